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

use super::tokens::{Spanned, Token, tokenize};
use super::value::Value;
use crate::error::{Error, ErrorKind};
use crate::expression::{Input, MAX_DEPTH, shown};
use crate::library::Notation;
use crate::symbolic::Constant;

/// The most numbers in a list: the matrix of a hundred stages.
const MAX_NUMBERS: usize = 10_000;

/// An operation on two numbers.
type Combine = fn(&Value, &Value) -> Result<Value, ErrorKind>;

/// What an expression is.
pub(super) enum Item {
    One(Value),
    /// A list, with those in it one after another.
    Many(Vec<Value>),
}

impl Item {
    fn values(self) -> Vec<Value> {
        match self {
            Item::One(value) => vec![value],
            Item::Many(values) => values,
        }
    }
}

/// Where values are assigned to a name.
#[derive(Default)]
struct Assigned {
    /// The name and the first token of the value, of the whole or of a list.
    whole: Option<(Range<usize>, usize)>,
    /// The same for `a[3]`, by the number.
    elements: BTreeMap<usize, (Range<usize>, usize)>,
    /// The name, where something is assigned a second time.
    again: Option<Range<usize>>,
}

/// A text with its assignments.
pub(super) struct Source<'a> {
    input: Input<'a>,
    notation: Notation,
    tokens: Vec<Spanned>,
    names: BTreeMap<String, Assigned>,
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

    fn list_within(&self, name: &str, depth: usize) -> Result<Option<Vec<Value>>, Error> {
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

    fn once(&self, name: &str) -> Result<(), Error> {
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
    fn evaluate(&self, at: usize, depth: usize) -> Result<Item, Error> {
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

/// A recursive descent over the tokens of one value.
struct Parser<'s, 'a> {
    source: &'s Source<'a>,
    tokens: &'s [Spanned],
    /// Where the text ends.
    end: usize,
    at: usize,
    depth: usize,
    /// In how many brackets, where the end of a line means nothing.
    inside: usize,
}

impl Parser<'_, '_> {
    fn peek(&self) -> Option<&Token> {
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

    /// Takes a symbol if it stands here.
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

    /// What stands here is something else.
    fn unexpected(&self, expected: &str) -> Error {
        let span = self.span();
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

    fn expression(&mut self) -> Result<Item, Error> {
        self.deeper()?;
        let mut left = self.term()?;
        while let Some(operator @ ('+' | '-')) = self.symbol() {
            // In lists without commas a sign that clings to what follows begins the next number.
            let [here, next] = [self.at, self.at + 1].map(|at| self.tokens.get(at));
            let clings = here.is_some_and(|x| x.apart) && next.is_some_and(|x| !x.apart);
            if self.inside > 0 && clings && matches!(left, Item::One(_)) && self.in_matrix() {
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

    /// Whether the innermost bracket is `[`, of a matrix with white space between its numbers.
    fn in_matrix(&self) -> bool {
        let mut depth = 0_i32;
        for token in self.tokens[..self.at].iter().rev() {
            match token.token {
                Token::Symbol(')' | ']' | '}') => depth += 1,
                Token::Symbol('(' | '{') if depth == 0 => return false,
                Token::Symbol('[') if depth == 0 => return true,
                Token::Symbol('(' | '[' | '{') => depth -= 1,
                _ => {}
            }
        }
        false
    }

    fn term(&mut self) -> Result<Item, Error> {
        let mut left = self.factor()?;
        while let Some(operator @ ('*' | '/' | '÷')) = self.symbol() {
            let span = self.span();
            self.at += 1;
            let right = self.factor()?;
            let combine = match operator {
                '*' => Value::multiply,
                _ => Value::divide,
            };
            left = self.combine(left, right, span, combine)?;
        }
        Ok(left)
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
        let product = match (&base, self.peek()) {
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

    /// What stands between quotes, read as an expression.
    fn quoted(&mut self, range: Range<usize>) -> Result<Item, Error> {
        self.deeper()?;
        let tokens = tokenize(self.source.input, range.clone(), self.source.notation)?;
        let mut parser = Parser {
            source: self.source,
            tokens: &tokens,
            end: range.end,
            at: 0,
            depth: self.depth,
            inside: 1,
        };
        let item = parser.expression()?;
        if parser.peek().is_some() {
            return Err(parser.unexpected("an operator, or the end of the text"));
        }
        self.depth -= 1;
        Ok(item)
    }

    /// Items up to a closing bracket; keyword arguments are passed over.
    fn items(&mut self, close: char) -> Result<Vec<Item>, Error> {
        self.deeper()?;
        self.inside += 1;
        let (mut items, mut numbers) = (Vec::new(), 0);
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
            // White space or the end of a line separates numbers of a matrix.
            let line = matches!(self.peek(), Some(Token::Line));
            let apart = self.tokens.get(self.at).is_some_and(|next| next.apart);
            let ends = matches!(self.symbol(), Some(c) if c == close || c == ',' || c == ';');
            if !ends && !(close == ']' && (line || apart)) {
                return Err(self.unexpected(&format!("an operator, `,` or `{close}`")));
            }
        }
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

    /// Passes over a keyword argument.
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

    /// A variable, an element, a call, or a list with the type of its entries before it.
    fn named(&mut self, name: &str, span: Range<usize>) -> Result<Item, Error> {
        // `big"0.5"`
        if let Some(Token::Text(range)) = self.peek().cloned()
            && !self.tokens[self.at].apart
        {
            self.at += 1;
            return self.quoted(range);
        }
        // The parameters of a type: `Rational{BigInt}`, `static_cast<double>`.
        for (open, close) in [('{', '}'), ('<', '>')] {
            let names = self.source_symbol(self.at) == Some(open)
                && matches!(self.tokens.get(self.at + 1), Some(found) if matches!(found.token, Token::Name(_)));
            if names {
                let rest = self.tokens[self.at..].iter().take(32);
                let end = rest
                    .enumerate()
                    .find(|(_, token)| matches!(token.token, Token::Symbol(c) if c == close));
                match end {
                    Some((length, _)) => self.at += length + 1,
                    None => return Err(self.unexpected("the parameters of a type")),
                }
            }
        }
        // A call for each entry: `Float64.(a)`.
        if self.source_symbol(self.at) == Some('.') && self.source_symbol(self.at + 1) == Some('(')
        {
            self.at += 1;
        }
        let mathematica = self.source.notation == Notation::Mathematica;
        match self.source_symbol(self.at) {
            Some('(') => {
                self.at += 1;
                if name == "convert" {
                    // The type comes first.
                    self.pass_over(')');
                }
                let arguments = self.items(')')?;
                self.call(name, span, arguments)
            }
            Some('[') if mathematica => {
                self.at += 1;
                let arguments = self.items(']')?;
                self.call(name, span, arguments)
            }
            Some('[') if !self.tokens[self.at].apart => {
                self.at += 1;
                let items = self.items(']')?;
                if self.source.has(name) {
                    return self.element(name, span, items);
                }
                Ok(joined(items))
            }
            _ => self.variable(name, span),
        }
    }

    fn variable(&mut self, name: &str, span: Range<usize>) -> Result<Item, Error> {
        self.deeper()?;
        let assigned = self.source.names.get(name);
        let item = match assigned {
            Some(Assigned {
                whole: Some((_, value)),
                ..
            }) => {
                self.source.once(name)?;
                self.source.evaluate(*value, self.depth)?
            }
            Some(_) => Item::Many(
                self.source
                    .list_within(name, self.depth)?
                    .unwrap_or_default(),
            ),
            None => {
                let kind = ErrorKind::Syntax {
                    found: format!("found `{}`, which has no value here", shown(name)),
                    expected: "a number".to_owned(),
                };
                return Err(self.wrong(span, kind));
            }
        };
        self.depth -= 1;
        Ok(item)
    }

    /// `a[2]`
    fn element(&mut self, name: &str, span: Range<usize>, items: Vec<Item>) -> Result<Item, Error> {
        let index = match &items[..] {
            [Item::One(value)] => {
                let whole = value.constant.as_rational().filter(|x| x.is_integer());
                whole.and_then(|x| usize::try_from(x.to_integer()).ok())
            }
            _ => None,
        };
        let single = index.and_then(|index| {
            let assigned = self.source.names.get(name)?;
            assigned.elements.get(&index)
        });
        self.deeper()?;
        let item = match (single, index) {
            (Some((_, value)), _) => {
                self.source.once(name)?;
                self.source.evaluate(*value, self.depth)?
            }
            (None, Some(index)) => {
                let list = self.source.list_within(name, self.depth)?;
                let one_based = self.source.notation == Notation::Julia;
                let found = index
                    .checked_sub(usize::from(one_based))
                    .and_then(|index| list.and_then(|list| list.into_iter().nth(index)));
                match found {
                    Some(value) => Item::One(value),
                    None => {
                        let message = format!("`{name}` has no entry {index}");
                        return Err(self.wrong(span, ErrorKind::Document { message }));
                    }
                }
            }
            (None, None) => {
                let message = format!("an entry of `{name}` has a number here");
                return Err(self.wrong(span, ErrorKind::Document { message }));
            }
        };
        self.depth -= 1;
        Ok(item)
    }

    /// A function of one or two numbers, or a conversion, which leaves a number as it is.
    fn call(&self, name: &str, span: Range<usize>, arguments: Vec<Item>) -> Result<Item, Error> {
        /// Conversions: the number is the first argument.
        const CONVERSIONS: [&str; 25] = [
            "convert",
            "n",
            "t",
            "float",
            "float64",
            "float32",
            "bigfloat",
            "big",
            "mpf",
            "mpq",
            "decimal",
            "double",
            "sun_rconst",
            "realtype",
            "sunrealtype",
            "real",
            "sympify",
            "s",
            "static_cast",
            "array",
            "svector",
            "smatrix",
            "value",
            "rationalize",
            "vector",
        ];
        let plain = name.to_ascii_lowercase();
        let wrong = |expected: &str| {
            let kind = ErrorKind::Arguments {
                function: shown(name),
                expected: expected.to_owned(),
                found: format!("{} arguments", arguments.len()),
            };
            Err(self.wrong(span.clone(), kind))
        };
        let two = |combine: Combine| match &arguments[..] {
            [Item::One(x), Item::One(y)] => combine(x, y)
                .map(Item::One)
                .map_err(|kind| self.wrong(span.clone(), kind)),
            _ => wrong("two numbers"),
        };
        match (plain.as_str(), arguments.len()) {
            ("sqrt" | "sunrsqrt" | "cbrt" | "cuberoot", _) => match &arguments[..] {
                [Item::One(value)] => {
                    let root = if plain.ends_with("sqrt") {
                        "sqrt"
                    } else {
                        "cbrt"
                    };
                    let value = value.root(root);
                    value.map(Item::One).map_err(|kind| self.wrong(span, kind))
                }
                _ => wrong("one number"),
            },
            ("pow" | "power" | "sunrpowerr", _) => two(Value::power),
            ("rational" | "fraction", 2) => two(Value::divide),
            ("rational" | "fraction" | "integer", 1) => Ok(first(arguments)),
            (conversion, 1..) if CONVERSIONS.contains(&conversion) => Ok(first(arguments)),
            _ => {
                let kind = ErrorKind::Unknown {
                    what: "function",
                    name: shown(name),
                    known: "sqrt, cbrt, pow and conversions such as big, Fraction, mpf, convert"
                        .to_owned(),
                };
                Err(self.wrong(span, kind))
            }
        }
    }
}

fn joined(items: Vec<Item>) -> Item {
    Item::Many(items.into_iter().flat_map(Item::values).collect())
}

fn first(arguments: Vec<Item>) -> Item {
    let mut arguments = arguments.into_iter();
    arguments.next().unwrap_or(Item::Many(Vec::new()))
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
