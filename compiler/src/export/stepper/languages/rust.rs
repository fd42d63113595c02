//! Rust.

use super::{Notation, shortest};
use crate::export::language::table::comments;

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
