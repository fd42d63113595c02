//! Discrete Lagrangians supplied by the user, and their derivatives.

use alloc::vec;
use alloc::vec::Vec;

use num_traits::Zero;

use super::failure::Failure;
use symplectic_core::inside::beside;
use symplectic_core::{Error, Quantity, Scalar, State, Vector};
use symplectic_linearisation::HyperDual;

/// A discrete Lagrangian `Ld(q0, q1)`: an approximation of the action from `q0` at the time t to `q1` at t + h. It is written once for all
/// scalars, and its derivatives are exact (Marsden & West 2001, §1.3).
///
/// ```
/// use symplectic::Scalar;
/// use symplectic::nalgebra::SVector;
/// use symplectic::variational::DiscreteLagrangian;
///
/// /// The pendulum, L = v²/2 + cos q, at the middle of the step: Ld = h L((q0 + q1)/2, (q1 − q0)/h).
/// struct Pendulum;
///
/// impl DiscreteLagrangian for Pendulum {
///     type Vector<T: Scalar> = SVector<T, 1>;
///
///     fn value<T: Scalar>(&self, _time: T, h: T, q0: &SVector<T, 1>, q1: &SVector<T, 1>) -> T {
///         let half = T::from_f64(0.5);
///         let (q, v) = ((q0[0] + q1[0]) * half, (q1[0] - q0[0]) / h);
///         h * (v * v * half + q.cos())
///     }
/// }
/// ```
pub trait DiscreteLagrangian {
    /// The type of the vectors of positions and momenta.
    type Vector<T: Scalar>: Vector<Scalar = T>;

    /// Whether there are [`forces`](Self::forces).
    const FORCED: bool = false;

    /// `Ld(q0, q1)` of the step of size `step_size` that begins at `time`; an action. The step size may be negative.
    fn value<T: Scalar>(
        &self,
        time: T,
        step_size: T,
        q0: &Self::Vector<T>,
        q1: &Self::Vector<T>,
    ) -> T;

    /// The discrete forces `f_d⁻(q0, q1)` at the start and `f_d⁺(q0, q1)` at the end of the step, which are impulses (Marsden & West
    /// 3.2.1). Both vectors are zero on entry. They are used only with `FORCED = true`.
    fn forces<T: Scalar>(
        &self,
        _time: T,
        _step_size: T,
        _q0: &Self::Vector<T>,
        _q1: &Self::Vector<T>,
        _minus: &mut Self::Vector<T>,
        _plus: &mut Self::Vector<T>,
    ) {
    }
}

impl<L: DiscreteLagrangian> DiscreteLagrangian for &L {
    type Vector<T: Scalar> = L::Vector<T>;

    const FORCED: bool = L::FORCED;

    fn value<T: Scalar>(&self, time: T, step_size: T, q0: &L::Vector<T>, q1: &L::Vector<T>) -> T {
        (**self).value(time, step_size, q0, q1)
    }

    fn forces<T: Scalar>(
        &self,
        time: T,
        step_size: T,
        q0: &L::Vector<T>,
        q1: &L::Vector<T>,
        minus: &mut L::Vector<T>,
        plus: &mut L::Vector<T>,
    ) {
        (**self).forces(time, step_size, q0, q1, minus, plus);
    }
}

/// The derivatives of a discrete Lagrangian and of its forces at two positions, and the memory to evaluate them.
#[derive(Clone)]
pub(super) struct Derivatives<L: DiscreteLagrangian> {
    q0: L::Vector<HyperDual>,
    q1: L::Vector<HyperDual>,
    minus: L::Vector<HyperDual>,
    plus: L::Vector<HyperDual>,
    /// The dimension of a discrete force, if it is wrong.
    resized: Option<usize>,
    /// Ld.
    pub(super) value: f64,
    /// `D1 Ld + f_d⁻`
    pub(super) start: Vec<f64>,
    /// `D2 Ld + f_d⁺`
    pub(super) end: Vec<f64>,
    /// The derivative of `D1 Ld + f_d⁻` with respect to q1, by rows.
    pub(super) mixed: Vec<f64>,
}

