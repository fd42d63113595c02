//! What has been worked out of a tableau, for the plans of both classes.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use proc_macro2::TokenStream;

use super::plan::HalfTableau;
use super::symplectic_rounding::Rounded;
use crate::arithmetic::eigen::{Blocks, Rows};
use crate::tableau::Tableau;

/// Results that plans share, since much is the same for both classes of systems, and all is twice the same where both
/// halves of a tableau are.
pub(crate) struct Known {
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

/// Two rounded coefficients that make 1, if they do.
pub(super) type Complements = Option<(Rounded, Rounded)>;

/// The matrix that takes the evaluations of a step to those of the next, if there is one.
pub(super) type Extrapolation = Option<Rc<Vec<Vec<f64>>>>;

/// What the coefficients of a half of the tableau belong to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Half {
    /// Positions and velocities.
    Positions,
    /// Momenta and forces.
    Momenta,
}

impl Known {
    /// Nothing yet.
    pub(crate) fn new(tableau: &Tableau) -> Self {
        Known {
            equal_halves: tableau.equal_halves() == (true, true),
            complements: RefCell::default(),
            extrapolations: RefCell::default(),
            decoupling: RefCell::default(),
            written: RefCell::default(),
        }
    }

    /// Two rounded quotients that make 1, of a position and of a momentum. With `true`, `compute` has to round two that
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

    /// The code of half a tableau at this place in the code: where the same is written already, its place.
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

    /// The blocks of a matrix on the diagonal, which are computed when it is another one than the last.
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
