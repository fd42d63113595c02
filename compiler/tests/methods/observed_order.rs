//! The orders that are proved are the orders that are seen, and no higher ones.
//!
//! One step of each method is compared with the exact flow in arithmetic with 211 decimal digits, for a
//! polynomial Hamiltonian of each class: the local error of a method of order `p` is `C h^(p+1)` with
//! `C ≠ 0`. No tree, weight or simplifying assumption of `symplectic_compiler::order` enters, only its verdict.
//! The step sizes are so small (2⁻²¹ at order 20, 2⁻¹⁶⁰ at order 1) that the next order does not show, and
//! that a coefficient with one wrong digit, the 25th, makes another order.

use std::collections::HashMap;

use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};
use symplectic_compiler::order::{HamiltonianClass, OrderOptions};
use symplectic_compiler::{Coefficients, Definition, Limits, Tableau, catalogue};

/// Numbers are integers that stand for multiples of 2⁻⁷⁰⁴: 211 decimal digits after the point.
const BITS: usize = 704;
/// How far a slope may be from `p + 1`.
const TOLERANCE: f64 = 0.05;
/// The terms of the Taylor series of the exact flow: (2⁻²¹)⁴⁸ is far below 2⁻⁷⁰⁴, the unit.
const TERMS: usize = 48;
/// Degrees of the Hamiltonians: high enough for trees whose vertices have up to five neighbours.
const DEGREE: usize = 5;
/// Binary places of the coefficients of the Hamiltonians.
const COEFFICIENT_BITS: usize = 6;

/// Two positions and two momenta.
type Point = [BigInt; 4];

fn fixed(numerator: i64, denominator: i64) -> BigInt {
    (BigInt::from(numerator) << BITS) / denominator
}

/// The logarithm to base 2 of a positive integer.
fn log2(integer: &BigInt) -> f64 {
    let more = integer.bits().saturating_sub(60);
    let leading = (integer >> more).to_f64().expect("60 bits");
    leading.log2() + more as f64
}

/// A polynomial Hamiltonian of a class.
struct Hamiltonian {
    /// Exponents of `q₁ q₂ p₁ p₂` by ascending degree, the constant first.
    monomials: Vec<[usize; 4]>,
    /// For each of them another one and the variable to multiply it by; nothing for the constant.
    factors: Vec<Option<(usize, usize)>>,
    /// The monomials below this one are enough for the vector field.
    enough: usize,
    /// Monomials and their coefficients in units of `2^-COEFFICIENT_BITS`.
    terms: Vec<(usize, i64)>,
    /// `q₁' q₂' p₁' p₂'`, likewise.
    field: [Vec<(usize, i64)>; 4],
}

impl Hamiltonian {
    /// All monomials that the class allows, with coefficients that follow no rule.
    fn of(class: HamiltonianClass) -> Self {
        let separated = |e: &[usize; 4]| e[0] + e[1] == 0 || e[2] + e[3] == 0;
        let mut monomials = Vec::new();
        for degree in 0..=DEGREE {
            let all = (0..(degree + 1).pow(3)).map(|index| {
                let (x, y, z) = (
                    index % (degree + 1),
                    index / (degree + 1) % (degree + 1),
                    index / (degree + 1).pow(2),
                );
                (x + y + z <= degree).then(|| [x, y, z, degree - x - y - z])
            });
            let general = class == HamiltonianClass::General;
            monomials.extend(all.flatten().filter(|e| general || separated(e)));
        }
        let index: HashMap<[usize; 4], usize> =
            (0..).zip(&monomials).map(|(i, e)| (*e, i)).collect();
        let lower = |exponents: &[usize; 4], variable: usize| {
            let mut lower = *exponents;
            lower[variable] = lower[variable].checked_sub(1)?;
            Some(index[&lower])
        };
        let factor = |e| (0..4).find_map(|v| Some((lower(e, v)?, v)));
        let factors = monomials.iter().map(factor).collect();
        let mut random: u64 = 20;
        let mut terms = Vec::new();
        let mut field: [Vec<(usize, i64)>; 4] = Default::default();
        for (i, exponents) in monomials.iter().enumerate().skip(1) {
            // Knuth's multiplier and increment.
            random = random
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let quadratic = exponents[2] + exponents[3] == 2;
            let kinetic = exponents[2] + exponents[3] > 0;
            if class == HamiltonianClass::Nystrom && kinetic && !quadratic {
                continue;
            }
            let size = 5 + i64::try_from(random >> 59).expect("5 bits");
            let coefficient = if random >> 58 & 1 == 0 { size } else { -size };
            terms.push((i, coefficient));
            for (variable, exponent) in exponents.iter().enumerate() {
                let Some(lower) = lower(exponents, variable) else {
                    continue;
                };
                let derivative = coefficient * i64::try_from(*exponent).expect("small");
                let (row, sign) = [(2, -1), (3, -1), (0, 1), (1, 1)][variable];
                field[row].push((lower, sign * derivative));
            }
        }
        let enough = monomials
            .iter()
            .position(|e| e.iter().sum::<usize>() == DEGREE)
            .expect("of the highest degree");
        Hamiltonian {
            monomials,
            factors,
            enough,
            terms,
            field,
        }
    }

