//! The scenes that the README does not show.
//!
//! A new scene needs a function here or in [`mechanics`] and a row in [`SCENES`].

mod mechanics;
mod sets;
mod variable_steps;

use std::f64::consts::TAU;

use symplectic::adaptive::{DistancePower, PairDistances};
use symplectic::{Error, Integrator, State, Vector};
use symplectic_report::{Ladder, Problem, Reference, Study};
use symplectic_tests::methods::{Gauss8, Midpoint, VelocityVerlet};
use symplectic_tests::scenes::{
    argon_crystal, charged_particle, fput_chain, fput_springs, harmonic_oscillator, henon_heiles,
    hyperbolic, kepler, nonseparable, pendulum, point_vortices, post_newtonian_kepler,
    pythagorean_three_body, sine_gordon,
};

use crate::peers::{with_forest_ruth, with_peers, with_rk4};
use crate::scenes::{FPUT_CHAIN, Scene, kepler, separable};
use crate::sets::{coupled, explicit, implicit};
use sets::newton;
use variable_steps::with_variable_steps;

/// The scenes, in the order of the report.
pub const SCENES: &[Scene] = &[
    ("kepler-0.3", |study| kepler(study, 0.3, 125.0, |same| same)),
    ("kepler-0.9", |study| {
        kepler_with_variable_steps(study, 0.9, 125.0)
    }),
    ("kepler-0.999", |study| {
        kepler_with_variable_steps(study, 0.999, 10.0)
    }),
    ("harmonic-oscillator", harmonic_oscillator),
    ("pendulum", pendulum),
    ("henon-heiles-1/12", henon_heiles_at_one_twelfth),
    ("energy-behaviour", energy_behaviour),
    ("pythagorean-three-body", pythagorean_three_body),
    ("argon-crystal", argon_crystal),
    ("sine-gordon", sine_gordon),
    ("springs-50", |study| springs(study, 50.0, 20.0, 16.0)),
    ("springs-1000", |study| springs(study, 1000.0, 2.0, 16.0)),
    ("springs-100000", |study| {
        springs(study, 1e5, 1.0 / 64.0, 256.0)
    }),
    ("fput-chain-16", short_fput_chain),
    ("fput-chain-65536", long_fput_chain),
    (
        "double-pendulum-on-rods",
        mechanics::double_pendulum_on_rods,
    ),
    ("chain-of-links", mechanics::chain_of_links),
    ("rigid-triangles", mechanics::rigid_triangles),
    ("resisted-pendulum", mechanics::resisted_pendulum),
    ("heavy-top", mechanics::heavy_top),
    ("damped-particle", mechanics::damped_particle),
    ("damped-energy", mechanics::damped_energy),
    ("damped-oscillator", mechanics::damped_oscillator),
    ("rolling-disk", mechanics::rolling_disk),
    ("skate", mechanics::skate),
    (
        "nonholonomic-oscillator",
        mechanics::nonholonomic_oscillator,
    ),
    ("sleigh", mechanics::sleigh),
    ("circuit", mechanics::circuit),
    ("nonseparable", nonseparable),
    ("charged-particle", charged_particle),
    ("post-newtonian-kepler", post_newtonian_kepler),
    ("point-vortices", point_vortices),
    ("hyperbolic", hyperbolic),
];

fn kepler_with_variable_steps(study: Study, eccentricity: f64, end: f64) -> Result<Study, Error> {
    let start = kepler::start(eccentricity);
    kepler(study, eccentricity, end, |problem| {
        let (run, monitor) = ((&start, end), DistancePower(1.5));
        with_variable_steps::<_, _, 2, 3>(problem, &kepler::Kepler, monitor, run, 1.0)
    })
}

/// A reference state recorded with the scene, computed with 70 digits.
fn recorded<V: Vector<Scalar = f64>>(state: Option<State<V>>) -> Reference<V> {
    Reference::known(
        state.expect("a recorded time"),
        "computed with 70 digits: `cargo run --release -p symplectic-tests --example references`",
        f64::EPSILON,
    )
}

