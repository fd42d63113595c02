//! The exact tableau of a symplectic partitioned Runge–Kutta method.

use std::sync::OnceLock;

use crate::algebra::{Number, StageAlgebra};
use crate::coefficients::Coefficients;
use crate::definition::{Definition, Key};
use crate::derive::parts;
use crate::error::Error;
use crate::evidence::Evidence;
use crate::exact::{Exact, Tier, over_algebra};
use crate::order::{GivenOrder, OrderOptions, OrderReport, PerturbedOrder};
use crate::partitioned::LowerTriangular;
use crate::properties::{Properties, SeparableProperties, composed};
use crate::stability::{Stability, StabilityInterval};

/// The matrices of splittings with more stages are left out of files and of code: they have nothing but the weights, again
/// and again.
const LARGEST_MATRICES: usize = 36;

/// Where a tableau comes from.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Provenance {
    /// What it is derived from.
    pub definition: Definition,
    /// The paper or book that the method is from.
    pub source: Option<String>,
}

/// The exact coefficients of the method (LZ 42, MW 2.6.6)
///
/// ```text
/// Q_i = q0 + h Σ_j a_ij ∂H/∂p(Q_j, P_j)      q1 = q0 + h Σ_i b_i ∂H/∂p(Q_i, P_i)
/// P_i = p0 − h Σ_j ã_ij ∂H/∂q(Q_j, P_j)      p1 = p0 − h Σ_i b̃_i ∂H/∂q(Q_i, P_i)
/// ```
///
/// $$ Q_i = q_0 + h \sum_j a_{ij} \frac{\partial H}{\partial p}(Q_j, P_j) \qquad
/// P_i = p_0 - h \sum_j \tilde a_{ij} \frac{\partial H}{\partial q}(Q_j, P_j) $$
///
/// with `c_i = Σ_j a_ij` and `c̃_i = Σ_j ã_ij`. Stages of a derived method are ordered by ascending nodes. Those of its adjoint keep their
/// labels, and those of a composition have the order of its steps. Nothing in it is a floating-point number.
#[derive(Debug, Clone)]
pub struct Tableau {
    pub(crate) name: Option<String>,
    pub(crate) provenance: Provenance,
    pub(crate) exact: Exact,
    /// The order that follows from the construction of the method, however well its coefficients are known.
    pub(crate) given: Option<GivenOrder>,
    pub(crate) wrong_digits: Vec<Error>,
    properties: OnceLock<Properties>,
    /// The properties that follow from the coefficients alone.
    own_properties: OnceLock<Properties>,
    separable: OnceLock<SeparableProperties>,
    orders: OnceLock<OrderReport>,
    pub(crate) perturbed: OnceLock<Option<PerturbedOrder>>,
    stability: OnceLock<Stability>,
    first_stable: OnceLock<Option<StabilityInterval>>,
}

impl PartialEq for Tableau {
    /// Equal names, provenances and coefficients. Expressions are not compared: they are equal where the
    /// definitions are.
    fn eq(&self, other: &Self) -> bool {
        let expressions = matches!(
            (&self.exact, &other.exact),
            (Exact::Reals(_), Exact::Reals(_))
        );
        self.name == other.name
            && self.provenance == other.provenance
            && (expressions || self.exact == other.exact)
    }
}

impl Tableau {
    pub(crate) fn new(definition: Definition, exact: Exact) -> Self {
        Tableau {
            name: None,
            provenance: Provenance {
                definition,
                source: None,
            },
            exact,
            given: None,
            wrong_digits: Vec::new(),
            properties: OnceLock::new(),
            own_properties: OnceLock::new(),
            separable: OnceLock::new(),
            orders: OnceLock::new(),
            perturbed: OnceLock::new(),
            stability: OnceLock::new(),
            first_stable: OnceLock::new(),
        }
    }

