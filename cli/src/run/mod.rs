//! `symplectic run`

mod advice;
mod keys;
mod memory;
mod method;
mod output;
mod parameters;
mod progress;
mod random;
mod section;
mod setup;
mod spec;
mod starts;
mod system;
mod table;
mod tape;
mod target;
mod unroll;
mod values;

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use clap::Args;
use symplectic::ensemble::{Ensemble, EnsembleError, Row};
use symplectic::nalgebra::DVector;
use symplectic::output::Interpolation;
use symplectic::system::Conservative;
use symplectic::{
    AtRunTime, Class, Compensated, Error as RunError, General, Hamiltonian, Integrator, Plain,
    Separable, State, Summation,
};
use symplectic_compiler::export::read_text;
use symplectic_compiler::formula::{Form, Structure, System};
use symplectic_compiler::{Error, ErrorKind};
use toml::Spanned;

use self::method::Method;
use self::output::{Facts, Results, Seen, Trajectory, append};
use self::progress::Progress;
use self::section::Section;
use self::setup::{File, Setup, Starts, Sums};
use self::starts::{Coordinates, Reader, Start};
use self::system::{Formula, Tapes};
use self::tape::Parameters;
use self::target::Target;
use self::unroll::{MOST_STEPS, Refusal};
use crate::output::print;

/// Integrate an ensemble of trajectories of a system given by its formula.
///
/// A TOML file contains the formula, the method, the step size, the starts and the output file; see "Runs from a file"
/// in the book.
#[derive(Args)]
pub(crate) struct Arguments {
    /// The TOML file.
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// Run only part I of N, from 0: `--shard 0/4`. The name of the output contains the part.
    #[arg(long, value_name = "I/N", value_parser = shard)]
    shard: Option<Shard>,
    /// Number of threads [default: one per core]. The results do not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    threads: Option<u16>,
    /// Largest number of stages of the method [default: 36].
    #[arg(long, value_name = "S", value_parser = clap::value_parser!(u16).range(1..=1000))]
    max_stages: Option<u16>,
}

/// One of several parts.
#[derive(Debug, Clone, Copy)]
struct Shard {
    part: usize,
    count: usize,
}

fn shard(text: &str) -> Result<Shard, String> {
    let parts = text.split_once('/');
    let numbers = parts.and_then(|(part, count)| Some((part.parse().ok()?, count.parse().ok()?)));
    numbers
        .filter(|(part, count)| part < count)
        .map(|(part, count)| Shard { part, count })
        .ok_or_else(|| "expected a part and a number of parts, such as 0/4, up to 3/4".to_owned())
}

type Vector = DVector<f64>;
type States = Vec<State<Vector>>;

/// A run, except for the types that depend on the formula.
struct Run<'a> {
    file: &'a File<'a>,
    setup: &'a Setup,
    method: &'a Method,
    coordinates: &'a Coordinates,
    tapes: Arc<Tapes>,
    times: Option<Vec<f64>>,
    section: Option<Section>,
    shard: Option<Shard>,
    target: Target,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let text = read_text(&arguments.file)?;
    let file = File {
        path: &arguments.file,
        text: &text,
    };
    let setup = file.read()?;
    let (mut system, structure) = read_system(&file, &setup)?;
    let method = Method::read(&file, &setup, arguments.max_stages)?;
    let times = times(&file, &setup)?;
    parameters::check_names(&file, &setup, &system)?;
    let reader = Reader {
        file: &file,
        system: &system,
        setup: &setup,
    };
    let (coordinates, starts) = reader.read()?;
    let bodies = coordinates.dimension() / system.layout.components().max(1);
    let values = parameters::read(&file, &setup, &system, bodies, &coordinates.parameters)?;
    let tapes = Tapes::new(&mut system, &structure, &values).map_err(|refusal| {
        let message = match refusal {
            Refusal::TooLong => format!(
                "with its sums written out, the formula has more than {MOST_STEPS} operations: take fewer bodies, or write a program with the macro `hamiltonian!`"
            ),
            Refusal::Outside => "an index in the formula is out of range: that coordinate or entry of a parameter does not exist".to_owned(),
        };
        file.error(setup.system.span(), message)
    })?;
    if let Some(threads) = arguments.threads {
        // The global pool can be set only once per process, and this is the only call.
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into());
        pool.build_global()
            .map_err(|error| document(format!("cannot start the threads: {error}")))?;
    }
    let path = named(file.beside(setup.output.file.get_ref()), arguments.shard);
    refuse_overwriting(&file, &setup, &path)?;
    refuse_twins(&file, &setup, &coordinates, &path)?;
    let size = (starts.len(), coordinates.with_parameters().count());
    if let Some(fault) = memory::fault_of_starts(size.0, size.1) {
        return Err(file.error(setup.starts.span(), fault));
    }
    if let (Some(given), Some(times)) = (&setup.times, &times) {
        let states = (times.len(), coordinates.dimension());
        let parts = arguments.shard.map_or(1, |shard| shard.count);
        if let Some(fault) = memory::fault_of_states(size, states, parts) {
            return Err(file.error(given.span(), fault));
        }
    }
    let most = memory::most_states(size, coordinates.dimension());
    let section = Section::read(&file, &setup, &values, most)?;
    let run = Run {
        file: &file,
        setup: &setup,
        method: &method,
        coordinates: &coordinates,
        tapes: Arc::new(tapes),
        times,
        section,
        shard: arguments.shard,
        target: Target::open(path)?,
    };
    match structure.split {
        Ok(_) => run.with_class::<Separable>(starts),
        Err(_) => run.with_class::<General>(starts),
    }
}

