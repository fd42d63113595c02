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

            const MASSES: $crate::system::Masses = $crate::system::Masses::Unit;
            const INLINED: bool = <Self as $crate::emitted::Bonds>::INLINED;
            const WELL_DECLARED: bool = true;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn velocity(&self, time: V::Scalar, q: &V, p: &V, velocity: &mut V) {
                $crate::System::velocity(&$crate::emitted::Chain::$ends($bonds(self)), time, q, p, velocity);
            }

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn force(&self, time: V::Scalar, q: &V, p: &V, force: &mut V) {
                $crate::System::force(&$crate::emitted::Chain::$ends($bonds(self)), time, q, p, force);
            }

            const FORCE_GRADIENT: bool = <Self as $crate::emitted::Bonds>::FORCE_GRADIENT;

            #[cfg_attr(not(debug_assertions), inline(always))]
            fn force_gradient(&self, time: V::Scalar, q: &V, force: &V, gradient: &mut V) {
                $crate::System::force_gradient(&$crate::emitted::Chain::$ends($bonds(self)), time, q, force, gradient);
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

            fn check_dimension(&self, dimension: usize) -> ::core::result::Result<(), $crate::Error> {
                $crate::emitted::Bonds::check_dimension(self, dimension)
            }
        }

        impl<V: $crate::Vector, $($parameters)*> $crate::system::OverEveryScalar<V> for $name {
            type Doubles = V::With<f64>;
        }
    };
}
