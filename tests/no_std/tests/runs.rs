//! It runs, and as well as with the standard library.

use symplectic::Error;
use symplectic_no_std::{
    Gauss4, StoermerVerlet, TripleJump, energy_error, impacts, momentum_of_a_ring,
};

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
fn a_pendulum_between_walls_turns_at_them() -> Result<(), Error> {
    // It swings to 1.047 without them; small angles take the time 2 arcsin(angle) from wall to wall at the speed 1.
    assert_eq!(impacts(1.1)?, 0);
    let angle = 0.01_f64;
    let expected = (100.0 + angle.asin()) / (2.0 * angle.asin());
    assert_eq!(impacts(angle)?, expected.floor() as u32);
    Ok(())
}

#[test]
fn a_ring_keeps_its_momentum() -> Result<(), Error> {
    let momentum = momentum_of_a_ring(2000)?;
    assert!((momentum - 1.0).abs() < 1e-13, "{momentum:e}");
    Ok(())
}
