//! Forces component by component: second-order stages along a chain.

use std::cell::Cell;

use crate::common::methods::{Gauss2, Gauss3, Gauss5, Gauss7, Gauss8, Gauss10, Lobatto3};
use symplectic::emitted::{Bonds, Chain};
use symplectic::nalgebra::DVector;
use symplectic::solver::Automatic;
use symplectic::system::{Components, OverEveryScalar, StageRows};
use symplectic::{
    Compensated, Error, Integrator, Method, Plain, Scalar, Separable, State, Statistics, Summation,
    System, Vector,
};

/// `V(d) = (1 + t/100) d²/2 + d⁴/4`, a driven pendulum on every particle, and no number for bonds that are stretched by more than so much.
#[derive(Clone, Copy, Debug)]
struct Breaking {
    at: f64,
}

impl Bonds for Breaking {
    fn tension<T: Scalar>(&self, time: T, stretch: T) -> T {
        let square = stretch * stretch;
        let breaks = (T::from_f64(self.at * self.at) - square).sqrt();
        let growing = T::from_f64(0.01).fused(time, T::one());
        square.fused(stretch, growing * stretch) + breaks * T::zero()
    }

    fn outer_force<T: Scalar>(&self, time: T, position: T) -> Option<T> {
        Some(time * T::from_f64(0.01) - position.sin())
    }
}

/// What its force does not show: that it is local, or how it is.
struct Global<S>(S);

impl<V: Vector, B: Bonds> OverEveryScalar<V> for Global<Chain<B>> {
    type Doubles = V::With<f64>;
}

impl<V: Vector, B: Bonds> System<V> for Global<Chain<B>> {
    type Class = Separable;
    type Solver = Automatic;

    const UNIT_MASSES: bool = true;

    fn velocity(&self, time: V::Scalar, q: &V, p: &V, velocity: &mut V) {
        self.0.velocity(time, q, p, velocity);
    }

    fn force(&self, time: V::Scalar, q: &V, p: &V, force: &mut V) {
        self.0.force(time, q, p, force);
    }
}

/// What makes its force component by component, and not in rows.
struct ByComponents<S>(S);

impl<V: Vector, B: Bonds> OverEveryScalar<V> for ByComponents<Chain<B>> {
    type Doubles = V::With<f64>;
}

impl<V: Vector, B: Bonds> System<V> for ByComponents<Chain<B>> {
    type Class = Separable;
    type Solver = Automatic;

    const UNIT_MASSES: bool = true;
    const LOCAL_FORCE: bool = true;

    fn velocity(&self, time: V::Scalar, q: &V, p: &V, velocity: &mut V) {
        self.0.velocity(time, q, p, velocity);
    }

    fn force(&self, time: V::Scalar, q: &V, p: &V, force: &mut V) {
        self.0.force(time, q, p, force);
    }

    fn local_force(&self, time: V::Scalar, components: &mut impl Components<V::Scalar>) {
        System::<V>::local_force(&self.0, time, components);
    }
}

/// Makes its force in rows, `made` times.
struct InRows<'a, S> {
    system: S,
    made: &'a Cell<u64>,
}

impl<V: Vector, B: Bonds> OverEveryScalar<V> for InRows<'_, Chain<B>> {
    type Doubles = V::With<f64>;
}

impl<V: Vector, B: Bonds> System<V> for InRows<'_, Chain<B>> {
    type Class = Separable;
    type Solver = Automatic;

    const UNIT_MASSES: bool = true;
    const LOCAL_FORCE: bool = true;
    const ROW_FORCES: bool = true;

    fn velocity(&self, time: V::Scalar, q: &V, p: &V, velocity: &mut V) {
        self.system.velocity(time, q, p, velocity);
    }

    fn force(&self, time: V::Scalar, q: &V, p: &V, force: &mut V) {
        self.system.force(time, q, p, force);
    }

    fn local_force(&self, time: V::Scalar, components: &mut impl Components<V::Scalar>) {
        System::<V>::local_force(&self.system, time, components);
    }

    fn row_forces(&self, rows: &mut impl StageRows) {
        self.made.set(self.made.get() + 1);
        System::<V>::row_forces(&self.system, rows);
    }
}

