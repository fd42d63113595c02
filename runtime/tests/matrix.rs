//! Methods × solvers × sums × checks, compiled and at run time.
//!
//! A method is one row of [`methods!`], a solver one line of [`solvers`], a check one line of [`check`]. Rows that are not symmetric
//! or not symplectic are the negative twins: they must fail the check.

mod common;

use common::methods::*;
use common::systems::{Fuse, PulsatingProduct, PulsatingStar};
use common::{coefficients, distance};
use symplectic::at_run_time::{RunTimeTableau, TableauError};
use symplectic::nalgebra::{Matrix2, Matrix4, Vector2, Vector4};
use symplectic::solver::{
    ByNewton, Dense, Differences, FixedPoint, FixedPointThenNewton, SimdFixedPoint, SimdJacobi,
    Solver,
};
use symplectic::system::{Conservative, SystemInLanes, Unconstrained};
use symplectic::{
    Checkpoint, Compensated, Error, General, Integrator, Method, Plain, ProvedFor, Separable,
    State, Statistics, Summation, System,
};

type Point = State<Vector2<f64>>;

/// The stated properties of a method, which its steps must show.
#[derive(Clone, Copy)]
struct Row {
    /// For separable and for general Hamiltonians.
    orders: [u32; 2],
    /// Number of steps of the coarsest run that measures the order. Its errors are above rounding, and the next power of h is small. Zero if
    /// the order is not measured, because no such run exists for order 16.
    steps: u32,
    /// Whether a step back undoes a step.
    symmetric: bool,
    symplectic: bool,
    /// Whether stages in lanes have the same bits as stages one by one, which holds if all stages are iterated.
    same_bits: bool,
}

/// A method with the system that it steps.
#[derive(Clone, Copy)]
struct Cell<'a> {
    name: &'a str,
    order: u32,
    row: Row,
    fuse: &'a Fuse,
    /// The state after [`DURATION`].
    exact: &'a Point,
    /// How many times larger the rounding errors of a step may be than with weights of one sign: Σ|b|.
    rounding: f64,
}

const SYMMETRIC: bool = true;
const SYMPLECTIC: bool = true;
const BITS: bool = true;

/// One test a row; the methods of the first block for every Hamiltonian, those of the second for separable ones.
macro_rules! methods {
    (
        every { $($test:ident: $method:ident, $orders:expr, $steps:expr, $symmetric:expr, $symplectic:expr, $bits:expr;)* }
        separable { $($splitting:ident: $composed:ident, $order:expr, $coarsest:expr, $reversible:expr;)* }
    ) => {
        $(#[test]
        fn $test() -> Result<(), Error> {
            let row = Row {
                orders: $orders,
                steps: $steps,
                symmetric: $symmetric,
                symplectic: $symplectic,
                same_bits: $bits,
            };
            separable($method, row)?;
            general($method, row)
        })*
        $(#[test]
        fn $splitting() -> Result<(), Error> {
            let row = Row {
                orders: [$order, 0],
                steps: $coarsest,
                symmetric: $reversible,
                symplectic: SYMPLECTIC,
                same_bits: BITS,
            };
            separable($composed, row)
        })*
    };
}

