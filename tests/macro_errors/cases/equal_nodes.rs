//! A node listed twice.

symplectic::tableau! {
    Twice { basis: polynomial(3), nodes: [0, 1/2, 2/4] }
}

fn main() {}