/// Counts evaluations of the force, and those component by component.
struct Counted<'a, S> {
    system: S,
    forces: &'a Cell<u64>,
    local_forces: &'a Cell<u64>,
}

impl<V: Vector, B: Bonds> OverEveryScalar<V> for Counted<'_, Chain<B>> {
    type Doubles = V::With<f64>;
}

impl<V: Vector, B: Bonds> System<V> for Counted<'_, Chain<B>> {
    type Class = Separable;
    type Solver = Automatic;

    const UNIT_MASSES: bool = true;
    const LOCAL_FORCE: bool = true;

    fn velocity(&self, time: V::Scalar, q: &V, p: &V, velocity: &mut V) {
        self.system.velocity(time, q, p, velocity);
    }

    fn force(&self, time: V::Scalar, q: &V, p: &V, force: &mut V) {
        self.forces.set(self.forces.get() + 1);
        self.system.force(time, q, p, force);
    }

    fn local_force(&self, time: V::Scalar, components: &mut impl Components<V::Scalar>) {
        self.local_forces.set(self.local_forces.get() + 1);
        System::<V>::local_force(&self.system, time, components);
    }
}

fn chains(bonds: Breaking) -> [Chain<Breaking>; 3] {
    [
        Chain::between_walls(bonds),
        Chain::with_free_ends(bonds),
        Chain::ring(bonds),
    ]
}

fn start(n: usize) -> State<DVector<f64>> {
    let waves = |phase: f64| DVector::from_fn(n, |i, _| 0.3 * (phase + 1.7 * i as f64).sin());
    State::new(0.5, waves(0.2), waves(1.1))
}

const STEP_SIZE: f64 = 0.2;

/// The state after 25 steps, and what they took.
fn run<M: Method, S, R: Summation>(
    method: M,
    system: S,
    n: usize,
    step_size: f64,
    set: impl Fn(&mut Integrator<M, S, DVector<f64>, R>) -> Result<(), Error>,
) -> Result<(State<DVector<f64>>, Statistics), Error>
where
    S: System<DVector<f64>, Class = Separable>,
{
    let mut integrator = Integrator::with_summation(method, system, start(n), step_size)?;
    set(&mut integrator)?;
    let end = integrator.take_steps(25)?.clone();
    Ok((end, *integrator.statistics()))
}

/// How far apart two states are, in any component.
fn distance(a: &State<DVector<f64>>, b: &State<DVector<f64>>) -> f64 {
    (&a.q - &b.q).amax().max((&a.p - &b.p).amax())
}

/// Compares the steps of a method by the force and by the local force.
macro_rules! compare {
    ($($method:ident),+; $step_size:expr, $set:expr) => {$(
        for n in [1, 2, 3, 24] {
            for chain in chains(Breaking { at: 1e3 }) {
                let (local, made) = run($method, chain, n, $step_size, $set)?;
                let (global, expected) = run($method, Global(chain), n, $step_size, $set)?;
                let distance = distance(&local, &global);
                assert!(distance <= 2e-13, "{} {n} {chain:?}: {distance:e}", stringify!($method));
                let ratio = made.evaluations as f64 / expected.evaluations as f64;
                // To the last bit one evaluation more: that forces stand still shows an evaluation after positions do.
                assert!((0.95..=1.35).contains(&ratio), "{} {n} {chain:?}: {ratio}", stringify!($method));
            }
        }
    )+};
}

#[test]
fn stages_along_the_components_are_those_of_the_force() -> Result<(), Error> {
    fn plain<M: Method, S>(made: &mut Integrator<M, S, DVector<f64>, Plain>) -> Result<(), Error>
    where
        S: System<DVector<f64>, Class = Separable>,
    {
        made.set_tolerance(1e-14)
    }
    fn to_rounding<M, S, V, R>(_made: &mut Integrator<M, S, V, R>) -> Result<(), Error>
    where
        M: Method,
        V: Vector,
        S: System<V>,
        R: Summation,
    {
        Ok(())
    }
    // Ten stages are too many to go along the components.
    for step_size in [-STEP_SIZE, 3.0 * STEP_SIZE] {
        compare!(Gauss2, Gauss3, Gauss8, Gauss10, Lobatto3; step_size, plain);
        compare!(Gauss2, Gauss3, Gauss8, Gauss10, Lobatto3; step_size, to_rounding::<_, _, _, Plain>);
        compare!(Gauss2, Gauss3, Gauss8, Gauss10, Lobatto3; step_size, to_rounding::<_, _, _, Compensated>);
    }
    Ok(())
}

