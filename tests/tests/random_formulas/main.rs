//! The code of random formulas against their graphs, evaluated with 71 digits.

mod generator;
mod precise;
mod systems;

use std::error::Error;
use std::path::Path;

use symplectic::Hamiltonian;
use symplectic::nalgebra::SVector;
use symplectic::solver::{Derivatives, DualNumbers, SystemInDuals};
use symplectic::system::Jacobian;
use symplectic_formula as formula;
use symplectic_tests::references::Wide;

use generator::{Formula, formulas};
use precise::Slopes;

/// What is done with each system.
pub trait Look {
    /// With the next one.
    fn at<H, const D: usize>(&mut self, system: H)
    where
        H: Hamiltonian<Vector<f64> = SVector<f64, D>> + SystemInDuals<SVector<f64, D>>;
}

#[test]
fn the_file_is_that_of_the_generator() -> Result<(), Box<dyn Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/random_formulas/systems.rs");
    let expected = generator::file();
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(&path, &expected)?;
    }
    assert!(
        std::fs::read_to_string(&path)? == expected,
        "UPDATE_EXPECT=1 writes it anew"
    );
    Ok(())
}

/// States without a pattern, of components below 3/2.
fn states<const D: usize>() -> Vec<[SVector<f64, D>; 2]> {
    let number = |k: usize| (k as f64 * 0.754_877_666_246_692_8).fract() * 3.0 - 1.5;
    let half = |k: usize| SVector::from_fn(|i, _| number(1 + k * D + i));
    (0..6).map(|k| [half(2 * k), half(2 * k + 1)]).collect()
}

struct Compare<'a> {
    formulas: std::slice::Iter<'a, Formula>,
    /// The largest errors of energy, first and second derivatives, in units of the largest component.
    errors: [f64; 3],
}

impl Look for Compare<'_> {
    fn at<H, const D: usize>(&mut self, system: H)
    where
        H: Hamiltonian<Vector<f64> = SVector<f64, D>> + SystemInDuals<SVector<f64, D>>,
    {
        let Formula { name, text } = self.formulas.next().expect("as many formulas");
        let read = formula::System::read(name, &format!("{name} {text}")).expect("a formula");
        let mut slopes = Slopes::new(read);
        for [q, p] in states::<D>() {
            let expected = slopes.energy(&q, &p);
            let energy = Hamiltonian::energy(&system, 0.3, &q, &p).expect("an energy");
            self.compare(0, name, &[energy], &[expected]);

            let (velocity, force) = slopes.first(&q, &p);
            let mut found = [q, p];
            let [of_p, of_q] = &mut found;
            Hamiltonian::slopes(&system, 0.3, &q, &p, (&mut *of_p, &mut *of_q));
            self.compare(1, name, of_p.as_slice(), &velocity);
            self.compare(1, name, of_q.as_slice(), &force);
            let mut apart = [q, p];
            let [of_p, of_q] = &mut apart;
            Hamiltonian::velocity(&system, 0.3, &q, &p, of_p);
            Hamiltonian::force(&system, 0.3, &q, &p, of_q);
            self.compare(1, name, of_p.as_slice(), &velocity);
            self.compare(1, name, of_q.as_slice(), &force);
            assert_eq!(found, apart, "{name}: together and apart");

            let mut exact = Jacobian::new(D, Hamiltonian::half_bandwidth(&system));
            assert!(Hamiltonian::second_derivatives(
                &system, 0.3, &q, &p, &mut exact
            ));
            let mut dual = Jacobian::new(D, D);
            let mut memory = <DualNumbers as Derivatives<SVector<f64, D>, H>>::memory(&q);
            DualNumbers::evaluate(&mut memory, &system, 0.3, &q, &p, &mut dual);
            for found in [&exact, &dual] {
                for (k, matrix) in slopes.second(&q, &p).iter().enumerate() {
                    let found = [
                        &found.velocity_by_position,
                        &found.velocity_by_momentum,
                        &found.force_by_position,
                    ][k];
                    let found: Vec<f64> = (0..D * D).map(|m| found.get(m / D, m % D)).collect();
                    self.compare(2, name, &found, matrix);
                }
            }
        }
    }
}

impl Compare<'_> {
    /// Notes the error, and stops at one that no rounding makes.
    fn compare(&mut self, kind: usize, name: &str, found: &[f64], expected: &[Wide]) {
        let size = |all: &[Wide]| all.iter().map(|x| x.to_f64().abs()).fold(1.0, f64::max);
        let largest = size(expected);
        for (found, &expected) in found.iter().zip(expected) {
            let difference = symplectic::Scalar::from_f64(*found);
            let difference: Wide = difference;
            let error = (difference - expected).to_f64().abs() / largest;
            self.errors[kind] = self.errors[kind].max(error);
            assert!(
                error < 1e-6,
                "{name}: {found:e} for {:e}",
                expected.to_f64()
            );
        }
    }
}

#[test]
fn random_formulas_are_compiled_to_what_they_say() {
    let formulas = formulas();
    let mut compare = Compare {
        formulas: formulas.iter(),
        errors: [0.0; 3],
    };
    systems::each(&mut compare);
    assert!(compare.formulas.next().is_none());
    let [energy, first, second] = compare.errors;
    // Four times what was measured: sums cancel, and powers make components large.
    assert!(energy < 4e-15, "{energy:e}");
    assert!(first < 4e-15, "{first:e}");
    assert!(second < 8e-15, "{second:e}");
}

/// The negative twin: each system against the next formula.
#[test]
#[should_panic(expected = "Named1: ")]
fn other_formulas_are_refuted() {
    let formulas = formulas();
    let mut compare = Compare {
        formulas: formulas[1..].iter(),
        errors: [0.0; 3],
    };
    systems::each(&mut compare);
}
