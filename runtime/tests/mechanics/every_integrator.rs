//! The same checks of every integrator: what is conserved, the form dq∧dp, and symmetries. Each row has a twin that fails.

use crate::methods::{Gauss2, TwoOfThree};
use std::panic::{AssertUnwindSafe, catch_unwind};

use symplectic::constraints::consistent;
use symplectic::flow::{Drift, Flow, FlowIntegrator, FlowSteps, Kick, Splitting};
use symplectic::nalgebra::{
    Matrix3, Rotation2, Rotation3, SVector, UnitQuaternion, Vector2, Vector3, Vector4,
};
use symplectic::rotation::{HeavyTop, RigidBody, RotationState, RotationSteps};
use symplectic::stepper::{PhasePoint, StepMap};
use symplectic::variational::{
    DiracRule, DiracSteps, Error, LagrangianSteps, VariationalSteps, momentum_of_velocity,
};
use symplectic::{Error as CoreError, Integrator, State, acceleration, assert_conserved};

use crate::dirac::{V6, Vortices, vortices_start};
use crate::discrete_lagrangians::{Trapezoid, perihelion};
use crate::forces::Resisted;
use crate::lagrangians::{Particle, near_perihelion};
use crate::rolling::{Disk, Midpoint, disk_start};
use crate::rotation::{LOPSIDED, Suzuki4, start as top_start};
use crate::symmetry::Bead;
use crate::systems::{DoubleSpherical, Lobatto3, Rattle4, V6 as SixVector, double_start};

symplectic::splitting! { Verlet { kick: [1/2, 1/2], drift: [1, 0] } }

type Plane = State<Vector2<f64>>;
type Space = State<Vector3<f64>>;

/// Whether a check passes.
fn passes(check: impl FnOnce()) -> bool {
    catch_unwind(AssertUnwindSafe(check)).is_ok()
}

fn turned_plane(state: &Plane) -> Plane {
    let turn = Rotation2::new(1.1);
    State::new(state.time, turn * state.q, turn * state.p)
}

pub(crate) fn kepler_by_flows(
    start: Plane,
) -> Result<FlowIntegrator<Vector2<f64>, impl Flow<Vector2<f64>> + Clone>, symplectic::flow::Error>
{
    let attraction = acceleration(|_, q: &Vector2<f64>, out| *out = -q / q.norm().powi(3));
    let free = acceleration(|_, _q: &Vector2<f64>, out| *out = Vector2::zeros());
    FlowSteps::run(
        Splitting::new(Verlet, Drift::new(free), Kick::new(attraction)),
        start,
        0.05,
    )
}

/// On the sphere, `H = |p|²(2 + z)/2 + z`.
pub(crate) fn bead(a: f64, b: f64) -> Space {
    let state = State::from_arrays(
        0.0,
        [0.6 + a, 0.1 * b, -0.8],
        [0.3 - a + 0.7 * b, 0.5 + b - 0.4 * a, 0.2],
    );
    consistent(&Bead, state).expect("a state on the sphere")
}