/// Compares the steps of a method in rows and component by component, to the last bit.
macro_rules! compare_rows {
    ($($method:ident),+; $step_size:expr, $set:expr) => {$(
        for n in [8, 24] {
            for chain in chains(Breaking { at: 1e3 }) {
                let rows = run($method, chain, n, $step_size, $set)?;
                let components = run($method, ByComponents(chain), n, $step_size, $set)?;
                assert_eq!(rows, components, "{} {n} {chain:?}", stringify!($method));
            }
        }
    )+};
}

#[test]
fn rows_have_the_bits_of_single_components() -> Result<(), Error> {
    // The last ones do not settle in their first sweeps.
    for step_size in [-STEP_SIZE, 3.0 * STEP_SIZE] {
        compare_rows!(Gauss2, Gauss3, Gauss5, Gauss7, Lobatto3; step_size, |made: &mut Integrator<_, _, _, Plain>| made.set_tolerance(1e-14));
        compare_rows!(Gauss2, Gauss3, Gauss5, Gauss7, Lobatto3; step_size, |_: &mut Integrator<_, _, _, Plain>| Ok(()));
        compare_rows!(Gauss2, Gauss3, Gauss5, Gauss7, Lobatto3; step_size, |_: &mut Integrator<_, _, _, Compensated>| Ok(()));
    }
    Ok(())
}

#[test]
fn rows_are_made_where_components_fill_them() -> Result<(), Error> {
    fn rows<M: Method>(method: M, n: usize) -> Result<u64, Error> {
        let made = &Cell::new(0);
        let system = InRows {
            system: Chain::ring(Breaking { at: 1e3 }),
            made,
        };
        run(
            method,
            system,
            n,
            STEP_SIZE,
            |_: &mut Integrator<_, _, _, Plain>| Ok(()),
        )?;
        Ok(made.get())
    }
    for (made, expected) in [
        (rows(Gauss2, 16)?, true),
        (rows(Lobatto3, 8)?, true),
        (rows(Gauss7, 40)?, true),
        (rows(Gauss2, 17)?, false),
        // Eight stages fill the lanes.
        (rows(Gauss8, 16)?, false),
    ] {
        assert_eq!(made > 25, expected, "{made}");
    }
    Ok(())
}

#[test]
fn steps_may_change_and_have_states_inside() -> Result<(), Error> {
    fn check<M: Method, S, R: Summation>(method: M, system: S, n: usize) -> Result<Vec<f64>, Error>
    where
        S: System<DVector<f64>, Class = Separable>,
    {
        let mut integrator =
            Integrator::<_, _, _, R>::with_summation(method, system, start(n), 0.2)?;
        let mut seen = Vec::new();
        for step_size in [0.2, 0.15, -0.1] {
            integrator.set_step_size(step_size)?;
            integrator.take_steps(5)?;
            let time = integrator.state().time - 0.3 * step_size;
            let inside = integrator.dense()?.state(time)?;
            for state in [&inside, integrator.state()] {
                seen.extend(state.q.iter().chain(&state.p));
            }
        }
        Ok(seen)
    }
    for chain in chains(Breaking { at: 1e3 }) {
        let pairs = [
            [
                check::<_, _, Plain>(Gauss8, chain, 20)?,
                check::<_, _, Plain>(Gauss8, Global(chain), 20)?,
            ],
            [
                check::<_, _, Compensated>(Gauss8, chain, 20)?,
                check::<_, _, Compensated>(Gauss8, Global(chain), 20)?,
            ],
        ];
        assert_eq!(
            check::<_, _, Plain>(Gauss3, chain, 24)?,
            check::<_, _, Plain>(Gauss3, ByComponents(chain), 24)?
        );
        assert_eq!(
            check::<_, _, Compensated>(Gauss5, chain, 24)?,
            check::<_, _, Compensated>(Gauss5, ByComponents(chain), 24)?
        );
        for [local, global] in pairs {
            let differences = local.iter().zip(&global).map(|(x, y)| (x - y).abs());
            assert!(differences.fold(0.0, f64::max) <= 1e-13);
        }
    }
    Ok(())
}

