//! The function that generates a step.

use alloc::vec::Vec;
use core::marker::PhantomData;

use num_traits::Zero;

use crate::error::{Error, Quantity};
use crate::integrator::Integrator;
use crate::integrator::validation::{check_state, check_step_size};
use crate::method::Solver;
use crate::method::diagnosis::{Attempt, FirstFault};
use crate::method::storage::{first_mismatch, first_non_finite, first_non_finite_of, is_finite};
use crate::method::{
    EvaluationCounts, EvaluationObserver, HalfChange, Method, Outcome, ProvedFor, StageChange,
    StagePlan, StageStorage, Step, Stopping, WarmStart,
};
use crate::number::{Coefficient, Coefficients, Plain, Scalar, Summation, Vector, Visit};
use crate::solver::fixed_point::by_stages;
use crate::system::{Class, Conservative, System};

/// What [`generating_function`] returns: the value at `(q0, p1)`, and the step that it generates.
#[derive(Clone, Debug, PartialEq)]
pub struct GeneratingFunction<V: Vector> {
    /// `H_d⁺(q0, p1)`, an action.
    pub value: V::Scalar,
    /// The momentum at the start of the step, `D1 H_d⁺(q0, p1)`; of the dimension of `q0`.
    pub p0: V,
    /// The position at its end, `D2 H_d⁺(q0, p1)`; of the dimension of `q0`.
    pub q1: V,
}

/// The Type II generating function of a step of size `step_size` that begins at `time`, as a function of the position
/// `q0` at its start and the momentum `p1` at its end (Leok & Zhang, eq. 43):
///
/// ```text
/// H_d⁺(q0, p1) = p1·q0 − h² Σ_ij b_i a_ij ∂H/∂q(Q_i, P_i)·∂H/∂p(Q_j, P_j) + h Σ_i b_i H(Q_i, P_i)
/// p0 = D1 H_d⁺(q0, p1)      q1 = D2 H_d⁺(q0, p1)
/// ```
///
/// $$ H_d^{+}(q_0, p_1) = p_1 q_0 - h^2 \sum_{ij} b_i a_{ij} \frac{\partial H}{\partial q}(Q_i, P_i)
/// \frac{\partial H}{\partial p}(Q_j, P_j) + h \sum_i b_i H(Q_i, P_i) $$
///
/// with the stages of the step from `(q0, p0)` to `(q1, p1)`, which are solved for from the two ends that are given:
///
/// ```text
/// Q_i = q0 + h Σ_j a_ij velocity_j      P_i = p1 − h Σ_j (b̃_j − ã_ij) force_j
/// ```
///
/// by the iteration of [`FixedPoint`](crate::solver::FixedPoint), with its stopping rule. `p0` and `q1` come from these stages; that they are
/// the derivatives is what symplecticity says. **It holds for symplectic methods only**, `b = b̃` and
/// `b_i ã_ij + b̃_j a_ji = b_i b̃_j`, which is every method that the macro derives; for another one that is written by
/// hand the value means nothing.
///
/// A sum over l = 0..k of `H_d⁺(q_l, p_{l+1}) − p_{l+1}·q_{l+1}` along an orbit, with `p_k·q_k` added, is the discrete
/// extremum function, whose derivative by `p_k` is `q_k` (eq. 21 to 24). Unlike a discrete Lagrangian it
/// is there for degenerate systems too, such as `H = q·p`, below.
///
/// # Cost
///
/// For s stages of dimension n, a sweep makes 2s evaluations and 2s²n products, and the value takes s²n products and
/// s energies. Memory is allocated; it is no part of a step.
///
/// # Time
///
/// Where H depends on time, the force is taken at `t0 + c_i h` and the velocity at `t0 + c̃_i h`, as in a step (see
/// [`Hamiltonian`](crate::Hamiltonian#time)). The energy is the sum of what belongs to both, so it has to be one time: where
/// `c_i ≠ c̃_i`, the energies at the two have to be equal.
///
/// With friction or constraints there is no such function, and the call does not compile.
///
/// # Errors
///
/// [`Error::NoEnergy`] where the system gives none; [`Error::TwoClocks`] where it depends on time and the method
/// has `c ≠ c̃`; [`Error::StepSize`], [`Error::Dimension`] and [`Error::NonFiniteState`] for the arguments;
/// [`Error::NoConvergence`], [`Error::NonFinite`] and [`Error::EvaluationDimension`] as in a step.
///
/// ```
/// symplectic::tableau! { Midpoint { basis: polynomial(1), nodes: gauss(1) } }
/// use symplectic::nalgebra::Vector1;
/// use symplectic::{Error, hamiltonian};
/// use symplectic::variational::generating_function;
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
    check_step_size(step_size)?;
    check_state(time, q0, p1, q0.dimension())?;
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

