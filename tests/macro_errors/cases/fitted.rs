symplectic::tableau! {
    Exponential { parameters: w, basis: [1, exp(w*t)], nodes: [0, 1] }
    Unused { parameters: w, basis: [1, t], nodes: [0, 1] }
    Splitting { parameters: w, kick: [1], drift: [1] }
    Order { parameters: w, basis: [cos(w*t), sin(w*t)], nodes: gauss(2), require: [order >= 5, consistent, explicit] }
    Unknown { basis: [cos(w*t), sin(w*t)], nodes: gauss(2) }
}

fn main() {}
