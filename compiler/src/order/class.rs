//! Classes of Hamiltonians, by the bicoloured trees that do not vanish for them.

use std::fmt;

use super::tree::{BicolouredTree, Colour};

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

    /// Whether the elementary differential of a tree can be nonzero in this class.
    pub fn contains(self, tree: &BicolouredTree) -> bool {
        let children = tree.children();
        let colours = match self {
            HamiltonianClass::General => true,
            HamiltonianClass::Separable | HamiltonianClass::Nystrom => {
                children.iter().all(|child| child.colour() != tree.colour())
            }
        };
        let linear = self == HamiltonianClass::Nystrom && tree.colour() == Colour::Q;
        let count = !linear || children.len() <= 1;
        colours && count && children.iter().all(|child| self.contains(child))
    }
}

impl fmt::Display for HamiltonianClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn classes_are_told_apart_by_their_trees() {
        let classes = |text: &str| {
            let tree: BicolouredTree = text.parse().expect(text);
            HamiltonianClass::ALL.map(|class| class.contains(&tree))
        };
        assert_eq!(classes("q[p[q,q]]"), [true, true, true]);
        assert_eq!(classes("q[p,p]"), [true, true, false]);
        assert_eq!(classes("p[q[p,p]]"), [true, true, false]);
        assert_eq!(classes("p[q,p]"), [true, false, false]);
    }
}
