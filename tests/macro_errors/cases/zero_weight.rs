//! A weight that vanishes.

symplectic::tableau! {
    ZeroWeight { basis: polynomial(3), nodes: [0, 1/3, 1] }
}

fn main() {}
