//! Two requirements that are refuted, one that is proved.

symplectic::tableau! {
    Gauss2 { basis: polynomial(2), nodes: gauss(2), require: [first_same_as_last, symmetric, explicit] }
}

fn main() {}
