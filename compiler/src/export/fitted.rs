//! Fitted methods as text for people and as JSON for programs.
//!
//! ```text
//! {"parameters", "definition", "name", "stages", "c": [E], "c_tilde": [E], "b": [E], "b_tilde": [E], "a": [[E]], "a_tilde": [[E]],
//!  "properties": {"symplectic", "symmetric", "consistent"}, "order": {"general", "separable", "nystrom"},
//!  "exact_on": {"velocities": [string], "forces": [string], "step": [string]}, "phase_error": {…}}
//!
//! E = {"exact": string or null, "series": [string]}
//! ```
//!
//! `exact` is an expression in the parameter, which stands for the product of frequency and step size. It is null for the sums `c` and
//! `c_tilde` of rows, and for the coefficients `ã_ij = b_j (b_i − a_ji)/b_i` that follow from the others. `series` are the coefficients of 1,
//! of the parameter and of its square in the power series.

use super::columns::{left, widths};
use super::facts::Fact;
use crate::algebra::{Field, FieldElement};
use crate::coefficients::subscript;
use crate::error::ErrorKind;
use crate::fitted::{Fitted, FittedOrder, PhaseError, Quotient};

/// The number of terms of the series that are written: `1, ν, ν²`.
const SERIES: usize = 3;

/// Writes a fitted method for people: each coefficient as a function, its limit, and what is proved.
///
/// # Errors
/// [`ErrorKind::Definition`] if a coefficient has no limit as the frequency goes to 0.
///
/// ```
/// use symplectic_compiler::{Definition, Fitted, Limits, export};
///
/// let definition = Definition::parse("parameters: w, basis: cos(w*t), nodes: 1/2")?;
/// let text = export::fitted::text(&Fitted::derive(&definition, &Limits::default())?)?;
/// assert!(text.contains("D    = w*cos(w/2)\nb_1  = sin(w)/D  → 1\n"), "{text}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn text(fitted: &Fitted) -> Result<String, ErrorKind> {
    let w = fitted.parameter();
    let stages = match fitted.stages() {
        1 => "1 stage".to_owned(),
        stages => format!("{stages} stages"),
    };
    let mut title: Vec<String> = fitted.name().map(str::to_owned).into_iter().collect();
    title.push(stages);
    let parts = fitted.definition().parts();
    title.extend(parts.map(|(key, text)| format!("{} {text}", key.name())));
    let mut text = title.join(", ") + "\n";
    text.push_str(&format!(
        "coefficients are functions of the product of frequency and step size, which is called {w}\n\n"
    ));
    let limits = fitted.series(1)?;
    let (limit_a, limit_b) = match fitted.is_exchanged() {
        false => (&limits.a, &limits.b),
        true => (&limits.a_tilde, &limits.b_tilde),
    };
    let ring = fitted.ring();
    let (denominator, _, _) = fitted.over_denominator();
    let common = ring.display(&denominator, w);
    let (a, b) = fitted.constructed();
    let row = |name: String, x: &Quotient, limit: &Vec<FieldElement>| {
        let function = if x.denominator == denominator {
            let numerator = ring.display(&x.numerator, w);
            format!("{}/D", bracketed(numerator))
        } else {
            ring.display_quotient(x, w)
        };
        let limit = limit.first().and_then(|x| ring.field.exact(x));
        let limit = limit.filter(|limit| *limit != function);
        let limit = limit.map_or_else(String::new, |limit| format!("→ {limit}"));
        vec![name, format!("= {function}"), limit]
    };
    let [own_a, own_b, partner] = match fitted.is_exchanged() {
        false => ["a", "b", "ã"],
        true => ["ã", "b̃", "a"],
    };
    let mut rows = vec![vec!["D".to_owned(), format!("= {common}"), String::new()]];
    for (i, (x, limit)) in b.iter().zip(limit_b).enumerate() {
        rows.push(row(format!("{own_b}_{}", i + 1), x, limit));
    }
    for (i, (entries, limits)) in a.iter().zip(limit_a).enumerate() {
        for (j, (x, limit)) in entries.iter().zip(limits).enumerate() {
            let place = subscript(i + 1, j + 1);
            rows.push(row(format!("{own_a}_{place}"), x, limit));
        }
    }
    let first = widths(&rows).first().copied().unwrap_or(0);
    for row in &rows {
        if let [name, function, limit] = row.as_slice() {
            let line = format!("{} {function}  {limit}", left(name, first));
            text.push_str(line.trim_end());
            text.push('\n');
        }
    }
    text.push_str(&format!(
        "\n{partner}_ij = b_j (b_i − {own_a}_ji)/b_i and b̃ = b; c_i and c̃_i are the sums of the rows. After → is the limit for {w} → 0.\n"
    ));
    for line in statements(fitted)? {
        text.push_str(&line);
        text.push('\n');
    }
    Ok(text)
}

