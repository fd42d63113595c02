//! Chains of particles with forces between neighbours.

#[cfg(feature = "alloc")]
mod derivatives;
mod system_macro;

use core::ops::Range;

use num_traits::Zero;

use crate::number::lanes::lane_of;
use crate::number::rows::{Eight, Row, Single, splats};
use crate::number::{F64x8, Lanes, Scalar, Vector, copy};
use crate::solver::Automatic;
#[cfg(feature = "alloc")]
use crate::system::Jacobian;
use crate::system::{
    Components, MOST_ROW_STAGES, OverEveryScalar, Separable, StageRows, System,
};

/// The forces on the particles of a [`Chain`].
///
/// Doubles are evaluated eight at a time, as one [`Scalar`]. As in all code that is generic over scalars, no branch may depend on a value;
/// whether there is an outer force may not depend on a value either.
pub trait Bonds {
    /// The derivative `V′` of the energy of a bond, at `stretch = q_{i+1} − q_i`: it pulls the left particle to the right and
    /// the right one to the left.
    fn tension<T: Scalar>(&self, time: T, stretch: T) -> T;

    /// The force `−W′` on a particle at `position` apart from the bonds; `None` if there is none.
    fn outer_force<T: Scalar>(&self, _time: T, _position: T) -> Option<T> {
        None
    }

    /// The second derivative `V″` of the energy of a bond, if it is known: exact derivatives for the iteration of
    /// [Newton](crate::solver::Newton).
    fn stiffness<T: Scalar>(&self, _time: T, _stretch: T) -> Option<T> {
        None
    }

    /// The second derivative `W″` of the energy of a particle, if it is known.
    fn outer_stiffness<T: Scalar>(&self, _time: T, _position: T) -> Option<T> {
        None
    }

    /// The energy `V` of a bond, if it is known.
    fn bond_energy<T: Scalar>(&self, _time: T, _stretch: T) -> Option<T> {
        None
    }

    /// The energy `W` of a particle, if it is known.
    fn outer_energy<T: Scalar>(&self, _time: T, _position: T) -> Option<T> {
        None
    }
}

impl<B: Bonds> Bonds for &B {
    fn tension<T: Scalar>(&self, time: T, stretch: T) -> T {
        (**self).tension(time, stretch)
    }

    fn outer_force<T: Scalar>(&self, time: T, position: T) -> Option<T> {
        (**self).outer_force(time, position)
    }

    fn stiffness<T: Scalar>(&self, time: T, stretch: T) -> Option<T> {
        (**self).stiffness(time, stretch)
    }

    fn outer_stiffness<T: Scalar>(&self, time: T, position: T) -> Option<T> {
        (**self).outer_stiffness(time, position)
    }

    fn bond_energy<T: Scalar>(&self, time: T, stretch: T) -> Option<T> {
        (**self).bond_energy(time, stretch)
    }

    fn outer_energy<T: Scalar>(&self, time: T, position: T) -> Option<T> {
        (**self).outer_energy(time, position)
    }
}

/// The neighbours of the first and the last particle of a [`Chain`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Ends {
    /// Bonds to walls at position zero.
    Walls,
    /// No neighbours.
    Free,
    /// The first and the last particle are neighbours.
    Ring,
}

