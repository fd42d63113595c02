//! Results computed from a tableau, shared by the plans of both classes.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use proc_macro2::TokenStream;

use super::plan::HalfTableau;
use super::symplectic_rounding::Rounded;
use crate::arithmetic::eigen::{Blocks, Rows};
use crate::tableau::Tableau;

/// Results that plans share: many are the same for both classes of systems, and all occur twice if the two halves of the
/// tableau are equal.
pub struct Known {
    /// Whether `a = ã` and `b = b̃`.
    equal_halves: bool,
    complements: RefCell<BTreeMap<[Term; 2], Complements>>,
    extrapolations: RefCell<BTreeMap<(Half, Groups), Extrapolation>>,
    decoupling: RefCell<Option<(Rows, Option<Blocks>)>>,
    written: RefCell<Vec<(TokenStream, HalfTableau)>>,
}

/// A row of stages of the tableau and the stages that are merged in a column.
pub(super) type Term = (Vec<usize>, Vec<usize>);

/// Stages of the tableau that are merged in each of some evaluations.
pub(super) type Groups = Vec<Vec<usize>>;

/// Two rounded coefficients with the sum 1, if there are any.
pub(super) type Complements = Option<(Rounded, Rounded)>;

/// The matrix that maps the evaluations of a step to those of the next step, if there is one.
pub(super) type Extrapolation = Option<Rc<Vec<Vec<f64>>>>;

/// The half of the tableau that coefficients belong to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Half {
    /// Positions and velocities.
    Positions,
    /// Momenta and forces.
    Momenta,
}

impl Known {
    /// An empty cache.
    pub fn new(tableau: &Tableau) -> Self {
        Known {
            equal_halves: tableau.equal_halves() == (true, true),
            complements: RefCell::default(),
            extrapolations: RefCell::default(),
            decoupling: RefCell::default(),
            written: RefCell::default(),
        }
    }

    /// Two rounded quotients with the sum 1, one of positions and one of momenta. `compute` gets `true` if the two quotients
    /// are the same.
    pub(super) fn complements(
        &self,
        position: Term,
        momentum: Term,
        compute: impl FnOnce(bool) -> Complements,
    ) -> Complements {
        let same = self.equal_halves && position == momentum;
        let key = [position, momentum];
        if let Some(&known) = self.complements.borrow().get(&key) {
            return known;
        }
        let value = compute(same);
        let mut complements = self.complements.borrow_mut();
        if self.equal_halves {
            let [position, momentum] = key.clone();
            complements.insert([momentum, position], value.map(|(x, y)| (y, x)));
        }
        complements.insert(key, value);
        value
    }

    /// The extrapolation of evaluations that belong to these stages.
    pub(super) fn extrapolation(
        &self,
        half: Half,
        stages: Groups,
        compute: impl FnOnce() -> Option<Vec<Vec<f64>>>,
    ) -> Extrapolation {
        let half = if self.equal_halves {
            Half::Positions
        } else {
            half
        };
        let mut extrapolations = self.extrapolations.borrow_mut();
        let known = extrapolations.entry((half, stages));
        known.or_insert_with(|| compute().map(Rc::new)).clone()
    }

    /// The code of a half tableau at `place`; if an equal half has been written already, the place of that half.
    pub(super) fn written(
        &self,
        place: TokenStream,
        half: HalfTableau,
        code: impl FnOnce(&HalfTableau) -> TokenStream,
    ) -> TokenStream {
        let mut written = self.written.borrow_mut();
        if let Some((place, _)) = written.iter().find(|(_, other)| *other == half) {
            return place.clone();
        }
        let code = code(&half);
        written.push((place, half));
        code
    }

    /// The diagonal blocks of a matrix. They are computed again only if the matrix differs from the last one.
    pub(super) fn blocks(
        &self,
        matrix: Rows,
        compute: impl FnOnce(&Rows) -> Option<Blocks>,
    ) -> Option<Blocks> {
        let mut last = self.decoupling.borrow_mut();
        match &*last {
            Some((known, blocks)) if *known == matrix => blocks.clone(),
            _ => {
                let blocks = compute(&matrix);
                *last = Some((matrix, blocks.clone()));
                blocks
            }
        }
    }
}
