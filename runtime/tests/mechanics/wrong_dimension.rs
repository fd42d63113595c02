//! Systems that change the dimension of the vector they write into: nothing is cut off, and nothing panics.

use crate::methods::{Gauss2, Lobatto3, Midpoint, StoermerVerlet};
use std::cell::Cell;

use symplectic::constraints::{
    Constrained, Gradients, HolonomicConstraints, Nonholonomic, NonholonomicConstraints,
    consistent, consistent_momentum, constraint_force,
};
use symplectic::friction::{Damped, Friction};
use symplectic::nalgebra::DVector;
use symplectic::solver::FixedPoint;
use symplectic::system::{Class, Lagrangian, Unconstrained};
use symplectic::variational::{
    DiracRule, DiracSteps, DiracSystem, DiscreteLagrangian, DiscretePath, Error, LagrangianSteps,
    Newmark, StepWithStages, VariationalSteps, momentum_of_velocity, velocity_of_momentum,
};
use symplectic::{
    Error as CoreError, General, Hamiltonian, Integrator, Method, ProvedFor, Quantity, Scalar,
    Separable, State, System,
};

type Vector = DVector<f64>;

/// Which evaluation gets a wrong dimension, and which dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fault {
    None,
    Velocity(usize),
    Force(usize),
    Applied(usize),
    Kick(usize),
}

/// What the particle has in each class.
trait Kind: Class {
    fn extra(_particle: &Particle<Self>) -> Option<Self::Extra<'_, Vector>> {
        None
    }
}

impl Kind for General {}

impl Kind for Damped {
    fn extra(particle: &Particle<Self>) -> Option<Self::Extra<'_, Vector>> {
        Some(particle)
    }
}

impl<C: Class + Unconstrained> Kind for Constrained<C> {
    fn extra(particle: &Particle<Self>) -> Option<Self::Extra<'_, Vector>> {
        Some(particle)
    }
}

impl<C: Class + Unconstrained> Kind for Nonholonomic<C> {
    fn extra(particle: &Particle<Self>) -> Option<Self::Extra<'_, Vector>> {
        Some(particle)
    }
}

/// A particle in the plane, |p|²/2 + |q|²/2: free, on the line y = 0, or with y' = 0.
struct Particle<C> {
    fault: Cell<Fault>,
    /// The evaluations before this time are right.
    from: f64,
    class: core::marker::PhantomData<C>,
}

impl<C> Particle<C> {
    const fn new(fault: Fault, from: f64) -> Self {
        Self {
            fault: Cell::new(fault),
            from,
            class: core::marker::PhantomData,
        }
    }

    fn fault(&self, time: f64) -> Fault {
        if time >= self.from {
            self.fault.get()
        } else {
            Fault::None
        }
    }
}

impl<C: Kind> System<Vector> for Particle<C> {
    type Class = C;
    type Solver = FixedPoint;

    const FORCED: bool = true;

    fn velocity(&self, time: f64, _: &Vector, p: &Vector, velocity: &mut Vector) {
        *velocity = match self.fault(time) {
            Fault::Velocity(to) => DVector::from_element(to, 1.0),
            _ => p.clone(),
        };
    }

    fn force(&self, time: f64, q: &Vector, _: &Vector, force: &mut Vector) {
        *force = match self.fault(time) {
            Fault::Force(to) => DVector::from_element(to, 1.0),
            _ => -q,
        };
    }

    fn applied_force(&self, time: f64, q: &Vector, _: &Vector, applied: &mut Vector) {
        *applied = match self.fault(time) {
            Fault::Applied(to) => DVector::from_element(to, 1.0),
            _ => q * 0.0,
        };
    }

    fn extra(&self) -> Option<<Self::Class as Class>::Extra<'_, Vector>> {
        C::extra(self)
    }
}

impl Friction<Vector> for Particle<Damped> {
    fn friction(&self, _component: usize) -> f64 {
        0.0
    }