methods! {
    every {
    //               method           orders    steps  a step back  keeps dq ∧ dp  in lanes
    euler:           SymplecticEuler, [1, 1],   64,    !SYMMETRIC,  SYMPLECTIC,    !BITS;
    adjoint_euler:   AdjointEuler,    [1, 1],   64,    !SYMMETRIC,  SYMPLECTIC,    !BITS;
    verlet:          StoermerVerlet,  [2, 2],   64,    SYMMETRIC,   SYMPLECTIC,    !BITS;
    midpoint:        Midpoint,        [2, 2],   64,    SYMMETRIC,   SYMPLECTIC,    BITS;
    gauss_2:         Gauss2,          [4, 4],   32,    SYMMETRIC,   SYMPLECTIC,    BITS;
    gauss_3:         Gauss3,          [6, 6],   16,    SYMMETRIC,   SYMPLECTIC,    BITS;
    gauss_8:         Gauss8,          [16, 16], 0,     SYMMETRIC,   SYMPLECTIC,    BITS;
    lobatto_3:       Lobatto3,        [4, 4],   32,    SYMMETRIC,   SYMPLECTIC,    !BITS;
    radau_3:         Radau3,          [5, 5],   32,    !SYMMETRIC,  SYMPLECTIC,    !BITS;
    tang:            Tang,            [4, 4],   32,    SYMMETRIC,   SYMPLECTIC,    BITS;
    askew:           Askew,           [2, 2],   64,    !SYMMETRIC,  SYMPLECTIC,    !BITS;
    triple_midpoint: TripleMidpoint,  [4, 4],   64,    SYMMETRIC,   SYMPLECTIC,    BITS;
    radau_iia:       RadauIIA,        [3, 3],   64,    !SYMMETRIC,  !SYMPLECTIC,   !BITS;
    weighted:        Weighted,        [1, 1],   64,    !SYMMETRIC,  !SYMPLECTIC,   !BITS;
    }
    separable {
    triple_jump:     TripleJump,      4,        64,    SYMMETRIC;
    position_jump:   PositionJump,    4,        64,    SYMMETRIC;
    yoshida:         Yoshida6,        6,        64,    SYMMETRIC;
    forest_ruth:     ForestRuth,      4,        64,    SYMMETRIC;
    }
}

fn separable<M: Method + Copy + ProvedFor<Separable>>(method: M, row: Row) -> Result<(), Error> {
    let fuse = &Fuse::never();
    let (name, order) = (M::NAME, row.orders[0]);
    assert_eq!(M::ORDERS.separable, order, "{name}");
    let exact = &exact(PulsatingStar(fuse))?;
    let cell = Cell {
        name,
        order,
        row,
        fuse,
        exact,
        rounding: 1.0,
    };
    solvers::<_, _, Compensated>(cell, method, PulsatingStar(fuse))?;
    solvers::<_, _, Plain>(cell, method, PulsatingStar(fuse))?;
    at_run_time(cell, method, PulsatingStar(fuse))
}

fn general<M: Method + Copy + ProvedFor<General>>(method: M, row: Row) -> Result<(), Error> {
    let fuse = &Fuse::never();
    let (name, order) = (M::NAME, row.orders[1]);
    assert_eq!(M::ORDERS.general, order, "{name}");
    let exact = &exact(PulsatingProduct(fuse))?;
    let cell = Cell {
        name,
        order,
        row,
        fuse,
        exact,
        rounding: 1.0,
    };
    solvers::<_, _, Compensated>(cell, method, PulsatingProduct(fuse))?;
    solvers::<_, _, Plain>(cell, method, PulsatingProduct(fuse))?;
    at_run_time(cell, method, PulsatingProduct(fuse))
}

/// A run of whichever types: the checks are the same code for all of them.
trait Run<'a> {
    fn step(&mut self) -> Result<&Point, Error>;
    fn take_steps(&mut self, count: u64) -> Result<&Point, Error>;
    fn set_step_size(&mut self, size: f64) -> Result<(), Error>;
    fn state(&self) -> &Point;
    fn remainder(&self) -> (Vector2<f64>, Vector2<f64>);
    fn statistics(&self) -> &Statistics;
    fn checkpoint(&self) -> Checkpoint;
    fn restore(&mut self, checkpoint: &Checkpoint);
    fn copy(&self) -> Box<dyn Run<'a> + 'a>;
}

