//! States on the constraints.

use alloc::vec;
use alloc::vec::Vec;
use core::array;

use super::resolution::Resolution;
use crate::constraints::kind::with_constraints;
use crate::constraints::metric::{Metric, Point};
use crate::constraints::{Constrained, Gradients, Terms, WithConstraints};
use symplectic_core::inside::{beside, is_finite, named};
use symplectic_core::solver::Failure;
use symplectic_core::system::{Class, Unconstrained};
use symplectic_core::{Error, Quantity, Scalar, State, System, Vector};

/// How far a start may be from the constraints, relative to the sizes of their terms.
pub(in crate::constraints) const CONSISTENT: f64 = 1e-10;
/// The size of rounding errors that other constraints leave, relative to [`CONSISTENT`] of their terms.
const SHARED: f64 = 256.0 * f64::EPSILON / CONSISTENT;
/// How far a gradient may be from the difference quotient, relative to its terms.
const GRADIENT: f64 = 1e-4;
/// Maximum number of iterations to find a consistent state.
const ITERATIONS: usize = 100;

/// The constraints of a system at a state.
pub(in crate::constraints) struct Examined<V: Vector> {
    metric: Metric<V::Scalar>,
    point: Point<V>,
    scratch: [V; 3],
    resolution: Resolution,
    /// `φ(q)`, and the sizes that each value is compared with.
    values: Vec<V::Scalar>,
    terms: Vec<Terms>,
    /// `G velocity`, and the sizes that each rate is compared with.
    rates: Vec<V::Scalar>,
    rate_terms: Vec<Terms>,
    /// The scale of each rate given by the force, `√(|G M⁻¹ force| |φ|)`, from the sizes of their terms. At rest there is no other scale.
    rate_scales: Vec<f64>,
    /// [`SHARED`] scales of values and rates. A constraint of bodies at rest at the origin has no terms of its own.
    shared: [Vec<f64>; 2],
}

impl<V: Vector> Examined<V> {
    pub(in crate::constraints) fn new<S: System<V>>(
        system: &WithConstraints<'_, V, S>,
        time: f64,
        q: &V,
        p: &V,
    ) -> Result<Self, Error> {
        let (constraints, dimension) = (system.constraints(), q.dimension());
        if constraints == 0 || constraints > dimension {
            return Err(Error::ConstraintCount {
                constraints,
                dimension,
            });
        }
        let (metric, point) = Metric::new(system, time, q, p);
        if let Some((constraint, component)) = point.gradients.misplaced() {
            return Err(Error::GradientPlace {
                constraint,
                component,
                constraints,
                dimension,
            });
        }
        let mut examined = Self {
            resolution: Resolution::new(system, q, &point.gradients),
            metric,
            point,
            scratch: array::from_fn(|_| q.zeros_like()),
            values: vec![V::Scalar::from_f64(0.0); constraints],
            terms: vec![Terms::default(); constraints],
            rates: vec![V::Scalar::from_f64(0.0); constraints],
            rate_terms: vec![Terms::default(); constraints],
            rate_scales: vec![0.0; constraints],
            shared: array::from_fn(|_| vec![0.0; constraints]),
        };
        examined.examine(system, time, q, p)?;
        Ok(examined)
    }

