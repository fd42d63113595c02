//! Eigenvalues and eigenvectors of small matrices, to some hundred binary places, without proof.

use super::fixed::{Complex, Fixed};
use super::rounding::{exact, to_f64};

/// A matrix by its rows.
pub type Rows = Vec<Vec<Fixed>>;

/// A similarity transformation `X⁻¹ B X` of a real matrix `B` to block diagonal form.
#[derive(Debug, Clone)]
pub struct Blocks {
    /// One eigenvalue `(α, ω)` per block: the block is `α` if `ω` is zero, otherwise `[[α, −ω], [ω, α]]` with `ω > 0`.
    pub values: Vec<(Fixed, Fixed)>,
    /// `X`
    pub vectors: Rows,
    /// `X⁻¹`
    pub inverse: Rows,
}

impl Blocks {
    /// The block diagonal form of the square of the matrix.
    #[must_use]
    pub fn squared(mut self) -> Self {
        let mut values = Vec::new();
        let mut column = 0;
        for (re, im) in &self.values {
            let square = re.multiply(re).subtract(&im.multiply(im));
            if im.vanishes() {
                values.push((square, Fixed::zero()));
                column += 1;
                continue;
            }
            let product = re.multiply(im);
            let double = product.add(&product);
            if double.vanishes() {
                // α = 0: the block of the square is −ω² times the identity.
                values.extend([(square.clone(), Fixed::zero()), (square, Fixed::zero())]);
            } else {
                if double < Fixed::zero() {
                    // A negative ω belongs to the conjugate eigenvector.
                    for row in &mut self.vectors {
                        row[column + 1] = row[column + 1].negate();
                    }
                    for entry in &mut self.inverse[column + 1] {
                        *entry = entry.negate();
                    }
                }
                values.push((square, double.abs()));
            }
            column += 2;
        }
        Blocks { values, ..self }
    }
}

/// Maximum number of sweeps of the root iteration.
const SWEEPS: usize = 200;

/// Block-diagonalises a matrix; `None` if it is not diagonalisable, to working precision, or has a multiple nonzero
/// eigenvalue.
pub fn diagonalise(matrix: &Rows) -> Option<Blocks> {
    let size = matrix.len();
    let (polynomial, adjugate) = characteristic(matrix);
    let zeros = polynomial.iter().take_while(|c| c.vanishes()).count();
    let roots = roots(&polynomial[zeros..])?;
    let mut values = vec![(Fixed::zero(), Fixed::zero()); zeros];
    let mut columns: Vec<Vec<Fixed>> = Vec::new();
    if zeros > 0 {
        let kernel = kernel(matrix);
        if kernel.len() != zeros {
            return None;
        }
        columns.extend(kernel);
    }
    let mut chosen: Vec<Complex> = roots
        .into_iter()
        .filter(|root| root.im.vanishes() || root.im > Fixed::zero())
        .collect();
    chosen.sort_by(|a, b| (&a.re, &a.im).cmp(&(&b.re, &b.im)));
    for mut root in chosen {
        let is_real = root.im.vanishes();
        if is_real {
            root.im = Fixed::zero();
        }
        let vector = eigenvector(&adjugate, &root)?;
        columns.push(vector.iter().map(|z| z.re.clone()).collect());
        if !is_real {
            columns.push(vector.iter().map(|z| z.im.negate()).collect());
        }
        values.push((root.re, root.im));
    }
    if columns.len() != size {
        return None;
    }
    let entry = |i: usize, j: usize| columns[j][i].clone();
    let vectors: Rows = (0..size)
        .map(|i| (0..size).map(|j| entry(i, j)).collect())
        .collect();
    Some(Blocks {
        values,
        inverse: inverse(&vectors)?,
        vectors,
    })
}

/// The product of two matrices.
pub fn product(a: &Rows, b: &Rows) -> Rows {
    let columns = b.first().map_or(0, Vec::len);
    let entry = |row: &Vec<Fixed>, j: usize| {
        let products = row.iter().zip(b).map(|(x, other)| x.multiply(&other[j]));
        products.fold(Fixed::zero(), |sum, product| sum.add(&product))
    };
    let row = |row| (0..columns).map(|j| entry(row, j)).collect();
    a.iter().map(row).collect()
}

