//! Degenerate Lagrangians, and constraints on velocities: vortices and rolling.

use symplectic::constraints::{Gradients, NonholonomicConstraints};
use symplectic::nalgebra::SVector;
use symplectic::system::Lagrangian;
use symplectic::variational::{
    DiracRule, DiracSteps, DiracSystem, Error, momentum_of_velocity, primary_constraints,
};
use symplectic::{
    Error as CoreError, Integrator, Method, ProvedFor, Quantity, Scalar, State, System, Vector,
};

use crate::rolling::{
    AtEnd, AtStart, Disk, INERTIA, LENGTH, Midpoint, Oscillator, RADIUS, Skate, Sleigh, Trapezoid,
    disk_start, oscillator_start, sleigh_momentum,
};

symplectic::composition! {
    pub Suzuki4 { base: stormer-verlet, weights: suzuki(4), require: [order == 4] }
    pub Jump6 { base: stormer-verlet, weights: triple_jump(6), require: [order == 6] }
}

type V3<T> = SVector<T, 3>;
type V4<T> = SVector<T, 4>;

pub fn distance(a: &[f64], b: &[f64]) -> f64 {
    let pairs = a.iter().zip(b);
    pairs.fold(0.0_f64, |largest, (a, b)| largest.max((a - b).abs()))
}

/// Checks that errors at t = 1 shrink with an order and no other one.
#[track_caller]
pub fn assert_order(order: f64, steps: u32, error: impl Fn(f64) -> f64) {
    let errors = [1, 2, 4].map(|factor| error(1.0 / f64::from(factor * steps)));
    let slopes = [0, 1].map(|k| (errors[k] / errors[k + 1]).log2());
    assert!(
        (slopes[1] - order).abs() < 0.05,
        "slopes {slopes:?} of {errors:?}"
    );
}

/// The Lagrangians of the systems with a Hamiltonian and rows.
macro_rules! lagrangian_of {
    ($name:ident, $vector:ident, $this:ident, $q:ident, $v:ident, $value:expr) => {
        impl Lagrangian for $name {
            type Vector<T: Scalar> = $vector<T>;

            fn lagrangian<T: Scalar>(&self, _: T, $q: &$vector<T>, $v: &$vector<T>) -> T {
                let $this = self;
                $value
            }
        }

        impl DiracSystem for $name {
            fn nonholonomic_constraints(&self) -> usize {
                NonholonomicConstraints::<$vector<f64>>::nonholonomic_constraints(self)
            }

            fn nonholonomic_rows<T: Scalar>(&self, q: &$vector<T>, rows: &mut Gradients<T>) {
                NonholonomicConstraints::nonholonomic_rows(self, q, rows);
            }
        }
    };
}

lagrangian_of!(Disk, V4, _this, _q, v, {
    let half = T::from_f64(0.5);
    (v[0] * v[0] + v[1] * v[1]) * half
        + v[2] * v[2] * T::from_f64(0.15)
        + v[3] * v[3] * T::from_f64(0.1)
});
lagrangian_of!(Skate, V3, this, q, v, {
    v.dot(v) * T::from_f64(0.5) + q[0] * T::from_f64(this.slope)
});
lagrangian_of!(Oscillator, V3, _this, q, v, {
    (v.dot(v) - q[0] * q[0] - q[1] * q[1]) * T::from_f64(0.5)
});
lagrangian_of!(Sleigh, V3, _this, q, v, {
    let (sin, cos, arm) = (q[2].sin(), q[2].cos(), T::from_f64(LENGTH) * v[2]);
    let speed = (v[0] - arm * sin).powi(2) + (v[1] + arm * cos).powi(2);
    (speed + v[2] * v[2] * T::from_f64(INERTIA)) * T::from_f64(0.5)
});

/// How far a hundred steps of a regular Lagrangian are from those of its Hamiltonian.
fn difference<M, S, V>(method: M, rule: DiracRule, system: S, start: State<V>) -> f64
where
    V: Vector<Scalar = f64>,
    M: Method + ProvedFor<<S as System<V>>::Class>,
    S: DiracSystem<Vector<f64> = V> + System<V> + Copy,
{
    let mut one = Integrator::new(method, system, start.clone(), 0.1).expect("a run");
    let mut other = DiracSteps::run(rule, system, start, 0.1).expect("a run");
    (0..100).fold(0.0_f64, |largest, _| {
        let (one, other) = (one.step().expect("a step"), other.step().expect("a step"));
        let ((q, p), (r, s)) = (one.as_slices(), other.as_slices());
        largest.max(distance(q, r)).max(distance(p, s))
    })
}

