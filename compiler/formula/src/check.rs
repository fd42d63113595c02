//! The checks that a definition requests: properties of the system, and conserved functions.

use num_traits::One;

use super::derivative::{Scatter, directional, gradient};
use super::evaluate::{Evaluator, Point};
use super::graph::{Base, Coordinate, Graph, Half, Id, Index, MAX_LOOPS, Node, Number, integer};
use super::structure::{Kinetic, Structure, goes_over_all};
use super::syntax::{Length, Name};
use super::system::{Invariant, Layout, Shape, System};
use symplectic_exact::error::FormulaError;
use symplectic_exact::error::{Error, ErrorKind};
use symplectic_exact::input::Input;

/// The properties that can be required.
pub const PROPERTIES: [&str; 5] = [
    "separable",
    "quadratic_kinetic",
    "unit_masses",
    "time_independent",
    "chain",
];

/// A bracket above this, relative to its terms, counts as nonzero.
const ROUNDING: f64 = 1e-8;

impl System {
    /// Checks the properties that the definition requires, and refutes false invariants; `text` is the text of the definition.
    ///
    /// # Errors
    /// A property that does not hold, at the term that violates it; a function that is not conserved.
    pub fn check(&mut self, structure: &Structure, text: &str) -> Result<(), Error> {
        let input = Input {
            name: &self.source.clone(),
            text,
        };
        if self.graph.overflowed() {
            let kind = ErrorKind::ExpressionSize {
                what: "its number of sums in one another",
                size: MAX_LOOPS + 1,
                limit: MAX_LOOPS,
            };
            return Err(kind.into());
        }
        if self.without_hamiltonian().is_some() {
            // If a part of the definition needs H, L was rejected on reading.
            return Ok(());
        }
        if !self.friction.is_empty() {
            self.check_friction(structure, input)?;
        }
        if let (Some(force), false) = (self.force_of_momenta(), self.friction.is_empty()) {
            let kind = FormulaError::Unsupported {
                what: "friction beside a force that depends on momenta".to_owned(),
                instead: "write the friction as a force too",
            };
            let place = self.place_of(force).cloned().unwrap_or(0..0);
            return Err(input.error(&place, kind.into()));
        }
        for name in self.required.clone() {
            self.require(structure, &name, input)?;
        }
        for k in 0..self.invariants.len() {
            let invariant = self.invariants[k].clone();
            self.invariants[k].proved = self.conserved(&invariant, input)?;
        }
        Ok(())
    }

    /// Friction is only for separable systems, and excludes invariants.
    fn check_friction(&self, structure: &Structure, input: Input<'_>) -> Result<(), Error> {
        if let Err(term) = structure.split {
            let place = self.place_of(term);
            let kind = match place {
                Some(_) => FormulaError::Unsupported {
                    what: "friction where H is not separable".to_owned(),
                    instead: "H = T(p) + U(q); this term depends on positions and momenta",
                },
                // H of a Lagrangian is written nowhere.
                None => FormulaError::FrictionAsForce {
                    with: "where H is not T(p) + U(q)",
                    force: {
                        let velocities = self.lagrangian.as_ref().map(|_| &self.velocities[..]);
                        self.layout.drag(velocities)
                    },
                },
            };
            return Err(input.error(place.unwrap_or(&(0..0)), kind.into()));
        }
        if let Some(invariant) = self.invariants.first() {
            let kind = FormulaError::Unsupported {
                what: "an invariant of a system with friction".to_owned(),
                instead: "remove it, because no function is proved to be conserved with friction",
            };
            return Err(input.error(&invariant.span, kind.into()));
        }
        Ok(())
    }

