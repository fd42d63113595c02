//! Formulas with `|x|`, `max` and powers of lengths, where these are zero: all derivatives that steps need are finite there.

use symplectic::nalgebra::{DVector, SVector, Vector1, Vector2};
use symplectic::simd::{F64x8, Lanes};
use symplectic::solver::ByNewton;
use symplectic::system::Jacobian;
use symplectic::tangent::Tangent;
use symplectic::{Error, Hamiltonian, Integrator, Scalar, State};

symplectic::tableau! { Gauss2 { base: gauss-2 } }
symplectic::tableau! { Verlet { base: velocity-verlet } }

symplectic::hamiltonian! { Cubic q: [x], p: [px]; H = px^2/2 + |x|^3 }
symplectic::hamiltonian! { Length q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + |[x, y]|^3 }
symplectic::hamiltonian! { Fall { g: 9.81, c: 0.1 } q: [x], p: [px]; H = px^2/2 + g x force: { x = -c px |px| } }
symplectic::hamiltonian! { Bracket { g: 9.81, c: 0.1 } q: [x], p: [px]; H = px^2/2 + g x force: { x = -c px |[px]| } }
symplectic::hamiltonian! {
    Throw { g: 9.81, c: 0.1 }
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + g y
    force: { x = -c px |[px, py]|, y = -c py |[px, py]| }
}
symplectic::hamiltonian! {
    /// Kinks of every kind, with powers that are not halves.
    Kinks { a: 0.5 }
    q: [x, y], p: [px, py];
    H = (px^2 + py^2) (1 + |[x, y]|^3)/2 + |[x, y]|^2.3 + x^2 |x| + |2 x|^2.2 + max(x, 0)^(5/2) + max(0, y)^2.7 a
        + min(x - y, 0)^3 + |sin(y)|^3 + cos(|x|) + px^2 |px|
}
symplectic::hamiltonian! {
    /// Spheres in contact between walls: Hertz.
    Spheres
    q: [..], p: [..]; bonds: walls;
    H = sum(i: p[i]^2/2) + sum(bonds d: max(-d, 0)^(5/2))
}

/// The end of ten steps of size 0.1, by fixed points and by Newton's iteration.
macro_rules! ends {
    ($system:expr, $start:expr) => {{
        let start = $start;
        let mut fixed = Integrator::new(Gauss2, $system, start.clone(), 0.1)?;
        let mut newton = Integrator::new(Gauss2, $system, start, 0.1)?.by_newton();
        [
            fixed.take_steps(10)?.clone(),
            newton.take_steps(10)?.clone(),
        ]
    }};
}

#[test]
fn steps_from_rest_at_a_kink_have_both_iterations() -> Result<(), Error> {
    let rest = State::from_arrays(0.0, [0.0], [0.0]);
    for end in ends!(Cubic, rest.clone()) {
        assert_eq!((end.q[0], end.p[0]), (0.0, 0.0));
    }
    let origin = State::from_arrays(0.0, [0.0; 2], [0.0; 2]);
    for end in ends!(Length, origin.clone()) {
        assert_eq!((end.q, end.p), (Vector2::zeros(), Vector2::zeros()));
    }
    // p' = −g + c p², and the error of ten steps of order 4 is 4e-7.
    let limit = (9.81_f64 / 0.1).sqrt();
    let exact = -limit * (9.81 / limit).tanh();
    let falls = ends!(Fall::new(), rest.clone());
    for (fall, throw) in falls.iter().zip(ends!(Throw::new(), origin)) {
        assert!((fall.p[0] - exact).abs() < 1e-6, "{}", fall.p[0]);
        assert!((throw.p[1] - exact).abs() < 1e-6 && throw.p[0] == 0.0);
    }
    // Two spellings of one function.
    assert_eq!(ends!(Bracket::new(), rest), falls);
    Ok(())
}

#[test]
fn newtons_iteration_ends_where_fixed_points_do() -> Result<(), Error> {
    // Through x = 0 and y = 0, where some terms have their kinks.
    for start in [
        [0.0, 0.0, 0.0, 0.0],
        [-0.3, 0.2, 1.0, -0.7],
        [0.0, 0.0, 0.0, 0.5],
    ] {
        let [x, y, px, py] = start;
        let [fixed, newton] = ends!(Kinks::new(), State::from_arrays(0.0, [x, y], [px, py]));
        // The rounding of a few sweeps.
        assert!((fixed.q - newton.q).norm() + (fixed.p - newton.p).norm() < 1e-14);
    }
    let zeros = || DVector::from_element(4, 0.0);
    let mut p = zeros();
    p[0] = 1.0;
    let [fixed, newton] = ends!(Spheres, State::new(0.0, zeros(), p));
    assert!((fixed.q - newton.q).norm() + (fixed.p - newton.p).norm() < 1e-14);
    Ok(())
}

