//! How the linear systems of a Newton iteration decouple for a tableau at run time.

use alloc::vec;
use alloc::vec::Vec;

use nalgebra::{DMatrix, Schur};

use crate::number::elimination::{Complex, Elimination, Entry};

/// A matrix by its rows.
type Rows = Vec<Vec<f64>>;

/// A [`Decoupling`](crate::solver::Decoupling) in doubles. Its errors cost sweeps, but they never change the solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Decoupling {
    /// The blocks in their order: `(α, ω)`, with `ω = 0` for a real eigenvalue.
    pub blocks: Vec<(f64, f64)>,
    /// `X` by rows.
    pub to_stages: Rows,
    /// `X⁻¹` by rows.
    pub from_stages: Rows,
}

/// Eigenvalues below this part of the largest entry of the matrix are zero.
const ZERO: f64 = 1e-9;

/// Distance of the shift of an inverse iteration from the eigenvalue, as a part of the largest entry of the matrix.
const SHIFT: f64 = 1e-10;

/// Largest relative error of `B X = X D`.
const ERROR: f64 = 1e-8;

/// Largest product of the entries of `X` and `X⁻¹`: rounding errors of the transformation grow by it.
const CONDITION: f64 = 1e8;

/// Maximum number of sweeps of the eigenvalue iteration, for each row.
const SWEEPS: usize = 100;

impl Decoupling {
    /// Decouples stages with the coefficients `a_ij` and `ã_ij`; `None` if that is impossible or loses too many digits.
    pub fn new(a: &[Vec<f64>], a_tilde: &[Vec<f64>], separable: bool) -> Option<Self> {
        if separable {
            return Self::of(&product(a_tilde, a));
        }
        let mut pairs = a.iter().flatten().zip(a_tilde.iter().flatten());
        let size = largest(a);
        let are_equal = pairs.all(|(x, y)| (x - y).abs() <= 64.0 * f64::EPSILON * size);
        are_equal.then(|| Self::of(a)).flatten()
    }

    /// Block-diagonalises a matrix.
    fn of(matrix: &[Vec<f64>]) -> Option<Self> {
        let (count, size) = (matrix.len(), largest(matrix));
        if count == 0 || size == 0.0 || !size.is_finite() {
            return None;
        }
        let dense = DMatrix::from_fn(count, count, |i, j| matrix[i][j]);
        let schur = Schur::try_new(dense.clone(), f64::EPSILON, SWEEPS * count)?;
        let mut blocks: Vec<(f64, f64)> = Vec::new();
        let mut x = DMatrix::zeros(count, count);
        let mut column = 0;
        for value in schur.complex_eigenvalues().iter() {
            let is_zero = value.re.abs().max(value.im.abs()) <= ZERO * size;
            let is_real = is_zero || value.im.abs() <= ZERO * size;
            if !is_real && value.im < 0.0 {
                continue;
            }
            let value = (
                if is_zero { 0.0 } else { value.re },
                if is_real { 0.0 } else { value.im },
            );
            let vector = eigenvector(matrix, value, SHIFT * size, column)?;
            let parts = if is_real { 1 } else { 2 };
            if column + parts > count {
                return None;
            }
            for (i, entry) in vector.iter().enumerate() {
                x[(i, column)] = entry.re;
                if !is_real {
                    x[(i, column + 1)] = -entry.im;
                }
            }
            column += parts;
            blocks.push(value);
        }
        if column != count {
            return None;
        }
        let inverse = x.clone().try_inverse()?;
        let transformed = &dense * &x - &x * diagonal(&blocks, count);
        let is_accurate =
            transformed.amax() <= ERROR * size * x.amax() && x.amax() * inverse.amax() <= CONDITION;
        let rows = |matrix: &DMatrix<f64>| -> Rows {
            let row = |i| (0..count).map(|j| matrix[(i, j)]).collect();
            (0..count).map(row).collect()
        };
        is_accurate.then(|| Self {
            blocks,
            to_stages: rows(&x),
            from_stages: rows(&inverse),
        })
    }
}

/// The block-diagonal matrix.
fn diagonal(blocks: &[(f64, f64)], count: usize) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(count, count);
    let mut first = 0;
    for &(real, imaginary) in blocks {
        matrix[(first, first)] = real;
        if imaginary != 0.0 {
            matrix[(first + 1, first + 1)] = real;
            matrix[(first, first + 1)] = -imaginary;
            matrix[(first + 1, first)] = imaginary;
            first += 1;
        }
        first += 1;
    }
    matrix
}