/// Refuses an output that would overwrite the starts.
fn refuse_overwriting(file: &File<'_>, setup: &Setup, output: &Path) -> Result<(), Error> {
    let Starts::File(name) = setup.starts.get_ref() else {
        return Ok(());
    };
    let (starts, output) = (file.beside(name).canonicalize(), output.canonicalize());
    match (starts, output) {
        (Ok(starts), Ok(output)) if starts == output => Err(file.error(
            setup.output.file.span(),
            "the output would overwrite the file of the starts: give another name",
        )),
        _ => Ok(()),
    }
}

/// Refuses a table in which two columns would have the same name.
fn refuse_twins(
    file: &File<'_>,
    setup: &Setup,
    coordinates: &Coordinates,
    output: &Path,
) -> Result<(), Error> {
    let is_table = (output.extension()).is_some_and(|extension| extension != "npz");
    match table::twin(coordinates, setup.section.is_some()) {
        Some(name) if is_table => {
            let message = format!(
                "two columns of the table would have the name `{name}`: give the coordinate or the parameter another name, or write a `.npz` file"
            );
            Err(file.error(setup.output.file.span(), message))
        }
        _ => Ok(()),
    }
}

/// The name of the output, with the part if there is one: `orbits.0-of-4.npz`.
fn named(path: PathBuf, shard: Option<Shard>) -> PathBuf {
    match (
        shard,
        path.extension().and_then(|extension| extension.to_str()),
    ) {
        (Some(Shard { part, count }), Some(extension)) => {
            path.with_extension(format!("{part}-of-{count}.{extension}"))
        }
        _ => path,
    }
}

/// The system of the formula, which must have no constraints, friction or applied forces.
fn read_system(file: &File<'_>, setup: &Setup) -> Result<(System, Structure), Error> {
    let (span, text) = (setup.system.span(), setup.system.get_ref());
    let name = format!("`system` in {}", file.path.display());
    let placed = |error| file.inside(span.clone(), text, error);
    let mut system = System::read_as(Form::of(text), &name, text).map_err(placed)?;
    let structure = Structure::of(&mut system);
    system.check(&structure, text).map_err(placed)?;
    let refused = if system.without_hamiltonian().is_some() {
        Some("a Lagrangian that is not quadratic in the velocities")
    } else if !system.functions.is_empty() {
        Some("functions that are written in Rust")
    } else if !system.is_free() {
        Some("constraints, friction and applied forces")
    } else {
        None
    };
    match refused {
        Some(what) => Err(file.error(
            span,
            format!("`symplectic run` does not support {what}: write a program with the macros, as the book describes"),
        )),
        None => Ok((system, structure)),
    }
}

/// Largest exact number of steps.
const MOST_STEPS_OF_A_RUN: f64 = (1_u64 << f64::MANTISSA_DIGITS) as f64;

