//! Errors.

use symplectic_core::inside::{Short, debug_by_message};

debug_by_message!(Error);

/// The error type of steps of variable size and of tangent maps. After an error the state of an integrator is that of the last successful step.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An error of the core, such as a step of size zero or a state that is not finite.
    #[error(transparent)]
    Core(#[from] symplectic_core::Error),

    /// The density of variable steps, about 1/monitor, is no longer positive: the monitor changes too much within a
    /// step.
    #[error(
        "step {step} at time {time}: the step density z is {density}, and there is no step of size ε/z; take a smaller ε, or a monitor \
         that changes less within a step",
        time = Short(*.time),
        density = Short(*.density)
    )]
    StepDensity {
        /// Time at the start of the step.
        time: f64,
        /// Number of the step, from 1.
        step: u64,
        /// The density z.
        density: f64,
    },

    /// The velocity is not `M⁻¹p` with a constant M; the logarithmic Hamiltonian requires `T = p·M⁻¹p/2`.
    #[error(
        "|velocity[{component}]| is {velocity}; a velocity linear in p and independent of time would give {linear}: the logarithmic \
         Hamiltonian is for H = pᵀM⁻¹p/2 + U(t, q) with a constant M; take `Poincare` or `AdaptiveSteps::run` for this system",
        velocity = Short(*.velocity),
        linear = Short(*.linear)
    )]
    LogarithmicMasses {
        /// The component of the velocity, from 0.
        component: usize,
        /// Its size.
        velocity: f64,
        /// The size that it would have if it were linear in the momentum.
        linear: f64,
    },

    /// The displacement whose growth is requested is zero.
    #[error(
        "the displacement is zero and remains zero; choose a nonzero one in a general direction"
    )]
    NoDisplacement,
}