/// Particles of mass one in a row, each bound to its two neighbours: Fermi–Pasta–Ulam–Tsingou, Toda, Klein–Gordon and
/// sine-Gordon chains, wave equations on a grid. The number n of particles is the dimension of the vectors:
///
/// ```text
/// H = Σ p_i²/2 + Σ W(t, q_i) + Σ V(t, q_{i+1} − q_i)
/// ```
///
/// where `q_i` is the displacement of particle `i` from its rest position. The last sum runs over all bonds: n + 1
/// [between walls](Self::between_walls), for `q_0 = q_{n+1} = 0`; n − 1 with [free ends](Self::with_free_ends); and n in a
/// [ring](Self::ring), for `q_{n+1} = q_1`.
///
/// An integrator knows the neighbours of every particle of a chain. Blocks of explicit steps with plain sums and at least 64
/// components compute force, kicks and drift in one pass through the chain, with eight particles of doubles side by side. Single
/// steps have the same bits.
///
/// ```
/// use symplectic::nalgebra::DVector;
/// use symplectic::{Error, Integrator, Scalar, State};
/// use symplectic::emitted::{Bonds, Chain};
///
/// symplectic::tableau! { StoermerVerlet { basis: polynomial(2), nodes: lobatto(2) } }
///
/// /// V(d) = d²/2 + d⁴/4
/// struct Beta;
///
/// impl Bonds for Beta {
///     fn tension<T: Scalar>(&self, _time: T, d: T) -> T {
///         d + d * d * d
///     }
/// }
///
/// # fn main() -> Result<(), Error> {
/// let n = 1000;
/// let pushed = DVector::from_fn(n, |i, _| if i == n / 2 { 1.0 } else { 0.0 });
/// let start = State::new(0.0, DVector::zeros(n), pushed);
/// let mut chain = Integrator::plain(StoermerVerlet, Chain::between_walls(Beta), start, 0.05)?;
/// let end = chain.integrate_to(100.0)?;
/// assert!(end.q.iter().all(|q| q.is_finite()));
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Chain<B> {
    bonds: B,
    ends: Ends,
}

impl<B: Bonds> Chain<B> {
    /// The chain with its first and last particle bound to walls at position zero.
    pub const fn between_walls(bonds: B) -> Self {
        Self {
            bonds,
            ends: Ends::Walls,
        }
    }

    /// The chain without bonds beyond its first and its last particle.
    pub const fn with_free_ends(bonds: B) -> Self {
        Self {
            bonds,
            ends: Ends::Free,
        }
    }

    /// The chain with its last particle bound to the first.
    pub const fn ring(bonds: B) -> Self {
        Self {
            bonds,
            ends: Ends::Ring,
        }
    }

    /// The bonds.
    pub const fn bonds(&self) -> &B {
        &self.bonds
    }

