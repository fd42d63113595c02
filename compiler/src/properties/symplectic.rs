//! Symplecticity (MW 2.6.7).

use super::{Entry, Examined, Property, first_nonzero_entry, first_nonzero_value};
use crate::algebra::Tensor;

/// Decides `b_i ã_ij + b̃_j a_ji = b_i b̃_j` in `K ⊗ K` and `b = b̃` in `K`.
pub(super) fn decide(examined: &Examined<'_>) -> Property {
    let tableau = examined.tableau;
    let algebra = &tableau.algebra;
    if let Some((i, value)) = first_nonzero_value(algebra, &(&tableau.b - &tableau.b_tilde)) {
        return Property::refuted(format!("b_{i} − b̃_{i} = {value}"));
    }
    let product = Tensor::from_products(algebra, &[(tableau.b.clone(), tableau.b_tilde.clone())]);
    let residual = tableau
        .a_tilde
        .scale_rows(algebra, &tableau.b)
        .add(&tableau.a.scale_rows(algebra, &tableau.b_tilde).transpose())
        .subtract(&product);
    first_nonzero_entry(algebra, &residual).map_or(
        Property::proved(None),
        |Entry {
             index,
             transposed,
             row,
             column,
             value,
         }| {
            Property::refuted(format!(
                "b_{row} ã_{index} + b̃_{column} a_{transposed} − b_{row} b̃_{column} = {value}"
            ))
        },
    )
}
