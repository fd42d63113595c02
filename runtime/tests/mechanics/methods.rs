//! The methods of these tests. Methods for constrained systems only are in [`systems`](super::systems) and [`rolling`](super::rolling).

symplectic::tableau! {
    pub Midpoint { basis: polynomial(1), nodes: gauss(1), require: [nonholonomic, order == 2] }
    pub Gauss2 { basis: polynomial(2), nodes: gauss(2) }
    pub Gauss3 { basis: polynomial(3), nodes: gauss(3) }
    pub Gauss4 { basis: polynomial(4), nodes: gauss(4) }
    pub Gauss6 { basis: polynomial(6), nodes: gauss(6) }
    pub StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) }
    pub Lobatto3 { basis: polynomial(3), nodes: lobatto(3), require: [constrained, order == 4] }
    pub Lobatto4 { basis: polynomial(4), nodes: lobatto(4), require: [constrained, order == 6] }
    pub Lobatto5 { basis: polynomial(5), nodes: lobatto(5), require: [constrained, order == 8] }
    pub ForestRuth { base: forest-ruth-1990 }
    pub Yoshida6 { base: yoshida-1990-order-6-a, accept: verified(100 bits) }
    /// More nodes than functions.
    pub TwoOfThree { basis: polynomial(2), quadrature: gauss(3) }
    /// A basis that is not polynomial.
    pub Cosine { basis: [1, cos(pi*t)], nodes: [0, 1] }
}
