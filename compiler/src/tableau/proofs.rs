//! What is proved about a tableau, each decided at its first use.

use std::sync::OnceLock;

use super::{Tableau, composed};
use crate::definition::Key;
use crate::evidence::Evidence;
use crate::exact::over_algebra;
use crate::order::{
    ConjugateOrder, HamiltonianClass, ModifiedTerm, OrderOptions, OrderReport, Pendulum,
    PerturbedOrder, SimplifyingAssumptions, SymplecticityOrder, conjugate_order, modified_equation,
    observed_order, order, perturbed_order, simplifying_assumptions, symplecticity_order,
};
use crate::properties::{Properties, SeparableProperties};
use crate::schedule::Evaluations;
use crate::stability::{MAX_STAGES, Stability, StabilityInterval, StableSteps};

/// The highest conjugate order that is looked for: the words of the next degree are 512.
const MAX_CONJUGATE_ORDER: usize = 9;

/// What has been decided so far.
#[derive(Debug, Clone, Default)]
pub(super) struct Proofs {
    properties: OnceLock<Properties>,
    /// The properties that follow from the coefficients alone.
    own_properties: OnceLock<Properties>,
    separable: OnceLock<SeparableProperties>,
    orders: OnceLock<OrderReport>,
    perturbed: OnceLock<Option<PerturbedOrder>>,
    stability: OnceLock<Stability>,
    first_stable: OnceLock<Option<StabilityInterval>>,
}

impl Tableau {
    /// All properties, decided at the first call.
    ///
    /// ```
    /// let verlet = symplectic_compiler::derive("polynomial(2)", "lobatto(2)")?;
    /// let properties = verlet.properties();
    /// assert!(properties.symplectic.holds && properties.explicit.holds);
    /// assert_eq!(properties.explicit.witness.as_deref(), Some("Q1, P1 = P2, Q2"));
    /// assert!(!properties.equal_matrices.holds);
    /// assert_eq!(properties.equal_matrices.witness.as_deref(), Some("a_11 − ã_11 = -1/2"));
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn properties(&self) -> Properties {
        let decided = || {
            let mut properties = self.own_properties();
            let definition = &self.provenance.definition;
            // A composition of constrained steps, which may be none itself. If it is neither, the parts say why.
            let composes = [Key::Base, Key::Compose].map(|key| definition.get(key).is_some());
            if !composes.contains(&true) {
                return properties;
            }
            let Ok(parts) = self.parts() else {
                return properties;
            };
            if !properties.constrained.holds
                && let Some(found) = composed::constrained(parts)
            {
                properties.constrained = found;
            }
            if !properties.nonholonomic.holds
                && let Some(found) = composed::nonholonomic(self, parts)
            {
                properties.nonholonomic = found;
            }
            properties
        };
        self.proofs.properties.get_or_init(decided).clone()
    }

    /// The properties that follow from the coefficients, whatever the method is composed of.
    #[doc(hidden)]
    pub fn own_properties(&self) -> Properties {
        let decided = || {
            let mut properties = Properties::of(&self.exact);
            // A method of order 1 is consistent.
            if let (Some(given), Evidence::Verified { .. }) =
                (&self.given, properties.consistent.evidence)
            {
                properties.consistent.evidence = given.evidence;
            }
            properties
        };
        self.proofs.own_properties.get_or_init(decided).clone()
    }

    /// The properties for separable Hamiltonians `H = T(p) + U(q)`, which may be more than those for all Hamiltonians.
    ///
    /// ```
    /// use symplectic_compiler::{Definition, Limits};
    ///
    /// let splitting = Definition::parse("kick: [1/2, 1/2], drift: [1, 0]")?.derive(&Limits::default())?;
    /// assert!(!splitting.properties().symplectic.holds && !splitting.properties().symmetric.holds);
    /// let separable = splitting.separable_properties();
    /// assert!(separable.symplectic.holds && separable.symmetric.holds);
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn separable_properties(&self) -> SeparableProperties {
        let symmetric = self.properties().symmetric;
        let decided = || SeparableProperties::of(&self.exact, symmetric);
        self.proofs.separable.get_or_init(decided).clone()
    }

