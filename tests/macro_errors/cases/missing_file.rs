//! A file that does not exist, and a path that is none.

symplectic::tableau! {
    Missing { file: "/no/such/folder/gauss-4.toml" }
    NotAPath { file: gauss_4 }
}

fn main() {}