impl<'a, M, S, R, N> Run<'a> for Integrator<M, S, Vector2<f64>, R, N>
where
    M: Method,
    S: System<Vector2<f64>> + Copy + 'a,
    R: Summation,
    N: Solver<Vector2<f64>, S>,
{
    fn step(&mut self) -> Result<&Point, Error> {
        self.step()
    }

    fn take_steps(&mut self, count: u64) -> Result<&Point, Error> {
        self.take_steps(count)
    }

    fn set_step_size(&mut self, size: f64) -> Result<(), Error> {
        self.set_step_size(size)
    }

    fn state(&self) -> &Point {
        self.state()
    }

    fn remainder(&self) -> (Vector2<f64>, Vector2<f64>) {
        let (q, p) = self.remainder();
        (*q, *p)
    }

    fn statistics(&self) -> &Statistics {
        self.statistics()
    }

    fn checkpoint(&self) -> Checkpoint {
        self.checkpoint().expect("doubles")
    }

    fn restore(&mut self, checkpoint: &Checkpoint) {
        self.restore(checkpoint).expect("the same run");
    }

    fn copy(&self) -> Box<dyn Run<'a> + 'a> {
        Box::new(self.clone())
    }
}

/// A new run from a state, with steps of a size.
type Made<'f, 'a> = &'f dyn Fn(Point, f64) -> Result<Box<dyn Run<'a> + 'a>, Error>;

/// All solvers, each against the iteration stage by stage.
fn solvers<'a, M, S, R: Summation>(cell: Cell<'_>, method: M, system: S) -> Result<(), Error>
where
    M: Method + Copy + ProvedFor<<S as System<Vector2<f64>>>::Class>,
    S: SystemInLanes<Vector2<f64>> + Copy + 'a,
{
    let made = |start: Point, size: f64| {
        Integrator::<M, S, _, R, <S as System<Vector2<f64>>>::Solver>::with_summation(
            method, system, start, size,
        )
    };
    let expected = check(cell, &|start, size| {
        Ok(Box::new(made(start, size)?.with_solver(FixedPoint)))
    })?;
    let found = [
        check(cell, &|start, size| Ok(Box::new(made(start, size)?)))?,
        check(cell, &|start, size| {
            Ok(Box::new(made(start, size)?.with_solver(SimdFixedPoint)))
        })?,
        check(cell, &|start, size| {
            Ok(Box::new(made(start, size)?.with_solver(SimdJacobi)))
        })?,
        check(cell, &|start, size| {
            Ok(Box::new(made(start, size)?.by_newton()))
        })?,
        check(cell, &|start, size| {
            let solver = FixedPointThenNewton::<Dense<Differences>>::new();
            let mut made = made(start, size)?.with_solver(solver);
            // Some steps are left to Newton's iteration.
            made.set_max_iterations(9);
            Ok(Box::new(made))
        })?,
    ];
    if cell.row.same_bits {
        assert_eq!(found[1], expected, "{}", cell.name);
    }
    for (solver, found) in found.iter().enumerate() {
        // Some units in the last place a step.
        let apart = distance(found, &expected);
        assert!(apart < 1e-13, "{}, solver {solver}: {apart:e}", cell.name);
    }
    Ok(())
}

/// The same coefficients as a tableau that is known only at run time, with both sums. A tableau that is not symplectic is refused.
fn at_run_time<'a, M, S>(cell: Cell<'_>, method: M, system: S) -> Result<(), Error>
where
    M: Method + Copy + ProvedFor<<S as System<Vector2<f64>>>::Class>,
    S: System<Vector2<f64>, Class: Conservative> + Copy + 'a,
{
    let coefficients = coefficients(method);
    let tableau = RunTimeTableau::new(M::NAME, &coefficients, M::ORDERS);
    if !cell.row.symplectic {
        assert!(
            matches!(tableau, Err(TableauError::NotSymplectic { .. })),
            "{tableau:?}"
        );
        return Ok(());
    }
    let tableau = &tableau.expect(cell.name);
    // A composition is one sum here, of terms as large as its fractions.
    let cell = Cell {
        rounding: coefficients.b.iter().map(|b| b.abs()).sum(),
        ..cell
    };
    let mut compiled = Integrator::new(method, system, start(), SIZE)?;
    let expected = compiled.take_steps(20)?;
    let compensated = solvers_at_run_time(cell, |start, size| {
        Integrator::new(tableau.clone(), system, start, size)
    })?;
    let plain = solvers_at_run_time(cell, |start, size| {
        Integrator::plain(tableau.clone(), system, start, size)
    })?;
    for (number, found) in compensated.iter().chain(&plain).enumerate() {
        let apart = distance(found, expected);
        let name = cell.name;
        assert!(apart < 1e-13, "{name}, at run time, {number}: {apart:e}");
    }
    Ok(())
}

