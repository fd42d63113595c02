//! The equations of motion, complete: with applied forces, friction, the forces of constraints, and derivatives that are zero.
//!
//! ```text
//! q' = ∂H/∂p,    p' = −∂H/∂q + f − γp − (∂φ/∂q)ᵀλ − wᵀλ,    φ(q) = 0,    w(q) q' = 0
//! ```

use num_traits::One;

use super::derivative::{Scatter, gradient};
use super::display::Notation;
use super::graph::{Base, Coordinate, Half, Index, Loop, LoopId, LoopRange, Number, integer};
use super::rewrite::flat;
use super::syntax::Length;
use super::system::{Constraint, Layout, Parameter, Shape, System};

/// Most coordinates whose derivatives are listed one by one if they are zero.
const MAX_LISTED: usize = 64;

impl System {
    /// Hamilton's equations, a line for each part, without the constraints.
    pub fn equations_of_motion(&self, notation: Notation) -> Vec<String> {
        let (system, velocity, force) = self.motion();
        system.equations(&[(Half::Q, velocity), (Half::P, force)], notation)
    }

    /// The derivatives of positions and momenta, in a system whose last parameters are the multipliers.
    fn motion(&self) -> (Self, Vec<Scatter>, Vec<Scatter>) {
        let mut system = self.clone();
        let velocity = gradient(&mut system.graph, self.energy, &[], Number::one(), Half::P);
        let mut force = gradient(&mut system.graph, self.energy, &[], integer(-1), Half::Q);
        system.add_applied(&mut force);
        system.add_friction(&mut force);
        system.add_multipliers(&mut force);
        if !self.is_free() {
            for part in &mut force {
                let terms = flat(&mut system.graph, 1, part.value, &[]);
                part.value = system.graph.sum(terms);
            }
        }
        let velocity = system.completed(velocity);
        let force = system.completed(force);
        (system, velocity, force)
    }

    /// Adds a part to a derivative: to the value of the part with the same loops and coordinate, if there is one.
    pub(super) fn add_part(&mut self, parts: &mut Vec<Scatter>, new: Scatter) {
        let same = |part: &&mut Scatter| part.loops == new.loops && part.target == new.target;
        match parts.iter_mut().find(same) {
            Some(part) => {
                let terms = [part.value, new.value].map(|value| (integer(1), value));
                part.value = self.graph.sum(terms);
            }
            None => parts.push(new),
        }
    }

    /// Adds the applied forces to the parts of `−∂H/∂q`.
    pub fn add_applied(&mut self, force: &mut Vec<Scatter>) {
        for applied in self.applied.clone() {
            self.add_part(force, applied);
        }
    }

    /// Adds `−γp` to the parts of a force.
    fn add_friction(&mut self, force: &mut Vec<Scatter>) {
        let rates = self.friction.clone();
        if rates.is_empty() {
            return;
        }
        let components = self.layout.components();
        let of_each = rates.len() > 1 && components == 1;
        let listed = self.listed(force);
        let over = match of_each || listed.is_some() {
            true => None,
            false => self.over_all(),
        };
        let indices: Vec<Index> = match (over, self.layout.length()) {
            (Some(over), _) => vec![Index::of(Base::Loop(over))],
            (None, Length::Fixed(n)) => (0..n as i64).map(Index::number).collect(),
            (None, _) => Vec::new(),
        };
        for (number, index) in indices.into_iter().enumerate() {
            for component in 0..components {
                let target = Coordinate {
                    half: Half::Q,
                    index: index.clone(),
                    component,
                };
                let momentum = self.graph.coordinate(target.of(Half::P));
                let rate = rates[(number * components + component) % rates.len()];
                let drag = self.graph.multiply(rate, momentum);
                let part = Scatter {
                    loops: over.into_iter().collect(),
                    target,
                    value: self.graph.scale(integer(-1), drag),
                };
                self.add_part(force, part);
            }
        }
    }

    /// Adds the forces of the constraints to the parts of a force, and the multipliers to the parameters.
    fn add_multipliers(&mut self, force: &mut Vec<Scatter>) {
        let names = self.multipliers();
        let holonomic = self.constraints.clone().into_iter();
        let holonomic = holonomic.map(|constraint| (constraint, Half::Q));
        let nonholonomic = self.nonholonomic.clone().into_iter();
        let all = holonomic.chain(nonholonomic.map(|constraint| (constraint, Half::V)));
        for ((constraint, half), name) in all.zip(names) {
            let multiplier = self.parameters.len();
            let shape = Shape::Number(None);
            self.parameters.push(Parameter { name, shape });
            let loops: Vec<LoopId> = constraint.over.into_iter().collect();
            for (k, &value) in constraint.parts.iter().enumerate() {
                let indices = self.multiplier_indices(&constraint, k);
                let factor = self.graph.parameter(multiplier, indices);
                let product = self.graph.multiply(factor, value);
                for mut part in gradient(&mut self.graph, product, &loops, integer(-1), half) {
                    part.target = part.target.of(Half::Q);
                    self.add_part(force, part);
                }
            }
        }
    }

