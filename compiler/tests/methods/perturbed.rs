//! Orders for perturbed systems H = H_A + εH_B: of splittings, with drifts for H_A and kicks for εH_B.

use num_rational::BigRational;
use num_traits::{One, Zero};
use proptest::prelude::*;
use symplectic_compiler::arithmetic::interval::Interval;
use symplectic_compiler::certify::Claim;
use symplectic_compiler::export::{json, toml};
use symplectic_compiler::order::PerturbedOrder;
use symplectic_compiler::{Definition, Evidence, Limits, Requirement, Tableau, catalogue, check};

fn define(text: &str) -> Tableau {
    let definition = Definition::parse(text).expect(text);
    definition.derive(&Limits::default()).expect(text)
}

fn known(name: &str) -> Tableau {
    catalogue::find(name).expect(name).derive().expect(name)
}

fn found(tableau: &Tableau) -> PerturbedOrder {
    tableau.perturbed_order().expect("a splitting")
}

/// The order, which is proved and sharp.
fn proved(tableau: &Tableau) -> Vec<usize> {
    let found = found(tableau);
    for power in &found.powers {
        assert_eq!(power.evidence, Evidence::Proved);
        assert!(power.refuted_by.is_some(), "{found}");
    }
    found.orders()
}

fn required(tableau: &Tableau, text: &str) -> Result<(), String> {
    let requirement = Requirement::parse(text).expect(text);
    let decided = tableau.require(&requirement, None);
    decided.map_err(|kind| kind.to_string())
}

/// Laskar & Robutel 2001, §4: the remainders are O(ε h^{2n} + ε² h²).
#[test]
fn the_methods_of_laskar_and_robutel_have_their_orders() {
    for n in 1..=4 {
        for family in ["saba", "sbab"] {
            let name = format!("{family}-{n}");
            assert_eq!(proved(&known(&name)), [2 * n, 2], "{name}");
        }
    }
}

#[test]
fn other_methods_have_the_order_for_separable_systems() {
    for (name, orders) in [
        ("symplectic-euler", [1, 1]),
        ("stormer-verlet", [2, 2]),
        ("position-verlet", [2, 2]),
        ("ruth-1983", [3, 3]),
        ("forest-ruth-1990", [4, 4]),
        ("mclachlan-1995-s5", [4, 4]),
        ("suzuki-1990", [4, 4]),
        ("suzuki-6", [6, 6]),
    ] {
        assert_eq!(proved(&known(name)), orders, "{name}");
    }
    for name in ["gauss-2", "lobatto-3", "midpoint"] {
        assert_eq!(known(name).perturbed_order(), None, "{name}");
    }
    // Explicit, and no splitting.
    let heun = define("a: [[0, 0], [1, 0]], b: [1/2, 1/2]");
    assert!(heun.properties().explicit.holds);
    assert_eq!(heun.perturbed_order(), None);
    let verlet = found(&known("stormer-verlet")).to_string();
    assert_eq!(
        verlet,
        "(2, 2), proved; not 3 in ε: A^2B has the coefficient 1/4 instead of 1/6, a difference of 1/12"
    );
    // SABA of two kicks, whose error in ε is that of Gauss.
    let saba = found(&known("saba-2")).to_string();
    assert!(
        saba.starts_with(
            "(4, 2), proved; not 5 in ε: A^4B has the coefficient 7/864 instead of 1/120, a difference of -1/4320; \
             not 3 in ε²: AB^2 has"
        ),
        "{saba}"
    );
}

/// The degree up to which the kicks at their times integrate exactly, as far as enclosures tell, plus 1.
fn degree_and_one(tableau: &Tableau) -> usize {
    const BITS: u32 = 400;
    let numbers = tableau.numbers();
    let kicks = numbers.b_tilde.iter().zip(&numbers.c);
    let kicks: Vec<[Interval; 2]> = kicks
        .map(|(weight, time)| [weight.enclose(BITS), time.enclose(BITS)])
        .collect();
    let exact = |n: &usize| {
        let zero = Interval::enclosing(&BigRational::zero(), BITS);
        let term = |[weight, time]: &[Interval; 2]| {
            (0..*n).fold(weight.clone(), |term, _| term.multiply(time))
        };
        let sum = kicks.iter().fold(zero, |sum, kick| sum.add(&term(kick)));
        sum.contains(&BigRational::new(One::one(), (*n + 1).into()))
    };
    (0..).take_while(exact).count()
}

