//! Tables, as CSV or Parquet: results with a line for each state, and starts with a line for each trajectory.

use std::collections::{HashMap, HashSet};
use std::fmt::Display;
use std::fs::{self, File};
use std::io::{self, Write};
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;
use symplectic::ensemble::{Parquet, ParquetColumn};
use symplectic_compiler::{Error, ErrorKind};
use symplectic_formula::{Parameter, Shape};

use crate::output::{Fact, Point, Results, Seen, points};
use crate::setup::MAX_COUNT;
use crate::starts::{Coordinates, Reader, listed};
use crate::trajectory::Trajectory;

/// Lines that are written to a Parquet file at once, if they are not wide.
const GROUP: usize = 1 << 16;

/// Cells that are written to a Parquet file at once.
const CELLS: usize = 1 << 22;

/// Largest size of a file of starts.
const MAX_BYTES: u64 = 1 << 31;

/// A line of a table of results: a state of a trajectory.
struct Line<'a> {
    row: &'a Trajectory,
    /// The number of states of the trajectory before it.
    number: usize,
    start: Point<'a>,
    parameters: &'a [f64],
    state: Point<'a>,
    energy_error: Option<f64>,
    /// The numbers in the further columns; none for a last good state beside others.
    further: Vec<f64>,
    /// Why the trajectory ended there.
    failure: Option<String>,
}

impl Results<'_> {
    /// A line for each trajectory, or for each trajectory and time. A trajectory that failed ends with its last good state and its error.
    fn lines(&self) -> impl Iterator<Item = Line<'_>> {
        let width = self.further_names().len();
        let further = match width {
            0 => vec![Vec::new(); self.rows.len()],
            _ => self.further(),
        };
        let rows = self.rows.iter().zip(self.starts);
        let rows = rows.zip(self.energy_errors()).zip(further);
        rows.flat_map(move |(((row, start), errors), further)| {
            let failure = row.failure.as_ref().map(|failure| failure.message.clone());
            let line = move |number: usize, state, energy_error: Option<f64>, failure| Line {
                row,
                number,
                start: start.into(),
                parameters: self.parameters(row),
                state,
                energy_error,
                further: match energy_error {
                    Some(_) => further[number * width..][..width].to_vec(),
                    None => Vec::new(),
                },
                failure,
            };
            // Without times and a section there are no points, and one error.
            let is_end = matches!(self.seen, Seen::End);
            let last = (is_end || failure.is_some()).then(|| {
                let error = errors.first().filter(|_| is_end);
                let number = if is_end { 0 } else { points(row).count() };
                line(number, (&row.state).into(), error.copied(), failure)
            });
            let seen = points(row).zip(errors).enumerate();
            let seen = seen.map(move |(k, (state, error))| line(k, state, Some(error), None));
            seen.collect::<Vec<_>>().into_iter().chain(last)
        })
    }

    fn header(&self) -> Vec<String> {
        header(
            self.coordinates,
            matches!(self.seen, Seen::Section),
            &self.further_names(),
        )
    }

    pub(super) fn write_csv(&self, out: &mut impl Write) -> io::Result<()> {
        let mut file = csv::Writer::from_writer(out);
        let is_section = matches!(self.seen, Seen::Section);
        let further = 0..self.further_names().len();
        file.write_record(self.header())?;
        for line in self.lines() {
            let numbers = |state| coordinates(state).map(|x| cell(*x));
            let energy_error = line.energy_error.map(|error| format!("{error:e}"));
            let mut cells = vec![line.row.number.to_string()];
            cells.extend(numbers(line.start));
            cells.extend(line.parameters.iter().map(|x| cell(*x)));
            cells.extend(is_section.then(|| line.number.to_string()));
            cells.push(cell(line.state.time));
            cells.extend(numbers(line.state));
            cells.push(energy_error.unwrap_or_default());
            let number = |k| {
                let number = line.further.get(k).filter(|x: &&f64| !x.is_nan());
                number.map_or(String::new(), |x| cell(*x))
            };
            cells.extend(further.clone().map(number));
            cells.push(line.row.statistics.steps.to_string());
            cells.push(line.failure.unwrap_or_default());
            file.write_record(cells)?;
        }
        file.flush()
    }

    /// As [`write_csv`](Self::write_csv); where there is no energy error it is NaN, where there is no error it is null.
    pub(super) fn write_parquet(&self, out: &mut (impl Write + Send)) -> io::Result<()> {
        let mut file = Parquet::new(out);
        for (name, fact) in self.facts.all() {
            match fact {
                Fact::Text(text) => file.note(name, text),
                Fact::Integers(integers) => file.note(name, &format!("{integers:?}")),
                Fact::Number(number) => file.note(name, &format!("{number:?}")),
            }
        }
        let is_section = matches!(self.seen, Seen::Section);
        let names = self.header();
        let further = self.further_names().len();
        let mut lines = self.lines();
        let most = (CELLS / names.len()).clamp(1, GROUP);
        loop {
            let group: Vec<Line<'_>> = lines.by_ref().take(most).collect();
            let columns = columns(&group, self.coordinates, is_section, further);
            let columns: Vec<_> = names.iter().map(String::as_str).zip(columns).collect();
            file.group(&columns)?;
            if group.len() < most {
                return file.finish().map(|_| ());
            }
        }
    }
}

