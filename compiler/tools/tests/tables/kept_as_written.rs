//! Decimals that satisfy what is claimed exactly as they are written are kept to the digit, and so are expressions of them.

use symplectic_compiler::{Definition, Library, Limits, Tableau, check, export};
use symplectic_tools::{ImportOrigin, Language, import_with_origin, refine, refine_table};

fn read(library: Library, text: &str) -> (Tableau, ImportOrigin) {
    import_with_origin(library, "table", text, &Limits::default()).expect(text)
}

fn derived(definition: &str) -> Tableau {
    let definition = Definition::parse(definition).expect(definition);
    definition.derive(&Limits::default()).expect("derived")
}

/// Each table in two spellings: with entries that are expressions of other decimals, and with all decimals written out.
#[test]
fn a_table_that_satisfies_its_order_as_written_is_imported_to_the_digit() {
    for (library, spellings, exact) in [
        (
            Library::Odeint,
            [
                "x = 0.1234567\na = [x, 1-x]\nb = [1, 0]\n",
                "a = [0.1234567, 0.8765433]\nb = [1, 0]\n",
            ],
            "first: drift, drift: [1234567/10^7, 8765433/10^7], kick: [1, 0]",
        ),
        (
            Library::Odeint,
            [
                "x = 0.2345678\na = [x, 1-2*x, x]\nb = [0.5, 0.5, 0]\n",
                "a = [0.2345678, 0.5308644, 0.2345678]\nb = [0.5, 0.5, 0]\n",
            ],
            "first: drift, drift: [2345678/10^7, 5308644/10^7, 2345678/10^7], kick: [1/2, 1/2, 0]",
        ),
        // The order needs a quotient of decimals, which does not terminate.
        (
            Library::Nodepy,
            [
                "x = 0.1234567\nA = [[0, 0], [x, 0]]\nb = [1 - 1/(2*x), 1/(2*x)]\n",
                "x = 0.1234567\ny = 0.5/x\nA = [[0, 0], [0.1234567, 0]]\nb = [1 - y, y]\n",
            ],
            "a: [[0, 0], [1234567/10^7, 0]], b: [-3765433/1234567, 5000000/1234567]",
        ),
        // Steps of the midpoint rule, whose matrix consists of halves.
        (
            Library::RungeKuttaJl,
            [
                "x = 0.2345678; y = 1 - 2x; a = [x/2 0 0; x y/2 0; x y x/2]; b = [x, y, x]",
                "a = [0.1172839 0 0; 0.2345678 0.2654322 0; 0.2345678 0.5308644 0.1172839]; b = [0.2345678, 0.5308644, 0.2345678]",
            ],
            "base: gauss-1, weights: [2345678/10^7, 5308644/10^7, 2345678/10^7]",
        ),
        // A root of a decimal: the weights of an order 2 that is exact for any number.
        (
            Library::Nodepy,
            [
                "x = sqrt(0.1234567)\nA = [[0, 0], [x, 0]]\nb = [1 - 1/(2*x), 1/(2*x)]\n",
                "A = [[0, 0], [sqrt(0.1234567), 0]]\nb = [1 - 0.5/sqrt(0.1234567), 0.5/sqrt(0.1234567)]\n",
            ],
            "a: [[0, 0], [sqrt(1234567/10^7), 0]], b: [1 - 1/(2*sqrt(1234567/10^7)), 1/(2*sqrt(1234567/10^7))]",
        ),
    ] {
        let exact = derived(exact);
        for text in spellings {
            let (tableau, origin) = read(library, text);
            assert_eq!(origin, ImportOrigin::Exact, "{text}");
            assert_eq!(tableau.exact_forms(), exact.exact_forms(), "{text}");
        }
    }
}

