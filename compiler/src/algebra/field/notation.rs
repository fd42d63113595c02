//! Elements of a number field as text.

use std::fmt::Write;

use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::NumberField;
use crate::arithmetic::linear_solver::LinearSolver;
use crate::arithmetic::polynomial::Polynomial;

/// The notation of a number that generates a field, and thereby a basis over the previous field.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Notation {
    /// Powers of a number with this name, such as `sqrt(2)` or `root(t^3 - t - 1, 1)`.
    Powers(String),
    /// The cosines `cos(k π/n)` of the multiples of an angle `π/n`; the number is `cos(π/n)`.
    Cosines(u32),
}

impl Notation {
    /// The name of the basis element with an index; the element with index 0 is 1.
    fn name(&self, index: usize) -> String {
        match (self, index) {
            (_, 0) => String::new(),
            (Notation::Powers(name), 1) => name.clone(),
            (Notation::Powers(name), _) => format!("{name}^{index}"),
            (Notation::Cosines(n), _) => {
                let n = *n as usize;
                let gcd = index.gcd(&n);
                match index / gcd {
                    1 => format!("cos(pi/{})", n / gcd),
                    k => format!("cos({k}*pi/{})", n / gcd),
                }
            }
        }
    }

    /// The basis elements with the first indices.
    fn values(&self, field: &NumberField, number: &Polynomial, count: usize) -> Vec<Polynomial> {
        let mut values = vec![Polynomial::one(), number.clone()];
        while values.len() < count {
            let [.., before, last] = values.as_slice() else {
                break;
            };
            let product = field.multiply(last, number);
            values.push(match self {
                Notation::Powers(_) => product,
                // cos((k+1)φ) = 2 cos(kφ) cos φ − cos((k−1)φ)
                Notation::Cosines(_) => &(&product + &product) - before,
            });
        }
        values.truncate(count);
        values
    }
}

/// A number by which a field was extended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Generator {
    pub(super) notation: Notation,
    pub(super) value: Polynomial,
    /// The degree over the previous field.
    pub(super) degree: usize,
}

/// The basis in which numbers are written: products of basis elements of the generators.
#[derive(Debug, Clone)]
pub(super) struct Basis {
    names: Vec<String>,
    /// `None` if the basis elements are the powers of `θ`.
    solver: Option<LinearSolver>,
}

impl Basis {
    pub(super) fn new(field: &NumberField, generators: &[Generator]) -> Self {
        let mut elements = vec![(String::new(), Polynomial::one())];
        for generator in generators {
            let values = generator
                .notation
                .values(field, &generator.value, generator.degree);
            let mut products = Vec::new();
            for (index, value) in values.iter().enumerate() {
                let name = generator.notation.name(index);
                for (before, element) in &elements {
                    let join = if before.is_empty() || name.is_empty() {
                        ""
                    } else {
                        "*"
                    };
                    let product = field.multiply(element, value);
                    products.push((format!("{before}{join}{name}"), product));
                }
            }
            elements = products;
        }
        let (names, values): (Vec<_>, Vec<_>) = elements.into_iter().unzip();
        let powers = (0..)
            .zip(&values)
            .all(|(k, v)| *v == Polynomial::monomial(k));
        let solver = if powers {
            None
        } else {
            LinearSolver::new(&values)
        };
        Basis { names, solver }
    }

    /// The coordinates of an element.
    pub(super) fn coordinates(&self, element: &Polynomial) -> Vec<BigRational> {
        if element.degree() <= Some(0) {
            // The first basis element is 1.
            return vec![element.coefficient(0)];
        }
        match &self.solver {
            Some(solver) => solver.solve(element),
            None => element.coefficients(),
        }
    }

    pub(super) fn names(&self) -> &[String] {
        &self.names
    }
}

/// A rational multiple of a product of names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Term {
    pub(super) coefficient: BigRational,
    /// Empty for a rational number.
    pub(super) name: String,
}

/// The sum of the nonzero terms: `1/2 - 5*sqrt(3)/6`.
pub(super) fn sum(terms: &[Term]) -> String {
    let mut text = String::new();
    for Term { coefficient, name } in terms.iter().filter(|t| !t.coefficient.is_zero()) {
        text.push_str(match (text.is_empty(), coefficient.is_negative()) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        });
        let (numerator, denominator) = (coefficient.numer().abs(), coefficient.denom());
        // Writing to a string does not fail.
        let _ = match (name.is_empty(), numerator.is_one()) {
            (true, _) => write!(text, "{numerator}"),
            (false, true) => write!(text, "{name}"),
            (false, false) => write!(text, "{numerator}*{name}"),
        };
        if !denominator.is_one() {
            let _ = write!(text, "/{denominator}");
        }
    }
    if text.is_empty() {
        text.push('0');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;

    #[test]
    fn sums_are_written_like_by_hand() {
        let term = |n, d, name: &str| Term {
            coefficient: ratio(n, d),
            name: name.to_owned(),
        };
        assert_eq!(
            sum(&[term(1, 2, ""), term(-1, 6, "sqrt(3)")]),
            "1/2 - sqrt(3)/6"
        );
        assert_eq!(
            sum(&[term(0, 1, ""), term(-5, 4, "sqrt(2)")]),
            "-5*sqrt(2)/4"
        );
        assert_eq!(sum(&[term(0, 1, "")]), "0");
    }

    #[test]
    fn multiples_of_an_angle_are_in_lowest_terms() {
        let names: Vec<String> = (0..5).map(|k| Notation::Cosines(8).name(k)).collect();
        assert_eq!(
            names,
            ["", "cos(pi/8)", "cos(pi/4)", "cos(3*pi/8)", "cos(pi/2)"]
        );
        assert_eq!(Notation::Powers("cbrt(2)".to_owned()).name(2), "cbrt(2)^2");
    }
}
