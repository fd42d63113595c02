//! Required orders for perturbed systems: `order(perturbed) >= (8, 4)`.

use super::Requirement;
use crate::error::ErrorKind;
use crate::evidence::Evidence;
use crate::expression::shown;
use crate::order::{PowerOrder, listed};
use crate::properties::GRADIENT_KICKS;
use crate::tableau::Tableau;

/// Whether the text before the sign asks for this order.
pub(super) fn is_meant(text: &str) -> bool {
    let letters = text.chars().filter(|c| !c.is_whitespace());
    letters.eq("order(perturbed)".chars())
}

/// Reads `(8, 4)`, or one number.
pub(super) fn read(text: &str) -> Result<Vec<usize>, ErrorKind> {
    let whole = text.trim();
    let inner = whole.strip_prefix('(').and_then(|c| c.strip_suffix(')'));
    let orders = inner.unwrap_or(whole).split(',');
    let orders: Option<Vec<usize>> = orders.map(|order| order.trim().parse().ok()).collect();
    let descending = |orders: &Vec<usize>| orders.is_sorted_by(|one, next| one >= next);
    orders.filter(descending).ok_or_else(|| ErrorKind::Type {
        found: match whole {
            "" => "nothing".to_owned(),
            _ => shown(whole),
        },
        expected: "an order in each power of ε, none above the one before, as in (8, 4)".to_owned(),
    })
}

impl Tableau {
    pub(super) fn require_perturbed(
        &self,
        requirement: &Requirement,
        exactly: bool,
        orders: &[usize],
        accepted: Option<u32>,
    ) -> Result<(), ErrorKind> {
        let refused = |message: String| Err(ErrorKind::Requirement { message });
        let Some(found) = self.perturbed_order() else {
            let reason = match self.exact.has_gradient_kicks() {
                true => GRADIENT_KICKS,
                false => "it is not a splitting",
            };
            return refused(format!("the method has no order for perturbed H: {reason}"));
        };
        let numbers = found.numbers();
        let mut evidence = Evidence::Proved;
        for power in 1..=found.powers.len().max(orders.len()) {
            let wanted = orders.get(power - 1).or(orders.last());
            let (Some(known), Some(&wanted)) = (found.power(power), wanted) else {
                continue;
            };
            let short = known.order < wanted;
            match &known.refuted_by {
                Some(violated) if short => {
                    return refused(format!(
                        "the order for perturbed H is {numbers}, not {}: {violated}",
                        listed(orders)
                    ));
                }
                None if short || exactly => {
                    return refused(format!(
                        "the order for perturbed H is {numbers}, and that it is {} cannot be decided here",
                        listed(orders)
                    ));
                }
                _ if exactly && known.order > wanted => {
                    return refused(format!(
                        "the order for perturbed H is {numbers}, not {}",
                        listed(orders)
                    ));
                }
                _ => evidence = evidence.and(self.evidence_to(known, power, wanted)),
            }
        }
        self.enough(requirement, evidence, accepted)
    }

    /// The evidence for at most the order found in a power of `ε`; it may be stronger up to the given order.
    fn evidence_to(&self, found: &PowerOrder, power: usize, order: usize) -> Evidence {
        match (found.evidence, &self.given) {
            (Evidence::Verified { .. }, Some(given)) if given.in_power(power) >= order => {
                given.evidence
            }
            (known, _) => known,
        }
    }
}
