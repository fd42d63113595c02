//! JSON for other programs.
//!
//! ```text
//! {"format": 2, "name", "stages", "basis", "nodes", "definition", "tier", "source",
//!  "c": [N], "c_tilde": [N], "b": [N], "b_tilde": [N], "a": [[N]], "a_tilde": [[N]],
//!  "properties": {"symplectic": P, "symmetric": P, …}}
//!
//! N = {"exact": string or null, "decimal": string, "f64": string, "f32": string}
//! P = {"holds": bool, "evidence": "proved" | "certified" | "refuted" | "verified", "bits": integer or null,
//!      "witness": string or null}
//! ```
//!
//! With gradient kicks there is also `"gradient": [N]`, the `g_i`. `basis` and `nodes` are null if there are none. `definition` is present only if these two do not
//! determine the tableau, and holds all parts of the [`Definition`](crate::Definition). `tier` is the name of the
//! [`Tier`](crate::Tier).
//!
//! `exact` is an expression such as `1/2 - sqrt(3)/6` or `(pi - 4)/(4*pi)`, or null if there is no readable form.
//! `decimal` has the requested number of significant digits, correctly rounded (zero is `0`). `f64` and `f32` are
//! the shortest decimals that read back to the correctly rounded floating-point numbers. `name` and `source` are
//! strings or null. The keys of `properties` are [`Properties::NAMES`](crate::Properties::NAMES).

mod read;
mod write;

pub use read::read;
pub(crate) use read::read_and_compare;
pub(super) use write::evidence;
pub use write::write;
