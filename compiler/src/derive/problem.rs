//! The parsed parts of a definition.

use std::fmt;
use std::sync::{Arc, OnceLock};

use super::base_method::Based;
use super::certified::Certified;
use super::composition::{self, Step};
use super::construction_kind::Kind;
use super::processed::Processed;
use super::reading::{Errors, misfit, misfit_at, read_matrix, read_vector, switch};
use super::sequence::{Factor, Sequence};
use super::splitting::Splitting;
use crate::basis::Basis;
use crate::certify::Claim;
use crate::definition::{Definition, Key};
use crate::error::{Error, ErrorKind};
use crate::exact::{Exact, over_algebra};
use crate::limits::Limits;
use crate::order::GivenOrder;
use crate::quadrature::Nodes;
use crate::symbolic::Constant;

/// A definition whose texts have been parsed. Clones share the construction and what has been derived from it.
#[derive(Clone)]
pub struct Problem {
    construction: Arc<Constructed>,
    /// Whether positions and momenta are exchanged at the end.
    exchange: bool,
    /// Whether the method is the adjoint of the construction.
    adjoint: bool,
}

/// A construction with its coefficients, derived when they are first needed.
struct Constructed {
    construction: Construction,
    exact: OnceLock<Arc<Exact>>,
}

impl fmt::Debug for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.definition())
    }
}

/// The constructions of [`super`], given coefficients, and compositions of other methods.
pub enum Construction {
    /// As many functions as nodes.
    Collocation { basis: Basis, nodes: Nodes },
    /// A quadrature formula with at least as many nodes as there are functions.
    Galerkin {
        basis: Basis,
        nodes: Nodes,
        /// The weights, if they are not the interpolatory ones.
        weights: Option<Vec<Constant>>,
    },
    /// Given coefficients.
    Given {
        a: Vec<Vec<Constant>>,
        b: Vec<Constant>,
        momenta: Momenta,
    },
    /// A sequence of drifts and kicks.
    Splitting(Splitting),
    /// The exact drifts and kicks behind printed ones.
    Certified(Certified),
    /// A composition of steps of one base method.
    Based(Box<Based>),
    /// A composition of steps of other methods.
    Composition { steps: Vec<Step> },
    /// A kernel between a processor and its inverse.
    Processed(Box<Processed>),
}

impl Construction {
    /// The sequence of kicks and drifts of the step, if it consists of them.
    pub fn sequence(&self) -> Option<Sequence> {
        match self {
            Construction::Splitting(splitting) => Some(splitting.sequence()),
            Construction::Certified(certified) => Some(certified.sequence()),
            Construction::Based(based) => based.sequence(),
            Construction::Composition { .. } | Construction::Processed(_) => {
                Sequence::joined(self.composed()?.iter().map(|step| {
                    (
                        Factor::Constant(step.fraction.clone()),
                        step.method.sequence(),
                    )
                }))
            }
            Construction::Collocation { .. }
            | Construction::Galerkin { .. }
            | Construction::Given { .. } => None,
        }
    }

    /// The steps of different methods of which it consists.
    pub fn composed(&self) -> Option<&[Step]> {
        match self {
            Construction::Composition { steps } => Some(steps),
            Construction::Processed(processed) => Some(processed.steps()),
            _ => None,
        }
    }
}

/// The coefficients for momenta, for given coefficients for positions.
pub enum Momenta {
    /// `ã = a`, `b̃ = b`.
    Equal,
    /// `ã` such that the pair is symplectic, `b̃ = b`.
    SymplecticPartner,
    /// Given coefficients.
    Given {
        a_tilde: Vec<Vec<Constant>>,
        b_tilde: Vec<Constant>,
    },
}

/// The keyword for [`Momenta::SymplecticPartner`].
const SYMPLECTIC_PARTNER: &str = "symplectic_partner";

impl Problem {
    pub(super) fn new(construction: Construction) -> Self {
        let exact = OnceLock::new();
        Problem {
            construction: Arc::new(Constructed {
                construction,
                exact,
            }),
            exchange: false,
            adjoint: false,
        }
    }

    /// As many functions as nodes.
    pub fn collocation(basis: Basis, nodes: Nodes) -> Self {
        Problem::new(Construction::Collocation { basis, nodes })
    }

    /// Steps of methods one after another.
    pub fn composition(steps: Vec<Step>) -> Self {
        Problem::new(Construction::Composition { steps })
    }

