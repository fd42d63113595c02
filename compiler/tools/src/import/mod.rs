//! Tables of other libraries, read with the order in which each library steps its numbers.
//!
//! A file holds the numbers of one table, in the language of the library: Julia's `1//2` and `big"0.5"`, C's `0x1.8p-1`, Fortran's
//! `1.0d0` and `0.5_real64`, Mathematica's `` 1.5`20 ``, Python's `Fraction(1, 2)`, Matlab's `[1 2; 3 4]`. Numbers are exact: a
//! decimal is a rational number, `sqrt(2)` is a root, and an expression of other numbers is exact given these. Decimals that satisfy the
//! conditions of their order as they are written are kept. Otherwise they are rounded, and the table is that of the exact method that is
//! [proved](symplectic_compiler::certify) to be near them.

mod numbers;
mod own;
mod tsv;

pub(crate) use numbers::{Flows, Numbers, Origin, half};
pub use own::{OwnNames, import_own};

use symplectic_compiler::Limits;
use symplectic_compiler::Tableau;
use symplectic_compiler::expression::Input;
use symplectic_compiler::inside::{Source, Value, zero};
use symplectic_compiler::{Error, ErrorKind};
use symplectic_compiler::{Library, Stepping};
use symplectic_exact::rounding::to_f64;

/// Reads a table in the form of a library.
///
/// The letters and the order of kicks and drifts are those of [`Library::stepping`]. Butcher tables have `A` or `a`, `b`, optionally
/// `c`, and optionally `a_tilde`, `b_tilde`. Matrices are read row by row. Everything else in the file is skipped. For RungeKutta.jl
/// the file may also be the tab-separated one of its `to_file`.
///
/// ```
/// use symplectic_compiler::{Library, Limits};
/// use symplectic_tools::import;
///
/// // Ruth's method of order 3: SUNDIALS kicks first.
/// let text = "sunrealtype a[] = {2.0/3.0, -2.0/3.0, 1.0}; sunrealtype ahat[] = {7.0/24.0, 0.75, -1.0/24.0};";
/// let ruth = import(Library::Sundials, "ruth.c", text, &Limits::default())?;
/// assert_eq!(ruth.orders().separable.order, 3);
/// // OrdinaryDiffEq.jl drifts first, by `b`, so that the same numbers are another method there.
/// let text = "a = [2//3, -2//3, 1]; b = [7//24, 3//4, -1//24]";
/// let exchanged = import(Library::Sciml, "ruth.jl", text, &Limits::default())?;
/// assert_eq!(exchanged.orders().separable.order, 3);
/// assert_ne!(exchanged.to_f64(), ruth.to_f64());
///
/// let error = import(Library::Sciml, "ruth.jl", "a = [1, x]; b = [1, 0]", &Limits::default()).unwrap_err();
/// assert_eq!(error.to_string(), "ruth.jl, column 9: found `x`, which has no value here, expected a number");
/// # Ok::<(), symplectic_compiler::Error>(())
/// ```
///
/// # Errors
/// [`ErrorKind::Syntax`] for the first part that is not a number; [`ErrorKind::Document`] for missing lists, lists of different
/// lengths, names with two values, a `c` that is not the row sum; [`ErrorKind::TooManyStages`]. Each with its place in the file.
pub fn import(
    library: Library,
    file_name: &str,
    text: &str,
    limits: &Limits,
) -> Result<Tableau, Error> {
    import_with_origin(library, file_name, text, limits).map(|(tableau, _)| tableau)
}

/// The origin of the exact coefficients of an imported table.
#[derive(Debug, Clone, PartialEq)]
pub enum ImportOrigin {
    /// The numbers of the table are exact, or they are decimals that satisfy the conditions of their order exactly as they are written. They
    /// are kept to the digit.
    Exact,
    /// The numbers are decimals; the coefficients are those of the exact method near them.
    NearDecimals {
        /// The order, and the condition that the decimals violate as they are written; `None` if none was found.
        forced_by: Option<String>,
        /// The largest distance of a coefficient from its decimal; `None` if the stages are in a different order.
        distance: Option<f64>,
    },
    /// The decimals themselves, because no exact method was found near them.
    Decimals {
        /// The order for separable `H`, up to the rounding of the decimals.
        separable: usize,
        /// The order for quadratic `T`, likewise.
        nystrom: usize,
    },
}

impl ImportOrigin {
    /// How the coefficients differ from the numbers of the table, in a sentence; `None` if they do not.
    pub fn note(&self) -> Option<String> {
        match self {
            ImportOrigin::Exact => None,
            ImportOrigin::NearDecimals {
                forced_by,
                distance,
            } => {
                let forced_by = forced_by.as_ref().map_or(String::new(), |condition| {
                    format!("as they are written, the decimals do not have {condition}; ")
                });
                let distance = distance.map_or(String::new(), |distance| {
                    format!(", from which the decimals differ by at most {distance:.1e}")
                });
                Some(format!(
                    "{forced_by}the result is the exact method near the decimals{distance}"
                ))
            }
            ImportOrigin::Decimals { separable, nystrom } => Some(format!(
                "no exact method was found near the decimals; they are taken as exact numbers; up to their rounding they have order \
                 {separable} for T(p) + U(q), and {nystrom} for quadratic T"
            )),
        }
    }
}

