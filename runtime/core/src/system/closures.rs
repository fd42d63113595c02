//! Systems given by closures.

use core::fmt;
use core::marker::PhantomData;

use crate::contract::{General, Masses, Separable, System};
use crate::number::{Vector, copy};
use crate::solver::FixedPoint;
use crate::system::Named;

/// A separable system given by two closures, `|time, p, velocity| …` and `|time, q, force| …`, which write their result
/// into the last argument.
///
/// Name the type of the vector, in the call or at an argument; the rest is inferred:
///
/// ```
/// use symplectic::nalgebra::{Vector1, Vector2};
/// use symplectic::separable;
///
/// let oscillator = separable::<Vector1<f64>, _, _>(
///     |_time, p, velocity| velocity[0] = p[0],
///     |time, q, force| force[0] = time.cos() - q[0],
/// );
/// let kepler = separable(
///     |_time, p: &Vector2<f64>, velocity| *velocity = *p,
///     |_time, q, force| *force = -q / q.norm().powi(3),
/// )
/// .with_energy(|_time, q, p| p.norm_squared() / 2.0 - q.norm().recip());
/// # let (x, y) = (Vector1::new(1.0), Vector2::new(1.0, 0.0));
/// # symplectic::System::force(&oscillator, 0.0, &x, &x, &mut Vector1::new(0.0));
/// # symplectic::System::force(&kepler, 0.0, &y, &y, &mut Vector2::zeros());
/// ```
pub const fn separable<V: Vector, F: Fn(V::Scalar, &V, &mut V), G: Fn(V::Scalar, &V, &mut V)>(
    velocity: F,
    force: G,
) -> SeparableClosures<V, F, G> {
    Closures::new(velocity, force)
}

/// A second-order system `q'' = acceleration(t, q)` given by one closure, `|time, q, acceleration| …`, with `p = q'`.
///
/// It is the separable system `H = |p|²/2 + U(q)` with `acceleration = −∂U/∂q`. If the acceleration is not a gradient there
/// is no Hamiltonian, and energy is not conserved.
///
/// ```
/// use symplectic::acceleration;
/// use symplectic::nalgebra::Vector2;
///
/// let kepler = acceleration(|_time, q: &Vector2<f64>, acceleration| *acceleration = -q / q.norm().powi(3))
///     .with_energy(|_time, q, p| p.norm_squared() / 2.0 - q.norm().recip());
/// # let mut velocity = Vector2::zeros();
/// # let p = Vector2::new(1.0, 2.0);
/// # symplectic::System::velocity(&kepler, 0.0, &p, &p, &mut velocity);
/// # assert_eq!(velocity, Vector2::new(1.0, 2.0));
/// ```
pub const fn acceleration<V: Vector, G: Fn(V::Scalar, &V, &mut V)>(
    acceleration: G,
) -> SeparableClosures<V, Momentum, G> {
    Closures::new(Momentum, acceleration)
}

/// Replaces the velocity of a system in which the velocity is the momentum.
#[derive(Clone, Copy, Debug)]
pub struct Momentum;

/// A system with a general Hamiltonian, given by two closures, `|time, q, p, velocity| …` and `|time, q, p, force| …`, which write
/// their result into the last argument.
///
/// ```
/// use symplectic::hamiltonian;
/// use symplectic::nalgebra::Vector1;
///
/// // H = (q² + 1)(p² + 1)/2
/// let system = hamiltonian::<Vector1<f64>, _, _>(
///     |_time, q, p, velocity| velocity[0] = p[0] * (q[0] * q[0] + 1.0),
///     |_time, q, p, force| force[0] = -q[0] * (p[0] * p[0] + 1.0),
/// )
/// .with_energy(|_time, q, p| (q[0] * q[0] + 1.0) * (p[0] * p[0] + 1.0) / 2.0);
/// # symplectic::System::energy(&system, 0.0, &Vector1::new(1.0), &Vector1::new(0.0));
/// ```
pub const fn hamiltonian<V, F, G>(velocity: F, force: G) -> HamiltonianClosures<V, F, G>
where
    V: Vector,
    F: Fn(V::Scalar, &V, &V, &mut V),
    G: Fn(V::Scalar, &V, &V, &mut V),
{
    Closures::new(velocity, force)
}

/// The result of [`separable`].
pub type SeparableClosures<V, F, G, E = NoEnergy> = Closures<V, F, G, E, Separable>;

/// The result of [`hamiltonian`].
pub type HamiltonianClosures<V, F, G, E = NoEnergy> = Closures<V, F, G, E, General>;

