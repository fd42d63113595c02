//! What certificates and tables claim, checked by a program in Python that shares no code with the compiler.

mod gradient;

use std::io::Write as _;
use std::path::PathBuf;
use std::process::Command;

use crate::run::{failure, stdout};

fn root() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// The exit status and the output of Python; `None` if there is no Python 3.11 here.
fn python(arguments: &[&str]) -> Option<(bool, String)> {
    let version = "import sys; sys.exit(sys.version_info < (3, 11))";
    let known = Command::new("python3").args(["-c", version]).status();
    if !known.is_ok_and(|status| status.success()) {
        let _ = writeln!(
            std::io::stderr(),
            "skipped, as there is no Python 3.11 here"
        );
        return None;
    }
    let output = Command::new("python3")
        .args(arguments)
        .current_dir(root())
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .output()
        .expect("Python runs");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(errors, "", "{arguments:?}");
    let text = String::from_utf8(output.stdout).expect("text");
    Some((output.status.success(), text))
}

/// A new folder for files that a test writes.
fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).expect("a folder");
    folder
}

#[test]
#[ignore = "thorough"]
fn the_checker_accepts_every_certificate_of_the_catalogue() {
    let Some((right, text)) = python(&["tableaux/check_certificate.py"]) else {
        return;
    };
    assert!(right, "{text}");
    for line in [
        "gauss-3.json: right: doubles, symplectic, symmetric, general 6, separable 6, nystrom 6, stability, table",
        "gauss-4.json: right: doubles, symplectic, symmetric, general 8, separable 8, nystrom 8, stability, table",
        "saba-4.json: right: doubles, palindrome, general 1, separable 2, nystrom 2, perturbed [8, 2], stability, table",
        "blanes-moan-2002-srkn14a.json: right: doubles, palindrome, general 1, separable 4, nystrom 6, perturbed [6, 6, 4], stability, table",
        "blanes-2013-aba-10-6-4.json: right: doubles, palindrome, general 1, separable 4, nystrom 4, perturbed [10, 6, 4], stability, table",
        "fourier-3.json: right: doubles, symplectic, symmetric, general 2, separable 2, nystrom 2, stability not covered, table",
        "suzuki-10.json: right: doubles, palindrome, general 1, separable 10, nystrom 10, perturbed [10, 10], stability not covered, table",
    ] {
        assert!(text.contains(line), "{line}: {text}");
    }
}

/// The first file is short, and alone it proves the claims that need no other. It names the others and is not satisfied.
#[test]
fn the_checker_without_its_other_files_names_the_unchecked_claims() {
    let program =
        std::fs::read_to_string(root().join("tableaux/check_certificate.py")).expect("the program");
    assert!(program.lines().count() <= 500);
    let alone = folder("alone").join("check_certificate.py");
    std::fs::write(&alone, program).expect("written");
    let arguments = [
        alone.to_str().expect("a path"),
        "tableaux/certificates/gauss-3.json",
        "tableaux/certificates/velocity-verlet.json",
        "tableaux/certificates/yoshida-1990-order-6-b.json",
    ];
    let Some((right, text)) = python(&arguments) else {
        return;
    };
    assert!(!right, "{text}");
    let expected = [
        "NOT ALL CHECKED: doubles, symplectic, symmetric, general 6, separable 6, nystrom 6, stability not checked here: needs checker/stability.py",
        "NOT ALL CHECKED: doubles, palindrome not checked here: needs checker/splittings.py",
        "NOT ALL CHECKED: solution not checked here: needs checker/solutions.py",
    ];
    assert_eq!(text.lines().count(), expected.len(), "{text}");
    for (line, part) in text.lines().zip(expected) {
        assert!(line.contains(part), "{part}: {line}");
    }
}

/// Every change of a processor is found: of a weight, of its kind, and of the order.
#[test]
fn the_checker_finds_a_changed_processor() {
    let text = std::fs::read_to_string(root().join("tableaux/certificates/processed-8-17.json"))
        .expect("a certificate");
    let folder = folder("processor");
    let changes = [
        ("", "", "separable 8"),
        (
            "\"back_and_forth\": true",
            "\"back_and_forth\": false",
            "WRONG",
        ),
        ("\"orders\": [8]", "\"orders\": [9]", "WRONG"),
        ("\"processor E3\"", "\"processor E5\"", "WRONG"),
        (
            "397810268625058950790974641671",
            "397810268625058950790974641673",
            "WRONG",
        ),
    ];
    for (from, to, expected) in changes {
        assert!(text.contains(from), "{from}");
        let file = folder.join("changed.json");
        std::fs::write(&file, text.replacen(from, to, 1)).expect("written");
        let program = "tableaux/check_certificate.py";
        let Some((_, found)) = python(&[program, file.to_str().expect("a path")]) else {
            return;
        };
        assert!(found.contains(expected), "{from}: {found}");
    }
}

