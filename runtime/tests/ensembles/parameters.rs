//! Trajectories with different parameters side by side: the bits that each has alone.

use std::sync::atomic::{AtomicUsize, Ordering};

use symplectic::at_run_time::RunTimeTableau;
use symplectic::emitted::LaneWork;
use symplectic::ensemble::Ensemble;
use symplectic::nalgebra::{SVector, Vector2};
use symplectic::simd::{F64x16, Lanes, MAX_LANES};
use symplectic::{
    Compensated, Hamiltonian, Integrator, Method, ProvedFor, Scalar, Separable, State, System,
    Vector,
};

use crate::common::methods::{ForestRuth, Gauss4};
use crate::common::tableau;
use crate::systems::{Bits, alone, keep, on_threads, words};

/// H = |p|²/2 + |q|²/2 + a x³: for large a trajectories escape to infinity, in a finite time.
#[derive(Clone, Debug)]
struct Cubic<'a> {
    /// a, for each lane.
    strengths: [f64; MAX_LANES],
    /// The number of forces evaluated in sixteen lanes.
    in_lanes: &'a AtomicUsize,
}

impl Hamiltonian for Cubic<'_> {
    type Class = Separable;
    type Vector<T: Scalar> = SVector<T, 2>;

    const JOINS: bool = true;

    fn in_lanes<V: Vector, L: Lanes, K: LaneWork<V, Self, L>>(work: K) -> K::Output
    where
        Self: System<V, Class = Separable>,
    {
        work.run::<SVector<L, 2>, Self>(|systems| {
            let mut joined: Option<Self> = None;
            for (lane, system) in systems.enumerate() {
                let joined = joined.get_or_insert_with(|| system.clone());
                joined.strengths[lane] = system.strengths[0];
            }
            joined
        })
    }

    fn velocity<T: Scalar>(
        &self,
        _time: T,
        _q: &SVector<T, 2>,
        p: &SVector<T, 2>,
        velocity: &mut SVector<T, 2>,
    ) {
        *velocity = *p;
    }

    fn force<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, 2>,
        _p: &SVector<T, 2>,
        force: &mut SVector<T, 2>,
    ) {
        let is_counted = size_of::<T>() == size_of::<[f64; 16]>();
        self.in_lanes
            .fetch_add(usize::from(is_counted), Ordering::Relaxed);
        let factor = T::from_lanes(&self.strengths) * T::from_f64(3.0);
        force[0] = -q[0] - factor * q[0] * q[0];
        force[1] = -q[1];
    }
}

type Starts = Vec<State<Vector2<f64>>>;

/// Seven trajectories in families of one or two, of which those with a large a escape, then 30 with a parameter of their own.
fn families(in_lanes: &AtomicUsize) -> Vec<(Cubic<'_>, Starts)> {
    let start = |k: usize| State::from_arrays(0.0, [-0.3 - 0.01 * k as f64, 0.2], [0.0, 0.1]);
    let mut families = Vec::new();
    let mut next = 0;
    for family in 0..35 {
        let strength = if family % 9 == 4 {
            2.5
        } else {
            0.01 * family as f64
        };
        let count = 1 + usize::from(family < 2);
        let system = Cubic {
            strengths: [strength; MAX_LANES],
            in_lanes,
        };
        families.push((system, (next..next + count).map(start).collect()));
        next += count;
    }
    families
}

/// What comes of all trajectories alone, by the integrators that `make` makes.
macro_rules! alone {
    ($families:expr, $make:expr, $run:expr) => {{
        let mut expected = Vec::new();
        for (system, starts) in $families {
            let make = |start| $make(system.clone(), start);
            expected.extend(alone(&starts, make, $run));
        }
        expected
    }};
}

/// Checks an ensemble against trajectories alone; returns the number of forces in lanes.
fn check<M: Method + ProvedFor<Separable> + Copy>(method: M) -> usize {
    let in_lanes = AtomicUsize::new(0);
    let make = |system, start| Integrator::new(method, system, start, 0.1);
    let ensemble = || {
        let ensemble = Ensemble::of_families(method, families(&in_lanes), 0.1);
        ensemble.expect("starts").in_lanes::<F64x16>()
    };
    let expected = alone!(families(&in_lanes), make, |run| {
        (run.take_steps(200).map(|_| ()), ())
    });
    let failed = expected.iter().filter(|(row, ())| row.outcome.is_err());
    assert_eq!(failed.count(), 4);
    let mut rows: Vec<(Bits, ())> = Vec::new();
    let run = ensemble();
    on_threads(1, || {
        run.take_steps(200, keep(&mut rows, 0));
    });
    assert_eq!(rows, expected, "{}", M::NAME);

    let times = [0.0, 0.25, 3.1];
    let expected = alone!(families(&in_lanes), make, |run| {
        let mut seen = Vec::new();
        let outcome = run.integrate_at(&times, |state| seen.push(words(state)));
        (outcome.map(|_| ()), seen)
    });
    let mut rows = Vec::new();
    let run = ensemble();
    on_threads(1, || {
        let see = |seen: &mut Vec<_>, state: &State<_>| seen.push(words(state));
        run.integrate_at(&times, |_| Vec::new(), see, keep(&mut rows, 0));
    });
    assert_eq!(rows, expected, "{} at times", M::NAME);
    in_lanes.into_inner()
}

#[test]
fn families_with_explicit_steps_share_lanes() {
    // Three groups of four stages, 200 steps: those that fail repeat them alone.
    let in_lanes = check(ForestRuth);
    assert!(in_lanes > 3 * 3 * 200, "{in_lanes}");
}

#[test]
fn families_with_coupled_stages_share_lanes() {
    // Two groups, and five trajectories alone.
    let in_lanes = check(Gauss4);
    assert!(in_lanes > 2 * 4 * 2 * 200, "{in_lanes}");
}

#[test]
fn families_with_run_time_tableaux_share_lanes() {
    for tableau in [tableau(ForestRuth), tableau(Gauss4)] {
        let in_lanes = AtomicUsize::new(0);
        let make = |system, start| Integrator::new(tableau.clone(), system, start, 0.1);
        let expected = alone!(families(&in_lanes), make, |run| {
            (run.take_steps(200).map(|_| ()), ())
        });
        let ensemble: Result<Ensemble<RunTimeTableau, _, _, Compensated>, _> =
            Ensemble::with_summation(tableau.clone(), families(&in_lanes), 0.1);
        let ensemble = ensemble.expect("starts").in_lanes::<F64x16>();
        let mut rows: Vec<(Bits, ())> = Vec::new();
        on_threads(1, || {
            ensemble.take_steps(200, keep(&mut rows, 0));
        });
        assert_eq!(rows, expected, "{}", tableau.name());
        // Until the first of a group fails.
        let in_lanes = in_lanes.into_inner();
        assert!(in_lanes > 100, "{}: {in_lanes}", tableau.name());
    }
}
