//! Circuits: degenerate Lagrangians with the laws of Kirchhoff for the currents.

use symplectic::constraints::Gradients;
use symplectic::nalgebra::{SVector, Vector4};
use symplectic::system::Lagrangian;
use symplectic::variational::{
    DiracRule, DiracSteps, DiracSystem, Error, momentum_of_velocity, primary_constraints,
};
use symplectic::{Scalar, State};

use crate::dirac::{Jump6, Suzuki4, assert_order, distance};

type V4<T> = SVector<T, 4>;

/// The circuit of Yoshimura & Marsden (2006), with the charges of an inductor and of three capacitors:
/// L = ℓ v0²/2 − Σ q_i²/2C_i − βq3⁴/4, −v0 + v2 = 0, −v1 + v2 − v3 = 0.
#[derive(Clone, Copy)]
pub struct Circuit {
    pub beta: f64,
}

const INDUCTANCE: f64 = 0.7;
const CAPACITIES: [f64; 3] = [1.3, 0.6, 0.9];

impl Lagrangian for Circuit {
    type Vector<T: Scalar> = V4<T>;

    fn lagrangian<T: Scalar>(&self, _: T, q: &V4<T>, v: &V4<T>) -> T {
        let half = T::from_f64(0.5);
        let [a, b, c] = CAPACITIES.map(|capacity| T::from_f64(0.5 / capacity));
        let stored = q[1] * q[1] * a + q[2] * q[2] * b + q[3] * q[3] * c;
        v[0] * v[0] * half * T::from_f64(INDUCTANCE)
            - stored
            - q[3].powi(4) * T::from_f64(self.beta / 4.0)
    }
}

impl DiracSystem for Circuit {
    fn nonholonomic_constraints(&self) -> usize {
        2
    }

    fn nonholonomic_rows<T: Scalar>(&self, _: &V4<T>, rows: &mut Gradients<T>) {
        rows.set(0, 0, -T::one());
        rows.set(0, 2, T::one());
        rows.set(1, 1, -T::one());
        rows.set(1, 2, T::one());
        rows.set(1, 3, -T::one());
    }
}

impl Circuit {
    /// The voltages of the two capacitors that are in parallel.
    fn voltages(&self, q: &Vector4<f64>) -> [f64; 2] {
        let [a, _, c] = CAPACITIES;
        [q[1] / a, q[3] / c + self.beta * q[3].powi(3)]
    }

    fn loop_voltage(&self, q: &Vector4<f64>) -> f64 {
        let [a, b] = self.voltages(q);
        a - b
    }
}

/// With the current 0.4 in the inductor, and the same voltage on both capacitors.
pub fn circuit_start(circuit: Circuit) -> State<Vector4<f64>> {
    let q3 = 0.5;
    let mut q = Vector4::new(0.1, 0.0, -0.3, q3);
    q[1] = circuit.voltages(&q)[1] * CAPACITIES[0];
    let v = Vector4::new(0.4, 0.0, 0.0, 0.0);
    let p = momentum_of_velocity(&circuit, 0.0, &q, &v).expect("finite");
    State::new(0.0, q, p)
}

/// Without β: ℓ f' = −V, V' = f (1/(C1 + C3) + 1/C2) for V = q1/C1 + q2/C2; the charges of the capacitors follow the charge of the inductor.
pub fn circuit_exact(time: f64) -> State<Vector4<f64>> {
    let State { q, p, .. } = circuit_start(Circuit { beta: 0.0 });
    let [a, b, c] = CAPACITIES;
    let rate = ((1.0 / (a + c) + 1.0 / b) / INDUCTANCE).sqrt();
    let (current, voltage) = (p[0] / INDUCTANCE, q[1] / a + q[2] / b);
    let (sin, cos) = (rate * time).sin_cos();
    let charge = current / rate * sin + voltage / (INDUCTANCE * rate * rate) * (cos - 1.0);
    let momentum = INDUCTANCE * current * cos - voltage / rate * sin;
    let shares = Vector4::new(1.0, a / (a + c), 1.0, c / (a + c));
    State::new(
        time,
        q + shares * charge,
        Vector4::new(momentum, 0.0, 0.0, 0.0),
    )
}

/// The error of the circuit at t = 1.
fn circuit_error(rule: DiracRule, size: f64) -> f64 {
    let circuit = Circuit { beta: 0.0 };
    let mut run = DiracSteps::run(rule, circuit, circuit_start(circuit), size).expect("a run");
    let end = run.integrate_to(1.0).expect("steps");
    let exact = circuit_exact(1.0);
    distance(end.q.as_slice(), exact.q.as_slice())
        .max(distance(end.p.as_slice(), exact.p.as_slice()))
}

