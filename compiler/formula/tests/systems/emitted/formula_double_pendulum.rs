/**

```text
H = (1/2) (pa² + 2 pb² − 2 pa pb cos(a − b))/(sin(a − b)² + 1) − g (2 cos(a) + cos(b))

a' = pa/(sin(a − b)² + 1) − pb cos(a − b)/(sin(a − b)² + 1)
b' = 2 pb/(sin(a − b)² + 1) − pa cos(a − b)/(sin(a − b)² + 1)
pa' = s1 − 2 g sin(a)
pb' = −g sin(b) − s1
s1 = cos(a − b) (sin(a − b) ((pa² + 2 pb² − 2 pa pb cos(a − b))/(sin(a − b)² + 1)²)) − sin(a − b) (pa pb/(sin(a − b)² + 1))
```

$$H = \\tfrac{1}{2}\\,\\frac{\\left({\\mathrm{pa}}^{2} + 2\\,{\\mathrm{pb}}^{2} - 2\\,\\mathrm{pa}\\,\\mathrm{pb}\\,\\cos\\left(a - b\\right)\\right)}{\\left({\\sin\\left(a - b\\right)}^{2} + 1\\right)} - g\\,\\left(2\\,\\cos\\left(a\\right) + \\cos\\left(b\\right)\\right)$$
$$\\dot{a} = \\frac{\\mathrm{pa}}{\\left({\\sin\\left(a - b\\right)}^{2} + 1\\right)} - \\frac{\\mathrm{pb}\\,\\cos\\left(a - b\\right)}{\\left({\\sin\\left(a - b\\right)}^{2} + 1\\right)}$$
$$\\dot{b} = 2\\,\\frac{\\mathrm{pb}}{\\left({\\sin\\left(a - b\\right)}^{2} + 1\\right)} - \\frac{\\mathrm{pa}\\,\\cos\\left(a - b\\right)}{\\left({\\sin\\left(a - b\\right)}^{2} + 1\\right)}$$
$$\\dot{\\mathrm{pa}} = s\_{1} - 2\\,g\\,\\sin\\left(a\\right)$$
$$\\dot{\\mathrm{pb}} = -g\\,\\sin\\left(b\\right) - s\_{1}$$
$$s\_{1} = \\cos\\left(a - b\\right)\\,\\left(\\sin\\left(a - b\\right)\\,\\left(\\frac{\\left({\\mathrm{pa}}^{2} + 2\\,{\\mathrm{pb}}^{2} - 2\\,\\mathrm{pa}\\,\\mathrm{pb}\\,\\cos\\left(a - b\\right)\\right)}{{\\left({\\sin\\left(a - b\\right)}^{2} + 1\\right)}^{2}}\\right)\\right) - \\sin\\left(a - b\\right)\\,\\left(\\frac{\\mathrm{pa}\\,\\mathrm{pb}}{\\left({\\sin\\left(a - b\\right)}^{2} + 1\\right)}\\right)$$

Found in the formula: not separable; independent of time, so H is conserved.
*/
#[allow(non_snake_case)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoublePendulum {
    /// The parameter `g`, 9.81 unless it is set.
    pub g: f64,
}
impl DoublePendulum {
    /// The system with these parameters, and the values of the definition for the others.
    #[allow(non_snake_case, clippy::too_many_arguments)]
    pub const fn new() -> Self {
        Self { g: 9.81 }
    }
}
impl ::core::default::Default for DoublePendulum {
    fn default() -> Self {
        Self::new()
    }
}
const _: () = {
    #[allow(unused_imports, clippy::all)]
    use ::symplectic::emitted::{One as _, Scalar, Zero as _};
    #[allow(unused_variables, non_snake_case, clippy::all)]
    impl ::symplectic::Hamiltonian for DoublePendulum {
        type Class = ::symplectic::General;
        type Vector<T: Scalar> = ::symplectic::nalgebra::SVector<T, 2>;
        const INLINED: bool = true;
        const JOINS: bool = true;
        #[inline(always)]
        fn in_lanes<LaneVector, LaneScalar, LaneWork>(work: LaneWork) -> LaneWork::Output
        where
            Self: ::symplectic::System<LaneVector, Class = ::symplectic::General>,
            LaneVector: ::symplectic::Vector,
            LaneScalar: ::symplectic::simd::Lanes,
            LaneWork: ::symplectic::emitted::LaneWork<LaneVector, Self, LaneScalar>,
        {
            work.run::<
                    ::symplectic::nalgebra::SVector<LaneScalar, 2>,
                    DoublePendulumInLanes,
                >(DoublePendulumInLanes::join)
        }
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
            let x1 = q[0] - q[1];
            let (x2, x3) = x1.sin_cos();
            let x4 = (x2 * x2 + T::one()).recip();
            velocity[0] = p[0] * x4 - p[1] * x3 * x4;
            velocity[1] = T::from_f64(2.0) * p[1] * x4 - p[0] * x3 * x4;
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
            let x1 = q[0] - q[1];
            let [(x2, x3), (x4, _), (x5, _)] = T::sin_cos_all([x1, q[0], q[1]]);
            let x6 = (x2 * x2 + T::one()).recip();
            let x7 = x3
                * (x2
                    * ((p[0] * p[0] + T::from_f64(2.0) * (p[1] * p[1])
                        - T::from_f64(2.0) * p[0] * p[1] * x3) * (x6 * x6)))
                - x2 * (p[0] * p[1] * x6);
            force[0] = x7 - T::from_f64(2.0 * self.g) * x4;
            force[1] = -(T::from_f64(self.g) * x5 + x7);
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
            let x1 = q[0] - q[1];
            let [(x2, x3), (x4, _), (x5, _)] = T::sin_cos_all([x1, q[0], q[1]]);
            let x6 = (x2 * x2 + T::one()).recip();
            velocity[0] = p[0] * x6 - p[1] * x3 * x6;
            velocity[1] = T::from_f64(2.0) * p[1] * x6 - p[0] * x3 * x6;
            let x7 = x3
                * (x2
                    * ((p[0] * p[0] + T::from_f64(2.0) * (p[1] * p[1])
                        - T::from_f64(2.0) * p[0] * p[1] * x3) * (x6 * x6)))
                - x2 * (p[0] * p[1] * x6);
            force[0] = x7 - T::from_f64(2.0 * self.g) * x4;
            force[1] = -(T::from_f64(self.g) * x5 + x7);
        }
        fn energy<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SVector<T, 2>,
            p: &::symplectic::nalgebra::SVector<T, 2>,
        ) -> ::core::option::Option<T> {
            let q = &q.data.0[0];
            let p = &p.data.0[0];
            let x1 = q[0] - q[1];
            let [(x2, x3), (_, x4), (_, x5)] = T::sin_cos_all([x1, q[0], q[1]]);
            let result_1 = T::from_f64(0.5)
                * (p[0] * p[0] + T::from_f64(2.0) * (p[1] * p[1])
                    - T::from_f64(2.0) * p[0] * p[1] * x3) / (x2 * x2 + T::one())
                - T::from_f64(self.g) * (T::from_f64(2.0) * x4 + x5);
            ::core::option::Option::Some(result_1)
        }
        ::symplectic::emitted::if_alloc! {
            fn second_derivatives < T : Scalar > (& self, time : T, q : &
            ::symplectic::nalgebra::SVector < T, 2 >, p : &
            ::symplectic::nalgebra::SVector < T, 2 >, jacobian : & mut
            ::symplectic::system::Jacobian < T >) -> bool { let q = & q.data.0[0]; let p
            = & p.data.0[0]; let x1 = q[0] - q[1]; let [(x2, x3), (_, x4), (_, x5)] =
            T::sin_cos_all([x1, q[0], q[1]]); let x6 = (x2 * x2 + T::one()).recip();
            jacobian.velocity_by_momentum.add(0, 0, x6); let x7 = - x3 * x6; jacobian
            .velocity_by_momentum.add(0, 1, x7); jacobian.velocity_by_momentum.add(1, 0,
            x7); jacobian.velocity_by_momentum.add(1, 1, T::from_f64(2.0) * x6); let x8 =
            x2 * (p[1] * x6); let x9 = T::from_f64(2.0) * x3; let x10 = x6 * x6; let x11
            = x9 * (x2 * (p[0] * x10 - p[1] * x3 * x10)); jacobian.velocity_by_position
            .add(0, 0, x8 - x11); jacobian.velocity_by_position.add(0, 1, x11 - x8); let
            x12 = x2 * (p[0] * x6); let x13 = x9 * (x2 * (T::from_f64(2.0) * p[1] * x10 -
            p[0] * x3 * x10)); jacobian.velocity_by_position.add(1, 0, x12 - x13);
            jacobian.velocity_by_position.add(1, 1, x13 - x12); let x14 = p[0] * p[1];
            let x15 = T::from_f64(2.0) * p[0] * p[1]; let x16 = p[0] * p[0] +
            T::from_f64(2.0) * (p[1] * p[1]) - x15 * x3; let x17 = x16 * x10; let x18 =
            x3 * x2; let x19 = x3 * (x14 * x6 - x3 * x17 - T::from_f64(2.0) * x2 * (x14 *
            x2 * x10 - T::from_f64(2.0) * x16 * (x6 * x10) * x18)) + x2 * (x2 * x17 - x15
            * (x10 * x18)); jacobian.force_by_position.add(0, 0, - (T::from_f64(2.0 *
            self.g) * x4 + x19)); jacobian.force_by_position.add(0, 1, x19); jacobian
            .force_by_position.add(1, 0, x19); jacobian.force_by_position.add(1, 1, -
            (x19 + T::from_f64(self.g) * x5)); true }
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
            ::symplectic::emitted::check_number("g", self.g)?;
            ::core::result::Result::Ok(())
        }
    }
    #[allow(non_snake_case)]
    struct DoublePendulumInLanes {
        g: <f64 as ::symplectic::emitted::LaneParameter>::InLanes,
    }
    #[allow(non_snake_case)]
    impl DoublePendulumInLanes {
        fn join(
            systems: &mut dyn ::core::iter::Iterator<Item = &DoublePendulum>,
        ) -> ::core::option::Option<Self> {
            use ::symplectic::emitted::LaneParameter as _;
            let first = systems.next()?;
            let mut joined = Self { g: first.g.in_all_lanes() };
            for (lane, system) in (1..).zip(systems) {
                system.g.set_lane(lane, &mut joined.g)?;
            }
            ::core::option::Option::Some(joined)
        }
    }
    #[allow(unused_variables, non_snake_case, clippy::all)]
    impl ::symplectic::Hamiltonian for DoublePendulumInLanes {
        type Class = ::symplectic::General;
        type Vector<T: Scalar> = ::symplectic::nalgebra::SVector<T, 2>;
        #[inline(always)]
        fn velocity<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SVector<T, 2>,
            p: &::symplectic::nalgebra::SVector<T, 2>,
            velocity: &mut ::symplectic::nalgebra::SVector<T, 2>,
        ) {
            ::symplectic::Hamiltonian::slopes(
                self,
                time,
                q,
                p,
                (velocity, &mut q.clone()),
            );
        }
        #[inline(always)]
        fn force<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SVector<T, 2>,
            p: &::symplectic::nalgebra::SVector<T, 2>,
            force: &mut ::symplectic::nalgebra::SVector<T, 2>,
        ) {
            ::symplectic::Hamiltonian::slopes(self, time, q, p, (&mut q.clone(), force));
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
            let x1 = q[0] - q[1];
            let [(x2, x3), (x4, _), (x5, _)] = T::sin_cos_all([x1, q[0], q[1]]);
            let x6 = (x2 * x2 + T::one()).recip();
            velocity[0] = p[0] * x6 - p[1] * x3 * x6;
            velocity[1] = T::from_f64(2.0) * p[1] * x6 - p[0] * x3 * x6;
            let x7 = x3
                * (x2
                    * ((p[0] * p[0] + T::from_f64(2.0) * (p[1] * p[1])
                        - T::from_f64(2.0) * p[0] * p[1] * x3) * (x6 * x6)))
                - x2 * (p[0] * p[1] * x6);
            force[0] = x7 - T::from_f64(2.0) * T::from_lanes(&self.g) * x4;
            force[1] = -(T::from_lanes(&self.g) * x5 + x7);
        }
    }
    impl ::symplectic::emitted::Named for DoublePendulum {
        const NAMES: [&'static [&'static str]; 2] = [&["a", "b"], &["pa", "pb"]];
    }
    #[allow(unused_variables, non_snake_case, clippy::all)]
    impl DoublePendulum {
        /// Observers of what the exact flow conserves, from a first state: `energy`.
        #[inline]
        pub fn invariants(
            &self,
            start: &::symplectic::State<::symplectic::nalgebra::SVector<f64, 2>>,
        ) -> [(
            &'static str,
            ::symplectic::Invariant<
                impl Fn(
                    &::symplectic::State<::symplectic::nalgebra::SVector<f64, 2>>,
                ) -> f64 + use<>,
            >,
        ); 1] {
            ::symplectic::emitted::invariants(
                ["energy"],
                self,
                |system: &Self, number, state| match number {
                    0 => {
                        ::symplectic::emitted::System::energy(
                                system,
                                state.time,
                                &state.q,
                                &state.p,
                            )
                            .unwrap_or(f64::NAN)
                    }
                    _ => f64::NAN,
                },
                start,
            )
        }
    }
};
