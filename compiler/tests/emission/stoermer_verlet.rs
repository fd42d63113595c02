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
        type General = StoermerVerletGeneral;
        type Separable = StoermerVerletSeparable;
    }
    pub struct StoermerVerletGeneral;
    #[allow(unused_variables)]
    impl ::symplectic::Plan for StoermerVerletGeneral {
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
            ::symplectic::combine(&mut q[1], step.q, step.size, [], []);
            ::symplectic::combine(&mut p[0], step.p, step.size, [], []);
            system
                .velocity(
                    step.at(::symplectic::Coefficient::exact(0.5)),
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
                &mut q[1],
                step.q,
                step.size,
                [
                    ::symplectic::Coefficient::exact(0.5),
                    ::symplectic::Coefficient::exact(0.5),
                ],
                [&velocity[0], &velocity[1]],
                &mut change.q,
            );
            system
                .force(
                    step.at(::symplectic::Coefficient::exact(0.0)),
                    step.q,
                    &p[0],
                    &mut force[0],
                );
            ::symplectic::relax(
                &mut p[0],
                step.p,
                step.size,
                [::symplectic::Coefficient::exact(0.5)],
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
            system
                .velocity(
                    step.at(::symplectic::Coefficient::exact(0.5)),
                    &q[1],
                    &p[0],
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
            system
                .force(
                    step.at(::symplectic::Coefficient::exact(1.0)),
                    &q[1],
                    &p[0],
                    &mut force[1],
                );
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
    pub struct StoermerVerletSeparable;
    #[allow(unused_variables)]
    impl ::symplectic::Plan for StoermerVerletSeparable {
        type Class = ::symplectic::Separable;
        type Coupling = ::symplectic::Explicit;
        type Stages<V: ::symplectic::Vector> = ::symplectic::Stages<V, 2, 1>;
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
            if !carried {
                system
                    .force(
                        step.at(::symplectic::Coefficient::exact(0.0)),
                        step.q,
                        step.p,
                        &mut force[0],
                    );
            }
            ::symplectic::combine(
                &mut p[0],
                step.p,
                step.size,
                [::symplectic::Coefficient::exact(0.5)],
                [&force[0]],
            );
            system
                .velocity(
                    step.at(::symplectic::Coefficient::exact(0.5)),
                    step.q,
                    &p[0],
                    &mut velocity[0],
                );
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
            ::symplectic::Change::default()
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
                [::symplectic::Coefficient::exact(1.0)],
                [&velocity[0]],
            );
            system
                .force(
                    step.at(::symplectic::Coefficient::exact(1.0)),
                    q1,
                    step.p,
                    &mut force[1],
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
            stages.force.swap(0, 1);
            true
        }
    }
};
