//! Claims that are not certified; that of `Sum` is: -1.7 is -1.7024143839… in two digits.

symplectic::composition! {
    Higher { base: velocity-verlet, weights: [1.3512071920, -1.7024143839], symmetric: true, claim: separable(6) }
    Sum { base: velocity-verlet, weights: [1.3512071920, -1.7], symmetric: true, claim: separable(4) }
    WrongSum { base: velocity-verlet, weights: [1.3512071920, -1.71], symmetric: true, claim: separable(4) }
    NotSymmetric { base: ruth-1983, weights: [1.3512071920, -1.7024143839], symmetric: true, claim: separable(4) }
}

symplectic::splitting! {
    Digits {
        kick: [0.6756036, -0.1756036],
        drift: [1.3512082, -1.7024164],
        symmetric: true,
        claim: separable(4),
    }
}

fn main() {}
