//! Definitions that leave something out.

symplectic::tableau! {
    NoNodes { basis: polynomial(2) }
    NoBasis { nodes: gauss(2) }
    Nothing {}
}

fn main() {}
