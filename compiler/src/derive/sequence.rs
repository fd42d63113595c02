//! Sequences of kicks and drifts as partitioned Runge–Kutta methods, perhaps with gradient kicks.

use std::collections::HashMap;

use num_rational::BigRational;

use super::reading::outside;
use super::splitting::Flow;
use crate::algebra::{Constants, Dense, Field, Real, Reals, Zero};
use crate::error::ErrorKind;
use crate::exact::Exact;
use crate::partitioned::{LowerTriangular, Partitioned};
use crate::symbolic::Constant;

/// A fraction of one of the two flows.
#[derive(Debug, Clone)]
pub struct Substep {
    flow: Flow,
    /// The factors of the fraction of the step.
    factors: Vec<Factor>,
    /// The factors of the weight of a gradient kick.
    gradient: Option<Vec<Factor>>,
}

/// A factor of a fraction of the step.
#[derive(Debug, Clone, PartialEq)]
pub enum Factor {
    /// A factor with a closed form.
    Constant(Constant),
    /// An enclosed factor.
    Real(Real),
}

impl Factor {
    /// The constant, if the factor has a closed form.
    pub fn constant(&self) -> Option<&Constant> {
        match self {
            Factor::Constant(constant) => Some(constant),
            Factor::Real(_) => None,
        }
    }

    /// Minus the factor.
    ///
    /// # Errors
    /// Those of [`Constant`].
    pub fn negated(&self) -> Result<Factor, ErrorKind> {
        Ok(match self {
            Factor::Constant(constant) => Factor::Constant(constant.negate()?),
            Factor::Real(real) => {
                let minus = Reals.rational(&BigRational::from_integer((-1).into()));
                Factor::Real(Reals.multiply(&minus, real))
            }
        })
    }

    fn is_zero(&self) -> bool {
        self.constant().is_some_and(Constant::is_trivially_zero)
    }

    fn element<F: Field>(&self, field: &F) -> Option<F::Element> {
        match self {
            Factor::Constant(constant) => field.constant(constant),
            Factor::Real(real) => field.real(real),
        }
    }
}

impl Substep {
    /// This fraction of the step, with the weight of a gradient kick.
    pub fn new(flow: Flow, fraction: Factor, gradient: Option<Factor>) -> Self {
        let gradient = gradient.filter(|weight| !weight.is_zero());
        Substep {
            flow,
            factors: vec![fraction],
            gradient: gradient.map(|weight| vec![weight]),
        }
    }

    /// The same in a step with this fraction of the whole one: the weight of a gradient kick belongs to `h³`.
    fn scale(&mut self, fraction: &Factor) {
        self.factors.push(fraction.clone());
        if let Some(gradient) = &mut self.gradient {
            gradient.extend(std::iter::repeat_n(fraction.clone(), 3));
        }
    }

    /// All factors.
    fn all_factors(&self) -> impl Iterator<Item = &Factor> {
        self.factors.iter().chain(self.gradient.iter().flatten())
    }
}

/// The sequence of kicks and drifts of a method: a splitting, its adjoint, or a composition of such
/// methods.
#[derive(Debug, Clone)]
pub struct Sequence {
    /// The flow that comes first in each pair of the tableau, unless the other choice makes the tableau shorter.
    first: Flow,
    substeps: Vec<Substep>,
}

impl Sequence {
    /// A sequence of these flows; flows of zero duration are left out.
    pub fn new(first: Flow, mut substeps: Vec<Substep>) -> Self {
        substeps.retain(|substep| {
            substep.gradient.is_some() || !substep.factors.iter().any(Factor::is_zero)
        });
        Sequence { first, substeps }
    }

