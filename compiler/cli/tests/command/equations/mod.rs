//! The equations of motion in every printed form, against the functions that integrate.

mod latex;
mod reader;

use std::fs;

use serde_json::Value as Json;
use symplectic::constraints::{Constrained, Nonholonomic, consistent_momentum};
use symplectic::friction::Damped;
use symplectic::nalgebra::{DVector, SVector};
use symplectic::system::{Class, Lagrangian, Unconstrained};
use symplectic::{Error, General, Hamiltonian, Separable, State, System, Vector};
use symplectic_formula::{Form, Structure, description};

use self::reader::{Values, World, constraints, solve};
use super::run::stdout;

/// A system for the runtime, and its formula as a text.
macro_rules! system {
    ($macro:ident, $text:ident: $($formula:tt)*) => {
        symplectic::$macro! { $($formula)* }
        const $text: &str = stringify!($($formula)*);
    };
}

system!(hamiltonian, CYCLIC: Cyclic q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + x^4);
system!(hamiltonian, SINGLE: Single q: [q], p: [p]; H = p^2/2 - cos(q));
system!(hamiltonian, TURNING: Turning { w: 1/2 } q: [3], p: [3]; H = |p|^2/2 + q[2]^2 + w (q[0] p[1] - q[1] p[0]));
system!(hamiltonian, GRAVITY: Gravity<N> { m: [N], g: 9.81 } q: [N; 3], p: [N; 3];
    H = sum(i: |p[i]|^2/(2 m[i]) + g m[i] q[i][2]));
system!(hamiltonian, FIRST: First<N> { k: 3 } q: [N], p: [N]; H = sum(i: p[i]^2/2) + k q[0]^2/2);
system!(hamiltonian, PLANETS: Planets<N> { m: [N], G: 2 } q: [N; 2], p: [N; 2];
    H = sum(i: |p[i]|^2/(2 m[i])) - sum(i < j: G m[i] m[j]/|q[i] - q[j]|));
system!(hamiltonian, CHAIN: Chain { beta: 3 } q: [..], p: [..]; bonds: walls;
    H = sum(i: p[i]^2/2) + sum(bonds d: d^2/2 + beta d^4/4));
system!(hamiltonian, RUBBED: Rubbed { gamma: 0.1 } q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + x^2
    friction: gamma);
system!(hamiltonian, RUBBED_UNEQUALLY: RubbedUnequally { a: 0.1 } q: [x, y], p: [px, py];
    H = (px^2 + py^2)/2 + cos(x + 2 y) friction: [a, a^2] force: { y = sin(t) - x });
system!(hamiltonian, RUBBED_CHAIN: RubbedChain { c: 0.3 } q: [..], p: [..]; bonds: free;
    H = sum(i: p[i]^2/2) + sum(bonds d: d^2/2 + d^3) friction: c);
system!(hamiltonian, RUBBED_BODIES: RubbedBodies<N> { c: 0.3 } q: [N; 2], p: [N; 2];
    H = sum(i: |p[i]|^2/2 + q[i][1]) friction: [c, 2 c]);
system!(hamiltonian, RUBBED_THREE: RubbedThree { c: [3] } q: [3], p: [3]; H = sum(i: p[i]^2/2) + q[1]^2
    friction: [c[0], 0, c[2]]);
system!(hamiltonian, DRONE: Drone { c: 0.2, g: 9.81 } q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + g y
    force: { y = -c py |[px, py]|, x = -c px |[px, py]| + sin(t), y = t });
system!(hamiltonian, DAMPERS: Dampers { dampers: pairs, c: [dampers] } q: [..], p: [..]; H = sum(i: p[i]^2/2)
    force: { q[i](s = (i, j) in dampers) = c[s] (p[j] - p[i]), q[j](s = (i, j) in dampers) = c[s] (p[i] - p[j]) });
system!(hamiltonian, PENDULUM: Pendulum { g: 9.81 } q: [x, y], p: [px, py]; H = (px^2 + py^2)/2 + g y
    constraints: { rod = x^2 + y^2 - 1 });
system!(hamiltonian, TWO: Two { g: 9.81 } q: [x, y, z], p: [px, py, pz]; H = (px^2 + py^2 + pz^2)/2 + g y
    constraints: { sphere = x^2 + y^2 + z^2 - 1, plane = x - 2 y } force: { z = -pz, x = cos(t) });
