//! Methods on scenes: errors at equal cost, in long runs.

use nalgebra::DVector;
use rayon::prelude::*;
use symplectic_compiler::certify::{CertifyError, Claim, Conditions, DRIFT, KICK};
use symplectic_compiler::order::HamiltonianClass;
use symplectic_compiler::{Definition, Error, Key, Tableau, catalogue};

use crate::figure::{Figure, Norm};
use crate::hunt::Problem;
use crate::polynomials::Polynomials;
use crate::scenes::{Half, Kind, SCENES, Scene, State};
use crate::structure::Model;
use crate::words::Exponent;

/// A splitting as a list of drifts and kicks, in doubles. A processed one has the lists of its processor and of its inverse too.
#[derive(Debug, Clone)]
pub struct Splitting {
    flows: Flows,
    processor: Option<[Flows; 2]>,
    forces: usize,
}

type Flows = Vec<(Half, f64)>;

impl Splitting {
    /// The drifts and kicks of a tableau; `None` if it is not a splitting.
    #[must_use]
    pub fn of(tableau: &Tableau) -> Option<Self> {
        let forces = tableau.evaluations()?.cost();
        Some(match tableau.processed() {
            None => Splitting {
                flows: flows(tableau)?,
                processor: None,
                forces,
            },
            Some(processed) => Splitting {
                flows: flows(&processed.kernel)?,
                processor: Some([flows(&processed.inverse)?, flows(&processed.processor)?]),
                forces,
            },
        })
    }

    /// Force evaluations a step; a gradient kick counts as two.
    #[must_use]
    pub fn forces(&self) -> usize {
        self.forces
    }

    /// The model whose unknowns are the fractions of the step, and these fractions.
    fn model(&self) -> (Model, DVector<f64>) {
        let exponent = |half: &Half| match half {
            Half::Drift => Exponent::Letter(DRIFT),
            Half::Kick => Exponent::Letter(KICK),
            Half::Gradient => Exponent::Gradient,
        };
        let whole: Vec<&(Half, f64)> = match &self.processor {
            None => self.flows.iter().collect(),
            Some([inverse, processor]) => {
                inverse.iter().chain(&self.flows).chain(processor).collect()
            }
        };
        let exponents = whole.iter().map(|(half, _)| exponent(half));
        let fractions = whole.iter().map(|(_, fraction)| *fraction);
        let fractions = DVector::from_iterator(whole.len(), fractions);
        (Model::of_all(exponents.collect()), fractions)
    }

    /// The states of a run at equal distances in time, with about this many force evaluations in a unit of time.
    fn run(&self, scene: &Scene, rate: f64) -> Vec<State> {
        let parts = SAMPLES as f64;
        let steps = (rate * scene.time / (self.forces as f64 * parts))
            .round()
            .max(1.0);
        let size = scene.time / (parts * steps);
        let apply = |flows: &Flows, state: &mut State| {
            for (half, fraction) in flows {
                // p += h (b f + 2 g h² f′f)
                let time = match half {
                    Half::Gradient => 2.0 * fraction * size.powi(3),
                    Half::Drift | Half::Kick => fraction * size,
                };
                scene.apply(*half, time, state);
            }
        };
        let mut state = scene.start();
        if let Some([inverse, _]) = &self.processor {
            apply(inverse, &mut state);
        }
        (0..SAMPLES)
            .map(|_| {
                for _ in 0..steps as usize {
                    apply(&self.flows, &mut state);
                }
                let mut shown = state.clone();
                if let Some([_, processor]) = &self.processor {
                    apply(processor, &mut shown);
                }
                shown
            })
            .collect()
    }
}

/// The drifts and kicks of a tableau; `None` if it is not a splitting.
fn flows(tableau: &Tableau) -> Option<Flows> {
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
    for (stage, (drift, kick)) in numbers.b.into_iter().zip(numbers.b_tilde).enumerate() {
        let gradient = numbers.gradient.get(stage).copied().unwrap_or(0.0);
        let stage = [
            (Half::Kick, kick),
            (Half::Gradient, gradient),
            (Half::Drift, drift),
        ];
        match drift_first {
            true => flows.extend(stage.into_iter().rev()),
            false => flows.extend(stage),
        }
    }
    flows.retain(|(_, fraction)| *fraction != 0.0);
    Some(flows)
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
    /// Its drifts and kicks.
    pub splitting: Splitting,
}

/// Residuals of conditions that hold are smaller, of coefficients in doubles.
const HOLDS: f64 = 1e-10;

/// The methods of the catalogue that have the orders of a problem and no higher order in its class, the most efficient first.
///
/// Orders and error constants are those of the coefficients in doubles: the catalogue is proved already.
///
/// # Errors
/// [`CertifyError::Order`] for an order that cannot be claimed.
pub fn rivals(problem: &Problem) -> Result<Vec<Known>, CertifyError> {
    let (class, order) = problem.compared_in();
    let claim = match &problem.claim {
        Claim::SymmetricBase(order) => Claim::Separable(*order),
        claim => claim.clone(),
    };
    let conditions = Polynomials::new(&Conditions::new(&claim, false)?);
    let errors =
        [class, HamiltonianClass::Nystrom].map(|class| Figure::new(class, order, 1, Norm::Error));
    let [figure, for_quadratic] = errors;
    let (figure, for_quadratic) = (figure?, for_quadratic?);
    let known = |entry: catalogue::Entry| {
        let splitting = Splitting::of(&entry.derive().ok()?)?;
        let (model, fractions) = splitting.model();
        let error = figure.value(&model, &fractions).sqrt();
        // A method of higher order for quadratic T belongs to that class.
        let is_rival = conditions.values(&model.letters, &fractions).amax() < HOLDS
            && error > HOLDS
            && for_quadratic.value(&model, &fractions).sqrt() > HOLDS;
        let efficiency = splitting.forces as f64 * error.powf(1.0 / order as f64);
        is_rival.then_some(Known {
            name: entry.name,
            error,
            efficiency,
            splitting,
        })
    };
    // Printed digits are solved for, which takes time: other orders than the claimed one are left out before.
    let claims = |entry: &catalogue::Entry| {
        let definition = Definition::parse(&entry.definition).ok()?;
        let claim = definition.get(Key::Claim)?.trim_end_matches(')');
        claim.rsplit(['(', ',']).next()?.trim().parse().ok()
    };
    let entries = catalogue::entries()
        .filter(|entry| claims(entry).is_none_or(|claimed: usize| claimed == order));
    let entries: Vec<_> = entries.collect();
    let mut known: Vec<Known> = entries.into_par_iter().filter_map(known).collect();
    known.sort_by(|x, y| {
        x.efficiency
            .total_cmp(&y.efficiency)
            .then_with(|| x.name.cmp(&y.name))
    });
    Ok(known)
}

/// The class of a problem as a word of the command line.
pub(crate) fn class_name(problem: &Problem) -> &'static str {
    match (&problem.claim, problem.compared_in().0) {
        (Claim::Perturbed(_), _) => "perturbed",
        (_, HamiltonianClass::Nystrom) => "nystrom",
        _ => "separable",
    }
}
