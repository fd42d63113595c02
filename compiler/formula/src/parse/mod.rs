//! From text to a [`Definition`].
//!
//! ```text
//! system     = [ name [ "<" lengths ">" ] ] [ "{" parameters "}" ] { statement }
//! parameter  = name [ ":" ( number | "[" shape "]" | "pairs" ) ]
//! statement  = "q" ":" coordinates "," ( "p" | "v" ) ":" coordinates [ "," "v" ":" coordinates ] ";"
//!              coordinates = "[" names | length [ ";" number ] "]"
//!            | "bonds" ":" ( "walls" | "free" | "ring" ) ";"
//!            | "extern" "fn" name "with" name "," name ";"
//!            | "let" name [ "(" names ")" ] "=" expression ";"
//!            | ( "H" | "L" ) "=" expression
//!            | "constraints" ":" "{" name [ "(" over ")" ] "=" expression { "," … } "}"
//!            | "force" ":" "{" ( name | "q" "[" expression "]" [ "(" over ")" ] ) "=" expression { "," … } "}"
//!            | "nonholonomic" ":" "{" name [ "(" over ")" ] "=" expression { "," … } "}"
//!            | "friction" ":" expression
//!            | "invariants" ":" "{" name "=" expression { "," … } "}"
//!            | "require" ":" "[" names "]"
//! expression = term { ("+" | "-") term }      term = factor { [ "*" | "/" ] factor }      factor = { "-" } atom [ "^" factor | raised ]
//! atom       = number | name | name "(" list ")" | atom "[" list "]" | "(" expression ")" | "|" expression "|" | "[" list "]"
//!            | "√" atom | "sum" "(" over ":" expression ")"
//! over       = name [ "in" expression ".." expression ] | name "<" name | "bonds" name | [ name "=" ] "(" name "," name ")" "in" name
//! ```
//!
//! Factors that follow one another are multiplied: `2 pa pb cos(d)`. Powers and roots may be written as they are printed: `x²`, `√(x + 1)`.

mod form;
mod statements;
mod tokens;
mod unknown;

use num_rational::BigRational;
use num_traits::{One, ToPrimitive, Zero};

pub use self::form::form;
use self::tokens::{Token, tokenize};
pub use self::unknown::{suggestion, unknown_function, unknown_length};
use super::function::Function;
use super::syntax::{Definition, Expression, Form, Kind, Name, Over, Span};
use symplectic_exact::error::FormulaError;
use symplectic_exact::error::{Error, ErrorKind};
use symplectic_exact::input::Input;

/// The deepest nesting of parentheses.
const MAX_DEPTH: usize = 64;
/// Words that are not names.
const KEYWORDS: [&str; 13] = [
    "H",
    "q",
    "p",
    "t",
    "pi",
    "let",
    "sum",
    "in",
    "bonds",
    "extern",
    "fn",
    "invariants",
    "require",
];

/// Words that begin a statement if `:` follows, and are names elsewhere.
const STATEMENTS: [&str; 5] = ["constraints", "force", "nonholonomic", "friction", "v"];

/// Reads a definition.
///
/// # Errors
/// Any violation of the grammar, at its place.
pub fn parse(input: Input<'_>, form: Form) -> Result<Definition, Error> {
    Parser::new(input, form)?.definition()
}

/// Reads a definition, and the expression from `from` to the end of the text, which has its names, as one more invariant without a name.
///
/// # Errors
/// Any violation of the grammar, at its place.
pub(super) fn parse_with(input: Input<'_>, form: Form, from: usize) -> Result<Definition, Error> {
    let Input { name, text } = input;
    let (text, expression) = text.split_at(from);
    let mut parser = Parser::new(Input { name, text }, form)?;
    let mut definition = parser.definition()?;
    let own = Input {
        name,
        text: expression,
    };
    let tokens = tokenize(own).map_err(|mut error| {
        if let Some(place) = &mut error.place {
            place.span = place.span.start + from..place.span.end + from;
        }
        error
    })?;
    let moved = |(token, span): (Token, Span)| (token, span.start + from..span.end + from);
    parser.tokens = tokens.into_iter().map(moved).collect();
    (parser.input, parser.next, parser.whole) = (input, 0, "expression");
    let value = parser.expression()?;
    if *parser.peek() != Token::End {
        return Err(parser.unexpected("an operator or the end of the expression"));
    }
    let name = Name {
        text: String::new(),
        span: value.span.clone(),
    };
    definition.invariants.push((name, value));
    Ok(definition)
}

