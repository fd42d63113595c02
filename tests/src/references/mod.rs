//! Reference end states of the scenes without a closed form.
//!
//! `data/references.toml` contains them with 30 digits; `cargo run --release -p symplectic-tests --example references` recomputes the file.
//! Every number in it comes from `recomputations` with 237-bit numbers ([`Wide`]), and each run is made with two
//! sequences of steps. A reference belongs to the scene with its start and coefficients rounded to doubles.

mod collocation;
mod recomputations;
mod wide;

use std::sync::OnceLock;

use serde::{Deserialize, Serialize};
use symplectic::{State, Vector};

pub use collocation::{Collocation, NoConvergence};
pub use recomputations::{ALL, Recomputation};
pub use wide::Wide;

/// The end of a run.
#[derive(Clone, Debug, PartialEq, Deserialize, Serialize)]
pub struct Record {
    /// The scene.
    pub scene: String,
    /// Its parameters, if it has any.
    pub parameters: String,
    /// The end time; the start is that of the scene.
    pub time: f64,
    /// The number of stages of the Gauss method.
    pub stages: usize,
    /// The number of steps of the coarser and of the finer run.
    pub steps: [u64; 2],
    /// The distance of the two ends to two digits: the larger of the relative distances of q and of p in the 2-norm.
    pub agreement: String,
    /// The position at the end of the finer run, in decimals.
    pub q: Vec<String>,
    /// The momentum at the end of the finer run, in decimals.
    pub p: Vec<String>,
}

/// The whole file.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
pub struct Records {
    /// The records in the order of [`ALL`].
    pub reference: Vec<Record>,
}

/// All records.
pub fn records() -> &'static [Record] {
    static RECORDS: OnceLock<Records> = OnceLock::new();
    let records = RECORDS.get_or_init(|| {
        let text = include_str!("../../data/references.toml");
        toml::from_str(text).expect("the file is as the program wrote it")
    });
    &records.reference
}

/// The recorded state of a scene at `time`, rounded to doubles; `None` if there is none with this dimension.
pub fn find<V>(scene: &str, parameters: &str, time: f64) -> Option<State<V>>
where
    V: Vector<Scalar = f64>,
{
    let mut records = records().iter();
    let record = records.find(|record| {
        record.scene == scene && record.parameters == parameters && record.time == time
    })?;
    let doubles =
        |digits: &[String]| -> Option<Vec<f64>> { digits.iter().map(|x| x.parse().ok()).collect() };
    State::from_slices(time, &doubles(&record.q)?, &doubles(&record.p)?).ok()
}
