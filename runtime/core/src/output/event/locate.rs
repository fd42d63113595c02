//! Locates the events of a function in a panel.

use super::list::EventList;
use super::search::Search;
use super::track::{Crossing, DEEPEST, Track};
use crate::error::Error;
use crate::integrator::DenseSteps;
use crate::number::{Scalar, Vector};
use crate::output::brent::{before_zero, negative_near_minimum};

/// Halvings of a panel, down to rounding, in the search for the sign of a function that starts on zero.
const HALVINGS: u32 = 60;

/// Distance from the end of a panel at which the slope there is estimated, relative to the panel.
const BESIDE: f64 = 1.0 / 65_536.0;

/// Increment of the difference quotient for the derivative along the flow, relative to the step.
pub(super) const SMALL: f64 = 1.0 / 16_384.0;

impl<E: EventList<S::Vector> + ?Sized, S: DenseSteps> Search<'_, E, S> {
    /// Finds the events of a function in the panel from `start`, and advances its track to the end. `ahead` holds the middle and the end of
    /// the panel.
    pub(super) fn detect(
        &mut self,
        stepper: &mut S,
        index: usize,
        start: f64,
        ahead: [Option<f64>; 2],
    ) -> Result<(), S::Error> {
        let at_start = self.tracks.as_ref()[index];
        let mut track = at_start;
        let mut changed = false;
        let mut from = start;
        for (to, value) in ahead.into_iter().zip(track.ahead) {
            let Some(to) = to else { continue };
            if track.changes(value) {
                changed = true;
                self.push(stepper, index, &mut track, (from, to))?;
            }
            track.go_on(value);
            from = to;
        }
        if let (false, [Some(middle), Some(end)]) = (changed || at_start.side == 0.0, ahead) {
            let places = [start, middle, end];
            self.look_for_two(stepper, index, at_start, &mut track, places)?;
        }
        self.tracks.as_mut()[index] = track;
        Ok(())
    }

    /// Finds two zeros between points with equal signs: on both sides of an extremum with the opposite sign.
    fn look_for_two(
        &mut self,
        stepper: &mut S,
        index: usize,
        at_start: Track,
        track: &mut Track,
        [start, middle, end]: [f64; 3],
    ) -> Result<(), S::Error> {
        let side = at_start.side;
        let first = side * at_start.value;
        let [second, third] = track.ahead.map(|value| side * value);
        let smallest = first.min(second).min(third);
        if smallest >= DEEPEST * (first.max(second).max(third) - smallest) {
            return Ok(());
        }
        let by_steps = self.by_steps;
        let mut value =
            |time| Ok::<_, S::Error>(side * self.value_at(stepper, index, time, by_steps)?);
        // A single extremum lies next to the smallest of the three values.
        let between = if second <= third && second <= first {
            (start, end)
        } else {
            let (near, at_near, far) = if second <= third {
                (start, first, end)
            } else {
                (end, third, start)
            };
            let beside = near + (far - near) * BESIDE;
            if (at_start.on_zero && near == start) || value(beside)? >= at_near {
                return Ok(());
            }
            (near, middle)
        };
        let beyond = negative_near_minimum(between, &mut value)?;
        let Some(beyond) = beyond else { return Ok(()) };
        let mut pair = at_start;
        self.push(stepper, index, &mut pair, (start, beyond))?;
        pair.go_on(-at_start.side);
        self.push(stepper, index, &mut pair, (beyond, end))?;
        track.pending = pair.pending;
        Ok(())
    }

    /// Records the event at a sign change if the change has the requested direction.
    fn push(
        &mut self,
        stepper: &mut S,
        index: usize,
        track: &mut Track,
        between: (f64, f64),
    ) -> Result<(), S::Error> {
        let kind = self.events.kind(index);
        if kind.matches(track.side) {
            let side = track.side;
            let by_steps = kind.by_steps || self.by_steps;
            let found = self.locate(stepper, index, track, between, by_steps)?;
            let time = found.unwrap_or(between.0);
            let unseen = track.stays && {
                self.look_at(stepper, time, by_steps)?;
                self.shown.copy_from(&self.output.state);
                let step = between.1 - between.0;
                time == between.0 || side * self.slope(stepper, index, step) >= 0.0
            };
            track.push(Crossing { time, side, unseen });
        }
        Ok(())
    }

    /// The last time before a sign change; `None` if it is the start of a search on zero.
    fn locate(
        &mut self,
        stepper: &mut S,
        index: usize,
        track: &Track,
        (from, to): (f64, f64),
        by_steps: bool,
    ) -> Result<Option<f64>, S::Error> {
        let mut start = from;
        if track.on_zero {
            match self.departure(stepper, index, track, (from, to), by_steps)? {
                Some(place) => start = place,
                None => return Ok(None),
            }
        }
        let span = stepper.last_span();
        let mut zero = |between, by_steps| {
            before_zero(between, |time| {
                self.value_at(stepper, index, time, by_steps)
            })
        };
        let found = zero((start, to), by_steps)?;
        if found.is_some() || !by_steps {
            return Ok(Some(found.unwrap_or(to)));
        }
        // Steps of the method place a zero close to `start` or `to` just outside the interval.
        let ((first, last), width) = (span.ok_or(Error::NoStep)?, to - from);
        let (low, high) = (first.min(last), first.max(last));
        let wider = (
            (from - width).clamp(low, high),
            (to + width).clamp(low, high),
        );
        let found = zero(wider, true)?;
        if found.is_some() {
            return Ok(found);
        }
        let time = zero((start, to), false)?.unwrap_or(to);
        Ok(zero((first, time), true)?.or(Some(time)))
    }

    /// A time at which a function that starts on zero exceeds its rounding error. The midpoint of the panel is tried first, then a quarter
    /// of it, and so on.
    fn departure(
        &mut self,
        stepper: &mut S,
        index: usize,
        track: &Track,
        (from, to): (f64, f64),
        by_steps: bool,
    ) -> Result<Option<f64>, S::Error> {
        let mut width = to - from;
        for _ in 0..HALVINGS {
            width *= 0.5;
            let place = from + width;
            if place == from {
                break;
            }
            let value = self.value_at(stepper, index, place, by_steps)?;
            if track.side * value > track.rounding {
                return Ok(Some(place));
            }
        }
        Ok(None)
    }

    /// Value of a function at a time inside the last step.
    fn value_at(
        &mut self,
        stepper: &mut S,
        index: usize,
        time: f64,
        by_steps: bool,
    ) -> Result<f64, S::Error> {
        self.look_at(stepper, time, by_steps)?;
        Ok(self.value(index)?)
    }

    /// Sets `output.state` to the state at a time inside the last step.
    pub(super) fn look_at(
        &mut self,
        stepper: &mut S,
        time: f64,
        by_steps: bool,
    ) -> Result<(), S::Error> {
        if by_steps {
            let taken = self.output.look_by_step(stepper, time);
            if taken.is_ok() || self.needs_steps {
                return taken;
            }
        }
        self.output.look_at(stepper, time)
    }

    /// Change of a function along the flow through `self.shown`, over a small part of `step`; 0 if it is unreliable.
    pub(super) fn slope(&mut self, stepper: &mut S, index: usize, step: f64) -> f64 {
        let state = &self.shown;
        let (velocity, force) = self
            .slopes
            .get_or_insert_with(|| (state.q.zeros_like(), state.p.zeros_like()));
        stepper.slopes(state, SMALL * step, velocity, force);
        let [before, after] = [-SMALL * step, SMALL * step].map(|size| {
            self.output.state.time = state.time + size;
            add(&mut self.output.state.q, &state.q, size, velocity);
            add(&mut self.output.state.p, &state.p, size, force);
            self.events.value(index, &self.output.state)
        });
        let change = after - before;
        // Not at an extremum, or where the function is undefined on one side.
        let known = change.abs() > 1e-9 * (after.abs() + before.abs());
        if known { change } else { 0.0 }
    }

    /// Largest change of a function at the present state when the state changes by rounding errors.
    pub(super) fn rounding(&mut self, stepper: &mut S, index: usize, value: f64) -> f64 {
        let changes = (0..4).map(|pattern| {
            self.output.state.copy_from(stepper.state());
            let size = 4.0 * <S::Vector as Vector>::Scalar::EPSILON;
            perturb(&mut self.output.state.q, pattern, size);
            perturb(&mut self.output.state.p, pattern, size);
            (self.events.value(index, &self.output.state) - value).abs()
        });
        changes.fold(0.0, f64::max)
    }
}

/// Multiplies components by 1 ± `size`; `pattern` selects the signs.
fn perturb<V: Vector>(vector: &mut V, pattern: u32, size: f64) {
    for (k, component) in vector.as_mut_slice().iter_mut().enumerate() {
        // Equal signs, alternating signs, and two patterns without a period.
        let k = k as u32;
        let bits = [
            0,
            k,
            k.wrapping_mul(0x9e37_79b9) >> 31,
            k.wrapping_mul(0x85eb_ca6b) >> 30,
        ];
        let odd = bits[pattern as usize % bits.len()] % 2 == 1;
        let size = V::Scalar::from_f64(if odd { -size } else { size });
        *component += *component * size;
    }
}

/// `out = start + size · slope`
fn add<V: Vector>(out: &mut V, start: &V, size: f64, slope: &V) {
    let size = V::Scalar::from_f64(size);
    let terms = start.as_slice().iter().zip(slope.as_slice());
    for (out, (&start, &slope)) in out.as_mut_slice().iter_mut().zip(terms) {
        *out = start + size * slope;
    }
}