/// An eigenvector, by inverse iteration; its largest entry is 1. Other numbers begin elsewhere, so that a multiple eigenvalue gets several.
fn eigenvector(
    matrix: &[Vec<f64>],
    (real, imaginary): (f64, f64),
    shift: f64,
    number: usize,
) -> Option<Vec<Complex<f64>>> {
    let count = matrix.len();
    let mut elimination = Elimination::new(count, count - 1);
    let is_regular = elimination.factor(|i, j| {
        let unit = if i == j { 1.0 } else { 0.0 };
        Complex {
            re: matrix[i][j] - unit * (real + shift),
            im: -unit * imaginary,
        }
    });
    if !is_regular {
        return None;
    }
    for (i, entry) in elimination.right.iter_mut().enumerate() {
        // Any vectors that are independent of each other.
        let re = 1.0 / (1 + (i + 2 * number) % (2 * count)) as f64;
        *entry = Complex { re, im: 0.0 };
    }
    for _ in 0..2 {
        elimination.solve();
        let sizes = elimination.right.iter().map(|entry| entry.size());
        let (place, _) =
            sizes.enumerate().fold(
                (0, 0.0),
                |best, (place, size)| {
                    if size > best.1 { (place, size) } else { best }
                },
            );
        let inverse = elimination.right[place].inverse();
        for entry in &mut elimination.right {
            *entry = *entry * inverse;
        }
    }
    let is_finite = |z: &Complex<f64>| z.re.is_finite() && z.im.is_finite();
    let vector = elimination.right;
    vector.iter().all(is_finite).then_some(vector)
}

/// The largest entry.
fn largest(matrix: &[Vec<f64>]) -> f64 {
    let entries = matrix.iter().flatten();
    entries.fold(0.0, |largest: f64, entry| largest.max(entry.abs()))
}

/// The product of two matrices.
fn product(a: &[Vec<f64>], b: &[Vec<f64>]) -> Rows {
    let columns = b.first().map_or(0, Vec::len);
    let row = |row: &Vec<f64>| {
        let mut sums = vec![0.0; columns];
        for (factor, other) in row.iter().zip(b) {
            let terms = sums.iter_mut().zip(other);
            terms.for_each(|(sum, entry)| *sum += factor * entry);
        }
        sums
    };
    a.iter().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::method::run_time::Schedule;
    use crate::method::{Coupled, Method, RunTimeCoefficients, StageTableau};

    symplectic::tableau! {
        Gauss2 { basis: polynomial(2), nodes: gauss(2) }
        Gauss5 { basis: polynomial(5), nodes: gauss(5) }
        Gauss8 { basis: polynomial(8), nodes: gauss(8) }
        Lobatto3 { basis: polynomial(3), nodes: lobatto(3) }
        Lobatto5 { basis: polynomial(5), nodes: lobatto(5) }
        Radau3 { basis: polynomial(3), nodes: radau-left(3) }
    }

    /// The stages of a plan.
    trait StagesOf {
        type Stages: StageTableau;
    }

    impl<P: StageTableau> StagesOf for Coupled<P> {
        type Stages = P;
    }

    /// The blocks of the compiler, from 192 bits, and those found here.
    fn compare<M, P>(_method: M, separable: bool)
    where
        M: Method,
        P: StagesOf,
    {
        let coefficients: RunTimeCoefficients = M::COEFFICIENTS.into();
        let Schedule::Coupled(coupled) = Schedule::new(&coefficients, separable) else {
            panic!("{} is implicit", M::NAME);
        };
        let emitted = P::Stages::DECOUPLING.map(|decoupling| decoupling.blocks.to_vec());
        let found = coupled.decoupling.map(|decoupling| decoupling.blocks);
        assert_eq!(
            emitted.is_some(),
            found.is_some(),
            "{}, {separable}",
            M::NAME
        );
        let (Some(mut emitted), Some(mut found)) = (emitted, found) else {
            return;
        };
        for list in [&mut emitted, &mut found] {
            list.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
        }
        assert_eq!(emitted.len(), found.len(), "{}", M::NAME);
        for (expected, found) in emitted.iter().zip(&found) {
            let apart = (expected.0 - found.0)
                .abs()
                .max((expected.1 - found.1).abs());
            assert!(apart < 1e-10, "{}: {expected:?}, {found:?}", M::NAME);
        }
    }

    #[test]
    fn the_blocks_are_those_of_emitted_methods() {
        macro_rules! compare_all {
            ($($method:ident)*) => {$(
                compare::<_, <$method as Method>::Separable>($method, true);
                compare::<_, <$method as Method>::General>($method, false);
            )*};
        }
        compare_all!(Gauss2 Gauss5 Gauss8 Lobatto3 Lobatto5 Radau3);
    }

    #[test]
    fn a_matrix_without_enough_eigenvectors_is_not_decoupled() {
        let defective = [vec![1.0, 1.0], vec![0.0, 1.0]];
        assert_eq!(Decoupling::of(&defective), None);
        assert_eq!(Decoupling::of(&[vec![0.0; 2], vec![0.0; 2]]), None);
        assert_eq!(Decoupling::of(&[vec![f64::NAN]]), None);
    }
}
