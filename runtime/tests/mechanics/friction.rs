//! Linear friction with exact kicks.

use crate::methods::{ForestRuth, Gauss4, StoermerVerlet, Yoshida6};
use symplectic::friction::{Damped, Friction, friction_growth};
use symplectic::nalgebra::{Matrix2, SMatrix, SVector, Vector2};
use symplectic::system::Masses;
use symplectic::variational::{Error, StepWithStages};
use symplectic::{Hamiltonian, Integrator, Method, ProvedFor, Scalar, State};

symplectic::composition! {
    /// Forest & Ruth's steps; half kicks of successive steps are at the same position.
    pub TripleJump { base: stormer-verlet, weights: triple_jump(4) }
}

type Plane<T> = SVector<T, 2>;

/// The ring of Marsden & West (2001), Figure 2: H = |p|²/2 + |q|²(|q|² − 1)², with the friction γ.
#[derive(Clone, Copy)]
struct Ring(f64);

impl Hamiltonian for Ring {
    type Class = Damped;
    type Vector<T: Scalar> = Plane<T>;

    const MASSES: Masses = Masses::Unit;

    fn velocity<T: Scalar>(&self, _: T, _: &Plane<T>, p: &Plane<T>, velocity: &mut Plane<T>) {
        *velocity = *p;
    }

    fn force<T: Scalar>(&self, _: T, q: &Plane<T>, _: &Plane<T>, force: &mut Plane<T>) {
        let r = q.dot(q);
        let slope = (r - T::one()) * (T::from_f64(3.0) * r - T::one());
        *force = q * (T::from_f64(-2.0) * slope);
    }

    fn energy<T: Scalar>(&self, _: T, q: &Plane<T>, p: &Plane<T>) -> Option<T> {
        let r = q.dot(q);
        Some(p.dot(p) * T::from_f64(0.5) + r * (r - T::one()) * (r - T::one()))
    }

    fn extra<T: Scalar>(&self) -> Option<&dyn Friction<Plane<T>>> {
        Some(self)
    }
}

impl<T: Scalar> Friction<Plane<T>> for Ring {
    fn friction(&self, _component: usize) -> f64 {
        self.0
    }
}

fn start() -> State<Vector2<f64>> {
    State::from_arrays(0.0, [1.25, 0.0], [0.0, 0.5])
}

fn end<M: Method + ProvedFor<Damped>>(method: M, friction: f64, steps: u32) -> State<Vector2<f64>> {
    let size = 2.0 / f64::from(steps);
    let mut run = Integrator::new(method, Ring(friction), start(), size).expect("a run");
    run.integrate_to(2.0).expect("steps").clone()
}

#[test]
fn the_order_is_that_for_separable_systems() {
    fn slope<M: Method + Copy + ProvedFor<Damped>>(method: M, steps: u32) -> f64 {
        let reference = end(Yoshida6, 0.25, 4000);
        let errors = [steps, 2 * steps].map(|steps| {
            let end = end(method, 0.25, steps);
            (end.q - reference.q).norm() + (end.p - reference.p).norm()
        });
        (errors[0] / errors[1]).log2()
    }
    for (slope, order) in [
        (slope(StoermerVerlet, 200), 2.0),
        (slope(ForestRuth, 200), 4.0),
        (slope(Yoshida6, 120), 6.0),
    ] {
        assert!((slope - order).abs() < 0.05, "{slope} instead of {order}");
    }
}

/// The angular momentum shrinks by e^{−γh} in every step, and so does dq∧dp, whatever the signs of the kicks.
#[test]
fn areas_and_momenta_shrink_exactly() {
    let momentum = |state: &State<Vector2<f64>>| state.q[0] * state.p[1] - state.q[1] * state.p[0];
    let mut run = Integrator::new(ForestRuth, Ring(0.25), start(), 0.1).expect("a run");
    let before = momentum(run.state());
    let after = momentum(run.take_steps(100).expect("steps"));
    assert!((after / before / (-2.5_f64).exp() - 1.0).abs() < 1e-13);

    // One dimension: the determinant of the Jacobian of a step, by differences of order 4.
    let step = |q: f64, p: f64| {
        let state = State::from_arrays(0.0, [q, 0.0], [p, 0.0]);
        let mut run = Integrator::new(ForestRuth, Ring(0.25), state, 0.1).expect("a run");
        let State { q, p, .. } = run.step().expect("a step").clone();
        Vector2::new(q[0], p[0])
    };
    const STEP: f64 = 1e-3;
    let column = |q: f64, p: f64| {
        let [a, b, c, d] =
            [-2.0, -1.0, 1.0, 2.0].map(|by| step(1.25 + by * STEP * q, 0.3 + by * STEP * p));
        (a - d + (c - b) * 8.0) / (12.0 * STEP)
    };
    let determinant = Matrix2::from_columns(&[column(1.0, 0.0), column(0.0, 1.0)]).determinant();
    let exact = (-0.025_f64).exp();
    assert!((determinant - exact).abs() < 1e-10, "{determinant} {exact}");
}

