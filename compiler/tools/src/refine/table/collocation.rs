//! The polynomial of the nodes, from linear conditions on its coefficients.

use num_integer::binomial;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use symplectic_compiler::Limits;
use symplectic_compiler::{FAMILIES, QuadratureRule};
use symplectic_exact::polynomial::Polynomial;
use symplectic_exact::rational::ratio;

/// The data about the nodes.
pub(super) struct Nodes {
    /// The printed values.
    pub printed: Vec<BigRational>,
    /// The nodes that are printed exactly.
    pub exact: Vec<BigRational>,
    /// Whether they are symmetric.
    pub symmetric: bool,
    /// The order of the quadrature.
    pub order: usize,
}

/// All polynomials whose roots are suitable nodes: the free coefficients determine the others.
pub(super) struct Family {
    degree: usize,
    /// The reduced echelon form, with its pivots.
    rows: Vec<(usize, Equation)>,
}

/// `Σ_k coefficients_k m_k = right` for the coefficients of `M = x^s + m_{s−1} x^{s−1} + ⋯ + m_0`.
struct Equation {
    coefficients: Vec<BigRational>,
    right: BigRational,
}

impl Family {
    /// The family of polynomials; `None` if the conditions contradict one another.
    pub fn of(nodes: &Nodes) -> Option<Self> {
        let degree = nodes.printed.len();
        let rows = echelon(equations(nodes), degree)?;
        Some(Family { degree, rows })
    }

    /// The powers whose coefficients are free.
    pub fn free(&self) -> Vec<usize> {
        let pivot = |power: usize| self.rows.iter().any(|(pivot, _)| *pivot == power);
        (0..self.degree).filter(|&power| !pivot(power)).collect()
    }

    /// The polynomial whose free coefficients are taken from `coefficients`.
    pub fn polynomial(&self, coefficients: &[BigRational]) -> Polynomial {
        let mut all = coefficients.to_vec();
        for (pivot, row) in &self.rows {
            let others = self.free().into_iter();
            let rest = others.map(|power| &row.coefficients[power] * &coefficients[power]);
            all[*pivot] = rest.fold(row.right.clone(), |rest, x| rest - x);
        }
        all.push(BigRational::one());
        Polynomial::from_rationals(&all)
    }
}

/// The coefficients of the polynomial with these nodes as roots, except the leading coefficient 1.
pub(super) fn coefficients(nodes: &[BigRational]) -> Vec<BigRational> {
    let product = nodes.iter().fold(Polynomial::one(), |product, node| {
        let factor = Polynomial::from_rationals(&[-node, BigRational::one()]);
        &product * &factor
    });
    (0..nodes.len())
        .map(|power| product.coefficient(power))
        .collect()
}

fn equations(nodes: &Nodes) -> Vec<Equation> {
    let degree = nodes.printed.len();
    let whole = |n: usize| ratio(i64::try_from(n).unwrap_or(i64::MAX), 1);
    let monic = |entry: &dyn Fn(usize) -> BigRational| Equation {
        coefficients: (0..degree).map(entry).collect(),
        right: -entry(degree),
    };
    // ∫M x^k = 0.
    let quadrature =
        (0..nodes.order.saturating_sub(degree)).map(|k| monic(&|j| whole(j + k + 1).recip()));
    let roots = nodes
        .exact
        .iter()
        .map(|node| monic(&|j| num_traits::pow(node.clone(), j)));
    // M(1 − x) = (−1)^s M(x), for each power of x.
    let sign = |n: usize| {
        if n.is_multiple_of(2) {
            ratio(1, 1)
        } else {
            ratio(-1, 1)
        }
    };
    let mirrored = |power: usize| {
        monic(&|j| {
            let above = match j >= power {
                true => sign(power) * whole(binomial(j, power)),
                false => BigRational::zero(),
            };
            match j == power {
                true => above - sign(degree),
                false => above,
            }
        })
    };
    let powers = if nodes.symmetric { 0..degree } else { 0..0 };
    let mirrored = powers.map(mirrored);
    quadrature.chain(roots).chain(mirrored).collect()
}

