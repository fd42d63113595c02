// gauss-2, 2 stages, basis polynomial(2), nodes gauss(2)
// source: Kuntzmann 1961
// source: Butcher, Implicit Runge–Kutta processes, Math. Comp. 18 (1964)
// source: Hairer, Lubich & Wanner, Geometric Numerical Integration, §II.1.3
// source: built as in Marsden & West 2001, Theorem 2.6.2
// source: the same method as chebyshev-2
// order 4 for every H (proved), 4 for T(p) + U(q) (proved), 4 for T quadratic (proved)
// symplectic (proved), symmetric (proved)
// written by symplectic VERSION
// A step of every H(t, q, p): the stages are solved for by fixed-point iteration, with compensated sums.
//
// Usage, in N dimensions, with a type that implements `System<N>`:
//
//     let mut state = State::new(q, p);
//     for k in 0..steps {
//         state.step(&system, t0 + k as f64 * h, h)?;
//     }

/// H(t, q, p).
pub trait System<const N: usize> {
    /// dH/dp
    fn velocity(&self, t: f64, q: &[f64; N], p: &[f64; N]) -> [f64; N];

    /// -dH/dq
    fn force(&self, t: f64, q: &[f64; N], p: &[f64; N]) -> [f64; N];
}

/// Why a step failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Failure {
    /// A stage is not finite.
    NotFinite,
    /// Stages do not converge: a smaller step may do.
    DoesNotConverge,
}

const STAGES: usize = 2;
const MAX_SWEEPS: usize = 100;

const C: [f64; STAGES] = [
    0.2113248654051871, // 1/2 - sqrt(3)/6 = 0.21132486540518712
    0.7886751345948129, // 1/2 + sqrt(3)/6 = 0.78867513459481288
];
const B: [f64; STAGES] = [
    0.5, // 1/2
    0.5, // 1/2
];
const B_TILDE: [f64; STAGES] = [
    0.5, // 1/2
    0.5, // 1/2
];
// mu_ij = a_ij / b_j and mu_tilde_ij = a_tilde_ij / b_tilde_j, rounded so that mu_ij + mu_tilde_ji is 1 exactly: symplectic as rounded.
const MU: [[f64; STAGES]; STAGES] = [
    [0.5, -0.07735026918962573],
    [1.0773502691896257, 0.5],
];
const MU_TILDE: [[f64; STAGES]; STAGES] = [
    [0.5, -0.07735026918962573],
    [1.0773502691896257, 0.5],
];

/// One vector for each stage.
type Stages<const N: usize> = [[f64; N]; STAGES];

/// Positions `q + q_low` and momenta `p + p_low`: the low parts are what rounding left out.
#[derive(Clone, Copy, Debug)]
pub struct State<const N: usize> {
    pub q: [f64; N],
    pub q_low: [f64; N],
    pub p: [f64; N],
    pub p_low: [f64; N],
}

impl<const N: usize> State<N> {
    pub fn new(q: [f64; N], p: [f64; N]) -> Self {
        State { q, q_low: [0.0; N], p, p_low: [0.0; N] }
    }

    /// A step of size `h` from the time `t`. Stages are iterated until they no longer change, or change by rounding
    /// errors only and twice no less than before. Where they do not, or are not finite, the state stays as it was. They are
    /// on the stack.
    pub fn step(&mut self, system: &impl System<N>, t: f64, h: f64) -> Result<(), Failure> {
        let (mut stage_q, mut stage_p) = ([self.q; STAGES], [self.p; STAGES]);
        let mut drift = drifts(system, t, h, &stage_q, &stage_p);
        stages(&self.q, &self.q_low, &MU, &drift, &mut stage_q)?;
        let mut least = f64::INFINITY;
        let (mut sweeps, mut stalled) = (0, 0);
        let kick = loop {
            let kick = kicks(system, t, h, &stage_q, &stage_p);
            let moved_p = stages(&self.p, &self.p_low, &MU_TILDE, &kick, &mut stage_p)?;
            drift = drifts(system, t, h, &stage_q, &stage_p);
            let moved_q = stages(&self.q, &self.q_low, &MU, &drift, &mut stage_q)?;
            let moved = moved_q.max(moved_p);
            stalled += usize::from(moved >= least);
            if moved == 0.0 || (stalled >= 2 && moved_q.min(moved_p) <= 64.0 * f64::EPSILON) {
                break kick;
            }
            least = least.min(moved);
            sweeps += 1;
            if sweeps == MAX_SWEEPS {
                return Err(Failure::DoesNotConverge);
            }
        };
        for k in 0..STAGES {
            for i in 0..N {
                add(&mut self.q[i], &mut self.q_low[i], drift[k][i]);
                add(&mut self.p[i], &mut self.p_low[i], kick[k][i]);
            }
        }
        Ok(())
    }
}

fn kicks<const N: usize>(
    system: &impl System<N>, t: f64, h: f64, q: &Stages<N>, p: &Stages<N>,
) -> Stages<N> {
    core::array::from_fn(|k| system.force(t + h * C[k], &q[k], &p[k]).map(|f| h * B_TILDE[k] * f))
}

fn drifts<const N: usize>(
    system: &impl System<N>, t: f64, h: f64, q: &Stages<N>, p: &Stages<N>,
) -> Stages<N> {
    core::array::from_fn(|k| system.velocity(t + h * C[k], &q[k], &p[k]).map(|v| h * B[k] * v))
}

/// Stages as sums of increments: `x + (low + sum_j factors[j] increments[j])`. Returns how far they moved, relative to the
/// largest.
fn stages<const N: usize>(
    x: &[f64; N], low: &[f64; N], factors: &[[f64; STAGES]; STAGES], increments: &Stages<N>, stages: &mut Stages<N>,
) -> Result<f64, Failure> {
    let (mut moved, mut largest) = (0.0_f64, 0.0_f64);
    for k in 0..STAGES {
        for i in 0..N {
            let mut sum = low[i];
            for j in 0..STAGES {
                sum += factors[k][j] * increments[j][i];
            }
            let stage = x[i] + sum;
            if !stage.is_finite() {
                return Err(Failure::NotFinite);
            }
            moved = moved.max((stage - stages[k][i]).abs());
            largest = largest.max(stage.abs());
            stages[k][i] = stage;
        }
    }
    let relative = if moved == 0.0 { 0.0 } else { moved / largest };
    if relative.is_finite() { Ok(relative) } else { Err(Failure::NotFinite) }
}

/// `high + low + term` as the nearest double and the rest (Knuth, Dekker).
fn add(high: &mut f64, low: &mut f64, term: f64) {
    let sum = *high + term;
    let part = sum - *high;
    let rest = *low + ((*high - (sum - part)) + (term - part));
    *high = sum + rest;
    *low = rest - (*high - sum);
}
