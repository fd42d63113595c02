//! Observers of conserved quantities.

use crate::number::{Vector, larger_or_nan};
use crate::state::State;
use crate::system::System;

/// An observer of a function of the state that the exact flow conserves, such as the energy or a momentum map.
///
/// It keeps the first value, the latest value and the largest deviation from the first one.
///
/// ```
/// symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
/// use symplectic::nalgebra::Vector2;
/// use symplectic::{Error, Integrator, Invariant, State, separable};
///
/// # fn main() -> Result<(), Error> {
/// let kepler = || {
///     separable(
///         |_time, p: &Vector2<f64>, velocity| *velocity = *p,
///         |_time, q, force| *force = -q / q.norm().powi(3),
///     )
///     .with_energy(|_time, q, p| p.norm_squared() / 2.0 - q.norm().recip())
/// };
/// let start = State::new(0.0, Vector2::new(0.4, 0.0), Vector2::new(0.0, 2.0));
/// let mut energy = Invariant::energy(kepler(), &start);
/// let mut angular_momentum = Invariant::new(|state: &State<Vector2<f64>>| state.q.perp(&state.p), &start);
/// let mut integrator = Integrator::new(Gauss2, kepler(), start, 0.0625)?;
/// integrator.integrate_with(100.0, |state| {
///     energy.observe(state);
///     angular_momentum.observe(state);
/// })?;
/// assert_eq!(angular_momentum.initial(), 0.8);
/// // Quadratic invariants are conserved by Gauss methods, the energy nearly.
/// assert!(angular_momentum.relative_deviation() < 1e-13);
/// assert!((1e-5..1e-2).contains(&energy.relative_deviation()));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Invariant<F> {
    function: F,
    initial: f64,
    last: f64,
    largest: f64,
}

impl<F> Invariant<F> {
    /// An observer of `function`, beginning with a state, of any type.
    pub fn new<T>(function: F, start: &T) -> Self
    where
        F: Fn(&T) -> f64,
    {
        let initial = function(start);
        Self {
            function,
            initial,
            last: initial,
            largest: 0.0,
        }
    }

    /// Observes a state.
    pub fn observe<T>(&mut self, state: &T)
    where
        F: Fn(&T) -> f64,
    {
        self.last = (self.function)(state);
        let deviation = (self.last - self.initial).abs();
        self.largest = larger_or_nan(self.largest, deviation);
    }

    /// The value at the first state.
    pub const fn initial(&self) -> f64 {
        self.initial
    }

    /// The value at the latest state.
    pub const fn last(&self) -> f64 {
        self.last
    }

    /// The largest distance from the first value so far; NaN if any value was NaN.
    pub const fn deviation(&self) -> f64 {
        self.largest
    }

    /// [`deviation`](Self::deviation), relative to the first value; the deviation itself if the first value is 0.
    ///
    /// ```
    /// use symplectic::Invariant;
    ///
    /// let mut momentum = Invariant::new(|p: &[f64; 2]| p[0] + p[1], &[1.0, -1.0]);
    /// momentum.observe(&[1.5, -1.5]);
    /// assert_eq!(momentum.relative_deviation(), 0.0);
    /// momentum.observe(&[1.5, -1.25]);
    /// assert_eq!(momentum.relative_deviation(), 0.25);
    /// ```
    pub fn relative_deviation(&self) -> f64 {
        self.largest / self.unit()
    }

    /// The latest value minus the first one, relative to the first one; the difference itself if the first value is 0.
    pub fn relative_error(&self) -> f64 {
        (self.last - self.initial) / self.unit()
    }

    /// The size of the first value, or 1 if it is 0.
    fn unit(&self) -> f64 {
        match self.initial == 0.0 {
            true => 1.0,
            false => self.initial.abs(),
        }
    }
}

impl Invariant<()> {
    /// An observer of the energy of `system`, in double precision; NaN if the system does not implement it.
    pub fn energy<V: Vector<Scalar = f64>, S: System<V>>(
        system: S,
        start: &State<V>,
    ) -> Invariant<impl Fn(&State<V>) -> f64 + use<V, S>> {
        let energy = move |state: &State<V>| {
            let energy = system.energy(state.time, &state.q, &state.p);
            energy.unwrap_or(f64::NAN)
        };
        Invariant::new(energy, start)
    }
}

/// An observer with the name of its quantity.
type Named<F> = (&'static str, Invariant<F>);

/// Observers of the conserved quantities of a system, with their names. `value` evaluates the quantity with a given number.
///
/// The method `invariants` of a system from a formula returns them.
#[doc(hidden)]
pub fn invariants<S: Clone, V, const COUNT: usize>(
    names: [&'static str; COUNT],
    system: &S,
    value: fn(&S, usize, &State<V>) -> f64,
    start: &State<V>,
) -> [Named<impl Fn(&State<V>) -> f64 + use<S, V, COUNT>>; COUNT] {
    let mut numbers = 0..;
    names.map(|name| {
        let (system, number) = (system.clone(), numbers.next().unwrap_or(COUNT));
        let function = move |state: &State<V>| value(&system, number, state);
        (name, Invariant::new(function, start))
    })
}
