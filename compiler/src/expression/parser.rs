//! Tokens to syntax trees, by recursive descent.

use std::ops::Range;

use super::lexer::{Token, tokenize};
use super::{Expression, ExpressionKind, Input, MAX_DEPTH, MAX_HEIGHT, Operator};
use crate::error::{Error, ErrorKind};

/// Reads a list of expressions, with or without brackets around it.
///
/// # Errors
/// Anything that does not follow the grammar of this module, at its place.
pub fn parse_list(input: Input<'_>) -> Result<Vec<Expression>, Error> {
    let tokens = tokenize(input)?;
    let mut parser = Parser {
        input,
        tokens,
        next: 0,
        depth: 0,
    };
    let items = if let Some(open) = parser.accept('[') {
        let items = parser.items()?;
        parser.close(open, ['[', ']'], "an operator, `,`")?;
        items
    } else {
        parser.items()?
    };
    match parser.peek() {
        (Token::End, _) => Ok(items),
        (Token::Symbol(c @ (')' | ']')), span) => {
            let partner = if *c == ')' { '(' } else { '[' };
            Err(input.error(
                span,
                ErrorKind::Unbalanced {
                    bracket: *c,
                    partner,
                },
            ))
        }
        _ => Err(parser.unexpected("an operator, `,` or the end")),
    }
}

/// The place of a row of a matrix, and its entries.
pub type Row = (Range<usize>, Vec<Expression>);

/// Reads a list of lists in brackets, a row each: `[[0, 0], [1/2, 1/2]]`.
///
/// # Errors
/// Anything that does not follow the grammar of this module, at its place.
pub fn parse_matrix(input: Input<'_>) -> Result<Vec<Row>, Error> {
    const SHAPE: &str = "`[`; a matrix is a list of rows: [[0, 0], [1/2, 1/2]]";
    let tokens = tokenize(input)?;
    let mut parser = Parser {
        input,
        tokens,
        next: 0,
        depth: 0,
    };
    let open = parser.accept('[').ok_or_else(|| parser.unexpected(SHAPE))?;
    let mut rows = Vec::new();
    loop {
        let row = parser.accept('[').ok_or_else(|| parser.unexpected(SHAPE))?;
        let items = parser.items()?;
        let close = parser.close(row.clone(), ['[', ']'], "an operator, `,`")?;
        rows.push((row.start..close.end, items));
        let more = parser.accept(',').is_some();
        if !more || parser.peek().0 == Token::Symbol(']') {
            break;
        }
    }
    parser.close(open, ['[', ']'], "`,`")?;
    match parser.peek().0 {
        Token::End => Ok(rows),
        _ => Err(parser.unexpected("the end")),
    }
}

struct Parser<'a> {
    input: Input<'a>,
    tokens: Vec<(Token, Range<usize>)>,
    next: usize,
    depth: usize,
}

