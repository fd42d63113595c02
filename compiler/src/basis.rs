//! Bases of the space in which the velocities are approximated.

use std::fmt::Display;

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::algebra::{Constants, Field};
use crate::arithmetic::matrix::left_kernel;
use crate::arithmetic::polynomial::Polynomial;
use crate::error::{Error, ErrorKind};
use crate::expression::{Expression, ExpressionKind, Input, parse_list};
use crate::limits::Limits;
use crate::quadrature::{check_stages, count};
use crate::symbolic::{Constant, FUNCTIONS, Function, Term};

/// Linearly independent functions `ψ_1, …, ψ_s` on `[0, 1]` (LZ §4).
#[derive(Debug, Clone, PartialEq)]
pub struct Basis {
    name: String,
    space: Space,
}

/// The space that a basis spans, by one of its bases.
#[derive(Debug, Clone, PartialEq)]
enum Space {
    /// Polynomials with rational coefficients.
    Polynomials(Vec<Polynomial>),
    /// Any functions.
    Functions(Vec<Function>),
}

/// The names of bases with one member for each number of functions.
const FAMILIES: [(&str, Members); 2] = [("polynomial", monomials), ("legendre", legendre)];

/// The member of a family with this number of functions.
type Members = fn(usize) -> Vec<Polynomial>;

impl Basis {
    /// Reads `polynomial(3)`, which is `1, t, t^2`, `legendre(3)`, or a list of functions of t such as
    /// `1, cos(pi*t), sin(pi*t)`.
    ///
    /// # Errors
    /// Wrong expressions, unknown bases, too many functions, linearly dependent functions, each at its
    /// place in the text.
    ///
    /// ```
    /// use symplectic_compiler::{Basis, Limits};
    ///
    /// let basis = Basis::parse("1, t - 1/2, exp(-t)", &Limits::default())?;
    /// assert_eq!(basis.len(), 3);
    /// let error = Basis::parse("1 + t, 2 + 2*t", &Limits::default()).unwrap_err();
    /// assert_eq!(
    ///     error.to_string(),
    ///     "basis, column 1: the basis functions are linearly dependent: 2*(t + 1) - (2*t + 2) = 0; leave one of them out"
    /// );
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn parse(text: &str, limits: &Limits) -> Result<Self, Error> {
        let input = Input {
            name: "basis",
            text,
        };
        let items = parse_list(input)?;
        if let [item] = items.as_slice()
            && let ExpressionKind::Call {
                function,
                name,
                arguments,
            } = &item.kind
            && !FUNCTIONS.contains(&function.as_str())
        {
            let Some((family, members)) = FAMILIES.iter().find(|(known, _)| known == function)
            else {
                let known = FAMILIES.map(|(name, _)| name).join(", ");
                let kind = ErrorKind::Unknown {
                    what: "basis",
                    name: function.clone(),
                    known: format!("{known}, or a list of functions of t"),
                };
                return Err(input.error(name, kind));
            };
            let size = count(input, item, function, arguments)?;
            if !size.is_positive() {
                let kind = ErrorKind::TooFewStages {
                    rule: family,
                    stages: size.to_string(),
                    minimum: 1,
                };
                return Err(input.error(&item.span, kind));
            }
            let size = check_stages(&size, limits).map_err(|kind| input.error(&item.span, kind))?;
            return Ok(Self::of_polynomials(
                format!("{family}({size})"),
                members(size),
            ));
        }
        Self::list(input, &items, limits)
    }

    fn list(input: Input<'_>, items: &[Expression], limits: &Limits) -> Result<Self, Error> {
        let whole = 0..input.text.len();
        let at = |kind| input.error(&whole, kind);
        check_stages(&items.len().into(), limits).map_err(at)?;
        let functions = items.iter().map(|item| item.function(input));
        Self::new(functions.collect::<Result<_, _>>()?).map_err(at)
    }

    /// The basis `1, t, …, t^(s−1)`.
    pub fn monomials(size: usize) -> Self {
        Self::of_polynomials(format!("polynomial({size})"), monomials(size))
    }

    fn of_polynomials(name: String, polynomials: Vec<Polynomial>) -> Self {
        Basis {
            name,
            space: Space::Polynomials(polynomials),
        }
    }

