//! Every splitting and composition of the catalogue in use: how often a step evaluates, and that it is of its order.

use symplectic::solver::Coefficient;
use symplectic::{Error, Integrator, Method};
use symplectic_compiler::catalogue;
use symplectic_tests::counting::{Counting, Counts};
use symplectic_tests::scenes::kepler;

const STEPS: u64 = 20;

/// Evaluations of force and velocity in [`STEPS`] steps of Kepler's problem, and sweeps of an iteration.
fn evaluations<M: Method + Copy>(method: M) -> Result<[u64; 3], Error> {
    let counts = Counts::default();
    let system = Counting::new(kepler::Kepler, &counts);
    let mut integrator = Integrator::new(method, system, kepler::start::<f64>(0.2), 0.01)?;
    // Checks of the system are not of the steps.
    let (forces, velocities) = (counts.forces(), counts.velocities());
    for _ in 0..STEPS {
        integrator.step()?;
    }
    Ok([
        counts.forces() - forces,
        counts.velocities() - velocities,
        integrator.iterations(),
    ])
}

/// A method of the catalogue with the evaluations that it makes.
struct Counted {
    name: &'static str,
    /// A step.
    forces: u64,
    velocities: u64,
    /// Once to start: the force or the velocity at the end of a step is that at the start of the next.
    once: [u64; 2],
    found: Result<[u64; 3], Error>,
}

/// Makes types of methods of the catalogue: `Type, "name", forces and velocities a step, and once to start`.
macro_rules! counted {
    ($($method:ident { $($name:tt)+ } $text:literal $forces:literal $velocities:literal [$($once:literal),+];)+) => {
        symplectic::composition! {
            $(/// A method of the catalogue.
            $method { base: $($name)+, max_stages: 626 })+
        }

        fn all() -> Vec<Counted> {
            vec![$(Counted {
                name: $text,
                forces: $forces,
                velocities: $velocities,
                once: [$($once),+],
                found: evaluations($method),
            }),+]
        }
    };
}