impl<M: Method, S: System<V, Class: Conservative>, V: Vector, R: Summation, N: Solver<V, S>>
    Integrator<M, S, V, R, N>
{
    /// Takes one step and returns its generating function at the position before and the momentum after it, the
    /// `p0` and `q1` of which are the momentum before and the position after it, up to rounding.
    ///
    /// The stages are solved for once more, and memory is allocated: see
    /// [`generating_function`](crate::variational::generating_function).
    ///
    /// # Errors
    ///
    /// Those of [`step`](Self::step), [`Error::NoEnergy`], [`Error::TwoClocks`]; the state is untouched.
    ///
    /// ```
    /// symplectic::tableau! { Midpoint { basis: polynomial(1), nodes: gauss(1) } }
    /// # use symplectic::nalgebra::Vector1;
    /// # use symplectic::{Error, Integrator, State, hamiltonian};
    /// # fn main() -> Result<(), Error> {
    /// let system = hamiltonian::<Vector1<f64>, _, _>(|_, q, _p, velocity| *velocity = *q, |_, _q, p, force| *force = -p)
    ///     .with_energy(|_, q, p| q[0] * p[0]);
    /// let start = State::new(0.0, Vector1::new(1.0), Vector1::new(1.0));
    /// let mut integrator = Integrator::new(Midpoint, system, start, 0.5)?;
    /// let generating = integrator.step_with_generating_function()?;
    /// assert!((generating.q1[0] - integrator.state().q[0]).abs() < 1e-15);
    /// assert!((generating.p0[0] - 1.0).abs() < 1e-15);
    /// # Ok(())
    /// # }
    /// ```
    pub fn step_with_generating_function(&mut self) -> Result<GeneratingFunction<V>, Error> {
        self.step_solved_by(generating::<M, S, V>)
    }
}

/// [`generating_function`] with `q0` and `p1` for the position and the momentum of `step`, whose number is for errors.
fn generating<M: Method, S: System<V>, V: Vector>(
    system: &S,
    step: &Step<'_, V>,
    number: u64,
    stopping: Stopping,
) -> Result<GeneratingFunction<V>, Error> {
    const {
        assert!(
            M::STAGES > 0,
            "a tableau at run time has no generating function: let a macro emit the method"
        );
    }
    let mut stages = Unknowns::<M, V>::like(step.q);
    let zeros = || step.q.zeros_like();
    let (mut q1, mut p0) = (zeros(), zeros());
    let outcome = by_stages::<TypeTwo<M, S::Class>, Plain, V, S>(
        step,
        system,
        &mut stages,
        WarmStart::default(),
        stopping,
        Outcome {
            q: &mut q1,
            q_low: &mut zeros(),
            p: &mut p0,
            p_low: &mut zeros(),
        },
    );
    let attempt = Attempt {
        time: step.time,
        step_size: step.size,
        step: number,
        dimension: step.q.dimension(),
    };
    let mismatch = stages.mismatch(attempt.dimension);
    let sound = mismatch.is_none() && is_finite(&q1) && is_finite(&p0);
    if outcome.is_err() || !sound {
        // The stages are there to tell.
        let observed = FirstFault::new(attempt.dimension);
        return Err(attempt.error(outcome.err(), &observed, &stages, &q1));
    }
    let value = stages.value(system, step, number)?;
    Ok(GeneratingFunction { value, p0, q1 })
}

/// The plan that goes from `(q0, p1)` to `(q1, p0)`: for it the position and the momentum of the [`Step`] are the two
/// that are known, and of its results the second is `p0`.
struct TypeTwo<M, C>(PhantomData<(M, C)>);

impl<M: Method, C: Class> StagePlan for TypeTwo<M, C> {
    type Class = C;
    type Stages<V: Vector> = Unknowns<M, V>;

