/// Documentation of the user.
/**

```text
2 stages, basis polynomial(2), nodes gauss(2)

              c │ a
────────────────┼─────────────────────────────────
1/2 - sqrt(3)/6 │             1/4  1/4 - sqrt(3)/6
1/2 + sqrt(3)/6 │ 1/4 + sqrt(3)/6              1/4
────────────────┼─────────────────────────────────
              b │             1/2              1/2

ã = a, b̃ = b, c̃ = c: the same for momenta.

properties
  symplectic          yes  proved
  symmetric           yes  proved
  consistent          yes  proved
  equal_matrices      yes  proved
  explicit            no   refuted  these stages need one another: Q1 → P1 → Q1
  first_row_zero      no   refuted  a_11 = 1/4
  stiffly_accurate    no   refuted  b_1 − a_21 = -0.0386751345948…
  first_same_as_last  no   refuted  a_11 = 1/4
  positive_weights    yes  proved
  constrained         no   refuted  a_11 = 1/4
  nonholonomic        no   refuted  steps with non-holonomic constraints have order 2 at most
```*/
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Gauss2;
#[allow(clippy::approx_constant)]
impl Gauss2 {
    /// a_ij: the position stages from the velocities. Correctly rounded.
    pub const A: [[f64; 2]; 2] = [
        [0.25, (-0.03867513459481288)],
        [0.5386751345948129, 0.25],
    ];
    /// ã_ij: the momentum stages from the forces. Correctly rounded.
    pub const A_TILDE: [[f64; 2]; 2] = Self::A;
    /// b_j: the weights of the velocities. Correctly rounded.
    pub const B: [f64; 2] = [0.5, 0.5];
    /// b̃_j: the weights of the forces. Correctly rounded.
    pub const B_TILDE: [f64; 2] = Self::B;
    /// c_i = Σ_j a_ij. Correctly rounded.
    pub const C: [f64; 2] = [0.2113248654051871, 0.7886751345948129];
    /// c̃_i = Σ_j ã_ij. Correctly rounded.
    pub const C_TILDE: [f64; 2] = Self::C;
}
#[allow(clippy::approx_constant)]
const _: () = {
    use ::symplectic::emitted;
    impl emitted::Method for Gauss2 {
        const NAME: &'static str = "Gauss2";
        const STAGES: usize = 2;
        const DEFINITION: &'static str = "basis: polynomial(2), nodes: gauss(2)";
        const COEFFICIENTS: emitted::Coefficients = {
            const A: &[&[emitted::Coefficient]] = &[
                &[
                    emitted::exact(0.25),
                    emitted::rounded((-0.03867513459481288), (-2.8473525618637145e-18)),
                ],
                &[
                    emitted::rounded(0.5386751345948129, 1.6725140369678172e-17),
                    emitted::exact(0.25),
                ],
            ];
            const B: &[emitted::Coefficient] = &[
                emitted::exact(0.5),
                emitted::exact(0.5),
            ];
            const C: &[emitted::Coefficient] = &[
                emitted::rounded(0.2113248654051871, 1.1030435245950743e-17),
                emitted::rounded(0.7886751345948129, 1.6725140369678172e-17),
            ];
            emitted::Coefficients::new([A, A], [B, B], [C, C])
        };
        const ORDERS: emitted::Orders = emitted::Orders {
            general: 4,
            separable: 4,
            nystrom: 4,
        };
        const SYMMETRY: emitted::Symmetry = emitted::Symmetry {
            general: true,
            separable: true,
        };
        type General = emitted::Coupled<Gauss2Plan<emitted::General>>;
        type Separable = emitted::Coupled<Gauss2Plan<emitted::Separable>>;
    }
    impl<C: emitted::Unconstrained> emitted::ProvedFor<C> for Gauss2 {}
    impl<C> emitted::SymmetricFor<C> for Gauss2 {}
    pub struct Gauss2Plan<K>(::core::marker::PhantomData<K>);
    impl<K: emitted::Class> Gauss2Plan<K> {
        const C: [emitted::Coefficient; 2] = [
            emitted::rounded(0.2113248654051871, 1.1030435245950743e-17),
            emitted::rounded(0.7886751345948129, 1.6725140369678172e-17),
        ];
        const B_TILDE: [emitted::Coefficient; 2] = [
            emitted::exact(0.5),
            emitted::exact(0.5),
        ];
        const C_TILDE: [emitted::Coefficient; 2] = Self::C;
        const B: [emitted::Coefficient; 2] = Self::B_TILDE;
        const Q_0: [emitted::Coefficient; 2] = [
            emitted::exact(0.5),
            emitted::Coefficient::new(
                (-0.07735026918962573),
                (-3.3450280739356345e-17),
                (-0.07735026),
            ),
        ];
        const Q_1: [emitted::Coefficient; 2] = [
            emitted::rounded(1.0773502691896257, 3.3450280739356345e-17),
            emitted::exact(0.5),
        ];
        const P_0: [emitted::Coefficient; 2] = Self::Q_0;
        const P_1: [emitted::Coefficient; 2] = Self::Q_1;
        const E: &'static [&'static [f64]] = <Self as emitted::StageTableau>::MOMENTA
            .extrapolation;
        const E_TILDE: &'static [&'static [f64]] = <Self as emitted::StageTableau>::POSITIONS
            .extrapolation;
    }
    #[allow(unused_variables)]
    impl<K: emitted::Class> emitted::StagePlan for Gauss2Plan<K> {
        type Class = K;
        type Stages<V: emitted::Vector> = emitted::Stages<V, 2, 2>;
        const EVALUATIONS: emitted::EvaluationCounts = emitted::EvaluationCounts {
            begin: 0,
            start: 1,
            sweep: 4,
            finish: 0,
            carried: 0,
        };
        #[inline]
        fn begin<
            R: emitted::Summation,
            V: emitted::Vector,
            S: emitted::System<V, Class = Self::Class>,
        >(
            step: &emitted::Step<'_, V>,
            system: &S,
            stages: &mut Self::Stages<V>,
            kept: emitted::WarmStart,
        ) {
            let sums = &mut emitted::StartingValues::<R>::new();
            if kept.stages {
                emitted::transform(&mut stages.velocity, [0, 1], Self::E);
                Self::positions(step, stages, sums);
                if !K::SEPARABLE {
                    emitted::transform(&mut stages.force, [0, 1], Self::E_TILDE);
                    Self::momenta(step, stages, sums);
                }
            } else {
                emitted::reset(&mut stages.p, [0, 1], step.p);
                let time = step.at(Self::C_TILDE[0]);
                system.velocity(time, step.q, step.p, &mut stages.velocity[0]);
                emitted::copy_to(&mut stages.velocity, 0, [1]);
                emitted::scale_all(&mut stages.velocity, [0, 1], step.size, Self::B);
                Self::positions(step, stages, sums);
            }
        }
        #[inline]
        fn forces<
            R: emitted::Summation,
            V: emitted::Vector,
            S: emitted::System<V, Class = Self::Class>,
        >(step: &emitted::Step<'_, V>, system: &S, stages: &mut Self::Stages<V>) {
            let emitted::Stages { q, p, force, .. } = stages;
            system.force(step.at(Self::C[0]), &q[0], &p[0], &mut force[0]);
            emitted::increment::<R, V>(&mut force[0], step.size, Self::B_TILDE[0]);
            system.force(step.at(Self::C[1]), &q[1], &p[1], &mut force[1]);
            emitted::increment::<R, V>(&mut force[1], step.size, Self::B_TILDE[1]);
        }
        #[inline]
        fn momenta<V: emitted::Vector, A: emitted::StageSums>(
            step: &emitted::Step<'_, V>,
            stages: &mut Self::Stages<V>,
            sums: &mut A,
        ) {
            let emitted::Stages { p, force, .. } = stages;
            let (base, terms) = ((step.p, step.p_low), [&force[0], &force[1]]);
            let weights = emitted::weights::<V::Scalar, _>(step.size, Self::B_TILDE);
            sums.increments(&mut p[0], base, Self::P_0, weights, terms);
            sums.increments(&mut p[1], base, Self::P_1, weights, terms);
        }
        #[inline]
        fn velocities<
            R: emitted::Summation,
            V: emitted::Vector,
            S: emitted::System<V, Class = Self::Class>,
        >(step: &emitted::Step<'_, V>, system: &S, stages: &mut Self::Stages<V>) {
            let emitted::Stages { q, p, velocity, .. } = stages;
            system.velocity(step.at(Self::C_TILDE[0]), &q[0], &p[0], &mut velocity[0]);
            emitted::increment::<R, V>(&mut velocity[0], step.size, Self::B[0]);
            system.velocity(step.at(Self::C_TILDE[1]), &q[1], &p[1], &mut velocity[1]);
            emitted::increment::<R, V>(&mut velocity[1], step.size, Self::B[1]);
        }
        #[inline]
        fn positions<V: emitted::Vector, A: emitted::StageSums>(
            step: &emitted::Step<'_, V>,
            stages: &mut Self::Stages<V>,
            sums: &mut A,
        ) {
            let emitted::Stages { q, velocity, .. } = stages;
            let (base, terms) = ((step.q, step.q_low), [&velocity[0], &velocity[1]]);
            let weights = emitted::weights::<V::Scalar, _>(step.size, Self::B);
            sums.increments(&mut q[0], base, Self::Q_0, weights, terms);
            sums.increments(&mut q[1], base, Self::Q_1, weights, terms);
        }
        #[inline]
        fn increments<V: emitted::Vector>(
            step: &emitted::Step<'_, V>,
            stages: &mut Self::Stages<V>,
        ) {
            emitted::scale_all(&mut stages.force, [0, 1], step.size, Self::B_TILDE);
            emitted::scale_all(&mut stages.velocity, [0, 1], step.size, Self::B);
        }
        #[inline]
        fn finish<
            R: emitted::Summation,
            V: emitted::Vector,
            S: emitted::System<V, Class = Self::Class>,
        >(
            step: &emitted::Step<'_, V>,
            system: &S,
            stages: &mut Self::Stages<V>,
            kept: emitted::WarmStart,
            outcome: emitted::Outcome<'_, V>,
        ) {
            let emitted::Outcome { q: q1, q_low: q1_low, p: p1, p_low: p1_low } = outcome;
            let emitted::Stages { q, p, velocity, force } = &mut *stages;
            let increments = [&velocity[0], &velocity[1]];
            emitted::total::<R, V, _>(q1, q1_low, step.q, step.q_low, increments);
            let increments = [&force[0], &force[1]];
            emitted::total::<R, V, _>(p1, p1_low, step.p, step.p_low, increments);
        }
    }
    impl<K: emitted::Class> emitted::StageTableau for Gauss2Plan<K> {
        type Lanes = emitted::F64x2;
        type Groups<T: ::core::fmt::Debug> = [T; 1];
        const INCREMENTS: bool = true;
        const POSITIONS: emitted::HalfTableau = emitted::HalfTableau {
            count: 2,
            columns: &[&[0.5, 1.0773502691896257], &[(-0.07735026918962573), 0.5]],
            times: &[0.2113248654051871, 0.7886751345948129],
            weights: &[0.5, 0.5],
            extrapolation: &[
                &[(-0.7320508075688773), (-1.7320508075688772)],
                &[1.7320508075688772, 2.732050807568877],
            ],
            polynomial: ::core::option::Option::Some(emitted::StagePolynomial {
                legendre: &[&[(-1.7320508075688772), 1.7320508075688772]],
                order: 3,
            }),
        };
        const MOMENTA: emitted::HalfTableau = Self::POSITIONS;
        const SECOND_ORDER: ::core::option::Option<emitted::SecondOrderTableau> = ::core::option::Option::Some(emitted::SecondOrderTableau {
            nodes: &[0.21132486540518713, 0.7886751345948129],
            columns: &[
                &[0.08333333333333326, 0.5386751345948129],
                &[(-0.038675134594812866), 0.08333333333333326],
            ],
            of_forces: &[
                &[0.04166666666666663, 0.26933756729740643],
                &[(-0.019337567297406433), 0.04166666666666663],
            ],
        });
        const DECOUPLING: ::core::option::Option<emitted::Decoupling> = if K::SEPARABLE {
            ::core::option::Option::Some(emitted::Decoupling {
                blocks: &[(0.041666666666666664, 0.07216878364870322)],
                to_stages: &[&[0.0, (-0.2679491924311227)], &[1.0, 0.0]],
                from_stages: &[&[0.0, 1.0], &[(-3.732050807568877), 0.0]],
            })
        } else {
            ::core::option::Option::Some(emitted::Decoupling {
                blocks: &[(0.25, 0.14433756729740643)],
                to_stages: &[&[0.0, (-0.2679491924311227)], &[1.0, 0.0]],
                from_stages: &[&[0.0, 1.0], &[(-3.732050807568877), 0.0]],
            })
        };
        #[inline(always)]
        fn groups<T: ::core::fmt::Debug>(
            mut make: impl ::core::ops::FnMut(usize) -> T,
        ) -> [T; 1] {
            [make(0)]
        }
        #[inline(always)]
        fn stored<V: emitted::Vector>(
            stages: &Self::Stages<V>,
        ) -> [emitted::StoredEvaluations<'_, V>; 2] {
            stages.stored(&[], &[])
        }
    }
};
