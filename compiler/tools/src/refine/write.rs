//! The facts about a refined method, as text and as data.

use num_rational::BigRational;
use serde::Serialize;

use super::Refinement;
use symplectic_compiler::certify::{CertifyError, Coefficient, Digits};
use symplectic_compiler::inside::decimal_text;
use symplectic_compiler::{Error, ErrorKind};
use symplectic_exact::rational::ratio;
use symplectic_exact::rounding::Decimal;

/// Longer exact values are not shown next to decimals.
const LONGEST_EXACT: usize = 24;

/// The contents of the JSON text.
#[derive(Serialize)]
pub(super) struct Report {
    name: Option<String>,
    source: Option<String>,
    claim: String,
    evidence: &'static str,
    distance: String,
    structure: String,
    conditions: usize,
    unknowns: usize,
    fixed: Vec<FixedEntry>,
    exact: bool,
    uniqueness_radius: Option<String>,
    next_order_refuted: Option<bool>,
    wrong_digits: Vec<WrongDigits>,
    printed_digits: &'static str,
    could_be_wrong_instead: Vec<String>,
    digits: usize,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    kick: Vec<Entry>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    drift: Vec<Entry>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    gradient: Vec<Entry>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    weights: Vec<Entry>,
}

#[derive(Serialize)]
struct FixedEntry {
    coefficient: String,
    value: String,
    as_printed: bool,
}

#[derive(Serialize)]
struct WrongDigits {
    coefficient: String,
    distance: String,
}

#[derive(Serialize)]
struct Entry {
    #[serde(skip)]
    name: Coefficient,
    printed: String,
    exact: Option<String>,
    decimal: String,
}

/// An upper bound with two digits, not smaller than the value.
pub(super) fn at_most(value: &BigRational) -> String {
    let nearest = Decimal::round(value, 2);
    // Two digits are wrong by at most 1/20.
    let up = || Decimal::round(&(value * ratio(11, 10)), 2);
    let bound = if nearest.value() < *value {
        up()
    } else {
        nearest
    };
    bound.to_string()
}

/// A lower bound with two digits, not larger than the value.
fn at_least(value: &BigRational) -> String {
    let nearest = Decimal::round(value, 2);
    let down = || Decimal::round(&(value * ratio(9, 10)), 2);
    let bound = if nearest.value() > *value {
        down()
    } else {
        nearest
    };
    bound.to_string()
}

fn too_many(error: &CertifyError) -> Error {
    let message = error.to_string();
    ErrorKind::NotCertified { message }.into()
}

pub(super) fn report(refinement: &Refinement, digits: usize) -> Result<Report, Error> {
    let certificate = &refinement.certificate;
    let fixed = certificate.fixed().iter().map(|fixed| FixedEntry {
        coefficient: fixed.coefficient.to_string(),
        value: fixed.value.to_string(),
        as_printed: fixed.as_printed,
    });
    let wrong = certificate.wrong_digits().into_iter();
    let wrong = wrong.map(|(coefficient, distance)| WrongDigits {
        coefficient: coefficient.to_string(),
        distance: at_most(&distance),
    });
    let mut report = Report {
        name: refinement.name.clone(),
        source: refinement.source.clone(),
        claim: certificate.claim().to_string(),
        evidence: "certified",
        distance: at_most(certificate.distance()),
        structure: certificate.structure().to_string(),
        conditions: certificate.conditions(),
        unknowns: certificate.unknowns(),
        fixed: fixed.collect(),
        exact: certificate.is_exact(),
        uniqueness_radius: certificate.uniqueness_radius().map(at_least),
        next_order_refuted: certificate.sharp(),
        wrong_digits: wrong.collect(),
        printed_digits: match certificate.digits() {
            Digits::All => "all",
            Digits::Excluded => "excluded",
            Digits::NotFound => "not found",
        },
        could_be_wrong_instead: {
            let suspects = certificate.suspects().iter();
            suspects.map(Coefficient::to_string).collect()
        },
        digits,
        kick: Vec::new(),
        drift: Vec::new(),
        gradient: Vec::new(),
        weights: Vec::new(),
    };
    for (name, printed) in &refinement.printed {
        let decimal = certificate.decimal(*name, digits);
        let Some(decimal) = decimal.map_err(|error| too_many(&error))? else {
            continue;
        };
        let list = match name {
            Coefficient::Kick(_) => &mut report.kick,
            Coefficient::Drift(_) => &mut report.drift,
            Coefficient::Gradient(_) => &mut report.gradient,
            Coefficient::Weight(_) | Coefficient::Processor(_) => &mut report.weights,
        };
        list.push(Entry {
            name: *name,
            printed: printed.text().to_owned(),
            exact: certificate.rational(*name).map(|value| value.to_string()),
            decimal: decimal.to_string(),
        });
    }
    Ok(report)
}

