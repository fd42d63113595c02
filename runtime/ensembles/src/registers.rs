//! Tests: trajectories in the registers of the processor, beside the lanes of the build.

use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;
use core::ops::ControlFlow;
use core::sync::atomic::{AtomicUsize, Ordering};

use crate::Ensemble;
use symplectic_core::inside::{Avx2, Avx512, Widest, may_be_found, width};
use symplectic_core::simd::DefaultLanes;
use symplectic_core::system::Masses;
use symplectic_core::{
    Compensated, Method, Plain, ProvedFor, Scalar, Separable, SeparableHamiltonian, State,
    Summation, System,
};

use symplectic::at_run_time::RunTimeTableau;
use symplectic::tangent::Tangent;

symplectic::tableau! {
    Verlet { base: velocity-verlet }
    Gauss4 { basis: polynomial(4), nodes: gauss(4) }
    Lobatto3 { basis: polynomial(3), nodes: lobatto(3) }
}
// Above the energy 1/6 trajectories escape to infinity in a finite time.
symplectic::hamiltonian! {
    Escaping
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + (x^2 + y^2)/2 + x^2 y - y^3/3 + 0.02 x cos(3 t)
}
symplectic::hamiltonian! {
    Pendulum { length, mass }
    q: [x, y], p: [px, py];
    H = (px^2/mass + py^2/(2 mass))/2 - mass cos(x/length) + exp(x y - y^2)
}
symplectic::hamiltonian! {
    Turning
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/(2 + x^2) + y^2 - cos(x) + 0.1 px sin(y)
}

symplectic::hamiltonian! {
    Driven { rate }
    q: [x], p: [px];
    H = px^2/2 - cos(x) + exp(-x^2)/(1 + x^2) + 0.02 x cos(rate t)
}

type Point = nalgebra::Vector2<f64>;

fn starts(count: usize) -> Vec<State<Point>> {
    let start = |k: usize| {
        let speed = if k % 11 == 10 {
            1.1
        } else {
            0.2 + 0.01 * k as f64
        };
        State::from_arrays(0.5, [0.1, 0.02 * k as f64 % 0.2], [0.1, speed])
    };
    (0..count).map(start).collect()
}

fn words(state: &State<Point>) -> [u64; 5] {
    let [[a, b], [c, d]] = [state.q, state.p].map(<[f64; 2]>::from);
    [state.time, a, b, c, d].map(f64::to_bits)
}

/// Ends and outputs of all trajectories, with their errors.
fn rows<M, S, R>(ensemble: &Ensemble<M, S, Point, R>) -> Vec<String>
where
    M: Method,
    S: System<Point> + Clone + Send,
    R: Summation,
{
    let mut rows = Vec::new();
    ensemble.integrate_to(9.3, |row| {
        rows.push(format!(
            "{:?}",
            (row.outcome, row.statistics, words(&row.state))
        ));
        ControlFlow::Continue(())
    });
    let see = |seen: &mut Vec<_>, state: &State<Point>| seen.push(words(state));
    ensemble.integrate_at(
        &[0.5, 0.55, 2.31, 2.32, 7.0],
        |_| Vec::new(),
        see,
        |row| {
            rows.push(format!("{:?}", (row.outcome, row.output)));
            ControlFlow::Continue(())
        },
    );
    rows
}

/// Compares the rows in all registers of this processor with those of single trajectories.
fn compare<M, S, R>(make: impl Fn() -> Ensemble<M, S, Point, R>)
where
    M: Method,
    S: System<Point> + Clone + Send,
    R: Summation,
{
    let alone = rows(&make().one_by_one());
    let found = make();
    if may_be_found::<Point, S>() && Avx512::detect().is_some() {
        assert!(matches!(found.registers, Widest::Avx512(_)));
    }
    assert_eq!(rows(&found), alone, "{}", M::NAME);
    let mut narrower = make();
    if let Some(avx2) = Avx2::detect() {
        narrower.registers = Widest::Avx2(avx2);
        // With coupled stages too.
        narrower.lanes = crate::Wanted::Yes;
        assert_eq!(rows(&narrower), alone, "{}, AVX2", M::NAME);
    }
}

fn check<M, S, R>(method: M, families: &[(S, Vec<State<Point>>)])
where
    M: Method + ProvedFor<S::Class>,
    S: System<Point> + Clone + Send,
    R: Summation,
{
    compare(|| {
        Ensemble::<M, S, Point, R>::with_summation(method.clone(), families.iter().cloned(), 0.1)
            .expect("starts")
    });
}

#[test]
#[ignore = "thorough"]
fn trajectories_have_the_same_bits_in_all_registers() {
    let one = [(Escaping, starts(37))];
    check::<_, _, Plain>(Verlet, &one);
    check::<_, _, Compensated>(Verlet, &one);
    check::<_, _, Plain>(Gauss4, &one);
    check::<_, _, Compensated>(Lobatto3, &one);
    let pendulum = |k: usize| {
        let (length, mass) = (1.0 + 0.1 * k as f64, 2.0 - 0.05 * k as f64);
        (Pendulum { length, mass }, starts(1))
    };
    let many: Vec<_> = (0..21).map(pendulum).collect();
    check::<_, _, Compensated>(Verlet, &many);
    check::<_, _, Compensated>(Gauss4, &many);
    let turning = [(Turning, starts(19))];
    check::<_, _, Plain>(Gauss4, &turning);
    check::<_, _, Compensated>(Gauss4, &turning);
}

