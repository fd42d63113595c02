//! What a run writes: arrays for NumPy, `.npz`, or a table, `.parquet` or `.csv`.

use std::io::{self, Write};
use std::sync::Arc;

use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};
use symplectic::constraints::{Constrained, constraint_force};
use symplectic::ensemble::Npz;
use symplectic::nalgebra::DVector;
use symplectic::output::unit_of;
use symplectic::{General, State};
use symplectic_tape::{At, Formula, Parameters, Tapes};

use crate::starts::Coordinates;
use crate::trajectory::Trajectory;

/// A state that is written.
#[derive(Clone, Copy)]
pub(super) struct Point<'a> {
    pub(super) time: f64,
    /// Positions and momenta.
    pub(super) halves: [&'a [f64]; 2],
}

impl<'a> From<&'a State<DVector<f64>>> for Point<'a> {
    fn from(state: &'a State<DVector<f64>>) -> Self {
        let (q, p) = state.as_slices();
        Point {
            time: state.time,
            halves: [q, p],
        }
    }
}

/// Appends a state to the output of a trajectory.
pub(super) fn append(output: &mut Vec<f64>, state: &State<DVector<f64>>) {
    let Point { time, halves } = state.into();
    output.push(time);
    output.extend(halves.into_iter().flatten());
}

/// The states in the output of a trajectory.
pub(super) fn points(row: &Trajectory) -> impl Iterator<Item = Point<'_>> {
    let dimension = row.state.q.len();
    let states = row.output.chunks_exact(1 + 2 * dimension);
    states.map(move |numbers| Point {
        time: numbers[0],
        halves: [&numbers[1..=dimension], &numbers[1 + dimension..]],
    })
}

/// The metadata in the file.
#[derive(Clone, Copy)]
pub(super) struct Facts<'a> {
    pub(super) method: &'a str,
    pub(super) definition: &'a str,
    pub(super) orders: [u64; 3],
    pub(super) step_size: f64,
    pub(super) sums: &'static str,
    pub(super) formula: &'a str,
    pub(super) setup: &'a str,
}

/// A fact in the metadata.
pub(super) enum Fact<'a> {
    Text(&'a str),
    Integers([u64; 3]),
    Number(f64),
}

impl Facts<'_> {
    /// All facts, by name.
    pub(super) fn all(&self) -> [(&'static str, Fact<'_>); 8] {
        [
            ("method", Fact::Text(self.method)),
            ("definition", Fact::Text(self.definition)),
            ("orders", Fact::Integers(self.orders)),
            ("step_size", Fact::Number(self.step_size)),
            ("sums", Fact::Text(self.sums)),
            ("formula", Fact::Text(self.formula)),
            ("setup", Fact::Text(self.setup)),
            ("version", Fact::Text(env!("CARGO_PKG_VERSION"))),
        ]
    }
}

/// The results of a run.
#[derive(Clone, Copy)]
pub(super) struct Results<'a> {
    pub(super) coordinates: &'a Coordinates,
    pub(super) facts: Facts<'a>,
    pub(super) tapes: &'a Arc<Tapes>,
    pub(super) rows: &'a [Trajectory],
    /// The start of each trajectory.
    pub(super) starts: &'a [State<DVector<f64>>],
    /// The values of the parameters that vary, for each trajectory of the whole run.
    pub(super) parameters: &'a [Vec<f64>],
    pub(super) seen: Seen<'a>,
    /// Whether the outputs are indicators of chaos.
    pub(super) has_chaos: bool,
}

/// The names of further columns: indicators of chaos; the error of the constraints, with the multipliers of holonomic ones.
pub(super) fn further(tapes: &Tapes, has_chaos: bool) -> Vec<String> {
    if has_chaos {
        return ["megno", "lyapunov_exponent"].map(str::to_owned).to_vec();
    }
    let Some(constraints) = tapes.constraints() else {
        return Vec::new();
    };
    let names = constraints.names().iter();
    let multipliers = names.filter(|_| constraints.are_holonomic());
    let multipliers = multipliers.map(|name| format!("{MULTIPLIER}{name}"));
    ["constraint_error".to_owned()]
        .into_iter()
        .chain(multipliers)
        .collect()
}