/// The shortest digits that give the number, with an exponent if it is small or large.
fn cell(x: f64) -> String {
    match x == 0.0 || (1e-5..1e16).contains(&x.abs()) {
        true => x.to_string(),
        false => format!("{x:e}"),
    }
}

/// Positions, then momenta.
fn coordinates(state: Point<'_>) -> impl Iterator<Item = &f64> {
    state.halves.into_iter().flatten()
}

/// The names of the columns; coordinates are at the start and at the time of the line. States of a section have numbers.
fn header(coordinates: &Coordinates, is_section: bool, further: &[String]) -> Vec<String> {
    let starts = coordinates.all().map(|name| format!("{name}_start"));
    let own = |name: &str| [name.to_owned()].into_iter();
    own("trajectory")
        .chain(starts)
        .chain(coordinates.parameters.iter().cloned())
        .chain(is_section.then(|| "number".to_owned()))
        .chain(own("time"))
        .chain(coordinates.all().cloned())
        .chain(own("energy_error"))
        .chain(further.iter().cloned())
        .chain(["steps", "error"].map(str::to_owned))
        .collect()
}

/// A name that two columns of a table would have, as with a coordinate `time`.
pub(super) fn twin(
    coordinates: &Coordinates,
    is_section: bool,
    further: &[String],
) -> Option<String> {
    let mut known = HashSet::new();
    let mut names = header(coordinates, is_section, further).into_iter();
    names.find(|name| !known.insert(name.clone()))
}

