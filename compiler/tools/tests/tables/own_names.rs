//! Tables with their own names and their own order.

use symplectic_compiler::{Definition, Error, Library, Limits, Tableau};
use symplectic_tools::{ImportOrigin, OwnNames, import, import_own};

fn derived(definition: &str) -> Tableau {
    let definition = Definition::parse(definition).expect(definition);
    definition.derive(&Limits::default()).expect("derived")
}

fn splitting(drift: &str, kick: &str, drifts_first: Option<bool>, symmetric: bool) -> OwnNames {
    OwnNames::Splitting {
        drift: drift.to_owned(),
        kick: kick.to_owned(),
        drifts_first,
        symmetric,
    }
}

fn composition(base: &str, symmetric: bool) -> OwnNames {
    OwnNames::Composition {
        base: base.to_owned(),
        weights: "gamma".to_owned(),
        symmetric,
    }
}

fn read(names: &OwnNames, file: &str, text: &str) -> Result<(Tableau, ImportOrigin), Error> {
    import_own(names, None, file, text, &Limits::default())
}

#[test]
fn a_splitting_is_read_by_its_own_names_and_order() {
    for (names, file, text, expected) in [
        (
            splitting("c", "d", Some(true), false),
            "table.py",
            "c = [0.25, 0.75]\nd = [1/3, 2/3]\n",
            "first: drift, drift: [1/4, 3/4], kick: [1/3, 2/3]",
        ),
        (
            splitting("c", "d", Some(false), false),
            "table.jl",
            "c = [0.25, 0.75]\nd = [1//3, 2//3]\n",
            "drift: [1/4, 3/4], kick: [1/3, 2/3]",
        ),
        // One drift more than kicks, one kick more than drifts: the longer list begins and ends the step.
        (
            splitting("x_coeff", "v_coeff", None, false),
            "table.c",
            "double x_coeff[3] = {0.25, 0.5, 0.25}; double v_coeff[2] = {0.5, 0.5};",
            "first: drift, drift: [1/4, 1/2, 1/4], kick: [1/2, 1/2, 0]",
        ),
        (
            splitting("D", "K", None, false),
            "table.f90",
            "real(8) :: k(2) = [0.5d0, 0.5d0], d(1) = [1.0d0]\n",
            "kick: [1/2, 1/2], drift: [1, 0]",
        ),
        // Half of a step.
        (
            splitting("c", "d", Some(true), true),
            "table.m",
            "c = [0.25 0.5]; d = [0.5];",
            "first: drift, drift: [1/4, 1/2, 1/4], kick: [1/2, 1/2, 0]",
        ),
    ] {
        let (tableau, origin) = read(&names, file, text).expect(text);
        assert_eq!(origin, ImportOrigin::Exact, "{text}");
        let expected = derived(expected);
        assert_eq!(tableau.exact_forms(), expected.exact_forms(), "{text}");
    }
    // The tables of libraries may have one more of what comes first, too.
    let text = "a = {1.0}; ahat = {0.5, 0.5};";
    let verlet = import(Library::Sundials, "verlet.c", text, &Limits::default());
    let expected = derived("kick: [1/2, 1/2], drift: [1, 0]");
    assert_eq!(
        verlet.expect("Verlet").exact_forms(),
        expected.exact_forms()
    );
}

/// Yoshida's solution A of order 6 (1990, table 1), with the weight in the middle last, first, missing, and all weights.
#[test]
fn the_weights_of_a_composition_are_read_whole_or_half() {
    let [w1, w2, w3] = [
        "-1.17767998417887",
        "0.235573213359357",
        "0.784513610477560",
    ];
    let middle = format!("1 - 2*(({w1}) + {w2} + {w3})");
    let expected = derived(&format!(
        "base: velocity-verlet, weights: [{w3}, {w2}, {w1}, 1.31518632068391], symmetric: true, claim: separable(6)"
    ));
    for (symmetric, list) in [
        (true, format!("[{w3}, {w2}, {w1}, {middle}]")),
        (true, format!("[{middle}, {w1}, {w2}, {w3}]")),
        // It is the one that the others leave, in either order.
        (true, format!("[{w1}, {w2}, {w3}]")),
        (true, format!("[{w3}, {w2}, {w1}]")),
        (
            false,
            format!("[{w3}, {w2}, {w1}, {middle}, {w1}, {w2}, {w3}]"),
        ),
    ] {
        let text = format!("gamma = {list}\n");
        let names = composition("velocity-verlet", symmetric);
        let (tableau, origin) = read(&names, "yoshida.py", &text).expect(&text);
        let ImportOrigin::NearDecimals {
            forced_by: Some(forced_by),
            distance: Some(distance),
        } = origin
        else {
            panic!("{text}: {origin:?}")
        };
        let condition =
            "order 6 with any symmetric basic method: the sum of the cubes of the weights is ";
        assert!(forced_by.starts_with(condition), "{forced_by}");
        // Each weight is rounded to 14 or 15 places.
        assert!(distance <= 1e-14, "{distance}");
        assert_eq!(tableau.to_f64(), expected.to_f64(), "{text}");
        assert_eq!(tableau.orders().separable.order, 6);
    }
    // Without a weight in the middle; decimals that satisfy the order as they are written are kept; another base.
    for (base, symmetric, list, weights) in [
        ("gauss-1", true, "[1/6, 1/3]", "[1/6, 1/3, 1/3, 1/6]"),
        (
            "lobatto-2",
            false,
            "[0.1234567, 0.8765433]",
            "[1234567/10^7, 8765433/10^7]",
        ),
        ("[kick: [1], drift: [1]]", false, "[0.5, 0.5]", "[1/2, 1/2]"),
    ] {
        let text = format!("gamma = {list}\n");
        let (tableau, origin) = read(&composition(base, symmetric), "w.py", &text).expect(&text);
        assert_eq!(origin, ImportOrigin::Exact, "{text}");
        let expected = derived(&format!("base: {base}, weights: {weights}"));
        assert_eq!(tableau.exact_forms(), expected.exact_forms(), "{text}");
    }
}

