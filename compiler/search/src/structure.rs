//! The structures of methods: which coefficients are unknowns, and which steps they make.

use nalgebra::{DMatrix, DVector};
use symplectic_compiler::Key;
use symplectic_compiler::certify::{Coefficient, DRIFT, KICK};

use crate::words::Exponent;

/// The structure of the methods that are searched.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Structure {
    /// A palindrome that begins and ends with a drift: `s` kicks.
    Aba,
    /// A palindrome that begins and ends with a kick: `s + 1` kicks, of which the last one and the first of the next step are one.
    Bab,
    /// Kick, drift, kick, drift, …: `s` of each, not symmetric.
    Plain,
    /// A palindrome of `s` steps of Störmer–Verlet, or of any other symmetric method of order 2.
    Composition,
    /// The same as the kernel of a processed method. The processor has steps −a, −b, …, a, b, … with as many fractions.
    Processed {
        /// The number of fractions of the processor.
        processor: usize,
    },
}

impl Structure {
    /// Whether the methods are symmetric, `Φ(−h) = Φ(h)⁻¹`: their orders are even.
    pub fn is_symmetric(self) -> bool {
        self != Structure::Plain
    }

    /// What it is called on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Structure::Aba => "aba",
            Structure::Bab => "bab",
            Structure::Plain => "plain",
            Structure::Composition => "composition",
            Structure::Processed { .. } => "processed",
        }
    }
}

/// A product of exponentials whose arguments are linear in the unknowns.
#[derive(Debug, Clone)]
pub(crate) struct Product {
    pub(crate) exponents: Vec<Exponent>,
    /// One row a factor, one column an unknown.
    pub(crate) arguments: DMatrix<f64>,
}

impl Product {
    /// The arguments of the factors.
    pub(crate) fn at(&self, unknowns: &DVector<f64>) -> Vec<f64> {
        (&self.arguments * unknowns).iter().copied().collect()
    }
}

/// A list of a definition with the numbers of its unknowns; `None` is zero.
pub(crate) type List = (Key, Vec<Option<usize>>);

/// The unknowns of a structure and the methods that they make.
#[derive(Debug, Clone)]
pub(crate) struct Model {
    pub(crate) structure: Structure,
    /// The product of the kicks and drifts.
    pub(crate) letters: Product,
    /// The product for the order conditions: of the basic method in a composition.
    pub(crate) steps: Product,
    /// The unknown that is the argument of each step, in a processed method of each step of the kernel.
    pub(crate) sequence: Vec<usize>,
    /// The coefficient that each unknown is.
    pub(crate) names: Vec<Coefficient>,
    /// The fractions of a processor as steps of the basic method.
    pub(crate) processor: Option<Product>,
    /// A typical size of each unknown.
    pub(crate) typical: DVector<f64>,
}

impl Model {
    /// The model of a structure; the `gradient` innermost kicks are gradient kicks.
    pub(crate) fn new(structure: Structure, kicks: usize, gradient: usize) -> Self {
        let (first, count) = match structure {
            Structure::Aba => (DRIFT, 2 * kicks + 1),
            Structure::Bab => (KICK, 2 * kicks + 1),
            Structure::Plain => (KICK, 2 * kicks),
            Structure::Composition => return Model::composition(structure, kicks, 0),
            Structure::Processed { processor } => {
                return Model::composition(structure, kicks, processor);
            }
        };
        let is_symmetric = structure.is_symmetric();
        let unknown = |index: usize| match is_symmetric {
            true => index.min(count - 1 - index),
            false => index,
        };
        let exponents = alternating(first, count);
        let kick_of = |index: usize| (index - usize::from(first == DRIFT)) / 2;
        // With a drift first, the first kick of the lists is zero.
        let name = |index: usize| match exponents[index] {
            Exponent::Letter(KICK) => {
                Coefficient::Kick(kick_of(index) + usize::from(first == DRIFT))
            }
            _ => Coefficient::Drift(index / 2),
        };
        let mut names: Vec<Coefficient> = (0..count)
            .filter(|index| unknown(*index) == *index)
            .map(name)
            .collect();
        // Kicks and drifts sum to 1; the ends of a palindrome are halves of steps.
        let share = |index: usize| match is_symmetric && index == 0 {
            true => 0.5 / kicks as f64,
            false => 1.0 / kicks as f64,
        };
        let mut typical: Vec<f64> = (0..names.len()).map(share).collect();
        let all: Vec<usize> = (0..count)
            .filter(|index| exponents[*index] == Exponent::Letter(KICK))
            .collect();
        let outside = all.len().saturating_sub(gradient) / 2;
        let mut steps: Vec<(Exponent, usize)> = Vec::new();
        for (index, exponent) in exponents.iter().enumerate() {
            steps.push((*exponent, unknown(index)));
            let has_gradient = all
                .iter()
                .skip(outside)
                .take(gradient)
                .any(|kick| *kick == index);
            if has_gradient {
                let name =
                    Coefficient::Gradient(kick_of(unknown(index)) + usize::from(first == DRIFT));
                let known = names.iter().position(|other| *other == name);
                let number = known.unwrap_or_else(|| {
                    names.push(name);
                    typical.push(0.0);
                    names.len() - 1
                });
                steps.push((Exponent::Gradient, number));
            }
        }
        let (exponents, sequence): (Vec<Exponent>, Vec<usize>) = steps.into_iter().unzip();
        let product = Product {
            exponents,
            arguments: selection(&sequence),
        };
        Model {
            structure,
            sequence,
            names,
            processor: None,
            typical: DVector::from_vec(typical),
            steps: product.clone(),
            letters: product,
        }
    }

