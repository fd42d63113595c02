//! Integration with events.

use core::ops::ControlFlow;

use super::list::Events;
use super::search::{Search, Stop};
use super::{Event, Moment};
use crate::error::Error;
use crate::integrator::sight::Sight;
use crate::integrator::{DenseSteps, Pace, Run, Statistics};
use crate::output::at_times::{check_times, is_after};

impl<S: DenseSteps> Run<S> {
    /// [`integrate_to`](crate::Integrator#method.integrate_to) that calls `observe` with the state at every event, in order. If `observe`
    /// breaks with a value, the integration ends and returns that value; otherwise it returns `None`. It ends after the step that contains
    /// the event, or at the event if it is a [`wall`](Event::wall).
    ///
    /// A stepper with its [own](crate::stepper::Own) pace takes the steps up to the one that reaches or passes `end`, and the present state is then
    /// that after this step. Events after `end` in this step are reported too, so that a run that continues misses none. At a wall or a
    /// changed state it begins anew: an adaptive run with the step density 1/σ there.
    ///
    /// # Errors
    ///
    /// Those of [`integrate_to`](crate::Integrator#method.integrate_to) and of [`look`](DenseSteps::look). [`Error::EventValue`] if the
    /// function is NaN; the present state is then the state before the step. [`Error::EventsAccumulate`], see
    /// [`Event`]. [`Error::OutputTime`] if `end` lies before the last step of a stepper with its own pace.
    pub fn integrate_with_events<
        G: Fn(&S::State) -> f64,
        B,
        F: FnMut(&S::State) -> ControlFlow<B>,
    >(
        &mut self,
        end: f64,
        event: &Event<G>,
        mut observe: F,
    ) -> Result<Option<B>, S::Error> {
        self.integrate_through(end, &[], event, |moment| match moment {
            Moment::Event { state, .. } => observe(state),
            Moment::Output(_) => ControlFlow::Continue(()),
        })
    }

    /// The state at the first event before `end`. If there is no event, returns `None`, with the present state at
    /// `end`.
    ///
    /// The present state is then the state after the step that contains the event; at a [`wall`](Event::wall) it is the
    /// state at the event. To continue from the event, [set](Self::set_state) the returned state, changed or not: see
    /// [`Event`].
    ///
    /// # Errors
    ///
    /// Those of [`integrate_with_events`](Self::integrate_with_events).
    pub fn find_event<G: Fn(&S::State) -> f64>(
        &mut self,
        end: f64,
        event: &Event<G>,
    ) -> Result<Option<S::State>, S::Error> {
        self.integrate_with_events(end, event, |state| ControlFlow::Break(state.clone()))
    }

