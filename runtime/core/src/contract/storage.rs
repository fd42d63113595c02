//! The memory of a step.

#[cfg(feature = "alloc")]
use alloc::sync::Arc;
use core::array;

use core::mem;

#[cfg(feature = "alloc")]
use crate::contract::CoupledRows;
use crate::contract::StoredEvaluations;
use crate::error::Quantity;
use crate::number::vector::LIGHT;
use crate::number::{Scalar, Vector, Visit};

/// Memory of one [`Plan`](crate::emitted::Plan), allocated once and used for every step.
pub trait StageStorage<V: Vector>: Sized + Clone {
    /// Whether copies of it allocate, because its stages are counted only at run time.
    const AT_RUN_TIME: bool = false;

    /// Storage for vectors of the dimension of `prototype`; every component is zero.
    fn like(prototype: &V) -> Self;

    /// Storage [like](Self::like) `prototype` for the same method.
    fn anew(&self, prototype: &V) -> Self {
        Self::like(prototype)
    }

    /// The rows of the stages, if they are known only at run time.
    #[cfg(feature = "alloc")]
    #[doc(hidden)]
    fn rows(&self) -> Option<&Arc<CoupledRows>> {
        None
    }

    /// Discards everything that earlier steps left.
    fn forget(&mut self, prototype: &V) {
        *self = self.anew(prototype);
    }

    /// Passes all numbers that a step leaves for the next one to `visit`: a checkpoint holds them.
    fn words(&mut self, visit: &mut Visit<'_>);

    /// Passes copies of the same numbers in the same order to `visit`. Long vectors should not be cloned for it.
    fn show_words(&self, visit: &mut Visit<'_>) {
        self.clone().words(visit);
    }

    /// Shows `visit` the coupled stages, if there are any.
    #[cfg(feature = "alloc")]
    #[doc(hidden)]
    fn stages(&mut self, _visit: &mut StageVisit<'_>) {}

    /// The first evaluation that is not finite although its stage value is: the quantity and the number of the stage, from 1. If a force
    /// and a velocity have the same number, the force. `None` if stages are not stored.
    fn non_finite(&self) -> Option<(Quantity, usize)>;

    /// The number of the first stage, from 1, whose force is not finite. The positions are not checked: a sweep has moved them since.
    fn non_finite_force(&self) -> Option<usize> {
        None
    }

    /// The first evaluation whose dimension is not `dimension`: the quantity, the number of the stage and the dimension found. Stages are
    /// numbered from 1; outside the stages the number is 0.
    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)>;
}

/// A part of the memory of coupled stages.
#[cfg(feature = "alloc")]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StagePart {
    /// The positions of the stages.
    Positions,
    /// The momenta of the stages.
    Momenta,
    /// The velocities, or the increments computed from them.
    Velocities,
    /// The forces, or the increments computed from them.
    Forces,
    /// The velocity at the start of the step, if momenta are eliminated.
    Start,
}

/// Called with the part, the stage, the component, and the number there.
#[cfg(feature = "alloc")]
pub type StageVisit<'a> = dyn FnMut(StagePart, usize, usize, &mut f64) + 'a;

/// Visits a copy of the stages on the stack: stages to which no pointer exists can stay in registers from step to step.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn aside<M: Clone, T>(stages: &M, look: impl FnOnce(&M) -> T) -> T {
    match mem::needs_drop::<M>() || size_of::<M>() > LIGHT {
        true => look(stages),
        false => look(&stages.clone()),
    }
}