/// The numbers of rooted trees with two colours, in all and where the colours alternate (OEIS A000151, A000081, each twice);
/// the conditions of each order that symplectic methods have for quadratic T (Calvo & Sanz-Serna 1993).
#[test]
fn the_trees_are_counted_right() {
    let program = "import sys; sys.path.insert(0, 'tableaux'); from check_certificate import trees; from checker.rootings import unrooted; \
                   print([len(trees(n, 'general')) for n in range(1, 7)], [len(trees(n, 'separable')) for n in range(1, 10)], \
                         [len(unrooted(n, 'nystrom')) for n in range(1, 9)])";
    let Some((_, text)) = python(&["-c", program]) else {
        return;
    };
    let expected =
        "[2, 4, 14, 52, 214, 916] [2, 2, 4, 8, 18, 40, 96, 230, 572] [2, 1, 2, 2, 4, 5, 10, 14]\n";
    assert_eq!(text, expected);
}

/// The equation behind one condition for all rootings of a tree, with random coefficients.
#[test]
fn rootings_are_equivalent_for_symplectic_methods() {
    let Some((_, text)) = python(&[
        "compiler/cli/tests/command/certificates/rootings.py",
        "tableaux",
    ]) else {
        return;
    };
    assert_eq!(text, "476 of 476\n");
}

/// Every digit of one certificate, and some of another, changed.
#[test]
fn the_checker_refutes_every_changed_digit_of_symplectic_euler() {
    let arguments = "compiler/cli/tests/command/certificates/mutations.py tableaux all-of symplectic-euler sampled 97 saba-2";
    let Some((_, text)) = python(&arguments.split_whitespace().collect::<Vec<_>>()) else {
        return;
    };
    assert_eq!(text, "144 changes\n");
}

/// Every digit of ten certificates, and some of their tables and of other files, changed.
#[test]
#[ignore = "thorough"]
fn a_wrong_digit_is_found() {
    let all = "symplectic-euler symplectic-euler-adjoint midpoint velocity-verlet position-verlet ruth-1983 \
               mclachlan-atela-1992-order-2-optimal radau-left-2 gauss-2 forest-ruth-1990";
    let sampled = "saba-2 mclachlan-1995-s2 newton-cotes-4 lobatto-3 lobatto-2-exchanged leok-zhang-3 radau-right-3 \
                   blanes-moan-2002-srkn6b mclachlan-1995-aba-8-4 kahan-li-1997-s9odr6-a yoshida-1990-order-6-b \
                   fourier-3 exponential-lobatto-2 triple-jump-8 \
                   sampled 13 mclachlan-atela-1992-order-4-optimal";
    let arguments = format!(
        "compiler/cli/tests/command/certificates/mutations.py tableaux all-of {all} sampled 97 {sampled}"
    );
    let arguments: Vec<&str> = arguments.split_whitespace().collect();
    let Some((_, text)) = python(&arguments) else {
        return;
    };
    let tried = text.strip_suffix(" changes\n").map(str::parse::<usize>);
    assert!(matches!(tried, Some(Ok(2000..))), "{text}");
}

/// Two digits of each certificate of the catalogue changed, one at a time.
#[test]
#[ignore = "thorough"]
fn a_wrong_digit_is_found_in_each_certificate() {
    let count = std::fs::read_dir(root().join("tableaux/certificates"))
        .expect("the certificates")
        .count();
    let program = "compiler/cli/tests/command/certificates/mutations.py";
    let Some((_, text)) = python(&[program, "tableaux", "random", "2"]) else {
        return;
    };
    assert_eq!(text, format!("{} changes\n", 2 * count));
}

