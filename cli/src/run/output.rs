//! What a run writes: arrays for NumPy, `.npz`, or a table, `.parquet` or `.csv`.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use rayon::iter::{IndexedParallelIterator, IntoParallelRefIterator, ParallelIterator};
use symplectic::State;
use symplectic::ensemble::{Npz, Row};
use symplectic::nalgebra::DVector;
use symplectic_compiler::{Error, ErrorKind};

use super::starts::Coordinates;
use super::system::Tapes;
use super::tape::{At, Parameters};

/// A trajectory with its states at the output times: for each of them the time, the positions and the momenta, without an
/// allocation of their own.
pub(super) type Trajectory = Row<DVector<f64>, Vec<f64>>;

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
pub(super) struct Results<'a> {
    pub(super) coordinates: &'a Coordinates,
    pub(super) facts: Facts<'a>,
    pub(super) tapes: &'a Tapes,
    pub(super) rows: &'a [Trajectory],
    /// The start of each trajectory.
    pub(super) starts: &'a [State<DVector<f64>>],
    /// The values of the parameters that vary, for each trajectory of the whole run.
    pub(super) parameters: &'a [Vec<f64>],
    /// The output times; `None` for the end only.
    pub(super) times: Option<&'a [f64]>,
}

/// An output file that is complete or absent: it is written under a temporary name in the same folder and then renamed.
pub(super) struct Target {
    path: PathBuf,
    part: PathBuf,
    file: File,
    format: Format,
    /// Whether the temporary file remains where it is not renamed, because it contains results.
    is_kept: bool,
}

/// The formats of files.
#[derive(Clone, Copy, PartialEq)]
enum Format {
    Npz,
    Parquet,
    Csv,
}

impl Target {
    /// Opens the file before the run, so that an unwritable output is detected before anything is computed.
    pub(super) fn open(path: PathBuf) -> Result<Self, Error> {
        let extension = path.extension().and_then(|extension| extension.to_str());
        let format = match extension {
            Some("csv") => Format::Csv,
            Some("npz") => Format::Npz,
            Some("parquet") => Format::Parquet,
            _ => {
                let message = format!(
                    "the name of the output `{}` must end in .npz, .parquet or .csv",
                    path.display()
                );
                return Err(ErrorKind::Document { message }.into());
            }
        };
        let name = path.file_name().unwrap_or_default();
        let ends_in_name = (path.as_os_str().as_encoded_bytes()).ends_with(name.as_encoded_bytes());
        if path.is_dir() || !ends_in_name {
            let message = format!(
                "the output `{}` names a folder; nothing was computed",
                path.display()
            );
            return Err(ErrorKind::Document { message }.into());
        }
        let mut name = name.to_owned();
        name.push(format!(".{}.part", std::process::id()));
        let part = path.with_file_name(name);
        let file = File::create(&part).map_err(|error| {
            let message = format!(
                "cannot write `{}`: {error}; nothing was computed",
                part.display()
            );
            Error::from(ErrorKind::Document { message })
        })?;
        Ok(Target {
            path,
            part,
            file,
            format,
            is_kept: false,
        })
    }

    /// The path of the output.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the results and renames the file.
    pub(super) fn write(self, results: &Results<'_>) -> Result<(), Error> {
        let format = self.format;
        self.fill(|out| match format {
            Format::Csv => results.write_csv(out),
            Format::Npz => results.write_npz(out),
            Format::Parquet => results.write_parquet(out),
        })
    }

    /// Writes the file by `write` and renames it. What can be read of a file that is not complete is kept.
    fn fill(
        mut self,
        write: impl FnOnce(&mut BufWriter<Lines<'_>>) -> io::Result<()>,
    ) -> Result<(), Error> {
        let (path, part) = (self.path.display(), self.part.display());
        let mut out = BufWriter::new(Lines::new(&self.file));
        let written = write(&mut out).and_then(|()| out.flush());
        let lines = out.get_ref();
        let rows = lines.count.saturating_sub(1);
        let message = match written {
            Ok(()) => {
                let renamed = self
                    .file
                    .sync_all()
                    .and_then(|()| fs::rename(&self.part, &self.path));
                self.is_kept = true;
                let Err(error) = renamed else {
                    return Ok(());
                };
                format!("cannot complete `{path}`: {error}; the results are in `{part}`: rename it")
            }
            Err(error) if self.format == Format::Csv && rows > 0 => {
                // If this fails, an incomplete row remains at the end.
                let _ = self.file.set_len(lines.whole);
                self.is_kept = true;
                format!("cannot write `{path}`: {error}; the first {rows} rows are in `{part}`")
            }
            Err(error) => format!(
                "cannot write `{path}`: {error}; the results of this run are lost: make room and run parts with `--shard`"
            ),
        };
        let message = format!("{message}; an existing file `{path}` is unchanged");
        Err(ErrorKind::Document { message }.into())
    }
}

/// A file that takes nothing after an error, so that what is left in buffers does not follow a gap. It counts lines.
struct Lines<'a> {
    file: &'a File,
    is_open: bool,
    length: u64,
    /// The length of the complete lines.
    whole: u64,
    count: usize,
}

