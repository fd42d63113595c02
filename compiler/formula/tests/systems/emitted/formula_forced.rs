/**

```text
H = (1/2) (px² + py²) + y g

x' = px
y' = py
px' = sin(t) − px c √(px² + py²)
py' = −g − py c √(px² + py²)
```

$$H = \\tfrac{1}{2}\\,\\left({\\mathrm{px}}^{2} + {\\mathrm{py}}^{2}\\right) + y\\,g$$
$$\\dot{x} = \\mathrm{px}$$
$$\\dot{y} = \\mathrm{py}$$
$$\\dot{\\mathrm{px}} = \\sin\\left(t\\right) - \\mathrm{px}\\,c\\,\\sqrt{{\\mathrm{px}}^{2} + {\\mathrm{py}}^{2}}$$
$$\\dot{\\mathrm{py}} = -g - \\mathrm{py}\\,c\\,\\sqrt{{\\mathrm{px}}^{2} + {\\mathrm{py}}^{2}}$$

Found in the formula: separable, with the kinetic energy |p|²/2; dependent on time; with an applied force that depends on momenta, so steps are those for general systems; a polynomial of degree 2 in positions and momenta.
*/
#[allow(non_snake_case)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drone {
    /// The parameter `c`, 0.1 unless it is set.
    pub c: f64,
    /// The parameter `g`, 9.81 unless it is set.
    pub g: f64,
}
impl Drone {
    /// The system with these parameters, and the values of the definition for the others.
    #[allow(non_snake_case, clippy::too_many_arguments)]
    pub const fn new() -> Self {
        Self { c: 0.1, g: 9.81 }
    }
}
impl ::core::default::Default for Drone {
    fn default() -> Self {
        Self::new()
    }
}
const _: () = {
    #[allow(unused_imports, clippy::all)]
    use ::symplectic::emitted::{One as _, Scalar, Zero as _};
    #[allow(unused_variables, non_snake_case, clippy::all)]
    impl ::symplectic::Hamiltonian for Drone {
        type Class = ::symplectic::General;
        type Vector<T: Scalar> = ::symplectic::nalgebra::SVector<T, 2>;
        const MASSES: ::symplectic::system::Masses = ::symplectic::system::Masses::Unit;
        const INLINED: bool = true;
        #[inline(always)]
        fn velocity<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SVector<T, 2>,
            p: &::symplectic::nalgebra::SVector<T, 2>,
            velocity: &mut ::symplectic::nalgebra::SVector<T, 2>,
        ) {
            let q = &q.data.0[0];
            let p = &p.data.0[0];
            let velocity = &mut velocity.data.0[0];
            velocity[0] = p[0];
            velocity[1] = p[1];
        }
        #[inline(always)]
        fn force<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SVector<T, 2>,
            p: &::symplectic::nalgebra::SVector<T, 2>,
            force: &mut ::symplectic::nalgebra::SVector<T, 2>,
        ) {
            let q = &q.data.0[0];
            let p = &p.data.0[0];
            let force = &mut force.data.0[0];
            let x1 = p[0] * p[0] + p[1] * p[1];
            let x2 = x1.sqrt().or_zero(x1);
            force[1] = -(T::from_f64(self.c) * p[1] * x2 + T::from_f64(self.g));
            let x3 = time.sin();
            force[0] = x3 - T::from_f64(self.c) * p[0] * x2;
        }
        #[inline(always)]
        fn slopes<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SVector<T, 2>,
            p: &::symplectic::nalgebra::SVector<T, 2>,
            (
                velocity,
                force,
            ): (
                &mut ::symplectic::nalgebra::SVector<T, 2>,
                &mut ::symplectic::nalgebra::SVector<T, 2>,
            ),
        ) {
            let q = &q.data.0[0];
            let p = &p.data.0[0];
            let velocity = &mut velocity.data.0[0];
            let force = &mut force.data.0[0];
            velocity[0] = p[0];
            velocity[1] = p[1];
            let x1 = p[0] * p[0] + p[1] * p[1];
            let x2 = x1.sqrt().or_zero(x1);
            force[1] = -(T::from_f64(self.c) * p[1] * x2 + T::from_f64(self.g));
            let x3 = time.sin();
            force[0] = x3 - T::from_f64(self.c) * p[0] * x2;
        }
        fn energy<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SVector<T, 2>,
            p: &::symplectic::nalgebra::SVector<T, 2>,
        ) -> ::core::option::Option<T> {
            let q = &q.data.0[0];
            let p = &p.data.0[0];
            let result_1 = T::from_f64(0.5) * (p[0] * p[0] + p[1] * p[1])
                + T::from_f64(self.g) * q[1];
            ::core::option::Option::Some(result_1)
        }
        const FORCED: bool = true;
        fn applied_force<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SVector<T, 2>,
            p: &::symplectic::nalgebra::SVector<T, 2>,
            applied: &mut ::symplectic::nalgebra::SVector<T, 2>,
        ) {
            let q = &q.data.0[0];
            let p = &p.data.0[0];
            let applied = &mut applied.data.0[0];
            let x1 = p[0] * p[0] + p[1] * p[1];
            let x2 = x1.sqrt().or_zero(x1);
            applied[1] = -T::from_f64(self.c) * p[1] * x2;
            let x3 = time.sin();
            applied[0] = x3 - T::from_f64(self.c) * p[0] * x2;
        }
        ::symplectic::emitted::if_alloc! {
            fn second_derivatives < T : Scalar > (& self, time : T, q : &
            ::symplectic::nalgebra::SVector < T, 2 >, p : &
            ::symplectic::nalgebra::SVector < T, 2 >, jacobian : & mut
            ::symplectic::system::Jacobian < T >) -> bool { let q = & q.data.0[0]; let p
            = & p.data.0[0]; jacobian.velocity_by_momentum.add(0, 0, T::one()); jacobian
            .velocity_by_momentum.add(1, 1, T::one()); let x1 = p[0] * p[0] + p[1] *
            p[1]; let x2 = x1.sqrt(); let x3 = x2.recip().or_zero(x1); let x4 =
            T::from_f64(self.c) * p[1] * x3; jacobian.applied_force_by_momentum.add(1, 0,
            - p[0] * x4); let x5 = T::from_f64(self.c) * x2.or_zero(x1); jacobian
            .applied_force_by_momentum.add(1, 1, - (x5 + p[1] * x4)); let x6 =
            T::from_f64(self.c) * p[0] * x3; jacobian.applied_force_by_momentum.add(0, 0,
            - (x5 + p[0] * x6)); jacobian.applied_force_by_momentum.add(0, 1, - p[1] *
            x6); true }
        }
        #[allow(non_snake_case, clippy::all)]
        fn half_bandwidth(&self) -> usize {
            1
        }
        #[allow(unused_variables)]
        fn check_dimension(
            &self,
            dimension: usize,
        ) -> ::core::result::Result<(), ::symplectic::Error> {
            ::symplectic::emitted::check_number("c", self.c)?;
            ::symplectic::emitted::check_number("g", self.g)?;
            ::core::result::Result::Ok(())
        }
    }
    impl ::symplectic::emitted::Named for Drone {
        const NAMES: [&'static [&'static str]; 2] = [&["x", "y"], &["px", "py"]];
    }
};