#[test]
fn regular_lagrangians_take_the_steps_of_their_hamiltonians() {
    let skate = (
        Skate { slope: 2.0 },
        State::from_arrays(0.0, [0.0; 3], [0.0, 0.0, 1.5]),
    );
    let momentum = sleigh_momentum(0.3, -0.4, 1.1);
    let sleigh = State::new(0.0, V3::from([0.1, 0.2, 0.3]), momentum);
    for apart in [
        difference(Midpoint, DiracRule::Midpoint, Disk, disk_start()),
        difference(Trapezoid, DiracRule::Trapezoid, Disk, disk_start()),
        difference(AtStart, DiracRule::AtStart, Disk, disk_start()),
        difference(AtEnd, DiracRule::AtEnd, Disk, disk_start()),
        difference(Midpoint, DiracRule::Midpoint, skate.0, skate.1.clone()),
        difference(Trapezoid, DiracRule::Trapezoid, skate.0, skate.1.clone()),
        difference(
            Midpoint,
            DiracRule::Midpoint,
            Oscillator,
            oscillator_start(),
        ),
        difference(
            Trapezoid,
            DiracRule::Trapezoid,
            Oscillator,
            oscillator_start(),
        ),
        difference(AtStart, DiracRule::AtStart, Oscillator, oscillator_start()),
        difference(Midpoint, DiracRule::Midpoint, Sleigh, sleigh),
    ] {
        assert!(apart < 1e-12, "{apart:e}");
    }
    let other = difference(
        Trapezoid,
        DiracRule::Midpoint,
        Oscillator,
        oscillator_start(),
    );
    assert!(other > 1e-4, "{other:e}");
    assert!((RADIUS * 1.3 - disk_start().p[0].hypot(disk_start().p[1])).abs() < 1e-15);
}

/// The disk that rolls, without a moment of inertia about its axis: θ is in no momentum.
#[derive(Clone, Copy)]
struct LightDisk;

impl Lagrangian for LightDisk {
    type Vector<T: Scalar> = V4<T>;

    fn lagrangian<T: Scalar>(&self, _: T, _: &V4<T>, v: &V4<T>) -> T {
        (v[0] * v[0] + v[1] * v[1]) * T::from_f64(0.5) + v[3] * v[3] * T::from_f64(0.1)
    }
}

impl DiracSystem for LightDisk {
    fn nonholonomic_constraints(&self) -> usize {
        2
    }

    fn nonholonomic_rows<T: Scalar>(&self, q: &V4<T>, rows: &mut Gradients<T>) {
        NonholonomicConstraints::nonholonomic_rows(&Disk, q, rows);
    }
}

/// θ and φ grow by the same amounts in every step, hω/cos(Ωh/2) and hΩ, and the disk goes round on a circle: the closed form of the disk with I = 0.
#[test]
fn a_disk_without_inertia_goes_round_on_a_circle() {
    const SIZE: f64 = 0.3;
    let mut start = disk_start();
    start.p[2] = 0.0;
    let turned = 0.8 * SIZE;
    let rolled = 1.3 * SIZE / (turned / 2.0).cos();
    let radius = RADIUS * rolled / (2.0 * (turned / 2.0).sin());
    let (sin, cos) = start.q[3].sin_cos();
    let centre = [start.q[0] - radius * sin, start.q[1] + radius * cos];
    let run = DiracSteps::run(DiracRule::Midpoint, LightDisk, start.clone(), SIZE);
    let mut run = run.expect("a run");
    assert!((run.stepper().velocity()[2] - 1.3).abs() < 1e-15);
    for k in 1..=200 {
        let State { q, p, .. } = run.step().expect("a step").clone();
        assert!(
            (q[2] - 0.1 - f64::from(k) * rolled).abs() < 1e-12,
            "θ, step {k}"
        );
        assert!(
            (q[3] - 0.3 - f64::from(k) * turned).abs() < 1e-12,
            "φ, step {k}"
        );
        let found = (q[0] - centre[0]).hypot(q[1] - centre[1]);
        assert!(
            (found - radius).abs() < 1e-12,
            "step {k}: {found} for {radius}"
        );
        assert!(p[2] == 0.0 && (run.stepper().velocity()[2] - 1.3).abs() < 1e-12);
    }
}

