//! A problem and its methods.

use super::contestant::{Contestant, Finish, Observe};
use super::text;
use super::{Ladder, Measured};
use symplectic::solver::Solver;
use symplectic::{Error, Integrator, Method, ProvedFor, State, Summation, System, Vector};

/// A system with a start, a reference state at the end, and the methods to run.
///
/// See the [module](super) for an example.
pub struct Problem<V, S> {
    pub(super) name: String,
    pub(super) description: String,
    pub(super) needs: String,
    pub(super) system: S,
    pub(super) start: State<V>,
    pub(super) reference: Reference<V>,
    pub(super) ladder: Ladder,
    pub(super) trace_at: Option<f64>,
    pub(super) invariants: Vec<(String, Box<Invariant<V>>)>,
    pub(super) contestants: Vec<Contestant<V>>,
}

type Invariant<V> = dyn Fn(&State<V>) -> f64;

impl<V, S> Problem<V, S>
where
    V: Vector<Scalar = f64>,
    S: System<V> + Clone + 'static,
{
    /// The integration from `start` to the time of `reference`, with step sizes from `step_size` downward.
    ///
    /// `step_size` is the first step size of every method. Choose it rather too large than too small: failures appear
    /// in the report.
    pub fn new(
        name: impl Into<String>,
        system: S,
        start: State<V>,
        reference: Reference<V>,
        step_size: f64,
    ) -> Self {
        Self {
            name: name.into(),
            description: String::new(),
            needs: String::new(),
            system,
            start,
            reference,
            ladder: Ladder::Descend { first: step_size },
            trace_at: None,
            invariants: Vec::new(),
            contestants: Vec::new(),
        }
    }

    /// Describes the Hamiltonian and the source of the data.
    #[must_use]
    pub fn described(mut self, description: impl Into<String>) -> Self {
        self.description = description.into();
        self
    }

    /// Describes the requirements of the problem on a method.
    #[must_use]
    pub fn needing(mut self, needs: impl Into<String>) -> Self {
        self.needs = needs.into();
        self
    }

    /// Replaces the default ladder, [`Ladder::Descend`], for methods added afterwards.
    #[must_use]
    pub fn on_ladder(mut self, ladder: Ladder) -> Self {
        self.ladder = ladder;
        self
    }

    /// Plots the energy over time in the runs with the step size nearest to this one. By default these are the runs
    /// whose number of evaluations is nearest to the median of the methods for an error of 10⁻⁶.
    #[must_use]
    pub const fn traced_at(mut self, step_size: f64) -> Self {
        self.trace_at = Some(step_size);
        self
    }

    /// Observes a function of the state that the exact flow conserves, such as a momentum map.
    #[must_use]
    pub fn conserving(
        mut self,
        name: impl Into<String>,
        invariant: impl Fn(&State<V>) -> f64 + 'static,
    ) -> Self {
        self.invariants.push((name.into(), Box::new(invariant)));
        self
    }

    /// Adds a method with the default solver and compensated sums.
    #[must_use]
    pub fn method<M: Method + Copy + ProvedFor<S::Class>>(self, method: M) -> Self {
        self.run(M::NAME, move |system, start, step_size| {
            Integrator::new(method, system, start, step_size)
        })
    }

    /// Adds an integrator that `build` creates from the system, the start and the step size: in lanes, with Newton's
    /// iteration, with plain sums, ….
    ///
    /// In the report, methods with the same name are the same method, even if they are built differently.
    #[must_use]
    pub fn run<M, R, N, F>(mut self, name: impl Into<String>, build: F) -> Self
    where
        M: Method,
        R: Summation + 'static,
        N: Solver<V, S> + 'static,
        F: Fn(S, State<V>, f64) -> Result<Integrator<M, S, V, R, N>, Error> + Clone + 'static,
    {
        let (system, start) = (self.system.clone(), self.start.clone());
        let end = self.reference.end.time;
        let ladder = self.ladder.clone();
        let make = move |step_size| build(system.clone(), start.clone(), step_size);
        let contestant = Contestant::of_integrator(name.into(), ladder, end, make);
        self.contestants.push(contestant);
        self
    }

    /// Adds a method from elsewhere, with its own step sizes or tolerances.
    ///
    /// `integrate` integrates from the start to the end with the given parameter. It passes its states to the observer
    /// if there is one; runs without an observer are timed. Its error is a message.
    #[must_use]
    pub fn peer<F>(mut self, name: impl Into<String>, ladder: Ladder, integrate: F) -> Self
    where
        F: Fn(f64, Option<Observe<'_, V>>) -> Result<Finish<V>, String> + 'static,
    {
        let contestant = Contestant::of_peer(name.into(), ladder, integrate);
        self.contestants.push(contestant);
        self
    }

    /// The names of the methods added so far.
    pub fn methods(&self) -> impl Iterator<Item = &str> {
        self.contestants
            .iter()
            .map(|contestant| contestant.name.as_str())
    }
}

/// The reference state at the end.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference<V> {
    /// The state.
    pub end: State<V>,
    /// Its source.
    pub origin: String,
    /// Its uncertainty, a relative error like [`Measured::error`](super::Measured::error).
    pub uncertainty: f64,
}

