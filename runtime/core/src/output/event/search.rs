//! The search for events, step by step.

use core::ops::ControlFlow;

use super::Moment;
use super::list::EventList;
use super::track::{Crossing, Track, sign};
use crate::error::Error;
use crate::integrator::DenseSteps;
use crate::integrator::last_step::LastEvent;
use crate::output::at_times::Output;

/// Largest number of events in a row that follow each other within [`SHORTEST`].
const MAX_IN_A_ROW: u32 = 1000;

/// A flight shorter than this, relative to the step, does not end a row of events.
const SHORTEST: f64 = 1.0 / 16_384.0;

/// Number of sample points in a step, unless an event sets another one.
const SAMPLES: u32 = 8;

/// A step whose stages converge in more sweeps than this may contain a whole oscillation.
const FEW_SWEEPS: u64 = 8;

/// Point `number` of `count` points in a step.
pub(super) fn place((start, end): (f64, f64), number: u32, count: u32) -> f64 {
    if number == count {
        end
    } else {
        start + (end - start) * (f64::from(number) / f64::from(count))
    }
}

/// A search for the events of a list.
pub(super) struct Search<'e, E: EventList<S::Vector> + ?Sized, S: DenseSteps> {
    pub(super) events: &'e E,
    pub(super) tracks: E::Tracks,
    /// Remaining output times.
    pub(super) times: &'e [f64],
    /// Number of sample points in a step that is sampled.
    pub(super) samples: u32,
    /// Whether every step is sampled.
    pub(super) samples_all: bool,
    /// Whether the last step is examined by steps of the method.
    pub(super) by_steps: bool,
    /// Whether an event is located by steps of the method in any case.
    pub(super) needs_steps: bool,
    /// Number of sweeps up to the last step that was seen.
    iterations: u64,
    /// Whether the last step took few sweeps.
    pub(super) resolved: bool,
    /// The state under examination.
    pub(super) output: Output<S>,
    pub(super) slopes: Option<(S::Vector, S::Vector)>,
    /// The state passed to the handler at an event, and as the handler changed it.
    pub(super) shown: S::State,
    pub(super) last: Option<LastEvent>,
}

/// Why a search does not continue with the next step.
pub(super) enum Stop<B, E> {
    /// The search restarts from the state that the handler received.
    Reset,
    /// The handler broke the search; the flag says whether the state that it received becomes the present state.
    Broken(B, bool),
    Failed(E),
}

type Seen<B, E> = ControlFlow<Stop<B, E>>;

impl<'e, E: EventList<S::Vector> + ?Sized, S: DenseSteps> Search<'e, E, S> {
    /// A search from the present state of the stepper, after the event `last`; `direction` has the sign of the step size.
    pub(super) fn new(
        events: &'e E,
        times: &'e [f64],
        stepper: &S,
        last: Option<LastEvent>,
        direction: f64,
    ) -> Self {
        let mut tracks = events.tracks();
        let count = tracks.as_ref().len();
        let start = stepper.state();
        let last = last.filter(|last| last.time == start.time);
        if let Some(last) = last
            && let Some(track) = tracks.as_mut().get_mut(last.index)
        {
            track.fired = last.side;
        }
        Self {
            events,
            tracks,
            times,
            samples: (0..count)
                .map(|k| events.kind(k).samples.unwrap_or(SAMPLES))
                .max()
                .unwrap_or(1),
            samples_all: (0..count).any(|k| events.kind(k).samples.is_some()),
            by_steps: false,
            needs_steps: (0..count).any(|k| events.kind(k).by_steps),
            iterations: stepper.statistics().iterations,
            resolved: false,
            output: Output::new(stepper, direction),
            slopes: None,
            shown: start.clone(),
            last,
        }
    }

    /// Starts at the present state of the stepper; `step` is the approximate size of the next step.
    pub(super) fn start(&mut self, stepper: &mut S, step: f64) -> Result<(), S::Error> {
        self.shown.copy_from(stepper.state());
        for index in 0..self.tracks.as_ref().len() {
            self.output.state.copy_from(stepper.state());
            let value = self.value(index)?;
            let track = self.start_of(stepper, index, value, step);
            self.tracks.as_mut()[index] = track;
        }
        Ok(())
    }

