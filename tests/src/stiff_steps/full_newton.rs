//! The full Newton iteration: derivatives at every stage in every iteration, and a dense system for all stages.
//!
//! Short, slow, and independent of the library. The unknowns are the stage positions; masses are 1.

#![allow(
    clippy::needless_range_loop,
    reason = "the indices are those of the formulas"
)]

use std::cell::RefCell;
use std::rc::Rc;

use symplectic::nalgebra::SVector;
use symplectic::output::Inside;
use symplectic::solver::{
    Failure, FixedPoint, HalfTableau, Outcome, Solver, StageStorage, StageTableau, Step,
    StepStatistics, Stopping, Visit, WarmStart,
};
use symplectic::system::Class;
use symplectic::{Quantity, Scalar, Separable, Summation, System};

use super::systems::Stiff;

/// First-order sensitivity of the result of a step to its start and to rounding errors.
#[derive(Clone, Debug, Default)]
pub struct Sensitivity {
    /// |∂(q1, p1)/∂(q0, p0)| entrywise, by rows.
    pub map: Vec<Vec<f64>>,
    /// A bound on the effect on (q1, p1) of rounding errors of one unit in the evaluations and the stages.
    pub noise: Vec<f64>,
}

impl Sensitivity {
    /// The error bound after a step from the bound before it.
    pub fn carry(&self, before: &[f64]) -> Vec<f64> {
        let carried = |row: &Vec<f64>| row.iter().zip(before).map(|(a, b)| a * b).sum::<f64>();
        let rows = self.map.iter().zip(&self.noise);
        rows.map(|(row, noise)| noise + carried(row)).collect()
    }
}

/// The fraction of the step and the values of a stage.
pub type StageValues = (f64, Vec<f64>);

/// A system that provides the starting values of [`FullNewton`] and stores its sensitivity.
#[derive(Clone, Debug)]
pub struct Watched<S> {
    system: S,
    /// Starting positions at fractions of the step; stages without one start from the beginning of the step.
    pub guess: Rc<RefCell<Vec<StageValues>>>,
    /// The sensitivity of the last step.
    pub notes: Rc<RefCell<Sensitivity>>,
    /// Whether the sensitivity is computed.
    pub is_reference: bool,
}

impl<S> Watched<S> {
    /// A system without starting values.
    pub fn new(system: S) -> Self {
        Self {
            system,
            guess: Rc::default(),
            notes: Rc::default(),
            is_reference: false,
        }
    }
}

impl<T: Scalar, S: Stiff<N>, const N: usize> System<SVector<T, N>> for Watched<S> {
    type Class = Separable;
    type Solver = FixedPoint;

    fn velocity(
        &self,
        _time: T,
        _q: &SVector<T, N>,
        p: &SVector<T, N>,
        velocity: &mut SVector<T, N>,
    ) {
        *velocity = *p;
    }

    fn force(&self, _time: T, q: &SVector<T, N>, _p: &SVector<T, N>, force: &mut SVector<T, N>) {
        self.system.force(&q.data.0[0], &mut force.data.0[0]);
    }
}

/// The solver.
#[derive(Clone, Copy, Debug)]
pub struct FullNewton;

/// Empty storage: the solver keeps nothing between steps.
#[derive(Clone, Copy, Debug)]
pub struct Nothing;

impl<T: Scalar, const N: usize> StageStorage<SVector<T, N>> for Nothing {
    fn like(_: &SVector<T, N>) -> Self {
        Self
    }

    fn words(&mut self, _: &mut Visit<'_>) {}

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        None
    }

    fn mismatch(&self, _: usize) -> Option<(Quantity, usize, usize)> {
        None
    }
}

/// Changes of the positions up to this multiple of EPSILON are rounding errors.
const ROUNDING: f64 = 16.0;

impl<T: Scalar, S: Stiff<N> + 'static, const N: usize> Solver<SVector<T, N>, Watched<S>>
    for FullNewton
{
    type Memory<P: StageTableau> = Nothing;

    fn take<P, R>(
        step: &Step<'_, SVector<T, N>>,
        watched: &Watched<S>,
        _memory: &mut Nothing,
        _kept: WarmStart,
        stopping: Stopping,
        outcome: Outcome<'_, SVector<T, N>>,
    ) -> Result<StepStatistics, Failure>
    where
        P: StageTableau,
        R: Summation,
        Watched<S>: System<SVector<T, N>, Class = P::Class>,
    {
        let mut stages = Stages::new::<P>(step);
        let system = &watched.system;
        stages.start_from::<P>(&watched.guess.borrow());
        let iterations = stages.solve(system, stopping.max_iterations)?;
        let (q, p) = stages.result(system);
        (*outcome.q, *outcome.p) = (q, p);
        if watched.is_reference {
            watched.notes.replace(stages.sensitivity(system, &q, &p));
        }
        Ok(StepStatistics {
            iterations,
            ..StepStatistics::default()
        })
    }

    fn extend<P: StageTableau>(
        _memory: &Nothing,
        _at: Inside<'_, SVector<T, N>>,
        _q: &mut SVector<T, N>,
        _p: &mut SVector<T, N>,
    ) {
    }
}

