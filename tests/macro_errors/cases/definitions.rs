//! Parts of definitions that do not go together.

symplectic::tableau! {
    Both { basis: polynomial(2), nodes: gauss(2), quadrature: gauss(3) }
    Weights { basis: polynomial(2), nodes: gauss(2), weights: [1/2, 1/2] }
    Short { basis: polynomial(4), quadrature: gauss(3) }
    OnlyA { a: [[0]] }
    Ragged { a: [[0, 0], [1/2]], b: [1/2, 1/2] }
    Count { a: [[0, 0], [1/2, 1/2]], b: [1] }
    Mixed { a: [[0]], b: [1], basis: polynomial(1) }
    Partner { a: [[0, 0], [1/2, 1/2]], b: [0, 1], a_tilde: symplectic_partner }
    Word { basis: polynomial(1), nodes: [1/2], exchange: yes }
}

fn main() {}
