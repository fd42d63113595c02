//! Values of the wrong kind.

symplectic::tableau! {
    NodesInT { basis: polynomial(2), nodes: [0, t] }
    TextNodes { basis: polynomial(2), nodes: "gauss(2)" }
    NumberOfFunctions { basis: 3, nodes: gauss(3) }
    RuleAsBasis { basis: gauss(3), nodes: gauss(3) }
}

fn main() {}
