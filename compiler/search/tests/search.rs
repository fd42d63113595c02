//! Searches whose results are known, and proofs of what they find.

use std::ops::ControlFlow;

use symplectic_compiler::catalogue;
use symplectic_compiler::certify::Claim;
use symplectic_compiler::order::HamiltonianClass;
use symplectic_search::{Method, Norm, Problem, Progress, Structure};

fn problem(claim: Claim, structure: Structure, kicks: usize) -> Problem {
    Problem {
        claim,
        structure,
        kicks,
        gradient: 0,
        norm: Norm::Error,
        largest: 1.0,
        dispersion: false,
        at_least_stable: 0.0,
    }
}

fn searched(problem: &Problem, starts: u64) -> Progress {
    let mut progress = Progress::new(1);
    let found = problem.search(&mut progress, starts, |_| ControlFlow::Continue(()));
    found.expect("an order that can be claimed");
    progress
}

fn best(problem: &Problem, starts: u64) -> Method {
    let progress = searched(problem, starts);
    let best = progress.solutions.first().expect("a solution");
    problem.prove(best).expect("a proof")
}

/// Without seeds, random starts find methods that are as efficient as those of the papers.
#[test]
fn random_starts_reach_the_efficiency_of_the_catalogue() {
    for (name, claim, structure, kicks, starts) in [
        (
            "mclachlan-1995-s2",
            Claim::Separable(2),
            Structure::Aba,
            2,
            64,
        ),
        (
            "mclachlan-1995-s4",
            Claim::Separable(4),
            Structure::Aba,
            4,
            256,
        ),
        (
            "mclachlan-1995-s5",
            Claim::Separable(4),
            Structure::Aba,
            5,
            256,
        ),
        (
            "ostmeyer-2022-order-4",
            Claim::Separable(4),
            Structure::Bab,
            5,
            256,
        ),
        (
            "blanes-moan-2002-s6",
            Claim::Separable(4),
            Structure::Bab,
            6,
            256,
        ),
        (
            "blanes-moan-2002-srkn6b",
            Claim::Nystrom(4),
            Structure::Bab,
            6,
            256,
        ),
        (
            "mclachlan-1995-ss5",
            Claim::SymmetricBase(4),
            Structure::Composition,
            5,
            512,
        ),
        (
            "mclachlan-1995-ss9",
            Claim::SymmetricBase(6),
            Structure::Composition,
            9,
            2048,
        ),
    ] {
        let problem = problem(claim, structure, kicks);
        let found = problem.efficiency(best(&problem, starts).error);
        let known = catalogue::find(name).expect("a name").derive().expect(name);
        let (class, _) = problem.compared_in();
        // For an error of 1 the evaluations are s C^(1/p).
        let known = known
            .evaluations_for(class, 1.0)
            .expect("an error constant");
        assert!(found < known * 1.0001, "{name}: {found} and {known}");
    }
}

#[test]
fn the_figure_of_a_solution_is_the_proved_error_constant() {
    for (claim, structure, kicks) in [
        (Claim::Separable(3), Structure::Plain, 3),
        (Claim::Separable(4), Structure::Aba, 4),
        (Claim::Nystrom(4), Structure::Bab, 5),
        (Claim::SymmetricBase(6), Structure::Composition, 7),
        (Claim::Nystrom(6), Structure::Aba, 7),
    ] {
        let problem = problem(claim, structure, kicks);
        let progress = searched(&problem, 1024);
        let solution = progress.solutions.first().expect("a solution");
        let method = problem.prove(solution).expect("a proof");
        // Short decimals for free parameters may raise the error by a thousandth.
        let ratio = method.error / solution.error;
        assert!((ratio - 1.0).abs() < 2e-3, "{problem:?}: {ratio}");
        if progress.free == Some(0) {
            assert!((ratio - 1.0).abs() < 1e-9, "{problem:?}: {ratio}");
        }
    }
}

