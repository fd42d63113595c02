//! Runs of processed methods.

use std::error::Error;

use symplectic::nalgebra::Vector1;
use symplectic::{
    Event, Integrator, ProcessedIntegrator, State, System, acceleration, composition, splitting,
};

splitting! {
    /// The symplectic Euler method, processed with half a kick: Störmer–Verlet.
    Verlet { kick: [1], drift: [1], processor: [kick: [1/2], drift: [0]] }
}

composition! {
    /// Morales et al. 2025.
    Morales {
        base: velocity-verlet,
        weights: [0.21456475499897766986381219621761, 0.51788649682987924281787142226803, -0.33342207567391682979227850551172,
            0.15757644257569146373033662060461, -0.37307499512657736825709230652023, 0.18372413281145589944261642180363,
            0.1947017706053903224022456342907, 0.21784176681731006074681969186513, -0.55959658767642092190866235003552],
        symmetric: true,
        processor: back_and_forth(-0.44324901019570126590495430949294, 0.25459857192003772850622377066944,
            -0.73862036266779261573694538099739, -0.00024139614958652134370419495289618, 0.73873460354125365739379753874964,
            -0.20285971152536085519251666906017, 0.44989521689676869571827637424046, 0.29538398007876871184026747505657,
            -0.3364996155865700091428329802017, -0.017142276311817526137611624011),
        claim: separable(7),
    }
}

type Place = Vector1<f64>;

fn pendulum() -> impl System<Place, Class = symplectic::Separable> + Clone {
    acceleration(|_, q: &Place, acceleration: &mut Place| acceleration[0] = -q[0].sin())
}

fn start() -> State<Place> {
    State::new(0.0, Vector1::new(1.0), Vector1::new(0.5))
}

/// The state at a time, by small steps of the whole method.
fn fine_state(time: f64) -> Result<State<Place>, symplectic::Error> {
    let mut fine = Integrator::new(Morales, pendulum(), start(), 0.05)?;
    fine.integrate_to(time).cloned()
}

fn distance(one: &State<Place>, other: &State<Place>) -> f64 {
    (one.q - other.q).norm().max((one.p - other.p).norm())
}

#[test]
fn a_run_of_kernel_steps_ends_where_steps_of_the_whole_method_do() -> Result<(), Box<dyn Error>> {
    let mut kernel = ProcessedIntegrator::new(Morales, pendulum(), start(), 0.2)?;
    let mut whole = Integrator::new(Morales, pendulum(), start(), 0.2)?;
    for _ in 0..5 {
        kernel.take_steps(20)?;
        whole.take_steps(20)?;
        assert!(distance(kernel.state(), whole.state()) < 1e-13);
        assert_eq!(kernel.state().time, whole.state().time);
    }
    assert_eq!(kernel.steps(), 100);
    // 17 forces a step and 20 for each of the processors of the start and of two states for each request.
    let [few, many] = [kernel.statistics(), whole.statistics()].map(|x| x.evaluations);
    assert!(2 * few < many, "{few} {many}");
    Ok(())
}

/// The errors at 3.5 and 7 steps in a unit of time are those of an independent program in 50 digits: 1.54223e-10 and 1.52458e-13.
#[test]
fn errors_are_those_of_an_independent_program() -> Result<(), Box<dyn Error>> {
    let end = fine_state(2.0)?;
    let error = |steps: u32| -> Result<f64, Box<dyn Error>> {
        let size = 2.0 / f64::from(steps);
        let mut run = ProcessedIntegrator::new(Morales, pendulum(), start(), size)?;
        Ok(distance(run.take_steps(u64::from(steps))?, &end))
    };
    let coarse = error(7)?;
    assert!((coarse - 1.54223e-10).abs() < 1e-14, "{coarse}");
    let fine = error(14)?;
    assert!((fine - 1.52458e-13).abs() < 5e-15, "{fine}");
    // The kernel alone has an error of order 4.
    let mut alone = ProcessedIntegrator::new(Verlet, pendulum(), start(), 2.0 / 7.0)?;
    assert!(distance(alone.take_steps(7)?, &end) > 1e-4);
    Ok(())
}

