//! Newmark's method: its textbook recursion, its order, what it preserves, its stability.

use crate::methods::{Gauss4, StoermerVerlet};
use symplectic::nalgebra::{DVector, Matrix4, SVector, Vector1, Vector2};
use symplectic::stepper::StepMap;
use symplectic::variational::{Error, Newmark, generating_function};
use symplectic::{
    Error as CoreError, Hamiltonian, Integrator, Quantity, Scalar, Separable, State, System,
};

use super::forces::Driven;

symplectic::hamiltonian! {
    /// Two masses and a potential that is not convex.
    pub Well
    q: [x, y], p: [px, py];
    H = px^2/2 + py^2/6 + (x^2 + y^2)^2/4 - x y + x^2 y/3
}

symplectic::hamiltonian! {
    pub Oscillator { omega: 100 }
    q: [x], p: [px];
    H = px^2/2 + omega^2 x^2/2
}

symplectic::hamiltonian! {
    pub Relativistic
    q: [x], p: [px];
    H = sqrt(1 + px^2) + x^2/2
}

const BETAS: [f64; 5] = [-1.0 / 6.0, 0.0, 1.0 / 12.0, 1.0 / 6.0, 0.25];

fn near(a: f64, b: f64) -> State<Vector2<f64>> {
    State::from_arrays(
        0.0,
        [0.8 + a, 0.3 - 0.4 * b],
        [0.2 + 0.5 * a - 0.6 * b, 0.7 + b],
    )
}

fn run(
    beta: f64,
    start: &State<Vector2<f64>>,
    h: f64,
) -> Result<Integrator<StoermerVerlet, Newmark<Well>, Vector2<f64>>, Error> {
    let newmark = Newmark::new(Well, beta, h)?;
    let start = newmark.shift(start)?;
    Ok(Integrator::new(StoermerVerlet, newmark, start, h)?)
}

fn distance(a: &State<Vector2<f64>>, b: &State<Vector2<f64>>) -> f64 {
    (a.q - b.q).amax().max((a.p - b.p).amax())
}

/// One step of (2.6.3) with γ = 1/2, in (q, v), as it is printed; the position at its end by 200 fixed-point iterations.
fn textbook(beta: f64, h: f64, state: &mut State<Vector2<f64>>) {
    let masses = Vector2::new(1.0, 3.0);
    let acceleration = |q: &Vector2<f64>| {
        let (x, y) = (q[0], q[1]);
        let square = x * x + y * y;
        let gradient = Vector2::new(
            square * x - y + 2.0 * x * y / 3.0,
            square * y - x + x * x / 3.0,
        );
        -gradient.component_div(&masses)
    };
    let (q, v) = (state.q, state.p.component_div(&masses));
    let before = acceleration(&q);
    let mut after = before;
    for _ in 0..200 {
        let weighted = before * (1.0 - 2.0 * beta) + after * (2.0 * beta);
        state.q = q + v * h + weighted * (h * h / 2.0);
        after = acceleration(&state.q);
    }
    state.p = (v + (before + after) * (h / 2.0)).component_mul(&masses);
}

#[test]
fn steps_are_those_of_the_textbook() -> Result<(), Error> {
    for beta in [-1.0 / 6.0, 0.0, 1.0 / 12.0, 1.0 / 6.0, 0.25, 0.5] {
        let mut expected = near(0.0, 0.0);
        let mut found = run(beta, &expected, 0.2)?;
        for _ in 0..50 {
            textbook(beta, 0.2, &mut expected);
            let state = found.step()?.clone();
            let state = found.system().unshift(&state)?;
            let error = distance(&state, &expected);
            assert!(error < 1e-12, "{beta}: {error:e}");
        }
        // Another β is another method.
        let mut other = run(beta + 0.01, &near(0.0, 0.0), 0.2)?;
        let end = other.take_steps(50)?.clone();
        assert!(distance(&other.system().unshift(&end)?, &expected) > 1e-4);
    }
    Ok(())
}

