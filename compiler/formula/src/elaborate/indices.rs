//! Entries of arrays, and checks that their indices are in range.

use num_traits::ToPrimitive;

use super::{Elaborator, MAX_COMPONENTS, Value};
use crate::graph::{Base, Coordinate, Index, LoopRange, Number};
use crate::parse::constant;
use crate::syntax::{Expression, Kind, Length};
use crate::system::{Layout, Shape};
use symplectic_exact::error::FormulaError;
use symplectic_exact::error::{Error, ErrorKind};

impl Elaborator<'_> {
    pub(super) fn entry(
        &mut self,
        array: &Expression,
        indices: &[Expression],
    ) -> Result<Value, Error> {
        let value = self.value(array)?;
        if indices.is_empty() {
            let kind = ErrorKind::Syntax {
                found: "no index".to_owned(),
                expected: "an index in `[…]`".to_owned(),
            };
            return self.error(array, kind);
        }
        let mut value = value;
        let mut rest = indices;
        while let Some((written, others)) = rest.split_first() {
            let index = self.index(written)?;
            let name = self.text(array);
            value = match value {
                Value::Half(half) => {
                    let (length, components) = match &self.layout {
                        Layout::Named([names, _]) => (Length::Fixed(names.len()), None),
                        Layout::Numbered(length, components) => (length.clone(), *components),
                    };
                    self.inside(&index, &length, &name, written)?;
                    if matches!(self.layout, Layout::Named(_)) && index.base != Base::Start {
                        let kind = FormulaError::Unsupported {
                            what: format!("`{}` with an index of a sum", self.text(array)),
                            instead: "number the coordinates, `q: [3], p: [3];`, to sum over them",
                        };
                        return self.error(written, kind);
                    }
                    let mut entry = |component| {
                        self.graph.coordinate(Coordinate {
                            half,
                            index: index.clone(),
                            component,
                        })
                    };
                    match components {
                        None => Value::Scalar(entry(0)),
                        Some(n) => Value::Vector((0..n).map(entry).collect()),
                    }
                }
                Value::Parameter(k) => {
                    let Shape::Array(lengths) = self.parameters[k].shape.clone() else {
                        return self.mismatch(array, &Value::Parameter(k), "an array");
                    };
                    self.inside(&index, &lengths[0], &name, written)?;
                    match (lengths.get(1), others.split_first()) {
                        (None, _) => Value::Scalar(self.graph.parameter(k, vec![index])),
                        (Some(columns), Some((second, left))) => {
                            let column = self.index(second)?;
                            self.inside(&column, columns, &name, second)?;
                            let id = self.graph.parameter(k, vec![index, column]);
                            rest = left;
                            value = Value::Scalar(id);
                            continue;
                        }
                        (Some(Length::Fixed(columns)), None) if *columns <= MAX_COMPONENTS => {
                            let row = (0..*columns as i64).map(|column| {
                                self.graph
                                    .parameter(k, vec![index.clone(), Index::number(column)])
                            });
                            Value::Vector(row.collect())
                        }
                        (Some(_), None) => {
                            return self.mismatch(
                                array,
                                &Value::Parameter(k),
                                "two indices: `A[i, j]`",
                            );
                        }
                    }
                }
                Value::Vector(parts) => match self.number(&index, parts.len(), &name, written)? {
                    Some(k) => Value::Scalar(parts[k]),
                    None => {
                        let kind = FormulaError::Unsupported {
                            what: format!("the index `{}` of a vector", self.text(written)),
                            instead: "use a number",
                        };
                        return self.error(written, kind);
                    }
                },
                Value::Matrix(rows) => match self.number(&index, rows.len(), &name, written)? {
                    Some(k) => Value::Vector(rows[k].clone()),
                    None => return self.mismatch(array, &Value::Matrix(rows), "a number as index"),
                },
                other => return self.mismatch(array, &other, "an array or a vector"),
            };
            rest = others;
        }
        Ok(value)
    }

    /// An index that is a number, checked.
    pub(super) fn number(
        &self,
        index: &Index,
        length: usize,
        name: &str,
        at: &Expression,
    ) -> Result<Option<usize>, Error> {
        if index.base != Base::Start {
            return Ok(None);
        }
        match usize::try_from(index.offset).ok().filter(|&k| k < length) {
            Some(k) => Ok(Some(k)),
            None => self.outside(name, at, &Length::Fixed(length)),
        }
    }

    pub(super) fn outside<T>(
        &self,
        name: &str,
        at: &Expression,
        length: &Length,
    ) -> Result<T, Error> {
        let last = match length {
            Length::Fixed(n) => (n - 1).to_string(),
            Length::Generic(name) => format!("{name} - 1"),
            Length::Runtime => "the last".to_owned(),
            Length::PairsOf(list) => format!("the last of `{list}`"),
        };
        let index = format!("`{}`", self.text(at));
        self.error(
            at,
            FormulaError::IndexRange {
                index,
                name: name.to_owned(),
                last,
            },
        )
    }

    pub(super) fn index(&mut self, written: &Expression) -> Result<Index, Error> {
        let refused = |this: &Self| {
            let kind = ErrorKind::Type {
                found: format!("the index `{}`", this.text(written)),
                expected: "a number or an index of a sum, with a number added or subtracted"
                    .to_owned(),
            };
            this.error(written, kind)
        };
        if let Some(number) = constant(written) {
            return match whole_index(&number) {
                Some(number) => Ok(Index::number(number)),
                None => refused(self),
            };
        }
        match &written.kind {
            Kind::Name(name) => match self.name(name, written)? {
                Value::Index(index) => Ok(index),
                // An argument of an abbreviation, as in `u(0, 1)`.
                Value::Scalar(id) => match self.graph.value(id).map(whole_index) {
                    Some(Some(number)) => Ok(Index::number(number)),
                    _ => refused(self),
                },
                _ => refused(self),
            },
            Kind::Sum(terms) => {
                let mut index = Index::number(0);
                for (minus, term) in terms {
                    let part = self.index(term)?;
                    match (part.base == Base::Start, minus) {
                        (true, _) => {
                            index.offset += if *minus { -part.offset } else { part.offset }
                        }
                        (false, false) if index.base == Base::Start => {
                            index = Index {
                                base: part.base,
                                offset: index.offset + part.offset,
                            };
                        }
                        _ => return refused(self),
                    }
                }
                Ok(normal(index))
            }
            _ => refused(self),
        }
    }

    /// Checks that an index is in range for every length of the system.
    pub(super) fn inside(
        &mut self,
        index: &Index,
        length: &Length,
        name: &str,
        at: &Expression,
    ) -> Result<(), Error> {
        let outside = |this: &Self| this.outside(name, at, length);
        // Whether a pair is in range is only known at run time.
        if let Base::Pair(id, slot) = index.base {
            let LoopRange::List(list) = self.graph.get_loop(id).range else {
                return outside(self);
            };
            let own = *length == Length::PairsOf(self.parameters[list].name.clone());
            let coordinates = self.layout.length() == *length;
            return match (slot, own, coordinates, index.offset) {
                (2, true, _, 0) | (0 | 1, _, true, 0) => Ok(()),
                _ => outside(self),
            };
        }
        let Some(lowest) = self.lowest(index) else {
            return outside(self);
        };
        if lowest < 0 {
            return outside(self);
        }
        let end = self.end(index);
        match (&end.base, length) {
            (Base::Start, Length::Fixed(n)) if end.offset <= *n as i64 => Ok(()),
            (Base::End(known), _) if known == length && end.offset <= 0 => Ok(()),
            // The system needs at least this many coordinates.
            (Base::Start, length)
                if *length == self.layout.length() && !matches!(length, Length::Fixed(_)) =>
            {
                self.least = self.least.max(usize::try_from(end.offset).unwrap_or(0));
                Ok(())
            }
            _ => outside(self),
        }
    }

    /// A lower bound of an index.
    pub(super) fn lowest(&mut self, index: &Index) -> Option<i64> {
        match &index.base {
            Base::Start => Some(index.offset),
            Base::End(Length::Fixed(n)) => Some(*n as i64 + index.offset),
            Base::End(length) => {
                // N − k is a valid index if there are at least k coordinates.
                let own = *length == self.layout.length() && index.offset < 0;
                own.then(|| {
                    self.least = self.least.max(usize::try_from(-index.offset).unwrap_or(0));
                    0
                })
            }
            Base::Loop(id) => {
                let LoopRange::Between(start, _) = self.graph.get_loop(*id).range.clone() else {
                    return None;
                };
                Some(self.lowest(&start)? + index.offset)
            }
            Base::Pair(..) => None,
        }
    }

    /// An upper bound that the index never reaches.
    pub(super) fn end(&self, index: &Index) -> Index {
        let mut end = Index {
            base: index.base.clone(),
            offset: index.offset + 1,
        };
        // The index of a loop is at most the end of its range minus one.
        while let Base::Loop(id) = &end.base
            && let LoopRange::Between(_, after) = &self.graph.get_loop(*id).range
        {
            end = Index {
                base: after.base.clone(),
                offset: after.offset + end.offset - 1,
            };
        }
        normal(end)
    }
}

/// Replaces an end of fixed length by a number.
pub(super) fn normal(index: Index) -> Index {
    match index.base {
        Base::End(Length::Fixed(n)) => Index::number(n as i64 + index.offset),
        _ => index,
    }
}

/// A number as an index, if it is whole and not huge.
fn whole_index(number: &Number) -> Option<i64> {
    let number = number.is_integer().then(|| number.to_i64()).flatten()?;
    (number.abs() <= 1_000_000).then_some(number)
}
