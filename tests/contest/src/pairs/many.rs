//! The long chain: lanes along the components, with plain sums.

use symplectic::nalgebra::DVector;
use symplectic::{Integrator, Method, Plain};

use super::{Pair, Problem, TO_ROUNDING, rule};
use crate::baseline::chain::{self, Blocks};
use crate::baseline::explicit::{self, Splitting};
use symplectic_tests::methods::{BlanesMoanSrkn14a, ForestRuth, Gauss8, VelocityVerlet};
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
    let Problem {
        step_size,
        tolerance,
        ..
    } = problem;
    let begin = problem.blocks();
    let by_hand = chain::SecondOrder::<8>::new(&rule!(Gauss8), PARTICLES, step_size);
    let by_hand = move |steps| {
        let (mut q, mut p) = begin.clone();
        let mut by_hand = by_hand.clone();
        by_hand.run(&mut q, &mut p, tolerance, steps);
        q.values().chain(p.values()).collect()
    };
    pairs.push(problem.pair(
        ("Gauss 8", Gauss8),
        step_size,
        move |mut integrator: Integrator<_, _, _, Plain>| {
            integrator.set_tolerance(tolerance)?;
            integrator.in_second_order_lanes()
        },
        by_hand.clone(),
    ));
    pairs.push(Pair {
        sums: TO_ROUNDING,
        ..problem.pair(
            ("Gauss 8", Gauss8),
            step_size,
            Integrator::<_, _, _, Plain>::in_second_order_lanes,
            by_hand.clone(),
        )
    });
    pairs.push(problem.pair(
        ("Gauss 8, stage by stage", Gauss8),
        step_size,
        move |mut integrator: Integrator<_, _, _, Plain>| {
            integrator.set_tolerance(tolerance)?;
            Ok(integrator)
        },
        by_hand,
    ));
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

    fn explicit<K: Splitting + 'static, M: Method>(
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
            // To the same time.
            steps: (self.steps as f64 * self.step_size / step_size).round() as u64,
            ..self.pair(
                method,
                step_size,
                Ok::<Integrator<_, _, _, Plain>, _>,
                by_hand,
            )
        }
    }
}
