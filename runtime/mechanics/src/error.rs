//! Errors of discrete mechanics and of rigid bodies.

use core::fmt;

use symplectic_core::Quantity;
use symplectic_core::inside::{OfTheCore, Short, debug_by_message};

debug_by_message!(Error);

/// The error type of discrete Lagrangians, generating functions and rigid bodies. After an error the state of the integrator is that of
/// the last successful step.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// An error that every integrator can return.
    #[error(transparent)]
    Core(#[from] symplectic_core::Error),

    /// The energy depends on time and the nodes c and c̃ of the method differ: there is no single Hamiltonian for a
    /// generating function.
    #[error(
        "the energy depends on time, and stage {stage} has the time {position_time} for the position and \
         {momentum_time} for the momentum; take a method with c = c̃",
        position_time = Short(*.position_time),
        momentum_time = Short(*.momentum_time)
    )]
    DifferentNodes {
        /// The stage, from 1.
        stage: usize,
        /// `t0 + c_i h`.
        position_time: f64,
        /// `t0 + c̃_i h`.
        momentum_time: f64,
    },

    /// A step of a system of class `friction::Damped` has no stages.
    #[error(
        "steps with friction have no stages, because their kicks are exact flows; write the friction as a force, in a formula \
         `force: {{ x = -gamma px }}`"
    )]
    NoStages,

    /// Newton's iteration for the end of a step of a discrete Lagrangian or a rigid body does not converge.
    #[error(
        "step {step} of size {step_size} at time {time}: no end of the step was found in {iterations} iterations (last relative change \
         {residual:e}); take a smaller step",
        time = Short(*.time),
        step_size = Short(*.step_size)
    )]
    NoEndOfStep {
        /// Time at the start of the step.
        time: f64,
        /// Step size.
        step_size: f64,
        /// Number of the step, from 1.
        step: u64,
        /// Relative change in the last iteration.
        residual: f64,
        /// Iterations made.
        iterations: u32,
    },

    /// The equations of a step of a Lagrangian, discrete or continuous, are singular: at an iterate, because the step is too large, or
    /// everywhere, because the momentum at the start of the step does not determine the position at its end.
    #[error(
        "step {step} of size {step_size} at time {time}: the equations of the step do not determine component {component} at its end \
         (pivot {pivot:e}); take a smaller step, or a Lagrangian that determines every velocity. If ∂²L/∂v∂v is singular, \
         `primary_constraints` returns the constraints on the momenta, and `DiracIntegrator` steps such a Lagrangian",
        time = Short(*.time),
        step_size = Short(*.step_size)
    )]
    IrregularLagrangian {
        /// Time at the start of the step.
        time: f64,
        /// Step size.
        step_size: f64,
        /// Number of the step, from 1.
        step: u64,
        /// The component of the position that is not determined, from 0.
        component: usize,
        /// The pivot, relative to the largest entry of its column.
        pivot: f64,
    },

    /// The discrete Lagrangian of a composition is not self-adjoint.
    #[error(
        "Ld(q0, q1, h) + Ld(q1, q0, −h) is {defect:e} instead of 0: the discrete Lagrangian is not self-adjoint, so its compositions have \
         order 1; take a self-adjoint one, such as the mean of Ld and −Ld(q1, q0, −h), or `VariationalSteps::run`"
    )]
    NotSelfAdjoint {
        /// The sum, for the path from the start to a point nearby.
        defect: f64,
    },

    /// The basis of a Galerkin method does not contain the constants, so that it excludes uniform motion.
    #[error(
        "the basis of {method} does not contain the constants: add 1 to it, or take the tableau with `LagrangianSteps::run`"
    )]
    NoConstants {
        /// Name of the method.
        method: &'static str,
    },

    /// The Lagrangian has a singular `∂²L/∂v∂v`, and steps of the method leave its primary constraints on the momenta.
    #[error(
        "the Lagrangian is degenerate: ∂L/∂v does not determine component {component} of the velocity, and steps of {method} leave the \
         primary constraint on this component of p, which `primary_constraints` returns; take `DiracIntegrator`, or, if L is a(q)·v − H(q) \
         with a linear in q, a Gauss method with as many functions as nodes"
    )]
    DegenerateLagrangian {
        /// Name of the method.
        method: &'static str,
        /// The component of the velocity, from 0.
        component: usize,
    },

    /// The momentum at the start violates a primary constraint of the Lagrangian.
    #[error(
        "no velocity has this momentum: component {component} violates a primary constraint by {value:e}; start from \
         `momentum_of_velocity(&system, time, &q, &v)`; `primary_constraints` returns the constraints"
    )]
    PrimaryConstraint {
        /// The component of the momentum that violates it, from 0, given the other components.
        component: usize,
        /// Its deviation.
        value: f64,
    },

    /// A Lagrangian has no velocity for the given momentum.
    #[error(
        "no velocity was found for this momentum at time {time}{}; take a Lagrangian whose ∂²L/∂v∂v is regular, and a momentum in the range of ∂L/∂v",
        Undetermined(*component),
        time = Short(*.time)
    )]
    NoVelocity {
        /// The time.
        time: f64,
        /// The component that ∂L/∂v does not determine, from 0; `None` if Newton's iteration does not converge.
        component: Option<usize>,
    },

    /// No step has the given ends, or they do not determine its start.
    #[error(
        "no {what} at the start of the step from time {time} was found for the given ends{} (relative residual {residual:e}); take another \
         step size, or a generating function of another type",
        Undetermined(*component),
        time = Short(*.time)
    )]
    NoStart {
        /// Time at the start of the step.
        time: f64,
        /// The unknown part of the start: position or momentum.
        what: Quantity,
        /// The component that the ends do not determine, from 0; `None` if Newton's iteration does not converge.
        component: Option<usize>,
        /// Distance of the last iterate from the given end, relative to the ends.
        residual: f64,
    },

    /// The position at the end of a step of a degenerate Lagrangian is not determined.
    #[error(
        "step {step} of size {step_size} at time {time}: component {component} of the position at the end of the step is not determined; \
         take a Lagrangian that depends on that component, or, with another rule, `Trapezoid` or `AtEnd`",
        time = Short(*.time),
        step_size = Short(*.step_size)
    )]
    UndeterminedPosition {
        /// Time at the start of the step.
        time: f64,
        /// Step size.
        step_size: f64,
        /// Number of the step, from 1.
        step: u64,
        /// The component, from 0.
        component: usize,
    },

    /// The equations of a step of a degenerate Lagrangian contradict each other.
    #[error(
        "step {step} of size {step_size} at time {time}: the conditions on the step contradict each other; the condition for {what} {index} \
         is violated by {value:e}; start where the conditions on positions hold, take the rule `AtEnd` for the first step; for \
         L = a(q)·v − H(q) take the rule `Midpoint` if a is linear, and otherwise a `DiscreteLagrangian`",
        time = Short(*.time),
        step_size = Short(*.step_size)
    )]
    ContradictoryStep {
        /// Time at the start of the step.
        time: f64,
        /// Step size.
        step_size: f64,
        /// Number of the step, from 1.
        step: u64,
        /// What the violated condition belongs to: a component of the momentum, or a constraint.
        what: Quantity,
        /// Its index, from 0.
        index: usize,
        /// The contradiction.
        value: f64,
    },

    /// The derivative of a point transformation is singular: momenta have no image.
    #[error(
        "the derivative of the map is singular: its component {component} depends on those before it (pivot {pivot:e}); keep away from \
         this position, or take other coordinates there"
    )]
    SingularTransformation {
        /// The component of the image, from 0.
        component: usize,
        /// Its pivot in the elimination, relative to the largest entry of its gradient.
        pivot: f64,
    },

    /// β of Newmark's method is not finite.
    #[error(
        "β of Newmark's method is {value}; it must be finite, and 1/4 or more for steps of any size",
        value = Short(*.value)
    )]
    NewmarkBeta {
        /// The β given.
        value: f64,
    },

    /// The velocity is not `M⁻¹p` with a constant M; Newmark's method requires the acceleration `M⁻¹ force`.
    #[error(
        "|velocity[{component}]| is {velocity}; a velocity linear in p and independent of time would give {linear}: Newmark's method is for \
         H = pᵀM⁻¹p/2 + V(t, q) with a constant M; take Störmer–Verlet or Gauss for this system",
        velocity = Short(*.velocity),
        linear = Short(*.linear)
    )]
    NewmarkMasses {
        /// The component of the velocity, from 0.
        component: usize,
        /// Its size.
        velocity: f64,
        /// The size that it would have if it were linear in the momentum.
        linear: f64,
    },

    /// No position was found for a shifted position of Newmark's method.
    #[error(
        "at time {time} no position q with q − βh² a(q) = x was found (last relative change {residual:e}); take a smaller step",
        time = Short(*.time)
    )]
    NewmarkPosition {
        /// The time.
        time: f64,
        /// Relative change in the last iteration with a regular matrix; NaN if there was none.
        residual: f64,
    },

    /// A rigid body turns by π or more in a step, so that the rotation of the step is not unique.
    #[error(
        "step {step} of size {step_size} at time {time}: the body turns by {angle} rad, but a step must turn by less than π; take a smaller \
         step",
        time = Short(*.time),
        step_size = Short(*.step_size),
        angle = Short(*.angle)
    )]
    HalfTurn {
        /// Time at the start of the step.
        time: f64,
        /// Step size.
        step_size: f64,
        /// Number of the step, from 1.
        step: u64,
        /// The angle in radians.
        angle: f64,
    },

    /// A principal moment of inertia is not finite and positive.
    #[error("moment of inertia {axis} is {value}; all three must be finite and positive",
        value = Short(*.value)
    )]
    MomentOfInertia {
        /// The principal axis, from 0.
        axis: usize,
        /// The moment given.
        value: f64,
    },

    /// No step size near the previous one conserves the discrete energy: the curvature c of the orbit is about to
    /// change sign.
    #[error(
        "step {step} at time {time}: no step between half and twice the size {step_size} of the step before conserves the discrete energy \
         here (curvature {curvature:e}); continue with `VariationalIntegrator` (constant steps)",
        time = Short(*.time),
        step_size = Short(*.step_size)
    )]
    NoEnergyStep {
        /// Time at the start of the step.
        time: f64,
        /// Size of the previous step.
        step_size: f64,
        /// Number of the step, from 1.
        step: u64,
        /// The curvature c.
        curvature: f64,
    },
}

impl Error {
    /// Whether it is the error of a step that may succeed if it is shorter.
    #[must_use]
    pub const fn depends_on_the_size(&self) -> bool {
        match self {
            Self::Core(error) => error.depends_on_the_size(),
            Self::NoEndOfStep { .. } | Self::IrregularLagrangian { .. } | Self::HalfTurn { .. } => {
                true
            }
            _ => false,
        }
    }
}

impl OfTheCore for Error {
    fn of_the_core(&self) -> Option<&symplectic_core::Error> {
        match self {
            Self::Core(error) => Some(error),
            _ => None,
        }
    }
}

/// The undetermined component, or nothing.
struct Undetermined(Option<usize>);

impl fmt::Display for Undetermined {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.map_or(Ok(()), |component| {
            write!(
                formatter,
                ": ∂L/∂v does not determine component {component}"
            )
        })
    }
}
