//! The bits of a trajectory are those that it has alone, whatever the lanes, the parts and the order.

use std::ops::ControlFlow;

use symplectic::ensemble::Ensemble;
use symplectic::nalgebra::{DVector, SVector, Vector1, Vector2};
use symplectic::simd::{F64x2, F64x4, F64x8, F64x16};
use symplectic::solver::{ByNewton, FixedPoint, Newton, SimdJacobi};
use symplectic::{
    Compensated, Integrator, Method, Plain, ProvedFor, Separable, State, Summation, System, Vector,
    acceleration,
};

use crate::common::methods::{
    ForestRuth, Gauss4, Lobatto3, McLachlanAtela, StoermerVerlet, SymplecticEuler, TripleMidpoint,
    Weighted, Yoshida6,
};
use crate::common::systems::Product;
use crate::systems::{Bits, HenonHeiles, Pendulums, alone, keep, on_threads, starts};

/// The runs of an ensemble made by `make`, of all lanes, by `$call`.
macro_rules! in_all_lanes {
    ($make:expr, |$ensemble:ident| $rows:expr) => {
        [
            ("one by one", {
                let $ensemble = $make.one_by_one();
                $rows
            }),
            ("2 lanes", {
                let $ensemble = $make.in_lanes::<F64x2>();
                $rows
            }),
            ("4 lanes", {
                let $ensemble = $make.in_lanes::<F64x4>();
                $rows
            }),
            ("8 lanes", {
                let $ensemble = $make.in_lanes::<F64x8>();
                $rows
            }),
        ]
    };
}

/// Checks ends, steps and outputs.
fn check<M, S, V, R>(method: M, system: S, starts: Vec<State<V>>, size: f64)
where
    M: Method + Copy + ProvedFor<S::Class>,
    S: System<V> + Clone + Send + Sync,
    V: Vector<Scalar = f64> + Send + Sync,
    R: Summation,
{
    let make =
        |start| Integrator::<M, S, V, R>::with_summation(method, system.clone(), start, size);
    let ensemble = || {
        let family = [(system.clone(), starts.clone())];
        Ensemble::<M, S, V, R>::with_summation(method, family, size).expect("starts")
    };
    let time = starts[0].time;
    let end = time + 60.4 * size;

    let expected = alone(&starts, make, |run| (run.integrate_to(end).map(|_| ()), ()));
    let found = in_all_lanes!(ensemble(), |ensemble| {
        let mut rows = Vec::new();
        assert_eq!(ensemble.integrate_to(end, keep(&mut rows, 0)), starts.len());
        rows
    });
    for (what, rows) in found {
        assert_eq!(rows, expected, "{} in {what}, to an end", M::NAME);
    }

    let expected = alone(&starts, make, |run| (run.take_steps(77).map(|_| ()), ()));
    let found = in_all_lanes!(ensemble(), |ensemble| {
        let mut rows = Vec::new();
        ensemble.take_steps(77, keep(&mut rows, 0));
        rows
    });
    for (what, rows) in found {
        assert_eq!(rows, expected, "{} in {what}, steps", M::NAME);
    }

    // The start, times inside steps, two in one step, and the end of a step.
    let times = [0.0, 0.0, 0.3, 3.1, 3.7, 10.0, 31.5].map(|steps| time + steps * size);
    let expected = alone(&starts, make, |run| {
        let mut seen = Vec::new();
        let outcome = run.integrate_at(&times, |state| seen.push(crate::systems::words(state)));
        (outcome.map(|_| ()), seen)
    });
    assert!(expected.iter().all(|(_, seen)| seen.len() == times.len()));
    let found = in_all_lanes!(ensemble(), |ensemble| {
        let mut rows = Vec::new();
        let see = |seen: &mut Vec<_>, state: &State<V>| seen.push(crate::systems::words(state));
        ensemble.integrate_at(&times, |_| Vec::new(), see, keep(&mut rows, 0));
        rows
    });
    for (what, rows) in found {
        assert_eq!(rows, expected, "{} in {what}, at times", M::NAME);
    }
}

fn check_sums<M, S, V>(method: M, system: S, starts: &[State<V>], size: f64)
where
    M: Method + Copy + ProvedFor<S::Class>,
    S: System<V> + Clone + Send + Sync,
    V: Vector<Scalar = f64> + Send + Sync,
{
    check::<M, S, V, Compensated>(method, system.clone(), starts.to_vec(), size);
    check::<M, S, V, Plain>(method, system, starts.to_vec(), size);
}

