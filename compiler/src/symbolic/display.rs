//! Constants and functions as text, in the grammar of expressions.

use std::fmt;

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::{Constant, Frequency, Function, Term, Tree, Wave};

impl fmt::Display for Constant {
    /// `1/2 - sqrt(2)/4`, `(pi - 4)/(4*pi)`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&join(signed_terms(self, "")))
    }
}

/// The terms of a sum with their signs, positive ones first, each with `last` as its last factor.
fn signed_terms(constant: &Constant, last: &str) -> Vec<(bool, String)> {
    let (rational, terms) = constant.summands();
    let mut texts = Vec::new();
    if !rational.is_zero() || terms.is_empty() {
        texts.push((rational.is_negative(), monomial(&rational, &[], last)));
    }
    for (x, q) in &terms {
        let text = match x.tree() {
            Tree::Product(factors) => monomial(q, factors, last),
            _ => monomial(q, &[(x.clone(), 1)], last),
        };
        texts.push((q.is_negative(), text));
    }
    texts.sort_by_key(|&(negative, _)| negative);
    texts
}

/// `a + b - c`
fn join(terms: Vec<(bool, String)>) -> String {
    let mut text = String::new();
    for (negative, term) in terms {
        text.push_str(match (text.is_empty(), negative) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        });
        text.push_str(&term);
    }
    text
}

/// `3*pi^2*t/(4*e)`: the product of the absolute value of a rational, of powers, and of a last factor unless empty.
fn monomial(coefficient: &BigRational, factors: &[(Constant, i32)], last: &str) -> String {
    let (mut above, mut below) = (Vec::new(), Vec::new());
    if !coefficient.denom().is_one() {
        below.push(coefficient.denom().to_string());
    }
    for (base, exponent) in factors {
        let text = factor(base);
        let text = match exponent.unsigned_abs() {
            1 => text,
            power => format!("{text}^{power}"),
        };
        if *exponent > 0 {
            above.push(text);
        } else {
            below.push(text);
        }
    }
    if !last.is_empty() {
        above.push(last.to_owned());
    }
    if !coefficient.numer().abs().is_one() || above.is_empty() {
        above.insert(0, coefficient.numer().abs().to_string());
    }
    let above = above.join("*");
    match below.as_slice() {
        [] => above,
        [single] => format!("{above}/{single}"),
        _ => format!("{above}/({})", below.join("*")),
    }
}

/// A constant as a factor.
fn factor(constant: &Constant) -> String {
    match constant.tree() {
        Tree::Pi => "pi".to_owned(),
        Tree::Root(root) => {
            let polynomial = root.polynomial.display("t");
            format!("root({polynomial}, {})", root.index)
        }
        Tree::Sqrt(x) => format!("sqrt({x})"),
        Tree::Cbrt(x) => format!("cbrt({x})"),
        Tree::Exp(x) if x.is_trivially_one() => "e".to_owned(),
        Tree::Exp(x) => format!("exp({x})"),
        Tree::Ln(x) => format!("ln({x})"),
        Tree::Cos(x) => format!("cos({x})"),
        Tree::Sin(x) => format!("sin({x})"),
        Tree::Rational(_) | Tree::Product(_) | Tree::Sum(..) => format!("({constant})"),
    }
}

impl fmt::Display for Frequency {
    /// The frequency as a constant: `3*pi/2`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text(""))
    }
}

impl Frequency {
    /// The product with `t`, or the frequency alone: `t/2`, `3*pi*t`, `(1 + pi)*t`.
    fn text(&self, last: &str) -> String {
        let pi = [(Constant::pi(), 1)];
        let mut terms = Vec::new();
        if !self.rational.is_zero() || self.pi.is_zero() {
            let text = |last| monomial(&self.rational, &[], last);
            terms.push((self.rational.is_negative(), text("")));
            if self.pi.is_zero() {
                terms[0].1 = text(last);
            }
        }
        if !self.pi.is_zero() {
            let last = if self.rational.is_zero() { last } else { "" };
            terms.push((self.pi.is_negative(), monomial(&self.pi, &pi, last)));
        }
        let both = terms.len() > 1;
        terms.sort_by_key(|&(negative, _)| negative);
        let text = join(terms);
        if both && !last.is_empty() {
            format!("({text})*{last}")
        } else {
            text
        }
    }
}

