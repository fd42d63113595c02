//! Symplectic–energy–momentum steps.

use crate::Error;
use alloc::vec;
use alloc::vec::Vec;

use num_traits::Float;

use super::discrete_lagrangian::{At, Derivatives, DiscreteLagrangian};
use super::ends::Ends;
use super::failure::Failure;
use super::regular::{Factors, is_solved};
use symplectic_core::inside::{SaveWords, StepsBeside, check_state, check_step_size, copy, words};
use symplectic_core::solver::{Visit, Words};
use symplectic_core::stepper::{Own, Stepper};
use symplectic_core::{Checkpoint, Error as CoreError, Quantity, Run, State, Statistics, Vector};

/// Symplectic–energy–momentum steps of a [`DiscreteLagrangian`] that does not depend on time (Kane, Marsden & Ortiz 1999; Marsden & West
/// 2001, 4.9). The step size is an unknown, and the discrete energy `E_d = −∂Ld/∂h` is the same in all steps.
///
/// ```text
/// p0 = −D1 Ld(q0, q1, h)      E = −∂Ld/∂h (q0, q1, h)      p1 = D2 Ld(q0, q1, h)
/// ```
///
/// $$ p_0 = -D_1 L_d(q_0, q_1, h) \qquad E = -\frac{\partial L_d}{\partial h}(q_0, q_1, h) \qquad p_1 = D_2 L_d(q_0, q_1, h) $$
///
/// The first step has the given size, and defines E. Newton's iteration with the exact Jacobian solves for q1 and h. The momentum maps of
/// the symmetries of `Ld` are conserved as in steps of constant size.
///
/// # Where no step exists
///
/// At a state with the energy H, the discrete energy of a step of size h is `H − h²c + …`, where c is a curvature of the orbit. For the
/// midpoint rule `c = (p·M⁻¹∇²V M⁻¹p + ∇V·M⁻¹∇V)/8`. So `h ∝ c^{−1/2}`, and where c changes its sign no step conserves the energy. The
/// steps grow as the run approaches such a point, and the run ends with [`Error::NoEnergyStep`]. A step is at most twice and at least half
/// as long as the previous one, which excludes other roots of the equations. For an autonomous Lagrangian, steps of constant size
/// ([`VariationalIntegrator`](super::VariationalIntegrator)) continue beyond this point, as Marsden & West (4.9.3) advise.
///
/// The condition number of the equations grows as `h⁻²`: E is conserved up to rounding errors times this number. Newton's iteration ends
/// when the equations hold up to the rounding of q1. A free particle, which conserves its energy with steps of every size, keeps its step
/// size.
///
/// # Output and events
///
/// [`integrate_to`](Run::integrate_to) passes the given time and returns the state there. A state inside the last step is that of a shorter
/// step of `Ld` from its start, whatever its discrete energy. After a [wall](symplectic_core::Event::wall), as after every new state, the run
/// begins anew: the next step has the size of the first one and defines E.
///
/// # Errors of a step
///
/// [`Error::NoEnergyStep`] if Newton's iteration finds no step that conserves the discrete energy; [`Error::NoEndOfStep`],
/// [`Error::IrregularLagrangian`] and [`Core(NonFinite)`](CoreError::NonFinite) if a step of the previous size has no end;
/// [`Core(EvaluationDimension)`](CoreError::EvaluationDimension) and [`Core(TimeResolution)`](CoreError::TimeResolution). The state is then
/// unchanged. All other methods: [`Run`].
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::variational::{DiscreteLagrangian, EnergyMomentumSteps};
/// use symplectic::{Scalar, State};
///
/// /// Kepler's problem, L = |v|²/2 + 1/|q|, by the midpoint rule.
/// struct Kepler;
///
/// impl DiscreteLagrangian for Kepler {
///     type Vector<T: Scalar> = SVector<T, 2>;
///
///     fn value<T: Scalar>(&self, _time: T, h: T, q0: &SVector<T, 2>, q1: &SVector<T, 2>) -> T {
///         let half = T::from_f64(0.5);
///         let (way, middle) = (q1 - q0, (q0 + q1) * half);
///         half * way.dot(&way) / h + h * middle.dot(&middle).sqrt().recip()
///     }
/// }
///
/// # fn main() -> Result<(), symplectic::variational::Error> {
/// // The pericentre of an orbit of eccentricity 1/2: steps grow from here.
/// let start = State::from_arrays(0.0, [0.5, 0.0], [0.0, 3_f64.sqrt()]);
/// let mut run = EnergyMomentumSteps::run(Kepler, start, 0.01)?;
/// for _ in 0..20 {
///     run.step()?;
/// }
/// assert!(run.step_size() > 0.01);
/// # Ok(())
/// # }
/// ```
pub type EnergyMomentumIntegrator<L> = Run<EnergyMomentumSteps<L>>;

