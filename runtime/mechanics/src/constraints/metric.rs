//! `G M⁻¹ Gᵀ` of a system at a state.

use core::array;

use alloc::vec;
use alloc::vec::Vec;

use super::normal_matrix::{NormalMatrix, Products};
use super::{Gradients, Terms, WithConstraints};
use symplectic_core::inside::{is_finite, non_linear_velocity};
use symplectic_core::solver::Failure;
use symplectic_core::system::{Class, Masses};
use symplectic_core::{Quantity, Scalar, System, Vector};

/// How the velocity depends on the momentum.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum InverseMasses<T> {
    /// The velocity is the momentum.
    Unit,
    /// Each component of the velocity is the component of the momentum times a constant.
    Diagonal(Vec<T>),
    /// Any other dependence: `M⁻¹` stands for ∂velocity/∂p.
    Full,
}

/// The data from which `G M⁻¹ Gᵀ` is computed at every state.
#[derive(Clone, Debug)]
pub struct Metric<T> {
    masses: InverseMasses<T>,
    products: Products,
    /// Whether the velocity is linear in the momentum.
    linear: bool,
}

/// Data at a state on the constraints: at the start of a step, and at its end.
#[derive(Clone, Debug)]
pub struct Point<V: Vector> {
    /// The force without that of the constraints; only for separable systems.
    pub(super) force: V,
    pub(super) gradients: Gradients<V::Scalar>,
    /// `G M⁻¹ Gᵀ`, factored.
    pub(super) normal: NormalMatrix<V::Scalar>,
}

impl<T: Scalar> Metric<T> {
    /// The metric of a system at a state, and an empty point.
    pub(super) fn new<V: Vector<Scalar = T>, S: System<V>>(
        system: &WithConstraints<'_, V, S>,
        time: f64,
        q: &V,
        p: &V,
    ) -> (Self, Point<V>) {
        let constraints = system.constraints();
        let gradients = Gradients::learned(constraints, q.dimension(), |gradients| {
            system.constraint_gradients(q, gradients);
        });
        let linear = S::MASSES.are_unit() || non_linear_velocity(system, time, q, p).is_none();
        let masses = inverse_masses(system, linear, time, q, p);
        let products = Products::new(&gradients, &masses);
        let point = Point {
            force: q.zeros_like(),
            normal: NormalMatrix::new(constraints, &products),
            gradients,
        };
        let metric = Self {
            masses,
            products,
            linear,
        };
        (metric, point)
    }

    /// Evaluates the gradients at `q`, and factors `G M⁻¹ Gᵀ` there.
    pub(super) fn evaluate<V: Vector<Scalar = T>, S: System<V>>(
        &self,
        system: &WithConstraints<'_, V, S>,
        time: f64,
        (q, p): (&V, &V),
        point: &mut Point<V>,
        [velocity, direction, moved]: &mut [V; 3],
    ) -> Result<(), Failure> {
        let Point {
            gradients, normal, ..
        } = point;
        if !gradients.evaluate(|gradients| system.constraint_gradients(q, gradients)) {
            return Err(Failure::MovingGradients);
        }
        if self.masses != InverseMasses::Full {
            normal.assemble(&self.products, &self.masses, gradients);
            return normal.factor();
        }
        let at = T::from_f64(time);
        self.reference(system, (at, q, p), velocity, moved);
        if !is_finite(velocity) {
            return Err(Failure::NonFinite {
                what: Quantity::Velocity,
                stage: None,
            });
        }
        for row in 0..gradients.constraints() {
            let at = (at, q, p);
            self.direction(system, at, (gradients, row), [velocity, direction, moved]);
            normal.set_row(row, gradients, direction.as_slice());
        }
        normal.factor()
    }

    /// The reference velocity for differences: at momentum zero if the velocity was linear at the start, otherwise at `p`. Away from the
    /// start the velocity may be affine, as in a magnetic field.
    fn reference<V: Vector<Scalar = T>, S: System<V>>(
        &self,
        system: &WithConstraints<'_, V, S>,
        (time, q, p): (T, &V, &V),
        velocity: &mut V,
        zero: &mut V,
    ) {
        if self.linear {
            zero.as_mut_slice().fill(T::zero());
            system.velocity(time, q, zero, velocity);
        } else {
            system.velocity(time, q, p, velocity);
        }
    }

