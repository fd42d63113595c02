//! Constraints, structure and invariants of constrained steps.

use symplectic::constraints::{Constrained, Gradients, HolonomicConstraints, consistent};
use symplectic::nalgebra::{SVector, Vector1, Vector2};
use symplectic::{
    Error, Event, Hamiltonian, Integrator, Method, ProvedFor, Separable, State, Vector,
};

use crate::systems::*;

/// The distance of two states in their largest component.
pub fn distance<V: Vector<Scalar = f64>>(a: &State<V>, b: &State<V>) -> f64 {
    let pairs = |a: &V, b: &V| {
        let pairs = a.as_slice().iter().zip(b.as_slice());
        pairs.fold(0.0_f64, |largest, (a, b)| largest.max((a - b).abs()))
    };
    pairs(&a.q, &b.q).max(pairs(&a.p, &b.p))
}

/// φ and G v are rounding errors in every step.
#[test]
#[ignore = "thorough"]
fn states_stay_on_the_constraints() {
    fn check<M: Method + ProvedFor<Constrained<Separable>>>(method: M, steps: u32) {
        let mut run =
            Integrator::new(method, DoubleSpherical, double_start(), 0.05).expect("a run");
        for _ in 0..steps {
            let State { q, p, .. } = run.step().expect("a step");
            let mut values = [0.0; 2];
            DoubleSpherical.constraint_values(q, &mut values);
            let link = q.fixed_rows::<3>(3) - q.fixed_rows::<3>(0);
            let velocity = p.fixed_rows::<3>(3) * 0.5 - p.fixed_rows::<3>(0);
            let rates = [
                q.fixed_rows::<3>(0).dot(&p.fixed_rows::<3>(0)),
                link.dot(&velocity),
            ];
            for (value, rate) in values.iter().zip(rates) {
                assert!(
                    value.abs() < 8e-15 && rate.abs() < 8e-15,
                    "{}: {value:e} {rate:e}",
                    M::NAME
                );
            }
        }
    }
    check(Euler, 5000);
    check(AdjointEuler, 5000);
    check(HalfSteps, 5000);
    check(Rattle, 5000);
    check(Lobatto3, 5000);
    check(Lobatto4, 5000);
    check(Rattle4, 5000);
    check(Waves, 5000);
    check(Lobatto6, 200);
    check(Lobatto7, 200);
    check(Lobatto8, 200);
}

/// dq∧dp of two tangent vectors of the constrained phase space, before and after a step, by differences.
#[test]
fn steps_are_symplectic_on_the_constraints() {
    fn check<M: Method + Copy + ProvedFor<Constrained<Separable>>>(method: M) -> f64 {
        const STEP: f64 = 1e-3;
        let start = double_start();
        // A state near by, in a direction, on the constraints.
        let moved = |direction: usize, by: f64| {
            let State { time, mut q, mut p } = start.clone();
            q[(direction * 2) % 6] += by;
            p[(direction + 1) % 6] -= 0.7 * by;
            p[4 - direction] += 0.3 * by;
            consistent(&DoubleSpherical, State { time, q, p }).expect("regular")
        };
        let stepped = |state: State<SVector<f64, 6>>| {
            let mut run = Integrator::new(method, DoubleSpherical, state, 0.1).expect("a run");
            run.step().expect("a step").clone()
        };
        // Differences of order 4.
        let tangent =
            |direction: usize, map: &dyn Fn(State<SVector<f64, 6>>) -> State<SVector<f64, 6>>| {
                let at = |by: f64| map(moved(direction, by * STEP));
                let part = |take: fn(&State<SVector<f64, 6>>) -> SVector<f64, 6>| {
                    let [a, b, c, d] = [-2.0, -1.0, 1.0, 2.0].map(|by| take(&at(by)));
                    (a - d + (c - b) * 8.0) / (12.0 * STEP)
                };
                (part(|state| state.q), part(|state| state.p))
            };
        let form = |map: &dyn Fn(State<SVector<f64, 6>>) -> State<SVector<f64, 6>>| {
            let ((q1, p1), (q2, p2)) = (tangent(0, map), tangent(1, map));
            q1.dot(&p2) - p1.dot(&q2)
        };
        let (before, after) = (form(&|state| state), form(&stepped));
        assert!(before.abs() > 0.1, "{before}");
        ((after - before) / before).abs()
    }
    for defect in [
        check(Euler),
        check(AdjointEuler),
        check(HalfSteps),
        check(Rattle),
        check(Lobatto3),
        check(Lobatto4),
        check(Rattle4),
        check(Quarter),
        check(Waves),
        check(Lobatto6),
        check(Lobatto7),
        check(Lobatto8),
    ] {
        assert!(defect < 1e-10, "{defect:e}");
    }
}

