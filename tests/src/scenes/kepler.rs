//! The Kepler problem in the plane, `H = |p|²/2 − 1/|q|`, from the pericentre of an orbit with semi-major axis 1 and
//! period 2π.
//!
//! *Needs:* nothing. Separable, quadratic kinetic energy, not stiff; hard for eccentricities near 1. *Source:* Hairer,
//! Lubich & Wanner, Geometric Numerical Integration (GNI), §I.2. *Reference:* closed form, [`exact`].

use std::f64::consts::{PI, TAU};

use symplectic::nalgebra::SVector;
use symplectic::system::Masses;
use symplectic::{Scalar, SeparableHamiltonian, State};

use super::Needs;

/// Its needs.
pub const NEEDS: Needs = Needs::NOTHING;

/// The system.
#[derive(Clone, Copy, Debug)]
pub struct Kepler;

impl SeparableHamiltonian for Kepler {
    type Vector<T: Scalar> = SVector<T, 2>;

    const MASSES: Masses = Masses::Unit;
    const INLINED: bool = true;

    #[inline(always)]
    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
        *velocity = *p;
    }

    #[inline(always)]
    fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, force: &mut SVector<T, 2>) {
        let square = q[0] * q[0] + q[1] * q[1];
        let factor = (square * square.sqrt()).recip();
        *force = SVector::from([-q[0] * factor, -q[1] * factor]);
    }

    fn energy<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, p: &SVector<T, 2>) -> Option<T> {
        Some(p.dot(p) * T::from_f64(0.5) - q.dot(q).sqrt().recip())
    }
}

/// The pericentre of the orbit with this eccentricity at time 0: `q = (1 − e, 0)`, `p = (0, √((1 + e)/(1 − e)))`.
pub fn start<T: Scalar>(eccentricity: f64) -> State<SVector<T, 2>> {
    let [distance, speed] = pericentre(eccentricity).map(T::from_f64);
    State::new(
        0.0,
        SVector::from([distance, T::zero()]),
        SVector::from([T::zero(), speed]),
    )
}

/// The angular momentum `q_1 p_2 − q_2 p_1`.
pub fn angular_momentum<T: Scalar>(state: &State<SVector<T, 2>>) -> T {
    state.q[0] * state.p[1] - state.q[1] * state.p[0]
}

/// The solution from [`start`] at `time`, for eccentricities in [0, 1).
///
/// It is the orbit through the doubles of [`start`], not through their exact values: rounding changes the period by
/// about 1e-16, a phase of 3e-12 after 1000 periods. The mean anomaly has an error of one rounding for up to 2⁵⁰
/// periods, the eccentric anomaly of `4 ε/(1 − e)` radians with `ε = 2⁻⁵³`. So the position is accurate to
/// `4 ε/(1 − e)` and the momentum to `4 ε/(1 − e)²`; away from the pericentre both are more accurate.
pub fn exact(eccentricity: f64, time: f64) -> State<SVector<f64, 2>> {
    let orbit = Orbit::new(pericentre(eccentricity));
    let anomaly = orbit.eccentric_anomaly(orbit.mean_anomaly(time));
    let (sine, cosine) = anomaly.sin_cos();
    // 1 − cos E without the cancellation at the pericentre.
    let versine = 2.0 * (anomaly / 2.0).sin().powi(2);
    // E' = n/(1 − e cos E)
    let rate = orbit.mean_motion() / (orbit.complement + orbit.eccentricity * versine);
    let major = 1.0 + orbit.excess;
    let minor = major * (orbit.complement * (1.0 + orbit.eccentricity)).sqrt();
    State::new(
        time,
        SVector::from([major * (orbit.complement - versine), minor * sine]),
        SVector::from([-major * sine * rate, minor * cosine * rate]),
    )
}

/// Distance and speed at the pericentre.
fn pericentre(eccentricity: f64) -> [f64; 2] {
    let distance = 1.0 - eccentricity;
    [distance, ((1.0 + eccentricity) / distance).sqrt()]
}

/// The orbit through a pericentre, with semi-major axis 1 up to rounding.
struct Orbit {
    /// δ = a − 1 for the semi-major axis a.
    excess: f64,
    /// e.
    eccentricity: f64,
    /// 1 − e, not computed from e.
    complement: f64,
}

impl Orbit {
    fn new([distance, speed]: [f64; 2]) -> Self {
        // 1/a = 2/r − v², and a − 1 = 1 − 1/a up to its square. The quotient and the square are computed with their
        // rounding errors; the differences of their leading parts, which nearly cancel, are exact.
        let quotient = 2.0 / distance;
        let quotient_error = (-quotient).mul_add(distance, 2.0) / distance;
        let square = speed * speed;
        let square_error = speed.mul_add(speed, -square);
        let excess = (1.0 - quotient + square) + (square_error - quotient_error);
        let complement = distance * (1.0 - excess);
        Self {
            excess,
            eccentricity: 1.0 - complement,
            complement,
        }
    }

    /// n = a^(−3/2), up to the square of a − 1.
    const fn mean_motion(&self) -> f64 {
        1.0 - 1.5 * self.excess
    }

    /// M = n t, reduced to [−π, π].
    fn mean_anomaly(&self, time: f64) -> f64 {
        /// 2π − [`TAU`].
        const TAU_ERROR: f64 = 2.449_293_598_294_706_4e-16;
        let turns = (time / TAU).round();
        // One rounding, and none where the result is small.
        let reduced = (-turns).mul_add(TAU, time);
        reduced - (turns * TAU_ERROR + 1.5 * self.excess * time)
    }

