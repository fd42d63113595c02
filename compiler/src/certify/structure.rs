//! The unknowns of a method: its symmetry and structure, read off the digits.

use std::fmt;

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::lyndon::{DRIFT, KICK};
use super::printed::Printed;
use super::processed::{Processing, Processor};
use super::splitting::Splitting;
use super::system::{Kind, Step};
use crate::arithmetic::rational::ratio;

/// A coefficient of a method, counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Coefficient {
    /// `kick[i]`.
    Kick(usize),
    /// `drift[i]`.
    Drift(usize),
    /// `gradient[i]`, the weight of a gradient kick.
    Gradient(usize),
    /// The weight of a basic method in a composition.
    Weight(usize),
    /// The weight of a basic method in the processor of a composition.
    Processor(usize),
}

impl fmt::Display for Coefficient {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Coefficient::Kick(index) => write!(f, "kick[{index}]"),
            Coefficient::Drift(index) => write!(f, "drift[{index}]"),
            Coefficient::Gradient(index) => write!(f, "gradient[{index}]"),
            Coefficient::Weight(index) => write!(f, "weight[{index}]"),
            Coefficient::Processor(index) => write!(f, "processor[{index}]"),
        }
    }
}

/// The structure of a method's coefficients.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Structure {
    /// Independent kicks and drifts.
    Splitting,
    /// Palindromic kicks and drifts.
    SymmetricSplitting,
    /// Compositions of a symmetric basic method.
    Composition,
    /// Compositions of a symmetric basic method with palindromic weights.
    SymmetricComposition,
    /// Processed compositions of a symmetric basic method.
    Processed,
}

impl Structure {
    /// Whether the method is symmetric (time-reversible).
    pub fn symmetric(self) -> bool {
        matches!(
            self,
            Structure::SymmetricSplitting | Structure::SymmetricComposition
        )
    }

    /// Whether the method is a composition of a symmetric basic method.
    pub fn composition(self) -> bool {
        matches!(
            self,
            Structure::Composition | Structure::SymmetricComposition | Structure::Processed
        )
    }
}

impl fmt::Display for Structure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Structure::Splitting => "splitting",
            Structure::SymmetricSplitting => "symmetric splitting",
            Structure::Composition => "composition",
            Structure::SymmetricComposition => "symmetric composition",
            Structure::Processed => "processed composition",
        })
    }
}

/// A free coefficient, or several equal ones.
#[derive(Debug, Clone)]
pub struct Unknown {
    /// The first coefficient with this value.
    pub name: Coefficient,
    /// The printed value.
    pub start: BigRational,
    /// The exact value that the digits seem to represent.
    pub simple: Option<BigRational>,
    /// Whether the print is a fraction or an integer.
    pub exact: bool,
}

/// A printed coefficient as a combination of unknowns.
#[derive(Debug, Clone)]
pub struct Target {
    /// The coefficient.
    pub name: Coefficient,
    /// The printed value.
    pub printed: BigRational,
    /// Half a unit of the last printed place; zero for a number that is printed exactly.
    pub half: BigRational,
    /// Unknowns with their factors.
    pub terms: Vec<(usize, BigRational)>,
}

/// One way to read the digits.
#[derive(Debug, Clone)]
pub struct Reading {
    pub structure: Structure,
    pub unknowns: Vec<Unknown>,
    pub steps: Vec<Step>,
    pub targets: Vec<Target>,
    /// Of a processed composition.
    pub processing: Option<Processing>,
}

/// One printed factor of the product.
#[derive(Clone, Copy)]
struct Factor<'a> {
    kind: Kind,
    /// The number of its flow: a gradient kick has two factors, which commute.
    flow: usize,
    name: Coefficient,
    printed: &'a Printed,
}

impl Factor<'_> {
    fn value(&self) -> &BigRational {
        self.printed.value()
    }

    fn unknown(&self) -> Unknown {
        Unknown {
            name: self.name,
            start: self.value().clone(),
            simple: self.printed.simple(),
            exact: self.printed.places().is_none(),
        }
    }

    fn target(&self, terms: Vec<(usize, BigRational)>) -> Target {
        Target {
            name: self.name,
            printed: self.value().clone(),
            half: self.printed.half_unit(),
            terms,
        }
    }
}

