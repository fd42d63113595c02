//! Symplectic correctors.

use alloc::vec;
use alloc::vec::Vec;

use super::integrator::{check_end, failed};
use super::{Flow, FlowError, Span, Splitting};
use crate::Error;
use crate::friction::Damped;
use symplectic_core::inside::{check_state, check_step_size};
use symplectic_core::proved::{Splits, SymmetricFor};
use symplectic_core::{ProvedFor, Separable, State, Vector};

/// A symplectic corrector for a symmetric [`Splitting`] K of `H = A + B` with a small `B = O(ε)` (Wisdom, Holman & Touma, *Fields Inst.
/// Commun.* 10, 217, 1996). It is a change of variables C that reduces the error of the steps from `O(εh²)` to `O(εh^{2m+2} + ε²h²)`.
///
/// To first order in ε, `n` steps integrate the kick along the exact flow of A, by a quadrature rule in every step. By the Euler–Maclaurin
/// formula, the error of this sum consists of terms at the two ends of the run. So only the ends need a correction:
///
/// ```text
/// C K^n C⁻¹ ≈ e^{nh(A+B)}       C = Π_i e^{−a_i hA} e^{b_i hB} e^{a_i hA}
/// 2 Σ_{i=1}^m b_i a_i^{2k−1} = −1/(2k) Σ_j w_j B_{2k}(c_j)       k = 1, …, m
/// ```
///
/// $$ 2 \sum_{i=1}^m b_i a_i^{2k-1} = -\frac{1}{2k} \sum_j w_j B_{2k}(c_j) \qquad k = 1, \dots, m $$
///
/// Here the `w_j` are the weights of the kicks, `c_j h` their times in the drift, and `B_{2k}` the Bernoulli polynomials. The rightmost
/// flow acts first. C has the pairs `(a_i, b_i)` and `(−a_i, −b_i)` with `a_i = i/2`; [`new`](Self::new) solves for the `b_i`. It takes
/// `2m` kicks and `2m + 1` drifts, forward and backward, and is symplectic if the flows are. Neither part may depend on time.
///
/// The run uses the variables of the kernel K: [`to_kernel`](Self::to_kernel) transforms the initial state,
/// [`from_kernel`](Self::from_kernel) states of the run back, for output. They are inverse to each other up to rounding. Both take the step
/// size of the run, or of a substep of [`Substeps`](super::Substeps). [`integrate_to`](super::FlowIntegrator::integrate_to) takes shorter
/// steps if the time to the end is not a multiple of the step size. More than four pairs rarely help: the error ε²h² remains.
///
/// A state [inside a step](super::FlowIntegrator::state_at) is the end of a shorter step, which has another change of variables. There
/// `from_kernel` leaves the error `O(εh³)` of one uncorrected step. For such a time, transform the last state of the run back, and continue
/// from it with corrected steps of another size.
///
/// ```
/// use symplectic::flow::kepler::Jacobi;
/// use symplectic::flow::{Corrector, FlowSteps, Splitting};
/// use symplectic::nalgebra::DVector;
/// use symplectic::State;
///
/// symplectic::tableau! { Leapfrog { base: position-verlet } }
///
/// # fn main() -> Result<(), symplectic::flow::Error> {
/// let system = Jacobi::new(39.4769264, &[1.0, 9.55e-4, 2.86e-4])?;
/// let q = [0.0, 0.0, 0.0, 5.2, 0.0, 0.0, 0.0, 9.5, 0.2];
/// let p = [0.0, 0.0, 0.0, 0.0, 2.63e-3, 0.0, -5.8e-4, 0.0, 0.0];
/// let start = system.from_inertial(&State::<DVector<f64>>::from_slices(0.0, &q, &p)?)?;
///
/// let h = 0.5;
/// let mut corrector = Corrector::new(Leapfrog, system.drift(), system.kick(), 4)?;
/// let step = Splitting::new(Leapfrog, system.drift(), system.kick());
/// let mut run = FlowSteps::run(step, corrector.to_kernel(&start, h)?, h)?;
/// run.take_steps(1000)?;
/// let end = system.to_inertial(&corrector.from_kernel(run.state(), h)?)?;
/// # assert!((end.q.rows(3, 3) - end.q.rows(0, 3)).norm() < 6.0);
/// # Ok(())
/// # }
/// ```
///
/// A method that is not symmetric has other error terms, and does not compile:
///
/// ```compile_fail,E0277
/// use symplectic::flow::Corrector;
///
/// symplectic::tableau! { SymplecticEuler { basis: polynomial(1), nodes: [0] } }
/// let corrector = Corrector::new(SymplecticEuler, (), (), 4);
/// ```
#[derive(Clone, Debug)]
pub struct Corrector<A, B> {
    /// The 2m pairs `(a_i, b_i)`, with `a_i` ascending.
    pairs: Vec<(f64, f64)>,
    /// The flow of A.
    pub drift: A,
    /// The flow of B.
    pub kick: B,
}

