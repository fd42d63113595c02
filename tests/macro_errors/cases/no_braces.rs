//! A definition without its braces.

symplectic::tableau! { pub Gauss2: gauss(2) }

fn main() {}