    /// Evaluates everything at a state.
    fn examine<S: System<V>>(
        &mut self,
        system: &WithConstraints<'_, V, S>,
        time: f64,
        q: &V,
        p: &V,
    ) -> Result<(), Error> {
        let Self {
            metric,
            point,
            scratch,
            ..
        } = self;
        let evaluated = metric.evaluate(system, time, (q, p), point, scratch);
        evaluated.map_err(|failure| named(error(failure, time), |k| system.constraint_name(k)))?;
        system.constraint_values(q, &mut self.values);
        let velocity = &mut self.scratch[0];
        system.velocity(V::Scalar::from_f64(time), q, p, velocity);
        let gradients = &self.point.gradients;
        gradients.multiply(velocity.as_slice(), &mut self.rates);
        for (terms, vector) in [(&mut self.terms, q), (&mut self.rate_terms, velocity)] {
            gradients.sizes(|k| vector.as_slice()[k].magnitude(), terms);
        }
        let [_, force, _] = &mut self.scratch;
        system.force(V::Scalar::from_f64(time), q, p, force);
        metric.apply(system, time, (q, p), force);
        let mut force_terms = vec![Terms::default(); self.rates.len()];
        gradients.sizes(|k| force.as_slice()[k].magnitude(), &mut force_terms);
        for (c, scale) in self.rate_scales.iter_mut().enumerate() {
            let value = self.terms[c].size() + self.resolution.values[c];
            let square = force_terms[c].size() * value;
            *scale = if square.is_finite() {
                num_traits::Float::sqrt(square)
            } else {
                0.0
            };
        }
        let sizes = |c: usize| self.terms[c].size() + self.resolution.values[c];
        let rates = |c: usize| self.rate_terms[c].size() + self.rate_scales[c];
        let metric = &self.metric;
        let at = (V::Scalar::from_f64(time), q, p);
        let lengths = metric.lengths(system, at, gradients, &mut self.scratch);
        self.shared = [shared(&lengths, sizes), shared(&lengths, rates)];
        let finite = |numbers: &[V::Scalar]| numbers.iter().all(|x| x.is_finite());
        if finite(&self.values) && finite(&self.rates) && finite(gradients.values()) {
            return Ok(());
        }
        Err(Error::NonFiniteState {
            what: Quantity::Constraint,
        })
    }

    /// The largest residual relative to its scale, with the number of its constraint.
    fn largest(
        values: &[V::Scalar],
        terms: &[Terms],
        other: impl Fn(usize) -> f64,
    ) -> (usize, f64) {
        let pairs = values.iter().zip(terms).enumerate();
        let relative =
            pairs.map(|(c, (value, terms))| (c, terms.relative(value.magnitude(), other(c))));
        relative.fold(
            (0, 0.0),
            |largest, next| {
                if next.1 > largest.1 { next } else { largest }
            },
        )
    }

    fn position(&self) -> (usize, f64) {
        Self::largest(&self.values, &self.terms, |c| {
            let others = self.shared[0][c] - self.terms[c].size();
            self.resolution.values[c].max(others)
        })
    }

    /// The constraint whose `G velocity` is farthest from zero relative to its scale, and this relative size.
    pub(in crate::constraints) fn momentum(&self) -> (usize, f64) {
        Self::largest(&self.rates, &self.rate_terms, |c| {
            let others = self.shared[1][c] - self.rate_terms[c].size();
            self.rate_scales[c].max(others)
        })
    }

    /// `|G velocity|` of a constraint.
    pub(in crate::constraints) fn rate(&self, constraint: usize) -> f64 {
        self.rates[constraint].magnitude()
    }

    /// Moves the momentum by `−Gᵀν`, until `G velocity = 0` or nothing changes.
    pub(in crate::constraints) fn project_momentum<S: System<V>>(
        &mut self,
        system: &WithConstraints<'_, V, S>,
        time: f64,
        q: &V,
        p: &mut V,
    ) -> Result<(), Error> {
        let mut best = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let (_, residual) = self.momentum();
            if residual == 0.0 || residual >= 0.5 * best && best <= CONSISTENT * 1e-4 {
                break;
            }
            best = best.min(residual);
            let mut multipliers = self.rates.clone();
            self.point.normal.solve(&mut multipliers);
            let gradients = &self.point.gradients;
            gradients.subtract_transposed(&multipliers, p.as_mut_slice());
            self.examine(system, time, q, p)?;
        }
        Ok(())
    }
}

/// The [`SHARED`] part of the largest size, for every constraint in its unit. Sizes are compared by the `lengths` of the gradients.
fn shared(lengths: &[f64], size: impl Fn(usize) -> f64) -> Vec<f64> {
    let sizes = (0..).zip(lengths).map(|(c, length)| size(c) / length);
    let largest = sizes.filter(|size| size.is_finite()).fold(0.0, f64::max);
    let scales = lengths.iter().map(|length| SHARED * largest * length);
    scales.collect()
}

