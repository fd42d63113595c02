//! Runs and their measurements.

use std::time::{Duration, Instant};

use symplectic::{Error, Integrator, Method, Separable, State, System, Vector};

use crate::counting::{Counting, Counts};

/// The state at `end`, from `start` in equal steps of at most `step_size`.
///
/// # Errors
///
/// Those of [`Integrator::new`] and [`Integrator::integrate_to`].
pub fn integrate<M, S, V>(
    method: M,
    system: S,
    start: &State<V>,
    end: f64,
    step_size: f64,
) -> Result<State<V>, Error>
where
    M: Method,
    S: System<V, Class = Separable>,
    V: Vector,
{
    let mut integrator = Integrator::new(method, system, start.clone(), step_size)?;
    integrator.integrate_to(end)?;
    Ok(integrator.into_state())
}

/// The distance of two positions in the 2-norm.
pub fn position_error<V: Vector<Scalar = f64>>(found: &State<V>, reference: &State<V>) -> f64 {
    let pairs = found.q.as_slice().iter().zip(reference.q.as_slice());
    pairs.map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The measurements of a run.
#[derive(Clone, Debug)]
pub struct Measurement<V> {
    /// The state at the end.
    pub end: State<V>,
    /// Steps taken.
    pub steps: u64,
    /// Evaluations of the force.
    pub forces: u64,
    /// Evaluations of the velocity.
    pub velocities: u64,
    /// Sweeps of the fixed-point iteration.
    pub sweeps: u64,
    /// The largest relative error of the energy in each quarter of the time.
    pub energy_errors: [f64; 4],
    /// The wall-clock time of the run without observation, the best of three.
    pub time: Duration,
}

impl<V> Measurement<V> {
    /// The largest relative error of the energy over the run.
    pub fn energy_error(&self) -> f64 {
        self.energy_errors.iter().copied().fold(0.0, largest)
    }
}

/// Integrates `system` from `start` to `end` in equal steps of at most `step_size`, with all measurements.
///
/// The energy error of a system without an energy is NaN.
///
/// # Errors
///
/// Those of [`Integrator::new`] and [`Integrator::integrate_to`].
pub fn measure<M, S, V>(
    method: M,
    system: &S,
    start: &State<V>,
    end: f64,
    step_size: f64,
) -> Result<Measurement<V>, Error>
where
    M: Method + Copy,
    S: System<V, Class = Separable> + Clone,
    V: Vector<Scalar = f64>,
{
    let mut time = Duration::MAX;
    for _ in 0..3 {
        let begin = Instant::now();
        integrate(method, system.clone(), start, end, step_size)?;
        time = time.min(begin.elapsed());
    }
    let mut measurement = observe(method, system, start, end, step_size, |_| {})?;
    measurement.time = time;
    Ok(measurement)
}

/// [`measure`] without the time, which is zero; calls `visit` with every state, including the first.
///
/// # Errors
///
/// Those of [`Integrator::new`] and [`Integrator::integrate_to`].
pub fn observe<M, S, V>(
    method: M,
    system: &S,
    start: &State<V>,
    end: f64,
    step_size: f64,
    mut visit: impl FnMut(&State<V>),
) -> Result<Measurement<V>, Error>
where
    M: Method,
    S: System<V, Class = Separable> + Clone,
    V: Vector<Scalar = f64>,
{
    let counts = Counts::default();
    let energy = |state: &State<V>| {
        system
            .energy(state.time, &state.q, &state.p)
            .unwrap_or(f64::NAN)
    };
    let before = energy(start);
    let mut energy_errors = [0.0; 4];
    let mut integrator = Integrator::new(
        method,
        Counting::new(system.clone(), &counts),
        start.clone(),
        step_size,
    )?;
    visit(start);
    integrator.integrate_with(end, |state| {
        // A state at a boundary belongs to the quarter that it ends.
        let quarter = (4.0 * (state.time - start.time) / (end - start.time)).ceil() as usize;
        let error = &mut energy_errors[quarter.clamp(1, 4) - 1];
        *error = largest(*error, ((energy(state) - before) / before).abs());
        visit(state);
    })?;
    Ok(Measurement {
        steps: integrator.steps(),
        sweeps: integrator.iterations(),
        forces: counts.forces(),
        velocities: counts.velocities(),
        energy_errors,
        time: Duration::ZERO,
        end: integrator.into_state(),
    })
}

/// The larger number; NaN if either is NaN.
pub fn largest(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}
