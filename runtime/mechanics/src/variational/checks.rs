//! Properties of a discrete Lagrangian, for tests.

use crate::Error;
use num_traits::Float;

use super::discrete_lagrangian::{At, Derivatives, DiscreteLagrangian};
use super::regular::Factors;
use symplectic_core::inside::check_step_size;
use symplectic_core::{Error as CoreError, Scalar, Vector};

/// Two positions, and the step from the first one to the second.
///
/// ```
/// use symplectic::nalgebra::SVector;
/// use symplectic::variational::{DiscreteLagrangian, DiscretePath};
/// use symplectic::Scalar;
///
/// /// A free particle of mass 2.
/// struct Free;
///
/// impl DiscreteLagrangian for Free {
///     type Vector<T: Scalar> = SVector<T, 1>;
///
///     fn value<T: Scalar>(&self, _time: T, h: T, q0: &SVector<T, 1>, q1: &SVector<T, 1>) -> T {
///         (q1[0] - q0[0]).powi(2) / h
///     }
/// }
///
/// # fn main() -> Result<(), symplectic::variational::Error> {
/// let (q0, q1) = (SVector::from([1.0]), SVector::from([1.5]));
/// let path = DiscretePath { time: 0.0, step_size: 0.5, q0: &q0, q1: &q1 };
/// let (p0, p1) = path.momenta(&Free)?;
/// assert_eq!((p0[0], p1[0]), (2.0, 2.0)); // twice the velocity
/// assert!(path.is_regular(&Free)?);
/// assert_eq!(path.self_adjoint_defect(&Free), 0.0);
/// // Translations.
/// assert_eq!(path.momentum_maps(&Free, |_| SVector::from([1.0]))?, [2.0, 2.0]);
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct DiscretePath<'a, V> {
    /// Time at the start of the step.
    pub time: f64,
    /// Step size.
    pub step_size: f64,
    /// Position at the start.
    pub q0: &'a V,
    /// Position at the end, of the same dimension.
    pub q1: &'a V,
}