#[test]
fn symmetric_steps_go_back_and_others_do_not() {
    fn back<M: Method + Copy + ProvedFor<Constrained<Separable>>>(method: M) -> f64 {
        let start = double_start();
        let mut run = Integrator::new(method, DoubleSpherical, start.clone(), 0.1).expect("a run");
        let there = run.step().expect("a step").clone();
        let mut run = Integrator::new(method, DoubleSpherical, there, -0.1).expect("a run");
        let mut back = run.step().expect("a step").clone();
        back.time = start.time;
        distance(&back, &start)
    }
    assert!(back(Rattle) < 1e-14 && back(Lobatto3) < 1e-14 && back(Lobatto4) < 1e-14);
    assert!(back(HalfSteps) < 1e-14 && back(Waves) < 1e-14);
    let others = [back(Quarter), back(Euler), back(AdjointEuler)];
    assert!(others.iter().all(|&back| back > 1e-8), "{others:?}");
}

/// A step of the adjoint undoes a step of symplectic Euler, for every class. Half steps of both are RATTLE in one order. In the other order
/// their middle is on the constraints, too.
#[test]
fn the_adjoint_undoes_a_constrained_step_of_symplectic_euler() -> Result<(), Error> {
    fn undone<S, C, V>(system: S, start: &State<V>) -> Result<f64, Error>
    where
        V: Vector<Scalar = f64>,
        S: Hamiltonian<Class = Constrained<C>, Vector<f64> = V> + Copy,
        C: symplectic::system::Class + symplectic::system::Unconstrained,
        Euler: ProvedFor<Constrained<C>>,
        AdjointEuler: ProvedFor<Constrained<C>>,
    {
        let there = (Integrator::new(Euler, system, start.clone(), 0.05)?)
            .step()?
            .clone();
        let mut run = Integrator::new(AdjointEuler, system, there, -0.05)?;
        let mut back = run.step()?.clone();
        back.time = start.time;
        Ok(distance(&back, start))
    }
    let defects = [
        undone(DoubleSpherical, &double_start())?,
        undone(Bead, &sphere_start())?,
        undone(Relativistic, &consistent(&Relativistic, sphere_start())?)?,
    ];
    assert!(defects.iter().all(|&defect| defect < 1e-14), "{defects:?}");
    fn step<M: Method + ProvedFor<Constrained<Separable>>>(
        method: M,
        start: &State<SVector<f64, 6>>,
        size: f64,
    ) -> Result<State<SVector<f64, 6>>, Error> {
        let mut run = Integrator::new(method, DoubleSpherical, start.clone(), size)?;
        run.step().cloned()
    }
    let start = double_start();
    let rattle = step(Rattle, &start, 0.1)?;
    assert_eq!(step(OtherHalfSteps, &start, 0.1)?, rattle);
    let halves = step(HalfSteps, &start, 0.1)?;
    let middle = step(AdjointEuler, &start, 0.05)?;
    assert!(distance(&step(Euler, &middle, 0.05)?, &halves) < 1e-15);
    let difference = distance(&halves, &rattle);
    assert!((1e-6..1e-2).contains(&difference), "{difference:e}");
    Ok(())
}

/// The angular momentum about the vertical axis, a symmetry of H and of the constraints.
#[test]
fn momentum_maps_are_conserved() {
    let momentum = |state: &State<SVector<f64, 6>>| {
        let State { q, p, .. } = state;
        q[0] * p[1] - q[1] * p[0] + q[3] * p[4] - q[4] * p[3]
    };
    let start = double_start();
    let before = momentum(&start);
    let mut run = Integrator::new(Lobatto3, DoubleSpherical, start, 0.1).expect("a run");
    let after = momentum(run.take_steps(2000).expect("steps"));
    assert!((after - before).abs() < 1e-13, "{:e}", after - before);
}

