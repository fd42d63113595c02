//! Constraints and friction from formulas, against the same motion in other coordinates.

use crate::methods::{ForestRuth, Gauss6, Lobatto4};
use crate::systems::Rattle;
use symplectic::constraints::{ConstraintName, HolonomicConstraints, consistent};
use symplectic::nalgebra::{DVector, SMatrix, SVector};
use symplectic::{Error, Integrator, State};

symplectic::hamiltonian! {
    /// The double pendulum in the plane.
    pub Plane { g: 9.81 }
    q: [x1, y1, x2, y2], p: [px1, py1, px2, py2];
    H = (px1^2 + py1^2 + px2^2 + py2^2)/2 + g (y1 + y2)
    constraints: { first = x1^2 + y1^2 - 1, second = (x2 - x1)^2 + (y2 - y1)^2 - 1 }
}

symplectic::lagrangian! {
    /// The same by its angles from below.
    pub Angles { g: 9.81 }
    q: [a, b], v: [va, vb];
    L = va^2 + vb^2/2 + va vb cos(a - b) + g (2 cos(a) + cos(b))
}

symplectic::lagrangian! {
    /// A chain of links in space, the first at the origin.
    pub Links<N> { m: [N], g: 1 }
    q: [N; 3], v: [N; 3];
    L = sum(i: m[i] |v[i]|^2/2 - g m[i] q[i][2])
    constraints: { anchor = |q[0]|^2 - 1, link(i in 1..N) = |q[i] - q[i-1]|^2 - 1 }
    invariants: { about_the_vertical = sum(i: q[i][0] p[i][1] - q[i][1] p[i][0]) }
}

symplectic::hamiltonian! {
    /// Molecules with rigid bonds.
    pub Molecules { m: [..], rods: pairs, length: [rods] }
    q: [..; 2], p: [..; 2];
    H = sum(i: |p[i]|^2/(2 m[i]))
    constraints: { rod(s = (i, j) in rods) = |q[i] - q[j]|^2 - length[s]^2 }
}

symplectic::hamiltonian! {
    /// Two points at one place: a constraint with components.
    pub Pinned { k: 1 }
    q: [2; 2], p: [2; 2];
    H = sum(i: |p[i]|^2/2) + k |q[0]|^2/2
    constraints: { pin = q[0] - q[1] }
}

symplectic::hamiltonian! {
    /// An oscillator with friction.
    pub Damped { gamma: 0.2 }
    q: [x], p: [px];
    H = (px^2 + x^2)/2
    friction: gamma
}

symplectic::hamiltonian! {
    /// A bead on a line, pushed against it where it is not at zero.
    pub Line
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 - x y
    constraints: { line = y }
}

/// The positions need one sweep and the last multiplier two: with one allowed that is an error, and no momentum off the line.
#[test]
fn too_few_sweeps_are_an_error() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [0.0, 0.0], [1.0, 0.0]);
    let mut run = Integrator::new(Rattle, Line, start.clone(), 0.1)?;
    run.set_max_iterations(1);
    let error = run.step().map(|_| ()).expect_err("one sweep");
    assert!(matches!(error, Error::NoConvergence { .. }), "{error}");
    assert_eq!(run.state(), &start);
    run.set_max_iterations(2);
    assert_eq!(run.step()?.to_arrays(), ([0.1, 0.0], [1.0, 0.0]));
    Ok(())
}

#[test]
fn coordinates_and_angles_are_the_same_motion() -> Result<(), Error> {
    let (a, b) = (1.2_f64, 2.0_f64);
    let angles = Angles::default();
    let p = angles.momentum_of_velocity(0.0, &SVector::from([a, b]), &SVector::from([0.3, -0.2]));
    let mut angles = Integrator::new(
        Gauss6,
        angles,
        State::new(0.0, SVector::from([a, b]), p),
        0.02,
    )?;
    let place = |a: f64, b: f64| {
        let first = [a.sin(), -a.cos()];
        [first[0], first[1], first[0] + b.sin(), first[1] - b.cos()]
    };
    let (va, vb) = (0.3, -0.2);
    let first = [a.cos() * va, a.sin() * va];
    let velocity = [
        first[0],
        first[1],
        first[0] + b.cos() * vb,
        first[1] + b.sin() * vb,
    ];
    let start = State::from_arrays(0.0, place(a, b), velocity);
    let mut plane = Integrator::new(Lobatto4, Plane::default(), start, 0.0025)?;
    for end in [0.5, 1.0, 2.0] {
        let [a, b] = angles.integrate_to(end)?.to_arrays().0;
        let found = plane.integrate_to(end)?.to_arrays().0;
        for (found, exact) in found.iter().zip(place(a, b)) {
            assert!((found - exact).abs() < 1e-10, "{end}: {found} {exact}");
        }
    }
    Ok(())
}