    /// The problem of the adjoint method.
    #[must_use]
    pub fn adjoint(&self) -> Self {
        Problem {
            adjoint: !self.adjoint,
            ..self.clone()
        }
    }

    fn construction(&self) -> &Construction {
        &self.construction.construction
    }

    /// Reads all parts.
    ///
    /// # Errors
    /// All errors in the parts, at most one per part.
    pub fn read(definition: &Definition, limits: &Limits) -> Result<Self, Vec<Error>> {
        let mut errors = Errors(Vec::new());
        let exchange = errors
            .note(switch(definition, Key::Exchange))
            .unwrap_or_default();
        let adjoint = errors
            .note(switch(definition, Key::Adjoint))
            .unwrap_or_default();
        let kind = Kind::of(definition);
        if let Some(name) = definition.get(Key::Parameters) {
            errors.push(misfit_at(definition, Key::Parameters, format!(
                "with `parameters` the coefficients are functions of `{name}`, and this needs numbers: give the parameter a number, on the command line by `--at {name}=3`"
            )));
            return Err(errors.0);
        }
        if let Some((key, _)) = definition.parts().find(|&(key, _)| !kind.takes(key)) {
            errors.push(misfit(kind.refuses(key)));
        }
        let construction = match kind {
            Kind::Composition => {
                let text = definition.get(Key::Compose).unwrap_or_default();
                let steps = composition::read(text, limits).map_err(|all| errors.extend(all));
                steps.ok().map(|steps| Construction::Composition { steps })
            }
            Kind::Based | Kind::Splitting if definition.get(Key::Processor).is_some() => {
                let processed = Processed::read(definition, kind, limits, &mut errors);
                processed.map(|found| Construction::Processed(Box::new(found)))
            }
            Kind::Based => Based::read(definition, limits, &mut errors).map(Construction::from),
            Kind::Splitting => {
                Splitting::read_exact(definition, limits, &mut errors).map(Construction::Splitting)
            }
            Kind::Certified => {
                Certified::read(definition, limits, &mut errors).map(Construction::Certified)
            }
            Kind::Given => read_given(definition, limits, &mut errors),
            Kind::Derived => read_derived(definition, limits, &mut errors),
        };
        if exchange
            && let Some(sequence) = construction.as_ref().and_then(Construction::sequence)
            && sequence.has_gradient_kicks()
        {
            let message = "`exchange` would make drifts of gradient kicks, which change momenta only: leave it out";
            errors.push(misfit_at(definition, Key::Exchange, message.to_owned()));
        }
        match construction {
            Some(construction) if errors.0.is_empty() => Ok(Problem {
                exchange,
                adjoint,
                ..Problem::new(construction)
            }),
            _ => Err(errors.0),
        }
    }

    /// The parts in canonical form.
    pub fn definition(&self) -> Definition {
        let row = |row: &Vec<Constant>| {
            let row: Vec<String> = row.iter().map(ToString::to_string).collect();
            row.join(", ")
        };
        let rows = |rows: &[Vec<Constant>]| {
            let rows: Vec<String> = rows.iter().map(|r| format!("[{}]", row(r))).collect();
            format!("[{}]", rows.join(", "))
        };
        let mut parts = match self.construction() {
            Construction::Collocation { basis, nodes } => vec![
                (Key::Basis, basis.name().to_owned()),
                (Key::Nodes, nodes.name().to_owned()),
            ],
            Construction::Galerkin {
                basis,
                nodes,
                weights,
            } => {
                let weights = weights.as_ref().map(|weights| (Key::Weights, row(weights)));
                let parts = [
                    (Key::Basis, basis.name().to_owned()),
                    (Key::Quadrature, nodes.name().to_owned()),
                ];
                parts.into_iter().chain(weights).collect()
            }
            Construction::Given { a, b, momenta } => {
                let mut parts = vec![(Key::A, rows(a)), (Key::B, row(b))];
                match momenta {
                    Momenta::Equal => {}
                    Momenta::SymplecticPartner => {
                        parts.push((Key::ATilde, SYMPLECTIC_PARTNER.to_owned()));
                    }
                    Momenta::Given { a_tilde, b_tilde } => {
                        parts.push((Key::ATilde, rows(a_tilde)));
                        if b_tilde != b {
                            parts.push((Key::BTilde, row(b_tilde)));
                        }
                    }
                }
                parts
            }
            Construction::Composition { steps } => {
                let definitions: Vec<Definition> =
                    steps.iter().map(|step| step.method.definition()).collect();
                let fractions = steps.iter().map(|step| &step.fraction);
                let composition = Definition::composition(fractions.zip(&definitions));
                let parts = composition.parts();
                parts.map(|(key, text)| (key, text.to_owned())).collect()
            }
            Construction::Splitting(splitting) => splitting.parts(ToString::to_string),
            Construction::Certified(certified) => certified.parts(),
            Construction::Based(based) => based.parts(),
            Construction::Processed(processed) => processed.parts(),
        };
        for (key, on) in [(Key::Exchange, self.exchange), (Key::Adjoint, self.adjoint)] {
            if on {
                parts.push((key, "true".to_owned()));
            }
        }
        Definition::new(parts)
    }