/// All ways to read a splitting, with the most structure first.
pub fn readings(splitting: &Splitting) -> Vec<Reading> {
    let mut factors: Vec<Factor<'_>> = Vec::new();
    let mut zeros = Vec::new();
    for (index, (kick, drift)) in splitting.kick.iter().zip(&splitting.drift).enumerate() {
        let kick = (Kind::Letter(KICK), Coefficient::Kick(index), kick);
        let gradient = splitting.gradient.get(index);
        let gradient =
            gradient.map(|printed| (Kind::Gradient, Coefficient::Gradient(index), printed));
        let drift = (Kind::Letter(DRIFT), Coefficient::Drift(index), drift);
        for (kind, name, printed) in [kick].into_iter().chain(gradient).chain([drift]) {
            let zero = printed.value().is_zero();
            let list = if zero { &mut zeros } else { &mut factors };
            let flow = list.last().map_or(0, |last: &Factor<'_>| {
                let same = kind == Kind::Gradient && last.name == Coefficient::Kick(index);
                last.flow + usize::from(!same)
            });
            list.push(Factor {
                kind,
                flow,
                name,
                printed,
            });
        }
    }
    let mut found = composition_of_verlet(&factors);
    let structures = [Structure::SymmetricSplitting, Structure::Splitting];
    found.extend(plain(&factors, structures));
    for reading in &mut found {
        let zeros = zeros.iter().map(|factor| factor.target(Vec::new()));
        reading.targets.extend(zeros);
    }
    found
}

/// The ways to read the weights of a composition of a symmetric basic method.
pub fn composition_readings(weights: &[Printed]) -> Vec<Reading> {
    let factors: Vec<Factor<'_>> = weights
        .iter()
        .enumerate()
        .map(|(index, printed)| Factor {
            kind: Kind::Base,
            flow: index,
            name: Coefficient::Weight(index),
            printed,
        })
        .collect();
    plain(&factors, COMPOSITIONS)
}

/// The ways to read a processed composition `P K P⁻¹`, where K has these weights.
pub fn processed_readings(weights: &[Printed], processor: &Processor<Printed>) -> Vec<Reading> {
    let mut readings = composition_readings(weights);
    for reading in &mut readings {
        let first = reading.unknowns.len();
        for (index, printed) in processor.weights().iter().enumerate() {
            let factor = Factor {
                kind: Kind::Base,
                flow: index,
                name: Coefficient::Processor(index),
                printed,
            };
            reading.unknowns.push(factor.unknown());
            let terms = vec![(first + index, BigRational::one())];
            reading.targets.push(factor.target(terms));
        }
        let count = processor.weights().len();
        let written = (first..first + count).map(|x| Step::new(Kind::Base, x));
        let written: Vec<Step> = written.collect();
        let processor = processor.with(written.clone()).steps(Step::inverse);
        let inverse = processor.iter().rev().map(|step| step.inverse());
        let kernel = std::mem::take(&mut reading.steps);
        reading.steps = inverse.chain(kernel).chain(processor.clone()).collect();
        reading.processing = Some(Processing {
            symmetric: reading.structure.symmetric(),
            back_and_forth: count < processor.len(),
            written,
        });
        reading.structure = Structure::Processed;
    }
    readings
}

const COMPOSITIONS: [Structure; 2] = [Structure::SymmetricComposition, Structure::Composition];

/// Whether two numbers may be intended to be equal: they agree to three places.
///
/// This is coarse, so that a wrong digit does not hide the structure. The result is compared
/// with all digits.
fn close(x: &BigRational, y: &BigRational) -> bool {
    (x - y).abs() <= ratio(1, 1000)
}

/// The factor of the same kind in the mirrored flow, with its index.
fn partner<'f, 'a>(factors: &'f [Factor<'a>], index: usize) -> Option<(usize, &'f Factor<'a>)> {
    let mirrored = factors.last()?.flow - factors[index].flow;
    let mut all = factors.iter().enumerate();
    all.find(|(_, other)| other.flow == mirrored && other.kind == factors[index].kind)
}