/// All solvers of a tableau at run time.
fn solvers_at_run_time<'a, S, R>(
    cell: Cell<'_>,
    made: impl Fn(Point, f64) -> Result<Integrator<RunTimeTableau, S, Vector2<f64>, R>, Error>,
) -> Result<[Point; 3], Error>
where
    S: System<Vector2<f64>, Class: Conservative> + Copy + 'a,
    R: Summation,
{
    Ok([
        check(cell, &|start, size| Ok(Box::new(made(start, size)?)))?,
        check(cell, &|start, size| {
            Ok(Box::new(made(start, size)?.by_newton()))
        })?,
        check(cell, &|start, size| {
            let solver = FixedPointThenNewton::<Dense<Differences>>::new();
            let mut made = made(start, size)?.with_solver(solver);
            // Some steps are left to Newton's iteration.
            made.set_max_iterations(9);
            Ok(Box::new(made))
        })?,
    ])
}

/// All checks; returns the state after some steps.
fn check(cell: Cell<'_>, made: Made<'_, '_>) -> Result<Point, Error> {
    for check in [
        has_its_order,
        undoes_its_steps,
        is_symplectic,
        keeps_the_angular_momentum,
        takes_many_steps_as_single_ones,
        fails_without_a_trace,
        survives_one_evaluation_that_is_not_finite,
        restarts_to_the_bit,
    ] {
        check(cell, made)?;
    }
    Ok(made(start(), SIZE)?.take_steps(20)?.clone())
}

const SIZE: f64 = 0.05;
const DURATION: f64 = 2.0;

fn exact<S: System<Vector2<f64>, Class: Unconstrained>>(system: S) -> Result<Point, Error> {
    let mut fine = Integrator::new(Gauss8, system, start(), DURATION / 64.0)?;
    Ok(fine.take_steps(64)?.clone())
}

/// Off the axes, so that no derivative vanishes by symmetry.
fn start() -> Point {
    State::from_arrays(0.25, [1.0, 0.3], [-0.2, 0.9])
}

/// The slope of log error over log h, and the correlation of both: it is the order, and the errors lie on a line.
fn has_its_order(cell: Cell<'_>, made: Made<'_, '_>) -> Result<(), Error> {
    if cell.row.steps == 0 {
        return Ok(());
    }
    let points = [8, 9, 10, 11, 12]
        .map(|steps| {
            let steps = cell.row.steps * steps / 8;
            let mut run = made(start(), DURATION / f64::from(steps))?;
            let error = distance(run.take_steps(u64::from(steps))?, cell.exact);
            Ok::<_, Error>([-f64::from(steps).ln(), error.ln()])
        })
        .into_iter()
        .collect::<Result<Vec<_>, _>>()?;
    let mean = |k: usize| points.iter().map(|point| point[k]).sum::<f64>() / points.len() as f64;
    let means = [mean(0), mean(1)];
    let moment = |i: usize, j: usize| {
        let products = points
            .iter()
            .map(|point| (point[i] - means[i]) * (point[j] - means[j]));
        products.sum::<f64>()
    };
    let slope = moment(0, 1) / moment(0, 0);
    let correlation = moment(0, 1) / (moment(0, 0) * moment(1, 1)).sqrt();
    let seen = format!("{}: slope {slope}, correlation {correlation}", cell.name);
    // The steps of high orders are large, and the next power of h is not as small.
    let (order, bound) = (
        f64::from(cell.order),
        0.1_f64.max(f64::from(cell.order) / 32.0),
    );
    assert!((slope - order).abs() < bound, "{seen}");
    assert!(correlation > 0.9999, "{seen}");
    Ok(())
}

