//! Systems with constraints: holonomic ones, `φ(q) = 0`, and non-holonomic ones, `w(q)·q' = 0`.
//!
//! A formula declares them by `constraints: …`. A system of your own sets its class, [`Constrained`] or [`Nonholonomic`], and implements
//! [`HolonomicConstraints`] or [`NonholonomicConstraints`]. [`Integrator::new`](symplectic_core::Integrator#method.new) then takes it, with
//! a method that is `constrained` or `nonholonomic`.

mod gradients;
mod holonomic;
mod increments;
mod kind;
mod last_impulse;
mod memory;
mod metric;
mod momentum_terms;
mod nonholonomic;
mod normal_matrix;
mod plan;
mod residuals;
mod with_constraints;

pub use gradients::Gradients;
pub use holonomic::{ConstraintForce, consistent, constraint_force};
pub use nonholonomic::consistent_momentum;
pub use symplectic_core::system::ConstraintName;

use core::marker::PhantomData;

use symplectic_core::Vector;
use symplectic_core::system::{FreePositions, Frictionless, Holonomic, NotGeneral, SplitClass};

use gradients::Terms;
use memory::Workspace;
use with_constraints::WithConstraints;

/// `H` of class `C`, [`Separable`](symplectic_core::Separable) or [`General`](symplectic_core::General), with holonomic constraints `φ(q) = 0`:
///
/// ```text
/// q' = ∂H/∂p      p' = −∂H/∂q − Gᵀλ      φ(q) = 0      G = ∂φ/∂q
/// ```
///
/// The system gives the constraints by [`HolonomicConstraints`]. Methods that are `constrained` step
/// such systems. They are Lobatto IIIA–IIIB (with two stages RATTLE), other pairs with stages at both ends, symplectic Euler and its
/// adjoint, and compositions. For any other method [`Integrator::new`](symplectic_core::Integrator#method.new) does not compile.
///
/// `Constrained<Damped>` is not a class: friction is part of the force of a system of class `Constrained<General>`.
///
/// ```compile_fail,E0277
/// use symplectic::system::Class;
/// use symplectic::constraints::Constrained;
/// use symplectic::friction::Damped;
///
/// const SEPARABLE: bool = <Constrained<Damped> as Class>::SEPARABLE;
/// assert!(SEPARABLE);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Constrained<C>(PhantomData<C>);

/// `H` of class `C`, [`Separable`](symplectic_core::Separable) or [`General`](symplectic_core::General), with non-holonomic constraints `w(q)·q' = 0`, linear in the velocities:
///
/// ```text
/// q' = ∂H/∂p      p' = −∂H/∂q − wᵀλ      w(q) ∂H/∂p = 0
/// ```
///
/// The system gives the rows of the m×n matrix `w` by [`NonholonomicConstraints`]. Methods that are
/// `nonholonomic` step such systems by the discrete Lagrange–d'Alembert–Pontryagin principle (Leok & Ohsawa, arXiv:0810.0740). These are
/// symmetric methods of order 2, compositions of one of them, and methods of order 1. Examples of the first are the implicit midpoint rule
/// and Lobatto IIIA–IIIB with two stages. A method of any other order would lose its order, and
/// [`Integrator::new`](symplectic_core::Integrator#method.new) does not compile:
///
/// ```compile_fail,E0277
/// use symplectic::nalgebra::Vector2;
/// use symplectic::constraints::Nonholonomic;
/// use symplectic::{Error, Integrator, Separable, State, System};
///
/// symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
///
/// fn run<S: System<Vector2<f64>, Class = Nonholonomic<Separable>>>(system: S, start: State<Vector2<f64>>) -> Result<(), Error> {
///     Integrator::new(Gauss2, system, start, 0.1)?;
///     Ok(())
/// }
/// ```
///
/// With `basis: polynomial(1), nodes: gauss(1)` it compiles:
///
/// ```
/// use symplectic::nalgebra::Vector2;
/// use symplectic::constraints::Nonholonomic;
/// use symplectic::{Error, Integrator, Separable, State, System};
///
/// symplectic::tableau! { Midpoint { basis: polynomial(1), nodes: gauss(1) } }
///
/// fn run<S: System<Vector2<f64>, Class = Nonholonomic<Separable>>>(system: S, start: State<Vector2<f64>>) -> Result<(), Error> {
///     Integrator::new(Midpoint, system, start, 0.1)?;
///     Ok(())
/// }
/// ```
///
/// `Nonholonomic<Damped>` is not a class: friction is part of the force of a system of class `Nonholonomic<General>`.
#[derive(Clone, Copy, Debug)]
pub struct Nonholonomic<C>(PhantomData<C>);