    /// The first monomials at a point.
    fn powers(&self, point: &Point, count: usize) -> Vec<BigInt> {
        let mut powers: Vec<BigInt> = Vec::with_capacity(count);
        for factor in &self.factors[..count] {
            powers.push(match factor {
                Some((lower, variable)) => (&powers[*lower] * &point[*variable]) >> BITS,
                None => BigInt::one() << BITS,
            });
        }
        powers
    }

    fn energy(&self, point: &Point) -> BigInt {
        combination(&self.terms, &self.powers(point, self.monomials.len()))
    }

    /// `(∂H/∂p, −∂H/∂q)`
    fn derivative(&self, point: &Point) -> Point {
        let powers = self.powers(point, self.enough);
        self.field.each_ref().map(|row| combination(row, &powers))
    }

    /// The coefficients of the Taylor series of the flow, by comparing those of `y' = f(y)`.
    fn series(&self, start: &Point) -> Vec<Point> {
        let mut series = vec![start.clone()];
        let mut powers: Vec<Vec<BigInt>> = vec![Vec::new(); self.enough];
        for n in 0..TERMS {
            for (i, factor) in self.factors[..self.enough].iter().enumerate() {
                let next = match factor {
                    Some((lower, variable)) => {
                        let products =
                            (0..=n).map(|k| &powers[*lower][k] * &series[n - k][*variable]);
                        products.sum::<BigInt>() >> BITS
                    }
                    None if n == 0 => BigInt::one() << BITS,
                    None => BigInt::zero(),
                };
                powers[i].push(next);
            }
            let last: Vec<BigInt> = powers.iter().map(|series| series[n].clone()).collect();
            let next = |row: &Vec<(usize, i64)>| combination(row, &last) / (n + 1);
            series.push(self.field.each_ref().map(next));
        }
        series
    }
}

fn combination(row: &[(usize, i64)], powers: &[BigInt]) -> BigInt {
    let terms = row.iter().map(|(i, coefficient)| &powers[*i] * coefficient);
    terms.sum::<BigInt>() >> COEFFICIENT_BITS
}

/// The exact flow after the time `2^-halvings`.
fn flow(series: &[Point], halvings: usize) -> Point {
    [0, 1, 2, 3].map(|i| {
        let terms = series.iter().enumerate();
        terms.map(|(n, term)| &term[i] >> (n * halvings)).sum()
    })
}

/// A Hamiltonian of each class with the flow from one point.
struct Reference {
    class: HamiltonianClass,
    hamiltonian: Hamiltonian,
    start: Point,
    series: Vec<Point>,
}

fn references() -> [Reference; 3] {
    HamiltonianClass::ALL.map(|class| {
        let hamiltonian = Hamiltonian::of(class);
        let start = [fixed(5, 13), fixed(-3, 11), fixed(4, 17), fixed(6, 19)];
        let series = hamiltonian.series(&start);
        Reference {
            class,
            hamiltonian,
            start,
            series,
        }
    })
}

/// The coefficients of a tableau in fixed point.
fn coefficients(tableau: &Tableau) -> Coefficients<BigInt> {
    let bits = u32::try_from(BITS + 64).expect("small");
    tableau.numbers().map(|number| {
        let low = number.enclose(bits).low();
        (low.numer() << BITS) / low.denom()
    })
}

