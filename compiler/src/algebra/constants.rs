//! The field of some given constants.

use std::collections::{HashMap, HashSet};
use std::num::NonZeroU32;
use std::sync::OnceLock;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{Signed, ToPrimitive, Zero as _};

use super::field::{ConstantField, Extension, FieldElement, Notation, NumberField, Transcendental};
use super::{Field, Image, Number, Zero};
use crate::arithmetic::algebraic_number::AlgebraicNumber;
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::rational::{length, ratio};
use crate::expression::{Input, parse_list};
use crate::symbolic::{Constant, Tree};

/// The most bits of a common denominator of elements: that of decimals with 154 places.
const LONGEST_DENOMINATOR: u64 = 512;

/// A [`ConstantField`] together with the elements that represent the algebraic and transcendental parts of some
/// constants.
#[derive(Debug, Clone)]
pub struct Constants {
    field: ConstantField,
    /// The radicals and roots.
    algebraic: HashMap<Constant, Polynomial>,
    /// `cos(π/n)`, where all angles are multiples of `π/n`.
    cosine: Option<(u32, Polynomial)>,
    /// The constants for which the field was constructed.
    known: HashMap<Constant, FieldElement>,
    /// Homomorphisms to finite fields, computed on demand.
    images: OnceLock<Vec<Image>>,
}

/// The number of homomorphisms. Each maps a given nonzero element to zero about once in millions of cases.
const IMAGES: usize = 3;

/// Longer texts are not readable for people, and would not be read again.
const LONGEST_TEXT: usize = 2000;
/// The largest product of the degree in `X` and the square root of the number of constants: the cost of elimination among
/// rational functions grows with both.
const MAX_DEGREES: f64 = 160.0;
/// Rationals with at most this many bits cost no more than short ones.
const USUAL_BITS: u64 = 128;
/// The largest product of the bits beyond [`USUAL_BITS`] and the degrees in `X` and `θ`: with long rationals, exact arithmetic takes
/// far longer than enclosures.
const MAX_LENGTH: f64 = 2048.0;

impl PartialEq for Constants {
    fn eq(&self, other: &Self) -> bool {
        self.field.algebraic() == other.field.algebraic()
            && self.field.generator() == other.field.generator()
    }
}

/// The parts of constants that determine a field.
#[derive(Default)]
struct Parts {
    pi: bool,
    /// The least common denominators of the exponents, the arguments in radians and the multiples of π.
    exponents: Option<u32>,
    radians: Option<u32>,
    angles: Option<u32>,
    /// Radicals and roots; nested ones come first.
    radicals: Vec<Constant>,
    seen: HashSet<Constant>,
    /// All exponents and arguments in radians, and powers of π.
    arguments: Vec<BigRational>,
    /// The largest number of bits of a rational.
    bits: u64,
}

/// The least common multiple of a denominator and the previous ones; `None` if it is too large.
fn common(known: Option<u32>, value: &BigRational) -> Option<Option<u32>> {
    let denominator = value.denom().to_u32()?;
    let all = u64::from(known.unwrap_or(1)).lcm(&u64::from(denominator));
    Some(Some(u32::try_from(all).ok()?))
}

impl Parts {
    /// Collects the parts of a constant; `None` if a part is in no constant field.
    fn collect(&mut self, constant: &Constant) -> Option<()> {
        if let Tree::Rational(value) = constant.tree() {
            self.note(value);
            return Some(());
        }
        if !self.seen.insert(constant.clone()) {
            return Some(());
        }
        match constant.tree() {
            Tree::Rational(_) => {}
            Tree::Pi => self.pi = true,
            Tree::Root(root) => {
                let bits = root.polynomial.numerators().iter().map(BigInt::bits).max();
                self.bits = self.bits.max(bits.unwrap_or(0));
                self.radicals.push(constant.clone());
            }
            Tree::Sqrt(x) | Tree::Cbrt(x) => {
                self.collect(x)?;
                self.radicals.push(constant.clone());
            }
            Tree::Exp(x) => {
                let exponent = x.as_rational()?;
                self.exponents = common(self.exponents, exponent)?;
                self.arguments.push(exponent.abs());
            }
            Tree::Cos(x) | Tree::Sin(x) => {
                let (radians, turns) = x.linear_in_pi()?;
                if !radians.is_zero() {
                    self.radians = common(self.radians, &radians)?;
                    self.arguments.push(radians.abs());
                }
                // The sine is the cosine of the complement.
                self.angles = common(self.angles, &turns)?;
                self.angles = common(self.angles, &(ratio(1, 2) - turns))?;
            }
            Tree::Ln(_) => return None,
            Tree::Product(factors) => {
                for (x, exponent) in factors {
                    let power = u64::from(exponent.unsigned_abs());
                    match x.tree() {
                        Tree::Pi => self.arguments.push(ratio(i64::from(exponent.abs()), 1)),
                        // Written out, its powers would be longer and of a higher degree.
                        Tree::Sum(..) => {
                            let mut inside = Parts::default();
                            inside.collect(x)?;
                            if inside.transcendental()?.is_some() {
                                let degree = inside.arguments.iter().max().cloned();
                                let degree = degree.unwrap_or_else(|| ratio(1, 1));
                                let power = BigRational::from_integer(power.into());
                                self.arguments.push(degree * power);
                            }
                            self.bits = self.bits.max(inside.bits.saturating_mul(power));
                        }
                        _ => {}
                    }
                    self.collect(x)?;
                }
            }
            Tree::Sum(value, terms) => {
                self.note(value);
                for (x, factor) in terms {
                    self.note(factor);
                    self.collect(x)?;
                }
            }
        }
        Some(())
    }

