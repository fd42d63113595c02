//! Steps in Lagrangian form, against the same methods for Hamiltonians.

use crate::methods::{
    Cosine, Gauss2, Gauss3, Gauss4, Gauss6, Lobatto3, Lobatto4, Midpoint, StoermerVerlet,
    TwoOfThree,
};
use symplectic::nalgebra::{DVector, SMatrix, SVector, Vector2};
use symplectic::system::Lagrangian;
use symplectic::variational::{
    Error, LagrangianIntegrator, LagrangianSteps, generating_function, momentum_of_velocity,
    velocity_of_momentum,
};
use symplectic::{
    Error as CoreError, General, Integrator, Method, ProvedFor, Quantity, Scalar, State, System,
};

type V2<T> = SVector<T, 2>;

/// A relativistic particle in Kepler's potential with friction: L = −√(1 − |v|²) + 1/|q|, f = −friction v.
#[derive(Clone, Copy)]
pub struct Particle {
    pub friction: f64,
}

impl Lagrangian for Particle {
    type Vector<T: Scalar> = V2<T>;
    const FORCED: bool = true;

    fn lagrangian<T: Scalar>(&self, _: T, q: &V2<T>, v: &V2<T>) -> T {
        q.dot(q).sqrt().recip() - (T::one() - v.dot(v)).sqrt()
    }

    fn force<T: Scalar>(&self, _: T, _: &V2<T>, v: &V2<T>, force: &mut V2<T>) {
        *force = v * T::from_f64(-self.friction);
    }
}

symplectic::hamiltonian! {
    /// The same by its Hamiltonian.
    pub Relativistic { friction: 0 }
    q: [x, y], p: [px, py];
    let energy = sqrt(1 + px^2 + py^2);
    H = energy - 1/sqrt(x^2 + y^2)
    force: { x = -friction px/energy, y = -friction py/energy }
}

/// A pendulum whose length depends on time: L = l(t)² v²/2 + l(t) cos q, l = 1 + sin(3t)/4.
#[derive(Clone, Copy)]
struct Swing;

impl Lagrangian for Swing {
    type Vector<T: Scalar> = SVector<T, 1>;

    fn lagrangian<T: Scalar>(&self, time: T, q: &SVector<T, 1>, v: &SVector<T, 1>) -> T {
        let length = T::one() + (time * T::from_f64(3.0)).sin() * T::from_f64(0.25);
        let speed = length * v[0];
        speed * speed * T::from_f64(0.5) + length * q[0].cos()
    }
}

symplectic::hamiltonian! {
    pub SwingByHamiltonian
    q: [x], p: [px];
    let l = 1 + sin(3 t)/4;
    H = px^2/(2 l^2) - l cos(x)
}

pub fn near_perihelion() -> State<Vector2<f64>> {
    let (q, v) = (Vector2::new(2.0, 0.0), Vector2::new(0.1, 0.6));
    let p = momentum_of_velocity(&Particle { friction: 0.0 }, 0.0, &q, &v).expect("a momentum");
    State::new(0.0, q, p)
}

pub fn distance<const N: usize>(a: &State<SVector<f64, N>>, b: &State<SVector<f64, N>>) -> f64 {
    (a.q - b.q).amax().max((a.p - b.p).amax())
}

/// The distance of both forms after ten steps.
fn difference<M, L, S, const N: usize>(
    method: M,
    lagrangian: L,
    system: S,
    start: State<SVector<f64, N>>,
) -> f64
where
    M: Method + Copy + ProvedFor<General> + ProvedFor<S::Class>,
    L: Lagrangian<Vector<f64> = SVector<f64, N>>,
    S: System<SVector<f64, N>>,
{
    let mut one = LagrangianSteps::run(method, lagrangian, start.clone(), 0.25).expect("a start");
    let mut other = Integrator::new(method, system, start, 0.25).expect("a start");
    for _ in 0..10 {
        one.step().expect("a step");
        other.step().expect("a step");
    }
    distance(one.state(), other.state())
}

#[test]
fn the_steps_are_those_of_the_hamiltonian() {
    macro_rules! each {
        ($($method:ident)*) => {$(
            let (particle, system) = (Particle { friction: 0.1 }, Relativistic { friction: 0.1 });
            let far = difference($method, particle, system, near_perihelion());
            assert!(far < 2e-14, "{}: {far:e}", $method::NAME);
        )*};
    }
    each!(Midpoint Gauss2 Gauss3 Gauss4 Gauss6 StoermerVerlet Lobatto3 Lobatto4 Cosine);
}

