//! A key without a value.

symplectic::tableau! {
    Gauss2 { basis: , nodes: gauss(2) }
}

fn main() {}