#[test]
fn newmark_with_beta_zero_is_verlet() -> Result<(), Error> {
    let mut newmark = run(0.0, &near(0.0, 0.0), 0.1)?;
    let mut verlet = Integrator::new(StoermerVerlet, Well, near(0.0, 0.0), 0.1)?;
    let end = newmark.take_steps(1000)?;
    assert!(distance(end, verlet.take_steps(1000)?) < 1e-12);
    Ok(())
}

#[test]
fn newmark_has_order_two_for_every_beta() -> Result<(), Error> {
    let mut reference = Integrator::new(Gauss4, Well, near(0.0, 0.0), 0.01)?;
    let reference = reference.integrate_to(2.0)?.clone();
    for beta in BETAS {
        let error = |steps: u32| -> Result<f64, Error> {
            let mut run = run(beta, &near(0.0, 0.0), 2.0 / f64::from(steps))?;
            let end = run.integrate_to(2.0)?.clone();
            Ok(distance(&run.system().unshift(&end)?, &reference))
        };
        let slope = (error(160)? / error(320)?).log2();
        assert!((slope - 2.0).abs() < 0.05, "{beta}: {slope}");
    }
    Ok(())
}

/// How far the map of a step is from symplectic: `JᵀΩJ − Ω` by differences.
fn defect(
    map: impl Fn(&State<Vector2<f64>>) -> Result<State<Vector2<f64>>, Error>,
) -> Result<f64, Error> {
    const STEP: f64 = 1e-3;
    let mut jacobian = Matrix4::zeros();
    for k in 0..4 {
        for (place, weight) in [(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)] {
            let mut state = near(0.0, 0.0);
            let part = if k < 2 { &mut state.q } else { &mut state.p };
            part[k % 2] += place * STEP;
            let end = map(&state)?;
            let end = SVector::from([end.q[0], end.q[1], end.p[0], end.p[1]]);
            let mut column = jacobian.column_mut(k);
            column += end * (weight / (12.0 * STEP));
        }
    }
    let mut omega = Matrix4::zeros();
    for k in 0..2 {
        omega[(k, k + 2)] = 1.0;
        omega[(k + 2, k)] = -1.0;
    }
    Ok((jacobian.transpose() * omega * jacobian - omega).amax())
}

#[test]
fn the_shifted_form_is_preserved() -> Result<(), Error> {
    let shifts = [-1.0 / 6.0, 1.0 / 12.0, 0.25].map(|beta| (beta, true));
    for (beta, changes) in [(0.0, false)].into_iter().chain(shifts) {
        let newmark = Newmark::new(Well, beta, 0.2)?;
        let step = |state: &State<Vector2<f64>>| {
            let mut run = Integrator::new(StoermerVerlet, newmark.clone(), state.clone(), 0.2)?;
            Ok(run.step()?.clone())
        };
        let shifted = defect(step)?;
        assert!(shifted < 1e-10, "{beta}: {shifted:e}");
        let unshifted = defect(|state| newmark.unshift(&step(&newmark.shift(state)?)?))?;
        assert_eq!(unshifted > 1e-4, changes, "{beta}: {unshifted:e}");
        let run = run(beta, &near(0.0, 0.0), 0.2)?;
        let start = |a, b| newmark.shift(&near(a, b)).expect("a state");
        assert!(run.symplecticity_defect(start)? < 1e-9);
    }
    Ok(())
}

