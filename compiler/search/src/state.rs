//! The state of a search in a file.

use std::path::Path;

use serde::{Deserialize, Serialize};
use symplectic_compiler::Error;

use crate::command::refused;
use crate::hunt::{Problem, Progress};

#[derive(Serialize, Deserialize)]
struct File {
    /// What is searched, so that a search does not go on as another one.
    problem: String,
    progress: Progress,
}

/// The state in a file, or that of a new search if there is no such file.
pub(crate) fn read(path: &Path, problem: &Problem, seed: u32) -> Result<Progress, Error> {
    let text = match std::fs::read_to_string(path) {
        Ok(text) => text,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            return Ok(Progress::new(seed));
        }
        Err(error) => return Err(refused(format!("cannot read {}: {error}", path.display()))),
    };
    let file: File = toml::from_str(&text).map_err(|error| {
        refused(format!(
            "{} is not the state of a search: {}",
            path.display(),
            error.message()
        ))
    })?;
    if file.problem != problem.text() {
        return Err(refused(format!(
            "{} is the state of another search, {}; this one is {}",
            path.display(),
            file.problem,
            problem.text()
        )));
    }
    if file.progress.seed != seed {
        return Err(refused(format!(
            "{} is the state of a search with the seed {}: give `--seed {}`",
            path.display(),
            file.progress.seed,
            file.progress.seed
        )));
    }
    Ok(file.progress)
}

/// Writes the state; the file is replaced as a whole.
pub(crate) fn write(path: &Path, problem: &Problem, progress: &Progress) -> Result<(), Error> {
    let failed = |error: String| refused(format!("cannot write {}: {error}", path.display()));
    let file = File {
        problem: problem.text(),
        progress: progress.clone(),
    };
    let text = toml::to_string(&file).map_err(|error| failed(error.to_string()))?;
    let mut part = path.as_os_str().to_owned();
    part.push(".part");
    std::fs::write(&part, text).map_err(|error| failed(error.to_string()))?;
    std::fs::rename(&part, path).map_err(|error| failed(error.to_string()))
}
