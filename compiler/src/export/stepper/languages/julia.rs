//! Julia.

use super::{Notation, shortest};
use crate::export::language::table::comments;

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
