//! The syntax tree of a definition.

use std::ops::Range;

use num_rational::BigRational;

/// A range of bytes of the text.
pub type Span = Range<usize>;

/// A name and its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Name {
    /// The name.
    pub text: String,
    /// Its place.
    pub span: Span,
}

/// The function of a definition: H of positions and momenta, or L of positions and velocities.
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

    /// The letter of its second argument, besides the positions.
    pub fn second(self) -> &'static str {
        match self {
            Form::Hamiltonian => "p",
            Form::Lagrangian => "v",
        }
    }

    /// The meaning of that letter.
    pub fn second_meaning(self) -> &'static str {
        match self {
            Form::Hamiltonian => "momenta",
            Form::Lagrangian => "velocities",
        }
    }

    /// The macro for this form.
    pub fn macro_name(self) -> &'static str {
        match self {
            Form::Hamiltonian => "hamiltonian!",
            Form::Lagrangian => "lagrangian!",
        }
    }

    /// An example of the declaration of coordinates.
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
    /// The form of its function.
    pub form: Form,
    /// The name of the system.
    pub name: Name,
    /// Generic lengths of the type of the system.
    pub lengths: Vec<Name>,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// The positions, and the momenta or velocities.
    pub coordinates: [Option<Coordinates>; 2],
    /// The ends of a chain.
    pub ends: Option<(Ends, Span)>,
    /// Functions written by the user in Rust: the function, its first and its second derivative.
    pub functions: Vec<[Name; 3]>,
    /// Abbreviations, in order.
    pub abbreviations: Vec<Abbreviation>,
    /// The Hamiltonian or the Lagrangian.
    pub function: Option<Expression>,
    /// Holonomic constraints.
    pub constraints: Vec<Constraint>,
    /// Applied (non-potential) forces.
    pub forces: Vec<Force>,
    /// The velocities, in a Hamiltonian system with non-holonomic constraints.
    pub velocities: Option<Coordinates>,
    /// Non-holonomic constraints.
    pub nonholonomic: Vec<Constraint>,
    /// The rate γ of a friction `−γp`, or a list of rates.
    pub friction: Option<Expression>,
    /// The functions declared to be conserved.
    pub invariants: Vec<(Name, Expression)>,
    /// The required properties.
    pub required: Vec<Name>,
}

/// `name = φ` or `name(i in a..b) = φ`: φ, a function of the positions or a form of the velocities, vanishes.
#[derive(Debug, Clone)]
pub struct Constraint {
    /// The name.
    pub name: Name,
    /// The indices of the family.
    pub over: Option<Over>,
    /// The expression that vanishes.
    pub value: Expression,
}

/// `x = f`, `q[i] = f` or `q[i](over) = f`: f is added to the force on a coordinate.
#[derive(Debug, Clone)]
pub struct Force {
    /// The coordinate: a name, or `q` with an index.
    pub target: Expression,
    /// The indices of the family.
    pub over: Option<Over>,
    /// The force.
    pub value: Expression,
}

/// A parameter: a field of the system.
#[derive(Debug, Clone)]
pub struct Parameter {
    /// Its name.
    pub name: Name,
    /// Its kind.
    pub kind: ParameterKind,
}

/// The kind of a parameter.
#[derive(Debug, Clone)]
pub enum ParameterKind {
    /// A number, with its default value if it has one.
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
    /// A generic constant of the type.
    Generic(String),
    /// A length known at run time.
    Runtime,
    /// The number of pairs in a parameter.
    PairsOf(String),
}

/// `let name = value;` or `let name(arguments) = value;`
#[derive(Debug, Clone)]
pub struct Abbreviation {
    /// The name.
    pub name: Name,
    /// The names of the arguments, if it has any.
    pub arguments: Vec<Name>,
    /// Its value.
    pub value: Expression,
}

/// Positions, momenta or velocities.
#[derive(Debug, Clone)]
pub struct Coordinates {
    /// Their kind.
    pub kind: CoordinatesKind,
    /// Their place.
    pub span: Span,
}

/// The kind of positions, momenta or velocities.
#[derive(Debug, Clone, PartialEq)]
pub enum CoordinatesKind {
    /// Named, one by one.
    Named(Vec<Name>),
    /// Numbered; with the number of components of each, if they are vectors.
    Numbered(Length, Option<usize>),
}

/// The ends of a chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// Bonds to walls at zero.
    Walls,
    /// Free ends.
    Free,
    /// Periodic: the ends are joined.
    Ring,
}

/// An expression and its place.
#[derive(Debug, Clone)]
pub struct Expression {
    /// Its kind.
    pub kind: Kind,
    /// Its place.
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
    /// Factors; `true` for divisors.
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

/// The range of a sum.
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
        /// The index of the pair.
        number: Option<Name>,
        /// Its indices.
        indices: [Name; 2],
        /// The parameter.
        list: Name,
    },
}
