//! A Gauss method over wide numbers, with fixed-point iteration: short, slow, and independent of the library for which
//! it computes references.

use std::fmt;

use symplectic::num_traits::{One, Zero};
use symplectic::{Scalar, State, System, Vector};

use super::Wide;

/// The coefficients of a collocation method.
#[derive(Clone, Debug)]
pub struct Collocation {
    a: Vec<Vec<Wide>>,
    b: Vec<Wide>,
}

/// The stage iteration did not converge in the step from this time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NoConvergence {
    /// The time.
    pub time: f64,
    /// The step size.
    pub step_size: f64,
}

impl fmt::Display for NoConvergence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { time, step_size } = self;
        write!(
            f,
            "no convergence at time {time} in a step of {step_size:e}"
        )
    }
}

impl std::error::Error for NoConvergence {}

/// The relative change that ends the iteration. The remaining error is about the next change, some 10⁻⁴⁰, because the
/// iteration contracts well.
const TOLERANCE: f64 = 1e-38;

/// Maximum number of sweeps.
const MAX_SWEEPS: u32 = 200;

impl Collocation {
    /// The method with these coefficients; `None` if one is not a decimal.
    pub fn from_decimals(a: &[Vec<String>], b: &[String]) -> Option<Self> {
        let parse =
            |row: &[String]| -> Option<Vec<Wide>> { row.iter().map(|x| Wide::parse(x)).collect() };
        Some(Self {
            a: a.iter().map(|row| parse(row)).collect::<Option<_>>()?,
            b: parse(b)?,
        })
    }

    /// The number of stages.
    pub fn stages(&self) -> usize {
        self.b.len()
    }

    /// The state at `end` and the number of steps, from `start` at time 0. `step_size` returns the size of each step
    /// from the state at its beginning; the last step ends at `end`.
    ///
    /// The time of the state is rounded to a double; the system must be autonomous.
    ///
    /// # Errors
    ///
    /// [`NoConvergence`].
    pub fn integrate<V, S>(
        &self,
        system: &S,
        start: &State<V>,
        end: f64,
        step_size: impl Fn(&State<V>) -> f64,
    ) -> Result<(State<V>, u64), NoConvergence>
    where
        V: Vector<Scalar = Wide>,
        S: System<V>,
    {
        let mut state = start.clone();
        // The remaining time in wide numbers, so that the steps add up to the end to all digits.
        let mut left = Wide::from_f64(end);
        let mut steps = 0;
        while !left.is_zero() {
            let mut size = Wide::from_f64(step_size(&state));
            if size > left {
                size = left;
            }
            self.step(system, &mut state, size)?;
            left -= size;
            state.time = end - left.to_f64();
            steps += 1;
        }
        Ok((state, steps))
    }

    fn step<V, S>(&self, system: &S, state: &mut State<V>, size: Wide) -> Result<(), NoConvergence>
    where
        V: Vector<Scalar = Wide>,
        S: System<V>,
    {
        let time = Wide::zero();
        let stages = self.stages();
        let (mut positions, mut momenta) =
            (vec![state.q.clone(); stages], vec![state.p.clone(); stages]);
        let mut velocities = vec![state.q.zeros_like(); stages];
        let mut forces = velocities.clone();
        for _ in 0..MAX_SWEEPS {
            for i in 0..stages {
                system.force(time, &positions[i], &momenta[i], &mut forces[i]);
            }
            let change = self.update(&state.p, size, &forces, &mut momenta);
            for i in 0..stages {
                system.velocity(time, &positions[i], &momenta[i], &mut velocities[i]);
            }
            let change = change.max(self.update(&state.q, size, &velocities, &mut positions));
            if change <= TOLERANCE {
                add(&mut state.p, size, &self.b, &forces);
                add(&mut state.q, size, &self.b, &velocities);
                return Ok(());
            }
        }
        Err(NoConvergence {
            time: state.time,
            step_size: size.to_f64(),
        })
    }

    /// Updates the stages to `start + size Σ_j a_ij slope_j`; returns the largest change relative to the largest
    /// component.
    fn update<V>(&self, start: &V, size: Wide, slopes: &[V], stages: &mut [V]) -> f64
    where
        V: Vector<Scalar = Wide>,
    {
        let (mut change, mut largest) = (Wide::zero(), Wide::zero());
        for (row, stage) in self.a.iter().zip(stages) {
            let mut new = start.clone();
            add(&mut new, size, row, slopes);
            for (&new, &old) in new.as_slice().iter().zip(stage.as_slice()) {
                change = larger(change, new - old);
                largest = larger(largest, new);
            }
            *stage = new;
        }
        if largest.is_zero() {
            largest = Wide::one();
        }
        (change / largest).to_f64()
    }
}

/// Adds `size Σ_j factor_j slope_j`.
fn add<V: Vector<Scalar = Wide>>(sum: &mut V, size: Wide, factors: &[Wide], slopes: &[V]) {
    for (k, component) in sum.as_mut_slice().iter_mut().enumerate() {
        let terms = factors.iter().zip(slopes);
        let total = terms.fold(Wide::zero(), |total, (factor, slope)| {
            factor.mul_add(slope.as_slice()[k], total)
        });
        *component = size.mul_add(total, *component);
    }
}

/// The maximum of `a` and `|b|`.
fn larger(a: Wide, b: Wide) -> Wide {
    let b = b.abs();
    if b > a { b } else { a }
}
