//! Whether formulas are as smooth as they have to be.

use super::Elaborator;
use crate::graph::{Id, Node};
use crate::smooth::{Powers, Smoothness, kinks};
use crate::syntax::{Expression, Form, Span};
use symplectic_exact::error::Error;
use symplectic_exact::error::FormulaError;

/// What a formula is, and so how smooth it has to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// H or L: its second derivatives are needed.
    Function,
    /// A holonomic constraint: as for H, which contains it.
    Constraint,
    /// An applied force: its first derivatives are needed.
    Force,
    /// A non-holonomic constraint: as for forces.
    Form,
    /// A conserved quantity: only its values are needed.
    Quantity,
}

impl Elaborator<'_> {
    /// Keeps the place of a power that is not whole.
    pub(super) fn keep_power(&mut self, id: Id, at: &Span) {
        let (_, inner) = self.graph.scaled(id);
        if let Node::Product(factors) = self.graph.node(inner) {
            for (base, exponent) in factors {
                if !exponent.is_integer() {
                    self.powers.entry(*base).or_insert_with(|| at.clone());
                }
            }
        }
    }

    /// Refuses a formula that has not enough continuous derivatives where a function in it changes its sign.
    pub(super) fn check_smooth(
        &self,
        id: Id,
        role: Role,
        written: &Expression,
    ) -> Result<(), Error> {
        let function = match self.definition.form {
            Form::Hamiltonian => "H",
            Form::Lagrangian => "L",
        };
        let (formula, order) = match role {
            Role::Function => (function, 2),
            Role::Constraint => ("a constraint", 2),
            Role::Force => ("a force", 1),
            Role::Form => ("a non-holonomic constraint", 1),
            Role::Quantity => ("a quantity", 0),
        };
        for (kink, smoothness) in kinks(&self.graph, id, order, Powers::Given, |kink| {
            kink.is_crossed
        }) {
            if matches!(smoothness, Smoothness::Smooth | Smoothness::Infinite) {
                continue;
            }
            let place = kink.bases.iter().find_map(|base| self.powers.get(base));
            let place = place.unwrap_or(&written.span);
            let kind = FormulaError::Kink {
                function: self.input.text[place.clone()].to_owned(),
                formula,
                times: ["", "once ", "twice "][order as usize],
                instead: match (smoothness, order) {
                    (Smoothness::TooLong, _) => "the formula is too long to examine it there",
                    (_, 0) => "write the function on one side of it",
                    (_, 1) => {
                        "write a power above 1 as in `|x|^(3/2)` or `max(x, 0)^2`, a product as in `x |x|`, or `sqrt(x^2 + a^2)`"
                    }
                    _ => {
                        "write a power above 2 as in `|x|^3` or `max(x, 0)^(5/2)`, a product as in `x^2 |x|`, or `sqrt(x^2 + a^2)`"
                    }
                },
            };
            return Err(self.input.error(place, kind.into()));
        }
        Ok(())
    }
}
