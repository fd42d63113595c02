//! The Markdown table, for example for a README.

use super::text;
use super::{Cost, Curve, Kind, Measurements, ProblemRecord};

impl Measurements {
    /// The times for the [targets](Self::targets) as a Markdown table: for each problem the fastest implicit method,
    /// the fastest explicit method, and every peer.
    ///
    /// A time is interpolated between two runs, or that of the first run if it is already accurate enough (≤); `–` if
    /// no run is.
    pub fn table(&self) -> String {
        let errors = self.targets.iter().map(|target| error(*target));
        let mut lines = vec![row(["problem".into(), "method".into()]
            .into_iter()
            .chain(errors))];
        let numbers = self.targets.iter().map(|_| "---:".into());
        lines.push(row(["---".into(), "---".into()].into_iter().chain(numbers)));
        for problem in &self.problems {
            for (index, (label, cells)) in self.rows(problem).into_iter().enumerate() {
                let name = if index == 0 {
                    problem.name.clone()
                } else {
                    String::new()
                };
                lines.push(row([name, label].into_iter().chain(cells)));
            }
        }
        lines.join("\n") + "\n"
    }

    /// The rows of a problem: a label, and a time for each target.
    fn rows(&self, problem: &ProblemRecord) -> Vec<(String, Vec<String>)> {
        let mut rows = Vec::new();
        for (kind, label) in [
            (Kind::Implicit, "best implicit"),
            (Kind::Explicit, "best explicit"),
        ] {
            let best = |target: &f64| match self.fastest_of(kind, problem, *target) {
                Some((curve, found)) => format!("{} ({})", cost(&found), curve.method),
                None => "–".into(),
            };
            if self.curves_of(kind, problem).next().is_some() {
                rows.push((label.into(), self.targets.iter().map(best).collect()));
            }
        }
        for curve in self.curves_of(Kind::Peer, problem) {
            let cells = self.targets.iter().map(|target| cost(&curve.cost(*target)));
            rows.push((curve.method.clone(), cells.collect()));
        }
        rows
    }

    fn curves_of<'a>(
        &'a self,
        kind: Kind,
        problem: &'a ProblemRecord,
    ) -> impl Iterator<Item = &'a Curve> {
        let is_kind =
            move |curve: &&Curve| self.method(&curve.method).is_some_and(|m| m.kind == kind);
        problem.curves.iter().filter(is_kind)
    }
}

fn row(cells: impl Iterator<Item = String>) -> String {
    let cells: Vec<String> = cells.collect();
    format!("| {} |", cells.join(" | "))
}

/// A target error, as 10⁻⁶ if it is a power of ten.
pub(super) fn error(target: f64) -> String {
    let exponent = target.log10().round();
    if (target / 10_f64.powf(exponent) - 1.0).abs() < 1e-9 {
        text::power_of_ten(exponent as i32)
    } else {
        text::scientific(target)
    }
}

/// A time, or a dash.
pub(super) fn cost(cost: &Cost) -> String {
    match cost {
        Cost::Between { seconds } => text::seconds(*seconds),
        Cost::AtMost { seconds } => format!("≤ {}", text::seconds(*seconds)),
        Cost::NotReached { .. } | Cost::NoRun => "–".into(),
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use crate::tests::measurements;

    #[test]
    fn the_table_of_a_small_study_has_the_recorded_text() {
        expect![[r#"
            | problem | method | 10⁻³ | 10⁻⁶ | 10⁻⁹ | 10⁻¹² |
            | --- | --- | ---: | ---: | ---: | ---: |
            | Kepler & co | best implicit | ≤ 1.00 ms (Gauss 4) | 1.68 ms (Gauss 4) | 2.52 ms (Gauss 4) | 3.56 ms (Gauss 4) |
            |  | best explicit | 3.16 ms (Verlet) | – | – | – |
            |  | DOP853 | ≤ 2.00 ms | 3.42 ms | 7.65 ms | – |
        "#]].assert_eq(&measurements().table());
    }
}
