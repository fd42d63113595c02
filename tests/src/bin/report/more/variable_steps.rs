//! Steps of variable size that keep the structure, in the scenes with close encounters.

use symplectic::adaptive::{AdaptiveSteps, Error, Logarithmic, Monitor};
use symplectic::nalgebra::SVector;
use symplectic::{Event, Hamiltonian, Integrator, Separable, State, Statistics, System};
use symplectic_report::{Finish, Ladder, Observe, Problem};
use symplectic_tests::methods::{Gauss8, KahanLi8Drift};

/// Adds a logarithmic Hamiltonian by Kahan & Li's method and reversible steps of Gauss 8, from the step parameter `first` downward. A
/// state with time as a position has `M = N + 1` components; stable Rust cannot compute M.
pub fn with_variable_steps<S, W, const N: usize, const M: usize>(
    problem: Problem<SVector<f64, N>, S>,
    system: &S,
    monitor: W,
    (start, end): (&State<SVector<f64, N>>, f64),
    first: f64,
) -> Problem<SVector<f64, N>, S>
where
    S: Hamiltonian<Class = Separable, Vector<f64> = SVector<f64, N>>
        + System<SVector<f64, N>, Class = Separable>
        + Copy
        + 'static,
    W: Monitor + Copy + 'static,
{
    let (system, start) = (*system, start.clone());
    let from = start.clone();
    let ladder = || Ladder::Descend { first };
    problem
        .peer(
            "Logarithmic Kahan–Li 8",
            ladder(),
            move |epsilon, observe| {
                let found = logarithmic::<_, N, M>(system, &from, end, epsilon, observe);
                found.map_err(|error| error.to_string())
            },
        )
        .peer("Reversible Gauss 8", ladder(), move |epsilon, observe| {
            let found = reversible(system, monitor, &start, end, epsilon, observe);
            found.map_err(|error| error.to_string())
        })
}

fn logarithmic<S, const N: usize, const M: usize>(
    system: S,
    start: &State<SVector<f64, N>>,
    end: f64,
    epsilon: f64,
    mut observe: Option<Observe<'_, SVector<f64, N>>>,
) -> Result<Finish<SVector<f64, N>>, Error>
where
    S: Hamiltonian<Class = Separable, Vector<f64> = SVector<f64, N>>,
{
    let system = Logarithmic::new(system);
    let extended: State<SVector<f64, M>> = system.extend(start)?;
    let mut run = Integrator::plain(KahanLi8Drift, system, extended, epsilon)?;
    while run.state().q[N] < end {
        run.step()?;
        if let Some(observe) = &mut observe {
            observe(&run.system().reduce(run.state())?);
        }
    }
    // Back to the end.
    run.set_step_size(-epsilon)?;
    let before = run.state().time - 2.0 * epsilon;
    let at_the_end = Event::crossing(|state: &State<SVector<f64, M>>| state.q[N] - end).by_steps();
    let found = run.find_event(before, &at_the_end)?;
    let found = found.as_ref().unwrap_or_else(|| run.state());
    Ok(finish(run.system().reduce(found)?, run.statistics()))
}

fn reversible<S, W, const N: usize>(
    system: S,
    monitor: W,
    start: &State<SVector<f64, N>>,
    end: f64,
    epsilon: f64,
    mut observe: Option<Observe<'_, SVector<f64, N>>>,
) -> Result<Finish<SVector<f64, N>>, Error>
where
    S: System<SVector<f64, N>, Class = Separable>,
    W: Monitor,
{
    let mut run = AdaptiveSteps::run(Gauss8, system, monitor, start.clone(), epsilon)?;
    let state = run.integrate_with(end, |state| {
        if let Some(observe) = &mut observe {
            observe(state);
        }
    })?;
    Ok(finish(state, run.statistics()))
}

fn finish<V>(state: State<V>, statistics: &Statistics) -> Finish<V> {
    Finish {
        state,
        steps: Some(statistics.steps),
        evaluations: statistics.evaluations,
        iterations: statistics.iterations,
        most_iterations: statistics.most_iterations,
    }
}