/// H of the shifted system: its derivatives are the velocity and the force, so steps have a generating function.
#[test]
fn the_shifted_system_is_hamiltonian() -> Result<(), Error> {
    let newmark = Newmark::new(Well, 0.25, 0.5)?;
    let State { q, p, .. } = near(0.0, 0.0);
    let energy = |q: &Vector2<f64>| newmark.energy(0.0, q, &p).expect("known");
    let mut force = q;
    newmark.force(0.0, &q, &p, &mut force);
    for k in 0..2 {
        let at = |by: f64| {
            let mut q = q;
            q[k] += by;
            energy(&q)
        };
        let slope = (8.0 * (at(1e-3) - at(-1e-3)) - (at(2e-3) - at(-2e-3))) / 12e-3;
        assert!((slope + force[k]).abs() < 1e-10, "{slope} {}", force[k]);
    }
    let generating = generating_function(StoermerVerlet, &newmark, 0.0, &q, &p, 0.5)?;
    let mut step = Integrator::new(
        StoermerVerlet,
        newmark,
        State::new(0.0, q, generating.p0),
        0.5,
    )?;
    assert!((step.step()?.q - generating.q1).norm() < 1e-14);
    // Its error is that of Verlet: it does not grow, and with half of the step it is a quarter.
    let errors = |h: f64, steps: u32| -> Result<[f64; 2], Error> {
        let mut run = run(0.25, &near(0.0, 0.0), h)?;
        let before = run.energy().expect("known");
        let mut largest = [0.0_f64; 2];
        for step in 0..steps {
            run.step()?;
            let half = &mut largest[usize::from(step >= steps / 2)];
            *half = half.max((run.energy().expect("known") - before).abs());
        }
        Ok(largest)
    };
    let [early, late] = errors(0.1, 20_000)?;
    assert!(late < 1.1 * early, "{early:e} {late:e}");
    let [_, fine] = errors(0.05, 40_000)?;
    assert!((3.5..4.5).contains(&(late / fine)), "{late:e} {fine:e}");
    Ok(())
}

/// hω = 100: with β = 1/4 the energy of a linear oscillator is conserved at every step size, and Verlet is not stable.
#[test]
fn average_acceleration_is_stable() -> Result<(), Error> {
    let start: State<Vector1<f64>> = State::from_arrays(0.0, [1.0], [2.0]);
    let energy = |state: &State<Vector1<f64>>| {
        Hamiltonian::energy(&Oscillator::new(), 0.0, &state.q, &state.p)
    };
    let newmark = Newmark::new(Oscillator::new(), 0.25, 1.0)?;
    let mut run = Integrator::new(StoermerVerlet, newmark.clone(), newmark.shift(&start)?, 1.0)?;
    let before = energy(&start).expect("known");
    for _ in 0..1000 {
        let state = newmark.unshift(run.step()?)?;
        let error = (energy(&state).expect("known") / before - 1.0).abs();
        assert!(error < 1e-11, "{error:e}");
    }
    // cos φ = 1 − Ω²/(2 (1 + Ω²/4)), and q stands for Re e^{ikφ} with this start at rest.
    let rest = newmark.shift(&State::from_arrays(0.0, [1.0], [0.0]))?;
    run.set_state(rest)?;
    let angle = (1.0_f64 - 1e4 / (2.0 * (1.0 + 1e4 / 4.0))).acos();
    for k in 1..=20 {
        let state = newmark.unshift(run.step()?)?;
        assert!((state.q[0] - (f64::from(k) * angle).cos()).abs() < 1e-11);
    }
    let mut verlet = Integrator::new(StoermerVerlet, Oscillator::new(), start.clone(), 1.0)?;
    assert!(matches!(
        verlet.take_steps(1000),
        Err(CoreError::NonFinite { .. })
    ));
    // (hω)² < 4/(1 − 4β): stable below hω = 2√3 and √2.4, and not above.
    let limits = [(1.0 / 6.0, 0.034_64), (-1.0 / 6.0, 0.015_49)];
    for (beta, h, stable) in limits.into_iter().flat_map(|(beta, limit)| {
        [(limit - 1e-5, true), (limit + 1e-4, false)].map(|(h, stable)| (beta, h, stable))
    }) {
        let newmark = Newmark::new(Oscillator::new(), beta, h)?;
        let mut run = Integrator::new(StoermerVerlet, newmark.clone(), newmark.shift(&start)?, h)?;
        let end = newmark.unshift(run.take_steps(500)?)?;
        assert_eq!(end.q[0].abs() < 100.0, stable, "{h}: {}", end.q[0]);
    }
    Ok(())
}

