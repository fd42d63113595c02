//! Splittings over flows: `H = A + B + …`, and each part is solved exactly.
//!
//! A [`Flow`] advances a state in time, in place. Flows can be composed to larger flows, and a [`FlowIntegrator`] takes steps with a flow:
//!
//! | what | step of size h | order |
//! |---|---|---|
//! | [`Splitting`] | the drifts and kicks of a proved method, with the flows of `A` and `B` instead | `M::ORDERS.separable`; for `B = O(ε)` its order for perturbed systems |
//! | [`Palindrome`] | `A(h/2) B(h) A(h/2)`; `B` may be a palindrome again, for three parts and more | 2 |
//! | [`Composed`] | steps `γ_i h` of a palindrome, with the `γ_i` of a composition | `M::ORDERS.general` |
//! | [`Substeps`] | `n` steps of size `h/n`, for fast parts | that of the step |
//! | `Asynchronous` | each of many potentials with its own step size | 2 |
//!
//! A `Corrector` removes the first-order error in a small `B` by transforming both ends of a run of symmetric steps.
//!
//! Flows of parts:
//!
//! | flow | part | exact |
//! |---|---|---|
//! | [`Kick`], [`Drift`] | `U(q)`, `T(p)` of a separable system | yes |
//! | `MollifiedKick` | `U(Aq)`, with means Aq over the motion of a `Linear` part | yes |
//! | `Linear` | `z' = Az`, such as `H = pᵀM⁻¹p/2 + qᵀKq/2` | to rounding |
//! | [`Gyration`] | `p' = p × B(q)` in a magnetic field | yes |
//! | [`Damping`] | `p' = −γp` | yes |
//! | [`OrnsteinUhlenbeck`] | `dp = −γp dt + √(2γmkT) dW` | in law |
//! | `kepler` | `Σ p²/(2m) − mμ/∣q∣` | to rounding |
//!
//! A method for separable systems has the same order as a splitting of any two parts. The order conditions are the same: those of the free
//! Lie algebra of `A` and `B` (Hairer, Lubich & Wanner, *Geometric numerical integration*, III.5). The step is symplectic if the flows are.
//!
//! # Time
//!
//! A flow is given a [`Span`] of time. [`Kick`], [`Drift`] and [`Gyration`] evaluate a time-dependent part at the [middle](Span::middle) of
//! the span; your own flows should do so too.
//!
//! The first part, in place of the drift, advances the time: its spans are consecutive from the start of the step to its end. A span of the
//! second part has its middle at the time that the first part has reached. If only the second part depends on time, as a kick by `U(t, q)`
//! does, the order is that of the method. If other parts do, the order of a [`Splitting`] is 2 in general; a composition of Verlet steps
//! keeps its order, as in [`Composed`].
//!
//! ```
//! use symplectic::flow::{Drift, Error, FlowSteps, Kick, Splitting};
//! use symplectic::nalgebra::Vector1;
//! use symplectic::{State, acceleration};
//!
//! symplectic::tableau! { ForestRuth { base: forest-ruth-1990 } }
//!
//! # fn main() -> Result<(), Error> {
//! let pendulum = || acceleration::<Vector1<f64>, _>(|_, q, force| force[0] = -q[0].sin());
//! let step = Splitting::new(ForestRuth, Drift::new(pendulum()), Kick::new(pendulum()));
//! let start = State::from_arrays(0.0, [1.0], [0.0]);
//! let mut run = FlowSteps::run(step, start, 0.1)?;
//! run.integrate_to(10.0)?;
//! # Ok(())
//! # }
//! ```

#![no_std]

#[cfg(feature = "alloc")]
extern crate alloc;

#[cfg(feature = "std")]
extern crate std;

#[cfg(feature = "alloc")]
mod asynchronous;
#[cfg(feature = "alloc")]
mod checkpoint;
mod composed;
#[cfg(feature = "alloc")]
mod corrector;
mod damping;
mod drift;
mod error;
#[cfg(feature = "alloc")]
mod exponential;
pub mod friction;
mod gyration;
mod integrator;
#[cfg(feature = "alloc")]
pub mod kepler;
mod kick;
#[cfg(feature = "alloc")]
mod linear;
mod memory;
#[cfg(feature = "alloc")]
mod mollified;
mod ornstein_uhlenbeck;
mod palindrome;
mod philox;
mod splitting;
mod substeps;

