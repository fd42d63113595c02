//! Claims that are not written as such, or not of printed digits.

symplectic::splitting! {
    Number { kick: [0.5, 0.5], drift: [1, 0], claim: 2 }
    Class { kick: [0.5, 0.5], drift: [1, 0], claim: general(2) }
    Order { kick: [0.5, 0.5], drift: [1, 0], claim: separable(two) }
    Zero { kick: [0.5, 0.5], drift: [1, 0], claim: separable(0) }
    High { kick: [0.5, 0.5], drift: [1, 0], claim: separable(40) }
    Ascending { kick: [0.5, 0.5], drift: [1, 0], claim: perturbed(2, 4) }
    Exact { kick: [1/4 + sqrt(3)/6, 3/4 - sqrt(3)/6], drift: [1, 0], claim: separable(2) }
    OneList { kick: [0.5, 0.5], claim: separable(2) }
    Lengths { kick: [0.5, 0.5], drift: [1], claim: separable(2) }
    Wrong { kick: [0.25, 0.75], drift: [0.6, 0.4], claim: separable(2) }
}

symplectic::composition! {
    Named { base: velocity-verlet, weights: triple_jump(4), claim: separable(4) }
    Weights { base: velocity-verlet, weights: [1/(2 - cbrt(2)), -cbrt(2)/(2 - cbrt(2))], symmetric: true, claim: separable(4) }
    Nystrom { base: velocity-verlet, weights: [1.3512071920, -1.7024143839], symmetric: true, claim: nystrom(4) }
    NoWeights { base: velocity-verlet, claim: separable(2) }
    Implicit { base: midpoint, weights: [1.3512071920, -1.7024143839], symmetric: true, claim: separable(4) }
    Adjoint { base: velocity-verlet, weights: [adjoint(1.3512071920), -1.7024143839], symmetric: true, claim: separable(4) }
}

symplectic::tableau! {
    Derived { basis: polynomial(2), nodes: lobatto(2), claim: separable(2) }
}

fn main() {}