    const EVALUATIONS: EvaluationCounts = EvaluationCounts {
        begin: 0,
        start: 1,
        sweep: 2 * M::STAGES as u32,
        finish: 0,
        carried: 0,
    };

    fn begin<R: Summation, V: Vector, S: System<V, Class = C>>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut Unknowns<M, V>,
        _kept: WarmStart,
    ) {
        stages.weights = Weights::new(&M::COEFFICIENTS, step.size);
        stages.q.iter_mut().for_each(|q| q.clone_from(step.q));
        stages.p.iter_mut().for_each(|p| p.clone_from(step.p));
        // One evaluation for all: the iteration finds the rest.
        if let Some((first, others)) = stages.velocity.split_first_mut() {
            system.velocity(V::Scalar::from_f64(step.time), step.q, step.p, first);
            others.iter_mut().for_each(|other| other.clone_from(first));
        }
    }

    fn sweep<R: Summation, V: Vector, S: System<V, Class = C>>(
        step: &Step<'_, V>,
        system: &S,
        stages: &mut Unknowns<M, V>,
    ) -> StageChange {
        let Unknowns {
            q,
            p,
            velocity,
            force,
            increment,
            weights,
            ..
        } = stages;
        let mut change = StageChange::default();
        for (q, weights) in q.iter_mut().zip(&weights.a) {
            sum(increment, weights, velocity);
            settle(q, step.q, increment, &mut change.q);
        }
        let arguments = q.iter().zip(&*p).zip(M::COEFFICIENTS.c);
        for (((q, p), &c), force) in arguments.zip(force.iter_mut()) {
            system.force(step.at(c), q, p, force);
        }
        for (p, weights) in p.iter_mut().zip(&weights.rest) {
            sum(increment, weights, force);
            settle(p, step.p, increment, &mut change.p);
        }
        let arguments = q.iter().zip(&*p).zip(M::COEFFICIENTS.c_tilde);
        for (((q, p), &c), velocity) in arguments.zip(velocity.iter_mut()) {
            system.velocity(step.at(c), q, p, velocity);
        }
        change
    }

    fn finish<R: Summation, V: Vector, S: System<V, Class = C>, W: EvaluationObserver>(
        step: &Step<'_, V>,
        _system: &S,
        stages: &mut Unknowns<M, V>,
        _kept: WarmStart,
        outcome: Outcome<'_, V>,
        _witness: &mut W,
    ) {
        let Unknowns {
            velocity,
            force,
            increment,
            weights,
            ..
        } = stages;
        let mut unused = HalfChange::default();
        sum(increment, &weights.b, velocity);
        settle(outcome.q, step.q, increment, &mut unused);
        sum(increment, &weights.back, force);
        settle(outcome.p, step.p, increment, &mut unused);
    }
}

/// The stages, one of each for every stage of the tableau.
#[derive(Clone)]
struct Unknowns<M, V: Vector> {
    q: Vec<V>,
    p: Vec<V>,
    velocity: Vec<V>,
    force: Vec<V>,
    /// What is added to the base.
    increment: V,
    weights: Weights<V::Scalar>,
    method: PhantomData<M>,
}

/// The coefficients times the step size.
#[derive(Clone)]
struct Weights<T> {
    /// `h a_ij`
    a: Vec<Vec<T>>,
    /// `−h (b̃_j − ã_ij)`
    rest: Vec<Vec<T>>,
    /// `h b_i`
    b: Vec<T>,
    /// `−h b̃_i`
    back: Vec<T>,
}

impl<T: Scalar> Weights<T> {
    fn new(coefficients: &Coefficients, h: f64) -> Self {
        let weights =
            |h: f64, list: &[Coefficient]| list.iter().map(|&c| T::weight(h, c)).collect();
        let rest = |row: &&[Coefficient]| {
            let pairs = coefficients.b_tilde.iter().zip(*row);
            pairs
                .map(|(&b, &a)| T::weight(-h, difference(b, a)))
                .collect()
        };
        Self {
            a: coefficients.a.iter().map(|row| weights(h, row)).collect(),
            rest: coefficients.a_tilde.iter().map(rest).collect(),
            b: weights(h, coefficients.b),
            back: weights(-h, coefficients.b_tilde),
        }
    }
}

