//! The tangent map and the indicators of chaos.

use std::ops::ControlFlow;

use symplectic::ensemble::Ensemble;
#[cfg(feature = "serde")]
use symplectic::ensemble::EnsembleCheckpoint;
use symplectic::nalgebra::{DVector, Matrix2, SVector, Vector1, Vector2};
use symplectic::num_traits::Zero;
use symplectic::solver::ByNewton;
use symplectic::tangent::{Error, Megno, Tangent};
use symplectic::variational::{self, generating_function};
use symplectic::{
    Checkpoint, CheckpointError, Compensated, Integrator, Method, ProvedFor, Separable, State,
    System,
};

use crate::common::dual::{Dual, dual};
use crate::common::methods::{ForestRuth, Gauss4, StoermerVerlet};
use crate::systems::{HenonHeiles, Pendulums, words};

symplectic::hamiltonian! {
    /// H = p²/2 + s q²/2: an oscillator for s = 1, a saddle for s = −1.
    Linear { s }
    q: [x], p: [px];
    H = px^2/2 + s x^2/2
}

symplectic::hamiltonian! {
    /// Not separable; its oscillations are not of one period.
    Coupled
    q: [x], p: [px];
    H = (x^2 + 1) (px^2 + 1)/2
}

symplectic::hamiltonian! {
    Pendulum
    q: [a], p: [pa];
    H = pa^2/2 - cos(a)
}

symplectic::hamiltonian! {
    /// Two rows of a matrix for each of two bodies.
    Plane<N> { k: 1 }
    q: [N; 2], p: [N; 2];
    H = sum(i: |p[i]|^2/2 + |q[i]|^4/4) + sum(i < j: k |q[i] - q[j]|^2/2)
}

symplectic::hamiltonian! {
    /// A stiff spring along x, a hill along y.
    SpringAndHill
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + 50 x^2 + x^4 - y^2/2
}

type Four = SVector<f64, 4>;

fn henon_heiles(y: f64, py: f64, energy: f64) -> State<Vector2<f64>> {
    let kinetic = energy - y * y / 2.0 + y * y * y / 3.0;
    State::from_arrays(0.0, [0.0, y], [(2.0 * kinetic - py * py).sqrt(), py])
}

const STILL: HenonHeiles = HenonHeiles { amplitude: 0.0 };

/// The state has the bits of a run alone, and the displacement those of a run in dual numbers.
#[test]
fn the_displacement_is_the_derivative_of_the_step() -> Result<(), Error> {
    fn check<M: Method + Copy + ProvedFor<Separable>>(method: M) -> Result<(), Error> {
        let inner = STILL;
        let system = Tangent::new(inner);
        let begin = henon_heiles(0.1, 0.2, 0.1);
        let (dq, dp) = (Vector2::new(0.6, 0.3), Vector2::new(-0.2, 0.7));
        let start: State<Four> = system.start(&begin, (&dq, &dp))?;
        let of_duals = |values: &Vector2<f64>, slopes: &Vector2<f64>| {
            Vector2::new(dual(values[0], slopes[0]), dual(values[1], slopes[1]))
        };
        let in_duals: State<Vector2<Dual>> =
            State::new(0.0, of_duals(&begin.q, &dq), of_duals(&begin.p, &dp));
        let mut run = Integrator::new(method, system, start, 0.1)?;
        let mut alone = Integrator::new(method, inner, begin, 0.1)?;
        let mut duals = Integrator::new(method, inner, in_duals, 0.1)?;
        for _ in 0..500 {
            let found = run.step()?.clone();
            assert_eq!(words(&system.state(&found)?), words(alone.step()?));
            let expected = duals.step()?;
            let (q, p) = system.displacement(&found)?;
            for k in 0..2 {
                assert_eq!(q[k], expected.q[k].derivative);
                assert_eq!(p[k], expected.p[k].derivative);
            }
        }
        Ok(())
    }
    check(StoermerVerlet)?;
    check(ForestRuth)
}