/// [`StageStorage::words`] and [`StageStorage::show_words`] of these fields. A field is a `memory` or an `optional memory`, consists of
/// `vectors`, is a single `vector`, or a `number`.
macro_rules! stored_words {
    ($($field:tt: $($kind:ident)+;)+) => {
        fn words(&mut self, visit: &mut $crate::number::Visit<'_>) {
            $($crate::contract::storage::stored_words!(@change $($kind)+, self.$field, visit);)+
        }

        fn show_words(&self, visit: &mut $crate::number::Visit<'_>) {
            $($crate::contract::storage::stored_words!(@show $($kind)+, self.$field, visit);)+
        }
    };
    (@change memory, $field:expr, $visit:ident) => { $field.words($visit) };
    (@show memory, $field:expr, $visit:ident) => { $field.show_words($visit) };
    (@change optional memory, $field:expr, $visit:ident) => {
        if let Some(memory) = &mut $field {
            memory.words($visit);
        }
    };
    (@show optional memory, $field:expr, $visit:ident) => {
        if let Some(memory) = &$field {
            memory.show_words($visit);
        }
    };
    (@change vectors, $field:expr, $visit:ident) => { $crate::number::vector_words($field.as_mut(), $visit) };
    (@show vectors, $field:expr, $visit:ident) => { $crate::number::words::show_vectors($field.as_ref(), $visit) };
    (@change vector, $field:expr, $visit:ident) => {
        $crate::number::vector_words(core::slice::from_mut(&mut $field), $visit)
    };
    (@show vector, $field:expr, $visit:ident) => {
        $crate::number::words::show_vectors(core::slice::from_ref(&$field), $visit)
    };
    (@change number, $field:expr, $visit:ident) => { $crate::number::Words::words(&mut $field, $visit) };
    // The visitor sees a copy.
    (@show number, $field:expr, $visit:ident) => { $crate::number::Words::words(&mut { $field }, $visit) };
}
pub(crate) use stored_words;

/// The memories of two plans.
impl<V: Vector, A: StageStorage<V>, B: StageStorage<V>> StageStorage<V> for (A, B) {
    fn like(prototype: &V) -> Self {
        (A::like(prototype), B::like(prototype))
    }

    stored_words! { 0: memory; 1: memory; }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        self.0.non_finite().or_else(|| self.1.non_finite())
    }

    #[inline]
    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        let first = self.0.mismatch(dimension);
        first.or_else(|| self.1.mismatch(dimension))
    }
}

/// The memory of a splitting: the latest evaluation of each kind.
#[derive(Clone, Debug)]
pub struct Evaluations<V> {
    /// The latest ∂H/∂p.
    pub velocity: V,
    /// The latest −∂H/∂q.
    pub force: V,
}

impl<V: Vector> StageStorage<V> for Evaluations<V> {
    fn like(prototype: &V) -> Self {
        Self {
            velocity: prototype.zeros_like(),
            force: prototype.zeros_like(),
        }
    }

    stored_words! { velocity: vector; force: vector; }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        None
    }

    #[inline]
    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        let (force, velocity) = (&self.force, &self.velocity);
        first_mismatch(array::from_ref(force), array::from_ref(velocity), dimension)
    }
}

/// `Q` positions with a force each, and `P` momenta with a velocity each.
///
/// For a separable system equal stages are stored once, so `Q` and `P` may differ and may be smaller than the number of stages. A stage
/// that equals the start or the result of the step is not stored, and its place stays unused.
#[derive(Clone, Debug)]
pub struct Stages<V, const Q: usize, const P: usize> {
    /// Stage positions Q_i.
    pub q: [V; Q],
    /// Stage momenta P_i.
    pub p: [V; P],
    /// ∂H/∂p at the stage momenta, or the increments computed from it.
    pub velocity: [V; P],
    /// −∂H/∂q at the stage positions, or the increments computed from it.
    pub force: [V; Q],
}

impl<V, const Q: usize, const P: usize> Stages<V, Q, P> {
    /// The velocities and the forces, with the numbers of those that are carried to the next step.
    pub const fn stored(
        &self,
        velocities: &'static [usize],
        forces: &'static [usize],
    ) -> [StoredEvaluations<'_, V>; 2] {
        [
            StoredEvaluations {
                values: &self.velocity,
                carried: velocities,
            },
            StoredEvaluations {
                values: &self.force,
                carried: forces,
            },
        ]
    }
}

impl<V: Vector, const Q: usize, const P: usize> StageStorage<V> for Stages<V, Q, P> {
    fn like(prototype: &V) -> Self {
        Self {
            q: array::from_fn(|_| prototype.zeros_like()),
            p: array::from_fn(|_| prototype.zeros_like()),
            velocity: array::from_fn(|_| prototype.zeros_like()),
            force: array::from_fn(|_| prototype.zeros_like()),
        }
    }

