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
    impl ::symplectic::emitted::Method for Lobatto3 {
        const NAME: &'static str = "Lobatto3";
        const STAGES: usize = 3;
        const DEFINITION: &'static str = "basis: polynomial(3), nodes: lobatto(3)";
        const COEFFICIENTS: ::symplectic::emitted::Coefficients = {
            const A: &[&[::symplectic::emitted::Coefficient]] = &[
                &[
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::emitted::Coefficient::new(
                        0.20833333333333334,
                        (-9.25185853854297e-18),
                        0.20833333,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        0.3333333333333333,
                        1.850371707708594e-17,
                        0.33333334,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        (-0.041666666666666664),
                        (-2.3129646346357427e-18),
                        (-0.041666668),
                    ),
                ],
                &[
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        0.6666666666666666,
                        3.700743415417188e-17,
                        0.6666667,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
                ],
            ];
            const B: &[::symplectic::emitted::Coefficient] = &[
                ::symplectic::emitted::Coefficient::new(
                    0.16666666666666666,
                    9.25185853854297e-18,
                    0.16666667,
                ),
                ::symplectic::emitted::Coefficient::new(
                    0.6666666666666666,
                    3.700743415417188e-17,
                    0.6666667,
                ),
                ::symplectic::emitted::Coefficient::new(
                    0.16666666666666666,
                    9.25185853854297e-18,
                    0.16666667,
                ),
            ];
            const C: &[::symplectic::emitted::Coefficient] = &[
                ::symplectic::emitted::Coefficient::exact(0.0),
                ::symplectic::emitted::Coefficient::exact(0.5),
                ::symplectic::emitted::Coefficient::exact(1.0),
            ];
            const A_TILDE: &[&[::symplectic::emitted::Coefficient]] = &[
                &[
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        (-0.16666666666666666),
                        (-9.25185853854297e-18),
                        (-0.16666667),
                    ),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        0.3333333333333333,
                        1.850371707708594e-17,
                        0.33333334,
                    ),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                ],
                &[
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        0.8333333333333334,
                        (-3.700743415417188e-17),
                        0.8333333,
                    ),
                    ::symplectic::emitted::Coefficient::exact(0.0),
                ],
            ];
            const C_TILDE: &[::symplectic::emitted::Coefficient] = &[
                ::symplectic::emitted::Coefficient::exact(0.0),
                ::symplectic::emitted::Coefficient::exact(0.5),
                ::symplectic::emitted::Coefficient::exact(1.0),
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
            general: 4,
            separable: 4,
            nystrom: 4,
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
                        ::symplectic::emitted::Coefficient::exact(0.0),
                    ],
                    &[
                        ::symplectic::emitted::Coefficient::exact(1.25),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                        ::symplectic::emitted::Coefficient::exact((-0.25)),
                    ],
                    &[
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(1.0),
                    ],
                ],
                momenta: &[
                    &[
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact((-0.25)),
                        ::symplectic::emitted::Coefficient::exact(0.0),
                    ],
                    &[
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                        ::symplectic::emitted::Coefficient::exact(0.0),
                    ],
                    &[
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(1.25),
                        ::symplectic::emitted::Coefficient::exact(0.0),
                    ],
                ],
                weights: &[
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        0.6666666666666666,
                        3.700743415417188e-17,
                        0.6666667,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
                ],
                nodes: &[
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(0.5),
                    ::symplectic::emitted::Coefficient::exact(1.0),
                ],
                momentum_nodes: &[
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(0.5),
                    ::symplectic::emitted::Coefficient::exact(1.0),
                ],
                multipliers: &[&[16.0, (-2.0)], &[(-8.0), 4.0]],
            };
            &[
                ::symplectic::emitted::ConstrainedStep::new(
                    ::symplectic::emitted::Coefficient::exact(0.0),
                    ::symplectic::emitted::Coefficient::exact(1.0),
                    &TABLEAU1,
                ),
            ]
        };
        type General = ::symplectic::emitted::Coupled<Lobatto3General>;
        type Separable = ::symplectic::emitted::Coupled<Lobatto3Separable>;
    }
    impl<C: ::symplectic::emitted::Holonomic> ::symplectic::emitted::ProvedFor<C>
    for Lobatto3 {}
    pub struct Lobatto3General;
    #[allow(unused_variables)]
    impl ::symplectic::emitted::StagePlan for Lobatto3General {
        type Class = ::symplectic::emitted::General;
        type Stages<V: ::symplectic::emitted::Vector> = ::symplectic::emitted::Stages<
            V,
            3,
            3,
        >;
        const EVALUATIONS: ::symplectic::emitted::EvaluationCounts = ::symplectic::emitted::EvaluationCounts {
            begin: 0,
            start: 1,
            sweep: 5,
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
            if kept.stages {
                ::symplectic::emitted::transform(
                    velocity,
                    [0, 1, 2],
                    [[0.0, 0.0, 1.0], [4.0, (-3.0), 12.0], [3.0, (-2.0), 6.0]],
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
                        ::symplectic::emitted::Coefficient::exact(1.25),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                        ::symplectic::emitted::Coefficient::exact((-0.25)),
                    ]),
                    [&velocity[0], &velocity[1], &velocity[2]],
                );
                ::symplectic::emitted::combine::<
                    R,
                    V,
                    _,
                >(
                    &mut q[2],
                    step.q,
                    step.q_low,
                    ::symplectic::emitted::factors([
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(1.0),
                    ]),
                    [&velocity[0], &velocity[1], &velocity[2]],
                );
                ::symplectic::emitted::transform(
                    force,
                    [0, 1],
                    [[(-1.0), 0.5], [(-8.0), 3.0]],
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
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact((-0.25)),
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
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                    ]),
                    [&force[0], &force[1]],
                );
                ::symplectic::emitted::combine::<
                    R,
                    V,
                    _,
                >(
                    &mut p[2],
                    step.p,
                    step.p_low,
                    ::symplectic::emitted::factors([
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(1.25),
                    ]),
                    [&force[0], &force[1]],
                );
            } else {
                ::symplectic::emitted::copy(&mut p[0], step.p);
                ::symplectic::emitted::copy(&mut p[1], step.p);
                ::symplectic::emitted::copy(&mut p[2], step.p);
                system
                    .velocity(
                        step.at(::symplectic::emitted::Coefficient::exact(0.0)),
                        step.q,
                        step.p,
                        &mut velocity[0],
                    );
                ::symplectic::emitted::copy_to(velocity, 0, [1, 2]);
                ::symplectic::emitted::scale(
                    &mut velocity[0],
                    step.size,
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
                );
                ::symplectic::emitted::scale(
                    &mut velocity[1],
                    step.size,
                    ::symplectic::emitted::Coefficient::new(
                        0.6666666666666666,
                        3.700743415417188e-17,
                        0.6666667,
                    ),
                );
                ::symplectic::emitted::scale(
                    &mut velocity[2],
                    step.size,
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
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
                        ::symplectic::emitted::Coefficient::exact(1.25),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                        ::symplectic::emitted::Coefficient::exact((-0.25)),
                    ]),
                    [&velocity[0], &velocity[1], &velocity[2]],
                );
                ::symplectic::emitted::combine::<
                    R,
                    V,
                    _,
                >(
                    &mut q[2],
                    step.q,
                    step.q_low,
                    ::symplectic::emitted::factors([
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(1.0),
                    ]),
                    [&velocity[0], &velocity[1], &velocity[2]],
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
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        0.6666666666666666,
                        3.700743415417188e-17,
                        0.6666667,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
                ],
            );
            let velocity_weights = ::symplectic::emitted::weights::<
                V::Scalar,
                _,
            >(
                step.size,
                [
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        0.6666666666666666,
                        3.700743415417188e-17,
                        0.6666667,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
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
            >(
                &mut force[0],
                step.size,
                ::symplectic::emitted::Coefficient::new(
                    0.16666666666666666,
                    9.25185853854297e-18,
                    0.16666667,
                ),
            );
            system
                .force(
                    step.at(::symplectic::emitted::Coefficient::exact(0.5)),
                    &q[1],
                    &p[1],
                    &mut force[1],
                );
            ::symplectic::emitted::increment::<
                R,
                V,
            >(
                &mut force[1],
                step.size,
                ::symplectic::emitted::Coefficient::new(
                    0.6666666666666666,
                    3.700743415417188e-17,
                    0.6666667,
                ),
            );
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
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact((-0.25)),
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
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(0.5),
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
                &mut p[2],
                step.p,
                step.p_low,
                ::symplectic::emitted::relative::<
                    R,
                    _,
                    _,
                >(
                    [
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(1.25),
                    ],
                    [force_weights[0], force_weights[1]],
                ),
                [&force[0], &force[1]],
                &mut change.p,
            );
            system
                .velocity(
                    step.at(::symplectic::emitted::Coefficient::exact(0.0)),
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
                ::symplectic::emitted::Coefficient::new(
                    0.16666666666666666,
                    9.25185853854297e-18,
                    0.16666667,
                ),
            );
            system
                .velocity(
                    step.at(::symplectic::emitted::Coefficient::exact(0.5)),
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
                ::symplectic::emitted::Coefficient::new(
                    0.6666666666666666,
                    3.700743415417188e-17,
                    0.6666667,
                ),
            );
            system
                .velocity(
                    step.at(::symplectic::emitted::Coefficient::exact(1.0)),
                    &q[2],
                    &p[2],
                    &mut velocity[2],
                );
            ::symplectic::emitted::increment::<
                R,
                V,
            >(
                &mut velocity[2],
                step.size,
                ::symplectic::emitted::Coefficient::new(
                    0.16666666666666666,
                    9.25185853854297e-18,
                    0.16666667,
                ),
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
                        ::symplectic::emitted::Coefficient::exact(1.25),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                        ::symplectic::emitted::Coefficient::exact((-0.25)),
                    ],
                    [velocity_weights[0], velocity_weights[1], velocity_weights[2]],
                ),
                [&velocity[0], &velocity[1], &velocity[2]],
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
                ::symplectic::emitted::relative::<
                    R,
                    _,
                    _,
                >(
                    [
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(1.0),
                    ],
                    [velocity_weights[0], velocity_weights[1], velocity_weights[2]],
                ),
                [&velocity[0], &velocity[1], &velocity[2]],
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
                ::symplectic::emitted::Coefficient::new(
                    0.16666666666666666,
                    9.25185853854297e-18,
                    0.16666667,
                ),
            );
            ::symplectic::emitted::scale(
                &mut force[1],
                step.size,
                ::symplectic::emitted::Coefficient::new(
                    0.6666666666666666,
                    3.700743415417188e-17,
                    0.6666667,
                ),
            );
            ::symplectic::emitted::scale(
                &mut velocity[0],
                step.size,
                ::symplectic::emitted::Coefficient::new(
                    0.16666666666666666,
                    9.25185853854297e-18,
                    0.16666667,
                ),
            );
            ::symplectic::emitted::scale(
                &mut velocity[1],
                step.size,
                ::symplectic::emitted::Coefficient::new(
                    0.6666666666666666,
                    3.700743415417188e-17,
                    0.6666667,
                ),
            );
            ::symplectic::emitted::scale(
                &mut velocity[2],
                step.size,
                ::symplectic::emitted::Coefficient::new(
                    0.16666666666666666,
                    9.25185853854297e-18,
                    0.16666667,
                ),
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
                    &q[2],
                    &p[2],
                    &mut force[2],
                );
            ::symplectic::emitted::scale(
                &mut force[2],
                step.size,
                ::symplectic::emitted::Coefficient::new(
                    0.16666666666666666,
                    9.25185853854297e-18,
                    0.16666667,
                ),
            );
            ::symplectic::emitted::total::<
                R,
                V,
                _,
            >(
                q1,
                q1_low,
                step.q,
                step.q_low,
                [&velocity[0], &velocity[1], &velocity[2]],
            );
            ::symplectic::emitted::total::<
                R,
                V,
                _,
            >(p1, p1_low, step.p, step.p_low, [&force[0], &force[1], &force[2]]);
        }
    }
    impl ::symplectic::emitted::StageTableau for Lobatto3General {
        type Lanes = ::symplectic::emitted::F64x4;
        type Groups<T: ::core::fmt::Debug> = [T; 1];
        const INCREMENTS: bool = true;
        const POSITIONS: ::symplectic::emitted::HalfTableau = ::symplectic::emitted::HalfTableau {
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
            polynomial: ::core::option::Option::Some(::symplectic::emitted::StagePolynomial {
                legendre: &[&[(-3.0), 0.0, 3.0], &[2.0, (-1.0), 2.0]],
                order: 3,
            }),
        };
        const MOMENTA: ::symplectic::emitted::HalfTableau = ::symplectic::emitted::HalfTableau {
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
            polynomial: ::core::option::Option::Some(::symplectic::emitted::StagePolynomial {
                legendre: &[&[(-3.0), 0.0, 3.0], &[2.0, (-1.0), 2.0]],
                order: 3,
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
    pub struct Lobatto3Separable;
    #[allow(unused_variables)]
    impl ::symplectic::emitted::StagePlan for Lobatto3Separable {
        type Class = ::symplectic::emitted::Separable;
        type Stages<V: ::symplectic::emitted::Vector> = ::symplectic::emitted::Stages<
            V,
            3,
            3,
        >;
        const EVALUATIONS: ::symplectic::emitted::EvaluationCounts = ::symplectic::emitted::EvaluationCounts {
            begin: 1,
            start: 1,
            sweep: 4,
            finish: 1,
            carried: 1,
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
            if !kept.evaluation {
                system
                    .force(
                        step.at(::symplectic::emitted::Coefficient::exact(0.0)),
                        step.q,
                        step.p,
                        &mut force[2],
                    );
            }
            ::symplectic::emitted::copy_to(force, 2, [0]);
            ::symplectic::emitted::scale(
                &mut force[0],
                step.size,
                ::symplectic::emitted::Coefficient::new(
                    0.16666666666666666,
                    9.25185853854297e-18,
                    0.16666667,
                ),
            );
            if kept.stages {
                ::symplectic::emitted::transform(
                    velocity,
                    [0, 1, 2],
                    [[0.0, 0.0, 1.0], [4.0, (-3.0), 12.0], [3.0, (-2.0), 6.0]],
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
                        ::symplectic::emitted::Coefficient::exact(1.25),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                        ::symplectic::emitted::Coefficient::exact((-0.25)),
                    ]),
                    [&velocity[0], &velocity[1], &velocity[2]],
                );
            } else {
                ::symplectic::emitted::copy(&mut p[0], step.p);
                ::symplectic::emitted::copy(&mut p[1], step.p);
                ::symplectic::emitted::copy(&mut p[2], step.p);
                system
                    .velocity(
                        step.at(::symplectic::emitted::Coefficient::exact(0.0)),
                        step.q,
                        step.p,
                        &mut velocity[0],
                    );
                ::symplectic::emitted::copy_to(velocity, 0, [1, 2]);
                ::symplectic::emitted::scale(
                    &mut velocity[0],
                    step.size,
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
                );
                ::symplectic::emitted::scale(
                    &mut velocity[1],
                    step.size,
                    ::symplectic::emitted::Coefficient::new(
                        0.6666666666666666,
                        3.700743415417188e-17,
                        0.6666667,
                    ),
                );
                ::symplectic::emitted::scale(
                    &mut velocity[2],
                    step.size,
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
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
                        ::symplectic::emitted::Coefficient::exact(1.25),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                        ::symplectic::emitted::Coefficient::exact((-0.25)),
                    ]),
                    [&velocity[0], &velocity[1], &velocity[2]],
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
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        0.6666666666666666,
                        3.700743415417188e-17,
                        0.6666667,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
                ],
            );
            let velocity_weights = ::symplectic::emitted::weights::<
                V::Scalar,
                _,
            >(
                step.size,
                [
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        0.6666666666666666,
                        3.700743415417188e-17,
                        0.6666667,
                    ),
                    ::symplectic::emitted::Coefficient::new(
                        0.16666666666666666,
                        9.25185853854297e-18,
                        0.16666667,
                    ),
                ],
            );
            system
                .force(
                    step.at(::symplectic::emitted::Coefficient::exact(0.5)),
                    &q[1],
                    step.p,
                    &mut force[1],
                );
            ::symplectic::emitted::increment::<
                R,
                V,
            >(
                &mut force[1],
                step.size,
                ::symplectic::emitted::Coefficient::new(
                    0.6666666666666666,
                    3.700743415417188e-17,
                    0.6666667,
                ),
            );
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
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact((-0.25)),
                    ],
                    [
                        <V::Scalar as ::symplectic::emitted::Scalar>::from_f64(1.0),
                        force_weights[1],
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
                &mut p[1],
                step.p,
                step.p_low,
                ::symplectic::emitted::relative::<
                    R,
                    _,
                    _,
                >(
                    [
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                    ],
                    [
                        <V::Scalar as ::symplectic::emitted::Scalar>::from_f64(1.0),
                        force_weights[1],
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
                ::symplectic::emitted::relative::<
                    R,
                    _,
                    _,
                >(
                    [
                        ::symplectic::emitted::Coefficient::exact(1.0),
                        ::symplectic::emitted::Coefficient::exact(1.25),
                    ],
                    [
                        <V::Scalar as ::symplectic::emitted::Scalar>::from_f64(1.0),
                        force_weights[1],
                    ],
                ),
                [&force[0], &force[1]],
                &mut change.p,
            );
            system
                .velocity(
                    step.at(::symplectic::emitted::Coefficient::exact(0.0)),
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
                ::symplectic::emitted::Coefficient::new(
                    0.16666666666666666,
                    9.25185853854297e-18,
                    0.16666667,
                ),
            );
            system
                .velocity(
                    step.at(::symplectic::emitted::Coefficient::exact(0.5)),
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
                ::symplectic::emitted::Coefficient::new(
                    0.6666666666666666,
                    3.700743415417188e-17,
                    0.6666667,
                ),
            );
            system
                .velocity(
                    step.at(::symplectic::emitted::Coefficient::exact(1.0)),
                    step.q,
                    &p[2],
                    &mut velocity[2],
                );
            ::symplectic::emitted::increment::<
                R,
                V,
            >(
                &mut velocity[2],
                step.size,
                ::symplectic::emitted::Coefficient::new(
                    0.16666666666666666,
                    9.25185853854297e-18,
                    0.16666667,
                ),
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
                        ::symplectic::emitted::Coefficient::exact(1.25),
                        ::symplectic::emitted::Coefficient::exact(0.5),
                        ::symplectic::emitted::Coefficient::exact((-0.25)),
                    ],
                    [velocity_weights[0], velocity_weights[1], velocity_weights[2]],
                ),
                [&velocity[0], &velocity[1], &velocity[2]],
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
                &mut force[1],
                step.size,
                ::symplectic::emitted::Coefficient::new(
                    0.6666666666666666,
                    3.700743415417188e-17,
                    0.6666667,
                ),
            );
            ::symplectic::emitted::scale(
                &mut velocity[0],
                step.size,
                ::symplectic::emitted::Coefficient::new(
                    0.16666666666666666,
                    9.25185853854297e-18,
                    0.16666667,
                ),
            );
            ::symplectic::emitted::scale(
                &mut velocity[1],
                step.size,
                ::symplectic::emitted::Coefficient::new(
                    0.6666666666666666,
                    3.700743415417188e-17,
                    0.6666667,
                ),
            );
            ::symplectic::emitted::scale(
                &mut velocity[2],
                step.size,
                ::symplectic::emitted::Coefficient::new(
                    0.16666666666666666,
                    9.25185853854297e-18,
                    0.16666667,
                ),
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
            >(
                q1,
                q1_low,
                step.q,
                step.q_low,
                [&velocity[0], &velocity[1], &velocity[2]],
            );
            system
                .force(
                    step.at(::symplectic::emitted::Coefficient::exact(1.0)),
                    &*q1,
                    step.p,
                    &mut force[2],
                );
            ::symplectic::emitted::total::<
                R,
                V,
                _,
            >(p1, p1_low, step.p, step.p_low, [&force[0], &force[1]]);
            ::symplectic::emitted::advance::<
                R,
                V,
            >(
                p1,
                p1_low,
                step.size,
                ::symplectic::emitted::Coefficient::new(
                    0.16666666666666666,
                    9.25185853854297e-18,
                    0.16666667,
                ),
                &force[2],
            );
        }
    }
    impl ::symplectic::emitted::StageTableau for Lobatto3Separable {
        type Lanes = ::symplectic::emitted::F64x4;
        type Groups<T: ::core::fmt::Debug> = [T; 1];
        const INCREMENTS: bool = true;
        const POSITIONS: ::symplectic::emitted::HalfTableau = ::symplectic::emitted::HalfTableau {
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
            polynomial: ::core::option::Option::Some(::symplectic::emitted::StagePolynomial {
                legendre: &[&[(-3.0), 0.0, 3.0], &[2.0, (-1.0), 2.0]],
                order: 4,
            }),
        };
        const MOMENTA: ::symplectic::emitted::HalfTableau = <Lobatto3General as ::symplectic::emitted::StageTableau>::MOMENTA;
        const SECOND_ORDER: ::core::option::Option<
            ::symplectic::emitted::SecondOrderTableau,
        > = ::core::option::Option::Some(::symplectic::emitted::SecondOrderTableau {
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
            rest: &[1.0, 0.5, 0.0, 0.0],
        });
        const DECOUPLING: ::core::option::Option<::symplectic::emitted::Decoupling> = ::core::option::Option::Some(::symplectic::emitted::Decoupling {
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
                    carried: &[2],
                },
            ]
        }
    }
};
