//! Two ways to say what the method is.

symplectic::tableau! {
    Both { file: "gauss-4.toml", nodes: gauss(4) }
}

fn main() {}
