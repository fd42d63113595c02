//! Splittings and compositions for separable Hamiltonians with exact coefficients.
//!
//! If a paper prints digits, the closed form is the solution of the order conditions with these digits. The test
//! `splittings` compares both, and the orders are proved like those of any other method. The letters: drifts and
//! kicks here are `a_i`, `b_i` in McLachlan (1995) and `c_i`, `d_i` in Ruth (1983), Forest & Ruth (1990) and Yoshida
//! (1990).

use super::Row;

pub(super) const ROWS: &[Row] = &[
    Row {
        name: "velocity-verlet",
        title: "Störmer–Verlet as kick, drift, kick",
        definition: "kick: [1/2, 1/2], drift: [1, 0]",
        stages: &[2],
        source: "Verlet 1967; Swope, Andersen, Berens & Wilson 1982; for separable Hamiltonians the method of stormer-verlet",
    },
    Row {
        name: "position-verlet",
        title: "Störmer–Verlet as drift, kick, drift",
        definition: "kick: [1, 0], drift: [1/2, 1/2], first: drift",
        stages: &[2],
        source: "Tuckerman, Berne & Martyna 1992; for separable Hamiltonians the method of lobatto-2-exchanged",
    },
    Row {
        name: "ruth-1983",
        title: "Ruth's method of order 3",
        definition: "kick: [7/24, 3/4, -1/24], drift: [2/3, -2/3, 1]",
        stages: &[3],
        source: "Ruth, A canonical integration technique, IEEE Trans. Nucl. Sci. 30 (1983)",
    },
    Row {
        name: "forest-ruth-1990",
        title: "the triple jump of order 4 as a splitting",
        definition: "kick: [1/(4 - 2*cbrt(2)), (1 - cbrt(2))/(4 - 2*cbrt(2))], \
                     drift: [1/(2 - cbrt(2)), -cbrt(2)/(2 - cbrt(2))], symmetric: true",
        stages: &[4],
        source: "Forest & Ruth, Fourth-order symplectic integration, Physica D 43 (1990); \
                 Candy & Rozmus, J. Comput. Phys. 92 (1991); Yoshida 1990",
    },
    Row {
        name: "suzuki-1990",
        title: "Suzuki's fractal of order 4 as a splitting",
        definition: "base: velocity-verlet, weights: suzuki(4)",
        stages: &[6],
        source: "Suzuki, Phys. Lett. A 146 (1990)",
    },
    Row {
        name: "mclachlan-1995-s2",
        title: "two kicks a step with the smallest error of order 2",
        definition: "kick: [1/2 - root(24*t^3 + t - 1, 1), 2*root(24*t^3 + t - 1, 1)], drift: [1/2], symmetric: true",
        stages: &[3],
        source: "McLachlan, On the numerical integration of ordinary differential equations by symmetric composition methods, \
                 SIAM J. Sci. Comput. 16 (1995); the closed form is a root of the cubic that has its 20 printed digits; \
                 Omelyan, Mryglod & Folk 2002",
    },
    Row {
        name: "mclachlan-1995-s4",
        title: "four kicks a step, order 4",
        definition: "kick: [(642 + sqrt(471))/3924, 121*(12 - sqrt(471))/3924, \
                     1 - 2*(642 + sqrt(471))/3924 - 2*121*(12 - sqrt(471))/3924], drift: [6/11, -1/22], symmetric: true",
        stages: &[5],
        source: "McLachlan, SIAM J. Sci. Comput. 16 (1995), S, m = 4",
    },
    Row {
        name: "mclachlan-1995-s5",
        title: "five kicks a step, order 4",
        definition: "kick: [(14 - sqrt(19))/108, (20 - 7*sqrt(19))/108, 1/2 - (14 - sqrt(19))/108 - (20 - 7*sqrt(19))/108], \
                     drift: [2/5, -1/10, 2/5], symmetric: true",
        stages: &[6],
        source: "McLachlan, SIAM J. Sci. Comput. 16 (1995), S, m = 5",
    },
    Row {
        name: "mclachlan-1995-ss5",
        title: "five steps of Störmer–Verlet, order 4",
        definition: "base: velocity-verlet, weights: [7/25, root(93750*t^3 - 82500*t^2 + 18150*t - 2017, 1), \
                     11/25 - 2*root(93750*t^3 - 82500*t^2 + 18150*t - 2017, 1)], symmetric: true",
        stages: &[6],
        source: "McLachlan, SIAM J. Sci. Comput. 16 (1995), SS, m = 5; the closed form solves 2z₁³ + 2z₂³ + z₃³ = 0 with z₁ = 7/25",
    },
    Row {
        name: "mclachlan-1995-sb3a4",
        title: "four kicks a step, order 4",
        definition: "kick: [1, -1/2], drift: [1/2 - sqrt(14)/12, -1/3 + sqrt(14)/12, 2/3], first: drift, symmetric: true",
        stages: &[5],
        source: "McLachlan, SIAM J. Sci. Comput. 16 (1995); the closed form solves the conditions of order 3 for its rational kicks",
    },
    Row {
        name: "mclachlan-1995-sb3a5",
        title: "five kicks a step, order 4",
        definition: "kick: [-3/73, 17/59, 2179/4307], \
                     drift: [-229483763/1729961856 + 365*sqrt(722025967665)/576653952, \
                     18550249/123568704 - 1081*sqrt(722025967665)/2100667968, \
                     1/2 - (-229483763/1729961856 + 365*sqrt(722025967665)/576653952) \
                     - (18550249/123568704 - 1081*sqrt(722025967665)/2100667968)], first: drift, symmetric: true",
        stages: &[6],
        source: "McLachlan, SIAM J. Sci. Comput. 16 (1995); the closed form solves the conditions of order 3 for the kicks -3/73 and 17/59, \
                 whose 20 digits are printed",
    },
    Row {
        name: "mclachlan-atela-1992-order-2-optimal",
        title: "two kicks a step with the smallest error of order 2, not symmetric",
        definition: "kick: [1 - sqrt(2)/2, sqrt(2)/2], drift: [sqrt(2)/2, 1 - sqrt(2)/2]",
        stages: &[2],
        source: "McLachlan & Atela, The accuracy of symplectic integrators, Nonlinearity 5 (1992)",
    },
    Row {
        name: "mclachlan-atela-1992-order-3-optimal",
        title: "three kicks a step with the smallest error of order 3, not symmetric",
        definition: "kick: [-1/3 + 3/2*root(12*t^4 - 24*t^2 + 16*t - 3, 2) - root(12*t^4 - 24*t^2 + 16*t - 3, 2)^3, \
                     4/3 - 5/2*root(12*t^4 - 24*t^2 + 16*t - 3, 2) + root(12*t^4 - 24*t^2 + 16*t - 3, 2)^3, \
                     root(12*t^4 - 24*t^2 + 16*t - 3, 2)], \
                     drift: [root(12*t^4 - 24*t^2 + 16*t - 3, 2), \
                     4/3 - 5/2*root(12*t^4 - 24*t^2 + 16*t - 3, 2) + root(12*t^4 - 24*t^2 + 16*t - 3, 2)^3, \
                     -1/3 + 3/2*root(12*t^4 - 24*t^2 + 16*t - 3, 2) - root(12*t^4 - 24*t^2 + 16*t - 3, 2)^3]",
        stages: &[3],
        source: "McLachlan & Atela, The accuracy of symplectic integrators, Nonlinearity 5 (1992); \
                 the quartic is the condition of order 3 for kicks that are the drifts in reverse",
    },
    Row {
        name: "chin-1997-c",
        title: "two kicks and a gradient kick in the middle, order 4 for quadratic T, positive coefficients",
        definition: "kick: [1/6, 2/3], drift: [1/2], gradient: [0, 1/72], symmetric: true",
        stages: &[3],
        source: "Suzuki, Phys. Lett. A 201 (1995); Chin, Symplectic integrators from composite operator factorizations, \
                 Phys. Lett. A 226 (1997); called 4A by Chin & Chen 2005, and C elsewhere; \
                 the gradient weight is the one with which the conditions of order 3 hold",
    },
    Row {
        name: "chin-chen-2002-4b",
        title: "two gradient kicks, order 4 for quadratic T, positive coefficients",
        definition: "kick: 1/2, drift: [1/2 - sqrt(3)/6, sqrt(3)/3], gradient: 1/24 - sqrt(3)/48, first: drift, symmetric: true",
        stages: &[3],
        source: "Suzuki, Phys. Lett. A 201 (1995); Chin, Phys. Lett. A 226 (1997); 4B of Chin & Chen, Gradient symplectic algorithms for \
                 solving the Schrödinger equation with time-dependent potentials, J. Chem. Phys. 117 (2002); \
                 the gradient weight is the one with which the conditions of order 3 hold",
    },
    Row {
        name: "chin-chen-2002-4c",
        title: "two kicks and a gradient kick between them, order 4 for quadratic T, positive coefficients",
        definition: "kick: [3/8, 1/4], drift: [1/6, 1/3], gradient: [0, 1/192], first: drift, symmetric: true",
        stages: &[4],
        source: "4C of Chin & Chen, Gradient symplectic algorithms for solving the Schrödinger equation with time-dependent potentials, \
                 J. Chem. Phys. 117 (2002); the gradient weight is the one with which the conditions of order 3 hold",
    },
    Row {
        name: "triple-jump-4",
        title: "three steps of Störmer–Verlet",
        definition: "base: stormer-verlet, weights: triple_jump(4)",
        stages: &[6],
        source: "Creutz & Gocksch 1989; Forest 1989; Suzuki 1990; Yoshida, Phys. Lett. A 150 (1990); \
                 Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.4",
    },
    Row {
        name: "triple-jump-6",
        title: "nine steps of Störmer–Verlet",
        definition: "base: stormer-verlet, weights: triple_jump(6)",
        stages: &[18],
        source: "Yoshida, Phys. Lett. A 150 (1990), §2; Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.4",
    },
    Row {
        name: "triple-jump-8",
        title: "27 steps of Störmer–Verlet as a splitting",
        definition: "base: velocity-verlet, weights: triple_jump(8)",
        stages: &[28],
        source: "Yoshida, Phys. Lett. A 150 (1990), §2; Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.4",
    },
    Row {
        name: "triple-jump-10",
        title: "81 steps of Störmer–Verlet as a splitting",
        definition: "base: velocity-verlet, weights: triple_jump(10)",
        stages: &[82],
        source: "Yoshida, Phys. Lett. A 150 (1990), §2; Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.4",
    },
    Row {
        name: "suzuki-4",
        title: "five steps of Störmer–Verlet",
        definition: "base: stormer-verlet, weights: suzuki(4)",
        stages: &[10],
        source: "Suzuki, Phys. Lett. A 146 (1990); Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.4",
    },
    Row {
        name: "suzuki-6",
        title: "25 steps of Störmer–Verlet as a splitting",
        definition: "base: velocity-verlet, weights: suzuki(6)",
        stages: &[26],
        source: "Suzuki, Phys. Lett. A 146 (1990); Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.4",
    },
    Row {
        name: "suzuki-8",
        title: "125 steps of Störmer–Verlet as a splitting",
        definition: "base: velocity-verlet, weights: suzuki(8)",
        stages: &[126],
        source: "Suzuki, Phys. Lett. A 146 (1990); Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.4",
    },
    Row {
        name: "suzuki-10",
        title: "625 steps of Störmer–Verlet as a splitting",
        definition: "base: velocity-verlet, weights: suzuki(10)",
        stages: &[626],
        source: "Suzuki, Phys. Lett. A 146 (1990); Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.4",
    },
    Row {
        name: "kahan-li-1997-s5odr4-a",
        title: "five steps of Störmer–Verlet, order 4",
        definition: "base: velocity-verlet, weights: [1/2 + sqrt(3)/6, 1/2 - sqrt(3)/6, -1], symmetric: true",
        stages: &[6],
        source: "Kahan & Li, Math. Comp. 66 (1997), s5odr4a",
    },
    Row {
        name: "kahan-li-1997-s5odr4-b",
        title: "five steps of Störmer–Verlet, order 4",
        definition: "base: velocity-verlet, weights: [1/2 - sqrt(3)/6, 1/2 + sqrt(3)/6, -1], symmetric: true",
        stages: &[6],
        source: "Kahan & Li, Math. Comp. 66 (1997), s5odr4b",
    },
];