/// One step of the method of size `2^-halvings`.
fn step(method: &Coefficients<BigInt>, reference: &Reference, halvings: usize) -> Point {
    let derivatives = |stages: &[Point]| -> Vec<Point> {
        let derivative = |stage| reference.hamiltonian.derivative(stage);
        stages.iter().map(derivative).collect()
    };
    let advanced = |position: &[BigInt], momentum: &[BigInt], slopes: &[Point]| -> Point {
        [0, 1, 2, 3].map(|i| {
            let row = if i < 2 { position } else { momentum };
            let products = row.iter().zip(slopes).filter(|(a, _)| !a.is_zero());
            let sum: BigInt = products.map(|(a, slope)| a * &slope[i]).sum();
            &reference.start[i] + (sum >> (BITS + halvings))
        })
    };
    let mut stages = vec![reference.start.clone(); method.b.len()];
    // Each sweep makes the error smaller by a multiple of h, which is taken to be at most 2⁴.
    for _ in 0..BITS / (halvings - 4) + 4 {
        let slopes = derivatives(&stages);
        let rows = method.a.iter().zip(&method.a_tilde);
        let next: Vec<Point> = rows
            .map(|(a, a_tilde)| advanced(a, a_tilde, &slopes))
            .collect();
        let moved = next.iter().flatten().zip(stages.iter().flatten());
        let stationary = moved.map(|(new, old)| (new - old).abs().bits()).max() <= Some(4);
        stages = next;
        if stationary {
            return advanced(&method.b, &method.b_tilde, &derivatives(&stages));
        }
    }
    panic!("the stages do not converge");
}

/// The slope of the local error between the steps `2^-halvings` and half of it.
fn slope(method: &Coefficients<BigInt>, reference: &Reference, halvings: usize) -> f64 {
    let logarithm = |halvings: usize| {
        let numeric = step(method, reference, halvings);
        let exact = flow(&reference.series, halvings);
        let square = |(x, y): (&BigInt, &BigInt)| (x - y).pow(2);
        let squares: BigInt = numeric.iter().zip(&exact).map(square).sum();
        // Rounding errors are some hundred units. An order far above the proved one ends here, too.
        assert!(squares.bits() > 2 * 40, "the error is lost in rounding");
        log2(&squares) / 2.0
    };
    logarithm(halvings) - logarithm(halvings + 1)
}

/// Steps for which the error of a method of this order has about 480 binary places.
fn halvings(order: usize) -> usize {
    480 / (order + 2)
}

fn agrees(slope: f64, order: usize) -> bool {
    (slope - (order + 1) as f64).abs() <= TOLERANCE
}