    /// [`integrate_to`](crate::Integrator#method.integrate_to) that calls `handle` with the states at the output times and at the events
    /// of a list, in order of time.
    ///
    /// At equal times output comes first, then the events in the order of the list. The handler may change the state at
    /// an event. The integration continues from the changed state, and later events at the same time receive it.
    ///
    /// If the handler breaks with a value, the integration ends and returns it; otherwise it returns `None`. The present state is then the
    /// state after the step. At a wall, and if the handler changed the state, it is the state at the event.
    ///
    /// # Errors
    ///
    /// Those of [`integrate_with_events`](Self::integrate_with_events); [`Error::OutputTime`] and
    /// [`Error::OutputAfterEnd`] before the first step; [`Error::NonFiniteState`] and [`Error::Dimension`] for a
    /// changed state.
    ///
    /// ```
    /// symplectic::tableau! { StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) } }
    /// use core::ops::ControlFlow;
    /// use symplectic::nalgebra::Vector1;
    /// use symplectic::output::Moment;
    /// use symplectic::{Error, Event, Integrator, State, acceleration};
    ///
    /// # fn main() -> Result<(), Error> {
    /// type Ball = State<Vector1<f64>>;
    ///
    /// // A ball between floor and ceiling, and its highest points.
    /// let ball = acceleration::<Vector1<f64>, _>(|_, _, acceleration| acceleration[0] = -10.0);
    /// let start = State::new(0.0, Vector1::new(0.0), Vector1::new(6.0));
    /// let mut integrator = Integrator::new(StoermerVerlet, ball, start, 0.125)?;
    /// let events = (
    ///     Event::wall(|ball: &Ball| ball.q[0]),
    ///     Event::wall(|ball: &Ball| 1.0 - ball.q[0]),
    ///     Event::falling(|ball: &Ball| ball.p[0]),
    /// );
    /// let (mut heights, mut found) = (Vec::new(), Vec::new());
    /// integrator.integrate_through(2.0, &[0.0, 0.5, 1.0, 1.5, 2.0], &events, |moment| {
    ///     match moment {
    ///         Moment::Output(ball) => heights.push(ball.q[0]),
    ///         Moment::Event { index, state } => {
    ///             found.push(index);
    ///             if index < 2 {
    ///                 state.p *= -0.8;
    ///             }
    ///         }
    ///     }
    ///     ControlFlow::<()>::Continue(())
    /// })?;
    /// assert_eq!(heights.len(), 5);
    /// assert!(heights.iter().all(|height| (0.0..=1.0).contains(height)));
    /// // Up to the ceiling, down to the floor, then up and down in lower and lower arcs.
    /// assert_eq!(found, [1, 0, 2, 0, 2]);
    /// # Ok(())
    /// # }
    /// ```
    pub fn integrate_through<
        E: Events<S::Vector> + ?Sized,
        B,
        F: FnMut(Moment<'_, S::Vector>) -> ControlFlow<B>,
    >(
        &mut self,
        end: f64,
        times: &[f64],
        events: &E,
        mut handle: F,
    ) -> Result<Option<B>, S::Error> {
        if S::Pace::OWN && !end.is_finite() {
            return Err(Error::EndTime { value: end }.into());
        }
        let (present, step) = (self.stepper.time(), self.size_to(end));
        // A stepper with its own pace may be beyond the end.
        let before = match S::Pace::OWN {
            true => self.start_of_last_step(),
            false => present,
        };
        if is_after(step, before, end) {
            return Err(Error::OutputTime { time: end, before }.into());
        }
        check_times(step, times, before, Some(end))?;
        let mut search = Search::new(events, times, &self.stepper, self.last_event, step);
        search.output.by_steps = self.output_by_steps;
        search.start(&mut self.stepper, step)?;
        let mut ended = search.show_output(&mut self.stepper, present, &mut handle)?;
        loop {
            let stepped = match ended {
                ControlFlow::Break(stop) => Ok(ControlFlow::Break(stop)),
                ControlFlow::Continue(()) => {
                    let mut searching = Searching {
                        search: &mut search,
                        handle: &mut handle,
                    };
                    match S::Pace::OWN {
                        true => self.pass_in_sight(end, &mut searching),
                        false => self.integrate_in_sight(end, &mut searching),
                    }
                }
            };
            self.last_event = search.last;
            let ControlFlow::Break(stop) = stepped? else {
                return Ok(None);
            };
            if !matches!(stop, Stop::Broken(_, false)) {
                let changed = self.copy_state(&search.shown);
                if changed.is_err() {
                    self.copy_state(&search.output.state)?;
                }
                changed?;
            }
            match stop {
                Stop::Broken(value, _) => return Ok(Some(value)),
                Stop::Failed(error) => return Err(error),
                Stop::Reset => {
                    let step = self.size_to(end).copysign(step);
                    search.start(&mut self.stepper, step)?;
                }
            }
            ended = ControlFlow::Continue(());
        }
    }

    /// Takes steps in sight of `sight` until `end` is reached or passed, or until it breaks.
    fn pass_in_sight<B>(
        &mut self,
        end: f64,
        sight: &mut impl Sight<S, B>,
    ) -> Result<ControlFlow<B>, S::Error> {
        while self.is_before(end) {
            self.step()?;
            let seen = sight.see_or_pass(&mut self.stepper)?;
            if seen.is_break() {
                return Ok(seen);
            }
        }
        Ok(ControlFlow::Continue(()))
    }

    /// Approximate size of the next step towards `end`.
    fn size_to(&self, end: f64) -> f64 {
        match S::Pace::OWN {
            true => self.step_size(),
            false => self.step_size.abs().copysign(end - self.stepper.time()),
        }
    }
}

/// A search during the steps of a run.
struct Searching<'a, 'e, E: Events<S::Vector> + ?Sized, S: DenseSteps, F> {
    search: &'a mut Search<'e, E, S>,
    handle: &'a mut F,
}

impl<E, S, F, B> Sight<S, Stop<B, S::Error>> for Searching<'_, '_, E, S, F>
where
    E: Events<S::Vector> + ?Sized,
    S: DenseSteps,
    F: FnMut(Moment<'_, S::Vector>) -> ControlFlow<B>,
{
    #[inline]
    fn passes(&mut self, state: &S::State, statistics: &Statistics) -> bool {
        self.search.passes(state, statistics.iterations)
    }

    fn see(&mut self, stepper: &mut S) -> Result<ControlFlow<Stop<B, S::Error>>, S::Error> {
        let seen = self.search.step(stepper, self.handle);
        Ok(seen.unwrap_or_else(|error| self.search.fail(stepper, error)))
    }
}
