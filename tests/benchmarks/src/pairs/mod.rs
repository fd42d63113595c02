//! The library and hand-written integrators on the same problems, with the same methods, steps and sums.

mod few;
mod many;

use symplectic::solver::Solver;
use symplectic::{Error, Integrator, Method, ProvedFor, State, Summation, System, Vector};

use crate::baseline::systems;
use symplectic_tests::measure::largest;
use symplectic_tests::scenes::{
    double_pendulum, fput_springs, henon_heiles, kepler, nonseparable, outer_solar_system,
};

/// A repeatable run with a number of steps; returns the components of the state at its end, q followed by p.
pub type Run = Box<dyn Fn(u64) -> Result<Vec<f64>, Error>>;

/// A method on a problem, by the library and by hand-written code.
pub struct Pair {
    /// The problem.
    pub problem: &'static str,
    /// The method.
    pub method: &'static str,
    /// The summation of increments, `plain` or `compensated`. For implicit methods also `to rounding`: plain sums,
    /// where the library iterates to rounding by default, not to the tolerance of the hand-written iteration.
    pub sums: &'static str,
    /// Whether both use the same arithmetic, so that their states agree to the last bit.
    pub same_arithmetic: bool,
    /// The step size.
    pub step_size: f64,
    /// Number of steps of a whole run, for timing.
    pub steps: u64,
    /// Number of steps after which the states are compared; small, because rounding errors grow, exponentially in
    /// chaotic systems.
    pub compared: u64,
    /// The run of the library.
    pub library: Run,
    /// The run of the hand-written code.
    pub baseline: Run,
}

/// The name of the sums if the library iterates to rounding.
const TO_ROUNDING: &str = "to rounding";

impl Pair {
    /// Problem, method and sums in one line.
    pub fn label(&self) -> String {
        format!("{} | {} | {}", self.problem, self.method, self.sums)
    }

    /// The largest difference of a component after `compared` steps, in units of the largest position or momentum.
    ///
    /// # Errors
    ///
    /// Those of the runs.
    pub fn difference(&self) -> Result<f64, Error> {
        let (found, expected) = (
            (self.library)(self.compared)?,
            (self.baseline)(self.compared)?,
        );
        let dimension = found.len() / 2;
        let mut difference = 0.0;
        for half in [0..dimension, dimension..2 * dimension] {
            let (found, expected) = (&found[half.clone()], &expected[half]);
            let scale = expected.iter().fold(0.0, |a, b| largest(a, b.abs()));
            for (a, b) in found.iter().zip(expected) {
                difference = largest(difference, (a - b).abs() / scale);
            }
        }
        Ok(difference)
    }
}

/// A problem with its start and its steps.
struct Problem<S, B, V> {
    name: &'static str,
    system: S,
    /// The system, written by hand.
    by_hand: B,
    start: State<V>,
    /// The step size of Gauss with eight stages; other methods use fractions of it.
    step_size: f64,
    /// As in [`Pair`], like `compared`.
    steps: u64,
    compared: u64,
    /// Largest final change of a stage in the hand-written iteration; rounding errors are smaller.
    tolerance: f64,
    /// Whether the library iterates positions and momenta at once, like the hand-written code for nonseparable
    /// Hamiltonians.
    at_once: bool,
}

/// All pairs.
pub fn pairs() -> Vec<Pair> {
    let mut pairs = Vec::new();
    few::separable(
        &mut pairs,
        &Problem {
            name: "Kepler, e = 0.6",
            system: kepler::Kepler,
            by_hand: systems::Kepler,
            start: kepler::start(0.6),
            step_size: 0.195,
            // To t = 125.
            steps: 641,
            compared: 128,
            tolerance: 1e-14,
            at_once: false,
        },
    );
    few::separable(
        &mut pairs,
        &Problem {
            name: "outer solar system",
            system: outer_solar_system::OuterSolarSystem,
            by_hand: systems::OuterSolarSystem,
            start: outer_solar_system::start(),
            step_size: 488.0,
            // 500 000 days.
            steps: 1025,
            compared: 20,
            tolerance: 1e-12,
            at_once: false,
        },
    );
    few::separable(
        &mut pairs,
        &Problem {
            name: "Hénon–Heiles",
            system: henon_heiles::HenonHeiles,
            by_hand: systems::HenonHeiles,
            start: henon_heiles::start(),
            step_size: 0.39,
            // To t = 10⁴.
            steps: 25641,
            compared: 100,
            tolerance: 1e-14,
            at_once: false,
        },
    );
    few::separable(
        &mut pairs,
        &Problem {
            name: "FPUT springs, ω = 50",
            system: fput_springs::FputSprings {
                omega: fput_springs::OMEGA,
            },
            by_hand: systems::FputSprings {
                omega: fput_springs::OMEGA,
            },
            start: fput_springs::start(fput_springs::OMEGA),
            step_size: 0.04,
            // To t = 200.
            steps: 5000,
            compared: 100,
            tolerance: 1e-14,
            at_once: false,
        },
    );
    for (name, at_once) in [
        ("double pendulum", true),
        ("double pendulum, in turn", false),
    ] {
        few::general(
            &mut pairs,
            &Problem {
                name,
                system: double_pendulum::DoublePendulum,
                by_hand: systems::DoublePendulum,
                start: double_pendulum::start(),
                step_size: 0.1,
                // To t = 100.
                steps: 1000,
                compared: 100,
                tolerance: 1e-13,
                at_once,
            },
        );
    }
    few::general(
        &mut pairs,
        &Problem {
            name: "(q² + 1)(p² + 1)/2",
            system: nonseparable::Nonseparable,
            by_hand: systems::Nonseparable,
            start: nonseparable::start(),
            step_size: 0.1,
            // To t = 100.
            steps: 1000,
            compared: 100,
            tolerance: 1e-14,
            at_once: true,
        },
    );
    many::chain(&mut pairs);
    pairs
}

impl<S, B, V> Problem<S, B, V>
where
    S: System<V> + Copy + 'static,
    V: Vector<Scalar = f64>,
{
    /// A pair for steps of `step_size`, with an integrator and its solver.
    fn pair<M: Method + Copy + ProvedFor<S::Class>, R: Summation, N: Solver<V, S>>(
        &self,
        method: (&'static str, M),
        step_size: f64,
        solved: impl Fn(Integrator<M, S, V, R>) -> Result<Integrator<M, S, V, R, N>, Error> + 'static,
        baseline: impl Fn(u64) -> Vec<f64> + 'static,
    ) -> Pair {
        let (system, start) = (self.system, self.start.clone());
        let library = move |steps| {
            let start = start.clone();
            let mut integrator = solved(Integrator::with_summation(
                method.1, system, start, step_size,
            )?)?;
            integrator.take_steps(steps)?;
            let State { q, p, .. } = integrator.state();
            Ok([q.as_slice(), p.as_slice()].concat())
        };
        Pair {
            problem: self.name,
            method: method.0,
            sums: if R::COMPENSATED {
                "compensated"
            } else {
                "plain"
            },
            same_arithmetic: false,
            step_size,
            steps: self.steps,
            compared: self.compared,
            library: Box::new(library),
            baseline: Box::new(move |steps| Ok(baseline(steps))),
        }
    }
}

/// The coefficients of a method.
macro_rules! rule {
    ($method:ident) => {
        $crate::baseline::gauss::Rule {
            a: ::symplectic_tests::methods::$method::A,
            a_tilde: ::symplectic_tests::methods::$method::A_TILDE,
            b: ::symplectic_tests::methods::$method::B,
            c: ::symplectic_tests::methods::$method::C,
        }
    };
}
use rule;
