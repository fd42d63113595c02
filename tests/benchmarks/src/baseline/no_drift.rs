//! Gauss and Lobatto methods with a lane per stage in the form without energy drift: coefficients `μ_ij = a_ij/b_j`
//! with `μ_ij + μ̃_ji = 1` exactly, iteration until the changes of the stages no longer decrease, state and increments
//! as sums of two doubles (Hairer, McLachlan & Razakarivony, 2008; Antoñana, Makazaga & Murua, 2017).

use std::array;

use super::gauss::{FirstOrder, Rule, SecondOrder, columns, row, transform};
use super::lanes::{Lanes, fast_two_sum, two_sum};
use super::systems::{General, Separable};

/// Positions or momenta, each a sum of two doubles.
#[derive(Clone, Copy, Debug)]
pub struct Double<const N: usize> {
    /// The sum, rounded.
    pub high: [f64; N],
    /// The rounding error of `high`.
    pub low: [f64; N],
}

impl<const N: usize> Double<N> {
    /// Exact doubles.
    pub const fn new(high: [f64; N]) -> Self {
        Self {
            high,
            low: [0.0; N],
        }
    }

    /// Adds the increments of all lanes.
    #[inline(always)]
    fn add<L: Lanes>(&mut self, increments: &[L; N]) {
        for k in 0..N {
            let (sum, rest) = increments[k].double_sum(L::splat(0.0));
            let (high, error) = two_sum(self.high[k], sum);
            (self.high[k], self.low[k]) = fast_two_sum(high, (self.low[k] + rest) + error);
        }
    }

    /// `self + Σ_j μ_ij increments_j` in lane i.
    #[inline(always)]
    fn stages<L: Lanes, const S: usize>(&self, mu: &[L; S], increments: &[L; N]) -> [L; N] {
        array::from_fn(|k| {
            let sum = transform(mu, increments[k]) + L::splat(self.low[k]);
            L::splat(self.high[k]) + sum
        })
    }
}

/// Whether changes still decrease: in some lane `change` is positive and below the smallest change so far, which is
/// updated.
#[inline(always)]
fn shrinks<L: Lanes>(change: L, least: &mut L) -> bool {
    let shrinks = change.between(L::splat(0.0), *least);
    *least = least.min(change);
    shrinks
}

/// `μ_ij = a_ij/b_j` and `μ̃_ij = ã_ij/b_j`: of two that add up to 1, the larger is rounded and the smaller is the
/// exact remainder.
fn mu<const S: usize>(rule: &Rule<S>) -> [[[f64; S]; S]; 2] {
    let mut mu = [[[0.0; S]; S]; 2];
    for i in 0..S {
        for j in 0..S {
            let (here, there) = (rule.a[i][j] / rule.b[j], rule.a_tilde[j][i] / rule.b[i]);
            let here = if i == j && here == there {
                0.5
            } else if here > there {
                here
            } else {
                1.0 - there
            };
            (mu[0][i][j], mu[1][j][i]) = (here, 1.0 - here);
        }
    }
    mu
}

/// The method for separable systems with quadratic kinetic energy.
#[derive(Clone, Copy, Debug)]
pub struct NoDrift<L, const S: usize> {
    mu: [[L; S]; 2],
    weights: L,
    /// The predictor, and the iteration while the changes are large.
    rough: SecondOrder<L, S>,
}

impl<L: Lanes, const S: usize> NoDrift<L, S> {
    /// The method with steps of `step_size`.
    pub fn new(rule: &Rule<S>, step_size: f64) -> Self {
        Self {
            mu: mu(rule).map(|mu| columns(&mu, |_| 1.0)),
            weights: row(&rule.b, step_size),
            rough: SecondOrder::new(rule, step_size),
        }
    }

