//! Steps beside a run, by which its last step is followed.

use super::stepper::advance_in_time;
use super::{DenseSteps, Stepper};
use crate::error::Error;
use crate::number::{Scalar, Vector};
use crate::state::State;

/// A stepper that can take a step from another state beside its run. It implements [`DenseSteps`]: a state inside the last step is that of a
/// shorter step from its start. This has the order of the method, while a cubic through both ends has order 3 and needs q' and p', which a
/// discrete Lagrangian does not give. For the start of a search, q' and p' are difference quotients of a short step.
pub trait StepsBeside: Stepper<State = State<Self::Vector>> {
    /// The vectors of a state.
    type Vector: Vector;

    /// Everything that a step changes.
    type Moving;

    /// A copy of what a step changes.
    fn moving(&self) -> Self::Moving;

    /// Exchanges what a step changes.
    fn exchange(&mut self, moving: &mut Self::Moving);

    /// Sets the start and the size of a step, after an [exchange](Self::exchange). `run` is what moves in the run, for starting values.
    fn begin_beside(&mut self, run: &Self::Moving, state: &State<Self::Vector>, size: f64);

    /// The state at the start of the last step and the size of that step; `None` before the first step, and after a new state or a failed
    /// step.
    fn last_step(&self) -> Option<(&State<Self::Vector>, f64)>;
}

/// Takes a step from `state` and writes its end there.
fn step_beside<S: StepsBeside>(
    stepper: &mut S,
    (size, end): (f64, f64),
    moving: &mut S::Moving,
    state: &mut State<S::Vector>,
) -> Result<(), S::Error> {
    let beside = Beside::new(stepper, moving);
    let stepper = &mut *beside.stepper;
    stepper.begin_beside(beside.moving, state, size);
    advance_in_time(stepper, size, end)?;
    state.copy_from(stepper.state());
    state.time = end;
    Ok(())
}

/// A stepper beside its run. It returns to the run when this is dropped, also if the system panics.
struct Beside<'a, S: StepsBeside> {
    stepper: &'a mut S,
    moving: &'a mut S::Moving,
}

impl<'a, S: StepsBeside> Beside<'a, S> {
    fn new(stepper: &'a mut S, moving: &'a mut S::Moving) -> Self {
        stepper.exchange(moving);
        Self { stepper, moving }
    }
}

impl<S: StepsBeside> Drop for Beside<'_, S> {
    fn drop(&mut self) {
        self.stepper.exchange(self.moving);
    }
}

impl<S: StepsBeside> DenseSteps for S {
    type Vector = <S as StepsBeside>::Vector;
    type Scratch = S::Moving;

    fn scratch(&self) -> S::Moving {
        self.moving()
    }

    fn last_span(&self) -> Option<(f64, f64)> {
        let (start, _) = self.last_step()?;
        Some((start.time, self.time()))
    }

    fn write_start(&self, out: &mut State<<S as StepsBeside>::Vector>) {
        let start = self.last_step().map(|(start, _)| start);
        out.copy_from(start.unwrap_or_else(|| self.state()));
    }

    fn look(
        &mut self,
        time: f64,
        moving: &mut S::Moving,
        out: &mut State<<S as StepsBeside>::Vector>,
    ) -> Result<(), S::Error> {
        let (from, size) = self.last_step().ok_or(Error::NoStep)?;
        let (start, end) = (from.time, self.time());
        if time == end {
            out.copy_from(self.state());
            return Ok(());
        }
        if !(start.min(end) <= time && time <= start.max(end)) {
            return Err(Error::OutsideStep { time, start, end }.into());
        }
        out.copy_from(from);
        if time == start {
            return Ok(());
        }
        let size = size * ((time - start) / (end - start));
        step_beside(self, (size, time), moving, out)
    }

    /// 0 if the short step fails.
    fn slopes(
        &mut self,
        state: &State<<S as StepsBeside>::Vector>,
        size: f64,
        velocity: &mut <S as StepsBeside>::Vector,
        force: &mut <S as StepsBeside>::Vector,
    ) {
        let (mut moving, mut end) = (self.moving(), state.clone());
        let taken = step_beside(self, (size, state.time + size), &mut moving, &mut end);
        let quotient = if taken.is_ok() { 1.0 / size } else { 0.0 };
        let quotient = <<S as StepsBeside>::Vector as Vector>::Scalar::from_f64(quotient);
        for (slope, end, start) in [(velocity, &end.q, &state.q), (force, &end.p, &state.p)] {
            let ends = end.as_slice().iter().zip(start.as_slice());
            let pairs = slope.as_mut_slice().iter_mut().zip(ends);
            pairs.for_each(|(slope, (&end, &start))| *slope = (end - start) * quotient);
        }
    }
}