fn undoes_its_steps(cell: Cell<'_>, made: Made<'_, '_>) -> Result<(), Error> {
    let mut run = made(start(), SIZE)?;
    run.take_steps(20)?;
    assert!(distance(run.state(), &start()) > 0.1, "{}", cell.name);
    run.set_step_size(-SIZE)?;
    let left = distance(run.take_steps(20)?, &start());
    // Two units in the last place a step, or the error of a method of order 5 with this step size.
    let undone = left < 40.0 * 2.0 * f64::EPSILON * cell.rounding;
    let kept = left > 1e-10;
    assert!(
        if cell.row.symmetric { undone } else { kept },
        "{}: {left:e}",
        cell.name
    );
    Ok(())
}

/// JᵀΩJ = Ω for the Jacobian J of a step, by differences of order 6.
fn is_symplectic(cell: Cell<'_>, made: Made<'_, '_>) -> Result<(), Error> {
    const SHIFT: f64 = 1.0 / 256.0;
    let column = |k: usize| {
        [(1.0, 45.0), (2.0, -9.0), (3.0, 1.0)].iter().try_fold(
            Vector4::zeros(),
            |sum, &(shift, weight)| {
                let moved = |shift: f64| {
                    let mut from = start();
                    let component = if k < 2 {
                        &mut from.q[k]
                    } else {
                        &mut from.p[k - 2]
                    };
                    *component += shift;
                    let mut run = made(from, 4.0 * SIZE)?;
                    let to = run.step()?;
                    Ok::<_, Error>(Vector4::new(to.q[0], to.q[1], to.p[0], to.p[1]))
                };
                let difference = moved(shift * SHIFT)? - moved(-shift * SHIFT)?;
                Ok::<_, Error>(sum + difference * (weight / (60.0 * SHIFT)))
            },
        )
    };
    let jacobian = Matrix4::from_columns(&[column(0)?, column(1)?, column(2)?, column(3)?]);
    let mut omega = Matrix4::zeros();
    omega.fixed_view_mut::<2, 2>(0, 2).fill_with_identity();
    omega
        .fixed_view_mut::<2, 2>(2, 0)
        .copy_from(&-Matrix2::identity());
    let defect = (jacobian.transpose() * omega * jacobian - omega).amax();
    // The differences are off by some rounding errors over the shift.
    let preserved = defect < 1e-12;
    let lost = defect > 1e-6;
    assert!(
        if cell.row.symplectic { preserved } else { lost },
        "{}: {defect:e}",
        cell.name
    );
    Ok(())
}

/// Every symplectic method conserves bilinear invariants.
fn keeps_the_angular_momentum(cell: Cell<'_>, made: Made<'_, '_>) -> Result<(), Error> {
    let momentum = |state: &Point| state.q.perp(&state.p);
    let mut run = made(start(), SIZE)?;
    let mut rounding = 0.0;
    for _ in 0..100 {
        let state = run.step()?;
        // Half a unit in the last place of either vector, and the same again for the stage iteration.
        rounding += 2.0 * state.q.norm() * state.p.norm() * f64::EPSILON;
    }
    let change = (momentum(run.state()) - momentum(&start())).abs();
    let (conserved, lost) = (change < rounding, change > 1e-8);
    let stated = if cell.row.symplectic { conserved } else { lost };
    assert!(stated, "{}: {change:e}", cell.name);
    Ok(())
}

