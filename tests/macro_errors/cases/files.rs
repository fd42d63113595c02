//! Files that are not what the macro needs, beside the case that uses them.

symplectic::tableau! {
    NotToml { file: "not_toml.toml" }
    NoTable { file: "no_table.toml" }
    Truncated { file: "truncated.toml" }
    LastDigit { file: "last_digit.toml" }
    Refuted { file: "lobatto-3.toml", require: [symplectic, explicit] }
    NoExtension { file: "not_toml.txt" }
}

fn main() {}