#[test]
fn dirac_rules_have_their_orders_on_a_circuit() {
    assert_order(2.0, 10, |size| circuit_error(DiracRule::Trapezoid, size));
    assert_order(2.0, 10, |size| circuit_error(DiracRule::Midpoint, size));
    assert_order(1.0, 160, |size| circuit_error(DiracRule::AtEnd, size));
}

/// KCL and the primary constraints with each rule, KVL of the loop of capacitors with trapezoids, the energy of linear elements at the middle.
#[test]
#[ignore = "thorough"]
fn circuit_steps_keep_kirchhoff_laws_and_energy() {
    let circuit = Circuit { beta: 0.0 };
    for rule in [DiracRule::Trapezoid, DiracRule::Midpoint, DiracRule::AtEnd] {
        let start = circuit_start(circuit);
        let mut run = DiracSteps::run(rule, circuit, start.clone(), 0.1).expect("a run");
        let energy = run.stepper().energy();
        let (mut loops, mut drift) = (0.0_f64, 0.0_f64);
        for _ in 0..2000 {
            let State { q, p, .. } = run.step().expect("a step").clone();
            let way = q - start.q;
            assert!((way[2] - way[0]).abs() + (way[2] - way[1] - way[3]).abs() < 1e-12);
            assert_eq!((p[1], p[2], p[3]), (0.0, 0.0, 0.0));
            let v = run.stepper().velocity();
            assert!((v[2] - v[0]).abs() + (v[2] - v[1] - v[3]).abs() < 1e-14);
            loops = loops.max(circuit.loop_voltage(&q).abs());
            drift = drift.max((run.stepper().energy() - energy).abs());
        }
        match rule {
            DiracRule::Trapezoid => assert!(loops < 1e-14 && drift < 3e-3, "{loops:e} {drift:e}"),
            DiracRule::Midpoint => assert!(loops < 1e-11 && drift < 1e-12, "{loops:e} {drift:e}"),
            _ => assert!(loops < 1e-14 && drift > 5e-3, "{loops:e} {drift:e}"),
        }
    }
}

/// The linear circuit with a resistor R and a voltage Et in series with the inductor: the force Et − R v0.
#[derive(Clone, Copy)]
struct Driven;

const RESISTANCE: f64 = 0.3;
const RAMP: f64 = 0.8;
const LINEAR: Circuit = Circuit { beta: 0.0 };

impl Lagrangian for Driven {
    type Vector<T: Scalar> = V4<T>;

    const FORCED: bool = true;

    fn lagrangian<T: Scalar>(&self, time: T, q: &V4<T>, v: &V4<T>) -> T {
        LINEAR.lagrangian(time, q, v)
    }

    fn force<T: Scalar>(&self, time: T, _: &V4<T>, v: &V4<T>, force: &mut V4<T>) {
        force[0] = T::from_f64(RAMP) * time - T::from_f64(RESISTANCE) * v[0];
    }
}

impl DiracSystem for Driven {
    fn nonholonomic_constraints(&self) -> usize {
        LINEAR.nonholonomic_constraints()
    }

    fn nonholonomic_rows<T: Scalar>(&self, q: &V4<T>, rows: &mut Gradients<T>) {
        LINEAR.nonholonomic_rows(q, rows);
    }
}

/// ℓF'' + RF' + F/C = Et − V for the charge F that has gone through the inductor.
fn driven_charge(time: f64) -> f64 {
    let q = circuit_start(LINEAR).q;
    let [a, b, c] = CAPACITIES;
    let capacity = 1.0 / (1.0 / (a + c) + 1.0 / b);
    let damping = RESISTANCE / (2.0 * INDUCTANCE);
    let rate = (1.0 / (INDUCTANCE * capacity) - damping * damping).sqrt();
    let slope = capacity * RAMP;
    let offset = -capacity * (q[1] / a + q[2] / b + RESISTANCE * slope);
    let swing = (0.4 - slope - damping * offset) / rate;
    let (sin, cos) = (rate * time).sin_cos();
    slope * time + offset + (-damping * time).exp() * (swing * sin - offset * cos)
}

