//! Galerkin methods with s basis functions and r ≥ s nodes (Leok & Zhang, 2011; Tang).

use crate::methods::{Gauss2, TwoOfThree};
use symplectic::nalgebra::{DMatrix, DVector, SVector, Vector2};
use symplectic::system::Lagrangian;
use symplectic::variational::{Error, LagrangianSteps, momentum_of_velocity, primary_constraints};
use symplectic::{Hamiltonian, Method, Scalar, State};

use crate::lagrangians::{
    Particle, Relativistic, Run, Vortices, Wrong, distance, near_perihelion, slope,
};

symplectic::tableau! {
    OneOfTwo { basis: polynomial(1), quadrature: gauss(2) }
    TwoOfFive { basis: polynomial(2), quadrature: gauss(5) }
    TwoOfSeven { basis: polynomial(2), quadrature: gauss(7) }
    ThreeOfFour { basis: polynomial(3), quadrature: lobatto(4) }
    Uneven { basis: polynomial(2), quadrature: [0, 1/4, 1] }
}

#[test]
fn galerkin_methods_have_their_orders() {
    macro_rules! each {
        ($($method:ident $steps:literal $order:literal;)*) => {$(
            let particle = Particle { friction: 0.0 };
            let make = |start, h| LagrangianSteps::galerkin($method, particle, start, h);
            let system = Relativistic { friction: 0.0 };
            let found = slope(make, system, &near_perihelion(), $steps);
            assert!((found - f64::from($order)).abs() < 0.05, "{}: {found}", $method::NAME);
        )*};
    }
    // min(2s, order of the quadrature formula)
    each! { OneOfTwo 256 2; TwoOfThree 32 4; ThreeOfFour 12 6; Uneven 256 3; Gauss2 32 4; }
}

symplectic::lagrangian! {
    /// The system of Hénon and Heiles.
    HenonHeiles q: [x, y], v: [vx, vy];
    L = (vx^2 + vy^2)/2 - (x^2 + y^2)/2 - x^2 y + y^3/3
}

#[test]
fn galerkin_is_the_tableau_for_a_quadratic_kinetic_energy_only() {
    let steps =
        |mut run: Run<_>| -> State<Vector2<f64>> { run.integrate_to(5.0).expect("a run").clone() };
    let start = State::from_arrays(0.0, [0.1, 0.2], [0.3, -0.2]);
    let tableau =
        LagrangianSteps::run(TwoOfThree, HenonHeiles, start.clone(), 0.5).expect("a start");
    let galerkin = LagrangianSteps::galerkin(TwoOfThree, HenonHeiles, start, 0.5).expect("a start");
    assert!(distance(&steps(tableau), &steps(galerkin)) < 1e-14);

    let ends = |run: Result<Run<Particle>, Error>| {
        run.expect("a start")
            .integrate_to(5.0)
            .expect("a run")
            .clone()
    };
    let (particle, start) = (Particle { friction: 0.0 }, near_perihelion());
    let tableau = ends(LagrangianSteps::run(
        TwoOfThree,
        particle,
        start.clone(),
        0.5,
    ));
    let galerkin = ends(LagrangianSteps::galerkin(TwoOfThree, particle, start, 0.5));
    assert!(distance(&tableau, &galerkin) > 1e-7);
}

/// No path inside a step is uniform: its velocity is a combination of t and t².
#[test]
fn a_basis_without_constants_has_no_galerkin_step() {
    symplectic::tableau! { NoConstants { basis: [t, t^2], quadrature: gauss(3) } }
    let particle = Particle { friction: 0.0 };
    let refused = LagrangianSteps::galerkin(NoConstants, particle, near_perihelion(), 0.1);
    assert!(matches!(
        refused.err(),
        Some(Error::NoConstants {
            method: "NoConstants"
        })
    ));
}

/// The functions 1, x − 1/2, x² − x + 1/6, and their integrals from 0.
fn functions(x: f64) -> [[f64; 3]; 2] {
    let square = x * x - x;
    let cubic = x * x * x / 3.0 - x * x / 2.0 + x / 6.0;
    [[1.0, x - 0.5, square + 1.0 / 6.0], [x, square / 2.0, cubic]]
}