    /// Records the length of a rational.
    fn note(&mut self, value: &BigRational) {
        let bits = length(value);
        self.bits = self.bits.max(bits);
    }

    /// Whether arithmetic is fast enough in a field with this degree in `X` and this degree of `θ`.
    fn are_short(&self, transcendental: f64, algebraic: usize) -> bool {
        let beyond = self.bits.saturating_sub(USUAL_BITS) as f64;
        let degrees = (1.0 + transcendental) * algebraic as f64;
        degrees <= 1.0 || beyond * degrees <= MAX_LENGTH
    }

    /// The largest power of `X` in an exponential, a sine or a cosine.
    fn degree(&self) -> Option<f64> {
        let denominator = self.exponents.or(self.radians).unwrap_or(1);
        let Some(largest) = self.arguments.iter().max() else {
            return Some(0.0);
        };
        (largest * BigRational::from_integer(denominator.into())).to_f64()
    }

    /// The transcendental number; `None` if there are several.
    fn transcendental(&self) -> Option<Option<Transcendental>> {
        let one = |n: Option<u32>| n.and_then(NonZeroU32::new);
        let kinds = [
            self.pi.then_some(Transcendental::Pi),
            one(self.exponents).map(|denominator| Transcendental::Exponential { denominator }),
            one(self.radians).map(|denominator| Transcendental::HalfAngleTangent { denominator }),
        ];
        let mut kinds = kinds.into_iter().flatten();
        let first = kinds.next();
        kinds.next().is_none().then_some(first)
    }
}

impl Constants {
    /// The field.
    pub fn field(&self) -> &ConstantField {
        &self.field
    }