#[test]
fn chains_keep_their_links_and_momenta() -> Result<(), Error> {
    let links = Links::<5>::new([1.0, 2.0, 1.0, 2.0, 1.0]);
    assert_eq!(
        HolonomicConstraints::<SMatrix<f64, 3, 5>>::constraints(&links),
        5
    );
    let q =
        SMatrix::<f64, 3, 5>::from_fn(|row, body| if row == 0 { 1.0 + body as f64 } else { 0.0 });
    let mut p = SMatrix::zeros();
    p[(1, 4)] = 1.5;
    let before = links.about_the_vertical(&q, &p);
    let mut run = Integrator::new(Lobatto4, links, State::new(0.0, q, p), 0.05)?;
    let energy = run.energy().expect("known");
    for _ in 0..400 {
        run.step()?;
        let mut values = [0.0; 5];
        HolonomicConstraints::constraint_values(run.system(), &run.state().q, &mut values);
        assert!(values.iter().all(|value| value.abs() < 2e-14), "{values:?}");
    }
    let State { q, p, .. } = run.state();
    assert!((run.system().about_the_vertical(q, p) - before).abs() < 1e-12);
    assert!((run.energy().expect("known") - energy).abs() < 1e-3);
    Ok(())
}

#[test]
fn molecules_from_data_keep_their_momentum_and_bonds() -> Result<(), Error> {
    let water = Molecules::new(
        vec![16.0, 1.0, 1.0],
        vec![(0, 1), (0, 2), (1, 2)],
        vec![1.0, 1.0, 1.5],
    );
    let q = DVector::from_vec(vec![0.0, 0.0, 1.0, 0.0, -0.1, 1.0]);
    let p = DVector::from_vec(vec![0.1, 0.0, 0.0, 1.0, 0.0, 0.2]);
    let start = consistent(&water, State::new(0.0, q, p))?;
    let total =
        |state: &State<DVector<f64>>| [0, 1].map(|k| state.p[k] + state.p[k + 2] + state.p[k + 4]);
    let momentum = total(&start);
    let mut run = Integrator::new(Rattle, water, start, 0.02)?;
    let energy: f64 = run.energy().expect("known");
    run.integrate_to(20.0)?;
    // No force acts: the turning of a rigid body conserves its energy in every step.
    assert!((run.energy().expect("known") - energy).abs() < 1e-12);
    for (found, exact) in total(run.state()).iter().zip(momentum) {
        assert!((found - exact).abs() < 1e-13);
    }
    Ok(())
}

/// Errors say what the constraint is called.
#[test]
fn constraints_have_names() {
    let rods = Molecules::new(vec![1.0; 3], vec![(0, 1), (1, 2)], vec![1.0, 1.0]);
    let q = DVector::from_vec(vec![0.0, 0.0, 1.0, 0.0, 1.0, 1.5]);
    let start = State::new(0.0, q, DVector::zeros(6));
    let error = Integrator::new(Rattle, rods, start, 0.1)
        .map(|_| ())
        .expect_err("too long");
    let Error::InconsistentStart { name, .. } = error else {
        panic!("{error}");
    };
    let member = Some(1);
    assert_eq!(
        name,
        Some(ConstraintName {
            name: "rod",
            member
        })
    );
    assert!(
        error.to_string().contains("constraint 1 (`rod[1]`)"),
        "{error}"
    );

    let start = State::from_arrays(0.0, [1.0, 0.0, 1.0, 0.0], [0.0; 4]);
    let error = Integrator::new(Rattle, Plane::default(), start, 0.1);
    let error = error.map(|_| ()).expect_err("a rod without length");
    assert!(error.to_string().contains("`second`"), "{error}");
}

/// A pair outside the positions is an error of the start, and no panic.
#[test]
fn a_pair_outside_is_refused() {
    let wrong = Molecules::new(vec![1.0; 2], vec![(0, 7)], vec![1.0]);
    let start = State::new(
        0.0,
        DVector::from_vec(vec![0.0, 0.0, 1.0, 0.0]),
        DVector::zeros(4),
    );
    let error = Integrator::new(Rattle, wrong, start, 0.1).map(|_| ());
    assert_eq!(
        error,
        Err(Error::PairOutOfRange {
            parameter: "rods",
            index: 0,
            pair: (0, 7),
            bodies: 2,
        })
    );
}