    /// The concatenated sequences of methods, each with its fraction of the step; `None` if one of the
    /// methods is not such a sequence.
    pub fn joined(parts: impl IntoIterator<Item = (Factor, Option<Sequence>)>) -> Option<Self> {
        let mut all: Option<Sequence> = None;
        for (fraction, part) in parts {
            let mut part = part?;
            for substep in &mut part.substeps {
                substep.scale(&fraction);
            }
            match &mut all {
                Some(all) => all.substeps.append(&mut part.substeps),
                None => all = Some(part),
            }
        }
        all
    }

    /// Whether there are gradient kicks.
    pub fn has_gradient_kicks(&self) -> bool {
        self.substeps
            .iter()
            .any(|substep| substep.gradient.is_some())
    }

    /// The sequence of the adjoint method: each flow is its own adjoint, so only the order is reversed.
    #[must_use]
    pub fn reversed(mut self) -> Self {
        self.substeps.reverse();
        self
    }

    /// The sequence with positions and momenta exchanged, for one without gradient kicks.
    #[must_use]
    pub fn exchanged(mut self) -> Self {
        self.first = self.first.other();
        for substep in &mut self.substeps {
            substep.flow = substep.flow.other();
        }
        self
    }

    /// The number of stages if no fraction vanishes, and otherwise an upper bound.
    pub fn stages(&self) -> usize {
        let flows = self.runs();
        let first = flows.first().copied();
        let [this, other] = [self.first, self.first.other()]
            .map(|layout| (flows.len() + usize::from(first != Some(layout))).div_ceil(2));
        this.min(other)
    }

    /// The coefficients.
    ///
    /// # Errors
    /// None, except for a constant outside the field constructed for it.
    pub fn exact(&self) -> Result<Exact, ErrorKind> {
        let factors = self.substeps.iter().flat_map(Substep::all_factors);
        let constants: Option<Vec<&Constant>> = factors.map(Factor::constant).collect();
        let exact = match constants.and_then(Constants::containing) {
            Some(field) => self.pair(&field).map(Exact::Field),
            None => self.pair(&Reals).map(Exact::Reals),
        };
        exact.ok_or_else(outside)
    }

    /// The tableau: with the kicks `k_i` and the drifts `d_i` in pairs, each kick before its drift,
    ///
    /// ```text
    /// a_ij = d_j for j < i     ã_ij = k_j for j ≤ i     b = d     b̃ = k
    /// ```
    ///
    /// and the same with the roles exchanged if each drift comes before its kick.
    fn pair<F: Field + Clone>(&self, field: &F) -> Option<Partitioned<Dense<F>>> {
        let flows = self.merged(field)?;
        let zero = field.rational(&BigRational::default());
        let start = flows.first().map_or(self.first, |merged| merged.flow);
        let length = |layout: Flow| (flows.len() + usize::from(layout != start)).div_ceil(2);
        let layout = match length(self.first.other()) < length(self.first) {
            true => self.first.other(),
            false => self.first,
        };
        let mut values: Vec<F::Element> =
            flows.iter().map(|merged| merged.fraction.clone()).collect();
        let mut weights: Vec<Option<F::Element>> =
            flows.into_iter().map(|merged| merged.gradient).collect();
        if start != layout {
            values.insert(0, zero.clone());
            weights.insert(0, None);
        }
        // The identity step also has a stage.
        if values.len() % 2 == 1 || values.is_empty() {
            values.resize(values.len().max(1).next_multiple_of(2), zero.clone());
        }
        weights.resize(values.len(), None);
        let gradient = weights.iter().any(Option::is_some).then(|| {
            let kicks = weights.into_iter().skip(usize::from(layout == Flow::Drift));
            let weight = |weight: Option<F::Element>| weight.unwrap_or_else(|| zero.clone());
            kicks.step_by(2).map(weight).collect()
        });
        let half = |offset: usize| -> Vec<F::Element> {
            values.iter().skip(offset).step_by(2).cloned().collect()
        };
        let (first, second) = (half(0), half(1));
        let field = field.clone();
        let pair = match layout {
            Flow::Kick => {
                Partitioned::of_splitting(field, LowerTriangular::KicksFirst, second, first)
            }
            Flow::Drift => {
                Partitioned::of_splitting(field, LowerTriangular::DriftsFirst, first, second)
            }
        };
        Some(Partitioned { gradient, ..pair })
    }

