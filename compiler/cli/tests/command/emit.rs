//! Steppers in other languages: their form, and their steps on Kepler's orbit, which has a closed form.

use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::run::{failure, stdout};
use expect_test::expect_file;

#[test]
fn emitted_steppers_have_the_recorded_text() {
    for (method, language, end) in [
        ("stormer-verlet", "c", "c"),
        ("ruth-1983", "rust", "rs"),
        ("forest-ruth-1990", "julia", "jl"),
        ("gauss-2", "python", "py"),
        ("gauss-2", "c", "c"),
        ("gauss-2", "rust", "rs"),
        ("gauss-2", "julia", "jl"),
    ] {
        let version = concat!("symplectic ", env!("CARGO_PKG_VERSION"));
        let text = emit(method, language, &[]).replace(version, "symplectic VERSION");
        let file = format!("data/emit/{method}.{end}");
        expect_file![file].assert_eq(&text);
    }
}

#[test]
fn emit_refuses_methods_that_it_cannot_write() {
    let refusal = |arguments: &[&str]| {
        let (status, message) = failure(&[&["emit"], arguments].concat());
        assert_eq!(status, Some(2), "{message}");
        message
    };
    let separable = ["gauss-2", "--language", "c", "--class", "separable"];
    assert!(refusal(&separable).contains("does not consist of drifts and kicks"));
    let long = ["triple-jump-10", "--language", "c", "--class", "general"];
    assert!(refusal(&long).contains("too long"));
    assert!(refusal(&["gauss-2", "--language", "cobol"]).contains("c, rust, julia, python"));
    assert!(refusal(&["gaus-2", "--language", "c"]).contains("gauss-2"));
    // Explicit, but no drifts and kicks.
    let kutta = folder("refused").join("kutta.toml");
    let definition =
        "[provenance]\na = \"[[0, 0, 0], [1/2, 0, 0], [-1, 2, 0]]\"\nb = \"1/6, 2/3, 1/6\"\n";
    fs::write(&kutta, definition).expect("written");
    let kutta = kutta.display().to_string();
    assert!(refusal(&[&kutta, "--language", "rust"]).contains("not symplectic"));
}

/// A method, how it is asked for, its proved order, and steps an orbit of which twice as many still have errors far above rounding.
struct Case {
    method: &'static str,
    options: &'static [&'static str],
    order: i32,
    orbit: usize,
}

const CASES: [Case; 8] = [
    case("symplectic-euler", &[], 1, 4000),
    case("stormer-verlet", &[], 2, 1600),
    case("position-verlet", &[], 2, 1600),
    case("forest-ruth-1990", &[], 4, 800),
    case("yoshida-1990-order-6-a", &[], 6, 160),
    case("stormer-verlet", &["--class", "general"], 2, 1600),
    case("gauss-2", &[], 4, 160),
    case("lobatto-4", &[], 6, 48),
];

const fn case(
    method: &'static str,
    options: &'static [&'static str],
    order: i32,
    orbit: usize,
) -> Case {
    Case {
        method,
        options,
        order,
        orbit,
    }
}

/// Steps of the orbit of eccentricity 0.2 from its pericentre: positions and momenta after three eighths of it with two step sizes, and
/// after ten orbits of 100 steps.
#[test]
fn languages_agree_to_the_last_bit_and_with_the_closed_form() {
    for (number, case) in CASES.iter().enumerate() {
        let general = emit(case.method, "c", case.options).contains("mu_tilde");
        let folder = folder(&format!("kepler-{number}"));
        let orbits = [case.orbit, 2 * case.orbit].map(|orbit| (3 * orbit / 8, orbit));
        let runs = [orbits[0], orbits[1], (1000, 100)];
        let results: Vec<Vec<[f64; 4]>> = [c, rust, python]
            .into_iter()
            .filter_map(|language| language(&folder, case, general, &runs))
            .collect();
        for other in results.iter().skip(1) {
            let bits = |found: &[[f64; 4]]| -> Vec<u64> {
                found.iter().flatten().map(|x| x.to_bits()).collect()
            };
            assert_eq!(bits(other), bits(&results[0]), "{}", case.method);
        }
        let Some([coarse, fine, long]) =
            results.first().map(|found| [found[0], found[1], found[2]])
        else {
            continue;
        };
        let exact = kepler(0.2, core::f64::consts::TAU * 3.0 / 8.0);
        let error = |found: [f64; 4]| -> f64 {
            let squares = found.iter().zip(exact).map(|(x, y)| (x - y).powi(2));
            squares.sum::<f64>().sqrt()
        };
        let slope = (error(coarse) / error(fine)).log2();
        assert!(
            (slope - f64::from(case.order)).abs() < 0.05,
            "{}: {slope}, {:e} {:e}",
            case.method,
            error(coarse),
            error(fine)
        );
        // After ten orbits of 100 steps the energy is what it was, up to an error of the order: there is no drift.
        let energy = |[x, y, px, py]: [f64; 4]| 0.5 * (px * px + py * py) - 1.0 / x.hypot(y);
        let bound = 0.1 * (core::f64::consts::TAU / 100.0).powi(case.order);
        let change = (energy(long) - energy(kepler(0.2, 0.0))).abs();
        assert!(change < bound, "{}: {change:e} of {bound:e}", case.method);
    }
}