    /// A basis of given functions.
    ///
    /// # Errors
    /// [`ErrorKind::DependentBasis`]. Functions whose coefficients do not lie in one constant field are assumed
    /// independent; if they are not, every derivation fails.
    pub fn new(functions: Vec<Function>) -> Result<Self, ErrorKind> {
        let texts: Vec<String> = functions.iter().map(ToString::to_string).collect();
        let name = texts.join(", ");
        let polynomials: Option<Vec<Polynomial>> =
            functions.iter().map(Function::as_polynomial).collect();
        if let Some(polynomials) = polynomials {
            let rows: Vec<Vec<BigRational>> =
                polynomials.iter().map(Polynomial::coefficients).collect();
            if let Some(coefficients) = left_kernel(&rows) {
                return Err(ErrorKind::DependentBasis {
                    combination: combination(&texts, &coefficients),
                });
            }
            return Ok(Self::of_polynomials(name, polynomials));
        }
        // Factors do not matter, but they may lie in no field with the others.
        let mut scaled = Vec::new();
        for function in &functions {
            let Some((_, leading)) = function.terms().next() else {
                return Err(ErrorKind::DependentBasis {
                    combination: function.to_string(),
                });
            };
            scaled.push(match leading.inverse() {
                Ok(inverse) if leading.as_rational().is_none() => function.scale(&inverse)?,
                _ => function.clone(),
            });
        }
        let space = match echelon_form(&scaled) {
            Some(Echelon::Dependent(coefficients)) => {
                let texts: Vec<String> = scaled.iter().map(ToString::to_string).collect();
                return Err(ErrorKind::DependentBasis {
                    combination: combination(&texts, &coefficients),
                });
            }
            Some(Echelon::Polynomials(polynomials)) => Space::Polynomials(polynomials),
            Some(Echelon::Independent(reduced)) => Space::Functions(reduced.unwrap_or(scaled)),
            None => Space::Functions(scaled),
        };
        Ok(Basis { name, space })
    }

    /// The basis as it is written: `polynomial(3)` or the list of its functions.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Functions that span the space: the same for all bases of one space of rational polynomials.
    ///
    /// # Errors
    /// [`ErrorKind::ExpressionSize`] for polynomials beyond the bounds of functions.
    pub fn functions(&self) -> Result<Vec<Function>, ErrorKind> {
        match &self.space {
            Space::Polynomials(polynomials) => {
                polynomials.iter().map(Function::polynomial).collect()
            }
            Space::Functions(functions) => Ok(functions.clone()),
        }
    }

    /// Polynomials with rational coefficients that span the space, where there are any.
    pub fn polynomials(&self) -> Option<&[Polynomial]> {
        match &self.space {
            Space::Polynomials(polynomials) => Some(polynomials),
            Space::Functions(_) => None,
        }
    }

    /// The number of functions.
    pub fn len(&self) -> usize {
        match &self.space {
            Space::Polynomials(polynomials) => polynomials.len(),
            Space::Functions(functions) => functions.len(),
        }
    }

    /// Whether there are no functions.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

fn monomials(size: usize) -> Vec<Polynomial> {
    (0..size).map(Polynomial::monomial).collect()
}

/// The Legendre polynomials on `[0, 1]`: `(k + 1) P_{k+1} = (2k + 1)(2t − 1) P_k − k P_{k−1}`.
fn legendre(size: usize) -> Vec<Polynomial> {
    let centred = Polynomial::from_integers(&[-1, 2]);
    let mut polynomials = vec![Polynomial::one(), centred.clone()];
    for k in 1..size {
        let ratio = |n: usize| BigRational::new(n.into(), (k + 1).into());
        let next = &(&centred * &polynomials[k]).scale(&ratio(2 * k + 1))
            - &polynomials[k - 1].scale(&ratio(k));
        polynomials.push(next);
    }
    polynomials.truncate(size);
    polynomials
}

/// What elimination among the coefficients of functions finds.
enum Echelon {
    /// A combination that vanishes.
    Dependent(Vec<Constant>),
    /// The functions span a space of polynomials with rational coefficients.
    Polynomials(Vec<Polynomial>),
    /// Anything else: the reduced functions, unless they are beyond the bounds of functions.
    Independent(Option<Vec<Function>>),
}

/// Reduces the coefficients of functions to echelon form, if they lie in one constant field.
fn echelon_form(functions: &[Function]) -> Option<Echelon> {
    let all = || functions.iter().flat_map(Function::terms);
    let field = Constants::containing(all().map(|(_, coefficient)| coefficient))?;
    let mut terms: Vec<&Term> = all().map(|(term, _)| term).collect();
    terms.sort();
    terms.dedup();
    let zero = Constant::zero();
    let coefficient = |f: &Function, term: &Term| {
        let known = f.terms().find(|(known, _)| *known == term);
        field.constant(known.map_or(&zero, |(_, coefficient)| coefficient))
    };
    let identity = |i: usize, k: usize| BigRational::from_integer(i64::from(i == k).into());
    let mut rows = Vec::new();
    for (i, f) in functions.iter().enumerate() {
        let row: Option<Vec<_>> = terms.iter().map(|term| coefficient(f, term)).collect();
        let origin = (0..functions.len()).map(|k| field.rational(&identity(i, k)));
        rows.push([row?, origin.collect()].concat());
    }
    let mut done = 0;
    for column in 0..terms.len() {
        let Some(pivot) = (done..rows.len()).find(|&i| !field.is_zero(&rows[i][column])) else {
            continue;
        };
        rows.swap(done, pivot);
        let inverse = field.inverse(&rows[done][column])?;
        let reference: Vec<_> = rows[done]
            .iter()
            .map(|x| field.multiply(x, &inverse))
            .collect();
        for (i, row) in rows.iter_mut().enumerate() {
            if i != done && !field.is_zero(&row[column]) {
                let factor = row[column].clone();
                for (x, y) in row.iter_mut().zip(&reference) {
                    *x = field.subtract(x, &field.multiply(&factor, y));
                }
            }
        }
        rows[done] = reference;
        done += 1;
    }
    if let Some(row) = rows.get(done) {
        let origin = row[terms.len()..].iter();
        return origin
            .map(|x| field.to_constant(x))
            .collect::<Option<_>>()
            .map(Echelon::Dependent);
    }
    let polynomial = |row: &Vec<_>| {
        let pairs = terms.iter().zip(row);
        let mut sum = Polynomial::zero();
        for (term, x) in pairs.filter(|(_, x)| !field.is_zero(x)) {
            let power = Polynomial::monomial(term.as_power()?);
            sum = &sum + &power.scale(&x.as_rational()?);
        }
        Some(sum)
    };
    let polynomials: Option<Vec<Polynomial>> = rows.iter().map(polynomial).collect();
    if let Some(polynomials) = polynomials {
        return Some(Echelon::Polynomials(polynomials));
    }
    let function = |row: &Vec<_>| {
        let mut function = Function::zero();
        let pairs = terms.iter().zip(row);
        for (term, x) in pairs.filter(|(_, x)| !field.is_zero(x)) {
            let coefficient = field.to_constant(x)?;
            function.insert((*term).clone(), &coefficient).ok()?;
        }
        Some(function)
    };
    Some(Echelon::Independent(rows.iter().map(function).collect()))
}

/// A number that can be the coefficient of a function in a combination.
pub(crate) trait Coefficient: Display {
    /// Whether the number is zero as it is written.
    fn is_absent(&self) -> bool;
    /// The value, if it is rational.
    fn rational(&self) -> Option<BigRational>;
}

impl Coefficient for BigRational {
    fn is_absent(&self) -> bool {
        self.is_zero()
    }

