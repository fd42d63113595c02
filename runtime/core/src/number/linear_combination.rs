//! The linear combinations in generated code.
//!
//! Nothing is allocated. Vectors of different dimension are combined up to the length of the shortest one. Such vectors occur only if a
//! system resizes a result; the integrator then returns [`Error::EvaluationDimension`](crate::Error::EvaluationDimension).

use core::marker::PhantomData;

use num_traits::Zero;

use crate::number::array::array;
use crate::number::registers::{self, Work};
use crate::number::summation::{Terms, add, add_sum};
use crate::number::{Coefficient, Scalar, Summation, Vector};

/// Coefficients times the step size: the factors of evaluations.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn weights<T: Scalar, const N: usize>(h: f64, coefficients: [Coefficient; N]) -> [T; N] {
    array(T::zero(), |j| T::weight(h, coefficients[j]))
}

/// The coefficients themselves: the factors of increments.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn factors<T: Scalar, const N: usize>(coefficients: [Coefficient; N]) -> [T; N] {
    array(T::zero(), |j| T::from_coefficient(coefficients[j]))
}

/// `out = base + low + Σ_j factors_j terms_j`; `low` is ignored with plain sums.
///
/// The terms are summed before the base is added, because the base is usually larger.
///
/// ```
/// use symplectic::nalgebra::Vector2;
/// use symplectic::Plain;
/// use symplectic::emitted::{combine, weights};
/// use symplectic::solver::Coefficient;
///
/// let (q, force) = (Vector2::new(1.0, 2.0), Vector2::new(4.0, 8.0));
/// let (low, mut out) = (Vector2::zeros(), Vector2::zeros());
/// let factors = weights(0.5, [1.0, -0.5].map(Coefficient::exact));
/// combine::<Plain, _, 2>(&mut out, &q, &low, factors, [&force, &q]);
/// assert_eq!(out, Vector2::new(2.75, 5.5));
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn combine<R: Summation, V: Vector, const N: usize>(
    out: &mut V,
    base: &V,
    low: &V,
    factors: [V::Scalar; N],
    terms: [&V; N],
) {
    let n = shortest([&*out, base, low]).min(shortest(terms));
    let (out, base) = (&mut out.as_mut_slice()[..n], &base.as_slice()[..n]);
    let (low, terms) = (&low.as_slice()[..n], starts(terms, n));
    for i in 0..n {
        out[i] = value::<R, _, N>(base[i], low[i], &factors, |j| terms[j][i]);
    }
}

/// `vector = (h coefficient) vector`: turns an evaluation into an increment.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn scale<V: Vector>(vector: &mut V, h: f64, coefficient: Coefficient) {
    let factor = V::Scalar::weight(h, coefficient);
    for component in vector.as_mut_slice() {
        *component *= factor;
    }
}

/// [`scale`] of these entries of an array, each with its own coefficient.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn scale_all<V: Vector, const N: usize>(
    vectors: &mut [V],
    indices: [usize; N],
    h: f64,
    coefficients: [Coefficient; N],
) {
    for (index, coefficient) in indices.into_iter().zip(coefficients) {
        scale(&mut vectors[index], h, coefficient);
    }
}

/// [`scale`] of an evaluation in a sweep with [compensated](Summation::COMPENSATED) sums, where evaluations become increments. With plain
/// sums the factors of the sums have the weights: see [`StageSums`](crate::emitted::StageSums).
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn increment<R: Summation, V: Vector>(vector: &mut V, h: f64, coefficient: Coefficient) {
    if R::COMPENSATED {
        scale(vector, h, coefficient);
    }
}

