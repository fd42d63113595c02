//! Steppers with the system of a formula: their form, and their steps against those of the runtime.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use crate::emit::{emit, folder, output};
use crate::run::failure;
use expect_test::expect_file;
use symplectic::nalgebra::{SMatrix, SVector};
use symplectic::{Error, Integrator, State};

/// A system for the runtime, and its formula as a text.
macro_rules! system {
    ($text:ident: $($formula:tt)*) => {
        symplectic::hamiltonian! { $($formula)* }
        const $text: &str = stringify!($($formula)*);
    };
}

system!(KEPLER: Kepler { gm: 1 } q: [2], p: [2]; H = |p|^2/2 - gm/|q|);
system!(PLANETS: Planets<N> { m: [N], G: 1 } q: [N; 3], p: [N; 3];
    H = sum(i: |p[i]|^2 / (2 m[i])) - sum(i < j: G m[i] m[j] / |q[i] - q[j]|));
system!(WARPED: Warped { lambda: 1/4, k: [2, 2] } q: [x, y], p: [px, py];
    H = (1 + lambda x^2) (px^2 + py^2)/2 + k[0, 0] x^2/2 + k[1, 1] y^4/4 + k[0, 1] x^5 y/(1 + y^2)^(3/2));
system!(DRIVEN: Driven { k: 1/3 } q: [x], p: [y]; H = y^2/2 + (1 + k t) x^2/2 + t x^4/(1 + x^2));
system!(MOLECULE: Molecule<N> { m: [N], springs: pairs, stiffness: [springs], length: [springs], G: 1/8 } q: [N; 3], p: [N; 3];
    H = sum(i: |p[i]|^2 / (2 m[i])) + sum(s = (i, j) in springs: stiffness[s] (|q[i] - q[j]| - length[s])^2/2)
        - sum(i < j: G m[i] m[j] / |q[i] - q[j]|));
system!(FIELD: Field<N> { g: 1 } q: [N; 2], p: [N; 2]; H = sum(i: |p[i]|^2/2 + g q[i][1]));
system!(PENDULUM: Pendulum { g: 9.81 } q: [a], p: [pa]; H = pa^2/2 - g cos(a) + exp(-t) sin(a)/8);
system!(KINKED: Kinked { a: 1/2 } q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + |x|^3 + |[x, y]|^3 + max(x - y, 0)^(5/2) + a y^2 |y| + |px|^3);

symplectic::tableau! { Verlet { base: stormer-verlet } }
symplectic::tableau! { Forest { base: forest-ruth-1990 } }
symplectic::tableau! { Gauss2 { base: gauss-2 } }

