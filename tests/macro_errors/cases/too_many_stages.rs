//! More stages than a derivation is allowed.

symplectic::tableau! {
    Gauss40 { basis: polynomial(40), nodes: gauss(40) }
    Gauss3 { basis: polynomial(3), nodes: gauss(3), max_stages: 2 }
}

fn main() {}
