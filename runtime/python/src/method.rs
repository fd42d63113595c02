//! Methods that take steps.

use std::sync::Mutex;

use pyo3::prelude::*;
use symplectic::Orders;
use symplectic::at_run_time::{RunTimeCoefficients, RunTimeTableau};
use symplectic_run::method::stepping;

use crate::errors;
use crate::tableau::Tableau;

/// A method that takes steps.
#[pyclass(frozen, module = "symplectica._native")]
pub(crate) struct Method {
    pub(crate) tableau: RunTimeTableau,
    /// Whether it is derived, with proved orders.
    pub(crate) is_proved: bool,
}

/// A derived method.
fn proved(tableau: RunTimeTableau) -> Method {
    Method {
        tableau,
        is_proved: true,
    }
}

/// Methods with steps for constraints, which live as long as the program: with each the text of its exact data and the kind of constraints.
static CONSTRAINED: Mutex<Vec<(String, bool, RunTimeTableau)>> = Mutex::new(Vec::new());

#[pymethods]
impl Method {
    /// A derived method, with its steps for constraints if there are any: holonomic ones or not.
    #[staticmethod]
    #[pyo3(signature = (tableau, holonomic=None))]
    fn derived(py: Python<'_>, tableau: &Tableau, holonomic: Option<bool>) -> PyResult<Self> {
        let exact = &tableau.0;
        let made = || py.detach(|| stepping(exact, holonomic));
        let refused =
            |refusal: symplectic_run::method::Refusal| errors::argument(refusal.to_string());
        let Some(are_holonomic) = holonomic else {
            return made().map(proved).map_err(refused);
        };
        let text = exact.provenance().definition.to_string();
        let lock = || {
            CONSTRAINED
                .lock()
                .map_err(|_| errors::internal("the list of methods is lost"))
        };
        let known = lock()?
            .iter()
            .find(|(known, kind, _)| (known, *kind) == (&text, are_holonomic))
            .map(|(.., method)| method.clone());
        if let Some(method) = known {
            return Ok(proved(method));
        }
        let method = made().map_err(refused)?;
        lock()?.push((text, are_holonomic, method.clone()));
        Ok(proved(method))
    }

    /// A method of doubles, about which nothing is proved. `orders` are believed.
    #[staticmethod]
    fn of_doubles(
        name: &str,
        a: Vec<Vec<f64>>,
        a_tilde: Vec<Vec<f64>>,
        b: Vec<f64>,
        b_tilde: Vec<f64>,
        orders: [u32; 3],
    ) -> PyResult<Self> {
        let sums = |rows: &[Vec<f64>]| rows.iter().map(|row| row.iter().sum()).collect();
        let coefficients = RunTimeCoefficients {
            c: sums(&a),
            c_tilde: sums(&a_tilde),
            a,
            a_tilde,
            b,
            b_tilde,
            gradient: Vec::new(),
        };
        let [general, separable, nystrom] = orders;
        let orders = Orders {
            general,
            separable,
            nystrom,
        };
        RunTimeTableau::new(name, &coefficients, orders)
            .map(|tableau| Method {
                tableau,
                is_proved: false,
            })
            .map_err(|error| errors::argument(error.to_string()))
    }

    #[getter]
    fn name(&self) -> &str {
        self.tableau.name()
    }

    #[getter]
    fn stages(&self) -> usize {
        self.tableau.stages()
    }

    /// The orders for general, separable and Nyström Hamiltonians.
    #[getter]
    fn orders(&self) -> (u32, u32, u32) {
        let orders = self.tableau.orders();
        (orders.general, orders.separable, orders.nystrom)
    }

    #[getter]
    fn is_explicit(&self) -> bool {
        self.tableau.is_explicit()
    }
}
