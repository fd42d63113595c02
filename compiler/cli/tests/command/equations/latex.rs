//! Equations in LaTeX, rewritten as those of the text format.

/// What is inside the braces at the beginning, and what follows them.
fn group(text: &str) -> (&str, &str) {
    let mut depth = 0;
    for (place, c) in text.char_indices() {
        depth += match c {
            '{' => 1,
            '}' => -1,
            _ => 0,
        };
        if depth == 0 {
            return (&text[1..place], &text[place + 1..]);
        }
    }
    panic!("no group: {text}")
}

/// The text of a formula or an equation.
pub fn text(latex: &str) -> String {
    let mut out = String::new();
    let mut rest = latex;
    while let Some(c) = rest.chars().next() {
        if let Some(command) = rest.strip_prefix('\\') {
            let end = command.find(|c: char| !c.is_ascii_alphabetic());
            let end = end.unwrap_or(command.len()).max(1);
            let (name, after) = command.split_at(end);
            rest = write_command(&mut out, name, after);
        } else if c == '{' {
            // A base with its exponent.
            let (base, after) = group(rest);
            let (exponent, after) = group(after.strip_prefix('^').expect("an exponent"));
            out.push_str(&format!("({})^({})", text(base), text(exponent)));
            rest = after;
        } else if let Some(after) = rest.strip_prefix('_') {
            let (index, after) = group(after);
            write_index(&mut out, index);
            rest = after;
        } else if let Some(after) = rest.strip_prefix("''") {
            out.push('″');
            rest = after;
        } else {
            match c {
                '\'' => out.push('′'),
                '&' => {}
                '-' => out.push('−'),
                c => out.push(c),
            }
            rest = &rest[c.len_utf8()..];
        }
    }
    out
}

fn write_command<'a>(out: &mut String, name: &str, after: &'a str) -> &'a str {
    let word = match name {
        "frac" | "tfrac" => {
            let (above, rest) = group(after);
            let (below, rest) = group(rest);
            out.push_str(&format!("(({})/({}))", text(above), text(below)));
            return rest;
        }
        "sqrt" => {
            let (inner, rest) = group(after);
            out.push_str(&format!("√({})", text(inner)));
            return rest;
        }
        "mathrm" | "operatorname" => {
            let (inner, rest) = group(after);
            out.push_str(&inner.replace("\\_", "_"));
            return rest;
        }
        "dot" => {
            let (inner, rest) = group(after);
            let inner = text(inner);
            let name = inner.find('[').unwrap_or(inner.len());
            out.push_str(&format!("{}'{}", &inner[..name], &inner[name..]));
            return rest;
        }
        "sum" => {
            let (range, rest) = group(after.strip_prefix('_').expect("a range"));
            out.push_str(&format!("Σ({})", text(range)));
            return rest;
        }
        "mathrel" => {
            out.push('+');
            return group(after).1;
        }
        "left" | "right" => "",
        "le" => "≤",
        "in" => "in",
        "quad" => "   ",
        "," | ";" => " ",
        "pi" => "π",
        "lambda" => "λ",
        "mu" => "μ",
        name => name,
    };
    out.push_str(word);
    after
}

/// The index of a vector, of a multiplier, whose first index is a name, or of a part that several equations have in common.
fn write_index(out: &mut String, index: &str) {
    let common = ["s", "u"].iter().any(|letter| {
        let before = out.strip_suffix(letter);
        before.is_some_and(|before| !before.ends_with(char::is_alphanumeric))
    });
    if common && index.chars().all(|c| c.is_ascii_digit()) {
        out.push_str(index);
        return;
    }
    let (name, indices) = match index.strip_prefix("\\mathrm") {
        Some(after) => {
            let (name, indices) = group(after);
            (Some(name), indices.trim_start_matches(','))
        }
        None => (None, index),
    };
    if let Some(name) = name {
        out.push('_');
        out.push_str(name);
    }
    if !indices.is_empty() {
        out.push_str(&format!("[{}]", text(indices).replace('−', "-")));
    }
}