/// Reads a table like [`import`], and returns the origin of its coefficients.
///
/// ```
/// use symplectic_compiler::{Library, Limits};
/// use symplectic_tools::{ImportOrigin, import_with_origin};
///
/// let text = "a[0] = 0.70710678118; a[1] = 0.29289321882; ahat[0] = 0.29289321881; ahat[1] = 0.70710678119;";
/// let (_, origin) = import_with_origin(Library::Sundials, "mclachlan.c", text, &Limits::default())?;
/// assert!(!matches!(origin, ImportOrigin::Exact));
/// # Ok::<(), symplectic_compiler::Error>(())
/// ```
///
/// # Errors
/// The errors of [`import`].
pub fn import_with_origin(
    library: Library,
    file_name: &str,
    text: &str,
    limits: &Limits,
) -> Result<(Tableau, ImportOrigin), Error> {
    let input = Input::of_file(file_name, text);
    outcome(&read(library, input, limits)?, limits)
}

/// The tableau of numbers, and the origin of its coefficients.
fn outcome(numbers: &Numbers, limits: &Limits) -> Result<(Tableau, ImportOrigin), Error> {
    let read = numbers.derive(limits)?;
    let origin = match read.origin {
        Origin::Exact => ImportOrigin::Exact,
        Origin::Refined(_, forced) => ImportOrigin::NearDecimals {
            forced_by: forced.map(|forced| forced.to_string()),
            distance: numbers.largest_error(&read.tableau).map(|x| to_f64(&x)),
        },
        Origin::Decimals([_, (separable, _), (nystrom, _)]) => {
            ImportOrigin::Decimals { separable, nystrom }
        }
    };
    Ok((read.tableau, origin))
}

/// The numbers of a table.
fn read(library: Library, input: Input<'_>, limits: &Limits) -> Result<Numbers, Error> {
    if library == Library::RungeKuttaJl && tsv::is_tsv(input.text) {
        return tsv::read(input, limits);
    }
    let source = Source::scan(input, library.notation())?;
    let list = |name: &str| -> Result<Vec<Value>, Error> {
        source
            .list(name)?
            .ok_or_else(|| missing(input, library, name))
    };
    let found = |name: &str| source.has(name);
    if library == Library::Odeint
        && let Some(rows) = source.rows("a")?
    {
        let matrix = below_diagonal(rows, list("b")?.len())
            .map_err(|message| input.error(&source.place("a"), ErrorKind::Document { message }))?;
        let positions = half(matrix, list("b")?, source.list("c")?, limits)
            .map_err(|kind| input.error(&source.place("b"), kind))?;
        return Ok(Numbers::RungeKutta {
            positions,
            momenta: None,
        });
    }
    if let Some(stepping) = library.stepping()
        && found(stepping.drift)
        && found(stepping.kick)
    {
        let (drifts, kicks) = (list(stepping.drift)?, list(stepping.kick)?);
        let place = source.place(stepping.kick);
        return Numbers::splitting(&Flows::from(&stepping), drifts, kicks, limits)
            .map_err(|kind| input.error(&place, kind));
    }
    let a = if found("A") { "A" } else { "a" };
    if !found(a) || !found("b") {
        // A value that cannot be read may have swallowed the other one.
        let stepping = library.stepping();
        let names = stepping.iter().flat_map(|names| [names.drift, names.kick]);
        for name in names.chain([a, "b"]).filter(|name| found(name)) {
            source.list(name)?;
        }
        return Err(missing(input, library, ""));
    }
    let table = |a: &str, b: &str, c: &str| -> Result<_, Error> {
        let weights = list(b)?;
        let nodes = source.list(c)?;
        let place = source.place(if nodes.is_some() { c } else { a });
        half(list(a)?, weights, nodes, limits).map_err(|kind| input.error(&place, kind))
    };
    if found("a_tilde") && found("gradient") {
        let message = "the method has gradient kicks, which are not imported: define it by `kick`, `drift` and `gradient`";
        let message = message.to_owned();
        return Err(input.error(&source.place("gradient"), ErrorKind::Document { message }));
    }
    let positions = table(a, "b", "c")?;
    let momenta = match found("a_tilde") {
        true => Some(table(
            "a_tilde",
            if found("b_tilde") { "b_tilde" } else { "b" },
            "c_tilde",
        )?),
        false => None,
    };
    if momenta
        .as_ref()
        .is_some_and(|momenta| momenta.1.len() != positions.1.len())
    {
        let message = "the two tables have different numbers of stages".to_owned();
        return Err(input.error(&source.place("a_tilde"), ErrorKind::Document { message }));
    }
    Ok(Numbers::RungeKutta { positions, momenta })
}

/// The matrix of an explicit method, row by row, from its rows below the diagonal.
fn below_diagonal(rows: Vec<Vec<Value>>, stages: usize) -> Result<Vec<Value>, String> {
    let lengths: Vec<usize> = rows.iter().map(Vec::len).collect();
    if !lengths.iter().copied().eq(1..stages) {
        return Err(format!(
            "the rows of `a` have {lengths:?} entries; {stages} weights need rows of 1, 2, … entries"
        ));
    }
    let mut matrix = vec![zero(); stages];
    for mut row in rows {
        row.resize_with(stages, zero);
        matrix.extend(row);
    }
    Ok(matrix)
}

/// The error for a missing part of a file of a library.
fn missing(input: Input<'_>, library: Library, name: &str) -> Error {
    let splitting = library.stepping().map(|stepping| {
        let Stepping { drift, kick, .. } = stepping;
        format!("the drifts `{drift}` and the kicks `{kick}` of a splitting, or ")
    });
    let name = match name {
        "" => String::new(),
        name => format!("`{name}` is missing: "),
    };
    let message = format!(
        "{name}a table of `{}` has {}the matrix `A` or `a` and the weights `b` of a Runge–Kutta method",
        library.name(),
        splitting.unwrap_or_default()
    );
    input.error(&(0..0), ErrorKind::Document { message })
}
