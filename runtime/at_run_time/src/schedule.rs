//! From coefficients to the order of computation.

use alloc::sync::Arc;
use alloc::vec;
use alloc::vec::Vec;
use core::array;

use symplectic_core::inside::rows::{CoupledRows, Evaluation, HalfRows, Kind, MAX_EVALUATIONS};
use symplectic_core::inside::two_sum;

use crate::coefficients::RunTimeCoefficients;
use crate::decoupling::decouple;

/// Order of computation of a step.
#[derive(Clone, Debug, PartialEq)]
pub enum Schedule {
    /// Drifts and kicks, each applied to the state in full.
    Splitting(Arc<Splitting>),
    /// Stages that depend on each other.
    Coupled(Arc<CoupledRows>),
}

/// The evaluations of a splitting in their order.
#[derive(Clone, Debug, PartialEq)]
pub struct Splitting {
    pub evaluations: Vec<Evaluation>,
    /// Whether the first evaluation is the last one of the previous step.
    pub carries: bool,
}

/// Distinct evaluations of both halves with their matrices.
struct Graph {
    forces: Vec<Evaluation>,
    velocities: Vec<Evaluation>,
    /// For each force the row of its position, with an entry for each velocity: sums of `a_ij`, without `h`.
    positions: Vec<Vec<f64>>,
    /// For each velocity the row of its momentum, with an entry for each force.
    momenta: Vec<Vec<f64>>,
}

impl Schedule {
    /// The schedule for separable Hamiltonians, or for general ones.
    pub fn new(coefficients: &RunTimeCoefficients, separable: bool) -> Self {
        let graph = Graph::new(coefficients, separable).relative();
        let order = separable.then(|| graph.order()).flatten();
        order.map_or_else(
            || {
                let a = scaled(&graph.positions, &graph.velocities);
                let a_tilde = scaled(&graph.momenta, &graph.forces);
                Self::Coupled(Arc::new(CoupledRows {
                    positions: half(&graph.positions, &graph.forces),
                    momenta: half(&graph.momenta, &graph.velocities),
                    decoupling: decouple(&a, &a_tilde, separable),
                }))
            },
            |splitting| Self::Splitting(Arc::new(splitting)),
        )
    }
}

impl Graph {
    /// For a separable Hamiltonian evaluations at equal stage values are merged. Evaluations that the result does not need are left out.
    fn new(coefficients: &RunTimeCoefficients, separable: bool) -> Self {
        let RunTimeCoefficients {
            a,
            a_tilde,
            b,
            b_tilde,
            c,
            c_tilde,
            gradient: _,
        } = coefficients;
        let stages = b.len();
        let groups = |matrix: &[Vec<f64>]| -> Vec<Vec<usize>> {
            let mut groups: Vec<Vec<usize>> = Vec::new();
            for (i, row) in matrix.iter().enumerate() {
                match groups.iter_mut().find(|group| matrix[group[0]] == *row) {
                    Some(group) if separable => group.push(i),
                    _ => groups.push(vec![i]),
                }
            }
            groups
        };
        let [used_forces, used_velocities] = used(coefficients, separable);
        let keep = |groups: Vec<Vec<usize>>, used: &[bool]| -> Vec<Vec<usize>> {
            let kept = groups.into_iter();
            kept.filter(|group| group.iter().any(|&i| used[i]))
                .collect()
        };
        let forces = keep(groups(a), &used_forces);
        let velocities = keep(groups(a_tilde), &used_velocities);
        debug_assert!(forces.len() <= stages && velocities.len() <= stages);
        let matrix = |rows: &[Vec<usize>], columns: &[Vec<usize>], matrix: &[Vec<f64>]| {
            let entry = |row: &[f64], group: &[usize]| sum(group.iter().map(|&j| row[j]));
            let row = |group: &Vec<usize>| {
                let row = &matrix[group[0]];
                columns.iter().map(|column| entry(row, column)).collect()
            };
            rows.iter().map(row).collect()
        };
        let evaluations = |kind, groups: &[Vec<usize>], weights: &[f64], times: &[f64]| {
            let evaluation = |group: &Vec<usize>| {
                let weight = sum(group.iter().map(|&i| weights[i]));
                Evaluation {
                    kind,
                    time: times[group[0]],
                    factor: if weight == 0.0 { 1.0 } else { weight },
                    counts: weight != 0.0,
                }
            };
            groups.iter().map(evaluation).collect()
        };
        Self {
            positions: matrix(&forces, &velocities, a),
            momenta: matrix(&velocities, &forces, a_tilde),
            forces: evaluations(Kind::Force, &forces, b_tilde, c),
            velocities: evaluations(Kind::Velocity, &velocities, b, c_tilde),
        }
    }