/// The derivative of the state at the time 5 along a displacement, by central differences of two runs without a tangent system.
fn by_differences<M, S, const N: usize>(
    (method, system): (M, S),
    begin: &State<SVector<f64, N>>,
    (dq, dp): (SVector<f64, N>, SVector<f64, N>),
) -> Result<[SVector<f64, N>; 2], Error>
where
    M: Method + Copy + ProvedFor<S::Class>,
    S: System<SVector<f64, N>> + Copy,
{
    let end = |e: f64| {
        let start = State::new(begin.time, begin.q + dq * e, begin.p + dp * e);
        let mut run = Integrator::new(method, system, start, 0.05)?;
        run.integrate_to(5.0)?;
        Ok::<_, Error>((run.state().q, run.state().p))
    };
    let (above, below) = (end(1e-5)?, end(-1e-5)?);
    Ok([(above.0 - below.0) / 2e-5, (above.1 - below.1) / 2e-5])
}

fn near<const N: usize>(found: &SVector<f64, N>, expected: &SVector<f64, N>) {
    let error = (found - expected).amax();
    assert!(
        error < 1e-8 * expected.amax().max(1.0),
        "{found} {expected}"
    );
}

/// Systems that are not separable, by a fixed-point iteration and by Newton's.
#[test]
fn implicit_methods_step_displacements_of_nonseparable_systems() -> Result<(), Error> {
    let system = Tangent::new(Coupled);
    let begin = State::from_arrays(0.0, [0.4], [0.3]);
    let ends = [(1.0, 0.0), (0.3, -2.0)].map(|(dq, dp)| {
        let displacement = (Vector1::new(dq), Vector1::new(dp));
        let start: State<Vector2<f64>> =
            system.start(&begin, (&displacement.0, &displacement.1))?;
        let mut run = Integrator::new(Gauss4, system, start.clone(), 0.05)?;
        // DH·δ is conserved.
        let energy = run.energy().expect("K is known");
        run.integrate_to(5.0)?;
        assert!((run.energy().expect("K is known") - energy).abs() < 1e-12);
        let mut newton = Integrator::new(Gauss4, system, start, 0.05)?.by_newton();
        newton.integrate_to(5.0)?;
        let (q, p) = system.displacement(newton.state())?;
        let [expected_q, expected_p] = by_differences((Gauss4, Coupled), &begin, displacement)?;
        near(&q, &expected_q);
        near(&p, &expected_p);
        let (q, p) = system.displacement(run.state())?;
        near(&q, &expected_q);
        near(&p, &expected_p);
        Ok::<_, Error>((q[0], p[0]))
    });
    let [a, b] = ends;
    let ((q, p), (other_q, other_p)) = (a?, b?);
    // The symplectic product is that of the start.
    assert!((q * other_p - p * other_q + 2.0).abs() < 1e-13);
    Ok(())
}

/// Newton's iteration needs as many iterations as alone, however long the displacement is: the tangent system is Hamiltonian.
#[test]
fn newton_has_the_right_matrix() -> Result<(), Error> {
    let system = Tangent::new(Coupled);
    let begin = State::from_arrays(0.0, [0.4], [0.3]);
    let mut alone = Integrator::new(Gauss4, Coupled, begin.clone(), 0.2)?.by_newton();
    alone.take_steps(50)?;
    for length in [1e-3, 1.0, 1e3] {
        let displacement = (&Vector1::new(length), &Vector1::new(-length));
        let start: State<Vector2<f64>> = system.start(&begin, displacement)?;
        let mut run = Integrator::new(Gauss4, system, start, 0.2)?.by_newton();
        run.take_steps(50)?;
        let [found, expected] = [run.statistics(), alone.statistics()].map(|s| s.iterations as f64);
        assert!(found < 1.5 * expected, "{length}: {found} {expected}");
    }
    Ok(())
}

/// The derivatives of the generating function are the momentum at the start and the position at the end.
#[test]
fn the_generating_function_is_that_of_the_step() -> Result<(), variational::Error> {
    let system = Tangent::new(Coupled);
    let (q0, p1) = (Vector2::new(0.4, 1.0), Vector2::new(0.5, 0.3));
    let at = |q0: &Vector2<f64>, p1: &Vector2<f64>| {
        generating_function(Gauss4, &system, 0.0, q0, p1, 0.1)
    };
    let found = at(&q0, &p1)?;
    for k in 0..2 {
        let mut e = Vector2::zeros();
        e[k] = 1e-5;
        let by_q = (at(&(q0 + e), &p1)?.value - at(&(q0 - e), &p1)?.value) / 2e-5;
        let by_p = (at(&q0, &(p1 + e))?.value - at(&q0, &(p1 - e))?.value) / 2e-5;
        assert!((by_q - found.p0[k]).abs() < 1e-9, "{by_q} {}", found.p0[k]);
        assert!((by_p - found.q1[k]).abs() < 1e-9, "{by_p} {}", found.q1[k]);
    }
    Ok(())
}