// Kick first and last: one force is saved. Drift first and last: one velocity.
counted! {
    VelocityVerlet { velocity-verlet } "velocity-verlet" 1 1 [1, 0];
    PositionVerlet { position-verlet } "position-verlet" 1 1 [0, 1];
    Ruth { ruth-1983 } "ruth-1983" 3 3 [0, 0];
    ForestRuth { forest-ruth-1990 } "forest-ruth-1990" 3 3 [1, 0];
    SuzukiSplitting { suzuki-1990 } "suzuki-1990" 5 5 [1, 0];
    McLachlanS2 { mclachlan-1995-s2 } "mclachlan-1995-s2" 2 2 [1, 0];
    McLachlanS4 { mclachlan-1995-s4 } "mclachlan-1995-s4" 4 4 [1, 0];
    McLachlanS5 { mclachlan-1995-s5 } "mclachlan-1995-s5" 5 5 [1, 0];
    McLachlanSs5 { mclachlan-1995-ss5 } "mclachlan-1995-ss5" 5 5 [1, 0];
    McLachlanSb3a4 { mclachlan-1995-sb3a4 } "mclachlan-1995-sb3a4" 4 4 [0, 1];
    McLachlanSb3a5 { mclachlan-1995-sb3a5 } "mclachlan-1995-sb3a5" 5 5 [0, 1];
    McLachlanAtela2 { mclachlan-atela-1992-order-2-optimal } "mclachlan-atela-1992-order-2-optimal" 2 2 [0, 0];
    McLachlanAtela3 { mclachlan-atela-1992-order-3-optimal } "mclachlan-atela-1992-order-3-optimal" 3 3 [0, 0];
    TripleJump4 { triple-jump-4 } "triple-jump-4" 3 3 [1, 0];
    TripleJump6 { triple-jump-6 } "triple-jump-6" 9 9 [1, 0];
    TripleJump8 { triple-jump-8 } "triple-jump-8" 27 27 [1, 0];
    TripleJump10 { triple-jump-10 } "triple-jump-10" 81 81 [1, 0];
    Suzuki4 { suzuki-4 } "suzuki-4" 5 5 [1, 0];
    Suzuki6 { suzuki-6 } "suzuki-6" 25 25 [1, 0];
    Suzuki8 { suzuki-8 } "suzuki-8" 125 125 [1, 0];
    Suzuki10 { suzuki-10 } "suzuki-10" 625 625 [1, 0];
    Saba1 { saba-1 } "saba-1" 1 1 [0, 1];
    Saba2 { saba-2 } "saba-2" 2 2 [0, 1];
    Saba3 { saba-3 } "saba-3" 3 3 [0, 1];
    Saba4 { saba-4 } "saba-4" 4 4 [0, 1];
    Sbab1 { sbab-1 } "sbab-1" 1 1 [1, 0];
    Sbab2 { sbab-2 } "sbab-2" 2 2 [1, 0];
    Sbab3 { sbab-3 } "sbab-3" 3 3 [1, 0];
    Sbab4 { sbab-4 } "sbab-4" 4 4 [1, 0];
    KahanLi1997S5odr4A { kahan-li-1997-s5odr4-a } "kahan-li-1997-s5odr4-a" 5 5 [1, 0];
    KahanLi1997S5odr4B { kahan-li-1997-s5odr4-b } "kahan-li-1997-s5odr4-b" 5 5 [1, 0];
    BlanesMoan2002S6 { blanes-moan-2002-s6 } "blanes-moan-2002-s6" 6 6 [1, 0];
    BlanesMoan2002S10 { blanes-moan-2002-s10 } "blanes-moan-2002-s10" 10 10 [1, 0];
    BlanesMoan2002Srkn6b { blanes-moan-2002-srkn6b } "blanes-moan-2002-srkn6b" 6 6 [1, 0];
    BlanesMoan2002Srkn11b { blanes-moan-2002-srkn11b } "blanes-moan-2002-srkn11b" 11 11 [1, 0];
    BlanesMoan2002Srkn14a { blanes-moan-2002-srkn14a } "blanes-moan-2002-srkn14a" 14 14 [0, 1];
    MclachlanAtela1992Order4Optimal { mclachlan-atela-1992-order-4-optimal } "mclachlan-atela-1992-order-4-optimal" 4 4 [0, 0];
    MclachlanAtela1992Order5Optimal { mclachlan-atela-1992-order-5-optimal } "mclachlan-atela-1992-order-5-optimal" 6 6 [0, 0];
    OkunborSkeel1994Order6Method13 { okunbor-skeel-1994-order-6-method-13 } "okunbor-skeel-1994-order-6-method-13" 7 7 [0, 1];
    Yoshida1990Order6A { yoshida-1990-order-6-a } "yoshida-1990-order-6-a" 7 7 [1, 0];
    Yoshida1990Order6B { yoshida-1990-order-6-b } "yoshida-1990-order-6-b" 7 7 [1, 0];
    Yoshida1990Order6C { yoshida-1990-order-6-c } "yoshida-1990-order-6-c" 7 7 [1, 0];
    Yoshida1990Order8A { yoshida-1990-order-8-a } "yoshida-1990-order-8-a" 15 15 [1, 0];
    Yoshida1990Order8B { yoshida-1990-order-8-b } "yoshida-1990-order-8-b" 15 15 [1, 0];
    Yoshida1990Order8C { yoshida-1990-order-8-c } "yoshida-1990-order-8-c" 15 15 [1, 0];
    Yoshida1990Order8D { yoshida-1990-order-8-d } "yoshida-1990-order-8-d" 15 15 [1, 0];
    Yoshida1990Order8E { yoshida-1990-order-8-e } "yoshida-1990-order-8-e" 15 15 [1, 0];
    Mclachlan1995Ss9 { mclachlan-1995-ss9 } "mclachlan-1995-ss9" 9 9 [1, 0];
    Mclachlan1995Ss15 { mclachlan-1995-ss15 } "mclachlan-1995-ss15" 15 15 [1, 0];
    Mclachlan1995Ss17 { mclachlan-1995-ss17 } "mclachlan-1995-ss17" 17 17 [1, 0];
    KahanLi1997S9odr6A { kahan-li-1997-s9odr6-a } "kahan-li-1997-s9odr6-a" 9 9 [1, 0];
    KahanLi1997S9odr6B { kahan-li-1997-s9odr6-b } "kahan-li-1997-s9odr6-b" 9 9 [1, 0];
    KahanLi1997S17odr8A { kahan-li-1997-s17odr8-a } "kahan-li-1997-s17odr8-a" 17 17 [1, 0];
    KahanLi1997S17odr8B { kahan-li-1997-s17odr8-b } "kahan-li-1997-s17odr8-b" 17 17 [1, 0];
    KahanLi1997S31odr10A { kahan-li-1997-s31odr10-a } "kahan-li-1997-s31odr10-a" 31 31 [1, 0];
    KahanLi1997S31odr10B { kahan-li-1997-s31odr10-b } "kahan-li-1997-s31odr10-b" 31 31 [1, 0];
    KahanLi1997S33odr10A { kahan-li-1997-s33odr10-a } "kahan-li-1997-s33odr10-a" 33 33 [1, 0];
    KahanLi1997S33odr10B { kahan-li-1997-s33odr10-b } "kahan-li-1997-s33odr10-b" 33 33 [1, 0];
    KahanLi1997S33odr10C { kahan-li-1997-s33odr10-c } "kahan-li-1997-s33odr10-c" 33 33 [1, 0];
    SofroniouSpaletta2005S11odr6 { sofroniou-spaletta-2005-s11odr6 } "sofroniou-spaletta-2005-s11odr6" 11 11 [1, 0];
    SofroniouSpaletta2005S13odr6 { sofroniou-spaletta-2005-s13odr6 } "sofroniou-spaletta-2005-s13odr6" 13 13 [1, 0];
    SofroniouSpaletta2005S21odr8 { sofroniou-spaletta-2005-s21odr8 } "sofroniou-spaletta-2005-s21odr8" 21 21 [1, 0];
    SofroniouSpaletta2005S35odr10 { sofroniou-spaletta-2005-s35odr10 } "sofroniou-spaletta-2005-s35odr10" 35 35 [1, 0];
    Pefrl { pefrl } "pefrl" 4 4 [0, 1];
    OmelyanMryglodFolk2003Velocity5 { omelyan-mryglod-folk-2003-velocity-5 } "omelyan-mryglod-folk-2003-velocity-5" 5 5 [1, 0];
    Ostmeyer2022Order4 { ostmeyer-2022-order-4 } "ostmeyer-2022-order-4" 5 5 [1, 0];
    BlanesCasasEscorihuela2022A19 { blanes-casas-escorihuela-2022-a19 } "blanes-casas-escorihuela-2022-a19" 19 19 [0, 1];
    Morales2025Y8m10b { morales-2025-y8m10b } "morales-2025-y8m10b" 21 21 [1, 0];
    Symplectic2026S7 { symplectic-2026-s7 } "symplectic-2026-s7" 7 7 [1, 0];
    Symplectic2026Srkn14 { symplectic-2026-srkn14 } "symplectic-2026-srkn14" 14 14 [1, 0];
    Symplectic2026S19odr8 { symplectic-2026-s19odr8 } "symplectic-2026-s19odr8" 19 19 [1, 0];
    Morales2022Y10m16 { morales-2022-y10m16 } "morales-2022-y10m16" 33 33 [1, 0];
    Saba5 { saba-5 } "saba-5" 5 5 [0, 1];
    Saba6 { saba-6 } "saba-6" 6 6 [0, 1];
    Saba7 { saba-7 } "saba-7" 7 7 [0, 1];
    Saba8 { saba-8 } "saba-8" 8 8 [0, 1];
    Sbab5 { sbab-5 } "sbab-5" 5 5 [1, 0];
    Sbab6 { sbab-6 } "sbab-6" 6 6 [1, 0];
    Sbab7 { sbab-7 } "sbab-7" 7 7 [1, 0];
    Sbab8 { sbab-8 } "sbab-8" 8 8 [1, 0];
    Mclachlan1995Aba84 { mclachlan-1995-aba-8-4 } "mclachlan-1995-aba-8-4" 5 5 [0, 1];
    Mclachlan1995Bab84 { mclachlan-1995-bab-8-4 } "mclachlan-1995-bab-8-4" 5 5 [1, 0];
    Blanes2013Aba104 { blanes-2013-aba-10-4 } "blanes-2013-aba-10-4" 7 7 [0, 1];
    Blanes2013Aba864 { blanes-2013-aba-8-6-4 } "blanes-2013-aba-8-6-4" 7 7 [0, 1];
    Blanes2013Aba1064 { blanes-2013-aba-10-6-4 } "blanes-2013-aba-10-6-4" 8 8 [0, 1];
}