    fn kick(
        &self,
        duration: f64,
        _: &Vector,
        force: &Vector,
        _: &Vector,
        change: &mut Vector,
    ) -> bool {
        *change = match self.fault.get() {
            Fault::Kick(to) => DVector::from_element(to, 1.0),
            _ => force * duration,
        };
        true
    }
}

impl<C: Class + Unconstrained> HolonomicConstraints<Vector> for Particle<Constrained<C>> {
    fn constraints(&self) -> usize {
        1
    }

    fn constraint_values(&self, q: &Vector, values: &mut [f64]) {
        values[0] = q[1];
    }

    fn constraint_gradients(&self, _: &Vector, gradients: &mut Gradients<f64>) {
        gradients.set(0, 1, 1.0);
    }
}

impl<C: Class + Unconstrained> NonholonomicConstraints<Vector> for Particle<Nonholonomic<C>> {
    fn nonholonomic_constraints(&self) -> usize {
        1
    }

    fn nonholonomic_rows(&self, _: &Vector, rows: &mut Gradients<f64>) {
        rows.set(0, 1, 1.0);
    }
}

fn start() -> State<Vector> {
    State::new(
        0.0,
        DVector::from_vec(vec![1.0, 0.0]),
        DVector::from_vec(vec![0.5, 0.0]),
    )
}

/// Dimensions smaller and larger than that of the state.
const WRONG: [usize; 3] = [0, 1, 3];

fn assert_resized(error: &(impl Clone + Into<Error>), what: Quantity, to: usize) {
    match error.clone().into() {
        Error::Core(
            CoreError::EvaluationDimension {
                what: named,
                expected,
                found,
                ..
            }
            | CoreError::ResizedEvaluation {
                what: named,
                expected,
                found,
                ..
            },
        ) => assert_eq!((named, expected, found), (what, 2, to)),
        error => panic!("{error}"),
    }
}

/// A fault at the start is found there. A later one is beyond the times at which the start is examined, t = 0 and 1: the step fails and
/// leaves the state, and succeeds without the fault.
fn refuses<M, C>(method: M)
where
    M: Method + Copy + ProvedFor<C>,
    C: Kind,
{
    for to in WRONG {
        for (fault, what) in [
            (Fault::Velocity(to), Quantity::Velocity),
            (Fault::Force(to), Quantity::Force),
        ] {
            let error = Integrator::new(method, Particle::<C>::new(fault, 0.0), start(), 0.1);
            let Err(error) = error else {
                panic!("{fault:?} was not found");
            };
            assert_resized(&error, what, to);
            let mut run = Integrator::new(method, Particle::<C>::new(fault, 1.55), start(), 0.1)
                .expect("right at the start");
            let error = run.integrate_to(2.0).map(|_| ()).expect_err("resized");
            assert_resized(&error, what, to);
            assert!(
                matches!(error, CoreError::EvaluationDimension { step: 16, .. }),
                "{error:?}"
            );
            let before = run.state().clone();
            assert!((before.time - 1.5).abs() < 1e-12);
            run.system().fault.set(Fault::None);
            run.step().expect("healed");
            assert!(run.state().time > before.time);
        }
    }
}

#[test]
fn constrained_steps_refuse_resized_results() {
    refuses::<_, Constrained<Separable>>(StoermerVerlet);
    refuses::<_, Constrained<Separable>>(Lobatto3);
    refuses::<_, Constrained<General>>(Lobatto3);
}

#[test]
fn nonholonomic_steps_refuse_resized_results() {
    refuses::<_, Nonholonomic<Separable>>(Midpoint);
    refuses::<_, Nonholonomic<Separable>>(StoermerVerlet);
    refuses::<_, Nonholonomic<General>>(Midpoint);
}

