//! The whole interface of a run, for every stepper: one row each.

use core::fmt::Debug;
use core::marker::PhantomData;
use core::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};

use symplectic::adaptive::{AdaptiveSteps, DistancePower};
use symplectic::nalgebra::{Vector1, Vector2, Vector3};
use symplectic::output::Moment;
use symplectic::rotation::{FreeBody, RotationState, RotationSteps};
use symplectic::solver::ByNewton;
use symplectic::stepper::{
    DenseSteps, Equal, Own, Pace, PhasePoint, RemainingSteps, StepMap, Stepper,
};
use symplectic::variational::{
    DiracRule, DiracSteps, DiscreteLagrangian, EnergyMomentumSteps, LagrangianSteps,
    VariationalSteps,
};
use symplectic::{
    Error, Event, Integrator, Retry, Run, Scalar, State, Statistics, Vector, acceleration,
};

use crate::dirac::{Vortices, vortices_start};
use crate::discrete_lagrangians::{Trapezoid, perihelion};
use crate::every_integrator::{bead, kepler_by_flows};
use crate::lagrangians::{Particle, near_perihelion};
use crate::methods::{Gauss2, TwoOfThree};
use crate::rolling::{Disk, Midpoint, disk_start};
use crate::rotation::{LOPSIDED, Suzuki4, start as top_start};
use crate::symmetry::Bead;
use crate::systems::Lobatto3;

symplectic::tableau! { Verlet { base: velocity-verlet } }

type Plane = State<Vector2<f64>>;

fn attraction(_time: f64, q: &Vector2<f64>, out: &mut Vector2<f64>) {
    *out = -q / q.norm().powi(3);
}

/// A run of any stepper, from a start.
fn run_of_any_pace<S, N, E>(
    name: &str,
    make: impl Fn(&S::State) -> Result<Run<S>, E>,
    start: &S::State,
) where
    S: Stepper + Clone,
    S::State: PhasePoint<Vector: Vector<Scalar = N>> + PartialEq + Debug,
    N: Scalar,
    E: Debug,
{
    let new = || make(start).expect(name);
    let mut one_by_one = new();
    assert_eq!(
        (one_by_one.steps(), one_by_one.state()),
        (0, start),
        "{name}"
    );
    let time = one_by_one.stepper().time();
    let mut seen = Vec::new();
    for _ in 0..9 {
        seen.push(one_by_one.step().expect(name).clone());
    }
    assert_ne!(one_by_one.stepper().time(), time, "{name}");
    let mut at_once = new();
    assert_eq!(at_once.take_steps(9).expect(name), &seen[8], "{name}");
    assert_eq!(at_once.statistics(), one_by_one.statistics(), "{name}");
    assert_eq!(at_once.steps(), 9, "{name}");
    // States by an iterator.
    let mut run = new();
    let thirds: Result<Vec<_>, _> = run.states().every(3).take(3).collect();
    let expected: Vec<_> = seen.iter().skip(2).step_by(3).cloned().collect();
    assert_eq!(thirds.expect(name), expected, "{name}");
    // A clone goes on with the same bits, a new state like a new run.
    let mut clone = at_once.clone();
    assert_eq!(
        clone.take_steps(5).expect(name),
        at_once.take_steps(5).expect(name),
        "{name}"
    );
    clone.set_state(start.clone()).expect(name);
    assert_eq!(clone.state(), start, "{name}");
    assert_eq!(clone.take_steps(9).expect(name), &seen[8], "{name}");
    assert_eq!(clone.into_state(), seen[8], "{name}");
    // The step as a map.
    let run = new();
    assert_eq!(run.step_from(start.clone()).expect(name), seen[0], "{name}");
    assert_eq!((run.steps(), run.state()), (0, start), "{name}");
    assert_eq!(
        run.equivariance_defect(Clone::clone).expect(name),
        0.0,
        "{name}"
    );
    assert!(
        fails_with(new().take_steps(1 << 53), "more than 2^53 steps"),
        "{name}"
    );
}

/// Whether it is an error with these words: each stepper has its own type of error.
fn fails_with<T>(outcome: Result<T, impl std::error::Error>, words: &str) -> bool {
    outcome.is_err_and(|error| error.to_string().contains(words))
}

