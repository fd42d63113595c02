//! Chains as types of their own.

/// Implements a system that is a chain for a type that has bonds. Bonds that are cheap to copy are copied, because the compiler can keep
/// the copy in registers.
#[doc(hidden)]
#[macro_export]
macro_rules! chain_system {
    (($($parameters:tt)*) ($name:ty), $bonds:expr, $ends:ident) => {
        impl<V: $crate::Vector, $($parameters)*> $crate::System<V> for $name {
            type Class = $crate::Separable;
            type Solver = $crate::solver::Automatic;

            const UNIT_MASSES: bool = true;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn velocity(&self, time: V::Scalar, q: &V, p: &V, velocity: &mut V) {
                $crate::System::velocity(&$crate::emitted::Chain::$ends($bonds(self)), time, q, p, velocity);
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn force(&self, time: V::Scalar, q: &V, p: &V, force: &mut V) {
                $crate::System::force(&$crate::emitted::Chain::$ends($bonds(self)), time, q, p, force);
            }

            const LOCAL_FORCE: bool = true;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn local_force(&self, time: V::Scalar, components: &mut impl $crate::emitted::Components<V::Scalar>) {
                $crate::System::<V>::local_force(&$crate::emitted::Chain::$ends($bonds(self)), time, components);
            }

            const ROW_FORCES: bool = true;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn row_forces(&self, rows: &mut impl $crate::emitted::StageRows) {
                $crate::System::<V>::row_forces(&$crate::emitted::Chain::$ends($bonds(self)), rows);
            }

            #[inline]
            fn kick_and_drift(
                &self,
                time: V::Scalar,
                state: (&mut [V::Scalar], &mut [V::Scalar]),
                kicks: &[V::Scalar],
                drift: V::Scalar,
            ) -> bool {
                $crate::System::<V>::kick_and_drift(&$crate::emitted::Chain::$ends($bonds(self)), time, state, kicks, drift)
            }

            fn energy(&self, time: V::Scalar, q: &V, p: &V) -> ::core::option::Option<V::Scalar> {
                $crate::System::energy(&$crate::emitted::Chain::$ends($bonds(self)), time, q, p)
            }

            $crate::if_alloc! {
                fn second_derivatives(
                    &self,
                    time: V::Scalar,
                    q: &V,
                    p: &V,
                    jacobian: &mut $crate::system::Jacobian<V::Scalar>,
                ) -> bool {
                    $crate::System::second_derivatives(&$crate::emitted::Chain::$ends($bonds(self)), time, q, p, jacobian)
                }
            }

            fn half_bandwidth(&self) -> usize {
                $crate::System::<V>::half_bandwidth(&$crate::emitted::Chain::$ends($bonds(self)))
            }
        }

        impl<V: $crate::Vector, $($parameters)*> $crate::system::OverEveryScalar<V> for $name {
            type Doubles = V::With<f64>;
        }
    };
}
