//! Methods with gradient kicks on formulas, chains and systems by hand.

use crate::common::methods::{Chin, ChinChen};
use symplectic::nalgebra::{DVector, SVector, Vector1};
use symplectic::{
    Checkpoint, Error, Integrator, Method, ProvedFor, Scalar, Separable, SeparableHamiltonian,
    State, System, Vector,
};

symplectic::tableau! {
    /// With the other sign of `g`.
    OtherSign { kick: [1/6, 2/3], drift: [1/2], gradient: [0, -1/72], symmetric: true }
    /// Drifts at both ends.
    Middle { base: chin-chen-2002-4b }
    /// A gradient kick without a kick.
    Alone { kick: [1/2, 0, 1/2], drift: [1/2, 1/2, 0], gradient: [0, 1/48, 0] }
}

symplectic::composition! {
    Sixth { base: chin-1997-c, weights: triple_jump(6) }
}

symplectic::hamiltonian! {
    Pendulum { g: 9.81 }
    q: [a], p: [pa];
    H = pa^2/2 - g cos(a)
}

symplectic::hamiltonian! {
    /// A mass matrix that is not diagonal.
    Tilted { k, m: 3 }
    q: [x, y], p: [px, py];
    H = px^2/m + px py/4 + 2 py^2 + cos(x - 2 y) + k x^4/(1 + y^2)
}

symplectic::hamiltonian! {
    /// A frame that moves, in addition.
    Moving { v }
    q: [x, y], p: [px, py];
    H = px^2 + px py/4 + 2 py^2 + v px - py/5 + cos(x - 2 y) + x^4/(1 + y^2)
}

symplectic::hamiltonian! {
    /// Bodies in the plane with their masses.
    Bodies { m: [..] }
    q: [..; 2], p: [..; 2];
    H = sum(i: |p[i]|^2/(2 m[i])) - sum(i < j: m[i] m[j]/sqrt(|q[i] - q[j]|^2 + 0.1)) + sum(i: |q[i]|^4/4)
}

symplectic::hamiltonian! {
    /// Driven: the potential depends on time.
    Driven<N> { a: [N], links: pairs }
    q: [N], p: [N];
    H = sum(i: p[i]^2)/2 + sum(i: a[i] cos(q[i] - t)) + sum(i in 0..N - 1: exp(q[i + 1] - q[i])) + sum((i, j) in links: (q[i] q[j])^2)
}

symplectic::hamiltonian! {
    Ring
    q: [..], p: [..];
    bonds: ring;
    H = sum(i: p[i]^2)/2 + sum(bonds d: d^2/2 + d^4/4) + sum(i: q[i]^4/4)
}

symplectic::hamiltonian! {
    Walls
    q: [..], p: [..];
    bonds: walls;
    H = sum(i: p[i]^2)/2 + sum(bonds d: d^2/2 - d^3/3)
}

symplectic::hamiltonian! {
    Free
    q: [..], p: [..];
    bonds: free;
    H = sum(i: p[i]^2)/2 + sum(bonds d: exp(d) - d)
}

/// The force gradient beside the quotient of a difference of forces: `f(q + δw) − f(q − δw)` with `w = M⁻¹f`.
fn agrees<V: Vector<Scalar = f64>, S: System<V>>(system: &S, time: f64, q: &V, zero: &V) {
    const { assert!(S::FORCE_GRADIENT) }
    let [mut force, mut at_rest, mut speed, mut gradient] = [(); 4].map(|()| zero.clone());
    system.force(time, q, zero, &mut force);
    system.velocity(time, q, &force, &mut speed);
    system.velocity(time, q, zero, &mut at_rest);
    system.force_gradient(time, q, &force, &mut gradient);
    let size = force
        .as_slice()
        .iter()
        .fold(1.0_f64, |size, f| size.max(f.abs()));
    let delta = 1e-5 / size;
    let moved = |sign: f64| {
        let mut there = q.clone();
        let rates = speed.as_slice().iter().zip(at_rest.as_slice());
        for (x, (rate, rest)) in there.as_mut_slice().iter_mut().zip(rates) {
            *x += sign * delta * (rate - rest);
        }
        let mut force = zero.clone();
        system.force(time, &there, zero, &mut force);
        force
    };
    let (above, below) = (moved(1.0), moved(-1.0));
    let quotients = above.as_slice().iter().zip(below.as_slice());
    let quotients: Vec<f64> = quotients.map(|(a, b)| (a - b) / (2.0 * delta)).collect();
    let scale = quotients
        .iter()
        .fold(1e-3_f64, |scale, x| scale.max(x.abs()));
    assert!(scale > 0.01, "the test sees nothing");
    for (found, expected) in gradient.as_slice().iter().zip(&quotients) {
        assert!(
            (found - expected).abs() < 1e-6 * scale,
            "{:?} instead of {quotients:?}",
            gradient.as_slice()
        );
    }
}

