//! Problems with few components: stages in lanes.

use symplectic::nalgebra::SVector;
use symplectic::solver::SimdFixedPoint;
use symplectic::system::SystemInLanes;
use symplectic::{
    Compensated, Error, General, Integrator, Method, Plain, ProvedFor, Separable, State, Summation,
    System,
};
use wide::{f64x2, f64x4, f64x8};

use super::{Pair, Problem, TO_ROUNDING, rule};
use crate::baseline::explicit::{self, Splitting};
use crate::baseline::gauss::{FirstOrder, Rule, SecondOrder};
use crate::baseline::lanes::Lanes;
use crate::baseline::no_drift::{Double, NoDrift, NoDriftGeneral};
use crate::baseline::systems;
use symplectic_tests::methods::{
    BlanesMoanSrkn14a, ForestRuth, Gauss2, Gauss4, Gauss6, Gauss8, Lobatto3, VelocityVerlet,
};

/// An integrator with the default solver.
type Made<M, S, const N: usize, R> = Integrator<M, S, SVector<f64, N>, R>;

/// Sets the tolerance of the hand-written iteration: the largest change of a stage in the last sweep.
fn within<M: Method, S: SystemInLanes<SVector<f64, N>>, const N: usize>(
    tolerance: f64,
    mut made: Made<M, S, N, Plain>,
) -> Result<Made<M, S, N, Plain>, Error> {
    made.set_tolerance(tolerance)?;
    Ok(made)
}

/// Implicit and explicit methods on a separable problem.
pub(super) fn separable<S, B, const N: usize>(
    pairs: &mut Vec<Pair>,
    problem: &Problem<S, B, SVector<f64, N>>,
) where
    S: SystemInLanes<SVector<f64, N>> + System<SVector<f64, N>, Class = Separable> + Copy + 'static,
    B: systems::Separable<N> + Copy + 'static,
{
    problem.gauss::<f64x8, _, 8>(pairs, ("Gauss 8", Gauss8), &rule!(Gauss8), 1.0);
    problem.gauss::<f64x8, _, 6>(pairs, ("Gauss 6", Gauss6), &rule!(Gauss6), 0.6);
    problem.gauss::<f64x4, _, 4>(pairs, ("Gauss 4", Gauss4), &rule!(Gauss4), 0.3);
    problem.gauss::<f64x2, _, 2>(pairs, ("Gauss 2", Gauss2), &rule!(Gauss2), 0.1);
    problem.gauss::<f64x4, _, 3>(pairs, ("Lobatto 3", Lobatto3), &rule!(Lobatto3), 0.1);
    problem.splitting::<explicit::Verlet, _>(pairs, ("Verlet", VelocityVerlet), 0.02);
    problem.splitting::<explicit::ForestRuth, _>(pairs, ("Forest–Ruth", ForestRuth), 0.05);
    let blanes_moan = ("Blanes–Moan SRKN14a", BlanesMoanSrkn14a);
    problem.splitting::<explicit::BlanesMoan, _>(pairs, blanes_moan, 0.4);
}

/// Implicit methods on a problem that is not separable.
pub(super) fn general<S, B, const N: usize>(
    pairs: &mut Vec<Pair>,
    problem: &Problem<S, B, SVector<f64, N>>,
) where
    S: SystemInLanes<SVector<f64, N>> + System<SVector<f64, N>, Class = General> + Copy + 'static,
    B: systems::General<N> + Copy + 'static,
{
    problem.coupled::<f64x8, _, 8>(pairs, ("Gauss 8", Gauss8), &rule!(Gauss8), 1.0);
    problem.coupled::<f64x8, _, 6>(pairs, ("Gauss 6", Gauss6), &rule!(Gauss6), 0.6);
    problem.coupled::<f64x4, _, 4>(pairs, ("Gauss 4", Gauss4), &rule!(Gauss4), 0.3);
    problem.coupled::<f64x2, _, 2>(pairs, ("Gauss 2", Gauss2), &rule!(Gauss2), 0.1);
    problem.coupled::<f64x4, _, 3>(pairs, ("Lobatto 3", Lobatto3), &rule!(Lobatto3), 0.1);
}

