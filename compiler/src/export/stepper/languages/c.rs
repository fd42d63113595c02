//! C99.

use super::Notation;
use crate::export::language::{comment, hexadecimal};

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
