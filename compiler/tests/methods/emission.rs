//! The generated code: readable, and without anything that the tableau does not need.

use expect_test::expect_file;
use proc_macro2::{Ident, Span};
use quote::quote;
use symplectic_compiler::emit::{Header, method};
use symplectic_compiler::{Definition, Limits, Tableau, catalogue, derive};

fn emitted(tableau: &Tableau, name: &str) -> String {
    let header = Header {
        attributes: quote!(#[doc = " Documentation of the user."]),
        visibility: quote!(pub),
        name: Ident::new(name, Span::call_site()),
    };
    let code = method(tableau, &header).expect("finite coefficients");
    prettyplease::unparse(&syn::parse2(code).expect("the generated code parses"))
}

fn derived(basis: &str, nodes: &str) -> Tableau {
    derive(basis, nodes).expect("derived")
}

#[test]
fn an_explicit_method_is_straight_line_code() {
    let code = emitted(&derived("polynomial(2)", "lobatto(2)"), "StoermerVerlet");
    expect_file!["emitted/stoermer_verlet.rs"].assert_eq(&code);
}

/// The force of the end is carried to the next step. The gradient kick is twice the weight, exactly.
#[test]
fn gradient_kicks_are_straight_line_code() {
    let chin = catalogue::find("chin-1997-c").expect("known").derive();
    let code = emitted(&chin.expect("derived"), "Chin");
    expect_file!["emitted/chin.rs"].assert_eq(&code);
}

#[test]
fn lobatto_3_is_emitted_with_explicit_end_stages() {
    let code = emitted(&derived("polynomial(3)", "lobatto(3)"), "Lobatto3");
    expect_file!["emitted/lobatto_3.rs"].assert_eq(&code);
}

/// Neither the sums nor the matrices, though both classes of systems and both halves of the tableau need them.
#[test]
fn one_matrix_is_written_once() {
    let code = emitted(&derived("polynomial(2)", "gauss(2)"), "Gauss2");
    expect_file!["emitted/gauss_2.rs"].assert_eq(&code);
    // Short enough to read.
    assert!(code.lines().count() <= 300);
}

/// Three kicks and drifts a step after the merging, and a force that is carried to the next.
#[test]
fn a_splitting_is_straight_line_code() {
    let ruth = catalogue::find("forest-ruth-1990").expect("known");
    let tableau = ruth.derive().expect("derived");
    let code = emitted(&tableau, "ForestRuth");
    let separable = code.split("struct ForestRuthSeparable").nth(1);
    let separable = separable.expect("the plan");
    assert!(code.contains("Separable = emitted::Splitting<ForestRuthSeparable>"));
    assert!(separable.contains("step.kept_force(1, "), "{separable}");
    // The last momentum stage has no drift after it, and no velocity is evaluated there.
    let calls = ["step.kick(", "step.drift("].map(|call| separable.matches(call).count());
    assert_eq!(calls, [4, 3]);
    expect_file!["emitted/forest_ruth.rs"].assert_eq(&code);
}

/// One plan for both classes, however many steps there are.
#[test]
fn a_composition_of_implicit_methods_is_a_list_of_steps() {
    let definition = Definition::parse("base: gauss-2, weights: triple_jump(6)");
    let tableau = definition.and_then(|definition| definition.derive(&Limits::default()));
    let code = emitted(&tableau.expect("derived"), "Jump");
    assert_eq!(code.matches("emitted::StagePlan for").count(), 1);
    let memory = "type Stages<V: emitted::Vector> = emitted::Stages<V, 2, 2>;";
    assert_eq!(code.matches(memory).count(), 1);
    assert_eq!(code.matches("emitted::Substep {").count(), 3);
    // The sizes of the first and the last step are equal, and so are those of the last and the next first one.
    assert_eq!(code.matches("WarmStart::new(true, true)").count(), 1);
    for class in ["General", "Separable"] {
        let plan = format!("type {class} = emitted::Composition<JumpPlan<emitted::{class}>>");
        assert!(code.contains(&plan), "{class}");
    }
    // Explicit for separable systems: one splitting there.
    let definition = Definition::parse("base: velocity-verlet, weights: triple_jump(4)");
    let tableau = definition.and_then(|definition| definition.derive(&Limits::default()));
    let code = emitted(&tableau.expect("derived"), "Jump");
    assert!(!code.contains("Substep"));
}

/// The numbers that the plans multiply by: all coefficients in them but the times.
fn factors(code: &str) -> Vec<f64> {
    let plans = code.split_once("pub struct").expect("a method").1;
    let plans = plans.split_once("pub struct").expect("plans").1;
    let plans = plans.replace([' ', '\n'], "");
    // Lists of times, each of which another list follows.
    let is_times = |part: &&str| ["C:", "C_TILDE:"].iter().any(|name| part.starts_with(name));
    let (times, rest): (Vec<&str>, Vec<&str>) = plans.split("const").partition(is_times);
    assert!(times.iter().all(|list| !list.contains("fn")), "{times:?}");
    let mut factors = Vec::new();
    for statement in rest.iter().flat_map(|part| part.split(';')) {
        let mut numbers = coefficients(statement);
        if statement.contains("step.drift(") || statement.contains("step.kept_drift(") {
            // Its time and its weight.
            numbers.drain(..1);
        }
        let only_times = statement.contains("force(") || statement.contains("step.at(");
        if !only_times {
            factors.extend(numbers);
        }
    }
    factors
}

/// The coefficients in a piece of code, except the starts of substeps.
fn coefficients(code: &str) -> Vec<f64> {
    let parts: Vec<&str> = code.split("emitted::").collect();
    let calls = ["exact(", "rounded(", "Coefficient::new("];
    let number = |pair: &[&str]| {
        let start = pair[0].ends_with("start:");
        let list = calls.iter().find_map(|call| pair[1].strip_prefix(call));
        let list = list.filter(|_| !start)?.trim_start_matches('(');
        let double = list.split([',', ')']).next().expect("a double");
        Some(double.parse().expect("a number"))
    };
    parts.windows(2).filter_map(number).collect()
}

#[test]
#[ignore = "thorough"]
fn nothing_is_multiplied_by_zero_or_computed_twice() {
    // As many stages as the macros take.
    let usual = |entry: &catalogue::Entry| entry.stages <= Limits::default().stages;
    for entry in catalogue::entries().filter(usual) {
        let tableau = entry.derive().expect("derived");
        let code = emitted(&tableau, "Method");
        let factors = factors(&code);
        assert!(!factors.is_empty());
        assert!(factors.iter().all(|&c| c != 0.0), "{}", entry.name);
        // Where all is explicit there is nothing to sweep over in the plan for separable systems.
        let plan = |name: &str| code.split_once(name).map(|parts| parts.1);
        let separable = plan("struct MethodSeparable").or_else(|| plan("struct MethodPlan"));
        assert_eq!(
            tableau.properties().explicit.holds,
            !separable.expect("the plan").contains("emitted::StageSums"),
            "{}",
            entry.name
        );
    }
}

/// Three steps of Störmer–Verlet: where one ends and the next begins, a force is evaluated once.
#[test]
fn a_composition_of_explicit_methods_is_explicit() {
    let verlet = "basis: polynomial(2), nodes: lobatto(2)";
    let (outer, inner) = ("1/(2 - cbrt(2))", "-cbrt(2)/(2 - cbrt(2))");
    let text = format!("compose: [[{outer}, {verlet}], [{inner}, {verlet}], [{outer}, {verlet}]]");
    let definition = Definition::parse(&text).expect("a definition");
    let jump = definition.derive(&Limits::default()).expect("derived");
    assert_eq!(jump.stages(), 6);
    let code = emitted(&jump, "TripleJump");
    let separable = code.split("struct TripleJumpSeparable").nth(1);
    let separable = separable.expect("the plan");
    // Four positions with a force, the last of which is the first of the next step, and three momenta.
    assert!(code.contains("Separable = emitted::Splitting<TripleJumpSeparable>"));
    assert!(separable.contains("step.kept_force(1, "), "{separable}");
    assert!(!separable.contains("emitted::StageSums") && !separable.contains("combine"));
    assert_eq!(separable.matches("force(").count(), 4);
    // Each of them is applied once, with the sum of the weights where two steps meet.
    let calls = ["step.kick(", "step.drift("].map(|call| separable.matches(call).count());
    assert_eq!(calls, [4, 3]);
    assert!(factors(&code).iter().all(|&c| c != 0.0));
}

/// The code that the book shows occurs as it stands in what is written.
#[test]
fn the_book_shows_what_is_written() {
    let ruth = catalogue::find("forest-ruth-1990").expect("known");
    let ruth = emitted(&ruth.derive().expect("derived"), "ForestRuth");
    let gauss = emitted(&derived("polynomial(2)", "gauss(2)"), "Gauss2");
    let trimmed = |text: &str| -> String {
        let lines = text.lines().map(|line| format!("{}\n", line.trim()));
        lines.collect()
    };
    let book = include_str!("../../../docs/src/guide/methods.md");
    let section = book.split("## What the macro writes").nth(1);
    let section = section.and_then(|rest| rest.split("\n## ").next());
    let blocks = section
        .expect("the section")
        .split("```")
        .skip(1)
        .step_by(2);
    let blocks: Vec<&str> = blocks.collect();
    assert_eq!(blocks.len(), 2);
    for (block, code) in blocks.iter().zip([ruth, gauss]) {
        let shown = block.strip_prefix("rust,ignore\n").expect("Rust");
        assert!(trimmed(&code).contains(&trimmed(shown)), "{shown}");
    }
}

/// Stages with equal times c but different times c̃: velocities can be extrapolated, forces cannot. A separable system needs velocities only.
#[test]
fn separable_systems_keep_an_extrapolation_that_others_lack() {
    let text = "a: [[1/12, 1/4], [1/3, 0]], b: [1/2, 1/2], a_tilde: symplectic_partner";
    let definition = Definition::parse(text).expect("a definition");
    let code = emitted(
        &definition.derive(&Limits::default()).expect("derived"),
        "OneTime",
    );
    let (general, separable) = code
        .split_once("struct OneTimeSeparable")
        .expect("a plan for each class");
    let counts = [general, separable].map(|plan| plan.matches("emitted::transform(").count());
    assert_eq!(counts, [0, 1]);
    // Without extrapolation every step begins with a velocity.
    assert!(general.contains("begin: 1,") && general.contains("start: 0,"));
    assert!(separable.contains("begin: 0,") && separable.contains("start: 1,"));
}

#[test]
fn the_name_of_the_imported_module_is_refused() {
    let header = Header {
        attributes: quote!(),
        visibility: quote!(),
        name: Ident::new("emitted", Span::call_site()),
    };
    let refused = method(&derived("1", "1/2"), &header).expect_err("taken");
    assert_eq!(
        refused.to_string(),
        "`emitted` is the module that generated code imports already; choose another name"
    );
}
