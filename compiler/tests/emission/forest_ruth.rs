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
    impl ::symplectic::Method for ForestRuth {
        const NAME: &'static str = "ForestRuth";
        const STAGES: usize = 4;
        const DEFINITION: &'static str = "kick: [-1/(2*(cbrt(2) - 2)), (cbrt(2) - 1)/(2*(cbrt(2) - 2))], drift: [-1/(cbrt(2) - 2), cbrt(2)/(cbrt(2) - 2)], symmetric: true";
        const COEFFICIENTS: ::symplectic::Coefficients = {
            const A: &[&[::symplectic::Coefficient]] = &[
                &[
                    ::symplectic::Coefficient::exact(0.0),
                    ::symplectic::Coefficient::exact(0.0),
                    ::symplectic::Coefficient::exact(0.0),
                    ::symplectic::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::Coefficient::new(
                        1.3512071919596575,
                        8.42741775545176e-17,
                        1.3512071,
                    ),
                    ::symplectic::Coefficient::exact(0.0),
                    ::symplectic::Coefficient::exact(0.0),
                    ::symplectic::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::Coefficient::new(
                        1.3512071919596575,
                        8.42741775545176e-17,
                        1.3512071,
                    ),
                    ::symplectic::Coefficient::new(
                        (-1.7024143839193153),
                        5.349624981599612e-17,
                        (-1.7024144),
                    ),
                    ::symplectic::Coefficient::exact(0.0),
                    ::symplectic::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::Coefficient::new(
                        1.3512071919596575,
                        8.42741775545176e-17,
                        1.3512071,
                    ),
                    ::symplectic::Coefficient::new(
                        (-1.7024143839193153),
                        5.349624981599612e-17,
                        (-1.7024144),
                    ),
                    ::symplectic::Coefficient::new(
                        1.3512071919596575,
                        8.42741775545176e-17,
                        1.3512071,
                    ),
                    ::symplectic::Coefficient::exact(0.0),
                ],
            ];
            const B: &[::symplectic::Coefficient] = &[
                ::symplectic::Coefficient::new(
                    1.3512071919596575,
                    8.42741775545176e-17,
                    1.3512071,
                ),
                ::symplectic::Coefficient::new(
                    (-1.7024143839193153),
                    5.349624981599612e-17,
                    (-1.7024144),
                ),
                ::symplectic::Coefficient::new(
                    1.3512071919596575,
                    8.42741775545176e-17,
                    1.3512071,
                ),
                ::symplectic::Coefficient::exact(0.0),
            ];
            const C: &[::symplectic::Coefficient] = &[
                ::symplectic::Coefficient::exact(0.0),
                ::symplectic::Coefficient::new(
                    1.3512071919596575,
                    8.42741775545176e-17,
                    1.3512071,
                ),
                ::symplectic::Coefficient::new(
                    (-0.35120719195965766),
                    2.674812490799806e-17,
                    (-0.3512072),
                ),
                ::symplectic::Coefficient::exact(1.0),
            ];
            const A_TILDE: &[&[::symplectic::Coefficient]] = &[
                &[
                    ::symplectic::Coefficient::new(
                        0.6756035959798288,
                        4.21370887772588e-17,
                        0.67560357,
                    ),
                    ::symplectic::Coefficient::exact(0.0),
                    ::symplectic::Coefficient::exact(0.0),
                    ::symplectic::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::Coefficient::new(
                        0.6756035959798288,
                        4.21370887772588e-17,
                        0.67560357,
                    ),
                    ::symplectic::Coefficient::new(
                        (-0.17560359597982883),
                        1.337406245399903e-17,
                        (-0.1756036),
                    ),
                    ::symplectic::Coefficient::exact(0.0),
                    ::symplectic::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::Coefficient::new(
                        0.6756035959798288,
                        4.21370887772588e-17,
                        0.67560357,
                    ),
                    ::symplectic::Coefficient::new(
                        (-0.17560359597982883),
                        1.337406245399903e-17,
                        (-0.1756036),
                    ),
                    ::symplectic::Coefficient::new(
                        (-0.17560359597982883),
                        1.337406245399903e-17,
                        (-0.1756036),
                    ),
                    ::symplectic::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::Coefficient::new(
                        0.6756035959798288,
                        4.21370887772588e-17,
                        0.67560357,
                    ),
                    ::symplectic::Coefficient::new(
                        (-0.17560359597982883),
                        1.337406245399903e-17,
                        (-0.1756036),
                    ),
                    ::symplectic::Coefficient::new(
                        (-0.17560359597982883),
                        1.337406245399903e-17,
                        (-0.1756036),
                    ),
                    ::symplectic::Coefficient::new(
                        0.6756035959798288,
                        4.21370887772588e-17,
                        0.67560357,
                    ),
                ],
            ];
            const C_TILDE: &[::symplectic::Coefficient] = &[
                ::symplectic::Coefficient::new(
                    0.6756035959798288,
                    4.21370887772588e-17,
                    0.67560357,
                ),
                ::symplectic::Coefficient::exact(0.5),
                ::symplectic::Coefficient::new(
                    0.32439640402017117,
                    1.337406245399903e-17,
                    0.3243964,
                ),
                ::symplectic::Coefficient::exact(1.0),
            ];
            const B_TILDE: &[::symplectic::Coefficient] = &[
                ::symplectic::Coefficient::new(
                    0.6756035959798288,
                    4.21370887772588e-17,
                    0.67560357,
                ),
                ::symplectic::Coefficient::new(
                    (-0.17560359597982883),
                    1.337406245399903e-17,
                    (-0.1756036),
                ),
                ::symplectic::Coefficient::new(
                    (-0.17560359597982883),
                    1.337406245399903e-17,
                    (-0.1756036),
                ),
                ::symplectic::Coefficient::new(
                    0.6756035959798288,
                    4.21370887772588e-17,
                    0.67560357,
                ),
            ];
            ::symplectic::Coefficients {
                a: A,
                a_tilde: A_TILDE,
                b: B,
                b_tilde: B_TILDE,
                c: C,
                c_tilde: C_TILDE,
            }
        };
        const ORDERS: ::symplectic::Orders = ::symplectic::Orders {
            general: 1,
            separable: 4,
            nystrom: 4,
        };
        type General = ::symplectic::Coupled<ForestRuthGeneral>;
        type Separable = ::symplectic::Splitting<ForestRuthSeparable>;
    }
    impl ::symplectic::ProvedFor<::symplectic::Separable> for ForestRuth {}
    impl ::symplectic::ProvedFor<()> for ForestRuth {}
    pub struct ForestRuthGeneral;
    #[allow(unused_variables)]
    impl ::symplectic::StagePlan for ForestRuthGeneral {
        type Class = ::symplectic::General;
        type Stages<V: ::symplectic::Vector> = ::symplectic::Stages<V, 4, 4>;
        const EVALUATIONS: ::symplectic::EvaluationCounts = ::symplectic::EvaluationCounts {
            begin: 0,
            start: 1,
            sweep: 7,
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
            ::symplectic::copy(&mut p[1], step.p);
            ::symplectic::copy(&mut p[2], step.p);
            ::symplectic::copy(&mut p[3], step.p);
            system
                .velocity(
                    step
                        .at(
                            ::symplectic::Coefficient::new(
                                0.6756035959798288,
                                4.21370887772588e-17,
                                0.67560357,
                            ),
                        ),
                    step.q,
                    step.p,
                    &mut velocity[0],
                );
            ::symplectic::copy_to(velocity, 0, [1, 2]);
            ::symplectic::combine::<
                R,
                V,
                _,
            >(
                &mut q[1],
                step.q,
                step.q_low,
                ::symplectic::weights(
                    step.size,
                    [
                        ::symplectic::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
                    ],
                ),
                [&velocity[0]],
            );
            ::symplectic::combine::<
                R,
                V,
                _,
            >(
                &mut q[2],
                step.q,
                step.q_low,
                ::symplectic::weights(
                    step.size,
                    [
                        ::symplectic::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
                        ::symplectic::Coefficient::new(
                            (-1.7024143839193153),
                            5.349624981599612e-17,
                            (-1.7024144),
                        ),
                    ],
                ),
                [&velocity[0], &velocity[1]],
            );
            ::symplectic::combine::<
                R,
                V,
                _,
            >(
                &mut q[3],
                step.q,
                step.q_low,
                ::symplectic::weights(
                    step.size,
                    [
                        ::symplectic::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
                        ::symplectic::Coefficient::new(
                            (-1.7024143839193153),
                            5.349624981599612e-17,
                            (-1.7024144),
                        ),
                        ::symplectic::Coefficient::new(
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
            system
                .force(
                    step.at(::symplectic::Coefficient::exact(0.0)),
                    step.q,
                    &p[0],
                    &mut force[0],
                );
            system
                .force(
                    step
                        .at(
                            ::symplectic::Coefficient::new(
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
                            ::symplectic::Coefficient::new(
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
                    step.at(::symplectic::Coefficient::exact(1.0)),
                    &q[3],
                    &p[3],
                    &mut force[3],
                );
            ::symplectic::relax::<
                R,
                V,
                _,
            >(
                &mut p[0],
                step.p,
                step.p_low,
                ::symplectic::weights(
                    step.size,
                    [
                        ::symplectic::Coefficient::new(
                            0.6756035959798288,
                            4.21370887772588e-17,
                            0.67560357,
                        ),
                    ],
                ),
                [&force[0]],
                &mut change.p,
            );
            ::symplectic::relax::<
                R,
                V,
                _,
            >(
                &mut p[1],
                step.p,
                step.p_low,
                ::symplectic::weights(
                    step.size,
                    [
                        ::symplectic::Coefficient::new(
                            0.6756035959798288,
                            4.21370887772588e-17,
                            0.67560357,
                        ),
                        ::symplectic::Coefficient::new(
                            (-0.17560359597982883),
                            1.337406245399903e-17,
                            (-0.1756036),
                        ),
                    ],
                ),
                [&force[0], &force[1]],
                &mut change.p,
            );
            ::symplectic::relax::<
                R,
                V,
                _,
            >(
                &mut p[2],
                step.p,
                step.p_low,
                ::symplectic::weights(
                    step.size,
                    [
                        ::symplectic::Coefficient::new(
                            0.6756035959798288,
                            4.21370887772588e-17,
                            0.67560357,
                        ),
                        ::symplectic::Coefficient::new(
                            (-0.17560359597982883),
                            1.337406245399903e-17,
                            (-0.1756036),
                        ),
                        ::symplectic::Coefficient::new(
                            (-0.17560359597982883),
                            1.337406245399903e-17,
                            (-0.1756036),
                        ),
                    ],
                ),
                [&force[0], &force[1], &force[2]],
                &mut change.p,
            );
            ::symplectic::relax::<
                R,
                V,
                _,
            >(
                &mut p[3],
                step.p,
                step.p_low,
                ::symplectic::weights(
                    step.size,
                    [
                        ::symplectic::Coefficient::new(
                            0.6756035959798288,
                            4.21370887772588e-17,
                            0.67560357,
                        ),
                        ::symplectic::Coefficient::new(
                            (-0.17560359597982883),
                            1.337406245399903e-17,
                            (-0.1756036),
                        ),
                        ::symplectic::Coefficient::new(
                            (-0.17560359597982883),
                            1.337406245399903e-17,
                            (-0.1756036),
                        ),
                        ::symplectic::Coefficient::new(
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
                            ::symplectic::Coefficient::new(
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
                    step.at(::symplectic::Coefficient::exact(0.5)),
                    &q[1],
                    &p[1],
                    &mut velocity[1],
                );
            system
                .velocity(
                    step
                        .at(
                            ::symplectic::Coefficient::new(
                                0.32439640402017117,
                                1.337406245399903e-17,
                                0.3243964,
                            ),
                        ),
                    &q[2],
                    &p[2],
                    &mut velocity[2],
                );
            ::symplectic::relax::<
                R,
                V,
                _,
            >(
                &mut q[1],
                step.q,
                step.q_low,
                ::symplectic::weights(
                    step.size,
                    [
                        ::symplectic::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
                    ],
                ),
                [&velocity[0]],
                &mut change.q,
            );
            ::symplectic::relax::<
                R,
                V,
                _,
            >(
                &mut q[2],
                step.q,
                step.q_low,
                ::symplectic::weights(
                    step.size,
                    [
                        ::symplectic::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
                        ::symplectic::Coefficient::new(
                            (-1.7024143839193153),
                            5.349624981599612e-17,
                            (-1.7024144),
                        ),
                    ],
                ),
                [&velocity[0], &velocity[1]],
                &mut change.q,
            );
            ::symplectic::relax::<
                R,
                V,
                _,
            >(
                &mut q[3],
                step.q,
                step.q_low,
                ::symplectic::weights(
                    step.size,
                    [
                        ::symplectic::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
                        ::symplectic::Coefficient::new(
                            (-1.7024143839193153),
                            5.349624981599612e-17,
                            (-1.7024144),
                        ),
                        ::symplectic::Coefficient::new(
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
                .velocity(
                    step.at(::symplectic::Coefficient::exact(1.0)),
                    &q[3],
                    &p[3],
                    &mut velocity[3],
                );
            ::symplectic::weighted_total::<
                R,
                V,
                _,
            >(
                q1,
                q1_low,
                step.q,
                step.q_low,
                ::symplectic::weights(
                    step.size,
                    [
                        ::symplectic::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
                        ::symplectic::Coefficient::new(
                            (-1.7024143839193153),
                            5.349624981599612e-17,
                            (-1.7024144),
                        ),
                        ::symplectic::Coefficient::new(
                            1.3512071919596575,
                            8.42741775545176e-17,
                            1.3512071,
                        ),
                    ],
                ),
                [&velocity[0], &velocity[1], &velocity[2]],
            );
            ::symplectic::weighted_total::<
                R,
                V,
                _,
            >(
                p1,
                p1_low,
                step.p,
                step.p_low,
                ::symplectic::weights(
                    step.size,
                    [
                        ::symplectic::Coefficient::new(
                            0.6756035959798288,
                            4.21370887772588e-17,
                            0.67560357,
                        ),
                        ::symplectic::Coefficient::new(
                            (-0.17560359597982883),
                            1.337406245399903e-17,
                            (-0.1756036),
                        ),
                        ::symplectic::Coefficient::new(
                            (-0.17560359597982883),
                            1.337406245399903e-17,
                            (-0.1756036),
                        ),
                        ::symplectic::Coefficient::new(
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
    impl ::symplectic::StageTableau for ForestRuthGeneral {
        type Lanes = ::symplectic::F64x4;
        type Groups<T: ::core::fmt::Debug> = [T; 1];
        const INCREMENTS: bool = false;
        const POSITIONS: ::symplectic::HalfTableau = ::symplectic::HalfTableau {
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
        const MOMENTA: ::symplectic::HalfTableau = ::symplectic::HalfTableau {
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
    pub struct ForestRuthSeparable;
    #[allow(unused_variables)]
    impl ::symplectic::SplittingPlan for ForestRuthSeparable {
        type Class = ::symplectic::Separable;
        const EVALUATIONS: u32 = 7;
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
                    ::symplectic::Coefficient::new(
                        0.6756035959798288,
                        4.21370887772588e-17,
                        0.67560357,
                    ),
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
                        time: ::symplectic::Coefficient::new(
                            0.6756035959798288,
                            4.21370887772588e-17,
                            0.67560357,
                        ),
                        weight: ::symplectic::Coefficient::new(
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
                        time: ::symplectic::Coefficient::new(
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
            moves
                .kick::<
                    R,
                    V,
                    S,
                >(
                    span.size,
                    ::symplectic::Coefficient::new(
                        (-0.17560359597982883),
                        1.337406245399903e-17,
                        (-0.1756036),
                    ),
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
                        stage: 2,
                        time: ::symplectic::Coefficient::exact(0.5),
                        weight: ::symplectic::Coefficient::new(
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
            moves
                .force::<
                    R,
                    V,
                    S,
                    W,
                >(
                    ::symplectic::Force {
                        span,
                        stage: 3,
                        time: ::symplectic::Coefficient::new(
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
            moves
                .kick::<
                    R,
                    V,
                    S,
                >(
                    span.size,
                    ::symplectic::Coefficient::new(
                        (-0.17560359597982883),
                        1.337406245399903e-17,
                        (-0.1756036),
                    ),
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
                        stage: 3,
                        time: ::symplectic::Coefficient::new(
                            0.32439640402017117,
                            1.337406245399903e-17,
                            0.3243964,
                        ),
                        weight: ::symplectic::Coefficient::new(
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
            moves
                .force::<
                    R,
                    V,
                    S,
                    W,
                >(
                    ::symplectic::Force {
                        span,
                        stage: 4,
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
                    ::symplectic::Coefficient::new(
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