    /// The order for each class of Hamiltonians with the default options, decided at the first call.
    ///
    /// ```
    /// let lobatto = symplectic_compiler::derive("polynomial(3)", "lobatto(3)")?;
    /// assert_eq!(lobatto.orders().general.order, 4);
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn orders(&self) -> OrderReport {
        let decided = || self.order(&OrderOptions::default());
        self.proofs.orders.get_or_init(decided).clone()
    }

    /// Whether the method is symplectic for general Hamiltonians, and has the same order as for separable ones.
    ///
    /// ```
    /// use symplectic_compiler::{catalogue, derive};
    ///
    /// assert!(derive("polynomial(3)", "lobatto(3)")?.keeps_its_order_in_general());
    /// let splitting = catalogue::find("forest-ruth-1990").expect("a known method").derive()?;
    /// assert!(!splitting.keeps_its_order_in_general());
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn keeps_its_order_in_general(&self) -> bool {
        let orders = self.orders();
        let loses_symplecticity =
            self.separable_properties().symplectic.holds && !self.properties().symplectic.holds;
        !loses_symplecticity && orders.general.order >= orders.separable.order
    }

    /// Linear stability, decided at the first call.
    ///
    /// ```
    /// let lobatto = symplectic_compiler::derive("polynomial(3)", "lobatto(3)")?;
    /// let stability = lobatto.stability();
    /// assert_eq!(stability.trace.to_string(), "(ν⁴ − 22ν² + 48)/(ν² + 24)");
    /// assert_eq!(stability.intervals_text(), "(0, 2*sqrt(2)) ∪ (2*sqrt(3), 2*sqrt(6))");
    /// assert_eq!(stability.intervals[0].high.decimal(20), "2.8284271247461900976");
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn stability(&self) -> Stability {
        // That of a processed method is the stability of its kernel, to which it is conjugate.
        let decided = || match self.processed() {
            Some(processed) => processed.kernel.stability(),
            None => Stability::of(&self.exact),
        };
        self.proofs.stability.get_or_init(decided).clone()
    }

    /// The interval `(0, ν)` of stable steps of a palindromic splitting. This bound is proved in a second also for hundreds of stages, for
    /// which [`Tableau::stability`] takes minutes.
    ///
    /// `None` for other methods, and where enclosures do not decide it: where the step is `±1` at the end of the
    /// interval, so that there may be more of it.
    ///
    /// ```
    /// use symplectic_compiler::catalogue;
    ///
    /// let jumps = catalogue::find("triple-jump-10").expect("a known method").derive()?;
    /// let first = jumps.first_stable_interval().expect("decided");
    /// assert!(first.high.to_string().starts_with("1."));
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn first_stable_interval(&self) -> Option<StabilityInterval> {
        let decided = || match self.processed() {
            Some(processed) => processed.kernel.first_stable_interval(),
            None => Stability::first_interval(&self.exact),
        };
        self.proofs.first_stable.get_or_init(decided).clone()
    }

    /// The stable steps, computed in bounded time.
    ///
    /// ```
    /// use symplectic_compiler::{catalogue, stability::StableSteps};
    ///
    /// let steps = |name| catalogue::find(name).expect("a known method").derive().map(|t| t.stable_steps());
    /// assert!(matches!(steps("gauss-3")?, StableSteps::All(_)));
    /// assert!(matches!(steps("suzuki-8")?, StableSteps::First { .. }));
    /// assert_eq!(steps("suzuki-8")?.to_string(), "(0, 3.14152750352…) at first");
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn stable_steps(&self) -> StableSteps {
        if let Some(processed) = self.processed() {
            return processed.kernel.stable_steps();
        }
        if self.stages() <= MAX_STAGES {
            let stability = self.stability();
            return match stability.evidence {
                Evidence::Undecided { bits } => StableSteps::NotDecided { bits },
                _ => StableSteps::All(Box::new(stability)),
            };
        }
        let Some(interval) = self.first_stable_interval() else {
            return StableSteps::NotComputed;
        };
        // Enclosures apply to the given method, or to one that is proved to exist.
        let given = self.given.as_ref();
        let evidence = given.map_or(Evidence::Proved, |given| given.evidence);
        StableSteps::First { interval, evidence }
    }

