//! Steps with constraints, forces and Galerkin paths commute with the symmetries of their systems, and balance momentum maps.

use crate::methods::{Gauss2, Lobatto3, TwoOfThree};
use symplectic::constraints::Constrained;
use symplectic::nalgebra::{Rotation2, Rotation3, Vector2, Vector3};
use symplectic::stepper::StepMap;
use symplectic::variational::{Error, LagrangianSteps, momentum_map};
use symplectic::{General, Integrator, Method, ProvedFor, Separable, State};

use crate::forces::{FourthRattle, Resisted, swing};
use crate::lagrangians::distance;
use crate::systems::{AdjointEuler, DoubleSpherical, Euler, Lobatto4, Rattle, double_start};

/// A rotation about the vertical axis, and one about a horizontal one.
fn rotations() -> [Rotation3<f64>; 2] {
    [Vector3::z_axis(), Vector3::x_axis()].map(|axis| Rotation3::from_axis_angle(&axis, 1.1))
}

/// Gravity is invariant under rotations about the vertical axis only, and so are the steps, with drag too.
#[test]
fn constrained_steps_commute_with_rotations_about_the_vertical() -> Result<(), Error> {
    fn defects<M>(method: M) -> Result<[f64; 2], Error>
    where
        M: Method + ProvedFor<Constrained<General>>,
    {
        let run = Integrator::new(method, Resisted::new(), swing(), 0.1)?;
        let [vertical, horizontal] = rotations().map(|turn| {
            run.equivariance_defect(|state| State::new(state.time, turn * state.q, turn * state.p))
        });
        Ok([vertical?, horizontal?])
    }
    for [vertical, horizontal] in [
        defects(Euler)?,
        defects(AdjointEuler)?,
        defects(Rattle)?,
        defects(Lobatto3)?,
        defects(Lobatto4)?,
        defects(FourthRattle)?,
    ] {
        assert!(vertical < 4e-15, "{vertical:e}");
        assert!(horizontal > 1e-2, "{horizontal:e}");
    }
    Ok(())
}

/// Two constraints: both masses turn.
#[test]
fn the_double_pendulum_turns_as_a_whole() -> Result<(), Error> {
    fn defects<M>(method: M) -> Result<[f64; 2], Error>
    where
        M: Method + ProvedFor<Constrained<Separable>>,
    {
        let run = Integrator::new(method, DoubleSpherical, double_start(), 0.1)?;
        let [vertical, horizontal] = rotations().map(|turn| {
            run.equivariance_defect(|state| {
                let mut turned = state.clone();
                for vector in [&mut turned.q, &mut turned.p] {
                    for first in [0, 3] {
                        let part = turn * vector.fixed_rows::<3>(first);
                        vector.fixed_rows_mut::<3>(first).copy_from(&part);
                    }
                }
                turned
            })
        });
        Ok([vertical?, horizontal?])
    }
    for [vertical, horizontal] in [defects(Rattle)?, defects(Lobatto4)?] {
        assert!(vertical < 4e-15, "{vertical:e}");
        assert!(horizontal > 1e-2, "{horizontal:e}");
    }
    Ok(())
}

symplectic::lagrangian! {
    /// A particle whose mass depends on the distance, with drag and a constant torque.
    pub Turned { drag: 0.2, torque: 0.7 }
    q: [x, y], v: [vx, vy];
    let r2 = x^2 + y^2;
    L = (1 + r2) (vx^2 + vy^2)/2 - r2^2/4
    force: { x = -drag vx - torque y/r2, y = -drag vy + torque x/r2 }
}

fn plane_start() -> State<Vector2<f64>> {
    State::from_arrays(0.0, [1.0, 0.2], [-0.3, 0.9])
}

/// Paths with more nodes than functions, and with as many.
#[test]
fn galerkin_steps_commute_with_rotations() -> Result<(), Error> {
    let turn = Rotation2::new(1.1);
    let turned =
        |state: &State<Vector2<f64>>| State::new(state.time, turn * state.q, turn * state.p);
    let of_three = |start| LagrangianSteps::galerkin(TwoOfThree, Turned::new(), start, 0.1);
    let of_two = |start| LagrangianSteps::galerkin(Gauss2, Turned::new(), start, 0.1);
    for (mut run, mut other) in [
        (of_three(plane_start())?, of_three(turned(&plane_start()))?),
        (of_two(plane_start())?, of_two(turned(&plane_start()))?),
    ] {
        for _ in 0..10 {
            let defect = distance(&turned(run.step()?), other.step()?);
            assert!(defect < 1e-14, "{defect:e}");
        }
    }
    Ok(())
}

/// `J^{f+}(q0, q1) − J^{f−}(q0, q1) = h Σ b_i f_i·ξ_Q(Q_i)`, where `J^{f−} = p0·ξ_Q(q0)` and `J^{f+} = p1·ξ_Q(q1)`. Without drag the torque
/// is the same at every stage, and with it is not.
#[test]
fn galerkin_steps_balance_the_angular_momentum() -> Result<(), Error> {
    let angular = |state: &State<Vector2<f64>>| {
        momentum_map(state, |q, out| *out = Vector2::new(-q[1], q[0]))
    };
    for (drag, balanced) in [(0.0, true), (0.2, false)] {
        let system = Turned { drag, torque: 0.7 };
        let mut run = LagrangianSteps::galerkin(TwoOfThree, system, plane_start(), 0.1)?;
        for _ in 0..50 {
            let before = angular(run.state());
            let change = angular(run.step()?) - before;
            let defect = (change - 0.1 * 0.7).abs();
            assert_eq!(defect < 4e-15, balanced, "{defect:e}");
            assert!(balanced || defect > 1e-4, "{defect:e}");
        }
    }
    Ok(())
}
