//! A property that does not exist.

symplectic::tableau! {
    Gauss2 { basis: polynomial(2), nodes: gauss(2), require: [symplectic, simplectic] }
}

fn main() {}
