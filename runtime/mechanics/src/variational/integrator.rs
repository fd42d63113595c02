//! Steps of a discrete Lagrangian.

use super::checks::DiscretePath;
use super::discrete_lagrangian::{At, Derivatives, DiscreteLagrangian};
use super::ends::Ends;
use super::failure::Failure;
use super::given_ends::GeneratingFunctions;
use super::regular::{Factors, is_solved};
use crate::Error;
use alloc::vec::Vec;
use symplectic_core::inside::{
    Part, SaveWords, StepsBeside, SymmetricSteps, beside, check_state, check_step_size, words,
};
use symplectic_core::proved::StoermerVerletSteps;
use symplectic_core::solver::Visit;
use symplectic_core::stepper::{Equal, Stepper};
use symplectic_core::{Checkpoint, Quantity, Run, State, Statistics, Vector};

/// Takes the steps of a [`DiscreteLagrangian`], with its forces if there are any (Marsden & West 2001, 2.1.1 and 3.2.5):
///
/// ```text
/// p0 = −D1 Ld(q0, q1) − f_d⁻(q0, q1)      p1 = D2 Ld(q0, q1) + f_d⁺(q0, q1)
/// ```
///
/// $$ p_0 = -D_1 L_d(q_0, q_1) - f_d^-(q_0, q_1) \qquad p_1 = D_2 L_d(q_0, q_1) + f_d^+(q_0, q_1) $$
///
/// Newton's iteration with the exact Jacobian `D1D2 Ld` solves the first equation for `q1`, from `q1 = q0`. For `L = v·Mv/2 − U(q)` its
/// first iterate is about `q0 + h M⁻¹p0`. The residual that rounding leaves in this equation is added to `p1`. So
/// `p1 − p0 = D1 Ld + D2 Ld + f_d⁻ + f_d⁺` holds up to rounding, and with it the balance of every momentum map.
///
/// Without forces a step is symplectic, and its order is that of `Ld` as an approximation of the action (Theorem 2.3.1). It conserves the
/// momentum maps of the symmetries of `Ld` (Theorem 1.3.3).
///
/// # Cost
///
/// For n components, an iteration takes n² evaluations of `Ld` with its derivatives and the elimination of a full matrix. The end of the
/// step takes n evaluations. A step allocates no memory. A step that fails leaves the state unchanged.
///
/// A state inside the last step is that of a shorter step from its start, with the order of the method and the cost of a step. A
/// [checkpoint](Run::checkpoint) is refused if `Ld`, its derivatives or its forces have other values near the state.
///
/// # Errors of a step
///
/// [`Error::IrregularLagrangian`], [`Error::NoEndOfStep`], [`Core(NonFinite)`](symplectic_core::Error::NonFinite),
/// [`Core(EvaluationDimension)`](symplectic_core::Error::EvaluationDimension) and
/// [`Core(TimeResolution)`](symplectic_core::Error::TimeResolution). All other methods: [`Run`].
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::variational::{DiscreteLagrangian, VariationalSteps};
/// use symplectic::{Scalar, State};
///
/// /// Kepler's problem, L = |v|²/2 + 1/|q|, by the trapezoidal rule.
/// struct Kepler;
///
/// impl DiscreteLagrangian for Kepler {
///     type Vector<T: Scalar> = SVector<T, 2>;
///
///     fn value<T: Scalar>(&self, _time: T, h: T, q0: &SVector<T, 2>, q1: &SVector<T, 2>) -> T {
///         let (half, way) = (T::from_f64(0.5), q1 - q0);
///         let attraction = |q: &SVector<T, 2>| q.dot(q).sqrt().recip();
///         half * way.dot(&way) / h + h * half * (attraction(q0) + attraction(q1))
///     }
/// }
///
/// # fn main() -> Result<(), symplectic::variational::Error> {
/// let start = State::from_arrays(0.0, [0.4, 0.0], [0.0, 2.0]);
/// let mut run = VariationalSteps::run(Kepler, start, 0.01)?;
/// run.integrate_to(100.0)?;
/// let State { q, p, .. } = run.state();
/// assert!((q.perp(p) - 0.8).abs() < 1e-13); // the angular momentum
/// # Ok(())
/// # }
/// ```
pub type VariationalIntegrator<L> = Run<VariationalSteps<L>>;

/// The steps of a [`VariationalIntegrator`].
#[derive(Clone)]
pub struct VariationalSteps<L: DiscreteLagrangian> {
    lagrangian: L,
    steps: SymmetricSteps,
    ends: Ends<L::Vector<f64>>,
    q1: L::Vector<f64>,
    derivatives: Derivatives<L>,
    factors: Factors,
    action: Option<f64>,
}

