//! One step for the oscillator `q' = p`, `p' = −ω²q` as a matrix.

use std::ops::Range;

use num_rational::BigRational;
use num_traits::{One, Zero};

use super::cascade;
use super::fraction::Fraction;
use super::polynomial::RealPolynomial;
use super::resolvent::{Resolvent, apply, apply_left, dot};
use crate::algebra::{Field, Number, Scalar, StageAlgebra};
use crate::partitioned::{Flows, Partitioned};

/// The polynomials in `x`, the constant first, that determine the matrix of one step.
///
/// With `ν = hω`, `x = ν²` and `(q, p/ω)` the stages are `(1 + xAÃ) Q = 1 q0 + νA1 p0/ω` and
/// `(1 + xÃA) P = 1 p0/ω − νÃ1 q0`, so that with `D = det(1 + xÃA) = det(1 + xAÃ)` and
/// `⟨u, v⟩ = uᵀ adj(1 + xÃA) v`
///
/// ```text
/// D M = ⎛ D − x⟨b, Ã1⟩                 ν⟨b, 1⟩     ⎞
///       ⎝ −ν(D b̃ᵀ1 − x⟨Aᵀb̃, Ã1⟩)      D − x⟨Aᵀb̃, 1⟩ ⎠
/// ```
///
/// by `(1 + xAÃ)⁻¹A = A(1 + xÃA)⁻¹` and `(1 + xAÃ)⁻¹ = 1 − xA(1 + xÃA)⁻¹Ã`.
pub(super) struct Parts<T> {
    /// `D`
    pub(super) determinant: T,
    /// `⟨b, 1⟩`
    pub(super) b_one: T,
    /// `⟨b, Ã1⟩`
    pub(super) b_c: T,
    /// `⟨Aᵀb̃, 1⟩`
    pub(super) ab_one: T,
    /// `⟨Aᵀb̃, Ã1⟩`
    pub(super) ab_c: T,
    /// `b̃ᵀ1`
    pub(super) b_sum: T,
}

impl<T> Parts<T> {
    pub(super) fn map<U>(&self, mut each: impl FnMut(&T) -> Option<U>) -> Option<Parts<U>> {
        Some(Parts {
            determinant: each(&self.determinant)?,
            b_one: each(&self.b_one)?,
            b_c: each(&self.b_c)?,
            ab_one: each(&self.ab_one)?,
            ab_c: each(&self.ab_c)?,
            b_sum: each(&self.b_sum)?,
        })
    }
}

/// Approximate cost of [`parts`] in products of machine words: `s⁴` products of matrix entries, for a splitting `s²`,
/// each reduced to lowest terms.
pub(super) fn cost<A: StageAlgebra>(pair: &Partitioned<A>) -> u64 {
    let algebra = &*pair.algebra;
    if !algebra.constants().is_costly() {
        return cost_of_length(pair);
    }
    let sum = |m: &A::Matrix| -> u64 {
        let rows = algebra.operator(m);
        let entries = rows.iter().flatten();
        entries.map(|x| algebra.constants().length(x)).sum()
    };
    let stages = algebra.stages().max(1) as u64;
    // The mean length of a product of entries.
    let entry = (sum(&pair.a) + sum(&pair.a_tilde)) / (stages * stages);
    let reduced = entry.saturating_mul(entry).saturating_mul(8);
    let products = stages.pow(if pair.lower_triangular().is_some() {
        2
    } else {
        4
    });
    products.saturating_mul(reduced)
}

/// Approximate cost, in products of machine words, of everything that follows, for fields with cheap products. The coefficients
/// of the matrix are products of one entry from each row, and elimination squares their length.
fn cost_of_length<A: StageAlgebra>(pair: &Partitioned<A>) -> u64 {
    let longest = |row: &Vec<Number<'_>>| row.iter().map(Number::words).max().unwrap_or(0);
    let total = |matrix: &A::Matrix| -> u64 {
        let rows = pair.algebra.entries(matrix);
        rows.iter().map(longest).sum()
    };
    let stages = pair.algebra.stages() as u64;
    let length = stages.saturating_mul(total(&pair.a) + total(&pair.a_tilde));
    (length.saturating_mul(length) / 16).saturating_add(cost_of_denominators(pair))
}

