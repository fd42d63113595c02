//! Starts that follow from others: formulas, an energy surface, velocities.

use crate::{call, columns, csv, folder};

const HENON: &str = r#"
system = "HenonHeiles q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + (x^2 + y^2)/2 + x^2 y - y^3/3"
method = "forest-ruth-1990"
step_size = 0.1
end = 0.0
output.file = "out.csv"
parameters.E = { values = [0.1, 0.125] }
[starts]
px = "sqrt(2 E - py^2 - y^2 + 2 y^3/3)"
x = 0
y = { values = [-0.1, 0, 0.2] }
py = "0.01 trajectory"
"#;

const NAMES: [&str; 6] = [
    "E",
    "x_start",
    "y_start",
    "px_start",
    "py_start",
    "trajectory",
];

/// The momentum through x = 0 with an energy.
fn expected(energy: f64, y: f64, py: f64) -> f64 {
    (2.0 * energy - py * py - y * y + 2.0 / 3.0 * y * y * y).sqrt()
}

#[test]
fn a_formula_has_parameters_coordinates_and_the_number_of_the_trajectory() {
    let rows = columns(&csv(&folder("formula"), HENON), &NAMES);
    assert_eq!(rows.len(), 6);
    for (k, row) in rows.iter().enumerate() {
        let &[energy, x, y, px, py, number] = &row[..] else {
            panic!("{row:?}");
        };
        assert_eq!((energy, x), ([0.1, 0.125][k / 3], 0.0));
        assert_eq!((y, number), ([-0.1, 0.0, 0.2][k % 3], k as f64));
        assert_eq!(py, 0.01 * k as f64);
        // A few roundings of terms below 1, halved by the root of about 1/4.
        assert!((px - expected(energy, y, py)).abs() < 1e-15, "{row:?}");
    }
    // A parameter with one value is no column.
    let one = HENON.replace("{ values = [0.1, 0.125] }", "0.125");
    let text = csv(&folder("formula-one"), &one);
    assert!(!text.lines().next().expect("a header").contains(",E,"));
    assert!((columns(&text, &["px_start"])[1][0] - expected(0.125, 0.0, 0.01)).abs() < 1e-15);
}

#[test]
fn a_momentum_on_an_energy_surface_has_the_energy() {
    let formula = "\"sqrt(2 E - py^2 - y^2 + 2 y^3/3)\"";
    for (rule, sign) in [
        ("{ energy = \"E\" }", 1.0),
        ("{ energy = \"E\", root = \"largest\" }", 1.0),
        ("{ root = \"smallest\", energy = \"E\" }", -1.0),
    ] {
        let setup = HENON.replace(formula, rule);
        for row in columns(&csv(&folder("surface"), &setup), &NAMES) {
            let exact = sign * expected(row[0], row[2], row[4]);
            assert!((row[3] - exact).abs() < 1e-15, "{row:?} {exact}");
        }
    }
    // In a rotating frame the momenta are not even: H = (p + 1)²/2 − 1/2 − y.
    let rotating =
        "system = 'Frame q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + px y - x py + x^2 + y^2'
        method = 'gauss-2'
        step_size = 0.1
        end = 0.0
        starts = { x = 0.5, y = 1, py = 2, px = { energy = 3, root = 'smallest' } }
        output.file = 'out.csv'";
    let rows = columns(&csv(&folder("rotating"), rotating), &["px_start"]);
    // px² + 2 px + 4 − 2 + 2.5 = 6
    let exact = -1.0 - 2.5_f64.sqrt();
    assert!((rows[0][0] - exact).abs() < 1e-15 * exact.abs(), "{rows:?}");
}

#[test]
fn impossible_starts_are_refused_or_left_out() {
    let folder = folder("impossible");
    let values = "[-0.1, 0, 0.2]";
    let formula = HENON.replace(values, "[0.1, 0.7, 0.2]");
    let surface = formula.replace("\"sqrt(2 E - py^2 - y^2 + 2 y^3/3)\"", "{ energy = \"E\" }");
    for (setup, told) in [
        (
            &formula,
            "start 1, with x = 0, y = 0.7, E = 0.1: `px` is NaN; give other starts",
        ),
        (
            &surface,
            "start 1, with x = 0, y = 0.7, E = 0.1: H does not reach the energy 0.1 for any `px`",
        ),
    ] {
        let output = call(&folder, setup, &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2));
        assert!(
            error.contains(told) && error.contains("setup.toml:9:6"),
            "{error}"
        );
        let setup = format!("skip_impossible_starts = true\n{setup}");
        let output = call(&folder, &setup, &[]);
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(said.starts_with("4 trajectories, 0 failed: "), "{said}");
        assert!(said.contains("impossible starts     2, left out"), "{said}");
        let text = std::fs::read_to_string(folder.join("out.csv")).expect("the output");
        let rows = columns(&text, &["y_start", "py_start", "trajectory"]);
        let expected = [
            [0.1, 0.0, 0.0],
            [0.2, 0.01, 1.0],
            [0.1, 0.02, 2.0],
            [0.2, 0.03, 3.0],
        ];
        assert_eq!(rows, expected);
        let none = setup.replace("[0.1, 0.7, 0.2]", "[0.7]");
        let error = call(&folder, &none, &[]).stderr;
        let error = String::from_utf8_lossy(&error).into_owned();
        assert!(error.contains("all starts are impossible"), "{error}");
    }
}

