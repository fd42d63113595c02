//! Tables with their own names: the drifts and kicks of a splitting, or the weights of a composition.

use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use super::numbers::{Flows, Numbers};
use super::{ImportOrigin, outcome};
use symplectic_compiler::Library;
use symplectic_compiler::Limits;
use symplectic_compiler::Tableau;
use symplectic_compiler::certify::{Printed, certify_composition};
use symplectic_compiler::did_you_mean;
use symplectic_compiler::expression::Input;
use symplectic_compiler::inside::Notation;
use symplectic_compiler::inside::check_stages;
use symplectic_compiler::inside::order_of_composition_within;
use symplectic_compiler::inside::shown;
use symplectic_compiler::inside::{Source, Value};
use symplectic_compiler::symbolic::Constant;
use symplectic_compiler::{Definition, Key};
use symplectic_compiler::{Error, ErrorKind};
use symplectic_exact::rational::ratio;
use symplectic_exact::rounding::{Decimal, to_f64};

/// The names of the lists of a table, and what they are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum OwnNames {
    /// A splitting, whose step has a drift and a kick in turn.
    Splitting {
        /// The drifts `q += drift_i h ∂T/∂p`.
        drift: String,
        /// The kicks `p −= kick_i h ∂U/∂q`.
        kick: String,
        /// Whether a drift comes first; `None` if the longer list does.
        drifts_first: Option<bool>,
        /// Whether the lists are the first half of a step that is the same from both ends.
        symmetric: bool,
    },
    /// A composition of a method.
    Composition {
        /// The method: a name of the catalogue, or a definition in brackets.
        base: String,
        /// The fractions of its steps.
        weights: String,
        /// Whether they are half of a palindrome. The one in the middle comes last, or first, or is missing, whichever makes the sum 1; or
        /// it is 1 minus all others, if they have an order above 2 with it.
        symmetric: bool,
    },
}

/// Reads a table by its own names, and returns the origin of its coefficients. The language is that of a library, or else the one of
/// the file's extension.
///
/// ```
/// use symplectic_compiler::Limits;
/// use symplectic_tools::{OwnNames, import_own};
///
/// let names = OwnNames::Splitting {
///     drift: "c".to_owned(), kick: "d".to_owned(), drifts_first: None, symmetric: false,
/// };
/// // One drift more than kicks: a drift begins and ends the step.
/// let (leapfrog, _) = import_own(&names, None, "leapfrog.py", "c = [0.5, 0.5]\nd = [1]", &Limits::default())?;
/// assert!(leapfrog.separable_properties().symmetric.holds && leapfrog.orders().separable.order == 2);
///
/// // The triple jump of Yoshida, with the weight in the middle first.
/// let names = OwnNames::Composition { base: "velocity-verlet".to_owned(), weights: "w".to_owned(), symmetric: true };
/// let text = "w = [-1.7024143839193153, 1.3512071919596578]";
/// let (jump, _) = import_own(&names, None, "yoshida.jl", text, &Limits::default())?;
/// assert_eq!(jump.orders().separable.order, 4);
/// # Ok::<(), symplectic_compiler::Error>(())
/// ```
///
/// # Errors
/// The errors of [`import`](super::import()); [`ErrorKind::Document`] if it is unclear which flow comes first, or if weights do not sum to 1.
pub fn import_own(
    names: &OwnNames,
    library: Option<Library>,
    file_name: &str,
    text: &str,
    limits: &Limits,
) -> Result<(Tableau, ImportOrigin), Error> {
    let input = Input::of_file(file_name, text);
    let notation = library.map_or_else(|| notation_of(file_name), Library::notation);
    let source = Source::scan(input, notation)?;
    let list = |name: &str| -> Result<Vec<Value>, Error> {
        let lower_case = name.to_lowercase();
        let name = if source.fortran { &lower_case } else { name };
        source.list(name)?.ok_or_else(|| {
            let meant = did_you_mean(name, source.names.keys().map(String::as_str));
            let message = format!("the list `{}` is missing{meant}", shown(name));
            input.error(&(0..0), ErrorKind::Document { message })
        })
    };
    let at = |name: &str, kind: ErrorKind| input.error(&source.place(name), kind);
    match names {
        OwnNames::Splitting { .. } => outcome(&names.numbers(list, at, limits)?, limits),
        OwnNames::Composition {
            base,
            weights,
            symmetric,
        } => {
            let at_weights = |kind: ErrorKind| at(weights, kind);
            let values = whole(list(weights)?, *symmetric).map_err(at_weights)?;
            check_stages(&values.len().into(), limits).map_err(at_weights)?;
            composed(base, &values, limits)
        }
    }
}

