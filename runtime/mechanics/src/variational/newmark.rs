//! Newmark's method, as Störmer–Verlet in shifted positions.

use crate::Error;
use alloc::boxed::Box;
use alloc::vec;
use alloc::vec::Vec;
use core::cell::Cell;
use core::fmt;

use num_traits::Zero;

use super::regular::Factors;
use super::two_ends::dot;
use symplectic_core::inside::{
    check_start, check_state, check_step_size, is_finite, non_linear_velocity,
};
use symplectic_core::solver::FixedPoint;
use symplectic_core::system::Masses;
use symplectic_core::{
    Error as CoreError, Hamiltonian, Quantity, Scalar, Separable, State, System, Vector,
};
use symplectic_linearisation::HyperDual;

/// A system `H = pᵀM⁻¹p/2 + V(q)` in shifted positions. In these, Newmark's method with `γ = 1/2` and any β is Störmer–Verlet (Newmark
/// 1959; Marsden & West 2001, 2.6.3; Skeel, Zhang & Schlick 1997):
///
/// ```text
/// q1 = q0 + h v0 + h²/2 ((1 − 2β) a(q0) + 2β a(q1))      v1 = v0 + h/2 (a(q0) + a(q1))      a = M⁻¹ force
/// x = q − βh² a(q)      x' = M⁻¹p      p' = force(q(x))
/// ```
///
/// $$ x = q - \beta h^2 a(q) \qquad \dot x = M^{-1} p \qquad \dot p = -\nabla V(q(x)) $$
///
/// (Marsden & West print `η(q) = q − βh² M⁻¹∇V`; the sign is plus.) An [`Integrator`](symplectic_core::Integrator) with Störmer–Verlet and the step
/// size `h` steps this system. The states are `(x, p)`, and [`unshift`](Self::unshift) gives `(q, p)`. So dx∧dp is preserved, but dq∧dp is
/// preserved only for `β = 0`.
///
/// | β | method |
/// |---|---|
/// | 0 | Störmer–Verlet in q; stable for hω < 2 |
/// | 1/12 | the positions of an orbit are those of Numerov's method |
/// | 1/6 | linear acceleration; stable for hω < 2√3 |
/// | 1/4 | average acceleration: linear oscillators are stable at every step size |
///
/// Every β has order 2. For β < 1/4 a linear oscillator is stable for `(hω)² < 4/(1 − 4β)`. β < 0 lowers this limit.
///
/// # Energy
///
/// [`energy`](System::energy) is the Hamiltonian of the shifted system, `H(q, p) + βh²/2 ∇V·M⁻¹∇V`. If β > 0 and V is convex, the
/// potential in x is the minimum of `V(q) + |q − x|²/(2βh²)`, in the norm of M. With an [applied force](Hamiltonian::applied_force)
/// there is no energy.
///
/// # Step size
///
/// The shift uses the `h` given here. A step of another size, such as the last before an end time, is a Störmer–Verlet step for the same
/// shifted system, which differs by O(h²) from the given one.
///
/// # Cost
///
/// An evaluation of the force solves for `q(x)` by Newton's iteration from `q = x`, with exact derivatives. For n components an iteration
/// takes n/2 evaluations of the force with its derivatives and the elimination of a full matrix. Memory is allocated only at the first
/// evaluation. If no `q` is found, the force is NaN and the step fails with [`Core(NonFinite)`](CoreError::NonFinite); a smaller step
/// succeeds.
///
/// ```
/// use symplectic::variational::{Error, Newmark};
/// use symplectic::{Integrator, State};
///
/// symplectic::tableau! { StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) } }
/// symplectic::hamiltonian! {
///     /// A soft spring and one of frequency 1000.
///     Springs
///     q: [x, y], p: [px, py];
///     H = (px^2 + py^2)/2 + x^4/4 + 1e6 (y - x^2)^2/2
/// }
///
/// # fn main() -> Result<(), Error> {
/// let h = 0.01;
/// let newmark = Newmark::new(Springs, 0.25, h)?;
/// let start = newmark.shift(&State::from_arrays(0.0, [1.0, 1.0], [0.0, 0.0]))?;
/// let mut run = Integrator::new(StoermerVerlet, newmark, start, h)?;
/// run.integrate_to(10.0)?;
/// let end = run.system().unshift(run.state())?;
/// assert!((end.q[1] - end.q[0].powi(2)).abs() < 0.01);
/// # Ok(())
/// # }
/// ```
///
/// A force that depends on momenta makes a system [`General`](symplectic_core::General), and does not compile:
///
/// ```compile_fail,E0271
/// use symplectic::variational::Newmark;
///
/// symplectic::hamiltonian! { Damped q: [x], p: [px]; H = (px^2 + x^2)/2 force: { x = -px } }
///
/// let newmark = Newmark::new(Damped, 0.25, 0.01);
/// ```
pub struct Newmark<S: Hamiltonian<Class = Separable>> {
    system: S,
    /// `βh²`
    shift: f64,
    /// Memory to solve for `q(x)`; `None` before the first evaluation and during an evaluation.
    workspace: Cell<Option<Box<Workspace<S>>>>,
}

