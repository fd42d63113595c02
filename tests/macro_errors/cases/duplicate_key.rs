//! A key given twice.

symplectic::tableau! {
    Gauss2 { basis: polynomial(2), nodes: gauss(2), nodes: lobatto(2) }
}

fn main() {}