/// The coefficients of `det(λ − B)`, the constant term first, and the matrices `M_1`, `M_2`, … of
/// `adj(λ − B) = Σ_k λ^(s−k) M_k` (Faddeev & LeVerrier).
fn characteristic(matrix: &Rows) -> (Vec<Fixed>, Vec<Rows>) {
    let size = matrix.len();
    let mut coefficients = vec![Fixed::one(); size + 1];
    let mut adjugate = Vec::with_capacity(size);
    let mut power = vec![vec![Fixed::zero(); size]; size];
    for k in 1..=size {
        for (i, row) in power.iter_mut().enumerate() {
            row[i] = row[i].add(&coefficients[size + 1 - k]);
        }
        let next = product(matrix, &power);
        adjugate.push(power);
        power = next;
        let trace = (0..size).fold(Fixed::zero(), |sum, i| sum.add(&power[i][i]));
        coefficients[size - k] = trace.negate().divide(&Fixed::integer(k as i64));
    }
    (coefficients, adjugate)
}

/// The eigenvector of a simple eigenvalue, a nonzero column of `adj(λ − B)`, scaled so that its largest entry is 1.
fn eigenvector(adjugate: &[Rows], value: &Complex) -> Option<Vec<Complex>> {
    let size = adjugate.len();
    let entry = |i: usize, j: usize| {
        adjugate
            .iter()
            .fold(Complex::real(Fixed::zero()), |sum, matrix| {
                let scaled = sum.multiply(value);
                scaled.add(&Complex::real(matrix[i][j].clone()))
            })
    };
    (0..size).find_map(|j| {
        let vector: Vec<Complex> = (0..size).map(|i| entry(i, j)).collect();
        let largest = vector.iter().max_by_key(|z| z.size())?;
        if largest.size().is_below(40) {
            return None;
        }
        Some(vector.iter().map(|z| z.divide(largest)).collect())
    })
}

/// The simple roots of a monic polynomial (Ehrlich & Aberth); `None` if two roots are close or the iteration fails.
fn roots(polynomial: &[Fixed]) -> Option<Vec<Complex>> {
    let degree = polynomial.len() - 1;
    let part = |x: f64| Fixed::new(&exact(if x.is_finite() { x } else { 0.0 }));
    let mut roots: Vec<Complex> = approximate_roots(polynomial)
        .into_iter()
        .map(|(re, im)| Complex {
            re: part(re),
            im: part(im),
        })
        .collect();
    for _ in 0..SWEEPS {
        let mut settled = true;
        for k in 0..degree {
            let step = aberth(polynomial, &roots, k);
            // The iteration converges cubically: the next step would be negligible.
            settled &= step.size().is_below(60);
            roots[k] = roots[k].subtract(&step);
        }
        if settled {
            // At a multiple root the steps become small before the root is accurate.
            let apart =
                |i: usize| (0..i).all(|j| !roots[i].subtract(&roots[j]).size().is_below(30));
            return (0..degree).all(apart).then_some(roots);
        }
    }
    None
}

/// The roots in double precision, as starting values.
fn approximate_roots(polynomial: &[Fixed]) -> Vec<(f64, f64)> {
    type Double = (f64, f64);
    let minus = |a: Double, b: Double| (a.0 - b.0, a.1 - b.1);
    let times = |a: Double, b: Double| (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0);
    let over = |a: Double, b: Double| {
        let square = b.0 * b.0 + b.1 * b.1;
        let product = times(a, (b.0, -b.1));
        (product.0 / square, product.1 / square)
    };
    let coefficients: Vec<f64> = polynomial.iter().map(|c| to_f64(&c.rational())).collect();
    let degree = coefficients.len() - 1;
    // Starting points on the unit circle, none on the real axis and no two conjugate.
    let angle = |k: usize| 0.4 + std::f64::consts::TAU * k as f64 / degree as f64;
    let mut roots: Vec<Double> = (0..degree)
        .map(|k| (angle(k).cos(), angle(k).sin()))
        .collect();
    for _ in 0..SWEEPS {
        let mut largest = 0.0_f64;
        for k in 0..degree {
            let z = roots[k];
            let (mut value, mut slope) = ((0.0, 0.0), (0.0, 0.0));
            for &coefficient in coefficients.iter().rev() {
                let product = times(slope, z);
                slope = (product.0 + value.0, product.1 + value.1);
                let product = times(value, z);
                value = (product.0 + coefficient, product.1);
            }
            let mut sum = (0.0, 0.0);
            for (_, &other) in roots.iter().enumerate().filter(|&(j, _)| j != k) {
                let term = over((1.0, 0.0), minus(z, other));
                sum = (sum.0 + term.0, sum.1 + term.1);
            }
            let step = over(value, minus(slope, times(value, sum)));
            largest = largest.max(step.0.abs() + step.1.abs());
            roots[k] = minus(z, step);
        }
        if largest < 1e-8 {
            break;
        }
    }
    roots
}

