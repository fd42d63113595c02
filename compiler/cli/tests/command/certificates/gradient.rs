//! Certificates of splittings with gradient kicks, and their negative twins.

use super::{folder, python, root};

/// Exact weights, those of the catalogue, and weights that solve order conditions.
#[test]
fn the_checker_proves_methods_with_gradient_kicks() {
    let read = |name: &str| {
        let path = root().join("tableaux/certificates").join(name);
        std::fs::read_to_string(path).expect("a certificate")
    };
    let edited = |text: &str, from: &str, to: &str| {
        assert!(text.contains(from), "{from}: {text}");
        text.replacen(from, to, 1)
    };
    let solved = "kick: [0.1, 0.3, 0.2], drift: [0.2642977396044841585331, 0.2357022603955158414669], \
                  gradient: [0, 0.001488997137002978556646, 0], symmetric: true, claim: nystrom(4)";
    let definition = symplectic_compiler::Definition::parse(solved).expect("a definition");
    let solved = definition.derive(&symplectic_compiler::Limits::default());
    let solved = symplectic_tools::certificate::write(&solved.expect("derived"));
    let solved = solved.expect("a certificate");
    let chin = read("chin-1997-c.json");
    let square_roots = read("chin-chen-2002-4b.json");
    let right = "right: doubles, palindrome, nystrom 4, stability";
    // The other sign of g, with the doubles that belong to it.
    let other_sign = edited(
        &edited(&chin, "\"1/72\"", "\"-1/72\""),
        "\"0x1.c71c71c71c71cp-7\"",
        "\"-0x1.c71c71c71c71cp-7\"",
    );
    let [digits, twice] = [
        ("\"0.001488", "\"0.001489"),
        ("\"0\", \"0\", \"1\", \"0\"", "\"0\", \"0\", \"2\", \"0\""),
    ];
    let folder = folder("gradient");
    for (name, text, part) in [
        ("rational", chin.clone(), right),
        ("roots", square_roots, right),
        ("solved", solved.clone(), right),
        ("sign", other_sign, "WRONG: not proved: order 4 (nystrom)"),
        (
            "double",
            edited(&chin, "\"1/72\"", "\"1/73\""),
            "WRONG: not proved: gradient[2]",
        ),
        (
            "class",
            edited(&chin, "\"nystrom\": {", "\"separable\": {"),
            "WRONG: not proved: members that are known",
        ),
        (
            "palindrome",
            edited(&chin, "true", "false"),
            "WRONG: not proved: palindrome = False",
        ),
        (
            "trace",
            edited(&chin, "\"36\"", "\"37\""),
            "WRONG: not proved: the trace",
        ),
        (
            "digits",
            edited(&solved, digits.0, digits.1),
            "WRONG: not proved: a solution of the order conditions",
        ),
        (
            "twice",
            edited(&solved, twice.0, twice.1),
            "WRONG: not proved: the conditions of the class",
        ),
    ] {
        let path = folder.join(format!("{name}.json"));
        std::fs::write(&path, text).expect("written");
        let path = path.to_str().expect("a path");
        let Some((_, said)) = python(&["tableaux/check_certificate.py", path]) else {
            return;
        };
        assert!(said.contains(part), "{name}: {said}");
    }
}