/// Two other ways: the first number is that of a quadrature, and the last is what trees say of separable systems.
#[test]
#[ignore = "thorough"]
fn the_ends_agree_with_quadrature_and_trees() {
    let mut count = 0;
    let splitting = |entry: &catalogue::Entry| {
        // The others are no splittings, or their trees take long.
        let parts = [
            "kick",
            "base: stormer",
            "base: velocity",
            "gauss(1)",
            "(2), nodes: lobatto(2)",
        ];
        entry.stages <= 30 && parts.iter().any(|part| entry.definition.contains(part))
    };
    for entry in catalogue::entries().filter(splitting) {
        let tableau = entry.derive().expect("derived");
        let Some(found) = tableau.perturbed_order() else {
            let explicit = tableau.properties().explicit.holds;
            assert!(!explicit || tableau.has_gradient_kicks(), "{}", entry.name);
            continue;
        };
        let orders = found.orders();
        assert_eq!(orders[0], degree_and_one(&tableau), "{}", entry.name);
        let separable = tableau.orders().separable;
        // Trees are not enumerated as far as words.
        let last = orders[orders.len() - 1];
        let agrees = match separable.refuted_by {
            Some(_) => separable.order == last,
            None => separable.order <= last,
        };
        assert!(agrees, "{}: {orders:?} and {}", entry.name, separable.order);
        assert!(orders.is_sorted_by(|one, next| one >= next));
        count += 1;
    }
    assert!(count >= 25, "{count}");
}

/// Terms with one or two kicks do not vanish for quadratic `T`, so that the certificate of a method for these is one for `ε` and `ε²`; of
/// the others, those of fourth order are certified only because the method is symmetric.
#[test]
fn methods_for_quadratic_kinetic_energies_are_certified_in_each_power() {
    let powers = found(&known("blanes-moan-2002-srkn11b")).powers;
    let orders: Vec<_> = powers.iter().map(|p| (p.order, p.evidence)).collect();
    let certified = |order| (order, Evidence::Certified);
    assert_eq!(orders, [certified(6), certified(6), certified(4)]);
    let claim = Claim::Nystrom(6);
    assert_eq!(
        [1, 2, 3, 9].map(|power| claim.order_in_power(power)),
        [6, 6, 3, 3]
    );
}

#[test]
fn perturbed_coefficients_lose_the_order() {
    let simpson = "kick: [1/6, 2/3], drift: [1/2], symmetric: true";
    assert_eq!(proved(&define(simpson)), [4, 2]);
    // Kicks that sum to 1 and are symmetric no longer make Simpson's rule.
    let moved = "kick: [1/6 + 1e-18, 2/3 - 2e-18], drift: [1/2], symmetric: true";
    assert_eq!(proved(&define(moved)), [2, 2]);
    let skew = "kick: [1/6 + 1e-18, 2/3 - 1e-18, 1/6], drift: [1/2, 1/2, 0]";
    assert_eq!(proved(&define(skew)), [1, 1]);
    // With H_A for the kicks the error in ε is that of two drifts.
    assert_eq!(
        proved(&define(&format!("{simpson}, exchange: true"))),
        [2, 2]
    );
    assert_eq!(
        proved(&define(&format!("{simpson}, adjoint: true"))),
        [4, 2]
    );
    // A method for quadratic T or not, the words are those of separable systems.
    let saba = "kick: [1/2], drift: [1/2 - sqrt(3)/6, sqrt(3)/3], first: drift, symmetric: true";
    assert_eq!(proved(&define(saba)), [4, 2]);
    let other = saba.replace(
        "sqrt(3)/6, sqrt(3)/3",
        "sqrt(3)/6 + 1e-18, sqrt(3)/3 - 2e-18",
    );
    assert_eq!(proved(&define(&other)), [2, 2]);
    // Weights that do not sum to 1 have no order at all.
    let half = define("a: [[0]], b: [1/2], a_tilde: [[1]], b_tilde: [1]");
    assert_eq!(proved(&half), [0, 0]);
}

