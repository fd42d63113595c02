//! Definitions with extreme constants: an answer in time, and files that are accepted again.

use std::time::Duration;

use crate::extreme::{Random, definition, seeds, within};
use num_bigint::BigInt;
use symplectic_compiler::export::{json, text, toml};
use symplectic_compiler::{Definition, Key, Limits, check};

/// An end to what has none: far more than any definition here takes, which is a few seconds, on a machine that is busy.
const DEADLINE: Duration = Duration::from_secs(300);

/// Derives a definition, decides its properties and orders, and rounds its coefficients. Whether it was not refused.
fn answered(definition: &Definition) -> bool {
    let Ok(tableau) = definition.derive(&Limits::default()) else {
        return false;
    };
    let _ = (tableau.properties(), tableau.separable_properties());
    let _ = (tableau.orders(), tableau.perturbed_order());
    let _ = tableau.stable_steps();
    let _ = tableau.to_f64();
    assert!(
        [1, 40]
            .iter()
            .all(|&digits| !text::write(&tableau, digits).is_empty())
    );
    true
}

/// `SYMPLECTIC_SEEDS=0..5000` tries more definitions.
#[test]
#[ignore = "thorough"]
fn extreme_constants_have_an_answer_in_time() {
    let seeds = seeds(0..200);
    let count = seeds.end - seeds.start;
    let derived = seeds.filter(|&seed| {
        let definition = definition(&mut Random::new(seed));
        let label = format!("seed {seed}: {definition}");
        within(DEADLINE, &label, move || answered(&definition)).0
    });
    let derived = derived.count() as u64;
    assert!(4 * derived > count, "only {derived} of {count} are derived");
}

/// Weights with many digits, the same from both ends, with the sum 1.
fn long_weights(count: usize, digits: usize, random: &mut Random) -> String {
    let half: Vec<BigInt> = (0..count / 2)
        .map(|index| {
            let number: String = (0..digits)
                .map(|_| char::from(b'0' + random.below(10) as u8))
                .collect();
            let number: BigInt = format!("1{number}").parse().expect("digits");
            if index % 2 == 0 { -number } else { number }
        })
        .collect();
    let one = BigInt::from(10).pow(digits as u32 + 1);
    let middle: BigInt = &one - half.iter().sum::<BigInt>() * 2;
    let all = half.iter().chain([&middle]).chain(half.iter().rev());
    let all: Vec<String> = all.map(|number| format!("{number}/{one}")).collect();
    all.join(", ")
}

/// These have an answer and are not refused. Exact numbers with so many digits would take minutes; enclosures decide.
#[test]
#[ignore = "thorough"]
fn implicit_compositions_with_many_digits_have_an_answer() {
    for (base, digits) in [
        ("[basis: 1, nodes: 1/2]", 1000),
        ("[basis: polynomial(2), nodes: gauss(2)]", 1000),
        ("[basis: polynomial(3), nodes: lobatto(3)]", 3000),
    ] {
        let weights = long_weights(9, digits, &mut Random::new(1));
        let parts = [(Key::Base, base), (Key::Weights, &*weights)];
        let definition = Definition::new(parts);
        let (derived, _) = within(DEADLINE, base, move || answered(&definition));
        assert!(derived, "{base}");
    }
    let small = "(pi - 355/113)^100";
    let text = format!(
        "base: [basis: polynomial(3), nodes: lobatto(3)], weights: [{small}, 1 - 2*{small}, {small}]"
    );
    let definition = Definition::parse(&text).expect("a definition");
    assert!(within(DEADLINE, small, move || answered(&definition)).0);
}

#[test]
#[ignore = "thorough"]
fn ten_thousand_digits_of_twenty_nodes_are_written() {
    let definition = Definition::parse("basis: polynomial(20), nodes: gauss(20)");
    let definition = definition.expect("a definition");
    let write = move || {
        let tableau = definition.derive(&Limits::default()).expect("a tableau");
        text::write(&tableau, 10_000).len()
    };
    let (length, _) = within(DEADLINE, "gauss(20)", write);
    assert!(length > 440 * 10_000);
}

/// Definitions whose numbers differ by hundreds of powers of ten.
fn stretched(random: &mut Random) -> Definition {
    let rate = [1, 40, 200, 400, 700, 750, 800, 900, 1000, 1300][random.below(10)];
    let sign = random.pick(&["", "-"]);
    let function = random.pick(&["exp", "cosh", "sinh"]);
    let scale = random.pick(&["", "t*", "1e-300*", "1e200*"]);
    let nodes = [
        "1/4, 3/4",
        "0, 1",
        "1e-30, 1/2",
        "1/3, 1 - 1e-60",
        "1/2, 1/2 + 1e-40",
    ];
    let mut parts = vec![
        (Key::Basis, format!("1, {scale}{function}({sign}{rate}*t)")),
        (Key::Nodes, random.pick(&nodes).to_owned()),
    ];
    for key in [Key::Exchange, Key::Adjoint] {
        if random.below(2) == 0 {
            parts.push((key, "true".to_owned()));
        }
    }
    Definition::new(parts)
}

/// Writes a definition in both formats and holds the files against new derivations; whether there is a tableau.
fn round_trip(definition: &Definition, digits: usize) -> Result<bool, String> {
    let limits = Limits::default();
    let Ok(tableau) = definition.derive(&limits) else {
        return Ok(false);
    };
    let files = [
        ("x.toml", toml::write(&tableau, digits)),
        ("x.json", json::write(&tableau, digits)),
    ];
    for (name, text) in files {
        check(name, &text, &limits).map_err(|error| error.to_string())?;
    }
    Ok(true)
}

#[test]
#[ignore = "thorough"]
fn files_with_extreme_functions_are_read_back() {
    for function in ["exp(750*t)", "exp(800*t)", "cosh(1000*t)"] {
        for switches in [
            &[][..],
            &[Key::Exchange],
            &[Key::Adjoint],
            &[Key::Exchange, Key::Adjoint],
        ] {
            let basis = format!("1, {function}");
            let parts = [(Key::Basis, &*basis), (Key::Nodes, "1/4, 3/4")];
            let switches = switches.iter().map(|&key| (key, "true"));
            let definition = Definition::new(parts.into_iter().chain(switches));
            assert_eq!(round_trip(&definition, 40), Ok(true), "{definition}");
        }
    }
}

/// `SYMPLECTIC_SEEDS=0..5000` tries more definitions.
#[test]
#[ignore = "thorough"]
fn files_of_random_stretched_definitions_are_read_back() {
    let seeds = seeds(0..40);
    let count = seeds.end - seeds.start;
    let written = seeds.filter(|&seed| {
        let mut random = Random::new(seed);
        let definition = stretched(&mut random);
        let digits = [1, 16, 40, 200][random.below(4)];
        let label = format!("seed {seed}, {digits} digits: {definition}");
        let (result, _) = within(DEADLINE, &label, move || round_trip(&definition, digits));
        result.unwrap_or_else(|error| panic!("{error}"))
    });
    let written = written.count() as u64;
    assert!(2 * written > count, "only {written} of {count} are written");
}
