//! Random definitions with tiny and huge constants, and a deadline for what is done with them.
#![allow(dead_code)]

mod seeds;

use std::sync::mpsc;
use std::time::{Duration, Instant};

use symplectic_compiler::{Definition, Key};

pub use seeds::seeds;

/// A sequence of pseudo-random numbers (splitmix64).
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15))
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    fn one_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }

    pub fn pick<'a>(&mut self, list: &[&'a str]) -> &'a str {
        list[self.below(list.len())]
    }

    /// Texts, as many as given.
    fn list(&mut self, count: usize, each: impl Fn(&mut Self) -> String) -> Vec<String> {
        (0..count).map(|_| each(self)).collect()
    }
}

const PLAIN: &[&str] = &[
    "1/2", "1/3", "2", "-1", "3/4", "0.1", "7", "1", "0", "pi", "e", "sqrt(2)",
];
const EXTREME: &[&str] = &[
    "1e-400",
    "1e400",
    "1e-300",
    "1e300",
    "1e-40",
    "1e40",
    "1e-17",
    "-1e-100",
    "1/3 + 1e-350",
    "e^-99999999999",
    "e^99999999999",
    "e^-1000000",
    "exp(-1000)",
    "exp(1000)",
    "exp(-2839)",
    "exp(2839)",
    "exp(-10^300)",
    "10^-390",
    "9^400",
    "7^-400",
    "pi^400",
    "pi^-400",
    "1 - 1e-300",
    "1 + 1e-399",
    "pi - 3.14159265358979323846",
    "e - 2.718281828459045235360287471352662497757247093699959574966967627724076630353547594571382178525166427",
    "(1 + 1e-200) - 1",
    "sin(10^300)",
    "cos(10^22)",
    "tan(1e-200)",
    "cos(pi/7)",
    "sqrt(1 + 1e-100) - 1",
    "ln(1 + 1e-200)",
    "1.000000000000000000000000000000000000000000000000000000000000001",
    "cosh(1000)",
    "sinh(-1000)",
    "exp(-exp(7))",
    "cos(exp(1000))",
    "sqrt(2) - 1.4142135623730950488016887242096980785696718753769480731766797379907324784621",
    "root(t^3 - 1e-30*t - 1e-200, 1)",
    "root(t^5 - 10^100*t + 1, 2)",
    "ln(10^400)",
    "cbrt(1e-399)",
    "sqrt(1e-399)",
];

/// A constant of the grammar.
pub fn constant(random: &mut Random, depth: usize) -> String {
    if depth == 0 || random.one_in(3) {
        let leaves = if random.one_in(2) { PLAIN } else { EXTREME };
        return random.pick(leaves).to_owned();
    }
    let a = constant(random, depth - 1);
    match random.below(8) {
        0 | 1 => {
            let b = constant(random, depth - 1);
            format!("({a}) {} ({b})", random.pick(&["+", "-", "*", "/"]))
        }
        2 => format!(
            "({a})^{}",
            random.pick(&["-400", "-17", "-2", "-1", "2", "3", "50", "400"])
        ),
        3 | 4 => {
            let functions = [
                "sqrt", "cbrt", "sin", "cos", "tan", "exp", "ln", "cosh", "sinh",
            ];
            format!("{}({a})", random.pick(&functions))
        }
        5 => format!(
            "(({a}) + {}) - ({a})",
            random.pick(&["1e-200", "1e-30", "exp(-500)", "pi/10^100"])
        ),
        6 => format!(
            "exp({}*({a}))",
            random.pick(&["-1", "100", "-1000", "1e-100"])
        ),
        _ => format!("({a})/10^{}", random.pick(&["3", "30", "300", "399"])),
    }
}

fn list(random: &mut Random, count: usize) -> Vec<String> {
    let mut list = random.list(count, |random| match random.below(3) {
        0 => random.pick(PLAIN).to_owned(),
        1 => random.pick(EXTREME).to_owned(),
        _ => constant(random, 2),
    });
    // Mostly consistent.
    if !random.one_in(4) {
        list.pop();
        let rest: String = list.iter().map(|x| format!(" - ({x})")).collect();
        let place = random.below(list.len() + 1);
        list.insert(place, format!("1{rest}"));
    }
    list
}

fn function(random: &mut Random) -> String {
    let c = match random.below(3) {
        0 => random
            .pick(&[
                "1", "10", "800", "-750", "1000", "2000", "-2500", "1e-100", "1e-300", "1/3", "pi",
            ])
            .to_owned(),
        1 => random.pick(EXTREME).to_owned(),
        _ => constant(random, 1),
    };
    match random.below(6) {
        0 | 1 => format!("exp(({c})*t)"),
        2 => format!("cosh(({c})*t)"),
        3 => format!("cos(({c})*t)"),
        4 => format!("t^{}*exp(({c})*t)", random.pick(&["1", "2", "7"])),
        _ => format!("t + ({c})"),
    }
}

