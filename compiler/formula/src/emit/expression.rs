//! Operations as Rust expressions.

use num_traits::Zero;
use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::block::{Names, Strength, Writer, Written};
use super::names::{entry, identifier, index_tokens};
use crate::Shape;
use crate::graph::{Coordinate, Half, Index};
use crate::operations::{Op, Operation};
use crate::statements::Turn;
use crate::syntax::Length;
use symplectic_exact::code as literal;
use symplectic_exact::rounding::to_f64;

impl Written {
    /// The name of a value.
    pub(super) fn name(name: &Ident, fixed: bool) -> Self {
        Written {
            tokens: quote!(#name),
            strength: Strength::Atom,
            fixed,
        }
    }
}

impl Writer<'_> {
    /// The expression for an operation, from the values that have names.
    pub(super) fn written(&self, names: &Names, op: Op) -> Written {
        match names.get(&op) {
            Some(written) => written.clone(),
            None => self.expression(names, op),
        }
    }

    /// The sines and cosines of all angles of a group that is computed together.
    pub(super) fn turns(&self, names: &mut Names, turns: &[Turn]) -> TokenStream {
        let values = turns
            .iter()
            .map(|turn| self.free(self.written(names, turn.angle)));
        let values: Vec<Written> = values.collect();
        let pairs = turns.iter().map(|turn| {
            turn.values
                .map(|value| value.map(|(_, number)| self.name(number)))
        });
        let pairs: Vec<[Option<Ident>; 2]> = pairs.collect();
        let shown = |[sine, cosine]: &[Option<Ident>; 2]| {
            let [sine, cosine] = [sine, cosine].map(|name| match name {
                Some(name) => quote!(#name),
                None => quote!(_),
            });
            quote!((#sine, #cosine))
        };
        let statement = match (pairs.as_slice(), values.as_slice()) {
            ([pair], [value]) => {
                let receiver = atom(value);
                match pair {
                    [Some(name), None] => quote!(let #name = #receiver.sin();),
                    [None, Some(name)] => quote!(let #name = #receiver.cos();),
                    pair => {
                        let pair = shown(pair);
                        quote!(let #pair = #receiver.sin_cos();)
                    }
                }
            }
            _ => {
                let scalar = &self.scalar;
                let pairs = pairs.iter().map(shown);
                let values = values.iter().map(|value| &value.tokens);
                quote!(let [#(#pairs),*] = #scalar::sin_cos_all([#(#values),*]);)
            }
        };
        for (op, number) in turns.iter().flat_map(|turn| turn.values).flatten() {
            names.insert(op, Written::name(&self.name(number), false));
        }
        statement
    }

    /// A double, converted to the scalar.
    pub(super) fn free(&self, written: Written) -> Written {
        if !written.fixed {
            return written;
        }
        let (scalar, tokens) = (&self.scalar, &written.tokens);
        let text = tokens.to_string();
        let tokens = match text.as_str() {
            "1.0" => quote!(#scalar::one()),
            "0.0" => quote!(#scalar::zero()),
            _ => quote!(#scalar::from_f64(#tokens)),
        };
        Written {
            tokens,
            strength: Strength::Atom,
            fixed: false,
        }
    }

    fn expression(&self, names: &Names, op: Op) -> Written {
        let fixed = self.is_fixed(op);
        let both = |a: Op, b: Op| {
            let sides = [a, b].map(|side| self.written(names, side));
            sides.map(|side| if fixed { side } else { self.free(side) })
        };
        let (tokens, strength) = match self.operations.get(op).clone() {
            Operation::Constant(value) => {
                let number = literal::double(to_f64(&value));
                let strength = if value < Zero::zero() {
                    Strength::Sign
                } else {
                    Strength::Atom
                };
                (number, strength)
            }
            Operation::Pi => (quote!(::core::f64::consts::PI), Strength::Atom),
            Operation::Time => (quote!(time), Strength::Atom),
            Operation::Parameter(parameter, indices) => {
                (self.parameter(parameter, &indices), Strength::Atom)
            }
            Operation::Coordinate(coordinate) => (self.coordinate(&coordinate), Strength::Atom),
            Operation::Negative(a) => {
                let a = self.written(names, a);
                let a = if fixed { a } else { self.free(a) };
                let a = at_least(&a, Strength::Product);
                (quote!(-#a), Strength::Sign)
            }
            Operation::Add(a, b) => {
                let [a, b] = both(a, b);
                let (a, b) = (a.tokens, at_least(&b, Strength::Product));
                (quote!(#a + #b), Strength::Sum)
            }
            Operation::Subtract(a, b) => {
                let [a, b] = both(a, b);
                let (a, b) = (a.tokens, at_least(&b, Strength::Product));
                (quote!(#a - #b), Strength::Sum)
            }
            Operation::Multiply(a, b) => match *self.operations.get(b) {
                Operation::Reciprocal(divisor) if self.operations.is_division(b) => {
                    let [a, b] = both(a, divisor);
                    let (a, b) = (
                        at_least(&a, Strength::Product),
                        at_least(&b, Strength::Sign),
                    );
                    (quote!(#a / #b), Strength::Product)
                }
                _ => {
                    let [a, b] = both(a, b);
                    let (a, b) = (
                        at_least(&a, Strength::Product),
                        at_least(&b, Strength::Sign),
                    );
                    (quote!(#a * #b), Strength::Product)
                }
            },
            Operation::Reciprocal(a) => {
                let a = self.written(names, a);
                match fixed {
                    true => {
                        let a = at_least(&a, Strength::Sign);
                        (quote!(1.0 / #a), Strength::Product)
                    }
                    false => {
                        let a = atom(&self.free(a));
                        (quote!(#a.recip()), Strength::Atom)
                    }
                }
            }
            Operation::Root(a) => self.call(names, a, "sqrt", fixed),
            Operation::Absolute(a) => self.call(names, a, "abs", fixed),
            Operation::OrZero(a, b) => {
                let [a, b] = both(a, b);
                let (a, b) = (atom(&a), b.tokens);
                (quote!(#a.or_zero(#b)), Strength::Atom)
            }
            Operation::Elementary(function, a) => self.call(names, a, function.name(), fixed),
            Operation::Atan2(a, b) => {
                let [y, x] = both(a, b);
                let (y, x) = (y.tokens, x.tokens);
                let scalar = if fixed {
                    quote!(::core::primitive::f64)
                } else {
                    let scalar = &self.scalar;
                    quote!(#scalar)
                };
                (
                    quote!(<#scalar as ::symplectic::Scalar>::atan2(#y, #x)),
                    Strength::Atom,
                )
            }
            Operation::User(function, derivative, a) => {
                let name = identifier(&self.system.functions[function][derivative.min(2)]);
                let a = self.written(names, a);
                let a = if fixed { a } else { self.free(a) }.tokens;
                (quote!(#name(#a)), Strength::Atom)
            }
            // A total has a name already.
            Operation::Total(..) => (quote!(), Strength::Atom),
        };
        Written {
            tokens,
            strength,
            fixed,
        }
    }

    fn call(&self, names: &Names, a: Op, name: &str, fixed: bool) -> (TokenStream, Strength) {
        let a = self.written(names, a);
        let name = literal::identifier(name);
        let tokens = match fixed {
            true => {
                let a = a.tokens;
                quote!(::symplectic::Scalar::#name(#a))
            }
            false => {
                let a = atom(&self.free(a));
                quote!(#a.#name())
            }
        };
        (tokens, Strength::Atom)
    }

    pub(super) fn parameter(&self, parameter: usize, indices: &[Index]) -> TokenStream {
        let parameter = &self.system.parameters[parameter];
        let name = identifier(&parameter.name);
        let lengths = match &parameter.shape {
            Shape::Array(lengths) => lengths.as_slice(),
            Shape::Number(_) | Shape::Pairs => &[],
        };
        let checked = |length: &Length| matches!(length, Length::Runtime | Length::PairsOf(_));
        let indices: Vec<TokenStream> = indices.iter().map(index_tokens).collect();
        let scalar = &self.scalar;
        let checked = lengths.iter().any(checked);
        let value = match (indices.as_slice(), checked) {
            ([i], false) => quote!(self.#name[#i]),
            ([i, j], false) => quote!(self.#name[#i][#j]),
            ([i], true) => quote!(self.#name.get(#i)),
            ([i, j], true) => quote!(self.#name.get(#i).and_then(|row| row.get(#j))),
            _ => quote!(self.#name),
        };
        match (self.in_lanes, checked) {
            (false, false) => value,
            (false, true) => quote!(#value.copied().unwrap_or(f64::NAN)),
            (true, false) => quote!(#scalar::from_lanes(&#value)),
            (true, true) => quote!(#value.map_or(#scalar::from_f64(f64::NAN), #scalar::from_lanes)),
        }
    }

    pub(super) fn coordinate(&self, coordinate: &Coordinate) -> TokenStream {
        if let Some(argument) = &self.argument {
            return argument.clone();
        }
        let half = match coordinate.half {
            Half::Q => quote!(q),
            Half::P => quote!(p),
            Half::V => quote!(v),
        };
        entry(&self.system.layout, &half, coordinate)
    }
}

fn at_least(written: &Written, strength: Strength) -> TokenStream {
    let tokens = &written.tokens;
    match written.strength >= strength {
        true => quote!(#tokens),
        false => quote!((#tokens)),
    }
}

fn atom(written: &Written) -> TokenStream {
    at_least(written, Strength::Atom)
}