impl<L: DiscreteLagrangian> Derivatives<L> {
    /// Memory for vectors like `prototype`.
    pub(super) fn new(prototype: &L::Vector<f64>) -> Result<Self, Error> {
        let n = prototype.dimension();
        let zeros = || L::Vector::from_slice(&vec![HyperDual::zero(); n]);
        Ok(Self {
            q0: zeros()?,
            q1: zeros()?,
            minus: zeros()?,
            plus: zeros()?,
            resized: None,
            value: 0.0,
            start: vec![0.0; n],
            end: vec![0.0; n],
            mixed: vec![0.0; n * n],
        })
    }

    /// Evaluates the value and the first derivatives, in one evaluation for each component.
    pub(super) fn first(&mut self, lagrangian: &L, at: At<'_, L::Vector<f64>>) {
        self.place(at);
        for k in 0..self.start.len() {
            let dual = self.along(lagrangian, at, k, k);
            self.value = dual.real();
            (self.start[k], self.end[k]) = (dual.first(), dual.second());
        }
        self.add_forces(lagrangian, at);
    }

    /// Evaluates the value, `start`, and `mixed`, in one evaluation for each of its entries.
    pub(super) fn second(&mut self, lagrangian: &L, at: At<'_, L::Vector<f64>>) {
        self.place(at);
        let n = self.start.len();
        for (row, column) in (0..n).flat_map(|row| (0..n).map(move |column| (row, column))) {
            let dual = self.along(lagrangian, at, row, column);
            self.value = dual.real();
            (self.start[row], self.end[column]) = (dual.first(), dual.second());
            self.mixed[row * n + column] = dual.mixed();
        }
        if !L::FORCED {
            return;
        }
        for column in 0..n {
            self.q1.as_mut_slice()[column].set_second(1.0);
            self.evaluate_forces(lagrangian, at);
            self.q1.as_mut_slice()[column].set_second(0.0);
            for (row, force) in self.minus.as_slice().iter().enumerate() {
                self.mixed[row * n + column] += force.second();
            }
        }
        self.add_forces(lagrangian, at);
    }

    /// [`second`](Self::second), and the matrix of the second derivatives `D1D2`, `D1D_h`, `D2D_h` and `D_hD_h` by rows: the derivatives of
    /// `D1 Ld`, then of `∂Ld/∂h`, with respect to q1 and h. Returns `∂Ld/∂h`.
    pub(super) fn by_size(
        &mut self,
        lagrangian: &L,
        at: At<'_, L::Vector<f64>>,
        rows: &mut [f64],
    ) -> f64 {
        self.second(lagrangian, at);
        let n = self.start.len();
        for (row, mixed) in rows.chunks_mut(n + 1).zip(self.mixed.chunks(n)) {
            row[..n].copy_from_slice(mixed);
        }
        let time = HyperDual::from_f64(at.time);
        let size = |first: f64| HyperDual::new(at.size, first, 1.0);
        for k in 0..n {
            self.q0.as_mut_slice()[k].set_first(1.0);
            let dual = lagrangian.value(time, size(0.0), &self.q0, &self.q1);
            rows[k * (n + 1) + n] = dual.mixed();
            self.q0.as_mut_slice()[k].set_first(0.0);
            self.q1.as_mut_slice()[k].set_first(1.0);
            let dual = lagrangian.value(time, size(0.0), &self.q0, &self.q1);
            rows[n * (n + 1) + k] = dual.mixed();
            self.q1.as_mut_slice()[k].set_first(0.0);
        }
        let dual = lagrangian.value(time, size(1.0), &self.q0, &self.q1);
        rows[n * (n + 1) + n] = dual.mixed();
        dual.first()
    }

