//! A step of the oscillator whose frequency the method is fitted to.

use num_rational::BigRational;
use num_traits::One;

use super::Fitted;
use crate::algebra::{Field, FieldElement};
use crate::arithmetic::rational::ratio;
use crate::error::ErrorKind;

/// By how much a step of the oscillator `q' = w p`, `p' = −w q` turns too far: the angle of the step minus `ν`, for small `ν`.
#[derive(Debug, Clone, PartialEq)]
pub enum PhaseError {
    /// The stages and the step are exact: proved.
    Exact,
    /// `coefficient·ν^power + …`: the step is not exact.
    Leading {
        /// The power of `ν`.
        power: usize,
        /// The coefficient.
        coefficient: FieldElement,
    },
    /// The angle is exact up to this power of `ν` at least.
    AtLeast {
        /// The power.
        power: usize,
    },
}

/// The length of the series.
const LENGTH: usize = 24;

impl Fitted {
    /// The phase error on the oscillator of the frequency `w`. The angle θ of a step has `cos θ = trace/2`, so that
    /// `trace/2 − cos ν = −(θ − ν) ν + …`.
    ///
    /// # Errors
    /// [`ErrorKind::Definition`] if a coefficient has no limit at `ν = 0`.
    pub fn phase_error(&self) -> Result<PhaseError, ErrorKind> {
        let exact = self.exact_on();
        let [cosine, sine] = [false, true].map(|sine| self.place_of_wave(sine));
        let both = |place: Option<usize>| {
            let lists = [&exact.velocities, &exact.forces];
            place.is_some_and(|place| lists.iter().all(|list| list.contains(&place)))
        };
        if both(cosine) && both(sine) {
            return Ok(PhaseError::Exact);
        }
        let field = &self.ring.field;
        let series = self.series(LENGTH)?;
        let [zero, one] = [BigRational::default(), BigRational::one()];
        let (zero, one) = (self.ring.rational(zero), self.ring.rational(one));
        let minus = self.ring.rational(ratio(-1, 1));
        // Σ_j Σ_k m_j[k] x_j[n − k]
        let coefficient = |m: &[Vec<FieldElement>], x: &[Vec<FieldElement>], n: usize| {
            let mut sum = zero.clone();
            for (m, x) in m.iter().zip(x) {
                let pairs = (0..=n).filter_map(|k| Some((m.get(k)?, x.get(n - k)?)));
                for (m, x) in pairs.filter(|(m, x)| !m.is_zero() && !x.is_zero()) {
                    sum = field.add(&sum, &field.multiply(m, x));
                }
            }
            sum
        };
        let mut trace = vec![zero.clone(); LENGTH];
        for starts_at_q in [true, false] {
            let start = |of_q: bool| {
                if of_q == starts_at_q {
                    one.clone()
                } else {
                    zero.clone()
                }
            };
            let stages = self.stages();
            let mut q: Vec<Vec<FieldElement>> = vec![vec![start(true)]; stages];
            let mut p: Vec<Vec<FieldElement>> = vec![vec![start(false)]; stages];
            let (mut q_end, mut p_end) = (vec![start(true)], vec![start(false)]);
            // Q = q + νaP, P = p − νãQ: each power follows from the lower ones.
            for n in 0..LENGTH - 1 {
                let next_q: Vec<FieldElement> =
                    series.a.iter().map(|row| coefficient(row, &p, n)).collect();
                let next_p: Vec<FieldElement> = series
                    .a_tilde
                    .iter()
                    .map(|row| field.multiply(&minus, &coefficient(row, &q, n)))
                    .collect();
                q_end.push(coefficient(&series.b, &p, n));
                p_end.push(field.multiply(&minus, &coefficient(&series.b_tilde, &q, n)));
                q.iter_mut().zip(next_q).for_each(|(q, x)| q.push(x));
                p.iter_mut().zip(next_p).for_each(|(p, x)| p.push(x));
            }
            let end = if starts_at_q { q_end } else { p_end };
            for (sum, x) in trace.iter_mut().zip(&end) {
                *sum = field.add(sum, x);
            }
        }
        let half = self.ring.rational(ratio(1, 2));
        let cosine = self
            .ring
            .wave(0, one, false, self.ring.rational(BigRational::one()));
        let length = i32::try_from(LENGTH).unwrap_or(i32::MAX);
        let cosine = self.ring.expansion(&cosine, 0, length);
        let mut differences = trace
            .iter()
            .zip(&cosine)
            .enumerate()
            .map(|(power, (x, y))| (power, field.subtract(&field.multiply(&half, x), y)));
        let leading = differences.find(|(_, x)| !x.is_zero());
        Ok(match leading {
            Some((power, x)) => PhaseError::Leading {
                power: power - 1,
                coefficient: field.multiply(&minus, &x),
            },
            None => PhaseError::AtLeast { power: LENGTH - 2 },
        })
    }

    /// The place of `cos(w·t)` or `sin(w·t)` in the basis.
    fn place_of_wave(&self, sine: bool) -> Option<usize> {
        let one = self.ring.rational(BigRational::one());
        self.basis.iter().position(|(_, f)| {
            let mut terms = f.terms();
            let first = terms.next().is_some_and(|(wave, _)| {
                wave.power == 0 && wave.sine == sine && wave.frequency == one
            });
            first && terms.next().is_none()
        })
    }
}
