//! Names of the formula in a language.

use super::super::languages::formulas::{Count, Formulas};
use super::super::template::fill;
use symplectic_formula::syntax::Length;
use symplectic_formula::{Shape, System};

/// The names of a system, of its lengths and of its parameters.
pub(super) struct Names {
    /// The type.
    pub kind: String,
    /// The prefix of functions.
    pub prefix: String,
    /// The lengths that the formula leaves open, with their names.
    pub lengths: Vec<(Length, String)>,
    /// The parameters.
    pub parameters: Vec<String>,
    /// The expressions for the numbers of pairs, by the names of the lists in the formula.
    counts: Vec<(String, String)>,
}

impl Names {
    /// The names of a system in a module of this name.
    pub fn new(system: &System, notation: &Formulas, module: &str) -> Self {
        let mut open: Vec<Length> = Vec::new();
        let arrays = system
            .parameters
            .iter()
            .flat_map(|parameter| match &parameter.shape {
                Shape::Array(lengths) => lengths.clone(),
                Shape::Number(_) => Vec::new(),
                Shape::Pairs => vec![Length::PairsOf(parameter.name.clone())],
            });
        for length in [system.layout.length()].into_iter().chain(arrays) {
            let is_named = match &length {
                Length::Fixed(_) => false,
                Length::PairsOf(_) => matches!(notation.count, Count::Length(_)),
                _ => true,
            };
            if is_named && !open.contains(&length) {
                open.push(length);
            }
        }
        let mut taken = Vec::new();
        let lengths = open.into_iter().map(|length| {
            let name = match &length {
                Length::Generic(name) => fill(notation.named_length, &[("name", name)]),
                Length::PairsOf(list) => match notation.count {
                    Count::Length(name) | Count::Expression(name) => fill(name, &[("name", list)]),
                },
                _ => notation.length.to_owned(),
            };
            let name = free(&name, notation.words, &mut taken);
            (length, name)
        });
        let lengths = lengths.collect();
        let parameters = system.parameters.iter();
        let parameters: Vec<String> = parameters
            .map(|parameter| free(&parameter.name, notation.words, &mut taken))
            .collect();
        let lists = system.parameters.iter().zip(&parameters);
        let lists = lists.filter(|(parameter, _)| matches!(parameter.shape, Shape::Pairs));
        let counts = match notation.count {
            Count::Length(_) => Vec::new(),
            Count::Expression(count) => lists
                .map(|(list, name)| (list.name.clone(), fill(count, &[("name", name)])))
                .collect(),
        };
        Names {
            kind: free(
                &system.name,
                &[notation.types, notation.words].concat(),
                &mut vec![module.to_owned()],
            ),
            prefix: snake(&plain(&system.name)),
            lengths,
            parameters,
            counts,
        }
    }

    /// A length, as a number or by its name.
    pub fn length(&self, length: &Length, notation: &Formulas) -> String {
        if let Length::Fixed(n) = length {
            return n.to_string();
        }
        if let Some((_, name)) = self.lengths.iter().find(|(known, _)| known == length) {
            return fill(notation.length_member, &[("name", name)]);
        }
        let of = |list: &String| *length == Length::PairsOf(list.clone());
        let found = self.counts.iter().find(|(list, _)| of(list));
        found.map_or_else(String::new, |(_, count)| count.clone())
    }
}

/// A name that is neither a word of the language nor taken: with underscores at its end if need be.
fn free(name: &str, words: &[&str], taken: &mut Vec<String>) -> String {
    let mut name = plain(name);
    while words.contains(&&name[..]) || taken.contains(&name) {
        name.push('_');
    }
    taken.push(name.clone());
    name
}

/// Letters that languages do not take in names, such as `₁`, by their numbers.
fn plain(name: &str) -> String {
    let mut text = String::new();
    for c in name.chars() {
        match c.is_ascii_alphanumeric() || c == '_' || c.is_alphabetic() {
            true => text.push(c),
            false => text.push_str(&format!("_{:x}", u32::from(c))),
        }
    }
    text
}

/// `double_pendulum` from `DoublePendulum`.
fn snake(name: &str) -> String {
    let mut text = String::new();
    let mut before = None;
    for c in name.chars() {
        if c.is_uppercase() && before.is_some_and(char::is_lowercase) {
            text.push('_');
        }
        text.extend(c.to_lowercase());
        before = Some(c);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::{free, plain, snake};

    #[test]
    fn names_become_free_identifiers_in_snake_case() {
        assert_eq!(snake("DoublePendulum"), "double_pendulum");
        assert_eq!(snake("Henon_Heiles"), "henon_heiles");
        assert_eq!(snake("NBody"), "nbody");
        assert_eq!(plain("m₁"), "m_2081");
        let mut taken = vec!["lambda_".to_owned()];
        assert_eq!(free("lambda", &["lambda"], &mut taken), "lambda__");
        assert_eq!(free("mu", &["lambda"], &mut taken), "mu");
        assert_eq!(free("mu", &["lambda"], &mut taken), "mu_");
    }
}
