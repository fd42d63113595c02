//! Peers: the classical Runge–Kutta method, and the crates `ode_solvers` and `differential-equations`, abbreviated
//! `diff-equations`.

use differential_equations::methods::{ExplicitRungeKutta, SymplecticIntegrator};
use differential_equations::prelude::{IVP, Solution};
use symplectic::nalgebra::SVector;
use symplectic::{State, Vector};
use symplectic_report::{Finish, Ladder, Observe, Problem};
use symplectic_tests::peers::{Equations, dop853};

/// Largest number of steps of a peer with step size control, about a second; beyond it the run counts as failed. No
/// problem here needs that many, but in a close encounter a loose tolerance leads to ever shorter steps.
const MAX_STEPS: usize = 500_000;

/// Largest number of steps of a peer with a given step size.
const MAX_EQUAL_STEPS: usize = 100_000_000;

/// A start with `N` components, as an array for the peers.
struct Begin<V, const M: usize> {
    start: State<V>,
    values: [f64; M],
    end: f64,
}

impl<V: Vector<Scalar = f64>, const M: usize> Begin<V, M> {
    fn new(start: &State<V>, end: f64) -> Self {
        let values = start.q.as_slice().iter().chain(start.p.as_slice());
        let mut filled = [0.0; M];
        for (place, value) in filled.iter_mut().zip(values) {
            *place = *value;
        }
        Self {
            start: start.clone(),
            values: filled,
            end,
        }
    }

    /// The state with these values; an error if a crate returns another number of values.
    fn state(&self, time: f64, values: &[f64]) -> Result<State<V>, String> {
        let half = self.start.q.dimension();
        let (q, p) = values.split_at(half.min(values.len()));
        State::from_slices(time, q, p).map_err(|error| error.to_string())
    }
}

/// Adds the peers to a problem with `N` components. `M = 2N` is a parameter because stable Rust cannot compute it.
pub fn with_peers<V, S, const N: usize, const M: usize>(
    problem: Problem<V, S>,
    system: &S,
    start: &State<V>,
    end: f64,
    step_size: f64,
) -> Problem<V, S>
where
    V: Vector<Scalar = f64>,
    S: symplectic::System<V> + symplectic::System<SVector<f64, N>> + Clone + 'static,
{
    let ladder = Ladder::Descend { first: step_size };
    let equations = || Equations::<S, N>(system.clone());
    let begin = || Begin::<V, M>::new(start, end);
    let (first, second) = ((equations(), begin()), (equations(), begin()));
    with_rk4(problem, system, start, end, ladder)
        .peer(
            "DOP853 (ode_solvers)",
            Ladder::decades(2, 14),
            move |tolerance, observe| ode_solvers(&first.0, &first.1, tolerance, observe),
        )
        .peer(
            "DOP853 (diff-equations)",
            Ladder::decades(2, 14),
            move |tolerance, _observe| differential_equations(&second.0, &second.1, tolerance),
        )
}

/// Adds Forest–Ruth from `differential-equations`, for separable systems.
pub fn with_forest_ruth<V, S, const N: usize, const M: usize>(
    problem: Problem<V, S>,
    system: &S,
    start: &State<V>,
    end: f64,
    step_size: f64,
) -> Problem<V, S>
where
    V: Vector<Scalar = f64>,
    S: symplectic::System<V> + symplectic::System<SVector<f64, N>> + Clone + 'static,
{
    let (equations, begin) = (
        Equations::<S, N>(system.clone()),
        Begin::<V, M>::new(start, end),
    );
    let ladder = Ladder::Descend { first: step_size };
    let name = "Forest–Ruth (diff-equations)";
    problem.peer(name, ladder, move |step_size, _observe| {
        let method = SymplecticIntegrator::ruth_forest(step_size).max_steps(MAX_EQUAL_STEPS);
        let problem = IVP::hamiltonian(&equations, 0.0, begin.end, begin.values).method(method);
        let solution = problem.t_eval([begin.end]).solve();
        finish(&begin, solution.map_err(|error| format!("{error:?}"))?)
    })
}

/// DOP853 from `ode_solvers`, with the same relative and absolute tolerance.
fn ode_solvers<V, S, const N: usize, const M: usize>(
    equations: &Equations<S, N>,
    begin: &Begin<V, M>,
    tolerance: f64,
    observe: Option<Observe<'_, V>>,
) -> Result<Finish<V>, String>
where
    V: Vector<Scalar = f64>,
    S: symplectic::System<SVector<f64, N>>,
{
    let (start, most_steps) = (begin.values, MAX_STEPS as u32);
    let mut solver = dop853(equations, start, begin.end, tolerance, most_steps);
    let statistics = solver.integrate().map_err(|error| error.to_string())?;
    if let Some(observe) = observe {
        for (time, y) in solver.x_out().iter().zip(solver.y_out()) {
            observe(&begin.state(*time, y.as_slice())?);
        }
    }
    let last = solver.y_out().last().ok_or("it hands back no state")?;
    let steps = u64::from(statistics.accepted_steps) + u64::from(statistics.rejected_steps);
    let evaluations = 2 * u64::from(statistics.num_eval);
    Ok(Finish::explicit(
        begin.state(begin.end, last.as_slice())?,
        Some(steps),
        evaluations,
    ))
}

