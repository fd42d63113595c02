//! Runs of formulas can be stopped.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use symplectic::at_run_time::RunTimeTableau;
use symplectic::nalgebra::DVector;
use symplectic::{Error, Integrator, Method, Separable, State};
use symplectic_formula::{Form, Structure, System};
use symplectic_tape::{Formula, Parameters, Tapes, Values, Watch};

symplectic::tableau! {
    StoermerVerlet { base: stormer-verlet }
    Gauss2 { base: gauss-2 }
}

/// Sets a flag after a number of evaluations.
#[derive(Debug)]
struct Counting(AtomicU64, Arc<AtomicBool>);

impl Watch for Counting {
    fn start(&self) -> f64 {
        0.0
    }

    fn evaluated(&self, elapsed: f64, trajectories: usize) {
        assert!(elapsed >= 0.0 && trajectories == 1);
        let left = self.0.load(Ordering::Relaxed);
        self.0.store(left.saturating_sub(1), Ordering::Relaxed);
        self.1.store(left == 0, Ordering::Relaxed);
    }
}

fn oscillator(evaluations: u64) -> Formula<Separable> {
    let text = "q: [x], p: [px]; H = px^2/2 + x^2/2";
    let mut system = System::read_as(Form::Hamiltonian, "the oscillator", text).expect("a formula");
    let structure = Structure::of(&mut system);
    let tapes = Tapes::new(&mut system, &structure, &Values::of_bodies(1), 0.0).expect("a tape");
    let stop = Arc::new(AtomicBool::new(false));
    let watch: Arc<dyn Watch> = Arc::new(Counting(AtomicU64::new(evaluations), Arc::clone(&stop)));
    Formula::new(Arc::new(tapes), Parameters::none())
        .watched(Some(watch))
        .stopped_by(stop)
}

#[test]
fn a_run_that_is_stopped_keeps_the_state_of_its_last_full_step() {
    let start = || State::new(0.0, DVector::from_element(1, 1.0), DVector::zeros(1));
    let verlet = RunTimeTableau::new(
        "verlet",
        &StoermerVerlet::COEFFICIENTS.into(),
        StoermerVerlet::ORDERS,
    )
    .expect("a method");
    let mut run = Integrator::new(verlet, oscillator(40), start(), 0.1).expect("a run");
    let stopped = run.integrate_to(100.0).expect_err("it is stopped");
    assert!(matches!(stopped, Error::NonFinite { .. }), "{stopped}");
    assert!(
        (3.0..4.5).contains(&run.state().time),
        "{}",
        run.state().time
    );
    assert!((run.state().q[0] - run.state().time.cos()).abs() < 1e-2);
    let mut run = Integrator::new(Gauss2, oscillator(40), start(), 0.1).expect("a run");
    assert!(run.integrate_to(100.0).is_err());
    assert!((run.state().q[0] - run.state().time.cos()).abs() < 1e-3);
    // With enough evaluations it goes to its end.
    let mut run =
        Integrator::new(StoermerVerlet, oscillator(u64::MAX), start(), 0.1).expect("a run");
    assert!(run.integrate_to(100.0).is_ok());
}