/// By how much a step of size h violates Equations (30) of Leok & Zhang with the Hamiltonian, for s functions and a quadrature formula of
/// nodes and weights.
///
/// The functions after the first have mean zero, so `V_1` is the mean velocity. The ends do not show the other `V_k`: their own equations
/// give them, by Newton's iteration with differences.
fn violation(
    s: usize,
    formula: &[(f64, f64)],
    h: f64,
    start: &State<Vector2<f64>>,
    end: &State<Vector2<f64>>,
) -> f64 {
    let (particle, system) = (Particle { friction: 0.0 }, Relativistic { friction: 0.0 });
    let first = (end.q - start.q) / h;
    // The equations of all functions, and that of the momentum at the end.
    let equations = |inner: &DVector<f64>| {
        let velocities = |k: usize| match k {
            0 => first,
            _ => Vector2::new(inner[2 * k - 2], inner[2 * k - 1]),
        };
        let mut sums = vec![Vector2::zeros(); s];
        sums[0] = -start.p;
        let mut impulse = start.p - end.p;
        for &(c, b) in formula {
            let ([values, integrals], [_, whole]) = (functions(c), functions(1.0));
            let (mut q, mut v) = (start.q, Vector2::zeros());
            for k in 0..s {
                q += velocities(k) * (h * integrals[k]);
                v += velocities(k) * values[k];
            }
            let p = momentum_of_velocity(&particle, 0.0, &q, &v).expect("a momentum");
            let (mut velocity, mut force) = (Vector2::zeros(), Vector2::zeros());
            Hamiltonian::velocity(&system, 0.0, &q, &p, &mut velocity);
            Hamiltonian::force(&system, 0.0, &q, &p, &mut force);
            // The third line of (30): Σ_i ψ_i(c_j) V_i = ∂H/∂p.
            assert!((velocity - v).amax() < 1e-14);
            impulse += force * (h * b);
            for (k, sum) in sums.iter_mut().enumerate() {
                *sum += p * (b * values[k]) + force * (h * b * (integrals[k] - whole[k]));
            }
        }
        (sums, impulse)
    };
    let inside = |inner: &DVector<f64>| {
        let sums = equations(inner).0;
        DVector::from_fn(inner.len(), |k, _| sums[1 + k / 2][k % 2])
    };
    let mut inner = DVector::zeros(2 * (s - 1));
    for _ in 0..20 {
        let (at, step) = (inside(&inner), 1e-4);
        let columns: Vec<_> = (0..inner.len())
            .map(|k| {
                let mut moved = inner.clone();
                moved[k] += step;
                (inside(&moved) - &at) / step
            })
            .collect();
        let slopes = DMatrix::from_columns(&columns);
        inner -= slopes.try_inverse().expect("regular") * at;
    }
    assert!(inside(&inner).amax() < 1e-15);
    let (sums, impulse) = equations(&inner);
    sums[0].amax().max(impulse.amax())
}

/// (30) holds with the Hamiltonian at the step that (38) takes with the Lagrangian: Proposition 2 of Leok & Zhang, for (s, r) = (2, 3) and
/// (3, 4).
#[test]
fn steps_obey_the_hamiltonian_equations() {
    let start = near_perihelion();
    let particle = Particle { friction: 0.0 };
    let far = 0.15_f64.sqrt();
    let gauss = [
        (0.5 - far, 5.0 / 18.0),
        (0.5, 4.0 / 9.0),
        (0.5 + far, 5.0 / 18.0),
    ];
    let near = 0.05_f64.sqrt();
    let lobatto = [
        (0.0, 1.0 / 12.0),
        (0.5 - near, 5.0 / 12.0),
        (0.5 + near, 5.0 / 12.0),
        (1.0, 1.0 / 12.0),
    ];
    let two = LagrangianSteps::galerkin(TwoOfThree, particle, start.clone(), 0.5);
    let three = LagrangianSteps::galerkin(ThreeOfFour, particle, start.clone(), 0.5);
    let two = two.expect("a start").step().expect("a step").clone();
    let three = three.expect("a start").step().expect("a step").clone();
    let of = |s, formula: &[_], end| violation(s, formula, 0.5, &start, end);
    assert!(of(2, &gauss, &two) < 1e-14);
    assert!(of(3, &lobatto, &three) < 1e-14);
    // With the formula of the other method they do not hold.
    let others = [of(2, &lobatto, &two), of(3, &gauss, &three)];
    assert!(others.iter().all(|&other| other > 1e-10), "{others:?}");
}

