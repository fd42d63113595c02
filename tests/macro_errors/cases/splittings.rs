//! Kicks and drifts that make no method.

symplectic::splitting! {
    Lengths { kick: [1/2, 1/2], drift: [1] }
    Sum { kick: [7/24, 3/4, -1/8], drift: [2/3, -2/3, 1] }
    Mirrored { kick: [1/2, 1/2], drift: [1/2, 1/2], symmetric: true }
    Empty { kick: [], drift: [] }
    Missing { kick: [1] }
    Neither { require: [explicit] }
    Elsewhere { kick: [1], drift: [1], nodes: [0] }
    File { kick: [1], drift: [1], file: "verlet.toml" }
    First { kick: [1], drift: [1], first: position }
    NotSymplectic { kick: [1/2, 1/2], drift: [1, 0], require: [symplectic] }
    NotSymmetric { kick: [1/4, 3/4], drift: [1, 0], require: [symmetric(separable)] }
    Order { kick: [1/2, 1/2], drift: [1, 0], require: [order(separable) == 4] }
}

symplectic::splitting! {}

symplectic::tableau! {
    Both { basis: polynomial(1), nodes: [0], kick: [1], drift: [1] }
}

fn main() {}
