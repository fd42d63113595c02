//! A key that does not exist.

symplectic::tableau! {
    Gauss2 { bases: polynomial(2), nodes: gauss(2) }
}

fn main() {}
