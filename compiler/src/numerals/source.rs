//! The assignments of a text, and the exact values of the requested ones.
//!
//! ```text
//! a = [1//2, big"0.5"]      a1 = convert(T, 0.5)      table->a[0] = SUN_RCONST(1.0) / SUN_RCONST(3.0);
//! static const double a[2] = { 0x1.8p-1, 0.5f };      b = {1/2, Sqrt[2]/2, 1.5`20};
//! ```
//!
//! Everything else in the text is skipped.

use std::cell::{Cell, RefCell};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::rc::Rc;

use super::constructors::name_lists;
use super::fortran::{bounded, data_statements, is_fortran};
use super::parser::{Item, Parser};
use super::tokens::{Kind, Spanned, Token, tokenize};
use super::value::Value;
use crate::error::{Error, ErrorKind};
use crate::expression::{Input, shown};
use crate::library::Notation;
use crate::symbolic::Constant;

/// The largest number of numbers in a list: the matrix of a hundred stages.
pub(super) const MAX_NUMBERS: usize = 10_000;
/// The largest number of numbers that are copied from lists into others.
const MAX_COPIES: usize = 100 * MAX_NUMBERS;

/// The assignments to a name.
#[derive(Default)]
pub struct Assigned {
    /// The place of the name and the first token of the value, if the name is assigned as a whole.
    pub whole: Option<(Range<usize>, usize)>,
    /// The same for elements such as `a[3]`, by index.
    pub elements: BTreeMap<usize, (Range<usize>, usize)>,
    /// The place where the value of the name becomes ambiguous, and the reason.
    pub refused: Option<(Range<usize>, &'static str)>,
}

impl Assigned {
    /// Notes an error that is reported only if the values of this name are requested.
    fn refuse(&mut self, span: Range<usize>, why: &'static str) {
        self.refused.get_or_insert((span, why));
    }
}

/// The largest number of names before a value: `a = b = 1` has two.
const MAX_TOGETHER: usize = 64;

const AGAIN: &str = "has a value already; a file holds one table";
const CHANGED: &str = "is changed later; write the numbers that it has in the end";
const INDEX: &str = "has an index that is not one number; write the list as a whole";
const TOGETHER: &str = "gets its value together with others; give each name its own";

/// The left side of an assignment.
struct Target {
    name: String,
    /// The index in brackets.
    index: Option<usize>,
    /// The number of brackets.
    brackets: usize,
    /// The first token of the value.
    value: usize,
    /// Whether the name is followed by its type.
    annotated: bool,
}

/// A text with its assignments.
pub struct Source<'a> {
    pub(super) input: Input<'a>,
    pub(super) notation: Notation,
    /// Whether the text is Fortran.
    pub fortran: bool,
    /// Lists of Fortran with an explicit lower bound.
    pub bounded: BTreeSet<String>,
    tokens: Vec<Spanned>,
    /// The bracket depth of each token.
    depths: Vec<usize>,
    /// The assignments.
    pub names: BTreeMap<String, Assigned>,
    /// The number of computed values. It is bounded, because names may refer to each other many times.
    computed: Cell<usize>,
    /// The number of numbers copied from lists.
    copied: Cell<usize>,
    /// The lists computed so far.
    lists: RefCell<BTreeMap<String, Rc<Vec<Value>>>>,
}

