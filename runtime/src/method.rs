//! What the macro emits: a method, and how it goes through one step.

use core::fmt::Debug;

use crate::{
    Change, Class, Coefficients, Coupling, General, Hamiltonian, Separable, StageStorage, Step,
    Vector,
};

/// A symplectic partitioned Runge–Kutta method: a type without a value, emitted from a proved tableau.
pub trait Method: Copy + Debug + 'static {
    /// Name of the method.
    const NAME: &'static str;
    /// Number of stages s of the tableau; a plan may store fewer.
    const STAGES: usize;
    /// What it was derived from: `basis: polynomial(3), nodes: lobatto(3)`. The compiler derives the exact
    /// tableau from it again.
    const DEFINITION: &'static str;
    /// The coefficients, for what is computed beside the step; the plans have theirs in their code.
    const COEFFICIENTS: Coefficients;

    /// How it steps a system with any Hamiltonian.
    type General: Plan<Class = General>;
    /// How it steps a system with a separable Hamiltonian.
    type Separable: Plan<Class = Separable>;
}

/// How a [`Method`] goes through one step of a system of one [`Class`].
///
/// A step is `begin`, then `sweep` until the stages no longer change (never where the
/// [`Coupling`](Self::Coupling) is [`Explicit`](crate::Explicit)), then `finish`; after it was accepted, `carry`.
///
/// Stage `i` evaluates the force at `t0 + c_i h` and the velocity at `t0 + c̃_i h`: see
/// [`Hamiltonian`](Hamiltonian#time). Plans of the class [`Separable`] pass for the argument that the system does not
/// read whatever vector is at hand.
pub trait Plan {
    /// The class of systems that it steps.
    type Class: Class;
    /// Whether stages have to be solved for.
    type Coupling: Coupling;
    /// Where the stage values and evaluations are.
    type Stages<V: Vector>: StageStorage<V>;

    /// Evaluates what is explicit before the coupled stages, and gives these their starting values.
    ///
    /// With `carried` the evaluation that [`carry`](Self::carry) left in its place is used instead of a new one.
    fn begin<V: Vector, S: Hamiltonian<V, Class = Self::Class>>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut Self::Stages<V>,
        carried: bool,
    );

    /// One fixed-point sweep over the coupled stages: new stage values from the latest velocities and forces,
    /// then new evaluations there. Returns how much the stage values changed.
    ///
    /// For a separable system one half comes after the other and uses its new evaluations: the stopping rule of
    /// [`Coupled`](crate::Coupled) relies on it.
    fn sweep<V: Vector, S: Hamiltonian<V, Class = Self::Class>>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut Self::Stages<V>,
    ) -> Change;

    /// Evaluates what comes after the coupled stages, and writes the result of the step into `q1` and `p1`,
    /// whose old values mean nothing.
    fn finish<V: Vector, S: Hamiltonian<V, Class = Self::Class>>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut Self::Stages<V>,
        q1: &mut V,
        p1: &mut V,
    );

    /// After an accepted step: where the last evaluation of a step is the first of the next one, puts it in
    /// the first one's place and returns true; elsewhere returns false.
    fn carry<V: Vector>(stages: &mut Self::Stages<V>) -> bool;
}
