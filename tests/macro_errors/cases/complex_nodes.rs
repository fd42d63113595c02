//! A rule whose nodes are not all real.

symplectic::tableau! {
    Chebyshev8 { basis: polynomial(8), nodes: chebyshev(8) }
}

fn main() {}