system!(hamiltonian, WATER: Water<N> { m: [N], rods: pairs, length: [rods], g: 9.81 } q: [N; 3], p: [N; 3];
    H = sum(i: |p[i]|^2/(2 m[i]) + g m[i] q[i][2])
    constraints: {
        top = q[0],
        rod(s = (i, j) in rods) = |q[i] - q[j]|^2 - length[s]^2,
        link(i in 1..N) = q[i][0] q[i-1][1],
    }
    force: { q[i] = -p[i] });
system!(lagrangian, BEAD: Bead { g: 9.81, c: 0.1 } q: [x, y], v: [vx, vy]; L = (vx^2 + 2 vy^2)/2 - g y
    constraints: { wire = y - x^2 } force: { x = -c vx });
system!(hamiltonian, SKATE: Skate { g: 0.5 } q: [x, y, a], p: [px, py, pa], v: [vx, vy, va];
    H = (px^2 + py^2 + 2 pa^2)/2 + g x nonholonomic: { edge = vx sin(a) - vy cos(a) } force: { a = -pa });
system!(lagrangian, ROLLING: Rolling { r: 0.5 } q: [x, y, a, b], v: [vx, vy, va, vb];
    L = (vx^2 + vy^2)/2 + va^2/4 + vb^2/8
    nonholonomic: { along = vx - r va cos(b), across = vy - r va sin(b) });
system!(hamiltonian, CARS: Cars<N> { m: [N] } q: [N; 3], p: [N; 3], v: [N; 3]; H = sum(i: |p[i]|^2/(2 m[i]))
    nonholonomic: { edge(i in 0..N) = v[i][0] sin(q[i][2]) - v[i][1] cos(q[i][2]) });
system!(lagrangian, RUBBED_LAGRANGIAN: RubbedLagrangian { c: 0.1 } q: [q], v: [v]; L = v^2 - q^4 cos(t)
    friction: c);
system!(lagrangian, RELATIVE: Relative { k: 2, c: 0.1 } q: [x, y], v: [vx, vy];
    L = -sqrt(1 - vx^2 - vy^2) - k x^2/2 force: { x = -c vx });

/// Pseudo-random numbers from 0.1 to 0.9.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        0.1 + 0.8 * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }

    fn vector(&mut self, length: usize) -> Vec<f64> {
        (0..length).map(|_| self.next()).collect()
    }
}

/// The equations and the constraints in one printed form, as in the text format.
struct Printed {
    form: &'static str,
    equations: Vec<String>,
    constraints: Vec<String>,
}

fn strings(json: &Json) -> Vec<String> {
    let lines = json.as_array().map(Vec::as_slice).unwrap_or_default();
    lines
        .iter()
        .map(|line| line.as_str().expect("a line").to_owned())
        .collect()
}

/// The lines that give a derivative or a part that equations have in common, and those that give zero.
fn sorted(form: &'static str, lines: impl Iterator<Item = String>) -> Printed {
    let (mut equations, mut constraints) = (Vec::new(), Vec::new());
    for line in lines {
        let left = line
            .split(" = ")
            .next()
            .unwrap_or_default()
            .trim_end_matches(" +");
        let left = left.split(" += ").next().unwrap_or_default();
        let common = left.starts_with("s1") || left.starts_with("s2") || left.starts_with("s3");
        if common || left.contains('\'') && !left.contains(' ') {
            equations.push(line);
        } else if line
            .split("    (")
            .next()
            .is_some_and(|line| line.ends_with(" = 0"))
        {
            constraints.push(line);
        }
    }
    Printed {
        form,
        equations,
        constraints,
    }
}

