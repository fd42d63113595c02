//! Processed compositions: `P K P⁻¹` with a kernel K and a processor P, both compositions of one symmetric basic method.
//!
//! `n` steps are `P Kⁿ P⁻¹`, so the processor is needed at the start and where a state is shown only. With `K = exp(k)` and `P = exp(π)` the
//! order is `p` if `exp(ad π) k = hE₁ + O(h^{p+1})`, which is decided by the words of the product `P K P⁻¹`.
//!
//! **A symmetric kernel** has a `k` that is odd in `h`. If `π` is even up to the degree `p − 1`, then `exp(ad π) k` is odd up to the degree `p`,
//! and the conditions of even degree follow from those of odd degree, as for a symmetric method. That `π` be even is necessary too: at the
//! first odd degree where it is not, `exp(ad π) k` has the term `[π, E₁]` of even degree, which vanishes for multiples of `E₁` only. So the
//! conditions are those of odd degree on `P K P⁻¹`, and that the words of odd degree up to `p − 1` vanish in P.
//!
//! **Back and forth.** `P(h) = Q(h) Q(−h)`, with `log Q = e + o` of even and odd parts, has an even logarithm up to brackets that contain `e`
//! and `o`. As the weights of Q sum to zero, `e` begins at the degree 4. If the words of odd degree up to `2j + 1` vanish in Q, then `o` begins at
//! `2j + 3`, and `π` is even up to the degree `2j + 6`. So the order is `p` if `2j + 7 ≥ p`. The weights of Q have to sum to zero for orders
//! up to 7, and `Σ γ³ = 0` in addition for the orders 8 and 9.

use super::conditions::{Claim, Conditions};
use super::system::{Step, System};

/// The processor of a composition, by the fractions of its steps. The first step acts first.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Processor<T> {
    /// `P(h) = S(γ_m h) ⋯ S(γ_1 h)`
    Steps(Vec<T>),
    /// `P(h) = Q(h) Q(−h)` with `Q(h) = S(γ_m h) ⋯ S(γ_1 h)`
    BackAndForth(Vec<T>),
}

impl<T> Processor<T> {
    /// The written weights.
    pub fn weights(&self) -> &[T] {
        match self {
            Processor::Steps(weights) | Processor::BackAndForth(weights) => weights,
        }
    }

    /// Other weights in the place of these.
    pub fn with<U>(&self, weights: Vec<U>) -> Processor<U> {
        match self {
            Processor::Steps(_) => Processor::Steps(weights),
            Processor::BackAndForth(_) => Processor::BackAndForth(weights),
        }
    }

    /// All weights, where `negative` is that of a step back.
    pub fn steps(self, negative: impl Fn(T) -> T) -> Vec<T>
    where
        T: Clone,
    {
        match self {
            Processor::Steps(weights) => weights,
            Processor::BackAndForth(weights) => {
                let back = weights.iter().cloned().map(negative);
                back.chain(weights.iter().cloned()).collect()
            }
        }
    }
}

/// How a processed composition is read.
#[derive(Debug, Clone)]
pub struct Processing {
    /// Whether the kernel is symmetric.
    pub symmetric: bool,
    /// Whether `P(h) = Q(h) Q(−h)`.
    pub back_and_forth: bool,
    /// The steps as they are written: those of P, or of Q.
    pub written: Vec<Step>,
}

impl Processing {
    /// The conditions on the product of all steps, and those on the written ones.
    pub fn system(&self, steps: Vec<Step>, claim: &Claim) -> System {
        let order = claim.order();
        let apart = if self.symmetric { 2 } else { 1 };
        let conditions = Conditions::of_degrees(claim, (1..=order).step_by(apart));
        let even = match (self.symmetric, self.back_and_forth) {
            (false, _) => 1,
            (true, false) => order.saturating_sub(1).max(1),
            // 2j + 1 for the smallest j with 2j + 7 ≥ p.
            (true, true) => 2 * order.saturating_sub(7).div_ceil(2) + 1,
        };
        let written = System::new(self.written.clone(), Conditions::even(claim, even));
        System {
            beside: Some(Box::new(written)),
            ..System::new(steps, conditions)
        }
    }
}