/// A table with another verdict on a property than its certificate.
#[test]
fn a_table_has_the_properties_of_its_certificate() {
    let tables = root().join("tableaux");
    let folder = folder("properties");
    let certificate = folder.join("certificates/gauss-2.json");
    std::fs::create_dir_all(folder.join("certificates")).expect("a folder");
    std::fs::copy(tables.join("certificates/gauss-2.json"), &certificate).expect("copied");
    let table = std::fs::read_to_string(tables.join("gauss-2.toml")).expect("the table");
    let other = table.replacen("{ holds = true", "{ holds = false", 1);
    // Only files in a folder `certificates` have a table.
    let draft = folder.join("gauss-2.json");
    std::fs::copy(&certificate, &draft).expect("copied");
    std::fs::write(folder.join("../gauss-2.toml"), &other).expect("written");
    for (text, path, part) in [
        (&table, &certificate, "stability, table"),
        (
            &other,
            &certificate,
            "WRONG: gauss-2.toml: not proved: symplectic",
        ),
        (&other, &draft, "right: doubles"),
    ] {
        std::fs::write(folder.join("gauss-2.toml"), text).expect("written");
        let path = path.to_str().expect("a path");
        let Some((_, said)) = python(&["tableaux/check_certificate.py", path]) else {
            return;
        };
        assert!(said.contains(part), "{said}");
    }
}

