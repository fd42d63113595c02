//! A Hamiltonian over every scalar as a system over one type of vectors.

#[cfg(feature = "alloc")]
use crate::contract::Jacobian;
use crate::contract::{Class, LaneWork, Masses, OverEveryScalar, System, first};
use crate::error::Error;
use crate::number::{Lanes, Vector};
use crate::solver::Automatic;
use crate::system::Hamiltonian;

impl<V: Vector, H: Hamiltonian<Vector<V::Scalar> = V>> System<V> for H {
    type Class = H::Class;
    type Solver = Automatic;

    const MASSES: Masses = H::MASSES;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn velocity(&self, time: V::Scalar, q: &V, p: &V, velocity: &mut V) {
        Hamiltonian::velocity::<V::Scalar>(self, time, q, p, velocity);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn force(&self, time: V::Scalar, q: &V, p: &V, force: &mut V) {
        Hamiltonian::force::<V::Scalar>(self, time, q, p, force);
    }

    const FORCE_GRADIENT: bool = H::FORCE_GRADIENT;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn force_gradient(&self, time: V::Scalar, q: &V, force: &V, gradient: &mut V) {
        Hamiltonian::force_gradient::<V::Scalar>(self, time, q, force, gradient);
    }

    const FORCED: bool = H::FORCED;
    const WELL_DECLARED: bool = H::WELL_DECLARED;

    fn applied_force(&self, time: V::Scalar, q: &V, p: &V, applied: &mut V) {
        Hamiltonian::applied_force::<V::Scalar>(self, time, q, p, applied);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slopes(&self, time: V::Scalar, q: &V, p: &V, slopes: (&mut V, &mut V)) {
        Hamiltonian::slopes::<V::Scalar>(self, time, q, p, slopes);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn velocities<'a>(&self, at: impl Fn(usize) -> (V::Scalar, &'a V, &'a V), velocities: &mut [V])
    where
        V: 'a,
    {
        Hamiltonian::velocities::<V::Scalar>(self, at, velocities);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn forces<'a>(&self, at: impl Fn(usize) -> (V::Scalar, &'a V, &'a V), forces: &mut [V])
    where
        V: 'a,
    {
        Hamiltonian::forces::<V::Scalar>(self, at, forces);
    }

    fn energy(&self, time: V::Scalar, q: &V, p: &V) -> Option<V::Scalar> {
        Hamiltonian::energy::<V::Scalar>(self, time, q, p)
    }

    #[cfg(feature = "alloc")]
    fn second_derivatives(
        &self,
        time: V::Scalar,
        q: &V,
        p: &V,
        jacobian: &mut Jacobian<V::Scalar>,
    ) -> bool {
        Hamiltonian::second_derivatives::<V::Scalar>(self, time, q, p, jacobian)
    }

    fn half_bandwidth(&self) -> usize {
        Hamiltonian::half_bandwidth(self)
    }

    fn check_dimension(&self, dimension: usize) -> Result<(), Error> {
        Hamiltonian::check_dimension(self, dimension)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn extra(&self) -> Option<<H::Class as Class>::Extra<'_, V>> {
        Hamiltonian::extra::<V::Scalar>(self)
    }

    const JOINS: bool = H::JOINS;

    const INLINED: bool = H::INLINED;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn over_lanes<L: Lanes, W: LaneWork<V, Self, L>>(work: W) -> Option<W::Output>
    where
        Self: Clone,
    {
        Some(match H::JOINS && !work.has_one_system() {
            true => H::in_lanes(work),
            false => work.run::<H::Vector<L>, H>(first),
        })
    }
}

impl<V: Vector, H: Hamiltonian<Vector<V::Scalar> = V>> OverEveryScalar<V> for H {
    type Doubles = H::Vector<f64>;
}
