//! The generating function of a step.

use super::energies::{EnergyAt, weighted_energy};
use super::two_ends::{Unknowns, dot, solve, sum};
use crate::Error;
use symplectic_core::inside::{check_state, check_step_size};
use symplectic_core::solver::{Coefficients, Solver, Step, Stopping};
use symplectic_core::system::Conservative;
use symplectic_core::{
    Error as CoreError, Integrator, Method, ProvedFor, Quantity, Scalar, Summation, System, Vector,
};

/// The value at `(q0, p1)`, and the step that it generates; returned by [`generating_function`].
#[derive(Clone, Debug, PartialEq)]
pub struct GeneratingFunction<V: Vector> {
    /// `H_d⁺(q0, p1)`, an action.
    pub value: V::Scalar,
    /// The momentum at the start of the step, `D1 H_d⁺(q0, p1)`; of the dimension of `q0`.
    pub p0: V,
    /// The position at its end, `D2 H_d⁺(q0, p1)`; of the dimension of `q0`.
    pub q1: V,
}

impl<V: Vector> GeneratingFunction<V> {
    /// The function of Type I at `(q0, q1)`, the discrete Lagrangian `L_d = p1·q1 − H_d⁺(q0, p1)` (Leok & Ohsawa, 9.8), from the momentum `p1`
    /// at the end of the step: `p0 = −D1 L_d`, `p1 = D2 L_d`.
    pub fn discrete_lagrangian(&self, p1: &V) -> V::Scalar {
        dot(p1, &self.q1) - self.value
    }

    /// The function of Type III at `(p0, q1)`, `H_d⁻ = −p0·q0 − L_d(q0, q1)` (Leok & Ohsawa, 9.9), from `q0` and `p1`: `q0 = −D1 H_d⁻`,
    /// `p1 = −D2 H_d⁻`.
    pub fn type_three(&self, q0: &V, p1: &V) -> V::Scalar {
        -dot(&self.p0, q0) - self.discrete_lagrangian(p1)
    }
}

