//! The structures of methods: which coefficients are unknowns, and which steps they make.

use nalgebra::{DMatrix, DVector};
use symplectic_compiler::Key;
use symplectic_compiler::certify::{DRIFT, KICK};

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
    /// The fractions of a processor as steps of the basic method.
    pub(crate) processor: Option<Product>,
    /// A typical size of each unknown.
    pub(crate) typical: DVector<f64>,
}

impl Model {
    pub(crate) fn new(structure: Structure, kicks: usize) -> Self {
        let (first, count) = match structure {
            Structure::Aba => (DRIFT, 2 * kicks + 1),
            Structure::Bab => (KICK, 2 * kicks + 1),
            Structure::Plain => (KICK, 2 * kicks),
            Structure::Composition => return Model::composition(structure, kicks, 0),
            Structure::Processed { processor } => {
                return Model::composition(structure, kicks, processor);
            }
        };
        // The number of the unknown of each factor.
        let unknown = |index: usize| match structure.is_symmetric() {
            true => index.min(count - 1 - index),
            false => index,
        };
        let sequence: Vec<usize> = (0..count).map(unknown).collect();
        // Kicks and drifts sum to 1; the ends of a palindrome are halves of steps.
        let share = |index: usize| match structure.is_symmetric() && index == 0 {
            true => 0.5 / kicks as f64,
            false => 1.0 / kicks as f64,
        };
        let product = Product {
            exponents: alternating(first, count),
            arguments: selection(&sequence),
        };
        Model {
            structure,
            sequence,
            processor: None,
            typical: DVector::from_fn(product.arguments.ncols(), |index, _| share(index)),
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

    /// The parts of the definition that list the unknowns, each with the numbers of its unknowns, and the parts that go with them.
    pub(crate) fn lists(&self) -> (Vec<(Key, Vec<usize>)>, Vec<(Key, &'static str)>) {
        let weights = self.sequence.iter().max().map_or(0, |last| last + 1);
        let every_second = |start: usize| (start..self.unknowns()).step_by(2).collect();
        match self.structure {
            Structure::Aba => (
                vec![(Key::Kick, every_second(1)), (Key::Drift, every_second(0))],
                vec![(Key::First, "drift"), (Key::Symmetric, "true")],
            ),
            Structure::Bab => (
                vec![(Key::Kick, every_second(0)), (Key::Drift, every_second(1))],
                vec![(Key::Symmetric, "true")],
            ),
            Structure::Plain => (
                vec![(Key::Kick, every_second(0)), (Key::Drift, every_second(1))],
                vec![],
            ),
            Structure::Composition => (
                vec![(Key::Weights, (0..weights).collect())],
                vec![(Key::Base, "velocity-verlet"), (Key::Symmetric, "true")],
            ),
            Structure::Processed { .. } => (
                vec![
                    (Key::Weights, (0..weights).collect()),
                    (Key::Processor, (weights..self.unknowns()).collect()),
                ],
                vec![(Key::Base, "velocity-verlet"), (Key::Symmetric, "true")],
            ),
        }
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
