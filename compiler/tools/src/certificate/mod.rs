//! Certificates: the claims about a method, in a form that an independent program can check.
//!
//! The format is described in the chapter on file formats of the book; `tableaux/check_certificate.py` is such a program. A certificate
//! contains the proved claims, and names the others. The program proves all of them again.

mod claims;
mod levels;
mod numbers;
mod solution;

use self::numbers::Numbers;
use crate::language::hexadecimal;
use symplectic_compiler::Tableau;
use symplectic_compiler::algebra::field::MAX_DEGREE;
use symplectic_compiler::inside::Fact;
use symplectic_compiler::inside::LowerTriangular;
use symplectic_compiler::{Error, ErrorKind};

use Fact::{List, Literal, Text};

/// The version of the format.
const VERSION: usize = 1;

/// Writes the certificate of a tableau as JSON.
///
/// # Errors
/// [`ErrorKind::NotCertified`] for a method whose coefficients are only enclosed: functions such as π together with cosines of nodes,
/// and compositions in a field of degree above 32, except triple jumps and Suzuki's fractals of Störmer–Verlet.
///
/// ```
/// use symplectic_compiler::catalogue;
/// use symplectic_tools::certificate;
///
/// let method = |name| catalogue::find(name).expect("a known method").derive();
/// let text = certificate::write(&method("gauss-2")?)?;
/// assert!(text.contains("\"general\": {\"order\": 4, \"violated\": \"q[q^4]\", \"residual\": \"-0.00555555555556\"}"));
/// assert!(certificate::write(&method("half-wave-gauss-4")?).is_err());
/// # Ok::<(), symplectic_compiler::Error>(())
/// ```
pub fn write(tableau: &Tableau) -> Result<String, Error> {
    let Some(numbers) = Numbers::of(tableau) else {
        let message = format!(
            "there is no certificate of this method: its coefficients are not in one field of algebraic numbers of degree at most {MAX_DEGREE} \
             with π, an exponential or a tangent, not the solution of order conditions, and not those of a triple jump or Suzuki's fractal of \
             `velocity-verlet` or `position-verlet`"
        );
        return Err(ErrorKind::NotCertified { message }.into());
    };
    let mut members = vec![
        ("format", Text("symplectic certificate".to_owned())),
        ("version", Literal(VERSION.to_string())),
        ("name", Text(tableau.name().unwrap_or_default().to_owned())),
        ("stages", Literal(tableau.stages().to_string())),
        ("layout", Text(layout(numbers.lower_triangular).to_owned())),
        ("numbers", numbers.kind),
        ("b", numbers.b),
        ("b_tilde", numbers.b_tilde),
    ];
    members.extend(numbers.gradient.map(|gradient| ("gradient", gradient)));
    if let Some((a, a_tilde)) = numbers.matrices {
        members.extend([("a", a), ("a_tilde", a_tilde)]);
    }
    members.push(("doubles", doubles(tableau, numbers.lower_triangular)));
    members.extend(claims::of(tableau, numbers.lower_triangular));
    let members: Vec<String> = members
        .iter()
        .map(|(key, value)| format!("  \"{key}\": {}", lines(value)))
        .collect();
    Ok(format!("{{\n{}\n}}\n", members.join(",\n")))
}

fn layout(lower_triangular: Option<LowerTriangular>) -> &'static str {
    match lower_triangular {
        None => "matrices",
        Some(LowerTriangular::KicksFirst) => "kicks first",
        Some(LowerTriangular::DriftsFirst) => "drifts first",
    }
}

/// The nearest doubles in hexadecimal; matrices only if the weights do not determine them.
fn doubles(tableau: &Tableau, lower_triangular: Option<LowerTriangular>) -> Fact {
    let doubles = tableau.to_f64();
    let vector = |list: &Vec<f64>| List(list.iter().map(|x| Text(hexadecimal(*x))).collect());
    let mut members = vec![
        ("c", vector(&doubles.c)),
        ("c_tilde", vector(&doubles.c_tilde)),
        ("b", vector(&doubles.b)),
        ("b_tilde", vector(&doubles.b_tilde)),
    ];
    if !doubles.gradient.is_empty() {
        members.push(("gradient", vector(&doubles.gradient)));
    }
    if lower_triangular.is_none() {
        let matrix = |rows: &Vec<Vec<f64>>| List(rows.iter().map(vector).collect());
        members.push(("a", matrix(&doubles.a)));
        members.push(("a_tilde", matrix(&doubles.a_tilde)));
    }
    Fact::Table(members)
}

/// A member as JSON, with a separate line for each entry of lists of lists and of tables.
fn lines(value: &Fact) -> String {
    match value {
        List(rows) if rows.iter().any(|row| matches!(row, List(_))) => {
            let rows: Vec<String> = rows
                .iter()
                .map(|row| format!("    {}", row.json()))
                .collect();
            format!("[\n{}\n  ]", rows.join(",\n"))
        }
        Fact::Table(entries) => {
            let entries: Vec<String> = entries
                .iter()
                .map(|(key, value)| format!("    \"{key}\": {}", value.json()))
                .collect();
            format!("{{\n{}\n  }}", entries.join(",\n"))
        }
        other => other.json(),
    }
}
