//! Dense output: the state at any time inside the last step.

use core::fmt;

use crate::error::{Error, Quantity};
use crate::integrator::partial_step::PartialSteps;
use crate::integrator::{DenseSteps, Integrator, Partitioned, Stepper};
use crate::method::storage::is_finite;
use crate::method::{Inside, Interpolation, Method, Solver};
use crate::number::{Compensated, Scalar, Summation, Vector, copy};
use crate::solver::FixedPoint;
use crate::state::State;
use crate::system::System;

/// Dense output of the last step, returned by [`Integrator::dense`].
///
/// Position and momentum are polynomials in time. They interpolate the states at both ends exactly (bit for bit); their
/// order is [`Integrator::INTERPOLATION`]. They are evaluated on demand.
///
/// ```
/// symplectic::tableau! { Gauss4 { basis: polynomial(4), nodes: gauss(4) } }
/// use symplectic::nalgebra::Vector1;
/// use symplectic::{Error, Integrator, State, acceleration};
///
/// # fn main() -> Result<(), Error> {
/// let oscillator = acceleration::<Vector1<f64>, _>(|_, q, acceleration| *acceleration = -q);
/// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(0.0));
/// let mut integrator = Integrator::new(Gauss4, oscillator, start, 0.125)?;
/// integrator.step()?;
/// let dense = integrator.dense()?;
/// let state = dense.state(0.1)?;
/// assert!((state.q[0] - 0.1_f64.cos()).abs() < 1e-7);
/// // The same without an allocation for dynamic vectors.
/// let (mut q, mut p) = (Vector1::zeros(), Vector1::zeros());
/// dense.write(0.1, &mut q, &mut p)?;
/// assert_eq!((q, p), (state.q, state.p));
/// assert_eq!(dense.state(0.125)?, *integrator.state());
/// # Ok(())
/// # }
/// ```
pub struct DenseOutput<
    'a,
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation = Compensated,
    N: Solver<V, S> = FixedPoint,
> {
    stepper: &'a Partitioned<M, S, V, R, N>,
    ends: Ends<V>,
}

/// Derivatives at both ends of a step, for Hermite interpolation only. The storage is reused for later steps.
pub(crate) struct Ends<V>(Option<[Derivatives<V>; 2]>);

struct Derivatives<V> {
    velocity: V,
    force: V,
}

impl<V: Vector> Ends<V> {
    pub(crate) const fn new() -> Self {
        Self(None)
    }

    /// Evaluates the derivatives for the last step of a stepper.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn evaluate<M: Method, S: System<V>, R: Summation, N: Solver<V, S>>(
        &mut self,
        stepper: &Partitioned<M, S, V, R, N>,
    ) -> Result<(), Error> {
        let last = stepper.last_step().ok_or(Error::NoStep)?;
        if Integrator::<M, S, V, R, N>::INTERPOLATION != Interpolation::Hermite {
            return Ok(());
        }
        let ends = self.0.get_or_insert_with(|| {
            core::array::from_fn(|_| Derivatives {
                velocity: stepper.state().q.zeros_like(),
                force: stepper.state().p.zeros_like(),
            })
        });
        let states = [
            (last.start, last.positions.start.0, last.momenta.start.0),
            (last.end, last.positions.end.0, last.momenta.end.0),
        ];
        for ((time, q, p), Derivatives { velocity, force }) in states.into_iter().zip(ends) {
            let at = V::Scalar::from_f64(time);
            stepper.system().velocity(at, q, p, velocity);
            stepper.momentum_rate(time, q, p, force);
            for (what, value) in [(Quantity::Velocity, velocity), (Quantity::Force, force)] {
                if value.dimension() != q.dimension() {
                    return Err(Error::ResizedEvaluation {
                        time,
                        what,
                        expected: q.dimension(),
                        found: value.dimension(),
                    });
                }
                if !is_finite(value) {
                    return Err(Error::NonFinite {
                        time,
                        step_size: last.size,
                        step: stepper.statistics().steps,
                        what,
                        stage: None,
                    });
                }
            }
        }
        Ok(())
    }

    /// Writes the state at a time inside the last step, for which `evaluate` was called.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn write<M: Method, S: System<V>, R: Summation, N: Solver<V, S>>(
        &self,
        stepper: &Partitioned<M, S, V, R, N>,
        time: f64,
        q: &mut V,
        p: &mut V,
    ) -> Result<(), Error> {
        let last = stepper.last_step().ok_or(Error::NoStep)?;
        let (start, end) = (last.start, last.end);
        if !(start.min(end) <= time && time <= start.max(end)) {
            return Err(Error::OutsideStep { time, start, end });
        }
        let (dimension, found) = (
            stepper.state().q.dimension(),
            (q.dimension(), p.dimension()),
        );
        if found != (dimension, dimension) {
            return Err(Error::Dimension {
                position: found.0,
                momentum: found.1,
            });
        }
        let at = Inside {
            fraction: (time - start) / (end - start),
            size: last.size,
            momentum: last.momenta.start.0,
        };
        q.as_mut_slice().fill(num_traits::Zero::zero());
        p.as_mut_slice().fill(num_traits::Zero::zero());
        match &self.0 {
            Some([start, end]) => {
                at.add_cubic([&start.velocity, &end.velocity], &last.positions, q);
                at.add_cubic([&start.force, &end.force], &last.momenta, p);
            }
            None => stepper.extend(at, q, p),
        }
        last.positions.add(at.fraction, q);
        last.momenta.add(at.fraction, p);
        Ok(())
    }
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> Integrator<M, S, V, R, N> {
    /// Dense output of the last step, from its start to the present state.
    ///
    /// With [`Interpolation::Hermite`] the system is evaluated at both ends. With [`Retry`](crate::Retry) the last step
    /// may be a part of the requested step.
    ///
    /// # Errors
    ///
    /// [`Error::NoStep`] before the first step and after every call that discards it, such as a new state, another
    /// solver or a failed step. [`Error::NonFinite`] if a derivative at an end is not finite, [`Error::ResizedEvaluation`] if it has a
    /// wrong dimension.
    pub fn dense(&self) -> Result<DenseOutput<'_, M, S, V, R, N>, Error> {
        let mut ends = Ends::new();
        ends.evaluate(&self.stepper)?;
        Ok(DenseOutput {
            stepper: &self.stepper,
            ends,
        })
    }
}