/// A system of class `C` given by closures for its velocity, force and energy.
#[derive(Clone, Copy)]
pub struct Closures<V, F, G, E, C> {
    velocity: F,
    force: G,
    energy: E,
    kind: PhantomData<fn(V) -> C>,
}

/// Replaces the energy of a system without a given energy.
#[derive(Clone, Copy, Debug)]
pub struct NoEnergy;

impl<V, F, G, C> Closures<V, F, G, NoEnergy, C> {
    const fn new(velocity: F, force: G) -> Self {
        Self {
            velocity,
            force,
            energy: NoEnergy,
            kind: PhantomData,
        }
    }

    /// The same system, with its Hamiltonian `|time, q, p| …`.
    pub fn with_energy<E>(self, energy: E) -> Closures<V, F, G, E, C>
    where
        V: Vector,
        E: Fn(V::Scalar, &V, &V) -> V::Scalar,
    {
        let Self {
            velocity,
            force,
            kind,
            ..
        } = self;
        Closures {
            velocity,
            force,
            energy,
            kind,
        }
    }
}

impl<V, F, G, E, C> Named for Closures<V, F, G, E, C> {}

impl<V: Vector, F: Velocity<V>, G: Fn(V::Scalar, &V, &mut V), E: Energy<V>> System<V>
    for SeparableClosures<V, F, G, E>
{
    type Class = Separable;
    type Solver = FixedPoint;

    const MASSES: Masses = F::MASSES;
    const WELL_DECLARED: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn velocity(&self, time: V::Scalar, _q: &V, p: &V, velocity: &mut V) {
        self.velocity.write(time, p, velocity);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn force(&self, time: V::Scalar, q: &V, _p: &V, force: &mut V) {
        (self.force)(time, q, force);
    }

    fn energy(&self, time: V::Scalar, q: &V, p: &V) -> Option<V::Scalar> {
        self.energy.evaluate(time, q, p)
    }
}

impl<V: Vector, F: Fn(V::Scalar, &V, &V, &mut V), G: Fn(V::Scalar, &V, &V, &mut V), E: Energy<V>>
    System<V> for HamiltonianClosures<V, F, G, E>
{
    type Class = General;
    type Solver = FixedPoint;

    const WELL_DECLARED: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn velocity(&self, time: V::Scalar, q: &V, p: &V, velocity: &mut V) {
        (self.velocity)(time, q, p, velocity);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn force(&self, time: V::Scalar, q: &V, p: &V, force: &mut V) {
        (self.force)(time, q, p, force);
    }

    fn energy(&self, time: V::Scalar, q: &V, p: &V) -> Option<V::Scalar> {
        self.energy.evaluate(time, q, p)
    }
}

impl<V, F, G, E, C> fmt::Debug for Closures<V, F, G, E, C> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("Closures").finish_non_exhaustive()
    }
}

mod parts {
    use super::{Masses, Momentum, NoEnergy, Vector, copy};

    /// A closure for the velocity, or the momentum.
    pub trait Velocity<V: Vector> {
        const MASSES: Masses;

        fn write(&self, time: V::Scalar, p: &V, velocity: &mut V);
    }

    impl<V: Vector> Velocity<V> for Momentum {
        const MASSES: Masses = Masses::Unit;

        #[cfg_attr(not(debug_assertions), inline(always))]
        fn write(&self, _time: V::Scalar, p: &V, velocity: &mut V) {
            copy(velocity, p);
        }
    }

    impl<V: Vector, F: Fn(V::Scalar, &V, &mut V)> Velocity<V> for F {
        const MASSES: Masses = Masses::Any;

        #[cfg_attr(not(debug_assertions), inline(always))]
        fn write(&self, time: V::Scalar, p: &V, velocity: &mut V) {
            self(time, p, velocity);
        }
    }

    /// A closure for the energy, or none.
    pub trait Energy<V: Vector> {
        fn evaluate(&self, time: V::Scalar, q: &V, p: &V) -> Option<V::Scalar>;
    }

    impl<V: Vector> Energy<V> for NoEnergy {
        fn evaluate(&self, _time: V::Scalar, _q: &V, _p: &V) -> Option<V::Scalar> {
            None
        }
    }

    impl<V: Vector, E: Fn(V::Scalar, &V, &V) -> V::Scalar> Energy<V> for E {
        fn evaluate(&self, time: V::Scalar, q: &V, p: &V) -> Option<V::Scalar> {
            Some(self(time, q, p))
        }
    }
}
use parts::{Energy, Velocity};
