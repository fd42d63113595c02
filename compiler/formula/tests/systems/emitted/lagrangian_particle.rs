/**

```text
L = −m c² √(1 − (vx² + vy²)/c²) − (1/2) (x² + y²)
px = vx ((m c²/√(1 − (vx² + vy²)/c²))/c²)
py = vy ((m c²/√(1 − (vx² + vy²)/c²))/c²)
x' = vx
y' = vy
px' = −x − vx drag
py' = −y − vy drag
```

$$L = -m\\,{c}^{2}\\,\\sqrt{1 - \\frac{\\left({\\mathrm{vx}}^{2} + {\\mathrm{vy}}^{2}\\right)}{{c}^{2}}} - \\tfrac{1}{2}\\,\\left({x}^{2} + {y}^{2}\\right)$$
$$\\mathrm{px} = \\mathrm{vx}\\,\\left(\\frac{\\left(\\frac{m\\,{c}^{2}}{\\sqrt{1 - \\frac{\\left({\\mathrm{vx}}^{2} + {\\mathrm{vy}}^{2}\\right)}{{c}^{2}}}}\\right)}{{c}^{2}}\\right)$$
$$\\mathrm{py} = \\mathrm{vy}\\,\\left(\\frac{\\left(\\frac{m\\,{c}^{2}}{\\sqrt{1 - \\frac{\\left({\\mathrm{vx}}^{2} + {\\mathrm{vy}}^{2}\\right)}{{c}^{2}}}}\\right)}{{c}^{2}}\\right)$$
$$\\dot{x} = \\mathrm{vx}$$
$$\\dot{y} = \\mathrm{vy}$$
$$\\dot{\\mathrm{px}} = -x - \\mathrm{vx}\\,\\mathrm{drag}$$
$$\\dot{\\mathrm{py}} = -y - \\mathrm{vy}\\,\\mathrm{drag}$$

Found in the formula: not quadratic in the velocities, so there is no formula of H: steps are those of `symplectic::variational::LagrangianIntegrator`, by L and its derivatives.
*/
#[allow(non_snake_case)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Particle {
    /// The parameter `m`, 1 unless it is set.
    pub m: f64,
    /// The parameter `c`, 1 unless it is set.
    pub c: f64,
    /// The parameter `drag`, 0 unless it is set.
    pub drag: f64,
}
impl Particle {
    /// The system with these parameters, and the values of the definition for the others.
    #[allow(non_snake_case, clippy::too_many_arguments)]
    pub const fn new() -> Self {
        Self { m: 1.0, c: 1.0, drag: 0.0 }
    }
}
impl ::core::default::Default for Particle {
    fn default() -> Self {
        Self::new()
    }
}
const _: () = {
    #[allow(unused_imports, clippy::all)]
    use ::symplectic::emitted::{One as _, Scalar, Zero as _};
    #[allow(unused_variables, non_snake_case, clippy::all)]
    impl ::symplectic::system::Lagrangian for Particle {
        type Vector<T: Scalar> = ::symplectic::nalgebra::SVector<T, 2>;
        fn lagrangian<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SVector<T, 2>,
            v: &::symplectic::nalgebra::SVector<T, 2>,
        ) -> T {
            let q = &q.data.0[0];
            let v = &v.data.0[0];
            let x1 = self.c * self.c;
            let result_1 = -(T::from_f64(self.m * x1)
                * (T::one() - T::from_f64(1.0 / x1) * (v[0] * v[0] + v[1] * v[1])).sqrt()
                + T::from_f64(0.5) * (q[0] * q[0] + q[1] * q[1]));
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
                let x1 = 1.0 / self.c;
                let x2 = x1 * x1;
                let x3 = T::from_f64(x2)
                    * (T::from_f64(self.m * (self.c * self.c))
                        / (T::one() - T::from_f64(x2) * (v[0] * v[0] + v[1] * v[1]))
                            .sqrt());
                by_velocity[0] = v[0] * x3;
                by_velocity[1] = v[1] * x3;
                by_position[0] = -q[0];
                by_position[1] = -q[1];
            };
            write(by_velocity, by_position);
            true
        }
        const FORCED: bool = true;
        fn force<T: Scalar>(
            &self,
            time: T,
            q: &::symplectic::nalgebra::SVector<T, 2>,
            v: &::symplectic::nalgebra::SVector<T, 2>,
            force: &mut ::symplectic::nalgebra::SVector<T, 2>,
        ) {
            let q = &q.data.0[0];
            let v = &v.data.0[0];
            let force = &mut force.data.0[0];
            force[0] = -T::from_f64(self.drag) * v[0];
            force[1] = -T::from_f64(self.drag) * v[1];
        }
        #[allow(unused_variables)]
        fn check_dimension(
            &self,
            dimension: usize,
        ) -> ::core::result::Result<(), ::symplectic::Error> {
            ::symplectic::emitted::check_number("m", self.m)?;
            ::symplectic::emitted::check_number("c", self.c)?;
            ::symplectic::emitted::check_number("drag", self.drag)?;
            ::core::result::Result::Ok(())
        }
    }
    impl ::symplectic::emitted::Named for Particle {
        const NAMES: [&'static [&'static str]; 2] = [&["x", "y"], &["px", "py"]];
    }
    #[allow(unused_variables, non_snake_case, clippy::all)]
    impl Particle {
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
                let x1 = 1.0 / self.c;
                let x2 = x1 * x1;
                let x3 = T::from_f64(x2)
                    * (T::from_f64(self.m * (self.c * self.c))
                        / (T::one() - T::from_f64(x2) * (v[0] * v[0] + v[1] * v[1]))
                            .sqrt());
                momentum[0] = v[0] * x3;
                momentum[1] = v[1] * x3;
            };
            write(&mut result);
            result
        }
    }
};
