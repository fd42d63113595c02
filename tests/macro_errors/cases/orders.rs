//! Orders and stability that a method does not have, each with the condition that is violated.

symplectic::tableau! {
    Verlet { basis: polynomial(2), nodes: lobatto(2), require: [order >= 3, order(separable) == 4, p_stable, stable_to(2)] }
    Gauss { basis: polynomial(3), nodes: gauss(3), require: [order == 5, order(nystrom) >= 7] }
    Words { basis: polynomial(1), nodes: gauss(1), require: [order, order(hamiltonian) >= 2, order >= two, stable_to(), stabel] }
    /// The first two digits of √3 are right.
    Digits {
        a: [[1/4, 1/4 - 1.732050808/6], [1/4 + 1.732050808/6, 1/4]],
        b: [1/2, 1/2],
        require: [symplectic, order >= 4],
    }
    /// Kicks and drifts of Ruth's third-order method exchanged.
    Ruth {
        a: [[-1/24, 0, 0], [-1/24, 3/4, 0], [-1/24, 3/4, 7/24]],
        b: [-1/24, 3/4, 7/24],
        a_tilde: [[1, 0, 0], [1, -2/3, 0], [1, -2/3, 2/3]],
        b_tilde: [1, -2/3, 2/3],
        require: [order(separable) >= 3],
    }
    Enough {
        basis: polynomial(3), nodes: lobatto(3), require: [order == 4, order(separable) >= 4, stable_to(14/5), symmetric],
    }
}

fn main() {}