/// A run with equal steps of size 0.1, from a start at the time 0; `late` is the start at a time that no step changes.
fn run_of_equal_steps<S, N, E>(
    name: &str,
    make: impl Fn(&S::State) -> Result<Run<S>, E>,
    start: &S::State,
    late: &S::State,
) where
    S: Stepper<Pace = Equal> + Clone,
    S::State: PhasePoint<Vector: Vector<Scalar = N>> + PartialEq + Debug,
    N: Scalar,
    E: Debug,
{
    run_of_any_pace(name, &make, start);
    let new = || make(start).expect(name);
    // To a time between two steps, with the same bits whoever looks.
    let mut run = new();
    let end = run.integrate_to(1.05).expect(name).clone();
    assert_eq!((end.canonical().time, run.steps()), (1.05, 11), "{name}");
    let (mut watched, mut times) = (new(), Vec::new());
    let see = |state: &S::State| times.push(state.canonical().time);
    assert_eq!(
        watched.integrate_with(1.05, see).expect(name),
        &end,
        "{name}"
    );
    assert_eq!((times.len(), times[10]), (11, 1.05), "{name}");
    assert!(times.is_sorted(), "{name}");
    let mut stopped = new();
    let third = stopped.integrate_while(1.05, |progress| {
        assert_eq!(progress.steps, 11);
        match progress.step {
            3 => ControlFlow::Break(progress.state.clone()),
            _ => ControlFlow::Continue(()),
        }
    });
    assert_eq!(third.expect(name).as_ref(), Some(stopped.state()), "{name}");
    assert_eq!(stopped.steps(), 3, "{name}");
    // And back: the methods of all rows are symmetric.
    let back = run.integrate_to(0.0).expect(name).canonical();
    let (found, expected) = (back.as_slices(), start.canonical());
    let expected = expected.as_slices();
    let pairs = (found.0.iter().chain(found.1)).zip(expected.0.iter().chain(expected.1));
    for (&found, &expected) in pairs {
        let distance = (found - expected).magnitude();
        assert!(distance < 1e-9, "{name}: {distance:e}");
    }
    // The step size, and a retry that is not needed.
    assert_eq!(run.step_size(), 0.1, "{name}");
    assert!(
        matches!(run.set_step_size(0.0), Err(Error::StepSize { .. })),
        "{name}"
    );
    run.set_step_size(-0.05).expect(name);
    assert_eq!((run.step_size(), run.steps()), (-0.05, 22), "{name}");
    run.step().expect(name);
    assert_eq!(run.state().canonical().time, -0.05, "{name}");
    let mut ready = new();
    ready.set_retry(Retry::Split { halvings: 3 });
    assert_eq!(ready.integrate_to(1.05).expect(name), &end, "{name}");
    assert_eq!(ready.statistics().rejected, 0, "{name}");
    // Errors leave everything as it is.
    let mut run = new();
    assert!(
        fails_with(run.integrate_to(f64::NAN), "the end time is NaN"),
        "{name}"
    );
    assert_eq!((run.steps(), run.state()), (0, start), "{name}");
    run.set_state(late.clone()).expect(name);
    assert!(fails_with(run.step(), "does not change the time"), "{name}");
    assert_eq!((run.steps(), run.state()), (0, late), "{name}");
}

