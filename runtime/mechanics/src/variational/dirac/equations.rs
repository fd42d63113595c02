//! The matrix of Newton's iteration, and its residual.

use num_traits::Float;

use super::failure::Failure;
use super::step::Equations;
use super::{DiracRule, DiracSystem};
use crate::variational;
use crate::variational::stages::StageOfStep;
use symplectic_core::inside::Part;

/// A point of a quadrature rule.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub(super) weight: f64,
    /// From 0 at the start of the step to 1 at its end.
    pub(super) place: f64,
}

impl DiracRule {
    pub(super) const fn points(self) -> &'static [Point] {
        match self {
            Self::Midpoint => &[Point {
                weight: 1.0,
                place: 0.5,
            }],
            Self::Trapezoid => &[
                Point {
                    weight: 0.5,
                    place: 0.0,
                },
                Point {
                    weight: 0.5,
                    place: 1.0,
                },
            ],
            Self::AtStart => &[Point {
                weight: 1.0,
                place: 0.0,
            }],
            Self::AtEnd => &[Point {
                weight: 1.0,
                place: 1.0,
            }],
        }
    }
}

impl Point {
    /// Its time in a part of a step.
    fn time(self, part: Part) -> f64 {
        match self.place {
            1.0 => part.end,
            place => part.time + place * part.size,
        }
    }
}

impl<L: DiracSystem> Equations<L> {
    /// The points of the rule as stages of the last step taken, a part that began at `q0`.
    pub(super) fn stages(
        &mut self,
        system: &L,
        part: Part,
        q0: &[f64],
    ) -> impl Iterator<Item = StageOfStep<L::Vector<f64>>> {
        self.rule.points().iter().map(move |point| {
            self.go(q0, point.place * part.size);
            let u = &self.unknowns[..q0.len()];
            let weight = point.weight * part.size;
            (self.derivatives).stage(system, (weight, point.time(part)), &self.q, u)
        })
    }

    /// Evaluates the matrix of Newton's iteration and its right-hand side.
    pub(super) fn assemble(
        &mut self,
        system: &L,
        part: Part,
        q0: &[f64],
        p0: &[f64],
    ) -> Result<(), Failure> {
        let n = q0.len();
        self.linear.clear();
        for (k, p) in p0.iter().enumerate() {
            self.linear.add_right(k, -p, Float::abs(*p));
        }
        self.go(q0, 0.0);
        self.add_impulse(system, n)?;
        for point in self.rule.points() {
            self.go(q0, point.place * part.size);
            self.add_point(system, part, *point)?;
            self.add_discrete_constraint(system, part.size, *point)?;
        }
        self.look_at(q0, part.size);
        self.add_end(system, part)?;
        self.add_constraint_at_end(system, part.size)
    }

    /// `−w(q0)ᵀλ`.
    fn add_impulse(&mut self, system: &L, n: usize) -> Result<(), Failure> {
        let entries = self.rows.at(system, &self.q).ok_or(Failure::MovingRows)?;
        for entry in entries {
            let column = 2 * n + entry.constraint;
            self.linear.add(entry.component, column, -entry.value);
            let term = entry.value * self.unknowns[column];
            self.linear
                .add_right(entry.component, term, Float::abs(term));
        }
        Ok(())
    }

    /// The contribution of a point of the rule to `D1 Ld` and `−D2 Ld`.
    fn add_point(
        &mut self,
        system: &L,
        part: Part,
        point @ Point { weight, place }: Point,
    ) -> Result<(), Failure> {
        let n = self.q.len();
        let time = point.time(part);
        let u = &self.unknowns[..n];
        self.derivatives.second(system, time, &self.q, u);
        let d = &self.derivatives;
        // The value of L does not matter here, and need not be finite.
        if let resized @ variational::failure::Failure::Resized { .. } = d.failure(None) {
            return Err(Failure::Evaluation(resized));
        }
        let way = place * part.size;
        // The weights of `L_q + f` in the two derivatives.
        let impulses = [weight * (part.size - way), weight * way];
        for k in 0..n {
            let (mut rate_size, mut momentum_size) =
                (Float::abs(d.rate[k]), Float::abs(d.momentum[k]));
            for (j, (&q, &u)) in self.q.iter().zip(u).enumerate() {
                let entry = k * n + j;
                let (rate, momentum) = (d.rate_by_velocity[entry], d.momentum_by_velocity[entry]);
                let by_position = (d.rate_by_position[entry], d.momentum_by_position[entry]);
                for (row, impulse, sign) in [(k, impulses[0], 1.0), (n + k, impulses[1], -1.0)] {
                    self.linear.add(row, j, sign * impulse * rate);
                    self.linear
                        .add(row, j, sign * impulse * way * by_position.0);
                    self.linear.add(row, j, -weight * momentum);
                    self.linear.add(row, j, -weight * way * by_position.1);
                }
                rate_size += Float::abs(rate * u) + Float::abs(by_position.0 * q);
                momentum_size += Float::abs(momentum * u) + Float::abs(by_position.1 * q);
            }
            let size = |impulse: f64| Float::abs(impulse) * rate_size + weight * momentum_size;
            let momentum = weight * d.momentum[k];
            let [start, end] = impulses.map(|impulse| impulse * d.rate[k]);
            (self.linear).add_right(k, momentum - start, size(impulses[0]));
            (self.linear).add_right(n + k, momentum + end, size(impulses[1]));
        }
        Ok(())
    }

