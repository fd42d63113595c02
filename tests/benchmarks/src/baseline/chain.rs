//! The FPUT-β chain: long vectors, with lanes along the particles and a single pass.

use std::array;

use wide::f64x8;

use super::explicit::Splitting;
use super::gauss::{Rule, product};
use super::lanes::Lanes;

/// Positions or momenta of the moving particles, in blocks of eight.
#[derive(Clone, Debug, PartialEq)]
pub struct Blocks(pub(super) Vec<f64x8>);

impl Blocks {
    /// Number of particles in a block.
    pub(super) const LANES: usize = f64x8::COUNT;

    /// The `values` in blocks; an incomplete block at the end is dropped.
    pub fn new(values: &[f64]) -> Self {
        let (blocks, _) = values.as_chunks::<{ Self::LANES }>();
        Self(blocks.iter().copied().map(f64x8::new).collect())
    }

    /// The values.
    pub fn values(&self) -> impl Iterator<Item = f64> {
        self.0.iter().flat_map(|block| block.to_array())
    }
}

/// A walk along the chain that computes the forces block by block.
#[derive(Clone, Copy)]
pub(super) struct Walk {
    here: f64x8,
    /// The tensions of the bonds to the right of the previous block.
    tensions: f64x8,
}

impl Walk {
    /// Starts at the left wall with the first block.
    #[inline(always)]
    pub(super) fn new(first: f64x8) -> Self {
        Self {
            here: first,
            tensions: tension(f64x8::splat(first.lane(0))),
        }
    }

    /// The force on the present block, whose right neighbour is the block `next`.
    #[inline(always)]
    pub(super) fn force(&mut self, next: f64x8) -> f64x8 {
        let (here, right) = (self.here.to_array(), next.lane(0));
        let right = f64x8::from_fn(|i| {
            if i + 1 < Blocks::LANES {
                here[i + 1]
            } else {
                right
            }
        });
        let tensions = tension(right - self.here);
        let (old, new) = (self.tensions.lane(Blocks::LANES - 1), tensions.to_array());
        let left = f64x8::from_fn(|i| if i == 0 { old } else { new[i - 1] });
        *self = Self {
            here: next,
            tensions,
        };
        tensions - left
    }
}

/// `d + d³`
#[inline(always)]
fn tension(d: f64x8) -> f64x8 {
    (d * d).fused(d, d)
}

/// `q += drift p`, then `p += kick force(q)`, in one pass.
#[inline(always)]
fn drift_and_kick(q: &mut Blocks, p: &mut Blocks, drift: f64, kick: f64) {
    let (drift, kick) = (f64x8::splat(drift), f64x8::splat(kick));
    let ([first, q @ ..], [p_first, p @ ..]) = (&mut q.0[..], &mut p.0[..]) else {
        return;
    };
    *first = p_first.fused(drift, *first);
    let mut walk = Walk::new(*first);
    // The block that waits for its right neighbour.
    let mut before = p_first;
    for (q, p) in q.iter_mut().zip(p) {
        *q = p.fused(drift, *q);
        *before = walk.force(*q).fused(kick, *before);
        before = p;
    }
    *before = walk.force(f64x8::splat(0.0)).fused(kick, *before);
}

/// Takes `steps` steps of a splitting. The last stage of a step is merged with the first stage of the next.
pub fn explicit<M: Splitting>(q: &mut Blocks, p: &mut Blocks, step_size: f64, steps: u64) {
    let last = M::LENGTH - 1;
    let h = step_size;
    if M::DRIFT_FIRST {
        // Drift, kick, …, drift: the last kick is empty.
        let mut pending = h * M::DRIFTS[0];
        for _ in 0..steps {
            for i in 0..last {
                drift_and_kick(q, p, pending, h * M::KICKS[i]);
                pending = h * M::DRIFTS[i + 1];
            }
            pending += h * M::DRIFTS[0];
        }
        drift_and_kick(q, p, pending - h * M::DRIFTS[0], 0.0);
    } else {
        // Kick, drift, …, kick: the last drift is empty.
        drift_and_kick(q, p, 0.0, h * M::KICKS[0]);
        for step in 0..steps {
            for i in 0..last {
                let mut impulse = M::KICKS[i + 1];
                if i + 1 == last && step + 1 < steps {
                    impulse += M::KICKS[0];
                }
                drift_and_kick(q, p, h * M::DRIFTS[i], h * impulse);
            }
        }
    }
}

