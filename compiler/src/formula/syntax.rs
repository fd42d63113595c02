//! The parts of a definition, as they are written.

use std::ops::Range;

use num_rational::BigRational;

/// The bytes that something was read from.
pub type Span = Range<usize>;

/// A name and where it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Name {
    /// The name.
    pub text: String,
    /// Where it stands.
    pub span: Span,
}

/// What a definition gives: H of positions and momenta, or L of positions and velocities.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// `H = …`
    Hamiltonian,
    /// `L = …`
    Lagrangian,
}

impl Form {
    /// The letter of the function.
    pub fn function(self) -> &'static str {
        match self {
            Form::Hamiltonian => "H",
            Form::Lagrangian => "L",
        }
    }

    /// The letter of what it depends on besides the positions.
    pub fn second(self) -> &'static str {
        match self {
            Form::Hamiltonian => "p",
            Form::Lagrangian => "v",
        }
    }

    /// What that letter means.
    pub fn second_meaning(self) -> &'static str {
        match self {
            Form::Hamiltonian => "momenta",
            Form::Lagrangian => "velocities",
        }
    }

    /// The macro that takes it.
    pub fn macro_name(self) -> &'static str {
        match self {
            Form::Hamiltonian => "hamiltonian!",
            Form::Lagrangian => "lagrangian!",
        }
    }

    /// How coordinates are declared.
    pub fn coordinates(self) -> &'static str {
        match self {
            Form::Hamiltonian => "q: [a, b], p: [pa, pb];",
            Form::Lagrangian => "q: [a, b], v: [va, vb];",
        }
    }
}

/// A whole definition.
#[derive(Debug, Clone)]
pub struct Definition {
    /// What it gives.
    pub form: Form,
    /// The name of the system.
    pub name: Name,
    /// Lengths that the type of the system is generic in.
    pub lengths: Vec<Name>,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// The positions, and the momenta or velocities.
    pub coordinates: [Option<Coordinates>; 2],
    /// How a chain ends.
    pub ends: Option<(Ends, Span)>,
    /// Functions that the user has written in Rust: the function, its first and its second derivative.
    pub functions: Vec<[Name; 3]>,
    /// Abbreviations, in order.
    pub abbreviations: Vec<Abbreviation>,
    /// The Hamiltonian or the Lagrangian.
    pub function: Option<Expression>,
    /// Holonomic constraints.
    pub constraints: Vec<Constraint>,
    /// Applied forces, without a potential.
    pub forces: Vec<Force>,
    /// The velocities, in a Hamiltonian system with non-holonomic constraints.
    pub velocities: Option<Coordinates>,
    /// Non-holonomic constraints.
    pub nonholonomic: Vec<Constraint>,
    /// The rate γ of a friction `−γp`.
    pub friction: Option<Expression>,
    /// What is said to be conserved.
    pub invariants: Vec<(Name, Expression)>,
    /// What the system has to be.
    pub required: Vec<Name>,
}

/// `name = φ` or `name(i in a..b) = φ`: φ is zero, a function of the positions or a form of the velocities.
#[derive(Debug, Clone)]
pub struct Constraint {
    /// The name.
    pub name: Name,
    /// The indices for each of which there is one.
    pub over: Option<Over>,
    /// What is zero.
    pub value: Expression,
}

/// `x = f`, `q[i] = f` or `q[i](over) = f`: f is added to the force on a coordinate.
#[derive(Debug, Clone)]
pub struct Force {
    /// The coordinate: a name, or `q` with an index.
    pub target: Expression,
    /// The indices for each of which there is one.
    pub over: Option<Over>,
    /// The force.
    pub value: Expression,
}

/// A parameter: a field of the system.
#[derive(Debug, Clone)]
pub struct Parameter {
    /// Its name.
    pub name: Name,
    /// What it holds.
    pub kind: ParameterKind,
}

/// What a parameter holds.
#[derive(Debug, Clone)]
pub enum ParameterKind {
    /// A number, with the value that it has unless another is set.
    Number(Option<BigRational>),
    /// Numbers in one or two dimensions.
    Array(Vec<Length>),
    /// Pairs of indices.
    Pairs,
}

/// A length of an array.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Length {
    /// A number.
    Fixed(usize),
    /// A constant that the type is generic in.
    Generic(String),
    /// Known when the program runs.
    Runtime,
    /// As many as a parameter has pairs.
    PairsOf(String),
}

/// `let name = value;` or `let name(arguments) = value;`
#[derive(Debug, Clone)]
pub struct Abbreviation {
    /// The name.
    pub name: Name,
    /// The names of the arguments, if it has any.
    pub arguments: Vec<Name>,
    /// What it stands for.
    pub value: Expression,
}

/// Positions, momenta or velocities.
#[derive(Debug, Clone)]
pub struct Coordinates {
    /// What they are.
    pub kind: CoordinatesKind,
    /// Where that is written.
    pub span: Span,
}

/// What positions, momenta or velocities are.
#[derive(Debug, Clone, PartialEq)]
pub enum CoordinatesKind {
    /// Each with a name of its own.
    Named(Vec<Name>),
    /// Numbered; with the number of components of each, if they are vectors.
    Numbered(Length, Option<usize>),
}

/// What is beyond the ends of a chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// A bond to a wall at zero.
    Walls,
    /// Nothing.
    Free,
    /// The other end.
    Ring,
}

/// An expression and where it stands.
#[derive(Debug, Clone)]
pub struct Expression {
    /// What it is.
    pub kind: Kind,
    /// Where it stands.
    pub span: Span,
}

/// The kinds of expressions.
#[derive(Debug, Clone)]
pub enum Kind {
    /// A number.
    Number(BigRational),
    /// A name.
    Name(String),
    /// Terms; `true` for those that are subtracted.
    Sum(Vec<(bool, Expression)>),
    /// Factors; `true` for those by which it is divided.
    Product(Vec<(bool, Expression)>),
    /// A power.
    Power(Box<Expression>, Box<Expression>),
    /// An entry of an array.
    Entry(Box<Expression>, Vec<Expression>),
    /// A function of arguments.
    Call(Name, Vec<Expression>),
    /// A length `|x|`.
    Bars(Box<Expression>),
    /// A list of components.
    List(Vec<Expression>),
    /// A sum over indices.
    Total(Box<Over>, Box<Expression>),
}

/// What a sum goes over.
#[derive(Debug, Clone)]
pub enum Over {
    /// `i` or `i in a..b`
    Range(Name, Option<[Expression; 2]>),
    /// `i < j`
    Pairs(Name, Name),
    /// `bonds d`
    Bonds(Name),
    /// `(i, j) in list` or `s = (i, j) in list`
    List {
        /// The number of the pair.
        number: Option<Name>,
        /// Its indices.
        indices: [Name; 2],
        /// The parameter.
        list: Name,
    },
}
