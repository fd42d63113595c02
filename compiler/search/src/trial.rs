//! Methods on scenes: errors at equal cost, in long runs.

use rayon::prelude::*;
use symplectic_compiler::certify::Claim;
use symplectic_compiler::order::HamiltonianClass;
use symplectic_compiler::{Error, Tableau, catalogue};

use crate::hunt::Problem;
use crate::proof::error_constant;
use crate::scenes::{Half, Kind, SCENES, Scene, State};

/// A splitting as a list of drifts and kicks, in doubles.
#[derive(Debug, Clone)]
pub struct Splitting {
    flows: Vec<(Half, f64)>,
    forces: usize,
}

impl Splitting {
    /// The drifts and kicks of a tableau; `None` if it is not a splitting.
    #[must_use]
    pub fn of(tableau: &Tableau) -> Option<Self> {
        let forces = tableau.evaluations()?.forces;
        let numbers = tableau.to_f64();
        let stages = numbers.b.len();
        // In a splitting the entries of the matrices are the weights of earlier steps, and of the own one of the kind that comes first.
        let is_splitting = |own_drift: bool| {
            (0..stages).all(|i| {
                (0..stages).all(|j| {
                    let drifted = j < i || (j == i && own_drift);
                    let kicked = j < i || (j == i && !own_drift);
                    numbers.a[i][j] == if drifted { numbers.b[j] } else { 0.0 }
                        && numbers.a_tilde[i][j] == if kicked { numbers.b_tilde[j] } else { 0.0 }
                })
            })
        };
        let drift_first = match (is_splitting(false), is_splitting(true)) {
            (true, _) => false,
            (_, true) => true,
            _ => return None,
        };
        let mut flows = Vec::new();
        for (drift, kick) in numbers.b.into_iter().zip(numbers.b_tilde) {
            let pair = [(Half::Kick, kick), (Half::Drift, drift)];
            match drift_first {
                true => flows.extend(pair.into_iter().rev()),
                false => flows.extend(pair),
            }
        }
        flows.retain(|(_, fraction)| *fraction != 0.0);
        Some(Splitting { flows, forces })
    }

    /// The states of a run at equal distances in time, with about this many force evaluations in a unit of time.
    fn run(&self, scene: &Scene, rate: f64) -> Vec<State> {
        let parts = SAMPLES as f64;
        let steps = (rate * scene.time / (self.forces as f64 * parts))
            .round()
            .max(1.0);
        let size = scene.time / (parts * steps);
        let mut state = scene.start();
        (0..SAMPLES)
            .map(|_| {
                for _ in 0..steps as usize {
                    for (half, fraction) in &self.flows {
                        scene.apply(*half, fraction * size, &mut state);
                    }
                }
                state.clone()
            })
            .collect()
    }
}

/// States of a run that are compared.
const SAMPLES: usize = 8;
/// Ratios of rates of evaluations: `2^{k/2}`.
const RATES: i32 = 13;
/// Errors that are compared: smaller ones are rounding errors, and of larger ones nothing is left of the order.
const COMPARED: std::ops::Range<f64> = 3e-11..3e-2;
/// The method of the references, and how many more evaluations they take than the finest run.
const REFERENCE: &str = "kahan-li-1997-s17odr8-a";
const FINER: f64 = 4.0;

/// What a scene shows about a method and another one.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// The scene.
    pub scene: &'static str,
    /// For each rate of force evaluations: the rate, the error of the method and that of the other one.
    pub errors: Vec<(f64, f64, f64)>,
}

impl Comparison {
    /// The geometric mean of the ratios of both errors at equal cost: below 1 the method is better. `None` without comparable errors.
    #[must_use]
    pub fn ratio(&self) -> Option<f64> {
        let logarithms = self.errors.iter().map(|(_, own, other)| (own / other).ln());
        let count = self.errors.len() as f64;
        (count > 0.0).then(|| (logarithms.sum::<f64>() / count).exp())
    }

    /// The largest of the ratios.
    #[must_use]
    pub fn worst(&self) -> Option<f64> {
        self.errors
            .iter()
            .map(|(_, own, other)| own / other)
            .reduce(f64::max)
    }
}

