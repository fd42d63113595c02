//! How increments are added to the state.

use crate::Scalar;

mod sealed {
    pub trait Sealed {}
    impl Sealed for super::Compensated {}
    impl Sealed for super::Plain {}
}

/// How a step adds its increments to the state: [`Compensated`] or [`Plain`]. Sealed.
pub trait Summation: sealed::Sealed + Copy + Default + 'static {
    /// Whether the state carries what the sums leave out.
    const COMPENSATED: bool;
}

/// The state is carried as an unevaluated sum of two numbers, and increments are added in this precision.
///
/// A rounding error of each step, relative to the state, would make the energy a random walk of that size; here it is
/// relative to the increment of the error itself. With coefficients that are symplectic as rounded (`μ̃_ij + μ_ji = 1`)
/// and an iteration that goes on until it stagnates, what remains is Brouwer's law, an energy error that grows like the
/// square root of the number of steps, without a drift (Hairer, McLachlan & Razakarivony, 2008; Antoñana, Makazaga &
/// Murua, 2017).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Compensated;

/// Plain sums: faster, and the rounding errors of the state add up from step to step. Iterations of coupled stages end as
/// soon as the change is down to rounding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Plain;

impl Summation for Compensated {
    const COMPENSATED: bool = true;
}

impl Summation for Plain {
    const COMPENSATED: bool = false;
}

/// The rounded sum, and what rounding left out of it (Knuth).
#[inline(always)]
pub(crate) fn two_sum<T: Scalar>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}

/// [`two_sum`] where `a` is not smaller than `b`, or is zero (Dekker).
#[inline(always)]
pub(crate) fn fast_two_sum<T: Scalar>(a: T, b: T) -> (T, T) {
    let sum = a + b;
    (sum, b - (sum - a))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_leave_nothing_out() {
        for (a, b) in [(1.0, 1e-20), (1e-20, 1.0), (0.1, 0.2), (-3.0, 3.0 + 1e-15)] {
            let (sum, rest) = two_sum(a, b);
            assert_eq!(sum, a + b);
            // What is left out is below half a unit in the last place, and adds nothing.
            assert_eq!(sum + rest, sum);
        }
        assert_eq!(two_sum(1.0, 1e-20), (1.0, 1e-20));
        assert_eq!(two_sum(1e-20, 1.0), (1.0, 1e-20));
        assert_eq!(fast_two_sum(1.0, 1e-20), (1.0, 1e-20));
        assert_eq!(
            two_sum(1.0_f32, 2.0_f32.powi(-30)),
            (1.0, 2.0_f32.powi(-30))
        );
    }
}
