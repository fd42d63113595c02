//! Several errors in one definition, and in two.

symplectic::tableau! {
    First {
        basis: [1, t, 2*t],
        nodes: gaus(3),
        bases: 1,
        require: [symplectic, simplectic, symetric],
    }
    Second { basis: polynomial(3), nodes: lobatto(3), require: [explicit, equal_matrices] }
}

fn main() {}
