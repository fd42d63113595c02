//! Chains of particles with forces between neighbours.

#[cfg(feature = "alloc")]
mod derivatives;
mod system_macro;

use core::marker::PhantomData;

use num_traits::Zero;

#[cfg(feature = "alloc")]
use crate::contract::Jacobian;
use crate::contract::{Masses, OverEveryScalar, Separable, System};
use crate::error::Error;
use crate::number::registers::{self, Widest, Work};
use crate::number::rows::{Eight, Row, Single, WideEight, WidestEight};
use crate::number::{Scalar, Vector, copy};
use crate::solver::Automatic;
use crate::system::Named;

/// The forces on the particles of a [`Chain`].
///
/// Doubles are evaluated eight at a time, as one [`Scalar`]. As in all code that is generic over scalars, no branch may depend on a value.
/// Whether there is an outer force must not depend on a value either.
pub trait Bonds {
    /// Whether the tension and the outer force are inlined everywhere: see [`Hamiltonian::INLINED`](crate::Hamiltonian::INLINED).
    const INLINED: bool = false;

    /// Whether the second derivatives of the energies are known, with which there is a
    /// [`force_gradient`](crate::SeparableHamiltonian::force_gradient).
    const FORCE_GRADIENT: bool = false;

    /// The derivative `V′` of the energy of a bond at `stretch = q_{i+1} − q_i`. A positive value pulls the left particle to the right and
    /// the right one to the left.
    fn tension<T: Scalar>(&self, time: T, stretch: T) -> T;

    /// The force `−W′` on a particle at `position`, in addition to that of the bonds; `None` if there is none.
    fn outer_force<T: Scalar>(&self, _time: T, _position: T) -> Option<T> {
        None
    }

    /// The second derivative `V″` of the energy of a bond, if it is known: exact derivatives for the iteration of
    /// `solver::Newton`.
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

    /// See [`crate::Hamiltonian::check_dimension`].
    #[doc(hidden)]
    fn check_dimension(&self, _dimension: usize) -> Result<(), Error> {
        Ok(())
    }
}

impl<B: Bonds> Bonds for &B {
    const INLINED: bool = B::INLINED;
    const FORCE_GRADIENT: bool = B::FORCE_GRADIENT;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn tension<T: Scalar>(&self, time: T, stretch: T) -> T {
        (**self).tension(time, stretch)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn outer_force<T: Scalar>(&self, time: T, position: T) -> Option<T> {
        (**self).outer_force(time, position)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stiffness<T: Scalar>(&self, time: T, stretch: T) -> Option<T> {
        (**self).stiffness(time, stretch)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn outer_stiffness<T: Scalar>(&self, time: T, position: T) -> Option<T> {
        (**self).outer_stiffness(time, position)
    }

    fn bond_energy<T: Scalar>(&self, time: T, stretch: T) -> Option<T> {
        (**self).bond_energy(time, stretch)
    }

    fn outer_energy<T: Scalar>(&self, time: T, position: T) -> Option<T> {
        (**self).outer_energy(time, position)
    }

    fn check_dimension(&self, dimension: usize) -> Result<(), Error> {
        (**self).check_dimension(dimension)
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
/// The force on doubles is computed for eight particles side by side.
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

    /// The derivative of the tension of a bond along that of its stretch.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn pull<T: Scalar>(&self, time: T, stretch: T, along: T) -> T {
        let stiffness = self.bonds.stiffness(time, stretch);
        stiffness.unwrap_or(T::from_f64(f64::NAN)) * along
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

    /// Computes the forces from the first particle to the last, in full rows as far as possible.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn forces<T: Scalar, R: Row<T>>(&self, time: T, q: &[T], force: &mut [T]) {
        let (Some(&first), Some(&last)) = (q.first(), q.last()) else {
            return;
        };
        let beyond = self.beyond(first);
        let mut tension = self.first_tension(time, first, last);
        // A last particle without a bond to its right is computed separately.
        let bound = self.bound(q.len());
        let end = bound - bound % R::WIDTH;
        let after = |end: usize| q.get(end).copied().or(beyond).unwrap_or(T::zero());
        let (rows, rest) = force[..bound].split_at_mut(end);
        self.part::<T, R>(time, &q[..end], after(end), &mut tension, rows);
        self.part::<T, Single>(time, &q[end..bound], after(bound), &mut tension, rest);
        if let (Some(&here), Some(force)) = (q.get(bound), force.get_mut(bound)) {
            *force = self.between(time, tension, here, T::zero());
        }
    }

    /// The forces on particles in full rows, with the position `after` the last one. `tension` is the tension to their left, and afterwards
    /// that to their right.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn part<T: Scalar, R: Row<T>>(
        &self,
        time: T,
        q: &[T],
        after: T,
        tension: &mut T,
        force: &mut [T],
    ) {
        let (q, force) = (R::rows(q), R::rows_mut(force));
        let n = q.len().min(force.len());
        let (q, force) = (&q[..n], &mut force[..n]);
        let (Some(first), Some(last)) = (q.first(), n.checked_sub(1)) else {
            return;
        };
        let (time, after) = (R::splat(time), R::splat(after));
        let (mut here, mut before) = (R::load(first), R::splat(*tension));
        for i in 0..last {
            let next = R::load(&q[i + 1]);
            force[i] = self.row::<T, R>(time, here, next, &mut before);
            here = next;
        }
        force[last] = self.row::<T, R>(time, here, after, &mut before);
        *tension = R::last(before);
    }

    /// The forces on a row of particles. `before` holds the tensions to the right of the row before, and afterwards those of this one.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn row<T: Scalar, R: Row<T>>(
        &self,
        time: R::Numbers,
        here: R::Numbers,
        next: R::Numbers,
        before: &mut R::Numbers,
    ) -> R::Array {
        let right = self.bonds.tension(time, R::right(here, next) - here);
        let left = R::left(*before, right);
        *before = right;
        R::store(self.between(time, left, here, right))
    }

    /// The forces on particles at positions in doubles.
    #[inline]
    fn forces_on_doubles(&self, time: f64, q: &[f64], force: &mut [f64]) {
        // A constant condition: other bonds compile without this code.
        if registers::APART && B::INLINED && q.len() >= <Eight as Row<f64>>::WIDTH {
            match Widest::find() {
                Widest::Build => self.forces::<f64, Eight>(time, q, force),
                Widest::Avx2(avx2) => {
                    avx2.run(Forces::<B, WideEight>::new(self, time, q, force));
                }
                Widest::Avx512(avx512) => {
                    avx512.run(Forces::<B, WidestEight>::new(self, time, q, force));
                }
            }
        } else {
            self.forces::<f64, Eight>(time, q, force);
        }
    }
}

/// The forces on a chain in rows `R`.
struct Forces<'a, B, R> {
    chain: &'a Chain<B>,
    time: f64,
    q: &'a [f64],
    force: &'a mut [f64],
    rows: PhantomData<R>,
}

