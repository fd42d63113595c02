//! Sums of terms `r·νᵏ·cos(φν)` and `r·νᵏ·sin(φν)`, with `r` and `φ` in a number field.
//!
//! Exponentials with different real frequencies are linearly independent over the rational functions of `ν`. So a sum is the
//! function 0 iff it has no terms, and the sums are an integral domain.

use num_rational::BigRational;
use num_traits::{One, Signed, Zero as _};

use crate::algebra::{Constants, Field, FieldElement};
use crate::arithmetic::rational::ratio;

/// `νᵏ·cos(φν)` or `νᵏ·sin(φν)`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Wave {
    /// `k`, which may be negative.
    pub power: i32,
    /// `φ`; of `φ` and `−φ` the one with a positive first coefficient.
    pub frequency: FieldElement,
    /// Whether it is a sine.
    pub sine: bool,
}

/// A sum of waves with their coefficients, each wave once.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Waves(Vec<(Wave, FieldElement)>);

impl Waves {
    /// The terms.
    pub fn terms(&self) -> impl Iterator<Item = (&Wave, &FieldElement)> {
        self.0.iter().map(|(wave, coefficient)| (wave, coefficient))
    }

    /// Whether it is the function 0.
    pub fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The lowest power of `ν`.
    pub fn lowest_power(&self) -> Option<i32> {
        self.0.iter().map(|(wave, _)| wave.power).min()
    }
}

/// The domain of these sums over a number field.
#[derive(Debug, Clone)]
pub struct Ring {
    /// The field of coefficients and frequencies.
    pub field: Constants,
}

impl Ring {
    /// An element of the field.
    pub fn rational(&self, value: BigRational) -> FieldElement {
        self.field.rational(&value)
    }

    /// A constant function.
    pub fn constant(&self, value: FieldElement) -> Waves {
        self.wave(0, self.rational(BigRational::zero()), false, value)
    }

    /// The function 1.
    pub fn one(&self) -> Waves {
        self.constant(self.rational(BigRational::one()))
    }

    /// `coefficient·ν^power·cos(frequency·ν)`, or with the sine.
    pub fn wave(
        &self,
        power: i32,
        frequency: FieldElement,
        sine: bool,
        coefficient: FieldElement,
    ) -> Waves {
        let mut sum = Waves::default();
        self.insert(&mut sum, power, frequency, sine, coefficient);
        sum
    }

    fn insert(
        &self,
        sum: &mut Waves,
        power: i32,
        frequency: FieldElement,
        sine: bool,
        coefficient: FieldElement,
    ) {
        if coefficient.is_zero() || sine && frequency.is_zero() {
            return;
        }
        let zero = self.rational(BigRational::zero());
        let negated = is_negated(&frequency);
        let (frequency, coefficient) = match (negated, sine) {
            (false, _) => (frequency, coefficient),
            (true, false) => (self.field.subtract(&zero, &frequency), coefficient),
            (true, true) => (
                self.field.subtract(&zero, &frequency),
                self.field.subtract(&zero, &coefficient),
            ),
        };
        let wave = Wave {
            power,
            frequency,
            sine,
        };
        match sum.0.iter().position(|(known, _)| *known == wave) {
            None => sum.0.push((wave, coefficient)),
            Some(index) => {
                let total = self.field.add(&sum.0[index].1, &coefficient);
                if total.is_zero() {
                    sum.0.swap_remove(index);
                } else {
                    sum.0[index].1 = total;
                }
            }
        }
    }

    /// The sum.
    pub fn add(&self, x: &Waves, y: &Waves) -> Waves {
        let mut sum = x.clone();
        for (wave, coefficient) in y.terms() {
            let Wave {
                power,
                frequency,
                sine,
            } = wave.clone();
            self.insert(&mut sum, power, frequency, sine, coefficient.clone());
        }
        sum
    }

    /// The product with an element of the field and a power of `ν`.
    pub fn scale(&self, x: &Waves, factor: &FieldElement, power: i32) -> Waves {
        if factor.is_zero() {
            return Waves::default();
        }
        let scaled = x.terms().map(|(wave, coefficient)| {
            let wave = Wave {
                power: wave.power + power,
                ..wave.clone()
            };
            (wave, self.field.multiply(coefficient, factor))
        });
        Waves(scaled.collect())
    }