/// The equations in every form.
fn printed(name: &str, text: &str) -> Vec<Printed> {
    let folder = super::emit::folder("equations");
    let file = folder.join(format!("{name}.txt"));
    fs::write(&file, text).expect("written");
    let file = file.display().to_string();
    let derived = |format: &str| stdout(&["derive-system", &file, "--format", format]);
    let mut all = Vec::new();
    let plain = derived("text");
    let plain = plain
        .split("\nsecond derivatives")
        .next()
        .expect("the equations");
    all.push(sorted(
        "text",
        plain.lines().map(|line| line.trim_start().to_owned()),
    ));
    let latex = derived("latex");
    let lines = latex
        .lines()
        .map(|line| line.trim().trim_end_matches("\\\\").trim());
    let lines = lines.filter(|line| !line.starts_with("\\begin") && !line.starts_with("\\end"));
    let lines = lines.filter(|line| !line.contains("partial") && !line.contains("const"));
    all.push(sorted("latex", lines.map(latex::text)));
    let json: Json = serde_json::from_str(&derived("json")).expect("JSON");
    for (form, key) in [("JSON, text", "text"), ("JSON, LaTeX", "latex")] {
        let lines = |part: &str| {
            let lines = strings(&json[part][key]);
            let plain = |line: &String| {
                if key == "latex" {
                    latex::text(line)
                } else {
                    line.clone()
                }
            };
            lines.iter().map(plain).collect()
        };
        all.push(Printed {
            form,
            equations: lines("equations_of_motion"),
            constraints: lines("constraints"),
        });
    }
    let mut system =
        symplectic_formula::System::read_as(Form::of(text), "text", text).expect("a system");
    let structure = Structure::of(&mut system);
    let page = description::page(&system, &structure);
    let block = page.split("```").nth(1).expect("a block");
    all.push(sorted("documentation", block.lines().map(str::to_owned)));
    let unescaped = |line: &str| {
        let (mut out, mut letters) = (String::new(), line.chars());
        while let Some(c) = letters.next() {
            out.extend(if c == '\\' { letters.next() } else { Some(c) });
        }
        latex::text(&out)
    };
    let displays = page
        .lines()
        .filter_map(|line| line.strip_prefix("$$")?.strip_suffix("$$"));
    let displays: Vec<String> = displays.map(unescaped).collect();
    // Long formulas are in the block only.
    if !displays.is_empty() {
        all.push(sorted("documentation, KaTeX", displays.into_iter()));
    }
    all
}

/// A state with everything that a formula names.
struct Case {
    world: World,
    time: f64,
    /// Positions and momenta, flat, with the names of all of their entries.
    halves: [Vec<f64>; 2],
    names: [Vec<String>; 2],
    /// The names of the multipliers, in the order of the constraints.
    multipliers: Vec<String>,
}

impl Case {
    /// With named coordinates.
    fn named(positions: &[&str], momenta: &[&str]) -> Self {
        Self::new(
            [positions, momenta].map(|names| names.iter().map(|&name| name.to_owned()).collect()),
        )
    }

    /// With numbered coordinates of this number of components; none if they are numbers.
    fn numbered(count: usize, components: usize) -> Self {
        let names = |letter: &str| {
            let name = |k: usize| match components {
                0 => format!("{letter}[{k}]"),
                n => format!("{letter}[{},{}]", k / n, k % n),
            };
            (0..count * components.max(1)).map(name).collect()
        };
        let mut case = Self::new([names("q"), names("p")]);
        case.world
            .lengths
            .extend(["n", "N"].map(|name| (name.to_owned(), count as i64)));
        case
    }

    fn new(names: [Vec<String>; 2]) -> Self {
        let mut random = Random(7);
        let halves = [0, 1].map(|half: usize| random.vector(names[half].len()));
        let time = random.next();
        let mut case = Case {
            world: World::default(),
            time,
            halves,
            names,
            multipliers: Vec::new(),
        };
        case.update();
        case
    }

    /// Takes the values from the time and the halves.
    fn update(&mut self) {
        self.world.values.insert("t".to_owned(), self.time);
        for (names, values) in self.names.iter().zip(&self.halves) {
            self.world
                .values
                .extend(names.iter().cloned().zip(values.iter().copied()));
        }
    }

    fn number(mut self, name: &str, value: f64) -> Self {
        self.world.values.insert(name.to_owned(), value);
        self
    }

    fn array(mut self, name: &str, values: &[f64]) -> Self {
        let entries = values.iter().enumerate();
        self.world
            .values
            .extend(entries.map(|(k, value)| (format!("{name}[{k}]"), *value)));
        self
    }

