//! TOML, the lossless exchange format, which people can read too.
//!
//! ```toml
//! name = "midpoint"                    # may be absent
//! stages = 1
//!
//! [provenance]
//! basis = "1"
//! nodes = "1/2"
//! source = "Leok & Zhang, Example 2"   # may be absent
//!
//! [exact]
//! node_polynomial = ["-1", "2"]        # coefficients of 1, x, x², …; the nodes are its roots
//! b = ["1"]                            # b_i = b(c_i), coefficients of 1, x, …
//! b_tilde = ["1"]
//! a = [["1/2"]]                        # a_ij = a(c_i, c_j); a row for each power of y
//! a_tilde = [["1/2"]]
//!
//! [decimals]                           # c, c_tilde, b, b_tilde, a, a_tilde, correctly rounded
//! digits = 3
//! # …
//!
//! [properties]
//! symplectic = { holds = true, evidence = "proved" }
//! # … each of them
//! ```
//!
//! All quantities with one index are polynomials in a node, and all with two indices are polynomials in two
//! nodes, so rational coefficients represent irrational tableaux exactly. Every list has as many
//! entries as there are stages; the node polynomial has one more.
//!
//! If the tier is `constant field`, `[exact]` has no node polynomial, and its entries are expressions
//! such as `"(pi - 4)/(4*pi)"`. If it is `enclosure`, there is no `[exact]`: the definition is the
//! lossless part. The matrices of a splitting with more than 36 stages are left out, because its weights determine them.
//! With gradient kicks both `[exact]` and `[decimals]` have a list `gradient`, the `g_i`.
//!
//! Write only the definition; [`check`](crate::check()), [`read`] and the macro derive the rest:
//!
//! ```toml
//! name = "kutta-3"
//!
//! [provenance]                         # the keys of a Definition
//! a = "[[0, 0, 0], [1/2, 0, 0], [-1, 2, 0]]"
//! b = "1/6, 2/3, 1/6"
//! ```

mod document;
mod read;
mod write;

pub(crate) use document::Document;
pub use read::read;
pub use write::write;