/// Of the nodes 0, 1/4 and 1/2 the second is the first with a wrong force, and the third the first with a wrong velocity.
#[test]
fn a_resized_result_is_named_with_its_stage() -> Result<(), Error> {
    let stage = |from: f64, fault| -> Result<_, Error> {
        let system = Particle::<Constrained<General>>::new(fault, from + 4.0);
        let mut run = Integrator::new(Lobatto3, system, start(), 0.5)?;
        run.integrate_to(4.0)?;
        match run.step() {
            Err(CoreError::EvaluationDimension { stage, .. }) => Ok(stage),
            other => panic!("{:?}", other.map(|_| ())),
        }
    };
    assert_eq!(stage(0.2, Fault::Force(3))?, Some(2));
    assert_eq!(stage(0.4, Fault::Velocity(1))?, Some(3));
    Ok(())
}

/// RATTLE has its stages of the momentum at t = 1.55. At t = 1.6 the velocity is that of the hidden constraint.
#[test]
fn a_resized_result_outside_the_stages_is_named_without_a_stage() -> Result<(), Error> {
    let system = Particle::<Constrained<Separable>>::new(Fault::Velocity(3), 1.58);
    let mut run = Integrator::new(StoermerVerlet, system, start(), 0.1)?;
    let error = run.integrate_to(2.0).map(|_| ()).expect_err("resized");
    assert_resized(&error, Quantity::Velocity, 3);
    assert!(
        matches!(
            error,
            CoreError::EvaluationDimension {
                step: 16,
                stage: None,
                ..
            }
        ),
        "{error:?}"
    );
    Ok(())
}

/// The state at the end has a wrong force, and the error is that of a state.
#[test]
fn dense_output_refuses_resized_results() -> Result<(), Error> {
    fn check<M, C>(method: M) -> Result<(), Error>
    where
        M: Method + Copy + ProvedFor<C>,
        C: Kind,
    {
        for to in WRONG {
            for (fault, what) in [
                (Fault::Velocity(to), Quantity::Velocity),
                (Fault::Force(to), Quantity::Force),
            ] {
                let mut run =
                    Integrator::new(method, Particle::<C>::new(Fault::None, 0.08), start(), 0.1)?;
                run.step()?;
                run.system().fault.set(fault);
                let error = run.dense().map(|_| ()).expect_err("resized");
                assert_resized(&error, what, to);
                assert!(
                    matches!(error, CoreError::ResizedEvaluation { time: 0.1, .. }),
                    "{error:?}"
                );
                run.system().fault.set(Fault::None);
                run.dense()?;
            }
        }
        Ok(())
    }
    check::<_, Damped>(StoermerVerlet)?;
    check::<_, Constrained<Separable>>(StoermerVerlet)?;
    check::<_, Constrained<General>>(Lobatto3)?;
    check::<_, Nonholonomic<Separable>>(Midpoint)?;
    check::<_, Nonholonomic<General>>(Midpoint)
}

#[test]
fn functions_of_states_refuse_resized_results() {
    for to in WRONG {
        for (fault, what) in [
            (Fault::Velocity(to), Quantity::Velocity),
            (Fault::Force(to), Quantity::Force),
        ] {
            let holonomic = Particle::<Constrained<Separable>>::new(fault, 0.0);
            let error = consistent(&holonomic, start()).expect_err("resized");
            assert_resized(&error, what, to);
            let error = constraint_force(&holonomic, &start()).expect_err("resized");
            assert_resized(&error, what, to);
            let rolling = Particle::<Nonholonomic<Separable>>::new(fault, 0.0);
            let error = consistent_momentum(&rolling, start()).expect_err("resized");
            assert_resized(&error, what, to);
        }
    }
}

#[test]
fn balances_refuse_a_resized_applied_force() -> Result<(), Error> {
    fn check<M, C>(method: M) -> Result<(), Error>
    where
        M: Method + Copy + ProvedFor<C>,
        C: Kind,
    {
        for to in WRONG {
            let system = Particle::<C>::new(Fault::Applied(to), 0.0);
            let mut run = Integrator::new(method, system, start(), 0.1)?;
            let error = run.step_with_stages().map(|_| ()).expect_err("resized");
            assert_resized(&error, Quantity::Force, to);
            assert_eq!(*run.state(), start());
            run.system().fault.set(Fault::None);
            assert_eq!(run.step_with_stages()?.work(), 0.0);
        }
        Ok(())
    }
    check::<_, General>(Gauss2)?;
    check::<_, Constrained<General>>(Lobatto3)?;
    check::<_, Nonholonomic<General>>(Midpoint)
}