pub type Run<L> = LagrangianIntegrator<L>;

/// The slope of the errors at t = 4, against a run of order 12 by the Hamiltonian.
pub fn slope<L, S, const N: usize>(
    make: impl Fn(State<SVector<f64, N>>, f64) -> Result<Run<L>, Error>,
    system: S,
    start: &State<SVector<f64, N>>,
    steps: u32,
) -> f64
where
    L: Lagrangian<Vector<f64> = SVector<f64, N>>,
    S: System<SVector<f64, N>>,
    Gauss6: ProvedFor<S::Class>,
{
    let mut exact = Integrator::new(Gauss6, system, start.clone(), 0.02).expect("a start");
    let exact = exact.integrate_to(4.0).expect("a run").clone();
    let error = |steps: u32| {
        let mut run = make(start.clone(), 4.0 / f64::from(steps)).expect("a start");
        distance(run.integrate_to(4.0).expect("a run"), &exact)
    };
    (error(steps) / error(2 * steps)).log2()
}

#[test]
fn lagrangian_steps_have_the_order_of_the_method() {
    macro_rules! each {
        ($($method:ident $steps:literal $order:literal;)*) => {$(
            let particle = Particle { friction: 0.1 };
            let make = |start, h| LagrangianSteps::run($method, particle, start, h);
            let system = Relativistic { friction: 0.1 };
            let found = slope(make, system, &near_perihelion(), $steps);
            assert!((found - f64::from($order)).abs() < 0.05, "{}: {found}", $method::NAME);
        )*};
    }
    each! {
        Midpoint 128 2; Gauss2 32 4; Gauss3 12 6; StoermerVerlet 128 2; Lobatto3 32 4; Lobatto4 12 6; Cosine 128 2;
    }
}

#[test]
fn time_dependent_lagrangians_keep_the_order() {
    let start = State::from_arrays(0.0, [1.0], [0.5]);
    macro_rules! each {
        ($($method:ident $steps:literal $order:literal;)*) => {$(
            let make = |start, h| LagrangianSteps::run($method, Swing, start, h);
            let found = slope(make, SwingByHamiltonian, &start, $steps);
            assert!((found - f64::from($order)).abs() < 0.05, "{}: {found}", $method::NAME);
        )*};
    }
    each! { Midpoint 128 2; Gauss2 64 4; Gauss3 64 6; StoermerVerlet 128 2; Lobatto3 64 4; }
}

/// The map of a step, by central differences, is symplectic.
#[test]
fn steps_are_symplectic() {
    let step = |state: SVector<f64, 4>, galerkin: bool| {
        let start = State::from_arrays(0.0, [state[0], state[1]], [state[2], state[3]]);
        let particle = Particle { friction: 0.0 };
        let run = match galerkin {
            true => LagrangianSteps::galerkin(TwoOfThree, particle, start, 0.5),
            false => LagrangianSteps::run(Lobatto3, particle, start, 0.5),
        };
        let mut run = run.expect("a start");
        let end = run.step().expect("a step");
        SVector::from([end.q[0], end.q[1], end.p[0], end.p[1]])
    };
    let State { q, p, .. } = near_perihelion();
    let at = SVector::from([q[0], q[1], p[0], p[1]]);
    let mut form = SMatrix::<f64, 4, 4>::zeros();
    for k in 0..2 {
        form[(k, k + 2)] = 1.0;
        form[(k + 2, k)] = -1.0;
    }
    for galerkin in [false, true] {
        let columns = [0, 1, 2, 3].map(|k| {
            let mut moved = [at, at];
            moved[0][k] += 1e-4;
            moved[1][k] -= 1e-4;
            (step(moved[0], galerkin) - step(moved[1], galerkin)) / 2e-4
        });
        let jacobian = SMatrix::<f64, 4, 4>::from_columns(&columns);
        let defect = (jacobian.transpose() * form * jacobian - form).amax();
        assert!(defect < 1e-8, "{galerkin}: {defect:e}");
    }
}