#[cfg(feature = "alloc")]
pub use asynchronous::{Asynchronous, Elements};
pub use composed::Composed;
#[cfg(feature = "alloc")]
pub use corrector::Corrector;
pub use damping::Damping;
pub use drift::Drift;
pub use error::{Error, FlowError};
pub use gyration::Gyration;
pub use integrator::{FlowIntegrator, FlowSteps};
pub use kick::Kick;
#[cfg(feature = "alloc")]
pub use linear::Linear;
#[cfg(feature = "alloc")]
pub use mollified::MollifiedKick;
pub use ornstein_uhlenbeck::OrnsteinUhlenbeck;
pub use palindrome::Palindrome;
pub use splitting::Splitting;
pub use substeps::Substeps;

pub use symplectic_core::solver::Span;

use symplectic_core::Vector;

/// The flow of a part of a system: exact, or a step that preserves the same structure.
///
/// ```
/// use symplectic::flow::{Flow, FlowError, Span};
/// use symplectic::nalgebra::Vector1;
///
/// /// H = qp: q' = q, p' = −p.
/// struct Saddle;
///
/// impl Flow<Vector1<f64>> for Saddle {
///     fn flow(&mut self, span: Span, q: &mut Vector1<f64>, p: &mut Vector1<f64>) -> Result<(), FlowError> {
///         *q *= span.size.exp();
///         *p *= (-span.size).exp();
///         Ok(())
///     }
/// }
/// ```
pub trait Flow<V: Vector> {
    /// Advances position and momentum by `span.size`, which may be negative. Whatever depends on time is evaluated at
    /// [`span.middle()`](Span::middle).
    ///
    /// # Errors
    ///
    /// [`FlowError`]. Composed flows, and flows of several particles in a magnetic field, may then have changed part of the state; a
    /// [`FlowIntegrator`] restores it.
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError>;

    /// Several flows in succession, each from the end of the previous one. Adjacent flows of the same part may be merged.
    ///
    /// # Errors
    ///
    /// Those of [`flow`](Self::flow).
    fn flow_through(
        &mut self,
        spans: impl Iterator<Item = Span>,
        q: &mut V,
        p: &mut V,
    ) -> Result<(), FlowError>
    where
        Self: Sized,
    {
        for span in spans {
            self.flow(span, q, p)?;
        }
        Ok(())
    }

    /// Passes each 64-bit word that the flow keeps between calls to `visit`, which may replace it; always in the same order. An
    /// [`OrnsteinUhlenbeck`] bath has one word, the number of its draws. A flow that depends only on the span and the state has none.
    ///
    /// [Checkpoints](FlowIntegrator#checkpoints) store them. A [partial step](FlowIntegrator::state_at) and a step that
    /// fails put them back.
    ///
    /// ```
    /// use symplectic::flow::{Flow, FlowError, Span};
    /// use symplectic::nalgebra::Vector1;
    ///
    /// /// A kick in every other call.
    /// struct EveryOther {
    ///     calls: u64,
    /// }
    ///
    /// impl Flow<Vector1<f64>> for EveryOther {
    ///     fn flow(&mut self, span: Span, _q: &mut Vector1<f64>, p: &mut Vector1<f64>) -> Result<(), FlowError> {
    ///         if self.calls % 2 == 0 {
    ///             p[0] += 2.0 * span.size;
    ///         }
    ///         self.calls += 1;
    ///         Ok(())
    ///     }
    ///
    ///     fn memory(&mut self, visit: &mut dyn FnMut(&mut u64)) {
    ///         visit(&mut self.calls);
    ///     }
    /// }
    /// ```
    fn memory(&mut self, _visit: &mut dyn FnMut(&mut u64)) {}
}

/// Checks that a parameter of a flow is finite and positive, or with `zero_too` not negative.
fn check_parameter(
    what: &'static str,
    index: usize,
    value: f64,
    zero_too: bool,
) -> Result<(), Error> {
    if value.is_finite() && (value > 0.0 || (zero_too && value == 0.0)) {
        return Ok(());
    }
    let range = if zero_too {
        "finite and not negative"
    } else {
        "finite and positive"
    };
    Err(Error::FlowParameter {
        what,
        index,
        value,
        range,
    })
}

/// Checks a count, for example of rows or components.
#[cfg(feature = "alloc")]
fn check_count(
    what: &'static str,
    count: usize,
    right: bool,
    range: &'static str,
) -> Result<(), Error> {
    if right {
        return Ok(());
    }
    Err(Error::FlowParameter {
        what,
        index: 0,
        value: count as f64,
        range,
    })
}

/// Checks that a state has the dimension that a flow expects.
fn check_dimension<V: Vector>(expected: usize, q: &V) -> Result<(), FlowError> {
    let found = q.dimension();
    if found == expected {
        Ok(())
    } else {
        Err(FlowError::Dimension { expected, found })
    }
}
