//! Observers of conserved quantities.

use num_traits::One;

use crate::number::{Scalar, Vector, larger_or_nan};
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
    /// What relative deviations are relative to.
    unit: f64,
}

impl<F> Invariant<F> {
    /// An observer of `function`, beginning with a state, of any type.
    pub fn new<T>(function: F, start: &T) -> Self
    where
        F: Fn(&T) -> f64,
    {
        let initial = function(start);
        let unit = if initial == 0.0 { 1.0 } else { initial.abs() };
        Self {
            function,
            initial,
            last: initial,
            largest: 0.0,
            unit,
        }
    }

    /// As [`new`](Self::new), but if the first value is nothing but rounding, deviations are relative to its terms: see [`unit_of`].
    pub fn of_state<V: Vector>(function: F, start: &State<V>) -> Self
    where
        F: Fn(&State<V>) -> f64,
    {
        let unit = unit_of(&function, start);
        Self {
            unit,
            ..Self::new(function, start)
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

    /// [`deviation`](Self::deviation), relative to the first value; the deviation itself if the first value is 0. For a function of
    /// the [state](Self::of_state), relative to the terms of the first value if that is nothing but rounding.
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
        self.largest / self.unit
    }

    /// The latest value minus the first one, relative to the first one; the difference itself if the first value is 0.
    pub fn relative_error(&self) -> f64 {
        (self.last - self.initial) / self.unit
    }
}

/// Its multiples have different fractional parts.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// What the deviations of a function of the state are relative to: the size of its value at the start, or the size of its terms if that
/// value consists of their rounding errors, as on a separatrix or a parabolic orbit; 1 if both are 0.
///
/// The size of the terms is not known from the value. It is estimated by how much the value changes if the positions, or the momenta,
/// change by an eighth and less, each component by another part so that opposite terms do not cancel. A value is rounding if it is below
/// 64 ε of this, with the ε of the scalars; else it is the unit, whatever its terms.
///
/// ```
/// use symplectic::State;
/// use symplectic::nalgebra::Vector1;
/// use symplectic::output::unit_of;
///
/// let energy = |state: &State<Vector1<f64>>| state.p[0] * state.p[0] / 2.0 - 1.0 / state.q[0];
/// let escape = 2.0_f64.sqrt();
/// let parabola = State::from_arrays(0.0, [1.0], [escape]);
/// assert!(energy(&parabola).abs() < 1e-15);
/// assert!((0.1..1.0).contains(&unit_of(energy, &parabola)));
/// let ellipse = State::from_arrays(0.0, [1.0], [1.0]);
/// assert_eq!(unit_of(energy, &ellipse), 0.5);
/// ```
pub fn unit_of<V: Vector>(function: impl Fn(&State<V>) -> f64, start: &State<V>) -> f64 {
    let value = function(start);
    let change = |half: fn(&mut State<V>) -> &mut V| {
        let mut near = start.clone();
        for (i, x) in half(&mut near).as_mut_slice().iter_mut().enumerate() {
            let part = 0.125 / (1.0 + 3.0 * ((i as f64 * GOLDEN) % 1.0));
            *x *= V::Scalar::one() - V::Scalar::from_f64(part);
        }
        let change = (function(&near) - value).abs();
        if change.is_finite() { change } else { 0.0 }
    };
    let terms = change(|state| &mut state.q) + change(|state| &mut state.p);
    match value.abs() {
        value if value == 0.0 && terms == 0.0 => 1.0,
        value if value <= 64.0 * V::Scalar::EPSILON * terms => terms,
        value => value,
    }
}

impl Invariant<()> {
    /// An observer of the energy of `system`, in double precision; NaN if the system does not implement it. If the first value is nothing
    /// but rounding, deviations are relative to its terms: see [`unit_of`].
    pub fn energy<V: Vector<Scalar = f64>, S: System<V>>(
        system: S,
        start: &State<V>,
    ) -> Invariant<impl Fn(&State<V>) -> f64 + use<V, S>> {
        let energy = move |state: &State<V>| {
            let energy = system.energy(state.time, &state.q, &state.p);
            energy.unwrap_or(f64::NAN)
        };
        Invariant::of_state(energy, start)
    }
}

/// An observer with the name of its quantity.
type Named<F> = (&'static str, Invariant<F>);

/// Observers of the conserved quantities of a system, with their names. `value` evaluates the quantity with a given number.
///
/// The method `invariants` of a system from a formula returns them.
#[doc(hidden)]
pub fn invariants<S: Clone, V: Vector, const COUNT: usize>(
    names: [&'static str; COUNT],
    system: &S,
    value: fn(&S, usize, &State<V>) -> f64,
    start: &State<V>,
) -> [Named<impl Fn(&State<V>) -> f64 + use<S, V, COUNT>>; COUNT] {
    let mut numbers = 0..;
    names.map(|name| {
        let (system, number) = (system.clone(), numbers.next().unwrap_or(COUNT));
        let function = move |state: &State<V>| value(&system, number, state);
        (name, Invariant::of_state(function, start))
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector2;

    use super::*;

    type Pair = State<Vector2<f64>>;

    fn state(q: [f64; 2], p: [f64; 2]) -> Pair {
        State::from_arrays(0.0, q, p)
    }

    /// Energies that are 0 except for rounding, and the size of their terms.
    #[test]
    fn a_value_that_is_rounding_has_the_unit_of_its_terms() {
        let kepler = |s: &Pair| s.p.norm_squared() / 2.0 - 1.0 / s.q.norm();
        let pendulum = |s: &Pair| s.p[0] * s.p[0] / 2.0 - s.q[0].cos() - 1.0;
        let light = |s: &Pair| (s.p[1] * s.p[1] - s.p[0] * s.p[0]) / 2.0;
        let momentum = |s: &Pair| s.q.perp(&s.p);
        let third = 1.0_f64 / 3.0;
        let escape = (2.0 / 0.7_f64).sqrt();
        let top = std::f64::consts::PI;
        type Function<'a> = &'a dyn Fn(&Pair) -> f64;
        let cases: [(Function<'_>, Pair); 4] = [
            (&kepler, state([0.42, 0.56], [-0.8 * escape, 0.6 * escape])),
            (&pendulum, state([top, 0.0], [0.0, 0.0])),
            (&light, state([1.0, 2.0], [1.0, 1.0])),
            (&momentum, state([0.1, 0.3], [third, 1.0])),
        ];
        for (number, (function, start)) in cases.iter().enumerate() {
            let unit = unit_of(function, start);
            assert!(function(start).abs() < 1e-15, "{number}");
            assert!((0.01..3.0).contains(&unit), "{number}: {unit}");
        }
    }

    #[test]
    fn a_value_above_its_rounding_is_its_own_unit() {
        let energy = |s: &Pair| s.p.norm_squared() / 2.0 - 1.0 / s.q.norm();
        for p in [0.0, 1.0, 1.42, 1.5, 1e3] {
            let start = state([1.0, 0.0], [0.0, p]);
            assert_eq!(unit_of(energy, &start), energy(&start).abs());
        }
        // At an equilibrium nothing is known of the terms.
        let rest = state([0.0; 2], [0.0; 2]);
        assert_eq!(unit_of(|s: &Pair| s.q.norm_squared(), &rest), 1.0);
    }
}