/// The largest number of pairs. With 8 pairs and steps of a sixth of the shortest period, the first-order error is about 10⁻¹¹ε.
const MAX_PAIRS: u32 = 8;

/// The spacing of the `a_i`.
const SPACING: f64 = 0.5;

impl<A, B> Corrector<A, B> {
    /// The corrector with m = `pairs` for the splitting with this method and these flows.
    ///
    /// # Errors
    ///
    /// [`Error::FlowParameter`] for 0 pairs or more than 8.
    pub fn new<M>(method: M, drift: A, kick: B, pairs: u32) -> Result<Self, Error>
    where
        M: Splits + SymmetricFor<Separable> + ProvedFor<Damped>,
    {
        if !(1..=MAX_PAIRS).contains(&pairs) {
            return Err(Error::FlowParameter {
                what: "number of pairs of a corrector",
                index: 0,
                value: f64::from(pairs),
                range: "from 1 to 8",
            });
        }
        let m = pairs as usize;
        let places: Vec<f64> = (1..=pairs).map(|i| SPACING * f64::from(i)).collect();
        let weights = weights(&places, &end_terms(m, &kicks(method)));
        let both = |i: usize, sign: f64| (sign * places[i], sign * weights[i]);
        let before = (0..m).rev().map(|i| both(i, -1.0));
        Ok(Self {
            pairs: before.chain((0..m).map(|i| both(i, 1.0))).collect(),
            drift,
            kick,
        })
    }

    /// `C⁻¹`: the state in the variables of the kernel, for the start of a run with steps of size `step_size`.
    ///
    /// # Errors
    ///
    /// [`Error::Core`] with `StepSize`, `Dimension` or `NonFiniteState`. If a flow fails, for example because it cannot go backward,
    /// [`Error::Flow`], or [`Error::Core`] with `NonFinite`, both of step 0.
    pub fn to_kernel<V>(&mut self, state: &State<V>, step_size: f64) -> Result<State<V>, Error>
    where
        V: Vector<Scalar = f64>,
        A: Flow<V>,
        B: Flow<V>,
    {
        self.corrected(state, step_size, true)
    }

    /// `C`: transforms a state in the variables of the kernel back.
    ///
    /// # Errors
    ///
    /// Those of [`to_kernel`](Self::to_kernel).
    pub fn from_kernel<V>(&mut self, state: &State<V>, step_size: f64) -> Result<State<V>, Error>
    where
        V: Vector<Scalar = f64>,
        A: Flow<V>,
        B: Flow<V>,
    {
        self.corrected(state, step_size, false)
    }

    fn corrected<V>(&mut self, state: &State<V>, h: f64, inverse: bool) -> Result<State<V>, Error>
    where
        V: Vector<Scalar = f64>,
        A: Flow<V>,
        B: Flow<V>,
    {
        check_step_size(h)?;
        check_state(state.time, &state.q, &state.p, state.q.dimension())?;
        let mut found = state.clone();
        let outcome = self.pass(&mut found, h, inverse);
        let span = Span {
            time: state.time,
            size: h,
        };
        outcome
            .and_then(|()| check_end(state.q.dimension(), &found))
            .map_err(|failure| failed(failure, span, 0))?;
        Ok(found)
    }

    /// Applies all pairs. The drift back from one `a_i` and the drift to the next are merged.
    fn pass<V>(&mut self, state: &mut State<V>, h: f64, inverse: bool) -> Result<(), FlowError>
    where
        V: Vector<Scalar = f64>,
        A: Flow<V>,
        B: Flow<V>,
    {
        let State { time, q, p } = state;
        let mut reached = 0.0;
        for k in 0..self.pairs.len() {
            let (place, weight) = match inverse {
                true => {
                    let (place, weight) = self.pairs[self.pairs.len() - 1 - k];
                    (place, -weight)
                }
                false => self.pairs[k],
            };
            let (from, to) = (*time + reached * h, *time + place * h);
            self.drift.flow(way(from, (place - reached) * h), q, p)?;
            self.kick.flow(Span::about(to, weight * h), q, p)?;
            reached = place;
        }
        self.drift
            .flow(way(*time + reached * h, -reached * h), q, p)
    }
}

