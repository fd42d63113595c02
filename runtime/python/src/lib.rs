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
mod single;
mod tableau;
mod tables;
mod watch;
mod work;

use pyo3::prelude::*;

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<tableau::Tableau>()?;
    module.add_class::<formula::Formula>()?;
    module.add_class::<problem::Problem>()?;
    module.add_class::<method::Method>()?;
    module.add_function(wrap_pyfunction!(catalogue::catalogue, module)?)?;
    module.add_function(wrap_pyfunction!(catalogue::keys, module)?)?;
    module.add_function(wrap_pyfunction!(tables::audit, module)?)?;
    module.add_function(wrap_pyfunction!(tables::refine, module)?)?;
    module.add_function(wrap_pyfunction!(tables::import_table, module)?)?;
    module.add_function(wrap_pyfunction!(single::integrate, module)?)?;
    module.add_function(wrap_pyfunction!(ensemble::ensemble, module)?)?;
    module.add_function(wrap_pyfunction!(ensemble::section, module)?)?;
    module.add_function(wrap_pyfunction!(ensemble::chaos, module)?)?;
    module.add_function(wrap_pyfunction!(ensemble::transition, module)?)?;
    module.add_function(wrap_pyfunction!(command::command, module)?)
}
