//! The stability of the methods of the catalogue on the oscillator, proved and measured.
//!
//! The files of the catalogue contain the coefficients and the stability sets; a test of the compiler re-proves them.

use std::collections::HashMap;
use std::fs;
use std::io;
use std::path::Path;

use nalgebra::Matrix2;
use serde::Deserialize;
use symplectic_compiler::order::HamiltonianClass;
use symplectic_compiler::{Definition, Evidence, Limits};
use symplectic_report::Fact;

/// A method of the catalogue.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Name.
    pub name: String,
    /// The intervals of `hω > 0` for which it is stable, in ascending order.
    pub stable: Vec<[f64; 2]>,
    /// Whether it is proved to be explicit for separable systems.
    pub is_explicit: bool,
    /// The order for separable systems and its evidence, and the order for quadratic kinetic energy if it differs.
    pub order: String,
    a: Vec<Vec<f64>>,
    a_tilde: Vec<Vec<f64>>,
    b: Vec<f64>,
    b_tilde: Vec<f64>,
    /// The weights of gradient kicks, or none.
    gradient: Vec<f64>,
}

/// The relevant parts of a file.
#[derive(Deserialize)]
struct File {
    name: String,
    decimals: Decimals,
    properties: Properties,
    order: Orders,
    stability: Stability,
}

#[derive(Deserialize)]
struct Orders {
    separable: Order,
    nystrom: Order,
}

#[derive(Deserialize)]
struct Order {
    order: usize,
    evidence: String,
}

impl Orders {
    fn in_words(&self) -> String {
        let words = |order: &Order| format!("{}, {}", order.order, order.evidence);
        if self.separable.order == self.nystrom.order {
            words(&self.separable)
        } else {
            format!(
                "{}; quadratic T: {}",
                words(&self.separable),
                words(&self.nystrom)
            )
        }
    }
}

#[derive(Deserialize)]
struct Properties {
    explicit: Property,
}

#[derive(Deserialize)]
struct Property {
    holds: bool,
}

#[derive(Deserialize)]
struct Decimals {
    a: Option<Vec<Vec<String>>>,
    a_tilde: Option<Vec<Vec<String>>>,
    b: Vec<String>,
    b_tilde: Vec<String>,
    #[serde(default)]
    gradient: Vec<String>,
}

#[derive(Deserialize)]
struct Stability {
    decimal: Option<Vec<[String; 2]>>,
}

/// The methods of the catalogue with known stability, by name: all except the longest compositions.
///
/// # Errors
///
/// If the files cannot be read.
pub fn catalogue() -> io::Result<HashMap<String, Entry>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tableaux");
    let mut entries = HashMap::new();
    for file in fs::read_dir(folder)? {
        let path = file?.path();
        if path
            .extension()
            .is_some_and(|extension| extension == "toml")
        {
            let text = fs::read_to_string(&path)?;
            let file: File = toml::from_str(&text).map_err(io::Error::other)?;
            // Files of long methods have no matrices: that of a processed method has the stable steps of its kernel only.
            if file.stability.decimal.is_some() && file.decimals.a.is_some() {
                let entry = Entry::new(&file).ok_or_else(|| io::Error::other(file.name.clone()))?;
                entries.insert(file.name, entry);
            }
        }
    }
    Ok(entries)
}

impl Entry {
    fn new(file: &File) -> Option<Self> {
        let number = |text: &String| match text.as_str() {
            "infinity" => Some(f64::INFINITY),
            digits => digits.parse().ok(),
        };
        let row = |row: &Vec<String>| row.iter().map(number).collect::<Option<Vec<f64>>>();
        let matrix = |rows: &Vec<Vec<String>>| rows.iter().map(row).collect::<Option<Vec<_>>>();
        let ends = file.stability.decimal.iter().flatten();
        let ends = ends.map(|[low, high]| Some([number(low)?, number(high)?]));
        Some(Self {
            name: file.name.clone(),
            is_explicit: file.properties.explicit.holds,
            order: file.order.in_words(),
            stable: ends.collect::<Option<_>>()?,
            a: matrix(file.decimals.a.as_ref()?)?,
            a_tilde: matrix(file.decimals.a_tilde.as_ref()?)?,
            b: row(&file.decimals.b)?,
            b_tilde: row(&file.decimals.b_tilde)?,
            gradient: row(&file.decimals.gradient)?,
        })
    }