#[test]
fn tangents_have_the_same_bits_in_all_registers() {
    let growing = [(Tangent::new(Driven { rate: 2.0 }), starts(37))];
    check::<_, _, Plain>(Verlet, &growing);
    check::<_, _, Compensated>(Verlet, &growing);
    check::<_, _, Compensated>(Gauss4, &growing);
}

#[test]
fn run_time_tableaux_have_the_same_bits_in_all_registers() {
    fn tableau<M: Method>(_method: M) -> RunTimeTableau {
        let coefficients = M::COEFFICIENTS.into();
        RunTimeTableau::new(M::NAME, &coefficients, M::ORDERS).expect(M::NAME)
    }
    for tableau in [tableau(Verlet), tableau(Gauss4), tableau(Lobatto3)] {
        compare::<RunTimeTableau, _, Compensated>(|| {
            Ensemble::new(tableau.clone(), Escaping, starts(37), 0.1).expect("starts")
        });
    }
}

/// H = p²/2 + q²/2; counts the evaluations of the force by the size of the number type.
#[derive(Clone, Copy)]
struct Counting<'a>(&'a Counts);

/// The number of forces, by the size of their numbers.
type Counts = [AtomicUsize; 257];

fn counts() -> Counts {
    core::array::from_fn(|_| AtomicUsize::new(0))
}

impl SeparableHamiltonian for Counting<'_> {
    type Vector<T: Scalar> = nalgebra::SVector<T, 2>;

    const MASSES: Masses = Masses::Unit;
    const INLINED: bool = true;

    #[inline(always)]
    fn velocity<T: Scalar>(&self, _time: T, p: &Self::Vector<T>, velocity: &mut Self::Vector<T>) {
        *velocity = *p;
    }

    #[inline(always)]
    fn force<T: Scalar>(&self, _time: T, q: &Self::Vector<T>, force: &mut Self::Vector<T>) {
        self.0[size_of::<T>()].fetch_add(1, Ordering::Relaxed);
        (force[0], force[1]) = (-q[0], -q[1]);
    }
}

/// The force evaluations in eight and in sixteen lanes, for 32 trajectories of 50 steps.
fn forces<M: Method + ProvedFor<Separable>>(method: M, avx2: bool) -> [usize; 2] {
    let counts = counts();
    let ensemble = Ensemble::plain(method, Counting(&counts), starts(32), 0.1);
    let mut ensemble = ensemble.expect("starts");
    if avx2 {
        ensemble.registers = Avx2::detect().map_or(Widest::Build, Widest::Avx2);
    }
    ensemble.take_steps(50, |_| ControlFlow::Continue(()));
    [64, 128].map(|size| counts[size].load(Ordering::Relaxed))
}

#[test]
fn a_group_is_compared_with_doubles_at_one_start_after_the_first_group() {
    let counts = counts();
    let ensemble = Ensemble::plain(Verlet, Counting(&counts), starts(320), 0.1);
    let ensemble = ensemble.expect("starts");
    let before = counts[8].load(Ordering::Relaxed);
    ensemble.take_steps(5, |_| ControlFlow::Continue(()));
    let width = width::<DefaultLanes>(ensemble.registers);
    let compared = counts[8].load(Ordering::Relaxed) - before;
    assert_eq!((before, compared), (0, width + 320 / width - 1));
}

#[test]
fn tangents_run_in_the_registers_that_are_found() {
    if !may_be_found::<Point, Escaping>() || Avx512::detect().is_none() {
        return;
    }
    let counts = counts();
    let system = Tangent::new(Counting(&counts));
    let start = |k: usize| State::from_arrays(0.0, [0.1, 0.2, 1.0, 0.0], [0.0, k as f64, 0.1, 0.2]);
    let starts: Vec<State<nalgebra::Vector4<f64>>> = (0..32).map(start).collect();
    let ensemble = Ensemble::plain(Verlet, system, starts, 0.1).expect("starts");
    ensemble.take_steps(50, |_| ControlFlow::Continue(()));
    // Dual numbers of doubles, and of sixteen lanes.
    let [alone, together] = [16, 256].map(|size| counts[size].load(Ordering::Relaxed));
    assert!(
        matches!((alone, together), (0..=32, 100..150)),
        "{alone} {together}"
    );
}

#[test]
fn trajectories_run_in_the_registers_that_are_found() {
    if !may_be_found::<Point, Escaping>() {
        return;
    }
    if Avx512::detect().is_some() {
        // Two groups of sixteen.
        assert!(matches!(forces(Verlet, false), [0, 100..150]));
        assert!(matches!(forces(Gauss4, false), [0, 200..5000]));
    }
    if Avx2::detect().is_some() {
        // Four groups of eight. A compiled method uses these lanes for its stages.
        assert!(matches!(forces(Verlet, true), [200..250, 0]));
        assert!(matches!(forces(Gauss4, true), [0, 0]));
    }
}
