//! It runs, and as well as with the standard library.

use symplectic::Error;
use symplectic_no_std::{Gauss4, StoermerVerlet, TripleJump, energy_error, momentum_of_a_ring};

#[test]
fn a_pendulum_keeps_its_energy() -> Result<(), Error> {
    let verlet = energy_error(StoermerVerlet, 1.0, 0.1)?;
    assert!(verlet > 1e-4 && verlet < 1e-2, "{verlet:e}");
    let jump = energy_error(TripleJump, 1.0, 0.1)?;
    assert!(jump > 1e-12 && jump < 1e-5, "{jump:e}");
    let gauss = energy_error(Gauss4, 1.0, 0.1)?;
    assert!(gauss < 1e-12, "{gauss:e}");
    // Where there is no pendulum there is an error.
    assert!(matches!(
        energy_error(Gauss4, 1.0, f64::NAN),
        Err(Error::StepSize { .. })
    ));
    Ok(())
}

#[test]
fn a_ring_keeps_its_momentum() -> Result<(), Error> {
    let momentum = momentum_of_a_ring(2000)?;
    assert!((momentum - 1.0).abs() < 1e-13, "{momentum:e}");
    Ok(())
}
