//! Methods from the macro.

symplectic::tableau! {
    /// Symplectic Euler: implicit in the position, explicit in the momentum; explicit for separable systems.
    pub SymplecticEuler { basis: polynomial(1), nodes: [0], require: [symplectic, explicit, order == 1] }

    /// Störmer–Verlet, order 2, explicit for separable systems.
    pub StoermerVerlet {
        basis: polynomial(2), nodes: lobatto(2), require: [symplectic, symmetric, explicit, first_same_as_last, order == 2, stable_to(19/10)]
    }

    /// Lobatto IIIA–IIIB with three stages, order 4.
    pub Lobatto3 { basis: polynomial(3), nodes: lobatto(3), require: [symplectic, symmetric, order == 4] }

    /// Lobatto IIIA–IIIB with four stages, order 6.
    pub Lobatto4 { basis: polynomial(4), nodes: lobatto(4), require: [symplectic, symmetric, order == 6] }

    /// Gauss with two stages, order 4.
    pub Gauss2 {
        basis: polynomial(2), nodes: gauss(2), require: [symplectic, symmetric, equal_matrices, order == 4, p_stable]
    }

    /// Gauss with four stages, order 8.
    pub Gauss4 {
        basis: polynomial(4), nodes: gauss(4), require: [symplectic, symmetric, equal_matrices, order == 8, p_stable]
    }

    /// Gauss with six stages, order 12.
    pub Gauss6 {
        basis: polynomial(6), nodes: gauss(6), require: [symplectic, symmetric, equal_matrices, order == 12]
    }

    /// Gauss with eight stages, order 16: for references.
    pub Gauss8 {
        basis: polynomial(8), nodes: gauss(8), require: [symplectic, symmetric, equal_matrices, order == 16]
    }
}

symplectic::composition! {
    /// Störmer–Verlet as a splitting: half a kick, a drift, half a kick.
    pub VelocityVerlet { base: velocity-verlet }

    /// Forest & Ruth, order 4.
    pub ForestRuth { base: forest-ruth-1990 }

    /// Blanes & Moan, order 6 for quadratic kinetic energy.
    pub BlanesMoanSrkn14a { base: blanes-moan-2002-srkn14a }
}
