// ruth-1983, 3 stages, kick 7/24, 3/4, -1/24, drift 2/3, -2/3, 1
// source: Ruth, A canonical integration technique, IEEE Trans. Nucl. Sci. 30 (1983)
// order 1 for every H (proved), 3 for T(p) + U(q) (proved), 3 for T quadratic (proved)
// symplectic(separable) (proved)
// written by symplectic VERSION
// A step of H = T(t, p) + U(t, q): drifts and kicks, with compensated sums.
//
// Usage, in N dimensions, with a type that implements `System<N>`:
//
//     let mut state = State::new(q, p);
//     for k in 0..steps {
//         state.step(&system, t0 + k as f64 * h, h)?;
//     }

/// H = T(t, p) + U(t, q).
pub trait System<const N: usize> {
    /// dT/dp
    fn velocity(&self, t: f64, p: &[f64; N]) -> [f64; N];

    /// -dU/dq
    fn force(&self, t: f64, q: &[f64; N]) -> [f64; N];
}

/// Why a step failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Failure {
    /// The result is not finite.
    NotFinite,
}

/// Positions `q + q_low` and momenta `p + p_low`: the low parts are what rounding left out.
#[derive(Clone, Copy, Debug)]
pub struct State<const N: usize> {
    pub q: [f64; N],
    pub q_low: [f64; N],
    pub p: [f64; N],
    pub p_low: [f64; N],
    /// The force at the end of the last step: set it to `None` after a change of `q`, of the force, or of the
    /// time other than by a step.
    pub force: Option<[f64; N]>,
}

impl<const N: usize> State<N> {
    pub fn new(q: [f64; N], p: [f64; N]) -> Self {
        State { q, q_low: [0.0; N], p, p_low: [0.0; N], force: None }
    }

    /// A step of size `h` from the time `t`. Where it is not finite, the state stays as it was.
    pub fn step(&mut self, system: &impl System<N>, t: f64, h: f64) -> Result<(), Failure> {
        let mut s = *self;
        let force = system.force(t, &s.q);
        s.kick(h * 0.2916666666666667, &force); // 7/24
        let velocity = system.velocity(t + h * 0.2916666666666667, &s.p);
        s.drift(h * 0.6666666666666666, &velocity); // 2/3
        let force = system.force(t + h * 0.6666666666666666, &s.q);
        s.kick(h * 0.75, &force); // 3/4
        let velocity = system.velocity(t + h * 1.0416666666666667, &s.p);
        s.drift(h * -0.6666666666666666, &velocity); // -2/3
        let force = system.force(t, &s.q);
        s.kick(h * -0.041666666666666664, &force); // -1/24
        let velocity = system.velocity(t + h, &s.p);
        s.drift(h * 1.0, &velocity); // 1
        let parts = [s.q, s.q_low, s.p, s.p_low];
        if !parts.iter().flatten().all(|x| x.is_finite()) {
            return Err(Failure::NotFinite);
        }
        s.force = None;
        *self = s;
        Ok(())
    }

    fn kick(&mut self, factor: f64, force: &[f64; N]) {
        for i in 0..N {
            add(&mut self.p[i], &mut self.p_low[i], factor * force[i]);
        }
    }

    fn drift(&mut self, factor: f64, velocity: &[f64; N]) {
        for i in 0..N {
            add(&mut self.q[i], &mut self.q_low[i], factor * velocity[i]);
        }
    }
}

/// `high + low + term` as the nearest double and the rest (Knuth, Dekker).
fn add(high: &mut f64, low: &mut f64, term: f64) {
    let sum = *high + term;
    let part = sum - *high;
    let rest = *low + ((*high - (sum - part)) + (term - part));
    *high = sum + rest;
    *low = rest - (*high - sum);
}
