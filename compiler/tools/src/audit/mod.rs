//! Claims of the tables of other libraries, compared with proofs.
//!
//! ```toml
//! library = "SUNDIALS ARKODE"
//! version = "7.1.1"
//! source = "https://github.com/LLNL/sundials/blob/v7.1.1/src/arkode/arkode_sprk.c"
//! convention = "sundials"            # the name of a `Library`, which says who goes first
//!
//! [[table]]
//! name = "ARKODE_SPRK_RUTH_3_3"
//! order = 3                          # what the library claims
//! class = "separable"                # for which Hamiltonians: general, separable or nystrom
//!
//! [table.numbers]                    # as the library has them, with its letters; each a text that is a number
//! a = ["2/3", "-2/3", "1"]
//! ahat = ["7/24", "3/4", "-1/24"]
//! ```
//!
//! Instead of `convention`, `[steps]` names the lists of a file and says where their order is documented:
//!
//! ```toml
//! [steps]                            # half of a step: drift c_1, kick d_1, …, and back
//! drift = "c"
//! kick = "d"
//! first = "drift"
//! symmetric = true
//! evidence = "leapfrog_step"
//!
//! [steps]                            # in another file: the fractions of the steps of a splitting
//! weights = "w"
//! base = "velocity-verlet"
//! evidence = "CompositionMethod::step"
//! ```
//!
//! For each table the order for each class of Hamiltonians is proved, with the first violated order condition, and whether
//! it is symmetric and symplectic. Its decimals are compared with those of the exact method near them. The report also has the order
//! that is [observed](symplectic_compiler::Tableau::observed_order) on a pendulum of each class. A difference between claim and proof that is not observed
//! is reported as unexplained.

mod convention;
mod file;
mod html;
mod lists;
mod row;

pub use row::{Claim, ProvedOrder, Row, Verdict};

use serde::Serialize;

use symplectic_compiler::Error;
use symplectic_compiler::Limits;
use symplectic_compiler::expression::Input;

/// The audited tables of some files.
#[derive(Debug, Clone, Default, Serialize)]
pub struct Audit {
    /// One row per table, in the order of the files.
    pub rows: Vec<Row>,
}

impl Audit {
    /// Adds the tables of a file.
    ///
    /// ```
    /// use symplectic_compiler::Limits;
    /// use symplectic_tools::audit::{Audit, Verdict};
    ///
    /// let text = r#"
    /// library = "SciML"
    /// version = "of an example"
    /// source = "https://github.com/SciML/OrdinaryDiffEq.jl"
    /// convention = "sciml"
    ///
    /// [[table]]
    /// name = "PseudoVerletLeapfrog"
    /// order = 3
    /// class = "separable"
    ///
    /// [table.numbers]
    /// a = ["1", "0"]
    /// b = ["1//2", "1//2"]
    /// "#;
    /// let mut audit = Audit::default();
    /// audit.add("sciml.toml", text, &Limits::default())?;
    /// let row = &audit.rows[0];
    /// assert_eq!((row.separable.order, row.verdict, row.explained), (2, Verdict::LessThanClaimed, true));
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`ErrorKind::Document`](symplectic_compiler::ErrorKind::Document) for a file that does not have this form, for example without `convention` and `[steps]`;
    /// [`ErrorKind::Unknown`](symplectic_compiler::ErrorKind::Unknown) for an unknown convention or class;
    /// [`ErrorKind::Syntax`](symplectic_compiler::ErrorKind::Syntax) for the first text that is not a number. Each with its place.
    pub fn add(&mut self, file_name: &str, text: &str, limits: &Limits) -> Result<(), Error> {
        let rows = file::rows(Input::of_file(file_name, text), limits)?;
        self.rows.extend(rows);
        Ok(())
    }

    /// The tables whose proved order differs from their claim.
    pub fn differences(&self) -> impl Iterator<Item = &Row> {
        self.rows
            .iter()
            .filter(|row| row.verdict != Verdict::AsClaimed)
    }

    /// The tables whose proved order differs from the observed order.
    pub fn unexplained(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| !row.explained)
    }

    /// The audit as JSON: `{"rows": [{"library", "version", "source", "name", "claim": {"order", "class"}, "general": C, "separable":
    /// C, "nystrom": C, …}]}` with `C = {"order", "evidence", "violated", "residual"}`.
    pub fn json(&self) -> String {
        let mut text = serde_json::to_string_pretty(self).unwrap_or_default();
        text.push('\n');
        text
    }

    /// The audit as a single self-contained page.
    pub fn html(&self) -> String {
        html::page(self)
    }
}