    /// The names of the multipliers of each constraint, holonomic ones first: `λ`, or `λ_name` if there are several constraints. They have
    /// another letter if a name of the system begins with λ.
    fn multipliers(&self) -> Vec<String> {
        let parameters = self.parameters.iter().map(|parameter| &parameter.name);
        let names: Vec<&String> = parameters.chain(self.layout.names()).collect();
        let is_free = |letter: &char| !names.iter().any(|name| name.starts_with(*letter));
        let letters = ['λ', 'μ', 'ν', 'κ', 'ξ', 'ζ'];
        let letter = letters.into_iter().find(is_free).unwrap_or('λ');
        let constraints = self.constraints.iter().chain(&self.nonholonomic);
        match self.constraints.len() + self.nonholonomic.len() {
            1 => vec![letter.to_string()],
            _ => constraints
                .map(|constraint| format!("{letter}_{}", constraint.name))
                .collect(),
        }
    }

    /// The indices of the multiplier of a part of a constraint.
    fn multiplier_indices(&self, constraint: &Constraint, part: usize) -> Vec<Index> {
        let number = constraint.over.map(|over| {
            Index::of(match self.graph.get_loop(over).range {
                LoopRange::Between(..) => Base::Loop(over),
                LoopRange::List(_) => Base::Pair(over, 2),
            })
        });
        let part = (constraint.parts.len() > 1).then(|| Index::number(part as i64));
        number.into_iter().chain(part).collect()
    }

    /// The constraints, a line for each, with its multiplier if there are several.
    pub fn constraint_equations(&self, notation: Notation) -> Vec<String> {
        // Velocities are written as derivatives.
        let mut system = System {
            lagrangian: None,
            ..self.clone()
        };
        let names = self.multipliers();
        let all = self.constraints.iter().chain(&self.nonholonomic);
        let mut lines = Vec::new();
        for (constraint, name) in all.zip(&names) {
            let loops: Vec<LoopId> = constraint.over.into_iter().collect();
            let multiplier = system.parameters.len();
            let (name, shape) = (name.clone(), Shape::Number(None));
            system.parameters.push(Parameter { name, shape });
            for (k, &part) in constraint.parts.iter().enumerate() {
                let indices = self.multiplier_indices(constraint, k);
                let several = names.len() > 1 || !indices.is_empty();
                let multiplier = system.graph.parameter(multiplier, indices);
                let multiplier = several.then(|| system.formula(multiplier, notation));
                let formula = system.formula(part, notation);
                let notes = system.notes(&loops, multiplier, notation);
                lines.push(format!("{formula} = 0{notes}"));
            }
        }
        lines
    }

    /// The number of coordinates, if the parts of a derivative are of single coordinates and all of them can be listed.
    fn listed(&self, parts: &[Scatter]) -> Option<usize> {
        let single =
            |part: &Scatter| part.loops.is_empty() && part.target.index.base == Base::Start;
        match self.layout.length() {
            Length::Fixed(n) if parts.iter().all(single) => {
                let every = parts.len() == n * self.layout.components();
                let is_named = matches!(self.layout, Layout::Named(_));
                (n <= MAX_LISTED || every || is_named).then_some(n)
            }
            _ => None,
        }
    }

    /// The parts of a derivative, with a zero for each coordinate, or each component of all coordinates, that no part sets.
    pub(super) fn completed(&mut self, parts: Vec<Scatter>) -> Vec<Scatter> {
        let (listed, over) = (self.listed(&parts), self.over_all());
        let value = self.graph.integer(0);
        let half = parts.first().map_or(Half::Q, |part| part.target.half);
        let mut all = Vec::new();
        for component in 0..self.layout.components() {
            let zero = |loops: Vec<LoopId>, index: Index| Scatter {
                loops,
                target: Coordinate {
                    half,
                    index,
                    component,
                },
                value,
            };
            let own = || {
                parts
                    .iter()
                    .filter(|part| part.target.component == component)
            };
            match (listed, over) {
                (Some(n), _) => {
                    let indices = (0..n as i64).map(Index::number);
                    let missing =
                        indices.filter(|index| !own().any(|part| part.target.index == *index));
                    all.extend(missing.map(|index| zero(Vec::new(), index)));
                }
                (None, Some(over)) => {
                    let reached = |except, offset| {
                        own().any(|part| self.goes_over(except, &part.target.index, offset))
                    };
                    // By a loop over all, or by both ends of the bonds of a chain.
                    if !(reached(0, 0) || reached(1, 0) && reached(1, 1)) {
                        all.push(zero(vec![over], Index::of(Base::Loop(over))));
                    }
                }
                (None, None) => {}
            }
        }
        all.extend(parts);
        let once = all.len() == self.layout.components();
        if listed.is_some() || once {
            // In the order of the coordinates, not of the formula.
            all.sort_by_key(|part| (part.target.index.offset, part.target.component));
        }
        all
    }

    /// Whether an index is that of a loop plus an offset, and the loop goes over all coordinates except the last ones.
    fn goes_over(&self, except: i64, index: &Index, offset: i64) -> bool {
        let Base::Loop(own) = index.base else {
            return false;
        };
        let range = LoopRange::Between(Index::number(0), self.last(except));
        index.offset == offset && self.graph.get_loop(own).range == range
    }

    /// The end of the coordinates, minus a number.
    fn last(&self, minus: i64) -> Index {
        match self.layout.length() {
            Length::Fixed(n) => Index::number(n as i64 - minus),
            length => Index {
                base: Base::End(length),
                offset: -minus,
            },
        }
    }

    /// A loop over all numbered coordinates.
    pub(super) fn over_all(&mut self) -> Option<LoopId> {
        if let Layout::Named(_) = self.layout {
            return None;
        }
        let range = LoopRange::Between(Index::number(0), self.last(0));
        self.graph.add_loop(Loop { range, depth: 0 })
    }
}