/// `largest` is hω for the first step size.
fn springs(study: Study, omega: f64, end: f64, largest: f64) -> Result<Study, Error> {
    let start = fput_springs::start(omega);
    let system = fput_springs::FputSprings { omega };
    let reference = match fput_springs::recorded(omega, end) {
        known @ Some(_) => recorded(known),
        None => Reference::computed(Gauss8, system, &start, end, 0.5 / omega)?,
    };
    let name = format!("Stiff and soft springs, ω = {omega}");
    let first = largest / omega;
    let problem = Problem::new(name, system, start.clone(), reference, first)
        .described("Fermi–Pasta–Ulam–Tsingou, three stiff springs between soft ones (GNI I.5.1)")
        .needing(
            "nothing; stiff: an explicit method or a fixed-point iteration wants hω of order one",
        );
    let problem = newton(problem);
    Ok(study.problem(separable::<_, 6, 12>(
        problem, system, &start, end, first, implicit,
    )))
}

fn short_fput_chain(study: Study) -> Result<Study, Error> {
    let (start, end) = (fput_chain::start(16), 100.0);
    let system = fput_chain::system();
    let reference = recorded(fput_chain::recorded(16, end));
    let problem = Problem::new("FPUT chain, N = 16", system, start.clone(), reference, 2.0)
        .described(FPUT_CHAIN)
        .needing("nothing: separable, quadratic kinetic energy, not stiff");
    let problem = implicit(explicit(problem));
    let problem = with_peers::<_, _, 16, 32>(problem, &system, &start, end, 2.0);
    Ok(study.problem(with_forest_ruth::<_, _, 16, 32>(
        problem, &system, &start, end, 2.0,
    )))
}

fn long_fput_chain(study: Study) -> Result<Study, Error> {
    const N: usize = 65_536;
    let (start, end) = (fput_chain::start(N), 1.0);
    let system = fput_chain::system();
    let reference = Reference::computed(Gauss8, system, &start, end, 0.2)?;
    let problem = Problem::new("FPUT chain, N = 65536", system, start.clone(), reference, 1.0)
        .described(FPUT_CHAIN)
        .needing("nothing: separable, quadratic kinetic energy, not stiff; more components than the nearest memory holds");
    let ladder = Ladder::Descend { first: 1.0 };
    // Only RK4: the other crates need arrays of a fixed length on the stack, which is too small.
    Ok(study.problem(with_rk4(
        implicit(explicit(problem)),
        &system,
        &start,
        end,
        ladder,
    )))
}

fn nonseparable(study: Study) -> Result<Study, Error> {
    let (start, end) = (nonseparable::start(), 100.0);
    let system = nonseparable::Nonseparable;
    let reference = Reference::computed(Gauss8, system, &start, end, 0.025)?;
    let problem = Problem::new(
        "H = (q² + 1)(p² + 1)/2",
        system,
        start.clone(),
        reference,
        0.5,
    )
    .described("A Hamiltonian that is not separable (Tao, Phys. Rev. E 94, 2016)")
    .needing("a method for general Hamiltonians; not separable");
    Ok(study.problem(with_peers::<_, _, 1, 2>(
        coupled(problem),
        &system,
        &start,
        end,
        0.5,
    )))
}

fn harmonic_oscillator(study: Study) -> Result<Study, Error> {
    let (start, end) = (harmonic_oscillator::start(), 100.0);
    let system = harmonic_oscillator::HarmonicOscillator { omega: 1.0 };
    let exact = harmonic_oscillator::exact(1.0, end);
    let reference = Reference::known(exact, "closed form", f64::EPSILON);
    let problem = Problem::new("Harmonic oscillator", system, start.clone(), reference, 4.0)
        .described("H = (p² + q²)/2")
        .needing("nothing: separable, quadratic kinetic energy, not stiff");
    Ok(study.problem(separable::<_, 1, 2>(
        problem, system, &start, end, 4.0, implicit,
    )))
}

