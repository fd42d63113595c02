//! The extended phase space: time is a position, and its momentum is minus the energy.

use alloc::vec::Vec;

use num_traits::Zero;

use crate::Error;
use symplectic_core::inside::{check_start, check_state};
use symplectic_core::{Hamiltonian, Scalar, State, Vector};
use symplectic_linearisation::HyperDual;

/// The extended state ((q, t), (p, p_t)) at τ = 0; its vectors have one component more.
pub(super) fn extended<V, W>(state: &State<V>, momentum: f64) -> Result<State<W>, Error>
where
    V: Vector<Scalar = f64>,
    W: Vector<Scalar = f64>,
{
    let vector = |components: &V, last: f64| {
        let components = components.as_slice().iter().copied().chain([last]);
        W::from_slice(&components.collect::<Vec<f64>>())
    };
    let q = vector(&state.q, state.time)?;
    Ok(State::new(0.0, q, vector(&state.p, momentum)?))
}

/// The state (q, p) at time t of an extended state.
pub(super) fn reduced<V, W>(state: &State<W>) -> Result<State<V>, Error>
where
    V: Vector<Scalar = f64>,
    W: Vector<Scalar = f64>,
{
    let State { time, q, p } = state;
    check_state(*time, q, p, q.dimension())?;
    let ((q, time), (p, _)) = (parted(q), parted(p));
    Ok(State::new(time, V::from_slice(q)?, V::from_slice(p)?))
}

/// All components except the last, and the last component.
pub(super) fn parted<W: Vector<Scalar = f64>>(vector: &W) -> (&[f64], f64) {
    let components = vector.as_slice();
    match components.split_last() {
        Some((&last, rest)) => (rest, last),
        None => (components, f64::NAN),
    }
}

/// [`parted`], mutable.
pub(super) fn parted_mut<W: Vector<Scalar = f64>>(
    vector: &mut W,
) -> Option<(&mut [f64], &mut f64)> {
    let (last, rest) = vector.as_mut_slice().split_last_mut()?;
    Some((rest, last))
}

/// Work vectors for evaluations of a system.
pub(super) struct Workspace<S: Hamiltonian> {
    pub(super) q: S::Vector<f64>,
    pub(super) p: S::Vector<f64>,
    /// The velocity or the force.
    pub(super) slope: S::Vector<f64>,
    dual_q: S::Vector<HyperDual>,
    dual_p: S::Vector<HyperDual>,
}

impl<S: Hamiltonian> Workspace<S> {
    pub(super) fn new(dimension: usize) -> Result<Self, Error> {
        let zeros = alloc::vec![0.0; dimension];
        let duals = alloc::vec![HyperDual::zero(); dimension];
        let vector = || S::Vector::from_slice(&zeros);
        Ok(Self {
            q: vector()?,
            p: vector()?,
            slope: vector()?,
            dual_q: S::Vector::from_slice(&duals)?,
            dual_p: S::Vector::from_slice(&duals)?,
        })
    }

    pub(super) fn set_q(&mut self, q: &[f64]) {
        self.q.as_mut_slice().copy_from_slice(q);
    }

    pub(super) fn set_p(&mut self, p: &[f64]) {
        self.p.as_mut_slice().copy_from_slice(p);
    }

    /// H at (time, q, p), with ∂H/∂t as its first derivative; NaN if the system gives no energy.
    pub(super) fn energy(&mut self, system: &S, time: f64) -> HyperDual {
        let copies = [(&mut self.dual_q, &self.q), (&mut self.dual_p, &self.p)];
        for (duals, values) in copies {
            let pairs = duals.as_mut_slice().iter_mut().zip(values.as_slice());
            pairs.for_each(|(dual, &value)| *dual = HyperDual::from_f64(value));
        }
        let time = HyperDual::new(time, 1.0, 0.0);
        let energy = system.energy(time, &self.dual_q, &self.dual_p);
        energy.unwrap_or_else(|| HyperDual::from_f64(f64::NAN))
    }
}

/// The energy of a state. An error if the state is not finite, or the system has constraints, friction or no energy.
pub(super) fn energy_of<S: Hamiltonian>(
    system: &S,
    state: &State<S::Vector<f64>>,
) -> Result<f64, Error> {
    let State { time, q, p } = state;
    check_start(system, state)?;
    Hamiltonian::energy(system, *time, q, p).ok_or(Error::Core(symplectic_core::Error::NoEnergy))
}
