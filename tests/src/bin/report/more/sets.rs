//! Sets of methods for constraints, friction and stiff systems.

use symplectic::constraints::{Constrained, Nonholonomic};
use symplectic::friction::Damped;
use symplectic::solver::ByNewton;
use symplectic::system::{Class, Unconstrained};
use symplectic::{Integrator, System, Vector};
use symplectic_report::Problem;
use symplectic_tests::methods::{
    BlanesMoanS6, BlanesMoanS10, ForestRuth, Gauss4, Gauss8, KahanLi8, Lobatto3, Lobatto4,
    Lobatto5, Midpoint, Midpoint4, Midpoint6, Rattle4, Rattle6, StoermerVerlet, VelocityVerlet,
};

use crate::sets::run;

/// Methods for holonomic constraints.
pub fn constrained<V, S, C>(problem: Problem<V, S>) -> Problem<V, S>
where
    V: Vector<Scalar = f64>,
    S: System<V, Class = Constrained<C>> + Clone + 'static,
    C: Class + Unconstrained,
{
    run!(problem, integrator => Ok(integrator);
        StoermerVerlet "RATTLE" plain,
        Rattle4 "RATTLE, order 4" plain,
        Rattle6 "RATTLE, order 6" plain,
        Lobatto3 "Lobatto 3" plain,
        Lobatto4 "Lobatto 4" plain,
        Lobatto5 "Lobatto 5" plain,
        Lobatto4 "Lobatto 4, compensated" new,
    )
}

/// Splittings for friction in the kicks.
pub fn damped<V, S>(problem: Problem<V, S>) -> Problem<V, S>
where
    V: Vector<Scalar = f64>,
    S: System<V, Class = Damped> + Clone + 'static,
{
    run!(problem, integrator => Ok(integrator);
        VelocityVerlet "Störmer–Verlet" plain,
        ForestRuth "Forest–Ruth" plain,
        BlanesMoanS6 "Blanes–Moan S6" plain,
        BlanesMoanS10 "Blanes–Moan S10" plain,
        KahanLi8 "Kahan–Li 8" plain,
        BlanesMoanS10 "S10, compensated" new,
    )
}

/// Methods for non-holonomic constraints.
pub fn nonholonomic<V, S, C>(problem: Problem<V, S>) -> Problem<V, S>
where
    V: Vector<Scalar = f64>,
    S: System<V, Class = Nonholonomic<C>> + Clone + 'static,
    C: Class + Unconstrained,
{
    run!(problem, integrator => Ok(integrator);
        Midpoint "Midpoint" plain,
        StoermerVerlet "Störmer–Verlet, implicit" plain,
        Midpoint4 "Midpoint, order 4" plain,
        Midpoint6 "Midpoint, order 6" plain,
        Midpoint4 "Midpoint, order 4, compensated" new,
    )
}

/// Implicit methods with Newton's iteration, for stiff systems.
pub fn newton<V, S>(problem: Problem<V, S>) -> Problem<V, S>
where
    V: Vector<Scalar = f64>,
    S: System<V, Class: Unconstrained> + Clone + 'static,
{
    run!(problem, integrator => Ok(integrator.by_newton());
        Gauss4 "Gauss 4, Newton" plain,
        Gauss8 "Gauss 8, Newton" plain,
    )
}
