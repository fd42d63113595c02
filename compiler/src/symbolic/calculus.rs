//! Derivatives, integrals and values of functions.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

use super::operations::at_pi;
use super::size::check_bits;
use super::{Constant, Frequency, Function, Term, Wave};
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::rational::length;
use crate::error::ErrorKind;

impl Function {
    /// The derivative.
    ///
    /// # Errors
    /// [`ErrorKind::FunctionClass`] for tangents; also those of [`Function`].
    pub fn derivative(&self) -> Result<Function, ErrorKind> {
        let mut derivative = Function::zero();
        for (term, coefficient) in self.terms() {
            match term {
                Term::Product {
                    growth,
                    wave,
                    power,
                } => {
                    let product = |wave: Wave, power: u32| Term::Product {
                        growth: growth.clone(),
                        wave,
                        power,
                    };
                    if *power > 0 {
                        let factor = BigRational::from_integer((*power).into());
                        let term = product(wave.clone(), power - 1);
                        derivative.insert(term, &coefficient.scale(&factor)?)?;
                    }
                    if !growth.is_zero() {
                        let factor = growth.to_constant()?;
                        let term = product(wave.clone(), *power);
                        derivative.insert(term, &coefficient.multiply(&factor)?)?;
                    }
                    let (slope, other) = match wave {
                        Wave::None => continue,
                        Wave::Cos(frequency) => (frequency.negate(), Wave::Sin(frequency.clone())),
                        Wave::Sin(frequency) => (frequency.clone(), Wave::Cos(frequency.clone())),
                    };
                    let factor = coefficient.multiply(&slope.to_constant()?)?;
                    derivative.insert(product(other, *power), &factor)?;
                }
                Term::LnCos(frequency) => {
                    let slope = frequency.negate().to_constant()?;
                    let term = Term::Tan(frequency.clone());
                    derivative.insert(term, &coefficient.multiply(&slope)?)?;
                }
                Term::Tan(_) => {
                    return Err(ErrorKind::FunctionClass {
                        found: format!("the derivative of {term}"),
                        reason: "it is a square of a tangent",
                    });
                }
            }
        }
        Ok(derivative)
    }

    /// The antiderivative that vanishes at 0.
    ///
    /// # Errors
    /// [`ErrorKind::FunctionClass`] for `ln(cos(ω·t))`, whose integral is not elementary; also those of [`Function`].
    pub fn antiderivative(&self) -> Result<Function, ErrorKind> {
        let mut integral = Function::zero();
        for (term, coefficient) in self.terms() {
            match term {
                Term::Product { power, .. } if term.is_power() => {
                    let factor = BigRational::new(BigInt::one(), (power + 1).into());
                    integral.insert(Term::power(power + 1), &coefficient.scale(&factor)?)?;
                }
                Term::Product {
                    growth,
                    wave,
                    power,
                } => integrate(&mut integral, coefficient, growth, wave, *power)?,
                Term::Tan(frequency) => {
                    let slope = frequency.negate().to_constant()?;
                    let term = Term::LnCos(frequency.clone());
                    integral.insert(term, &coefficient.divide(&slope)?)?;
                }
                Term::LnCos(_) => {
                    return Err(ErrorKind::FunctionClass {
                        found: format!("the integral of {term}"),
                        reason: "it is not an elementary function",
                    });
                }
            }
        }
        let start = integral.evaluate(&Constant::zero())?;
        integral.subtract(&Function::constant(start))
    }

    /// The value at `t`.
    ///
    /// # Errors
    /// Those of [`Function`].
    pub fn evaluate(&self, t: &Constant) -> Result<Constant, ErrorKind> {
        if let (Some(polynomial), Some(t)) = (self.as_polynomial(), t.as_rational()) {
            let degree = polynomial.degree().unwrap_or(0);
            let bits = length(t) as usize;
            check_bits(degree.saturating_mul(bits), t.is_integer())?;
            return Constant::rational(polynomial.evaluate(t));
        }
        let mut sum = Constant::zero();
        for (term, coefficient) in self.terms() {
            let at = |frequency: &Frequency| frequency.to_constant()?.multiply(t);
            let value = match term {
                Term::Product {
                    growth,
                    wave,
                    power,
                } => {
                    // The degree is bounded by `MAX_DEGREE`.
                    let value = t.power(*power as i32)?.multiply(&at(growth)?.exp()?)?;
                    match wave {
                        Wave::None => value,
                        Wave::Cos(frequency) => value.multiply(&at(frequency)?.cos()?)?,
                        Wave::Sin(frequency) => value.multiply(&at(frequency)?.sin()?)?,
                    }
                }
                Term::Tan(frequency) => at(frequency)?.tan()?,
                Term::LnCos(frequency) => at(frequency)?.cos()?.ln()?,
            };
            sum = sum.add(&coefficient.multiply(&value)?)?;
        }
        Ok(sum)
    }
}

