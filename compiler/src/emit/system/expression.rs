//! Operations as Rust expressions, and the statements before them.

use std::collections::BTreeSet;

use num_traits::Zero;
use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::block::{Block, Strength, Writer, Written};
use super::names::{entry, identifier, index_tokens};
use crate::arithmetic::rounding::to_f64;
use crate::emit::literal;
use crate::formula::Shape;
use crate::formula::function::Elementary;
use crate::formula::graph::{Coordinate, Half, Index};
use crate::formula::operations::{Op, Operation};
use crate::formula::syntax::Length;

impl Writer<'_> {
    /// The expression for an operation, after the statements that it needs.
    pub(super) fn require(&mut self, block: &mut Block, op: Op) -> Written {
        if let Some(written) = block.scope.names.get(&op) {
            return written.clone();
        }
        if let Some(&turn) = block.turns.get(&op) {
            self.turns(block, turn);
            return block.scope.names[&op].clone();
        }
        // Long chains of operations are written from their beginning.
        self.prepare(block, op);
        let written = self.expression(block, op);
        let leaf = self.operations.get(op).is_leaf();
        let often = block.uses.get(&op).copied().unwrap_or(0) > 1;
        if leaf || !often {
            return written;
        }
        self.keep(block, op, written)
    }

    pub(super) fn keep(&mut self, block: &mut Block, op: Op, written: Written) -> Written {
        let name = self.name();
        let Written { tokens, fixed, .. } = written;
        block.statements.extend(quote!(let #name = #tokens;));
        let written = Written {
            tokens: quote!(#name),
            strength: Strength::Atom,
            fixed,
        };
        block.scope.names.insert(op, written.clone());
        written
    }

    /// Names parts of a deeply nested operation, so that no expression in the code is too deep.
    pub(super) fn prepare(&mut self, block: &mut Block, op: Op) {
        let mut order = Vec::new();
        let mut open = vec![(op, 0_usize)];
        let mut seen = BTreeSet::new();
        let mut deep = false;
        while let Some((next, depth)) = open.pop() {
            if !seen.insert(next) || block.scope.names.contains_key(&next) {
                continue;
            }
            deep |= depth > MOST_DEPTH;
            order.push(next);
            open.extend(
                self.operations
                    .get(next)
                    .operands()
                    .into_iter()
                    .map(|operand| (operand, depth + 1)),
            );
        }
        if !deep {
            return;
        }
        order.sort();
        for (count, next) in order.into_iter().enumerate() {
            let is_wanted = next != op
                && block.here.contains(&next)
                && !self.operations.get(next).is_leaf()
                && !self.operations.is_division(next);
            let often = block.uses.get(&next).copied().unwrap_or(0) > 1;
            if is_wanted
                && (often || count % MOST_DEPTH == 0)
                && !block.scope.names.contains_key(&next)
            {
                match block.turns.get(&next) {
                    Some(&turn) => self.turns(block, turn),
                    None => {
                        let written = self.expression(block, next);
                        self.keep(block, next, written);
                    }
                }
            }
        }
    }

    /// The sines and cosines of all angles of a group that is computed together.
    pub(super) fn turns(&mut self, block: &mut Block, turn: (usize, usize)) {
        let angles = block.angles.get(&turn).cloned().unwrap_or_default();
        let mut names = Vec::new();
        let mut values = Vec::new();
        for angle in angles {
            let value = self.require(block, angle);
            values.push(self.free(value));
            let mut pair = Vec::new();
            for function in [Elementary::Sin, Elementary::Cos] {
                let found =
                    block.turns.keys().copied().find(|&op| {
                        *self.operations.get(op) == Operation::Elementary(function, angle)
                    });
                pair.push(found.map(|op| (op, self.name())));
            }
            names.push(pair);
        }
        let shown = |name: &Option<(Op, Ident)>| match name {
            Some((_, name)) => quote!(#name),
            None => quote!(_),
        };
        let pairs = names.iter().map(|pair| {
            let pair = pair.iter().map(shown);
            quote!((#(#pair),*))
        });
        let pairs: Vec<TokenStream> = pairs.collect();
        let statement = match (pairs.as_slice(), values.as_slice()) {
            ([pair], [value]) => {
                let receiver = atom(value);
                match names[0].as_slice() {
                    [Some((_, name)), None] => quote!(let #name = #receiver.sin();),
                    [None, Some((_, name))] => quote!(let #name = #receiver.cos();),
                    _ => quote!(let #pair = #receiver.sin_cos();),
                }
            }
            _ => {
                let scalar = &self.scalar;
                let values = values.iter().map(|value| &value.tokens);
                quote!(let [#(#pairs),*] = #scalar::sin_cos_all([#(#values),*]);)
            }
        };
        block.statements.extend(statement);
        for (op, name) in names.into_iter().flatten().flatten() {
            let written = Written {
                tokens: quote!(#name),
                strength: Strength::Atom,
                fixed: false,
            };
            block.scope.names.insert(op, written);
        }
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

    pub(super) fn expression(&mut self, block: &mut Block, op: Op) -> Written {
        let fixed = self.operations.depends(op).is_fixed();
        let both = |this: &mut Self, block: &mut Block, a: Op, b: Op| {
            let sides = [a, b].map(|side| this.require(block, side));
            sides.map(|side| if fixed { side } else { this.free(side) })
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
                let a = self.require(block, a);
                let a = if fixed { a } else { self.free(a) };
                let a = at_least(&a, Strength::Product);
                (quote!(-#a), Strength::Sign)
            }
            Operation::Add(a, b) => {
                let [a, b] = both(self, block, a, b);
                let (a, b) = (a.tokens, at_least(&b, Strength::Product));
                (quote!(#a + #b), Strength::Sum)
            }
            Operation::Subtract(a, b) => {
                let [a, b] = both(self, block, a, b);
                let (a, b) = (a.tokens, at_least(&b, Strength::Product));
                (quote!(#a - #b), Strength::Sum)
            }
            Operation::Multiply(a, b) => match *self.operations.get(b) {
                Operation::Reciprocal(divisor) if self.operations.is_division(b) => {
                    let [a, b] = both(self, block, a, divisor);
                    let (a, b) = (
                        at_least(&a, Strength::Product),
                        at_least(&b, Strength::Sign),
                    );
                    (quote!(#a / #b), Strength::Product)
                }
                _ => {
                    let [a, b] = both(self, block, a, b);
                    let (a, b) = (
                        at_least(&a, Strength::Product),
                        at_least(&b, Strength::Sign),
                    );
                    (quote!(#a * #b), Strength::Product)
                }
            },
            Operation::Reciprocal(a) => {
                let a = self.require(block, a);
                match fixed {
                    true => {
                        let a = at_least(&a, Strength::Sign);
                        (quote!(1.0 / #a), Strength::Product)
                    }
                    false => {
                        let a = atom(&a);
                        (quote!(#a.recip()), Strength::Atom)
                    }
                }
            }
            Operation::Root(a) => self.call(block, a, "sqrt", fixed),
            Operation::Absolute(a) => self.call(block, a, "abs", fixed),
            Operation::Elementary(function, a) => self.call(block, a, function.name(), fixed),
            Operation::Atan2(a, b) => {
                let [y, x] = both(self, block, a, b);
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
                let a = self.require(block, a).tokens;
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

    pub(super) fn call(
        &mut self,
        block: &mut Block,
        a: Op,
        name: &str,
        fixed: bool,
    ) -> (TokenStream, Strength) {
        let a = self.require(block, a);
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
        let Shape::Array(lengths) = &parameter.shape else {
            return quote!(self.#name);
        };
        let checked = |length: &Length| matches!(length, Length::Runtime | Length::PairsOf(_));
        let indices: Vec<TokenStream> = indices.iter().map(index_tokens).collect();
        match (indices.as_slice(), lengths.iter().any(checked)) {
            ([i], false) => quote!(self.#name[#i]),
            ([i, j], false) => quote!(self.#name[#i][#j]),
            ([i], true) => quote!(self.#name.get(#i).copied().unwrap_or(f64::NAN)),
            ([i, j], true) => {
                quote!(self.#name.get(#i).and_then(|row| row.get(#j)).copied().unwrap_or(f64::NAN))
            }
            _ => quote!(self.#name),
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

/// Greatest nesting depth of an expression in the code.
const MOST_DEPTH: usize = 32;

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
