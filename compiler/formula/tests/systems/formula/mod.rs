//! Reading, emitting and evaluating formulas in tests.
#![allow(dead_code, reason = "each test file uses its own part")]

use f256::f256;
use proc_macro2::TokenStream;
use quote::{format_ident, quote};
use symplectic_formula::emit::{Header, system};
use symplectic_formula::evaluate::Real;
use symplectic_formula::function::Elementary;
use symplectic_formula::graph::Number;
use symplectic_formula::{Form, Structure, System};

/// A definition that is right.
pub fn read(form: Form, text: &str) -> (System, Structure) {
    let mut read = System::read_as(form, "formula", text).unwrap_or_else(|error| panic!("{error}"));
    let structure = Structure::of(&mut read);
    read.check(&structure, text)
        .unwrap_or_else(|error| panic!("{error}"));
    (read, structure)
}

/// The code of a system.
pub fn code(read: &System, structure: &Structure) -> String {
    let header = Header {
        attributes: TokenStream::new(),
        visibility: quote!(pub),
        name: format_ident!("{}", read.name),
    };
    let tokens = system(read, structure, &header);
    let file = syn::parse2(tokens.clone()).unwrap_or_else(|error| panic!("{error}\n{tokens}"));
    prettyplease::unparse(&file)
}

/// The error of a definition, with the place under it.
pub fn refused(form: Form, text: &str) -> String {
    let found = System::read_as(form, "formula", text).and_then(|mut read| {
        let structure = Structure::of(&mut read);
        read.check(&structure, text)
    });
    let error = match found {
        Err(error) => error,
        Ok(()) => return format!("{text}\naccepted"),
    };
    let span = error
        .place
        .as_ref()
        .map_or(0..0, |place| place.span.clone());
    let blank = |text: &str| " ".repeat(text.chars().count());
    let carets = "^".repeat(text[span.clone()].chars().count().max(1));
    format!(
        "{text}\n{}{carets} {}",
        blank(&text[..span.start]),
        error.kind
    )
}

/// A number of 71 digits.
#[derive(Clone, Debug)]
pub struct Wide(pub f256);

impl Real for Wide {
    fn number(value: &Number) -> Self {
        let parse = |n: &num_bigint::BigInt| n.to_string().parse::<f256>().expect("a number");
        Wide(parse(value.numer()) / parse(value.denom()))
    }

    fn pi() -> Self {
        Wide(f256::ONE.atan() * f256::from(4.0))
    }

    fn add(&self, other: &Self) -> Self {
        Wide(self.0 + other.0)
    }

    fn multiply(&self, other: &Self) -> Self {
        Wide(self.0 * other.0)
    }

    fn power(&self, exponent: &Number) -> Self {
        if exponent.is_integer() {
            let n: i64 = exponent.numer().try_into().expect("a small exponent");
            let mut power = f256::ONE;
            for _ in 0..n.unsigned_abs() {
                power *= self.0;
            }
            return Wide(if n < 0 { f256::ONE / power } else { power });
        }
        Wide((self.0.ln() * Self::number(exponent).0).exp())
    }

    fn elementary(&self, function: Elementary) -> Self {
        let x = self.0;
        let half = f256::from(0.5);
        Wide(match function {
            Elementary::Exp => x.exp(),
            Elementary::Ln => x.ln(),
            Elementary::Sin => x.sin(),
            Elementary::Cos => x.cos(),
            Elementary::Tan => x.tan(),
            Elementary::Asin => x.asin(),
            Elementary::Acos => x.acos(),
            Elementary::Atan => x.atan(),
            Elementary::Sinh => (x.exp() - (-x).exp()) * half,
            Elementary::Cosh => (x.exp() + (-x).exp()) * half,
            Elementary::Tanh => (x.exp() - (-x).exp()) / (x.exp() + (-x).exp()),
        })
    }

    fn atan2(&self, x: &Self) -> Self {
        Wide(self.0.atan2(&x.0))
    }
}
