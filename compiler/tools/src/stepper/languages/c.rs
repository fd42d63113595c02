//! C99.

use super::Notation;
use super::formulas::{Count, Field, FieldShape, Formulas, Functions};
use crate::language::{comment, hexadecimal};

pub(super) const NOTATION: Notation = Notation {
    splitting: include_str!("../templates/splitting.c.txt"),
    coupled: include_str!("../templates/coupled.c.txt"),
    add: include_str!("../templates/add.c.txt"),
    carries: ["0", "1"],
    kick: "    system->force(@time@, s->q, s->slope, system->context);
    @name@_kick(s, h * @weight@); /* @remark@ */
",
    carried_kick:
        "    if (!s->force_is_known) system->force(@time@, s->q, s->slope, system->context);
    @name@_kick(s, h * @weight@); /* @remark@ */
",
    drift: "    system->velocity(@time@, s->p, s->slope, system->context);
    @name@_drift(s, h * @weight@); /* @remark@ */
",
    vector: "static const double @name@_@vector@[@NAME@_STAGES] = {\n@entries@};\n",
    entry: "    @number@, /* @remark@ */\n",
    matrix: "static const double @name@_@vector@[@NAME@_STAGES][@NAME@_STAGES] = {\n@entries@};\n",
    row: "    {@numbers@},\n",
    number: hexadecimal,
    comment,
    remark: |text| format!("/* {text} */"),
};

pub(super) const FORMULAS: Formulas = Formulas {
    template: include_str!("../templates/system.c.txt"),
    indent: 4,
    comment,
    declare,
    usage,
    argument: "const double *@half@",
    start,
    enough: "",
    too_few: "    if (@length@ < @least@) {
        for (size_t i = 0; i < @dimension@; i++) @vector@[i] = NAN;
        return;
    }
",
    too_few_for_energy: "    if (@length@ < @least@) return NAN;\n",
    clear: "for (size_t i = 0; i < @dimension@; i++) @vector@[i] = 0.0;",
    name: "const double @name@ = @value@;",
    zero: "double @name@ = 0.0;",
    increase: "@target@ += @value@;",
    set: "@target@ = @value@;",
    result: "return @value@;",
    range: "for (size_t @index@ = @start@; @before@ < @limit@; @index@++) {",
    pairs: &[
        "for (size_t @index@ = 0; @index@ < @count@; @index@++) {",
        "const size_t @first@ = @list@[@index@][0], @second@ = @list@[@index@][1];",
        "if (@first@ >= @bodies@ || @second@ >= @bodies@) @outside@",
    ],
    outside: "{ for (size_t i = 0; i < @dimension@; i++) @vector@[i] = NAN; return; }",
    outside_energy: "return NAN;",
    end: "}",
    member: "s->@name@",
    matrix: ["@member@[@row@ * @columns@ + @j@]", "@member@[@i@][@j@]"],
    length_member: "s->@name@",
    length: "n",
    named_length: "@name@",
    count: Count::Length("@name@_count"),
    multiple: "@count@ * @length@",
    first: 0,
    infinity: "INFINITY",
    functions: Functions {
        root: "sqrt",
        absolute: "fabs",
        or_zero: "@b@ == 0.0 ? 0.0 : @a@",
        logarithm: "log",
        angle: "atan2",
        prefix: "",
    },
    words: &[
        "_", "auto", "break", "case", "char", "const", "continue", "default", "do", "double",
        "else", "enum", "extern", "float", "for", "goto", "if", "inline", "int", "long",
        "register", "restrict", "return", "short", "signed", "sizeof", "static", "struct",
        "switch", "typedef", "union", "unsigned", "void", "volatile", "while", "NAN", "INFINITY",
        "NULL", "alignas", "alignof", "bool", "false", "linux", "nullptr", "true", "typeof",
        "unix",
    ],
    types: &[],
};

fn declare(fields: &[Field], _least: usize) -> String {
    let field = |field: &Field| {
        let name = &field.name;
        match &field.shape {
            FieldShape::Length => format!("    size_t {name};\n"),
            FieldShape::Number(_) => format!("    double {name};\n"),
            FieldShape::Array {
                lengths,
                is_fixed: true,
            } => {
                format!("    double {name}[{}];\n", lengths.join("]["))
            }
            FieldShape::Array {
                lengths,
                is_fixed: false,
            } => {
                let rows = ["", ", by rows"][usize::from(lengths.len() > 1)];
                let names = lengths.iter().map(|name| name.trim_start_matches("s->"));
                let lengths = names.collect::<Vec<_>>().join(" x ");
                format!("    const double *{name}; /* {lengths} numbers{rows} */\n")
            }
            FieldShape::Pairs { count } => {
                let count = count.trim_start_matches("s->");
                format!("    const size_t (*{name})[2]; /* {count} pairs of indices from 0 */\n")
            }
        }
    };
    match fields {
        [] => String::new(),
        fields => {
            let fields: String = fields.iter().map(field).collect();
            format!("typedef struct {{\n{fields}}} @system@_parameters;\n")
        }
    }
}

fn usage(fields: &[Field]) -> Vec<String> {
    let system = |context: &str| {
        format!("@name@_system system = {{@system@_velocity, @system@_force, {context}}};")
    };
    match fields {
        [] => vec![system("NULL")],
        fields => {
            let values = Field::values(fields, |name, value| format!(".{name} = {value}"));
            let parameters = format!("@system@_parameters parameters = {{{values}}};");
            vec![parameters, system("&parameters")]
        }
    }
}

/// The parameters, and arguments that are not used.
fn start(body: &str, prefix: &str, vectors: &[&str]) -> String {
    let mut text = match body.contains("s->") {
        true => format!("    const {prefix}_parameters *s = context;\n"),
        false => "    (void)context;\n".to_owned(),
    };
    let words: Vec<&str> = body
        .split(|c: char| !(c.is_alphanumeric() || c == '_'))
        .collect();
    for name in [&["t"], vectors].concat() {
        if !words.contains(&name) {
            text.push_str(&format!("    (void){name};\n"));
        }
    }
    text
}
