//! Rust.

use super::formulas::{Count, Field, FieldShape, Formulas, Functions};
use super::{Notation, shortest};
use crate::language::table::comments;

pub(super) const NOTATION: Notation = Notation {
    splitting: include_str!("../templates/splitting.rs.txt"),
    coupled: include_str!("../templates/coupled.rs.txt"),
    add: include_str!("../templates/add.rs.txt"),
    carries: ["None", "Some(force)"],
    kick: "        let force = system.force(@time@, &s.q);
        s.kick(h * @weight@, &force); // @remark@
",
    carried_kick: "        let force = s.force.unwrap_or_else(|| system.force(@time@, &s.q));
        s.kick(h * @weight@, &force); // @remark@
",
    drift: "        let velocity = system.velocity(@time@, &s.p);
        s.drift(h * @weight@, &velocity); // @remark@
",
    vector: "const @VECTOR@: [f64; STAGES] = [\n@entries@];\n",
    entry: "    @number@, // @remark@\n",
    matrix: "const @VECTOR@: [[f64; STAGES]; STAGES] = [\n@entries@];\n",
    row: "    [@numbers@],\n",
    number: shortest,
    comment: |lines| comments("//", lines),
    remark: |text| format!("// {text}"),
};

pub(super) const FORMULAS: Formulas = Formulas {
    template: include_str!("../templates/system.rs.txt"),
    indent: 8,
    comment: NOTATION.comment,
    declare,
    usage,
    argument: "@half@: &[f64; DIMENSION]",
    start: |_, _, _| String::new(),
    enough: "const _: () = assert!(@length@ >= @least@);\n",
    too_few: "",
    too_few_for_energy: "",
    clear: "",
    name: "let @name@ = @value@;",
    zero: "let mut @name@ = 0.0;",
    increase: "@target@ += @value@;",
    set: "@target@ = @value@;",
    result: "@value@",
    range: "for @index@ in @start@..@end@ {",
    pairs: &[
        "for (@index@, &(@first@, @second@)) in @list@.iter().enumerate() {",
        "if @first@ >= @bodies@ || @second@ >= @bodies@ {",
        "    return @outside@;",
        "}",
    ],
    outside: "[f64::NAN; DIMENSION]",
    outside_energy: "f64::NAN",
    end: "}",
    member: "self.@name@",
    matrix: ["@member@[@i@][@j@]"; 2],
    length_member: "@name@",
    length: "LENGTH",
    named_length: "LENGTH_@name@",
    count: Count::Length("LENGTH_@name@"),
    multiple: "@count@ * @length@",
    first: 0,
    infinity: "f64::INFINITY",
    functions: Functions {
        root: "f64::sqrt",
        absolute: "f64::abs",
        or_zero: "if @b@ == 0.0 { 0.0 } else { @a@ }",
        logarithm: "f64::ln",
        angle: "f64::atan2",
        prefix: "f64::",
    },
    words: &[
        "_", "as", "async", "await", "abstract", "become", "box", "break", "const", "continue",
        "crate", "do", "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if",
        "impl", "in", "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv",
        "pub", "ref", "return", "self", "Self", "static", "struct", "super", "trait", "true",
        "try", "type", "typeof", "unsafe", "unsized", "use", "virtual", "where", "while", "yield",
    ],
    types: &[
        "Err", "Failure", "None", "Ok", "Option", "Result", "Self", "Some", "Stages", "State",
        "System", "f64",
    ],
};

fn declare(fields: &[Field], least: usize) -> String {
    let mut text = String::new();
    for field in fields {
        if let FieldShape::Length = field.shape {
            let (name, value) = (&field.name, least.max(2));
            let small = match name.contains(char::is_lowercase) {
                true => "#[allow(non_upper_case_globals)]\n",
                false => "",
            };
            text.push_str(&format!(
                "/// A length that the formula leaves open: set it here.\n{small}pub const {name}: usize = {value};\n\n"
            ));
        }
    }
    let members = fields.iter().filter_map(|Field { name, shape }| {
        let kind = match shape {
            FieldShape::Length => return None,
            FieldShape::Number(_) => "f64".to_owned(),
            FieldShape::Array { lengths, .. } => {
                lengths.iter().rev().fold("f64".to_owned(), |kind, length| {
                    format!("[{kind}; {length}]")
                })
            }
            FieldShape::Pairs { count } => format!("[(usize, usize); {count}]"),
        };
        Some(format!("    pub {name}: {kind},\n"))
    });
    let members: String = members.collect();
    text.push_str("#[allow(non_snake_case)]\n#[derive(Clone, Copy, Debug)]\n");
    text.push_str(&match members.is_empty() {
        true => "pub struct @Type@;\n".to_owned(),
        false => format!("pub struct @Type@ {{\n{members}}}\n"),
    });
    text
}

fn usage(fields: &[Field]) -> Vec<String> {
    let is_parameter = |field: &&Field| !matches!(field.shape, FieldShape::Length);
    let values = fields.iter().filter(is_parameter).map(|field| {
        let value = field.default().unwrap_or_else(|| "...".to_owned());
        format!("{}: {value}", field.name)
    });
    let values: Vec<String> = values.collect();
    vec![match values.is_empty() {
        true => "let system = @Type@;".to_owned(),
        false => format!("let system = @Type@ {{ {} }};", values.join(", ")),
    }]
}
