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
    impl ::symplectic::Method for StoermerVerlet {
        const NAME: &'static str = "StoermerVerlet";
        const STAGES: usize = 2;
        const DEFINITION: &'static str = "basis: polynomial(2), nodes: lobatto(2)";
        const COEFFICIENTS: ::symplectic::Coefficients = {
            const A: &[&[::symplectic::Coefficient]] = &[
                &[
                    ::symplectic::Coefficient::exact(0.0),
                    ::symplectic::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::Coefficient::exact(0.5),
                    ::symplectic::Coefficient::exact(0.5),
                ],
            ];
            const B: &[::symplectic::Coefficient] = &[
                ::symplectic::Coefficient::exact(0.5),
                ::symplectic::Coefficient::exact(0.5),
            ];
            const C: &[::symplectic::Coefficient] = &[
                ::symplectic::Coefficient::exact(0.0),
                ::symplectic::Coefficient::exact(1.0),
            ];
            const A_TILDE: &[&[::symplectic::Coefficient]] = &[
                &[
                    ::symplectic::Coefficient::exact(0.5),
                    ::symplectic::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::Coefficient::exact(0.5),
                    ::symplectic::Coefficient::exact(0.0),
                ],
            ];
            const C_TILDE: &[::symplectic::Coefficient] = &[
                ::symplectic::Coefficient::exact(0.5),
                ::symplectic::Coefficient::exact(0.5),
            ];
            ::symplectic::Coefficients {
                a: A,
                a_tilde: A_TILDE,
                b: B,
                b_tilde: B,
                c: C,
                c_tilde: C_TILDE,
            }
        };
        const ORDERS: ::symplectic::Orders = ::symplectic::Orders {
            general: 2,
            separable: 2,
            nystrom: 2,
        };
        type General = ::symplectic::Coupled<StoermerVerletGeneral>;
        type Separable = ::symplectic::Splitting<StoermerVerletSeparable>;
    }
    impl<C> ::symplectic::ProvedFor<C> for StoermerVerlet {}
    pub struct StoermerVerletGeneral;
    #[allow(unused_variables)]
    impl ::symplectic::StagePlan for StoermerVerletGeneral {
        type Class = ::symplectic::General;
        type Stages<V: ::symplectic::Vector> = ::symplectic::Stages<V, 2, 2>;
        const EVALUATIONS: ::symplectic::EvaluationCounts = ::symplectic::EvaluationCounts {
            begin: 0,
            start: 1,
            sweep: 3,
            finish: 1,
            carried: 0,
        };
        #[inline]
        fn begin<
            R: ::symplectic::Summation,
            V: ::symplectic::Vector,
            S: ::symplectic::Hamiltonian<V, Class = Self::Class>,
        >(
            step: &::symplectic::Step<'_, V>,
            system: &S,
            stages: &mut Self::Stages<V>,
            kept: ::symplectic::Kept,
        ) {
            let ::symplectic::Stages { q, p, velocity, force } = stages;
            ::symplectic::copy(&mut p[0], step.p);
            system
                .velocity(
                    step.at(::symplectic::Coefficient::exact(0.5)),
                    step.q,
                    step.p,
                    &mut velocity[0],
                );
            ::symplectic::copy_to(velocity, 0, [1]);
            ::symplectic::scale(
                &mut velocity[0],
                step.size,
                ::symplectic::Coefficient::exact(0.5),
            );
            ::symplectic::scale(
                &mut velocity[1],
                step.size,
                ::symplectic::Coefficient::exact(0.5),
            );
            ::symplectic::combine::<
                R,
                V,
                _,
            >(
                &mut q[1],
                step.q,
                step.q_low,
                ::symplectic::factors([
                    ::symplectic::Coefficient::exact(1.0),
                    ::symplectic::Coefficient::exact(1.0),
                ]),
                [&velocity[0], &velocity[1]],
            );
        }
        #[inline]
        fn sweep<
            R: ::symplectic::Summation,
            V: ::symplectic::Vector,
            S: ::symplectic::Hamiltonian<V, Class = Self::Class>,
        >(
            step: &::symplectic::Step<'_, V>,
            system: &S,
            stages: &mut Self::Stages<V>,
        ) -> ::symplectic::Change {
            let ::symplectic::Stages { q, p, velocity, force } = stages;
            let mut change = ::symplectic::Change::default();
            let force_weights = ::symplectic::weights::<
                V::Scalar,
                _,
            >(
                step.size,
                [
                    ::symplectic::Coefficient::exact(0.5),
                    ::symplectic::Coefficient::exact(0.5),
                ],
            );
            let velocity_weights = ::symplectic::weights::<
                V::Scalar,
                _,
            >(
                step.size,
                [
                    ::symplectic::Coefficient::exact(0.5),
                    ::symplectic::Coefficient::exact(0.5),
                ],
            );
            system
                .force(
                    step.at(::symplectic::Coefficient::exact(0.0)),
                    step.q,
                    &p[0],
                    &mut force[0],
                );
            ::symplectic::increment::<
                R,
                V,
            >(&mut force[0], step.size, ::symplectic::Coefficient::exact(0.5));
            ::symplectic::relax::<
                R,
                V,
                _,
            >(
                &mut p[0],
                step.p,
                step.p_low,
                ::symplectic::relative::<
                    R,
                    _,
                    _,
                >([::symplectic::Coefficient::exact(1.0)], [force_weights[0]]),
                [&force[0]],
                &mut change.p,
            );
            system
                .velocity(
                    step.at(::symplectic::Coefficient::exact(0.5)),
                    step.q,
                    &p[0],
                    &mut velocity[0],
                );
            ::symplectic::increment::<
                R,
                V,
            >(&mut velocity[0], step.size, ::symplectic::Coefficient::exact(0.5));
            system
                .velocity(
                    step.at(::symplectic::Coefficient::exact(0.5)),
                    &q[1],
                    &p[0],
                    &mut velocity[1],
                );
            ::symplectic::increment::<
                R,
                V,
            >(&mut velocity[1], step.size, ::symplectic::Coefficient::exact(0.5));
            ::symplectic::relax::<
                R,
                V,
                _,
            >(
                &mut q[1],
                step.q,
                step.q_low,
                ::symplectic::relative::<
                    R,
                    _,
                    _,
                >(
                    [
                        ::symplectic::Coefficient::exact(1.0),
                        ::symplectic::Coefficient::exact(1.0),
                    ],
                    [velocity_weights[0], velocity_weights[1]],
                ),
                [&velocity[0], &velocity[1]],
                &mut change.q,
            );
            change
        }
        #[inline]
        fn increments<V: ::symplectic::Vector>(
            step: &::symplectic::Step<'_, V>,
            stages: &mut Self::Stages<V>,
        ) {
            let ::symplectic::Stages { q, p, velocity, force } = stages;
            ::symplectic::scale(
                &mut force[0],
                step.size,
                ::symplectic::Coefficient::exact(0.5),
            );
            ::symplectic::scale(
                &mut velocity[0],
                step.size,
                ::symplectic::Coefficient::exact(0.5),
            );
            ::symplectic::scale(
                &mut velocity[1],
                step.size,
                ::symplectic::Coefficient::exact(0.5),
            );
        }
        #[inline]
        fn finish<
            R: ::symplectic::Summation,
            V: ::symplectic::Vector,
            S: ::symplectic::Hamiltonian<V, Class = Self::Class>,
            W: ::symplectic::Witness,
        >(
            step: &::symplectic::Step<'_, V>,
            system: &S,
            stages: &mut Self::Stages<V>,
            kept: ::symplectic::Kept,
            outcome: ::symplectic::Outcome<'_, V>,
            witness: &mut W,
        ) {
            let ::symplectic::Outcome { q: q1, q_low: q1_low, p: p1, p_low: p1_low } = outcome;
            let ::symplectic::Stages { q, p, velocity, force } = stages;
            system
                .force(
                    step.at(::symplectic::Coefficient::exact(1.0)),
                    &q[1],
                    &p[0],
                    &mut force[1],
                );
            ::symplectic::scale(
                &mut force[1],
                step.size,
                ::symplectic::Coefficient::exact(0.5),
            );
            ::symplectic::total::<
                R,
                V,
                _,
            >(q1, q1_low, step.q, step.q_low, [&velocity[0], &velocity[1]]);
            ::symplectic::total::<
                R,
                V,
                _,
            >(p1, p1_low, step.p, step.p_low, [&force[0], &force[1]]);
        }
    }
    impl ::symplectic::StageTableau for StoermerVerletGeneral {
        type Lanes = ::symplectic::F64x2;
        type Groups<T: ::core::fmt::Debug> = [T; 1];
        const INCREMENTS: bool = true;
        const POSITIONS: ::symplectic::HalfTableau = ::symplectic::HalfTableau {
            count: 2,
            columns: &[&[0.0, 1.0], &[0.0, 1.0]],
            times: &[0.0, 1.0],
            weights: &[0.5, 0.5],
            extrapolation: &[&[0.0, (-1.0)], &[1.0, 2.0]],
            polynomial: ::core::option::Option::Some(::symplectic::StagePolynomial {
                legendre: &[&[(-1.0), 1.0]],
                order: 2,
            }),
        };
        const MOMENTA: ::symplectic::HalfTableau = ::symplectic::HalfTableau {
            count: 2,
            columns: &[&[1.0, 1.0], &[0.0, 0.0]],
            times: &[0.5, 0.5],
            weights: &[0.5, 0.5],
            extrapolation: &[],
            polynomial: ::core::option::Option::Some(::symplectic::StagePolynomial {
                legendre: &[&[(-1.0), 1.0]],
                order: 2,
            }),
        };
        const SECOND_ORDER: ::core::option::Option<::symplectic::SecondOrderTableau> = ::core::option::Option::None;
        #[inline(always)]
        fn groups<T: ::core::fmt::Debug>(
            mut make: impl ::core::ops::FnMut(usize) -> T,
        ) -> [T; 1] {
            [make(0)]
        }
        #[inline(always)]
        fn stored<V: ::symplectic::Vector>(
            stages: &Self::Stages<V>,
        ) -> [::symplectic::StoredEvaluations<'_, V>; 2] {
            [
                ::symplectic::StoredEvaluations {
                    values: &stages.velocity,
                    carried: &[],
                },
                ::symplectic::StoredEvaluations {
                    values: &stages.force,
                    carried: &[],
                },
            ]
        }
    }
    pub struct StoermerVerletSeparable;
    #[allow(unused_variables)]
    impl ::symplectic::SplittingPlan for StoermerVerletSeparable {
        type Class = ::symplectic::Separable;
        const EVALUATIONS: u32 = 3;
        const CARRIED: u32 = 1;
        #[inline(always)]
        fn apply<
            R: ::symplectic::Summation,
            V: ::symplectic::Vector,
            S: ::symplectic::Hamiltonian<V, Class = Self::Class>,
            K: ::symplectic::Moves,
            W: ::symplectic::Witness,
        >(
            span: ::symplectic::Span,
            system: &S,
            evaluations: &mut ::symplectic::Evaluations<V>,
            kept: ::symplectic::Kept,
            state: ::symplectic::Outcome<'_, V>,
            moves: &mut K,
            witness: &mut W,
        ) {
            let ::symplectic::Evaluations { velocity, force } = evaluations;
            let ::symplectic::Outcome { q, q_low, p, p_low } = state;
            if !kept.evaluation {
                moves
                    .force::<
                        R,
                        V,
                        S,
                        W,
                    >(
                        ::symplectic::Force {
                            span,
                            stage: 1,
                            time: ::symplectic::Coefficient::exact(0.0),
                        },
                        system,
                        &mut *force,
                        &mut *q,
                        (&mut *p, &mut *p_low),
                        witness,
                    );
            }
            moves
                .kick::<
                    R,
                    V,
                    S,
                >(
                    span.size,
                    ::symplectic::Coefficient::exact(0.5),
                    system,
                    &mut *force,
                    &mut *q,
                    (&mut *p, &mut *p_low),
                );
            moves
                .drift::<
                    R,
                    V,
                    S,
                    W,
                >(
                    ::symplectic::Drift {
                        span,
                        stage: 1,
                        time: ::symplectic::Coefficient::exact(0.5),
                        weight: ::symplectic::Coefficient::exact(1.0),
                        known: false,
                    },
                    system,
                    (&mut *velocity, &mut *force),
                    (&mut *q, &mut *q_low),
                    (&mut *p, &mut *p_low),
                    witness,
                );
            moves
                .force::<
                    R,
                    V,
                    S,
                    W,
                >(
                    ::symplectic::Force {
                        span,
                        stage: 2,
                        time: ::symplectic::Coefficient::exact(1.0),
                    },
                    system,
                    &mut *force,
                    &mut *q,
                    (&mut *p, &mut *p_low),
                    witness,
                );
            moves
                .kick::<
                    R,
                    V,
                    S,
                >(
                    span.size,
                    ::symplectic::Coefficient::exact(0.5),
                    system,
                    &mut *force,
                    &mut *q,
                    (&mut *p, &mut *p_low),
                );
        }
    }
};
