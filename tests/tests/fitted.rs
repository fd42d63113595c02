//! Methods fitted to a frequency: their emitted coefficients against exact ones, and their steps.

use symplectic::at_run_time::{FittedCoefficients, RunTimeTableau, TableauError};
use symplectic::{Integrator, Method, State};
use symplectic_compiler::{Coefficients, Definition, Fitted, Limits};

symplectic::tableau! {
    /// Fitted Lobatto pair.
    FittedLobatto3 { parameters: w, basis: [1, cos(w*t), sin(w*t)], nodes: [0, 1/2, 1] }
    FittedGauss2 { parameters: w, basis: [cos(w*t), sin(w*t)], nodes: gauss(2) }
    pub FittedGauss3 { parameters: omega, basis: [1, cos(omega*t), sin(omega*t)], nodes: gauss(3) }
    FittedLobatto4 { parameters: w, basis: [1, t, cos(w*t), sin(w*t)], nodes: lobatto(4), exchange: true }
    Gauss2 { basis: polynomial(2), nodes: gauss(2) }
}

type Failure = Box<dyn std::error::Error>;

const ALL: [(&str, FittedCoefficients); 4] = [
    (FittedLobatto3::DEFINITION, FittedLobatto3::COEFFICIENTS),
    (FittedGauss2::DEFINITION, FittedGauss2::COEFFICIENTS),
    (FittedGauss3::DEFINITION, FittedGauss3::COEFFICIENTS),
    (FittedLobatto4::DEFINITION, FittedLobatto4::COEFFICIENTS),
];

/// The double as a fraction.
fn fraction(value: f64) -> String {
    const DENOMINATOR: i64 = 1 << 20;
    format!("{}/{DENOMINATOR}", value * DENOMINATOR as f64)
}

/// The largest difference from the correctly rounded coefficients of the method that is derived for the number `nu`, in units in the
/// last place.
fn units(definition: &str, functions: &FittedCoefficients, nu: f64) -> Result<f64, Failure> {
    let fitted = Fitted::derive(&Definition::parse(definition)?, &Limits::default())?;
    let exact = fitted.definition_at(&fraction(nu))?;
    let exact = exact.derive(&Limits::default())?.to_f64();
    let found = functions.at(nu)?;
    let found = Coefficients {
        c: found.c,
        c_tilde: found.c_tilde,
        b: found.b,
        b_tilde: found.b_tilde,
        a: found.a,
        a_tilde: found.a_tilde,
        gradient: found.gradient,
    };
    let difference = |(x, y): &(f64, f64)| (x - y).abs() / (y.next_up() - y).abs().max(1e-30);
    let pairs = found.zip(exact);
    Ok(pairs.iter().map(difference).fold(0.0, f64::max))
}

/// On both sides of the angle up to which series are used, and up to the largest angle.
#[test]
fn coefficients_are_correct_to_two_units() -> Result<(), Failure> {
    for (definition, functions) in &ALL {
        for nu in [
            1.0 / 1024.0,
            0.25,
            1.0,
            1.0 + 1.0 / 1024.0,
            1.75,
            3.5,
            20.5,
            63.25,
            -0.375,
        ] {
            let found = units(definition, functions, nu)?;
            assert!(found <= 2.0, "{definition} at {nu}: {found} units");
        }
    }
    Ok(())
}

#[test]
#[ignore = "thorough"]
fn coefficients_at_many_angles_are_correct_to_two_units() -> Result<(), Failure> {
    for (definition, functions) in &ALL {
        for step in 1..48_u32 {
            let nu = f64::from(step) / 8.0;
            let found = units(definition, functions, nu)?;
            assert!(found <= 2.0, "{definition} at {nu}: {found} units");
        }
    }
    Ok(())
}

#[test]
fn angles_without_a_method_are_refused() {
    let gauss = FittedGauss2 { w: 1.0 };
    for step in [f64::NAN, f64::INFINITY, 65.0] {
        assert!(matches!(gauss.at(step), Err(TableauError::Angle { .. })));
    }
    // The denominator is w sin(w/√3) times a number.
    let zero = std::f64::consts::PI * 3.0_f64.sqrt();
    let refused = gauss.at(zero);
    assert!(
        matches!(refused, Err(TableauError::NoMethod { .. })),
        "{refused:?}"
    );
    assert!(gauss.at(zero + 1e-3).is_ok());
}

symplectic::hamiltonian! { Duffing q: [x], p: [px]; H = px^2/2 + x^2/2 + x^4/400 }

/// The state of a spring of frequency 1 that gets a little stiffer, after 40 units of time.
fn end(method: RunTimeTableau, step: f64) -> Result<[f64; 2], Failure> {
    let start = State::from_arrays(0.0, [1.0], [0.0]);
    let mut run = Integrator::new(method, Duffing, start, step)?;
    run.integrate_to(40.0)?;
    Ok([run.state().q[0], run.state().p[0]])
}

#[test]
fn a_fitted_method_is_of_order_four_and_more_accurate_near_its_frequency() -> Result<(), Failure> {
    let plain = RunTimeTableau::new("Gauss", &Gauss2::COEFFICIENTS.into(), Gauss2::ORDERS)?;
    let known = end(plain.clone(), 0.0025)?;
    let error = |method: RunTimeTableau, step: f64| -> Result<f64, Failure> {
        let [q, p] = end(method, step)?;
        Ok((q - known[0]).hypot(p - known[1]))
    };
    let fitted = |step: f64| -> Result<f64, Failure> {
        let method = FittedGauss2 { w: 1.0 }.at(step)?;
        assert_eq!(method.orders().general, 4);
        error(method, step)
    };
    let (coarse, fine) = (fitted(0.5)?, fitted(0.25)?);
    let slope = (coarse / fine).log2();
    assert!((3.7..4.6).contains(&slope), "{slope}: {coarse:e}, {fine:e}");
    let plain = error(plain, 0.25)?;
    assert!(fine * 5.0 < plain, "{fine:e}, {plain:e}");
    Ok(())
}
