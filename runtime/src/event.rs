//! Events: where a function of the state changes its sign.

use core::ops::ControlFlow;

use crate::dense::Ends;
use crate::partial::PartialSteps;
use crate::root::brent;
use crate::{Error, Hamiltonian, Integrator, Method, Solver, State, Summation, Vector};

/// A function of the state whose zeros are looked for.
///
/// It is looked at the ends of every step and at places between them, equally spaced: a change of sign between
/// neighbours is an event. The zero is found by Brent's method on the [dense output](Integrator::dense), to rounding; or,
/// with [`by_steps`](Self::by_steps), by steps of the method itself.
///
/// What can be missed: two zeros, or any even number, between neighbouring places; a zero at which the sign does
/// not change. Of three zeros between neighbours one is found. More [`samples`](Self::samples) miss less.
///
/// A zero at a place that is looked at is an event when the sign was another one before; so the start is none, and a
/// function that is zero for a while has one event there.
///
/// ```
/// symplectic::tableau! { Gauss4 { basis: polynomial(4), nodes: gauss(4) } }
/// use core::ops::ControlFlow;
/// use symplectic::nalgebra::Vector1;
/// use symplectic::{Error, Event, Integrator, State, acceleration};
///
/// # fn main() -> Result<(), Error> {
/// let oscillator = acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q);
/// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
/// let mut integrator = Integrator::new(Gauss4, oscillator, start, 0.125)?;
///
/// // The times at which q = cos t goes up through zero: 3π/2, 7π/2, …
/// let mut times = Vec::new();
/// integrator.integrate_with_events(20.0, &Event::rising(|state: &State<Vector1<f64>>| state.q[0]), |state| {
///     times.push(state.time);
///     ControlFlow::<()>::Continue(())
/// })?;
/// assert_eq!(times.len(), 3);
/// assert!((times[1] - 3.5 * core::f64::consts::PI).abs() < 1e-6);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Event<G> {
    function: G,
    /// Whether a change to plus is one, and a change to minus.
    directions: [bool; 2],
    samples: u32,
    by_steps: bool,
}

impl<G> Event<G> {
    const fn new(function: G, directions: [bool; 2]) -> Self {
        Self {
            function,
            directions,
            samples: 4,
            by_steps: false,
        }
    }

    /// Where the function changes from minus to plus, in the direction of the steps.
    pub const fn rising(function: G) -> Self {
        Self::new(function, [true, false])
    }

    /// Where the function changes from plus to minus, in the direction of the steps.
    pub const fn falling(function: G) -> Self {
        Self::new(function, [false, true])
    }

    /// Where the function changes its sign.
    pub const fn crossing(function: G) -> Self {
        Self::new(function, [true, true])
    }

    /// Looks at this many places in every step, its end among them, instead of four; 0 counts as 1.
    #[must_use]
    pub fn samples(mut self, samples: u32) -> Self {
        self.samples = samples.max(1);
        self
    }

    /// Finds the zero by steps of the method from the start of the step in which it is, about ten for an event: the state
    /// has then the order of the method, whatever that of the dense output is.
    ///
    /// ```
    /// symplectic::tableau! { Gauss4 { basis: polynomial(4), nodes: gauss(4) } }
    /// # use symplectic::nalgebra::Vector1;
    /// # use symplectic::{Error, Event, Integrator, State, acceleration};
    /// # fn main() -> Result<(), Error> {
    /// # let oscillator = acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q);
    /// # let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    /// let mut integrator = Integrator::new(Gauss4, oscillator, start, 0.125)?;
    /// let event = Event::falling(|state: &State<Vector1<f64>>| state.q[0]).by_steps();
    /// let state = integrator.find_event(2.0, &event)?.expect("a quarter of a period");
    /// assert!((state.time - core::f64::consts::FRAC_PI_2).abs() < 1e-13);
    /// # Ok(())
    /// # }
    /// ```
    #[must_use]
    pub const fn by_steps(mut self) -> Self {
        self.by_steps = true;
        self
    }
}

impl<M: Method, S: Hamiltonian<V>, V: Vector, R: Summation, N: Solver<V, S>>
    Integrator<M, S, V, R, N>
{
    /// [`integrate_to`](Self::integrate_to) that shows `observe` the state at every event, in their order, and ends after
    /// the step in which `observe` breaks it: with the value that it breaks with, otherwise with `None`.
    ///
    /// # Errors
    ///
    /// Those of [`integrate_to`](Self::integrate_to) and of [`dense`](Self::dense); [`Error::EventValue`] where the
    /// function is not a number.
    pub fn integrate_with_events<G, B, F>(
        &mut self,
        end: f64,
        event: &Event<G>,
        mut observe: F,
    ) -> Result<Option<B>, Error>
    where
        G: Fn(&State<V>) -> f64,
        F: FnMut(&State<V>) -> ControlFlow<B>,
    {
        let mut search = Search {
            event,
            ends: Ends::new(),
            state: self.state().clone(),
            before: value(event, self.state())?,
        };
        let ended = self.steps_to(end, |integrator, next| {
            integrator.advance_in_sight(next.size, next.time, &mut |integrator: &Self| {
                search.step(integrator, &mut observe)
            })
        })?;
        Ok(ended.break_value())
    }

    /// The state at the first event before `end`; `None`, and the present state at `end`, if there is none.
    ///
    /// The present state is that after the step in which the event is.
    ///
    /// # Errors
    ///
    /// As for [`integrate_with_events`](Self::integrate_with_events).
    pub fn find_event<G: Fn(&State<V>) -> f64>(
        &mut self,
        end: f64,
        event: &Event<G>,
    ) -> Result<Option<State<V>>, Error> {
        self.integrate_with_events(end, event, |state| ControlFlow::Break(state.clone()))
    }
}

