//! Larger number fields: a field extended by a real algebraic number.

use num_bigint::BigInt;
use num_integer::binomial;
use num_rational::BigRational;
use num_traits::{One, Zero};

use super::notation::Generator;
use super::number_field::trace;
use super::{MAX_DEGREE, Notation, NumberField};
use crate::arithmetic::algebraic_number::AlgebraicNumber;
use crate::arithmetic::factor::is_surely_squarefree;
use crate::arithmetic::interval::Interval;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::power_sums::{from_power_sums, interpolate_traces, power_sums};

/// The largest degree of the product of a field and the equation of a new number.
const MAX_PRODUCT_DEGREE: usize = 160;

/// A field that contains another field and an additional number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Extension {
    /// The extended field; the original field if that contains the number.
    pub field: NumberField,
    /// The additional number.
    pub number: Polynomial,
    /// The image of `θ` of the original field.
    pub(super) previous: Polynomial,
}

impl Extension {
    /// An element of the original field, as an element of this one.
    pub fn embed(&self, element: &Polynomial) -> Polynomial {
        if let Some(constant) = element.as_constant() {
            return Polynomial::constant(constant);
        }
        if self.previous == Polynomial::variable() {
            return element.clone();
        }
        let coefficients = element.coefficients().into_iter().rev();
        coefficients.fold(Polynomial::zero(), |value, c| {
            &self.field.multiply(&value, &self.previous) + &Polynomial::constant(c)
        })
    }
}

impl NumberField {
    /// The field itself as an extension by one of its elements.
    pub(super) fn containing(&self, number: Polynomial) -> Extension {
        Extension {
            field: self.clone(),
            number,
            previous: self.reduce(&Polynomial::variable()),
        }
    }

    /// The smallest field that contains this one and a number.
    ///
    /// `None` if its degree exceeds [`MAX_DEGREE`], if the product of the degrees of this field and
    /// the number exceeds 160, or if factoring gives up
    /// ([`irreducible_factors`](crate::arithmetic::factor::irreducible_factors)).
    pub fn adjoin(&self, number: &AlgebraicNumber, notation: Notation) -> Option<Extension> {
        if let Some(value) = number.root().rational() {
            return Some(self.containing(Polynomial::constant(value.clone())));
        }
        if self.degree() == 1 {
            if number.degree() > MAX_DEGREE {
                return None;
            }
            let generator = Generator {
                notation,
                value: Polynomial::variable(),
                degree: number.degree(),
            };
            return Some(Extension {
                field: NumberField::new(number.clone(), vec![generator]),
                number: Polynomial::variable(),
                previous: Polynomial::zero(),
            });
        }
        let leading = number.polynomial().leading();
        let monic = number.polynomial().scale(&leading.recip());
        let monic = monic.coefficients().into_iter().map(Polynomial::constant);
        self.adjoin_root(
            &monic.collect::<Vec<_>>(),
            &|bits| number.enclose(bits),
            notation,
        )
    }