/// Files that claim more than they prove, and files that are no certificates: each is rejected in one line that says why.
#[test]
fn the_checker_rejects_unproved_claims_and_damaged_certificates() {
    let read =
        |name: &str| std::fs::read_to_string(root().join("tableaux/certificates").join(name));
    let gauss = read("gauss-2.json").expect("a certificate");
    let solution = read("mclachlan-atela-1992-order-4-optimal.json").expect("a certificate");
    let edited = |text: &str, from: &str, to: &str| {
        assert!(text.contains(from), "{from}: {text}");
        text.replacen(from, to, 1)
    };
    let elsewhere = edited(
        &read("saba-8.json").expect("a certificate"),
        "\"0.17104888371",
        "\"0.18104888371",
    );
    let exponential = read("exponential-lobatto-2.json").expect("a certificate");
    let levels = read("triple-jump-8.json").expect("a certificate");
    let perturbed = read("blanes-2013-aba-10-6-4.json").expect("a certificate");
    let splitting = read("velocity-verlet.json").expect("a certificate");
    let irrational = read("saba-2.json").expect("a certificate");
    let long = "9".repeat(5000);
    // The implicit midpoint rule in numbers modulo x² − 1, where x is 1 and is written in place of it.
    let reducible = r#"{"format": "symplectic certificate", "version": 1, "name": "", "stages": 1, "layout": "matrices",
        "numbers": {"kind": "field", "polynomial": ["-1", "0", "1"], "root": "1.0"}, "b": [["1"]], "b_tilde": [["1"]],
        "a": [[["0", "1/2"]]], "a_tilde": [[["1/2"]]],
        "doubles": {"c": ["0x1p-1"], "c_tilde": ["0x1p-1"], "b": ["0x1p+0"], "b_tilde": ["0x1p+0"],
            "a": [["0x1p-1"]], "a_tilde": [["0x1p-1"]]},
        "symplectic": false, "order": {}, "not_covered": []}"#;
    let violated = |tree: &str| {
        edited(
            &gauss,
            "\"violated\": \"q[q^4]\"",
            &format!("\"violated\": \"{tree}\""),
        )
    };
    let weights = |count: usize| {
        let list = format!("[{}]", vec!["[\"1\"]"; count].join(","));
        let text = reducible.replace("\"matrices\"", "\"kicks first\"");
        let text = edited(&text, "\"stages\": 1", &format!("\"stages\": {count}"));
        let text = edited(
            &text,
            "\"a\": [[[\"0\", \"1/2\"]]], \"a_tilde\": [[[\"1/2\"]]],",
            "",
        );
        let text = edited(&text, "\"symplectic\": false, ", "");
        text.replace("[[\"1\"]]", &list)
    };
    let cases = [
        // Claims that are too good.
        (
            edited(
                &gauss,
                "\"general\": {\"order\": 4",
                "\"general\": {\"order\": 5",
            ),
            "order 5 (general)",
        ),
        // With a tree of the sixth order that is indeed violated.
        (
            edited(
                &gauss,
                "\"general\": {\"order\": 4, \"violated\": \"q[q^4]\", \"residual\": \"-0.00555555555556\"",
                "\"general\": {\"order\": 5, \"violated\": \"q[q^5]\", \"residual\": \"-0.0138888888889\"",
            ),
            "order 5 (general), tree",
        ),
        // One node twice.
        (
            edited(
                &gauss,
                "\"c\": [\"0x1.b0cb174df99c7p-3\", \"0x1.93cd3a2c8198ep-1\"]",
                "\"c\": [\"0x1.b0cb174df99c7p-3\", \"0x1.b0cb174df99c7p-3\"]",
            ),
            "nodes in order",
        ),
        // Three roots round to this decimal: 0.99, 1 and 1.01.
        (
            edited(
                reducible,
                "[\"-1\", \"0\", \"1\"]",
                "[\"-9999\", \"29999\", \"-30000\", \"10000\"]",
            ),
            "one root of the polynomial that rounds to 1.0",
        ),
        (
            edited(&gauss, "\"infinity\"", "\"3\""),
            "the end infinity of stable steps",
        ),
        (
            edited(&gauss, "\"symmetric\": true", "\"symmetric\": false"),
            "symmetric = False",
        ),
        (
            edited(&gauss, "\"q[q^4]\"", "\"q[q^3]\""),
            "as a tree of the next order",
        ),
        (
            edited(&solution, "\"orders\": [4]", "\"orders\": [5]"),
            "the conditions of the class, each once",
        ),
        (
            edited(&solution, "\"unknowns\": [\"", "\"unknowns\": [\"1"),
            "a solution of the order conditions",
        ),
        (
            elsewhere,
            "a solution of the order conditions that rounds to the digits",
        ),
        // The words of fourth order with three kicks are violated.
        (
            edited(
                &perturbed,
                "\"perturbed\": [10, 6, 4]",
                "\"perturbed\": [10, 6]",
            ),
            "orders [10, 6] for H_A + eps H_B, from what was solved",
        ),
        // The same numbers at other conditions.
        (
            edited(&perturbed, "\"AAB\"", "\"ABA\""),
            "the conditions of the class, each once",
        ),
        (
            edited(&gauss, "\"chain\":", "\"intervals \":"),
            "members that are known",
        ),
        (
            edited(&gauss, ", [1]]", "]"),
            "a chain from a derivative to a number",
        ),
        (
            edited(&solution, "\"orders\": [4]", "\"orders\": [4, 8]"),
            "orders that do not grow",
        ),
        (
            edited(&solution, "\"orders\": [4]", "\"orders\": [4, 4]"),
            "one order",
        ),
        (
            edited(&solution, "\"orders\": [4]", "\"orders\": [24]")
                .replace("nystrom\",", "perturbed\","),
            "orders with fewer words",
        ),
        (
            edited(&solution, "\"kicks first\"", "\"matrices\""),
            "the member 'a' is missing",
        ),
        (
            edited(&splitting, "\"order\":", "\"a\": \"rubbish\", \"order\":"),
            "members that are known, not a",
        ),
        (
            edited(&gauss, "\"order\":", "\"perturbed\": [2], \"order\":"),
            "orders [2] for H_A + eps H_B and no higher",
        ),
        (
            edited(
                &gauss,
                "\"residual\":",
                "\"error_constant\": 0, \"residual\":",
            ),
            "members that are known, not error_constant",
        ),
        (
            edited(
                &gauss,
                "\"doubles\": {",
                "\"doubles\": {\"b_hat\": [\"junk\"],",
            ),
            "members that are known, not b_hat",
        ),
        (
            edited(
                &gauss,
                "\"not_covered\": [",
                "\"not_covered\": [\"general 20\"",
            ),
            "a list of claims",
        ),
        (
            edited(
                &gauss,
                "\"not_covered\": [",
                "\"not_covered\": [\"stability\"",
            ),
            "a list of claims that are not made",
        ),
        (
            edited(
                &gauss,
                "\"not_covered\": [",
                "\"not_covered\": [\"order (perturbed)\", \"order (perturbed)\"",
            ),
            "each once",
        ),
        (
            edited(&gauss, "\"symplectic\": true", "\"symplectic\": [1]"),
            "symplectic = [1]",
        ),
        (reducible.to_owned(), "symplectic = False"),
        (violated("q[q^4"), "a tree, not"),
        (violated("zz q[q^4]"), "a tree, not"),
        (violated("q[q^0]"), "a tree, not"),
        (
            violated("q[p[q[p[q[p^99]^99]^99]^99]^99]"),
            "a tree with at most 60 vertices",
        ),
        (weights(1000), "1000 stages, of at most 64"),
        (
            edited(
                reducible,
                "[\"-1\", \"0\", \"1\"]",
                &format!("[{}\"1\"]", format!("\"{}\",", &long[..400]).repeat(40)),
            ),
            "a polynomial with at most 3000 digits",
        ),
        // No certificates.
        (String::new(), "JSONDecodeError"),
        ("[]".to_owned(), "an object"),
        ("{}".to_owned(), "the member 'format' is missing"),
        ("[".repeat(100_000), "RecursionError"),
        (
            edited(&gauss, "\"version\": 1", "\"version\": 2"),
            "WRONG: a certificate of version 2: this checker reads version 1; take the one of the version",
        ),
        (
            edited(&gauss, "\"symplectic certificate\"", "2"),
            "a certificate, as `symplectic certify` writes it",
        ),
        (
            edited(&gauss, "\"version\": 1", "\"version\": NaN"),
            "a whole number or a text, not NaN",
        ),
        (
            edited(&gauss, "\"version\": 1", &format!("\"version\": {long}")),
            "ValueError",
        ),
        (
            edited(&gauss, "\"name\": \"gauss-2\"", "\"name\": 2"),
            "the name as a text",
        ),
        (
            edited(&gauss, "\"stages\": 2", "\"stages\": 1e9"),
            "a whole number or a text, not 1e9",
        ),
        (
            edited(&gauss, "\"stages\": 2", "\"stages\": 2, \"stages\": 2"),
            "members with different names",
        ),
        (
            edited(&gauss, "\"stages\": 2", "\"stages\": 2, \"error\": 0"),
            "members that are known",
        ),
        (
            edited(&gauss, "\"b\": [\"1/2\"]", "\"b\": [\"1/0\"]"),
            "ZeroDivisionError",
        ),
        (
            edited(&gauss, "\"b\": [\"1/2\"]", "\"b\": 3"),
            "a list of rational numbers",
        ),
        (
            edited(&gauss, "\"b\": [\"1/2\"]", &format!("\"b\": [\"{long}\"]")),
            "a rational number, not 999",
        ),
        (
            edited(&gauss, "  \"b\": [\"1/2\"],\n", ""),
            "the member 'b' is missing",
        ),
        (
            edited(
                &solution,
                "\"unknowns\": [\"",
                "\"unknowns\": [\"1e999999999\", \"",
            ),
            "conditions, as many as unknowns",
        ),
        // Coefficients with another number in place of e, and another order of the field of a level.
        (
            edited(
                &exponential,
                "\"variable\": \"e\"",
                "\"variable\": \"exp(1/2)\"",
            ),
            "c_tilde[1] = ",
        ),
        (
            edited(
                &exponential,
                "\"variable\": \"e\"",
                "\"variable\": \"exp(2)\"",
            ),
            "a number X that is known",
        ),
        (
            edited(
                &levels,
                "[\"-2\", \"0\", \"0\", \"1\"]",
                "[\"-3\", \"0\", \"0\", \"1\"]",
            ),
            "one root of the polynomial",
        ),
        (
            edited(
                &levels,
                "\"separable\": {\"order\": 8",
                "\"separable\": {\"order\": 9",
            ),
            "order 9 (separable)",
        ),
        // A trace with irrational coefficients.
        (
            edited(&irrational, "false, false]", "false, true]"),
            "the stable ends of ['0', '2.6321",
        ),
        (
            edited(
                &irrational,
                "\"intervals\": [",
                "\"numerator\": [\"2\", \"-1\"], \"denominator\": [\"1\"], \"intervals\": [",
            ),
            "the trace of a step of the oscillator",
        ),
        (
            edited(&gauss, "\"residual\": \"-0", "\"residual\": \"-1e999999999"),
            "a decimal, not",
        ),
        (
            edited(
                &gauss,
                "\"violated\": \"q",
                &format!("\"violated\": \"{}", "q[".repeat(50_000)),
            ),
            "RecursionError",
        ),
    ];
    let folder = folder("rejected");
    let paths: Vec<String> = (0..cases.len())
        .map(|k| folder.join(format!("{k}.json")).display().to_string())
        .collect();
    for ((text, _), path) in cases.iter().zip(&paths) {
        std::fs::write(path, text).expect("written");
    }
    let missing = folder.join("missing.json").display().to_string();
    let mut arguments = vec!["tableaux/check_certificate.py", &missing];
    arguments.extend(paths.iter().map(String::as_str));
    let Some((right, text)) = python(&arguments) else {
        return;
    };
    assert!(!right, "{text}");
    let expected =
        std::iter::once("FileNotFoundError").chain(cases.iter().map(|(_, message)| *message));
    for (line, message) in text.lines().zip(expected) {
        assert!(
            line.contains("WRONG") && line.contains(message),
            "{message}: {line}"
        );
    }
    assert_eq!(text.lines().count(), cases.len() + 1, "{text}");
}

