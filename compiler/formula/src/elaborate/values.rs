//! Values with their shapes, names, and errors about them.

use super::{Elaborator, MAX_COMPONENTS, MAX_NODES, Momenta, Value};
use crate::function::ELEMENTARY;
use crate::graph::{Base, Coordinate, Half, Id, Index, Loop, LoopRange, Node};
use crate::parse::{VECTOR_FUNCTIONS, suggestion, unknown_function};
use crate::syntax::{Expression, Kind, Length, Name};
use crate::system::{Layout, Shape};
use symplectic_exact::error::FormulaError;
use symplectic_exact::error::{Error, ErrorKind};

impl Elaborator<'_> {
    /// The error for a name that has a meaning already.
    pub(super) fn taken(&self, name: &Name) -> Error {
        let meaning = self.meaning(&name.text);
        let kind = FormulaError::Taken {
            name: name.text.clone(),
            meaning,
        };
        self.input.error(&name.span, kind.into())
    }

    pub(super) fn error<T>(&self, at: &Expression, kind: impl Into<ErrorKind>) -> Result<T, Error> {
        Err(self.input.error(&at.span, kind.into()))
    }

    pub(super) fn text(&self, at: &Expression) -> String {
        self.input.text[at.span.clone()].to_owned()
    }

    pub(super) fn mismatch<T>(
        &self,
        at: &Expression,
        found: &Value,
        expected: &str,
    ) -> Result<T, Error> {
        let found = format!("`{}`, {}", self.text(at), self.shape(found));
        let expected = expected.to_owned();
        self.error(at, ErrorKind::Type { found, expected })
    }

    pub(super) fn shape(&self, value: &Value) -> String {
        match value {
            Value::Scalar(_) => "a number".to_owned(),
            Value::Vector(parts) => format!("a vector of {}", counted(parts.len(), "component")),
            Value::Matrix(rows) => format!("a matrix of {}", counted(rows.len(), "row")),
            Value::Half(Half::Q) => "the array of all positions".to_owned(),
            Value::Half(Half::P) => "the array of all momenta".to_owned(),
            Value::Half(Half::V) => "the array of all velocities".to_owned(),
            Value::Parameter(k) => format!("the whole parameter `{}`", self.parameters[*k].name),
            Value::Index(_) => "an index".to_owned(),
            Value::Abbreviation(_) => "an abbreviation with arguments".to_owned(),
            Value::Function(_) => "a function".to_owned(),
        }
    }

    pub(super) fn scalar(&mut self, written: &Expression) -> Result<Id, Error> {
        let value = self.value(written)?;
        match self.single(value) {
            Value::Scalar(id) => Ok(id),
            other => self.mismatch(written, &other, "a number"),
        }
    }

    /// A vector of one component, where a number is meant, as this number; other values as they are.
    pub(super) fn single(&mut self, value: Value) -> Value {
        match self.whole(value.clone()) {
            Value::Vector(parts) if parts.len() == 1 => Value::Scalar(parts[0]),
            _ => value,
        }
    }

    pub(super) fn components(&mut self, value: Value, at: &Expression) -> Result<Vec<Id>, Error> {
        match self.whole(value) {
            Value::Vector(parts) => Ok(parts),
            other => self.mismatch(at, &other, "a vector"),
        }
    }

    /// A short array as the vector or the matrix of its entries.
    pub(super) fn whole(&mut self, value: Value) -> Value {
        let fixed = |length: &Length| match length {
            Length::Fixed(n) if *n <= MAX_COMPONENTS => Some(*n),
            _ => None,
        };
        match &value {
            Value::Half(half) => {
                let count = match &self.layout {
                    Layout::Named([names, _]) => Some(names.len()),
                    Layout::Numbered(length, None) => fixed(length),
                    Layout::Numbered(..) => None,
                };
                let Some(count) = count else {
                    return value;
                };
                let entry = |k| Coordinate {
                    half: *half,
                    index: Index::number(k),
                    component: 0,
                };
                Value::Vector(
                    (0..count as i64)
                        .map(|k| self.graph.coordinate(entry(k)))
                        .collect(),
                )
            }
            Value::Parameter(parameter) => {
                let Shape::Array(lengths) = &self.parameters[*parameter].shape else {
                    return value;
                };
                let lengths: Option<Vec<usize>> = lengths.iter().map(fixed).collect();
                let mut entry = |indices: &[usize]| {
                    let indices = indices.iter().map(|&k| Index::number(k as i64)).collect();
                    self.graph.parameter(*parameter, indices)
                };
                match lengths.as_deref() {
                    Some([n]) => Value::Vector((0..*n).map(|k| entry(&[k])).collect()),
                    Some([n, m]) => {
                        let rows = (0..*n).map(|i| (0..*m).map(|j| entry(&[i, j])).collect());
                        Value::Matrix(rows.collect())
                    }
                    _ => value,
                }
            }
            // A length as a number: a sum of ones.
            Value::Index(Index {
                base: Base::End(length),
                offset: 0,
            }) => {
                let end = Index::of(Base::End(length.clone()));
                let range = LoopRange::Between(Index::number(0), end);
                let one = self.graph.integer(1);
                match self.graph.add_loop(Loop {
                    range,
                    depth: self.loops.len(),
                }) {
                    Some(over) => Value::Scalar(self.graph.total(over, one)),
                    None => value,
                }
            }
            _ => value,
        }
    }

    pub(super) fn value(&mut self, written: &Expression) -> Result<Value, Error> {
        if self.graph.size() > MAX_NODES {
            let kind = ErrorKind::ExpressionSize {
                what: "its number of different parts",
                size: self.graph.size(),
                limit: MAX_NODES,
            };
            return self.error(written, kind);
        }
        let value = self.value_of(written)?;
        if let Value::Scalar(id) = value {
            self.check_finite(id, written)?;
            self.keep_power(id, &written.span);
            self.places
                .entry(id)
                .or_insert_with(|| written.span.clone());
        }
        Ok(value)
    }

    pub(super) fn value_of(&mut self, written: &Expression) -> Result<Value, Error> {
        Ok(match &written.kind {
            Kind::Number(number) => Value::Scalar(self.graph.constant(number.clone())),
            Kind::Name(name) => self.name(name, written)?,
            Kind::Sum(terms) => self.sum(terms)?,
            Kind::Product(factors) => self.product(factors)?,
            Kind::Power(base, exponent) => Value::Scalar(self.power(base, exponent)?),
            Kind::Entry(array, indices) => self.entry(array, indices)?,
            Kind::Call(function, arguments) => self.call(function, arguments, written)?,
            Kind::Bars(inner) => {
                let value = self.value(inner)?;
                match self.whole(value) {
                    Value::Scalar(id) => Value::Scalar(self.graph.absolute(id)),
                    Value::Vector(parts) => {
                        let square = self.dot(&parts, &parts);
                        Value::Scalar(self.root(square, inner)?)
                    }
                    other => return self.mismatch(inner, &other, "a vector"),
                }
            }
            Kind::List(items) => {
                let parts: Result<Vec<Id>, Error> =
                    items.iter().map(|item| self.scalar(item)).collect();
                Value::Vector(parts?)
            }
            Kind::Total(over, body) => self.total(over, body, written)?,
        })
    }

    pub(super) fn is_momentum(&self, value: &Value) -> bool {
        match value {
            Value::Half(half) => *half == Half::P,
            Value::Scalar(id) => matches!(
                self.graph.node(*id),
                Node::Coordinate(coordinate) if coordinate.half == Half::P
            ),
            _ => false,
        }
    }

    /// The error for a momentum, if there are none here.
    fn no_momentum(&self, name: &str) -> Option<FormulaError> {
        let name = name.to_owned();
        match self.momenta {
            Momenta::Known => None,
            Momenta::NotInLagrangian => Some(FormulaError::MomentumInLagrangian { name }),
            Momenta::NotInForce => {
                let position = match &self.layout {
                    Layout::Named([_, momenta]) => momenta.iter().position(|known| *known == name),
                    Layout::Numbered(..) => None,
                };
                let velocity = position.and_then(|k| self.velocities.get(k));
                let velocity = velocity.map_or("v", String::as_str).to_owned();
                Some(FormulaError::MomentumInForce { name, velocity })
            }
        }
    }

    pub(super) fn name(&mut self, name: &str, at: &Expression) -> Result<Value, Error> {
        if let Some(value) = self.names.get(name) {
            if self.is_momentum(value)
                && let Some(kind) = self.no_momentum(name)
            {
                return self.error(at, kind);
            }
            return Ok(value.clone());
        }
        match name {
            "pi" | "π" => return Ok(Value::Scalar(self.graph.pi())),
            "t" => return Ok(Value::Scalar(self.graph.time())),
            _ => {}
        }
        let visible = self
            .names
            .iter()
            .filter(|(_, value)| !(self.momenta != Momenta::Known && self.is_momentum(value)));
        let mut known: Vec<&str> = visible
            .map(|(name, _)| name.as_str())
            .chain(["pi", "t"])
            .collect();
        known.sort_unstable();
        let after = &self.input.text[at.span.end..];
        let arguments = after.starts_with('(');
        let functions = ELEMENTARY.iter().map(|(function, _)| *function);
        let functions = functions.chain(["sqrt"]).chain(VECTOR_FUNCTIONS);
        let candidates: Vec<&str> = known.iter().copied().chain(functions).collect();
        let meant = suggestion(name, &candidates);
        let mut abbreviations = self.definition.abbreviations.iter();
        let is_abbreviation = abbreviations.any(|abbreviation| abbreviation.name.text == name);
        if !is_abbreviation && arguments && meant.is_none_or(|meant| !known.contains(&meant)) {
            let name = Name {
                text: name.to_owned(),
                span: at.span.clone(),
            };
            return Err(unknown_function(self.input, &name));
        }
        let meant = match after.trim_start().starts_with('^') && name == "e" {
            true => Some("exp(x)"),
            false => meant,
        };
        let mut known = known.join(", ");
        if matches!(self.layout, Layout::Numbered(..)) && matches!(name, "N" | "n" | "len") {
            known.push_str(&format!(
                "; for the length of `q`: `sum(i: …)` goes over all coordinates, `sum(i: 1)` is their number, and `{}<N>` with `q: [N]` names it",
                self.definition.name.text
            ));
        }
        let known = match meant {
            _ if is_abbreviation => {
                format!("{known}; its definition, `let {name}`, has to come first")
            }
            Some(meant) => format!("{known}; did you mean `{meant}`?"),
            None => known,
        };
        self.error(
            at,
            ErrorKind::Unknown {
                what: "name",
                name: name.to_owned(),
                known,
            },
        )
    }
}

/// `1 component`, `2 components`
pub(super) fn counted(count: usize, what: &str) -> String {
    let ending = if count == 1 { "" } else { "s" };
    format!("{count} {what}{ending}")
}
