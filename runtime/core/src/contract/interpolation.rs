//! Values inside a step.
//!
//! Every polynomial here is a straight line between the ends of the step plus a part that vanishes at both ends. So it has the results of
//! the steps at its ends, to the last bit:
//!
//! ```text
//! q(t0 + θh) = (1 − θ) q0 + θ q1 + θ (1 − θ) (…)
//! ```

use crate::contract::{HalfTableau, StagePolynomial, StoredEvaluations};
use crate::number::vector::same;
use crate::number::{Scalar, Vector};

/// How values inside a step are computed.
///
/// With the order m, values inside steps of size h have errors of `O(hᵐ)`, in addition to the errors at the ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// The polynomials through the velocities and the forces of the stages, integrated.
    ///
    /// If the basis has as many polynomials as there are nodes, this is the Galerkin polynomial itself. With collocation coefficients `a`
    /// it passes through the stages (Hairer, Nørsett & Wanner, *Solving ODEs I*, Theorem II.7.10).
    ///
    /// Its orders follow from the order of interpolation and from the stage orders, `C(η)` and `Ĉ(η̂)`. In a separable system it has the
    /// order `min(s, η̂ + 1) + 1` for positions and `min(s, η + 1) + 1` for momenta. In a general system both have the smaller one. So
    /// Gauss and Radau with s > 1 stages have the order `s + 1`.
    Stages {
        /// The order of positions.
        positions: u32,
        /// The order of momenta.
        momenta: u32,
    },
    /// The cubic polynomials with the values and derivatives of both ends, for which the system is evaluated there: order 4.
    Hermite,
}

impl Interpolation {
    /// The order for positions and momenta together.
    ///
    /// ```
    /// use symplectic::output::Interpolation;
    ///
    /// assert_eq!(Interpolation::Stages { positions: 3, momenta: 4 }.order(), 3);
    /// assert_eq!(Interpolation::Hermite.order(), 4);
    /// ```
    pub const fn order(self) -> u32 {
        match self {
            Self::Stages { positions, momenta } => {
                if positions < momenta {
                    positions
                } else {
                    momenta
                }
            }
            Self::Hermite => 4,
        }
    }

    /// [`Stages`](Self::Stages) if both positions and momenta have a polynomial, otherwise [`Hermite`](Self::Hermite).
    pub(crate) const fn of_stages(
        positions: Option<StagePolynomial>,
        momenta: Option<StagePolynomial>,
    ) -> Self {
        match (positions, momenta) {
            (Some(positions), Some(momenta)) => Self::Stages {
                positions: positions.order,
                momenta: momenta.order,
            },
            _ => Self::Hermite,
        }
    }
}

/// A time inside a step.
#[derive(Debug)]
pub struct Inside<'a, V> {
    /// The fraction θ of the step.
    pub fraction: f64,
    /// The size h of the step.
    pub size: f64,
    /// The momentum at the start of the step.
    pub momentum: &'a V,
}

impl<V> Clone for Inside<'_, V> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<V> Copy for Inside<'_, V> {}

impl<'a, V: Vector> Inside<'a, V> {
    /// The same time for vectors of another type, if that is the same type.
    pub(crate) fn same<W: Vector>(self) -> Option<Inside<'a, W>> {
        Some(Inside {
            fraction: self.fraction,
            size: self.size,
            momentum: same(self.momentum)?,
        })
    }
}

impl<V: Vector> Inside<'_, V> {
    /// The factor of the evaluation of a stage, from 0, in the part that vanishes at both ends
    ///
    /// ```text
    /// −θ(1 − θ) Σ_k γ_k G_k(θ)      G_k = L_k'/(k(k + 1)),   ∫_0^θ L_k = −θ(1 − θ) G_k(θ)
    /// ```
    ///
    /// with the Legendre coefficients γ_k of its Lagrange polynomial. The Jacobi polynomials `G_k` are at most 1 on
    /// [0, 1], so no digits are lost in the sum: `(k + 1) G_k = (2k − 1)(2θ − 1) G_{k−1} − (k − 2) G_{k−2}`, `G_1 = 1`.
    pub(crate) fn factor(self, polynomial: StagePolynomial, stage: usize) -> f64 {
        let theta = self.fraction;
        let x = 2.0 * theta - 1.0;
        let (mut before, mut jacobi, mut sum) = (0.0, 1.0, 0.0);
        for (row, k) in polynomial.legendre.iter().zip(1_u32..) {
            if k > 1 {
                let k = f64::from(k);
                let next = ((2.0 * k - 1.0) * x * jacobi - (k - 2.0) * before) / (k + 1.0);
                (before, jacobi) = (jacobi, next);
            }
            sum += row[stage] * jacobi;
        }
        -theta * (1.0 - theta) * sum
    }

    /// Adds to `out` the part that vanishes at both ends, from evaluations that are stored one by one.
    #[doc(hidden)]
    pub fn add(
        self,
        half: &HalfTableau,
        increments: bool,
        evaluations: StoredEvaluations<'_, V>,
        out: &mut V,
    ) {
        let Some(polynomial) = half.polynomial else {
            return;
        };
        for (stage, value) in evaluations.values.iter().enumerate() {
            let mut factor = self.factor(polynomial, stage);
            if !increments {
                factor *= self.size;
            } else if evaluations.carried.contains(&stage) {
                factor *= self.size * half.weights[stage];
            }
            let factor = V::Scalar::from_f64(factor);
            for (out, &value) in out.as_mut_slice().iter_mut().zip(value.as_slice()) {
                *out += factor * value;
            }
        }
    }

    /// Adds to `out` the part that vanishes at both ends, `θ(1 − θ)((1 − θ)(h f0 − Δ) − θ(h f1 − Δ))`. The derivatives at the ends are `f0`
    /// and `f1`; Δ is the difference of the ends.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn add_cubic(self, [start, end]: [&V; 2], line: &Line<'_, V>, out: &mut V) {
        let Self { fraction, size, .. } = self;
        let bubble = fraction * (1.0 - fraction);
        let [size, at_start, at_end] =
            [size, bubble * (1.0 - fraction), bubble * fraction].map(V::Scalar::from_f64);
        let derivatives = start.as_slice().iter().zip(end.as_slice());
        for (k, (out, (&start, &end))) in out.as_mut_slice().iter_mut().zip(derivatives).enumerate()
        {
            let difference = line.difference(k);
            *out += at_start * (size * start - difference) - at_end * (size * end - difference);
        }
    }
}

/// The ends of a step in positions or momenta, each with its compensation.
pub(crate) struct Line<'a, V> {
    pub(crate) start: (&'a V, &'a V),
    pub(crate) end: (&'a V, &'a V),
}

impl<V: Vector> Line<'_, V> {
    /// The difference of the ends in one component.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn difference(&self, k: usize) -> V::Scalar {
        let ((start, start_low), (end, end_low)) = (self.start, self.end);
        (end.as_slice()[k] - start.as_slice()[k])
            + (end_low.as_slice()[k] - start_low.as_slice()[k])
    }

    /// Adds the straight line to `out`, computed from the nearer end.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn add(&self, fraction: f64, out: &mut V) {
        let ((near, low), way) = if fraction <= 0.5 {
            (self.start, fraction)
        } else {
            (self.end, fraction - 1.0)
        };
        let way = V::Scalar::from_f64(way);
        let (near, low) = (near.as_slice(), low.as_slice());
        for (k, out) in out.as_mut_slice().iter_mut().enumerate() {
            *out = near[k] + (low[k] + (way * self.difference(k) + *out));
        }
    }
}