    /// Takes `steps` steps from `(q, p)`, and returns the number of sweeps.
    ///
    /// Until the stages change by less than `rough`, sweeps use the second-order form, which needs one matrix instead
    /// of two.
    #[inline(always)]
    pub fn run<T: Separable<N>, const N: usize>(
        &self,
        system: &T,
        (q, p): (&mut Double<N>, &mut Double<N>),
        rough: f64,
        steps: u64,
    ) -> u64 {
        let rough = L::splat(rough);
        let weigh = |x: [L; N]| x.map(|x| self.weights * x);
        let mut force = system.force(&q.high.map(L::splat));
        let mut matrix = &self.rough.stages;
        let mut sweeps = 0;
        for _ in 0..steps {
            let velocity = system.velocity(&p.high);
            let base: [L; N] = array::from_fn(|k| {
                L::splat(velocity[k]).fused(self.rough.nodes, L::splat(q.high[k]))
            });
            let second_order = |matrix: &[L; S], force: &[L; N]| -> [L; N] {
                let acceleration = system.velocity(force);
                array::from_fn(|k| base[k] + transform(matrix, acceleration[k]))
            };
            let mut stages = second_order(matrix, &force);
            matrix = &self.rough.extrapolated;
            loop {
                force = system.force(&stages);
                sweeps += 1;
                let next = second_order(&self.rough.stages, &force);
                let change = largest_change(&next, &stages);
                stages = next;
                if !change.exceeds(rough) {
                    break;
                }
            }
            let mut least = L::splat(f64::INFINITY);
            let mut drifts;
            let mut kicks;
            loop {
                force = system.force(&stages);
                kicks = weigh(force);
                drifts = weigh(system.velocity(&p.stages(&self.mu[1], &kicks)));
                sweeps += 1;
                let next = q.stages(&self.mu[0], &drifts);
                let change = largest_change(&next, &stages);
                if !shrinks(change, &mut least) {
                    break;
                }
                stages = next;
            }
            q.add(&drifts);
            p.add(&kicks);
        }
        sweeps
    }
}

/// The largest change of a component in each lane.
#[inline(always)]
fn largest_change<L: Lanes, const N: usize>(a: &[L; N], b: &[L; N]) -> L {
    let mut change = L::splat(0.0);
    for k in 0..N {
        change = change.max((a[k] - b[k]).abs());
    }
    change
}

/// Whether the stages start from the opposite side of the solution, for half of the steps. Otherwise the rounding
/// errors of the iteration have a preferred sign and the energy drifts.
#[inline(always)]
const fn mirrors(step: u64) -> bool {
    let bits = step.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    (bits ^ bits >> 32).wrapping_mul(0xc4ce_b9fe_1a85_ec53) >> 63 == 1
}

/// The reflection of `old` at `new`.
#[inline(always)]
fn beyond<L: Lanes, const N: usize>(old: &[L; N], new: &[L; N]) -> [L; N] {
    array::from_fn(|k| new[k] + (new[k] - old[k]))
}

/// The method for any Hamiltonian.
#[derive(Clone, Copy, Debug)]
pub struct NoDriftGeneral<L, const S: usize> {
    mu: [[L; S]; 2],
    weights: L,
    rough: FirstOrder<L, S>,
}

impl<L: Lanes, const S: usize> NoDriftGeneral<L, S> {
    /// The method with steps of `step_size`.
    pub fn new(rule: &Rule<S>, step_size: f64) -> Self {
        Self {
            mu: mu(rule).map(|mu| columns(&mu, |_| 1.0)),
            weights: row(&rule.b, step_size),
            rough: FirstOrder::new(rule, step_size),
        }
    }

    /// Takes `steps` steps from `(q, p)`, and returns the number of sweeps.
    #[inline(always)]
    pub fn run<T: General<N>, const N: usize>(
        &self,
        system: &T,
        (q, p): (&mut Double<N>, &mut Double<N>),
        steps: u64,
    ) -> u64 {
        let weigh = |x: [L; N]| x.map(|x| self.weights * x);
        let (mut velocity, mut force) = system.slopes(&q.high.map(L::splat), &p.high.map(L::splat));
        let mut matrix = &self.rough.stages;
        let mut sweeps = 0;
        for step in 0..steps {
            let mut at = (
                FirstOrder::<L, S>::stages(&matrix[0], &q.high, &velocity),
                FirstOrder::<L, S>::stages(&matrix[1], &p.high, &force),
            );
            matrix = &self.rough.extrapolated;
            let stages = |(velocity, force): ([L; N], [L; N])| {
                let (drifts, kicks) = (weigh(velocity), weigh(force));
                let next = (
                    q.stages(&self.mu[0], &drifts),
                    p.stages(&self.mu[1], &kicks),
                );
                (drifts, kicks, next)
            };
            if mirrors(step) {
                let (_, _, next) = stages(system.slopes(&at.0, &at.1));
                let (_, _, after) = stages(system.slopes(&next.0, &next.1));
                sweeps += 2;
                at = (beyond(&next.0, &after.0), beyond(&next.1, &after.1));
            }
            let mut least = L::splat(f64::INFINITY);
            let mut drifts;
            let mut kicks;
            loop {
                (velocity, force) = system.slopes(&at.0, &at.1);
                sweeps += 1;
                let next;
                (drifts, kicks, next) = stages((velocity, force));
                let change = largest_change(&next.0, &at.0).max(largest_change(&next.1, &at.1));
                if !shrinks(change, &mut least) {
                    break;
                }
                at = next;
            }
            q.add(&drifts);
            p.add(&kicks);
        }
        sweeps
    }
}