/// The result of a step from its increments: `base + low + Σ_j increments_j`, rounded to `out`, with the round-off in `out_low`.
///
/// ```
/// use symplectic::nalgebra::Vector1;
/// use symplectic::Compensated;
/// use symplectic::emitted::total;
///
/// let (one, tiny, zero) = (Vector1::new(1.0), Vector1::new(f64::EPSILON / 8.0), Vector1::new(0.0));
/// let (mut out, mut low) = (zero, zero);
/// total::<Compensated, _, 2>(&mut out, &mut low, &one, &tiny, [&tiny, &tiny]);
/// assert_eq!((out[0], low[0]), (1.0, 3.0 * tiny[0]));
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn total<R: Summation, V: Vector, const N: usize>(
    out: &mut V,
    out_low: &mut V,
    base: &V,
    low: &V,
    increments: [&V; N],
) {
    let n = shortest([&*out, &*out_low, base, low]).min(shortest(increments));
    let terms = starts(increments, n);
    totals_by::<R, V>((out, out_low), (base, low), (n, N), |i: usize, j: usize| {
        terms[j][i]
    });
}

/// [`total`] of evaluations instead of increments: `base + low + Σ_j factors_j terms_j`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn weighted_total<R: Summation, V: Vector, const N: usize>(
    out: &mut V,
    out_low: &mut V,
    base: &V,
    low: &V,
    factors: [V::Scalar; N],
    terms: [&V; N],
) {
    let n = shortest([&*out, &*out_low, base, low]).min(shortest(terms));
    let terms = starts(terms, n);
    totals_by::<R, V>((out, out_low), (base, low), (n, N), |i: usize, j: usize| {
        factors[j] * terms[j][i]
    });
}

/// A drift or a kick, in place: `out + low + (h coefficient) evaluation`, rounded to `out`, with the round-off in `out_low`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn advance<R: Summation, V: Vector>(
    out: &mut V,
    out_low: &mut V,
    h: f64,
    coefficient: Coefficient,
    evaluation: &V,
) {
    let factor = V::Scalar::weight(h, coefficient);
    add_products::<R, V>(
        out.as_mut_slice(),
        out_low.as_mut_slice(),
        factor,
        evaluation.as_slice(),
    );
}

/// `out + low + factor terms`, component by component.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn add_products<R: Summation, V: Vector>(
    out: &mut [V::Scalar],
    low: &mut [V::Scalar],
    factor: V::Scalar,
    terms: &[V::Scalar],
) {
    let work = AddProducts::<R, _> {
        out,
        low,
        factor,
        terms,
        sums: PhantomData,
    };
    registers::in_widest::<V::Scalar, _>(work.out.len(), work);
}

/// The work of [`add_products`].
struct AddProducts<'a, R, T> {
    out: &'a mut [T],
    low: &'a mut [T],
    factor: T,
    terms: &'a [T],
    sums: PhantomData<R>,
}

impl<R: Summation, T: Scalar> Work for AddProducts<'_, R, T> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) {
        add_products_here::<R, T>(self.out, self.low, self.factor, self.terms);
    }
}

/// [`add_products`] in the registers of the caller.
// The compiler knows that slices passed as arguments do not overlap. For memory to which vectors point it has to check this before every
// loop.
#[cfg_attr(not(debug_assertions), inline(always))]
fn add_products_here<R: Summation, T: Scalar>(
    out: &mut [T],
    low: &mut [T],
    factor: T,
    terms: &[T],
) {
    let n = out.len().min(low.len()).min(terms.len());
    let (out, low, terms) = (&mut out[..n], &mut low[..n], &terms[..n]);
    if !R::COMPENSATED {
        for i in 0..n {
            out[i] = factor.fused(terms[i], out[i]);
        }
    } else {
        for i in 0..n {
            (out[i], low[i]) = add_sum(out[i], low[i], (factor * terms[i], None));
        }
    }
}