/// Each of the two points has half of the force.
#[test]
fn each_component_of_a_constraint_has_its_multiplier() -> Result<(), Error> {
    assert_eq!(
        HolonomicConstraints::<SMatrix<f64, 2, 2>>::constraints(&Pinned::default()),
        2
    );
    let q = SMatrix::<f64, 2, 2>::from([[1.0, 0.5], [1.0, 0.5]]);
    let mut run = Integrator::new(
        Lobatto4,
        Pinned::default(),
        State::new(0.0, q, SMatrix::zeros()),
        0.05,
    )?;
    let q = run.integrate_to(3.0)?.q;
    let exact = (3.0 / 2.0_f64.sqrt()).cos();
    assert!((q[(0, 1)] - exact).abs() < 1e-8 && (q[(1, 0)] - 0.5 * exact).abs() < 1e-8);
    Ok(())
}

#[test]
fn friction_of_a_formula_has_its_closed_form() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [1.0], [0.0]);
    let mut run = Integrator::new(ForestRuth, Damped::default(), start, 0.05)?;
    let x = run.integrate_to(10.0)?.to_arrays().0[0];
    let (rate, frequency) = (0.1_f64, 0.99_f64.sqrt());
    let exact = (-rate * 10.0).exp()
        * ((frequency * 10.0).cos() + rate / frequency * (frequency * 10.0).sin());
    assert!((x - exact).abs() < 1e-6, "{x} {exact}");
    Ok(())
}

/// Where a formula is singular and its limit is not, and far from the numbers that are usual.
mod far_and_singular {
    use symplectic::nalgebra::{SVector, Vector1, Vector3};
    use symplectic::{Error, Hamiltonian, Integrator, Quantity, State};

    symplectic::tableau! { Verlet { base: velocity-verlet } }

    symplectic::hamiltonian! {
        /// Powers of a distance that are smooth where it is zero.
        Powers
        q: [3], p: [3];
        H = |p|^2/2 + |q|^3 + |q|^4 + |q|^(5/2)
    }

    symplectic::hamiltonian! {
        /// The limit at zero is 1, and the quotient has none.
        Quotient
        q: [x], p: [px];
        H = px^2/2 + sin(x)/x
    }

    symplectic::hamiltonian! {
        /// Functions that are bounded, or underflow.
        Bounded
        q: [x], p: [px];
        H = px^2/2 + tanh(x) + atan(x) + exp(-x^2) + 1/(1 + x^2)
    }

    fn force<S, const N: usize>(system: &S, q: [f64; N]) -> SVector<f64, N>
    where
        S: Hamiltonian<Vector<f64> = SVector<f64, N>>,
    {
        let (q, mut force) = (SVector::from(q), SVector::zeros());
        system.force(0.0, &q, &SVector::zeros(), &mut force);
        force
    }

    #[test]
    fn powers_of_a_distance_are_smooth_at_zero() {
        assert_eq!(force(&Powers, [0.0; 3]), Vector3::zeros());
        // Where |q|² underflows the force does.
        assert_eq!(force(&Powers, [1e-200, 0.0, 0.0]), Vector3::zeros());
        for x in [1e-150, 1e-20, 1e-3, 1.0, 1e20, 1e70] {
            let found = force(&Powers, [0.0, -x, 0.0])[1];
            let exact = 3.0 * x.powi(2) + 4.0 * x.powi(3) + 2.5 * x * x.sqrt();
            assert!((found / exact - 1.0).abs() < 1e-14, "{x}: {found}");
        }
    }

    #[test]
    fn bounded_functions_have_forces_everywhere() {
        for x in [1e-300, 1e-9, 0.5, 30.0, 1e3, 1e150] {
            let exact = |x: f64| {
                let tanh = x.cosh().recip().powi(2);
                let gauss = -2.0 * x * (-x * x).exp();
                tanh + 1.0 / (1.0 + x * x) + gauss - 2.0 * x / (1.0 + x * x) / (1.0 + x * x)
            };
            for x in [x, -x] {
                let found = force(&Bounded, [x])[0];
                let error = (found + exact(x)).abs();
                assert!(error < 1e-14, "{x}: {found} {}", exact(x));
            }
        }
    }

    #[test]
    fn a_quotient_of_zeros_is_an_error_of_the_step() -> Result<(), Error> {
        let near = force(&Quotient, [1e-3])[0];
        assert!((near - 1e-3 / 3.0).abs() < 1e-9, "{near}");
        let start = State::new(0.0, Vector1::new(0.0), Vector1::new(1.0));
        let mut run = Integrator::new(Verlet, Quotient, start.clone(), 0.1)?;
        let error = run.step().err();
        let is_that = matches!(
            error,
            Some(Error::NonFinite {
                what: Quantity::Force,
                ..
            })
        );
        assert!(is_that, "{error:?}");
        assert_eq!(run.state(), &start);
        Ok(())
    }
}
