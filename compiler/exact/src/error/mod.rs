//! What can be wrong with an input, and where.

mod formula;

use std::fmt;
use std::ops::Range;

pub use formula::FormulaError;

/// An input that cannot be compiled: what is wrong, where, and what to do instead.
#[derive(Clone, PartialEq, Eq)]
pub struct Error {
    /// What is wrong.
    pub kind: Box<ErrorKind>,
    /// The place, if the input was text.
    pub place: Option<Place>,
}

/// The message: a test that returns the error, and `unwrap`, print this form.
impl fmt::Debug for Error {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, formatter)
    }
}

/// A part of an input text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// Which input: `basis`, `nodes` or a file's name.
    pub input: String,
    /// The whole text of that input.
    pub text: String,
    /// The offending bytes of `text`.
    pub span: Range<usize>,
}

/// The kinds of wrong input.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ErrorKind {
    /// The text does not follow the grammar of expressions.
    #[error("{found}, expected {expected}")]
    Syntax {
        /// The text found there.
        found: String,
        /// The expected text.
        expected: String,
    },
    /// A formula that no system can have.
    #[error(transparent)]
    Formula(#[from] FormulaError),
    /// A method that a library, or its file, cannot express.
    #[error("{library} cannot express this method: {reason}")]
    NotExpressible {
        /// The library.
        library: &'static str,
        /// Why.
        reason: &'static str,
    },
    /// A method for which no stepper can be written.
    #[error("no stepper of this method can be written: {reason}")]
    NoStepper {
        /// Why, and what to do.
        reason: &'static str,
    },
    /// A system for which no velocity and force can be written with a stepper.
    #[error("no stepper of this system can be written: it has {what}")]
    NoStepperOfSystem {
        /// What cannot be written, and what to do.
        what: &'static str,
    },
    /// A method for which no theorem can be written for a proof assistant.
    #[error("no theorem of this method can be written for Coq: {reason}")]
    NoTheorem {
        /// Why.
        reason: &'static str,
    },
    /// A parenthesis or bracket without its partner.
    #[error("`{bracket}` has no matching `{partner}`")]
    Unbalanced {
        /// The unmatched bracket.
        bracket: char,
        /// The missing character.
        partner: char,
    },
    /// A function or a name that does not exist here. The message names the known one that is near.
    #[error(
        "unknown {what} `{name}`; known here: {known}{}",
        crate::suggestion::among(name, known)
    )]
    Unknown {
        /// `function`, `name`, `method`, …
        what: &'static str,
        /// What was written.
        name: String,
        /// What could be written.
        known: String,
    },
    /// A function with arguments that it does not take.
    #[error("`{function}` takes {expected}, found {found}")]
    Arguments {
        /// The function.
        function: String,
        /// The expected arguments.
        expected: String,
        /// What was written.
        found: String,
    },
    /// A division by zero.
    #[error("division by zero")]
    DivisionByZero,
    /// A constant that cannot be distinguished from zero where this matters.
    #[error(
        "cannot decide whether {constant} is zero (|x| < 2^-{bits}); write 0 if it is, or write it in another form"
    )]
    Undecided {
        /// The constant.
        constant: String,
        /// The binary places up to which it is zero.
        bits: u32,
    },
    /// A function at a constant where it has no real value.
    #[error("{value} is not a real number: `{function}` needs {needs}")]
    Domain {
        /// The function with its argument.
        value: String,
        /// The function.
        function: &'static str,
        /// The arguments that it needs.
        needs: &'static str,
    },
    /// A root of a polynomial that does not exist.
    #[error("root({polynomial}, {index}) does not exist: {}", real_roots(*real))]
    RootIndex {
        /// The polynomial.
        polynomial: String,
        /// The requested number.
        index: String,
        /// How many real roots there are.
        real: usize,
    },
    /// A function of `t` that cannot be integrated in closed form here.
    #[error(
        "{found} is not supported: {reason}; supported are sums of products of t^k and sin, cos, exp, cosh, sinh of q*t + c with q rational, a rational multiple of pi or a sum of both, and constant multiples of tan(q*t) with |q| < pi/2"
    )]
    FunctionClass {
        /// The text found there.
        found: String,
        /// Why it is not supported.
        reason: &'static str,
    },
    /// A power that is not a small natural number.
    #[error("the exponent must be a whole number from 0 to {limit}, found {found}")]
    Exponent {
        /// The largest exponent.
        limit: u32,
        /// What was written.
        found: String,
    },
    /// A value of the wrong kind.
    #[error("found {found}, expected {expected}")]
    Type {
        /// The text found there.
        found: String,
        /// What is needed.
        expected: String,
    },
    /// An expression that would take more work than is allowed.
    #[error("this is too large: {what} {size} exceeds the limit {limit}")]
    ExpressionSize {
        /// What is too large.
        what: &'static str,
        /// How large it is.
        size: usize,
        /// The bound.
        limit: usize,
    },
    /// A constant that is not rational and too large or too small, which takes as many binary places.
    #[error(
        "{constant} is too {}: it, or a part of it, is about 2^{logarithm}, and constants that are not rational lie between 2^-{limit} and 2^{limit}; {}",
        if *logarithm > 0 { "large" } else { "small" },
        if *logarithm > 0 { "look at its exponents" } else { "write 0 if that is meant" }
    )]
    Magnitude {
        /// The constant.
        constant: String,
        /// The binary logarithm of the part.
        logarithm: i64,
        /// The bound.
        limit: i64,
    },
    /// More stages than the limit.
    #[error(
        "{stages} stages exceed the limit of {limit}, beyond which a derivation may run for very long; raise it with `--max-stages {stages}` (in the macro `max_stages: {stages}`)"
    )]
    TooManyStages {
        /// The requested stages.
        stages: String,
        /// The limit in force.
        limit: usize,
    },
    /// A rule with fewer nodes than it needs.
    #[error("`{rule}({stages})` does not exist: `{rule}(s)` needs s ≥ {minimum}")]
    TooFewStages {
        /// The rule.
        rule: &'static str,
        /// The requested nodes.
        stages: String,
        /// The smallest number of nodes.
        minimum: usize,
    },
    /// A rule some of whose nodes are not real.
    #[error(
        "`{rule}({stages})` has only {real} real nodes out of {stages}; real nodes exist only for {exist}"
    )]
    ComplexNodes {
        /// The rule.
        rule: &'static str,
        /// The requested nodes.
        stages: usize,
        /// How many of them are real.
        real: usize,
        /// The numbers of nodes for which all are real.
        exist: &'static str,
    },
    /// A node polynomial some of whose roots are not real.
    #[error("the node polynomial has {degree} roots, but only {real} of them are real")]
    ComplexRoots {
        /// Its degree.
        degree: usize,
        /// The number of its real roots.
        real: usize,
    },
    /// A node polynomial with a repeated root, or constant.
    #[error(
        "the node polynomial {polynomial} is not squarefree of degree at least 1, so its roots are not distinct nodes"
    )]
    NotSquarefree {
        /// The polynomial.
        polynomial: String,
    },
    /// Two equal nodes.
    #[error("the node {node} is listed twice; nodes must be distinct")]
    EqualNodes {
        /// The repeated node.
        node: String,
    },
    /// A node outside `[0, 1]`.
    #[error("the node {node} lies outside [0, 1]; nodes are fractions of a step")]
    NodeOutside {
        /// The node.
        node: String,
    },
    /// Basis functions that are linearly dependent.
    #[error("the basis functions are linearly dependent: {combination} = 0; leave one of them out")]
    DependentBasis {
        /// A vanishing combination.
        combination: String,
    },
    /// Basis functions that are dependent on the nodes, though not as functions.
    #[error(
        "the matrix of the basis at the nodes is singular: {combination} vanishes at every node; change a node or a basis function"
    )]
    SingularBasis {
        /// A combination of the basis that vanishes at all nodes.
        combination: String,
    },
    /// Basis functions that cannot be distinguished from dependent ones on the nodes.
    #[error(
        "the matrix of the basis at the nodes cannot be told from a singular one: as far as enclosures tell, {combination} vanishes at every node; change a node or a basis function"
    )]
    UndecidedBasis {
        /// The combination of the basis.
        combination: String,
    },
    /// Basis functions whose products a quadrature formula does not distinguish.
    #[error(
        "the Gram matrix of the basis with these nodes and weights is singular: the quadrature formula gives 0 for {combination} times each basis function; change a weight, a node or a function"
    )]
    SingularGram {
        /// The combination of the basis.
        combination: String,
    },
    /// Parts of a definition that do not go together.
    #[error("{message}")]
    Definition {
        /// What is wrong.
        message: String,
    },
    /// More basis functions than nodes of the quadrature formula.
    #[error(
        "{basis} basis functions and {nodes} node{} of the quadrature formula: the Galerkin construction needs at least as many nodes as functions", if *nodes == 1 {""} else {"s"}
    )]
    NotRectangular {
        /// The number of basis functions.
        basis: usize,
        /// The number of nodes.
        nodes: usize,
    },
    /// A different number of basis functions and nodes.
    #[error("{basis} basis function{} and {nodes} node{}: the collocation construction needs as many of one as of the other", if *basis == 1 {""} else {"s"}, if *nodes == 1 {""} else {"s"})]
    NotSquare {
        /// The number of basis functions.
        basis: usize,
        /// The number of nodes.
        nodes: usize,
    },
    /// A coefficient beyond the largest double.
    #[error(
        "a coefficient is too large for a double, which makes it {value}; move the nodes apart, or give smaller coefficients"
    )]
    Overflow {
        /// What it would be as a double.
        value: String,
    },
    /// A vanishing weight, by which `ã` would divide.
    #[error(
        "the weight b_{index} at the node c_{index} = {node} is zero, and ã_{index}j = (b_{index} b_j − b_j a_j{index})/b_{index} divides by it; choose other nodes, another basis or other weights"
    )]
    ZeroWeight {
        /// The stage, counted from 1.
        index: usize,
        /// Its node.
        node: String,
    },
    /// A weight that cannot be distinguished from zero.
    #[error(
        "the weight b_{index} cannot be told from zero, |b_{index}| ≤ 2^-{bits}, and ã_{index}j = (b_{index} b_j − b_j a_j{index})/b_{index} divides by it; choose other nodes, another basis or other weights"
    )]
    UndecidedWeight {
        /// The stage, counted from 1.
        index: usize,
        /// The bound on its size.
        bits: u32,
    },
    /// A file that cannot be read as a tableau.
    #[error("{message}")]
    Document {
        /// What is wrong with it.
        message: String,
    },
    /// A file whose entry is not what the derivation gives.
    #[error(
        "`{entry}` does not fit: the file has {found}, the derivation gives {expected}{advice}"
    )]
    Mismatch {
        /// The first entry that does not fit.
        entry: String,
        /// The entry in the file.
        found: String,
        /// What it should say.
        expected: String,
        /// What to do if an earlier version wrote the file; otherwise empty.
        advice: &'static str,
    },
    /// A printed number that the exact method of the claimed order does not round to. The method is right; its print is not.
    #[error("{message}")]
    WrongDigits {
        /// The wrong number, and the right one.
        message: String,
    },
    /// Printed coefficients that are not those of a method with the claimed order.
    #[error("{message}")]
    NotCertified {
        /// What is wrong, and how far the nearest exact method is if one was found.
        message: String,
    },
    /// A requirement that is refuted.
    #[error("{message}")]
    Requirement {
        /// What does not hold, with the witness.
        message: String,
    },
    /// A requirement that is only verified.
    #[error(
        "`{requirement}` is not proved, only verified to 2^-{bits}; `accept: verified({bits} bits)` takes that for enough"
    )]
    NotProved {
        /// The requirement.
        requirement: String,
        /// The binary places to which it is verified.
        bits: u32,
    },
}

