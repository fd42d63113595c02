//! The file from which an interrupted run continues: the trajectories that are finished.
//!
//! It has a line of text, a line of JSON with the origin of the run, and a record for each trajectory, in order. A record is its
//! length, a checksum, and numbers of eight bytes, little-endian. A record that is incomplete ends the file.

use std::fs::{self, File, TryLockError};
use std::io::{self, BufRead, BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};
use symplectic::nalgebra::DVector;
use symplectic::{State, Statistics};
use symplectic_compiler::{Error, ErrorKind};

use crate::counted;
use crate::trajectory::{Failure, Trajectory};

/// The first line. A later format has another number.
const FORMAT: &str = "symplectic run: finished trajectories, format 1";

/// What a run must have in common with an interrupted one to continue it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Origin {
    pub(super) version: String,
    pub(super) formula: String,
    /// The definition of the method, which may be in a file.
    pub(super) method: String,
    /// The whole run file.
    pub(super) setup: String,
    /// The part of the run, as in `--shard`.
    pub(super) part: Option<[usize; 2]>,
    /// A checksum of the starts and of the parameters, which may be in a file.
    pub(super) starts: u64,
}

impl Origin {
    /// What differs from this run in the origin of an interrupted one.
    fn difference(&self, other: &Self) -> Option<String> {
        let part = |part: Option<[usize; 2]>| match part {
            Some([part, count]) => format!("the part {part}/{count}"),
            None => "the whole run".to_owned(),
        };
        Some(match () {
            () if self.version != other.version => format!(
                "was written by version {} of `symplectic`, and this is version {}",
                other.version, self.version
            ),
            () if self.formula != other.formula => {
                "belongs to another system: its formula differs".to_owned()
            }
            () if self.setup != other.setup => {
                "belongs to another run file, or the run file has changed".to_owned()
            }
            () if self.part != other.part => format!(
                "belongs to {}, and this is {}",
                part(other.part),
                part(self.part)
            ),
            () if self.method != other.method => {
                "belongs to another method: its file has changed".to_owned()
            }
            () if self.starts != other.starts => {
                "belongs to other starts: their file has changed".to_owned()
            }
            () => return None,
        })
    }
}

/// The finished trajectories of a run, which are saved from time to time.
#[derive(Debug)]
pub(super) struct Resume {
    path: PathBuf,
    origin: Origin,
    /// `None` before the first trajectory is saved.
    file: Option<File>,
    /// Number of trajectories in the file.
    saved: usize,
    /// The length of the file with these.
    length: u64,
    interval: Duration,
    last: Instant,
    fault: Option<io::Error>,
}

impl Resume {
    /// Opens the file of a run with this output, if it exists, and reads the trajectories in it. Only if `continues` they may be used.
    pub(super) fn open(
        output: &Path,
        origin: Origin,
        interval: Duration,
        continues: bool,
    ) -> Result<(Self, Vec<Trajectory>), Error> {
        let mut name = output.file_name().unwrap_or_default().to_owned();
        name.push(".resume");
        let mut resume = Resume {
            path: output.with_file_name(name),
            origin,
            file: None,
            saved: 0,
            length: 0,
            interval,
            last: Instant::now(),
            fault: None,
        };
        let opened = File::options().read(true).write(true).open(&resume.path);
        let rows = match opened {
            Ok(file) => resume.read(file, continues)?,
            Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
            Err(error) => return Err(resume.refused(format!("cannot be read: {error}"))),
        };
        Ok((resume, rows))
    }

    fn read(&mut self, file: File, continues: bool) -> Result<Vec<Trajectory>, Error> {
        // A file system without locks has none.
        if let Err(TryLockError::WouldBlock) = file.try_lock() {
            return Err(self.refused("is being written by another run".to_owned()));
        }
        let unread = |error: io::Error| self.refused(format!("cannot be read: {error}"));
        let mut reader = BufReader::new(&file);
        let mut lines = [Vec::new(), Vec::new()];
        for line in &mut lines {
            // Not more than a run file may have.
            let mut limited = (&mut reader).take(1 << 28);
            limited.read_until(b'\n', line).map_err(unread)?;
        }
        let mut length = lines.iter().map(Vec::len).sum::<usize>() as u64;
        let [format, origin] = lines.map(|line| String::from_utf8_lossy(&line).into_owned());
        let own = format!("{FORMAT}\n");
        if !origin.ends_with('\n') && own.starts_with(&format) {
            // Killed while it wrote the first lines.
            return self.begin(file);
        }
        if format != own {
            let message = "was written by another version of `symplectic`, or is no file of finished trajectories".to_owned();
            return Err(self.refused(message));
        }
        let found: Origin =
            serde_json::from_str(&origin).map_err(|_| self.refused("is damaged".to_owned()))?;
        let mut rows = Vec::new();
        while let Some((row, bytes)) = record(&mut reader).map_err(unread)? {
            length += bytes;
            rows.push(row);
        }
        if rows.is_empty() {
            return self.begin(file);
        }
        if !continues {
            let message = format!(
                "has {} of an interrupted run: continue it with `--resume`, or delete the file",
                counted(rows.len(), "finished trajectory", "finished trajectories")
            );
            return Err(self.refused(message));
        }
        if let Some(difference) = self.origin.difference(&found) {
            let message = format!("{difference}: continue that run, or delete the file");
            return Err(self.refused(message));
        }
        (self.file, self.saved, self.length) = (Some(file), rows.len(), length);
        Ok(rows)
    }

