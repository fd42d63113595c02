//! Files that are replaced as a whole.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Writes a file as a whole or not at all: into `NAME.part` beside it, which is written to the disk and then renamed.
///
/// # Errors
///
/// Those of `write` and of the file system; the file is then as before, and `NAME.part` is removed.
///
/// ```
/// use std::io::Write;
/// use symplectic::files::replace_file;
///
/// # fn main() -> std::io::Result<()> {
/// let path = std::env::temp_dir().join("symplectic-replace-file.txt");
/// replace_file(&path, |out| writeln!(out, "step {}", 1000))?;
/// assert_eq!(std::fs::read_to_string(&path)?, "step 1000\n");
/// # std::fs::remove_file(path)
/// # }
/// ```
pub fn replace_file(
    path: impl AsRef<Path>,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    let path = path.as_ref();
    let mut part = OsString::from(path);
    part.push(".part");
    let replaced = write_part(&part, write).and_then(|()| fs::rename(&part, path));
    if replaced.is_err() {
        // The error of the write says more than that of the removal.
        let _ = fs::remove_file(&part);
        return replaced;
    }
    // The new name is on the disk when its folder is. Not all systems can open a folder; the file is whole there too.
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    if let Ok(folder) = File::open(folder.unwrap_or(Path::new("."))) {
        let _ = folder.sync_all();
    }
    Ok(())
}

fn write_part(
    part: &OsString,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> io::Result<()> {
    let mut out = BufWriter::new(File::create(part)?);
    write(&mut out)?;
    out.into_inner()?.sync_all()
}

/// A file that is replaced when an interval has passed, such as a checkpoint every ten minutes.
///
/// ```
/// symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
/// symplectic::hamiltonian! { Pendulum q: [a], p: [pa]; H = pa^2/2 - cos(a) }
/// use std::time::Duration;
/// use symplectic::files::PeriodicFile;
/// use symplectic::{Integrator, State};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let mut run = Integrator::new(Gauss2, Pendulum, State::from_arrays(0.0, [1.0], [0.0]), 0.1)?;
/// # let folder = std::env::temp_dir();
/// let mut file = PeriodicFile::new(folder.join("symplectic-run.checkpoint"), Duration::from_secs(600));
/// for _ in 0..100 {
///     run.take_steps(1000)?;
///     // With the feature `serde`: serde_json::to_vec(&run.checkpoint()?)
///     file.when_due(|| Ok::<_, std::io::Error>(format!("{:?}", run.state())))?;
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct PeriodicFile {
    path: PathBuf,
    interval: Duration,
    last: Instant,
}

impl PeriodicFile {
    /// A file that is first written when the interval has passed from now.
    pub fn new(path: impl Into<PathBuf>, interval: Duration) -> Self {
        Self {
            path: path.into(),
            interval,
            last: Instant::now(),
        }
    }

    /// Calls `content` and [replaces](replace_file) the file if the interval has passed since the last time; says whether it has.
    ///
    /// # Errors
    ///
    /// Those of `content` and of the file system; the file is then as before, and due.
    pub fn when_due<B: AsRef<[u8]>, E: From<io::Error>>(
        &mut self,
        content: impl FnOnce() -> Result<B, E>,
    ) -> Result<bool, E> {
        let due = self.last.elapsed() >= self.interval;
        if due {
            let content = content()?;
            replace_file(&self.path, |out| out.write_all(content.as_ref()))?;
            self.last = Instant::now();
        }
        Ok(due)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder =
            std::env::temp_dir().join(std::format!("symplectic-{name}-{}", std::process::id()));
        fs::create_dir_all(&folder).expect("a folder");
        folder
    }

    #[test]
    fn a_failed_write_keeps_the_old_file_and_no_partial_one() {
        let folder = folder("replace");
        let path = folder.join("file");
        replace_file(&path, |out| out.write_all(b"whole")).expect("written");
        let failure = replace_file(&path, |out| {
            out.write_all(b"half")?;
            Err(io::Error::other("the disk is full"))
        });
        assert_eq!(
            failure.expect_err("a failure").to_string(),
            "the disk is full"
        );
        assert_eq!(fs::read(&path).expect("the file"), b"whole");
        assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 1);
        fs::remove_dir_all(folder).expect("removed");
    }

    #[test]
    fn a_periodic_file_is_written_when_it_is_due() {
        let folder = folder("periodic");
        let path = folder.join("file");
        let mut rare = PeriodicFile::new(&path, Duration::from_secs(1 << 30));
        let written = rare.when_due(|| -> io::Result<&str> { panic!("not due") });
        assert!(!written.expect("no write") && !path.exists());
        let mut always = PeriodicFile::new(&path, Duration::ZERO);
        for text in ["first", "second"] {
            assert!(always.when_due(|| io::Result::Ok(text)).expect("a write"));
            assert_eq!(fs::read_to_string(&path).expect("the file"), text);
        }
        let failure = always.when_due(|| Err::<&str, _>(io::Error::other("no content")));
        assert!(failure.is_err());
        assert_eq!(fs::read_to_string(&path).expect("the file"), "second");
        fs::remove_dir_all(folder).expect("removed");
    }
}