/// Position and momentum on the orbit of eccentricity `e` at a time after the pericentre: the closed form, by Kepler's equation.
fn kepler(e: f64, time: f64) -> [f64; 4] {
    let mut anomaly = time;
    for _ in 0..100 {
        anomaly = time + e * anomaly.sin();
    }
    let (sine, cosine) = anomaly.sin_cos();
    let (axis, r) = ((1.0 - e * e).sqrt(), 1.0 - e * cosine);
    [cosine - e, axis * sine, -sine / r, axis * cosine / r]
}

/// The state is where it was after a step that fails: in Python.
#[test]
fn a_step_that_fails_leaves_the_state() {
    // A force that is not finite, and a step that is far too large.
    for (number, case) in [CASES[1].method, "gauss-2"].into_iter().enumerate() {
        let folder = folder(&format!("failure-{number}"));
        let main = |force: &str, h: &str| {
            let arguments = if number == 0 { "t, x" } else { "t, q, p" };
            let x = if number == 0 { "x" } else { "q" };
            let v = if number == 0 { "x" } else { "p" };
            format!(
                "import math\nimport stepper\ndef velocity({arguments}): return list({v})\n\
                 def force({arguments}): return [{force} for y in {x}]\n\
                 s = stepper.State([1.0], [0.5])\n\
                 try:\n    stepper.step(s, velocity, force, 0.0, {h})\n    print('ok', s.q, s.p)\n\
                 except ArithmeticError as error:\n    print(type(error).__name__, s.q, s.p, s.q_low, s.p_low)\n"
            )
        };
        fs::write(folder.join("stepper.py"), emit(case, "python", &[])).expect("written");
        let run = |force: &str, h: &str| {
            fs::write(folder.join("main.py"), main(force, h)).expect("written");
            output("python3", &["main.py"], &folder)
        };
        let Some(found) = run("math.nan", "0.1") else {
            return;
        };
        assert_eq!(found, "NotFinite [1.0] [0.5] [0.0] [0.0]\n");
        if number == 1 {
            let found = run("-math.sin(40 * y)", "3.0").expect("Python runs");
            assert_eq!(found, "DoesNotConverge [1.0] [0.5] [0.0] [0.0]\n");
        }
        // The twin: a force that is finite and a step that is not too large.
        assert!(
            run("-y", "0.1")
                .expect("Python runs")
                .starts_with("ok [1.04")
        );
    }
}

/// Systems that Kepler's orbit does not show: bodies far from the origin that hardly move, H that depends on time, and forces that reuse
/// their list.
const HARD: &str = r"
import math, stepper

def run(velocity, force, q, p, t, h, steps):
    s = stepper.State(q, p)
    for k in range(steps):
        stepper.step(s, velocity, force, t + k * h, h)
    return s.q, s.p

# A chain of six bodies at rest lengths 1: momenta are far smaller than positions.
def chain(t, q, p):
    pull = [q[i + 1] - q[i] - 1 for i in range(5)]
    return [(pull[i] if i < 5 else 0.0) - (pull[i - 1] if i > 0 else 0.0) for i in range(6)]

start = [i + 1e-3 * math.sin(i) for i in range(6)]
q, p = run(lambda t, q, p: list(p), chain, start, [0.0] * 6, 0.0, 0.2, 2000)
energy = lambda q, p: sum(x * x for x in p) / 2 + sum((q[i + 1] - q[i] - 1) ** 2 for i in range(5)) / 2
before = energy(start, [0.0] * 6)
assert abs(energy(q, p) / before - 1) < 0.03, energy(q, p) / before

# H = (1 + q^2) (1 + 0.3 sin t) p^2/2 is not separable and depends on time: the step has the determinant 1.
v = lambda t, q, p: [(1 + q[0] ** 2) * (1 + 0.3 * math.sin(t)) * p[0]]
f = lambda t, q, p: [-q[0] * (1 + 0.3 * math.sin(t)) * p[0] ** 2]
e = 1e-4
ends = [run(v, f, [0.7 + a * e], [0.9 + b * e], 0.3, 0.2, 1) for a, b in [(1, 0), (-1, 0), (0, 1), (0, -1)]]
dq = [[(ends[i][k][0] - ends[i + 1][k][0]) / (2 * e) for k in (0, 1)] for i in (0, 2)]
determinant = dq[0][0] * dq[1][1] - dq[0][1] * dq[1][0]
assert abs(determinant - 1) < 1e-6, determinant