/// PEFRL (Omelyan, Mryglod & Folk 2002): its decimals violate the conditions of order 3 by 1e-17. What is computed from them is not rounded
/// by itself, so that both spellings are the same method.
#[test]
fn a_table_that_has_to_be_moved_is_the_same_in_both_spellings() {
    let computed = "xi = 0.1786178958448091\nlam = -0.2123418310626054\nchi = -0.06626458266981849\n\
                    a = [xi, chi, 1-2*(chi+xi), chi, xi]\nb = [(1-2*lam)/2, lam, lam, (1-2*lam)/2, 0]\n";
    let written = "a = [0.1786178958448091, -0.06626458266981849, 0.77529337365001878, -0.06626458266981849, 0.1786178958448091]\n\
                   b = [0.7123418310626054, -0.2123418310626054, -0.2123418310626054, 0.7123418310626054, 0]\n";
    let [x, y] = [computed, written].map(|text| {
        let (tableau, origin) = read(Library::Odeint, text);
        let ImportOrigin::NearDecimals {
            forced_by: Some(forced_by),
            distance: Some(distance),
        } = origin
        else {
            panic!("{origin:?}")
        };
        assert!(
            forced_by.starts_with("order 4 for ") && distance < 1e-16,
            "{forced_by} {distance}"
        );
        // All written out, the number that was computed claims more digits than its ingredients have.
        assert!(
            tableau.wrong_digits().is_empty() || text == written,
            "{text}"
        );
        // The file of the result is derived again from the numbers with their errors.
        let file = export::toml::write(&tableau, 30);
        let again = check("pefrl.toml", &file, &Limits::default()).expect("the same method");
        assert_eq!(
            again.wrong_digits().len(),
            tableau.wrong_digits().len(),
            "{file}"
        );
        Language::Sundials.write(&tableau, 30).expect("written")
    });
    let numbers = |text: &str| text.lines().skip_while(|line| !line.contains('{')).count();
    assert_eq!(numbers(&x), numbers(&y));
    let hexadecimal = |text: &str| -> Vec<String> {
        let words = text.split(|c: char| c.is_whitespace() || matches!(c, ',' | '{' | '}'));
        let words = words.filter(|word| word.trim_start_matches('-').starts_with("0x"));
        words.map(str::to_owned).collect()
    };
    assert!(!hexadecimal(&x).is_empty());
    assert_eq!(hexadecimal(&x), hexadecimal(&y));
}

/// The condition that the numbers violate is part of the origin, and a number that was computed has the error of its ingredients.
#[test]
fn a_forced_change_names_its_condition() {
    let text = "x = 0.2345678\ny = 0.5308643\na = [x, y, 1-x-y]\nb = [0.5, 0.5, 0]\n";
    let (tableau, origin) = read(Library::Odeint, text);
    let ImportOrigin::NearDecimals { forced_by, .. } = origin else {
        panic!("{origin:?}")
    };
    assert_eq!(
        forced_by.as_deref(),
        Some(
            "order 2 for nystrom H: p[q] has the weight 0.499999950000… instead of 1/2, a difference of -5.00000000000e-8…"
        )
    );
    let definition = tableau.provenance().definition.to_string();
    assert!(definition.contains("0.2345679±1e-7"), "{definition}");
    assert_eq!(tableau.orders().separable.order, 2);
}

/// A structure that the digits only nearly have does not change them where the claim holds without it.
#[test]
fn a_claim_that_holds_as_printed_keeps_every_number() {
    for (claimed, exact) in [
        // Nearly a palindrome: 0.23456785 would round to both.
        (
            "first: drift, drift: [0.2345678, 0.5308643, 0.2345679], kick: [0.5, 0.5, 0], claim: separable(1)",
            "first: drift, drift: [2345678/10^7, 5308643/10^7, 2345679/10^7], kick: [1/2, 1/2, 0]",
        ),
        // Nearly 1/3.
        (
            "first: drift, drift: [0.3333333, 0.3333334, 0.3333333], kick: [0.5, 0.5, 0], claim: separable(2)",
            "first: drift, drift: [3333333/10^7, 3333334/10^7, 3333333/10^7], kick: [1/2, 1/2, 0]",
        ),
        (
            "base: velocity-verlet, weights: [0.2345678, 0.5308643, 0.2345679], claim: separable(2)",
            "base: velocity-verlet, weights: [2345678/10^7, 5308643/10^7, 2345679/10^7]",
        ),
    ] {
        let claimed = derived(claimed);
        assert_eq!(
            claimed.exact_forms(),
            derived(exact).exact_forms(),
            "{exact}"
        );
        assert!(claimed.wrong_digits().is_empty());
    }
}

