//! Constraints of bodies at rest at the origin: neither position nor velocity gives a scale for their rounding errors.

use symplectic::constraints::{Constrained, HolonomicConstraints};
use symplectic::nalgebra::{Vector2, Vector3, Vector4};
use symplectic::{Error, Integrator, Method, ProvedFor, Separable, State};

use crate::rolling::Midpoint;
use crate::systems::*;

symplectic::hamiltonian! {
    /// A pendulum whose pivot is a body that is held at a place. Constraints have units of their own.
    pub Held { x: 0, y: 0, length: 1, g: 9.81, heavy: 1, unit: 1, square: 1 }
    q: [x0, y0, x1, y1], p: [px0, py0, px1, py1];
    H = (px0^2 + py0^2)/(2 heavy) + (px1^2 + py1^2)/2 + g (heavy y0 + y1)
    constraints: {
        along_x = unit (x0 - x),
        along_y = unit (y0 - y),
        rod = square ((x1 - x0)^2 + (y1 - y0)^2 - length^2),
    }
}

symplectic::hamiltonian! {
    /// The same pendulum without the body at its pivot.
    pub Alone { x: 0, y: 0, length: 1, g: 9.81 }
    q: [x1, y1], p: [px, py];
    H = (px^2 + py^2)/2 + g y1
    constraints: { rod = (x1 - x)^2 + (y1 - y)^2 - length^2 }
}

fn start(held: Held, angle: f64) -> State<Vector4<f64>> {
    let (sine, cosine) = angle.sin_cos();
    let (x, y) = (held.x + held.length * sine, held.y - held.length * cosine);
    State::from_arrays(0.0, [held.x, held.y, x, y], [0.0; 4])
}

/// The largest residual of φ, relative to the length of the rod and its square, over `steps` steps; and the last state.
fn run<M: Method + ProvedFor<Constrained<Separable>>>(
    method: M,
    held: Held,
    (angle, size, steps): (f64, f64, u32),
) -> Result<(f64, State<Vector4<f64>>), Error> {
    let mut run = Integrator::new(method, held, start(held, angle), size)?;
    let mut largest = 0.0_f64;
    for _ in 0..steps {
        let q = &run.step()?.q;
        let mut values = [0.0; 3];
        held.constraint_values(q, &mut values);
        let rod = held.square * held.length * held.length;
        let scales = [held.unit * held.length, held.unit * held.length, rod];
        for (value, scale) in values.iter().zip(scales) {
            largest = largest.max((value / scale).abs());
        }
    }
    Ok((largest, run.state().clone()))
}

/// Steps of the pendulum with a held pivot and of the pendulum alone are the same, and so is the energy of both.
#[test]
#[ignore = "thorough"]
fn a_body_held_at_the_origin_is_a_pivot() -> Result<(), Error> {
    fn check<M: Method + Copy + ProvedFor<Constrained<Separable>>>(
        method: M,
        held: Held,
        angle: f64,
        steps: u32,
    ) -> Result<(), Error> {
        let (largest, end) = run(method, held, (angle, 0.01, steps))?;
        assert!(largest < 1e-14, "{}: {largest:e}", M::NAME);
        let Held {
            x, y, length, g, ..
        } = held;
        let alone = Alone { x, y, length, g };
        let first = start(held, angle);
        let [q, p] = [&first.q, &first.p].map(|v| Vector2::new(v[2], v[3]));
        let mut run = Integrator::new(method, alone, State::new(0.0, q, p), 0.01)?;
        let single = run.take_steps(u64::from(steps))?.clone();
        let after = run.energy().expect("known");
        let [q, p] = [&end.q, &end.p].map(|v| Vector2::new(v[2], v[3]));
        let apart = (q - single.q).norm().max((p - single.p).norm());
        assert!(apart < 1e-9, "{}: {apart:e}", M::NAME);
        let energy = p.norm_squared() / 2.0 + g * q[1];
        let drift = (energy - after).abs();
        assert!(drift < 1e-11, "{}: {drift:e}", M::NAME);
        assert!(end.p[0].abs().max(end.p[1].abs()) < 1e-14);
        Ok(())
    }
    let pivot = Held::default();
    check(Rattle, pivot, 1.5, 10_000)?;
    check(Lobatto3, pivot, 1.5, 10_000)?;
    for angle in [0.3, -1.5, std::f64::consts::FRAC_PI_2, 2.5] {
        check(Rattle, pivot, angle, 1000)?;
        check(Lobatto3, pivot, angle, 1000)?;
    }
    check(Lobatto4, pivot, 1.5, 1000)?;
    check(Rattle4, pivot, 1.5, 1000)?;
    for (x, y) in [
        (0.5, 0.0),
        (0.0, -0.7),
        (0.5, 0.25),
        (0.0, 1e-300),
        (1e-20, 1e-18),
    ] {
        let held = Held {
            x,
            y,
            ..Held::default()
        };
        check(Rattle, held, 1.5, 1000)?;
        check(Lobatto3, held, 1.5, 1000)?;
    }
    Ok(())
}

