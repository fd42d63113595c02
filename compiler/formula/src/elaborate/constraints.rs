//! Holonomic constraints.

use super::smooth::Role;
use super::{Elaborator, Value};
use crate::graph::{Base, Id, LoopRange};
use crate::syntax::{self, Expression, Length};
use crate::system::Constraint;
use symplectic_exact::error::Error;
use symplectic_exact::error::FormulaError;

impl Elaborator<'_> {
    /// The constraints: functions of the positions that vanish.
    pub(super) fn constraints(&mut self) -> Result<Vec<Constraint>, Error> {
        let definition = self.definition;
        self.families(&definition.constraints, &[], Self::zeros)
    }

    /// Families of constraints, each with its indices; `parts` reads the vanishing functions. Names must differ from those of `others`.
    pub(super) fn families(
        &mut self,
        all: &[syntax::Constraint],
        others: &[Constraint],
        parts: fn(&mut Self, &Expression) -> Result<Vec<Id>, Error>,
    ) -> Result<Vec<Constraint>, Error> {
        let mut constraints: Vec<Constraint> = Vec::new();
        for written in all {
            let name = &written.name;
            let mut known = constraints.iter().chain(others);
            let known = known.any(|known| known.name == name.text);
            if known || self.names.contains_key(&name.text) {
                let meaning = match known {
                    true => "a constraint".to_owned(),
                    false => self.meaning(&name.text),
                };
                let kind = FormulaError::Taken {
                    name: name.text.clone(),
                    meaning,
                };
                return Err(self.input.error(&name.span, kind.into()));
            }
            let value = &written.value;
            let parts = match &written.over {
                None => parts(self, value)?,
                Some(over) => self.under(over, value, |this| parts(this, value))?,
            };
            let loops = std::mem::take(&mut self.loops);
            let over = match loops[..] {
                [] => None,
                [over] => Some(over),
                _ => {
                    let kind = FormulaError::Unsupported {
                        what: "a constraint for every `i < j`".to_owned(),
                        instead: "write the pairs as a parameter: `rods: pairs`, `rod(s = (i, j) in rods) = …`",
                    };
                    return Err(self.input.error(&name.span, kind.into()));
                }
            };
            if let Some(over) = over
                && let LoopRange::Between(_, end) = &self.graph.get_loop(over).range
                && end.base == Base::End(Length::Runtime)
            {
                let kind = FormulaError::Unsupported {
                    what: "a constraint for every index of a length that is known when the program runs".to_owned(),
                    instead: "write the pairs as a parameter: `rods: pairs`, `rod(s = (i, j) in rods) = …`",
                };
                return Err(self.input.error(&name.span, kind.into()));
            }
            constraints.push(Constraint {
                name: name.text.clone(),
                over,
                parts,
            });
        }
        Ok(constraints)
    }

    /// A function of the positions, or a vector of them.
    fn zeros(&mut self, written: &Expression) -> Result<Vec<Id>, Error> {
        let parts = self.one_or_more(written)?;
        for &part in &parts {
            let depends = self.graph.depends(part);
            let what = match (depends.p, depends.v, depends.time) {
                (true, ..) => "a momentum in a constraint",
                (_, true, _) => "a velocity in a constraint",
                (_, _, true) => "the time in a constraint",
                _ if !depends.q => "a constraint without a position",
                _ => continue,
            };
            let kind = FormulaError::Unsupported {
                what: what.to_owned(),
                instead: "a holonomic constraint is a function of the positions that is zero",
            };
            return self.error(written, kind);
        }
        for &part in &parts {
            self.check_smooth(part, Role::Constraint, written)?;
        }
        Ok(parts)
    }

    /// A number, or the components of a vector.
    pub(super) fn one_or_more(&mut self, written: &Expression) -> Result<Vec<Id>, Error> {
        match self.value(written)? {
            Value::Scalar(id) => Ok(vec![id]),
            value => self.components(value, written),
        }
    }
}