#[test]
#[ignore = "thorough"]
fn every_integrator_conserves_its_momentum_maps() -> Result<(), Box<dyn std::error::Error>> {
    let angular = |state: &Plane| state.q.perp(&state.p);
    let distance = |state: &Plane| state.q.norm();
    // Constraints: the angular momentum about the vertical, and about another axis.
    let new = || Integrator::new(Lobatto3, Bead, bead(0.0, 0.0), 0.1).expect("a run");
    let about = |axis: usize| move |state: &Space| state.q.cross(&state.p)[axis];
    assert_conserved!(new(), 1000, about(2), 4e-15);
    assert!(!passes(|| assert_conserved!(new(), 1000, about(0), 1e-3)));
    // A rolling disk keeps the momentum of its heading, but not that of its place.
    let new = || Integrator::new(Midpoint, Disk, disk_start(), 0.1).expect("a run");
    let part = |k: usize| move |state: &State<Vector4<f64>>| state.p[k];
    assert_conserved!(new(), 1000, part(3), 4e-15);
    assert!(!passes(|| assert_conserved!(new(), 1000, part(0), 1e-3)));
    let new = || DiracSteps::run(DiracRule::Midpoint, Disk, disk_start(), 0.1).expect("a run");
    assert_conserved!(new(), 1000, part(3), 1e-14);
    assert!(!passes(|| assert_conserved!(new(), 1000, part(0), 1e-3)));
    // Vortices keep their centre.
    let new =
        || DiracSteps::run(DiracRule::Midpoint, Vortices, vortices_start(), 0.1).expect("a run");
    let centre = |state: &State<V6<f64>>| state.q.fixed_rows::<3>(0).sum();
    assert_conserved!(new(), 1000, centre, 1e-13);
    assert!(!passes(|| assert_conserved!(
        new(),
        1000,
        |state: &State<V6<f64>>| state.q[0],
        1e-3
    )));
    // Discrete Lagrangians, Lagrangians with and without friction, and flows.
    let new = || VariationalSteps::run(Trapezoid, perihelion(), 0.05).expect("a run");
    assert_conserved!(new(), 1000, angular, 1e-13);
    assert!(!passes(|| assert_conserved!(new(), 1000, distance, 1e-3)));
    let new = |friction| {
        LagrangianSteps::run(Gauss2, Particle { friction }, near_perihelion(), 0.1).expect("a run")
    };
    assert_conserved!(new(0.0), 1000, angular, 1e-13);
    assert!(!passes(|| assert_conserved!(
        new(0.01),
        1000,
        angular,
        1e-3
    )));
    let new = || kepler_by_flows(perihelion()).expect("a run");
    assert_conserved!(new(), 1000, angular, 1e-13);
    assert!(!passes(|| assert_conserved!(new(), 1000, distance, 1e-3)));
    // On SO(3), the angular momentum about the vertical.
    let new = || RotationSteps::run(LOPSIDED, top_start(), 0.05).expect("a run");
    let about = |axis: usize| move |state: &RotationState| state.spatial_momentum()[axis];
    assert_conserved!(new(), 1000, about(2), 8e-15);
    assert!(!passes(|| assert_conserved!(new(), 1000, about(0), 1e-3)));
    Ok(())
}

/// A top with a torque that is fixed in the body. It has no potential: its work on a closed way is not zero.
#[derive(Clone)]
struct Driven(HeavyTop);

impl RigidBody for Driven {
    fn moments(&self) -> Vector3<f64> {
        self.0.moments
    }

    fn torque(&self, time: f64, attitude: &UnitQuaternion<f64>) -> Vector3<f64> {
        self.0.torque(time, attitude) + Vector3::new(0.3, 0.1, -0.2)
    }
}

/// States of a top near its start.
fn tops(a: f64, b: f64) -> RotationState {
    let RotationState {
        time,
        attitude,
        momentum,
    } = top_start();
    let turn = UnitQuaternion::from_scaled_axis(Vector3::new(a, 0.4 * b, -0.3 * a));
    RotationState::new(
        time,
        attitude * turn,
        momentum + Vector3::new(0.2 * a, b, 0.5 * b - a),
    )
}

/// States of the double pendulum near its start.
fn doubles(a: f64, b: f64) -> State<SixVector<f64>> {
    let mut state = double_start();
    state.q[0] += a;
    state.q[4] += 0.5 * b - a;
    state.p[1] += b;
    state.p[3] += 0.3 * a;
    consistent(&DoubleSpherical, state).expect("on the rods")
}

/// States of three vortices, with the momenta that belong to their places.
fn vortices(a: f64, b: f64) -> State<V6<f64>> {
    let mut q = vortices_start().q;
    q[0] += a;
    q[4] += b - 0.5 * a;
    let p = momentum_of_velocity(&Vortices, 0.0, &q, &V6::zeros()).expect("finite");
    State::new(0.0, q, p)
}

