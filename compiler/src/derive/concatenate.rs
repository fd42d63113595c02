//! The coefficients of methods in succession, in a common field.

use std::ptr;
use std::sync::Arc;

use num_rational::BigRational;

use crate::algebra::{Constants, Dense, Field, NodeAlgebra, Real, Reals, StageAlgebra};
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::rational::length;
use crate::error::ErrorKind;
use crate::exact::Exact;
use crate::partitioned::Partitioned;
use crate::symbolic::Constant;

/// The coefficients of `Φ^m_{γ_m h} ∘ … ∘ Φ^1_{γ_1 h}`, the first step first.
///
/// # Errors
/// [`ErrorKind::Definition`] if there is no method, [`ErrorKind::ExpressionSize`] if a node or a coefficient exceeds the
/// bounds of constants.
pub(crate) fn concatenate(parts: &[(&Constant, &Exact)]) -> Result<Exact, ErrorKind> {
    if parts.is_empty() {
        return Err(ErrorKind::Definition {
            message: "a composition is made of one method or more".to_owned(),
        });
    }
    if parts.iter().any(|(_, exact)| exact.has_gradient_kicks()) {
        let message = "a splitting with gradient kicks is composed with splittings only";
        return Err(ErrorKind::Definition {
            message: message.to_owned(),
        });
    }
    // Any algebra holds rational multiples, the strongest one that there is among them.
    if let [(fraction, exact)] = parts
        && let Some(fraction) = fraction.as_rational()
    {
        return Ok(match exact {
            Exact::Nodes(pair) => Exact::Nodes(rational_multiple(pair, fraction)),
            Exact::Field(pair) => Exact::Field(rational_multiple(pair, fraction)),
            Exact::Reals(pair) => Exact::Reals(rational_multiple(pair, fraction)),
        });
    }
    let methods = parts.iter().map(|(_, exact)| Method::new(exact));
    let methods: Vec<Method<'_>> = methods.collect::<Result<_, _>>()?;
    let fractions: Vec<&Constant> = parts.iter().map(|(fraction, _)| *fraction).collect();
    let needed: Option<Vec<Vec<&Constant>>> = methods.iter().map(Method::constants).collect();
    let field = needed.and_then(|needed| {
        let needed = needed.into_iter().flatten();
        let stages = parts.iter().map(|(_, exact)| exact.stages()).sum();
        let words = longest(fractions.iter().copied()) + longest(needed.clone());
        let short = work(stages, words) <= MAX_WORK;
        let fractions = fractions.iter().copied();
        short.then(|| Constants::containing(fractions.chain(needed)))?
    });
    let same = |i: usize, j: usize| parts[i].0 == parts[j].0 && ptr::eq(parts[i].1, parts[j].1);
    let joined = match field {
        Some(field) => join(&field, &fractions, &methods, |_| None, same).map(Exact::Field),
        None => join(&Reals, &fractions, &methods, |x| Some(x.clone()), same).map(Exact::Reals),
    };
    joined.ok_or_else(|| ErrorKind::Definition {
        message: "a constant lies outside the field of the coefficients".to_owned(),
    })
}

/// The products of machine words for all products of two coefficients beyond which exact arithmetic with all that follows
/// takes more than two seconds or so.
const MAX_WORK: u64 = 300_000;

/// The products of machine words for a product of each coefficient of a matrix with another.
fn work(stages: usize, words: u64) -> u64 {
    let stages = stages as u64;
    stages.saturating_mul(stages).saturating_mul(words * words)
}

/// The machine words of the longest rational among constants.
fn longest<'a>(constants: impl Iterator<Item = &'a Constant>) -> u64 {
    let lengths = constants.filter_map(|constant| constant.as_rational().map(length));
    lengths.max().unwrap_or(0) / 64
}

fn rational_multiple<A: StageAlgebra>(
    pair: &Partitioned<A>,
    fraction: &BigRational,
) -> Partitioned<A> {
    pair.scaled(&pair.algebra.constant(fraction))
}