/// Gauss with 3 stages, the last two of them exchanged: the certificate gives the order of the stages for symmetry, and no other order
/// will do.
#[test]
fn symmetry_in_another_order_of_the_stages_is_checked() {
    let a = "[[5/36, 5/36 - sqrt(15)/30, 2/9 - sqrt(15)/15], [5/36 + sqrt(15)/30, 5/36, 2/9 + sqrt(15)/15], \
             [5/36 + sqrt(15)/24, 5/36 - sqrt(15)/24, 2/9]]";
    let text = stdout(&[
        "derive",
        "--a",
        a,
        "--b",
        "5/18, 5/18, 4/9",
        "--format",
        "toml",
        "--name",
        "gauss",
    ]);
    let folder = folder("reordered");
    let table = folder.join("gauss.toml");
    std::fs::write(&table, text).expect("written");
    let certificate = stdout(&["certify", table.to_str().expect("a path")]);
    let order = "\"symmetric\": [2, 1, 3]";
    assert!(certificate.contains(order), "{certificate}");
    for (stages, part) in [
        (
            "[2, 1, 3]",
            "right: doubles, symplectic, symmetric, general 6,",
        ),
        ("[3, 2, 1]", "WRONG: not proved: symmetric, stage 1"),
        ("[1, 2, 3]", "WRONG: not proved: symmetric, stages 1 and 2"),
        (
            "[2, 2, 3]",
            "WRONG: not proved: symmetric: an order of the stages",
        ),
        (
            "[2, 1]",
            "WRONG: not proved: symmetric: an order of the stages",
        ),
        (
            "[2, 1, 0]",
            "WRONG: not proved: symmetric: an order of the stages",
        ),
        ("true", "WRONG: not proved: symmetric = True"),
    ] {
        let path = folder.join("gauss.json");
        let changed = certificate.replace(order, &format!("\"symmetric\": {stages}"));
        std::fs::write(&path, changed).expect("written");
        let path = path.to_str().expect("a path");
        let Some((_, said)) = python(&["tableaux/check_certificate.py", path]) else {
            return;
        };
        assert!(said.contains(part), "{stages}: {said}");
    }
}

