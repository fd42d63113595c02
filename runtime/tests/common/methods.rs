//! The methods of the tests.

symplectic::tableau! {
    /// Drift, then kick. Force and velocity of a stage have different times.
    pub SymplecticEuler { basis: polynomial(1), nodes: [0] }
    /// Kick, then drift: the adjoint of [`SymplecticEuler`].
    pub AdjointEuler { basis: polynomial(1), nodes: [1] }
    /// Störmer–Verlet.
    pub StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) }
    /// Gauss with one stage: the implicit midpoint rule.
    pub Midpoint { basis: polynomial(1), nodes: gauss(1) }
    pub Gauss2 { basis: polynomial(2), nodes: gauss(2) }
    pub Gauss3 { basis: polynomial(3), nodes: gauss(3) }
    pub Gauss4 { basis: polynomial(4), nodes: gauss(4) }
    pub Gauss5 { basis: polynomial(5), nodes: gauss(5) }
    pub Gauss7 { basis: polynomial(7), nodes: gauss(7) }
    pub Gauss8 { basis: polynomial(8), nodes: gauss(8) }
    pub Gauss10 { basis: polynomial(10), nodes: gauss(10) }
    pub Gauss18 { basis: polynomial(18), nodes: gauss(18) }
    pub Lobatto3 { basis: polynomial(3), nodes: lobatto(3) }
    pub Lobatto4 { basis: polynomial(4), nodes: lobatto(4) }
    pub Radau2 { basis: polynomial(2), nodes: radau-right(2) }
    pub Radau3 { basis: polynomial(3), nodes: radau-right(3) }
    /// With the coefficients of positions and momenta exchanged.
    pub RadauIA { basis: polynomial(2), nodes: radau-right(2), exchange: true }
    /// More nodes than functions.
    pub Tang { basis: legendre(2), quadrature: gauss(3) }
    /// A basis that is not polynomial.
    pub Waves { basis: [1, cos(pi*t), sin(pi*t)], nodes: [0, 1/2, 1] }
    /// Nodes that belong to no quadrature rule: not symmetric, and c̃ differs from c.
    pub Askew { basis: polynomial(3), nodes: [1/10, 1/2, 4/5] }
    /// Not symplectic.
    pub RadauIIA { a: [[5/12, -1/12], [3/4, 1/4]], b: [3/4, 1/4] }
    /// Not symplectic; each stage can be solved after the one before it.
    pub Weighted { a: [[1/4, 0], [1/2, 1/3]], b: [1/2, 1/2] }
    /// Stages at the same time: the stages of the next step cannot be extrapolated from them.
    pub Twins { a: [[1/2, 0], [0, 1/2]], b: [1/2, 1/2] }
    pub ForestRuth { base: forest-ruth-1990 }
    /// Order 4 for quadratic kinetic energy only.
    pub McLachlanAtela { base: mclachlan-atela-1992-order-4-optimal }
    /// With a gradient kick.
    pub Chin { base: chin-1997-c }
    /// With gradient kicks at both ends.
    pub ChinChen { kick: [1/8, 3/8], drift: [1/3, 1/3], gradient: [1/384, 0], symmetric: true }
}

symplectic::composition! {
    pub TripleJump { base: velocity-verlet, weights: triple_jump(4) }
    pub PositionJump { base: position-verlet, weights: triple_jump(4) }
    pub Yoshida6 { base: StoermerVerlet, weights: triple_jump(6) }
    /// A composition of steps with coupled stages.
    pub TripleMidpoint { base: Midpoint, weights: triple_jump(4) }
    pub Gauss6 { base: gauss-2, weights: triple_jump(6) }
}