# A force that writes into one list gives the same as one that makes a new one.
memory = [0.0]
def reused(t, q, p):
    memory[0] = -q[0]
    return memory
fresh = run(lambda t, q, p: list(p), lambda t, q, p: [-q[0]], [1.0], [0.0], 0.0, 0.1, 10)
assert run(lambda t, q, p: list(p), reused, [1.0], [0.0], 0.0, 0.1, 10) == fresh
print('ok')
";

#[test]
fn emitted_coupled_stages_step_a_chain_and_a_nonseparable_system() {
    for (method, options) in [
        ("gauss-2", &[][..]),
        ("gauss-4", &[]),
        ("lobatto-3", &[]),
        ("stormer-verlet", &["--class", "general"]),
    ] {
        let folder = folder(&format!("hard-{method}"));
        fs::write(folder.join("stepper.py"), emit(method, "python", options)).expect("written");
        fs::write(folder.join("main.py"), HARD).expect("written");
        let Some(found) = output("python3", &["main.py"], &folder) else {
            return;
        };
        assert_eq!(found, "ok\n", "{method}");
    }
}

/// A force is kept for the next step of its own state only, whatever list it was in.
#[test]
fn an_emitted_stepper_copies_the_force_it_carries() {
    let folder = folder("carried");
    let main = "
import stepper
memory = [0.0]
def force(t, q):
    memory[0] = -q[0]
    return memory
def run(force):
    states = [stepper.State([1.0], [0.0]), stepper.State([5.0], [0.0])]
    for k in range(10):
        for s in states:
            stepper.step(s, lambda t, p: list(p), force, k * 0.1, 0.1)
    return [s.q + s.p for s in states]
assert run(force) == run(lambda t, q: [-q[0]])
print('ok')
";
    fs::write(
        folder.join("stepper.py"),
        emit("stormer-verlet", "python", &[]),
    )
    .expect("written");
    fs::write(folder.join("main.py"), main).expect("written");
    if let Some(found) = output("python3", &["main.py"], &folder) {
        assert_eq!(found, "ok\n");
    }
}

pub fn emit(method: &str, language: &str, options: &[&str]) -> String {
    stdout(&[&["emit", method, "--language", language], options].concat())
}

/// A folder of its own for a test.
pub fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"))
        .join("emit")
        .join(name);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// What a program prints; `None` where it is not installed.
pub fn output(program: &str, arguments: &[&str], folder: &Path) -> Option<String> {
    let output = Command::new(program)
        .args(arguments)
        .current_dir(folder)
        .output();
    let Ok(output) = output else {
        let _ = writeln!(std::io::stderr(), "skipped, as there is no {program} here");
        return None;
    };
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{program} {arguments:?}: {errors}");
    Some(String::from_utf8(output.stdout).expect("text"))
}

/// Four numbers a line, as bits in hexadecimal.
fn read(text: &str) -> Vec<[f64; 4]> {
    let line = |line: &str| {
        let number = |word| f64::from_bits(u64::from_str_radix(word, 16).expect("bits"));
        let numbers: Vec<f64> = line.split_whitespace().map(number).collect();
        numbers.try_into().expect("four numbers")
    };
    text.lines().map(line).collect()
}

/// The number of steps of each run, and how many make an orbit.
type Runs = [(usize, usize); 3];

