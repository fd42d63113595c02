//! Every explicit method of the catalogue on scenes: the force evaluations of a run for a global error.
//!
//! `cargo run --release -p symplectic-tests --example explicit_methods` prints for each scene and error the methods with the fewest
//! evaluations; with names of scenes, only these. On each scene all methods take runs of the same costs, 1/√2 apart: a method of n
//! evaluations a step takes steps n times as long as leapfrog. The cost for an error is interpolated between two runs. Sums are compensated,
//! so that rounding hides no method. `tests/src/bin/report` measures times.
#![allow(clippy::print_stdout, reason = "the table is what this program is for")]

use std::error::Error;

use symplectic::at_run_time::RunTimeTableau;
use symplectic::{Integrator, Separable, State, System, Vector};
use symplectic_compiler::catalogue;
use symplectic_tests::at_run_time::tableau;
use symplectic_tests::methods::Gauss8;
use symplectic_tests::scenes::{
    argon_crystal, fput_chain, henon_heiles, kepler, outer_solar_system, pendulum, sine_gordon,
};

symplectic::hamiltonian! {
    /// A pendulum whose velocity is bounded.
    RelativisticPendulum
    q: [x], p: [px];
    H = sqrt(1 + px^2) - cos(x)
}

symplectic::hamiltonian! {
    /// An anharmonic oscillator in the plane whose velocity is bounded.
    RelativisticOscillator
    q: [2], p: [2];
    H = sqrt(1 + |p|^2) + |q|^2/2 + q[0]^2 q[1]^2
}

/// The global errors.
const TARGETS: [f64; 4] = [1e-3, 1e-6, 1e-9, 1e-12];

/// How many methods are shown for an error.
const SHOWN: usize = 6;

/// A method with its force evaluations a step.
struct Explicit {
    tableau: RunTimeTableau,
    name: String,
    forces: usize,
}

/// A scene: its start, the state at its end, and the step of leapfrog with which it begins.
struct Scene<V, S> {
    name: &'static str,
    system: S,
    start: State<V>,
    end: State<V>,
    first: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let measured = Measured {
        methods: methods()?,
        chosen: std::env::args().skip(1).collect(),
    };
    println!(
        "{} explicit methods; force evaluations of a run\n",
        measured.methods.len()
    );
    let mut quadratic = Vec::new();
    for (name, eccentricity) in [("kepler-0.3", 0.3), ("kepler-0.6", 0.6)] {
        quadratic.extend(measured.known(Scene {
            name,
            system: kepler::Kepler,
            start: kepler::start(eccentricity),
            end: kepler::exact(eccentricity, 125.0),
            first: 0.2,
        }));
    }
    quadratic.extend(measured.known(Scene {
        name: "pendulum",
        system: pendulum::Pendulum,
        start: pendulum::start(1.5),
        end: pendulum::exact(1.5, 100.0),
        first: 0.5,
    }));
    let (system, start) = (henon_heiles::HenonHeiles, henon_heiles::start());
    quadratic.extend(measured.computed("henon-heiles", system, start, (1000.0, 0.125), 0.5)?);
    let (system, start) = (
        outer_solar_system::OuterSolarSystem,
        outer_solar_system::start(),
    );
    let time = (200_000.0, 150.0);
    quadratic.extend(measured.computed("outer-solar-system", system, start, time, 200.0)?);
    let (system, start) = (argon_crystal::ArgonCrystal, argon_crystal::start());
    quadratic.extend(measured.computed("argon-crystal", system, start, (0.02, 1e-4), 1e-4)?);
    let (system, start) = (fput_chain::system(), fput_chain::start(64));
    quadratic.extend(measured.computed("fput-chain-64", system, start, (100.0, 0.2), 0.5)?);
    let (system, start) = (sine_gordon::system(), sine_gordon::start());
    quadratic.extend(measured.computed("sine-gordon", system, start, (10.0, 0.05), 0.2)?);
    let mut other = Vec::new();
    let start = State::from_arrays(0.0, [0.0], [1.5]);
    let system = RelativisticPendulum;
    other.extend(measured.computed("relativistic-pendulum", system, start, (100.0, 0.1), 0.5)?);
    let start = State::from_arrays(0.0, [0.8, 0.3], [0.2, 0.9]);
    let system = RelativisticOscillator;
    other.extend(measured.computed("relativistic-oscillator", system, start, (100.0, 0.1), 0.5)?);
    measured.summary("all scenes with quadratic T", &quadratic);
    measured.summary("all scenes with other T", &other);
    Ok(())
}

/// The evaluations of each method for each target, where it reaches the target.
type Costs = Vec<Vec<Option<f64>>>;

/// The methods, and parts of the names of the scenes on which they are measured; all scenes if there are none.
struct Measured {
    methods: Vec<Explicit>,
    chosen: Vec<String>,
}

impl Measured {
    /// Measures a scene whose end is that of Gauss's method with eight stages and this step.
    fn computed<V, S>(
        &self,
        name: &'static str,
        system: S,
        start: State<V>,
        (time, step_size): (f64, f64),
        first: f64,
    ) -> Result<Option<Costs>, Box<dyn Error>>
    where
        V: Vector<Scalar = f64>,
        S: System<V, Class = Separable> + Clone,
    {
        let mut gauss = Integrator::new(Gauss8, system.clone(), start.clone(), step_size)?;
        let end = gauss.integrate_to(time)?.clone();
        Ok(self.known(Scene {
            name,
            system,
            start,
            end,
            first,
        }))
    }

