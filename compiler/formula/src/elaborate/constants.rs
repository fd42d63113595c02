//! Constants without a finite value.

use num_traits::{One, Signed};

use super::Elaborator;
use crate::evaluate::{Evaluator, Point};
use crate::function::Elementary;
use crate::graph::{Dependence, Graph, Id, Node, Number};
use crate::syntax::Expression;
use symplectic_exact::error::FormulaError;
use symplectic_exact::error::{Error, ErrorKind};
use symplectic_exact::rounding::to_f64;

impl Elaborator<'_> {
    /// Refuses a constant that is infinite or NaN in double precision, as the generated code computes it.
    pub(super) fn check_finite(&self, id: Id, at: &Expression) -> Result<(), Error> {
        let exact = self.graph.value(id).map(to_f64);
        match exact.or_else(|| constant_value(&self.graph, id)) {
            Some(value) if !value.is_finite() => {
                let value = self.text(at);
                self.error(at, FormulaError::NotFinite { value })
            }
            _ => Ok(()),
        }
    }

    /// Whether a divisor is 0, or a constant that is 0 in double precision.
    pub(super) fn divides_by_zero(&self, id: Id) -> bool {
        self.graph.is_zero(id) || constant_value(&self.graph, id) == Some(0.0)
    }

    /// An elementary function, at a number in its domain.
    pub(super) fn elementary(
        &mut self,
        function: Elementary,
        x: Id,
        at: &Expression,
    ) -> Result<Id, Error> {
        let value = self.graph.value(x);
        let needs = match function {
            Elementary::Ln if value.is_some_and(|value| !value.is_positive()) => {
                Some("a positive number")
            }
            Elementary::Asin | Elementary::Acos
                if value.is_some_and(|value| value.abs() > Number::one()) =>
            {
                Some("a number from -1 to 1")
            }
            Elementary::Tan
                if self
                    .graph
                    .half_turns(x)
                    .is_some_and(|turns| !turns.is_integer()) =>
            {
                Some("an angle other than pi/2 and its odd multiples")
            }
            _ => None,
        };
        match needs {
            Some(needs) => {
                let kind = ErrorKind::Domain {
                    value: self.text(at),
                    function: function.name(),
                    needs,
                };
                self.error(at, kind)
            }
            None => Ok(self.graph.elementary(function, x)),
        }
    }
}

/// The value of a node without names, other than a number, in double precision.
fn constant_value(graph: &Graph, id: Id) -> Option<f64> {
    if graph.depends(id) != Dependence::default() || graph.value(id).is_some() {
        return None;
    }
    let unknown = |&id: &Id| matches!(graph.node(id), Node::User(..) | Node::Total(..));
    if graph.below([id]).iter().any(unknown) {
        return None;
    }
    let nowhere = Point {
        time: 0.0,
        halves: [Vec::new(), Vec::new()],
        parameters: Vec::new(),
        pairs: Vec::new(),
    };
    Evaluator::new(graph, &nowhere).value(id)
}