/// Errors of methods on all scenes of a class; each scene is integrated at several costs.
#[derive(Debug)]
pub struct Trial {
    scenes: Vec<(&'static Scene, Vec<State>)>,
}

impl Trial {
    /// The scenes for a problem, with their references.
    ///
    /// # Errors
    /// None as long as the catalogue has the method for the references.
    pub fn new(problem: &Problem) -> Result<Self, Error> {
        let takes = |kind: Kind| match &problem.claim {
            Claim::Perturbed(_) => kind == Kind::Perturbed,
            Claim::Nystrom(_) => kind == Kind::Quadratic,
            Claim::Separable(_) | Claim::SymmetricBase(_) => kind != Kind::Perturbed,
        };
        let fine = catalogue::find(REFERENCE).ok_or_else(|| catalogue::unknown(REFERENCE))?;
        let fine = Splitting::of(&fine.derive()?).ok_or_else(|| catalogue::unknown(REFERENCE))?;
        let scenes: Vec<&'static Scene> = SCENES.iter().filter(|scene| takes(scene.kind)).collect();
        let reference =
            |scene: &'static Scene| (scene, fine.run(scene, FINER * rate(scene, RATES - 1)));
        Ok(Trial {
            scenes: scenes.into_par_iter().map(reference).collect(),
        })
    }

    /// The names of the scenes.
    #[must_use]
    pub fn scenes(&self) -> Vec<&'static str> {
        self.scenes.iter().map(|(scene, _)| scene.name).collect()
    }

    /// The errors of a method: for each scene the largest one at each rate.
    #[must_use]
    pub fn errors(&self, method: &Splitting) -> Vec<Vec<f64>> {
        let scenes = self.scenes.par_iter();
        let errors = scenes.map(|(scene, reference)| {
            (0..RATES)
                .map(|index| {
                    let found = method.run(scene, rate(scene, index));
                    found
                        .iter()
                        .zip(reference)
                        .fold(0.0, |largest: f64, (x, y)| largest.max(x.distance(y)))
                })
                .collect()
        });
        errors.collect()
    }

    /// Compares the errors of a method with those of another one.
    #[must_use]
    pub fn compare(&self, own: &[Vec<f64>], other: &[Vec<f64>]) -> Vec<Comparison> {
        let scenes = self.scenes.iter().zip(own.iter().zip(other));
        let comparison =
            |((scene, _), (own, other)): (&(&'static Scene, _), (&Vec<f64>, &Vec<f64>))| {
                let pairs = (0..RATES).zip(own.iter().zip(other));
                let pairs = pairs.map(|(index, (own, other))| (rate(scene, index), *own, *other));
                Comparison {
                    scene: scene.name,
                    errors: pairs
                        .filter(|(_, own, other)| {
                            COMPARED.contains(own) && COMPARED.contains(other)
                        })
                        .collect(),
                }
            };
        scenes.map(comparison).collect()
    }
}

fn rate(scene: &Scene, index: i32) -> f64 {
    scene.rate * 2f64.powf(0.5 * f64::from(index))
}

/// A method of the catalogue with the class and order of a problem.
#[derive(Debug, Clone)]
pub struct Known {
    /// Its name.
    pub name: String,
    /// Its error constant in the class.
    pub error: f64,
    /// `s C^{1/p}`.
    pub efficiency: f64,
    /// Its tableau.
    pub tableau: Tableau,
}

/// The methods of the catalogue that have at least the orders of a problem and no higher order in its class, the most efficient first.
#[must_use]
pub fn rivals(problem: &Problem) -> Vec<Known> {
    let (class, order) = problem.compared_in();
    let entries: Vec<_> = catalogue::entries().collect();
    let known = |entry: catalogue::Entry| {
        let tableau = entry.derive().ok()?;
        let forces = tableau.evaluations()?.forces;
        let is_rival = match &problem.claim {
            Claim::Perturbed(orders) => tableau.perturbed_order()?.orders() == *orders,
            // A method of higher order for quadratic T belongs to that class.
            _ => {
                let report = tableau.orders();
                let is_of_order = |class| report.class(class).order == order;
                is_of_order(class) && is_of_order(HamiltonianClass::Nystrom)
            }
        };
        let error = is_rival.then(|| error_constant(&tableau, class))?;
        let efficiency = forces as f64 * error.powf(1.0 / order as f64);
        Some(Known {
            name: entry.name,
            error,
            efficiency,
            tableau,
        })
    };
    let mut known: Vec<Known> = entries.into_par_iter().filter_map(known).collect();
    known.sort_by(|x, y| {
        x.efficiency
            .total_cmp(&y.efficiency)
            .then_with(|| x.name.cmp(&y.name))
    });
    known
}

/// The class of a problem as a word of the command line.
pub(crate) fn class_name(problem: &Problem) -> &'static str {
    match (&problem.claim, problem.compared_in().0) {
        (Claim::Perturbed(_), _) => "perturbed",
        (_, HamiltonianClass::Nystrom) => "nystrom",
        _ => "separable",
    }
}
