//! Tableaux of the papers, compared exactly.
//!
//! The expected entries are typed from the sources; another test evaluates them in `Q(√d)` and holds
//! them against LZ's own conditions, so that a typing or printing error would show.

use num_rational::BigRational;
use symplectic_compiler::derive;

struct Golden {
    basis: &'static str,
    nodes: &'static str,
    c: &'static [&'static str],
    a: &'static [&'static [&'static str]],
    a_tilde: &'static [&'static [&'static str]],
    b: &'static [&'static str],
}

const GOLDEN: &[Golden] = &[
    // LZ Example 2: symplectic Euler, midpoint, adjoint of symplectic Euler.
    Golden {
        basis: "1",
        nodes: "0",
        c: &["0"],
        a: &[&["0"]],
        a_tilde: &[&["1"]],
        b: &["1"],
    },
    Golden {
        basis: "1",
        nodes: "1/2",
        c: &["1/2"],
        a: &[&["1/2"]],
        a_tilde: &[&["1/2"]],
        b: &["1"],
    },
    Golden {
        basis: "1",
        nodes: "1",
        c: &["1"],
        a: &[&["1"]],
        a_tilde: &[&["0"]],
        b: &["1"],
    },
    // LZ Example 5, s = 1, 2.
    Golden {
        basis: "polynomial(1)",
        nodes: "chebyshev(1)",
        c: &["1/2"],
        a: &[&["1/2"]],
        a_tilde: &[&["1/2"]],
        b: &["1"],
    },
    Golden {
        basis: "polynomial(2)",
        nodes: "chebyshev(2)",
        c: GAUSS2_C,
        a: GAUSS2_A,
        a_tilde: GAUSS2_A,
        b: &["1/2", "1/2"],
    },
    // LZ Example 5, s = 3. The paper prints a_33 = 1/6 − 5√2/48, with which the third row would sum to
    // 1/2 + √2/6 and not to c_3 = 1/2 + √2/4.
    Golden {
        basis: "polynomial(3)",
        nodes: "chebyshev(3)",
        c: &["1/2 - sqrt(2)/4", "1/2", "1/2 + sqrt(2)/4"],
        a: &[
            &["1/6 + sqrt(2)/48", "1/6 - sqrt(2)/6", "1/6 - 5*sqrt(2)/48"],
            &["1/6 + sqrt(2)/8", "1/6", "1/6 - sqrt(2)/8"],
            &["1/6 + 5*sqrt(2)/48", "1/6 + sqrt(2)/6", "1/6 - sqrt(2)/48"],
        ],
        a_tilde: &[
            &["1/6 - sqrt(2)/48", "1/6 - sqrt(2)/8", "1/6 - 5*sqrt(2)/48"],
            &["1/6 + sqrt(2)/6", "1/6", "1/6 - sqrt(2)/6"],
            &["1/6 + 5*sqrt(2)/48", "1/6 + sqrt(2)/8", "1/6 + sqrt(2)/48"],
        ],
        b: &["1/3", "1/3", "1/3"],
    },
    // GNI table II.1.1: Gauss of order 4 and 6.
    Golden {
        basis: "polynomial(2)",
        nodes: "gauss(2)",
        c: GAUSS2_C,
        a: GAUSS2_A,
        a_tilde: GAUSS2_A,
        b: &["1/2", "1/2"],
    },
    Golden {
        basis: "polynomial(3)",
        nodes: "gauss(3)",
        c: GAUSS3_C,
        a: GAUSS3_A,
        a_tilde: GAUSS3_A,
        b: &["5/18", "4/9", "5/18"],
    },
    // GNI §II.2.2: Lobatto IIIA–IIIB with two (Störmer–Verlet) and three stages.
    Golden {
        basis: "polynomial(2)",
        nodes: "lobatto(2)",
        c: &["0", "1"],
        a: &[&["0", "0"], &["1/2", "1/2"]],
        a_tilde: &[&["1/2", "0"], &["1/2", "0"]],
        b: &["1/2", "1/2"],
    },
    Golden {
        basis: "polynomial(3)",
        nodes: "lobatto(3)",
        c: &["0", "1/2", "1"],
        a: &[
            &["0", "0", "0"],
            &["5/24", "1/3", "-1/24"],
            &["1/6", "2/3", "1/6"],
        ],
        a_tilde: &[
            &["1/6", "-1/6", "0"],
            &["1/6", "1/3", "0"],
            &["1/6", "5/6", "0"],
        ],
        b: &["1/6", "2/3", "1/6"],
    },
    // Hairer & Wanner, Solving Ordinary Differential Equations II, §IV.5: Lobatto IIIA and IIIB of order 6.
    Golden {
        basis: "polynomial(4)",
        nodes: "lobatto(4)",
        c: &["0", "1/2 - sqrt(5)/10", "1/2 + sqrt(5)/10", "1"],
        a: &[
            &["0", "0", "0", "0"],
            &[
                "11/120 + sqrt(5)/120",
                "5/24 - sqrt(5)/120",
                "5/24 - 13*sqrt(5)/120",
                "-1/120 + sqrt(5)/120",
            ],
            &[
                "11/120 - sqrt(5)/120",
                "5/24 + 13*sqrt(5)/120",
                "5/24 + sqrt(5)/120",
                "-1/120 - sqrt(5)/120",
            ],
            &["1/12", "5/12", "5/12", "1/12"],
        ],
        a_tilde: &[
            &["1/12", "-1/24 - sqrt(5)/24", "-1/24 + sqrt(5)/24", "0"],
            &["1/12", "5/24 + sqrt(5)/120", "5/24 - 13*sqrt(5)/120", "0"],
            &["1/12", "5/24 + 13*sqrt(5)/120", "5/24 - sqrt(5)/120", "0"],
            &["1/12", "11/24 - sqrt(5)/24", "11/24 + sqrt(5)/24", "0"],
        ],
        b: &["1/12", "5/12", "5/12", "1/12"],
    },
];

