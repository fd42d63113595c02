//! How a method steps systems with non-holonomic constraints, as data.

use proc_macro2::TokenStream;

use super::constrained::{constants, list, steps};
use crate::algebra::Number;
use crate::coefficients::Coefficients;
use crate::derive::Parts;
use crate::properties::composed;
use crate::tableau::Tableau;

/// The `NONHOLONOMIC` constant of a `Method`; empty for a method that does not qualify.
///
/// A composition of methods that qualify composes their steps, if it keeps its order with them.
pub(super) fn code(
    tableau: &Tableau,
    numbers: &Coefficients<Number<'_>>,
    parts: &Parts,
) -> Option<TokenStream> {
    if composed::nonholonomic(tableau, parts).is_some() {
        let tableaux = parts.methods.iter();
        let tableaux = tableaux.map(|method| constants(&method.numbers(), &[]));
        let tableaux = tableaux.collect::<Option<Vec<_>>>()?;
        return Some(steps(
            "NONHOLONOMIC",
            &tableaux,
            Some(&list(&parts.substeps)),
        ));
    }
    if !tableau.own_properties().nonholonomic.holds {
        return None;
    }
    Some(steps("NONHOLONOMIC", &[constants(numbers, &[])?], None))
}
