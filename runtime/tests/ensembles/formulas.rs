//! Formulas with other parameters in each trajectory: side by side, with the bits that each has alone.

use std::cell::Cell;
use std::f64::consts::PI;

use symplectic::ensemble::Ensemble;
use symplectic::nalgebra::{DVector, Vector2, Vector3};
use symplectic::simd::F64x16;
use symplectic::{Hamiltonian, Integrator, Method, ProvedFor, Scalar, State, Vector};

use crate::common::methods::{Chin, ChinChen, ForestRuth, Gauss2, Gauss4, StoermerVerlet};
use crate::systems::{Bits, alone, keep, on_threads, words};

thread_local! {
    /// The number of evaluations in sixteen lanes.
    static IN_LANES: Cell<usize> = const { Cell::new(0) };
}

fn trough<T: Scalar>(x: T) -> T {
    x * x * T::from_f64(0.05)
}

/// The slope of the trough, which every force needs.
fn slope<T: Scalar>(x: T) -> T {
    let is_counted = size_of::<T>() == 16 * size_of::<f64>();
    IN_LANES.set(IN_LANES.get() + usize::from(is_counted));
    x * T::from_f64(0.1)
}

fn curvature<T: Scalar>(_x: T) -> T {
    T::from_f64(0.1)
}

symplectic::hamiltonian! {
    Kepler { mu, tilt: 0.01 }
    q: [x, y], p: [px, py];
    extern fn trough with slope, curvature;
    H = (px^2 + py^2)/2 - mu/sqrt(x^2 + y^2) - (sin(mu) tilt/mu) x cos(t/3) + trough(x)
}

symplectic::hamiltonian! {
    /// With functions of arrays of parameters, and a sum of them.
    Wells { depth: [3], width: [3] }
    q: [3], p: [3];
    extern fn trough with slope, curvature;
    H = |p|^2/(2 sum(i: depth[i]^2)) - sum(i: depth[i] exp(-q[i]^2/width[i])/pi) + trough(q[1])
}

symplectic::hamiltonian! {
    /// Not separable.
    Bell { a, b: 2 }
    q: [x, y], p: [px, py];
    extern fn trough with slope, curvature;
    H = (px^2 + py^2)(1 + a x^2)/2 + b (x^2 + y^4)/2 + (sqrt(a)/3) x y + trough(x)
}

symplectic::hamiltonian! {
    /// Of any number of bodies, with links from a list.
    Net { m: [..], links: pairs, k: [links] }
    q: [..], p: [..];
    extern fn trough with slope, curvature;
    H = sum(i: p[i]^2/(2 m[i])) + sum(s = (i, j) in links: k[s] (q[i] - q[j])^4/4) + sum(i: trough(q[i]))
}

symplectic::hamiltonian! {
    /// With a function of a parameter alone.
    Spring { a }
    q: [x], p: [px];
    extern fn trough with slope, curvature;
    extern fn slope with curvature, curvature;
    H = px^2/2 + slope(a) x^2/2 + trough(x)
}

mod sites {
    use super::{curvature, slope, trough};

    symplectic::hamiltonian! {
        /// With lengths that have the names of the generated code.
        pub Sites<Scalar, LaneVector, LaneScalar, LaneWork, SitesInLanes> {
            a: [Scalar], b: [LaneVector], c: [LaneScalar], d: [LaneWork], e: [SitesInLanes], a_spare_one: 1,
        }
        q: [Scalar], p: [Scalar];
        extern fn trough with slope, curvature;
        let some = sum(i in 0..LaneVector: b[i]) + sum(i in 0..LaneScalar: c[i]);
        let others = sum(i in 0..LaneWork: d[i]) + sum(i in 0..SitesInLanes: e[i]);
        H = sum(i: p[i]^2)/2 + sum(i: a[i] q[i]^2)/2 + trough(q[0]) + sqrt(2) (some + others) q[0]^2
    }
}

/// Families of systems, with their starts.
type Families<S, V> = Vec<(S, Vec<State<V>>)>;

