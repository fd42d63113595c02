//! The derivatives of a Lagrangian.

use alloc::vec;
use alloc::vec::Vec;

use num_traits::Zero;

use crate::variational::failure::Failure;
use crate::variational::stages::StageOfStep;
use symplectic_core::inside::beside;
use symplectic_core::system::Lagrangian;
use symplectic_core::{Error, Quantity, Scalar, Vector};
use symplectic_linearisation::HyperDual;

/// The momentum and its rate at a state of positions and velocities, with their Jacobians, and memory to evaluate them. Matrices are by
/// rows.
#[derive(Clone)]
pub(crate) struct Derivatives<L: Lagrangian> {
    q: L::Vector<HyperDual>,
    v: L::Vector<HyperDual>,
    force: L::Vector<HyperDual>,
    /// Position, velocity, `∂L/∂v` and `∂L/∂q` in doubles.
    doubles: [L::Vector<f64>; 4],
    /// An evaluation of a wrong dimension, and its dimension.
    resized: Option<(Quantity, usize)>,
    /// L.
    pub(crate) value: f64,
    /// `∂L/∂v`
    pub(crate) momentum: Vec<f64>,
    /// `∂L/∂q + f`
    pub(crate) rate: Vec<f64>,
    /// `∂²L/∂v∂q`
    pub(crate) momentum_by_position: Vec<f64>,
    /// `∂²L/∂v∂v`
    pub(crate) momentum_by_velocity: Vec<f64>,
    /// `∂²L/∂q∂q + ∂f/∂q`
    pub(crate) rate_by_position: Vec<f64>,
    /// `∂²L/∂q∂v + ∂f/∂v`
    pub(crate) rate_by_velocity: Vec<f64>,
}

impl<L: Lagrangian> Derivatives<L> {
    /// Memory for vectors of `n` components.
    pub(crate) fn new(n: usize) -> Result<Self, Error> {
        let zeros = || L::Vector::from_slice(&vec![HyperDual::zero(); n]);
        let double = || L::Vector::from_slice(&vec![0.0; n]);
        let matrix = || vec![0.0; n * n];
        Ok(Self {
            q: zeros()?,
            v: zeros()?,
            force: zeros()?,
            doubles: [double()?, double()?, double()?, double()?],
            resized: None,
            value: 0.0,
            momentum: vec![0.0; n],
            rate: vec![0.0; n],
            momentum_by_position: matrix(),
            momentum_by_velocity: matrix(),
            rate_by_position: matrix(),
            rate_by_velocity: matrix(),
        })
    }

    /// Evaluates the value, the momentum and its rate.
    pub(crate) fn first(&mut self, lagrangian: &L, time: f64, q: &[f64], v: &[f64]) {
        self.resized = None;
        if self.gradient(lagrangian, time, q, v) {
            if L::FORCED {
                self.place(q, v);
                self.add_value_of_force(lagrangian, time);
            }
            return;
        }
        self.place(q, v);
        for k in 0..q.len() {
            self.q.as_mut_slice()[k].set_first(1.0);
            self.v.as_mut_slice()[k].set_second(1.0);
            let dual = lagrangian.lagrangian(HyperDual::from_f64(time), &self.q, &self.v);
            self.q.as_mut_slice()[k].set_first(0.0);
            self.v.as_mut_slice()[k].set_second(0.0);
            self.value = dual.real();
            (self.rate[k], self.momentum[k]) = (dual.first(), dual.second());
        }
        if L::FORCED {
            self.add_value_of_force(lagrangian, time);
        }
    }

    /// Identifies a Lagrangian and its force, at a position and a velocity and beside them.
    pub(crate) fn fingerprint(
        &mut self,
        lagrangian: &L,
        time: f64,
        q: &L::Vector<f64>,
        v: &L::Vector<f64>,
    ) -> Vec<f64> {
        let mut numbers = Vec::new();
        for (q, v) in [(q, v), (&beside(q), &beside(v))] {
            self.first(lagrangian, time, q.as_slice(), v.as_slice());
            numbers.push(self.value);
            numbers.extend(self.momentum.iter().chain(&self.rate));
        }
        numbers
    }

    /// The stage at a position and a velocity, with the weight `h b_i`.
    pub(crate) fn stage(
        &mut self,
        lagrangian: &L,
        (weight, time): (f64, f64),
        q: &[f64],
        v: &[f64],
    ) -> StageOfStep<L::Vector<f64>> {
        self.first(lagrangian, time, q, v);
        let vector = |numbers: &[f64]| {
            let mut vector = self.doubles[0].zeros_like();
            vector.as_mut_slice().copy_from_slice(numbers);
            vector
        };
        let (q, velocity, mut applied) = (vector(q), vector(v), self.doubles[0].zeros_like());
        if L::FORCED {
            lagrangian.force(time, &q, &velocity, &mut applied);
        }
        StageOfStep {
            weight,
            force_weight: weight,
            time,
            momentum_time: time,
            q,
            p: vector(&self.momentum),
            velocity,
            force: vector(&self.rate),
            applied,
            multipliers: Vec::new(),
        }
    }

