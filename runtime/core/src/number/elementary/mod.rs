//! Elementary functions of doubles, one by one or side by side in lanes, with the same bits.
//!
//! The functions of the standard library take one double and differ between platforms. Here the functions that systems need most consist of
//! sums, products and operations on bits, which lanes also have. They are sine, cosine, exponential function and logarithm. The error of
//! each is below one unit in the last place; `tests/tests/elementary.rs` checks it. Huge and tiny numbers, infinities and NaN are passed to
//! [`libm`], one by one, without this guarantee.

mod circular;
mod doubles;
mod exponential;
mod logarithm;

pub(crate) use circular::{cos, sin, sin_cos, sin_cos_all};
pub(crate) use doubles::Doubles;
pub(crate) use exponential::exp;
pub(crate) use logarithm::ln;

use crate::number::array::array;

/// `2⁵² + 2⁵¹`: adding it to a double below 2⁵¹ rounds the double to an integer, which is in the last bits of the sum.
const TO_INTEGER: f64 = 6_755_399_441_055_744.0;

/// `coefficients_0 + coefficients_1 x + …`, summed in pairs, so that few sums depend on one another.
#[cfg_attr(not(debug_assertions), inline(always))]
fn polynomial<D: Doubles, const N: usize>(x: D, coefficients: [f64; N]) -> D {
    let mut terms: [D; N] = array(D::zero(), |k| D::from_f64(coefficients[k]));
    let (mut power, mut count) = (x, N);
    while count > 1 {
        let half = count / 2;
        for k in 0..half {
            terms[k] = terms[2 * k + 1].fused(power, terms[2 * k]);
        }
        if count % 2 == 1 {
            terms[half] = terms[count - 1];
        }
        count -= half;
        power *= power;
    }
    terms[0]
}
