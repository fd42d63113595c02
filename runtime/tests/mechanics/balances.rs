//! Balances of energy and momentum with applied forces.

use crate::methods::{Gauss2, Gauss3, Lobatto4, Midpoint, StoermerVerlet, TwoOfThree};
use symplectic::constraints::Gradients;
use symplectic::nalgebra::{SVector, Vector2};
use symplectic::output::Balance;
use symplectic::system::Lagrangian;
use symplectic::variational::{
    DiracRule, DiracSteps, DiracSystem, Error, LagrangianSteps, StagesOfStep, StepWithStages,
};
use symplectic::{Hamiltonian, Integrator, Method, ProvedFor, Scalar, State, System};

use crate::dirac::Suzuki4;
use crate::forces::{Ring, ring_start};
use crate::rolling::{Disk, disk_start};

/// A step of the classical Runge–Kutta method.
fn runge_kutta(
    ring: &Ring,
    q: &Vector2<f64>,
    p: &Vector2<f64>,
    h: f64,
) -> (Vector2<f64>, Vector2<f64>) {
    let rates = |q: Vector2<f64>, p: Vector2<f64>| {
        let (mut velocity, mut force) = (Vector2::zeros(), Vector2::zeros());
        System::velocity(ring, 0.0, &q, &p, &mut velocity);
        System::force(ring, 0.0, &q, &p, &mut force);
        (velocity, force)
    };
    let a = rates(*q, *p);
    let b = rates(q + a.0 * (h / 2.0), p + a.1 * (h / 2.0));
    let c = rates(q + b.0 * (h / 2.0), p + b.1 * (h / 2.0));
    let d = rates(q + c.0 * h, p + c.1 * h);
    let sum = |a: Vector2<f64>, b, c, d| (a + (b + c) * 2.0 + d) * (h / 6.0);
    (q + sum(a.0, b.0, c.0, d.0), p + sum(a.1, b.1, c.1, d.1))
}

/// The mean energy of the five units of time before t = 500, 1000, 1500 with h = 0.1, less the energy at t: Figure 2.
#[test]
#[ignore = "thorough"]
fn mean_energies_agree_with_figure_two() {
    let mut run = Integrator::new(Gauss3, Ring::new(), ring_start(), 0.1).expect("a run");
    let exact = [500.0, 1000.0, 1500.0].map(|time| {
        run.integrate_to(time).expect("steps");
        run.energy().expect("known")
    });
    for (energy, printed) in exact.iter().zip([0.298, 0.160, 0.092]) {
        assert!((energy - printed).abs() < 5e-4, "{energy} {printed}");
    }
    fn means<M: Method + ProvedFor<symplectic::General>>(method: M) -> [f64; 3] {
        let mut run = Integrator::new(method, Ring::new(), ring_start(), 0.1).expect("a run");
        [500.0, 1000.0, 1500.0].map(|time| {
            run.integrate_to(time - 5.0).expect("steps");
            let energies = (0..50).map(|_| {
                run.step().expect("a step");
                run.energy().expect("known")
            });
            energies.sum::<f64>() / 50.0
        })
    }
    let means_of_runge_kutta = || {
        let State { mut q, mut p, .. } = ring_start();
        let energy = |q: &Vector2<f64>, p: &Vector2<f64>| {
            Hamiltonian::energy(&Ring::new(), 0.0, q, p).expect("known")
        };
        let energies: Vec<f64> = (0..15_000)
            .map(|_| {
                (q, p) = runge_kutta(&Ring::new(), &q, &p, 0.1);
                energy(&q, &p)
            })
            .collect();
        [5000, 10_000, 15_000].map(|end| energies[end - 50..end].iter().sum::<f64>() / 50.0)
    };
    let errors = means_of_runge_kutta();
    for (k, printed) in [-4.1e-2, -3.6e-2, -2.7e-2].into_iter().enumerate() {
        let error = errors[k] - exact[k];
        assert!((error - printed).abs() < 5e-4, "{error:e} {printed:e}");
    }
    for (found, printed) in [
        (means(Midpoint), [-1.3e-3, 2e-4, 7e-4]),
        (means(StoermerVerlet), [-4.9e-3, -3.0e-3, -2.1e-3]),
    ] {
        for k in 0..3 {
            let error = found[k] - exact[k];
            assert!(
                (error - printed[k]).abs() < 1e-4,
                "{error:e} {:e}",
                printed[k]
            );
        }
    }
}

