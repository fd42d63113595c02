//! A requirement that is refuted.

symplectic::tableau! {
    Lobatto3 { basis: polynomial(3), nodes: lobatto(3), require: [symplectic, explicit] }
}

fn main() {}
