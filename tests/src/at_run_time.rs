//! Conversion of derived tableaux to tableaux at run time.

use symplectic::Orders;
use symplectic::at_run_time::{RunTimeCoefficients, RunTimeTableau, TableauError};
use symplectic_compiler::Tableau;

/// A derived tableau as a tableau at run time, with correctly rounded coefficients and the proved orders.
///
/// # Errors
///
/// [`TableauError`] if it is not symplectic.
pub fn tableau(name: &str, exact: &Tableau) -> Result<RunTimeTableau, TableauError> {
    let symplectic_compiler::Coefficients {
        a,
        a_tilde,
        b,
        b_tilde,
        c,
        c_tilde,
        gradient,
    } = exact.to_f64();
    let coefficients = RunTimeCoefficients {
        a,
        a_tilde,
        b,
        b_tilde,
        c,
        c_tilde,
        gradient,
    };
    let orders = exact.orders();
    let order = |order: usize| u32::try_from(order).unwrap_or(u32::MAX);
    let orders = Orders {
        general: order(orders.general.order),
        separable: order(orders.separable.order),
        nystrom: order(orders.nystrom.order),
    };
    RunTimeTableau::new(name, &coefficients, orders)
}

#[cfg(test)]
mod tests {
    use symplectic_compiler::catalogue;

    use super::*;

    /// The limit on stages of the macros.
    const STAGES: usize = 36;

    #[test]
    fn every_symplectic_method_of_the_catalogue_is_one_at_run_time() {
        let mut taken = 0;
        for entry in catalogue::entries().filter(|entry| entry.stages <= STAGES) {
            let exact = entry.derive().expect("derived");
            let is_symplectic = exact.properties().symplectic.holds
                || exact.separable_properties().symplectic.holds;
            let found = tableau(&entry.name, &exact);
            let is_taken = is_symplectic && !exact.has_gradient_kicks();
            assert_eq!(found.is_ok(), is_taken, "{}: {found:?}", entry.name);
            let Ok(found) = found else { continue };
            taken += 1;
            let accepts = exact.keeps_its_order_in_general();
            assert_eq!(found.orders().general >= found.orders().separable, accepts);
        }
        assert!(taken > 100, "{taken}");
    }
}