    /// The solution E of Kepler's equation E − e sin E = M for M in [−π, π].
    fn eccentric_anomaly(&self, mean: f64) -> f64 {
        let target = mean.abs();
        let e = self.eccentricity;
        if target == 0.0 {
            return mean;
        }
        // On [0, π] the left-hand side is increasing and convex. So Newton's iteration decreases from min(M + e, π) ≥ E
        // to E, until rounding errors dominate.
        let mut anomaly = (target + e).min(PI.max(target));
        loop {
            let residual = (anomaly - target) - e * anomaly.sin();
            let slope = self.complement + 2.0 * e * (anomaly / 2.0).sin().powi(2);
            let next = anomaly - residual / slope;
            if next < anomaly {
                anomaly = next;
            } else {
                return next.copysign(mean);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_closed_form_is_finite_at_all_times_and_eccentricities() {
        for eccentricity in [0.0, 0.1, 0.6, 0.9, 0.999, 1.0 - 1e-9] {
            for i in 0..20_000 {
                // A golden-ratio walk over times of all sizes.
                let time = (0.618_034 * f64::from(i)).fract() * 10.0_f64.powi(i % 21 - 10);
                let state = exact(eccentricity, time);
                assert!(
                    state.q.iter().chain(state.p.iter()).all(|x| x.is_finite()),
                    "{eccentricity} {time}"
                );
            }
        }
        assert!(exact(0.6, f64::NAN).q[0].is_nan());
    }

    /// Kepler's equation in 60 digits for the doubles of [`start`] (mpmath 1.3, `findroot` on E − e sin E − n t with
    /// a = 1/(2/r − v²)); q1, q2, p1, p2 rounded to double.
    const GOLDEN: &[(f64, f64, [f64; 4])] = &[
        (
            0.0,
            3.0,
            [
                -0.9899924966004454,
                0.1411200080598672,
                -0.1411200080598672,
                -0.9899924966004454,
            ],
        ),
        (
            0.3,
            100000000.0,
            [
                -0.8783018463672417,
                0.7782454283735295,
                -0.6952104378631184,
                -0.47010587316899666,
            ],
        ),
        (
            0.6,
            1.0,
            [
                -0.6289481768266242,
                0.7996647309700394,
                -0.9825156909388114,
                -0.022763170097430167,
            ],
        ),
        (
            0.6,
            125.0,
            [
                -0.26481829958652686,
                -0.7537228043074438,
                1.179326753291014,
                0.3356469995618767,
            ],
        ),
        (
            0.6,
            -6.5,
            [
                0.27303029271555246,
                -0.39013278396033063,
                1.0241171648979304,
                1.4667175402914494,
            ],
        ),
        (
            0.6,
            6250.0,
            [
                -1.2203445783439903,
                -0.6274635181716139,
                0.5715825253196066,
                -0.36166245630103966,
            ],
        ),
        (
            0.6,
            100000000.0,
            [
                -1.3124249462859952,
                0.561398651033305,
                -0.49160802241427753,
                -0.39927000843923655,
            ],
        ),
        (
            0.9,
            0.001,
            [
                0.09995001540847058,
                0.0043581727907328754,
                -0.09993838249902381,
                4.3567211454157135,
            ],
        ),
        (
            0.9,
            6250.0,
            [
                -1.628084310163071,
                -0.2987971135836638,
                0.41412286589070757,
                -0.19172912324525976,
            ],
        ),
        (
            0.999,
            0.001,
            [
                -0.013559556706924228,
                0.007601668126929136,
                -10.937343742034917,
                2.8343020598345223,
            ],
        ),
        (
            0.999,
            1.0,
            [
                -1.354152530768465,
                0.04179544823419808,
                -0.689998652451476,
                -0.011720522239106574,
            ],
        ),
        (
            0.999,
            6250.0,
            [
                -1.7532514874084475,
                -0.02935606040991188,
                0.374443494841548,
                -0.019231691631067294,
            ],
        ),
        (
            0.999,
            100000000.0,
            [
                -1.8133781236559583,
                0.025946864071585387,
                -0.3199968139498136,
                -0.020077039367784644,
            ],
        ),
    ];

    #[test]
    fn the_closed_form_has_the_digits_of_a_multiprecision_computation() {
        for &(eccentricity, time, digits) in GOLDEN {
            let state = exact(eccentricity, time);
            // The bounds stated for `exact`.
            let bound = 4.0 * (f64::EPSILON / 2.0) / (1.0 - eccentricity);
            let bounds = [
                bound,
                bound,
                bound / (1.0 - eccentricity),
                bound / (1.0 - eccentricity),
            ];
            let found = [state.q[0], state.q[1], state.p[0], state.p[1]];
            for i in 0..4 {
                let error = (found[i] - digits[i]).abs();
                assert!(
                    error <= bounds[i],
                    "e = {eccentricity}, t = {time}, component {i}: {error:e} > {:e}",
                    bounds[i]
                );
            }
        }
    }

    #[test]
    fn the_closed_form_starts_at_the_start() {
        for eccentricity in [0.0, 0.3, 0.6, 0.9, 0.999] {
            let (found, expected) = (exact(eccentricity, 0.0), start::<f64>(eccentricity));
            assert_eq!(found.q[1], 0.0);
            assert_eq!(found.p[0], 0.0);
            assert!((found.q[0] / expected.q[0] - 1.0).abs() <= 2.0 * f64::EPSILON);
            assert!((found.p[1] / expected.p[1] - 1.0).abs() <= 4.0 * f64::EPSILON);
        }
    }
}