fn c(folder: &Path, case: &Case, general: bool, runs: &Runs) -> Option<Vec<[f64; 4]>> {
    let mut name = case.method.replace('-', "_");
    if !case.options.is_empty() {
        name.push_str("_general");
    }
    let upper = name.to_uppercase();
    let arguments = match general {
        true => [
            "const double *q, const double *p",
            "const double *q, const double *p",
        ],
        false => ["const double *p", "const double *q"],
    };
    let unused = if general {
        ["(void)q; ", "(void)p; "]
    } else {
        ["", ""]
    };
    let calls = runs.map(|(steps, orbit)| format!("    run({steps}, {orbit});\n"));
    let main = format!(
        "#include \"stepper.c\"\n#include <inttypes.h>\n#include <stdint.h>\n#include <stdio.h>\n#include <string.h>\n\
         static void velocity(double t, {}, double *v, void *context) {{ (void)t; (void)context; {}v[0] = p[0]; v[1] = p[1]; }}\n\
         static void force(double t, {}, double *f, void *context) {{\n    (void)t; (void)context; {}double r = sqrt(q[0] * q[0] + q[1] * q[1]);\n\
             double r3 = r * r * r; f[0] = -q[0] / r3; f[1] = -q[1] / r3;\n}}\n\
         static void run(int steps, int orbit) {{\n    double memory[{upper}_DOUBLES(2)];\n    {name}_state s;\n\
             {name}_system system = {{velocity, force, NULL}};\n    double h = 2.0 * 3.141592653589793 / orbit;\n\
             {name}_start(&s, 2, memory);\n    s.q[0] = 0.8; s.p[1] = sqrt(1.2 / 0.8);\n\
             for (int k = 0; k < steps; k++) if ({name}_step(&s, &system, k * h, h) != {upper}_OK) printf(\"failed\\n\");\n\
             double found[4] = {{s.q[0], s.q[1], s.p[0], s.p[1]}};\n    uint64_t bits[4];\n    memcpy(bits, found, sizeof bits);\n\
             for (int i = 0; i < 4; i++) printf(\"%\" PRIx64 \" \", bits[i]);\n    printf(\"\\n\");\n}}\n\
         int main(void) {{\n{}    return 0;\n}}\n",
        arguments[0],
        unused[0],
        arguments[1],
        unused[1],
        calls.concat()
    );
    fs::write(
        folder.join("stepper.c"),
        emit(case.method, "c", case.options),
    )
    .expect("written");
    fs::write(folder.join("main.c"), main).expect("written");
    let options = "-std=c99 -pedantic-errors -Wall -Wextra -Werror -O2 -ffp-contract=off -o main-c main.c -lm";
    let options: Vec<&str> = options.split(' ').collect();
    output("cc", &options, folder)?;
    output("./main-c", &[], folder).map(|text| read(&text))
}

fn rust(folder: &Path, case: &Case, general: bool, runs: &Runs) -> Option<Vec<[f64; 4]>> {
    let [velocity, force] = match general {
        true => ["_q: &[f64; 2], p: &[f64; 2]", "q: &[f64; 2], _p: &[f64; 2]"],
        false => ["p: &[f64; 2]", "q: &[f64; 2]"],
    };
    let calls = runs.map(|(steps, orbit)| format!("    run({steps}, {orbit});\n"));
    let main = format!(
        "mod stepper;\nuse stepper::*;\nstruct Kepler;\nimpl System<2> for Kepler {{\n\
             fn velocity(&self, _t: f64, {velocity}) -> [f64; 2] {{ *p }}\n\
             fn force(&self, _t: f64, {force}) -> [f64; 2] {{\n        let r = (q[0] * q[0] + q[1] * q[1]).sqrt();\n\
                 let r3 = r * r * r;\n        [-q[0] / r3, -q[1] / r3]\n    }}\n}}\n\
         fn run(steps: u32, orbit: u32) {{\n    let mut s = State::new([0.8, 0.0], [0.0, f64::sqrt(1.2 / 0.8)]);\n\
             let h = 2.0 * 3.141592653589793 / f64::from(orbit);\n\
             for k in 0..steps {{ s.step(&Kepler, f64::from(k) * h, h).expect(\"a step\"); }}\n\
             for x in [s.q[0], s.q[1], s.p[0], s.p[1]] {{ print!(\"{{:x}} \", x.to_bits()); }}\n    println!();\n}}\n\
         fn main() {{\n{}}}\n",
        calls.concat()
    );
    fs::write(
        folder.join("stepper.rs"),
        emit(case.method, "rust", case.options),
    )
    .expect("written");
    fs::write(folder.join("main.rs"), main).expect("written");
    output(
        "rustc",
        &["--edition", "2024", "-O", "-o", "main-rust", "main.rs"],
        folder,
    )?;
    output("./main-rust", &[], folder).map(|text| read(&text))
}

fn python(folder: &Path, case: &Case, general: bool, runs: &Runs) -> Option<Vec<[f64; 4]>> {
    let arguments = if general {
        ["t, q, p"; 2]
    } else {
        ["t, p", "t, q"]
    };
    let calls = runs.map(|(steps, orbit)| format!("run({steps}, {orbit})\n"));
    let main = format!(
        "import math, struct, stepper\ndef velocity({}): return list(p)\n\
         def force({}):\n    r = math.sqrt(q[0] * q[0] + q[1] * q[1])\n    r3 = r * r * r\n    return [-q[0] / r3, -q[1] / r3]\n\
         def run(steps, orbit):\n    s = stepper.State([0.8, 0.0], [0.0, math.sqrt(1.2 / 0.8)])\n    h = 2.0 * 3.141592653589793 / orbit\n    \
         for k in range(steps): stepper.step(s, velocity, force, k * h, h)\n    \
         print(*(struct.pack('>d', x).hex() for x in s.q + s.p))\n{}",
        arguments[0],
        arguments[1],
        calls.concat()
    );
    let text = emit(case.method, "python", case.options);
    fs::write(folder.join("stepper.py"), text).expect("written");
    fs::write(folder.join("main.py"), main).expect("written");
    output("python3", &["main.py"], folder).map(|text| read(&text))
}
