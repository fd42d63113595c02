//! Properties that a method has only for separable Hamiltonians.

use std::sync::Arc;

use num_rational::BigRational;

use super::symplectic::decide_matrices;
use super::{Evidence, Examined, Property, Symmetry};
use crate::algebra::{Dense, Field, NodeAlgebra, Zero};
use crate::exact::{Exact, over_algebra};
use crate::hamiltonian_class::HamiltonianClass;
use crate::partitioned::Partitioned;
use crate::schedule::{Class, Groups};

/// Properties of a method for `H = T(p) + U(q)`, which has them for every `H` or for these only.
///
/// There a stage `Q_i` enters only forces, and a stage `P_i` only velocities. So it does not matter which of them have the same number, and
/// a splitting may have different weights for positions and momenta.
///
/// A splitting with gradient kicks has them for quadratic `T` only: see [`SeparableProperties::class`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SeparableProperties {
    /// The class of Hamiltonians: separable ones, or with gradient kicks those with quadratic `T`.
    pub class: HamiltonianClass,
    /// `b_i ã_ij + b̃_j a_ji = b_i b̃_j` (MW 2.6.7; GNI VI.4, Theorem 4.6).
    pub symplectic: Property,
    /// Equal to its adjoint, for some order of the position stages and some order of the momentum stages.
    pub symmetric: Property,
}

impl SeparableProperties {
    /// The names of the properties, as in `require: [symplectic(separable)]`.
    pub const NAMES: [&str; 2] = ["symplectic", "symmetric"];

    /// The property of this name.
    pub fn get(&self, name: &str) -> Option<&Property> {
        let all = [&self.symplectic, &self.symmetric];
        let index = Self::NAMES.iter().position(|known| *known == name)?;
        all.get(index).copied()
    }

    /// Decides both. `symmetric` is the symmetry for every Hamiltonian, as far as known.
    ///
    /// A splitting is symplectic whatever its coefficients are, and gradient kicks are kicks by another potential: with [lower triangular](Partitioned::lower_triangular) matrices one of
    /// `b_i ã_ij` and `b̃_j a_ji` is `b_i b̃_j`, and the other is zero.
    pub(crate) fn of(exact: &Exact, symmetric: Property) -> Self {
        over_algebra!(exact, pair => SeparableProperties::of_pair(pair, symmetric))
    }

    fn of_pair<A: SeparableSymmetry>(pair: &Partitioned<A>, symmetric: Property) -> Self {
        let symplectic = match pair.lower_triangular() {
            Some(_) => Property::holding(Evidence::Proved, None),
            None => decide_matrices(&Examined {
                pair,
                numbers: &pair.numbers(),
            }),
        };
        SeparableProperties {
            class: match pair.gradient {
                Some(_) => HamiltonianClass::Nystrom,
                None => HamiltonianClass::Separable,
            },
            symplectic,
            symmetric: if symmetric.holds {
                symmetric
            } else {
                A::separably_symmetric(pair, symmetric)
            },
        }
    }
}

/// An algebra over which symmetry for separable Hamiltonians can be decided.
pub(crate) trait SeparableSymmetry: Symmetry {
    /// Symmetry for separable Hamiltonians of a pair that is not known to be symmetric for all.
    fn separably_symmetric(pair: &Partitioned<Self>, for_all: Property) -> Property;
}

impl SeparableSymmetry for NodeAlgebra {
    /// Not looked for: the tableaux of this algebra have equal weights, and no splitting is among them.
    fn separably_symmetric(_pair: &Partitioned<Self>, for_all: Property) -> Property {
        for_all
    }
}

impl<F: Field + Clone> SeparableSymmetry for Dense<F> {
    /// For separable Hamiltonians this method equals one with a stage for each distinct position and one for each distinct momentum. An
    /// order of its stages is an order of each kind.
    fn separably_symmetric(pair: &Partitioned<Self>, _for_all: Property) -> Property {
        // Flows are their own adjoints.
        if pair.flows().is_some_and(|flows| flows.is_palindrome()) {
            return Property::holding(Evidence::Proved, None);
        }
        if pair.gradient.is_some() {
            return Property::refuted("the kicks and drifts are not a palindrome".to_owned());
        }
        let apart = apart(pair);
        let mut symmetric = Self::symmetric(&apart, &apart.numbers());
        if symmetric.evidence == Evidence::Refuted {
            let witness = "no order of the position stages and of the momentum stages makes the tableau equal to its adjoint";
            symmetric.witness = Some(witness.to_owned());
        }
        symmetric
    }
}

