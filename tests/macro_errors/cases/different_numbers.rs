//! More nodes than basis functions.

symplectic::tableau! {
    Different { basis: polynomial(2), nodes: lobatto(3) }
}

fn main() {}
