//! Error at equal cost.
//!
//! A method of order `p` with error constant `C` makes an error of about `C h^{p+1}` in a step of `h`, so `C h^p` in a
//! unit of time. With `n` force evaluations a step, `N = n/h` of them in a unit of time give
//!
//! ```text
//! error = C (n/N)^p = (n C^{1/p} / N)^p .
//! ```
//!
//! A gradient kick counts as two evaluations: it takes a force and a product of the Hessian of `U` and a vector.
//!
//! So `n C^{1/p}` is the number of evaluations in a unit of time at which the error is 1, by its leading term. It
//! compares methods of one order at any accuracy. For an error `ε` the number is `n (C/ε)^{1/p}`, which compares methods
//! of different orders (McLachlan 1995, §3; Blanes & Moan 2002, the effective error).

use crate::arithmetic::rounding::to_f64;
use crate::order::HamiltonianClass;
use crate::tableau::Tableau;

impl Tableau {
    /// Force evaluations, with two for a gradient kick, in a unit of time for an error of `tolerance`, `n (C/ε)^{1/p}`, by the leading term of the error
    /// for a class of Hamiltonians. This figure compares methods; it is not a bound.
    ///
    /// `None` for methods that solve for their stages, for methods whose order is only a lower bound, and if the figure
    /// is not finite.
    ///
    /// ```
    /// use symplectic_compiler::{catalogue, order::HamiltonianClass::Separable};
    ///
    /// let cost = |name| catalogue::find(name)?.derive().ok()?.evaluations_for(Separable, 1e-8);
    /// // Four times as many kicks a step as Störmer–Verlet, and so few steps that it is a 38th of the kicks.
    /// assert!(cost("mclachlan-1995-s4") < cost("stormer-verlet").map(|cost| cost / 38.0));
    /// assert!(cost("mclachlan-1995-s4") > Some(118.0));
    /// assert_eq!(cost("gauss-2"), None);
    /// ```
    pub fn evaluations_for(&self, class: HamiltonianClass, tolerance: f64) -> Option<f64> {
        let report = self.orders();
        let found = report.class(class);
        let constant = to_f64(&found.error_constant.as_ref()?.value());
        let evaluations = self.evaluations()?.cost() as f64;
        let cost = evaluations * (constant / tolerance).powf(1.0 / found.order as f64);
        (cost.is_finite() && found.order > 0).then_some(cost)
    }
}