/// Blanes, Casas, Farrés, Laskar, Makazaga & Murua 2013, `ABA(10,6,4)`.
const BLANES: &str = "drift: [0.03809449742241219545697532230863756534060, 0.1452987161169137492940200726606637497442, \
    0.2076276957255412507162056113249882065158, 0.4359097036515261592231548624010651844006, \
    -0.6538612258327867093807117373907094120024, 0.4359097036515261592231548624010651844006, \
    0.2076276957255412507162056113249882065158, 0.1452987161169137492940200726606637497442, \
    0.03809449742241219545697532230863756534060], \
    kick: [0, 0.09585888083707521061077150377145884776921, 0.2044461531429987806805077839164344779763, \
    0.2170703479789911017143385924306336714532, -0.01737538195906509300561788011852699719871, \
    -0.01737538195906509300561788011852699719871, 0.2170703479789911017143385924306336714532, \
    0.2044461531429987806805077839164344779763, 0.09585888083707521061077150377145884776921], \
    claim: perturbed(10, 6, 4)";

#[test]
fn a_claimed_order_is_certified_and_the_rest_verified() {
    let evidence = |tableau: &Tableau| {
        let powers = found(tableau).powers.into_iter();
        let known = powers.map(|power| (power.order, power.evidence));
        known.collect::<Vec<_>>()
    };
    use Evidence::Certified;
    let verified = |found: &Evidence| matches!(found, Evidence::Verified { .. });
    let blanes = define(BLANES);
    let certified = [(10, Certified), (6, Certified), (4, Certified)];
    assert_eq!(evidence(&blanes), certified);
    assert_eq!(evidence(&blanes.adjoint()), certified);
    // The last number is an order for separable systems.
    let orders = blanes.orders();
    assert_eq!(
        (orders.separable.order, orders.separable.evidence),
        (4, Certified)
    );
    assert_eq!(required(&blanes, "order(perturbed) == (10, 6, 4)"), Ok(()));
    assert_eq!(required(&blanes, "order(perturbed) >= (8, 4)"), Ok(()));
    let less = define(&BLANES.replace("(10, 6, 4)", "(8, 6, 4)"));
    let found = evidence(&less);
    // There are more free coefficients then, and the order in ε is 8 only, or 10 without a proof.
    assert!(found[0].0 == 8 || verified(&found[0].1), "{found:?}");
    assert_eq!(found[1..], [(6, Certified), (4, Certified)]);
    assert_eq!(required(&less, "order(perturbed) >= (8, 6, 4)"), Ok(()));
    // Exchanged, the claim is about the other part.
    let exchanged = define(&format!("{BLANES}, exchange: true"));
    assert!(
        evidence(&exchanged)
            .iter()
            .all(|(_, found)| verified(found))
    );
    // A claim for separable systems is one for every power.
    let jump = define(
        "kick: [0.675603595979829, -0.175603595979829, -0.175603595979829, 0.675603595979829], \
         drift: [1.351207191959658, -1.702414383919315, 1.351207191959658, 0.0], claim: separable(4)",
    );
    assert_eq!(evidence(&jump), [(4, Certified), (4, Certified)]);
}

#[test]
fn a_failed_requirement_on_the_perturbed_order_names_the_word() {
    let saba = known("saba-3");
    for held in [
        "order(perturbed) == (6, 2)",
        "order(perturbed)>=(4,2)",
        "order(perturbed) >= 2",
        "order(perturbed) >= (6, 2, 1)",
    ] {
        assert_eq!(required(&saba, held), Ok(()), "{held}");
    }
    let refused = |text: &str| required(&saba, text).expect_err(text);
    let told = refused("order(perturbed) >= (6, 4)");
    assert!(
        told.starts_with(
            "the order for perturbed H is (6, 2), not (6, 4): AB^2 has the coefficient 1/4 - "
        ),
        "{told}"
    );
    let told = refused("order(perturbed) >= (8, 2)");
    assert!(
        told.contains("not (8, 2): A^6B has the coefficient 19/96000"),
        "{told}"
    );
    assert_eq!(
        refused("order(perturbed) == (4, 2)"),
        "the order for perturbed H is (6, 2), not (4, 2)"
    );
    assert!(refused("order(perturbed) >= 6").contains("not (6): AB^2"));
    let gauss = required(&known("gauss-2"), "order(perturbed) >= (2, 2)");
    assert_eq!(
        gauss.expect_err("no splitting"),
        "the method has no order for perturbed H: it is not a splitting"
    );
    // What is printed is read.
    for text in ["order(perturbed) >= (8, 4)", "order(perturbed) == (2, 2)"] {
        assert_eq!(Requirement::parse(text).expect(text).to_string(), text);
    }
}