    /// The sequence of kicks and drifts of the step, if it consists of them: for a splitting, or a composition of
    /// splittings only.
    pub fn sequence(&self) -> Option<Sequence> {
        let mut sequence = self.construction().sequence()?;
        if self.exchange {
            sequence = sequence.exchanged();
        }
        Some(if self.adjoint {
            sequence.reversed()
        } else {
            sequence
        })
    }

    /// The order that follows from the construction of the method with these coefficients.
    pub fn given(&self, exact: &Exact) -> Option<GivenOrder> {
        self.constructed_order().map(|given| GivenOrder {
            symmetric: over_algebra!(exact, pair => {
                pair.flows().is_some_and(|flows| flows.is_palindrome())
            }),
            ..given
        })
    }

    /// The order that follows from the construction, without the symmetry of a splitting.
    pub fn constructed_order(&self) -> Option<GivenOrder> {
        let given = match self.construction() {
            Construction::Certified(certified) => {
                Some(GivenOrder::certified(certified.claim().clone()))
            }
            Construction::Based(based) => based.given(),
            Construction::Processed(processed) => processed.given(),
            _ => None,
        }?;
        // With positions and momenta exchanged, U is quadratic, or T is the perturbation.
        let separable = matches!(given.claim, Claim::Separable(_));
        (separable || !self.exchange).then_some(given)
    }

    /// The printed numbers that differ from the rounded exact ones: each at its place, or without a place in steps of a
    /// composition.
    pub fn wrong_digits(&self) -> Vec<Error> {
        match self.construction() {
            Construction::Certified(certified) => certified.wrong_digits().to_vec(),
            Construction::Based(based) => based.wrong_digits().to_vec(),
            Construction::Processed(processed) => processed.wrong_digits().to_vec(),
            Construction::Composition { steps } => {
                let all = steps.iter().flat_map(|step| step.method.wrong_digits());
                all.map(|error| (*error.kind).into()).collect()
            }
            Construction::Collocation { .. }
            | Construction::Galerkin { .. }
            | Construction::Given { .. }
            | Construction::Splitting(_) => Vec::new(),
        }
    }

    /// The number of stages of the method, or a bound on it; of a processed method the larger of the numbers of its kernel and its processor.
    pub fn stages(&self) -> usize {
        match self.construction() {
            Construction::Collocation { nodes, .. } | Construction::Galerkin { nodes, .. } => {
                nodes.len()
            }
            Construction::Given { b, .. } => b.len(),
            Construction::Splitting(splitting) => splitting.sequence().stages(),
            Construction::Certified(certified) => certified.stages(),
            Construction::Based(based) => based.stages(),
            // Limits apply to what is written.
            Construction::Processed(processed) => {
                let [kernel, processor] = processed.parts_of_run();
                kernel.stages().max(processor.stages())
            }
            Construction::Composition { .. } => {
                let steps = self.construction().composed().unwrap_or_default();
                match self.construction().sequence() {
                    Some(sequence) => sequence.stages(),
                    None => steps.iter().map(|step| step.method.stages()).sum(),
                }
            }
        }
    }

    /// The functions for which the construction is exact, if they are not polynomials: rows and weights of the square construction
    /// integrate them exactly. Also whether these are the rows of the momenta.
    pub fn exact_on(&self) -> Option<(&Basis, bool)> {
        match self.construction() {
            Construction::Collocation { basis, .. } => {
                let fitted = basis.polynomials().is_none() && !self.adjoint;
                fitted.then_some((basis, self.exchange))
            }
            _ => None,
        }
    }