/// Checks an ensemble against trajectories alone; returns the number of evaluations in lanes.
fn check<M, S, V>(method: M, families: &Families<S, V>, size: f64) -> usize
where
    M: Method + ProvedFor<S::Class> + Copy,
    S: Hamiltonian<Vector<f64> = V> + Clone + Send + Sync,
    V: Vector<Scalar = f64> + Send + Sync,
{
    let times = [0.0, 1.25, 3.1];
    let (mut ends, mut sights) = (Vec::new(), Vec::new());
    for (system, starts) in families {
        let make = |start| Integrator::new(method, system.clone(), start, size);
        ends.extend(alone(starts, make, |run| {
            (run.take_steps(100).map(|_| ()), ())
        }));
        sights.extend(alone(starts, make, |run| {
            let mut seen = Vec::new();
            let outcome = run.integrate_at(&times, |state| seen.push(words(state)));
            (outcome.map(|_| ()), seen)
        }));
    }
    let different = ends.windows(2).all(|pair| pair[0] != pair[1]);
    assert!(different && ends.iter().all(|(row, ())| row.outcome.is_ok()));
    let ensemble = Ensemble::of_families(method, families.clone(), size);
    let ensemble = ensemble.expect("starts").in_lanes::<F64x16>();
    let (mut rows, mut seen): (Vec<(Bits, ())>, Vec<_>) = Default::default();
    let run = || {
        IN_LANES.set(0);
        ensemble.take_steps(100, keep(&mut rows, 0));
        let see = |seen: &mut Vec<_>, state: &State<_>| seen.push(words(state));
        ensemble.integrate_at(&times, |_| Vec::new(), see, keep(&mut seen, 0));
        IN_LANES.get()
    };
    let in_lanes = on_threads(1, run);
    assert_eq!(rows, ends, "{}", M::NAME);
    assert_eq!(seen, sights, "{} at times", M::NAME);
    in_lanes
}

/// Twenty families, of which the first two have two starts: a group of sixteen and one of six, which is too small for coupled stages.
fn families<S, V>(make: impl Fn(f64) -> (S, State<V>)) -> Families<S, V>
where
    V: Vector<Scalar = f64>,
{
    let family = |k: u32| {
        let (system, start) = make(0.1 * f64::from(k));
        let mut other = start.clone();
        other.q.as_mut_slice()[0] *= 1.01;
        let both = if k < 2 {
            vec![start, other]
        } else {
            vec![start]
        };
        (system, both)
    };
    (0..20).map(family).collect()
}

fn orbits() -> Families<Kepler, Vector2<f64>> {
    families(|x| {
        let (mu, tilt) = (1.0 + x, 0.02 * x);
        let start = State::from_arrays(0.0, [1.0, 0.1], [0.0, 1.1]);
        (Kepler { mu, tilt }, start)
    })
}

#[test]
fn explicit_steps_of_formulas_have_the_bits_of_single_runs() {
    // Three or four forces a step, hundred steps, two groups, and as many at times.
    let orbits = orbits();
    assert!(check(ForestRuth, &orbits, 0.05) > 2 * 3 * 100);
    assert!(check(StoermerVerlet, &orbits, 0.02) > 2 * 2 * 100);
    // Their gradient kicks take curvatures, which are not counted.
    assert!(check(Chin, &orbits, 0.05) > 2 * 2 * 100);
    assert!(check(ChinChen, &orbits, 0.05) > 2 * 3 * 100);
    let wells = families(|x| {
        let (depth, width) = ([1.0 + x, 2.0 - 0.1 * x, PI], [2.0, 3.0 + x, 4.0]);
        let start = State::from_arrays(0.0, [0.3, 0.2, -0.1], [0.1, 0.2, 0.3]);
        (Wells { depth, width }, start)
    });
    assert!(check(ForestRuth, &wells, 0.1) > 2 * 3 * 100);
    assert!(check(ChinChen, &wells, 0.1) > 2 * 3 * 100);
    // The same with one trajectory in each group: parameters do not matter.
    let same: Families<_, Vector3<f64>> = wells.into_iter().take(1).collect();
    assert!(check(ForestRuth, &same, 0.1) > 3 * 100);
}