    /// Replaces the coefficients of evaluations by those of increments, rounded so that `μ̃_ij + μ_ji = 1`.
    fn relative(mut self) -> Self {
        for (f, force) in self.forces.iter().enumerate() {
            for (v, velocity) in self.velocities.iter().enumerate() {
                let (mu, mu_tilde) = (&mut self.positions[f][v], &mut self.momenta[v][f]);
                *mu /= velocity.factor;
                *mu_tilde /= force.factor;
                if force.counts && velocity.counts {
                    complement(mu, mu_tilde);
                }
            }
        }
        self
    }

    /// The order of a splitting; `None` if evaluations depend on each other, or enter later stages with part of their weight.
    fn order(&self) -> Option<Splitting> {
        let all = (self.forces.iter()).chain(&self.velocities);
        if !all.clone().all(|evaluation| evaluation.counts) {
            return None;
        }
        let (mut forces, mut velocities) = (
            vec![false; self.forces.len()],
            vec![false; self.velocities.len()],
        );
        let is_ready = |row: &[f64], made: &[bool]| {
            let mut entries = row.iter().zip(made);
            entries.all(|(&entry, &made)| entry == if made { 1.0 } else { 0.0 })
        };
        let mut evaluations = Vec::new();
        while evaluations.len() < forces.len() + velocities.len() {
            let velocity = (0..velocities.len())
                .find(|&v| !velocities[v] && is_ready(&self.momenta[v], &forces));
            let force = (0..forces.len())
                .find(|&f| !forces[f] && is_ready(&self.positions[f], &velocities));
            evaluations.push(if let Some(f) = force {
                forces[f] = true;
                self.forces[f]
            } else {
                let v = velocity?;
                velocities[v] = true;
                self.velocities[v]
            });
        }
        let (first, last) = (evaluations.first()?, evaluations.last()?);
        let carries = evaluations.len() > 1
            && first.kind == last.kind
            && first.time == 0.0
            && last.time == 1.0;
        Some(Splitting {
            carries,
            evaluations,
        })
    }
}

/// Which forces and which velocities the result of a step needs, by stage.
fn used(coefficients: &RunTimeCoefficients, separable: bool) -> [Vec<bool>; 2] {
    let RunTimeCoefficients {
        a,
        a_tilde,
        b,
        b_tilde,
        ..
    } = coefficients;
    let counts = |weights: &[f64]| weights.iter().map(|&weight| weight != 0.0).collect();
    let (mut forces, mut velocities): (Vec<bool>, Vec<bool>) = (counts(b_tilde), counts(b));
    loop {
        let before = (forces.clone(), velocities.clone());
        let stages = b.len();
        for i in 0..stages {
            let (position, momentum) = match separable {
                true => (forces[i], velocities[i]),
                false => (forces[i] || velocities[i], forces[i] || velocities[i]),
            };
            for j in 0..stages {
                velocities[j] |= position && a[i][j] != 0.0;
                forces[j] |= momentum && a_tilde[i][j] != 0.0;
            }
        }
        if !separable {
            // A stage of a general Hamiltonian has both.
            for (force, velocity) in forces.iter_mut().zip(&mut velocities) {
                *force |= *velocity;
                *velocity = *force;
            }
        }
        if (&before.0, &before.1) == (&forces, &velocities) {
            return [forces, velocities];
        }
    }
}

/// The sum, rounded once except for the rounding of its compensation.
fn sum(values: impl Iterator<Item = f64>) -> f64 {
    let (high, low) = values.fold((0.0, 0.0), |(high, low), value| {
        let (high, rest) = two_sum(high, value);
        (high, low + rest)
    });
    high + low
}

/// Makes two numbers that sum to 1 up to rounding do so exactly: the smaller one becomes the complement of the larger one.
fn complement(mu: &mut f64, mu_tilde: &mut f64) {
    if *mu == 0.0 {
        *mu_tilde = 1.0;
    } else if *mu_tilde == 0.0 {
        *mu = 1.0;
    } else if *mu >= *mu_tilde {
        *mu_tilde = 1.0 - *mu;
    } else {
        *mu = 1.0 - *mu_tilde;
    }
}

/// The coefficients of evaluations from those of their increments.
fn scaled(matrix: &[Vec<f64>], evaluations: &[Evaluation]) -> Vec<Vec<f64>> {
    let row = |row: &Vec<f64>| {
        let pairs = row.iter().zip(evaluations);
        pairs.map(|(entry, other)| entry * other.factor).collect()
    };
    matrix.iter().map(row).collect()
}