    /// The order for each class of Hamiltonians.
    ///
    /// ```
    /// use symplectic_compiler::order::OrderOptions;
    ///
    /// let lobatto = symplectic_compiler::derive("polynomial(3)", "lobatto(3)")?;
    /// let order = lobatto.order(&OrderOptions::default());
    /// assert_eq!(order.general.order, 4);
    /// let violated = order.general.refuted_by.expect("refuted at order 5");
    /// assert_eq!(violated.tree.order(), 5);
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn order(&self, options: &OrderOptions) -> OrderReport {
        order(&self.exact, options, self.given.as_ref())
    }

    /// The conjugate order of a splitting for a class of Hamiltonians: the order that a change of variables gives it, for a processed method
    /// that of its kernel. `None` for other methods and for general Hamiltonians.
    ///
    /// ```
    /// use symplectic_compiler::{Definition, Evidence, Limits, order::HamiltonianClass};
    ///
    /// // The symplectic Euler method is conjugate to Störmer–Verlet.
    /// let euler = Definition::parse("kick: [1], drift: [1]")?.derive(&Limits::default())?;
    /// let found = euler.conjugate_order(HamiltonianClass::Separable).expect("a splitting");
    /// assert_eq!((found.order, found.evidence), (2, Evidence::Proved));
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn conjugate_order(&self, class: HamiltonianClass) -> Option<ConjugateOrder> {
        let Some(processed) = self.processed() else {
            return conjugate_order(&self.exact, class, MAX_CONJUGATE_ORDER);
        };
        let kernel = &processed.kernel;
        let mut found = kernel.conjugate_order(class)?;
        // The kernel has at least the order of the whole, and a symmetric one an even order.
        let report = self.orders();
        let whole = report.class(class);
        let symmetric = kernel.separable_properties().symmetric.holds;
        let known = whole.order + usize::from(symmetric && whole.order % 2 == 1);
        if matches!(found.evidence, Evidence::Verified { .. }) && known >= found.order {
            found.evidence = whole.evidence;
        }
        Some(found)
    }

    /// The simplifying assumptions that hold; `None` if `b` differs from `b̃`.
    ///
    /// ```
    /// let gauss = symplectic_compiler::derive("polynomial(20)", "gauss(20)")?;
    /// let assumptions = gauss.simplifying_assumptions().expect("b = b̃");
    /// assert_eq!((assumptions.b, assumptions.c, assumptions.d), (40, 20, 20));
    /// assert_eq!(assumptions.order(), 40);
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn simplifying_assumptions(&self) -> Option<SimplifyingAssumptions> {
        over_algebra!(&self.exact, pair => simplifying_assumptions(pair))
    }

    /// The order of symplecticity for general Hamiltonians, from trees up to order `limit`; `None` for a
    /// method that is symplectic by its coefficients, or for a splitting with gradient kicks, which steps other Hamiltonians only.
    ///
    /// If no condition up to the limit is violated, it is the order of the method if that is higher, because the
    /// exact flow is symplectic.
    pub fn symplecticity_order(&self, limit: usize) -> Option<SymplecticityOrder> {
        if self.exact.has_gradient_kicks() {
            return None;
        }
        let mut found = over_algebra!(&self.exact, pair => {
            symplecticity_order(pair, HamiltonianClass::General, limit)
        })?;
        let verified = matches!(found.evidence, Evidence::Verified { .. });
        if found.violated.is_none() || verified {
            let general = self.orders().general;
            // Better knowledge of the order is also knowledge of the order of symplecticity.
            if general.order > found.order || (verified && general.order == found.order) {
                found.order = general.order;
                found.evidence = general.evidence;
            }
        }
        Some(found)
    }

