//! Coordinates and parameters.

use std::collections::HashMap;

use super::super::parse::unknown_length;
use super::super::syntax::{
    Coordinates, CoordinatesKind, Definition, Form, Length, Name, ParameterKind,
};
use super::super::system::{Layout, Parameter, Shape};
use symplectic_exact::error::FormulaError;
use symplectic_exact::error::{Error, ErrorKind};
use symplectic_exact::input::Input;

/// Checks that no two of the names that a definition declares for its whole formula are equal.
pub(super) fn check_names(input: Input<'_>, definition: &Definition) -> Result<(), Error> {
    let taken = |name: &Name, meaning: &str| {
        let kind = FormulaError::Taken {
            name: name.text.clone(),
            meaning: meaning.to_owned(),
        };
        Err(input.error(&name.span, kind.into()))
    };
    let [q, p] = [0, 1].map(|half| named(&definition.coordinates[half]));
    if let ([one], [other]) = (q, p)
        && one.text == other.text
        && one.text.starts_with(char::is_uppercase)
    {
        // `q: [N], p: [N];` without `<N>`.
        return Err(unknown_length(input, definition, one));
    }
    let parameters = definition.parameters.iter().map(|known| &known.name);
    let functions = definition.functions.iter().map(|[function, ..]| function);
    let abbreviations = definition.abbreviations.iter().map(|known| &known.name);
    let all = (definition.lengths.iter())
        .map(|name| (name, "a length"))
        .chain(parameters.map(|name| (name, "a parameter")))
        .chain(
            q.iter()
                .chain(p)
                .map(|name| (name, coordinate(definition.form))),
        )
        .chain(
            named(&definition.velocities)
                .iter()
                .map(|name| (name, "a velocity")),
        )
        .chain(functions.map(|name| (name, "a function")))
        .chain(abbreviations.map(|name| (name, "an abbreviation")));
    let mut known: HashMap<&str, &str> = HashMap::from([(&*definition.name.text, "the system")]);
    for (name, meaning) in all {
        match known.insert(&name.text, meaning) {
            // Only a length is a name in the type of the system.
            Some("the system") if meaning != "a length" => {}
            Some(earlier) => return taken(name, earlier),
            None => {}
        }
    }
    Ok(())
}

/// The names of coordinates that have names.
fn named(coordinates: &Option<Coordinates>) -> &[Name] {
    match coordinates.as_ref().map(|known| &known.kind) {
        Some(CoordinatesKind::Named(names)) => names,
        _ => &[],
    }
}

/// The layout of the coordinates, and the names of velocities.
pub(super) fn layout(
    input: Input<'_>,
    definition: &Definition,
) -> Result<(Layout, Vec<String>), Error> {
    let [q, p] = &definition.coordinates;
    let form = definition.form;
    let second = form.second_meaning();
    let missing = |part, example| {
        let kind = FormulaError::Missing { part, example };
        Err(input.error(&definition.name.span, kind.into()))
    };
    let Some(q) = q else {
        return missing("positions", form.coordinates());
    };
    let Some(p) = p else {
        return missing(second, form.coordinates());
    };
    let (place, found) = match (&q.kind, &p.kind) {
        (CoordinatesKind::Named(q), CoordinatesKind::Named(momenta)) => {
            if q.len() == momenta.len() {
                let text = |names: &[Name]| -> Vec<String> {
                    names.iter().map(|name| name.text.clone()).collect()
                };
                let (positions, names) = (text(q), text(momenta));
                return Ok(match form {
                    Form::Hamiltonian => {
                        let velocities = velocities(input, definition)?;
                        (Layout::Named([positions, names]), velocities)
                    }
                    Form::Lagrangian => {
                        let momenta = momentum_names(definition, &positions, &names);
                        (Layout::Named([positions, momenta]), names)
                    }
                });
            }
            (
                &p.span,
                format!("{} {second} for {} positions", momenta.len(), q.len()),
            )
        }
        (CoordinatesKind::Numbered(length, components), CoordinatesKind::Numbered(n, k)) => {
            if (length, components) == (n, k) {
                velocities(input, definition)?;
                return Ok((Layout::Numbered(length.clone(), *components), Vec::new()));
            }
            (
                &p.span,
                format!("{second} of another shape than the positions"),
            )
        }
        _ => (
            &p.span,
            format!("{second} of another kind than the positions"),
        ),
    };
    let single = match form {
        Form::Hamiltonian => "momentum",
        Form::Lagrangian => "velocity",
    };
    let expected = format!("one {single} for each position");
    Err(input.error(place, ErrorKind::Type { found, expected }))
}

