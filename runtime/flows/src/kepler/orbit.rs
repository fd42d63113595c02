//! The end of one Kepler orbit of any kind.

use core::f64::consts::TAU;

use num_traits::Float;

use super::path::{self, Functions, Path};
use symplectic_core::Scalar;

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

/// Periods after which half of the digits of the phase are lost; likewise the ratio of the terms of a sum to the sum.
const MAX_PERIODS: f64 = (1_u64 << 26) as f64;

/// The ratio of the terms of a sum to the sum, up to which the sum has its digits.
pub(super) const LARGEST_CANCELLATION: f64 = 6.0;

/// The square of a shorter distance has not all of its digits.
pub(super) const SMALLEST_DISTANCE: f64 = 1e-153;

/// From this `|βs²|` on, `(s − G1)/β` does not cancel.
const LONG_ARC: f64 = 4.0;

/// An orbit: position and velocity, distance and its reciprocal, `q·v`, `2μ/r − v²`, μ, and 1/m.
#[derive(Clone, Copy, Debug)]
pub(super) struct Orbit<T> {
    pub(super) place: [T; 3],
    pub(super) velocity: [T; 3],
    pub(super) distance: T,
    pub(super) inverse: T,
    pub(super) radial: T,
    pub(super) beta: T,
    pub(super) mu: T,
    pub(super) lighter: T,
}

impl<T: Scalar> Orbit<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn new(mu: T, lighter: T, q: [T; 3], p: [T; 3]) -> Self {
        let dot = |a: [T; 3], b: [T; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let distance = dot(q, q).sqrt();
        let inverse = distance.recip();
        let v = [p[0] * lighter, p[1] * lighter, p[2] * lighter];
        Self {
            place: q,
            velocity: v,
            distance,
            inverse,
            radial: dot(q, v),
            beta: (mu + mu) * inverse - dot(v, v),
            mu,
            lighter,
        }
    }

    /// `ζ = μ − βr`
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn zeta(&self) -> T {
        self.mu - self.beta * self.distance
    }

    /// The distance at the end, and the sum of its terms.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn at_end(&self, [g1, g2]: [T; 2]) -> [T; 2] {
        let (first, second) = (self.radial * g1, self.zeta() * g2);
        let terms = self.distance + first.abs() + second.abs();
        [self.distance + (first + second), terms]
    }

    /// The change, from the functions `G1` and `G2`, the distance at the end, and g.
    ///
    /// The mass occurs by its reciprocal only: two numbers whose product is not 1 would change areas in all steps alike.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn change(&self, [g1, g2]: [T; 2], end: T, g: T) -> Change<T> {
        let Self {
            inverse,
            mu,
            lighter,
            ..
        } = *self;
        let heavier_at_end = (end * lighter).recip();
        let pull = -mu * g2;
        [
            pull * inverse,
            g * lighter,
            -mu * (g1 * inverse) * heavier_at_end,
            pull * (heavier_at_end * lighter),
        ]
    }
}

impl Orbit<f64> {
    /// The change in the time `h`, for every orbit: ellipse, parabola, hyperbola and line.
    ///
    /// By the arc from the start if its terms do not cancel, else from the pericentre.
    pub(super) fn end(&self, h: f64) -> Result<Change<f64>, NoEnd> {
        let Self {
            distance,
            radial,
            beta,
            mu,
            ..
        } = *self;
        if distance == 0.0 {
            return Err(NoEnd::AtCentre);
        }
        let known = [distance, radial, beta, h].iter().all(|x| x.is_finite());
        if !known || distance < SMALLEST_DISTANCE {
            return Err(NoEnd::NotFound);
        }
        let h = self.without_periods(h)?;
        if h == 0.0 {
            return Ok([0.0; 4]);
        }
        // Backward is forward with the opposite velocity.
        let (time, radial, sign) = (h.abs(), radial * h.signum(), h.signum());
        let from_start = Path {
            distance,
            slope: radial,
            bend: self.zeta(),
            beta,
        };
        let arc = from_start.arc(time, time / distance);
        let (functions, end) = match arc {
            Some((s, of)) if from_start.cancellation(s, &of) < LARGEST_CANCELLATION => {
                (of, from_start.distance(&of))
            }
            _ => self.by_pericentre(time, radial)?,
        };
        let [_, g1, g2, g3] = functions;
        // Of two sums for g, that of smaller terms.
        let sums = [[time, -mu * g3], [distance * g1, radial * g2]];
        let [size, other] = sums.map(|[a, b]| a.abs() + b.abs());
        let [a, b] = if size < other { sums[0] } else { sums[1] };
        let g = sign * (a + b);
        let change = self.change([sign * g1, g2], end, g);
        let [x, y, z] = self.velocity;
        let terms =
            distance * (1.0 + change[0].abs()) + g.abs() * libm::hypot(libm::hypot(x, y), z);
        // The position at the end has half of its digits, and all is finite.
        let found = terms < end * MAX_PERIODS && change.iter().all(|x| x.is_finite());
        found.then_some(change).ok_or(NoEnd::NotFound)
    }