    /// A method that is not in the catalogue, from its definition.
    ///
    /// # Errors
    ///
    /// If the compiler rejects the definition.
    pub fn derived(name: &str, definition: &str) -> io::Result<Self> {
        let definition = Definition::parse(definition).map_err(io::Error::other)?;
        let tableau = definition
            .derive(&Limits::default())
            .map_err(io::Error::other)?;
        let order = |class| {
            let found = tableau.orders().class(class).clone();
            Order {
                order: found.order,
                evidence: evidence(found.evidence).into(),
            }
        };
        let orders = Orders {
            separable: order(HamiltonianClass::Separable),
            nystrom: order(HamiltonianClass::Nystrom),
        };
        let intervals = tableau.stability().intervals;
        let intervals = intervals.iter();
        let doubles = tableau.to_f64();
        Ok(Self {
            name: name.into(),
            stable: intervals
                .map(|interval| [interval.low.to_f64(), interval.high.to_f64()])
                .collect(),
            is_explicit: tableau.evaluations().is_some(),
            order: orders.in_words(),
            a: doubles.a,
            a_tilde: doubles.a_tilde,
            b: doubles.b,
            b_tilde: doubles.b_tilde,
            gradient: doubles.gradient,
        })
    }

    /// The proved facts.
    pub fn facts(&self) -> Vec<Fact> {
        let end = |end: f64| match end {
            0.0 => "0".to_owned(),
            _ if end.is_infinite() => "∞".to_owned(),
            _ => format!("{end:.4}"),
        };
        let intervals = self.stable.iter().take(SHOWN);
        let mut stable: Vec<String> = intervals
            .map(|[low, high]| format!("({}, {})", end(*low), end(*high)))
            .collect();
        if self.stable.len() > SHOWN {
            stable.push("…".to_owned());
        }
        vec![
            Fact::new("proved order", self.order.as_str()),
            Fact::new("proved to be stable for hω in", stable.join(" ∪ ")),
        ]
    }

    /// The end of the first interval of stability, if it begins at zero.
    pub fn proved_limit(&self) -> Option<f64> {
        let [low, high] = *self.stable.first()?;
        (low == 0.0).then_some(high)
    }

    /// Whether `hω` is inside one of the intervals.
    pub fn is_stable_at(&self, nu: f64) -> bool {
        let mut intervals = self.stable.iter();
        intervals.any(|&[low, high]| low < nu && nu < high)
    }

    /// The stages for a separable system in an order in which each depends on earlier stages only; `None` for an
    /// implicit method.
    pub fn explicit(&self) -> Option<ExplicitStep<'_>> {
        let stages = self.b.len();
        let mut known = [vec![false; stages], vec![false; stages]];
        let mut order = Vec::new();
        while order.len() < 2 * stages {
            let before = order.len();
            for i in 0..stages {
                for (half, matrix) in [&self.a, &self.a_tilde].into_iter().enumerate() {
                    let mut needed = (0..stages).filter(|&j| matrix[i][j] != 0.0);
                    if !known[half][i] && needed.all(|j| known[1 - half][j]) {
                        known[half][i] = true;
                        let terms = (0..stages).filter(|&j| matrix[i][j] != 0.0);
                        order.push(Stage {
                            half,
                            index: i,
                            terms: terms.map(|j| (j, matrix[i][j])).collect(),
                        });
                    }
                }
            }
            if order.len() == before {
                return None;
            }
        }
        Some(ExplicitStep { entry: self, order })
    }
}

/// The step of an explicit method on the oscillator.
#[derive(Clone, Debug)]
pub struct ExplicitStep<'a> {
    entry: &'a Entry,
    order: Vec<Stage>,
}

#[derive(Clone, Debug)]
struct Stage {
    /// 0 for a position, 1 for a momentum.
    half: usize,
    index: usize,
    /// The stages of the other half, with their coefficients.
    terms: Vec<(usize, f64)>,
}

