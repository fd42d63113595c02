//! Names with two meanings, names of a single coordinate, and formulas as they are printed.

use crate::formula;
use expect_test::expect;
use symplectic_formula::display::Notation;
use symplectic_formula::{Form, description};

fn refused(text: &str) -> String {
    formula::refused(Form::of(text), text)
}

fn code(text: &str) -> String {
    let (read, structure) = formula::read(Form::of(text), text);
    formula::code(&read, &structure)
}

/// A definition with these names for a length, a parameter, a position, a momentum, a velocity, a function, an abbreviation, and one with
/// an argument.
fn definition([length, parameter, x, px, vx, function, short, called]: [&str; 8]) -> String {
    format!(
        "S<{length}> {{ {parameter}: 1, a: [{length}] }} q: [{x}, y], p: [{px}, py], v: [{vx}, vy];
         extern fn {function} with slope, curvature; let {short} = 2; let {called}(b) = b;
         H = ({px}^2 + py^2)/2 + {function}({x}) + {called}({x}) {short} {parameter} + sum(i: a[i]) y
         nonholonomic: {{ edge = {vx} - vy }}"
    )
}

#[test]
fn two_declarations_of_one_name_are_refused_at_the_second() {
    let names = ["Aa", "Bb", "Cc", "Dd", "Ee", "Ff", "Gg", "Hh"];
    let meanings = [
        "a length",
        "a parameter",
        "a coordinate or momentum",
        "a coordinate or momentum",
        "a velocity",
        "a function",
        "an abbreviation",
        "an abbreviation",
    ];
    let right = definition(names).replace("sum(i: a[i])", "sum(i in 0..Aa: a[i])");
    assert!(formula::read(Form::Hamiltonian, &right).0.graph.size() > 0);
    for second in 1..names.len() {
        for first in 0..second {
            let mut same = names;
            same[second] = same[first];
            let text = definition(same);
            let error = refused(&text);
            let expected = format!("`{}` is {} already", names[first], meanings[first]);
            assert!(error.contains(&expected), "{error}");
        }
    }
}

#[test]
fn a_local_name_that_is_declared_already_is_refused_at_the_local_name() {
    let declared = [
        (
            "S<Name> { m: [Name] } q: [2], p: [2];",
            "an index or a length",
        ),
        ("S { Name: 1 } q: [2], p: [2];", "a parameter"),
        ("S { Name: [2] } q: [2], p: [2];", "a parameter"),
        ("S q: [Name, y], p: [px, py];", "a coordinate or momentum"),
        ("S q: [x, y], p: [Name, py];", "a coordinate or momentum"),
        (
            "S q: [2], p: [2]; extern fn Name with slope, curvature;",
            "a function",
        ),
        ("S q: [2], p: [2]; let Name = 2;", "an abbreviation"),
        ("S q: [2], p: [2]; let Name(a, b) = a b;", "an abbreviation"),
    ];
    let locals = [
        "H = |p|^2 + sum(Name in 0..2: 1)",
        "H = |p|^2 + sum(i in 0..2: sum(Name in 0..i: 1))",
        "let own(Name) = Name^2; H = |p|^2 + own(2)",
        "H = |p|^2 constraints: { own(Name in 0..2) = q[Name] }",
        "H = |p|^2 constraints: { Name = q[0] }",
    ];
    for (declaration, meaning) in declared {
        for local in locals {
            let text = format!("{declaration} {local}");
            let error = refused(&text);
            let place = declaration.len() + local.find("Name").expect("a name") + 1;
            let expected = format!("`Name` is {meaning} already; choose another name");
            assert!(error.ends_with(&expected), "{error}");
            let carets = error.lines().last().expect("a line");
            assert_eq!(carets.find('^'), Some(place), "{error}");
        }
    }
}