const SYSTEM: HenonHeiles = HenonHeiles { amplitude: 0.02 };

#[test]
fn splittings_in_lanes_have_the_bits_of_single_runs() {
    let starts = starts(13, 100);
    check_sums(SymplecticEuler, SYSTEM, &starts, 0.01);
    check_sums(StoermerVerlet, SYSTEM, &starts, 0.1);
    check_sums(ForestRuth, SYSTEM, &starts, -0.1);
    check_sums(McLachlanAtela, SYSTEM, &starts, 0.1);
    check_sums(Yoshida6, SYSTEM, &starts, 0.1);
}

/// Threads take shares of many trajectories, and their rows are shown while the next shares run.
#[test]
fn short_runs_on_any_number_of_threads() {
    let mut starts = starts(3000, 5000);
    // Groups end where the time changes.
    starts[1111..1300]
        .iter_mut()
        .for_each(|start| start.time = 0.75);
    let make = |start| Integrator::new(StoermerVerlet, SYSTEM, start, 0.1);
    let expected = alone(&starts, make, |run| (run.take_steps(3).map(|_| ()), ()));
    let ensemble = Ensemble::new(StoermerVerlet, SYSTEM, starts, 0.1).expect("starts");
    for threads in 1..=3 {
        let mut rows = Vec::new();
        on_threads(threads, || ensemble.take_steps(3, keep(&mut rows, 0)));
        assert!(rows == expected, "{threads} threads");
        // The run ends in the middle of a share.
        let mut count = 0;
        let next = on_threads(threads, || {
            ensemble.take_steps(3, |_| {
                count += 1;
                match count < 1777 {
                    true => ControlFlow::Continue(()),
                    false => ControlFlow::Break(()),
                }
            })
        });
        assert_eq!((next, count), (1777, 1777), "{threads} threads");
    }
}

/// Two registers of AVX-512: they are the lanes of a build for it.
#[test]
fn sixteen_lanes_have_the_bits_of_single_runs() {
    // One of them escapes in its lane, and the last lanes are empty.
    let starts = starts(37, 20);
    let ensemble = || Ensemble::new(Yoshida6, SYSTEM, starts.clone(), 0.1).expect("starts");
    let times = [0.5, 0.71, 8.3, 20.0];
    let see = |seen: &mut Vec<_>, state: &State<_>| seen.push(crate::systems::words(state));
    let [mut ends, mut ends_alone] = [Vec::new(), Vec::new()];
    let [mut seen, mut seen_alone] = [Vec::new(), Vec::new()];
    let lanes = ensemble().in_lanes::<F64x16>();
    lanes.integrate_to(30.7, keep(&mut ends, 0));
    lanes.integrate_at(&times, |_| Vec::new(), see, keep(&mut seen, 0));
    let alone = ensemble().one_by_one();
    alone.integrate_to(30.7, keep(&mut ends_alone, 0));
    alone.integrate_at(&times, |_| Vec::new(), see, keep(&mut seen_alone, 0));
    assert_eq!(ends.len(), starts.len());
    assert!(ends == ends_alone && seen == seen_alone);
}

#[test]
fn coupled_stages_in_lanes_have_the_bits_of_single_runs() {
    let starts = starts(5, 100);
    check_sums(Gauss4, SYSTEM, &starts, 0.1);
    check_sums(Lobatto3, SYSTEM, &starts, 0.1);
    check_sums(TripleMidpoint, SYSTEM, &starts, 0.1);
}

#[test]
fn nonseparable_systems_in_lanes_have_the_bits_of_single_runs() {
    let start = |k: usize| State::from_arrays(0.0, [0.1 * k as f64], [0.3]);
    let starts: Vec<_> = (0..7).map(start).collect();
    check_sums(ForestRuth.accept_lower_order(), Product, &starts, 0.01);
    check_sums(Gauss4, Product, &starts, 0.05);
    check_sums(Weighted.accept_lower_order(), Product, &starts, 0.05);
}

symplectic::hamiltonian! {
    Damped { gamma: 0.1 }
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + x^2 y^2 + cos(x)
    friction: gamma
}

symplectic::hamiltonian! {
    Rod
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + y
    constraints: { rod = x^2 + y^2 - 1 }
}

