//! How a method steps systems with non-holonomic constraints.

use super::constrained::{ConstrainedSteps, rounded};
use crate::tableau::{Parts, Tableau, composed};

/// The steps for non-holonomic constraints; `None` for a method that does not qualify.
///
/// A composition of methods that qualify composes their steps, if it keeps its order with them.
pub(super) fn steps(tableau: &Tableau, parts: &Parts) -> Option<ConstrainedSteps> {
    let tableau_of = |tableau: &Tableau| rounded(&tableau.numbers(), Vec::new());
    if composed::nonholonomic(tableau, parts).is_some_and(|found| found.holds) {
        return ConstrainedSteps::composed(parts, tableau_of);
    }
    if !tableau.own_properties().nonholonomic.holds {
        return None;
    }
    Some(ConstrainedSteps::one(tableau_of(tableau)?))
}
