//! Time and distance along an orbit by the universal anomaly.

use super::stumpff;
use symplectic_core::Scalar;

/// The maximum number of iterations: each halves the previous change, and this exceeds the number of bits and exponents.
const MAX_ITERATIONS: u32 = 1200;

/// A point of an orbit: the distance r with its derivatives by the universal anomaly s, and β. The derivative of the time is r.
#[derive(Clone, Copy, Debug)]
pub(super) struct Path {
    pub(super) distance: f64,
    pub(super) slope: f64,
    pub(super) bend: f64,
    pub(super) beta: f64,
}

/// `G0` … `G3` of an arc.
pub(super) type Functions = [f64; 4];

/// `G1`, `G2`, `G3` at `s`, from `c_2` and `c_3` at `ψ = βs²`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn g_functions<T: Scalar>(s: T, psi: T, (c2, c3): (T, T)) -> [T; 3] {
    let square = s * s;
    [s * (T::one() - psi * c3), square * c2, square * s * c3]
}

/// `G0` … `G3` at any `s`.
pub(super) fn functions(s: f64, beta: f64) -> Functions {
    let psi = beta * s * s;
    let [g1, g2, g3] = g_functions(s, psi, stumpff::any(psi));
    [1.0 - beta * g2, g1, g2, g3]
}

/// The functions of the sum of two arcs.
pub(super) fn sum(
    [a0, a1, a2, a3]: Functions,
    [b0, b1, b2, b3]: Functions,
    beta: f64,
) -> Functions {
    let g1 = a1 * b0 + a0 * b1;
    let g2 = a2 + (a1 * b1 + a0 * b2);
    [1.0 - beta * g2, g1, g2, (a3 + b3) + (a2 * b1 + a1 * b2)]
}

impl Path {
    /// The terms of the time that an arc of length s takes.
    fn times(&self, s: f64, [_, _, g2, g3]: &Functions) -> [f64; 3] {
        [self.distance * s, self.slope * g2, self.bend * g3]
    }

    /// The terms of the distance at the end of an arc.
    fn distances(&self, [_, g1, g2, _]: &Functions) -> [f64; 3] {
        [self.distance, self.slope * g1, self.bend * g2]
    }

    /// The time that an arc takes.
    pub(super) fn time(&self, s: f64, functions: &Functions) -> f64 {
        total(self.times(s, functions))
    }

    /// The distance at the end of an arc.
    pub(super) fn distance(&self, functions: &Functions) -> f64 {
        total(self.distances(functions))
    }

    /// By how much the terms of time and distance exceed the sums.
    pub(super) fn cancellation(&self, s: f64, functions: &Functions) -> f64 {
        let of = |terms: [f64; 3]| total(terms.map(f64::abs)) / total(terms).max(0.0);
        of(self.times(s, functions)).max(of(self.distances(functions)))
    }

    /// The arc that takes a positive time; the first guess of its length is between 0 and `high`.
    ///
    /// The time grows with the length, so Newton's iteration is safeguarded by bisection.
    pub(super) fn arc(&self, time: f64, high: f64) -> Option<(f64, Functions)> {
        let at = |s: f64| {
            let functions = functions(s, self.beta);
            let late = self.time(s, &functions) - time;
            // A time that overflows is too long, whatever the sum of infinities.
            let late = if late.is_finite() {
                late
            } else {
                f64::INFINITY
            };
            (late, self.distance(&functions), functions)
        };
        // A first guess that underflows to 0 would not grow.
        let (mut low, mut high) = (0.0, high.max(f64::MIN_POSITIVE));
        while at(high).0 < 0.0 {
            (low, high) = (high, 2.0 * high);
        }
        let mut s = low + (high - low) / 2.0;
        let mut before = high - low;
        for _ in 0..MAX_ITERATIONS {
            let (late, slope, _) = at(s);
            if late < 0.0 {
                low = s;
            } else {
                high = s;
            }
            let newton = s - late / slope;
            let inside = newton > low && newton < high;
            let next = if late == 0.0 {
                s
            } else if inside && (2.0 * (newton - s)).abs() <= before {
                newton
            } else {
                low + (high - low) / 2.0
            };
            before = (next - s).abs();
            s = next;
            if before <= f64::EPSILON * s {
                let (late, slope, functions) = at(s);
                return Some(self.without_rounding(s, functions, -late / slope));
            }
        }
        None
    }

    /// Corrects an arc by the rest of Newton's iteration, which is below the last bit of s; for a long hyperbola the functions have it.
    fn without_rounding(&self, s: f64, functions: Functions, rest: f64) -> (f64, Functions) {
        if rest.abs() <= 64.0 * f64::EPSILON * s {
            let [g0, g1, g2, g3] = functions;
            let near = [
                g0 - self.beta * g1 * rest,
                g1 + g0 * rest,
                g2 + g1 * rest,
                g3 + g2 * rest,
            ];
            (s + rest, near)
        } else {
            (s, functions)
        }
    }
}

fn total([a, b, c]: [f64; 3]) -> f64 {
    a + (b + c)
}