    /// The smallest field that contains this field and a real root `β` of a monic squarefree polynomial over
    /// it. The lowest degree comes first; enclosures of `β` shrink as the places grow.
    ///
    /// In `A = Q(θ)[y]/(q)`, whose dimension is the number of its embeddings `(θ_i, β_ij)`, `u = θ + k y` takes
    /// a different value in each, for some small `k`. The sums of its powers over all embeddings give the
    /// characteristic polynomial `R` of `u`. The irreducible factor of `R` that vanishes at the real number
    /// `θ + k β` defines `Q(θ, β) = Q(u)`. There `θ = g(u)/R'(u)`, where `g` interpolates the traces `Tr(θ uᵏ)`
    /// (the rational univariate representation; Rouillier 1999).
    pub(super) fn adjoin_root(
        &self,
        monic: &[Polynomial],
        enclose: &dyn Fn(u32) -> Interval,
        notation: Notation,
    ) -> Option<Extension> {
        let degree = monic.len().checked_sub(1)? * self.degree();
        if degree > MAX_PRODUCT_DEGREE {
            return None;
        }
        if self.degree() == 1 {
            let constants: Vec<BigRational> = monic.iter().map(|c| c.coefficient(0)).collect();
            let number =
                AlgebraicNumber::identify(&Polynomial::from_rationals(&constants), enclose)?;
            return self.adjoin(&number, notation);
        }
        let table = self.trace_table(monic, degree);
        // Each pair of embeddings excludes at most one k.
        let multipliers = (1..=(degree * degree) as i64).flat_map(|k| [k, -k]);
        let (k, characteristic) = multipliers
            .map(|k| {
                let sums: Vec<BigRational> = (0..=degree)
                    .map(|j| sum_of_power(&table, k, 0, j))
                    .collect();
                (k, from_power_sums(&sums, degree))
            })
            .find(|(_, polynomial)| is_surely_squarefree(polynomial))?;
        let primitive = AlgebraicNumber::identify(&characteristic, &|bits| {
            let theta = self.primitive_element().enclose(bits);
            let multiple = Interval::enclosing(&integer(k), bits).multiply(&enclose(bits));
            theta.add(&multiple)
        })?;
        if primitive.degree() > MAX_DEGREE {
            return None;
        }
        let mut field = NumberField::new(primitive, Vec::new());
        let traces: Vec<BigRational> = (0..degree).map(|j| sum_of_power(&table, k, 1, j)).collect();
        let numerator = field.reduce(&interpolate_traces(&characteristic, &traces));
        let denominator = field.inverse(&field.reduce(&characteristic.derivative()))?;
        let previous = field.multiply(&numerator, &denominator);
        let number = (&Polynomial::variable() - &previous).scale(&integer(k).recip());
        if field.degree() == self.degree() {
            let number = self.express(&field, &previous, &number)?;
            return Some(self.containing(number));
        }
        let mut extension = Extension {
            field: field.clone(),
            number,
            previous,
        };
        let mut generators: Vec<Generator> = self
            .generators_with_notation()
            .iter()
            .map(|generator| Generator {
                value: extension.embed(&generator.value),
                ..generator.clone()
            })
            .collect();
        generators.push(Generator {
            notation,
            value: extension.number.clone(),
            degree: field.degree() / self.degree(),
        });
        field = NumberField::new(field.primitive_element().clone(), generators);
        extension.field = field;
        Some(extension)
    }

    /// The traces `Tr(θⁱ yˡ)` over all embeddings of `Q(θ)[y]/(q)`, for `i + l ≤ degree`.
    fn trace_table(&self, monic: &[Polynomial], degree: usize) -> Vec<Vec<BigRational>> {
        let size = monic.len() - 1;
        // Newton's identities over Q(θ).
        let mut relative = vec![Polynomial::constant(integer(size as i64))];
        for k in 1..=degree {
            let mut sum = Polynomial::zero();
            for j in 1..k.min(size + 1) {
                let (c, s) = (&monic[size - j], &relative[k - j]);
                if !c.is_zero() && !s.is_zero() {
                    sum = &sum + &self.multiply(c, s);
                }
            }
            if k <= size {
                sum = &sum + &monic[size - k].scale(&integer(k as i64));
            }
            relative.push(-&sum);
        }
        let sums = power_sums(self.modulus(), degree + self.degree() + 1);
        (0..=degree)
            .map(|i| {
                let shifted = &sums[i..];
                relative[..=degree - i]
                    .iter()
                    .map(|s| trace(s, shifted))
                    .collect()
            })
            .collect()
    }

    /// An element of an isomorphic field, as an element of this one; `image` is `θ` there.
    fn express(
        &self,
        other: &NumberField,
        image: &Polynomial,
        element: &Polynomial,
    ) -> Option<Polynomial> {
        let sums = power_sums(other.modulus(), other.degree());
        let mut product = element.clone();
        let mut traces = Vec::new();
        for _ in 0..self.degree() {
            traces.push(trace(&product, &sums));
            product = other.multiply(&product, image);
        }
        let monic = self.modulus().scale(&self.modulus().leading().recip());
        let numerator = interpolate_traces(&monic, &traces);
        let denominator = self.inverse(&monic.derivative())?;
        Some(self.multiply(&numerator, &denominator))
    }
}

