//! Functions outside the class that is integrated, each at its place.

symplectic::tableau! {
    Nested { basis: [1, cos(cos(t))], nodes: [0, 1] }
    Quotient { basis: [1, 1/(1 + t)], nodes: [0, 1] }
    Tangent { basis: [1, t*tan(t)], nodes: [0, 1] }
    Imaginary { basis: [1, sqrt(-1)*t], nodes: [0, 1] }
    Singular { basis: [1, cos(pi*t), sin(pi*t)], nodes: [0, 1/3, 5/6], require: [symmetric] }
    Vanishing { basis: [1, sin(pi*t)], nodes: [0, 1] }
    Undecided { basis: [1, t/((e - pi)*(e + pi) - e^2 + pi^2)], nodes: [0, 1] }
    NoRoot { basis: [1, t], nodes: [0, root(t^2 + 1, 1)] }
}

fn main() {}
