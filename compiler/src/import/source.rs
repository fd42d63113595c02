//! The assignments of a text, and the exact values of those that are asked for.
//!
//! ```text
//! a = [1//2, big"0.5"]      a1 = convert(T, 0.5)      table->a[0] = SUN_RCONST(1.0) / SUN_RCONST(3.0);
//! static const double a[2] = { 0x1.8p-1, 0.5f };      b = {1/2, Sqrt[2]/2, 1.5`20};
//! ```
//!
//! Everything else in the text is passed over.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::ops::Range;

use super::parser::{Item, Parser};
use super::tokens::{Spanned, Token, tokenize};
use super::value::Value;
use crate::error::{Error, ErrorKind};
use crate::expression::Input;
use crate::library::Notation;
use crate::symbolic::Constant;

/// The most numbers in a list: the matrix of a hundred stages.
pub(super) const MAX_NUMBERS: usize = 10_000;

/// Where values are assigned to a name.
#[derive(Default)]
pub(super) struct Assigned {
    /// The name and the first token of the value, of the whole or of a list.
    pub whole: Option<(Range<usize>, usize)>,
    /// The same for `a[3]`, by the number.
    pub elements: BTreeMap<usize, (Range<usize>, usize)>,
    /// The name, where something is assigned a second time.
    pub again: Option<Range<usize>>,
}

/// A text with its assignments.
pub(super) struct Source<'a> {
    pub input: Input<'a>,
    pub notation: Notation,
    tokens: Vec<Spanned>,
    pub names: BTreeMap<String, Assigned>,
    /// How many values were computed: a name may stand in many others, and these in many others again.
    computed: Cell<usize>,
}

impl<'a> Source<'a> {
    /// Finds the assignments.
    pub fn scan(input: Input<'a>, notation: Notation) -> Result<Self, Error> {
        let tokens = tokenize(input, 0..input.text.len(), notation)?;
        let mut source = Source {
            input,
            notation,
            tokens,
            names: BTreeMap::new(),
            computed: Cell::new(0),
        };
        for at in 0..source.tokens.len() {
            if let Some((name, index, value)) = source.assignment(at) {
                source.note(at, name, index, value);
            }
        }
        Ok(source)
    }

    /// The name, the number in brackets and the first token of the value, if an assignment begins at a token.
    fn assignment(&self, at: usize) -> Option<(String, Option<usize>, usize)> {
        let Token::Name(name) = &self.tokens[at].token else {
            return None;
        };
        let (mut after, mut index) = (at + 1, None);
        while let Some(close) = match self.symbol(after) {
            Some('[') => Some(']'),
            Some('(') => Some(')'),
            _ => None,
        } {
            let number = match &self.tokens.get(after + 1)?.token {
                Token::Number(value) => {
                    let whole = value.constant.as_rational().filter(|x| x.is_integer());
                    whole.and_then(|x| usize::try_from(x.to_integer()).ok())
                }
                _ => None,
            };
            index = number.or(index);
            // The size of an array may be anything, or a second one behind a comma.
            let length = self.tokens[after..].iter().take(8);
            let end = length
                .enumerate()
                .find(|(_, token)| matches!(token.token, Token::Symbol(c) if c == close))?;
            after += end.0 + 1;
        }
        let equals = self.symbol(after) == Some('=');
        equals.then(|| (name.clone(), index, self.skip_lines(after + 1)))
    }

    /// Notes an assignment: of an element where the value is no list.
    fn note(&mut self, at: usize, name: String, index: Option<usize>, value: usize) {
        let list = matches!(self.symbol(value), Some('{' | '['));
        let place = (self.tokens[at].span.clone(), value);
        let assigned = self.names.entry(name).or_default();
        let before = match index.filter(|_| !list) {
            Some(index) => assigned.elements.insert(index, place),
            None => assigned.whole.replace(place),
        };
        // An error only where the values of this name are asked for.
        if before.is_some() && assigned.again.is_none() {
            assigned.again = Some(self.tokens[at].span.clone());
        }
    }

    /// Whether a name has a value, or `a1`, `a2`, … have.
    pub fn has(&self, name: &str) -> bool {
        self.names.contains_key(name) || !self.numbered(name).is_empty()
    }

