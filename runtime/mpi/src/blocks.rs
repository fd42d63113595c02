//! The blocks of an ensemble in a folder: one file each, complete or absent.

use std::ffi::OsString;
use std::fmt;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

use symplectic::ensemble::{Ensemble, EnsembleCheckpoint, Npz, NpzArray, NpzValues, WriteEnsemble};
use symplectic::simd::{DefaultLanes, Lanes};
use symplectic::solver::Solver;
use symplectic::{Compensated, Method, Summation, System, Vector};

use crate::Error;

/// An ensemble that is divided into blocks of trajectories, with the folder of their results.
///
/// Block `k` of `n` is [`Ensemble::to_shard`]`(k, n)`. Its file `block-000003-of-000064.npz` holds a checkpoint of the whole ensemble, the
/// facts, and the arrays that `work` wrote. It is written under another name and then renamed: so it is complete or not there, and a
/// run that is killed at any time loses the blocks in work only. A second run finds the others.
///
/// All ranks must see one folder. One run at a time may write to it.
pub struct Blocks<'a, M, S, V, R = Compensated, N = <S as System<V>>::Solver, L = DefaultLanes>
where
    V: Vector,
    S: System<V>,
{
    ensemble: &'a Ensemble<M, S, V, R, N, L>,
    folder: PathBuf,
    count: usize,
    /// What every block begins with, as a file: the checkpoint and the facts.
    head: Vec<u8>,
    /// The arrays of the head.
    head_arrays: Vec<NpzArray>,
}

/// What was found where the file of a block belongs.
pub(crate) enum Found {
    /// What `work` wrote.
    Complete(Vec<NpzArray>),
    /// A file that was cut off or changed.
    Damaged(io::Error),
    /// Nothing.
    Nothing,
}