/// The columns of lines, in the order of the [`header`].
fn columns(
    lines: &[Line<'_>],
    names: &Coordinates,
    is_section: bool,
    further: usize,
) -> Vec<ParquetColumn> {
    let count = names.all().count();
    let integers =
        |of: fn(&Line<'_>) -> u64| ParquetColumn::Integers(lines.iter().map(of).collect());
    let doubles =
        |of: &dyn Fn(&Line<'_>) -> f64| ParquetColumn::Doubles(lines.iter().map(of).collect());
    let coordinate = |of: for<'l> fn(&'l Line<'_>) -> Point<'l>, k: usize| {
        doubles(&|line| coordinates(of(line)).nth(k).copied().unwrap_or(f64::NAN))
    };
    let mut columns = vec![integers(|line| line.row.number as u64)];
    columns.extend((0..count).map(|k| coordinate(|line| line.start, k)));
    let parameters = 0..names.parameters.len();
    columns.extend(parameters.map(|k| doubles(&|line| line.parameters[k])));
    columns.extend(is_section.then(|| integers(|line| line.number as u64)));
    columns.push(doubles(&|line| line.state.time));
    columns.extend((0..count).map(|k| coordinate(|line| line.state, k)));
    columns.push(doubles(&|line| line.energy_error.unwrap_or(f64::NAN)));
    let number = |k: usize| move |line: &Line<'_>| line.further.get(k).copied().unwrap_or(f64::NAN);
    columns.extend((0..further).map(|k| doubles(&number(k))));
    columns.push(integers(|line| line.row.statistics.steps));
    let failures = lines.iter().map(|line| line.failure.clone()).collect();
    columns.push(ParquetColumn::Texts(failures));
    columns
}

/// The coordinates of a system, a value for each of them in each row, and whether these are velocities in the place of momenta.
type Rows = (Coordinates, Vec<Vec<f64>>, bool);

/// The columns that a file of starts must have.
struct Columns {
    names: Vec<String>,
    has_velocities: bool,
}

impl Reader<'_> {
    /// The rows of a file whose columns have the names of the coordinates.
    pub(super) fn of_table(&self, path: &Path) -> Result<Rows, Error> {
        let about = fs::metadata(path).map_err(|error| refused(path, error))?;
        if !about.is_file() {
            return Err(refused(
                path,
                "not a file on a disk: write the starts to a file",
            ));
        }
        if about.len() > MAX_BYTES {
            let message =
                format!("longer than {MAX_BYTES} bytes: split the file into several files");
            return Err(refused(path, message));
        }
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("parquet") => {
                // The crate panics on some files that are damaged.
                let hook = panic::take_hook();
                panic::set_hook(Box::new(|_| {}));
                let rows = panic::catch_unwind(AssertUnwindSafe(|| self.of_parquet(path)));
                panic::set_hook(hook);
                rows.unwrap_or_else(|_| Err(refused(path, "the file is damaged")))
            }
            _ => self.of_csv(path),
        }
    }

    fn of_csv(&self, path: &Path) -> Result<Rows, Error> {
        let mut reader = csv::ReaderBuilder::new()
            .trim(csv::Trim::All)
            .from_path(path)
            .map_err(|error| refused(path, error))?;
        let header = reader.headers().map_err(|error| refused(path, error))?;
        let header = header.clone();
        let names: Vec<&str> = header.iter().collect();
        let coordinates = self.coordinates(&names)?;
        let columns = self.columns(&coordinates, &names);
        let places = places(&columns, &names)
            .map_err(|message| refused(path, format!("line 1: {message}")))?;
        let mut rows = Vec::new();
        for (number, record) in reader.records().enumerate() {
            let record = record.map_err(|error| refused(path, error))?;
            if number == MAX_COUNT {
                return Err(refused(path, too_many()));
            }
            let cells = record
                .iter()
                .map(|text| (text.to_owned(), text.parse().ok()));
            let row = row(number, &places, &names, cells);
            rows.push(row.map_err(|message| refused(path, message))?);
        }
        let has_velocities = columns.has_velocities;
        Ok((coordinates, rows, has_velocities))
    }

    fn of_parquet(&self, path: &Path) -> Result<Rows, Error> {
        let file = File::open(path).map_err(|error| refused(path, error))?;
        let reader = SerializedFileReader::new(file).map_err(|error| refused(path, error))?;
        let about = reader.metadata().file_metadata();
        if about.num_rows() > MAX_COUNT as i64 {
            return Err(refused(path, too_many()));
        }
        let fields = about.schema().get_fields();
        let names: Vec<&str> = fields.iter().map(|field| field.name()).collect();
        let coordinates = self.coordinates(&names)?;
        let columns = self.columns(&coordinates, &names);
        let places = places(&columns, &names).map_err(|message| refused(path, message))?;
        let unread = |error| {
            refused(
                path,
                format!(
                    "{error}; only files without compression or with Snappy compression can be read"
                ),
            )
        };
        let records = reader.get_row_iter(None).map_err(unread)?;
        let mut rows = Vec::new();
        for (number, record) in records.enumerate() {
            let record = record.map_err(unread)?;
            if number == MAX_COUNT {
                return Err(refused(path, too_many()));
            }
            let fields = record.get_column_iter().map(|(_, field)| field);
            let cells = fields.map(|field| (field.to_string(), double(field)));
            let row = row(number, &places, &names, cells);
            rows.push(row.map_err(|message| refused(path, message))?);
        }
        let has_velocities = columns.has_velocities;
        Ok((coordinates, rows, has_velocities))
    }

    /// The columns of a file with some names; of a Lagrangian it has momenta or velocities.
    fn columns(&self, coordinates: &Coordinates, names: &[&str]) -> Columns {
        let velocities = self.velocities(coordinates);
        let is_velocity = |name: &&str| velocities.iter().any(|velocity| velocity == name);
        let has_velocities = names.iter().any(is_velocity);
        let [positions, momenta] = &coordinates.halves;
        let second = if has_velocities { &velocities } else { momenta };
        let all = positions
            .iter()
            .chain(second)
            .chain(&coordinates.parameters);
        Columns {
            names: all.cloned().collect(),
            has_velocities,
        }
    }

    /// The coordinates, as many as a table has if the formula does not say it.
    fn coordinates(&self, names: &[&str]) -> Result<Coordinates, Error> {
        let components = self.system.layout.components();
        let listed = names.iter().filter(|name| name.starts_with("q[")).count();
        let bodies = self.bodies(Some(listed / components.max(1)))?;
        let mut parameters: Vec<String> = Vec::new();
        for Parameter { name, shape } in &self.system.parameters {
            let is_column = names.contains(&name.as_str());
            if is_column && matches!(shape, Shape::Number(_)) {
                if let Some(value) = self.setup.parameters.get(name) {
                    let message = format!(
                        "`{name}` is also a column of the file with the starts: leave out one of the two"
                    );
                    return Err(self.file.error(value.span(), message));
                }
                parameters.push(name.clone());
            }
        }
        Ok(Coordinates::new(self.system, bodies, parameters))
    }
}

fn refused(path: &Path, message: impl Display) -> Error {
    let message = format!("{}: {message}", path.display());
    ErrorKind::Document { message }.into()
}

/// The place of each of the named columns.
fn places(columns: &Columns, names: &[&str]) -> Result<Vec<usize>, String> {
    let known = columns.names.iter().enumerate();
    let mut left: HashMap<&str, usize> = known.map(|(k, name)| (name.as_str(), k)).collect();
    let mut places = Vec::new();
    for name in names {
        let place = left.remove(name).ok_or_else(|| {
            format!(
                "the column `{name}` is neither a coordinate nor a parameter that is a number, or it occurs twice; the coordinates are {}",
                listed(&columns.names)
            )
        })?;
        places.push(place);
    }
    match columns
        .names
        .iter()
        .find(|name| left.contains_key(name.as_str()))
    {
        Some(name) => Err(format!("the column `{name}` is missing")),
        None => Ok(places),
    }
}

/// A row by the places of its columns; a cell is its text and its value.
fn row(
    number: usize,
    places: &[usize],
    names: &[&str],
    cells: impl Iterator<Item = (String, Option<f64>)>,
) -> Result<Vec<f64>, String> {
    let mut row = vec![0.0; places.len()];
    for ((place, (text, value)), name) in places.iter().zip(cells).zip(names) {
        row[*place] = value.filter(|value| value.is_finite()).ok_or_else(|| {
            format!("start {number}, column `{name}`: expected a finite number, found `{text}`")
        })?;
    }
    Ok(row)
}

fn too_many() -> String {
    format!("more than {MAX_COUNT} starts: split the file into several files")
}

/// The number in a cell of a Parquet file; integers only if they are exact in double precision.
fn double(field: &Field) -> Option<f64> {
    match *field {
        Field::Double(value) => Some(value),
        Field::Float(value) => Some(value.into()),
        Field::Float16(value) => Some(value.into()),
        Field::Byte(value) => Some(value.into()),
        Field::Short(value) => Some(value.into()),
        Field::Int(value) => Some(value.into()),
        Field::UByte(value) => Some(value.into()),
        Field::UShort(value) => Some(value.into()),
        Field::UInt(value) => Some(value.into()),
        Field::Long(value) if value.unsigned_abs() <= 1 << 53 => Some(value as f64),
        Field::ULong(value) if value <= 1 << 53 => Some(value as f64),
        // Rounded, as in a CSV file.
        Field::Decimal(_) => field.to_string().parse().ok(),
        _ => None,
    }
}
