//! Files of Apache Parquet.

use alloc::boxed::Box;
use alloc::format;
use alloc::string::{String, ToString};
use alloc::sync::Arc;
use alloc::vec::Vec;
use core::fmt::{self, Display};
use std::io::{self, Error, ErrorKind, Write};

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{Type, TypePtr};

use crate::{Ensemble, Row};
use symplectic_core::solver::Solver;
use symplectic_core::{Method, Summation, System, Vector};

/// The values of a column, one for each row of a group.
#[derive(Clone, Debug, PartialEq)]
pub enum ParquetColumn {
    /// Doubles.
    Doubles(Vec<f64>),
    /// Unsigned integers.
    Integers(Vec<u64>),
    /// Strings, or null.
    Texts(Vec<Option<String>>),
}

impl ParquetColumn {
    fn len(&self) -> usize {
        match self {
            Self::Doubles(values) => values.len(),
            Self::Integers(values) => values.len(),
            Self::Texts(values) => values.len(),
        }
    }

    /// The type of a column of this name.
    fn field(&self, name: &str) -> Result<TypePtr, ParquetError> {
        let (physical, repetition, logical) = match self {
            Self::Doubles(_) => (Physical::DOUBLE, Repetition::REQUIRED, None),
            Self::Integers(_) => {
                let unsigned = LogicalType::integer(64, false);
                (Physical::INT64, Repetition::REQUIRED, Some(unsigned))
            }
            Self::Texts(_) => (
                Physical::BYTE_ARRAY,
                Repetition::OPTIONAL,
                Some(LogicalType::String),
            ),
        };
        Type::primitive_type_builder(name, physical)
            .with_repetition(repetition)
            .with_logical_type(logical)
            .build()
            .map(Arc::new)
    }
}

/// Writes a file of Apache Parquet, a table for DuckDB, Polars, pandas, R and Spark; these can read several files as one.
///
/// Each group of rows is written immediately: a run of any length needs the memory of one group. The first group determines the columns
/// of the file. A file that was not [finished](Self::finish) cannot be read.
///
/// ```
/// use core::ops::ControlFlow;
/// use symplectic::State;
/// use symplectic::ensemble::{Ensemble, Parquet};
///
/// symplectic::tableau! { VelocityVerlet { base: velocity-verlet } }
/// symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let starts = (0..1000).map(|k| State::from_arrays(0.0, [0.003 * f64::from(k)], [0.0])).collect();
/// let ensemble = Ensemble::new(VelocityVerlet, Pendulum, starts, 0.01)?;
/// let mut file = Parquet::new(Vec::new()); // or `File::create("pendulums.parquet")?`
/// file.facts(&ensemble);
/// file.note("system", "H = pa^2/2 - cos(a)");
/// let (mut rows, mut written) = (Vec::new(), Ok(()));
/// ensemble.integrate_to(10.0, |row| {
///     rows.push(row);
///     if rows.len() == 256 {
///         written = file.rows(&rows);
///         rows.clear();
///     }
///     if written.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
/// });
/// written?;
/// file.rows(&rows)?;
/// let bytes = file.finish()?;
/// assert!(bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"));
/// # Ok(())
/// # }
/// ```
pub struct Parquet<W: Write + Send> {
    file: Stage<W>,
    notes: Vec<KeyValue>,
}

/// The progress of a file.
enum Stage<W: Write + Send> {
    Empty(W),
    Open {
        schema: TypePtr,
        writer: Box<SerializedFileWriter<W>>,
    },
    /// A group was written incompletely.
    Broken,
}

impl<W: Write + Send> fmt::Debug for Parquet<W> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Parquet").finish_non_exhaustive()
    }
}

impl<W: Write + Send> Parquet<W> {
    /// A file without rows.
    pub const fn new(out: W) -> Self {
        Self {
            file: Stage::Empty(out),
            notes: Vec::new(),
        }
    }