#[test]
fn systems_with_friction_or_constraints_have_the_bits_of_single_runs() {
    let start = |k: usize| State::from_arrays(0.0, [0.1 * k as f64, 0.7], [0.3, 0.1]);
    let starts: Vec<_> = (0..11).map(start).collect();
    check_sums(ForestRuth, Damped::default(), &starts, 0.1);
    let start = |k: usize| {
        let (sine, cosine) = (0.3 * k as f64).sin_cos();
        State::from_arrays(0.0, [sine, -cosine], [0.0, 0.0])
    };
    let starts: Vec<_> = (0..5).map(start).collect();
    check_sums(Lobatto3, Rod, &starts, 0.1);
}

#[test]
fn dynamic_vectors_in_lanes_have_the_bits_of_single_runs() {
    for dimension in [3, 70] {
        let start = |k: usize| {
            let q = DVector::from_fn(dimension, |i, _| 0.3 * ((i * k) as f64 + 0.5).sin());
            State::new(0.0, q, DVector::from_element(dimension, 0.2))
        };
        let starts: Vec<_> = (0..6).map(start).collect();
        check_sums(StoermerVerlet, Pendulums, &starts, 0.1);
    }
}

#[test]
fn closures_in_an_ensemble_have_the_bits_of_single_runs() {
    let pendulum = acceleration(|_time, q: &Vector1<f64>, a: &mut Vector1<f64>| a[0] = -q[0].sin());
    let start = |k: usize| State::from_arrays(0.0, [0.2 * k as f64], [0.0]);
    let starts: Vec<_> = (0..5).map(start).collect();
    check_sums(StoermerVerlet, pendulum, &starts, 0.1);
    check_sums(Gauss4, pendulum, &starts, 0.1);
}

#[test]
fn starts_at_different_times_have_the_bits_of_single_runs() {
    let mut starts = starts(11, 100);
    for (k, start) in starts.iter_mut().enumerate() {
        start.time = [0.5, 0.5, 0.75][k / 4];
    }
    let make = |start| Integrator::new(ForestRuth, SYSTEM, start, 0.1);
    let expected = alone(&starts, make, |run| (run.integrate_to(7.3).map(|_| ()), ()));
    let ensemble = Ensemble::new(ForestRuth, SYSTEM, starts, 0.1).expect("starts");
    let mut rows = Vec::new();
    ensemble.integrate_to(7.3, keep(&mut rows, 0));
    assert_eq!(rows, expected);
}

#[test]
fn chosen_solvers_in_an_ensemble_have_the_bits_of_single_runs() {
    let starts = starts(5, 100);
    let make = |start| Integrator::new(Gauss4, SYSTEM, start, 0.1);
    let end = |rows: &[(Bits, ())], expected: &[(Bits, ())]| assert_eq!(rows, expected);
    let ensemble = || Ensemble::new(Gauss4, SYSTEM, starts.clone(), 0.1).expect("starts");

    let newton = alone(
        &starts,
        |start| Ok(make(start)?.by_newton()),
        |run| (run.integrate_to(9.0).map(|_| ()), ()),
    );
    let mut rows = Vec::new();
    ensemble()
        .with_solver(<Newton>::new())
        .integrate_to(9.0, keep(&mut rows, 0));
    end(&rows, &newton);

    let fixed = alone(
        &starts,
        |start| Ok(make(start)?.with_solver(FixedPoint)),
        |run| (run.integrate_to(9.0).map(|_| ()), ()),
    );
    assert_ne!(newton, fixed);
    let mut rows = Vec::new();
    ensemble()
        .with_solver(FixedPoint)
        .integrate_to(9.0, keep(&mut rows, 0));
    end(&rows, &fixed);

    let start = |k: usize| State::from_arrays(0.0, [0.1 * k as f64], [0.3]);
    let starts: Vec<_> = (0..5).map(start).collect();
    let jacobi = alone(
        &starts,
        |start| Ok(Integrator::new(Gauss4, Product, start, 0.1)?.with_solver(SimdJacobi)),
        |run| (run.integrate_to(9.0).map(|_| ()), ()),
    );
    let ensemble = Ensemble::new(Gauss4, Product, starts, 0.1).expect("starts");
    let mut rows = Vec::new();
    ensemble
        .with_solver(SimdJacobi)
        .integrate_to(9.0, keep(&mut rows, 0));
    end(&rows, &jacobi);
}