    /// Begins a file in the place of one without trajectories.
    fn begin(&mut self, mut file: File) -> Result<Vec<Trajectory>, Error> {
        self.length = file
            .set_len(0)
            .and_then(|()| file.rewind())
            .and_then(|()| self.write_origin(&mut file))
            .map_err(|error| self.refused(format!("cannot be written: {error}")))?;
        self.file = Some(file);
        Ok(Vec::new())
    }

    /// Writes the first lines; returns their length.
    fn write_origin(&self, file: &mut File) -> io::Result<u64> {
        let origin = serde_json::to_string(&self.origin)?;
        let lines = format!("{FORMAT}\n{origin}\n");
        file.write_all(lines.as_bytes())?;
        Ok(lines.len() as u64)
    }

    fn refused(&self, what: String) -> Error {
        let message = format!("`{}` {what}; nothing was computed", self.path.display());
        ErrorKind::Document { message }.into()
    }

    /// Saves the new ones of all trajectories, if the last time is longer ago than the interval. After an error nothing more is saved.
    pub(super) fn save(&mut self, rows: &[Trajectory]) {
        if self.fault.is_some() || self.last.elapsed() < self.interval {
            return;
        }
        self.fault = self.append(rows).err();
        self.last = Instant::now();
    }

    fn append(&mut self, rows: &[Trajectory]) -> io::Result<()> {
        if self.file.is_none() {
            let mut options = File::options();
            let mut file = options.write(true).create_new(true).open(&self.path)?;
            let _ = file.try_lock();
            self.length = self.write_origin(&mut file)?;
            self.file = Some(file);
        }
        let Some(mut file) = self.file.as_ref() else {
            return Ok(());
        };
        // Over what an error may have left.
        file.set_len(self.length)?;
        file.seek(SeekFrom::Start(self.length))?;
        let mut out = BufWriter::new(file);
        for row in &rows[self.saved..] {
            let bytes = encoded(row);
            out.write_all(&(bytes.len() as u64).to_le_bytes())?;
            out.write_all(&checksum(bytes.iter().copied()).to_le_bytes())?;
            out.write_all(&bytes)?;
        }
        out.flush()?;
        drop(out);
        file.sync_data()?;
        self.length = file.stream_position()?;
        self.saved = rows.len();
        Ok(())
    }

    /// What to do if the results cannot be written: they are in the file, if there is one.
    pub(super) fn advice(&mut self, rows: &[Trajectory]) -> Option<String> {
        self.file.as_ref()?;
        self.append(rows).ok()?;
        Some(format!(
            "all trajectories are in `{}`: make room and run again with `--resume`",
            self.path.display()
        ))
    }

    /// Why trajectories could not be saved.
    pub(super) fn fault(&self) -> Option<String> {
        let fault = self.fault.as_ref()?;
        Some(format!(
            "finished trajectories were not saved in `{}`: {fault}",
            self.path.display()
        ))
    }

