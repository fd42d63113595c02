//! What holds in all three tiers: spans, laws of the constructions, rounding, evidence, files.

use num_rational::BigRational;
use symplectic_compiler::export::{json, toml};
use symplectic_compiler::{Definition, Evidence, Limits, Tableau, Tier, catalogue, check, derive};

fn define(text: &str) -> Tableau {
    let definition = Definition::parse(text).unwrap_or_else(|error| panic!("{text}: {error}"));
    definition
        .derive(&Limits::default())
        .unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// Definitions of every construction in every tier.
const DEFINITIONS: &[(&str, Tier)] = &[
    (
        "basis: polynomial(3), nodes: [0, 1/4, 1]",
        Tier::NodeAlgebra,
    ),
    (
        "basis: legendre(2), quadrature: gauss(4)",
        Tier::NodeAlgebra,
    ),
    (
        "basis: [1, t - sqrt(2)], nodes: gauss(2)",
        Tier::NodeAlgebra,
    ),
    (
        "basis: polynomial(2), nodes: lobatto(2), exchange: true",
        Tier::NodeAlgebra,
    ),
    (
        "basis: [1, cos(pi*t), sin(pi*t)], nodes: [0, 1/2, 1]",
        Tier::ConstantField,
    ),
    (
        "basis: [1, cos(pi*t), sin(pi*t)], nodes: [1/6, 1/2, 5/6]",
        Tier::ConstantField,
    ),
    (
        "basis: [1, cos(t), sin(t)], nodes: [0, 1/3, 1]",
        Tier::ConstantField,
    ),
    (
        "basis: [1, exp(t/2), t*exp(-t)], nodes: [0, 1/2, 1]",
        Tier::ConstantField,
    ),
    (
        "basis: polynomial(2), nodes: [1/2 - sqrt(2)/4, 1/2 + sqrt(2)/4]",
        Tier::ConstantField,
    ),
    (
        "basis: polynomial(3), nodes: [0, 1/2 - sqrt(2)/4, cos(pi/5)]",
        Tier::ConstantField,
    ),
    (
        "basis: polynomial(2), nodes: [1/pi, 1]",
        Tier::ConstantField,
    ),
    (
        "basis: [1, cos(pi*t)], quadrature: [0, 1/3, 2/3, 1]",
        Tier::ConstantField,
    ),
    (
        "basis: polynomial(2), quadrature: [0, 1/2, 1], weights: [1/5, 3/5, 1/5]",
        Tier::ConstantField,
    ),
    ("a: [[0, 0], [1/2, 0]], b: [0, 1]", Tier::ConstantField),
    (
        "a: [[1/4, 1/4 - sqrt(3)/6], [1/4 + sqrt(3)/6, 1/4]], b: [1/2, 1/2], a_tilde: symplectic_partner",
        Tier::ConstantField,
    ),
    (
        "a: [[0, 0], [1/2, 1/2]], b: [1/2, 1/2], a_tilde: [[1/2, 0], [1/2, 0]], b_tilde: [1/2, 1/2]",
        Tier::ConstantField,
    ),
    (
        "basis: [1, t, cos(pi*t), sin(pi*t)], nodes: gauss(4)",
        Tier::Enclosure,
    ),
    (
        "basis: [1, exp(t), cos(pi*t)], nodes: [0, 1/2, 1]",
        Tier::Enclosure,
    ),
    ("basis: [1, tan(t)], nodes: [0, 1]", Tier::Enclosure),
    (
        "basis: [1, cos(t)], quadrature: lobatto(4), exchange: true",
        Tier::Enclosure,
    ),
    ("a: [[pi/8]], b: [e/3]", Tier::Enclosure),
];

#[test]
fn every_definition_is_in_the_strongest_tier() {
    for (text, tier) in DEFINITIONS {
        assert_eq!(define(text).tier(), *tier, "{text}");
    }
}

#[test]
fn only_enclosures_are_verified_and_they_are_never_proved_equal() {
    for (text, tier) in DEFINITIONS {
        let properties = define(text).properties();
        for (name, property) in properties.all() {
            let verified = matches!(property.evidence, Evidence::Verified { .. });
            assert!(
                !verified || *tier == Tier::Enclosure,
                "{text}: {name} {property}"
            );
        }
        let symplectic = &properties.symplectic;
        if *tier == Tier::Enclosure && !text.starts_with("a:") {
            assert!(symplectic.holds, "{text}");
            assert_eq!(
                symplectic.evidence,
                Evidence::Verified { bits: 1280 },
                "{text}"
            );
        }
    }
    let wrong = define("a: [[pi/8]], b: [e/3]").properties();
    assert_eq!(wrong.symplectic.evidence, Evidence::Refuted);
    assert_eq!(wrong.consistent.evidence, Evidence::Refuted);
}

#[test]
fn bases_of_one_space_give_one_tableau() {
    let waves = derive("1, cos(pi*t), sin(pi*t)", "0, 1/2, 1").expect("derived");
    let others = derive("1 + sin(pi*t), cos(pi*t), 2*sin(pi*t)", "0, 1/2, 1").expect("derived");
    assert_eq!(waves.exact_forms(), others.exact_forms());
    assert!(waves.has_coefficients_of(&others));
    let shifted = derive("2, cos(pi*(t - 1/3)), sin(pi*(t - 1/3))", "0, 1/2, 1").expect("derived");
    assert_eq!(waves.exact_forms(), shifted.exact_forms());

    let exponentials = derive("1, exp(t), exp(-t)", "0, 1/3, 1").expect("derived");
    let hyperbolic = derive("cosh(t) + 1, sinh(t) - 2, 3", "0, 1/3, 1").expect("derived");
    assert_eq!(exponentials.exact_forms(), hyperbolic.exact_forms());

    // Enclosures: all digits, since the coefficients are the same numbers.
    let digits = |basis: &str| {
        let tableau = derive(basis, "gauss(3)").expect("derived");
        tableau
            .numbers()
            .map(|number| number.decimal(80).to_string())
    };
    assert_eq!(
        digits("1, cos(t), sin(t)"),
        digits("1 - cos(t), cos(t + 1), sin(t)")
    );
    assert_ne!(digits("1, cos(t), sin(t)"), digits("1, cos(2*t), sin(2*t)"));
}

#[test]
fn a_quadrature_with_as_many_nodes_gives_the_square_construction() {
    for (functions, nodes) in [
        ("polynomial(3)", "gauss(3)"),
        ("polynomial(4)", "lobatto(4)"),
        ("legendre(3)", "[0, 1/5, 1]"),
        ("polynomial(2)", "[1/2 - sqrt(2)/4, 3/4]"),
    ] {
        let square = define(&format!("basis: {functions}, nodes: {nodes}"));
        let rectangular = define(&format!("basis: {functions}, quadrature: {nodes}"));
        assert!(
            square.has_coefficients_of(&rectangular),
            "{functions} at {nodes}"
        );
    }
    // With other weights it is another method.
    let simpson = define("basis: polynomial(3), quadrature: [0, 1/2, 1], weights: [1/6, 2/3, 1/6]");
    assert!(simpson.has_coefficients_of(&define("basis: polynomial(3), nodes: lobatto(3)")));
    let other = define("basis: polynomial(3), quadrature: [0, 1/2, 1], weights: [1/4, 1/2, 1/4]");
    assert!(!other.has_coefficients_of(&simpson));
}

/// T (2.35) with the orthonormal Legendre polynomials √(2k+1) P_k(2t − 1), in floating point.
#[test]
fn legendre_bases_are_tangs_method() {
    let tableau = define("basis: legendre(2), quadrature: gauss(4)").to_f64();
    for i in 0..4 {
        for j in 0..4 {
            let (c, x) = (tableau.c[i], tableau.c[j]);
            let a = c + 3.0 * (c * c - c) * (2.0 * x - 1.0);
            assert!((tableau.a[i][j] - tableau.b[j] * a).abs() < 1e-15);
            let a_tilde = 1.0 - x - 3.0 * (x * x - x) * (2.0 * c - 1.0);
            assert!((tableau.a_tilde[i][j] - tableau.b[j] * a_tilde).abs() < 1e-15);
        }
    }
    let exchanged = define("basis: legendre(2), quadrature: gauss(4), exchange: true").to_f64();
    assert_eq!(
        (exchanged.a, exchanged.a_tilde),
        (tableau.a_tilde, tableau.a)
    );
}

/// Another route to every digit and double: many more digits, and the decimal reader of the standard library.
#[test]
#[ignore = "thorough"]
fn every_coefficient_is_correctly_rounded() {
    // The matrices of the longest repeat their weights.
    let usual = catalogue::entries().filter(|entry| entry.stages <= Limits::default().stages);
    let catalogue = usual.map(|entry| entry.derive().expect("derived"));
    let all = catalogue.chain(DEFINITIONS.iter().map(|(text, _)| define(text)));
    let mut count = 0;
    for tableau in all {
        for number in tableau.numbers().iter() {
            let long = number.decimal(120).to_string();
            assert_eq!(Ok(number.to_f64()), long.parse(), "{long}");
            assert_eq!(Ok(number.to_f32()), long.parse(), "{long}");
            let forty = number.decimal(40);
            let exactly = if long == "0" {
                "0/1".to_owned()
            } else {
                fraction(&long)
            };
            let exactly: BigRational = exactly.parse().expect("a fraction");
            assert_eq!(
                forty,
                symplectic_compiler::arithmetic::rounding::Decimal::round(&exactly, 40)
            );
            count += 1;
        }
    }
    assert!(count > 4000, "{count}");
}

/// A decimal as a fraction of whole numbers.
fn fraction(decimal: &str) -> String {
    let (mantissa, exponent) = decimal.split_once('e').unwrap_or((decimal, "0"));
    let (whole, digits) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let exponent: i64 = exponent.parse().expect("an exponent");
    let power = usize::try_from(digits.len() as i64 - exponent).expect("a small number");
    format!("{whole}{digits}/1{}", "0".repeat(power))
}

#[test]
fn near_ties_fall_to_the_right_side() {
    // The middle between two doubles, two singles, and two decimals of five digits, with something added.
    let middles = [
        ("1 + 1/2^53", 1.0, 1.0 + f64::EPSILON),
        ("3/2 - 3/2^53", 1.5 - 2.0 * f64::EPSILON, 1.5 - f64::EPSILON),
    ];
    for (middle, below, above) in middles {
        for more in ["sqrt(2)/2^300", "pi/10^270", "(pi + e)/2^400", "exp(-500)"] {
            let rounded = |sign: &str| {
                define(&format!("a: [[{middle} {sign} {more}]], b: [1]"))
                    .to_f64()
                    .a[0][0]
            };
            assert_eq!(
                (rounded("-"), rounded("+")),
                (below, above),
                "{middle} ± {more}"
            );
        }
        // Ties go to even, however they are written.
        for zero in [
            "0",
            "sqrt(2)*sqrt(3) - sqrt(6)",
            "cos(pi/7) - cos(2*pi/7) + cos(3*pi/7) - 1/2",
            "(pi - 1)*(pi + 1) - pi^2 + 1",
            "exp(1/2)^2 - e",
        ] {
            let tie = define(&format!("a: [[{middle} + {zero}]], b: [1]"));
            let even = if below.to_bits() % 2 == 0 {
                below
            } else {
                above
            };
            assert_eq!(tie.to_f64().a[0][0], even, "{middle} + {zero}");
        }
    }
    let single = |text: &str| {
        let tableau = define(&format!("a: [[{text}]], b: [1]"));
        tableau.numbers().a[0][0].to_f32()
    };
    assert_eq!(single("1 + 1/2^24 + sqrt(2)/2^80"), 1.0 + f32::EPSILON);
    assert_eq!(single("1 + 1/2^24 - sqrt(2)/2^80"), 1.0);
    assert_eq!(single("1 + 1/2^24"), 1.0);
    let decimal = |text: &str| {
        let tableau = define(&format!("a: [[{text}]], b: [1]"));
        tableau.numbers().a[0][0].decimal(5).to_string()
    };
    assert_eq!(decimal("0.123455 + sqrt(2)/10^40"), "0.12346");
    assert_eq!(decimal("0.123445 - pi/10^40"), "0.12344");
    assert_eq!(decimal("0.123445"), "0.12344");
}

#[test]
fn hidden_zeros_are_found() {
    for zero in [
        "sqrt(2)*sqrt(3) - sqrt(6)",
        "sqrt(5 + 2*sqrt(6)) - sqrt(2) - sqrt(3)",
        "cbrt(2 + sqrt(5)) + cbrt(2 - sqrt(5)) - 1",
        "cos(pi/7) - cos(2*pi/7) + cos(3*pi/7) - 1/2",
        "root(t^3 - 3*t + 1, 2) - 2*cos(4*pi/9)",
        "1/(pi - 1) - 1/(pi + 1) - 2/(pi^2 - 1)",
        "cosh(1)^2 - sinh(1)^2 - 1",
        "sin(1)^2 + cos(1)^2 - 1",
        "sin(2) - 2*sin(1)*cos(1)",
        "cos(pi/3 + 1) - cos(1)/2 + sqrt(3)*sin(1)/2",
    ] {
        let tableau = define(&format!("a: [[{zero}]], b: [1]"));
        assert_eq!(
            tableau.exact_forms().a[0][0].as_deref(),
            Some("0"),
            "{zero}"
        );
        let beside = define(&format!("a: [[{zero} + 1/10^30]], b: [1]"));
        assert_ne!(beside.exact_forms().a[0][0].as_deref(), Some("0"), "{zero}");
    }
    // Two transcendental numbers: only verified, and said so.
    let two = define("a: [[(e - pi)*(e + pi) - e^2 + pi^2]], b: [1]");
    assert_eq!(two.tier(), Tier::Enclosure);
    assert_eq!(
        two.properties().first_row_zero.evidence,
        Evidence::Verified { bits: 1280 }
    );
    assert_eq!(two.to_f64().a[0][0], 0.0);
}

#[test]
fn exact_forms_are_read_again() {
    for (text, tier) in DEFINITIONS {
        if *tier == Tier::Enclosure {
            continue;
        }
        let tableau = define(text);
        let forms = tableau.exact_forms();
        for (form, number) in forms.iter().zip(tableau.numbers().iter()) {
            let Some(form) = form else { continue };
            let again = define(&format!("a: [[{form}]], b: [1]"));
            assert_eq!(
                again.numbers().a[0][0].decimal(60),
                number.decimal(60),
                "{form}"
            );
            // Tangents of half angles are written anew with the half of the half.
            if !form.contains("tan") {
                assert_eq!(again.exact_forms().a[0][0].as_ref(), Some(form), "{text}");
            }
        }
    }
}

#[test]
fn files_of_every_tier_are_read_and_checked() {
    for (text, _) in DEFINITIONS {
        let tableau = define(text).named("any");
        let file = toml::write(&tableau, 25);
        assert_eq!(
            check("t.toml", &file, &Limits::default()).as_ref(),
            Ok(&tableau),
            "{text}"
        );
        assert_eq!(
            toml::read("t.toml", &file, &Limits::default()).as_ref(),
            Ok(&tableau),
            "{text}"
        );
        let exported = json::write(&tableau, 25);
        assert_eq!(
            json::read("t.json", &exported, &Limits::default()).as_ref(),
            Ok(&tableau),
            "{text}"
        );
        // A person's file has the definition only.
        let end = file
            .find("\n[exact]")
            .or(file.find("\n[decimals]"))
            .expect("a section");
        let written: String = file[..end]
            .lines()
            .filter(|line| !line.starts_with("stages") && !line.starts_with("tier"))
            .map(|line| format!("{line}\n"))
            .collect();
        assert_eq!(
            check("t.toml", &written, &Limits::default()).as_ref(),
            Ok(&tableau),
            "{written}"
        );
    }
}

#[test]
fn changed_digits_in_files_of_other_tiers_are_found() {
    for (text, _) in DEFINITIONS.iter().skip(4).step_by(6) {
        let file = toml::write(&define(text), 8);
        let start = file.find("tier = ").expect("a tier");
        let bytes = file.as_bytes();
        let digits = (start..file.len()).filter(|&position| bytes[position].is_ascii_digit());
        // A prime stride, so that every kind of entry is met; each check derives and proves anew.
        for position in digits.step_by(11) {
            // Comments are not looked at.
            if file[..position].rfind('#') > file[..position].rfind('\n') {
                continue;
            }
            let digit = if bytes[position] == b'7' { "3" } else { "7" };
            let changed = format!("{}{digit}{}", &file[..position], &file[position + 1..]);
            let result = check("t.toml", &changed, &Limits::default());
            assert!(
                result.is_err(),
                "{text}: {}",
                &file[position.saturating_sub(30)..position + 1]
            );
        }
    }
}

#[test]
fn runge_kutta_methods_are_given() {
    let rk4 = define(
        "a: [[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 1/2, 0, 0], [0, 0, 1, 0]], b: [1/6, 1/3, 1/3, 1/6]",
    );
    let properties = rk4.properties();
    assert!(properties.equal_matrices.holds && properties.consistent.holds);
    assert!(!properties.symplectic.holds && !properties.symmetric.holds);
    assert_eq!(rk4.to_f64().c, [0.0, 0.5, 0.5, 1.0]);
    // The stages keep the order in which they are given.
    let reversed = define("a: [[1/2, 1/2], [0, 0]], b: [1/2, 1/2], a_tilde: symplectic_partner");
    assert_eq!(reversed.to_f64().c, [1.0, 0.0]);
    assert!(reversed.properties().symmetric.holds && reversed.properties().explicit.holds);
}

#[test]
fn weights_go_with_their_nodes() {
    let sorted = define("basis: [1], quadrature: [0, 1], weights: [3/4, 1/4]");
    let given = define("basis: [1], quadrature: [1, 0], weights: [1/4, 3/4]");
    assert!(given.has_coefficients_of(&sorted));
    assert_eq!(given.provenance(), sorted.provenance());
    assert_eq!(given.to_f64().b, [0.75, 0.25]);
}

#[test]
fn constant_factors_of_basis_functions_do_not_change_the_method() {
    for (with, without) in [
        ("[1, pi*t, exp(-t)]", "[1, t, exp(-t)]"),
        ("[e, cos(pi*t)*e, sin(pi*t)]", "[1, cos(pi*t), sin(pi*t)]"),
    ] {
        let [with, without] =
            [with, without].map(|basis| define(&format!("basis: {basis}, nodes: [0, 1/2, 1]")));
        assert_eq!(with.tier(), Tier::ConstantField);
        assert!(with.has_coefficients_of(&without));
    }
}

#[test]
fn a_coefficient_of_1e_434_is_not_zero() {
    let tiny = define("a: [[pi*exp(-1000)]], b: [1 + 1/2^53 + pi*exp(-1000)]");
    assert_eq!(tiny.tier(), Tier::Enclosure);
    assert_eq!(tiny.properties().first_row_zero.evidence, Evidence::Refuted);
    let digits = tiny.numbers().a[0][0].decimal(3).to_string();
    assert_eq!(digits, "1.59e-434");
    assert_eq!(tiny.to_f64().b[0], 1.0 + f64::EPSILON);
}

#[test]
fn fields_that_would_be_too_large_give_way_to_enclosures() {
    for text in [
        "basis: [1, cos(200*t), sin(200*t)], nodes: [0, 1/3, 1]",
        "basis: [1, exp(t)], nodes: [0.1, 0.957]",
        "a: [[exp(400) + exp(1/2)]], b: [1]",
        "basis: polynomial(5), nodes: [cos(pi/5), exp(-1), cbrt(2)/2, sqrt(3)/2, exp(-1/2)]",
    ] {
        assert_eq!(define(text).tier(), Tier::Enclosure, "{text}");
    }
}

#[test]
fn zeros_at_nodes_of_any_degree_are_exact() {
    for nodes in ["radau-left(5)", "lobatto(6)"] {
        let tableau = derive(
            &format!("polynomial({})", &nodes[nodes.len() - 2..nodes.len() - 1]),
            nodes,
        )
        .expect("derived");
        let forms = tableau.exact_forms();
        let mut zeros = 0;
        for (form, number) in forms.iter().zip(tableau.numbers().iter()) {
            if number.is_zero() {
                assert_eq!(form.as_deref(), Some("0"), "{nodes}");
                zeros += 1;
            }
        }
        assert!(zeros > 4, "{nodes}");
    }
}
