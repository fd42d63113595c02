//! Non-holonomic constraints: forms that are linear in the velocities.

use num_traits::One;

use super::Elaborator;
use super::smooth::Role;
use crate::derivative::gradient;
use crate::graph::{Graph, Half, Id, LoopId, Node, Number};
use crate::rewrite::at_rest;
use crate::structure::terms;
use crate::syntax::{Expression, Span};
use crate::system::Constraint;
use symplectic_exact::error::Error;
use symplectic_exact::error::FormulaError;

/// The required form of a non-holonomic constraint.
const FORM: &str = "a non-holonomic constraint is a sum of velocities times functions of the positions, which is zero: `edge = vx sin(a) - vy cos(a)`";

impl Elaborator<'_> {
    /// The non-holonomic constraints, each linear in the velocities.
    pub(super) fn nonholonomic(
        &mut self,
        holonomic: &[Constraint],
    ) -> Result<Vec<Constraint>, Error> {
        let definition = self.definition;
        let found = self.families(&definition.nonholonomic, holonomic, Self::forms)?;
        if found.is_empty() {
            return Ok(found);
        }
        // Without those of `read_with`, which have no name.
        let mut declared = (definition.invariants.iter()).filter(|(name, _)| !name.text.is_empty());
        let (what, span) = if let Some(known) = definition.constraints.first() {
            (
                "holonomic and non-holonomic constraints together",
                &known.name.span,
            )
        } else if let Some(friction) = &definition.friction {
            ("friction with constraints", &friction.span)
        } else if let Some((name, _)) = declared.next() {
            (
                "a conserved quantity with non-holonomic constraints",
                &name.span,
            )
        } else {
            return Ok(found);
        };
        let instead = match what.starts_with("a conserved") {
            true => "leave it out: of what is conserved only H is known",
            false => "leave out one of them",
        };
        let kind = FormulaError::Unsupported {
            what: what.to_owned(),
            instead,
        };
        Err(self.input.error(span, kind.into()))
    }

    /// A form, or a vector of forms.
    fn forms(&mut self, written: &Expression) -> Result<Vec<Id>, Error> {
        let parts = self.one_or_more(written)?;
        for &part in &parts {
            self.form(part, written)?;
            self.check_smooth(part, Role::Form, written)?;
        }
        Ok(parts)
    }

    /// Checks that a formula is nonzero and linear in the velocities, with functions of the positions as factors.
    fn form(&mut self, part: Id, written: &Expression) -> Result<(), Error> {
        let depends = self.graph.depends(part);
        let wrong = match (depends.p, depends.time, depends.v) {
            (true, ..) => Some("a momentum in a non-holonomic constraint"),
            (_, true, _) => Some("the time in a non-holonomic constraint"),
            (_, _, false) => Some("a non-holonomic constraint without a velocity"),
            _ => None,
        };
        if let Some(what) = wrong {
            return self.no_form(what, &written.span);
        }
        let loops: Vec<LoopId> = self.loops.clone();
        let whole = |graph: &Graph, id: Id| !graph.depends(id).v;
        let terms = terms(&mut self.graph, part, whole).unwrap_or_else(|| vec![(part, part)]);
        for (term, from) in terms {
            let rest = at_rest(&mut self.graph, term);
            let rates = gradient(&mut self.graph, term, &loops, Number::one(), Half::V);
            let what = if !self.graph.is_zero(rest) {
                "a term without a velocity in a non-holonomic constraint"
            } else if rates.iter().any(|rate| self.graph.depends(rate.value).v) {
                "a term that is not linear in the velocities"
            } else {
                continue;
            };
            let place = self.places.get(&from).cloned();
            return self.no_form(what, &place.unwrap_or_else(|| written.span.clone()));
        }
        Ok(())
    }

    fn no_form(&self, what: &str, span: &Span) -> Result<(), Error> {
        let kind = FormulaError::Unsupported {
            what: what.to_owned(),
            instead: FORM,
        };
        Err(self.input.error(span, kind.into()))
    }

    /// Checks that a formula contains no velocity that is declared for the constraints.
    pub(super) fn no_velocity(&self, formula: Id, written: &Expression) -> Result<(), Error> {
        let below = self.graph.below([formula]);
        let found = below.into_iter().find(|&id| match self.graph.node(id) {
            Node::Coordinate(coordinate) => coordinate.half == Half::V,
            _ => false,
        });
        let Some(found) = found else {
            return Ok(());
        };
        let kind = FormulaError::Unsupported {
            what: "a velocity in a formula of momenta".to_owned(),
            instead: "write it with the momenta; velocities are for `nonholonomic: {…}`",
        };
        let span = self.places.get(&found).unwrap_or(&written.span);
        Err(self.input.error(span, kind.into()))
    }
}