    /// The functions of the arc that takes this time, and the distance at its end; `radial` is `q·v` in the direction of the time.
    ///
    /// All terms of time and distance from the pericentre are positive.
    #[cold]
    fn by_pericentre(&self, time: f64, radial: f64) -> Result<(Functions, f64), NoEnd> {
        let Self {
            distance, beta, mu, ..
        } = *self;
        let (zeta, rate) = (self.zeta(), Scalar::sqrt(beta.abs()));
        let momentum = self.angular_momentum();
        // μ times the eccentricity.
        let bend = match beta > 0.0 {
            true => libm::hypot(zeta, radial * rate),
            false => libm::hypot(mu, momentum * rate),
        };
        let pericentre = Path {
            distance: momentum * momentum / (mu + bend),
            slope: 0.0,
            bend,
            beta,
        };
        // The arc from the start to the pericentre, negative if the body moves away from it.
        let to_pericentre = |s: f64| {
            let [.., by_series] = path::functions(s, beta);
            let g1 = -radial / bend;
            let long = (beta * s * s).abs() > LONG_ARC;
            let g3 = if long { (s - g1) / beta } else { by_series };
            let functions = [zeta / bend, g1, (distance - pericentre.distance) / bend, g3];
            (s, functions, pericentre.time(s, &functions))
        };
        let angle = -radial * rate;
        let (mut first, mut of_first, mut sooner) = to_pericentre(if beta > 0.0 {
            libm::atan2(angle, zeta) / rate
        } else if beta < 0.0 {
            libm::asinh(angle / bend) / rate
        } else {
            -radial / bend
        });
        if beta > 0.0 && time - sooner > self.period() / 2.0 {
            (first, of_first, sooner) = to_pericentre(first + TAU / rate);
        }
        // The arc from the pericentre to the end.
        let rest = time - sooner;
        let by_cube = libm::cbrt(6.0 * rest.abs() / bend);
        let high = by_cube.min(rest.abs() / pericentre.distance);
        let (second, of_second) = pericentre.arc(rest.abs(), high).ok_or(NoEnd::NotFound)?;
        let end = pericentre.distance(&of_second);
        if end <= 0.0 {
            return Err(NoEnd::AtCentre);
        }
        let functions = match first > 0.0 && rest > 0.0 {
            true => path::sum(of_first, of_second, beta),
            false => path::functions(first + second.copysign(rest), beta),
        };
        Ok((functions, end))
    }

    /// `|q × v|`
    fn angular_momentum(&self) -> f64 {
        let (q, v) = (&self.place, &self.velocity);
        let component = |i: usize, j: usize| {
            // Kahan's: without the rounding errors of the products.
            let product = q[j] * v[i];
            libm::fma(q[i], v[j], -product) - libm::fma(q[j], v[i], -product)
        };
        libm::hypot(
            libm::hypot(component(0, 1), component(1, 2)),
            component(2, 0),
        )
    }

    fn period(&self) -> f64 {
        TAU * self.mu / (self.beta * Scalar::sqrt(self.beta))
    }

    /// The time without whole periods.
    fn without_periods(&self, h: f64) -> Result<f64, NoEnd> {
        if self.beta <= 0.0 {
            return Ok(h);
        }
        let period = self.period();
        let periods = Float::round(h / period);
        if periods.abs() >= MAX_PERIODS {
            return Err(NoEnd::Periods(periods.abs()));
        }
        Ok(if periods == 0.0 {
            h
        } else {
            libm::fma(-periods, period, h)
        })
    }
}
