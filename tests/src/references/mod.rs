//! Reference end states of the scenes without a closed form.
//!
//! They stand in `data/references.toml` with 30 digits and are recomputed by `cargo run --release --example references`:
//! every number in that file is from the program, by `recomputations` over numbers of 237 bits ([`Wide`]), and each run is
//! made twice, with two sequences of steps. The reference belongs to the doubles of the scene: those that its start is, and
//! those that its coefficients are.

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
    /// The time of the end; the start is that of the scene.
    pub time: f64,
    /// The stages of the Gauss method, and how many steps it took in the coarser run and in the finer one.
    pub stages: usize,
    /// See `stages`.
    pub steps: [u64; 2],
    /// The distance of the two ends in two digits: the larger one of the relative distances of q and of p in the 2-norm.
    pub agreement: String,
    /// The position at the end of the finer run.
    pub q: Vec<String>,
    /// The momentum there.
    pub p: Vec<String>,
}

/// The file as a whole.
#[derive(Clone, Debug, Default, PartialEq, Deserialize, Serialize)]
pub struct Records {
    /// In the order of [`ALL`].
    pub reference: Vec<Record>,
}

/// What is recorded.
pub fn records() -> &'static [Record] {
    static RECORDS: OnceLock<Records> = OnceLock::new();
    let records = RECORDS.get_or_init(|| {
        let text = include_str!("../../data/references.toml");
        toml::from_str(text).expect("the file is as the program wrote it")
    });
    &records.reference
}

/// The recorded state of a scene at `time` as the nearest doubles; `None` if there is none, or none of this dimension.
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
