//! Closed forms, and digits of other lists than those that were certified.

use num_bigint::BigInt;

use super::*;
use crate::arithmetic::rounding::Decimal;
use crate::certify::{Printed, certify_composition};

/// Some more digits than are compared.
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

fn composition(half: &[&str], order: usize) -> Certificate {
    let printed = |text: &&str| Printed::parse(text).expect(text);
    let mut weights: Vec<Printed> = half.iter().map(printed).collect();
    let mirrored: Vec<Printed> = weights.iter().rev().skip(1).cloned().collect();
    weights.extend(mirrored);
    certify_composition(&weights, order).expect("certified")
}

/// Kahan & Li 1997, with the digits of GNI V.3.2; s15odr8 is Suzuki & Umeno's and McLachlan's SS15.
#[test]
fn compositions_of_kahan_and_li_are_certified() {
    let six = [
        "0.39216144400731413927925056",
        "0.33259913678935943859974864",
        "-0.70624617255763935980996482",
        "0.08221359629355080023149045",
        "0.79854399093482996339895035",
    ];
    let found = composition(&six, 6);
    assert_eq!((found.conditions(), found.unknowns()), (4, 5));
    assert!(found.distance() < &ratio(1, 10i64.pow(18)));
    assert_eq!(found.sharp(), Some(true));
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
    let found = composition(&fifteen, 8);
    assert!(
        found.wrong_digits().is_empty(),
        "{:?}",
        found.wrong_digits()
    );
    // The other list, refined, has these digits too.
    let mclachlan = certificate("McLachlan1995SS15");
    for index in 0..8 {
        let ours = digits(&mclachlan, Coefficient::Drift(index), 40);
        assert_eq!(ours, digits(&found, Coefficient::Weight(index), 40));
    }
    let seventeen = [
        "0.13020248308889008087881763",
        "0.56116298177510838456196441",
        "-0.38947496264484728640807860",
        "0.15884190655515560089621075",
        "-0.39590389413323757733623154",
        "0.18453964097831570709183254",
        "0.25837438768632204729397911",
        "0.29501172360931029887096624",
        "-0.60550853383003451169892108",
    ];
    let found = composition(&seventeen, 8);
    assert!(found.distance() < &ratio(1, 10i64.pow(17)));
}

/// Sofroniou & Spaletta 2005, order 10 with 35 stages (GNI V.3.2).
#[test]
fn a_composition_of_order_10_is_certified() {
    let half = [
        "0.07879572252168641926390768",
        "0.31309610341510852776481247",
        "0.02791838323507806610952027",
        "-0.22959284159390709415121340",
        "0.13096206107716486317465686",
        "-0.26973340565451071434460973",
        "0.07497334315589143566613711",
        "0.11199342399981020488957508",
        "0.36613344954622675119314812",
        "-0.39910563013603589787862981",
        "0.10308739852747107731580277",
        "0.41143087395589023782070412",
        "-0.00486636058313526176219566",
        "-0.39203335370863990644808194",
        "0.05194250296244964703718290",
        "0.05066509075992449633587434",
        "0.04967437063972987905456880",
        "0.04931773575959453791768001",
    ];
    let found = composition(&half, 10);
    assert_eq!((found.conditions(), found.unknowns()), (16, 18));
    assert!(
        found.distance() < &ratio(1, 10i64.pow(17)),
        "{}",
        found.distance_text()
    );
}

fn perturbed(drift: &[&str], kick: &[&str], orders: &[usize]) -> Certificate {
    let mut kicks = vec!["0"];
    kicks.extend(kick);
    let splitting = Splitting::parse(&kicks, drift).expect("coefficients");
    certify(&splitting, &Claim::Perturbed(orders.to_vec())).expect("certified")
}

/// Laskar & Robutel 2001, `SABA₂`: the nodes of Gauss, order (4, 2); and Blanes et al. 2013, `ABA(10,6,4)`.
#[test]
fn methods_for_perturbed_systems_are_certified() {
    let drift = [
        "0.21132486540518711775",
        "0.57735026918962576451",
        "0.21132486540518711775",
    ];
    let found = perturbed(&drift, &["0.5", "0.5"], &[4, 2]);
    assert_digits(&found, Coefficient::Drift(1), &(root(3, 2) * ratio(1, 3)));
    assert!(satisfies(&found, &Claim::Perturbed(vec![4, 2])));
    assert!(!satisfies(&found, &Claim::Perturbed(vec![5, 2])));
    assert!(!satisfies(&found, &Claim::Perturbed(vec![4, 3])));
    let drift = [
        "0.03809449742241219545697532230863756534060",
        "0.1452987161169137492940200726606637497442",
        "0.2076276957255412507162056113249882065158",
        "0.4359097036515261592231548624010651844006",
        "-0.6538612258327867093807117373907094120024",
        "0.4359097036515261592231548624010651844006",
        "0.2076276957255412507162056113249882065158",
        "0.1452987161169137492940200726606637497442",
        "0.03809449742241219545697532230863756534060",
    ];
    let kick = [
        "0.09585888083707521061077150377145884776921",
        "0.2044461531429987806805077839164344779763",
        "0.2170703479789911017143385924306336714532",
        "-0.01737538195906509300561788011852699719871",
        "-0.01737538195906509300561788011852699719871",
        "0.2170703479789911017143385924306336714532",
        "0.2044461531429987806805077839164344779763",
        "0.09585888083707521061077150377145884776921",
    ];
    let found = perturbed(&drift, &kick, &[10, 6, 4]);
    assert_eq!((found.conditions(), found.unknowns()), (9, 9));
    assert!(
        found.distance() < &ratio(1, 10i64.pow(18)),
        "{}",
        found.distance_text()
    );
    assert!(satisfies(&found, &Claim::Perturbed(vec![10, 6, 4])));
    assert!(!satisfies(&found, &Claim::Perturbed(vec![10, 6, 6])));
}
