//! Sums, products, powers and functions of values.

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::values::counted;
use super::{Elaborator, MAX_EXPONENT, MAX_JOINED_EXPONENT, Value};
use crate::function::{Elementary, Function};
use crate::graph::{Id, Node, Number, integer};
use crate::parse::{JUMPS, constant, unknown_function};
use crate::syntax::{Expression, Kind, Name};
use symplectic_exact::error::FormulaError;
use symplectic_exact::error::{Error, ErrorKind};

impl Elaborator<'_> {
    pub(super) fn sum(&mut self, terms: &[(bool, Expression)]) -> Result<Value, Error> {
        let mut values = Vec::with_capacity(terms.len());
        for (minus, term) in terms {
            let value = self.value(term)?;
            let sign = if *minus {
                -Number::one()
            } else {
                Number::one()
            };
            values.push((sign, self.whole(value), term));
        }
        if values
            .iter()
            .any(|(_, value, _)| matches!(value, Value::Scalar(_)))
        {
            for (_, value, _) in &mut values {
                *value = self.single(value.clone());
            }
        }
        let (_, first, _) = &values[0];
        match first.clone() {
            Value::Scalar(_) => {
                let mut parts = Vec::with_capacity(values.len());
                for (sign, value, at) in values {
                    match value {
                        Value::Scalar(id) => parts.push((sign, id)),
                        other => return self.mismatch(at, &other, "a number"),
                    }
                }
                Ok(Value::Scalar(self.graph.sum(parts)))
            }
            Value::Vector(components) => {
                let mut parts = vec![Vec::with_capacity(values.len()); components.len()];
                for (sign, value, at) in values {
                    match value {
                        Value::Vector(ids) if ids.len() == parts.len() => {
                            for (part, id) in parts.iter_mut().zip(ids) {
                                part.push((sign.clone(), id));
                            }
                        }
                        other => {
                            let expected =
                                format!("a vector of {}", counted(parts.len(), "component"));
                            return self.mismatch(at, &other, &expected);
                        }
                    }
                }
                Ok(Value::Vector(
                    parts.into_iter().map(|part| self.graph.sum(part)).collect(),
                ))
            }
            other => self.mismatch(values[0].2, &other, "a number or a vector"),
        }
    }

    pub(super) fn product(&mut self, factors: &[(bool, Expression)]) -> Result<Value, Error> {
        let mut scalars = Vec::with_capacity(factors.len());
        let mut other: Option<Value> = None;
        for (divide, factor) in factors {
            let value = self.value(factor)?;
            let mut value = self.whole(value);
            // Of two vectors one must be a number, so one with a single component is.
            match (&value, &other) {
                (Value::Vector(_), _) if *divide => value = self.single(value),
                (Value::Vector(_), Some(Value::Vector(parts))) if parts.len() == 1 => {
                    scalars.push((parts[0], integer(1)));
                    other = None;
                }
                (Value::Vector(_), Some(Value::Vector(_))) => value = self.single(value),
                _ => {}
            }
            match (value, other.take()) {
                (Value::Scalar(id), before) => {
                    if *divide && self.divides_by_zero(id) {
                        return self.error(factor, ErrorKind::DivisionByZero);
                    }
                    scalars.push((id, integer(if *divide { -1 } else { 1 })));
                    other = before;
                }
                (value @ (Value::Vector(_) | Value::Matrix(_)), None) if !divide => {
                    other = Some(value)
                }
                (Value::Vector(parts), Some(Value::Matrix(rows))) if !divide => {
                    if rows.iter().any(|row| row.len() != parts.len()) {
                        let found = Value::Vector(parts);
                        return self.mismatch(
                            factor,
                            &found,
                            "a vector with as many components as the matrix has columns",
                        );
                    }
                    other = Some(Value::Vector(
                        rows.iter().map(|row| self.dot(row, &parts)).collect(),
                    ));
                }
                (found @ (Value::Vector(_) | Value::Matrix(_)), _) => {
                    let expected = match divide {
                        true => "a number to divide by",
                        false => "a number, or `dot(a, b)` or `cross(a, b)`",
                    };
                    return self.mismatch(factor, &found, expected);
                }
                (found, _) => return self.mismatch(factor, &found, "a number or a vector"),
            }
        }
        let mut scaled = |parts: Vec<Id>| -> Vec<Id> {
            let all = |part| {
                scalars
                    .iter()
                    .cloned()
                    .chain([(part, Number::one())])
                    .collect::<Vec<_>>()
            };
            parts
                .into_iter()
                .map(|part| self.graph.product(Number::one(), all(part)))
                .collect()
        };
        Ok(match other {
            None => Value::Scalar(self.graph.product(Number::one(), scalars)),
            Some(Value::Vector(parts)) if scalars.is_empty() => Value::Vector(parts),
            // One factor for all components.
            Some(Value::Vector(parts)) => {
                let factor = self.graph.product(Number::one(), scalars);
                Value::Vector(
                    parts
                        .into_iter()
                        .map(|part| self.graph.multiply(factor, part))
                        .collect(),
                )
            }
            Some(Value::Matrix(rows)) => Value::Matrix(rows.into_iter().map(&mut scaled).collect()),
            Some(other) => other,
        })
    }

    pub(super) fn dot(&mut self, a: &[Id], b: &[Id]) -> Id {
        let products: Vec<_> = a
            .iter()
            .zip(b)
            .map(|(&a, &b)| (Number::one(), self.graph.multiply(a, b)))
            .collect();
        self.graph.sum(products)
    }

    pub(super) fn root(&mut self, x: Id, at: &Expression) -> Result<Id, Error> {
        if self.graph.value(x).is_some_and(Signed::is_negative) {
            let kind = ErrorKind::Domain {
                value: self.text(at),
                function: "sqrt",
                needs: "a number that is not negative",
            };
            return self.error(at, kind);
        }
        Ok(self.graph.power(x, BigRational::new(1.into(), 2.into())))
    }

    pub(super) fn power(&mut self, base: &Expression, exponent: &Expression) -> Result<Id, Error> {
        let number = constant(exponent);
        // Even powers of a length have no root.
        if let (Kind::Bars(inner), Some(number)) = (&base.kind, &number) {
            let value = self.value(inner)?;
            let half = number / integer(2);
            match self.whole(value) {
                Value::Vector(parts) => {
                    let square = self.dot(&parts, &parts);
                    return self.number_power(square, half, base);
                }
                Value::Scalar(id) if self.graph.value(id).is_none() => {
                    let (factor, x) = self.graph.scaled(id);
                    let square = self.graph.power(x, integer(2));
                    let power = self.number_power(square, half, base)?;
                    let factor = self.graph.constant(factor.abs());
                    let factor = self.number_power(factor, number.clone(), base)?;
                    return Ok(self.graph.multiply(factor, power));
                }
                _ => {}
            }
        }
        let value = self.value(base)?;
        let x = match self.whole(value) {
            Value::Scalar(id) => id,
            Value::Vector(parts) if parts.len() == 1 => parts[0],
            found => {
                return self.mismatch(base, &found, "a number (the square of a vector is `|v|^2`)");
            }
        };
        match number {
            Some(number) => {
                let large = integer(MAX_EXPONENT);
                if number.abs() > large || *number.denom() > MAX_EXPONENT.into() {
                    let kind = ErrorKind::Type {
                        found: format!("the exponent `{}`", self.text(exponent)),
                        expected: format!("one up to {MAX_EXPONENT}"),
                    };
                    return self.error(exponent, kind);
                }
                self.number_power(x, number, base)
            }
            None => {
                // exp(e ln x)
                let exponent = self.scalar(exponent)?;
                let logarithm = self.elementary(Elementary::Ln, x, base)?;
                self.check_finite(logarithm, base)?;
                let product = self.graph.multiply(exponent, logarithm);
                Ok(self.graph.elementary(Elementary::Exp, product))
            }
        }
    }

    pub(super) fn number_power(
        &mut self,
        x: Id,
        exponent: Number,
        at: &Expression,
    ) -> Result<Id, Error> {
        if let Some(value) = self.graph.value(x) {
            if value.is_zero() && exponent.is_negative() {
                return self.error(at, ErrorKind::DivisionByZero);
            }
            if value.is_negative() && !exponent.is_integer() {
                let kind = ErrorKind::Domain {
                    value: self.text(at),
                    function: "a fractional power",
                    needs: "a number that is not negative",
                };
                return self.error(at, kind);
            }
        }
        let power = self.graph.power(x, exponent);
        let (_, inner) = self.graph.scaled(power);
        if let Node::Product(factors) = self.graph.node(inner)
            && factors
                .iter()
                .any(|(_, e)| e.abs() > integer(MAX_JOINED_EXPONENT))
        {
            let kind = ErrorKind::Type {
                found: format!("a power of `{}` with a huge exponent", self.text(at)),
                expected: format!("exponents up to {MAX_JOINED_EXPONENT}"),
            };
            return self.error(at, kind);
        }
        Ok(power)
    }

    pub(super) fn call(
        &mut self,
        function: &Name,
        arguments: &[Expression],
        at: &Expression,
    ) -> Result<Value, Error> {
        let name = function.text.as_str();
        if JUMPS.contains(&name) {
            let function = name.to_owned();
            return Err((self.input).error(&at.span, FormulaError::Jumps { function }.into()));
        }
        if let Some(Value::Abbreviation(k)) = self.names.get(name).cloned() {
            return self.expand(k, arguments, at);
        }
        let two = matches!(name, "dot" | "cross" | "hypot" | "atan2" | "max" | "min");
        if arguments.len() != 1 + usize::from(two) {
            let kind = ErrorKind::Arguments {
                function: name.to_owned(),
                expected: if two { "two arguments" } else { "one argument" }.to_owned(),
                found: arguments.len().to_string(),
            };
            return self.error(at, kind);
        }
        if let Some(&Value::Function(user)) = self.names.get(name) {
            let x = self.scalar(&arguments[0])?;
            return Ok(Value::Scalar(self.graph.user(user, 0, x)));
        }
        if let Some(function) = Function::find(name) {
            let x = self.scalar(&arguments[0])?;
            return Ok(Value::Scalar(match function {
                Function::Sqrt => self.root(x, &arguments[0])?,
                Function::Elementary(function) => self.elementary(function, x, at)?,
            }));
        }
        let both = |this: &mut Self| -> Result<[Vec<Id>; 2], Error> {
            let mut sides = [Vec::new(), Vec::new()];
            for (side, written) in sides.iter_mut().zip(arguments) {
                let value = this.value(written)?;
                *side = this.components(value, written)?;
            }
            if sides[0].len() != sides[1].len() {
                let found = Value::Vector(sides[1].clone());
                let expected = format!("a vector of {}", counted(sides[0].len(), "component"));
                return this.mismatch(&arguments[1], &found, &expected);
            }
            Ok(sides)
        };
        Ok(match name {
            "norm" => {
                let value = self.value(&arguments[0])?;
                let parts = self.components(value, &arguments[0])?;
                let square = self.dot(&parts, &parts);
                Value::Scalar(self.root(square, &arguments[0])?)
            }
            "dot" => {
                let [a, b] = both(self)?;
                Value::Scalar(self.dot(&a, &b))
            }
            "cross" => {
                let [a, b] = both(self)?;
                let mut minor = |i: usize, j: usize| {
                    let (plus, minus) = (
                        self.graph.multiply(a[i], b[j]),
                        self.graph.multiply(a[j], b[i]),
                    );
                    self.graph
                        .sum([(Number::one(), plus), (-Number::one(), minus)])
                };
                match a.len() {
                    2 => Value::Scalar(minor(0, 1)),
                    3 => Value::Vector(vec![minor(1, 2), minor(2, 0), minor(0, 1)]),
                    _ => {
                        return self.mismatch(
                            &arguments[0],
                            &Value::Vector(a),
                            "a vector of 2 or 3 components",
                        );
                    }
                }
            }
            "abs" => {
                let x = self.scalar(&arguments[0])?;
                Value::Scalar(self.graph.absolute(x))
            }
            // min(a, b) = −max(−a, −b)
            "max" | "min" => {
                let sign = integer(if name == "max" { 1 } else { -1 });
                let side = |this: &mut Self, k: usize| {
                    let x = this.scalar(&arguments[k])?;
                    Ok::<_, Error>(this.graph.scale(sign.clone(), x))
                };
                let [a, b] = [side(self, 0)?, side(self, 1)?];
                let difference = self.graph.sum([(integer(1), a), (integer(-1), b)]);
                let size = self.graph.absolute(difference);
                self.keep_power(size, &at.span);
                let larger = self.graph.larger(a, b);
                Value::Scalar(self.graph.scale(sign, larger))
            }
            "hypot" | "atan2" => {
                let [a, b] = [self.scalar(&arguments[0])?, self.scalar(&arguments[1])?];
                Value::Scalar(match name {
                    "atan2" => self.graph.atan2(a, b),
                    _ => {
                        let square = self.dot(&[a, b], &[a, b]);
                        self.root(square, at)?
                    }
                })
            }
            _ => {
                return Err(unknown_function(self.input, function));
            }
        })
    }
}
