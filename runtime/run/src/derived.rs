//! Coordinates of the starts that follow from others: by formulas, on an energy surface, from velocities.

use std::ops::Range;

use symplectic::State;
use symplectic::nalgebra::DVector;
use symplectic_compiler::Error;
use symplectic_tape::{At, Input, Parameters, Tape, Tapes};

use crate::expression::Names;
use crate::setup::{File, Setup};
use crate::starts::{Coordinates, Start};
use crate::surface::outer_root;

/// How a coordinate follows from others.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Rule {
    /// An expression.
    Formula(String),
    /// The momentum for which H is the value of an expression: the largest one or the smallest.
    Energy { energy: String, is_largest: bool },
}

/// A coordinate that follows from others.
#[derive(Debug, Clone)]
pub(super) struct Derived {
    pub(super) place: usize,
    pub(super) name: String,
    pub(super) rule: Rule,
    /// The place of its value in the file.
    pub(super) span: Range<usize>,
}

/// Starts that are given in the same way.
#[derive(Debug)]
pub(super) struct Given {
    /// Coordinates, then parameters that vary; derived coordinates are not known yet.
    pub(super) rows: Vec<Vec<f64>>,
    pub(super) derived: Vec<Derived>,
    /// Whether velocities are in the place of momenta.
    pub(super) has_velocities: bool,
}

/// The starts of a run.
pub(super) struct Completed {
    pub(super) starts: Vec<Start>,
    /// The number of starts that are impossible and left out.
    pub(super) skipped: usize,
}

/// A rule that can be computed.
struct Prepared<'a> {
    derived: &'a Derived,
    /// The value, or the energy.
    value: Tape,
    /// The coordinates that must be known.
    needs: Vec<usize>,
}

/// Completes starts.
pub(super) struct Completion<'a> {
    pub(super) file: &'a File<'a>,
    pub(super) setup: &'a Setup,
    pub(super) coordinates: &'a Coordinates,
    pub(super) names: Names<'a>,
    pub(super) tapes: &'a Tapes,
}

