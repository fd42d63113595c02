//! Sections: the states at which an expression of the formula language goes through zero.

use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use symplectic::nalgebra::DVector;
use symplectic::system::Class;
use symplectic::{Error as RunError, Event, Hamiltonian, Integrator, Method, State};
use symplectic_compiler::Error;
use symplectic_tape::{At, Formula, Tape, Values};

use crate::expression::Names;
use crate::output::{append, points};
use crate::setup::{Direction, File, Setup};
use crate::trajectory::Trajectory;

/// A section, and the number of its states.
#[derive(Debug)]
pub(super) struct Section {
    tape: Tape,
    direction: Direction,
    /// The number of states that may be kept.
    most: usize,
    found: Arc<AtomicUsize>,
}

impl Section {
    /// Reads the section, if there is one.
    pub(super) fn read(
        file: &File<'_>,
        setup: &Setup,
        values: &Values,
        most: usize,
    ) -> Result<Option<Self>, Error> {
        let Some(section) = &setup.section else {
            return Ok(None);
        };
        let (span, direction) = (section.span(), section.get_ref().direction);
        if setup.times.is_some() {
            return Err(file.error(
                span,
                "both `times` and `section` are given: give `end` with the section",
            ));
        }
        let (span, of) = (section.get_ref().of.span(), section.get_ref().of.get_ref());
        let names = Names {
            file,
            setup,
            values,
            further: &[],
        };
        Ok(Some(Self {
            tape: names.tape("of", of, span)?,
            direction,
            most,
            found: Arc::default(),
        }))
    }

    /// Counts the states that an interrupted run found.
    pub(super) fn count(&self, rows: &[Trajectory]) {
        let found = rows.iter().map(|row| points(row).count()).sum();
        self.found.store(found, Ordering::Relaxed);
    }

    /// Integrates to `end` and appends the states of the section; ends early if all trajectories have too many.
    pub(super) fn see<M, C, R, N, const F: bool>(
        &self,
        seen: &mut Vec<f64>,
        run: &mut Integrator<M, Formula<C, F>, DVector<f64>, R, N>,
        end: f64,
    ) -> Result<(), RunError>
    where
        M: Method,
        C: Class,
        Formula<C, F>: Hamiltonian<Vector<f64> = DVector<f64>>,
        R: symplectic::Summation,
        N: symplectic::emitted::Solver<DVector<f64>, Formula<C, F>>,
    {
        let parameters = run.system().parameters().clone();
        let value = |state: &State<DVector<f64>>| {
            let (q, p) = state.as_slices();
            self.tape.value(At {
                parameters: &parameters,
                time: state.time,
                q,
                p,
            })
        };
        let event = match self.direction {
            Direction::Rising => Event::rising(value),
            Direction::Falling => Event::falling(value),
            Direction::Both => Event::crossing(value),
        };
        let keep = |state: &State<_>| {
            if self.found.fetch_add(1, Ordering::Relaxed) >= self.most {
                return ControlFlow::Break(());
            }
            append(seen, state);
            ControlFlow::Continue(())
        };
        run.integrate_with_events(end, &event.by_steps(), keep)
            .map(|_| seen.shrink_to_fit())
    }

    /// Whether there are more states than may be kept.
    pub(super) fn is_full(&self) -> impl Fn() -> bool + Send + Sync + use<> {
        let (found, most) = (Arc::clone(&self.found), self.most);
        move || found.load(Ordering::Relaxed) > most
    }

    /// The number of states that may be kept.
    pub(super) fn most(&self) -> usize {
        self.most
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use symplectic::{Integrator, Separable, State};
    use symplectic_compiler::expression::Input;
    use symplectic_formula::{Form, Structure, System};
    use symplectic_tape::{Formula, Parameters, Tape, Tapes, Values};

    use crate::Section;
    use crate::setup::Direction;

    symplectic::tableau! { Verlet { base: velocity-verlet } }

    #[test]
    fn a_run_ends_where_no_more_states_can_be_kept() {
        let formula = "Oscillator q: [x], p: [px]; H = px^2/2 + x^2/2";
        let mut system = System::read_as(Form::Hamiltonian, "", formula).expect("a formula");
        let structure = Structure::of(&mut system);
        let values = Values::of_bodies(1);
        let tapes = Arc::new(Tapes::new(&mut system, &structure, &values, 0.0).expect("tapes"));
        let x = Input {
            name: "x",
            text: "x",
        };
        let read = System::read_with(Form::Hamiltonian, formula, &[], x);
        let (system, x) = read.expect("an expression");
        let tape = Tape::of_value(&system, &values, x[0], None).expect("a tape");
        let section = Section {
            tape,
            direction: Direction::Both,
            most: 5,
            found: Arc::default(),
        };
        let mut seen = Vec::new();
        // Three crossings each; of the second run two are kept.
        for (states, is_full) in [(3, false), (5, true)] {
            let system = Formula::<Separable>::new(Arc::clone(&tapes), Parameters::none());
            let start = State::new(0.0, vec![1.0].into(), vec![0.0].into());
            let mut run = Integrator::new(Verlet, system, start, 0.1).expect("a start");
            section.see(&mut seen, &mut run, 10.0).expect("steps");
            assert_eq!((seen.len() / 3, section.is_full()()), (states, is_full));
        }
    }
}
