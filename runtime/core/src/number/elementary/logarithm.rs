//! The natural logarithm.
//!
//! `x = 2ᵏ (1 + f)` with `√2/2 < 1 + f < √2`, `s = f/(2 + f)`, and a polynomial for `ln(1 + f) = ln(1 + s) − ln(1 − s)`.
//!
//! *Source:* fdlibm (`e_log.c` as in FreeBSD), except for the branches:
//!
//! > Copyright (C) 1993 by Sun Microsystems, Inc. All rights reserved. Developed at SunSoft, a Sun Microsystems, Inc. business. Permission
//! > to use, copy, modify, and distribute this software is freely granted, provided that this notice is preserved.

use super::exponential::LN_2;
use super::{Doubles, polynomial};

/// `(ln(1 + s) − ln(1 − s) − 2s)/s³` in powers of s², with an error of 2⁻⁵⁸ of the logarithm.
const RATIO: [f64; 7] = [
    6.666_666_666_666_735e-1,
    3.999_999_999_940_942e-1,
    2.857_142_874_366_239e-1,
    2.222_219_843_214_978_4e-1,
    1.818_357_216_161_805e-1,
    1.531_383_769_920_937_3e-1,
    1.479_819_860_511_658_6e-1,
];

/// The first 32 bits of √2/2.
const LEAST: u64 = 0x3FE6_A09E_0000_0000;

/// The bits of 1.
const ONE: u64 = 0x3FF0_0000_0000_0000;

/// The bits of 2⁵²: a double with these bits and an integer in its last bits has the value 2⁵² plus the integer.
const TWO_TO_52: u64 = 0x4330_0000_0000_0000;

/// ln x.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn ln<D: Doubles>(x: D) -> D {
    if !is_near(x) {
        return x.one_by_one(|x| if is_near(x) { near(x) } else { libm::log(x) });
    }
    near(x)
}

/// Whether all numbers are positive, normal and below the largest double.
#[cfg_attr(not(debug_assertions), inline(always))]
fn is_near<D: Doubles>(x: D) -> bool {
    x.all_below(f64::MAX) && (-x).all_below(-f64::MIN_POSITIVE)
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn near<D: Doubles>(x: D) -> D {
    let shifted = D::sum(x.to_bits(), D::bits(ONE - LEAST));
    let k = D::from_bits((shifted >> 52) | D::bits(TWO_TO_52))
        - D::from_f64(4_503_599_627_370_496.0 + 1023.0);
    let mantissa = shifted & D::bits((1 << 52) - 1);
    let f = D::from_bits(D::sum(mantissa, D::bits(LEAST))) - D::one();
    let s = f / (D::from_f64(2.0) + f);
    let square = s * s;
    let sum = square * polynomial(square, RATIO);
    let half = f * f * D::from_f64(0.5);
    let low = k * D::from_f64(LN_2[1]);
    k * D::from_f64(LN_2[0]) - ((half - (s * (half + sum) + low)) - f)
}
