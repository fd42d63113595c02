//! Splittings: alternating kicks and drifts.

use super::lanes::{Lanes, fast_two_sum, two_sum};
use super::no_drift::Double;
use super::systems::Separable;

/// The alternating kicks and drifts of a method.
pub trait Splitting {
    /// Number of kicks, and of drifts.
    const LENGTH: usize;
    /// The kicks, as fractions of the step.
    const KICKS: &'static [f64];
    /// The drifts, as fractions of the step.
    const DRIFTS: &'static [f64];
    /// Whether each drift precedes the kick with the same index.
    const DRIFT_FIRST: bool;
}

/// A [`Splitting`] with the coefficients that the macros emitted for a method.
macro_rules! splitting {
    ($($(#[$meta:meta])* $name:ident: $method:ident, $drift_first:literal;)+) => {$(
        $(#[$meta])*
        #[derive(Clone, Copy, Debug)]
        pub struct $name;

        impl Splitting for $name {
            const LENGTH: usize = ::symplectic_tests::methods::$method::B.len();
            const KICKS: &'static [f64] = &::symplectic_tests::methods::$method::B_TILDE;
            const DRIFTS: &'static [f64] = &::symplectic_tests::methods::$method::B;
            const DRIFT_FIRST: bool = $drift_first;
        }
    )+};
}

splitting! {
    /// Half a kick, a drift, half a kick.
    Verlet: VelocityVerlet, false;
    /// Forest & Ruth, order 4.
    ForestRuth: ForestRuth, false;
    /// Blanes & Moan, order 6 for quadratic kinetic energy.
    BlanesMoan: BlanesMoanSrkn14a, true;
}

/// Whether the force at the end of a step is reused at the start of the next.
const fn carries<M: Splitting>() -> bool {
    !M::DRIFT_FIRST && M::KICKS[M::LENGTH - 1] != 0.0
}

/// Takes `steps` steps of `step_size` from `(q, p)` with plain sums.
#[inline(always)]
pub fn run<M: Splitting, T: Separable<N>, const N: usize>(
    system: &T,
    (q, p): (&mut [f64; N], &mut [f64; N]),
    step_size: f64,
    steps: u64,
) {
    let mut force = system.force(q);
    for _ in 0..steps {
        for i in 0..M::LENGTH {
            if M::DRIFT_FIRST && M::DRIFTS[i] != 0.0 {
                add(q, step_size * M::DRIFTS[i], &system.velocity(p));
            }
            if M::KICKS[i] != 0.0 {
                if !(carries::<M>() && i == 0) {
                    force = system.force(q);
                }
                add(p, step_size * M::KICKS[i], &force);
            }
            if !M::DRIFT_FIRST && M::DRIFTS[i] != 0.0 {
                add(q, step_size * M::DRIFTS[i], &system.velocity(p));
            }
        }
    }
}

/// [`run`] with sums compensated at every kick and drift.
#[inline(always)]
pub fn run_compensated<M: Splitting, T: Separable<N>, const N: usize>(
    system: &T,
    (q, p): (&mut Double<N>, &mut Double<N>),
    step_size: f64,
    steps: u64,
) {
    let mut force = system.force(&q.high);
    for _ in 0..steps {
        for i in 0..M::LENGTH {
            if M::DRIFT_FIRST && M::DRIFTS[i] != 0.0 {
                add_compensated(q, step_size * M::DRIFTS[i], &system.velocity(&p.high));
            }
            if M::KICKS[i] != 0.0 {
                if !(carries::<M>() && i == 0) {
                    force = system.force(&q.high);
                }
                add_compensated(p, step_size * M::KICKS[i], &force);
            }
            if !M::DRIFT_FIRST && M::DRIFTS[i] != 0.0 {
                add_compensated(q, step_size * M::DRIFTS[i], &system.velocity(&p.high));
            }
        }
    }
}

#[inline(always)]
fn add<const N: usize>(x: &mut [f64; N], factor: f64, slope: &[f64; N]) {
    for k in 0..N {
        x[k] = factor.fused(slope[k], x[k]);
    }
}

#[inline(always)]
fn add_compensated<const N: usize>(x: &mut Double<N>, factor: f64, slope: &[f64; N]) {
    for k in 0..N {
        let (high, error) = two_sum(x.high[k], factor * slope[k]);
        (x.high[k], x.low[k]) = fast_two_sum(high, x.low[k] + error);
    }
}