/// The pendulum in the plane and by its angle.
#[test]
fn coordinates_and_angle_are_the_same_motion() -> Result<(), Error> {
    let (angle, rate) = (2.0_f64, 0.5);
    let start = State::new(
        0.0,
        Vector2::new(angle.sin(), -angle.cos()),
        Vector2::new(angle.cos(), angle.sin()) * rate,
    );
    let mut plane = Integrator::new(Lobatto4, Pendulum, start, 0.02)?;
    let by_angle = State::new(0.0, Vector1::new(angle), Vector1::new(rate));
    let mut reference = Integrator::new(Lobatto5, Angle, by_angle, 0.01)?;
    for end in 1..=20 {
        let end = f64::from(end);
        let State { q, p, .. } = plane.integrate_to(end)?.clone();
        let State { q: a, p: rate, .. } = reference.integrate_to(end)?.clone();
        let (sine, cosine) = a[0].sin_cos();
        let difference = (q - Vector2::new(sine, -cosine)).norm();
        let other = (p - Vector2::new(cosine, sine) * rate[0]).norm();
        assert!(
            difference < 2e-10 && other < 2e-10,
            "{difference:e} {other:e}"
        );
    }
    Ok(())
}

/// The energy error stays as it is, and shrinks by 2⁴ for half the step.
#[test]
fn the_energy_does_not_drift() {
    let error = |size: f64| {
        let start: State<Vector2<f64>> = State::from_arrays(0.0, [1.0, 0.0], [0.0, 0.0]);
        let mut run = Integrator::new(Lobatto3, Pendulum, start, size).expect("a run");
        let before = run.energy().expect("known");
        let mut largest = [0.0_f64; 2];
        for half in &mut largest {
            for _ in 0..4000 {
                run.step().expect("a step");
                *half = half.max((run.energy().expect("known") - before).abs());
            }
        }
        largest
    };
    let [early, late] = error(0.1);
    assert!(late < 1.1 * early, "{early:e} {late:e}");
    let ratio = late / error(0.05)[1];
    assert!((14.0..18.0).contains(&ratio), "{ratio}");
}

/// A pendulum that hangs at rest stays there: forces and impulses cancel, and what rounding leaves of them is no motion.
#[test]
fn a_pendulum_in_equilibrium_stays_at_rest() {
    let start: State<Vector2<f64>> = State::from_arrays(0.0, [0.6, -0.8], [0.0, 0.0]);
    let turned = Turned(Vector2::new(0.6, -0.8));
    let mut run = Integrator::new(Lobatto4, turned, start.clone(), 0.1).expect("a run");
    let end = run.take_steps(1000).expect("steps");
    assert!(
        distance(
            end,
            &State {
                time: end.time,
                ..start
            }
        ) < 1e-13
    );
}

/// Where M is full, sweeps take the matrix at the start of the step, and Newton's matrix only if these contract badly.
#[test]
fn newton_takes_over_at_large_steps() {
    fn factorisations<M: Method + ProvedFor<Constrained<Separable>>>(method: M, size: f64) -> u64 {
        let start = consistent(&Relativistic, sphere_start()).expect("regular");
        let mut run = Integrator::new(method, Relativistic, start, size).expect("a run");
        for _ in 0..3 {
            let q = run.step().expect("a step").q;
            assert!((q.norm() - 1.0).abs() < 1e-15, "{}: {size}", M::NAME);
        }
        run.statistics().factorisations
    }
    assert_eq!(factorisations(Rattle, 0.02), 0);
    // The first step of all has no multipliers to start from.
    assert!(factorisations(Lobatto3, 0.02) <= 1);
    assert!(factorisations(Rattle, 0.7) > 0);
    assert!(factorisations(Lobatto3, 0.7) > 3);
}

symplectic::hamiltonian! {
    /// A free particle on the unit sphere.
    pub Sphere
    q: [x, y, z], p: [px, py, pz];
    H = (px^2 + py^2 + pz^2)/2
    constraints: { sphere = x^2 + y^2 + z^2 - 1 }
}

/// Farther than a pendulum is long, there is no step.
#[test]
fn a_constrained_step_without_a_solution_is_refused() {
    let start: State<Vector2<f64>> = State::from_arrays(0.0, [1.0, 0.0], [0.0, -1.0]);
    let mut run = Integrator::new(Rattle, Pendulum, start.clone(), 3.0).expect("a run");
    let error = run.step().expect_err("no step");
    assert!(matches!(error, Error::NoConvergence { .. }), "{error}");
    assert_eq!(run.state(), &start);

    // Without a constraint force q1 = (1, 1, 1). The first correction moves it to (0, 1, 1), at a right angle to q0. There a constraint
    // force along q0 does not change q1·q1 − 1 = 1.
    let start = State::from_arrays(0.0, [1.0, 0.0, 0.0], [0.0, 1.0, 1.0]);
    let mut run = Integrator::new(Rattle, Sphere, start.clone(), 1.0).expect("a run");
    let error = run.step().expect_err("no step");
    assert!(matches!(error, Error::SingularMatrix { .. }), "{error}");
    assert_eq!(run.state(), &start);
}

