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
    impl ::symplectic::emitted::Method for ForestRuth {
        const NAME: &'static str = "ForestRuth";
        const STAGES: usize = 4;
        const DEFINITION: &'static str = "kick: [-1/(2*(cbrt(2) - 2)), (cbrt(2) - 1)/(2*(cbrt(2) - 2))], drift: [-1/(cbrt(2) - 2), cbrt(2)/(cbrt(2) - 2)], symmetric: true";
        const COEFFICIENTS: ::symplectic::emitted::Coefficients = {
            const A: &[&[::symplectic::emitted::Coefficient]] = &[
                &[
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::emitted::Coefficient::new(
                        1.3512071919596575,
                        8.42741775545176e-17,
                        1.3512071,
                    ),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::emitted::Coefficient::new(
                        1.3512071919596575,
                        8.42741775545176e-17,
                        1.3512071,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        (-1.7024143839193153),
                        5.349624981599612e-17,
                        (-1.7024144),
                    ),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::emitted::Coefficient::new(
                        1.3512071919596575,
                        8.42741775545176e-17,
                        1.3512071,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        (-1.7024143839193153),
                        5.349624981599612e-17,
                        (-1.7024144),
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        1.3512071919596575,
                        8.42741775545176e-17,
                        1.3512071,
                    ),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                ],
            ];
            const B: &[::symplectic::emitted::Coefficient] = &[
                ::symplectic::emitted::Coefficient::new(
                    1.3512071919596575,
                    8.42741775545176e-17,
                    1.3512071,
                ),
                ::symplectic::emitted::Coefficient::new(
                    (-1.7024143839193153),
                    5.349624981599612e-17,
                    (-1.7024144),
                ),
                ::symplectic::emitted::Coefficient::new(
                    1.3512071919596575,
                    8.42741775545176e-17,
                    1.3512071,
                ),
                ::symplectic::emitted::Coefficient::exact(0.0),
            ];
            const C: &[::symplectic::emitted::Coefficient] = &[
                ::symplectic::emitted::Coefficient::exact(0.0),
                ::symplectic::emitted::Coefficient::new(
                    1.3512071919596575,
                    8.42741775545176e-17,
                    1.3512071,
                ),
                ::symplectic::emitted::Coefficient::new(
                    (-0.35120719195965766),
                    2.674812490799806e-17,
                    (-0.3512072),
                ),
                ::symplectic::emitted::Coefficient::exact(1.0),
            ];
            const A_TILDE: &[&[::symplectic::emitted::Coefficient]] = &[
                &[
                    ::symplectic::emitted::Coefficient::new(
                        0.6756035959798288,
                        4.21370887772588e-17,
                        0.67560357,
                    ),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::emitted::Coefficient::new(
                        0.6756035959798288,
                        4.21370887772588e-17,
                        0.67560357,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        (-0.17560359597982883),
                        1.337406245399903e-17,
                        (-0.1756036),
                    ),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::emitted::Coefficient::new(
                        0.6756035959798288,
                        4.21370887772588e-17,
                        0.67560357,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        (-0.17560359597982883),
                        1.337406245399903e-17,
                        (-0.1756036),
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        (-0.17560359597982883),
                        1.337406245399903e-17,
                        (-0.1756036),
                    ),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::emitted::Coefficient::new(
                        0.6756035959798288,
                        4.21370887772588e-17,
                        0.67560357,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        (-0.17560359597982883),
                        1.337406245399903e-17,
                        (-0.1756036),
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        (-0.17560359597982883),
                        1.337406245399903e-17,
                        (-0.1756036),
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        0.6756035959798288,
                        4.21370887772588e-17,
                        0.67560357,
                    ),
                ],
            ];
            const C_TILDE: &[::symplectic::emitted::Coefficient] = &[
                ::symplectic::emitted::Coefficient::new(
                    0.6756035959798288,
                    4.21370887772588e-17,
                    0.67560357,
                ),
                ::symplectic::emitted::Coefficient::exact(0.5),
                ::symplectic::emitted::Coefficient::new(
                    0.32439640402017117,
                    1.337406245399903e-17,
                    0.3243964,
                ),
                ::symplectic::emitted::Coefficient::exact(1.0),
            ];
            const B_TILDE: &[::symplectic::emitted::Coefficient] = &[
                ::symplectic::emitted::Coefficient::new(
                    0.6756035959798288,
                    4.21370887772588e-17,
                    0.67560357,
                ),
                ::symplectic::emitted::Coefficient::new(
                    (-0.17560359597982883),
                    1.337406245399903e-17,
                    (-0.1756036),
                ),
                ::symplectic::emitted::Coefficient::new(
                    (-0.17560359597982883),
                    1.337406245399903e-17,
                    (-0.1756036),
                ),
                ::symplectic::emitted::Coefficient::new(
                    0.6756035959798288,
                    4.21370887772588e-17,
                    0.67560357,
                ),
            ];
            ::symplectic::emitted::Coefficients {
                a: A,
                a_tilde: A_TILDE,
                b: B,
                b_tilde: B_TILDE,
                c: C,
                c_tilde: C_TILDE,
            }
        };
        const ORDERS: ::symplectic::emitted::Orders = ::symplectic::emitted::Orders {
            general: 1,
            separable: 4,
            nystrom: 4,
        };
        const SYMMETRY: ::symplectic::emitted::Symmetry = ::symplectic::emitted::Symmetry {
            general: false,
            separable: true,
        };
        type General = ::symplectic::emitted::Coupled<ForestRuthGeneral>;
        type Separable = ::symplectic::emitted::Splitting<ForestRuthSeparable>;
    }
    impl ::symplectic::emitted::ProvedFor<::symplectic::emitted::Separable>
    for ForestRuth {}
    impl ::symplectic::emitted::ProvedFor<()> for ForestRuth {}
    impl ::symplectic::emitted::ProvedFor<::symplectic::emitted::Damped> for ForestRuth {}
    pub struct ForestRuthGeneral;
    #[allow(unused_variables)]
    impl ::symplectic::emitted::StagePlan for ForestRuthGeneral {
        type Class = ::symplectic::emitted::General;
        type Stages<V: ::symplectic::emitted::Vector> = ::symplectic::emitted::Stages<
            V,
            4,
            4,
        >;
        const EVALUATIONS: ::symplectic::emitted::EvaluationCounts = ::symplectic::emitted::EvaluationCounts {
            begin: 0,
            start: 1,
            sweep: 7,
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
            ::symplectic::emitted::copy(&mut p[1], step.p);
            ::symplectic::emitted::copy(&mut p[2], step.p);
            ::symplectic::emitted::copy(&mut p[3], step.p);
            system
                .velocity(
                    step
                        .at(
                            ::symplectic::emitted::Coefficient::new(
                                0.6756035959798288,
                                4.21370887772588e-17,
                                0.67560357,
                            ),
                        ),
                    step.q,
                    step.p,
                    &mut velocity[0],
                );
            ::symplectic::emitted::copy_to(velocity, 0, [1, 2]);
            ::symplectic::emitted::combine::<
                R,
                V,
                _,
            >(
                &mut q[1],
                step.q,
                step.q_low,
                ::symplectic::emitted::weights(
                    step.size,
                    [
                        ::symplectic::emitted::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
                    ],
                ),
                [&velocity[0]],
            );
            ::symplectic::emitted::combine::<
                R,
                V,
                _,
            >(
                &mut q[2],
                step.q,
                step.q_low,
                ::symplectic::emitted::weights(
                    step.size,
                    [
                        ::symplectic::emitted::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
                        ::symplectic::emitted::Coefficient::new(
                            (-1.7024143839193153),
                            5.349624981599612e-17,
                            (-1.7024144),
                        ),
                    ],
                ),
                [&velocity[0], &velocity[1]],
            );
            ::symplectic::emitted::combine::<
                R,
                V,
                _,
            >(
                &mut q[3],
                step.q,
                step.q_low,
                ::symplectic::emitted::weights(
                    step.size,
                    [
                        ::symplectic::emitted::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
                        ::symplectic::emitted::Coefficient::new(
                            (-1.7024143839193153),
                            5.349624981599612e-17,
                            (-1.7024144),
                        ),
                        ::symplectic::emitted::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
                    ],
                ),
                [&velocity[0], &velocity[1], &velocity[2]],
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
            system
                .force(
                    step.at(::symplectic::emitted::Coefficient::exact(0.0)),
                    step.q,
                    &p[0],
                    &mut force[0],
                );
            system
                .force(
                    step
                        .at(
                            ::symplectic::emitted::Coefficient::new(
                                1.3512071919596575,
                                8.42741775545176e-17,
                                1.3512071,
                            ),
                        ),
                    &q[1],
                    &p[1],
                    &mut force[1],
                );
            system
                .force(
                    step
                        .at(
                            ::symplectic::emitted::Coefficient::new(
                                (-0.35120719195965766),
                                2.674812490799806e-17,
                                (-0.3512072),
                            ),
                        ),
                    &q[2],
                    &p[2],
                    &mut force[2],
                );
            system
                .force(
                    step.at(::symplectic::emitted::Coefficient::exact(1.0)),
                    &q[3],
                    &p[3],
                    &mut force[3],
                );
            ::symplectic::emitted::relax::<
                R,
                V,
                _,
            >(
                &mut p[0],
                step.p,
                step.p_low,
                ::symplectic::emitted::weights(
                    step.size,
                    [
                        ::symplectic::emitted::Coefficient::new(
                            0.6756035959798288,
                            4.21370887772588e-17,
                            0.67560357,
                        ),
                    ],
                ),
                [&force[0]],
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
                ::symplectic::emitted::weights(
                    step.size,
                    [
                        ::symplectic::emitted::Coefficient::new(
                            0.6756035959798288,
                            4.21370887772588e-17,
                            0.67560357,
                        ),
                        ::symplectic::emitted::Coefficient::new(
                            (-0.17560359597982883),
                            1.337406245399903e-17,
                            (-0.1756036),
                        ),
                    ],
                ),
                [&force[0], &force[1]],
                &mut change.p,
            );
            ::symplectic::emitted::relax::<
                R,
                V,
                _,
            >(
                &mut p[2],
                step.p,
                step.p_low,
                ::symplectic::emitted::weights(
                    step.size,
                    [
                        ::symplectic::emitted::Coefficient::new(
                            0.6756035959798288,
                            4.21370887772588e-17,
                            0.67560357,
                        ),
                        ::symplectic::emitted::Coefficient::new(
                            (-0.17560359597982883),
                            1.337406245399903e-17,
                            (-0.1756036),
                        ),
                        ::symplectic::emitted::Coefficient::new(
                            (-0.17560359597982883),
                            1.337406245399903e-17,
                            (-0.1756036),
                        ),
                    ],
                ),
                [&force[0], &force[1], &force[2]],
                &mut change.p,
            );
            ::symplectic::emitted::relax::<
                R,
                V,
                _,
            >(
                &mut p[3],
                step.p,
                step.p_low,
                ::symplectic::emitted::weights(
                    step.size,
                    [
                        ::symplectic::emitted::Coefficient::new(
                            0.6756035959798288,
                            4.21370887772588e-17,
                            0.67560357,
                        ),
                        ::symplectic::emitted::Coefficient::new(
                            (-0.17560359597982883),
                            1.337406245399903e-17,
                            (-0.1756036),
                        ),
                        ::symplectic::emitted::Coefficient::new(
                            (-0.17560359597982883),
                            1.337406245399903e-17,
                            (-0.1756036),
                        ),
                        ::symplectic::emitted::Coefficient::new(
                            0.6756035959798288,
                            4.21370887772588e-17,
                            0.67560357,
                        ),
                    ],
                ),
                [&force[0], &force[1], &force[2], &force[3]],
                &mut change.p,
            );
            system
                .velocity(
                    step
                        .at(
                            ::symplectic::emitted::Coefficient::new(
                                0.6756035959798288,
                                4.21370887772588e-17,
                                0.67560357,
                            ),
                        ),
                    step.q,
                    &p[0],
                    &mut velocity[0],
                );
            system
                .velocity(
                    step.at(::symplectic::emitted::Coefficient::exact(0.5)),
                    &q[1],
                    &p[1],
                    &mut velocity[1],
                );
            system
                .velocity(
                    step
                        .at(
                            ::symplectic::emitted::Coefficient::new(
                                0.32439640402017117,
                                1.337406245399903e-17,
                                0.3243964,
                            ),
                        ),
                    &q[2],
                    &p[2],
                    &mut velocity[2],
                );
            ::symplectic::emitted::relax::<
                R,
                V,
                _,
            >(
                &mut q[1],
                step.q,
                step.q_low,
                ::symplectic::emitted::weights(
                    step.size,
                    [
                        ::symplectic::emitted::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
                    ],
                ),
                [&velocity[0]],
                &mut change.q,
            );
            ::symplectic::emitted::relax::<
                R,
                V,
                _,
            >(
                &mut q[2],
                step.q,
                step.q_low,
                ::symplectic::emitted::weights(
                    step.size,
                    [
                        ::symplectic::emitted::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
                        ::symplectic::emitted::Coefficient::new(
                            (-1.7024143839193153),
                            5.349624981599612e-17,
                            (-1.7024144),
                        ),
                    ],
                ),
                [&velocity[0], &velocity[1]],
                &mut change.q,
            );
            ::symplectic::emitted::relax::<
                R,
                V,
                _,
            >(
                &mut q[3],
                step.q,
                step.q_low,
                ::symplectic::emitted::weights(
                    step.size,
                    [
                        ::symplectic::emitted::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
                        ::symplectic::emitted::Coefficient::new(
                            (-1.7024143839193153),
                            5.349624981599612e-17,
                            (-1.7024144),
                        ),
                        ::symplectic::emitted::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
                    ],
                ),
                [&velocity[0], &velocity[1], &velocity[2]],
                &mut change.q,
            );
            change
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
                .velocity(
                    step.at(::symplectic::emitted::Coefficient::exact(1.0)),
                    &q[3],
                    &p[3],
                    &mut velocity[3],
                );
            ::symplectic::emitted::weighted_total::<
                R,
                V,
                _,
            >(
                q1,
                q1_low,
                step.q,
                step.q_low,
                ::symplectic::emitted::weights(
                    step.size,
                    [
                        ::symplectic::emitted::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
                        ::symplectic::emitted::Coefficient::new(
                            (-1.7024143839193153),
                            5.349624981599612e-17,
                            (-1.7024144),
                        ),
                        ::symplectic::emitted::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
                    ],
                ),
                [&velocity[0], &velocity[1], &velocity[2]],
            );
            ::symplectic::emitted::weighted_total::<
                R,
                V,
                _,
            >(
                p1,
                p1_low,
                step.p,
                step.p_low,
                ::symplectic::emitted::weights(
                    step.size,
                    [
                        ::symplectic::emitted::Coefficient::new(
                            0.6756035959798288,
                            4.21370887772588e-17,
                            0.67560357,
                        ),
                        ::symplectic::emitted::Coefficient::new(
                            (-0.17560359597982883),
                            1.337406245399903e-17,
                            (-0.1756036),
                        ),
                        ::symplectic::emitted::Coefficient::new(
                            (-0.17560359597982883),
                            1.337406245399903e-17,
                            (-0.1756036),
                        ),
                        ::symplectic::emitted::Coefficient::new(
                            0.6756035959798288,
                            4.21370887772588e-17,
                            0.67560357,
                        ),
                    ],
                ),
                [&force[0], &force[1], &force[2], &force[3]],
            );
        }
    }
    impl ::symplectic::emitted::StageTableau for ForestRuthGeneral {
        type Lanes = ::symplectic::emitted::F64x4;
        type Groups<T: ::core::fmt::Debug> = [T; 1];
        const INCREMENTS: bool = false;
        const POSITIONS: ::symplectic::emitted::HalfTableau = ::symplectic::emitted::HalfTableau {
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
        const MOMENTA: ::symplectic::emitted::HalfTableau = ::symplectic::emitted::HalfTableau {
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
    pub struct ForestRuthSeparable;
    #[allow(unused_variables)]
    impl ::symplectic::emitted::SplittingPlan for ForestRuthSeparable {
        type Class = ::symplectic::emitted::Separable;
        const EVALUATIONS: u32 = 7;
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
                    ::symplectic::emitted::Coefficient::new(
                        0.6756035959798288,
                        4.21370887772588e-17,
                        0.67560357,
                    ),
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
                        time: ::symplectic::emitted::Coefficient::new(
                            0.6756035959798288,
                            4.21370887772588e-17,
                            0.67560357,
                        ),
                        weight: ::symplectic::emitted::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
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
                        time: ::symplectic::emitted::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
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
                    ::symplectic::emitted::Coefficient::new(
                        (-0.17560359597982883),
                        1.337406245399903e-17,
                        (-0.1756036),
                    ),
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
                        stage: 2,
                        time: ::symplectic::emitted::Coefficient::exact(0.5),
                        weight: ::symplectic::emitted::Coefficient::new(
                            (-1.7024143839193153),
                            5.349624981599612e-17,
                            (-1.7024144),
                        ),
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
                        stage: 3,
                        time: ::symplectic::emitted::Coefficient::new(
                            (-0.35120719195965766),
                            2.674812490799806e-17,
                            (-0.3512072),
                        ),
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
                    ::symplectic::emitted::Coefficient::new(
                        (-0.17560359597982883),
                        1.337406245399903e-17,
                        (-0.1756036),
                    ),
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
                        stage: 3,
                        time: ::symplectic::emitted::Coefficient::new(
                            0.32439640402017117,
                            1.337406245399903e-17,
                            0.3243964,
                        ),
                        weight: ::symplectic::emitted::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
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
                        stage: 4,
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
                    ::symplectic::emitted::Coefficient::new(
                        0.6756035959798288,
                        4.21370887772588e-17,
                        0.67560357,
                    ),
                    system,
                    &mut *force,
                    &mut *q,
                    (&mut *p, &mut *p_low),
                );
        }
    }
};