/// With compensated sums an implicit method keeps the orbit beside a displacement that is longer by ten orders of magnitude.
#[test]
fn a_long_displacement_does_not_disturb_the_orbit() -> Result<(), Error> {
    let system = Tangent::new(SpringAndHill);
    let begin = State::from_arrays(0.0, [0.5, 0.0], [0.0, 0.0]);
    let mut alone = Integrator::new(Gauss4, SpringAndHill, begin.clone(), 0.1)?;
    alone.take_steps(200)?;
    let displacement = (&Vector2::new(0.0, 1e10), &Vector2::zero());
    let start: State<Four> = system.start(&begin, displacement)?;
    let mut run = Integrator::new(Gauss4, system, start, 0.1)?;
    run.take_steps(200)?;
    assert!((run.state().q[0] - alone.state().q[0]).abs() < 1e-11);
    // Along y it grows like cosh t.
    let growth = run.state().q[3] / 1e10 / 20_f64.cosh();
    assert!((growth - 1.0).abs() < 1e-9, "{growth}");
    Ok(())
}

/// A force that depends on time.
#[test]
fn displacements_of_driven_systems_agree_with_differences() -> Result<(), Error> {
    let driven = HenonHeiles { amplitude: 0.1 };
    let system = Tangent::new(driven);
    let begin = henon_heiles(0.1, 0.2, 0.1);
    let displacement = (Vector2::new(0.6, 0.3), Vector2::new(-0.2, 0.7));
    let start: State<Four> = system.start(&begin, (&displacement.0, &displacement.1))?;
    let mut run = Integrator::new(ForestRuth, system, start, 0.05)?;
    run.integrate_to(5.0)?;
    let (q, p) = system.displacement(run.state())?;
    let [expected_q, expected_p] = by_differences((ForestRuth, driven), &begin, displacement)?;
    near(&q, &expected_q);
    near(&p, &expected_p);
    Ok(())
}

/// Bodies in the columns of a matrix, and vectors whose dimension is known at run time.
#[test]
fn displacements_work_in_matrices_and_dynamic_vectors() -> Result<(), Error> {
    let system = Tangent::new(Plane::<2> { k: 1.0 });
    let matrix = Matrix2::new;
    let begin = State::new(0.0, matrix(1.0, 0.0, 0.2, 0.5), matrix(0.0, 0.1, 0.3, 0.0));
    let displacement = (&matrix(0.1, 0.2, 0.3, 0.4), &matrix(0.5, -0.6, 0.7, 0.8));
    let start: State<SVector<f64, 8>> = system.start(&begin, displacement)?;
    assert_eq!(system.state(&start)?, begin);
    assert_eq!(system.displacement(&start)?.1, *displacement.1);
    let mut run = Integrator::new(ForestRuth, system, start, 0.01)?;
    let before = run.energy();
    run.integrate_to(10.0)?;
    let (before, after) = (before.expect("K"), run.energy().expect("K"));
    assert!((before - after).abs() < 1e-6);

    let dynamic = Tangent::new(Pendulums);
    let vector = |numbers: &[f64]| DVector::from_column_slice(numbers);
    let begin = State::new(0.0, vector(&[0.5, 1.0]), vector(&[0.0, 0.0]));
    let start: State<DVector<f64>> =
        dynamic.start(&begin, (&vector(&[1.0, 0.0]), &vector(&[0.0, 1.0])))?;
    let mut run = Integrator::new(ForestRuth, dynamic, start, 0.1)?;
    run.integrate_to(20.0)?;
    for (place, (angle, dq, dp)) in [(0.5, 1.0, 0.0), (1.0, 0.0, 1.0)].into_iter().enumerate() {
        let system = Tangent::new(Pendulum);
        let start: State<Vector2<f64>> = system.start(
            &State::from_arrays(0.0, [angle], [0.0]),
            (&Vector1::new(dq), &Vector1::new(dp)),
        )?;
        let mut one = Integrator::new(ForestRuth, system, start, 0.1)?;
        one.integrate_to(20.0)?;
        let (found, expected) = (run.state(), one.state());
        assert!((found.q[2 + place] - expected.q[1]).abs() < 1e-12);
        assert!((found.p[place] - expected.p[0]).abs() < 1e-12);
    }
    Ok(())
}

