//! The computation of each reference, as data.

use symplectic::nalgebra::{DVector, SVector};
use symplectic::{Scalar, State, System, Vector};

use super::{Collocation, NoConvergence, Record, Wide};
use crate::measure::largest;
use crate::scenes::argon_crystal::{self, ArgonCrystal};
use crate::scenes::charged_particle::{self, ChargedParticle};
use crate::scenes::damped_particle::{self, DampedParticle};
use crate::scenes::double_pendulum::{self, DoublePendulum};
use crate::scenes::fput_chain;
use crate::scenes::fput_springs::{self, FputSprings};
use crate::scenes::henon_heiles::{self, HenonHeiles};
use crate::scenes::nonseparable::{self, Nonseparable};
use crate::scenes::outer_solar_system::{self, OuterSolarSystem};
use crate::scenes::pythagorean_three_body::{self, PythagoreanThreeBody};
use crate::scenes::sine_gordon;
use crate::scenes::{point_vortices, post_newtonian_kepler};

/// A run from the start of a scene to an end time.
#[derive(Clone, Copy, Debug)]
pub struct Recomputation {
    /// The scene.
    pub scene: &'static str,
    /// Its parameters, if it has any.
    pub parameters: &'static str,
    /// The end time.
    pub time: f64,
    /// The step size of the coarser run, or its factor for the time scale of the scene.
    pub step: f64,
    /// The run with a given step size.
    run: Run,
}

type Run = fn(&Collocation, time: f64, step: f64) -> Result<End, NoConvergence>;

/// Steps, position and momentum.
type End = (u64, [Vec<Wide>; 2]);

/// The ratio of the step sizes of the finer and the coarser run.
const REFINEMENT: f64 = 0.75;

/// All recomputations.
pub const ALL: &[Recomputation] = &[
    Recomputation {
        scene: "Hénon–Heiles",
        parameters: "E = 1/8",
        time: 1e4,
        step: 1.0,
        run: |method, time, step| uniform(method, HenonHeiles, henon_heiles::start(), time, step),
    },
    Recomputation {
        scene: "Hénon–Heiles",
        parameters: "E = 1/12",
        time: 1e4,
        step: 1.0,
        run: |method, time, step| {
            uniform(
                method,
                HenonHeiles,
                henon_heiles::start_at_one_twelfth(),
                time,
                step,
            )
        },
    },
    Recomputation {
        scene: "outer solar system",
        parameters: "",
        time: 500_000.0,
        step: 400.0,
        run: |method, time, step| {
            uniform(
                method,
                OuterSolarSystem,
                outer_solar_system::start(),
                time,
                step,
            )
        },
    },
    Recomputation {
        scene: "Pythagorean three-body",
        parameters: "",
        time: 70.0,
        step: 0.09,
        run: |method, time, step| {
            let start: State<SVector<Wide, 6>> = pythagorean_three_body::start();
            // Kepler's third law for the nearest pair.
            let scale = |state: &State<SVector<Wide, 6>>| {
                let distances = pythagorean_three_body::distances(&state.q).map(Wide::to_f64);
                let nearest = distances.into_iter().fold(f64::INFINITY, f64::min);
                step * (nearest.powi(3) / 9.0).sqrt()
            };
            end(method.integrate(&PythagoreanThreeBody, &start, time, scale))
        },
    },
    Recomputation {
        scene: "FPUT springs",
        parameters: "ω = 50",
        time: 200.0,
        step: 1.0 / 16.0,
        run: |method, time, step| springs(method, 50.0, time, step),
    },
    Recomputation {
        scene: "FPUT springs",
        parameters: "ω = 1000",
        time: 1.0,
        step: 1.0 / 256.0,
        run: |method, time, step| springs(method, 1e3, time, step),
    },
    Recomputation {
        scene: "FPUT springs",
        parameters: "ω = 100000",
        time: 1.0 / 64.0,
        step: 1.0 / 32768.0,
        run: |method, time, step| springs(method, 1e5, time, step),
    },
    Recomputation {
        scene: "argon crystal",
        parameters: "",
        time: 0.02,
        step: 1.0 / 12_288.0,
        run: |method, time, step| uniform(method, ArgonCrystal, argon_crystal::start(), time, step),
    },
    Recomputation {
        scene: "FPUT chain",
        parameters: "N = 16",
        time: 100.0,
        step: 0.5,
        run: |method, time, step| {
            let start = State::new(
                0.0,
                DVector::from_element(16, Wide::from_f64(0.0)),
                DVector::from_iterator(16, fput_chain::momenta(16)),
            );
            uniform(method, fput_chain::system(), start, time, step)
        },
    },
    Recomputation {
        scene: "sine-Gordon lattice",
        parameters: "N = 64",
        time: 10.0,
        step: 0.25,
        run: |method, time, step| {
            uniform(
                method,
                sine_gordon::system(),
                sine_gordon::start(),
                time,
                step,
            )
        },
    },
    Recomputation {
        scene: "damped particle",
        parameters: "no damping",
        time: 100.0,
        step: 0.1875,
        run: |method, time, step| {
            uniform(method, DampedParticle, damped_particle::start(), time, step)
        },
    },
    Recomputation {
        scene: "double pendulum",
        parameters: "",
        time: 100.0,
        step: 0.0625,
        run: |method, time, step| {
            uniform(method, DoublePendulum, double_pendulum::start(), time, step)
        },
    },
    Recomputation {
        scene: "nonseparable",
        parameters: "",
        time: 100.0,
        step: 0.125,
        run: |method, time, step| uniform(method, Nonseparable, nonseparable::start(), time, step),
    },
    Recomputation {
        scene: "charged particle",
        parameters: "",
        time: 100.0,
        step: 0.125,
        run: |method, time, step| {
            uniform(
                method,
                ChargedParticle,
                charged_particle::start(),
                time,
                step,
            )
        },
    },
    Recomputation {
        scene: "post-Newtonian Kepler",
        parameters: "ε = 0.001, ν = 1/4",
        time: 125.0,
        step: 0.75,
        run: |method, time, step| {
            let start = post_newtonian_kepler::start();
            let scale = |state: &State<SVector<Wide, 2>>| {
                0.5 * step * state.q.dot(&state.q).to_f64().powf(0.75)
            };
            end(method.integrate(&post_newtonian_kepler::EQUAL_MASSES, &start, time, scale))
        },
    },
    Recomputation {
        scene: "point vortices",
        parameters: "N = 4",
        time: 50.0,
        step: 0.125,
        run: |method, time, step| {
            uniform(
                method,
                point_vortices::FOUR,
                point_vortices::start(),
                time,
                step,
            )
        },
    },
];