/// The distinct used position stages of a pair, and then the momentum stages, as separate stages.
///
/// What the force does not see of a momentum stage, and the velocity of a position stage, has no weight; the
/// coefficients that it never meets are half the weights, which are their own in the adjoint.
fn apart<F: Field + Clone>(pair: &Partitioned<Dense<F>>) -> Partitioned<Dense<F>> {
    let field = pair.algebra.field();
    let groups = Groups::new(Class::Separable, pair);
    let zero = field.rational(&BigRational::default());
    let sum = |values: &[F::Element], group: &[usize]| {
        let values = group.iter().map(|&i| &values[i]);
        values.fold(zero.clone(), |sum, value| field.add(&sum, value))
    };
    let rows = |matrix: &[Vec<F::Element>], stages: &[Vec<usize>], evaluations: &[Vec<usize>]| {
        let row = |stage: &Vec<usize>| -> Vec<F::Element> {
            let row = &matrix[stage[0]];
            evaluations.iter().map(|group| sum(row, group)).collect()
        };
        stages.iter().map(row).collect::<Vec<_>>()
    };
    let positions = rows(&pair.a, &groups.positions, &groups.velocities);
    let momenta = rows(&pair.a_tilde, &groups.momenta, &groups.forces);
    let total = |weights: &[F::Element], groups: &[Vec<usize>]| -> Vec<F::Element> {
        groups.iter().map(|group| sum(weights, group)).collect()
    };
    let b = total(&pair.b, &groups.velocities);
    let b_tilde = total(&pair.b_tilde, &groups.forces);

    let counts = |x: &F::Element| field.zero(x) != Zero::Yes;
    let mut forces: Vec<bool> = b_tilde.iter().map(counts).collect();
    let mut velocities: Vec<bool> = b.iter().map(counts).collect();
    loop {
        let needed = |used: &[bool], rows: &[Vec<F::Element>], index: usize| {
            let mut rows = rows.iter().zip(used);
            rows.any(|(row, used)| *used && counts(&row[index]))
        };
        let more = |known: &[bool], used: &[bool], rows: &[Vec<F::Element>]| -> Vec<bool> {
            let each = known.iter().enumerate();
            each.map(|(i, known)| *known || needed(used, rows, i))
                .collect()
        };
        let (f, v) = (
            more(&forces, &velocities, &momenta),
            more(&velocities, &forces, &positions),
        );
        if f == forces && v == velocities {
            break;
        }
        (forces, velocities) = (f, v);
    }
    let kept = |used: &[bool]| -> Vec<usize> { (0..used.len()).filter(|&i| used[i]).collect() };
    let (forces, velocities) = (kept(&forces), kept(&velocities));

    let half = field.rational(&BigRational::new(1.into(), 2.into()));
    let halves = |b: &F::Element| field.multiply(&half, b);
    // The stages with forces first, then those with velocities.
    let weights =
        |b: &[F::Element], own: &[usize], before: usize, after: usize| -> Vec<F::Element> {
            let own = own.iter().map(|&j| b[j].clone());
            let before = std::iter::repeat_n(zero.clone(), before);
            before
                .chain(own)
                .chain(std::iter::repeat_n(zero.clone(), after))
                .collect()
        };
    let (n, m) = (forces.len(), velocities.len());
    let (b, b_tilde) = (
        weights(&b, &velocities, n, 0),
        weights(&b_tilde, &forces, 0, m),
    );
    let position = |i: usize| weights(&positions[i], &velocities, n, 0);
    let momentum = |i: usize| weights(&momenta[i], &forces, 0, m);
    let (half_b, half_b_tilde): (Vec<_>, Vec<_>) = (
        b.iter().map(halves).collect(),
        b_tilde.iter().map(halves).collect(),
    );
    let a = forces.iter().map(|&i| position(i));
    let a_tilde = velocities.iter().map(|&i| momentum(i));
    Partitioned {
        algebra: Arc::new(Dense::new(field.clone(), n + m)),
        a: a.chain(std::iter::repeat_n(half_b, m)).collect(),
        a_tilde: std::iter::repeat_n(half_b_tilde, n)
            .chain(a_tilde)
            .collect(),
        b,
        b_tilde,
        gradient: None,
    }
}
