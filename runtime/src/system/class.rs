//! The kinds of Hamiltonian that a method has a plan for.

use crate::method::{Method, Plan};

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::General {}
    impl Sealed for super::Separable {}
}

/// What the derivatives of a [`Hamiltonian`](crate::Hamiltonian) depend on: [`General`] or [`Separable`].
///
/// It picks the [`Plan`] of a [`Method`], while compiling. Sealed.
pub trait Class: sealed::Sealed + Sized + 'static {
    /// The plan of the method `M` for systems of this class.
    type Plan<M: Method>: Plan<Class = Self>;
    /// Whether the velocity depends on the momentum only, and the force on the position only.
    const SEPARABLE: bool;
}

/// Velocity and force may depend on position and momentum both.
#[derive(Clone, Copy, Debug)]
pub struct General;

/// `H = T(t, p) + U(t, q)`: the velocity depends on the momentum only, the force on the position only.
#[derive(Clone, Copy, Debug)]
pub struct Separable;

impl Class for General {
    type Plan<M: Method> = M::General;
    const SEPARABLE: bool = false;
}

impl Class for Separable {
    type Plan<M: Method> = M::Separable;
    const SEPARABLE: bool = true;
}
