//! A basis that does not exist.

symplectic::tableau! {
    Gauss3 { basis: polynom(3), nodes: gauss(3) }
}

fn main() {}
