//! A system over one type of vectors, as a step evaluates it.

use num_traits::Zero;

#[cfg(feature = "alloc")]
use crate::contract::Jacobian;
use crate::contract::{Class, LaneWork, Masses, Solver};
use crate::error::Error;
use crate::number::{
    F64x2, F64x4, F64x8, Lanes, Scalar, Vector, WideF64x4, WideF64x8, WidestF64x8,
};

/// A Hamiltonian system over one type of vectors, as an [`Integrator`](crate::Integrator) steps it.
///
/// Every [`Hamiltonian`](crate::Hamiltonian) and [`SeparableHamiltonian`](crate::SeparableHamiltonian) implements it over its vectors of
/// any scalar, and so do closures. Implement it by hand only for a system that a single scalar type can evaluate, for example one that calls a library for
/// doubles. Its coupled stages are then computed one by one.
///
/// ```
/// use symplectic::nalgebra::DVector;
/// use symplectic::solver::FixedPoint;
/// use symplectic::{Separable, System};
///
/// /// H = |p|²/2 + |q|²/2
/// struct Oscillators;
///
/// impl System<DVector<f64>> for Oscillators {
///     type Class = Separable;
///     type Solver = FixedPoint;
///
///     fn velocity(&self, _time: f64, _q: &DVector<f64>, p: &DVector<f64>, velocity: &mut DVector<f64>) {
///         velocity.copy_from(p);
///     }
///
///     fn force(&self, _time: f64, q: &DVector<f64>, _p: &DVector<f64>, force: &mut DVector<f64>) {
///         force.zip_apply(q, |force, q| *force = -q);
///     }
/// }
/// ```
///
/// # Separable systems
///
/// With `type Class = Separable` the velocity must not read `q`, and the force must not read `p`: these arguments are arbitrary vectors.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a Hamiltonian system over the vectors `{V}`",
    label = "implement `SeparableHamiltonian`, or `Hamiltonian` with `type Class = General`"
)]
pub trait System<V: Vector>: Sized {
    /// The class of the Hamiltonian: see [`Class`].
    type Class: Class;

    /// The solver of coupled stages unless another solver is [named](crate::Integrator::with_solver):
    /// [`FixedPoint`](crate::solver::FixedPoint), or [`Automatic`](crate::solver::Automatic) for a system that is defined over
    /// every scalar.
    type Solver: Solver<V, Self>;

    /// Declaration about the masses: see [`SeparableHamiltonian::MASSES`](crate::SeparableHamiltonian::MASSES).
    const MASSES: Masses = Masses::Any;

    /// Whether everything is inlined: see [`Hamiltonian::INLINED`](crate::Hamiltonian::INLINED).
    const INLINED: bool = false;

    /// Whether the second half of the positions is a displacement of the first, as in `tangent::Tangent`. Monitors of
    /// step sizes ignore the second half.
    const DISPLACED: bool = false;

    /// Writes ∂H/∂p at `(time, q, p)` into `velocity`.
    fn velocity(&self, time: V::Scalar, q: &V, p: &V, velocity: &mut V);

    /// Whether the force has a part without a potential: see [`Hamiltonian::applied_force`](crate::Hamiltonian::applied_force).
    const FORCED: bool = false;

    /// Whether [`FORCED`](Self::FORCED) and the class are certainly right. In a separable system the velocity does not read the position,
    /// and the force does not read the momentum. Otherwise an integrator tests this when it is created.
    #[doc(hidden)]
    const WELL_DECLARED: bool = false;

    /// Writes −∂H/∂q at `(time, q, p)`, plus the [applied force](Self::applied_force), into `force`.
    fn force(&self, time: V::Scalar, q: &V, p: &V, force: &mut V);

    /// Whether there is a [`force_gradient`](Self::force_gradient), which methods with gradient kicks need.
    const FORCE_GRADIENT: bool = false;

    /// Writes the force gradient into `gradient`: see [`SeparableHamiltonian::force_gradient`](crate::SeparableHamiltonian::force_gradient).
    fn force_gradient(&self, _time: V::Scalar, _q: &V, _force: &V, gradient: &mut V) {
        gradient.as_mut_slice().fill(V::Scalar::from_f64(f64::NAN));
    }

