//! Runs with coupled stages in lanes.
//!
//! A lane has the bits of its run. A run leaves its lane for a step that cannot be taken in lanes, and returns after it.

use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;
use core::marker::PhantomData;
use core::mem;

use super::stages::{LaneMemory, LaneOutcome, StepInLanes};
use super::sweeps::{FindStep, Fits};
use crate::in_lanes::{evaluations, fill};
use symplectic_core::inside::{Plan, PlanOf, StepParts, Work, step_parts_of};
use symplectic_core::num_traits::Zero;
use symplectic_core::simd::Lanes;
use symplectic_core::solver::{Outcome, Solver, Step, Stopping, WarmStart};
use symplectic_core::{Integrator, Method, Scalar, State, Summation, System, Vector};

/// Whether steps with this method and solver can be taken in lanes.
pub(crate) fn goes_in_lanes<M: Method, S: System<V>, V: Vector, N: Solver<V, S>>() -> bool {
    N::IS_AUTOMATIC && PlanOf::<M, S, V>::with_tableau(Fits) == Some(true)
}

/// The state of runs: position and momentum, their low parts, and the same at the start of the last step.
#[derive(Clone, Debug)]
struct StatesInLanes<W> {
    now: Box<[W; 4]>,
    other: Box<[W; 4]>,
}

/// Type parameters without stored values.
type Kind<M, S, V, R, N> = fn() -> (M, S, V, R, N);

/// Runs of the same system and the same step size, at the same time.
pub(crate) struct CoupledLanes<M, S, V, R, N, W: Vector, J> {
    system: J,
    linear_velocity: bool,
    stopping: Stopping,
    states: StatesInLanes<W>,
    memory: LaneMemory<W>,
    taken: Option<LaneOutcome<W::Scalar>>,
    time: f64,
    last_time: f64,
    last_size: f64,
    steps: u64,
    /// Number of steps when a run came into its lane, or was last copied from it.
    since: Vec<u64>,
    /// Number of sweeps since then.
    sweeps: W::Scalar,
    /// The largest number of sweeps of a step since then.
    most: W::Scalar,
    kind: PhantomData<Kind<M, S, V, R, N>>,
}

