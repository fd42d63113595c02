//! Events: sign changes of a function of the state.

use crate::state::State;

mod list;
mod locate;
pub(crate) mod run;
mod scan;
mod search;
mod track;

pub use list::Events;

/// An event function g of the state; its sign changes are the events.
///
/// # Which zeros are found
///
/// g is evaluated after every step. If its sign has changed, the step has an event.
///
/// 1. A step is passed over if g at both of its ends exceeds four times its largest change in this step and in the one before.
/// 2. Otherwise g is evaluated on the [dense output](crate::Integrator#method.dense) at 2, 4 and 8 points. The step is passed over as soon
///    as all values exceed four times the largest change between neighbouring points.
/// 3. Otherwise the derivatives of g along the flow and the values show where g may turn. If it may turn within twice that change from
///    zero, or if the values change sign more than once, steps of the method decide: from the start of the step to each point.
///
/// In a search by steps, a step consists of four panels. g is evaluated at the start, the middle and the end of each. If the three signs
/// agree but g may have an extremum nearer to zero, the extremum is located by Brent's method; if g has the other sign there, the zeros on
/// both sides are events.
///
/// So two zeros about an extremum are found down to a distance of about 1e-5 of a panel, up to the accuracy of the method. There are three
/// conditions: g has at most one extremum in a panel; it deviates from the values at neighbouring points by less than four times their largest change; and a
/// step is shorter than 0.45 of the period of every oscillation of g. A step whose stages need more than eight sweeps is evaluated at 8 points
/// in any case, since it may contain a whole oscillation. So is the first step. Explicit methods and Newton's iteration have no such sign of
/// long steps: give [`samples`](Self::samples) if steps are longer.
///
/// The search can miss
///
/// * two zeros, or any even number, of a g that varies much faster than the motion: give [`samples`](Self::samples);
/// * two zeros closer than about 1e-5 of a panel;
/// * a zero without a sign change.
///
/// Zeros are located by Brent's method to rounding: on the dense output, or by steps of the method where these decide, and for an event
/// [`by_steps`](Self::by_steps).
///
/// # The state at an event
///
/// The state at an event is the last state before the zero, to rounding: g is zero there or still has its old sign. So
/// the state at a [`wall`](Self::wall) never lies behind the wall.
///
/// # A start on zero
///
/// If g is zero at the start of a search, its sign there is that of its derivative along the flow. So the start is not an event, and the
/// next zero is found even if it is close. For example, a ball thrown up from the floor may land within the first step.
///
/// A search from the last event (after [`set_state`](crate::Integrator::set_state) with its state, changed or not) also starts on zero,
/// whatever value g has by rounding. If the new state reverses the sign of dg/dt, the next zero is found. If g continues through zero, the
/// event is not found again. If the derivative is zero, the search assumes that g turns back.
///
/// # Impacts that accumulate
///
/// The search cannot resolve flights shorter than the resolution of time, a g within its rounding error, or a state at rest on the zero. It
/// then ends with [`Error::EventsAccumulate`](crate::Error::EventsAccumulate), at the state of the last event.
///
/// So does a search that has found a thousand events in a row, each at most 1/16384 of a step after the one before. A body at rest on a
/// wall makes such short flights if the handler only reflects it. Events that are not walls and at which the handler changes nothing do not
/// count. If that many events are real, take smaller steps.
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

/// Which sign changes of a function are events, and how they are located.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// Whether a change from minus to plus is an event, and a change from plus to minus.
    directions: [bool; 2],
    /// Number of points at which every step is sampled, if given.
    samples: Option<u32>,
    by_steps: bool,
    wall: bool,
}

impl Kind {
    const fn new(directions: [bool; 2]) -> Self {
        Self {
            directions,
            samples: None,
            by_steps: false,
            wall: false,
        }
    }

    /// Whether a change from the sign `side` is an event.
    fn matches(&self, side: f64) -> bool {
        self.directions[usize::from(side > 0.0)]
    }
}

impl<G> Event<G> {
    const fn new(function: G, directions: [bool; 2]) -> Self {
        let kind = Kind::new(directions);
        Self { function, kind }
    }

    /// Events where the function changes from minus to plus, in the direction of the steps.
    pub const fn rising(function: G) -> Self {
        Self::new(function, [true, false])
    }

    /// Events where the function changes from plus to minus, in the direction of the steps.
    pub const fn falling(function: G) -> Self {
        Self::new(function, [false, true])
    }

    /// Events at every sign change of the function.
    pub const fn crossing(function: G) -> Self {
        Self::new(function, [true, true])
    }

    /// A wall, which keeps the state at g ≥ 0. An event is a change from plus to minus, in the direction of the steps.
    ///
    /// A wall differs from [`falling`](Self::falling) in three ways. It is located [by steps](Self::by_steps), because the run continues
    /// from the state there. A start at g ≤ 0 is an event at once unless g rises above zero. The integration does not continue behind the
    /// wall: after an event the present state is the state that the handler leaves. The handler has to reflect it. A handler that lets the
    /// state continue into the wall receives the same event again, until [`Error::EventsAccumulate`](crate::Error::EventsAccumulate), or
    /// [`Error::BehindWall`](crate::Error::BehindWall) if g is negative.
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
        event.by_steps()
    }

    /// Evaluates g in every step at this number of points, including its end. By default it is evaluated at eight points, in steps near
    /// events only. Two points make a panel, so an odd number counts as the next even number. 0 counts as 1, and more than 2²⁰ as 2²⁰; 1
    /// samples the end only, for sign changes. Of several events in one search the largest number applies to all.
    #[must_use]
    pub fn samples(mut self, samples: u32) -> Self {
        self.kind.samples = Some(samples.clamp(1, 1 << 20));
        self
    }

    /// Locates the zero by steps of the method from the start of the step that contains it, about ten per event. The
    /// state at the event then has the order of the method, whatever the order of the dense output.
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

/// What [`integrate_through`](crate::Integrator::integrate_through) passes to its handler, in order of time.
#[derive(Debug)]
pub enum Moment<'a, V> {
    /// The state at the next output time.
    Output(&'a State<V>),
    /// The state at an event.
    Event {
        /// Index of the event in the list, from 0.
        index: usize,
        /// The state. The handler may change it, except its time.
        state: &'a mut State<V>,
    },
}