#[test]
fn the_action_is_that_of_the_generating_function() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [1.0], [0.5]);
    let mut run = LagrangianSteps::run(Gauss3, Swing, start.clone(), 0.25)?;
    let p1 = run.step()?.p;
    let generating = generating_function(Gauss3, &SwingByHamiltonian, 0.0, &start.q, &p1, 0.25)?;
    let action = run.stepper().action().expect("a step");
    assert!((generating.discrete_lagrangian(&p1) - action).abs() < 1e-15);
    Ok(())
}

/// Two vortices by a Lagrangian that is linear in the velocities: L = y1 x1' + y2 x2' + ln |r1 − r2|.
pub struct Vortices;

impl Lagrangian for Vortices {
    type Vector<T: Scalar> = SVector<T, 4>;

    fn lagrangian<T: Scalar>(&self, _: T, q: &SVector<T, 4>, v: &SVector<T, 4>) -> T {
        let (x, y) = (q[0] - q[2], q[1] - q[3]);
        q[1] * v[0] + q[3] * v[2] + (x * x + y * y).sqrt().ln()
    }
}

symplectic::hamiltonian! {
    VorticesByHamiltonian q: [xa, xb], p: [ya, yb];
    H = -ln(sqrt((xa - xb)^2 + (ya - yb)^2))
}

#[test]
fn steps_linear_in_velocities_are_those_of_the_reduced_hamiltonian() -> Result<(), Error> {
    let (a, b) = ([1.0, 0.3], [-0.5, -0.2]);
    let q = SVector::from([a[0], a[1], b[0], b[1]]);
    let mut run = LagrangianSteps::from_velocity(Gauss2, Vortices, 0.0, q, SVector::zeros(), 0.1)?;
    let start = State::from_arrays(0.0, [a[0], b[0]], [a[1], b[1]]);
    let mut other = Integrator::new(Gauss2, VorticesByHamiltonian, start, 0.1)?;
    for _ in 0..100 {
        run.step()?;
        other.step()?;
        let (q, State { q: x, p: y, .. }) = (run.state().q, other.state());
        let far = [q[0] - x[0], q[1] - y[0], q[2] - x[1], q[3] - y[1]];
        assert!(far.iter().all(|far| far.abs() < 1e-13), "{far:?}");
    }
    assert!(matches!(
        run.stepper().velocity(),
        Err(Error::NoVelocity {
            component: Some(0),
            ..
        })
    ));
    Ok(())
}

symplectic::lagrangian! {
    /// The relativistic particle with friction, from its formula.
    FromFormula { friction: 0 }
    q: [x, y], v: [vx, vy];
    L = 1/sqrt(x^2 + y^2) - sqrt(1 - vx^2 - vy^2)
    force: { x = -friction vx, y = -friction vy }
}

symplectic::lagrangian! {
    /// Particles on springs in a ring, with kinetic energies v²/2 + v⁴/4.
    Ring q: [..], v: [..];
    L = sum(i: v[i]^2/2 + v[i]^4/4 - q[i]^2/2) - sum(i: q[i])^2/4
}

#[test]
fn a_lagrangian_formula_takes_the_steps_of_the_one_by_hand() -> Result<(), Error> {
    let (by_hand, formula) = (Particle { friction: 0.1 }, FromFormula { friction: 0.1 });
    let start = near_perihelion();
    let p = formula.momentum_of_velocity(0.0, &start.q, &Vector2::new(0.1, 0.6));
    assert!((p - start.p).amax() < 1e-15);
    let mut one = LagrangianSteps::run(Gauss3, by_hand, start.clone(), 0.2)?;
    let mut other = LagrangianSteps::run(Gauss3, formula, start, 0.2)?;
    let (one, other) = (one.integrate_to(3.0)?, other.integrate_to(3.0)?);
    assert!(distance(one, other) < 1e-13);

    let (q, v) = (
        DVector::from_vec(vec![0.5, -0.2, 0.1]),
        DVector::from_vec(vec![0.1, 0.4, 0.0]),
    );
    let mut run = LagrangianSteps::from_velocity(Gauss3, Ring, 0.0, q, v, 0.1)?;
    let energy = run.stepper().energy()?;
    run.integrate_to(50.0)?;
    assert!((run.stepper().energy()? - energy).abs() < 1e-9);
    Ok(())
}

/// L without a velocity, and one that is not finite.
pub struct Wrong {
    pub strange: bool,
}

impl Lagrangian for Wrong {
    type Vector<T: Scalar> = V2<T>;

