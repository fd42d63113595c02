//! Systems for every scalar, and what comes of their trajectories alone.

use std::fmt::Debug;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

use symplectic::ensemble::Row;
use symplectic::nalgebra::{DVector, SVector, Vector2};
use symplectic::system::Masses;
use symplectic::{
    Error, Hamiltonian, Integrator, Scalar, SeparableHamiltonian, State, Statistics, Vector,
};

/// H = |p|²/2 + |q|²/2 + x²y − y³/3 + a x cos 3t: beyond the energy 1/6 trajectories escape to infinity, in a finite time.
#[derive(Clone, Copy, Debug)]
pub struct HenonHeiles {
    pub amplitude: f64,
}

impl SeparableHamiltonian for HenonHeiles {
    type Vector<T: Scalar> = SVector<T, 2>;

    const MASSES: Masses = Masses::Unit;

    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
        *velocity = *p;
    }

    fn force<T: Scalar>(&self, time: T, q: &SVector<T, 2>, force: &mut SVector<T, 2>) {
        let (x, y) = (q[0], q[1]);
        let drive = (time * T::from_f64(3.0)).cos() * T::from_f64(self.amplitude);
        force[0] = -x - (x + x) * y - drive;
        force[1] = y * y - x * x - y;
    }
}

/// H = Σ p²/2 + (1 − cos q), of any dimension.
#[derive(Clone, Copy, Debug)]
pub struct Pendulums;

impl SeparableHamiltonian for Pendulums {
    type Vector<T: Scalar> = DVector<T>;

    fn velocity<T: Scalar>(&self, _time: T, p: &DVector<T>, velocity: &mut DVector<T>) {
        velocity.copy_from(p);
    }

    fn force<T: Scalar>(&self, _time: T, q: &DVector<T>, force: &mut DVector<T>) {
        force.zip_apply(q, |force, q| *force = -q.sin());
    }
}

/// A system that counts the forces evaluated in sixteen lanes. Only trajectories have so many: stages have at most eight.
#[derive(Debug)]
pub struct Counted<'a, S> {
    pub system: S,
    pub in_lanes: &'a AtomicUsize,
}

impl<S: Clone> Clone for Counted<'_, S> {
    fn clone(&self) -> Self {
        Self {
            system: self.system.clone(),
            in_lanes: self.in_lanes,
        }
    }
}

impl<S: Hamiltonian> Hamiltonian for Counted<'_, S> {
    type Class = S::Class;
    type Vector<T: Scalar> = S::Vector<T>;

    const MASSES: Masses = S::MASSES;

    fn velocity<T: Scalar>(
        &self,
        time: T,
        q: &S::Vector<T>,
        p: &S::Vector<T>,
        velocity: &mut S::Vector<T>,
    ) {
        self.system.velocity(time, q, p, velocity);
    }

    fn force<T: Scalar>(
        &self,
        time: T,
        q: &S::Vector<T>,
        p: &S::Vector<T>,
        force: &mut S::Vector<T>,
    ) {
        let is_counted = size_of::<T>() == 16 * size_of::<f64>();
        self.in_lanes
            .fetch_add(usize::from(is_counted), Ordering::Relaxed);
        self.system.force(time, q, p, force);
    }
}

/// Starts of [`HenonHeiles`]: the first few stay, each `escape`-th of the others leaves.
pub fn starts(count: usize, escape: usize) -> Vec<State<Vector2<f64>>> {
    let start = |k: usize| {
        let phase = 0.7 * k as f64;
        let speed = if k % escape == escape - 1 {
            0.9 + 0.01 * k as f64
        } else {
            0.3
        };
        State::from_arrays(
            0.5,
            [0.1 * phase.sin(), 0.1 * phase.cos()],
            [0.1, speed * (1.0 + 0.001 * k as f64)],
        )
    };
    (0..count).map(start).collect()
}

/// Calls `work` with this number of threads, if there are threads.
pub fn on_threads<T: Send>(count: usize, work: impl FnOnce() -> T + Send) -> T {
    #[cfg(feature = "parallel")]
    {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
        pool.expect("threads").install(work)
    }
    #[cfg(not(feature = "parallel"))]
    {
        let _ = count;
        work()
    }
}

/// What came of a trajectory, in bits.
#[derive(Clone, PartialEq)]
pub struct Bits<E = Error> {
    pub outcome: Result<(), E>,
    words: Vec<u64>,
    statistics: Statistics,
}

impl Bits {
    /// Number of failed attempts at a step.
    pub fn rejected(&self) -> u64 {
        self.statistics.rejected
    }
}

impl<E: Debug> Debug for Bits<E> {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{:?} {:x?}", self.outcome, self.words)
    }
}

/// The words of a state.
pub fn words<V: Vector<Scalar = f64>>(state: &State<V>) -> Vec<u64> {
    let (q, p) = state.as_slices();
    let numbers = [&[state.time], q, p].concat();
    numbers.into_iter().map(f64::to_bits).collect()
}

pub fn bits<V: Vector<Scalar = f64>, E>(
    outcome: Result<(), E>,
    state: &State<V>,
    statistics: &Statistics,
) -> Bits<E> {
    Bits {
        outcome,
        words: words(state),
        statistics: *statistics,
    }
}

/// Keeps rows in bits, whose numbers come one after another from the first one.
pub fn keep<V: Vector<Scalar = f64>, A, E>(
    rows: &mut Vec<(Bits<E>, A)>,
    first: usize,
) -> impl FnMut(Row<V, A, E>) -> ControlFlow<()> {
    move |row| {
        assert_eq!(row.trajectory, first + rows.len());
        rows.push((bits(row.outcome, &row.state, &row.statistics), row.output));
        ControlFlow::Continue(())
    }
}

/// What comes of each start alone, in an integrator that `make` makes and `run` runs.
pub fn alone<M, S, V, R, N, A>(
    starts: &[State<V>],
    make: impl Fn(State<V>) -> Result<Integrator<M, S, V, R, N>, Error>,
    run: impl Fn(&mut Integrator<M, S, V, R, N>) -> (Result<(), Error>, A),
) -> Vec<(Bits, A)>
where
    M: symplectic::Method,
    S: symplectic::System<V>,
    V: Vector<Scalar = f64>,
    R: symplectic::Summation,
    N: symplectic::emitted::Solver<V, S>,
{
    let one = |start: &State<V>| {
        let mut integrator = make(start.clone()).expect("a start");
        let (outcome, output) = run(&mut integrator);
        let found = bits(outcome, integrator.state(), integrator.statistics());
        (found, output)
    };
    starts.iter().map(one).collect()
}