/// The indices of pairs and the stretch of bonds need layouts of their own.
#[test]
fn the_other_local_names_are_refused_like_indices() {
    let water = "Water { springs: pairs, length: [springs] } q: [..; 3], p: [..; 3];
let s(i, j) = |q[i] - q[j]|^2;
H = sum(i: |p[i]|^2/2) + sum(s = (i, j) in springs: (|q[i] - q[j]| - length[s])^2/2)";
    expect![[r#"
        Water { springs: pairs, length: [springs] } q: [..; 3], p: [..; 3];
        let s(i, j) = |q[i] - q[j]|^2;
        H = sum(i: |p[i]|^2/2) + sum(s = (i, j) in springs: (|q[i] - q[j]| - length[s])^2/2)
                                     ^ `s` is an abbreviation already; choose another name"#]]
    .assert_eq(&last_line_under(water));
    for (sum, meaning) in [
        ("sum((a, j) in list: q[a])", "an abbreviation"),
        ("sum((i, a) in list: q[i])", "an abbreviation"),
        ("sum(a = (i, j) in list: q[i])", "an abbreviation"),
        ("sum(a < j: q[j])", "an abbreviation"),
        ("sum(i < a: q[i])", "an abbreviation"),
        ("sum(bonds a: a^2)", "an abbreviation"),
        ("sum(i < i: q[i])", "an index or a length"),
        ("sum(i: sum(i: q[i]))", "an index or a length"),
        ("b(2, 3)", "an argument"),
    ] {
        let text = format!(
            "S {{ list: pairs }} q: [..], p: [..]; bonds: free; let a(x) = x; let b(c, c) = c; H = sum(i: p[i]^2) + {sum}"
        );
        let error = refused(&text);
        assert!(
            error.contains(&format!("is {meaning} already; choose another")),
            "{error}"
        );
    }
    let momentum = refused("S q: [a], v: [va]; let f(pa) = pa^2; L = va^2/2 - f(a)");
    assert!(
        momentum.contains("`pa` is the name of a momentum already"),
        "{momentum}"
    );
}

/// The refusal with the carets under the line of the error.
fn last_line_under(text: &str) -> String {
    let error = refused(text);
    let (_, carets) = error.rsplit_once('\n').expect("a line");
    let (head, message) = carets.split_at(carets.find('^').expect("a caret"));
    let before: usize = text.rfind('\n').map_or(0, |place| place + 1);
    let before = text[..before].chars().count();
    let blank: String = head.chars().skip(before).collect();
    format!("{text}\n{blank}{message}")
}

#[test]
fn reserved_words_are_refused_as_names() {
    for word in [
        "t",
        "pi",
        "π",
        "H",
        "q",
        "p",
        "sum",
        "in",
        "let",
        "bonds",
        "extern",
        "fn",
        "invariants",
        "require",
        "sqrt",
        "sin",
        "atan2",
        "norm",
        "dot",
        "cross",
    ] {
        for text in [
            format!("S {{ {word}: 1 }} q: [x], p: [px]; H = px^2"),
            format!("S q: [{word}, y], p: [px, py]; H = px^2 + py^2"),
            format!("S q: [x, y], p: [{word}, py]; H = py^2"),
            format!("S q: [x], p: [px]; let {word} = 2; H = px^2"),
            format!("S q: [x], p: [px]; let f({word}) = 2; H = px^2"),
            format!("S q: [x], p: [px]; extern fn {word} with slope, curvature; H = px^2"),
            format!("S q: [2], p: [2]; H = |p|^2 + sum(i < {word}: 1)"),
            format!("S q: [x], p: [px]; H = px^2 constraints: {{ {word} = x }}"),
            format!("S q: [x], p: [px]; H = px^2 invariants: {{ {word} = px }}"),
        ] {
            let error = refused(&text);
            assert!(
                error.contains(&format!("`{word}` is ")) && error.contains(" already"),
                "{error}"
            );
        }
    }
}

#[test]
fn invariants_do_not_take_the_names_of_what_is_observed() {
    for (name, meaning) in [
        ("energy", "the value of H, which is observed"),
        ("x", "a coordinate or momentum"),
        ("px", "a coordinate or momentum"),
        ("new", "what makes a system"),
    ] {
        let error = refused(&format!(
            "S q: [x], p: [px]; H = px^2/2 invariants: {{ {name} = px }}"
        ));
        assert!(
            error.contains(&format!("`{name}` is {meaning} already")),
            "{error}"
        );
    }
}

#[test]
fn a_single_coordinate_can_have_its_letter() {
    let text = |text: &str| {
        let (read, structure) = formula::read(Form::of(text), text);
        description::text(&read, &structure)
    };
    expect![[r#"
        Oscillator

        Hamiltonian
          H = (1/2) p² + (1/2) q²

        equations of motion
          q' = p
          p' = −q

        second derivatives
          ∂²H/∂p∂p += 1
          ∂²H/∂q∂q += 1

        found in the formula
          separable, with the kinetic energy |p|²/2
          independent of time, so H is conserved
          a polynomial of degree 2 in positions and momenta
    "#]]
    .assert_eq(&text("Oscillator q: [q], p: [p]; H = p^2/2 + q^2/2"));
    let long = "P { c: 2 } q: [x], p: [px]; let f(a) = a^2; H = px^2/2 + f(x) - cos(x)
        constraints: { at = x^3 } force: { x = -c px } invariants: {}";
    let rest = "let f(a) = a^2; H = P^2/2 + f(Q) - cos(Q) constraints: { at = Q^3 } force: { Q = -c P } invariants: {}";
    for [q, p] in [["q", "p"], ["x", "p"], ["q", "px"]] {
        let own = rest.replace('Q', q).replace('P', p);
        let own = format!("P {{ c: 2 }} q: [{q}], p: [{p}]; {own}");
        assert_eq!(statements(&own), statements(long), "{own}");
    }
    let lagrangian = "P q: [x], v: [vx]; L = vx^2 - x^4";
    let own = "P q: [q], v: [v]; L = v^2 - q^4";
    assert_eq!(statements(own), statements(lagrangian));
    assert!(text(own).contains("H = (1/4) p² + q⁴"), "{}", text(own));
    // Of several coordinates none has the letter of all.
    for text in [
        "P q: [q, x], p: [pq, px]; H = pq^2",
        "P q: [x], p: [q]; H = q^2",
    ] {
        assert!(
            refused(text).contains("`q` is the positions already"),
            "{}",
            refused(text)
        );
    }
}

/// The code without its documentation and the names of the coordinates.
fn statements(text: &str) -> String {
    let code = code(text);
    let lines = code
        .lines()
        .skip_while(|line| !line.starts_with("impl") && !line.starts_with("const"));
    lines
        .filter(|line| !line.contains("///") && !line.contains("const NAMES"))
        .collect::<Vec<_>>()
        .join("\n")
}

#[test]
fn a_vector_of_one_component_is_read_as_a_number() {
    let written = "P { k: [1] } q: [1], p: [1]; H = p[0]^2/(2 k[0]) + k[0] q[0]^2/2 - cos(q[0]) + q[0] q[0]^3 + 2 q[0]";
    for h in [
        "p^2/(2 k) + k q^2/2 - cos(q) + q q^3 + 2 q",
        "|p|^2/(2 k) + k |q|^2/2 - cos(q) + q q^3 + 2 q[0]",
    ] {
        let text = format!("P {{ k: [1] }} q: [1], p: [1]; H = {h}");
        assert_eq!(statements(&text), statements(written), "{h}");
    }
    // Vectors they stay where vectors are meant.
    let bodies = "P<N> q: [N; 1], p: [N; 1]; H = sum(i: |p[i]|^2/2) + sum(i < j: |q[i] - 2 q[j]|^3 + q[i]^2 dot(q[i], q[j]))";
    assert!(formula::read(Form::Hamiltonian, bodies).1.split.is_ok());
    let two = refused("P q: [2], p: [2]; H = p^2/2");
    assert!(two.contains("the square of a vector is `|v|^2`"), "{two}");
}

#[test]
fn formulas_are_read_as_they_are_printed() {
    for [printed, written] in [
        ["px²/2 + x⁴", "px^2/2 + x^4"],
        ["px²/2 − |[x, 1]|³ x¹²", "px^2/2 - |[x, 1]|^3 x^12"],
        [
            "px² + (x² + 1)⁻² + 2 √(x² + 1) π",
            "px^2 + (x^2 + 1)^-2 + 2 sqrt(x^2 + 1) pi",
        ],
        ["px²x⁰ + cos(x)² m[1]²", "px^2 x^0 + cos(x)^2 m[1]^2"],
    ] {
        let text = |h: &str| code(&format!("P {{ m: [2] }} q: [x], p: [px]; H = {h}"));
        assert_eq!(text(printed), text(written), "{printed}");
    }
    for text in [
        "P { g: 9.81 } q: [a, b], p: [pa, pb];
         H = (pa^2 + 2 pb^2 - 2 pa pb cos(a - b))/(2 (1 + sin(a - b)^2)) - g (2 cos(a) + cos(b)) + 3/(1 + a^2)^2",
        "P q: [x], p: [px]; H = sqrt(1 + px^2) - pi/sqrt(1 + x^2) + (1 + x^2)^(3/2)/3 + exp(-x)/2 + x/(3 (2 + x^4))",
        "P { m: [3], A: [2, 2] } q: [3], p: [3]; H = |p|^2/(2 m[1]) + A[0, 1] q[2]^5 - atan2(q[0], q[1]) t",
    ] {
        let (first, _) = formula::read(Form::Hamiltonian, text);
        let printed = first.formula(first.energy, Notation::Text);
        let head = text.split_once("H = ").expect("H").0;
        let (again, _) = formula::read(Form::Hamiltonian, &format!("{head} H = {printed}"));
        assert_eq!(again.formula(again.energy, Notation::Text), printed);
    }
    for (h, expected) in [
        ("px^2 + cos²(x)", "the square is `cos(x)^2`"),
        ("px²^3", "`(x²)^3`"),
        ("px^2 + √x²", "`√(x²)` or `(√x)²`"),
        ("px^2 + x⁻", "a whole number as a raised power"),
        ("px^2 + ²", "a number, a name, `(` or `|`"),
    ] {
        let error = refused(&format!("P q: [x], p: [px]; H = {h}"));
        assert!(error.contains(expected), "{error}");
    }
}

/// The length of the coordinates, and ranges in the notation of other languages.
#[test]
fn errors_about_lengths_and_ranges_show_the_right_notation() {
    let named = "P<N> q: [N], p: [N]; H = sum(i: p[i]^2/2) + sum(i < j: cos(q[i] - q[j]))/(2 N)";
    let counted = named.replace("(2 N)", "(2 sum(i: 1))");
    assert_eq!(code(named), code(&counted));
    let own = |text: &str| {
        last_line_under(text)
            .lines()
            .last()
            .expect("a line")
            .trim()
            .to_owned()
    };
    expect![[r#"
        ^ unknown name `N`; known here: p, pi, q, t; for the length of `q`: `sum(i: …)` goes over all coordinates, `sum(i: 1)` is their number, and `P<N>` with `q: [N]` names it
        ^ unknown name `N`; known here: p, pi, q, t; for the length of `q`: `sum(i: …)` goes over all coordinates, `sum(i: 1)` is their number, and `P<N>` with `q: [N]` names it
        ^ unknown length `N`; known here: none; write `P<N>`, or `..` for a length that is known at run time only
        ^ unknown length `N`; known here: none; write `P<N>`, or `..` for a length that is known at run time only
        ^ unknown length `N`; known here: none; write `P<N>`, or `..` for a length that is known at run time only
        ^ found `1`, expected `in` for a range without its end, `sum(i in 0..N: …)`, or pairs, `sum(i = (i, j) in pairs: …)`
        ^ found `=`, expected the index after the last: `0..3` is 0, 1, 2"#]]
    .assert_eq(
        &[
            "P q: [..; 3], p: [..; 3]; H = sum(i: |p[i]|^2)/N",
            "P q: [..; 3], p: [..; 3]; H = sum(i in 0..N: |p[i]|^2)",
            "P q: [N; 3], p: [N; 3]; H = sum(i: |p[i]|^2)",
            "P q: [N], p: [N]; H = sum(i: p[i]^2)",
            "P { m: [N] } q: [..; 3], p: [..; 3]; H = sum(i: |p[i]|^2)",
            "P q: [..], p: [..]; H = sum(i = 1..3: p[i]^2)",
            "P q: [..], p: [..]; H = sum(i in 1..=3: p[i]^2)",
        ]
        .map(own)
        .join("\n"),
    );
}

#[test]
fn a_definition_without_a_name_is_the_same_system() {
    for (named, nameless) in [
        (
            "Kepler q: [2], p: [2]; H = |p|^2/2 - 1/|q|",
            "q: [2], p: [2]; H = |p|^2/2 - 1/|q|",
        ),
        (
            "P { g: 2 } q: [a], v: [va]; L = va^2/2 + g cos(a)",
            "{ g: 2 } q: [a], v: [va]; L = va^2/2 + g cos(a)",
        ),
        (
            "S let k = 2; q: [x], p: [px]; H = px^2/2 + k x^2",
            "let k = 2; q: [x], p: [px]; H = px^2/2 + k x^2",
        ),
    ] {
        let equations = |text: &str| {
            let (read, _) = formula::read(Form::of(text), text);
            (read.name.clone(), read.equations_of_motion(Notation::Text))
        };
        let (name, expected) = equations(named);
        assert_ne!(name, "System");
        assert_eq!(equations(nameless), ("System".to_owned(), expected));
    }
    // A name that is misspelt is not passed over.
    assert!(refused("Kepler: q: [2], p: [2]; H = |p|^2/2").contains("found `:`"));
}