    /// [`first`](Self::first) without the force, if the Lagrangian supplies its gradient; otherwise returns `false`.
    fn gradient(&mut self, lagrangian: &L, time: f64, q: &[f64], v: &[f64]) -> bool {
        let [at, velocity, by_velocity, by_position] = &mut self.doubles;
        at.as_mut_slice().copy_from_slice(q);
        velocity.as_mut_slice().copy_from_slice(v);
        if !lagrangian.gradient(time, at, velocity, by_velocity, by_position) {
            return false;
        }
        // L may be NaN where its gradient is finite: ln x at x < 0.
        self.value = lagrangian.lagrangian(time, at, velocity);
        for (what, derivative) in [
            (Quantity::Momentum, &*by_velocity),
            (Quantity::Force, &*by_position),
        ] {
            let found = derivative.dimension();
            if found != q.len() {
                self.resized = Some((what, found));
                self.value = f64::NAN;
                return true;
            }
        }
        self.momentum.copy_from_slice(by_velocity.as_slice());
        self.rate.copy_from_slice(by_position.as_slice());
        true
    }

    fn add_value_of_force(&mut self, lagrangian: &L, time: f64) {
        self.evaluate_force(lagrangian, time);
        for (rate, force) in self.rate.iter_mut().zip(self.force.as_slice()) {
            *rate += force.real();
        }
    }

    /// Evaluates everything: n(2n + 1) evaluations of L for n components, and n of a force.
    pub(crate) fn second(&mut self, lagrangian: &L, time: f64, q: &[f64], v: &[f64]) {
        self.resized = None;
        self.place(q, v);
        let n = q.len();
        for row in 0..n {
            self.q.as_mut_slice()[row].set_first(1.0);
            for column in 0..n {
                self.v.as_mut_slice()[column].set_second(1.0);
                let dual = lagrangian.lagrangian(HyperDual::from_f64(time), &self.q, &self.v);
                self.v.as_mut_slice()[column].set_second(0.0);
                self.value = dual.real();
                (self.rate[row], self.momentum[column]) = (dual.first(), dual.second());
                self.rate_by_velocity[row * n + column] = dual.mixed();
                self.momentum_by_position[column * n + row] = dual.mixed();
            }
            for column in row..n {
                self.q.as_mut_slice()[column].set_second(1.0);
                let dual = lagrangian.lagrangian(HyperDual::from_f64(time), &self.q, &self.v);
                self.q.as_mut_slice()[column].set_second(0.0);
                self.rate_by_position[row * n + column] = dual.mixed();
                self.rate_by_position[column * n + row] = dual.mixed();
            }
            self.q.as_mut_slice()[row].set_first(0.0);
            self.v.as_mut_slice()[row].set_first(1.0);
            for column in row..n {
                self.v.as_mut_slice()[column].set_second(1.0);
                let dual = lagrangian.lagrangian(HyperDual::from_f64(time), &self.q, &self.v);
                self.v.as_mut_slice()[column].set_second(0.0);
                self.momentum_by_velocity[row * n + column] = dual.mixed();
                self.momentum_by_velocity[column * n + row] = dual.mixed();
            }
            self.v.as_mut_slice()[row].set_first(0.0);
        }
        if L::FORCED {
            self.add_force_and_slopes(lagrangian, time);
        }
    }

    /// Whether the value, the momentum and its rate are finite.
    pub(crate) fn is_finite(&self) -> bool {
        let mut numbers = self.momentum.iter().chain(&self.rate);
        self.value.is_finite() && numbers.all(|number| number.is_finite())
    }

    /// Why the last evaluation is not [finite](Self::is_finite): `stage` is its number, from 1.
    pub(crate) fn failure(&self, stage: Option<usize>) -> Failure {
        match self.resized {
            Some((what, found)) => Failure::Resized {
                what,
                stage,
                expected: self.rate.len(),
                found,
            },
            None => Failure::NonFinite { stage },
        }
    }

    /// The error if the evaluation at a state is not [finite](Self::is_finite).
    pub(crate) fn check(&self, time: f64) -> Result<(), Error> {
        self.check_dimension(time)?;
        if self.is_finite() {
            return Ok(());
        }
        let what = Quantity::Lagrangian;
        Err(Error::NonFiniteState { what })
    }

    /// The error if the evaluation at a state has a wrong dimension.
    pub(crate) fn check_dimension(&self, time: f64) -> Result<(), Error> {
        self.resized.map_or(Ok(()), |(what, found)| {
            Err(Error::ResizedEvaluation {
                time,
                what,
                expected: self.rate.len(),
                found,
            })
        })
    }

    fn place(&mut self, q: &[f64], v: &[f64]) {
        for (duals, values) in [(&mut self.q, q), (&mut self.v, v)] {
            let pairs = duals.as_mut_slice().iter_mut().zip(values);
            pairs.for_each(|(dual, &value)| *dual = HyperDual::from_f64(value));
        }
    }

    fn evaluate_force(&mut self, lagrangian: &L, time: f64) {
        self.force.as_mut_slice().fill(HyperDual::zero());
        let time = HyperDual::from_f64(time);
        lagrangian.force(time, &self.q, &self.v, &mut self.force);
        let found = self.force.dimension();
        if found != self.q.dimension() {
            self.resized = Some((Quantity::Force, found));
            self.force.clone_from(&self.q);
            (self.force.as_mut_slice()).fill(HyperDual::from_f64(f64::NAN));
        }
    }

    fn add_force_and_slopes(&mut self, lagrangian: &L, time: f64) {
        let n = self.rate.len();
        for column in 0..n {
            self.q.as_mut_slice()[column].set_first(1.0);
            self.v.as_mut_slice()[column].set_second(1.0);
            self.evaluate_force(lagrangian, time);
            self.q.as_mut_slice()[column].set_first(0.0);
            self.v.as_mut_slice()[column].set_second(0.0);
            for (row, force) in self.force.as_slice().iter().enumerate() {
                self.rate_by_position[row * n + column] += force.first();
                self.rate_by_velocity[row * n + column] += force.second();
                if column == 0 {
                    self.rate[row] += force.real();
                }
            }
        }
    }
}