/// Approximate cost of the matrix if its entries have no short common denominator: then its coefficients have the product of all denominators,
/// and each of `s⁴` products is reduced to lowest terms.
fn cost_of_denominators<A: StageAlgebra>(pair: &Partitioned<A>) -> u64 {
    let algebra = &*pair.algebra;
    let field = algebra.constants();
    if pair.lower_triangular().is_some() || cascade::steps(pair).len() > 1 {
        return 0;
    }
    let matrices = [&pair.a, &pair.a_tilde].map(|m| algebra.operator(m));
    let entries = || matrices.iter().flatten().flatten();
    if !field.common_denominator(entries()).is_one() {
        return 0;
    }
    let bits: u64 = entries().map(|x| field.number(x).denominator_bits()).sum();
    let words = bits / 64;
    let products = (algebra.stages() as u64).pow(4);
    products.saturating_mul(words.saturating_mul(words)) / 500
}

/// The parts over the field of constants.
pub(super) fn parts<A: StageAlgebra>(pair: &Partitioned<A>) -> Parts<Vec<Scalar<A>>> {
    if let Some(flows) = pair.flows() {
        return parts_of_splitting(&*pair.algebra, &flows);
    }
    match &*cascade::steps(pair) {
        [] | [_] => parts_of_stages(pair),
        steps => parts_by_steps(pair, steps),
    }
}

/// The parts of a composition, from those of its steps.
pub(super) fn parts_by_steps<A: StageAlgebra>(
    pair: &Partitioned<A>,
    steps: &[Range<usize>],
) -> Parts<Vec<Scalar<A>>> {
    let coefficients = Operators::of(pair);
    let part = |stages: &Range<usize>| coefficients.part(stages);
    let field = pair.algebra.constants();
    let each: Vec<_> = steps.iter().map(|step| part(step).parts(field)).collect();
    cascade::joined(field, &each)
}

/// The parts for any method, from the inverse of `1 + xÃA`.
pub(super) fn parts_of_stages<A: StageAlgebra>(pair: &Partitioned<A>) -> Parts<Vec<Scalar<A>>> {
    Operators::of(pair).parts(pair.algebra.constants())
}

/// The coefficients in a basis over the field.
struct Operators<T> {
    a: Vec<Vec<T>>,
    a_tilde: Vec<Vec<T>>,
    b: Vec<T>,
    b_tilde: Vec<T>,
    one: Vec<T>,
}

impl<T: Clone> Operators<T> {
    fn of<A: StageAlgebra>(pair: &Partitioned<A>) -> Self
    where
        A::Constants: Field<Element = T>,
    {
        let algebra = &*pair.algebra;
        let [a, a_tilde] = [&pair.a, &pair.a_tilde].map(|m| algebra.operator(m));
        let [b, b_tilde] = [&pair.b, &pair.b_tilde].map(|f| algebra.functional(f));
        let one = algebra.coordinates(&algebra.constant(&BigRational::one()));
        Operators {
            a,
            a_tilde,
            b,
            b_tilde,
            one,
        }
    }

    /// The coefficients of these stages only.
    fn part(&self, stages: &Range<usize>) -> Self {
        let vector = |list: &[T]| list[stages.clone()].to_vec();
        Operators {
            a: cascade::block(&self.a, stages),
            a_tilde: cascade::block(&self.a_tilde, stages),
            b: vector(&self.b),
            b_tilde: vector(&self.b_tilde),
            one: vector(&self.one),
        }
    }

    fn parts<F: Field<Element = T>>(&self, field: &F) -> Parts<Vec<T>> {
        let Operators {
            a,
            a_tilde,
            b,
            b_tilde,
            one,
        } = self;
        let c_tilde = apply(field, a_tilde, one);
        let ab = apply_left(field, b_tilde, a);
        let resolvent = Resolvent::of_product(field, a_tilde, a);
        let [b_one, ab_one] = pair_of(resolvent.adjugate(&[b, &ab], one));
        let [b_c, ab_c] = pair_of(resolvent.adjugate(&[b, &ab], &c_tilde));
        Parts {
            determinant: resolvent.determinant(),
            b_one,
            b_c,
            ab_one,
            ab_c,
            b_sum: vec![dot(field, b_tilde, one)],
        }
    }
}

/// The parts for a splitting, with `D = 1`.
fn parts_of_splitting<A: StageAlgebra>(
    algebra: &A,
    flows: &Flows<Scalar<A>>,
) -> Parts<Vec<Scalar<A>>> {
    let field = algebra.constants();
    let [zero, one] = [BigRational::zero(), BigRational::one()].map(|x| field.rational(&x));
    let [mut m11, m12, mut m21, mut m22] = matrix_of_flows(field, flows);
    let negative = |list: Vec<Scalar<A>>| -> Vec<Scalar<A>> {
        list.iter().map(|x| field.subtract(&zero, x)).collect()
    };
    let kicks = flows.iter().filter(|flow| flow.is_kick);
    Parts {
        b_one: m12,
        b_c: negative(m11.split_off(1)),
        ab_one: negative(m22.split_off(1)),
        b_sum: vec![kicks.fold(zero.clone(), |sum, kick| field.add(&sum, &kick.fraction))],
        ab_c: m21.split_off(m21.len().min(1)),
        determinant: vec![one],
    }
}