#[test]
fn kicks_with_friction_refuse_resized_results() -> Result<(), Error> {
    for to in WRONG {
        let system = Particle::<Damped>::new(Fault::Kick(to), 0.0);
        let mut run = Integrator::new(StoermerVerlet, system, start(), 0.1)?;
        let error = run.step().map(|_| ()).expect_err("resized");
        assert_resized(&error, Quantity::Kick, to);
        assert!(
            matches!(error, CoreError::EvaluationDimension { stage: None, .. }),
            "{error:?}"
        );
        assert!(
            error
                .to_string()
                .contains("change of the momentum by a kick has dimension"),
            "{error}"
        );
        assert_eq!(*run.state(), start());
        run.system().fault.set(Fault::Applied(to));
        run.step()?;
        let error = run.dense().map(|_| ()).expect_err("resized");
        assert_resized(&error, Quantity::Force, to);
    }
    Ok(())
}

/// The same particle by its Lagrangian, with a force of a wrong dimension.
struct Forced {
    to: usize,
}

impl Lagrangian for Forced {
    type Vector<T: Scalar> = DVector<T>;

    const FORCED: bool = true;

    fn lagrangian<T: Scalar>(&self, _: T, q: &DVector<T>, v: &DVector<T>) -> T {
        (v.dot(v) - q.dot(q)) * T::from_f64(0.5)
    }

    fn force<T: Scalar>(&self, _: T, _: &DVector<T>, _: &DVector<T>, force: &mut DVector<T>) {
        *force = DVector::from_element(self.to, T::one());
    }
}

impl DiracSystem for Forced {}

impl DiscreteLagrangian for Forced {
    type Vector<T: Scalar> = DVector<T>;

    const FORCED: bool = true;

    fn value<T: Scalar>(&self, _: T, h: T, q0: &DVector<T>, q1: &DVector<T>) -> T {
        let difference = q1 - q0;
        difference.dot(&difference) / (h + h)
    }

    fn forces<T: Scalar>(
        &self,
        _: T,
        _: T,
        _: &DVector<T>,
        _: &DVector<T>,
        _minus: &mut DVector<T>,
        plus: &mut DVector<T>,
    ) {
        *plus = DVector::from_element(self.to, T::one());
    }
}

/// The same Lagrangian without a force, whose gradient has a wrong dimension: of `∂L/∂v` or of `∂L/∂q`.
struct WithGradient {
    by_velocity: usize,
    by_position: usize,
}

impl Lagrangian for WithGradient {
    type Vector<T: Scalar> = DVector<T>;

    fn lagrangian<T: Scalar>(&self, _: T, q: &DVector<T>, v: &DVector<T>) -> T {
        (v.dot(v) - q.dot(q)) * T::from_f64(0.5)
    }

    fn gradient<T: Scalar>(
        &self,
        _: T,
        _: &DVector<T>,
        _: &DVector<T>,
        by_velocity: &mut DVector<T>,
        by_position: &mut DVector<T>,
    ) -> bool {
        *by_velocity = DVector::from_element(self.by_velocity, T::one());
        *by_position = DVector::from_element(self.by_position, T::one());
        true
    }
}

#[test]
fn resized_gradients_of_lagrangians_are_refused() {
    for to in WRONG {
        for (by_velocity, by_position, what) in
            [(to, 2, Quantity::Momentum), (2, to, Quantity::Force)]
        {
            let system = WithGradient {
                by_velocity,
                by_position,
            };
            let State { q, p, .. } = start();
            let error = momentum_of_velocity(&system, 0.0, &q, &p).expect_err("resized");
            assert_resized(&error, what, to);
        }
    }
}

