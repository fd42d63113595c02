//! Adapters of systems for the crates `ode_solvers` and `differential-equations`.

use differential_equations::prelude::ODE;
use ode_solvers::{Dop853, OutputType, SVector as PeerVector, System};
use symplectic::nalgebra::SVector;

/// A system with `N` components as `M = 2N` first-order equations.
pub struct Equations<S, const N: usize>(pub S);

impl<S: symplectic::System<SVector<f64, N>>, const N: usize> Equations<S, N> {
    fn slopes(&self, time: f64, y: &[f64], slopes: &mut [f64]) {
        let (q, p) = (vector(&y[..N]), vector(&y[N..2 * N]));
        let (mut velocity, mut force) = (SVector::zeros(), SVector::zeros());
        self.0.velocity(time, &q, &p, &mut velocity);
        self.0.force(time, &q, &p, &mut force);
        slopes[..N].copy_from_slice(velocity.as_slice());
        slopes[N..2 * N].copy_from_slice(force.as_slice());
    }
}

fn vector<const N: usize>(values: &[f64]) -> SVector<f64, N> {
    SVector::from_fn(|i, _| values[i])
}

impl<S, const N: usize, const M: usize> System<f64, PeerVector<f64, M>> for &Equations<S, N>
where
    S: symplectic::System<SVector<f64, N>>,
{
    fn system(&self, time: f64, y: &PeerVector<f64, M>, slopes: &mut PeerVector<f64, M>) {
        self.slopes(time, y.as_slice(), slopes.as_mut_slice());
    }
}

impl<S, const N: usize, const M: usize> ODE<f64, [f64; M]> for Equations<S, N>
where
    S: symplectic::System<SVector<f64, N>>,
{
    fn diff(&self, time: f64, y: &[f64; M], slopes: &mut [f64; M]) {
        self.slopes(time, y, slopes);
    }
}

/// In this trait position and momentum are vectors with the length of the state.
impl<S, const N: usize, const M: usize> differential_equations::ode::Hamiltonian<f64, [f64; M]>
    for Equations<S, N>
where
    S: symplectic::System<SVector<f64, N>>,
{
    fn velocity(&self, time: f64, q: &[f64; M], p: &[f64; M], velocity: &mut [f64; M]) {
        let mut found = SVector::zeros();
        self.0
            .velocity(time, &vector(&q[..N]), &vector(&p[..N]), &mut found);
        velocity[..N].copy_from_slice(found.as_slice());
    }

    fn force(&self, time: f64, q: &[f64; M], p: &[f64; M], force: &mut [f64; M]) {
        let mut found = SVector::zeros();
        self.0
            .force(time, &vector(&q[..N]), &vector(&p[..N]), &mut found);
        force[..N].copy_from_slice(found.as_slice());
    }
}

/// DOP853 from `ode_solvers`, from time 0, with the same relative and absolute tolerance.
pub fn dop853<S, const N: usize, const M: usize>(
    equations: &Equations<S, N>,
    start: [f64; M],
    end: f64,
    tolerance: f64,
    most_steps: u32,
) -> Dop853<f64, PeerVector<f64, M>, &Equations<S, N>>
where
    S: symplectic::System<SVector<f64, N>>,
{
    Dop853::from_param(
        equations,
        0.0,
        end,
        end,
        PeerVector::<f64, M>::from(start),
        tolerance,
        tolerance,
        // The defaults, except for the limit on the steps and without intermediate output.
        0.9,
        0.0,
        0.333,
        6.0,
        end,
        0.0,
        most_steps,
        1000,
        OutputType::Sparse,
    )
}