    stored_words! { q: vectors; p: vectors; velocity: vectors; force: vectors; }

    fn non_finite(&self) -> Option<(Quantity, usize)> {
        first_non_finite((&self.q, &self.force), (&self.p, &self.velocity))
    }

    fn non_finite_force(&self) -> Option<usize> {
        first_non_finite_of(&self.force)
    }

    #[inline]
    fn mismatch(&self, dimension: usize) -> Option<(Quantity, usize, usize)> {
        first_mismatch(&self.force, &self.velocity, dimension)
    }
}

/// The number of the first vector, from 1, that is not finite.
pub fn first_non_finite_of<V: Vector>(vectors: &[V]) -> Option<usize> {
    let first = vectors.iter().position(|vector| !is_finite(vector));
    first.map(|index| index + 1)
}

/// [`StageStorage::non_finite`] of positions with their forces and momenta with their velocities.
pub fn first_non_finite<V: Vector>(
    (q, force): (&[V], &[V]),
    (p, velocity): (&[V], &[V]),
) -> Option<(Quantity, usize)> {
    let first = |values: &[V], evaluations: &[V]| {
        let mut pairs = values.iter().zip(evaluations);
        pairs.position(|(value, evaluation)| is_finite(value) && !is_finite(evaluation))
    };
    // A stage that is not stored counts as finite: everything computed from it comes later in the order.
    match (first(q, force), first(p, velocity)) {
        (Some(i), Some(j)) if j < i => Some((Quantity::Velocity, j + 1)),
        (Some(i), _) => Some((Quantity::Force, i + 1)),
        (None, j) => j.map(|j| (Quantity::Velocity, j + 1)),
    }
}

/// [`StageStorage::mismatch`] of forces and velocities.
#[inline]
pub fn first_mismatch<V: Vector>(
    force: &[V],
    velocity: &[V],
    dimension: usize,
) -> Option<(Quantity, usize, usize)> {
    let first = |evaluations: &[V]| {
        let mut dimensions = evaluations.iter().map(V::dimension).enumerate();
        dimensions.find(|&(_, found)| found != dimension)
    };
    if let Some((i, found)) = first(force) {
        return Some((Quantity::Force, i + 1, found));
    }
    first(velocity).map(|(i, found)| (Quantity::Velocity, i + 1, found))
}

/// Whether every component is finite.
#[inline]
pub fn is_finite<V: Vector>(vector: &V) -> bool {
    // Every step checks its result with this function, so it is branch-free and vectorises. Adding 1 to the exponent carries into the sign
    // bit only if the number is NaN or infinite.
    const SIGN: u64 = 1 << 63;
    const LEAST_EXPONENT: u64 = 1 << 52;
    let mut carries = 0;
    for component in vector.as_slice() {
        let size = component.magnitude().to_bits() & !SIGN;
        carries |= size + LEAST_EXPONENT;
    }
    carries & SIGN == 0
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    #[test]
    fn is_finite_finds_a_nonfinite_number_in_any_component() {
        for (number, finite) in [
            (0.0, true),
            (-0.0, true),
            (f64::MAX, true),
            (f64::MIN, true),
            (5e-324, true),
            (f64::INFINITY, false),
            (f64::NEG_INFINITY, false),
            (f64::NAN, false),
            (-f64::NAN, false),
            (f64::from_bits(0x7ff0_0000_0000_0001), false),
        ] {
            for place in 0..3 {
                let mut vector = Vector3::new(1.0, -2.0, 3e300);
                vector[place] = number;
                assert_eq!(is_finite(&vector), finite, "{vector}");
            }
            // The largest double is infinite as an f32.
            let single = Vector3::new(1.0, number as f32, 2.0);
            let finite = finite && number.abs() <= f64::from(f32::MAX);
            assert_eq!(is_finite(&single), finite, "{single}");
        }
    }
}