impl ExplicitStep<'_> {
    /// The matrix that maps `(q, p/ω)` over a step with `hω = ν`.
    pub fn matrix(&self, nu: f64) -> Matrix2<f64> {
        // Q_i = q + ν Σ a_ij P_j and P_i = p − ν Σ ã_ij Q_j, for (q, p) = (1, 0) and (0, 1) together. A gradient kick, which is one of a
        // splitting, has b̃_j − 2 g_j ν² in the place of b̃_j.
        let sign = [nu, -nu];
        let unit = [[1.0, 0.0], [0.0, 1.0]];
        let stages = self.entry.b.len();
        let mut values = [vec![[0.0; 2]; stages], vec![[0.0; 2]; stages]];
        let total = |half: usize,
                     terms: &mut dyn Iterator<Item = (usize, f64)>,
                     values: &[Vec<[f64; 2]>; 2]| {
            terms.fold(unit[half], |[x, y], (j, coefficient)| {
                let [u, v] = values[1 - half][j];
                let gradient = self.entry.gradient.get(j).filter(|_| half == 1);
                let gradient = gradient.map_or(0.0, |weight| 2.0 * weight * nu.powi(3));
                let factor = sign[half] * coefficient + gradient;
                [x + factor * u, y + factor * v]
            })
        };
        for Stage { half, index, terms } in &self.order {
            values[*half][*index] = total(*half, &mut terms.iter().copied(), &values);
        }
        let weights = |weights: &Vec<f64>| weights.clone().into_iter().enumerate();
        let [[a, b], [c, d]] = [
            total(0, &mut weights(&self.entry.b), &values),
            total(1, &mut weights(&self.entry.b_tilde), &values),
        ];
        Matrix2::new(a, b, c, d)
    }

    /// The smallest `hω` at which the powers of the matrix grow; infinite if they do not up to [`FARTHEST`].
    ///
    /// The search tests points [`SEARCH`] apart, and points between them where the eigenvalues approach ±1, because
    /// gaps of instability can be very narrow there.
    pub fn measured_limit(&self) -> f64 {
        let half_trace = |nu: f64| self.matrix(nu).trace().abs() / 2.0;
        let mut before = [0.0, half_trace(0.0)];
        let mut here = [SEARCH, half_trace(SEARCH)];
        while here[0] < FARTHEST {
            let next = [here[0] + SEARCH, half_trace(here[0] + SEARCH)];
            let mut suspect = here[0];
            if here[1] > NEAR_ONE && here[1] >= before[1] && here[1] >= next[1] {
                suspect = maximum(before[0], next[0], half_trace);
            }
            if !powers_are_bounded(self.matrix(suspect)) {
                return self.border(before[0], suspect);
            }
            (before, here) = (here, next);
        }
        f64::INFINITY
    }

    /// The boundary between a stable and an unstable step, by bisection.
    fn border(&self, mut stable: f64, mut unstable: f64) -> f64 {
        for _ in 0..20 {
            let middle = 0.5 * (stable + unstable);
            if powers_are_bounded(self.matrix(middle)) {
                stable = middle;
            } else {
                unstable = middle;
            }
        }
        unstable
    }
}

/// The word for the evidence.
pub const fn evidence(evidence: Evidence) -> &'static str {
    match evidence {
        Evidence::Certified => "certified",
        Evidence::Verified { .. } => "verified",
        _ => "proved",
    }
}

/// Number of intervals of stability in the facts.
const SHOWN: usize = 3;

/// The distance of the points in the search for a limit.
pub const SEARCH: f64 = 1.0 / 64.0;

/// The end of the search for a limit.
pub const FARTHEST: f64 = 8.0;

/// Half-trace from which a maximum may hide a gap.
const NEAR_ONE: f64 = 0.99;

/// The position of the only maximum of a function between `low` and `high`.
fn maximum(mut low: f64, mut high: f64, function: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..60 {
        let [left, right] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
        if function(left) < function(right) {
            low = left;
        } else {
            high = right;
        }
    }
    0.5 * (low + high)
}

/// Whether the norm of the 2²⁴-th power of a matrix, by squaring, is below a thousand.
///
/// This detects an eigenvalue outside the unit circle by 10⁻⁶. With all eigenvalues on it, the powers are bounded by
/// the condition number of the eigenvectors.
fn powers_are_bounded(mut matrix: Matrix2<f64>) -> bool {
    for _ in 0..24 {
        matrix = matrix * matrix;
    }
    matrix.norm() < 1e3
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_powers_of_rotations_are_bounded_and_others_are_not() {
        let turn = |factor: f64| {
            let (sine, cosine) = 0.7_f64.sin_cos();
            Matrix2::new(cosine, sine, -sine, cosine) * factor
        };
        assert!(powers_are_bounded(turn(1.0)));
        assert!(!powers_are_bounded(turn(1.0 + 1e-6)));
        assert!(!powers_are_bounded(Matrix2::new(1.0, 1.0, 0.0, 1.0)));
    }

    #[test]
    fn the_catalogue_is_read() {
        let catalogue = catalogue().expect("the files of the repository");
        let verlet = &catalogue["velocity-verlet"];
        assert_eq!(verlet.proved_limit(), Some(2.0));
        let step = verlet.explicit().expect("an explicit method");
        assert_eq!(step.matrix(0.5), Matrix2::new(0.875, 0.5, -0.46875, 0.875));
        assert!((step.measured_limit() - 2.0).abs() < 1e-5);
        assert!(catalogue["gauss-2"].explicit().is_none());
        assert_eq!(catalogue["gauss-2"].proved_limit(), Some(f64::INFINITY));
        assert!(!catalogue.contains_key("suzuki-10"));
    }
}
