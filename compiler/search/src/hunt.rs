//! The search: random starts, solutions of the order conditions, minima of the figure.

use std::ops::ControlFlow;

use nalgebra::DVector;
use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use symplectic_compiler::certify::{CertifyError, Claim, Conditions};
use symplectic_compiler::order::HamiltonianClass;

use crate::figure::{Figure, Norm, dispersion};
use crate::manifold::{Manifold, Point};
use crate::polynomials::Polynomials;
use crate::stability::stable_per_kick;
use crate::structure::{Model, Structure};

/// What a search looks for.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// The order conditions that the methods satisfy.
    pub claim: Claim,
    /// The structure.
    pub structure: Structure,
    /// Kicks a step.
    pub kicks: usize,
    /// How many of them are gradient kicks, the innermost ones. Each counts as two force evaluations.
    pub gradient: usize,
    /// The norm of the error that is minimised.
    pub norm: Norm,
    /// The largest absolute value of a coefficient. It is a soft bound: a method may exceed it a little.
    pub largest: f64,
    /// Whether the frequency of the harmonic oscillator has an error of higher order than the method: by two, of symmetric methods.
    pub dispersion: bool,
    /// The least end of the first interval of stable `hω`, divided by the kicks.
    pub at_least_stable: f64,
}

/// A solution of the order conditions in doubles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Solution {
    /// The unknowns of the structure: kicks and drifts in their order, or weights, of a palindrome the first half.
    pub unknowns: Vec<f64>,
    /// The norm of the leading error, `C`.
    pub error: f64,
    /// The end of the first interval of stable `hω`, divided by the kicks.
    pub stable: f64,
    /// How many starts led here.
    pub found: usize,
    /// Whether it is a minimum, and not only a point on the way to one.
    pub is_minimum: bool,
    /// Whether a coefficient is at the bound.
    pub is_at_bound: bool,
}

impl Solution {
    /// The largest absolute value of an unknown.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.unknowns
            .iter()
            .fold(0.0, |largest: f64, x| largest.max(x.abs()))
    }
}

/// The state of a search.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Progress {
    /// The seed of the random numbers.
    pub seed: u32,
    /// The number of starts so far.
    pub starts: u64,
    /// How many of them led to solutions of the conditions.
    pub solved: u64,
    /// The number of conditions.
    pub conditions: usize,
    /// The number of unknowns.
    pub unknowns: usize,
    /// The number of free directions at the solutions; `None` before the first one.
    pub free: Option<usize>,
    /// The different solutions, the best first.
    pub solutions: Vec<Solution>,
}

impl Progress {
    /// A search that has not begun.
    #[must_use]
    pub fn new(seed: u32) -> Self {
        Progress {
            seed,
            starts: 0,
            solved: 0,
            conditions: 0,
            unknowns: 0,
            free: None,
            solutions: Vec::new(),
        }
    }
}

/// Starts that are tried before their results are compared. The results do not depend on the number of threads.
const BATCH: u64 = 64;
/// The solutions that are kept.
const KEPT: usize = 100;
/// Steps of the projection of a start.
const PROJECTION: usize = 60;
/// Steps of minimisation for every solution, and for those that are worth it.
const FIRST: usize = 30;
const LATER: usize = 600;
/// Squared errors this many times above that of the best solution are not minimised further.
const WORTH: f64 = 4.0;
/// Solutions closer than this are one.
const SAME: f64 = 1e-4;

impl Problem {
    /// The class of Hamiltonians and the order in which methods are compared.
    #[must_use]
    pub fn compared_in(&self) -> (HamiltonianClass, usize) {
        match &self.claim {
            Claim::Nystrom(order) => (HamiltonianClass::Nystrom, *order),
            claim => (
                HamiltonianClass::Separable,
                claim.order_in_power(usize::MAX).max(self.composed_order()),
            ),
        }
    }

    /// The order of a composition.
    fn composed_order(&self) -> usize {
        match self.claim {
            Claim::SymmetricBase(order) => order,
            _ => 0,
        }
    }

    /// Force evaluations a step; a gradient kick counts as two.
    #[must_use]
    pub fn forces(&self) -> usize {
        // The last kick and the first one of the next step are one.
        self.kicks + self.gradient.min(self.kicks)
    }

    /// The efficiency `s C^{1/p}` of a method with an error constant: the force evaluations in a unit of time at which the error is 1.
    #[must_use]
    pub fn efficiency(&self, error: f64) -> f64 {
        self.forces() as f64 * error.powf(1.0 / self.compared_in().1 as f64)
    }