impl<M, S, V, R, N, W, J> CoupledLanes<M, S, V, R, N, W, J>
where
    M: Method,
    S: System<V>,
    J: System<W, Class = S::Class>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
    W: Vector<Scalar: Lanes>,
{
    /// Empty lanes for runs like this one, of a system with the parameters of each of them, in vectors like `zeros`.
    pub(crate) fn like(run: &mut Integrator<M, S, V, R, N>, system: J, zeros: &W) -> Self {
        let vectors = || Box::new(core::array::from_fn(|_| zeros.clone()));
        let StepParts {
            step_memory,
            stopping,
            ..
        } = step_parts_of(run.stepper_mut());
        let time = step_memory.state.time;
        Self {
            system,
            linear_velocity: step_memory.linear_velocity,
            stopping: *stopping,
            states: StatesInLanes {
                now: vectors(),
                other: vectors(),
            },
            memory: LaneMemory::like(&mut step_memory.memory, zeros),
            taken: None,
            time,
            last_time: time,
            last_size: 0.0,
            steps: 0,
            since: vec![0; W::Scalar::WIDTH],
            sweeps: W::Scalar::zero(),
            most: W::Scalar::zero(),
            kind: PhantomData,
        }
    }

    /// Begins runs at other states of the same time: each lane at the state that `start` returns for it. A run has to be
    /// [loaded](Self::load) before its first step in a lane.
    pub(crate) fn begin<'s>(&mut self, linear_velocity: bool, start: impl Fn(usize) -> &'s State<V>)
    where
        V: 's,
    {
        let [q, p, q_low, p_low] = &mut *self.states.now;
        fill(q, |lane| start(lane).q.as_slice());
        fill(p, |lane| start(lane).p.as_slice());
        for low in [q_low, p_low] {
            low.as_mut_slice().fill(W::Scalar::zero());
        }
        self.linear_velocity = linear_velocity;
        self.taken = None;
        (self.time, self.last_time, self.last_size) = (start(0).time, start(0).time, 0.0);
        self.since.fill(self.steps);
        (self.sweeps, self.most) = (W::Scalar::zero(), W::Scalar::zero());
    }

    /// Sets the system, with the parameters of the run in each lane.
    pub(crate) fn set_system(&mut self, system: J) {
        self.system = system;
    }

    /// Velocity and force in all lanes.
    pub(crate) fn evaluations(&self) -> [W; 2] {
        let [q, p, ..] = &*self.states.now;
        evaluations(&self.system, &State::new(self.time, q.clone(), p.clone()))
    }

    /// Whether a step may take more than one sweep: the last one is left to the run.
    pub(crate) const fn may_sweep(&self) -> bool {
        self.stopping.max_iterations > 1
    }

    /// Time of all runs in lanes.
    pub(crate) const fn time(&self) -> f64 {
        self.time
    }

    /// Copies a run into a lane; returns whether its next step, of this size, can be taken there.
    pub(crate) fn load(
        &mut self,
        lane: usize,
        run: &mut Integrator<M, S, V, R, N>,
        size: f64,
    ) -> bool {
        let step_memory = step_parts_of(run.stepper_mut()).step_memory;
        let StatesInLanes { now, other } = &mut self.states;
        let lanes = now.iter_mut().chain(other.iter_mut());
        for (lanes, numbers) in lanes.zip(step_memory.vectors()) {
            let numbers = V::Scalar::doubles(numbers.as_slice()).unwrap_or(&[]);
            for (lanes, &number) in lanes.as_mut_slice().iter_mut().zip(numbers) {
                lanes.set(lane, number);
            }
        }
        self.memory.load(lane, &mut step_memory.memory);
        let WarmStart { stages, scales, .. } = step_memory.kept;
        for (lanes, scale) in self.memory.scales.iter_mut().zip(scales) {
            lanes.set(lane, scale);
        }
        self.count_from_here(lane);
        stages && scales[0] > 0.0 && step_memory.last_size == size
    }

    /// Copies a lane into its run.
    pub(crate) fn store(&mut self, lane: usize, run: &mut Integrator<M, S, V, R, N>) {
        self.store_state(lane, run);
        let step_memory = step_parts_of(run.stepper_mut()).step_memory;
        self.memory.store(lane, &mut step_memory.memory);
        step_memory.kept = WarmStart {
            evaluation: true,
            stages: true,
            scales: self.memory.scales.map(|scale| scale.get(lane)),
        };
    }

    /// Copies the state of a lane, and its statistics, into its run, but not the stages: the run has ended.
    pub(crate) fn store_state(&mut self, lane: usize, run: &mut Integrator<M, S, V, R, N>) {
        let step_memory = step_parts_of(run.stepper_mut()).step_memory;
        let StatesInLanes { now, other } = &self.states;
        let lanes = now.iter().chain(other.iter());
        for (lanes, numbers) in lanes.zip(step_memory.vectors()) {
            let numbers = V::Scalar::doubles_mut(numbers.as_mut_slice()).unwrap_or(&mut []);
            for (lanes, number) in lanes.as_slice().iter().zip(numbers) {
                *number = lanes.get(lane);
            }
        }
        step_memory.kept = WarmStart::default();
        let steps = self.steps - self.since[lane];
        if steps > 0 {
            let counts = self.taken.map(|taken| taken.counts);
            let sweeps = self.sweeps.get(lane) as u64;
            let statistics = &mut step_memory.statistics;
            statistics.steps += steps;
            statistics.iterations += sweeps;
            let most = self.most.get(lane) as u32;
            statistics.most_iterations = statistics.most_iterations.max(most);
            if let Some(counts) = counts {
                let per_step = u64::from(counts.begin + counts.finish);
                statistics.evaluations += steps * per_step + sweeps * u64::from(counts.sweep);
            }
        }
        step_memory.state.time = self.time;
        step_memory.last_time = self.last_time;
        step_memory.last_size = self.last_size;
        self.count_from_here(lane);
    }

    /// Computes a step of the runs in the lanes `live`; returns the lanes in which it succeeds. The others are as before.
    pub(crate) fn attempt(&mut self, size: f64, live: u32) -> u32 {
        // A constant condition: ensembles with other solvers compile without this code.
        let taken = if N::IS_AUTOMATIC {
            self.take(size, live)
        } else {
            None
        };
        let Some(taken) = taken else {
            return 0;
        };
        self.taken = Some(taken);
        taken.settled & live & W::Scalar::in_registers(Finite(&self.states.other))
    }

    fn take(&mut self, size: f64, live: u32) -> Option<LaneOutcome<W::Scalar>> {
        let [q, p, q_low, p_low] = &*self.states.now;
        let step = Step {
            time: self.time,
            size,
            q,
            q_low,
            p,
            p_low,
            linear_velocity: self.linear_velocity,
        };
        let [q, p, q_low, p_low] = &mut *self.states.other;
        let outcome = Outcome { q, q_low, p, p_low };
        let take = PlanOf::<M, S, V>::with_tableau(FindStep::<R, W, J>(PhantomData))?;
        take(StepInLanes {
            step: &step,
            system: &self.system,
            memory: &mut self.memory,
            live,
            stopping: self.stopping,
            outcome,
        })
    }

    /// Makes a computed step, to the time `time`, the present state. Lanes in which it failed have to be [loaded](Self::load) again.
    pub(crate) fn accept(&mut self, size: f64, time: f64) {
        // With plain sums all low parts are zero.
        mem::swap(&mut self.states.now, &mut self.states.other);
        mem::swap(&mut self.memory.before, &mut self.memory.settled);
        if let Some(taken) = &self.taken {
            self.memory.scales = taken.scales;
            let counts = SweepCounts {
                sweeps: &mut self.sweeps,
                most: &mut self.most,
                taken: taken.sweeps,
            };
            W::Scalar::in_registers(counts);
        }
        self.steps += 1;
        self.go_to(size, time);
    }

    /// Sets the time after a step that every run has taken alone.
    pub(crate) const fn go_to(&mut self, size: f64, time: f64) {
        self.last_size = size;
        self.last_time = mem::replace(&mut self.time, time);
    }

    /// Counts the steps of a lane from here.
    fn count_from_here(&mut self, lane: usize) {
        self.since[lane] = self.steps;
        self.sweeps.set(lane, 0.0);
        self.most.set(lane, 0.0);
    }
}

/// Whether the velocity of a run is [linear](Step::linear_velocity).
pub(crate) fn has_linear_velocity<M, S, V, R, N>(run: &mut Integrator<M, S, V, R, N>) -> bool
where
    M: Method,
    S: System<V>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
{
    step_parts_of(run.stepper_mut()).step_memory.linear_velocity
}

/// The lanes in which a computed state is finite.
struct Finite<'a, W>(&'a [W; 4]);

impl<W: Vector<Scalar: Lanes>> Work for Finite<'_, W> {
    type Output = u32;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> u32 {
        let [q, p, ..] = self.0;
        let mut largest = W::Scalar::zero();
        for vector in [q, p] {
            for component in vector.as_slice() {
                largest = largest.larger_or_nan(component.abs());
            }
        }
        largest.at_most(W::Scalar::from_f64(f64::MAX))
    }
}

/// Counts the sweeps of a step.
struct SweepCounts<'a, L> {
    sweeps: &'a mut L,
    most: &'a mut L,
    taken: L,
}

impl<L: Lanes> Work for SweepCounts<'_, L> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) {
        *self.sweeps += self.taken;
        *self.most = self.most.larger(self.taken);
    }
}