/// The names of the velocities that a Hamiltonian system declares for its non-holonomic constraints.
fn velocities(input: Input<'_>, definition: &Definition) -> Result<Vec<String>, Error> {
    let (Some(velocities), [Some(q), Some(p)]) = (&definition.velocities, &definition.coordinates)
    else {
        return Ok(Vec::new());
    };
    let parameters = definition.parameters.iter();
    if let Some(parameter) = parameters
        .map(|known| &known.name)
        .find(|name| name.text == "v")
    {
        let kind = FormulaError::Taken {
            name: "v".to_owned(),
            meaning: "the velocities".to_owned(),
        };
        return Err(input.error(&parameter.span, kind.into()));
    }
    let wrong = |found: String| {
        let expected = "one velocity for each position".to_owned();
        Err(input.error(&velocities.span, ErrorKind::Type { found, expected }))
    };
    match (&q.kind, &p.kind, &velocities.kind) {
        (CoordinatesKind::Named(q), CoordinatesKind::Named(_), CoordinatesKind::Named(names)) => {
            if q.len() != names.len() {
                return wrong(format!(
                    "{} velocities for {} positions",
                    names.len(),
                    q.len()
                ));
            }
            Ok(names.iter().map(|name| name.text.clone()).collect())
        }
        (q, _, v) if q == v => Ok(Vec::new()),
        _ => wrong("velocities of another shape than the positions".to_owned()),
    }
}

/// A description of the coordinates, for messages.
pub(super) fn coordinate(form: Form) -> &'static str {
    match form {
        Form::Hamiltonian => "a coordinate or momentum",
        Form::Lagrangian => "a coordinate or velocity",
    }
}

/// The names of the momenta in a Lagrangian system: `p` for `q`, `pa` for `a`, or `p_a`, `p__a`, … if that name is taken.
fn momentum_names(
    definition: &Definition,
    positions: &[String],
    velocities: &[String],
) -> Vec<String> {
    let declared = definition
        .parameters
        .iter()
        .map(|parameter| &parameter.name)
        .chain(&definition.lengths)
        .chain(definition.abbreviations.iter().map(|known| &known.name))
        .chain(definition.functions.iter().flatten())
        .map(|name| &name.text);
    let mut taken: Vec<&String> = declared.chain(positions).chain(velocities).collect();
    let pi = "pi".to_owned();
    taken.push(&pi);
    let name = |position: &String| {
        if position == "q" {
            return "p".to_owned();
        }
        let mut momentum = format!("p{position}");
        let mut between = "_".to_owned();
        while taken.contains(&&momentum) {
            momentum = format!("p{between}{position}");
            between.push('_');
        }
        momentum
    };
    positions.iter().map(name).collect()
}

pub(super) fn parameters(
    input: Input<'_>,
    definition: &Definition,
    layout: &Layout,
) -> Result<Vec<Parameter>, Error> {
    let mut parameters: Vec<Parameter> = Vec::new();
    for parameter in &definition.parameters {
        let name = &parameter.name;
        let shape = match &parameter.kind {
            ParameterKind::Number(value) => Shape::Number(value.clone()),
            ParameterKind::Pairs => Shape::Pairs,
            ParameterKind::Array(lengths) => {
                let free = !matches!(layout, Layout::Numbered(Length::Runtime, _));
                if free && lengths.contains(&Length::Runtime) {
                    let kind = FormulaError::Unsupported {
                        what: format!("`{}` with a length that is known at run time", name.text),
                        instead: "write `q: [..]` too, or a length `<N>` of the system",
                    };
                    return Err(input.error(&name.span, kind.into()));
                }
                Shape::Array(lengths.clone())
            }
        };
        parameters.push(Parameter {
            name: name.text.clone(),
            shape,
        });
    }
    Ok(parameters)
}