    /// Adds a string to the metadata of the file.
    pub fn note(&mut self, name: &str, text: &str) {
        let note = KeyValue::new(name.to_string(), text.to_string());
        self.notes.push(note);
    }

    /// Writes the metadata of an ensemble: `method`, `definition`, `orders` (general, separable, with quadratic kinetic energy),
    /// `step_size`, `sums`, `solver`, `tolerance` and the `version` of this library. For a tableau at run time `definition` is
    /// `at run time`.
    pub fn facts<M, S, V, R, N, L>(&mut self, ensemble: &Ensemble<M, S, V, R, N, L>)
    where
        M: Method,
        S: System<V>,
        V: Vector,
        R: Summation,
        N: Solver<V, S>,
    {
        let facts = ensemble.method_facts();
        self.note("method", facts.method);
        self.note("definition", facts.definition);
        self.note("orders", &format!("{:?}", facts.orders));
        self.note("step_size", &format!("{:?}", facts.step_size));
        self.note("sums", facts.sums);
        self.note("solver", &facts.solver);
        self.note("tolerance", &format!("{:?}", facts.tolerance));
        self.note("version", env!("CARGO_PKG_VERSION"));
    }

    /// Writes a group of rows, given by columns.
    ///
    /// # Errors
    ///
    /// [`ErrorKind::InvalidInput`] if there is no column, if columns have different lengths or the same name, or if the first group had
    /// other columns; nothing is written then. I/O errors of the output, after which the file accepts no more groups.
    pub fn group(&mut self, columns: &[(&str, ParquetColumn)]) -> io::Result<()> {
        let Some(((_, first), rest)) = columns.split_first() else {
            return Err(invalid("a group without columns".to_string()));
        };
        if let Some((name, column)) = rest.iter().find(|(_, other)| other.len() != first.len()) {
            return Err(invalid(format!(
                "the column `{name}` has {} values, and the first one has {}",
                column.len(),
                first.len()
            )));
        }
        for (k, (name, _)) in columns.iter().enumerate() {
            if columns[..k].iter().any(|(other, _)| other == name) {
                return Err(invalid(format!("two columns have the name `{name}`")));
            }
        }
        let fields = columns.iter().map(|(name, column)| column.field(name));
        let fields = fields.collect::<Result<Vec<_>, _>>();
        let schema = fields.and_then(|fields| {
            let schema = Type::group_type_builder("rows").with_fields(fields);
            schema.build().map(Arc::new)
        });
        let schema = schema.map_err(|error| invalid(error.to_string()))?;
        if let Stage::Open { schema: own, .. } = &self.file
            && *own != schema
        {
            return Err(invalid(
                "the columns are not those of the first group".to_string(),
            ));
        }
        let mut writer = match core::mem::replace(&mut self.file, Stage::Broken) {
            Stage::Broken => return Err(broken()),
            Stage::Open { writer, .. } => writer,
            Stage::Empty(out) => {
                let properties = Arc::new(WriterProperties::builder().build());
                let writer = SerializedFileWriter::new(out, schema.clone(), properties);
                Box::new(writer.map_err(of_output)?)
            }
        };
        if first.len() != 0 {
            write(&mut writer, columns).map_err(of_output)?;
        }
        self.file = Stage::Open { schema, writer };
        Ok(())
    }

