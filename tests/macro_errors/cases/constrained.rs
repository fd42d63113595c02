//! Methods that cannot step systems with constraints: the entry that is in the way.

symplectic::tableau! {
    Gauss { basis: polynomial(2), nodes: gauss(2), require: [symplectic, constrained] }
    RadauLeft { basis: polynomial(2), nodes: radau-left(2), require: [constrained] }
    RadauRight { basis: polynomial(2), nodes: radau-right(2), require: [constrained, nonholonomic] }
    Exchanged { basis: polynomial(3), nodes: lobatto(3), exchange: true, require: [constrained] }
    Lobatto { basis: polynomial(3), nodes: lobatto(3), require: [constrained] }
}

symplectic::splitting! {
    Verlet { kick: [1/2, 1/2], drift: [1, 0], require: [constrained] }
}

fn main() {}