impl<'a, M, S, V, R, N, L> Blocks<'a, M, S, V, R, N, L>
where
    M: Method,
    S: System<V> + Clone + Send + Sync,
    V: Vector + Send + Sync,
    R: Summation,
    N: Solver<V, S>,
    L: Lanes,
{
    /// Divides an ensemble into `count` blocks. Nothing is written yet.
    ///
    /// `facts` writes what the results depend on beside the ensemble: the time at the end, times of output, thresholds. A folder with
    /// other facts is refused, and the merged file begins with them, after those of [`Npz::facts`].
    ///
    /// A block should take seconds at least, and there should be ten or more for each rank: a rank that is done early takes from the
    /// work of the others.
    ///
    /// # Errors
    ///
    /// [`Error::Count`] for no blocks, or more than trajectories; [`Error::Resumed`], [`Error::Checkpoint`], [`Error::Facts`].
    pub fn new(
        ensemble: &'a Ensemble<M, S, V, R, N, L>,
        folder: impl Into<PathBuf>,
        count: usize,
        facts: impl FnOnce(&mut Npz<Vec<u8>>) -> io::Result<()>,
    ) -> Result<Self, Error> {
        let trajectories = ensemble.starts().len();
        if count == 0 || count > trajectories {
            return Err(Error::Count {
                count,
                trajectories,
            });
        }
        let first = ensemble.trajectories().start;
        if ensemble.trajectories().len() < trajectories {
            return Err(Error::Resumed { first });
        }
        let checkpoint = ensemble.checkpoint(first)?;
        let head = || {
            let mut file = Npz::new(Vec::new());
            file.text("checkpoint", &serde_json::to_string(&checkpoint)?)?;
            file.facts(ensemble)?;
            facts(&mut file)?;
            let head = file.finish()?;
            let arrays = NpzArray::read_all(&head)?;
            Ok((head, arrays))
        };
        let (head, head_arrays) = head().map_err(Error::Facts)?;
        Ok(Self {
            ensemble,
            folder: folder.into(),
            count,
            head,
            head_arrays,
        })
    }

    /// Writes the results of all blocks as one file, in the order of the trajectories. It has the bytes that one process writes with
    /// [`Npz::facts`], the facts, and `work` for the whole ensemble.
    ///
    /// # Errors
    ///
    /// [`Error::Missing`] for a block that was not run, [`Error::OtherRun`], [`Error::File`] for a block that is damaged or has other
    /// arrays than the first, and where the file cannot be written; there is then no file, or the one that was there before.
    pub fn merge(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        let mut all: Vec<NpzArray> = Vec::new();
        for block in 0..self.count {
            let file = |error| Error::File {
                path: self.path(block),
                error,
            };
            let arrays = match self.find(block)? {
                Found::Complete(arrays) => arrays,
                Found::Damaged(error) => return Err(file(error)),
                Found::Nothing => {
                    let path = self.path(block);
                    return Err(Error::Missing { path });
                }
            };
            match block {
                0 => all = arrays,
                _ => append(&mut all, arrays).map_err(file)?,
            }
        }
        let whole = || {
            let mut file = Npz::new(Vec::new());
            // The checkpoint is for blocks.
            for array in self.head_arrays.iter().skip(1).chain(&all) {
                file.array(array)?;
            }
            file.finish()
        };
        let path = path.as_ref();
        let written = whole().and_then(|bytes| write_whole(path, &bytes));
        written.map_err(|error| Error::File {
            path: path.into(),
            error,
        })
    }

    /// The number of blocks.
    pub(crate) const fn count(&self) -> usize {
        self.count
    }

    /// What every block begins with.
    pub(crate) fn head(&self) -> &[u8] {
        &self.head
    }

    /// Makes the folder. Refuses one with another division into blocks.
    pub(crate) fn open(&self) -> Result<(), Error> {
        let failed = |error| Error::File {
            path: self.folder.clone(),
            error,
        };
        fs::create_dir_all(&self.folder).map_err(failed)?;
        let own = self.suffix();
        for entry in fs::read_dir(&self.folder).map_err(failed)? {
            let path = entry.map_err(failed)?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if name.starts_with("block-") && name.ends_with(".npz") && !name.ends_with(&own) {
                let difference = format!("here there are {} blocks", self.count);
                return Err(Error::OtherRun { path, difference });
            }
        }
        Ok(())
    }

    /// Reads a block.
    pub(crate) fn find(&self, block: usize) -> Result<Found, Error> {
        let path = self.path(block);
        let bytes = match fs::read(&path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(Found::Nothing),
            Err(error) => return Err(Error::File { path, error }),
        };
        let arrays = match NpzArray::read_all(&bytes) {
            Ok(arrays) => arrays,
            Err(error) => return Ok(Found::Damaged(error)),
        };
        if let Some(difference) = self.difference(&arrays) {
            return Err(Error::OtherRun { path, difference });
        }
        let shard = self.ensemble.to_shard(block, self.count)?;
        Ok(match self.own_arrays(&shard, arrays) {
            Ok(arrays) => Found::Complete(arrays),
            Err(error) => Found::Damaged(error),
        })
    }

    /// Runs a block and writes it.
    pub(crate) fn fill(
        &self,
        block: usize,
        work: impl FnOnce(&Ensemble<M, S, V, R, N, L>, &mut Npz<Vec<u8>>) -> io::Result<()>,
    ) -> Result<(), Error> {
        let shard = self.ensemble.to_shard(block, self.count)?;
        let filled = || {
            let mut file = Npz::new(Vec::new());
            for array in &self.head_arrays {
                file.array(array)?;
            }
            work(&shard, &mut file)?;
            let bytes = file.finish()?;
            self.own_arrays(&shard, NpzArray::read_all(&bytes)?)?;
            Ok(bytes)
        };
        let bytes = filled().map_err(|error| Error::Work { block, error })?;
        let path = self.path(block);
        write_whole(&path, &bytes).map_err(|error| Error::File { path, error })
    }

    /// The first difference between these arrays and the head of a block.
    pub(crate) fn difference(&self, arrays: &[NpzArray]) -> Option<String> {
        let mut others = arrays.iter();
        self.head_arrays.iter().find_map(|own| match others.next() {
            Some(other) if is_same(own, other) => None,
            Some(other) if own.name == "checkpoint" => Some(self.other_checkpoint(other)),
            Some(other) if own.shape.is_empty() && own.name == other.name => Some(format!(
                "`{}` is {:?}, and here {:?}",
                own.name, other.values, own.values
            )),
            _ => Some(format!("`{}` is another", own.name)),
        })
    }

    /// How the checkpoint of another run differs from that of this ensemble.
    fn other_checkpoint(&self, other: &NpzArray) -> String {
        let checkpoint = match &other.values {
            NpzValues::Texts(texts) => texts
                .first()
                .and_then(|text| serde_json::from_str::<EnsembleCheckpoint>(text).ok()),
            _ => None,
        };
        match checkpoint.map(|checkpoint| self.ensemble.check(&checkpoint)) {
            Some(Err(error)) => error.to_string(),
            _ => "it has no checkpoint of this version".to_owned(),
        }
    }

    /// The arrays of a block without its head, if they have all of its trajectories.
    fn own_arrays(
        &self,
        shard: &Ensemble<M, S, V, R, N, L>,
        mut arrays: Vec<NpzArray>,
    ) -> io::Result<Vec<NpzArray>> {
        let own = arrays.split_off(self.head_arrays.len());
        let expected = shard.trajectories();
        let complete = own.iter().any(|array| match &array.values {
            NpzValues::Integers(values) if array.name == "trajectory" => {
                let numbers = expected.clone().map(|number| number as u64);
                numbers.eq(values.iter().copied())
            }
            _ => false,
        });
        match complete {
            true => Ok(own),
            false => Err(io::Error::new(
                ErrorKind::InvalidData,
                format!(
                    "the array `trajectory` is not {expected:?}: write all rows with `Npz::rows`; a run that was stopped has too few"
                ),
            )),
        }
    }

    fn path(&self, block: usize) -> PathBuf {
        self.folder
            .join(format!("block-{block:06}{}", self.suffix()))
    }

    fn suffix(&self) -> String {
        format!("-of-{:06}.npz", self.count)
    }
}