fn integer(value: i64) -> BigRational {
    BigRational::from_integer(value.into())
}

/// `Tr(θˢ (θ + k y)ʲ)` from the traces of the monomials.
fn sum_of_power(table: &[Vec<BigRational>], k: i64, s: usize, j: usize) -> BigRational {
    let mut power = BigInt::one();
    let mut sum = BigRational::zero();
    for l in 0..=j {
        let trace = &table[s + j - l][l];
        if !trace.is_zero() {
            sum += trace * (binomial(BigInt::from(j), BigInt::from(l)) * &power);
        }
        power *= k;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;

    fn root(coefficients: &[i64], index: usize) -> AlgebraicNumber {
        AlgebraicNumber::real_root(&Polynomial::from_integers(coefficients), index).expect("a root")
    }

    fn named(name: &str) -> Notation {
        Notation::Powers(name.to_owned())
    }

    #[test]
    fn numbers_satisfy_their_equations_in_the_compositum() {
        // √2, the real root of t³ − t − 1, a root of 5t² − 5t + 1.
        let steps = [
            (root(&[-2, 0, 1], 2), "sqrt(2)"),
            (root(&[-1, -1, 0, 1], 1), "root(t^3 - t - 1, 1)"),
            (root(&[1, -5, 5], 1), "root(5*t^2 - 5*t + 1, 1)"),
        ];
        let mut field = NumberField::rationals();
        let mut numbers: Vec<Polynomial> = Vec::new();
        for (number, name) in &steps {
            let extension = field.adjoin(number, named(name)).expect("small");
            numbers = numbers.iter().map(|x| extension.embed(x)).collect();
            numbers.push(extension.number.clone());
            field = extension.field;
        }
        assert_eq!(field.degree(), 12);
        for ((number, name), element) in steps.iter().zip(&numbers) {
            assert_eq!(&field.minimal_polynomial(element), number.polynomial());
            let distance = field.enclose(element, 100).subtract(&number.enclose(101));
            assert!(distance.contains(&ratio(0, 1)));
            assert_eq!(&field.display(element), name);
        }
        let listed: Vec<_> = field.generators().map(|(_, value)| value.clone()).collect();
        assert_eq!(listed, numbers);
    }

    #[test]
    fn a_number_of_the_field_does_not_make_it_grow() {
        let q = NumberField::rationals();
        let k = q
            .adjoin(&root(&[-2, 0, 1], 2), named("sqrt(2)"))
            .expect("small")
            .field;
        let k = k
            .adjoin(&root(&[-3, 0, 1], 2), named("sqrt(3)"))
            .expect("small")
            .field;
        let same = k
            .adjoin(&root(&[-6, 0, 1], 1), named("sqrt(6)"))
            .expect("small");
        assert_eq!(same.field, k);
        assert_eq!(k.display(&same.number), "-sqrt(2)*sqrt(3)");
        assert_eq!(same.embed(&same.number), same.number);
        // (√3 − √2)/2 has the degree of the whole field.
        let half = k
            .adjoin(&root(&[1, 0, -40, 0, 16], 3), named("x"))
            .expect("small");
        assert_eq!(k.display(&half.number), "-sqrt(2)/2 + sqrt(3)/2");
        let rational = k.adjoin(&AlgebraicNumber::rational(ratio(3, 4)), named("x"));
        assert_eq!(
            rational.expect("small").number,
            Polynomial::constant(ratio(3, 4))
        );
    }

    #[test]
    fn fields_of_too_high_a_degree_are_refused() {
        let q = NumberField::rationals();
        let large = root(&[vec![-2], vec![0; 32], vec![1]].concat(), 1);
        assert_eq!(q.adjoin(&large, named("x")), None);
        let k = q
            .adjoin(&root(&[-2, 0, 0, 0, 0, 0, 0, 1], 1), named("a"))
            .expect("small")
            .field;
        assert_eq!(k.adjoin(&root(&[-3, 0, 0, 0, 0, 1], 1), named("b")), None);
    }
}
