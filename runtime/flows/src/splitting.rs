//! Splitting methods with flows in place of drifts and kicks.

use core::marker::PhantomData;

use nalgebra::Vector1;

use super::{Flow, FlowError, Span};
use crate::friction::Damped;
use symplectic_core::inside::{KickDrift, Plan};
use symplectic_core::proved::Splits;
use symplectic_core::solver::{Coefficient, FixedPoint, Outcome, StageStorage};
use symplectic_core::{Method, Plain, ProvedFor, Separable, Summation, System, Vector};

/// A step of a splitting method with the flow of `A` in place of the drift and the flow of `B` in place of the kick.
///
/// The method consists of kicks and drifts; it comes from [`splitting!`](symplectic_core::splitting), [`composition!`](symplectic_core::composition) or the
/// catalogue. The order for `H = A + B` is `M::ORDERS.separable`. If `B = O(ε)` is small, the error is `O(εh^s1 + ε²h^s2 + …)`, with the
/// order `(s1, s2, …)` of the method for perturbed systems. Adjacent flows of the same part are merged, also between the steps of
/// [`flow_through`](Flow::flow_through).
///
/// Methods without kicks and drifts do not compile. Nor do Runge–Kutta–Nyström methods: their order holds only if `A` is quadratic in the
/// momenta and `B` depends on positions only, so that `[B, [B, [B, A]]] = 0`. With `method.accept_lower_order()` they compile.
///
/// ```compile_fail,E0277
/// use symplectic::flow::Splitting;
///
/// symplectic::tableau! { Nystrom { base: mclachlan-atela-1992-order-4-optimal } }
/// let step = Splitting::new(Nystrom, (), ());
/// ```
///
/// ```compile_fail,E0277
/// use symplectic::flow::Splitting;
///
/// symplectic::tableau! { Gauss2 { basis: polynomial(2), nodes: gauss(2) } }
/// let step = Splitting::new(Gauss2, (), ());
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Splitting<M, A, B> {
    method: PhantomData<M>,
    /// The flow in place of the drift.
    pub drift: A,
    /// The flow in place of the kick.
    pub kick: B,
}

impl<M: Method, A, B> Splitting<M, A, B> {
    /// The step of this method with these flows.
    pub fn new(_method: M, drift: A, kick: B) -> Self
    where
        M: Splits + ProvedFor<Damped>,
    {
        Self {
            method: PhantomData,
            drift,
            kick,
        }
    }
}

impl<V: Vector, M: Method, A: Flow<V>, B: Flow<V>> Flow<V> for Splitting<M, A, B> {
    fn flow(&mut self, span: Span, q: &mut V, p: &mut V) -> Result<(), FlowError> {
        self.flow_through(core::iter::once(span), q, p)
    }

    fn flow_through(
        &mut self,
        spans: impl Iterator<Item = Span>,
        q: &mut V,
        p: &mut V,
    ) -> Result<(), FlowError> {
        let mut flows = Flows {
            drift: &mut self.drift,
            kick: &mut self.kick,
            q,
            p,
            step: Span::about(0.0, 0.0),
            drifted: 0.0,
            pending: Pending::NOTHING,
            outcome: Ok(()),
        };
        let mut memory = <M::Separable as Plan>::Memory::<_, Nothing, FixedPoint>::like(&PLACE);
        let [mut a, mut b, mut c, mut d] = [PLACE; 4];
        for span in spans {
            let place = Outcome {
                q: &mut a,
                q_low: &mut b,
                p: &mut c,
                p_low: &mut d,
            };
            (flows.step, flows.drifted) = (span, 0.0);
            M::Separable::take_in_place::<Plain, _, _, FixedPoint, _>(
                span,
                &Nothing,
                &mut memory,
                place,
                &mut flows,
            );
            if flows.outcome.is_err() {
                break;
            }
        }
        flows.take_pending();
        flows.outcome
    }

    fn memory(&mut self, visit: &mut dyn FnMut(&mut u64)) {
        self.drift.memory(visit);
        self.kick.memory(visit);
    }
}

/// The system with one component for which the plan of the method runs. It does nothing: only the coefficients of the plan are needed.
struct Nothing;

const PLACE: Vector1<f64> = Vector1::new(0.0);

impl System<Vector1<f64>> for Nothing {
    type Class = Separable;
    type Solver = FixedPoint;

    fn velocity(&self, _: f64, _: &Vector1<f64>, _: &Vector1<f64>, _: &mut Vector1<f64>) {}

    fn force(&self, _: f64, _: &Vector1<f64>, _: &Vector1<f64>, _: &mut Vector1<f64>) {}
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Part {
    Drift,
    Kick,
}

/// A flow that is not yet taken, because the next one may be of the same part.
#[derive(Clone, Copy, Debug)]
struct Pending {
    part: Part,
    /// The start of a drift, or the middle of a kick.
    time: f64,
    size: f64,
}

impl Pending {
    const NOTHING: Self = Self {
        part: Part::Drift,
        time: 0.0,
        size: 0.0,
    };
}

/// Takes flows in place of the drifts and kicks of a splitting.
struct Flows<'a, V, A, B> {
    drift: &'a mut A,
    kick: &'a mut B,
    q: &'a mut V,
    p: &'a mut V,
    step: Span,
    /// The sum of the drifts so far, as a fraction of the step.
    drifted: f64,
    pending: Pending,
    outcome: Result<(), FlowError>,
}

impl<V: Vector, A: Flow<V>, B: Flow<V>> Flows<'_, V, A, B> {
    /// The next flow, of size `weight` times the step size.
    fn next(&mut self, part: Part, weight: Coefficient) {
        let time = self.step.time + self.drifted * self.step.size;
        let size = self.step.size * weight.double();
        if part == Part::Drift {
            self.drifted += weight.double();
        }
        if self.pending.size != 0.0 && self.pending.part == part {
            self.pending.size += size;
            return;
        }
        self.take_pending();
        self.pending = Pending { part, time, size };
    }

    #[inline(never)]
    fn take_pending(&mut self) {
        let Pending { part, time, size } = core::mem::replace(&mut self.pending, Pending::NOTHING);
        if size == 0.0 || self.outcome.is_err() {
            return;
        }
        let (q, p) = (&mut *self.q, &mut *self.p);
        self.outcome = match part {
            Part::Drift => self.drift.flow(Span { time, size }, q, p),
            Part::Kick => self.kick.flow(Span::about(time, size), q, p),
        };
    }
}

impl<U: Vector, A: Flow<U>, B: Flow<U>> KickDrift for Flows<'_, U, A, B> {
    fn kick<R: Summation, V: Vector>(
        &mut self,
        _h: f64,
        weight: Coefficient,
        _q: &V,
        _force: &V,
        _momentum: (&mut V, &mut V),
    ) {
        self.next(Part::Kick, weight);
    }

    fn drift<R: Summation, V: Vector>(
        &mut self,
        _h: f64,
        weight: Coefficient,
        _velocity: &V,
        _position: (&mut V, &mut V),
    ) {
        self.next(Part::Drift, weight);
    }
}
