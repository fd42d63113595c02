//! Coupled stages in lanes: the bits of a single run, for every kind of sweep.

use std::sync::Mutex;
use std::sync::atomic::AtomicUsize;

use symplectic::ensemble::Ensemble;
use symplectic::nalgebra::{DVector, SVector, Vector1};
use symplectic::simd::{F64x4, F64x16};
use symplectic::{
    Compensated, Hamiltonian, Integrator, Method, Plain, ProvedFor, Retry, Scalar,
    SeparableHamiltonian, State, Summation,
};

use crate::common::methods::{
    Askew, Gauss4, Gauss5, Gauss18, Lobatto3, Lobatto4, Midpoint, Radau3, RadauIIA, Tang, Twins,
};
use crate::common::systems::{Kepler, Product};
use crate::common::tableau;
use crate::systems::{Bits, Counted, HenonHeiles, Pendulums, alone, keep, on_threads, starts};

symplectic::tableau! {
    /// Both positions are equal: one force, and two velocities.
    OneForce { a: [[3/8, 1/8], [3/8, 1/8]], b: [1/2, 1/2], a_tilde: symplectic_partner }
}

const SYSTEM: HenonHeiles = HenonHeiles { amplitude: 0.02 };

/// Checks the ends of trajectories in sixteen lanes; returns the number of forces evaluated there. Other widths are in `bits`; every
/// combination of them would take long to compile.
fn forces_in_lanes<M, H, R>(
    method: M,
    system: &H,
    starts: &[State<H::Vector<f64>>],
    size: f64,
) -> usize
where
    M: Method + Copy + ProvedFor<H::Class>,
    H: Hamiltonian + Clone + Send + Sync,
    H::Vector<f64>: Send + Sync,
    R: Summation,
{
    let make = |start| {
        Integrator::<M, H, H::Vector<f64>, R>::with_summation(method, system.clone(), start, size)
    };
    let expected = alone(starts, make, |run| (run.take_steps(90).map(|_| ()), ()));
    assert!(expected.iter().any(|(row, ())| row.outcome.is_ok()));
    let in_lanes = AtomicUsize::new(0);
    let counted = Counted {
        system: system.clone(),
        in_lanes: &in_lanes,
    };
    let family = [(counted, starts.to_vec())];
    let ensemble = Ensemble::<M, _, H::Vector<f64>, R>::with_summation(method, family, size);
    let ensemble = ensemble.expect("starts").in_lanes::<F64x16>();
    let mut rows = Vec::new();
    on_threads(1, || {
        ensemble.take_steps(90, keep(&mut rows, 0));
    });
    assert_eq!(rows, expected, "{}", M::NAME);
    in_lanes.into_inner()
}

/// Checks the ends of trajectories, and that steps are taken in lanes.
fn check<M, H, R>(method: M, system: &H, starts: &[State<H::Vector<f64>>], size: f64)
where
    M: Method + Copy + ProvedFor<H::Class>,
    H: Hamiltonian + Clone + Send + Sync,
    H::Vector<f64>: Send + Sync,
    R: Summation,
{
    let in_lanes = forces_in_lanes::<M, H, R>(method, system, starts, size);
    // A force of each of two groups is compared with doubles. Of slow iterations few succeed in lanes.
    assert!(in_lanes > 20, "{}: {in_lanes}", M::NAME);
}

/// [`check`] with both kinds of sums.
macro_rules! check {
    ($system:expr, $starts:expr, $size:expr, $($method:expr),*) => {
        $(
            check::<_, _, Compensated>($method, &$system, &$starts, $size);
            check::<_, _, Plain>($method, &$system, &$starts, $size);
        )*
    };
}

/// Orbits of every eccentricity up to 0.9: near the pericentre the stages of some do not settle in their lane.
fn orbits(count: u32) -> Vec<State<SVector<f64, 2>>> {
    let start = |k: u32| {
        let e = 0.9 * f64::from(k) / f64::from(count);
        State::from_arrays(0.0, [1.0 - e, 0.0], [0.0, ((1.0 + e) / (1.0 - e)).sqrt()])
    };
    (0..count).map(start).collect()
}

#[test]
#[ignore = "thorough"]
fn second_order_systems_have_the_bits_of_single_runs() {
    // With unit masses, and one that leaves; with velocities that are computed.
    check!(
        SYSTEM,
        starts(19, 7),
        0.1,
        Midpoint,
        Gauss5,
        Gauss18,
        Lobatto4
    );
    check!(Kepler, orbits(19), 0.05, Gauss4, Radau3);
    // Many sweeps, whose number depends on the sizes of the stages.
    check!(Kepler, orbits(33), 0.08, Midpoint);
}

#[test]
fn other_kinds_of_methods_have_the_bits_of_single_runs() {
    check!(Kepler, orbits(9), 0.05, Tang, Askew, Twins, RadauIIA);
    // With fewer forces than velocities there is no place for positions only: these trajectories run one by one.
    let starts = orbits(9);
    let in_lanes = forces_in_lanes::<_, _, Plain>(OneForce, &Kepler, &starts, 0.05);
    assert_eq!(in_lanes, 0);
}