    /// Track of a function at the start, where its value is `value`.
    fn start_of(&mut self, stepper: &mut S, index: usize, value: f64, step: f64) -> Track {
        let fired = self.tracks.as_ref()[index].fired;
        let mut track = Track {
            side: sign(value),
            value,
            change: f64::INFINITY,
            ..Track::default()
        };
        let wall = self.events.kind(index).wall;
        if wall {
            track.side = 1.0;
        }
        if fired != 0.0 {
            track.rounding = self.rounding(stepper, index, value);
        } else if value * track.side > 0.0 {
            return track;
        }
        let slope = self.slope(stepper, index, step);
        let near = value.abs() <= track.rounding.max(slope.abs());
        if !wall && near {
            track.side = if slope == 0.0 { fired } else { sign(slope) };
        }
        track.on_zero = track.side != 0.0 && track.side * value <= track.rounding;
        track.stays = near && track.side != 0.0 && track.side * slope >= 0.0;
        track
    }

    /// Whether the step to `state` has no output and, for certain, no event. `iterations` is the number of sweeps so far.
    #[inline]
    pub(super) fn passes(&mut self, state: &S::State, iterations: u64) -> bool {
        let sweeps = iterations.checked_sub(self.iterations);
        self.resolved = sweeps.is_some_and(|sweeps| sweeps <= FEW_SWEEPS);
        self.iterations = iterations;
        let output = self.times.first();
        if output.is_some_and(|&time| !self.output.is_after(time, state.time)) {
            return false;
        }
        let all = self.tracks.as_mut();
        if !all.is_empty() && (self.samples_all || !self.resolved) {
            return false;
        }
        for (index, track) in all.iter_mut().enumerate() {
            track.ahead[1] = self.events.value(index, state);
            if !track.passes(track.ahead[1]) {
                return false;
            }
        }
        for track in all {
            track.begin_step();
            track.go_on(track.ahead[1]);
            track.end_step();
        }
        self.last = None;
        true
    }

