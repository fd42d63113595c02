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
          pf' = 0

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
fn equations_in_latex_have_friction_multipliers_and_zeros() {
    for (name, text, latex) in [
        (
            "friction",
            "Fric { g: 0.1 } q: [x], p: [px]; H = px^2/2 + x^2/2 friction: g",
            expect![[r#"
                \begin{aligned}
                  H &= \tfrac{1}{2}\,{\mathrm{px}}^{2} + \tfrac{1}{2}\,{x}^{2} \\
                  \dot{x} &= \mathrm{px} \\
                  \dot{\mathrm{px}} &= -x - \mathrm{px}\,g \\
                  \frac{\partial^2 H}{\partial \mathrm{px}\,\partial \mathrm{px}} &\mathrel{+}= 1 \\
                  \frac{\partial^2 H}{\partial x\,\partial x} &\mathrel{+}= 1
                \end{aligned}
            "#]],
        ),
        (
            "constraints",
            "C { g: 9.81 } q: [x, y], p: [px, py]; H = (px^2+py^2)/2 + g y constraints: { rod = x^2 + y^2 - 1 }",
            expect![[r#"
                \begin{aligned}
                  H &= \tfrac{1}{2}\,\left({\mathrm{px}}^{2} + {\mathrm{py}}^{2}\right) + y\,g \\
                  \dot{x} &= \mathrm{px} \\
                  \dot{y} &= \mathrm{py} \\
                  \dot{\mathrm{px}} &= -2\,x\,\lambda \\
                  \dot{\mathrm{py}} &= -g - 2\,y\,\lambda \\
                  {x}^{2} + {y}^{2} - 1 &= 0 \\
                  \frac{\partial^2 H}{\partial \mathrm{px}\,\partial \mathrm{px}} &\mathrel{+}= 1 \\
                  \frac{\partial^2 H}{\partial \mathrm{py}\,\partial \mathrm{py}} &\mathrel{+}= 1
                \end{aligned}
            "#]],
        ),
        (
            "cyclic",
            "Cyclic q: [x, y], p: [px, py]; H = (px^2+py^2)/2 + x^2",
            expect![[r#"
                \begin{aligned}
                  H &= \tfrac{1}{2}\,\left({\mathrm{px}}^{2} + {\mathrm{py}}^{2}\right) + {x}^{2} \\
                  \dot{x} &= \mathrm{px} \\
                  \dot{y} &= \mathrm{py} \\
                  \dot{\mathrm{px}} &= -2\,x \\
                  \dot{\mathrm{py}} &= 0 \\
                  \frac{\partial^2 H}{\partial \mathrm{px}\,\partial \mathrm{px}} &\mathrel{+}= 1 \\
                  \frac{\partial^2 H}{\partial \mathrm{py}\,\partial \mathrm{py}} &\mathrel{+}= 1 \\
                  \frac{\partial^2 H}{\partial x\,\partial x} &\mathrel{+}= 2
                \end{aligned}
            "#]],
        ),
    ] {
        let path = file(&format!("{name}.txt"), text);
        latex.assert_eq(&stdout(&["derive-system", &path, "--format", "latex"]));
    }
}

#[test]
fn conserved_momenta_have_the_names_of_their_components() {
    for (text, sentences, components) in [
        (
            "Body q: [1; 3], p: [1; 3]; H = |p[0]|^2/2 + q[0][2]",
            "`total_momentum` in x and y is conserved\n  `angular_momentum` about z is conserved",
            vec![
                ("total_momentum", "x"),
                ("total_momentum", "y"),
                ("angular_momentum", "z"),
            ],
        ),
        (
            "Frame { w: 1 } q: [3], p: [3]; H = |p|^2/2 - 1/|q| + w (q[0] p[1] - q[1] p[0])",
            "`angular_momentum` about z is conserved",
            vec![("angular_momentum", "z")],
        ),
        (
            "Names q: [a, b, c], p: [pa, pb, pc]; H = (pa^2 + pb^2 + pc^2)/2 + b + (a^2 + c^2)^2",
            "`angular_momentum` about b is conserved",
            vec![("angular_momentum", "b")],
        ),
        (
            "Wide<N> q: [N; 5], p: [N; 5]; H = sum(i: |p[i]|^2/2 + q[i][0]^2 + q[i][1]^2 + q[i][3]^4)",
            "`total_momentum` in 2 and 4 is conserved",
            vec![("total_momentum", "2"), ("total_momentum", "4")],
        ),
    ] {
        let path = file("conserved.txt", text);
        let shown = stdout(&["derive-system", &path]);
        assert!(shown.contains(&format!("  {sentences}\n")), "{shown}");
        let json = stdout(&["derive-system", &path, "--format", "json"]);
        let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
        let found = json["conserved_momenta"].as_array().expect("a list");
        let found = found
            .iter()
            .map(|part| [&part["name"], &part["component"]].map(|x| x.as_str().expect("a name")));
        let expected = components
            .iter()
            .map(|&(name, component)| [name, component]);
        assert_eq!(found.collect::<Vec<_>>(), expected.collect::<Vec<_>>());
        let latex = stdout(&["derive-system", &path, "--format", "latex"]);
        assert_eq!(latex.matches("\\mathrm{const}").count(), components.len());
    }
    // A number needs no name of a component, and old readers find the names of the momenta.
    let chain = "Chain q: [..], p: [..]; bonds: free; H = sum(i: p[i]^2/2) + sum(bonds d: d^4)";
    let path = file("conserved.txt", chain);
    assert!(stdout(&["derive-system", &path]).contains("  `total_momentum` is conserved\n"));
    let json = stdout(&["derive-system", &path, "--format", "json"]);
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(json["conserved"], serde_json::json!(["total_momentum"]));
    let momentum = &json["conserved_momenta"][0];
    assert_eq!(
        (&momentum["component"], &momentum["text"]),
        (
            &serde_json::Value::Null,
            &serde_json::json!("Σ(0 ≤ i < n) p[i]")
        )
    );
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
