//! Tables of other libraries, imported.

use crate::run::{failure, stdout, symplectic};

/// The command prints the table as `show` does, and names unknown libraries.
#[test]
fn the_command_imports() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR"));
    let file = folder.join("ruth.c");
    let exported = stdout(&["show", "ruth-1983", "--format", "sundials"]);
    std::fs::write(&file, exported).expect("written");
    let path = file.to_str().expect("text");
    let output = symplectic(&["import", "--from", "sundials", path, "--name", "ruth"]);
    let text = String::from_utf8_lossy(&output.stdout);
    let remark = String::from_utf8_lossy(&output.stderr);
    // The constants are doubles, half a unit in the last place from thirds and 24ths.
    assert!(
        output.status.success()
            && remark.contains(
                "the exact method near the decimals, from which the decimals differ by at most"
            )
            && remark.contains("e-17"),
        "{remark}"
    );
    assert!(
        text.starts_with("ruth, 3 stages, ") && text.contains("separable  3, "),
        "{text}"
    );
    let (status, message) = failure(&["import", "--from", "gsl", path]);
    assert!(
        status == Some(2) && message.contains("unknown library `gsl`; known here: sciml, "),
        "{message}"
    );
    // One digit is wrong, so that no exact method is near, or is farther away than the digits say.
    let wrong =
        "double a[2] = {0.29289321, 0.70710678};\ndouble ahat[2] = {0.70710678, 0.29299322};\n";
    std::fs::write(&file, wrong).expect("written");
    let output = symplectic(&["import", "--from", "sundials", path]);
    let remark = String::from_utf8_lossy(&output.stderr);
    assert!(
        remark.contains("no exact method was found near the decimals")
            && remark.contains(
                "up to their rounding they have order 0 for T(p) + U(q), and 0 for quadratic T"
            ),
        "{remark}"
    );
    // Its free coefficients make q[p,p,p] differ by 2·10⁻²⁰ from 1/4: not the condition that SciML's order of steps violates.
    let mcate4 = "a = [0.515352837431122936, -0.085782019412973646, 0.441583023616466524, 0.128846158365384185]\n\
                  b = [0.134496199277431089, -0.224819803079420806, 0.756320000515668291, 0.334003603286321425]\n";
    std::fs::write(&file, mcate4).expect("written");
    let output = symplectic(&["import", "--from", "sciml", path]);
    let text = String::from_utf8_lossy(&output.stdout);
    for class in ["separable", "nystrom"] {
        let line = text
            .lines()
            .find(|line| line.trim_start().starts_with(class));
        let line = line.expect("an order");
        assert!(
            line.contains("  3, certified; not 4: p[q,q,q] has the weight 0.2606"),
            "{line}"
        );
    }
    std::fs::write(&file, "double a[] = {1, one};\ndouble ahat[] = {1, 0};\n").expect("written");
    let (status, message) = failure(&["import", "--from", "sundials", path]);
    let message = message.replace(path, "ruth.c");
    assert_eq!(status, Some(2));
    expect_test::expect![[r#"
        error: found `one`, which has no value here, expected a number
         --> ruth.c:1:18
          |
        1 | double a[] = {1, one};
          |                  ^^^
    "#]]
    .assert_eq(&message);
}

/// A file in the folder of the tests, with this text.
fn file(name: &str, text: &str) -> String {
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, text).expect("written");
    path.to_str().expect("text").to_owned()
}

