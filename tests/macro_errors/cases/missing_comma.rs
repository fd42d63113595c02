//! Entries without a comma between them.

symplectic::tableau! {
    Gauss2 { basis: polynomial(2) nodes: gauss(2) }
}

fn main() {}
