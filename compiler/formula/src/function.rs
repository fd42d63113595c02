//! The functions of one variable.

/// An elementary function.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Elementary {
    /// eˣ
    Exp,
    /// The natural logarithm.
    Ln,
    /// The sine.
    Sin,
    /// The cosine.
    Cos,
    /// The tangent.
    Tan,
    /// The inverse sine.
    Asin,
    /// The inverse cosine.
    Acos,
    /// The inverse tangent.
    Atan,
    /// The hyperbolic sine.
    Sinh,
    /// The hyperbolic cosine.
    Cosh,
    /// The hyperbolic tangent.
    Tanh,
}

/// All elementary functions, by their names in formulas and in Rust.
pub const ELEMENTARY: [(&str, Elementary); 11] = [
    ("exp", Elementary::Exp),
    ("ln", Elementary::Ln),
    ("sin", Elementary::Sin),
    ("cos", Elementary::Cos),
    ("tan", Elementary::Tan),
    ("asin", Elementary::Asin),
    ("acos", Elementary::Acos),
    ("atan", Elementary::Atan),
    ("sinh", Elementary::Sinh),
    ("cosh", Elementary::Cosh),
    ("tanh", Elementary::Tanh),
];

/// A function of one variable in a formula.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Function {
    /// An elementary function.
    Elementary(Elementary),
    /// The square root, which is the power 1/2.
    Sqrt,
}

impl Function {
    /// The function with this name.
    pub fn find(name: &str) -> Option<Self> {
        if name == "sqrt" {
            return Some(Function::Sqrt);
        }
        let found = ELEMENTARY.iter().find(|(known, _)| *known == name);
        found.map(|&(_, function)| Function::Elementary(function))
    }
}

impl Elementary {
    /// The name of the function.
    pub fn name(self) -> &'static str {
        let found = ELEMENTARY.iter().find(|(_, function)| *function == self);
        found.map_or("", |(name, _)| name)
    }
}