/// A parameter or a length that is set.
enum Value {
    Length(usize),
    Number(f64),
    Array(&'static [f64]),
    Matrix([[f64; 2]; 2]),
    Pairs(&'static [(usize, usize)]),
}
use Value::{Array, Length, Matrix, Number, Pairs};

/// Steps of a system from a start.
struct Case {
    method: &'static str,
    formula: &'static str,
    kind: &'static str,
    values: Vec<(&'static str, Value)>,
    start: [Vec<f64>; 2],
    h: f64,
    steps: u32,
}

/// Positions, momenta and H after the steps of the runtime.
macro_rules! runtime {
    ($case:ident, $method:expr, $system:expr, $vector:ty) => {{
        let [q, p] = &$case.start;
        let [q, p] = [q, p].map(|half| <$vector>::from_column_slice(half));
        let start = State::new(0.0, q, p);
        let mut integrator = Integrator::new($method, $system, start, $case.h)
            .expect("the system and the method fit");
        for _ in 0..$case.steps {
            integrator.step().expect("a step");
        }
        let energy = integrator.energy().expect("H is known");
        let state = integrator.state();
        let mut found: Vec<f64> = state.q.iter().chain(state.p.iter()).copied().collect();
        found.push(energy);
        found
    }};
}

fn kepler(method: &'static str) -> Case {
    Case {
        method,
        formula: KEPLER,
        kind: "Kepler",
        values: vec![("gm", Number(0.7))],
        start: [vec![0.8, 0.0], vec![0.0, 1.1]],
        h: 0.01,
        steps: 2000,
    }
}

const MASSES: [f64; 3] = [1.0, 0.01, 0.003];

fn planets() -> Case {
    Case {
        method: "forest-ruth-1990",
        formula: PLANETS,
        kind: "Planets",
        values: vec![("N", Length(3)), ("m", Array(&MASSES)), ("G", Number(1.0))],
        start: [
            vec![0.0, 0.0, 0.0, 1.0, 0.1, 0.0, -0.3, 2.0, 0.2],
            vec![0.0, -0.01, 0.0, 0.0, 0.01, 0.0005, -0.002, 0.0, 0.0],
        ],
        h: 0.02,
        steps: 1000,
    }
}

const BONDS: [(usize, usize); 4] = [(0, 1), (2, 0), (3, 2), (1, 3)];
const STIFFNESS: [f64; 4] = [40.0, 1.0, 2.5, 0.3];
const LENGTHS: [f64; 4] = [0.96, 1.1, 1.0, 2.0];
const ATOMS: [f64; 4] = [16.0, 1.0, 1.25, 3.0];

/// Bonds in a list.
fn molecule(springs: &'static [(usize, usize)]) -> Case {
    Case {
        method: "forest-ruth-1990",
        formula: MOLECULE,
        kind: "Molecule",
        values: vec![
            ("N", Length(4)),
            ("m", Array(&ATOMS)),
            ("springs", Pairs(springs)),
            ("stiffness", Array(&STIFFNESS)),
            ("length", Array(&LENGTHS)),
            ("G", Number(0.125)),
        ],
        start: [
            vec![0.0, 0.1, 0.0, 1.0, 0.0, -0.2, -0.3, 1.0, 0.1, 0.4, 1.5, 0.9],
            vec![
                0.2, 0.0, 0.1, -0.1, 0.3, 0.0, 0.0, -0.2, 0.05, -0.1, 0.0, 0.2,
            ],
        ],
        h: 0.01,
        steps: 1000,
    }
}

/// H depends on time.
fn driven() -> Case {
    Case {
        method: "forest-ruth-1990",
        formula: DRIVEN,
        kind: "Driven",
        values: vec![("k", Number(0.3))],
        start: [vec![0.5], vec![-0.2]],
        h: 0.01,
        steps: 1000,
    }
}

fn warped() -> Case {
    Case {
        method: "gauss-2",
        formula: WARPED,
        kind: "Warped",
        values: vec![
            ("lambda", Number(0.25)),
            ("k", Matrix([[1.0, 0.1], [0.0, 2.0]])),
        ],
        start: [vec![0.3, -0.2], vec![0.1, 0.4]],
        h: 0.05,
        steps: 200,
    }
}

/// The force has components that are zero.
fn field() -> Case {
    Case {
        method: "forest-ruth-1990",
        formula: FIELD,
        kind: "Field",
        values: vec![("N", Length(2)), ("g", Number(9.81))],
        start: [vec![0.5, 0.1, -0.2, 0.3], vec![-0.2, 1.0, 0.7, 0.0]],
        h: 0.01,
        steps: 100,
    }
}

fn pendulum() -> Case {
    Case {
        method: "stormer-verlet",
        formula: PENDULUM,
        kind: "Pendulum",
        values: vec![("g", Number(9.81))],
        start: [vec![1.0], vec![0.5]],
        h: 0.01,
        steps: 500,
    }
}

/// From a point where all functions with kinks are zero.
fn kinked() -> Case {
    Case {
        method: "forest-ruth-1990",
        formula: KINKED,
        kind: "Kinked",
        values: vec![("a", Number(0.5))],
        start: [vec![0.0, 0.0], vec![0.0, 0.4]],
        h: 0.01,
        steps: 1000,
    }
}

#[test]
fn emitted_systems_have_the_recorded_text() {
    for (case, name, language, end) in [
        (kepler("stormer-verlet"), "kepler", "c", "c"),
        (planets(), "planets", "rust", "rs"),
        (warped(), "warped", "julia", "jl"),
        (planets(), "planets", "python", "py"),
        (warped(), "warped", "c", "c"),
        (pendulum(), "pendulum", "python", "py"),
        (molecule(&BONDS), "molecule", "c", "c"),
        (molecule(&BONDS), "molecule", "rust", "rs"),
        (molecule(&BONDS), "molecule", "julia", "jl"),
        (molecule(&BONDS), "molecule", "python", "py"),
    ] {
        let text = stepper(&folder(&format!("form-{name}-{language}")), &case, language);
        let start = text.find("The system").expect("a system");
        let start = text[..start].rfind('\n').expect("a line before it");
        let file = format!("data/emit/systems/{name}.{end}");
        expect_file![file].assert_eq(&text[start + 1..]);
    }
}

/// Drifts and kicks of sums, products, quotients and roots: every bit is that of the runtime.
#[test]
fn splittings_have_the_bits_of_the_runtime() {
    let case = kepler("stormer-verlet");
    let system = Kepler { gm: 0.7 };
    agree(&case, &runtime!(case, Verlet, system, SVector<f64, 2>), 0.0);
    let case = kepler("forest-ruth-1990");
    agree(&case, &runtime!(case, Forest, system, SVector<f64, 2>), 0.0);
    let case = planets();
    let system = Planets::new(MASSES);
    agree(
        &case,
        &runtime!(case, Forest, system, SMatrix<f64, 3, 3>),
        0.0,
    );
    let case = molecule(&BONDS);
    let system = Molecule::new(ATOMS, BONDS.to_vec(), STIFFNESS.to_vec(), LENGTHS.to_vec());
    agree(
        &case,
        &runtime!(case, Forest, system, SMatrix<f64, 3, 4>),
        0.0,
    );
    let case = field();
    let system = Field::<2> { g: 9.81 };
    agree(
        &case,
        &runtime!(case, Forest, system, SMatrix<f64, 2, 2>),
        0.0,
    );
    let case = kinked();
    let system = Kinked { a: 0.5 };
    agree(&case, &runtime!(case, Forest, system, SVector<f64, 2>), 0.0);
    let case = driven();
    let system = Driven { k: 0.3 };
    agree(&case, &runtime!(case, Forest, system, SVector<f64, 1>), 0.0);
}

/// The iteration of the runtime begins elsewhere and ends elsewhere: 200 steps differ by the rounding errors of each.
#[test]
fn coupled_stages_are_those_of_the_runtime_up_to_rounding() {
    let case = warped();
    let mut system = Warped::new([[1.0, 0.1], [0.0, 2.0]]);
    system.lambda = 0.25;
    agree(
        &case,
        &runtime!(case, Gauss2, system, SVector<f64, 2>),
        1e-13,
    );
}

/// The functions of libraries differ in their last bits: 500 steps of a pendulum add up less than 1000 units of rounding.
#[test]
fn elementary_functions_are_those_of_the_runtime_up_to_rounding() {
    let case = pendulum();
    agree(
        &case,
        &runtime!(case, Verlet, Pendulum::new(), SVector<f64, 1>),
        2e-13,
    );
}

/// A twin: another value of the parameter gives other bits.
#[test]
fn another_value_of_a_parameter_changes_the_bits() {
    let case = kepler("stormer-verlet");
    let other = runtime!(case, Verlet, Kepler::new(), SVector<f64, 2>);
    let folder = folder("felt");
    for language in [c, rust, python] {
        let found = language(&folder, &case).into_iter().flatten();
        assert!(found.zip(&other).all(|(x, y)| x != *y));
    }
}

/// A pair with an index out of range is an error of the step; in the runtime, of the integrator that is made.
#[test]
fn pairs_out_of_range_are_errors() {
    for pair in [[(4, 0); 4], [(0, 4); 4]] {
        let case = molecule(Vec::leak(pair.to_vec()));
        let folder = folder("pairs-out-of-range");
        for (language, message) in [
            (c as fn(&Path, &Case) -> Option<Vec<f64>>, ""),
            (rust, "NotFinite"),
            (python, "out of range"),
        ] {
            match std::panic::catch_unwind(|| language(&folder, &case)) {
                // There is no compiler here.
                Ok(found) => assert_eq!(found, None),
                Err(panic) => {
                    let panic = panic.downcast_ref::<String>().expect("a message");
                    assert!(panic.contains(message), "{panic}");
                }
            }
        }
        let system = Molecule::new(ATOMS, pair.to_vec(), STIFFNESS.to_vec(), LENGTHS.to_vec());
        let [q, p] = [0, 1].map(|half| SMatrix::<f64, 3, 4>::from_column_slice(&case.start[half]));
        let made = Integrator::new(Forest, system, State::new(0.0, q, p), case.h);
        assert!(matches!(made, Err(Error::PairOutOfRange { .. })));
    }
}

#[test]
fn systems_that_do_not_fit_are_refused() {
    let folder = folder("systems-refused");
    let refusal = |method: &str, formula: &str, options: &[&str]| {
        let file = folder.join("system.txt");
        fs::write(&file, formula).expect("written");
        let file = file.display().to_string();
        let arguments = ["emit", method, "--language", "c", "--system", &file];
        let (status, message) = failure(&[&arguments, options].concat());
        assert_eq!(status, Some(2), "{message}");
        message
    };
    let separable = ["--class", "separable"];
    assert!(refusal("stormer-verlet", WARPED, &separable).contains("H is not separable"));
    assert!(
        refusal("forest-ruth-1990", WARPED, &[])
            .contains("H is not separable, where it has a lower order")
    );
    assert!(
        refusal("gauss-2", KEPLER, &separable).contains("does not consist of drifts and kicks")
    );
    let relativistic = "R q: [x], p: [y]; H = sqrt(1 + y^2) + x^2/2";
    assert!(
        refusal("blanes-moan-2002-srkn11b", relativistic, &[])
            .contains("not quadratic in the momenta")
    );
    // Its order is 4 there, and not 6.
    let moving = "R q: [x], p: [y]; H = y^2/2 + sin(t) y + x^4/4";
    assert!(refusal("blanes-moan-2002-srkn11b", moving, &[]).contains("depends on the time"));
    for (more, what) in [
        ("friction: 1/10;", "friction"),
        ("friction: [1, 2];", "friction"),
        ("v: [vx, vz], nonholonomic: { c = vx - vz }", "constraints"),
        ("force: { x = t }", "forces"),
        ("constraints: { c = x }", "constraints"),
        (
            "extern fn potential with slope, curvature;",
            "written in Rust",
        ),
    ] {
        let formula = format!("P q: [x, z], p: [y, w]; {more} H = (y^2 + w^2)/2 + x^4 + z^2");
        let message = refusal("stormer-verlet", &formula, &[]);
        assert!(message.contains(what), "{message}");
    }
    let lagrangian = "L q: [x], v: [u]; L = u^4/4 + u^2/2 - x^2";
    assert!(refusal("gauss-2", lagrangian, &[]).contains("no formula of H"));
    assert!(
        refusal("gauss-2", "P q: [x], p: [y]; H = y^2/2 + z", &[]).contains("unknown name `z`")
    );
}

/// Compares what the languages find with each other, to the last bit, and with the runtime.
fn agree(case: &Case, expected: &[f64], tolerance: f64) {
    let folder = folder(&format!("{}-{}", case.kind, case.method));
    let bits = |found: &[f64]| -> Vec<u64> { found.iter().map(|x| x.to_bits()).collect() };
    let mut first: Option<Vec<f64>> = None;
    for language in [c, rust, python] {
        let Some(found) = language(&folder, case) else {
            continue;
        };
        match tolerance {
            0.0 => assert_eq!(bits(&found), bits(expected), "{found:?} {expected:?}"),
            _ => {
                let fits = |(x, y): (&f64, &f64)| (x - y).abs() <= tolerance;
                assert_eq!(found.len(), expected.len());
                assert!(
                    found.iter().zip(expected).all(fits),
                    "{found:?} {expected:?}"
                );
            }
        }
        let first = first.get_or_insert_with(|| found.clone());
        assert_eq!(bits(&found), bits(first), "{}", case.kind);
    }
}

/// Writes the formula into a folder, and the stepper of it.
fn stepper(folder: &Path, case: &Case, language: &str) -> String {
    let file = folder.join("formula.txt");
    fs::write(&file, case.formula).expect("written");
    let file = file.display().to_string();
    let mut text = emit(case.method, language, &["--system", &file]);
    // In Rust lengths are constants of the file.
    for (name, value) in &case.values {
        let length = match value {
            Length(n) => Some(*n),
            Pairs(list) => Some(list.len()),
            _ => None,
        };
        if let ("rust", Some(n)) = (language, length) {
            let line = format!("pub const LENGTH_{name}: usize = ");
            assert!(text.contains(&line));
            text = text.replace(&format!("{line}2;"), &format!("{line}{n};"));
        }
    }
    text
}

/// Numbers in hexadecimal, one a line.
fn read(text: &str) -> Vec<f64> {
    let number = |line: &str| u64::from_str_radix(line, 16).expect("bits");
    text.lines().map(number).map(f64::from_bits).collect()
}

fn rows(matrix: &[[f64; 2]; 2]) -> Vec<String> {
    matrix.iter().map(|row| format!("{row:?}")).collect()
}

fn c(folder: &Path, case: &Case) -> Option<Vec<f64>> {
    fs::write(folder.join("stepper.c"), stepper(folder, case, "c")).expect("written");
    let (name, prefix) = (case.method.replace('-', "_"), case.kind.to_lowercase());
    let upper = name.to_uppercase();
    let braces = |text: String| text.replace('[', "{").replace(']', "}");
    let [mut arrays, mut fields] = [String::new(), String::new()];
    for (field, value) in &case.values {
        let value = match value {
            Length(n) => n.to_string(),
            Number(x) => format!("{x:?}"),
            Array(list) => {
                let numbers = braces(format!("{list:?}"));
                writeln!(arrays, "    static const double {field}[] = {numbers};").expect("text");
                (*field).to_owned()
            }
            Pairs(list) => {
                let pairs = braces(format!("{list:?}").replace('(', "[").replace(')', "]"));
                writeln!(arrays, "    static const size_t {field}[][2] = {pairs};").expect("text");
                write!(fields, ".{field}_count = {}, ", list.len()).expect("text");
                (*field).to_owned()
            }
            Matrix(matrix) => braces(format!("[{}]", rows(matrix).join(", "))),
        };
        write!(fields, ".{field} = {value}, ").expect("text");
    }
    let n = case.start[0].len();
    let starts: String = ["q", "p"]
        .iter()
        .zip(&case.start)
        .flat_map(|(half, list)| {
            list.iter()
                .enumerate()
                .map(move |(i, x)| format!("    s.{half}[{i}] = {x:?};\n"))
        })
        .collect();
    let (h, steps) = (case.h, case.steps);
    let main = format!(
        "#include \"stepper.c\"\n#include <inttypes.h>\n#include <stdint.h>\n#include <stdio.h>\n#include <string.h>\n\
         static void show(double x) {{ uint64_t bits; memcpy(&bits, &x, sizeof bits); printf(\"%\" PRIx64 \"\\n\", bits); }}\n\
         int main(void) {{\n{arrays}    {prefix}_parameters parameters = {{{fields}}};\n    {name}_system system = {{{prefix}_velocity, {prefix}_force, &parameters}};\n    \
         double memory[{upper}_DOUBLES({n})];\n    {name}_state s;\n    {name}_start(&s, {n}, memory);\n{starts}    \
         for (int k = 0; k < {steps}; k++) if ({name}_step(&s, &system, k * {h:?}, {h:?}) != {upper}_OK) return 1;\n    \
         for (int i = 0; i < {n}; i++) show(s.q[i]);\n    for (int i = 0; i < {n}; i++) show(s.p[i]);\n    \
         show({prefix}_energy({steps} * {h:?}, s.q, s.p, &parameters));\n    return 0;\n}}\n"
    );
    fs::write(folder.join("main.c"), main).expect("written");
    let options = "-std=c99 -pedantic-errors -Wall -Wextra -Werror -O2 -ffp-contract=off -o main-c main.c -lm";
    output("cc", &options.split(' ').collect::<Vec<_>>(), folder)?;
    output("./main-c", &[], folder).map(|text| read(&text))
}

fn rust(folder: &Path, case: &Case) -> Option<Vec<f64>> {
    fs::write(folder.join("stepper.rs"), stepper(folder, case, "rust")).expect("written");
    let fields = case.values.iter().filter_map(|(field, value)| {
        let value = match value {
            Length(_) => return None,
            Number(x) => format!("{x:?}"),
            Array(list) => format!("{list:?}"),
            Pairs(list) => format!("{list:?}"),
            Matrix(matrix) => format!("{matrix:?}"),
        };
        Some(format!("{field}: {value}"))
    });
    let fields: Vec<String> = fields.collect();
    let (kind, fields, [q, p], h, steps) = (
        case.kind,
        fields.join(", "),
        &case.start,
        case.h,
        case.steps,
    );
    let main = format!(
        "mod stepper;\nuse stepper::*;\nfn main() {{\n    let system = {kind} {{ {fields} }};\n    \
         let mut s = State::new({q:?}, {p:?});\n    \
         for k in 0..{steps} {{ s.step(&system, f64::from(k) * {h:?}, {h:?}).expect(\"a step\"); }}\n    \
         let energy = system.energy({steps} as f64 * {h:?}, &s.q, &s.p);\n    \
         for x in s.q.iter().chain(&s.p).chain([&energy]) {{ println!(\"{{:x}}\", x.to_bits()); }}\n}}\n"
    );
    fs::write(folder.join("main.rs"), main).expect("written");
    let options = "--edition 2024 -O -D warnings -A dead_code -o main-rust main.rs";
    output("rustc", &options.split(' ').collect::<Vec<_>>(), folder)?;
    output("./main-rust", &[], folder).map(|text| read(&text))
}

fn python(folder: &Path, case: &Case) -> Option<Vec<f64>> {
    fs::write(folder.join("stepper.py"), stepper(folder, case, "python")).expect("written");
    let arguments = case.values.iter().map(|(field, value)| match value {
        Length(n) => format!("{field}={n}"),
        Number(x) if *field == "lambda" => format!("lambda_={x:?}"),
        Number(x) => format!("{field}={x:?}"),
        Array(list) => format!("{field}={list:?}"),
        Pairs(list) => format!("{field}={list:?}"),
        Matrix(matrix) => format!("{field}={matrix:?}"),
    });
    let arguments = arguments.collect::<Vec<_>>().join(", ");
    let (kind, [q, p], h, steps) = (case.kind, &case.start, case.h, case.steps);
    let main = format!(
        "import struct, stepper\nsystem = stepper.{kind}({arguments})\ns = stepper.State({q:?}, {p:?})\n\
         for k in range({steps}): stepper.step(s, system.velocity, system.force, k * {h:?}, {h:?})\n\
         for x in s.q + s.p + [system.energy({steps} * {h:?}, s.q, s.p)]: print(struct.pack('>d', x).hex())\n"
    );
    fs::write(folder.join("main.py"), main).expect("written");
    output("python3", &["main.py"], folder).map(|text| read(&text))
}
