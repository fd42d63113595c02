//! `cos a cos b + sin a sin b = cos(a − b)`, so that masses written in Cartesian velocities become short: `sin² + cos² = 1`.

use std::collections::BTreeMap;

use num_traits::One;

use super::function::Elementary;
use super::graph::{Graph, Id, Node, Number, integer};

/// The largest number of terms into which a formula is expanded.
const MAX_TERMS: usize = 128;
/// The largest number of simplification rounds.
const MAX_ROUNDS: usize = 128;

/// Factors with their exponents.
type Factors = BTreeMap<Id, Number>;
/// Factors with their exponents as a list.
type Product = Vec<(Id, Number)>;
/// Products of factors with their coefficients.
type Terms = BTreeMap<Product, Number>;

/// The formula with the identity applied to its terms, or unchanged if it does not apply.
pub(super) fn shortened(graph: &mut Graph, id: Id) -> Id {
    let Some(mut terms) = expanded(graph, id) else {
        return id;
    };
    let mut found = false;
    for _ in 0..MAX_ROUNDS {
        let Some(shorter) = addition(graph, &terms) else {
            break;
        };
        (terms, found) = (shorter, true);
    }
    if !found {
        return id;
    }
    let terms: Vec<_> = terms
        .into_iter()
        .map(|(factors, factor)| (factor, graph.product(Number::one(), factors)))
        .collect();
    graph.sum(terms)
}

/// The terms of a formula multiplied out; `None` if there are too many.
fn expanded(graph: &Graph, id: Id) -> Option<Terms> {
    let mut known: BTreeMap<Id, Terms> = BTreeMap::new();
    for id in graph.below([id]) {
        let terms = match graph.node(id) {
            Node::Constant(value) => Terms::from([(Vec::new(), value.clone())]),
            Node::Sum(parts, constant) => {
                let mut sum = Terms::new();
                add(&mut sum, Vec::new(), constant.clone());
                for (factor, part) in parts {
                    for (factors, inner) in known.get(part)? {
                        add(&mut sum, factors.clone(), factor * inner);
                    }
                }
                sum
            }
            Node::Product(parts) => {
                let mut product = Terms::from([(Vec::new(), Number::one())]);
                for (part, exponent) in parts {
                    let single = Terms::from([(vec![(*part, exponent.clone())], Number::one())]);
                    let sum = known.get(part)?;
                    let times = u32::try_from(&exponent.to_integer());
                    match (exponent.is_integer(), times) {
                        (true, Ok(times @ 1..=8)) => {
                            for _ in 0..times {
                                product = multiplied(&product, sum)?;
                            }
                        }
                        _ => product = multiplied(&product, &single)?,
                    }
                }
                product
            }
            _ => Terms::from([(vec![(id, Number::one())], Number::one())]),
        };
        if terms.len() > MAX_TERMS {
            return None;
        }
        known.insert(id, terms);
    }
    known.remove(&id)
}

fn add(terms: &mut Terms, factors: Product, factor: Number) {
    let sum = terms.remove(&factors).unwrap_or_default() + factor;
    if sum != Number::default() {
        terms.insert(factors, sum);
    }
}

fn multiplied(a: &Terms, b: &Terms) -> Option<Terms> {
    let mut product = Terms::new();
    for (left, factor) in a {
        for (right, other) in b {
            let mut factors: Factors = left.iter().cloned().collect();
            for (x, exponent) in right {
                *factors.entry(*x).or_default() += exponent;
            }
            factors.retain(|_, exponent| *exponent != Number::default());
            add(&mut product, factors.into_iter().collect(), factor * other);
        }
    }
    (product.len() <= MAX_TERMS).then_some(product)
}

/// The terms with a pair of cosines and a pair of sines replaced by one cosine.
fn addition(graph: &mut Graph, terms: &Terms) -> Option<Terms> {
    for (cosines, factor) in terms {
        for ([a, b], rest) in pairs(graph, cosines, Elementary::Cos) {
            let mut sines: Factors = rest.iter().cloned().collect();
            for angle in [a, b] {
                let sine = graph.elementary(Elementary::Sin, angle);
                *sines.entry(sine).or_default() += integer(1);
            }
            let sines: Product = sines.into_iter().collect();
            let Some(partner) = terms.get(&sines) else {
                continue;
            };
            let sign = match partner {
                same if same == factor => -1,
                other if -other == *factor => 1,
                _ => continue,
            };
            let angle = graph.sum([(integer(1), a), (integer(sign), b)]);
            let cosine = graph.elementary(Elementary::Cos, angle);
            let mut factors: Factors = rest.into_iter().collect();
            let mut factor = factor.clone();
            match graph.value(cosine) {
                Some(value) => factor *= value,
                None => *factors.entry(cosine).or_default() += integer(1),
            }
            let mut shorter = terms.clone();
            shorter.remove(cosines);
            shorter.remove(&sines);
            add(&mut shorter, factors.into_iter().collect(), factor);
            return Some(shorter);
        }
    }
    None
}

/// The arguments of two factors of a product that are this function, and the remaining factors.
fn pairs(graph: &Graph, factors: &[(Id, Number)], function: Elementary) -> Vec<([Id; 2], Product)> {
    let angle = |x: Id| match graph.node(x) {
        Node::Elementary(known, angle) if *known == function => Some(*angle),
        _ => None,
    };
    let whole = |exponent: &Number| exponent.is_integer() && *exponent >= integer(1);
    let mut found = Vec::new();
    for (k, (x, exponent)) in factors.iter().enumerate() {
        for (other, exponent_of_other) in &factors[k..] {
            let twice = x == other;
            let (Some(a), Some(b)) = (angle(*x), angle(*other)) else {
                continue;
            };
            if !whole(exponent) || !whole(exponent_of_other) || twice && *exponent < integer(2) {
                continue;
            }
            let mut rest: Factors = factors.iter().cloned().collect();
            for x in [x, other] {
                rest.entry(*x)
                    .and_modify(|exponent| *exponent -= integer(1));
            }
            rest.retain(|_, exponent| *exponent != Number::default());
            found.push(([a, b], rest.into_iter().collect()));
        }
    }
    found
}
