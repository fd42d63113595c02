//! How the linear systems of a Newton iteration decouple for a tableau at run time.

use alloc::vec;
use alloc::vec::Vec;

use nalgebra::{DMatrix, Schur};

use symplectic_core::inside::rows::RowDecoupling;
use symplectic_linearisation::{Complex, Elimination, Entry};

/// A matrix by its rows.
type Rows = Vec<Vec<f64>>;

/// Eigenvalues below this part of the largest entry of the matrix are zero.
const ZERO: f64 = 1e-9;

/// Nonzero eigenvalues closer than this part of the largest entry of the matrix may be one, without enough eigenvectors.
const CLOSE: f64 = 1e-6;

/// Distance of the shift of an inverse iteration from the eigenvalue, as a part of the largest entry of the matrix.
const SHIFT: f64 = 1e-10;

/// Largest relative error of `B X = X D`.
const ERROR: f64 = 1e-8;

/// Largest product of the entries of `X` and `X⁻¹`: rounding errors of the transformation grow by it, those of singles too.
const CONDITION: f64 = 1e6;

/// Largest number of stages: the condition of larger matrices is too bad.
const MAX_STAGES: usize = 64;

/// Maximum number of sweeps of the eigenvalue iteration, for each row.
const SWEEPS: usize = 100;

/// Decouples stages with the coefficients `a_ij` and `ã_ij`; `None` if that is impossible or loses too many digits.
pub fn decouple(a: &[Vec<f64>], a_tilde: &[Vec<f64>], separable: bool) -> Option<RowDecoupling> {
    if a.len().max(a_tilde.len()) > MAX_STAGES {
        return None;
    }
    if separable {
        return diagonalise(&product(a_tilde, a));
    }
    let mut pairs = a.iter().flatten().zip(a_tilde.iter().flatten());
    let size = largest(a);
    let are_equal = pairs.all(|(x, y)| (x - y).abs() <= 64.0 * f64::EPSILON * size);
    are_equal.then(|| diagonalise(a)).flatten()
}

/// Block-diagonalises a matrix.
fn diagonalise(matrix: &[Vec<f64>]) -> Option<RowDecoupling> {
    let (count, size) = (matrix.len(), largest(matrix));
    let is_finite = matrix.iter().flatten().all(|entry| entry.is_finite());
    if size == 0.0 || !is_finite {
        return None;
    }
    let blocks = eigenvalues(matrix, size)?;
    let mut vectors = vec![Vec::with_capacity(count); count];
    for &value in &blocks {
        let vector = eigenvector(matrix, value, SHIFT * size, vectors[0].len())?;
        for (row, entry) in vectors.iter_mut().zip(&vector) {
            row.push(entry.re);
            if value.1 != 0.0 {
                row.push(-entry.im);
            }
        }
    }
    let dense = DMatrix::from_fn(count, count, |i, j| vectors[i][j]);
    let inverse = dense.try_inverse()?;
    let inverse: Rows = (0..count)
        .map(|i| (0..count).map(|j| inverse[(i, j)]).collect())
        .collect();
    let left = product(matrix, &vectors);
    let right = product(&vectors, &diagonal(&blocks, count));
    let pairs = left.iter().flatten().zip(right.iter().flatten());
    let error = pairs.fold(0.0, |largest: f64, (x, y)| largest.max((x - y).abs()));
    let is_accurate = error <= ERROR * size * largest(&vectors)
        && largest(&vectors) * largest(&inverse) <= CONDITION;
    is_accurate.then_some(RowDecoupling {
        blocks,
        to_stages: vectors,
        from_stages: inverse,
    })
}

/// The real eigenvalues, and those with a positive imaginary part; `None` if two of them that are not zero are close.
fn eigenvalues(matrix: &[Vec<f64>], size: f64) -> Option<Vec<(f64, f64)>> {
    let count = matrix.len();
    let dense = DMatrix::from_fn(count, count, |i, j| matrix[i][j]);
    let schur = Schur::try_new(dense, f64::EPSILON, SWEEPS * count)?;
    let mut values: Vec<(f64, f64)> = Vec::new();
    for value in schur.complex_eigenvalues().iter() {
        let is_zero = |part: f64| part.abs() <= ZERO * size;
        let imaginary = if is_zero(value.im) { 0.0 } else { value.im };
        let real = match imaginary == 0.0 && is_zero(value.re) {
            true => 0.0,
            false => value.re,
        };
        if imaginary < 0.0 {
            continue;
        }
        let is_close = |other: &(f64, f64)| {
            (other.0 - real).abs().max((other.1 - imaginary).abs()) <= CLOSE * size
        };
        if (real, imaginary) != (0.0, 0.0) && values.iter().any(is_close) {
            return None;
        }
        values.push((real, imaginary));
    }
    let of_blocks = values
        .iter()
        .map(|value| if value.1 == 0.0 { 1 } else { 2 });
    (of_blocks.sum::<usize>() == count).then_some(values)
}

