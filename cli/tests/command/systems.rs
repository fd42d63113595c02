//! `symplectic derive-system`.

use std::fs;
use std::process::Command;

use crate::run::stdout;
use expect_test::{expect, expect_file};

const PENDULUM: &str = "Pendulum { g: 9.81 } q: [a], p: [pa]; H = pa^2/2 - g cos(a)\n";

fn file(name: &str, text: &str) -> String {
    let path = std::env::temp_dir().join(format!("symplectic-{}-{name}", std::process::id()));
    fs::write(&path, text).expect("a file");
    path.display().to_string()
}

#[test]
fn a_system_is_derived() {
    let path = file("pendulum.txt", PENDULUM);
    expect![[r#"
        Pendulum

        parameters
          g = 9.81

        Hamiltonian
          H = (1/2) pa² − g cos(a)

        equations of motion
          a' = pa
          pa' = −g sin(a)

        second derivatives
          ∂²H/∂pa∂pa += 1
          ∂²H/∂a∂a += g cos(a)

        found in the formula
          separable, with the kinetic energy |p|²/2
          independent of time, so H is conserved
    "#]]
    .assert_eq(&stdout(&["derive-system", &path]));
}

#[test]
fn a_system_is_derived_as_latex_and_json() {
    let planets = "Planets<N> { m: [N], G: 1 } q: [N; 2], p: [N; 2];
        H = sum(i: |p[i]|^2/(2 m[i])) - sum(i < j: G m[i] m[j]/|q[i] - q[j]|)";
    let path = file("planets.txt", planets);
    for format in ["latex", "json"] {
        expect_file![format!("data/planets.{format}")].assert_eq(&stdout(&[
            "derive-system",
            &path,
            "--format",
            format,
        ]));
    }
}

#[test]
fn a_file_of_toml_holds_the_same() {
    let (plain, toml) = (
        file("p.txt", PENDULUM),
        file("p.toml", &format!("hamiltonian = '''\n{PENDULUM}'''\n")),
    );
    assert_eq!(
        stdout(&["derive-system", &plain]),
        stdout(&["derive-system", &toml])
    );
}

const SPHERE: &str =
    "Sphere { g: 9.81 } q: [a, f], v: [va, vf]; L = (va^2 + sin(a)^2 vf^2)/2 - g cos(a)\n";

#[test]
fn a_system_is_derived_from_its_lagrangian() {
    let path = file("sphere.txt", SPHERE);
    expect![[r#"
        Sphere

        parameters
          g = 9.81

        Lagrangian
          L = (1/2) (va² + vf² sin(a)²) − g cos(a)

        momenta
          pa = va
          pf = vf sin(a)²

        Hamiltonian
          H = (1/2) pa² + (1/2) pf²/sin(a)² + g cos(a)

        equations of motion
          a' = pa
          f' = pf/sin(a)²
          pa' = g sin(a) + cos(a) (pf²/sin(a)³)

        second derivatives
          ∂²H/∂pa∂pa += 1
          ∂²H/∂pf∂pf += 1/sin(a)²
          ∂²H/∂pf∂a += −2 cos(a) (pf/sin(a)³)
          ∂²H/∂a∂a += sin(a) (pf²/sin(a)³) − cos(a) (g − 3 pf² cos(a)/sin(a)⁴)

        found in the formula
          not separable
          independent of time, so H is conserved
          the mass matrix is regular at random points
          `f` is cyclic, so `pf` is conserved
    "#]]
    .assert_eq(&stdout(&["derive-system", &path]));
    let toml = file(
        "sphere.toml",
        &format!("lagrangian = '{}'\n", SPHERE.trim()),
    );
    for format in ["latex", "json"] {
        let shown = stdout(&["derive-system", &path, "--format", format]);
        expect_file![format!("data/sphere.{format}")].assert_eq(&shown);
        let same = stdout(&["derive-system", &toml, "--format", format]);
        assert_eq!(shown, same);
    }
    let both = file("both.toml", "lagrangian = 'L'\nhamiltonian = 'H'\n");
    let output = Command::new(env!("CARGO_BIN_EXE_symplectic"))
        .args(["derive-system", &both])
        .output()
        .expect("a run");
    assert!(String::from_utf8_lossy(&output.stderr).contains("has both keys"));
}

#[test]
fn errors_stand_at_their_place() {
    let path = file(
        "wrong.txt",
        "Pendulum q: [a], p: [pa];\nH = pa^2/2 - cos(b)\n",
    );
    let output = Command::new(env!("CARGO_BIN_EXE_symplectic"))
        .args(["derive-system", &path])
        .output()
        .expect("a run");
    assert_eq!(output.status.code(), Some(2));
    let error = String::from_utf8_lossy(&output.stderr).replace(&path, "wrong.txt");
    expect![[r#"
        error: unknown name `b`; known here: a, p, pa, pi, q, t
         --> wrong.txt:2:18
          |
        2 | H = pa^2/2 - cos(b)
          |                  ^
    "#]]
    .assert_eq(&error);
}