/// What is proved, as lines.
fn statements(fitted: &Fitted) -> Result<Vec<String>, ErrorKind> {
    let w = fitted.parameter();
    let yes = |holds: bool| if holds { "yes  proved" } else { "no   refuted" };
    let mut lines = vec![
        String::new(),
        format!("properties, for every {w}"),
        format!("  symplectic  {}", yes(true)),
        format!("  symmetric   {}", yes(fitted.is_symmetric())),
        format!("  consistent  {}", yes(fitted.is_consistent())),
        String::new(),
        "order, for small steps at a fixed frequency".to_owned(),
    ];
    let orders = fitted.orders()?;
    for (name, found) in [
        ("general", orders.general),
        ("separable", orders.separable),
        ("nystrom", orders.nystrom),
    ] {
        lines.push(format!("  {name:10} {}", order(found, w)));
    }
    let exact = fitted.exact_on();
    let basis: Vec<&str> = fitted.basis().collect();
    let span = |places: &[usize]| {
        let names: Vec<&str> = places
            .iter()
            .filter_map(|&i| basis.get(i).copied())
            .collect();
        match names.as_slice() {
            [] => "no function of the basis".to_owned(),
            names => format!("velocities in the span of {}", names.join(", ")),
        }
    };
    let forces = |places: &[usize]| span(places).replace("velocities", "forces");
    lines.push(String::new());
    lines.push(format!(
        "exact on the span of the basis, with {w} the frequency and t the time in the step; proved"
    ));
    lines.push(format!("  positions at the end:    {}", span(&exact.step)));
    lines.push(format!(
        "  momenta at the end:      {}",
        forces(&exact.step)
    ));
    lines.push(format!(
        "  positions at the stages: {}",
        span(&exact.velocities)
    ));
    lines.push(format!(
        "  momenta at the stages:   {}",
        forces(&exact.forces)
    ));
    lines.push(String::new());
    lines.push(format!("oscillator of the frequency {w}"));
    lines.push(match fitted.phase_error()? {
        PhaseError::Exact => "  the step is exact, proved".to_owned(),
        PhaseError::Leading { power, coefficient } => {
            let coefficient = fitted.ring().field.exact(&coefficient).unwrap_or_default();
            format!(
                "  phase: order {}, error {} {w}^{power}, proved",
                power.saturating_sub(1),
                bracketed(coefficient)
            )
        }
        PhaseError::AtLeast { power } => {
            format!("  phase: no error up to {w}^{power}, proved")
        }
    });
    Ok(lines)
}

/// A number, with brackets around a sum.
fn bracketed(number: String) -> String {
    match number.contains(' ') {
        true => format!("({number})"),
        false => number,
    }
}

fn order(found: FittedOrder, w: &str) -> String {
    match found.violated {
        None => format!("at least {}, proved", found.order),
        Some((vertices, power)) => format!(
            "{}, proved; not {}: a tree of order {vertices} has a residual in {w}^{power}",
            found.order,
            found.order + 1
        ),
    }
}

