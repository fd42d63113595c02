//! Events: where a function of the state changes its sign.

use crate::state::State;

mod list;
mod locate;
pub(crate) mod run;
mod search;
mod track;

pub use list::Events;

/// A function g of the state whose zeros are looked for.
///
/// # Which zeros are found
///
/// A step is looked at in panels, four unless [`samples`](Self::samples) says otherwise: g is evaluated on the
/// [dense output](crate::Integrator::dense) at the start, the middle and the end of each. A change of sign between
/// neighbours is an event, found by Brent's method to rounding. Where all three signs are the same, and the three values
/// and the slope at the end with the smallest one say that g has an extremum nearer to zero, the extremum is looked for:
/// if it is beyond zero, the zeros on both sides of it are events. So no zero is missed in a panel in which g has
/// at most one extremum, not further from the three values than four times their largest difference.
///
/// What can be missed: two zeros, or any even number, in a panel in which g has several extrema or a sharp one; two
/// zeros closer than about 1e-5 of a panel; a zero at which the sign does not change. Of three zeros between neighbours
/// one is found. More samples miss less.
///
/// # The state at an event
///
/// It is the last state before the zero, to rounding: g is zero there or still has the sign that it is about to
/// lose. So the state at a [`wall`](Self::wall) is never behind it.
///
/// # A start on zero
///
/// Where g is zero at the start of a search, it has the sign that it takes right after it, by its derivative along the flow.
/// So the start is no event, and a zero after it is found however soon: a ball thrown up from the floor comes down
/// again, perhaps within the first step.
///
/// A search from the event that was found last (after [`set_state`](crate::Integrator::set_state) with its state, changed or
/// not) starts on zero too, whatever g is by rounding. If the state was reset so that g turns round, the next zero is
/// found; if g goes on through zero, the event is not found again. Where the derivative is zero, g is to turn round.
///
/// # Impacts that accumulate
///
/// If g is to turn round, but is never seen to: because the flight is shorter than time can resolve or stays within the
/// rounding of g, or because the state is at rest on the zero: the search ends with
/// [`Error::EventsAccumulate`](crate::Error::EventsAccumulate), at the state of the last event. So does a search that has found a
/// thousand events at the same time.
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
    kind: Kind,
}

/// What is an event of a function, and how it is found.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// Whether a change to plus is one, and a change to minus.
    directions: [bool; 2],
    samples: u32,
    by_steps: bool,
    wall: bool,
}

impl Kind {
    const fn new(directions: [bool; 2]) -> Self {
        Self {
            directions,
            samples: 8,
            by_steps: false,
            wall: false,
        }
    }

    /// Whether a change from this sign is an event.
    fn wants(&self, side: f64) -> bool {
        self.directions[usize::from(side > 0.0)]
    }
}

impl<G> Event<G> {
    const fn new(function: G, directions: [bool; 2]) -> Self {
        let kind = Kind::new(directions);
        Self { function, kind }
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

    /// A wall, on which the state stays at g ≥ 0: where the function changes from plus to minus, in the direction of the
    /// steps.
    ///
    /// It differs from [`falling`](Self::falling) in two ways. A start at g ≤ 0 is an event at once unless g rises above
    /// zero. And an integration does not go on behind it: after the event the present state is that at the event, with
    /// what the handler makes of it. A handler that lets the state go on into the wall gets the same event again, until
    /// [`Error::EventsAccumulate`](crate::Error::EventsAccumulate).
    ///
    /// ```
    /// symplectic::tableau! { StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) } }
    /// # use symplectic::nalgebra::Vector1;
    /// # use symplectic::{Error, Event, Integrator, State, acceleration};
    /// # fn main() -> Result<(), Error> {
    /// // A ball that loses three tenths of its speed at every impact, for ten of them.
    /// let ball = acceleration::<Vector1<f64>, _>(|_, _, acceleration| acceleration[0] = -9.8);
    /// let start = State::new(0.0, Vector1::new(50.0), Vector1::new(0.0));
    /// let mut integrator = Integrator::new(StoermerVerlet, ball, start, 0.05)?;
    /// let floor = Event::wall(|state: &State<Vector1<f64>>| state.q[0]);
    /// let fall = (2.0_f64 * 50.0 / 9.8).sqrt();
    /// let mut expected = fall;
    /// for impact in 0..10 {
    ///     let mut state = integrator.find_event(40.0, &floor)?.expect("an impact");
    ///     assert!(state.q[0] >= 0.0 && (state.time - expected).abs() < 1e-12);
    ///     state.p[0] *= -0.7;
    ///     integrator.set_state(state)?;
    ///     expected += 2.0 * fall * 0.7_f64.powi(impact + 1);
    /// }
    /// # Ok(())
    /// # }
    /// ```
    pub const fn wall(function: G) -> Self {
        let mut event = Self::falling(function);
        event.kind.wall = true;
        event
    }

    /// Looks at this many places in every step, its end among them, instead of eight, in half as many panels. An odd
    /// number counts as the next even one; 0 counts as 1, and 1 looks at the end only, for changes of sign.
    #[must_use]
    pub fn samples(mut self, samples: u32) -> Self {
        self.kind.samples = samples.max(1);
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
        self.kind.by_steps = true;
        self
    }
}

/// What [`integrate_through`](crate::Integrator::integrate_through) shows, in the order of time.
#[derive(Debug)]
pub enum Moment<'a, V> {
    /// The state at the next output time.
    Output(&'a State<V>),
    /// The state at an event.
    Event {
        /// The number of the event in the list, from 0.
        index: usize,
        /// The state, which may be changed; its time is kept.
        state: &'a mut State<V>,
    },
}
