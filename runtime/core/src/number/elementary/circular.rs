//! Sine and cosine.
//!
//! `x = n π/2 + y` with an integer n and `|y| ≤ π/4`. Here π/2 is the sum of three doubles of 33 bits, whose products with n are exact,
//! and a fourth double. Polynomials then give sine and cosine of `y`, which is a sum of two doubles.
//!
//! *Source:* the method and the polynomials are those of fdlibm (`e_rem_pio2.c`, `k_sin.c`, `k_cos.c` as in FreeBSD):
//!
//! > Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved. Developed at SunPro, a Sun Microsystems, Inc. business.
//! > Permission to use, copy, modify, and distribute this software is freely granted, provided that this notice is preserved.
//!
//! The difference: all three parts of π/2 are always subtracted, so that there is no branch on `y`.

use super::doubles::Branches;
use super::{Doubles, TO_INTEGER, polynomial};
use crate::number::Scalar;

/// 2/π.
const QUARTERS: f64 = core::f64::consts::FRAC_2_PI;

/// π/2: its first 33 bits, the next 33, the next 33, and the double nearest to the rest.
const QUARTER: [f64; 4] = [
    f64::from_bits(0x3FF9_21FB_5440_0000),
    f64::from_bits(0x3DD0_B461_1A60_0000),
    f64::from_bits(0x3BA3_198A_2E00_0000),
    f64::from_bits(0x397B_839A_2520_49C1),
];

/// `(y − sin y)/y³` in powers of y², with an error of 2⁻⁵⁸ of the sine.
const SINE: [f64; 6] = [
    1.666_666_666_666_663_2e-1,
    -8.333_333_333_322_49e-3,
    1.984_126_982_985_795e-4,
    -2.755_731_370_707_006_8e-6,
    2.505_076_025_340_686_3e-8,
    -1.589_690_995_211_55e-10,
];

/// `(cos y − 1 + y²/2)/y⁴` in powers of y², with an error of 2⁻⁵⁸ of the cosine.
const COSINE: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// Products of n with the parts of π/2 are exact below this bound.
const NEAR: f64 = 8e5;

/// Sine and cosine.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sin_cos<D: Doubles>(x: D) -> (D, D) {
    if !x.abs().all_below(NEAR) {
        return (x.one_by_one(any_sine), x.one_by_one(any_cosine));
    }
    let angle = Angle::new(x);
    (angle.sine(), angle.cosine())
}

/// [`sin_cos`] of each angle, all at once if all are below [`NEAR`]. Otherwise each angle has its own branch, and the results of one angle
/// wait in memory for the next.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sin_cos_all<D: Doubles, const N: usize>(angles: [D; N]) -> [(D, D); N] {
    let mut sum = D::zero();
    for x in &angles {
        sum += x.abs();
    }
    let mut all = [(D::zero(), D::zero()); N];
    if !sum.all_below(NEAR) {
        for (result, x) in all.iter_mut().zip(angles) {
            *result = sin_cos(x);
        }
        return all;
    }
    for (result, x) in all.iter_mut().zip(angles) {
        let angle = Angle::new(x);
        *result = (angle.sine(), angle.cosine());
    }
    all
}

/// Sine.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn sin<D: Doubles>(x: D) -> D {
    if !x.abs().all_below(NEAR) {
        return x.one_by_one(any_sine);
    }
    Angle::new(x).sine()
}

/// Cosine.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn cos<D: Doubles>(x: D) -> D {
    if !x.abs().all_below(NEAR) {
        return x.one_by_one(any_cosine);
    }
    Angle::new(x).cosine()
}

fn any_sine(x: f64) -> f64 {
    if Scalar::abs(x) < NEAR {
        Angle::new(x).sine()
    } else {
        libm::sin(x)
    }
}

fn any_cosine(x: f64) -> f64 {
    if Scalar::abs(x) < NEAR {
        Angle::new(x).cosine()
    } else {
        libm::cos(x)
    }
}

/// An angle `n π/2 + y`.
#[derive(Clone, Copy)]
struct Angle<D> {
    /// n + [`TO_INTEGER`], which holds n in its last bits.
    quarters: D,
    /// y = a − b as the pair (a, b), where b is as small as a rounding error of a.
    rest: (D, D),
}

impl<D: Doubles> Angle<D> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn new(x: D) -> Self {
        let to_integer = D::from_f64(TO_INTEGER);
        let quarters = x.fused(D::from_f64(QUARTERS), to_integer);
        let n = quarters - to_integer;
        let [first, second, third, last] = QUARTER;
        let a = plus(x, n, -first);
        let b = plus(a, n, -second);
        let c = plus(b, n, -third);
        // The order of the sums keeps the chain of dependent additions short.
        let of_second = plus(plus(b - a, n, second), n, last);
        Self {
            quarters,
            rest: (c, of_second + plus(c - b, n, third)),
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sine(self) -> D {
        D::choose(self.quarters.to_bits(), Sine(self)).with_sign_of_bit(1, self.quarters)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn cosine(self) -> D {
        D::choose(self.quarters.to_bits(), Cosine(self))
            .with_sign_of_bit(1, self.quarters + D::one())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn sine_of_rest(self) -> D {
        let (y, less) = self.rest;
        let square = y * y;
        y - (square * y).fused(polynomial(square, SINE), less * near(square))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn cosine_of_rest(self) -> D {
        let (y, less) = self.rest;
        let square = y * y;
        let near = near(square);
        let rounded = (D::one() - near) - square * D::from_f64(0.5);
        near + (square * square).fused(polynomial(square, COSINE), y.fused(less, rounded))
    }
}

/// `number + n part`
#[cfg_attr(not(debug_assertions), inline(always))]
fn plus<D: Doubles>(number: D, n: D, part: f64) -> D {
    n.fused(D::from_f64(part), number)
}

/// The sine, up to its sign.
#[derive(Clone, Copy)]
struct Sine<D>(Angle<D>);

impl<D: Doubles> Branches<D> for Sine<D> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn odd(self) -> D {
        self.0.cosine_of_rest()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn even(self) -> D {
        self.0.sine_of_rest()
    }
}

/// The cosine, up to its sign.
#[derive(Clone, Copy)]
struct Cosine<D>(Angle<D>);

impl<D: Doubles> Branches<D> for Cosine<D> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn odd(self) -> D {
        self.0.sine_of_rest()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn even(self) -> D {
        self.0.cosine_of_rest()
    }
}

/// `1 − y²/2`, where the division by 2 is exact.
#[cfg_attr(not(debug_assertions), inline(always))]
fn near<D: Doubles>(square: D) -> D {
    square.fused(D::from_f64(-0.5), D::one())
}