fn megno<S>(system: S, start: State<Vector1<f64>>, end: f64, step: f64) -> Result<Megno, Error>
where
    S: symplectic::Hamiltonian<Vector<f64> = Vector1<f64>, Class = Separable>,
{
    let system = Tangent::new(system);
    let displacement = (&Vector1::new(0.8), &Vector1::new(0.6));
    let start: State<Vector2<f64>> = system.start(&start, displacement)?;
    let mut megno = Megno::new(&start)?;
    let mut run =
        Integrator::<_, _, _, Compensated>::with_summation(ForestRuth, system, start, step)?;
    while run.state().time < end {
        megno.see(run.step()?);
    }
    Ok(megno)
}

/// Closed forms: a rotation, and the growth by eᵗ.
#[test]
fn megno_of_linear_systems_has_its_closed_form() -> Result<(), Error> {
    let start = || State::from_arrays(0.0, [0.3], [0.1]);
    let oscillator = megno(Linear { s: 1.0 }, start(), 1000.0, 0.05)?;
    assert!(oscillator.mean().abs() < 1e-4, "{oscillator:?}");
    assert!(oscillator.lyapunov_exponent().abs() < 1e-7);

    // |δ|² = (a² e²ᵗ + b² e⁻²ᵗ) with a = (0.8 + 0.6)/√2.
    let saddle = megno(
        Linear { s: -1.0 },
        State::from_arrays(0.0, [0.0], [0.0]),
        100.0,
        0.05,
    )?;
    let time = 100.0;
    let growth = time + f64::ln(1.4 / f64::sqrt(2.0));
    assert!((saddle.growth() - growth).abs() < 1e-3, "{saddle:?}");
    assert!((saddle.lyapunov_exponent() - 1.0).abs() < 1e-3);
    // Y = 2 (t + c − (t²/2 + ct + …)/t) = t + O(1/t).
    assert!((saddle.value() - time).abs() < 0.05);
    assert!((saddle.mean() - time / 2.0).abs() < 0.1);
    Ok(())
}

/// The displacement of a pendulum that swings grows like t: 2.
#[test]
fn megno_of_a_quasi_periodic_orbit_is_two() -> Result<(), Error> {
    let pendulum = megno(
        Pendulum,
        State::from_arrays(0.0, [1.0], [0.0]),
        20_000.0,
        0.2,
    )?;
    assert!((pendulum.mean() - 2.0).abs() < 0.05, "{pendulum:?}");
    assert!(pendulum.lyapunov_exponent() < 1e-3);
    Ok(())
}

/// Lengths far beyond squares of doubles, backward in time, and at other times.
#[test]
fn megno_does_not_depend_on_the_length_of_the_displacement() -> Result<(), Error> {
    let system = Tangent::new(STILL);
    let run = |length: f64, size: f64, every: usize| {
        let displacement = (
            &(Vector2::new(0.6, 0.3) * length),
            &(Vector2::new(-0.2, 0.7) * length),
        );
        let start: State<Four> = system.start(&henon_heiles(-0.16, 0.0, 0.125), displacement)?;
        let mut megno = Megno::new(&start)?;
        let mut run = Integrator::new(ForestRuth, system, start, size)?;
        for step in 0..4000 {
            let state = run.step()?;
            if step % every == 0 {
                megno.see(state);
            }
        }
        Ok::<_, Error>(megno)
    };
    let one = run(1.0, 0.05, 1)?;
    // A power of two changes no bit of the displacement.
    let far = run(f64::exp2(-1000.0), 0.05, 1)?;
    assert!((one.mean() - far.mean()).abs() < 1e-10 * one.mean());
    let sparse = run(1.0, 0.05, 10)?;
    assert!((one.mean() - sparse.mean()).abs() < 0.02 * one.mean());
    assert!(run(1.0, -0.05, 1)?.mean() > 4.0);
    Ok(())
}