/// Forces that depend on the velocity and the time.
#[test]
fn dirac_rules_have_their_orders_on_a_driven_circuit() {
    let error = |rule, composed, size| {
        let start = circuit_start(LINEAR);
        let run = if composed {
            DiracSteps::composed(Suzuki4, rule, Driven, start, size)
        } else {
            DiracSteps::run(rule, Driven, start, size)
        };
        let mut run = run.expect("a run");
        let q = run.integrate_to(1.0).expect("steps").q;
        (q[0] - 0.1 - driven_charge(1.0)).abs()
    };
    assert_order(2.0, 10, |size| error(DiracRule::Trapezoid, false, size));
    assert_order(2.0, 10, |size| error(DiracRule::Midpoint, false, size));
    assert_order(1.0, 160, |size| error(DiracRule::AtEnd, false, size));
    assert_order(4.0, 5, |size| error(DiracRule::Trapezoid, true, size));
}

/// The circuit with this unit of time.
#[derive(Clone, Copy)]
struct InUnits(f64);

impl Lagrangian for InUnits {
    type Vector<T: Scalar> = V4<T>;

    fn lagrangian<T: Scalar>(&self, time: T, q: &V4<T>, v: &V4<T>) -> T {
        let unit = T::from_f64(self.0);
        LINEAR.lagrangian(time, q, &(v * unit)) / unit
    }
}

impl DiracSystem for InUnits {
    fn nonholonomic_constraints(&self) -> usize {
        LINEAR.nonholonomic_constraints()
    }

    fn nonholonomic_rows<T: Scalar>(&self, q: &V4<T>, rows: &mut Gradients<T>) {
        LINEAR.nonholonomic_rows(q, rows);
    }
}

/// Nanoseconds and years, a charge of 10⁻⁹: the steps are the same.
#[test]
fn circuit_steps_do_not_depend_on_units() {
    let mut run = DiracSteps::run(DiracRule::Trapezoid, LINEAR, circuit_start(LINEAR), 0.05);
    let expected = run
        .as_mut()
        .expect("a run")
        .integrate_to(2.0)
        .expect("steps")
        .q;
    for (time, charge) in [(1e-9, 1.0), (1e8, 1.0), (1e-9, 1e-9)] {
        let State { q, p, .. } = circuit_start(LINEAR);
        let start = State::new(0.0, q * charge, p * charge);
        let run = DiracSteps::run(DiracRule::Trapezoid, InUnits(time), start, 0.05 * time);
        let q = run
            .expect("a run")
            .integrate_to(2.0 * time)
            .expect("steps")
            .q
            / charge;
        let apart = distance(q.as_slice(), expected.as_slice());
        assert!(apart < 1e-13, "{time:e} {charge:e}: {apart:e}");
    }
}

/// The state at t = 1 of the circuit with a capacitor that is not linear.
fn nonlinear_end(rule: DiracRule, order: u32, size: f64) -> State<Vector4<f64>> {
    let circuit = Circuit { beta: 2.0 };
    let start = circuit_start(circuit);
    let run = match order {
        2 => DiracSteps::run(rule, circuit, start, size),
        4 => DiracSteps::composed(Suzuki4, rule, circuit, start, size),
        _ => DiracSteps::composed(Jump6, rule, circuit, start, size),
    };
    let mut run = run.expect("a run");
    run.integrate_to(1.0).expect("steps").clone()
}

/// Compositions of the trapezoidal rule have their order, for it keeps the condition on positions at both ends. The midpoint rule takes the error of
/// that condition from one end to the other with the opposite sign, which is not near the identity: compositions have order 2.
#[test]
fn only_compositions_of_trapezoids_keep_their_order_on_a_circuit() {
    let exact = nonlinear_end(DiracRule::Trapezoid, 6, 1.0 / 64.0);
    let error = |rule, order, size: f64| {
        let end = nonlinear_end(rule, order, size);
        distance(end.q.as_slice(), exact.q.as_slice())
    };
    // `assert_order` bounds the slope from both sides.
    assert_order(2.0, 10, |size| error(DiracRule::Trapezoid, 2, size));
    assert_order(4.0, 8, |size| error(DiracRule::Trapezoid, 4, size));
    assert_order(6.0, 8, |size| error(DiracRule::Trapezoid, 6, size));
    assert_order(2.0, 10, |size| error(DiracRule::Midpoint, 2, size));
    assert_order(2.0, 16, |size| error(DiracRule::Midpoint, 4, size));
}