#[test]
fn families_with_different_parameters_have_the_bits_of_single_runs() {
    let families: Vec<(HenonHeiles, Vec<_>)> =
        [(0.0, 5), (0.01, 1), (0.02, 3), (0.03, 0), (0.04, 9)]
            .into_iter()
            .map(|(amplitude, count)| (HenonHeiles { amplitude }, starts(count, 100)))
            .collect();
    let mut expected = Vec::new();
    for (system, starts) in &families {
        let make = |start| Integrator::new(ForestRuth, *system, start, 0.1);
        expected.extend(alone(starts, make, |run| {
            (run.take_steps(50).map(|_| ()), ())
        }));
    }
    let ensemble = || Ensemble::of_families(ForestRuth, families.clone(), 0.1).expect("starts");
    let mut rows = Vec::new();
    ensemble().take_steps(50, keep(&mut rows, 0));
    assert_eq!(rows, expected);
    // Parts that cut families, more of them than trajectories, and a part of a part.
    for count in [1, 2, 5, 7, 18, 25] {
        let mut rows = Vec::new();
        let whole = ensemble();
        for part in 0..count {
            let shard = ensemble().shard(part, count).expect("a part");
            let first = rows.len();
            assert_eq!(shard.trajectories().start, first);
            let mut own = Vec::new();
            shard.take_steps(50, keep(&mut own, first));
            // A copy of the part.
            let copy = whole.to_shard(part, count).expect("a part");
            assert_eq!(copy.trajectories(), shard.trajectories());
            let mut copied = Vec::new();
            copy.take_steps(50, keep(&mut copied, first));
            assert_eq!(copied, own);
            rows.append(&mut own);
        }
        assert_eq!(rows, expected, "{count} parts");
    }
    let part = ensemble().shard(1, 3).expect("a part").shard(1, 2);
    let part = part.expect("a part of a part");
    let copy = ensemble().to_shard(1, 3).expect("a part").to_shard(1, 2);
    let copy = copy.expect("a part of a part");
    assert_eq!(copy.trajectories(), part.trajectories());
    assert_eq!(copy.starts(), part.starts());
    let mut rows = Vec::new();
    let range = part.trajectories();
    part.take_steps(50, keep(&mut rows, range.start));
    assert_eq!(rows, expected[range]);
}

/// Its force has other bits in lanes, as a product of matrices may have.
#[derive(Clone, Copy)]
struct OtherInLanes;

impl symplectic::Hamiltonian for OtherInLanes {
    type Class = Separable;
    type Vector<T: symplectic::Scalar> = SVector<T, 1>;

    fn velocity<T: symplectic::Scalar>(
        &self,
        _time: T,
        _q: &Self::Vector<T>,
        p: &Self::Vector<T>,
        velocity: &mut Self::Vector<T>,
    ) {
        *velocity = *p;
    }

    fn force<T: symplectic::Scalar>(
        &self,
        _time: T,
        q: &Self::Vector<T>,
        _p: &Self::Vector<T>,
        force: &mut Self::Vector<T>,
    ) {
        force[0] = match size_of::<T>() > 8 {
            true => -q[0] * T::from_f64(1.0 + f64::EPSILON),
            false => -q[0],
        };
    }
}

#[test]
fn a_system_with_other_bits_in_lanes_goes_one_by_one() {
    let start = |k: usize| State::from_arrays(0.0, [0.1 + 0.1 * k as f64], [0.3]);
    let starts: Vec<_> = (0..8).map(start).collect();
    check_sums(StoermerVerlet, OtherInLanes, &starts, 0.1);
}

#[test]
fn rows_come_in_order_for_any_number_of_threads() {
    // Several batches, and groups that are not full.
    let starts = starts(1030, 50);
    let make = |start: State<Vector2<f64>>| Integrator::new(StoermerVerlet, SYSTEM, start, 0.1);
    let expected = alone(&starts, make, |run| (run.take_steps(40).map(|_| ()), ()));
    let run = |starts: Vec<State<Vector2<f64>>>| {
        let ensemble = Ensemble::new(StoermerVerlet, SYSTEM, starts, 0.1).expect("starts");
        let mut rows = Vec::new();
        ensemble.take_steps(40, keep(&mut rows, 0));
        rows
    };
    assert_eq!(run(starts.clone()), expected);
    let backward: Vec<_> = starts.iter().rev().cloned().collect();
    let mut rows = run(backward);
    rows.reverse();
    assert_eq!(rows, expected);
    #[cfg(feature = "parallel")]
    for threads in [1, 2, 5] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let rows = pool.expect("threads").install(|| run(starts.clone()));
        assert_eq!(rows, expected, "{threads} threads");
    }
}
