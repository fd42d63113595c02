//! Random formulas, always the same ones.

use std::fmt::Write as _;

/// Formulas with two coordinates that have names.
pub const NAMED: usize = 28;
/// Formulas with four coordinates that have indices.
pub const INDEXED: usize = 12;

/// A formula: the name of its system, and what stands behind the name.
pub struct Formula {
    pub name: String,
    pub text: String,
}

/// All formulas.
pub fn formulas() -> Vec<Formula> {
    let mut random = Random(2026);
    let named = (0..NAMED).map(|k| Formula {
        name: format!("Named{k}"),
        text: format!(
            "{{ g: 1.25 }} q: [a, b], p: [pa, pb]; H = {}",
            named(&mut random, k)
        ),
    });
    let mut all: Vec<Formula> = named.collect();
    all.extend((0..INDEXED).map(|k| Formula {
        name: format!("Indexed{k}"),
        text: format!(
            "{{ g: 1.25 }} q: [4], p: [4]; H = {}",
            indexed(&mut random, k)
        ),
    }));
    all
}

/// The file with the systems.
pub fn file() -> String {
    let mut file = String::from(
        "//! Random formulas; written by `UPDATE_EXPECT=1 cargo test -p symplectic-tests --test random_formulas`.\n\n\
         use super::Look;\n",
    );
    for Formula { name, text } in formulas() {
        let (parameters, rest) = text.split_once("} ").unwrap_or_default();
        let (coordinates, energy) = rest.split_once("; ").unwrap_or_default();
        let _ = write!(
            file,
            "\nsymplectic::hamiltonian! {{\n    /// A random system.\n    pub {name} {parameters}}}\n    {coordinates};\n    {energy}\n}}\n"
        );
    }
    file.push_str("\n/// Looks at each of them.\npub fn each(look: &mut impl Look) {\n");
    for Formula { name, .. } in formulas() {
        let _ = writeln!(file, "    look.at({name}::default());");
    }
    file.push_str("}\n");
    file
}

/// One of three is separable, so that both kinds of code are emitted.
fn named(random: &mut Random, number: usize) -> String {
    let all = ["a", "b", "pa", "pb", "g"];
    match number % 3 {
        0 => {
            let (kinetic, potential) = (
                random.expression(4, &["pa", "pb", "g"]),
                random.expression(4, &["a", "b", "g"]),
            );
            format!("{kinetic} + pa^2 + pb^2 + {potential} + a b")
        }
        _ => format!("{} + pa^2 + b pb", random.expression(5, &all)),
    }
}

fn indexed(random: &mut Random, number: usize) -> String {
    let alone = random.expression(3, &["q[i]", "p[i]", "g"]);
    let other = match number % 4 {
        0 => format!("sum(i < j: {})", random.expression(3, &["q[i]", "q[j]"])),
        1 => format!(
            "sum(i in 0..3: {})",
            random.expression(3, &["q[i]", "q[i+1]", "p[i+1]"])
        ),
        2 => format!(
            "sum(i: sum(j in 0..i: {}))",
            random.expression(3, &["q[i]", "p[j]", "g"])
        ),
        _ => format!("sin(sum(i: {}))", random.expression(2, &["q[i]", "p[i]"])),
    };
    format!("sum(i: {alone} + p[i]^2) + {other}")
}

/// Numbers by a linear congruence.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % bound
    }

    fn leaf(&mut self, leaves: &[&str]) -> String {
        match self.below(leaves.len() + 2) {
            k if k < leaves.len() => leaves[k].to_owned(),
            k if k == leaves.len() => format!("{}", 1 + self.below(9)),
            _ => format!("0.{}", 1 + self.below(99)),
        }
    }

    /// An expression of at most this depth, regular everywhere.
    fn expression(&mut self, depth: usize, leaves: &[&str]) -> String {
        if depth == 0 {
            return self.leaf(leaves);
        }
        let kind = self.below(17);
        let a = self.expression(depth - 1, leaves);
        match kind {
            0..5 => {
                let b = self.expression(depth - 1, leaves);
                match kind {
                    0 => format!("({a} + {b})"),
                    1 => format!("({a} - {b})"),
                    2 => format!("({a}) ({b})"),
                    3 => format!("(({a})/(2 + sin({b})))"),
                    _ => format!("hypot(1 + ({a})^2, {b})"),
                }
            }
            5 => format!("({a})^{}", 2 + self.below(2)),
            6 => format!("(1 + ({a})^2)^(-3/2)"),
            7 => format!("sqrt(2 + cos({a}))"),
            8 => format!("ln(1 + ({a})^2)"),
            9 => format!("exp(sin({a}))"),
            10 => format!("tanh({a})"),
            11 => format!("atan({a})"),
            12 => format!("sinh(cos({a}))"),
            13 => format!("tan(sin({a}))"),
            14 => format!("asin(sin({a})/2)"),
            15 => format!("atan2({a}, 3 + cos({a}))"),
            _ => format!("acos(cos({a})/3)"),
        }
    }
}