fn takes_many_steps_as_single_ones(cell: Cell<'_>, made: Made<'_, '_>) -> Result<(), Error> {
    let (mut at_once, mut one_by_one) = (made(start(), SIZE)?, made(start(), SIZE)?);
    at_once.take_steps(20)?;
    for _ in 0..20 {
        one_by_one.step()?;
    }
    assert_same(cell, &*at_once, &*one_by_one);
    Ok(())
}

/// The same states to the last bit, at the same cost.
fn assert_same(cell: Cell<'_>, found: &dyn Run<'_>, expected: &dyn Run<'_>) {
    assert_eq!(found.state(), expected.state(), "{}", cell.name);
    assert_eq!(found.remainder(), expected.remainder(), "{}", cell.name);
    assert_eq!(found.statistics(), expected.statistics(), "{}", cell.name);
}

/// A step in which an evaluation is NaN leaves the state unchanged, and the run continues as if the step had not been tried.
fn fails_without_a_trace(cell: Cell<'_>, made: Made<'_, '_>) -> Result<(), Error> {
    let (mut failing, mut good) = (made(start(), SIZE)?, made(start(), SIZE)?);
    for evaluations in [0, 1, 2, 3, 5, 8, 13] {
        let before = (failing.state().clone(), failing.remainder());
        let statistics = *failing.statistics();
        cell.fuse.set(evaluations);
        let failed = failing.step().is_err();
        assert!(failed || evaluations > 0, "{}", cell.name);
        cell.fuse.set(u64::MAX);
        if failed {
            let after = (failing.state().clone(), failing.remainder());
            assert_eq!(after, before, "{} {evaluations}", cell.name);
            assert_eq!(
                failing.statistics(),
                &statistics,
                "{} {evaluations}",
                cell.name
            );
            failing.step()?;
        }
        // Stages without a warm start may differ by a unit in the last place.
        let apart = distance(failing.state(), good.step()?);
        assert!(apart < 1e-14, "{} {evaluations}: {apart:e}", cell.name);
    }
    Ok(())
}

/// A step in which one evaluation is NaN succeeds, because it is taken once more as a first step. Only the first step may fail.
fn survives_one_evaluation_that_is_not_finite(
    cell: Cell<'_>,
    made: Made<'_, '_>,
) -> Result<(), Error> {
    let (mut failing, mut good) = (made(start(), SIZE)?, made(start(), SIZE)?);
    for run in [&mut failing, &mut good] {
        run.step()?;
    }
    for evaluations in [0, 1, 2, 3, 5, 8, 13] {
        cell.fuse.set_once(evaluations);
        failing.step()?;
        cell.fuse.set(u64::MAX);
        // Stages without a warm start may differ by a unit in the last place.
        let apart = distance(failing.state(), good.step()?);
        assert!(apart < 1e-14, "{} {evaluations}: {apart:e}", cell.name);
    }
    Ok(())
}

/// Compares an uninterrupted run with one that is saved and restored and with one that is cloned, at every break.
fn restarts_to_the_bit(cell: Cell<'_>, made: Made<'_, '_>) -> Result<(), Error> {
    let (mut whole, mut cloned) = (made(start(), SIZE)?, made(start(), SIZE)?);
    let mut saved = cloned.checkpoint();
    for steps in [1, 3, 2, 17, 1, 40] {
        let mut resumed = made(start(), SIZE)?;
        resumed.restore(&saved);
        let mut copy = cloned.copy();
        for run in [&mut whole, &mut resumed, &mut copy] {
            // Half of the steps at once, the others one by one.
            run.take_steps(steps / 2)?;
            for _ in steps / 2..steps {
                run.step()?;
            }
        }
        assert_same(cell, &*resumed, &*whole);
        assert_same(cell, &*copy, &*whole);
        saved = resumed.checkpoint();
        assert_eq!(saved, whole.checkpoint(), "{}", cell.name);
        cloned = copy;
    }
    Ok(())
}