/// The reduced echelon form, with its pivots; `None` for a contradiction.
fn echelon(equations: Vec<Equation>, degree: usize) -> Option<Vec<(usize, Equation)>> {
    let mut rows: Vec<(usize, Equation)> = Vec::new();
    for mut equation in equations {
        for (pivot, row) in &rows {
            let factor = equation.coefficients[*pivot].clone();
            subtract(&mut equation, row, &factor);
        }
        let pivot = (0..degree)
            .rev()
            .find(|&k| !equation.coefficients[k].is_zero());
        let Some(pivot) = pivot else {
            if equation.right.is_zero() {
                continue;
            }
            return None;
        };
        let scale = equation.coefficients[pivot].recip();
        equation.coefficients.iter_mut().for_each(|x| *x *= &scale);
        equation.right *= scale;
        for (_, row) in &mut rows {
            let factor = row.coefficients[pivot].clone();
            subtract(row, &equation, &factor);
        }
        rows.push((pivot, equation));
    }
    Some(rows)
}

fn subtract(from: &mut Equation, row: &Equation, factor: &BigRational) {
    if factor.is_zero() {
        return;
    }
    for (entry, other) in from.coefficients.iter_mut().zip(&row.coefficients) {
        *entry -= factor * other;
    }
    from.right -= factor * &row.right;
}

/// The rule with these nodes, and whether it belongs to a known family.
pub(super) fn rule(polynomial: &Polynomial) -> Result<(QuadratureRule, bool), String> {
    let stages = polynomial.degree().unwrap_or(0);
    let limits = Limits::default();
    for family in FAMILIES {
        let named = QuadratureRule::parse(&format!("{}({stages})", family.name), &limits);
        if let Ok(rule) = named
            && rule.algebra().modulus().primitive() == polynomial.primitive()
        {
            return Ok((rule, true));
        }
    }
    let name = format!("the roots of {}", polynomial.display("x"));
    let rule = QuadratureRule::with_nodes(name, polynomial).map_err(|kind| kind.to_string())?;
    Ok((rule, false))
}

/// Whether the numbers are exactly symmetric, that is, equal to their mirror images.
pub(super) fn symmetric(values: &[BigRational]) -> bool {
    let mut sorted = values.to_vec();
    sorted.sort_unstable();
    let pairs = sorted.iter().zip(sorted.iter().rev());
    let mut sums = pairs.map(|(x, y)| x + y);
    sums.all(|sum| sum.is_one())
}

/// The distance from a polynomial collocation method: the largest `|Σ_j a_ij c_j^k − c_i^{k+1}/(k + 1)|`.
pub(super) fn off_collocation(
    stages: usize,
    a: impl Fn(usize, usize) -> BigRational,
    c: impl Fn(usize) -> BigRational,
) -> BigRational {
    let mut largest = BigRational::zero();
    for i in 0..stages {
        for k in 0..stages {
            let power = |x: BigRational, n: usize| num_traits::pow(x, n);
            let sum =
                (0..stages).fold(BigRational::zero(), |sum, j| sum + a(i, j) * power(c(j), k));
            let n = i64::try_from(k + 1).unwrap_or(i64::MAX);
            let wanted = power(c(i), k + 1) * ratio(1, n);
            largest = largest.max((sum - wanted).abs());
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(
        printed: &[i64],
        exact: &[i64],
        symmetric: bool,
        order: usize,
    ) -> Option<(Polynomial, usize)> {
        let printed: Vec<BigRational> = printed.iter().map(|&x| ratio(x, 1000)).collect();
        let start = coefficients(&printed);
        let family = Family::of(&Nodes {
            printed,
            exact: exact.iter().map(|&x| ratio(x, 1)).collect(),
            symmetric,
            order,
        })?;
        Some((family.polynomial(&start), family.free().len()))
    }

    #[test]
    fn polynomials_of_the_families_are_found() {
        for (printed, exact, order, name) in [
            (&[113, 500, 887][..], &[][..], 6, "gauss(3)"),
            (&[0, 500, 1000], &[0, 1], 4, "lobatto(3)"),
            (&[155, 645, 1000], &[1], 5, "radau-right(3)"),
            (&[0, 355, 845], &[0], 5, "radau-left(3)"),
        ] {
            let (polynomial, free) = found(printed, exact, false, order).expect(name);
            assert_eq!(free, 0, "{name}");
            let (rule, named) = rule(&polynomial).expect(name);
            assert!(named && rule.name() == name, "{}", rule.name());
        }
        // One order higher is a contradiction.
        assert!(found(&[0, 500, 1000], &[0, 1], false, 5).is_none());
        assert!(found(&[113, 500, 887], &[], false, 7).is_none());
        // Three symmetric nodes have order 4, and one free parameter.
        let (polynomial, free) = found(&[200, 500, 800], &[], true, 4).expect("free");
        assert_eq!(free, 1);
        let [low, high] = [ratio(1, 5), ratio(4, 5)].map(|x| polynomial.evaluate(&x));
        assert!(low.is_zero() && high.is_zero());
    }
}