    /// `a1`, `a2`, … by their numbers.
    fn numbered(&self, name: &str) -> BTreeMap<usize, String> {
        let numbered = self.names.keys().filter_map(|key| {
            let digits = key.strip_prefix(name)?;
            let digits = digits.strip_prefix('_').unwrap_or(digits);
            let plain = digits.bytes().all(|byte| byte.is_ascii_digit());
            let number = plain.then(|| digits.parse().ok()).flatten()?;
            Some((number, key.clone()))
        });
        numbered.collect()
    }

    /// The list of a name; `None` if there is none.
    ///
    /// # Errors
    /// The first thing in it that is not a number, a name that is assigned twice, and numbers that do not follow one another.
    pub fn list(&self, name: &str) -> Result<Option<Vec<Value>>, Error> {
        self.list_within(name, 0)
    }

    /// Where a name is first assigned.
    pub fn place(&self, name: &str) -> Range<usize> {
        let own = self.names.get(name).and_then(|assigned| {
            let first = assigned.elements.values().next();
            assigned.whole.as_ref().or(first)
        });
        let numbered = || {
            let (_, first) = self.numbered(name).into_iter().next()?;
            self.names.get(&first)?.whole.as_ref()
        };
        own.or_else(numbered).map_or(0..0, |(span, _)| span.clone())
    }

    pub fn list_within(&self, name: &str, depth: usize) -> Result<Option<Vec<Value>>, Error> {
        if let Some(assigned) = self.names.get(name) {
            self.once(name)?;
            if let Some((_, value)) = &assigned.whole {
                return self.evaluate(*value, depth).map(|item| Some(item.values()));
            }
            let places = assigned.elements.iter();
            let places = places.map(|(&index, (span, value))| (index, span.clone(), *value));
            return self.elements(name, places, depth).map(Some);
        }
        let numbered = self.numbered(name);
        if numbered.is_empty() {
            return Ok(None);
        }
        let mut places = Vec::new();
        for (index, name) in numbered {
            self.once(&name)?;
            if let Some((span, value)) = self.names.get(&name).and_then(|found| found.whole.clone())
            {
                places.push((index, span, value));
            }
        }
        self.elements(name, places.into_iter(), depth).map(Some)
    }

    pub fn once(&self, name: &str) -> Result<(), Error> {
        match self
            .names
            .get(name)
            .and_then(|assigned| assigned.again.as_ref())
        {
            Some(span) => {
                let message = format!("`{name}` has a value already; a file holds one table");
                Err(self.wrong(span, message))
            }
            None => Ok(()),
        }
    }

    fn elements(
        &self,
        name: &str,
        places: impl Iterator<Item = (usize, Range<usize>, usize)>,
        depth: usize,
    ) -> Result<Vec<Value>, Error> {
        let mut next = None;
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
                    let message = format!("`{name}` {index} is a list, and a number is needed");
                    return Err(self.wrong(&span, message));
                }
            }
        }
        Ok(values)
    }

    /// The value that begins at a token and takes the whole statement.
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
        };
        let item = parser.expression()?;
        match parser.peek() {
            None | Some(Token::Line | Token::Symbol(',' | ';' | ')' | ']' | '}')) => Ok(item),
            // The end of a Julia tuple, or the next word of a declaration.
            Some(Token::Name(_)) if parser.tokens[parser.at].apart => Ok(item),
            Some(_) => Err(parser.unexpected("an operator, or the end of the statement")),
        }
    }

    fn symbol(&self, at: usize) -> Option<char> {
        match self.tokens.get(at)?.token {
            Token::Symbol(c) => Some(c),
            _ => None,
        }
    }

    fn skip_lines(&self, mut at: usize) -> usize {
        while matches!(self.tokens.get(at), Some(found) if matches!(found.token, Token::Line)) {
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
pub(super) fn value_of(
    input: Input<'_>,
    range: Range<usize>,
    notation: Notation,
) -> Result<Value, Error> {
    let source = Source {
        input,
        notation,
        tokens: Vec::new(),
        names: BTreeMap::new(),
        computed: Cell::new(0),
    };
    let mut parser = Parser {
        source: &source,
        tokens: &[],
        end: range.end,
        at: 0,
        depth: 0,
        inside: 1,
    };
    match parser.quoted(range.clone())? {
        Item::One(value) => Ok(value),
        Item::Many(_) => Err(source.wrong(&range, "a list where a number is needed".to_owned())),
    }
}

/// The number 0.
pub(super) fn zero() -> Value {
    Value::exact(Constant::zero())
}
