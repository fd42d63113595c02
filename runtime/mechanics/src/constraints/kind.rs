//! The kinds of constraints.

use super::memory::OwnPart;
use super::with_constraints::{Constraints, WithConstraints};
use symplectic_core::inside::ConstrainedStep;
use symplectic_core::system::Class;
use symplectic_core::{Error, Method, System, Vector};

/// A class of systems with constraints. The two kinds differ in what is here, and share the plan and the memory.
pub trait Kind: Class {
    /// The part of the memory that only its steps need.
    type Part<V: Vector>: OwnPart<V>;

    /// Name of the trait that gives the constraints.
    const GIVEN_BY: &'static str;

    /// The constraints of a system.
    fn constraints_of<'a, V: Vector>(given: Self::Extra<'a, V>) -> Constraints<'a, V>;

    /// The steps of a method.
    fn steps_of<M: Method>(method: &M) -> &'static [ConstrainedStep];

    /// The steps of a method whose coefficients are known at compile time.
    fn known_steps<M: Method>() -> &'static [ConstrainedStep];

    /// Checks that a state obeys the constraints, and that these are independent.
    fn check_start<V: Vector, S: System<V>>(
        system: &WithConstraints<'_, V, S>,
        time: f64,
        q: &V,
        p: &V,
    ) -> Result<(), Error>;
}

/// A system with its constraints, for states of this dimension.
pub(super) fn with_constraints<K: Kind, V: Vector, S: System<V, Class = K>>(
    system: &S,
    dimension: usize,
) -> WithConstraints<'_, V, S> {
    let constraints = system.extra().map(K::constraints_of);
    WithConstraints::new(system, (constraints, K::GIVEN_BY), dimension)
}
