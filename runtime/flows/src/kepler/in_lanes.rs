//! The ends of several Kepler orbits at once.

use super::orbit::{Change, LARGEST_CANCELLATION, NoEnd, Orbit, SMALLEST_DISTANCE};
use super::path::g_functions;
use super::stumpff;
use symplectic_core::simd::Lanes;

/// The number of iterations in lanes; lanes that have not converged then are solved one at a time.
const MAX_ITERATIONS: u32 = 6;

/// The iteration is of order 6: after a smaller relative change the next iterate is exact up to rounding.
const LAST_CHANGE: f64 = 1e-4;

/// Terms of orders 4 and 5 are used up to this size; far from the solution larger terms lead away from it.
const LARGEST_TERMS: f64 = 0.2;

/// The largest residual of Kepler's equation, relative to its terms, of an accepted iterate; rounding causes a tenth of it.
const RESIDUAL: f64 = 32.0 * f64::EPSILON;

/// Lanes are used up to this `|βs²|`: a third of a period.
const LARGEST_PSI: f64 = 4.0;

/// Up to this `μs²/r`, `h − μG3` has all digits.
const LARGEST_ARC: f64 = 32.0;

/// The changes of positions and momenta in the time `h`; every lane has the same bits as if computed alone.
///
/// The [series](anomaly) of the universal anomaly from the start gives the first iterate; the series from an iterate gives its correction.
pub(super) fn changes<L: Lanes>(orbit: &Orbit<L>, h: f64) -> Result<Change<L>, (usize, NoEnd)> {
    let (one, two, of) = (L::one(), L::from_f64(2.0), L::from_f64);
    let step = of(h);
    let Orbit {
        distance,
        inverse,
        radial,
        beta,
        mu,
        ..
    } = *orbit;
    let zeta = orbit.zeta();
    let mut s = anomaly(beta, inverse, [radial, zeta], step);
    let mut left = MAX_ITERATIONS;
    // A converged lane keeps its iterate until the last lane has converged.
    let ([g0, g1, g2, g3], change, unsettled) = loop {
        let psi = beta * s * s;
        let quarter = psi * of(0.25);
        let c = stumpff::quadruple(quarter, stumpff::small(quarter));
        let [g1, g2, g3] = g_functions(s, psi, c);
        let g0 = one - beta * g2;
        let late = distance * s + (radial * g2 + zeta * g3) - step;
        let here = distance + (radial * g1 + zeta * g2);
        let slopes = [radial * g0 + zeta * g1, zeta * g0 - beta * (radial * g1)];
        let change = anomaly(beta, here.recip(), slopes, -late);
        let (size, bound) = (change.abs(), s.abs() * of(LAST_CHANGE));
        let unsettled = size - bound;
        left -= 1;
        if left == 0 || unsettled.all_below(0.0) {
            break ([g0, g1, g2, g3], change, unsettled);
        }
        s = size.if_below(bound, s, s + change);
    };
    // The addition theorem: G_k(s + δ) from G_k(s) and G_k(δ), for βδ² < 10⁻⁷.
    let (square, third) = (of(0.5) * change * change, of(1.0 / 3.0));
    let bend = beta * square;
    let d1 = change - third * bend * change;
    let d2 = square - of(1.0 / 6.0) * bend * square;
    let d3 = third * square * change;
    let g2_near = g2 + (g1 * d1 + g0 * d2);
    let g3 = g3 + (g2 * change + (g1 * d2 + g0 * d3));
    s += change;
    // G1 = s − βG3 and G1² = G2(2 − βG2) hold to rounding, so the flow preserves areas and the errors of many steps have no common sign.
    let g1 = s - beta * g3;
    let g2 = g1 * g1 / (two - beta * g2_near);

    let [end, end_terms] = orbit.at_end([g1, g2]);
    let changes = orbit.change([g1, g2], end, step - mu * g3);
    let terms = [distance * s, radial * g2, zeta * g3];
    let late = terms[0] + (terms[1] + terms[2]) - step;
    let sizes = terms[0].abs() + terms[1].abs() + terms[2].abs() + step.abs();
    let excess = [
        unsettled,
        late.abs() - sizes * of(RESIDUAL),
        end_terms - end * of(LARGEST_CANCELLATION),
        sizes - step.abs() * of(LARGEST_CANCELLATION),
        (beta * s * s).abs() - of(LARGEST_PSI),
        mu * s * s * inverse - of(LARGEST_ARC),
        of(SMALLEST_DISTANCE) - distance,
    ];
    if excess.iter().all(|excess| excess.all_below(0.0)) {
        return Ok(changes);
    }
    one_by_one(orbit, h, changes, excess)
}

/// The universal anomaly after the time `h`, to the fifth power of `h`. The arguments describe the initial point: `1/r`, and the
/// derivatives r' and r'' by the anomaly.
///
/// ```text
/// h = r s (1 + r's/2r + r''s²/6r − βr's³/24r − βr''s⁴/120r + …)
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
fn anomaly<L: Lanes>(beta: L, inverse: L, [slope, bend]: [L; 2], h: L) -> L {
    let of = L::from_f64;
    let u = h * inverse;
    let square = u * u;
    let (a, b, psi) = (slope * inverse * u, bend * inverse * square, beta * square);
    // The terms at s = u, which give those of the inverse series.
    let (x, y) = (of(1.0 / 2.0) * a, of(1.0 / 6.0) * b);
    let (z, w) = (of(-1.0 / 24.0) * psi * a, of(-1.0 / 120.0) * psi * b);
    let xx = x * x;
    let third = (xx + xx) - y;
    let fourth = x * (of(5.0) * (y - xx)) - z;
    let fifth = of(3.0) * (y * y) + of(6.0) * (x * z) + xx * (of(14.0) * xx - of(21.0) * y) - w;
    let higher = fourth + fifth;
    let higher = higher.abs().if_below(of(LARGEST_TERMS), higher, L::zero());
    u - u * (x - (third + higher))
}

/// Recomputes the lanes that exceed a bound, by the iteration that converges for every orbit.
#[cold]
#[inline(never)]
fn one_by_one<L: Lanes>(
    orbit: &Orbit<L>,
    h: f64,
    mut changes: Change<L>,
    excess: [L; 7],
) -> Result<Change<L>, (usize, NoEnd)> {
    let excess = excess.map(L::to_array);
    for lane in 0..L::WIDTH {
        if excess.iter().all(|excess| excess.as_ref()[lane] < 0.0) {
            continue;
        }
        let alone = orbit.lane(lane).end(h).map_err(|why| (lane, why))?;
        for (lanes, alone) in changes.iter_mut().zip(alone) {
            lanes.set(lane, alone);
        }
    }
    Ok(changes)
}

impl<L: Lanes> Orbit<L> {
    /// The orbit of a lane.
    fn lane(&self, lane: usize) -> Orbit<f64> {
        let one = |lanes: L| lanes.get(lane);
        Orbit {
            place: self.place.map(one),
            velocity: self.velocity.map(one),
            distance: one(self.distance),
            inverse: one(self.inverse),
            radial: one(self.radial),
            beta: one(self.beta),
            mu: one(self.mu),
            lighter: one(self.lighter),
        }
    }
}
