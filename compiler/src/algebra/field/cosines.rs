//! Cosines of rational multiples of π in number fields.

use num_integer::gcd;
use num_rational::BigRational;

use super::{Extension, MAX_DEGREE, Notation, NumberField};
use crate::arithmetic::algebraic_number::AlgebraicNumber;
use crate::arithmetic::elementary;
use crate::arithmetic::interval::Interval;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::rational::ratio;

/// No cosine of `π/n` with a larger `n` has a degree within [`MAX_DEGREE`].
const MAX_ANGLE: u32 = 1000;

impl NumberField {
    /// The field with `cos(π/n)`, and so with the cosines of all multiples of `π/n`.
    ///
    /// For `n` up to 6 and for 12 these are written with the square roots of 2, 3 and 5, for other `n` as
    /// cosines. `None` for `n = 0`, and in the cases of [`NumberField::adjoin`].
    pub fn cosine(&self, n: u32) -> Option<Extension> {
        let quarter = |x: &Polynomial| x.scale(&ratio(1, 4));
        match n {
            0 => None,
            1 => Some(self.containing(Polynomial::from_integers(&[-1]))),
            2 => Some(self.containing(Polynomial::zero())),
            3 => Some(self.containing(Polynomial::constant(ratio(1, 2)))),
            4 | 6 => {
                let mut root = self.square_root(&Polynomial::from_integers(&[i64::from(n) / 2]))?;
                root.number = root.number.scale(&ratio(1, 2));
                Some(root)
            }
            5 => {
                let mut root = self.square_root(&Polynomial::from_integers(&[5]))?;
                root.number = quarter(&(&Polynomial::one() + &root.number));
                Some(root)
            }
            12 => {
                // cos(π/12) = √2 (1 + √3)/4
                let two = self.square_root(&Polynomial::from_integers(&[2]))?;
                let mut three = two.field.square_root(&Polynomial::from_integers(&[3]))?;
                let sum = &Polynomial::one() + &three.number;
                three.number = quarter(&three.field.multiply(&three.embed(&two.number), &sum));
                three.previous = three.embed(&two.previous);
                Some(three)
            }
            _ if n > MAX_ANGLE || totient(2 * n) as usize > 2 * MAX_DEGREE => None,
            _ => {
                let enclose = |bits| {
                    let angle = elementary::pi(bits);
                    let n = Interval::enclosing(&BigRational::from_integer(n.into()), bits);
                    angle.divide(&n).map(|angle| elementary::cos(&angle))
                };
                let nowhere = Interval::enclosing(&ratio(2, 1), 1);
                let number = AlgebraicNumber::identify(&cosine_polynomial(n), &|bits| {
                    enclose(bits).unwrap_or_else(|| nowhere.clone())
                })?;
                self.adjoin(&number, Notation::Cosines(n))
            }
        }
    }

    /// `cos(kφ)` from `cos φ`.
    pub fn cosine_of_multiple(&self, cosine: &Polynomial, k: u32) -> Polynomial {
        // The cosines of mφ and (m + 1)φ, where m grows to k digit by digit:
        // cos((a + b)φ) = 2 cos(aφ) cos(bφ) − cos((a − b)φ).
        let (mut low, mut high) = (Polynomial::one(), cosine.clone());
        let sum = |a: &Polynomial, b: &Polynomial, difference: &Polynomial| {
            let product = self.multiply(a, b);
            &(&product + &product) - difference
        };
        for digit in (0..32 - k.leading_zeros()).rev() {
            let odd = sum(&low, &high, cosine);
            if k >> digit & 1 == 1 {
                high = sum(&high, &high, &Polynomial::one());
                low = odd;
            } else {
                low = sum(&low, &low, &Polynomial::one());
                high = odd;
            }
        }
        low
    }
}

/// Euler's function: the number of integers up to `n` that are coprime to it.
fn totient(n: u32) -> u32 {
    (1..=n).filter(|k| gcd(*k, n) == 1).count() as u32
}

