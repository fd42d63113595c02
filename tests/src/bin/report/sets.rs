//! Which methods are run on what kind of problem.
//!
//! Every method is generic over the system once, here: a scene chooses a set and says its numbers.

use symplectic::nalgebra::SVector;
use symplectic::report::Problem;
use symplectic::{Hamiltonian, HamiltonianInLanes, Integrator, Separable, Vector};
use symplectic_tests::methods::{
    BlanesMoanSrkn14a, ForestRuth, Gauss2, Gauss4, Gauss6, Gauss8, Lobatto3, StoermerVerlet,
    SymplecticEuler, VelocityVerlet,
};

use crate::methods::{
    BlanesMoanS6, BlanesMoanS10, BlanesMoanSrkn11b, KahanLi8, SofroniouSpaletta10, Yoshida8,
};

/// A problem with methods that are to be run on it.
pub type Set<V, S> = fn(Problem<V, S>) -> Problem<V, S>;

/// Names of methods, as they are in all problems.
const GAUSS_2: &str = "Gauss 2";
const GAUSS_4: &str = "Gauss 4";
const GAUSS_6: &str = "Gauss 6";
const GAUSS_8: &str = "Gauss 8";
const GAUSS_8_COMPENSATED: &str = "Gauss 8, compensated";
const SRKN_14A: &str = "Blanes–Moan SRKN 14a";

/// Explicit methods that are worth it for quadratic kinetic energy: plain sums.
pub fn explicit<V, S>(problem: Problem<V, S>) -> Problem<V, S>
where
    V: Vector<Scalar = f64>,
    S: Hamiltonian<V, Class = Separable> + Clone + 'static,
{
    problem
        .run("Störmer–Verlet", |system, start, h| {
            Integrator::plain(VelocityVerlet, system, start, h)
        })
        .run("Forest–Ruth", |system, start, h| {
            Integrator::plain(ForestRuth, system, start, h)
        })
        .run("Blanes–Moan S10", |system, start, h| {
            Integrator::plain(BlanesMoanS10, system, start, h)
        })
        .run(SRKN_14A, |system, start, h| {
            Integrator::plain(BlanesMoanSrkn14a, system, start, h)
        })
        .run("Kahan–Li 8", |system, start, h| {
            Integrator::plain(KahanLi8, system, start, h)
        })
        .run("Sofroniou–Spaletta 10", |system, start, h| {
            Integrator::plain(SofroniouSpaletta10, system, start, h)
        })
}

/// More of them, for one scene that has all.
pub fn more_explicit<V, S>(problem: Problem<V, S>) -> Problem<V, S>
where
    V: Vector<Scalar = f64>,
    S: Hamiltonian<V, Class = Separable> + Clone + 'static,
{
    problem
        .run("Symplectic Euler", |system, start, h| {
            Integrator::plain(SymplecticEuler, system, start, h)
        })
        .run("Blanes–Moan S6", |system, start, h| {
            Integrator::plain(BlanesMoanS6, system, start, h)
        })
        .run("Blanes–Moan SRKN 11b", |system, start, h| {
            Integrator::plain(BlanesMoanSrkn11b, system, start, h)
        })
        .run("Yoshida 8", |system, start, h| {
            Integrator::plain(Yoshida8, system, start, h)
        })
        .run("SRKN 14a, compensated", |system, start, h| {
            Integrator::new(BlanesMoanSrkn14a, system, start, h)
        })
        .run("Lobatto 3", |system, start, h| {
            Integrator::plain(Lobatto3, system, start, h)
        })
}

/// Implicit methods for `q'' = M⁻¹ f(q)` in few components: only positions are iterated, in lanes.
pub fn second_order<S, const N: usize>(
    problem: Problem<SVector<f64, N>, S>,
) -> Problem<SVector<f64, N>, S>
where
    S: HamiltonianInLanes<SVector<f64, N>> + Clone + 'static,
{
    problem
        .run(GAUSS_2, |system, start, h| {
            Integrator::plain(Gauss2, system, start, h)?.in_second_order_lanes()
        })
        .run(GAUSS_4, |system, start, h| {
            Integrator::plain(Gauss4, system, start, h)?.in_second_order_lanes()
        })
        .run(GAUSS_6, |system, start, h| {
            Integrator::plain(Gauss6, system, start, h)?.in_second_order_lanes()
        })
        .run(GAUSS_8, |system, start, h| {
            Integrator::plain(Gauss8, system, start, h)?.in_second_order_lanes()
        })
        .run(GAUSS_8_COMPENSATED, |system, start, h| {
            Integrator::new(Gauss8, system, start, h)?.in_second_order_lanes()
        })
}

/// Implicit methods in few components, stages side by side in lanes.
fn in_lanes<S, const N: usize>(problem: Problem<SVector<f64, N>, S>) -> Problem<SVector<f64, N>, S>
where
    S: HamiltonianInLanes<SVector<f64, N>> + Clone + 'static,
{
    problem
        .run(GAUSS_2, |system, start, h| {
            Ok(Integrator::plain(Gauss2, system, start, h)?.in_lanes())
        })
        .run(GAUSS_4, |system, start, h| {
            Ok(Integrator::plain(Gauss4, system, start, h)?.in_lanes())
        })
        .run(GAUSS_6, |system, start, h| {
            Ok(Integrator::plain(Gauss6, system, start, h)?.in_lanes())
        })
        .run(GAUSS_8, |system, start, h| {
            Ok(Integrator::plain(Gauss8, system, start, h)?.in_lanes())
        })
        .run(GAUSS_8_COMPENSATED, |system, start, h| {
            Ok(Integrator::new(Gauss8, system, start, h)?.in_lanes())
        })
}

/// Implicit methods that are interesting where nothing is explicit.
pub fn coupled<S, const N: usize>(
    problem: Problem<SVector<f64, N>, S>,
) -> Problem<SVector<f64, N>, S>
where
    S: HamiltonianInLanes<SVector<f64, N>> + Clone + 'static,
{
    in_lanes(problem)
        .run("Störmer–Verlet, implicit", |system, start, h| {
            Integrator::plain(StoermerVerlet, system, start, h)
        })
        .run("Lobatto 3", |system, start, h| {
            Integrator::plain(Lobatto3, system, start, h)
        })
}

/// Implicit methods in many components: lanes run along them as it is.
pub fn long<V, S>(problem: Problem<V, S>) -> Problem<V, S>
where
    V: Vector<Scalar = f64>,
    S: Hamiltonian<V> + Clone + 'static,
{
    problem
        .run(GAUSS_2, |system, start, h| {
            Integrator::plain(Gauss2, system, start, h)
        })
        .run(GAUSS_4, |system, start, h| {
            Integrator::plain(Gauss4, system, start, h)
        })
        .run(GAUSS_8, |system, start, h| {
            Integrator::plain(Gauss8, system, start, h)
        })
        .run(GAUSS_8_COMPENSATED, |system, start, h| {
            Integrator::new(Gauss8, system, start, h)
        })
}

/// By Newton's iteration, for what is stiff.
pub fn newton<V, S>(problem: Problem<V, S>) -> Problem<V, S>
where
    V: Vector<Scalar = f64>,
    S: Hamiltonian<V> + Clone + 'static,
{
    problem
        .run("Gauss 4, Newton", |system, start, h| {
            Ok(Integrator::plain(Gauss4, system, start, h)?.by_newton())
        })
        .run("Gauss 8, Newton", |system, start, h| {
            Ok(Integrator::plain(Gauss8, system, start, h)?.by_newton())
        })
}