/// The error of a state at which there are no multipliers.
pub(super) const fn error(failure: Failure, time: f64) -> Error {
    match failure {
        Failure::DependentConstraints { constraint, pivot } => Error::DependentConstraints {
            time,
            constraint,
            name: None,
            pivot,
        },
        Failure::NonFinite { what, .. } => Error::NonFiniteState { what },
        _ => Error::MovingGradients { time },
    }
}

/// Checks that position and momentum have one dimension and are finite.
pub(in crate::constraints) fn check_numbers<V: Vector>(q: &V, p: &V) -> Result<(), Error> {
    if q.dimension() != p.dimension() {
        return Err(Error::Dimension {
            position: q.dimension(),
            momentum: p.dimension(),
        });
    }
    for (vector, what) in [(q, Quantity::Position), (p, Quantity::Momentum)] {
        if !is_finite(vector) {
            return Err(Error::NonFiniteState { what });
        }
    }
    Ok(())
}

/// Checks that a state is on the constraints, `φ(q) = 0` and `G ∂H/∂p = 0`. Also checks that the constraints are independent and that the
/// system's gradients are correct.
pub(super) fn check_start<V: Vector, S: System<V>>(
    system: &WithConstraints<'_, V, S>,
    time: f64,
    q: &V,
    p: &V,
) -> Result<(), Error> {
    system.check_given()?;
    let examined = system.check(time, Examined::new(system, time, q, p))?;
    check_gradients(system, q, &examined.point.gradients)?;
    // Entries may vanish at the start.
    let mut gradients = examined.point.gradients.clone();
    let other = beside(q);
    if gradients.evaluate(|gradients| system.constraint_gradients(&other, gradients)) {
        check_gradients(system, &other, &gradients)?;
    }
    let (position, momentum) = (examined.position(), examined.momentum());
    if position.1 <= CONSISTENT && momentum.1 <= CONSISTENT {
        return Ok(());
    }
    let constraint = if position.1 > CONSISTENT {
        position.0
    } else {
        momentum.0
    };
    Err(Error::InconsistentStart {
        constraint,
        name: system.constraint_name(constraint),
        value: examined.values[constraint].magnitude(),
        rate: examined.rates[constraint].magnitude(),
    })
}

/// Compares the gradients at `q` with difference quotients of the constraints in two directions.
fn check_gradients<V: Vector, S: System<V>>(
    system: &WithConstraints<'_, V, S>,
    q: &V,
    gradients: &Gradients<V::Scalar>,
) -> Result<(), Error> {
    let constraints = system.constraints();
    let sizes = q.as_slice().iter().map(|x| x.magnitude());
    let size = sizes.fold(0.0, f64::max);
    let step = num_traits::Float::cbrt(V::Scalar::EPSILON) * if size > 0.0 { size } else { 1.0 };
    let zeros = || vec![V::Scalar::from_f64(0.0); constraints];
    let (mut high, mut low, mut stated) = (zeros(), zeros(), zeros());
    for ratio in [0.618_033_988_749_895, 0.754_877_666_246_693] {
        let direction = |k: usize| 0.25 + ((k + 1) as f64 * ratio) % 1.0;
        let mut moved = q.clone();
        for (sign, values) in [(1.0, &mut high), (-1.0, &mut low)] {
            moved.clone_from(q);
            for (k, component) in moved.as_mut_slice().iter_mut().enumerate() {
                *component += V::Scalar::from_f64(sign * step * direction(k));
            }
            system.constraint_values(&moved, values);
        }
        for (k, component) in moved.as_mut_slice().iter_mut().enumerate() {
            *component = V::Scalar::from_f64(direction(k));
        }
        gradients.multiply(moved.as_slice(), &mut stated);
        let mut terms = vec![Terms::default(); constraints];
        gradients.sizes(direction, &mut terms);
        let half = V::Scalar::from_f64((2.0 * step).recip());
        for (constraint, &stated) in stated.iter().enumerate() {
            let found = (high[constraint] - low[constraint]) * half;
            let difference = (stated - found).magnitude();
            // Where the constraint is undefined nearby, the difference is NaN and proves nothing.
            if terms[constraint].relative(difference, found.magnitude()) > GRADIENT {
                return Err(Error::GradientMismatch {
                    constraint,
                    name: system.constraint_name(constraint),
                    stated: stated.magnitude(),
                    found: found.magnitude(),
                });
            }
        }
    }
    Ok(())
}