fn turned(q: &Vector2<f64>, out: &mut Vector2<f64>) {
    *out = Vector2::new(-q[1], q[0]);
}

fn angular_momentum(state: &State<Vector2<f64>>) -> f64 {
    state.q.perp(&state.p)
}

/// `J1 − J0 = h Σ b_i f_i·ξ_Q(Q_i)` in every step, whatever the method.
#[test]
fn the_balance_of_angular_momentum_is_exact() {
    fn check<M: Method + ProvedFor<symplectic::General>>(method: M) {
        let mut run =
            Integrator::new(method, Ring { gamma: 0.25 }, ring_start(), 0.1).expect("a run");
        for _ in 0..50 {
            let before = angular_momentum(run.state());
            let stages = run.step_with_stages().expect("a step");
            let change = angular_momentum(run.state()) - before;
            assert!(
                (change - stages.impulse(turned)).abs() < 2e-15,
                "{change:e}"
            );
            assert!(change.abs() > 1e-4, "{change:e}");
        }
    }
    check(Midpoint);
    check(Gauss3);
    check(StoermerVerlet);
    check(Lobatto4);
}

/// The work differs from the change of the energy by an error of the order of the method.
#[test]
fn the_energy_balance_has_the_order_of_the_method() {
    let defect = |size: f64| -> f64 {
        let start = State::from_arrays(0.0, [0.9, 0.2], [0.3, 0.5]);
        let mut run = Integrator::new(Gauss2, Ring { gamma: 0.25 }, start, size).expect("a run");
        let before = run.energy().expect("known");
        let stages = run.step_with_stages().expect("a step");
        run.energy().expect("known") - before - stages.work()
    };
    let found = (defect(0.02) / defect(0.01)).log2();
    assert!((found - 5.0).abs() < 0.1, "{found}");
}

symplectic::hamiltonian! {
    /// A free particle that is pushed harder and harder: p = t²/2, E = t⁴/8.
    pub Pushed
    q: [x], p: [px];
    H = px^2/2
    force: { x = t }
}

/// Over many steps the supplies that [`Balance`] adds up are the integrals in closed form. Gauss with two stages integrates polynomials of
/// degree 3 exactly, f = t and f v = t³/2 among them.
#[test]
fn supplies_add_up_to_integrals() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [0.0], [0.0]);
    let mut run = Integrator::new(Gauss2, Pushed, start, 1.0 / 64.0)?;
    let mut momentum = Balance::new(|state: &State<SVector<f64, 1>>| state.p[0], run.state());
    let energy = |state: &State<SVector<f64, 1>>| state.p[0] * state.p[0] / 2.0;
    let mut energy = Balance::new(energy, run.state());
    for _ in 0..6400 {
        let stages = run.step_with_stages()?;
        momentum.observe(run.state(), stages.impulse(|_, out| out[0] = 1.0));
        energy.observe(run.state(), stages.work());
    }
    let t = run.state().time;
    assert_eq!(t, 100.0);
    for (supplied, deviation, exact) in [
        (momentum.supplied(), momentum.deviation(), t * t / 2.0),
        (energy.supplied(), energy.deviation(), t.powi(4) / 8.0),
    ] {
        assert!((supplied / exact - 1.0).abs() < 1e-14, "{supplied} {exact}");
        assert!(deviation < 1e-14 * exact, "{deviation:e}");
    }
    Ok(())
}