fn springs(method: &Collocation, omega: f64, time: f64, step: f64) -> Result<End, NoConvergence> {
    let start = fput_springs::start(omega);
    uniform(method, FputSprings { omega }, start, time, step)
}

fn uniform<V, S>(
    method: &Collocation,
    system: S,
    start: State<V>,
    time: f64,
    step: f64,
) -> Result<End, NoConvergence>
where
    V: Vector<Scalar = Wide>,
    S: System<V>,
{
    end(method.integrate(&system, &start, time, |_| step))
}

fn end<V>(result: Result<(State<V>, u64), NoConvergence>) -> Result<End, NoConvergence>
where
    V: Vector<Scalar = Wide>,
{
    let (state, steps) = result?;
    let (q, p) = state.as_slices();
    Ok((steps, [q.to_vec(), p.to_vec()]))
}

impl Recomputation {
    /// Whether the record belongs to this run.
    pub fn is_of(&self, record: &Record) -> bool {
        (
            record.scene.as_str(),
            record.parameters.as_str(),
            record.time,
        ) == (self.scene, self.parameters, self.time)
    }

    /// Makes both runs.
    ///
    /// # Errors
    ///
    /// [`NoConvergence`].
    pub fn run(&self, method: &Collocation) -> Result<Record, NoConvergence> {
        let (coarse_steps, coarse) = (self.run)(method, self.time, self.step)?;
        let (fine_steps, fine) = (self.run)(method, self.time, REFINEMENT * self.step)?;
        let distance = |half: usize| relative_distance(&coarse[half], &fine[half]);
        let [q, p] = &fine;
        let digits = |half: &[Wide]| half.iter().map(Wide::to_string).collect();
        Ok(Record {
            scene: self.scene.to_owned(),
            parameters: self.parameters.to_owned(),
            time: self.time,
            stages: method.stages(),
            steps: [coarse_steps, fine_steps],
            agreement: format!("{:.1e}", distance(0).max(distance(1))),
            q: digits(q),
            p: digits(p),
        })
    }
}

impl Record {
    /// The distance of the end of a run with this step size from the record, in the sense of
    /// [`agreement`](Self::agreement); NaN if the record cannot be parsed or has another dimension.
    ///
    /// # Errors
    ///
    /// [`NoConvergence`].
    pub fn distance(
        &self,
        run: &Recomputation,
        method: &Collocation,
        step: f64,
    ) -> Result<f64, NoConvergence> {
        let (_, end) = (run.run)(method, run.time, step)?;
        let digits = [&self.q, &self.p].map(|half| -> Option<Vec<Wide>> {
            half.iter().map(|digits| Wide::parse(digits)).collect()
        });
        let distances = end.iter().zip(&digits).map(|(end, digits)| match digits {
            Some(digits) if digits.len() == end.len() => relative_distance(end, digits),
            _ => f64::NAN,
        });
        Ok(distances.fold(0.0, largest))
    }
}

/// `|a − b|/|b|` in the 2-norm.
fn relative_distance(a: &[Wide], b: &[Wide]) -> f64 {
    let norm = |components: &mut dyn Iterator<Item = Wide>| {
        let squares = components.map(|x| x * x);
        squares.fold(Wide::from_f64(0.0), |sum, x| sum + x).sqrt()
    };
    let difference = norm(&mut a.iter().zip(b).map(|(&a, &b)| a - b));
    (difference / norm(&mut b.iter().copied())).to_f64()
}
