//! What Newton's iteration finds out from a formula by itself: exact second derivatives, and how wide their band is.

// Crates that forbid this compile: the code of a formula allows nothing of the kind.
#![forbid(dead_code)]

use symplectic::nalgebra::{DVector, SMatrix, SVector};
use symplectic::solver::{
    AnalyticOrDifferences, Banded, ByNewton, Dense, Derivatives, Differences, DualNumbers, Newton,
    Solver, SystemInDuals,
};
use symplectic::system::Jacobian;
use symplectic::{Error, Integrator, Scalar, State, System, Vector};
use symplectic_tests::counted::{Counted, operations};
use symplectic_tests::counting::{Counting, Counts};
use symplectic_tests::formulas;
use symplectic_tests::methods::{Gauss2, Gauss3, Lobatto3};

mod systems {
    symplectic::hamiltonian! {
        /// A ring of particles with masses of their own, which is no chain of the runtime.
        pub Necklace { m: [..] }
        q: [..], p: [..]; bonds: ring;
        H = sum(i: p[i]^2/(2 m[i])) + sum(bonds d: d^2/2 + d^4/4)
    }

    symplectic::hamiltonian! {
        /// The same between walls.
        pub Beads { m: [..], k: 1 }
        q: [..], p: [..]; bonds: walls;
        H = sum(i: p[i]^2/(2 m[i])) + sum(bonds d: k d^2/2 + d^4/4)
    }

    symplectic::hamiltonian! {
        /// Particles on a string in space.
        pub String<N> { k: 100 }
        q: [N; 3], p: [N; 3];
        H = sum(i: |p[i]|^2/2) + sum(i in 0..N-1: k (|q[i+1] - q[i]| - 1)^2/2 + q[i][2])
    }

    symplectic::hamiltonian! {
        /// Neighbours in the first component only.
        pub Rails<N>
        q: [N; 2], p: [N; 2];
        H = sum(i: |p[i]|^2/2 + q[i][1]^4) + sum(i in 0..N-1: (q[i+1][0] - q[i][0])^4)
    }

    symplectic::hamiltonian! {
        /// Neighbours up to the third, in an inner sum, and momenta that feel positions.
        pub Ladder<N> { k: 10 }
        q: [N], p: [N];
        H = sum(i: (1 + q[i]^2) p[i]^2/2) + sum(i in 0..N-3: sum(j in i+1..i+4: k (q[j] - q[i])^2/2))
    }

    symplectic::hamiltonian! {
        /// The first and the last of five, and neighbours.
        pub Five
        q: [5], p: [5];
        H = |p|^2/2 + (q[0] - q[3])^4 + sum(i in 2..4: q[i]^2 q[i+1]^2) + sum(i in 0..2: q[i]^4) q[2]
    }

    symplectic::hamiltonian! {
        /// Springs between particles, from data.
        pub Molecule { springs: pairs, stiffness: [springs] }
        q: [..; 2], p: [..; 2];
        H = sum(i: |p[i]|^2/2) + sum(s = (i, j) in springs: stiffness[s] (|q[i] - q[j]|^2 - 1)^2/2)
    }

    symplectic::hamiltonian! {
        /// A chain of springs that stiffen, in a valley, with a force that depends on time.
        pub Valley { k: 100 }
        q: [..], p: [..]; bonds: free;
        H = sum(i: p[i]^2/2 + q[i]^4/4 - q[i] sin(t)) + sum(bonds d: k d^2/2 + d^4/4)
        require: [chain]
    }
}

/// `n` numbers between 0 and 2, in which neighbours differ.
fn numbers<T: Scalar>(n: usize, phase: f64) -> Vec<T> {
    let number = |i: usize| (i % 8) as f64 / 4.0 + 0.1 * (phase + 1.7 * (i * i) as f64).sin();
    (0..n).map(|i| T::from_f64(number(i))).collect()
}

fn vector<V: Vector>(n: usize, phase: f64) -> V {
    V::from_slice(&numbers(n, phase)).expect("as many components")
}

fn start<V: Vector>(n: usize) -> State<V> {
    State::new(0.0, vector(n, 0.3), vector(n, 1.1))
}

