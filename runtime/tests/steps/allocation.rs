//! Steps allocate nothing.
//!
//! The crate is `no_std`, and nothing in a step uses the allocator that the generating function does: memory can only
//! come from `clone` and `zeros_like` of the vectors it is generic over. These count here; the whole allocator is
//! counted in the tests of the workspace.

use std::cell::Cell;
use std::ops::ControlFlow;

use crate::common::systems::Pendulum;

use crate::common::methods::{Midpoint, StoermerVerlet};
use symplectic::adaptive::{AdaptiveSteps, DistancePower, Logarithmic, Poincare};
use symplectic::emitted::{Bonds, Chain};
use symplectic::flow::{Drift, FlowSteps, Kick, Splitting, Substeps};
use symplectic::output::Moment;
use symplectic::variational::{self, DiscreteLagrangian, Newmark, VariationalSteps};
use symplectic::{Error, Event, Integrator, Method, Scalar, SeparableHamiltonian, State, Vector};

thread_local! {
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

/// How many vectors `action` makes.
fn made<R>(action: impl FnOnce() -> R) -> (u64, R) {
    let before = COUNT.get();
    let result = action();
    (COUNT.get() - before, result)
}

#[derive(Debug, PartialEq)]
struct Counted<T>(Vec<T>);

impl<T: Scalar> Counted<T> {
    fn new(components: Vec<T>) -> Self {
        // One without components holds no memory.
        COUNT.set(COUNT.get() + u64::from(!components.is_empty()));
        Self(components)
    }
}

impl<T: Scalar> Clone for Counted<T> {
    fn clone(&self) -> Self {
        Self::new(self.0.clone())
    }
}

impl<T: Scalar> Vector for Counted<T> {
    type Scalar = T;
    type With<U: Scalar> = Counted<U>;

    fn dimension(&self) -> usize {
        self.0.len()
    }

    fn as_slice(&self) -> &[T] {
        &self.0
    }

    fn as_mut_slice(&mut self) -> &mut [T] {
        &mut self.0
    }

    fn from_slice(components: &[T]) -> Result<Self, Error> {
        Ok(Self::new(components.to_vec()))
    }

    fn blank() -> Self {
        Self(Vec::new())
    }

    fn zeros_like(&self) -> Self {
        self.zeros_with()
    }

    fn zeros_with<U: Scalar>(&self) -> Counted<U> {
        Counted::new(vec![U::zero(); self.0.len()])
    }
}

/// Memory for what is between the steps is made once in a run, not once in a step or for an event.
#[test]
fn dense_output_and_events_do_not_allocate() -> Result<(), Error> {
    fn check<M: Method>(method: M) -> Result<(), Error> {
        let start = State::new(0.0, Counted::new(vec![1.0; 5]), Counted::new(vec![0.0; 5]));
        let mut integrator = Integrator::new(method, Pendulum::default(), start, 0.1)?;
        let event = Event::crossing(|state: &State<Counted<f64>>| state.q.0[0]);
        let mut run = |duration: f64| {
            let end = integrator.state().time + duration;
            let mut events = 0;
            let count = made(|| {
                integrator.integrate_with_events(end, &event, |_| {
                    events += 1;
                    ControlFlow::<()>::Continue(())
                })
            });
            let times: Vec<f64> = (1..=100)
                .map(|k| end + 0.03 + duration * f64::from(k) / 100.0)
                .collect();
            let output = made(|| integrator.integrate_at(&times, |_| {}).map(|_| ()));
            count.1?;
            output.1?;
            Ok::<_, Error>((count.0, output.0, events))
        };
        let (short, long) = (run(10.0)?, run(100.0)?);
        assert_eq!((short.0, short.1), (long.0, long.1), "{}", M::NAME);
        assert!(long.2 > 5 * short.2);
        let (mut q, mut p) = (integrator.state().q.clone(), integrator.state().p.clone());
        let dense = integrator.dense()?;
        let (count, outcome) = made(|| dense.write(dense.span().0, &mut q, &mut p));
        assert_eq!(count, 0);
        outcome
    }
    check(StoermerVerlet)?;
    check(Midpoint)
}

/// Nor do events of a list, with output between them, found by steps, and with states that are reset.
#[test]
fn resets_at_events_do_not_allocate() -> Result<(), Error> {
    fn check<M: Method>(method: M) -> Result<(), Error> {
        let start = State::new(0.0, Counted::new(vec![1.0; 5]), Counted::new(vec![0.0; 5]));
        let mut integrator = Integrator::new(method, Pendulum::default(), start, 0.1)?;
        let first = |state: &State<Counted<f64>>| state.q.0[0];
        let events = (Event::wall(first), Event::crossing(first).by_steps());
        let mut run = |duration: f64| {
            let start = integrator.state().time;
            let times: Vec<f64> = (1..=100)
                .map(|k| start + duration * f64::from(k) / 100.0)
                .collect();
            let mut impacts = 0;
            let (count, ended) = made(|| {
                integrator.integrate_through(start + duration, &times, &events, |moment| {
                    if let Moment::Event { index: 0, state } = moment {
                        impacts += 1;
                        state.p.0.iter_mut().for_each(|p| *p = -*p);
                    }
                    ControlFlow::<()>::Continue(())
                })
            });
            ended.map(|_| (count, impacts))
        };
        let (short, long) = (run(10.0)?, run(100.0)?);
        assert_eq!(short.0, long.0, "{}", M::NAME);
        assert!(long.1 > 5 * short.1 && short.1 > 1);
        Ok(())
    }
    check(StoermerVerlet)?;
    check(Midpoint)
}

#[test]
fn steps_do_not_allocate() -> Result<(), Error> {
    fn check<M: Method>(method: M, memory: u64) -> Result<(), Error> {
        let start = State::new(0.0, Counted::new(vec![1.0; 5]), Counted::new(vec![0.0; 5]));
        let (count, integrator) = made(|| Integrator::new(method, Pendulum::default(), start, 0.1));
        assert_eq!(count, memory);
        let mut integrator = integrator?;

        let (count, outcome) = made(|| {
            for _ in 0..10 {
                integrator.step()?;
            }
            integrator.integrate_to(10.0)?;
            integrator.integrate_with(5.0, |_| {}).map(|_| ())
        });
        outcome?;
        assert_eq!(count, 0);

        let (count, _) = made(|| integrator.states().take(3).count());
        assert_eq!(count, 2 * 3, "an iterator clones q and p");
        Ok(())
    }
    // To test what the system declares; what the state leaves out, the result and what that leaves out, two each; a velocity and a force,
    // and the stages where they are solved for.
    check(StoermerVerlet, 8 + 6 + 2)?;
    check(Midpoint, 8 + 6 + 4)
}

/// In blocks, and by themselves.
#[test]
fn steps_of_a_chain_do_not_allocate() -> Result<(), Error> {
    struct Springs;
    impl Bonds for Springs {
        fn tension<T: Scalar>(&self, _time: T, stretch: T) -> T {
            stretch
        }
    }
    let start = State::new(
        0.0,
        Counted::new(vec![0.0; 100]),
        Counted::new(vec![1.0; 100]),
    );
    let mut plain = Integrator::plain(StoermerVerlet, Chain::between_walls(Springs), start, 0.1)?;
    let (count, outcome) = made(|| {
        plain.take_steps(1000)?;
        plain.step().map(|_| ())
    });
    outcome?;
    assert_eq!(count, 0);
    Ok(())
}

/// A particle on a line with drag, by its discrete Lagrangian.
struct Particle;

impl DiscreteLagrangian for Particle {
    type Vector<T: Scalar> = Counted<T>;

    fn value<T: Scalar>(&self, _time: T, h: T, q0: &Counted<T>, q1: &Counted<T>) -> T {
        let way = q1.0[0] - q0.0[0];
        let half = T::from_f64(0.5);
        way * way * half / h + h * (q0.0[0] + way * half).cos()
    }

    const FORCED: bool = true;

    fn forces<T: Scalar>(
        &self,
        _time: T,
        _step_size: T,
        q0: &Counted<T>,
        q1: &Counted<T>,
        minus: &mut Counted<T>,
        _plus: &mut Counted<T>,
    ) {
        minus.0[0] = (q0.0[0] - q1.0[0]) * T::from_f64(0.1);
    }
}

#[test]
fn steps_of_a_discrete_lagrangian_do_not_allocate() -> Result<(), variational::Error> {
    let start = || State::new(0.0, Counted::new(vec![1.0]), Counted::new(vec![0.0]));
    let (made_by_new, run) = made(|| VariationalSteps::run(Particle, start(), 0.1));
    assert!(made_by_new > 4);
    let mut run = run?;
    let (made_by_steps, outcome) = made(|| run.integrate_to(10.0).map(|_| ()));
    outcome?;
    assert_eq!(made_by_steps, 0);
    Ok(())
}

#[test]
fn steps_of_newmark_do_not_allocate() -> Result<(), variational::Error> {
    struct Pendulums;
    impl SeparableHamiltonian for Pendulums {
        type Vector<T: Scalar> = Counted<T>;

        fn velocity<T: Scalar>(&self, _: T, p: &Counted<T>, velocity: &mut Counted<T>) {
            velocity.0.copy_from_slice(&p.0);
        }

        fn force<T: Scalar>(&self, _: T, q: &Counted<T>, force: &mut Counted<T>) {
            for (force, &q) in force.0.iter_mut().zip(&q.0) {
                *force = -q.sin();
            }
        }
    }
    let newmark = Newmark::new(Pendulums, 0.25, 0.1)?;
    let start = State::new(0.0, Counted::new(vec![1.0; 5]), Counted::new(vec![0.0; 5]));
    let start = newmark.shift(&start)?;
    let mut run = Integrator::new(StoermerVerlet, newmark, start, 0.1)?;
    let (made_first, outcome) = made(|| run.step().map(|_| ()));
    outcome?;
    assert!(made_first > 0);
    let (made_by_steps, outcome) = made(|| run.integrate_to(10.0).map(|_| ()));
    outcome?;
    assert_eq!(made_by_steps, 0);
    Ok(())
}

#[test]
fn steps_of_flows_do_not_allocate() -> Result<(), symplectic::flow::Error> {
    let start = State::new(0.0, Counted::new(vec![1.0; 5]), Counted::new(vec![0.0; 5]));
    let (drift, kick) = (
        Drift::new(Pendulum::default()),
        Kick::new(Pendulum::default()),
    );
    let step = Substeps::new(Splitting::new(StoermerVerlet, drift, kick), 3)?;
    let mut integrator = FlowSteps::run(step, start, 0.1)?;
    integrator.step()?;
    let (count, outcome) = made(|| integrator.integrate_to(10.0).map(|_| ()));
    outcome?;
    assert_eq!(count, 0);
    // Output has room for one state.
    let times: Vec<f64> = (0..100).map(|k| 10.0 + 0.03 * f64::from(k)).collect();
    let (count, outcome) = made(|| integrator.integrate_at(&times, |_| {}).map(|_| ()));
    outcome?;
    assert_eq!(count, 2);
    Ok(())
}

#[test]
fn steps_of_variable_size_do_not_allocate() -> Result<(), symplectic::adaptive::Error> {
    struct Line;
    impl SeparableHamiltonian for Line {
        type Vector<T: Scalar> = Counted<T>;

        fn velocity<T: Scalar>(&self, _: T, p: &Counted<T>, velocity: &mut Counted<T>) {
            velocity.0.copy_from_slice(&p.0);
        }

        fn force<T: Scalar>(&self, _: T, q: &Counted<T>, force: &mut Counted<T>) {
            force.0[0] = -q.0[0] * (q.0[0] * q.0[0] + T::one()).recip();
        }

        fn energy<T: Scalar>(&self, _: T, q: &Counted<T>, p: &Counted<T>) -> Option<T> {
            let half = T::from_f64(0.5);
            let square = q.0[0] * q.0[0] + T::one();
            Some(half * (p.0[0] * p.0[0] + square.ln()) - T::from_f64(4.0))
        }
    }
    let start = || State::new(0.0, Counted::new(vec![1.0]), Counted::new(vec![0.0]));
    let monitor = DistancePower(0.0);
    let mut run = AdaptiveSteps::run(StoermerVerlet, Line, monitor, start(), 0.1)?;
    let (count, outcome) = made(|| run.take_steps(100).map(|_| ()));
    outcome?;
    assert_eq!(count, 0);

    let logarithmic = Logarithmic::new(Line);
    let extended: State<Counted<f64>> = logarithmic.extend(&start())?;
    let mut run = Integrator::new(StoermerVerlet, logarithmic, extended, 0.1)?;
    let (count, outcome) = made(|| run.step().map(|_| ()));
    outcome?;
    assert!(count > 0);
    let (count, outcome) = made(|| run.take_steps(100).map(|_| ()));
    outcome?;
    assert_eq!(count, 0);

    let poincare = Poincare::new(Line, monitor);
    let extended: State<Counted<f64>> = poincare.extend(&start())?;
    let mut run = Integrator::new(Midpoint, poincare, extended, 0.1)?;
    let (count, outcome) = made(|| run.step().map(|_| ()));
    outcome?;
    assert!(count > 0);
    let (count, outcome) = made(|| run.take_steps(100).map(|_| ()));
    outcome?;
    assert_eq!(count, 0);
    Ok(())
}