/// Writes a fitted method as JSON.
///
/// # Errors
/// [`ErrorKind::Definition`] if a coefficient has no limit as the frequency goes to 0.
pub fn json(fitted: &Fitted) -> Result<String, ErrorKind> {
    let series = fitted.series(SERIES)?;
    let exact = |x: &FieldElement| Fact::Text(fitted.ring().field.exact(x).unwrap_or_default());
    let (own_a, own_b) = fitted.constructed();
    let display = |x: &Quotient| Fact::Text(fitted.ring().display_quotient(x, fitted.parameter()));
    let entry = |function: Fact, series: &[FieldElement]| {
        let series = Fact::List(series.iter().map(exact).collect());
        Fact::Table(vec![("exact", function), ("series", series)]).json()
    };
    let alone = |v: &[Vec<FieldElement>]| -> Vec<String> {
        v.iter().map(|series| entry(Fact::Absent, series)).collect()
    };
    let both = |v: &[Quotient], series: &[Vec<FieldElement>]| -> Vec<String> {
        let pairs = v.iter().zip(series);
        pairs.map(|(x, series)| entry(display(x), series)).collect()
    };
    let constructed = |series: &[Vec<Vec<FieldElement>>]| -> Vec<Vec<String>> {
        let rows = own_a.iter().zip(series);
        rows.map(|(row, series)| both(row, series)).collect()
    };
    let partner = |series: &[Vec<Vec<FieldElement>>]| -> Vec<Vec<String>> {
        series.iter().map(|row| alone(row)).collect()
    };
    let (a, a_tilde) = match fitted.is_exchanged() {
        false => (constructed(&series.a), partner(&series.a_tilde)),
        true => (partner(&series.a), constructed(&series.a_tilde)),
    };
    let b = both(&own_b, &series.b);
    let (c, c_tilde) = (alone(&series.c), alone(&series.c_tilde));
    let list = |v: &[String]| format!("[{}]", v.join(", "));
    let matrix = |m: &[Vec<String>]| {
        let rows: Vec<String> = m.iter().map(|row| format!("\n    {}", list(row))).collect();
        format!("[{}\n  ]", rows.join(","))
    };
    let literal = |value: bool| Fact::Literal(value.to_string());
    let properties = Fact::Table(vec![
        ("symplectic", literal(true)),
        ("symmetric", literal(fitted.is_symmetric())),
        ("consistent", literal(fitted.is_consistent())),
    ]);
    let orders = fitted.orders()?;
    let class = |found: FittedOrder| Fact::Literal(found.order.to_string());
    let order = Fact::Table(vec![
        ("general", class(orders.general)),
        ("separable", class(orders.separable)),
        ("nystrom", class(orders.nystrom)),
    ]);
    let found = fitted.exact_on();
    let basis: Vec<&str> = fitted.basis().collect();
    let names = |places: &[usize]| {
        let names = places.iter().filter_map(|&i| basis.get(i));
        Fact::List(names.map(|name| Fact::Text((*name).to_owned())).collect())
    };
    let exact_on = Fact::Table(vec![
        ("velocities", names(&found.velocities)),
        ("forces", names(&found.forces)),
        ("step", names(&found.step)),
    ]);
    let phase = match fitted.phase_error()? {
        PhaseError::Exact => Fact::Table(vec![("exact", literal(true))]),
        PhaseError::Leading { power, coefficient } => Fact::Table(vec![
            ("exact", literal(false)),
            ("power", Fact::Literal(power.to_string())),
            ("coefficient", exact(&coefficient)),
        ]),
        PhaseError::AtLeast { power } => {
            Fact::Table(vec![("at_least", Fact::Literal(power.to_string()))])
        }
    };
    let text = |text: &str| Fact::Text(text.to_owned()).json();
    let fields = [
        ("parameters", text(fitted.parameter())),
        ("definition", text(&fitted.definition().to_string())),
        (
            "name",
            fitted.name().map_or_else(|| Fact::Absent.json(), text),
        ),
        ("stages", fitted.stages().to_string()),
        ("c", list(&c)),
        ("c_tilde", list(&c_tilde)),
        ("b", list(&b)),
        ("b_tilde", list(&b)),
        ("a", matrix(&a)),
        ("a_tilde", matrix(&a_tilde)),
        ("properties", properties.json()),
        ("order", order.json()),
        ("exact_on", exact_on.json()),
        ("phase_error", phase.json()),
    ];
    let fields: Vec<String> = fields
        .iter()
        .map(|(key, value)| format!("  \"{key}\": {value}"))
        .collect();
    Ok(format!("{{\n{}\n}}\n", fields.join(",\n")))
}
