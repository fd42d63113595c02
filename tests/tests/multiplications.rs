//! The arithmetic of a step: no product with a coefficient that is zero, and none that could have been left out.

mod strict;

use strict::{Strict, products};
use symplectic::nalgebra::Vector1;
use symplectic::solver::FixedPoint;
use symplectic::{Error, Integrator, Method, Separable, State, System};
use symplectic_tests::methods::{Lobatto3, StoermerVerlet, SymplecticEuler};

/// A free particle under a constant force: its evaluations multiply nothing.
struct Falling;

impl System<Vector1<Strict>> for Falling {
    type Class = Separable;
    type Solver = FixedPoint;

    fn velocity(
        &self,
        _time: Strict,
        _q: &Vector1<Strict>,
        p: &Vector1<Strict>,
        velocity: &mut Vector1<Strict>,
    ) {
        *velocity = *p;
    }

    fn force(
        &self,
        _time: Strict,
        _q: &Vector1<Strict>,
        _p: &Vector1<Strict>,
        force: &mut Vector1<Strict>,
    ) {
        force[0] = Strict(-1.0);
    }
}

/// Products in the second step, and the sweeps it took.
fn second_step<M: Method + Copy>(method: M) -> Result<(u64, u64), Error> {
    let start = State::new(0.0, Vector1::new(Strict(3.0)), Vector1::new(Strict(2.0)));
    let mut integrator = Integrator::new(method, Falling, start, 0.125)?;
    integrator.step()?;
    let (before, sweeps) = (products(), integrator.iterations());
    integrator.step()?;
    Ok((products() - before, integrator.iterations() - sweeps))
}

#[test]
fn explicit_steps_multiply_by_nothing_but_their_coefficients() -> Result<(), Error> {
    // q1 = q0 + h v(p1), p1 = p0 + h f(q0)
    assert_eq!(second_step(SymplecticEuler)?, (2, 0));
    // P = p0 + (h/2) f(q0), q1 = q0 + h v(P), p1 = P + (h/2) f(q1)
    assert_eq!(second_step(StoermerVerlet)?, (3, 0));
    Ok(())
}

#[test]
fn implicit_steps_leave_out_the_zeros_of_their_matrices() -> Result<(), Error> {
    let (products, sweeps) = second_step(Lobatto3)?;
    // A sweep: a_2j has 3 entries, ã_ij 2 in each of 3 rows, the last column is zero; and the increments of 3 velocities
    // and a force. The start: three velocities from those before, of which the first is the last, and the position that
    // follows from them; the increment of the first force. The end: that of the last.
    assert_eq!(products, (9 + 4) * sweeps + (1 + 3 + 3) + 3 + 1 + 1);
    Ok(())
}

#[test]
#[should_panic(expected = "a product with zero")]
fn a_product_with_zero_would_be_seen() {
    let _ = Strict(0.0) * Strict(1.0);
}