/// The second derivatives are those by dual numbers, and the half bandwidth is the smallest one that holds them.
fn known<V, S>(system: &S, n: usize, half_bandwidth: usize)
where
    V: Vector<Scalar = f64>,
    S: SystemInDuals<V>,
{
    let (q, p) = (vector::<V>(n, 0.3), vector::<V>(n, 1.1));
    let mut dual = Jacobian::new(n, n);
    let mut memory = <DualNumbers as Derivatives<V, S>>::memory(&q);
    <DualNumbers as Derivatives<V, S>>::evaluate(&mut memory, system, 0.3, &q, &p, &mut dual);
    let band = System::<V>::half_bandwidth(system);
    let mut exact = Jacobian::new(n, band);
    assert!(System::<V>::second_derivatives(
        system, 0.3, &q, &p, &mut exact
    ));
    let mut widest = 0;
    let mut compare = |exact: f64, dual: f64, i: usize, k: usize| {
        let error = (exact - dual).abs();
        assert!(
            error <= 1e-12 * dual.abs().max(1.0),
            "({i}, {k}): {exact:e} for {dual:e}"
        );
        if dual != 0.0 {
            widest = i.abs_diff(k).max(widest);
        }
    };
    for i in 0..n {
        for k in 0..n {
            let velocities = [&exact, &dual].map(|j| j.velocity_by_momentum.get(i, k));
            let mixed = [&exact, &dual].map(|j| j.velocity_by_position.get(i, k));
            let forces = [&exact, &dual].map(|j| j.force_by_position.get(i, k));
            for [exact, dual] in [velocities, mixed, forces] {
                compare(exact, dual, i, k);
            }
        }
    }
    assert_eq!((widest, band), (half_bandwidth.min(n - 1), half_bandwidth));
}

#[test]
fn second_derivatives_are_exact_and_in_the_narrowest_band() {
    const ALL: usize = usize::MAX;
    known::<SVector<f64, 2>, _>(&formulas::DoublePendulum::default(), 2, 1);
    known::<SVector<f64, 1>, _>(&formulas::Pendulum, 1, 0);
    known::<SMatrix<f64, 3, 6>, _>(&formulas::Planets::new([1.0; 6]), 18, ALL);
    known::<DVector<f64>, _>(&formulas::FputChain, 12, 1);
    known::<DVector<f64>, _>(&formulas::SineGordon::default(), 12, ALL);
    known::<DVector<f64>, _>(&systems::Valley::default(), 12, 1);
    known::<DVector<f64>, _>(&systems::Necklace::new(vec![2.0; 12]), 12, ALL);
    known::<DVector<f64>, _>(&systems::Beads::new(vec![2.0; 12]), 12, 1);
    known::<SMatrix<f64, 3, 6>, _>(&systems::String::<6>::default(), 18, 5);
    known::<SVector<f64, 5>, _>(&systems::Five, 5, 3);
    known::<SMatrix<f64, 2, 6>, _>(&systems::Rails::<6>, 12, 2);
    known::<SVector<f64, 12>, _>(&systems::Ladder::<12>::default(), 12, 3);
    for (springs, half_bandwidth) in [(vec![(0, 1), (1, 2), (4, 3)], 3), (vec![(0, 1), (1, 4)], 7)]
    {
        let stiffness = vec![2.0; springs.len()];
        let molecule = systems::Molecule::new(springs, stiffness);
        known::<DVector<f64>, _>(&molecule, 10, half_bandwidth);
    }
    // Of no pairs, the components of a particle.
    let nothing = systems::Molecule::new(vec![], vec![]);
    assert_eq!(System::<DVector<f64>>::half_bandwidth(&nothing), 1);
}

/// A run with this solver: its end, its statistics, and the evaluations of velocity and force.
fn run<V, S, N>(
    system: S,
    dimension: usize,
    solver: N,
) -> Result<(State<V>, symplectic::Statistics, u64), Error>
where
    V: Vector<Scalar = f64>,
    S: System<V, Class = symplectic::Separable>,
    N: for<'a> Solver<V, Counting<'a, S>>,
{
    let counts = Counts::default();
    let system = Counting::new(system, &counts);
    let mut run = Integrator::new(Gauss3, system, start(dimension), 0.05)?.with_solver(solver);
    let before = counts.velocities() + counts.forces();
    run.take_steps(40)?;
    let evaluations = counts.velocities() + counts.forces() - before;
    Ok((run.state().clone(), *run.statistics(), evaluations))
}