impl<'a> Source<'a> {
    /// Finds the assignments.
    pub fn scan(input: Input<'a>, notation: Notation) -> Result<Self, Error> {
        let mut source = Source::empty(input, notation);
        source.fortran = is_fortran(input.text, notation);
        source.tokens = tokenize(input, 0..input.text.len(), notation, Kind::File)?;
        if source.fortran {
            source.bounded = bounded(&source.tokens);
            data_statements(&mut source.tokens);
        } else if notation == Notation::C {
            name_lists(&mut source.tokens);
        }
        // For each open bracket, whether it is inside parentheses or opens them.
        let mut open: Vec<bool> = Vec::new();
        let mut arguments = Vec::new();
        for token in &source.tokens {
            if let Token::Symbol(')' | ']' | '}') = token.token {
                open.pop();
            }
            let inside = open.last() == Some(&true);
            source.depths.push(open.len());
            arguments.push(inside);
            if let Token::Symbol(bracket @ ('(' | '[' | '{')) = token.token {
                open.push(inside || bracket == '(');
            }
        }
        let (mut annotated, mut named) = (0, Vec::new());
        for (at, is_argument) in arguments.into_iter().enumerate() {
            let Token::Name(name) = &source.tokens[at].token else {
                continue;
            };
            let name = name.clone();
            if at < annotated {
                // A part of a type.
            } else if let Some(target) = source.assignment(at, &name) {
                if target.annotated {
                    annotated = target.value;
                }
                match is_argument {
                    true => named.push((at, target)),
                    false => source.note(at, target),
                }
            } else if source.changes(at) {
                let span = source.tokens[at].span.clone();
                source.names.entry(name).or_default().refuse(span, CHANGED);
            }
        }
        // `f(a = 1)` names an argument, unless there is no other `a`.
        let outside: BTreeSet<String> = source.names.keys().cloned().collect();
        for (at, target) in named {
            if !outside.contains(&target.name) {
                source.note(at, target);
            }
        }
        for assigned in source.names.values_mut() {
            let whole = assigned.whole.is_some();
            if let Some((span, _)) = assigned.elements.values().next().filter(|_| whole) {
                let span = span.clone();
                assigned.refuse(span, CHANGED);
            }
        }
        source.drop_prefix();
        Ok(source)
    }

    fn empty(input: Input<'a>, notation: Notation) -> Self {
        Source {
            input,
            notation,
            fortran: false,
            bounded: BTreeSet::new(),
            tokens: Vec::new(),
            depths: Vec::new(),
            names: BTreeMap::new(),
            computed: Cell::new(0),
            copied: Cell::new(0),
            lists: RefCell::default(),
        }
    }

    /// The first token after the brackets that follow a name, the number of brackets, and the index if there is only one.
    fn brackets(&self, at: usize) -> Option<(usize, usize, Option<usize>)> {
        let (mut after, mut brackets, mut index) = (at + 1, 0, None);
        while let Some('[' | '(') = self.symbol(after) {
            let depth = self.depths[after];
            // The size of an array may be any expression.
            let inner = self.depths[after + 1..].iter().take(64);
            let length = inner.take_while(|&&inside| inside > depth).count();
            let end = after + 1 + length;
            if !matches!(self.symbol(end), Some(']' | ')')) {
                return None;
            }
            let number = match &self.tokens[after + 1].token {
                Token::Number(value) if length == 1 => {
                    let whole = value.constant.as_rational().filter(|x| x.is_integer());
                    whole.and_then(|x| usize::try_from(x.to_integer()).ok())
                }
                _ => None,
            };
            index = number.filter(|_| brackets == 0);
            brackets += 1;
            after = end + 1;
        }
        Some((after, brackets, index))
    }

    /// The left side of an assignment, if one begins at a name.
    fn assignment(&self, at: usize, name: &str) -> Option<Target> {
        let (mut after, brackets, index) = self.brackets(at)?;
        let annotation = self.annotation(at);
        after = annotation.unwrap_or(after);
        let mut value = match self.symbol(after) {
            Some('=') if self.assigns(after) => self.skip_lines(after + 1),
            Some('{') if self.initialises(at) => after,
            _ => return None,
        };
        // `a = b = 1`
        for _ in 0..MAX_TOGETHER {
            let name = self.tokens.get(value).map(|found| &found.token);
            let next = name.filter(|name| matches!(name, Token::Name(_)) && !self.fortran);
            let next = next.and_then(|_| self.brackets(value));
            match next.filter(|&(after, ..)| self.assigns(after)) {
                Some((after, ..)) => value = self.skip_lines(after + 1),
                None => break,
            }
        }
        Some(Target {
            name: name.to_owned(),
            index,
            brackets,
            value,
            annotated: annotation.is_some(),
        })
    }