/// H = √(1 + p²) + 1 − cos(q − t/2), whose velocity is not linear.
#[derive(Clone, Copy, Debug)]
struct Relativistic;

impl SeparableHamiltonian for Relativistic {
    type Vector<T: Scalar> = SVector<T, 1>;

    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
        velocity[0] = p[0] / (T::one() + p[0] * p[0]).sqrt();
    }

    fn force<T: Scalar>(&self, time: T, q: &SVector<T, 1>, force: &mut SVector<T, 1>) {
        force[0] = -(q[0] - time * T::from_f64(0.5)).sin();
    }
}

fn points(count: usize) -> Vec<State<Vector1<f64>>> {
    let start = |k: usize| State::from_arrays(0.5, [0.1 * k as f64], [0.3 - 0.05 * k as f64]);
    (0..count).map(start).collect()
}

#[test]
#[ignore = "thorough"]
fn separable_systems_have_the_bits_of_single_runs() {
    check!(
        Relativistic,
        points(19),
        0.1,
        Gauss4,
        Gauss18,
        Lobatto3,
        Twins,
        RadauIIA
    );
}

symplectic::hamiltonian! {
    Swing
    q: [x, y], p: [px, py];
    H = (1 + x^2) (px^2 + py^2)/2 + cos(y) + x cos(3 t)/8 + px y/4
}

#[test]
#[ignore = "thorough"]
fn nonseparable_systems_have_the_bits_of_single_runs() {
    let start = |k: usize| State::from_arrays(0.5, [0.1 * k as f64, 0.2], [0.3, 0.1 * k as f64]);
    let starts: Vec<_> = (0..19).map(start).collect();
    check!(Swing, starts, 0.1, Midpoint, Gauss4, Gauss18, Twins);
    check!(Product, points(9), 0.05, RadauIIA.accept_lower_order());
}

#[test]
#[ignore = "thorough"]
fn run_time_tableaux_step_nonseparable_systems_in_lanes() {
    let start = |k: usize| State::from_arrays(0.5, [0.1 * k as f64, 0.2], [0.3, 0.1 * k as f64]);
    let starts: Vec<_> = (0..19).map(start).collect();
    for tableau in [tableau(Midpoint), tableau(Gauss4), tableau(Gauss18)] {
        let make = |start| Integrator::new(tableau.clone(), Swing, start, 0.1);
        let expected = alone(&starts, make, |run| (run.take_steps(90).map(|_| ()), ()));
        let in_lanes = AtomicUsize::new(0);
        let counted = Counted {
            system: Swing,
            in_lanes: &in_lanes,
        };
        let ensemble = Ensemble::new(tableau.clone(), counted, starts.clone(), 0.1);
        let mut rows = Vec::new();
        let ensemble = ensemble.expect("starts").in_lanes::<F64x16>();
        on_threads(1, || {
            ensemble.take_steps(90, keep(&mut rows, 0));
        });
        assert_eq!(rows, expected, "{}", tableau.name());
        let in_lanes = in_lanes.into_inner();
        assert!(in_lanes > 20, "{}: {in_lanes}", tableau.name());
    }
}

#[test]
#[ignore = "thorough"]
fn dynamic_vectors_have_the_bits_of_single_runs() {
    for dimension in [1, 3, 20] {
        let start = |k: usize| {
            let q = DVector::from_fn(dimension, |i, _| 0.3 * ((i * k) as f64 + 0.5).sin());
            State::new(0.0, q, DVector::from_element(dimension, 0.2))
        };
        let starts: Vec<_> = (0..18).map(start).collect();
        check!(Pendulums, starts, 0.1, Gauss4, Lobatto3);
    }
}

#[test]
fn tolerances_and_sweep_bounds_hold_in_lanes() {
    let starts = orbits(18);
    // Some of these tolerances are out of reach where positions are large.
    for (tolerance, sweeps) in [
        (1e-9, 200),
        (1.3e-15, 200),
        (2e-15, 200),
        (0.0, 5),
        (0.0, 1),
    ] {
        let make = |start| {
            let mut run = Integrator::plain(Gauss4, Kepler, start, 0.05)?;
            run.set_tolerance(tolerance)?;
            run.set_max_iterations(sweeps);
            Ok(run)
        };
        let expected = alone(&starts, make, |run| (run.take_steps(100).map(|_| ()), ()));
        let ensemble = Ensemble::plain(Gauss4, Kepler, starts.clone(), 0.05);
        let mut ensemble = ensemble.expect("starts").in_lanes::<F64x4>();
        ensemble.set_tolerance(tolerance).expect("a tolerance");
        ensemble.set_max_iterations(sweeps);
        let mut rows = Vec::new();
        ensemble.take_steps(100, keep(&mut rows, 0));
        assert_eq!(rows, expected, "{tolerance}, {sweeps} sweeps");
    }
}