    /// The number of functions of the basis, if the quadrature formula has more nodes.
    pub fn functions(&self) -> Option<usize> {
        match self.construction() {
            Construction::Galerkin { basis, nodes, .. } => {
                let fewer = basis.len() < nodes.len() && !self.exchange;
                fewer.then(|| basis.len())
            }
            _ => None,
        }
    }

    /// The steps of a composition that is not a splitting, expanded down to methods that are not compositions.
    pub fn steps(&self) -> Result<Option<Vec<Step>>, ErrorKind> {
        if self.sequence().is_some() {
            return Ok(None);
        }
        let outer = match self.construction() {
            Construction::Based(based) => based.steps(),
            other => other.composed().map(<[Step]>::to_vec),
        };
        let Some(outer) = outer else {
            return Ok(None);
        };
        let mut steps = Vec::new();
        for Step { fraction, method } in outer {
            match method.steps()? {
                Some(inner) => {
                    for step in inner {
                        steps.push(Step {
                            fraction: fraction.multiply(&step.fraction)?,
                            ..step
                        });
                    }
                }
                None => steps.push(Step { fraction, method }),
            }
        }
        if self.exchange {
            steps
                .iter_mut()
                .for_each(|step| step.method.exchange ^= true);
        }
        if self.adjoint {
            steps
                .iter_mut()
                .for_each(|step| step.method.adjoint ^= true);
            steps.reverse();
        }
        Ok(Some(steps))
    }

    /// The kernel and the processor of a processed method.
    pub fn processed(&self) -> Option<[Problem; 2]> {
        let parts = match self.construction() {
            Construction::Processed(processed) => processed.parts_of_run(),
            Construction::Based(based) => based.alone()?.processed()?,
            _ => return None,
        };
        // The adjoint has another processor, P(−h).
        let exchange = |problem: Problem| Problem {
            exchange: problem.exchange ^ self.exchange,
            ..problem
        };
        (!self.adjoint).then(|| parts.map(exchange))
    }

    /// The inverse of the step, as a step of the same size: the step `−h` of the adjoint.
    ///
    /// # Errors
    /// Those of a fraction that is too long.
    pub fn inverse(&self) -> Result<Problem, ErrorKind> {
        let step = Step {
            fraction: Constant::one().negate()?,
            method: self.adjoint(),
        };
        Ok(Problem::composition(vec![step]))
    }

    /// The coefficients, derived at the first call.
    ///
    /// # Errors
    /// All errors except those in the texts.
    pub fn exact(&self) -> Result<Arc<Exact>, ErrorKind> {
        let known = &self.construction.exact;
        let exact = match known.get() {
            Some(exact) => exact,
            None => {
                let exact = Arc::new(self.construction().exact()?);
                known.get_or_init(|| exact)
            }
        };
        if self.adjoint
            && exact.has_gradient_kicks()
            && let Some(sequence) = self.sequence()
        {
            // Such kicks need the form of a splitting, which the adjoint with the same stages does not have.
            return sequence.exact().map(Arc::new);
        }
        Ok(self.of_construction(exact))
    }

    /// The coefficients, if they have been derived.
    pub fn known_exact(&self) -> Option<Arc<Exact>> {
        let exact = self.construction.exact.get()?;
        if self.adjoint && exact.has_gradient_kicks() {
            return None;
        }
        Some(self.of_construction(exact))
    }

    /// The coefficients, from those of the construction.
    fn of_construction(&self, exact: &Arc<Exact>) -> Arc<Exact> {
        match (self.exchange, self.adjoint) {
            (false, false) => Arc::clone(exact),
            (true, false) => Arc::new((**exact).clone().exchanged()),
            (false, true) => Arc::new(exact.adjoint()),
            (true, true) => Arc::new((**exact).clone().exchanged().adjoint()),
        }
    }
}

