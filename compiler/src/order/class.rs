//! The bicoloured trees that do not vanish for a class of Hamiltonians.

use super::tree::{BicolouredTree, Colour};
pub use crate::hamiltonian_class::HamiltonianClass;

impl HamiltonianClass {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_hamiltonian_class_contains_the_right_trees() {
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