const LAGRANGIAN: &str = r#"
system = "Coupled { m: 2 } q: [x, y], v: [vx, vy]; L = (1 + x^2) vx^2/2 + vx vy/2 + m vy^2/2 + y vx - x^2"
method = "gauss-4"
step_size = 0.1
end = 0.0
starts = { x = 0.5, vx = 3, y = 0.25, vy = "2 x + trajectory" }
output.file = "out.csv"
"#;

#[test]
fn velocities_of_a_lagrangian_are_starts() {
    let rows = columns(
        &csv(&folder("velocities"), LAGRANGIAN),
        &["px_start", "py_start"],
    );
    // ∂L/∂vx = (1 + x²) vx + vy/2 + y, ∂L/∂vy = vx/2 + m vy, in four roundings.
    for (found, exact) in rows[0].iter().zip([4.5, 3.5]) {
        assert!((found - exact).abs() < 4e-15, "{rows:?}");
    }
    let numbered = "system = 'Chain { m: [3] } q: [3], v: [3]; L = sum(i: m[i] v[i]^2/2 - q[i]^2)'
        parameters.m = [1, 2, 3]
        method = 'forest-ruth-1990'
        step_size = 0.1
        end = 0.0
        starts = { q = [0, 0, 0], v = [1, { values = [2, -2] }, 3] }
        output.file = 'out.csv'";
    let names = ["p[0]_start", "p[1]_start", "p[2]_start"];
    let folder = folder("velocity-list");
    let rows = columns(&csv(&folder, numbered), &names);
    assert_eq!(rows, [[1.0, 4.0, 9.0], [1.0, -4.0, 9.0]]);
    // The same in a file.
    let table = "v[0],q[0],v[1],q[1],v[2],q[2]\n1,0,2,0,3,0\n1,0,-2,0,3,0\n";
    std::fs::write(folder.join("starts.csv"), table).expect("a file");
    let starts = "{ q = [0, 0, 0], v = [1, { values = [2, -2] }, 3] }";
    let of_file = numbered.replace(starts, "'starts.csv'");
    assert_eq!(columns(&csv(&folder, &of_file), &names), rows);
    std::fs::write(folder.join("starts.csv"), table.replace("v[0]", "p[0]")).expect("a file");
    let output = call(&folder, &of_file, &[]);
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(
        error.contains("the column `p[0]` is neither a coordinate"),
        "{error}"
    );
}

#[test]
fn wrong_rules_are_refused_at_their_place() {
    let folder = folder("rules");
    let px = "\"sqrt(2 E - py^2 - y^2 + 2 y^3/3)\"";
    let py = "\"0.01 trajectory\"";
    for (setup, place, told) in [
        (
            HENON.replace("parameters.E", "parameters.y"),
            "7:",
            "`y` has another meaning: give the parameter another name",
        ),
        (
            HENON.replace(px, "\"sqrt(2 E + F)\""),
            "9:",
            "unknown name `F`",
        ),
        (HENON.replace(px, "\"E +\""), "9:", "the expression ends"),
        (
            HENON.replace(px, "\"[x, E]\""),
            "9:6",
            "`px` has 2 components",
        ),
        (
            HENON.replace(px, "\"py + E\"").replace(py, "\"px\""),
            "9:6",
            "`px`, `py` depend on each other",
        ),
        (
            HENON.replace(px, "\"px + E\""),
            "9:6",
            "`px` depends on itself",
        ),
        (
            HENON
                .replace(px, "{ energy = \"E\" }")
                .replace(py, "{ energy = \"E\" }"),
            "9:6",
            "`px`, `py` depend on each other",
        ),
        (
            HENON
                .replace(px, "0")
                .replace("x = 0\n", "x = { energy = \"E\" }\n"),
            "10:5",
            "`x` is no momentum: an energy determines one of px, py",
        ),
        (
            HENON.replace(px, "{ energy = \"E\", roots = 2 }"),
            "9:6",
            "there is no key `roots` beside `energy`; known here: `energy`, `root`; did you mean `root`?",
        ),
        (
            HENON.replace(px, "{ energy = \"E\", root = 2 }"),
            "9:6",
            "`root` must be \"largest\" or \"smallest\"",
        ),
        (
            HENON.replace(px, "{ energy = [\"E\"] }"),
            "9:6",
            "`energy` needs a finite number, or a formula in quotes",
        ),
        (
            HENON.replace(px, "0"),
            "7:12",
            "there is no parameter `E`; the formula has none",
        ),
        (
            HENON.replace("{ values = [0.1, 0.125] }", "[1]"),
            "7:",
            "`E`: found a list, expected a finite number, or several by a table",
        ),
        (
            HENON.replace("{ values = [0.1, 0.125] }", "\"1\""),
            "7:",
            "`E`: found a string, expected a finite number, or several by a table",
        ),
        (
            LAGRANGIAN.replace("vx = 3", "px = 3"),
            "6:",
            "give either all momenta or all velocities",
        ),
        (
            LAGRANGIAN.replace("2 x + trajectory", "2 px"),
            "6:",
            "`vy` depends on a momentum, and the starts have velocities",
        ),
        (
            LAGRANGIAN.replace("\"2 x + trajectory\"", "{ energy = 1 }"),
            "6:",
            "is no momentum",
        ),
        (
            LAGRANGIAN.replace("vx = 3,", ""),
            "6:",
            "the starts give no value for `px`",
        ),
    ] {
        let output = call(&folder, &setup, &[]);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{told}: {error}");
        assert!(
            error.contains(told) && error.contains(&format!("setup.toml:{place}")),
            "{place} {told}: {error}"
        );
    }
}