/// Units of length, of mass and of the constraints do not matter.
#[test]
fn a_held_body_does_not_depend_on_units() -> Result<(), Error> {
    let plain = Held::default();
    let long = |length: f64| Held {
        length,
        g: 9.81 * length,
        ..plain
    };
    let cases = [
        (long(1e-150), 0.01),
        (long(1e150), 0.01),
        // With the gravity of the Earth, time scales with the root of the length.
        (
            Held {
                length: 1e-100,
                ..plain
            },
            1e-52,
        ),
        (
            Held {
                length: 1e100,
                ..plain
            },
            1e48,
        ),
        (
            Held {
                unit: 1e10,
                square: 1e-10,
                ..plain
            },
            0.01,
        ),
        (
            Held {
                unit: 1e-10,
                square: 1e10,
                ..plain
            },
            0.01,
        ),
        (
            Held {
                heavy: 1e10,
                ..plain
            },
            0.01,
        ),
        (
            Held {
                heavy: 1e-3,
                ..plain
            },
            0.01,
        ),
    ];
    for (held, size) in cases {
        for angle in [0.3, 1.5] {
            for largest in [
                run(Rattle, held, (angle, size, 300))?.0,
                run(Lobatto3, held, (angle, size, 300))?.0,
            ] {
                assert!(largest < 1e-14, "{held:?}: {largest:e}");
            }
        }
    }
    Ok(())
}

/// The state after a step may be the start of another run.
#[test]
fn a_run_with_a_held_body_starts_again_after_every_step() -> Result<(), Error> {
    let held = Held::default();
    let mut state = start(held, 1.5);
    for _ in 0..200 {
        let mut run = Integrator::new(Lobatto3, held, state, 0.01)?;
        state = run.step()?.clone();
    }
    Ok(())
}

symplectic::hamiltonian! {
    /// A bead on an inclined line.
    pub Line { slope: 3 }
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + y
    constraints: { line = y - slope x }
}

symplectic::hamiltonian! {
    /// A bead that two lines hold; the force is along one of them.
    pub Crossing
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + y - x
    constraints: { along = x + y, across = x - y }
}

symplectic::hamiltonian! {
    /// The bead at the crossing, by rows.
    pub CrossingByRows
    q: [x, y], p: [px, py], v: [vx, vy];
    H = (px^2 + py^2)/2 + 0.7 y - 0.3 x
    nonholonomic: { along = vx + vy, across = vx - 3 vy }
}

symplectic::hamiltonian! {
    /// A held body whose momentum moves another.
    pub Coupled
    q: [x, y, z], p: [px, py, pz];
    H = (px^2 + py^2 + pz^2)/2 + 0.3 px py + 0.2 py pz + x - 0.7 y + cos(z)
    constraints: { along_x = x, along_y = x + 3 y }
}

