//! Reading the exact data of a TOML file.

use std::sync::Arc;

use num_rational::BigRational;
use toml::Spanned;

use super::Document;
use super::document::{List, Matrix, document_error};
use crate::algebra::{NodeAlgebra, Tensor};
use crate::arithmetic::polynomial::Polynomial;
use crate::arithmetic::rational;
use crate::error::{Error, ErrorKind};
use crate::exact::Exact;
use crate::expression::{Input, MAX_BITS};
use crate::limits::Limits;
use crate::partitioned::Partitioned;
use crate::quadrature::{first_outside, node_text};
use crate::tableau::Tableau;

/// Reads a tableau from the exact data of a TOML file.
///
/// If the file has functions of the nodes, they give the result, whether or not it follows
/// from the definition; decimals and properties are ignored. Any other tableau is derived again from
/// its definition. [`check`](crate::check()) checks everything.
///
/// # Errors
/// [`ErrorKind::Document`] if the text is not TOML, a key is missing or unknown, a list has a wrong
/// length or an entry is not rational; [`ErrorKind::TooManyStages`]; node polynomials whose roots are
/// not distinct reals in `[0, 1]`. Each with its place in the file.
///
/// ```
/// use symplectic_compiler::{Limits, derive, export::toml};
///
/// let text = toml::write(&derive("polynomial(2)", "lobatto(2)")?, 10);
/// let error = toml::read("verlet.toml", &text.replacen("\"1/2\"", "\"1/0\"", 1), &Limits::default());
/// assert_eq!(
///     error.unwrap_err().to_string(),
///     "verlet.toml, line 14, column 6: `1/0` is not a rational number such as 3 or -3/4"
/// );
/// # Ok::<(), symplectic_compiler::Error>(())
/// ```
pub fn read(file_name: &str, text: &str, limits: &Limits) -> Result<Tableau, Error> {
    let file = Input::of_file(file_name, text);
    let document = Document::parse(file, limits)?;
    let functions = document.derived.as_ref().and_then(|derived| {
        let exact = derived.exact.as_ref()?;
        Some((derived.stages(), exact, exact.node_polynomial.as_ref()?))
    });
    let Some((stages, exact, node_polynomial)) = functions else {
        return document.derive(file, limits);
    };
    let modulus = polynomial(file, node_polynomial)?;
    let algebra = algebra(&modulus, stages).map_err(|kind| {
        let span = node_polynomial.span();
        file.error(&super::super::entries::first_line(text, span), kind)
    })?;
    let origin = document.origin();
    let pair = Partitioned {
        algebra: Arc::new(algebra),
        a: tensor(file, &exact.a)?,
        a_tilde: tensor(file, &exact.a_tilde)?,
        b: polynomial(file, &exact.b)?,
        b_tilde: polynomial(file, &exact.b_tilde)?,
        gradient: None,
    };
    let mut tableau = Tableau::read(origin.definition(), Arc::new(Exact::Nodes(pair)));
    tableau.name = origin.name;
    tableau.provenance.source = origin.source;
    Ok(tableau)
}

fn algebra(modulus: &Polynomial, stages: usize) -> Result<NodeAlgebra, ErrorKind> {
    let algebra = NodeAlgebra::new(modulus)?;
    if algebra.dimension() != stages {
        let message = format!(
            "the node polynomial has {} roots, but there are {stages} stages",
            algebra.dimension()
        );
        return Err(ErrorKind::Document { message });
    }
    match first_outside(&algebra) {
        Some(outside) => Err(ErrorKind::NodeOutside {
            node: node_text(&algebra, outside),
        }),
        None => Ok(algebra),
    }
}

/// A matrix that is known to be present.
fn tensor(file: Input<'_>, rows: &Option<Matrix>) -> Result<Tensor, Error> {
    let rows = rows.iter().flat_map(Spanned::get_ref);
    let columns = rows.map(|row| polynomial(file, row));
    Ok(Tensor::from_columns(columns.collect::<Result<_, _>>()?))
}

fn polynomial(file: Input<'_>, list: &List) -> Result<Polynomial, Error> {
    let coefficients = list.get_ref().iter().map(|entry| number(file, entry));
    let coefficients: Vec<BigRational> = coefficients.collect::<Result<_, _>>()?;
    Ok(Polynomial::from_rationals(&coefficients))
}

fn number(file: Input<'_>, entry: &Spanned<String>) -> Result<BigRational, Error> {
    let text = entry.get_ref();
    // A digit takes more than three bits.
    if text.len() > MAX_BITS / 3 {
        let message = format!("a number with {} characters is too long", text.len());
        return Err(document_error(file, entry.span(), message));
    }
    rational::parse(text).ok_or_else(|| {
        let shown = crate::expression::shown(text);
        let message = format!("`{shown}` is not a rational number such as 3 or -3/4");
        document_error(file, entry.span(), message)
    })
}
