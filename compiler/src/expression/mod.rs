//! The language in which bases and nodes are written: `polynomial(3)`, `1, t, t^2 - t/3`, `0, 1/3, 1`.
//!
//! ```text
//! list       = "[" items "]" | items            items = expression { "," expression }
//! expression = term { ("+" | "-") term }        term  = factor { ("*" | "/") factor }
//! factor     = { "-" | "+" } power              power = atom [ "^" factor ]
//! atom       = number | name | name "(" items ")" | "(" expression ")"
//! ```
//!
//! Numbers are decimals and exact: `0.1` is 1/10. The command line, table files and the macro share
//! this grammar; every node of the tree stores the range of bytes it was read from.

mod lexer;
mod messages;
mod parser;

use std::ops::Range;

use num_rational::BigRational;

pub use symplectic_exact::input::{Input, MAX_EXPONENT, shown, without_mark};

pub(crate) use messages::{complex, is_complex};
pub use parser::{Row, parse_list, parse_matrix};

/// The longest text that is read.
pub const MAX_LENGTH: usize = 100_000;
/// The deepest nesting of parentheses and signs.
pub const MAX_DEPTH: usize = 64;
/// The highest syntax tree; a sum of as many terms is as high.
pub const MAX_HEIGHT: usize = 256;
/// The largest degree of a polynomial.
pub const MAX_DEGREE: usize = 256;
/// The longest numerator or denominator, in bits.
pub const MAX_BITS: usize = 100_000;

/// A syntax tree and the bytes of the input that it was read from.
#[derive(Debug, Clone, PartialEq)]
pub struct Expression {
    /// What it is.
    pub kind: ExpressionKind,
    /// Its place.
    pub span: Range<usize>,
    /// The height of the tree, which bounds every recursion over it.
    height: usize,
}

impl Expression {
    fn new(kind: ExpressionKind, span: Range<usize>) -> Self {
        let below = match &kind {
            ExpressionKind::Number(_) | ExpressionKind::Name(_) => 0,
            ExpressionKind::Call { arguments, .. } => {
                arguments.iter().map(|a| a.height).max().unwrap_or(0)
            }
            ExpressionKind::Negate(inner) => inner.height,
            ExpressionKind::Binary { left, right, .. } => left.height.max(right.height),
        };
        Expression {
            kind,
            span,
            height: below + 1,
        }
    }
}

/// The kinds of expressions.
#[derive(Debug, Clone, PartialEq)]
pub enum ExpressionKind {
    /// A number, exact.
    Number(BigRational),
    /// A name such as `t`.
    Name(String),
    /// A function with its arguments.
    Call {
        /// The function.
        function: String,
        /// The place of its name.
        name: Range<usize>,
        /// The arguments.
        arguments: Vec<Expression>,
    },
    /// A negated expression.
    Negate(Box<Expression>),
    /// Two expressions joined by an operator.
    Binary {
        /// The operator.
        operator: Operator,
        /// The left operand.
        left: Box<Expression>,
        /// The right operand.
        right: Box<Expression>,
    },
}

/// The binary operators.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operator {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
    /// `^`
    Power,
}
