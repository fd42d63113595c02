//! Systems by their formulas: what is derived and emitted, and what is refused.
//!
//! `UPDATE_EXPECT=1 cargo test -p symplectic-formula --test systems` writes the forms anew.

mod formula;
mod formulas;
mod kinks;
mod lagrangians;
mod names;