    /// Velocity and force at once, with the same bits: see [`Hamiltonian::slopes`](crate::Hamiltonian::slopes).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes(&self, time: V::Scalar, q: &V, p: &V, (velocity, force): (&mut V, &mut V)) {
        self.velocity(time, q, p, velocity);
        self.force(time, q, p, force);
    }

    /// [`velocity`](Self::velocity) at every stage, with the same bits; `at` returns the time, the positions and the momenta of a stage.
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn velocities<'a>(&self, at: impl Fn(usize) -> (V::Scalar, &'a V, &'a V), velocities: &mut [V])
    where
        V: 'a,
    {
        for (stage, velocity) in velocities.iter_mut().enumerate() {
            let (time, q, p) = at(stage);
            self.velocity(time, q, p, velocity);
        }
    }

    /// [`force`](Self::force) at every stage: see [`velocities`](Self::velocities).
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn forces<'a>(&self, at: impl Fn(usize) -> (V::Scalar, &'a V, &'a V), forces: &mut [V])
    where
        V: 'a,
    {
        for (stage, force) in forces.iter_mut().enumerate() {
            let (time, q, p) = at(stage);
            self.force(time, q, p, force);
        }
    }

    /// H at `(time, q, p)`, if the system provides it. No method needs it.
    fn energy(&self, _time: V::Scalar, _q: &V, _p: &V) -> Option<V::Scalar> {
        None
    }

    /// Writes the part of the force without a potential: see [`Hamiltonian::applied_force`](crate::Hamiltonian::applied_force).
    fn applied_force(&self, _time: V::Scalar, _q: &V, _p: &V, applied: &mut V) {
        applied.as_mut_slice().fill(V::Scalar::zero());
    }

    /// Writes the second derivatives of H into `jacobian`, if the system provides them: see
    /// [`Hamiltonian::second_derivatives`](crate::Hamiltonian::second_derivatives).
    #[cfg(feature = "alloc")]
    fn second_derivatives(
        &self,
        _time: V::Scalar,
        _q: &V,
        _p: &V,
        _jacobian: &mut Jacobian<V::Scalar>,
    ) -> bool {
        false
    }

    /// The largest `|i − j|` of components that interact: see [`Hamiltonian::half_bandwidth`](crate::Hamiltonian::half_bandwidth).
    fn half_bandwidth(&self) -> usize {
        usize::MAX
    }

    /// The constraints or the friction of the system, if its class has any: see [`Hamiltonian::extra`](crate::Hamiltonian::extra).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn extra(&self) -> Option<<Self::Class as Class>::Extra<'_, V>> {
        None
    }

    /// See [`Hamiltonian::check_dimension`](crate::Hamiltonian::check_dimension).
    #[doc(hidden)]
    fn check_dimension(&self, _dimension: usize) -> Result<(), Error> {
        Ok(())
    }

    /// The error of a step from the position `q`, supplemented with details from the system.
    #[doc(hidden)]
    fn explain(&self, error: Error, _q: &V) -> Error {
        error
    }

    /// Runs `work` over vectors of these lanes, if the system is defined over them.
    #[doc(hidden)]
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn over_lanes<L: Lanes, W: LaneWork<V, Self, L>>(_work: W) -> Option<W::Output>
    where
        Self: Clone,
    {
        None
    }

    /// Whether trajectories of systems with different parameters run in lanes side by side.
    #[doc(hidden)]
    const JOINS: bool = false;
}

/// A system over vectors of doubles and over vectors of SIMD lanes.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a Hamiltonian system over the vectors `{V}` with lanes in place of doubles",
    label = "this needs a system that is written for every `Scalar`: `SeparableHamiltonian` or `Hamiltonian`"
)]
pub trait SystemInLanes<V: Vector>:
    System<V>
    + System<V::With<F64x2>>
    + System<V::With<F64x4>>
    + System<V::With<F64x8>>
    + System<V::With<WideF64x4>>
    + System<V::With<WideF64x8>>
    + System<V::With<WidestF64x8>>
{
}

impl<V: Vector, S> SystemInLanes<V> for S where
    S: System<V>
        + System<V::With<F64x2>>
        + System<V::With<F64x4>>
        + System<V::With<F64x8>>
        + System<V::With<WideF64x4>>
        + System<V::With<WideF64x8>>
        + System<V::With<WidestF64x8>>
{
}

/// A system over `V` that is defined over every scalar.
pub trait OverEveryScalar<V: Vector>: System<V> + SystemInLanes<Self::Doubles> {
    /// The same vectors over doubles: `V` itself if its scalar is f64.
    type Doubles: Vector<Scalar = f64>;
}
