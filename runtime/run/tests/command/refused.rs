//! What is refused, before anything is run.

use std::fs;

use crate::{PENDULUM, call, folder};

#[test]
fn a_misspelt_key_of_a_start_is_refused_with_the_key_that_is_meant() {
    let folder = folder("misspelt-starts");
    for (start, meant) in [
        ("{ form = 0, to = 1, count = 2 }", "from"),
        ("{ fro = 0 }", "from"),
        ("{ uniforn = [0, 1] }", "uniform"),
        ("{ vaules = [0, 1] }", "values"),
    ] {
        let setup = PENDULUM.replace("{ from = -1, to = 1, count = 11 }", start);
        assert_ne!(setup, PENDULUM);
        let output = call(&folder, &setup, &[]);
        let errors = String::from_utf8_lossy(&output.stderr);
        let advice = format!("did you mean `{meant}`?");
        assert!(errors.contains(&advice), "{errors}");
    }
}

#[test]
fn wrong_files_are_refused_at_their_place() {
    let folder = folder("wrong");
    let replaced = |from: &str, to: &str| {
        assert!(PENDULUM.contains(from), "{from}");
        PENDULUM.replace(from, to)
    };
    let quartic = PENDULUM.replace("pa^2/2", "pa^4/4").replace(
        "blanes-moan-2002-s10",
        "mclachlan-atela-1992-order-4-optimal",
    );
    let two = PENDULUM.replace("H = pa^2/2 - g cos(a)", "H = pa^2/2 - g cos(a) + a pa");
    for (setup, place, message) in [
        (
            replaced("end =", "ende ="),
            "5:5",
            "there is no key `ende`; known here: `system`, `method`,",
        ),
        (
            replaced("end =", "sums = 1\nend ="),
            "5:",
            "`sums`: found the integer `1`, expected a string",
        ),
        (
            replaced("end = 10.0", "sums.kind = 'plain'"),
            "5:",
            "`sums`: found a table, expected a string",
        ),
        (
            replaced("end = 10.0", "end = '10'"),
            "5:11",
            "`end`: found a string, expected a number",
        ),
        (
            replaced("end = 10.0", "end = 10.0\n    accept_lower_order = 1"),
            "6:26",
            "`accept_lower_order`: found the integer `1`, expected `true` or `false`",
        ),
        (
            replaced("end = 10.0", "times = [0, true]"),
            "5:13",
            "`times`: expected a list of times, or { from, to, count }",
        ),
        (
            replaced(
                "end = 10.0",
                "end = 10.0\n    random = { seed = -1, count = 2 }",
            ),
            "6:23",
            "`random.seed`: found the integer `-1`, expected a whole number, 0 or larger",
        ),
        (
            replaced(
                "end = 10.0",
                "end = 10.0\n    random = { seed = 1, number = 2 }",
            ),
            "6:26",
            "there is no key `number`; known here: `seed`, `count`",
        ),
        (
            replaced("end = 10.0", "end = 10.0\n    random = 3"),
            "6:14",
            "`random`: found the integer `3`, expected a table such as `{ seed = 1, count = 1000 }`",
        ),
        (
            replaced("end = 10.0", "section = { off = 'a' }"),
            "5:17",
            "there is no key `off`; known here: `of`, `direction`",
        ),
        (
            replaced("\"out.csv\"", "[\"out.csv\"]"),
            "11:12",
            "`output.file`: found a list, expected a string with the name of a file",
        ),
        (
            replaced("file = \"out.csv\"", ""),
            "10:5",
            "the key `output.file` is missing",
        ),
        (
            replaced("[starts]", "[[starts]]\n    x = 1\n    [rest]"),
            "9:6",
            "there is no key `rest`",
        ),
        (
            replaced("step_size = 0.05", ""),
            "1:1",
            "the key `step_size` is missing",
        ),
        (
            replaced("step_size = 0.05", "").replace("[starts]", "[starts]\n    step_size = 0.05"),
            "1:1",
            "the key `step_size` is missing (here it is `starts.step_size`); this key is one of the file: write it above the first `[…]`",
        ),
        (
            replaced("pa = 0.5", "pa = 0.5\n    random = { seed = 1, count = 2 }"),
            "10:5",
            "the coordinates are a, pa; this key is one of the file: write it above",
        ),
        (
            PENDULUM.to_owned() + "\n    end = 2.0",
            "13:5",
            "there is no key `end`; known here: `file`; this key is one of the file: write it above",
        ),
        (
            replaced(
                "parameters.g = 4",
                "parameters.g = 4\nparameters.random = { seed = 1, count = 2 }",
            ),
            "7:",
            "there is no parameter `random`; the parameters are g; this key is one of the file",
        ),
        (
            replaced("end =", "sums = 'exact'\nend ="),
            "5:",
            "unknown sums `exact`, expected `compensated` or `plain`",
        ),
        (
            replaced("pa = 0.5", "pb = 0.5"),
            "9:5",
            "there is no coordinate `pb`; the coordinates are a, pa",
        ),
        (replaced("pa = 0.5", ""), "7:", "give no value for `pa`"),
        (
            replaced("-s10", "-s9"),
            "3:",
            "known here: blanes-moan-2002-s6, blanes-moan-2002-s10",
        ),
        (
            replaced(
                "\"blanes-moan-2002-s10\"",
                "{ basis = \"polynomial(2)\", nodes = \"gaus(2)\" }",
            ),
            "3:50",
            "unknown quadrature rule `gaus`",
        ),
        (
            replaced(
                "\"blanes-moan-2002-s10\"",
                "{ basis = \"polynomial(2)\", nods = \"gauss(2)\" }",
            ),
            "3:41",
            "a method has no key `nods`",
        ),
        (
            replaced("\"blanes-moan-2002-s10\"", "3"),
            "3:14",
            "expected the name of a method of the catalogue",
        ),
        (replaced("= 0.05", "= 0"), "4:", "the step size is 0"),
        (
            replaced("= 10.0", "= -10.0"),
            "5:",
            "cannot reach the time -10",
        ),
        (replaced("cos(a)", "cos(b)"), "2:72", "unknown name `b`"),
        (
            replaced("{ g: 9.81 }", "{ g }").replace("parameters.g = 4", ""),
            "2:",
            "the parameter `g` has no value",
        ),
        (
            replaced("parameters.g", "parameters.h"),
            "6:16",
            "there is no parameter `h`; the parameters are g",
        ),
        (
            replaced("count = 11", "count = 0"),
            "8:",
            "`a`: the count is 0",
        ),
        (
            replaced(
                "a = { from = -1, to = 1, count = 11 }",
                "a = { normal = [0, 1] }",
            ),
            "7:",
            "`random = { seed = 1, count = 1000 }`",
        ),
        (
            replaced(
                "a = { from = -1, to = 1, count = 11 }",
                "a = { normal = [0, 1] }",
            )
            .replace("parameters.g = 4", "random = { seed = 1, count = 0 }"),
            "6:",
            "the count is 0, so there are no starts",
        ),
        (
            replaced("{ g: 9.81 }", "{ g: 9.81, m: [2] }")
                .replace("cos(a)", "cos(a) (m[0] + m[1])")
                .replace("parameters.g = 4", "parameters.m = [4]"),
            "6:",
            "`m` has 1 entry; it needs 2",
        ),
        (
            "system = 'Chain q: [2], p: [2]; H = |p|^2/2 + |q|^2/2'
             method = 'forest-ruth-1990'
             step_size = 0.1
             end = 1.0
             starts = { q = [0, 1], p = [0, 1, 2] }
             output.file = 'out.csv'"
                .to_owned(),
            "5:",
            "`p` has 3 numbers; it needs 2: the coordinates are q[0], q[1], p[0], p[1]",
        ),
        (
            quartic,
            "3:",
            "has order 4 if the kinetic energy is quadratic",
        ),
        (two, "3:", "for separable H only"),
    ] {
        let output = call(&folder, &setup, &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}: {error}");
        assert!(
            error.contains(message) && error.contains(&format!("setup.toml:{place}")),
            "{place} {message}: {error}"
        );
    }
    for (file, message) in [
        ("nowhere/out.csv", "nothing was computed"),
        ("out.txt", "must end in .npz, .parquet or .csv"),
    ] {
        let output = call(&folder, &replaced("out.csv", file), &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(
            output.status.code() == Some(2) && error.contains(message),
            "{error}"
        );
    }
    // A table has a column for the time.
    let timed = replaced("[a]", "[time]").replace("cos(a)", "cos(time)");
    let timed = timed.replace("a = {", "time = {");
    for (file, status) in [("out.csv", 2), ("out.parquet", 2), ("out.npz", 0)] {
        let output = call(&folder, &timed.replace("out.csv", file), &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(status), "{error}");
        assert_eq!(error.contains("would have the name `time`"), status == 2);
    }
    // A line of a CSV file.
    let table = "starts.csv";
    let setup = &PENDULUM[..PENDULUM.find("[starts]").expect("a table")];
    let setup = format!("starts = '{table}'\noutput.file = 'out.csv'\n{setup}");
    for (text, message) in [
        (
            "a,pa\n0,1\n0,nan\n",
            "column `pa`: expected a finite number, found `nan`",
        ),
        (
            "a,pb\n0,1\n",
            "line 1: the column `pb` is neither a coordinate nor",
        ),
        ("a\n0\n", "line 1: the column `pa` is missing"),
    ] {
        fs::write(folder.join(table), text).expect("a file");
        let output = call(&folder, &setup, &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(
            output.status.code() == Some(2) && error.contains(message),
            "{error}"
        );
    }
}

/// What would lose something, or take all memory, is refused before anything is run.
#[test]
fn setups_that_overwrite_files_or_exceed_memory_are_refused() {
    let folder = folder("refused");
    fs::write(folder.join("starts.csv"), "a,pa\n1,0\n").expect("a file");
    fs::create_dir_all(folder.join("there.csv")).expect("a folder");
    let starts = "[starts]\n    a = { from = -1, to = 1, count = 11 }\n    pa = 0.5\n";
    assert!(PENDULUM.contains(starts));
    let of_file = PENDULUM
        .replace(&format!("    {starts}"), "")
        .replace("step_size", "starts = \"starts.csv\"\n    step_size");
    let zeros = ", 0".repeat(19);
    let wide = format!(
        "system = 'Free<N> q: [N], p: [N]; H = sum(i: p[i]^2/2)'
        method = 'forest-ruth-1990'
        step_size = 0.1
        end = 1.0
        output.file = 'out.csv'
        [starts]
        q = [{{ from = 0, to = 1, count = 4000000 }}{zeros}]
        p = [0{zeros}]"
    );
    let cases = [
        (
            of_file.replace("out.csv", "starts.csv"),
            "would overwrite the file of the starts",
        ),
        (PENDULUM.replace("out.csv", "there.csv"), "names a folder"),
        (
            PENDULUM.replace("count = 11", "count = 1000000000000"),
            "`a`: the count is 1000000000000: it must be from 1 to 4194304",
        ),
        (
            PENDULUM.replace(
                "end = 10.0",
                "times = { from = 0, to = 1, count = 1000000000000 }",
            ),
            "`times`: the count is 1000000000000: it must be from 1 to 4194304",
        ),
        (
            PENDULUM
                .replace(
                    "end = 10.0",
                    "times = { from = 0, to = 1, count = 4000000 }",
                )
                .replace("count = 11", "count = 25"),
            "needs about 5.7 GB of memory, and at most 4 are allowed: give fewer `times`, or run at least 2 parts",
        ),
        (wide, "the starts need about 6.6 GB of memory"),
        (
            PENDULUM.replace("end = 10.0", "end = 1e300"),
            "more than 2^53 steps",
        ),
        (
            PENDULUM.replace("g = 4", "g = inf"),
            "expected a finite number",
        ),
        (
            PENDULUM.replace("g = 4", "g = { values = [1, inf] }"),
            "`g` has a value that is not finite",
        ),
        (
            PENDULUM.replace("g = 4", "g = { uniform = [nan, 1] }"),
            "`g` has a value that is not finite",
        ),
    ];
    for (setup, told) in cases {
        let output = call(&folder, &setup, &[]);
        let errors = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}: {errors}");
        assert!(errors.contains(told), "{told}: {errors}");
    }
    let kept = fs::read_to_string(folder.join("starts.csv")).expect("the starts");
    assert_eq!(kept, "a,pa\n1,0\n");
}

/// Text where numbers are meant, empty lists, tables with wrong keys.
#[test]
fn wrong_values_are_named_with_what_is_expected() {
    let folder = folder("values");
    let chain = "system = 'Chain { m: [3], w: [2, 2] } q: [3], p: [3]; H = sum(i: p[i]^2/m[i]/2 + w[0, 1] q[i]^2/2)'
        method = 'forest-ruth-1990'
        step_size = 0.05
        end = 1.0
        parameters.m = [1, 1, 1]
        parameters.w = [[1, 1], [1, 1]]
        starts = { q = [1, 0, 0], p = [0, 0, 0] }
        output.file = 'out.csv'";
    let range = "{ from = -1, to = 1, count = 11 }";
    let replaced = |setup: &str, from: &str, to: &str| {
        assert!(setup.contains(from), "{from}");
        setup.replacen(from, to, 1)
    };
    let times = "`times`: expected a list of times, or { from, to, count }; ";
    for (to, what) in [
        ("['1']", "entry 0 is a string"),
        ("'1'", "found a string"),
        ("{ from = 0, to = 1 }", "the key `count` is missing"),
        (
            "{ from = 0, to = 1, cout = 2 }",
            "there is no key `cout` beside `from`; did you mean `count`?",
        ),
        (
            "{ from = 0, to = '1', count = 2 }",
            "`from` and `to` need numbers",
        ),
    ] {
        let setup = replaced(PENDULUM, "end = 10.0", &format!("times = {to}"));
        let error = call(&folder, &setup, &[]).stderr;
        let error = String::from_utf8_lossy(&error);
        let told = format!("{times}{what}");
        assert!(
            error.contains(&told) && error.contains("setup.toml:5:13"),
            "{told}: {error}"
        );
    }
    for (setup, from, to, place, message) in [
        (
            PENDULUM,
            range,
            "[]",
            "8:9",
            "`a`: found an empty list, expected a number, {",
        ),
        (
            PENDULUM,
            range,
            "true",
            "8:9",
            "`a`: found a boolean, expected a number, {",
        ),
        (
            PENDULUM,
            range,
            "{}",
            "8:9",
            "`a`: found an empty table, expected a number, {",
        ),
        (
            PENDULUM,
            range,
            "{ from = 0, to = 1 }",
            "8:9",
            "`a`: the key `count` is missing: expected",
        ),
        (
            PENDULUM,
            range,
            "{ from = '0', to = 1, count = 2 }",
            "8:9",
            "`a`: `from` and `to` need numbers, and `count` a whole number",
        ),
        (
            PENDULUM,
            range,
            "{ form = 0, to = 1, count = 2 }",
            "8:9",
            "`a`: there is no key `form` beside `from`",
        ),
        (
            PENDULUM,
            range,
            "{ fro = 0 }",
            "8:9",
            "`a`: there is no key `fro` here, expected a number",
        ),
        (
            PENDULUM,
            range,
            "{ values = ['0.1'] }",
            "8:9",
            "`a`: `values` needs a list of numbers, such as [0.1, 0.2]",
        ),
        (
            PENDULUM,
            range,
            "{ uniform = [1] }",
            "8:9",
            "`a`: `uniform` has 1 number, and needs 2",
        ),
        (PENDULUM, range, "''", "8:9", "the expression ends"),
        (
            PENDULUM,
            "g = 4",
            "g = '4'",
            "6:20",
            "`g`: found a string, expected a finite number",
        ),
        (
            PENDULUM,
            "g = 4",
            "g = inf",
            "6:20",
            "`g`: found inf, expected a finite number",
        ),
        (
            PENDULUM,
            "g = 4",
            "g = []",
            "6:20",
            "`g`: found an empty list, expected a finite number",
        ),
        (
            PENDULUM,
            "end = 10.0",
            "end = 10.0\n    end = 11.0",
            "6:5",
            "the key `end` is given twice",
        ),
        (
            PENDULUM,
            "end = 10.0",
            "end = 10.0\n    random = []",
            "6:14",
            "`random`: found a list, expected a table such as",
        ),
        (
            PENDULUM,
            "[output]\n    file = \"out.csv\"",
            "[[output]]",
            "10:5",
            "`output`: found a list, expected a table with the key `file`",
        ),
        (
            PENDULUM,
            "out.csv",
            "",
            "11:12",
            "must end in .npz, .parquet or .csv",
        ),
        (
            chain,
            "[1, 1, 1]",
            "[]",
            "5:24",
            "`m` has 0 entries; it needs 3",
        ),
        (
            chain,
            "[1, 1, 1]",
            "[1, '1', 1]",
            "5:24",
            "`m[1]`: found a string, expected a finite number",
        ),
        (
            chain,
            "[1, 1, 1]",
            "1",
            "5:24",
            "`m`: found a number, expected a list of finite numbers",
        ),
        (
            chain,
            "[1, 1], [1, 1]",
            "[1, 1], 1",
            "6:24",
            "`w[1]`: found a number, expected a list of finite numbers",
        ),
        (
            chain,
            "[1, 1], [1, 1]",
            "[1, 1], [1, nan]",
            "6:24",
            "`w[1][1]`: found NaN, expected a finite number",
        ),
        (
            chain,
            "q = [1, 0, 0]",
            "q = 1",
            "7:24",
            "`q`: found a number, expected a list with a value for each coordinate",
        ),
        (
            chain,
            "{ q = [1, 0, 0], p = [0, 0, 0] }",
            "[]",
            "7:18",
            "the list of starts is empty: give at least one table",
        ),
        (
            chain,
            "{ q = [1, 0, 0], p = [0, 0, 0] }",
            "'none.csv'",
            "7:18",
            "none.csv: No such file",
        ),
    ] {
        let output = call(&folder, &replaced(setup, from, to), &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{message}: {error}");
        assert!(
            error.contains(message) && error.contains(&format!("setup.toml:{place}")),
            "{place} {message}: {error}"
        );
    }
}