    /// Whether a token is the `=` of an assignment, and not of a comparison.
    fn assigns(&self, at: usize) -> bool {
        self.symbol(at) == Some('=') && self.symbol(at + 1) != Some('=')
    }

    /// The `=` after the type of a name at the beginning of a statement: `a: list[float] = [1.0]`, `const a::Vector{Float64} = [1.0]`.
    fn annotation(&self, at: usize) -> Option<usize> {
        /// What may precede the name.
        const KEYWORDS: [&str; 6] = ["const", "static", "global", "local", "let", "mut"];
        /// What may stand before a colon without being a name.
        const BLOCKS: [&str; 3] = ["else", "try", "finally"];
        let typed = matches!(self.notation, Notation::Julia | Notation::Python) && !self.fortran;
        if !typed || self.symbol(at + 1) != Some(':') {
            return None;
        }
        let is = |at: usize, words: &[&str]| match &self.tokens[at].token {
            Token::Name(word) => words.contains(&word.as_str()),
            _ => false,
        };
        let begins = at.checked_sub(1).is_none_or(|before| {
            let ends = matches!(self.tokens[before].token, Token::Line | Token::Symbol(';'));
            ends || is(before, &KEYWORDS)
        });
        if !begins || is(at, &BLOCKS) {
            return None;
        }
        let type_ = self.depths[at..].iter().take(64).enumerate();
        let mut type_ = type_.filter(|(_, depth)| **depth == self.depths[at]);
        let (length, _) = type_.find(|(i, _)| {
            let token = &self.tokens[at + i].token;
            matches!(token, Token::Line | Token::Symbol('=' | ';' | ','))
        })?;
        self.assigns(at + length).then_some(at + length)
    }

    /// Whether braces after a name and its size are its value in C++: `double a[2]{1.0, 0.0}`, `std::vector<double> a{1.0}`.
    fn initialises(&self, at: usize) -> bool {
        /// What precedes the name of a type or a block.
        const OTHERS: [&str; 12] = [
            "struct",
            "class",
            "enum",
            "union",
            "namespace",
            "public",
            "private",
            "protected",
            "virtual",
            "else",
            "do",
            "try",
        ];
        let before = at.checked_sub(1).and_then(|at| self.tokens.get(at));
        let declared = before.is_some_and(|before| match &before.token {
            Token::Name(word) => !OTHERS.contains(&word.as_str()),
            Token::Symbol(c) => matches!(c, '>' | ','),
            _ => false,
        });
        self.notation == Notation::C && declared && self.symbol(at + 1) != Some('(')
    }

    /// Whether the value of a name is changed here: `a += 1`, `a .*= 2`, `a[1]++`, `push!(a, 1)`.
    fn changes(&self, at: usize) -> bool {
        let before = |n: usize| at.checked_sub(n).and_then(|at| self.symbol(at));
        let function = at.checked_sub(3).and_then(|at| self.tokens.get(at));
        let named = function.is_some_and(|token| matches!(token.token, Token::Name(_)));
        let julia = self.notation == Notation::Julia;
        if julia && named && before(1) == Some('(') && before(2) == Some('!') {
            return true;
        }
        let Some((mut after, ..)) = self.brackets(at) else {
            return false;
        };
        let clings = |at: usize| self.tokens.get(at).is_some_and(|token| !token.apart);
        if self.symbol(after) == Some('.') {
            after += 1;
            if self.symbol(after) == Some('=') && clings(after) {
                return true;
            }
        }
        match self.symbol(after) {
            Some(sign @ ('+' | '-')) if self.symbol(after + 1) == Some(sign) => {
                self.notation == Notation::C && clings(after + 1)
            }
            Some('+' | '-' | '*' | '/' | '÷' | '^' | '%' | '|' | '&' | '@') => {
                self.symbol(after + 1) == Some('=') && clings(after + 1)
            }
            _ => false,
        }
    }