impl<C: SplitClass> SplitClass for Constrained<C> {}

impl<C: SplitClass> SplitClass for Nonholonomic<C> {}

impl<C> Holonomic for Constrained<C> {}

impl<C> FreePositions for Nonholonomic<C> {}

impl<C> Frictionless for Constrained<C> {}

impl<C> Frictionless for Nonholonomic<C> {}

impl<C> NotGeneral for Constrained<C> {}

impl<C> NotGeneral for Nonholonomic<C> {}

/// The holonomic constraints `φ(q) = 0` of a system of class [`Constrained`]. It is implemented for the vectors of every scalar:
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::constraints::{Constrained, Gradients, HolonomicConstraints};
/// use symplectic::system::Masses;
/// use symplectic::{Error, Hamiltonian, Integrator, Scalar, Separable, State};
///
/// symplectic::tableau! {
///     /// Lobatto IIIA–IIIB with two stages: RATTLE.
///     Rattle { basis: polynomial(2), nodes: lobatto(2), require: [constrained, order == 2] }
/// }
///
/// /// A pendulum of length 1 in the plane: H = |p|²/2 + 9.81 y, |q|² − 1 = 0.
/// struct Pendulum;
///
/// impl Hamiltonian for Pendulum {
///     type Class = Constrained<Separable>;
///     type Vector<T: Scalar> = SVector<T, 2>;
///
///     const MASSES: Masses = Masses::Unit;
///
///     fn velocity<T: Scalar>(&self, _: T, _: &SVector<T, 2>, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
///         *velocity = *p;
///     }
///
///     fn force<T: Scalar>(&self, _: T, _: &SVector<T, 2>, _: &SVector<T, 2>, force: &mut SVector<T, 2>) {
///         *force = SVector::from([T::zero(), T::from_f64(-9.81)]);
///     }
///
///     fn extra<T: Scalar>(&self) -> Option<&dyn HolonomicConstraints<SVector<T, 2>>> {
///         Some(self)
///     }
/// }
///
/// impl<T: Scalar> HolonomicConstraints<SVector<T, 2>> for Pendulum {
///     fn constraints(&self) -> usize {
///         1
///     }
///
///     fn constraint_values(&self, q: &SVector<T, 2>, values: &mut [T]) {
///         values[0] = q.dot(q) - T::one();
///     }
///
///     fn constraint_gradients(&self, q: &SVector<T, 2>, gradients: &mut Gradients<T>) {
///         gradients.set(0, 0, T::from_f64(2.0) * q[0]);
///         gradients.set(0, 1, T::from_f64(2.0) * q[1]);
///     }
/// }
///
/// # fn main() -> Result<(), Error> {
/// let start: State<SVector<f64, 2>> = State::from_arrays(0.0, [1.0, 0.0], [0.0, 0.0]);
/// let mut run = Integrator::new(Rattle, Pendulum, start, 0.01)?;
/// let end = run.integrate_to(10.0)?;
/// assert!((end.q.norm() - 1.0).abs() < 1e-14 && end.q.dot(&end.p).abs() < 1e-14);
/// # Ok(())
/// # }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not give its holonomic constraints over the vectors `{V}`",
    label = "implement `HolonomicConstraints` for the vectors of every scalar"
)]
pub trait HolonomicConstraints<V: Vector>: of_class::Constrained<V> {
    /// Their number m.
    fn constraints(&self) -> usize;

    /// Writes `φ(q)`, one value for each constraint.
    fn constraint_values(&self, q: &V, values: &mut [V::Scalar]);

    /// Sets the entries of the [`Gradients`] `G = ∂φ/∂q`, always the same entries in the same order.
    ///
    /// An integrator compares them with differences of `φ` when it is created.
    fn constraint_gradients(&self, q: &V, gradients: &mut Gradients<V::Scalar>);

    /// The name of a constraint, for errors.
    fn constraint_name(&self, _constraint: usize) -> Option<ConstraintName> {
        None
    }
}