#[test]
fn files_hold_the_order_and_are_checked() {
    let saba = known("saba-2");
    let limits = Limits::default();
    let written = toml::write(&saba, 20);
    let line = "perturbed = [{ order = 4, evidence = \"proved\", refuted_by = \"A^4B\", value = \"7/864\", \
                wanted = \"1/120\", residual = \"-1/4320\" }, { order = 2, ";
    assert!(written.contains(line), "{written}");
    assert_eq!(check("saba.toml", &written, &limits), Ok(saba.clone()));
    let edited = written.replace("[{ order = 4,", "[{ order = 6,");
    let told = check("saba.toml", &edited, &limits).expect_err("edited");
    assert!(
        told.to_string().contains("order.perturbed[0].order"),
        "{told}"
    );
    let written = json::write(&saba, 20);
    assert!(
        written.contains("\"perturbed\": [{\"order\": 4, "),
        "{written}"
    );
    assert_eq!(check("saba.json", &written, &limits), Ok(saba.clone()));
    let edited = written.replace(
        "\"perturbed\": [{\"order\": 4, ",
        "\"perturbed\": [{\"order\": 6, ",
    );
    assert!(check("saba.json", &edited, &limits).is_err());
    let gauss = json::write(&known("gauss-1"), 20);
    assert!(gauss.contains("\"perturbed\": null"), "{gauss}");
}

/// Weights with which `Σ_i w_i c_i^n = 1/(n + 1)` for as many `n` as there are nodes: Lagrange's, by elimination.
fn interpolatory(nodes: &[BigRational]) -> Vec<BigRational> {
    let n = nodes.len();
    let mut rows: Vec<Vec<BigRational>> = (0..n)
        .map(|power| {
            let mut row: Vec<BigRational> = nodes
                .iter()
                .map(|node| num_traits::pow(node.clone(), power))
                .collect();
            row.push(BigRational::new(One::one(), (power + 1).into()));
            row
        })
        .collect();
    for column in 0..n {
        let pivot = (column..n)
            .find(|&row| !rows[row][column].is_zero())
            .expect("distinct nodes");
        rows.swap(column, pivot);
        let leading = rows[column][column].clone();
        rows[column].iter_mut().for_each(|entry| *entry /= &leading);
        let done = rows[column].clone();
        for (index, row) in rows.iter_mut().enumerate() {
            let factor = row[column].clone();
            if index != column {
                row.iter_mut()
                    .zip(&done)
                    .for_each(|(entry, other)| *entry -= &factor * other);
            }
        }
    }
    rows.into_iter().filter_map(|mut row| row.pop()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// For kicks at any times, in any order, some of them moved: the first number is the degree of their quadrature
    /// plus 1, in exact arithmetic.
    #[test]
    fn the_first_number_is_that_of_the_quadrature(
        nodes in proptest::collection::btree_set(0i64..=12, 1..6),
        turn in 0usize..6,
        mirrored in proptest::bool::ANY,
        moved in proptest::bool::weighted(0.2),
    ) {
        let fraction = |&node: &i64| BigRational::new(node.into(), 12.into());
        let mut nodes: Vec<BigRational> = nodes.iter().map(fraction).collect();
        if mirrored {
            // Symmetric nodes gain a degree where they are odd in number.
            let others: Vec<BigRational> = nodes.iter().map(|node| BigRational::one() - node).collect();
            nodes.extend(others.into_iter().filter(|other| !nodes.contains(other)).collect::<Vec<_>>());
        }
        let turn = turn % nodes.len();
        nodes.rotate_left(turn);
        let mut kicks = interpolatory(&nodes);
        if moved && kicks.len() > 1 {
            let little = BigRational::new(One::one(), num_bigint::BigInt::from(10).pow(18));
            kicks[0] += &little;
            kicks[1] -= &little;
        }
        let degree = (0..).take_while(|&n| {
            let terms = kicks.iter().zip(&nodes);
            let sum: BigRational = terms.map(|(kick, node)| kick * num_traits::pow(node.clone(), n)).sum();
            sum == BigRational::new(One::one(), (n + 1).into())
        });
        let mut drifts = Vec::new();
        let mut time = BigRational::zero();
        for node in nodes.iter().chain([&BigRational::one()]) {
            drifts.push((node - &time).to_string());
            time = node.clone();
        }
        let mut texts: Vec<String> = kicks.iter().map(ToString::to_string).collect();
        texts.push("0".to_owned());
        let text = format!("kick: [{}], drift: [{}], first: drift", texts.join(", "), drifts.join(", "));
        prop_assert_eq!(proved(&define(&text))[0], degree.count());
    }
}