    /// Notes an assignment: of an element if the value is not a list.
    fn note(&mut self, at: usize, target: Target) {
        let Target {
            name,
            index,
            brackets,
            value,
            annotated: _,
        } = target;
        let list = matches!(self.symbol(value), Some('{' | '[')) || self.is_reshaped(value);
        // The size of a list in its declaration.
        let declared = list && (self.notation == Notation::C || self.fortran);
        let unclear = brackets > 0 && !declared && (list || brackets > 1 || index.is_none());
        let before = at.checked_sub(1).and_then(|at| self.symbol(at));
        let together = before == Some(',') && self.depths[at] == 0 && self.has_tuples();
        let span = self.tokens[at].span.clone();
        let place = (span.clone(), value);
        let assigned = self.names.entry(name).or_default();
        let earlier = match index.filter(|_| !list && brackets == 1) {
            Some(index) => assigned.elements.insert(index, place),
            None => assigned.whole.replace(place),
        };
        for (holds, why) in [
            (unclear, INDEX),
            (together, TOGETHER),
            (earlier.is_some(), AGAIN),
        ] {
            if holds {
                assigned.refuse(span.clone(), why);
            }
        }
    }

    /// Whether the value is a matrix that Fortran forms of a list.
    fn is_reshaped(&self, value: usize) -> bool {
        let name = self.tokens.get(value).map(|found| &found.token);
        self.fortran && matches!(name, Some(Token::Name(name)) if name == "reshape")
    }

    /// Drops the name of the method from the lists `gauss_2_a`, `gauss_2_b` of C, if a text has one such table and no other.
    fn drop_prefix(&mut self) {
        let own = ["a", "A", "b"].into_iter().any(|name| self.has(name));
        if own || self.notation != Notation::C || self.fortran {
            return;
        }
        let prefixes = self.names.keys().filter_map(|key| key.strip_suffix("_a"));
        let mut prefixes = prefixes.filter(|prefix| self.has(&format!("{prefix}_b")));
        let (Some(prefix), None) = (prefixes.next().map(str::to_owned), prefixes.next()) else {
            return;
        };
        for name in ["a", "b", "c", "a_tilde", "b_tilde", "c_tilde", "gradient"] {
            if let Some(assigned) = self.names.remove(&format!("{prefix}_{name}")) {
                self.names.entry(name.to_owned()).or_insert(assigned);
            }
        }
    }

    /// The lists `a1`, `a2`, … if each is filled entry by entry, as rows of a matrix.
    ///
    /// # Errors
    /// The errors of [`list`](Self::list).
    pub fn rows(&self, name: &str) -> Result<Option<Vec<Vec<Value>>>, Error> {
        let numbered = self.numbered(name);
        let filled = numbered.values().all(|row| {
            let assigned = self.names.get(row);
            assigned.is_some_and(|assigned| assigned.whole.is_none())
        });
        if numbered.is_empty() || !filled || self.names.contains_key(name) {
            return Ok(None);
        }
        let rows = numbered
            .values()
            .map(|row| Ok(self.list(row)?.unwrap_or_default()));
        rows.collect::<Result<_, Error>>().map(Some)
    }

    /// Whether a comma outside brackets forms a tuple rather than separating declarations.
    fn has_tuples(&self) -> bool {
        self.notation != Notation::C && !self.fortran
    }

    /// Whether a name has a value, or `a1`, `a2`, … have values.
    pub fn has(&self, name: &str) -> bool {
        self.names.contains_key(name) || !self.numbered(name).is_empty()
    }

    /// The names `a1`, `a2`, … by their numbers.
    fn numbered(&self, name: &str) -> BTreeMap<usize, String> {
        let keys = self.names.keys();
        let numbered = keys.filter_map(|key| Some((number(name, key)?, key.clone())));
        numbered.collect()
    }

    /// The list of a name; `None` if there is none.
    ///
    /// # Errors
    /// The first part that is not a number, a name that is assigned twice, and numbers that are not consecutive.
    pub fn list(&self, name: &str) -> Result<Option<Vec<Value>>, Error> {
        self.list_within(name, 0)
            .map(|list| list.map(|list| list.to_vec()))
    }

