//! Tableaux in the notation of other programs, ready for use there.
//!
//! | language | holds | methods |
//! |---|---|---|
//! | LaTeX | the partitioned Butcher tableau, `booktabs` | all |
//! | C99, Fortran 2008 | constants, equal to the doubles to the bit | all |
//! | Julia | a named tuple of exact or long numbers, and the constructors that take it | all |
//! | Python | exact or long numbers, for `fractions`, `mpmath`, `numpy` | all |
//! | SUNDIALS | a function that makes a table of ARKODE | splittings; Runge–Kutta methods whose stages follow one another |
//! | PETSc | a function that registers the method | splittings; Runge–Kutta methods with a regular matrix |
//! | nodepy | a `RungeKuttaMethod` with entries of SymPy | Runge–Kutta methods |
//! | TSV of RungeKutta.jl | doubles, as its `from_file` reads them | Runge–Kutta methods |
//! | Coq | the exact table, and a theorem of its orders, symplecticity and symmetry | exact ones with algebraic coefficients |
//!
//! Methods with gradient kicks are written in LaTeX, C, Fortran, Julia and Python, with the weights `g_i` as one more vector.

mod c;
mod coq;
mod fortran;
mod julia;
mod latex;
mod nodepy;
mod petsc;
mod polynomials;
mod python;
mod sundials;
pub(crate) mod table;
mod tsv;

pub(crate) use c::{comment, hexadecimal};

use symplectic_compiler::Tableau;
use symplectic_compiler::{Error, ErrorKind};
use table::Table;

/// A language or a library in whose notation tableaux are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Language {
    /// A table for a paper.
    Latex,
    /// C99: static constants.
    C,
    /// Fortran 2008: a module of parameters.
    Fortran,
    /// Julia: a named tuple.
    Julia,
    /// Python: lists of numeric strings.
    Python,
    /// C for ARKODE of SUNDIALS.
    Sundials,
    /// C for TS of PETSc.
    Petsc,
    /// Python for nodepy.
    Nodepy,
    /// Tab-separated doubles for RungeKutta.jl.
    Tsv,
    /// A theorem for Coq.
    Coq,
}

impl Language {
    /// All languages.
    pub const ALL: [Language; 10] = [
        Language::Latex,
        Language::C,
        Language::Fortran,
        Language::Julia,
        Language::Python,
        Language::Sundials,
        Language::Petsc,
        Language::Nodepy,
        Language::Tsv,
        Language::Coq,
    ];

    /// The library that steps the method by its table, for which a table with gradient kicks has no form; `None` for tables as data.
    fn library(self) -> Option<&'static str> {
        match self {
            Language::Latex
            | Language::C
            | Language::Fortran
            | Language::Julia
            | Language::Python => None,
            Language::Sundials => Some("SUNDIALS"),
            Language::Petsc => Some("PETSc"),
            Language::Nodepy => Some("nodepy"),
            Language::Tsv => Some("RungeKutta.jl"),
            Language::Coq => Some("the theorem for Coq"),
        }
    }

    /// Writes a tableau. Decimals, as numbers or in comments, have `digits ≥ 1` significant digits.
    ///
    /// ```
    /// use symplectic_compiler::derive;
    /// use symplectic_tools::Language;
    ///
    /// let verlet = derive("polynomial(2)", "lobatto(2)")?.named("stormer-verlet");
    /// let text = Language::C.write(&verlet, 17)?;
    /// assert!(text.contains("static const double stormer_verlet_b[2] = {\n    0x1p-1, /* 1/2 */"));
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`ErrorKind::NotExpressible`] for a method that the library, or its file, cannot express, and [`ErrorKind::NoTheorem`] for a method whose
    /// coefficients are not exactly known algebraic numbers.
    pub fn write(self, tableau: &Tableau, digits: usize) -> Result<String, Error> {
        if let Some(library) = self.library()
            && tableau.has_gradient_kicks()
        {
            return Err(not_expressible(library, "it has gradient kicks"));
        }
        let table = Table::new(tableau, digits);
        match self {
            Language::Latex => Ok(latex::write(&table)),
            Language::C => Ok(c::write(&table)),
            Language::Fortran => Ok(fortran::write(&table)),
            Language::Julia => Ok(julia::write(&table)),
            Language::Python => Ok(python::write(&table)),
            Language::Sundials => sundials::write(&table),
            Language::Petsc => petsc::write(&table),
            Language::Nodepy => nodepy::write(&table),
            Language::Tsv => tsv::write(&table),
            Language::Coq => coq::write(&table),
        }
    }
}

/// The error for a method that a library cannot run.
fn not_expressible(library: &'static str, reason: &'static str) -> Error {
    ErrorKind::NotExpressible { library, reason }.into()
}