impl OwnNames {
    /// The names.
    pub(crate) fn lists(&self) -> Vec<&str> {
        match self {
            OwnNames::Splitting { drift, kick, .. } => vec![drift, kick],
            OwnNames::Composition { weights, .. } => vec![weights],
        }
    }

    /// The drifts and kicks of a step, whatever their sums. Those of a composition are the ones of its base, which must be a splitting.
    pub(crate) fn numbers(
        &self,
        list: impl Fn(&str) -> Result<Vec<Value>, Error>,
        at: impl Fn(&str, ErrorKind) -> Error,
        limits: &Limits,
    ) -> Result<Numbers, Error> {
        match self {
            OwnNames::Splitting {
                drift,
                kick,
                drifts_first,
                symmetric,
            } => {
                let (drifts, kicks) = (list(drift)?, list(kick)?);
                let at_kick = |kind: ErrorKind| at(kick, kind);
                let longer = match drifts.len().cmp(&kicks.len()) {
                    std::cmp::Ordering::Less => Some(false),
                    std::cmp::Ordering::Equal => None,
                    std::cmp::Ordering::Greater => Some(true),
                };
                let drifts_first = drifts_first.or(longer).ok_or_else(|| {
                    let message =
                        "as many drifts as kicks: which of them come first must be stated";
                    let message = message.to_owned();
                    at_kick(ErrorKind::Document { message })
                })?;
                let flows = Flows {
                    drift,
                    kick,
                    drifts_first,
                    mirrored: *symmetric,
                };
                Numbers::splitting(&flows, drifts, kicks, limits).map_err(at_kick)
            }
            OwnNames::Composition {
                base,
                weights,
                symmetric,
            } => {
                let at_weights = |kind: ErrorKind| at(weights, kind);
                let values = list(weights)?;
                let values = match symmetric {
                    true => whole(values, true).map_err(at_weights)?,
                    false => values,
                };
                let base = Definition::new([(Key::Base, base.clone())]).derive(limits)?;
                Numbers::composition(&base, &values, limits).map_err(at_weights)
            }
        }
    }
}

/// The language of a file, by its extension.
fn notation_of(file_name: &str) -> Notation {
    let extension = file_name.rsplit_once('.').map_or("", |(_, after)| after);
    match extension.to_lowercase().as_str() {
        "py" => Notation::Python,
        "nb" | "wl" | "wls" => Notation::Mathematica,
        "c" | "h" | "cc" | "cpp" | "cxx" | "hpp" | "f" | "for" | "f90" | "f95" | "f03" | "f08" => {
            Notation::C
        }
        _ => Notation::Julia,
    }
}

/// All weights of a composition.
fn whole(values: Vec<Value>, symmetric: bool) -> Result<Vec<Value>, ErrorKind> {
    let sum = |values: &[Value]| values.iter().map(Value::rational).sum::<BigRational>();
    let is_one =
        |values: &Vec<Value>| (sum(values) - BigRational::one()).abs() <= tolerance(values);
    let mirrored = |first: &[Value], middle: &[Value]| {
        let back = first.iter().rev();
        first.iter().chain(middle).chain(back).cloned().collect()
    };
    let readings: Vec<Vec<Value>> = match (symmetric, values.as_slice()) {
        (true, [middle, rest @ ..]) => {
            let (last, before) = values.split_last().unwrap_or((middle, rest));
            let outwards: Vec<Value> = rest.iter().rev().cloned().collect();
            vec![
                mirrored(before, std::slice::from_ref(last)),
                mirrored(&outwards, std::slice::from_ref(middle)),
                mirrored(&values, &[]),
            ]
        }
        _ => vec![values.clone()],
    };
    if let Some(found) = readings.into_iter().find(is_one) {
        return Ok(found);
    }
    if symmetric {
        // The one in the middle is what the others leave, if this gives them an order, outwards or inwards.
        let one = Value::exact(Constant::one());
        let middle = (values.iter().chain(&values)).try_fold(one, |rest, x| rest.subtract(x))?;
        let outwards: Vec<Value> = values.iter().rev().cloned().collect();
        let order = |all: &Vec<Value>| {
            let fractions: Vec<BigRational> = all.iter().map(Value::rational).collect();
            order_of_composition_within(&fractions, true, &tolerance(all))
        };
        let both = [&outwards, &values].map(|list| {
            let all = mirrored(list, std::slice::from_ref(&middle));
            (order(&all), all)
        });
        if let Some((_, found)) = both
            .into_iter()
            .filter(|(order, _)| *order > 2)
            .max_by_key(|(order, _)| *order)
        {
            return Ok(found);
        }
    }
    Err({
        let sum = Decimal::round(&sum(&values), 17);
        let message = match symmetric {
            true => format!(
                "the weights sum to {sum}; mirrored they do not sum to 1, whether the one in the middle is the last, the first or missing, \
                 and with 1 minus their sums in the middle they have no order above 2"
            ),
            false => format!(
                "the weights sum to {sum}, not to 1; half of a palindrome is read with `--symmetric`"
            ),
        };
        ErrorKind::Document { message }
    })
}

