//! The methods and the constrained systems of these tests.

use symplectic::constraints::{Constrained, Gradients, HolonomicConstraints, consistent};
use symplectic::nalgebra::{DVector, SVector};
use symplectic::system::Masses;
use symplectic::{General, Hamiltonian, Scalar, Separable, State};

pub use crate::methods::{Lobatto3, Lobatto4, Lobatto5};

symplectic::tableau! {
    /// Symplectic Euler.
    pub Euler { basis: polynomial(1), nodes: [0], require: [constrained, order == 1] }
    /// Its adjoint.
    pub AdjointEuler { basis: polynomial(1), nodes: [1], require: [constrained, order == 1] }
    pub Rattle { basis: polynomial(2), nodes: lobatto(2), require: [constrained, order == 2] }
    pub Lobatto6 { basis: polynomial(6), nodes: lobatto(6), require: [constrained, order == 10] }
    pub Lobatto7 { basis: polynomial(7), nodes: lobatto(7), require: [constrained, order == 12] }
    pub Lobatto8 { basis: polynomial(8), nodes: lobatto(8), require: [constrained, order == 14] }
    pub NewtonCotes4 { basis: polynomial(4), nodes: newton-cotes(4), require: [constrained, order == 2] }
    pub NewtonCotes5 { basis: polynomial(5), nodes: newton-cotes(5), require: [constrained, order == 4] }
    pub ClenshawCurtis4 { basis: polynomial(4), nodes: clenshaw-curtis(4), require: [constrained, order == 2] }
    pub ClenshawCurtis5 { basis: polynomial(5), nodes: clenshaw-curtis(5), require: [constrained, order == 4] }
    /// Not symmetric.
    pub Quarter { basis: polynomial(3), nodes: [0, 1/4, 1], require: [constrained, order == 2] }
    /// Functions that are no polynomials.
    pub Waves { basis: [1, cos(pi*t), sin(pi*t)], nodes: [0, 1/2, 1], require: [constrained], accept: verified(100 bits) }
}

symplectic::composition! {
    /// The middle of a step is on the constraints.
    pub HalfSteps { base: symplectic-euler, weights: [adjoint(1/2), 1/2], require: [order == 2] }
    /// Its tableau is that of RATTLE.
    pub OtherHalfSteps { base: symplectic-euler, weights: [1/2, adjoint(1/2)], require: [constrained, order == 2] }
    pub Rattle4 { base: lobatto-2, weights: triple_jump(4), require: [order == 4] }
    pub Rattle6 { base: lobatto-2, weights: triple_jump(6), require: [order == 6] }
    /// Its steps are those of RATTLE, since RATTLE is its own adjoint.
    pub RattleAndAdjoint { base: lobatto-2, weights: [1/2, adjoint(1/2)], require: [constrained, order == 2] }
    /// The first stage of the tableau is the end of the step.
    pub AdjointLobatto3 { base: lobatto-3, adjoint: true, require: [constrained, order == 4] }
    pub AdjointQuarter {
        base: [basis: polynomial(3), nodes: [0, 1/4, 1]],
        adjoint: true,
        require: [constrained, order == 2],
    }
    /// A method that is not symmetric, with the adjoint in the middle.
    pub AdjointBetween {
        base: [basis: polynomial(3), nodes: [0, 1/4, 1]],
        weights: [1/4, adjoint(1/2), 1/4],
        require: [constrained, order == 2],
    }
    /// Half steps of symplectic Euler and its adjoint, with negative weights.
    pub HalfSteps4 {
        base: [base: symplectic-euler, weights: [adjoint(1/2), 1/2]],
        weights: triple_jump(4),
        require: [constrained, nonholonomic, order == 4],
    }
    /// Different methods, of order 4 and of order 2, a negative weight and a step of zero size.
    pub Mixed {
        compose: [[3/2, base: lobatto-3, adjoint: true], [0, base: lobatto-4], [-1/2, base: lobatto-2]],
        require: [constrained, order == 2],
    }
}

type V2<T> = SVector<T, 2>;
type V3<T> = SVector<T, 3>;
pub type V6<T> = SVector<T, 6>;

/// A plane pendulum of length 1: H = |p|²/2 + y, |q|² = 1.
#[derive(Clone, Copy)]
pub struct Pendulum;

impl Hamiltonian for Pendulum {
    type Class = Constrained<Separable>;
    type Vector<T: Scalar> = V2<T>;

    const MASSES: Masses = Masses::Unit;