impl Completion<'_> {
    pub(super) fn complete(&self, all: Vec<Given>) -> Result<Completed, Error> {
        let mut completed = Completed {
            starts: Vec::new(),
            skipped: 0,
        };
        for Given {
            rows,
            derived,
            has_velocities,
        } in all
        {
            let order = self.order(&derived, has_velocities)?;
            for mut row in rows {
                match self.derive(&order, &mut row, completed.starts.len()) {
                    Ok(()) => (),
                    Err(_) if self.setup.skip_impossible_starts => {
                        completed.skipped += 1;
                        continue;
                    }
                    Err(error) => return Err(error),
                }
                if has_velocities {
                    self.momenta(&mut row)?;
                }
                completed.starts.push(self.start(&row));
            }
        }
        if completed.starts.is_empty() && completed.skipped > 0 {
            let message = "all starts are impossible: their formulas have no value, or the energy is not reached";
            return Err(self.file.error(self.setup.starts.span(), message));
        }
        Ok(completed)
    }

    fn start(&self, row: &[f64]) -> Start {
        let half = self.coordinates.dimension();
        Start {
            state: State::new(
                self.setup.start(),
                DVector::from_column_slice(&row[..half]),
                DVector::from_column_slice(&row[half..2 * half]),
            ),
            parameters: row[2 * half..].to_vec(),
        }
    }

    /// The rules, each after those of the coordinates that it needs.
    fn order<'d>(
        &self,
        derived: &'d [Derived],
        has_velocities: bool,
    ) -> Result<Vec<Prepared<'d>>, Error> {
        let mut left = Vec::new();
        for derived in derived {
            left.push(self.prepare(derived, has_velocities)?);
        }
        let mut order: Vec<Prepared<'d>> = Vec::new();
        while !left.is_empty() {
            let open: Vec<usize> = left.iter().map(|rule| rule.derived.place).collect();
            let is_ready = |rule: &Prepared<'_>| !rule.needs.iter().any(|need| open.contains(need));
            let Some(next) = left.iter().position(is_ready) else {
                let names: Vec<String> = left
                    .iter()
                    .map(|rule| format!("`{}`", rule.derived.name))
                    .collect();
                let message = match &names[..] {
                    [name] => {
                        format!("{name} depends on itself: give one of its coordinates a number")
                    }
                    _ => format!(
                        "{} depend on each other: give one of them a number",
                        names.join(", ")
                    ),
                };
                return Err(self.file.error(left[0].derived.span.clone(), message));
            };
            order.push(left.remove(next));
        }
        Ok(order)
    }

    fn prepare<'d>(
        &self,
        derived: &'d Derived,
        has_velocities: bool,
    ) -> Result<Prepared<'d>, Error> {
        let Derived {
            place,
            name,
            rule,
            span,
        } = derived;
        let refused = |message: String| Err(self.file.error(span.clone(), message));
        let half = self.coordinates.dimension();
        let needs = |tape: &Tape| -> Vec<usize> {
            let places = tape.inputs().filter_map(|input| match input {
                Input::Position(k) => Some(k),
                Input::Momentum(k) => Some(half + k),
                Input::Constant(_) | Input::Time | Input::Parameter(_) => None,
            });
            places.collect()
        };
        let text = match rule {
            Rule::Formula(text) | Rule::Energy { energy: text, .. } => text,
        };
        let value = self.names.tape(name, text, span.clone())?;
        let mut all = needs(&value);
        if has_velocities && all.iter().any(|need| *need >= half) {
            return refused(format!(
                "`{name}` depends on a momentum, and the starts have velocities: give all momenta, or a formula of positions"
            ));
        }
        if let Rule::Energy { .. } = rule {
            let of_energy = needs(self.tapes.energy());
            if *place < half || has_velocities {
                return refused(format!(
                    "`{name}` is no momentum: an energy determines one of {}",
                    self.coordinates.halves[1].join(", ")
                ));
            }
            if !of_energy.contains(place) {
                return refused(format!(
                    "`{name}` does not change the energy: name another momentum"
                ));
            }
            all.extend(of_energy.into_iter().filter(|need| need != place));
        }
        Ok(Prepared {
            derived,
            value,
            needs: all,
        })
    }

    fn derive(
        &self,
        order: &[Prepared<'_>],
        row: &mut [f64],
        trajectory: usize,
    ) -> Result<(), Error> {
        if order.is_empty() {
            return Ok(());
        }
        let half = self.coordinates.dimension();
        let mut parameters = row[2 * half..].to_vec();
        let of_system = Parameters::from(parameters.as_slice());
        parameters.push(trajectory as f64);
        let with_number = Parameters::from(parameters.as_slice());
        for Prepared { derived, value, .. } in order {
            let place = derived.place;
            let value = value.value(self.at(&with_number, row));
            let found = match derived.rule {
                Rule::Formula(_) => Some(value),
                Rule::Energy { is_largest, .. } => {
                    let at = |momentum: f64| {
                        let mut row = row.to_vec();
                        row[place] = momentum;
                        let at = self.at(&of_system, &row);
                        [
                            self.tapes.energy_at(at),
                            self.tapes.velocity_at(at)[place - half],
                        ]
                    };
                    outer_root(at, value, is_largest)
                }
            };
            match found.filter(|found| found.is_finite()) {
                Some(found) => row[place] = found,
                None => return Err(self.impossible(derived, value, row, order, trajectory)),
            }
        }
        Ok(())
    }

    fn at<'r>(&self, parameters: &'r Parameters, row: &'r [f64]) -> At<'r, f64> {
        let half = self.coordinates.dimension();
        At {
            parameters,
            time: self.setup.start(),
            q: &row[..half],
            p: &row[half..2 * half],
        }
    }

    /// The error for a start without a value.
    fn impossible(
        &self,
        derived: &Derived,
        value: f64,
        row: &[f64],
        order: &[Prepared<'_>],
        trajectory: usize,
    ) -> Error {
        let name = &derived.name;
        let fault = match derived.rule {
            Rule::Formula(_) => format!("`{name}` is {value}"),
            Rule::Energy { .. } => format!("H does not reach the energy {value} for any `{name}`"),
        };
        let is_known = |place: &usize| order.iter().all(|rule| rule.derived.place != *place);
        let names = self.coordinates.with_parameters().zip(row).enumerate();
        let known = names.filter(|(place, _)| is_known(place));
        let known: Vec<String> = known
            .take(6)
            .map(|(_, (name, value))| format!("{name} = {value}"))
            .collect();
        let message = format!(
            "start {trajectory}, with {}: {fault}; give other starts, or leave out such starts by `skip_impossible_starts = true`",
            known.join(", ")
        );
        self.file.error(derived.span.clone(), message)
    }

    /// Replaces the velocities of a row by momenta. H of a Lagrangian is quadratic in the momenta.
    fn momenta(&self, row: &mut [f64]) -> Result<(), Error> {
        let half = self.coordinates.dimension();
        let parameters = Parameters::from(&row[2 * half..]);
        let (q, rest) = row.split_at_mut(half);
        let at = (self.setup.start(), &*q);
        let Some(momentum) = self.tapes.momentum_of(&parameters, at, &rest[..half]) else {
            let message = "the masses are singular at a start: give other starts";
            return Err(self.file.error(self.setup.starts.span(), message));
        };
        rest[..half].copy_from_slice(&momentum);
        Ok(())
    }
}