    /// The contribution of a point of the rule to `w_d·u`.
    fn add_discrete_constraint(
        &mut self,
        system: &L,
        size: f64,
        Point { weight, place }: Point,
    ) -> Result<(), Failure> {
        let n = self.q.len();
        let rows = 2 * n;
        let u = &self.unknowns[..n];
        for entry in self.rows.at(system, &self.q).ok_or(Failure::MovingRows)? {
            let (row, column) = (rows + entry.constraint, entry.component);
            self.linear.add(row, column, weight * entry.value);
            let term = weight * entry.value * u[column];
            self.linear.add_right(row, -term, Float::abs(term));
        }
        for column in 0..n {
            let entries = self.rows.along(system, &self.q, column);
            for entry in entries.ok_or(Failure::MovingRows)? {
                let term = weight * place * size * entry.slope * u[entry.component];
                self.linear.add(rows + entry.constraint, column, term);
            }
        }
        Ok(())
    }

    /// L_v(q1, v1).
    fn add_end(&mut self, system: &L, part: Part) -> Result<(), Failure> {
        let n = self.q.len();
        self.derivatives
            .second(system, part.end, &self.q, &self.velocity);
        let d = &self.derivatives;
        if let resized @ variational::failure::Failure::Resized { .. } = d.failure(None) {
            return Err(Failure::Evaluation(resized));
        }
        for k in 0..n {
            let mut size = Float::abs(d.momentum[k]);
            for j in 0..n {
                let (by_position, by_velocity) = (
                    d.momentum_by_position[k * n + j],
                    d.momentum_by_velocity[k * n + j],
                );
                self.linear.add(n + k, j, by_velocity);
                self.linear.add(n + k, j, part.size * by_position);
                self.linear.add(n + k, n + j, by_velocity);
                size += Float::abs(by_velocity * self.velocity[j])
                    + Float::abs(by_position * self.q[j]);
            }
            self.linear.add_right(n + k, -d.momentum[k], size);
        }
        Ok(())
    }

    /// `−w(q1)ᵀμ` and `w(q1)·v1`.
    fn add_constraint_at_end(&mut self, system: &L, size: f64) -> Result<(), Failure> {
        let (n, m) = (self.q.len(), self.rows.constraints());
        let (rows, multipliers) = (2 * n + m, 2 * n + m);
        let (v, mu) = (&self.velocity, &self.unknowns[multipliers..]);
        for entry in self.rows.at(system, &self.q).ok_or(Failure::MovingRows)? {
            let (a, c, value) = (entry.constraint, entry.component, entry.value);
            self.linear.add(n + c, multipliers + a, -value);
            self.linear
                .add_right(n + c, value * mu[a], Float::abs(value * mu[a]));
            self.linear.add(rows + a, c, value);
            self.linear.add(rows + a, n + c, value);
            self.linear
                .add_right(rows + a, -value * v[c], Float::abs(value * v[c]));
        }
        for column in 0..n {
            let entries = self.rows.along(system, &self.q, column);
            for entry in entries.ok_or(Failure::MovingRows)? {
                let (a, c, slope) = (entry.constraint, entry.component, size * entry.slope);
                self.linear.add(n + c, column, -slope * mu[a]);
                self.linear.add(rows + a, column, slope * v[c]);
            }
        }
        Ok(())
    }
}