/// With more and more Gauss nodes, the steps of two functions converge geometrically to that with exact integrals, Tang's (2.16)–(2.19): each
/// two nodes more gain a factor of more than a thousand.
#[test]
fn more_nodes_converge_to_exact_integrals() {
    let (h, start) = (2.0, near_perihelion());
    macro_rules! step {
        ($method:ident) => {{
            let particle = Particle { friction: 0.0 };
            let mut run =
                LagrangianSteps::galerkin($method, particle, start.clone(), h).expect("a start");
            run.step().expect("a step").clone()
        }};
    }
    let steps = [step!(TwoOfThree), step!(TwoOfFive), step!(TwoOfSeven)];
    // Integrals by the Gauss formula with three nodes on 64 intervals, exact to rounding.
    let far = 0.15_f64.sqrt();
    let exact: Vec<(f64, f64)> = (0..64)
        .flat_map(|k| {
            let nodes = [(-far, 5.0 / 18.0), (0.0, 4.0 / 9.0), (far, 5.0 / 18.0)];
            nodes.map(|(c, b)| ((f64::from(k) + 0.5 + c) / 64.0, b / 64.0))
        })
        .collect();
    let violations = steps
        .each_ref()
        .map(|end| violation(2, &exact, h, &start, end));
    assert!(violations[0] < 1e-4, "{violations:?}");
    for pair in violations.windows(2) {
        assert!(pair[1] < pair[0] / 1000.0, "{violations:?}");
    }
    // So do the steps.
    let [a, b] = [0, 1].map(|k| distance(&steps[k], &steps[k + 1]));
    assert!(b < a / 1000.0 && b > 1e-10, "{a:e} {b:e}");
}

/// For r > s a Lagrangian that is linear in velocities, or lacks one, is refused: the steps would leave the primary constraints p = ∂L/∂v.
#[test]
fn degenerate_lagrangians_need_as_many_functions_as_nodes() -> Result<(), Error> {
    let q = SVector::from([1.0, 0.3, -0.5, -0.2]);
    let p = momentum_of_velocity(&Vortices, 0.0, &q, &SVector::zeros())?;
    let vortices = State::new(0.0, q, p);
    let refused = LagrangianSteps::galerkin(TwoOfThree, Vortices, vortices.clone(), 0.1).err();
    let (method, component) = ("TwoOfThree", 0);
    assert_eq!(
        refused,
        Some(Error::DegenerateLagrangian { method, component })
    );
    let lacking = State::from_arrays(0.0, [1.0, 0.0], [0.0, 0.0]);
    let refused =
        LagrangianSteps::galerkin(TwoOfThree, Wrong { strange: false }, lacking, 0.1).err();
    let error = refused.expect("refused");
    let component = 1;
    assert_eq!(error, Error::DegenerateLagrangian { method, component });
    let text = error.to_string();
    assert!(
        text.contains("take `DiracIntegrator`") && text.contains("component 1"),
        "{text}"
    );
    let constraints = primary_constraints(
        &Wrong { strange: false },
        0.0,
        &[1.0, 0.0].into(),
        &[0.5, 0.5].into(),
    )?;
    let constraints: Vec<_> = constraints
        .into_iter()
        .map(|found| (found.direction.into(), found.value))
        .collect();
    assert!(
        text.contains("`primary_constraints`") && constraints == [([0.0, 1.0], 0.0)],
        "{text}"
    );
    // With as many functions as nodes the steps keep the constraints.
    let mut run = LagrangianSteps::galerkin(Gauss2, Vortices, vortices, 0.1)?;
    for _ in 0..10 {
        let State { q, p, .. } = run.step()?;
        let off = [p[0] - q[1], p[1], p[2] - q[3], p[3]];
        assert!(off.iter().all(|off| off.abs() < 1e-15), "{off:?}");
    }
    Ok(())
}

