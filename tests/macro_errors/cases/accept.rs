//! What is verified is not proved.

symplectic::tableau! {
    Verified { basis: [1, cos(t)], nodes: gauss(2), require: [symplectic, symmetric] }
    Loose { basis: [1, cos(t)], nodes: gauss(2), require: [symplectic], accept: verified(2000 bits) }
    Refuted { basis: [1, cos(t)], nodes: gauss(2), require: [explicit], accept: verified(100 bits) }
    Shape { basis: [1, cos(t)], nodes: gauss(2), accept: proved }
    Enough { basis: [1, cos(t)], nodes: gauss(2), require: [symplectic], accept: verified(100 bits) }
}

fn main() {}