    fn lagrangian<T: Scalar>(&self, _: T, q: &V2<T>, v: &V2<T>) -> T {
        let kinetic = v[0] * v[0] * T::from_f64(0.5);
        let potential = if self.strange {
            (q[0] * T::from_f64(0.0)).ln()
        } else {
            q[0] * q[0]
        };
        kinetic - potential
    }
}

/// L = (x³ + x) y' − |q|²/2: a is not linear.
struct Bent;

impl Lagrangian for Bent {
    type Vector<T: Scalar> = V2<T>;

    fn lagrangian<T: Scalar>(&self, _: T, q: &V2<T>, v: &V2<T>) -> T {
        (q[0] * q[0] * q[0] + q[0]) * v[1] - q.dot(q) * T::from_f64(0.5)
    }
}

/// A vortex in the potential |q|²/2: L = (x y' − y x' − |q|²)/2.
struct Vortex;
impl Lagrangian for Vortex {
    type Vector<T: Scalar> = V2<T>;

    fn lagrangian<T: Scalar>(&self, _: T, q: &V2<T>, v: &V2<T>) -> T {
        (q[0] * v[1] - q[1] * v[0] - q.dot(q)) * T::from_f64(0.5)
    }
}

/// Silent before: Störmer–Verlet did not move, Lobatto methods and a nonlinear a cost the order, and any momentum was taken.
#[test]
#[ignore = "thorough"]
fn steps_that_leave_primary_constraints_are_errors() -> Result<(), Error> {
    fn first_error<M: Method + ProvedFor<General>>(method: M) -> Option<Error> {
        let start = State::from_arrays(0.0, [1.0, 0.0], [0.0, 0.5]);
        let mut run = LagrangianSteps::run(method, Vortex, start.clone(), 0.1).expect("linear");
        let error = run.step().err()?;
        assert_eq!(run.state(), &start);
        Some(error)
    }
    let degenerate = |error| matches!(error, Some(Error::DegenerateLagrangian { .. }));
    assert!(degenerate(first_error(StoermerVerlet)));
    assert!(degenerate(first_error(Lobatto3)));
    assert!(degenerate(first_error(Lobatto4)));
    assert_eq!(first_error(Gauss2), None);
    // Rounding errors of long runs are none: far from the origin, and where p = a(q) = 0 is passed.
    struct Far<const SYMMETRIC: bool>(f64);
    impl<const SYMMETRIC: bool> Lagrangian for Far<SYMMETRIC> {
        type Vector<T: Scalar> = V2<T>;

        fn lagrangian<T: Scalar>(&self, _: T, q: &V2<T>, v: &V2<T>) -> T {
            let (half, x) = (T::from_f64(0.5), q[0] - T::from_f64(self.0));
            let momenta = match SYMMETRIC {
                true => (q[0] * v[1] - q[1] * v[0]) * half,
                false => q[0] * v[1],
            };
            momenta - (x * x + q[1] * q[1]) * half
        }
    }
    for (size, centre) in [(0.1, 0.0), (0.01, 0.0), (0.1, 1e4), (0.01, 100.0)] {
        let (q, v) = (V2::new(centre + 1.0, 0.0), V2::zeros());
        let mut run = LagrangianSteps::from_velocity(Gauss2, Far::<true>(centre), 0.0, q, v, size)?;
        let mut other =
            LagrangianSteps::from_velocity(Gauss2, Far::<false>(centre), 0.0, q, v, size)?;
        for _ in 0..10_000 {
            run.step()?;
            other.step()?;
        }
    }
    let bent =
        LagrangianSteps::from_velocity(Gauss2, Bent, 0.0, V2::new(1.0, 0.0), V2::zeros(), 0.1);
    assert!(degenerate(bent?.step().err()));
    let off = State::from_arrays(0.0, [1.0, 0.0], [0.0, 7.0]);
    let (component, value) = (1, 6.5);
    assert_eq!(
        LagrangianSteps::run(Gauss2, Vortex, off, 0.1).err(),
        Some(Error::PrimaryConstraint { component, value })
    );
    Ok(())
}