/// The non-holonomic constraints `w(q)·q' = 0` of a system of class [`Nonholonomic`]. It is implemented for the vectors of every scalar:
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::constraints::{Gradients, Nonholonomic, NonholonomicConstraints};
/// use symplectic::system::Masses;
/// use symplectic::{Error, Hamiltonian, Integrator, Scalar, Separable, State};
///
/// symplectic::tableau! {
///     /// The implicit midpoint rule.
///     Midpoint { basis: polynomial(1), nodes: gauss(1), require: [nonholonomic, order == 2] }
/// }
///
/// /// A skate on the ice, at (x, y) in the direction a: H = (px² + py² + pa²)/2, x' sin a − y' cos a = 0.
/// struct Skate;
///
/// type V3<T> = SVector<T, 3>;
///
/// impl Hamiltonian for Skate {
///     type Class = Nonholonomic<Separable>;
///     type Vector<T: Scalar> = V3<T>;
///
///     const MASSES: Masses = Masses::Unit;
///
///     fn velocity<T: Scalar>(&self, _: T, _: &V3<T>, p: &V3<T>, velocity: &mut V3<T>) {
///         *velocity = *p;
///     }
///
///     fn force<T: Scalar>(&self, _: T, _: &V3<T>, _: &V3<T>, force: &mut V3<T>) {
///         *force = V3::zeros();
///     }
///
///     fn extra<T: Scalar>(&self) -> Option<&dyn NonholonomicConstraints<V3<T>>> {
///         Some(self)
///     }
/// }
///
/// impl<T: Scalar> NonholonomicConstraints<V3<T>> for Skate {
///     fn nonholonomic_constraints(&self) -> usize {
///         1
///     }
///
///     fn nonholonomic_rows(&self, q: &V3<T>, rows: &mut Gradients<T>) {
///         rows.set(0, 0, q[2].sin());
///         rows.set(0, 1, -q[2].cos());
///     }
/// }
///
/// # fn main() -> Result<(), Error> {
/// // It turns at the rate 1 and moves at the speed 2, on a circle of radius 2 about (0, 2).
/// let start: State<V3<f64>> = State::from_arrays(0.0, [0.0; 3], [2.0, 0.0, 1.0]);
/// let mut run = Integrator::new(Midpoint, Skate, start, 0.01)?;
/// let end = run.integrate_to(10.0)?;
/// assert!((end.q[0].hypot(end.q[1] - 2.0) - 2.0).abs() < 1e-4);
/// assert!((end.p[0] * end.q[2].sin() - end.p[1] * end.q[2].cos()).abs() < 1e-14);
/// # Ok(())
/// # }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not give its non-holonomic constraints over the vectors `{V}`",
    label = "implement `NonholonomicConstraints` for the vectors of every scalar"
)]
pub trait NonholonomicConstraints<V: Vector>: of_class::Nonholonomic<V> {
    /// Their number m.
    fn nonholonomic_constraints(&self) -> usize;

    /// Sets the entries of the m×n matrix `w(q)`, always the same entries in the same order.
    fn nonholonomic_rows(&self, q: &V, rows: &mut Gradients<V::Scalar>);

    /// The name of a constraint, for errors.
    fn constraint_name(&self, _constraint: usize) -> Option<ConstraintName> {
        None
    }
}

/// What the class of a system with constraints must be.
#[doc(hidden)]
pub mod of_class {
    use symplectic_core::system::{Class, Unconstrained};
    use symplectic_core::{System, Vector};

    /// A system of the class with holonomic constraints.
    #[diagnostic::on_unimplemented(
        message = "`{Self}` has constraints, but its class excludes them",
        label = "declare `type Class = Constrained<Separable>;` or `Constrained<General>`"
    )]
    pub trait Constrained<V> {}

    #[diagnostic::do_not_recommend]
    impl<V, C, S> Constrained<V> for S
    where
        V: Vector,
        C: Class + Unconstrained,
        S: System<V, Class = super::Constrained<C>>,
    {
    }

    /// A system of the class with non-holonomic constraints.
    #[diagnostic::on_unimplemented(
        message = "`{Self}` has non-holonomic constraints, but its class excludes them",
        label = "declare `type Class = Nonholonomic<Separable>;` or `Nonholonomic<General>`"
    )]
    pub trait Nonholonomic<V> {}

    #[diagnostic::do_not_recommend]
    impl<V, C, S> Nonholonomic<V> for S
    where
        V: Vector,
        C: Class + Unconstrained,
        S: System<V, Class = super::Nonholonomic<C>>,
    {
    }
}
