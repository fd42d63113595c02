//! Certificates of methods from the literature, and negative twins without certificates.

mod literature;
mod published;
mod twins;

use num_rational::BigRational;
use num_traits::Zero;
use serde_json::Value;

use super::search::expanded;
use super::structure::Target;
use super::system::System;
use super::{Certificate, Claim, Coefficient, Conditions, Splitting, certify};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::rational::ratio;

/// A method of the data file.
struct Method {
    name: String,
    kick: Vec<String>,
    drift: Vec<String>,
    class: String,
    order: usize,
    separable_order: usize,
    reversible: bool,
    residual: f64,
}

impl Method {
    fn splitting(&self) -> Splitting {
        splitting(&self.kick, &self.drift)
    }

    fn claim(&self) -> Claim {
        match &*self.class {
            "nystrom" => Claim::Nystrom(self.order),
            _ => Claim::Separable(self.order),
        }
    }
}

fn splitting(kick: &[String], drift: &[String]) -> Splitting {
    let texts = |list: &[String]| -> Vec<String> { list.to_vec() };
    let (kick, drift) = (texts(kick), texts(drift));
    let kick: Vec<&str> = kick.iter().map(String::as_str).collect();
    let drift: Vec<&str> = drift.iter().map(String::as_str).collect();
    Splitting::parse(&kick, &drift).expect("coefficients")
}

fn methods() -> Vec<Method> {
    let text = include_str!("../../../tests/data/explicit-methods.json");
    let data: Value = serde_json::from_str(text).expect("valid");
    let read = |method: &Value| {
        let word = |key: &str| method[key].as_str().expect(key).to_owned();
        let list = |key: &str| -> Vec<String> {
            let list = method[key].as_array().expect(key).iter();
            list.map(|x| x.as_str().expect("text").to_owned()).collect()
        };
        let number = |key: &str| method[key].as_u64().expect(key) as usize;
        Method {
            name: word("name"),
            kick: list("kick"),
            drift: list("drift"),
            class: word("hamiltonian_class"),
            order: number("order"),
            separable_order: number("order_general_separable"),
            reversible: method["time_reversible"].as_bool().expect("a boolean"),
            residual: word("order_condition_residual_of_the_printed_digits")
                .parse()
                .expect("a number"),
        }
    };
    let methods: Vec<Method> = data["methods"]
        .as_array()
        .expect("a list")
        .iter()
        .map(read)
        .collect();
    assert_eq!(methods.len(), 31);
    methods
}

fn method(name: &str) -> Method {
    let found = methods().into_iter().find(|method| method.name == name);
    found.expect(name)
}

/// The residuals of the coefficients of a certificate in all conditions of a claim, including even degrees, for
/// any structure.
fn residuals(certificate: &Certificate, claim: &Claim, bits: u32) -> Vec<Interval> {
    let mut targets = Vec::new();
    let mut unknowns = Vec::new();
    for name in certificate.coefficients() {
        unknowns.push(certificate.enclose(name, bits).expect("known"));
        targets.push(Target {
            name,
            printed: BigRational::zero(),
            half: BigRational::zero(),
            terms: vec![(targets.len(), ratio(1, 1))],
        });
    }
    let (steps, arguments) = expanded(&targets, &unknowns, bits);
    let conditions = Conditions::new(claim, false).expect("a claim");
    let system = System::new(steps, conditions);
    system.residuals(&arguments)
}

/// Whether all conditions of a claim hold to nearly as many binary places as the coefficients have.
fn satisfies(certificate: &Certificate, claim: &Claim) -> bool {
    const BITS: u32 = 600;
    residuals(certificate, claim, BITS).iter().all(|residual| {
        assert!(residual.width_bits() < 60 - i64::from(BITS));
        residual.contains(&BigRational::zero())
    })
}

fn digits(certificate: &Certificate, coefficient: Coefficient, count: usize) -> String {
    let decimal = certificate.decimal(coefficient, count).expect("few digits");
    decimal.expect("a coefficient").to_string()
}
