//! Coordinates and parameters.

use super::super::error::FormulaError;
use super::super::syntax::{CoordinatesKind, Definition, Length, Name, ParameterKind};
use super::super::system::{Layout, Parameter, Shape};
use crate::error::{Error, ErrorKind};
use crate::expression::Input;

pub(super) fn layout(input: Input<'_>, definition: &Definition) -> Result<Layout, Error> {
    let [q, p] = &definition.coordinates;
    let missing = |part, example| {
        let kind = FormulaError::Missing { part, example };
        Err(input.error(&definition.name.span, kind.into()))
    };
    let Some(q) = q else {
        return missing("positions", "q: [a, b], p: [pa, pb];");
    };
    let Some(p) = p else {
        return missing("momenta", "q: [a, b], p: [pa, pb];");
    };
    let (place, found) = match (&q.kind, &p.kind) {
        (CoordinatesKind::Named(q), CoordinatesKind::Named(momenta)) => {
            let mut names: Vec<&Name> = Vec::new();
            for name in q.iter().chain(momenta) {
                if names.iter().any(|known| known.text == name.text) {
                    let kind = FormulaError::Taken {
                        name: name.text.clone(),
                        meaning: "a coordinate or momentum".to_owned(),
                    };
                    return Err(input.error(&name.span, kind.into()));
                }
                names.push(name);
            }
            if q.len() == momenta.len() {
                let text = |names: &[Name]| names.iter().map(|name| name.text.clone()).collect();
                return Ok(Layout::Named([text(q), text(momenta)]));
            }
            (
                &p.span,
                format!("{} momenta for {} positions", momenta.len(), q.len()),
            )
        }
        (CoordinatesKind::Numbered(length, components), CoordinatesKind::Numbered(n, k)) => {
            if (length, components) == (n, k) {
                return Ok(Layout::Numbered(length.clone(), *components));
            }
            (
                &p.span,
                "momenta of another shape than the positions".to_owned(),
            )
        }
        _ => (
            &p.span,
            "momenta of another kind than the positions".to_owned(),
        ),
    };
    let expected = "one momentum for each position".to_owned();
    Err(input.error(place, ErrorKind::Type { found, expected }))
}

pub(super) fn parameters(
    input: Input<'_>,
    definition: &Definition,
    layout: &Layout,
) -> Result<Vec<Parameter>, Error> {
    let mut parameters: Vec<Parameter> = Vec::new();
    let taken = |name: &Name, meaning: &str| {
        let kind = FormulaError::Taken {
            name: name.text.clone(),
            meaning: meaning.to_owned(),
        };
        Err(input.error(&name.span, kind.into()))
    };
    for parameter in &definition.parameters {
        let name = &parameter.name;
        if parameters.iter().any(|known| known.name == name.text) {
            return taken(name, "a parameter");
        }
        if definition
            .lengths
            .iter()
            .any(|length| length.text == name.text)
        {
            return taken(name, "a length");
        }
        if let Layout::Named(names) = layout
            && names.iter().flatten().any(|known| *known == name.text)
        {
            return taken(name, "a coordinate or momentum");
        }
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