/// `Q_i = q0 + Σ_j a_ij P_j`, `P_j = p0 + Σ_l ã_jl force(Q_l)`; the coefficients contain the step size.
struct Stages<T, const N: usize> {
    start: ([T; N], [T; N]),
    a: Vec<Vec<T>>,
    a_tilde: Vec<Vec<T>>,
    b: Vec<T>,
    b_tilde: Vec<T>,
    q: Vec<[T; N]>,
}

impl<T: Scalar, const N: usize> Stages<T, N> {
    fn new<P: StageTableau>(step: &Step<'_, SVector<T, N>>) -> Self {
        assert!(P::Class::SEPARABLE);
        let matrix = |half: &HalfTableau, other: &HalfTableau| -> Vec<Vec<T>> {
            let entry = |i: usize, j: usize| {
                let column = half.columns[j][i];
                match P::INCREMENTS {
                    true => T::from_f64(column) * T::from_f64(step.size * other.weights[j]),
                    false => T::from_f64(step.size * column),
                }
            };
            (0..half.count)
                .map(|i| (0..other.count).map(|j| entry(i, j)).collect())
                .collect()
        };
        let weights = |half: &HalfTableau| -> Vec<T> {
            (0..half.count)
                .map(|j| T::from_f64(step.size * half.weights[j]))
                .collect()
        };
        let (positions, momenta) = (&P::POSITIONS, &P::MOMENTA);
        Self {
            start: (step.q.data.0[0], step.p.data.0[0]),
            a: matrix(positions, momenta),
            a_tilde: matrix(momenta, positions),
            b: weights(momenta),
            b_tilde: weights(positions),
            q: vec![step.q.data.0[0]; positions.count],
        }
    }

    fn start_from<P: StageTableau>(&mut self, guess: &[(f64, Vec<f64>)]) {
        for (q, time) in self.q.iter_mut().zip(P::POSITIONS.times) {
            let found = guess
                .iter()
                .find(|(fraction, _)| (fraction - time).abs() < 1e-9);
            if let Some((_, components)) = found {
                *q = std::array::from_fn(|k| T::from_f64(components[k]));
            }
        }
    }

    /// Returns the number of iterations.
    fn solve<S: Stiff<N>>(&mut self, system: &S, max_iterations: u32) -> Result<u32, Failure> {
        let mut residual = f64::NAN;
        for iteration in 1..=max_iterations {
            let factors = Factors::of(self.matrix(system)).ok_or(Failure::SingularMatrix)?;
            let mut change = self.residual(system);
            factors.solve(&mut change);
            let mut scale = self
                .start
                .0
                .iter()
                .fold(0.0, |scale: f64, q| scale.max(q.magnitude()));
            for (q, change) in self.q.iter_mut().flatten().zip(&change) {
                *q += *change;
                scale = scale.max(q.magnitude());
            }
            let size = change
                .iter()
                .fold(0.0, |size: f64, x| size.max(x.magnitude()));
            residual = size / scale;
            if !residual.is_finite() {
                break;
            }
            if residual <= ROUNDING * T::EPSILON {
                return Ok(iteration);
            }
        }
        Err(Failure::NoConvergence {
            residual,
            iterations: max_iterations,
        })
    }

    fn forces<S: Stiff<N>>(&self, system: &S) -> Vec<[T; N]> {
        let mut forces = vec![[T::zero(); N]; self.q.len()];
        for (q, force) in self.q.iter().zip(&mut forces) {
            system.force(q, force);
        }
        forces
    }

    fn momenta(&self, forces: &[[T; N]]) -> Vec<[T; N]> {
        let momentum = |row: &Vec<T>| {
            std::array::from_fn(|k| {
                row.iter()
                    .zip(forces)
                    .fold(self.start.1[k], |sum, (a, force)| sum + *a * force[k])
            })
        };
        self.a_tilde.iter().map(momentum).collect()
    }

