//! Linear friction.

use super::{Flow, FlowError, Span, check_parameter};
use crate::Error;
use symplectic_core::Vector;

/// The flow of linear friction, `p' = −γp`: `p ← e^{−γh} p`.
///
/// A splitting into symplectic flows and this flow is conformally symplectic: a step multiplies dq∧dp by `e^{−γh}` exactly (McLachlan
/// & Perlmutter 2001). The factor is applied as `p + (e^{−γh} − 1)p`, so that its rounding error does not accumulate over many steps.
///
/// ```
/// use symplectic::flow::{Damping, Flow, Span};
/// use symplectic::nalgebra::Vector1;
///
/// let (mut q, mut p) = (Vector1::new(2.0), Vector1::new(1.0));
/// Damping::new(0.5)?.flow(Span { time: 0.0, size: 2.0 }, &mut q, &mut p).expect("a flow");
/// assert!((p[0] - (-1.0_f64).exp()).abs() < 1e-15);
/// # Ok::<(), symplectic::flow::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Damping {
    rate: f64,
}

impl Damping {
    /// Friction with the rate γ.
    ///
    /// # Errors
    ///
    /// [`Error::FlowParameter`] for a rate that is negative or not finite.
    pub fn new(rate: f64) -> Result<Self, Error> {
        check_parameter("friction", 0, rate, true)?;
        Ok(Self { rate })
    }
}

impl<V: Vector<Scalar = f64>> Flow<V> for Damping {
    fn flow(&mut self, span: Span, _q: &mut V, p: &mut V) -> Result<(), FlowError> {
        let loss = libm::expm1(-self.rate * span.size);
        for p in p.as_mut_slice() {
            *p += loss * *p;
        }
        Ok(())
    }
}
