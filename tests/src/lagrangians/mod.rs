//! Scenes given by their Lagrangians; [`formulas`](crate::formulas) contains their Hamiltonians.

symplectic::lagrangian! {
    /// Kepler's problem in the plane.
    pub Kepler
    q: [2], v: [2];
    L = |v|^2/2 + 1/|q|
    require: [separable, unit_masses, time_independent]
}

symplectic::lagrangian! {
    /// The Hénon–Heiles system.
    pub HenonHeiles
    q: [x, y], v: [vx, vy];
    L = (vx^2 + vy^2 - x^2 - y^2)/2 - x^2 y + y^3/3
}

symplectic::lagrangian! {
    /// The double pendulum.
    pub DoublePendulum { g: 9.8 }
    q: [a, b], v: [va, vb];
    let d = a - b;
    L = va^2 + vb^2/2 + va vb cos(d) + g (2 cos(a) + cos(b))
}

symplectic::lagrangian! {
    /// The double pendulum in Cartesian velocities.
    pub CartesianDoublePendulum { g: 9.8 }
    q: [a, b], v: [va, vb];
    let first = [cos(a) va, sin(a) va];
    let second = first + [cos(b) vb, sin(b) vb];
    L = (|first|^2 + |second|^2)/2 + g (2 cos(a) + cos(b))
}

symplectic::lagrangian! {
    /// A charged particle in a magnetic field.
    pub ChargedParticle
    q: [x, y, z], v: [vx, vy, vz];
    let r = hypot(x, y);
    let A = [-y r/3, x r/3, 0];
    L = |v|^2/2 + dot(A, v) - (x^3 - y^3 + x^4/5 + y^4 + z^4)
}

symplectic::lagrangian! {
    /// A pendulum on a stiff spring.
    pub SpringPendulum { omega }
    q: [2], v: [2];
    L = |v|^2/2 - omega^2 (|q| - 1)^2/2 - q[1]
}

symplectic::lagrangian! {
    /// A pendulum on a stiff spring, in polar coordinates.
    pub PolarSpringPendulum { omega }
    q: [r, f], v: [vr, vf];
    let w = [vr cos(f) - r sin(f) vf, vr sin(f) + r cos(f) vf];
    L = |w|^2/2 - omega^2 (r - 1)^2/2 - r sin(f)
}

symplectic::lagrangian! {
    /// Gravitating bodies in space.
    pub Planets<N> { m: [N], G: 2.95912208286e-4 }
    q: [N; 3], v: [N; 3];
    L = sum(i in 0..N: m[i] |v[i]|^2/2) + sum(i < j: G m[i] m[j]/|q[i] - q[j]|)
    invariants: {
        momentum = sum(i: p[i]),
        angular_momentum = sum(i: cross(q[i], p[i])),
    }
    require: [separable, quadratic_kinetic]
}

symplectic::lagrangian! {
    /// The sine-Gordon lattice.
    pub SineGordon { stiffness: 16 }
    q: [..], v: [..]; bonds: ring;
    L = sum(i: v[i]^2/2 - 1 + cos(q[i])) - sum(bonds d: stiffness d^2/2)
    require: [chain]
}

symplectic::lagrangian! {
    /// Five pendulums, all coupled by the kinetic energy.
    pub FivePendulums { g: 9.81 }
    q: [5], v: [5];
    L = sum(i: 5 v[i]^2/2 + g cos(q[i])) + sum(i < j: v[i] v[j] cos(q[i] - q[j])/2)
}
