//! Whether a quantity changes by what is supplied.

use crate::state::State;

/// An observer of a balance: how far a function of the state is from its first value and all that was supplied since.
///
/// The energy with the [work](crate::variational::StagesOfStep::work) of an applied force, a momentum map with its
/// [impulse](crate::variational::StagesOfStep::impulse); with nothing supplied it is an [`Invariant`](crate::Invariant).
///
/// ```
/// use symplectic::State;
/// use symplectic::nalgebra::Vector1;
/// use symplectic::output::Balance;
///
/// let at = |time: f64, p: f64| State::new(time, Vector1::new(0.0), Vector1::new(p));
/// let mut momentum = Balance::new(|state: &State<Vector1<f64>>| state.p[0], &at(0.0, 1.0));
/// momentum.observe(&at(0.5, 1.25), 0.25);
/// momentum.observe(&at(1.0, 1.75), 0.5);
/// assert_eq!((momentum.supplied(), momentum.deviation()), (0.75, 0.0));
/// momentum.observe(&at(1.5, 1.75), 0.125);
/// assert_eq!((momentum.last(), momentum.deviation()), (-0.125, 0.125));
/// ```
#[derive(Clone, Debug)]
pub struct Balance<F> {
    function: F,
    initial: f64,
    supplied: f64,
    /// What the sum of the supplies leaves out.
    rest: f64,
    last: f64,
    largest: f64,
}

impl<F> Balance<F> {
    /// A balance of `function`, beginning with a state.
    pub fn new<V>(function: F, start: &State<V>) -> Self
    where
        F: Fn(&State<V>) -> f64,
    {
        let initial = function(start);
        Self {
            function,
            initial,
            supplied: 0.0,
            rest: 0.0,
            last: 0.0,
            largest: 0.0,
        }
    }

    /// Looks at a state, after so much was supplied since the one before.
    pub fn observe<V>(&mut self, state: &State<V>, supplied: f64)
    where
        F: Fn(&State<V>) -> f64,
    {
        let add = supplied + self.rest;
        let sum = self.supplied + add;
        self.rest = add - (sum - self.supplied);
        self.supplied = sum;
        self.last = (self.function)(state) - self.initial - self.supplied;
        // NaN once and for all.
        if !(self.last.abs() <= self.largest || self.largest.is_nan()) {
            self.largest = self.last.abs();
        }
    }

    /// The value at the first state.
    pub const fn initial(&self) -> f64 {
        self.initial
    }

    /// All that was supplied.
    pub const fn supplied(&self) -> f64 {
        self.supplied
    }

    /// At the latest state the value, less the first one and all that was supplied.
    pub const fn last(&self) -> f64 {
        self.last
    }

    /// The largest absolute value of [that](Self::last) so far; NaN if one of the values was.
    pub const fn deviation(&self) -> f64 {
        self.largest
    }
}
