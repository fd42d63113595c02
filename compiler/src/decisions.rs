//! What enclosures decide, compared with the same from eight times as many bits, for definitions with tiny, huge and nearly
//! equal numbers.

use crate::algebra::{Number, StageAlgebra, ZERO_BITS};
use crate::coefficients::Coefficients;
use crate::evidence::Evidence;
use crate::exact::over_algebra;
use crate::order::{HamiltonianClass, OrderOptions, OrderReport, order_of_pair};
use crate::partitioned::Partitioned;
use crate::properties::Properties;
use crate::schedule::{Class, StepGraph};
use crate::stability::Stability;
use crate::{Definition, Limits, Tableau};

#[path = "../tests/methods/extreme/seeds.rs"]
mod seeds;
use seeds::seeds;

const TIMES: u32 = 8;
const BITS: u32 = TIMES * 2048;

/// Numbers in reproducible disorder (Knuth's MMIX).
struct Numbers(u64);

impl Numbers {
    fn new(seed: u64) -> Self {
        Numbers(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15))
    }

    fn below(&mut self, bound: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % bound
    }

    fn one_in(&mut self, bound: usize) -> bool {
        self.below(bound) == 0
    }

    fn of<'a>(&mut self, list: &[&'a str]) -> &'a str {
        list[self.below(list.len())]
    }

    fn weight(&mut self) -> String {
        const SIZES: [&str; 11] = [
            "1", "1", "1/3", "-1/2", "2/7", "1e-30", "1e-280", "1e-300", "1e-400", "1e30",
            "1e-1000",
        ];
        const REALS: [&str; 10] = [
            "1",
            "pi",
            "e",
            "sqrt(2)",
            "(pi - 355/113)",
            "exp(1/3)",
            "sin(1)",
            "(e - 19/7)",
            "(pi - e - 423/1000)",
            "ln(2)",
        ];
        match self.below(6) {
            0 => self.of(&SIZES).to_owned(),
            1 => format!(
                "({} + {}*{})",
                self.of(&REALS),
                self.of(&REALS),
                self.of(&SIZES)
            ),
            _ => format!("{}*{}", self.of(&REALS), self.of(&SIZES)),
        }
    }

    /// Weights that are often consistent, often the same from both ends, and often nearly so.
    fn weights(&mut self, count: usize) -> Vec<String> {
        let mut list: Vec<String> = (0..count).map(|_| self.weight()).collect();
        if self.one_in(3) {
            for i in 0..count / 2 {
                list[count - 1 - i] = list[i].clone();
            }
        }
        if count > 1 && self.one_in(4) {
            list[1] = format!(
                "{} + {}",
                list[0],
                self.of(&["1e-300", "1e-400*pi", "1e-500*e"])
            );
        }
        if count > 1 && !self.one_in(3) {
            let middle = self.below(count);
            let others = list.iter().enumerate().filter(|(i, _)| *i != middle);
            let sum: Vec<String> = others.map(|(_, weight)| format!("({weight})")).collect();
            list[middle] = format!("1 - {}", sum.join(" - "));
        }
        list
    }

    fn definition(&mut self) -> String {
        let count = 1 + self.below(4);
        if self.one_in(4) {
            let count = 1 + self.below(2);
            let rows: Vec<String> = (0..count)
                .map(|_| format!("[{}]", self.weights(count).join(", ")))
                .collect();
            let b = self.weights(count).join(", ");
            return format!("a: [{}], b: [{b}]", rows.join(", "));
        }
        let (kick, drift) = (self.weights(count), self.weights(count));
        format!("kick: [{}], drift: [{}]", kick.join(", "), drift.join(", "))
    }
}