    /// Alternating flows: neighbours of the same kind are merged, and exact zeros are removed. Equal fractions are
    /// the same element, so that a palindromic sequence is recognised.
    fn merged<F: Field>(&self, field: &F) -> Option<Vec<Merged<F::Element>>> {
        struct Products {
            flow: Flow,
            fraction: Vec<usize>,
            gradient: Vec<usize>,
        }
        let mut elements = Elements::new(field);
        let mut merged: Vec<Products> = Vec::new();
        for substep in &self.substeps {
            let fraction = elements.product(&substep.factors)?;
            let gradient = match &substep.gradient {
                Some(factors) => Some(elements.product(factors)?),
                None => None,
            };
            match merged.last_mut() {
                Some(last) if last.flow == substep.flow => {
                    last.fraction.push(fraction);
                    last.gradient.extend(gradient);
                }
                _ => merged.push(Products {
                    flow: substep.flow,
                    fraction: vec![fraction],
                    gradient: gradient.into_iter().collect(),
                }),
            }
            if let Some(last) = merged.last_mut()
                && field.zero(elements.sum(&mut last.fraction)) == Zero::Yes
                && field.zero(elements.sum(&mut last.gradient)) == Zero::Yes
            {
                merged.pop();
            }
        }
        let value = |mut products: Products| {
            let gradient = elements.sum(&mut products.gradient).clone();
            Merged {
                flow: products.flow,
                fraction: elements.sum(&mut products.fraction).clone(),
                gradient: (field.zero(&gradient) != Zero::Yes).then_some(gradient),
            }
        };
        Some(merged.into_iter().map(value).collect())
    }

    /// The flows, with repeated flows of the same kind merged.
    fn runs(&self) -> Vec<Flow> {
        let mut flows: Vec<Flow> = self.substeps.iter().map(|substep| substep.flow).collect();
        flows.dedup();
        flows
    }
}

/// Flows of one kind after one another.
struct Merged<E> {
    flow: Flow,
    fraction: E,
    /// The weight of a gradient kick.
    gradient: Option<E>,
}

/// Elements of a field for fractions of the step, shared by all fractions that are written alike.
struct Elements<'a, F: Field> {
    field: &'a F,
    products: Vec<(&'a [Factor], F::Element)>,
    /// The sums of products with these ascending indices.
    sums: HashMap<Vec<usize>, F::Element>,
}

impl<'a, F: Field> Elements<'a, F> {
    fn new(field: &'a F) -> Self {
        Elements {
            field,
            products: Vec::new(),
            sums: HashMap::new(),
        }
    }

    /// The index of a product; `None` if the field does not hold a factor.
    fn product(&mut self, factors: &'a [Factor]) -> Option<usize> {
        let known = self.products.iter();
        if let Some(index) = known.clone().position(|(other, _)| *other == factors) {
            return Some(index);
        }
        let one = self.field.rational(&BigRational::from_integer(1.into()));
        let value = factors.iter().try_fold(one, |product, factor| {
            Some(self.field.multiply(&product, &factor.element(self.field)?))
        })?;
        self.products.push((factors, value));
        Some(self.products.len() - 1)
    }

    /// The sum of products; sorts their indices.
    fn sum(&mut self, products: &mut [usize]) -> &F::Element {
        products.sort_unstable();
        let (field, values) = (self.field, &self.products);
        self.sums.entry(products.to_vec()).or_insert_with(|| {
            let values = products.iter().map(|&index| values[index].1.clone());
            values
                .reduce(|sum, value| field.add(&sum, &value))
                .unwrap_or_else(|| field.rational(&BigRational::default()))
        })
    }
}