/// Point vortices of unit strength: L = Σ (x_i y_i' − y_i x_i')/2 − H, q = (x1, x2, x3, y1, y2, y3).
#[derive(Clone, Copy)]
pub struct Vortices;

pub type V6<T> = SVector<T, 6>;

/// H = −Σ ln r_ij² / 4
fn vortex_energy<T: Scalar>(at: impl Fn(usize) -> [T; 2]) -> T {
    let pairs = [(0, 1), (0, 2), (1, 2)];
    pairs.into_iter().fold(T::zero(), |sum, (i, j)| {
        let ([a, b], [c, d]) = (at(i), at(j));
        sum - ((a - c).powi(2) + (b - d).powi(2)).ln() * T::from_f64(0.25)
    })
}

impl Lagrangian for Vortices {
    type Vector<T: Scalar> = V6<T>;

    fn lagrangian<T: Scalar>(&self, _: T, q: &V6<T>, v: &V6<T>) -> T {
        let half = T::from_f64(0.5);
        let area = (0..3).fold(T::zero(), |sum, i| {
            sum + (q[i] * v[3 + i] - q[3 + i] * v[i]) * half
        });
        area - vortex_energy(|i| [q[i], q[3 + i]])
    }
}

impl DiracSystem for Vortices {}

symplectic::hamiltonian! {
    /// The vortices with q = y and p = x.
    pub CanonicalVortices
    q: [a, b, c], p: [pa, pb, pc];
    H = -(ln((a - b)^2 + (pa - pb)^2) + ln((a - c)^2 + (pa - pc)^2) + ln((b - c)^2 + (pb - pc)^2))/4
}

const VORTICES: [f64; 6] = [0.0, 1.0, 0.3, 0.1, 0.0, 0.8];

pub fn vortices_start() -> State<V6<f64>> {
    let q = V6::from(VORTICES);
    let p = momentum_of_velocity(&Vortices, 0.0, &q, &V6::zeros()).expect("finite");
    State::new(0.0, q, p)
}

/// At the middle: Gauss with one stage, and p1 = a(q1) without being asked for.
#[test]
#[ignore = "thorough"]
fn vortices_take_the_midpoint_rule() {
    let [x, y] = [0, 3].map(|k| V3::from([VORTICES[k], VORTICES[k + 1], VORTICES[k + 2]]));
    let start = State::new(0.0, y, x);
    let mut one = Integrator::new(Midpoint, CanonicalVortices, start, 0.1).expect("a run");
    let mut other =
        DiracSteps::run(DiracRule::Midpoint, Vortices, vortices_start(), 0.1).expect("a run");
    let before = other.stepper().energy();
    for step in 0..1000 {
        let State { q: y, p: x, .. } = one.step().expect("a step").clone();
        let State { q, p, .. } = other.step().expect("a step");
        let apart = distance(&q.as_slice()[..3], x.as_slice());
        let apart = apart.max(distance(&q.as_slice()[3..], y.as_slice()));
        assert!(apart < 1e-11, "step {step}: {apart:e}");
        let image = (0..3).map(|i| (p[i] + q[3 + i] / 2.0).abs() + (p[3 + i] - q[i] / 2.0).abs());
        assert_eq!(image.sum::<f64>(), 0.0);
        assert!((other.stepper().energy() - before).abs() < 2e-3);
    }
    let found = primary_constraints(&Vortices, 0.0, &other.state().q, &V6::zeros());
    let found = found.expect("finite");
    assert_eq!(found.len(), 6);
    for (k, constraint) in found.iter().enumerate() {
        let unit = V6::from_fn(|i, _| if i == k { 1.0 } else { 0.0 });
        assert_eq!(
            (constraint.direction, constraint.value),
            (unit, other.state().p[k])
        );
    }
}