/// A search for events, step by step.
struct Search<'e, G, V> {
    event: &'e Event<G>,
    ends: Ends<V>,
    /// The state that is looked at.
    state: State<V>,
    /// The value at the last place that was looked at.
    before: f64,
}

impl<G: Fn(&State<V>) -> f64, V: Vector> Search<'_, G, V> {
    /// Shows the events in the last step.
    fn step<M, S, R, N, B>(
        &mut self,
        integrator: &Integrator<M, S, V, R, N>,
        observe: &mut impl FnMut(&State<V>) -> ControlFlow<B>,
    ) -> Result<ControlFlow<B>, Error>
    where
        M: Method,
        S: Hamiltonian<V>,
        R: Summation,
        N: Solver<V, S>,
    {
        let last = integrator.last_step().ok_or(Error::NoStep)?;
        let (start, end, samples) = (last.start, last.end, self.event.samples);
        // Without places inside and without an event nothing is to be interpolated.
        let mut evaluated = false;
        let mut before = start;
        for number in 1..=samples {
            let (time, new) = if number == samples {
                (end, value(self.event, integrator.state())?)
            } else {
                if !evaluated {
                    self.ends.evaluate(integrator)?;
                    evaluated = true;
                }
                let time = start + (end - start) * (f64::from(number) / f64::from(samples));
                (time, self.value_at(integrator, time)?)
            };
            let old = core::mem::replace(&mut self.before, new);
            let changed = old != 0.0 && (new == 0.0 || (new > 0.0) != (old > 0.0));
            if changed && self.event.directions[usize::from(old > 0.0)] {
                if !evaluated {
                    self.ends.evaluate(integrator)?;
                    evaluated = true;
                }
                self.locate(integrator, (before, time))?;
                let shown = observe(&self.state);
                if shown.is_break() {
                    return Ok(shown);
                }
            }
            before = time;
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Makes the state at the event between two times the one that is looked at.
    fn locate<M, S, R, N>(
        &mut self,
        integrator: &Integrator<M, S, V, R, N>,
        between: (f64, f64),
    ) -> Result<(), Error>
    where
        M: Method,
        S: Hamiltonian<V>,
        R: Summation,
        N: Solver<V, S>,
    {
        let (before, after) = between;
        // The polynomial has different signs there.
        let time = brent(between, |time| self.value_at(integrator, time))?.unwrap_or(after);
        if !self.event.by_steps {
            return self.look_at(integrator, time);
        }
        let mut partial = PartialSteps::like(&self.state.q);
        let mut value = |time| {
            partial.take(integrator, time, &mut self.state)?;
            value(self.event, &self.state)
        };
        let mut found = brent(between, &mut value)?;
        if found.is_none() {
            // The zero is so near to one of them that it is on the other side of it.
            let (last, width) = (integrator.last_step().ok_or(Error::NoStep)?, after - before);
            let (low, high) = (last.start.min(last.end), last.start.max(last.end));
            let wider = (
                (before - width).clamp(low, high),
                (after + width).clamp(low, high),
            );
            found = brent(wider, &mut value)?;
        }
        value(found.unwrap_or(time)).map(|_| ())
    }

    fn value_at<M, S, R, N>(
        &mut self,
        integrator: &Integrator<M, S, V, R, N>,
        time: f64,
    ) -> Result<f64, Error>
    where
        M: Method,
        S: Hamiltonian<V>,
        R: Summation,
        N: Solver<V, S>,
    {
        self.look_at(integrator, time)?;
        value(self.event, &self.state)
    }

    fn look_at<M, S, R, N>(
        &mut self,
        integrator: &Integrator<M, S, V, R, N>,
        time: f64,
    ) -> Result<(), Error>
    where
        M: Method,
        S: Hamiltonian<V>,
        R: Summation,
        N: Solver<V, S>,
    {
        let State { time: at, q, p } = &mut self.state;
        *at = time;
        self.ends.write(integrator, time, q, p)
    }
}

/// The value of the function at a state.
fn value<G: Fn(&State<V>) -> f64, V>(event: &Event<G>, state: &State<V>) -> Result<f64, Error> {
    let value = (event.function)(state);
    if value.is_nan() {
        return Err(Error::EventValue { time: state.time });
    }
    Ok(value)
}