/// Memory for states inside a step of a [`Partitioned`].
pub struct InsideSteps<M: Method, S: System<V>, V: Vector, N: Solver<V, S>> {
    ends: Ends<V>,
    partial: Option<PartialSteps<M, S, V, N>>,
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> DenseSteps
    for Partitioned<M, S, V, R, N>
{
    type Vector = V;
    type Scratch = InsideSteps<M, S, V, N>;

    fn scratch(&self) -> Self::Scratch {
        InsideSteps {
            ends: Ends::new(),
            partial: None,
        }
    }

    fn last_span(&self) -> Option<(f64, f64)> {
        self.last_step().map(|last| (last.start, last.end))
    }

    fn write_start(&self, out: &mut State<V>) {
        match self.last_step() {
            Some(last) => {
                out.time = last.start;
                copy(&mut out.q, last.positions.start.0);
                copy(&mut out.p, last.momenta.start.0);
            }
            None => out.copy_from(self.state()),
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn prepare(&self, scratch: &mut Self::Scratch) -> Result<(), Error> {
        scratch.ends.evaluate(self)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn look(
        &mut self,
        time: f64,
        scratch: &mut Self::Scratch,
        out: &mut State<V>,
    ) -> Result<(), Error> {
        scratch.ends.write(self, time, &mut out.q, &mut out.p)?;
        out.time = time;
        Ok(())
    }

    fn look_by_step(
        &mut self,
        time: f64,
        scratch: &mut Self::Scratch,
        out: &mut State<V>,
    ) -> Result<(), Error> {
        let partial = &mut scratch.partial;
        let partial = partial.get_or_insert_with(|| PartialSteps::of(self));
        partial.take(self, time, out)
    }

    fn slopes(&mut self, state: &State<V>, _size: f64, velocity: &mut V, force: &mut V) {
        let State { time, q, p } = state;
        (self.system()).velocity(V::Scalar::from_f64(*time), q, p, velocity);
        self.momentum_rate(*time, q, p, force);
    }
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>>
    DenseOutput<'_, M, S, V, R, N>
{
    /// Start time and end time of the step; the end is smaller if the step went backward.
    pub fn span(&self) -> (f64, f64) {
        let span = self.stepper.last_step();
        // `dense` checked that there is a last step, and the borrow keeps it.
        span.map_or((f64::NAN, f64::NAN), |last| (last.start, last.end))
    }

    /// Writes position and momentum at `time` into `q` and `p`, which have the dimension of the system.
    ///
    /// # Errors
    ///
    /// [`Error::OutsideStep`] if `time` is outside [`span`](Self::span), [`Error::Dimension`] if `q` or `p` has another
    /// dimension; `q` and `p` are then untouched.
    pub fn write(&self, time: f64, q: &mut V, p: &mut V) -> Result<(), Error> {
        self.ends.write(self.stepper, time, q, p)
    }

    /// The state at `time`.
    ///
    /// # Errors
    ///
    /// [`Error::OutsideStep`] if `time` is outside [`span`](Self::span).
    pub fn state(&self, time: f64) -> Result<State<V>, Error> {
        let State { q, p, .. } = self.stepper.state();
        let mut state = State::new(time, q.zeros_like(), p.zeros_like());
        self.write(time, &mut state.q, &mut state.p)?;
        Ok(state)
    }
}

impl<M: Method, S: System<V>, V: Vector, R: Summation, N: Solver<V, S>> fmt::Debug
    for DenseOutput<'_, M, S, V, R, N>
{
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("DenseOutput")
            .field("method", &M::NAME)
            .field("span", &self.span())
            .finish_non_exhaustive()
    }
}
