//! The methods of the data file.

use num_traits::Signed;

use super::*;
use crate::arithmetic::rounding::to_f64;

#[test]
#[ignore = "thorough"]
fn all_methods_are_certified() {
    for method in methods() {
        let name = &method.name;
        let claim = method.claim();
        let found =
            certify(&method.splitting(), &claim).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(found.structure().symmetric(), method.reversible, "{name}");
        assert_eq!(found.sharp(), Some(true), "{name}");
        // Neither the structure nor the restriction to odd degrees is used here.
        assert!(satisfies(&found, &claim), "{name}");
        let separable = Claim::Separable(method.separable_order);
        assert!(satisfies(&found, &separable), "{name}");
        let next = Claim::Separable(method.separable_order + 1);
        assert!(!satisfies(&found, &next), "{name}");
        // Residuals are sums of at most a few hundred products with a few coefficients of size 3.
        let distance = to_f64(found.distance());
        assert!(
            method.residual <= 1e4 * distance + 1e-90,
            "{name}: {distance}"
        );
        assert!(distance <= 1e2 * method.residual, "{name}: {distance}");
        if found.is_exact() {
            continue;
        }
        assert_eq!(
            found.conditions() + found.fixed().len(),
            found.unknowns(),
            "{name}"
        );
        let unique = found.uniqueness_radius().expect(name);
        assert!(unique > &(found.distance() * ratio(1000, 1)), "{name}");
    }
}

#[test]
fn certify_counts_the_wrong_digits_of_published_methods() {
    let wrong = |name: &str| {
        let method = method(name);
        let found = certify(&method.splitting(), &method.claim()).expect(name);
        found.wrong_digits().len()
    };
    // Printed with 20 decimals, which are wrong beyond the 13th.
    assert!(wrong("Yoshida1990Order8C") > 20);
    assert!(wrong("Yoshida1990Order8D") > 20);
    // The last of 20 decimals of two weights is not rounded correctly: they are 5.7e-21 and 5.8e-21 off.
    assert_eq!(wrong("Yoshida1990Order6A"), 3);
    for name in ["Suzuki1990", "Ruth1983", "StormerVerlet"] {
        assert_eq!(wrong(name), 0, "{name}");
    }
}

#[test]
fn certify_keeps_printed_fractions_exact() {
    let fixed = |name: &str| -> Vec<(String, String)> {
        let method = method(name);
        let found = certify(&method.splitting(), &method.claim()).expect(name);
        let text = |x: &super::super::Fixed| (x.coefficient.to_string(), x.value.to_string());
        found.fixed().iter().map(text).collect()
    };
    let one = |name: &str, value: &str| vec![(name.to_owned(), value.to_owned())];
    assert_eq!(fixed("McLachlan1995SS5"), one("drift[0]", "7/25"));
    assert_eq!(fixed("McLachlan1995SS17"), one("drift[0]", "25/194"));
    assert_eq!(fixed("McLachlan1995S4"), one("drift[1]", "-1/22"));
    assert_eq!(fixed("McLachlan1995S5"), one("drift[1]", "-1/10"));
    // The sum of the drifts leaves 6/11 for the other drift.
    let method = method("McLachlan1995S4");
    let found = certify(&method.splitting(), &method.claim()).expect("certified");
    let drift = found.enclose(Coefficient::Drift(0), 2000).expect("a drift");
    assert!(drift.contains(&ratio(6, 11)) && drift.width_bits() < -1990);
}

/// Störmer–Verlet, Ruth's fractions, and two methods with one free decimal.
#[test]
fn rational_methods_are_exact() {
    for name in [
        "StormerVerlet",
        "Ruth1983",
        "McLachlan1995S2",
        "McLachlanAtela1992Order2Optimal",
    ] {
        let method = method(name);
        let found = certify(&method.splitting(), &method.claim()).expect(name);
        assert!(found.is_exact(), "{name}");
        let values = found.coefficients().map(|c| found.rational(c).expect(name));
        assert!(values.map(|x| x.abs()).max().is_some());
    }
    let ruth = method("Ruth1983");
    let found = certify(&ruth.splitting(), &ruth.claim()).expect("certified");
    assert_eq!(found.rational(Coefficient::Kick(2)), Some(ratio(-1, 24)));
    assert!(found.distance().is_zero() && found.fixed().is_empty());
}

#[test]
fn enclosures_do_not_depend_on_the_order_of_the_calls() {
    let method = method("BlanesMoan2002S6");
    let new = || certify(&method.splitting(), &method.claim()).expect("certified");
    let (first, second) = (new(), new());
    let name = Coefficient::Kick(0);
    let bits = [64, 3000, 200, 900, 3000];
    let ascending: Vec<Interval> = bits
        .iter()
        .filter_map(|&b| first.enclose(name, b))
        .collect();
    // From several threads at once, and in the opposite order.
    let descending: Vec<Interval> = std::thread::scope(|scope| {
        let ask = |&b: &u32| {
            let second = second.clone();
            scope.spawn(move || second.enclose(name, b))
        };
        let threads: Vec<_> = bits.iter().rev().map(ask).collect();
        let join = |t: std::thread::ScopedJoinHandle<'_, Option<Interval>>| t.join().ok().flatten();
        threads.into_iter().filter_map(join).collect()
    });
    assert!(ascending.iter().eq(descending.iter().rev()));
    assert_eq!(ascending.len(), bits.len());
    for (interval, bits) in ascending.iter().zip(bits) {
        assert_eq!(interval.bits(), bits);
        assert!(interval.width_bits() <= 3 - i64::from(bits));
        let finest = ascending[1].with_bits(bits);
        assert!(interval.low() <= finest.high() && finest.low() <= interval.high());
    }
}