#[test]
fn a_run_refuses_a_state_off_its_primary_constraints() -> Result<(), Error> {
    let on = State::from_arrays(0.0, [1.0, 0.0], [0.0, 0.5]);
    let mut run = LagrangianSteps::run(Gauss2, Vortex, on.clone(), 0.1)?;
    let off = State::from_arrays(0.0, [1.0, 0.0], [0.0, 7.0]);
    assert_eq!(
        run.set_state(off),
        Err(Error::PrimaryConstraint {
            component: 1,
            value: 6.5
        })
    );
    assert_eq!(run.state(), &on);
    let expected = LagrangianSteps::run(Gauss2, Vortex, on.clone(), 0.1)?
        .step()?
        .clone();
    assert_eq!(run.step()?, &expected);
    run.set_state(on)?;
    assert_eq!(run.step()?, &expected);
    Ok(())
}

/// A momentum whose velocity is not found from rest: the mass vanishes there.
#[test]
fn a_lagrangian_that_is_degenerate_at_rest_is_stepped() -> Result<(), Error> {
    struct Quartic;
    impl Lagrangian for Quartic {
        type Vector<T: Scalar> = SVector<T, 1>;

        fn lagrangian<T: Scalar>(&self, _: T, q: &SVector<T, 1>, v: &SVector<T, 1>) -> T {
            v[0].powi(4) * T::from_f64(0.25) - q[0] * q[0] * T::from_f64(0.5)
        }
    }
    let mut run =
        LagrangianSteps::run(Gauss2, Quartic, State::from_arrays(0.0, [0.5], [1.0]), 0.01)?;
    let energy = run.stepper().energy()?;
    run.integrate_to(0.5)?;
    assert!((run.stepper().energy()? - energy).abs() < 1e-8);
    Ok(())
}

#[test]
fn degenerate_and_nonfinite_lagrangians_are_errors() {
    let start = State::from_arrays(0.0, [1.0, 0.0], [0.0, 0.0]);
    let run = |strange| {
        LagrangianSteps::run(Gauss2, Wrong { strange }, start.clone(), 0.1).expect("a start")
    };
    let singular = LagrangianSteps::run(Gauss2, Wrong { strange: false }, start.clone(), 0.1);
    let (method, component) = ("Gauss2", 1);
    let refused = Error::DegenerateLagrangian { method, component };
    assert_eq!(singular.err(), Some(refused));
    let error = run(true).step().expect_err("no number");
    let what = Quantity::Lagrangian;
    assert!(
        matches!(error, Error::Core(CoreError::NonFinite { what: found, stage: Some(1), .. }) if found == what)
    );

    // No velocity below that of light has an infinite momentum.
    let (q, p) = (Vector2::new(1.0, 0.0), Vector2::new(f64::INFINITY, 0.0));
    let particle = Particle { friction: 0.0 };
    assert!(matches!(
        velocity_of_momentum(&particle, 0.0, &q, &p),
        Err(Error::Core(CoreError::NonFiniteState {
            what: Quantity::Momentum
        }))
    ));
    let v = velocity_of_momentum(&particle, 0.0, &q, &Vector2::new(1e6, 0.0)).expect("a velocity");
    assert!((v[0] - (1.0 - 0.5e-12)).abs() < 1e-15);
    let p = Vector2::new(1.0, 0.0);
    assert!(matches!(
        velocity_of_momentum(&Wrong { strange: false }, 0.0, &q, &p),
        Err(Error::NoVelocity {
            component: Some(1),
            ..
        })
    ));
    assert!(matches!(
        velocity_of_momentum(&Wrong { strange: true }, 0.0, &q, &p),
        Err(Error::NoVelocity {
            component: None,
            ..
        })
    ));
    assert!(matches!(
        LagrangianSteps::run(Gauss2, particle, near_perihelion(), 0.0),
        Err(Error::Core(CoreError::StepSize { .. }))
    ));
}

/// L = v²/2 + exp q: q reaches infinity in a finite time.
struct Runaway;

impl Lagrangian for Runaway {
    type Vector<T: Scalar> = SVector<T, 1>;

    fn lagrangian<T: Scalar>(&self, _: T, q: &SVector<T, 1>, v: &SVector<T, 1>) -> T {
        v[0] * v[0] * T::from_f64(0.5) + q[0].exp()
    }
}

