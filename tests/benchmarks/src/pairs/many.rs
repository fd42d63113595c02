//! The long chain: lanes along the components.

use symplectic::nalgebra::DVector;
use symplectic::solver::FixedPoint;
use symplectic::{Compensated, Integrator, Method, Plain};

use super::{Pair, Problem, TO_ROUNDING, rule};
use crate::baseline::chain::{self, Blocks};
use crate::baseline::chain_no_drift::{DoubleBlocks, NoDrift};
use crate::baseline::explicit::{self, Splitting};
use crate::baseline::gauss::Rule;
use symplectic_tests::methods::{
    BlanesMoanSrkn14a, ForestRuth, Gauss2, Gauss4, Gauss6, Gauss8, Lobatto3, VelocityVerlet,
};
use symplectic_tests::scenes::fput_chain::{FputChain, PARTICLES, start, system};

type Chain = Problem<FputChain, (), DVector<f64>>;

/// Implicit and explicit methods on the chain.
pub(super) fn chain(pairs: &mut Vec<Pair>) {
    let problem = Problem {
        name: "FPUT chain, N = 1024",
        system: system(),
        by_hand: (),
        start: start(PARTICLES),
        step_size: 0.5,
        // To t = 100.
        steps: 200,
        compared: 200,
        tolerance: 1e-14,
        at_once: false,
    };
    problem.implicit(pairs, ("Gauss 8", Gauss8), &rule!(Gauss8), 1.0);
    problem.implicit(pairs, ("Gauss 6", Gauss6), &rule!(Gauss6), 0.6);
    problem.implicit(pairs, ("Gauss 4", Gauss4), &rule!(Gauss4), 0.3);
    problem.implicit(pairs, ("Gauss 2", Gauss2), &rule!(Gauss2), 0.1);
    problem.implicit(pairs, ("Lobatto 3", Lobatto3), &rule!(Lobatto3), 0.1);
    pairs.push(problem.stage_by_stage());
    pairs.push(problem.explicit::<explicit::Verlet, _>(("Verlet", VelocityVerlet), 0.05));
    let forest_ruth = ("Forest–Ruth", ForestRuth);
    pairs.push(problem.explicit::<explicit::ForestRuth, _>(forest_ruth, 0.1));
    let blanes_moan = ("Blanes–Moan SRKN14a", BlanesMoanSrkn14a);
    pairs.push(problem.explicit::<explicit::BlanesMoan, _>(blanes_moan, 0.2));
}

impl Chain {
    fn blocks(&self) -> (Blocks, Blocks) {
        let vectors = [&self.start.q, &self.start.p];
        let [q, p] = vectors.map(|vector| Blocks::new(vector.as_slice()));
        (q, p)
    }

    /// The number of steps of this size to the same end time.
    fn steps_of(&self, step_size: f64) -> u64 {
        (self.steps as f64 * self.step_size / step_size).round() as u64
    }

    /// The hand-written run.
    fn by_hand<const STAGES: usize>(
        &self,
        rule: &Rule<STAGES>,
        step_size: f64,
    ) -> impl Fn(u64) -> Vec<f64> + Clone + use<STAGES> {
        let (begin, tolerance) = (self.blocks(), self.tolerance);
        let by_hand = chain::SecondOrder::<STAGES>::new(rule, PARTICLES, step_size);
        move |steps| {
            let (mut q, mut p) = begin.clone();
            by_hand.clone().run(&mut q, &mut p, tolerance, steps);
            q.values().chain(p.values()).collect()
        }
    }

    /// A method with `scale` times the step size of the problem: to the tolerance of the hand-written code, to
    /// rounding, and with compensated sums.
    fn implicit<M: Method + Copy, const STAGES: usize>(
        &self,
        pairs: &mut Vec<Pair>,
        method: (&'static str, M),
        rule: &Rule<STAGES>,
        scale: f64,
    ) {
        let (step_size, tolerance) = (scale * self.step_size, self.tolerance);
        let by_hand = self.by_hand(rule, step_size);
        let to_tolerance = self.pair(
            method,
            step_size,
            move |mut integrator: Integrator<_, _, _, Plain>| {
                integrator.set_tolerance(tolerance)?;
                Ok(integrator)
            },
            by_hand.clone(),
        );
        let to_rounding = self.pair(
            method,
            step_size,
            |made: Integrator<_, _, _, Plain>| Ok(made),
            by_hand,
        );
        let (begin, by_hand) = (self.blocks(), NoDrift::new(rule, PARTICLES, step_size));
        let compensated = self.pair(
            method,
            step_size,
            |made: Integrator<_, _, _, Compensated>| Ok(made),
            move |steps| {
                let (q, p) = begin.clone();
                let (mut q, mut p) = (DoubleBlocks::new(q), DoubleBlocks::new(p));
                by_hand
                    .clone()
                    .run((&mut q, &mut p), 1e4 * tolerance, steps);
                q.high.values().chain(p.high.values()).collect()
            },
        );
        let steps = self.steps_of(step_size);
        pairs.push(Pair {
            steps,
            ..to_tolerance
        });
        pairs.push(Pair {
            sums: TO_ROUNDING,
            steps,
            ..to_rounding
        });
        pairs.push(Pair {
            steps,
            ..compensated
        });
    }

    /// The cost of a system that is defined for doubles only.
    fn stage_by_stage(&self) -> Pair {
        let (step_size, tolerance) = (self.step_size, self.tolerance);
        self.pair(
            ("Gauss 8, stage by stage", Gauss8),
            step_size,
            move |mut integrator: Integrator<_, _, _, Plain>| {
                integrator.set_tolerance(tolerance)?;
                Ok(integrator.with_solver(FixedPoint))
            },
            self.by_hand(&rule!(Gauss8), step_size),
        )
    }

    fn explicit<K: Splitting + 'static, M: Method + Copy>(
        &self,
        method: (&'static str, M),
        step_size: f64,
    ) -> Pair {
        let begin = self.blocks();
        let by_hand = move |steps| {
            let (mut q, mut p) = begin.clone();
            chain::explicit::<K>(&mut q, &mut p, step_size, steps);
            q.values().chain(p.values()).collect()
        };
        Pair {
            steps: self.steps_of(step_size),
            ..self.pair(
                method,
                step_size,
                Ok::<Integrator<_, _, _, Plain>, _>,
                by_hand,
            )
        }
    }
}
