//! The coefficients of a certified method as affine functions of its irrational unknowns.

use std::collections::BTreeMap;

use num_rational::BigRational;
use num_traits::Zero;

use super::certificate::{Certificate, Solution};
use super::conditions::Claim;
use super::structure::Coefficient;
use super::system::{Step, Sum, System};
use crate::arithmetic::interval::Interval;

/// `c + Σ_i f_i x_i`
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Affine {
    /// `c`
    pub constant: BigRational,
    /// The factors of the unknowns, by their indices; none is zero.
    pub factors: BTreeMap<usize, BigRational>,
}

impl Affine {
    /// A function that is a number.
    pub fn rational(value: BigRational) -> Self {
        Affine {
            constant: value,
            factors: BTreeMap::new(),
        }
    }

    /// The number, if the function is one.
    pub fn as_rational(&self) -> Option<&BigRational> {
        self.factors.is_empty().then_some(&self.constant)
    }

    /// The multiple by a number.
    pub fn scaled(&self, factor: &BigRational) -> Self {
        Affine::rational(BigRational::zero()).plus(self, factor)
    }

    /// The sum with a multiple of another function.
    pub fn plus(mut self, other: &Affine, factor: &BigRational) -> Self {
        self.constant += &other.constant * factor;
        for (index, own) in &other.factors {
            *self.factors.entry(*index).or_default() += own * factor;
        }
        self.factors.retain(|_, factor| !factor.is_zero());
        self
    }
}

/// The solved conditions, in the form that certificates for other programs contain.
#[derive(Debug)]
pub struct Solved {
    /// The claim for which the conditions are sufficient; for a composition, an order with any symmetric base.
    pub claim: Claim,
    /// The fractions of a composition, in the order of its steps.
    pub weights: Option<Vec<Affine>>,
    /// The processor of a processed composition.
    pub processor: Option<SolvedProcessor>,
}

/// The processor of a processed composition whose conditions were solved.
#[derive(Debug)]
pub struct SolvedProcessor {
    /// The fractions that are written.
    pub weights: Vec<Affine>,
    /// Whether they are those of `Q` in `P(h) = Q(h) Q(−h)`.
    pub back_and_forth: bool,
    /// All conditions, in arguments.
    pub system: System,
    /// The arguments.
    pub arguments: Vec<Affine>,
}

impl Certificate {
    /// A coefficient as an affine function of the unknowns whose values are not known rationals.
    pub fn affine(&self, coefficient: Coefficient) -> Option<Affine> {
        let target = self.target(coefficient)?;
        let terms = target.terms.iter();
        Some(terms.fold(
            Affine::rational(BigRational::zero()),
            |sum, (index, factor)| sum.plus(&self.argument(*index), factor),
        ))
    }

    /// An unknown, replaced by its value if that is known to be rational. The last weight of a processor is minus the others.
    fn argument(&self, index: usize) -> Affine {
        if let Some(value) = self.solution().known(index) {
            return Affine::rational(value);
        }
        if let Some(sum) = self.sum_of_processor()
            && let Some((others, rest)) = sum.last_of(index, |x| self.solution().known(x).is_some())
        {
            let start = Affine::rational(rest);
            return others.into_iter().fold(start, |sum, (other, factor)| {
                sum.plus(&self.argument(other), &factor)
            });
        }
        Affine {
            constant: BigRational::zero(),
            factors: BTreeMap::from([(index, num_traits::One::one())]),
        }
    }

    /// The condition that the weights of a processor sum to 0.
    fn sum_of_processor(&self) -> Option<Sum> {
        let Solution::Enclosed(enclosed) = self.solution() else {
            return None;
        };
        let written = enclosed.system().beside.as_ref()?;
        written.linear_conditions().into_iter().next()
    }

    /// The conditions that were solved; `None` for a method whose coefficients are all rational.
    pub fn solved(&self) -> Option<Solved> {
        let Solution::Enclosed(enclosed) = self.solution() else {
            return None;
        };
        let composition = self.structure().composition();
        let steps = enclosed.steps().iter();
        let weight = |step: &Step| {
            let argument = self.argument(step.argument);
            match step.negative {
                true => argument.scaled(&BigRational::from_integer((-1).into())),
                false => argument,
            }
        };
        let weights: Option<Vec<Affine>> = composition.then(|| steps.map(weight).collect());
        let system = enclosed.system();
        let processor = system.beside.as_ref().map(|written| {
            let is_kernel = |name: &Coefficient| matches!(name, Coefficient::Weight(_));
            let kernel = self.coefficients().filter(is_kernel).count();
            SolvedProcessor {
                weights: written.steps.iter().map(weight).collect(),
                back_and_forth: system.steps.len() - kernel > 2 * written.steps.len(),
                system: system.clone(),
                arguments: (0..self.unknowns()).map(|x| self.argument(x)).collect(),
            }
        });
        let claim = match composition {
            true => Claim::SymmetricBase(self.claim().order()),
            false => self.claim().clone(),
        };
        Some(Solved {
            claim,
            weights,
            processor,
        })
    }

    /// Enclosures of all unknowns.
    pub fn enclosed_unknowns(&self, bits: u32) -> Vec<Interval> {
        self.solution().unknowns(bits)
    }
}
