//! Rules with fewer nodes than they need.

symplectic::tableau! {
    Gauss0 { basis: polynomial(1), nodes: gauss(0) }
    Lobatto1 { basis: polynomial(1), nodes: lobatto(1) }
}

fn main() {}