    /// Passes the output and the events in the last step to the handler.
    pub(super) fn step<B>(
        &mut self,
        stepper: &mut S,
        handle: &mut impl FnMut(Moment<'_, S::Vector>) -> ControlFlow<B>,
    ) -> Result<Seen<B, S::Error>, S::Error> {
        let (start, end) = stepper.last_span().ok_or(Error::NoStep)?;
        self.output.evaluated = false;
        self.by_steps = self.is_open(stepper, (start, end))?;
        // Otherwise the sign changes at most once, as at the ends.
        let (panels, halves) = match self.by_steps {
            true => (self.samples.div_ceil(2), 2),
            false => (1, 1),
        };
        for track in self.tracks.as_mut() {
            track.begin_step();
        }
        for panel in 0..panels {
            let point = |number| place((start, end), number, panels * halves);
            let from = point(panel * halves);
            let middle = (halves == 2).then(|| point(panel * halves + 1));
            let to = point((panel + 1) * halves);
            if let Some(middle) = middle {
                self.look_at(stepper, middle, self.by_steps)?;
                self.look_ahead(0)?;
            }
            self.look_at_point(stepper, to, self.by_steps)?;
            self.look_ahead(1)?;
            for index in 0..self.tracks.as_ref().len() {
                let (mut from, mut until) = (from, to);
                if !self.by_steps {
                    let [before, after, points] = self.tracks.as_mut()[index].go_to_change();
                    from = place((start, end), before, points);
                    until = place((start, end), after, points);
                }
                self.detect(stepper, index, from, [middle, Some(until)])?;
            }
            let seen = self.show(stepper, to, handle)?;
            if seen.is_break() {
                return Ok(seen);
            }
        }
        for track in self.tracks.as_mut() {
            track.end_step();
        }
        // An event before the end of the step is no longer the start of another search.
        self.last = self.last.filter(|last| last.time == end);
        Ok(ControlFlow::Continue(()))
    }

    /// [`look_at`](Self::look_at), or the present state at the end of the step.
    pub(super) fn look_at_point(
        &mut self,
        stepper: &mut S,
        time: f64,
        by_steps: bool,
    ) -> Result<(), S::Error> {
        if time == stepper.time() {
            self.output.state.copy_from(stepper.state());
            return Ok(());
        }
        self.look_at(stepper, time, by_steps)
    }

    /// Ends the search with an error. The state returns to the start of the last step, because its end may lie behind a
    /// wall that was not found.
    pub(super) fn fail<B>(&mut self, stepper: &mut S, error: S::Error) -> Seen<B, S::Error> {
        stepper.write_start(&mut self.shown);
        ControlFlow::Break(Stop::Failed(error))
    }

    /// Passes output and events up to a time to the handler.
    fn show<B>(
        &mut self,
        stepper: &mut S,
        end: f64,
        handle: &mut impl FnMut(Moment<'_, S::Vector>) -> ControlFlow<B>,
    ) -> Result<Seen<B, S::Error>, S::Error> {
        loop {
            let next = self.next();
            let until = next.map_or(end, |(_, next)| next.time);
            let shown = self.show_output(stepper, until, handle)?;
            let Some((index, Crossing { time, .. })) = next else {
                return Ok(shown);
            };
            if shown.is_break() {
                return Ok(shown);
            }
            let by_steps = self.events.kind(index).by_steps || self.by_steps;
            self.look_at(stepper, time, by_steps)?;
            self.shown.copy_from(&self.output.state);
            let step = stepper.last_span().map_or(0.0, |(start, end)| end - start);
            let shown = self.show_events((time, step), handle);
            if shown.is_break() {
                return Ok(shown);
            }
        }
    }

    /// The next event in the panel; of simultaneous events the first in the list.
    fn next(&self) -> Option<(usize, Crossing)> {
        let tracks = self.tracks.as_ref().iter().enumerate();
        let firsts = tracks.filter_map(|(index, track)| Some((index, track.pending[0]?)));
        firsts.reduce(|first, other| {
            if self.output.is_after(first.1.time, other.1.time) {
                other
            } else {
                first
            }
        })
    }

    /// Passes all events at a time to the handler; `self.shown` is the state at this time, in a step of this size.
    fn show_events<B>(
        &mut self,
        (time, step): (f64, f64),
        handle: &mut impl FnMut(Moment<'_, S::Vector>) -> ControlFlow<B>,
    ) -> Seen<B, S::Error> {
        let mut reset = false;
        while let Some((index, next)) = self.next()
            && next.time == time
        {
            let near = |last: &LastEvent| (time - last.time).abs() <= SHORTEST * step.abs();
            let count = self.last.filter(near).map_or(0, |last| last.count);
            if next.unseen || count == MAX_IN_A_ROW {
                let value = self.events.value(index, &self.shown);
                let failed = match self.events.kind(index).wall && value < 0.0 {
                    true => Error::BehindWall { time, index, value },
                    false => Error::EventsAccumulate { time, index, count },
                };
                return ControlFlow::Break(Stop::Failed(failed.into()));
            }
            let track = &mut self.tracks.as_mut()[index];
            track.pop();
            track.fired = next.side;
            self.last = Some(LastEvent {
                time,
                index,
                side: next.side,
                count: count + 1,
            });
            let state = &mut self.shown;
            let handled = handle(Moment::Event { index, state });
            self.shown.time = time;
            reset |= self.events.kind(index).wall || self.shown != self.output.state;
            if let ControlFlow::Break(value) = handled {
                return ControlFlow::Break(Stop::Broken(value, reset));
            }
        }
        if reset {
            return ControlFlow::Break(Stop::Reset);
        }
        // The search continues through the events, which end a row.
        self.last = self.last.map(|last| LastEvent { count: 0, ..last });
        for track in self.tracks.as_mut() {
            track.fired = 0.0;
        }
        ControlFlow::Continue(())
    }

    /// Passes the states at the output times up to `until` to the handler; `until` is not after the present time.
    pub(super) fn show_output<B>(
        &mut self,
        stepper: &mut S,
        until: f64,
        handle: &mut impl FnMut(Moment<'_, S::Vector>) -> ControlFlow<B>,
    ) -> Result<Seen<B, S::Error>, S::Error> {
        while let Some((&time, rest)) = self.times.split_first()
            && !self.output.is_after(time, until)
        {
            let present = stepper.state();
            let handled = if time == present.time {
                handle(Moment::Output(present))
            } else {
                self.output.look_for_output(stepper, time)?;
                handle(Moment::Output(&self.output.state))
            };
            self.times = rest;
            if let ControlFlow::Break(value) = handled {
                return Ok(ControlFlow::Break(Stop::Broken(value, false)));
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Stores the values at `self.output.state`, the middle (0) or the end (1) of the panel.
    fn look_ahead(&mut self, place: usize) -> Result<(), S::Error> {
        for index in 0..self.tracks.as_ref().len() {
            self.tracks.as_mut()[index].ahead[place] = self.value(index)?;
        }
        Ok(())
    }

    /// Value of a function at `self.output.state`.
    pub(super) fn value(&self, index: usize) -> Result<f64, Error> {
        let value = self.events.value(index, &self.output.state);
        if value.is_nan() {
            let time = self.output.state.time;
            return Err(Error::EventValue { time });
        }
        Ok(value)
    }
}
