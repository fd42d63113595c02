//! Systems with work vectors of their own, which threads cannot share.

use std::cell::Cell;

use symplectic::adaptive::{DistancePower, Logarithmic, Poincare};
use symplectic::ensemble::Ensemble;
use symplectic::nalgebra::{DVector, Vector2, Vector3};
use symplectic::variational::{self, Newmark};
use symplectic::{
    Error, Event, Integrator, Method, ProvedFor, Scalar, SeparableHamiltonian, State, System,
    Vector,
};

use crate::common::methods::{Gauss4, StoermerVerlet, Yoshida6};
use crate::systems::{HenonHeiles, Pendulums, alone, keep, on_threads, starts, words};

symplectic::hamiltonian! { Kepler { mu } q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 - mu/sqrt(x^2 + y^2) }

/// Compares ends, states at times and the work of closures with single runs. Each start has the system of its number by `system`.
fn check<M, S, V>(method: M, system: impl Fn(usize) -> S, starts: &[State<V>], size: f64)
where
    M: Method + Copy + ProvedFor<S::Class>,
    S: System<V> + Clone + Send,
    V: Vector<Scalar = f64> + Send + Sync,
{
    let families = || (0..starts.len()).map(|k| (system(k), vec![starts[k].clone()]));
    let one = || [(system(0), starts.to_vec())];
    let one_by_one = |system: &dyn Fn(usize) -> S| {
        let run = |k: usize| {
            let make = |start| Integrator::new(method, system(k), start, size);
            let steps = |run: &mut Integrator<M, S, V>| (run.take_steps(9).map(|_| ()), ());
            alone(&starts[k..=k], make, steps)
        };
        (0..starts.len()).flat_map(run).collect::<Vec<_>>()
    };
    let threads: &[usize] = match cfg!(feature = "parallel") {
        true => &[1, 2, 5],
        false => &[1],
    };
    for &threads in threads {
        let take_steps = |ensemble: Ensemble<M, S, V>| {
            on_threads(threads, move || {
                let mut rows = Vec::new();
                ensemble.take_steps(9, keep(&mut rows, 0));
                rows
            })
        };
        let ensemble = Ensemble::of_families(method, one(), size).expect("starts");
        assert_eq!(take_steps(ensemble), one_by_one(&|_| system(0)));
        let ensemble = Ensemble::of_families(method, families(), size).expect("starts");
        assert_eq!(take_steps(ensemble), one_by_one(&system));

        let times = [0.0, 2.5, 4.0].map(|steps| starts[0].time + steps * size);
        let seen = |run: &mut Integrator<M, S, V>| {
            let mut seen = Vec::new();
            let outcome = run.integrate_at(&times, |state| seen.push(words(state)));
            (outcome.map(|_| ()), seen)
        };
        let make = |start| Integrator::new(method, system(0), start, size);
        let expected = alone(starts, make, seen);
        let ensemble = || Ensemble::of_families(method, one(), size).expect("starts");
        let (at_times, each) = (ensemble(), ensemble());
        let found = on_threads(threads, move || {
            let mut rows = Vec::new();
            let see = |seen: &mut Vec<_>, state: &State<V>| seen.push(words(state));
            at_times.integrate_at(&times, |_| Vec::new(), see, keep(&mut rows, 0));
            rows
        });
        assert_eq!(found, expected);
        let found = on_threads(threads, move || {
            let mut rows = Vec::new();
            let work = |output: &mut Vec<_>, run: &mut Integrator<M, S, V>| {
                let (outcome, seen) = seen(run);
                *output = seen;
                outcome
            };
            each.each(|_| Vec::new(), work, keep(&mut rows, 0));
            rows
        });
        assert_eq!(found, expected);
    }
}

/// Numbers of trajectories below, at and above those of full lanes.
const COUNTS: [usize; 4] = [1, 7, 16, 17];

/// Pericentres, of orbits of different eccentricities.
fn pericentre(k: usize) -> State<Vector2<f64>> {
    let e = 0.05 * k as f64;
    State::from_arrays(0.0, [1.0 - e, 0.0], [0.0, ((1.0 + e) / (1.0 - e)).sqrt()])
}

fn kepler(k: usize) -> Kepler {
    Kepler {
        mu: 1.0 + 0.01 * k as f64,
    }
}

#[test]
fn newmark_in_ensembles_has_the_bits_of_single_runs() -> Result<(), variational::Error> {
    let newmark = |k: usize| {
        let amplitude = 0.01 * k as f64;
        Newmark::new(HenonHeiles { amplitude }, 0.25, 0.1).expect("a shift")
    };
    for count in COUNTS {
        let starts = starts(count, 100);
        let shifted: Result<Vec<_>, _> =
            starts.iter().map(|start| newmark(0).shift(start)).collect();
        check(StoermerVerlet, newmark, &shifted?, 0.1);
    }
    let pendulums = |_| Newmark::new(Pendulums, 0.25, 0.1).expect("a shift");
    let start = |k: usize| {
        State::new(
            0.0,
            DVector::from_element(5, 0.1 * k as f64),
            DVector::from_element(5, 0.3),
        )
    };
    check(
        StoermerVerlet,
        pendulums,
        &Vec::from_iter((0..17).map(start)),
        0.1,
    );
    Ok(())
}

