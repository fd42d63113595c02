//! A definition without a name.

symplectic::tableau! { basis: polynomial(2), nodes: gauss(2) }

fn main() {}
