//! Whether a text gives a Hamiltonian or a Lagrangian.

use super::tokens::{Token, tokenize};
use crate::expression::Input;
use crate::formula::syntax::Form;

/// What a text gives: L, if a statement begins with `L =` or `v:`, else H.
pub fn form(input: Input<'_>) -> Form {
    let Ok(tokens) = tokenize(input) else {
        return Form::Hamiltonian;
    };
    let mut depth = 0_usize;
    for (k, (token, _)) in tokens.iter().enumerate() {
        match token {
            Token::Symbol('(' | '[' | '{') => depth += 1,
            Token::Symbol(')' | ']' | '}') => depth = depth.saturating_sub(1),
            Token::Name(name) if depth == 0 => {
                let sign = match name.as_str() {
                    "L" => '=',
                    "v" => ':',
                    _ => continue,
                };
                let follows = tokens.get(k + 1).map(|(token, _)| token);
                let before = k.checked_sub(1).map(|k| &tokens[k].0);
                let abbreviation = before == Some(&Token::Name("let".to_owned()));
                if follows == Some(&Token::Symbol(sign)) && !abbreviation {
                    return Form::Lagrangian;
                }
            }
            _ => {}
        }
    }
    Form::Hamiltonian
}
