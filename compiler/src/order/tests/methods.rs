//! Methods that no derivation yields, for the tests of this folder.

use std::sync::Arc;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero as _};

use crate::algebra::{Dense, Rationals, StageAlgebra};
use crate::arithmetic::rational::parse;
use crate::order::tree::{BicolouredTree, Colour};
use crate::partitioned::Partitioned;

/// A method with rational coefficients.
pub(crate) type RationalPair = Partitioned<Dense<Rationals>>;

/// Reads `-3/4`.
pub(crate) fn rational(text: &str) -> BigRational {
    parse(text).expect(text)
}

/// Reads `-0.75`, exactly.
pub(crate) fn decimal(text: &str) -> BigRational {
    let places = text.split_once('.').map_or(0, |(_, places)| places.len());
    let digits: BigInt = text.replace('.', "").parse().expect(text);
    BigRational::new(digits, BigInt::from(10).pow(places as u32))
}

fn rows(rows: &[&str]) -> Vec<Vec<BigRational>> {
    let row = |row: &&str| row.split_whitespace().map(rational).collect();
    rows.iter().map(row).collect()
}

/// A Runge–Kutta method from the rows of `a` and `b`.
pub(crate) fn runge_kutta(a: &[&str], b: &str) -> RationalPair {
    let (a, b) = (rows(a), rows(&[b]).remove(0));
    Partitioned::equal(Arc::new(Dense::new(Rationals, b.len())), a, b)
}

/// A well-known explicit Runge–Kutta method.
pub(crate) fn explicit_runge_kutta(name: &str) -> RationalPair {
    match name {
        "euler" => runge_kutta(&["0"], "1"),
        "midpoint" => runge_kutta(&["0 0", "1/2 0"], "0 1"),
        "kutta3" => runge_kutta(&["0 0 0", "1/2 0 0", "-1 2 0"], "1/6 2/3 1/6"),
        "rk4" => runge_kutta(
            &["0 0 0 0", "1/2 0 0 0", "0 1/2 0 0", "0 0 1 0"],
            "1/6 1/3 1/3 1/6",
        ),
        _ => unreachable!("{name}"),
    }
}

/// The composition, for `i = 1..n`, of the kick `p −= kick_i h ∂U/∂q` and the drift
/// `q += drift_i h ∂T/∂p` as a partitioned Runge–Kutta method (MW 2.6.4): `Q_i` contains the drifts before
/// the stage, `P_i` the kicks up to it.
pub(crate) fn splitting(drift: &[BigRational], kick: &[BigRational]) -> RationalPair {
    let stages = drift.len();
    let matrix = |entries: &[BigRational], among: fn(usize, usize) -> bool| {
        let entry = |i, j| {
            if among(i, j) {
                entries[j].clone()
            } else {
                BigRational::zero()
            }
        };
        (0..stages)
            .map(|i| (0..stages).map(|j| entry(i, j)).collect())
            .collect()
    };
    Partitioned {
        algebra: Arc::new(Dense::new(Rationals, stages)),
        a: matrix(drift, |i, j| j < i),
        a_tilde: matrix(kick, |i, j| j <= i),
        b: drift.to_vec(),
        b_tilde: kick.to_vec(),
        gradient: None,
    }
}

/// As [`splitting`] for drifts before kicks: `for i = 1..n`, drift, then kick.
pub(crate) fn drift_first(drift: &[BigRational], kick: &[BigRational]) -> RationalPair {
    splitting(kick, drift).exchanged()
}

/// An elementary weight by the recursion over the tree itself, without an enumeration.
pub(crate) fn weight<A: StageAlgebra>(pair: &Partitioned<A>, tree: &BicolouredTree) -> BigRational {
    fn stages<A: StageAlgebra>(pair: &Partitioned<A>, tree: &BicolouredTree) -> A::Vector {
        let one = pair.algebra.constant(&BigRational::one());
        tree.children().iter().fold(one, |product, child| {
            let matrix = match child.colour() {
                Colour::Q => &pair.a,
                Colour::P => &pair.a_tilde,
            };
            let applied = pair.algebra.apply(matrix, &stages(pair, child));
            pair.algebra.multiply(&product, &applied)
        })
    }
    let weights = match tree.colour() {
        Colour::Q => &pair.b,
        Colour::P => &pair.b_tilde,
    };
    let terms = pair.algebra.multiply(weights, &stages(pair, tree));
    let sum = pair.algebra.sum(&terms);
    sum.short_rational().expect("a rational weight")
}