/// Aberth's correction `w/(1 − w Σ_j 1/(z − z_j))` with `w = f/f′`; the sum removes the other roots.
fn aberth(polynomial: &[Fixed], roots: &[Complex], k: usize) -> Complex {
    let z = &roots[k];
    let mut value = Complex::real(Fixed::zero());
    let mut slope = Complex::real(Fixed::zero());
    for coefficient in polynomial.iter().rev() {
        slope = slope.multiply(z).add(&value);
        value = value.multiply(z).add(&Complex::real(coefficient.clone()));
    }
    let one = Complex::real(Fixed::one());
    let others = roots.iter().enumerate().filter(|&(j, _)| j != k);
    let sum = others.fold(Complex::real(Fixed::zero()), |sum, (_, other)| {
        sum.add(&one.divide(&z.subtract(other)))
    });
    // f/(f′ − f Σ …) avoids a division by f′, which may be small.
    value.divide(&slope.subtract(&value.multiply(&sum)))
}

/// A basis of the kernel of a matrix.
fn kernel(matrix: &Rows) -> Rows {
    let size = matrix.len();
    let mut rows = matrix.clone();
    // The column of each pivot; the other columns are free.
    let mut pivots = Vec::new();
    for column in 0..size {
        let rank = pivots.len();
        let Some(best) = (rank..size).max_by_key(|&i| rows[i][column].abs()) else {
            break;
        };
        if !rows[best][column].vanishes() {
            rows.swap(rank, best);
            eliminate(&mut rows, rank, column);
            pivots.push(column);
        }
    }
    let free = (0..size).filter(|column| !pivots.contains(column));
    free.map(|column| {
        let mut vector = vec![Fixed::zero(); size];
        vector[column] = Fixed::one();
        for (row, &pivot) in rows.iter().zip(&pivots) {
            vector[pivot] = row[column].negate();
        }
        vector
    })
    .collect()
}

/// Gauss–Jordan step: scales the pivot to 1 and eliminates its column from all other rows.
fn eliminate(rows: &mut Rows, row: usize, column: usize) {
    let pivot = rows[row][column].clone();
    rows[row].iter_mut().for_each(|x| *x = x.divide(&pivot));
    let pivot_row = rows[row].clone();
    for (_, other) in rows.iter_mut().enumerate().filter(|&(i, _)| i != row) {
        let factor = other[column].clone();
        let entries = other.iter_mut().zip(&pivot_row).skip(column);
        entries.for_each(|(x, y)| *x = x.subtract(&factor.multiply(y)));
    }
}

