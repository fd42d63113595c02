//! Search state of an event function.

use super::scan::Scan;

/// Largest assumed distance of an extremum from the values beside it, in units of their largest difference.
pub(super) const DEEPEST: f64 = 4.0;

/// The sign of an event function at the current point, and its events in the present panel.
#[derive(Clone, Copy, Debug, Default)]
pub struct Track {
    /// Sign at the current point; 0 if unknown.
    pub(super) side: f64,
    /// Whether the value there is zero to rounding, so that `side` is the sign right after it.
    pub(super) on_zero: bool,
    /// Rounding error of the value at the start of the search.
    pub(super) rounding: f64,
    /// Whether the function is zero at the start of the search and its derivative does not take it to the other side.
    pub(super) stays: bool,
    /// Value at the current point.
    pub(super) value: f64,
    /// Value at the start of the present step.
    pub(super) start: f64,
    /// Change of the value in the last step; infinite if unknown.
    pub(super) change: f64,
    /// The values in the present step, as far as they are known.
    pub(super) scan: Scan,
    /// Values in the middle and at the end of the panel.
    pub(super) ahead: [f64; 2],
    /// Events in the panel that the handler has not received, in order of time.
    pub(super) pending: [Option<Crossing>; 2],
    /// Sign before the event from which the search starts; 0 if it does not start from an event.
    pub(super) fired: f64,
}

/// A sign change.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    pub(super) time: f64,
    /// Sign before the change.
    pub(super) side: f64,
    /// Whether the change follows a start on zero so closely that the turn of the function cannot be resolved.
    pub(super) unseen: bool,
}

impl Track {
    /// Whether the next step, with this value at its end, has no event for certain: the value at both ends is far from zero, compared with
    /// its change in this step and in the one before.
    pub(super) fn passes(&self, value: f64) -> bool {
        let same = self.side * value > 0.0 && self.side * self.value > 0.0;
        let nearest = value.abs().min(self.value.abs());
        let change = (value - self.value).abs().max(self.change);
        // `min` and `max` ignore NaN.
        let at_rest = value == 0.0 && self.value == 0.0 && self.change == 0.0;
        !self.on_zero && (same && nearest > DEEPEST * change || at_rest)
    }

    /// Begins a step at the current point.
    pub(super) const fn begin_step(&mut self) {
        self.start = self.value;
    }

    /// Ends the step at the current point.
    pub(super) const fn end_step(&mut self) {
        self.change = (self.value - self.start).abs();
    }

    /// Whether the sign changes before the next point, where the function has this value.
    pub(super) fn changes(&self, value: f64) -> bool {
        let zero = value == 0.0 && !self.on_zero;
        self.side != 0.0 && (zero || self.side * sign(value) < 0.0)
    }

    /// Advances to the next point, where the function has this value.
    pub(super) fn go_on(&mut self, value: f64) {
        if value != 0.0 || !self.on_zero {
            (self.side, self.on_zero, self.stays) = (sign(value), false, false);
        }
        self.value = value;
    }

    /// Records an event.
    pub(super) fn push(&mut self, crossing: Crossing) {
        let [first, second] = &mut self.pending;
        *if first.is_none() { first } else { second } = Some(crossing);
    }

    /// Removes the first event.
    pub(super) fn pop(&mut self) -> Option<Crossing> {
        let [first, second] = self.pending;
        self.pending = [second, None];
        first
    }
}

/// 1, −1 or 0.
pub(super) fn sign(value: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value.signum() }
}