/// The mean energy error over each quarter of a long run, and the largest loop voltage.
fn long_run(rule: DiracRule) -> ([f64; 4], f64) {
    const STEPS: u32 = 1000;
    let circuit = Circuit { beta: 2.0 };
    let mut run = DiracSteps::run(rule, circuit, circuit_start(circuit), 0.1).expect("a run");
    let (before, mut loops) = (run.stepper().energy(), 0.0_f64);
    let means = [(); 4].map(|()| {
        let mut sum = 0.0;
        for _ in 0..STEPS {
            let q = run.step().expect("a step").q;
            loops = loops.max(circuit.loop_voltage(&q).abs());
            sum += run.stepper().energy() - before;
        }
        sum / f64::from(STEPS)
    });
    (means, loops)
}

#[test]
#[ignore = "thorough"]
fn the_energy_of_a_nonlinear_circuit_stays() {
    let (means, loops) = long_run(DiracRule::Trapezoid);
    let drift = means.map(|mean| (mean - means[0]).abs());
    assert!(drift.iter().all(|drift| *drift < 2e-5), "{means:?}");
    assert!(
        means[0].abs() < 2e-3 && loops < 3e-15,
        "{means:?} {loops:e}"
    );
    let (means, loops) = long_run(DiracRule::Midpoint);
    let drift = means.map(|mean| (mean - means[0]).abs());
    assert!(drift.iter().all(|drift| *drift < 2e-5), "{means:?}");
    assert!(
        means[0].abs() < 2e-3 && (1e-5..1e-2).contains(&loops),
        "{means:?} {loops:e}"
    );
}

/// There and back.
#[test]
fn symmetric_rules_go_back() {
    let circuit = Circuit { beta: 2.0 };
    let back = |there: DiracRule, back: DiracRule| {
        let start = circuit_start(circuit);
        let mut run = DiracSteps::run(there, circuit, start.clone(), 0.1).expect("a run");
        (0..50).for_each(|_| drop(run.step().expect("a step").clone()));
        let turn = run.state().clone();
        let mut run = DiracSteps::run(back, circuit, turn, -0.1).expect("a run");
        (0..50).for_each(|_| drop(run.step().expect("a step").clone()));
        distance(run.state().q.as_slice(), start.q.as_slice())
    };
    for rule in [DiracRule::Trapezoid, DiracRule::Midpoint] {
        let way = back(rule, rule);
        assert!(way < 1e-12, "{rule:?} {way:e}");
    }
    let astray = back(DiracRule::AtEnd, DiracRule::AtEnd);
    assert!(astray > 1e-3, "{astray:e}");
}

/// Starts off a primary constraint, and off the condition on positions; a position that nothing determines.
#[test]
fn circuit_starts_off_the_constraints_are_refused() {
    let circuit = Circuit { beta: 0.0 };
    let mut start = circuit_start(circuit);
    start.p[2] = 0.125;
    let run = DiracSteps::run(DiracRule::Midpoint, circuit, start, 0.1);
    let (component, value) = (2, 0.125);
    assert_eq!(
        run.map(|_| ()),
        Err(Error::PrimaryConstraint { component, value })
    );

    let mut off = circuit_start(circuit);
    off.q[1] += 1e-3;
    let new = |rule| DiracSteps::run(rule, circuit, off.clone(), 0.1).expect("a run");
    let error = new(DiracRule::Trapezoid)
        .step()
        .map(|_| ())
        .expect_err("off");
    assert!(
        matches!(error, Error::ContradictoryStep { step: 1, .. }),
        "{error}"
    );
    // One step of the rule at the end takes it there.
    let mut run = new(DiracRule::AtEnd);
    let there = run.step().expect("a step").clone();
    assert!(circuit.loop_voltage(&there.q).abs() < 1e-15);
    let mut run = DiracSteps::run(DiracRule::Trapezoid, circuit, there, 0.1).expect("a run");
    run.step().expect("consistent");

    let start = circuit_start(circuit);
    let mut run = DiracSteps::run(DiracRule::AtStart, circuit, start, 0.1).expect("a run");
    let error = run.step().map(|_| ()).expect_err("not determined");
    assert!(
        matches!(error, Error::UndeterminedPosition { step: 1, .. }),
        "{error}"
    );
}

#[test]
fn primary_constraints_of_a_circuit_are_found() {
    let circuit = Circuit { beta: 0.0 };
    let q = circuit_start(circuit).q;
    let found = primary_constraints(&circuit, 0.0, &q, &V4::zeros()).expect("finite");
    let found: Vec<_> = found
        .iter()
        .map(|found| (found.direction, found.value))
        .collect();
    let unit = |k: usize| V4::from_fn(|i, _| if i == k { 1.0 } else { 0.0 });
    assert_eq!(found, [(unit(1), 0.0), (unit(2), 0.0), (unit(3), 0.0)]);
}
