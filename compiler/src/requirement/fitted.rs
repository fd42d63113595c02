//! What can be required of a method that is fitted to a frequency: it must hold for every frequency.

use super::Requirement;
use crate::error::ErrorKind;
use crate::fitted::Fitted;
use crate::hamiltonian_class::HamiltonianClass;

impl Fitted {
    /// Checks a requirement: `symplectic`, `symmetric`, `consistent`, or an order for small steps at a fixed frequency.
    ///
    /// # Errors
    /// [`ErrorKind::Requirement`] if it is refuted, or is not among these.
    ///
    /// ```
    /// use symplectic_compiler::{Definition, Fitted, Limits, Requirement};
    ///
    /// let gauss = Definition::parse("parameters: w, basis: [cos(w*t), sin(w*t)], nodes: gauss(2)")?;
    /// let gauss = Fitted::derive(&gauss, &Limits::default())?;
    /// gauss.require(&Requirement::parse("order >= 4")?)?;
    /// let error = gauss.require(&Requirement::parse("consistent")?).unwrap_err();
    /// assert_eq!(error.to_string(), "the method is not `consistent` for every w: the weights do not sum to 1");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn require(&self, requirement: &Requirement) -> Result<(), ErrorKind> {
        let w = self.parameter();
        let refused = |message: String| Err(ErrorKind::Requirement { message });
        let property = |name: &str| match name {
            "symplectic" => Some((true, "")),
            "symmetric" => Some((self.is_symmetric(), "the adjoint method is another one")),
            "consistent" => Some((self.is_consistent(), "the weights do not sum to 1")),
            _ => None,
        };
        match requirement {
            Requirement::Property(name) | Requirement::ClassProperty { name, .. } => {
                match property(name) {
                    Some((true, _)) => return Ok(()),
                    Some((false, witness)) => {
                        let message =
                            format!("the method is not `{name}` for every {w}: {witness}");
                        return refused(message);
                    }
                    None => {}
                }
            }
            Requirement::Order {
                class,
                exactly,
                order,
            } => {
                let orders = self.orders()?;
                let found = match class {
                    HamiltonianClass::General => orders.general,
                    HamiltonianClass::Separable => orders.separable,
                    HamiltonianClass::Nystrom => orders.nystrom,
                };
                let holds = match exactly {
                    true => found.order == *order && found.violated.is_some(),
                    false => found.order >= *order,
                };
                return match holds {
                    true => Ok(()),
                    false => {
                        let at_least = if found.violated.is_none() {
                            "at least "
                        } else {
                            ""
                        };
                        refused(format!(
                            "the order for {class} H, for small steps at a fixed {w}, is {at_least}{}, not {order}",
                            found.order
                        ))
                    }
                };
            }
            Requirement::PerturbedOrder { .. }
            | Requirement::PStable
            | Requirement::StableTo(_) => {}
        }
        refused(format!(
            "`{requirement}` is not decided for a method with `parameters`; these are: symplectic, symmetric, consistent, order >= 4. For one number \
             it is: leave out `parameters` and write that number for {w}"
        ))
    }
}