struct Parser<'a> {
    input: Input<'a>,
    form: Form,
    tokens: Vec<(Token, Span)>,
    next: usize,
    /// What is read, for messages.
    whole: &'static str,
    depth: usize,
    /// The user's functions, and abbreviations with arguments.
    calls: Vec<String>,
    /// For every open bracket whether it is a bar.
    in_bars: Vec<bool>,
}

impl<'a> Parser<'a> {
    fn new(input: Input<'a>, form: Form) -> Result<Self, Error> {
        Ok(Parser {
            input,
            form,
            tokens: tokenize(input)?,
            next: 0,
            whole: "definition",
            depth: 0,
            calls: Vec::new(),
            in_bars: Vec::new(),
        })
    }

    fn peek(&self) -> &Token {
        self.ahead(0)
    }

    fn ahead(&self, by: usize) -> &Token {
        &self.tokens[(self.next + by).min(self.tokens.len() - 1)].0
    }

    fn span(&self) -> Span {
        self.tokens[self.next.min(self.tokens.len() - 1)].1.clone()
    }

    /// The end of the previous token.
    fn end(&self) -> usize {
        self.next
            .checked_sub(1)
            .map_or(0, |last| self.tokens[last].1.end)
    }

    fn is(&self, symbol: char) -> bool {
        *self.peek() == Token::Symbol(symbol)
    }

    fn accept(&mut self, symbol: char) -> bool {
        let found = self.is(symbol);
        self.next += usize::from(found);
        found
    }

    fn expect(&mut self, symbol: char, expected: &str) -> Result<(), Error> {
        match self.accept(symbol) {
            true => Ok(()),
            false => Err(self.unexpected(expected)),
        }
    }

    /// Reads the closing partner of an open bracket.
    fn close(&mut self, open: &Span, [bracket, partner]: [char; 2]) -> Result<(), Error> {
        if self.accept(partner) {
            return Ok(());
        }
        if *self.peek() == Token::End {
            return Err(self
                .input
                .error(open, ErrorKind::Unbalanced { bracket, partner }));
        }
        Err(self.unexpected(&format!("an operator or `{partner}`")))
    }

    fn unexpected(&self, expected: &str) -> Error {
        let span = self.span();
        let found = match self.peek() {
            Token::End => format!("the {} ends", self.whole),
            _ => format!("found `{}`", &self.input.text[span.clone()]),
        };
        let expected = self.instead().unwrap_or_else(|| expected.to_owned());
        self.input
            .error(&span, ErrorKind::Syntax { found, expected })
    }

    fn word(&self, word: &str) -> bool {
        matches!(self.peek(), Token::Name(name) if name == word)
    }

    fn accept_word(&mut self, word: &str) -> bool {
        let found = self.word(word);
        self.next += usize::from(found);
        found
    }

    fn name(&mut self, expected: &str) -> Result<Name, Error> {
        let Token::Name(text) = self.peek().clone() else {
            return Err(self.unexpected(expected));
        };
        let span = self.span();
        self.next += 1;
        Ok(Name { text, span })
    }

    fn is_keyword(&self, word: &str) -> bool {
        KEYWORDS.contains(&word) || word == self.form.function() || word == self.form.second()
    }

    /// A name of the user's choice.
    fn new_name(&mut self, expected: &str) -> Result<Name, Error> {
        let name = self.name(expected)?;
        let meaning = match name.text.as_str() {
            "t" => "the time",
            "pi" | "π" => "the number π",
            "q" => "the positions",
            "p" => "the momenta",
            "H" => "the Hamiltonian",
            "v" if self.form == Form::Lagrangian => "the velocities",
            "L" if self.form == Form::Lagrangian => "the Lagrangian",
            word if KEYWORDS.contains(&word) => "a word of the language",
            word if is_function(word) => "a function",
            _ => return Ok(name),
        };
        Err(self.taken(name, meaning))
    }