fn pendulum(study: Study) -> Result<Study, Error> {
    let (momentum, end) = (1.5, 100.0);
    let (system, start) = (pendulum::Pendulum, pendulum::start(momentum));
    let exact = pendulum::exact(momentum, end);
    let reference = Reference::known(exact, "closed form, elliptic functions", 1e-14);
    let problem = Problem::new("Pendulum", system, start.clone(), reference, 2.0)
        .described("H = p²/2 − cos q, swinging far (GNI I.1.1)")
        .needing("nothing: separable, quadratic kinetic energy, not stiff");
    Ok(study.problem(separable::<_, 1, 2>(
        problem, system, &start, end, 2.0, implicit,
    )))
}

fn henon_heiles_at_one_twelfth(study: Study) -> Result<Study, Error> {
    let (start, end) = (henon_heiles::start_at_one_twelfth(), 1e4);
    let system = henon_heiles::HenonHeiles;
    let reference = recorded(henon_heiles::recorded_at_one_twelfth(end));
    let problem = Problem::new(
        "Hénon–Heiles, E = 1/12",
        system,
        start.clone(),
        reference,
        2.0,
    )
    .described("H = (|p|² + |q|²)/2 + q₁²q₂ − q₂³/3, on an orbit that is not chaotic (GNI I.3)")
    .needing("nothing: separable, quadratic kinetic energy, not stiff");
    Ok(study.problem(separable::<_, 2, 4>(
        problem, system, &start, end, 2.0, implicit,
    )))
}

fn pythagorean_three_body(study: Study) -> Result<Study, Error> {
    let (start, end) = (pythagorean_three_body::start(), 70.0);
    let system = pythagorean_three_body::PythagoreanThreeBody;
    let reference = recorded(pythagorean_three_body::recorded(end));
    let first = 1.0 / 64.0;
    let problem = Problem::new(
        "Pythagorean three-body",
        system,
        start.clone(),
        reference,
        first,
    )
    .described(
        "Masses 3, 4, 5 from rest in the corners of a triangle with these sides (Burrau 1913)",
    )
    .needing("steps that follow encounters as near as 4·10⁻⁴; separable, quadratic kinetic energy");
    let monitor = PairDistances {
        dimensions: 2,
        sharpness: 2,
        exponent: 1.5,
    };
    let run = (&start, end);
    let problem = with_variable_steps::<_, _, 6, 7>(problem, &system, monitor, run, 0.25);
    Ok(study.problem(separable::<_, 6, 12>(
        problem, system, &start, end, first, implicit,
    )))
}

fn argon_crystal(study: Study) -> Result<Study, Error> {
    let (start, end, first) = (argon_crystal::start(), 0.02, 4e-4);
    let system = argon_crystal::ArgonCrystal;
    let reference = recorded(argon_crystal::recorded(end));
    let problem = Problem::new(
        "Frozen argon crystal",
        system,
        start.clone(),
        reference,
        first,
    )
    .described("Seven atoms with a Lennard-Jones potential in the plane (GNI I.4)")
    .needing("nothing: separable, quadratic kinetic energy, not stiff");
    Ok(study.problem(separable::<_, 14, 28>(
        problem, system, &start, end, first, implicit,
    )))
}

fn sine_gordon(study: Study) -> Result<Study, Error> {
    const N: usize = sine_gordon::PENDULUMS;
    let (start, end) = (sine_gordon::start(), 10.0);
    let system = sine_gordon::system();
    let reference = recorded(sine_gordon::recorded(end));
    let problem = Problem::new(
        "Sine-Gordon lattice, N = 64",
        system,
        start.clone(),
        reference,
        0.5,
    )
    .described("H = Σ (p²/2 + 8(q_{i+1} − q_i)² + 1 − cos q), a ring with a breather (Duncan 1997)")
    .needing("nothing: separable, quadratic kinetic energy, not stiff");
    let problem = implicit(explicit(problem));
    Ok(study.problem(with_peers::<_, _, N, { 2 * N }>(
        problem, &system, &start, end, 0.5,
    )))
}