/// How often the force was evaluated, and how often component by component, in 30 steps; the statistics count both.
fn counts<M: Method, R: Summation>(method: M, step_size: f64) -> Result<(u64, u64), Error> {
    let (forces, local_forces) = (&Cell::new(0), &Cell::new(0));
    let counted = Counted {
        system: Chain::ring(Breaking { at: 1e3 }),
        forces,
        local_forces,
    };
    let mut integrator =
        Integrator::<_, _, _, R>::with_summation(method, counted, start(20), step_size)?;
    // That of the first step comes from no step before.
    integrator.step()?;
    let before = (forces.get(), local_forces.get(), *integrator.statistics());
    integrator.take_steps(30)?;
    let made = (forces.get() - before.0, local_forces.get() - before.1);
    let evaluations = integrator.statistics().evaluations - before.2.evaluations;
    // A velocity for each force, that at the start, and with compensated sums that of what the momentum leaves out.
    let velocities = if R::COMPENSATED { 2 } else { 1 };
    let of_forces = 2 * M::STAGES as u64 * (made.0 + made.1);
    assert_eq!(
        evaluations,
        of_forces + 30 * velocities,
        "{} {made:?}",
        M::NAME
    );
    Ok(made)
}

#[test]
fn after_the_first_step_the_force_is_evaluated_component_by_component() -> Result<(), Error> {
    fn check<M: Method>(method: M) -> Result<(), Error> {
        for (forces, local_forces) in [
            counts::<M, Plain>(method, STEP_SIZE)?,
            counts::<M, Compensated>(method, 0.1 * STEP_SIZE)?,
        ] {
            assert_eq!(forces, 0, "{}", M::NAME);
            assert!(local_forces >= 3 * 30, "{} {local_forces}", M::NAME);
        }
        Ok(())
    }
    check(Gauss2)?;
    check(Gauss3)?;
    check(Gauss8)?;
    check(Lobatto3)
}

#[test]
fn iterations_of_many_sweeps_go_on_by_the_force() -> Result<(), Error> {
    for (forces, local_forces) in [
        counts::<_, Plain>(Gauss2, 3.0 * STEP_SIZE)?,
        counts::<_, Plain>(Gauss3, 3.0 * STEP_SIZE)?,
        counts::<_, Plain>(Lobatto3, 3.0 * STEP_SIZE)?,
        counts::<_, Compensated>(Gauss2, 3.0 * STEP_SIZE)?,
    ] {
        assert!(forces > 0 && local_forces > 0, "{forces} {local_forces}");
    }
    Ok(())
}

/// The error, and the state after it.
fn failure<M: Method, S>(
    method: M,
    (system, n): (S, usize),
    iterations: u32,
) -> (Error, State<DVector<f64>>)
where
    S: System<DVector<f64>, Class = Separable>,
{
    let mut start = start(n);
    start.p *= 3.0;
    let mut integrator = Integrator::new(method, system, start, STEP_SIZE).expect("a start");
    integrator.step().expect("a step");
    integrator.set_max_iterations(iterations);
    let error = loop {
        let before = integrator.state().clone();
        if let Err(error) = integrator.step() {
            assert_eq!(integrator.state(), &before);
            break error;
        }
    };
    (error, integrator.state().clone())
}

#[test]
fn steps_fail_as_they_do_by_the_force() {
    for chain in chains(Breaking { at: 1.25 }) {
        let (local, state) = failure(Gauss8, (chain, 20), 200);
        let (global, expected) = failure(Gauss8, (Global(chain), 20), 200);
        assert!(matches!(local, Error::NonFinite { .. }), "{local}");
        assert_eq!(local, global);
        // A unit of rounding of the largest component in every step.
        let size = expected.q.amax().max(expected.p.amax());
        let bound = expected.time / STEP_SIZE * f64::EPSILON * size;
        assert!(distance(&state, &expected) <= bound, "{chain:?}");
    }
    for iterations in [1, 2, 3] {
        let chain = Chain::ring(Breaking { at: 1e3 });
        let (local, _) = failure(Gauss8, (chain, 20), iterations);
        assert!(matches!(local, Error::NoConvergence { .. }), "{local}");
        let in_rows = failure(Gauss3, (chain, 24), iterations);
        assert_eq!(
            in_rows,
            failure(Gauss3, (ByComponents(chain), 24), iterations)
        );
    }
    fn check<M: Method>(method: M) {
        for chain in chains(Breaking { at: 1.25 }) {
            let in_rows = failure(method, (chain, 24), 200);
            assert!(matches!(in_rows.0, Error::NonFinite { .. }), "{in_rows:?}");
            assert_eq!(in_rows, failure(method, (ByComponents(chain), 24), 200));
        }
    }
    check(Gauss3);
    check(Lobatto3);
}