impl<'a, B, R> Forces<'a, B, R> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    const fn new(chain: &'a Chain<B>, time: f64, q: &'a [f64], force: &'a mut [f64]) -> Self {
        Self {
            chain,
            time,
            q,
            force,
            rows: PhantomData,
        }
    }
}

impl<B: Bonds, R: Row<f64>> Work for Forces<'_, B, R> {
    type Output = ();

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) {
        self.chain.forces::<f64, R>(self.time, self.q, self.force);
    }
}

impl<B> Named for Chain<B> {}

impl<V: Vector, B: Bonds> System<V> for Chain<B> {
    type Class = Separable;
    type Solver = Automatic;

    const MASSES: Masses = Masses::Unit;
    const INLINED: bool = B::INLINED;

    #[inline]
    fn velocity(&self, _time: V::Scalar, _q: &V, p: &V, velocity: &mut V) {
        copy(velocity, p);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn force(&self, time: V::Scalar, q: &V, _p: &V, force: &mut V) {
        let (q, force) = (q.as_slice(), force.as_mut_slice());
        let n = q.len().min(force.len());
        let (q, force) = (&q[..n], &mut force[..n]);
        if let (Some(&[time]), Some(q), Some(force)) = (
            V::Scalar::doubles(&[time]),
            V::Scalar::doubles(q),
            V::Scalar::doubles_mut(&mut *force),
        ) {
            return self.forces_on_doubles(time, q, force);
        }
        self.forces::<V::Scalar, Single>(time, q, force);
    }

    const FORCE_GRADIENT: bool = B::FORCE_GRADIENT;

    /// Bond by bond `V″ (f_{i+1} − f_i)`, and on each particle `−W″ f_i`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn force_gradient(&self, time: V::Scalar, q: &V, force: &V, gradient: &mut V) {
        let (q, force) = (q.as_slice(), force.as_slice());
        let gradient = gradient.as_mut_slice();
        let n = q.len().min(force.len()).min(gradient.len());
        let (q, force, gradient) = (&q[..n], &force[..n], &mut gradient[..n]);
        let zero = V::Scalar::zero();
        let (Some(&first), Some(&last)) = (q.first(), q.last()) else {
            return;
        };
        let (first_force, last_force) = (force[0], force[n - 1]);
        let mut left = match self.ends {
            Ends::Walls => self.pull(time, first, first_force),
            Ends::Free => zero,
            Ends::Ring => self.pull(time, first - last, first_force - last_force),
        };
        for i in 0..n {
            let right = if i + 1 < n {
                self.pull(time, q[i + 1] - q[i], force[i + 1] - force[i])
            } else {
                match self.ends {
                    Ends::Walls => self.pull(time, -last, -last_force),
                    Ends::Free => zero,
                    Ends::Ring => self.pull(time, first - last, first_force - last_force),
                }
            };
            let outer = self.bonds.outer_force(time, q[i]).map(|_| {
                let stiffness = self.bonds.outer_stiffness(time, q[i]);
                stiffness.unwrap_or(V::Scalar::from_f64(f64::NAN)) * force[i]
            });
            gradient[i] = right - left - outer.unwrap_or(zero);
            left = right;
        }
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

    fn check_dimension(&self, dimension: usize) -> Result<(), Error> {
        self.bonds.check_dimension(dimension)
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