/// Output and events of a run whose last step can be followed, from a start at the time 0 with steps of about 0.1.
fn followed_run<S, E: Debug>(name: &str, make: impl Fn() -> Result<Run<S>, E>)
where
    S: DenseSteps<State: PartialEq + Debug> + Clone,
    S::Vector: Vector<Scalar = f64>,
{
    let new = || make().expect(name);
    let mut plain = new();
    let seen: Vec<_> = (plain.states().take(9))
        .map(|state| state.expect(name))
        .collect();
    let inside = 0.5 * (seen[3].time + seen[4].time);
    let times = [0.0, seen[0].time, inside, seen[4].time, seen[4].time + 1e-3];
    let (mut run, mut found) = (new(), Vec::new());
    run.integrate_at(&times, |state| found.push(state.clone()))
        .expect(name);
    assert_eq!(run.state(), &seen[5], "{name}");
    assert_eq!((&found[1], &found[3]), (&seen[0], &seen[4]), "{name}");
    let shown: Vec<_> = found.iter().map(|state| state.time).collect();
    assert_eq!(shown, times, "{name}");
    // Between its neighbours, up to the curvature of the path.
    let middle = (seen[3].q.as_slice()[0] + seen[4].q.as_slice()[0]) / 2.0;
    assert!((found[2].q.as_slice()[0] - middle).abs() < 0.01, "{name}");
    let again = run.integrate_at(&[0.0], |_| ());
    assert!(fails_with(again, "the output time 0"), "{name}");
    // An event at that time, and a wall.
    let event = Event::rising(|state: &State<S::Vector>| state.time - inside);
    let (mut run, last) = (new(), seen[8].time);
    let state = run.find_event(last, &event).expect(name).expect(name);
    assert!((state.time - inside).abs() < 1e-12, "{name}");
    assert_eq!(run.state(), &seen[4], "{name}");
    let moved = |from: &State<S::Vector>| (state.q.as_slice()[0] - from.q.as_slice()[0]).abs();
    let moved = moved(&found[2]);
    assert!(moved < 1e-3, "{name}: {moved:e}");
    let wall = Event::wall(|state: &State<S::Vector>| inside - state.time);
    let mut run = new();
    let reached = run.find_event(last, &wall).expect(name).expect(name);
    assert_eq!(run.state(), &reached, "{name}");
    assert!(
        reached.time <= inside && inside - reached.time < 1e-12,
        "{name}"
    );
    // Both in order of time.
    let (mut run, mut moments) = (new(), Vec::new());
    let ended = run.integrate_through(last, &[inside / 2.0], &event, |moment| {
        moments.push(match moment {
            Moment::Output(state) => ("output", state.time),
            Moment::Event { state, .. } => ("event", state.time),
        });
        ControlFlow::<()>::Continue(())
    });
    assert_eq!(ended.expect(name), None, "{name}");
    let kinds: Vec<_> = moments.iter().map(|(kind, _)| *kind).collect();
    assert_eq!(kinds, ["output", "event"], "{name}");
}

/// Rows with equal steps: a name, a run from a state, the start, and the start at another time.
macro_rules! equal_steps {
    ($($name:literal: $start:expr => $make:expr;)*) => {$(
        let start = $start;
        let mut late = start.clone();
        late.time = 1e17;
        run_of_equal_steps($name, $make, &start, &late);
    )*};
}

#[test]
fn every_stepper_has_the_whole_interface_of_a_run() {
    let kepler = || acceleration(attraction);
    equal_steps! {
        "splitting": perihelion() => |start: &Plane| Integrator::new(Verlet, kepler(), start.clone(), 0.1);
        "plain sums": perihelion() => |start: &Plane| Integrator::plain(Verlet, kepler(), start.clone(), 0.1);
        "coupled stages": near_perihelion() => |start: &Plane| Integrator::new(Gauss2, kepler(), start.clone(), 0.1);
        "Newton's iteration": near_perihelion() => |start: &Plane| {
            Integrator::new(Gauss2, kepler(), start.clone(), 0.1).map(|run| run.by_newton())
        };
        "constraint": bead(0.0, 0.0) => |start: &State<Vector3<f64>>| Integrator::new(Lobatto3, Bead, start.clone(), 0.1);
        "rolling": disk_start() => |start: &State<_>| Integrator::new(Midpoint, Disk, start.clone(), 0.1);
        "flows": perihelion() => |start: &Plane| {
            let mut run = kepler_by_flows(start.clone())?;
            run.set_step_size(0.1)?;
            Ok::<_, symplectic::flow::Error>(run)
        };
        "discrete Lagrangian": perihelion() => |start: &Plane| VariationalSteps::run(Trapezoid, start.clone(), 0.1);
        "composed": perihelion() => |start: &Plane| {
            VariationalSteps::composed(Suzuki4, Trapezoid, start.clone(), 0.1)
        };
        "Lagrangian": near_perihelion() => |start: &Plane| {
            LagrangianSteps::run(Gauss2, Particle { friction: 0.0 }, start.clone(), 0.1)
        };
        "Galerkin": near_perihelion() => |start: &Plane| {
            LagrangianSteps::galerkin(TwoOfThree, Particle { friction: 0.0 }, start.clone(), 0.1)
        };
        "vortices": vortices_start() => |start: &State<_>| {
            DiracSteps::run(DiracRule::Midpoint, Vortices, start.clone(), 0.1)
        };
        "top": top_start() => |start: &RotationState| RotationSteps::run(LOPSIDED, *start, 0.1);
        "top, order 4": top_start() => |start: &RotationState| {
            RotationSteps::composed(Suzuki4, LOPSIDED, *start, 0.1)
        };
        "own": State::from_arrays(0.0, [1.0], [0.0]) => |start: &State<Vector1<f64>>| own(start, Fault::None);
    }
    let start = near_perihelion();
    run_of_any_pace(
        "adaptive",
        |start: &Plane| {
            AdaptiveSteps::run(Verlet, kepler(), DistancePower(1.5), start.clone(), 0.1)
        },
        &start,
    );
    run_of_any_pace(
        "energy and momentum",
        |start: &Plane| EnergyMomentumSteps::run(Trapezoid, start.clone(), 0.01),
        &start,
    );
}