#[test]
fn beads_start_from_rest_at_the_origin() -> Result<(), Error> {
    fn check<M: Method + Copy + ProvedFor<Constrained<Separable>>>(method: M) -> Result<(), Error> {
        let start = || State::from_arrays(0.0, [0.0_f64, 0.0], [0.0, 0.0]);
        for slope in [3.0, -0.3, 1e-5, 7e8] {
            let mut run = Integrator::new(method, Line { slope }, start(), 0.01)?;
            let end = run.take_steps(1000)?;
            // y'' = −slope²/(1 + slope²)
            let fall = -50.0 * slope * slope / (1.0 + slope * slope);
            assert!((end.q[1] - fall).abs() < 1e-12 * fall.abs());
        }
        let mut run = Integrator::new(method, Crossing, start(), 0.01)?;
        let end = run.take_steps(1000)?;
        assert!(end.q.norm() < 1e-18 && end.p.norm() < 1e-17, "{end:?}");
        let start: State<Vector3<f64>> = State::from_arrays(0.0, [0.0, 0.0, 0.5], [0.0; 3]);
        let start = symplectic::constraints::consistent(&Coupled, start)?;
        let mut run = Integrator::new(method, Coupled, start, 0.01)?;
        let end = run.take_steps(1000)?;
        assert!(end.q.fixed_rows::<2>(0).norm() < 1e-17, "{end:?}");
        Ok(())
    }
    check(Rattle)?;
    check(Lobatto3)?;
    check(Lobatto4)?;
    let start = State::from_arrays(0.0, [0.0, 0.0], [0.0, 0.0]);
    let mut run = Integrator::new(Midpoint, CrossingByRows, start, 0.01)?;
    let end = run.take_steps(1000)?;
    assert!(end.q.norm() < 1e-15 && end.p.norm() < 1e-16, "{end:?}");
    Ok(())
}

symplectic::hamiltonian! {
    /// A held body, with a constraint twice; `apart` moves its second copy.
    pub Twice { apart: 0 }
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + y + x
    constraints: { along_x = x, again = x + apart x y }
}

symplectic::hamiltonian! {
    /// A bead that must stay where a bounded function has a value, near the origin at rest.
    pub Bounded { rate: 1 }
    q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + 1000 y
    constraints: { bounded = atan(y) - x/(1 + x^2) }
}

/// The sizes of impulses excuse rounding errors only.
#[test]
fn steps_without_a_solution_are_refused() {
    let start = || State::from_arrays(0.0, [0.0_f64, 0.0], [0.0, 0.0]);
    for apart in [0.0, 1.0] {
        let error = Integrator::new(Rattle, Twice { apart }, start(), 0.1).map(|_| ());
        let error = error.expect_err("dependent");
        assert!(
            matches!(error, Error::DependentConstraints { .. }),
            "{error}"
        );
    }
    // Rounding errors of forces on so light a body are larger than its motion.
    let light = Held {
        heavy: 1e-10,
        ..Held::default()
    };
    run(Rattle, light, (1.5, 0.01, 1000)).expect_err("too light a body");
    for size in [10.0, 1e3, 1e6, 1e9] {
        let held = Held::default();
        let error = run(Rattle, held, (1.5, size, 3)).map(|_| ());
        error.expect_err("too large a step");
        let error = run(Lobatto3, held, (1.5, size, 3)).map(|_| ());
        error.expect_err("too large a step");
        let mut run = Integrator::new(Rattle, Bounded::default(), start(), size).expect("a run");
        if let Ok(State { q, .. }) = run.step() {
            let q: &Vector2<f64> = q;
            let defect = q[1].atan() - q[0] / (1.0 + q[0] * q[0]);
            assert!(defect.abs() < 1e-14, "{size}: {q:?}");
        }
    }
}
