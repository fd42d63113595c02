//! What a tableau is, decided in exact arithmetic and returned with evidence.
//!
//! One property a file; each decides itself from the exact coefficients and trusts nothing about how
//! they were derived.

mod consistent;
mod constrained;
mod end_stages;
mod equal_matrices;
mod explicit;
mod nonholonomic;
mod positive_weights;
mod separable;
mod symmetric;
mod symplectic;

use std::borrow::Cow;
use std::fmt;

pub(crate) use self::constrained::{from_start_to_end, multiplier_matrix};
pub(crate) use self::nonholonomic::has_steps;
pub use self::separable::SeparableProperties;
pub(crate) use self::symmetric::Symmetry;
pub use self::symmetric::images;
use crate::algebra::{Number, StageAlgebra, Zero};
use crate::coefficients::{Coefficients, subscript};
use crate::evidence::{Evidence, evidence_text};
use crate::exact::{Exact, over_algebra};
use crate::partitioned::Partitioned;

/// Whether a property holds, how that is known, and an example.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Property {
    /// Whether it holds.
    pub holds: bool,
    /// How that is known.
    pub evidence: Evidence,
    /// For a refuted property, where it fails; for one that holds, what makes it so where that is of
    /// use (the order of the stages, say).
    pub witness: Option<String>,
}

impl Property {
    pub(crate) fn holding(evidence: Evidence, witness: Option<String>) -> Self {
        Property {
            holds: true,
            evidence,
            witness,
        }
    }

    fn undecided(bits: u32, witness: String) -> Self {
        Property {
            holds: false,
            evidence: Evidence::Undecided { bits },
            witness: Some(witness),
        }
    }

    pub(crate) fn refuted(witness: String) -> Self {
        Property {
            holds: false,
            evidence: Evidence::Refuted,
            witness: Some(witness),
        }
    }
}

impl fmt::Display for Property {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !matches!(self.evidence, Evidence::Undecided { .. }) {
            f.write_str(if self.holds { "yes, " } else { "no, " })?;
        }
        match self.evidence {
            Evidence::Proved => f.write_str("proved")?,
            Evidence::Certified => f.write_str("certified")?,
            Evidence::Refuted => f.write_str("refuted")?,
            known => f.write_str(&evidence_text(known))?,
        }
        self.witness
            .as_ref()
            .map_or(Ok(()), |witness| write!(f, ": {witness}"))
    }
}

