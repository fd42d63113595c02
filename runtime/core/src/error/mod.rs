//! Errors.

mod constraint_name;
pub(crate) mod debug;
pub(crate) mod phrases;
mod quantity;

pub use constraint_name::ConstraintName;
pub use quantity::Quantity;

use debug::debug_by_message;
use phrases::{AtStage, Divergence, Entries, Named, Short};

debug_by_message!(Error);

/// The error type of integrators. After an error the state of the integrator is that of the last successful step.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The iteration for the coupled stages diverged, or converged too slowly. Take a smaller step, or for a stiff
    /// system `solver::Newton` instead of a fixed-point iteration.
    #[error(
        "step {step} of size {step_size} at time {time}: the stages {}; take a smaller step{}",
        Divergence { residual: *.residual, iterations: *.iterations },
        if *.newton_may_help { ", or, with the feature `newton`, `by_newton()` for a stiff system" } else { "" },
        time = Short(*.time),
        step_size = Short(*.step_size)
    )]
    NoConvergence {
        /// Time at the start of the step.
        time: f64,
        /// Step size.
        step_size: f64,
        /// Number of the step, from 1.
        step: u64,
        /// Relative change of the stages in the last sweep with a finite change; infinite if there was none.
        residual: f64,
        /// Sweeps made.
        iterations: u32,
        /// Whether Newton's iteration may converge: a fixed-point iteration failed, and the system has no constraints.
        newton_may_help: bool,
    },

    /// The iteration for the coupled stages stagnates far above rounding errors, because evaluations are noisy.
    #[error(
        "step {step} of size {step_size} at time {time}: after {iterations} iterations the change of the stages stagnates at {residual:e}; \
         the velocity or the force has larger errors than rounding, or jumps: evaluate it more precisely, take a smaller step, or take \
         `Plain` sums and set a tolerance above that change",
        time = Short(*.time),
        step_size = Short(*.step_size)
    )]
    Stagnation {
        /// Time at the start of the step.
        time: f64,
        /// Step size.
        step_size: f64,
        /// Number of the step, from 1.
        step: u64,
        /// Relative change of the stages in the last sweep.
        residual: f64,
        /// Sweeps made.
        iterations: u32,
    },

    /// An evaluation of the system, or the result of the step, is not finite.
    #[error(
        "step {step} of size {step_size} at time {time}: the {what}{} is not finite; take a smaller step, or keep \
         the state where the system is defined",
        AtStage(*.stage),
        time = Short(*.time),
        step_size = Short(*.step_size)
    )]
    NonFinite {
        /// Time at the start of the step.
        time: f64,
        /// Step size.
        step_size: f64,
        /// Number of the step, from 1.
        step: u64,
        /// What is not finite.
        what: Quantity,
        /// Number of the stage, from 1, counting only stages that are stored; `None` for the result of the step.
        stage: Option<usize>,
    },

    /// A linear system of the Newton iteration for the coupled stages has a pivot that is zero or not finite.
    #[error(
        "step {step} of size {step_size} at time {time}: a matrix of the Newton iteration is singular; take a smaller step",
        time = Short(*.time),
        step_size = Short(*.step_size)
    )]
    SingularMatrix {
        /// Time at the start of the step.
        time: f64,
        /// Step size.
        step_size: f64,
        /// Number of the step, from 1.
        step: u64,
    },

    /// An evaluation of the system changed the dimension of its output vector.
    #[error(
        "step {step} of size {step_size} at time {time}: the {what}{} has dimension {found} instead \
         of {expected}; the system must write into the given vector without resizing it",
        AtStage(*.stage),
        time = Short(*.time),
        step_size = Short(*.step_size)
    )]
    EvaluationDimension {
        /// Time at the start of the step.
        time: f64,
        /// Step size.
        step_size: f64,
        /// Number of the step, from 1.
        step: u64,
        /// The quantity that has the wrong dimension.
        what: Quantity,
        /// Number of its stage, from 1, counting only stages that are stored; `None` outside the stages.
        stage: Option<usize>,
        /// Dimension of the state.
        expected: usize,
        /// Dimension of the evaluation.
        found: usize,
    },

    /// An evaluation of the system at a given state changed the dimension of its output vector.
    #[error(
        "the {what} of the state at time {time} has dimension {found} instead of {expected}; the system must write into the given \
         vector without resizing it",
        time = Short(*.time)
    )]
    ResizedEvaluation {
        /// The time of the state.
        time: f64,
        /// The quantity that has the wrong dimension.
        what: Quantity,
        /// Dimension of the state.
        expected: usize,
        /// Dimension of the evaluation.
        found: usize,
    },

    /// Time, position or momentum of a given state is not finite.
    #[error(
        "the {what} of the state is not finite; start from finite values, and check the parameters of the system"
    )]
    NonFiniteState {
        /// What is not finite.
        what: Quantity,
    },

    /// Position and momentum of a given state differ in dimension, or the state differs in dimension from the state
    /// that it replaces.
    #[error(
        "the position has dimension {position} and the momentum {momentum}; both must have the same, \
         and a new state that of the one it replaces"
    )]
    Dimension {
        /// Dimension of the position.
        position: usize,
        /// Dimension of the momentum.
        momentum: usize,
    },

    /// A parameter of a formula, or one of its entries, is NaN.
    #[error("the parameter `{parameter}` is NaN or contains NaN: give numbers")]
    ParameterNotANumber {
        /// Its name.
        parameter: &'static str,
    },

    /// The length of an array parameter does not fit the state or a list of pairs.
    #[error(
        "the parameter `{parameter}` has {}; it needs {expected}: give an entry for each body or pair, or start from a state with \
         other dimensions",
        Entries(*.found)
    )]
    ParameterLength {
        /// Name of the parameter.
        parameter: &'static str,
        /// Its length; of a matrix, the length of the first wrong dimension.
        found: usize,
        /// The length needed.
        expected: usize,
    },

    /// A pair in a parameter has the index of a body that does not exist.
    #[error(
        "pair {index} of the parameter `{parameter}` is {pair:?}, but there are {bodies} bodies; indices count from 0 and must be less \
         than {bodies}"
    )]
    PairOutOfRange {
        /// Name of the parameter.
        parameter: &'static str,
        /// Index of the pair in the list, from 0.
        index: usize,
        /// The pair.
        pair: (usize, usize),
        /// Number of bodies in the state.
        bodies: usize,
    },

    /// The dimension of the state is not a multiple of the number of components of each body.
    #[error(
        "the state has dimension {dimension}, which is not a multiple of {factor}; give {factor} components for each body"
    )]
    DimensionFactor {
        /// Dimension of the position.
        dimension: usize,
        /// Number of components for each body.
        factor: usize,
    },

    /// The formula names a body that the state does not have.
    #[error(
        "the state has {bodies} bodies, but the formula needs at least {least}; start from a state with more"
    )]
    TooFewBodies {
        /// Number of bodies in the state.
        bodies: usize,
        /// The smallest number that the formula allows.
        least: usize,
    },

    /// The step size is zero or not finite.
    #[error("the step size is {value}; it must be finite and not zero",
        value = Short(*.value)
    )]
    StepSize {
        /// The step size given.
        value: f64,
    },

    /// The tolerance of an iteration is negative or not finite.
    #[error("the tolerance is {value}; it must be finite and not negative",
        value = Short(*.value)
    )]
    Tolerance {
        /// The tolerance given.
        value: f64,
    },

    /// The end time is not finite, or its distance from the present time overflows.
    #[error(
        "the end time is {value}; it must be finite, and so must its distance from the present time",
        value = Short(*.value)
    )]
    EndTime {
        /// The end time given.
        value: f64,
    },

    /// The integration needs 2⁵³ steps or more; smaller counts are exact.
    #[error(
        "from time {time} to {end} in steps of size {step_size}: this takes more than 2^53 steps; take larger ones",
        time = Short(*.time),
        step_size = Short(*.step_size),
        end = Short(*.end)
    )]
    StepCount {
        /// Time of the state.
        time: f64,
        /// End time given.
        end: f64,
        /// Step size.
        step_size: f64,
    },

    /// The order of the method holds for quadratic kinetic energy only, and the velocity of the system is not linear in
    /// the momentum.
    #[error(
        "`{method}` has order {order} where the kinetic energy is pᵀM⁻¹p/2 with a constant M, and order {lower_order} for other separable systems; \
         |velocity[{component}]| is {velocity}; a velocity linear in p would give {linear}: take a method for separable systems, or write \
         `.accept_lower_order()` after the method",
        velocity = Short(*.velocity),
        linear = Short(*.linear)
    )]
    NotQuadraticKinetic {
        /// Name of the method.
        method: &'static str,
        /// Its order for quadratic kinetic energy.
        order: u32,
        /// Its order for other separable systems.
        lower_order: u32,
        /// The component of the velocity, from 0.
        component: usize,
        /// Its size.
        velocity: f64,
        /// The size that it would have if it were linear in the momentum.
        linear: f64,
    },

    /// The system is not separable, but a tableau at run time has its order, or is symplectic, for separable
    /// Hamiltonians only.
    #[error(
        "the tableau has order {order} for separable Hamiltonians and {lower_order} for others, or is symplectic for separable ones only; \
         write the system as a separable one, take another tableau, or call `accept_lower_order`"
    )]
    SeparableTableau {
        /// Its order for separable Hamiltonians.
        order: u32,
        /// Its order for other Hamiltonians.
        lower_order: u32,
    },

    /// A tableau at run time has no steps for the constraints of the system.
    #[error(
        "the tableau has no steps for these constraints: give them by `with_constrained_steps`; methods that are `constrained` have \
         steps for holonomic constraints, such as `basis: polynomial(2), nodes: lobatto(2)`, and those that are `nonholonomic` for \
         non-holonomic ones, such as `basis: polynomial(1), nodes: gauss(1)`"
    )]
    NoConstrainedSteps,

    /// A system declares unit masses, but its velocity differs from the momentum.
    #[error(
        "|velocity[{component}]| is {velocity} where |p[{component}]| is {momentum}: leave out `Masses::Unit`, or let `velocity` copy the \
         momentum",
        velocity = Short(*.velocity),
        momentum = Short(*.momentum)
    )]
    NotUnitMasses {
        /// The component, from 0.
        component: usize,
        /// The size of the velocity there.
        velocity: f64,
        /// The size of the momentum there: that of the state, or another at which the velocity was tested.
        momentum: f64,
    },

    /// A system of the class [`Separable`](crate::Separable) whose velocity depends on the position, or whose force on the momentum.
    #[error(
        "component {component} of the {what} depends on the {argument}, but the system has `type Class = Separable`: write `General`",
        argument = match what { Quantity::Velocity => "position", _ => "momentum" }
    )]
    NotSeparable {
        /// Velocity or force.
        what: Quantity,
        /// The component, from 0.
        component: usize,
    },

    /// A system writes an applied force, but does not declare it by `FORCED`.
    #[error(
        "component {component} of the applied force is not zero, but would be ignored: add `const FORCED: bool = true`"
    )]
    NotForced {
        /// The component, from 0.
        component: usize,
    },

    /// The system has no energy; the generating function needs it.
    #[error("the system gives no energy; implement `energy`, or add a closure by `with_energy`")]
    NoEnergy,

    /// There is no last step for dense output: no step has led to the present state.
    #[error("no step has led to the present state; take a step first")]
    NoStep,

    /// The requested time is not in the last step.
    #[error("the time {time} is not in the last step, from {start} to {end}",
        time = Short(*.time),
        start = Short(*.start),
        end = Short(*.end)
    )]
    OutsideStep {
        /// The time given.
        time: f64,
        /// Time at the start of the step.
        start: f64,
        /// Time at the end of the step.
        end: f64,
    },

    /// An output time is not finite, precedes the previous output time or precedes the last step.
    #[error(
        "the output time {time} is not finite or comes before {before}; give times in the direction of the steps, none \
         before the last step",
        time = Short(*.time),
        before = Short(*.before)
    )]
    OutputTime {
        /// The time given.
        time: f64,
        /// The previous output time, or the earliest possible time.
        before: f64,
    },

    /// An output time is after the end of the integration.
    #[error("the output time {time} is after the end {end}; leave it out, or integrate to it",
        time = Short(*.time),
        end = Short(*.end)
    )]
    OutputAfterEnd {
        /// The time given.
        time: f64,
        /// End time given.
        end: f64,
    },

    /// The function of an [`Event`](crate::Event) is NaN.
    #[error("the event function is NaN at time {time}",
        time = Short(*.time)
    )]
    EventValue {
        /// The time.
        time: f64,
    },

    /// Events accumulate, as impacts do when a body comes to rest on a wall: they follow each other more closely than time or the state can
    /// resolve, or a thousand events in a row are less than 1/16384 of a step apart. The present state is that at the last event.
    #[error(
        "events accumulate at time {time}: after {count} events in a row, each within 1/16384 of a step, the search ends at function \
         {index}; stop there, constrain the state to the wall, or take a smaller step if the events are real",
        time = Short(*.time)
    )]
    EventsAccumulate {
        /// The time.
        time: f64,
        /// Index of the event in the list, from 0.
        index: usize,
        /// Number of these events, of all functions.
        count: u32,
    },

    /// The state is behind a [`wall`](crate::Event::wall), and does not leave it.
    #[error(
        "at time {time} the state is behind a wall: event function {index} is {value:e}; start where it is at least 0, and let the handler \
         keep the state there",
        time = Short(*.time)
    )]
    BehindWall {
        /// The time.
        time: f64,
        /// Index of the event in the list, from 0.
        index: usize,
        /// Value of the function.
        value: f64,
    },

    /// The length of a slice differs from the dimension of the vector to create.
    #[error("the slice has {}; it needs {expected}: give an entry for each component of the vector", Entries(*.found))]
    Length {
        /// The dimension of the vector.
        expected: usize,
        /// The length of the slice.
        found: usize,
    },

    /// The class of a system has constraints or friction, but the system gives none: steps would ignore them.
    #[error(
        "the class of the system has {what}, but the system gives none: implement `{by}`, and return `Some(self)` from `extra`"
    )]
    NoExtra {
        /// Constraints or friction.
        what: &'static str,
        /// The trait to implement.
        by: &'static str,
    },

    /// A system of class `Constrained` or `Nonholonomic` without a constraint, or with more constraints than positions.
    #[error(
        "the system has {constraints} constraints on {dimension} components of the position; it needs at least one and at most one for \
         each component: `constraints` says how many, in class `Nonholonomic` `nonholonomic_constraints`"
    )]
    ConstraintCount {
        /// Number of constraints.
        constraints: usize,
        /// Dimension of the position.
        dimension: usize,
    },

    /// A gradient has an entry for a constraint or a component that does not exist.
    #[error(
        "the gradient of constraint {constraint} by component {component} was set, but there are only {constraints} constraints and \
         {dimension} components, counted from 0"
    )]
    GradientPlace {
        /// The constraint, from 0.
        constraint: usize,
        /// The component, from 0.
        component: usize,
        /// Number of constraints.
        constraints: usize,
        /// Dimension of the position.
        dimension: usize,
    },

    /// The gradient of a constraint is not its derivative.
    #[error(
        "the gradient of constraint {constraint}{} is not the derivative of the constraint: its directional derivative is {stated:e}, but \
         difference quotients give {found:e}; correct `constraint_gradients`",
        Named(*name)
    )]
    GradientMismatch {
        /// The constraint, from 0.
        constraint: usize,
        /// Its name, if it has one.
        name: Option<ConstraintName>,
        /// Size of the derivative in a direction, as stated.
        stated: f64,
        /// Size of the derivative by differences.
        found: f64,
    },

    /// The entries of the gradients of the constraints were set at other indices, or in another order, than before.
    #[error(
        "at time {time} the gradients of the constraints were set at other indices than before; set the same entries in the same order, \
         also where they are zero",
        time = Short(*.time)
    )]
    MovingGradients {
        /// Time at the start of the step.
        time: f64,
    },

    /// The start violates the constraints.
    #[error(
        "the state is not on the constraints: for constraint {constraint}{} |φ| = {value:e}, |dφ/dt| = {rate:e}; both must be 0; \
         `constraints::consistent(&system, state)` returns a consistent state",
        Named(*name)
    )]
    InconsistentStart {
        /// The constraint, from 0: the one that is farthest from 0.
        constraint: usize,
        /// Its name, if it has one.
        name: Option<ConstraintName>,
        /// Its |φ|.
        value: f64,
        /// Its |G ∂H/∂p|.
        rate: f64,
    },

    /// The velocity at the start violates the non-holonomic constraints.
    #[error(
        "the velocity violates the constraints: |w·q'| of constraint {constraint}{} is {rate:e}, but must be 0; use \
         `constraints::consistent_momentum(&system, state)`; for a Lagrangian use `variational::momentum_of_velocity` with a consistent velocity",
        Named(*name)
    )]
    InconsistentVelocity {
        /// The constraint, from 0: the one that is farthest from 0.
        constraint: usize,
        /// Its name, if it has one.
        name: Option<ConstraintName>,
        /// Its |w ∂H/∂p|.
        rate: f64,
    },

    /// No state that satisfies the constraints was found near the given state.
    #[error(
        "no state on the constraints was found near this one: the largest |φ| is {value:e}, the largest rate {rate:e}; start closer to the \
         constraints"
    )]
    NoConsistentState {
        /// The largest |φ|.
        value: f64,
        /// The largest |G ∂H/∂p|.
        rate: f64,
    },

    /// The gradient of a constraint vanishes or depends on those of the previous constraints, or `∂²H/∂p∂p` vanishes
    /// along it: the multipliers are not unique.
    #[error(
        "at time {time} constraint {constraint}{} depends on those before it, its gradient vanishes, or the velocity along it depends on no \
         momentum (pivot {pivot:e}); leave it out, or keep away from this configuration",
        Named(*name),
        time = Short(*.time)
    )]
    DependentConstraints {
        /// Time at the start of the step.
        time: f64,
        /// The constraint, from 0.
        constraint: usize,
        /// Its name, if it has one.
        name: Option<ConstraintName>,
        /// Its pivot in the elimination of `G M⁻¹ Gᵀ`, relative to its diagonal entry.
        pivot: f64,
    },

    /// The monitor of variable steps is not positive and finite, or its derivative along the motion is not finite.
    #[error(
        "the monitor of the step sizes is {value} at time {time}; it must be finite, positive and away from zero along the orbit, with a finite derivative",
        time = Short(*.time),
        value = Short(*.value)
    )]
    Monitor {
        /// Time of the state.
        time: f64,
        /// Value of the monitor.
        value: f64,
    },

    /// An argument of a logarithm is not positive: the logarithmic Hamiltonian requires `U < 0` and `T + B > 0`.
    #[error(
        "step {step} from time {time}: {what} is {value}, but the logarithmic Hamiltonian requires {what} > 0; take a smaller step, or \
         `AdaptiveSteps::run` where the potential is not negative everywhere",
        time = Short(*.time),
        value = Short(*.value)
    )]
    LogarithmicDomain {
        /// Physical time at the start of the step.
        time: f64,
        /// Number of the step, from 1; 0 for the extension of a state.
        step: u64,
        /// `−U` or `T + B`.
        what: &'static str,
        /// Its value.
        value: f64,
    },

    /// The step is so small that it does not change the time.
    #[error(
        "a step of size {step_size} does not change the time {time}, which has 53 bits; take a larger step, or \
         choose a time origin closer to the present time",
        time = Short(*.time),
        step_size = Short(*.step_size)
    )]
    TimeResolution {
        /// Time of the state.
        time: f64,
        /// Step size.
        step_size: f64,
    },
}

impl Error {
    /// Whether it is the error of a step that may succeed if it is shorter.
    #[must_use]
    pub const fn depends_on_the_size(&self) -> bool {
        matches!(
            self,
            Self::NoConvergence { .. }
                | Self::Stagnation { .. }
                | Self::NonFinite { .. }
                | Self::SingularMatrix { .. }
        )
    }

    /// Adds the name of the constraint to the error.
    pub(crate) fn named(mut self, of: impl Fn(usize) -> Option<ConstraintName>) -> Self {
        if let Self::GradientMismatch {
            constraint, name, ..
        }
        | Self::InconsistentStart {
            constraint, name, ..
        }
        | Self::InconsistentVelocity {
            constraint, name, ..
        }
        | Self::DependentConstraints {
            constraint, name, ..
        } = &mut self
        {
            *name = of(*constraint);
        }
        self
    }
}
