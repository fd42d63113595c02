//! Splittings that are too long for their matrices to be written out.

use symplectic::{Error, Integrator, Method};
use symplectic_tests::counting::{Counting, Counts};
use symplectic_tests::scenes::kepler;

symplectic::composition! {
    /// 81 steps of Störmer–Verlet.
    TripleJump10 { base: triple-jump-10, max_stages: 82 }
}

const STEPS: u64 = 20;

#[test]
fn a_step_evaluates_as_often_as_it_has_kicks_and_drifts() -> Result<(), Error> {
    let counts = Counts::default();
    let system = Counting::new(kepler::Kepler, &counts);
    let mut integrator = Integrator::new(TripleJump10, system, kepler::start::<f64>(0.2), 0.01)?;
    for _ in 0..STEPS {
        integrator.step()?;
    }
    let found = (counts.forces(), counts.velocities());
    assert_eq!(found, (81 * STEPS + 1, 81 * STEPS));
    Ok(())
}

#[test]
fn matrices_are_made_of_the_weights() {
    let (a, a_tilde) = (TripleJump10::A, TripleJump10::A_TILDE);
    assert_eq!((a[3][2], a[3][3]), (TripleJump10::B[2], 0.0));
    assert_eq!(
        (a_tilde[3][3], a_tilde[3][4]),
        (TripleJump10::B_TILDE[3], 0.0)
    );
    let of = TripleJump10::COEFFICIENTS;
    assert_eq!(of.a[81][80].double(), TripleJump10::B[80]);
    assert_eq!(of.a_tilde[3][3].double(), TripleJump10::B_TILDE[3]);
}