/// The inverse of a matrix; `None` if it is singular to working precision.
fn inverse(matrix: &Rows) -> Option<Rows> {
    let size = matrix.len();
    let unit = |i: usize, j: usize| if i == j { Fixed::one() } else { Fixed::zero() };
    let mut rows: Rows = matrix
        .iter()
        .enumerate()
        .map(|(i, row)| {
            row.iter()
                .cloned()
                .chain((0..size).map(|j| unit(i, j)))
                .collect()
        })
        .collect();
    for column in 0..size {
        let best = (column..size).max_by_key(|&i| rows[i][column].abs())?;
        if rows[best][column].vanishes() {
            return None;
        }
        rows.swap(column, best);
        eliminate(&mut rows, column, column);
    }
    Some(
        rows.into_iter()
            .map(|mut row| row.split_off(size))
            .collect(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::ratio;

    fn matrix(entries: &[&[i64]]) -> Rows {
        let row = |row: &&[i64]| row.iter().map(|&x| Fixed::integer(x)).collect();
        entries.iter().map(row).collect()
    }

    /// Checks `B X = X Λ`, `X⁻¹ X = 1` and the blocks.
    fn check(entries: &[&[i64]], expected: &[(i64, i64)]) {
        let matrix = matrix(entries);
        let blocks = diagonalise(&matrix).expect("diagonalisable");
        check_blocks(&matrix, &blocks, expected);
    }

    fn check_blocks(matrix: &Rows, blocks: &Blocks, expected: &[(i64, i64)]) {
        let values = blocks.values.iter();
        let values: Vec<_> = values
            .map(|(re, im)| (re.rational(), im.rational()))
            .collect();
        for (value, &(re, im)) in values.iter().zip(expected) {
            let vanishes =
                |x: &num_rational::BigRational, y: i64| Fixed::new(&(x - ratio(y, 1))).vanishes();
            assert!(
                vanishes(&value.0, re) && vanishes(&value.1, im),
                "{value:?}"
            );
        }
        assert_eq!(values.len(), expected.len());
        let size = matrix.len();
        let mut diagonal = vec![vec![Fixed::zero(); size]; size];
        let mut k = 0;
        for (re, im) in &blocks.values {
            diagonal[k][k] = re.clone();
            if !im.vanishes() {
                diagonal[k][k + 1] = im.negate();
                diagonal[k + 1][k] = im.clone();
                diagonal[k + 1][k + 1] = re.clone();
                k += 1;
            }
            k += 1;
        }
        let (left, right) = (
            product(matrix, &blocks.vectors),
            product(&blocks.vectors, &diagonal),
        );
        let unit = product(&blocks.inverse, &blocks.vectors);
        for i in 0..size {
            for j in 0..size {
                assert!(left[i][j].subtract(&right[i][j]).vanishes());
                let one = Fixed::integer(i64::from(i == j));
                assert!(unit[i][j].subtract(&one).vanishes());
            }
        }
    }

    #[test]
    fn diagonalisation_finds_the_blocks_of_known_matrices() {
        check(&[&[2]], &[(2, 0)]);
        check(&[&[0, -1], &[1, 0]], &[(0, 1)]);
        check(&[&[1, 1], &[0, 3]], &[(1, 0), (3, 0)]);
        check(&[&[3, -2, 0], &[4, -1, 0], &[7, 5, 9]], &[(1, 2), (9, 0)]);
        // A double eigenvalue 0 with two eigenvectors.
        check(
            &[&[1, 1, 1], &[1, 1, 1], &[1, 1, 1]],
            &[(0, 0), (0, 0), (3, 0)],
        );
    }

    #[test]
    fn squared_blocks_are_those_of_the_squared_matrix() {
        let check = |entries: &[&[i64]], expected: &[(i64, i64)]| {
            let matrix = matrix(entries);
            let blocks = diagonalise(&matrix).expect("diagonalisable").squared();
            check_blocks(&product(&matrix, &matrix), &blocks, expected);
        };
        check(&[&[1, 1], &[0, 3]], &[(1, 0), (9, 0)]);
        check(&[&[0, -1], &[1, 0]], &[(-1, 0), (-1, 0)]);
        // (1 ± 2i)² = −3 ± 4i, and (−1 ± 2i)² = −3 ∓ 4i.
        check(&[&[3, -2, 0], &[4, -1, 0], &[7, 5, 9]], &[(-3, 4), (81, 0)]);
        check(&[&[-3, 2, 0], &[-4, 1, 0], &[7, 5, 9]], &[(-3, 4), (81, 0)]);
    }

    #[test]
    fn diagonalisation_refuses_defective_matrices() {
        assert!(diagonalise(&matrix(&[&[0, 1], &[0, 0]])).is_none());
        assert!(diagonalise(&matrix(&[&[1, 1], &[0, 1]])).is_none());
    }
}
