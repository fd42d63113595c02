//! The last step, for dense output.

use crate::method::interpolation::Line;

/// The last step of an integrator.
pub(crate) struct LastStep<'a, V> {
    pub(crate) start: f64,
    pub(crate) end: f64,
    pub(crate) size: f64,
    pub(crate) positions: Line<'a, V>,
    pub(crate) momenta: Line<'a, V>,
}