    /// Measures a scene, if it is chosen, and prints the methods with the fewest evaluations.
    fn known<V, S>(&self, scene: Scene<V, S>) -> Option<Costs>
    where
        V: Vector<Scalar = f64>,
        S: System<V, Class = Separable> + Clone,
    {
        let is_chosen = |part: &String| scene.name.contains(part.as_str());
        if !self.chosen.is_empty() && !self.chosen.iter().any(is_chosen) {
            return None;
        }
        let costs: Costs = self.methods.iter().map(|m| costs(m, &scene)).collect();
        let cost = |method: usize, target: usize| costs[method][target];
        self.print(scene.name, cost, |cost| format!("{cost:.0}"));
        Some(costs)
    }

    /// Prints the geometric mean over scenes of the evaluations, in units of those of the best method of a scene. A method that misses an
    /// error that another one reaches is left out there.
    fn summary(&self, title: &str, scenes: &[Costs]) {
        if scenes.is_empty() {
            return;
        }
        let mean = |method: usize, target: usize| -> Option<f64> {
            let (mut sum, mut count) = (0.0, 0.0);
            for costs in scenes {
                let reached = costs.iter().filter_map(|costs| costs[target]);
                let Some(best) = reached.min_by(f64::total_cmp) else {
                    continue;
                };
                sum += (costs[method][target]? / best).ln();
                count += 1.0;
            }
            (count > 0.0).then(|| f64::exp(sum / count))
        };
        self.print(title, mean, |mean| format!("{mean:.2}"));
    }

    fn print(
        &self,
        title: &str,
        cost: impl Fn(usize, usize) -> Option<f64>,
        shown: impl Fn(f64) -> String,
    ) {
        println!("## {title}\n");
        for (k, target) in TARGETS.into_iter().enumerate() {
            let methods = self.methods.iter().enumerate();
            let mut found: Vec<(f64, &str)> = methods
                .filter_map(|(i, method)| Some((cost(i, k)?, method.name.as_str())))
                .collect();
            found.sort_by(|x, y| x.0.total_cmp(&y.0));
            println!("{target:.0e}");
            for (cost, name) in found.into_iter().take(SHOWN) {
                println!("  {:>9}  {name}", shown(cost));
            }
        }
        println!();
    }
}

/// The explicit methods of the catalogue, each under one name.
fn methods() -> Result<Vec<Explicit>, Box<dyn Error>> {
    /// More forces in a step are worse than a method of the same order with fewer.
    const MOST: usize = 36;
    let mut methods = Vec::new();
    for entry in catalogue::entries() {
        let exact = entry.derive()?;
        let Some(evaluations) = exact.evaluations().filter(|known| known.forces <= MOST) else {
            continue;
        };
        if entry
            .same_as()
            .iter()
            .any(|other| methods.iter().any(|known: &Explicit| known.name == *other))
        {
            continue;
        }
        methods.push(Explicit {
            tableau: tableau(&entry.name, &exact)?,
            name: entry.name,
            forces: evaluations.forces,
        });
    }
    Ok(methods)
}

/// The evaluations for each target, where the method reaches it: those of the last run after which errors stay below it.
fn costs<V, S>(method: &Explicit, scene: &Scene<V, S>) -> Vec<Option<f64>>
where
    V: Vector<Scalar = f64>,
    S: System<V, Class = Separable> + Clone,
{
    /// Runs, each with √2 times the cost of the one before.
    const RUNS: i32 = 18;
    /// Runs with errors below all targets, after which the measurement ends.
    const BELOW: usize = 3;
    let time = scene.end.time - scene.start.time;
    let mut found = vec![None; TARGETS.len()];
    let mut before: Option<(f64, f64)> = None;
    let mut below = 0;
    for k in 0..RUNS {
        let longest = scene.first * method.forces as f64 / 2_f64.powf(f64::from(k) / 2.0);
        let steps = (time / longest).ceil();
        let cost = steps * method.forces as f64;
        let Some(error) = error(method, scene, time / steps, steps as u64) else {
            found.fill(None);
            before = None;
            continue;
        };
        for (known, target) in found.iter_mut().zip(TARGETS) {
            if error > target {
                *known = None;
            } else if known.is_none() {
                // Between two runs the error is a power of the cost.
                *known = Some(match before {
                    Some((cheaper, larger)) => {
                        let part = (larger / target).ln() / (larger / error.max(1e-16)).ln();
                        cheaper * (cost / cheaper).powf(part)
                    }
                    None => cost,
                });
            }
        }
        below = if found.iter().all(Option::is_some) {
            below + 1
        } else {
            0
        };
        if below == BELOW {
            break;
        }
        before = Some((cost, error));
    }
    found
}

/// The relative error of the positions or of the momenta at the end, whichever is larger; `None` for a run that fails.
fn error<V, S>(method: &Explicit, scene: &Scene<V, S>, step_size: f64, steps: u64) -> Option<f64>
where
    V: Vector<Scalar = f64>,
    S: System<V, Class = Separable> + Clone,
{
    let (system, start) = (scene.system.clone(), scene.start.clone());
    let mut run = Integrator::new(method.tableau.clone(), system, start, step_size).ok()?;
    run.take_steps(steps).ok()?;
    let state = run.state();
    let pairs = [(&state.q, &scene.end.q), (&state.p, &scene.end.p)];
    let errors = pairs.map(|(found, exact)| {
        let norm =
            |values: &mut dyn Iterator<Item = f64>| values.map(|x| x * x).sum::<f64>().sqrt();
        let (found, exact) = (found.as_slice(), exact.as_slice());
        let mut differences = found.iter().zip(exact).map(|(x, y)| x - y);
        norm(&mut differences) / norm(&mut exact.iter().copied())
    });
    let error = errors[0].max(errors[1]);
    error.is_finite().then_some(error)
}