symplectic::hamiltonian! {
    /// Coupled oscillators with another friction on each.
    Unequal { a: 0.3, b: 0.1 }
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + (x^2 + y^4)/2 + x y/3
    friction: [a, 2 b]
}

symplectic::hamiltonian! {
    /// Two points with friction in one direction only.
    OneWay<N>
    q: [N; 2], p: [N; 2];
    H = sum(i: |p[i]|^2/2)
    friction: [1/4, 0]
}

/// With a rate for each component the volume of phase space shrinks by e^{−h tr Γ} in every step.
#[test]
fn volumes_shrink_by_the_trace_of_the_rates() {
    let step = |at: SVector<f64, 4>| {
        let state = State::from_arrays(0.0, [at[0], at[1]], [at[2], at[3]]);
        let mut run = Integrator::new(ForestRuth, Unequal::new(), state, 0.1).expect("a run");
        let State { q, p, .. } = run.step().expect("a step").clone();
        SVector::from([q[0], q[1], p[0], p[1]])
    };
    // By differences of order 4.
    const STEP: f64 = 1e-3;
    let column = |k: usize| {
        let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|by| {
            let mut at = SVector::from([0.7, -0.4, 0.3, 0.5]);
            at[k] += by * STEP;
            step(at)
        });
        (a - d + (c - b) * 8.0) / (12.0 * STEP)
    };
    let columns = [0, 1, 2, 3].map(column);
    let determinant = SMatrix::<f64, 4, 4>::from_columns(&columns).determinant();
    let exact = (-0.1 * (0.3 + 0.2_f64)).exp();
    assert!((determinant - exact).abs() < 1e-10, "{determinant} {exact}");
}

/// The rates of a list belong to the components of every vector, here the columns.
#[test]
fn friction_rates_apply_to_the_components_of_each_vector() {
    let p = Matrix2::new(1.0, 3.0, 2.0, 4.0);
    let start = State::new(0.0, Matrix2::zeros(), p);
    let mut run = Integrator::new(ForestRuth, OneWay::<2>, start, 0.5).expect("a run");
    let end = &run.integrate_to(4.0).expect("steps").p;
    let decay = (-1.0_f64).exp();
    let exact = Matrix2::new(decay, 3.0 * decay, 2.0, 4.0);
    assert!((end - exact).amax() < 1e-15, "{end}");
}

/// The largest growth by friction is that of the middle kicks, (1 − 2^⅓)/(2 (2 − 2^⅓)) of a step.
#[test]
fn friction_growth_is_that_of_the_negative_kicks() {
    let (rate, size) = (3.0, 0.25);
    assert_eq!(friction_growth(StoermerVerlet, rate, size), 0.0);
    let root = 2.0_f64.cbrt();
    let exact = rate * size * (root - 1.0) / (2.0 * (2.0 - root));
    // Half of the middle step alone, −1.7 h/2, would be more than four times as much.
    for found in [
        friction_growth(ForestRuth, rate, size),
        friction_growth(TripleJump, rate, size),
    ] {
        assert!(
            (found - exact).abs() < 4.0 * f64::EPSILON,
            "{found} {exact}"
        );
    }
    // Backward in time the positive kicks grow.
    assert_eq!(
        friction_growth(StoermerVerlet, rate, -size),
        rate * size / 2.0
    );
    for (rate, size) in [(f64::NAN, size), (rate, f64::NAN)] {
        assert!(friction_growth(StoermerVerlet, rate, size).is_nan());
        assert!(friction_growth(ForestRuth, rate, size).is_nan());
    }
}

