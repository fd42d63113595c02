//! Systems whose scalars are doubles side by side.

use crate::number::{F64x2, F64x4, F64x8, Lanes, Vector};
use crate::system::{Components, Hamiltonian};

/// A system over vectors of doubles and over vectors of [`Lanes`]: every one that is generic over its scalar.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a Hamiltonian system over the vectors `{V}` with lanes in place of doubles",
    label = "this needs a system that is generic over its `Scalar`: `impl<T: Scalar> SeparableHamiltonian<SVector<T, N>> for …`"
)]
pub trait HamiltonianInLanes<V: Vector>:
    Hamiltonian<V>
    + Hamiltonian<V::With<F64x2>>
    + Hamiltonian<V::With<F64x4>>
    + Hamiltonian<V::With<F64x8>>
{
}

impl<V: Vector, S> HamiltonianInLanes<V> for S where
    S: Hamiltonian<V>
        + Hamiltonian<V::With<F64x2>>
        + Hamiltonian<V::With<F64x4>>
        + Hamiltonian<V::With<F64x8>>
{
}

/// Lanes in which systems are evaluated.
pub trait SystemLanes: Lanes {
    /// [`Hamiltonian::velocity`] in every lane at once.
    fn velocity<V, S>(
        system: &S,
        time: Self,
        q: &V::With<Self>,
        p: &V::With<Self>,
        velocity: &mut V::With<Self>,
    ) where
        V: Vector,
        S: HamiltonianInLanes<V>;

    /// [`Hamiltonian::force`] in every lane at once.
    fn force<V, S>(
        system: &S,
        time: Self,
        q: &V::With<Self>,
        p: &V::With<Self>,
        force: &mut V::With<Self>,
    ) where
        V: Vector,
        S: HamiltonianInLanes<V>;

    /// [`Hamiltonian::LOCAL_FORCE`] of a system over these lanes.
    fn has_local_force<V, S>() -> bool
    where
        V: Vector,
        S: HamiltonianInLanes<V>;

    /// [`Hamiltonian::local_force`] in every lane at once.
    fn local_force<V, S>(system: &S, time: Self, components: &mut impl Components<Self>)
    where
        V: Vector,
        S: HamiltonianInLanes<V>;

    /// [`Hamiltonian::slopes`] in every lane at once.
    fn slopes<V, S>(
        system: &S,
        time: Self,
        q: &V::With<Self>,
        p: &V::With<Self>,
        slopes: (&mut V::With<Self>, &mut V::With<Self>),
    ) where
        V: Vector,
        S: HamiltonianInLanes<V>;
}

macro_rules! system_lanes {
    ($name:ident) => {
        impl SystemLanes for $name {
            #[inline(always)]
            fn velocity<V, S>(
                system: &S,
                time: Self,
                q: &V::With<Self>,
                p: &V::With<Self>,
                velocity: &mut V::With<Self>,
            ) where
                V: Vector,
                S: HamiltonianInLanes<V>,
            {
                Hamiltonian::<V::With<Self>>::velocity(system, time, q, p, velocity);
            }

            #[inline(always)]
            fn force<V, S>(
                system: &S,
                time: Self,
                q: &V::With<Self>,
                p: &V::With<Self>,
                force: &mut V::With<Self>,
            ) where
                V: Vector,
                S: HamiltonianInLanes<V>,
            {
                Hamiltonian::<V::With<Self>>::force(system, time, q, p, force);
            }

            #[inline(always)]
            fn has_local_force<V, S>() -> bool
            where
                V: Vector,
                S: HamiltonianInLanes<V>,
            {
                <S as Hamiltonian<V::With<Self>>>::LOCAL_FORCE
            }

            #[inline(always)]
            fn local_force<V, S>(system: &S, time: Self, components: &mut impl Components<Self>)
            where
                V: Vector,
                S: HamiltonianInLanes<V>,
            {
                Hamiltonian::<V::With<Self>>::local_force(system, time, components);
            }

            #[inline(always)]
            fn slopes<V, S>(
                system: &S,
                time: Self,
                q: &V::With<Self>,
                p: &V::With<Self>,
                slopes: (&mut V::With<Self>, &mut V::With<Self>),
            ) where
                V: Vector,
                S: HamiltonianInLanes<V>,
            {
                Hamiltonian::<V::With<Self>>::slopes(system, time, q, p, slopes);
            }
        }
    };
}

system_lanes!(F64x2);
system_lanes!(F64x4);
system_lanes!(F64x8);