#[test]
fn steps_that_are_split_go_on_in_their_lane() {
    let starts = orbits(10);
    for halvings in [1, 4] {
        let make = |start| {
            let mut run = Integrator::new(Midpoint, Kepler, start, 0.4)?;
            run.set_retry(Retry::Split { halvings });
            run.set_max_iterations(14);
            Ok(run)
        };
        let times: Vec<f64> = (1..90).map(|k| 0.13 * f64::from(k)).collect();
        let expected = alone(&starts, make, |run| {
            let mut seen = Vec::new();
            let outcome = run.integrate_at(&times, |state| seen.push(crate::systems::words(state)));
            (outcome.map(|_| ()), seen)
        });
        let ends: Vec<(Bits, ())> = alone(&starts, make, |run| {
            (run.integrate_to(20.0).map(|_| ()), ())
        });
        let split = ends.iter().filter(|(row, ())| row.rejected() > 0);
        let failed = ends.iter().filter(|(row, ())| row.outcome.is_err());
        assert!(split.count() > 3 && failed.count() < 10);
        let ensemble = Ensemble::new(Midpoint, Kepler, starts.clone(), 0.4);
        let mut ensemble = ensemble.expect("starts").in_lanes::<F64x4>();
        ensemble.set_retry(Retry::Split { halvings });
        ensemble.set_max_iterations(14);
        let see = |seen: &mut Vec<_>, state: &State<_>| seen.push(crate::systems::words(state));
        let mut rows = Vec::new();
        ensemble.integrate_at(&times, |_| Vec::new(), see, keep(&mut rows, 0));
        assert_eq!(rows, expected);
        let mut rows = Vec::new();
        ensemble.integrate_to(20.0, keep(&mut rows, 0));
        assert_eq!(rows, ends);
    }
}

/// Counts the forces that are evaluated for each size of a scalar, in bytes.
struct BySize<'a>(&'a Mutex<[usize; 129]>);

impl Clone for BySize<'_> {
    fn clone(&self) -> Self {
        Self(self.0)
    }
}

impl SeparableHamiltonian for BySize<'_> {
    type Vector<T: Scalar> = SVector<T, 2>;

    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
        *velocity = *p;
    }

    fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, force: &mut SVector<T, 2>) {
        self.0.lock().expect("a count")[size_of::<T>()] += 1;
        let square = q.dot(q);
        *force = -q * (square * square.sqrt()).recip();
    }
}

#[test]
fn nearly_all_steps_run_in_full_lanes() {
    let counts = Mutex::new([0; 129]);
    // Sixteen for every thread.
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let some: Vec<_> = orbits(30).into_iter().take(16).collect();
    let starts = some.iter().cloned().cycle().take(16 * threads).collect();
    let ensemble = Ensemble::new(Gauss4, BySize(&counts), starts, 0.01).expect("starts");
    let ensemble = ensemble.in_lanes::<F64x16>();
    ensemble.take_steps(1000, |_| std::ops::ControlFlow::Continue(()));
    let counts = counts.into_inner().expect("counts");
    // Four stages, and at least two sweeps of every step.
    assert!(counts[128] > 8 * 999, "{}", counts[128]);
    // Stages of a trajectory alone in four lanes: the first step, and few others.
    assert!(counts[32] > 16, "{}", counts[32]);
    assert!(counts[32] < counts[128] / 100, "{}", counts[32]);
}

/// The rows of an ensemble of Kepler orbits by Gauss's method from the row `first` on, and the number of forces in lanes.
fn gauss(count: usize, threads: usize, first: usize) -> (Vec<(Bits, ())>, usize) {
    let in_lanes = AtomicUsize::new(0);
    let system = Counted {
        system: Kepler,
        in_lanes: &in_lanes,
    };
    let make = || {
        let starts = orbits(80).into_iter().take(count).collect();
        let ensemble = Ensemble::new(Gauss4, system.clone(), starts, 0.05);
        ensemble.expect("starts").in_lanes::<F64x16>()
    };
    let checkpoint = make().checkpoint(first).expect("f64");
    let mut resumed = make();
    resumed.restore(&checkpoint).expect("the same run");
    let mut rows = Vec::new();
    on_threads(threads, || {
        resumed.take_steps(60, keep(&mut rows, first));
    });
    (rows, in_lanes.into_inner())
}

#[test]
fn rows_are_the_same_for_any_threads_and_after_a_restart() {
    let make = |start| Integrator::new(Gauss4, Kepler, start, 0.05);
    let expected = alone(&orbits(80), make, |run| {
        (run.take_steps(60).map(|_| ()), ())
    });
    for threads in [1, 2, 4] {
        // Also from the middle of a group.
        for first in [0, 5, 16, 79] {
            let (rows, in_lanes) = gauss(80, threads, first);
            assert_eq!(
                rows,
                expected[first..],
                "{threads} threads, from row {first}"
            );
            // A single trajectory is no group.
            assert_eq!(in_lanes > 60, first < 79, "{in_lanes}");
        }
    }
}

#[test]
fn fewer_trajectories_than_half_the_lanes_run_one_by_one() {
    let in_lanes = |count| gauss(count, 1, 0).1;
    assert_eq!(in_lanes(7), 0);
    assert!(in_lanes(8) > 60);
    // The same for what is left of full groups.
    assert_eq!(in_lanes(16 + 7), in_lanes(16));
    assert!(in_lanes(16 + 8) > in_lanes(16));
}
