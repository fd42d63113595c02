//! Systems over SIMD lanes.

use crate::contract::{System, SystemInLanes};
use crate::number::{F64x2, F64x4, F64x8, Lanes, Vector, WideF64x4, WideF64x8, WidestF64x8};

/// Work with vectors of lanes in place of vectors `V`.
#[doc(hidden)]
pub trait LaneWork<V: Vector, S: System<V>, L: Lanes> {
    /// The result of the work.
    type Output;

    /// Whether all lanes have the same system. Functions of its parameters are then computed once, and not in every lane.
    fn has_one_system(&self) -> bool;

    /// Runs the work with a system of type `J` over the vectors `W`.
    fn run<W: Vector<Scalar = L>, J: System<W, Class = <S as System<V>>::Class>>(
        self,
        join: Join<S, J>,
    ) -> Self::Output;
}

/// Makes a system over lanes, each with the parameters and the bits of one of these systems. Returns `None` if there is no system, or if
/// they differ in more than the values of parameters. It reads no system after the first that differs.
#[doc(hidden)]
pub type Join<S, J> = for<'a> fn(&mut dyn Iterator<Item = &'a S>) -> Option<J>;

/// The first system, for lanes with the same system.
#[doc(hidden)]
pub fn first<S: Clone>(systems: &mut dyn Iterator<Item = &S>) -> Option<S> {
    systems.next().cloned()
}

/// Lanes in which systems are evaluated.
pub trait SystemLanes: Lanes {
    /// [`System::velocity`] in every lane at once.
    fn velocity<V: Vector, S: SystemInLanes<V>>(
        system: &S,
        time: Self,
        q: &V::With<Self>,
        p: &V::With<Self>,
        velocity: &mut V::With<Self>,
    );

    /// [`System::force`] in every lane at once.
    fn force<V: Vector, S: SystemInLanes<V>>(
        system: &S,
        time: Self,
        q: &V::With<Self>,
        p: &V::With<Self>,
        force: &mut V::With<Self>,
    );

    /// [`System::slopes`] in every lane at once.
    fn slopes<V: Vector, S: SystemInLanes<V>>(
        system: &S,
        time: Self,
        q: &V::With<Self>,
        p: &V::With<Self>,
        slopes: (&mut V::With<Self>, &mut V::With<Self>),
    );
}

macro_rules! system_lanes {
    ($name:ident) => {
        impl SystemLanes for $name {
            forward! {
                velocity: &mut V::With<Self>;
                force: &mut V::With<Self>;
                slopes: (&mut V::With<Self>, &mut V::With<Self>);
            }
        }
    };
}

macro_rules! forward {
    ($($function:ident: $out:ty;)*) => {
        $(
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn $function<V, S>(
                system: &S,
                time: Self,
                q: &V::With<Self>,
                p: &V::With<Self>,
                out: $out,
            ) where
                V: Vector,
                S: SystemInLanes<V>,
            {
                System::<V::With<Self>>::$function(system, time, q, p, out);
            }
        )*
    };
}

system_lanes!(F64x2);
system_lanes!(F64x4);
system_lanes!(F64x8);
system_lanes!(WideF64x4);
system_lanes!(WideF64x8);
system_lanes!(WidestF64x8);
