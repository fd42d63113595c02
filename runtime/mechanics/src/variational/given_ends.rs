//! Generating functions at given ends of a step.

use crate::Error;
use alloc::vec;

use num_traits::Float;

use super::end_derivative::EndDerivative;
use super::stages::StepWithStages;
use super::two_ends::dot;
use crate::variational::regular::{Singular, largest};
use symplectic_core::inside::check_state;
use symplectic_core::solver::Solver;
use symplectic_core::stepper::StepMap;
use symplectic_core::system::Conservative;
use symplectic_core::{
    Error as CoreError, Integrator, Method, Quantity, State, Summation, System, Vector,
};

/// The generating functions of the next step, at given ends:
///
/// ```text
/// Type I    L_d(q0, q1)                 p0 = −D1 L_d      p1 = D2 L_d
/// Type II   H_d⁺(q0, p1) = p1·q1 − L_d    p0 = D1 H_d⁺      q1 = D2 H_d⁺
/// Type III  H_d⁻(p0, q1) = −p0·q0 − L_d   q0 = −D1 H_d⁻     p1 = −D2 H_d⁻
/// ```
///
/// $$ L_d(q_0, q_1) \qquad H_d^{+}(q_0, p_1) = p_1 q_1 - L_d \qquad H_d^{-}(p_0, q_1) = -p_0 q_0 - L_d $$
///
/// (Leok & Ohsawa, arXiv:0810.0740v1, 9.8 and 9.9; Leok & Zhang 2011, eq. 43). Newton's iteration on the steps of the integrator finds
/// the missing position or momentum at the start, beginning with that of the present state. The matrix of the iteration is computed by
/// central differences. An iteration takes 2n + 1 steps for n components, or more if a short difference does not move the end
/// measurably. The residual is at the rounding errors of a step. The integrator itself takes no step.
///
/// # Errors
///
/// All three return [`Error::NoStart`] if the ends do not determine the start, or it is not found. Type I: H does not determine the
/// velocity, as for `H = q·p`, or at a conjugate point; Type II: `∂p1/∂p0` is singular; Type III: `∂q1/∂q0` is. They return
/// [`Core(Dimension)`](CoreError::Dimension) and [`Core(NonFiniteState)`](CoreError::NonFiniteState) for the arguments, and the errors of a
/// step and of its [stages](super::StepWithStages), which are found by fixed points: a step may be too large for them.
///
/// ```
/// symplectic::tableau! { Midpoint { basis: polynomial(1), nodes: gauss(1) } }
/// symplectic::hamiltonian! { Oscillator q: [x], p: [px]; H = (px^2 + x^2)/2 }
/// use symplectic::nalgebra::Vector1;
/// use symplectic::variational::{Error, GeneratingFunctions};
/// use symplectic::{Integrator, State};
///
/// # fn main() -> Result<(), Error> {
/// let run = Integrator::new(Midpoint, Oscillator, State::from_arrays(0.0, [1.0], [0.0]), 0.5)?;
/// let (q0, q1) = (Vector1::new(1.0), Vector1::new(2.0));
/// let step = run.type_one(&q0, &q1)?;
/// // h (((q1 − q0)/h)² − ((q0 + q1)/2)²)/2
/// assert!((step.value - 0.4375).abs() < 1e-14);
/// // The other functions have the same step at their ends.
/// let (p0, p1) = (step.start.p, step.end.p);
/// assert!((run.type_two(&q0, &p1)?.value - (p1.dot(&q1) - step.value)).abs() < 1e-14);
/// assert!((run.type_three(&p0, &q1)?.value - (-p0.dot(&q0) - step.value)).abs() < 1e-14);
/// # Ok(())
/// # }
/// ```
pub trait GeneratingFunctions:
    StepMap<State = State<Self::Vector>, Error: core::error::Error + Into<Error>>
{
    /// The vectors of a state.
    type Vector: Vector<Scalar = f64>;

    /// The state one step after `start`, and the action `L_d` of that step.
    ///
    /// # Errors
    ///
    /// Those of [`step_from`](StepMap::step_from), and those of the action.
    fn step_with_action(
        &self,
        start: State<Self::Vector>,
    ) -> Result<(State<Self::Vector>, f64), Error>;

    /// `L_d(q0, q1)` of Type I.
    ///
    /// # Errors
    ///
    /// See [above](Self#errors).
    fn type_one(
        &self,
        q0: &Self::Vector,
        q1: &Self::Vector,
    ) -> Result<GivenEnds<Self::Vector>, Error> {
        let State { time, p, .. } = self.present();
        let guess = State::new(*time, q0.clone(), p.clone());
        find(
            self,
            guess,
            Half::Momentum,
            (Half::Position, q1),
            |_, _, action| action,
        )
    }

    /// `H_d⁺(q0, p1)` of Type II.
    ///
    /// # Errors
    ///
    /// See [above](Self#errors).
    fn type_two(
        &self,
        q0: &Self::Vector,
        p1: &Self::Vector,
    ) -> Result<GivenEnds<Self::Vector>, Error> {
        let State { time, p, .. } = self.present();
        let guess = State::new(*time, q0.clone(), p.clone());
        find(
            self,
            guess,
            Half::Momentum,
            (Half::Momentum, p1),
            |_, end, action| dot(&end.p, &end.q) - action,
        )
    }

    /// `H_d⁻(p0, q1)` of Type III.
    ///
    /// # Errors
    ///
    /// See [above](Self#errors).
    fn type_three(
        &self,
        p0: &Self::Vector,
        q1: &Self::Vector,
    ) -> Result<GivenEnds<Self::Vector>, Error> {
        let State { time, q, .. } = self.present();
        let guess = State::new(*time, q.clone(), p0.clone());
        find(
            self,
            guess,
            Half::Position,
            (Half::Position, q1),
            |start, _, action| -dot(&start.p, &start.q) - action,
        )
    }
}