/// The matrix of a sequence of flows: [`product_of_flows`] as polynomials in `x`.
pub(super) fn matrix_of_flows<F: Field>(
    field: &F,
    flows: &Flows<F::Element>,
) -> [Vec<F::Element>; 4] {
    let [zero, one] = [BigRational::zero(), BigRational::one()].map(|x| field.rational(&x));
    let add = |sum: &mut Vec<F::Element>, factor: &F::Element, list: &Vec<F::Element>, shift| {
        sum.resize(sum.len().max(list.len() + shift), zero.clone());
        for (sum, x) in sum[shift..].iter_mut().zip(list) {
            *sum = field.add(sum, &field.multiply(factor, x));
        }
    };
    let negative = |kick: &F::Element| field.subtract(&zero, kick);
    product_of_flows(flows, [Vec::new(), vec![one]], negative, add)
}

/// The product of the matrices of drifts `d` and kicks `k`, with `k − 2gν²` in place of `k` for gradient kicks,
///
/// ```text
/// ⎛ 1  νd ⎞      ⎛  1   0 ⎞
/// ⎝ 0   1 ⎠      ⎝ −νk  1 ⎠
/// ```
///
/// as `M11`, `M12/ν`, `M21/ν` and `M22`, so that `ν² = x` remains where two off-diagonal entries meet. `add` adds to a sum the
/// product of a factor, another entry and this power of `x`.
pub(super) fn product_of_flows<E: Clone, T: Clone>(
    flows: &Flows<E>,
    [zero, one]: [T; 2],
    negative: impl Fn(&E) -> E,
    add: impl Fn(&mut T, &E, &T, usize),
) -> [T; 4] {
    let [mut m11, mut m12, mut m21, mut m22] = [one.clone(), zero.clone(), zero, one];
    for flow in flows.iter() {
        if flow.is_kick {
            let back = negative(&flow.fraction);
            add(&mut m21, &back, &m11, 0);
            add(&mut m22, &back, &m12, 1);
            for _ in 0..2 {
                if let Some(gradient) = &flow.gradient {
                    add(&mut m21, gradient, &m11, 1);
                    add(&mut m22, gradient, &m12, 2);
                }
            }
        } else {
            add(&mut m11, &flow.fraction, &m21, 1);
            add(&mut m12, &flow.fraction, &m22, 0);
        }
    }
    [m11, m12, m21, m22]
}

/// The two lists for two vectors.
fn pair_of<T>(lists: Vec<Vec<T>>) -> [Vec<T>; 2] {
    let mut lists = lists.into_iter();
    [(); 2].map(|()| lists.next().unwrap_or_default())
}

/// The matrix of one step: `M11`, `M12/ν`, `M21/ν` and `M22` as functions of `x`.
#[derive(Debug)]
pub(super) struct Step<P> {
    /// `det(1 + xÃA)`; where it vanishes the stages have no solution, or infinitely many.
    pub(super) stages: P,
    pub(super) m11: Fraction<P>,
    pub(super) m12: Fraction<P>,
    pub(super) m21: Fraction<P>,
    pub(super) m22: Fraction<P>,
    pub(super) trace: Fraction<P>,
    pub(super) determinant: Fraction<P>,
}

impl<P: RealPolynomial> Step<P> {
    pub(super) fn new(parts: &Parts<P>) -> Self {
        let d = &parts.determinant;
        let m11 = d.subtract(&parts.b_c.shift());
        let m22 = d.subtract(&parts.ab_one.shift());
        let m12 = parts.b_one.clone();
        let m21 = parts.ab_c.shift().subtract(&d.multiply(&parts.b_sum));
        // D² det M is a multiple of D, because D det M is det(1 + xÃ*A*) of the adjoint method.
        let determinant = m11.multiply(&m22).subtract(&m12.multiply(&m21).shift());
        let one = d.constant(&BigRational::one());
        let quotient = determinant.quotient_from_below(d);
        let determinant = if quotient.subtract(d).is_zero() {
            Fraction::new(&one, &one)
        } else if quotient.multiply(d).subtract(&determinant).is_zero() {
            Fraction::new(&quotient, d)
        } else {
            Fraction::new(&determinant, &d.multiply(d))
        };
        Step {
            stages: d.clone(),
            trace: Fraction::new(&m11.add(&m22), d),
            m11: Fraction::new(&m11, d),
            m12: Fraction::new(&m12, d),
            m21: Fraction::new(&m21, d),
            m22: Fraction::new(&m22, d),
            determinant,
        }
    }

