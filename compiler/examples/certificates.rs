//! Certifies the explicit methods of the test data, and prints how: `cargo run --release --example certificates`.

use std::error::Error;
use std::io::{self, Write};
use std::time::Instant;

use serde_json::Value;
use symplectic_compiler::certify::{Certificate, Claim, Splitting, certify};

fn texts(list: &Value) -> Vec<&str> {
    list.as_array()
        .into_iter()
        .flatten()
        .filter_map(Value::as_str)
        .collect()
}

fn fixed(certificate: &Certificate) -> String {
    let list = certificate.fixed().iter();
    let list: Vec<String> = list
        .map(|fixed| {
            let value = if fixed.as_printed {
                String::new()
            } else {
                format!(" = {}", fixed.value)
            };
            format!("{}{value}", fixed.coefficient)
        })
        .collect();
    list.join(", ")
}

fn main() -> Result<(), Box<dyn Error>> {
    let data = include_str!("../tests/data/explicit-methods.json");
    let data: Value = serde_json::from_str(data)?;
    let mut out = io::stdout().lock();
    writeln!(
        out,
        "name | claim | structure | conditions | unknowns | fixed | distance | unique within | sharp | seconds"
    )?;
    for method in data["methods"].as_array().into_iter().flatten() {
        let order = |key: &str| method[key].as_u64().unwrap_or(0) as usize;
        let splitting = Splitting::parse(&texts(&method["kick"]), &texts(&method["drift"]))?;
        let claim = match method["hamiltonian_class"].as_str() {
            Some("nystrom") => Claim::Nystrom(order("order")),
            _ => Claim::Separable(order("order")),
        };
        let start = Instant::now();
        let result = certify(&splitting, &claim);
        let seconds = start.elapsed().as_secs_f64();
        let name = method["name"].as_str().unwrap_or("");
        match result {
            Ok(found) => {
                let distance = if found.is_exact() { "exact, " } else { "" };
                let unique = found.uniqueness_radius().map(ToString::to_string);
                writeln!(
                    out,
                    "{name} | {claim} | {} | {} | {} | {} | {distance}{} | {} | {:?} | {seconds:.3}",
                    found.structure(),
                    found.conditions(),
                    found.unknowns(),
                    fixed(&found),
                    found.distance_text(),
                    unique.unwrap_or_default(),
                    found.sharp(),
                )?;
            }
            Err(error) => writeln!(out, "{name} | {claim} | {error} | {seconds:.3}")?,
        }
    }
    Ok(())
}
