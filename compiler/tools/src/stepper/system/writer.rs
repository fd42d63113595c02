//! Statements in loops, in the notation of a language.

use std::collections::HashMap;

use num_traits::Zero;

use super::super::languages::formulas::Formulas;
use super::super::template::fill;
use super::names::Names;
use symplectic_exact::rounding::to_f64;
use symplectic_formula::display::index_letter;
use symplectic_formula::function::Elementary;
use symplectic_formula::graph::{Base, Coordinate, Half, Index, LoopId, LoopRange};
use symplectic_formula::operations::{Op, Operation, Operations};
use symplectic_formula::statements::{Goal, Statement, statements};
use symplectic_formula::syntax::Length;
use symplectic_formula::{Shape, System};

/// A writer of statements.
pub(super) struct Writer<'a> {
    pub system: &'a System,
    pub names: &'a Names,
    pub notation: &'a Formulas,
    pub operations: &'a Operations<'a>,
    /// Leaves the function where a pair has an index out of range.
    pub outside: String,
}

/// How tightly an expression is bound.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Strength {
    Choice,
    Sum,
    Product,
    Sign,
    Atom,
}

type Written = (String, Strength);

/// The numbers of the values that have names.
type Known = HashMap<Op, usize>;

impl Writer<'_> {
    /// The statements that reach some goals, and `use_value` for each.
    pub fn write(&self, goals: &[Goal], use_value: &dyn Fn(usize, &str) -> String) -> String {
        let statements = statements(self.operations, 0, goals);
        let mut text = String::new();
        self.block(&mut text, 0, &Known::new(), &statements, use_value);
        text
    }

    /// A line at a depth of nesting in a function.
    pub fn line(&self, text: &mut String, depth: usize, line: &str) {
        let spaces = self.notation.indent + 4 * depth;
        text.push_str(&format!("{:spaces$}{line}\n", ""));
    }

    fn block(
        &self,
        text: &mut String,
        depth: usize,
        known: &Known,
        statements: &[Statement],
        use_value: &dyn Fn(usize, &str) -> String,
    ) {
        let mut known = known.clone();
        let name = |text: &mut String, number: usize, value: &str| {
            let values = [("name", &name(number)[..]), ("value", value)];
            self.line(text, depth, &fill(self.notation.name, &values));
        };
        for statement in statements {
            match statement {
                Statement::Name(op, number) => {
                    name(text, *number, &self.written(&known, *op).0);
                    known.insert(*op, *number);
                }
                Statement::Turns(turns) => {
                    for (op, number) in turns.iter().flat_map(|turn| turn.values).flatten() {
                        name(text, number, &self.written(&known, op).0);
                        known.insert(op, number);
                    }
                }
                Statement::Zero(op, number) => {
                    known.insert(*op, *number);
                    let name = self.written(&known, *op).0;
                    let line = fill(self.notation.zero, &[("name", &name)]);
                    self.line(text, depth, &line);
                }
                Statement::Add(total, value) => {
                    let [target, value] = [total, value].map(|&op| self.written(&known, op).0);
                    let values = [("target", &target[..]), ("value", &value)];
                    self.line(text, depth, &fill(self.notation.increase, &values));
                }
                Statement::Loop(over, inner) => {
                    self.begin(text, depth, *over);
                    self.block(text, depth + 1, &known, inner, use_value);
                    if !self.notation.end.is_empty() {
                        self.line(text, depth, self.notation.end);
                    }
                }
                Statement::Reached(place, value) => {
                    let value = self.written(&known, *value).0;
                    self.line(text, depth, &use_value(*place, &value));
                }
            }
        }
    }

    /// The beginning of a loop.
    fn begin(&self, text: &mut String, depth: usize, over: LoopId) {
        match &self.system.graph.get_loop(over).range {
            LoopRange::Between(start, end) => {
                self.line(text, depth, &self.range(over, start, end));
            }
            LoopRange::List(parameter) => {
                let name = &self.names.parameters[*parameter];
                let list = fill(self.notation.member, &[("name", name)]);
                let pairs = Length::PairsOf(self.system.parameters[*parameter].name.clone());
                let [bodies, count] = [self.system.layout.length(), pairs]
                    .map(|length| self.names.length(&length, self.notation));
                let [first, second] = [0, 1].map(|slot| pair_name(over, slot));
                let values = [
                    ("index", &index_letter(over)[..]),
                    ("first", &first),
                    ("second", &second),
                    ("list", &list),
                    ("count", &count),
                    ("bodies", &bodies),
                    ("outside", &self.outside),
                ];
                for (number, line) in self.notation.pairs.iter().enumerate() {
                    self.line(text, depth + number.min(1), &fill(line, &values));
                }
            }
        }
    }

    fn range(&self, over: LoopId, start: &Index, end: &Index) -> String {
        let letter = index_letter(over);
        let limit = Index::of(end.base.clone());
        let before = Index {
            base: Base::Loop(over),
            offset: (-end.offset).max(0),
        };
        let limit = match end.offset {
            ..=0 => limit,
            _ => end.clone(),
        };
        fill(
            self.notation.range,
            &[
                ("index", &letter),
                ("start", &self.index(start, 1, 0)),
                ("end", &self.index(end, 1, 0)),
                ("last", &self.index(end, 1, -1)),
                ("before", &self.index(&before, 1, 0)),
                ("limit", &self.index(&limit, 1, 0)),
            ],
        )
    }

    /// `scale·index + shift`
    fn index(&self, index: &Index, scale: i64, shift: i64) -> String {
        let constant = index.offset.saturating_mul(scale).saturating_add(shift);
        let base = match &index.base {
            Base::Start => return constant.to_string(),
            Base::End(length) => self.names.length(length, self.notation),
            Base::Pair(id, slot @ (0 | 1)) => pair_name(*id, *slot),
            Base::Loop(id) | Base::Pair(id, _) => index_letter(*id),
        };
        let base = match scale {
            1 => base,
            _ => format!("{scale} * {base}"),
        };
        match constant {
            0 => base,
            1.. => format!("{base} + {constant}"),
            _ => format!("{base} - {}", constant.unsigned_abs()),
        }
    }

    /// An entry of a vector.
    pub fn entry(&self, vector: &str, coordinate: &Coordinate) -> String {
        let components = self.system.layout.components() as i64;
        let shift = coordinate.component as i64 + self.notation.first;
        format!(
            "{vector}[{}]",
            self.index(&coordinate.index, components, shift)
        )
    }

    fn parameter(&self, parameter: usize, indices: &[Index]) -> String {
        let name = &self.names.parameters[parameter];
        let member = fill(self.notation.member, &[("name", name)]);
        let all: Vec<String> = indices
            .iter()
            .map(|index| self.index(index, 1, self.notation.first))
            .collect();
        match (
            indices,
            all.as_slice(),
            &self.system.parameters[parameter].shape,
        ) {
            ([_], [i], _) => format!("{member}[{i}]"),
            ([row, _], [i, j], Shape::Array(lengths)) => {
                let columns = lengths
                    .last()
                    .map(|length| self.names.length(length, self.notation));
                let columns = columns.unwrap_or_default();
                let is_fixed = lengths
                    .iter()
                    .all(|length| matches!(length, Length::Fixed(_)));
                let row = match row.offset {
                    0 => i.clone(),
                    _ => format!("({i})"),
                };
                let pattern = self.notation.matrix[usize::from(is_fixed)];
                let values = [
                    ("member", &member[..]),
                    ("i", i),
                    ("row", &row),
                    ("columns", &columns),
                    ("j", j),
                ];
                fill(pattern, &values)
            }
            _ => member,
        }
    }

    /// The expression for an operation, from the values that have names.
    fn written(&self, known: &Known, op: Op) -> Written {
        match known.get(&op) {
            Some(&number) => (name(number), Strength::Atom),
            None => self.expression(known, op),
        }
    }

    fn expression(&self, known: &Known, op: Op) -> Written {
        let at_least = |op: Op, least: Strength| {
            let (text, strength) = self.written(known, op);
            if strength >= least {
                text
            } else {
                format!("({text})")
            }
        };
        let binary = |a: Op, sign: &str, b: Op, left: Strength, right: Strength| {
            let (a, b) = (at_least(a, left), at_least(b, right));
            (format!("{a} {sign} {b}"), left)
        };
        let call = |function: &str, a: Op| {
            let argument = self.written(known, a).0;
            (format!("{function}({argument})"), Strength::Atom)
        };
        let functions = &self.notation.functions;
        match self.operations.get(op).clone() {
            Operation::Constant(value) => {
                let number = to_f64(&value);
                let text = match number.is_finite() {
                    true => format!("{number:?}"),
                    false => self.notation.infinity.to_owned(),
                };
                let is_negative = value < Zero::zero();
                (
                    text,
                    if is_negative {
                        Strength::Sign
                    } else {
                        Strength::Atom
                    },
                )
            }
            Operation::Pi => (format!("{:?}", std::f64::consts::PI), Strength::Atom),
            Operation::Time => ("t".to_owned(), Strength::Atom),
            Operation::Parameter(parameter, indices) => {
                (self.parameter(parameter, &indices), Strength::Atom)
            }
            Operation::Coordinate(coordinate) => {
                let half = match coordinate.half {
                    Half::Q => "q",
                    Half::P | Half::V => "p",
                };
                (self.entry(half, &coordinate), Strength::Atom)
            }
            Operation::Negative(a) => (
                format!("-{}", at_least(a, Strength::Product)),
                Strength::Sign,
            ),
            Operation::Add(a, b) => binary(a, "+", b, Strength::Sum, Strength::Product),
            Operation::Subtract(a, b) => binary(a, "-", b, Strength::Sum, Strength::Product),
            Operation::Multiply(a, b) => match *self.operations.get(b) {
                Operation::Reciprocal(divisor) if self.operations.is_division(b) => {
                    binary(a, "/", divisor, Strength::Product, Strength::Sign)
                }
                _ => binary(a, "*", b, Strength::Product, Strength::Sign),
            },
            Operation::Reciprocal(a) => {
                let a = at_least(a, Strength::Sign);
                (format!("1.0 / {a}"), Strength::Product)
            }
            Operation::Root(a) => call(functions.root, a),
            Operation::Absolute(a) => call(functions.absolute, a),
            Operation::OrZero(a, b) => {
                let [a, b] = [a, b].map(|op| self.written(known, op).0);
                let values = [("a", &a[..]), ("b", &b)];
                (fill(functions.or_zero, &values), Strength::Choice)
            }
            Operation::Elementary(Elementary::Ln, a) => call(functions.logarithm, a),
            Operation::Elementary(function, a) => {
                call(&format!("{}{}", functions.prefix, function.name()), a)
            }
            Operation::Atan2(a, b) => {
                let [y, x] = [a, b].map(|op| self.written(known, op).0);
                (format!("{}({y}, {x})", functions.angle), Strength::Atom)
            }
            // Functions of the user are refused, and a total has a name.
            Operation::User(..) | Operation::Total(..) => (String::new(), Strength::Atom),
        }
    }
}

/// The first or the second index of a pair.
fn pair_name(over: LoopId, slot: usize) -> String {
    format!("{}_{slot}", index_letter(over))
}

fn name(number: usize) -> String {
    format!("x{number}")
}