/// The Type II generating function of a step of size `step_size` that begins at `time`. Its arguments are the position `q0` at the start
/// and the momentum `p1` at the end (Leok & Zhang, eq. 43):
///
/// ```text
/// H_d⁺(q0, p1) = p1·q0 − h² Σ_ij b̃_i a_ij ∂H/∂q(Q_i, P_i)·∂H/∂p(Q_j, P_j) + h Σ_i b_i H(Q_i, P_i)
/// p0 = D1 H_d⁺(q0, p1)      q1 = D2 H_d⁺(q0, p1)
/// ```
///
/// $$ H_d^{+}(q_0, p_1) = p_1 q_0 - h^2 \sum_{ij} \tilde b_i a_{ij} \frac{\partial H}{\partial q}(Q_i, P_i)
/// \frac{\partial H}{\partial p}(Q_j, P_j) + h \sum_i b_i H(Q_i, P_i) $$
///
/// with the stages of the step from `(q0, p0)` to `(q1, p1)`. These are found from the two given ends,
///
/// ```text
/// Q_i = q0 + h Σ_j a_ij velocity_j      P_i = p1 − h Σ_j (b̃_j − ã_ij) force_j
/// ```
///
/// by the iteration of [`FixedPoint`](symplectic_core::solver::FixedPoint), with its stopping criterion. `p0` and `q1` come from these stages. They
/// are the derivatives of the function because the method is symplectic. **It holds for symplectic methods only**,
/// `b_i ã_ij + b̃_j a_ji = b_i b̃_j`, which includes every method that the macro derives. If `b̃ ≠ b`, as for splittings, the last sum is
/// `h Σ_i (b_i T(P_i) + b̃_i U(Q_i))`. For another method, written by hand, the value has no meaning.
///
/// Along an orbit, the sum over l = 0..k of `H_d⁺(q_l, p_{l+1}) − p_{l+1}·q_{l+1}` plus `p_k·q_k` is the discrete extremum function. Its
/// derivative with respect to `p_k` is `q_k` (eq. 21 to 24). Unlike a discrete Lagrangian it exists for degenerate systems too, such as
/// `H = q·p` below.
///
/// # Cost
///
/// For s stages of dimension n, a sweep takes 2s evaluations and 2s²n products. The value takes s²n products and s energies. Memory is
/// allocated, separate from that of a step.
///
/// # Time
///
/// If H depends on time, the force is evaluated at `t0 + c_i h` and the velocity at `t0 + c̃_i h`, as in a step (see
/// [`Hamiltonian`](symplectic_core::Hamiltonian#time)). The energy contains the terms of both, so it needs a single time: if `c_i ≠ c̃_i`, the
/// energies at the two times have to be equal.
///
/// With friction, an [applied force](symplectic_core::Hamiltonian::applied_force) or constraints no such function exists, and the call does not
/// compile:
///
/// ```compile_fail,E0080
/// symplectic::tableau! { Midpoint { basis: polynomial(1), nodes: gauss(1) } }
/// symplectic::hamiltonian! { Resisted q: [x], p: [px]; H = (px^2 + x^2)/2  force: { x = -px^3 } }
/// use symplectic::nalgebra::Vector1;
/// use symplectic::variational::generating_function;
///
/// let (q0, p1) = (Vector1::new(1.0), Vector1::new(0.0));
/// let generating = generating_function(Midpoint, &Resisted, 0.0, &q0, &p1, 0.1);
/// ```
///
/// ```compile_fail,E0277
/// symplectic::tableau! { ForestRuth { base: forest-ruth-1990 } }
/// symplectic::hamiltonian! { Slowed q: [x], p: [px]; H = (px^2 + x^2)/2  friction: 0.2 }
/// use symplectic::nalgebra::Vector1;
/// use symplectic::variational::generating_function;
///
/// let (q0, p1) = (Vector1::new(1.0), Vector1::new(0.0));
/// let generating = generating_function(ForestRuth, &Slowed, 0.0, &q0, &p1, 0.1);
/// ```
///
/// ```compile_fail,E0277
/// symplectic::tableau! { Rattle { basis: polynomial(2), nodes: lobatto(2) } }
/// symplectic::hamiltonian! { Bead q: [x, y], p: [px, py]; H = (px^2 + py^2)/2  constraints: { circle = x^2 + y^2 - 1 } }
/// use symplectic::nalgebra::Vector2;
/// use symplectic::variational::generating_function;
///
/// let (q0, p1) = (Vector2::new(1.0, 0.0), Vector2::new(0.0, 1.0));
/// let generating = generating_function(Rattle, &Bead, 0.0, &q0, &p1, 0.1);
/// ```
///
/// # Errors
///
/// [`Core(NoEnergy)`](CoreError::NoEnergy) if the system has no energy; [`Error::DifferentNodes`] if it depends on time and the method has
/// `c ≠ c̃`; [`Core(StepSize)`](CoreError::StepSize), [`Core(Dimension)`](CoreError::Dimension) and
/// [`Core(NonFiniteState)`](CoreError::NonFiniteState) for the arguments; [`Core(NoConvergence)`](CoreError::NoConvergence),
/// [`Core(NonFinite)`](CoreError::NonFinite) and [`Core(EvaluationDimension)`](CoreError::EvaluationDimension) as in a step.
///
/// ```
/// symplectic::tableau! { Midpoint { basis: polynomial(1), nodes: gauss(1) } }
/// use symplectic::nalgebra::Vector1;
/// use symplectic::hamiltonian;
/// use symplectic::variational::{Error, generating_function};
///
/// # fn main() -> Result<(), Error> {
/// // H = q·p, which has no Lagrangian. The midpoint rule multiplies q by (1 + h/2)/(1 − h/2), that is 5/3, and
/// // H_d⁺ = 5/3 q0·p1.
/// let system = hamiltonian::<Vector1<f64>, _, _>(|_, q, _p, velocity| *velocity = *q, |_, _q, p, force| *force = -p)
///     .with_energy(|_, q, p| q[0] * p[0]);
/// let (q0, p1) = (Vector1::new(3.0), Vector1::new(2.0));
/// let generating = generating_function(Midpoint, &system, 0.0, &q0, &p1, 0.5)?;
/// assert!((generating.value - 10.0).abs() < 1e-14);
/// assert!((generating.q1[0] - 5.0).abs() < 1e-14);
/// assert!((generating.p0[0] - 10.0 / 3.0).abs() < 1e-14);
/// # Ok(())
/// # }
/// ```
pub fn generating_function<
    M: Method + ProvedFor<S::Class>,
    S: System<V, Class: Conservative>,
    V: Vector,
>(
    _method: M,
    system: &S,
    time: f64,
    q0: &V,
    p1: &V,
    step_size: f64,
) -> Result<GeneratingFunction<V>, Error> {
    const {
        let reason = "a method with gradient kicks has no generating function here";
        assert!(M::COEFFICIENTS.gradient.is_empty(), "{}", reason);
    }
    check_step_size(step_size)?;
    check_state(time, q0, p1, q0.dimension())?;
    system.check_dimension(q0.dimension())?;
    let nothing = q0.zeros_like();
    let step = Step {
        time,
        size: step_size,
        q: q0,
        q_low: &nothing,
        p: p1,
        p_low: &nothing,
        linear_velocity: false,
    };
    generating::<M, S, V>(system, &step, 1, Stopping::DEFAULT)
}

