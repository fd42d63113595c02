//! Applied forces and friction.

use super::smooth::Role;
use super::values::counted;
use super::{Elaborator, Momenta, Value};
use crate::derivative::Scatter;
use crate::graph::{Coordinate, Half, Id, Node};
use crate::syntax::{Force, Form, Kind, Length, Name, Over};
use crate::system::{Layout, Parameter, Shape};
use symplectic_exact::error::FormulaError;
use symplectic_exact::error::{Error, ErrorKind};

impl Elaborator<'_> {
    /// The applied forces, each with its coordinate.
    pub(super) fn forces(&mut self) -> Result<Vec<Scatter>, Error> {
        let mut forces = Vec::new();
        for written in &self.definition.forces {
            let parts = match self.indices(written) {
                None => self.force(written)?,
                Some(over) => self.under(&over, &written.target, |this| this.force(written))?,
            };
            let loops = std::mem::take(&mut self.loops);
            forces.extend(parts.into_iter().map(|(target, value)| Scatter {
                loops: loops.clone(),
                target,
                value,
            }));
        }
        Ok(forces)
    }

    /// The indices of a force: the written ones, or all if the index of the coordinate is a new name.
    fn indices(&self, written: &Force) -> Option<Over> {
        if written.over.is_some() {
            return written.over.clone();
        }
        let Kind::Entry(_, indices) = &written.target.kind else {
            return None;
        };
        match &indices[0].kind {
            Kind::Name(text) if !self.names.contains_key(text) => {
                let name = Name {
                    text: text.clone(),
                    span: indices[0].span.clone(),
                };
                Some(Over::Range(name, None))
            }
            _ => None,
        }
    }

    /// The components of a coordinate, each with the force on it.
    fn force(&mut self, written: &Force) -> Result<Vec<(Coordinate, Id)>, Error> {
        let (target, value) = (&written.target, &written.value);
        let coordinates: Option<Vec<Coordinate>> = match self.value(target)? {
            Value::Scalar(id) => self.position(id).map(|coordinate| vec![coordinate]),
            Value::Vector(parts) => parts.iter().map(|&part| self.position(part)).collect(),
            _ => None,
        };
        let Some(coordinates) = coordinates else {
            let kind = ErrorKind::Type {
                found: format!("`{}`", self.text(target)),
                expected: "a position, on which the force is: `x` or `q[i]`".to_owned(),
            };
            return self.error(target, kind);
        };
        let is_lagrangian = self.definition.form == Form::Lagrangian;
        if is_lagrangian {
            self.momenta = Momenta::NotInForce;
        }
        let found = self.value(value)?;
        self.momenta = Momenta::Known;
        let parts = match found {
            Value::Scalar(id) => vec![id],
            found => self.components(found, value)?,
        };
        if !is_lagrangian {
            for &part in &parts {
                self.no_velocity(part, value)?;
            }
        }
        for &part in &parts {
            self.check_smooth(part, Role::Force, value)?;
        }
        if parts.len() != coordinates.len() {
            let kind = ErrorKind::Type {
                found: format!("a force with {}", counted(parts.len(), "component")),
                expected: format!("one with {}, as the position has", coordinates.len()),
            };
            return self.error(value, kind);
        }
        Ok(coordinates.into_iter().zip(parts).collect())
    }

    fn position(&self, id: Id) -> Option<Coordinate> {
        match self.graph.node(id) {
            Node::Coordinate(coordinate) if coordinate.half == Half::Q => Some(coordinate.clone()),
            _ => None,
        }
    }

    /// The rates of the friction, functions of parameters only: see [`System::friction`](crate::System::friction).
    pub(super) fn friction(&mut self) -> Result<Vec<Id>, Error> {
        let Some(written) = &self.definition.friction else {
            return Ok(Vec::new());
        };
        let value = self.value(written)?;
        let count = match &self.layout {
            Layout::Named([names, _]) => Some(names.len()),
            Layout::Numbered(_, Some(components)) => Some(*components),
            Layout::Numbered(Length::Fixed(count), None) => Some(*count),
            Layout::Numbered(..) => None,
        };
        let rates = match self.whole(value) {
            Value::Scalar(rate) => vec![rate],
            Value::Vector(rates) if count == Some(rates.len()) => rates,
            other => {
                let list = count.filter(|&count| count > 1);
                let list =
                    list.map(|count| format!(", or a list of {count}, one for each component"));
                let list = list.unwrap_or_default();
                let force = self.force_of_rates(&other);
                let expected = format!("a rate γ{list}{}", force.unwrap_or_default());
                return self.mismatch(written, &other, &expected);
            }
        };
        let fixed = rates
            .iter()
            .all(|&rate| self.graph.depends(rate).is_fixed());
        if !fixed {
            let kind = ErrorKind::Type {
                found: format!("the friction `{}`", self.text(written)),
                expected: "a rate γ of numbers and parameters, for the force −γp".to_owned(),
            };
            return self.error(written, kind);
        }
        if !self.definition.constraints.is_empty() {
            let velocities = self.velocities_of_forces();
            let kind = FormulaError::FrictionAsForce {
                with: "with constraints",
                force: self.layout.drag(velocities),
            };
            return self.error(written, kind);
        }
        Ok(rates)
    }

    /// The names of the velocities, if forces are functions of them and not of momenta.
    fn velocities_of_forces(&self) -> Option<&[String]> {
        (self.definition.form == Form::Lagrangian).then_some(&self.velocities)
    }

    /// The force that replaces a friction with a rate for each body.
    fn force_of_rates(&self, value: &Value) -> Option<String> {
        let (Value::Parameter(k), Layout::Numbered(bodies, _)) = (value, &self.layout) else {
            return None;
        };
        let Parameter { name, shape } = &self.parameters[*k];
        let is_list = matches!(shape, Shape::Array(lengths) if lengths[..] == [bodies.clone()]);
        is_list.then(|| match self.velocities_of_forces() {
            None => {
                format!("; for a rate for each body write `force: {{ q[i] = -{name}[i] p[i] }}`")
            }
            Some(_) => {
                format!("; for a drag on each body write `force: {{ q[i] = -{name}[i] v[i] }}`")
            }
        })
    }
}
