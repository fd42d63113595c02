//! The end of one Kepler orbit of any kind.

use core::f64::consts::TAU;

use num_traits::Float;

use super::stumpff;
use crate::number::Scalar;

/// Why the end of an orbit is not known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum NoEnd {
    /// The body is at the centre.
    AtCentre,
    /// It passes through too many periods.
    Periods(f64),
    /// It is not finite, or half of its digits are lost.
    NotFound,
}

/// `[a, b, c, d]`: position and momentum change from `(q, p)` to `(q + a q + b p, p + c q + d p)`.
pub(super) type Change<T> = [T; 4];

/// Periods after which half of the digits of the phase are lost.
const MOST_PERIODS: f64 = (1_u64 << 26) as f64;

/// The maximum number of iterations: each halves the previous change, and this exceeds the number of bits and exponents.
const MOST: u32 = 1200;

/// An orbit: distance and its reciprocal, `q·v`, `2μ/r − v²`, μ, and the mass with its reciprocal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Orbit<T> {
    pub(super) distance: T,
    pub(super) inverse: T,
    pub(super) radial: T,
    pub(super) beta: T,
    pub(super) mu: T,
    pub(super) mass: [T; 2],
}

impl<T: Scalar> Orbit<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn new(mu: T, mass: [T; 2], q: [T; 3], p: [T; 3]) -> Self {
        let dot = |a: [T; 3], b: [T; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let distance = dot(q, q).sqrt();
        let inverse = distance.recip();
        let lighter = mass[1];
        let v = [p[0] * lighter, p[1] * lighter, p[2] * lighter];
        Self {
            distance,
            inverse,
            radial: dot(q, v),
            beta: (mu + mu) * inverse - dot(v, v),
            mu,
            mass,
        }
    }

    /// `ζ = μ − βr`
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn zeta(&self) -> T {
        self.mu - self.beta * self.distance
    }

    /// The distance at the end, and the distance below which cancellation has lost half of its digits.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn at_end(&self, radial: T, [g1, g2]: [T; 2]) -> (T, T) {
        let (first, second) = (radial * g1, self.zeta() * g2);
        let terms = self.distance + first.abs() + second.abs();
        let end = self.distance + (first + second);
        (end, terms * T::from_f64(MOST_PERIODS.recip()))
    }

    /// The change, from the functions `G1` and `G2`, the distance at the end, and g.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn change(&self, [g1, g2]: [T; 2], end: T, g: T) -> Change<T> {
        let Self { inverse, mu, .. } = *self;
        let [mass, lighter] = self.mass;
        let at_end = end.recip();
        let pull = -mu * g2;
        [
            pull * inverse,
            g * lighter,
            -(mass * mu) * (g1 * inverse) * at_end,
            pull * at_end,
        ]
    }
}

/// `G1`, `G2`, `G3` at `s`, from `c_2` and `c_3` at `ψ = βs²`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn g_functions<T: Scalar>(s: T, psi: T, (c2, c3): (T, T)) -> [T; 3] {
    let square = s * s;
    [s * (T::one() - psi * c3), square * c2, square * s * c3]
}

impl Orbit<f64> {
    /// The change in the time `h`, for every orbit: ellipse, parabola, hyperbola and line.
    ///
    /// The universal anomaly s, `t' = r`, is the zero of a monotone function. Newton's iteration is safeguarded by bisection.
    pub(super) fn end(&self, h: f64) -> Result<Change<f64>, NoEnd> {
        let Self {
            distance,
            radial,
            beta,
            ..
        } = *self;
        if distance == 0.0 {
            return Err(NoEnd::AtCentre);
        }
        if ![distance, radial, beta, h].iter().all(|x| x.is_finite()) {
            return Err(NoEnd::NotFound);
        }
        let h = self.without_periods(h)?;
        if h == 0.0 {
            return Ok([0.0; 4]);
        }
        // Backward is forward with the opposite velocity.
        let (time, radial, sign) = (h.abs(), radial * h.signum(), h.signum());
        let zeta = self.zeta();
        let at = |s: f64| {
            let psi = beta * s * s;
            let [g1, g2, g3] = g_functions(s, psi, stumpff::any(psi));
            let value = distance * s + (radial * g2 + zeta * g3) - time;
            // A function that overflows does so above the zero, whatever the sum of infinities.
            let value = if value.is_finite() {
                value
            } else {
                f64::INFINITY
            };
            (value, self.at_end(radial, [g1, g2]), [g1, g2])
        };
        let (mut low, mut high) = (0.0, time / distance);
        while at(high).0 < 0.0 {
            (low, high) = (high, 2.0 * high);
        }
        let mut s = low + (high - low) / 2.0;
        let mut before = high - low;
        for _ in 0..MOST {
            let (value, (slope, _), _) = at(s);
            if value < 0.0 {
                low = s;
            } else {
                high = s;
            }
            let newton = s - value / slope;
            let inside = newton > low && newton < high;
            let next = if value == 0.0 {
                s
            } else if inside && (2.0 * (newton - s)).abs() <= before {
                newton
            } else {
                low + (high - low) / 2.0
            };
            before = (next - s).abs();
            s = next;
            if before <= f64::EPSILON * s {
                let (_, (end, least), [g1, g2]) = at(s);
                if end <= 0.0 {
                    return Err(NoEnd::AtCentre);
                }
                if end < least {
                    return Err(NoEnd::NotFound);
                }
                let g = distance * g1 + radial * g2;
                let change = self.change([sign * g1, g2], end, sign * g);
                let finite = change.iter().all(|x| x.is_finite());
                return finite.then_some(change).ok_or(NoEnd::NotFound);
            }
        }
        Err(NoEnd::NotFound)
    }

    /// The time without whole periods.
    fn without_periods(&self, h: f64) -> Result<f64, NoEnd> {
        if self.beta <= 0.0 {
            return Ok(h);
        }
        let period = TAU * self.mu / (self.beta * Scalar::sqrt(self.beta));
        let periods = Float::round(h / period);
        if periods.abs() >= MOST_PERIODS {
            return Err(NoEnd::Periods(periods.abs()));
        }
        Ok(if periods == 0.0 {
            h
        } else {
            libm::fma(-periods, period, h)
        })
    }
}
