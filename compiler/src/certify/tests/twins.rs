//! Lists with errors, and their diagnoses.

use num_traits::Signed;

use super::*;
use crate::certify::{CertifyError, MAX_STAGES, Printed, certify_composition};

/// Adds or subtracts one in the sixth decimal place.
fn changed(text: &str, up: bool) -> String {
    let printed = Printed::parse(text).expect(text);
    let places = printed.places().expect("a decimal").max(6) as usize;
    let step = ratio(if up { 1 } else { -1 }, 1_000_000);
    let scale = BigRational::from_integer(num_bigint::BigInt::from(10).pow(places as u32));
    let digits = ((printed.value() + step) * scale).to_integer();
    let sign = if digits.is_negative() { "-" } else { "" };
    let digits = format!("{:0>width$}", digits.abs(), width = places + 1);
    let (whole, fraction) = digits.split_at(digits.len() - places);
    format!("{sign}{whole}.{fraction}")
}

fn near_one_millionth(distance: &BigRational) -> bool {
    let (low, high) = (ratio(1, 10i64.pow(8)), ratio(1, 10i64.pow(3)));
    (low..high).contains(&distance.abs())
}

/// A wrong digit in the sixth place breaks the sum of the weights; the exact method behind it is still found.
#[test]
#[ignore = "thorough"]
fn one_wrong_digit_is_found() {
    for name in [
        "ForestRuth1990",
        "BlanesMoan2002S6",
        "BlanesMoan2002SRKN11B",
        "McLachlanAtela1992Order4Optimal",
        "Yoshida1990Order8A",
    ] {
        let method = method(name);
        let mut drift = method.drift.clone();
        drift[1] = changed(&drift[1], true);
        let error = certify(&splitting(&method.kick, &drift), &method.claim()).expect_err(name);
        let CertifyError::WeightSum { what, nearest, .. } = &error else {
            panic!("{name}: {error}");
        };
        assert_eq!(*what, "drifts");
        let nearest = nearest.as_ref().expect(name);
        assert!(near_one_millionth(nearest.distance()), "{name}: {error}");
        assert!(satisfies(nearest, &method.claim()), "{name}");
    }
}

/// Two wrong digits that leave the sum unchanged.
#[test]
fn wrong_digits_with_the_right_sum_are_found() {
    for (name, other) in [
        ("ForestRuth1990", 2),
        ("McLachlan1995SS9", 7),
        ("OkunborSkeel1994Order6Method13", 6),
        ("McLachlanAtela1992Order5Optimal", 3),
        ("Yoshida1990Order6B", 5),
    ] {
        let method = method(name);
        let mut drift = method.drift.clone();
        let kick = method.kick.clone();
        let exact = |texts: &[String]| -> BigRational {
            let value = |t: &String| Printed::parse(t).expect(t).value().clone();
            texts.iter().map(value).sum()
        };
        let sum = exact(&drift);
        drift[1] = changed(&drift[1], true);
        drift[other] = changed(&drift[other], false);
        assert_eq!(exact(&drift), sum, "{name}");
        let error = certify(&splitting(&kick, &drift), &method.claim()).expect_err(name);
        let CertifyError::DifferentSolution { certificate, .. } = &error else {
            panic!("{name}: {error}");
        };
        assert!(
            near_one_millionth(certificate.distance()),
            "{name}: {error}"
        );
        assert!(
            error.to_string().contains("away from the digits"),
            "{error}"
        );
    }
}

#[test]
#[ignore = "thorough"]
fn exchanged_and_truncated_lists_are_refuted() {
    for method in methods() {
        let name = &method.name;
        let exchanged = splitting(&method.drift, &method.kick);
        let error = certify(&exchanged, &method.claim()).expect_err(name);
        assert!(
            matches!(
                error,
                CertifyError::DifferentSolution { .. }
                    | CertifyError::NotFound { .. }
                    | CertifyError::TooFewCoefficients { .. }
                    | CertifyError::Dependent { .. }
            ),
            "{name}: {error}"
        );
        if method.kick.len() == 1 {
            continue;
        }
        let (kick, drift) = (&method.kick[1..], &method.drift[1..]);
        let error = certify(&splitting(kick, drift), &method.claim()).expect_err(name);
        assert!(
            matches!(error, CertifyError::WeightSum { .. }),
            "{name}: {error}"
        );
    }
}

