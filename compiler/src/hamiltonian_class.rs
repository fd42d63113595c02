//! Classes of Hamiltonians.

use std::fmt;

/// A class of Hamiltonians; the smaller it is, the fewer order conditions a method has to satisfy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum HamiltonianClass {
    /// Every `H(q, p)`: all bicoloured trees.
    General,
    /// `H = T(p) + U(q)`: neighbouring vertices have different colours.
    Separable,
    /// `H = pᵀM⁻¹p/2 + U(q)` (Nyström): in addition, a vertex for `q'` has at most one child, because
    /// `∂H/∂p` is linear in `p`.
    Nystrom,
}

impl HamiltonianClass {
    /// All classes, the largest first.
    pub const ALL: [HamiltonianClass; 3] = [
        HamiltonianClass::General,
        HamiltonianClass::Separable,
        HamiltonianClass::Nystrom,
    ];

    /// The name in requirements and exports: `general`, `separable`, `nystrom`.
    pub fn name(self) -> &'static str {
        match self {
            HamiltonianClass::General => "general",
            HamiltonianClass::Separable => "separable",
            HamiltonianClass::Nystrom => "nystrom",
        }
    }
}

impl fmt::Display for HamiltonianClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
