//! The extension module of the Python package `symplectica`: derivation, proofs, formulas and runs. The package itself, in Python, has the
//! objects that people use.

mod catalogue;
mod command;
mod emitted;
mod ensemble;
mod errors;
mod events;
mod formula;
mod method;
mod problem;
mod search;
mod single;
mod tableau;
mod tables;
mod watch;
mod work;

use pyo3::pymodule;

#[pymodule]
mod _native {
    #[pymodule_export]
    use super::catalogue::{catalogue, keys};
    #[pymodule_export]
    use super::command::command;
    #[pymodule_export]
    use super::ensemble::{chaos, ensemble, section, transition};
    #[pymodule_export]
    use super::formula::Formula;
    #[pymodule_export]
    use super::method::Method;
    #[pymodule_export]
    use super::problem::Problem;
    #[pymodule_export]
    use super::search::search;
    #[pymodule_export]
    use super::single::integrate;
    #[pymodule_export]
    use super::tableau::Tableau;
    #[pymodule_export]
    use super::tables::{audit, import_table, refine};

    /// The version of the package.
    #[pymodule_export]
    #[allow(non_upper_case_globals)]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
