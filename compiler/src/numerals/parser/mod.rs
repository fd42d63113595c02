//! The expressions of a table in any of the languages.

mod fortran;
mod names;

use std::ops::Range;

use super::source::{MAX_NUMBERS, Source};
use super::tokens::{Kind, Spanned, Token, tokenize};
use super::value::Value;
use crate::error::{Error, ErrorKind};
use crate::expression::{MAX_DEPTH, shown};
use crate::library::Notation;

/// An operation on two numbers.
type Combine = fn(&Value, &Value) -> Result<Value, ErrorKind>;

/// The value of an expression.
pub enum Item {
    One(Value),
    /// A list, with nested lists flattened.
    Many(Vec<Value>),
}

impl Item {
    pub fn values(self) -> Vec<Value> {
        match self {
            Item::One(value) => vec![value],
            Item::Many(values) => values,
        }
    }
}

/// A recursive descent over the tokens of one value.
pub(super) struct Parser<'s, 'a> {
    pub source: &'s Source<'a>,
    pub tokens: &'s [Spanned],
    /// The end of the text.
    pub end: usize,
    pub at: usize,
    pub depth: usize,
    /// The number of open brackets; within brackets the end of a line has no meaning.
    pub inside: usize,
    /// Whether the innermost bracket is `[` of a matrix, where white space separates numbers.
    pub matrix: bool,
}

