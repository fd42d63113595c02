//! Names of entries, lengths and indices in the code.

use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use crate::Layout;
use crate::graph::{Base, Coordinate, Index, LoopId};
use crate::syntax::Length;

/// An entry of a vector.
pub fn entry(layout: &Layout, vector: &TokenStream, coordinate: &Coordinate) -> TokenStream {
    let index = index_tokens(&coordinate.index);
    match layout {
        Layout::Numbered(_, Some(_)) => {
            let component = Literal::usize_unsuffixed(coordinate.component);
            quote!(#vector[#index][#component])
        }
        _ => quote!(#vector[#index]),
    }
}

/// A name of the user as an identifier; raw if it is a Rust keyword.
pub fn identifier(name: &str) -> Ident {
    const WORDS: [&str; 46] = [
        "as", "async", "await", "abstract", "become", "box", "break", "const", "continue", "do",
        "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in",
        "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref",
        "return", "static", "struct", "trait", "true", "try", "type", "typeof", "unsafe",
        "unsized", "use", "virtual", "where",
    ];
    match WORDS.contains(&name) || ["while", "yield"].contains(&name) {
        true => Ident::new_raw(name, Span::call_site()),
        false => Ident::new(name, Span::call_site()),
    }
}

/// The length of an array.
pub fn length_tokens(length: &Length) -> TokenStream {
    match length {
        Length::Fixed(n) => {
            let n = Literal::usize_unsuffixed(*n);
            quote!(#n)
        }
        Length::Generic(name) => {
            let name = identifier(name);
            quote!(#name)
        }
        Length::Runtime | Length::PairsOf(_) => quote!(n),
    }
}

/// The index of a loop; of a list, the number of the pair.
pub fn index_name(id: LoopId) -> Ident {
    let letters = ["i", "j", "k", "l", "m"];
    match letters.get(id.0) {
        Some(letter) => format_ident!("{letter}"),
        None => format_ident!("i{}", id.0),
    }
}

pub fn pair_name(id: LoopId, slot: usize) -> Ident {
    format_ident!("{}_{}", index_name(id), ["first", "second"][slot])
}

/// An index.
pub fn index_tokens(index: &Index) -> TokenStream {
    let offset = Literal::usize_unsuffixed(index.offset.unsigned_abs() as usize);
    let base = match &index.base {
        Base::Start => return quote!(#offset),
        Base::End(length) => length_tokens(length),
        Base::Loop(id) => {
            let name = index_name(*id);
            quote!(#name)
        }
        Base::Pair(id, slot @ (0 | 1)) => {
            let name = pair_name(*id, *slot);
            quote!(#name)
        }
        Base::Pair(id, _) => {
            let name = index_name(*id);
            quote!(#name)
        }
    };
    match index.offset.signum() {
        0 => base,
        1 => quote!(#base + #offset),
        _ => quote!(#base - #offset),
    }
}
