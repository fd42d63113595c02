//! The force of a chain, component by component.

use crate::number::F64x8;

/// The components of a [`Chain`](crate::emitted::Chain), whose force is local: positions are made where they are asked for, and need not be
/// in memory. The force on every component has to be set, once.
pub trait Components<T> {
    /// How many there are.
    fn dimension(&self) -> usize;

    /// The position of a component, from 0, the force on which has not been [set](Self::set_force).
    fn position(&mut self, component: usize) -> T;

    /// Sets the force on a component.
    fn set_force(&mut self, component: usize, force: T);
}

/// The most stages of [`StageRows`]: with eight the lanes are full of stages anyway.
pub const MOST_ROW_STAGES: usize = 7;

/// [`Components`] side by side, eight in a row, of all stages of a step at once: the first row is of the components 0 to 7. Every
/// component is in a row, and the force on every row has to be set, once. The positions of a stage are at the place of its number in what
/// is given, from 0; what is behind the last stage is not looked at.
pub trait StageRows {
    /// How many rows there are, one at least.
    fn count(&self) -> usize;

    /// How many stages there are, [`MOST_ROW_STAGES`] at most.
    fn stages(&self) -> usize;

    /// The time of a stage.
    fn time(&self, stage: usize) -> F64x8;

    /// The positions in a row, from 0, the forces on which have not been [set](Self::set_forces).
    fn positions(&mut self, row: usize) -> [F64x8; MOST_ROW_STAGES];

    /// Sets the forces on a row.
    fn set_forces(&mut self, row: usize, forces: [F64x8; MOST_ROW_STAGES]);
}