/// The kicks are exact flows, so there are no stages to balance.
#[test]
fn steps_with_friction_have_no_stages() {
    let mut run = Integrator::new(StoermerVerlet, Ring(1e-3), start(), 0.1).expect("a run");
    let error = run.step_with_stages().expect_err("no stages");
    assert_eq!(error, Error::NoStages);
    assert_eq!((run.steps(), run.state()), (0, &start()));
}

/// The energies of Figure 2 at t = 500, 1000, 1500: those of Störmer–Verlet with h = 0.1 stay near those of small steps.
#[test]
fn the_energy_decays_as_it_should() {
    let energies = |size: f64| {
        let mut run = Integrator::new(StoermerVerlet, Ring(1e-3), start(), size).expect("a run");
        [500.0, 1000.0, 1500.0].map(|time| {
            // The mean over ten units of time, for the error oscillates.
            run.integrate_to(time - 5.0).expect("steps");
            let (mut sum, mut count) = (0.0, 0);
            while run.state().time < time + 5.0 {
                run.step().expect("a step");
                sum += run.energy().expect("known");
                count += 1;
            }
            sum / f64::from(count)
        })
    };
    let exact = energies(0.01);
    for (energy, printed) in exact.iter().zip([0.298, 0.160, 0.092]) {
        assert!((energy - printed).abs() < 2e-3, "{energy} {printed}");
    }
    for (energy, exact) in energies(0.1).iter().zip(exact) {
        assert!((energy - exact).abs() < 6e-3, "{energy} {exact}");
    }
}

/// Without friction the steps are those of a separable system, to the last bit.
#[test]
fn zero_friction_gives_the_bits_of_the_separable_system() {
    struct Undamped;

    impl symplectic::SeparableHamiltonian for Undamped {
        type Vector<T: Scalar> = Plane<T>;

        fn velocity<T: Scalar>(&self, _: T, p: &Plane<T>, velocity: &mut Plane<T>) {
            *velocity = *p;
        }

        fn force<T: Scalar>(&self, time: T, q: &Plane<T>, force: &mut Plane<T>) {
            Hamiltonian::force(&Ring(0.0), time, q, q, force);
        }
    }
    macro_rules! compare {
        ($($with:ident)*) => {$(
            let mut damped = Integrator::$with(ForestRuth, Ring(0.0), start(), 0.1).expect("a run");
            let mut undamped = Integrator::$with(ForestRuth, Undamped, start(), 0.1).expect("a run");
            for _ in 0..20 {
                let (a, b) = (damped.step().expect("a step"), undamped.step().expect("a step"));
                assert_eq!((a.q, a.p), (b.q, b.p));
            }
        )*};
    }
    compare! { plain new }
}

/// Dense output knows the friction: the values inside a step have order 4.
#[test]
fn dense_output_with_friction_has_order_four() {
    let error = |size: f64| {
        let mut run = Integrator::new(ForestRuth, Ring(1.0), start(), size).expect("a run");
        run.step().expect("a step");
        let middle = run
            .dense()
            .expect("a step")
            .state(0.5 * size)
            .expect("inside");
        let fine = size / 200.0;
        let mut run = Integrator::new(Yoshida6, Ring(1.0), start(), fine).expect("a run");
        let exact = run.integrate_to(0.5 * size).expect("steps");
        (middle.p - exact.p).norm()
    };
    let slope = (error(0.04) / error(0.02)).log2();
    assert!(slope > 3.7, "{slope}");
}

/// H = p²/2 + q⁴/4 with a friction that depends on the place, −γ(q)p, γ = (1 + q²)/4: its flow at a fixed position is known.
struct Molasses;

type Line<T> = SVector<T, 1>;

impl Molasses {
    fn rate<T: Scalar>(q: &Line<T>) -> T {
        (q[0] * q[0] + T::one()) * T::from_f64(0.25)
    }
}

impl Hamiltonian for Molasses {
    type Class = Damped;
    type Vector<T: Scalar> = Line<T>;

    const MASSES: Masses = Masses::Unit;
    const FORCED: bool = true;

    fn velocity<T: Scalar>(&self, _: T, _: &Line<T>, p: &Line<T>, velocity: &mut Line<T>) {
        *velocity = *p;
    }

    fn force<T: Scalar>(&self, _: T, q: &Line<T>, _: &Line<T>, force: &mut Line<T>) {
        force[0] = -q[0] * q[0] * q[0];
    }