    /// The position to the right of the last particle; `None` if there is no bond.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn beyond<T: Scalar>(&self, first: T) -> Option<T> {
        match self.ends {
            Ends::Walls => Some(T::zero()),
            Ends::Free => None,
            Ends::Ring => Some(first),
        }
    }

    /// The tension to the left of the first particle.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_tension<T: Scalar>(&self, time: T, first: T, last: T) -> T {
        match self.ends {
            Ends::Walls => self.bonds.tension(time, first),
            Ends::Free => T::zero(),
            Ends::Ring => self.bonds.tension(time, first - last),
        }
    }

    /// The force on particles between two tensions.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn between<T: Scalar>(&self, time: T, left: T, here: T, right: T) -> T {
        match self.bonds.outer_force(time, here) {
            Some(outer) => outer + (right - left),
            None => right - left,
        }
    }

    /// Number of particles with a bond to their right.
    fn bound(&self, particles: usize) -> usize {
        match self.ends {
            Ends::Free => particles.saturating_sub(1),
            Ends::Walls | Ends::Ring => particles,
        }
    }

    /// Makes a pass from the first particle to the last, in full rows as far as possible.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn walk<T: Scalar, R: Row<T>>(&self, time: T, pass: &mut impl Pass<T>) {
        let q = pass.positions();
        let n = q.len();
        let (Some(&first), Some(&last)) = (q.first(), q.last()) else {
            return;
        };
        let beyond = self.beyond(first);
        let mut tension = self.first_tension(time, first, last);
        // A last particle without a bond to its right is computed separately.
        let bound = self.bound(n);
        let begin = R::misaligned(q).min(bound);
        let end = bound - (bound - begin) % R::WIDTH;
        self.part::<T, Single>(time, pass, 0..begin, beyond, &mut tension);
        self.part::<T, R>(time, pass, begin..end, beyond, &mut tension);
        self.part::<T, Single>(time, pass, end..bound, beyond, &mut tension);
        pass.rows::<Single>(bound..n, last, |here, _after| {
            self.between(time, tension, here, T::zero())
        });
    }

    /// Kicks and a drift in one pass; returns `false` if there are more kicks than a pass supports.
    // Not inlined, because vectors are long: one copy of the code serves all passes of a step.
    #[inline(never)]
    fn kicks_and_drift<T: Scalar, R: Row<T>>(
        &self,
        time: T,
        (q, p): (&mut [T], &mut [T]),
        kicks: &[T],
        drift: T,
    ) -> bool {
        match *kicks {
            [kick] => self.walk::<T, R>(
                time,
                &mut KicksAndDrift {
                    q,
                    p,
                    kicks: [kick],
                    drift,
                },
            ),
            [earlier, later] => {
                let kicks = [earlier, later];
                self.walk::<T, R>(time, &mut KicksAndDrift { q, p, kicks, drift });
            }
            _ => return false,
        }
        true
    }

    /// A pass over the particles of a part. `tension` is the tension to the left of the part, and afterwards that to its right.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn part<T: Scalar, R: Row<T>>(
        &self,
        time: T,
        pass: &mut impl Pass<T>,
        part: Range<usize>,
        beyond: Option<T>,
        tension: &mut T,
    ) {
        let after = (pass.positions().get(part.end).copied()).or(beyond);
        let (time, after) = (R::splat(time), R::splat(after.unwrap_or(T::zero())));
        let mut before = R::splat(*tension);
        pass.rows::<R>(part, after, |here, next| {
            let right = self.bonds.tension(time, R::right(here, next) - here);
            let left = R::left(before, right);
            before = right;
            self.between(time, left, here, right)
        });
        *tension = R::last(before);
    }
}

/// The operation of a pass through a chain.
trait Pass<T: Scalar> {
    /// The positions; those of particles that the pass has not reached are still the old positions.
    fn positions(&self) -> &[T];

    /// Processes the particles of a part, which consists of full rows, from left to right. `force` gives the force on a row from its
    /// positions and those of the next row; the row after the last one is `after`.
    fn rows<R: Row<T>>(
        &mut self,
        part: Range<usize>,
        after: R::Numbers,
        force: impl FnMut(R::Numbers, R::Numbers) -> R::Numbers,
    );
}

/// Writes the forces.
struct Forces<'a, T> {
    q: &'a [T],
    force: &'a mut [T],
}

impl<T: Scalar> Pass<T> for Forces<'_, T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn positions(&self) -> &[T] {
        self.q
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rows<R: Row<T>>(
        &mut self,
        part: Range<usize>,
        after: R::Numbers,
        mut force: impl FnMut(R::Numbers, R::Numbers) -> R::Numbers,
    ) {
        let (out, _) = R::rows_mut(&mut self.force[part.clone()]);
        let (q, _) = R::rows(&self.q[part.clone()]);
        let n = q.len().min(out.len());
        let (q, out) = (&q[..n], &mut out[..n]);
        let (Some(first), Some(last)) = (q.first(), n.checked_sub(1)) else {
            return;
        };
        let mut here = R::load(first);
        for i in 0..last {
            let next = R::load(&q[i + 1]);
            out[i] = R::store(force(here, next));
            here = next;
        }
        out[last] = R::store(force(here, after));
    }
}

/// Several kicks in sequence and a drift.
struct KicksAndDrift<'a, T, const K: usize> {
    q: &'a mut [T],
    p: &'a mut [T],
    kicks: [T; K],
    drift: T,
}

