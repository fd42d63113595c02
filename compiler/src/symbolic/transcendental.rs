//! Roots, exponentials, logarithms and waves of constants.

use std::cmp::Ordering;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::{Constant, Tree};
use crate::arithmetic::rational::ratio;
use crate::error::ErrorKind;
use crate::expression::shown;

impl Constant {
    /// The square root, in lowest terms `q·√n` for rationals.
    ///
    /// # Errors
    /// [`ErrorKind::Domain`] for negative constants, [`ErrorKind::Undecided`]; also those of [`Constant`].
    pub fn sqrt(&self) -> Result<Constant, ErrorKind> {
        match self.sign() {
            None => return Err(self.undecided()),
            Some(Ordering::Less) => {
                return Err(ErrorKind::Domain {
                    value: shown(&format!("sqrt({self})")),
                    function: "sqrt",
                    needs: "an argument ≥ 0",
                });
            }
            Some(Ordering::Equal) => return Ok(Constant::zero()),
            Some(Ordering::Greater) => {}
        }
        match self.tree() {
            Tree::Rational(value) => {
                let (factor, radicand) = root_of_rational(value, 2);
                radical(factor, radicand, Tree::Sqrt)
            }
            Tree::Exp(x) => x.scale(&ratio(1, 2))?.exp(),
            _ => Constant::build(Tree::Sqrt(self.clone())),
        }
    }

    /// The real cube root, in lowest terms `q·∛n` for rationals.
    ///
    /// # Errors
    /// Those of [`Constant`].
    pub fn cbrt(&self) -> Result<Constant, ErrorKind> {
        match self.tree() {
            Tree::Rational(value) => {
                let (factor, radicand) = root_of_rational(&value.abs(), 3);
                let factor = if value.is_negative() { -factor } else { factor };
                radical(factor, radicand, Tree::Cbrt)
            }
            Tree::Exp(x) => x.scale(&ratio(1, 3))?.exp(),
            _ => match self.sign() {
                Some(Ordering::Equal) => Ok(Constant::zero()),
                // A cube root may be inverted later, so it must be known whether it is zero.
                None => Err(self.undecided()),
                Some(_) => Constant::build(Tree::Cbrt(self.clone())),
            },
        }
    }

    /// The exponential.
    ///
    /// # Errors
    /// Those of [`Constant`].
    pub fn exp(&self) -> Result<Constant, ErrorKind> {
        match self.tree() {
            Tree::Rational(value) if value.is_zero() => Ok(Constant::one()),
            Tree::Ln(x) => Ok(x.clone()),
            _ => Constant::build(Tree::Exp(self.clone())),
        }
    }

    /// The natural logarithm.
    ///
    /// # Errors
    /// [`ErrorKind::Domain`] for constants that are not positive, [`ErrorKind::Undecided`]; also those of [`Constant`].
    pub fn ln(&self) -> Result<Constant, ErrorKind> {
        match self.sign() {
            None => return Err(self.undecided()),
            Some(Ordering::Greater) => {}
            Some(_) => {
                return Err(ErrorKind::Domain {
                    value: shown(&format!("ln({self})")),
                    function: "ln",
                    needs: "an argument > 0",
                });
            }
        }
        match self.tree() {
            Tree::Rational(value) if value.is_one() => Ok(Constant::zero()),
            Tree::Exp(x) => Ok(x.clone()),
            _ => Constant::build(Tree::Ln(self.clone())),
        }
    }

    /// The cosine.
    ///
    /// # Errors
    /// Those of [`Constant`].
    pub fn cos(&self) -> Result<Constant, ErrorKind> {
        self.wave(0)
    }

    /// The sine.
    ///
    /// # Errors
    /// Those of [`Constant`].
    pub fn sin(&self) -> Result<Constant, ErrorKind> {
        self.wave(3)
    }

    /// The tangent.
    ///
    /// # Errors
    /// [`ErrorKind::Domain`] if the cosine is zero, [`ErrorKind::Undecided`]; also those of [`Constant`].
    pub fn tan(&self) -> Result<Constant, ErrorKind> {
        self.sin()?.divide(&self.cos()?).map_err(|kind| match kind {
            ErrorKind::DivisionByZero => ErrorKind::Domain {
                value: shown(&format!("tan({self})")),
                function: "tan",
                needs: "an argument whose cosine is not zero",
            },
            kind => kind,
        })
    }

    /// The hyperbolic cosine `(eˣ + e⁻ˣ)/2`.
    ///
    /// # Errors
    /// Those of [`Constant`].
    pub fn cosh(&self) -> Result<Constant, ErrorKind> {
        let sum = self.exp()?.add(&self.negate()?.exp()?)?;
        sum.scale(&ratio(1, 2))
    }

