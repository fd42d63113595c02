/**

```text
L = g (2 cos(a) + cos(b)) + va² + (1/2) vb² + va vb cos(a − b)

pa = 2 va + vb cos(a − b)
pb = vb + va cos(a − b)

H = (1/2) (pa² − 2 pa pb cos(a − b) + 2 pb²)/(2 − cos(a − b)²) − g (2 cos(a) + cos(b))

a' = pa/(2 − cos(a − b)²) − pb cos(a − b)/(2 − cos(a − b)²)
b' = 2 pb/(2 − cos(a − b)²) − pa cos(a − b)/(2 − cos(a − b)²)
pa' = −2 g sin(a) − s1
pb' = s1 − g sin(b)
s1 = sin(a − b) (pa pb/(2 − cos(a − b)²) − cos(a − b) ((pa² − 2 pa pb cos(a − b) + 2 pb²)/(2 − cos(a − b)²)²))
```

$$H = \\tfrac{1}{2}\\,\\frac{\\left({\\mathrm{pa}}^{2} - 2\\,\\mathrm{pa}\\,\\mathrm{pb}\\,\\cos\\left(a - b\\right) + 2\\,{\\mathrm{pb}}^{2}\\right)}{\\left(2 - {\\cos\\left(a - b\\right)}^{2}\\right)} - g\\,\\left(2\\,\\cos\\left(a\\right) + \\cos\\left(b\\right)\\right)$$
$$\\dot{a} = \\frac{\\mathrm{pa}}{\\left(2 - {\\cos\\left(a - b\\right)}^{2}\\right)} - \\frac{\\mathrm{pb}\\,\\cos\\left(a - b\\right)}{\\left(2 - {\\cos\\left(a - b\\right)}^{2}\\right)}$$
$$\\dot{b} = 2\\,\\frac{\\mathrm{pb}}{\\left(2 - {\\cos\\left(a - b\\right)}^{2}\\right)} - \\frac{\\mathrm{pa}\\,\\cos\\left(a - b\\right)}{\\left(2 - {\\cos\\left(a - b\\right)}^{2}\\right)}$$
$$\\dot{\\mathrm{pa}} = -2\\,g\\,\\sin\\left(a\\right) - s\_{1}$$
$$\\dot{\\mathrm{pb}} = s\_{1} - g\\,\\sin\\left(b\\right)$$
$$s\_{1} = \\sin\\left(a - b\\right)\\,\\left(\\frac{\\mathrm{pa}\\,\\mathrm{pb}}{\\left(2 - {\\cos\\left(a - b\\right)}^{2}\\right)} - \\cos\\left(a - b\\right)\\,\\left(\\frac{\\left({\\mathrm{pa}}^{2} - 2\\,\\mathrm{pa}\\,\\mathrm{pb}\\,\\cos\\left(a - b\\right) + 2\\,{\\mathrm{pb}}^{2}\\right)}{{\\left(2 - {\\cos\\left(a - b\\right)}^{2}\\right)}^{2}}\\right)\\right)$$

Found in the formula: not separable; independent of time, so H is conserved; the mass matrix is regular at random points.
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
            let x1 = (q[0] - q[1]).cos();
            let x2 = (T::from_f64(2.0) - x1 * x1).recip();
            velocity[0] = p[0] * x2 - p[1] * x1 * x2;
            velocity[1] = T::from_f64(2.0) * p[1] * x2 - p[0] * x1 * x2;
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
            let x6 = (T::from_f64(2.0) - x3 * x3).recip();
            let x7 = x2
                * (p[0] * p[1] * x6
                    - x3
                        * (x6 * x6
                            * (p[0] * p[0] - T::from_f64(2.0) * p[0] * p[1] * x3
                                + T::from_f64(2.0) * (p[1] * p[1]))));
            force[0] = -(T::from_f64(2.0 * self.g) * x4 + x7);
            force[1] = x7 - T::from_f64(self.g) * x5;
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
            let x6 = (T::from_f64(2.0) - x3 * x3).recip();
            velocity[0] = p[0] * x6 - p[1] * x3 * x6;
            velocity[1] = T::from_f64(2.0) * p[1] * x6 - p[0] * x3 * x6;
            let x7 = x2
                * (p[0] * p[1] * x6
                    - x3
                        * (x6 * x6
                            * (p[0] * p[0] - T::from_f64(2.0) * p[0] * p[1] * x3
                                + T::from_f64(2.0) * (p[1] * p[1]))));
            force[0] = -(T::from_f64(2.0 * self.g) * x4 + x7);
            force[1] = x7 - T::from_f64(self.g) * x5;
        }
        fn energy<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SVector<T, 2>,
            p: &::symplectic::nalgebra::SVector<T, 2>,
        ) -> ::core::option::Option<T> {
            let q = &q.data.0[0];
            let p = &p.data.0[0];
            let [(_, x1), (_, x2), (_, x3)] = T::sin_cos_all([q[0] - q[1], q[0], q[1]]);
            let result_1 = T::from_f64(0.5)
                * (p[0] * p[0] - T::from_f64(2.0) * p[0] * p[1] * x1
                    + T::from_f64(2.0) * (p[1] * p[1])) / (T::from_f64(2.0) - x1 * x1)
                - T::from_f64(self.g) * (T::from_f64(2.0) * x2 + x3);
            ::core::option::Option::Some(result_1)
        }
        ::symplectic::emitted::if_alloc! {
            fn second_derivatives < T : Scalar > (& self, time : T, q : &
            ::symplectic::nalgebra::SVector < T, 2 >, p : &
            ::symplectic::nalgebra::SVector < T, 2 >, jacobian : & mut
            ::symplectic::system::Jacobian < T >) -> bool { let q = & q.data.0[0]; let p
            = & p.data.0[0]; let x1 = q[0] - q[1]; let [(x2, x3), (_, x4), (_, x5)] =
            T::sin_cos_all([x1, q[0], q[1]]); let x6 = (T::from_f64(2.0) - x3 * x3)
            .recip(); jacobian.velocity_by_momentum.add(0, 0, x6); let x7 = - x3 * x6;
            jacobian.velocity_by_momentum.add(0, 1, x7); jacobian.velocity_by_momentum
            .add(1, 0, x7); jacobian.velocity_by_momentum.add(1, 1, T::from_f64(2.0) *
            x6); let x8 = T::from_f64(2.0) * x3; let x9 = x6 * x6; let x10 = x2 * (p[1] *
            x6 - x8 * (p[0] * x9 - p[1] * x3 * x9)); jacobian.velocity_by_position.add(0,
            0, x10); jacobian.velocity_by_position.add(0, 1, - x10); let x11 = x2 * (p[0]
            * x6 + x8 * (p[0] * x3 * x9 - T::from_f64(2.0) * p[1] * x9)); jacobian
            .velocity_by_position.add(1, 0, x11); jacobian.velocity_by_position.add(1, 1,
            - x11); let x12 = p[0] * p[1]; let x13 = T::from_f64(2.0) * p[0] * p[1]; let
            x14 = p[0] * p[0] - x13 * x3 + T::from_f64(2.0) * (p[1] * p[1]); let x15 = x9
            * x14; let x16 = x3 * x2; let x17 = x3 * (x12 * x6 - x3 * x15) + x2 * (x2 *
            x15 - x13 * (x9 * x16) - x8 * (x12 * x9 * x2 - T::from_f64(2.0) * (x6 * x9) *
            x14 * x16)); jacobian.force_by_position.add(0, 0, - (T::from_f64(2.0 * self
            .g) * x4 + x17)); jacobian.force_by_position.add(0, 1, x17); jacobian
            .force_by_position.add(1, 0, x17); jacobian.force_by_position.add(1, 1, -
            (x17 + T::from_f64(self.g) * x5)); true }
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
            let x6 = (T::from_f64(2.0) - x3 * x3).recip();
            velocity[0] = p[0] * x6 - p[1] * x3 * x6;
            velocity[1] = T::from_f64(2.0) * p[1] * x6 - p[0] * x3 * x6;
            let x7 = x2
                * (p[0] * p[1] * x6
                    - x3
                        * (x6 * x6
                            * (p[0] * p[0] - T::from_f64(2.0) * p[0] * p[1] * x3
                                + T::from_f64(2.0) * (p[1] * p[1]))));
            force[0] = -(T::from_f64(2.0) * T::from_lanes(&self.g) * x4 + x7);
            force[1] = x7 - T::from_lanes(&self.g) * x5;
        }
    }
    #[allow(unused_variables, non_snake_case, clippy::all)]
    impl ::symplectic::system::Lagrangian for DoublePendulum {
        type Vector<T: Scalar> = ::symplectic::nalgebra::SVector<T, 2>;
        fn lagrangian<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SVector<T, 2>,
            v: &::symplectic::nalgebra::SVector<T, 2>,
        ) -> T {
            let q = &q.data.0[0];
            let v = &v.data.0[0];
            let [(_, x1), (_, x2), (_, x3)] = T::sin_cos_all([q[0] - q[1], q[0], q[1]]);
            let result_1 = T::from_f64(self.g) * (T::from_f64(2.0) * x2 + x3)
                + v[0] * v[0] + T::from_f64(0.5) * (v[1] * v[1]) + v[0] * v[1] * x1;
            result_1
        }
        fn gradient<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SVector<T, 2>,
            v: &::symplectic::nalgebra::SVector<T, 2>,
            by_velocity: &mut ::symplectic::nalgebra::SVector<T, 2>,
            by_position: &mut ::symplectic::nalgebra::SVector<T, 2>,
        ) -> bool {
            let write = |
                by_velocity: &mut ::symplectic::nalgebra::SVector<T, 2>,
                by_position: &mut ::symplectic::nalgebra::SVector<T, 2>|
            {
                let q = &q.data.0[0];
                let v = &v.data.0[0];
                let by_velocity = &mut by_velocity.data.0[0];
                let by_position = &mut by_position.data.0[0];
                let x1 = q[0] - q[1];
                let [(x2, x3), (x4, _), (x5, _)] = T::sin_cos_all([x1, q[0], q[1]]);
                by_velocity[0] = T::from_f64(2.0) * v[0] + v[1] * x3;
                by_velocity[1] = v[1] + v[0] * x3;
                let x6 = x2 * (v[0] * v[1]);
                by_position[0] = -(T::from_f64(2.0 * self.g) * x4 + x6);
                by_position[1] = x6 - T::from_f64(self.g) * x5;
            };
            write(by_velocity, by_position);
            true
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
    impl ::symplectic::emitted::Named for DoublePendulum {
        const NAMES: [&'static [&'static str]; 2] = [&["a", "b"], &["pa", "pb"]];
    }
    #[allow(unused_variables, non_snake_case, clippy::all)]
    impl DoublePendulum {
        /// The momenta `p = ∂L/∂v` of these velocities: `State::new(t, q, system.momentum_of_velocity(t, &q, &v))` is where to start.
        pub fn momentum_of_velocity<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SVector<T, 2>,
            v: &::symplectic::nalgebra::SVector<T, 2>,
        ) -> ::symplectic::nalgebra::SVector<T, 2> {
            let mut result = v.clone();
            let write = |momentum: &mut ::symplectic::nalgebra::SVector<T, 2>| {
                let q = &q.data.0[0];
                let v = &v.data.0[0];
                let momentum = &mut momentum.data.0[0];
                let x1 = (q[0] - q[1]).cos();
                momentum[0] = T::from_f64(2.0) * v[0] + v[1] * x1;
                momentum[1] = v[1] + v[0] * x1;
            };
            write(&mut result);
            result
        }
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
