/// Documentation of the user.
/**

```text
2 stages, basis polynomial(2), nodes lobatto(2)

c │ a              c̃ │ ã
──┼─────────     ────┼─────────
0 │   0    0     1/2 │ 1/2    0
1 │ 1/2  1/2     1/2 │ 1/2    0
──┼─────────     ────┼─────────
b │ 1/2  1/2       b̃ │ 1/2  1/2

properties
  symplectic          yes  proved
  symmetric           yes  proved
  consistent          yes  proved
  equal_matrices      no   refuted  a_11 − ã_11 = -1/2
  explicit            yes  proved   Q1, P1 = P2, Q2
  first_row_zero      yes  proved
  stiffly_accurate    yes  proved
  first_same_as_last  yes  proved   Q_s = q1 is Q_1 of the next step
  positive_weights    yes  proved
  constrained         yes  proved   det (A Ã) ≈ 0.500000
  nonholonomic        yes  proved   order 2: Σ b c² = 1/2 ≠ 1/3
```*/
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StoermerVerlet;
#[allow(clippy::approx_constant)]
impl StoermerVerlet {
    /// a_ij: the position stages from the velocities. Correctly rounded.
    pub const A: [[f64; 2]; 2] = [[0.0, 0.0], [0.5, 0.5]];
    /// ã_ij: the momentum stages from the forces. Correctly rounded.
    pub const A_TILDE: [[f64; 2]; 2] = [[0.5, 0.0], [0.5, 0.0]];
    /// b_j: the weights of the velocities. Correctly rounded.
    pub const B: [f64; 2] = [0.5, 0.5];
    /// b̃_j: the weights of the forces. Correctly rounded.
    pub const B_TILDE: [f64; 2] = Self::B;
    /// c_i = Σ_j a_ij. Correctly rounded.
    pub const C: [f64; 2] = [0.0, 1.0];
    /// c̃_i = Σ_j ã_ij. Correctly rounded.
    pub const C_TILDE: [f64; 2] = [0.5, 0.5];
}
#[allow(clippy::approx_constant)]
const _: () = {
    impl ::symplectic::emitted::Method for StoermerVerlet {
        const NAME: &'static str = "StoermerVerlet";
        const STAGES: usize = 2;
        const DEFINITION: &'static str = "basis: polynomial(2), nodes: lobatto(2)";
        const COEFFICIENTS: ::symplectic::emitted::Coefficients = {
            const A: &[&[::symplectic::emitted::Coefficient]] = &[
                &[
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::emitted::Coefficient::exact(0.5),
                    ::symplectic::emitted::Coefficient::exact(0.5),
                ],
            ];
            const B: &[::symplectic::emitted::Coefficient] = &[
                ::symplectic::emitted::Coefficient::exact(0.5),
                ::symplectic::emitted::Coefficient::exact(0.5),
            ];
            const C: &[::symplectic::emitted::Coefficient] = &[
                ::symplectic::emitted::Coefficient::exact(0.0),
                ::symplectic::emitted::Coefficient::exact(1.0),
            ];
            const A_TILDE: &[&[::symplectic::emitted::Coefficient]] = &[
                &[
                    ::symplectic::emitted::Coefficient::exact(0.5),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::emitted::Coefficient::exact(0.5),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                ],
            ];
            const C_TILDE: &[::symplectic::emitted::Coefficient] = &[
                ::symplectic::emitted::Coefficient::exact(0.5),
                ::symplectic::emitted::Coefficient::exact(0.5),
            ];
            ::symplectic::emitted::Coefficients {
                a: A,
                a_tilde: A_TILDE,
                b: B,
                b_tilde: B,
                c: C,
                c_tilde: C_TILDE,
            }
        };
        const ORDERS: ::symplectic::emitted::Orders = ::symplectic::emitted::Orders {
            general: 2,
            separable: 2,
            nystrom: 2,
        };
        const SYMMETRY: ::symplectic::emitted::Symmetry = ::symplectic::emitted::Symmetry {
            general: true,
            separable: true,
        };
        const CONSTRAINED: &'static [::symplectic::emitted::ConstrainedStep] = {
            const TABLEAU1: ::symplectic::emitted::ConstrainedTableau = ::symplectic::emitted::ConstrainedTableau {
                positions: &[
                    &[
                        ::symplectic::emitted::Coefficient::exact(0.0),
                        ::symplectic::emitted::Coefficient::exact(0.0),
                    ],
                    &[
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(1.0),
                    ],
                ],
                momenta: &[
                    &[
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(0.0),
                    ],
                    &[
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(0.0),
                    ],
                ],
                weights: &[
                    ::symplectic::emitted::Coefficient::exact(0.5),
                    ::symplectic::emitted::Coefficient::exact(0.5),
                ],
                nodes: &[
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(1.0),
                ],
                momentum_nodes: &[
                    ::symplectic::emitted::Coefficient::exact(0.5),
                    ::symplectic::emitted::Coefficient::exact(0.5),
                ],
                multipliers: &[&[2.0]],
            };
            &[
                ::symplectic::emitted::ConstrainedStep::new(
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(1.0),
                    &TABLEAU1,
                ),
            ]
        };
        const NONHOLONOMIC: &'static [::symplectic::emitted::ConstrainedStep] = {
            const TABLEAU1: ::symplectic::emitted::ConstrainedTableau = ::symplectic::emitted::ConstrainedTableau {
                positions: &[
                    &[
                        ::symplectic::emitted::Coefficient::exact(0.0),
                        ::symplectic::emitted::Coefficient::exact(0.0),
                    ],
                    &[
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(1.0),
                    ],
                ],
                momenta: &[
                    &[
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(0.0),
                    ],
                    &[
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(0.0),
                    ],
                ],
                weights: &[
                    ::symplectic::emitted::Coefficient::exact(0.5),
                    ::symplectic::emitted::Coefficient::exact(0.5),
                ],
                nodes: &[
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(1.0),
                ],
                momentum_nodes: &[
                    ::symplectic::emitted::Coefficient::exact(0.5),
                    ::symplectic::emitted::Coefficient::exact(0.5),
                ],
                multipliers: &[],
            };
            &[
                ::symplectic::emitted::ConstrainedStep::new(
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(1.0),
                    &TABLEAU1,
                ),
            ]
        };
        type General = ::symplectic::emitted::Coupled<StoermerVerletGeneral>;
        type Separable = ::symplectic::emitted::Splitting<StoermerVerletSeparable>;
    }
    impl<C> ::symplectic::emitted::ProvedFor<C> for StoermerVerlet {}
    pub struct StoermerVerletGeneral;
    #[allow(unused_variables)]
    impl ::symplectic::emitted::StagePlan for StoermerVerletGeneral {
        type Class = ::symplectic::emitted::General;
        type Stages<V: ::symplectic::emitted::Vector> = ::symplectic::emitted::Stages<
            V,
            2,
            2,
        >;
        const EVALUATIONS: ::symplectic::emitted::EvaluationCounts = ::symplectic::emitted::EvaluationCounts {
            begin: 0,
            start: 1,
            sweep: 3,
            finish: 1,
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
            ::symplectic::emitted::copy(&mut p[0], step.p);
            system
                .velocity(
                    step.at(::symplectic::emitted::Coefficient::exact(0.5)),
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
                &mut q[1],
                step.q,
                step.q_low,
                ::symplectic::emitted::factors([
                    ::symplectic::emitted::Coefficient::exact(1.0),
                    ::symplectic::emitted::Coefficient::exact(1.0),
                ]),
                [&velocity[0], &velocity[1]],
            );
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
                    step.at(::symplectic::emitted::Coefficient::exact(0.0)),
                    step.q,
                    &p[0],
                    &mut force[0],
                );
            ::symplectic::emitted::increment::<
                R,
                V,
            >(&mut force[0], step.size, ::symplectic::emitted::Coefficient::exact(0.5));
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
                >([::symplectic::emitted::Coefficient::exact(1.0)], [force_weights[0]]),
                [&force[0]],
                &mut change.p,
            );
            system
                .velocity(
                    step.at(::symplectic::emitted::Coefficient::exact(0.5)),
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
                    step.at(::symplectic::emitted::Coefficient::exact(0.5)),
                    &q[1],
                    &p[0],
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
                &mut q[1],
                step.q,
                step.q_low,
                ::symplectic::emitted::relative::<
                    R,
                    _,
                    _,
                >(
                    [
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(1.0),
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
            system
                .force(
                    step.at(::symplectic::emitted::Coefficient::exact(1.0)),
                    &q[1],
                    &p[0],
                    &mut force[1],
                );
            ::symplectic::emitted::scale(
                &mut force[1],
                step.size,
                ::symplectic::emitted::Coefficient::exact(0.5),
            );
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
    impl ::symplectic::emitted::StageTableau for StoermerVerletGeneral {
        type Lanes = ::symplectic::emitted::F64x2;
        type Groups<T: ::core::fmt::Debug> = [T; 1];
        const INCREMENTS: bool = true;
        const POSITIONS: ::symplectic::emitted::HalfTableau = ::symplectic::emitted::HalfTableau {
            count: 2,
            columns: &[&[0.0, 1.0], &[0.0, 1.0]],
            times: &[0.0, 1.0],
            weights: &[0.5, 0.5],
            extrapolation: &[&[0.0, (-1.0)], &[1.0, 2.0]],
            polynomial: ::core::option::Option::Some(::symplectic::emitted::StagePolynomial {
                legendre: &[&[(-1.0), 1.0]],
                order: 2,
            }),
        };
        const MOMENTA: ::symplectic::emitted::HalfTableau = ::symplectic::emitted::HalfTableau {
            count: 2,
            columns: &[&[1.0, 1.0], &[0.0, 0.0]],
            times: &[0.5, 0.5],
            weights: &[0.5, 0.5],
            extrapolation: &[],
            polynomial: ::core::option::Option::Some(::symplectic::emitted::StagePolynomial {
                legendre: &[&[(-1.0), 1.0]],
                order: 2,
            }),
        };
        const SECOND_ORDER: ::core::option::Option<
            ::symplectic::emitted::SecondOrderTableau,
        > = ::core::option::Option::None;
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
    pub struct StoermerVerletSeparable;
    #[allow(unused_variables)]
    impl ::symplectic::emitted::SplittingPlan for StoermerVerletSeparable {
        type Class = ::symplectic::emitted::Separable;
        const EVALUATIONS: u32 = 3;
        const CARRIED: u32 = 1;
        #[inline(always)]
        fn apply<
            R: ::symplectic::emitted::Summation,
            V: ::symplectic::emitted::Vector,
            S: ::symplectic::emitted::System<V, Class = Self::Class>,
            K: ::symplectic::emitted::KickDrift,
            W: ::symplectic::emitted::EvaluationObserver,
        >(
            span: ::symplectic::emitted::Span,
            system: &S,
            evaluations: &mut ::symplectic::emitted::Evaluations<V>,
            kept: ::symplectic::emitted::WarmStart,
            state: ::symplectic::emitted::Outcome<'_, V>,
            kick_drift: &mut K,
            witness: &mut W,
        ) {
            let ::symplectic::emitted::Evaluations { velocity, force } = evaluations;
            let ::symplectic::emitted::Outcome { q, q_low, p, p_low } = state;
            if !kept.evaluation {
                kick_drift
                    .force::<
                        R,
                        V,
                        S,
                        W,
                    >(
                        ::symplectic::emitted::Force {
                            span,
                            stage: 1,
                            time: ::symplectic::emitted::Coefficient::exact(0.0),
                        },
                        system,
                        &mut *force,
                        &mut *q,
                        (&mut *p, &mut *p_low),
                        witness,
                    );
            }
            kick_drift
                .kick::<
                    R,
                    V,
                    S,
                >(
                    span.size,
                    ::symplectic::emitted::Coefficient::exact(0.5),
                    system,
                    &mut *force,
                    &mut *q,
                    (&mut *p, &mut *p_low),
                );
            kick_drift
                .drift::<
                    R,
                    V,
                    S,
                    W,
                >(
                    ::symplectic::emitted::Drift {
                        span,
                        stage: 1,
                        time: ::symplectic::emitted::Coefficient::exact(0.5),
                        weight: ::symplectic::emitted::Coefficient::exact(1.0),
                        known: false,
                    },
                    system,
                    (&mut *velocity, &mut *force),
                    (&mut *q, &mut *q_low),
                    (&mut *p, &mut *p_low),
                    witness,
                );
            kick_drift
                .force::<
                    R,
                    V,
                    S,
                    W,
                >(
                    ::symplectic::emitted::Force {
                        span,
                        stage: 2,
                        time: ::symplectic::emitted::Coefficient::exact(1.0),
                    },
                    system,
                    &mut *force,
                    &mut *q,
                    (&mut *p, &mut *p_low),
                    witness,
                );
            kick_drift
                .kick::<
                    R,
                    V,
                    S,
                >(
                    span.size,
                    ::symplectic::emitted::Coefficient::exact(0.5),
                    system,
                    &mut *force,
                    &mut *q,
                    (&mut *p, &mut *p_low),
                );
        }
    }
};