/// `vectors_i = Σ_j matrix_ij vectors_j` for the vectors with these `indices`: starting values from the previous step. The matrix is given
/// by its columns.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn transform<V: Vector, const N: usize>(
    vectors: &mut [V],
    indices: [usize; N],
    columns: &[&[f64]],
) {
    let matrix: [[f64; N]; N] = array([0.0; N], |i| array(0.0, |j| columns[j][i]));
    let Ok(vectors) = vectors.get_disjoint_mut(indices) else {
        return;
    };
    let mut slices = vectors.map(V::as_mut_slice);
    // If a node of this step coincides with a node of the previous step, all entries of the row except one are zero.
    let sparse = matrix.map(|row| row.contains(&0.0));
    let n = slices.iter().map(|slice| slice.len()).min().unwrap_or(0);
    for i in 0..n {
        let old: [V::Scalar; N] = array(V::Scalar::zero(), |j| slices[j][i]);
        for ((row, sparse), slice) in matrix.iter().zip(sparse).zip(&mut slices) {
            let factor = |j: usize| V::Scalar::from_f64(row[j]);
            slice[i] = if sparse {
                let mut terms = (0..N).filter(|&j| row[j] != 0.0);
                let first = terms.next().map(|j| factor(j) * old[j]);
                terms.fold(first.unwrap_or_else(V::Scalar::zero), |sum, j| {
                    factor(j).fused(old[j], sum)
                })
            } else {
                sum_of_products(None, N, |j| (factor(j), old[j]))
            };
        }
    }
}

/// Copies one vector to another, component by component, because `clone_from` of a dynamic vector may allocate.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn copy<V: Vector>(out: &mut V, from: &V) {
    let (out, from) = (out.as_mut_slice(), from.as_slice());
    let n = out.len().min(from.len());
    out[..n].copy_from_slice(&from[..n]);
}

/// Copies a vector to these entries of an array.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn reset<V: Vector, const N: usize>(vectors: &mut [V], indices: [usize; N], from: &V) {
    for index in indices {
        copy(&mut vectors[index], from);
    }
}

/// Copies one vector of an array to others.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn copy_to<V: Vector, const N: usize>(vectors: &mut [V], from: usize, to: [usize; N]) {
    for index in to {
        if let Ok([source, target]) = vectors.get_disjoint_mut([from, index]) {
            copy(target, source);
        }
    }
}

/// The shortest length, so that one comparison bounds every index of a loop.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn shortest<'a, V: Vector>(vectors: impl IntoIterator<Item = &'a V>) -> usize {
    let mut shortest = usize::MAX;
    for vector in vectors {
        shortest = shortest.min(vector.as_slice().len());
    }
    shortest
}

/// The first `n` components of each vector.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn starts<V: Vector, const N: usize>(vectors: [&V; N], n: usize) -> [&[V::Scalar]; N] {
    array(&[][..], |j| &vectors[j].as_slice()[..n])
}

/// One component of a stage.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn value<R: Summation, T: Scalar, const N: usize>(
    base: T,
    low: T,
    factors: &[T; N],
    term: impl Fn(usize) -> T,
) -> T {
    if N == 0 {
        return base;
    }
    base + sum_of_products(R::COMPENSATED.then_some(low), N, |j| (factors[j], term(j)))
}

/// The products of a sum, by their numbers from 0. A closure is enough, except for lanes: a closure with operations of lanes may not be
/// inlined.
pub(crate) trait Products<T> {
    fn product(&self, number: usize) -> (T, T);
}

impl<T, F: Fn(usize) -> (T, T)> Products<T> for F {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn product(&self, number: usize) -> (T, T) {
        self(number)
    }
}

/// The sum of `count` products, at least one, and of an optional start. Products with even and with odd indices are summed separately, so
/// that additions need not wait for one another.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn sum_of_products<T: Scalar>(
    start: Option<T>,
    count: usize,
    product: impl Fn(usize) -> (T, T),
) -> T {
    sum_of(start, count, product)
}

/// [`sum_of_products`] of any kind.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sum_of<T: Scalar>(start: Option<T>, count: usize, products: impl Products<T>) -> T {
    let mut even = plus_product(start, products.product(0));
    if count == 1 {
        return even;
    }
    let mut odd = plus_product(None, products.product(1));
    for j in 2..count {
        let sum = if j % 2 == 0 { &mut even } else { &mut odd };
        *sum = plus_product(Some(*sum), products.product(j));
    }
    even + odd
}