/// Which real roots a polynomial has, and how they are counted.
fn real_roots(count: usize) -> String {
    match count {
        0 => "the polynomial has no real roots".to_owned(),
        1 => "the polynomial has one real root, whose number is 1".to_owned(),
        _ => format!(
            "the polynomial has {count} distinct real roots, numbered from 1 to {count} in ascending order"
        ),
    }
}

impl ErrorKind {
    /// Whether an error of a derivation is about a weight.
    pub fn is_about_weight(&self) -> bool {
        matches!(
            self,
            ErrorKind::ZeroWeight { .. } | ErrorKind::UndecidedWeight { .. }
        )
    }

    /// Whether an error of `derive_from` is about the basis rather than the nodes.
    pub fn is_about_basis(&self) -> bool {
        matches!(
            self,
            ErrorKind::NotSquare { .. } | ErrorKind::NotRectangular { .. }
        )
    }
}

impl Error {
    /// An error at a part of an input text.
    pub fn at(kind: ErrorKind, place: Place) -> Self {
        Error {
            kind: Box::new(kind),
            place: Some(place),
        }
    }
}

impl From<ErrorKind> for Error {
    fn from(kind: ErrorKind) -> Self {
        Error {
            kind: Box::new(kind),
            place: None,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(place) = &self.place {
            let before = &place.text[..place.span.start.min(place.text.len())];
            let line = before.matches('\n').count() + 1;
            let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
            if line > 1 {
                write!(f, "{}, line {line}, column {column}: ", place.input)?;
            } else {
                write!(f, "{}, column {column}: ", place.input)?;
            }
        }
        self.kind.fmt(f)
    }
}

impl std::error::Error for Error {}