/// A run that is saved and restored has the bits of the run that goes on.
#[test]
fn a_restored_constrained_run_has_the_same_bits() {
    for method_steps in [3, 10] {
        let mut run =
            Integrator::new(Lobatto3, DoubleSpherical, double_start(), 0.1).expect("a run");
        run.take_steps(method_steps).expect("steps");
        let saved = run.checkpoint().expect("saved");
        let mut other =
            Integrator::new(Lobatto3, DoubleSpherical, double_start(), 0.1).expect("a run");
        other.restore(&saved).expect("restored");
        assert_eq!(
            run.take_steps(20).expect("steps"),
            other.take_steps(20).expect("steps")
        );
    }
}

/// A state that is set starts anew: nothing of the steps before, nor of one that failed, is in the next step.
#[test]
fn a_state_that_is_set_starts_anew() {
    let mut run = Integrator::new(Lobatto3, DoubleSpherical, double_start(), 0.1).expect("a run");
    run.take_steps(10).expect("steps");
    let there = run.state().clone();
    run.set_state(there.clone()).expect("consistent");
    let mut fresh = Integrator::new(Lobatto3, DoubleSpherical, there, 0.1).expect("a run");
    assert_eq!(run.step().expect("a step"), fresh.step().expect("a step"));
}

/// Equal steps start from extrapolated stages, which saves sweeps; steps of two sizes in turn do not.
#[test]
fn extrapolation_saves_sweeps() {
    let sweeps = |sizes: [f64; 2]| {
        let start = double_start();
        let mut run = Integrator::new(Lobatto4, DoubleSpherical, start, sizes[0]).expect("a run");
        for number in 0..100 {
            run.set_step_size(sizes[number % 2]).expect("a size");
            run.step().expect("a step");
        }
        run.statistics().iterations
    };
    let (equal, unequal) = (sweeps([0.02; 2]), sweeps([0.02, 0.0201]));
    assert!(10 * equal < 9 * unequal, "{equal} {unequal}");
}

/// The adjoint of symplectic Euler takes about as many sweeps and evaluations as symplectic Euler: without stages of steps before, and for
/// a velocity that depends on the momentum in any way. The bounds leave a tenth more.
#[test]
fn the_adjoint_takes_as_many_sweeps() -> Result<(), Error> {
    fn work<M, S, C, V>(method: M, system: S, start: State<V>) -> Result<[u64; 2], Error>
    where
        V: Vector<Scalar = f64>,
        S: Hamiltonian<Class = Constrained<C>, Vector<f64> = V>,
        C: symplectic::system::Class + symplectic::system::Unconstrained,
        M: Method + ProvedFor<Constrained<C>>,
    {
        let mut run = Integrator::new(method, system, start, 0.02)?;
        for number in 0..100 {
            run.set_step_size([0.02, 0.0201][number % 2])?;
            run.step()?;
        }
        let done = run.statistics();
        Ok([done.iterations, done.evaluations])
    }
    macro_rules! both {
        ($system:ident, $start:expr) => {
            [
                work(Euler, $system, $start)?,
                work(AdjointEuler, $system, $start)?,
            ]
        };
    }
    let counts = [
        both!(DoubleSpherical, double_start()),
        both!(Bead, sphere_start()),
        both!(Relativistic, consistent(&Relativistic, sphere_start())?),
    ];
    for [euler, adjoint] in counts {
        for (euler, adjoint) in euler.into_iter().zip(adjoint) {
            assert!(10 * adjoint <= 11 * euler, "{counts:?}");
        }
    }
    Ok(())
}

/// A pendulum whose force is NaN at one evaluation.
#[derive(Clone)]
struct FailsOnce(std::cell::Cell<u32>);

impl symplectic::System<Vector2<f64>> for FailsOnce {
    type Class = Constrained<Separable>;
    type Solver = symplectic::solver::FixedPoint;

    fn velocity(&self, _: f64, _: &Vector2<f64>, p: &Vector2<f64>, velocity: &mut Vector2<f64>) {
        *velocity = *p;
    }

