//! Compositions that make no method.

symplectic::composition! {
    Unknown { base: StoermerVerlett, weights: triple_jump(4) }
    NotSymmetric { base: ruth-1983, weights: triple_jump(4) }
    Mirrored { base: radau-left-2, weights: [1/3, 1/3], symmetric: true }
    Sum { base: gauss-2, weights: [1/2, 1/3] }
    Odd { base: StoermerVerlet, weights: suzuki(5) }
    Reached { base: gauss-4, weights: triple_jump(6) }
    Long { base: StoermerVerlet, weights: suzuki(8) }
    Twice { base: StoermerVerlet, weights: suzuki(4), symmetric: true }
    Missing { weights: [1/2, 1/2] }
    Alone { base: gauss-2, symmetric: true }
    Inside { base: [kick: [1/2, 1/2], drift: [1]], weights: [1] }
    Elsewhere { base: gauss-2, kick: [1], drift: [1] }
}

fn main() {}
