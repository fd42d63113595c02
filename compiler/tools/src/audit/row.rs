//! One table: the claimed, the proved and the observed order.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Zero};
use serde::{Serialize, Serializer};

use crate::import::{Numbers, Origin};
use symplectic_compiler::Error;
use symplectic_compiler::Limits;
use symplectic_compiler::inside::evidence_text;
use symplectic_compiler::order::{ClassOrder, HamiltonianClass, Pendulum};

/// The largest accepted difference between the observed and the proved order.
const TOLERANCE: f64 = 0.05;

/// The data common to the tables of a file.
pub(super) struct Source {
    pub library: String,
    pub version: String,
    pub source: String,
    pub convention: String,
}

/// The claim of a library about a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Claim {
    /// The order.
    pub order: usize,
    /// The class of Hamiltonians.
    #[serde(serialize_with = "class_name")]
    pub class: HamiltonianClass,
}

fn class_name<S: Serializer>(class: &HamiltonianClass, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(class.name())
}

/// The proved order compared with the claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The orders agree.
    AsClaimed,
    /// The proved order is lower.
    LessThanClaimed,
    /// The proved order is higher.
    MoreThanClaimed,
}

/// The order for a class, with its evidence.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ProvedOrder {
    /// The order.
    pub order: usize,
    /// The evidence: proved, certified for the exact method near the decimals, or verified to some binary places.
    pub evidence: String,
    /// The tree of the first violated condition.
    pub violated: Option<String>,
    /// The elementary weight minus its required value.
    pub residual: Option<String>,
}

impl ProvedOrder {
    fn new(found: &ClassOrder) -> Self {
        let violated = found.refuted_by.as_ref();
        ProvedOrder {
            order: found.order,
            evidence: evidence_text(found.evidence),
            violated: violated.map(|violated| violated.tree.to_string()),
            residual: violated.map(|violated| violated.residual.clone()),
        }
    }
}

/// A table of a library.
#[derive(Debug, Clone, Serialize)]
pub struct Row {
    /// The library.
    pub library: String,
    /// Its version.
    pub version: String,
    /// The source of the numbers.
    pub source: String,
    /// How the library steps the numbers, and where it documents that.
    pub convention: String,
    /// The name of the table there.
    pub name: String,
    /// The claim of the library.
    pub claim: Claim,
    /// A remark in the file.
    pub note: Option<String>,
    /// The number of stages.
    pub stages: usize,
    /// The kind of the numbers: exact (also decimals that satisfy their order conditions as they are written), decimals of an exact method, or decimals near which no exact method was found.
    pub numbers: String,
    /// For every Hamiltonian.
    pub general: ProvedOrder,
    /// For `H = T(p) + U(q)`.
    pub separable: ProvedOrder,
    /// For quadratic `T`.
    pub nystrom: ProvedOrder,
    /// Whether it is symmetric, at least for separable Hamiltonians.
    pub symmetric: bool,
    /// Whether it is symplectic, at least for separable Hamiltonians.
    pub symplectic: bool,
    /// The decimal places in which the printed numbers agree with the exact method, and the number of printed places. `None` if the numbers
    /// are exact or if no exact method was found.
    /// If the conditions leave coefficients free, another exact method may agree in more places.
    pub right_places: Option<(u32, u32)>,
    /// The stable steps `hω` on the oscillator.
    pub stable: String,
    /// The order observed on the pendulum with `H = p²/2 − cos q`.
    pub seen_quadratic: Option<f64>,
    /// The order observed on the pendulum with `H = √(1 + p²) − cos q`.
    pub seen_relativistic: Option<f64>,
    /// The order observed on the pendulum with `H = √(1 + p²) (2 − cos q)`, which is not separable.
    pub seen_coupled: Option<f64>,
    /// The proved order compared with the claim.
    pub verdict: Verdict,
    /// Whether the proved orders agree with the observed orders, and with those of the printed numbers up to their rounding.
    pub explained: bool,
}

