/// Documentation of the user.
/**

```text
chin-1997-c, 3 stages, kick 1/6, 2/3, drift 1/2, gradient 0, 1/72, symmetric true
source: Suzuki, Phys. Lett. A 201 (1995);
        Chin, Symplectic integrators from composite operator factorizations, Phys. Lett. A 226 (1997);
        called 4A by Chin & Chen 2005, and C elsewhere;
        the gradient weight is the one with which the conditions of order 3 hold

  c │ a                 c̃ │ ã
────┼────────────     ────┼──────────────
  0 │   0    0  0     1/6 │ 1/6    0    0
1/2 │ 1/2    0  0     5/6 │ 1/6  2/3    0
  1 │ 1/2  1/2  0       1 │ 1/6  2/3  1/6
────┼────────────     ────┼──────────────
  b │ 1/2  1/2  0       b̃ │ 1/6  2/3  1/6

g = 0, 1/72, 0: p += h (b̃_i f + 2 g_i h² f′ M⁻¹ f)

properties
  symplectic           no   refuted  gradient kicks need quadratic T
  symmetric            no   refuted  gradient kicks need quadratic T
  consistent           yes  proved
  equal_matrices       no   refuted  a_11 − ã_11 = -1/6
  explicit             yes  proved   Q1, P1, Q2, P2, Q3
  first_row_zero       yes  proved
  stiffly_accurate     yes  proved
  first_same_as_last   yes  proved   Q_s = q1 is Q_1 of the next step
  positive_weights     no   refuted  b_3 = 0
  constrained          no   refuted  gradient kicks need quadratic T
  nonholonomic         no   refuted  gradient kicks need quadratic T
  symplectic(nystrom)  yes  proved
  symmetric(nystrom)   yes  proved
```*/
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Chin;
#[allow(clippy::approx_constant)]
impl Chin {
    /// a_ij: the position stages from the velocities. Correctly rounded.
    pub const A: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [0.5, 0.0, 0.0], [0.5, 0.5, 0.0]];
    /// ã_ij: the momentum stages from the forces. Correctly rounded.
    pub const A_TILDE: [[f64; 3]; 3] = [
        [0.16666666666666666, 0.0, 0.0],
        [0.16666666666666666, 0.6666666666666666, 0.0],
        [0.16666666666666666, 0.6666666666666666, 0.16666666666666666],
    ];
    /// b_j: the weights of the velocities. Correctly rounded.
    pub const B: [f64; 3] = [0.5, 0.5, 0.0];
    /// b̃_j: the weights of the forces. Correctly rounded.
    pub const B_TILDE: [f64; 3] = [
        0.16666666666666666,
        0.6666666666666666,
        0.16666666666666666,
    ];
    /// c_i = Σ_j a_ij. Correctly rounded.
    pub const C: [f64; 3] = [0.0, 0.5, 1.0];
    /// c̃_i = Σ_j ã_ij. Correctly rounded.
    pub const C_TILDE: [f64; 3] = [0.16666666666666666, 0.8333333333333334, 1.0];
    /// g_j: the weights of the gradient kicks. Correctly rounded.
    pub const GRADIENT: [f64; 3] = [0.0, 0.013888888888888888, 0.0];
}
#[allow(clippy::approx_constant)]
const _: () = {
    use ::symplectic::emitted;
    impl emitted::Method for Chin {
        const NAME: &'static str = "Chin";
        const STAGES: usize = 3;
        const DEFINITION: &'static str = "kick: [1/6, 2/3], drift: 1/2, gradient: [0, 1/72], symmetric: true";
        const COEFFICIENTS: emitted::Coefficients = {
            const A: &[&[emitted::Coefficient]] = &[
                &[emitted::exact(0.0), emitted::exact(0.0), emitted::exact(0.0)],
                &[emitted::exact(0.5), emitted::exact(0.0), emitted::exact(0.0)],
                &[emitted::exact(0.5), emitted::exact(0.5), emitted::exact(0.0)],
            ];
            const B: &[emitted::Coefficient] = &[
                emitted::exact(0.5),
                emitted::exact(0.5),
                emitted::exact(0.0),
            ];
            const C: &[emitted::Coefficient] = &[
                emitted::exact(0.0),
                emitted::exact(0.5),
                emitted::exact(1.0),
            ];
            const A_TILDE: &[&[emitted::Coefficient]] = &[
                &[
                    emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
                    emitted::exact(0.0),
                    emitted::exact(0.0),
                ],
                &[
                    emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
                    emitted::rounded(0.6666666666666666, 3.700743415417188e-17),
                    emitted::exact(0.0),
                ],
                &[
                    emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
                    emitted::rounded(0.6666666666666666, 3.700743415417188e-17),
                    emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
                ],
            ];
            const C_TILDE: &[emitted::Coefficient] = &[
                emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
                emitted::rounded(0.8333333333333334, (-3.700743415417188e-17)),
                emitted::exact(1.0),
            ];
            const B_TILDE: &[emitted::Coefficient] = &[
                emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
                emitted::rounded(0.6666666666666666, 3.700743415417188e-17),
                emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
            ];
            emitted::Coefficients {
                gradient: &[
                    emitted::exact(0.0),
                    emitted::rounded(0.013888888888888888, 7.709882115452476e-19),
                    emitted::exact(0.0),
                ],
                ..emitted::Coefficients::new([A, A_TILDE], [B, B_TILDE], [C, C_TILDE])
            }
        };
        const ORDERS: emitted::Orders = emitted::Orders {
            general: 0,
            separable: 0,
            nystrom: 4,
        };
        const SYMMETRY: emitted::Symmetry = emitted::Symmetry {
            general: false,
            separable: true,
        };
        type General = emitted::SeparableOnly;
        type Separable = emitted::Splitting<ChinSeparable>;
    }
    impl emitted::ProvedFor<emitted::Separable> for Chin {}
    impl emitted::ProvedFor<()> for Chin {}
    impl<C: emitted::SplitClass> emitted::SymmetricFor<C> for Chin {}
    pub struct ChinSeparable;
    #[allow(unused_variables)]
    impl emitted::SplittingPlan for ChinSeparable {
        type Class = emitted::Separable;
        const EVALUATIONS: u32 = 6;
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
            step.kick(emitted::rounded(0.16666666666666666, 9.25185853854297e-18));
            step.drift(
                1,
                emitted::rounded(0.16666666666666666, 9.25185853854297e-18),
                emitted::exact(0.5),
            );
            step.force(2, emitted::exact(0.5));
            step.kick(emitted::rounded(0.6666666666666666, 3.700743415417188e-17));
            step.force_gradient(2, emitted::exact(0.5));
            step.gradient_kick(
                emitted::rounded(0.027777777777777776, 1.5419764230904951e-18),
            );
            step.drift(
                2,
                emitted::rounded(0.8333333333333334, (-3.700743415417188e-17)),
                emitted::exact(0.5),
            );
            step.force(3, emitted::exact(1.0));
            step.kick(emitted::rounded(0.16666666666666666, 9.25185853854297e-18));
        }
    }
};