    /// The hyperbolic sine `(eˣ − e⁻ˣ)/2`.
    ///
    /// # Errors
    /// Those of [`Constant`].
    pub fn sinh(&self) -> Result<Constant, ErrorKind> {
        let difference = self.exp()?.subtract(&self.negate()?.exp()?)?;
        difference.scale(&ratio(1, 2))
    }

    /// `cos(x + quarters·π/2)`, reduced by the symmetries of the cosine.
    fn wave(&self, quarters: u32) -> Result<Constant, ErrorKind> {
        // x = rest + turn·π, where the rest contains no rational multiple of π.
        let (rational, terms) = self.summands();
        let turn = terms
            .iter()
            .find(|(x, _)| *x.tree() == Tree::Pi)
            .map_or_else(BigRational::zero, |(_, q)| q.clone());
        let rest = self.subtract(&Constant::pi().scale(&turn)?)?;
        let mut turn = turn + BigRational::new(quarters.into(), 2.into());
        let leading = terms.iter().find(|(x, _)| *x.tree() != Tree::Pi);
        if rest.is_trivially_zero() {
            return cos_of_pi(&turn);
        }
        // The cosine is even: make the first coefficient of the rest positive.
        let negative = leading.map_or(rational.is_negative(), |(_, q)| q.is_negative());
        let rest = if negative {
            turn = -turn;
            rest.negate()?
        } else {
            rest
        };
        // cos(x + n·π/2), with a remaining |turn| ≤ 1/4 in x.
        let steps = (&turn * ratio(2, 1) - ratio(1, 2)).ceil();
        let turn = turn - &steps * ratio(1, 2);
        let argument = rest.add(&Constant::pi().scale(&turn)?)?;
        let phase = steps.to_integer().mod_floor(&BigInt::from(4));
        match phase.to_u32() {
            Some(0) => Constant::build(Tree::Cos(argument)),
            Some(1) => Constant::build(Tree::Sin(argument))?.negate(),
            Some(2) => Constant::build(Tree::Cos(argument))?.negate(),
            _ => Constant::build(Tree::Sin(argument)),
        }
    }
}

/// `cos(turn·π)`, as a cosine between 0 and π/2 or a rational.
fn cos_of_pi(turn: &BigRational) -> Result<Constant, ErrorKind> {
    let (one, two) = (ratio(1, 1), ratio(2, 1));
    let mut turn = turn - (turn / &two).floor() * &two;
    if turn > one {
        turn = two - turn;
    }
    let negative = turn > ratio(1, 2);
    if negative {
        turn = one - turn;
    }
    let size = if turn.is_zero() {
        Constant::one()
    } else if turn == ratio(1, 2) {
        Constant::zero()
    } else if turn == ratio(1, 3) {
        Constant::rational(turn * ratio(3, 2))?
    } else {
        Constant::build(Tree::Cos(Constant::pi().scale(&turn)?))?
    };
    if negative { size.negate() } else { Ok(size) }
}

/// `factor·root(radicand)`.
fn radical(
    factor: BigRational,
    radicand: BigInt,
    tree: fn(Constant) -> Tree,
) -> Result<Constant, ErrorKind> {
    if radicand.is_one() {
        return Constant::rational(factor);
    }
    let radicand = Constant::rational(BigRational::from_integer(radicand))?;
    Constant::build(tree(radicand))?.scale(&factor)
}

