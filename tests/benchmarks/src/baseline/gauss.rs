//! Gauss and Lobatto methods with a lane per stage: fixed-point iteration from the stage polynomial of the previous
//! step, plain sums.

use std::array;

use super::lanes::Lanes;
use super::systems::{General, Separable};

/// The coefficients of a symplectic method with `S` stages, as `tableau!` emits them.
#[derive(Clone, Copy, Debug)]
pub struct Rule<const S: usize> {
    /// The matrix a, for the positions.
    pub a: [[f64; S]; S],
    /// The matrix ã, for the momenta; equal to a for Gauss.
    pub a_tilde: [[f64; S]; S],
    /// The weights b.
    pub b: [f64; S],
    /// The nodes c.
    pub c: [f64; S],
}

impl<const S: usize> Rule<S> {
    /// `a ã`, the matrix of the second-order form.
    pub(super) fn square(&self) -> [[f64; S]; S] {
        product(&self.a, &self.a_tilde)
    }

    /// `ℓ_j(1 + c_i)`: evaluates the polynomial through values at the nodes of a step at the nodes of the next step.
    pub(super) fn extrapolation(&self) -> [[f64; S]; S] {
        array::from_fn(|i| {
            array::from_fn(|j| {
                let others = (0..S).filter(|&k| k != j);
                others
                    .map(|k| (1.0 + self.c[i] - self.c[k]) / (self.c[j] - self.c[k]))
                    .product()
            })
        })
    }
}

/// A matrix by columns, with a lane per row; lanes beyond the last row are zero.
pub(super) fn columns<L: Lanes, const S: usize>(
    matrix: &[[f64; S]; S],
    factor: impl Fn(usize) -> f64,
) -> [L; S] {
    array::from_fn(|j| L::from_fn(|i| if i < S { matrix[i][j] * factor(j) } else { 0.0 }))
}

/// `values` in lanes, zero beyond the last.
pub(super) fn row<L: Lanes, const S: usize>(values: &[f64; S], factor: f64) -> L {
    L::from_fn(|i| if i < S { values[i] * factor } else { 0.0 })
}

pub(super) fn product<const S: usize>(a: &[[f64; S]; S], b: &[[f64; S]; S]) -> [[f64; S]; S] {
    array::from_fn(|i| array::from_fn(|j| (0..S).map(|k| a[i][k] * b[k][j]).sum()))
}

/// `Σ_j columns_j x_j` for the lanes `x_j`, as two independent sums.
#[inline(always)]
pub(super) fn transform<L: Lanes, const S: usize>(columns: &[L; S], x: L) -> L {
    let mut even = columns[0] * L::splat(x.lane(0));
    if S == 1 {
        return even;
    }
    let mut odd = columns[1] * L::splat(x.lane(1));
    for j in (2..S).step_by(2) {
        even = columns[j].fused(L::splat(x.lane(j)), even);
        if j + 1 < S {
            odd = columns[j + 1].fused(L::splat(x.lane(j + 1)), odd);
        }
    }
    even + odd
}

/// The second-order form, for separable systems with quadratic kinetic energy:
/// `Q_i = q0 + h c_i M⁻¹p0 + h² Σ_j (a ã)_ij M⁻¹force_j`.
#[derive(Clone, Copy, Debug)]
pub struct SecondOrder<L, const S: usize> {
    pub(super) step_size: f64,
    pub(super) nodes: L,
    pub(super) stages: [L; S],
    pub(super) extrapolated: [L; S],
    weights: L,
    position_weights: L,
}

impl<L: Lanes, const S: usize> SecondOrder<L, S> {
    /// The method with steps of `step_size`.
    pub fn new(rule: &Rule<S>, step_size: f64) -> Self {
        let h = step_size;
        let square = rule.square();
        let extrapolated = product(&square, &rule.extrapolation());
        let position: [f64; S] = array::from_fn(|j| rule.b[j] * (1.0 - rule.c[j]));
        Self {
            step_size,
            nodes: row(&rule.c, h),
            stages: columns(&square, |_| h * h),
            extrapolated: columns(&extrapolated, |_| h * h),
            weights: row(&rule.b, h),
            position_weights: row(&position, h * h),
        }
    }