    /// Identifies a discrete Lagrangian and its forces, by two paths near a state.
    pub(super) fn fingerprint(
        &mut self,
        lagrangian: &L,
        State { time, q, .. }: &State<L::Vector<f64>>,
    ) -> Vec<f64> {
        let (near, mut numbers) = (beside(q), Vec::new());
        for (q0, q1) in [(q, &near), (&near, &beside(&near))] {
            let (time, size) = (*time, 1.0);
            self.first(lagrangian, At { time, size, q0, q1 });
            numbers.push(self.value);
            numbers.extend(self.start.iter().chain(&self.end));
        }
        numbers
    }

    /// Whether everything that [`first`](Self::first) or [`second`](Self::second) has written is finite.
    pub(super) fn is_finite(&self) -> bool {
        let lists = [&self.start, &self.end, &self.mixed];
        let mut numbers = lists.into_iter().flatten();
        self.value.is_finite() && numbers.all(|number| number.is_finite())
    }

    /// Why the last evaluation is not finite.
    pub(super) fn failure(&self) -> Failure {
        let stage = None;
        match self.resized {
            Some(found) => Failure::Resized {
                what: Quantity::Force,
                stage,
                expected: self.start.len(),
                found,
            },
            None => Failure::NonFinite { stage },
        }
    }

    /// [`Error::ResizedEvaluation`] if the last evaluation of the forces has a wrong dimension.
    pub(super) fn check(&self, time: f64) -> Result<(), Error> {
        self.resized.map_or(Ok(()), |found| {
            Err(Error::ResizedEvaluation {
                time,
                what: Quantity::Force,
                expected: self.start.len(),
                found,
            })
        })
    }

    fn place(&mut self, at: At<'_, L::Vector<f64>>) {
        self.resized = None;
        for (dual, from) in [(&mut self.q0, at.q0), (&mut self.q1, at.q1)] {
            let pairs = dual.as_mut_slice().iter_mut().zip(from.as_slice());
            pairs.for_each(|(dual, &value)| *dual = HyperDual::from_f64(value));
        }
    }

    /// Ld with its derivatives with respect to one component of q0 and one of q1.
    fn along(
        &mut self,
        lagrangian: &L,
        at: At<'_, L::Vector<f64>>,
        row: usize,
        column: usize,
    ) -> HyperDual {
        self.q0.as_mut_slice()[row].set_first(1.0);
        self.q1.as_mut_slice()[column].set_second(1.0);
        let [time, size] = [at.time, at.size].map(HyperDual::from_f64);
        let dual = lagrangian.value(time, size, &self.q0, &self.q1);
        self.q0.as_mut_slice()[row].set_first(0.0);
        self.q1.as_mut_slice()[column].set_second(0.0);
        dual
    }

    fn evaluate_forces(&mut self, lagrangian: &L, at: At<'_, L::Vector<f64>>) {
        for force in [&mut self.minus, &mut self.plus] {
            force.as_mut_slice().fill(HyperDual::zero());
        }
        let [time, size] = [at.time, at.size].map(HyperDual::from_f64);
        let (q0, q1) = (&self.q0, &self.q1);
        lagrangian.forces(time, size, q0, q1, &mut self.minus, &mut self.plus);
        for force in [&mut self.minus, &mut self.plus] {
            let found = force.dimension();
            if found != q0.dimension() {
                self.resized = Some(found);
                force.clone_from(q0);
                (force.as_mut_slice()).fill(HyperDual::from_f64(f64::NAN));
            }
        }
    }

    fn add_forces(&mut self, lagrangian: &L, at: At<'_, L::Vector<f64>>) {
        if !L::FORCED {
            return;
        }
        self.evaluate_forces(lagrangian, at);
        for (sum, force) in [(&mut self.start, &self.minus), (&mut self.end, &self.plus)] {
            let pairs = sum.iter_mut().zip(force.as_slice());
            pairs.for_each(|(sum, force)| *sum += force.real());
        }
    }
}

/// The arguments at which a discrete Lagrangian is evaluated.
pub(super) struct At<'a, V> {
    pub(super) time: f64,
    pub(super) size: f64,
    pub(super) q0: &'a V,
    pub(super) q1: &'a V,
}

impl<V> Clone for At<'_, V> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<V> Copy for At<'_, V> {}