    fn rational(&self) -> Option<BigRational> {
        Some(self.clone())
    }
}

impl Coefficient for Constant {
    fn is_absent(&self) -> bool {
        self.is_trivially_zero()
    }

    fn rational(&self) -> Option<BigRational> {
        self.as_rational().cloned()
    }
}

/// A linear combination as text; rational coefficients are scaled to coprime integers:
/// `2*(t + 1) - (2*t + 2)`.
pub(crate) fn combination<C: Coefficient>(functions: &[String], coefficients: &[C]) -> String {
    let rational: Option<Vec<BigRational>> =
        coefficients.iter().map(Coefficient::rational).collect();
    let single = coefficients.iter().filter(|c| !c.is_absent()).count() == 1;
    let operand = |function: &String| {
        if function.contains(' ') && !single {
            format!("({function})")
        } else {
            function.clone()
        }
    };
    let mut text = String::new();
    let Some(rational) = rational else {
        let terms = functions.iter().zip(coefficients);
        for (function, c) in terms.filter(|(_, c)| !c.is_absent()) {
            let plus = if text.is_empty() { "" } else { " + " };
            let factor = c.to_string();
            let factor = match factor.as_str() {
                "1" => String::new(),
                _ if factor.contains(' ') || factor.starts_with('-') => format!("({factor})*"),
                _ => format!("{factor}*"),
            };
            text.push_str(&format!("{plus}{factor}{}", operand(function)));
        }
        return text;
    };
    let scaled = Polynomial::from_rationals(&rational)
        .primitive()
        .coefficients();
    let flip = scaled
        .iter()
        .find(|c| !c.is_zero())
        .is_some_and(Signed::is_negative);
    for (function, c) in functions.iter().zip(&scaled).filter(|(_, c)| !c.is_zero()) {
        let sign = match (text.is_empty(), c.is_negative() != flip) {
            (true, _) => "",
            (false, false) => " + ",
            (false, true) => " - ",
        };
        let factor = if c.abs().is_one() {
            String::new()
        } else {
            format!("{}*", c.abs())
        };
        text.push_str(&format!("{sign}{factor}{}", operand(function)));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(text: &str) -> String {
        Basis::parse(text, &Limits::default())
            .expect_err(text)
            .to_string()
    }

    #[test]
    fn wrong_bases_are_refused_with_the_reason() {
        let cases = [
            (
                "polynomial(0)",
                "basis, column 1: `polynomial(0)` does not exist: `polynomial(s)` needs s ≥ 1",
            ),
            (
                "polynomial(99)",
                "basis, column 1: 99 stages exceed the limit of 36",
            ),
            (
                "fourier(3)",
                "basis, column 1: unknown basis `fourier`; known here: polynomial",
            ),
            (
                "polynomial(2, 3)",
                "basis, column 1: `polynomial` takes one number",
            ),
            (
                "1, t, 1 - t",
                "basis, column 1: the basis functions are linearly dependent: 1 - t - (-t + 1) = 0",
            ),
            (
                "0, t",
                "basis, column 1: the basis functions are linearly dependent: 0 = 0",
            ),
            (
                "1, polynomial(2)",
                "basis, column 4: unknown function `polynomial`",
            ),
        ];
        for (text, message) in cases {
            assert!(error(text).starts_with(message), "{text}: {}", error(text));
        }
    }
}