/// The output times; `None` for the end only.
fn times(file: &File<'_>, setup: &Setup) -> Result<Option<Vec<f64>>, Error> {
    let (size, start) = (*setup.step_size.get_ref(), setup.start());
    if !size.is_finite() || size == 0.0 {
        let message = format!(
            "the step size is {size:?}: it must be finite, and not zero; negative to go backward"
        );
        return Err(file.error(setup.step_size.span(), message));
    }
    if let Some(given) = &setup.start_time
        && !start.is_finite()
    {
        let message = format!("`start_time` is {start}: it must be finite");
        return Err(file.error(given.span(), message));
    }
    let behind = |time: f64| !time.is_finite() || (time - start) * size < 0.0;
    let refused = |time: f64, span| {
        let message = format!(
            "the run cannot reach the time {time:?}: it starts at {start:?} with the step size {size:?}"
        );
        Err(file.error(span, message))
    };
    let too_many = |time: f64| ((time - start) / size).abs() > MOST_STEPS_OF_A_RUN;
    let refused_as_too_many = |time: f64, span| {
        let message =
            format!("from {start:?} to {time:?} there are more than 2^53 steps of {size:?}");
        Err(file.error(span, message))
    };
    match (&setup.end, &setup.times) {
        (Some(end), None) => match *end.get_ref() {
            time if behind(time) => refused(time, end.span()),
            time if too_many(time) => refused_as_too_many(time, end.span()),
            _ => Ok(None),
        },
        (None, Some(times)) => {
            let span = times.span();
            let list = (times.get_ref().list())
                .map_err(|message| file.error(span.clone(), format!("`times`: {message}")))?;
            if let Some(&time) = list.iter().find(|time| behind(**time)) {
                return refused(time, span);
            }
            if let Some(&time) = list.last().filter(|time| too_many(**time)) {
                return refused_as_too_many(time, span);
            }
            let mut pairs = list.windows(2);
            match pairs.find(|pair| (pair[1] - pair[0]) * size < 0.0) {
                Some(pair) => {
                    let message = format!(
                        "`times` goes back from {:?} to {:?}: sort the times in the direction of the steps of {size:?}",
                        pair[0], pair[1]
                    );
                    Err(file.error(span, message))
                }
                None if list.is_empty() => Err(file.error(span, "`times` is empty: give at least one time")),
                None => Ok(Some(list)),
            }
        }
        (None, None) => Err(document(format!(
            "{}: there is no end: give `end`, or `times` at which states are written",
            file.path.display()
        ))),
        (Some(_), Some(times)) => Err(file.error(
            times.span(),
            "both `end` and `times` are given: give `end` for the final state only, or `times` for the states at these times",
        )),
    }
}