impl Row {
    pub(super) fn new(
        source: &Source,
        name: &str,
        claim: Claim,
        note: Option<String>,
        numbers: &Numbers,
        limits: &Limits,
    ) -> Result<Self, Error> {
        let read = numbers.derive(limits)?;
        let tableau = &read.tableau;
        let orders = tableau.orders();
        let mut proved = HamiltonianClass::ALL.map(|class| ProvedOrder::new(orders.class(class)));
        // The conditions violated by the printed numbers, rather than those that the exact method near them violates by less.
        let within = match &read.origin {
            Origin::Exact => None,
            Origin::Refined(within, _) | Origin::Decimals(within) => Some(within),
        };
        let mut agree = true;
        for (found, (order, violated)) in proved.iter_mut().zip(within.into_iter().flatten()) {
            if let Some(violated) = violated {
                found.violated = Some(violated.tree.to_string());
                found.residual = Some(violated.residual.clone());
            }
            if matches!(read.origin, Origin::Decimals(_)) {
                found.order = *order;
                found.evidence = "up to the rounding of the decimals".to_owned();
            }
            // Conditions of the decimals are computed up to a limit; the order of the exact method may be higher.
            agree &= found.order == *order || violated.is_none() && found.order > *order;
        }
        let [general, separable, nystrom] = proved;
        let seen = |pendulum, order: usize| tableau.observed_order(pendulum, order);
        let seen_coupled = seen(Pendulum::Coupled, general.order);
        let seen_relativistic = seen(Pendulum::Relativistic, separable.order);
        let seen_quadratic = seen(Pendulum::Quadratic, nystrom.order);
        let agrees = |seen: Option<f64>, proved: usize| {
            seen.is_some_and(|seen| (seen - proved as f64).abs() <= TOLERANCE)
        };
        let proved = match claim.class {
            HamiltonianClass::General => general.order,
            HamiltonianClass::Separable => separable.order,
            HamiltonianClass::Nystrom => nystrom.order,
        };
        let separable_properties = tableau.separable_properties();
        let refined = matches!(read.origin, Origin::Refined(..));
        let right_places = match numbers.distance(tableau) {
            Some(distance) if refined => {
                let printed = numbers.all().into_iter().filter(|value| !value.is_exact());
                let finest = printed
                    .map(|value| value.error.clone())
                    .min()
                    .unwrap_or_default();
                let printed = places(&finest);
                Some((places(&distance).min(printed), printed))
            }
            _ => None,
        };
        Ok(Row {
            library: source.library.clone(),
            version: source.version.clone(),
            source: source.source.clone(),
            convention: source.convention.clone(),
            name: name.to_owned(),
            claim,
            note,
            stages: tableau.stages(),
            numbers: match read.origin {
                Origin::Exact => "exact",
                Origin::Refined(..) => "decimals of an exact method that is proved to exist",
                Origin::Decimals(_) => "decimals near which no exact method was found",
            }
            .to_owned(),
            verdict: match proved.cmp(&claim.order) {
                std::cmp::Ordering::Less => Verdict::LessThanClaimed,
                std::cmp::Ordering::Equal => Verdict::AsClaimed,
                std::cmp::Ordering::Greater => Verdict::MoreThanClaimed,
            },
            explained: agree
                && agrees(seen_quadratic, nystrom.order)
                && agrees(seen_relativistic, separable.order)
                && agrees(seen_coupled, general.order),
            symmetric: separable_properties.symmetric.holds,
            symplectic: separable_properties.symplectic.holds,
            stable: tableau.stable_steps().to_string(),
            right_places,
            general,
            separable,
            nystrom,
            seen_quadratic,
            seen_relativistic,
            seen_coupled,
        })
    }

    /// The proved order for the class of the claim.
    pub fn proved(&self) -> &ProvedOrder {
        match self.claim.class {
            HamiltonianClass::General => &self.general,
            HamiltonianClass::Separable => &self.separable,
            HamiltonianClass::Nystrom => &self.nystrom,
        }
    }
}

/// The number of correct decimal places for an error.
fn places(error: &BigRational) -> u32 {
    /// More than in any table.
    const MAX_PLACES: u32 = 200;
    let half = BigRational::new(BigInt::one(), 2.into());
    if error.is_zero() {
        return MAX_PLACES;
    }
    let right =
        |places: u32| *error <= &half / BigRational::from_integer(BigInt::from(10).pow(places));
    (1..=MAX_PLACES)
        .take_while(|&places| right(places))
        .last()
        .unwrap_or(0)
}
