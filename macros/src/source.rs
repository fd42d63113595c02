//! Tokens as text for the compiler, and positions in that text as tokens.

use std::ops::Range;

use proc_macro2::{Delimiter, Ident, Span, TokenStream, TokenTree};
use symplectic_compiler::Error;

/// A value of a definition as text for the compiler, with the span of each token.
pub struct Source {
    /// The text.
    pub text: String,
    spans: Vec<(Range<usize>, Span)>,
}

impl Source {
    /// The text of a token stream.
    pub fn new(tokens: TokenStream) -> Self {
        let mut source = Source {
            text: String::new(),
            spans: Vec::new(),
        };
        source.append(unwrapped(tokens));
        source
    }

    fn append(&mut self, tokens: TokenStream) {
        for token in tokens {
            let TokenTree::Group(group) = &token else {
                let word = !matches!(token, TokenTree::Punct(_));
                // Adjacent words need a space; hyphens in names must not get one.
                if word
                    && self
                        .text
                        .ends_with(|c: char| c.is_alphanumeric() || c == '_' || c == '.')
                {
                    self.text.push(' ');
                }
                self.push(&token.to_string(), token.span());
                continue;
            };
            let [open, close] = match group.delimiter() {
                Delimiter::Parenthesis => ["(", ")"],
                Delimiter::Bracket => ["[", "]"],
                Delimiter::Brace => ["{", "}"],
                // A group inserted by another macro is a single operand.
                Delimiter::None => ["(", ")"],
            };
            self.push(open, group.span_open());
            self.append(group.stream());
            self.push(close, group.span_close());
        }
    }

    fn push(&mut self, text: &str, span: Span) {
        let start = self.text.len();
        self.text.push_str(text);
        self.spans.push((start..self.text.len(), span));
    }

    /// A compiler error at the tokens that it concerns.
    pub fn locate(&self, error: &Error) -> syn::Error {
        let span = error
            .place
            .as_ref()
            .map_or(0..self.text.len(), |place| place.span.clone());
        let overlaps = |range: &Range<usize>| range.start < span.end && span.start < range.end;
        let mut spans: Vec<Span> = self
            .spans
            .iter()
            .filter(|(range, _)| overlaps(range))
            .map(|(_, span)| *span)
            .collect();
        if spans.is_empty() {
            // The end of the text.
            spans.extend(self.spans.last().map(|(_, span)| *span));
        }
        // An error over several tokens spans from the first to the last; the tokens themselves do not matter.
        let about: TokenStream = spans
            .into_iter()
            .map(|span| TokenTree::Ident(Ident::new("part", span)))
            .collect();
        syn::Error::new_spanned(about, &error.kind)
    }
}

/// The tokens without an invisible group around all of them, inserted by another macro.
fn unwrapped(tokens: TokenStream) -> TokenStream {
    let mut trees = tokens.clone().into_iter();
    match (trees.next(), trees.next()) {
        (Some(TokenTree::Group(group)), None) if group.delimiter() == Delimiter::None => {
            unwrapped(group.stream())
        }
        _ => tokens,
    }
}
