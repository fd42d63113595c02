//! The scenes of the report, one function each: the system, the reference, the largest step, and the sets of methods.
//!
//! A new scene needs a function here and a row in [`SCENES`].

use std::f64::consts::TAU;

use symplectic::adaptive::{DistancePower, PairDistances};
use symplectic::nalgebra::SVector;
use symplectic::variational::{DiracIntegrator, DiracRule};
use symplectic::{Error, Integrator, Separable, State, System, Vector};
use symplectic_report::{Finish, Ladder, Observe, Problem, Reference, Study};
use symplectic_tests::methods::{
    Gauss6, Gauss8, Midpoint, StoermerVerlet, Suzuki4, VelocityVerlet,
};
use symplectic_tests::scenes::{
    argon_crystal, charged_particle, circuit, damped_particle, double_pendulum, fput_chain,
    fput_springs, harmonic_oscillator, henon_heiles, hyperbolic, kepler, nonholonomic_oscillator,
    nonseparable, outer_solar_system, pendulum, point_vortices, post_newtonian_kepler,
    pythagorean_three_body, rolling_disk, sine_gordon, skate, sleigh,
};

use crate::peers::{with_forest_ruth, with_peers, with_rk4};
use crate::sets::{
    Set, constrained, coupled, explicit, implicit, more_explicit, newton, nonholonomic,
};
use crate::variable_steps::with_variable_steps;

