//! Tableaux in the notation of other programs: each form as a whole, and what the programs make of it.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::atomic::{AtomicU32, Ordering};

use crate::run::{failure, stdout};
use expect_test::expect_file;
use symplectic_compiler::{Coefficients, Tableau, catalogue};
use symplectic_tools::Language;

#[test]
fn exported_tables_have_the_recorded_text() {
    for (method, format, end) in [
        ("lobatto-3", "latex", "tex"),
        ("gauss-2", "c", "c"),
        ("lobatto-2", "fortran", "f90"),
        ("gauss-2", "julia", "jl"),
        ("lobatto-3", "julia", "jl"),
        ("gauss-2", "python", "py"),
        ("forest-ruth-1990", "sundials", "c"),
        ("midpoint", "sundials", "c"),
        ("forest-ruth-1990", "petsc", "c"),
        ("gauss-2", "petsc", "c"),
        ("gauss-2", "nodepy", "py"),
        ("gauss-2", "tsv", "tsv"),
        ("kahan-li-1997-s31odr10-a", "latex", "tex"),
        ("gauss-4", "latex", "tex"),
        ("saba-5", "latex", "tex"),
        ("mclachlan-atela-1992-order-3-optimal", "latex", "tex"),
    ] {
        let text = stdout(&["show", method, "--format", format]);
        let version = concat!("symplectic ", env!("CARGO_PKG_VERSION"));
        let text = text.replace(version, "symplectic VERSION");
        let file = format!("data/languages/{method}.{format}.{end}");
        expect_file![file].assert_eq(&text);
    }
}

#[test]
fn exports_refuse_methods_that_the_library_cannot_run() {
    for (method, format, reason) in [
        ("gauss-2", "sundials", "its stages need one another"),
        ("lobatto-3", "sundials", "this one is implicit"),
        ("lobatto-3", "petsc", "this one is implicit"),
        ("lobatto-3", "nodepy", "not partitioned ones"),
        ("lobatto-3", "tsv", "`--format julia` writes both tableaux"),
    ] {
        let (status, message) = failure(&["show", method, "--format", format]);
        assert_eq!(status, Some(2), "{method} {format}");
        assert!(
            message.contains("cannot express this method") && message.contains(reason),
            "{message}"
        );
    }
}

/// The least numbers of what is compared, so that nothing is left out unseen.
struct Least {
    doubles: usize,
    doubles_in_fortran: usize,
    sundials: usize,
    petsc: usize,
    inverses: usize,
}

/// What programs read is what was written.
fn assert_read(methods: &[Tableau], least: &Least) {
    c_has_the_doubles(&texts(methods, Language::C), least);
    fortran_has_the_doubles(&texts(methods, Language::Fortran), least);
    python_has_the_doubles(&texts(methods, Language::Python), least);
    latex_fits_the_page(methods);
    functions_for_libraries_compile(methods, least);
}

#[test]
fn programs_read_what_was_written() {
    let names = ["gauss-2", "lobatto-3", "forest-ruth-1990", "saba-2"];
    let methods = names.map(|name| {
        let entry = catalogue::entries().find(|entry| entry.name == name);
        entry.expect(name).derive().expect("derived")
    });
    let least = Least {
        doubles: 100,
        doubles_in_fortran: 50,
        sundials: 2,
        petsc: 3,
        inverses: 1,
    };
    assert_read(&methods, &least);
}

#[test]
#[ignore = "thorough"]
fn programs_read_the_whole_catalogue() {
    let methods: Vec<Tableau> = catalogue::entries()
        .map(|entry| entry.derive().expect("derived"))
        .collect();
    let least = Least {
        doubles: 10_001,
        doubles_in_fortran: 3001,
        sundials: 60,
        petsc: 90,
        inverses: 11,
    };
    assert_read(&methods, &least);
}

/// The methods that can be written, and their texts.
fn texts(methods: &[Tableau], language: Language) -> Vec<(&Tableau, String)> {
    let written = methods.iter().filter_map(|tableau| {
        let text = language.write(tableau, 40).ok()?;
        Some((tableau, text))
    });
    written.collect()
}

