//! Observation of the energy and of invariants along a run.

use super::Trace;
use symplectic::output::unit_of;
use symplectic::{State, Vector};

/// Number of time intervals in a [`Trace`].
const PARTS: usize = 240;

/// A function of the state.
pub(super) type Function<'a, V> = dyn Fn(&State<V>) -> f64 + 'a;

/// Records the largest deviations of invariants from their initial values, and the error of the energy over time.
pub(super) struct Observer<'a, V> {
    energy: Option<(&'a Function<'a, V>, Deviation)>,
    invariants: Vec<(&'a Function<'a, V>, Deviation)>,
    start: f64,
    end: f64,
    ranges: Vec<Option<(f64, f64)>>,
}

/// The largest deviation of a value from its initial value.
pub(super) struct Deviation {
    initial: f64,
    /// The scale of deviations.
    unit: f64,
    largest: f64,
}

impl Deviation {
    /// Deviations from the value at the start, relative to [it or its terms](unit_of).
    pub fn new<V: Vector>(function: impl Fn(&State<V>) -> f64, start: &State<V>) -> Self {
        Self {
            initial: function(start),
            unit: unit_of(function, start),
            largest: 0.0,
        }
    }

    /// Observes `value` and returns its signed deviation.
    pub fn observe(&mut self, value: f64) -> f64 {
        let deviation = (value - self.initial) / self.unit;
        // A NaN stays.
        if !(deviation.abs() <= self.largest || self.largest.is_nan()) {
            self.largest = deviation.abs();
        }
        deviation
    }

    /// The largest absolute deviation; NaN if any was NaN.
    pub const fn largest(&self) -> f64 {
        self.largest
    }
}

impl<'a, V: Vector> Observer<'a, V> {
    /// An observer from `start` to the time `end`.
    pub fn new(
        energy: Option<&'a Function<'a, V>>,
        invariants: impl Iterator<Item = &'a Function<'a, V>>,
        start: &State<V>,
        end: f64,
    ) -> Self {
        let with_deviation =
            |function: &'a Function<'a, V>| (function, Deviation::new(function, start));
        Self {
            energy: energy.map(with_deviation),
            invariants: invariants.map(with_deviation).collect(),
            start: start.time,
            end,
            ranges: vec![None; PARTS],
        }
    }

    /// Observes a state.
    pub fn observe(&mut self, state: &State<V>) {
        for (function, deviation) in &mut self.invariants {
            deviation.observe(function(state));
        }
        let Some((function, deviation)) = &mut self.energy else {
            return;
        };
        let error = deviation.observe(function(state));
        // A state at a boundary belongs to the interval that it ends.
        let part = (PARTS as f64 * (state.time - self.start) / (self.end - self.start)).ceil();
        let range = &mut self.ranges[(part as usize).clamp(1, PARTS) - 1];
        let (low, high) = range.get_or_insert((error, error));
        *low = low.min(error);
        *high = high.max(error);
    }

    /// The largest relative error of the energy, if there is one and it is finite.
    pub fn energy_error(&self) -> Option<f64> {
        let (_, deviation) = self.energy.as_ref()?;
        deviation.largest.is_finite().then_some(deviation.largest)
    }

    /// The largest deviations of the invariants, if finite.
    pub fn drifts(&self) -> Vec<Option<f64>> {
        let largest = self
            .invariants
            .iter()
            .map(|(_, deviation)| deviation.largest);
        largest
            .map(|value| value.is_finite().then_some(value))
            .collect()
    }

    /// The energy over time in the run with `parameter`; `None` if too few states were observed or it is not finite.
    pub fn trace(self, parameter: f64) -> Option<Trace> {
        let finite = |range: &Option<(f64, f64)>| {
            range.is_none_or(|(low, high)| low.is_finite() && high.is_finite())
        };
        let seen = self.ranges.iter().flatten().count();
        (seen > 2 && self.ranges.iter().all(finite)).then_some(Trace {
            parameter,
            ranges: self.ranges,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector1;

    fn state(time: f64, q: f64) -> State<Vector1<f64>> {
        State::new(time, Vector1::new(q), Vector1::new(0.0))
    }

    #[test]
    fn deviations_are_relative_to_the_first_value_and_to_its_terms_where_it_is_zero() {
        let energy = |state: &State<Vector1<f64>>| state.q[0];
        let shifted = |state: &State<Vector1<f64>>| state.q[0] - 2.0;
        let functions: [&Function<'_, _>; 1] = [&shifted];
        let mut observer =
            Observer::new(Some(&energy), functions.into_iter(), &state(0.0, 2.0), 10.0);
        for (time, q) in [(0.01, 1.5), (5.0, 2.25), (5.03, 2.5), (10.0, 2.0)] {
            observer.observe(&state(time, q));
        }
        assert_eq!(observer.energy_error(), Some(0.25));
        // An eighth of q is a quarter.
        assert_eq!(observer.drifts(), [Some(0.5 / 0.25)]);
        let trace = observer.trace(0.5).expect("states on the way");
        assert_eq!(trace.ranges[0], Some((-0.25, -0.25)));
        assert_eq!(trace.ranges[119], Some((0.125, 0.125)));
        assert_eq!(trace.ranges[120], Some((0.25, 0.25)));
        assert_eq!(trace.ranges[239], Some((0.0, 0.0)));
        assert_eq!(trace.ranges[1], None);
    }

    #[test]
    fn a_nan_energy_is_not_an_error_of_zero() {
        let energy = |state: &State<Vector1<f64>>| (state.q[0] - 1.0).sqrt();
        let mut observer = Observer::new(Some(&energy), core::iter::empty(), &state(0.0, 2.0), 1.0);
        for (time, q) in [(0.2, 0.0), (0.4, 2.0), (1.0, 2.0)] {
            observer.observe(&state(time, q));
        }
        assert_eq!(observer.energy_error(), None);
        assert!(observer.trace(1.0).is_none());
    }

    /// An energy of two terms that cancel up to a rounding error.
    #[test]
    fn deviations_of_an_energy_that_is_rounding_are_relative_to_its_terms() {
        let energy = |state: &State<Vector1<f64>>| state.q[0] * state.q[0] - 2.0;
        let start = state(0.0, 2.0_f64.sqrt());
        assert!(energy(&start) != 0.0 && energy(&start).abs() < 1e-15);
        let mut observer = Observer::new(Some(&energy), [].into_iter(), &start, 1.0);
        observer.observe(&state(0.5, 1.5));
        // 0.25 by a quarter of the term 2, which is what an eighth of q changes.
        let error = observer.energy_error().expect("an error");
        assert!((0.1..1.0).contains(&error), "{error}");
    }
}
