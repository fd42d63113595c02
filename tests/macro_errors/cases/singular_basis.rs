//! Basis functions that the nodes do not tell apart.

symplectic::tableau! {
    Singular { basis: [1, t*(t - 1)], nodes: [0, 1] }
}

fn main() {}