/// Gauss in the second-order form.
#[derive(Clone, Debug)]
pub struct SecondOrder<const S: usize> {
    step_size: f64,
    nodes: [f64; S],
    stages: [[f64; S]; S],
    extrapolated: [[f64; S]; S],
    weights: [f64; S],
    position_weights: [f64; S],
    /// The forces of all stages, block by block.
    forces: Vec<[f64x8; S]>,
}

impl<const S: usize> SecondOrder<S> {
    /// The method for `particles`, with steps of `step_size`.
    pub fn new(rule: &Rule<S>, particles: usize, step_size: f64) -> Self {
        let h = step_size;
        let square = rule.square();
        let scaled = |matrix: [[f64; S]; S]| matrix.map(|row| row.map(|x| h * h * x));
        Self {
            step_size,
            nodes: rule.c.map(|c| h * c),
            stages: scaled(square),
            extrapolated: scaled(product(&square, &rule.extrapolation())),
            weights: rule.b.map(|b| h * b),
            position_weights: array::from_fn(|i| h * h * rule.b[i] * (1.0 - rule.c[i])),
            forces: vec![[f64x8::splat(0.0); S]; particles / Blocks::LANES],
        }
    }

    /// Computes new stage positions from the forces by `matrix`, and the new forces; returns the largest change of a
    /// force.
    #[inline(always)]
    fn sweep(
        (q, p): (&Blocks, &Blocks),
        forces: &mut [[f64x8; S]],
        nodes: &[f64; S],
        matrix: &[[f64; S]; S],
    ) -> f64x8 {
        let mut change = f64x8::splat(0.0);
        let stages = |q: f64x8, p: f64x8, force: &[f64x8; S]| -> [f64x8; S] {
            array::from_fn(|i| {
                let mut sum = p * f64x8::splat(nodes[i]);
                for j in 0..S {
                    sum = force[j].fused(f64x8::splat(matrix[i][j]), sum);
                }
                q + sum
            })
        };
        let ([q_first, q @ ..], [p_first, p @ ..], [force_first, forces @ ..]) =
            (&q.0[..], &p.0[..], forces)
        else {
            return change;
        };
        let mut walks = stages(*q_first, *p_first, force_first).map(Walk::new);
        let mut before = force_first;
        let mut update = |walks: &mut [Walk; S], next: [f64x8; S], force: &mut [f64x8; S]| {
            for i in 0..S {
                let new = walks[i].force(next[i]);
                change = change.fast_max((new - force[i]).abs());
                force[i] = new;
            }
        };
        for ((q, p), force) in q.iter().zip(p).zip(forces) {
            let next = stages(*q, *p, force);
            update(&mut walks, next, before);
            before = force;
        }
        update(&mut walks, [f64x8::splat(0.0); S], before);
        change
    }

    /// Takes `steps` steps; iterates until no force changes a stage position by more than about `tolerance`, and
    /// returns the number of sweeps.
    pub fn run(&mut self, q: &mut Blocks, p: &mut Blocks, tolerance: f64, steps: u64) -> u64 {
        let bound = f64x8::splat(2.0 * tolerance / (self.step_size * self.step_size));
        for force in &mut self.forces {
            *force = [f64x8::splat(0.0); S];
        }
        let mut matrix = &self.stages;
        let mut sweeps = 0;
        for _ in 0..steps {
            Self::sweep((q, p), &mut self.forces, &self.nodes, matrix);
            sweeps += 1;
            matrix = &self.extrapolated;
            loop {
                let change = Self::sweep((q, p), &mut self.forces, &self.nodes, &self.stages);
                sweeps += 1;
                if !change.exceeds(bound) {
                    break;
                }
            }
            for ((q, p), force) in q.0.iter_mut().zip(&mut p.0).zip(&self.forces) {
                let mut drift = *p * f64x8::splat(self.step_size);
                let mut kick = f64x8::splat(0.0);
                for j in 0..S {
                    drift = force[j].fused(f64x8::splat(self.position_weights[j]), drift);
                    kick = force[j].fused(f64x8::splat(self.weights[j]), kick);
                }
                *q += drift;
                *p += kick;
            }
        }
        sweeps
    }
}