    /// The residual of the stage equations.
    fn residual<S: Stiff<N>>(&self, system: &S) -> Vec<T> {
        let momenta = self.momenta(&self.forces(system));
        let mut residual = Vec::new();
        for (row, q) in self.a.iter().zip(&self.q) {
            for k in 0..N {
                let moved = row
                    .iter()
                    .zip(&momenta)
                    .fold(T::zero(), |sum, (a, p)| sum + *a * p[k]);
                residual.push(self.start.0[k] - q[k] + moved);
            }
        }
        residual
    }

    /// `1 − A Ã ⊗ ∂force/∂q`, with the derivative at each stage.
    fn matrix<S: Stiff<N>>(&self, system: &S) -> Vec<Vec<T>> {
        let count = self.q.len();
        let derivatives: Vec<_> = self.q.iter().map(|q| system.derivative(q)).collect();
        let entry = |row: usize, column: usize| {
            let ((i, k), (l, m)) = ((row / N, row % N), (column / N, column % N));
            let products = self.a[i].iter().zip(&self.a_tilde);
            let product = products.fold(T::zero(), |sum, (a, tilde)| sum + *a * tilde[l]);
            let unit = if row == column { T::one() } else { T::zero() };
            unit - product * derivatives[l][k][m]
        };
        (0..count * N)
            .map(|row| (0..count * N).map(|column| entry(row, column)).collect())
            .collect()
    }

    fn result<S: Stiff<N>>(&self, system: &S) -> (SVector<T, N>, SVector<T, N>) {
        let forces = self.forces(system);
        let momenta = self.momenta(&forces);
        let sum = |start: &[T; N], weights: &[T], values: &[[T; N]]| {
            SVector::from(std::array::from_fn(|k| {
                weights
                    .iter()
                    .zip(values)
                    .fold(start[k], |sum, (b, value)| sum + *b * value[k])
            }))
        };
        (
            sum(&self.start.0, &self.b, &momenta),
            sum(&self.start.1, &self.b_tilde, &forces),
        )
    }

    /// (δq1, δp1) for errors of the stage momenta and of the forces; the caller expresses changes of the start by
    /// these.
    fn response(
        &self,
        factors: &Factors<T>,
        derivatives: &[[[T; N]; N]],
        of_momenta: &[[T; N]],
        of_forces: &[[T; N]],
    ) -> [[T; N]; 2] {
        let through = |forces: &[[T; N]]| -> Vec<[T; N]> {
            (0..self.a_tilde.len())
                .map(|j| {
                    std::array::from_fn(|k| {
                        self.a_tilde[j]
                            .iter()
                            .zip(forces)
                            .fold(of_momenta[j][k], |sum, (a, f)| sum + *a * f[k])
                    })
                })
                .collect()
        };
        let momenta = through(of_forces);
        let mut unknown: Vec<T> = Vec::new();
        for row in &self.a {
            for k in 0..N {
                unknown.push(
                    row.iter()
                        .zip(&momenta)
                        .fold(T::zero(), |sum, (a, p)| sum + *a * p[k]),
                );
            }
        }
        factors.solve(&mut unknown);
        let forces: Vec<[T; N]> = of_forces
            .iter()
            .enumerate()
            .map(|(l, force)| {
                std::array::from_fn(|k| {
                    (0..N).fold(force[k], |sum, m| {
                        sum + derivatives[l][k][m] * unknown[l * N + m]
                    })
                })
            })
            .collect();
        let momenta = through(&forces);
        [
            std::array::from_fn(|k| {
                self.b
                    .iter()
                    .zip(&momenta)
                    .fold(T::zero(), |sum, (b, p)| sum + *b * p[k])
            }),
            std::array::from_fn(|k| {
                self.b_tilde
                    .iter()
                    .zip(&forces)
                    .fold(T::zero(), |sum, (b, f)| sum + *b * f[k])
            }),
        ]
    }