symplectic::lagrangian! {
    /// Degenerate at rest only.
    Quartic q: [x], v: [vx];
    L = vx^4/4 - x^2/2
}

symplectic::lagrangian! {
    /// A mass that vanishes at x = 0.
    Massless q: [x, y], v: [vx, vy];
    L = x vx^2/2 + vy^2/2 - x
}

/// What counts is the velocity of the state, not rest.
#[test]
fn a_lagrangian_that_is_degenerate_elsewhere_is_stepped() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [0.1], [8.0]);
    macro_rules! check {
        ($method:ident) => {
            let error = |steps: u32| -> Result<f64, Error> {
                let h = 2.0 / f64::from(steps);
                let mut run = LagrangianSteps::galerkin($method, Quartic, start.clone(), h)?;
                let energy = run.stepper().energy()?;
                run.integrate_to(2.0)?;
                Ok((run.stepper().energy()? - energy).abs())
            };
            let found = (error(16)? / error(32)?).log2();
            assert!((found - 4.0).abs() < 0.1, "{}: {found}", $method::NAME);
        };
    }
    check!(TwoOfThree);
    check!(Gauss2);
    Ok(())
}

/// L = v⁴/4, which counts its evaluations.
struct Counted(std::cell::Cell<u32>);

impl Lagrangian for Counted {
    type Vector<T: Scalar> = SVector<T, 1>;

    fn lagrangian<T: Scalar>(&self, _: T, _: &SVector<T, 1>, v: &SVector<T, 1>) -> T {
        self.0.set(self.0.get() + 1);
        v[0].powi(4) * T::from_f64(0.25)
    }
}

/// The stages of a free particle all have the velocity of the start. An evaluation with second derivatives takes three of L at each stage,
/// and the one that confirms it takes one.
#[test]
fn the_first_step_begins_with_the_velocity_of_the_start() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [0.0], [8.0]);
    macro_rules! check {
        ($($method:ident)*) => {$(
            let free = Counted(std::cell::Cell::new(0));
            let mut run = LagrangianSteps::galerkin($method, free, start.clone(), 0.1)?;
            run.stepper().lagrangian().0.set(0);
            let state = run.step()?;
            assert!((state.q[0] - 0.2).abs() < 1e-15 && state.p == start.p);
            let stages = u32::try_from($method::STAGES).expect("few");
            assert_eq!(run.stepper().lagrangian().0.get(), 4 * stages, "{}", $method::NAME);
        )*};
    }
    check! { OneOfTwo TwoOfThree TwoOfFive ThreeOfFour Uneven Gauss2 }
    Ok(())
}

/// Where the mass vanishes, the momentum of x is zero.
#[test]
fn a_lagrangian_that_is_degenerate_at_the_start_is_refused() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [0.0, 1.0], [0.0, 0.5]);
    let (method, component) = ("TwoOfThree", 0);
    let refused = LagrangianSteps::galerkin(TwoOfThree, Massless, start.clone(), 0.1).err();
    assert_eq!(
        refused,
        Some(Error::DegenerateLagrangian { method, component })
    );
    // At the start only: the first step says so.
    let mut run = LagrangianSteps::galerkin(Gauss2, Massless, start.clone(), 0.1)?;
    let error = run.step().map(|_| ()).expect_err("singular");
    assert!(
        matches!(
            error,
            Error::IrregularLagrangian {
                component: 0,
                step: 1,
                ..
            }
        ),
        "{error}"
    );
    assert!(
        error.to_string().contains("`primary_constraints`"),
        "{error}"
    );
    assert_eq!(*run.state(), start);
    let found = primary_constraints(&Massless, 0.0, &start.q, &[3.0, 0.5].into())?;
    let found: Vec<_> = found
        .into_iter()
        .map(|found| (found.direction.into(), found.value))
        .collect();
    assert_eq!(found, [([1.0, 0.0], 0.0)]);
    Ok(())
}
