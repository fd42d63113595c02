//! What a search knows about one event function.

/// The sign of a function on its way, and its events in the present panel.
#[derive(Clone, Copy, Debug, Default)]
pub struct Track {
    /// Its sign at the last place; 0 where it is not known.
    pub(super) side: f64,
    /// Whether its value there is zero to rounding, so that the sign is that right after it.
    pub(super) on_zero: bool,
    /// What its values differ from zero by rounding at the start of the search.
    pub(super) rounding: f64,
    /// Whether it is zero at the start of the search and does not go to the other side there, by its derivative.
    pub(super) stays: bool,
    /// Its value there.
    pub(super) value: f64,
    /// Its values in the middle and at the end of the panel.
    pub(super) ahead: [f64; 2],
    /// Events in the panel that are not shown yet, in the order of time.
    pub(super) pending: [Option<Crossing>; 2],
    /// The sign before the event from which the search starts; 0 if it does not start from one.
    pub(super) fired: f64,
}

/// A change of sign.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossing {
    pub(super) time: f64,
    /// The sign before it.
    pub(super) side: f64,
    /// Whether it comes so soon after a start on zero that the function cannot be seen to turn round before it.
    pub(super) unseen: bool,
}

impl Track {
    /// Whether the sign changes on the way to a place with this value.
    pub(super) fn changes(&self, value: f64) -> bool {
        let zero = value == 0.0 && !self.on_zero;
        self.side != 0.0 && (zero || self.side * sign(value) < 0.0)
    }

    /// Goes on to a place with this value.
    pub(super) fn go_on(&mut self, value: f64) {
        if value != 0.0 || !self.on_zero {
            (self.side, self.on_zero, self.stays) = (sign(value), false, false);
        }
        self.value = value;
    }

    /// Takes note of an event.
    pub(super) fn push(&mut self, crossing: Crossing) {
        let [first, second] = &mut self.pending;
        *if first.is_none() { first } else { second } = Some(crossing);
    }

    /// Takes the first event off the list.
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