impl<V: Vector<Scalar = f64>> Reference<V> {
    /// A state from a closed form or from a computation with more digits, known to the relative error `uncertainty`.
    pub fn known(end: State<V>, origin: impl Into<String>, uncertainty: f64) -> Self {
        Self {
            end,
            origin: origin.into(),
            uncertainty,
        }
    }

    /// The state that a method computes with steps of `step_size`. Its uncertainty is the distance from the state with
    /// steps of 3/2 that size.
    ///
    /// # Errors
    ///
    /// Those of [`Integrator::new`] and [`Integrator::integrate_to`].
    ///
    /// ```
    /// use symplectic::nalgebra::Vector1;
    /// use symplectic_report::Reference;
    /// use symplectic::{Error, State, acceleration};
    ///
    /// symplectic::tableau! { Gauss6 { basis: polynomial(6), nodes: gauss(6) } }
    ///
    /// # fn main() -> Result<(), Error> {
    /// let oscillator = acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q);
    /// let start = State::from_arrays(0.0, [1.0], [0.0]);
    /// let reference = Reference::computed(Gauss6, oscillator, &start, 10.0, 0.1)?;
    /// assert!((reference.end.q[0] - 10_f64.cos()).abs() < 1e-15);
    /// assert!(reference.uncertainty < 1e-14);
    /// # Ok(())
    /// # }
    /// ```
    pub fn computed<M, S>(
        method: M,
        system: S,
        start: &State<V>,
        end: f64,
        step_size: f64,
    ) -> Result<Self, Error>
    where
        M: Method + ProvedFor<S::Class>,
        S: System<V>,
    {
        let mut integrator = Integrator::new(method, system, start.clone(), 1.5 * step_size)?;
        let coarse = integrator.integrate_to(end)?.clone();
        integrator.set_state(start.clone())?;
        integrator.set_step_size(step_size)?;
        let fine = integrator.integrate_to(end)?.clone();
        let uncertainty = Measured::error_of(&coarse, &fine);
        Ok(Self {
            origin: format!(
                "{} with steps of {step_size}; with steps of {} the end differs by {}",
                M::NAME,
                1.5 * step_size,
                text::scientific(uncertainty),
            ),
            end: fine,
            uncertainty,
        })
    }
}

impl Measured {
    /// The larger of the relative errors of q and p in the 2-norm, absolute if the reference is zero.
    pub(super) fn error_of<V: Vector<Scalar = f64>>(found: &State<V>, reference: &State<V>) -> f64 {
        let relative = |found: &V, reference: &V| {
            let (found, reference) = (found.as_slice(), reference.as_slice());
            let largest = reference.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
            // Scaled, so that squares neither overflow nor underflow.
            let unit = if largest == 0.0 { 1.0 } else { largest };
            let norm = |components: &mut dyn Iterator<Item = f64>| {
                let squares = components.map(|x| (x / unit) * (x / unit));
                squares.sum::<f64>().sqrt()
            };
            let pairs = found.iter().zip(reference);
            let distance = norm(&mut pairs.map(|(a, b)| a - b));
            if largest == 0.0 {
                distance
            } else {
                distance / norm(&mut reference.iter().copied())
            }
        };
        let (q, p) = (
            relative(&found.q, &reference.q),
            relative(&found.p, &reference.p),
        );
        // NaN if either is NaN.
        if q.is_nan() || q > p { q } else { p }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_error_is_the_larger_relative_one() {
        let reference = State::from_arrays(0.0, [3.0, 4.0], [0.0, 0.0]);
        let found = State::from_arrays(0.0, [3.0, 4.5], [0.0, 0.01]);
        assert!((Measured::error_of(&found, &reference) - 0.1).abs() < 1e-15);
        let found = State::from_arrays(0.0, [3.0, 4.0], [0.25, 0.0]);
        assert_eq!(Measured::error_of(&found, &reference), 0.25);
        let found = State::from_arrays(0.0, [f64::NAN, 4.0], [0.25, 0.0]);
        assert!(Measured::error_of(&found, &reference).is_nan());
        let found = State::from_arrays(0.0, [1.0, 4.0], [0.25, f64::NAN]);
        assert!(Measured::error_of(&found, &reference).is_nan());
    }

    #[test]
    fn the_relative_error_does_not_depend_on_the_scale() {
        for scale in [1e-300, 1.0, 1e300] {
            let reference = State::from_arrays(0.0, [3.0 * scale], [4.0 * scale]);
            let found = State::from_arrays(0.0, [3.0 * scale], [5.0 * scale]);
            assert!((Measured::error_of(&found, &reference) - 0.25).abs() < 1e-15);
        }
    }
}
