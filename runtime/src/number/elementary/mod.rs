//! Elementary functions of doubles, one by one or side by side in lanes, with the same bits.
//!
//! Those of the standard library are functions of one double, and not the same on every platform. What systems need most is made
//! of sums, products and operations on bits here, which lanes have too: sine, cosine, exponential function, logarithm. The error
//! of each is below one unit in the last place; `tests/tests/elementary.rs` looks at it. What is left to [`libm`], one by one, are
//! arguments for which this would not hold: huge and tiny ones, infinities, NaN.

mod circular;
mod doubles;
mod exponential;
mod logarithm;

pub(crate) use circular::{cos, sin, sin_cos, sin_cos_all};
pub(crate) use doubles::Doubles;
pub(crate) use exponential::exp;
pub(crate) use logarithm::ln;

use crate::number::array::array;

/// `2⁵² + 2⁵¹`: added to a double below 2⁵¹ it rounds it to an integer, which is in the last bits of the sum.
const TO_INTEGER: f64 = 6_755_399_441_055_744.0;

/// `coefficients_0 + coefficients_1 x + …`, by pairs: few sums wait for one another.
#[inline(always)]
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
