//! Symplectic correctors: the error of first order in ε is gone from both ends of a run.

use symplectic::flow::kepler::Jacobi;
use symplectic::flow::{Corrector, Error, FlowError, FlowSteps, OrnsteinUhlenbeck, Splitting};
use symplectic::friction::Damped;
use symplectic::nalgebra::Vector1;
use symplectic::proved::{Splits, SymmetricFor};
use symplectic::{ProvedFor, Separable, State};

use super::methods::{Leapfrog, Saba3};
use super::planets::{self, Bodies, N};
use super::splittings::{END, Quartic, Rotation, exact, near, start};
use crate::common::distance;
use crate::common::methods::StoermerVerlet;

/// The errors that are odd and even in ε, with this many pairs, or without a corrector.
fn by_powers<M>(method: M, pairs: u32, small: f64, steps: u32) -> Result<[f64; 2], Error>
where
    M: Copy + Splits + SymmetricFor<Separable> + ProvedFor<Damped>,
{
    let errors = [small, -small].map(|small| {
        let step = Splitting::new(method, Rotation, Quartic(small));
        let size = END / f64::from(steps);
        let mut corrector = Corrector::new(method, Rotation, Quartic(small), pairs.max(1))?;
        let start = match pairs {
            0 => start(),
            _ => corrector.to_kernel(&start(), size)?,
        };
        let mut run = FlowSteps::run(step, start, size)?;
        let end = run.integrate_to(END)?;
        let end = match pairs {
            0 => end.clone(),
            _ => corrector.from_kernel(end, size)?,
        };
        let exact = exact(0.0, small);
        Ok::<_, Error>([end.q - exact.q, end.p - exact.p])
    });
    let [plus, minus] = errors;
    let (plus, minus) = (plus?, minus?);
    Ok([-1.0, 1.0].map(|sign| {
        let parts = [0, 1].map(|k| (plus[k] + minus[k] * sign)[0].abs() / 2.0);
        parts[0].hypot(parts[1])
    }))
}

#[test]
fn the_order_in_the_small_part_is_raised() -> Result<(), Error> {
    fn slope<M>(method: M, pairs: u32, power: usize, steps: u32) -> Result<f64, Error>
    where
        M: Copy + Splits + SymmetricFor<Separable> + ProvedFor<Damped>,
    {
        let small = [1e-4, 1e-2][power];
        let error = |steps| Ok::<_, Error>(by_powers(method, pairs, small, steps)?[power]);
        let fine = error(2 * steps)?;
        assert!(fine > 1e-14, "{fine:e}");
        Ok((error(steps)? / fine).log2())
    }
    near(slope(StoermerVerlet, 0, 0, 20)?, 2.0);
    near(slope(StoermerVerlet, 1, 0, 20)?, 4.0);
    near(slope(StoermerVerlet, 2, 0, 16)?, 6.0);
    near(slope(Leapfrog, 1, 0, 20)?, 4.0);
    near(slope(Leapfrog, 2, 0, 16)?, 6.0);
    // That with ε² stays.
    near(slope(Leapfrog, 2, 1, 20)?, 2.0);
    // Of order 6 without a corrector.
    near(slope(Saba3, 3, 0, 10)?, 8.0);
    Ok(())
}

#[test]
fn the_kernel_is_left_as_it_was_entered() -> Result<(), Error> {
    for pairs in 1..=8 {
        let mut corrector = Corrector::new(StoermerVerlet, Rotation, Quartic(0.3), pairs)?;
        for size in [0.2, -0.3] {
            let kernel = corrector.to_kernel(&start(), size)?;
            assert!(distance(&kernel, &start()) > 1e-5);
            assert!(distance(&corrector.from_kernel(&kernel, size)?, &start()) < 1e-14);
        }
    }
    Ok(())
}

fn energy(masses: [f64; N], state: &State<Bodies>) -> f64 {
    let mut energy = 0.0;
    for i in 0..N {
        energy += state.p.column(i).norm_squared() / (2.0 * masses[i]);
        for j in 0..i {
            let apart = (state.q.column(i) - state.q.column(j)).norm();
            energy -= planets::G * masses[i] * masses[j] / apart;
        }
    }
    energy
}

/// Three planets, 20 steps in the shortest period: the error of the energy falls by about ε, 10⁻³.
#[test]
fn planets_keep_their_energy() -> Result<(), Error> {
    let masses = planets::masses(1e-3);
    let inertial = planets::start(masses);
    let system = Jacobi::new(planets::G, &masses)?;
    let start = system.from_inertial(&inertial)?;
    let size = 0.05;
    let worst = |pairs: Option<u32>| -> Result<f64, Error> {
        let step = Splitting::new(Leapfrog, system.drift(), system.kick());
        let mut corrector =
            Corrector::new(Leapfrog, system.drift(), system.kick(), pairs.unwrap_or(1))?;
        let kernel = match pairs {
            Some(_) => corrector.to_kernel(&start, size)?,
            None => start.clone(),
        };
        let mut run = FlowSteps::run(step, kernel, size)?;
        let (before, mut worst) = (energy(masses, &inertial), 0.0_f64);
        for _ in 0..400 {
            let state = run.step()?;
            let state = match pairs {
                Some(_) => corrector.from_kernel(state, size)?,
                None => state.clone(),
            };
            let energy = energy(masses, &system.to_inertial(&state)?);
            worst = worst.max((energy / before - 1.0).abs());
        }
        Ok(worst)
    };
    // The book has these errors.
    for (pairs, expected) in [
        (None, 1.0e-6),
        (Some(1), 5e-8),
        (Some(2), 6e-9),
        (Some(4), 1.4e-9),
    ] {
        let error = worst(pairs)?;
        assert!((error / expected - 1.0).abs() < 0.1, "{pairs:?}: {error:e}");
    }
    let corrected = worst(Some(6))?;
    assert!(corrected < 9e-9, "{corrected:e}");
    Ok(())
}

#[test]
fn bad_input_is_refused() -> Result<(), Error> {
    for pairs in [0, 9] {
        let refused = Corrector::new(StoermerVerlet, Rotation, Quartic(0.3), pairs).err();
        assert!(matches!(refused, Some(Error::FlowParameter { .. })));
    }
    let mut corrector = Corrector::new(StoermerVerlet, Rotation, Quartic(0.3), 2)?;
    let nowhere = State::from_arrays(0.0, [f64::NAN], [0.0]);
    assert!(matches!(
        corrector.to_kernel(&nowhere, 0.1),
        Err(Error::Core(symplectic::Error::NonFiniteState { .. }))
    ));
    assert_eq!(
        corrector.to_kernel(&start(), 0.0),
        Err(Error::Core(symplectic::Error::StepSize { value: 0.0 }))
    );
    // From far away the kicks overflow.
    let far = State::new(0.0, Vector1::new(1e200), Vector1::new(0.0));
    assert!(matches!(
        corrector.to_kernel(&far, 0.1),
        Err(Error::Core(symplectic::Error::NonFinite { step: 0, .. }))
    ));
    let bath = OrnsteinUhlenbeck::new(0.5, 1.0, [1.0], 3)?;
    let mut bath = Corrector::new(StoermerVerlet, Rotation, bath, 2)?;
    let refused = bath.to_kernel(&start(), 0.1);
    assert!(matches!(
        refused,
        Err(Error::Flow {
            failure: FlowError::Backward { .. },
            ..
        })
    ));
    Ok(())
}
