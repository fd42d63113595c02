//! The methods of the tests.

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

    /// Lobatto IIIA–IIIB with five stages, order 8.
    pub Lobatto5 { basis: polynomial(5), nodes: lobatto(5), require: [symplectic, symmetric, order == 8] }

    /// Gauss with two stages, order 4.
    pub Gauss2 {
        basis: polynomial(2), nodes: gauss(2), require: [symplectic, symmetric, equal_matrices, order == 4, p_stable]
    }

    /// Gauss with three stages, order 6.
    pub Gauss3 {
        basis: polynomial(3), nodes: gauss(3), require: [symplectic, symmetric, equal_matrices, order == 6, p_stable]
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

    /// The implicit midpoint rule, which is the variational Newmark method with γ = 1/2 in other variables, order 2.
    pub Midpoint { basis: polynomial(1), nodes: gauss(1), require: [order == 2, p_stable] }

    /// Radau with two stages, with a node at the end of the step.
    pub RadauRight2 { basis: polynomial(2), nodes: radau-right(2), require: [symplectic] }

    /// Radau with three stages, with a node at the end of the step.
    pub RadauRight3 { basis: polynomial(3), nodes: radau-right(3), require: [symplectic] }

    /// Clenshaw–Curtis with four stages.
    pub ClenshawCurtis4 { basis: polynomial(4), nodes: clenshaw-curtis(4), require: [symplectic, symmetric] }

    /// Galerkin: polynomials of degree two and Gauss quadrature with three nodes.
    pub GalerkinGauss3 { basis: legendre(2), quadrature: gauss(3), require: [symplectic, symmetric] }

    /// A trigonometric basis on the nodes of Gauss: symplectic and symmetric, verified but not proved.
    pub TrigonometricGauss4 { basis: [1, t, cos(t), sin(t)], nodes: gauss(4) }
}

symplectic::composition! {
    /// Störmer–Verlet as a splitting: half a kick, a drift, half a kick.
    pub VelocityVerlet { base: velocity-verlet }

    /// Five Störmer–Verlet steps, order 4.
    pub Suzuki4 { base: stormer-verlet, weights: suzuki(4), require: [order == 4] }

    /// Five midpoint steps, order 4, also with non-holonomic constraints.
    pub Midpoint4 { base: gauss-1, weights: suzuki(4), require: [order == 4] }

    /// Twenty-five midpoint steps, order 6, also with non-holonomic constraints.
    pub Midpoint6 { base: gauss-1, weights: suzuki(6), require: [order == 6] }

    /// Five steps of Lobatto with two stages, with constraints of RATTLE, order 4.
    pub Rattle4 { base: lobatto-2, weights: suzuki(4), require: [order == 4] }

    /// Nine steps of Lobatto with two stages, with constraints of RATTLE, order 6.
    pub Rattle6 { base: lobatto-2, weights: triple_jump(6), require: [order == 6] }

    /// Forest & Ruth, order 4.
    pub ForestRuth { base: forest-ruth-1990 }

    /// Blanes & Moan, order 6 for quadratic kinetic energy.
    pub BlanesMoanSrkn14a { base: blanes-moan-2002-srkn14a }

    /// Ruth, order 3.
    pub Ruth3 { base: ruth-1983 }

    /// McLachlan & Atela, order 4 with the smallest error constant among such methods.
    pub McLachlanAtela4 { base: mclachlan-atela-1992-order-4-optimal }

    /// Blanes & Moan S6, order 4.
    pub BlanesMoanS6 { base: blanes-moan-2002-s6 }

    /// Blanes & Moan S10, order 6.
    pub BlanesMoanS10 { base: blanes-moan-2002-s10 }

    /// Blanes & Moan SRKN 11b, order 6 for quadratic kinetic energy.
    pub BlanesMoanSrkn11b { base: blanes-moan-2002-srkn11b }

    /// Blanes, Casas & Escorihuela-Tomàs, order 8 for quadratic kinetic energy.
    pub BlanesA19 { base: blanes-casas-escorihuela-2022-a19 }

    /// Blanes and others, for perturbed systems.
    pub BlanesPerturbed { base: blanes-2013-aba-10-6-4 }

    /// Yoshida's solution D, order 8.
    pub Yoshida8 { base: yoshida-1990-order-8-d }

    /// Kahan & Li, order 8 with 17 steps of Störmer–Verlet.
    pub KahanLi8 { base: kahan-li-1997-s17odr8-a }

    /// Kahan & Li, order 8, with a drift first: on Kepler orbits in logarithmic time its only error is that of the time.
    pub KahanLi8Drift { base: kahan-li-1997-s17odr8-b, exchange: true }

    /// Sofroniou & Spaletta, order 10 with 35 steps of Störmer–Verlet.
    pub SofroniouSpaletta10 { base: sofroniou-spaletta-2005-s35odr10 }

    /// Order 8 by triple jumps, with 27 steps of Störmer–Verlet.
    pub TripleJump8 { base: triple-jump-8 }

    /// Order 6 by a triple jump of three implicit steps.
    pub GaussTripleJump { base: gauss-2, weights: triple_jump(6) }
}