fn scattered(n: usize) -> DVector<f64> {
    DVector::from_fn(n, |i, _| 0.4 * (1.7 * i as f64 + 0.3).sin())
}

#[test]
fn the_force_gradient_of_a_formula_is_the_derivative_of_its_force() {
    agrees(
        &Pendulum { g: 9.81 },
        0.0,
        &Vector1::new(0.7),
        &Vector1::zeros(),
    );
    let tilted = Tilted { k: 0.7, m: 3.0 };
    agrees(&tilted, 0.0, &SVector::from([0.3, -0.8]), &SVector::zeros());
    let moving = Moving { v: 3.0 };
    agrees(&moving, 0.0, &SVector::from([0.3, -0.8]), &SVector::zeros());
    let bodies = Bodies {
        m: vec![1.0, 0.3, 2.0, 0.7, 1.5],
    };
    agrees(&bodies, 0.0, &scattered(10), &DVector::zeros(10));
    let driven = Driven {
        a: [0.5, 1.0, -0.4, 2.0],
        links: vec![(0, 2), (3, 1)],
    };
    let q = SVector::from([0.1, 0.5, -0.7, 0.3]);
    agrees(&driven, 0.8, &q, &SVector::zeros());
}

#[test]
fn the_force_gradient_of_a_chain_is_the_derivative_of_its_force() {
    for n in [1, 2, 3, 8, 19] {
        agrees(&Walls, 0.0, &scattered(n), &DVector::zeros(n));
        if n > 1 {
            agrees(&Ring, 0.0, &scattered(n), &DVector::zeros(n));
            agrees(&Free, 0.0, &scattered(n), &DVector::zeros(n));
        }
    }
}

/// The slope of the error at the end against the step size, between two step sizes.
fn slope<M: Method + ProvedFor<Separable>>(method: M, step: f64) -> Result<f64, Error> {
    let start = || State::from_arrays(0.0, [0.3, -0.8], [0.4, 0.1]);
    let tilted = || Tilted { k: 0.7, m: 3.0 };
    let end = |step| -> Result<SVector<f64, 2>, Error> {
        let mut run = Integrator::new(method.clone(), tilted(), start(), step)?;
        Ok(run.integrate_to(2.0)?.q)
    };
    let exact = Integrator::new(Sixth, tilted(), start(), step / 32.0)?
        .integrate_to(2.0)?
        .q;
    let [coarse, fine] = [end(step)?, end(step / 2.0)?].map(|q| (q - exact).norm());
    Ok((coarse / fine).log2())
}

#[test]
fn steps_have_the_order_of_their_method() -> Result<(), Error> {
    for (found, order) in [
        (slope(Chin, 0.05)?, 4.0),
        (slope(OtherSign, 0.01)?, 2.0),
        (slope(ChinChen, 0.05)?, 4.0),
        (slope(Middle, 0.05)?, 4.0),
        (slope(Alone, 0.02)?, 2.0),
        (slope(Sixth, 0.1)?, 6.0),
    ] {
        assert!((found - order).abs() < 0.15, "{found} instead of {order}");
    }
    assert_eq!(
        (
            Chin::ORDERS.nystrom,
            Chin::ORDERS.separable,
            Chin::ORDERS.general
        ),
        (4, 0, 0)
    );
    assert_eq!(Chin::GRADIENT, [0.0, 1.0 / 72.0, 0.0]);
    Ok(())
}

/// `p += h (k f + 2 g h² f′ f)`, by hand for the pendulum.
#[test]
fn a_step_is_that_written_by_hand() -> Result<(), Error> {
    let (g, h): (f64, f64) = (9.81, 0.1);
    let [mut q, mut p] = [0.7_f64, -0.2];
    let mut run = Integrator::plain(Chin, Pendulum { g }, State::from_arrays(0.0, [q], [p]), h)?;
    for _ in 0..5 {
        let found = run.step()?;
        p -= h / 6.0 * g * q.sin();
        q += h / 2.0 * p;
        let force = -g * q.sin();
        p += h * (2.0 / 3.0 * force + h * h / 36.0 * (-g * q.cos() * force));
        q += h / 2.0 * p;
        p -= h / 6.0 * g * q.sin();
        assert!((found.q[0] - q).abs() < 1e-14 && (found.p[0] - p).abs() < 1e-13);
    }
    Ok(())
}