/// At the origin the second derivatives of |q|³ are zero: displacements move freely.
#[test]
fn tangent_maps_are_finite_at_a_kink() -> Result<(), symplectic::tangent::Error> {
    let tangent = Tangent::new(Length);
    let origin = State::from_arrays(0.0, [0.0; 2], [0.0; 2]);
    let start = || tangent.start(&origin, (&Vector2::new(1.0, 0.0), &Vector2::new(0.0, 2.0)));
    let gauss: State<SVector<f64, 4>> = start()?;
    let mut gauss = Integrator::new(Gauss2, tangent, gauss, 0.5)?;
    let verlet: State<SVector<f64, 4>> = start()?;
    let mut verlet = Integrator::new(Verlet, tangent, verlet, 0.5)?;
    for end in [gauss.take_steps(2)?, verlet.take_steps(2)?] {
        assert_eq!((end.q.sum(), end.p.sum()), (3.0, 2.0));
    }
    Ok(())
}

symplectic::hamiltonian! { RootOfFour q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + sqrt(x^4 (1 + y^2)) }
symplectic::hamiltonian! { Hypot q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + hypot(x^2, x^2 y) }
symplectic::hamiltonian! { Hidden q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + sqrt(x^4 + (x^2 y)^2 + x^6) }
symplectic::hamiltonian! { Even q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + x^2/2 + 4 - 2 cos(|x|) + y sin(|y|) sin(|y|) }
symplectic::hamiltonian! { Sizes q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + |x| sin(|x|) }
symplectic::hamiltonian! { Ball q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + 2 - 2 cos(|[x, y]|) }
symplectic::hamiltonian! { Sides q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + max(x, 0)^2 + min(x, 0)^2 }
symplectic::hamiltonian! { Squares q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + |x^2 + y^2| + max(x^2 + y^2, 0)/2 }
symplectic::hamiltonian! { Quotient q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + x^3/sqrt(x^4 + x^6) }

/// A derivative whose emitted form has no value at a kink is no number there, never a wrong one.
#[test]
fn second_derivatives_at_a_kink_are_limits_or_nan() {
    macro_rules! second {
        ($system:expr) => {{
            let mut jacobian = Jacobian::<f64>::new(2, usize::MAX);
            let zero = Vector2::<f64>::zeros();
            assert!($system.second_derivatives(0.0, &zero, &zero, &mut jacobian));
            -jacobian.force_by_position.get(0, 0)
        }};
    }
    assert_eq!([second!(RootOfFour), second!(Hypot)], [2.0, 2.0]);
    assert_eq!([second!(Even), second!(Squares)], [3.0, 3.0]);
    let others: [f64; 4] = [
        second!(Hidden),
        second!(Sizes),
        second!(Ball),
        second!(Sides),
    ];
    for found in others {
        assert!(found == 2.0 || found.is_nan(), "{found}");
    }
    assert_eq!(second!(Length), 0.0);
    let mut force = Vector2::<f64>::zeros();
    Quotient.force(0.0, &Vector2::zeros(), &Vector2::zeros(), &mut force);
    assert!(force[0] == -1.0 || force[0].is_nan(), "{force}");
}

/// The velocity and the force at a point.
fn slopes<T: Scalar>(x: [T; 4]) -> [T; 4] {
    let (q, p) = (SVector::from([x[0], x[1]]), SVector::from([x[2], x[3]]));
    let (mut velocity, mut force) = (SVector::zeros(), SVector::zeros());
    Kinks::new().velocity(T::zero(), &q, &p, &mut velocity);
    Kinks::new().force(T::zero(), &q, &p, &mut force);
    [velocity[0], velocity[1], force[0], force[1]]
}

#[test]
fn every_scalar_has_the_same_values_at_a_kink() {
    const NUMBERS: [f64; 5] = [0.0, -0.0, 0.75, -1.5, 1e-3];
    let mut points = Vec::new();
    for x in NUMBERS {
        for y in NUMBERS {
            points.push([x, y, -x, 0.5 * y]);
        }
    }
    for eight in points.chunks(8) {
        let lanes = core::array::from_fn(|k| {
            F64x8::from_fn(|lane| eight.get(lane).unwrap_or(&eight[0])[k])
        });
        let lanes = slopes(lanes).map(Lanes::to_array);
        for (lane, point) in eight.iter().enumerate() {
            let doubles = slopes(*point);
            let singles = slopes(point.map(|x| x as f32));
            for k in 0..4 {
                assert_eq!(
                    lanes[k].as_ref()[lane].to_bits(),
                    doubles[k].to_bits(),
                    "{point:?}"
                );
                // Ten operations of rounding, each of a number below 20.
                let error = (f64::from(singles[k]) - doubles[k]).abs();
                assert!(
                    error < 10.0 * 20.0 * f64::from(f32::EPSILON),
                    "{point:?} {error}"
                );
            }
        }
    }
    assert_eq!(slopes([0.0_f64; 4]), [0.0; 4]);
}

/// The square of a length that is far below 1: nothing is added to it.
#[test]
fn powers_of_short_lengths_keep_their_digits() {
    for x in [1e-150, 1e-20, 1e-3, 1e3] {
        let mut force = Vector1::zeros();
        Cubic.force(0.0, &Vector1::new(-x), &force.clone(), &mut force);
        assert!((force[0] / (3.0 * x * x) - 1.0).abs() < 1e-15);
        let mut force = Vector2::zeros();
        let q = Vector2::new(0.0, x);
        Length.force(0.0, &q, &force.clone(), &mut force);
        assert!((force[1] / (-3.0 * x * x) - 1.0).abs() < 1e-15);
    }
}
