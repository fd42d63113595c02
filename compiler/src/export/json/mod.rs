//! JSON for other programs.
//!
//! ```text
//! {"name", "stages", "basis", "nodes", "source",
//!  "c": [N], "c_tilde": [N], "b": [N], "b_tilde": [N], "a": [[N]], "a_tilde": [[N]],
//!  "properties": {"symplectic": P, "symmetric": P, …}}
//!
//! N = {"exact": string or null, "decimal": string, "f64": string}
//! P = {"holds": bool, "evidence": "proved" | "refuted" | "verified", "bits": integer or null,
//!      "witness": string or null}
//! ```
//!
//! `exact` is a [`ClosedForm`](crate::algebra::ClosedForm) such as `1/2 - sqrt(3)/6`, null where there
//! is no short one; `decimal` has the requested number of significant digits, correctly rounded (zero
//! is `0`); `f64` is the shortest decimal that reads back to the correctly rounded double. `name` and
//! `source` are strings or null. The keys of `properties` are
//! [`Properties::NAMES`](crate::Properties::NAMES).

mod read;
mod write;

pub use read::read;
pub(super) use write::evidence;
pub use write::write;
