//! Closed forms, and digits from lists other than the certified ones.

use num_bigint::BigInt;

use super::*;
use crate::arithmetic::rounding::Decimal;
use crate::catalogue;
use crate::certify::{Printed, certify_composition};
use crate::definition::{Definition, Key};

/// A few more digits than are compared.
const DIGITS: u32 = 600;
const COMPARED: usize = 500;

/// `ⁿ√x`, with an error below `10^−600`.
fn root(x: u32, n: u32) -> BigRational {
    let scale = BigInt::from(10).pow(DIGITS);
    let scaled = BigInt::from(x) * BigInt::from(10).pow(DIGITS * n);
    BigRational::new(scaled.nth_root(n), scale)
}

fn certificate(name: &str) -> Certificate {
    let method = method(name);
    certify(&method.splitting(), &method.claim()).expect(name)
}

fn assert_digits(found: &Certificate, coefficient: Coefficient, exact: &BigRational) {
    let exact = Decimal::round(exact, COMPARED).to_string();
    assert_eq!(digits(found, coefficient, COMPARED), exact, "{coefficient}");
}

#[test]
fn digits_are_those_of_the_closed_forms() {
    let one = || ratio(1, 1);
    // Forest & Ruth 1990: w₁ = 1/(2 − ∛2), w₀ = 1 − 2w₁.
    let found = certificate("ForestRuth1990");
    let w = one() / (ratio(2, 1) - root(2, 3));
    assert_digits(&found, Coefficient::Drift(0), &w);
    assert_digits(&found, Coefficient::Kick(0), &(&w * ratio(1, 2)));
    assert_digits(&found, Coefficient::Kick(1), &((one() - &w) * ratio(1, 2)));
    // Suzuki 1990: w₁ = 1/(4 − ∛4), w₀ = 1 − 4w₁.
    let found = certificate("Suzuki1990");
    let w = one() / (ratio(4, 1) - root(4, 3));
    assert_digits(&found, Coefficient::Drift(3), &w);
    assert_digits(&found, Coefficient::Drift(2), &(one() - &w * ratio(4, 1)));
    // McLachlan 1995: (642 + √471)/3924 and 121(12 − √471)/3924 with the drifts 6/11 and −1/22.
    let found = certificate("McLachlan1995S4");
    let k = (ratio(642, 1) + root(471, 2)) / ratio(3924, 1);
    assert_digits(&found, Coefficient::Kick(0), &k);
    let k = (ratio(12, 1) - root(471, 2)) * ratio(121, 3924);
    assert_digits(&found, Coefficient::Kick(1), &k);
    // (14 − √19)/108 with the drifts 2/5 and −1/10.
    let found = certificate("McLachlan1995S5");
    let k = (ratio(14, 1) - root(19, 2)) / ratio(108, 1);
    assert_digits(&found, Coefficient::Kick(0), &k);
}

/// The list of a method of the catalogue, mirrored, with its last item only once.
fn mirrored(name: &str, key: Key) -> Vec<String> {
    let entry = catalogue::find(name).expect(name);
    let definition = Definition::parse(&entry.definition).expect(name);
    let list = definition.get(key).expect(name);
    let list = list.trim_matches(['[', ']']).split(", ");
    let mut all: Vec<String> = list.map(str::to_owned).collect();
    let back: Vec<String> = all.iter().rev().skip(1).cloned().collect();
    all.extend(back);
    all
}

fn composition(weights: &[String], order: usize) -> Certificate {
    let printed = |text: &String| Printed::parse(text).expect(text);
    let weights: Vec<Printed> = weights.iter().map(printed).collect();
    certify_composition(&weights, order).expect("certified")
}

/// Kahan & Li 1997, with the digits of GNI V.3.2, and Sofroniou & Spaletta 2005.
#[test]
fn compositions_are_certified() {
    let places = |n: u32| BigRational::new(1.into(), BigInt::from(10).pow(n));
    for (name, order, [conditions, unknowns]) in [
        ("kahan-li-1997-s9odr6-a", 6, [4, 5]),
        ("kahan-li-1997-s17odr8-a", 8, [8, 9]),
        ("sofroniou-spaletta-2005-s35odr10", 10, [16, 18]),
    ] {
        let found = composition(&mirrored(name, Key::Weights), order);
        assert_eq!(
            [found.conditions(), found.unknowns()],
            [conditions, unknowns]
        );
        assert!(
            found.distance() < &places(17),
            "{name}: {}",
            found.distance_text()
        );
        assert_eq!(found.sharp(), Some(true), "{name}");
    }
}

/// s15odr8 of Kahan & Li is Suzuki & Umeno's and McLachlan's SS15: the digits of GNI V.3.2, more than the catalogue has,
/// are those of the exact method.
#[test]
fn refined_digits_are_those_of_a_longer_list() {
    let fifteen = [
        "0.74167036435061295344822780",
        "-0.40910082580003159399730010",
        "0.19075471029623837995387626",
        "-0.57386247111608226665638773",
        "0.29906418130365592384446354",
        "0.33462491824529818378495798",
        "0.31529309239676659663205666",
        "-0.79688793935291635401978884",
    ];
    let mclachlan = composition(&mirrored("mclachlan-1995-ss15", Key::Weights), 8);
    for (index, printed) in fifteen.into_iter().enumerate() {
        let places = printed.trim_start_matches(['-', '0', '.']).len();
        assert_eq!(
            digits(&mclachlan, Coefficient::Weight(index), places),
            printed
        );
    }
}

/// Laskar & Robutel 2001, `SABA₂`: the nodes of Gauss, order (4, 2); and Blanes et al. 2013, `ABA(10,6,4)`.
#[test]
fn methods_for_perturbed_systems_are_certified() {
    let perturbed = |kick: &[String], drift: &[String], orders: &[usize]| {
        let claim = Claim::Perturbed(orders.to_vec());
        certify(&splitting(kick, drift), &claim).expect("certified")
    };
    let texts = |list: &[&str]| list.iter().map(|&text| text.to_owned()).collect::<Vec<_>>();
    let drift = texts(&[
        "0.21132486540518711775",
        "0.57735026918962576451",
        "0.21132486540518711775",
    ]);
    let found = perturbed(&texts(&["0", "0.5", "0.5"]), &drift, &[4, 2]);
    assert_digits(&found, Coefficient::Drift(1), &(root(3, 2) * ratio(1, 3)));
    assert!(satisfies(&found, &Claim::Perturbed(vec![4, 2])));
    assert!(!satisfies(&found, &Claim::Perturbed(vec![5, 2])));
    assert!(!satisfies(&found, &Claim::Perturbed(vec![4, 3])));
    let name = "blanes-2013-aba-10-6-4";
    let half = mirrored(name, Key::Kick);
    let kick = [&texts(&["0"]), &half[..4], &half[3..]].concat();
    let found = perturbed(&kick, &mirrored(name, Key::Drift), &[10, 6, 4]);
    assert_eq!((found.conditions(), found.unknowns()), (9, 9));
    assert!(
        found.distance() < &ratio(1, 10i64.pow(18)),
        "{}",
        found.distance_text()
    );
    assert!(satisfies(&found, &Claim::Perturbed(vec![10, 6, 4])));
    assert!(!satisfies(&found, &Claim::Perturbed(vec![10, 6, 6])));
}