/// The order 11 of Gauss with 4 stages, with a tree of the next order that is violated. For other Hamiltonians the trees are too many, and the
/// simplifying assumptions prove 8.
#[test]
fn the_checker_rejects_order_11_of_gauss_4_with_too_many_trees() {
    let gauss = std::fs::read_to_string(root().join("tableaux/certificates/gauss-4.json"))
        .expect("a certificate");
    let general =
        r#""general": {"order": 8, "violated": "q[q^8]", "residual": "-0.0000226757369615"}"#;
    assert!(gauss.contains(general), "{gauss}");
    let false_claim =
        r#""general": {"order": 11, "violated": "q[q^11]", "residual": "-0.000536929057337"}"#;
    let with_all = gauss.replacen(general, false_claim, 1);
    let start = with_all.find("\"separable\"").expect("a claim");
    let end = start + with_all[start..].find("\"nystrom\"").expect("a claim");
    let end = end + with_all[end..].find('}').expect("its end") + 1;
    let before = with_all[..start].trim_end().trim_end_matches(',');
    let alone = format!("{before}{}", &with_all[end..]);
    let folder = folder("long");
    for (name, text, part) in [
        (
            "all.json",
            &with_all,
            "WRONG: not proved: orders that do not fall",
        ),
        (
            "alone.json",
            &alone,
            "NOT ALL CHECKED: doubles, symplectic, symmetric, general 11 not checked: too many trees, and simplifying assumptions prove 8,",
        ),
    ] {
        let path = folder.join(name);
        std::fs::write(&path, text).expect("written");
        let path = path.to_str().expect("a path");
        let Some((right, said)) = python(&["tableaux/check_certificate.py", path]) else {
            return;
        };
        assert!(!right && said.contains(part), "{part}: {said}");
    }
}

