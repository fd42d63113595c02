//! Methods that only the report runs, beside those of `symplectic_tests::methods`.

symplectic::composition! {
    /// Blanes & Moan S6, order 4.
    pub BlanesMoanS6 { base: blanes-moan-2002-s6 }

    /// Blanes & Moan S10, order 6.
    pub BlanesMoanS10 { base: blanes-moan-2002-s10 }

    /// Blanes & Moan SRKN 11b, order 6 for quadratic kinetic energy.
    pub BlanesMoanSrkn11b { base: blanes-moan-2002-srkn11b }

    /// Yoshida's solution D, order 8.
    pub Yoshida8 { base: yoshida-1990-order-8-d }

    /// Kahan & Li, order 8 with 17 steps of Störmer–Verlet.
    pub KahanLi8 { base: kahan-li-1997-s17odr8-a }

    /// Sofroniou & Spaletta, order 10 with 35 steps of Störmer–Verlet.
    pub SofroniouSpaletta10 { base: sofroniou-spaletta-2005-s35odr10 }
}

symplectic::tableau! {
    /// The implicit midpoint rule, which is the variational Newmark method with γ = 1/2 in other variables, order 2.
    pub Midpoint { basis: polynomial(1), nodes: gauss(1) }
}
