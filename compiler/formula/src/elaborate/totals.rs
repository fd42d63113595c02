//! Sums over indices, pairs, lists and bonds.

use num_traits::One;

use super::indices::normal;
use super::{Elaborator, Value};
use crate::graph::{Base, Coordinate, Half, Id, Index, Loop, LoopId, LoopRange, Number};
use crate::syntax::{Abbreviation, Ends, Expression, Kind, Name, Over};
use crate::system::{Bonds, Layout, Shape};
use symplectic_exact::error::FormulaError;
use symplectic_exact::error::{Error, ErrorKind};

/// The largest number of distinct sums in a formula.
const MAX_SUMS: usize = 16;
/// The deepest nesting of abbreviations with arguments.
const MAX_NESTED: usize = 64;
/// The largest number of abbreviations with arguments that are written out.
const MAX_EXPANSIONS: usize = 10_000;

impl Elaborator<'_> {
    pub(super) fn new_loop(&mut self, range: LoopRange, at: &Expression) -> Result<LoopId, Error> {
        let depth = self.loops.len();
        match self.graph.add_loop(Loop { range, depth }) {
            // Derivatives need more loops.
            Some(id) if self.graph.count_loops() <= MAX_SUMS => {
                self.loops.push(id);
                Ok(id)
            }
            _ => {
                let kind = ErrorKind::ExpressionSize {
                    what: "its number of different sums",
                    size: MAX_SUMS + 1,
                    limit: MAX_SUMS,
                };
                self.error(at, kind)
            }
        }
    }

    /// Reads an expression in which some names have a local meaning.
    pub(super) fn with<T>(
        &mut self,
        meanings: Vec<(&Name, Value)>,
        read: impl FnOnce(&mut Self) -> Result<T, Error>,
    ) -> Result<T, Error> {
        for (name, value) in &meanings {
            if self.names.contains_key(&name.text) {
                return Err(self.taken(name));
            }
            self.names.insert(name.text.clone(), value.clone());
            self.locals.push(name.text.clone());
        }
        let result = read(self);
        for (name, _) in meanings {
            self.names.remove(&name.text);
            self.locals.pop();
        }
        result
    }

    /// The value of an abbreviation for given arguments.
    pub(super) fn expand(
        &mut self,
        abbreviation: usize,
        arguments: &[Expression],
        at: &Expression,
    ) -> Result<Value, Error> {
        let definition = self.definition;
        let Abbreviation {
            name,
            arguments: names,
            value,
        } = &definition.abbreviations[abbreviation];
        if names.len() != arguments.len() {
            let kind = ErrorKind::Arguments {
                function: name.text.clone(),
                expected: format!("{} arguments", names.len()),
                found: arguments.len().to_string(),
            };
            return self.error(at, kind);
        }
        self.expansions += 1;
        if self.nested >= MAX_NESTED || self.expansions > MAX_EXPANSIONS {
            let kind = ErrorKind::ExpressionSize {
                what: "its number of abbreviations in one another",
                size: self.expansions.max(self.nested),
                limit: if self.nested >= MAX_NESTED {
                    MAX_NESTED
                } else {
                    MAX_EXPANSIONS
                },
            };
            return self.error(at, kind);
        }
        let values = arguments.iter().map(|argument| match self.index(argument) {
            Ok(index) if self.is_index(argument) => Ok(Value::Index(index)),
            _ => self.value(argument),
        });
        let values = values.collect::<Result<Vec<_>, Error>>()?;
        // Only its arguments and the names defined before it are visible.
        let locals = std::mem::take(&mut self.locals);
        let hidden: Vec<_> = locals.iter().map(|name| self.names.remove(name)).collect();
        self.nested += 1;
        let result = self.with(names.iter().zip(values).collect(), |this| this.value(value));
        self.nested -= 1;
        for (name, value) in locals.iter().zip(hidden) {
            self.names.extend(value.map(|value| (name.clone(), value)));
        }
        self.locals = locals;
        result
    }

    /// Whether an argument is an index of a sum or a length, plus a number.
    fn is_index(&self, argument: &Expression) -> bool {
        match &argument.kind {
            Kind::Name(name) => matches!(self.names.get(name), Some(Value::Index(_))),
            Kind::Sum(terms) => terms.iter().any(|(_, term)| self.is_index(term)),
            _ => false,
        }
    }

    pub(super) fn total(
        &mut self,
        over: &Over,
        body: &Expression,
        at: &Expression,
    ) -> Result<Value, Error> {
        if let Over::Bonds(name) = over {
            return self.bonds(name, body, at).map(Value::Scalar);
        }
        let depth = self.loops.len();
        let value = self.under(over, at, |this| this.value(body))?;
        let value = self.whole(value);
        let loops = self.loops.split_off(depth);
        let mut close = |id: Id| {
            loops
                .iter()
                .rev()
                .fold(id, |body, &over| self.graph.total(over, body))
        };
        Ok(match value {
            Value::Scalar(id) => Value::Scalar(close(id)),
            Value::Vector(parts) => Value::Vector(parts.into_iter().map(close).collect()),
            other => return self.mismatch(body, &other, "a number or a vector"),
        })
    }

    /// Reads an expression in the loops of `over`, which stay open.
    pub(super) fn under<T>(
        &mut self,
        over: &Over,
        at: &Expression,
        read: impl FnOnce(&mut Self) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let all = || Index::number(0);
        let count = |this: &Self, index: &Name| match &this.layout {
            Layout::Numbered(length, _) => Ok(normal(Index::of(Base::End(length.clone())))),
            Layout::Named(_) => {
                let kind = FormulaError::Unbounded {
                    index: index.text.clone(),
                };
                Err(this.input.error(&index.span, kind.into()))
            }
        };
        match over {
            Over::Range(name, range) => {
                let (start, end) = match range {
                    Some(written) => {
                        let [start, end] = written;
                        let range = (self.index(start)?, self.index(end)?);
                        // An index must not be negative.
                        let numbers = [(&range.0, start), (&range.1, end)];
                        for (index, written) in numbers {
                            let lowest = match index.base {
                                Base::End(_) if index == numbers[1].0 => Some(0),
                                _ => self.lowest(index),
                            };
                            if lowest.is_none_or(|lowest| lowest < 0) {
                                let kind = ErrorKind::Type {
                                    found: format!("the end `{}` of a range", self.text(written)),
                                    expected: "an index that is never negative".to_owned(),
                                };
                                return self.error(written, kind);
                            }
                        }
                        range
                    }
                    None => (all(), count(self, name)?),
                };
                let id = self.new_loop(LoopRange::Between(start, end), at)?;
                let index = Value::Index(Index::of(Base::Loop(id)));
                self.with(vec![(name, index)], read)
            }
            Over::Pairs(first, second) => {
                let end = count(self, first)?;
                let outer = self.new_loop(LoopRange::Between(all(), end.clone()), at)?;
                let next = Index {
                    base: Base::Loop(outer),
                    offset: 1,
                };
                let inner = self.new_loop(LoopRange::Between(next, end), at)?;
                let index = |id| Value::Index(Index::of(Base::Loop(id)));
                self.with(vec![(first, index(outer)), (second, index(inner))], read)
            }
            Over::List {
                number,
                indices: [first, second],
                list,
            } => {
                let Some(Value::Parameter(parameter)) = self.names.get(&list.text).cloned() else {
                    let kind = ErrorKind::Type {
                        found: format!("`{}`", list.text),
                        expected: "a parameter of pairs: `springs: pairs`".to_owned(),
                    };
                    return Err(self.input.error(&list.span, kind));
                };
                if !matches!(self.parameters[parameter].shape, Shape::Pairs) {
                    return self.mismatch(
                        at,
                        &Value::Parameter(parameter),
                        "a parameter of pairs: `springs: pairs`",
                    );
                }
                let id = self.new_loop(LoopRange::List(parameter), at)?;
                let index = |slot| Value::Index(Index::of(Base::Pair(id, slot)));
                let mut meanings = vec![(first, index(0)), (second, index(1))];
                meanings.extend(number.as_ref().map(|name| (name, index(2))));
                self.with(meanings, read)
            }
            Over::Bonds(_) => {
                let kind = FormulaError::Unsupported {
                    what: "a constraint for every bond".to_owned(),
                    instead: "write a range, such as `i in 1..N`",
                };
                self.error(at, kind)
            }
        }
    }

    /// The sum over the bonds of a chain.
    pub(super) fn bonds(
        &mut self,
        name: &Name,
        body: &Expression,
        at: &Expression,
    ) -> Result<Id, Error> {
        let Some((ends, _)) = self.definition.ends else {
            let kind = FormulaError::Missing {
                part: "ends of the chain",
                example: "bonds: walls;",
            };
            return self.error(at, kind);
        };
        let Layout::Numbered(length, None) = self.layout.clone() else {
            let kind = FormulaError::Unsupported {
                what: "a sum over bonds".to_owned(),
                instead: "a chain has numbered positions, `q: [..], p: [..];` or `q: [N], p: [N];`",
            };
            return self.error(at, kind);
        };
        if !self.loops.is_empty() {
            let kind = FormulaError::Unsupported {
                what: "a sum over bonds in another sum".to_owned(),
                instead: "write it apart",
            };
            return self.error(at, kind);
        }
        let place = |index: Index| Coordinate {
            half: Half::Q,
            index,
            component: 0,
        };
        let last = normal(Index {
            base: Base::End(length),
            offset: -1,
        });
        let potential = |this: &mut Self, stretch: Id| {
            this.with(vec![(name, Value::Scalar(stretch))], |this| {
                this.scalar(body)
            })
        };
        let stretch = self.graph.coordinate(place(STRETCH));
        let bond = potential(self, stretch)?;
        let id = self.new_loop(LoopRange::Between(Index::number(0), last.clone()), at)?;
        let [here, next] = [0, 1].map(|offset| {
            self.graph.coordinate(place(Index {
                base: Base::Loop(id),
                offset,
            }))
        });
        let difference = |this: &mut Self, plus: Id, minus: Id| {
            this.graph
                .sum([(Number::one(), plus), (-Number::one(), minus)])
        };
        let between = difference(self, next, here);
        let inner = potential(self, between)?;
        self.loops.pop();
        let mut terms = vec![(Number::one(), self.graph.total(id, inner))];
        let [first, last] =
            [Index::number(0), last].map(|index| self.graph.coordinate(place(index)));
        self.least = self.least.max(1);
        match ends {
            Ends::Free => {}
            Ends::Walls => {
                let other = self.graph.scale(-Number::one(), last);
                for stretch in [first, other] {
                    terms.push((Number::one(), potential(self, stretch)?));
                }
            }
            Ends::Ring => {
                let stretch = difference(self, first, last);
                terms.push((Number::one(), potential(self, stretch)?));
            }
        }
        let whole = self.graph.sum(terms);
        self.bonds.push(Bonds {
            whole,
            potential: bond,
        });
        Ok(whole)
    }
}

/// The index that represents the stretch of a bond among the positions.
pub const STRETCH: Index = Index {
    base: Base::Start,
    offset: -1,
};