impl<M: Method, S: System<V>, V: Vector, R, N, L> fmt::Debug for Blocks<'_, M, S, V, R, N, L> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("Blocks")
            .field("ensemble", self.ensemble)
            .field("folder", &self.folder)
            .field("count", &self.count)
            .finish_non_exhaustive()
    }
}

/// The same name, shape and bits.
fn is_same(one: &NpzArray, other: &NpzArray) -> bool {
    let values = match (&one.values, &other.values) {
        (NpzValues::Doubles(one), NpzValues::Doubles(other)) => {
            let bits = one.iter().map(|x| x.to_bits());
            bits.eq(other.iter().map(|x| x.to_bits()))
        }
        (one, other) => one == other,
    };
    values && (&one.name, &one.shape) == (&other.name, &other.shape)
}

/// Puts the arrays of the next block after those of the blocks before.
fn append(all: &mut [NpzArray], next: Vec<NpzArray>) -> io::Result<()> {
    if all.len() != next.len() {
        let message = "it has another number of arrays than the first block";
        return Err(io::Error::new(ErrorKind::InvalidData, message));
    }
    let mut pairs = all.iter_mut().zip(next);
    pairs.try_for_each(|(array, next)| array.append(next))
}

/// Writes a file that is there in full or not at all.
fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut name = OsString::from(path);
    name.push(".part");
    let part = PathBuf::from(name);
    let write = || {
        let mut file = File::create(&part)?;
        file.write_all(bytes)?;
        file.sync_all()?;
        fs::rename(&part, path)
    };
    write().inspect_err(|_| {
        let _ = fs::remove_file(&part);
    })
}