const GAUSS2_C: &[&str] = &["1/2 - sqrt(3)/6", "1/2 + sqrt(3)/6"];
const GAUSS2_A: &[&[&str]] = &[&["1/4", "1/4 - sqrt(3)/6"], &["1/4 + sqrt(3)/6", "1/4"]];
const GAUSS3_C: &[&str] = &["1/2 - sqrt(15)/10", "1/2", "1/2 + sqrt(15)/10"];
const GAUSS3_A: &[&[&str]] = &[
    &["5/36", "2/9 - sqrt(15)/15", "5/36 - sqrt(15)/30"],
    &["5/36 + sqrt(15)/24", "2/9", "5/36 - sqrt(15)/24"],
    &["5/36 + sqrt(15)/30", "2/9 + sqrt(15)/15", "5/36"],
];

fn shown(forms: &[Option<String>]) -> Vec<String> {
    let shown = |form: &Option<String>| form.clone().unwrap_or("none".into());
    forms.iter().map(shown).collect()
}

#[test]
fn the_papers_tableaux_come_out_exactly() {
    for golden in GOLDEN {
        let name = format!("{} at {}", golden.basis, golden.nodes);
        let forms = derive(golden.basis, golden.nodes)
            .expect(&name)
            .exact_forms();
        assert_eq!(shown(&forms.c), golden.c, "{name}");
        assert_eq!(shown(&forms.b), golden.b, "{name}");
        assert_eq!(shown(&forms.b_tilde), golden.b, "{name}");
        for i in 0..golden.c.len() {
            assert_eq!(shown(&forms.a[i]), golden.a[i], "{name}");
            assert_eq!(shown(&forms.a_tilde[i]), golden.a_tilde[i], "{name}");
        }
    }
}

/// LZ Example 3, whose Ã the paper misprints: by its own formula it is that of Störmer–Verlet.
#[test]
fn a_half_wave_gives_stoermer_verlet() {
    let waves = derive("1, cos(pi*t)", "0, 1").expect("derived");
    let forms = waves.exact_forms();
    assert_eq!(shown(&forms.b), ["1/2", "1/2"]);
    assert_eq!(
        forms.a.iter().map(|r| shown(r)).collect::<Vec<_>>(),
        [["0", "0"], ["1/2", "1/2"]]
    );
    assert_eq!(
        forms.a_tilde.iter().map(|r| shown(r)).collect::<Vec<_>>(),
        [["1/2", "0"], ["1/2", "0"]]
    );
    assert!(waves.has_coefficients_of(&derive("polynomial(2)", "0, 1").expect("derived")));
    assert!(!waves.has_coefficients_of(&derive("polynomial(2)", "0, 2/3").expect("derived")));
}