fn read_derived(
    definition: &Definition,
    limits: &Limits,
    errors: &mut Errors,
) -> Option<Construction> {
    let basis = definition.get(Key::Basis);
    let basis = basis.map(|text| errors.note(Basis::parse(text, limits)));
    let mut nodes = |key: Key| {
        let text = definition.get(key);
        text.map(|text| errors.note(Nodes::parse_ordered(key.name(), text, limits)))
    };
    let (square, rectangular) = (nodes(Key::Nodes), nodes(Key::Quadrature));
    let weights = definition.get(Key::Weights);
    let weights = weights.map(|text| errors.note(read_vector(Key::Weights, text)));
    let missing = |what: &str| {
        misfit(format!(
            "{what}a method needs `basis` with `nodes` or `quadrature`, or `a` and `b`, or `kick` and `drift`, or a `base`, or `compose`, or a file"
        ))
    };
    match (basis, square, rectangular, weights) {
        (Some(basis), Some(nodes), None, None) => Some(Construction::Collocation {
            basis: basis?,
            nodes: nodes?.0,
        }),
        (Some(basis), None, Some(nodes), None) => Some(Construction::Galerkin {
            basis: basis?,
            nodes: nodes?.0,
            weights: None,
        }),
        (Some(basis), None, Some(nodes), Some(weights)) => {
            let (basis, (nodes, order), weights) = (basis?, nodes?, weights?);
            if weights.len() != nodes.len() {
                let message = format!(
                    "{} weights for {} nodes; a quadrature formula has one for each",
                    weights.len(),
                    nodes.len()
                );
                errors.push(misfit_at(definition, Key::Weights, message));
                return None;
            }
            // The nodes are now in ascending order, and the weights are permuted with them.
            let weights = order.iter().map(|&i| weights[i].clone()).collect();
            Some(Construction::Galerkin {
                basis,
                nodes,
                weights: Some(weights),
            })
        }
        (_, Some(_), Some(_), _) => {
            errors.push(misfit(
                "`nodes` are those of the square construction and `quadrature` of the rectangular one: leave out one of them"
                    .to_owned(),
            ));
            None
        }
        (_, _, None, Some(_)) => {
            let message = "`weights` go with `quadrature`; with `nodes` they follow from the basis";
            errors.push(misfit(message.to_owned()));
            None
        }
        (None, None, None, None) => {
            errors.push(missing(""));
            None
        }
        (None, ..) => {
            errors.push(missing("`basis` is missing; "));
            None
        }
        (Some(_), None, None, None) => {
            errors.push(missing("`nodes` are missing; "));
            None
        }
    }
}

fn read_given(
    definition: &Definition,
    limits: &Limits,
    errors: &mut Errors,
) -> Option<Construction> {
    let (Some(a), Some(b)) = (definition.get(Key::A), definition.get(Key::B)) else {
        let message =
            "given coefficients need both `a` and `b`; `a_tilde` and `b_tilde` may be left out";
        errors.push(misfit(message.to_owned()));
        return None;
    };
    let a = errors.note(read_matrix(Key::A, a, limits));
    let b = errors.note(read_vector(Key::B, b));
    let a_tilde = match definition.get(Key::ATilde) {
        None => Some(None),
        Some(SYMPLECTIC_PARTNER) => Some(Some(None)),
        Some(text) => errors
            .note(read_matrix(Key::ATilde, text, limits))
            .map(|matrix| Some(Some(matrix))),
    };
    let b_tilde = match definition.get(Key::BTilde) {
        None => Some(None),
        Some(text) => errors.note(read_vector(Key::BTilde, text)).map(Some),
    };
    let (a, b, a_tilde, b_tilde) = (a?, b?, a_tilde?, b_tilde?);
    let momenta = match (a_tilde, b_tilde) {
        (None, None) => Momenta::Equal,
        (Some(None), None) => Momenta::SymplecticPartner,
        (Some(Some(a_tilde)), b_tilde) => Momenta::Given {
            a_tilde,
            b_tilde: b_tilde.unwrap_or_else(|| b.clone()),
        },
        (None | Some(None), Some(_)) => {
            let message = "`b_tilde` goes with a given `a_tilde`";
            errors.push(misfit(message.to_owned()));
            return None;
        }
    };
    let stages = a.len();
    let mut check = |key: Key, found: usize| {
        if found != stages {
            let message = format!(
                "`{}` has {found} entries or rows where `a` has {stages} rows",
                key.name()
            );
            errors.push(misfit_at(definition, key, message));
        }
    };
    check(Key::B, b.len());
    if let Momenta::Given { a_tilde, b_tilde } = &momenta {
        check(Key::ATilde, a_tilde.len());
        check(Key::BTilde, b_tilde.len());
    }
    Some(Construction::Given { a, b, momenta })
}