impl<S, B, const N: usize> Problem<S, B, SVector<f64, N>>
where
    S: SystemInLanes<SVector<f64, N>> + System<SVector<f64, N>, Class = Separable> + Copy + 'static,
    B: systems::Separable<N> + Copy + 'static,
{
    fn gauss<L: Lanes + 'static, M: Method + Copy, const STAGES: usize>(
        &self,
        pairs: &mut Vec<Pair>,
        method: (&'static str, M),
        rule: &Rule<STAGES>,
        fraction: f64,
    ) {
        let (h, tolerance) = (fraction * self.step_size, self.tolerance);
        let (system, (q, p)) = (self.by_hand, arrays(&self.start));
        let by_hand = SecondOrder::<L, STAGES>::new(rule, h);
        let by_hand = move |steps| {
            let (mut q, mut p) = (q, p);
            by_hand.run(&system, (&mut q, &mut p), tolerance, steps);
            [q, p].concat()
        };
        pairs.push(self.pair(method, h, move |made| within(tolerance, made), by_hand));
        pairs.push(Pair {
            sums: TO_ROUNDING,
            ..self.pair(method, h, |made: Made<M, S, N, Plain>| Ok(made), by_hand)
        });
        let by_hand = NoDrift::<L, STAGES>::new(rule, h);
        pairs.push(self.pair(
            method,
            h,
            |made: Made<M, S, N, Compensated>| Ok(made),
            move |steps| {
                let (mut q, mut p) = (Double::new(q), Double::new(p));
                by_hand.run(&system, (&mut q, &mut p), 1e4 * tolerance, steps);
                [q.high, p.high].concat()
            },
        ));
    }

    fn splitting<K: Splitting + 'static, M: Method + Copy>(
        &self,
        pairs: &mut Vec<Pair>,
        method: (&'static str, M),
        fraction: f64,
    ) {
        let h = fraction * self.step_size;
        let (system, (q, p)) = (self.by_hand, arrays(&self.start));
        let plain = self.pair(
            method,
            h,
            Ok::<Integrator<_, _, _, Plain>, _>,
            move |steps| {
                let (mut q, mut p) = (q, p);
                explicit::run::<K, B, N>(&system, (&mut q, &mut p), h, steps);
                [q, p].concat()
            },
        );
        let compensated = self.pair(
            method,
            h,
            Ok::<Integrator<_, _, _, Compensated>, _>,
            move |steps| {
                let (mut q, mut p) = (Double::new(q), Double::new(p));
                explicit::run_compensated::<K, B, N>(&system, (&mut q, &mut p), h, steps);
                [q.high, p.high].concat()
            },
        );
        pairs.extend([plain, compensated].map(|pair| Pair {
            same_arithmetic: true,
            ..pair
        }));
    }
}

impl<S, B, const N: usize> Problem<S, B, SVector<f64, N>>
where
    S: SystemInLanes<SVector<f64, N>> + System<SVector<f64, N>, Class = General> + Copy + 'static,
    B: systems::General<N> + Copy + 'static,
{
    fn coupled<L: Lanes + 'static, M: Method + Copy + ProvedFor<General>, const STAGES: usize>(
        &self,
        pairs: &mut Vec<Pair>,
        method: (&'static str, M),
        rule: &Rule<STAGES>,
        fraction: f64,
    ) {
        let (h, tolerance) = (fraction * self.step_size, self.tolerance);
        let (system, (q, p)) = (self.by_hand, arrays(&self.start));
        let by_hand = FirstOrder::<L, STAGES>::new(rule, h);
        let by_hand = move |steps| {
            let (mut q, mut p) = (q, p);
            by_hand.run(&system, (&mut q, &mut p), tolerance, steps);
            [q, p].concat()
        };
        pairs.push(self.coupled_pair(method, h, move |made| within(tolerance, made), by_hand));
        pairs.push(Pair {
            sums: TO_ROUNDING,
            ..self.coupled_pair::<M, Plain>(method, h, Ok, by_hand)
        });
        let by_hand = NoDriftGeneral::<L, STAGES>::new(rule, h);
        pairs.push(
            self.coupled_pair::<M, Compensated>(method, h, Ok, move |steps| {
                let (mut q, mut p) = (Double::new(q), Double::new(p));
                by_hand.run(&system, (&mut q, &mut p), steps);
                [q.high, p.high].concat()
            }),
        );
    }

    /// A pair that iterates positions and momenta at once or in turn.
    fn coupled_pair<M: Method + Copy + ProvedFor<General>, R: Summation>(
        &self,
        method: (&'static str, M),
        step_size: f64,
        set: impl Fn(Made<M, S, N, R>) -> Result<Made<M, S, N, R>, Error> + 'static,
        baseline: impl Fn(u64) -> Vec<f64> + 'static,
    ) -> Pair {
        if self.at_once {
            self.pair(method, step_size, set, baseline)
        } else {
            let in_turn = move |made| Ok(set(made)?.with_solver(SimdFixedPoint));
            self.pair(method, step_size, in_turn, baseline)
        }
    }
}

fn arrays<const N: usize>(state: &State<SVector<f64, N>>) -> ([f64; N], [f64; N]) {
    (state.q.data.0[0], state.p.data.0[0])
}