    fn require(&self, structure: &Structure, name: &Name, input: Input<'_>) -> Result<(), Error> {
        let fail = |property: &'static str, reason: String, id: Option<Id>| {
            let place = id.and_then(|id| self.place_of(id));
            let span = place.unwrap_or(&name.span);
            Err(input.error(span, FormulaError::Property { property, reason }.into()))
        };
        let mixed = |property| match structure.split {
            Ok(_) => Ok(()),
            Err(term) => fail(
                property,
                "this term depends on positions and momenta".to_owned(),
                Some(term),
            ),
        };
        match name.text.as_str() {
            "separable" => {
                mixed("separable")?;
                match self.force_of_momenta() {
                    None => Ok(()),
                    Some(force) => fail(
                        "separable",
                        "this force depends on momenta".to_owned(),
                        Some(force),
                    ),
                }
            }
            "quadratic_kinetic" => {
                mixed("of quadratic kinetic energy")?;
                match structure.kinetic {
                    Kinetic::General => fail(
                        "of quadratic kinetic energy",
                        "the second derivatives of T(p) are not constant".to_owned(),
                        None,
                    ),
                    _ => Ok(()),
                }
            }
            "unit_masses" => {
                mixed("of unit masses")?;
                match structure.kinetic {
                    Kinetic::Unit => Ok(()),
                    _ => fail(
                        "of unit masses",
                        "the velocity is not the momentum".to_owned(),
                        None,
                    ),
                }
            }
            "time_independent" => match structure.time_dependent {
                false => Ok(()),
                true => {
                    let applied = self.applied.iter().map(|part| part.value);
                    let time = self
                        .graph
                        .below(applied.chain([self.energy]))
                        .into_iter()
                        .find(|&id| matches!(self.graph.node(id), Node::Time));
                    fail("independent of time", "here is the time".to_owned(), time)
                }
            },
            "chain" => match structure.chain {
                Some(_) => Ok(()),
                None => fail(
                    "a chain",
                    "H is not Σ p_i²/2, a sum over bonds and one over all particles".to_owned(),
                    None,
                ),
            },
            _ => {
                let known = PROPERTIES.join(", ");
                Err(input.error(
                    &name.span,
                    ErrorKind::Unknown {
                        what: "property",
                        name: name.text.clone(),
                        known,
                    },
                ))
            }
        }
    }

    /// Whether a function is proved to be conserved, by a symmetry visible in the formula. Otherwise the bracket is tested at a few states.
    ///
    /// # Errors
    /// [`FormulaError::NotConserved`].
    pub fn conserved(&mut self, invariant: &Invariant, input: Input<'_>) -> Result<bool, Error> {
        let mut proved = true;
        let mut all = vec![("H", self.energy)];
        all.extend(self.constraint_square().map(|square| ("Σφ²", square)));
        for &part in &invariant.parts {
            for &(of, formula) in &all {
                if self.is_symmetry(part, formula) && !(of == "H" && self.is_forced(part)) {
                    continue;
                }
                proved = false;
                for seed in 0..3 {
                    let Some((bracket, size)) = self.bracket(part, formula, seed) else {
                        continue;
                    };
                    if bracket.abs() > ROUNDING * size {
                        let kind = FormulaError::NotConserved {
                            name: invariant.name.clone(),
                            of,
                            bracket: format!("{bracket:.3e}"),
                        };
                        return Err(input.error(&invariant.span, kind.into()));
                    }
                }
            }
        }
        Ok(proved)
    }

    /// Whether H, or `energy` in its place, is visibly invariant along the direction that a function generates.
    fn is_symmetry(&mut self, function: Id, energy: Id) -> bool {
        if self.graph.depends(function).time {
            return false;
        }
        let by_p = gradient(&mut self.graph, function, &[], Number::one(), Half::P);
        let by_q = gradient(&mut self.graph, function, &[], -Number::one(), Half::Q);
        let system = self.clone();
        let mut seen = true;
        let speed = directional(&mut self.graph, energy, None, |graph, coordinate| {
            let parts = if coordinate.half == Half::Q {
                &by_p
            } else {
                &by_q
            };
            let speed = at(&system, graph, parts, coordinate);
            seen &= speed.is_some();
            speed.unwrap_or_else(|| graph.integer(0))
        });
        seen && self.graph.is_zero(speed)
    }

    /// Whether applied forces change a function, as far as the formula shows.
    fn is_forced(&mut self, function: Id) -> bool {
        let system = self.clone();
        let mut seen = true;
        let power = directional(&mut self.graph, function, None, |graph, coordinate| {
            if coordinate.half != Half::P {
                return graph.integer(0);
            }
            let force = at(&system, graph, &system.applied, coordinate);
            seen &= force.is_some();
            force.unwrap_or_else(|| graph.integer(0))
        });
        !(seen && self.graph.is_zero(power))
    }

    /// At a state: `{function, energy}` plus the time derivative, plus the applied forces' term if `energy` is H; and the terms' size.
    fn bracket(&mut self, function: Id, energy: Id, seed: u64) -> Option<(f64, f64)> {
        let mut derivatives = Vec::new();
        for (of, half) in [
            (function, Half::Q),
            (function, Half::P),
            (energy, Half::Q),
            (energy, Half::P),
        ] {
            derivatives.push(gradient(&mut self.graph, of, &[], Number::one(), half));
        }
        let one = self.graph.integer(1);
        let by_time = directional(&mut self.graph, function, Some(one), |graph, _| {
            graph.integer(0)
        });
        let point = self.random_point(seed)?;
        let mut evaluator = Evaluator::new(&self.graph, &point);
        let values: Option<Vec<_>> = derivatives
            .iter()
            .map(|parts| evaluator.sum(parts))
            .collect();
        let [f_q, f_p, mut h_q, h_p] = <[_; 4]>::try_from(values?).ok()?;
        if energy == self.energy {
            for (row, applied) in h_q.iter_mut().zip(evaluator.sum(&self.applied)?) {
                let pairs = row.iter_mut().zip(applied);
                pairs.for_each(|(slope, force)| *slope -= force);
            }
        }
        let mut sum = evaluator.value(by_time)?;
        let mut size = sum.abs();
        for (i, row) in f_q.iter().enumerate() {
            for k in 0..row.len() {
                let terms = [f_q[i][k] * h_p[i][k], -f_p[i][k] * h_q[i][k]];
                sum += terms[0] + terms[1];
                size += terms[0].abs() + terms[1].abs();
            }
        }
        sum.is_finite().then_some((sum, size))
    }

    /// A pseudo-random state and parameters; the same for the same seed.
    pub fn random_point(&self, seed: u64) -> Option<Point<f64>> {
        let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ 0x5851_F42D_4C95_7F2D;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            0.25 + (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        let length = |length: &Length| match length {
            Length::Fixed(n) => *n,
            Length::Generic(_) | Length::Runtime => 3.max(self.least),
            Length::PairsOf(_) => 2,
        };
        let count = length(&self.layout.length());
        if count > 1000 {
            return None;
        }
        let components = self.layout.components();
        let mut vector = || {
            (0..count)
                .map(|_| (0..components).map(|_| next()).collect())
                .collect()
        };
        let halves = [vector(), vector()];
        let parameters = self
            .parameters
            .iter()
            .map(|parameter| match &parameter.shape {
                // Independent of the default value.
                Shape::Number(_) => vec![vec![next()]],
                Shape::Pairs => Vec::new(),
                Shape::Array(lengths) => {
                    let columns = lengths.get(1).map_or(1, length);
                    (0..length(&lengths[0]))
                        .map(|_| (0..columns).map(|_| next()).collect())
                        .collect()
                }
            });
        let parameters = parameters.collect();
        let pairs = self
            .parameters
            .iter()
            .map(|parameter| match parameter.shape {
                Shape::Pairs if count > 2 => vec![[0, 1], [2, 1]],
                Shape::Pairs => vec![[0, count - 1]; 2],
                _ => Vec::new(),
            });
        let pairs = pairs.collect();
        Some(Point {
            time: next(),
            halves,
            parameters,
            pairs,
        })
    }
}

/// The derivative with respect to a coordinate, from the parts of a derivative; `None` if the parts do not show it.
pub(super) fn at(
    system: &System,
    graph: &mut Graph,
    parts: &[Scatter],
    coordinate: &Coordinate,
) -> Option<Id> {
    let mut terms = Vec::new();
    for part in parts
        .iter()
        .filter(|part| part.target.component == coordinate.component)
    {
        let single =
            matches!(system.layout, Layout::Named(_)) || part.target.index.base == Base::Start;
        match part.loops.as_slice() {
            [] if part.target.index == coordinate.index => terms.push(part.value),
            [] if single && coordinate.index.base == Base::Start => {}
            [over]
                if goes_over_all(system, *over)
                    && part.target.index == Index::of(Base::Loop(*over)) =>
            {
                let inner = graph.below([part.value]);
                let nested = inner.iter().any(|&id| {
                    matches!(graph.node(id), Node::Total(..)) && graph.depends(id).changes_in(*over)
                });
                if nested {
                    return None;
                }
                terms.push(graph.with_index(part.value, *over, &coordinate.index));
            }
            _ => return None,
        }
    }
    let terms: Vec<_> = terms.into_iter().map(|term| (integer(1), term)).collect();
    Some(graph.sum(terms))
}