/// With a force of the time: closed form, order 2, and vectors on the heap.
#[test]
fn newmark_has_order_two_with_a_force_of_time() -> Result<(), Error> {
    #[derive(Clone, Copy)]
    struct OnTheHeap;
    impl Hamiltonian for OnTheHeap {
        type Class = Separable;
        type Vector<T: Scalar> = DVector<T>;

        fn velocity<T: Scalar>(
            &self,
            _: T,
            _: &DVector<T>,
            p: &DVector<T>,
            velocity: &mut DVector<T>,
        ) {
            velocity.copy_from(p);
        }

        fn force<T: Scalar>(
            &self,
            time: T,
            q: &DVector<T>,
            _: &DVector<T>,
            force: &mut DVector<T>,
        ) {
            force.zip_apply(q, |force, q| *force = (time * T::from_f64(0.5)).cos() - q);
        }
    }
    let error = |steps: u32| -> Result<f64, Error> {
        let h = 5.0 / f64::from(steps);
        let newmark = Newmark::new(Driven::new(), 0.25, h)?;
        let rest = State::from_arrays(0.0, [0.0], [0.0]);
        let mut run = Integrator::new(StoermerVerlet, newmark.clone(), newmark.shift(&rest)?, h)?;
        let end = newmark.unshift(run.integrate_to(5.0)?)?;
        assert_eq!(run.energy(), None);

        let heap = Newmark::new(OnTheHeap, 0.25, h)?;
        let rest = heap.shift(&State::from_slices(0.0, &[0.0; 3], &[0.0; 3])?)?;
        let mut run = Integrator::new(StoermerVerlet, heap.clone(), rest, h)?;
        let other = heap.unshift(run.integrate_to(5.0)?)?;
        assert!(other.q.iter().all(|q| (q - end.q[0]).abs() < 1e-13));
        // x = (cos ωt − cos t)/(1 − ω²)
        Ok((end.q[0] - (2.5_f64.cos() - 5.0_f64.cos()) / 0.75).abs())
    };
    let slope = (error(100)? / error(200)?).log2();
    assert!((slope - 2.0).abs() < 0.05, "{slope}");
    Ok(())
}

#[test]
fn newmark_refuses_bad_beta_step_sizes_and_masses() -> Result<(), Error> {
    for value in [f64::NEG_INFINITY, f64::INFINITY] {
        let outcome = Newmark::new(Well, value, 0.1);
        assert_eq!(outcome.err(), Some(Error::NewmarkBeta { value }));
    }
    assert!(matches!(
        Newmark::new(Well, f64::NAN, 0.1),
        Err(Error::NewmarkBeta { .. })
    ));
    assert!(matches!(
        Newmark::new(Well, 0.1, 0.0),
        Err(Error::Core(CoreError::StepSize { .. }))
    ));
    let fast = Newmark::new(Relativistic, 0.25, 0.1)?.shift(&State::from_arrays(0.0, [0.0], [1.0]));
    assert!(matches!(
        fast,
        Err(Error::NewmarkMasses { component: 0, .. })
    ));
    symplectic::hamiltonian! { Cap q: [x], p: [px]; H = px^2/2 + x^3/3 }
    let newmark = Newmark::new(Cap, 0.25, 2.0)?;
    // x = q + q²: no q for x < −1/4.
    let state = State::from_arrays(1.0, [-1.0], [0.0]);
    assert!(matches!(
        newmark.unshift(&state),
        Err(Error::NewmarkPosition { time: 1.0, .. })
    ));
    let mut run = Integrator::new(StoermerVerlet, newmark, state, 2.0)?;
    assert!(matches!(
        run.step(),
        Err(CoreError::NonFinite {
            what: Quantity::Force,
            ..
        })
    ));
    Ok(())
}

/// The force overflows, its derivative does not.
#[test]
fn newmark_refuses_a_force_that_overflows() -> Result<(), Error> {
    symplectic::hamiltonian! { Quartic q: [x], p: [px]; H = px^2/2 + x^4/4 }
    let newmark = Newmark::new(Quartic, 0.25, 0.1)?;
    let far = State::from_arrays(0.0, [1e110], [0.0]);
    let what = Quantity::Force;
    assert_eq!(
        newmark.shift(&far),
        Err(Error::Core(CoreError::NonFiniteState { what }))
    );
    assert!(matches!(
        newmark.unshift(&far),
        Err(Error::NewmarkPosition { .. })
    ));
    Ok(())
}