    fn pairs(mut self, name: &str, pairs: &[(usize, usize)]) -> Self {
        let pairs = pairs.iter().map(|&(i, j)| [i as i64, j as i64]).collect();
        self.world.pairs.insert(name.to_owned(), pairs);
        self
    }

    fn multipliers(mut self, names: &[&str]) -> Self {
        self.multipliers = names.iter().map(|&name| name.to_owned()).collect();
        self
    }

    /// The derivatives by name.
    fn derivatives(&self, [velocity, force]: [&[f64]; 2]) -> Values {
        let names = self.names.iter().flatten().map(|name| dotted(name));
        names.zip(velocity.iter().chain(force).copied()).collect()
    }
}

/// The name of the derivative of a coordinate.
fn dotted(name: &str) -> String {
    match name.split_once('[') {
        Some((head, rest)) => format!("{head}'[{rest}"),
        None => format!("{name}'"),
    }
}

/// Bound of the rounding errors of a few dozen operations with numbers below 100.
const ROUNDING: f64 = 1e-11;

fn assert_same(form: &str, found: &Values, expected: &Values) {
    let names = |values: &Values| {
        let mut names: Vec<String> = values.keys().cloned().collect();
        names.sort();
        names
    };
    assert_eq!(names(found), names(expected), "{form}");
    for (name, value) in expected {
        let difference = (found[name] - value).abs();
        assert!(
            difference < ROUNDING,
            "{form}: {name} = {}, not {value}",
            found[name]
        );
    }
}

/// What systems of a class have in addition to velocity and force.
trait Given: Class {
    /// A rate of friction.
    fn rate<S: Hamiltonian<Class = Self>>(_system: &S, _component: usize) -> f64 {
        0.0
    }

    /// The values of holonomic constraints.
    fn values<S: Hamiltonian<Class = Self>>(_system: &S, _q: &S::Vector<f64>) -> Vec<f64> {
        Vec::new()
    }
}

impl Given for General {}

impl Given for Separable {}

impl Given for Damped {
    fn rate<S: Hamiltonian<Class = Self>>(system: &S, component: usize) -> f64 {
        let friction = Hamiltonian::extra::<f64>(system).expect("friction");
        friction.friction(component)
    }
}

impl<C: Class + Unconstrained> Given for Constrained<C> {
    fn values<S: Hamiltonian<Class = Self>>(system: &S, q: &S::Vector<f64>) -> Vec<f64> {
        let constraints = Hamiltonian::extra::<f64>(system).expect("constraints");
        let mut values = vec![0.0; constraints.constraints()];
        constraints.constraint_values(q, &mut values);
        values
    }
}

impl<C: Class + Unconstrained> Given for Nonholonomic<C> {}

/// Velocity, and force with friction, by the functions that integrate.
fn slopes<S: Hamiltonian<Class: Given>>(system: &S, case: &Case) -> [S::Vector<f64>; 2] {
    let [q, p] = case.halves.each_ref().map(|half| vector::<S>(half));
    let [mut velocity, mut force] = [q.zeros_like(), q.zeros_like()];
    system.velocity(case.time, &q, &p, &mut velocity);
    system.force(case.time, &q, &p, &mut force);
    for (k, force) in force.as_mut_slice().iter_mut().enumerate() {
        *force -= S::Class::rate(system, k) * case.halves[1][k];
    }
    [velocity, force]
}

fn vector<S: Hamiltonian>(components: &[f64]) -> S::Vector<f64> {
    S::Vector::<f64>::from_slice(components).expect("the dimension")
}

/// Compares every printed form of a system with holonomic constraints, or without constraints.
fn compare<S: Hamiltonian<Class: Given>>(system: &S, name: &str, text: &str, mut case: Case) {
    let [velocity, mut force] = slopes(system, &case);
    let values = |q: &[f64]| S::Class::values(system, &vector::<S>(q));
    let multipliers = Random(3).vector(values(&case.halves[0]).len());
    assert_eq!(multipliers.len(), case.multipliers.len());
    let named = case
        .multipliers
        .iter()
        .cloned()
        .zip(multipliers.iter().copied());
    case.world.values.extend(named);
    // Constraints of degree two: central differences are exact up to rounding.
    let step = 2.0_f64.powi(-8);
    for (k, force) in force.as_mut_slice().iter_mut().enumerate() {
        let moved = |by: f64| {
            let mut q = case.halves[0].clone();
            q[k] += by;
            values(&q)
        };
        let (after, before) = (moved(step), moved(-step));
        for (multiplier, (after, before)) in multipliers.iter().zip(after.iter().zip(&before)) {
            *force -= multiplier * (after - before) / (2.0 * step);
        }
    }
    let slopes = [velocity.as_slice(), force.as_slice()];
    compare_with(name, text, &case, slopes, &values(&case.halves[0]));
}

