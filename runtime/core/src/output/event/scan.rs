//! Whether the interpolation decides which events a step has.

use core::mem;

use super::list::EventList;
use super::locate::SMALL;
use super::search::{Search, place};
use super::track::{DEEPEST, Track, sign};
use crate::integrator::DenseSteps;

/// An extremum at a distance from zero of at most this number of differences is looked for by steps of the method.
const OPEN: f64 = 2.0;

/// What a series of values in a step shows.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Scan {
    /// The last value and its sign.
    last: f64,
    side: f64,
    /// Number of values, without the first.
    count: u32,
    /// The smallest magnitude of a value.
    smallest: f64,
    /// The largest magnitude of a difference.
    largest: f64,
    /// Number of sign changes, and of the value after the last one.
    changes: u32,
    changed: u32,
}

impl Scan {
    /// Appends a value.
    fn append(&mut self, value: f64) {
        self.count += 1;
        if sign(value) != self.side {
            self.changes += 1;
            self.changed = self.count;
        }
        self.smallest = self.smallest.min(value.abs());
        self.largest = self.largest.max((value - self.last).abs());
        (self.last, self.side) = (value, sign(value));
    }
}

impl Track {
    /// Begins a scan of the present step.
    const fn begin_scan(&mut self) {
        self.scan = Scan {
            last: self.value,
            side: self.side,
            count: 0,
            smallest: self.value.abs(),
            largest: 0.0,
            changes: 0,
            changed: 0,
        };
    }

    /// Goes on to the point before the last sign change that the scan shows. Returns the numbers of this point and of the next one, and of
    /// the last one.
    pub(super) const fn go_to_change(&mut self) -> [u32; 3] {
        let Scan { count, changed, .. } = self.scan;
        if changed > 1 {
            (self.on_zero, self.stays) = (false, false);
        }
        match changed {
            0 => [0, 1, 1],
            _ => [changed - 1, changed, count],
        }
    }

    /// Whether the scan leaves an event possible.
    fn is_near(&self) -> bool {
        let scan = &self.scan;
        let change = scan.largest.max(self.change / f64::from(scan.count));
        scan.smallest <= DEEPEST * change && change > 0.0
    }

    /// Largest distance from zero at which the interpolation does not decide whether the function turns before zero or beyond it. `slopes`
    /// are the changes in a step that the derivatives at its ends predict.
    fn open_range(&self, slopes: [f64; 2]) -> f64 {
        let before = if self.change.is_finite() {
            self.change
        } else {
            0.0
        };
        let steepest = slopes
            .into_iter()
            .fold(before, |steepest, slope| steepest.max(slope.abs()));
        OPEN * self.scan.largest.max(steepest / f64::from(self.scan.count))
    }
}

impl<E: EventList<S::Vector> + ?Sized, S: DenseSteps> Search<'_, E, S> {
    /// Whether the interpolation leaves open which events the last step has, so that steps of the method decide.
    pub(super) fn is_open(&mut self, stepper: &mut S, span: (f64, f64)) -> Result<bool, S::Error> {
        let (count, finest) = (self.tracks.as_ref().len(), self.samples.next_multiple_of(2));
        self.tracks.as_mut().iter_mut().for_each(Track::begin_scan);
        if count == 0 || self.samples == 1 {
            return Ok(false);
        }
        let at_once = self.samples_all || !mem::take(&mut self.resolved);
        let mut points = if at_once { finest } else { 2 };
        loop {
            self.tracks.as_mut().iter_mut().for_each(Track::begin_scan);
            for number in 1..=points {
                self.look_at_point(stepper, place(span, number, points), false)?;
                for index in 0..count {
                    let value = self.value(index)?;
                    self.tracks.as_mut()[index].scan.append(value);
                }
            }
            if !self.tracks.as_ref().iter().any(Track::is_near) {
                return Ok(false);
            }
            if points == finest {
                break;
            }
            points = finest.min(2 * points);
        }
        for index in 0..count {
            if self.tracks.as_ref()[index].is_near()
                && self.is_open_for(stepper, index, span, points)?
            {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// [`is_open`](Self::is_open) for a function that is near zero at some of the points of a scan.
    fn is_open_for(
        &mut self,
        stepper: &mut S,
        index: usize,
        span: (f64, f64),
        points: u32,
    ) -> Result<bool, S::Error> {
        let track = self.tracks.as_ref()[index];
        let mut slopes = [0.0; 2];
        for (slope, time) in slopes.iter_mut().zip([span.0, span.1]) {
            self.look_at_point(stepper, time, false)?;
            *slope = self.slope_here(stepper, index, span);
        }
        let range = track.open_range(slopes);
        if track.scan.changes > 1 || track.scan.smallest > range {
            return Ok(track.scan.changes > 1);
        }
        // The function turns between two points if it goes towards zero at the first one and away from it at the second one.
        let (mut side, mut goes_there) = (track.side, track.on_zero.then_some(false));
        for number in 0..=points {
            self.look_at_point(stepper, place(span, number, points), false)?;
            let value = self.value(index)?;
            let here = if number == 0 { track.side } else { sign(value) };
            let slope =
                (value.abs() <= range).then(|| here * self.slope_here(stepper, index, span));
            let turns = match slope {
                Some(slope) => slope >= 0.0 && goes_there != Some(false),
                None => goes_there == Some(true),
            };
            if number > 0 && here == side && turns {
                return Ok(true);
            }
            if number > 0 || !track.on_zero {
                goes_there = slope.map(|slope| slope <= 0.0);
            }
            side = here;
        }
        Ok(false)
    }

    /// The change of a function in the last step that its derivative at `self.output.state` predicts.
    fn slope_here(&mut self, stepper: &mut S, index: usize, (start, end): (f64, f64)) -> f64 {
        self.shown.copy_from(&self.output.state);
        self.slope(stepper, index, end - start) / (2.0 * SMALL)
    }
}