impl fmt::Display for Term {
    /// `t^2*exp(-t/2)*sin(3*t)`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Term::Product {
                growth,
                wave,
                power,
            } => {
                let mut factors = Vec::new();
                match power {
                    0 => {}
                    1 => factors.push("t".to_owned()),
                    _ => factors.push(format!("t^{power}")),
                }
                if !growth.is_zero() {
                    factors.push(format!("exp({})", growth.text("t")));
                }
                match wave {
                    Wave::None => {}
                    Wave::Cos(frequency) => factors.push(format!("cos({})", frequency.text("t"))),
                    Wave::Sin(frequency) => factors.push(format!("sin({})", frequency.text("t"))),
                }
                if factors.is_empty() {
                    factors.push("1".to_owned());
                }
                f.write_str(&factors.join("*"))
            }
            Term::Tan(frequency) => write!(f, "tan({})", frequency.text("t")),
            Term::LnCos(frequency) => write!(f, "ln(cos({}))", frequency.text("t")),
        }
    }
}

impl fmt::Display for Function {
    /// The polynomial part with the highest degree first, then the other terms.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(constant) = self.as_constant() {
            return constant.fmt(f);
        }
        let mut terms: Vec<(&Term, &Constant)> = self.terms().collect();
        terms.sort_by(|(a, _), (b, _)| {
            let powers = b.is_power().cmp(&a.is_power());
            powers.then_with(|| match (a.parts(), b.parts()) {
                (Some((g, w, k)), Some((h, v, l))) => (g, w, l).cmp(&(h, v, k)),
                _ => a.cmp(b),
            })
        });
        let text = terms
            .into_iter()
            .map(|(term, coefficient)| {
                let mut parts = signed_terms(coefficient, "");
                let (negative, size) = match parts.as_mut_slice() {
                    [(negative, text)] => (*negative, std::mem::take(text)),
                    _ => (false, format!("({})", join(parts))),
                };
                let text = if term.is_one() {
                    size
                } else if size == "1" {
                    term.to_string()
                } else {
                    format!("{size}*{term}")
                };
                (negative, text)
            })
            .collect();
        f.write_str(&join(text))
    }
}

#[cfg(test)]
mod tests {
    use crate::arithmetic::polynomial::Polynomial;
    use crate::arithmetic::rational::ratio;
    use crate::symbolic::Function;
    use crate::symbolic::constant::tests::constant;
    use crate::symbolic::function::tests::function;
    use proptest::prelude::*;

    #[test]
    fn constants_print_with_few_parentheses() {
        let cases = [
            "0",
            "-1/2",
            "1/2 - sqrt(2)/4",
            "sqrt(2)/4 - 1/2",
            "(pi - 4)/(4*pi)",
            "cos(pi/5)",
            "exp(1/2)",
            "e",
            "3*pi^2/(4*e)*sqrt(2)",
            "1/pi",
            "-1/(2*pi^2)",
            "root(t^3 - t - 1, 1)",
            "ln(cos(1))",
            "(pi + 1)^2",
            "sqrt(pi + 1) - 7/3*pi",
            "cbrt(2)^2/2",
        ];
        let printed: Vec<String> = cases
            .iter()
            .map(|text| constant(text).to_string())
            .collect();
        assert_eq!(
            printed[8],
            "3*pi^2*sqrt(2)/(4*e)".replace("/(4*e)", "*exp(-1)/4")
        );
        for (k, text) in cases.iter().enumerate() {
            assert_eq!(constant(&printed[k]), constant(text), "{text}");
            if ![8, 13, 14].contains(&k) {
                assert_eq!(printed[k], *text);
            }
        }
    }

    #[test]
    fn functions_print_like_mathematics() {
        for text in [
            "0",
            "1",
            "t^2 - 1/3*t",
            "cos(pi*t)",
            "t^2*exp(-t/2)*sin(3*t)",
            "(1 - sqrt(2))*t",
            "sqrt(2)/4*t^2 - t + (1 - sqrt(2))",
            "-t + exp(t)",
            "2*tan(t)",
            "ln(cos(pi*t/4))",
            "cos((1 + pi/2)*t)",
            "exp(3*pi*t/2)",
        ] {
            assert_eq!(function(text).to_string(), text);
        }
        assert_eq!(function("1 + cos(t)^2").to_string(), "3/2 + 1/2*cos(2*t)");
    }

    proptest! {
        #[test]
        fn polynomials_print_as_polynomials(c in prop::collection::vec((-20i64..20, 1i64..12), 0..7)) {
            let p = Polynomial::from_rationals(&c.iter().map(|&(n, d)| ratio(n, d)).collect::<Vec<_>>());
            let f = Function::polynomial(&p).expect("small");
            prop_assert_eq!(f.to_string(), p.display("t").to_string());
            prop_assert_eq!(f.as_polynomial(), Some(p));
        }
    }
}