#[test]
fn newton_of_a_formula_makes_no_evaluations_for_differences() -> Result<(), Error> {
    fn check<V, S>(system: impl Fn() -> S, n: usize) -> Result<(), Error>
    where
        V: Vector<Scalar = f64>,
        S: System<V, Class = symplectic::Separable>,
    {
        let (end, statistics, evaluations) = run::<V, S, Newton>(system(), n, Newton::new())?;
        assert!(statistics.factorisations > 0);
        assert_eq!(evaluations, statistics.evaluations);
        // Differences take more evaluations, and end at the same place.
        let differences = Newton::<Dense<Differences>>::new();
        let (other, by_differences, evaluations) = run::<V, S, _>(system(), n, differences)?;
        assert!(evaluations > by_differences.evaluations);
        assert!(10 * statistics.iterations <= 11 * by_differences.iterations);
        let pairs = end.q.as_slice().iter().zip(other.q.as_slice());
        for (q, other) in pairs {
            // Rounding errors of 40 steps, which grow.
            assert!((q - other).abs() < 1e-9 * (1.0 + q.abs()), "{q} {other}");
        }
        Ok(())
    }
    let spring = || formulas::SpringPendulum { omega: 1e3 };
    check::<SVector<f64, 2>, _>(spring, 2)?;
    check::<DVector<f64>, _>(|| systems::Valley { k: 1e6 }, 12)?;
    check::<SMatrix<f64, 3, 5>, _>(|| systems::String { k: 1e3 }, 15)?;
    check::<DVector<f64>, _>(|| formulas::SineGordon { stiffness: 1e5 }, 12)
}

#[test]
fn bands_are_full_matrices_to_rounding() -> Result<(), Error> {
    macro_rules! check {
        ($method:ident, $system:expr => $vector:ty, $n:expr) => {
            let run = || Integrator::new($method, $system, start::<$vector>($n), 0.001);
            let full = Newton::<Dense<AnalyticOrDifferences>>::new();
            let (mut band, mut full) = (run()?.by_newton(), run()?.with_solver(full));
            for _ in 0..50 {
                let (band, full) = (band.step()?, full.step()?);
                let error = (&band.q - &full.q).norm() / full.q.norm();
                assert!(error < 1e-12, "{}: {error:e}", stringify!($system));
            }
            assert_eq!(
                band.statistics().iterations,
                full.statistics().iterations,
                "{}",
                stringify!($system)
            );
        };
    }
    check!(Gauss3, systems::Valley { k: 1e5 } => DVector<f64>, 20);
    check!(Lobatto3, systems::Valley { k: 100.0 } => DVector<f64>, 20);
    check!(Gauss2, systems::Ladder { k: 1e4 } => SVector<f64, 20>, 20);
    check!(Gauss3, systems::String { k: 1e4 } => SMatrix<f64, 3, 6>, 18);
    check!(Gauss3, systems::Beads { m: vec![2.0; 20], k: 1e4 } => DVector<f64>, 20);
    let springs = || vec![(0, 1), (3, 2), (3, 4)];
    check!(Gauss3, systems::Molecule::new(springs(), vec![1e3; 3]) => DVector<f64>, 10);
    Ok(())
}

/// A chain of 1000 particles costs ten times the operations of a chain of 100. With full matrices it costs more.
#[test]
fn long_chains_cost_linear_time() {
    let step = |n: usize, full: bool| {
        let start = start::<DVector<Counted>>(n);
        let run = Integrator::new(Gauss3, systems::Valley { k: 1e4 }, start, 0.1);
        let run = run.expect("a start");
        operations(|| {
            let taken = match full {
                true => {
                    let full = Newton::<Dense<AnalyticOrDifferences>>::new();
                    run.with_solver(full).step().map(|_| ())
                }
                false => run.by_newton().step().map(|_| ()),
            };
            taken.expect("a step");
        }) as f64
    };
    let (short, long) = (step(100, false), step(1000, false));
    // The number of sweeps differs by one.
    assert!((8.0..10.5).contains(&(long / short)), "{short} {long}");
    // The negative twin.
    let (short, long) = (step(20, true), step(40, true));
    assert!(long / short > 3.0, "{short} {long}");
}

/// The negative twin: the neighbours are what makes the iteration converge.
#[test]
fn a_band_that_is_too_narrow_does_not_converge() -> Result<(), Error> {
    let system = systems::Valley { k: 1e6 };
    let run = || Integrator::new(Gauss3, system, start::<DVector<f64>>(12), 0.1);
    run()?.by_newton().take_steps(10)?;
    let narrow = Newton::<Banded<0, AnalyticOrDifferences>>::new();
    assert!(run()?.with_solver(narrow).take_steps(10).is_err());
    Ok(())
}