/// The same table in two spellings; `audit` has the stable steps of the numbers in the table, too.
#[test]
fn a_table_that_satisfies_its_order_as_written_is_not_changed() {
    for (name, text, drift) in [
        (
            "smallest.py",
            "x = 0.1234567\na = [x, 1-x]\nb = [1, 0]\n",
            "drift = \"1234567/10000000, 8765433/10000000\"",
        ),
        (
            "symmetric.py",
            "x = 0.2345678\na = [x, 1-2*x, x]\nb = [0.5, 0.5, 0]\n",
            "drift = \"1172839/5000000, 1327161/2500000, 1172839/5000000\"",
        ),
    ] {
        let path = file(name, text);
        let output = symplectic(&["import", "--from", "odeint", &path, "--format", "toml"]);
        assert!(output.stderr.is_empty(), "{output:?}");
        let text = String::from_utf8_lossy(&output.stdout);
        assert!(text.contains(drift), "{text}");
    }
    let tables = "library = \"x\"\nversion = \"1\"\nsource = \"x\"\nconvention = \"odeint\"\n\
                  [[table]]\nname = \"symmetric\"\norder = 2\nclass = \"separable\"\n\
                  [table.numbers]\na = [\"0.2345678\", \"1 - 2*0.2345678\", \"0.2345678\"]\nb = [\"0.5\", \"0.5\", \"0\"]\n";
    let (path, json) = (file("symmetric.toml", tables), file("symmetric.json", ""));
    let kick = "0.5, 0.5, 0";
    let drift = "0.2345678, 0.5308644, 0.2345678";
    let derived = stdout(&[
        "derive", "--first", "drift", "--kick", kick, "--drift", drift,
    ]);
    std::fs::remove_file(&json).expect("removed");
    stdout(&["audit", &path, "--json", &json]);
    let audited = std::fs::read_to_string(&json).expect("written");
    let audited: serde_json::Value = serde_json::from_str(&audited).expect("valid");
    let row = &audited["rows"][0];
    assert_eq!(
        (&row["numbers"], &row["right_places"]),
        (&"exact".into(), &serde_json::Value::Null)
    );
    let stable = row["stable"].as_str().expect("text");
    assert!(
        derived.contains(&format!("stable for ν in {stable}")),
        "{stable}\n{derived}"
    );
}

#[test]
fn a_table_that_is_changed_says_what_forces_it() {
    let path = file(
        "forced.py",
        "x = 0.2345678\ny = 0.5308643\na = [x, y, 1-x-y]\nb = [0.5, 0.5, 0]\n",
    );
    let output = symplectic(&["import", "--from", "odeint", &path]);
    let remark = String::from_utf8_lossy(&output.stderr);
    assert_eq!(
        remark,
        "warning: as they are written, the decimals do not have order 2 for nystrom H: p[q] has the weight 0.499999950000… instead of \
         1/2, a difference of -5.00000000000e-8…; the result is the exact method near the decimals, from which the decimals differ by at \
         most 5.0e-8\n"
    );
}

#[test]
fn a_table_is_read_by_its_own_names() {
    let path = file("own.py", "version = 1.2.3\nc = [0.5, 0.5]\nd = [1]\n");
    let text = stdout(&[
        "import", "--drift", "c", "--kick", "d", "--first", "drift", &path,
    ]);
    assert!(
        text.starts_with("2 stages, kick 1, 0, drift 1/2, 1/2, first drift\n"),
        "{text}"
    );
    let path = file("half.py", "w = [1/6, 1/3]\n");
    let text = stdout(&["import", "--weights", "w", "--symmetric", &path]);
    assert!(
        text.contains("base velocity-verlet, weights 1/6, 1/3, 1/3, 1/6"),
        "{text}"
    );
    let text = stdout(&[
        "import",
        "--weights",
        "w",
        "--symmetric",
        "--base",
        "gauss-1",
        &path,
    ]);
    assert!(text.starts_with("4 stages, base gauss-1, "), "{text}");
    for (arguments, message) in [
        (
            vec!["--drift", "w", "--kick", "w"],
            "which of them come first must be stated",
        ),
        (vec!["--drift", "w"], "--kick <NAME>"),
        (vec![], "--from <LIBRARY>"),
        (
            vec!["--from", "sciml", "--symmetric"],
            "`--symmetric` is for tables that are read with",
        ),
        (vec!["--weights", "v"], "the list `v` is missing"),
    ] {
        let mut all = vec!["import", &path];
        all.extend(arguments);
        let (status, found) = failure(&all);
        assert!(status == Some(2) && found.contains(message), "{found}");
    }
}
