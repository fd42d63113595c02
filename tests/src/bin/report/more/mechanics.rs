//! The scenes with constraints, friction and forces, one function each.

use symplectic::nalgebra::{Matrix3, SVector};
use symplectic::proved::StoermerVerletSteps;
use symplectic::rotation::{self, RotationSteps};
use symplectic::variational::{self, DiracRule, DiracSteps};
use symplectic::{Error, Integrator};
use symplectic_report::{Finish, Ladder, Observe, Problem, Reference, Study};
use symplectic_tests::methods::{
    Gauss6, Gauss8, Lobatto5, Midpoint, Rattle6, StoermerVerlet, Suzuki4,
};
use symplectic_tests::scenes::{
    chain_of_links, circuit, damped_oscillator, damped_particle, double_pendulum, heavy_top,
    nonholonomic_oscillator, resisted_pendulum, rigid_triangles, rolling_disk, skate, sleigh,
};

use super::sets::{constrained, damped, nonholonomic};
use crate::peers::{with_peers, with_rk4};
use crate::sets::coupled;

pub fn double_pendulum_on_rods(study: Study) -> Result<Study, Error> {
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

pub fn damped_particle(study: Study) -> Result<Study, Error> {
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

pub fn damped_energy(study: Study) -> Result<Study, Error> {
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

pub fn rolling_disk(study: Study) -> Result<Study, Error> {
    let origin = "in closed form: it goes round on a circle";
    let reference = Reference::known(rolling_disk::exact(20.0), origin, 4.0 * f64::EPSILON);
    let (system, start) = (rolling_disk::Disk::new(), rolling_disk::start());
    let problem = Problem::new("Rolling disk", system, start, reference, 0.5)
        .described("H = (px² + py²)/2 + pθ² + 2pφ², x' = θ' cos φ, y' = θ' sin φ: a disk that rolls upright, two non-holonomic constraints")
        .needing("a method that is `nonholonomic`");
    Ok(study.problem(nonholonomic(problem)))
}

pub fn skate(study: Study) -> Result<Study, Error> {
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

pub fn nonholonomic_oscillator(study: Study) -> Result<Study, Error> {
    let origin = "integrals of closed forms";
    let reference = Reference::known(nonholonomic_oscillator::exact(20.0), origin, 1e-13);
    let system = nonholonomic_oscillator::Oscillator;
    let start = nonholonomic_oscillator::start();
    let problem = Problem::new("Non-holonomic oscillator", system, start, reference, 0.5)
        .described("H = (|p|² + x² + y²)/2, z' = y x': one non-holonomic constraint")
        .needing("a method that is `nonholonomic`");
    Ok(study.problem(nonholonomic(problem)))
}

pub fn sleigh(study: Study) -> Result<Study, Error> {
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

pub fn circuit(study: Study) -> Result<Study, Error> {
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
) -> Result<Finish<SVector<f64, 4>>, variational::Error> {
    let (system, start) = (circuit::Circuit::default(), circuit::start());
    // Equal steps, the last of which ends at `end`.
    let steps = (end / size).ceil();
    let size = end / steps;
    let mut run = if composed {
        DiracSteps::composed(Suzuki4, rule, system, start, size)?
    } else {
        DiracSteps::run(rule, system, start, size)?
    };
    match observe {
        Some(observe) => {
            for _ in 0..steps as u64 {
                observe(run.step()?);
            }
        }
        None => drop(run.integrate_to(end)?),
    }
    let evaluations = run.stepper().system().evaluations.get();
    Ok(Finish::explicit(
        run.state().clone(),
        Some(run.steps()),
        evaluations,
    ))
}

pub fn chain_of_links(study: Study) -> Result<Study, Error> {
    let (system, start) = (chain_of_links::system(), chain_of_links::start());
    let reference = Reference::computed(Lobatto5, system.clone(), &start, 4.0, 1.0 / 64.0)?;
    let problem = Problem::new("Chain of 32 links", system, start, reference, 0.25)
        .described(
            "H = Σ (|p|²/2 + y), a chain of links of length 1 that falls: 32 holonomic constraints",
        )
        .needing("a method that is `constrained`");
    Ok(study.problem(constrained(problem)))
}

pub fn rigid_triangles(study: Study) -> Result<Study, Error> {
    let origin = "in closed form: they rotate uniformly and swing";
    let reference = Reference::known(rigid_triangles::exact(10.0), origin, 8.0 * f64::EPSILON);
    let (system, start) = (rigid_triangles::system(), rigid_triangles::start());
    let problem = Problem::new("Rigid triangles", system, start, reference, 0.25)
        .described("Sixteen molecules of three masses on three rods in a harmonic trap: 48 holonomic constraints")
        .needing("a method that is `constrained`");
    Ok(study.problem(constrained(problem)))
}

pub fn resisted_pendulum(study: Study) -> Result<Study, Error> {
    let (angles, end) = (resisted_pendulum::start_in_angles(), 20.0);
    let in_angles = resisted_pendulum::InAngles::new();
    let known = Reference::computed(Gauss8, in_angles, &angles, end, 0.025)?;
    let reference = Reference::known(
        resisted_pendulum::on_a_rod(&known.end),
        format!("in angles: {}", known.origin),
        known.uncertainty.max(4.0 * f64::EPSILON),
    );
    let system = resisted_pendulum::OnARod::new();
    let start = resisted_pendulum::on_a_rod(&angles);
    let problem = Problem::new("Resisted spherical pendulum", system, start, reference, 0.5)
        .described("H = |p|²/2 + z on the sphere |q| = 1, with the force −p/10: a holonomic constraint and friction")
        .needing("a method that is `constrained`; the force depends on the momentum");
    Ok(study.problem(constrained(problem)))
}

pub fn damped_oscillator(study: Study) -> Result<Study, Error> {
    let reference = Reference::known(
        damped_oscillator::exact(20.0),
        "closed form",
        4.0 * f64::EPSILON,
    );
    let (system, start) = (
        damped_oscillator::Oscillator::new(),
        damped_oscillator::start(),
    );
    let problem = Problem::new(
        "Damped oscillator, exact kicks",
        system,
        start,
        reference,
        2.0,
    )
    .described("H = (p² + q²)/2 with the friction −p/4 as a part of every kick, by its exact flow")
    .needing("a splitting with its order for separable Hamiltonians");
    Ok(study.problem(damped(problem)))
}

pub fn heavy_top(study: Study) -> Result<Study, Error> {
    let (angles, end, first) = (heavy_top::start_in_angles(), 10.0, 0.25);
    let in_angles = heavy_top::EulerAngles::default();
    let known = Reference::computed(Gauss8, in_angles, &angles, end, 0.025)?;
    let reference = Reference::known(
        heavy_top::in_columns(&heavy_top::from_angles(&known.end)),
        format!("in Euler angles: {}", known.origin),
        known.uncertainty.max(8.0 * f64::EPSILON),
    );
    let start = heavy_top::in_columns(&heavy_top::start());
    let problem = Problem::new("Heavy top", heavy_top::columns(), start, reference, first)
        .described("A top by the nine components of its attitude with six holonomic constraints, and on SO(3) without constraints")
        .needing("a method that is `constrained`, or an integrator on SO(3)");
    let problem = constrained(problem);
    let ladder = || Ladder::Descend { first };
    let problem = problem
        .peer("SO(3)", ladder(), move |size, observe| {
            top_run(StoermerVerlet, end, size, observe).map_err(|error| error.to_string())
        })
        .peer("SO(3), order 4", ladder(), move |size, observe| {
            top_run(Suzuki4, end, size, observe).map_err(|error| error.to_string())
        })
        .peer("SO(3), order 6", ladder(), move |size, observe| {
            top_run(Rattle6, end, size, observe).map_err(|error| error.to_string())
        });
    Ok(study.problem(problem))
}

fn top_run<M: StoermerVerletSteps>(
    method: M,
    end: f64,
    size: f64,
    observe: Option<Observe<'_, Matrix3<f64>>>,
) -> Result<Finish<Matrix3<f64>>, rotation::Error> {
    // Equal steps, the last of which ends at `end`.
    let steps = (end / size).ceil();
    let size = end / steps;
    let mut run = RotationSteps::composed(method, heavy_top::TOP, heavy_top::start(), size)?;
    match observe {
        Some(observe) => {
            for _ in 0..steps as u64 {
                observe(&heavy_top::in_columns(run.step()?));
            }
        }
        None => drop(run.integrate_to(end)?),
    }
    // One torque in each substep, of which a composition has as many as steps of Störmer–Verlet.
    let evaluations = run.steps() * M::STAGES as u64 / 2;
    Ok(Finish::explicit(
        heavy_top::in_columns(run.state()),
        Some(run.steps()),
        evaluations,
    ))
}