    /// Steps whose fractions are all unknowns.
    pub(crate) fn of_all(exponents: Vec<Exponent>) -> Self {
        let sequence: Vec<usize> = (0..exponents.len()).collect();
        let product = Product {
            arguments: selection(&sequence),
            exponents,
        };
        Model {
            structure: Structure::Plain,
            typical: DVector::zeros(sequence.len()),
            sequence,
            names: Vec::new(),
            processor: None,
            steps: product.clone(),
            letters: product,
        }
    }

    /// A palindrome of steps of `velocity-verlet`, perhaps between a processor and its inverse.
    fn composition(structure: Structure, kernel: usize, processor: usize) -> Self {
        let sequence: Vec<usize> = (0..kernel)
            .map(|index| index.min(kernel - 1 - index))
            .collect();
        let weights = kernel.div_ceil(2);
        // An unknown with a sign for each step: −a, −b, …, a, b, … of the processor, and of its inverse the steps back in reverse.
        let written = || (0..processor).map(|index| weights + index);
        let after: Vec<(usize, f64)> = written()
            .map(|u| (u, -1.0))
            .chain(written().map(|u| (u, 1.0)))
            .collect();
        let before = after.iter().rev().map(|(unknown, sign)| (*unknown, -sign));
        let whole: Vec<(usize, f64)> = before
            .chain(sequence.iter().map(|u| (*u, 1.0)))
            .chain(after.iter().copied())
            .collect();
        let unknowns = weights + processor;
        let mut arguments = DMatrix::zeros(2 * whole.len() + 1, unknowns);
        for (index, (unknown, sign)) in whole.iter().enumerate() {
            // Half a kick, a drift, half a kick.
            for (factor, share) in [(2 * index, 0.5), (2 * index + 1, 1.0), (2 * index + 2, 0.5)] {
                arguments[(factor, *unknown)] += sign * share;
            }
        }
        let of_base = |steps: &[(usize, f64)]| Product {
            exponents: vec![Exponent::Base; steps.len()],
            arguments: DMatrix::from_fn(steps.len(), unknowns, |row, column| match steps[row] {
                (unknown, sign) if unknown == column => sign,
                _ => 0.0,
            }),
        };
        let share = 1.0 / kernel as f64;
        Model {
            structure,
            sequence,
            names: (0..weights)
                .map(Coefficient::Weight)
                .chain((0..processor).map(Coefficient::Processor))
                .collect(),
            processor: (processor > 0).then(|| of_base(&after[processor..])),
            typical: DVector::from_fn(
                unknowns,
                |index, _| if index < weights { share } else { 0.0 },
            ),
            letters: Product {
                exponents: alternating(KICK, 2 * whole.len() + 1),
                arguments,
            },
            steps: of_base(&whole),
        }
    }

    /// The number of unknowns.
    pub(crate) fn unknowns(&self) -> usize {
        self.typical.len()
    }

    /// The lists of a definition with the numbers of their unknowns, and the parts that go with them. Kicks without a gradient have none in the
    /// list of gradients.
    pub(crate) fn lists(&self) -> (Vec<List>, Vec<(Key, &'static str)>) {
        let of = |is: fn(&Coefficient) -> bool| -> Vec<Option<usize>> {
            (0..self.unknowns())
                .filter(|index| is(&self.names[*index]))
                .map(Some)
                .collect()
        };
        let lists = match self.structure {
            Structure::Composition | Structure::Processed { .. } => vec![
                (
                    Key::Weights,
                    of(|name| matches!(name, Coefficient::Weight(_))),
                ),
                (
                    Key::Processor,
                    of(|name| matches!(name, Coefficient::Processor(_))),
                ),
            ],
            _ => {
                let kicks = of(|name| matches!(name, Coefficient::Kick(_)));
                let gradient = |kick: &Option<usize>| match kick.map(|kick| self.names[kick]) {
                    Some(Coefficient::Kick(index)) => self
                        .names
                        .iter()
                        .position(|name| *name == Coefficient::Gradient(index)),
                    _ => None,
                };
                let mut gradients: Vec<Option<usize>> = kicks.iter().map(gradient).collect();
                if gradients.iter().all(Option::is_none) {
                    gradients.clear();
                }
                vec![
                    (Key::Kick, kicks),
                    (Key::Drift, of(|name| matches!(name, Coefficient::Drift(_)))),
                    (Key::Gradient, gradients),
                ]
            }
        };
        let others = match self.structure {
            Structure::Aba => vec![(Key::First, "drift"), (Key::Symmetric, "true")],
            Structure::Bab => vec![(Key::Symmetric, "true")],
            Structure::Plain => vec![],
            Structure::Composition | Structure::Processed { .. } => {
                vec![(Key::Base, "velocity-verlet"), (Key::Symmetric, "true")]
            }
        };
        (
            lists
                .into_iter()
                .filter(|(_, list)| !list.is_empty())
                .collect(),
            others,
        )
    }
}

fn alternating(first: u8, count: usize) -> Vec<Exponent> {
    let other = if first == DRIFT { KICK } else { DRIFT };
    let letter = |index: usize| {
        if index.is_multiple_of(2) {
            first
        } else {
            other
        }
    };
    (0..count)
        .map(|index| Exponent::Letter(letter(index)))
        .collect()
}

/// The matrix with a one in each row, in the column of its unknown.
fn selection(sequence: &[usize]) -> DMatrix<f64> {
    let columns = sequence.iter().max().map_or(0, |last| last + 1);
    DMatrix::from_fn(sequence.len(), columns, |row, column| {
        f64::from(u8::from(sequence[row] == column))
    })
}