    /// The place of the first assignment to a name.
    pub fn place(&self, name: &str) -> Range<usize> {
        let own = self.names.get(name).and_then(|assigned| {
            let first = assigned.elements.values().next();
            assigned.whole.as_ref().or(first)
        });
        let numbered = || {
            let (_, first) = self.numbered(name).into_iter().next()?;
            let first = self.names.get(&first)?;
            first.whole.as_ref().or(first.elements.values().next())
        };
        own.or_else(numbered).map_or(0..0, |(span, _)| span.clone())
    }

    /// [`list`](Self::list), computed once.
    pub fn list_within(&self, name: &str, depth: usize) -> Result<Option<Rc<Vec<Value>>>, Error> {
        if let Some(known) = self.lists.borrow().get(name) {
            return Ok(Some(Rc::clone(known)));
        }
        let Some(list) = self.computed_list(name, depth)? else {
            return Ok(None);
        };
        let list = Rc::new(list);
        let mut lists = self.lists.borrow_mut();
        lists.insert(name.to_owned(), Rc::clone(&list));
        Ok(Some(list))
    }

    fn computed_list(&self, name: &str, depth: usize) -> Result<Option<Vec<Value>>, Error> {
        if let Some(assigned) = self.names.get(name) {
            self.once(name)?;
            if let Some((_, value)) = &assigned.whole {
                return self.evaluate(*value, depth).map(|item| Some(item.values()));
            }
            let places = assigned.elements.iter();
            let places = places.map(|(&index, (span, value))| (index, span.clone(), *value));
            let from_zero = match self.notation {
                Notation::C => !self.fortran,
                Notation::Python => true,
                Notation::Julia | Notation::Mathematica => false,
            };
            let first = from_zero.then_some(0);
            return self.elements(name, places, first, depth).map(Some);
        }
        let numbered = self.numbered(name);
        if numbered.is_empty() {
            return Ok(None);
        }
        // `a1` and `a01`
        let names = self.names.keys().filter(|key| number(name, key).is_some());
        if names.count() > numbered.len() {
            let message = format!("two of the numbered `{name}` have the same number");
            return Err(self.wrong(&self.place(name), message));
        }
        let mut places = Vec::new();
        for (index, name) in numbered {
            self.once(&name)?;
            if let Some((span, value)) = self.names.get(&name).and_then(|found| found.whole.clone())
            {
                places.push((index, span, value));
            }
        }
        self.elements(name, places.into_iter(), None, depth)
            .map(Some)
    }

    /// The value assigned to a name as a whole; a list is computed once.
    pub fn whole(&self, name: &str, value: usize, depth: usize) -> Result<Item, Error> {
        let known = self.lists.borrow().get(name).map(Rc::clone);
        if let Some(list) = known.filter(|list| list.len() != 1) {
            return self.copy(name, &list).map(Item::Many);
        }
        let item = self.evaluate(value, depth)?;
        if let Item::Many(values) = &item {
            let list = Rc::new(self.copy(name, values)?);
            self.lists.borrow_mut().insert(name.to_owned(), list);
        }
        Ok(item)
    }

    /// A copy of the numbers of a list, up to a limit.
    pub fn copy(&self, name: &str, list: &[Value]) -> Result<Vec<Value>, Error> {
        self.copied.set(self.copied.get() + list.len());
        if self.copied.get() > MAX_COPIES {
            let kind = ErrorKind::ExpressionSize {
                what: "the number of values that are copied from lists",
                size: self.copied.get(),
                limit: MAX_COPIES,
            };
            return Err(self.input.error(&self.place(name), kind));
        }
        Ok(list.to_vec())
    }

    /// Rejects a name with an ambiguous value.
    pub fn once(&self, name: &str) -> Result<(), Error> {
        let assigned = self.names.get(name);
        match assigned.and_then(|assigned| assigned.refused.as_ref()) {
            Some((span, why)) => Err(self.wrong(span, format!("`{}` {why}", shown(name)))),
            None => Ok(()),
        }
    }