    fn sensitivity<S: Stiff<N>>(
        &self,
        system: &S,
        q: &SVector<T, N>,
        p: &SVector<T, N>,
    ) -> Sensitivity {
        let Some(factors) = Factors::of(self.matrix(system)) else {
            return Sensitivity::default();
        };
        let derivatives: Vec<_> = self.q.iter().map(|q| system.derivative(q)).collect();
        let (positions, count) = (self.q.len(), self.a_tilde.len());
        let zeros = |count| vec![[T::zero(); N]; count];
        let mut map = vec![vec![0.0; 2 * N]; 2 * N];
        let mut noise = vec![0.0; 2 * N];
        for k in 0..N {
            // A change of q0 changes the forces.
            let of_forces: Vec<[T; N]> = derivatives
                .iter()
                .map(|d| std::array::from_fn(|i| d[i][k]))
                .collect();
            let mut response = self.response(&factors, &derivatives, &zeros(count), &of_forces);
            response[0][k] += T::one();
            for i in 0..N {
                map[i][k] = response[0][i].magnitude();
                map[N + i][k] = response[1][i].magnitude();
            }
            let mut of_momenta = zeros(count);
            of_momenta.iter_mut().for_each(|p| p[k] = T::one());
            let mut response =
                self.response(&factors, &derivatives, &of_momenta, &zeros(positions));
            response[1][k] += T::one();
            for i in 0..N {
                map[i][N + k] = response[0][i].magnitude();
                map[N + i][N + k] = response[1][i].magnitude();
            }
        }
        let forces = self.forces(system);
        for l in 0..positions {
            let largest = self.q[l]
                .iter()
                .chain(&self.start.0)
                .fold(0.0, |largest: f64, q| largest.max(q.magnitude()));
            let q = [largest; N];
            let terms = system.terms(&self.q[l].map(signed));
            for k in 0..N {
                let argument: f64 = (0..N)
                    .map(|m| derivatives[l][k][m].magnitude() * q[m])
                    .sum();
                let mut of_forces = zeros(positions);
                of_forces[l][k] = T::from_f64(argument + terms[k]);
                let response = self.response(&factors, &derivatives, &zeros(count), &of_forces);
                for i in 0..N {
                    noise[i] += response[0][i].magnitude();
                    noise[N + i] += response[1][i].magnitude();
                }
            }
        }
        for j in 0..count {
            for k in 0..N {
                let sum: f64 = self.a_tilde[j]
                    .iter()
                    .zip(&forces)
                    .map(|(a, f)| (*a * f[k]).magnitude())
                    .sum();
                let mut of_momenta = zeros(count);
                of_momenta[j][k] = T::from_f64(sum + largest(&self.start.1));
                let response =
                    self.response(&factors, &derivatives, &of_momenta, &zeros(positions));
                for i in 0..N {
                    noise[i] += response[0][i].magnitude();
                    noise[N + i] += response[1][i].magnitude();
                }
            }
        }
        for k in 0..N {
            noise[k] += largest(&q.data.0[0]) + largest(&self.start.0);
            noise[N + k] += largest(&p.data.0[0]) + largest(&self.start.1);
        }
        noise
            .iter_mut()
            .for_each(|noise| *noise *= f64::EPSILON / 2.0);
        Sensitivity { map, noise }
    }
}

fn largest<T: Scalar>(values: &[T]) -> f64 {
    values
        .iter()
        .fold(0.0, |largest: f64, x| largest.max(x.magnitude()))
}

/// A nearby double, accurate enough for magnitudes.
fn signed<T: Scalar>(x: T) -> f64 {
    let size = x.magnitude();
    if (x - T::from_f64(size)).magnitude() <= size {
        size
    } else {
        -size
    }
}

/// Gaussian elimination with partial pivoting.
struct Factors<T> {
    rows: Vec<Vec<T>>,
    order: Vec<usize>,
}

impl<T: Scalar> Factors<T> {
    fn of(mut rows: Vec<Vec<T>>) -> Option<Self> {
        let n = rows.len();
        let mut order: Vec<usize> = (0..n).collect();
        for k in 0..n {
            let size = |row: usize| rows[row][k].magnitude();
            let pivot = (k..n).fold(
                k,
                |best, row| if size(row) > size(best) { row } else { best },
            );
            if !(size(pivot) > 0.0 && size(pivot).is_finite()) {
                return None;
            }
            rows.swap(k, pivot);
            order.swap(k, pivot);
            let inverse = rows[k][k].recip();
            for i in k + 1..n {
                if rows[i][k].is_zero() {
                    continue;
                }
                let factor = rows[i][k] * inverse;
                rows[i][k] = factor;
                for j in k + 1..n {
                    let product = factor * rows[k][j];
                    rows[i][j] -= product;
                }
            }
        }
        Some(Self { rows, order })
    }

    fn solve(&self, right: &mut [T]) {
        let n = right.len();
        let mut x: Vec<T> = self.order.iter().map(|&i| right[i]).collect();
        for i in 0..n {
            for j in 0..i {
                let product = self.rows[i][j] * x[j];
                x[i] -= product;
            }
        }
        for i in (0..n).rev() {
            for j in i + 1..n {
                let product = self.rows[i][j] * x[j];
                x[i] -= product;
            }
            x[i] /= self.rows[i][i];
        }
        right.copy_from_slice(&x);
    }
}
