//! Writing a report to a folder.

use std::fmt;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::{Measurements, Scheme};

/// The message, as `main` and `unwrap` print it.
impl fmt::Debug for WriteError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, formatter)
    }
}

/// The error of writing a report.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// A file or a folder cannot be written.
    #[error("cannot write {path:?}: {source}")]
    File {
        /// Its path.
        path: PathBuf,
        /// The I/O error.
        source: io::Error,
    },
    /// The measurements cannot be written as JSON.
    #[error("the measurements cannot be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// The measurements cannot be written as a table.
    #[error("the measurements cannot be written as a table: {0}")]
    Csv(#[from] csv::Error),
}

impl Measurements {
    /// Writes `index.html`, `measurements.json`, `measurements.csv`, `verdicts.csv`, `limits.csv`, `table.md` and the
    /// plots, `plots/*.svg`, into `folder`, which is created if necessary; returns the path of the page.
    ///
    /// Tables without rows are not written, and the file of an earlier report is removed.
    ///
    /// # Errors
    ///
    /// [`WriteError`]; files written before the error remain.
    pub fn write(&self, folder: impl AsRef<Path>) -> Result<PathBuf, WriteError> {
        let folder = folder.as_ref();
        let plots = folder.join("plots");
        fs::create_dir_all(&plots).map_err(|source| WriteError::File {
            path: plots.clone(),
            source,
        })?;
        for (name, plot) in self.plots() {
            write(plots.join(format!("{name}.svg")), &plot.svg(Scheme::Reader))?;
        }
        write(folder.join("measurements.json"), &self.json()?)?;
        let tables = [
            ("measurements.csv", self.csv()?),
            ("verdicts.csv", self.verdicts_csv()?),
            ("limits.csv", self.limits_csv()?),
        ];
        for (name, text) in tables {
            write_or_remove(folder.join(name), &text)?;
        }
        write(folder.join("table.md"), &self.table())?;
        let page = folder.join("index.html");
        write(page.clone(), &self.page())?;
        Ok(page)
    }
}

fn write(path: PathBuf, text: &str) -> Result<(), WriteError> {
    fs::write(&path, text).map_err(|source| WriteError::File { path, source })
}

/// Writes a text; removes the file of an earlier report if the text is empty.
fn write_or_remove(path: PathBuf, text: &str) -> Result<(), WriteError> {
    if !text.is_empty() {
        return write(path, text);
    }
    match fs::remove_file(&path) {
        Err(source) if source.kind() != io::ErrorKind::NotFound => {
            Err(WriteError::File { path, source })
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let files = fs::read_dir(folder).expect("the folder was written");
        let files = files.map(|file| file.expect("it can be read"));
        let files = files.filter(|file| file.metadata().expect("it is there").is_file());
        let mut names: Vec<String> = files
            .inspect(|file| assert!(file.metadata().expect("it is there").len() > 0))
            .map(|file| file.file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn no_file_is_empty() {
        let name = format!("symplectic-report-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        let mut found = crate::tests::measurements();
        found.write(&folder).expect("the folder can be written");
        assert_eq!(
            names(&folder),
            [
                "index.html",
                "limits.csv",
                "measurements.csv",
                "measurements.json",
                "table.md",
                "verdicts.csv"
            ]
        );
        found.verdicts.clear();
        found.limits.clear();
        found.write(&folder).expect("it can be written again");
        assert_eq!(
            names(&folder),
            [
                "index.html",
                "measurements.csv",
                "measurements.json",
                "table.md"
            ]
        );
        fs::remove_dir_all(&folder).expect("it can be removed");
    }
}
