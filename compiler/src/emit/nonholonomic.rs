//! How a method steps systems with non-holonomic constraints.

use super::constrained::{ConstrainedSteps, rounded};
use crate::algebra::Number;
use crate::coefficients::Coefficients;
use crate::derive::Parts;
use crate::properties::composed;
use crate::tableau::Tableau;

/// The steps for non-holonomic constraints; `None` for a method that does not qualify.
///
/// A composition of methods that qualify composes their steps, if it keeps its order with them.
pub(super) fn steps(
    tableau: &Tableau,
    numbers: &Coefficients<Number<'_>>,
    parts: &Parts,
) -> Option<ConstrainedSteps> {
    let tableau_of = |numbers: &Coefficients<Number<'_>>| rounded(numbers, Vec::new());
    if composed::nonholonomic(tableau, parts).is_some() {
        return ConstrainedSteps::composed(parts, tableau_of);
    }
    if !tableau.own_properties().nonholonomic.holds {
        return None;
    }
    Some(ConstrainedSteps::one(tableau_of(numbers)?))
}
