//! Whether a constant is zero.

use num_traits::Zero;

use super::Constant;
use crate::algebra::{Constants, Field};

/// Whether a constant is zero; `None` if it lies in no number field where this can be decided.
pub(crate) fn is_zero(constant: &Constant) -> Option<bool> {
    if let Some(value) = constant.as_rational() {
        return Some(value.is_zero());
    }
    let field = Constants::containing([constant])?;
    Some(field.constant(constant)?.is_zero())
}
