//! Bounds that are none.

symplectic::tableau! {
    Negative { basis: polynomial(3), nodes: gauss(3), max_stages: -1 }
    Zero { basis: polynomial(3), nodes: gauss(3), max_stages: 0 }
    Word { basis: polynomial(3), nodes: gauss(3), max_stages: many }
}

fn main() {}