#[test]
fn the_definition_of_a_found_method_has_the_digits_of_the_exact_one() {
    for (claim, structure, kicks) in [
        (Claim::Nystrom(6), Structure::Bab, 11),
        (Claim::Perturbed(vec![8, 4]), Structure::Aba, 5),
        (Claim::SymmetricBase(6), Structure::Composition, 9),
    ] {
        let problem = problem(claim.clone(), structure, kicks);
        let method = best(&problem, 512);
        assert!(
            method.tableau.wrong_digits().is_empty(),
            "{}",
            method.definition
        );
        let orders = method.tableau.orders();
        let (class, order) = problem.compared_in();
        assert_eq!(orders.class(class).order, order, "{}", method.definition);
        assert!(method.tableau.separable_properties().symmetric.holds);
        if let Claim::Perturbed(orders) = claim {
            let found = method.tableau.perturbed_order().expect("a splitting");
            assert_eq!(found.orders(), orders);
        }
    }
}

#[test]
fn a_search_in_parts_and_on_one_thread_finds_the_same() {
    let problem = problem(Claim::Separable(4), Structure::Bab, 5);
    let whole = searched(&problem, 256);
    let mut parts = Progress::new(1);
    for starts in [64, 192, 256] {
        let found = problem.search(&mut parts, starts, |_| ControlFlow::Continue(()));
        found.expect("an order that can be claimed");
    }
    assert_eq!(parts, whole);
    let one = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread");
    assert_eq!(one.install(|| searched(&problem, 256)), whole);
}

#[test]
fn too_few_kicks_have_no_solution_and_as_many_as_conditions_isolated_ones() {
    let few = searched(&problem(Claim::Separable(6), Structure::Aba, 6), 256);
    assert!(few.solutions.is_empty() && few.conditions > few.unknowns);
    // Forest & Ruth 1990 is the only method of order 4 with three kicks.
    let isolated = searched(&problem(Claim::Separable(4), Structure::Aba, 3), 256);
    assert_eq!((isolated.free, isolated.solutions.len()), (Some(0), 1));
    let forest_ruth = 1.0 / (2.0 - 2f64.cbrt());
    assert!((isolated.solutions[0].unknowns[1] - forest_ruth).abs() < 1e-12);
}

/// A change of variables does not alter the frequency of an oscillator: the figure modulo conjugation is at most the error constant, and
/// methods with its least value differ from those with the least error.
#[test]
fn the_error_modulo_conjugation_is_at_most_the_error() {
    let with = |norm| Problem {
        norm,
        ..problem(Claim::Separable(4), Structure::Bab, 6)
    };
    let [plain, conjugate, long] = [Norm::Error, Norm::ModuloConjugation, Norm::LongRuns]
        .map(|norm| searched(&with(norm), 128));
    let least = |progress: &Progress| progress.solutions[0].error;
    assert!(least(&conjugate) < least(&long) && least(&long) < least(&plain));
}

#[test]
fn methods_with_dispersion_of_higher_order_turn_an_oscillator_with_it() {
    let problem = Problem {
        dispersion: true,
        ..problem(Claim::Nystrom(4), Structure::Bab, 5)
    };
    let method = best(&problem, 256);
    assert_eq!(
        method
            .tableau
            .orders()
            .class(HamiltonianClass::Nystrom)
            .order,
        4
    );
    let numbers = method.tableau.to_f64();
    // The error of the angle after a step of h.
    let error = |h: f64| {
        let (mut a, mut b, mut c, mut d) = (1.0, 0.0, 0.0, 1.0);
        for (kick, drift) in numbers.b_tilde.iter().zip(&numbers.b) {
            (c, d) = (c - kick * h * a, d - kick * h * b);
            (a, b) = (a + drift * h * c, b + drift * h * d);
        }
        (0.5 * (a + d)).acos() - h
    };
    let slope = (error(0.8) / error(0.4)).log2();
    assert!((slope - 7.0).abs() < 0.3, "{slope}");
}
