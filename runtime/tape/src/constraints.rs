//! The constraints of a formula.

use symplectic::Scalar;
use symplectic::constraints::{ConstraintName, Gradients};
use symplectic::nalgebra::DVector;
use symplectic_formula::System;
use symplectic_formula::derivative::{Scatter, gradient};
use symplectic_formula::graph::{Coordinate, Half, Index, integer};

use crate::interpreter::copy_to;
use crate::tape::{At, Parameters, Tape};
use crate::unroll::{Refusal, Unrolled};
use crate::values::Values;

/// The constraints of a system.
#[derive(Debug)]
pub struct Constraints {
    /// Whether they are functions of positions; otherwise they are linear in the velocities.
    are_holonomic: bool,
    /// φ(q); for non-holonomic constraints without results.
    values: Tape,
    /// The entries of ∂φ/∂q, or of w, in the order of their places.
    entries: Tape,
    /// Constraint and component of each entry.
    places: Vec<(usize, usize)>,
    names: Vec<ConstraintName>,
}

impl Constraints {
    /// Differentiates the constraints of a system and unrolls their loops; `None` if it has none.
    pub(crate) fn new(system: &mut System, values: &Values) -> Result<Option<Self>, Refusal> {
        if !system.is_constrained() {
            return Ok(None);
        }
        let are_holonomic = !system.constraints.is_empty();
        let (all, half) = match are_holonomic {
            true => (system.constraints.clone(), Half::Q),
            false => (system.nonholonomic.clone(), Half::V),
        };
        // φ as if it were the derivative with respect to some coordinate, and its derivatives.
        let parts: Vec<Vec<(Scatter, Vec<Scatter>)>> = all
            .iter()
            .map(|constraint| {
                let loops: Vec<_> = constraint.over.into_iter().collect();
                let derivatives = |&value| {
                    let graph = &mut system.graph;
                    let entries = gradient(graph, value, &loops, integer(1), half);
                    let target = Coordinate {
                        half: Half::Q,
                        index: Index::number(0),
                        component: 0,
                    };
                    let loops = loops.clone();
                    let value = Scatter {
                        loops,
                        target,
                        value,
                    };
                    (value, entries)
                };
                constraint.parts.iter().map(derivatives).collect()
            })
            .collect();
        if system.graph.overflowed() {
            return Err(Refusal::TooLong);
        }
        let derivatives = parts.iter().flatten().flat_map(|(_, entries)| entries);
        let mut roots: Vec<_> = derivatives.map(|entry| entry.value).collect();
        if are_holonomic {
            roots.extend(parts.iter().flatten().map(|(value, _)| value.value));
        }
        let mut unrolled = Unrolled::new(system, values, &roots, None)?;
        let (mut found, mut entries) = (Vec::new(), Vec::new());
        let (mut places, mut names): (Vec<(usize, usize)>, _) = (Vec::new(), Vec::new());
        for (constraint, parts) in all.iter().zip(&parts) {
            let (first, count) = (names.len(), parts.len());
            // The range of the indices of the family.
            let range = match constraint.over {
                Some(over) => {
                    let over = system.graph.get_loop(over);
                    let range = values.range(system, &Default::default(), over);
                    range.ok_or(Refusal::Outside)?
                }
                None => 0..1,
            };
            let name: &'static str = constraint.name.clone().leak();
            names.extend((0..count * range.len()).map(|k| ConstraintName {
                name,
                member: match (constraint.over, count) {
                    (None, 1) => None,
                    (None, _) => Some(k),
                    (Some(_), _) => Some(k / count),
                },
            }));
            let number = |unrolled: &Unrolled<'_>, part: usize| {
                let index = constraint.over.map(|over| unrolled.index(over));
                first + (index.unwrap_or(range.start) - range.start) * count + part
            };
            for (part, (value, derivatives)) in parts.iter().enumerate() {
                if are_holonomic {
                    unrolled.scatter(value, &mut |unrolled, _, value| {
                        found.push((number(unrolled, part), value));
                        Ok(())
                    })?;
                }
                for entry in derivatives {
                    unrolled.scatter(entry, &mut |unrolled, component, value| {
                        places.push((number(unrolled, part), component));
                        entries.push(value);
                        Ok(())
                    })?;
                }
            }
        }
        found.sort_by_key(|(number, _)| *number);
        let found: Vec<_> = found.into_iter().map(|(_, value)| value).collect();
        Ok(Some(Constraints {
            are_holonomic,
            values: unrolled.tape(&found)?,
            entries: unrolled.tape(&entries)?,
            places,
            names,
        }))
    }

    /// Whether they are functions of positions; otherwise they are linear in the velocities.
    pub fn are_holonomic(&self) -> bool {
        self.are_holonomic
    }

    /// Their number.
    pub fn count(&self) -> usize {
        self.names.len()
    }

    /// The names of all constraints.
    pub fn names(&self) -> &[ConstraintName] {
        &self.names
    }

    /// φ(q)
    pub(crate) fn values<T: Scalar>(&self, parameters: &Parameters, q: &[T], out: &mut [T]) {
        let write = |to: usize, values: &[T]| copy_to(out, to, values);
        self.values.run(at(parameters, q), write);
    }

    /// Calls `set` with constraint, component and value of each entry of ∂φ/∂q or w.
    fn each<T: Scalar>(
        &self,
        parameters: &Parameters,
        q: &[T],
        mut set: impl FnMut(usize, usize, T),
    ) {
        let write = |to: usize, values: &[T]| {
            for (&(constraint, component), value) in self.places.iter().skip(to).zip(values) {
                set(constraint, component, *value);
            }
        };
        self.entries.run(at(parameters, q), write);
    }

    /// Sets ∂φ/∂q or w.
    pub(crate) fn set<T: Scalar>(
        &self,
        parameters: &Parameters,
        q: &DVector<T>,
        out: &mut Gradients<T>,
    ) {
        let set = |constraint, component, value| out.set(constraint, component, value);
        self.each(parameters, q.as_slice(), set);
    }

    /// The largest |φ|, or the largest |w·q'|.
    pub fn error(&self, parameters: &Parameters, q: &[f64], velocity: &[f64]) -> f64 {
        let mut all = vec![0.0; self.count()];
        match self.are_holonomic {
            true => self.values(parameters, q, &mut all),
            false => self.each(parameters, q, |constraint, component, value| {
                all[constraint] += value * velocity[component];
            }),
        }
        let larger = |a: f64, b: f64| if a.is_nan() || a > b { a } else { b };
        all.into_iter().map(f64::abs).fold(0.0, larger)
    }
}

fn at<'a, T: Scalar>(parameters: &'a Parameters, q: &'a [T]) -> At<'a, T> {
    At {
        parameters,
        time: T::from_f64(0.0),
        q,
        p: &[],
    }
}
