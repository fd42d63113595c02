//! A kick by the force of a system.

use super::{Flow, FlowError, Span};
use symplectic_core::inside::is_finite;
use symplectic_core::{Quantity, Separable, System, Vector};

/// The flow of the potential of a separable system: `p ← p + h force(t, q)`, with t at the [middle](Span::middle) of the span.
///
/// ```
/// use symplectic::flow::{Flow, FlowError, Kick, Span};
/// use symplectic::nalgebra::Vector1;
/// use symplectic::acceleration;
///
/// let mut kick = Kick::new(acceleration::<Vector1<f64>, _>(|_, q, force| force[0] = -q[0]));
/// let (mut q, mut p) = (Vector1::new(2.0), Vector1::new(1.0));
/// kick.flow(Span { time: 0.0, size: 0.25 }, &mut q, &mut p)?;
/// assert_eq!((q[0], p[0]), (2.0, 0.5));
/// # Ok::<(), FlowError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Kick<S, V> {
    system: S,
    force: Option<V>,
}

impl<V: Vector<Scalar = f64>, S: System<V, Class = Separable>> Kick<S, V> {
    /// The kick by the force of this system.
    pub const fn new(system: S) -> Self {
        Self {
            system,
            force: None,
        }
    }
}

impl<V: Vector<Scalar = f64>, S: System<V, Class = Separable>> Flow<V> for Kick<S, V> {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        let force = work_vector(&mut self.force, q, p)?;
        self.system.force(span.middle(), q, p, force);
        add(Quantity::Force, span.size, force, p)
    }
}

/// The work vector `kept`; reallocated if its dimension is not that of the state.
pub(super) fn work_vector<'a, V: Vector>(
    kept: &'a mut Option<V>,
    q: &V,
    p: &V,
) -> Result<&'a mut V, FlowError> {
    let dimension = q.dimension();
    super::check_dimension(dimension, p)?;
    if kept
        .as_ref()
        .is_some_and(|kept| kept.dimension() != dimension)
    {
        *kept = None;
    }
    Ok(kept.get_or_insert_with(|| q.zeros_like()))
}

/// Adds `size · slope` to a vector. Returns an error if the slope is not finite or the dimensions differ.
pub(super) fn add<V: Vector<Scalar = f64>>(
    what: Quantity,
    size: f64,
    slope: &V,
    to: &mut V,
) -> Result<(), FlowError> {
    if !is_finite(slope) {
        return Err(FlowError::NonFinite { what });
    }
    super::check_dimension(slope.dimension(), to)?;
    for (to, slope) in to.as_mut_slice().iter_mut().zip(slope.as_slice()) {
        *to += size * slope;
    }
    Ok(())
}