impl Parser<'_> {
    fn peek(&self) -> &(Token, Range<usize>) {
        &self.tokens[self.next.min(self.tokens.len() - 1)]
    }

    fn accept(&mut self, symbol: char) -> Option<Range<usize>> {
        let (token, span) = self.peek().clone();
        (token == Token::Symbol(symbol)).then(|| {
            self.next += 1;
            span
        })
    }

    fn unexpected(&self, expected: &str) -> Error {
        let (token, span) = self.peek();
        let found = token.describe(&self.input.text[span.clone()]);
        self.input.error(
            span,
            ErrorKind::Syntax {
                found,
                expected: expected.to_owned(),
            },
        )
    }

    /// The end of what an opening bracket began; `inside` is what could have gone on there.
    fn close(
        &mut self,
        open: Range<usize>,
        [bracket, partner]: [char; 2],
        inside: &str,
    ) -> Result<Range<usize>, Error> {
        if let Some(span) = self.accept(partner) {
            return Ok(span);
        }
        // Is the partner missing, or does something stand before it?
        let mut depth = 0;
        let closes = self.tokens[self.next..].iter().any(|(token, _)| {
            depth += i32::from(*token == Token::Symbol(bracket));
            depth -= i32::from(*token == Token::Symbol(partner));
            depth < 0
        });
        if closes {
            Err(self.unexpected(&format!("{inside} or `{partner}`")))
        } else {
            Err(self
                .input
                .error(&open, ErrorKind::Unbalanced { bracket, partner }))
        }
    }

    fn items(&mut self) -> Result<Vec<Expression>, Error> {
        let mut items = vec![self.expression()?];
        while self.accept(',').is_some() {
            // A comma may end the list, as in Rust.
            if matches!(self.peek().0, Token::End | Token::Symbol(']' | ')')) {
                break;
            }
            items.push(self.expression()?);
        }
        Ok(items)
    }

    fn expression(&mut self) -> Result<Expression, Error> {
        self.chain(
            &[('+', Operator::Add), ('-', Operator::Subtract)],
            Self::term,
        )
    }

    fn term(&mut self) -> Result<Expression, Error> {
        self.chain(
            &[('*', Operator::Multiply), ('/', Operator::Divide)],
            Self::factor,
        )
    }

    fn chain(
        &mut self,
        operators: &[(char, Operator)],
        operand: fn(&mut Self) -> Result<Expression, Error>,
    ) -> Result<Expression, Error> {
        let mut left = operand(self)?;
        while let Some(&(_, operator)) = operators
            .iter()
            .find(|(symbol, _)| self.peek().0 == Token::Symbol(*symbol))
        {
            self.next += 1;
            left = binary(operator, left, operand(self)?);
            self.check_size(
                "its number of operators in a row and inside one another",
                left.height,
                MAX_HEIGHT,
            )?;
        }
        Ok(left)
    }

    fn factor(&mut self) -> Result<Expression, Error> {
        self.depth += 1;
        self.check_size("its depth", self.depth, MAX_DEPTH)?;
        let factor = if let Some(minus) = self.accept('-') {
            let inner = self.factor()?;
            let span = minus.start..inner.span.end;
            Expression::new(ExpressionKind::Negate(Box::new(inner)), span)
        } else if self.accept('+').is_some() {
            self.factor()?
        } else {
            let base = self.atom()?;
            match self.accept('^') {
                Some(_) => binary(Operator::Power, base, self.factor()?),
                None => base,
            }
        };
        self.depth -= 1;
        Ok(factor)
    }

    fn atom(&mut self) -> Result<Expression, Error> {
        let (token, span) = self.peek().clone();
        match token {
            Token::Number(value) => {
                self.next += 1;
                Ok(Expression::new(ExpressionKind::Number(value), span))
            }
            Token::Name(name) => {
                self.next += 1;
                let Some(open) = self.accept('(') else {
                    return Ok(Expression::new(ExpressionKind::Name(name), span));
                };
                let empty = self.peek().0 == Token::Symbol(')');
                let arguments = if empty { Vec::new() } else { self.items()? };
                let close = self.close(open, ['(', ')'], "an operator, `,`")?;
                let whole = span.start..close.end;
                let kind = ExpressionKind::Call {
                    function: name,
                    name: span,
                    arguments,
                };
                Ok(Expression::new(kind, whole))
            }
            Token::Symbol('(') => {
                self.next += 1;
                let inner = self.expression()?;
                let close = self.close(span.clone(), ['(', ')'], "an operator")?;
                Ok(Expression {
                    span: span.start..close.end,
                    ..inner
                })
            }
            Token::Symbol(c @ (')' | ']')) if self.next == 0 => {
                let partner = if c == ')' { '(' } else { '[' };
                Err(self.input.error(
                    &span,
                    ErrorKind::Unbalanced {
                        bracket: c,
                        partner,
                    },
                ))
            }
            _ => Err(self.unexpected("a number, a name or `(`")),
        }
    }

    fn check_size(&self, what: &'static str, size: usize, limit: usize) -> Result<(), Error> {
        if size > limit {
            return Err(self.input.error(
                &self.peek().1,
                ErrorKind::ExpressionSize { what, size, limit },
            ));
        }
        Ok(())
    }
}

fn binary(operator: Operator, left: Expression, right: Expression) -> Expression {
    let span = left.span.start..right.span.end;
    Expression::new(
        ExpressionKind::Binary {
            operator,
            left: Box::new(left),
            right: Box::new(right),
        },
        span,
    )
}
