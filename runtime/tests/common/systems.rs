use std::cell::Cell;

use symplectic::nalgebra::{DVector, SVector, Vector1, Vector2};
use symplectic::solver::FixedPoint;
use symplectic::{
    General, Hamiltonian, Scalar, Separable, SeparableHamiltonian, State, System, Vector,
};

/// H = Σ p²/2 − cos q, over every vector, counting its evaluations.
#[derive(Default)]
pub struct Pendulum {
    pub velocities: Cell<u32>,
    pub forces: Cell<u32>,
}

impl<V: Vector> System<V> for Pendulum {
    type Class = Separable;
    type Solver = FixedPoint;

    fn velocity(&self, _time: V::Scalar, _q: &V, p: &V, velocity: &mut V) {
        self.velocities.set(self.velocities.get() + 1);
        velocity.as_mut_slice().copy_from_slice(p.as_slice());
    }

    fn force(&self, _time: V::Scalar, q: &V, _p: &V, force: &mut V) {
        self.forces.set(self.forces.get() + 1);
        for (force, q) in force.as_mut_slice().iter_mut().zip(q.as_slice()) {
            *force = -q.sin();
        }
    }

    fn energy(&self, _time: V::Scalar, q: &V, p: &V) -> Option<V::Scalar> {
        let half = V::Scalar::from_f64(0.5);
        let terms = q
            .as_slice()
            .iter()
            .zip(p.as_slice())
            .map(|(q, p)| *p * *p * half - q.cos());
        terms.reduce(|sum, term| sum + term)
    }
}

/// H = (q² + 1)(p² + 1)/2.
#[derive(Clone, Copy, Debug)]
pub struct Product;

impl Hamiltonian for Product {
    type Class = General;
    type Vector<T: Scalar> = SVector<T, 1>;

    fn velocity<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, 1>,
        p: &SVector<T, 1>,
        velocity: &mut SVector<T, 1>,
    ) {
        velocity[0] = p[0] * (q.dot(q) + T::one());
    }

    fn force<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, 1>,
        p: &SVector<T, 1>,
        force: &mut SVector<T, 1>,
    ) {
        *force = -q * (p.dot(p) + T::one());
    }

    fn energy<T: Scalar>(&self, _time: T, q: &SVector<T, 1>, p: &SVector<T, 1>) -> Option<T> {
        Some((q.dot(q) + T::one()) * (p.dot(p) + T::one()) * T::from_f64(0.5))
    }
}

/// H = |p|²/2 − 1/|q|.
#[derive(Clone, Copy, Debug)]
pub struct Kepler;

impl SeparableHamiltonian for Kepler {
    type Vector<T: Scalar> = SVector<T, 2>;

    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
        *velocity = *p;
    }

    fn force<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, force: &mut SVector<T, 2>) {
        let square = q.dot(q);
        *force = -q * (square * square.sqrt()).recip();
    }

    fn energy<T: Scalar>(&self, _time: T, q: &SVector<T, 2>, p: &SVector<T, 2>) -> Option<T> {
        Some(p.dot(p) * T::from_f64(0.5) - q.dot(q).sqrt().recip())
    }
}

/// The perihelion of an orbit of [`Kepler`] with eccentricity 0.6.
pub fn perihelion() -> State<Vector2<f64>> {
    State::from_arrays(0.0, [0.4, 0.0], [0.0, 2.0])
}

/// H = p²/2 + q²/2 − q cos 3t.
#[derive(Clone, Copy)]
pub struct Driven;

impl System<Vector1<f64>> for Driven {
    type Class = Separable;
    type Solver = FixedPoint;

    fn velocity(
        &self,
        _time: f64,
        _q: &Vector1<f64>,
        p: &Vector1<f64>,
        velocity: &mut Vector1<f64>,
    ) {
        *velocity = *p;
    }

    fn force(&self, time: f64, q: &Vector1<f64>, _p: &Vector1<f64>, force: &mut Vector1<f64>) {
        force[0] = (3.0 * time).cos() - q[0];
    }
}

impl Driven {
    /// The solution from q = 1, p = 0 at t = 0: q = (9 cos t − cos 3t)/8.
    pub fn exact(time: f64) -> State<Vector1<f64>> {
        let q = (9.0 * time.cos() - (3.0 * time).cos()) / 8.0;
        let p = (-9.0 * time.sin() + 3.0 * (3.0 * time).sin()) / 8.0;
        State::new(time, Vector1::new(q), Vector1::new(p))
    }
}

pub fn point(q: f64, p: f64) -> State<Vector1<f64>> {
    State::new(0.0, Vector1::new(q), Vector1::new(p))
}

/// Masses 1 apart joined by stiff springs: the force is a small difference of large positions, hence noisy.
#[derive(Clone, Copy)]
pub struct Chain;

impl Chain {
    pub const STIFFNESS: f64 = 1e4;

