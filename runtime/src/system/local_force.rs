//! The force of a chain, component by component.

use crate::number::F64x8;

/// The components of a [`Chain`](crate::emitted::Chain), whose force is local. Positions are computed on request and need not be
/// in memory. The force on every component has to be set exactly once.
pub trait Components<T> {
    /// Number of components.
    fn dimension(&self) -> usize;

    /// The position of a component, from 0, whose force has not yet been [set](Self::set_force).
    fn position(&mut self, component: usize) -> T;

    /// Sets the force on a component.
    fn set_force(&mut self, component: usize, force: T);
}

/// The largest number of stages of [`StageRows`]: eight stages already fill the lanes.
pub const MOST_ROW_STAGES: usize = 7;

/// [`Components`] of all stages of a step at once, eight components in a row: the first row has the components 0 to 7. Every
/// component is in a row, and the force on every row has to be set exactly once. Arrays are indexed by the stage, from 0; entries
/// behind the last stage are ignored.
pub trait StageRows {
    /// Number of rows, at least one.
    fn count(&self) -> usize;

    /// Number of stages, at most [`MOST_ROW_STAGES`].
    fn stages(&self) -> usize;

    /// The time of a stage.
    fn time(&self, stage: usize) -> F64x8;

    /// The positions in a row, from 0, whose forces have not yet been [set](Self::set_forces).
    fn positions(&mut self, row: usize) -> [F64x8; MOST_ROW_STAGES];

    /// Sets the forces on a row.
    fn set_forces(&mut self, row: usize, forces: [F64x8; MOST_ROW_STAGES]);
}