/// A splitting with π whose last drift is zero: a flow of no length is none, so that the others are a palindrome.
#[test]
fn the_checker_drops_a_drift_of_length_zero_with_pi() {
    let text = stdout(&[
        "derive",
        "--kick",
        "1/pi, 1 - 2/pi, 1/pi",
        "--drift",
        "1/2, 1/2, 0",
        "--format",
        "toml",
    ]);
    let folder = folder("pi");
    let table = folder.join("pi.toml");
    std::fs::write(&table, text).expect("written");
    let certificate = stdout(&["certify", table.to_str().expect("a path")]);
    for (claim, part) in [
        (
            "true",
            "right: doubles, palindrome, general 1, separable 2, nystrom 2, perturbed [2, 2], stability",
        ),
        ("false", "WRONG: not proved: palindrome = False"),
    ] {
        let path = folder.join("pi.json");
        let text = certificate.replace("\"palindrome\": true", &format!("\"palindrome\": {claim}"));
        std::fs::write(&path, text).expect("written");
        let path = path.to_str().expect("a path");
        let Some((_, said)) = python(&["tableaux/check_certificate.py", path]) else {
            return;
        };
        assert!(said.contains(part), "{claim}: {said}");
    }
}

/// Two steps of a half: the trace is a square less 2. Where it touches -2, the double step is -1: the certificate does not cover its stability,
/// and the program does not check such a claim.
#[test]
fn the_checker_skips_stability_where_the_trace_touches_two() {
    let folder = folder("touching");
    let [table, file] = ["twice.toml", "twice.json"].map(|name| folder.join(name));
    let definition = "[provenance]\nbase = \"saba-2\"\nweights = \"1/2, 1/2\"\n";
    std::fs::write(&table, definition).expect("written");
    let [table, file] = [table, file].map(|path| path.display().to_string());
    assert_eq!(stdout(&["certify", &table, "--out", &file]), "");
    let text = std::fs::read_to_string(&file).expect("written");
    let missing = "\"not_covered\": [\"stability\"]";
    assert!(text.contains(missing), "{text}");
    let claim = "\"stability\": {\"intervals\": [[\"0\", \"infinity\", false, false]]}";
    let text = text.replace(missing, &format!("{claim}, \"not_covered\": []"));
    std::fs::write(&file, text).expect("written");
    let Some((right, text)) = python(&["tableaux/check_certificate.py", &file]) else {
        return;
    };
    let message = "stability not checked: the trace may touch 2 or -2";
    assert!(
        !right && text.contains("NOT ALL CHECKED") && text.contains(message),
        "{text}"
    );
}

#[test]
fn the_command_writes_the_certificate_of_a_method_and_of_a_file() {
    let known = std::fs::read_to_string(root().join("tableaux/certificates/gauss-2.json"))
        .expect("a certificate");
    assert_eq!(stdout(&["certify", "gauss-2"]), known);
    let file = folder("command").join("gauss-2.json").display().to_string();
    let table = root().join("tableaux/gauss-2.toml").display().to_string();
    assert_eq!(stdout(&["certify", &table, "--out", &file]), "");
    assert_eq!(std::fs::read_to_string(&file).expect("written"), known);
    for (arguments, status, part) in [
        (
            vec!["certify", "half-wave-gauss-4"],
            1,
            "there is no certificate of this method",
        ),
        (vec!["certify", "gauß-2"], 2, "gauß-2"),
        (
            vec!["certify", "my-method"],
            2,
            "or a file named .toml or .json",
        ),
        (
            vec!["certify", "missing.toml"],
            2,
            "cannot read `missing.toml`",
        ),
        (
            vec!["certify", &table, "--out", &table],
            2,
            "would overwrite an input",
        ),
        (
            vec!["certify", "gauss-2", "--out", "/missing/gauss-2.json"],
            2,
            "cannot write",
        ),
    ] {
        let (found, message) = failure(&arguments);
        assert!(
            found == Some(status) && message.contains(part),
            "{arguments:?}: {message}"
        );
    }
}