#[test]
fn every_run_that_can_be_followed_has_output_and_events() {
    let kepler = || acceleration(attraction);
    let start = near_perihelion;
    followed_run("splitting", || {
        Integrator::new(Verlet, kepler(), start(), 0.1)
    });
    followed_run("coupled stages", || {
        Integrator::new(Gauss2, kepler(), start(), 0.1)
    });
    followed_run("constraint", || {
        Integrator::new(Lobatto3, Bead, bead(0.0, 0.0), 0.1)
    });
    followed_run("flows", || kepler_by_flows(start()));
    followed_run("adaptive", || {
        AdaptiveSteps::run(Verlet, kepler(), DistancePower(1.5), start(), 0.1)
    });
    followed_run("discrete Lagrangian", || {
        VariationalSteps::run(Trapezoid, start(), 0.1)
    });
    followed_run("composed", || {
        VariationalSteps::composed(Suzuki4, Trapezoid, start(), 0.1)
    });
    followed_run("Lagrangian", || {
        LagrangianSteps::run(Gauss2, Particle { friction: 0.0 }, start(), 0.1)
    });
    followed_run("Galerkin", || {
        LagrangianSteps::galerkin(TwoOfThree, Particle { friction: 0.0 }, start(), 0.1)
    });
    followed_run("vortices", || {
        DiracSteps::run(DiracRule::Midpoint, Vortices, vortices_start(), 0.1)
    });
    followed_run("energy and momentum", || {
        EnergyMomentumSteps::run(
            Trapezoid,
            State::from_arrays(0.0, [1.0, 0.0], [0.0, 1.1]),
            0.1,
        )
    });
}

/// A free particle with the pace `P`, by hand.
#[derive(Clone)]
struct Straight<P> {
    state: State<Vector1<f64>>,
    before: Option<State<Vector1<f64>>>,
    statistics: Statistics,
    /// What it says of its steps.
    own: Option<f64>,
    /// Whether it counts the steps that it takes for a run.
    counts: bool,
    pace: PhantomData<P>,
}

fn straight<P: Pace>(size: f64, own: Option<f64>) -> Result<Run<Straight<P>>, Error> {
    let stepper = Straight {
        state: State::from_arrays(0.0, [0.0], [1.0]),
        before: None,
        statistics: Statistics::default(),
        own,
        counts: true,
        pace: PhantomData,
    };
    Run::of(stepper, size)
}

impl<P: Pace> Stepper for Straight<P> {
    type State = State<Vector1<f64>>;
    type Error = Error;
    type Pace = P;
    type Saved = ();

    fn state(&self) -> &Self::State {
        &self.state
    }

    fn statistics(&self) -> &Statistics {
        &self.statistics
    }

    fn statistics_mut(&mut self) -> &mut Statistics {
        &mut self.statistics
    }

    fn set_state(&mut self, state: &Self::State) -> Result<(), Error> {
        self.state = state.clone();
        self.before = None;
        Ok(())
    }

    fn advance(&mut self, size: f64, end: f64) -> Result<(), Error> {
        let (size, end) = match P::OWN {
            true => (0.1, self.state.time + 0.1),
            false => (size, end),
        };
        self.before = Some(self.state.clone());
        self.state.q += size * self.state.p;
        self.state.time = end;
        self.statistics.steps += 1;
        Ok(())
    }