impl<S: Hamiltonian<Class = Separable>> Newmark<S> {
    /// The shifted system for `beta` and steps of size `step_size`.
    ///
    /// # Errors
    ///
    /// [`Error::NewmarkBeta`] if `beta` is not finite; [`Core(StepSize)`](CoreError::StepSize).
    pub fn new(system: S, beta: f64, step_size: f64) -> Result<Self, Error> {
        check_step_size(step_size)?;
        if !beta.is_finite() {
            return Err(Error::NewmarkBeta { value: beta });
        }
        Ok(Self {
            system,
            shift: beta * step_size * step_size,
            workspace: Cell::default(),
        })
    }

    /// The state `(x, p)` of a state `(q, p)`: `x = q − βh² a(q)`.
    ///
    /// # Errors
    ///
    /// [`Core(Dimension)`](CoreError::Dimension); [`Core(NonFiniteState)`](CoreError::NonFiniteState) for the state or its force;
    /// [`Core(ResizedEvaluation)`](CoreError::ResizedEvaluation); [`Error::NewmarkMasses`] if the velocity is not `M⁻¹p` with a constant M.
    pub fn shift(&self, state: &State<S::Vector<f64>>) -> Result<State<S::Vector<f64>>, Error> {
        let State { time, q, p } = state;
        check_start(&self.system, state)?;
        if let Some(found) = non_linear_velocity(&self.system, *time, q, p) {
            return Err(Error::NewmarkMasses {
                component: found.component,
                velocity: found.velocity,
                linear: found.linear,
            });
        }
        let [_, acceleration] = self.acceleration(*time, q)?;
        if !is_finite(&acceleration) {
            let what = Quantity::Force;
            return Err(CoreError::NonFiniteState { what }.into());
        }
        let mut shifted = state.clone();
        for (x, a) in shifted
            .q
            .as_mut_slice()
            .iter_mut()
            .zip(acceleration.as_slice())
        {
            *x -= self.shift * a;
        }
        Ok(shifted)
    }

    /// The state `(q, p)` of a state `(x, p)`, with the `q` that solves `q − βh² a(q) = x`.
    ///
    /// # Errors
    ///
    /// [`Core(Dimension)`](CoreError::Dimension), [`Core(NonFiniteState)`](CoreError::NonFiniteState);
    /// [`Core(ResizedEvaluation)`](CoreError::ResizedEvaluation); [`Error::NewmarkPosition`] if no such `q` is found.
    pub fn unshift(&self, state: &State<S::Vector<f64>>) -> Result<State<S::Vector<f64>>, Error> {
        let State { time, q, p } = state;
        check_state(*time, q, p, q.dimension())?;
        let q = match self.at_position(*time, q, S::Vector::clone) {
            Ok(q) => q,
            // The cause may be a wrong dimension.
            Err(error) => {
                self.acceleration(*time, q)?;
                return Err(error);
            }
        };
        Ok(State::new(*time, q, p.clone()))
    }

    /// The system in its original positions.
    pub const fn system(&self) -> &S {
        &self.system
    }