/// Friction takes J (1 − e^{−γt}) of the angular momentum, up to an error of order 4; the balance of the steps is exact.
#[test]
fn friction_removes_angular_momentum_to_order_four() -> Result<(), Error> {
    let errors = [0.1, 0.05].map(|size: f64| {
        let ring = Ring { gamma: 0.25 };
        let mut run = Integrator::new(Gauss2, ring, ring_start(), size).expect("a run");
        let mut balance = Balance::new(angular_momentum, run.state());
        while run.state().time < 20.0 - size / 2.0 {
            let stages = run.step_with_stages().expect("a step");
            balance.observe(run.state(), stages.impulse(turned));
        }
        assert!(balance.deviation() < 1e-14, "{:e}", balance.deviation());
        balance.supplied() - balance.initial() * ((-5.0_f64).exp() - 1.0)
    });
    let slope = (errors[0] / errors[1]).log2();
    assert!((slope - 4.0).abs() < 0.05, "{slope}: {errors:?}");
    Ok(())
}

/// The stages are found once more, from rest, by fixed-point iteration: the evaluations of a step with its stages over those of a step.
#[test]
fn a_step_with_stages_repeats_the_stage_iteration() -> Result<(), Error> {
    let evaluations = std::cell::Cell::new(0_u32);
    let count = || evaluations.set(evaluations.get() + 1);
    let system = symplectic::separable::<SVector<f64, 1>, _, _>(
        |_, p, velocity| {
            count();
            *velocity = *p;
        },
        |_, q, force| {
            count();
            force[0] = -q[0].sin();
        },
    );
    let start = State::from_arrays(0.0, [0.4], [0.9]);
    let mut run = Integrator::new(Gauss3, system, start, 0.1)?;
    let mut costs = [0; 2];
    for step in 0..20 {
        evaluations.set(0);
        run.step()?;
        let without = evaluations.replace(0);
        run.step_with_stages()?;
        if step >= 10 {
            costs[0] += without;
            costs[1] += evaluations.get();
        }
    }
    let ratio = f64::from(costs[1]) / f64::from(costs[0]);
    assert!((2.0..4.0).contains(&ratio), "{ratio} {costs:?}");
    Ok(())
}

symplectic::lagrangian! {
    /// A particle in a ring-shaped valley, with friction, whose mass depends on the place.
    pub Valley { drag: 0.25 }
    q: [x, y], v: [vx, vy];
    let r2 = x^2 + y^2;
    L = (1 + r2/4) (vx^2 + vy^2)/2 - r2 (r2 - 1)^2
    force: { x = -drag vx, y = -drag vy }
}

impl DiracSystem for Valley {}