macro_rules! properties {
    ($($(#[$doc:meta])* $name:ident: $decide:path;)*) => {
        /// All properties of a tableau.
        #[derive(Debug, Clone, PartialEq, Eq)]
        pub struct Properties {
            $($(#[$doc])* pub $name: Property,)*
        }

        impl Properties {
            /// The names of the properties, as in `require: […]` and in the exports.
            pub const NAMES: &[&str] = &[$(stringify!($name)),*];

            fn decide<A: Symmetry>(examined: &Examined<'_, A>) -> Self {
                Properties { $($name: $decide(examined),)* }
            }

            /// Every property with its name.
            pub fn all(&self) -> Vec<(&'static str, &Property)> {
                vec![$((stringify!($name), &self.$name)),*]
            }

            /// The property of this name.
            pub fn get(&self, name: &str) -> Option<&Property> {
                self.all().into_iter().find(|(known, _)| *known == name).map(|(_, property)| property)
            }
        }
    };
}

properties! {
    /// `b_i ã_ij + b̃_j a_ji = b_i b̃_j` and `b_i = b̃_i` (MW 2.6.7): symplectic for every Hamiltonian.
    symplectic: symplectic::decide;
    /// Equal to its adjoint, for some order of the stages.
    symmetric: symmetric::decide;
    /// `Σ_i b_i = Σ_i b̃_i = 1`: order at least 1.
    consistent: consistent::decide;
    /// `ã = a` and `b̃ = b`: a Runge–Kutta method, the same for positions and momenta.
    equal_matrices: equal_matrices::decide;
    /// For separable `H = T(p) + U(q)` the stages can be computed one after another.
    explicit: explicit::decide;
    /// `a_1j = 0`: the first position stage is `q0`.
    first_row_zero: end_stages::first_row_zero;
    /// `a_sj = b_j`: the last position stage is `q1`.
    stiffly_accurate: end_stages::stiffly_accurate;
    /// The last position stage of a step is the first of the next.
    first_same_as_last: end_stages::first_same_as_last;
    /// `b_i > 0` and `b̃_i > 0`.
    positive_weights: positive_weights::decide;
    /// Steps systems with holonomic constraints: `b_i = b̃_i ≠ 0`, symplectic, `a_1j = 0`, `a_sj = b_j` and
    /// `det (A Ã) ≠ 0` for the rows 2..s and the columns 1..s−1 (MW 3.5.6), with the stages counted from the start to the end of the step;
    /// or a composition of such methods. The order with constraints is no part of this property.
    constrained: constrained::decide;
    /// Steps systems with non-holonomic constraints without loss of order: `b_i = b̃_i ≠ 0`, symplectic, and symmetric of order 2, or of
    /// order 1; or a composition that has its order with any steps of order 2 for symmetric methods and of order 1 for others.
    nonholonomic: nonholonomic::decide;
}

impl Properties {
    /// Decides all properties of a method by its coefficients.
    pub(crate) fn of(exact: &Exact) -> Self {
        over_algebra!(exact, pair => Properties::of_pair(pair))
    }

    pub(crate) fn of_pair<A: Symmetry>(pair: &Partitioned<A>) -> Self {
        let numbers = &pair.numbers();
        Properties::decide(&Examined { pair, numbers })
    }
}

/// Decides the symmetry alone.
pub(crate) fn symmetric(exact: &Exact) -> Property {
    over_algebra!(exact, pair => symmetric::decide(&Examined { pair, numbers: &pair.numbers() }))
}

/// A pair with its coefficients as numbers, which several properties look at.
struct Examined<'a, A: StageAlgebra> {
    pair: &'a Partitioned<A>,
    numbers: &'a Coefficients<Number<'a>>,
}

/// Why a property of methods for other Hamiltonians is not one of a method with gradient kicks.
pub(crate) const GRADIENT_KICKS: &str = "gradient kicks need quadratic T";

impl<A: StageAlgebra> Examined<'_, A> {
    /// The refutation of a property of methods for all Hamiltonians: gradient kicks are for quadratic `T` only.
    fn refuted_by_gradient_kicks(&self) -> Option<Property> {
        let found = self.pair.gradient.as_ref();
        found.map(|_| Property::refuted(GRADIENT_KICKS.to_owned()))
    }
}

/// Decides whether numbers are all zero: the evidence that they are, or the first that is not.
fn vanishing<'a, 'n: 'a>(
    numbers: impl IntoIterator<Item = &'a Number<'n>>,
) -> Result<Evidence, usize> {
    let mut evidence = Evidence::Proved;
    for (index, number) in numbers.into_iter().enumerate() {
        match number.zero() {
            Zero::Yes => {}
            Zero::Within(bits) => evidence = evidence.and(Evidence::Verified { bits }),
            Zero::No => return Err(index),
        }
    }
    Ok(evidence)
}

/// How it is known that a matrix vanishes, or its first entry that does not.
pub(crate) fn vanishing_matrix<A: StageAlgebra>(
    algebra: &A,
    residual: &A::Matrix,
) -> Result<Evidence, Entry> {
    let mut evidence = Evidence::Proved;
    for i in 0..algebra.stages() {
        let numbers = algebra.row(residual, i);
        let row = vanishing(&numbers).map_err(|j| {
            let exact = algebra.exact_entries(residual)[i].swap_remove(j);
            Entry {
                index: subscript(i + 1, j + 1),
                transposed: subscript(j + 1, i + 1),
                row: i + 1,
                column: j + 1,
                value: exact.unwrap_or_else(|| shown(&numbers[j])),
            }
        })?;
        evidence = evidence.and(row);
    }
    Ok(evidence)
}

/// How it is known that a vector vanishes, or its first value that does not with its stage, counted
/// from 1.
pub(crate) fn vanishing_vector<A: StageAlgebra>(
    algebra: &A,
    residual: &A::Vector,
) -> Result<Evidence, (usize, String)> {
    let numbers = algebra.values(Cow::Borrowed(residual));
    vanishing(&numbers).map_err(|index| {
        let exact = algebra.exact_values(residual).swap_remove(index);
        (index + 1, exact.unwrap_or_else(|| shown(&numbers[index])))
    })
}

/// An entry of a matrix, for a message.
pub(crate) struct Entry {
    /// The index of the entry: `12`.
    index: String,
    /// The index of its mirror image: `21`.
    transposed: String,
    /// The row, counted from 1.
    row: usize,
    /// The column, counted from 1.
    column: usize,
    /// The value.
    value: String,
}

/// A number for a message: a short rational exactly, anything else by its first digits.
pub(crate) fn shown(number: &Number<'_>) -> String {
    number.short_rational().map_or_else(
        || format!("{}…", number.decimal(12)),
        |value| value.to_string(),
    )
}