/// LZ Example 4, with c̃, which the paper does not print.
#[test]
fn half_waves_at_three_nodes_come_out_exactly() {
    let forms = derive("1, cos(pi*t), sin(pi*t)", "0, 1/2, 1")
        .expect("derived")
        .exact_forms();
    let end = "(pi - 2)/(2*pi)";
    assert_eq!(shown(&forms.b), [end, "2/pi", end]);
    assert_eq!(shown(&forms.c), ["0", "1/2", "1"]);
    let rows = |matrix: &[Vec<Option<String>>]| matrix.iter().map(|r| shown(r)).collect::<Vec<_>>();
    assert_eq!(
        rows(&forms.a),
        [
            ["0", "0", "0"],
            ["1/4", "1/pi", "(pi - 4)/(4*pi)"],
            [end, "2/pi", end]
        ]
    );
    assert_eq!(
        rows(&forms.a_tilde),
        [
            [end, "(pi - 4)/(pi^2 - 2*pi)", "0"],
            [end, "1/pi", "0"],
            [end, "1/(pi - 2)", "0"]
        ]
    );
    assert_eq!(
        shown(&forms.c_tilde),
        [
            "(pi^2 - 2*pi - 4)/(2*pi^2 - 4*pi)",
            "1/2",
            "(pi^2 - 2*pi + 4)/(2*pi^2 - 4*pi)"
        ]
    );
}

/// `p + q√d`.
#[derive(Debug, Clone, PartialEq)]
struct Surd(BigRational, BigRational);

fn rational(text: &str) -> BigRational {
    text.parse().expect(text)
}

/// Reads `5/24 - 13*sqrt(5)/120`, and which root it has.
fn surd(text: &str) -> (Surd, Option<i64>) {
    let Some((before, after)) = text.split_once("sqrt(") else {
        return (Surd(rational(text), rational("0")), None);
    };
    let (radicand, after) = after.split_once(')').expect(text);
    let denominator = after.strip_prefix('/').unwrap_or("1");
    let (p, factor) = before.rsplit_once(' ').unwrap_or(("0 +", before));
    let (p, sign) = p.rsplit_once(' ').expect(text);
    let factor = factor.strip_suffix('*').unwrap_or("1");
    let q = rational(&format!("{factor}/{denominator}"));
    let q = if sign == "-" { -q } else { q };
    (Surd(rational(p), q), Some(radicand.parse().expect(text)))
}

impl Surd {
    fn times(&self, other: &Surd, d: i64) -> Surd {
        let d = BigRational::from_integer(d.into());
        Surd(
            &self.0 * &other.0 + &self.1 * &other.1 * d,
            &self.0 * &other.1 + &self.1 * &other.0,
        )
    }

    fn plus(&self, other: &Surd) -> Surd {
        Surd(&self.0 + &other.0, &self.1 + &other.1)
    }
}

/// Row sums and `b_i ã_ij + b_j a_ji = b_i b_j`, without the library.
fn is_consistent(golden: &Golden) -> bool {
    let all = golden.a.iter().chain(golden.a_tilde).copied().flatten();
    let root = all.clone().find_map(|text| surd(text).1).unwrap_or(1);
    assert!(all.filter_map(|text| surd(text).1).all(|d| d == root));
    let of = |text: &str| surd(text).0;
    let zero = Surd(rational("0"), rational("0"));
    let stages = 0..golden.c.len();
    let rows = stages.clone().all(|i| {
        golden.a[i]
            .iter()
            .fold(zero.clone(), |sum, entry| sum.plus(&of(entry)))
            == of(golden.c[i])
    });
    let pairs = stages.clone().all(|i| {
        stages.clone().all(|j| {
            let (b_i, b_j) = (of(golden.b[i]), of(golden.b[j]));
            let left = b_i.times(&of(golden.a_tilde[i][j]), root);
            let right = b_j.times(&of(golden.a[j][i]), root);
            left.plus(&right) == b_i.times(&b_j, root)
        })
    });
    rows && pairs
}

#[test]
fn the_expected_entries_satisfy_the_conditions_of_the_paper() {
    for golden in GOLDEN {
        assert!(
            is_consistent(golden),
            "{} at {}",
            golden.basis,
            golden.nodes
        );
    }
    // As the paper prints it, they do not.
    let printed = Golden {
        a: &[
            &["1/6 + sqrt(2)/48", "1/6 - sqrt(2)/6", "1/6 - 5*sqrt(2)/48"],
            &["1/6 + sqrt(2)/8", "1/6", "1/6 - sqrt(2)/8"],
            &[
                "1/6 + 5*sqrt(2)/48",
                "1/6 + sqrt(2)/6",
                "1/6 - 5*sqrt(2)/48",
            ],
        ],
        ..GOLDEN[5]
    };
    assert_eq!(printed.nodes, "chebyshev(3)");
    assert!(!is_consistent(&printed));
}