#[test]
fn compositions_of_the_midpoint_rule_keep_their_order_on_vortices() {
    let end = |size| {
        let run = DiracSteps::composed(
            Suzuki4,
            DiracRule::Midpoint,
            Vortices,
            vortices_start(),
            size,
        );
        run.expect("a run")
            .integrate_to(1.0)
            .expect("steps")
            .clone()
    };
    let exact = end(1.0 / 128.0);
    assert_order(4.0, 4, |size| {
        distance(end(size).q.as_slice(), exact.q.as_slice())
    });
}

/// There D2 Ld is not a(q1).
#[test]
fn vortices_do_not_take_other_rules() {
    for rule in [DiracRule::Trapezoid, DiracRule::AtStart, DiracRule::AtEnd] {
        let mut run = DiracSteps::run(rule, Vortices, vortices_start(), 0.1).expect("a run");
        let error = run.step().map(|_| ()).expect_err("a contradiction");
        let momentum = Quantity::Momentum;
        assert!(
            matches!(error, Error::ContradictoryStep { step: 1, what, value, .. } if what == momentum && value > 1e-4),
            "{rule:?}: {error}"
        );
        assert_eq!((run.state(), run.steps()), (&vortices_start(), 0));
    }
}

/// L = (x + βx²) y' − (x² + y²)/2
#[derive(Clone, Copy)]
struct Linear {
    beta: f64,
}

impl Lagrangian for Linear {
    type Vector<T: Scalar> = SVector<T, 2>;

    fn lagrangian<T: Scalar>(&self, _: T, q: &SVector<T, 2>, v: &SVector<T, 2>) -> T {
        let momentum = q[0] + q[0] * q[0] * T::from_f64(self.beta);
        momentum * v[1] - q.dot(q) * T::from_f64(0.5)
    }
}

impl DiracSystem for Linear {}

/// a(q0) + a(q1) is not 2a at the middle, unless a is linear.
#[test]
fn momenta_that_are_not_linear_contradict_the_midpoint_rule() {
    let start = |beta: f64| State::from_arrays(0.0, [0.6, 0.2], [0.0, 0.6 + beta * 0.36]);
    let new = |beta| DiracSteps::run(DiracRule::Midpoint, Linear { beta }, start(beta), 0.1);
    new(0.0).expect("a run").integrate_to(10.0).expect("steps");
    let mut run = new(0.5).expect("a run");
    let error = run.step().map(|_| ()).expect_err("a contradiction");
    assert!(
        matches!(error, Error::ContradictoryStep { step: 1, .. }),
        "{error}"
    );
}

/// L = v²/2 + ln x is NaN for x < 0, but has derivatives there.
struct Logarithm;

impl Lagrangian for Logarithm {
    type Vector<T: Scalar> = SVector<T, 1>;

    fn lagrangian<T: Scalar>(&self, _: T, q: &SVector<T, 1>, v: &SVector<T, 1>) -> T {
        v[0] * v[0] * T::from_f64(0.5) + q[0].ln()
    }
}

impl DiracSystem for Logarithm {}

/// The first iterate, with the velocity of the start, ends at x = −0.1. The middle m of the step solves 4m² − 1.8m − 1/4 = 0.
#[test]
fn an_iterate_outside_the_domain_of_the_lagrangian_is_left() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [1.0], [-2.2]);
    let mut run = DiracSteps::run(DiracRule::Midpoint, Logarithm, start, 0.5)?;
    let middle = (1.8 + (1.8_f64.powi(2) + 4.0).sqrt()) / 8.0;
    let end = run.step()?.q[0];
    assert!((end - (2.0 * middle - 1.0)).abs() < 1e-15, "{end}");
    Ok(())
}

/// L = |v|²/2 with rows that are told: two equal ones, one that vanishes at x = 1, more than components, one out of place.
#[derive(Clone, Copy, PartialEq)]
enum Rows {
    Equal,
    Vanishing,
    Many,
    Misplaced,
    Moving,
}

impl Lagrangian for Rows {
    type Vector<T: Scalar> = SVector<T, 2>;

