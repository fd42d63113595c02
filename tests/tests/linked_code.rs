//! What a scene does not need stays out of its program: a separable scene with an explicit method contains no solver, and one without
//! constraints and friction nothing of these.

use std::collections::BTreeSet;
use std::error::Error;

use object::{Object, ObjectSymbol};
use rustc_demangle::demangle;

/// The modules of the library with what only implicit methods need.
const SOLVERS: [&str; 4] = [
    "symplectic_core::contract::change::",
    "symplectic_core::method::coupled::",
    "symplectic_core::solver::",
    "symplectic_newton::",
];

/// The modules with what only constraints, friction and Lagrangians need.
const MECHANICS: [&str; 4] = [
    "symplectic_mechanics::constraints::holonomic::",
    "symplectic_mechanics::constraints::nonholonomic::",
    "symplectic_flows::friction::",
    "symplectic_mechanics::",
];

/// The names of the functions in a program, without their hashes.
fn functions(program: &str) -> Result<BTreeSet<String>, Box<dyn Error>> {
    let data = std::fs::read(program)?;
    let file = object::File::parse(&*data)?;
    let names = file
        .symbols()
        .filter_map(|symbol| Some(format!("{:#}", demangle(symbol.name().ok()?))));
    Ok(names.collect())
}

/// Whether the name is that of a function of the module, or of an implementation for one of its types.
fn is_of(name: &str, module: &str) -> bool {
    name.trim_start_matches('<').starts_with(module)
}

#[test]
fn an_explicit_scene_links_no_solver() -> Result<(), Box<dyn Error>> {
    let explicit = functions(env!("CARGO_BIN_EXE_explicit_scene"))?;
    let implicit = functions(env!("CARGO_BIN_EXE_implicit_scene"))?;
    let of = |names: &BTreeSet<String>, module: &str| -> Vec<String> {
        names
            .iter()
            .filter(|name| is_of(name, module))
            .cloned()
            .collect()
    };
    for module in SOLVERS {
        assert_eq!(of(&explicit, module), Vec::<String>::new(), "{module}");
    }
    // The same searches find the solver where it is, and the drifts and kicks where those are.
    for module in [
        "symplectic_core::method::coupled::",
        "symplectic_core::solver::nystrom::",
    ] {
        assert!(!of(&implicit, module).is_empty(), "{module}");
    }
    let splitting = "symplectic_core::method::splitting::";
    assert!(!of(&explicit, splitting).is_empty() && of(&implicit, splitting).is_empty());
    // The one that the types choose brings neither Newton's iteration nor that of other scalars.
    for module in [
        "symplectic_newton::",
        "symplectic_core::solver::fixed_point::",
    ] {
        assert_eq!(of(&implicit, module), Vec::<String>::new(), "{module}");
    }
    // And all in all there is less.
    let library = |names: &BTreeSet<String>| {
        names
            .iter()
            .filter(|name| name.contains("symplectic"))
            .count()
    };
    assert!(library(&explicit) < library(&implicit));
    Ok(())
}

/// Of a formula, too, a program contains what it asks for: no energy, second derivatives or solver beside an explicit method.
#[test]
fn an_explicit_formula_has_only_its_velocity_and_force_in_it() -> Result<(), Box<dyn Error>> {
    let explicit = functions(env!("CARGO_BIN_EXE_explicit_formula"))?;
    let newton = functions(env!("CARGO_BIN_EXE_newton_formula"))?;
    let has = |names: &BTreeSet<String>, part: &str| names.iter().any(|name| name.contains(part));
    for module in SOLVERS {
        assert!(!has(&explicit, module), "{module}");
    }
    // In the other program the same search finds all of them.
    assert!(has(&newton, "symplectic_newton::"));
    for function in ["energy", "second_derivatives", "half_bandwidth"] {
        let of_formula = |name: &String| {
            name.contains("HenonHeiles") && name.contains(&format!(">::{function}"))
        };
        assert!(!explicit.iter().any(of_formula), "{function}");
        assert!(newton.iter().any(of_formula), "{function}");
    }
    Ok(())
}

/// No force and no constraint: no code for them.
#[test]
fn a_scene_without_constraints_links_no_code_for_them() -> Result<(), Box<dyn Error>> {
    for program in [
        env!("CARGO_BIN_EXE_explicit_scene"),
        env!("CARGO_BIN_EXE_implicit_scene"),
        env!("CARGO_BIN_EXE_explicit_formula"),
        env!("CARGO_BIN_EXE_newton_formula"),
    ] {
        let names = functions(program)?;
        for module in MECHANICS {
            let found: Vec<&String> = names.iter().filter(|name| name.contains(module)).collect();
            assert!(found.is_empty(), "{program}: {found:?}");
        }
    }
    // The same search finds each of them where it is.
    let names = functions(env!("CARGO_BIN_EXE_mechanics_scenes"))?;
    for module in MECHANICS {
        assert!(names.iter().any(|name| is_of(name, module)), "{module}");
    }
    Ok(())
}