/// The state on the constraints of a system that is nearest to `state` in the metric of its masses, to first order. With `G = ∂φ/∂q`,
///
/// ```text
/// q ← q − M⁻¹ G(q)ᵀ μ with φ(q) = 0,    then    p ← p − G(q)ᵀ ν with G(q) ∂H/∂p(q, p) = 0
/// ```
///
/// An integrator does not project by itself: [`Integrator::new`](symplectic_core::Integrator#method.new) refuses a state that is not on the
/// constraints.
///
/// # Errors
///
/// [`Error::NoExtra`] if the system does not give its constraints; [`Error::NoConsistentState`] if the iteration does not converge; [`Error::DependentConstraints`], [`Error::NonFiniteState`],
/// [`Error::ResizedEvaluation`], and the errors of a system whose constraints or gradients are wrong.
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::constraints::consistent;
/// use symplectic::{Error, State};
///
/// symplectic::hamiltonian! { Pendulum q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + 9.81 y constraints: { rod = x^2 + y^2 - 1 } }
///
/// # fn main() -> Result<(), Error> {
/// // A pendulum of length 1, |q|² − 1 = 0, that was read off a plot.
/// let read: State<SVector<f64, 2>> = State::from_arrays(0.0, [0.6, -0.79], [0.8, 0.61]);
/// let start = consistent(&Pendulum, read)?;
/// assert!((start.q.norm() - 1.0).abs() < 1e-15 && start.q.dot(&start.p).abs() < 1e-15);
/// # Ok(())
/// # }
/// ```
pub fn consistent<V: Vector, S: System<V, Class = Constrained<C>>, C: Class + Unconstrained>(
    system: &S,
    state: State<V>,
) -> Result<State<V>, Error> {
    let State { time, q, p } = state;
    check_numbers(&q, &p)?;
    let system = &with_constraints(system, q.dimension());
    system.check_given()?;
    system.check(time, moved_onto(system, time, q, p))
}

fn moved_onto<V: Vector, S: System<V>>(
    system: &WithConstraints<'_, V, S>,
    time: f64,
    mut q: V,
    mut p: V,
) -> Result<State<V>, Error> {
    let mut examined = Examined::new(system, time, &q, &p)?;
    let mut best = f64::INFINITY;
    for _ in 0..ITERATIONS {
        let (_, residual) = examined.position();
        if residual == 0.0 || residual >= 0.5 * best && best <= CONSISTENT * 1e-4 {
            break;
        }
        best = best.min(residual);
        let mut multipliers = examined.values.clone();
        examined.point.normal.solve(&mut multipliers);
        let mut change = q.zeros_like();
        let gradients = &examined.point.gradients;
        gradients.subtract_transposed(&multipliers, change.as_mut_slice());
        examined.metric.apply(system, time, (&q, &p), &mut change);
        let pairs = q.as_mut_slice().iter_mut().zip(change.as_slice());
        pairs.for_each(|(q, &change)| *q += change);
        examined.examine(system, time, &q, &p)?;
    }
    examined.project_momentum(system, time, &q, &mut p)?;
    let found = is_finite(&q) && is_finite(&p);
    if found && examined.position().1 <= CONSISTENT && examined.momentum().1 <= CONSISTENT {
        return Ok(State { time, q, p });
    }
    Err(Error::NoConsistentState {
        value: examined.values[examined.position().0].magnitude(),
        rate: examined.rates[examined.momentum().0].magnitude(),
    })
}