/// DOP853 from `differential-equations`, with the same relative and absolute tolerance.
fn differential_equations<V, S, const N: usize, const M: usize>(
    equations: &Equations<S, N>,
    begin: &Begin<V, M>,
    tolerance: f64,
) -> Result<Finish<V>, String>
where
    V: Vector<Scalar = f64>,
    S: symplectic::System<SVector<f64, N>>,
{
    let method = ExplicitRungeKutta::dop853()
        .rtol(tolerance)
        .atol(tolerance)
        .max_steps(MAX_STEPS);
    let problem = IVP::ode(equations, 0.0, begin.end, begin.values).method(method);
    let solution = problem.t_eval([begin.end]).solve();
    finish(begin, solution.map_err(|error| format!("{error:?}"))?)
}

fn finish<V: Vector<Scalar = f64>, const M: usize>(
    begin: &Begin<V, M>,
    solution: Solution<f64, [f64; M]>,
) -> Result<Finish<V>, String> {
    let (_, last) = solution.last().map_err(|error| error.to_string())?;
    let steps = (solution.steps.accepted + solution.steps.rejected) as u64;
    let evaluations = 2 * solution.evals.function as u64;
    Ok(Finish::explicit(
        begin.state(begin.end, last)?,
        Some(steps),
        evaluations,
    ))
}

/// Adds the classical Runge–Kutta method of order 4.
pub fn with_rk4<V, S>(
    problem: Problem<V, S>,
    system: &S,
    start: &State<V>,
    end: f64,
    ladder: Ladder,
) -> Problem<V, S>
where
    V: Vector<Scalar = f64>,
    S: symplectic::System<V> + Clone + 'static,
{
    let (system, start) = (system.clone(), start.clone());
    problem.peer("RK4", ladder, move |step_size, observe| {
        Ok(rk4(&system, &start, end, step_size, observe))
    })
}

/// The classical Runge–Kutta method with equal steps of at most `step_size`.
fn rk4<V, S>(
    system: &S,
    start: &State<V>,
    end: f64,
    step_size: f64,
    mut observe: Option<Observe<'_, V>>,
) -> Finish<V>
where
    V: Vector<Scalar = f64>,
    S: symplectic::System<V>,
{
    let steps = ((end - start.time) / step_size - 1e-9).ceil().max(1.0) as u64;
    let h = (end - start.time) / steps as f64;
    let mut state = start.clone();
    let (mut stage, mut sum) = (start.clone(), start.clone());
    let mut slope = (start.q.zeros_like(), start.q.zeros_like());
    for step in 0..steps {
        let time = start.time + step as f64 * h;
        stage.clone_from(&state);
        sum.clone_from(&state);
        // The next stage lies h·ahead along the slope of this stage, whose weight is h·weight/6.
        for (node, weight, ahead) in [
            (0.0, 1.0, 0.5),
            (0.5, 2.0, 0.5),
            (0.5, 2.0, 1.0),
            (1.0, 1.0, 0.0),
        ] {
            let at = time + node * h;
            system.velocity(at, &stage.q, &stage.p, &mut slope.0);
            system.force(at, &stage.q, &stage.p, &mut slope.1);
            for (slope, stage, state, sum) in [
                (&slope.0, &mut stage.q, &state.q, &mut sum.q),
                (&slope.1, &mut stage.p, &state.p, &mut sum.p),
            ] {
                let slope = slope.as_slice().iter();
                let stages = stage.as_mut_slice().iter_mut().zip(state.as_slice());
                for ((slope, (stage, state)), sum) in slope.zip(stages).zip(sum.as_mut_slice()) {
                    *stage = state + ahead * h * slope;
                    *sum += weight * h / 6.0 * slope;
                }
            }
        }
        std::mem::swap(&mut state, &mut sum);
        state.time = start.time + (step + 1) as f64 * h;
        if let Some(observe) = &mut observe {
            observe(&state);
        }
    }
    Finish::explicit(state, Some(steps), 8 * steps)
}

#[cfg(test)]
mod tests {
    use super::*;
    use symplectic_tests::order::ObservedOrder;
    use symplectic_tests::scenes::henon_heiles::{HenonHeiles, start};

    #[test]
    fn the_classical_method_has_order_4_and_shows_its_states() {
        let run = |step_size| {
            let mut times = Vec::new();
            let mut observe = |state: &State<SVector<f64, 2>>| times.push(state.time);
            let end = rk4(&HenonHeiles, &start(), 8.0, step_size, Some(&mut observe)).state;
            assert_eq!(times.len() as f64, 8.0 / step_size);
            assert_eq!(times.last(), Some(&8.0));
            end
        };
        let exact = run(1.0 / 512.0);
        let error = |h| (h, (run(h).q - exact.q).norm());
        let order = ObservedOrder::of(&[1.0 / 16.0, 1.0 / 32.0, 1.0 / 64.0].map(error));
        assert!(order.shows(4.0, 0.1), "{order}");
    }

    #[test]
    fn peers_end_at_the_same_state() {
        let begin = Begin::<SVector<f64, 2>, 4>::new(&start(), 8.0);
        let equations = Equations::<_, 2>(HenonHeiles);
        let first = ode_solvers(&equations, &begin, 1e-11, None).expect("it is not stiff");
        let second = differential_equations(&equations, &begin, 1e-11).expect("it is not stiff");
        let third = rk4(&HenonHeiles, &start(), 8.0, 1e-3, None);
        for other in [&second, &third] {
            assert!(
                (first.state.q - other.state.q).norm() < 1e-9,
                "{first:?} {other:?}"
            );
            assert!(
                (first.state.p - other.state.p).norm() < 1e-9,
                "{first:?} {other:?}"
            );
        }
        assert!(first.evaluations > 100 && second.evaluations > 100);
    }
}
