//! Potentials with steps of their own.

use std::cell::Cell;

use symplectic::flow::{Asynchronous, Elements, Error, FlowError, FlowSteps, Substeps};
use symplectic::nalgebra::{SMatrix, SVector};
use symplectic::{Quantity, Separable, State, System, separable};

use crate::common::methods::{Gauss5, StoermerVerlet};
use crate::common::{distance, run};

const N: usize = 8;

type V = SVector<f64, N>;

/// The bonds of a chain with free ends: two soft ones, then one that is stiff, and so on. Neighbours have different masses.
struct Chain {
    ends: Vec<[usize; 2]>,
    /// The longest steps of soft and of stiff bonds.
    longest: [f64; 2],
    evaluations: Vec<Cell<u64>>,
    /// Where forces end to be finite.
    breaks_at: f64,
}

fn is_stiff(bond: usize) -> bool {
    bond % 3 == 2
}

fn tension(bond: usize, stretch: f64) -> f64 {
    match is_stiff(bond) {
        true => 16.0 * stretch,
        false => stretch + 0.5 * stretch.powi(3),
    }
}

fn energy(bond: usize, stretch: f64) -> f64 {
    match is_stiff(bond) {
        true => 8.0 * stretch.powi(2),
        false => 0.5 * stretch.powi(2) + 0.125 * stretch.powi(4),
    }
}

fn inverse_mass(component: usize) -> f64 {
    [1.0, 0.5][component % 2]
}

impl Chain {
    fn new(longest: [f64; 2]) -> Self {
        Self {
            ends: (1..N).map(|right| [right - 1, right]).collect(),
            longest,
            evaluations: vec![Cell::new(0); N - 1],
            breaks_at: f64::INFINITY,
        }
    }
}

impl Elements for Chain {
    fn count(&self) -> usize {
        self.ends.len()
    }

    fn components(&self, bond: usize) -> &[usize] {
        &self.ends[bond]
    }

    fn force(&self, bond: usize, time: f64, q: &[f64], force: &mut [f64]) {
        let count = &self.evaluations[bond];
        count.set(count.get() + 1);
        let broken = if time > self.breaks_at { f64::NAN } else { 1.0 };
        let tension = broken * tension(bond, q[1] - q[0]);
        force.copy_from_slice(&[tension, -tension]);
    }

    fn step_size(&self, bond: usize) -> f64 {
        self.longest[usize::from(is_stiff(bond))]
    }

    fn inverse_mass(&self, component: usize) -> f64 {
        inverse_mass(component)
    }
}

/// The same chain, by one force.
fn whole() -> impl System<V, Class = Separable> + Clone {
    separable::<V, _, _>(
        |_, p: &V, velocity: &mut V| *velocity = V::from_fn(|i, _| inverse_mass(i) * p[i]),
        |_, q: &V, force: &mut V| {
            *force = V::zeros();
            for bond in 0..N - 1 {
                let tension = tension(bond, q[bond + 1] - q[bond]);
                force[bond] += tension;
                force[bond + 1] -= tension;
            }
        },
    )
}

fn energy_of(state: &State<V>) -> f64 {
    let kinetic: f64 = (0..N)
        .map(|i| inverse_mass(i) * state.p[i].powi(2) / 2.0)
        .sum();
    let bonds = (0..N - 1).map(|bond| energy(bond, state.q[bond + 1] - state.q[bond]));
    kinetic + bonds.sum::<f64>()
}

fn start() -> State<V> {
    let q = V::from_fn(|i, _| 0.3 * (0.9 * (i as f64)).sin());
    let p = V::from_fn(|i, _| 0.4 * (1.7 * (i as f64)).cos());
    State::new(0.0, q, p)
}

/// The state at `end` by steps of size `h`.
fn by_elements(longest: [f64; 2], h: f64, end: f64) -> Result<State<V>, Error> {
    let step = Asynchronous::new(Chain::new(longest), N)?;
    let mut run = FlowSteps::run(step, start(), h)?;
    run.integrate_to(end)?;
    Ok(run.into_state())
}

#[test]
fn the_order_is_two() -> Result<(), Error> {
    let end = 4.0;
    let exact = run(Gauss5, whole(), start(), end, 400)?;
    // One step of soft bonds to four, to three and to nine of two by seven.
    for parts in [[1.0, 4.0], [1.0, 3.0], [2.0, 7.0]] {
        let error = |h: f64| -> Result<f64, Error> {
            let longest = parts.map(|part| h / part);
            Ok(distance(&by_elements(longest, h, end)?, &exact))
        };
        let slope = (error(0.02)? / error(0.01)?).log2();
        assert!((slope - 2.0).abs() < 0.05, "{parts:?}: {slope}");
    }
    Ok(())
}

#[test]
fn asynchronous_steps_of_equal_size_are_velocity_verlet() -> Result<(), Error> {
    let verlet = run(StoermerVerlet, whole(), start(), 10.0, 200)?;
    let found = by_elements([1.0; 2], 0.05, 10.0)?;
    assert!(distance(&found, &verlet) < 1e-12);
    // And with other steps it is not.
    let other = by_elements([1.0, 0.02], 0.05, 10.0)?;
    assert!(distance(&other, &verlet) > 1e-4);
    Ok(())
}