    /// A name of the user's choice that the generated code contains.
    fn new_rust_name(&mut self, expected: &str) -> Result<Name, Error> {
        let name = self.new_name(expected)?;
        match name.text.as_str() {
            // Other words of Rust become raw identifiers.
            "self" | "Self" | "super" | "crate" | "_" => Err(self.taken(name, "a word of Rust")),
            _ => Ok(name),
        }
    }

    fn taken(&self, name: Name, meaning: &str) -> Error {
        let kind = FormulaError::Taken {
            name: name.text,
            meaning: meaning.to_owned(),
        };
        self.input.error(&name.span, kind.into())
    }

    fn list(&mut self, end: char) -> Result<Vec<Expression>, Error> {
        let mut items = Vec::new();
        while !self.is(end) {
            items.push(self.expression()?);
            if !self.accept(',') {
                break;
            }
        }
        Ok(items)
    }

    /// Reads an expression one nesting level deeper.
    fn deeper<T>(&mut self, read: impl FnOnce(&mut Self) -> Result<T, Error>) -> Result<T, Error> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            let kind = ErrorKind::ExpressionSize {
                what: "its depth",
                size: self.depth,
                limit: MAX_DEPTH,
            };
            return Err(self.input.error(&self.span(), kind));
        }
        let value = read(self)?;
        self.depth -= 1;
        Ok(value)
    }

    fn expression(&mut self) -> Result<Expression, Error> {
        self.deeper(Self::sum_of_terms)
    }

    fn sum_of_terms(&mut self) -> Result<Expression, Error> {
        let start = self.span().start;
        let first = (self.accept('-'), self.term()?);
        let mut terms = vec![first];
        loop {
            let minus = self.is('-');
            if !minus && !self.is('+') {
                break;
            }
            self.next += 1;
            terms.push((minus, self.term()?));
        }
        let span = start..self.end();
        Ok(match terms.len() == 1 && !terms[0].0 {
            true => terms.remove(0).1,
            false => Expression {
                kind: Kind::Sum(terms),
                span,
            },
        })
    }

    /// Whether a factor begins here that multiplies the previous one.
    fn factor_follows(&self) -> bool {
        match self.peek() {
            Token::Number(_) | Token::Symbol('(' | '√') => true,
            Token::Symbol('|') => self.in_bars.last() != Some(&true),
            Token::Name(name) => {
                let other = match self.ahead(1) {
                    Token::Symbol(':') if STATEMENTS.contains(&name.as_str()) => true,
                    // A word of this kind that is misspelt.
                    Token::Symbol(':') if *self.ahead(2) == Token::Symbol('{') => true,
                    Token::Symbol(':' | '=') => self.is_keyword(name),
                    _ => false,
                };
                !other
                    && !matches!(
                        name.as_str(),
                        "in" | "let" | "extern" | "fn" | "invariants" | "require" | "H"
                    )
                    && name != self.form.function()
            }
            _ => false,
        }
    }

    fn term(&mut self) -> Result<Expression, Error> {
        let start = self.span().start;
        let mut factors = vec![(false, self.factor()?)];
        let mut divided = false;
        loop {
            let divide = self.is('/');
            if divide || self.is('*') || self.is('×') || self.is('·') {
                if self.is('×') || self.is('·') {
                    let name = if self.is('×') { "cross" } else { "dot" };
                    let name = Name {
                        text: name.to_owned(),
                        span: self.span(),
                    };
                    self.next += 1;
                    let (_, left) = factors.pop().unwrap_or_else(|| unreachable!());
                    let right = self.factor()?;
                    let span = left.span.start..right.span.end;
                    let call = Kind::Call(name, vec![left, right]);
                    factors.push((false, Expression { kind: call, span }));
                    continue;
                }
                self.next += 1;
                divided = divide;
            } else if self.factor_follows() {
                if divided {
                    let last = factors.last().map_or(start, |(_, last)| last.span.start);
                    let span = last..self.span().end;
                    return Err(self
                        .input
                        .error(&span, FormulaError::AmbiguousQuotient.into()));
                }
                if let Token::Number(_) = self.peek() {
                    return Err(
                        self.unexpected("an operator: a number is not written after a factor")
                    );
                }
            } else {
                break;
            }
            factors.push((divide, self.factor()?));
        }
        let span = start..self.end();
        Ok(match factors.len() {
            1 => factors.remove(0).1,
            _ => Expression {
                kind: Kind::Product(factors),
                span,
            },
        })
    }

    fn factor(&mut self) -> Result<Expression, Error> {
        let start = self.span().start;
        if self.accept('-') {
            let inner = self.deeper(Self::factor)?;
            let span = start..inner.span.end;
            return Ok(Expression {
                kind: Kind::Sum(vec![(true, inner)]),
                span,
            });
        }
        let base = self.entry()?;
        let exponent = match self.peek().clone() {
            Token::Raised(number) => {
                let span = self.span();
                self.next += 1;
                if self.is('^') {
                    let expected = "parentheses around this power: `(x²)^3`";
                    return Err(self.unexpected(expected));
                }
                let kind = Kind::Number(number);
                Expression { kind, span }
            }
            _ if self.accept('^') => self.deeper(Self::factor)?,
            _ => return Ok(base),
        };
        let span = start..self.end();
        Ok(Expression {
            kind: Kind::Power(Box::new(base), Box::new(exponent)),
            span,
        })
    }

    fn entry(&mut self) -> Result<Expression, Error> {
        let start = self.span().start;
        let mut value = self.atom()?;
        while self.is('[') {
            let indices = self.within(['[', ']'], |parser| parser.list(']'))?;
            value = Expression {
                kind: Kind::Entry(Box::new(value), indices),
                span: start..self.end(),
            };
        }
        Ok(value)
    }

    /// Reads the contents of brackets, with their end; `|` opens a length there.
    fn within<T>(
        &mut self,
        brackets: [char; 2],
        read: impl FnOnce(&mut Self) -> Result<T, Error>,
    ) -> Result<T, Error> {
        let open = self.span();
        self.next += 1;
        self.in_bars.push(brackets[0] == '|');
        let value = read(self)?;
        self.in_bars.pop();
        self.close(&open, brackets)?;
        Ok(value)
    }

    fn atom(&mut self) -> Result<Expression, Error> {
        let span = self.span();
        let start = span.start;
        let kind = match self.peek().clone() {
            Token::Number(value) => {
                self.next += 1;
                Kind::Number(value)
            }
            Token::Name(name) if name == "sum" => {
                self.next += 1;
                if !self.is('(') {
                    return Err(self.unexpected("`(`: `sum(i: p[i]^2)`"));
                }
                self.within(['(', ')'], Self::total)?
            }
            Token::Name(text)
                if is_function(&text)
                    || self.calls.contains(&text) && *self.ahead(1) == Token::Symbol('(') =>
            {
                self.next += 1;
                if !self.is('(') {
                    let power = match self.peek() {
                        Token::Symbol('^') | Token::Raised(_) => {
                            format!(": the square is `{text}(x)^2`")
                        }
                        _ => String::new(),
                    };
                    let expected = format!("`(` and the argument of `{text}`{power}");
                    return Err(self.unexpected(&expected));
                }
                let arguments = self.within(['(', ')'], |parser| parser.list(')'))?;
                Kind::Call(Name { text, span }, arguments)
            }
            Token::Name(text) => {
                self.next += 1;
                Kind::Name(text)
            }
            Token::Symbol('(') => {
                let called = self.name_before();
                let inner = self.within(['(', ')'], |parser| {
                    let inner = parser.expression()?;
                    match called {
                        // A product has no list.
                        Some(name) if parser.is(',') => Err(unknown_function(parser.input, &name)),
                        _ => Ok(inner),
                    }
                })?;
                // A sum or product in parentheses stays separate.
                return Ok(Expression {
                    span: start..self.end(),
                    ..inner
                });
            }
            Token::Symbol('√') => {
                self.next += 1;
                let name = Name {
                    text: "sqrt".to_owned(),
                    span,
                };
                let argument = self.deeper(Self::entry)?;
                if matches!(self.peek(), Token::Symbol('^') | Token::Raised(_)) {
                    return Err(self.unexpected("parentheses: `√(x²)` or `(√x)²`"));
                }
                Kind::Call(name, vec![argument])
            }
            Token::Symbol('[') => Kind::List(self.within(['[', ']'], |parser| parser.list(']'))?),
            Token::Symbol('|') => Kind::Bars(Box::new(self.within(['|', '|'], Self::expression)?)),
            _ => return Err(self.unexpected("a number, a name, `(` or `|`")),
        };
        Ok(Expression {
            kind,
            span: start..self.end(),
        })
    }

    fn total(&mut self) -> Result<Kind, Error> {
        let over = self.over()?;
        self.expect(':', "`:` and the terms of the sum")?;
        Ok(Kind::Total(Box::new(over), Box::new(self.expression()?)))
    }

    /// The range of a sum or of a family of constraints.
    pub(super) fn over(&mut self) -> Result<Over, Error> {
        const OVER: &str =
            "what the sum goes over: `i`, `i in 0..N`, `i < j`, `bonds d` or `(i, j) in pairs`";
        if self.accept_word("bonds") {
            let stretch = self.new_name("a name for the stretch of a bond")?;
            return Ok(Over::Bonds(stretch));
        }
        if self.is('(') {
            return self.pair_list(None);
        }
        let index = self.new_name(OVER)?;
        if self.accept('=') {
            if !self.is('(') {
                let index = &index.text;
                return Err(self.unexpected(&format!(
                    "`in` for a range without its end, `sum({index} in 0..N: …)`, or pairs, `sum({index} = (i, j) in pairs: …)`"
                )));
            }
            self.pair_list(Some(index))
        } else if self.accept('<') {
            let other = self.new_name("the other index: `i < j`")?;
            Ok(Over::Pairs(index, other))
        } else if self.accept_word("in") {
            let from = self.expression()?;
            for _ in 0..2 {
                self.expect('.', "`..`: a range is written `0..N`")?;
            }
            if self.is('=') {
                return Err(self.unexpected("the index after the last: `0..3` is 0, 1, 2"));
            }
            Ok(Over::Range(index, Some([from, self.expression()?])))
        } else {
            Ok(Over::Range(index, None))
        }
    }

    fn pair_list(&mut self, number: Option<Name>) -> Result<Over, Error> {
        const FORM: &str = "`(i, j) in pairs`";
        self.expect('(', FORM)?;
        let first = self.new_name(FORM)?;
        self.expect(',', FORM)?;
        let second = self.new_name(FORM)?;
        self.expect(')', FORM)?;
        if !self.accept_word("in") {
            return Err(self.unexpected(FORM));
        }
        let list = self.name("a parameter of pairs")?;
        Ok(Over::List {
            number,
            indices: [first, second],
            list,
        })
    }
}