    /// `direction = M⁻¹ g` for the gradient g of a constraint, where `velocity` is the [reference](Self::reference). Overwrites `moved`.
    fn direction<V: Vector<Scalar = T>, S: System<V>>(
        &self,
        system: &WithConstraints<'_, V, S>,
        (time, q, p): (T, &V, &V),
        (gradients, constraint): (&Gradients<T>, usize),
        [velocity, direction, moved]: [&mut V; 3],
    ) {
        let mut largest = 0.0_f64;
        moved.as_mut_slice().fill(T::zero());
        let entries = gradients.entries();
        for (_, component, value) in entries.filter(|entry| entry.0 == constraint) {
            moved.as_mut_slice()[component] += value;
            largest = largest.max(value.magnitude());
        }
        if self.linear {
            system.velocity(time, q, moved, direction);
            let pairs = direction.as_mut_slice().iter_mut();
            for (direction, &velocity) in pairs.zip(velocity.as_slice()) {
                *direction -= velocity;
            }
            return;
        }
        let sizes = p.as_slice().iter().map(|x| x.magnitude());
        let size = sizes.fold(0.0, f64::max);
        let size = if size > 0.0 { size } else { 1.0 };
        let step = num_traits::Float::sqrt(T::EPSILON) * size;
        let step = step / largest.max(f64::MIN_POSITIVE);
        let (by, back) = (T::from_f64(step), T::from_f64(step.recip()));
        for (moved, &p) in moved.as_mut_slice().iter_mut().zip(p.as_slice()) {
            *moved = p + by * *moved;
        }
        system.velocity(time, q, moved, direction);
        let pairs = direction.as_mut_slice().iter_mut();
        for (direction, &velocity) in pairs.zip(velocity.as_slice()) {
            *direction = (*direction - velocity) * back;
        }
    }

    /// Whether `M⁻¹` is known only through evaluations of the velocity.
    pub(super) fn is_full(&self) -> bool {
        self.masses == InverseMasses::Full
    }

    /// The largest difference between the numbers of two constraints that share a component.
    pub(super) const fn half_bandwidth(&self) -> usize {
        self.products.half_bandwidth()
    }

    /// `left M⁻¹ rightᵀ` as a band by rows, with `M⁻¹` at a state.
    pub(super) fn cross<V: Vector<Scalar = T>, S: System<V>>(
        &self,
        system: &WithConstraints<'_, V, S>,
        (time, q, p): (T, &V, &V),
        left: &Gradients<T>,
        right: &Gradients<T>,
        band: &mut [T],
        [velocity, direction, moved]: &mut [V; 3],
    ) {
        band.fill(T::zero());
        let half = self.half_bandwidth();
        let place = |row: usize, column: usize| row * (2 * half + 1) + column + half - row;
        if self.masses != InverseMasses::Full {
            let mass = |component: usize| match &self.masses {
                InverseMasses::Diagonal(inverse) => inverse[component],
                _ => T::one(),
            };
            for [a, b, row, column, component] in self.products.pairs() {
                let (left, right) = (left.values(), right.values());
                band[place(row, column)] += left[a] * right[b] * mass(component);
                if row != column {
                    band[place(column, row)] += left[b] * right[a] * mass(component);
                }
            }
            return;
        }
        self.reference(system, (time, q, p), velocity, moved);
        for column in 0..right.constraints() {
            let at = (time, q, p);
            self.direction(system, at, (right, column), [velocity, direction, moved]);
            for (row, component, value) in left.entries() {
                band[place(row, column)] += value * direction.as_slice()[component];
            }
        }
    }

    /// The length `√(G M⁻¹ Gᵀ)_cc` of the gradient of every constraint, with `M⁻¹` at a state.
    pub(super) fn lengths<V: Vector<Scalar = T>, S: System<V>>(
        &self,
        system: &WithConstraints<'_, V, S>,
        at: (T, &V, &V),
        gradients: &Gradients<T>,
        scratch: &mut [V; 3],
    ) -> Vec<f64> {
        let width = 2 * self.half_bandwidth() + 1;
        let mut band = vec![T::zero(); width * gradients.constraints()];
        self.cross(system, at, gradients, gradients, &mut band, scratch);
        let rows = band.chunks_exact(width);
        let squares = rows.map(|row| row[width / 2].magnitude());
        squares.map(num_traits::Float::sqrt).collect()
    }