fn half(matrix: &[Vec<f64>], evaluations: &[Evaluation]) -> HalfRows {
    let row = |row: &Vec<f64>| {
        let entries = row.iter().copied().enumerate();
        entries.filter(|(_, entry)| *entry != 0.0).collect()
    };
    HalfRows {
        rows: matrix.iter().map(row).collect(),
        columns: columns(matrix),
        matrix: matrix.to_vec(),
        counting: (0..evaluations.len())
            .filter(|&i| evaluations[i].counts)
            .collect(),
        extrapolation: extrapolation(evaluations),
        evaluations: evaluations.to_vec(),
    }
}

/// The columns of a matrix that has four to eight rows and no zeros, as in Gauss methods; otherwise none. Fewer stages are summed faster one by
/// one.
fn columns(matrix: &[Vec<f64>]) -> Vec<[f64; 8]> {
    let is_full = matrix.iter().flatten().all(|entry| *entry != 0.0);
    if !is_full || !(4..=8).contains(&matrix.len()) {
        return Vec::new();
    }
    let last = matrix.len() - 1;
    let column = |j: usize| array::from_fn(|lane| matrix[lane.min(last)][j]);
    (0..matrix[0].len()).map(column).collect()
}

/// The matrix that extrapolates increments: the polynomial through the evaluations of a step, at the times of the next step.
fn extrapolation(evaluations: &[Evaluation]) -> Vec<Vec<f64>> {
    let times: Vec<f64> = evaluations
        .iter()
        .map(|evaluation| evaluation.time)
        .collect();
    let are_apart = |i: usize| times[..i].iter().all(|time| *time != times[i]);
    if times.len() > MAX_EVALUATIONS || !(0..times.len()).all(are_apart) {
        return Vec::new();
    }
    let lagrange = |j: usize, x: f64| {
        let others = (0..times.len()).filter(|&k| k != j);
        others.fold(1.0, |product, k| {
            product * ((x - times[k]) / (times[j] - times[k]))
        })
    };
    let row = |i: usize| {
        let entry = |j: usize| {
            lagrange(j, 1.0 + times[i]) * (evaluations[i].factor / evaluations[j].factor)
        };
        (0..times.len()).map(entry).collect()
    };
    (0..times.len()).map(row).collect()
}

#[cfg(test)]
mod tests {
    use symplectic_core::Method;

    use super::*;

    symplectic::tableau! {
        Verlet { basis: polynomial(2), nodes: lobatto(2) }
        Gauss3 { basis: polynomial(3), nodes: gauss(3) }
        ForestRuth { base: forest-ruth-1990 }
    }

    fn coefficients<M: Method>(_method: M) -> RunTimeCoefficients {
        M::COEFFICIENTS.into()
    }

    fn splitting<M: Method>(method: M) -> Arc<Splitting> {
        match Schedule::new(&coefficients(method), true) {
            Schedule::Splitting(splitting) => splitting,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn verlet_is_a_kick_a_drift_and_a_kick() {
        let found = splitting(Verlet);
        let kinds: Vec<_> = found
            .evaluations
            .iter()
            .map(|e| (e.kind, e.factor))
            .collect();
        // The two stage momenta are equal, so they are merged.
        let expected = [
            (Kind::Force, 0.5),
            (Kind::Velocity, 1.0),
            (Kind::Force, 0.5),
        ];
        assert_eq!(kinds, expected);
        assert!(found.carries);
    }

    #[test]
    fn forest_ruth_has_four_kicks_and_three_drifts() {
        let found = splitting(ForestRuth);
        let found = &found.evaluations;
        for (kind, count) in [(Kind::Force, 4), (Kind::Velocity, 3)] {
            let factors = found.iter().filter(|e| e.kind == kind).map(|e| e.factor);
            assert_eq!(factors.clone().count(), count);
            assert!((factors.sum::<f64>() - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn rounded_methods_are_symplectic_exactly() {
        for separable in [true, false] {
            let graph = Graph::new(&coefficients(Gauss3), separable).relative();
            for (f, row) in graph.positions.iter().enumerate() {
                for (v, mu) in row.iter().enumerate() {
                    // The sum is exact because the larger number is between 1/2 and 2.
                    assert_eq!(mu + graph.momenta[v][f], 1.0);
                }
            }
        }
    }

    #[test]
    fn the_extrapolation_of_a_quadratic_force_is_exact() {
        let Schedule::Coupled(found) = Schedule::new(&coefficients(Gauss3), false) else {
            panic!("Gauss is implicit");
        };
        let half = &found.positions;
        let force = |time: f64| 1.0 - 3.0 * time + 2.0 * time * time;
        for (i, row) in half.extrapolation.iter().enumerate() {
            let at = |k: usize, shift: f64| {
                let evaluation = &half.evaluations[k];
                evaluation.factor * force(evaluation.time + shift)
            };
            let found: f64 = row.iter().enumerate().map(|(j, e)| e * at(j, 0.0)).sum();
            assert!((found - at(i, 1.0)).abs() < 1e-13, "{found}");
        }
    }
}
