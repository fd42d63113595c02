//! A formula as a system for integrators.

use std::sync::Arc;

use symplectic::nalgebra::DVector;
use symplectic::{General, Hamiltonian, Scalar, SeparableHamiltonian, State};
use symplectic_compiler::formula::derivative::gradient;
use symplectic_compiler::formula::graph::{Half, integer};
use symplectic_compiler::formula::{Structure, System};

use super::tape::{At, Tape};
use super::unroll::{Refusal, Unrolled};
use super::values::Values;

/// The tapes of a formula.
#[derive(Debug)]
pub(super) struct Tapes {
    velocity: Tape,
    force: Tape,
    /// Velocity followed by force.
    slopes: Tape,
    energy: Tape,
}

impl Tapes {
    /// Differentiates a system and unrolls its loops.
    pub(super) fn new(
        system: &mut System,
        structure: &Structure,
        values: &Values,
    ) -> Result<Self, Refusal> {
        let energy = system.energy;
        let (kinetic, potential) = match structure.split {
            Ok(split) => (split.kinetic, split.potential),
            Err(_) => (energy, energy),
        };
        let mut by = |of, sign, half| gradient(&mut system.graph, of, &[], integer(sign), half);
        let velocity = by(kinetic, 1, Half::P);
        let force = by(potential, -1, Half::Q);
        if system.graph.overflowed() {
            return Err(Refusal::TooLong);
        }
        let parts = velocity.iter().chain(&force).map(|part| part.value);
        let mut unrolled = Unrolled::new(system, values, &parts.collect::<Vec<_>>())?;
        let velocity = unrolled.gradient(&velocity)?;
        let force = unrolled.gradient(&force)?;
        let of_energy = Unrolled::new(system, values, &[energy])?;
        Ok(Tapes {
            slopes: unrolled.tape(&[velocity.as_slice(), &force].concat())?,
            velocity: unrolled.tape(&velocity)?,
            force: unrolled.tape(&force)?,
            energy: of_energy.tape(&[of_energy.of(energy)?])?,
        })
    }

    /// H at a state.
    pub(super) fn energy_at(&self, state: &State<DVector<f64>>) -> f64 {
        self.energy(state.time, &state.q, &state.p)
    }

    fn energy<T: Scalar>(&self, time: T, q: &DVector<T>, p: &DVector<T>) -> T {
        let mut energy = T::zero();
        self.energy.run(at(time, q, p), |_, value| energy = value);
        energy
    }
}

fn at<'a, T: Scalar>(time: T, q: &'a DVector<T>, p: &'a DVector<T>) -> At<'a, T> {
    At {
        time,
        q: q.as_slice(),
        p: p.as_slice(),
    }
}

#[inline(always)]
fn fill<T: Scalar>(tape: &Tape, at: At<'_, T>, vector: &mut DVector<T>) {
    let components = vector.as_mut_slice();
    tape.run(at, |k, value| {
        if let Some(component) = components.get_mut(k) {
            *component = value;
        }
    });
}

/// A separable system, `H = T(t, p) + U(t, q)`.
#[derive(Debug, Clone)]
pub(super) struct SeparableFormula(pub(super) Arc<Tapes>);

impl SeparableHamiltonian for SeparableFormula {
    type Vector<T: Scalar> = DVector<T>;

    fn velocity<T: Scalar>(&self, time: T, p: &DVector<T>, velocity: &mut DVector<T>) {
        // The tape of the velocity reads no position.
        fill(&self.0.velocity, at(time, p, p), velocity);
    }

    fn force<T: Scalar>(&self, time: T, q: &DVector<T>, force: &mut DVector<T>) {
        // The tape of the force reads no momentum.
        fill(&self.0.force, at(time, q, q), force);
    }

    fn energy<T: Scalar>(&self, time: T, q: &DVector<T>, p: &DVector<T>) -> Option<T> {
        Some(self.0.energy(time, q, p))
    }
}

/// Any other system.
#[derive(Debug, Clone)]
pub(super) struct GeneralFormula(pub(super) Arc<Tapes>);

impl Hamiltonian for GeneralFormula {
    type Class = General;
    type Vector<T: Scalar> = DVector<T>;

    fn velocity<T: Scalar>(&self, time: T, q: &DVector<T>, p: &DVector<T>, out: &mut DVector<T>) {
        fill(&self.0.velocity, at(time, q, p), out);
    }

    fn force<T: Scalar>(&self, time: T, q: &DVector<T>, p: &DVector<T>, out: &mut DVector<T>) {
        fill(&self.0.force, at(time, q, p), out);
    }

    fn slopes<T: Scalar>(
        &self,
        time: T,
        q: &DVector<T>,
        p: &DVector<T>,
        (velocity, force): (&mut DVector<T>, &mut DVector<T>),
    ) {
        let (velocity, force) = (velocity.as_mut_slice(), force.as_mut_slice());
        let count = velocity.len();
        self.0.slopes.run(at(time, q, p), |k, value| {
            let component = match k.checked_sub(count) {
                None => velocity.get_mut(k),
                Some(k) => force.get_mut(k),
            };
            if let Some(component) = component {
                *component = value;
            }
        });
    }

    fn energy<T: Scalar>(&self, time: T, q: &DVector<T>, p: &DVector<T>) -> Option<T> {
        Some(self.0.energy(time, q, p))
    }
}