const fn way(time: f64, size: f64) -> Span {
    Span { time, size }
}

/// The kicks `(w_j, c_j)` of a method in a step of size 1.
fn kicks<M: Splits + ProvedFor<Damped>>(method: M) -> Vec<(f64, f64)> {
    struct Still;
    struct Kicks(Vec<(f64, f64)>);
    type Place = nalgebra::Vector1<f64>;

    impl Flow<Place> for Still {
        fn flow(&mut self, _: Span, _: &mut Place, _: &mut Place) -> Result<(), FlowError> {
            Ok(())
        }
    }

    impl Flow<Place> for Kicks {
        fn flow(&mut self, span: Span, _: &mut Place, _: &mut Place) -> Result<(), FlowError> {
            self.0.push((span.size, span.middle()));
            Ok(())
        }
    }

    let mut step = Splitting::new(method, Still, Kicks(Vec::new()));
    let (mut q, mut p) = (Place::zeros(), Place::zeros());
    // Neither flow fails.
    let _ = step.flow(way(0.0, 1.0), &mut q, &mut p);
    step.kick.0
}

/// `−1/(2k) Σ_j w_j B_{2k}(c_j)` for k = 1, …, m.
fn end_terms(m: usize, kicks: &[(f64, f64)]) -> Vec<f64> {
    let mut terms = vec![0.0; m];
    for &(weight, place) in kicks {
        let values = bernoulli(2 * m, place);
        for (k, term) in (1..).zip(&mut terms) {
            *term -= weight * values[2 * k] / (2 * k) as f64;
        }
    }
    terms
}

/// `B_0(x)` to `B_last(x)`, by `Σ_{k ≤ n} (n+1 over k) B_k(x) = (n + 1) xⁿ`.
fn bernoulli(last: usize, x: f64) -> Vec<f64> {
    let (mut values, mut power) = (Vec::with_capacity(last + 1), 1.0);
    for n in 0..=last {
        let next = (n + 1) as f64;
        let (mut binomial, mut sum) = (1.0, 0.0);
        for (k, value) in values.iter().enumerate() {
            sum += binomial * value;
            binomial *= (n + 1 - k) as f64 / (k + 1) as f64;
        }
        values.push(power - sum / next);
        power *= x;
    }
    values
}

/// The solution b of `2 Σ_i b_i a_i^{2k−1} = terms_k`, by the Lagrange polynomials in a².
fn weights(places: &[f64], terms: &[f64]) -> Vec<f64> {
    let others = |place: f64| places.iter().filter(move |&&other| other != place);
    let weight = |&place: &f64| {
        let mut polynomial = vec![1.0];
        for &other in others(place) {
            let (root, distance) = (other * other, place * place - other * other);
            polynomial.push(0.0);
            for k in (0..polynomial.len()).rev() {
                let below = if k == 0 { 0.0 } else { polynomial[k - 1] };
                polynomial[k] = (below - root * polynomial[k]) / distance;
            }
        }
        let sum: f64 = polynomial.iter().zip(terms).map(|(c, term)| c * term).sum();
        sum / (2.0 * place)
    };
    places.iter().map(weight).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bernoulli_polynomials_have_their_values() {
        let zero = bernoulli(8, 0.0);
        let known = [
            1.0,
            -1.0 / 2.0,
            1.0 / 6.0,
            0.0,
            -1.0 / 30.0,
            0.0,
            1.0 / 42.0,
            0.0,
            -1.0 / 30.0,
        ];
        let middle = bernoulli(8, 0.5);
        for n in 0..=8 {
            assert!((zero[n] - known[n]).abs() < 1e-15, "{n}");
            let at_middle = (2.0_f64.powi(1 - n as i32) - 1.0) * known[n];
            assert!((middle[n] - at_middle).abs() < 1e-15, "{n}");
        }
    }

    /// For drift–kick–drift, the third-order corrector of Wisdom, Holman & Touma has a = √(7/40), b = 1/(48 a).
    #[test]
    fn the_third_order_corrector_has_the_weights_of_the_paper() {
        let place = (7.0_f64 / 40.0).sqrt();
        let terms = end_terms(1, &[(1.0, 0.5)]);
        assert!((weights(&[place], &terms)[0] * 48.0 * place - 1.0).abs() < 1e-15);
    }
}