/// The states of a trajectory that are written.
#[derive(Clone, Copy)]
pub(super) enum Seen<'a> {
    /// The last one.
    End,
    /// Those at these times.
    Times(&'a [f64]),
    /// Those of a section.
    Section,
}

impl Results<'_> {
    /// `(H − H₀)/|H₀|`; if H₀ is nothing but rounding, relative to [its terms](unit_of).
    pub(super) fn energy_errors(&self) -> Vec<Vec<f64>> {
        self.of_rows(|row, start, parameters| {
            let energy_at = |Point {
                                 time,
                                 halves: [q, p],
                             }: Point<'_>| {
                let at = At {
                    parameters,
                    time,
                    q,
                    p,
                };
                self.tapes.energy_at(at)
            };
            let first = energy_at(start.into());
            let scale = unit_of(|state| energy_at(state.into()), start);
            let seen = self.states(row).into_iter();
            seen.map(|point| (energy_at(point) - first) / scale)
                .collect()
        })
    }

    /// Numbers for each trajectory, from its start and its parameters.
    fn of_rows(
        &self,
        of: impl Fn(&Trajectory, &State<DVector<f64>>, &Parameters) -> Vec<f64> + Sync,
    ) -> Vec<Vec<f64>> {
        let pairs = self.rows.par_iter().zip(self.starts);
        let all = pairs.map(|(row, start)| {
            let parameters = Parameters::from(self.parameters(row));
            of(row, start, &parameters)
        });
        all.collect()
    }

    /// The states of a trajectory that are written.
    fn states<'r>(&self, row: &'r Trajectory) -> Vec<Point<'r>> {
        match self.seen {
            Seen::End => vec![(&row.state).into()],
            Seen::Times(_) | Seen::Section => points(row).collect(),
        }
    }

    /// The errors of the constraints at the states that are written: the largest |φ|, or |w·q'|; none without constraints.
    pub(super) fn constraint_errors(&self) -> Vec<Vec<f64>> {
        self.of_rows(|row, _, parameters| {
            let seen = self.states(row).into_iter();
            seen.filter_map(|point| self.constraint_error(point, parameters))
                .collect()
        })
    }

    fn constraint_error(
        &self,
        Point {
            time,
            halves: [q, p],
        }: Point<'_>,
        parameters: &Parameters,
    ) -> Option<f64> {
        let constraints = self.tapes.constraints()?;
        let velocity = self.tapes.velocity_at(At {
            parameters,
            time,
            q,
            p,
        });
        Some(constraints.error(parameters, q, &velocity))
    }

    /// The names of the further columns.
    pub(super) fn further_names(&self) -> Vec<String> {
        further(self.tapes, self.has_chaos)
    }

    /// The numbers in the further columns, for each state that is written one after another. Multipliers are NaN at states that are not on
    /// the constraints, as between steps.
    pub(super) fn further(&self) -> Vec<Vec<f64>> {
        let multipliers = self.further_names().len().saturating_sub(1);
        self.of_rows(|row, _, parameters| {
            if self.has_chaos {
                return (0..=multipliers).map(|k| indicator(row, k)).collect();
            }
            let mut all = Vec::new();
            for point in self.states(row) {
                all.extend(self.constraint_error(point, parameters));
                if multipliers > 0 {
                    let own = self.multipliers(point, parameters);
                    all.extend(own.unwrap_or_else(|| vec![f64::NAN; multipliers]));
                }
            }
            all
        })
    }

    fn multipliers(&self, point: Point<'_>, parameters: &Parameters) -> Option<Vec<f64>> {
        let system =
            Formula::<Constrained<General>>::new(Arc::clone(self.tapes), parameters.clone());
        let [q, p] = point.halves.map(DVector::from_column_slice);
        let found = constraint_force(&system, &State::new(point.time, q, p));
        found.ok().map(|found| found.multipliers)
    }

    /// The values of the parameters that vary.
    pub(super) fn parameters(&self, row: &Trajectory) -> &[f64] {
        self.parameters.get(row.number).map_or(&[], Vec::as_slice)
    }

    /// The same trajectories with their last states only.
    pub(super) fn at_end(&self) -> Self {
        Results {
            seen: Seen::End,
            ..*self
        }
    }

    pub(super) fn write_npz(&self, out: &mut impl Write) -> io::Result<()> {
        let mut file = Npz::new(out);
        for (name, fact) in self.facts.all() {
            match fact {
                Fact::Text(text) => file.text(name, text)?,
                Fact::Integers(integers) => file.integers(name, &[integers.len()], &integers)?,
                Fact::Number(number) => file.doubles(name, &[], &[number])?,
            }
        }
        for (name, names) in ["positions", "momenta"]
            .into_iter()
            .zip(&self.coordinates.halves)
        {
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            file.texts(name, &names)?;
        }
        let (count, dimension) = (self.rows.len(), self.coordinates.dimension());
        let errors = self.energy_errors();
        for (name, half) in [("q_start", 0), ("p_start", 1)] {
            let all: Vec<f64> = self
                .starts
                .iter()
                .flat_map(|start| Point::from(start).halves[half])
                .copied()
                .collect();
            file.doubles(name, &[count, dimension], &all)?;
        }
        let names = &self.coordinates.parameters;
        if !names.is_empty() {
            let texts: Vec<&str> = names.iter().map(String::as_str).collect();
            file.texts("parameter_names", &texts)?;
            let rows = self.rows.iter();
            let all: Vec<f64> = rows.flat_map(|row| self.parameters(row)).copied().collect();
            file.doubles("parameters", &[count, names.len()], &all)?;
        }
        self.write_rows(&mut file)?;
        let times = match self.seen {
            Seen::Times(times) => times,
            Seen::End => {
                file.doubles("energy_error", &[count], &errors.concat())?;
                self.write_further(&mut file, &[count], 1)?;
                return file.finish().map(|_| ());
            }
            Seen::Section => {
                self.write_section(&mut file)?;
                let errors = errors.concat();
                file.doubles("energy_error", &[errors.len()], &errors)?;
                self.write_further(&mut file, &[errors.len()], 0)?;
                return file.finish().map(|_| ());
            }
        };
        // NaN for the times that a failed trajectory did not reach.
        let steps = times.len();
        file.doubles("times", &[steps], times)?;
        for (name, half) in [("q_at_times", 0), ("p_at_times", 1)] {
            let mut all = vec![f64::NAN; count * steps * dimension];
            for (row, places) in self
                .rows
                .iter()
                .zip(all.chunks_mut((steps * dimension).max(1)))
            {
                for (seen, place) in points(row).zip(places.chunks_mut(dimension.max(1))) {
                    place.copy_from_slice(seen.halves[half]);
                }
            }
            file.doubles(name, &[count, steps, dimension], &all)?;
        }
        let mut all = vec![f64::NAN; count * steps];
        for (errors, places) in errors.iter().zip(all.chunks_mut(steps.max(1))) {
            places[..errors.len()].copy_from_slice(errors);
        }
        file.doubles("energy_error", &[count, steps], &all)?;
        self.write_further(&mut file, &[count, steps], steps)?;
        file.finish().map(|_| ())
    }

    /// The further columns: those of `multiplier_…` as one array. Each trajectory has at least this number of states; those that it did not
    /// reach have NaN.
    fn write_further(
        &self,
        file: &mut Npz<impl Write>,
        shape: &[usize],
        least: usize,
    ) -> io::Result<()> {
        let names = self.further_names();
        if names.is_empty() {
            return Ok(());
        }
        let mut all = self.further();
        for row in &mut all {
            row.resize(row.len().max(least * names.len()), f64::NAN);
        }
        let all = all.concat();
        let column = |k: usize| all.iter().copied().skip(k).step_by(names.len());
        for (k, name) in names.iter().enumerate() {
            if !name.starts_with(MULTIPLIER) {
                file.doubles(name, shape, &column(k).collect::<Vec<_>>())?;
            }
        }
        let multipliers = names
            .iter()
            .filter_map(|name| name.strip_prefix(MULTIPLIER));
        let multipliers: Vec<&str> = multipliers.collect();
        if multipliers.is_empty() {
            return Ok(());
        }
        let states = all.chunks_exact(names.len());
        let values: Vec<f64> = states.flat_map(|state| &state[1..]).copied().collect();
        file.texts("constraints", &multipliers)?;
        let shape = [shape, &[multipliers.len()]].concat();
        file.doubles("multipliers", &shape, &values)
    }

    /// The numbers, last states and errors of trajectories.
    fn write_rows(&self, file: &mut Npz<impl Write>) -> io::Result<()> {
        let (rows, count) = (self.rows, self.rows.len());
        let integers = |of: fn(&Trajectory) -> u64| rows.iter().map(of).collect::<Vec<u64>>();
        file.integers("trajectory", &[count], &integers(|row| row.number as u64))?;
        let times: Vec<f64> = rows.iter().map(|row| row.state.time).collect();
        file.doubles("time", &[count], &times)?;
        let dimension = self.coordinates.dimension();
        for (name, half) in [("q", 0), ("p", 1)] {
            let states = rows.iter().map(|row| Point::from(&row.state));
            let values = states.flat_map(|state| state.halves[half]).copied();
            let values = of_length(count * dimension, values);
            file.doubles(name, &[count, dimension], &values)?;
        }
        file.integers("steps", &[count], &integers(|row| row.statistics.steps))?;
        let failed = |row: &'_ Trajectory| Some((row.number as u64, row.failure.clone()?.message));
        let (failed, errors): (Vec<u64>, Vec<String>) = rows.iter().filter_map(failed).unzip();
        file.integers("failed", &[failed.len()], &failed)?;
        let errors: Vec<&str> = errors.iter().map(String::as_str).collect();
        file.texts("error", &errors)
    }

    /// The states of a section, one after another. Only one array is in memory at a time.
    fn write_section(&self, file: &mut Npz<impl Write>) -> io::Result<()> {
        let all = || {
            let rows = self.rows.iter();
            rows.flat_map(|row| (0_u64..).zip(points(row)).map(move |seen| (row, seen)))
        };
        let dimension = self.coordinates.dimension();
        let count = self.rows.iter().map(|row| points(row).count()).sum();
        let trajectories = all().map(|(row, _)| row.number as u64);
        file.integers(
            "section_trajectory",
            &[count],
            &of_length(count, trajectories),
        )?;
        let numbers = all().map(|(_, (number, _))| number);
        file.integers("section_number", &[count], &of_length(count, numbers))?;
        let times = all().map(|(_, (_, point))| point.time);
        file.doubles("section_time", &[count], &of_length(count, times))?;
        for (name, half) in [("section_q", 0), ("section_p", 1)] {
            let values = all().flat_map(|(_, (_, point))| point.halves[half]);
            let values = of_length(count * dimension, values.copied());
            file.doubles(name, &[count, dimension], &values)?;
        }
        Ok(())
    }
}

/// How the names of columns of multipliers begin.
const MULTIPLIER: &str = "multiplier_";

/// An indicator of chaos; NaN for a trajectory that could not start.
fn indicator(row: &Trajectory, k: usize) -> f64 {
    row.output.get(k).copied().unwrap_or(f64::NAN)
}

/// The values of an iterator that does not know its length, without growing.
fn of_length<T>(length: usize, values: impl Iterator<Item = T>) -> Vec<T> {
    let mut all = Vec::with_capacity(length);
    all.extend(values);
    all
}