impl Run<'_> {
    fn with_class<C: Class + Conservative>(self, starts: Vec<Start>) -> Result<ExitCode, Error>
    where
        Formula<C>: Hamiltonian<Class = C, Vector<f64> = Vector>,
    {
        match self.setup.sums {
            Sums::Compensated => self.integrate::<C, Compensated>(starts),
            Sums::Plain => self.integrate::<C, Plain>(starts),
        }
    }

    fn integrate<C: Class + Conservative, R: Summation>(
        self,
        starts: Vec<Start>,
    ) -> Result<ExitCode, Error>
    where
        Formula<C>: Hamiltonian<Class = C, Vector<f64> = Vector>,
    {
        let mut parameters: Vec<Vec<f64>> = Vec::new();
        let mut families: Vec<(Formula<C>, States)> = Vec::new();
        let same_bits = |a: &[f64], b: &[f64]| {
            let bits = |x: &f64| x.to_bits();
            a.iter().map(bits).eq(b.iter().map(bits))
        };
        for start in starts {
            let before = parameters.last();
            let is_of_family = before.is_some_and(|before| same_bits(before, &start.parameters));
            match families.last_mut() {
                Some((_, family)) if is_of_family => {
                    family.push(start.state);
                }
                _ => {
                    let own = Parameters::Own(start.parameters.as_slice().into());
                    let system = Formula::new(Arc::clone(&self.tapes), own);
                    families.push((system, vec![start.state]));
                }
            }
            parameters.push(start.parameters);
        }
        let size = *self.setup.step_size.get_ref();
        let made: Result<Ensemble<AtRunTime, _, Vector, R>, _> =
            Ensemble::families_at_run_time(&self.method.tableau, families, size);
        let mut ensemble = made.map_err(|error| self.refused(&error))?;
        if let Some(Shard { part, count }) = self.shard {
            ensemble = ensemble
                .shard(part, count)
                .map_err(|error| self.refused(&error))?;
        }
        let progress = Progress::new(ensemble.trajectories().len());
        let mut rows: Vec<Trajectory> = Vec::with_capacity(ensemble.trajectories().len());
        let keep = |mut row: Trajectory| {
            row.outcome = row.outcome.map_err(advice::without_calls);
            rows.push(row);
            progress.trajectory();
            ControlFlow::Continue(())
        };
        let start = self.setup.start();
        let end = (self.setup.end.as_ref()).map_or(start, |end| *end.get_ref());
        match (&self.times, &self.section) {
            (None, Some(section)) => {
                ensemble.stop_if(section.is_full());
                let at = |time: f64| progress.within((time - start) / (end - start));
                let see = |seen: &mut Vec<f64>, run: &mut _| section.see(seen, run, end, at);
                ensemble.each(|_| Vec::new(), see, keep);
                if section.is_full()() {
                    progress.finish();
                    let fault =
                        memory::fault_of_section(section.most(), ensemble.trajectories().len());
                    let given = self.setup.section.as_ref().map_or(0..0, Spanned::span);
                    return Err(self.file.error(given, fault));
                }
            }
            (Some(times), _) => {
                let numbers = times.len() * (1 + 2 * self.coordinates.dimension());
                let last = times.last().map_or(start, |last| *last);
                let see = |seen: &mut Vec<f64>, state: &State<Vector>| {
                    append(seen, state);
                    progress.within((state.time - start) / (last - start));
                };
                ensemble.integrate_at(times, |_| Vec::with_capacity(numbers), see, keep);
            }
            (None, None) => {
                let mut keep = keep;
                let keep = |row: Row<Vector>| {
                    keep(Trajectory {
                        trajectory: row.trajectory,
                        outcome: row.outcome,
                        state: row.state,
                        statistics: row.statistics,
                        output: Vec::new(),
                    })
                };
                match progress.is_single() {
                    false => ensemble.integrate_to(end, keep),
                    true => {
                        let to_end = |(): &mut (), run: &mut Integrator<_, _, _, R>| {
                            let shown = run.integrate_while(end, |done| {
                                progress.within(done.fraction());
                                ControlFlow::<()>::Continue(())
                            });
                            shown.map(|_| ())
                        };
                        ensemble.each(|_| (), to_end, keep)
                    }
                };
            }
        }
        progress.finish();
        let orders = self.method.tableau.orders();
        let results = Results {
            coordinates: self.coordinates,
            facts: Facts {
                method: self.method.tableau.name(),
                definition: &self.method.definition,
                orders: [orders.general, orders.separable, orders.nystrom].map(u64::from),
                step_size: *self.setup.step_size.get_ref(),
                sums: match self.setup.sums {
                    Sums::Compensated => "compensated",
                    Sums::Plain => "plain",
                },
                formula: self.setup.system.get_ref(),
                setup: self.file.text,
            },
            tapes: &self.tapes,
            rows: &rows,
            starts: ensemble.starts(),
            parameters: &parameters,
            seen: match (&self.times, &self.section) {
                (Some(times), _) => Seen::Times(times),
                (None, Some(_)) => Seen::Section,
                (None, None) => Seen::End,
            },
        };
        let failed = rows.iter().filter(|row| row.outcome.is_err()).count();
        let mut message = format!(
            "{} trajectories, {failed} failed: {}\n",
            rows.len(),
            self.target.path().display()
        );
        let first = rows
            .iter()
            .find_map(|row| row.outcome.as_ref().err().map(|error| (row, error)));
        if let Some((row, error)) = first {
            message.push_str(&format!("trajectory {}: {error}\n", row.trajectory));
            message.extend(advice::note(error));
        }
        message.extend(self.note_on_times(C::SEPARABLE));
        self.target.write(&results)?;
        let printed = print(&message)?;
        Ok(match failed > 0 && failed == rows.len() {
            true => ExitCode::from(1),
            false => printed,
        })
    }

    /// What to know about output times inside steps, if the method has a higher order than their interpolation.
    fn note_on_times(&self, is_separable: bool) -> Option<String> {
        let size = *self.setup.step_size.get_ref();
        let is_inside = |time: &f64| {
            let steps = (time - self.setup.start()) / size;
            (steps - steps.round()).abs() > 1e-9 * steps.abs().max(1.0)
        };
        let orders = self.method.tableau.orders();
        let order = if is_separable {
            orders.separable
        } else {
            orders.general
        };
        let inside = self
            .times
            .as_ref()?
            .iter()
            .filter(|time| is_inside(time))
            .count();
        (inside > 0 && order > INTERPOLATION).then(|| {
            format!(
                "note: {inside} of the `times` are inside steps, where states are interpolated with order {INTERPOLATION}; the method has order {order} at multiples of `step_size`\n"
            )
        })
    }

    /// Translates an error of the ensemble into the terms of the file.
    fn refused(&self, error: &EnsembleError) -> Error {
        let accept = "take another method (`symplectic list --class …`), or write `accept_lower_order = true`";
        let span = self.setup.method.span();
        let name = self.method.tableau.name();
        match error {
            EnsembleError::Start {
                error: RunError::NotQuadraticKinetic { order, lower_order, .. },
                ..
            } => self.file.error(
                span,
                format!("`{name}` has order {order} if the kinetic energy is quadratic in the momenta, but for this H only {lower_order}: {accept}"),
            ),
            EnsembleError::All(RunError::SeparableTableau { order, lower_order }) => self.file.error(
                span,
                format!("H is not separable: `{name}` has order {order} for separable H only, and for this H it has order {lower_order} or is not symplectic: {accept}"),
            ),
            other => self.file.error(self.setup.starts.span(), other.to_string()),
        }
    }
}

/// The order of states inside steps.
const INTERPOLATION: u32 = Interpolation::Hermite.order();

fn document(message: String) -> Error {
    ErrorKind::Document { message }.into()
}

/// `1 entry`, `2 entries`
fn counted(count: usize, one: &str, many: &str) -> String {
    let what = if count == 1 { one } else { many };
    format!("{count} {what}")
}