#[test]
fn resized_forces_of_lagrangians_are_refused() -> Result<(), Error> {
    for to in WRONG {
        let v = DVector::from_vec(vec![0.5, 0.0]);
        let error = momentum_of_velocity(&Forced { to }, 0.0, &start().q, &v).expect_err("resized");
        assert_resized(&error, Quantity::Force, to);
        let run = VariationalSteps::run(Forced { to }, start(), 0.1);
        let error = run
            .and_then(|mut run| run.step().map(|_| ()))
            .expect_err("resized");
        assert_resized(&error, Quantity::Force, to);
        let q1 = DVector::from_vec(vec![1.05, 0.0]);
        let path = DiscretePath {
            time: 0.0,
            step_size: 0.1,
            q0: &start().q,
            q1: &q1,
        };
        let error = path.momenta(&Forced { to }).expect_err("resized");
        assert_resized(&error, Quantity::Force, to);
        let run = LagrangianSteps::run(Gauss2, Forced { to }, start(), 0.1);
        let error = run
            .and_then(|mut run| run.step().map(|_| ()))
            .expect_err("resized");
        assert_resized(&error, Quantity::Force, to);
        let run = DiracSteps::run(DiracRule::Midpoint, Forced { to }, start(), 0.1);
        let error = run
            .and_then(|mut run| run.step().map(|_| ()))
            .expect_err("resized");
        assert_resized(&error, Quantity::Force, to);
    }
    Ok(())
}

/// The first evaluation of a wrong dimension ends the search for the velocity.
#[test]
fn the_search_for_a_velocity_refuses_resized_results() {
    struct Counted(Cell<u32>);

    impl Lagrangian for Counted {
        type Vector<T: Scalar> = DVector<T>;

        const FORCED: bool = true;

        fn lagrangian<T: Scalar>(&self, _: T, _: &DVector<T>, v: &DVector<T>) -> T {
            self.0.set(self.0.get() + 1);
            v.dot(v) * T::from_f64(0.5)
        }

        fn force<T: Scalar>(&self, _: T, _: &DVector<T>, _: &DVector<T>, force: &mut DVector<T>) {
            *force = DVector::from_element(3, T::one());
        }
    }

    let system = Counted(Cell::new(0));
    let State { q, p, .. } = start();
    let error = velocity_of_momentum(&system, 0.0, &q, &p).expect_err("resized");
    assert_resized(&error, Quantity::Force, 3);
    // n(2n + 1)
    assert_eq!(system.0.get(), 10);
}

/// The particle by its Hamiltonian; its velocity reads every component of the momentum.
struct Resized {
    to: usize,
}

impl Hamiltonian for Resized {
    type Class = Separable;
    type Vector<T: Scalar> = DVector<T>;

    fn velocity<T: Scalar>(&self, _: T, _: &DVector<T>, p: &DVector<T>, velocity: &mut DVector<T>) {
        velocity[0] = p[0];
        velocity[1] = p[1];
    }

    fn force<T: Scalar>(&self, _: T, _: &DVector<T>, _: &DVector<T>, force: &mut DVector<T>) {
        *force = DVector::from_element(self.to, T::one());
    }

    fn energy<T: Scalar>(&self, _: T, _: &DVector<T>, p: &DVector<T>) -> Option<T> {
        Some(p.dot(p) * T::from_f64(0.5))
    }
}

#[test]
fn newmark_refuses_a_resized_force() -> Result<(), Error> {
    for to in WRONG {
        let newmark = Newmark::new(Resized { to }, 0.25, 0.1)?;
        let error = newmark.shift(&start()).expect_err("resized");
        assert_resized(&error, Quantity::Force, to);
        let error = newmark.unshift(&start()).expect_err("resized");
        assert_resized(&error, Quantity::Force, to);
        let State { q, p, .. } = start();
        let energy = System::energy(&newmark, 0.0, &q, &p);
        assert!(energy.is_some_and(f64::is_nan), "{energy:?}");
        let mut run = Integrator::new(StoermerVerlet, newmark, start(), 0.1)?;
        let error = run.step().map(|_| ()).expect_err("resized");
        assert_resized(&error, Quantity::Force, to);
    }
    Ok(())
}
