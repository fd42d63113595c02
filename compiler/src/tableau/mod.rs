//! The exact tableau of a symplectic partitioned Runge–Kutta method.

pub(crate) mod composed;
mod derivation;
mod parts;
mod proofs;

pub use self::derivation::{derive, derive_from, derive_within};
pub(crate) use self::parts::{Parts, Substep};

use std::sync::{Arc, OnceLock};

use self::derivation::first;
use self::proofs::Proofs;
use crate::algebra::Number;
use crate::coefficients::Coefficients;
use crate::definition::{Definition, Key};
use crate::derive::Problem;
use crate::error::{Error, ErrorKind};
use crate::exact::{Exact, Tier, over_algebra};
use crate::limits::Limits;
use crate::order::GivenOrder;
use crate::partitioned::LowerTriangular;

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
    /// What it is derived from. It is read when it is first needed, if the coefficients are from a file.
    problem: OnceLock<Result<Problem, ErrorKind>>,
    pub(crate) exact: Arc<Exact>,
    /// The order that follows from the construction of the method, however well its coefficients are known.
    pub(crate) given: Option<GivenOrder>,
    pub(crate) wrong_digits: Vec<Error>,
    parts: OnceLock<Result<Parts, ErrorKind>>,
    processed: OnceLock<Option<Box<Processed>>>,
    proofs: Proofs,
}

/// The methods of which a processed method `P ∘ K ∘ P⁻¹` consists. The method itself is a step with all of them; in a run
/// `P ∘ Kⁿ ∘ P⁻¹` only the kernel K is taken in every step.
#[derive(Debug, Clone)]
pub struct Processed {
    /// K
    pub kernel: Tableau,
    /// P, whose weights sum to 0.
    pub processor: Tableau,
    /// P⁻¹ as a step of size h.
    pub inverse: Tableau,
}

impl PartialEq for Tableau {
    /// Equal names, provenances and coefficients. Expressions are not compared: they are equal where the
    /// definitions are.
    fn eq(&self, other: &Self) -> bool {
        let expressions = matches!(
            (&*self.exact, &*other.exact),
            (Exact::Reals(_), Exact::Reals(_))
        );
        self.name == other.name
            && self.provenance == other.provenance
            && (expressions || self.exact == other.exact)
    }
}

impl Tableau {
    /// The method of a problem.
    pub(crate) fn derived(problem: Problem) -> Result<Self, ErrorKind> {
        let exact = problem.exact()?;
        Ok(Tableau {
            given: problem.given(&exact),
            wrong_digits: problem.wrong_digits(),
            ..Tableau::of(problem, exact)
        })
    }

    /// The method of a problem with the coefficients derived for it.
    pub(crate) fn of(problem: Problem, exact: Arc<Exact>) -> Self {
        Tableau::read(problem.definition(), exact).with_problem(problem)
    }

    /// The same tableau with the problem that its definition gives.
    pub(crate) fn with_problem(self, problem: Problem) -> Self {
        Tableau {
            problem: OnceLock::from(Ok(problem)),
            ..self
        }
    }

    /// A method with coefficients that need not follow from its definition.
    pub(crate) fn read(definition: Definition, exact: Arc<Exact>) -> Self {
        Tableau {
            name: None,
            provenance: Provenance {
                definition,
                source: None,
            },
            problem: OnceLock::new(),
            exact,
            given: None,
            wrong_digits: Vec::new(),
            parts: OnceLock::new(),
            processed: OnceLock::new(),
            proofs: Proofs::default(),
        }
    }

    /// What it is derived from.
    ///
    /// # Errors
    /// Those of a definition in a file with coefficients, which is read here.
    pub(crate) fn problem(&self) -> Result<&Problem, ErrorKind> {
        let read = || {
            let unlimited = Limits { stages: usize::MAX };
            let read = Problem::read(&self.provenance.definition, &unlimited);
            read.map_err(|errors| *first(errors).kind)
        };
        self.problem
            .get_or_init(read)
            .as_ref()
            .map_err(Clone::clone)
    }

    /// What it is derived from, if that has been read.
    pub(crate) fn known_problem(&self) -> Option<&Problem> {
        self.problem.get().and_then(|read| read.as_ref().ok())
    }