/// The irreducible polynomial of `cos(π/n)`, up to a factor, for `n > 1`.
fn cosine_polynomial(n: u32) -> Polynomial {
    // The cyclotomic polynomial is a palindrome: z^(−h) Φ(z) = c_h + Σ_k c_(h+k) (zᵏ + z⁻ᵏ), and zᵏ + z⁻ᵏ
    // is 2 cos(kφ) = 2 T_k(cos φ) at z = exp(iφ).
    let cyclotomic = cyclotomic(2 * n as usize);
    let half = cyclotomic.degree().unwrap_or(0) / 2;
    let twice = Polynomial::from_integers(&[0, 2]);
    let (mut before, mut chebyshev) = (Polynomial::variable(), Polynomial::one());
    let mut sum = Polynomial::constant(cyclotomic.coefficient(half));
    for k in 1..=half {
        let next = &(&twice * &chebyshev) - &before;
        (before, chebyshev) = (chebyshev, next);
        let factor = cyclotomic.coefficient(half + k) * ratio(2, 1);
        sum = &sum + &chebyshev.scale(&factor);
    }
    sum
}

/// The cyclotomic polynomial `Φ_n`.
fn cyclotomic(n: usize) -> Polynomial {
    let mut polynomial = Polynomial::from_integers(&[-1, 1]);
    let mut rest = n;
    let mut radical = 1;
    for prime in 2..=n {
        if rest.is_multiple_of(prime) {
            while rest.is_multiple_of(prime) {
                rest /= prime;
            }
            radical *= prime;
            // Φ_(mp)(x) = Φ_m(xᵖ)/Φ_m(x)
            let spread = polynomial.compose(&Polynomial::monomial(prime));
            if let Some((quotient, _)) = spread.div_rem(&polynomial) {
                polynomial = quotient;
            }
        }
    }
    polynomial.compose(&Polynomial::monomial(n / radical))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rounding::to_f64;

    #[test]
    fn cosines_have_their_values() {
        let q = NumberField::rationals();
        for n in 1..=40 {
            let Some(Extension { field, number, .. }) = q.cosine(n) else {
                assert!(totient(2 * n) > 64, "{n}");
                continue;
            };
            let degree = if n == 1 {
                1
            } else {
                (totient(2 * n) / 2).max(1) as usize
            };
            assert_eq!(field.degree(), degree, "{n}");
            for k in 0..=2 * n {
                let value = to_f64(
                    &field
                        .enclose(&field.cosine_of_multiple(&number, k), 60)
                        .low(),
                );
                let expected = (f64::from(k) * std::f64::consts::PI / f64::from(n)).cos();
                assert!((value - expected).abs() < 1e-14, "cos({k} pi/{n})");
            }
        }
        assert_eq!(q.cosine(0), None);
        assert_eq!(q.cosine(997), None);
    }

    #[test]
    fn cosines_are_written_in_the_usual_way() {
        let shown = |n, k| {
            let Extension { field, number, .. } =
                NumberField::rationals().cosine(n).expect("small");
            field.display(&field.cosine_of_multiple(&number, k))
        };
        assert_eq!(shown(4, 1), "sqrt(2)/2");
        assert_eq!(shown(6, 5), "-sqrt(3)/2");
        assert_eq!(shown(5, 1), "1/4 + sqrt(5)/4");
        assert_eq!(shown(12, 1), "sqrt(2)/4 + sqrt(2)*sqrt(3)/4");
        assert_eq!(shown(12, 2), "sqrt(3)/2");
        assert_eq!(shown(8, 3), "cos(3*pi/8)");
        assert_eq!(shown(9, 4), "cos(pi/9) - cos(2*pi/9)");
        assert_eq!(shown(7, 3), "1/2 - cos(pi/7) + cos(2*pi/7)");
    }

    #[test]
    fn the_same_cosine_from_two_angles_is_the_same() {
        let q = NumberField::rationals();
        let eighth = q.cosine(8).expect("small");
        let quarter = eighth.field.cosine(4).expect("small");
        assert_eq!(quarter.field, eighth.field);
        assert_eq!(
            quarter.number,
            eighth.field.cosine_of_multiple(&eighth.number, 2)
        );
        // In the other order.
        let quarter = q.cosine(4).expect("small");
        let eighth = quarter.field.cosine(8).expect("small");
        assert_eq!(eighth.field.degree(), 4);
        let double = eighth.field.cosine_of_multiple(&eighth.number, 2);
        assert_eq!(double, eighth.embed(&quarter.number));
        // Over another field, two steps at once.
        let seventh = q.cosine(7).expect("small");
        let twelfth = seventh.field.cosine(12).expect("small");
        assert_eq!(twelfth.field.degree(), 12);
        let embedded = twelfth.embed(&seventh.number);
        assert_eq!(twelfth.field.display(&embedded), "cos(pi/7)");
        assert_eq!(
            twelfth.field.minimal_polynomial(&embedded),
            seventh.field.modulus().clone()
        );
    }
}
