//! A macro with nothing in it.

symplectic::tableau! {}

fn main() {}
