/**

```text
H = (1/2) Σ(0 ≤ i < n) p[i]² + (Σ(0 ≤ j < n-1) ((1/2) (q[j] − q[j+1])² + (1/4) beta (q[j] − q[j+1])⁴) + ((1/2) q[0]² + (1/4) beta q[0]⁴) + ((1/2) q[n-1]² + (1/4) beta q[n-1]⁴))

q'[i] = p[i]    (0 ≤ i < n)
p'[j] += −(q[j] − q[j+1]) − beta (q[j] − q[j+1])³    (0 ≤ j < n-1)
p'[j+1] += s1(j)    (0 ≤ j < n-1)
p'[0] += −q[0] − beta q[0]³
p'[n-1] += −q[n-1] − beta q[n-1]³
s1(j) = (q[j] − q[j+1]) + beta (q[j] − q[j+1])³
```

$$H = \\tfrac{1}{2}\\,\\sum\_{0 \\le i \< n} {p\_{i}}^{2} + \\left(\\sum\_{0 \\le j \< n-1} \\left(\\tfrac{1}{2}\\,{\\left(q\_{j} - q\_{j+1}\\right)}^{2} + \\tfrac{1}{4}\\,\\mathrm{beta}\\,{\\left(q\_{j} - q\_{j+1}\\right)}^{4}\\right) + \\left(\\tfrac{1}{2}\\,{q\_{0}}^{2} + \\tfrac{1}{4}\\,\\mathrm{beta}\\,{q\_{0}}^{4}\\right) + \\left(\\tfrac{1}{2}\\,{q\_{n-1}}^{2} + \\tfrac{1}{4}\\,\\mathrm{beta}\\,{q\_{n-1}}^{4}\\right)\\right)$$
$$\\dot{q\_{i}} = p\_{i}\\quad (0 \\le i \< n)$$
$$\\dot{p\_{j}} \\mathrel{+}= -\\left(q\_{j} - q\_{j+1}\\right) - \\mathrm{beta}\\,{\\left(q\_{j} - q\_{j+1}\\right)}^{3}\\quad (0 \\le j \< n-1)$$
$$\\dot{p\_{j+1}} \\mathrel{+}= s\_{1}(j)\\quad (0 \\le j \< n-1)$$
$$\\dot{p\_{0}} \\mathrel{+}= -q\_{0} - \\mathrm{beta}\\,{q\_{0}}^{3}$$
$$\\dot{p\_{n-1}} \\mathrel{+}= -q\_{n-1} - \\mathrm{beta}\\,{q\_{n-1}}^{3}$$
$$s\_{1}(j) = \\left(q\_{j} - q\_{j+1}\\right) + \\mathrm{beta}\\,{\\left(q\_{j} - q\_{j+1}\\right)}^{3}$$

Found in the formula: separable, with the kinetic energy |p|²/2; independent of time, so H is conserved; a polynomial of degree 4 in positions and momenta; a chain of neighbours.
*/
#[allow(non_snake_case)]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fput {
    /// The parameter `beta`, 1 unless it is set.
    pub beta: f64,
}
impl Fput {
    /// The system with these parameters, and the values of the definition for the others.
    #[allow(non_snake_case, clippy::too_many_arguments)]
    pub const fn new() -> Self {
        Self { beta: 1.0 }
    }
}
impl ::core::default::Default for Fput {
    fn default() -> Self {
        Self::new()
    }
}
const _: () = {
    #[allow(unused_imports, clippy::all)]
    use ::symplectic::emitted::{One as _, Scalar, Zero as _};
    #[allow(unused_variables, non_snake_case, clippy::all)]
    impl ::symplectic::emitted::Bonds for Fput {
        const INLINED: bool = true;
        #[inline(always)]
        fn tension<T: Scalar>(&self, time: T, stretch: T) -> T {
            let value = stretch
                + T::from_f64(self.beta) * (stretch * (stretch * stretch));
            value
        }
        const FORCE_GRADIENT: bool = true;
        #[inline(always)]
        fn stiffness<T: Scalar>(
            &self,
            time: T,
            stretch: T,
        ) -> ::core::option::Option<T> {
            ::core::option::Option::Some({
                let value = T::from_f64(3.0 * self.beta) * (stretch * stretch)
                    + T::one();
                value
            })
        }
        fn bond_energy<T: Scalar>(
            &self,
            time: T,
            stretch: T,
        ) -> ::core::option::Option<T> {
            ::core::option::Option::Some({
                let x1 = stretch * stretch;
                let value = T::from_f64(0.5) * x1
                    + T::from_f64(0.25 * self.beta) * (x1 * x1);
                value
            })
        }
        #[allow(unused_variables)]
        fn check_dimension(
            &self,
            dimension: usize,
        ) -> ::core::result::Result<(), ::symplectic::Error> {
            let n = ::symplectic::emitted::bodies(dimension, 1)?;
            ::symplectic::emitted::check_bodies(n, 1)?;
            ::symplectic::emitted::check_number("beta", self.beta)?;
            ::core::result::Result::Ok(())
        }
    }
    ::symplectic::emitted::chain_system!(
        () (Fput), | bonds : & Self | * bonds, between_walls
    );
    impl ::symplectic::emitted::Named for Fput {}
    #[allow(unused_variables, non_snake_case, clippy::all)]
    impl Fput {
        /// Observers of what the exact flow conserves, from a first state: `energy`.
        #[inline]
        pub fn invariants(
            &self,
            start: &::symplectic::State<::symplectic::nalgebra::DVector<f64>>,
        ) -> [(
            &'static str,
            ::symplectic::Invariant<
                impl Fn(
                    &::symplectic::State<::symplectic::nalgebra::DVector<f64>>,
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
