//! The file of the output: complete, or what could be written of it.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use symplectic_compiler::{Error, ErrorKind};

use crate::output::Results;

/// An output file that is complete or absent: it is written under a temporary name in the same folder and then renamed.
pub(super) struct Target {
    path: PathBuf,
    part: PathBuf,
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
        // It would remain, empty, if the run is killed.
        let tried = File::create(&part).and_then(|_| fs::remove_file(&part));
        tried.map_err(|error| {
            let message = format!(
                "cannot write `{}`: {error}; nothing was computed",
                part.display()
            );
            Error::from(ErrorKind::Document { message })
        })?;
        Ok(Target {
            path,
            part,
            format,
            is_kept: false,
        })
    }

    /// The path of the output.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the results and renames the file. `advice` says where the results are if they cannot be written.
    pub(super) fn write(
        self,
        results: &Results<'_>,
        advice: impl FnOnce() -> Option<String>,
    ) -> Result<(), Error> {
        let format = self.format;
        let write = |out: &mut BufWriter<Lines<'_>>| match format {
            Format::Csv => results.write_csv(out),
            Format::Npz => results.write_npz(out),
            Format::Parquet => results.write_parquet(out),
        };
        self.fill(write, advice)
    }

    /// Writes the file by `write` and renames it. What can be read of a file that is not complete is kept.
    fn fill(
        mut self,
        write: impl FnOnce(&mut BufWriter<Lines<'_>>) -> io::Result<()>,
        advice: impl FnOnce() -> Option<String>,
    ) -> Result<(), Error> {
        let (path, part) = (self.path.display(), self.part.display());
        let lost = |error: io::Error, advice: Option<String>| {
            let advice = advice.unwrap_or_else(|| {
                "the results of this run are lost: make room and run parts with `--shard`"
                    .to_owned()
            });
            let message = format!(
                "cannot write `{path}`: {error}; {advice}; an existing file `{path}` is unchanged"
            );
            Error::from(ErrorKind::Document { message })
        };
        let file = match File::create(&self.part) {
            Ok(file) => file,
            Err(error) => return Err(lost(error, advice())),
        };
        let mut out = BufWriter::new(Lines::new(&file));
        let written = write(&mut out).and_then(|()| out.flush());
        // Without what is still in the buffer.
        let (lines, _) = out.into_parts();
        let rows = lines.count.saturating_sub(1);
        let message = match written {
            Ok(()) => {
                let renamed = file
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
                let _ = file.set_len(lines.whole);
                self.is_kept = true;
                let advice = advice().map_or(String::new(), |advice| format!("; {advice}"));
                format!(
                    "cannot write `{path}`: {error}; the first {rows} rows are in `{part}`{advice}"
                )
            }
            Err(error) => {
                // Makes room.
                let _ = fs::remove_file(&self.part);
                return Err(lost(error, advice()));
            }
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

#[cfg(test)]
mod tests {
    use std::fs;
    use std::io::{self, BufWriter, Write};

    use super::{Lines, Target};

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
            .fill(|out| out.write_all(b"all"), || None)
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
            let write = |out: &mut BufWriter<Lines<'_>>| {
                out.write_all(text.as_bytes())?;
                out.flush()?;
                out.write_all(b"4\n5\n")?;
                Err(io::ErrorKind::StorageFull.into())
            };
            let error = target.fill(write, || None);
            let error = error.expect_err("no room").to_string();
            assert_eq!(fs::read_to_string(&part).ok().as_deref(), kept);
            assert_eq!(error.contains("the first 2 rows are in"), kept.is_some());
            assert_eq!(error.contains("are lost"), kept.is_none());
        }
        fs::remove_dir_all(&folder).expect("a folder");
    }

    /// A CSV writer writes its buffer once more when it is dropped.
    #[test]
    fn nothing_is_written_after_an_error() {
        let name = format!("symplectic-lines-{}", std::process::id());
        let path = std::env::temp_dir().join(name);
        fs::write(&path, "").expect("a file");
        let file = fs::File::open(&path).expect("a file");
        let mut lines = Lines::new(&file);
        // The file is open for reading only.
        let first = lines.write(b"1").expect_err("not writable");
        let second = lines.write(b"1").expect_err("not open");
        assert_ne!(first.kind(), io::ErrorKind::BrokenPipe);
        assert_eq!(second.kind(), io::ErrorKind::BrokenPipe);
        fs::remove_file(&path).expect("a file");
    }
}