    fn elements(
        &self,
        name: &str,
        places: impl Iterator<Item = (usize, Range<usize>, usize)>,
        first: Option<usize>,
        depth: usize,
    ) -> Result<Vec<Value>, Error> {
        let mut next = first;
        let mut values = Vec::new();
        for (index, span, value) in places {
            let expected = next.unwrap_or(index.min(1));
            if index != expected {
                let message = format!("`{name}` {expected} is missing before `{name}` {index}");
                return Err(self.wrong(&span, message));
            }
            next = Some(index + 1);
            match self.evaluate(value, depth)? {
                Item::One(value) => values.push(value),
                Item::Many(_) => {
                    let message = format!("`{name}` {index} is a list, expected a number");
                    return Err(self.wrong(&span, message));
                }
            }
        }
        Ok(values)
    }

    /// The value that begins at a token and extends over the whole statement.
    pub fn evaluate(&self, at: usize, depth: usize) -> Result<Item, Error> {
        self.computed.set(self.computed.get() + 1);
        if self.computed.get() > MAX_NUMBERS {
            let kind = ErrorKind::ExpressionSize {
                what: "the number of values that are computed",
                size: self.computed.get(),
                limit: MAX_NUMBERS,
            };
            let span = self.tokens.get(at).map_or(0..0, |found| found.span.clone());
            return Err(self.input.error(&span, kind));
        }
        let mut parser = Parser {
            source: self,
            tokens: &self.tokens,
            end: self.input.text.len(),
            at,
            depth,
            inside: 0,
            matrix: false,
        };
        let item = parser.expression()?;
        let after = parser.at;
        let Some(found) = self.tokens.get(after) else {
            return Ok(item);
        };
        let previous = after.checked_sub(1).and_then(|at| self.tokens.get(at));
        let between = previous.map_or(0..0, |previous| previous.span.end..found.span.start);
        let other_line = self
            .input
            .text
            .get(between)
            .is_some_and(|gap| gap.contains('\n'));
        match &found.token {
            Token::Line | Token::Symbol(';' | ')' | ']' | '}') => Ok(item),
            Token::Symbol(',') if self.depths[after] == 0 && self.has_tuples() => {
                let message = "several values without brackets; write them as a list".to_owned();
                Err(self.wrong(&found.span, message))
            }
            Token::Symbol(',') => Ok(item),
            // The next statement in Fortran, or the end of a block in Julia.
            Token::Name(_) if other_line => Ok(item),
            Token::Name(name) if name == "end" && self.notation == Notation::Julia => Ok(item),
            _ => Err(parser.unexpected("an operator, or the end of the statement")),
        }
    }

    fn symbol(&self, at: usize) -> Option<char> {
        match self.tokens.get(at)?.token {
            Token::Symbol(c) => Some(c),
            _ => None,
        }
    }

    fn skip_lines(&self, mut at: usize) -> usize {
        // In Python the end of the line ends the statement.
        let over = self.notation != Notation::Python;
        while over
            && matches!(self.tokens.get(at), Some(found) if matches!(found.token, Token::Line))
        {
            at += 1;
        }
        at
    }

    /// An error at a part of the text.
    pub fn wrong(&self, span: &Range<usize>, message: String) -> Error {
        self.input.error(span, ErrorKind::Document { message })
    }
}

/// The exact value of one text, as in `a = "1/3"`.
pub fn value_of(input: Input<'_>, range: Range<usize>, notation: Notation) -> Result<Value, Error> {
    let source = Source::empty(input, notation);
    let mut parser = Parser {
        source: &source,
        tokens: &[],
        end: range.end,
        at: 0,
        depth: 0,
        inside: 1,
        matrix: false,
    };
    match parser.quoted(range.clone())? {
        Item::One(value) => Ok(value),
        Item::Many(_) => Err(source.wrong(&range, "found a list, expected a number".to_owned())),
    }
}

/// The number after the name `a` in `a1` or `a_1`.
fn number(name: &str, key: &str) -> Option<usize> {
    let digits = key.strip_prefix(name)?;
    let digits = digits.strip_prefix('_').unwrap_or(digits);
    let plain = digits.bytes().all(|byte| byte.is_ascii_digit());
    plain.then(|| digits.parse().ok()).flatten()
}

/// The number 0.
pub fn zero() -> Value {
    Value::exact(Constant::zero())
}