/// The triple jump of Yoshida in decimals whose sum is exactly 1: of order 4 only with a symmetric base.
const JUMP: &str = "gamma = [1.3512071919596578, -1.7024143839193156, 1.3512071919596578]\n";

/// Their sum is off by the rounding of the decimals: 4 half units of the last place.
#[test]
fn rounded_weights_of_steps_that_are_not_kicks_and_drifts_are_read() {
    let half = "0.784513610477560, 0.235573213359357, -1.17767998417887, 1.31518632068391";
    for (base, order) in [("gauss-1", 6), ("gauss-2", 6), ("symplectic-euler", 1)] {
        let text = format!("gamma = [{half}]\n");
        let (tableau, origin) = read(&composition(base, true), "w.py", &text).expect(base);
        let ImportOrigin::NearDecimals {
            forced_by: Some(forced_by),
            distance: Some(distance),
        } = origin
        else {
            panic!("{base}: {origin:?}")
        };
        let stated = format!("which is {order} up to rounding");
        assert!(forced_by.starts_with("the sum 1") && forced_by.contains(&stated));
        assert!((distance - 4e-15).abs() < 1e-20, "{distance}");
        let mirrored = "-1.17767998417887, 0.235573213359357, 0.784513610477560";
        let weights = half.replace("1.31518632068391", "1.315186320683906");
        let expected = derived(&format!("base: {base}, weights: [{weights}, {mirrored}]"));
        assert_eq!(tableau.exact_forms(), expected.exact_forms(), "{base}");
    }
}

#[test]
fn weights_for_a_base_that_is_not_symmetric_are_kept_and_no_higher_order_is_stated() {
    for base in ["symplectic-euler", "[kick: [1, 0], drift: [2/3, 1/3]]"] {
        let (tableau, origin) = read(&composition(base, false), "w.py", JUMP).expect(base);
        assert_eq!(origin, ImportOrigin::Exact, "{base}");
        assert_eq!(tableau.orders().separable.order, 1, "{base}");
    }
    // Nor for a base that is no method: it is symmetric, and has order 0.
    let base = "[a: [[1/4]], b: [1/2], a_tilde: [[1/4]], b_tilde: [1/2]]";
    let (tableau, origin) = read(&composition(base, false), "w.py", JUMP).expect(base);
    assert_eq!(origin, ImportOrigin::Exact);
    assert_eq!(tableau.orders().separable.order, 0);
    // With a symmetric base they are those of order 4.
    let names = composition("velocity-verlet", false);
    let (tableau, origin) = read(&names, "w.py", JUMP).expect("the triple jump");
    assert!(
        matches!(origin, ImportOrigin::NearDecimals { .. }),
        "{origin:?}"
    );
    assert_eq!(tableau.orders().separable.order, 4);
}

/// 63 times 1/63, rounded to eight places: the sum is off by 52 half units of the last place.
#[test]
fn many_weights_whose_errors_add_up_are_read() {
    let text = format!("gamma = [{}]\n", ["0.01587302"; 63].join(", "));
    let names = composition("velocity-verlet", false);
    let limits = Limits { stages: 64 };
    let read = import_own(&names, None, "w.py", &text, &limits);
    let (tableau, origin) = read.expect("63 weights");
    assert!(
        matches!(origin, ImportOrigin::NearDecimals { .. }),
        "{origin:?}"
    );
    let expected = format!(
        "base: velocity-verlet, weights: [{}]",
        ["1/63"; 63].join(", ")
    );
    let expected = Definition::parse(&expected).and_then(|definition| definition.derive(&limits));
    assert_eq!(tableau.to_f64(), expected.expect("63 steps").to_f64());
}