fn define(text: &str) -> Tableau {
    let definition = Definition::parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    definition
        .derive(&Limits::default())
        .unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// The explicit method that moves alternately, as a definition: first positions by `drift[0]`, or first
/// momenta by `kick[0]`.
fn splitting(drift: &[&str], kick: &[&str], drift_first: bool) -> String {
    let matrix = |weights: &[&str], with_own: bool| {
        let entry = |i: usize, j: usize| {
            let used = j < i || j == i && with_own;
            if used { weights[j] } else { "0" }
        };
        let row = |i| {
            (0..weights.len())
                .map(|j| entry(i, j))
                .collect::<Vec<_>>()
                .join(", ")
        };
        let rows: Vec<String> = (0..weights.len())
            .map(|i| format!("[{}]", row(i)))
            .collect();
        rows.join(", ")
    };
    format!(
        "a: [{}], b: [{}], a_tilde: [{}], b_tilde: [{}]",
        matrix(drift, drift_first),
        drift.join(", "),
        matrix(kick, !drift_first),
        kick.join(", ")
    )
}

/// The orders proved for the classes, which must be sharp, and the slopes seen at step sizes for them.
fn proved_and_seen(tableau: &Tableau, references: &[Reference]) -> [(usize, f64); 3] {
    let report = tableau.order(&OrderOptions::default());
    let method = coefficients(tableau);
    [0, 1, 2].map(|i| {
        let proved = report.class(references[i].class);
        assert!(proved.refuted_by.is_some(), "{tableau:?}: {proved}");
        let halvings = halvings(proved.order);
        (proved.order, slope(&method, &references[i], halvings))
    })
}

/// The reference is the flow of a Hamiltonian system: it conserves the energy to all digits but the last few.
#[test]
fn the_exact_flow_conserves_energy() {
    for reference in references() {
        let Reference {
            class,
            hamiltonian,
            start,
            series,
        } = &reference;
        let change = |point: &Point| hamiltonian.energy(point) - hamiltonian.energy(start);
        assert!(change(&flow(series, 21)).bits() < 12, "{class}");
        let kinetic = |e: &[usize; 4]| e[2] + e[3];
        let exponents = || {
            hamiltonian
                .terms
                .iter()
                .map(|(i, _)| &hamiltonian.monomials[*i])
        };
        let mixed = exponents().any(|e| kinetic(e) > 0 && e[0] + e[1] > 0);
        let highest = exponents().map(kinetic).max();
        let expected = match class {
            HamiltonianClass::General => (true, Some(DEGREE)),
            HamiltonianClass::Separable => (false, Some(DEGREE)),
            HamiltonianClass::Nystrom => (false, Some(2)),
        };
        assert_eq!((mixed, highest), expected, "{class}");
    }
}

/// The methods but the longest, steps of which take s² products of 200 digits here, and those with gradient kicks, which
/// [`gradient_kicks`](super::gradient_kicks) tests.
fn entries() -> impl Iterator<Item = catalogue::Entry> {
    let usual = catalogue::entries().filter(|entry| entry.stages <= Limits::default().stages);
    usual.filter(|entry| !entry.definition.contains("gradient: "))
}

#[test]
#[ignore = "thorough"]
fn orders_of_the_catalogue_are_seen() {
    let references = references();
    let (mut pairs, mut disagreements) = (0, Vec::new());
    for entry in entries() {
        let tableau = entry.derive().expect("derived");
        let seen = proved_and_seen(&tableau, &references);
        for (class, (order, slope)) in HamiltonianClass::ALL.into_iter().zip(seen) {
            pairs += 1;
            let name = &entry.name;
            if !agrees(slope, order) {
                disagreements.push(format!("{name}, {class}: {order}, {slope}"));
            }
            // The same test refuses the claims next to it.
            let refused = !agrees(slope, order - 1) && !agrees(slope, order + 1);
            assert!(refused, "{name}, {class}: {slope}");
        }
    }
    assert!(disagreements.is_empty(), "{disagreements:#?}");
    assert_eq!(pairs, 3 * entries().count());
}

/// 10⁻²⁵ more in one weight is order 0, in one entry of a matrix it is order 1.
#[test]
#[ignore = "thorough"]
fn a_wrong_digit_in_the_catalogue_is_seen() {
    let [general, ..] = references();
    let digit = fixed(1, 1) / BigInt::from(10).pow(25);
    for entry in entries() {
        let name = &entry.name;
        let tableau = entry.derive().expect("derived");
        let order = tableau.order(&OrderOptions::default()).general.order;
        let halvings = halvings(order);
        let slope = |change: &dyn Fn(&mut Coefficients<BigInt>)| {
            let mut method = coefficients(&tableau);
            change(&mut method);
            slope(&method, &general, halvings)
        };
        let weight = slope(&|method| method.b[0] += &digit);
        assert!(
            agrees(weight, 0) && !agrees(weight, order),
            "{name}: {weight}"
        );
        for momentum in [false, true] {
            let entry = slope(&|method| {
                let matrix = if momentum {
                    &mut method.a_tilde
                } else {
                    &mut method.a
                };
                matrix[0][0] += &digit;
            });
            assert!(agrees(entry, 1), "{name}: {entry}");
            assert_eq!(agrees(entry, order), order == 1, "{name}: {entry}");
        }
    }
}

/// Methods whose orders are in the literature, some of them different for each class, and the same with
/// the mistakes that are made with them.
#[test]
fn orders_of_given_methods_are_seen() {
    let ruth = (["2/3", "-2/3", "1"], ["7/24", "3/4", "-1/24"]);
    let c = ["0", "1/3", "-1/3", "1", "-1/3", "1/3"];
    let d = ["7/48", "3/8", "-1/48", "-1/48", "3/8", "7/48"];
    let outer = "1/(2 - cbrt(2))";
    let inner = "1 - 2/(2 - cbrt(2))";
    let (half, middle) = (format!("({outer})/2"), format!("(1 - {outer})/2"));
    let yoshida = (
        [outer, inner, outer, "0"],
        [&*half, &*middle, &*middle, &*half],
    );
    let gauss = |root: &str| {
        format!(
            "a: [[1/4, 1/4 - {root}/6], [1/4 + {root}/6, 1/4]], b: [1/2, 1/2], a_tilde: symplectic_partner"
        )
    };
    let rk4 = |last: &str| {
        format!(
            "a: [[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 1/2, 0, 0], [0, 0, {last}, 0]], b: [1/6, 1/3, 1/3, 1/6]"
        )
    };
    let lobatto = |column: [&str; 3]| {
        let [x, y, z] = column;
        format!(
            "a: [[0, 0, 0], [5/24, 1/3, -1/24], [1/6, 2/3, 1/6]], b: [1/6, 2/3, 1/6], \
             a_tilde: [[{x}, -1/6, 0], [{y}, 1/3, 0], [{z}, 5/6, 0]], b_tilde: [1/6, 2/3, 1/6]"
        )
    };
    let methods = [
        ("Ruth", splitting(&ruth.0, &ruth.1, false), [1, 3, 3]),
        (
            "Ruth, exchanged",
            splitting(&ruth.1, &ruth.0, false),
            [1, 1, 1],
        ),
        ("rational", splitting(&c, &d, true), [1, 4, 4]),
        ("rational, exchanged", splitting(&d, &c, true), [1, 1, 1]),
        (
            "Yoshida",
            splitting(&yoshida.0, &yoshida.1, false),
            [1, 4, 4],
        ),
        ("Gauss", gauss("sqrt(3)"), [4, 4, 4]),
        ("Gauss, rounded", gauss("1.732050808"), [2, 2, 2]),
        ("RK4", rk4("1"), [4, 4, 4]),
        ("RK4, mistyped", rk4("1/2"), [1, 1, 1]),
        (
            "Kutta",
            "a: [[0, 0, 0], [1/2, 0, 0], [-1, 2, 0]], b: [1/6, 2/3, 1/6]".to_owned(),
            [3, 3, 3],
        ),
        ("Lobatto", lobatto(["1/6", "1/6", "1/6"]), [4, 4, 4]),
        // The change (2, −1, 2)/12 is made to vanish by a and b: it shows where ∂H/∂p is not linear.
        (
            "Lobatto, changed",
            lobatto(["1/3", "1/12", "1/3"]),
            [2, 2, 4],
        ),
    ];
    let references = references();
    for (name, definition, orders) in methods {
        let seen = proved_and_seen(&define(&definition), &references);
        assert_eq!(seen.map(|(order, _)| order), orders, "{name}");
        for (order, slope) in seen {
            assert!(agrees(slope, order), "{name}: {order}, {slope}");
        }
    }
}

/// McLachlan–Atela 4 and 5 are that for quadratic kinetic energy only. Their coefficients are known as
/// decimals, so the steps are coarse enough that what the decimals leave out does not show.
#[test]
fn mclachlan_atela_are_of_order_3_for_separable_hamiltonians() {
    let fourth = splitting(
        &[
            "0.5153528374311229364",
            "-0.085782019412973646",
            "0.4415830236164665242",
            "0.1288461583653841854",
        ],
        &[
            "0.1344961992774310892",
            "-0.2248198030794208058",
            "0.7563200005156682911",
            "0.3340036032863214255",
        ],
        false,
    );
    let fifth = splitting(
        &[
            "0.339839625839110000",
            "-0.088601336903027329",
            "0.5858564768259621188",
            "-0.603039356536491888",
            "0.3235807965546976394",
            "0.4423637942197494587",
        ],
        &[
            "0.1193900292875672758",
            "0.6989273703824752308",
            "-0.1713123582716007754",
            "0.4012695022513534480",
            "0.0107050818482359840",
            "-0.0589796254980311632",
        ],
        false,
    );
    let [_, separable, nystrom] = references();
    for (definition, order) in [(fourth, 4), (fifth, 5)] {
        let method = coefficients(&define(&definition));
        let slopes = [&separable, &nystrom].map(|reference| slope(&method, reference, 7));
        assert!(
            agrees(slopes[0], 3) && !agrees(slopes[0], order),
            "{slopes:?}"
        );
        assert!(agrees(slopes[1], order), "{slopes:?}");
    }
}
