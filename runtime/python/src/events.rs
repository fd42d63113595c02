//! Events that are given by expressions.

use pyo3::prelude::*;
use symplectic::nalgebra::DVector;
use symplectic::{Event, State};
use symplectic_formula::graph::Half;
use symplectic_tape::{At, Parameters, Tape};

use crate::errors;
use crate::problem::Problem;

/// An event as Python gives it: expression, direction, whether it is a wall, points of each step at which it is evaluated, assignments, and
/// the count at which the run ends.
pub(crate) type Given = (
    String,
    String,
    bool,
    Option<u32>,
    Vec<(String, String)>,
    Option<u64>,
);

/// Events of a run.
pub(crate) struct Events(Vec<Own>);

struct Own {
    function: Tape,
    direction: Direction,
    wall: bool,
    samples: Option<u32>,
    /// New values of coordinates.
    set: Vec<(Half, usize, Tape)>,
    last: Option<u64>,
}

#[derive(Clone, Copy, PartialEq)]
enum Direction {
    Rising,
    Falling,
    Both,
}

/// The function of an event.
pub(crate) type Function<'a> = Box<dyn Fn(&State<DVector<f64>>) -> f64 + 'a>;

impl Events {
    pub(crate) fn new(problem: &Problem, given: Vec<Given>) -> PyResult<Self> {
        let mut all = Vec::new();
        for (text, direction, wall, samples, assignments, last) in given {
            let direction = match &direction[..] {
                "rising" => Direction::Rising,
                "falling" => Direction::Falling,
                "both" => Direction::Both,
                _ => {
                    return Err(errors::argument(format!(
                        "unknown direction `{direction}`; known here: rising, falling, both"
                    )));
                }
            };
            if problem.tapes.has_friction() && !assignments.is_empty() {
                return Err(errors::argument(
                    "events cannot change the state of a system with `friction`: write the friction as a force",
                ));
            }
            let mut set = Vec::new();
            for (target, value) in assignments {
                let (half, place) = problem.coordinate("set", &target)?;
                set.push((half, place, problem.expression("set", &value)?));
            }
            all.push(Own {
                function: problem.expression("event", &text)?,
                direction,
                wall,
                samples,
                set,
                last,
            });
        }
        Ok(Events(all))
    }

    /// The number of evaluations in every step.
    pub(crate) fn looks(&self) -> f64 {
        let samples = self.0.iter().map(|own| own.samples.unwrap_or(8));
        samples.map(f64::from).sum()
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The events for a search, with the parameters of a trajectory.
    pub(crate) fn list<'a>(&'a self, parameters: &'a Parameters) -> Vec<Event<Function<'a>>> {
        let event = |own: &'a Own| {
            let value: Function<'a> =
                Box::new(move |state| own.function.value(at(parameters, state)));
            let event = match own.direction {
                _ if own.wall => Event::wall(value),
                Direction::Rising => Event::rising(value).by_steps(),
                Direction::Falling => Event::falling(value).by_steps(),
                Direction::Both => Event::crossing(value).by_steps(),
            };
            match own.samples {
                Some(samples) => event.samples(samples),
                None => event,
            }
        };
        self.0.iter().map(event).collect()
    }

    /// Sets the coordinates that an event changes, all from the state before.
    pub(crate) fn change(
        &self,
        index: usize,
        parameters: &Parameters,
        state: &mut State<DVector<f64>>,
    ) {
        let set = &self.0[index].set;
        let values: Vec<f64> = set
            .iter()
            .map(|(.., tape)| tape.value(at(parameters, state)))
            .collect();
        for ((half, place, _), value) in set.iter().zip(values) {
            match half {
                Half::P => state.p[*place] = value,
                _ => state.q[*place] = value,
            }
        }
    }

    /// Whether the run ends with this occurrence of an event, counted from 1.
    pub(crate) fn ends(&self, index: usize, count: u64) -> bool {
        self.0[index].last.is_some_and(|last| count >= last)
    }
}

fn at<'a>(parameters: &'a Parameters, state: &'a State<DVector<f64>>) -> At<'a, f64> {
    let (q, p) = state.as_slices();
    At {
        parameters,
        time: state.time,
        q,
        p,
    }
}
