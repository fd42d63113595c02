//! Definitions, parameters and statements.

use num_traits::ToPrimitive;

use super::tokens::Token;
use super::unknown::{suggestion, unknown_length};
use super::{Parser, STATEMENTS, constant};
use crate::syntax::{
    Abbreviation, Constraint, Coordinates, CoordinatesKind, Definition, Ends, Expression, Force,
    Form, Kind, Length, Name, Parameter, ParameterKind, Span,
};
use symplectic_exact::error::FormulaError;
use symplectic_exact::error::{Error, ErrorKind};

impl Parser<'_> {
    pub(super) fn definition(&mut self) -> Result<Definition, Error> {
        let mut definition = Definition {
            form: self.form,
            name: self.name_of_system()?,
            lengths: Vec::new(),
            parameters: Vec::new(),
            coordinates: [None, None],
            ends: None,
            functions: Vec::new(),
            abbreviations: Vec::new(),
            function: None,
            constraints: Vec::new(),
            forces: Vec::new(),
            velocities: None,
            nonholonomic: Vec::new(),
            friction: None,
            invariants: Vec::new(),
            required: Vec::new(),
        };
        if self.accept('<') {
            while !self.is('>') {
                let length = self.new_rust_name("a length such as `N`, or `>`")?;
                if !length.text.starts_with(char::is_uppercase) {
                    let kind = ErrorKind::Type {
                        found: format!("the length `{}`", length.text),
                        expected: "a name that begins with a capital letter".to_owned(),
                    };
                    return Err(self.input.error(&length.span, kind));
                }
                definition.lengths.push(length);
                if !self.accept(',') {
                    break;
                }
            }
            self.expect('>', "`,` or `>`")?;
        }
        let open = self.span();
        if self.accept('{') {
            while !self.is('}') {
                let parameter = self.parameter(&definition)?;
                definition.parameters.push(parameter);
                if !self.accept(',') {
                    break;
                }
            }
            self.close(&open, ['{', '}'])?;
        }
        while *self.peek() != Token::End {
            self.statement(&mut definition)?;
        }
        if let (Some(velocities), []) = (&definition.velocities, &definition.nonholonomic[..]) {
            return Err(self.other_form("v".to_owned(), &velocities.span));
        }
        Ok(definition)
    }

    /// The name of the system, which only code needs.
    fn name_of_system(&mut self) -> Result<Name, Error> {
        let is_first = |word: &str| matches!(self.peek(), Token::Name(name) if name == word);
        let is_coordinates = is_first("q") && *self.ahead(1) == Token::Symbol(':');
        if self.is('{') || is_coordinates || is_first("let") {
            return Ok(Name {
                text: "System".to_owned(),
                span: 0..0,
            });
        }
        self.name("the name of the system, its parameters or `q: […]`")
    }

    /// The name of a Rust function; it must differ from the names in the generated code of a system.
    fn function_name(&mut self, expected: &str) -> Result<Name, Error> {
        let name = self.new_rust_name(expected)?;
        let letters = name.text.trim_end_matches(|c: char| c.is_ascii_digit());
        let used = ["i", "j", "k", "l", "m", "n", "u", "v", "w", "x", "y", "z"];
        let words = [
            "velocity", "force", "jacobian", "time", "value", "position", "stretch",
        ];
        if used.contains(&letters)
            || words.contains(&name.text.as_str())
            || name.text.contains("result_")
        {
            return Err(self.taken(name, "a name in the code of a system"));
        }
        Ok(name)
    }

    fn parameter(&mut self, definition: &Definition) -> Result<Parameter, Error> {
        let name = self.new_rust_name("a parameter such as `g: 9.81`, or `}`")?;
        let kind = if !self.accept(':') {
            ParameterKind::Number(None)
        } else if self.accept_word("pairs") {
            ParameterKind::Pairs
        } else if self.is('[') {
            let open = self.span();
            self.next += 1;
            let mut lengths = vec![self.length(definition)?];
            if self.accept(';') || self.accept(',') {
                lengths.push(self.length(definition)?);
            }
            self.close(&open, ['[', ']'])?;
            ParameterKind::Array(lengths)
        } else {
            let value = self.expression()?;
            let Some(number) = constant(&value) else {
                let kind = ErrorKind::Type {
                    found: format!("`{}`", &self.input.text[value.span.clone()]),
                    expected: "a number, a shape such as `[N]` or `[3, 3]`, or `pairs`".to_owned(),
                };
                return Err(self.input.error(&value.span, kind));
            };
            ParameterKind::Number(Some(number))
        };
        Ok(Parameter { name, kind })
    }

    /// A length in a shape.
    fn length(&mut self, definition: &Definition) -> Result<Length, Error> {
        const EXPECTED: &str =
            "a length: a number, a name between the `<…>` of the system, or `..`";
        if self.accept('.') {
            self.expect('.', EXPECTED)?;
            return Ok(Length::Runtime);
        }
        let span = self.span();
        match self.peek().clone() {
            Token::Number(number) => {
                self.next += 1;
                let length = number.to_usize().filter(|&n| number.is_integer() && n > 0);
                let Some(length) = length.filter(|&n| n <= 1_000_000) else {
                    let kind = ErrorKind::Type {
                        found: format!("the length {number}"),
                        expected: "a whole number from 1 to 1000000".to_owned(),
                    };
                    return Err(self.input.error(&span, kind));
                };
                Ok(Length::Fixed(length))
            }
            Token::Name(text) => {
                self.next += 1;
                let pairs = |parameter: &&Parameter| {
                    parameter.name.text == text && matches!(parameter.kind, ParameterKind::Pairs)
                };
                if definition.lengths.iter().any(|length| length.text == text) {
                    Ok(Length::Generic(text))
                } else if definition.parameters.iter().find(pairs).is_some() {
                    Ok(Length::PairsOf(text))
                } else {
                    let name = Name { text, span };
                    Err(unknown_length(self.input, definition, &name))
                }
            }
            _ => Err(self.unexpected(EXPECTED)),
        }
    }

    fn statement(&mut self, definition: &mut Definition) -> Result<(), Error> {
        let span = self.span();
        let twice = |parser: &Self, part: &str| {
            let part = part.to_owned();
            Err(parser
                .input
                .error(&span, FormulaError::Twice { part }.into()))
        };
        let Token::Name(word) = self.peek().clone() else {
            return Err(self.unexpected(statement(self.form)));
        };
        self.next += 1;
        match word.as_str() {
            word if word == "q" || word == self.form.second() => {
                let half = usize::from(word != "q");
                let example = self.form.coordinates();
                self.expect(':', &format!("`:` and the coordinates: `{example}`"))?;
                if definition.coordinates[half].is_some() {
                    return twice(self, &format!("`{word}`"));
                }
                definition.coordinates[half] = Some(self.coordinates(word, definition)?);
                // `q: […], p: […];`, or `v: […];`
                if !self.accept(',') && !self.accept(';') {
                    return Err(self.unexpected("`,` or `;`"));
                }
            }
            "bonds" => {
                const ENDS: &str = "`walls`, `free` or `ring`";
                self.expect(':', "`:` and how the chain ends: `bonds: walls;`")?;
                let name = self.name(ENDS)?;
                let ends = match name.text.as_str() {
                    "walls" => Ends::Walls,
                    "free" => Ends::Free,
                    "ring" => Ends::Ring,
                    _ => {
                        self.next -= 1;
                        return Err(self.unexpected(ENDS));
                    }
                };
                if definition.ends.is_some() {
                    return twice(self, "`bonds`");
                }
                definition.ends = Some((ends, name.span));
                self.accept(';');
            }
            "extern" => {
                const FORM: &str =
                    "a function with its two derivatives: `extern fn V with dV, d2V;`";
                if !self.accept_word("fn") {
                    return Err(self.unexpected(FORM));
                }
                let function = self.function_name(FORM)?;
                if !self.accept_word("with") {
                    return Err(self.unexpected(FORM));
                }
                let first = self.function_name(FORM)?;
                self.expect(',', FORM)?;
                let second = self.function_name(FORM)?;
                self.calls.push(function.text.clone());
                definition.functions.push([function, first, second]);
                self.expect(';', "`;`")?;
            }
            "let" => {
                let name = self.new_name("a name")?;
                let mut arguments = Vec::new();
                if self.accept('(') {
                    while !self.is(')') {
                        arguments.push(self.new_name("an argument, or `)`")?);
                        if !self.accept(',') {
                            break;
                        }
                    }
                    self.expect(')', "`,` or `)`")?;
                }
                self.expect('=', "`=`")?;
                let value = self.expression()?;
                self.expect(';', "an operator or `;`")?;
                if !arguments.is_empty() {
                    self.calls.push(name.text.clone());
                }
                definition.abbreviations.push(Abbreviation {
                    name,
                    arguments,
                    value,
                });
            }
            word if word == self.form.function() => {
                self.expect('=', "`=` and the formula")?;
                if definition.function.is_some() {
                    return twice(self, word);
                }
                definition.function = Some(self.expression()?);
                let ends = matches!(self.peek(), Token::End | Token::Name(_));
                if !self.accept(';') && !ends {
                    return Err(self.unexpected("an operator or `;`"));
                }
            }
            "constraints" => {
                const FORM: &str = "`constraints: { rod = |q[0]|^2 - 1, link(i in 1..N) = |q[i] - q[i-1]|^2 - 1 }`";
                let read = self.constraints(FORM)?;
                definition.constraints.extend(read);
            }
            "nonholonomic" => {
                let read = self.constraints("`nonholonomic: { edge = vx sin(a) - vy cos(a) }`")?;
                definition.nonholonomic.extend(read);
            }
            "force" => self.forces(definition)?,
            "friction" => {
                self.expect(
                    ':',
                    "`:` and a rate, or a list: `friction: gamma;`, `friction: [a, b];`",
                )?;
                if definition.friction.is_some() {
                    return twice(self, "`friction`");
                }
                definition.friction = Some(self.expression()?);
                self.accept(';');
            }
            "invariants" => {
                const FORM: &str = "`invariants: { momentum = sum(i: p[i]) }`";
                self.expect(':', FORM)?;
                let open = self.span();
                self.expect('{', FORM)?;
                while !self.is('}') {
                    let name = self.new_rust_name("the name of an invariant, or `}`")?;
                    self.expect('=', "`=`")?;
                    definition.invariants.push((name, self.expression()?));
                    if !self.accept(',') {
                        break;
                    }
                }
                self.close(&open, ['{', '}'])?;
                self.accept(';');
            }
            "require" => {
                const FORM: &str = "`require: [separable, quadratic_kinetic]`";
                self.expect(':', FORM)?;
                let open = self.span();
                self.expect('[', FORM)?;
                while !self.is(']') {
                    definition.required.push(self.name("a property, or `]`")?);
                    if !self.accept(',') {
                        break;
                    }
                }
                self.close(&open, ['[', ']'])?;
                self.accept(';');
            }
            "v" if self.form == Form::Hamiltonian && self.is(':') => {
                self.next += 1;
                if definition.velocities.is_some() {
                    return twice(self, "`v`");
                }
                definition.velocities = Some(self.coordinates("v", definition)?);
                if !self.accept(',') && !self.accept(';') {
                    return Err(self.unexpected("`,` or `;`"));
                }
            }
            "H" | "L" | "p" | "v" if self.is('=') || self.is(':') => {
                return Err(self.other_form(word, &span));
            }
            word => {
                let known = [&STATEMENTS[..], &["invariants", "require"]].concat();
                let meant = suggestion(word, &known).filter(|_| self.is(':'));
                self.next -= 1;
                let expected = match meant {
                    Some(meant) => format!("`{meant}:`"),
                    None => statement(self.form).to_owned(),
                };
                return Err(self.unexpected(&expected));
            }
        }
        Ok(())
    }

    /// The error for a part that belongs to a formula of the other form.
    fn other_form(&self, found: String, span: &Span) -> Error {
        let kind = FormulaError::OtherForm {
            found,
            function: self.form.function(),
            coordinates: self.form.coordinates(),
            other: match self.form {
                Form::Hamiltonian => Form::Lagrangian.macro_name(),
                Form::Lagrangian => Form::Hamiltonian.macro_name(),
            },
        };
        self.input.error(span, kind.into())
    }

    /// The constraints after the keyword; `form` shows their syntax.
    fn constraints(&mut self, form: &str) -> Result<Vec<Constraint>, Error> {
        self.expect(':', form)?;
        let open = self.span();
        self.expect('{', form)?;
        let mut constraints = Vec::new();
        while !self.is('}') {
            let name = self.new_name("the name of a constraint, or `}`")?;
            let over = match self.accept('(') {
                true => {
                    let over = self.over()?;
                    self.expect(')', "`)`")?;
                    Some(over)
                }
                false => None,
            };
            self.expect('=', "`=` and what is zero")?;
            let value = self.expression()?;
            constraints.push(Constraint { name, over, value });
            if !self.accept(',') {
                break;
            }
        }
        self.close(&open, ['{', '}'])?;
        self.accept(';');
        Ok(constraints)
    }

    fn forces(&mut self, definition: &mut Definition) -> Result<(), Error> {
        let form = match self.form {
            Form::Hamiltonian => "`force: { x = -c px, y = 0 }` or `force: { q[i] = -c p[i] }`",
            Form::Lagrangian => "`force: { x = -c vx, y = 0 }` or `force: { q[i] = -c v[i] }`",
        };
        self.expect(':', form)?;
        let open = self.span();
        self.expect('{', form)?;
        while !self.is('}') {
            let name = self.name("a coordinate, or `}`")?;
            let mut target = Expression {
                kind: Kind::Name(name.text),
                span: name.span.clone(),
            };
            if self.accept('[') {
                let index = self.expression()?;
                self.expect(']', "`]`")?;
                target = Expression {
                    kind: Kind::Entry(Box::new(target), vec![index]),
                    span: name.span.start..self.end(),
                };
            }
            let over = match self.accept('(') {
                true => {
                    let over = self.over()?;
                    self.expect(')', "`)`")?;
                    Some(over)
                }
                false => None,
            };
            self.expect('=', "`=` and the force")?;
            let value = self.expression()?;
            definition.forces.push(Force {
                target,
                over,
                value,
            });
            if !self.accept(',') {
                break;
            }
        }
        self.close(&open, ['{', '}'])?;
        self.accept(';');
        Ok(())
    }

    /// The coordinates after `letter`, which is also the name of a single one: `q: [q]`.
    fn coordinates(&mut self, letter: &str, definition: &Definition) -> Result<Coordinates, Error> {
        let open = self.span();
        self.expect('[', "`[`: `[a, b]`, `[N]`, `[N; 3]` or `[..]`")?;
        let is_length = |name: &str| definition.lengths.iter().any(|length| length.text == name);
        let kind = match self.peek() {
            Token::Name(name) if name == letter && *self.ahead(1) == Token::Symbol(']') => {
                CoordinatesKind::Named(vec![self.name("a coordinate")?])
            }
            Token::Name(name)
                if match self.ahead(1) {
                    Token::Symbol(';') => false,
                    Token::Symbol(',') => true,
                    _ => !is_length(name),
                } =>
            {
                let mut names = vec![self.new_name("a coordinate")?];
                while self.accept(',') && !self.is(']') {
                    names.push(self.new_name("a coordinate")?);
                }
                CoordinatesKind::Named(names)
            }
            _ => {
                let length = self.length(definition)?;
                let mut components = None;
                if self.accept(';') {
                    let span = self.span();
                    match self.length(definition)? {
                        Length::Fixed(n) if n <= 16 => components = Some(n),
                        _ => {
                            let kind = ErrorKind::Type {
                                found: "these components of a vector".to_owned(),
                                expected: "a number from 1 to 16".to_owned(),
                            };
                            return Err(self.input.error(&span, kind));
                        }
                    }
                }
                CoordinatesKind::Numbered(length, components)
            }
        };
        self.close(&open, ['[', ']'])?;
        Ok(Coordinates {
            kind,
            span: open.start..self.end(),
        })
    }
}

/// The statements that a definition may contain.
fn statement(form: Form) -> &'static str {
    match form {
        Form::Hamiltonian => {
            "`q: […], p: […];`, `let …;`, `H = …`, `bonds: …;`, `extern fn …;`, `constraints: {…}`, `nonholonomic: {…}`, `force: {…}`, `friction: …;`, `invariants: {…}` or `require: […]`"
        }
        Form::Lagrangian => {
            "`q: […], v: […];`, `let …;`, `L = …`, `bonds: …;`, `extern fn …;`, `constraints: {…}`, `nonholonomic: {…}`, `force: {…}`, `friction: …;`, `invariants: {…}` or `require: […]`"
        }
    }
}
