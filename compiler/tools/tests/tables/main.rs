//! Tables of other programs, read and written.
//!
//! `UPDATE_EXPECT=1 cargo test -p symplectic-tools -- --include-ignored` writes the catalogue in `tableaux/` anew.

mod catalogue;
mod imports;
mod kept_as_written;
mod own_names;
