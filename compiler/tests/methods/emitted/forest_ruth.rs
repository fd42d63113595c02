/// Documentation of the user.
/**

```text
forest-ruth-1990, 4 stages, kick -1/(2*(cbrt(2) - 2)), (cbrt(2) - 1)/(2*(cbrt(2) - 2)), drift -1/(cbrt(2) - 2), cbrt(2)/(cbrt(2) - 2), symmetric true
source: Forest & Ruth, Fourth-order symplectic integration, Physica D 43 (1990);
        Candy & Rozmus, J. Comput. Phys. 92 (1991);
        Yoshida 1990

                  c │ a
────────────────────┼────────────────────────────────────────────────────────────
                  0 │                 0                   0                  0  0
  1.351207191959658 │ 1.351207191959658                   0                  0  0
-0.3512071919596576 │ 1.351207191959658  -1.702414383919315                  0  0
                  1 │ 1.351207191959658  -1.702414383919315  1.351207191959658  0
────────────────────┼────────────────────────────────────────────────────────────
                  b │ 1.351207191959658  -1.702414383919315  1.351207191959658  0

                 c̃ │ ã
───────────────────┼─────────────────────────────────────────────────────────────────────────────────
0.6756035959798288 │ 0.6756035959798288                    0                    0                   0
               1/2 │ 0.6756035959798288  -0.1756035959798288                    0                   0
0.3243964040201712 │ 0.6756035959798288  -0.1756035959798288  -0.1756035959798288                   0
                 1 │ 0.6756035959798288  -0.1756035959798288  -0.1756035959798288  0.6756035959798288
───────────────────┼─────────────────────────────────────────────────────────────────────────────────
                 b̃ │ 0.6756035959798288  -0.1756035959798288  -0.1756035959798288  0.6756035959798288

Entries with a decimal point are correctly rounded to 16 significant digits; all others are exact.

properties
  symplectic             no   refuted  b_1 − b̃_1 = 1/3 + cbrt(2)/6 + cbrt(2)^2/12
  symmetric              no   refuted  no order of the stages makes the tableau equal to its adjoint
  consistent             yes  proved
  equal_matrices         no   refuted  a_11 − ã_11 = -1/3 - cbrt(2)/6 - cbrt(2)^2/12
  explicit               yes  proved   Q1, P1, Q2, P2, Q3, P3, Q4
  first_row_zero         yes  proved
  stiffly_accurate       yes  proved
  first_same_as_last     yes  proved   Q_s = q1 is Q_1 of the next step
  positive_weights       no   refuted  b_2 = -1.70241438392…
  constrained            no   refuted  b_4 = 0
  nonholonomic           no   refuted  b_4 = 0
  symplectic(separable)  yes  proved
  symmetric(separable)   yes  proved
```*/
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ForestRuth;
#[allow(clippy::approx_constant)]
impl ForestRuth {
    /// a_ij: the position stages from the velocities. Correctly rounded.
    pub const A: [[f64; 4]; 4] = [
        [0.0, 0.0, 0.0, 0.0],
        [1.3512071919596575, 0.0, 0.0, 0.0],
        [1.3512071919596575, (-1.7024143839193153), 0.0, 0.0],
        [1.3512071919596575, (-1.7024143839193153), 1.3512071919596575, 0.0],
    ];
    /// ã_ij: the momentum stages from the forces. Correctly rounded.
    pub const A_TILDE: [[f64; 4]; 4] = [
        [0.6756035959798288, 0.0, 0.0, 0.0],
        [0.6756035959798288, (-0.17560359597982883), 0.0, 0.0],
        [0.6756035959798288, (-0.17560359597982883), (-0.17560359597982883), 0.0],
        [
            0.6756035959798288,
            (-0.17560359597982883),
            (-0.17560359597982883),
            0.6756035959798288,
        ],
    ];
    /// b_j: the weights of the velocities. Correctly rounded.
    pub const B: [f64; 4] = [
        1.3512071919596575,
        (-1.7024143839193153),
        1.3512071919596575,
        0.0,
    ];
    /// b̃_j: the weights of the forces. Correctly rounded.
    pub const B_TILDE: [f64; 4] = [
        0.6756035959798288,
        (-0.17560359597982883),
        (-0.17560359597982883),
        0.6756035959798288,
    ];
    /// c_i = Σ_j a_ij. Correctly rounded.
    pub const C: [f64; 4] = [0.0, 1.3512071919596575, (-0.35120719195965766), 1.0];
    /// c̃_i = Σ_j ã_ij. Correctly rounded.
    pub const C_TILDE: [f64; 4] = [0.6756035959798288, 0.5, 0.32439640402017117, 1.0];
}
#[allow(clippy::approx_constant)]
const _: () = {
    use ::symplectic::emitted;
    impl emitted::Method for ForestRuth {
        const NAME: &'static str = "ForestRuth";
        const STAGES: usize = 4;
        const DEFINITION: &'static str = "kick: [-1/(2*(cbrt(2) - 2)), (cbrt(2) - 1)/(2*(cbrt(2) - 2))], drift: [-1/(cbrt(2) - 2), cbrt(2)/(cbrt(2) - 2)], symmetric: true";
        const COEFFICIENTS: emitted::Coefficients = {
            const A: &[&[emitted::Coefficient]] = &[
                &[
                    emitted::exact(0.0),
                    emitted::exact(0.0),
                    emitted::exact(0.0),
                    emitted::exact(0.0),
                ],
                &[
                    emitted::rounded(1.3512071919596575, 8.42741775545176e-17),
                    emitted::exact(0.0),
                    emitted::exact(0.0),
                    emitted::exact(0.0),
                ],
                &[
                    emitted::rounded(1.3512071919596575, 8.42741775545176e-17),
                    emitted::rounded((-1.7024143839193153), 5.349624981599612e-17),
                    emitted::exact(0.0),
                    emitted::exact(0.0),
                ],
                &[
                    emitted::rounded(1.3512071919596575, 8.42741775545176e-17),
                    emitted::rounded((-1.7024143839193153), 5.349624981599612e-17),
                    emitted::rounded(1.3512071919596575, 8.42741775545176e-17),
                    emitted::exact(0.0),
                ],
            ];
            const B: &[emitted::Coefficient] = &[
                emitted::rounded(1.3512071919596575, 8.42741775545176e-17),
                emitted::rounded((-1.7024143839193153), 5.349624981599612e-17),
                emitted::rounded(1.3512071919596575, 8.42741775545176e-17),
                emitted::exact(0.0),
            ];
            const C: &[emitted::Coefficient] = &[
                emitted::exact(0.0),
                emitted::rounded(1.3512071919596575, 8.42741775545176e-17),
                emitted::rounded((-0.35120719195965766), 2.674812490799806e-17),
                emitted::exact(1.0),
            ];
            const A_TILDE: &[&[emitted::Coefficient]] = &[
                &[
                    emitted::rounded(0.6756035959798288, 4.21370887772588e-17),
                    emitted::exact(0.0),
                    emitted::exact(0.0),
                    emitted::exact(0.0),
                ],
                &[
                    emitted::rounded(0.6756035959798288, 4.21370887772588e-17),
                    emitted::rounded((-0.17560359597982883), 1.337406245399903e-17),
                    emitted::exact(0.0),
                    emitted::exact(0.0),
                ],
                &[
                    emitted::rounded(0.6756035959798288, 4.21370887772588e-17),
                    emitted::rounded((-0.17560359597982883), 1.337406245399903e-17),
                    emitted::rounded((-0.17560359597982883), 1.337406245399903e-17),
                    emitted::exact(0.0),
                ],
                &[
                    emitted::rounded(0.6756035959798288, 4.21370887772588e-17),
                    emitted::rounded((-0.17560359597982883), 1.337406245399903e-17),
                    emitted::rounded((-0.17560359597982883), 1.337406245399903e-17),
                    emitted::rounded(0.6756035959798288, 4.21370887772588e-17),
                ],
            ];
            const C_TILDE: &[emitted::Coefficient] = &[
                emitted::rounded(0.6756035959798288, 4.21370887772588e-17),
                emitted::exact(0.5),
                emitted::rounded(0.32439640402017117, 1.337406245399903e-17),
                emitted::exact(1.0),
            ];
            const B_TILDE: &[emitted::Coefficient] = &[
                emitted::rounded(0.6756035959798288, 4.21370887772588e-17),
                emitted::rounded((-0.17560359597982883), 1.337406245399903e-17),
                emitted::rounded((-0.17560359597982883), 1.337406245399903e-17),
                emitted::rounded(0.6756035959798288, 4.21370887772588e-17),
            ];
            emitted::Coefficients::new([A, A_TILDE], [B, B_TILDE], [C, C_TILDE])
        };
        const ORDERS: emitted::Orders = emitted::Orders {
            general: 1,
            separable: 4,
            nystrom: 4,
        };
        const SYMMETRY: emitted::Symmetry = emitted::Symmetry {
            general: false,
            separable: true,
        };
        type General = emitted::Coupled<ForestRuthGeneral>;
        type Separable = emitted::Splitting<ForestRuthSeparable>;
    }
    #[diagnostic::do_not_recommend]
    impl<C: emitted::SeparableOrDamped> emitted::ProvedFor<C> for ForestRuth {}
    impl emitted::Splits for ForestRuth {}
    impl<C: emitted::SplitClass> emitted::SymmetricFor<C> for ForestRuth {}
    pub struct ForestRuthGeneral;
    impl ForestRuthGeneral {
        const C: [emitted::Coefficient; 4] = [
            emitted::exact(0.0),
            emitted::rounded(1.3512071919596575, 8.42741775545176e-17),
            emitted::rounded((-0.35120719195965766), 2.674812490799806e-17),
            emitted::exact(1.0),
        ];
        const C_TILDE: [emitted::Coefficient; 4] = [
            emitted::rounded(0.6756035959798288, 4.21370887772588e-17),
            emitted::exact(0.5),
            emitted::rounded(0.32439640402017117, 1.337406245399903e-17),
            emitted::exact(1.0),
        ];
        const Q_1: [emitted::Coefficient; 1] = [
            emitted::rounded(1.3512071919596575, 8.42741775545176e-17),
        ];
        const Q_2: [emitted::Coefficient; 2] = [
            emitted::rounded(1.3512071919596575, 8.42741775545176e-17),
            emitted::rounded((-1.7024143839193153), 5.349624981599612e-17),
        ];
        const Q_3: [emitted::Coefficient; 3] = [
            emitted::rounded(1.3512071919596575, 8.42741775545176e-17),
            emitted::rounded((-1.7024143839193153), 5.349624981599612e-17),
            emitted::rounded(1.3512071919596575, 8.42741775545176e-17),
        ];
        const P_0: [emitted::Coefficient; 1] = [
            emitted::rounded(0.6756035959798288, 4.21370887772588e-17),
        ];
        const P_1: [emitted::Coefficient; 2] = [
            emitted::rounded(0.6756035959798288, 4.21370887772588e-17),
            emitted::rounded((-0.17560359597982883), 1.337406245399903e-17),
        ];
        const P_2: [emitted::Coefficient; 3] = [
            emitted::rounded(0.6756035959798288, 4.21370887772588e-17),
            emitted::rounded((-0.17560359597982883), 1.337406245399903e-17),
            emitted::rounded((-0.17560359597982883), 1.337406245399903e-17),
        ];
        const P_3: [emitted::Coefficient; 4] = [
            emitted::rounded(0.6756035959798288, 4.21370887772588e-17),
            emitted::rounded((-0.17560359597982883), 1.337406245399903e-17),
            emitted::rounded((-0.17560359597982883), 1.337406245399903e-17),
            emitted::rounded(0.6756035959798288, 4.21370887772588e-17),
        ];
    }
    #[allow(unused_variables)]
    impl emitted::StagePlan for ForestRuthGeneral {
        type Class = emitted::General;
        type Stages<V: emitted::Vector> = emitted::Stages<V, 4, 4>;
        const EVALUATIONS: emitted::EvaluationCounts = emitted::EvaluationCounts {
            begin: 1,
            start: 0,
            sweep: 7,
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
            emitted::reset(&mut stages.p, [0, 1, 2, 3], step.p);
            let time = step.at(Self::C_TILDE[0]);
            system.velocity(time, step.q, step.p, &mut stages.velocity[0]);
            emitted::copy_to(&mut stages.velocity, 0, [1, 2]);
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
            system.force(step.at(Self::C[1]), &q[1], &p[1], &mut force[1]);
            system.force(step.at(Self::C[2]), &q[2], &p[2], &mut force[2]);
            system.force(step.at(Self::C[3]), &q[3], &p[3], &mut force[3]);
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
                [&force[0], &force[1], &force[2], &force[3]],
            );
            sums.evaluations(
                &mut p[0],
                base,
                emitted::weights(step.size, Self::P_0),
                [terms[0]],
            );
            sums.evaluations(
                &mut p[1],
                base,
                emitted::weights(step.size, Self::P_1),
                [terms[0], terms[1]],
            );
            sums.evaluations(
                &mut p[2],
                base,
                emitted::weights(step.size, Self::P_2),
                [terms[0], terms[1], terms[2]],
            );
            sums.evaluations(
                &mut p[3],
                base,
                emitted::weights(step.size, Self::P_3),
                terms,
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
            system.velocity(step.at(Self::C_TILDE[1]), &q[1], &p[1], &mut velocity[1]);
            system.velocity(step.at(Self::C_TILDE[2]), &q[2], &p[2], &mut velocity[2]);
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
                [&velocity[0], &velocity[1], &velocity[2], &velocity[3]],
            );
            sums.evaluations(
                &mut q[1],
                base,
                emitted::weights(step.size, Self::Q_1),
                [terms[0]],
            );
            sums.evaluations(
                &mut q[2],
                base,
                emitted::weights(step.size, Self::Q_2),
                [terms[0], terms[1]],
            );
            sums.evaluations(
                &mut q[3],
                base,
                emitted::weights(step.size, Self::Q_3),
                [terms[0], terms[1], terms[2]],
            );
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
            system
                .velocity(step.at(emitted::exact(1.0)), &q[3], &p[3], &mut velocity[3]);
            let (weights, terms) = (
                emitted::weights(
                    step.size,
                    [
                        emitted::rounded(1.3512071919596575, 8.42741775545176e-17),
                        emitted::rounded((-1.7024143839193153), 5.349624981599612e-17),
                        emitted::rounded(1.3512071919596575, 8.42741775545176e-17),
                    ],
                ),
                [&velocity[0], &velocity[1], &velocity[2]],
            );
            emitted::weighted_total::<
                R,
                V,
                _,
            >(q1, q1_low, step.q, step.q_low, weights, terms);
            let (weights, terms) = (
                emitted::weights(
                    step.size,
                    [
                        emitted::rounded(0.6756035959798288, 4.21370887772588e-17),
                        emitted::rounded((-0.17560359597982883), 1.337406245399903e-17),
                        emitted::rounded((-0.17560359597982883), 1.337406245399903e-17),
                        emitted::rounded(0.6756035959798288, 4.21370887772588e-17),
                    ],
                ),
                [&force[0], &force[1], &force[2], &force[3]],
            );
            emitted::weighted_total::<
                R,
                V,
                _,
            >(p1, p1_low, step.p, step.p_low, weights, terms);
        }
    }
    impl emitted::StageTableau for ForestRuthGeneral {
        type Lanes = emitted::F64x4;
        type Groups<T: ::core::fmt::Debug> = [T; 1];
        const INCREMENTS: bool = false;
        const POSITIONS: emitted::HalfTableau = emitted::HalfTableau {
            count: 4,
            columns: &[
                &[0.0, 1.3512071919596575, 1.3512071919596575, 1.3512071919596575],
                &[0.0, 0.0, (-1.7024143839193153), (-1.7024143839193153)],
                &[0.0, 0.0, 0.0, 1.3512071919596575],
                &[0.0, 0.0, 0.0, 0.0],
            ],
            times: &[0.0, 1.3512071919596575, (-0.35120719195965766), 1.0],
            weights: &[
                0.6756035959798288,
                (-0.17560359597982883),
                (-0.17560359597982883),
                0.6756035959798288,
            ],
            extrapolation: &[],
            polynomial: ::core::option::Option::None,
        };
        const MOMENTA: emitted::HalfTableau = emitted::HalfTableau {
            count: 4,
            columns: &[
                &[
                    0.6756035959798288,
                    0.6756035959798288,
                    0.6756035959798288,
                    0.6756035959798288,
                ],
                &[
                    0.0,
                    (-0.17560359597982883),
                    (-0.17560359597982883),
                    (-0.17560359597982883),
                ],
                &[0.0, 0.0, (-0.17560359597982883), (-0.17560359597982883)],
                &[0.0, 0.0, 0.0, 0.6756035959798288],
            ],
            times: &[0.6756035959798288, 0.5, 0.32439640402017117, 1.0],
            weights: &[
                1.3512071919596575,
                (-1.7024143839193153),
                1.3512071919596575,
                0.0,
            ],
            extrapolation: &[],
            polynomial: ::core::option::Option::None,
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
    pub struct ForestRuthSeparable;
    #[allow(unused_variables)]
    impl emitted::SplittingPlan for ForestRuthSeparable {
        type Class = emitted::Separable;
        const EVALUATIONS: u32 = 7;
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
            step.kick(emitted::rounded(0.6756035959798288, 4.21370887772588e-17));
            step.drift(
                1,
                emitted::rounded(0.6756035959798288, 4.21370887772588e-17),
                emitted::rounded(1.3512071919596575, 8.42741775545176e-17),
            );
            step.force(2, emitted::rounded(1.3512071919596575, 8.42741775545176e-17));
            step.kick(emitted::rounded((-0.17560359597982883), 1.337406245399903e-17));
            step.drift(
                2,
                emitted::exact(0.5),
                emitted::rounded((-1.7024143839193153), 5.349624981599612e-17),
            );
            step.force(
                3,
                emitted::rounded((-0.35120719195965766), 2.674812490799806e-17),
            );
            step.kick(emitted::rounded((-0.17560359597982883), 1.337406245399903e-17));
            step.drift(
                3,
                emitted::rounded(0.32439640402017117, 1.337406245399903e-17),
                emitted::rounded(1.3512071919596575, 8.42741775545176e-17),
            );
            step.force(4, emitted::exact(1.0));
            step.kick(emitted::rounded(0.6756035959798288, 4.21370887772588e-17));
        }
    }
};
