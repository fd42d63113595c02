//! Where in a panel the events of a function are.

use super::list::EventList;
use super::search::{Search, copy_state};
use super::track::{Crossing, Track};
use crate::error::Error;
use crate::integrator::Integrator;
use crate::integrator::partial_step::PartialSteps;
use crate::method::{Method, Solver};
use crate::number::{Scalar, Summation, Vector};
use crate::output::brent::{before_zero, negative_near_minimum};
use crate::system::System;

/// Halvings of a panel in which the side to which a function leaves zero is looked for: down to rounding.
const HALVINGS: u32 = 60;

/// How far beside the end of a panel its slope is looked at, as a part of the panel.
const BESIDE: f64 = 1.0 / 65_536.0;

/// How far an extremum is from the values in a panel, at most, in units of their largest difference.
const DEEPEST: f64 = 4.0;

/// The part of a step over which a derivative along the flow is taken.
const SMALL: f64 = 1.0 / 16_384.0;

impl<E, M, S, V, N> Search<'_, E, M, S, V, N>
where
    E: EventList<V> + ?Sized,
    M: Method,
    S: System<V>,
    V: Vector,
    N: Solver<V, S>,
{
    /// Finds the events of a function in the panel with the start `start`, the middle and the end `ahead`, and goes on to its
    /// end.
    pub(super) fn detect<R: Summation>(
        &mut self,
        integrator: &Integrator<M, S, V, R, N>,
        index: usize,
        start: f64,
        ahead: [Option<f64>; 2],
    ) -> Result<(), Error> {
        let at_start = self.tracks.as_ref()[index];
        let mut track = at_start;
        let mut changed = false;
        let mut from = start;
        for (to, value) in ahead.into_iter().zip(track.ahead) {
            let Some(to) = to else { continue };
            if track.changes(value) {
                changed = true;
                self.push(integrator, index, &mut track, (from, to))?;
            }
            track.go_on(value);
            from = to;
        }
        if let (false, [Some(middle), Some(end)]) = (changed || at_start.side == 0.0, ahead) {
            let places = [start, middle, end];
            self.look_for_two(integrator, index, at_start, &mut track, places)?;
        }
        self.tracks.as_mut()[index] = track;
        Ok(())
    }

    /// Finds two zeros between places at which the sign is the same: on both sides of an extremum beyond zero.
    fn look_for_two<R: Summation>(
        &mut self,
        integrator: &Integrator<M, S, V, R, N>,
        index: usize,
        at_start: Track,
        track: &mut Track,
        [start, middle, end]: [f64; 3],
    ) -> Result<(), Error> {
        let side = at_start.side;
        let first = side * at_start.value;
        let [second, third] = track.ahead.map(|value| side * value);
        let smallest = first.min(second).min(third);
        if smallest >= DEEPEST * (first.max(second).max(third) - smallest) {
            return Ok(());
        }
        let mut value = |time| Ok(side * self.value_at(integrator, index, time, false)?);
        // One extremum is where the smallest of the three values is, or beside it.
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
        self.push(integrator, index, &mut pair, (start, beyond))?;
        pair.go_on(-at_start.side);
        self.push(integrator, index, &mut pair, (beyond, end))?;
        track.pending = pair.pending;
        Ok(())
    }

    /// Takes note of the event at a change of sign, if it is one that is asked for.
    fn push<R: Summation>(
        &mut self,
        integrator: &Integrator<M, S, V, R, N>,
        index: usize,
        track: &mut Track,
        between: (f64, f64),
    ) -> Result<(), Error> {
        let kind = self.events.kind(index);
        if kind.wants(track.side) {
            let side = track.side;
            let found = self.locate(integrator, index, track, between, kind.by_steps)?;
            let time = found.unwrap_or(between.0);
            let unseen = track.stays && {
                self.look_at(integrator, time, kind.by_steps)?;
                copy_state(&mut self.shown, &self.state);
                let step = between.1 - between.0;
                time == between.0 || side * self.slope(integrator, index, step) >= 0.0
            };
            track.push(Crossing { time, side, unseen });
        }
        Ok(())
    }

    /// The last time before a change of sign; none if that is at the start, on zero.
    fn locate<R: Summation>(
        &mut self,
        integrator: &Integrator<M, S, V, R, N>,
        index: usize,
        track: &Track,
        (from, to): (f64, f64),
        by_steps: bool,
    ) -> Result<Option<f64>, Error> {
        let mut start = from;
        if track.on_zero {
            match self.departure(integrator, index, track, (from, to), by_steps)? {
                Some(place) => start = place,
                None => return Ok(None),
            }
        }
        let mut zero = |between, by_steps| {
            before_zero(between, |time| {
                self.value_at(integrator, index, time, by_steps)
            })
        };
        let found = zero((start, to), by_steps)?;
        if found.is_some() || !by_steps {
            return Ok(Some(found.unwrap_or(to)));
        }
        // The zero is so near to one of them that it is on the other side of it.
        let (last, width) = (integrator.last_step().ok_or(Error::NoStep)?, to - from);
        let (low, high) = (last.start.min(last.end), last.start.max(last.end));
        let wider = (
            (from - width).clamp(low, high),
            (to + width).clamp(low, high),
        );
        let found = zero(wider, true)?;
        if found.is_some() {
            return Ok(found);
        }
        let time = zero((start, to), false)?.unwrap_or(to);
        Ok(zero((last.start, time), true)?.or(Some(time)))
    }

    /// A place at which a function that starts on zero has its sign, beyond rounding: the last one of those halfway to the
    /// start, a quarter of the way, and so on.
    fn departure<R: Summation>(
        &mut self,
        integrator: &Integrator<M, S, V, R, N>,
        index: usize,
        track: &Track,
        (from, to): (f64, f64),
        by_steps: bool,
    ) -> Result<Option<f64>, Error> {
        let mut width = to - from;
        for _ in 0..HALVINGS {
            width *= 0.5;
            let place = from + width;
            if place == from {
                break;
            }
            let value = self.value_at(integrator, index, place, by_steps)?;
            if track.side * value > track.rounding {
                return Ok(Some(place));
            }
        }
        Ok(None)
    }

    /// The value of a function inside the last step.
    fn value_at<R: Summation>(
        &mut self,
        integrator: &Integrator<M, S, V, R, N>,
        index: usize,
        time: f64,
        by_steps: bool,
    ) -> Result<f64, Error> {
        self.look_at(integrator, time, by_steps)?;
        self.value(index)
    }

    /// Makes the state at a time of the last step the one that is looked at.
    pub(super) fn look_at<R: Summation>(
        &mut self,
        integrator: &Integrator<M, S, V, R, N>,
        time: f64,
        by_steps: bool,
    ) -> Result<(), Error> {
        if by_steps {
            let partial = self
                .partial
                .get_or_insert_with(|| PartialSteps::of(integrator));
            return partial.take(integrator, time, &mut self.state);
        }
        if !self.evaluated {
            self.ends.evaluate(integrator)?;
            self.evaluated = true;
        }
        self.state.time = time;
        let state = &mut self.state;
        self.ends
            .write(integrator, time, &mut state.q, &mut state.p)
    }

    /// The change of a function along the flow through the state that is to be shown, over a small part of `step`; 0
    /// where it is not known.
    pub(super) fn slope<R: Summation>(
        &mut self,
        integrator: &Integrator<M, S, V, R, N>,
        index: usize,
        step: f64,
    ) -> f64 {
        let state = &self.shown;
        let (velocity, force) = self
            .slopes
            .get_or_insert_with(|| (state.q.zeros_like(), state.p.zeros_like()));
        let time = V::Scalar::from_f64(state.time);
        let system = integrator.system();
        system.velocity(time, &state.q, &state.p, velocity);
        system.force(time, &state.q, &state.p, force);
        let [before, after] = [-SMALL * step, SMALL * step].map(|size| {
            self.state.time = state.time + size;
            add(&mut self.state.q, &state.q, size, velocity);
            add(&mut self.state.p, &state.p, size, force);
            self.events.value(index, &self.state)
        });
        let change = after - before;
        // Of an extremum on the way, or undefined on one side.
        let known = change.abs() > 1e-9 * (after.abs() + before.abs());
        if known { change } else { 0.0 }
    }

    /// The change of a function at the present state when the state changes by rounding.
    pub(super) fn rounding<R: Summation>(
        &mut self,
        integrator: &Integrator<M, S, V, R, N>,
        index: usize,
        value: f64,
    ) -> f64 {
        let changes = (0..4).map(|pattern| {
            copy_state(&mut self.state, integrator.state());
            let size = 4.0 * V::Scalar::EPSILON;
            perturb(&mut self.state.q, pattern, size);
            perturb(&mut self.state.p, pattern, size);
            (self.events.value(index, &self.state) - value).abs()
        });
        changes.fold(0.0, f64::max)
    }
}

/// Multiplies components by 1 ± `size`, with signs by the number of a pattern.
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