    /// Takes `steps` steps from `(q, p)`; iterates until no stage position moves by more than `tolerance`, and
    /// returns the number of sweeps.
    #[inline(always)]
    pub fn run<T: Separable<N>, const N: usize>(
        &self,
        system: &T,
        (q, p): (&mut [f64; N], &mut [f64; N]),
        tolerance: f64,
        steps: u64,
    ) -> u64 {
        let tolerance = L::splat(tolerance);
        let mut force = system.force(&q.map(L::splat));
        let mut first = true;
        let mut sweeps = 0;
        for _ in 0..steps {
            let velocity = system.velocity(p);
            let base: [L; N] =
                array::from_fn(|k| L::splat(velocity[k]).fused(self.nodes, L::splat(q[k])));
            let mut acceleration = system.velocity(&force);
            let matrix = if first {
                &self.stages
            } else {
                &self.extrapolated
            };
            first = false;
            let mut stages: [L; N] =
                array::from_fn(|k| base[k] + transform(matrix, acceleration[k]));
            loop {
                force = system.force(&stages);
                acceleration = system.velocity(&force);
                sweeps += 1;
                let next: [L; N] =
                    array::from_fn(|k| base[k] + transform(&self.stages, acceleration[k]));
                let mut change = L::splat(0.0);
                for k in 0..N {
                    change = change.max((next[k] - stages[k]).abs());
                }
                if !change.exceeds(tolerance) {
                    break;
                }
                stages = next;
            }
            for k in 0..N {
                q[k] +=
                    self.step_size * velocity[k] + (self.position_weights * acceleration[k]).sum();
                p[k] += (self.weights * force[k]).sum();
            }
        }
        sweeps
    }
}

/// The first-order form, for any Hamiltonian.
#[derive(Clone, Copy, Debug)]
pub struct FirstOrder<L, const S: usize> {
    /// The matrices of the positions and of the momenta.
    pub(super) stages: [[L; S]; 2],
    pub(super) extrapolated: [[L; S]; 2],
    weights: L,
}

impl<L: Lanes, const S: usize> FirstOrder<L, S> {
    /// The method with steps of `step_size`.
    pub fn new(rule: &Rule<S>, step_size: f64) -> Self {
        let halves = [&rule.a, &rule.a_tilde];
        Self {
            stages: halves.map(|a| columns(a, |_| step_size)),
            extrapolated: halves
                .map(|a| columns(&product(a, &rule.extrapolation()), |_| step_size)),
            weights: row(&rule.b, step_size),
        }
    }

    /// `base + Σ_j matrix_ij slopes_j` in lane i.
    #[inline(always)]
    pub(super) fn stages<const N: usize>(
        matrix: &[L; S],
        base: &[f64; N],
        slopes: &[L; N],
    ) -> [L; N] {
        array::from_fn(|k| L::splat(base[k]) + transform(matrix, slopes[k]))
    }

    /// Like [`SecondOrder::run`], with the same tolerance for positions and momenta of the stages.
    #[inline(always)]
    pub fn run<T: General<N>, const N: usize>(
        &self,
        system: &T,
        (q, p): (&mut [f64; N], &mut [f64; N]),
        tolerance: f64,
        steps: u64,
    ) -> u64 {
        let tolerance = L::splat(tolerance);
        let (mut velocity, mut force) = system.slopes(&q.map(L::splat), &p.map(L::splat));
        let mut matrix = &self.stages;
        let mut sweeps = 0;
        for _ in 0..steps {
            let mut at = (
                Self::stages(&matrix[0], q, &velocity),
                Self::stages(&matrix[1], p, &force),
            );
            matrix = &self.extrapolated;
            loop {
                (velocity, force) = system.slopes(&at.0, &at.1);
                sweeps += 1;
                let next = (
                    Self::stages(&self.stages[0], q, &velocity),
                    Self::stages(&self.stages[1], p, &force),
                );
                let mut change = L::splat(0.0);
                for k in 0..N {
                    change = change.max((next.0[k] - at.0[k]).abs());
                    change = change.max((next.1[k] - at.1[k]).abs());
                }
                if !change.exceeds(tolerance) {
                    break;
                }
                at = next;
            }
            for k in 0..N {
                q[k] += (self.weights * velocity[k]).sum();
                p[k] += (self.weights * force[k]).sum();
            }
        }
        sweeps
    }
}
