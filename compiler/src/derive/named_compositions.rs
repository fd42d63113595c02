//! Named compositions of a symmetric method, each level of which raises its order by two (GNI II.4).
//!
//! From a symmetric method of order `p` they form one of order `p + 2`. The fractions `γ_i` must satisfy
//! `Σ γ_i = 1` and `Σ γ_i^{p+1} = 0`, which gives order `p + 1`; symmetry gives the other order.
//!
//! * triple jump (Creutz & Gocksch 1989; Forest 1989; Suzuki 1990; Yoshida 1990):
//!   `γ_1 = γ_3 = 1/(2 − r)`, `γ_2 = −r/(2 − r)` with `r = 2^{1/(p+1)}`;
//! * Suzuki's fractal (Suzuki 1990): `γ_1 = γ_2 = γ_4 = γ_5 = 1/(4 − r²)`, `γ_3 = −r²/(4 − r²)`, whose steps are
//!   smaller.

use num_bigint::BigInt;
use num_integer::Integer;

use crate::algebra::field::MAX_DEGREE;
use crate::arithmetic::polynomial::Polynomial;
use crate::definition::Key;
use crate::error::ErrorKind;
use crate::expression::{Expression, ExpressionKind, Input, parse_list};
use crate::symbolic::Constant;

/// The highest order of a named composition.
pub const MAX_ORDER: usize = 10;

/// A named composition.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scheme {
    /// The triple jump.
    TripleJump,
    /// Suzuki's fractal.
    Suzuki,
}

impl Scheme {
    /// The names in definitions.
    pub const NAMES: [&str; 2] = ["triple_jump", "suzuki"];

    /// Reads `triple_jump(4)`; the returned expression is the order.
    pub fn find(item: &Expression) -> Option<(Self, &Expression)> {
        let ExpressionKind::Call {
            function,
            arguments,
            ..
        } = &item.kind
        else {
            return None;
        };
        let all = [Scheme::TripleJump, Scheme::Suzuki];
        let scheme = all.into_iter().find(|scheme| scheme.name() == function)?;
        match arguments.as_slice() {
            [order] => Some((scheme, order)),
            _ => None,
        }
    }

    /// Reads the weights of a definition; `None` if they are others, or of no known order.
    pub fn parse(weights: &str) -> Option<(Self, u32)> {
        let input = Input {
            name: Key::Weights.name(),
            text: weights,
        };
        let items = parse_list(input).ok()?;
        let [item] = items.as_slice() else {
            return None;
        };
        let (scheme, order) = Scheme::find(item)?;
        let order = u32::try_from(order.whole(input).ok()?).ok()?;
        (order as usize <= MAX_ORDER).then_some((scheme, order))
    }

    /// The name in definitions.
    pub fn name(self) -> &'static str {
        match self {
            Scheme::TripleJump => Self::NAMES[0],
            Scheme::Suzuki => Self::NAMES[1],
        }
    }

    /// The fractions that turn a symmetric method of order `from` into one of order `to`.
    ///
    /// All roots are powers of one number, `2^{1/n}` with the least common multiple `n` of the `p + 1`, if its
    /// field is within the bounds of number fields. Otherwise each root is a separate number.
    ///
    /// # Errors
    /// None up to [`MAX_ORDER`]; [`ErrorKind::ExpressionSize`] if a constant would be too long.
    pub fn fractions(self, from: usize, to: usize) -> Result<Vec<Constant>, ErrorKind> {
        let orders = || (from..to).step_by(2);
        let common = orders().fold(1, |n, p| n.lcm(&(p + 1)));
        let mut fractions = vec![Constant::one()];
        for p in orders() {
            let root = if common <= MAX_DEGREE {
                root_of_two(common)?.power(exponent(common / (p + 1)))?
            } else {
                root_of_two(p + 1)?
            };
            let (root, whole) = match self {
                Scheme::TripleJump => (root, 2),
                Scheme::Suzuki => (root.power(2)?, 4),
            };
            let outer = Constant::whole(whole).subtract(&root)?.inverse()?;
            let inner = root.multiply(&outer)?.negate()?;
            let outers = whole as usize / 2;
            let level = std::iter::repeat_n(&outer, outers)
                .chain([&inner])
                .chain(std::iter::repeat_n(&outer, outers));
            let mut raised = Vec::new();
            for factor in level {
                for fraction in &fractions {
                    raised.push(fraction.multiply(factor)?);
                }
            }
            fractions = raised;
        }
        Ok(fractions)
    }
}

/// Exponents are no larger than degrees of number fields.
fn exponent(value: usize) -> i32 {
    i32::try_from(value).unwrap_or(i32::MAX)
}

/// `2^{1/n}` for an odd `n`.
fn root_of_two(n: usize) -> Result<Constant, ErrorKind> {
    if n == 3 {
        return Constant::whole(2).cbrt();
    }
    let polynomial = &Polynomial::monomial(n) - &Polynomial::from_integers(&[2]);
    Constant::root(&polynomial, &BigInt::from(1))
}
