//! Julia.

use super::formulas::{Count, Field, FieldShape, Formulas, Functions};
use super::{Notation, shortest};
use crate::language::table::comments;

pub(super) const NOTATION: Notation = Notation {
    splitting: include_str!("../templates/splitting.jl.txt"),
    coupled: include_str!("../templates/coupled.jl.txt"),
    add: include_str!("../templates/add.jl.txt"),
    carries: ["false", "true"],
    kick: "    force!(s.slope, @time@, s.q)
    advance!(s.p, s.p_low, h * @weight@, s.slope) # @remark@
",
    carried_kick: "    s.force_is_known || force!(s.slope, @time@, s.q)
    advance!(s.p, s.p_low, h * @weight@, s.slope) # @remark@
",
    drift: "    velocity!(s.slope, @time@, s.p)
    advance!(s.q, s.q_low, h * @weight@, s.slope) # @remark@
",
    vector: "const @VECTOR@ = [\n@entries@]\n",
    entry: "    @number@, # @remark@\n",
    matrix: "const @VECTOR@ = [\n@entries@]\n",
    row: "    [@numbers@],\n",
    number: shortest,
    comment: |lines| comments("#", lines),
    remark: |text| format!("# {text}"),
};

pub(super) const FORMULAS: Formulas = Formulas {
    template: include_str!("../templates/system.jl.txt"),
    indent: 4,
    comment: NOTATION.comment,
    declare,
    usage,
    argument: "@half@",
    start: |_, _, _| String::new(),
    enough: "",
    too_few: TOO_FEW,
    too_few_for_energy: TOO_FEW,
    clear: "fill!(@vector@, 0.0)",
    name: "@name@ = @value@",
    zero: "@name@ = 0.0",
    increase: "@target@ += @value@",
    set: "@target@ = @value@",
    result: "return @value@",
    range: "for @index@ in @start@:@last@",
    pairs: &[
        "for @index@ in 0:length(@list@) - 1",
        "@first@, @second@ = @list@[@index@ + 1] .- 1",
        "0 <= @first@ < @bodies@ && 0 <= @second@ < @bodies@ || @outside@",
    ],
    outside: OUTSIDE,
    outside_energy: OUTSIDE,
    end: "end",
    member: "s.@name@",
    matrix: ["@member@[@i@, @j@]"; 2],
    length_member: "s.@name@",
    length: "n",
    named_length: "@name@",
    count: Count::Expression("length(s.@name@)"),
    multiple: "@count@ * @length@",
    first: 1,
    infinity: "Inf",
    functions: Functions {
        root: "sqrt",
        absolute: "abs",
        or_zero: "ifelse(@b@ == 0.0, 0.0, @a@)",
        logarithm: "log",
        angle: "atan",
        prefix: "",
    },
    words: &[
        "_",
        "baremodule",
        "begin",
        "break",
        "catch",
        "const",
        "continue",
        "do",
        "else",
        "elseif",
        "end",
        "export",
        "false",
        "finally",
        "for",
        "function",
        "global",
        "if",
        "import",
        "in",
        "isa",
        "let",
        "local",
        "macro",
        "module",
        "quote",
        "return",
        "struct",
        "true",
        "try",
        "using",
        "where",
        "while",
    ],
    types: &[
        "B",
        "B_TILDE",
        "Base",
        "C",
        "MAX_SWEEPS",
        "MU",
        "MU_TILDE",
        "STAGES",
        "State",
        "Float64",
        "Inf",
        "Int",
        "Matrix",
        "NaN",
        "Vector",
        "energy",
    ],
};

const TOO_FEW: &str = "    @length@ < @least@ && throw(ArgumentError(\"the formula needs at least @least@ coordinates\"))\n";

const OUTSIDE: &str = "throw(ArgumentError(\"a pair has an index out of range\"))";

fn declare(fields: &[Field], _least: usize) -> String {
    let field = |field: &Field| {
        let kind = match &field.shape {
            FieldShape::Length => "Int",
            FieldShape::Number(_) => "Float64",
            FieldShape::Array { lengths, .. } if lengths.len() == 1 => "Vector{Float64}",
            FieldShape::Array { .. } => "Matrix{Float64}",
            FieldShape::Pairs { .. } => "Vector{Tuple{Int, Int}}",
        };
        let remark = match field.shape {
            FieldShape::Pairs { .. } => " # pairs of indices from 1",
            _ => "",
        };
        let default = field
            .default()
            .map_or_else(String::new, |value| format!(" = {value}"));
        format!("    {}::{kind}{default}{remark}\n", field.name)
    };
    match fields {
        [] => "struct @Type@ end\n".to_owned(),
        fields => {
            let fields: String = fields.iter().map(field).collect();
            format!("Base.@kwdef struct @Type@\n{fields}end\n")
        }
    }
}

fn usage(fields: &[Field]) -> Vec<String> {
    let values = Field::values(fields, |name, value| format!("{name} = {value}"));
    vec![
        format!("system = @module@.@Type@({values})"),
        "velocity!(v, t, @velocity_of@) = @module@.velocity!(system, v, t, @velocity_of@)"
            .to_owned(),
        "force!(f, t, @force_of@) = @module@.force!(system, f, t, @force_of@)".to_owned(),
    ]
}