impl<T: Scalar, const K: usize> Pass<T> for KicksAndDrift<'_, T, K> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn positions(&self) -> &[T] {
        self.q
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn rows<R: Row<T>>(
        &mut self,
        part: Range<usize>,
        after: R::Numbers,
        mut force: impl FnMut(R::Numbers, R::Numbers) -> R::Numbers,
    ) {
        let (q, _) = R::rows_mut(&mut self.q[part.clone()]);
        let (p, _) = R::rows_mut(&mut self.p[part]);
        let n = q.len().min(p.len());
        let (q, p) = (&mut q[..n], &mut p[..n]);
        let (kicks, drift) = (splats::<T, R, K>(self.kicks), R::splat(self.drift));
        let row = |here: R::Numbers, force: R::Numbers, q: &mut R::Array, p: &mut R::Array| {
            let mut momentum = R::load(p);
            for kick in kicks {
                momentum = kick.fused(force, momentum);
            }
            *p = R::store(momentum);
            *q = R::store(drift.fused(momentum, here));
        };
        let (Some(first), Some(last)) = (q.first(), n.checked_sub(1)) else {
            return;
        };
        let mut here = R::load(first);
        for i in 0..last {
            let next = R::load(&q[i + 1]);
            row(here, force(here, next), &mut q[i], &mut p[i]);
            here = next;
        }
        row(here, force(here, after), &mut q[last], &mut p[last]);
    }
}

/// A row with zero in its last lane.
#[cfg_attr(not(debug_assertions), inline(always))]
fn without_last(row: F64x8) -> F64x8 {
    let lanes = row.to_array();
    F64x8::from_fn(|lane| {
        if lane + 1 < F64x8::WIDTH {
            lanes[lane]
        } else {
            0.0
        }
    })
}

impl<V: Vector, B: Bonds> System<V> for Chain<B> {
    type Class = Separable;
    type Solver = Automatic;

    const UNIT_MASSES: bool = true;

    #[inline]
    fn velocity(&self, _time: V::Scalar, _q: &V, p: &V, velocity: &mut V) {
        copy(velocity, p);
    }

    #[inline]
    fn force(&self, time: V::Scalar, q: &V, _p: &V, force: &mut V) {
        let (q, force) = (q.as_slice(), force.as_mut_slice());
        let n = q.len().min(force.len());
        let (q, force) = (&q[..n], &mut force[..n]);
        if let (Some(&[time]), Some(q), Some(force)) = (
            V::Scalar::doubles(&[time]),
            V::Scalar::doubles(q),
            V::Scalar::doubles_mut(&mut *force),
        ) {
            return self.walk::<f64, Eight>(time, &mut Forces { q, force });
        }
        self.walk::<V::Scalar, Single>(time, &mut Forces { q, force });
    }

    const LOCAL_FORCE: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn local_force(&self, time: V::Scalar, components: &mut impl Components<V::Scalar>) {
        let Some(last) = components.dimension().checked_sub(1) else {
            return;
        };
        let first = components.position(0);
        // Only a ring needs the position at its other end.
        let at_last = match self.ends {
            Ends::Ring => components.position(last),
            Ends::Walls | Ends::Free => first,
        };
        let (mut here, mut left) = (first, self.first_tension(time, first, at_last));
        for k in 0..last {
            let next = components.position(k + 1);
            let right = self.bonds.tension(time, next - here);
            components.set_force(k, self.between(time, left, here, right));
            (here, left) = (next, right);
        }
        let right = match self.beyond(first) {
            Some(beyond) => self.bonds.tension(time, beyond - here),
            None => V::Scalar::zero(),
        };
        components.set_force(last, self.between(time, left, here, right));
    }

