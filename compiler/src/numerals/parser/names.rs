//! The meaning of a name: a variable, an element of a list, a call, or the type of a list.

use std::ops::Range;

use super::{Combine, Item, Parser, joined};
use crate::error::{Error, ErrorKind};
use crate::expression::shown;
use crate::library::Notation;
use crate::numerals::source::Assigned;
use crate::numerals::tokens::Token;
use crate::numerals::value::Value;

impl Parser<'_, '_> {
    /// A variable, an element, a call, or a list preceded by the type of its entries.
    pub(super) fn named(&mut self, name: &str, span: Range<usize>) -> Result<Item, Error> {
        if self.source.fortran
            && let Some(item) = self.fortran_call(name, &span)?
        {
            return Ok(item);
        }
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
                if open == '<' {
                    self.no_integer()?;
                }
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
        let entry = self.source.fortran && self.source.has(name);
        match self.source_symbol(self.at) {
            Some('(') if entry => {
                self.at += 1;
                let items = self.items(')')?;
                self.element(name, span, items)
            }
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
                // The type of the entries.
                let types = self.source.notation == Notation::Julia && TYPES.contains(&name);
                match types {
                    true => Ok(joined(items)),
                    false => Err(self.no_value(name, span)),
                }
            }
            _ => self.variable(name, span),
        }
    }

    /// Rejects `static_cast<int>`, which truncates a number.
    fn no_integer(&self) -> Result<(), Error> {
        const INTEGERS: [&str; 8] = [
            "int", "unsigned", "short", "char", "bool", "size_t", "int32_t", "int64_t",
        ];
        match self.tokens.get(self.at + 1) {
            Some(found) if matches!(&found.token, Token::Name(name) if INTEGERS.contains(&name.as_str())) =>
            {
                let message = "a number is cut to an integer here".to_owned();
                Err(self.wrong(found.span.clone(), ErrorKind::Document { message }))
            }
            _ => Ok(()),
        }
    }

    fn no_value(&self, name: &str, span: Range<usize>) -> Error {
        let kind = ErrorKind::Syntax {
            found: format!("found `{}`, which has no value here", shown(name)),
            expected: "a number".to_owned(),
        };
        self.wrong(span, kind)
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
                self.source.whole(name, *value, self.depth)?
            }
            Some(_) => {
                let list = self.source.list_within(name, self.depth)?;
                let list = list.map(|list| self.source.copy(name, &list)).transpose()?;
                Item::Many(list.unwrap_or_default())
            }
            None => return Err(self.no_value(name, span)),
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
            (None, Some(_)) if self.source.bounded.contains(name) => {
                let message =
                    format!("`{name}` has a lower bound of its own; write the list from 1");
                return Err(self.wrong(span, ErrorKind::Document { message }));
            }
            (None, Some(index)) => {
                let list = self.source.list_within(name, self.depth)?;
                let one_based = self.source.notation == Notation::Julia || self.source.fortran;
                let found = index
                    .checked_sub(usize::from(one_based))
                    .and_then(|index| list.and_then(|list| list.get(index).cloned()));
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

    /// A function of one or two numbers, or a conversion, which keeps the number.
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
        // A vector of several numbers; in C++ several arguments mean something else.
        let vectors = matches!(
            self.source.notation,
            Notation::Julia | Notation::Python | Notation::Mathematica
        );
        // The precision, or the kind in Fortran, is not a number of the table.
        let second = matches!(name, "N" | "mpf" | "Float") || plain == "real";
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
            ("integer", 1) => match &arguments[..] {
                [Item::One(value)]
                    if value.constant.as_rational().is_some_and(|x| x.is_integer()) =>
                {
                    Ok(first(arguments))
                }
                _ => wrong("an integer"),
            },
            ("rational" | "fraction", 1) => Ok(first(arguments)),
            ("svector" | "vector" | "array", 2..) if vectors => Ok(joined(arguments)),
            (conversion, 1) if CONVERSIONS.contains(&conversion) => Ok(first(arguments)),
            (_, 2) if second && matches!(arguments[1], Item::One(_)) => Ok(first(arguments)),
            (conversion, _) if CONVERSIONS.contains(&conversion) => wrong("one argument"),
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

/// Julia types that may precede a list of their numbers.
const TYPES: [&str; 13] = [
    "SA", "T", "T2", "Float64", "Float32", "BigFloat", "Rational", "BigInt", "Int", "Int64",
    "Real", "Number", "Any",
];

/// The first argument, which becomes a real number of its language.
fn first(arguments: Vec<Item>) -> Item {
    match arguments.into_iter().next() {
        Some(Item::One(value)) => Item::One(value.with_whole(false)),
        Some(list) => list,
        None => Item::Many(Vec::new()),
    }
}
