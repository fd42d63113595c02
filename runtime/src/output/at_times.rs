//! Output at given times.

use crate::error::Error;
use crate::integrator::Integrator;
use crate::method::{Method, Solver};
#[cfg(feature = "alloc")]
use crate::number::Scalar;
#[cfg(feature = "alloc")]
use crate::number::registers::Work;
use crate::number::{Summation, Vector};
use crate::output::dense::Ends;
use crate::output::steps::{Steps, is_after};
use crate::state::State;
use crate::system::System;

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Integrator<M, S, V, R, N> {
    /// Steps past the last of `times` and calls `observe` with the state at each of them, in order.
    ///
    /// The step size does not depend on the output times; states inside a step are [interpolated](Self::dense). The
    /// first time may be the present time or lie in the last step. With a negative step size the times decrease.
    ///
    /// # Errors
    ///
    /// [`Error::OutputTime`] for the first time that is not finite, precedes its predecessor or precedes the last step;
    /// [`Error::StepCount`] for too many steps. Both are returned before any step is taken. Also the errors of
    /// [`step`](Self::step) and of [`dense`](Self::dense); the state is then that of the last successful step.
    ///
    /// ```
    /// symplectic::tableau! { Gauss4 { basis: polynomial(4), nodes: gauss(4) } }
    /// # use symplectic::nalgebra::Vector1;
    /// # use symplectic::{Error, Integrator, State, acceleration};
    /// # fn main() -> Result<(), Error> {
    /// let oscillator = acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q);
    /// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
    /// let mut integrator = Integrator::new(Gauss4, oscillator, start, 0.25)?;
    /// let mut found = Vec::new();
    /// integrator.integrate_at(&[0.0, 0.1, 0.2, 1.1], |state| found.push((state.time, state.q[0])))?;
    /// for (time, q) in found {
    ///     assert!((q - time.cos()).abs() < 1e-6);
    /// }
    /// assert_eq!((integrator.state().time, integrator.steps()), (1.25, 5));
    /// # Ok(())
    /// # }
    /// ```
    pub fn integrate_at<F: FnMut(&State<V>)>(
        &mut self,
        times: &[f64],
        mut observe: F,
    ) -> Result<&State<V>, Error> {
        integrate_at(self, times, &mut observe)?;
        Ok(self.state())
    }
}

/// [`Integrator::integrate_at`] for constant and variable step sizes.
pub(crate) fn integrate_at<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>>(
    steps: &mut impl Steps<M, S, V, R, N>,
    times: &[f64],
    observe: &mut impl FnMut(&State<V>),
) -> Result<(), Error> {
    check(steps, times)?;
    let direction = steps.direction();
    let mut rest = times;
    let mut output = Output::new(steps.integrator(), direction);
    output.show(steps.integrator(), &mut rest, observe)?;
    while let Some(&time) = rest.first() {
        steps.steps_before(time)?;
        steps.step_in_sight(|integrator| output.show(integrator, &mut rest, observe))?;
    }
    Ok(())
}

/// Checks the times of [`integrate_at`].
pub(crate) fn check<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>>(
    steps: &impl Steps<M, S, V, R, N>,
    times: &[f64],
) -> Result<(), Error> {
    let before = steps.start_of_last_step();
    steps.check_count(check_times(steps.direction(), times, before, None)?)
}

/// Checks that the times are finite and ordered, from `before` to `end`, and returns the last of them.
pub(crate) fn check_times(
    direction: f64,
    times: &[f64],
    mut before: f64,
    end: Option<f64>,
) -> Result<f64, Error> {
    for &time in times {
        if !time.is_finite() || is_after(direction, before, time) {
            return Err(Error::OutputTime { time, before });
        }
        if let Some(end) = end
            && is_after(direction, time, end)
        {
            return Err(Error::OutputAfterEnd { time, end });
        }
        before = time;
    }
    Ok(before)
}

/// Storage for states inside a step.
pub(crate) struct Output<V> {
    ends: Ends<V>,
    /// Whether `ends` belongs to the last step.
    pub(crate) evaluated: bool,
    pub(crate) state: State<V>,
    /// The sign of the step size.
    direction: f64,
}

impl<V: Vector> Output<V> {
    /// Storage for states like the present one of an integrator; `direction` has the sign of the step size.
    pub(crate) fn new<M: Method, S: System<V>, R: Summation, N: Solver<V, S>>(
        integrator: &Integrator<M, S, V, R, N>,
        direction: f64,
    ) -> Self {
        Self {
            ends: Ends::new(),
            evaluated: false,
            state: integrator.state().clone(),
            direction,
        }
    }

    /// Whether `time` comes after `other` in the direction of the steps.
    pub(crate) fn is_after(&self, time: f64, other: f64) -> bool {
        is_after(self.direction, time, other)
    }

    /// Sets `state` to the state at a time inside the last step.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn look_at<M: Method, S: System<V>, R: Summation, N: Solver<V, S>>(
        &mut self,
        integrator: &Integrator<M, S, V, R, N>,
        time: f64,
    ) -> Result<(), Error> {
        if !self.evaluated {
            self.ends.evaluate(integrator)?;
            self.evaluated = true;
        }
        let State { q, p, .. } = &mut self.state;
        self.ends.write(integrator, time, q, p)?;
        self.state.time = time;
        Ok(())
    }

    /// [`look_at`](Self::look_at) for runs side by side, in the registers of their lanes.
    #[cfg(feature = "alloc")]
    pub(crate) fn look_together<M: Method, S: System<V>, R: Summation, N: Solver<V, S>>(
        &mut self,
        integrator: &Integrator<M, S, V, R, N>,
        time: f64,
    ) -> Result<(), Error> {
        V::Scalar::in_registers(Look {
            output: self,
            integrator,
            time,
        })
    }

    /// Removes the output times up to the time `present` from the list.
    #[cfg(feature = "alloc")]
    pub(crate) fn skip(&self, times: &mut &[f64], present: f64) {
        let seen = (times.iter()).take_while(|&&time| !self.is_after(time, present));
        *times = &times[seen.count()..];
    }

    /// Observes the states at the output times up to the present time and removes these times from the list.
    pub(crate) fn show<M: Method, S: System<V>, R: Summation, N: Solver<V, S>>(
        &mut self,
        integrator: &Integrator<M, S, V, R, N>,
        times: &mut &[f64],
        observe: &mut impl FnMut(&State<V>),
    ) -> Result<(), Error> {
        self.evaluated = false;
        while let Some((&time, rest)) = times.split_first() {
            let present = integrator.state();
            if self.is_after(time, present.time) {
                break;
            }
            if time == present.time {
                observe(present);
            } else {
                self.look_at(integrator, time)?;
                observe(&self.state);
            }
            *times = rest;
        }
        Ok(())
    }
}

/// A look at a time inside a step.
#[cfg(feature = "alloc")]
struct Look<'a, V, T> {
    output: &'a mut Output<V>,
    integrator: &'a T,
    time: f64,
}

#[cfg(feature = "alloc")]
impl<M, S, V, R, N> Work for Look<'_, V, Integrator<M, S, V, R, N>>
where
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    type Output = Result<(), Error>;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> Self::Output {
        self.output.look_at(self.integrator, self.time)
    }
}
