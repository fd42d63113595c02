//! The exponential function.
//!
//! `x = k ln 2 + r` with an integer k and `|r| ≤ ln 2/2`; a rational function gives `eʳ`, and k is added to its exponent.
//!
//! *Source:* fdlibm (`e_exp.c` as in FreeBSD), except for the branches:
//!
//! > Copyright (C) 2004 by Sun Microsystems, Inc. All rights reserved. Permission to use, copy, modify, and distribute this software is
//! > freely granted, provided that this notice is preserved.

use super::{Doubles, TO_INTEGER, polynomial};
use crate::number::Scalar;

/// ln 2: its first 32 bits and the double nearest to the rest.
pub(super) const LN_2: [f64; 2] = [
    f64::from_bits(0x3FE6_2E42_FEE0_0000),
    f64::from_bits(0x3DEA_39EF_3579_3C76),
];

/// `(r (eʳ + 1)/(eʳ − 1) − 2)/r²` in powers of r², with an error of 2⁻⁵⁹ of the exponential.
const RATIO: [f64; 5] = [
    1.666_666_666_666_660_2e-1,
    -2.777_777_777_701_559_3e-3,
    6.613_756_321_437_934e-5,
    -1.653_390_220_546_525_2e-6,
    4.138_136_797_057_238_5e-8,
];

/// eˣ and e⁻ˣ are normal numbers for |x| below this bound.
const NEAR: f64 = 708.0;

/// eˣ.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn exp<D: Doubles>(x: D) -> D {
    if !x.abs().all_below(NEAR) {
        return x.one_by_one(|x| {
            if Scalar::abs(x) < NEAR {
                near(x)
            } else {
                libm::exp(x)
            }
        });
    }
    near(x)
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn near<D: Doubles>(x: D) -> D {
    let to_integer = D::from_f64(TO_INTEGER);
    let bits = x * D::from_f64(core::f64::consts::LOG2_E) + to_integer;
    let k = bits - to_integer;
    let high = x - k * D::from_f64(LN_2[0]);
    let low = k * D::from_f64(LN_2[1]);
    let r = high - low;
    let square = r * r;
    let c = r - square * polynomial(square, RATIO);
    let power = D::one() + (((r * c) / (D::from_f64(2.0) - c) - low) + high);
    D::from_bits(D::sum(power.to_bits(), bits.to_bits() << 52))
}
