//! Elementary functions of functions.

use std::cmp::Ordering;

use num_rational::BigRational;
use num_traits::One;

use super::{Constant, Frequency, Function, Term, Wave};
use crate::arithmetic::rational::ratio;
use crate::error::ErrorKind;
use crate::expression::shown;

impl Function {
    /// `exp(α·t + c) = e^c·e^(α·t)`.
    ///
    /// # Errors
    /// [`ErrorKind::FunctionClass`] for other arguments; also those of [`Function`].
    pub fn exp(&self) -> Result<Function, ErrorKind> {
        let (growth, constant) = self.argument("exp")?;
        let term = Term::Product {
            growth,
            wave: Wave::None,
            power: 0,
        };
        Ok(Self::single(term, constant.exp()?))
    }

    /// `cos(β·t + c) = cos c·cos(β·t) − sin c·sin(β·t)`.
    ///
    /// # Errors
    /// [`ErrorKind::FunctionClass`] for other arguments; also those of [`Function`].
    pub fn cos(&self) -> Result<Function, ErrorKind> {
        let (frequency, phase) = self.argument("cos")?;
        let cosine = Self::wave(Wave::cos(BigRational::one(), &frequency), &phase.cos()?)?;
        let sine = Self::wave(Wave::sin(BigRational::one(), &frequency), &phase.sin()?)?;
        cosine.subtract(&sine)
    }

    /// `sin(β·t + c) = cos c·sin(β·t) + sin c·cos(β·t)`.
    ///
    /// # Errors
    /// [`ErrorKind::FunctionClass`] for other arguments; also those of [`Function`].
    pub fn sin(&self) -> Result<Function, ErrorKind> {
        let (frequency, phase) = self.argument("sin")?;
        let sine = Self::wave(Wave::sin(BigRational::one(), &frequency), &phase.cos()?)?;
        let cosine = Self::wave(Wave::cos(BigRational::one(), &frequency), &phase.sin()?)?;
        sine.add(&cosine)
    }

    /// `cosh f = (e^f + e^−f)/2`.
    ///
    /// # Errors
    /// [`ErrorKind::FunctionClass`] unless `f = α·t + c`; also those of [`Function`].
    pub fn cosh(&self) -> Result<Function, ErrorKind> {
        self.argument("cosh")?;
        let sum = self.exp()?.add(&self.negate()?.exp()?)?;
        sum.scale(&Constant::rational(ratio(1, 2))?)
    }

    /// `sinh f = (e^f − e^−f)/2`.
    ///
    /// # Errors
    /// [`ErrorKind::FunctionClass`] unless `f = α·t + c`; also those of [`Function`].
    pub fn sinh(&self) -> Result<Function, ErrorKind> {
        self.argument("sinh")?;
        let difference = self.exp()?.subtract(&self.negate()?.exp()?)?;
        difference.scale(&Constant::rational(ratio(1, 2))?)
    }

    /// `tan(ω·t)` with `|ω| < π/2`, or the tangent of a constant.
    ///
    /// # Errors
    /// [`ErrorKind::FunctionClass`] for other arguments; also those of [`Function`].
    pub fn tan(&self) -> Result<Function, ErrorKind> {
        if let Some(constant) = self.as_constant() {
            return Ok(Self::constant(constant.tan()?));
        }
        let (frequency, phase) = self.argument("tan")?;
        if !phase.is_trivially_zero() {
            return Err(self.refused("tan", "a tangent takes q*t without a constant"));
        }
        if !is_below_right_angle(&frequency)? {
            return Err(self.refused("tan", "it has a pole between 0 and 1"));
        }
        let (frequency, negated) = frequency.normalise();
        let sign = Constant::whole(if negated { -1 } else { 1 });
        Ok(Self::single(Term::Tan(frequency), sign))
    }

    /// `ln(cos(ω·t))` with `|ω| < π/2`, or the logarithm of a constant.
    ///
    /// # Errors
    /// [`ErrorKind::FunctionClass`] for other arguments; also those of [`Function`].
    pub fn ln(&self) -> Result<Function, ErrorKind> {
        if let Some(constant) = self.as_constant() {
            return Ok(Self::constant(constant.ln()?));
        }
        let mut terms = self.terms();
        if let (Some((term, coefficient)), None) = (terms.next(), terms.next())
            && let Some((growth, Wave::Cos(frequency), 0)) = term.parts()
            && growth.is_zero()
            && coefficient.is_trivially_one()
            && is_below_right_angle(frequency)?
        {
            let term = Term::LnCos(frequency.clone());
            return Ok(Self::single(term, Constant::one()));
        }
        Err(self.refused("ln", "a logarithm takes a constant here"))
    }

    /// A root of a constant function.
    ///
    /// # Errors
    /// [`ErrorKind::FunctionClass`] for functions that are not constant, and those of the root.
    pub(super) fn radical(
        &self,
        name: &'static str,
        root: fn(&Constant) -> Result<Constant, ErrorKind>,
    ) -> Result<Function, ErrorKind> {
        match self.as_constant() {
            Some(constant) => Ok(Self::constant(root(&constant)?)),
            None => Err(self.refused(name, "a root takes a constant here")),
        }
    }

    /// The frequency q and the constant c of `self = q·t + c`.
    fn argument(&self, name: &'static str) -> Result<(Frequency, Constant), ErrorKind> {
        self.linear().ok_or_else(|| {
            self.refused(
                name,
                "its argument is not q*t + c with q rational or a rational multiple of pi",
            )
        })
    }

    fn refused(&self, name: &str, reason: &'static str) -> ErrorKind {
        ErrorKind::FunctionClass {
            found: shown(&format!("{name}({self})")),
            reason,
        }
    }

    fn wave(
        (factor, wave): (BigRational, Wave),
        coefficient: &Constant,
    ) -> Result<Function, ErrorKind> {
        let term = Term::Product {
            growth: Frequency::zero(),
            wave,
            power: 0,
        };
        Ok(Self::single(term, coefficient.scale(&factor)?))
    }
}

/// Whether `|ω| < π/2`.
fn is_below_right_angle(frequency: &Frequency) -> Result<bool, ErrorKind> {
    let right = Constant::pi().scale(&ratio(1, 2))?;
    for side in [frequency.clone(), frequency.negate()] {
        let distance = right.subtract(&side.to_constant()?)?;
        match distance.sign() {
            None => return Err(distance.undecided()),
            Some(Ordering::Greater) => {}
            Some(_) => return Ok(false),
        }
    }
    Ok(true)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::symbolic::function::tests::function;

    #[test]
    fn functions_outside_the_integrable_class_are_refused() {
        let t = Function::variable();
        let square = t.power(2).expect("small");
        let class = |result: Result<Function, ErrorKind>| {
            matches!(result, Err(ErrorKind::FunctionClass { .. }))
        };
        assert!(class(square.exp()) && class(square.sin()) && class(square.cosh()));
        assert!(
            class(function("cos(t)").cos()) && class(t.ln()) && class(function("2*cos(t)").ln())
        );
        assert!(class(t.radical("sqrt", Constant::sqrt)));
        assert!(class(function("sqrt(2)*t").sin()));
        assert!(class(function("2*t").tan()) && class(function("pi*t/2").tan()));
        assert!(class(function("t + 1").tan()) && class(function("cos(2*t)").ln()));
        assert!(function("pi*t/2 - t/1000").tan().is_ok() && function("(pi - 4)*t").tan().is_ok());
        assert!(function("cos(3*t/2)").ln().is_ok());
    }
}
