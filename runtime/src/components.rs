//! A system, component by component.

/// The components of a system whose force is [local](crate::SeparableHamiltonian::LOCAL_FORCE): positions are made where they are asked
/// for, and need not be in memory. The force on every component has to be set, once.
pub trait Components<T> {
    /// How many there are.
    fn dimension(&self) -> usize;

    /// The position of a component, from 0, the force on which has not been [set](Self::set_force).
    fn position(&mut self, component: usize) -> T;

    /// Sets the force on a component.
    fn set_force(&mut self, component: usize, force: T);
}
