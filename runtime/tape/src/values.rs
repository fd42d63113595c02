//! The numbers that a formula needs in addition to the state: parameters and lengths.

use std::collections::HashMap;

use symplectic_formula::System;
use symplectic_formula::graph::{Base, Index, Loop, LoopId, LoopRange};
use symplectic_formula::syntax::Length;

/// The values of parameters and lengths.
#[derive(Debug, Clone, Default)]
pub struct Values {
    /// The number of coordinates, or of bodies.
    pub bodies: usize,
    /// The values of lengths that the formula leaves open.
    pub lengths: HashMap<Length, usize>,
    /// The rows of each parameter. A number has one row of one column; a one-dimensional array has rows of one column.
    pub parameters: Vec<Vec<Vec<Entry>>>,
    /// The pairs of each parameter that is a list of pairs.
    pub pairs: Vec<Vec<[usize; 2]>>,
}

/// An entry of a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Entry {
    /// The same in all trajectories.
    Number(f64),
    /// The number of a parameter that varies between trajectories.
    Varied(usize),
    /// The number of a parameter that is a further coordinate, without a velocity and a force: it stands after the positions for the force,
    /// and after the momenta for the velocity. Tangent maps then have derivatives by parameters.
    Further(usize),
}

/// The index of each loop being unrolled; for a list of pairs, the number of the pair.
pub(crate) type Indices = HashMap<LoopId, usize>;

impl Values {
    /// For a formula without parameters: the number of coordinates, or of bodies.
    pub fn of_bodies(bodies: usize) -> Self {
        Values {
            bodies,
            ..Values::default()
        }
    }

    /// The number of parameters that are further coordinates.
    pub(crate) fn further(&self) -> usize {
        let entries = self.parameters.iter().flatten().flatten();
        let numbers = entries.filter_map(|entry| match entry {
            Entry::Further(k) => Some(k + 1),
            Entry::Number(_) | Entry::Varied(_) => None,
        });
        numbers.max().unwrap_or(0)
    }

    /// A length, if known.
    pub fn length(&self, system: &System, length: &Length) -> Option<usize> {
        match length {
            Length::Fixed(n) => Some(*n),
            known if *known == system.layout.length() => Some(self.bodies),
            Length::PairsOf(name) => {
                let mut parameters = system.parameters.iter();
                let place = parameters.position(|parameter| parameter.name == *name)?;
                Some(self.pairs.get(place)?.len())
            }
            other => self.lengths.get(other).copied(),
        }
    }

    /// An index; `None` if it does not exist.
    pub(crate) fn index(&self, system: &System, indices: &Indices, index: &Index) -> Option<usize> {
        let base = match &index.base {
            Base::Start => 0,
            Base::End(length) => self.length(system, length)?,
            Base::Loop(id) => *indices.get(id)?,
            Base::Pair(id, slot) => {
                let number = *indices.get(id)?;
                let LoopRange::List(parameter) = system.graph.get_loop(*id).range else {
                    return None;
                };
                let pair = self.pairs.get(parameter)?.get(number)?;
                pair.get(*slot).copied().unwrap_or(number)
            }
        };
        usize::try_from(i64::try_from(base).ok()? + index.offset).ok()
    }

    /// The range of indices of a loop.
    pub(crate) fn range(
        &self,
        system: &System,
        indices: &Indices,
        over: &Loop,
    ) -> Option<std::ops::Range<usize>> {
        match &over.range {
            LoopRange::List(parameter) => Some(0..self.pairs.get(*parameter)?.len()),
            LoopRange::Between(start, end) => {
                let start = self.index(system, indices, start)?;
                // An end before the first body makes the range empty.
                Some(start..self.index(system, indices, end).unwrap_or(0).max(start))
            }
        }
    }
}
