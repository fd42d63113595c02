//! Methods as papers print them: files with digits and a claim, refined to exact methods.
//!
//! ```toml
//! name = "triple-jump"
//! source = "Forest & Ruth, Physica D 43 (1990)"
//!
//! [claim]
//! class = "separable"        # H = T(p) + U(q), or "nystrom" for quadratic T
//! order = 4                  # or perturbed = [8, 6, 4] instead of both, for H_A + εH_B
//!
//! [printed]                  # in the order of the step, each drift after the kick of the same number
//! kick = ["0.67560360", "-0.17560360", "-0.17560360", "0.67560360"]
//! drift = ["1.35120719", "-1.70241438", "1.35120719", "0"]
//! ```
//!
//! Instead of `kick` and `drift` a file may have `weights`, the weights of a composition of any symmetric basic method of
//! order 2; then the claim is just an `order`.

mod file;
mod table;
mod write;

pub use table::{RefinedTable, refine_table, refine_table_to_nearest};

use serde::Serialize as _;

use symplectic_compiler::Error;
use symplectic_compiler::certify::{Certificate, Coefficient, Printed};
use symplectic_compiler::expression::Input;

/// An exact method behind printed digits.
#[derive(Debug, Clone)]
pub struct Refinement {
    name: Option<String>,
    source: Option<String>,
    printed: Vec<(Coefficient, Printed)>,
    certificate: Certificate,
}

/// Reads a file with printed coefficients and proves that an exact method of the claimed order is near them.
///
/// ```
/// let text = r#"
/// [claim]
/// class = "separable"
/// order = 4
///
/// [printed]
/// kick = ["0.67560360", "-0.17560360", "-0.17560360", "0.67560360"]
/// drift = ["1.35120719", "-1.70241438", "1.35120719", "0"]
/// "#;
/// let refinement = symplectic_tools::refine("jump.toml", text)?;
/// assert!(refinement.text(30)?.contains("drift[0]   1.35120719195965763404768780897"));
///
/// let wrong = text.replace("-1.70241438", "-1.70241338");
/// let error = symplectic_tools::refine("jump.toml", &wrong).unwrap_err();
/// assert!(error.to_string().starts_with("jump.toml, line 8, column 9: the drifts sum to 1.000001, not to 1;"));
/// # Ok::<(), symplectic_compiler::Error>(())
/// ```
///
/// # Errors
/// [`ErrorKind::Document`](symplectic_compiler::ErrorKind::Document) for an invalid file: missing and unknown keys, texts that are not
/// numbers, lists of different length, impossible claims. [`ErrorKind::NotCertified`](symplectic_compiler::ErrorKind::NotCertified) if
/// the digits are not those of a method with the claimed order: they do not sum to 1, are too few, or no solution is near
/// them. The error gives the distance of the nearest solution that was found. Each with its place in the file.
pub fn refine(file_name: &str, text: &str) -> Result<Refinement, Error> {
    file::refine(Input::of_file(file_name, text), false)
}

/// The same with the solution that was found, however far it is from the digits.
///
/// ```
/// let text = r#"
/// [claim]
/// class = "separable"
/// order = 2
///
/// [printed]
/// kick = ["0.4", "0.6"]
/// drift = ["1", "0"]
/// "#;
/// assert!(symplectic_tools::refine("verlet.toml", text).is_err());
/// let verlet = symplectic_tools::refine_to_nearest("verlet.toml", text)?;
/// assert_eq!(verlet.certificate().distance_text(), "0.10");
/// # Ok::<(), symplectic_compiler::Error>(())
/// ```
///
/// # Errors
/// Those of [`refine()`], except for digits that are too far from the solution.
pub fn refine_to_nearest(file_name: &str, text: &str) -> Result<Refinement, Error> {
    file::refine(Input::of_file(file_name, text), true)
}

impl Refinement {
    /// The name in the file.
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// The source in the file.
    pub fn source(&self) -> Option<&str> {
        self.source.as_deref()
    }

    /// The certificate of the exact method.
    pub fn certificate(&self) -> &Certificate {
        &self.certificate
    }

    /// The coefficients as printed.
    pub fn printed(&self) -> &[(Coefficient, Printed)] {
        &self.printed
    }

    /// The proved facts and all coefficients to `digits` significant digits, for people.
    ///
    /// # Errors
    /// [`ErrorKind::NotCertified`](symplectic_compiler::ErrorKind::NotCertified) for more digits than are computed.
    pub fn text(&self, digits: usize) -> Result<String, Error> {
        write::text(self, digits)
    }

    /// The proved facts and all coefficients to `digits` significant digits, as JSON.
    ///
    /// ```text
    /// {"name", "source", "claim": string, "evidence": "certified", "distance": D, "structure", "conditions", "unknowns",
    ///  "fixed": [{"coefficient", "value", "as_printed": bool}], "exact": bool, "uniqueness_radius": D or null,
    ///  "next_order_refuted": bool or null, "wrong_digits": [{"coefficient", "distance": D}],
    ///  "printed_digits": "all", "excluded" or "not found", "could_be_wrong_instead": [coefficient], "digits",
    ///  "kick": [C], "drift": [C]} or {…, "weights": [C]}
    ///
    /// C = {"printed": string, "exact": string or null, "decimal": string}, D = "1.9e-15"
    /// ```
    ///
    /// # Errors
    /// The errors of [`Refinement::text`].
    pub fn json(&self, digits: usize) -> Result<String, Error> {
        let report = write::report(self, digits)?;
        let mut text = Vec::new();
        let mut serializer = serde_json::Serializer::pretty(&mut text);
        // Writing strings and numbers to a vector of bytes cannot fail.
        let written = report.serialize(&mut serializer);
        debug_assert!(written.is_ok());
        text.push(b'\n');
        Ok(String::from_utf8_lossy(&text).into_owned())
    }
}