/// Takes one step and returns its generating function at the position before and the momentum after it. Its `p0` and `q1` are the
/// momentum before and the position after the step, up to rounding.
///
/// The stages are computed again, and memory is allocated: see [`generating_function()`].
///
/// # Errors
///
/// Those of [`step`](symplectic_core::Run::step), [`Core(NoEnergy)`](CoreError::NoEnergy), [`Error::DifferentNodes`]; the state is then
/// unchanged.
///
/// ```
/// symplectic::tableau! { Midpoint { basis: polynomial(1), nodes: gauss(1) } }
/// # use symplectic::nalgebra::Vector1;
/// # use symplectic::{Integrator, State, hamiltonian};
/// use symplectic::variational::{Error, step_with_generating_function};
/// # fn main() -> Result<(), Error> {
/// let system = hamiltonian::<Vector1<f64>, _, _>(|_, q, _p, velocity| *velocity = *q, |_, _q, p, force| *force = -p)
///     .with_energy(|_, q, p| q[0] * p[0]);
/// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(1.0));
/// let mut integrator = Integrator::new(Midpoint, system, start, 0.5)?;
/// let generating = step_with_generating_function(&mut integrator)?;
/// assert!((generating.q1[0] - integrator.state().q[0]).abs() < 1e-15);
/// assert!((generating.p0[0] - 1.0).abs() < 1e-15);
/// # Ok(())
/// # }
/// ```
pub fn step_with_generating_function<
    M: Method,
    S: System<V, Class: Conservative>,
    V: Vector,
    R: Summation,
    N: Solver<V, S>,
>(
    run: &mut Integrator<M, S, V, R, N>,
) -> Result<GeneratingFunction<V>, Error> {
    run.step_solved_by(|system, step, p1, number, stopping| {
        let step = Step { p: p1, ..*step };
        generating::<M, S, V>(system, &step, number, stopping)
    })
}

/// [`generating_function`] with the position and the momentum of `step` as `q0` and `p1`. `number` is the number of the step, for errors.
fn generating<M: Method, S: System<V>, V: Vector>(
    system: &S,
    step: &Step<'_, V>,
    number: u64,
    stopping: Stopping,
) -> Result<GeneratingFunction<V>, Error> {
    const {
        assert!(
            !S::FORCED,
            "with an applied force a step is not symplectic and has no generating function"
        );
    }
    let (mut stages, [p0, q1]) = solve::<false, M, S, V>(system, step, number, stopping)?;
    let value = stages.value(system, step, number)?;
    Ok(GeneratingFunction { value, p0, q1 })
}

impl<M: Method, V: Vector> Unknowns<M, V> {
    /// The value of the generating function, from the stages.
    fn value<S: System<V>>(
        &mut self,
        system: &S,
        step: &Step<'_, V>,
        number: u64,
    ) -> Result<V::Scalar, Error> {
        let not_finite = |stage| {
            Error::from(CoreError::NonFinite {
                time: step.time,
                step_size: step.size,
                step: number,
                what: Quantity::Energy,
                stage,
            })
        };
        let Coefficients { c, c_tilde, .. } = M::COEFFICIENTS;
        let times = c.iter().zip(c_tilde);
        let weights = self.weights.b.iter().zip(&self.weights.other);
        let places = self.q.iter().zip(&self.p);
        let stages =
            times
                .zip(weights.zip(places))
                .map(|((&c, &c_tilde), ((&b, &back), (q, p)))| EnergyAt {
                    weights: [b, -back],
                    times: [step.at(c), step.at(c_tilde)],
                    q,
                    p,
                });
        let mut value = weighted_energy(system, (step.q, step.p), stages, |energy, stage| {
            if energy.is_finite() {
                Ok(())
            } else {
                Err(not_finite(Some(stage)))
            }
        })?;
        for ((row, &back), force) in self
            .weights
            .a
            .iter()
            .zip(&self.weights.other)
            .zip(&self.force)
        {
            // −h² Σ_j b̃_i a_ij ∂H/∂q_i·∂H/∂p_j is h b̃_i force_i·(Q_i − q0).
            sum(&mut self.increment, row, &self.velocity);
            value -= back * dot(force, &self.increment);
        }
        value += dot(step.p, step.q);
        if value.is_finite() {
            Ok(value)
        } else {
            Err(not_finite(None))
        }
    }
}