    /// Removes the file, which is not needed any more.
    pub(super) fn remove(self) {
        if self.file.is_some() {
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// FNV-1a.
pub(super) fn checksum(bytes: impl IntoIterator<Item = u8>) -> u64 {
    let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.into_iter().fold(0xcbf2_9ce4_8422_2325, step)
}

fn encoded(row: &Trajectory) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut word = |word: u64| bytes.extend(word.to_le_bytes());
    let statistics = &row.statistics;
    for number in [
        row.number as u64,
        statistics.steps,
        statistics.rejected,
        statistics.iterations,
        statistics.most_iterations.into(),
        statistics.evaluations,
        statistics.factorisations,
        statistics.largest_residual.to_bits(),
        row.state.time.to_bits(),
    ] {
        word(number);
    }
    let (q, p) = row.state.as_slices();
    for list in [q, p, &row.output] {
        word(list.len() as u64);
        list.iter().for_each(|x| word(x.to_bits()));
    }
    let failure = row.failure.iter();
    let texts = failure.flat_map(|failure| [&failure.kind, &failure.message]);
    for text in texts {
        bytes.extend((text.len() as u64).to_le_bytes());
        bytes.extend(text.as_bytes());
    }
    bytes
}

/// The next trajectory of a file, with the length of its record; `None` at the end, or if the record is incomplete.
fn record(file: &mut impl Read) -> io::Result<Option<(Trajectory, u64)>> {
    let mut head = [0; 16];
    if !fill(file, &mut head)? {
        return Ok(None);
    }
    let mut head = Words(&head);
    let (Some(length), Some(sum)) = (head.word(), head.word()) else {
        return Ok(None);
    };
    let mut bytes = Vec::new();
    file.take(length).read_to_end(&mut bytes)?;
    if bytes.len() as u64 != length || checksum(bytes.iter().copied()) != sum {
        return Ok(None);
    }
    Ok(decoded(Words(&bytes)).map(|row| (row, 16 + length)))
}

/// Reads all bytes; false if the file ends before.
fn fill(file: &mut impl Read, bytes: &mut [u8]) -> io::Result<bool> {
    match file.read_exact(bytes) {
        Ok(()) => Ok(true),
        Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => Ok(false),
        Err(error) => Err(error),
    }
}

fn decoded(mut words: Words<'_>) -> Option<Trajectory> {
    let number = usize::try_from(words.word()?).ok()?;
    let statistics = Statistics {
        steps: words.word()?,
        rejected: words.word()?,
        iterations: words.word()?,
        most_iterations: u32::try_from(words.word()?).ok()?,
        evaluations: words.word()?,
        factorisations: words.word()?,
        largest_residual: words.double()?,
    };
    let time = words.double()?;
    let [q, p, output] = [words.list()?, words.list()?, words.list()?];
    let failure = match words.0.is_empty() {
        true => None,
        false => Some(Failure {
            kind: words.text()?,
            message: words.text()?,
        }),
    };
    Some(Trajectory {
        number,
        failure,
        state: State::new(time, DVector::from_vec(q), DVector::from_vec(p)),
        statistics,
        output,
    })
}

/// The rest of a record.
struct Words<'a>(&'a [u8]);

impl Words<'_> {
    fn word(&mut self) -> Option<u64> {
        let (word, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(u64::from_le_bytes(*word))
    }

    fn double(&mut self) -> Option<f64> {
        self.word().map(f64::from_bits)
    }

    fn list(&mut self) -> Option<Vec<f64>> {
        let count = self.word()?;
        (0..count).map(|_| self.double()).collect()
    }

    fn text(&mut self) -> Option<String> {
        let length = usize::try_from(self.word()?).ok()?;
        let (text, rest) = self.0.split_at_checked(length)?;
        self.0 = rest;
        String::from_utf8(text.to_vec()).ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file that ends anywhere has all of the records before.
    #[test]
    fn a_file_cut_at_any_byte_has_its_complete_records() {
        let row = |number: usize| Trajectory {
            number,
            failure: (number == 1).then(|| Failure {
                kind: "not finite".to_owned(),
                message: "the force at time 1 is not finite – ∞".to_owned(),
            }),
            state: State::new(
                f64::MIN_POSITIVE,
                vec![-0.0, 0.1].into(),
                vec![f64::NAN, 3.0].into(),
            ),
            statistics: Statistics {
                steps: 1 << 60,
                most_iterations: 7,
                largest_residual: 1e-300,
                ..Statistics::default()
            },
            output: vec![1.5; number],
        };
        let rows: Vec<Trajectory> = (0..3).map(row).collect();
        let (mut bytes, mut ends) = (Vec::new(), Vec::new());
        for row in &rows {
            let own = encoded(row);
            bytes.extend((own.len() as u64).to_le_bytes());
            bytes.extend(checksum(own.iter().copied()).to_le_bytes());
            bytes.extend(own);
            ends.push(bytes.len());
        }
        for end in 0..=bytes.len() {
            let mut file = &bytes[..end];
            let mut found = Vec::new();
            while let Some((row, _)) = record(&mut file).expect("bytes") {
                found.push(row);
            }
            let complete = ends.iter().filter(|complete| **complete <= end).count();
            // Debug, because NaN differs from itself.
            assert_eq!(format!("{found:?}"), format!("{:?}", &rows[..complete]));
        }
        // A changed byte is noticed.
        bytes[40] ^= 1;
        assert!(record(&mut &bytes[..]).expect("bytes").is_none());
    }
}
