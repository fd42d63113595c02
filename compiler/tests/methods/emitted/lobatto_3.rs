/// Documentation of the user.
/**

```text
3 stages, basis polynomial(3), nodes lobatto(3)

  c │ a                      c̃ │ ã
────┼─────────────────     ────┼───────────────
  0 │    0    0      0       0 │ 1/6  -1/6    0
1/2 │ 5/24  1/3  -1/24     1/2 │ 1/6   1/3    0
  1 │  1/6  2/3    1/6       1 │ 1/6   5/6    0
────┼─────────────────     ────┼───────────────
  b │  1/6  2/3    1/6       b̃ │ 1/6   2/3  1/6

properties
  symplectic          yes  proved
  symmetric           yes  proved
  consistent          yes  proved
  equal_matrices      no   refuted  a_11 − ã_11 = -1/6
  explicit            no   refuted  these stages need one another: Q2 → P1 → Q2
  first_row_zero      yes  proved
  stiffly_accurate    yes  proved
  first_same_as_last  yes  proved   Q_s = q1 is Q_1 of the next step
  positive_weights    yes  proved
  constrained         yes  proved   det (A Ã) ≈ 0.0208333
  nonholonomic        no   refuted  steps with non-holonomic constraints have order 2 at most
```*/
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Lobatto3;
#[allow(clippy::approx_constant)]
impl Lobatto3 {
    /// a_ij: the position stages from the velocities. Correctly rounded.
    pub const A: [[f64; 3]; 3] = [
        [0.0, 0.0, 0.0],
        [0.20833333333333334, 0.3333333333333333, (-0.041666666666666664)],
        [0.16666666666666666, 0.6666666666666666, 0.16666666666666666],
    ];
    /// ã_ij: the momentum stages from the forces. Correctly rounded.
    pub const A_TILDE: [[f64; 3]; 3] = [
        [0.16666666666666666, (-0.16666666666666666), 0.0],
        [0.16666666666666666, 0.3333333333333333, 0.0],
        [0.16666666666666666, 0.8333333333333334, 0.0],
    ];
    /// b_j: the weights of the velocities. Correctly rounded.
    pub const B: [f64; 3] = [
        0.16666666666666666,
        0.6666666666666666,
        0.16666666666666666,
    ];
    /// b̃_j: the weights of the forces. Correctly rounded.
    pub const B_TILDE: [f64; 3] = Self::B;
    /// c_i = Σ_j a_ij. Correctly rounded.
    pub const C: [f64; 3] = [0.0, 0.5, 1.0];
    /// c̃_i = Σ_j ã_ij. Correctly rounded.
    pub const C_TILDE: [f64; 3] = [0.0, 0.5, 1.0];
}
#[allow(clippy::approx_constant)]
const _: () = {
    use ::symplectic::emitted;
    impl emitted::Method for Lobatto3 {
        const NAME: &'static str = "Lobatto3";
        const STAGES: usize = 3;
        const DEFINITION: &'static str = "basis: polynomial(3), nodes: lobatto(3)";
        const COEFFICIENTS: emitted::Coefficients = {
            const A: &[&[emitted::Coefficient]] = &[
                &[emitted::exact(0.0), emitted::exact(0.0), emitted::exact(0.0)],
                &[
                    emitted::rounded(0.20833333333333334, (-9.25185853854297e-18)),
                    emitted::rounded(0.3333333333333333, 1.850371707708594e-17),
                    emitted::rounded((-0.041666666666666664), (-2.3129646346357427e-18)),
                ],
                &[
                    emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
                    emitted::rounded(0.6666666666666666, 3.700743415417188e-17),
                    emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
                ],
            ];
            const B: &[emitted::Coefficient] = &[
                emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
                emitted::rounded(0.6666666666666666, 3.700743415417188e-17),
                emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
            ];
            const C: &[emitted::Coefficient] = &[
                emitted::exact(0.0),
                emitted::exact(0.5),
                emitted::exact(1.0),
            ];
            const A_TILDE: &[&[emitted::Coefficient]] = &[
                &[
                    emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
                    emitted::rounded((-0.16666666666666666), (-9.25185853854297e-18)),
                    emitted::exact(0.0),
                ],
                &[
                    emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
                    emitted::rounded(0.3333333333333333, 1.850371707708594e-17),
                    emitted::exact(0.0),
                ],
                &[
                    emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
                    emitted::rounded(0.8333333333333334, (-3.700743415417188e-17)),
                    emitted::exact(0.0),
                ],
            ];
            const C_TILDE: &[emitted::Coefficient] = &[
                emitted::exact(0.0),
                emitted::exact(0.5),
                emitted::exact(1.0),
            ];
            emitted::Coefficients::new([A, A_TILDE], [B, B], [C, C_TILDE])
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
        const CONSTRAINED: &'static [emitted::ConstrainedStep] = {
            const TABLEAU1: emitted::ConstrainedTableau = emitted::ConstrainedTableau {
                positions: &[
                    &[emitted::exact(0.0), emitted::exact(0.0), emitted::exact(0.0)],
                    &[
                        emitted::exact(1.25),
                        emitted::exact(0.5),
                        emitted::exact((-0.25)),
                    ],
                    &[emitted::exact(1.0), emitted::exact(1.0), emitted::exact(1.0)],
                ],
                momenta: &[
                    &[emitted::exact(1.0), emitted::exact((-0.25)), emitted::exact(0.0)],
                    &[emitted::exact(1.0), emitted::exact(0.5), emitted::exact(0.0)],
                    &[emitted::exact(1.0), emitted::exact(1.25), emitted::exact(0.0)],
                ],
                weights: &[
                    emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
                    emitted::rounded(0.6666666666666666, 3.700743415417188e-17),
                    emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
                ],
                nodes: &[emitted::exact(0.0), emitted::exact(0.5), emitted::exact(1.0)],
                momentum_nodes: &[
                    emitted::exact(0.0),
                    emitted::exact(0.5),
                    emitted::exact(1.0),
                ],
                multipliers: &[&[16.0, (-2.0)], &[(-8.0), 4.0]],
            };
            &[
                emitted::ConstrainedStep::new(
                    emitted::exact(0.0),
                    emitted::exact(1.0),
                    &TABLEAU1,
                ),
            ]
        };
        type General = emitted::Coupled<Lobatto3General>;
        type Separable = emitted::Coupled<Lobatto3Separable>;
    }
    impl<C: emitted::Holonomic> emitted::ProvedFor<C> for Lobatto3 {}
    impl<C> emitted::SymmetricFor<C> for Lobatto3 {}
    pub struct Lobatto3General;
    impl Lobatto3General {
        const C: [emitted::Coefficient; 3] = [
            emitted::exact(0.0),
            emitted::exact(0.5),
            emitted::exact(1.0),
        ];
        const B_TILDE: [emitted::Coefficient; 3] = [
            emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
            emitted::rounded(0.6666666666666666, 3.700743415417188e-17),
            emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
        ];
        const C_TILDE: [emitted::Coefficient; 3] = Self::C;
        const B: [emitted::Coefficient; 3] = Self::B_TILDE;
        const Q_1: [emitted::Coefficient; 3] = [
            emitted::exact(1.25),
            emitted::exact(0.5),
            emitted::exact((-0.25)),
        ];
        const Q_2: [emitted::Coefficient; 3] = [
            emitted::exact(1.0),
            emitted::exact(1.0),
            emitted::exact(1.0),
        ];
        const P_0: [emitted::Coefficient; 2] = [
            emitted::exact(1.0),
            emitted::exact((-0.25)),
        ];
        const P_1: [emitted::Coefficient; 2] = [
            emitted::exact(1.0),
            emitted::exact(0.5),
        ];
        const P_2: [emitted::Coefficient; 2] = [
            emitted::exact(1.0),
            emitted::exact(1.25),
        ];
        const E: &'static [&'static [f64]] = <Self as emitted::StageTableau>::MOMENTA
            .extrapolation;
        const E_TILDE: &'static [&'static [f64]] = &[&[(-1.0), (-8.0)], &[0.5, 3.0]];
    }
    #[allow(unused_variables)]
    impl emitted::StagePlan for Lobatto3General {
        type Class = emitted::General;
        type Stages<V: emitted::Vector> = emitted::Stages<V, 3, 3>;
        const EVALUATIONS: emitted::EvaluationCounts = emitted::EvaluationCounts {
            begin: 0,
            start: 1,
            sweep: 5,
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
            if kept.stages {
                emitted::transform(&mut stages.velocity, [0, 1, 2], Self::E);
                Self::positions(step, stages, sums);
                emitted::transform(&mut stages.force, [0, 1], Self::E_TILDE);
                Self::momenta(step, stages, sums);
            } else {
                emitted::reset(&mut stages.p, [0, 1, 2], step.p);
                let time = step.at(Self::C_TILDE[0]);
                system.velocity(time, step.q, step.p, &mut stages.velocity[0]);
                emitted::copy_to(&mut stages.velocity, 0, [1, 2]);
                emitted::scale_all(&mut stages.velocity, [0, 1, 2], step.size, Self::B);
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
            system.force(step.at(Self::C[0]), step.q, &p[0], &mut force[0]);
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
            let (base, terms) = (
                (step.p, step.p_low),
                [&force[0], &force[1], &force[2]],
            );
            let weights = emitted::weights::<V::Scalar, _>(step.size, Self::B_TILDE);
            sums.increments(
                &mut p[0],
                base,
                Self::P_0,
                [weights[0], weights[1]],
                [terms[0], terms[1]],
            );
            sums.increments(
                &mut p[1],
                base,
                Self::P_1,
                [weights[0], weights[1]],
                [terms[0], terms[1]],
            );
            sums.increments(
                &mut p[2],
                base,
                Self::P_2,
                [weights[0], weights[1]],
                [terms[0], terms[1]],
            );
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
            system.velocity(step.at(Self::C_TILDE[1]), &q[1], &p[1], &mut velocity[1]);
            emitted::increment::<R, V>(&mut velocity[1], step.size, Self::B[1]);
            system.velocity(step.at(Self::C_TILDE[2]), &q[2], &p[2], &mut velocity[2]);
            emitted::increment::<R, V>(&mut velocity[2], step.size, Self::B[2]);
        }
        #[inline]
        fn positions<V: emitted::Vector, A: emitted::StageSums>(
            step: &emitted::Step<'_, V>,
            stages: &mut Self::Stages<V>,
            sums: &mut A,
        ) {
            let emitted::Stages { q, velocity, .. } = stages;
            let (base, terms) = (
                (step.q, step.q_low),
                [&velocity[0], &velocity[1], &velocity[2]],
            );
            let weights = emitted::weights::<V::Scalar, _>(step.size, Self::B);
            sums.increments(&mut q[1], base, Self::Q_1, weights, terms);
            sums.increments(&mut q[2], base, Self::Q_2, weights, terms);
        }
        #[inline]
        fn increments<V: emitted::Vector>(
            step: &emitted::Step<'_, V>,
            stages: &mut Self::Stages<V>,
        ) {
            emitted::scale_all(
                &mut stages.force,
                [0, 1],
                step.size,
                [Self::B_TILDE[0], Self::B_TILDE[1]],
            );
            emitted::scale_all(&mut stages.velocity, [0, 1, 2], step.size, Self::B);
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
            system.force(step.at(emitted::exact(1.0)), &q[2], &p[2], &mut force[2]);
            emitted::scale(
                &mut force[2],
                step.size,
                emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
            );
            let increments = [&velocity[0], &velocity[1], &velocity[2]];
            emitted::total::<R, V, _>(q1, q1_low, step.q, step.q_low, increments);
            let increments = [&force[0], &force[1], &force[2]];
            emitted::total::<R, V, _>(p1, p1_low, step.p, step.p_low, increments);
        }
    }
    impl emitted::StageTableau for Lobatto3General {
        type Lanes = emitted::F64x4;
        type Groups<T: ::core::fmt::Debug> = [T; 1];
        const INCREMENTS: bool = true;
        const POSITIONS: emitted::HalfTableau = emitted::HalfTableau {
            count: 3,
            columns: &[
                &[0.0, 1.25, 1.0, 1.0],
                &[0.0, 0.5, 1.0, 1.0],
                &[0.0, (-0.25), 1.0, 1.0],
            ],
            times: &[0.0, 0.5, 1.0, 1.0],
            weights: &[
                0.16666666666666666,
                0.6666666666666666,
                0.16666666666666666,
                0.16666666666666666,
            ],
            extrapolation: &[
                &[0.0, 4.0, 3.0, 3.0],
                &[0.0, (-3.0), (-2.0), (-2.0)],
                &[1.0, 12.0, 6.0, 6.0],
            ],
            polynomial: ::core::option::Option::Some(emitted::StagePolynomial {
                legendre: &[&[(-3.0), 0.0, 3.0], &[2.0, (-1.0), 2.0]],
                order: 3,
            }),
        };
        const MOMENTA: emitted::HalfTableau = emitted::HalfTableau {
            count: 3,
            columns: &[
                &[1.0, 1.0, 1.0, 1.0],
                &[(-0.25), 0.5, 1.25, 1.25],
                &[0.0, 0.0, 0.0, 0.0],
            ],
            times: &[0.0, 0.5, 1.0, 1.0],
            weights: &[
                0.16666666666666666,
                0.6666666666666666,
                0.16666666666666666,
                0.16666666666666666,
            ],
            extrapolation: &[
                &[0.0, 4.0, 3.0, 3.0],
                &[0.0, (-3.0), (-2.0), (-2.0)],
                &[1.0, 12.0, 6.0, 6.0],
            ],
            polynomial: ::core::option::Option::Some(emitted::StagePolynomial {
                legendre: &[&[(-3.0), 0.0, 3.0], &[2.0, (-1.0), 2.0]],
                order: 3,
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
    pub struct Lobatto3Separable;
    impl Lobatto3Separable {
        const C: [emitted::Coefficient; 3] = [
            emitted::exact(0.0),
            emitted::exact(0.5),
            emitted::exact(1.0),
        ];
        const B_TILDE: [emitted::Coefficient; 3] = [
            emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
            emitted::rounded(0.6666666666666666, 3.700743415417188e-17),
            emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
        ];
        const C_TILDE: [emitted::Coefficient; 3] = Self::C;
        const B: [emitted::Coefficient; 3] = Self::B_TILDE;
        const Q_1: [emitted::Coefficient; 3] = [
            emitted::exact(1.25),
            emitted::exact(0.5),
            emitted::exact((-0.25)),
        ];
        const P_0: [emitted::Coefficient; 2] = [
            emitted::exact(1.0),
            emitted::exact((-0.25)),
        ];
        const P_1: [emitted::Coefficient; 2] = [
            emitted::exact(1.0),
            emitted::exact(0.5),
        ];
        const P_2: [emitted::Coefficient; 2] = [
            emitted::exact(1.0),
            emitted::exact(1.25),
        ];
        const E: &'static [&'static [f64]] = <Self as emitted::StageTableau>::MOMENTA
            .extrapolation;
    }
    #[allow(unused_variables)]
    impl emitted::StagePlan for Lobatto3Separable {
        type Class = emitted::Separable;
        type Stages<V: emitted::Vector> = emitted::Stages<V, 3, 3>;
        const EVALUATIONS: emitted::EvaluationCounts = emitted::EvaluationCounts {
            begin: 1,
            start: 1,
            sweep: 4,
            finish: 1,
            carried: 1,
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
            let emitted::Stages { q, p, velocity, force } = &mut *stages;
            if !kept.evaluation {
                system
                    .force(step.at(emitted::exact(0.0)), step.q, step.p, &mut force[2]);
            }
            emitted::copy_to(force, 2, [0]);
            emitted::scale(
                &mut force[0],
                step.size,
                emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
            );
            let sums = &mut emitted::StartingValues::<R>::new();
            if kept.stages {
                emitted::transform(&mut stages.velocity, [0, 1, 2], Self::E);
                Self::positions(step, stages, sums);
            } else {
                emitted::reset(&mut stages.p, [0, 1, 2], step.p);
                let time = step.at(Self::C_TILDE[0]);
                system.velocity(time, step.q, step.p, &mut stages.velocity[0]);
                emitted::copy_to(&mut stages.velocity, 0, [1, 2]);
                emitted::scale_all(&mut stages.velocity, [0, 1, 2], step.size, Self::B);
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
            system.force(step.at(Self::C[1]), &q[1], step.p, &mut force[1]);
            emitted::increment::<R, V>(&mut force[1], step.size, Self::B_TILDE[1]);
        }
        #[inline]
        fn momenta<V: emitted::Vector, A: emitted::StageSums>(
            step: &emitted::Step<'_, V>,
            stages: &mut Self::Stages<V>,
            sums: &mut A,
        ) {
            let emitted::Stages { p, force, .. } = stages;
            let (base, terms) = (
                (step.p, step.p_low),
                [&force[0], &force[1], &force[2]],
            );
            let weights = emitted::weights::<V::Scalar, _>(step.size, Self::B_TILDE);
            let one = <V::Scalar as emitted::Scalar>::from_f64(1.0);
            sums.increments(
                &mut p[0],
                base,
                Self::P_0,
                [one, weights[1]],
                [terms[0], terms[1]],
            );
            sums.increments(
                &mut p[1],
                base,
                Self::P_1,
                [one, weights[1]],
                [terms[0], terms[1]],
            );
            sums.increments(
                &mut p[2],
                base,
                Self::P_2,
                [one, weights[1]],
                [terms[0], terms[1]],
            );
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
            system.velocity(step.at(Self::C_TILDE[1]), step.q, &p[1], &mut velocity[1]);
            emitted::increment::<R, V>(&mut velocity[1], step.size, Self::B[1]);
            system.velocity(step.at(Self::C_TILDE[2]), step.q, &p[2], &mut velocity[2]);
            emitted::increment::<R, V>(&mut velocity[2], step.size, Self::B[2]);
        }
        #[inline]
        fn positions<V: emitted::Vector, A: emitted::StageSums>(
            step: &emitted::Step<'_, V>,
            stages: &mut Self::Stages<V>,
            sums: &mut A,
        ) {
            let emitted::Stages { q, velocity, .. } = stages;
            let (base, terms) = (
                (step.q, step.q_low),
                [&velocity[0], &velocity[1], &velocity[2]],
            );
            let weights = emitted::weights::<V::Scalar, _>(step.size, Self::B);
            sums.increments(&mut q[1], base, Self::Q_1, weights, terms);
        }
        #[inline]
        fn increments<V: emitted::Vector>(
            step: &emitted::Step<'_, V>,
            stages: &mut Self::Stages<V>,
        ) {
            emitted::scale_all(&mut stages.force, [1], step.size, [Self::B_TILDE[1]]);
            emitted::scale_all(&mut stages.velocity, [0, 1, 2], step.size, Self::B);
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
            let increments = [&velocity[0], &velocity[1], &velocity[2]];
            emitted::total::<R, V, _>(q1, q1_low, step.q, step.q_low, increments);
            system.force(step.at(emitted::exact(1.0)), &*q1, step.p, &mut force[2]);
            let increments = [&force[0], &force[1]];
            emitted::total::<R, V, _>(p1, p1_low, step.p, step.p_low, increments);
            emitted::advance::<
                R,
                V,
            >(
                p1,
                p1_low,
                step.size,
                emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
                &force[2],
            );
        }
    }
    impl emitted::StageTableau for Lobatto3Separable {
        type Lanes = emitted::F64x4;
        type Groups<T: ::core::fmt::Debug> = [T; 1];
        const INCREMENTS: bool = true;
        const POSITIONS: emitted::HalfTableau = emitted::HalfTableau {
            count: 3,
            columns: &[
                &[0.0, 1.25, 1.0, 1.0],
                &[0.0, 0.5, 1.0, 1.0],
                &[0.0, (-0.25), 1.0, 1.0],
            ],
            times: &[0.0, 0.5, 1.0, 1.0],
            weights: &[
                0.16666666666666666,
                0.6666666666666666,
                0.16666666666666666,
                0.16666666666666666,
            ],
            extrapolation: &[
                &[0.0, 4.0, 3.0, 3.0],
                &[0.0, (-3.0), (-2.0), (-2.0)],
                &[1.0, 12.0, 6.0, 6.0],
            ],
            polynomial: ::core::option::Option::Some(emitted::StagePolynomial {
                legendre: &[&[(-3.0), 0.0, 3.0], &[2.0, (-1.0), 2.0]],
                order: 4,
            }),
        };
        const MOMENTA: emitted::HalfTableau = <Lobatto3General as emitted::StageTableau>::MOMENTA;
        const SECOND_ORDER: ::core::option::Option<emitted::SecondOrderTableau> = ::core::option::Option::Some(emitted::SecondOrderTableau {
            nodes: &[0.0, 0.5, 1.0, 1.0],
            columns: &[
                &[0.0, 0.5, 1.0, 1.0],
                &[0.0, 0.0625, 0.5, 0.5],
                &[0.0, 0.0, 0.0, 0.0],
            ],
            of_forces: &[
                &[0.0, 0.08333333333333333, 0.16666666666666666, 0.16666666666666666],
                &[0.0, 0.041666666666666664, 0.3333333333333333, 0.3333333333333333],
                &[0.0, 0.0, 0.0, 0.0],
            ],
        });
        const DECOUPLING: ::core::option::Option<emitted::Decoupling> = ::core::option::Option::Some(emitted::Decoupling {
            blocks: &[(0.0, 0.0), (0.0, 0.0), (0.041666666666666664, 0.0)],
            to_stages: &[&[(-1.6), 0.2, (-0.2)], &[1.0, 0.0, 0.4], &[0.0, 1.0, 1.0]],
            from_stages: &[
                &[(-1.6666666666666667), (-1.6666666666666667), 0.3333333333333333],
                &[(-4.166666666666667), (-6.666666666666667), 1.8333333333333333],
                &[4.166666666666667, 6.666666666666667, (-0.8333333333333334)],
            ],
        });
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
            stages.stored(&[], &[2])
        }
    }
};