    /// Raises the terms of every constraint to `factor Σ_k |G M⁻¹|_k sizes_k`: so far do momenta of these sizes change `factor G velocity`.
    pub(super) fn raise<V: Vector<Scalar = T>, S: System<V>>(
        &self,
        system: &WithConstraints<'_, V, S>,
        (time, q, p): (f64, &V, &V),
        gradients: &Gradients<T>,
        (sizes, factor): (&[f64], f64),
        terms: &mut [Terms],
        [velocity, direction, moved]: &mut [V; 3],
    ) {
        if self.masses == InverseMasses::Full {
            let at = (T::from_f64(time), q, p);
            self.reference(system, at, velocity, moved);
            for (constraint, terms) in terms.iter_mut().enumerate() {
                let row = (gradients, constraint);
                self.direction(system, at, row, [velocity, direction, moved]);
                let pairs = direction.as_slice().iter().zip(sizes);
                let sum: f64 = pairs.map(|(x, size)| x.magnitude() * size).sum();
                terms.raise(factor * sum);
            }
            return;
        }
        terms.iter_mut().for_each(|terms| terms.raise(0.0));
        for (constraint, component, value) in gradients.entries() {
            let velocity = match &self.masses {
                InverseMasses::Diagonal(inverse) => inverse[component].magnitude(),
                _ => 1.0,
            } * sizes[component];
            let terms = &mut terms[constraint];
            terms.raise(terms.least() + factor * value.magnitude() * velocity);
        }
    }

    /// `vector = M⁻¹ vector` for a vector `Gᵀ factors`, at a state.
    pub(super) fn apply<V: Vector<Scalar = T>, S: System<V>>(
        &self,
        system: &WithConstraints<'_, V, S>,
        time: f64,
        (q, p): (&V, &V),
        vector: &mut V,
    ) {
        match &self.masses {
            InverseMasses::Unit => {}
            InverseMasses::Diagonal(inverse) => {
                for (x, &inverse) in vector.as_mut_slice().iter_mut().zip(inverse) {
                    *x *= inverse;
                }
            }
            InverseMasses::Full => {
                let [mut at, mut there, mut moved] = array::from_fn(|_| p.clone());
                let time = T::from_f64(time);
                let pairs = moved.as_mut_slice().iter_mut().zip(vector.as_slice());
                pairs.for_each(|(p, &x)| *p += x);
                system.velocity(time, q, p, &mut at);
                system.velocity(time, q, &moved, &mut there);
                let pairs = there.as_slice().iter().zip(at.as_slice());
                for (x, (&there, &at)) in vector.as_mut_slice().iter_mut().zip(pairs) {
                    *x = there - at;
                }
            }
        }
    }
}

/// How the velocity of a system depends on the momentum, as far as evaluations can tell.
fn inverse_masses<V: Vector, S: System<V>>(
    system: &WithConstraints<'_, V, S>,
    linear: bool,
    time: f64,
    q: &V,
    p: &V,
) -> InverseMasses<V::Scalar> {
    if S::MASSES.are_unit() {
        return InverseMasses::Unit;
    }
    if !(S::Class::SEPARABLE || S::MASSES == Masses::Constant) || !linear {
        return InverseMasses::Full;
    }
    let velocity = |momentum: &dyn Fn(usize) -> f64| {
        let (mut point, mut velocity) = (p.zeros_like(), p.zeros_like());
        for (k, component) in point.as_mut_slice().iter_mut().enumerate() {
            *component = V::Scalar::from_f64(momentum(k));
        }
        system.velocity(V::Scalar::from_f64(time), q, &point, &mut velocity);
        velocity
    };
    let inverse = velocity(&|_| 1.0);
    // Momenta whose components are all different, so that entries off the diagonal show.
    let tries = [0.618_033_988_749_895, 0.754_877_666_246_693];
    let diagonal = tries.iter().all(|ratio| {
        let momentum = |k: usize| 1.0 + (k as f64 * ratio) % 1.0;
        let tried = velocity(&momentum);
        let mut pairs = inverse.as_slice().iter().zip(tried.as_slice()).enumerate();
        pairs.all(|(k, (&inverse, &tried))| {
            let expected = inverse * V::Scalar::from_f64(momentum(k));
            (tried - expected).magnitude() <= 16.0 * V::Scalar::EPSILON * expected.magnitude()
        })
    });
    match diagonal {
        true => InverseMasses::Diagonal(inverse.as_slice().to_vec()),
        false => InverseMasses::Full,
    }
}
