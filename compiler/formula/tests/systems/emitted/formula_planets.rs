/**

```text
H = (1/2) Σ(0 ≤ i < N) (p[i][0]² + p[i][1]² + p[i][2]²)/m[i] − Σ(0 ≤ i < N) Σ(i+1 ≤ j < N) G m[i] m[j]/√((q[i][0] − q[j][0])² + (q[i][1] − q[j][1])² + (q[i][2] − q[j][2])²)

q'[i][0] = p[i][0]/m[i]    (0 ≤ i < N)
q'[i][1] = p[i][1]/m[i]    (0 ≤ i < N)
q'[i][2] = p[i][2]/m[i]    (0 ≤ i < N)
p'[i][0] += −Σ(i+1 ≤ j < N) (q[i][0] − q[j][0]) s1(i, j)    (0 ≤ i < N)
p'[i][1] += −Σ(i+1 ≤ j < N) (q[i][1] − q[j][1]) s1(i, j)    (0 ≤ i < N)
p'[i][2] += −Σ(i+1 ≤ j < N) (q[i][2] − q[j][2]) s1(i, j)    (0 ≤ i < N)
p'[j][0] += (q[i][0] − q[j][0]) s1(i, j)    (0 ≤ i < N, i+1 ≤ j < N)
p'[j][1] += (q[i][1] − q[j][1]) s1(i, j)    (0 ≤ i < N, i+1 ≤ j < N)
p'[j][2] += (q[i][2] − q[j][2]) s1(i, j)    (0 ≤ i < N, i+1 ≤ j < N)
s1(i, j) = G m[i] m[j]/((q[i][0] − q[j][0])² + (q[i][1] − q[j][1])² + (q[i][2] − q[j][2])²)^(3/2)
```

$$H = \\tfrac{1}{2}\\,\\sum\_{0 \\le i \< N} \\frac{\\left({p\_{i,0}}^{2} + {p\_{i,1}}^{2} + {p\_{i,2}}^{2}\\right)}{m\_{i}} - \\sum\_{0 \\le i \< N} \\sum\_{i+1 \\le j \< N} \\frac{G\\,m\_{i}\\,m\_{j}}{\\sqrt{{\\left(q\_{i,0} - q\_{j,0}\\right)}^{2} + {\\left(q\_{i,1} - q\_{j,1}\\right)}^{2} + {\\left(q\_{i,2} - q\_{j,2}\\right)}^{2}}}$$
$$\\dot{q\_{i,0}} = \\frac{p\_{i,0}}{m\_{i}}\\quad (0 \\le i \< N)$$
$$\\dot{q\_{i,1}} = \\frac{p\_{i,1}}{m\_{i}}\\quad (0 \\le i \< N)$$
$$\\dot{q\_{i,2}} = \\frac{p\_{i,2}}{m\_{i}}\\quad (0 \\le i \< N)$$
$$\\dot{p\_{i,0}} \\mathrel{+}= -\\sum\_{i+1 \\le j \< N} \\left(q\_{i,0} - q\_{j,0}\\right)\\,s\_{1}(i, j)\\quad (0 \\le i \< N)$$
$$\\dot{p\_{i,1}} \\mathrel{+}= -\\sum\_{i+1 \\le j \< N} \\left(q\_{i,1} - q\_{j,1}\\right)\\,s\_{1}(i, j)\\quad (0 \\le i \< N)$$
$$\\dot{p\_{i,2}} \\mathrel{+}= -\\sum\_{i+1 \\le j \< N} \\left(q\_{i,2} - q\_{j,2}\\right)\\,s\_{1}(i, j)\\quad (0 \\le i \< N)$$
$$\\dot{p\_{j,0}} \\mathrel{+}= \\left(q\_{i,0} - q\_{j,0}\\right)\\,s\_{1}(i, j)\\quad (0 \\le i \< N,\\; i+1 \\le j \< N)$$
$$\\dot{p\_{j,1}} \\mathrel{+}= \\left(q\_{i,1} - q\_{j,1}\\right)\\,s\_{1}(i, j)\\quad (0 \\le i \< N,\\; i+1 \\le j \< N)$$
$$\\dot{p\_{j,2}} \\mathrel{+}= \\left(q\_{i,2} - q\_{j,2}\\right)\\,s\_{1}(i, j)\\quad (0 \\le i \< N,\\; i+1 \\le j \< N)$$
$$s\_{1}(i, j) = \\frac{G\\,m\_{i}\\,m\_{j}}{{\\left({\\left(q\_{i,0} - q\_{j,0}\\right)}^{2} + {\\left(q\_{i,1} - q\_{j,1}\\right)}^{2} + {\\left(q\_{i,2} - q\_{j,2}\\right)}^{2}\\right)}^{3/2}}$$

Found in the formula: separable, with a kinetic energy of constant masses; independent of time, so H is conserved; `total_momentum` in x, y and z is conserved; `angular_momentum` about x, y and z is conserved.
*/
#[allow(non_snake_case)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Planets<const N: usize> {
    /// The parameter `m`.
    pub m: [f64; N],
    /// The parameter `G`, 0.000295912208286 unless it is set.
    pub G: f64,
}
impl<const N: usize> Planets<N> {
    /// The system with these parameters, and the values of the definition for the others.
    #[allow(non_snake_case, clippy::too_many_arguments)]
    pub const fn new(m: [f64; N]) -> Self {
        Self { m, G: 0.000295912208286 }
    }
}
const _: () = {
    #[allow(unused_imports, clippy::all)]
    use ::symplectic::emitted::{One as _, Scalar, Zero as _};
    #[allow(unused_variables, non_snake_case, clippy::all)]
    impl<const N: usize> ::symplectic::SeparableHamiltonian for Planets<N> {
        type Vector<T: Scalar> = ::symplectic::nalgebra::SMatrix<T, 3, N>;
        const INLINED: bool = true;
        const JOINS: bool = true;
        #[inline(always)]
        fn in_lanes_of_separable<LaneVector, LaneScalar, LaneWork>(
            work: LaneWork,
        ) -> LaneWork::Output
        where
            Self: ::symplectic::System<LaneVector, Class = ::symplectic::Separable>,
            LaneVector: ::symplectic::Vector,
            LaneScalar: ::symplectic::simd::Lanes,
            LaneWork: ::symplectic::emitted::LaneWork<LaneVector, Self, LaneScalar>,
        {
            work.run::<
                    ::symplectic::nalgebra::SMatrix<LaneScalar, 3, N>,
                    PlanetsInLanes<N>,
                >(PlanetsInLanes::join)
        }
        #[inline(always)]
        fn velocity<T: Scalar>(
            &self,
            time: T,
            p: &::symplectic::nalgebra::SMatrix<T, 3, N>,
            velocity: &mut ::symplectic::nalgebra::SMatrix<T, 3, N>,
        ) {
            let p = &p.data.0;
            let velocity = &mut velocity.data.0;
            for i in 0..N {
                let x1 = 1.0 / self.m[i];
                velocity[i][0] = T::from_f64(x1) * p[i][0];
                velocity[i][1] = T::from_f64(x1) * p[i][1];
                velocity[i][2] = T::from_f64(x1) * p[i][2];
            }
        }
        #[inline(always)]
        fn force<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SMatrix<T, 3, N>,
            force: &mut ::symplectic::nalgebra::SMatrix<T, 3, N>,
        ) {
            let q = &q.data.0;
            let force = &mut force.data.0;
            force.as_flattened_mut().fill(T::zero());
            for i in 0..N {
                let mut x1 = T::zero();
                let mut x2 = T::zero();
                let mut x3 = T::zero();
                let x4 = self.G * self.m[i];
                for j in i + 1..N {
                    let x5 = q[i][2] - q[j][2];
                    let x6 = q[i][0] - q[j][0];
                    let x7 = q[i][1] - q[j][1];
                    let x8 = x6 * x6 + x7 * x7 + x5 * x5;
                    let x9 = T::from_f64(x4 * self.m[j]) / (x8 * x8.sqrt());
                    let x10 = x5 * x9;
                    x1 += x10;
                    let x11 = x7 * x9;
                    x2 += x11;
                    let x12 = x6 * x9;
                    x3 += x12;
                    force[j][0] += x12;
                    force[j][1] += x11;
                    force[j][2] += x10;
                }
                force[i][0] += -x3;
                force[i][1] += -x2;
                force[i][2] += -x1;
            }
        }
        const FORCE_GRADIENT: bool = true;
        #[inline(always)]
        fn force_gradient<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SMatrix<T, 3, N>,
            force: &::symplectic::nalgebra::SMatrix<T, 3, N>,
            gradient: &mut ::symplectic::nalgebra::SMatrix<T, 3, N>,
        ) {
            let p = force;
            let q = &q.data.0;
            let p = &p.data.0;
            let gradient = &mut gradient.data.0;
            gradient.as_flattened_mut().fill(T::zero());
            for i in 0..N {
                let mut x1 = T::zero();
                let mut x2 = T::zero();
                let mut x3 = T::zero();
                let x4 = 1.0 / self.m[i];
                let x5 = T::from_f64(x4) * p[i][2];
                let x6 = T::from_f64(x4) * p[i][1];
                let x7 = T::from_f64(x4) * p[i][0];
                let x8 = self.G * self.m[i];
                for j in i + 1..N {
                    let x9 = x8 * self.m[j];
                    let x10 = q[i][0] - q[j][0];
                    let x11 = q[i][1] - q[j][1];
                    let x12 = q[i][2] - q[j][2];
                    let x13 = x10 * x10 + x11 * x11 + x12 * x12;
                    let x14 = x13.sqrt();
                    let x15 = T::from_f64(x9) / (x13 * x14);
                    let x16 = 1.0 / self.m[j];
                    let x17 = x5 - T::from_f64(x16) * p[j][2];
                    let x18 = x7 - T::from_f64(x16) * p[j][0];
                    let x19 = x6 - T::from_f64(x16) * p[j][1];
                    let x20 = T::from_f64(x9)
                        * (T::from_f64(2.0) * x10 * x18 + T::from_f64(2.0) * x11 * x19
                            + T::from_f64(2.0) * x12 * x17) / (x13 * x13 * x14);
                    let x21 = x15 * x17 - T::from_f64(1.5) * x12 * x20;
                    x1 += x21;
                    let x22 = x15 * x19 - T::from_f64(1.5) * x11 * x20;
                    x2 += x22;
                    let x23 = x15 * x18 - T::from_f64(1.5) * x10 * x20;
                    x3 += x23;
                    gradient[j][0] += x23;
                    gradient[j][1] += x22;
                    gradient[j][2] += x21;
                }
                gradient[i][0] += -x3;
                gradient[i][1] += -x2;
                gradient[i][2] += -x1;
            }
        }
        fn energy<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SMatrix<T, 3, N>,
            p: &::symplectic::nalgebra::SMatrix<T, 3, N>,
        ) -> ::core::option::Option<T> {
            let q = &q.data.0;
            let p = &p.data.0;
            let mut x1 = T::zero();
            let mut x2 = T::zero();
            for i in 0..N {
                let mut x3 = T::zero();
                let x4 = self.G * self.m[i];
                for j in i + 1..N {
                    let x5 = q[i][0] - q[j][0];
                    let x6 = q[i][1] - q[j][1];
                    let x7 = q[i][2] - q[j][2];
                    x3
                        += T::from_f64(x4 * self.m[j])
                            / (x5 * x5 + x6 * x6 + x7 * x7).sqrt();
                }
                x1
                    += T::from_f64(1.0 / self.m[i])
                        * (p[i][0] * p[i][0] + p[i][1] * p[i][1] + p[i][2] * p[i][2]);
                x2 += x3;
            }
            let result_1 = T::from_f64(0.5) * x1 - x2;
            ::core::option::Option::Some(result_1)
        }
        ::symplectic::emitted::if_alloc! {
            fn second_derivatives < T : Scalar > (& self, time : T, q : &
            ::symplectic::nalgebra::SMatrix < T, 3, N >, p : &
            ::symplectic::nalgebra::SMatrix < T, 3, N >, jacobian : & mut
            ::symplectic::system::Jacobian < T >) -> bool { let q = & q.data.0; let p = &
            p.data.0; for i in 0..N { let mut x1 = T::zero(); let mut x2 = T::zero(); let
            mut x3 = T::zero(); let mut x4 = T::zero(); let mut x5 = T::zero(); let mut
            x6 = T::zero(); let mut x7 = T::zero(); let mut x8 = T::zero(); let mut x9 =
            T::zero(); let x10 = self.G * self.m[i]; for j in i + 1..N { let x11 = q[i]
            [2] - q[j] [2]; let x12 = x10 * self.m[j]; let x13 = q[i] [0] - q[j] [0]; let
            x14 = q[i] [1] - q[j] [1]; let x15 = x13 * x13 + x14 * x14 + x11 * x11; let
            x16 = x15.sqrt(); let x17 = (x15 * x15 * x16).recip(); let x18 =
            T::from_f64(x12) * x13 * x17; x1 += x11 * x18; x2 += x14 * x18; let x19 =
            T::from_f64(x12) / (x15 * x16); let x20 = T::from_f64(3.0) * x13; let x21 =
            x20 * x18; let x22 = x19 - x21; x3 += x22; let x23 = T::from_f64(x12) * x14 *
            x17; x4 += x11 * x23; let x24 = T::from_f64(3.0) * x14; let x25 = x24 * x23;
            let x26 = x19 - x25; x5 += x26; x6 += x13 * x23; let x27 = T::from_f64(3.0) *
            x11; let x28 = T::from_f64(x12) * x11 * x17; let x29 = x27 * x28; let x30 =
            x19 - x29; x7 += x30; x8 += x14 * x28; x9 += x13 * x28; jacobian
            .force_by_position.add(i * 3 + 0, j * 3 + 0, x22); let x31 = x24 * x18; let
            x32 = - x31; jacobian.force_by_position.add(i * 3 + 0, j * 3 + 1, x32); let
            x33 = x27 * x18; let x34 = - x33; jacobian.force_by_position.add(i * 3 + 0, j
            * 3 + 2, x34); let x35 = x20 * x23; let x36 = - x35; jacobian
            .force_by_position.add(i * 3 + 1, j * 3 + 0, x36); jacobian.force_by_position
            .add(i * 3 + 1, j * 3 + 1, x26); let x37 = x27 * x23; let x38 = - x37;
            jacobian.force_by_position.add(i * 3 + 1, j * 3 + 2, x38); let x39 = x20 *
            x28; let x40 = - x39; jacobian.force_by_position.add(i * 3 + 2, j * 3 + 0,
            x40); let x41 = x24 * x28; let x42 = - x41; jacobian.force_by_position.add(i
            * 3 + 2, j * 3 + 1, x42); jacobian.force_by_position.add(i * 3 + 2, j * 3 +
            2, x30); jacobian.force_by_position.add(j * 3 + 0, i * 3 + 0, x22); jacobian
            .force_by_position.add(j * 3 + 0, i * 3 + 1, x32); jacobian.force_by_position
            .add(j * 3 + 0, i * 3 + 2, x34); jacobian.force_by_position.add(j * 3 + 0, j
            * 3 + 0, x21 - x19); jacobian.force_by_position.add(j * 3 + 0, j * 3 + 1,
            x31); jacobian.force_by_position.add(j * 3 + 0, j * 3 + 2, x33); jacobian
            .force_by_position.add(j * 3 + 1, i * 3 + 0, x36); jacobian.force_by_position
            .add(j * 3 + 1, i * 3 + 1, x26); jacobian.force_by_position.add(j * 3 + 1, i
            * 3 + 2, x38); jacobian.force_by_position.add(j * 3 + 1, j * 3 + 0, x35);
            jacobian.force_by_position.add(j * 3 + 1, j * 3 + 1, x25 - x19); jacobian
            .force_by_position.add(j * 3 + 1, j * 3 + 2, x37); jacobian.force_by_position
            .add(j * 3 + 2, i * 3 + 0, x40); jacobian.force_by_position.add(j * 3 + 2, i
            * 3 + 1, x42); jacobian.force_by_position.add(j * 3 + 2, i * 3 + 2, x30);
            jacobian.force_by_position.add(j * 3 + 2, j * 3 + 0, x39); jacobian
            .force_by_position.add(j * 3 + 2, j * 3 + 1, x41); jacobian.force_by_position
            .add(j * 3 + 2, j * 3 + 2, x29 - x19); } let x43 = 1.0 / self.m[i]; jacobian
            .velocity_by_momentum.add(i * 3 + 0, i * 3 + 0, T::from_f64(x43)); jacobian
            .velocity_by_momentum.add(i * 3 + 1, i * 3 + 1, T::from_f64(x43)); jacobian
            .velocity_by_momentum.add(i * 3 + 2, i * 3 + 2, T::from_f64(x43)); jacobian
            .force_by_position.add(i * 3 + 0, i * 3 + 0, - x3); jacobian
            .force_by_position.add(i * 3 + 0, i * 3 + 1, T::from_f64(3.0) * x2); jacobian
            .force_by_position.add(i * 3 + 0, i * 3 + 2, T::from_f64(3.0) * x1); jacobian
            .force_by_position.add(i * 3 + 1, i * 3 + 0, T::from_f64(3.0) * x6); jacobian
            .force_by_position.add(i * 3 + 1, i * 3 + 1, - x5); jacobian
            .force_by_position.add(i * 3 + 1, i * 3 + 2, T::from_f64(3.0) * x4); jacobian
            .force_by_position.add(i * 3 + 2, i * 3 + 0, T::from_f64(3.0) * x9); jacobian
            .force_by_position.add(i * 3 + 2, i * 3 + 1, T::from_f64(3.0) * x8); jacobian
            .force_by_position.add(i * 3 + 2, i * 3 + 2, - x7); } true }
        }
        #[allow(unused_variables)]
        fn check_dimension(
            &self,
            dimension: usize,
        ) -> ::core::result::Result<(), ::symplectic::Error> {
            ::symplectic::emitted::check_numbers("m", &self.m[..])?;
            ::symplectic::emitted::check_number("G", self.G)?;
            ::core::result::Result::Ok(())
        }
    }
    #[allow(non_snake_case)]
    struct PlanetsInLanes<const N: usize> {
        m: <[f64; N] as ::symplectic::emitted::LaneParameter>::InLanes,
        G: <f64 as ::symplectic::emitted::LaneParameter>::InLanes,
    }
    #[allow(non_snake_case)]
    impl<const N: usize> PlanetsInLanes<N> {
        fn join(
            systems: &mut dyn ::core::iter::Iterator<Item = &Planets<N>>,
        ) -> ::core::option::Option<Self> {
            use ::symplectic::emitted::LaneParameter as _;
            let first = systems.next()?;
            let mut joined = Self {
                m: first.m.in_all_lanes(),
                G: first.G.in_all_lanes(),
            };
            for (lane, system) in (1..).zip(systems) {
                system.m.set_lane(lane, &mut joined.m)?;
                system.G.set_lane(lane, &mut joined.G)?;
            }
            ::core::option::Option::Some(joined)
        }
    }
    #[allow(unused_variables, non_snake_case, clippy::all)]
    impl<const N: usize> ::symplectic::SeparableHamiltonian for PlanetsInLanes<N> {
        type Vector<T: Scalar> = ::symplectic::nalgebra::SMatrix<T, 3, N>;
        #[inline(always)]
        fn velocity<T: Scalar>(
            &self,
            time: T,
            p: &::symplectic::nalgebra::SMatrix<T, 3, N>,
            velocity: &mut ::symplectic::nalgebra::SMatrix<T, 3, N>,
        ) {
            let p = &p.data.0;
            let velocity = &mut velocity.data.0;
            for i in 0..N {
                let x1 = T::from_lanes(&self.m[i]).recip();
                velocity[i][0] = x1 * p[i][0];
                velocity[i][1] = x1 * p[i][1];
                velocity[i][2] = x1 * p[i][2];
            }
        }
        #[inline(always)]
        fn force<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SMatrix<T, 3, N>,
            force: &mut ::symplectic::nalgebra::SMatrix<T, 3, N>,
        ) {
            let q = &q.data.0;
            let force = &mut force.data.0;
            force.as_flattened_mut().fill(T::zero());
            for i in 0..N {
                let mut x1 = T::zero();
                let mut x2 = T::zero();
                let mut x3 = T::zero();
                let x4 = T::from_lanes(&self.G) * T::from_lanes(&self.m[i]);
                for j in i + 1..N {
                    let x5 = q[i][2] - q[j][2];
                    let x6 = q[i][0] - q[j][0];
                    let x7 = q[i][1] - q[j][1];
                    let x8 = x6 * x6 + x7 * x7 + x5 * x5;
                    let x9 = x4 * T::from_lanes(&self.m[j]) / (x8 * x8.sqrt());
                    let x10 = x5 * x9;
                    x1 += x10;
                    let x11 = x7 * x9;
                    x2 += x11;
                    let x12 = x6 * x9;
                    x3 += x12;
                    force[j][0] += x12;
                    force[j][1] += x11;
                    force[j][2] += x10;
                }
                force[i][0] += -x3;
                force[i][1] += -x2;
                force[i][2] += -x1;
            }
        }
        const FORCE_GRADIENT: bool = true;
        #[inline(always)]
        fn force_gradient<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SMatrix<T, 3, N>,
            force: &::symplectic::nalgebra::SMatrix<T, 3, N>,
            gradient: &mut ::symplectic::nalgebra::SMatrix<T, 3, N>,
        ) {
            let p = force;
            let q = &q.data.0;
            let p = &p.data.0;
            let gradient = &mut gradient.data.0;
            gradient.as_flattened_mut().fill(T::zero());
            for i in 0..N {
                let mut x1 = T::zero();
                let mut x2 = T::zero();
                let mut x3 = T::zero();
                let x4 = T::from_lanes(&self.m[i]).recip();
                let x5 = x4 * p[i][2];
                let x6 = x4 * p[i][1];
                let x7 = x4 * p[i][0];
                let x8 = T::from_lanes(&self.G) * T::from_lanes(&self.m[i]);
                for j in i + 1..N {
                    let x9 = x8 * T::from_lanes(&self.m[j]);
                    let x10 = q[i][0] - q[j][0];
                    let x11 = q[i][1] - q[j][1];
                    let x12 = q[i][2] - q[j][2];
                    let x13 = x10 * x10 + x11 * x11 + x12 * x12;
                    let x14 = x13.sqrt();
                    let x15 = x9 / (x13 * x14);
                    let x16 = T::from_lanes(&self.m[j]).recip();
                    let x17 = x5 - x16 * p[j][2];
                    let x18 = x7 - x16 * p[j][0];
                    let x19 = x6 - x16 * p[j][1];
                    let x20 = x9
                        * (T::from_f64(2.0) * x10 * x18 + T::from_f64(2.0) * x11 * x19
                            + T::from_f64(2.0) * x12 * x17) / (x13 * x13 * x14);
                    let x21 = x15 * x17 - T::from_f64(1.5) * x12 * x20;
                    x1 += x21;
                    let x22 = x15 * x19 - T::from_f64(1.5) * x11 * x20;
                    x2 += x22;
                    let x23 = x15 * x18 - T::from_f64(1.5) * x10 * x20;
                    x3 += x23;
                    gradient[j][0] += x23;
                    gradient[j][1] += x22;
                    gradient[j][2] += x21;
                }
                gradient[i][0] += -x3;
                gradient[i][1] += -x2;
                gradient[i][2] += -x1;
            }
        }
    }
    impl<const N: usize> ::symplectic::emitted::Named for Planets<N> {
        const COMPONENTS: ::core::option::Option<usize> = ::core::option::Option::Some(
            3,
        );
    }
    #[allow(unused_variables, non_snake_case, clippy::all)]
    impl<const N: usize> Planets<N> {
        /// `momentum`, which the exact flow conserves: H has the symmetry.
        pub fn momentum<T: Scalar>(
            &self,
            q: &::symplectic::nalgebra::SMatrix<T, 3, N>,
            p: &::symplectic::nalgebra::SMatrix<T, 3, N>,
        ) -> [T; 3] {
            let q = &q.data.0;
            let p = &p.data.0;
            let mut x1 = T::zero();
            let mut x2 = T::zero();
            let mut x3 = T::zero();
            for i in 0..N {
                x1 += p[i][0];
                x2 += p[i][1];
                x3 += p[i][2];
            }
            let result_1 = x1;
            let result_2 = x2;
            let result_3 = x3;
            [result_1, result_2, result_3]
        }
        /// `angular_momentum`, which the exact flow conserves: H has the symmetry.
        pub fn angular_momentum<T: Scalar>(
            &self,
            q: &::symplectic::nalgebra::SMatrix<T, 3, N>,
            p: &::symplectic::nalgebra::SMatrix<T, 3, N>,
        ) -> [T; 3] {
            let q = &q.data.0;
            let p = &p.data.0;
            let mut x1 = T::zero();
            let mut x2 = T::zero();
            let mut x3 = T::zero();
            for i in 0..N {
                x1 += p[i][2] * q[i][1] - p[i][1] * q[i][2];
                x2 += p[i][0] * q[i][2] - p[i][2] * q[i][0];
                x3 += p[i][1] * q[i][0] - p[i][0] * q[i][1];
            }
            let result_1 = x1;
            let result_2 = x2;
            let result_3 = x3;
            [result_1, result_2, result_3]
        }
        /// Observers of what the exact flow conserves, from a first state: `energy`, `momentum[0]`, `momentum[1]`, `momentum[2]`, `angular_momentum[0]`, `angular_momentum[1]`, `angular_momentum[2]`.
        #[inline]
        pub fn invariants(
            &self,
            start: &::symplectic::State<::symplectic::nalgebra::SMatrix<f64, 3, N>>,
        ) -> [(
            &'static str,
            ::symplectic::Invariant<
                impl Fn(
                    &::symplectic::State<::symplectic::nalgebra::SMatrix<f64, 3, N>>,
                ) -> f64 + use<N>,
            >,
        ); 7] {
            ::symplectic::emitted::invariants(
                [
                    "energy",
                    "momentum[0]",
                    "momentum[1]",
                    "momentum[2]",
                    "angular_momentum[0]",
                    "angular_momentum[1]",
                    "angular_momentum[2]",
                ],
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
                    1 => system.momentum(&state.q, &state.p)[0],
                    2 => system.momentum(&state.q, &state.p)[1],
                    3 => system.momentum(&state.q, &state.p)[2],
                    4 => system.angular_momentum(&state.q, &state.p)[0],
                    5 => system.angular_momentum(&state.q, &state.p)[1],
                    6 => system.angular_momentum(&state.q, &state.p)[2],
                    _ => f64::NAN,
                },
                start,
            )
        }
    }
};
