//! Work-precision diagrams: which method reaches a given accuracy in the least time on your problem.
//!
//! A [`Study`] runs methods on [problems](Problem) with decreasing step sizes. Its result is plain data,
//! [`Measurements`], which [`write`](Measurements::write) turns into a page, plots, tables and files:
//!
//! * the global error at the end, against a [`Reference`];
//! * the largest error of the energy and of other invariants, in a separate, untimed run;
//! * the CPU time of the whole integration: the median of several runs in which the methods take turns, so that changes
//!   in the speed of the machine affect all methods alike;
//! * evaluations of velocities and forces, iterations, and failures: a failed run is shown with its error, and a run
//!   that would exceed the budget is reported as skipped.
//!
//! A separate question is how large the steps of a method can be. A [`Verdict`] classifies a run as accurate, bounded,
//! unstable or stopped. [`Verdicts`] is a table of problems by methods, which [`Measurements::verdicts`] adds to the
//! page and the files.
//!
//! ```
//! use symplectic::nalgebra::Vector1;
//! use symplectic_report::{Kind, Measurements, Problem, Reference, Settings, Study};
//! use symplectic::{Error, State, acceleration};
//!
//! symplectic::tableau! {
//!     Verlet { basis: polynomial(2), nodes: lobatto(2) }
//!     Gauss4 { basis: polynomial(4), nodes: gauss(4) }
//!     Gauss6 { basis: polynomial(6), nodes: gauss(6) }
//! }
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let pendulum = acceleration::<Vector1<f64>, _>(|_time, q, acceleration| acceleration[0] = -q[0].sin())
//!     .with_energy(|_time, q, p| p[0] * p[0] / 2.0 - q[0].cos());
//! let start = State::from_arrays(0.0, [2.0], [0.0]);
//! let reference = Reference::computed(Gauss6, pendulum.clone(), &start, 10.0, 0.05)?;
//! let problem = Problem::new("pendulum", pendulum, start, reference, 1.0)
//!     .method(Verlet)
//!     .method(Gauss4);
//! # let settings = Settings {
//! #     targets: vec![1e-3, 1e-6],
//! #     budget: std::time::Duration::from_secs(60),
//! #     repetitions: symplectic_report::Repetitions { least: 1, most: 1, enough: std::time::Duration::ZERO },
//! # };
//! # let _defaults =
//! Settings::default();
//! let measurements = Study::new("A pendulum").problem(problem).run(&settings, |_progress| {});
//!
//! assert_eq!(measurements.methods[1].kind, Kind::Implicit);
//! assert!(measurements.problems[0].curves[1].cost(1e-6).seconds().is_some());
//! assert_eq!(Measurements::from_json(&measurements.json()?)?, measurements);
//! let page = measurements.page();
//! # assert!(page.contains("<svg"));
//! # Ok(())
//! # }
//! ```

mod best;
mod contestant;
mod csv;
mod files;
mod ladder;
mod measurements;
mod observer;
mod page;
mod plot;
mod problem;
mod roles;
mod study;
mod table;
mod text;
mod timing;
mod verdict;

pub use best::Cost;
pub use contestant::{Finish, Observe};
pub use files::WriteError;
pub use ladder::Ladder;
pub use measurements::{
    Curve, Fact, Kind, Measured, Measurements, MethodRecord, Outcome, Parameter, Point,
    ProblemRecord, Trace,
};
pub use plot::{Plot, Scheme};
pub use problem::{Problem, Reference};
pub use roles::Role;
pub use study::{Advance, Settings, Study};
pub use timing::Repetitions;
pub use verdict::{Cause, Cell, Column, Row, StabilityLimit, Verdict, Verdicts};

#[cfg(test)]
mod tests;
