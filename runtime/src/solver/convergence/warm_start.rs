//! Convergence test after a warm start: sweeps are compared with the stages of the previous step. Nearly all iterations end here.
//!
//! The processor need not wait for the maximum over all lanes, and nothing is prepared that is rarely needed.

use super::{
    Begun, Class, Movement, PATIENCE, ROUNDING, STAGNATION, Scalar, Stopping, Sweeps, WarmStart,
    is_known, units,
};
use crate::number::dither::{dither_last_sweep, dither_side};

/// Smallest tolerance, in units of EPSILON, that the [early](PATIENCE) sweeps wait for. If both halves must settle, all sweeps wait
/// for which [one without progress suffices](STAGNATION). Rounding lets changes shrink to it unless the evaluations are noisy.
pub(crate) const WITHIN_REACH: f64 = 8.0;

/// The number of sweeps and the sizes of the stages if the iteration has settled; otherwise the state from which it can go on.
type Settled<M> = Result<(u32, [f64; 2]), Begun<M>>;

/// Iterates from the stages of the previous step.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn settle_from_warm_start<C: Class, T: Scalar, W: Sweeps>(
    sweeps: &mut W,
    kept: WarmStart,
    stopping: Stopping,
) -> Settled<W::Movement> {
    let both = !C::SEPARABLE;
    let goes_on = kept.stages && kept.scales[0] > 0.0;
    // The last allowed sweep is left to the cold start, which examines it.
    if !goes_on || stopping.max_iterations < 2 {
        return Err(Begun::NOTHING);
    }
    sweeps.begin(kept);
    let late = stopping.max_iterations.min(PATIENCE);
    let mut begun = Begun::NOTHING;
    let bound = stopping.max_iterations.min(STAGNATION);
    // If one half suffices, the smallest change may belong to a sweep that was not near rounding; if both must settle, it cannot.
    let near_by = if C::SEPARABLE { late } else { bound };
    if !W::STOPS_AT_ROUNDING {
        if !C::SEPARABLE && late == PATIENCE && dither_side(sweeps.time()) {
            // Approach from the other side. An ordinary sweep comes first: it leaves mostly the slowest-decaying error, which is reflected.
            begun.first = Some(sweeps.sweep());
            sweeps.overrelaxed_sweep();
            begun.iterations += 2;
        }
        return to_stagnation::<T, W>(sweeps, kept.scales, begun, [near_by, bound], both);
    }
    let [q, p] = units::<T>(WITHIN_REACH, kept.scales);
    let tolerance = stopping.tolerance;
    if tolerance >= q && (!both || tolerance >= p) {
        let settled = to_tolerance(sweeps, tolerance, near_by, both);
        settled.map(|iterations| (iterations, kept.scales))
    } else {
        to_rounding::<T, W>(sweeps, kept.scales, begun, late, both)
    }
}

/// Sweeps until a change is within the tolerance.
#[cfg_attr(not(debug_assertions), inline(always))]
fn to_tolerance<W: Sweeps>(
    sweeps: &mut W,
    tolerance: f64,
    bound: u32,
    both: bool,
) -> Result<u32, Begun<W::Movement>> {
    let mut iterations = 0;
    while iterations + 1 < bound {
        let this = sweeps.sweep();
        iterations += 1;
        if this.is_within([tolerance; 2], both) {
            return Ok(iterations);
        }
    }
    Err(Begun {
        iterations,
        ..Begun::NOTHING
    })
}

/// Sweeps until a change can be rounding errors and the next one would be at most one unit of EPSILON.
#[cfg_attr(not(debug_assertions), inline(always))]
fn to_rounding<T: Scalar, W: Sweeps>(
    sweeps: &mut W,
    scales: [f64; 2],
    mut begun: Begun<W::Movement>,
    late: u32,
    both: bool,
) -> Settled<W::Movement> {
    let mut size = Size::of::<T>(scales);
    while begun.iterations + 1 < late {
        let this = sweeps.sweep();
        begun.iterations += 1;
        if this.is_within(size.near, both) {
            let is_last = |scales| {
                let one = units::<T>(1.0, scales);
                let next = |before| this.is_next_within(&before, one, both);
                this.is_within(one, both) || begun.before.is_some_and(next)
            };
            let before = size.scales;
            if is_last(before) && sweeps.are_about(&this, before, both) {
                return Ok((begun.iterations, before));
            }
            let scales = sweeps.change(&this).scales();
            if is_known::<T>(scales, both) {
                size = Size::of::<T>(scales);
                if this.is_within(size.near, both) {
                    if is_last(size.scales) {
                        return Ok((begun.iterations, size.scales));
                    }
                    if begun.least.is_some() {
                        begun.last = Some(this);
                        return Err(begun);
                    }
                    begun.least = Some((begun.iterations, this));
                }
            }
        } else if begun.iterations == 1 {
            begun.first = Some(this);
        }
        begun.before = Some(this);
    }
    Err(begun)
}

/// Sweeps until changes that can be rounding errors have stopped shrinking, and once more if [`dither_last_sweep`] says so.
#[cfg_attr(not(debug_assertions), inline(always))]
fn to_stagnation<T: Scalar, W: Sweeps>(
    sweeps: &mut W,
    scales: [f64; 2],
    mut begun: Begun<W::Movement>,
    [near_by, bound]: [u32; 2],
    both: bool,
) -> Settled<W::Movement> {
    let mut size = Size::of::<T>(scales);
    let mut this = loop {
        let this = sweeps.sweep();
        begun.iterations += 1;
        if this.settles_within(size.near, both) {
            if sweeps.are_about(&this, size.scales, true) {
                break this;
            }
            let scales = sweeps.change(&this).scales();
            if is_known::<T>(scales, true) {
                size = Size::of::<T>(scales);
                if this.settles_within(size.near, both) {
                    break this;
                }
            }
        }
        if begun.iterations + 1 >= near_by {
            begun.last = Some(this);
            return Err(begun);
        }
        if begun.iterations == 1 {
            begun.first = Some(this);
        }
    };
    let mut smallest = f64::INFINITY;
    // A single branch decides: the processor predicts it in most sweeps, and a misprediction waits for nothing else.
    while this.shrinks(smallest, size.weights, both) {
        if begun.iterations + 1 >= bound {
            begun.last = Some(this);
            return Err(begun);
        }
        smallest = this.size(size.weights, both);
        begun.least = Some((begun.iterations, this));
        this = sweeps.sweep();
        begun.iterations += 1;
    }
    if !(this.settles_within(size.near, both) && this.is_number()) {
        begun.last = Some(this);
        return Err(begun);
    }
    // Any nonzero change is below infinity.
    let is_moving = this.shrinks(f64::INFINITY, size.weights, both);
    if is_moving && dither_last_sweep(sweeps.time()) {
        sweeps.sweep();
        begun.iterations += 1;
    }
    Ok((begun.iterations, size.scales))
}

/// Sizes of the stages.
struct Size {
    /// Sizes of positions and momenta, up to a factor of two.
    scales: [f64; 2],
    /// Weights that make the changes of the two halves comparable: each is the scale of the other half.
    weights: [f64; 2],
    /// Bounds below which a change can be rounding errors.
    near: [f64; 2],
}

impl Size {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn of<T: Scalar>(scales: [f64; 2]) -> Self {
        Self {
            scales,
            weights: [scales[1], scales[0]],
            near: units::<T>(ROUNDING, scales),
        }
    }
}