    fn lagrangian<T: Scalar>(&self, _: T, _: &SVector<T, 2>, v: &SVector<T, 2>) -> T {
        v.dot(v) * T::from_f64(0.5)
    }
}

impl DiracSystem for Rows {
    fn nonholonomic_constraints(&self) -> usize {
        match self {
            Self::Equal => 2,
            Self::Many => 3,
            _ => 1,
        }
    }

    fn nonholonomic_rows<T: Scalar>(&self, q: &SVector<T, 2>, rows: &mut Gradients<T>) {
        match self {
            Self::Equal => (0..2).for_each(|row| rows.set(row, 1, T::one())),
            Self::Vanishing => rows.set(0, 1, T::one() - q[0]),
            Self::Many => (0..3).for_each(|row| rows.set(row, 1, T::one())),
            Self::Misplaced => rows.set(0, 2, T::one()),
            Self::Moving => {
                let here = q[0].magnitude() == T::zero().magnitude();
                rows.set(0, if here { 1 } else { 0 }, T::one());
            }
        }
    }
}

#[test]
fn dirac_steps_refuse_dependent_or_wrong_rows() {
    let start = State::from_arrays(0.0, [0.0, 0.0], [1.0, 0.0]);
    let new = |rows, start| DiracSteps::run(DiracRule::Midpoint, rows, start, 0.1);
    let mut run = new(Rows::Equal, start.clone()).expect("a run");
    let error = run.step().map(|_| ()).expect_err("equal rows");
    assert!(
        matches!(
            error,
            Error::Core(CoreError::DependentConstraints {
                constraint: 0 | 1,
                ..
            })
        ),
        "{error}"
    );
    // A row that does not vanish yet, and one that does.
    let mut run = new(Rows::Vanishing, start.clone()).expect("a run");
    run.integrate_to(0.5).expect("steps");
    let vanishing = State::from_arrays(0.0, [1.0, 0.0], [1.0, 0.0]);
    let mut run = new(Rows::Vanishing, vanishing.clone()).expect("a run");
    let error = run.step().map(|_| ()).expect_err("no row");
    assert!(
        matches!(
            error,
            Error::Core(CoreError::DependentConstraints { constraint: 0, .. })
        ),
        "{error}"
    );
    assert_eq!(run.state(), &vanishing);
    let error = new(Rows::Many, start.clone())
        .map(|_| ())
        .expect_err("too many");
    let (constraints, dimension) = (3, 2);
    assert_eq!(
        error,
        Error::Core(CoreError::ConstraintCount {
            constraints,
            dimension
        })
    );
    let error = new(Rows::Misplaced, start.clone())
        .map(|_| ())
        .expect_err("misplaced");
    assert!(
        matches!(
            error,
            Error::Core(CoreError::GradientPlace { component: 2, .. })
        ),
        "{error}"
    );
    let mut run = new(Rows::Moving, start.clone()).expect("a run");
    let error = run.step().map(|_| ()).expect_err("moving");
    assert_eq!(error, Error::Core(CoreError::MovingGradients { time: 0.0 }));
    let across = State::from_arrays(0.0, [0.0, 0.0], [1.0, 0.25]);
    let error = new(Rows::Vanishing, across)
        .map(|_| ())
        .expect_err("across");
    // `consistent_momentum` is for systems with a Hamiltonian.
    assert!(
        error.to_string().contains("momentum_of_velocity"),
        "{error}"
    );
    let (constraint, rate) = (0, 0.25);
    assert_eq!(
        error,
        Error::Core(CoreError::InconsistentVelocity {
            constraint,
            name: None,
            rate
        })
    );
    let error = new(
        Rows::Vanishing,
        State::from_arrays(f64::NAN, [0.0; 2], [0.0; 2]),
    );
    let what = Quantity::Time;
    assert_eq!(
        error.map(|_| ()),
        Err(Error::Core(CoreError::NonFiniteState { what }))
    );
}

#[test]
fn a_regular_lagrangian_has_no_primary_constraint() {
    let q = V3::from([0.1, 0.2, 0.3]);
    let regular = primary_constraints(&Sleigh, 0.0, &q, &V3::zeros()).expect("finite");
    assert_eq!(regular, []);
}