/// For Lagrangians too: methods of Runge and Kutta, Galerkin paths with more nodes than functions, and the rules of Dirac mechanics.
#[test]
fn lagrangian_steps_balance_angular_momentum_and_energy() -> Result<(), Error> {
    type Plane = State<Vector2<f64>>;
    /// Checks the balance of the angular momentum, and returns the defect of that of the energy. `step` returns the state and the energy after a
    /// step, with its stages.
    fn defect<S>(start: &Plane, energy: f64, mut step: S) -> Result<f64, Error>
    where
        S: FnMut() -> Result<(Plane, f64, StagesOfStep<Vector2<f64>>), Error>,
    {
        let (mut before, mut energy, mut first) = (angular_momentum(start), energy, None);
        for _ in 0..20 {
            let (state, after, stages) = step()?;
            let (moment, work) = (angular_momentum(&state), stages.work());
            let change = moment - before;
            assert!(
                (change - stages.impulse(turned)).abs() < 4e-15,
                "{change:e}"
            );
            assert!(change.abs() > 1e-5, "{change:e}");
            first.get_or_insert(after - energy - work);
            (before, energy) = (moment, after);
        }
        Ok(first.unwrap_or(f64::NAN))
    }
    let start = || State::from_arrays(0.0, [0.9, 0.2], [0.3, 0.5]);
    let lagrangian = |galerkin: bool, size: f64| -> Result<f64, Error> {
        let mut run = if galerkin {
            LagrangianSteps::galerkin(TwoOfThree, Valley::new(), start(), size)?
        } else {
            LagrangianSteps::run(Gauss2, Valley::new(), start(), size)?
        };
        defect(&start(), run.stepper().energy()?, || {
            let stages = run.step_with_stages()?;
            Ok((run.state().clone(), run.stepper().energy()?, stages))
        })
    };
    let dirac = |rule: DiracRule, composed: bool, size: f64| -> Result<f64, Error> {
        let mut run = if composed {
            DiracSteps::composed(Suzuki4, rule, Valley::new(), start(), size)?
        } else {
            DiracSteps::run(rule, Valley::new(), start(), size)?
        };
        defect(&start(), run.stepper().energy(), || {
            let stages = run.step_with_stages()?;
            Ok((run.state().clone(), run.stepper().energy(), stages))
        })
    };
    // One step: an order more than the method.
    for (name, coarse, fine, order) in [
        (
            "Gauss 2",
            lagrangian(false, 0.04)?,
            lagrangian(false, 0.02)?,
            5.0,
        ),
        (
            "Galerkin",
            lagrangian(true, 0.04)?,
            lagrangian(true, 0.02)?,
            5.0,
        ),
        (
            "midpoint",
            dirac(DiracRule::Midpoint, false, 0.04)?,
            dirac(DiracRule::Midpoint, false, 0.02)?,
            3.0,
        ),
        (
            "trapezoid",
            dirac(DiracRule::Trapezoid, false, 0.04)?,
            dirac(DiracRule::Trapezoid, false, 0.02)?,
            3.0,
        ),
        (
            "composition",
            dirac(DiracRule::Midpoint, true, 0.04)?,
            dirac(DiracRule::Midpoint, true, 0.02)?,
            5.0,
        ),
    ] {
        let slope = (coarse / fine).log2();
        assert!((slope - order).abs() < 0.15, "{name}: {slope}");
    }
    Ok(())
}

/// With rows the impulses of the constraints are in no stage. A symmetry along the rows keeps its balance: the heading of a rolling disk.
#[test]
fn a_symmetry_along_nonholonomic_rows_keeps_its_balance() -> Result<(), Error> {
    let mut run = DiracSteps::run(DiracRule::Midpoint, Braked, disk_start(), 0.1)?;
    for _ in 0..20 {
        let before = run.state().p;
        let stages = run.step_with_stages()?;
        let change = run.state().p - before;
        let impulse = |k: usize| stages.impulse(move |_, out| out[k] = 1.0);
        assert!((change[3] - impulse(3)).abs() < 1e-15 && impulse(3) < -1e-4);
        // Not that of the place, which the constraint moves.
        assert!((change[0] - impulse(0)).abs() > 1e-4);
    }
    Ok(())
}

/// The rolling disk with friction of its heading.
#[derive(Clone, Copy)]
struct Braked;

impl Lagrangian for Braked {
    type Vector<T: Scalar> = SVector<T, 4>;

    const FORCED: bool = true;

    fn lagrangian<T: Scalar>(&self, time: T, q: &SVector<T, 4>, v: &SVector<T, 4>) -> T {
        Disk.lagrangian(time, q, v)
    }

    fn force<T: Scalar>(
        &self,
        _: T,
        _: &SVector<T, 4>,
        v: &SVector<T, 4>,
        force: &mut SVector<T, 4>,
    ) {
        force[3] = -v[3] * T::from_f64(0.05);
    }
}

impl DiracSystem for Braked {
    fn nonholonomic_constraints(&self) -> usize {
        DiracSystem::nonholonomic_constraints(&Disk)
    }

    fn nonholonomic_rows<T: Scalar>(&self, q: &SVector<T, 4>, rows: &mut Gradients<T>) {
        DiracSystem::nonholonomic_rows(&Disk, q, rows);
    }
}
