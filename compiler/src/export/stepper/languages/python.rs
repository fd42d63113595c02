//! Python.

use super::{Notation, shortest};
use crate::export::language::table::comments;

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
