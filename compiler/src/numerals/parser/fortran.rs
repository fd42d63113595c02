//! Calls that are special in Fortran: `real(x, kind)`, `real(z'3FE0000000000000', real64)`, `reshape`.

use std::ops::Range;

use super::{Item, Parser};
use crate::error::{Error, ErrorKind};
use crate::numerals::fortran::double_of_bits;
use crate::numerals::tokens::Token;
use crate::numerals::value::Value;

impl Parser<'_, '_> {
    /// The value of such a call; `None` for other names.
    pub(super) fn fortran_call(
        &mut self,
        name: &str,
        span: &Range<usize>,
    ) -> Result<Option<Item>, Error> {
        let called = self.source_symbol(self.at) == Some('(');
        match name {
            "real" | "dble" if called => self.conversion().map(Some),
            "reshape" if called => self.reshaped(span).map(Some),
            _ => Ok(None),
        }
    }

    /// `real(0.5, kind)`, where the kind is not a number of the table.
    fn conversion(&mut self) -> Result<Item, Error> {
        self.at += 1;
        self.inside += 1;
        let item = match self.bits()? {
            Some(value) => Item::One(value),
            None => match self.expression()? {
                Item::One(value) => Item::One(value.with_whole(false)),
                list => list,
            },
        };
        if self.take(',') {
            self.pass_over(')');
        }
        if !self.take(')') {
            return Err(self.unexpected("`)`"));
        }
        self.inside -= 1;
        Ok(item)
    }

    /// The bits of a number of 64 bits, `z'3FE0000000000000', real64`.
    fn bits(&mut self) -> Result<Option<Value>, Error> {
        let (Some(Token::Name(name)), Some(Token::Text(range))) = (
            self.peek(),
            self.tokens.get(self.at + 1).map(|found| &found.token),
        ) else {
            return Ok(None);
        };
        if name != "z" {
            return Ok(None);
        }
        let kind = self.tokens.get(self.at + 3).map(|found| &found.token);
        let long = match kind {
            Some(Token::Name(kind)) => matches!(kind.as_str(), "real64" | "c_double"),
            Some(Token::Number(kind)) => kind.constant.to_string() == "8",
            _ => false,
        };
        let value = double_of_bits(&self.source.input.text[range.clone()]).filter(|_| long);
        let Some(value) = value else {
            return Err(self.unexpected("the bits of a `real64`"));
        };
        self.at += 2;
        Ok(Some(value))
    }

    /// `reshape(list, [m, n])` column by column, or `reshape(list, [m, n], order=[2, 1])` row by row.
    fn reshaped(&mut self, span: &Range<usize>) -> Result<Item, Error> {
        let by_rows = self.order_of_axes()?;
        self.at += 1;
        let items = self.items(')')?;
        let wrong = |message: &str| {
            let kind = ErrorKind::Document {
                message: message.to_owned(),
            };
            Err(self.wrong(span.clone(), kind))
        };
        let [Item::Many(values), Item::Many(shape)] = &items[..] else {
            return wrong("`reshape` needs a list and its shape");
        };
        let size = |value: &Value| {
            let whole = value.constant.as_rational().filter(|x| x.is_integer());
            whole.and_then(|x| usize::try_from(x.to_integer()).ok())
        };
        let sizes: Option<Vec<usize>> = shape.iter().map(size).collect();
        let Some([rows, columns]) = sizes.as_deref() else {
            return wrong("the shape of a matrix is two numbers");
        };
        if rows.checked_mul(*columns) != Some(values.len()) {
            return wrong("the shape does not fit the list");
        }
        if by_rows {
            return Ok(Item::Many(values.clone()));
        }
        let places = (0..*rows).flat_map(|i| (0..*columns).map(move |j| j * rows + i));
        Ok(Item::Many(places.map(|at| values[at].clone()).collect()))
    }

    /// Whether the call that begins here has the argument `order=[2, 1]`.
    fn order_of_axes(&self) -> Result<bool, Error> {
        let mut depth = 0_usize;
        for (length, found) in self.tokens[self.at..].iter().enumerate() {
            match &found.token {
                Token::Symbol('(' | '[') => depth += 1,
                Token::Symbol(')' | ']') => depth = depth.saturating_sub(1),
                Token::Name(name) if name == "order" && depth == 1 => {
                    let written: Vec<String> = self.tokens[self.at + length + 1..]
                        .iter()
                        .take(6)
                        .map(|token| match &token.token {
                            Token::Symbol(c) => c.to_string(),
                            Token::Number(value) => value.constant.to_string(),
                            _ => "?".to_owned(),
                        })
                        .collect();
                    if written.concat() == "=[2,1]" {
                        return Ok(true);
                    }
                    let message = "this order of the axes is not read; write `order=[2, 1]`";
                    let message = message.to_owned();
                    return Err(self.wrong(found.span.clone(), ErrorKind::Document { message }));
                }
                _ => {}
            }
            if depth == 0 {
                break;
            }
        }
        Ok(false)
    }
}
