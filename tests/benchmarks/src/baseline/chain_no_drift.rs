//! Gauss and Lobatto methods on the FPUT-β chain in the form without energy drift: the rounded coefficients are exactly
//! symplectic, the iteration runs until the changes no longer decrease, and the state is a sum of two doubles.

use std::array;

use wide::f64x8;

use super::chain::{Blocks, Walk};
use super::gauss::{Rule, product};
use super::lanes::{Lanes, fast_two_sum, two_sum};

/// Positions or momenta, each a sum of two doubles.
#[derive(Clone, Debug)]
pub struct DoubleBlocks {
    /// The sum, rounded.
    pub high: Blocks,
    /// The rounding error of `high`.
    low: Blocks,
}

impl DoubleBlocks {
    /// Exact doubles.
    pub fn new(high: Blocks) -> Self {
        let low = Blocks(vec![f64x8::splat(0.0); high.0.len()]);
        Self { high, low }
    }
}

/// The contents of the rows: forces while the changes are large, then increments `h b_j force_j`.
#[derive(Clone, Copy, PartialEq)]
enum Rows {
    Forces,
    Increments,
}

/// The second-order form: `Q_i = q0 + h c_i p0 + h Σ_j ν_ij w_j` with `ν_ij − ν_ji = c_i − c_j` exactly.
#[derive(Clone, Debug)]
pub struct NoDrift<const S: usize> {
    step_size: f64,
    /// `c_i`
    nodes: [f64; S],
    /// `ν`
    nu: [[f64; S]; S],
    /// `h a ã`, applied to forces.
    rough: [[f64; S]; S],
    /// The predictor, applied to the increments of the previous step.
    extrapolated: [[f64; S]; S],
    /// `h b_j`
    weights: [f64; S],
    /// The rows of all stages, block by block.
    rows: Vec<[f64x8; S]>,
}

/// Rounds a number below one to a multiple of 2⁻⁵²; sums and differences of such numbers are exact.
fn on_grid(x: f64) -> f64 {
    (x + 1.0) - 1.0
}

impl<const S: usize> NoDrift<S> {
    /// The method for `particles`, with steps of `step_size`.
    pub fn new(rule: &Rule<S>, particles: usize, step_size: f64) -> Self {
        let (h, square) = (step_size, rule.square());
        let nodes = rule.c.map(on_grid);
        // c_i − ν_ij is symmetric; each pair uses the same entry.
        let symmetric = |i: usize, j: usize| on_grid(nodes[i] - square[i][j] / rule.b[j]);
        let extrapolated = product(&square, &rule.extrapolation());
        Self {
            step_size,
            nodes,
            nu: array::from_fn(|i| array::from_fn(|j| nodes[i] - symmetric(i.max(j), i.min(j)))),
            rough: square.map(|row| row.map(|x| h * x)),
            extrapolated: array::from_fn(|i| array::from_fn(|j| extrapolated[i][j] / rule.b[j])),
            weights: rule.b.map(|b| h * b),
            rows: vec![[f64x8::splat(0.0); S]; particles / Blocks::LANES],
        }
    }

