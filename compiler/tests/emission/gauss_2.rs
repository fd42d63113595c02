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
    impl ::symplectic::Method for Gauss2 {
        const NAME: &'static str = "Gauss2";
        const STAGES: usize = 2;
        const DEFINITION: &'static str = "basis: polynomial(2), nodes: gauss(2)";
        const COEFFICIENTS: ::symplectic::Coefficients = {
            const A: &[&[::symplectic::Coefficient]] = &[
                &[
                    ::symplectic::Coefficient::exact(0.25),
                    ::symplectic::Coefficient::new(
                        (-0.03867513459481288),
                        (-2.8473525618637145e-18),
                        (-0.038675133),
                    ),
                ],
                &[
                    ::symplectic::Coefficient::new(
                        0.5386751345948129,
                        1.6725140369678172e-17,
                        0.5386751,
                    ),
                    ::symplectic::Coefficient::exact(0.25),
                ],
            ];
            const B: &[::symplectic::Coefficient] = &[
                ::symplectic::Coefficient::exact(0.5),
                ::symplectic::Coefficient::exact(0.5),
            ];
            const C: &[::symplectic::Coefficient] = &[
                ::symplectic::Coefficient::new(
                    0.2113248654051871,
                    1.1030435245950743e-17,
                    0.21132487,
                ),
                ::symplectic::Coefficient::new(
                    0.7886751345948129,
                    1.6725140369678172e-17,
                    0.7886751,
                ),
            ];
            ::symplectic::Coefficients {
                a: A,
                a_tilde: A,
                b: B,
                b_tilde: B,
                c: C,
                c_tilde: C,
            }
        };
        type General = Gauss2General;
        type Separable = Gauss2Separable;
    }
    pub struct Gauss2General;
    #[allow(unused_variables)]
    impl ::symplectic::Plan for Gauss2General {
        type Class = ::symplectic::General;
        type Coupling = ::symplectic::Coupled;
        type Stages<V: ::symplectic::Vector> = ::symplectic::Stages<V, 2, 2>;
        #[inline]
        fn begin<
            V: ::symplectic::Vector,
            S: ::symplectic::Hamiltonian<V, Class = Self::Class>,
        >(
            step: &::symplectic::Step<'_, V>,
            system: &S,
            stages: &mut Self::Stages<V>,
            carried: bool,
        ) {
            let ::symplectic::Stages { q, p, velocity, force } = stages;
            ::symplectic::combine(&mut q[0], step.q, step.size, [], []);
            ::symplectic::combine(&mut q[1], step.q, step.size, [], []);
            ::symplectic::combine(&mut p[0], step.p, step.size, [], []);
            ::symplectic::combine(&mut p[1], step.p, step.size, [], []);
            system
                .velocity(
                    step
                        .at(
                            ::symplectic::Coefficient::new(
                                0.2113248654051871,
                                1.1030435245950743e-17,
                                0.21132487,
                            ),
                        ),
                    step.q,
                    step.p,
                    &mut velocity[0],
                );
            ::symplectic::copy_to(velocity, 0, [1]);
        }
        #[inline]
        fn sweep<
            V: ::symplectic::Vector,
            S: ::symplectic::Hamiltonian<V, Class = Self::Class>,
        >(
            step: &::symplectic::Step<'_, V>,
            system: &S,
            stages: &mut Self::Stages<V>,
        ) -> ::symplectic::Change {
            let ::symplectic::Stages { q, p, velocity, force } = stages;
            let mut change = ::symplectic::Change::default();
            ::symplectic::relax(
                &mut q[0],
                step.q,
                step.size,
                [
                    ::symplectic::Coefficient::exact(0.25),
                    ::symplectic::Coefficient::new(
                        (-0.03867513459481288),
                        (-2.8473525618637145e-18),
                        (-0.038675133),
                    ),
                ],
                [&velocity[0], &velocity[1]],
                &mut change.q,
            );
            ::symplectic::relax(
                &mut q[1],
                step.q,
                step.size,
                [
                    ::symplectic::Coefficient::new(
                        0.5386751345948129,
                        1.6725140369678172e-17,
                        0.5386751,
                    ),
                    ::symplectic::Coefficient::exact(0.25),
                ],
                [&velocity[0], &velocity[1]],
                &mut change.q,
            );
            system
                .force(
                    step
                        .at(
                            ::symplectic::Coefficient::new(
                                0.2113248654051871,
                                1.1030435245950743e-17,
                                0.21132487,
                            ),
                        ),
                    &q[0],
                    &p[0],
                    &mut force[0],
                );
            system
                .force(
                    step
                        .at(
                            ::symplectic::Coefficient::new(
                                0.7886751345948129,
                                1.6725140369678172e-17,
                                0.7886751,
                            ),
                        ),
                    &q[1],
                    &p[1],
                    &mut force[1],
                );
            ::symplectic::relax(
                &mut p[0],
                step.p,
                step.size,
                [
                    ::symplectic::Coefficient::exact(0.25),
                    ::symplectic::Coefficient::new(
                        (-0.03867513459481288),
                        (-2.8473525618637145e-18),
                        (-0.038675133),
                    ),
                ],
                [&force[0], &force[1]],
                &mut change.p,
            );
            ::symplectic::relax(
                &mut p[1],
                step.p,
                step.size,
                [
                    ::symplectic::Coefficient::new(
                        0.5386751345948129,
                        1.6725140369678172e-17,
                        0.5386751,
                    ),
                    ::symplectic::Coefficient::exact(0.25),
                ],
                [&force[0], &force[1]],
                &mut change.p,
            );
            system
                .velocity(
                    step
                        .at(
                            ::symplectic::Coefficient::new(
                                0.2113248654051871,
                                1.1030435245950743e-17,
                                0.21132487,
                            ),
                        ),
                    &q[0],
                    &p[0],
                    &mut velocity[0],
                );
            system
                .velocity(
                    step
                        .at(
                            ::symplectic::Coefficient::new(
                                0.7886751345948129,
                                1.6725140369678172e-17,
                                0.7886751,
                            ),
                        ),
                    &q[1],
                    &p[1],
                    &mut velocity[1],
                );
            change
        }
        #[inline]
        fn finish<
            V: ::symplectic::Vector,
            S: ::symplectic::Hamiltonian<V, Class = Self::Class>,
        >(
            step: &::symplectic::Step<'_, V>,
            system: &S,
            stages: &mut Self::Stages<V>,
            q1: &mut V,
            p1: &mut V,
        ) {
            let ::symplectic::Stages { q, p, velocity, force } = stages;
            ::symplectic::combine(
                q1,
                step.q,
                step.size,
                [
                    ::symplectic::Coefficient::exact(0.5),
                    ::symplectic::Coefficient::exact(0.5),
                ],
                [&velocity[0], &velocity[1]],
            );
            ::symplectic::combine(
                p1,
                step.p,
                step.size,
                [
                    ::symplectic::Coefficient::exact(0.5),
                    ::symplectic::Coefficient::exact(0.5),
                ],
                [&force[0], &force[1]],
            );
        }
        #[inline]
        fn carry<V: ::symplectic::Vector>(stages: &mut Self::Stages<V>) -> bool {
            false
        }
    }
    pub struct Gauss2Separable;
    #[allow(unused_variables)]
    impl ::symplectic::Plan for Gauss2Separable {
        type Class = ::symplectic::Separable;
        type Coupling = ::symplectic::Coupled;
        type Stages<V: ::symplectic::Vector> = ::symplectic::Stages<V, 2, 2>;
        #[inline]
        fn begin<
            V: ::symplectic::Vector,
            S: ::symplectic::Hamiltonian<V, Class = Self::Class>,
        >(
            step: &::symplectic::Step<'_, V>,
            system: &S,
            stages: &mut Self::Stages<V>,
            carried: bool,
        ) {
            let ::symplectic::Stages { q, p, velocity, force } = stages;
            ::symplectic::combine(&mut q[0], step.q, step.size, [], []);
            ::symplectic::combine(&mut q[1], step.q, step.size, [], []);
            ::symplectic::combine(&mut p[0], step.p, step.size, [], []);
            ::symplectic::combine(&mut p[1], step.p, step.size, [], []);
            system
                .velocity(
                    step
                        .at(
                            ::symplectic::Coefficient::new(
                                0.2113248654051871,
                                1.1030435245950743e-17,
                                0.21132487,
                            ),
                        ),
                    step.q,
                    step.p,
                    &mut velocity[0],
                );
            ::symplectic::copy_to(velocity, 0, [1]);
        }
        #[inline]
        fn sweep<
            V: ::symplectic::Vector,
            S: ::symplectic::Hamiltonian<V, Class = Self::Class>,
        >(
            step: &::symplectic::Step<'_, V>,
            system: &S,
            stages: &mut Self::Stages<V>,
        ) -> ::symplectic::Change {
            let ::symplectic::Stages { q, p, velocity, force } = stages;
            let mut change = ::symplectic::Change::default();
            ::symplectic::relax(
                &mut q[0],
                step.q,
                step.size,
                [
                    ::symplectic::Coefficient::exact(0.25),
                    ::symplectic::Coefficient::new(
                        (-0.03867513459481288),
                        (-2.8473525618637145e-18),
                        (-0.038675133),
                    ),
                ],
                [&velocity[0], &velocity[1]],
                &mut change.q,
            );
            ::symplectic::relax(
                &mut q[1],
                step.q,
                step.size,
                [
                    ::symplectic::Coefficient::new(
                        0.5386751345948129,
                        1.6725140369678172e-17,
                        0.5386751,
                    ),
                    ::symplectic::Coefficient::exact(0.25),
                ],
                [&velocity[0], &velocity[1]],
                &mut change.q,
            );
            system
                .force(
                    step
                        .at(
                            ::symplectic::Coefficient::new(
                                0.2113248654051871,
                                1.1030435245950743e-17,
                                0.21132487,
                            ),
                        ),
                    &q[0],
                    step.p,
                    &mut force[0],
                );
            system
                .force(
                    step
                        .at(
                            ::symplectic::Coefficient::new(
                                0.7886751345948129,
                                1.6725140369678172e-17,
                                0.7886751,
                            ),
                        ),
                    &q[1],
                    step.p,
                    &mut force[1],
                );
            ::symplectic::relax(
                &mut p[0],
                step.p,
                step.size,
                [
                    ::symplectic::Coefficient::exact(0.25),
                    ::symplectic::Coefficient::new(
                        (-0.03867513459481288),
                        (-2.8473525618637145e-18),
                        (-0.038675133),
                    ),
                ],
                [&force[0], &force[1]],
                &mut change.p,
            );
            ::symplectic::relax(
                &mut p[1],
                step.p,
                step.size,
                [
                    ::symplectic::Coefficient::new(
                        0.5386751345948129,
                        1.6725140369678172e-17,
                        0.5386751,
                    ),
                    ::symplectic::Coefficient::exact(0.25),
                ],
                [&force[0], &force[1]],
                &mut change.p,
            );
            system
                .velocity(
                    step
                        .at(
                            ::symplectic::Coefficient::new(
                                0.2113248654051871,
                                1.1030435245950743e-17,
                                0.21132487,
                            ),
                        ),
                    step.q,
                    &p[0],
                    &mut velocity[0],
                );
            system
                .velocity(
                    step
                        .at(
                            ::symplectic::Coefficient::new(
                                0.7886751345948129,
                                1.6725140369678172e-17,
                                0.7886751,
                            ),
                        ),
                    step.q,
                    &p[1],
                    &mut velocity[1],
                );
            change
        }
        #[inline]
        fn finish<
            V: ::symplectic::Vector,
            S: ::symplectic::Hamiltonian<V, Class = Self::Class>,
        >(
            step: &::symplectic::Step<'_, V>,
            system: &S,
            stages: &mut Self::Stages<V>,
            q1: &mut V,
            p1: &mut V,
        ) {
            let ::symplectic::Stages { q, p, velocity, force } = stages;
            ::symplectic::combine(
                q1,
                step.q,
                step.size,
                [
                    ::symplectic::Coefficient::exact(0.5),
                    ::symplectic::Coefficient::exact(0.5),
                ],
                [&velocity[0], &velocity[1]],
            );
            ::symplectic::combine(
                p1,
                step.p,
                step.size,
                [
                    ::symplectic::Coefficient::exact(0.5),
                    ::symplectic::Coefficient::exact(0.5),
                ],
                [&force[0], &force[1]],
            );
        }
        #[inline]
        fn carry<V: ::symplectic::Vector>(stages: &mut Self::Stages<V>) -> bool {
            false
        }
    }
};
