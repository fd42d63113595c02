//! Sets of methods for each kind of problem.
//!
//! Every method is generic over the system, here only; a scene chooses a set and its parameters.

use symplectic::system::Unconstrained;
use symplectic::{Integrator, Separable, System, Vector};
use symplectic_report::Problem;
use symplectic_tests::methods::{
    BlanesA19, BlanesMoanS6, BlanesMoanS10, BlanesMoanSrkn11b, BlanesMoanSrkn14a, ForestRuth,
    Gauss2, Gauss4, Gauss6, Gauss8, KahanLi8, Lobatto3, SofroniouSpaletta10, StoermerVerlet,
    SymplecticEuler, VelocityVerlet, Yoshida8,
};

/// Adds a set of methods to a problem.
pub type Set<V, S> = fn(Problem<V, S>) -> Problem<V, S>;

/// Adds methods to a problem, `Method "name" sums`, each with the expression applied to its integrator.
macro_rules! run {
    ($problem:expr, $integrator:pat => $made:expr; $($method:ident $name:literal $sums:ident),+ $(,)?) => {
        $problem$(.run($name, |system, start, h| {
            let $integrator = Integrator::$sums($method, system, start, h)?;
            $made
        }))+
    };
}
#[cfg(feature = "all-scenes")]
pub(crate) use run;

/// Competitive explicit methods for quadratic kinetic energy, with plain sums.
pub fn explicit<V, S>(problem: Problem<V, S>) -> Problem<V, S>
where
    V: Vector<Scalar = f64>,
    S: System<V, Class = Separable> + Clone + 'static,
{
    run!(problem, integrator => Ok(integrator);
        VelocityVerlet "Störmer–Verlet" plain,
        ForestRuth "Forest–Ruth" plain,
        BlanesMoanS10 "Blanes–Moan S10" plain,
        BlanesMoanSrkn11b "Blanes–Moan SRKN 11b" plain,
        BlanesMoanSrkn14a "Blanes–Moan SRKN 14a" plain,
        BlanesA19 "Blanes–Casas–Escorihuela A19" plain,
        KahanLi8 "Kahan–Li 8" plain,
        SofroniouSpaletta10 "Sofroniou–Spaletta 10" plain,
    )
}

/// More explicit methods, for one scene.
pub fn more_explicit<V, S>(problem: Problem<V, S>) -> Problem<V, S>
where
    V: Vector<Scalar = f64>,
    S: System<V, Class = Separable> + Clone + 'static,
{
    run!(problem, integrator => Ok(integrator);
        SymplecticEuler "Symplectic Euler" plain,
        BlanesMoanS6 "Blanes–Moan S6" plain,
        Yoshida8 "Yoshida 8" plain,
        BlanesMoanSrkn14a "SRKN 14a, compensated" new,
        Lobatto3 "Lobatto 3" plain,
    )
}

/// Implicit methods.
pub fn implicit<V, S>(problem: Problem<V, S>) -> Problem<V, S>
where
    V: Vector<Scalar = f64>,
    S: System<V, Class: Unconstrained> + Clone + 'static,
{
    run!(problem, integrator => Ok(integrator);
        Gauss2 "Gauss 2" plain,
        Gauss4 "Gauss 4" plain,
        Gauss6 "Gauss 6" plain,
        Gauss8 "Gauss 8" plain,
        Gauss8 "Gauss 8, compensated" new,
    )
}

/// Implicit methods for systems that are not separable.
pub fn coupled<V, S>(problem: Problem<V, S>) -> Problem<V, S>
where
    V: Vector<Scalar = f64>,
    S: System<V, Class: Unconstrained> + Clone + 'static,
{
    run!(implicit(problem), integrator => Ok(integrator);
        StoermerVerlet "Störmer–Verlet, implicit" plain,
        Lobatto3 "Lobatto 3" plain,
    )
}