#[test]
#[ignore = "thorough"]
fn orders_that_are_too_high_are_refuted() {
    for method in methods() {
        let name = &method.name;
        let claims = [
            Claim::Separable(method.separable_order + 1),
            Claim::Nystrom(method.order + 1),
        ];
        for claim in claims {
            let error = certify(&method.splitting(), &claim).expect_err(name);
            assert!(
                !matches!(error, CertifyError::WeightSum { .. }),
                "{name}: {error}"
            );
        }
    }
}

/// McLachlan & Atela's method of order 4 has as many coefficients as a separable `H` has conditions, and
/// satisfies only those for quadratic kinetic energies.
#[test]
fn mclachlan_atela_4_is_not_of_order_4_for_separable_hamiltonians() {
    let method = method("McLachlanAtela1992Order4Optimal");
    let conditions = Conditions::new(&Claim::Separable(4), false).expect("a claim");
    assert_eq!(conditions.conditions().len(), 8);
    let error = certify(&method.splitting(), &Claim::Separable(4)).expect_err("refuted");
    match error {
        CertifyError::NotFound { degree, .. } => assert_eq!(degree, 4),
        CertifyError::DifferentSolution { certificate, .. } => {
            assert!(certificate.distance() > &ratio(1, 100));
        }
        error => panic!("{error}"),
    }
    assert!(certify(&method.splitting(), &Claim::Separable(3)).is_ok());
}

#[test]
fn certify_refuses_bad_input_with_the_reason() {
    let texts = |list: &[&str]| -> Vec<Printed> {
        list.iter()
            .map(|text| Printed::parse(text).expect(text))
            .collect()
    };
    let message = |kick: &[&str], drift: &[&str], claim: &Claim| {
        let splitting = Splitting {
            kick: texts(kick),
            drift: texts(drift),
            gradient: Vec::new(),
        };
        let error = certify(&splitting, claim).expect_err("wrong");
        error.to_string()
    };
    let order = |order| Claim::Separable(order);
    let told = message(&["0.5", "0.5"], &["1"], &order(2));
    assert!(told.starts_with("2 kicks and 1 drifts"), "{told}");
    let told = message(&["0"], &["0.0"], &order(2));
    assert!(told.starts_with("the kicks sum to 0, not to 1"), "{told}");
    let told = message(&["0.5", "0.4"], &["1", "0"], &order(2));
    assert!(
        told.starts_with("the kicks sum to 0.9, not to 1;"),
        "{told}"
    );
    let told = message(&["0.5", "0.5"], &["1", "0"], &order(4));
    assert!(told.contains("takes 2 conditions"), "{told}");
    assert!(
        told.contains("composition with these coefficients has 1 unknown:"),
        "{told}"
    );
    let told = message(&["0.5", "0.5"], &["1", "0"], &order(12));
    assert!(told.contains("orders are from 1 to 10"), "{told}");
    let told = message(&[], &[], &order(2));
    assert!(told.contains("0 stages"), "{told}");
    let told = message(&["1e9"], &["1"], &order(2));
    assert!(told.starts_with("kick[0] = 1.00000e9 is larger"), "{told}");
    let told = message(&["1"], &["1"], &Claim::SymmetricBase(2));
    assert!(told.contains("composition"), "{told}");
    let many = vec!["0.01"; MAX_STAGES + 1];
    assert!(message(&many, &many, &order(2)).contains("65 stages"));
    let told = certify_composition(&texts(&["0.5", "0.6"]), 2).expect_err("wrong");
    assert!(
        told.to_string().starts_with("the weights sum to 1.1"),
        "{told}"
    );
    assert!(Splitting::parse(&["0,5"], &["1"]).is_err());
    let verlet = certify(
        &Splitting::parse(&["0.5", "0.5"], &["1", "0"]).expect("read"),
        &order(2),
    );
    let verlet = verlet.expect("certified");
    assert!(verlet.decimal(Coefficient::Kick(0), 10_001).is_err());
    assert_eq!(verlet.enclose(Coefficient::Kick(2), 10), None);
}