    fn force(&self, _: f64, _: &Vector2<f64>, _: &Vector2<f64>, force: &mut Vector2<f64>) {
        let left = self.0.get();
        self.0.set(left.wrapping_sub(1));
        *force = Vector2::new(0.0, if left == 0 { f64::NAN } else { -1.0 });
    }

    fn extra(&self) -> Option<&dyn HolonomicConstraints<Vector2<f64>>> {
        Some(self)
    }
}

impl HolonomicConstraints<Vector2<f64>> for FailsOnce {
    fn constraints(&self) -> usize {
        1
    }
    fn constraint_values(&self, q: &Vector2<f64>, values: &mut [f64]) {
        values[0] = q.norm_squared() - 1.0;
    }
    fn constraint_gradients(&self, q: &Vector2<f64>, gradients: &mut Gradients<f64>) {
        for k in 0..2 {
            gradients.set(0, k, 2.0 * q[k]);
        }
    }
}

/// A step that does not succeed from extrapolated stages is tried from its start.
#[test]
fn a_step_that_fails_from_extrapolation_is_repeated_from_its_start() {
    let start: State<Vector2<f64>> = State::from_arrays(0.0, [1.0, 0.0], [0.0, -1.0]);
    let system = FailsOnce(std::cell::Cell::new(u32::MAX));
    let mut run = Integrator::new(Lobatto4, system, start, 0.1).expect("a run");
    let state = run.state().clone();
    // The first step has nothing else to start from.
    run.system().0.set(1);
    assert!(run.step().is_err() && *run.state() == state);
    // Four steps are not enough to extrapolate from, but they leave multipliers.
    for steps in [4, 6] {
        run.take_steps(steps).expect("steps");
        run.system().0.set(1);
        run.step().expect("a step from the start");
    }
}

/// A velocity that is linear in the momentum at the start, and affine elsewhere. The error of the energy does not grow, and is of order 2:
/// the steps resolve the gyration of frequency 20.
#[test]
fn constrained_motion_in_a_magnetic_field_keeps_its_energy() {
    let errors = |steps: u32| {
        let start: State<SVector<f64, 3>> = State::from_arrays(0.0, [0.0; 3], [0.0, 1.0, 0.0]);
        let size = 20.0 / f64::from(steps);
        let mut run = Integrator::new(Rattle, Charged, start, size).expect("a run");
        let before: f64 = run.energy().expect("known");
        [(); 2].map(|()| {
            (0..steps / 2).fold(0.0_f64, |largest, _| {
                run.step().expect("a step");
                largest.max((run.energy().expect("known") - before).abs())
            })
        })
    };
    let ([early, late], [_, fine]) = (errors(4000), errors(8000));
    assert!(late < 1.1 * early, "{early:e} {late:e}");
    let ratio = late / fine;
    assert!((3.9..4.1).contains(&ratio), "{ratio}");
}

symplectic::hamiltonian! {
    /// A particle on a sphere of radius 1, with gravity.
    Bowl q: [x, y, z], p: [px, py, pz];
    H = (px^2 + py^2 + pz^2)/2 + z
    constraints: { sphere = x^2 + y^2 + z^2 - 1 }
}

/// The state at a wall is on the constraints, and so is the reflected one after it is projected.
#[test]
fn a_particle_on_a_sphere_bounces_off_a_wall() -> Result<(), Error> {
    let start: State<SVector<f64, 3>> = State::from_arrays(0.0, [0.6, 0.0, -0.8], [0.0, 0.7, 0.0]);
    let mut run = Integrator::new(Lobatto3, Bowl, start, 0.1)?;
    let energy = run.energy().expect("known");
    let wall = Event::wall(|state: &State<SVector<f64, 3>>| state.q[0] + 0.1);
    let mut impacts = 0;
    while let Some(mut state) = run.find_event(20.0, &wall)? {
        assert!((0.0..1e-13).contains(&(state.q[0] + 0.1)));
        // Along the sphere.
        let normal = SVector::from([1.0, 0.0, 0.0]) - state.q * state.q[0];
        state.p -= normal * (2.0 * state.p.dot(&normal) / normal.dot(&normal));
        run.set_state(consistent(&Bowl, state)?)?;
        impacts += 1;
    }
    assert!(impacts > 3, "{impacts}");
    assert!((run.energy().expect("known") - energy).abs() < 1e-5);
    Ok(())
}