    fn take_while(
        &mut self,
        steps: &mut RemainingSteps,
        mut goes_on: impl FnMut(&Self::State, &Statistics) -> bool,
    ) -> Result<bool, Error> {
        let mut copy = *steps;
        while let Some((size, end)) = copy.next() {
            self.advance(size, end)?;
            copy.tick();
            if !goes_on(&self.state, &self.statistics) {
                *steps = copy;
                return Ok(false);
            }
        }
        if self.counts {
            *steps = copy;
        }
        Ok(true)
    }

    fn own_step_size(&self) -> Option<f64> {
        self.own
    }

    fn save(&self) {}

    fn go_back(&mut self, _saved: &()) {}
}

impl<P: Pace> DenseSteps for Straight<P> {
    type Vector = Vector1<f64>;
    /// The time of the state before the step.
    type Scratch = Option<f64>;

    fn scratch(&self) -> Option<f64> {
        None
    }

    fn last_span(&self) -> Option<(f64, f64)> {
        Some((self.before.as_ref()?.time, self.state.time))
    }

    fn write_start(&self, out: &mut State<Vector1<f64>>) {
        out.clone_from(self.before.as_ref().unwrap_or(&self.state));
    }

    fn prepare(&self, scratch: &mut Option<f64>) -> Result<(), Error> {
        let before = self.before.as_ref().ok_or(Error::NoStep)?;
        *scratch = Some(before.time);
        Ok(())
    }

    fn look(
        &mut self,
        time: f64,
        scratch: &mut Option<f64>,
        out: &mut State<Vector1<f64>>,
    ) -> Result<(), Error> {
        self.write_start(out);
        assert_eq!(*scratch, Some(out.time), "not prepared");
        out.q += (time - out.time) * out.p;
        out.time = time;
        Ok(())
    }

    fn slopes(
        &mut self,
        state: &State<Vector1<f64>>,
        _size: f64,
        velocity: &mut Vector1<f64>,
        force: &mut Vector1<f64>,
    ) {
        *velocity = state.p;
        force.fill(0.0);
    }
}

#[test]
fn steppers_by_hand_that_can_be_followed_have_output_and_events() -> Result<(), Error> {
    followed_run("equal", || straight::<Equal>(0.1, None));
    followed_run("own", || straight::<Own>(1.0, Some(0.1)));
    // The pace says who chooses the sizes, whatever the stepper says of them.
    followed_run("equal, with a size", || straight::<Equal>(0.1, Some(-3.0)));
    followed_run("own, without a size", || straight::<Own>(0.1, None));
    // The run ends, and exactly, also if its steps are not counted.
    let mut run = straight::<Equal>(0.1, Some(-3.0))?;
    run = Run::of(
        Straight {
            counts: false,
            ..run.stepper().clone()
        },
        0.1,
    )?;
    let never = Event::rising(|_: &State<_>| -1.0);
    assert_eq!(run.find_event(1.05, &never)?, None);
    assert_eq!((run.state().time, run.steps()), (1.05, 11));
    // A look by a step needs no preparation.
    let mut run = straight::<Equal>(0.1, None)?;
    run.step()?;
    let (mut stepper, mut state) = (run.stepper().clone(), run.state().clone());
    let mut scratch = stepper.scratch();
    stepper.look_by_step(0.05, &mut scratch, &mut state)?;
    assert_eq!((state.time, state.q[0]), (0.05, 0.05));
    // A size that has vanished still has a sign.
    let mut run = straight::<Own>(1.0, Some(0.0))?;
    let mut seen = Vec::new();
    run.integrate_at(&[0.0, 0.05, 0.25], |state| seen.push(state.time))?;
    assert_eq!(seen, [0.0, 0.05, 0.25]);
    Ok(())
}

/// A particle that a wall at 0 repels, L = v²/2 − 1/√q; not a number behind the wall.
#[derive(Clone)]
struct Repelled;

impl DiscreteLagrangian for Repelled {
    type Vector<T: Scalar> = Vector1<T>;

    fn value<T: Scalar>(&self, _time: T, h: T, q0: &Vector1<T>, q1: &Vector1<T>) -> T {
        let (half, way) = (T::from_f64(0.5), q1[0] - q0[0]);
        half * way * way / h - half * h * (q0[0].sqrt().recip() + q1[0].sqrt().recip())
    }
}