#[test]
fn unclear_names_are_refused_with_advice() {
    for (names, text, message) in [
        (
            splitting("c", "d", None, false),
            "c = [0.5, 0.5]\nd = [1, 0]\n",
            "line 2, column 1: as many drifts as kicks: which of them come first must be stated",
        ),
        (
            splitting("c", "d", Some(false), false),
            "c = [0.5, 0.5]\nd = [1]\n",
            "2 drifts `c` and 1 kicks `d`: a table has as many of both, or one more of what comes first",
        ),
        (
            splitting("drfit", "kick", Some(false), false),
            "drift = [0.5, 0.5]\nkick = [1, 0]\n",
            "the list `drfit` is missing; did you mean `drift`?",
        ),
        (
            composition("velocity-verlet", false),
            "gamma = [1.3512071919596578, -1.7024143839193153]\n",
            "the weights sum to -0.35120719195965750, not to 1; half of a palindrome is read with `--symmetric`",
        ),
        (
            composition("velocity-verlet", true),
            "gamma = [1.3, -1.8]\n",
            "whether the one in the middle is the last, the first or missing",
        ),
        (
            composition("velocity-verle", true),
            "gamma = [0.25, 0.5]\n",
            "unknown method `velocity-verle`",
        ),
        (
            composition("velocity-verlet", true),
            "gamma = []\n",
            "the weights sum to 0",
        ),
    ] {
        let error = read(&names, "table.py", text).expect_err(text).to_string();
        assert!(error.contains(message), "{text}: {error}");
    }
}

#[test]
fn names_with_a_type_or_with_a_common_value_are_read() {
    let expected = derived("first: drift, drift: [1/2, 1/2], kick: [1, 0]");
    for (file, text) in [
        (
            "t.py",
            "c: list[float] = [0.5, 0.5]\nd: \"np.ndarray\" = [1.0]\n",
        ),
        (
            "t.jl",
            "const c::Vector{Float64} = [0.5, 0.5]\nd::Vector = [1.0]\n",
        ),
        (
            "t.rs",
            "pub const c: [f64; 2] = [0.5, 0.5];\nstatic d: [f64; 1] = [1.0];\n",
        ),
        // As on many pages about Yoshida's method.
        ("t.py", "c1 = c2 = d1 / 2\nd1 = 1\nc = [c1, c2]\nd = [d1]\n"),
        ("t.c", "double c[2], d[1]; c[0] = c[1] = 0.5; d[0] = 1.0;"),
        // Neither a comparison nor an argument is a value.
        (
            "t.py",
            "c = [0.5, 0.5]\nd = [1.0]\ndef step(x, c=None, d=3):\n    if c == 1: return f(d=[2])\n    if x: c[0] == 1\n",
        ),
        ("t.py", "method = dict(c=[0.5, 0.5], d=[1.0])\n"),
    ] {
        let (tableau, _) = read(&splitting("c", "d", None, false), file, text).expect(text);
        assert_eq!(tableau.exact_forms(), expected.exact_forms(), "{text}");
    }
    // A block on one line is not a type.
    for text in [
        "c = [1]\nif x:\n    y = 1\nelse: c = [2]\n",
        "c = [1]\nif x: c = [2]\n",
    ] {
        let error = read(&splitting("c", "d", None, false), "t.py", text).expect_err("two");
        assert!(
            error.to_string().contains("`c` has a value already"),
            "{error}"
        );
    }
}

/// Only the lists of the table have to be numbers.
#[test]
fn lines_that_are_not_needed_are_ignored() {
    let expected = derived("kick: [7/24, 3/4, -1/24], drift: [2/3, -2/3, 1]");
    for text in [
        "version = 1.2.3\na = [2/3, -2/3, 1]\nahat = [7/24, 3/4, -1/24]\n",
        "# made on 2024-01-01\nmask = 0b1010\nname = f\"it's {name}\na = [2/3, -2/3, 1]\nahat = [7/24, 3/4, -1/24]\n",
        "don't panic\na = [2/3, -2/3, 1]\nahat = [7/24, 3/4, -1/24]\nn = 123_456\nother = [nan, 1e]\nc = 12abc\n",
    ] {
        let names = splitting("a", "ahat", Some(false), false);
        let (tableau, _) = read(&names, "ruth.py", text).expect(text);
        assert_eq!(tableau.exact_forms(), expected.exact_forms(), "{text}");
    }
    // Where it is needed, it is still wrong at its place.
    let names = splitting("a", "ahat", Some(false), false);
    let error = read(&names, "ruth.py", "a = [1, 1.2.3]\nahat = [1, 0]\n").expect_err("wrong");
    assert_eq!(
        error.to_string(),
        "ruth.py, column 9: found `1.2.3`, expected a number"
    );
}