/// The step after one that failed is that of a run where none failed.
#[test]
fn a_step_that_fails_leaves_nothing_behind() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [0.0], [1.0]);
    let mut one = LagrangianSteps::run(Midpoint, Runaway, start.clone(), 0.1)?;
    let mut other = LagrangianSteps::run(Midpoint, Runaway, start, 0.1)?;
    one.step()?;
    other.step()?;
    // V = p + h/2 exp(q + hV/2) has no solution.
    one.set_step_size(10.0)?;
    assert!(one.step().is_err());
    for run in [&mut one, &mut other] {
        run.set_step_size(0.01)?;
        run.step()?;
    }
    assert_eq!(one.state(), other.state());
    Ok(())
}

/// A charge in a magnetic field: L = |v|²/2 + strength (x y' − y x').
struct Charge {
    strength: f64,
}

impl Lagrangian for Charge {
    type Vector<T: Scalar> = V2<T>;

    fn lagrangian<T: Scalar>(&self, _: T, q: &V2<T>, v: &V2<T>) -> T {
        let turning = T::from_f64(self.strength) * (q[0] * v[1] - q[1] * v[0]);
        v.dot(v) * T::from_f64(0.5) + turning
    }
}

/// At rest the velocities are rounding errors, and so are their changes.
#[test]
fn a_charge_at_rest_stays_at_rest() -> Result<(), Error> {
    for strength in [1.0, 1e3, 1e6] {
        let (charge, q) = (Charge { strength }, Vector2::new(3.7, -0.2));
        let p = momentum_of_velocity(&charge, 0.0, &q, &Vector2::zeros())?;
        let mut run = LagrangianSteps::galerkin(TwoOfThree, charge, State::new(0.0, q, p), 0.1)?;
        assert!((run.integrate_to(10.0)?.q - q).amax() < 1e-13);
    }
    Ok(())
}

/// L = v ln v − v − exp q, of H = exp p + exp q: p = ln v, which needs v > 0.
struct Exponential;

impl Lagrangian for Exponential {
    type Vector<T: Scalar> = SVector<T, 1>;

    fn lagrangian<T: Scalar>(&self, _: T, q: &SVector<T, 1>, v: &SVector<T, 1>) -> T {
        v[0] * v[0].ln() - v[0] - q[0].exp()
    }
}

#[test]
fn a_lagrangian_that_is_infinite_at_rest_starts_from_a_velocity() -> Result<(), Error> {
    let (q, v) = (SVector::from([0.0]), SVector::from([1.0]));
    let mut run = LagrangianSteps::from_velocity(Gauss3, Exponential, 0.0, q, v, 0.1)?;
    assert_eq!(run.stepper().velocity()?, v);
    run.integrate_to(2.0)?;
    // H = 2: q' = exp p = 2 − exp q, and so exp(−q) = (1 + exp(−2t))/2.
    let exact = -((1.0 + (-4.0_f64).exp()) / 2.0).ln();
    assert!((run.state().q[0] - exact).abs() < 1e-8);
    assert!((run.stepper().velocity()?[0] - (2.0 - exact.exp())).abs() < 1e-8);
    assert!((run.stepper().energy()? - 2.0).abs() < 1e-8);
    Ok(())
}

struct Nothing;

impl Lagrangian for Nothing {
    type Vector<T: Scalar> = DVector<T>;

    fn lagrangian<T: Scalar>(&self, _: T, _: &DVector<T>, _: &DVector<T>) -> T {
        T::zero()
    }
}

#[test]
fn a_lagrangian_without_coordinates_advances_the_time() -> Result<(), Error> {
    let start = State::new(0.0, DVector::zeros(0), DVector::zeros(0));
    let mut run = LagrangianSteps::run(Gauss2, Nothing, start, 0.1)?;
    assert_eq!(run.integrate_to(1.0)?.time, 1.0);
    Ok(())
}

/// L is taken at `t0 + c_i h`. For Lobatto with two nodes `c̃ = (1/2, 1/2)`, and the Hamiltonian has steps of its own.
#[test]
fn where_l_depends_on_time_steps_are_those_of_the_hamiltonian_if_both_nodes_agree() {
    let start = State::from_arrays(0.0, [1.0], [0.5]);
    macro_rules! far {
        ($method:ident) => {
            difference($method, Swing, SwingByHamiltonian, start.clone())
        };
    }
    assert!(far!(Gauss2) < 2e-14);
    assert!(far!(Lobatto3) < 2e-14);
    assert!(far!(StoermerVerlet) > 1e-4);
}