/// A scene: its name on the command line, and the function that adds it to a study.
pub type Scene = (&'static str, fn(Study) -> Result<Study, Error>);

/// All scenes, in the order of the report.
pub const SCENES: &[Scene] = &[
    ("kepler-0.6", |study| {
        kepler(study, 0.6, 125.0, &[more_explicit])
    }),
    ("kepler-0.3", |study| kepler(study, 0.3, 125.0, &[])),
    ("kepler-0.9", |study| kepler(study, 0.9, 125.0, &[])),
    ("kepler-0.999", |study| kepler(study, 0.999, 10.0, &[])),
    ("harmonic-oscillator", harmonic_oscillator),
    ("pendulum", pendulum),
    ("henon-heiles", henon_heiles),
    ("henon-heiles-1/12", henon_heiles_at_one_twelfth),
    ("energy-behaviour", energy_behaviour),
    ("outer-solar-system", outer_solar_system),
    ("pythagorean-three-body", pythagorean_three_body),
    ("argon-crystal", argon_crystal),
    ("sine-gordon", sine_gordon),
    ("springs-50", |study| springs(study, 50.0, 20.0, 16.0)),
    ("springs-1000", |study| springs(study, 1000.0, 2.0, 16.0)),
    ("springs-100000", |study| {
        springs(study, 1e5, 1.0 / 64.0, 256.0)
    }),
    ("fput-chain", fput_chain),
    ("fput-chain-16", short_fput_chain),
    ("fput-chain-65536", long_fput_chain),
    ("double-pendulum", double_pendulum),
    ("double-pendulum-on-rods", double_pendulum_on_rods),
    ("damped-particle", damped_particle),
    ("damped-energy", damped_energy),
    ("rolling-disk", rolling_disk),
    ("skate", skate),
    ("nonholonomic-oscillator", nonholonomic_oscillator),
    ("sleigh", sleigh),
    ("circuit", circuit),
    ("nonseparable", nonseparable),
    ("charged-particle", charged_particle),
    ("post-newtonian-kepler", post_newtonian_kepler),
    ("point-vortices", point_vortices),
    ("hyperbolic", hyperbolic),
];

/// A reference state recorded with the scene, computed with 70 digits.
fn recorded<V: Vector<Scalar = f64>>(state: Option<State<V>>) -> Reference<V> {
    Reference::known(
        state.expect("a recorded time"),
        "computed with 70 digits: `cargo run --release --example references`",
        f64::EPSILON,
    )
}

fn kepler(
    study: Study,
    eccentricity: f64,
    end: f64,
    sets: &[Set<SVector<f64, 2>, kepler::Kepler>],
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
    let problem = sets.iter().fold(problem, |problem, set| set(problem));
    let problem = if eccentricity > 0.8 {
        let (run, monitor) = ((&start, end), DistancePower(1.5));
        with_variable_steps::<_, _, 2, 3>(problem, &kepler::Kepler, monitor, run, 1.0)
    } else {
        problem
    };
    Ok(study.problem(separable::<_, 2, 4>(
        problem,
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

const FPUT_CHAIN: &str = "H = Σ p²/2 + Σ (d²/2 + d⁴/4), d the differences of neighbours, fixed ends (Fermi, Pasta, Ulam & Tsingou 1955)";

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

fn double_pendulum_on_rods(study: Study) -> Result<Study, Error> {
    let (angles, end) = (double_pendulum::start(), 10.0);
    let known = Reference::computed(Gauss8, double_pendulum::DoublePendulum, &angles, end, 0.025)?;
    let reference = Reference::known(
        double_pendulum::on_rods(&known.end),
        format!("in angles: {}", known.origin),
        known.uncertainty.max(4.0 * f64::EPSILON),
    );
    let problem = Problem::new(
        "Double pendulum on rods",
        double_pendulum::OnRods::new(),
        double_pendulum::on_rods(&angles),
        reference,
        0.25,
    )
    .described("H = |p|²/2 + g(y₁ + y₂), two masses on rods of length 1: two holonomic constraints")
    .needing("a method that is `constrained`");
    Ok(study.problem(constrained(problem)))
}

fn damped_particle(study: Study) -> Result<Study, Error> {
    let (start, end) = (damped_particle::start(), 100.0);
    let system = damped_particle::WithFriction::new();
    let reference = Reference::computed(Gauss8, system, &start, end, 0.025)?;
    let problem = Problem::new("Damped particle", system, start.clone(), reference, 0.5)
        .described("H = |p|²/2 + |q|²(|q|² − 1)² and the force −p/1000 (Marsden & West, Figure 2)")
        .needing("a method for general Hamiltonians: the force depends on the momentum");
    Ok(study.problem(with_peers::<_, _, 2, 4>(
        coupled(problem),
        &system,
        &start,
        end,
        0.5,
    )))
}

fn damped_energy(study: Study) -> Result<Study, Error> {
    let (start, end, size) = (damped_particle::start(), 1500.0, 0.1);
    let system = damped_particle::WithFriction::new();
    let reference = Reference::computed(Gauss8, system, &start, end, 0.05)?;
    let ladder = Ladder::Halve {
        first: size,
        halvings: 2,
    };
    let problem = Problem::new("Energy with friction", system, start.clone(), reference, size)
        .described("The damped particle in the long run: the energy that friction takes, by variational methods of order 2 with forces, by RK4 and by Gauss 6, which is the true one to the eye, as in Marsden & West, Figure 2")
        .needing("a method for general Hamiltonians: the force depends on the momentum")
        .on_ladder(ladder.clone())
        .traced_at(size)
        .run("Midpoint", |system, start, h| Integrator::plain(Midpoint, system, start, h))
        .run("Störmer–Verlet, implicit", |system, start, h| Integrator::plain(StoermerVerlet, system, start, h))
        .run("Gauss 6", |system, start, h| Integrator::plain(Gauss6, system, start, h));
    Ok(study.problem(with_rk4(problem, &system, &start, end, ladder)))
}

fn rolling_disk(study: Study) -> Result<Study, Error> {
    let origin = "in closed form: it goes round on a circle";
    let reference = Reference::known(rolling_disk::exact(20.0), origin, 4.0 * f64::EPSILON);
    let (system, start) = (rolling_disk::Disk::new(), rolling_disk::start());
    let problem = Problem::new("Rolling disk", system, start, reference, 0.5)
        .described("H = (px² + py²)/2 + pθ² + 2pφ², x' = θ' cos φ, y' = θ' sin φ: a disk that rolls upright, two non-holonomic constraints")
        .needing("a method that is `nonholonomic`");
    Ok(study.problem(nonholonomic(problem)))
}

fn skate(study: Study) -> Result<Study, Error> {
    let origin = "in closed form: a cycloid";
    let reference = Reference::known(skate::exact(20.0), origin, 4.0 * f64::EPSILON);
    let problem = Problem::new(
        "Skate on a slope",
        skate::Skate::new(),
        skate::start(),
        reference,
        0.25,
    )
    .described(
        "H = |p|²/2 − 2x, x' sin a = y' cos a: a skate on a slope, one non-holonomic constraint",
    )
    .needing("a method that is `nonholonomic`");
    Ok(study.problem(nonholonomic(problem)))
}

fn nonholonomic_oscillator(study: Study) -> Result<Study, Error> {
    let origin = "integrals of closed forms";
    let reference = Reference::known(nonholonomic_oscillator::exact(20.0), origin, 1e-13);
    let system = nonholonomic_oscillator::Oscillator;
    let start = nonholonomic_oscillator::start();
    let problem = Problem::new("Non-holonomic oscillator", system, start, reference, 0.5)
        .described("H = (|p|² + x² + y²)/2, z' = y x': one non-holonomic constraint")
        .needing("a method that is `nonholonomic`");
    Ok(study.problem(nonholonomic(problem)))
}

fn sleigh(study: Study) -> Result<Study, Error> {
    let origin = "integrals of closed forms";
    let reference = Reference::known(sleigh::exact(20.0), origin, 1e-13);
    let problem = Problem::new(
        "Chaplygin's sleigh",
        sleigh::Sleigh::new(),
        sleigh::start(),
        reference,
        0.25,
    )
    .described("A body on a plane that glides on a blade, x' sin a = y' cos a; the kinetic energy depends on a")
    .needing("a method that is `nonholonomic`; not separable");
    Ok(study.problem(nonholonomic(problem)))
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

fn circuit(study: Study) -> Result<Study, Error> {
    let (start, end, first) = (circuit::start(), 20.0, 0.5);
    let reference = Reference::known(circuit::exact(end), "closed form", 16.0 * f64::EPSILON);
    let system = circuit::SolvedByHand;
    let problem = Problem::new("Circuit", system, start.clone(), reference, first)
        .described("L = ℓq₀'²/2 − Σ q²/2C and Kirchhoff's laws for the currents: an inductor and three capacitors, a degenerate Lagrangian (Yoshimura & Marsden 2006). The peers have the laws solved by hand.")
        .needing("Dirac mechanics");
    let methods = [
        ("Trapezoid", DiracRule::Trapezoid, false),
        ("Midpoint", DiracRule::Midpoint, false),
        ("Trapezoid, order 4", DiracRule::Trapezoid, true),
    ];
    let problem = methods
        .into_iter()
        .fold(problem, |problem, (name, rule, composed)| {
            let ladder = Ladder::Descend { first };
            problem.peer(name, ladder, move |size, observe| {
                circuit_run(rule, composed, end, size, observe).map_err(|error| error.to_string())
            })
        });
    Ok(study.problem(with_peers::<_, _, 4, 8>(
        problem, &system, &start, end, first,
    )))
}

fn circuit_run(
    rule: DiracRule,
    composed: bool,
    end: f64,
    size: f64,
    observe: Option<Observe<'_, SVector<f64, 4>>>,
) -> Result<Finish<SVector<f64, 4>>, Error> {
    let (system, start) = (circuit::Circuit::default(), circuit::start());
    // Equal steps, the last of which ends at `end`.
    let steps = (end / size).ceil();
    let size = end / steps;
    let mut run = if composed {
        DiracIntegrator::composed(Suzuki4, rule, system, start, size)?
    } else {
        DiracIntegrator::new(rule, system, start, size)?
    };
    match observe {
        Some(observe) => {
            for _ in 0..steps as u64 {
                observe(run.step()?);
            }
        }
        None => drop(run.integrate_to(end)?),
    }
    let evaluations = run.system().evaluations.get();
    Ok(Finish::explicit(
        run.state().clone(),
        Some(run.steps()),
        evaluations,
    ))
}

/// Adds the methods and peers of a separable problem, with the set `implicit`.
fn separable<S, const N: usize, const M: usize>(
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
