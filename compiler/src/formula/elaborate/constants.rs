//! Constants without a finite value, and kinks that are written as powers.

use num_traits::{One, Signed, Zero};

use super::Elaborator;
use super::arithmetic::kink;
use crate::arithmetic::rounding::to_f64;
use crate::error::{Error, ErrorKind};
use crate::formula::error::FormulaError;
use crate::formula::evaluate::{Evaluator, Point};
use crate::formula::function::Elementary;
use crate::formula::graph::{Dependence, Graph, Id, Node, Number, integer};
use crate::formula::syntax::{Expression, Span};

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

    /// Refuses `(x²)ᵉ` where it is `|x|²ᵉ` with a kink: `sqrt(x^2)` is `|x|`.
    pub(super) fn no_kink(&self, x: Id, exponent: &Number, at: &Span) -> Result<(), Error> {
        let (_, inner) = self.graph.scaled(x);
        let Node::Product(factors) = self.graph.node(inner) else {
            return Ok(());
        };
        let two = integer(2);
        let is_even = |number: &Number| (number / &two).is_integer();
        let has_kink = |(base, power): &(Id, Number)| {
            let whole = power * exponent;
            let depends = self.graph.depends(*base);
            is_even(power)
                && whole.is_positive()
                && whole <= two
                && !is_even(&whole)
                && (depends.q || depends.p || depends.v)
                && !has_one_sign(&self.graph, *base)
        };
        match !exponent.is_integer() && factors.iter().any(has_kink) {
            true => {
                let written = &self.input.text[at.clone()];
                let function = format!("`{written}`, a power of an absolute value,");
                Err(self.input.error(at, kink(&function).into()))
            }
            false => Ok(()),
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

/// Whether a value is visibly never negative.
fn has_one_sign(graph: &Graph, id: Id) -> bool {
    match graph.node(id) {
        Node::Constant(value) => !value.is_negative(),
        Node::Pi => true,
        Node::Sum(terms, constant) => {
            let mut terms = terms.iter();
            !constant.is_negative()
                && terms.all(|(factor, x)| factor.is_positive() && has_one_sign(graph, *x))
        }
        // An even power, or one whose denominator is even.
        Node::Product(factors) => factors.iter().all(|(x, exponent)| {
            let [above, below] =
                [exponent.numer(), exponent.denom()].map(|part| (part % 2_u32).is_zero());
            above || below || has_one_sign(graph, *x)
        }),
        Node::Elementary(Elementary::Exp | Elementary::Cosh | Elementary::Acos, _) => true,
        Node::Total(_, body) => has_one_sign(graph, *body),
        _ => false,
    }
}