impl<V: Vector<Scalar = f64>> DiscretePath<'_, V> {
    /// The discrete Legendre transforms `p0 = −D1 Ld(q0, q1)` and `p1 = D2 Ld(q0, q1)`, with forces `−D1 Ld − f_d⁻` and `D2 Ld + f_d⁺`
    /// (Marsden & West, 1.5.1 and 3.2.5).
    ///
    /// # Errors
    ///
    /// [`Core(StepSize)`](CoreError::StepSize); [`Core(Dimension)`](CoreError::Dimension) if the positions differ in dimension;
    /// [`Core(ResizedEvaluation)`](CoreError::ResizedEvaluation) if a force does.
    pub fn momenta<L>(&self, lagrangian: &L) -> Result<(V, V), Error>
    where
        L: DiscreteLagrangian<Vector<f64> = V>,
    {
        let mut derivatives = self.derivatives_like::<L>()?;
        derivatives.first(lagrangian, self.at());
        derivatives.check(self.time)?;
        let (mut p0, mut p1) = (self.q0.zeros_like(), self.q0.zeros_like());
        let pairs = p0.as_mut_slice().iter_mut().zip(&derivatives.start);
        pairs.for_each(|(p, start)| *p = -start);
        p1.as_mut_slice().copy_from_slice(&derivatives.end);
        Ok((p0, p1))
    }

    /// Whether `D1D2 Ld(q0, q1)` is invertible, up to rounding (Marsden & West, §1.5). Then `(q0, p0)` determines `q1`.
    ///
    /// # Errors
    ///
    /// [`Core(StepSize)`](CoreError::StepSize); [`Core(Dimension)`](CoreError::Dimension) if the positions differ in dimension;
    /// [`Core(ResizedEvaluation)`](CoreError::ResizedEvaluation) if a force does.
    pub fn is_regular<L>(&self, lagrangian: &L) -> Result<bool, Error>
    where
        L: DiscreteLagrangian<Vector<f64> = V>,
    {
        let mut derivatives = self.derivatives_like::<L>()?;
        derivatives.second(lagrangian, self.at());
        derivatives.check(self.time)?;
        let mut factors = Factors::new(self.q0.dimension());
        Ok(factors.factor(&derivatives.mixed).is_ok())
    }

    /// `|Ld(q0, q1, h) + Ld(q1, q0, −h)|`: zero up to rounding on every path if and only if `Ld` is self-adjoint. Then its steps are
    /// symmetric and their order is even (Marsden & West, §2.4).
    pub fn self_adjoint_defect<L>(&self, lagrangian: &L) -> f64
    where
        L: DiscreteLagrangian<Vector<f64> = V>,
    {
        let (time, size) = (self.time, self.step_size);
        let there = lagrangian.value(time, size, self.q0, self.q1);
        let back = lagrangian.value(time + size, -size, self.q1, self.q0);
        Float::abs(there + back)
    }

    /// The discrete momentum maps `J⁻ = −D1 Ld·ξ(q0)` and `J⁺ = D2 Ld·ξ(q1)`, with the velocities `ξ(q)` of a symmetry. `J⁺ − J⁻` is the
    /// change of `Ld` along the symmetry: zero if `Ld` is invariant (Marsden & West, §1.3.3).
    ///
    /// # Errors
    ///
    /// [`Core(StepSize)`](CoreError::StepSize); [`Core(Dimension)`](CoreError::Dimension) if the positions differ in dimension;
    /// [`Core(ResizedEvaluation)`](CoreError::ResizedEvaluation) if a force does.
    pub fn momentum_maps<L>(
        &self,
        lagrangian: &L,
        generator: impl Fn(&V) -> V,
    ) -> Result<[f64; 2], Error>
    where
        L: DiscreteLagrangian<Vector<f64> = V>,
    {
        let (p0, p1) = self.momenta(lagrangian)?;
        Ok([(p0, self.q0), (p1, self.q1)].map(|(p, q)| dot(&p, &generator(q))))
    }

    /// How far the difference `Δ` of two discrete Lagrangians is from a function of the step size: `(strong, weak)`, on a path that
    /// continues to `q2` (Marsden & West, §2.1.2):
    ///
    /// ```text
    /// strong = max(|D1 Δ(q0, q1)|, |D2 Δ(q0, q1)|)
    /// weak = max(|D1D2 Δ(q0, q1)|, |D2 Δ(q0, q1) + D1 Δ(q1, q2)|)
    /// ```
    ///
    /// Strongly equivalent discrete Lagrangians, `strong = 0` everywhere, have the same momenta. Weakly equivalent ones, `weak = 0`
    /// everywhere, differ by `f(q1) − f(q0)` and have the same positions.
    ///
    /// # Errors
    ///
    /// [`Core(StepSize)`](CoreError::StepSize); [`Core(Dimension)`](CoreError::Dimension) if the positions differ in dimension;
    /// [`Core(ResizedEvaluation)`](CoreError::ResizedEvaluation) if a force does.
    pub fn difference<L, K>(&self, one: &L, other: &K, q2: &V) -> Result<(f64, f64), Error>
    where
        L: DiscreteLagrangian<Vector<f64> = V>,
        K: DiscreteLagrangian<Vector<f64> = V>,
    {
        let following = DiscretePath {
            time: self.time + self.step_size,
            step_size: self.step_size,
            q0: self.q1,
            q1: q2,
        };
        let (mut ours, mut theirs) = (self.derivatives_like::<L>()?, self.derivatives_like::<K>()?);
        ours.second(one, self.at());
        theirs.second(other, self.at());
        ours.check(self.time)?;
        theirs.check(self.time)?;
        let (mut next_ours, mut next_theirs) = (
            following.derivatives_like::<L>()?,
            following.derivatives_like::<K>()?,
        );
        next_ours.first(one, following.at());
        next_theirs.first(other, following.at());
        next_ours.check(following.time)?;
        next_theirs.check(following.time)?;
        let differences = |a: &[f64], b: &[f64]| {
            let pairs = a.iter().zip(b);
            pairs.fold(0.0_f64, |largest, (a, b)| largest.max(Float::abs(a - b)))
        };
        let start = differences(&ours.start, &theirs.start);
        let strong = start.max(differences(&ours.end, &theirs.end));
        let mixed = differences(&ours.mixed, &theirs.mixed);
        let ends = ours.end.iter().zip(&theirs.end);
        let starts = next_ours.start.iter().zip(&next_theirs.start);
        let weak = ends.zip(starts).fold(mixed, |largest, ((a, b), (c, d))| {
            largest.max(Float::abs((a - b) + (c - d)))
        });
        Ok((strong, weak))
    }

    fn at(&self) -> At<'_, V> {
        At {
            time: self.time,
            size: self.step_size,
            q0: self.q0,
            q1: self.q1,
        }
    }

    fn derivatives_like<L>(&self) -> Result<Derivatives<L>, CoreError>
    where
        L: DiscreteLagrangian<Vector<f64> = V>,
    {
        let (position, momentum) = (self.q0.dimension(), self.q1.dimension());
        if position != momentum {
            return Err(CoreError::Dimension { position, momentum });
        }
        check_step_size(self.step_size)?;
        Derivatives::new(self.q0)
    }
}

fn dot<V: Vector<Scalar = f64>>(a: &V, b: &V) -> f64 {
    let pairs = a.as_slice().iter().zip(b.as_slice());
    pairs.fold(0.0, |sum, (&a, &b)| a.fused(b, sum))
}
