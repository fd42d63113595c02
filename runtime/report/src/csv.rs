//! CSV output: a row per run, per verdict, per limit.

use serde::Serialize;

use super::{Curve, Measured, Measurements, Outcome, Parameter, Point, ProblemRecord, Verdict};

/// The columns of a run; missing values are empty.
#[derive(Default, Serialize)]
struct Row<'a> {
    problem: &'a str,
    method: &'a str,
    step_size: Option<f64>,
    tolerance: Option<f64>,
    outcome: &'static str,
    error: Option<f64>,
    energy_error: Option<f64>,
    /// The invariants with their drifts: `angular momentum 1.2e-15; …`.
    drifts: String,
    seconds: Option<f64>,
    repetitions: Option<usize>,
    steps: Option<u64>,
    evaluations: Option<u64>,
    mean_iterations: Option<f64>,
    most_iterations: Option<u32>,
    message: &'a str,
}

impl<'a> Row<'a> {
    fn new(problem: &'a ProblemRecord, curve: &'a Curve, point: &'a Point) -> Self {
        let is = |parameter| (curve.parameter == parameter).then_some(point.parameter);
        let row = Self {
            problem: &problem.name,
            method: &curve.method,
            step_size: is(Parameter::StepSize),
            tolerance: is(Parameter::Tolerance),
            ..Self::default()
        };
        match &point.outcome {
            Outcome::Measured(run) => row.measured(problem, run),
            Outcome::Failed { error } => Self {
                outcome: "failed",
                message: error,
                ..row
            },
            Outcome::Skipped { reason } => Self {
                outcome: "skipped",
                message: reason,
                ..row
            },
        }
    }

    fn measured(self, problem: &ProblemRecord, run: &Measured) -> Self {
        let drifts: Vec<String> = problem
            .invariants
            .iter()
            .zip(&run.drifts)
            .map(|(name, drift)| match drift {
                Some(drift) => format!("{name} {drift:e}"),
                None => format!("{name} not finite"),
            })
            .collect();
        Self {
            outcome: "measured",
            error: Some(run.error),
            energy_error: run.energy_error,
            drifts: drifts.join("; "),
            seconds: Some(run.seconds),
            repetitions: Some(run.repetitions),
            steps: run.steps,
            evaluations: Some(run.evaluations),
            mean_iterations: Some(run.mean_iterations),
            most_iterations: Some(run.most_iterations),
            ..self
        }
    }
}

impl Measurements {
    /// The runs as comma-separated values, a row per run, with a header.
    ///
    /// # Errors
    ///
    /// Those of the writer, which into memory has none.
    pub fn csv(&self) -> Result<String, csv::Error> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for problem in &self.problems {
            for curve in &problem.curves {
                for point in &curve.points {
                    writer.serialize(Row::new(problem, curve, point))?;
                }
            }
        }
        finish(writer)
    }

    /// The [verdicts](Self::verdicts) as comma-separated values, a row per verdict, with a header.
    ///
    /// # Errors
    ///
    /// Those of the writer, which into memory has none.
    pub fn verdicts_csv(&self) -> Result<String, csv::Error> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for table in &self.verdicts {
            for row in &table.rows {
                for (column, cell) in table.columns.iter().zip(&row.cells) {
                    let Some(cell) = cell else { continue };
                    let found = VerdictRow {
                        table: &table.title,
                        problem: &row.problem,
                        method: &column.method,
                        proved_stable: cell.proved_stable,
                        ..VerdictRow::new(&cell.verdict)
                    };
                    writer.serialize(found)?;
                }
            }
        }
        finish(writer)
    }

    /// The [limits](Self::limits) of stability as comma-separated values, a row per method, with a header.
    ///
    /// # Errors
    ///
    /// Those of the writer, which into memory has none.
    pub fn limits_csv(&self) -> Result<String, csv::Error> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for limit in &self.limits {
            writer.serialize(limit)?;
        }
        finish(writer)
    }
}

