//! Balances: a quantity against the total supply of it.

use symplectic_core::inside::larger_or_nan;

/// Observes a balance: the deviation of a function of the state from its first value plus the total supply since.
///
/// Examples: the energy and the [work](crate::variational::StagesOfStep::work) of an applied force; a momentum map and
/// its [impulse](crate::variational::StagesOfStep::impulse). Without supply it is an [`Invariant`](symplectic_core::Invariant).
///
/// [`step_with_stages`](crate::variational::StepWithStages::step_with_stages) returns the supply of each step. For Gauss methods it needs two to four
/// times as many evaluations as a step, for explicit methods many more.
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
    /// Rounding error of `supplied` (compensated summation).
    rest: f64,
    last: f64,
    largest: f64,
}

impl<F> Balance<F> {
    /// A balance of `function` that begins at the state `start`, of any type.
    pub fn new<T>(function: F, start: &T) -> Self
    where
        F: Fn(&T) -> f64,
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

    /// Observes a state; `supplied` is the supply since the previous state.
    pub fn observe<T>(&mut self, state: &T, supplied: f64)
    where
        F: Fn(&T) -> f64,
    {
        let add = supplied + self.rest;
        let sum = self.supplied + add;
        self.rest = add - (sum - self.supplied);
        self.supplied = sum;
        self.last = (self.function)(state) - self.initial - self.supplied;
        self.largest = larger_or_nan(self.largest, self.last.abs());
    }

    /// The value at the first state.
    pub const fn initial(&self) -> f64 {
        self.initial
    }

    /// The total supply.
    pub const fn supplied(&self) -> f64 {
        self.supplied
    }

    /// The value at the latest state, minus the first value and the total supply.
    pub const fn last(&self) -> f64 {
        self.last
    }

    /// The largest absolute value of [`last`](Self::last) so far; NaN if any was NaN.
    pub const fn deviation(&self) -> f64 {
        self.largest
    }
}