    fn velocity<T: Scalar>(&self, _: T, _: &V2<T>, p: &V2<T>, velocity: &mut V2<T>) {
        *velocity = *p;
    }

    fn force<T: Scalar>(&self, _: T, _: &V2<T>, _: &V2<T>, force: &mut V2<T>) {
        *force = V2::from([T::zero(), -T::one()]);
    }

    fn energy<T: Scalar>(&self, _: T, q: &V2<T>, p: &V2<T>) -> Option<T> {
        Some(p.dot(p) * T::from_f64(0.5) + q[1])
    }

    fn extra<T: Scalar>(&self) -> Option<&dyn HolonomicConstraints<V2<T>>> {
        Some(self)
    }
}

impl<T: Scalar> HolonomicConstraints<V2<T>> for Pendulum {
    fn constraints(&self) -> usize {
        1
    }
    fn constraint_values(&self, q: &V2<T>, values: &mut [T]) {
        values[0] = q.dot(q) - T::one();
    }
    fn constraint_gradients(&self, q: &V2<T>, gradients: &mut Gradients<T>) {
        for k in 0..2 {
            gradients.set(0, k, q[k] + q[k]);
        }
    }
}

/// A plane pendulum of length 1 in a field of this direction.
#[derive(Clone, Copy)]
pub struct Turned(pub V2<f64>);

impl Hamiltonian for Turned {
    type Class = Constrained<Separable>;
    type Vector<T: Scalar> = V2<T>;

    const MASSES: Masses = Masses::Unit;

    fn velocity<T: Scalar>(&self, time: T, q: &V2<T>, p: &V2<T>, velocity: &mut V2<T>) {
        Pendulum.velocity(time, q, p, velocity);
    }

    fn force<T: Scalar>(&self, _: T, _: &V2<T>, _: &V2<T>, force: &mut V2<T>) {
        *force = self.0.map(T::from_f64);
    }

    fn extra<T: Scalar>(&self) -> Option<&dyn HolonomicConstraints<V2<T>>> {
        Some(self)
    }
}

impl<T: Scalar> HolonomicConstraints<V2<T>> for Turned {
    fn constraints(&self) -> usize {
        1
    }
    fn constraint_values(&self, q: &V2<T>, values: &mut [T]) {
        Pendulum.constraint_values(q, values);
    }
    fn constraint_gradients(&self, q: &V2<T>, gradients: &mut Gradients<T>) {
        Pendulum.constraint_gradients(q, gradients);
    }
}

/// The same pendulum by its angle from below: H = p²/2 − cos a.
pub struct Angle;

impl symplectic::SeparableHamiltonian for Angle {
    type Vector<T: Scalar> = SVector<T, 1>;

    fn velocity<T: Scalar>(&self, _: T, p: &SVector<T, 1>, velocity: &mut SVector<T, 1>) {
        velocity[0] = p[0];
    }

    fn force<T: Scalar>(&self, _: T, q: &SVector<T, 1>, force: &mut SVector<T, 1>) {
        force[0] = -q[0].sin();
    }
}

/// Two spherical pendulums, one hanging on the other, with masses 1 and 2 and lengths 1.
#[derive(Clone, Copy)]
pub struct DoubleSpherical;

impl Hamiltonian for DoubleSpherical {
    type Class = Constrained<Separable>;
    type Vector<T: Scalar> = V6<T>;

    fn velocity<T: Scalar>(&self, _: T, _: &V6<T>, p: &V6<T>, velocity: &mut V6<T>) {
        for k in 0..3 {
            velocity[k] = p[k];
            velocity[k + 3] = p[k + 3] * T::from_f64(0.5);
        }
    }

    fn force<T: Scalar>(&self, _: T, _: &V6<T>, _: &V6<T>, force: &mut V6<T>) {
        *force = V6::from([0.0, 0.0, -1.0, 0.0, 0.0, -2.0].map(T::from_f64));
    }

    fn energy<T: Scalar>(&self, _: T, q: &V6<T>, p: &V6<T>) -> Option<T> {
        let kinetic = |k: usize| p[k] * p[k] * T::from_f64(if k < 3 { 0.5 } else { 0.25 });
        let kinetic = (1..6).fold(kinetic(0), |sum, k| sum + kinetic(k));
        Some(kinetic + q[2] + q[5] + q[5])
    }

    fn extra<T: Scalar>(&self) -> Option<&dyn HolonomicConstraints<V6<T>>> {
        Some(self)
    }
}

