//! Everything into one folder.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::{Measurements, Scheme};

/// Why a report was not written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// A file or a folder cannot be written.
    #[error("cannot write {path:?}: {source}")]
    File {
        /// Its path.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The measurements cannot be written as JSON.
    #[error("the measurements are no JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// The measurements cannot be written as a table.
    #[error("the measurements are no table: {0}")]
    Csv(#[from] csv::Error),
}

impl Measurements {
    /// Writes `index.html`, `measurements.json`, `measurements.csv`, `verdicts.csv`, `limits.csv`, `table.md` and the plots,
    /// `plots/*.svg`, into `folder`, which is made where there is none; returns the path of the page.
    ///
    /// # Errors
    ///
    /// [`WriteError`], with what was written before it left as it is.
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
        write(folder.join("measurements.csv"), &self.csv()?)?;
        write(folder.join("verdicts.csv"), &self.verdicts_csv()?)?;
        write(folder.join("limits.csv"), &self.limits_csv()?)?;
        write(folder.join("table.md"), &self.table())?;
        let page = folder.join("index.html");
        write(page.clone(), &self.page())?;
        Ok(page)
    }
}

fn write(path: PathBuf, text: &str) -> Result<(), WriteError> {
    fs::write(&path, text).map_err(|source| WriteError::File { path, source })
}