    /// The number of unknowns.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        Model::new(self.structure, self.kicks, self.gradient).unknowns()
    }

    /// The difference of the degrees of the two leading terms of the error, and of successive orders.
    pub(crate) fn step(&self) -> usize {
        if self.structure.is_symmetric() { 2 } else { 1 }
    }

    /// The problem in words.
    pub(crate) fn text(&self) -> String {
        let (structure, kicks) = (self.structure.name(), self.kicks);
        let norm = match self.norm {
            Norm::Error => "error constant".to_owned(),
            Norm::ModuloConjugation => "error modulo conjugation".to_owned(),
            Norm::LongRuns => "error of long runs".to_owned(),
            Norm::Perturbed { epsilon } => format!("error constant for ε = {epsilon}"),
            Norm::Cost { tolerance } => format!("cost at an error of {tolerance:e}"),
        };
        let gradient = match self.gradient {
            0 => String::new(),
            count => format!(", {count} of them with gradients"),
        };
        let dispersion = if self.dispersion {
            ", dispersion of higher order"
        } else {
            ""
        };
        format!(
            "{}{dispersion}, {structure} with {kicks} kicks{gradient}, least {norm}, coefficients up to {}, stable up to hω = {} a kick",
            self.claim, self.largest, self.at_least_stable
        )
    }

    pub(crate) fn manifold(&self) -> Result<Manifold, CertifyError> {
        let (class, order) = self.compared_in();
        let model = Model::new(self.structure, self.kicks, self.gradient);
        let conditions = Conditions::new(&self.claim, self.structure.is_symmetric())?;
        let mut equations = vec![(Polynomials::new(&conditions), model.steps.clone())];
        if let Some(processor) = &model.processor {
            // P(h) = Q(h) Q(−h) is even up to the degree that the order needs, if these words vanish in Q.
            let degree = 2 * order.saturating_sub(7).div_ceil(2) + 1;
            let words = Conditions::new(&Claim::SymmetricBase(degree), true)?;
            equations.push((Polynomials::vanishing(&words), processor.clone()));
        }
        if self.dispersion {
            equations.push((dispersion(class, order)?, model.letters.clone()));
        }
        Ok(Manifold {
            equations,
            figure: Figure::new(class, order, self.step(), self.norm)?,
            largest: self.largest,
            model,
        })
    }

    /// Continues a search until `starts` starts have been tried, or `report`, which is called regularly, breaks it off.
    ///
    /// The same seed and number of starts give the same solutions, in one run or in several, and with any number of threads.
    ///
    /// ```
    /// use std::ops::ControlFlow;
    /// use symplectic_compiler::certify::Claim;
    /// use symplectic_search::{Norm, Problem, Progress, Structure};
    ///
    /// let problem = Problem {
    ///     claim: Claim::Separable(2),
    ///     structure: Structure::Aba,
    ///     kicks: 2,
    ///     gradient: 0,
    ///     norm: Norm::Error,
    ///     largest: 1.0,
    ///     dispersion: false,
    ///     at_least_stable: 0.0,
    /// };
    /// let mut progress = Progress::new(1);
    /// problem.search(&mut progress, 64, |_| ControlFlow::Continue(()))?;
    /// // McLachlan 1995: 0.1932 is the first drift of the best method with two kicks.
    /// assert!((progress.solutions[0].unknowns[0] - 0.1932).abs() < 1e-3);
    /// # Ok::<(), symplectic_compiler::certify::CertifyError>(())
    /// ```
    ///
    /// # Errors
    /// [`CertifyError::Order`] for an order that is zero or too high.
    pub fn search(
        &self,
        progress: &mut Progress,
        starts: u64,
        mut report: impl FnMut(&Progress) -> ControlFlow<()>,
    ) -> Result<(), CertifyError> {
        let manifold = self.manifold()?;
        progress.conditions = manifold
            .equations
            .iter()
            .map(|(polynomials, _)| polynomials.len())
            .sum();
        progress.unknowns = manifold.model.unknowns();
        while progress.starts < starts {
            let batch = progress.starts..(progress.starts + BATCH).min(starts);
            let best = progress
                .solutions
                .first()
                .map_or(f64::INFINITY, |best| best.error.powi(2));
            let seed = progress.seed;
            let points: Vec<Option<Point>> = batch
                .clone()
                .into_par_iter()
                .map(|index| manifold.minimum_from(seed, index, best))
                .collect();
            progress.starts = batch.end;
            for point in points.into_iter().flatten() {
                progress.solved += 1;
                progress.free = Some(point.free);
                let solution = self.solution(&manifold, point);
                if solution.stable >= self.at_least_stable {
                    keep(&mut progress.solutions, solution);
                }
            }
            if report(progress).is_break() {
                break;
            }
        }
        Ok(())
    }

    fn solution(&self, manifold: &Manifold, point: Point) -> Solution {
        let letters = &manifold.model.letters;
        let stable = stable_per_kick(
            &letters.exponents,
            &letters.at(&point.unknowns),
            self.forces(),
        );
        Solution {
            error: manifold
                .figure
                .value(&manifold.model, &point.unknowns)
                .sqrt(),
            stable,
            found: 1,
            is_minimum: point.converged,
            is_at_bound: manifold.is_at_bound(&point.unknowns),
            unknowns: point.unknowns.iter().copied().collect(),
        }
    }
}

impl Manifold {
    /// The minimum that a random start leads to; `best` is the squared error of the best solution so far.
    fn minimum_from(&self, seed: u32, index: u64, best: f64) -> Option<Point> {
        let mut random =
            Pcg64::seed_from_u64(u64::from(seed) ^ index.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let mut normal = || -> f64 { StandardNormal.sample(&mut random) };
        let spread = 0.15 + 0.1 * normal().abs().min(2.0);
        let noise = DVector::from_fn(self.model.unknowns(), |_, _| spread * normal());
        let solved = self.project(&(&self.model.typical + noise), PROJECTION)?;
        let point = self.minimise(self.point(solved), FIRST);
        match point.value < (WORTH * best).ln() {
            true => Some(self.minimise(point, LATER)),
            false => Some(point),
        }
    }
}

/// Adds a solution to the list, or counts it if it is known.
fn keep(solutions: &mut Vec<Solution>, solution: Solution) {
    let is_same = |known: &&mut Solution| {
        let pairs = known.unknowns.iter().zip(&solution.unknowns);
        pairs.fold(0.0, |far: f64, (x, y)| far.max((x - y).abs())) < SAME
    };
    if let Some(known) = solutions.iter_mut().find(is_same) {
        known.found += 1;
        if solution.error < known.error && solution.is_minimum {
            *known = Solution {
                found: known.found,
                ..solution
            };
        }
        return;
    }
    let at = solutions.partition_point(|known| known.error <= solution.error);
    solutions.insert(at, solution);
    solutions.truncate(KEPT);
}