fn basis(random: &mut Random, count: usize) -> String {
    let mut functions = vec!["1".to_owned()];
    functions.extend(random.list(count - 1, function));
    functions.join(", ")
}

fn nodes(random: &mut Random, count: usize) -> String {
    const INSIDE: &[&str] = &[
        "0",
        "1",
        "1/2",
        "1/4",
        "3/4",
        "1e-400",
        "1 - 1e-400",
        "1e-30",
        "exp(-1000)",
        "exp(-99999999999)",
        "exp(-10)",
        "1/2 + 1e-300",
        "1/2 - 1e-399",
        "cos(1)",
        "sin(10^300)^2",
        "sqrt(2) - 1",
        "1 - exp(-2000)",
        "pi - 3",
        "1/3 + pi/10^100",
        "(1 + cos(10^200))/2",
        "ln(1 + 1e-30)",
    ];
    if random.one_in(4) {
        return format!(
            "{}({count})",
            random.pick(&["gauss", "lobatto", "radau-left", "radau-right"])
        );
    }
    random
        .list(count, |random| random.pick(INSIDE).to_owned())
        .join(", ")
}

fn matrix(random: &mut Random, count: usize) -> String {
    let row = |random: &mut Random| format!("[{}]", list(random, count).join(", "));
    format!("[{}]", random.list(count, row).join(", "))
}

/// The parts of a definition, which may be refused.
fn parts(random: &mut Random, depth: usize) -> Vec<(Key, String)> {
    let count = 1 + random.below(3);
    let mut parts = match random.below(if depth == 0 { 5 } else { 7 }) {
        0 => {
            let (kick, drift) = (list(random, count + 1), list(random, count + 1));
            let mut parts = vec![(Key::Kick, kick.join(", ")), (Key::Drift, drift.join(", "))];
            if random.one_in(3) {
                parts.push((Key::Symmetric, "true".to_owned()));
            }
            parts
        }
        1 | 2 => vec![
            (Key::Basis, basis(random, count)),
            (Key::Nodes, nodes(random, count)),
        ],
        3 => {
            let more = count + random.below(2);
            let mut parts = vec![
                (Key::Basis, basis(random, count)),
                (Key::Quadrature, nodes(random, more)),
            ];
            if random.one_in(2) {
                parts.push((Key::Weights, list(random, more).join(", ")));
            }
            parts
        }
        4 => {
            let mut parts = vec![
                (Key::A, matrix(random, count)),
                (Key::B, list(random, count).join(", ")),
            ];
            if random.one_in(2) {
                parts.push((Key::ATilde, "symplectic_partner".to_owned()));
            }
            parts
        }
        5 => {
            let bases = [
                "velocity-verlet",
                "lobatto-3",
                "midpoint",
                "gauss-2",
                "radau-left-2",
            ];
            let weights = list(random, count + 1).join(", ");
            vec![
                (Key::Base, random.pick(&bases).to_owned()),
                (Key::Weights, weights),
            ]
        }
        _ => {
            let fractions = list(random, 2);
            let step = |fraction: &String, random: &mut Random| {
                let definition = definition_of(random, depth - 1);
                format!("[{fraction}, {definition}]")
            };
            let steps: Vec<String> = fractions.iter().map(|x| step(x, random)).collect();
            vec![(Key::Compose, format!("[{}]", steps.join(", ")))]
        }
    };
    for key in [Key::Exchange, Key::Adjoint] {
        if random.one_in(4) {
            parts.push((key, "true".to_owned()));
        }
    }
    parts
}

fn definition_of(random: &mut Random, depth: usize) -> Definition {
    Definition::new(parts(random, depth))
}

/// A definition with extreme constants, which may be refused.
pub fn definition(random: &mut Random) -> Definition {
    definition_of(random, 1)
}

/// What a function gives, and the time that it takes.
///
/// # Panics
/// With the label after the limit, and where the function panics.
pub fn within<T: Send + 'static>(
    limit: Duration,
    label: &str,
    work: impl FnOnce() -> T + Send + 'static,
) -> (T, Duration) {
    let start = Instant::now();
    let (sender, receiver) = mpsc::channel();
    std::thread::spawn(move || sender.send(work()));
    match receiver.recv_timeout(limit) {
        Ok(result) => (result, start.elapsed()),
        Err(mpsc::RecvTimeoutError::Timeout) => {
            panic!("no end after {:?}: {label}", start.elapsed())
        }
        Err(mpsc::RecvTimeoutError::Disconnected) => panic!("panic: {label}"),
    }
}
