//! Formulas with errors, each at its place.

symplectic::hamiltonian! {
    Unknown { g: 9.81 } q: [a], p: [pa];
    H = pa^2/2 - g cso(a)
}

symplectic::hamiltonian! {
    Shapes<N> { m: [N] } q: [N; 3], p: [N; 3];
    H = sum(i: |p[i]|^2/(2 m[i])) + sum(i: |q[i] - m[i]|)
}

symplectic::hamiltonian! {
    Mixed q: [x], p: [px];
    H = px^2/2 + x px
    require: [separable]
}

symplectic::hamiltonian! {
    Kink q: [x], p: [px];
    H = px^2/2 + |x|
}

symplectic::lagrangian! {
    Degenerate q: [x, y], v: [vx, vy];
    L = vy^2/2 - x y
}

symplectic::lagrangian! {
    Relativistic { m, c } q: [3], v: [3];
    L = -m c^2 sqrt(1 - |v|^2/c^2) - |q|^2
    require: [separable]
}

symplectic::lagrangian! {
    Drag { m, c } q: [x, y], v: [vx, vy];
    L = -m c^2 sqrt(1 - (vx^2 + vy^2)/c^2)
    force: { x = -px, y = -vy }
}

symplectic::hamiltonian! {
    Rod q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + y
    constraints: { rod = x^2 + y^2 - 1 }
    friction: 1/10
}

fn main() {}