/// A folder of its own for each call.
fn folder(name: &str) -> PathBuf {
    static CALLS: AtomicU32 = AtomicU32::new(0);
    let name = format!("{name}-{}", CALLS.fetch_add(1, Ordering::Relaxed));
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// What a command prints; `None` if there is no such program here.
fn printed(program: &str, arguments: &[&str], at: &Path) -> Option<String> {
    let output = Command::new(program)
        .args(arguments)
        .current_dir(at)
        .output();
    let Ok(output) = output else {
        // Not captured: whoever reads the output of the tests shall see it.
        let _ = writeln!(std::io::stderr(), "skipped, as there is no {program} here");
        return None;
    };
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{program} {arguments:?}: {errors}");
    Some(String::from_utf8(output.stdout).expect("text"))
}

/// The bits of the doubles of a tableau, as the languages name its parts.
fn bits(tableau: &Tableau, part: &str) -> Vec<u64> {
    let Coefficients {
        c,
        c_tilde,
        b,
        b_tilde,
        a,
        a_tilde,
        gradient,
    } = tableau.to_f64();
    let values = match part {
        "c" => c,
        "b" => b,
        "c_tilde" => c_tilde,
        "b_tilde" => b_tilde,
        "a" => a.concat(),
        "a_tilde" => a_tilde.concat(),
        "gradient" => gradient,
        other => panic!("{other}"),
    };
    values.into_iter().map(f64::to_bits).collect()
}

const PARTS: [&str; 7] = ["c", "b", "c_tilde", "b_tilde", "a", "a_tilde", "gradient"];

/// Compares lines `method part bits bits …` with the tableaux; returns how many numbers were compared.
fn compare(lines: &str, methods: &[(&Tableau, String)]) -> usize {
    let mut compared = 0;
    for line in lines.lines() {
        let mut words = line.split_whitespace();
        let (index, part) = (
            words.next().expect("a method"),
            words.next().expect("a part"),
        );
        let (tableau, _) = &methods[index.parse::<usize>().expect("a number")];
        let found: Vec<u64> = words
            .map(|word| u64::from_str_radix(word, 16).expect("bits"))
            .collect();
        assert_eq!(found, bits(tableau, part), "{:?} {part}", tableau.name());
        compared += found.len();
    }
    compared
}

/// The name that a text of C gives to the parts of its tableau: what is before `_c[`.
fn prefix(text: &str) -> &str {
    let start = text.find("double ").expect("an array") + "double ".len();
    let end = text[start..].find("_c[").expect("the nodes") + start;
    &text[start..end]
}

/// Constants of C are the doubles, to the bit, of all methods.
fn c_has_the_doubles(methods: &[(&Tableau, String)], least: &Least) {
    let mut program = "#include <stdio.h>\n#include <stdint.h>\n#include <string.h>\nstatic void show(int m, const char *part, const double *x, int n) {\n  printf(\"%d %s\", m, part);\n  for (int i = 0; i < n; i++) { uint64_t u; memcpy(&u, &x[i], 8); printf(\" %016llx\", (unsigned long long)u); }\n  printf(\"\\n\");\n}\n".to_owned();
    let mut calls = String::new();
    for (index, (_, text)) in methods.iter().enumerate() {
        program.push_str(text);
        let name = prefix(text);
        for part in PARTS {
            let array = format!("{name}_{part}");
            if text.contains(&format!("double {array}[")) {
                calls.push_str(&format!(
                    "  show({index}, \"{part}\", (const double *){array}, sizeof({array})/sizeof(double));\n"
                ));
            }
        }
    }
    program.push_str(&format!("int main(void) {{\n{calls}  return 0;\n}}\n"));
    let folder = folder("c");
    fs::write(folder.join("all.c"), program).expect("written");
    let flags = ["-std=c99", "-pedantic-errors", "-Wall", "-Werror", "all.c"];
    let arguments = [&flags[..], &["-o", "all"]].concat();
    if printed("cc", &arguments, &folder).is_none() {
        return;
    }
    let lines = printed(folder.join("all").to_str().expect("text"), &[], &folder);
    let compared = compare(&lines.expect("a program"), methods);
    assert!(compared >= least.doubles, "{compared}");
}

/// Parameters of Fortran are the doubles, to the bit.
fn fortran_has_the_doubles(methods: &[(&Tableau, String)], least: &Least) {
    let folder = folder("fortran");
    if printed("gfortran", &["--version"], &folder).is_none() {
        return;
    }
    // The longest one needs more lines than a statement may have.
    let longest = methods.iter().map(|(tableau, _)| tableau.stages()).max();
    let some = |stages| stages <= 10 || Some(stages) == longest;
    let short: Vec<usize> = (0..methods.len())
        .filter(|&k| some(methods[k].0.stages()))
        .collect();
    let mut program = String::new();
    let mut main = "program show\n  use, intrinsic :: iso_fortran_env, only: int64\n".to_owned();
    let mut calls = String::new();
    for &index in &short {
        let text = &methods[index].1;
        program.push_str(text);
        let module = text.lines().find_map(|line| line.strip_prefix("module "));
        let module = module.expect("a module");
        for part in PARTS {
            if text.contains(&format!("parameter :: {part}(")) {
                let own = format!("x{index}_{part}");
                main.push_str(&format!("  use {module}, only: {own} => {part}\n"));
                let values = match part {
                    "a" | "a_tilde" => format!("transpose({own})"),
                    _ => own.clone(),
                };
                calls.push_str(&format!(
                    "  print '(a,*(1x,z16.16))', '{index} {part}', transfer({values}, [0_int64])\n"
                ));
            }
        }
    }
    program.push_str(&format!("{main}  implicit none\n{calls}end program show\n"));
    fs::write(folder.join("all.f90"), program).expect("written");
    let arguments = ["-std=f2008", "-Wall", "-Werror", "all.f90", "-o", "all"];
    printed("gfortran", &arguments, &folder);
    let lines = printed(folder.join("all").to_str().expect("text"), &[], &folder);
    let compared = compare(&lines.expect("a program"), methods);
    assert!(compared >= least.doubles_in_fortran, "{compared}");
}

/// Texts of Python are numbers whose doubles are those of the tableau.
fn python_has_the_doubles(methods: &[(&Tableau, String)], least: &Least) {
    let folder = folder("python");
    if printed("python3", &["--version"], &folder).is_none() {
        return;
    }
    for (index, (_, text)) in methods.iter().enumerate() {
        fs::write(folder.join(format!("method{index}.py")), text).expect("written");
    }
    let program = format!(
        "import importlib, struct\n\
         def flat(x):\n    return [z for y in x for z in flat(y)] if isinstance(x, list) else [x]\n\
         for k in range({}):\n    m = importlib.import_module(f'method{{k}}')\n    for part in {PARTS:?}:\n        if hasattr(m, part):\n            print(k, part, *(struct.pack('>d', x).hex() for x in flat(m.doubles(getattr(m, part)))))\n",
        methods.len()
    );
    fs::write(folder.join("show.py"), program).expect("written");
    let lines = printed("python3", &["show.py"], &folder).expect("Python runs");
    let compared = compare(&lines, methods);
    assert!(compared >= least.doubles, "{compared}");
}

/// A document with every method compiles, and nothing stands out of the text: a number would lose digits.
fn latex_fits_the_page(methods: &[Tableau]) {
    let folder = folder("latex");
    let mut document = "\\documentclass{article}\n\\usepackage{amsmath}\n\\usepackage{booktabs}\n\\usepackage{longtable}\n\\begin{document}\n".to_owned();
    for tableau in methods {
        let text = Language::Latex.write(tableau, 16).expect("every method");
        let name = tableau.name().expect("a name");
        document.push_str(&format!(
            "\\clearpage\\noindent\\verb|{name}|\\typeout{{{name}}}\n{text}"
        ));
    }
    document.push_str("\\end{document}\n");
    fs::write(folder.join("all.tex"), document).expect("written");
    let flags = ["-halt-on-error", "-interaction=nonstopmode", "all.tex"];
    // Tables on several pages have their widths from the run before.
    let runs = (0..3).map_while(|_| printed("pdflatex", &flags, &folder));
    let Some(log) = runs.last() else {
        return;
    };
    let mut name = "";
    for line in log.lines() {
        if catalogue::find(line).is_some() {
            name = line;
        }
        assert!(!line.starts_with("Overfull"), "{name}: {line}");
    }
}

/// Tables of SUNDIALS and PETSc, stepped as these libraries do, have the order that they state: on the pendulum, by halved steps.
#[test]
fn splittings_have_their_order_in_the_libraries_order_of_steps() {
    for method in [
        "symplectic-euler",
        "symplectic-euler-adjoint",
        "velocity-verlet",
        "position-verlet",
        "ruth-1983",
        "forest-ruth-1990",
        "suzuki-1990",
        "mclachlan-atela-1992-order-4-optimal",
        "mclachlan-atela-1992-order-5-optimal",
        "blanes-moan-2002-srkn6b",
    ] {
        for (format, names, drifts_first) in [
            ("sundials", ["a", "ahat"], false),
            ("petsc", ["c", "d"], true),
        ] {
            let text = stdout(&["show", method, "--format", format]);
            let [drifts, kicks] = names.map(|name| numbers(&text, name));
            let order = stated_order(&text);
            let mean = |steps: i32| {
                let end = |steps: i32| run(&drifts, &kicks, drifts_first, steps);
                let (here, exact) = (end(steps), end(8 * steps));
                (here.0 - exact.0).hypot(here.1 - exact.1)
            };
            let slope = (mean(64) / mean(128)).log2();
            assert!(
                (slope - f64::from(order)).abs() < 0.25,
                "{method} for {format}: {slope}, not {order}"
            );
            // In the other order of steps it is another method, except one with the same flows from both ends.
            if method == "ruth-1983" {
                let turned = |steps: i32| run(&drifts, &kicks, !drifts_first, steps);
                let distance = |steps: i32| {
                    let (here, exact) = (turned(steps), turned(8 * steps));
                    (here.0 - exact.0).hypot(here.1 - exact.1)
                };
                let slope = (distance(64) / distance(128)).log2();
                assert!(slope < f64::from(order) - 0.5, "{slope}");
            }
        }
    }
}

/// The pendulum H = p²/2 − cos q to the time 2.
fn run(drifts: &[f64], kicks: &[f64], drifts_first: bool, steps: i32) -> (f64, f64) {
    let (mut q, mut p) = (0.4_f64, 0.7_f64);
    let h = 2.0 / f64::from(steps);
    for _ in 0..steps {
        for (drift, kick) in drifts.iter().zip(kicks) {
            if drifts_first {
                q += h * drift * p;
                p -= h * kick * q.sin();
            } else {
                p -= h * kick * q.sin();
                q += h * drift * p;
            }
        }
    }
    (q, p)
}

/// The decimals beside the numbers of an array.
fn numbers(text: &str, name: &str) -> Vec<f64> {
    let start = text.find(&format!(" {name}[")).expect("the array");
    let lines = text[start..].lines().skip(1);
    let lines = lines.take_while(|line| !line.trim().starts_with('}'));
    lines
        .map(|line| {
            let remark = line.split("/* ").nth(1).expect("a remark");
            let remark = remark.trim_end_matches(" */");
            let last = remark.rsplit(" = ").next().expect("a number");
            match last.split_once('/') {
                Some((p, q)) => p.parse::<f64>().expect("p") / q.parse::<f64>().expect("q"),
                None => last.parse().expect("a decimal"),
            }
        })
        .collect()
}

/// The order that the call states.
fn stated_order(text: &str) -> u32 {
    let numbers = match text.split_once("SPRKTable_Create(") {
        Some((_, rest)) => rest,
        None => text.split_once("SymplecticRegister(").expect("a call").1,
    };
    let order = numbers.split(", ").nth(1).expect("an order");
    order.parse().expect("a number")
}

/// The functions for SUNDIALS and PETSc compile beside declarations as those libraries have them.
fn functions_for_libraries_compile(methods: &[Tableau], least: &Least) {
    let folder = folder("libraries");
    fs::create_dir_all(folder.join("arkode")).expect("a folder");
    let arkode = "#include <stddef.h>\ntypedef double sunrealtype;\ntypedef struct sprk *ARKodeSPRKTable;\ntypedef struct butcher *ARKodeButcherTable;\nARKodeSPRKTable ARKodeSPRKTable_Create(int s, int q, const sunrealtype *a, const sunrealtype *ahat);\nARKodeButcherTable ARKodeButcherTable_Create(int s, int q, int p, sunrealtype *c, sunrealtype *A, sunrealtype *b, sunrealtype *d);\n";
    let petsc = "#include <stddef.h>\ntypedef double PetscReal;\ntypedef double PetscScalar;\ntypedef int PetscInt;\ntypedef int PetscErrorCode;\ntypedef struct ts *TS;\n#define PETSC_SUCCESS 0\n#define PETSC_VERSION_LT(major, minor, subminor) 0\n#define PetscFunctionBegin do { } while (0)\n#define PetscFunctionReturn(x) return x\n#define PetscCall(x) do { PetscErrorCode e = x; if (e) return e; } while (0)\nPetscErrorCode TSBasicSymplecticRegister(const char *name, PetscInt order, PetscInt s, PetscReal c[], PetscReal d[]);\nPetscErrorCode TSIRKTableauCreate(TS, PetscInt, const PetscReal *, const PetscReal *, const PetscReal *, const PetscReal *, const PetscScalar *, const PetscScalar *, const PetscScalar *);\n";
    for (path, text) in [
        ("arkode/arkode_sprk.h", arkode),
        (
            "arkode/arkode_butcher.h",
            "#include <arkode/arkode_sprk.h>\n",
        ),
        ("petscts.h", petsc),
    ] {
        let text = format!("#pragma once\n{text}");
        fs::write(folder.join(path), text).expect("written");
    }
    for (language, file, least) in [
        (Language::Sundials, "sundials.c", least.sundials),
        (Language::Petsc, "petsc.c", least.petsc),
    ] {
        let written = texts(methods, language);
        assert!(written.len() >= least, "{file}: {}", written.len());
        let texts: String = written.iter().map(|(_, text)| text.as_str()).collect();
        fs::write(folder.join(file), texts).expect("written");
        let flags = ["-std=c99", "-Wall", "-Werror", "-Wno-unused-function"];
        let arguments = [&flags[..], &["-I.", "-c", file]].concat();
        if printed("cc", &arguments, &folder).is_none() {
            return;
        }
    }
    tsirk_has_the_inverse(&folder, methods, least.inverses);
}

/// TSIRK reads `A` row by row and `A_inv` column by column: so read they are inverse to one another, for every method.
fn tsirk_has_the_inverse(folder: &Path, methods: &[Tableau], least: usize) {
    let mut program = "#include \"petsc.c\"\n#include <math.h>\n#include <stdio.h>\nPetscErrorCode TSBasicSymplecticRegister(const char *name, PetscInt order, PetscInt s, PetscReal c[], PetscReal d[]) { (void)name; (void)order; (void)s; (void)c; (void)d; return 0; }\nPetscErrorCode TSIRKTableauCreate(TS ts, PetscInt n, const PetscReal *A, const PetscReal *b, const PetscReal *c, const PetscReal *binterp, const PetscScalar *A_inv, const PetscScalar *sums, const PetscScalar *I_s) {\n  (void)ts; (void)b; (void)c; (void)binterp; (void)sums; (void)I_s;\n  double distance = 0;\n  for (int i = 0; i < n; i++)\n    for (int k = 0; k < n; k++) {\n      double sum = i == k ? -1 : 0;\n      for (int j = 0; j < n; j++) sum += A[i * n + j] * A_inv[j + k * n];\n      distance = fmax(distance, fabs(sum));\n    }\n  printf(\"%d %g\\n\", n, distance);\n  return 0;\n}\nint main(void) {\n".to_owned();
    let create = |text: &str| {
        let start = text.find("PetscErrorCode ")? + "PetscErrorCode ".len();
        let end = text[start..].find("_create(TS ts)")? + start;
        Some(text[start..end].to_owned())
    };
    for (_, text) in texts(methods, Language::Petsc) {
        if let Some(name) = create(&text) {
            program.push_str(&format!("  {name}_create(NULL);\n"));
        }
    }
    program.push_str("  return 0;\n}\n");
    fs::write(folder.join("irk.c"), program).expect("written");
    let flags = ["-std=c99", "-w", "-I.", "irk.c", "-lm", "-o", "irk"];
    if printed("cc", &flags, folder).is_none() {
        return;
    }
    let lines = printed(folder.join("irk").to_str().expect("text"), &[], folder);
    let lines = lines.expect("a program");
    assert!(lines.lines().count() >= least, "{lines}");
    for line in lines.lines() {
        let (_, distance) = line.split_once(' ').expect("two numbers");
        assert!(distance.parse::<f64>().expect("a number") < 1e-10, "{line}");
    }
}