#[test]
fn logarithmic_in_ensembles_has_the_bits_of_single_runs() -> Result<(), symplectic::adaptive::Error>
{
    let logarithmic = |k| Logarithmic::new(kepler(k));
    for count in COUNTS {
        let extend = |k| logarithmic(0).extend::<Vector3<f64>>(&pericentre(k));
        let starts: Result<Vec<_>, _> = (0..count).map(extend).collect();
        check(Yoshida6, logarithmic, &starts?, 0.05);
    }
    Ok(())
}

#[test]
fn poincare_in_ensembles_has_the_bits_of_single_runs() -> Result<(), symplectic::adaptive::Error> {
    let poincare = |k| Poincare::new(kepler(k), DistancePower(1.5));
    for count in COUNTS {
        let extend = |k| poincare(0).extend::<Vector3<f64>>(&pericentre(k));
        let starts: Result<Vec<_>, _> = (0..count).map(extend).collect();
        check(Gauss4, poincare, &starts?, 0.05);
    }
    Ok(())
}

#[test]
fn a_failed_step_of_a_transformed_system_in_an_ensemble_names_its_own_cause() {
    // The third start escapes: U is positive there.
    symplectic::hamiltonian! { Shifted q: [x], p: [px]; H = px^2/2 + x - 1 }
    let logarithmic = Logarithmic::new(Shifted);
    let start = |speed: f64| {
        let start = State::from_arrays(0.0, [0.0], [speed]);
        logarithmic.extend::<Vector2<f64>>(&start).expect("a start")
    };
    let starts = Vec::from_iter([0.0, 0.1, 9.0, 0.2].map(start));
    let make = |start| Integrator::new(StoermerVerlet, logarithmic.clone(), start, 0.1);
    let expected = alone(&starts, make, |run| (run.take_steps(20).map(|_| ()), ()));
    let ensemble = Ensemble::new(StoermerVerlet, logarithmic.clone(), starts, 0.1);
    let ensemble = ensemble.expect("starts");
    let mut rows = Vec::new();
    ensemble.take_steps(20, keep(&mut rows, 0));
    assert_eq!(rows, expected);
    let failed = |(bits, ()): &(crate::systems::Bits, ())| {
        matches!(bits.outcome, Err(Error::LogarithmicDomain { .. }))
    };
    assert!(rows.iter().any(failed) && !rows.iter().all(failed));
}

/// A system by hand that counts its forces in a cell.
#[derive(Clone, Debug, Default)]
struct Counting(Cell<u64>);

impl SeparableHamiltonian for Counting {
    type Vector<T: Scalar> = Vector2<T>;

    fn velocity<T: Scalar>(&self, _time: T, p: &Vector2<T>, velocity: &mut Vector2<T>) {
        *velocity = *p;
    }

    fn force<T: Scalar>(&self, _time: T, q: &Vector2<T>, force: &mut Vector2<T>) {
        self.0.set(self.0.get() + 1);
        *force = -*q;
    }
}

#[test]
fn a_system_with_a_cell_runs_in_lanes_on_all_threads() {
    check(
        StoermerVerlet,
        |_| Counting::default(),
        &starts(1030, 50),
        0.1,
    );
}

#[test]
fn the_work_of_an_ensemble_finds_events_of_a_transformed_system() {
    let logarithmic = Logarithmic::new(kepler(0));
    let extend = |k| {
        logarithmic
            .extend::<Vector3<f64>>(&pericentre(k))
            .expect("a start")
    };
    let starts: Vec<_> = (0..17).map(extend).collect();
    let find = |run: &mut Integrator<Yoshida6, Logarithmic<Kepler>, Vector3<f64>>| {
        let arrival = Event::rising(|state: &State<Vector3<f64>>| state.q[2] - 6.0).by_steps();
        run.find_event(100.0, &arrival)
            .map(|found| found.map(|state| words(&state)))
    };
    let make = |start| Integrator::new(Yoshida6, logarithmic.clone(), start, 0.05);
    let expected = alone(&starts, make, |run| (Ok(()), find(run).expect("an event")));
    let ensemble = Ensemble::new(Yoshida6, logarithmic.clone(), starts, 0.05).expect("starts");
    let mut rows = Vec::new();
    let work = |output: &mut Option<_>, run: &mut Integrator<_, _, _>| {
        *output = find(run)?;
        Ok(())
    };
    ensemble.each(|_| None, work, keep(&mut rows, 0));
    assert_eq!(rows, expected);
}

#[test]
fn families_across_the_shares_of_threads_have_the_bits_of_single_runs() {
    symplectic::hamiltonian! { Pendulum { length } q: [a], p: [pa]; H = pa^2/2 - length cos(a) }
    let system = |k: usize| Pendulum {
        length: 1.0 + 0.001 * k as f64,
    };
    // Another start time shifts the groups against the shares.
    let time = |k| if k == 3 { 1.0 } else { 0.0 };
    let start = |k: usize| State::from_arrays(time(k), [0.001 * k as f64], [0.1]);
    let starts = Vec::from_iter((0..1100).map(start));
    check(StoermerVerlet, system, &starts, 0.1);
}