/// Compares every printed form with velocity, force and the values of the constraints.
fn compare_with(name: &str, text: &str, case: &Case, slopes: [&[f64]; 2], values: &[f64]) {
    let expected = case.derivatives(slopes);
    for Printed {
        form,
        equations,
        constraints: lines,
    } in printed(name, text)
    {
        let form = format!("{name}, {form}");
        let found = solve(&equations, &case.world);
        assert_same(&form, &found, &expected);
        let found = constraints(&lines, &case.world);
        assert_eq!(found.len(), values.len(), "{form}: {lines:?}");
        for (constraint, (multiplier, found)) in found.into_iter().enumerate() {
            // A single one needs no name.
            let place = multiplier.map_or(Some(constraint), |name| {
                case.multipliers.iter().position(|known| *known == name)
            });
            let value = values[place.expect("a multiplier")];
            assert!(
                (found - value).abs() < ROUNDING,
                "{form}: {found}, not {value}"
            );
        }
    }
}

#[test]
fn printed_equations_of_hamiltonians_are_those_that_integrate() {
    let plane = || Case::named(&["x", "y"], &["px", "py"]);
    compare(&Cyclic, "cyclic", CYCLIC, plane());
    compare(&Single, "single", SINGLE, Case::named(&["q"], &["p"]));
    compare(
        &Turning::default(),
        "turning",
        TURNING,
        Case::numbered(3, 0).number("w", 0.5),
    );
    let masses = [1.0, 0.5, 0.25];
    let bodies = |components| Case::numbered(3, components).array("m", &masses);
    compare(
        &Gravity::new(masses),
        "gravity",
        GRAVITY,
        bodies(3).number("g", 9.81),
    );
    compare(
        &First::<3>::new(),
        "first",
        FIRST,
        Case::numbered(3, 0).number("k", 3.0),
    );
    compare(
        &Planets::new(masses),
        "planets",
        PLANETS,
        bodies(2).number("G", 2.0),
    );
    let case = Case::numbered(4, 0).number("beta", 3.0);
    let [q, p] = case.halves.clone().map(DVector::from);
    let [mut velocity, mut force] = [q.clone(), q.clone()];
    let chain = Chain::default();
    System::velocity(&chain, case.time, &q, &p, &mut velocity);
    System::force(&chain, case.time, &q, &p, &mut force);
    let slopes = [velocity.as_slice(), force.as_slice()];
    compare_with("chain", CHAIN, &case, slopes, &[]);
}

#[test]
fn printed_equations_with_friction_and_forces_are_those_that_integrate() {
    let plane = || Case::named(&["x", "y"], &["px", "py"]);
    compare(
        &Rubbed::default(),
        "rubbed",
        RUBBED,
        plane().number("gamma", 0.1),
    );
    let case = plane().number("a", 0.1);
    compare(
        &RubbedUnequally::default(),
        "rubbed-unequally",
        RUBBED_UNEQUALLY,
        case,
    );
    let case = Case::numbered(4, 0).number("c", 0.3);
    compare(&RubbedChain::default(), "rubbed-chain", RUBBED_CHAIN, case);
    let case = Case::numbered(3, 2).number("c", 0.3);
    compare(
        &RubbedBodies::<3>::new(),
        "rubbed-bodies",
        RUBBED_BODIES,
        case,
    );
    let case = Case::named(&["q"], &["p"]).number("c", 0.1);
    compare(
        &RubbedLagrangian::default(),
        "rubbed-lagrangian",
        RUBBED_LAGRANGIAN,
        case,
    );
    let rates = [0.3, 7.0, 0.2];
    let case = Case::numbered(3, 0).array("c", &rates);
    compare(&RubbedThree::new(rates), "rubbed-three", RUBBED_THREE, case);
    let case = plane().number("c", 0.2).number("g", 9.81);
    compare(&Drone::default(), "drone", DRONE, case);
    let (pairs, rates) = ([(0, 1), (3, 0), (1, 0)], [0.5, 2.0, 0.25]);
    let case = Case::numbered(4, 0)
        .array("c", &rates)
        .pairs("dampers", &pairs);
    compare(
        &Dampers::new(pairs.to_vec(), rates.to_vec()),
        "dampers",
        DAMPERS,
        case,
    );
}

