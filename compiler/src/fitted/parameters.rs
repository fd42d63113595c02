//! Numbers for the parameters of a definition.

use super::refused;
use crate::definition::{Definition, Key};
use crate::error::Error;
use crate::expression::{Input, parse_list};

impl Definition {
    /// The definition with numbers, given as texts, for its parameters: all of them, each once.
    ///
    /// # Errors
    /// [`ErrorKind::Definition`](crate::ErrorKind::Definition) if a parameter has no number, or if a number is for none of them; wrong
    /// expressions.
    ///
    /// ```
    /// use symplectic_compiler::Definition;
    ///
    /// let fitted = Definition::parse("parameters: w, basis: [1, cos(w*t), sin(w*t)], nodes: [0, 1/2, 1]")?;
    /// let at = fitted.at(&[("w", "3/10")])?;
    /// assert_eq!(at.to_string(), "basis: [1, cos((3/10)*t), sin((3/10)*t)], nodes: [0, 1/2, 1]");
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn at(&self, values: &[(&str, &str)]) -> Result<Definition, Error> {
        let names: Vec<&str> = self
            .get(Key::Parameters)
            .map_or_else(Vec::new, |text| text.split(',').map(str::trim).collect());
        for (name, value) in values {
            if !names.contains(name) {
                let known = match names.as_slice() {
                    [] => "the definition has no `parameters`".to_owned(),
                    names => format!("the parameters are {}", names.join(", ")),
                };
                return Err(refused(format!("`{name}` is not a parameter: {known}")));
            }
            let input = Input {
                name: "at",
                text: value,
            };
            let items = parse_list(input)?;
            let [item] = items.as_slice() else {
                return Err(refused(format!(
                    "`{name}` takes one number, and not `{value}`"
                )));
            };
            item.constant(input)?;
        }
        for (index, name) in names.iter().enumerate() {
            let given = values.iter().filter(|(known, _)| known == name).count();
            if given != 1 || names[..index].contains(name) {
                return Err(refused(format!(
                    "every parameter takes one number: `{name}` has {given}"
                )));
            }
        }
        let parts = self.parts().filter(|(key, _)| *key != Key::Parameters);
        Ok(Definition::new(
            parts.map(|(key, text)| (key, replaced(text, values))),
        ))
    }
}

/// The text with values, in brackets, in the place of names.
fn replaced(text: &str, values: &[(&str, &str)]) -> String {
    let mut result = String::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let end = match is_word(first) {
            true => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            false => first.len_utf8(),
        };
        let (word, after) = rest.split_at(end);
        match values.iter().find(|(name, _)| *name == word) {
            Some((_, value)) => result.push_str(&format!("({value})")),
            None => result.push_str(word),
        }
        rest = after;
    }
    result
}