    /// The difference.
    pub fn subtract(&self, x: &Waves, y: &Waves) -> Waves {
        self.add(x, &self.scale(y, &self.rational(ratio(-1, 1)), 0))
    }

    /// The product.
    pub fn multiply(&self, x: &Waves, y: &Waves) -> Waves {
        let half = self.rational(ratio(1, 2));
        let minus_half = self.rational(ratio(-1, 2));
        let mut product = Waves::default();
        for (v, r) in x.terms() {
            for (w, s) in y.terms() {
                let coefficient = self.field.multiply(r, s);
                let power = v.power + w.power;
                if v.frequency.is_zero() || w.frequency.is_zero() {
                    let frequency = self.field.add(&v.frequency, &w.frequency);
                    let sine = v.sine || w.sine;
                    self.insert(&mut product, power, frequency, sine, coefficient);
                    continue;
                }
                let sum = self.field.add(&v.frequency, &w.frequency);
                let difference = match (v.sine, w.sine) {
                    // sin y cos x = (sin(y + x) + sin(y − x))/2
                    (false, true) => self.field.subtract(&w.frequency, &v.frequency),
                    _ => self.field.subtract(&v.frequency, &w.frequency),
                };
                let both = v.sine && w.sine;
                let of_sum = if both { &minus_half } else { &half };
                let sine = v.sine != w.sine;
                let first = self.field.multiply(&coefficient, of_sum);
                let second = self.field.multiply(&coefficient, &half);
                self.insert(&mut product, power, sum, sine, first);
                self.insert(&mut product, power, difference, sine, second);
            }
        }
        product
    }

    /// The determinant of a square matrix.
    pub fn determinant(&self, rows: &[Vec<Waves>]) -> Waves {
        let Some((first, rest)) = rows.split_first() else {
            return self.one();
        };
        let mut sum = Waves::default();
        for (column, entry) in first.iter().enumerate().filter(|(_, x)| !x.is_zero()) {
            let minor: Vec<Vec<Waves>> = rest.iter().map(|row| without(row, column)).collect();
            let term = self.multiply(entry, &self.determinant(&minor));
            sum = if column.is_multiple_of(2) {
                self.add(&sum, &term)
            } else {
                self.subtract(&sum, &term)
            };
        }
        sum
    }

    /// The adjugate of a square matrix: its inverse times its determinant.
    pub fn adjugate(&self, rows: &[Vec<Waves>]) -> Vec<Vec<Waves>> {
        let size = rows.len();
        let cofactor = |row: usize, column: usize| {
            let minor: Vec<Vec<Waves>> = (0..size)
                .filter(|&i| i != row)
                .map(|i| without(&rows[i], column))
                .collect();
            let minor = self.determinant(&minor);
            match (row + column).is_multiple_of(2) {
                true => minor,
                false => self.subtract(&Waves::default(), &minor),
            }
        };
        let row = |i: usize| (0..size).map(|j| cofactor(j, i)).collect();
        (0..size).map(row).collect()
    }

    /// `∫_0^c tᵏ cos(φνt) dt`, or with the sine, as a function of `ν`.
    pub fn integral(
        &self,
        c: &FieldElement,
        power: u32,
        frequency: &FieldElement,
        sine: bool,
    ) -> Waves {
        let whole = |n: u32| self.rational(BigRational::from_integer(n.into()));
        let end = self.power(c, power);
        let Some(inverse) = self.field.inverse(frequency) else {
            if sine {
                return Waves::default();
            }
            let value = self.field.multiply(&end, c);
            let divided = self.field.multiply(
                &value,
                &self.rational(BigRational::new(1.into(), (power + 1).into())),
            );
            return self.constant(divided);
        };
        // By parts: [tᵏ sin(at)]/a − (k/a)∫tᵏ⁻¹ sin(at), and −[tᵏ cos(at)]/a + (k/a)∫tᵏ⁻¹ cos(at), with a = φν.
        let angle = self.field.multiply(frequency, c);
        let sign = self.rational(ratio(if sine { -1 } else { 1 }, 1));
        let mut ends = self.wave(0, angle, !sine, end);
        if sine && power == 0 {
            ends = self.subtract(&ends, &self.one());
        }
        let mut integral = self.scale(&ends, &self.field.multiply(&sign, &inverse), -1);
        if power > 0 {
            let rest = self.integral(c, power - 1, frequency, !sine);
            let factor = self
                .field
                .multiply(&whole(power), &self.field.multiply(&sign, &inverse));
            integral = self.subtract(&integral, &self.scale(&rest, &factor, -1));
        }
        integral
    }

