//! The gravity between planets.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

use super::bodies::Bodies;
use super::groups::{Axes, load, load_one, store};
use crate::{FlowError, check_dimension};
use symplectic_core::inside::array;
use symplectic_core::simd::{F64x4, Lanes};
use symplectic_core::{Quantity, Scalar, Vector};

/// The positions of n planets, and the forces on them.
#[derive(Clone, Debug)]
pub(super) struct Attraction {
    gravity: f64,
    count: usize,
    /// The positions; planet k is also stored at k + n, k + 2n, ….
    places: Axes,
    /// The masses, likewise.
    masses: Vec<f64>,
    pub(super) forces: Axes,
    /// The forces on the first planet of each pair (k, k + d) for the present d; the last d of them are repeated before the first.
    pulls: Axes,
    /// The sum of the pulls on the second planet of each pair, with the opposite sign.
    reactions: Axes,
}

/// Pairs in lanes.
pub(super) type Group = F64x4;
const WIDTH: usize = Group::WIDTH;

impl Attraction {
    pub(super) fn new(bodies: &Bodies) -> Self {
        let count = bodies.masses.len() - 1;
        let (padded, half) = (count.next_multiple_of(WIDTH), count / 2);
        let masses = bodies.masses[1..].iter().cycle().copied();
        let axes = |length: usize| [0; 3].map(|_| vec![0.0; length]);
        Self {
            gravity: bodies.gravity,
            count,
            places: axes(padded + half),
            masses: masses.take(padded + half).collect(),
            forces: axes(padded),
            pulls: axes(half + padded),
            reactions: axes(padded),
        }
    }

    /// The number of planets.
    pub(super) const fn count(&self) -> usize {
        self.count
    }

    /// Checks that the dimension of a state fits these bodies.
    pub(super) fn check<V: Vector<Scalar = f64>>(&self, q: &V, p: &V) -> Result<(), FlowError> {
        check_dimension(3 * (self.count + 1), q)?;
        check_dimension(3 * (self.count + 1), p)
    }

    /// Stores the position of a planet.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn put(&mut self, planet: usize, place: [f64; 3]) {
        for (list, x) in self.places.iter_mut().zip(place) {
            let mut at = planet;
            while let Some(entry) = list.get_mut(at) {
                *entry = x;
                at += self.count;
            }
        }
    }

    /// The position of a planet.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn place(&self, planet: usize) -> [f64; 3] {
        let [x, y, z] = &self.places;
        [x[planet], y[planet], z[planet]]
    }

    /// The positions of several planets in lanes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn places(&self, first: usize) -> [Group; 3] {
        load(&self.places, first)
    }

    /// Adds the forces of gravity between the planets. They are not finite if two planets are at the same position.
    ///
    /// The pairs of planets (k, k + d) are computed in lanes, for d = 1, …, n/2; for `2d = n` each pair occurs twice, once from either side.
    pub(super) fn attract(&mut self) {
        let count = self.count;
        let half = count / 2;
        let starts = (0..count).step_by(WIDTH);
        let (gravity, zero) = (Group::from_f64(self.gravity), Group::from_f64(0.0));
        for apart in 1..=half {
            for first in starts.clone() {
                let here: [Group; 3] = load(&self.places, first);
                let there: [Group; 3] = load(&self.places, first + apart);
                let own: Group = load_one(&self.masses, first);
                let other: Group = load_one(&self.masses, first + apart);
                let way = array(zero, |axis| there[axis] - here[axis]);
                let pull = pull(gravity * own * other, way, zero);
                let before: [Group; 3] = load(&self.forces, first);
                let sum = array(zero, |axis| before[axis] + pull[axis]);
                store(&mut self.forces, first, sum);
                store(&mut self.pulls, half + first, pull);
            }
            if 2 * apart == count {
                break;
            }
            for axis in 0..3 {
                let list = &mut self.pulls[axis][..half + count];
                for k in 0..apart {
                    list[half - apart + k] = list[half + count - apart + k];
                }
            }
            for first in starts.clone() {
                let back: [Group; 3] = load(&self.pulls, half - apart + first);
                let before: [Group; 3] = match apart {
                    1 => [zero; 3],
                    _ => load(&self.reactions, first),
                };
                let sum = array(zero, |axis| before[axis] + back[axis]);
                store(&mut self.reactions, first, sum);
            }
        }
        for first in starts.clone() {
            let own: [Group; 3] = load(&self.forces, first);
            let back: [Group; 3] = load(&self.reactions, first);
            let force = array(zero, |axis| own[axis] - back[axis]);
            store(&mut self.forces, first, force);
        }
    }

    /// Why forces are not finite: two planets coincide, or the star, if given, coincides with a planet other than the first.
    #[cold]
    pub(super) fn failure(&self, star: Option<[f64; 3]>) -> FlowError {
        let count = self.count;
        let meets = |place: [f64; 3], mut others: Range<usize>| {
            others.find(|&other| {
                let way = array(0.0, |axis| self.place(other)[axis] - place[axis]);
                let [x, y, z]: [f64; 3] = way;
                x * x + y * y + z * z == 0.0
            })
        };
        let by_star = star.and_then(|star| Some((0, meets(star, 1..count)?)));
        let mut pairs =
            (0..count).filter_map(|i| Some((i + 1, meets(self.place(i), i + 1..count)?)));
        match by_star.or_else(|| pairs.next()) {
            Some((first, other)) => FlowError::Collision {
                first,
                second: other + 1,
            },
            None => FlowError::NonFinite {
                what: Quantity::Force,
            },
        }
    }
}

/// `strength · way/|way|³`; `more` is added to `|way|²`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn pull<L: Lanes>(strength: L, way: [L; 3], more: L) -> [L; 3] {
    let [x, y, z] = way;
    let square = (x * x + y * y) + (z * z + more);
    let pull = strength / (square * square.sqrt());
    [pull * x, pull * y, pull * z]
}