/// The steps of an [`EnergyMomentumIntegrator`].
#[derive(Clone)]
pub struct EnergyMomentumSteps<L: DiscreteLagrangian> {
    lagrangian: L,
    moving: Moving<L::Vector<f64>>,
    derivatives: Derivatives<L>,
    /// By rows.
    matrix: Vec<f64>,
    /// The derivatives of `∂Ld/∂h` with respect to q1 and h.
    last_row: Vec<f64>,
    factors: Factors,
}

/// What a step changes.
#[derive(Clone)]
pub struct Moving<V> {
    /// The position of the next state is the unknown q1 of a step.
    ends: Ends<V>,
    /// That of the last step.
    step_size: f64,
    first_size: f64,
    energy: Option<f64>,
    curvature: Option<f64>,
}

/// Maximum number of Newton iterations.
const MAX_ITERATIONS: u32 = 40;

/// The relative change of an iterate after which the next iterate is exact up to rounding.
const LAST_CHANGE: f64 = 1e-9;

/// Relative accuracy to which q1 is known.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Largest ratio of the sizes of two successive steps.
const MAX_CHANGE: f64 = 2.0;

impl<L: DiscreteLagrangian> EnergyMomentumSteps<L> {
    /// An integrator at `state`, with a first step of size `step_size`, which is negative to go backward.
    ///
    /// Does not compile for a Lagrangian with [`forces`](DiscreteLagrangian::FORCED), which change the energy.
    ///
    /// # Errors
    ///
    /// [`Core(StepSize)`](CoreError::StepSize), [`Core(Dimension)`](CoreError::Dimension) if `q` and `p` differ,
    /// [`Core(NonFiniteState)`](CoreError::NonFiniteState).
    pub fn run(
        lagrangian: L,
        state: State<L::Vector<f64>>,
        step_size: f64,
    ) -> Result<Run<Self>, Error> {
        const {
            assert!(
                !L::FORCED,
                "forces change the energy: take a `VariationalIntegrator`"
            );
        }
        check_step_size(step_size)?;
        let n = state.q.dimension();
        check_state(state.time, &state.q, &state.p, n)?;
        let stepper = EnergyMomentumSteps {
            lagrangian,
            derivatives: Derivatives::new(&state.q)?,
            matrix: vec![0.0; (n + 1) * (n + 1)],
            last_row: vec![0.0; n + 1],
            factors: Factors::new(n + 1),
            moving: Moving {
                ends: Ends::new(state),
                step_size,
                first_size: step_size,
                energy: None,
                curvature: None,
            },
        };
        Ok(Run::of(stepper, 1.0)?)
    }

    /// The discrete energy E of all steps; `None` before the first step.
    pub const fn discrete_energy(&self) -> Option<f64> {
        self.moving.energy
    }

    /// The curvature c at the start of the last step, from the derivative of the discrete energy by the step size: `−dE_d/dh / (2h)`. If it
    /// comes near zero, the run is about to end. `None` before the first step.
    pub const fn curvature(&self) -> Option<f64> {
        self.moving.curvature
    }
}

impl<L: DiscreteLagrangian> Stepper for EnergyMomentumSteps<L> {
    type State = State<L::Vector<f64>>;
    type Error = Error;
    type Pace = Own;
    /// A step is not split: its size is the unknown.
    type Saved = ();

    fn state(&self) -> &Self::State {
        &self.moving.ends.state
    }

    fn statistics(&self) -> &Statistics {
        &self.moving.ends.statistics
    }

    fn statistics_mut(&mut self) -> &mut Statistics {
        &mut self.moving.ends.statistics
    }

