//! Forces `f(t, q, p)` with methods whose nodes c and c̃ differ.
//!
//! Time is one more position, with velocity 1. So the time of a force is `t0 + c_i h`, and the order for general Hamiltonians holds. Beyond
//! order 2 only methods with negative weights have `c ≠ c̃`, such as compositions.

use crate::methods::{Gauss4, StoermerVerlet};
use symplectic::nalgebra::Vector3;
use symplectic::{Error, Integrator, Method, State};

use crate::discrete_lagrangians::Jump6;
use crate::forces::{FourthRattle, slope, swing};

symplectic::hamiltonian! {
    /// Friction that depends on time and place, and drives where it is negative.
    pub Pumped
    q: [x], p: [px];
    H = (px^2 + x^4)/2
    force: { x = -(0.1 + 0.5 sin(2 t)) (1 + x^2) px }
}

symplectic::hamiltonian! {
    /// A spherical pendulum of length 1 in a medium whose resistance changes with time.
    pub Rod
    q: [x, y, z], p: [px, py, pz];
    let gamma = 0.3 + sin(3 t);
    H = (px^2 + py^2 + pz^2)/2 + z
    constraints: { rod = x^2 + y^2 + z^2 - 1 }
    force: { x = -gamma px, y = -gamma py, z = -gamma pz }
}

symplectic::hamiltonian! {
    /// The same in the angle a from the vertical and the azimuth b.
    pub Angles
    q: [a, b], p: [pa, pb];
    let gamma = 0.3 + sin(3 t);
    H = (pa^2 + pb^2/sin(a)^2)/2 + cos(a)
    force: { a = -gamma pa, b = -gamma pb }
}

#[test]
fn nodes_of_positions_and_momenta_differ() {
    let coefficients = StoermerVerlet::COEFFICIENTS;
    let nodes = coefficients.c.iter().zip(coefficients.c_tilde);
    for (c, c_tilde) in nodes {
        assert_eq!((c.double() - c_tilde.double()).abs(), 0.5);
    }
}

#[test]
fn the_order_is_that_for_general_hamiltonians() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [1.0], [0.5]);
    let mut run = Integrator::new(Gauss4, Pumped, start.clone(), 1.0 / 64.0)?;
    let end = run.integrate_to(4.0)?.clone();
    for (found, order) in [
        (slope(StoermerVerlet, || Pumped, &start, &end, 256), 2.0),
        (slope(FourthRattle, || Pumped, &start, &end, 256), 4.0),
        (slope(Jump6, || Pumped, &start, &end, 64), 6.0),
    ] {
        assert!((found - order).abs() < 0.05, "{found} instead of {order}");
    }
    Ok(())
}

/// Against the same motion in angles, by a Gauss method.
#[test]
fn the_order_with_constraints_is_the_same() -> Result<(), Error> {
    let angles = State::from_arrays(0.0, [(-0.8_f64).acos(), 0.0], [-0.5, 0.42]);
    let mut run = Integrator::new(Gauss4, Angles, angles, 1.0 / 128.0)?;
    let State { q, p, .. } = run.integrate_to(2.0)?.clone();
    let ((sin_a, cos_a), (sin_b, cos_b)) = (q[0].sin_cos(), q[1].sin_cos());
    let along_a = Vector3::new(cos_a * cos_b, cos_a * sin_b, -sin_a);
    let along_b = Vector3::new(-sin_b, cos_b, 0.0);
    let end = State::new(
        2.0,
        Vector3::new(sin_a * cos_b, sin_a * sin_b, cos_a),
        along_a * p[0] + along_b * (p[1] / sin_a),
    );
    for (found, order) in [
        (slope(StoermerVerlet, || Rod, &swing(), &end, 64), 2.0),
        (slope(FourthRattle, || Rod, &swing(), &end, 128), 4.0),
    ] {
        assert!((found - order).abs() < 0.05, "{found} instead of {order}");
    }
    Ok(())
}