    /// The smallest field known to hold all constants. `None` if they are not algebraic over one transcendental number: π, `e^{1/n}`
    /// or `tan(1/(2n))`. Also if a degree exceeds the bounds of number fields, or of rational functions for this number of
    /// constants.
    pub fn containing<'a>(constants: impl IntoIterator<Item = &'a Constant>) -> Option<Self> {
        let constants: Vec<&Constant> = constants.into_iter().collect();
        let mut parts = Parts::default();
        for constant in &constants {
            parts.collect(constant)?;
        }
        let transcendental = parts.transcendental()?;
        // The first powers of X; there is at least one.
        let degree = parts.degree()?;
        let powers = transcendental.map_or(0.0, |_| degree.max(1.0));
        let size = (1.0 + degree) * (constants.len() as f64).sqrt();
        if size > MAX_DEGREES || !parts.are_short(powers, 1) {
            return None;
        }
        let mut result = Constants {
            field: ConstantField::new(NumberField::rationals(), transcendental),
            algebraic: HashMap::new(),
            cosine: None,
            known: HashMap::new(),
            images: OnceLock::new(),
        };
        if let Some(n) = parts.angles.filter(|&n| n > 1) {
            let extension = result.field.algebraic().cosine(n)?;
            result.extend(&extension);
            result.cosine = Some((n, extension.number));
        }
        for radical in &parts.radicals {
            let number_field = result.field.algebraic();
            let order = match radical.tree() {
                Tree::Root(root) => root.polynomial.degree().unwrap_or(1),
                Tree::Cbrt(_) => 3,
                _ => 2,
            };
            if !parts.are_short(powers, order * number_field.degree()) {
                return None;
            }
            let inner = |x: &Constant| result.element(x)?.as_algebraic();
            let extension = match radical.tree() {
                Tree::Sqrt(x) => number_field.square_root(&inner(x)?)?,
                Tree::Cbrt(x) => number_field.cube_root(&inner(x)?)?,
                Tree::Root(root) => {
                    let number = AlgebraicNumber::real_root(&root.polynomial, root.index)?;
                    number_field.adjoin(&number, Notation::Powers(radical.to_string()))?
                }
                _ => return None,
            };
            result.extend(&extension);
            result.algebraic.insert(radical.clone(), extension.number);
        }
        // Without rational functions elimination is as fast as the field.
        let degree = result.field.algebraic().degree() as f64;
        if transcendental.is_some() && size * degree > MAX_DEGREES {
            return None;
        }
        for constant in constants {
            if constant.as_rational().is_none() && !result.known.contains_key(constant) {
                let element = result.element(constant)?;
                result.known.insert(constant.clone(), element);
            }
        }
        Some(result)
    }

    /// Moves to a larger number field.
    fn extend(&mut self, extension: &Extension) {
        self.field = self.field.extended(extension);
        for image in self.algebraic.values_mut() {
            *image = extension.embed(image);
        }
        if let Some((_, image)) = &mut self.cosine {
            *image = extension.embed(image);
        }
    }

    /// A constant whose parts are known here.
    fn element(&self, constant: &Constant) -> Option<FieldElement> {
        let field = &self.field;
        match constant.tree() {
            Tree::Rational(value) => Some(field.rational(value.clone())),
            Tree::Pi => field
                .transcendental()
                .filter(|_| matches!(field.generator(), Some(Transcendental::Pi))),
            Tree::Root(_) | Tree::Sqrt(_) | Tree::Cbrt(_) => {
                let image = self.algebraic.get(constant)?;
                Some(field.from_algebraic(image))
            }
            Tree::Exp(x) => match field.generator()? {
                Transcendental::Exponential { denominator } => {
                    field.exponential(multiple(x.as_rational()?, denominator.get())?)
                }
                _ => None,
            },
            Tree::Cos(x) => Some(self.sine_cosine(x)?.1),
            Tree::Sin(x) => Some(self.sine_cosine(x)?.0),
            Tree::Ln(_) => None,
            Tree::Product(factors) => {
                let mut product = field.one();
                for (x, exponent) in factors {
                    let power = field.power(&self.element(x)?, *exponent)?;
                    product = field.multiply(&product, &power);
                }
                Some(product)
            }
            Tree::Sum(value, terms) => {
                let mut sum = field.rational(value.clone());
                for (x, factor) in terms {
                    let term = field.multiply(&self.element(x)?, &field.rational(factor.clone()));
                    sum = field.add(&sum, &term);
                }
                Some(sum)
            }
        }
    }

    /// `sin x` and `cos x` for `x = q₀ + q₁π`.
    fn sine_cosine(&self, x: &Constant) -> Option<(FieldElement, FieldElement)> {
        let field = &self.field;
        let (radians, turns) = x.linear_in_pi()?;
        let sine = self.cosine_of(&(ratio(1, 2) - &turns))?;
        let cosine = self.cosine_of(&turns)?;
        if radians.is_zero() {
            return Some((sine, cosine));
        }
        let Transcendental::HalfAngleTangent { denominator } = field.generator()? else {
            return None;
        };
        let (s, c) = field.sine_cosine(multiple(&radians, denominator.get())?)?;
        // sin(x + y) and cos(x + y)
        let product = |x, y| field.multiply(x, y);
        Some((
            field.add(&product(&s, &cosine), &product(&c, &sine)),
            field.subtract(&product(&c, &cosine), &product(&s, &sine)),
        ))
    }

    /// `cos(q π)`.
    fn cosine_of(&self, turns: &BigRational) -> Option<FieldElement> {
        let Some((n, cosine)) = &self.cosine else {
            // Integer multiples of π only.
            let whole = turns.is_integer().then(|| turns.to_integer());
            let value = match whole {
                Some(whole) if whole.is_even() => 1,
                Some(_) => -1,
                None => return None,
            };
            return Some(self.field.rational(ratio(value, 1)));
        };
        let scaled = turns.abs() * BigRational::from_integer((*n).into());
        let period = BigInt::from(2 * u64::from(*n));
        let k = scaled
            .is_integer()
            .then(|| scaled.to_integer().mod_floor(&period))?
            .to_u32()?;
        let value = self.field.algebraic().cosine_of_multiple(cosine, k);
        Some(self.field.from_algebraic(&value))
    }

    /// The field, if it consists of algebraic numbers.
    pub fn number_field(&self) -> Option<&NumberField> {
        let algebraic = self.field.generator().is_none();
        algebraic.then(|| self.field.algebraic())
    }

    /// Whether an element is zero.
    pub fn is_zero(&self, x: &FieldElement) -> bool {
        x.is_zero()
    }

    /// An element as a constant; `None` if it is beyond the bounds of constants.
    pub fn to_constant(&self, x: &FieldElement) -> Option<Constant> {
        // The printed text is read again.
        let text = self.field.display(x);
        let input = Input {
            name: "constant",
            text: &text,
        };
        let items = parse_list(input).ok()?;
        items.first()?.constant(input).ok()
    }
}