#[test]
fn printed_equations_with_constraints_are_those_that_integrate() {
    let plane = || Case::named(&["x", "y"], &["px", "py"]).number("g", 9.81);
    compare(
        &Pendulum::default(),
        "pendulum",
        PENDULUM,
        plane().multipliers(&["λ"]),
    );
    let case = Case::named(&["x", "y", "z"], &["px", "py", "pz"]).number("g", 9.81);
    compare(
        &Two::default(),
        "two",
        TWO,
        case.multipliers(&["λ_sphere", "λ_plane"]),
    );
    let (masses, rods, lengths) = ([1.0, 0.5, 0.25], [(0, 2), (1, 2)], [0.75, 1.25]);
    let case = Case::numbered(3, 3).number("g", 9.81).array("m", &masses);
    let case = case
        .array("length", &lengths)
        .pairs("rods", &rods)
        .multipliers(&[
            "λ_top[0]",
            "λ_top[1]",
            "λ_top[2]",
            "λ_rod[0]",
            "λ_rod[1]",
            "λ_link[1]",
            "λ_link[2]",
        ]);
    let water = Water::new(masses, rods.to_vec(), lengths.to_vec());
    compare(&water, "water", WATER, case);
    let case = plane().number("c", 0.1).multipliers(&["λ"]);
    compare(&Bead::default(), "bead", BEAD, case);
}

/// The multipliers act along the rows of the constraints, which a projection of the momentum shows. On projected momenta the printed
/// constraints hold.
fn compare_nonholonomic<S: Hamiltonian<Class: Given>>(
    system: &S,
    project: impl Fn(State<S::Vector<f64>>) -> Result<State<S::Vector<f64>>, Error>,
    name: &str,
    text: &str,
    mut case: Case,
) {
    let [q, p] = case.halves.each_ref().map(|half| vector::<S>(half));
    let projected = project(State::new(case.time, q, p)).expect("regular");
    let before = case.halves[1].clone();
    case.halves[1] = projected.p.as_slice().to_vec();
    case.update();
    let [velocity, force] = slopes(system, &case);
    let expected = case.derivatives([velocity.as_slice(), force.as_slice()]);
    let size = case.halves[0].len();
    for Printed {
        form,
        equations,
        constraints: lines,
    } in printed(name, text)
    {
        let form = format!("{name}, {form}");
        let mut world = case.world.clone();
        let mut at = |multiplier: usize| {
            let names = case.multipliers.iter().enumerate();
            let values =
                names.map(|(k, name)| (name.clone(), f64::from(u8::from(k == multiplier))));
            world.values.extend(values);
            solve(&equations, &world)
        };
        let count = case.multipliers.len();
        assert_same(&form, &at(count), &expected);
        // The forces of the multipliers span the change of the momentum.
        let mut rows: Vec<Vec<f64>> = (0..count)
            .map(|k| {
                let found = at(k);
                let names = case.names[1].iter().map(|name| dotted(name));
                names.map(|name| found[&name] - expected[&name]).collect()
            })
            .collect();
        rows.push(
            before
                .iter()
                .zip(&case.halves[1])
                .map(|(a, b)| a - b)
                .collect(),
        );
        assert_eq!(rank(rows.clone()), count, "{form}: {rows:?}");
        rows.pop();
        assert_eq!(rank(rows), count, "{form}");
        let mut world = case.world.clone();
        world.values.extend(expected.clone());
        let found = constraints(&lines, &world);
        assert_eq!(found.len(), count, "{form}: {lines:?}");
        assert!(
            found.iter().all(|(_, value)| value.abs() < ROUNDING),
            "{form}: {found:?}"
        );
        let moved = (0..size).map(|k| (dotted(&case.names[0][k]), before[k]));
        world.values.extend(moved);
        let found = constraints(&lines, &world);
        assert!(
            found.iter().any(|(_, value)| value.abs() > 0.01),
            "{form}: {found:?}"
        );
    }
}

