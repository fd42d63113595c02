//! A rule that does not exist.

symplectic::tableau! {
    Gauss3 { basis: polynomial(3), nodes: gaus(3) }
}

fn main() {}
