//! How a method steps systems with non-holonomic constraints, as data.

use proc_macro2::TokenStream;

use super::constrained::{constants, list, steps};
use crate::algebra::Number;
use crate::coefficients::Coefficients;
use crate::derive::Substep;
use crate::order::symmetric_composition;
use crate::symbolic::Constant;
use crate::tableau::Tableau;

/// The `NONHOLONOMIC` constant of a `Method`; empty for a method that does not qualify.
///
/// A composition qualifies if it keeps its order for every symmetric basic step of order 2.
pub(super) fn code(
    tableau: &Tableau,
    numbers: &Coefficients<Number<'_>>,
    (methods, substeps): (&[Tableau], &[Substep]),
) -> Option<TokenStream> {
    if let [method] = methods {
        let properties = method.properties();
        let fractions: Vec<Constant> = substeps.iter().map(|step| step.fraction.clone()).collect();
        let order = tableau.orders().general.order;
        let keeps = properties.nonholonomic.holds
            && properties.symmetric.holds
            && symmetric_composition::has_order(&fractions, order);
        if keeps {
            let tableau = constants(&method.numbers(), &[])?;
            return Some(steps("NONHOLONOMIC", &[tableau], Some(&list(substeps))));
        }
    }
    if !tableau.properties().nonholonomic.holds {
        return None;
    }
    Some(steps("NONHOLONOMIC", &[constants(numbers, &[])?], None))
}