/// Adds the integral of `coefficient·tᵏ·e^(α·t)·wave`, where `α ≠ 0` or the wave is not `None`.
///
/// With `z = α + iβ`, `∫ tᵏ·e^(zt) = e^(zt)·Σⱼ (−1)ʲ·k!/(k−j)!·t^(k−j)/z^(j+1)`; the real part is the integral with the
/// cosine, the imaginary part that with the sine.
fn integrate(
    integral: &mut Function,
    coefficient: &Constant,
    growth: &Frequency,
    wave: &Wave,
    power: u32,
) -> Result<(), ErrorKind> {
    let mut factor = BigRational::one();
    let mut inverse = InversePowers::new(growth, wave)?;
    for j in 0..=power {
        let (real, imaginary) = inverse.next()?;
        let scaled = coefficient.scale(&factor)?;
        let mut insert = |wave: Wave, part: &Constant| {
            let term = Term::Product {
                growth: growth.clone(),
                wave,
                power: power - j,
            };
            integral.insert(term, &scaled.multiply(part)?)
        };
        match wave {
            Wave::None => insert(Wave::None, &real)?,
            Wave::Cos(frequency) => {
                insert(wave.clone(), &real)?;
                insert(Wave::Sin(frequency.clone()), &imaginary.negate()?)?;
            }
            Wave::Sin(frequency) => {
                insert(wave.clone(), &real)?;
                insert(Wave::Cos(frequency.clone()), &imaginary)?;
            }
        }
        factor *= -BigRational::from_integer((power - j).into());
    }
    Ok(())
}

/// The powers `z⁻¹, z⁻², …` of `z = α + iβ ≠ 0`.
///
/// The numerators and the norm `α² + β²` are polynomials in π, so that they stay expanded and short.
struct InversePowers {
    conjugate: (Polynomial, Polynomial),
    /// `(α − iβ)ᵐ`
    numerator: (Polynomial, Polynomial),
    kind: Kind,
    exponent: i32,
}

/// Whether z is real, purely imaginary or general; the former two have simpler inverses.
enum Kind {
    Real(Constant),
    Imaginary(Constant),
    /// The norm `α² + β²`.
    Complex(Constant),
}

impl InversePowers {
    fn new(growth: &Frequency, wave: &Wave) -> Result<Self, ErrorKind> {
        let (a, b) = match wave {
            Wave::None => (growth.to_polynomial(), Polynomial::zero()),
            Wave::Cos(frequency) | Wave::Sin(frequency) => {
                (growth.to_polynomial(), frequency.to_polynomial())
            }
        };
        let kind = if b.is_zero() {
            Kind::Real(at_pi(&a)?)
        } else if a.is_zero() {
            Kind::Imaginary(at_pi(&b)?)
        } else {
            Kind::Complex(at_pi(&(&(&a * &a) + &(&b * &b)))?)
        };
        Ok(InversePowers {
            conjugate: (a, -&b),
            numerator: (Polynomial::one(), Polynomial::zero()),
            kind,
            exponent: 0,
        })
    }