/// The readings in which each factor is a step: symmetric or not, with equal digits as one unknown or as several. Those
/// with more structure come first.
fn plain(factors: &[Factor<'_>], [symmetric, asymmetric]: [Structure; 2]) -> Vec<Reading> {
    let pairs = || {
        factors
            .iter()
            .enumerate()
            .map(|(i, x)| (x, partner(factors, i)))
    };
    let palindrome = pairs().all(|(x, y)| y.is_some_and(|(_, y)| close(x.value(), y.value())));
    let exact = palindrome && pairs().all(|(x, y)| y.is_some_and(|(_, y)| x.value() == y.value()));
    let mut readings: Vec<Reading> = Vec::new();
    for (structure, possible) in [(symmetric, palindrome), (asymmetric, !exact)] {
        for equal in [true, false] {
            let reading = read(factors, structure, equal);
            let known = readings.iter().any(|other| {
                other.structure == structure && other.unknowns.len() == reading.unknowns.len()
            });
            if possible && !known {
                readings.push(reading);
            }
        }
    }
    readings
}

/// The reading with a structure; with `equal`, equal digits are one unknown.
fn read(factors: &[Factor<'_>], structure: Structure, equal: bool) -> Reading {
    let mut unknowns: Vec<(Kind, Unknown)> = Vec::new();
    let mut arguments: Vec<usize> = Vec::new();
    for (index, factor) in factors.iter().enumerate() {
        let same = |(kind, unknown): &(Kind, Unknown)| {
            *kind == factor.kind && &unknown.start == factor.value()
        };
        let partner = partner(factors, index).filter(|_| structure.symmetric());
        let known = if let Some((partner, _)) = partner
            && partner < index
        {
            Some(arguments[partner])
        } else if equal {
            unknowns.iter().position(same)
        } else {
            None
        };
        arguments.push(known.unwrap_or_else(|| {
            unknowns.push((factor.kind, factor.unknown()));
            unknowns.len() - 1
        }));
    }
    let pairs = || factors.iter().zip(&arguments);
    let step = |(factor, &argument): (&Factor<'_>, &usize)| Step::new(factor.kind, argument);
    let target = |(factor, &argument): (&Factor<'_>, &usize)| {
        factor.target(vec![(argument, BigRational::one())])
    };
    Reading {
        structure,
        steps: pairs().map(step).collect(),
        targets: pairs().map(target).collect(),
        unknowns: unknowns.into_iter().map(|(_, unknown)| unknown).collect(),
        processing: None,
    }
}

/// The readings as a composition of steps of Störmer–Verlet, `exp(w/2 B) exp(w A) exp(w/2 B)` or with the
/// letters exchanged: the outer coefficients are the half sums of neighbouring inner ones.
fn composition_of_verlet(factors: &[Factor<'_>]) -> Vec<Reading> {
    let alternating = factors.windows(2).all(|pair| pair[0].kind != pair[1].kind)
        && factors.iter().all(|factor| factor.kind != Kind::Gradient);
    if factors.len() < 3 || factors.len().is_multiple_of(2) || !alternating {
        return Vec::new();
    }
    let inner = factors.iter().skip(1).step_by(2).enumerate();
    let inner = inner.map(|(flow, factor)| Factor { flow, ..*factor });
    let inner: Vec<Factor<'_>> = inner.collect();
    // The inner neighbours of the outer coefficient with this index.
    let neighbours = |index: usize| index.saturating_sub(1)..(index + 1).min(inner.len());
    let half = ratio(1, 2);
    let outer: Vec<&Factor<'_>> = factors.iter().step_by(2).collect();
    let half_sums = outer.iter().enumerate().all(|(index, factor)| {
        let around = inner[neighbours(index)].iter();
        let sum: BigRational = around.map(Factor::value).sum();
        close(factor.value(), &(sum * &half))
    });
    if !half_sums {
        return Vec::new();
    }
    let mut readings = plain(&inner, COMPOSITIONS);
    for reading in &mut readings {
        let argument = |index: usize| reading.steps[index].argument;
        // In the order of the unknowns, so that mirrored coefficients are recognised as equal.
        let half_sum = |(index, factor): (usize, &&Factor<'_>)| {
            let inner = neighbours(index).map(|inner| (argument(inner), half.clone()));
            let mut terms: Vec<_> = inner.collect();
            terms.sort();
            factor.target(terms)
        };
        let targets: Vec<Target> = outer.iter().enumerate().map(half_sum).collect();
        reading.targets.extend(targets);
        for step in &mut reading.steps {
            step.kind = Kind::Base;
        }
    }
    readings
}
