//! Orders of constrained steps, with and without an applied force.

use symplectic::constraints::{Constrained, consistent};
use symplectic::nalgebra::Vector2;
use symplectic::{
    Hamiltonian, Integrator, Method, ProvedFor, Separable, State, Vector, system::Unconstrained,
};

use crate::forces::Resisted;
use crate::holonomic::distance;
use crate::systems::*;

/// The state at a time.
fn end<M, S, C, V>(method: M, system: S, start: &State<V>, (time, steps): (f64, u32)) -> State<V>
where
    M: Method + ProvedFor<Constrained<C>>,
    V: Vector<Scalar = f64>,
    S: Hamiltonian<Class = Constrained<C>, Vector<f64> = V>,
    C: symplectic::system::Class + Unconstrained,
{
    let size = time / f64::from(steps);
    let mut run = Integrator::new(method, system, start.clone(), size).expect("consistent");
    run.integrate_to(time).expect("converges").clone()
}

/// The slope of the error at a time between a number of steps and twice as many, against Lobatto with six stages.
fn slope<M, S, C, V>(method: M, system: S, start: &State<V>, (time, steps): (f64, u32)) -> f64
where
    M: Method + Copy + ProvedFor<Constrained<C>>,
    V: Vector<Scalar = f64>,
    S: Hamiltonian<Class = Constrained<C>, Vector<f64> = V> + Copy,
    C: symplectic::system::Class + Unconstrained,
{
    let reference = end(Lobatto6, system, start, (time, 96));
    let [coarse, fine] = [steps, 2 * steps]
        .map(|steps| distance(&end(method, system, start, (time, steps)), &reference));
    // A rounding error of a hundredth changes the slope by 0.015.
    assert!(
        fine > 100.0 * f64::EPSILON,
        "{}: {fine:e} is lost in rounding errors",
        M::NAME
    );
    (coarse / fine).log2()
}

macro_rules! orders {
    ($($name:ident: $system:expr, $start:expr, [$($method:ident $steps:literal $order:literal,)*];)*) => {$(
        #[test]
        fn $name() {
            $(
                let found = slope($method, $system, &$start, (1.0, $steps));
                let near = (found - f64::from($order)).abs() < 0.05;
                assert!(near, "{}: {found} instead of {}", stringify!($method), $order);
            )*
        }
    )*};
}

orders! {
    orders_on_the_double_spherical_pendulum: DoubleSpherical, double_start(), [
        Euler 640 1, AdjointEuler 640 1, HalfSteps 40 2, Rattle 40 2, Lobatto3 40 4, Lobatto4 20 6, Quarter 80 2, NewtonCotes4 80 2, NewtonCotes5 32 4, ClenshawCurtis4 80 2, ClenshawCurtis5 32 4, Waves 80 2,
        Rattle4 80 4, Rattle6 60 6, RattleAndAdjoint 20 2, AdjointLobatto3 40 4, AdjointBetween 80 2, HalfSteps4 80 4, Mixed 80 2,
    ];
    orders_with_a_kinetic_energy_that_depends_on_the_place: Bead, sphere_start(), [
        Euler 320 1, AdjointEuler 320 1, HalfSteps 40 2, Rattle 40 2, Lobatto3 32 4, Lobatto4 10 6, Lobatto5 7 8, Rattle4 80 4,
    ];
    orders_with_a_velocity_that_is_not_linear: Relativistic,
        consistent(&Relativistic, sphere_start()).expect("regular"), [
        Euler 320 1, AdjointEuler 320 1, HalfSteps 40 2, Rattle 40 2, Lobatto3 32 4, Lobatto4 8 6, Lobatto5 4 8, Rattle4 80 4,
        AdjointLobatto3 32 4, AdjointBetween 80 2, HalfSteps4 80 4,
    ];
    orders_with_an_applied_force: Resisted::new(), sphere_start(), [
        Rattle 64 2, Lobatto3 16 4, Lobatto4 8 6, Lobatto5 4 8, Rattle4 64 4,
    ];
}

/// At t = 1 the errors of order 8 reach rounding errors before the slope is 8. At t = 3/2 they are larger.
#[test]
fn order_eight_on_the_double_spherical_pendulum() {
    let found = slope(Lobatto5, DoubleSpherical, &double_start(), (1.5, 24));
    assert!((found - 8.0).abs() < 0.05, "{found}");
}

/// A method and its adjoint for −h are inverse to each other, and RATTLE and Lobatto are their own adjoints.
#[test]
fn constrained_steps_of_adjoints_go_back() {
    fn there_and_back<M, N>(there: M, back: N) -> f64
    where
        M: Method + ProvedFor<Constrained<Separable>>,
        N: Method + ProvedFor<Constrained<Separable>>,
    {
        let start = double_start();
        let mut run = Integrator::new(there, DoubleSpherical, start.clone(), 0.05).expect("a run");
        run.integrate_to(1.0).expect("converges");
        let turn = run.state().clone();
        let mut run = Integrator::new(back, DoubleSpherical, turn, -0.05).expect("a run");
        run.integrate_to(0.0).expect("converges");
        distance(run.state(), &start)
    }
    for back in [
        there_and_back(Quarter, AdjointQuarter),
        there_and_back(AdjointQuarter, Quarter),
        there_and_back(Lobatto3, AdjointLobatto3),
        there_and_back(RattleAndAdjoint, RattleAndAdjoint),
    ] {
        assert!(back < 1e-12, "{back:e}");
    }
    let astray = there_and_back(Quarter, Quarter);
    assert!(astray > 1e-6, "{astray:e}");
}

/// The positions stay on the constraints and the velocities along them, to rounding.
#[test]
fn compositions_with_adjoints_keep_the_constraints() {
    fn residual<M: Method + ProvedFor<Constrained<Separable>>>(method: M) -> f64 {
        let start: State<Vector2<f64>> = State::from_arrays(0.0, [0.6, -0.8], [0.8, 0.6]);
        let mut run = Integrator::new(method, Pendulum, start, 0.05).expect("a run");
        let mut largest: f64 = 0.0;
        for _ in 0..1000 {
            let State { q, p, .. } = run.step().expect("a step");
            largest = largest.max((q.dot(q) - 1.0).abs()).max(q.dot(p).abs());
        }
        largest
    }
    for residual in [
        residual(RattleAndAdjoint),
        residual(AdjointLobatto3),
        residual(AdjointBetween),
        residual(HalfSteps4),
        residual(Mixed),
    ] {
        assert!(residual < 4e-15, "{residual:e}");
    }
}