    fn pull(q: &DVector<f64>, force: &mut DVector<f64>) {
        force.fill(0.0);
        for i in 1..q.len() {
            let tension = Self::STIFFNESS * (q[i] - q[i - 1] - 1.0);
            force[i - 1] += tension;
            force[i] -= tension;
        }
    }

    /// At rest, with every mass off its place by up to `amplitude`.
    pub fn start(amplitude: f64) -> State<DVector<f64>> {
        let place = |i: usize| i as f64 + amplitude * (0.7 * (i * i) as f64).sin();
        State::new(
            0.0,
            DVector::from_fn(100, |i, _| place(i)),
            DVector::zeros(100),
        )
    }
}

impl System<DVector<f64>> for Chain {
    type Class = Separable;
    type Solver = FixedPoint;

    fn velocity(
        &self,
        _time: f64,
        _q: &DVector<f64>,
        p: &DVector<f64>,
        velocity: &mut DVector<f64>,
    ) {
        velocity.copy_from(p);
    }

    fn force(&self, _time: f64, q: &DVector<f64>, _p: &DVector<f64>, force: &mut DVector<f64>) {
        Self::pull(q, force);
    }
}

/// [`Chain`], not known to be separable.
#[derive(Clone, Copy)]
pub struct GeneralChain;

impl System<DVector<f64>> for GeneralChain {
    type Class = General;
    type Solver = FixedPoint;

    fn velocity(&self, _t: f64, _q: &DVector<f64>, p: &DVector<f64>, velocity: &mut DVector<f64>) {
        velocity.copy_from(p);
    }

    fn force(&self, _t: f64, q: &DVector<f64>, _p: &DVector<f64>, force: &mut DVector<f64>) {
        Chain::pull(q, force);
    }
}

/// 1 + sin(t)/4
fn pulse<T: Scalar>(time: T) -> T {
    T::one() + time.sin() * T::from_f64(0.25)
}

/// H = |p|²/2 − (1 + sin(t)/4)/|q|: separable, depends on time, conserves the angular momentum.
#[derive(Clone, Copy, Debug)]
pub struct PulsatingStar<'a>(pub &'a Fuse);

/// H = (|q|² + 1)(|p|² + 1)/2 + (1 + sin(t)/4)|q|²/2: not separable, depends on time, conserves the angular momentum.
///
/// Only the potential depends on time. If `c̃` differs from `c`, force and velocity of a stage are evaluated at different times. A step then
/// preserves dq ∧ dp only if the derivatives ∂²H/∂q∂p do not depend on time.
#[derive(Clone, Copy, Debug)]
pub struct PulsatingProduct<'a>(pub &'a Fuse);

/// Counts evaluations down; after the last one, evaluations are NaN.
#[derive(Debug)]
pub struct Fuse(Cell<u64>, Cell<bool>);

impl Fuse {
    /// For a system whose evaluations are always finite.
    pub const fn never() -> Self {
        Self(Cell::new(u64::MAX), Cell::new(false))
    }

    pub fn set(&self, evaluations: u64) {
        self.0.set(evaluations);
        self.1.set(false);
    }

    /// One evaluation is NaN, after this number of others.
    pub fn set_once(&self, evaluations: u64) {
        self.0.set(evaluations);
        self.1.set(true);
    }

    /// Whether all evaluations were finite.
    pub fn holds(&self) -> bool {
        self.0.get() > 0
    }

    /// Counts an evaluation: returns 1, or NaN if none is left.
    fn burn<T: Scalar>(&self) -> T {
        match self.0.get() {
            0 => {
                if self.1.get() {
                    self.0.set(u64::MAX);
                }
                T::from_f64(f64::NAN)
            }
            u64::MAX => T::one(),
            left => {
                self.0.set(left - 1);
                T::one()
            }
        }
    }
}

impl SeparableHamiltonian for PulsatingStar<'_> {
    type Vector<T: Scalar> = SVector<T, 2>;

    fn velocity<T: Scalar>(&self, _time: T, p: &SVector<T, 2>, velocity: &mut SVector<T, 2>) {
        *velocity = p * self.0.burn::<T>();
    }

    fn force<T: Scalar>(&self, time: T, q: &SVector<T, 2>, force: &mut SVector<T, 2>) {
        SeparableHamiltonian::force(&Kepler, time, q, force);
        *force *= pulse::<T>(time) * self.0.burn();
    }
}

impl Hamiltonian for PulsatingProduct<'_> {
    type Class = General;
    type Vector<T: Scalar> = SVector<T, 2>;

    fn velocity<T: Scalar>(
        &self,
        _time: T,
        q: &SVector<T, 2>,
        p: &SVector<T, 2>,
        velocity: &mut SVector<T, 2>,
    ) {
        *velocity = p * ((q.dot(q) + T::one()) * self.0.burn());
    }

    fn force<T: Scalar>(
        &self,
        time: T,
        q: &SVector<T, 2>,
        p: &SVector<T, 2>,
        force: &mut SVector<T, 2>,
    ) {
        *force = q * (-(p.dot(p) + T::one() + pulse(time)) * self.0.burn());
    }
}