pub(super) fn text(refinement: &Refinement, digits: usize) -> Result<String, Error> {
    let report = report(refinement, digits)?;
    let mut text = String::new();
    let origin = [&report.name, &report.source];
    let origin: Vec<&str> = origin.into_iter().flatten().map(String::as_str).collect();
    if !origin.is_empty() {
        // Always one line, even if the file contains control characters.
        let line = origin
            .join(", ")
            .replace(|c: char| c.is_control(), "\u{fffd}");
        text.push_str(&format!("{line}\n\n"));
    }
    let claim = &report.claim;
    text.push_str(&if report.exact && report.distance == "0" {
        format!("certified: the printed digits are an exact method of {claim}\n")
    } else {
        format!(
            "certified: an exact method of {claim} exists within {} of the printed digits\n",
            report.distance
        )
    });
    let plural = |count: usize| if count == 1 { "" } else { "s" };
    let mut line = |name: &str, words: &str| text.push_str(&format!("  {name:<13}{words}\n"));
    line("structure", &report.structure);
    let (conditions, unknowns) = (report.conditions, report.unknowns);
    let equations = format!(
        "{conditions} condition{} for {unknowns} unknown{}",
        plural(conditions),
        plural(unknowns)
    );
    line("equations", &equations);
    if !report.fixed.is_empty() {
        line("fixed", &fixed(refinement, &report).join(", "));
    }
    match &report.uniqueness_radius {
        Some(radius) => line(
            "unique",
            &format!("the only one within {radius} of the printed unknowns"),
        ),
        None if report.exact => line("exact", "all coefficients are rational"),
        None => {}
    }
    match report.next_order_refuted {
        Some(true) => line("next order", "refuted"),
        Some(false) => line("next order", "not refuted"),
        None => {}
    }
    let all = refinement.printed.len();
    let wrong = match report.wrong_digits.len() {
        0 => "none".to_owned(),
        count => format!("in {count} of {all} coefficients, marked below"),
    };
    line("wrong digits", &wrong);
    let method = format!("{} of {}", report.structure, report.claim);
    match refinement.certificate.digits() {
        Digits::All => {}
        Digits::Excluded => line(
            "",
            &format!("proved: no {method} rounds to all printed digits"),
        ),
        Digits::NotFound => line(
            "",
            &format!("no {method} was found that rounds to all printed digits; that is not proved"),
        ),
    }
    if !report.could_be_wrong_instead.is_empty() {
        let others = report.could_be_wrong_instead.join(" or ");
        line("", &format!("the wrong number could be {others} instead"));
    }
    let lists = [
        &report.kick,
        &report.drift,
        &report.gradient,
        &report.weights,
    ];
    for list in lists {
        let width = list.iter().map(|entry| entry.name.to_string().len());
        let width = width.max().unwrap_or(0);
        if !list.is_empty() {
            text.push('\n');
        }
        for entry in list {
            let name = entry.name.to_string();
            // One more column for the signs.
            let sign = if entry.decimal.starts_with('-') {
                ""
            } else {
                " "
            };
            let exact = entry.exact.as_ref();
            let exact = exact.filter(|exact| exact.contains('/') && exact.len() <= LONGEST_EXACT);
            let exact = exact.map_or_else(String::new, |exact| format!(" = {exact}"));
            let mut wrong = report.wrong_digits.iter();
            let off = wrong.find(|wrong| wrong.coefficient == name);
            let off = off.map_or_else(String::new, |wrong| {
                format!("  (the print is off by {})", wrong.distance)
            });
            text.push_str(&format!(
                "  {name:<width$}  {sign}{}{exact}{off}\n",
                entry.decimal
            ));
        }
    }
    Ok(text)
}

/// The fixed coefficients, as they are printed or as the fraction that the print rounds.
fn fixed(refinement: &Refinement, report: &Report) -> Vec<String> {
    let words = |fixed: &FixedEntry| {
        let named = |(name, _): &&(Coefficient, symplectic_compiler::certify::Printed)| {
            name.to_string() == fixed.coefficient
        };
        let printed = refinement.printed.iter().find(named);
        match printed {
            Some((_, printed)) if fixed.as_printed => {
                format!("{} = {}", fixed.coefficient, printed.text())
            }
            Some((_, printed))
                if printed
                    .simple()
                    .is_none_or(|x| x.to_string() != fixed.value) =>
            {
                format!(
                    "{} = {}, within its last place",
                    fixed.coefficient,
                    moved(fixed)
                )
            }
            _ => format!("{} = {}", fixed.coefficient, fixed.value),
        }
    };
    report.fixed.iter().map(words).collect()
}

/// The value of a coefficient that was moved, as a decimal.
fn moved(fixed: &FixedEntry) -> String {
    let value = fixed.value.parse::<BigRational>();
    let decimal = value.map(|value| decimal_text(&value));
    decimal
        .ok()
        .flatten()
        .unwrap_or_else(|| fixed.value.clone())
}
