//! Formulas, chains and ensembles of them: all is inlined.

use std::error::Error;
use std::hint::black_box;
use std::ops::ControlFlow;

use symplectic::at_run_time::{RunTimeCoefficients, RunTimeTableau, TableauError};
use symplectic::ensemble::Ensemble;
use symplectic::nalgebra::DVector;
use symplectic::{Compensated, Integrator, Method, Plain, State};

symplectic::tableau! {
    Verlet { base: velocity-verlet }
    Lobatto3 { basis: polynomial(3), nodes: lobatto(3) }
    Gauss4 { basis: polynomial(4), nodes: gauss(4) }
    Gauss6 { basis: polynomial(6), nodes: gauss(6) }
}

symplectic::hamiltonian! {
    /// Separable, with elementary functions.
    Pendulum { w: 1.0 }
    q: [x], p: [y];
    H = y^2/2 - w cos(x) + exp(-x^2)
}

symplectic::hamiltonian! {
    /// Not separable.
    DoublePendulum
    q: [x, y], p: [u, v];
    H = (u^2 + 2 v^2 - 2 u v cos(x - y))/(2 (1 + sin(x - y)^2)) - 2 cos(x) - cos(y)
}

symplectic::hamiltonian! {
    /// With friction.
    Damped
    q: [x], p: [y];
    H = y^2/2 - cos(x)
    force: { x = -0.1 y }
}

symplectic::hamiltonian! {
    /// A chain.
    Fput
    q: [..], p: [..]; bonds: walls;
    H = sum(i: p[i]^2/2) + sum(bonds d: d^2/2 + d^3/12)
}

/// A method as one that is known only when the program runs.
fn at_run_time<M: Method>() -> Result<RunTimeTableau, TableauError> {
    let coefficients: RunTimeCoefficients = M::COEFFICIENTS.into();
    RunTimeTableau::new(M::NAME, &coefficients, M::ORDERS)
}

fn main() -> Result<(), Box<dyn Error>> {
    let one = State::from_arrays(0.0, [1.0], [0.0]);
    let two = State::from_arrays(0.0, [1.0, 0.5], [0.0, 0.0]);
    let ring = State::new(
        0.0,
        DVector::from_fn(64, |i, _| 0.01 * i as f64),
        DVector::<f64>::zeros(64),
    );
    macro_rules! alone {
        ($($method:expr, $system:expr, $start:expr;)+) => {$(
            let mut integrator = Integrator::new($method, $system, $start.clone(), 0.01)?;
            integrator.integrate_to(1.0)?;
            black_box(integrator.state());
        )+};
    }
    alone! {
        Lobatto3, Pendulum::default(), one;
        Gauss6, Pendulum::default(), one;
        Gauss4, DoublePendulum, two;
        Verlet, Fput, ring;
        Gauss4, Fput, ring;
    }
    let mut plain = Integrator::plain(Gauss4, Pendulum::default(), one.clone(), 0.01)?;
    plain.integrate_to(1.0)?;
    black_box(plain.state());
    macro_rules! together {
        ($($ensemble:expr;)+) => {$(
            let ensemble = $ensemble;
            ensemble.integrate_to(1.0, |row| {
                black_box(row.state);
                ControlFlow::Continue(())
            });
            ensemble.integrate_at(
                &[0.5, 1.0],
                |_| 0.0,
                |sum, state| *sum += state.q[0],
                |row| {
                    black_box(row.output);
                    ControlFlow::Continue(())
                },
            );
        )+};
    }
    let (ones, twos) = (vec![one; 40], vec![two; 40]);
    together! {
        Ensemble::new(Verlet, Pendulum::default(), ones.clone(), 0.01)?;
        Ensemble::new(Gauss4, Damped, ones.clone(), 0.01)?;
        Ensemble::new(Gauss4, DoublePendulum, twos, 0.01)?;
        Ensemble::<RunTimeTableau, _, _, Compensated>::with_summation(at_run_time::<Lobatto3>()?,
            [(Pendulum::default(), ones.clone())],
            0.01,
        )?;
        Ensemble::<RunTimeTableau, _, _, Plain>::with_summation(at_run_time::<Verlet>()?,
            [(Pendulum::default(), ones)],
            0.01,
        )?;
    }
    Ok(())
}
