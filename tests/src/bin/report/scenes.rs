//! The scenes of the report, one function each: the system, the reference, the largest step, and the sets of methods.
//!
//! Here are those of the README; a new scene needs a function and a row in [`more`](crate::more). Every scene is compiled with every method
//! of its sets, so all scenes take twice as long to build.

use std::f64::consts::TAU;

use symplectic::nalgebra::SVector;
use symplectic::{Error, Separable, State, System};
use symplectic_report::{Problem, Reference, Study};
use symplectic_tests::methods::Gauss8;
use symplectic_tests::scenes::{
    double_pendulum, fput_chain, henon_heiles, kepler, outer_solar_system,
};

use crate::peers::{with_forest_ruth, with_peers};
use crate::sets::{Set, coupled, explicit, implicit, more_explicit};

/// A scene: its name on the command line, and the function that adds it to a study.
pub type Scene = (&'static str, fn(Study) -> Result<Study, Error>);

/// The scenes of the README.
const OF_THE_README: &[Scene] = &[
    ("kepler-0.6", |study| {
        kepler(study, 0.6, 125.0, more_explicit)
    }),
    ("outer-solar-system", outer_solar_system),
    ("henon-heiles", henon_heiles),
    ("double-pendulum", double_pendulum),
    ("fput-chain", fput_chain),
];

#[cfg(feature = "all-scenes")]
const MORE: &[Scene] = crate::more::SCENES;
#[cfg(not(feature = "all-scenes"))]
const MORE: &[Scene] = &[];

/// All scenes of this build, in the order of the report.
pub fn scenes() -> impl Iterator<Item = &'static Scene> {
    OF_THE_README.iter().chain(MORE)
}

/// The Kepler problem in the plane.
pub type KeplerProblem = Problem<SVector<f64, 2>, kepler::Kepler>;

/// The Kepler problem, with the methods that `more` adds to those of every separable problem.
pub fn kepler(
    study: Study,
    eccentricity: f64,
    end: f64,
    more: impl FnOnce(KeplerProblem) -> KeplerProblem,
) -> Result<Study, Error> {
    let start = kepler::start(eccentricity);
    // The error bound of the closed form; away from the pericentre the error is much smaller.
    let reference = Reference::known(
        kepler::exact(eccentricity, end),
        "closed form, Kepler's equation",
        2.0 * f64::EPSILON / (1.0 - eccentricity),
    );
    let name = format!("Kepler, e = {eccentricity}");
    let problem = Problem::new(name, kepler::Kepler, start.clone(), reference, TAU / 8.0)
        .described("H = |p|²/2 − 1/|q|, from the pericentre (GNI I.2)")
        .needing(
            "nothing: separable, quadratic kinetic energy, not stiff; hard where e comes near 1",
        )
        .conserving("angular momentum", kepler::angular_momentum);
    Ok(study.problem(separable::<_, 2, 4>(
        more(problem),
        kepler::Kepler,
        &start,
        end,
        TAU / 8.0,
        implicit,
    )))
}

fn henon_heiles(study: Study) -> Result<Study, Error> {
    let (start, end) = (henon_heiles::start(), 1000.0);
    let system = henon_heiles::HenonHeiles;
    let reference = Reference::computed(Gauss8, system, &start, end, 0.125)?;
    let problem = Problem::new(
        "Hénon–Heiles, E = 1/8",
        system,
        start.clone(),
        reference,
        2.0,
    )
    .described("H = (|p|² + |q|²)/2 + q₁²q₂ − q₂³/3, a star in a galaxy (GNI I.3)")
    .needing("nothing: separable, quadratic kinetic energy, not stiff");
    Ok(study.problem(separable::<_, 2, 4>(
        problem, system, &start, end, 2.0, implicit,
    )))
}

fn outer_solar_system(study: Study) -> Result<Study, Error> {
    let (start, end) = (outer_solar_system::start(), 200_000.0);
    let system = outer_solar_system::OuterSolarSystem;
    let reference = Reference::computed(Gauss8, system, &start, end, 150.0)?;
    let problem = Problem::new(
        "Outer solar system",
        system,
        start.clone(),
        reference,
        1600.0,
    )
    .described("The Sun and five planets over 200 000 days (GNI I.2.4)")
    .needing("nothing: separable, quadratic kinetic energy, not stiff, no close encounters")
    .conserving("angular momentum in z", |state| {
        outer_solar_system::angular_momentum(state)[2]
    })
    .conserving("momentum in x", |state| {
        outer_solar_system::total_momentum(state)[0]
    });
    Ok(study.problem(separable::<_, 18, 36>(
        problem, system, &start, end, 1600.0, implicit,
    )))
}

fn fput_chain(study: Study) -> Result<Study, Error> {
    const N: usize = fput_chain::PARTICLES;
    let (start, end) = (fput_chain::start(N), 100.0);
    let system = fput_chain::system();
    let reference = Reference::computed(Gauss8, system, &start, end, 0.2)?;
    let problem = Problem::new(
        "FPUT chain, N = 1024",
        system,
        start.clone(),
        reference,
        2.0,
    )
    .described(FPUT_CHAIN)
    .needing("nothing: separable, quadratic kinetic energy, not stiff; many components");
    let problem = implicit(explicit(problem));
    let problem = with_peers::<_, _, N, { 2 * N }>(problem, &system, &start, end, 2.0);
    Ok(study.problem(with_forest_ruth::<_, _, N, { 2 * N }>(
        problem, &system, &start, end, 2.0,
    )))
}

pub const FPUT_CHAIN: &str = "H = Σ p²/2 + Σ (d²/2 + d⁴/4), d the differences of neighbours, fixed ends (Fermi, Pasta, Ulam & Tsingou 1955)";

fn double_pendulum(study: Study) -> Result<Study, Error> {
    let (start, end) = (double_pendulum::start(), 100.0);
    let system = double_pendulum::DoublePendulum;
    let reference = Reference::computed(Gauss8, system, &start, end, 0.025)?;
    let problem = Problem::new("Double pendulum", system, start.clone(), reference, 0.5)
        .described(
            "H = (p₁² + 2p₂² − 2p₁p₂ cos δ)/(2(1 + sin² δ)) − g(2 cos q₁ + cos q₂), δ = q₁ − q₂",
        )
        .needing("a method for general Hamiltonians; not separable, chaotic");
    Ok(study.problem(with_peers::<_, _, 2, 4>(
        coupled(problem),
        &system,
        &start,
        end,
        0.5,
    )))
}

/// Adds the methods and peers of a separable problem, with the set `implicit`.
pub fn separable<S, const N: usize, const M: usize>(
    problem: Problem<SVector<f64, N>, S>,
    system: S,
    start: &State<SVector<f64, N>>,
    end: f64,
    step_size: f64,
    implicit: Set<SVector<f64, N>, S>,
) -> Problem<SVector<f64, N>, S>
where
    S: System<SVector<f64, N>, Class = Separable> + Clone + 'static,
{
    let problem = implicit(explicit(problem));
    let problem = with_peers::<_, _, N, M>(problem, &system, start, end, step_size);
    with_forest_ruth::<_, _, N, M>(problem, &system, start, end, step_size)
}
