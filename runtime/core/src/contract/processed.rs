//! Processed methods.

use crate::contract::Method;

/// A method `P ∘ K ∘ P⁻¹` with a kernel K and a processor P. The macros implement it for a definition with a `processor`.
///
/// As a [`Method`] it is one step with all three, which costs as many evaluations as they have together. A
/// [`ProcessedIntegrator`](crate::ProcessedIntegrator) takes the steps of the kernel only.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a processed method",
    label = "has no processor",
    note = "`composition! {{ Name {{ base: velocity-verlet, weights: […], processor: […] }} }}` makes one; any other method is for `Integrator::new`"
)]
pub trait Processed: Method {
    /// K
    type Kernel: Method + Default;
    /// P as a step of size h, which takes no time.
    type Processor: Method + Default;
    /// P⁻¹ as a step of size h.
    type Inverse: Method + Default;
}