/// The block-diagonal matrix.
fn diagonal(blocks: &[(f64, f64)], count: usize) -> Rows {
    let mut matrix = vec![vec![0.0; count]; count];
    let mut first = 0;
    for &(real, imaginary) in blocks {
        matrix[first][first] = real;
        if imaginary != 0.0 {
            matrix[first + 1][first + 1] = real;
            matrix[first][first + 1] = -imaginary;
            matrix[first + 1][first] = imaginary;
            first += 1;
        }
        first += 1;
    }
    matrix
}

/// An eigenvector, by inverse iteration; its largest entry is 1. Each `number` starts from another vector, so that a multiple eigenvalue
/// gets several.
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
        // Pseudo-random numbers between −1 and 1: the vectors are as independent as possible.
        let bits = (1 + i as u64 + 4096 * number as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        let bits = (bits ^ bits >> 29).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let re = (bits >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
        *entry = Complex { re, im: 0.0 };
    }
    for _ in 0..2 {
        elimination.solve();
        let size = |place: usize| elimination.right[place].size();
        let place = (0..count).max_by(|&a, &b| size(a).total_cmp(&size(b)))?;
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
    use symplectic::emitted::Coupled;
    use symplectic_core::Method;
    use symplectic_core::solver::StageTableau;

    use super::*;
    use crate::coefficients::RunTimeCoefficients;
    use crate::schedule::Schedule;

    symplectic::tableau! {
        Gauss2 { basis: polynomial(2), nodes: gauss(2) }
        Gauss5 { basis: polynomial(5), nodes: gauss(5) }
        Gauss8 { basis: polynomial(8), nodes: gauss(8) }
        Gauss12 { basis: polynomial(12), nodes: gauss(12) }
        Lobatto3 { basis: polynomial(3), nodes: lobatto(3) }
        Lobatto5 { basis: polynomial(5), nodes: lobatto(5) }
        Radau3 { basis: polynomial(3), nodes: radau-left(3) }
        Coarse { basis: polynomial(2), quadrature: gauss(6) }
        Twice { compose: [[1/2, base: gauss-2], [1/2, base: gauss-2]] }
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
        let found = (coupled.decoupling.as_ref()).map(|decoupling| decoupling.blocks.clone());
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
        compare_all!(Gauss2 Gauss5 Gauss8 Gauss12 Lobatto3 Lobatto5 Radau3 Coarse);
    }

    /// Its matrix has each eigenvalue twice, and rounding parts them.
    #[test]
    fn a_composition_is_not_decoupled() {
        for separable in [true, false] {
            let schedule = Schedule::new(&Twice::COEFFICIENTS.into(), separable);
            assert!(matches!(schedule, Schedule::Coupled(coupled) if coupled.decoupling.is_none()));
        }
    }

    #[test]
    fn a_matrix_without_enough_eigenvectors_is_not_decoupled() {
        let defective = [vec![1.0, 1.0], vec![0.0, 1.0]];
        assert_eq!(diagonalise(&defective), None);
        // The same in another basis: rounding splits the eigenvalue.
        let turned = [vec![1.3, 0.1], vec![-0.9, 0.7]];
        assert_eq!(diagonalise(&turned), None);
        assert_eq!(diagonalise(&[vec![0.0; 2], vec![0.0; 2]]), None);
        assert_eq!(diagonalise(&[]), None);
        assert_eq!(diagonalise(&[vec![1.0, f64::NAN], vec![0.0, 1.0]]), None);
    }

    #[test]
    fn a_multiple_zero_has_as_many_eigenvectors() {
        // Of rank 1, with eleven zeros.
        let row = |i: usize| (0..12).map(|j| (1 + i) as f64 / (1 + j) as f64).collect();
        let matrix: Rows = (0..12).map(row).collect();
        let blocks = diagonalise(&matrix).expect("diagonalisable").blocks;
        assert_eq!(
            blocks.iter().filter(|block| **block == (0.0, 0.0)).count(),
            11
        );
    }
}