    fn applied_force<T: Scalar>(&self, _: T, q: &Line<T>, p: &Line<T>, applied: &mut Line<T>) {
        applied[0] = -Self::rate(q) * p[0];
    }

    fn extra<T: Scalar>(&self) -> Option<&dyn Friction<Line<T>>> {
        Some(self)
    }
}

impl<T: Scalar> Friction<Line<T>> for Molasses {
    fn friction(&self, _component: usize) -> f64 {
        0.0
    }

    fn kick(
        &self,
        duration: T,
        q: &Line<T>,
        force: &Line<T>,
        p: &Line<T>,
        change: &mut Line<T>,
    ) -> bool {
        let rate = Self::rate(q);
        let loss = T::one() - (-rate * duration).exp();
        change[0] = loss * (force[0] / rate - p[0]);
        true
    }
}

symplectic::hamiltonian! {
    /// The same by stages.
    pub MolassesByStages
    q: [x], p: [px];
    H = px^2/2 + x^4/4
    force: { x = -(1 + x^2) px/4 }
}

#[test]
fn a_friction_flow_of_the_user_keeps_the_order() {
    let start: State<Line<f64>> = State::from_arrays(0.0, [1.5], [0.5]);
    let mut exact =
        Integrator::new(Gauss4, MolassesByStages, start.clone(), 1.0 / 64.0).expect("a run");
    let end = exact.integrate_to(3.0).expect("steps").clone();
    fn errors<M: Method + ProvedFor<Damped>>(
        method: M,
        start: &State<Line<f64>>,
        end: &State<Line<f64>>,
        steps: u32,
    ) -> f64 {
        let size = 3.0 / f64::from(steps);
        let mut run = Integrator::new(method, Molasses, start.clone(), size).expect("a run");
        let found = run.integrate_to(3.0).expect("steps");
        (found.q - end.q).norm() + (found.p - end.p).norm()
    }
    let slope = |coarse: f64, fine: f64| (coarse / fine).log2();
    let found = slope(
        errors(StoermerVerlet, &start, &end, 200),
        errors(StoermerVerlet, &start, &end, 400),
    );
    assert!((found - 2.0).abs() < 0.05, "{found}");
    let found = slope(
        errors(ForestRuth, &start, &end, 200),
        errors(ForestRuth, &start, &end, 400),
    );
    assert!((found - 4.0).abs() < 0.05, "{found}");
    // Between the steps, with the slope of the momentum at both ends.
    let mut run = Integrator::new(ForestRuth, Molasses, start.clone(), 0.01).expect("a run");
    run.step().expect("a step");
    // At the middle an error of both slopes would cancel.
    let inside = run.dense().expect("a step").state(0.0025).expect("inside");
    let mut exact = Integrator::new(Gauss4, MolassesByStages, start, 0.0025).expect("a run");
    let quarter = exact.step().expect("a step");
    assert!((inside.p - quarter.p).norm() < 1e-9);
}

symplectic::hamiltonian! {
    /// An oscillator with friction, and a drive that is an applied force.
    pub DrivenWithFriction
    q: [x], p: [px];
    H = (px^2 + x^2)/2
    force: { x = 5 cos(t) }
    friction: 0.2
}

/// The applied force of a formula is in its force, and counts once between the steps too.
#[test]
fn an_applied_force_with_friction_counts_once() {
    let start: State<Line<f64>> = State::from_arrays(0.0, [0.3], [0.5]);
    let run =
        |size| Integrator::new(ForestRuth, DrivenWithFriction, start.clone(), size).expect("a run");
    let mut whole = run(0.01);
    whole.step().expect("a step");
    let inside = whole
        .dense()
        .expect("a step")
        .state(0.0025)
        .expect("inside");
    let mut part = run(0.0025);
    let exact = part.step().expect("a step");
    assert!((inside.p - exact.p).norm() < 1e-8);
    // x = 25 sin t is the motion that is driven: −x + x = 0 and 5 cos t = 0.2 p.
    let start: State<Line<f64>> = State::from_arrays(0.0, [0.0], [25.0]);
    let mut run = Integrator::new(ForestRuth, DrivenWithFriction, start, 0.01).expect("a run");
    let end = run.integrate_to(10.0).expect("steps");
    assert!((end.q[0] - 25.0 * 10.0_f64.sin()).abs() < 1e-6);
}