/// In lanes and alone, with the same bits; chaotic orbits apart from the others.
#[test]
#[ignore = "thorough"]
fn megno_in_ensembles_has_the_bits_of_single_runs() -> Result<(), Box<dyn std::error::Error>> {
    let system = Tangent::new(STILL);
    let displacement = (&Vector2::new(0.6, 0.3), &Vector2::new(-0.2, 0.7));
    let begins: Vec<_> = (0..20)
        .map(|k| henon_heiles(-0.25 + 0.025 * f64::from(k), 0.0, 0.125))
        .collect();
    let starts: Vec<State<Four>> = begins
        .iter()
        .map(|begin| system.start(begin, displacement))
        .collect::<Result<_, _>>()?;
    let times: Vec<f64> = (0..=1000).map(|k| 0.5 * f64::from(k)).collect();
    let output = |trajectory: usize| Megno::new(&starts[trajectory]).expect("a displacement");
    let indicators = |ensemble: Ensemble<_, _, Four, _, _, _>| {
        let mut found = Vec::new();
        ensemble.integrate_at(&times, output, Megno::see, |row| {
            row.outcome.clone().expect("a bounded orbit");
            found.push((row.output.mean().to_bits(), words(&row.state)));
            ControlFlow::Continue(())
        });
        found
    };
    let ensemble = || Ensemble::new(ForestRuth, system, starts.clone(), 0.1);
    let together = indicators(ensemble()?);
    let mut alone = Vec::new();
    ensemble()?
        .one_by_one()
        .integrate_at(&times, output, Megno::see, |row| {
            alone.push((row.output.mean().to_bits(), words(&row.state)));
            ControlFlow::Continue(())
        });
    assert_eq!(together, alone);
    let means: Vec<f64> = together
        .iter()
        .map(|(bits, _)| f64::from_bits(*bits))
        .collect();
    let (sea, island) = means.split_at(10);
    assert!(
        sea.iter().filter(|mean| **mean > 4.0).count() >= 8,
        "{sea:?}"
    );
    assert!(island.iter().all(|mean| *mean < 2.5), "{island:?}");
    Ok(())
}

/// The indicator and the run are saved in the middle, one as text.
#[test]
fn an_indicator_resumes_with_the_same_bits() -> Result<(), Box<dyn std::error::Error>> {
    let system = Tangent::new(STILL);
    let displacement = (&Vector2::new(0.6, 0.3), &Vector2::new(-0.2, 0.7));
    let start: State<Four> = system.start(&henon_heiles(-0.16, 0.0, 0.125), displacement)?;
    let make = || Integrator::new(ForestRuth, system, start.clone(), 0.1);
    let (mut megno, mut run) = (Megno::new(&start)?, make()?);
    let steps = |megno: &mut Megno, run: &mut Integrator<_, _, Four>| {
        (0..200).try_for_each(|_| run.step().map(|state| megno.see(state)))
    };
    steps(&mut megno, &mut run)?;
    let saved = (run.checkpoint()?, Checkpoint::from(megno));
    steps(&mut megno, &mut run)?;

    let mut again = make()?;
    again.restore(&saved.0)?;
    let mut resumed = Megno::try_from(&saved.1)?;
    steps(&mut resumed, &mut again)?;
    assert_eq!(Checkpoint::from(resumed), Checkpoint::from(megno));
    assert_eq!(words(again.state()), words(run.state()));
    // A checkpoint of another kind.
    let other = Megno::try_from(&saved.0);
    assert!(matches!(
        other,
        Err(CheckpointError::OtherRun { what: "method", .. })
    ));
    Ok(())
}

