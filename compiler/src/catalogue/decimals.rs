//! Splittings by printed decimals: the exact method near the digits is certified.
//!
//! The letters are those of [`super::splittings`]. Where the order conditions leave coefficients free, because the paper
//! minimised an error norm, these are the printed decimals.

use super::Row;

pub(super) const ROWS: &[Row] = &[
    Row {
        name: "blanes-moan-2002-s6",
        title: "six kicks a step, order 4",
        definition: "kick: [0.079203696431195700, 0.35317290604977400, -0.042065080357719500, 0.21937695575349960], \
                     drift: [0.20951510661336200, -0.14385177317981800, 0.43433666656645600], symmetric: true, claim: \
                     separable(4)",
        stages: &[7],
        source: "Blanes & Moan, Practical symplectic partitioned Runge–Kutta and Runge–Kutta–Nyström methods, J. \
                 Comput. Appl. Math. 142 (2002), S₆",
    },
    Row {
        name: "blanes-moan-2002-s10",
        title: "ten kicks a step, order 6",
        definition: "kick: [0.050262764400392200, 0.41351430042834400, 0.045079889794397700, -0.18805485381956900, \
                     0.54196067845078000, -0.7255255585086898], drift: [0.14881644790104200, -0.13238586576778400, \
                     0.067307604692185000, 0.43266640257817500, -0.01640458940361800], symmetric: true, claim: \
                     separable(6)",
        stages: &[11],
        source: "Blanes & Moan, Practical symplectic partitioned Runge–Kutta and Runge–Kutta–Nyström methods, J. \
                 Comput. Appl. Math. 142 (2002), S₁₀",
    },
    Row {
        name: "blanes-moan-2002-srkn6b",
        title: "six kicks a step, order 4, the smallest error for quadratic T",
        definition: "kick: [0.082984406417405200, 0.39630980149836800, -0.039056304922348600, 0.1195241940131508], \
                     drift: [0.24529895718427100, 0.60487266571108000, -0.35017162289535100], symmetric: true, claim: \
                     separable(4)",
        stages: &[7],
        source: "Blanes & Moan, Practical symplectic partitioned Runge–Kutta and Runge–Kutta–Nyström methods, J. \
                 Comput. Appl. Math. 142 (2002), SRKN₆ᵇ",
    },
    Row {
        name: "blanes-moan-2002-srkn11b",
        title: "eleven kicks a step, order 6 for quadratic T",
        definition: "kick: [0.041464998518262400, 0.19812867191806700, -0.040006192104153300, 0.075253984301580700, \
                     -0.011511387420687900, 0.23666992478693110], drift: [0.12322977594627100, 0.29055379779955800, \
                     -0.12704921262541700, -0.24633176106207500, 0.35720887279592800, 0.2047770542914700], symmetric: \
                     true, claim: nystrom(6)",
        stages: &[12],
        source: "Blanes & Moan, Practical symplectic partitioned Runge–Kutta and Runge–Kutta–Nyström methods, J. \
                 Comput. Appl. Math. 142 (2002), SRKN₁₁ᵇ",
    },
    Row {
        name: "blanes-moan-2002-srkn14a",
        title: "14 kicks a step, order 6 for quadratic T",
        definition: "kick: [0.091719152624461650, 0.18398317000500600, -0.056534365832888270, 0.0049146887747128540, \
                     0.14376112716835800, 0.32856769374680400, -0.19641146648645423], drift: [0.037859319840611600, \
                     0.10263563310243500, -0.025867888266558700, 0.31424140307144700, -0.13014445951741500, \
                     0.10641770036954300, -0.0087942431285105800, 0.2073050690568954], first: drift, symmetric: true, \
                     claim: nystrom(6)",
        stages: &[15],
        source: "Blanes & Moan, Practical symplectic partitioned Runge–Kutta and Runge–Kutta–Nyström methods, J. \
                 Comput. Appl. Math. 142 (2002), SRKN₁₄ᵃ",
    },
    Row {
        name: "mclachlan-atela-1992-order-4-optimal",
        title: "four kicks a step, order 4 for quadratic T, not symmetric",
        definition: "kick: [0.1344961992774310892, -0.2248198030794208058, 0.7563200005156682911, \
                     0.3340036032863214255], drift: [0.5153528374311229364, -0.085782019412973646, \
                     0.4415830236164665242, 0.1288461583653841854], claim: nystrom(4)",
        stages: &[4],
        source: "McLachlan & Atela, The accuracy of symplectic integrators, Nonlinearity 5 (1992); of order 3 for \
                 other separable H",
    },
    Row {
        name: "mclachlan-atela-1992-order-5-optimal",
        title: "six kicks a step, order 5 for quadratic T, not symmetric",
        definition: "kick: [0.1193900292875672758, 0.6989273703824752308, -0.1713123582716007754, \
                     0.4012695022513534480, 0.0107050818482359840, -0.0589796254980311632], drift: \
                     [0.339839625839110000, -0.088601336903027329, 0.5858564768259621188, -0.603039356536491888, \
                     0.3235807965546976394, 0.4423637942197494587], claim: nystrom(5)",
        stages: &[6],
        source: "McLachlan & Atela, The accuracy of symplectic integrators, Nonlinearity 5 (1992); of order 3 for \
                 other separable H",
    },
    Row {
        name: "okunbor-skeel-1994-order-6-method-13",
        title: "seven kicks a step, order 6 for quadratic T",
        definition: "kick: [0.00016600692650009894, -0.37962421426377360608, 0.68913741185181063674, \
                     0.38064159097092574080], drift: [-1.0130879789171747298, 1.1874295737325427070, \
                     -0.018335852096460590340, 0.34399425728109261313], first: drift, symmetric: true, claim: \
                     nystrom(6)",
        stages: &[8],
        source: "Okunbor & Skeel, Canonical Runge–Kutta–Nyström methods of orders five and six, J. Comput. Appl. \
                 Math. 51 (1994), method 13",
    },
    Row {
        name: "pefrl",
        title: "four kicks a step, order 4, drifts first",
        definition: "kick: [0.7123418310626056, -0.2123418310626054], drift: [0.1786178958448091, \
                     -0.06626458266981849, 0.77529337365001878], first: drift, symmetric: true, claim: separable(4)",
        stages: &[5],
        source: "Omelyan, Mryglod & Folk, Optimized Forest–Ruth- and Suzuki-like algorithms for integration of motion \
                 in many-body systems, Comput. Phys. Commun. 146 (2002), the position extended Forest–Ruth-like \
                 algorithm; ξ, λ and χ there are here the first drift, the second kick and the second drift",
    },
    Row {
        name: "omelyan-mryglod-folk-2003-velocity-5",
        title: "five kicks a step, order 4",
        definition: "kick: [0.08398315262876693, 0.6822365335719091, -0.26621968620067603], drift: \
                     [0.2539785108410595, -0.03230286765269967, 0.55664871362328034], symmetric: true, claim: \
                     separable(4)",
        stages: &[6],
        source: "Omelyan, Mryglod & Folk, Symplectic analytically integrable decomposition algorithms, Comput. Phys. \
                 Commun. 151 (2003), equations 63 and 71, variant 8; OMF4 of programs for lattice field theory",
    },
    Row {
        name: "ostmeyer-2022-order-4",
        title: "five kicks a step, order 4",
        definition: "kick: [0.09257547473195787, 0.4627160310210738, -0.05529150575303167], drift: \
                     [0.2540996315529392, -0.1676517240119692, 0.82710418491806], symmetric: true, claim: \
                     separable(4)",
        stages: &[6],
        source: "Ostmeyer, Optimised Trotter decompositions for classical and quantum computing, J. Phys. A 56 (2023), \
                 arXiv 2211.02691, equation 40",
    },
    Row {
        name: "blanes-casas-escorihuela-2022-a19",
        title: "19 kicks a step, order 8 for quadratic T",
        definition: "kick: [0.129478606560536730662493794395, 0.222257260092671143423043559581, \
                     -0.0577514893325147204757023246320, -0.0578312262103924910221345032763, \
                     0.103087297437175356747933252265, -0.140819612554090768205554103887, \
                     0.0234462603492826276699713718626, 0.134854517356684096617882205068, \
                     0.0287973821073779306345172160211, 0.2289620083865401878950990652052], drift: [0.0505805, \
                     0.149999, -0.0551795510771615573511026950361, 0.423755898835337951482264998051, \
                     -0.213495353584659048059672194633, -0.0680769774574032619111630736274, \
                     0.227917056974013435948887201671, -0.235373619381058906524740047732, \
                     0.387413869179878047816794031058, -0.1675408234889466614012682197515], first: drift, symmetric: \
                     true, claim: nystrom(8)",
        stages: &[20],
        source: "Blanes, Casas & Escorihuela-Tomàs, Runge–Kutta–Nyström symplectic splitting methods of order 8, Appl. \
                 Numer. Math. 182 (2022), arXiv 2202.01541, table 4, A₁₉",
    },
];
