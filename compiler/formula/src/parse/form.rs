//! Whether a text gives a Hamiltonian or a Lagrangian.

use super::tokens::{Token, tokenize};
use crate::syntax::Form;
use symplectic_exact::input::Input;

/// The form of a text: H, if a statement begins with `H =` or `p:`; else L, if one begins with `L =` or `v:`; else H.
pub fn form(input: Input<'_>) -> Form {
    let Ok(tokens) = tokenize(input) else {
        return Form::Hamiltonian;
    };
    let (mut depth, mut found) = (0_usize, Form::Hamiltonian);
    for (k, (token, _)) in tokens.iter().enumerate() {
        match token {
            Token::Symbol('(' | '[' | '{') => depth += 1,
            Token::Symbol(')' | ']' | '}') => depth = depth.saturating_sub(1),
            Token::Name(name) if depth == 0 => {
                let (sign, form) = match name.as_str() {
                    "H" => ('=', Form::Hamiltonian),
                    "p" => (':', Form::Hamiltonian),
                    "L" => ('=', Form::Lagrangian),
                    "v" => (':', Form::Lagrangian),
                    _ => continue,
                };
                let follows = tokens.get(k + 1).map(|(token, _)| token);
                let before = k.checked_sub(1).map(|k| &tokens[k].0);
                let abbreviation = before == Some(&Token::Name("let".to_owned()));
                if follows == Some(&Token::Symbol(sign)) && !abbreviation {
                    match form {
                        Form::Hamiltonian => return form,
                        Form::Lagrangian => found = form,
                    }
                }
            }
            _ => {}
        }
    }
    found
}