/// A chaos map that is interrupted after some rows, and one whose orbits go on from where they were.
#[cfg(feature = "serde")]
#[test]
fn indicators_of_an_ensemble_resume_with_the_same_bits() -> Result<(), Box<dyn std::error::Error>> {
    let system = Tangent::new(STILL);
    let displacement = (&Vector2::new(0.6, 0.3), &Vector2::new(-0.2, 0.7));
    let begins = (0..20).map(|k| henon_heiles(-0.25 + 0.025 * f64::from(k), 0.0, 0.125));
    let starts: Vec<State<Four>> = begins
        .map(|begin| system.start(&begin, displacement))
        .collect::<Result<_, _>>()?;
    let make = || Ensemble::new(ForestRuth, system, starts.clone(), 0.1);
    let output = |trajectory: usize| Megno::new(&starts[trajectory]).expect("a displacement");
    let times: Vec<f64> = (0..=50).map(|k| 0.5 * f64::from(k)).collect();
    let map = |ensemble: &Ensemble<_, _, Four>, found: &mut Vec<Megno>, most: usize| {
        ensemble.integrate_at(&times, output, Megno::see, |row| {
            found.push(row.output);
            match found.len() < most {
                true => ControlFlow::Continue(()),
                false => ControlFlow::Break(()),
            }
        })
    };
    let mut whole = Vec::new();
    map(&make()?, &mut whole, 20);
    let mut found = Vec::new();
    let next = map(&make()?, &mut found, 7);
    let text = serde_json::to_string(&(make()?.checkpoint(next)?, &found))?;

    let (checkpoint, mut found): (EnsembleCheckpoint, Vec<Megno>) = serde_json::from_str(&text)?;
    let mut resumed = make()?;
    resumed.restore(&checkpoint)?;
    map(&resumed, &mut found, 20);
    let checkpoints = |found: &[Megno]| {
        found
            .iter()
            .map(|&megno| megno.into())
            .collect::<Vec<Checkpoint>>()
    };
    assert_eq!(checkpoints(&found), checkpoints(&whole));
    let damaged = text.replacen("\"MEGNO\"", "\"MEGNo\"", 1);
    serde_json::from_str::<(EnsembleCheckpoint, Vec<Megno>)>(&damaged).expect_err("a change");

    // Every orbit is saved at half of its steps.
    type Saved = (Megno, Option<Checkpoint>);
    let steps = |count: u32| {
        move |(megno, saved): &mut Saved, run: &mut Integrator<_, _, Four>| {
            if let Some(saved) = saved {
                run.restore(saved).expect("a checkpoint of this run");
            }
            (0..count).try_for_each(|_| run.step().map(|state| megno.see(state)))?;
            *saved = Some(run.checkpoint().expect("doubles"));
            Ok(())
        }
    };
    let each = |count: u32, output: &(dyn Fn(usize) -> Saved + Sync)| {
        let mut found = Vec::new();
        make().expect("starts").each(output, steps(count), |row| {
            found.push(row.output);
            ControlFlow::Continue(())
        });
        found
    };
    let whole = each(100, &|k| (output(k), None));
    let text = serde_json::to_string(&each(50, &|k| (output(k), None)))?;
    let half: Vec<Saved> = serde_json::from_str(&text)?;
    assert_eq!(each(50, &|k| half[k].clone()), whole);
    Ok(())
}

#[test]
fn bad_displacements_and_dimensions_are_refused() -> Result<(), Error> {
    let system = Tangent::new(STILL);
    let begin = henon_heiles(0.1, 0.0, 0.1);
    let (zero, some) = (Vector2::zero(), Vector2::new(1.0, 0.0));
    let found: Result<State<Four>, Error> = system.start(&begin, (&zero, &zero));
    assert_eq!(found, Err(Error::NoDisplacement));
    let found: Result<State<Four>, Error> = system.start(&begin, (&some, &(some * f64::NAN)));
    assert!(matches!(
        found,
        Err(Error::Core(symplectic::Error::NonFiniteState { .. }))
    ));
    let found: Result<State<SVector<f64, 6>>, Error> = system.start(&begin, (&some, &zero));
    let length = |expected, found| Error::Core(symplectic::Error::Length { expected, found });
    assert_eq!(found, Err(length(6, 4)));
    let still: State<Vector2<f64>> = State::from_arrays(0.0, [1.0, 0.0], [0.0, 1.0]);
    assert_eq!(Megno::new(&still), Err(Error::NoDisplacement));
    // Of odd and of other dimensions.
    let odd = State::from_arrays(0.0, [0.1; 5], [0.1; 5]);
    assert_eq!(Megno::new(&odd), Err(length(6, 5)));
    assert_eq!(system.state(&odd), Err(length(6, 5)));
    let mut run = Integrator::new(ForestRuth, system, odd, 0.1)?;
    assert_eq!(run.step().map_err(Error::Core).err(), Some(length(6, 5)));
    let other = State::from_arrays(0.0, [0.1; 6], [0.1; 6]);
    let mut run = Integrator::new(ForestRuth, system, other, 0.1)?;
    assert_eq!(run.step().map_err(Error::Core).err(), Some(length(4, 6)));
    // States that are not behind the last one.
    let start: State<Four> = system.start(&begin, (&some, &zero))?;
    let mut run = Integrator::new(ForestRuth, system, start.clone(), 0.1)?;
    let mut megno = Megno::new(&start)?;
    run.take_steps(100)?;
    megno.see(run.state());
    let seen = megno;
    megno.see(run.state());
    megno.see(&start);
    let mut back = Integrator::new(ForestRuth, system, run.into_state(), -0.1)?;
    back.take_steps(250)?;
    megno.see(back.state());
    assert_eq!(megno, seen);
    Ok(())
}
