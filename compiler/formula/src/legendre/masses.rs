//! The mass matrix M and the shift A of the momenta, `p = ∂L/∂v = M v + A`.

use num_traits::One;

use crate::derivative::{Scatter, gradient};
use crate::graph::{Base, Coordinate, Graph, Half, Id, Index, LoopId, Number};
use crate::rewrite::{Unroll, at_rest};
use crate::structure::goes_over_all;
use crate::syntax::Length;
use crate::system::System;
use crate::trigonometry::shortened;

/// The largest number of velocities that are examined one by one.
const MAX_VELOCITIES: usize = 64;

/// The largest number of coupled velocities.
const MAX_COUPLED: usize = 16;

/// The mass matrix: of all velocities, or of the velocities of each body of a sum.
pub(super) struct Masses {
    /// The loop over all bodies, if there is one.
    pub over: Option<LoopId>,
    /// The velocities.
    pub velocities: Vec<Coordinate>,
    /// Whether each velocity is in L.
    pub appears: Vec<bool>,
    /// A
    pub shift: Vec<Id>,
    /// M
    pub matrix: Vec<Vec<Id>>,
    /// Whether M consists of numbers.
    pub are_numbers: bool,
    /// Whether entries of M are nonzero.
    coupled: Vec<Vec<bool>>,
}

impl Masses {
    /// The masses of a Lagrangian; `None` if velocities are coupled in an unsupported way.
    pub fn of(system: &mut System, formula: Id) -> Option<Self> {
        let parts = momenta(&mut system.graph, formula);
        if let Some(bodies) = bodies(system, &parts) {
            return Some(bodies);
        }
        let Length::Fixed(count) = system.layout.length() else {
            return None;
        };
        let components = system.layout.components();
        if count * components > MAX_VELOCITIES {
            return None;
        }
        let single = |parts: &[Scatter]| {
            let alone =
                |part: &Scatter| part.loops.is_empty() && part.target.index.base == Base::Start;
            parts.iter().all(alone)
        };
        let parts = match single(&parts) {
            true => parts,
            false => {
                let written = Unroll::default().run(&mut system.graph, formula)?;
                momenta(&mut system.graph, written)
            }
        };
        if !single(&parts) {
            return None;
        }
        let velocities = (0..count * components).map(|k| Coordinate {
            half: Half::V,
            index: Index::number((k / components) as i64),
            component: k % components,
        });
        Masses::from(&mut system.graph, &parts, velocities.collect(), None)
    }

    /// The masses from the momenta, which are all in one loop or all outside loops.
    fn from(
        graph: &mut Graph,
        parts: &[Scatter],
        velocities: Vec<Coordinate>,
        over: Option<LoopId>,
    ) -> Option<Self> {
        let loops: Vec<LoopId> = over.into_iter().collect();
        let zero = graph.integer(0);
        let count = velocities.len();
        let place = |target: &Coordinate| velocities.iter().position(|known| known == target);
        let mut momenta = vec![Vec::new(); count];
        for part in parts {
            // Sums in the loop of a body belong to its momentum.
            let inner = part.loops[loops.len()..].iter().rev();
            let value = inner.fold(part.value, |value, &inner| graph.total(inner, value));
            momenta[place(&part.target)?].push((Number::one(), value));
        }
        let appears = momenta.iter().map(|terms| !terms.is_empty()).collect();
        let (mut shift, mut matrix) = (Vec::new(), vec![vec![zero; count]; count]);
        for (k, terms) in momenta.into_iter().enumerate() {
            let momentum = graph.sum(terms);
            shift.push(at_rest(graph, momentum));
            let mut row = vec![Vec::new(); count];
            for second in gradient(graph, momentum, &loops, Number::one(), Half::V) {
                if second.loops != loops {
                    return None;
                }
                row[place(&second.target)?].push((Number::one(), second.value));
            }
            for (l, terms) in row.into_iter().enumerate().skip(k) {
                let entry = graph.sum(terms);
                let entry = shortened(graph, entry);
                (matrix[k][l], matrix[l][k]) = (entry, entry);
            }
        }
        let rows = matrix.iter();
        let coupled = rows.map(|row| row.iter().map(|&entry| entry != zero).collect());
        let masses = Masses {
            over,
            velocities,
            appears,
            shift,
            are_numbers: matrix
                .iter()
                .flatten()
                .all(|&entry| graph.value(entry).is_some()),
            coupled: coupled.collect(),
            matrix,
        };
        let blocks = masses.blocks();
        let large = |block: &Vec<usize>| block.len() > MAX_COUPLED && !masses.is_diagonal(block);
        (!blocks.iter().any(large)).then_some(masses)
    }

    /// The velocities in groups: those that M couples, and uncoupled ones with the same mass.
    pub fn blocks(&self) -> Vec<Vec<usize>> {
        let mut blocks: Vec<Vec<usize>> = Vec::new();
        let mut seen = vec![false; self.velocities.len()];
        for k in 0..seen.len() {
            if std::mem::replace(&mut seen[k], true) {
                continue;
            }
            let mut block = vec![k];
            let mut next = 0;
            while let Some(&row) = block.get(next) {
                next += 1;
                for (other, seen) in seen.iter_mut().enumerate() {
                    if self.coupled[row][other] && !std::mem::replace(seen, true) {
                        block.push(other);
                    }
                }
            }
            block.sort_unstable();
            let mass = |block: &[usize]| self.matrix[block[0]][block[0]];
            let alike = blocks.iter_mut().find(|known| {
                block.len() == 1 && self.is_diagonal(known) && mass(known) == mass(&block)
            });
            match alike {
                Some(known) => known.extend(block),
                None => blocks.push(block),
            }
        }
        blocks
    }

    /// Whether the velocities of a group are not coupled.
    pub fn is_diagonal(&self, block: &[usize]) -> bool {
        let mut rows = block.iter();
        rows.all(|&k| block.iter().all(|&l| k == l || !self.coupled[k][l]))
    }
}

fn momenta(graph: &mut Graph, formula: Id) -> Vec<Scatter> {
    gradient(graph, formula, &[], Number::one(), Half::V)
}

/// The masses of each body, if L is a sum over all bodies.
fn bodies(system: &mut System, parts: &[Scatter]) -> Option<Masses> {
    let over = *parts.first()?.loops.first()?;
    let own = Index::of(Base::Loop(over));
    let each = |part: &Scatter| part.loops.first() == Some(&over) && part.target.index == own;
    if !goes_over_all(system, over) || !parts.iter().all(each) {
        return None;
    }
    let velocities = (0..system.layout.components()).map(|component| Coordinate {
        half: Half::V,
        index: own.clone(),
        component,
    });
    Masses::from(&mut system.graph, parts, velocities.collect(), Some(over))
}