/// An expression of printed numbers in a claim is exact given these, as in the files of libraries.
#[test]
fn a_claim_with_computed_numbers_is_that_of_the_decimals() {
    for (computed, written) in [
        (
            "first: drift, drift: [0.2345678, 1 - 2*0.2345678, 0.2345678], kick: [0.5, 0.5, 0], claim: separable(2)",
            "first: drift, drift: [0.2345678, 0.5308644, 0.2345678], kick: [0.5, 0.5, 0], claim: separable(2)",
        ),
        (
            "base: velocity-verlet, weights: [0.784513610477560, 0.235573213359357, -1.17767998417887, \
             1 - 2*(0.784513610477560 + 0.235573213359357 - 1.17767998417887)], symmetric: true, claim: separable(6)",
            "base: velocity-verlet, weights: [0.784513610477560, 0.235573213359357, -1.17767998417887, \
             1.315186320683906 ± 1.2e-14], symmetric: true, claim: separable(6)",
        ),
    ] {
        let [computed, written] = [computed, written].map(derived);
        assert_eq!(computed.to_f64(), written.to_f64());
        assert_eq!(computed.orders(), written.orders());
        // The definition has the number and its bound, and is derived again.
        let again = derived(&computed.provenance().definition.to_string());
        assert_eq!(again.to_f64(), written.to_f64());
    }
    // Exact numbers need no claim.
    let exact = "base: velocity-verlet, weights: [sqrt(2)/2, 1 - sqrt(2)], symmetric: true, claim: separable(2)";
    let exact = Definition::parse(exact).expect(exact);
    let error = exact.derive(&Limits::default()).expect_err("no decimals");
    assert!(
        error
            .to_string()
            .contains("leave it out where numbers are exact"),
        "{error}"
    );
}

#[test]
fn a_file_that_satisfies_its_claim_as_printed_is_refined_to_itself() {
    let text = "[claim]\nclass = \"separable\"\norder = 2\n[printed]\nkick = [\"0\", \"0.5\", \"0.5\"]\n\
                drift = [\"0.2345678\", \"0.5308644\", \"0.2345678\"]\n";
    let computed = text.replace("0.5308644", "1 - 2*0.2345678");
    let computed = refine("splitting.toml", &computed).expect("order 2");
    let refined = refine("splitting.toml", text).expect("order 2");
    let texts = [&refined, &computed].map(|refined| refined.text(20).expect("few digits"));
    assert_eq!(texts[0], texts[1]);
    let refined = refined.text(20).expect("few digits");
    assert!(
        refined.contains("drift[1]   0.53086440000000000000 = 1327161/2500000"),
        "{refined}"
    );
    // An explicit method of order 2 for any node, and an implicit one of order 1 for any matrix.
    for (order, arrays, number) in [
        (
            2,
            "a = [[\"0\", \"0\"], [\"0.125\", \"0\"]]\nb = [\"-3.0000\", \"4\"]\nc = [\"0\", \"0.1250000001 ± 1e-9\"]\n",
            "a[1][0]   0.12500000000000000000",
        ),
        (
            2,
            "a = [[\"0\", \"0\"], [\"0.1234567\", \"0\"]]\nb = [\"1 - 1/(2*0.1234567)\", \"0.5/0.1234567\"]\n",
            "a[1][0]   0.12345670000000000000",
        ),
        (
            1,
            "a = [[\"0.1111111\", \"0.0123456\"], [\"0.7654321\", \"0.1234567\"]]\nb = [\"0.2345678\", \"0.7654322\"]\n",
            "a[1][0]   0.76543210000000000000",
        ),
    ] {
        let text = format!("[claim]\nclass = \"general\"\norder = {order}\n[printed]\n{arrays}");
        let table = refine_table("table.toml", &text)
            .expect("refined")
            .expect("arrays");
        let text = table.text(20).expect("few digits");
        assert!(
            text.contains(number) && text.contains("wrong digits none"),
            "{text}"
        );
    }
}