#[test]
fn coupled_stages_of_formulas_have_the_bits_of_single_runs() {
    let orbits = orbits();
    assert!(check(Gauss4, &orbits, 0.05) > 4 * 3 * 100);
    let bells = families(|x| {
        let start = State::from_arrays(0.0, [0.3, 0.2], [0.1, 0.5]);
        (
            Bell {
                a: 0.1 + x,
                b: 2.0 - x,
            },
            start,
        )
    });
    assert!(check(Gauss2, &bells, 0.05) > 2 * 3 * 100);
}

fn net(x: f64, links: Vec<(usize, usize)>) -> (Net, State<DVector<f64>>) {
    let k = (0..links.len()).map(|link| 1.0 + x + link as f64).collect();
    let m = vec![1.0 + x, 2.0, 3.0 - x, 1.0];
    let vector = |entries: [f64; 4]| DVector::from_row_slice(&entries);
    let start = State::new(
        0.0,
        vector([0.1, 0.5, -0.5, 1.0]),
        vector([0.3, 0.1, 0.2, 0.0]),
    );
    (Net { m, links, k }, start)
}

#[test]
fn lists_of_pairs_are_the_same_in_all_lanes() {
    let nets = families(|x| net(x, vec![(0, 1), (1, 2), (2, 3)]));
    assert!(check(ForestRuth, &nets, 0.05) > 2 * 3 * 100);
    // With other pairs, or with fewer of them, a trajectory runs alone between those in lanes.
    for other in [vec![(0, 1), (1, 2), (0, 3)], vec![(0, 1)]] {
        let mut nets = families(|x| net(x, vec![(0, 1), (1, 2), (2, 3)]));
        nets.truncate(6);
        let (system, start) = net(0.35, other);
        nets.insert(3, (system, vec![start]));
        // Two groups, four entries, three forces a step, 100 steps and 62 to the last time.
        assert!(check(ForestRuth, &nets, 0.05) >= 2 * 4 * 3 * 162);
    }
}

#[test]
fn families_with_different_pairs_do_not_share_lanes() {
    let line = vec![(0, 1), (1, 2), (2, 3)];
    for others in [
        [vec![(0, 1), (1, 2), (0, 3)], line.clone()],
        [vec![(0, 1)], vec![]],
    ] {
        // Twelve trajectories in families of four; the middle one has no starts.
        let [second, last] = others;
        let sizes = [(line.clone(), 4), (second, 4), (line.clone(), 0), (last, 4)];
        let mut count = 0;
        let nets = sizes.map(|(links, size)| {
            let (system, start) = net(0.1, links);
            let start = |k: u32| {
                let mut start = start.clone();
                start.q[0] = 0.1 + 0.01 * f64::from(k);
                start
            };
            count += size;
            (system, (count - size..count).map(start).collect())
        });
        // Three groups: see above.
        let in_lanes = check(ForestRuth, &nets.to_vec(), 0.05);
        assert!(in_lanes >= 3 * 4 * 3 * 162, "{in_lanes}");
    }
}

#[test]
fn formulas_may_name_lengths_like_the_emitted_code() {
    let sites = families(|x| {
        let mut system = sites::Sites::new([1.0 + x, 2.0], [x], [0.1, x], [0.2], [0.3; 3]);
        system.a_spare_one += x;
        (system, State::from_arrays(0.0, [0.3, 0.2], [0.1, 0.5]))
    });
    assert!(check(ForestRuth, &sites, 0.05) > 2 * 3 * 100);
}

#[test]
fn parameters_are_lanes_only_if_the_systems_differ() {
    let springs = |step: f64| {
        let spring = |k: u32| {
            let start = State::from_arrays(0.0, [0.3 + 0.01 * f64::from(k)], [0.1]);
            (
                Spring {
                    a: 10.0 + step * f64::from(k),
                },
                vec![start],
            )
        };
        (0..16).map(spring).collect::<Families<_, _>>()
    };
    let apart = check(ForestRuth, &springs(0.1), 0.05);
    let starts = springs(0.0).into_iter().flat_map(|(_, starts)| starts);
    let together = check(
        ForestRuth,
        &vec![(Spring { a: 10.0 }, starts.collect())],
        0.05,
    );
    // Slopes at x, and as many at a.
    assert!(together >= 3 * 162);
    assert_eq!(apart, 2 * together);
}
