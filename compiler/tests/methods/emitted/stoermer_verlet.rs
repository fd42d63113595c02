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
    use ::symplectic::emitted;
    impl emitted::Method for StoermerVerlet {
        const NAME: &'static str = "StoermerVerlet";
        const STAGES: usize = 2;
        const DEFINITION: &'static str = "basis: polynomial(2), nodes: lobatto(2)";
        const COEFFICIENTS: emitted::Coefficients = {
            const A: &[&[emitted::Coefficient]] = &[
                &[emitted::exact(0.0), emitted::exact(0.0)],
                &[emitted::exact(0.5), emitted::exact(0.5)],
            ];
            const B: &[emitted::Coefficient] = &[
                emitted::exact(0.5),
                emitted::exact(0.5),
            ];
            const C: &[emitted::Coefficient] = &[
                emitted::exact(0.0),
                emitted::exact(1.0),
            ];
            const A_TILDE: &[&[emitted::Coefficient]] = &[
                &[emitted::exact(0.5), emitted::exact(0.0)],
                &[emitted::exact(0.5), emitted::exact(0.0)],
            ];
            const C_TILDE: &[emitted::Coefficient] = &[
                emitted::exact(0.5),
                emitted::exact(0.5),
            ];
            emitted::Coefficients::new([A, A_TILDE], [B, B], [C, C_TILDE])
        };
        const ORDERS: emitted::Orders = emitted::Orders {
            general: 2,
            separable: 2,
            nystrom: 2,
        };
        const SYMMETRY: emitted::Symmetry = emitted::Symmetry {
            general: true,
            separable: true,
        };
        const CONSTRAINED: &'static [emitted::ConstrainedStep] = {
            const TABLEAU1: emitted::ConstrainedTableau = emitted::ConstrainedTableau {
                positions: &[
                    &[emitted::exact(0.0), emitted::exact(0.0)],
                    &[emitted::exact(1.0), emitted::exact(1.0)],
                ],
                momenta: &[
                    &[emitted::exact(1.0), emitted::exact(0.0)],
                    &[emitted::exact(1.0), emitted::exact(0.0)],
                ],
                weights: &[emitted::exact(0.5), emitted::exact(0.5)],
                nodes: &[emitted::exact(0.0), emitted::exact(1.0)],
                momentum_nodes: &[emitted::exact(0.5), emitted::exact(0.5)],
                multipliers: &[&[2.0]],
            };
            &[
                emitted::ConstrainedStep::new(
                    emitted::exact(0.0),
                    emitted::exact(1.0),
                    &TABLEAU1,
                ),
            ]
        };
        const NONHOLONOMIC: &'static [emitted::ConstrainedStep] = {
            const TABLEAU1: emitted::ConstrainedTableau = emitted::ConstrainedTableau {
                positions: &[
                    &[emitted::exact(0.0), emitted::exact(0.0)],
                    &[emitted::exact(1.0), emitted::exact(1.0)],
                ],
                momenta: &[
                    &[emitted::exact(1.0), emitted::exact(0.0)],
                    &[emitted::exact(1.0), emitted::exact(0.0)],
                ],
                weights: &[emitted::exact(0.5), emitted::exact(0.5)],
                nodes: &[emitted::exact(0.0), emitted::exact(1.0)],
                momentum_nodes: &[emitted::exact(0.5), emitted::exact(0.5)],
                multipliers: &[],
            };
            &[
                emitted::ConstrainedStep::new(
                    emitted::exact(0.0),
                    emitted::exact(1.0),
                    &TABLEAU1,
                ),
            ]
        };
        type General = emitted::Coupled<StoermerVerletGeneral>;
        type Separable = emitted::Splitting<StoermerVerletSeparable>;
    }
    impl<C> emitted::ProvedFor<C> for StoermerVerlet {}
    impl emitted::Splits for StoermerVerlet {}
    impl<C> emitted::SymmetricFor<C> for StoermerVerlet {}
    impl emitted::StoermerVerletSteps for StoermerVerlet {}
    pub struct StoermerVerletGeneral;
    impl StoermerVerletGeneral {
        const C: [emitted::Coefficient; 2] = [emitted::exact(0.0), emitted::exact(1.0)];
        const B_TILDE: [emitted::Coefficient; 2] = [
            emitted::exact(0.5),
            emitted::exact(0.5),
        ];
        const C_TILDE: [emitted::Coefficient; 2] = Self::B_TILDE;
        const B: [emitted::Coefficient; 2] = Self::B_TILDE;
        const Q_1: [emitted::Coefficient; 2] = [
            emitted::exact(1.0),
            emitted::exact(1.0),
        ];
        const P_0: [emitted::Coefficient; 1] = [emitted::exact(1.0)];
    }
    #[allow(unused_variables)]
    impl emitted::StagePlan for StoermerVerletGeneral {
        type Class = emitted::General;
        type Stages<V: emitted::Vector> = emitted::Stages<V, 2, 2>;
        const EVALUATIONS: emitted::EvaluationCounts = emitted::EvaluationCounts {
            begin: 1,
            start: 0,
            sweep: 3,
            finish: 1,
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
            emitted::reset(&mut stages.p, [0], step.p);
            let time = step.at(Self::C_TILDE[0]);
            system.velocity(time, step.q, step.p, &mut stages.velocity[0]);
            emitted::copy_to(&mut stages.velocity, 0, [1]);
            emitted::scale_all(&mut stages.velocity, [0, 1], step.size, Self::B);
            Self::positions(step, stages, sums);
        }
        #[inline]
        fn forces<
            R: emitted::Summation,
            V: emitted::Vector,
            S: emitted::System<V, Class = Self::Class>,
        >(step: &emitted::Step<'_, V>, system: &S, stages: &mut Self::Stages<V>) {
            let emitted::Stages { q, p, force, .. } = stages;
            system.force(step.at(Self::C[0]), step.q, &p[0], &mut force[0]);
            emitted::increment::<R, V>(&mut force[0], step.size, Self::B_TILDE[0]);
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
            sums.increments(&mut p[0], base, Self::P_0, [weights[0]], [terms[0]]);
        }
        #[inline]
        fn velocities<
            R: emitted::Summation,
            V: emitted::Vector,
            S: emitted::System<V, Class = Self::Class>,
        >(step: &emitted::Step<'_, V>, system: &S, stages: &mut Self::Stages<V>) {
            let emitted::Stages { q, p, velocity, .. } = stages;
            system.velocity(step.at(Self::C_TILDE[0]), step.q, &p[0], &mut velocity[0]);
            emitted::increment::<R, V>(&mut velocity[0], step.size, Self::B[0]);
            system.velocity(step.at(Self::C_TILDE[1]), &q[1], &p[0], &mut velocity[1]);
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
            sums.increments(&mut q[1], base, Self::Q_1, weights, terms);
        }
        #[inline]
        fn increments<V: emitted::Vector>(
            step: &emitted::Step<'_, V>,
            stages: &mut Self::Stages<V>,
        ) {
            emitted::scale_all(&mut stages.force, [0], step.size, [Self::B_TILDE[0]]);
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
            system.force(step.at(emitted::exact(1.0)), &q[1], &p[0], &mut force[1]);
            emitted::scale(&mut force[1], step.size, emitted::exact(0.5));
            let increments = [&velocity[0], &velocity[1]];
            emitted::total::<R, V, _>(q1, q1_low, step.q, step.q_low, increments);
            let increments = [&force[0], &force[1]];
            emitted::total::<R, V, _>(p1, p1_low, step.p, step.p_low, increments);
        }
    }
    impl emitted::StageTableau for StoermerVerletGeneral {
        type Lanes = emitted::F64x2;
        type Groups<T: ::core::fmt::Debug> = [T; 1];
        const INCREMENTS: bool = true;
        const POSITIONS: emitted::HalfTableau = emitted::HalfTableau {
            count: 2,
            columns: &[&[0.0, 1.0], &[0.0, 1.0]],
            times: &[0.0, 1.0],
            weights: &[0.5, 0.5],
            extrapolation: &[&[0.0, (-1.0)], &[1.0, 2.0]],
            polynomial: ::core::option::Option::Some(emitted::StagePolynomial {
                legendre: &[&[(-1.0), 1.0]],
                order: 2,
            }),
        };
        const MOMENTA: emitted::HalfTableau = emitted::HalfTableau {
            count: 2,
            columns: &[&[1.0, 1.0], &[0.0, 0.0]],
            times: &[0.5, 0.5],
            weights: &[0.5, 0.5],
            extrapolation: &[],
            polynomial: ::core::option::Option::Some(emitted::StagePolynomial {
                legendre: &[&[(-1.0), 1.0]],
                order: 2,
            }),
        };
        const SECOND_ORDER: ::core::option::Option<emitted::SecondOrderTableau> = ::core::option::Option::None;
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
    pub struct StoermerVerletSeparable;
    #[allow(unused_variables)]
    impl emitted::SplittingPlan for StoermerVerletSeparable {
        type Class = emitted::Separable;
        const EVALUATIONS: u32 = 3;
        const CARRIED: u32 = 1;
        #[inline(always)]
        fn apply<R, V, S, K, W>(step: &mut emitted::SplittingStep<'_, R, V, S, K, W>)
        where
            R: emitted::Summation,
            V: emitted::Vector,
            S: emitted::System<V, Class = Self::Class>,
            K: emitted::KickDrift,
            W: emitted::EvaluationObserver,
        {
            step.kept_force(1, emitted::exact(0.0));
            step.kick(emitted::exact(0.5));
            step.drift(1, emitted::exact(0.5), emitted::exact(1.0));
            step.force(2, emitted::exact(1.0));
            step.kick(emitted::exact(0.5));
        }
    }
};
