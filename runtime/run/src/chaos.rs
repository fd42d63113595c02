//! Indicators of chaos: MEGNO and the largest Lyapunov exponent.

use std::ops::ControlFlow;

use symplectic::at_run_time::RunTimeTableau;
use symplectic::emitted::Solver;
use symplectic::ensemble::{Ensemble, Row};
use symplectic::system::{Class, Conservative};
use symplectic::tangent::{Error, Megno, Tangent};
use symplectic::{Hamiltonian, Integrator, State, Summation};
use symplectic_tape::Formula;

use crate::integrate::{Keep, States, Vector};
use crate::{Run, random};

/// The length of a displacement of an explicit method, relative to the state: it may grow by 10⁵⁸⁰.
const SMALL: f64 = 1e-280;

impl Run<'_> {
    /// Whether the run computes indicators of chaos.
    pub(super) fn has_chaos(&self) -> bool {
        self.setup.megno.is_some()
    }

    /// A system with its variational equations, and its starts with displacements.
    pub(super) fn tangents<C: Class + Conservative>(
        &self,
        system: Formula<C>,
        starts: States,
    ) -> (Tangent<Formula<C>>, States) {
        let is_explicit = C::SEPARABLE && self.method.tableau.is_explicit();
        let displaced = |start: State<Vector>| {
            let (q, p) = (&start.q, &start.p);
            let largest = q.amax().max(p.amax());
            let length = match largest > 0.0 {
                true => largest,
                false => 1.0,
            };
            let length = match is_explicit {
                // Not subnormal.
                true => (SMALL * length).max(1e-290),
                false => length,
            };
            // A direction without any symmetry, the same in every run.
            let direction = |from: usize| {
                let part = |k: usize, _| random::normal(0, (from + k) as u64);
                Vector::from_fn(q.len(), part)
            };
            let (dq, dp) = (direction(0), direction(q.len()));
            let scale = length / dq.norm().hypot(dp.norm());
            State::new(
                start.time,
                joined(q, &(dq * scale)),
                joined(&(dp * scale), p),
            )
        };
        let starts = starts.into_iter().map(displaced).collect();
        (Tangent::new(system), starts)
    }

    /// Integrates to the end; the output of a trajectory consists of the mean MEGNO and the exponent.
    pub(super) fn chaos<
        C: Class + Conservative,
        R: Summation,
        N: Solver<Vector, Tangent<Formula<C>>>,
    >(
        &self,
        ensemble: &mut Ensemble<RunTimeTableau, Tangent<Formula<C>>, Vector, R, N>,
        keep: Keep<'_>,
    ) where
        Formula<C>: Hamiltonian<Class = C, Vector<f64> = Vector>,
    {
        let end = self.end();
        let work =
            |output: &mut Vec<f64>,
             run: &mut Integrator<RunTimeTableau, Tangent<Formula<C>>, Vector, R, N>| {
                let mut megno = Megno::new(run.state())?;
                let ended = run.integrate_while(end, |progress| {
                    megno.see(progress.state);
                    ControlFlow::<()>::Continue(())
                });
                *output = vec![megno.mean(), megno.lyapunov_exponent()];
                ended?;
                Ok(())
            };
        let show = |row: Row<Vector, Vec<f64>, Error>| {
            let state = original(&row.state);
            keep(Row { state, ..row }.into())
        };
        ensemble.each_as(Ok::<_, Error>, |_| Vec::new(), work, show);
    }
}

fn joined(first: &Vector, second: &Vector) -> Vector {
    let parts = first.iter().chain(second.iter());
    Vector::from_iterator(first.len() + second.len(), parts.copied())
}

/// A state without its displacement.
pub(super) fn original(state: &State<Vector>) -> State<Vector> {
    let half = state.q.len() / 2;
    State::new(
        state.time,
        state.q.rows(0, half).into_owned(),
        state.p.rows(half, half).into_owned(),
    )
}
