#![allow(dead_code, unused_imports)]

pub mod dual;
pub mod methods;
pub mod systems;

use symplectic::at_run_time::{RunTimeCoefficients, RunTimeTableau};
use symplectic::{Error, Integrator, Method, ProvedFor, State, System, Vector};

/// The state at `end` after `steps` equal steps.
pub fn run<M, S, V>(
    method: M,
    system: S,
    start: State<V>,
    end: f64,
    steps: u32,
) -> Result<State<V>, Error>
where
    M: Method + ProvedFor<S::Class>,
    S: System<V>,
    V: Vector,
{
    let size = (end - start.time) / f64::from(steps);
    let mut integrator = Integrator::new(method, system, start, size)?;
    integrator.integrate_to(end)?;
    assert_eq!(integrator.steps(), u64::from(steps));
    Ok(integrator.into_state())
}

/// The largest difference of two states in a component.
pub fn distance<V: Vector<Scalar = f64>>(a: &State<V>, b: &State<V>) -> f64 {
    let pairs = |a: &V, b: &V| -> f64 {
        let differences = a
            .as_slice()
            .iter()
            .zip(b.as_slice())
            .map(|(a, b)| (a - b).abs());
        differences.fold(0.0, f64::max)
    };
    pairs(&a.q, &b.q).max(pairs(&a.p, &b.p))
}

/// The coefficients of an emitted method as doubles.
pub fn coefficients<M: Method>(_method: M) -> RunTimeCoefficients {
    M::COEFFICIENTS.into()
}

/// An emitted method as a tableau at run time.
pub fn tableau<M: Method>(method: M) -> RunTimeTableau {
    RunTimeTableau::new(M::NAME, &coefficients(method), M::ORDERS).expect(M::NAME)
}