    /// The next step has the size of the first one, and defines E.
    fn set_state(&mut self, state: &Self::State) -> Result<(), Error> {
        self.moving.ends.check(state)?;
        self.moving.ends.set(state);
        self.moving.begin(self.moving.first_size);
        Ok(())
    }

    fn advance(&mut self, _size: f64, _end: f64) -> Result<(), Error> {
        let (time, before) = (self.time(), self.moving.step_size);
        let ends = &mut self.moving.ends;
        let step = ends.begin();
        // First the end of a step of the previous size, then that of a step with the energy E.
        copy(&mut ends.next.q, &ends.state.q);
        let fixed = self.solve(before, None);
        fixed.map_err(|failure| self.error(failure))?;
        let curvature = self.slope_of_energy() / (-2.0 * before);
        let size = match self.moving.energy {
            None => before,
            Some(energy) => self
                .solve(before, Some(energy))
                .map_err(|_| Error::NoEnergyStep {
                    time,
                    step_size: before,
                    step,
                    curvature,
                })?,
        };
        let end = time + size;
        if end == time {
            return Err(CoreError::TimeResolution {
                time,
                step_size: size,
            }
            .into());
        }
        let energy = self.evaluate(size);
        let Ends { state, next, .. } = &mut self.moving.ends;
        let at = At {
            time,
            size,
            q0: &state.q,
            q1: &next.q,
        };
        self.derivatives.first(&self.lagrangian, at);
        if !(self.derivatives.is_finite() && energy.is_finite()) {
            return Err(self.error(self.derivatives.failure()));
        }
        let Derivatives {
            start, end: last, ..
        } = &self.derivatives;
        copy(&mut next.p, &state.p);
        let momenta = next.p.as_mut_slice().iter_mut();
        for (p, (start, last)) in momenta.zip(start.iter().zip(last)) {
            *p += start + last;
        }
        self.moving.ends.end(size, end);
        self.moving.energy.get_or_insert(energy);
        (self.moving.step_size, self.moving.curvature) = (size, Some(curvature));
        Ok(())
    }

    fn own_step_size(&self) -> Option<f64> {
        Some(self.moving.step_size)
    }

    fn save(&self) {}

    fn go_back(&mut self, _saved: &()) {}
}

impl<V: Vector<Scalar = f64>> Moving<V> {
    /// Begins at a new state: the next step has this size, and defines E.
    const fn begin(&mut self, size: f64) {
        (self.energy, self.curvature) = (None, None);
        self.step_size = size;
    }
}

impl<V: Vector<Scalar = f64>> Words for Moving<V> {
    fn words(&mut self, visit: &mut Visit<'_>) {
        words!(visit: self.ends, self.step_size, self.first_size, self.energy, self.curvature);
    }
}

impl<L: DiscreteLagrangian> StepsBeside for EnergyMomentumSteps<L> {
    type Vector = L::Vector<f64>;
    type Moving = Moving<L::Vector<f64>>;

    fn moving(&self) -> Self::Moving {
        self.moving.clone()
    }

    fn exchange(&mut self, moving: &mut Self::Moving) {
        core::mem::swap(&mut self.moving, moving);
    }

    /// The step has the given size, whatever its energy.
    fn begin_beside(&mut self, run: &Self::Moving, state: &Self::State, size: f64) {
        self.moving.ends.set_beside(&run.ends, state);
        self.moving.begin(size);
    }

    fn last_step(&self) -> Option<(&Self::State, f64)> {
        self.moving.ends.last_step()
    }
}

impl<L: DiscreteLagrangian> SaveWords for EnergyMomentumSteps<L> {
    fn blank_checkpoint(&self) -> Checkpoint {
        let dimension = self.state().q.dimension();
        Checkpoint::of_method(
            "steps of constant discrete energy",
            "single steps".into(),
            dimension,
        )
    }

    fn words(&mut self, visit: &mut Visit<'_>) {
        self.moving.words(visit);
    }

    fn fingerprint(&mut self) -> Vec<f64> {
        (self.derivatives).fingerprint(&self.lagrangian, &self.moving.ends.state)
    }
}