fn charged_particle(study: Study) -> Result<Study, Error> {
    let (start, end) = (charged_particle::start(), 100.0);
    let system = charged_particle::ChargedParticle;
    let reference = recorded(charged_particle::recorded(end));
    let problem = Problem::new("Charged particle", system, start.clone(), reference, 0.5)
        .described("H = |p − A(q)|²/2 + U(q) with B = (0, 0, r) (Hairer & Lubich 2018)")
        .needing("a method for general Hamiltonians; not separable");
    let problem = coupled(problem);
    Ok(study.problem(with_peers::<_, _, 3, 6>(problem, &system, &start, end, 0.5)))
}

fn post_newtonian_kepler(study: Study) -> Result<Study, Error> {
    let (start, end, first) = (post_newtonian_kepler::start(), 125.0, TAU / 8.0);
    let system = post_newtonian_kepler::EQUAL_MASSES;
    let reference = recorded(post_newtonian_kepler::recorded(end));
    let problem = Problem::new(
        "Post-Newtonian Kepler",
        system,
        start.clone(),
        reference,
        first,
    )
    .described("Two equal masses to the first order in 1/c² = 10⁻³ (Damour & Schäfer 1988)")
    .needing("a method for general Hamiltonians; not separable");
    let problem = coupled(problem);
    Ok(study.problem(with_peers::<_, _, 2, 4>(
        problem, &system, &start, end, first,
    )))
}

fn point_vortices(study: Study) -> Result<Study, Error> {
    let (start, end) = (point_vortices::start(), 50.0);
    let system = point_vortices::FOUR;
    let reference = recorded(point_vortices::recorded(end));
    let problem = Problem::new("Four point vortices", system, start.clone(), reference, 0.5)
        .described("H = −Σ Γ_i Γ_j ln |z_i − z_j|: half of the plane is the momentum (Newton 2001)")
        .needing("a method for general Hamiltonians; not separable, degenerate, chaotic");
    let problem = coupled(problem);
    Ok(study.problem(with_peers::<_, _, 4, 8>(problem, &system, &start, end, 0.5)))
}

fn hyperbolic(study: Study) -> Result<Study, Error> {
    let (start, end) = (hyperbolic::start(), 10.0);
    let system = hyperbolic::Hyperbolic;
    let exact = hyperbolic::exact(end);
    let reference = Reference::known(exact, "closed form", 4.0 * f64::EPSILON);
    let problem = Problem::new("H = qp", system, start.clone(), reference, 1.0)
        .described("A Hamiltonian without a Lagrangian (Leok & Zhang 2011)")
        .needing("a method for general Hamiltonians; not separable, degenerate");
    let problem = coupled(problem);
    Ok(study.problem(with_peers::<_, _, 1, 2>(problem, &system, &start, end, 1.0)))
}

/// Marsden & West, Figure 1: the energy of a conservative system over a long time.
fn energy_behaviour(study: Study) -> Result<Study, Error> {
    let (start, end, size) = (henon_heiles::start(), 1000.0, 0.4);
    let system = henon_heiles::HenonHeiles;
    let reference = Reference::computed(Gauss8, system, &start, end, 0.125)?;
    let ladder = Ladder::Halve {
        first: size,
        halvings: 3,
    };
    let problem = Problem::new("Energy in the long run", system, start.clone(), reference, size)
        .described("Variational methods of order 2 (Störmer–Verlet is Newmark with β = 0, γ = 1/2) against the classical Runge–Kutta method of order 4 on the system of Hénon & Heiles, as in Marsden & West, Figure 1")
        .needing("nothing")
        .on_ladder(ladder.clone())
        .traced_at(size)
        .run("Störmer–Verlet", |system, start, h| Integrator::plain(VelocityVerlet, system, start, h))
        .run("Midpoint", |system, start, h| Integrator::plain(Midpoint, system, start, h));
    Ok(study.problem(with_rk4(problem, &system, &start, end, ladder)))
}