    /// Whether this may be the method of a problem with the same definition: as far as both have been derived, the coefficients are equal.
    fn may_be(&self, problem: &Problem) -> bool {
        match (&*self.exact, problem.known_exact().as_deref()) {
            (Exact::Reals(_), Some(Exact::Reals(_))) | (_, None) => true,
            (own, Some(other)) => own == other,
        }
    }

    /// The methods and steps from which it is built, derived at the first call.
    ///
    /// # Errors
    /// [`ErrorKind::ExpressionSize`] if a fraction of a fraction would be too long, and those of [`Tableau::problem`].
    pub(crate) fn parts(&self) -> Result<&Parts, ErrorKind> {
        let derived = || Parts::of(self.problem()?);
        self.parts
            .get_or_init(derived)
            .as_ref()
            .map_err(Clone::clone)
    }

    /// The kernel and the processor of a processed method, derived at the first call; `None` for any other method.
    ///
    /// ```
    /// use symplectic_compiler::{Definition, Limits};
    ///
    /// // Störmer–Verlet is the symplectic Euler method, processed with half a kick.
    /// let euler = "kick: [1], drift: [1], processor: [kick: [1/2], drift: [0]]";
    /// let tableau = Definition::parse(euler)?.derive(&Limits::default())?;
    /// assert_eq!(tableau.orders().separable.order, 2);
    /// let kernel = &tableau.processed().expect("a processed method").kernel;
    /// assert_eq!(kernel.orders().separable.order, 1);
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn processed(&self) -> Option<&Processed> {
        let has = |key| self.provenance.definition.get(key).is_some();
        if !has(Key::Processor) && (!has(Key::Base) || has(Key::Weights)) {
            return None;
        }
        let derived = || {
            let [kernel, processor] = self.problem().ok()?.processed()?;
            let inverse = processor.inverse().ok()?;
            Some(Box::new(Processed {
                kernel: Tableau::derived(kernel).ok()?,
                processor: Tableau::derived(processor).ok()?,
                inverse: Tableau::derived(inverse).ok()?,
            }))
        };
        self.processed.get_or_init(derived).as_deref()
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

    /// The coefficients in the algebra that holds them.
    #[doc(hidden)]
    pub fn exact(&self) -> &Exact {
        &self.exact
    }

    /// A tableau with the same name, definition and source, and other coefficients. Nothing is known about them yet.
    #[doc(hidden)]
    #[must_use]
    pub fn with_exact(self, exact: Exact) -> Self {
        Tableau {
            name: self.name,
            provenance: self.provenance.clone(),
            ..Tableau::read(self.provenance.definition, Arc::new(exact))
        }
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
        match &*self.exact {
            Exact::Nodes(_) => Tier::NodeAlgebra,
            Exact::Field(_) => Tier::ConstantField,
            Exact::Reals(_) => Tier::Enclosure,
        }
    }

    /// The number of stages.
    pub fn stages(&self) -> usize {
        self.exact.stages()
    }

    /// Whether it is a splitting with gradient kicks, for quadratic kinetic energy.
    pub fn has_gradient_kicks(&self) -> bool {
        self.exact.has_gradient_kicks()
    }

    /// Whether the coefficients for momenta are those for positions, `ã = a` and `b̃ = b`, as elements
    /// of the algebra that holds them.
    pub fn equal_halves(&self) -> (bool, bool) {
        over_algebra!(&self.exact, pair => pair.equal_halves())
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
        self.exact.numbers()
    }

    /// Readable exact forms of all coefficients that have one, which the grammar of expressions reads.
    ///
    /// ```
    /// let gauss = symplectic_compiler::derive("polynomial(2)", "gauss(2)")?;
    /// assert_eq!(gauss.exact_forms().c[0].as_deref(), Some("1/2 - sqrt(3)/6"));
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn exact_forms(&self) -> Coefficients<Option<String>> {
        over_algebra!(&self.exact, pair => pair.exact_forms())
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
pub fn left_out(tableau: &Tableau) -> Option<LowerTriangular> {
    let long = tableau.stages() > LARGEST_MATRICES;
    long.then(|| tableau.exact.lower_triangular())?
}
