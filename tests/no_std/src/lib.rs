//! Integrations in a crate without the standard library and without an allocator: static vectors, elementary functions
//! from `libm`.
//!
//! Built alone, `cargo test -p symplectic-no-std`: in a build of the whole workspace the runtime has its default features.

#![no_std]

use core::ops::ControlFlow;

use symplectic::nalgebra::{SVector, Vector1};
use symplectic::output::Moment;
use symplectic::{Error, Event, Integrator, Method, Scalar, SeparableHamiltonian, State};

symplectic::tableau! {
    /// Explicit for separable systems, order 2.
    pub StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) }

    /// Implicit, order 8.
    pub Gauss4 { basis: polynomial(4), nodes: gauss(4) }
}

symplectic::composition! {
    /// Explicit, order 6.
    pub TripleJump { base: velocity-verlet, weights: triple_jump(6) }
}

/// H = p²/2 − cos q
#[derive(Clone, Copy, Debug)]
pub struct Pendulum;

impl SeparableHamiltonian for Pendulum {
    type Vector<T: Scalar> = Vector1<T>;

    fn velocity<T: Scalar>(&self, _time: T, p: &Vector1<T>, velocity: &mut Vector1<T>) {
        *velocity = *p;
    }

    fn force<T: Scalar>(&self, _time: T, q: &Vector1<T>, force: &mut Vector1<T>) {
        force[0] = -q[0].sin();
    }

    fn energy<T: Scalar>(&self, _time: T, q: &Vector1<T>, p: &Vector1<T>) -> Option<T> {
        Some(p[0] * p[0] * T::from_f64(0.5) - q[0].cos())
    }
}

/// The largest error of the energy of a swing from rest at `angle`, over 1000 steps.
///
/// # Errors
/// Those of a step.
pub fn energy_error<M: Method>(method: M, angle: f64, step_size: f64) -> Result<f64, Error> {
    let start = State::new(0.0, Vector1::new(angle), Vector1::new(0.0));
    let mut integrator = Integrator::new(method, Pendulum, start, step_size)?;
    let energy = -angle.cos();
    let mut largest = 0.0;
    for _ in 0..1000 {
        integrator.step()?;
        let error = integrator
            .energy()
            .map_or(f64::NAN, |now| (now - energy).abs());
        if error > largest || error.is_nan() {
            largest = error;
        }
    }
    Ok(largest)
}

/// How often a pendulum between two walls at ±`angle` touches them until the time 100.
///
/// # Errors
/// Those of a step.
pub fn impacts(angle: f64) -> Result<u32, Error> {
    let start = State::new(0.0, Vector1::new(0.0), Vector1::new(1.0));
    let mut integrator = Integrator::new(Gauss4, Pendulum, start, 0.25)?;
    let walls = [-1.0, 1.0].map(|side| {
        Event::wall(move |state: &State<Vector1<f64>>| angle - side * state.q[0]).by_steps()
    });
    let mut count = 0;
    integrator.integrate_through(100.0, &[50.0], &walls, |moment| {
        if let Moment::Event { state, .. } = moment {
            state.p = -state.p;
            count += 1;
        }
        ControlFlow::<()>::Continue(())
    })?;
    Ok(count)
}

symplectic::hamiltonian! {
    /// Toda's ring.
    pub Toda<N>
    q: [N], p: [N]; bonds: ring;
    H = sum(i: p[i]^2/2) + sum(bonds d: exp(d) - d)
    require: [chain]
}

/// The momentum of a ring of 100 particles after some steps, of which it keeps all.
///
/// # Errors
/// Those of a step.
pub fn momentum_of_a_ring(steps: u64) -> Result<f64, Error> {
    let pushed = SVector::<f64, 100>::from_fn(|i, _| if i == 50 { 1.0 } else { 0.0 });
    let start = State::new(0.0, SVector::zeros(), pushed);
    let mut ring = Integrator::plain(StoermerVerlet, Toda::<100>, start, 0.05)?;
    Ok(ring.take_steps(steps)?.p.sum())
}