/// Largest defect of a self-adjoint discrete Lagrangian, relative to its value: the rounding of a late time is in it.
const SELF_ADJOINT: f64 = 1e-8;
/// Maximum number of Newton iterations; 3 to 6 are typical.
const MAX_ITERATIONS: u32 = 40;

impl<L: DiscreteLagrangian> VariationalSteps<L> {
    /// An integrator at `state`, with steps of size `step_size`, which is negative to go backward.
    ///
    /// # Errors
    ///
    /// [`Core(StepSize)`](symplectic_core::Error::StepSize), [`Core(Dimension)`](symplectic_core::Error::Dimension) if `q` and `p` differ,
    /// [`Core(NonFiniteState)`](symplectic_core::Error::NonFiniteState).
    pub fn run(
        lagrangian: L,
        state: State<L::Vector<f64>>,
        step_size: f64,
    ) -> Result<Run<Self>, Error> {
        Self::by(SymmetricSteps::ONE, lagrangian, state, step_size)
    }

    /// [`run`](Self::run) with the steps of a composition of Störmer–Verlet steps, made by
    /// [`composition!`](symplectic_core::composition). It has the order of that composition for general Hamiltonians, `M::ORDERS.general`, if `Ld`
    /// has order 2 and is self-adjoint.
    ///
    /// # Errors
    ///
    /// As for [`run`](Self::run); [`Error::NotSelfAdjoint`] if the
    /// [defect](super::DiscretePath::self_adjoint_defect) of a path from the start is not a rounding error. Does not compile with another
    /// method.
    pub fn composed<M: StoermerVerletSteps>(
        _method: M,
        lagrangian: L,
        state: State<L::Vector<f64>>,
        step_size: f64,
    ) -> Result<Run<Self>, Error> {
        let run = Self::by(SymmetricSteps::of::<M>(), lagrangian, state, step_size)?;
        let State { time, q, p } = run.state();
        // Two paths of about the length of a step: the value at one of them may be small by chance.
        let (along, mut defect, mut size) = (beside(p), 0.0_f64, 0.0_f64);
        for steps in [1.0, 2.0] {
            let mut q1 = q.clone();
            for (q, &p) in q1.as_mut_slice().iter_mut().zip(along.as_slice()) {
                *q += steps * step_size * p;
            }
            let path = DiscretePath {
                time: *time,
                step_size,
                q0: q,
                q1: &q1,
            };
            defect = defect.max(path.self_adjoint_defect(run.stepper().lagrangian()));
            let value = run.stepper().lagrangian().value(*time, step_size, q, &q1);
            size = size.max(value.abs());
        }
        match defect > SELF_ADJOINT * size {
            true => Err(Error::NotSelfAdjoint { defect }),
            false => Ok(run),
        }
    }

    fn by(
        steps: SymmetricSteps,
        lagrangian: L,
        state: State<L::Vector<f64>>,
        step_size: f64,
    ) -> Result<Run<Self>, Error> {
        check_step_size(step_size)?;
        check_state(state.time, &state.q, &state.p, state.q.dimension())?;
        let stepper = VariationalSteps {
            lagrangian,
            steps,
            q1: state.q.clone(),
            derivatives: Derivatives::new(&state.q)?,
            factors: Factors::new(state.q.dimension()),
            ends: Ends::new(state),
            action: None,
        };
        Ok(Run::of(stepper, step_size)?)
    }

    /// `Ld(q0, q1)` of the last step, or of the last part of a [split](symplectic_core::Retry) step; for a composition the sum over its substeps.
    /// `None` before the first step.
    pub const fn action(&self) -> Option<f64> {
        self.action
    }

    /// The discrete Lagrangian.
    pub const fn lagrangian(&self) -> &L {
        &self.lagrangian
    }
}

impl<L: DiscreteLagrangian> VariationalSteps<L> {
    /// A step of the discrete Lagrangian, from `next` to `next`.
    fn part(&mut self, part: Part) -> Result<(), Failure> {
        self.find_end(part)?;
        let State { q, p, .. } = &mut self.ends.next;
        let at = At {
            time: part.time,
            size: part.size,
            q0: q,
            q1: &self.q1,
        };
        self.derivatives.first(&self.lagrangian, at);
        let Derivatives { start, end, .. } = &self.derivatives;
        for (p, (start, end)) in p.as_mut_slice().iter_mut().zip(start.iter().zip(end)) {
            *p += start + end;
        }
        let mut numbers = p.as_slice().iter();
        if !(self.derivatives.value.is_finite() && numbers.all(|number| number.is_finite())) {
            return Err(self.derivatives.failure());
        }
        core::mem::swap(q, &mut self.q1);
        Ok(())
    }