/// A method as far as it does not depend on the field in which it is composed.
enum Method<'a> {
    /// Functions of the nodes, with the nodes.
    Nodes(&'a Partitioned<NodeAlgebra>, Vec<Constant>),
    Constants(Coefficients<Constant>),
    Reals(&'a Partitioned<Dense<Reals>>),
}

/// The entries of `a`, `ã`, `b` and `b̃`. Values that positions and momenta share are stored once, so that they stay
/// equal in a field that does not compare expressions.
struct Coefficients<T> {
    a: Vec<Vec<T>>,
    b: Vec<T>,
    a_tilde: Option<Vec<Vec<T>>>,
    b_tilde: Option<Vec<T>>,
}

impl<T> Coefficients<T> {
    fn iter(&self) -> impl Iterator<Item = &T> {
        let matrices = self.a.iter().chain(self.a_tilde.iter().flatten());
        let vectors = [&self.b].into_iter().chain(&self.b_tilde);
        matrices.chain(vectors).flatten()
    }

    fn map<U>(&self, each: impl Fn(&T) -> Option<U>) -> Option<Coefficients<U>> {
        let vector = |row: &Vec<T>| row.iter().map(&each).collect::<Option<Vec<U>>>();
        let matrix = |rows: &Vec<Vec<T>>| rows.iter().map(vector).collect::<Option<Vec<_>>>();
        let a_tilde = self.a_tilde.as_ref().map(|m| matrix(m).ok_or(()));
        let b_tilde = self.b_tilde.as_ref().map(|v| vector(v).ok_or(()));
        Some(Coefficients {
            a: matrix(&self.a)?,
            b: vector(&self.b)?,
            // A half that is not there is no failure.
            a_tilde: a_tilde.transpose().ok()?,
            b_tilde: b_tilde.transpose().ok()?,
        })
    }

    fn pair<F: Field<Element = T> + Clone>(self, field: &F) -> Partitioned<Dense<F>>
    where
        T: Clone,
    {
        Partitioned {
            algebra: Arc::new(Dense::new(field.clone(), self.b.len())),
            a_tilde: self.a_tilde.unwrap_or_else(|| self.a.clone()),
            b_tilde: self.b_tilde.unwrap_or_else(|| self.b.clone()),
            a: self.a,
            b: self.b,
            gradient: None,
        }
    }
}

/// Something for each coefficient of a pair, if there is one for all.
fn coefficients<A: StageAlgebra, T>(
    pair: &Partitioned<A>,
    matrix: impl Fn(&A::Matrix) -> Option<Vec<Vec<T>>>,
    vector: impl Fn(&A::Vector) -> Option<Vec<T>>,
) -> Option<Coefficients<T>> {
    let (same_a, same_b) = pair.equal_halves();
    Some(Coefficients {
        a: matrix(&pair.a)?,
        b: vector(&pair.b)?,
        a_tilde: if same_a {
            None
        } else {
            Some(matrix(&pair.a_tilde)?)
        },
        b_tilde: if same_b {
            None
        } else {
            Some(vector(&pair.b_tilde)?)
        },
    })
}

/// The same for a pair of lists.
fn entries<F: Field, T>(
    pair: &Partitioned<Dense<F>>,
    each: impl Fn(&F::Element) -> Option<T>,
) -> Option<Coefficients<T>> {
    let vector = |row: &Vec<F::Element>| row.iter().map(&each).collect::<Option<Vec<T>>>();
    coefficients(pair, |rows| rows.iter().map(vector).collect(), vector)
}

impl<'a> Method<'a> {
    fn new(exact: &'a Exact) -> Result<Self, ErrorKind> {
        Ok(match exact {
            Exact::Nodes(pair) => Method::Nodes(pair, pair.algebra.node_constants()?),
            Exact::Field(pair) => {
                let field = pair.algebra.field();
                let constants = entries(pair, |x| field.to_constant(x));
                Method::Constants(constants.ok_or_else(|| ErrorKind::Definition {
                    message: "a coefficient is too long to be composed with others".to_owned(),
                })?)
            }
            Exact::Reals(pair) => Method::Reals(pair),
        })
    }

    /// The constants of which the coefficients are polynomials; `None` if there are none.
    fn constants(&self) -> Option<Vec<&Constant>> {
        match self {
            Method::Nodes(_, nodes) => Some(nodes.iter().collect()),
            Method::Constants(constants) => Some(constants.iter().collect()),
            Method::Reals(_) => None,
        }
    }

    /// The method over a field, if all coefficients are elements.
    fn over<F: Field + Clone>(
        &self,
        field: &F,
        real: impl Fn(&Real) -> Option<F::Element>,
    ) -> Option<Partitioned<Dense<F>>> {
        let coefficients = match self {
            Method::Nodes(pair, nodes) => {
                let nodes = nodes.iter().map(|node| field.constant(node));
                let nodes: Vec<F::Element> = nodes.collect::<Option<_>>()?;
                let vector = |f: &Polynomial| -> Vec<F::Element> {
                    let f: Vec<_> = f.coefficients().iter().map(|q| field.rational(q)).collect();
                    nodes.iter().map(|x| evaluate(field, &f, x)).collect()
                };
                coefficients(
                    pair,
                    |m| {
                        let columns: Vec<_> = m.columns().iter().map(vector).collect();
                        let row = |i: usize| {
                            let in_y: Vec<_> = columns.iter().map(|f| f[i].clone()).collect();
                            nodes.iter().map(|y| evaluate(field, &in_y, y)).collect()
                        };
                        Some((0..nodes.len()).map(row).collect())
                    },
                    |f| Some(vector(f)),
                )?
            }
            Method::Constants(constants) => constants.map(|x| field.constant(x))?,
            Method::Reals(pair) => entries(pair, real)?,
        };
        Some(coefficients.pair(field))
    }
}

/// The value of a polynomial with these coefficients.
fn evaluate<F: Field>(field: &F, polynomial: &[F::Element], x: &F::Element) -> F::Element {
    let value = polynomial.iter().rev().cloned();
    let value = value.reduce(|value, next| field.add(&field.multiply(&value, x), &next));
    value.unwrap_or_else(|| field.rational(&BigRational::default()))
}

/// The composition over a field, if all coefficients are elements.
fn join<F: Field + Clone>(
    field: &F,
    fractions: &[&Constant],
    methods: &[Method<'_>],
    real: impl Fn(&Real) -> Option<F::Element>,
    same: impl Fn(usize, usize) -> bool,
) -> Option<Partitioned<Dense<F>>> {
    let scaled = |(fraction, method): (&&Constant, &Method<'_>)| {
        let pair = method.over(field, &real)?;
        let fraction = field.constant(fraction)?;
        Some(pair.scaled(&vec![fraction; pair.b.len()]))
    };
    let mut steps: Vec<Partitioned<Dense<F>>> = Vec::new();
    for (index, step) in fractions.iter().zip(methods).enumerate() {
        // Where numbers are expressions, equal steps share theirs.
        let known = (0..index).find(|&before| same(before, index));
        let step = known.map_or_else(|| scaled(step), |before| Some(steps[before].clone()))?;
        steps.push(step);
    }
    let zero = field.rational(&BigRational::default());
    let b: Vec<F::Element> = steps.iter().flat_map(|step| step.b.clone()).collect();
    let b_tilde: Vec<F::Element> = steps.iter().flat_map(|step| step.b_tilde.clone()).collect();
    // A stage has the whole steps before its own, and nothing of those after it.
    let rows = |blocks: Vec<&Vec<Vec<F::Element>>>, b: &[F::Element]| {
        let mut rows: Vec<Vec<F::Element>> = Vec::with_capacity(b.len());
        for block in blocks {
            let before = rows.len();
            rows.extend(block.iter().map(|own| {
                let mut row = b[..before].to_vec();
                row.extend_from_slice(own);
                row.resize(b.len(), zero.clone());
                row
            }));
        }
        rows
    };
    Some(Partitioned {
        a: rows(steps.iter().map(|step| &step.a).collect(), &b),
        a_tilde: rows(steps.iter().map(|step| &step.a_tilde).collect(), &b_tilde),
        algebra: Arc::new(Dense::new(field.clone(), b.len())),
        b,
        b_tilde,
        gradient: None,
    })
}
