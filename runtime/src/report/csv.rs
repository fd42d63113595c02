//! One row for each run.

use std::prelude::v1::*;

use serde::Serialize;

use super::{Curve, Measured, Measurements, Outcome, Parameter, Point, ProblemRecord};

/// The columns; what a run does not have is left empty.
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
    /// The runs as comma-separated values, one a row, with a header.
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
        let bytes = writer.into_inner().map_err(|error| error.into_error())?;
        // Rust strings and digits went in.
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    }
}

#[cfg(test)]
mod tests {
    use expect_test::expect;

    use crate::report::tests::measurements;

    #[test]
    fn rows_of_all_outcomes() {
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
}
