//! What was probably meant by a name that is not known.

/// The known name that is probably meant: the nearest, if it is near.
///
/// ```
/// use symplectic_exact::suggestion::suggestion;
///
/// let known = ["symplectic", "symmetric", "stable_to(2)"];
/// assert_eq!(suggestion("simplectic", &known), Some("symplectic"));
/// assert_eq!(suggestion("stable_ot(3)", &known), Some("stable_to(2)"));
/// assert_eq!(suggestion("reversible", &known), None);
/// ```
pub fn suggestion<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    // Longer texts are no names.
    const LONGEST: usize = 64;
    let name = name.trim().to_lowercase();
    if name.chars().count() > LONGEST {
        return None;
    }
    let nearest = |name: &str, part: fn(&str) -> &str| {
        let length = name.chars().count();
        let distances = known.iter().map(|other| {
            let other_part = part(other).to_lowercase();
            let far = other_part.chars().count() > 2 * LONGEST;
            (
                if far {
                    usize::MAX
                } else {
                    edits(name, &other_part)
                },
                *other,
            )
        });
        let (distance, found) = distances.min()?;
        (distance < length && distance <= 1.max((length + 1) / 3)).then_some(found)
    };
    // A word that several known names begin with does not tell which of them is meant.
    let shared = known
        .iter()
        .filter(|other| word(other) == word(&name))
        .count()
        > 1;
    nearest(&name, |text| text).or_else(|| nearest(word(&name), word).filter(|_| !shared))
}

/// `; did you mean …?`, if a known name is near, for the end of a message.
///
/// ```
/// use symplectic_exact::suggestion::did_you_mean;
///
/// assert_eq!(did_you_mean("claims", ["claim", "kick", "drift"]), "; did you mean `claim`?");
/// assert_eq!(did_you_mean("order", ["claim", "kick", "drift"]), "");
/// ```
pub fn did_you_mean<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    match suggestion(name, &known) {
        Some(meant) => format!("; did you mean `{meant}`?"),
        None => String::new(),
    }
}

/// The same for a list of names in a message: `symplectic, stable_to(2), or a list of numbers`.
pub(crate) fn among(name: &str, listed: &str) -> String {
    // Advice stands behind a semicolon.
    if listed.contains(';') {
        return String::new();
    }
    let items = listed.split(',').map(str::trim);
    did_you_mean(name, items.filter(|item| is_name(item)))
}

/// A message of a deserializer, with what was probably meant by a key or a word that it does not know.
///
/// ```
/// use symplectic_exact::suggestion::with_suggestion;
///
/// let message = "unknown field `clas`, expected one of `class`, `order`";
/// assert_eq!(with_suggestion(message), format!("{message}; did you mean `class`?"));
/// assert_eq!(with_suggestion("missing field `order`"), "missing field `order`");
/// ```
pub fn with_suggestion(message: &str) -> String {
    let unknown = ["unknown field `", "unknown variant `"];
    let found = unknown.iter().find_map(|start| message.strip_prefix(start));
    let found = found.and_then(|rest| rest.split_once('`'));
    let meant = found.map(|(name, known)| did_you_mean(name, known.split('`').skip(1).step_by(2)));
    format!("{message}{}", meant.unwrap_or_default())
}

/// Whether an item of a list in a message is a name, perhaps with arguments: `stable_to(2)`, `order >= 4`.
fn is_name(item: &str) -> bool {
    let rest = &item[word(item).len()..];
    let count = |bracket: char| item.matches(bracket).count();
    !word(item).is_empty()
        && count('(') == count(')')
        && (rest.is_empty() || [" ", "("].iter().any(|start| rest.starts_with(start)))
        && (!rest.starts_with(' ') || rest.starts_with(" >=") || rest.starts_with(" =="))
}

/// The first word.
fn word(text: &str) -> &str {
    let end = text.find(|c: char| !c.is_alphanumeric() && !matches!(c, '_' | '-' | '.'));
    &text[..end.unwrap_or(text.len())]
}

/// The number of insertions, deletions, changes and exchanges of neighbours that turn one word into another.
pub(crate) fn edits(from: &str, to: &str) -> usize {
    let (from, to): (Vec<char>, Vec<char>) = (from.chars().collect(), to.chars().collect());
    let mut rows = vec![vec![0; to.len() + 1]; from.len() + 1];
    for i in 0..=from.len() {
        for j in 0..=to.len() {
            let mut least = i.max(j);
            if i > 0 && j > 0 {
                let change = rows[i - 1][j - 1] + usize::from(from[i - 1] != to[j - 1]);
                least = change.min(rows[i - 1][j] + 1).min(rows[i][j - 1] + 1);
                if i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1] {
                    least = least.min(rows[i - 2][j - 2] + 1);
                }
            }
            rows[i][j] = least;
        }
    }
    rows[from.len()][to.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suggestions_are_near() {
        let known = ["cos", "exp", "ln", "omega", "sqrt"];
        for (name, meant) in [
            ("cso", Some("cos")),
            ("omgea", Some("omega")),
            ("Omega", Some("omega")),
            ("sqr", Some("sqrt")),
            ("erf", None),
            ("foo", None),
            ("x", None),
            ("", None),
        ] {
            assert_eq!(suggestion(name, &known), meant, "{name}");
        }
        assert_eq!(edits("", "abc"), 3);
        assert_eq!(suggestion(&"x".repeat(10_000), &known), None);
    }

    #[test]
    fn suggestions_are_listed_names_and_not_words_of_the_sentence() {
        let listed = "symplectic, symmetric, order(separable) == 6, order >= 4, order(perturbed) >= (8, 4), stable_to(2), or a list, …";
        for (name, meant) in [
            ("symetric", "; did you mean `symmetric`?"),
            (
                "ordre(separable) == 6",
                "; did you mean `order(separable) == 6`?",
            ),
            ("ordr >= 2", "; did you mean `order >= 4`?"),
            ("stable_to", "; did you mean `stable_to(2)`?"),
            ("order(hamiltonian)", ""),
            ("list", ""),
            ("orr a list of numbers", ""),
        ] {
            assert_eq!(among(name, listed), meant, "{name}");
        }
    }
}