    /// The force and `M⁻¹ force` at a position q.
    ///
    /// # Errors
    ///
    /// [`Core(ResizedEvaluation)`](CoreError::ResizedEvaluation).
    fn acceleration(
        &self,
        time: f64,
        q: &S::Vector<f64>,
    ) -> Result<[S::Vector<f64>; 2], CoreError> {
        let check = |what, evaluation: &S::Vector<f64>| {
            let (expected, found) = (q.dimension(), evaluation.dimension());
            if found == expected {
                return Ok(());
            }
            Err(CoreError::ResizedEvaluation {
                time,
                what,
                expected,
                found,
            })
        };
        let (mut force, mut acceleration) = (q.zeros_like(), q.zeros_like());
        Hamiltonian::force(&self.system, time, q, q, &mut force);
        check(Quantity::Force, &force)?;
        Hamiltonian::velocity(&self.system, time, q, &force, &mut acceleration);
        check(Quantity::Velocity, &acceleration)?;
        Ok([force, acceleration])
    }

    /// The result of `evaluate` at `q(x)`.
    fn at_position<T>(
        &self,
        time: f64,
        x: &S::Vector<f64>,
        evaluate: impl FnOnce(&S::Vector<f64>) -> T,
    ) -> Result<T, Error> {
        if self.shift == 0.0 {
            return Ok(evaluate(x));
        }
        let workspace = self.workspace.take();
        let workspace =
            workspace.filter(|workspace| workspace.position.dimension() == x.dimension());
        let mut workspace = match workspace {
            Some(workspace) => workspace,
            None => Box::new(Workspace::new(x)?),
        };
        let outcome = workspace.solve(&self.system, time, self.shift, x);
        let value = outcome.map(|()| evaluate(&workspace.position));
        self.workspace.set(Some(workspace));
        value.map_err(|residual| Error::NewmarkPosition { time, residual })
    }
}

impl<S: Hamiltonian<Class = Separable>> System<S::Vector<f64>> for Newmark<S> {
    type Class = Separable;
    type Solver = FixedPoint;

    const MASSES: Masses = S::MASSES;
    const FORCED: bool = S::FORCED;
    const WELL_DECLARED: bool = true;

    fn velocity(
        &self,
        time: f64,
        q: &S::Vector<f64>,
        p: &S::Vector<f64>,
        velocity: &mut S::Vector<f64>,
    ) {
        Hamiltonian::velocity(&self.system, time, q, p, velocity);
    }

    fn check_dimension(&self, dimension: usize) -> Result<(), CoreError> {
        self.system.check_dimension(dimension)
    }

    fn force(
        &self,
        time: f64,
        q: &S::Vector<f64>,
        _p: &S::Vector<f64>,
        force: &mut S::Vector<f64>,
    ) {
        let evaluate = |q: &S::Vector<f64>| Hamiltonian::force(&self.system, time, q, q, force);
        if self.at_position(time, q, evaluate).is_err() {
            // The cause may be a wrong dimension; the step finds it here.
            Hamiltonian::force(&self.system, time, q, q, force);
            force.as_mut_slice().fill(f64::NAN);
        }
    }

    fn applied_force(
        &self,
        time: f64,
        q: &S::Vector<f64>,
        _p: &S::Vector<f64>,
        applied: &mut S::Vector<f64>,
    ) {
        let evaluate =
            |q: &S::Vector<f64>| Hamiltonian::applied_force(&self.system, time, q, q, applied);
        if self.at_position(time, q, evaluate).is_err() {
            applied.as_mut_slice().fill(f64::NAN);
        }
    }

    fn energy(&self, time: f64, q: &S::Vector<f64>, p: &S::Vector<f64>) -> Option<f64> {
        if S::FORCED {
            return None;
        }
        let evaluate = |q: &S::Vector<f64>| {
            let Ok([force, acceleration]) = self.acceleration(time, q) else {
                return Some(f64::NAN);
            };
            let energy = Hamiltonian::energy(&self.system, time, q, p)?;
            Some(energy + self.shift * 0.5 * dot(&force, &acceleration))
        };
        self.at_position(time, q, evaluate)
            .unwrap_or(Some(f64::NAN))
    }
}

