//! Expressions that are none.

symplectic::tableau! {
    DividesByZero { basis: [1, t/(1 - 1)], nodes: [0, 1/0] }
    Unfinished { basis: [1, t +], nodes: [0, 1] }
    NoOperator { basis: [1, 2 t], nodes: [0, 1] }
    Power { basis: [1, t^(1/2)], nodes: [0, 1] }
    Arguments { basis: polynomial(2), nodes: gauss(2, 3) }
    Decimal { basis: polynomial(2), nodes: [0, 1.5.2] }
}

fn main() {}