/// Over 1200 units of time, a step of a soft bond being 3.7 of a stiff one: the error of the energy stays what it was.
#[test]
fn momentum_is_conserved_and_energy_bounded() -> Result<(), Error> {
    let step = Asynchronous::new(Chain::new([0.1, 0.1 / 3.7]), N)?;
    let mut run = FlowSteps::run(step, start(), 0.2)?;
    let (before, momentum) = (energy_of(&start()), start().p.sum());
    let mut worst = [0.0_f64; 2];
    let mut drift = 0.0_f64;
    for worst in &mut worst {
        for _ in 0..3000 {
            let state = run.step()?;
            *worst = worst.max((energy_of(state) - before).abs());
            drift = drift.max((state.p.sum() - momentum).abs());
        }
    }
    assert!(drift < 2e-13, "{drift:e}");
    assert!(worst[0] < 0.01 * before, "{worst:?} of {before}");
    assert!(worst[1] < 1.1 * worst[0], "{worst:?}");
    Ok(())
}

#[test]
fn asynchronous_steps_are_reversible() -> Result<(), Error> {
    let step = Asynchronous::new(Chain::new([0.07, 0.03]), N)?;
    let mut run = FlowSteps::run(step, start(), 0.2)?;
    run.integrate_to(20.0)?;
    assert!(distance(run.state(), &start()) > 0.1);
    run.integrate_to(0.0)?;
    assert!(distance(run.state(), &start()) < 1e-11);
    Ok(())
}

#[test]
fn a_step_is_symplectic() -> Result<(), Error> {
    let step = |z: &SVector<f64, { 2 * N }>| -> Result<SVector<f64, { 2 * N }>, Error> {
        let step = Asynchronous::new(Chain::new([0.3, 0.11]), N)?;
        let half = |first: usize| V::from_fn(|i, _| z[first + i]);
        let mut run = FlowSteps::run(step, State::new(0.0, half(0), half(N)), 0.6)?;
        let end = run.step()?;
        Ok(SVector::from_fn(|i, _| {
            if i < N { end.q[i] } else { end.p[i - N] }
        }))
    };
    let start = start();
    let z = SVector::from_fn(|i, _| if i < N { start.q[i] } else { start.p[i - N] });
    let mut jacobian = SMatrix::<f64, { 2 * N }, { 2 * N }>::zeros();
    let small = 1e-4;
    for j in 0..2 * N {
        let at = |side: f64| {
            let mut moved = z;
            moved[j] += side * small;
            step(&moved)
        };
        jacobian.set_column(j, &((at(1.0)? - at(-1.0)?) / (2.0 * small)));
    }
    let omega = SMatrix::<f64, { 2 * N }, { 2 * N }>::from_fn(|i, j| {
        f64::from(i + N == j) - f64::from(j + N == i)
    });
    let defect = jacobian.transpose() * omega * jacobian - omega;
    assert!(defect.amax() < 1e-7, "{:e}", defect.amax());
    Ok(())
}

/// In steps that follow one another, each element has one evaluation for each of its steps, and one to begin with.
#[test]
fn an_element_is_evaluated_once_in_each_of_its_steps() -> Result<(), Error> {
    let (steps, end) = (50, 5.0);
    let step = Asynchronous::new(Chain::new([0.1, 0.025]), N)?;
    let mut run = FlowSteps::run(Substeps::new(step, steps)?, start(), end)?;
    run.integrate_to(end)?;
    for (bond, found) in run
        .stepper()
        .flow()
        .step
        .elements()
        .evaluations
        .iter()
        .enumerate()
    {
        let in_each = if is_stiff(bond) { 4 } else { 1 };
        assert_eq!(found.get(), u64::from(steps) * in_each + 1, "bond {bond}");
    }
    let single = by_elements([0.1, 0.025], 0.1, end)?;
    assert!(distance(run.state(), &single) < 1e-12);
    Ok(())
}

#[test]
fn a_step_that_fails_changes_nothing() -> Result<(), Error> {
    let mut chain = Chain::new([0.1, 0.03]);
    chain.breaks_at = 0.45;
    let mut run = FlowSteps::run(Asynchronous::new(chain, N)?, start(), 0.1)?;
    run.integrate_to(0.4)?;
    let before = run.state().clone();
    let error = run.step().err();
    let is_that = |error: &Error| {
        matches!(
            error,
            Error::Core(symplectic::Error::NonFinite {
                what: Quantity::Force,
                ..
            })
        )
    };
    assert!(error.as_ref().is_some_and(is_that), "{error:?}");
    assert_eq!(run.state(), &before);
    Ok(())
}

#[test]
fn bad_elements_are_refused() -> Result<(), Error> {
    let refused = |change: fn(&mut Chain), dimension: usize, what: &str| {
        let mut chain = Chain::new([0.1, 0.03]);
        change(&mut chain);
        let error = Asynchronous::new(chain, dimension).err();
        assert!(
            error
                .as_ref()
                .is_some_and(|error| error.to_string().contains(what)),
            "{error:?}"
        );
    };
    refused(|chain| chain.longest[1] = 0.0, N, "step size of an element");
    refused(
        |chain| chain.longest[0] = f64::NAN,
        N,
        "step size of an element",
    );
    refused(|chain| chain.ends[2] = [3, 8], N, "component of an element");
    refused(|chain| chain.ends[2] = [3, 3], N, "component of an element");
    refused(|_| (), N - 1, "component of an element");
    // More steps than can be, and a state with other components.
    let fine = Asynchronous::new(Chain::new([0.1, 1e-12]), N)?;
    let mut run = FlowSteps::run(fine, start(), 0.2)?;
    assert!(run.step().is_err());
    let larger = Asynchronous::new(Chain::new([0.1; 2]), N + 1)?;
    let mut run = FlowSteps::run(larger, start(), 0.2)?;
    assert!(matches!(
        run.step(),
        Err(Error::Flow {
            failure: FlowError::Dimension {
                expected: 9,
                found: 8
            },
            ..
        })
    ));
    Ok(())
}
