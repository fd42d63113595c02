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
    impl ::symplectic::emitted::Method for Gauss2 {
        const NAME: &'static str = "Gauss2";
        const STAGES: usize = 2;
        const DEFINITION: &'static str = "basis: polynomial(2), nodes: gauss(2)";
        const COEFFICIENTS: ::symplectic::emitted::Coefficients = {
            const A: &[&[::symplectic::emitted::Coefficient]] = &[
                &[
                    ::symplectic::emitted::Coefficient::exact(0.25),
                    ::symplectic::emitted::Coefficient::new(
                        (-0.03867513459481288),
                        (-2.8473525618637145e-18),
                        (-0.038675133),
                    ),
                ],
                &[
                    ::symplectic::emitted::Coefficient::new(
                        0.5386751345948129,
                        1.6725140369678172e-17,
                        0.5386751,
                    ),
                    ::symplectic::emitted::Coefficient::exact(0.25),
                ],
            ];
            const B: &[::symplectic::emitted::Coefficient] = &[
                ::symplectic::emitted::Coefficient::exact(0.5),
                ::symplectic::emitted::Coefficient::exact(0.5),
            ];
            const C: &[::symplectic::emitted::Coefficient] = &[
                ::symplectic::emitted::Coefficient::new(
                    0.2113248654051871,
                    1.1030435245950743e-17,
                    0.21132487,
                ),
                ::symplectic::emitted::Coefficient::new(
                    0.7886751345948129,
                    1.6725140369678172e-17,
                    0.7886751,
                ),
            ];
            ::symplectic::emitted::Coefficients {
                a: A,
                a_tilde: A,
                b: B,
                b_tilde: B,
                c: C,
                c_tilde: C,
            }
        };
        const ORDERS: ::symplectic::emitted::Orders = ::symplectic::emitted::Orders {
            general: 4,
            separable: 4,
            nystrom: 4,
        };
        const SYMMETRY: ::symplectic::emitted::Symmetry = ::symplectic::emitted::Symmetry {
            general: true,
            separable: true,
        };
        type General = ::symplectic::emitted::Coupled<Gauss2General>;
        type Separable = ::symplectic::emitted::Coupled<Gauss2Separable>;
    }
    impl<C: ::symplectic::emitted::Unconstrained> ::symplectic::emitted::ProvedFor<C>
    for Gauss2 {}
    pub struct Gauss2General;
    #[allow(unused_variables)]
    impl ::symplectic::emitted::StagePlan for Gauss2General {
        type Class = ::symplectic::emitted::General;
        type Stages<V: ::symplectic::emitted::Vector> = ::symplectic::emitted::Stages<
            V,
            2,
            2,
        >;
        const EVALUATIONS: ::symplectic::emitted::EvaluationCounts = ::symplectic::emitted::EvaluationCounts {
            begin: 0,
            start: 1,
            sweep: 4,
            finish: 0,
            carried: 0,
        };
        #[inline]
        fn begin<
            R: ::symplectic::emitted::Summation,
            V: ::symplectic::emitted::Vector,
            S: ::symplectic::emitted::System<V, Class = Self::Class>,
        >(
            step: &::symplectic::emitted::Step<'_, V>,
            system: &S,
            stages: &mut Self::Stages<V>,
            kept: ::symplectic::emitted::WarmStart,
        ) {
            let ::symplectic::emitted::Stages { q, p, velocity, force } = stages;
            if kept.stages {
                ::symplectic::emitted::transform(
                    velocity,
                    [0, 1],
                    [
                        [(-0.7320508075688773), 1.7320508075688772],
                        [(-1.7320508075688772), 2.732050807568877],
                    ],
                );
                ::symplectic::emitted::combine::<
                    R,
                    V,
                    _,
                >(
                    &mut q[0],
                    step.q,
                    step.q_low,
                    ::symplectic::emitted::factors([
                        ::symplectic::emitted::Coefficient::exact(0.5),
                        ::symplectic::emitted::Coefficient::new(
                            (-0.07735026918962573),
                            (-3.3450280739356345e-17),
                            (-0.07735026),
                        ),
                    ]),
                    [&velocity[0], &velocity[1]],
                );
                ::symplectic::emitted::combine::<
                    R,
                    V,
                    _,
                >(
                    &mut q[1],
                    step.q,
                    step.q_low,
                    ::symplectic::emitted::factors([
                        ::symplectic::emitted::Coefficient::new(
                            1.0773502691896257,
                            3.3450280739356345e-17,
                            1.0773503,
                        ),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                    ]),
                    [&velocity[0], &velocity[1]],
                );
                ::symplectic::emitted::transform(
                    force,
                    [0, 1],
                    [
                        [(-0.7320508075688773), 1.7320508075688772],
                        [(-1.7320508075688772), 2.732050807568877],
                    ],
                );
                ::symplectic::emitted::combine::<
                    R,
                    V,
                    _,
                >(
                    &mut p[0],
                    step.p,
                    step.p_low,
                    ::symplectic::emitted::factors([
                        ::symplectic::emitted::Coefficient::exact(0.5),
                        ::symplectic::emitted::Coefficient::new(
                            (-0.07735026918962573),
                            (-3.3450280739356345e-17),
                            (-0.07735026),
                        ),
                    ]),
                    [&force[0], &force[1]],
                );
                ::symplectic::emitted::combine::<
                    R,
                    V,
                    _,
                >(
                    &mut p[1],
                    step.p,
                    step.p_low,
                    ::symplectic::emitted::factors([
                        ::symplectic::emitted::Coefficient::new(
                            1.0773502691896257,
                            3.3450280739356345e-17,
                            1.0773503,
                        ),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                    ]),
                    [&force[0], &force[1]],
                );
            } else {
                ::symplectic::emitted::copy(&mut p[0], step.p);
                ::symplectic::emitted::copy(&mut p[1], step.p);
                system
                    .velocity(
                        step
                            .at(
                                ::symplectic::emitted::Coefficient::new(
                                    0.2113248654051871,
                                    1.1030435245950743e-17,
                                    0.21132487,
                                ),
                            ),
                        step.q,
                        step.p,
                        &mut velocity[0],
                    );
                ::symplectic::emitted::copy_to(velocity, 0, [1]);
                ::symplectic::emitted::scale(
                    &mut velocity[0],
                    step.size,
                    ::symplectic::emitted::Coefficient::exact(0.5),
                );
                ::symplectic::emitted::scale(
                    &mut velocity[1],
                    step.size,
                    ::symplectic::emitted::Coefficient::exact(0.5),
                );
                ::symplectic::emitted::combine::<
                    R,
                    V,
                    _,
                >(
                    &mut q[0],
                    step.q,
                    step.q_low,
                    ::symplectic::emitted::factors([
                        ::symplectic::emitted::Coefficient::exact(0.5),
                        ::symplectic::emitted::Coefficient::new(
                            (-0.07735026918962573),
                            (-3.3450280739356345e-17),
                            (-0.07735026),
                        ),
                    ]),
                    [&velocity[0], &velocity[1]],
                );
                ::symplectic::emitted::combine::<
                    R,
                    V,
                    _,
                >(
                    &mut q[1],
                    step.q,
                    step.q_low,
                    ::symplectic::emitted::factors([
                        ::symplectic::emitted::Coefficient::new(
                            1.0773502691896257,
                            3.3450280739356345e-17,
                            1.0773503,
                        ),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                    ]),
                    [&velocity[0], &velocity[1]],
                );
            }
        }
        #[inline]
        fn sweep<
            R: ::symplectic::emitted::Summation,
            V: ::symplectic::emitted::Vector,
            S: ::symplectic::emitted::System<V, Class = Self::Class>,
        >(
            step: &::symplectic::emitted::Step<'_, V>,
            system: &S,
            stages: &mut Self::Stages<V>,
        ) -> ::symplectic::emitted::StageChange {
            let ::symplectic::emitted::Stages { q, p, velocity, force } = stages;
            let mut change = ::symplectic::emitted::StageChange::default();
            let force_weights = ::symplectic::emitted::weights::<
                V::Scalar,
                _,
            >(
                step.size,
                [
                    ::symplectic::emitted::Coefficient::exact(0.5),
                    ::symplectic::emitted::Coefficient::exact(0.5),
                ],
            );
            let velocity_weights = ::symplectic::emitted::weights::<
                V::Scalar,
                _,
            >(
                step.size,
                [
                    ::symplectic::emitted::Coefficient::exact(0.5),
                    ::symplectic::emitted::Coefficient::exact(0.5),
                ],
            );
            system
                .force(
                    step
                        .at(
                            ::symplectic::emitted::Coefficient::new(
                                0.2113248654051871,
                                1.1030435245950743e-17,
                                0.21132487,
                            ),
                        ),
                    &q[0],
                    &p[0],
                    &mut force[0],
                );
            ::symplectic::emitted::increment::<
                R,
                V,
            >(&mut force[0], step.size, ::symplectic::emitted::Coefficient::exact(0.5));
            system
                .force(
                    step
                        .at(
                            ::symplectic::emitted::Coefficient::new(
                                0.7886751345948129,
                                1.6725140369678172e-17,
                                0.7886751,
                            ),
                        ),
                    &q[1],
                    &p[1],
                    &mut force[1],
                );
            ::symplectic::emitted::increment::<
                R,
                V,
            >(&mut force[1], step.size, ::symplectic::emitted::Coefficient::exact(0.5));
            ::symplectic::emitted::relax::<
                R,
                V,
                _,
            >(
                &mut p[0],
                step.p,
                step.p_low,
                ::symplectic::emitted::relative::<
                    R,
                    _,
                    _,
                >(
                    [
                        ::symplectic::emitted::Coefficient::exact(0.5),
                        ::symplectic::emitted::Coefficient::new(
                            (-0.07735026918962573),
                            (-3.3450280739356345e-17),
                            (-0.07735026),
                        ),
                    ],
                    [force_weights[0], force_weights[1]],
                ),
                [&force[0], &force[1]],
                &mut change.p,
            );
            ::symplectic::emitted::relax::<
                R,
                V,
                _,
            >(
                &mut p[1],
                step.p,
                step.p_low,
                ::symplectic::emitted::relative::<
                    R,
                    _,
                    _,
                >(
                    [
                        ::symplectic::emitted::Coefficient::new(
                            1.0773502691896257,
                            3.3450280739356345e-17,
                            1.0773503,
                        ),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                    ],
                    [force_weights[0], force_weights[1]],
                ),
                [&force[0], &force[1]],
                &mut change.p,
            );
            system
                .velocity(
                    step
                        .at(
                            ::symplectic::emitted::Coefficient::new(
                                0.2113248654051871,
                                1.1030435245950743e-17,
                                0.21132487,
                            ),
                        ),
                    &q[0],
                    &p[0],
                    &mut velocity[0],
                );
            ::symplectic::emitted::increment::<
                R,
                V,
            >(
                &mut velocity[0],
                step.size,
                ::symplectic::emitted::Coefficient::exact(0.5),
            );
            system
                .velocity(
                    step
                        .at(
                            ::symplectic::emitted::Coefficient::new(
                                0.7886751345948129,
                                1.6725140369678172e-17,
                                0.7886751,
                            ),
                        ),
                    &q[1],
                    &p[1],
                    &mut velocity[1],
                );
            ::symplectic::emitted::increment::<
                R,
                V,
            >(
                &mut velocity[1],
                step.size,
                ::symplectic::emitted::Coefficient::exact(0.5),
            );
            ::symplectic::emitted::relax::<
                R,
                V,
                _,
            >(
                &mut q[0],
                step.q,
                step.q_low,
                ::symplectic::emitted::relative::<
                    R,
                    _,
                    _,
                >(
                    [
                        ::symplectic::emitted::Coefficient::exact(0.5),
                        ::symplectic::emitted::Coefficient::new(
                            (-0.07735026918962573),
                            (-3.3450280739356345e-17),
                            (-0.07735026),
                        ),
                    ],
                    [velocity_weights[0], velocity_weights[1]],
                ),
                [&velocity[0], &velocity[1]],
                &mut change.q,
            );
            ::symplectic::emitted::relax::<
                R,
                V,
                _,
            >(
                &mut q[1],
                step.q,
                step.q_low,
                ::symplectic::emitted::relative::<
                    R,
                    _,
                    _,
                >(
                    [
                        ::symplectic::emitted::Coefficient::new(
                            1.0773502691896257,
                            3.3450280739356345e-17,
                            1.0773503,
                        ),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                    ],
                    [velocity_weights[0], velocity_weights[1]],
                ),
                [&velocity[0], &velocity[1]],
                &mut change.q,
            );
            change
        }
        #[inline]
        fn increments<V: ::symplectic::emitted::Vector>(
            step: &::symplectic::emitted::Step<'_, V>,
            stages: &mut Self::Stages<V>,
        ) {
            let ::symplectic::emitted::Stages { q, p, velocity, force } = stages;
            ::symplectic::emitted::scale(
                &mut force[0],
                step.size,
                ::symplectic::emitted::Coefficient::exact(0.5),
            );
            ::symplectic::emitted::scale(
                &mut force[1],
                step.size,
                ::symplectic::emitted::Coefficient::exact(0.5),
            );
            ::symplectic::emitted::scale(
                &mut velocity[0],
                step.size,
                ::symplectic::emitted::Coefficient::exact(0.5),
            );
            ::symplectic::emitted::scale(
                &mut velocity[1],
                step.size,
                ::symplectic::emitted::Coefficient::exact(0.5),
            );
        }
        #[inline]
        fn finish<
            R: ::symplectic::emitted::Summation,
            V: ::symplectic::emitted::Vector,
            S: ::symplectic::emitted::System<V, Class = Self::Class>,
            W: ::symplectic::emitted::EvaluationObserver,
        >(
            step: &::symplectic::emitted::Step<'_, V>,
            system: &S,
            stages: &mut Self::Stages<V>,
            kept: ::symplectic::emitted::WarmStart,
            outcome: ::symplectic::emitted::Outcome<'_, V>,
            witness: &mut W,
        ) {
            let ::symplectic::emitted::Outcome {
                q: q1,
                q_low: q1_low,
                p: p1,
                p_low: p1_low,
            } = outcome;
            let ::symplectic::emitted::Stages { q, p, velocity, force } = stages;
            ::symplectic::emitted::total::<
                R,
                V,
                _,
            >(q1, q1_low, step.q, step.q_low, [&velocity[0], &velocity[1]]);
            ::symplectic::emitted::total::<
                R,
                V,
                _,
            >(p1, p1_low, step.p, step.p_low, [&force[0], &force[1]]);
        }
    }
    impl ::symplectic::emitted::StageTableau for Gauss2General {
        type Lanes = ::symplectic::emitted::F64x2;
        type Groups<T: ::core::fmt::Debug> = [T; 1];
        const INCREMENTS: bool = true;
        const POSITIONS: ::symplectic::emitted::HalfTableau = ::symplectic::emitted::HalfTableau {
            count: 2,
            columns: &[&[0.5, 1.0773502691896257], &[(-0.07735026918962573), 0.5]],
            times: &[0.2113248654051871, 0.7886751345948129],
            weights: &[0.5, 0.5],
            extrapolation: &[
                &[(-0.7320508075688773), (-1.7320508075688772)],
                &[1.7320508075688772, 2.732050807568877],
            ],
            polynomial: ::core::option::Option::Some(::symplectic::emitted::StagePolynomial {
                legendre: &[&[(-1.7320508075688772), 1.7320508075688772]],
                order: 3,
            }),
        };
        const MOMENTA: ::symplectic::emitted::HalfTableau = <Gauss2General as ::symplectic::emitted::StageTableau>::POSITIONS;
        const SECOND_ORDER: ::core::option::Option<
            ::symplectic::emitted::SecondOrderTableau,
        > = ::core::option::Option::None;
        const DECOUPLING: ::core::option::Option<::symplectic::emitted::Decoupling> = ::core::option::Option::Some(::symplectic::emitted::Decoupling {
            blocks: &[(0.25, 0.14433756729740643)],
            to_stages: &[&[0.0, (-0.2679491924311227)], &[1.0, 0.0]],
            from_stages: &[&[0.0, 1.0], &[(-3.732050807568877), 0.0]],
        });
        #[inline(always)]
        fn groups<T: ::core::fmt::Debug>(
            mut make: impl ::core::ops::FnMut(usize) -> T,
        ) -> [T; 1] {
            [make(0)]
        }
        #[inline(always)]
        fn stored<V: ::symplectic::emitted::Vector>(
            stages: &Self::Stages<V>,
        ) -> [::symplectic::emitted::StoredEvaluations<'_, V>; 2] {
            [
                ::symplectic::emitted::StoredEvaluations {
                    values: &stages.velocity,
                    carried: &[],
                },
                ::symplectic::emitted::StoredEvaluations {
                    values: &stages.force,
                    carried: &[],
                },
            ]
        }
    }
    pub struct Gauss2Separable;
    #[allow(unused_variables)]
    impl ::symplectic::emitted::StagePlan for Gauss2Separable {
        type Class = ::symplectic::emitted::Separable;
        type Stages<V: ::symplectic::emitted::Vector> = ::symplectic::emitted::Stages<
            V,
            2,
            2,
        >;
        const EVALUATIONS: ::symplectic::emitted::EvaluationCounts = ::symplectic::emitted::EvaluationCounts {
            begin: 0,
            start: 1,
            sweep: 4,
            finish: 0,
            carried: 0,
        };
        #[inline]
        fn begin<
            R: ::symplectic::emitted::Summation,
            V: ::symplectic::emitted::Vector,
            S: ::symplectic::emitted::System<V, Class = Self::Class>,
        >(
            step: &::symplectic::emitted::Step<'_, V>,
            system: &S,
            stages: &mut Self::Stages<V>,
            kept: ::symplectic::emitted::WarmStart,
        ) {
            let ::symplectic::emitted::Stages { q, p, velocity, force } = stages;
            if kept.stages {
                ::symplectic::emitted::transform(
                    velocity,
                    [0, 1],
                    [
                        [(-0.7320508075688773), 1.7320508075688772],
                        [(-1.7320508075688772), 2.732050807568877],
                    ],
                );
                ::symplectic::emitted::combine::<
                    R,
                    V,
                    _,
                >(
                    &mut q[0],
                    step.q,
                    step.q_low,
                    ::symplectic::emitted::factors([
                        ::symplectic::emitted::Coefficient::exact(0.5),
                        ::symplectic::emitted::Coefficient::new(
                            (-0.07735026918962573),
                            (-3.3450280739356345e-17),
                            (-0.07735026),
                        ),
                    ]),
                    [&velocity[0], &velocity[1]],
                );
                ::symplectic::emitted::combine::<
                    R,
                    V,
                    _,
                >(
                    &mut q[1],
                    step.q,
                    step.q_low,
                    ::symplectic::emitted::factors([
                        ::symplectic::emitted::Coefficient::new(
                            1.0773502691896257,
                            3.3450280739356345e-17,
                            1.0773503,
                        ),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                    ]),
                    [&velocity[0], &velocity[1]],
                );
            } else {
                ::symplectic::emitted::copy(&mut p[0], step.p);
                ::symplectic::emitted::copy(&mut p[1], step.p);
                system
                    .velocity(
                        step
                            .at(
                                ::symplectic::emitted::Coefficient::new(
                                    0.2113248654051871,
                                    1.1030435245950743e-17,
                                    0.21132487,
                                ),
                            ),
                        step.q,
                        step.p,
                        &mut velocity[0],
                    );
                ::symplectic::emitted::copy_to(velocity, 0, [1]);
                ::symplectic::emitted::scale(
                    &mut velocity[0],
                    step.size,
                    ::symplectic::emitted::Coefficient::exact(0.5),
                );
                ::symplectic::emitted::scale(
                    &mut velocity[1],
                    step.size,
                    ::symplectic::emitted::Coefficient::exact(0.5),
                );
                ::symplectic::emitted::combine::<
                    R,
                    V,
                    _,
                >(
                    &mut q[0],
                    step.q,
                    step.q_low,
                    ::symplectic::emitted::factors([
                        ::symplectic::emitted::Coefficient::exact(0.5),
                        ::symplectic::emitted::Coefficient::new(
                            (-0.07735026918962573),
                            (-3.3450280739356345e-17),
                            (-0.07735026),
                        ),
                    ]),
                    [&velocity[0], &velocity[1]],
                );
                ::symplectic::emitted::combine::<
                    R,
                    V,
                    _,
                >(
                    &mut q[1],
                    step.q,
                    step.q_low,
                    ::symplectic::emitted::factors([
                        ::symplectic::emitted::Coefficient::new(
                            1.0773502691896257,
                            3.3450280739356345e-17,
                            1.0773503,
                        ),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                    ]),
                    [&velocity[0], &velocity[1]],
                );
            }
        }
        #[inline]
        fn sweep<
            R: ::symplectic::emitted::Summation,
            V: ::symplectic::emitted::Vector,
            S: ::symplectic::emitted::System<V, Class = Self::Class>,
        >(
            step: &::symplectic::emitted::Step<'_, V>,
            system: &S,
            stages: &mut Self::Stages<V>,
        ) -> ::symplectic::emitted::StageChange {
            let ::symplectic::emitted::Stages { q, p, velocity, force } = stages;
            let mut change = ::symplectic::emitted::StageChange::default();
            let force_weights = ::symplectic::emitted::weights::<
                V::Scalar,
                _,
            >(
                step.size,
                [
                    ::symplectic::emitted::Coefficient::exact(0.5),
                    ::symplectic::emitted::Coefficient::exact(0.5),
                ],
            );
            let velocity_weights = ::symplectic::emitted::weights::<
                V::Scalar,
                _,
            >(
                step.size,
                [
                    ::symplectic::emitted::Coefficient::exact(0.5),
                    ::symplectic::emitted::Coefficient::exact(0.5),
                ],
            );
            system
                .force(
                    step
                        .at(
                            ::symplectic::emitted::Coefficient::new(
                                0.2113248654051871,
                                1.1030435245950743e-17,
                                0.21132487,
                            ),
                        ),
                    &q[0],
                    step.p,
                    &mut force[0],
                );
            ::symplectic::emitted::increment::<
                R,
                V,
            >(&mut force[0], step.size, ::symplectic::emitted::Coefficient::exact(0.5));
            system
                .force(
                    step
                        .at(
                            ::symplectic::emitted::Coefficient::new(
                                0.7886751345948129,
                                1.6725140369678172e-17,
                                0.7886751,
                            ),
                        ),
                    &q[1],
                    step.p,
                    &mut force[1],
                );
            ::symplectic::emitted::increment::<
                R,
                V,
            >(&mut force[1], step.size, ::symplectic::emitted::Coefficient::exact(0.5));
            ::symplectic::emitted::relax::<
                R,
                V,
                _,
            >(
                &mut p[0],
                step.p,
                step.p_low,
                ::symplectic::emitted::relative::<
                    R,
                    _,
                    _,
                >(
                    [
                        ::symplectic::emitted::Coefficient::exact(0.5),
                        ::symplectic::emitted::Coefficient::new(
                            (-0.07735026918962573),
                            (-3.3450280739356345e-17),
                            (-0.07735026),
                        ),
                    ],
                    [force_weights[0], force_weights[1]],
                ),
                [&force[0], &force[1]],
                &mut change.p,
            );
            ::symplectic::emitted::relax::<
                R,
                V,
                _,
            >(
                &mut p[1],
                step.p,
                step.p_low,
                ::symplectic::emitted::relative::<
                    R,
                    _,
                    _,
                >(
                    [
                        ::symplectic::emitted::Coefficient::new(
                            1.0773502691896257,
                            3.3450280739356345e-17,
                            1.0773503,
                        ),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                    ],
                    [force_weights[0], force_weights[1]],
                ),
                [&force[0], &force[1]],
                &mut change.p,
            );
            system
                .velocity(
                    step
                        .at(
                            ::symplectic::emitted::Coefficient::new(
                                0.2113248654051871,
                                1.1030435245950743e-17,
                                0.21132487,
                            ),
                        ),
                    step.q,
                    &p[0],
                    &mut velocity[0],
                );
            ::symplectic::emitted::increment::<
                R,
                V,
            >(
                &mut velocity[0],
                step.size,
                ::symplectic::emitted::Coefficient::exact(0.5),
            );
            system
                .velocity(
                    step
                        .at(
                            ::symplectic::emitted::Coefficient::new(
                                0.7886751345948129,
                                1.6725140369678172e-17,
                                0.7886751,
                            ),
                        ),
                    step.q,
                    &p[1],
                    &mut velocity[1],
                );
            ::symplectic::emitted::increment::<
                R,
                V,
            >(
                &mut velocity[1],
                step.size,
                ::symplectic::emitted::Coefficient::exact(0.5),
            );
            ::symplectic::emitted::relax::<
                R,
                V,
                _,
            >(
                &mut q[0],
                step.q,
                step.q_low,
                ::symplectic::emitted::relative::<
                    R,
                    _,
                    _,
                >(
                    [
                        ::symplectic::emitted::Coefficient::exact(0.5),
                        ::symplectic::emitted::Coefficient::new(
                            (-0.07735026918962573),
                            (-3.3450280739356345e-17),
                            (-0.07735026),
                        ),
                    ],
                    [velocity_weights[0], velocity_weights[1]],
                ),
                [&velocity[0], &velocity[1]],
                &mut change.q,
            );
            ::symplectic::emitted::relax::<
                R,
                V,
                _,
            >(
                &mut q[1],
                step.q,
                step.q_low,
                ::symplectic::emitted::relative::<
                    R,
                    _,
                    _,
                >(
                    [
                        ::symplectic::emitted::Coefficient::new(
                            1.0773502691896257,
                            3.3450280739356345e-17,
                            1.0773503,
                        ),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                    ],
                    [velocity_weights[0], velocity_weights[1]],
                ),
                [&velocity[0], &velocity[1]],
                &mut change.q,
            );
            change
        }
        #[inline]
        fn increments<V: ::symplectic::emitted::Vector>(
            step: &::symplectic::emitted::Step<'_, V>,
            stages: &mut Self::Stages<V>,
        ) {
            let ::symplectic::emitted::Stages { q, p, velocity, force } = stages;
            ::symplectic::emitted::scale(
                &mut force[0],
                step.size,
                ::symplectic::emitted::Coefficient::exact(0.5),
            );
            ::symplectic::emitted::scale(
                &mut force[1],
                step.size,
                ::symplectic::emitted::Coefficient::exact(0.5),
            );
            ::symplectic::emitted::scale(
                &mut velocity[0],
                step.size,
                ::symplectic::emitted::Coefficient::exact(0.5),
            );
            ::symplectic::emitted::scale(
                &mut velocity[1],
                step.size,
                ::symplectic::emitted::Coefficient::exact(0.5),
            );
        }
        #[inline]
        fn finish<
            R: ::symplectic::emitted::Summation,
            V: ::symplectic::emitted::Vector,
            S: ::symplectic::emitted::System<V, Class = Self::Class>,
            W: ::symplectic::emitted::EvaluationObserver,
        >(
            step: &::symplectic::emitted::Step<'_, V>,
            system: &S,
            stages: &mut Self::Stages<V>,
            kept: ::symplectic::emitted::WarmStart,
            outcome: ::symplectic::emitted::Outcome<'_, V>,
            witness: &mut W,
        ) {
            let ::symplectic::emitted::Outcome {
                q: q1,
                q_low: q1_low,
                p: p1,
                p_low: p1_low,
            } = outcome;
            let ::symplectic::emitted::Stages { q, p, velocity, force } = stages;
            ::symplectic::emitted::total::<
                R,
                V,
                _,
            >(q1, q1_low, step.q, step.q_low, [&velocity[0], &velocity[1]]);
            ::symplectic::emitted::total::<
                R,
                V,
                _,
            >(p1, p1_low, step.p, step.p_low, [&force[0], &force[1]]);
        }
    }
    impl ::symplectic::emitted::StageTableau for Gauss2Separable {
        type Lanes = ::symplectic::emitted::F64x2;
        type Groups<T: ::core::fmt::Debug> = [T; 1];
        const INCREMENTS: bool = true;
        const POSITIONS: ::symplectic::emitted::HalfTableau = <Gauss2General as ::symplectic::emitted::StageTableau>::POSITIONS;
        const MOMENTA: ::symplectic::emitted::HalfTableau = <Gauss2General as ::symplectic::emitted::StageTableau>::POSITIONS;
        const SECOND_ORDER: ::core::option::Option<
            ::symplectic::emitted::SecondOrderTableau,
        > = ::core::option::Option::Some(::symplectic::emitted::SecondOrderTableau {
            nodes: &[0.21132486540518713, 0.7886751345948129],
            columns: &[
                &[0.08333333333333326, 0.5386751345948129],
                &[(-0.038675134594812866), 0.08333333333333326],
            ],
            of_forces: &[
                &[0.04166666666666663, 0.26933756729740643],
                &[(-0.019337567297406433), 0.04166666666666663],
            ],
            rest: &[0.7886751345948129, 0.21132486540518713],
        });
        const DECOUPLING: ::core::option::Option<::symplectic::emitted::Decoupling> = ::core::option::Option::Some(::symplectic::emitted::Decoupling {
            blocks: &[(0.041666666666666664, 0.07216878364870322)],
            to_stages: &[&[0.0, (-0.2679491924311227)], &[1.0, 0.0]],
            from_stages: &[&[0.0, 1.0], &[(-3.732050807568877), 0.0]],
        });
        #[inline(always)]
        fn groups<T: ::core::fmt::Debug>(
            mut make: impl ::core::ops::FnMut(usize) -> T,
        ) -> [T; 1] {
            [make(0)]
        }
        #[inline(always)]
        fn stored<V: ::symplectic::emitted::Vector>(
            stages: &Self::Stages<V>,
        ) -> [::symplectic::emitted::StoredEvaluations<'_, V>; 2] {
            [
                ::symplectic::emitted::StoredEvaluations {
                    values: &stages.velocity,
                    carried: &[],
                },
                ::symplectic::emitted::StoredEvaluations {
                    values: &stages.force,
                    carried: &[],
                },
            ]
        }
    }
};
