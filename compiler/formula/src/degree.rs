//! The degree of a polynomial H.

use std::collections::HashMap;

use num_traits::{Signed, ToPrimitive};

use super::evaluate::{Evaluator, Real};
use super::graph::{Graph, Id, Node, integer};
use super::modular::{Modular, Points};
use super::system::System;

/// The highest degree that is tested.
const MAX_DEGREE: usize = 32;

/// The degree of H as a polynomial in positions and momenta; `None` if H is not visibly a polynomial.
pub fn degree(system: &System) -> Option<usize> {
    let written = as_written(&system.graph, system.energy)?;
    let points = Points::of(system);
    // The written leading terms may cancel.
    let leading = |degree: &usize| {
        let mut found = points.exact().iter();
        found.any(|point| {
            let mut sum = Modular::number(&integer(0));
            let mut binomial = integer(1);
            for k in 0..=*degree {
                let mut scaled = point.clone();
                let factor = Modular::number(&integer(k as i64));
                for x in scaled.halves.iter_mut().flatten().flatten() {
                    *x = x.multiply(&factor);
                }
                let sign = if (degree - k).is_multiple_of(2) {
                    1
                } else {
                    -1
                };
                let weight = Modular::number(&(&binomial * integer(sign)));
                let Some(value) = Evaluator::new(&system.graph, &scaled).value(system.energy)
                else {
                    return false;
                };
                sum = sum.add(&weight.multiply(&value));
                binomial = binomial * integer((degree - k) as i64) / integer(k as i64 + 1);
            }
            sum.is_not_zero()
        })
    };
    (0..=written).rev().find(leading)
}

/// The degree before terms cancel.
fn as_written(graph: &Graph, root: Id) -> Option<usize> {
    let mut known: HashMap<Id, usize> = HashMap::new();
    for id in graph.below([root]) {
        let depends = graph.depends(id);
        let degree = match graph.node(id) {
            _ if !depends.q && !depends.p => 0,
            Node::Coordinate(_) => 1,
            Node::Sum(terms, _) => terms.iter().map(|(_, x)| known[x]).max()?,
            Node::Product(factors) => {
                let mut sum = 0_usize;
                for (x, exponent) in factors {
                    let inner = known[x];
                    if inner > 0 && (exponent.is_negative() || !exponent.is_integer()) {
                        return None;
                    }
                    sum = sum.checked_add(inner.checked_mul(exponent.to_usize().unwrap_or(0))?)?;
                }
                sum
            }
            Node::Total(_, body) => known[body],
            _ => return None,
        };
        if degree > MAX_DEGREE {
            return None;
        }
        known.insert(id, degree);
    }
    known.get(&root).copied()
}