/// The shortest of these steps that fails is taken in parts.
fn split_run<S: Stepper<Pace = Equal>, E: Debug>(
    name: &str,
    make: impl Fn(f64) -> Result<Run<S>, E>,
) {
    let fails = |&size: &f64| make(size).expect(name).step().is_err();
    let size = (0..12)
        .map(|k| f64::from(1 << k) / 8.0)
        .find(fails)
        .expect(name);
    let mut run = make(size).expect(name);
    run.set_retry(Retry::Split { halvings: 12 });
    run.step().expect(name);
    assert_eq!(run.stepper().time(), size, "{name}");
    let &Statistics {
        steps, rejected, ..
    } = run.statistics();
    assert!(
        rejected > 0 && steps >= 2 && steps.is_power_of_two(),
        "{name}"
    );
}

#[test]
fn a_step_that_is_too_long_is_split() {
    split_run("coupled stages", |size| {
        Integrator::new(Gauss2, acceleration(attraction), near_perihelion(), size)
    });
    split_run("discrete Lagrangian", |size| {
        VariationalSteps::run(Repelled, State::from_arrays(0.0, [1.0], [-2.0]), size)
    });
    split_run("rotation", |size| {
        RotationSteps::run(FreeBody::new(1.0, 1.4, 0.8), top_start(), size)
    });
}

/// What is wrong with a stepper.
#[derive(Clone, Copy, PartialEq)]
enum Fault {
    None,
    /// Steps after `set_state` depend on earlier ones.
    Remembers,
    /// Steps are not counted.
    DoesNotCount,
    /// The time of a state is not that of the run.
    OtherTime,
}

/// Störmer–Verlet steps of a pendulum, by hand.
#[derive(Clone)]
struct Pendulum {
    state: State<Vector1<f64>>,
    statistics: Statistics,
    force: Option<f64>,
    fault: Fault,
}

fn own(start: &State<Vector1<f64>>, fault: Fault) -> Result<Run<Pendulum>, Error> {
    let stepper = Pendulum {
        state: start.clone(),
        statistics: Statistics::default(),
        force: None,
        fault,
    };
    Run::of(stepper, 0.1)
}

impl Stepper for Pendulum {
    type State = State<Vector1<f64>>;
    type Error = Error;
    type Pace = Equal;
    type Saved = Self;

    fn state(&self) -> &Self::State {
        &self.state
    }

    fn statistics(&self) -> &Statistics {
        &self.statistics
    }

    fn statistics_mut(&mut self) -> &mut Statistics {
        &mut self.statistics
    }

    fn set_state(&mut self, state: &Self::State) -> Result<(), Error> {
        self.state = state.clone();
        if self.fault != Fault::Remembers {
            self.force = None;
        }
        Ok(())
    }

    fn advance(&mut self, size: f64, end: f64) -> Result<(), Error> {
        let State { time, q, p } = &mut self.state;
        p[0] += size / 2.0 * self.force.unwrap_or_else(|| -q[0].sin());
        q[0] += size * p[0];
        let force = -q[0].sin();
        p[0] += size / 2.0 * force;
        self.force = Some(force);
        *time = match self.fault {
            Fault::OtherTime => *time + size * (1.0 + 1e-15),
            _ => end,
        };
        self.statistics.steps += u64::from(self.fault != Fault::DoesNotCount);
        Ok(())
    }

    fn save(&self) -> Self {
        self.clone()
    }

    fn go_back(&mut self, saved: &Self) {
        self.clone_from(saved);
    }
}

/// The table finds these faults.
#[test]
fn a_faulty_stepper_fails_the_table() {
    let start = State::from_arrays(0.0, [1.0], [0.0]);
    let mut late = start.clone();
    late.time = 1e17;
    let passes = |fault| {
        let make = |start: &State<_>| own(start, fault);
        let check = || run_of_equal_steps("own", make, &start, &late);
        catch_unwind(AssertUnwindSafe(check)).is_ok()
    };
    assert!(passes(Fault::None));
    assert!(!passes(Fault::Remembers));
    assert!(!passes(Fault::DoesNotCount));
    assert!(!passes(Fault::OtherTime));
}