#[test]
fn a_step_evaluates_as_often_as_it_has_kicks_and_drifts() -> Result<(), Error> {
    for Counted {
        name,
        forces,
        velocities,
        once,
        found,
    } in all()
    {
        let expected = [forces * STEPS + once[0], velocities * STEPS + once[1], 0];
        assert_eq!(found?, expected, "{name}");
    }
    Ok(())
}

#[test]
fn the_compiler_knows_how_often() {
    for method in all() {
        let entry = catalogue::find(method.name).expect(method.name);
        let tableau = entry.derive().expect(method.name);
        let known = tableau
            .evaluations()
            .map(|known| (known.forces as u64, known.velocities as u64));
        assert_eq!(
            known,
            Some((method.forces, method.velocities)),
            "{}",
            method.name
        );
    }
}

#[test]
fn no_splitting_of_the_catalogue_is_left_out() {
    let here: Vec<&str> = all().iter().map(|method| method.name).collect();
    for entry in catalogue::entries() {
        let definition = &entry.definition;
        // Gradient kicks need another class of systems: runtime/tests/steps/gradient_kicks.rs
        if definition.contains("gradient:") {
            continue;
        }
        // The kernel alone is taken in every step: runtime/tests/steps/processed.rs
        if definition.contains("processor:") {
            continue;
        }
        let explicit = definition.contains("kick:") || definition.contains("base:");
        assert_eq!(
            explicit,
            here.contains(&entry.name.as_str()),
            "{}",
            entry.name
        );
    }
}

/// The matrices that the macro leaves to the compiler of Rust are those of the tableau.
#[test]
fn matrices_of_a_long_splitting_are_those_of_its_tableau() {
    let entry = catalogue::find("triple-jump-10").expect("known");
    let tableau = entry.derive().expect("derived");
    let doubles = tableau.to_f64();
    assert_eq!(TripleJump10::A.map(Vec::from).to_vec(), doubles.a);
    assert_eq!(
        TripleJump10::A_TILDE.map(Vec::from).to_vec(),
        doubles.a_tilde
    );
    let of = TripleJump10::COEFFICIENTS;
    let rows = |rows: &[&[Coefficient]]| -> Vec<Vec<f64>> {
        let row = |row: &&[Coefficient]| row.iter().map(|x| x.double()).collect();
        rows.iter().map(row).collect()
    };
    assert_eq!((rows(of.a), rows(of.a_tilde)), (doubles.a, doubles.a_tilde));
}