/// Two things that should be the same, as text.
type Difference = (&'static str, String, String);

fn stability_text(found: &Stability) -> String {
    let intervals = found.intervals.iter().map(|i| {
        let ends = [&i.low, &i.high].map(|end| end.decimal(20));
        format!("{ends:?} {:?}", [i.low_closed, i.high_closed])
    });
    let intervals: Vec<String> = intervals.collect();
    let dispersion = found
        .dispersion
        .as_ref()
        .map(|d| (d.order, d.coefficient.value));
    let function = found.runge_kutta.as_ref().map(|f| {
        let flags = [f.a_stable, f.l_stable];
        (
            flags,
            f.imaginary.decimal(20),
            f.at_infinity.as_ref().map(|x| x.value),
        )
    });
    let degrees =
        [&found.trace, &found.determinant].map(|f| (f.numerator.len(), f.denominator.len()));
    format!(
        "{intervals:?} {} {dispersion:?} {function:?} {degrees:?}",
        found.p_stable
    )
}

fn graphs<A: StageAlgebra>(pair: &Partitioned<A>, numbers: &Coefficients<Number<'_>>) -> String {
    let text = |class| {
        let graph = StepGraph::of_pair(class, pair, numbers);
        let values = graph.positions.iter().chain(&graph.momenta);
        let values: Vec<_> = values
            .map(|v| (&v.stages, v.is_end, v.is_start(), &v.applied))
            .collect();
        format!("{:?} {values:?}", graph.schedule())
    };
    text(Class::General) + &text(Class::Separable)
}

fn order_text(report: &OrderReport) -> String {
    let orders = HamiltonianClass::ALL.map(|class| report.class(class).order);
    format!("{orders:?}")
}

/// What wide enclosures decide differently from the reported results, and from usual enclosures alone.
fn compare(tableau: &Tableau) -> Vec<Difference> {
    let undecided = |evidence| matches!(evidence, Evidence::Undecided { .. });
    let options = OrderOptions {
        limit: 4,
        ..OrderOptions::default()
    };
    let mut all: Vec<Difference> = Vec::new();
    over_algebra!(&tableau.exact, pair => {
        let (coarse, fine) = (pair.enclosed(BITS / TIMES), pair.enclosed(BITS));
        let [few, more] = [1, TIMES].map(|times| Stability::with_more_bits(pair, times));
        for stability in [tableau.stability(), few] {
            if !undecided(stability.evidence) && !undecided(more.evidence) {
                all.push(("stability", stability_text(&stability), stability_text(&more)));
            }
        }
        let more = Properties::of_pair(&fine);
        for properties in [tableau.properties(), Properties::of_pair(&coarse)] {
            for ((name, usual), (_, more)) in properties.all().into_iter().zip(more.all()) {
                if !undecided(usual.evidence) && !undecided(more.evidence) {
                    all.push((name, usual.holds.to_string(), more.holds.to_string()));
                }
            }
        }
        let more = graphs(&fine, &fine.numbers());
        for graphs in [graphs(pair, &pair.numbers()), graphs(&coarse, &coarse.numbers())] {
            all.push(("schedule", graphs, more.clone()));
        }
        let more = order_text(&order_of_pair(&fine, &options, None));
        for report in [order_of_pair(pair, &options, None), order_of_pair(&coarse, &options, None)] {
            all.push(("order", order_text(&report), more.clone()));
        }
    });
    all.retain(|(_, usual, more)| usual != more);
    all
}

/// `SYMPLECTIC_SEEDS=0..5000` compares more definitions.
#[test]
#[ignore = "thorough"]
fn stability_decisions_do_not_change_with_eight_times_the_bits() {
    let (mut tried, mut compared, mut open, mut differences) = (0, 0, 0, Vec::new());
    for seed in seeds(0..80) {
        tried += 1;
        let text = Numbers::new(seed).definition();
        // A stage with the weight zero, or a constant out of bounds.
        let Ok(tableau) = Definition::parse(&text).and_then(|d| d.derive(&Limits::default()))
        else {
            continue;
        };
        compared += 1;
        let evidence = tableau.stability().evidence;
        open += usize::from(matches!(evidence, Evidence::Undecided { .. }));
        if let Evidence::Verified { bits } = evidence {
            assert_eq!(bits, ZERO_BITS, "{text}");
        }
        let found = compare(&tableau).into_iter();
        differences.extend(found.map(|(what, usual, more)| {
            format!("seed {seed}: {text}\n  {what}: {usual}\n  not {more}")
        }));
    }
    assert!(differences.is_empty(), "{}", differences.join("\n"));
    // About a third of all definitions have a tableau, and nearly all of these are decided.
    assert!(
        5 * compared > tried && 20 * open <= compared,
        "{compared} of {tried} compared, {open} of these not decided"
    );
}
