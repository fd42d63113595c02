//! The numbers that a formula needs beside the state: parameters, and how many bodies there are.

use std::collections::HashMap;

use symplectic_compiler::formula::System;
use symplectic_compiler::formula::graph::{Base, Index, Loop, LoopId, LoopRange};
use symplectic_compiler::formula::syntax::Length;

/// The values of parameters and lengths.
#[derive(Debug, Clone, Default)]
pub(super) struct Values {
    /// How many coordinates, or bodies, there are.
    pub(super) bodies: usize,
    /// The values of lengths that the formula leaves open.
    pub(super) lengths: HashMap<Length, usize>,
    /// Each parameter by rows; a number is one row of one column, and an array in one dimension has rows of one column.
    pub(super) parameters: Vec<Vec<Vec<f64>>>,
    /// The pairs of parameters that are lists.
    pub(super) pairs: Vec<Vec<[usize; 2]>>,
}

/// The loops that are unrolled, with their indices; of a list it is the number of the pair.
pub(super) type Indices = HashMap<LoopId, usize>;

impl Values {
    /// A length, where it is known.
    pub(super) fn length(&self, system: &System, length: &Length) -> Option<usize> {
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

    /// An index; `None` where it does not exist.
    pub(super) fn index(&self, system: &System, indices: &Indices, index: &Index) -> Option<usize> {
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

    /// The indices that a loop goes through.
    pub(super) fn range(
        &self,
        system: &System,
        indices: &Indices,
        over: &Loop,
    ) -> Option<std::ops::Range<usize>> {
        match &over.range {
            LoopRange::List(parameter) => Some(0..self.pairs.get(*parameter)?.len()),
            LoopRange::Between(start, end) => {
                let start = self.index(system, indices, start)?;
                // Before the first body there is none.
                Some(start..self.index(system, indices, end).unwrap_or(0).max(start))
            }
        }
    }
}
