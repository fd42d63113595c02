//! The constructors of Boost.Numeric.Odeint, which fill a list that the name of its type names.
//!
//! ```text
//! struct coef_a_type : boost::array<Value, 2> { coef_a_type() { (*this)[0] = static_cast<Value>(1)/static_cast<Value>(2); … } };
//! struct rk4_coefficients_a1 : boost::array<Value, 1> { … };      the second row of A, below the diagonal
//! ```

use super::tokens::{Spanned, Token};

/// Writes `(*this)[0]` as `a[0]`, with the letter of the type.
pub(super) fn name_lists(tokens: &mut Vec<Spanned>) {
    let mut written: Vec<Spanned> = Vec::with_capacity(tokens.len());
    let mut letter: Option<String> = None;
    for token in tokens.iter() {
        written.push(token.clone());
        let declared = match &written[..] {
            [.., before, last] => match (&before.token, &last.token) {
                (Token::Name(word), Token::Name(name)) if word == "struct" || word == "class" => {
                    Some(name)
                }
                _ => None,
            },
            _ => None,
        };
        if let Some(name) = declared {
            letter = list_of(name);
        }
        let (Some(letter), [.., open, star, this, close]) = (&letter, &written[..]) else {
            continue;
        };
        let own = matches!(
            (&open.token, &star.token, &this.token, &close.token),
            (Token::Symbol('('), Token::Symbol('*'), Token::Name(this), Token::Symbol(')')) if this == "this"
        );
        if own {
            let name = Spanned {
                token: Token::Name(letter.clone()),
                span: open.span.start..close.span.end,
                apart: open.apart,
            };
            written.truncate(written.len() - 4);
            written.push(name);
        }
    }
    *tokens = written;
}

/// The only part of a name such as `coef_a_type` that is `a`, `b`, `c` or one of them with a number.
fn list_of(name: &str) -> Option<String> {
    let is_list = |part: &&str| {
        let number = part.strip_prefix(['a', 'b', 'c']);
        number.is_some_and(|digits| digits.bytes().all(|c| c.is_ascii_digit()))
    };
    let mut lists = name.split('_').filter(is_list);
    let list = lists.next()?;
    lists.next().is_none().then(|| list.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_types_give_the_names_of_lists() {
        let list = |name| list_of(name);
        assert_eq!(list("coef_a_type").as_deref(), Some("a"));
        assert_eq!(list("rk4_coefficients_a12").as_deref(), Some("a12"));
        assert_eq!(list("symplectic_rkn_sb3a_mclachlan"), None);
        assert_eq!(list("a_b"), None);
    }
}