    /// Writes a group of rows of an ensemble: `trajectory`, `time`, `q[0]`, …, `p[0]`, …, `steps`, and `error` or null.
    ///
    /// # Errors
    ///
    /// As for [`group`](Self::group); without rows nothing is written.
    pub fn rows<V: Vector<Scalar = f64>, A, E: Display>(
        &mut self,
        rows: &[Row<V, A, E>],
    ) -> io::Result<()> {
        let Some(first) = rows.first() else {
            return Ok(());
        };
        let dimension = first.state.q.dimension();
        let other = rows
            .iter()
            .find(|row| [&row.state.q, &row.state.p].map(V::dimension) != [dimension; 2]);
        if let Some(row) = other {
            return Err(invalid(format!(
                "trajectory {} has another dimension than the first row, {dimension}: write them to files of their own",
                row.trajectory
            )));
        }
        let integers =
            |of: fn(&Row<V, A, E>) -> u64| ParquetColumn::Integers(rows.iter().map(of).collect());
        let component = |of: fn(&Row<V, A, E>) -> &V, k| {
            let values = rows.iter().map(|row| of(row).as_slice()[k]);
            ParquetColumn::Doubles(values.collect())
        };
        let times = rows.iter().map(|row| row.state.time).collect();
        let errors = rows
            .iter()
            .map(|row| row.outcome.as_ref().err().map(ToString::to_string));
        let names = |half: &str| -> Vec<String> {
            (0..dimension).map(|k| format!("{half}[{k}]")).collect()
        };
        let (positions, momenta) = (names("q"), names("p"));
        let mut columns = Vec::with_capacity(2 * dimension + 4);
        columns.push(("trajectory", integers(|row| row.trajectory as u64)));
        columns.push(("time", ParquetColumn::Doubles(times)));
        for (k, name) in positions.iter().enumerate() {
            columns.push((name, component(|row| &row.state.q, k)));
        }
        for (k, name) in momenta.iter().enumerate() {
            columns.push((name, component(|row| &row.state.p, k)));
        }
        columns.push(("steps", integers(|row| row.statistics.steps)));
        columns.push(("error", ParquetColumn::Texts(errors.collect())));
        self.group(&columns)
    }

    /// Writes the metadata, flushes, and returns the output.
    ///
    /// # Errors
    ///
    /// I/O errors of the output; [`ErrorKind::InvalidInput`] if no group was written, or a group was written incompletely.
    pub fn finish(self) -> io::Result<W> {
        match self.file {
            Stage::Broken => Err(broken()),
            Stage::Empty(_) => Err(invalid(
                "no group of rows was written: a file needs the columns of one".to_string(),
            )),
            Stage::Open { mut writer, .. } => {
                for note in self.notes {
                    writer.append_key_value_metadata(note);
                }
                let mut out = writer.into_inner().map_err(of_output)?;
                out.flush()?;
                Ok(out)
            }
        }
    }
}

fn write<W: Write + Send>(
    writer: &mut SerializedFileWriter<W>,
    columns: &[(&str, ParquetColumn)],
) -> Result<(), ParquetError> {
    let mut group = writer.next_row_group()?;
    for (_, column) in columns {
        let Some(mut open) = group.next_column()? else {
            break;
        };
        match column {
            ParquetColumn::Doubles(values) => {
                open.typed::<DoubleType>().write_batch(values, None, None)?;
            }
            ParquetColumn::Integers(values) => {
                // Unsigned integers are stored as signed integers with the same bits.
                let bits: Vec<i64> = values.iter().map(|value| value.cast_signed()).collect();
                open.typed::<Int64Type>().write_batch(&bits, None, None)?;
            }
            ParquetColumn::Texts(values) => {
                let present: Vec<i16> = values.iter().map(|value| value.is_some().into()).collect();
                let texts = values.iter().flatten();
                let texts: Vec<ByteArray> = texts.map(|text| text.as_str().into()).collect();
                open.typed::<ByteArrayType>()
                    .write_batch(&texts, Some(&present), None)?;
            }
        }
        open.close()?;
    }
    group.close()?;
    Ok(())
}

fn invalid(message: String) -> Error {
    Error::new(ErrorKind::InvalidInput, message)
}

fn broken() -> Error {
    invalid("a group was written in part: begin a new file".to_string())
}

/// The I/O error of the output, if there was one.
fn of_output(error: ParquetError) -> Error {
    match error {
        ParquetError::External(error) => match error.downcast::<Error>() {
            Ok(error) => *error,
            Err(error) => Error::other(error),
        },
        error => Error::other(error),
    }
}