#[test]
fn every_symplectic_integrator_passes_the_symplecticity_check()
-> Result<(), Box<dyn std::error::Error>> {
    const BOUND: f64 = 1e-11;
    let near = |state: Plane| {
        move |a: f64, b: f64| {
            let by = SVector::from([0.2 * a, 0.1 * b - 0.1 * a]);
            State::new(
                0.0,
                state.q + by,
                state.p + SVector::from([0.1 * b, 0.2 * a]),
            )
        }
    };
    let bead_run = Integrator::new(Lobatto3, Bead, bead(0.0, 0.0), 0.2)?;
    let double = Integrator::new(Rattle4, DoubleSpherical, doubles(0.0, 0.0), 0.05)?;
    let discrete = VariationalSteps::run(Trapezoid, perihelion(), 0.05)?;
    let particle =
        |friction| LagrangianSteps::run(Gauss2, Particle { friction }, near_perihelion(), 0.1);
    let galerkin = LagrangianSteps::galerkin(
        TwoOfThree,
        Particle { friction: 0.0 },
        near_perihelion(),
        0.1,
    )?;
    let dirac = DiracSteps::run(DiracRule::Midpoint, Vortices, vortices_start(), 0.1)?;
    let top = RotationSteps::run(LOPSIDED, top_start(), 0.1)?;
    let fourth = RotationSteps::composed(Suzuki4, LOPSIDED, top_start(), 0.1)?;
    for (name, defect) in [
        ("constraint", bead_run.symplecticity_defect(bead)?),
        ("two constraints", double.symplecticity_defect(doubles)?),
        (
            "discrete Lagrangian",
            discrete.symplecticity_defect(near(perihelion()))?,
        ),
        (
            "Lagrangian",
            particle(0.0)?.symplecticity_defect(near(near_perihelion()))?,
        ),
        (
            "Galerkin",
            galerkin.symplecticity_defect(near(near_perihelion()))?,
        ),
        ("vortices", dirac.symplecticity_defect(vortices)?),
        (
            "flows",
            kepler_by_flows(perihelion())?.symplecticity_defect(near(perihelion()))?,
        ),
        ("top", top.symplecticity_defect(tops)?),
        ("top, order 4", fourth.symplecticity_defect(tops)?),
    ] {
        assert!(defect < BOUND, "{name}: {defect:e}");
    }
    // Friction with a constraint, friction with a Lagrangian, a torque without a potential, and a non-holonomic constraint.
    let resisted = |a: f64, b: f64| {
        let state = bead(a, b);
        consistent(&Resisted::new(), state).expect("on the sphere")
    };
    let resisted_run = Integrator::new(Lobatto3, Resisted::new(), resisted(0.0, 0.0), 0.1)?;
    let driven = RotationSteps::run(Driven(LOPSIDED), top_start(), 0.1)?;
    for (name, defect) in [
        ("resisted", resisted_run.symplecticity_defect(resisted)?),
        (
            "resisted Lagrangian",
            particle(0.1)?.symplecticity_defect(near(near_perihelion()))?,
        ),
        ("driven top", driven.symplecticity_defect(tops)?),
    ] {
        assert!(defect > 1e-4, "{name}: {defect:e}");
    }
    Ok(())
}

/// On two directions the form of `T*SO(3)` is `η·dΠ' − η'·dΠ + Π·(η×η')`.
#[test]
fn the_symplectic_form_of_a_top_is_that_of_the_cotangent_bundle() {
    const STEP: f64 = 1e-5;
    let difference = |one: RotationState, other: RotationState| {
        let (one, other) = (one.canonical(), other.canonical());
        [
            (one.q - other.q) / (2.0 * STEP),
            (one.p - other.p) / (2.0 * STEP),
        ]
    };
    let [q, p] = difference(tops(STEP, 0.0), tops(-STEP, 0.0));
    let [other_q, other_p] = difference(tops(0.0, STEP), tops(0.0, -STEP));
    let found: f64 = (q.transpose() * other_p - p.transpose() * other_q).trace();
    let (eta, other_eta) = (Vector3::new(1.0, 0.0, -0.3), Vector3::new(0.0, 0.4, 0.0));
    let (change, other_change) = (Vector3::new(0.2, 0.0, -1.0), Vector3::new(0.0, 1.0, 0.5));
    let momentum = top_start().momentum;
    let expected =
        eta.dot(&other_change) - other_eta.dot(&change) + momentum.dot(&eta.cross(&other_eta));
    assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    let canonical = top_start().canonical();
    let eta = Matrix3::from(canonical.q * Vector3::new(0.7, -0.2, 0.4).cross_matrix());
    assert!(
        ((canonical.p.transpose() * eta).trace() - momentum.dot(&Vector3::new(0.7, -0.2, 0.4)))
            .abs()
            < 1e-15
    );
}