    /// Real and imaginary part of the next power.
    fn next(&mut self) -> Result<(Constant, Constant), ErrorKind> {
        self.exponent += 1;
        match &self.kind {
            Kind::Real(a) => Ok((a.power(-self.exponent)?, Constant::zero())),
            Kind::Imaginary(b) => {
                // i⁻¹ = −i
                let size = b.power(-self.exponent)?;
                Ok(match self.exponent % 4 {
                    0 => (size, Constant::zero()),
                    1 => (Constant::zero(), size.negate()?),
                    2 => (size.negate()?, Constant::zero()),
                    _ => (Constant::zero(), size),
                })
            }
            Kind::Complex(norm) => {
                let (p, q) = &self.numerator;
                let (a, b) = &self.conjugate;
                self.numerator = (&(p * a) - &(q * b), &(p * b) + &(q * a));
                let scale = norm.power(-self.exponent)?;
                Ok((
                    at_pi(&self.numerator.0)?.multiply(&scale)?,
                    at_pi(&self.numerator.1)?.multiply(&scale)?,
                ))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;
    use crate::symbolic::constant::tests::{constant, value};
    use crate::symbolic::function::tests::{function, texts};
    use num_traits::Zero;
    use proptest::prelude::*;

    /// Whether all coefficients are zero to 200 binary places.
    fn vanishes(function: &Function) -> bool {
        function.terms().all(|(_, coefficient)| {
            let interval = coefficient.enclose(200).expect("can be enclosed");
            interval.contains(&BigRational::zero())
        })
    }

    #[test]
    fn integrals_have_their_known_closed_forms() {
        let cases = [
            ("1", "t"),
            ("t^2 - t/3", "t^3/3 - t^2/6"),
            ("cos(pi*t)", "sin(pi*t)/pi"),
            ("sin(t)", "1 - cos(t)"),
            ("exp(t)", "exp(t) - 1"),
            ("t*exp(-t)", "1 - (t + 1)*exp(-t)"),
            ("t^2*exp(-t/2)", "16 - (2*t^2 + 8*t + 16)*exp(-t/2)"),
            ("t*cos(pi*t)", "t*sin(pi*t)/pi + cos(pi*t)/pi^2 - 1/pi^2"),
            ("exp(t)*cos(t)", "exp(t)*(cos(t) + sin(t))/2 - 1/2"),
            (
                "exp(pi*t)*sin(pi*t)",
                "exp(pi*t)*(sin(pi*t) - cos(pi*t))/(2*pi) + 1/(2*pi)",
            ),
            (
                "exp(t)*sin(pi*t)",
                "(exp(t)*(sin(pi*t) - pi*cos(pi*t)) + pi)/(1 + pi^2)",
            ),
            ("2*tan(pi*t/3)", "-6/pi*ln(cos(pi*t/3))"),
        ];
        for (text, expected) in cases {
            let integral = function(text).antiderivative().expect(text);
            assert!(
                vanishes(&integral.subtract(&function(expected)).expect(text)),
                "{text}: {integral}"
            );
        }
        assert_eq!(
            function("cos(pi*t)").antiderivative(),
            Ok(function("sin(pi*t)/pi"))
        );
        assert_eq!(function("ln(cos(t))").derivative(), Ok(function("-tan(t)")));
        assert!(matches!(
            function("ln(cos(t))").antiderivative(),
            Err(ErrorKind::FunctionClass { .. })
        ));
        assert!(matches!(
            function("tan(t)").derivative(),
            Err(ErrorKind::FunctionClass { .. })
        ));
    }

    #[test]
    fn values_at_rational_nodes_are_folded() {
        let at = |text: &str, n: i64, d: i64| {
            function(text)
                .evaluate(&Constant::rational(ratio(n, d)).expect("small"))
                .expect(text)
        };
        assert_eq!(at("cos(pi*t)", 1, 3), constant("1/2"));
        assert_eq!(at("t^2 + sin(pi*t)", 1, 2), constant("5/4"));
        assert_eq!(at("exp(2*t)", 1, 2), constant("e"));
        assert_eq!(at("tan(pi*t/4)", 1, 1), constant("1"));
        assert_eq!(at("ln(cos(pi*t/3))", 1, 1), constant("ln(1/2)"));
        assert_eq!(at("t*cos(t)", 0, 1), constant("0"));
        assert_eq!(
            function("t^2 + 1").evaluate(&constant("sqrt(2)")),
            Ok(constant("3"))
        );
    }

    #[test]
    fn long_integrals_end() {
        for text in [
            "t^100*exp(t)*sin(pi*t)",
            "t^256*exp(-t)",
            "t^200*cos((1 + pi)*t)",
            "t^250*exp(pi*t/3 - t)*cos((1/7 + pi)*t)",
        ] {
            match function(text).antiderivative() {
                Ok(integral) => assert!(
                    vanishes(
                        &integral
                            .derivative()
                            .expect(text)
                            .subtract(&function(text))
                            .expect(text)
                    ),
                    "{text}"
                ),
                Err(kind) => assert!(matches!(kind, ErrorKind::ExpressionSize { .. }), "{text}"),
            }
        }
    }

    proptest! {
        #[test]
        fn antiderivatives_differentiate_back(text in texts()) {
            let f = function(&text);
            let integral = f.antiderivative().expect("elementary");
            prop_assert!(vanishes(&integral.derivative().expect("elementary").subtract(&f).expect("small")));
            prop_assert!(integral.evaluate(&Constant::zero()).expect("small").enclose(200).expect("small").contains(&BigRational::zero()));
        }

        #[test]
        fn integrals_agree_with_quadrature(text in texts(), n in 1i64..8) {
            let f = function(&text);
            let end = Constant::rational(ratio(n, 7)).expect("small");
            let exact = value(&f.antiderivative().expect("elementary").evaluate(&end).expect("small"));
            // Simpson's rule on 16 intervals: an error of order (h·frequency)⁴.
            let steps = 32;
            let sum: f64 = (0..=steps).map(|k| {
                let node = Constant::rational(ratio(n * k, 7 * steps)).expect("small");
                let weight = if k == 0 || k == steps { 1.0 } else if k % 2 == 1 { 4.0 } else { 2.0 };
                weight * value(&f.evaluate(&node).expect("small"))
            }).sum();
            let h = n as f64 / (7.0 * steps as f64);
            prop_assert!((sum * h / 3.0 - exact).abs() <= 2e-2 * (1.0 + exact.abs()), "{}: {} {}", text, sum * h / 3.0, exact);
        }
    }
}