impl<'a> Lines<'a> {
    fn new(file: &'a File) -> Self {
        Lines {
            file,
            is_open: true,
            length: 0,
            whole: 0,
            count: 0,
        }
    }
}

impl Write for Lines<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if !self.is_open {
            return Err(io::ErrorKind::BrokenPipe.into());
        }
        let written = self.file.write(bytes);
        match &written {
            Ok(count) => {
                let mut ends = bytes[..*count]
                    .iter()
                    .enumerate()
                    .filter(|(_, byte)| **byte == b'\n');
                self.count += ends.clone().count();
                if let Some((last, _)) = ends.next_back() {
                    self.whole = self.length + last as u64 + 1;
                }
                self.length += *count as u64;
            }
            Err(error) => self.is_open = error.kind() == io::ErrorKind::Interrupted,
        }
        written
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Drop for Target {
    fn drop(&mut self) {
        // The temporary file still exists if the run or the writing failed.
        if !self.is_kept {
            let _ = fs::remove_file(&self.part);
        }
    }
}

impl Results<'_> {
    /// `(H − H₀)/|H₀|`, or `H − H₀` if the energy at the start is zero.
    pub(super) fn energy_errors(&self) -> Vec<Vec<f64>> {
        let pairs = self.rows.par_iter().zip(self.starts);
        let errors = pairs.map(|(row, start)| {
            let parameters = Parameters::Own(self.parameters(row).into());
            let energy_at = |Point {
                                 time,
                                 halves: [q, p],
                             }: Point<'_>| {
                let parameters = &parameters;
                let at = At {
                    parameters,
                    time,
                    q,
                    p,
                };
                self.tapes.energy_at(at)
            };
            let first = energy_at(start.into());
            let scale = if first == 0.0 { 1.0 } else { first.abs() };
            let error = |energy: f64| (energy - first) / scale;
            match self.times {
                None => vec![error(energy_at((&row.state).into()))],
                Some(_) => points(row).map(|seen| error(energy_at(seen))).collect(),
            }
        });
        errors.collect()
    }

    /// The values of the parameters that vary.
    pub(super) fn parameters(&self, row: &Trajectory) -> &[f64] {
        self.parameters
            .get(row.trajectory)
            .map_or(&[], Vec::as_slice)
    }

    fn write_npz(&self, out: &mut impl Write) -> io::Result<()> {
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
        file.rows(self.rows)?;
        let Some(times) = self.times else {
            file.doubles("energy_error", &[count], &errors.concat())?;
            return file.finish().map(|_| ());
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
        file.finish().map(|_| ())
    }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::io::{self, Write};

    use super::Target;

    /// A folder appears under the name of the output during the run: the results remain under the temporary name.
    #[test]
    fn results_remain_if_the_file_cannot_be_renamed() {
        let name = format!("symplectic-target-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        fs::create_dir_all(&folder).expect("a folder");
        let path = folder.join("out.npz");
        let target = Target::open(path.clone()).expect("a file");
        let part = target.part.clone();
        fs::create_dir(&path).expect("a folder");
        let error = target
            .fill(|out| out.write_all(b"all"))
            .expect_err("a folder");
        assert_eq!(fs::read(&part).expect("the part"), b"all");
        let told = format!("the results are in `{}`", part.display());
        assert!(error.to_string().contains(&told), "{error}");
        fs::remove_dir_all(&folder).expect("a folder");
    }

    /// What a buffer holds at an error is not written after it, and a row that is not complete is removed.
    #[test]
    fn complete_rows_remain_if_writing_fails() {
        let name = format!("symplectic-rows-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        fs::create_dir_all(&folder).expect("a folder");
        for (text, kept) in [("x\n1\n2\n3", Some("x\n1\n2\n")), ("x\n1", None)] {
            let target = Target::open(folder.join("out.csv")).expect("a file");
            let part = target.part.clone();
            let error = target.fill(|out| {
                out.write_all(text.as_bytes())?;
                out.flush()?;
                Err(io::ErrorKind::StorageFull.into())
            });
            let error = error.expect_err("no room").to_string();
            assert_eq!(fs::read_to_string(&part).ok().as_deref(), kept);
            assert_eq!(error.contains("the first 2 rows are in"), kept.is_some());
            assert_eq!(error.contains("are lost"), kept.is_none());
        }
        fs::remove_dir_all(&folder).expect("a folder");
    }
}