fn finish(writer: csv::Writer<Vec<u8>>) -> Result<String, csv::Error> {
    let bytes = writer.into_inner().map_err(|error| error.into_error())?;
    // The input consists of Rust strings and digits, so this is lossless.
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// The columns of a verdict; missing values are empty.
#[derive(Default, Serialize)]
struct VerdictRow<'a> {
    table: &'a str,
    problem: &'a str,
    method: &'a str,
    verdict: &'static str,
    error: Option<f64>,
    energy_error: Option<f64>,
    steps: Option<u64>,
    proved_stable: Option<bool>,
    message: &'a str,
}

impl<'a> VerdictRow<'a> {
    fn new(verdict: &'a Verdict) -> Self {
        let row = Self::default();
        match verdict {
            Verdict::Accurate { error } => Self {
                verdict: "accurate",
                error: Some(*error),
                ..row
            },
            Verdict::Bounded { energy, error } => Self {
                verdict: "bounded",
                error: Some(*error),
                energy_error: Some(*energy),
                ..row
            },
            Verdict::Unstable { steps } => Self {
                verdict: "unstable",
                steps: Some(*steps),
                ..row
            },
            Verdict::Stopped { error, .. } => Self {
                verdict: "stopped",
                message: error,
                ..row
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use crate::tests::measurements;

    #[test]
    fn the_csv_has_a_row_for_every_outcome() {
        let csv = measurements().csv().expect("memory takes all");
        expect![[r#"
            problem,method,step_size,tolerance,outcome,error,energy_error,drifts,seconds,repetitions,steps,evaluations,mean_iterations,most_iterations,message
            Kepler & co,Verlet,1.0,,measured,0.01,0.001,angular momentum 1e-4,0.001,5,0,1000,0.0,0,
            Kepler & co,Verlet,0.5,,measured,0.0001,0.00001,angular momentum 1e-6,0.01,5,1,10000,0.0,0,
            Kepler & co,Verlet,0.25,,skipped,,,,,,,,,,it would take about 1 s
            Kepler & co,Gauss 4,2.0,,failed,,,,,,,,,,"the stages did not converge, ""so"" <it> says"
            Kepler & co,Gauss 4,1.0,,measured,0.001,0.0001,angular momentum 1e-5,0.001,5,0,1000,0.0,0,
            Kepler & co,Gauss 4,0.5,,measured,1e-7,1e-8,angular momentum 9.999999999999999e-10,0.002,5,0,2000,0.0,0,
            Kepler & co,Gauss 4,0.25,,measured,1e-13,1e-14,angular momentum 1e-15,0.004,5,0,4000,0.0,0,
            Kepler & co,DOP853,,1.0,measured,0.0001,0.00001,angular momentum 1e-6,0.002,5,0,2000,0.0,0,
            Kepler & co,DOP853,,0.5,measured,1e-10,1.0000000000000001e-11,angular momentum 1e-12,0.01,5,1,10000,0.0,0,
        "#]].assert_eq(&csv);
    }

    #[test]
    fn the_csv_has_a_row_for_every_verdict_and_limit() {
        let csv = measurements().verdicts_csv().expect("memory takes all");
        expect![[r#"
            table,problem,method,verdict,error,energy_error,steps,proved_stable,message
            Stiff & extreme,short,Verlet,accurate,0.00002,,,,
            Stiff & extreme,short,Gauss 4,bounded,0.25,0.5,,false,
            Stiff & extreme,long,Verlet,unstable,,,12,false,
            Stiff & extreme,long,Gauss 4,stopped,,,,,step 1 of size 1 did not converge
            Stiff & extreme,only Gauss,Gauss 4,accurate,0.0,,,,
        "#]]
        .assert_eq(&csv);
        let csv = measurements().limits_csv().expect("memory takes all");
        expect![[r#"
            method,proved,measured
            Verlet,2.0,2.00002
        "#]]
        .assert_eq(&csv);
    }
}