/// `sum + x y`
#[cfg_attr(not(debug_assertions), inline(always))]
fn plus_product<T: Scalar>(sum: Option<T>, (x, y): (T, T)) -> T {
    match sum {
        Some(sum) => x.fused(y, sum),
        // Does not start from zero: the compiler has to keep the addition 0 + x.
        None => x * y,
    }
}

/// The terms of the sums of a vector, by the numbers of the component and of the term. A closure is enough, except for lanes: one with
/// operations of lanes may not be inlined.
pub trait TermsOfComponents<T> {
    /// The term of a component.
    fn term(&self, component: usize, number: usize) -> T;
}

impl<T, F: Fn(usize, usize) -> T> TermsOfComponents<T> for F {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn term(&self, component: usize, number: usize) -> T {
        self(component, number)
    }
}

/// The terms of one component.
struct OfComponent<'a, X>(usize, &'a X);

impl<T, X: TermsOfComponents<T>> Terms<T> for OfComponent<'_, X> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn term(&self, number: usize) -> T {
        self.1.term(self.0, number)
    }
}

/// The first `n` components of a result: `base + low + Σ_j term_ij` over `count` terms, rounded to `out`, with the round-off in `out_low`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub fn totals_by<R: Summation, V: Vector>(
    (out, out_low): (&mut V, &mut V),
    (base, low): (&V, &V),
    (n, count): (usize, usize),
    terms: impl TermsOfComponents<V::Scalar>,
) {
    let (out, out_low) = (
        &mut out.as_mut_slice()[..n],
        &mut out_low.as_mut_slice()[..n],
    );
    let (base, low) = (&base.as_slice()[..n], &low.as_slice()[..n]);
    for i in 0..n {
        let (high, rest) = add::<R, _>(base[i], low[i], count, OfComponent(i, &terms));
        out[i] = high;
        if R::COMPENSATED {
            out_low[i] = rest;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::registers::{Avx2, Avx512};
    use crate::number::{Compensated, Plain};

    /// Numbers of many sizes; a few are not finite.
    fn numbers(seed: u64, count: usize) -> [f64; MAX_COUNT] {
        let mut state = seed;
        array(0.0, |index| {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            let size = [1e-300, 1e-16, 1.0, 3e5, 1e300][(state >> 40) as usize % 5];
            match (index + 1 == count, seed % 5) {
                (true, 0) => f64::NAN,
                (true, 1) => f64::INFINITY,
                _ => size * ((state >> 11) as f64 / 2_f64.powi(53) - 0.5),
            }
        })
    }

    /// More numbers than a row of the widest registers has, several times.
    const MAX_COUNT: usize = 75;

    fn compare<R: Summation>(count: usize, run: impl Fn(AddProducts<'_, R, f64>)) {
        for seed in 0..10 {
            let [out, low, terms] = [seed, seed + 7, seed + 14].map(|seed| numbers(seed, count));
            let with = |run: &dyn Fn(AddProducts<'_, R, f64>)| {
                let (mut out, mut low) = (out, low);
                run(AddProducts {
                    out: &mut out[..count],
                    low: &mut low[..count],
                    factor: 0.3,
                    terms: &terms[..count],
                    sums: PhantomData,
                });
                [out, low].map(|numbers| numbers.map(f64::to_bits))
            };
            assert_eq!(with(&run), with(&|work| work.run()), "{count} numbers");
        }
    }

    #[test]
    fn kicks_have_the_same_bits_in_all_registers() {
        for count in 0..MAX_COUNT {
            if let Some(avx2) = Avx2::detect() {
                compare::<Plain>(count, |work| avx2.run(work));
                compare::<Compensated>(count, |work| avx2.run(work));
            }
            if let Some(avx512) = Avx512::detect() {
                compare::<Plain>(count, |work| avx512.run(work));
                compare::<Compensated>(count, |work| avx512.run(work));
            }
        }
    }
}