    /// Solves `p0 + D1 Ld + f_d⁻ = 0` for `q1`.
    fn find_end(&mut self, part: Part) -> Result<(), Failure> {
        let State { q, p, .. } = &self.ends.next;
        self.q1.as_mut_slice().copy_from_slice(q.as_slice());
        let mut residual = f64::INFINITY;
        for _ in 0..MAX_ITERATIONS {
            let at = At {
                time: part.time,
                size: part.size,
                q0: q,
                q1: &self.q1,
            };
            self.derivatives.second(&self.lagrangian, at);
            if !self.derivatives.is_finite() {
                return Err(self.derivatives.failure());
            }
            self.factors
                .factor(&self.derivatives.mixed)
                .map_err(Failure::Singular)?;
            let pairs = p.as_slice().iter().zip(&self.derivatives.start);
            let right = pairs.map(|(p, start)| -(p + start));
            let (start, end) = (q.as_slice(), self.q1.as_mut_slice());
            let correction = self.factors.correct(right, start, end);
            if correction.is_last {
                return Ok(());
            }
            residual = correction.residual;
        }
        if is_solved(p.as_slice(), &self.derivatives.start) {
            return Ok(());
        }
        Err(Failure::NotFound {
            residual,
            iterations: MAX_ITERATIONS,
        })
    }
}

impl<L: DiscreteLagrangian> Stepper for VariationalSteps<L> {
    type State = State<L::Vector<f64>>;
    type Error = Error;
    type Pace = Equal;
    type Saved = <Self as StepsBeside>::Moving;

    fn state(&self) -> &Self::State {
        &self.ends.state
    }

    fn statistics(&self) -> &Statistics {
        &self.ends.statistics
    }

    fn statistics_mut(&mut self) -> &mut Statistics {
        &mut self.ends.statistics
    }

    fn set_state(&mut self, state: &Self::State) -> Result<(), Error> {
        self.ends.check(state)?;
        self.ends.set(state);
        self.action = None;
        Ok(())
    }

    fn advance(&mut self, size: f64, end: f64) -> Result<(), Error> {
        let (start, number) = (self.ends.state.time, self.ends.begin());
        self.ends.next.copy_from(&self.ends.state);
        let mut action = 0.0;
        for part in self.steps.parts(start, size, end) {
            self.part(part).map_err(|failure| {
                failure.error(Quantity::DiscreteLagrangian, start, size, number)
            })?;
            action += self.derivatives.value;
        }
        self.ends.end(size, end);
        self.action = Some(action);
        Ok(())
    }

    fn save(&self) -> Self::Saved {
        self.moving()
    }

    fn go_back(&mut self, saved: &Self::Saved) {
        (self.ends, self.action) = saved.clone();
    }

    fn may_split(&self, error: &Error) -> bool {
        error.depends_on_the_size()
    }
}

impl<L: DiscreteLagrangian> StepsBeside for VariationalSteps<L> {
    type Vector = L::Vector<f64>;
    type Moving = (Ends<L::Vector<f64>>, Option<f64>);

    fn moving(&self) -> Self::Moving {
        (self.ends.clone(), self.action)
    }

    fn exchange(&mut self, (ends, action): &mut Self::Moving) {
        core::mem::swap(&mut self.ends, ends);
        core::mem::swap(&mut self.action, action);
    }

    fn begin_beside(&mut self, (run, _): &Self::Moving, state: &Self::State, _size: f64) {
        self.ends.set_beside(run, state);
    }

    fn last_step(&self) -> Option<(&Self::State, f64)> {
        self.ends.last_step()
    }
}

impl<L: DiscreteLagrangian> SaveWords for VariationalSteps<L> {
    fn blank_checkpoint(&self) -> Checkpoint {
        let dimension = self.ends.state.q.dimension();
        let definition = self.steps.definition();
        Checkpoint::of_method("steps of a discrete Lagrangian", definition, dimension)
    }

    fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: self.ends, self.action);
    }

    fn fingerprint(&mut self) -> Vec<f64> {
        (self.derivatives).fingerprint(&self.lagrangian, &self.ends.state)
    }
}

impl<L: DiscreteLagrangian + Clone> GeneratingFunctions for VariationalIntegrator<L> {
    type Vector = L::Vector<f64>;

    /// Does not compile with a force.
    fn step_with_action(&self, start: Self::State) -> Result<(Self::State, f64), Error> {
        const {
            assert!(
                !L::FORCED,
                "with a force a step is not symplectic and has no generating function"
            )
        }
        let mut run = self.clone();
        run.set_state(start)?;
        run.step_at_once()?;
        let action = run.stepper().action().unwrap_or(f64::NAN);
        Ok((run.into_state(), action))
    }
}