impl Parser<'_, '_> {
    pub fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.at).map(|found| &found.token)
    }

    fn symbol(&mut self) -> Option<char> {
        if self.inside > 0 {
            self.lines();
        }
        match self.peek() {
            Some(Token::Symbol(c)) => Some(*c),
            _ => None,
        }
    }

    /// Consumes a symbol if it comes next.
    fn take(&mut self, wanted: char) -> bool {
        let found = self.symbol() == Some(wanted);
        self.at += usize::from(found);
        found
    }

    fn lines(&mut self) {
        while matches!(self.peek(), Some(Token::Line)) {
            self.at += 1;
        }
    }

    fn span(&self) -> Range<usize> {
        self.tokens
            .get(self.at)
            .map_or(self.end..self.end, |found| found.span.clone())
    }

    /// The error for an unexpected next token.
    pub fn unexpected(&self, expected: &str) -> Error {
        let span = self.span();
        if let Some(Token::Wrong(kind)) = self.peek() {
            return self.source.input.error(&span, kind.clone());
        }
        let found = match self.peek() {
            None => "the input ends".to_owned(),
            Some(Token::Line) => "the line ends".to_owned(),
            Some(_) => format!("found `{}`", shown(&self.source.input.text[span.clone()])),
        };
        let expected = expected.to_owned();
        let kind = ErrorKind::Syntax { found, expected };
        self.source.input.error(&span, kind)
    }

    fn wrong(&self, span: Range<usize>, kind: ErrorKind) -> Error {
        self.source.input.error(&span, kind)
    }

    fn deeper(&mut self) -> Result<(), Error> {
        self.depth += 1;
        if self.depth <= MAX_DEPTH {
            return Ok(());
        }
        let kind = ErrorKind::ExpressionSize {
            what: "its depth",
            size: self.depth,
            limit: MAX_DEPTH,
        };
        Err(self.wrong(self.span(), kind))
    }

    pub fn expression(&mut self) -> Result<Item, Error> {
        self.deeper()?;
        let mut left = self.term()?;
        while let Some(operator @ ('+' | '-')) = self.symbol() {
            // In lists without commas, a sign directly before a number begins that number.
            let [here, next] = [self.at, self.at + 1].map(|at| self.tokens.get(at));
            let clings = here.is_some_and(|x| x.apart) && next.is_some_and(|x| !x.apart);
            if self.matrix && clings && matches!(left, Item::One(_)) {
                break;
            }
            let span = self.span();
            self.at += 1;
            let right = self.term()?;
            let combine = if operator == '+' {
                Value::add
            } else {
                Value::subtract
            };
            left = self.combine(left, right, span, combine)?;
        }
        self.depth -= 1;
        Ok(left)
    }

    fn term(&mut self) -> Result<Item, Error> {
        let mut left = self.fraction()?;
        while let Some(operator @ ('*' | '/')) = self.symbol() {
            let span = self.span();
            self.at += 1;
            let right = self.fraction()?;
            left = match operator {
                '*' => self.combine(left, right, span, Value::multiply)?,
                _ => self.quotient(left, right, span)?,
            };
        }
        Ok(left)
    }

    /// Factors separated by `//`, which binds more tightly than `/` in Julia.
    fn fraction(&mut self) -> Result<Item, Error> {
        let mut left = self.factor()?;
        while self.symbol() == Some('÷') {
            let span = self.span();
            if self.source.notation != Notation::Julia {
                let message = "`//` is not a division with all digits here; write `/`".to_owned();
                return Err(self.wrong(span, ErrorKind::Document { message }));
            }
            self.at += 1;
            let right = self.factor()?;
            left = self.combine(left, right, span, Value::divide)?;
        }
        Ok(left)
    }

    /// A quotient; C and Fortran truncate the quotient of two integers.
    fn quotient(&self, left: Item, right: Item, span: Range<usize>) -> Result<Item, Error> {
        let cuts = self.source.notation == Notation::C || self.source.fortran;
        if let (Item::One(x), Item::One(y)) = (&left, &right)
            && cuts
            && x.whole
            && y.whole
        {
            let message =
                "an integer divided by an integer is cut to an integer here; write `1.0` for `1`";
            let message = message.to_owned();
            return Err(self.wrong(span, ErrorKind::Document { message }));
        }
        self.combine(left, right, span, Value::divide)
    }

    fn combine(
        &self,
        left: Item,
        right: Item,
        span: Range<usize>,
        combine: Combine,
    ) -> Result<Item, Error> {
        match (left, right) {
            (Item::One(x), Item::One(y)) => {
                let value = combine(&x, &y).map_err(|kind| self.wrong(span, kind))?;
                Ok(Item::One(value))
            }
            _ => {
                let message = "lists are not computed with here; write their numbers".to_owned();
                Err(self.wrong(span, ErrorKind::Document { message }))
            }
        }
    }

    fn factor(&mut self) -> Result<Item, Error> {
        self.lines();
        let span = self.span();
        if self.take('+') {
            return self.nested_factor();
        }
        if self.take('-') {
            return match self.nested_factor()? {
                Item::One(value) => {
                    let value = value.negate().map_err(|kind| self.wrong(span, kind))?;
                    Ok(Item::One(value))
                }
                Item::Many(_) => Err(self.wrong(
                    span,
                    ErrorKind::Document {
                        message: "a list has no sign here; write its numbers".to_owned(),
                    },
                )),
            };
        }
        if self.take('√') {
            let Item::One(value) = self.nested_factor()? else {
                let message = "the root of a list".to_owned();
                return Err(self.wrong(span, ErrorKind::Document { message }));
            };
            let root = value.root("sqrt").map_err(|kind| self.wrong(span, kind));
            return root.map(Item::One);
        }
        let base = self.atom()?;
        if self.symbol() == Some('^') {
            let span = self.span();
            self.at += 1;
            let exponent = self.nested_factor()?;
            return self.combine(base, exponent, span, Value::power);
        }
        // `2a1` of Julia.
        let julia = self.source.notation == Notation::Julia && !self.source.fortran;
        let product = julia
            && match (&base, self.peek()) {
                (Item::One(_), Some(Token::Name(_))) => {
                    let number = matches!(
                        self.tokens[self.at.saturating_sub(1)].token,
                        Token::Number(_)
                    );
                    number && !self.tokens[self.at].apart
                }
                _ => false,
            };
        if product {
            let span = self.span();
            let right = self.nested_factor()?;
            return self.combine(base, right, span, Value::multiply);
        }
        Ok(base)
    }

    fn nested_factor(&mut self) -> Result<Item, Error> {
        self.deeper()?;
        let item = self.factor();
        self.depth -= 1;
        item
    }

    fn atom(&mut self) -> Result<Item, Error> {
        let span = self.span();
        match self.peek().cloned() {
            Some(Token::Number(value)) => {
                self.at += 1;
                Ok(Item::One(value))
            }
            Some(Token::Text(range)) => {
                self.at += 1;
                self.quoted(range)
            }
            Some(Token::Symbol('(')) => {
                self.at += 1;
                let items = self.items(')')?;
                match <[Item; 1]>::try_from(items) {
                    Ok([item]) => Ok(item),
                    Err(_) if self.source.notation == Notation::C && !self.source.fortran => {
                        let message = "expected one number in these brackets".to_owned();
                        Err(self.wrong(span, ErrorKind::Document { message }))
                    }
                    Err(items) => Ok(joined(items)),
                }
            }
            Some(Token::Symbol(open @ ('[' | '{'))) => {
                self.at += 1;
                let items = self.items(if open == '[' { ']' } else { '}' })?;
                Ok(joined(items))
            }
            Some(Token::Symbol('@')) => {
                // A macro of Julia, `@big`.
                self.at += 2;
                self.nested_factor()
            }
            Some(Token::Name(name)) => {
                self.at += 1;
                self.named(&name, span)
            }
            _ => Err(self.unexpected("a number")),
        }
    }

    /// The text between quotes, read as an expression.
    pub fn quoted(&mut self, range: Range<usize>) -> Result<Item, Error> {
        self.deeper()?;
        let (input, notation) = (self.source.input, self.source.notation);
        let tokens = tokenize(input, range.clone(), notation, Kind::Number)?;
        let mut parser = Parser {
            source: self.source,
            tokens: &tokens,
            end: range.end,
            at: 0,
            depth: self.depth,
            inside: 1,
            matrix: false,
        };
        let item = parser.expression()?;
        if parser.peek().is_some() {
            return Err(parser.unexpected("an operator, or the end of the text"));
        }
        self.depth -= 1;
        Ok(item)
    }

    /// Items up to a closing bracket; keyword arguments are skipped.
    fn items(&mut self, close: char) -> Result<Vec<Item>, Error> {
        self.deeper()?;
        self.inside += 1;
        let spaces =
            close == ']' && self.source.notation == Notation::Julia && !self.source.fortran;
        let outside = std::mem::replace(&mut self.matrix, spaces);
        let (mut items, mut numbers) = (Vec::new(), 0);
        // Whether white space on the same line separates the previous item from this one.
        let mut beside = false;
        loop {
            match self.symbol() {
                Some(c) if c == close => break,
                Some(',' | ';') => {
                    self.at += 1;
                    continue;
                }
                _ => {}
            }
            let named = matches!(self.peek(), Some(Token::Name(_)));
            if named && self.source_symbol(self.at + 1) == Some('=') {
                self.pass_over(close);
                continue;
            }
            let span = self.span();
            let item = self.expression()?;
            if beside
                && [Some(&item), items.last()]
                    .into_iter()
                    .flatten()
                    .any(is_long)
            {
                let message = "lists beside one another are columns; write the numbers row by row";
                let message = message.to_owned();
                return Err(self.wrong(span, ErrorKind::Document { message }));
            }
            numbers += match &item {
                Item::One(_) => 1,
                Item::Many(values) => values.len(),
            };
            if numbers > MAX_NUMBERS {
                let kind = ErrorKind::ExpressionSize {
                    what: "the length of a list",
                    size: numbers,
                    limit: MAX_NUMBERS,
                };
                return Err(self.wrong(span, kind));
            }
            items.push(item);
            // White space or the end of a line separates the numbers of a matrix.
            let before = self.at.checked_sub(1).and_then(|at| self.tokens.get(at));
            let line = before.is_some_and(|before| matches!(before.token, Token::Line))
                || matches!(self.peek(), Some(Token::Line));
            let apart = self.tokens.get(self.at).is_some_and(|next| next.apart);
            let ends = matches!(self.symbol(), Some(c) if c == close || c == ',' || c == ';');
            if !ends && !(spaces && (line || apart)) {
                return Err(self.unexpected(&format!("an operator, `,` or `{close}`")));
            }
            beside = !ends && !line;
        }
        self.matrix = outside;
        self.at += 1;
        self.inside -= 1;
        self.depth -= 1;
        Ok(items)
    }

    fn source_symbol(&self, at: usize) -> Option<char> {
        match self.tokens.get(at)?.token {
            Token::Symbol(c) => Some(c),
            _ => None,
        }
    }

    /// Skips a keyword argument.
    fn pass_over(&mut self, close: char) {
        let mut depth = 0_i32;
        while let Some(token) = self.tokens.get(self.at) {
            match token.token {
                Token::Symbol('(' | '[' | '{') => depth += 1,
                Token::Symbol(',') if depth == 0 => return,
                Token::Symbol(c) if depth == 0 && c == close => return,
                Token::Symbol(')' | ']' | '}') => depth -= 1,
                _ => {}
            }
            self.at += 1;
        }
    }
}

/// Whether the item is a list of several numbers.
fn is_long(item: &Item) -> bool {
    matches!(item, Item::Many(values) if values.len() > 1)
}

fn joined(items: Vec<Item>) -> Item {
    Item::Many(items.into_iter().flat_map(Item::values).collect())
}