#[test]
fn a_run_back_returns_to_its_start_to_rounding() -> Result<(), Box<dyn Error>> {
    let mut run = ProcessedIntegrator::new(Morales, pendulum(), start(), 0.25)?;
    run.take_steps(1000)?;
    run.set_step_size(-0.25)?;
    let end = run.take_steps(1000)?;
    assert_eq!(end.time, 0.0);
    assert!(
        distance(end, &start()) < 1e-13,
        "{}",
        distance(end, &start())
    );
    Ok(())
}

#[test]
fn a_new_step_size_begins_from_the_state_shown() -> Result<(), Box<dyn Error>> {
    let mut run = ProcessedIntegrator::new(Morales, pendulum(), start(), 0.25)?;
    let shown = run.take_steps(10)?.clone();
    run.set_step_size(0.125)?;
    let continued = run.take_steps(20)?.clone();
    let mut other = ProcessedIntegrator::new(Morales, pendulum(), shown.clone(), 0.125)?;
    assert!(distance(&continued, other.take_steps(20)?) < 1e-14);
    // From a new state, too.
    run.set_state(shown)?;
    assert_eq!(distance(run.take_steps(20)?, other.state()), 0.0);
    Ok(())
}

#[test]
fn a_restored_run_continues_with_the_same_bits() -> Result<(), Box<dyn Error>> {
    let new = || ProcessedIntegrator::new(Morales, pendulum(), start(), 0.2);
    let mut run = new()?;
    run.take_steps(7)?;
    let checkpoint = run.checkpoint()?;
    run.take_steps(9)?;
    let mut resumed = new()?;
    resumed.restore(&checkpoint)?;
    resumed.take_steps(9)?;
    assert_eq!(resumed.state(), run.state());
    assert_eq!(resumed.statistics(), run.statistics());
    // Another system is told apart.
    let other =
        acceleration(|_, q: &Place, acceleration: &mut Place| acceleration[0] = -2.0 * q[0].sin());
    let mut other = ProcessedIntegrator::new(Morales, other, start(), 0.2)?;
    assert!(other.restore(&checkpoint).is_err());
    Ok(())
}

#[test]
fn states_inside_a_step_and_events_have_the_order_of_the_whole() -> Result<(), Box<dyn Error>> {
    let mut run = ProcessedIntegrator::new(Morales, pendulum(), start(), 0.25)?;
    run.take_steps(8)?;
    let inside = run.state_at(1.9)?;
    let exact = fine_state(1.9)?;
    assert!(
        distance(&inside, &exact) < 1e-10,
        "{}",
        distance(&inside, &exact)
    );
    // The pendulum passes the lowest point.
    let mut run = ProcessedIntegrator::new(Morales, pendulum(), start(), 0.25)?;
    let lowest = Event::rising(|state: &State<Place>| state.q[0]);
    let (passed, before) = (run.find_event(10.0, &lowest)?, run.statistics().steps);
    let passed = passed.ok_or("no event")?;
    assert!(before > 0 && passed.q[0].abs() < 1e-13);
    let exact = fine_state(passed.time)?;
    assert!(distance(&passed, &exact) < 1e-10);
    Ok(())
}

#[test]
fn a_failed_step_leaves_the_state_unchanged() -> Result<(), Box<dyn Error>> {
    let system = acceleration(|_, q: &Place, acceleration: &mut Place| {
        acceleration[0] = if q[0] > 1.5 { f64::NAN } else { 1.0 };
    });
    let mut run = ProcessedIntegrator::new(Verlet, system, start(), 0.25)?;
    let error = run.take_steps(100).err().ok_or("no error")?;
    assert!(error.to_string().contains("step"), "{error}");
    let reached = run.state().clone();
    assert!(reached.q[0] < 1.5 && reached.q[0] > 1.0 && reached.time == run.steps() as f64 * 0.25);
    assert!(run.step().is_err());
    assert_eq!(run.state(), &reached);
    Ok(())
}