impl<T: Scalar> HolonomicConstraints<V6<T>> for DoubleSpherical {
    fn constraints(&self) -> usize {
        2
    }
    fn constraint_values(&self, q: &V6<T>, values: &mut [T]) {
        let (first, second) = (q.fixed_rows::<3>(0), q.fixed_rows::<3>(3));
        let link = second - first;
        values[0] = first.dot(&first) - T::one();
        values[1] = link.dot(&link) - T::one();
    }
    fn constraint_gradients(&self, q: &V6<T>, gradients: &mut Gradients<T>) {
        for k in 0..3 {
            let link = q[k + 3] - q[k];
            gradients.set(0, k, q[k] + q[k]);
            gradients.set(1, k, -(link + link));
            gradients.set(1, k + 3, link + link);
        }
    }
}

/// A bead on a sphere whose kinetic energy depends on the place: H = (1 + z²)|p|²/2 + z, |q|² = 1.
#[derive(Clone, Copy)]
pub struct Bead;

/// A bead on a sphere whose velocity is not linear in the momentum: H = √(1 + |p|²) + z, |q|² = 1.
#[derive(Clone, Copy)]
pub struct Relativistic;

macro_rules! on_the_sphere {
    ($($bead:ident)*) => {$(
        impl<T: Scalar> HolonomicConstraints<V3<T>> for $bead {
            fn constraints(&self) -> usize {
                1
            }

            fn constraint_values(&self, q: &V3<T>, values: &mut [T]) {
                values[0] = q.dot(q) - T::one();
            }

            fn constraint_gradients(&self, q: &V3<T>, gradients: &mut Gradients<T>) {
                for k in 0..3 {
                    gradients.set(0, k, q[k] + q[k]);
                }
            }
        }
    )*};
}

on_the_sphere! { Bead Relativistic }

impl Hamiltonian for Bead {
    type Class = Constrained<General>;
    type Vector<T: Scalar> = V3<T>;

    fn velocity<T: Scalar>(&self, _: T, q: &V3<T>, p: &V3<T>, velocity: &mut V3<T>) {
        *velocity = p * (T::one() + q[2] * q[2]);
    }

    fn force<T: Scalar>(&self, _: T, q: &V3<T>, p: &V3<T>, force: &mut V3<T>) {
        *force = V3::from([T::zero(), T::zero(), -(q[2] * p.dot(p)) - T::one()]);
    }

    fn energy<T: Scalar>(&self, _: T, q: &V3<T>, p: &V3<T>) -> Option<T> {
        Some((T::one() + q[2] * q[2]) * p.dot(p) * T::from_f64(0.5) + q[2])
    }

    fn extra<T: Scalar>(&self) -> Option<&dyn HolonomicConstraints<V3<T>>> {
        Some(self)
    }
}

impl Hamiltonian for Relativistic {
    type Class = Constrained<Separable>;
    type Vector<T: Scalar> = V3<T>;

    fn velocity<T: Scalar>(&self, _: T, _: &V3<T>, p: &V3<T>, velocity: &mut V3<T>) {
        *velocity = p * (T::one() + p.dot(p)).sqrt().recip();
    }

    fn force<T: Scalar>(&self, _: T, _: &V3<T>, _: &V3<T>, force: &mut V3<T>) {
        *force = V3::from([0.0, 0.0, -1.0].map(T::from_f64));
    }

    fn energy<T: Scalar>(&self, _: T, q: &V3<T>, p: &V3<T>) -> Option<T> {
        Some((T::one() + p.dot(p)).sqrt() + q[2])
    }

    fn extra<T: Scalar>(&self) -> Option<&dyn HolonomicConstraints<V3<T>>> {
        Some(self)
    }
}

/// A charged bead in the magnetic field 20 along z, on a sphere through the origin, where the vector potential vanishes:
/// H = |p − A(q)|²/2 + z, A = 10 (−y, x, 0).
#[derive(Clone, Copy)]
pub struct Charged;

impl Hamiltonian for Charged {
    type Class = Constrained<General>;
    type Vector<T: Scalar> = V3<T>;

    fn velocity<T: Scalar>(&self, _: T, q: &V3<T>, p: &V3<T>, velocity: &mut V3<T>) {
        let half = T::from_f64(10.0);
        *velocity = V3::from([p[0] + half * q[1], p[1] - half * q[0], p[2]]);
    }

    fn force<T: Scalar>(&self, time: T, q: &V3<T>, p: &V3<T>, force: &mut V3<T>) {
        let mut velocity = *p;
        Hamiltonian::velocity(self, time, q, p, &mut velocity);
        let half = T::from_f64(10.0);
        *force = V3::from([half * velocity[1], -(half * velocity[0]), -T::one()]);
    }