/// `b − a`, also where the two nearly cancel.
fn difference(b: Coefficient, a: Coefficient) -> Coefficient {
    Coefficient::exact((b.double() - a.double()) + (b.low() - a.low()))
}

impl<M: Method, V: Vector> StageStorage<V> for Unknowns<M, V> {
    fn like(prototype: &V) -> Self {
        let vectors = || (0..M::STAGES).map(|_| prototype.zeros_like()).collect();
        Self {
            q: vectors(),
            p: vectors(),
            velocity: vectors(),
            force: vectors(),
            increment: prototype.zeros_like(),
            weights: Weights::new(&M::COEFFICIENTS, 0.0),
            method: PhantomData,
        }
    }

    /// Nothing is left for another step.
    fn words(&mut self, _visit: &mut Visit<'_>) {}

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        first_non_finite((&self.q, &self.force), (&self.p, &self.velocity))
    }

    fn non_finite_force(&self) -> Option<usize> {
        first_non_finite_of(&self.force)
    }

    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        first_mismatch(&self.force, &self.velocity, dimension)
    }
}

impl<M: Method, V: Vector> Unknowns<M, V> {
    /// The value of the generating function, once the stages are known.
    fn value<S: System<V>>(
        &mut self,
        system: &S,
        step: &Step<'_, V>,
        number: u64,
    ) -> Result<V::Scalar, Error> {
        let not_finite = |stage| Error::NonFinite {
            time: step.time,
            step_size: step.size,
            step: number,
            what: Quantity::Energy,
            stage,
        };
        let mut value = V::Scalar::zero();
        let Coefficients { c, c_tilde, .. } = M::COEFFICIENTS;
        let rows = self.weights.a.iter().zip(&self.weights.b);
        let times = c.iter().zip(c_tilde);
        let stages = self.q.iter().zip(&self.p).zip(&self.force);
        for (i, (((row, &b), (&c, &c_tilde)), ((q, p), force))) in
            rows.zip(times).zip(stages).enumerate()
        {
            let [position_time, momentum_time] = [c, c_tilde].map(|c| step.at(c));
            let energy = system.energy(position_time, q, p).ok_or(Error::NoEnergy)?;
            if !energy.is_finite() {
                return Err(not_finite(Some(i + 1)));
            }
            // A system that reads no clock gives the same number, bit for bit.
            if position_time != momentum_time && system.energy(momentum_time, q, p) != Some(energy)
            {
                let [position_time, momentum_time] = [c, c_tilde].map(|c| step.at(c));
                return Err(Error::TwoClocks {
                    stage: i + 1,
                    position_time,
                    momentum_time,
                });
            }
            // −h² Σ_j b_i a_ij ∂H/∂q_i·∂H/∂p_j is h b_i force_i·(Q_i − q0).
            sum(&mut self.increment, row, &self.velocity);
            value += b * (dot(force, &self.increment) + energy);
        }
        value += dot(step.p, step.q);
        if value.is_finite() {
            Ok(value)
        } else {
            Err(not_finite(None))
        }
    }
}

/// `out = Σ_j weights_j terms_j`.
fn sum<V: Vector>(out: &mut V, weights: &[V::Scalar], terms: &[V]) {
    out.as_mut_slice().fill(V::Scalar::zero());
    for (&weight, term) in weights.iter().zip(terms) {
        let components = out.as_mut_slice().iter_mut().zip(term.as_slice());
        components.for_each(|(out, &term)| *out += weight * term);
    }
}

/// `out = base + increment`; notes in `change` how far `out` moved.
fn settle<V: Vector>(out: &mut V, base: &V, increment: &V, change: &mut HalfChange) {
    let ends = base.as_slice().iter().zip(increment.as_slice());
    for (out, (&base, &increment)) in out.as_mut_slice().iter_mut().zip(ends) {
        let new = base + increment;
        change.record(base, *out, new);
        *out = new;
    }
}

fn dot<V: Vector>(a: &V, b: &V) -> V::Scalar {
    let products = a.as_slice().iter().zip(b.as_slice()).map(|(&a, &b)| a * b);
    products.fold(V::Scalar::zero(), |sum, product| sum + product)
}