/// No number where a particle is farther than one from its place, with free ends that do not hold it.
struct Bounded;

impl Bonds for Bounded {
    fn tension<T: Scalar>(&self, _time: T, stretch: T) -> T {
        stretch * T::from_f64(0.01)
    }

    fn outer_force<T: Scalar>(&self, _time: T, position: T) -> Option<T> {
        Some((T::one() - position * position).sqrt() * T::zero())
    }
}

/// The force at the last stage of Lobatto 3 is in no stage: it shows in the result only.
#[test]
fn what_shows_in_the_result_only_is_named_too() {
    fn fault<S: System<DVector<f64>, Class = Separable>>(system: S, step_size: f64) -> Error {
        let mut start = State::new(0.0, DVector::zeros(8), DVector::zeros(8));
        start.p[0] = 3.0;
        let mut integrator =
            Integrator::plain(Lobatto3, system, start, step_size).expect("a start");
        integrator.take_steps(20).expect_err("out of bounds")
    }
    for step_size in [0.04, 0.1, 0.2, 0.35, 0.54, 0.66] {
        let chain = || Chain::with_free_ends(Bounded);
        let in_rows = fault(chain(), step_size);
        assert!(matches!(in_rows, Error::NonFinite { .. }), "{in_rows:?}");
        assert_eq!(in_rows, fault(ByComponents(chain()), step_size));
    }
}

/// Springs that are a hundred times stiffer in the beginning.
#[derive(Clone, Copy)]
struct Softening;

impl Bonds for Softening {
    fn tension<T: Scalar>(&self, time: T, stretch: T) -> T {
        let more = (time * time * T::from_f64(-4.0)).exp() * T::from_f64(100.0);
        (more + T::one()) * stretch
    }
}

#[test]
fn steps_after_hard_ones_take_few_sweeps_again() -> Result<(), Error> {
    fn check<M: Method + Copy, R: Summation>(
        method: M,
        n: usize,
        set: impl Fn(&mut Integrator<M, Chain<Softening>, DVector<f64>, R>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let made = |state| {
            let chain = Chain::ring(Softening);
            let mut made = Integrator::with_summation(method, chain, state, 0.1)?;
            set(&mut made)?;
            Ok::<_, Error>(made)
        };
        let sweeps = |integrator: &mut Integrator<M, _, _, R, _>, steps: u64| {
            let before = integrator.statistics().iterations;
            integrator.take_steps(steps)?;
            Ok::<_, Error>((integrator.statistics().iterations - before) as f64 / steps as f64)
        };
        let mut hard = made(State {
            time: 0.0,
            ..start(n)
        })?;
        let first = sweeps(&mut hard, 5)?;
        hard.take_steps(25)?;
        let mut anew = made(hard.state().clone())?;
        anew.take_steps(10)?;
        hard.take_steps(10)?;
        let (after, expected) = (sweeps(&mut hard, 200)?, sweeps(&mut anew, 200)?);
        assert!(first > 1.5 * expected, "{n}: {first} {expected}");
        let ratio = after / expected;
        assert!((0.97..=1.03).contains(&ratio), "{n}: {after} {expected}");
        Ok(())
    }
    for n in [16, 17] {
        check::<_, Plain>(Gauss3, n, |made| made.set_tolerance(1e-13))?;
        check::<_, Plain>(Gauss3, n, |_| Ok(()))?;
        check::<_, Compensated>(Gauss3, n, |_| Ok(()))?;
        check::<_, Plain>(Gauss8, n, |made| made.set_tolerance(1e-13))?;
        check::<_, Plain>(Gauss8, n, |_| Ok(()))?;
        check::<_, Compensated>(Gauss8, n, |_| Ok(()))?;
    }
    Ok(())
}