/// A step back undoes a step, for palindromes.
#[test]
fn steps_are_reversible() -> Result<(), Error> {
    let start = State::from_arrays(0.0, [0.3, -0.8], [0.4, 0.1]);
    let back = |method_step: f64, other: f64| -> Result<f64, Error> {
        let tilted = || Tilted { k: 0.7, m: 3.0 };
        let there = Integrator::new(Chin, tilted(), start.clone(), method_step)?
            .take_steps(20)?
            .clone();
        let here = Integrator::new(Chin, tilted(), there, other)?
            .take_steps(20)?
            .clone();
        Ok((here.q - start.q).norm() + (here.p - start.p).norm())
    };
    assert!(back(0.1, -0.1)? < 1e-13);
    assert!(back(0.1, -0.099)? > 1e-4);
    Ok(())
}

/// The first force and force gradient of a step are the last ones of the step before: fewer evaluations, the same bits as from a state.
#[test]
fn carried_evaluations_are_those_of_a_fresh_start() -> Result<(), Error> {
    fn check<M: Method + ProvedFor<Separable> + Copy>(
        method: M,
        per_step: u64,
    ) -> Result<(), Error> {
        let tilted = || Tilted { k: 0.7, m: 3.0 };
        let start = State::from_arrays(0.0, [0.3, -0.8], [0.4, 0.1]);
        let mut whole = Integrator::plain(method, tilted(), start.clone(), 0.1)?;
        let mut state = start;
        for _ in 0..10 {
            whole.step()?;
            state = Integrator::plain(method, tilted(), state, 0.1)?
                .step()?
                .clone();
            assert_eq!(whole.state().q, state.q);
            assert_eq!(whole.state().p, state.p);
        }
        let first = whole.statistics().evaluations;
        whole.take_steps(10)?;
        assert_eq!(whole.statistics().evaluations - first, 10 * per_step);
        Ok(())
    }
    // Forces, velocities and force gradients.
    check(Chin, 2 + 2 + 1)?;
    check(ChinChen, 3 + 3 + 1)?;
    check(Middle, 2 + 2 + 2)?;
    check(Alone, 2 + 2 + 1)
}

#[test]
fn a_restored_run_has_the_same_bits() -> Result<(), Box<dyn std::error::Error>> {
    let tilted = || Tilted { k: 0.7, m: 3.0 };
    let start = State::from_arrays(0.0, [0.3, -0.8], [0.4, 0.1]);
    let mut whole = Integrator::new(ChinChen, tilted(), start.clone(), 0.1)?;
    whole.take_steps(25)?;
    let checkpoint: Checkpoint = whole.checkpoint()?;
    whole.take_steps(25)?;
    let mut resumed = Integrator::new(ChinChen, tilted(), start, 0.1)?;
    resumed.restore(&checkpoint)?;
    resumed.take_steps(25)?;
    assert_eq!(resumed.state(), whole.state());
    assert_eq!(resumed.statistics(), whole.statistics());
    Ok(())
}

/// Positions and momenta in 1000 steps: the energy has no drift.
#[test]
fn the_energy_of_a_chain_is_kept() -> Result<(), Error> {
    let start = State::new(0.0, scattered(19), DVector::zeros(19));
    let mut run = Integrator::new(Chin, Ring, start, 0.1)?;
    let before = run.energy().expect("an energy");
    let mut largest = 0.0_f64;
    for _ in 0..1000 {
        run.step()?;
        largest = largest.max((run.energy().expect("an energy") / before - 1.0).abs());
    }
    assert!(largest < 2e-4, "{largest:e}");
    Ok(())
}

/// A kinetic energy that is not quadratic, of a system that claims a force gradient.
#[test]
fn a_kinetic_energy_that_is_not_quadratic_is_refused() {
    struct Relativistic;
    impl SeparableHamiltonian for Relativistic {
        type Vector<T: Scalar> = SVector<T, 1>;
        const FORCE_GRADIENT: bool = true;

        fn velocity<T: Scalar>(&self, _: T, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
            velocity[0] = p[0] / (p[0] * p[0] + T::one()).sqrt();
        }

        fn force<T: Scalar>(&self, _: T, q: &SVector<T, 1>, force: &mut SVector<T, 1>) {
            force[0] = -q[0];
        }

        fn force_gradient<T: Scalar>(
            &self,
            _: T,
            _: &SVector<T, 1>,
            force: &SVector<T, 1>,
            gradient: &mut SVector<T, 1>,
        ) {
            gradient[0] = -force[0];
        }
    }
    let start = State::from_arrays(0.0, [1.0], [0.5]);
    let refused = Integrator::new(Chin, Relativistic, start, 0.1).err();
    assert!(
        matches!(
            refused,
            Some(Error::NotQuadraticKinetic {
                order: 4,
                lower_order: 0,
                ..
            })
        ),
        "{refused:?}"
    );
}
