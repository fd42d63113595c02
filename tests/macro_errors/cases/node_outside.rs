//! A node outside the step.

symplectic::tableau! {
    Outside { basis: polynomial(2), nodes: [0, 3/2] }
    Before { basis: polynomial(2), nodes: [-1/10, 1/2] }
}

fn main() {}