impl<S: Hamiltonian<Class = Separable> + Clone> Clone for Newmark<S> {
    fn clone(&self) -> Self {
        Self {
            system: self.system.clone(),
            shift: self.shift,
            workspace: Cell::default(),
        }
    }
}

impl<S: Hamiltonian<Class = Separable> + fmt::Debug> fmt::Debug for Newmark<S> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut structure = formatter.debug_struct("Newmark");
        structure.field("system", &self.system);
        structure.field("shift", &self.shift);
        structure.finish_non_exhaustive()
    }
}

/// Maximum number of Newton iterations for `q(x)`.
const MAX_ITERATIONS: u32 = 40;

/// The unknown of `q − βh² a(q) = x`, and memory to evaluate the left-hand side with its derivatives.
struct Workspace<S: Hamiltonian> {
    position: S::Vector<f64>,
    q: S::Vector<HyperDual>,
    force: S::Vector<HyperDual>,
    acceleration: S::Vector<HyperDual>,
    /// By rows.
    matrix: Vec<f64>,
    factors: Factors,
}

impl<S: Hamiltonian> Workspace<S> {
    fn new(prototype: &S::Vector<f64>) -> Result<Self, CoreError> {
        let n = prototype.dimension();
        let zeros = || S::Vector::from_slice(&vec![HyperDual::zero(); n]);
        Ok(Self {
            position: prototype.zeros_like(),
            q: zeros()?,
            force: zeros()?,
            acceleration: zeros()?,
            matrix: vec![0.0; n * n],
            factors: Factors::new(n),
        })
    }

    /// Solves for the position; the error is the relative change in the last iteration.
    fn solve(&mut self, system: &S, time: f64, shift: f64, x: &S::Vector<f64>) -> Result<(), f64> {
        self.position.as_mut_slice().copy_from_slice(x.as_slice());
        let mut residual = f64::NAN;
        for _ in 0..MAX_ITERATIONS {
            if !self.linearise(system, time, shift) {
                return Err(residual);
            }
            self.factors.factor(&self.matrix).map_err(|_| residual)?;
            let position = self.position.as_mut_slice();
            let places = x.as_slice().iter().zip(self.q.as_slice());
            let left = places.zip(self.acceleration.as_slice());
            let right = left.map(|((x, q), a)| x - (q.real() - shift * a.real()));
            let correction = self.factors.correct(right, x.as_slice(), position);
            if correction.is_last {
                return Ok(());
            }
            residual = correction.residual;
        }
        Err(residual)
    }

    /// Writes the matrix `1 − βh² ∂a/∂q`; each evaluation of the acceleration gives two columns. Returns whether force and acceleration
    /// have the dimension of the position.
    fn linearise(&mut self, system: &S, time: f64, shift: f64) -> bool {
        let n = self.position.dimension();
        let time = HyperDual::from_f64(time);
        let pairs = self
            .q
            .as_mut_slice()
            .iter_mut()
            .zip(self.position.as_slice());
        pairs.for_each(|(dual, &value)| *dual = HyperDual::from_f64(value));
        for one in (0..n).step_by(2) {
            let other = one + 1;
            self.q.as_mut_slice()[one].set_first(1.0);
            if let Some(dual) = self.q.as_mut_slice().get_mut(other) {
                dual.set_second(1.0);
            }
            system.force(time, &self.q, &self.q, &mut self.force);
            if self.force.dimension() != n {
                self.force.clone_from(&self.q);
                return false;
            }
            system.velocity(time, &self.q, &self.force, &mut self.acceleration);
            if self.acceleration.dimension() != n {
                self.acceleration.clone_from(&self.q);
                return false;
            }
            let rows = self.matrix.chunks_exact_mut(n).enumerate();
            for ((i, row), a) in rows.zip(self.acceleration.as_slice()) {
                let entry = |j: usize, slope: f64| f64::from(i == j) - shift * slope;
                row[one] = entry(one, a.first());
                if let Some(place) = row.get_mut(other) {
                    *place = entry(other, a.second());
                }
            }
            self.q.as_mut_slice()[one].set_first(0.0);
            if let Some(dual) = self.q.as_mut_slice().get_mut(other) {
                dual.set_second(0.0);
            }
        }
        true
    }
}
