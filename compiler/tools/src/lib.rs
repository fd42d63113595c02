//! Methods of other programs and for other programs: tables in their languages, programs that take steps, certificates.
//!
//! | what | where |
//! |---|---|
//! | tables of other libraries; what they claim and what is proved | [`import()`], [`import_own`], [`audit`] |
//! | the exact method near printed digits, for files and for Butcher arrays | [`refine()`], [`refine_table()`] |
//! | coefficients in LaTeX, C, Fortran, Julia, Python, SUNDIALS, PETSc, nodepy, RungeKutta.jl, Coq | [`Language::write`] |
//! | programs that take steps, in C, Rust, Julia, Python | [`Stepper::write`] |
//! | what is proved about a method, for `tableaux/check_certificate.py` | [`certificate::write`] |
//!
//! None of it is needed to compile a method: the macros do without.

pub mod audit;
pub mod certificate;
mod import;
mod language;
mod refine;
mod stepper;

pub use import::{ImportOrigin, OwnNames, import, import_own, import_with_origin};
pub use language::Language;
pub use refine::{
    RefinedTable, Refinement, refine, refine_table, refine_table_to_nearest, refine_to_nearest,
};
pub use stepper::{SteppedClass, Stepper};