/// The `k` with `value = k/n`.
fn multiple(value: &BigRational, n: u32) -> Option<i32> {
    let scaled = value * BigRational::from_integer(n.into());
    scaled.is_integer().then(|| scaled.to_integer().to_i32())?
}

impl Field for Constants {
    type Element = FieldElement;

    fn rational(&self, value: &BigRational) -> FieldElement {
        self.field.rational(value.clone())
    }

    fn constant(&self, value: &Constant) -> Option<FieldElement> {
        match self.known.get(value) {
            Some(element) => Some(element.clone()),
            None => self.element(value),
        }
    }

    fn add(&self, x: &FieldElement, y: &FieldElement) -> FieldElement {
        self.field.add(x, y)
    }

    fn subtract(&self, x: &FieldElement, y: &FieldElement) -> FieldElement {
        self.field.subtract(x, y)
    }

    fn multiply(&self, x: &FieldElement, y: &FieldElement) -> FieldElement {
        self.field.multiply(x, y)
    }

    fn inverse(&self, x: &FieldElement) -> Option<FieldElement> {
        self.field.inverse(x)
    }

    fn verified_bits(&self) -> Option<u32> {
        None
    }

    fn zero(&self, x: &FieldElement) -> Zero {
        if x.is_zero() { Zero::Yes } else { Zero::No }
    }

    /// The simplest candidate, so that elements stay short.
    fn pivot(&self, candidates: &[&FieldElement]) -> Option<usize> {
        let nonzero = candidates.iter().enumerate().filter(|(_, x)| !x.is_zero());
        let length =
            |list: &[Polynomial]| -> usize { list.iter().map(|c| c.coefficients().len()).sum() };
        nonzero
            .min_by_key(|(_, x)| length(x.numerator()) + length(x.denominator()))
            .map(|(index, _)| index)
    }

    fn common_denominator<'a>(
        &self,
        elements: impl Iterator<Item = &'a FieldElement>,
    ) -> BigRational {
        let polynomials = elements.flat_map(FieldElement::numerator);
        let mut common = BigInt::from(1);
        for denominator in polynomials.map(Polynomial::denominator) {
            let lcm = common.lcm(denominator);
            // Unrelated denominators have a product that is longer than the fractions.
            if lcm.bits() > LONGEST_DENOMINATOR {
                return BigRational::from_integer(1.into());
            }
            common = lcm;
        }
        BigRational::from_integer(common)
    }

    fn number(&self, x: &FieldElement) -> Number<'_> {
        match x.as_rational() {
            Some(value) => Number::Rational(value),
            None => Number::Field(&self.field, x.clone()),
        }
    }

    fn exact(&self, x: &FieldElement) -> Option<String> {
        let text = self.field.display(x);
        (text.len() <= LONGEST_TEXT).then_some(text)
    }

    fn images(&self) -> &[Image] {
        self.images
            .get_or_init(|| Image::several(&self.field, IMAGES))
    }

    fn image(&self, x: &FieldElement, image: &Image) -> Option<u64> {
        image.of(x)
    }

    fn is_costly(&self) -> bool {
        self.field.generator().is_some()
    }

    fn length(&self, x: &FieldElement) -> u64 {
        let lists = [x.numerator(), x.denominator()];
        let words = |c: &Polynomial| -> u64 {
            let bits: u64 = c.numerators().iter().map(BigInt::bits).sum();
            (bits + c.denominator().bits()) / 64
        };
        let polynomials = || lists.into_iter().flatten();
        let total: u64 = polynomials().map(words).sum();
        if !self.is_costly() {
            // Products of algebraic numbers cost less, and little if their coefficients are short.
            return total / 8;
        }
        total
            + polynomials()
                .map(|c| c.numerators().len() as u64)
                .sum::<u64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn has_a_field(text: &str) -> bool {
        let input = Input { name: "", text };
        let items = parse_list(input).expect(text);
        let constants = items.iter().map(|item| item.constant(input).expect(text));
        let constants: Vec<Constant> = constants.collect();
        Constants::containing(&constants).is_some()
    }

    /// Exact arithmetic with `(π − 355/113)¹⁰⁰`, a polynomial of degree 100 with coefficients of 800 bits, takes minutes.
    #[test]
    fn powers_of_sums_are_as_long_as_they_are_written_out() {
        assert!(has_a_field("(pi - 22/7)^2, pi^3"));
        assert!(has_a_field("(1 + sqrt(2))^20"));
        assert!(!has_a_field("(pi - 355/113)^100"));
        assert!(!has_a_field("(1 + pi)^200"));
    }
}
