//! Every pair of a class of systems and a kind of method: which of them have steps, and that a bound says so for the others.

symplectic::tableau! { Gauss { base: gauss-2 } }
symplectic::tableau! { Midpoint { base: midpoint } }
symplectic::tableau! { Lobatto { base: lobatto-3 } }
symplectic::tableau! { Verlet { base: stormer-verlet } }
symplectic::tableau! { Euler { base: symplectic-euler } }
symplectic::tableau! { ForestRuth { base: forest-ruth-1990 } }
symplectic::tableau! { Ruth { base: ruth-1983 } }
symplectic::tableau! { Nystrom { base: mclachlan-atela-1992-order-4-optimal } }

use symplectic::constraints::{Constrained, Nonholonomic};
use symplectic::friction::Damped;
use symplectic::proved::{LowerOrder, Splits, StoermerVerletSteps, SymmetricFor};
use symplectic::system::Class;
use symplectic::{General, Method, ProvedFor, Separable};

fn steps<M: Method + ProvedFor<C>, C: Class>() {}
fn symmetric<M: SymmetricFor<C>, C: Class>() {}
fn splits<M: Splits>() {}
fn composes<M: StoermerVerletSteps>() {}
fn class<C: Class>() {}

type Holonomic<C> = Constrained<C>;

/// What is possible.
fn possible() {
    steps::<Gauss, General>();
    steps::<Gauss, Separable>();
    steps::<Midpoint, General>();
    steps::<Midpoint, Separable>();
    steps::<Midpoint, Nonholonomic<Separable>>();
    steps::<Midpoint, Nonholonomic<General>>();
    steps::<Lobatto, General>();
    steps::<Lobatto, Separable>();
    steps::<Lobatto, Holonomic<Separable>>();
    steps::<Lobatto, Holonomic<General>>();
    steps::<Verlet, General>();
    steps::<Verlet, Separable>();
    steps::<Verlet, Damped>();
    steps::<Verlet, Holonomic<Separable>>();
    steps::<Verlet, Nonholonomic<General>>();
    steps::<Euler, General>();
    steps::<Euler, Damped>();
    steps::<Euler, Holonomic<General>>();
    steps::<ForestRuth, Separable>();
    steps::<ForestRuth, Damped>();
    steps::<Nystrom, Separable>();
    steps::<LowerOrder<ForestRuth>, General>();
    steps::<LowerOrder<Nystrom>, Damped>();
    symmetric::<Gauss, Damped>();
    symmetric::<ForestRuth, Holonomic<Separable>>();
    composes::<Verlet>();
    class::<Holonomic<General>>();
}

fn main() {
    possible();
    // Friction is for splittings whose order holds for every separable H.
    steps::<Gauss, Damped>();
    steps::<Midpoint, Damped>();
    steps::<Lobatto, Damped>();
    steps::<Nystrom, Damped>();
    steps::<LowerOrder<Gauss>, Damped>();
    // A splitting of higher order loses it on a general H.
    steps::<ForestRuth, General>();
    steps::<Nystrom, General>();
    // Constraints are for methods with such steps.
    steps::<Gauss, Holonomic<Separable>>();
    steps::<Gauss, Nonholonomic<Separable>>();
    steps::<Midpoint, Holonomic<Separable>>();
    steps::<Lobatto, Nonholonomic<Separable>>();
    steps::<ForestRuth, Holonomic<Separable>>();
    steps::<ForestRuth, Nonholonomic<Separable>>();
    steps::<Nystrom, Holonomic<General>>();
    steps::<LowerOrder<Gauss>, Holonomic<General>>();
    // Friction is part of the force of a system with constraints.
    class::<Holonomic<Damped>>();
    class::<Nonholonomic<Damped>>();
    // Variable steps and correctors are for symmetric methods.
    symmetric::<Ruth, Separable>();
    symmetric::<Euler, General>();
    symmetric::<ForestRuth, General>();
    // Flows are for splittings, and compositions of other steps are compositions of Störmer–Verlet.
    splits::<Gauss>();
    composes::<ForestRuth>();
    composes::<Gauss>();
}