    /// The printed numbers of a definition with a `claim` that the exact method does not round to, each at its place
    /// ([`ErrorKind::WrongDigits`](crate::ErrorKind::WrongDigits)). The tableau is that of the exact method: these are faults
    /// of the print.
    ///
    /// ```
    /// use symplectic_compiler::{Definition, Limits};
    ///
    /// let jump = "kick: [0.675603595980, -0.175603595980], drift: [1.351207191960, -1.702414383919], symmetric: true, \
    ///             claim: separable(4)";
    /// assert!(Definition::parse(jump)?.derive(&Limits::default())?.wrong_digits().is_empty());
    ///
    /// let changed = jump.replace("0.675603595980", "0.675603595990");
    /// let tableau = Definition::parse(&changed)?.derive(&Limits::default())?;
    /// let told = tableau.wrong_digits()[0].to_string();
    /// assert!(told.contains("`0.675603595990` is not the exact kick[0], rounded: that is 0.675603595980"), "{told}");
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn wrong_digits(&self) -> &[Error] {
        &self.wrong_digits
    }

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
            let Ok(parts) = parts(definition) else {
                return properties;
            };
            if !properties.constrained.holds
                && let Some(found) = composed::constrained(&parts)
            {
                properties.constrained = found;
            }
            if !properties.nonholonomic.holds
                && let Some(found) = composed::nonholonomic(self, &parts)
            {
                properties.nonholonomic = found;
            }
            properties
        };
        self.properties.get_or_init(decided).clone()
    }

    /// The properties that follow from the coefficients, whatever the method is composed of.
    pub(crate) fn own_properties(&self) -> Properties {
        let decided = || {
            let mut properties = over_algebra!(self, pair => Properties::of_pair(pair));
            // A method of order 1 is consistent.
            if let (Some(given), Evidence::Verified { .. }) =
                (&self.given, properties.consistent.evidence)
            {
                properties.consistent.evidence = given.evidence;
            }
            properties
        };
        self.own_properties.get_or_init(decided).clone()
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
        let decided = || over_algebra!(self, pair => SeparableProperties::of_pair(pair, symmetric));
        self.separable.get_or_init(decided).clone()
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
        self.orders.get_or_init(decided).clone()
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
        let decided = || over_algebra!(self, pair => Stability::of_pair(pair));
        self.stability.get_or_init(decided).clone()
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
        let decided = || over_algebra!(self, pair => Stability::first_interval(pair));
        self.first_stable.get_or_init(decided).clone()
    }

    /// The same tableau with a name.
    #[must_use]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.name = Some(name.into());
        self
    }

    /// The same tableau with the paper or book that it is from.
    #[must_use]
    pub fn with_source(mut self, source: impl Into<String>) -> Self {
        self.provenance.source = Some(source.into());
        self
    }

    /// The name, if it was given one.
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// Where the tableau comes from.
    pub fn provenance(&self) -> &Provenance {
        &self.provenance
    }

    /// How the coefficients are known.
    pub fn tier(&self) -> Tier {
        match &self.exact {
            Exact::Nodes(_) => Tier::NodeAlgebra,
            Exact::Field(_) => Tier::ConstantField,
            Exact::Reals(_) => Tier::Enclosure,
        }
    }

    /// The number of stages.
    pub fn stages(&self) -> usize {
        over_algebra!(self, pair => pair.algebra.stages())
    }

    /// Whether the coefficients for momenta are those for positions, `ã = a` and `b̃ = b`, as elements
    /// of the algebra that holds them.
    pub fn equal_halves(&self) -> (bool, bool) {
        over_algebra!(self, pair => pair.equal_halves())
    }

    /// Whether another tableau is known to have the same coefficients: as elements of the same algebra, or
    /// because all of them have the same exact forms.
    pub fn has_coefficients_of(&self, other: &Tableau) -> bool {
        if self.exact == other.exact || self.stages() != other.stages() {
            return self.exact == other.exact;
        }
        let forms = self.exact_forms();
        forms.iter().all(Option::is_some) && forms == other.exact_forms()
    }

    /// All coefficients as numbers that can be enclosed and correctly rounded.
    ///
    /// ```
    /// let gauss = symplectic_compiler::derive("polynomial(2)", "gauss(2)")?;
    /// assert_eq!(gauss.numbers().a[1][0].decimal(20).to_string(), "0.53867513459481288225");
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn numbers(&self) -> Coefficients<Number<'_>> {
        over_algebra!(self, pair => pair.numbers())
    }

    /// Readable exact forms of all coefficients that have one, which the grammar of expressions reads.
    ///
    /// ```
    /// let gauss = symplectic_compiler::derive("polynomial(2)", "gauss(2)")?;
    /// assert_eq!(gauss.exact_forms().c[0].as_deref(), Some("1/2 - sqrt(3)/6"));
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn exact_forms(&self) -> Coefficients<Option<String>> {
        over_algebra!(self, pair => pair.exact_forms())
    }

    /// All coefficients as correctly rounded doubles.
    ///
    /// ```
    /// let gauss = symplectic_compiler::derive("polynomial(2)", "gauss(2)")?;
    /// assert_eq!(gauss.to_f64().a[1], [0.25 + 3f64.sqrt() / 6.0, 0.25]);
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn to_f64(&self) -> Coefficients<f64> {
        self.numbers().map(Number::to_f64)
    }
}

/// How the weights make the matrices of a splitting that are left out; `None` where they are not.
pub(crate) fn left_out(tableau: &Tableau) -> Option<LowerTriangular> {
    let long = tableau.stages() > LARGEST_MATRICES;
    long.then(|| over_algebra!(tableau, pair => pair.lower_triangular()))?
}
