//! One matrix for positions and momenta.

use super::{Entry, Examined, Property, first_nonzero_entry, first_nonzero_value};

/// Decides `ã = a` in `K ⊗ K` and `b̃ = b` in `K`.
pub(super) fn decide(examined: &Examined<'_>) -> Property {
    let tableau = examined.tableau;
    let algebra = &tableau.algebra;
    if let Some(Entry { index, value, .. }) =
        first_nonzero_entry(algebra, &tableau.a.subtract(&tableau.a_tilde))
    {
        Property::refuted(format!("a_{index} − ã_{index} = {value}"))
    } else if let Some((i, value)) = first_nonzero_value(algebra, &(&tableau.b - &tableau.b_tilde))
    {
        Property::refuted(format!("b_{i} − b̃_{i} = {value}"))
    } else {
        Property::proved(None)
    }
}