/// `ᵏ√value = factor·ᵏ√radicand` for a nonnegative rational. The radicand is an integer, not divisible by the k-th
/// power of a prime below 1000, and 1 if the rational is a k-th power.
fn root_of_rational(value: &BigRational, order: u32) -> (BigRational, BigInt) {
    // ᵏ√(p/q) = ᵏ√(p·q^(k−1))/q
    let mut radicand = value.numer() * value.denom().pow(order - 1);
    let mut factor = BigInt::one();
    if radicand.is_zero() {
        return (BigRational::zero(), BigInt::one());
    }
    let exact = |radicand: &BigInt| {
        let root = radicand.nth_root(order);
        (root.pow(order) == *radicand).then_some(root)
    };
    for divisor in (2u32..1000).filter(|n| (2..=n.isqrt()).all(|d| n % d != 0)) {
        let power = BigInt::from(divisor).pow(order);
        while radicand > power {
            let (quotient, remainder) = radicand.div_rem(&power);
            if !remainder.is_zero() {
                break;
            }
            radicand = quotient;
            factor *= divisor;
        }
    }
    if let Some(root) = exact(&radicand) {
        factor *= root;
        radicand = BigInt::one();
    }
    (BigRational::new(factor, value.denom().clone()), radicand)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::symbolic::constant::tests::{constant, value};
    use proptest::prelude::*;

    #[test]
    fn perfect_powers_and_symmetries_are_simplified() {
        let cases = [
            ("sqrt(9/4)", "3/2"),
            ("sqrt(12)", "2*sqrt(3)"),
            ("sqrt(1/2)", "sqrt(2)/2"),
            ("sqrt(0)", "0"),
            ("sqrt(10007^2)", "10007"),
            ("cbrt(-8/27)", "-2/3"),
            ("cbrt(54)", "3*cbrt(2)"),
            ("cbrt(0)", "0"),
            ("sqrt(exp(3))", "exp(3/2)"),
            ("exp(0)", "1"),
            ("exp(ln(pi))", "pi"),
            ("ln(exp(pi))", "pi"),
            ("ln(1)", "0"),
            ("cos(pi/3)", "1/2"),
            ("sin(pi/6)", "1/2"),
            ("sin(-pi/2)", "-1"),
            ("cos(7*pi)", "-1"),
            ("sin(100*pi)", "0"),
            ("sin(pi/5)", "cos(3*pi/10)"),
            ("cos(4*pi/5)", "-cos(pi/5)"),
            ("cos(-1)", "cos(1)"),
            ("sin(1 - pi)", "-sin(1)"),
            ("sin(1 + pi/2)", "cos(1)"),
            ("cos(1 + pi/2)", "-sin(1)"),
            ("cos(7*pi + sqrt(2))", "-cos(sqrt(2))"),
            ("cos(pi/4 - 1)", "sin(pi/4 + 1)"),
            ("tan(pi/4)", "1"),
            ("tan(-pi/3)", "-tan(pi/3)"),
            ("cosh(0)", "1"),
            ("sinh(1)", "(e - 1/e)/2"),
            ("root(t^2 - 4, 2)", "2"),
            ("root((t^2 - 2)^2, 1)", "root(3*t^2 - 6, 1)"),
        ];
        for (a, b) in cases {
            assert_eq!(constant(a), constant(b), "{a} = {b}");
        }
    }

    #[test]
    fn values_that_do_not_exist_are_refused() {
        let minus = Constant::whole(-1);
        assert!(matches!(minus.sqrt(), Err(ErrorKind::Domain { .. })));
        assert!(matches!(minus.ln(), Err(ErrorKind::Domain { .. })));
        assert!(matches!(
            Constant::zero().ln(),
            Err(ErrorKind::Domain { .. })
        ));
        let right = Constant::pi().scale(&ratio(3, 2)).expect("small");
        assert!(matches!(right.tan(), Err(ErrorKind::Domain { .. })));
        assert!(matches!(
            Constant::whole(3000).exp(),
            Err(ErrorKind::Magnitude { .. })
        ));
        let huge = Constant::whole(10).power(2000).expect("rational");
        assert!(matches!(huge.sin(), Err(ErrorKind::Magnitude { .. })));
        let open = constant("(e - pi)*(e + pi) - e^2 + pi^2");
        assert!(matches!(open.sqrt(), Err(ErrorKind::Undecided { .. })));
        let mut nested = Constant::one();
        let ended = (0..400).find_map(|_| match nested.sin() {
            Ok(next) => {
                nested = next;
                None
            }
            Err(kind) => Some(kind),
        });
        assert!(matches!(ended, Some(ErrorKind::ExpressionSize { .. })));
    }

    proptest! {
        #[test]
        fn folding_keeps_values(n in -400i64..400, d in 1i64..60, k in -9i64..9, m in 0usize..4) {
            let x = constant(&format!("{n}*pi/{d} + {k}*{}", ["1", "0", "sqrt(3)", "(1 - sqrt(2))"][m]));
            let v = value(&x);
            for (found, expected) in [(x.cos(), v.cos()), (x.sin(), v.sin()), (x.cbrt(), v.cbrt())] {
                let found = found.expect("small");
                prop_assert!((value(&found) - expected).abs() < 1e-9);
                prop_assert_eq!(constant(&found.to_string()), found);
            }
            if v > 0.0 {
                prop_assert!((value(&x.sqrt().expect("positive")) - v.sqrt()).abs() < 1e-9);
            }
            prop_assert_eq!(x.sin().expect("small").negate(), x.negate().expect("small").sin());
            prop_assert_eq!(x.cos(), x.negate().expect("small").cos());
        }
    }
}