    /// The coefficients of the modified equation for the trees of a class up to an order, at most 20, in
    /// the order of the enumeration (see [`ModifiedTerm`]).
    ///
    /// ```
    /// use symplectic_compiler::order::HamiltonianClass;
    ///
    /// let euler = symplectic_compiler::derive("polynomial(1)", "0")?;
    /// let terms = euler.modified_equation(HamiltonianClass::Separable, 2);
    /// let trees: Vec<_> = terms.iter().map(|term| term.tree.to_string()).collect();
    /// assert_eq!(trees, ["q", "p", "q[p]", "p[q]"]);
    /// // q' = ∂T/∂p − h/2 ∂²T/∂p² ∂U/∂q, p' = −∂U/∂q + h/2 ∂²U/∂q² ∂T/∂p
    /// assert_eq!(terms[2].exact.as_deref(), Some("1/2"));
    /// assert_eq!(terms[3].exact.as_deref(), Some("-1/2"));
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn modified_equation(&self, class: HamiltonianClass, order: usize) -> Vec<ModifiedTerm> {
        over_algebra!(&self.exact, pair => modified_equation(pair, class, order))
    }

    /// The order observed on a pendulum: `log₂` of the ratio of the errors of one step, minus 1.
    /// `expected` determines the size of the step.
    ///
    /// `None` for gradient kicks on a pendulum whose kinetic energy is not quadratic, if the error is lost in round-off, because the order is much higher than expected, or if the iteration for the
    /// stages does not converge.
    ///
    /// ```
    /// use symplectic_compiler::{catalogue, order::Pendulum};
    ///
    /// // Of order 4 for quadratic T, of order 3 for other separable Hamiltonians, and of order 1 for those that are not.
    /// let method = catalogue::find("mclachlan-atela-1992-order-4-optimal").expect("a known method").derive()?;
    /// let seen = |pendulum, expected| method.observed_order(pendulum, expected).expect("an order");
    /// assert!((seen(Pendulum::Quadratic, 4) - 4.0).abs() < 0.01);
    /// assert!((seen(Pendulum::Relativistic, 3) - 3.0).abs() < 0.01);
    /// assert!((seen(Pendulum::Coupled, 1) - 1.0).abs() < 0.01);
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn observed_order(&self, pendulum: Pendulum, expected: usize) -> Option<f64> {
        let lower_triangular = self.exact.lower_triangular();
        observed_order(self.numbers(), lower_triangular, pendulum, expected)
    }

    /// The order `(s₁, s₂, …)` for perturbed systems `H = H_A + εH_B` with drifts for `H_A` and kicks for `εH_B`, computed on
    /// the first call. `None` for a method that is not a splitting for separable `H`, or has gradient kicks.
    ///
    /// The first order is determined up to [`MAX_PERTURBED_ORDER`](crate::certify::MAX_PERTURBED_ORDER), the others up to [`MAX_ORDER`](crate::certify::MAX_ORDER).
    ///
    /// ```
    /// use symplectic_compiler::catalogue;
    ///
    /// let order = |name| Some(catalogue::find(name)?.derive().ok()?.perturbed_order()?.orders());
    /// assert_eq!(order("saba-4"), Some(vec![8, 2]));
    /// assert_eq!(order("stormer-verlet"), Some(vec![2, 2]));
    /// assert_eq!(order("gauss-2"), None);
    /// ```
    pub fn perturbed_order(&self) -> Option<PerturbedOrder> {
        self.proofs
            .perturbed
            .get_or_init(|| {
                // A splitting is explicit, which is decided faster.
                let explicit = self.properties().explicit.holds;
                let given = self.given.as_ref();
                explicit.then(|| perturbed_order(&self.exact, given))?
            })
            .clone()
    }

    /// The numbers of evaluations of force and velocity per step, for separable Hamiltonians and a method that is
    /// explicit for them; `None` for a method with coupled stages.
    ///
    /// Evaluations of the previous step that are reused (first same as last) do not count: only the very first step
    /// makes them. Those of a processed method are the evaluations of its kernel.
    ///
    /// ```
    /// use symplectic_compiler::schedule::Evaluations;
    ///
    /// let verlet = symplectic_compiler::derive("polynomial(2)", "lobatto(2)")?;
    /// assert_eq!(verlet.evaluations(), Some(Evaluations { forces: 1, velocities: 1, gradients: 0 }));
    /// let gauss = symplectic_compiler::derive("polynomial(2)", "gauss(2)")?;
    /// assert_eq!(gauss.evaluations(), None);
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn evaluations(&self) -> Option<Evaluations> {
        match self.processed() {
            Some(processed) => processed.kernel.evaluations(),
            None => Evaluations::of(&self.exact),
        }
    }
}