#[test]
fn every_integrator_commutes_with_symmetries() -> Result<(), Box<dyn std::error::Error>> {
    let stretched = |state: &Plane| State::new(state.time, state.q * 2.0, state.p / 2.0);
    let discrete = VariationalSteps::run(Trapezoid, perihelion(), 0.05)?;
    let particle =
        LagrangianSteps::run(Gauss2, Particle { friction: 0.2 }, near_perihelion(), 0.1)?;
    let galerkin = LagrangianSteps::galerkin(
        TwoOfThree,
        Particle { friction: 0.2 },
        near_perihelion(),
        0.1,
    )?;
    let flows = kepler_by_flows(perihelion())?;
    let slow = |state: &Plane| State::new(state.time, state.q * 2.0, state.p * 0.9);
    let dirac = DiracSteps::run(DiracRule::Midpoint, Vortices, vortices_start(), 0.1)?;
    // Rotations and dilations of the plane; momenta are linear in the places.
    let vortices = |turn: Rotation2<f64>, factor: f64| {
        move |state: &State<V6<f64>>| {
            let mut q = state.q;
            for k in 0..3 {
                let place = turn * Vector2::new(q[k], q[k + 3]) * factor;
                (q[k], q[k + 3]) = (place.x, place.y);
            }
            let p = momentum_of_velocity(&Vortices, 0.0, &q, &V6::zeros()).expect("finite");
            State::new(state.time, q, p)
        }
    };
    let top = RotationSteps::run(LOPSIDED, top_start(), 0.1)?;
    let turned = |axis| {
        move |state: &RotationState| {
            let turn = UnitQuaternion::from_axis_angle(&axis, 1.1);
            RotationState::new(state.time, turn * state.attitude, state.momentum)
        }
    };
    let bead_run = Integrator::new(Lobatto3, Bead, bead(0.0, 0.0), 0.2)?;
    let turned_bead = |axis| {
        move |state: &Space| {
            let turn = Rotation3::from_axis_angle(&axis, 1.1);
            State::new(state.time, turn * state.q, turn * state.p)
        }
    };
    let (vertical, horizontal) = (Vector3::z_axis(), Vector3::x_axis());
    for (name, with, without) in [
        (
            "discrete Lagrangian",
            discrete.equivariance_defect(turned_plane)?,
            discrete.equivariance_defect(stretched)?,
        ),
        (
            "Lagrangian",
            particle.equivariance_defect(turned_plane)?,
            particle.equivariance_defect(slow)?,
        ),
        (
            "Galerkin",
            galerkin.equivariance_defect(turned_plane)?,
            galerkin.equivariance_defect(slow)?,
        ),
        (
            "flows",
            flows.equivariance_defect(turned_plane)?,
            flows.equivariance_defect(stretched)?,
        ),
        (
            "vortices",
            dirac.equivariance_defect(vortices(Rotation2::new(1.1), 1.0))?,
            dirac.equivariance_defect(vortices(Rotation2::identity(), 1.3))?,
        ),
        (
            "top",
            top.equivariance_defect(turned(vertical))?,
            top.equivariance_defect(turned(horizontal))?,
        ),
        (
            "bead",
            bead_run.equivariance_defect(turned_bead(vertical))?,
            bead_run.equivariance_defect(turned_bead(horizontal))?,
        ),
    ] {
        assert!(with < 1e-14, "{name}: {with:e}");
        assert!(without > 1e-3, "{name}: {without:e}");
    }
    Ok(())
}

/// A check takes no step, and a state that is refused is an error.
#[test]
fn checks_do_not_advance_the_integrator() -> Result<(), Error> {
    let top = RotationSteps::run(LOPSIDED, top_start(), 0.1)?;
    top.symplecticity_defect(tops)?;
    assert_eq!((top.steps(), top.present()), (0, &top_start()));
    let broken =
        |_: f64, _: f64| RotationState::new(f64::NAN, UnitQuaternion::identity(), Vector3::zeros());
    assert!(matches!(
        top.symplecticity_defect(broken),
        Err(Error::Core(CoreError::NonFiniteState { .. }))
    ));
    let dirac = DiracSteps::run(DiracRule::Midpoint, Vortices, vortices_start(), 0.1)?;
    let off = |_: f64, _: f64| State::new(0.0, vortices_start().q, V6::zeros());
    assert!(matches!(
        dirac.symplecticity_defect(off),
        Err(Error::PrimaryConstraint { .. })
    ));
    Ok(())
}
