//! Second-order systems: coupled stages without the momenta.

use core::marker::PhantomData;

use crate::fixed_point::{Sweeps, settle};
use crate::in_lanes::{ByLanes, LaneStages, Sums, entry, extrapolate, fill, lanes, total, values};
use crate::kernel::add;
use crate::{
    Change, Class, Error, EvaluationCounts, Failure, Hamiltonian, HamiltonianInLanes, InLanes,
    Inside, Kept, Outcome, PartChange, Quantity, Scalar, SecondOrderTableau, Solver, StageTableau,
    Step, Summation, Vector, Work,
};

/// [`InLanes`] for second-order systems `q'' = f(q)`, whose velocity is the momentum: only the positions are iterated, with
/// the coefficients of a [`SecondOrderTableau`]. Made by
/// [`Integrator::in_second_order_lanes`](crate::Integrator::in_second_order_lanes).
///
/// Methods that have no such coefficients, and systems that are not separable, are taken as by [`InLanes`].
#[derive(Clone, Copy, Debug)]
pub struct SecondOrderInLanes(());

impl SecondOrderInLanes {
    /// The solver, if the velocity of `system` is the momentum at two points: `p`, and one with other components.
    ///
    /// # Errors
    ///
    /// [`Error::NotSecondOrder`]
    pub(crate) fn new<V, S>(system: &S, time: f64, q: &V, p: &V) -> Result<Self, Error>
    where
        V: Vector<Scalar = f64>,
        S: Hamiltonian<V>,
    {
        let mut point = p.clone();
        let mut velocity = p.zeros_like();
        for shift in [0.0, 0.75] {
            for (k, component) in point.as_mut_slice().iter_mut().enumerate() {
                *component += shift * (k + 1) as f64;
            }
            system.velocity(time, q, &point, &mut velocity);
            let pairs = velocity.as_slice().iter().zip(point.as_slice());
            for (component, (&velocity, &momentum)) in pairs.enumerate() {
                if velocity != momentum {
                    return Err(Error::NotSecondOrder {
                        component,
                        velocity,
                        momentum,
                    });
                }
            }
        }
        Ok(Self(()))
    }
}

impl<V, S> Solver<V, S> for SecondOrderInLanes
where
    V: Vector<Scalar = f64>,
    S: HamiltonianInLanes<V>,
{
    type Memory<P: StageTableau> = LaneStages<V, P>;

    #[inline]
    fn take<P, R>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut LaneStages<V, P>,
        kept: Kept,
        max_iterations: u32,
        outcome: Outcome<'_, V>,
    ) -> Result<Work, Failure>
    where
        P: StageTableau,
        R: Summation,
        S: Hamiltonian<V, Class = P::Class>,
    {
        let (Some(tableau), true) = (P::SECOND_ORDER, P::Class::SEPARABLE) else {
            return <InLanes as Solver<V, S>>::take::<P, R>(
                step,
                system,
                stages,
                kept,
                max_iterations,
                outcome,
            );
        };
        let mut sweeps = Positions::<P, R, V, S> {
            lanes: ByLanes {
                step,
                system,
                stages: &mut *stages,
                sums: PhantomData,
            },
            tableau,
        };
        let work = settle::<P::Class, f64>(&mut sweeps, kept, max_iterations)?;
        // The momenta of the stages, for who asks about the inside of the step.
        sweeps.lanes.momenta();
        sweeps.lanes.velocities();
        let Outcome { q, q_low, p, p_low } = outcome;
        total::<R, P, V>(
            (p, p_low),
            (step.p, step.p_low),
            &stages.force,
            &P::POSITIONS,
            step.size,
        );
        let h = step.size;
        for k in 0..step.q.dimension().min(step.p.dimension()) {
            let (base, low) = (step.q.as_slice()[k], step.q_low.as_slice()[k]);
            let (momentum, momentum_low) = (step.p.as_slice()[k], step.p_low.as_slice()[k]);
            let low = low + h * momentum_low;
            let term = |number: usize| match number.checked_sub(1) {
                None => h * momentum,
                Some(stage) => h * (tableau.rest[stage] * entry::<P, V>(&stages.force, stage, k)),
            };
            let (high, rest) = add::<R, f64>(base, low, P::POSITIONS.count + 1, term);
            q.as_mut_slice()[k] = high;
            if R::COMPENSATED {
                q_low.as_mut_slice()[k] = rest;
            }
        }
        Ok(work)
    }

    fn extend<P: StageTableau>(stages: &LaneStages<V, P>, at: Inside, q: &mut V, p: &mut V) {
        <InLanes as Solver<V, S>>::extend::<P>(stages, at, q, p);
    }
}

/// The positions of the stages alone.
struct Positions<'a, P: StageTableau, R, V: Vector, S> {
    lanes: ByLanes<'a, P, R, V, S>,
    tableau: SecondOrderTableau,
}

impl<P, R, V, S> Positions<'_, P, R, V, S>
where
    P: StageTableau,
    R: Summation,
    V: Vector<Scalar = f64>,
    S: HamiltonianInLanes<V>,
{
    /// New positions; returns how much they changed.
    #[inline(always)]
    fn positions(&mut self) -> PartChange {
        let (step, stages) = (self.lanes.step, &mut *self.lanes.stages);
        let tableau = self.tableau;
        let sums = Sums {
            columns: tableau.columns,
            factor: None,
        };
        let h = P::Lanes::from_f64(step.size);
        let momentum = step.p.as_slice();
        let increment = |(group, k): (usize, usize), sum: P::Lanes| {
            let node: P::Lanes = lanes(tableau.nodes, group);
            h * (node * P::Lanes::from_f64(momentum[k]) + sum)
        };
        let base = (step.q, step.q_low);
        values::<P, R, V>(&sums, &mut stages.q, base, &stages.force, increment)
    }
}

impl<P, R, V, S> Sweeps for Positions<'_, P, R, V, S>
where
    P: StageTableau,
    R: Summation,
    V: Vector<Scalar = f64>,
    S: HamiltonianInLanes<V>,
{
    const HASTY: bool = !R::COMPENSATED;

    #[inline(always)]
    fn evaluations(&self) -> EvaluationCounts {
        EvaluationCounts {
            begin: 0,
            start: 0,
            sweep: P::POSITIONS.count as u32,
            finish: 0,
            carried: 0,
        }
    }

    #[inline(always)]
    fn begin(&mut self, kept: Kept) {
        if kept.stages && !P::POSITIONS.extrapolation.is_empty() {
            extrapolate::<P, V>(&P::POSITIONS, &mut self.lanes.stages.force);
        } else {
            for group in self.lanes.stages.force.as_mut() {
                group.as_mut_slice().fill(P::Lanes::from_f64(0.0));
            }
            fill::<P, V>(&mut self.lanes.stages.p, self.lanes.step.p);
        }
        self.positions();
    }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        self.lanes.non_finite()
    }

    fn non_finite_force(&self) -> Option<usize> {
        self.lanes.non_finite_force()
    }

    #[inline(always)]
    fn sweep(&mut self) -> Change {
        self.lanes.forces();
        let q = self.positions();
        // Both halves are this one.
        Change { q, p: q }
    }
}
