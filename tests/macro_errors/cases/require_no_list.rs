//! Properties without brackets.

symplectic::tableau! {
    Gauss2 { basis: polynomial(2), nodes: gauss(2), require: symplectic }
}

fn main() {}