    /// A polynomial that vanishes where the matrix is a multiple of the identity, and nowhere else on `x > 0`
    /// except at poles.
    pub(super) fn scalar(&self) -> P {
        let [(n11, d11), (n22, d22)] =
            [&self.m11, &self.m22].map(|f| (&f.numerator, &f.denominator));
        let difference = match d11.subtract(d22).is_zero() {
            true => n11.subtract(n22),
            false => n11.multiply(d22).subtract(&n22.multiply(d11)),
        };
        let off = self.m12.numerator.common_factor(&self.m21.numerator);
        off.common_factor(&difference)
    }

    /// Whether `det M = 1`.
    pub(super) fn preserves_area(&self) -> bool {
        self.determinant.is(&BigRational::one())
    }

    /// `1 − det M`, `1 + det M`, `1 + det M − tr M` and `1 + det M + tr M`.
    ///
    /// Both eigenvalues of a real matrix are in the closed unit disc iff none of these is negative: with
    /// `χ(λ) = λ² − tr λ + det`, the last two are `χ(1)` and `χ(−1)` (Jury; Schur, Cohn). If the eigenvalues are
    /// complex, `|λ|² = det ≤ 1`. If they are real, `χ(±1) ≥ 0` excludes that exactly one eigenvalue is outside
    /// `[−1, 1]` on a side; two outside on one side have a product greater than 1.
    pub(super) fn conditions(&self) -> [Fraction<P>; 4] {
        let (t, d) = (&self.trace, &self.determinant);
        let one = BigRational::one();
        let minus = -&one;
        let zero = BigRational::zero();
        let condition = |determinant: &BigRational, trace: &BigRational| {
            // 1 + a det + b tr
            if d.denominator.subtract(&t.denominator).is_zero() {
                let det = d.numerator.scale(determinant);
                let sum = d.denominator.add(&det).add(&t.numerator.scale(trace));
                return Fraction::new(&sum, &d.denominator);
            }
            let both = d.denominator.multiply(&t.denominator);
            let det = d.numerator.multiply(&t.denominator).scale(determinant);
            let trace = t.numerator.multiply(&d.denominator).scale(trace);
            Fraction::new(&both.add(&det).add(&trace), &both)
        };
        [
            condition(&minus, &zero),
            condition(&one, &zero),
            condition(&one, &minus),
            condition(&one, &one),
        ]
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::algebra::{Dense, Rationals};
    use crate::arithmetic::polynomial::Polynomial;
    use crate::arithmetic::rational::ratio;

    /// Kicks 2/3, −1/5, 3/7 and drifts 1/2, 5, −1/3.
    fn splitting() -> Partitioned<Dense<Rationals>> {
        let b = vec![ratio(1, 2), ratio(5, 1), ratio(-1, 3)];
        let b_tilde = vec![ratio(2, 3), ratio(-1, 5), ratio(3, 7)];
        let rows = |b: &[BigRational], filled: usize| -> Vec<Vec<BigRational>> {
            let entry = |i: usize, j: usize| match j < i + filled {
                true => b[j].clone(),
                false => ratio(0, 1),
            };
            let row = |i| (0..b.len()).map(|j| entry(i, j)).collect();
            (0..b.len()).map(row).collect()
        };
        Partitioned {
            algebra: Arc::new(Dense::new(Rationals, 3)),
            a: rows(&b, 0),
            a_tilde: rows(&b_tilde, 1),
            b,
            b_tilde,
            gradient: None,
        }
    }

    #[test]
    fn the_product_of_flows_agrees_with_the_resolvent() {
        for pair in [splitting(), splitting().exchanged()] {
            let flows = pair.flows().expect("a splitting");
            let polynomial = |list: &Vec<BigRational>| Some(Polynomial::from_rationals(list));
            let of_flows = parts_of_splitting(&*pair.algebra, &flows).map(polynomial);
            let of_flows = of_flows.expect("rational");
            let of_stages = parts_of_stages(&pair).map(polynomial).expect("rational");
            assert_eq!(of_flows.determinant, of_stages.determinant);
            assert_eq!(of_flows.b_one, of_stages.b_one);
            assert_eq!(of_flows.b_c, of_stages.b_c);
            assert_eq!(of_flows.ab_one, of_stages.ab_one);
            assert_eq!(of_flows.ab_c, of_stages.ab_c);
            assert_eq!(of_flows.b_sum, of_stages.b_sum);
        }
        let mut changed = splitting();
        changed.a[2][0] = ratio(1, 3);
        assert!(changed.flows().is_none());
    }
}