    fn energy<T: Scalar>(&self, time: T, q: &V3<T>, p: &V3<T>) -> Option<T> {
        let mut velocity = *p;
        Hamiltonian::velocity(self, time, q, p, &mut velocity);
        Some(velocity.dot(&velocity) * T::from_f64(0.5) + q[2])
    }

    fn extra<T: Scalar>(&self) -> Option<&dyn HolonomicConstraints<V3<T>>> {
        Some(self)
    }
}

impl<T: Scalar> HolonomicConstraints<V3<T>> for Charged {
    fn constraints(&self) -> usize {
        1
    }
    fn constraint_values(&self, q: &V3<T>, values: &mut [T]) {
        values[0] = q.dot(q) - (q[0] + q[0]);
    }
    fn constraint_gradients(&self, q: &V3<T>, gradients: &mut Gradients<T>) {
        for k in 0..3 {
            let centre = T::from_f64(if k == 0 { 1.0 } else { 0.0 });
            gradients.set(0, k, (q[k] - centre) + (q[k] - centre));
        }
    }
}

/// A hanging chain of links in the plane, with unit masses.
#[derive(Clone, Copy)]
pub struct Links(pub usize);

impl Links {
    /// The chain stretched out sideways, at rest.
    pub fn start(self) -> State<DVector<f64>> {
        let place = |k: usize| {
            if k.is_multiple_of(2) {
                (k / 2 + 1) as f64
            } else {
                0.0
            }
        };
        let q = DVector::from_iterator(2 * self.0, (0..2 * self.0).map(place));
        State::new(0.0, q, DVector::zeros(2 * self.0))
    }
}

impl Hamiltonian for Links {
    type Class = Constrained<Separable>;
    type Vector<T: Scalar> = DVector<T>;

    const MASSES: Masses = Masses::Unit;

    fn velocity<T: Scalar>(&self, _: T, _: &DVector<T>, p: &DVector<T>, velocity: &mut DVector<T>) {
        velocity.copy_from(p);
    }

    fn force<T: Scalar>(&self, _: T, _: &DVector<T>, _: &DVector<T>, force: &mut DVector<T>) {
        for (k, force) in force.iter_mut().enumerate() {
            *force = T::from_f64(-((k % 2) as f64));
        }
    }

    fn energy<T: Scalar>(&self, _: T, q: &DVector<T>, p: &DVector<T>) -> Option<T> {
        let heights = q.iter().skip(1).step_by(2);
        Some(heights.fold(p.dot(p) * T::from_f64(0.5), |sum, &y| sum + y))
    }

    fn extra<T: Scalar>(&self) -> Option<&dyn HolonomicConstraints<DVector<T>>> {
        Some(self)
    }
}

impl<T: Scalar> HolonomicConstraints<DVector<T>> for Links {
    fn constraints(&self) -> usize {
        self.0
    }
    fn constraint_values(&self, q: &DVector<T>, values: &mut [T]) {
        let (mut x, mut y) = (T::zero(), T::zero());
        for (value, place) in values.iter_mut().zip(q.as_slice().chunks(2)) {
            let link = (place[0] - x, place[1] - y);
            *value = link.0 * link.0 + link.1 * link.1 - T::one();
            (x, y) = (place[0], place[1]);
        }
    }
    fn constraint_gradients(&self, q: &DVector<T>, gradients: &mut Gradients<T>) {
        for link in 0..self.0 {
            for k in 0..2 {
                let here = 2 * link + k;
                let before = if link > 0 { q[here - 2] } else { T::zero() };
                let difference = (q[here] - before) + (q[here] - before);
                gradients.set(link, here, difference);
                if link > 0 {
                    gradients.set(link, here - 2, -difference);
                }
            }
        }
    }
}

/// A state of the double pendulum on its constraints.
pub fn double_start() -> State<V6<f64>> {
    let q = [0.8, 0.0, -0.6, 0.8, 1.0, -0.6];
    let state = State::from_arrays(0.0, q, [0.0, 0.5, 0.0, 0.3, 1.0, 0.3]);
    consistent(&DoubleSpherical, state).expect("regular")
}

/// A state on the sphere, of a system on it.
pub fn sphere_start() -> State<V3<f64>> {
    State::from_arrays(0.0, [0.6, 0.0, -0.8], [0.4, 0.7, 0.3])
}
