//! Templates with placeholders for values.

/// A template with its placeholders filled: `@name@` becomes the value of that name. Other text stays as it is, and values are not
/// searched for placeholders.
pub(super) fn fill(template: &str, values: &[(&str, &str)]) -> String {
    let mut text = String::with_capacity(template.len());
    let mut rest = template;
    while let Some((before, after)) = rest.split_once('@') {
        text.push_str(before);
        let value = after.split_once('@').and_then(|(name, after)| {
            let found = values.iter().find(|(known, _)| *known == name)?;
            Some((found.1, after))
        });
        rest = match value {
            Some((value, after)) => {
                text.push_str(value);
                after
            }
            None => {
                text.push('@');
                after
            }
        };
    }
    text.push_str(rest);
    text
}

#[cfg(test)]
mod tests {
    use super::fill;

    #[test]
    fn template_values_are_not_expanded_again() {
        let values = [("a", "@b@"), ("b", "2")];
        assert_eq!(fill("x@a@y@b@z", &values), "x@b@y2z");
        assert_eq!(fill("me@home, @c@ @b@ @", &values), "me@home, @c@ 2 @");
    }
}