    /// A power of an element of the field.
    pub fn power(&self, x: &FieldElement, exponent: u32) -> FieldElement {
        let one = self.rational(BigRational::one());
        (0..exponent).fold(one, |product, _| self.field.multiply(&product, x))
    }

    /// The coefficients of `νᵏ` for `k` from `start` to `end`, exclusively.
    pub fn expansion(&self, x: &Waves, start: i32, end: i32) -> Vec<FieldElement> {
        let zero = self.rational(BigRational::zero());
        let mut series = vec![zero; usize::try_from(end - start).unwrap_or(0)];
        for (wave, coefficient) in x.terms() {
            // cos z = 1 − z²/2 + …, sin z = z − z³/6 + …
            let mut exponent = i32::from(wave.sine);
            let mut term = match wave.sine {
                true => self.field.multiply(coefficient, &wave.frequency),
                false => coefficient.clone(),
            };
            let square = self.field.multiply(&wave.frequency, &wave.frequency);
            while wave.power + exponent < end && !term.is_zero() {
                let index = usize::try_from(wave.power + exponent - start).ok();
                if let Some(entry) = index.and_then(|index| series.get_mut(index)) {
                    *entry = self.field.add(entry, &term);
                }
                let next = i64::from((exponent + 1) * (exponent + 2));
                let factor = self
                    .field
                    .multiply(&square, &self.rational(ratio(-1, next)));
                term = self.field.multiply(&term, &factor);
                exponent += 2;
            }
        }
        series
    }

    /// The sum as text, in the grammar of expressions, with this name for `ν`.
    pub fn display(&self, x: &Waves, name: &str) -> String {
        let mut text = String::new();
        for (wave, coefficient) in x.terms() {
            let factors = self.factors(wave, name);
            let number = self.field.exact(coefficient).unwrap_or_default();
            let is_sum = number.get(1..).is_some_and(|rest| rest.contains([' ']));
            let (minus, number) = match number.strip_prefix('-') {
                Some(rest) if !is_sum => (true, rest.to_owned()),
                _ if is_sum => (false, format!("({number})")),
                _ => (false, number),
            };
            let sign = match (text.is_empty(), minus) {
                (true, true) => "-",
                (true, false) => "",
                (false, true) => " - ",
                (false, false) => " + ",
            };
            let product = match (number.as_str(), factors.is_empty()) {
                (_, true) => number,
                ("1", false) => factors,
                (_, false) => format!("{number}*{factors}"),
            };
            text.push_str(&format!("{sign}{product}"));
        }
        if text.is_empty() {
            "0".to_owned()
        } else {
            text
        }
    }

    fn factors(&self, wave: &Wave, name: &str) -> String {
        let power = match wave.power {
            0 => None,
            1 => Some(name.to_owned()),
            k => Some(format!("{name}^{k}")),
        };
        let function = (!wave.frequency.is_zero()).then(|| {
            let frequency = self.field.exact(&wave.frequency).unwrap_or_default();
            let angle = match frequency.as_str() {
                "1" => name.to_owned(),
                text if text.contains(' ') => format!("({text})*{name}"),
                text => match text.strip_prefix("1/") {
                    Some(divisor) => format!("{name}/{divisor}"),
                    None => format!("{text}*{name}"),
                },
            };
            format!("{}({angle})", if wave.sine { "sin" } else { "cos" })
        });
        let both: Vec<String> = power.into_iter().chain(function).collect();
        both.join("*")
    }
}

/// Whether the first coefficient of an element is negative.
fn is_negated(x: &FieldElement) -> bool {
    let first = x.numerator().first().and_then(|number| {
        let mut coefficients = number.coefficients().into_iter();
        coefficients.find(|q| !q.is_zero())
    });
    first.is_some_and(|q| q.is_negative())
}

fn without(row: &[Waves], column: usize) -> Vec<Waves> {
    let others = row.iter().enumerate().filter(|(j, _)| *j != column);
    others.map(|(_, x)| x.clone()).collect()
}