/// The number of independent rows.
fn rank(mut rows: Vec<Vec<f64>>) -> usize {
    let mut rank = 0;
    for column in 0..rows[0].len() {
        let largest = (rank..rows.len())
            .max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()));
        let Some(pivot) = largest.filter(|&row| rows[row][column].abs() > ROUNDING) else {
            continue;
        };
        rows.swap(rank, pivot);
        for row in rank + 1..rows.len() {
            let factor = rows[row][column] / rows[rank][column];
            for k in column..rows[row].len() {
                rows[row][k] -= factor * rows[rank][k];
            }
        }
        rank += 1;
    }
    rank
}

#[test]
fn printed_equations_with_nonholonomic_constraints_are_those_that_integrate() {
    let case = Case::named(&["x", "y", "a"], &["px", "py", "pa"]).number("g", 0.5);
    let skate = Skate::default();
    let project = |state| consistent_momentum(&skate, state);
    compare_nonholonomic(&skate, project, "skate", SKATE, case.multipliers(&["λ"]));
    let case = Case::named(&["x", "y", "a", "b"], &["px", "py", "pa", "pb"]).number("r", 0.5);
    let case = case.multipliers(&["λ_along", "λ_across"]);
    let masses = [1.0, 0.5];
    let cars = Cars::new(masses);
    let project = |state| consistent_momentum(&cars, state);
    let twice = Case::numbered(2, 3)
        .array("m", &masses)
        .multipliers(&["λ[0]", "λ[1]"]);
    compare_nonholonomic(&cars, project, "cars", CARS, twice);
    let wheel = Rolling::default();
    let project = |state| consistent_momentum(&wheel, state);
    compare_nonholonomic(&wheel, project, "rolling", ROLLING, case);
}

/// L is not quadratic in the velocities: the equations are those of the derivatives of L.
#[test]
fn printed_equations_of_a_lagrangian_without_h_are_those_that_integrate() {
    let mut case = Case::named(&["x", "y"], &["vx", "vy"])
        .number("k", 2.0)
        .number("c", 0.1);
    case.halves[1] = vec![0.3, -0.4];
    case.update();
    let relative = Relative::default();
    let [q, v] = case
        .halves
        .each_ref()
        .map(|half| SVector::<f64, 2>::from_column_slice(half));
    let [mut by_velocity, mut by_position, mut force] = [SVector::<f64, 2>::zeros(); 3];
    assert!(relative.gradient(case.time, &q, &v, &mut by_velocity, &mut by_position));
    relative.force(case.time, &q, &v, &mut force);
    let names = ["x'", "y'", "px'", "py'"].map(str::to_owned);
    let force = by_position + force;
    let values = v.iter().chain(&force).copied();
    let expected: Values = names.into_iter().zip(values).collect();
    for Printed {
        form,
        equations,
        constraints,
    } in printed("relative", RELATIVE)
    {
        assert_same(form, &solve(&equations, &case.world), &expected);
        assert!(constraints.is_empty(), "{form}");
    }
}

/// A twin: equations without the friction or without a line are found.
#[test]
fn incomplete_equations_are_found() {
    let case = Case::named(&["x", "y"], &["px", "py"]).number("gamma", 0.1);
    let [velocity, force] = slopes(&Rubbed::default(), &case);
    let expected = case.derivatives([velocity.as_slice(), force.as_slice()]);
    let with = |of_px: &str, of_py: Option<&str>| {
        let lines = ["x' = px", "y' = py", of_px].into_iter().chain(of_py);
        let lines: Vec<String> = lines.map(str::to_owned).collect();
        std::panic::catch_unwind(|| assert_same("twin", &solve(&lines, &case.world), &expected))
    };
    assert!(with("px' = −2 x − gamma px", Some("py' = −gamma py")).is_ok());
    assert!(with("px' = −2 x", Some("py' = −gamma py")).is_err());
    assert!(with("px' = −2 x − gamma px", None).is_err());
}
