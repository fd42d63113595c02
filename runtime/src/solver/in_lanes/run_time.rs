//! Coupled stages of a tableau that is known only at run time.

use core::marker::PhantomData;

use super::{LaneSweeps, Sums, keep, largest, relax, scale, settle::settle, sum, transform};
use crate::method::run_time::{Coupled, Half, Row, Schedule};
use crate::method::{
    EvaluationCounts, LaneMemory, LaneOutcome, LaneStages, Outcome, Step, Stopping,
};
use crate::number::summation::Overrelaxed;
use crate::number::{Coefficient, Lanes, Summation, Vector, copy};
use crate::solver::run_time::total;
use crate::solver::simd::change::LaneMovement;
use crate::system::{Class, System};

/// Takes a step of the trajectories in the lanes `live`, after a step that has left its stages in `memory`. `None` if stages are not
/// coupled.
pub(crate) fn take_at_run_time<C, R, W, S>(
    step: &Step<'_, W>,
    system: &S,
    memory: &mut LaneMemory<W>,
    live: u32,
    stopping: Stopping,
    Outcome { q, q_low, p, p_low }: Outcome<'_, W>,
) -> Option<LaneOutcome<W::Scalar>>
where
    C: Class,
    R: Summation,
    W: Vector<Scalar: Lanes>,
    S: System<W, Class = C>,
{
    let LaneMemory {
        before,
        now,
        settled,
        scales,
        tableau,
    } = memory;
    let schedule = tableau.as_ref().map(|tableau| tableau.schedule::<C>());
    let Some(Schedule::Coupled(coupled)) = schedule else {
        return None;
    };
    let mut sweeps = ByRows::<R, W, S> {
        step,
        system,
        coupled,
        before,
        now,
        settled,
        sums: PhantomData,
    };
    let found = settle::<C, _, _>(&mut sweeps, step.time, live, *scales, stopping);
    let Coupled { positions, momenta } = coupled;
    let base = (step.q, step.q_low);
    total::<R, W>((q, q_low), base, momenta, &settled.velocity);
    let base = (step.p, step.p_low);
    total::<R, W>((p, p_low), base, positions, &settled.force);
    let is_sound = !now.mismatch(step.q.dimension());
    Some(LaneOutcome {
        settled: if is_sound { found.lanes } else { 0 },
        sweeps: found.sweeps,
        scales: found.scales,
        counts: EvaluationCounts {
            begin: u32::from(momenta.extrapolation.is_empty()),
            start: 0,
            sweep: (positions.evaluations.len() + momenta.evaluations.len()) as u32,
            finish: 0,
            carried: 0,
        },
    })
}

/// The stages of a step. Velocities and forces are stored as increments.
struct ByRows<'a, R, W, S> {
    step: &'a Step<'a, W>,
    system: &'a S,
    coupled: &'a Coupled,
    before: &'a LaneStages<W>,
    now: &'a mut LaneStages<W>,
    settled: &'a mut LaneStages<W>,
    sums: PhantomData<R>,
}

/// The sums of a half.
#[inline(always)]
fn sums<R: Summation>(
    rows: &[Row],
) -> Sums<impl Fn(usize) -> usize, impl Fn(usize, usize) -> (usize, f64)> {
    Sums {
        count: |stage: usize| rows[stage].len(),
        term: |stage: usize, j: usize| rows[stage][j],
        with_low: R::COMPENSATED,
    }
}

impl<R, W, S> ByRows<'_, R, W, S>
where
    R: Summation,
    W: Vector<Scalar: Lanes>,
    S: System<W>,
{
    #[inline(always)]
    fn positions<T: Summation>(&mut self) -> W::Scalar {
        let base = (self.step.q, self.step.q_low);
        let sums = sums::<T>(&self.coupled.positions.rows);
        relax::<T, W>(&sums, &mut self.now.q, base, &self.now.velocity, sum)
    }

    #[inline(always)]
    fn momenta<T: Summation>(&mut self) -> W::Scalar {
        let base = (self.step.p, self.step.p_low);
        let sums = sums::<T>(&self.coupled.momenta.rows);
        relax::<T, W>(&sums, &mut self.now.p, base, &self.now.force, sum)
    }

    #[inline(always)]
    fn sweep_by<T: Summation>(&mut self) -> LaneMovement<W::Scalar> {
        let (step, system) = (self.step, self.system);
        let Coupled { positions, momenta } = self.coupled;
        let LaneStages { q, p, force, .. } = &mut *self.now;
        for (i, (force, evaluation)) in force.iter_mut().zip(&positions.evaluations).enumerate() {
            let p = p.get(i).unwrap_or(step.p);
            let time = step.at(Coefficient::exact(evaluation.time));
            system.force(time, &q[i], p, force);
            scale(force, step.size * evaluation.factor);
        }
        let change = self.momenta::<T>();
        let LaneStages { q, p, velocity, .. } = &mut *self.now;
        for (i, (velocity, evaluation)) in velocity.iter_mut().zip(&momenta.evaluations).enumerate()
        {
            let q = q.get(i).unwrap_or(step.q);
            let time = step.at(Coefficient::exact(evaluation.time));
            system.velocity(time, q, &p[i], velocity);
            scale(velocity, step.size * evaluation.factor);
        }
        LaneMovement {
            q: self.positions::<T>(),
            p: change,
        }
    }
}

/// Extrapolates the increments of a half from those of the previous step.
fn extrapolate<W: Vector>(half: &Half, out: &mut [W], before: &[W]) {
    transform(out, before, |i, j| half.extrapolation[i][j]);
}

impl<R, W, S> LaneSweeps<W::Scalar> for ByRows<'_, R, W, S>
where
    R: Summation,
    W: Vector<Scalar: Lanes>,
    S: System<W>,
{
    const STOPS_AT_ROUNDING: bool = !R::COMPENSATED;

    fn begin(&mut self) {
        let Coupled { positions, momenta } = self.coupled;
        let step = self.step;
        if !momenta.extrapolation.is_empty() {
            extrapolate(momenta, &mut self.now.velocity, &self.before.velocity);
        } else if let [first, others @ ..] = &mut *self.now.velocity {
            let time = step.at(Coefficient::exact(momenta.evaluations[0].time));
            self.system.velocity(time, step.q, step.p, first);
            others.iter_mut().for_each(|other| copy(other, first));
            for (velocity, evaluation) in self.now.velocity.iter_mut().zip(&momenta.evaluations) {
                scale(velocity, step.size * evaluation.factor);
            }
        }
        self.positions::<R>();
        if positions.extrapolation.is_empty() {
            self.now.p.iter_mut().for_each(|p| copy(p, step.p));
        } else {
            extrapolate(positions, &mut self.now.force, &self.before.force);
            self.momenta::<R>();
        }
    }

    #[inline(always)]
    fn sweep(&mut self) -> LaneMovement<W::Scalar> {
        self.sweep_by::<R>()
    }

    fn overrelaxed_sweep(&mut self) -> LaneMovement<W::Scalar> {
        self.sweep_by::<Overrelaxed<R>>()
    }

    fn scales(&self) -> [W::Scalar; 2] {
        [
            largest(self.step.q, &self.now.q),
            largest(self.step.p, &self.now.p),
        ]
    }

    fn keep(&mut self, lanes: u32) {
        keep(lanes, self.now, self.settled);
    }
}
