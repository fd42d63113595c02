//! Linear stability of a Runge–Kutta method: the stability function.

use std::cmp::Ordering;
use std::ops::Range;

use num_rational::BigRational;
use num_traits::One;

use super::cascade;
use super::cells::Cells;
use super::end_point::EndPoint;
use super::fraction::{Coefficient, Fraction, RationalFunction, Variable};
use super::polynomial::RealPolynomial;
use super::resolvent::Resolvent;
use crate::algebra::{Field, Scalar, StageAlgebra};
use crate::arithmetic::rational::ratio;
use crate::partitioned::Partitioned;

/// Linear stability of a method with `ã = a` and `b̃ = b` on `y' = λy`, where one step is `y1 = R(hλ) y0`.
#[derive(Debug, Clone)]
pub struct RungeKuttaStability {
    /// The stability function `R(z) = 1 + z bᵀ(1 − zA)⁻¹1 = det(1 − zA + z1bᵀ)/det(1 − zA)`.
    pub function: RationalFunction,
    /// `R(∞)`; `None` if infinite.
    pub at_infinity: Option<Coefficient>,
    /// Whether `|R(z)| ≤ 1` for `Re z ≤ 0`.
    pub a_stable: bool,
    /// Whether the method is A-stable and `R(∞) = 0`.
    pub l_stable: bool,
    /// The largest `y` with `|R(iη)| ≤ 1` for `0 ≤ η ≤ y`; the interval is closed at `y` unless infinite.
    pub imaginary: EndPoint,
}

/// The coefficients of `det(1 − zA)` and of `bᵀ adj(1 − zA) 1`.
pub(super) fn parts<A: StageAlgebra>(pair: &Partitioned<A>) -> [Vec<Scalar<A>>; 2] {
    let algebra = &*pair.algebra;
    let field = algebra.constants();
    let (a, b) = (algebra.operator(&pair.a), algebra.functional(&pair.b));
    let one = algebra.coordinates(&algebra.constant(&BigRational::one()));
    let steps = cascade::steps(pair);
    if steps.len() < 2 {
        return parts_of_stages(field, &a, &b, &one);
    }
    let part = |stages: &Range<usize>| {
        let vector = |list: &[Scalar<A>]| list[stages.clone()].to_vec();
        parts_of_stages(
            field,
            &cascade::block(&a, stages),
            &vector(&b),
            &vector(&one),
        )
    };
    cascade::joined_functions(field, &steps.iter().map(part).collect::<Vec<_>>())
}

/// [`parts`] from the matrix of all stages.
pub(super) fn parts_of_stages<F: Field>(
    field: &F,
    a: &[Vec<F::Element>],
    b: &[F::Element],
    one: &[F::Element],
) -> [Vec<F::Element>; 2] {
    let resolvent = Resolvent::new(field, a);
    let numerator = resolvent.adjugate(&[b], one).pop();
    // The resolvent has x = −z.
    let minus = field.rational(&ratio(-1, 1));
    [resolvent.determinant(), numerator.unwrap_or_default()].map(|mut list| {
        for x in list.iter_mut().skip(1).step_by(2) {
            *x = field.multiply(x, &minus);
        }
        list
    })
}

/// Decides everything from the polynomials of [`parts`]; `None` if roots cannot be separated.
pub(super) fn decide<P: RealPolynomial>(
    denominator: &P,
    numerator: &P,
) -> Option<RungeKuttaStability> {
    let function = Fraction::new(&denominator.add(&numerator.shift()), denominator);
    let (p, q) = (&function.numerator, &function.denominator);
    // |Q(iy)|² − |P(iy)|² as a polynomial in y²: not negative where |R(iy)| ≤ 1. A pole on the axis makes
    // it negative, because P does not vanish there.
    let size = |p: &P| {
        let (real, imaginary) = p.on_imaginary_axis();
        real.multiply(&real)
            .add(&imaginary.multiply(&imaginary).shift())
    };
    let excess = size(q).subtract(&size(p));
    let cells = Cells::new(std::slice::from_ref(&excess))?;
    let first = cells.samples.iter().position(|x| excess.sign_at(x).is_lt());
    let imaginary = match first {
        None => EndPoint::INFINITY,
        Some(0) => EndPoint::ZERO,
        Some(index) => EndPoint::square_root_of(&cells.roots[index - 1]),
    };
    let at_infinity = match p.degree().cmp(&q.degree()) {
        Ordering::Less => Some(Coefficient::rational(BigRational::default())),
        Ordering::Equal => Some(p.leading_ratio(q)),
        Ordering::Greater => None,
    };
    // The maximum principle on the left half-plane: R is bounded by 1 there iff it is bounded by 1 on the boundary and
    // has no pole inside (Hairer & Wanner, Solving ODEs II, IV.3).
    let a_stable = first.is_none() && at_infinity.is_some() && roots_on_the_right(q);
    Some(RungeKuttaStability {
        function: function.exported(Variable::Z),
        l_stable: a_stable && p.degree() < q.degree(),
        at_infinity,
        a_stable,
        imaginary,
    })
}

/// Whether all roots have positive real parts (Routh, for the polynomial in `−z`).
///
/// The even and the odd part of `f(−z)`, the longer one first, are divided as in Euclid's algorithm. The
/// roots are in the open left half-plane iff every remainder has one degree less than its divisor, down to a
/// constant, and all leading coefficients have the same sign.
fn roots_on_the_right<P: RealPolynomial>(polynomial: &P) -> bool {
    let Some(degree) = polynomial.degree() else {
        return false;
    };
    let even = polynomial.even_part();
    let odd = even.subtract(polynomial);
    let (mut a, mut b) = if degree % 2 == 0 {
        (even, odd)
    } else {
        (odd, even)
    };
    let sign = a.leading_sign();
    for expected in (0..degree).rev() {
        if b.degree() != Some(expected) || b.leading_sign() != sign {
            return false;
        }
        (a, b) = (b.clone(), a.remainder(&b));
    }
    true
}