    const ROW_FORCES: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn row_forces(&self, rows: &mut impl StageRows) {
        let stages = rows.stages();
        let Some(last) = rows.count().checked_sub(1) else {
            return;
        };
        let first = rows.positions(0);
        // Only a ring needs the positions at its other end.
        let at_last = match self.ends {
            Ends::Ring => rows.positions(last),
            Ends::Walls | Ends::Free => first,
        };
        let zeros = [F64x8::zero(); MOST_ROW_STAGES];
        let (mut here, mut before) = (first, zeros);
        for stage in 0..stages {
            // The tension to the left of the first particle, in all lanes.
            let [first, last] = [
                lane_of(first[stage], 0),
                lane_of(at_last[stage], F64x8::WIDTH - 1),
            ];
            let ends = [first, last].map(F64x8::from_f64);
            before[stage] = self.first_tension(rows.time(stage), ends[0], ends[1]);
        }
        for row in 0..last {
            let (next, mut forces) = (rows.positions(row + 1), zeros);
            for stage in 0..stages {
                let (time, here) = (rows.time(stage), here[stage]);
                let tension = self
                    .bonds
                    .tension(time, Eight::right(here, next[stage]) - here);
                forces[stage] =
                    self.between(time, Eight::left(before[stage], tension), here, tension);
                before[stage] = tension;
            }
            rows.set_forces(row, forces);
            here = next;
        }
        let mut forces = zeros;
        for stage in 0..stages {
            let (time, here) = (rows.time(stage), here[stage]);
            // A last particle without a bond to its right is its own neighbour; its tension is set to zero below.
            let beyond = self.beyond(first[stage]);
            let next = Eight::right(here, beyond.unwrap_or(here));
            let mut tension = self.bonds.tension(time, next - here);
            if beyond.is_none() {
                tension = without_last(tension);
            }
            forces[stage] = self.between(time, Eight::left(before[stage], tension), here, tension);
        }
        rows.set_forces(last, forces);
    }

    #[inline]
    fn kick_and_drift(
        &self,
        time: V::Scalar,
        (q, p): (&mut [V::Scalar], &mut [V::Scalar]),
        kicks: &[V::Scalar],
        drift: V::Scalar,
    ) -> bool {
        let n = q.len().min(p.len());
        let (q, p) = (&mut q[..n], &mut p[..n]);
        if let (Some(&[time, drift]), Some(kicks), Some(q), Some(p)) = (
            V::Scalar::doubles(&[time, drift]),
            V::Scalar::doubles(kicks),
            V::Scalar::doubles_mut(&mut *q),
            V::Scalar::doubles_mut(&mut *p),
        ) {
            return self.kicks_and_drift::<f64, Eight>(time, (q, p), kicks, drift);
        }
        self.kicks_and_drift::<V::Scalar, Single>(time, (q, p), kicks, drift)
    }

    fn energy(&self, time: V::Scalar, q: &V, p: &V) -> Option<V::Scalar> {
        let zero = V::Scalar::zero();
        let (q, p) = (q.as_slice(), p.as_slice());
        let bond = |stretch| self.bonds.bond_energy(time, stretch);
        let (&first, &last) = (q.first()?, q.last()?);
        // The bonds at the ends.
        let mut energy = match self.ends {
            Ends::Walls => bond(first)? + bond(-last)?,
            Ends::Free => zero,
            Ends::Ring => bond(first - last)?,
        };
        for pair in q.windows(2) {
            energy += bond(pair[1] - pair[0])?;
        }
        let half = V::Scalar::from_f64(0.5);
        for (&q, &p) in q.iter().zip(p) {
            energy += half * p * p;
            if self.bonds.outer_force(time, q).is_some() {
                energy += self.bonds.outer_energy(time, q)?;
            }
        }
        Some(energy)
    }

    #[cfg(feature = "alloc")]
    fn second_derivatives(
        &self,
        time: V::Scalar,
        q: &V,
        _p: &V,
        jacobian: &mut Jacobian<V::Scalar>,
    ) -> bool {
        self.add_second_derivatives(time, q.as_slice(), jacobian)
            .is_some()
    }

    /// The ends of a ring are neighbours, too.
    fn half_bandwidth(&self) -> usize {
        match self.ends {
            Ends::Walls | Ends::Free => 1,
            Ends::Ring => usize::MAX,
        }
    }
}

impl<V: Vector, B: Bonds> OverEveryScalar<V> for Chain<B> {
    type Doubles = V::With<f64>;
}
