//! Python.

use super::formulas::{Count, Field, Formulas, Functions};
use super::{Notation, shortest};
use crate::language::table::comments;

pub(super) const NOTATION: Notation = Notation {
    splitting: include_str!("../templates/splitting.py.txt"),
    coupled: include_str!("../templates/coupled.py.txt"),
    add: include_str!("../templates/add.py.txt"),
    carries: ["None", "list(f)"],
    kick: "    f = force(@time@, q)
    _advance(p, p_low, h * @weight@, f)  # @remark@
",
    carried_kick: "    f = force(@time@, q) if state.force is None else state.force
    _advance(p, p_low, h * @weight@, f)  # @remark@
",
    drift: "    v = velocity(@time@, p)
    _advance(q, q_low, h * @weight@, v)  # @remark@
",
    vector: "@VECTOR@ = [\n@entries@]\n",
    entry: "    @number@,  # @remark@\n",
    matrix: "@VECTOR@ = [\n@entries@]\n",
    row: "    [@numbers@],\n",
    number: shortest,
    comment: |lines| comments("#", lines),
    remark: |text| format!("# {text}"),
};

pub(super) const FORMULAS: Formulas = Formulas {
    template: include_str!("../templates/system.py.txt"),
    indent: 8,
    comment: NOTATION.comment,
    declare,
    usage,
    argument: "@half@",
    start: |_, _, _| String::new(),
    enough: "",
    too_few: TOO_FEW,
    too_few_for_energy: TOO_FEW,
    clear: "",
    name: "@name@ = @value@",
    zero: "@name@ = 0.0",
    increase: "@target@ += @value@",
    set: "@target@ = @value@",
    result: "return @value@",
    range: "for @index@ in range(@start@, @end@):",
    pairs: &[
        "for @index@, (@first@, @second@) in enumerate(@list@):",
        "if not (0 <= @first@ < @bodies@ and 0 <= @second@ < @bodies@):",
        "    @outside@",
    ],
    outside: OUTSIDE,
    outside_energy: OUTSIDE,
    end: "",
    member: "self.@name@",
    matrix: ["@member@[@i@][@j@]"; 2],
    length_member: "self.@name@",
    length: "n",
    named_length: "@name@",
    count: Count::Expression("len(self.@name@)"),
    multiple: "(@count@ * @length@)",
    first: 0,
    infinity: "math.inf",
    functions: Functions {
        root: "math.sqrt",
        absolute: "abs",
        or_zero: "@a@ if @b@ != 0.0 else 0.0",
        logarithm: "math.log",
        angle: "math.atan2",
        prefix: "math.",
    },
    words: &[
        "False", "None", "True", "and", "as", "assert", "async", "await", "break", "class",
        "continue", "def", "del", "elif", "else", "except", "finally", "for", "from", "global",
        "if", "import", "in", "is", "lambda", "nonlocal", "not", "or", "pass", "raise", "return",
        "try", "while", "with", "yield", "self", "velocity", "force", "energy",
    ],
    types: &[
        "False",
        "None",
        "True",
        "DoesNotConverge",
        "NotFinite",
        "State",
        "B",
        "B_TILDE",
        "C",
        "MAX_SWEEPS",
        "MU",
        "MU_TILDE",
        "STAGES",
        "ArithmeticError",
        "ValueError",
        "math",
        "step",
        "sys",
    ],
};

const TOO_FEW: &str = "        if @length@ < @least@:
            raise ValueError(\"the formula needs at least @least@ coordinates\")
";

const OUTSIDE: &str = "raise ValueError(\"a pair has an index out of range\")";

fn declare(fields: &[Field], _least: usize) -> String {
    if fields.is_empty() {
        return String::new();
    }
    // Arguments without a default come first.
    let (given, others): (Vec<&Field>, Vec<&Field>) =
        fields.iter().partition(|field| field.default().is_none());
    let arguments = given
        .iter()
        .chain(&others)
        .map(|field| match field.default() {
            None => field.name.clone(),
            Some(value) => format!("{}={value}", field.name),
        });
    let arguments: Vec<String> = arguments.collect();
    let members = fields
        .iter()
        .map(|Field { name, .. }| format!("        self.{name} = {name}\n"));
    let members: String = members.collect();
    format!(
        "    def __init__(self, {}):\n{members}\n",
        arguments.join(", ")
    )
}

fn usage(fields: &[Field]) -> Vec<String> {
    let values = Field::values(fields, |name, value| format!("{name}={value}"));
    vec![
        format!("system = @Type@({values})"),
        "step(state, system.velocity, system.force, t0 + k * h, h)".to_owned(),
    ]
}
