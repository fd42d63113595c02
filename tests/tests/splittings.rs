//! Every splitting and composition of the catalogue in use: how often a step evaluates, and that it is of its order.

use symplectic::{Error, Integrator, Method};
use symplectic_compiler::catalogue;
use symplectic_tests::counting::{Counting, Counts};
use symplectic_tests::scenes::kepler;

const STEPS: u64 = 20;

/// Evaluations of force and velocity in [`STEPS`] steps of Kepler's problem, and sweeps of an iteration.
fn evaluations<M: Method>(method: M) -> Result<[u64; 3], Error> {
    let counts = Counts::default();
    let system = Counting::new(kepler::Kepler, &counts);
    let mut integrator = Integrator::new(method, system, kepler::start::<f64>(0.2), 0.01)?;
    for _ in 0..STEPS {
        integrator.step()?;
    }
    Ok([
        counts.forces(),
        counts.velocities(),
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
            $method { base: $($name)+ })+
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
    Suzuki4 { suzuki-4 } "suzuki-4" 5 5 [1, 0];
    Suzuki6 { suzuki-6 } "suzuki-6" 25 25 [1, 0];
    Saba1 { saba-1 } "saba-1" 1 1 [0, 1];
    Saba2 { saba-2 } "saba-2" 2 2 [0, 1];
    Saba3 { saba-3 } "saba-3" 3 3 [0, 1];
    Saba4 { saba-4 } "saba-4" 4 4 [0, 1];
    Sbab1 { sbab-1 } "sbab-1" 1 1 [1, 0];
    Sbab2 { sbab-2 } "sbab-2" 2 2 [1, 0];
    Sbab3 { sbab-3 } "sbab-3" 3 3 [1, 0];
    Sbab4 { sbab-4 } "sbab-4" 4 4 [1, 0];
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
        let explicit = definition.contains("kick:") || definition.contains("base:");
        assert_eq!(
            explicit,
            here.contains(&entry.name.as_str()),
            "{}",
            entry.name
        );
    }
}
