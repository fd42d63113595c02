//! Basis functions of which one is superfluous.

symplectic::tableau! {
    Dependent { basis: [1, t, 1 + t], nodes: lobatto(3) }
}

fn main() {}
