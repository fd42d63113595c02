symplectic::tableau! {
    /// Störmer–Verlet.
    pub StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) }
    /// The implicit midpoint rule.
    pub Midpoint { basis: polynomial(1), nodes: gauss(1) }
}