/// The largest residual of a condition that the rounding of the weights explains.
fn tolerance(values: &[Value]) -> BigRational {
    let least = BigRational::new(1.into(), num_bigint::BigInt::from(10).pow(10));
    let error: BigRational = values.iter().map(|value| &value.error).sum();
    (error * ratio(50, 1)).max(least)
}

/// The composition of a method with these weights: those written, or near them.
///
/// The conditions are those for the steps of the base, which are more if it is not symmetric.
fn composed(
    base: &str,
    values: &[Value],
    limits: &Limits,
) -> Result<(Tableau, ImportOrigin), Error> {
    let definition = |texts: Vec<String>| {
        [
            (Key::Base, base.to_owned()),
            (Key::Weights, format!("[{}]", texts.join(", "))),
        ]
    };
    let exact = || {
        let texts = values.iter().map(|value| value.constant.to_string());
        Definition::new(definition(texts.collect())).derive(limits)
    };
    if values.iter().all(Value::is_exact) {
        return Ok((exact()?, ImportOrigin::Exact));
    }
    let fractions: Vec<BigRational> = values.iter().map(Value::rational).collect();
    let off = fractions.iter().sum::<BigRational>() - BigRational::one();
    let base = Definition::new([(Key::Base, base.to_owned())]).derive(limits)?;
    let symmetric = base.separable_properties().symmetric.holds;
    let within = |tolerance: &BigRational| match base.own_properties().consistent.holds {
        true => order_of_composition_within(&fractions, symmetric, tolerance),
        false => 0,
    };
    let order = within(&tolerance(values));
    if within(&BigRational::zero()) >= order {
        return Ok((exact()?, ImportOrigin::Exact));
    }
    let printed: Result<Vec<Printed>, ErrorKind> = values.iter().map(Value::printed).collect();
    let printed = printed?;
    let texts = printed.iter().map(|printed| printed.text().to_owned());
    let claim = (Key::Claim, format!("separable({order})"));
    let claimed = definition(texts.collect()).into_iter().chain([claim]);
    let found = Definition::new(claimed).derive(limits);
    match (found, certify_composition(&printed, order)) {
        (Ok(tableau), Ok(certificate)) => {
            // The first conditions of every composition; only the sum for a base of order 1.
            let cubes: BigRational = fractions.iter().map(|x| x * x * x).sum();
            let violated = match off.is_zero() {
                true => format!(
                    "the sum of the cubes of the weights is {:.1e}, not 0",
                    to_f64(&cubes)
                ),
                false => format!("the sum of the weights is 1 {:+.1e}", to_f64(&off)),
            };
            let origin = ImportOrigin::NearDecimals {
                forced_by: Some(format!("{}: {violated}", certificate.claim())),
                distance: Some(to_f64(certificate.distance())),
            };
            Ok((tableau, origin))
        }
        _ if off.is_zero() => {
            let (separable, nystrom) = (order, order);
            Ok((exact()?, ImportOrigin::Decimals { separable, nystrom }))
        }
        _ => {
            // Their order would need exact weights, and a step the sum 1.
            let middle = fractions.len() / 2;
            let texts = fractions
                .iter()
                .enumerate()
                .map(|(i, x)| match i == middle {
                    true => (x - &off).to_string(),
                    false => x.to_string(),
                });
            let tableau = Definition::new(definition(texts.collect())).derive(limits)?;
            let origin = ImportOrigin::NearDecimals {
                forced_by: Some(format!(
                    "the sum 1; only the weight in the middle was changed, since only for a symmetric base of kicks and drifts all are \
                     refined to their order, which is {order} up to rounding"
                )),
                distance: Some(to_f64(&off.abs())),
            };
            Ok((tableau, origin))
        }
    }
}
