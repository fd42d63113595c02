//! The ends of several Kepler orbits at once.

use super::orbit::{Change, NoEnd, Orbit, g_functions};
use super::stumpff;
use crate::number::Lanes;

/// Iterations in lanes; what has not converged then is done one by one.
const MOST: u32 = 6;

/// The relative change after which the next iterate is exact up to rounding, for the iteration is of order 3.
const LAST_CHANGE: f64 = 1e-7;

/// The residual of Kepler's equation, relative to its terms, up to which an iterate is the solution: rounding makes a tenth of it.
const RESIDUAL: f64 = 32.0 * f64::EPSILON;

/// `|βs²|` up to which lanes are used: a third of a period.
const LARGEST_PSI: f64 = 4.0;

/// `μs²/r` up to which `h − μG3` has all digits.
const LARGEST_ARC: f64 = 32.0;

/// How positions and momenta change in the time `h`, lane by lane; every lane as it would be alone, to the last bit.
///
/// The iteration for the universal anomaly is Halley's, of order 3.
pub(super) fn changes<L: Lanes>(orbit: &Orbit<L>, h: f64) -> Result<Change<L>, (usize, NoEnd)> {
    let step = L::from_f64(h);
    let Orbit {
        distance,
        radial,
        beta,
        mu,
        ..
    } = *orbit;
    let zeta = orbit.zeta();
    let (half, third) = (L::from_f64(0.5), L::from_f64(1.0 / 3.0));
    let functions = |s: L| {
        let psi = beta * s * s;
        let quarter = psi * L::from_f64(0.25);
        g_functions(s, psi, stumpff::quadruple(quarter, stumpff::small(quarter)))
    };
    // The series of s in h to the third power.
    let inverse = distance.recip();
    let u = step * inverse;
    let slope = half * radial * inverse;
    let bend = half * third * zeta * inverse;
    let mut s = u - slope * u * u + (slope * slope + slope * slope - bend) * u * u * u;
    // 1 where a lane has not converged.
    let mut open = L::one();
    for _ in 0..MOST {
        let [g1, g2, g3] = functions(s);
        let value = distance * s + (radial * g2 + zeta * g3) - step;
        let first = distance + (radial * g1 + zeta * g2);
        let second = radial * (L::one() - beta * g2) + zeta * g1;
        let change = -value * first / (first * first - half * value * second);
        s += change * open;
        let (changes, anomalies, opened) = (change.to_array(), s.to_array(), open.to_array());
        open = L::from_fn(|lane| {
            let bound = LAST_CHANGE * anomalies.as_ref()[lane].abs();
            if changes.as_ref()[lane].abs() <= bound {
                0.0
            } else {
                opened.as_ref()[lane]
            }
        });
        if !open.any_above(0.0) {
            break;
        }
    }
    let [g1, g2, g3] = functions(s);
    let (end, least) = orbit.at_end(radial, [g1, g2]);
    let mut change = orbit.change([g1, g2], end, step - mu * g3);
    let (first, second) = (distance * s, radial * g2 + zeta * g3);
    let value = (first + second - step).abs();
    let terms = first.abs() + (radial * g2).abs() + (zeta * g3).abs() + step.abs();
    let bound = terms * L::from_f64(RESIDUAL);
    let (value, bound, left) = (value.to_array(), bound.to_array(), (end - least).to_array());
    let psi = (beta * s * s).abs().to_array();
    let arc = (mu * s * s * inverse).to_array();
    for lane in 0..L::WIDTH {
        let in_range = psi.as_ref()[lane] <= LARGEST_PSI && arc.as_ref()[lane] <= LARGEST_ARC;
        let found = value.as_ref()[lane] <= bound.as_ref()[lane] && left.as_ref()[lane] > 0.0;
        if !(in_range && found) {
            let alone = orbit.lane(lane).end(h).map_err(|why| (lane, why))?;
            for (lanes, alone) in change.iter_mut().zip(alone) {
                let old = lanes.to_array();
                *lanes = L::from_fn(|k| if k == lane { alone } else { old.as_ref()[k] });
            }
        }
    }
    Ok(change)
}

impl<L: Lanes> Orbit<L> {
    /// The orbit of a lane.
    fn lane(&self, lane: usize) -> Orbit<f64> {
        let one = |lanes: L| lanes.to_array().as_ref()[lane];
        Orbit {
            distance: one(self.distance),
            radial: one(self.radial),
            beta: one(self.beta),
            mu: one(self.mu),
            mass: one(self.mass),
        }
    }
}