/// The value of a [generating function](GeneratingFunctions), and the step with the given ends.
#[derive(Clone, Debug, PartialEq)]
pub struct GivenEnds<V> {
    /// The value, an action.
    pub value: f64,
    /// The state at the start of the step.
    pub start: State<V>,
    /// The state at its end.
    pub end: State<V>,
}

impl<M, S, V, R, N> GeneratingFunctions for Integrator<M, S, V, R, N>
where
    M: Method,
    S: System<V, Class: Conservative> + Clone,
    V: Vector<Scalar = f64>,
    R: Summation,
    N: Solver<V, S>,
{
    type Vector = V;

    /// The errors of the action are [`Core(NoEnergy)`](CoreError::NoEnergy) and [`Error::DifferentNodes`]. Does not compile with an applied
    /// force.
    fn step_with_action(&self, start: State<V>) -> Result<(State<V>, f64), Error> {
        const {
            assert!(
                !S::FORCED,
                "with an applied force a step is not symplectic and has no generating function"
            );
        }
        let mut run = self.clone();
        run.set_state(start)?;
        let action = run.step_with_stages()?.action(run.system())?;
        Ok((run.into_state(), action))
    }
}

/// The position or the momentum of a state.
#[derive(Clone, Copy)]
enum Half {
    Position,
    Momentum,
}

impl Half {
    const fn of<V>(self, state: &State<V>) -> &V {
        match self {
            Self::Position => &state.q,
            Self::Momentum => &state.p,
        }
    }

    const fn of_mut<V>(self, state: &mut State<V>) -> &mut V {
        match self {
            Self::Position => &mut state.q,
            Self::Momentum => &mut state.p,
        }
    }

    fn take<V>(self, state: State<V>) -> V {
        match self {
            Self::Position => state.q,
            Self::Momentum => state.p,
        }
    }

    const fn quantity(self) -> Quantity {
        match self {
            Self::Position => Quantity::Position,
            Self::Momentum => Quantity::Momentum,
        }
    }
}

/// Maximum number of Newton iterations; 3 to 6 are typical.
const MAX_ITERATIONS: u32 = 40;
/// Residuals below this, relative to the terms of the end, are rounding errors.
const ROUNDING: f64 = 16.0 * f64::EPSILON;
/// A residual below this that no longer halves consists of rounding errors inside the step: Newton's iteration converges quadratically.
const STATIONARY: f64 = 1e-9;

/// Finds the position or momentum `unknown` of the start whose step ends at `target`.
fn find<I: GeneratingFunctions + ?Sized>(
    run: &I,
    mut start: State<I::Vector>,
    unknown: Half,
    (half, target): (Half, &I::Vector),
    value: impl FnOnce(&State<I::Vector>, &State<I::Vector>, f64) -> f64,
) -> Result<GivenEnds<I::Vector>, Error> {
    let n = run.present().q.dimension();
    check_state(start.time, &start.q, &start.p, n)?;
    check_state(start.time, &start.q, target, n).map_err(|error| match error {
        CoreError::NonFiniteState { .. } => CoreError::NonFiniteState {
            what: half.quantity(),
        },
        error => error,
    })?;
    let not_found = |component, residual| Error::NoStart {
        time: run.present().time,
        what: unknown.quantity(),
        component,
        residual,
    };
    let target = target.as_slice();
    let (mut right, mut sizes) = (vec![0.0; n], vec![0.0; n]);
    let mut derivative = EndDerivative::new(n);
    let mut last = f64::NAN;
    for _ in 0..MAX_ITERATIONS {
        let end = run.step_from(start.clone()).map_err(Into::into)?;
        let (known, found) = (half.of(&start).as_slice(), half.of(&end).as_slice());
        let iterate = unknown.of(&start).as_slice();
        let mut residual = 0.0_f64;
        for i in 0..n {
            right[i] = target[i] - found[i];
            sizes[i] = largest(&[target[i], known[i], found[i], derivative.terms(i, iterate)]);
            if right[i] != 0.0 {
                residual = residual.max(Float::abs(right[i]) / sizes[i]);
            }
        }
        // A component that is zero by cancellation has rounding errors of the size of the others.
        let is_rounding = residual <= STATIONARY || largest(&right) <= ROUNDING * largest(&sizes);
        if residual <= ROUNDING || (is_rounding && residual > last / 2.0) {
            let (end, action) = run.step_with_action(start.clone())?;
            let value = value(&start, &end, action);
            return Ok(GivenEnds { value, start, end });
        }
        last = residual;
        let shifted = |column: usize, by: f64| {
            let mut start = start.clone();
            unknown.of_mut(&mut start).as_mut_slice()[column] += by;
            let end = run.step_from(start).map_err(Into::into)?;
            Ok(half.take(end))
        };
        derivative.measure([iterate, unknown.of(&end).as_slice()], &sizes, shifted)?;
        derivative
            .solve(&right, &sizes, unknown.of_mut(&mut start).as_mut_slice())
            .map_err(|Singular { component, .. }| not_found(Some(component), residual))?;
    }
    Err(not_found(None, last))
}