    /// Computes new stage positions from the rows by `h matrix`, and new rows of a kind; returns their largest change.
    #[inline(always)]
    fn sweep(
        &mut self,
        (q, p): (&DoubleBlocks, &DoubleBlocks),
        matrix: fn(&Self) -> &[[f64; S]; S],
        kind: Rows,
    ) -> f64x8 {
        let mut rows = std::mem::take(&mut self.rows);
        let (h, nodes, weights) = (f64x8::splat(self.step_size), &self.nodes, &self.weights);
        let matrix = matrix(self);
        let mut change = f64x8::splat(0.0);
        let stages = |(q, low): (f64x8, f64x8), p: f64x8, row: &[f64x8; S]| -> [f64x8; S] {
            array::from_fn(|i| {
                let mut sum = f64x8::splat(matrix[i][0]) * row[0];
                for j in 1..S {
                    sum = row[j].fused(f64x8::splat(matrix[i][j]), sum);
                }
                q + h.fused(sum, h.fused(f64x8::splat(nodes[i]) * p, low))
            })
        };
        let bases = (q.high.0.iter().copied()).zip(q.low.0.iter().copied());
        let mut ahead = bases.zip(p.high.0.iter().copied()).zip(&mut rows);
        if let Some(((base, p), first)) = ahead.next() {
            let mut walks = stages(base, p, first).map(Walk::new);
            let mut before = first;
            let mut update = |walks: &mut [Walk; S], next: [f64x8; S], row: &mut [f64x8; S]| {
                for i in 0..S {
                    let mut new = walks[i].force(next[i]);
                    if kind == Rows::Increments {
                        new *= f64x8::splat(weights[i]);
                    }
                    change = change.fast_max((new - row[i]).abs());
                    row[i] = new;
                }
            };
            for ((base, p), row) in ahead {
                let next = stages(base, p, row);
                update(&mut walks, next, before);
                before = row;
            }
            update(&mut walks, [f64x8::splat(0.0); S], before);
        }
        self.rows = rows;
        change
    }

    /// Takes `steps` steps, and returns the number of sweeps. Sweeps use forces while these change a stage position by
    /// more than about `rough`.
    pub fn run(
        &mut self,
        (q, p): (&mut DoubleBlocks, &mut DoubleBlocks),
        rough: f64,
        steps: u64,
    ) -> u64 {
        let rough = f64x8::splat(2.0 * rough / (self.step_size * self.step_size));
        for row in &mut self.rows {
            *row = [f64x8::splat(0.0); S];
        }
        let mut sweeps = 0;
        for _ in 0..steps {
            self.sweep((q, p), |made| &made.extrapolated, Rows::Forces);
            sweeps += 2;
            while (self.sweep((q, p), |made| &made.rough, Rows::Forces)).exceeds(rough) {
                sweeps += 1;
            }
            self.sweep((q, p), |made| &made.rough, Rows::Increments);
            sweeps += 1;
            let mut least = f64x8::splat(f64::INFINITY);
            loop {
                let change = self.sweep((q, p), |made| &made.nu, Rows::Increments);
                sweeps += 1;
                if !change.between(f64x8::splat(0.0), least) {
                    break;
                }
                least = least.min(change);
            }
            self.add((q, p));
        }
        sweeps
    }

    /// Adds the increments to the state.
    #[inline(always)]
    fn add(&self, (q, p): (&mut DoubleBlocks, &mut DoubleBlocks)) {
        let h = f64x8::splat(self.step_size);
        let q = q.high.0.iter_mut().zip(&mut q.low.0);
        let p = p.high.0.iter_mut().zip(&mut p.low.0);
        for (((q, q_low), (p, p_low)), row) in q.zip(p).zip(&self.rows) {
            let mut mean = row[0] * f64x8::splat(1.0 - self.nodes[0]);
            for j in 1..S {
                mean = row[j].fused(f64x8::splat(1.0 - self.nodes[j]), mean);
            }
            let rest = p_low.fused(h, *q_low);
            let (sum, error) = two_sum(h * *p, h * mean);
            (*q, *q_low) = plus((*q, rest), (sum, error));
            let (mut sum, mut rest) = (row[0], f64x8::splat(0.0));
            for j in 1..S {
                let error;
                (sum, error) = two_sum(sum, row[j]);
                rest += error;
            }
            (*p, *p_low) = plus((*p, *p_low), (sum, rest));
        }
    }
}

/// The sum of two double-double numbers.
#[inline(always)]
fn plus((a, a_low): (f64x8, f64x8), (b, b_low): (f64x8, f64x8)) -> (f64x8, f64x8) {
    let (high, error) = two_sum(a, b);
    fast_two_sum(high, (a_low + b_low) + error)
}