fn is_function(name: &str) -> bool {
    Function::find(name).is_some() || VECTOR_FUNCTIONS.contains(&name) || JUMPS.contains(&name)
}

/// The functions of vectors, and of several numbers.
pub const VECTOR_FUNCTIONS: [&str; 8] = [
    "norm", "dot", "cross", "hypot", "atan2", "abs", "max", "min",
];

/// Functions that are recognised, and rejected with a reason.
pub const JUMPS: [&str; 5] = ["sign", "floor", "ceil", "round", "mod"];

/// The value of a numeric expression.
pub fn constant(expression: &Expression) -> Option<BigRational> {
    Some(match &expression.kind {
        Kind::Number(value) => value.clone(),
        Kind::Sum(terms) => {
            let mut sum = BigRational::zero();
            for (minus, term) in terms {
                let value = constant(term)?;
                sum = if *minus { sum - value } else { sum + value };
            }
            sum
        }
        Kind::Product(factors) => {
            let mut product = BigRational::one();
            for (divide, factor) in factors {
                let value = constant(factor)?;
                if *divide && value.is_zero() {
                    return None;
                }
                product = if *divide {
                    product / value
                } else {
                    product * value
                };
            }
            product
        }
        Kind::Power(base, exponent) => {
            let (base, exponent) = (constant(base)?, constant(exponent)?);
            let exponent = exponent.is_integer().then(|| exponent.to_i32()).flatten()?;
            if exponent.abs() > 400
                || (base.is_zero() && exponent < 0)
                || base.numer().bits().max(base.denom().bits()) > 64
            {
                return None;
            }
            let power = num_traits::pow(base, exponent.unsigned_abs() as usize);
            if exponent < 0 { power.recip() } else { power }
        }
        _ => return None,
    })
}