impl<L: DiscreteLagrangian> EnergyMomentumSteps<L> {
    /// Newton's iteration for q1, and for the step size if `energy` is given. It starts from the present q1.
    fn solve(&mut self, before: f64, energy: Option<f64>) -> Result<f64, Failure> {
        let n = self.moving.ends.next.q.dimension();
        let (mut size, mut residual) = (before, f64::INFINITY);
        for _ in 0..MAX_ITERATIONS {
            let found = self.evaluate(size);
            if !(self.derivatives.is_finite() && found.is_finite()) {
                return Err(self.derivatives.failure());
            }
            let missing = energy.map(|energy| found - energy);
            if missing.is_none() {
                // The last equation keeps the step size.
                self.matrix[n * (n + 1)..].fill(0.0);
                self.matrix[n * (n + 1) + n] = 1.0;
            }
            let holds = self.holds(missing.unwrap_or(0.0));
            if holds && energy.is_some() {
                return Ok(size);
            }
            self.factors
                .factor(&self.matrix)
                .map_err(Failure::Singular)?;
            if holds {
                return Ok(size);
            }
            let Ends { state, next, .. } = &mut self.moving.ends;
            let pairs = state.p.as_slice().iter().zip(&self.derivatives.start);
            let right = pairs.map(|(p, start)| -(p + start));
            let changes = self.factors.solve(right.chain([missing.unwrap_or(0.0)]));
            let (mut changed, mut way) = (0.0_f64, 0.0_f64);
            let ends = (next.q.as_mut_slice().iter_mut()).zip(state.q.as_slice());
            for (&change, (q1, q0)) in changes.iter().zip(ends) {
                *q1 += change;
                changed = changed.max(Float::abs(change));
                way = way
                    .max(Float::abs(*q1 - q0))
                    .max(Float::abs(*q1) * f64::EPSILON);
            }
            size += changes[n];
            residual = (changed / way).max(Float::abs(changes[n] / size));
            let ratio = size / before;
            if !(1.0 / MAX_CHANGE..=MAX_CHANGE).contains(&ratio) {
                break;
            }
            if residual <= LAST_CHANGE {
                return Ok(size);
            }
        }
        let p = self.moving.ends.state.p.as_slice();
        if energy.is_none() && is_solved(p, &self.derivatives.start) {
            return Ok(size);
        }
        Err(Failure::NotFound {
            residual,
            iterations: MAX_ITERATIONS,
        })
    }

    /// Whether the equations hold up to the rounding of q1; `missing` is the error of the discrete energy.
    fn holds(&self, missing: f64) -> bool {
        let Ends { state, next, .. } = &self.moving.ends;
        let q1 = next.q.as_slice();
        let rounding = |row: &[f64]| {
            let terms = row.iter().zip(q1).map(|(slope, q)| Float::abs(slope * q));
            ROUNDING * terms.fold(0.0, |sum, term| sum + term)
        };
        let momenta = state.p.as_slice().iter().zip(&self.derivatives.start);
        let mut rows = self.matrix.chunks(q1.len() + 1).zip(momenta);
        rows.all(|(row, (p, start))| Float::abs(p + start) <= rounding(row))
            && Float::abs(missing) <= rounding(&self.last_row)
    }

    /// Evaluates all derivatives for a step of this size, and returns `E_d = −∂Ld/∂h`.
    fn evaluate(&mut self, size: f64) -> f64 {
        let Ends { state, next, .. } = &self.moving.ends;
        let at = At {
            time: state.time,
            size,
            q0: &state.q,
            q1: &next.q,
        };
        let slope = self
            .derivatives
            .by_size(&self.lagrangian, at, &mut self.matrix);
        let n = self.moving.ends.next.q.dimension();
        self.last_row.copy_from_slice(&self.matrix[n * (n + 1)..]);
        -slope
    }

    /// `dE_d/dh` along the ends of steps of all sizes, after the iteration for one size has converged.
    fn slope_of_energy(&mut self) -> f64 {
        let n = self.moving.ends.next.q.dimension();
        let right = (0..=n).map(|k| if k == n { 1.0 } else { 0.0 });
        let ends = self.factors.solve(right);
        let products = self
            .last_row
            .iter()
            .zip(ends)
            .map(|(slope, end)| slope * end);
        -products.fold(0.0, |sum, product| sum + product)
    }

    fn error(&self, failure: Failure) -> Error {
        let (what, size) = (Quantity::DiscreteLagrangian, self.moving.step_size);
        failure.error(what, self.time(), size, self.statistics().steps + 1)
    }
}
