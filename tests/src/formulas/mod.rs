//! The scenes as formulas, from which all equations are derived.
//!
//! The same systems written by hand are in [`scenes`](crate::scenes). Tests check that both agree, and benches compare
//! their speed. The restricted three-body problem is here only.

symplectic::hamiltonian! {
    /// The harmonic oscillator.
    pub HarmonicOscillator { omega }
    q: [x], p: [px];
    H = (px^2 + omega^2 x^2)/2
}

symplectic::hamiltonian! {
    /// The pendulum.
    pub Pendulum
    q: [a], p: [pa];
    H = pa^2/2 - cos(a)
}

symplectic::hamiltonian! {
    /// The Kepler problem in the plane.
    pub Kepler
    q: [2], p: [2];
    H = |p|^2/2 - 1/|q|
    require: [separable, unit_masses, time_independent]
}

symplectic::hamiltonian! {
    /// The planar restricted three-body problem, in the frame that rotates with the Earth and the Moon.
    pub RestrictedThreeBody { mu: 0.01215058560962404 }
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + y px - x py - (1 - mu)/hypot(x + mu, y) - mu/hypot(x - 1 + mu, y)
}

symplectic::hamiltonian! {
    /// The Hénon–Heiles system.
    pub HenonHeiles
    q: [x, y], p: [px, py];
    H = (px^2 + py^2 + x^2 + y^2)/2 + x^2 y - y^3/3
}

symplectic::hamiltonian! {
    /// The double pendulum.
    pub DoublePendulum { g: 9.8 }
    q: [a, b], p: [pa, pb];
    let d = a - b;
    H = (pa^2 + 2 pb^2 - 2 pa pb cos(d))/(2 (1 + sin(d)^2)) - g (2 cos(a) + cos(b))
}

symplectic::hamiltonian! {
    /// Gravitating bodies in space.
    pub Planets<N> { m: [N], G: 2.95912208286e-4 }
    q: [N; 3], p: [N; 3];
    H = sum(i in 0..N: |p[i]|^2/(2 m[i])) - sum(i < j: G m[i] m[j]/|q[i] - q[j]|)
    invariants: {
        momentum = sum(i: p[i]),
        angular_momentum = sum(i: cross(q[i], p[i])),
    }
    require: [separable, quadratic_kinetic]
}

symplectic::hamiltonian! {
    /// The three bodies of Burrau, in the plane.
    pub PythagoreanThreeBody { m: [3] }
    q: [3; 2], p: [3; 2];
    H = sum(i: |p[i]|^2/(2 m[i])) - sum(i < j: m[i] m[j]/|q[i] - q[j]|)
}

symplectic::hamiltonian! {
    /// Argon atoms in the plane.
    pub ArgonCrystal { depth: 119.8, sigma: 0.341, m }
    q: [7; 2], p: [7; 2];
    let s(i, j) = sigma^2/|q[i] - q[j]|^2;
    H = sum(i: |p[i]|^2)/(2 m) + sum(i < j: 4 depth (s(i, j)^6 - s(i, j)^3))
}

symplectic::hamiltonian! {
    /// A charged particle in a magnetic field.
    pub ChargedParticle
    q: [x, y, z], p: [px, py, pz];
    let r = hypot(x, y);
    let A = [-y r/3, x r/3, 0];
    H = |p - A|^2/2 + x^3 - y^3 + x^4/5 + y^4 + z^4
}

symplectic::hamiltonian! {
    /// A particle in a potential with a ridge.
    pub DampedParticle
    q: [2], p: [2];
    H = |p|^2/2 + |q|^2 (|q|^2 - 1)^2
}

symplectic::hamiltonian! {
    /// A pendulum on a stiff spring.
    pub SpringPendulum { omega }
    q: [2], p: [2];
    H = |p|^2/2 + omega^2 (|q| - 1)^2/2 + q[1]
}

symplectic::hamiltonian! {
    /// A polynomial system that is not separable.
    pub Nonseparable
    q: [x], p: [px];
    H = (x^2 + 1) (px^2 + 1)/2
}

symplectic::hamiltonian! {
    /// A system without a Lagrangian.
    pub Hyperbolic
    q: [x], p: [px];
    H = x px
}

symplectic::hamiltonian! {
    /// The first post-Newtonian two-body problem.
    pub PostNewtonianKepler { epsilon, nu }
    q: [2], p: [2];
    let r = |q|;
    let radial = dot(q, p)/r;
    H = |p|^2/2 - 1/r
        + epsilon (1/(2 r^2) - (1 - 3 nu) |p|^4/8 - ((3 + nu) |p|^2 + nu radial^2)/(2 r))
}

symplectic::hamiltonian! {
    /// Point vortices; the momenta are strengths times heights.
    pub PointVortices<N> { strength: [N] }
    q: [N], p: [N];
    let y(i) = p[i]/strength[i];
    H = -sum(i < j: strength[i] strength[j] ln((q[i] - q[j])^2 + (y(i) - y(j))^2)/2)
}

symplectic::hamiltonian! {
    /// Masses between walls, joined by stiff and soft springs in turn.
    pub FputSprings { omega: 50 }
    q: [6], p: [6];
    H = |p|^2/2 + omega^2 sum(i in 3..6: q[i]^2)/2
        + ((q[0] - q[3])^4 + sum(i in 0..2: (q[i+1] - q[i+4] - q[i] - q[i+3])^4) + (q[2] + q[5])^4)/4
}

symplectic::hamiltonian! {
    /// The chain of Fermi, Pasta, Ulam and Tsingou.
    pub FputChain
    q: [..], p: [..]; bonds: walls;
    H = sum(i: p[i]^2/2) + sum(bonds d: d^2/2 + d^4/4)
    require: [chain]
}

symplectic::hamiltonian! {
    /// The sine-Gordon lattice.
    pub SineGordon { stiffness: 16 }
    q: [..], p: [..]; bonds: ring;
    H = sum(i: p[i]^2/2 + 1 - cos(q[i])) + sum(bonds d: stiffness d^2/2)
}
