//! The command `symplectic run`: trajectories of a formula in a file.
//!
//! [`command`] is the command; [`method`] turns a derived method into one that takes steps.

mod advice;
mod chaos;
mod derived;
mod expression;
mod integrate;
mod keys;
mod memory;
pub mod method;
mod output;
mod parameters;
mod progress;
mod random;
mod resume;
mod section;
mod setup;
mod spec;
mod starts;
mod summary;
mod surface;
mod table;
mod target;
mod trajectory;

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

use clap::Parser;
use symplectic_compiler::export::read_text;
use symplectic_compiler::{Error, ErrorKind};
use symplectic_formula::{Form, Structure, System};
use symplectic_tape::{MAX_OPERATIONS, Refusal, Tapes};
use symplectic_terminal::errors;

use crate::derived::{Completed, Completion};
use crate::expression::Names;
use crate::integrate::Kind;
use crate::method::Method;
use crate::section::Section;
use crate::setup::{File, Setup, Starts};
use crate::starts::{Coordinates, Reader};
use crate::target::Target;

/// Integrate an ensemble of trajectories of a system given by its formula.
///
/// A TOML file contains the formula, the method, the step size, the starts and the output file; see "Runs from a file"
/// in the book.
#[derive(Parser)]
#[command(name = "symplectic-run", bin_name = "symplectic run", version)]
struct Arguments {
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
    /// Continue an interrupted run, whose finished trajectories are in `OUTPUT.resume`; without this file, start from the beginning.
    #[arg(long)]
    resume: bool,
    /// Seconds between two times at which finished trajectories are saved.
    #[arg(long, value_name = "SECONDS", default_value = "10", value_parser = clap::value_parser!(u32))]
    save_every: u32,
    /// Write the progress to standard error every ten seconds, even if it is not a terminal.
    #[arg(long)]
    progress: bool,
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

/// A run, except for the types that depend on the formula.
struct Run<'a> {
    file: &'a File<'a>,
    setup: &'a Setup,
    method: &'a Method,
    coordinates: &'a Coordinates,
    tapes: Arc<Tapes>,
    times: Option<Vec<f64>>,
    section: Option<Section>,
    arguments: &'a Arguments,
    /// The number of starts that are left out.
    skipped: usize,
    target: Target,
}

/// Runs the command with the arguments of a command line, whose first one is the name of the program. The exit status is 0 for success, 1 if
/// all trajectories fail, 2 for invalid input. Wrong arguments end the process.
pub fn command(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    errors::exit_code(run(&Arguments::parse_from(arguments)))
}

fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let text = read_text(&arguments.file)?;
    let file = File {
        path: &arguments.file,
        text: &text,
    };
    let setup = file.read()?;
    let (mut system, structure) = read_system(&file, &setup)?;
    let method = Method::read(&file, &setup, &system, arguments.max_stages)?;
    let times = times(&file, &setup)?;
    if let Some(megno) = &setup.megno
        && (times.is_some() || setup.section.is_some())
    {
        let message = "MEGNO is computed at the end only: give `end` without `times` and `section`";
        return Err(file.error(megno.span(), message));
    }
    refuse_combinations(&file, &setup, &system, &method)?;
    let kind = Kind::of(&system, &structure);
    if let Some(solver) = &setup.solver
        && kind.is_separable
        && method.tableau.is_explicit()
    {
        let message = format!(
            "`{}` is explicit for this H, so its stages need no iteration: leave out `solver`, or take an implicit method",
            method.tableau.name()
        );
        return Err(file.error(solver.span(), message));
    }
    if let Some(project) = &setup.project_starts
        && !system.is_constrained()
    {
        let message = "the system has no constraints, so starts are not projected: leave out `project_starts`";
        return Err(file.error(project.span(), message));
    }
    if let Some(bound) = &setup.warn_energy_error
        && (bound.get_ref().is_nan() || *bound.get_ref() < 0.0)
    {
        let message = format!(
            "`warn_energy_error` is {}: it must be a number from 0, or `inf` for no warning",
            bound.get_ref()
        );
        return Err(file.error(bound.span(), message));
    }
    parameters::check_names(&file, &setup, &system)?;
    let reader = Reader {
        file: &file,
        system: &system,
        setup: &setup,
    };
    let (coordinates, given) = reader.read()?;
    let bodies = coordinates.dimension() / system.layout.components().max(1);
    let values = parameters::read(&file, &setup, &system, bodies, &coordinates.parameters)?;
    let tapes = Tapes::new(&mut system, &structure, &values, setup.start()).map_err(|refusal| {
        let message = match refusal {
            Refusal::TooLong => format!(
                "with its sums written out, the formula has more than {MAX_OPERATIONS} operations: take fewer bodies, or write a program with the macro `hamiltonian!`"
            ),
            Refusal::Outside => "an index in the formula is out of range: that coordinate or entry of a parameter does not exist".to_owned(),
        };
        file.error(setup.system.span(), message)
    })?;
    let further = parameters::further(&file, &setup, &system, &coordinates)?;
    let completion = Completion {
        file: &file,
        setup: &setup,
        coordinates: &coordinates,
        names: Names {
            file: &file,
            setup: &setup,
            values: &values,
            further: &further,
        },
        tapes: &tapes,
    };
    let Completed { starts, skipped } = completion.complete(given)?;
    if let Some(threads) = arguments.threads {
        // The global pool can be set only once per process, and this is the only call.
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into());
        pool.build_global()
            .map_err(|error| document(format!("cannot start the threads: {error}")))?;
    }
    let path = named(file.beside(setup.output.file.get_ref()), arguments.shard);
    refuse_overwriting(&file, &setup, &path)?;
    let further = output::further(&tapes, setup.megno.is_some());
    refuse_twins(&file, &setup, &coordinates, &further, &path)?;
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
        arguments,
        skipped,
        target: Target::open(path).map_err(|error| file.placed(setup.output.file.span(), error))?,
    };
    run.of_kind(kind, starts)
}

/// Refuses what is not defined with friction, applied forces or constraints.
fn refuse_combinations(
    file: &File<'_>,
    setup: &Setup,
    system: &System,
    method: &Method,
) -> Result<(), Error> {
    let with = [
        (!system.friction.is_empty(), "friction"),
        (!system.applied.is_empty(), "applied forces"),
        (system.is_constrained(), "constraints"),
    ];
    if let Some(megno) = &setup.megno
        && let Some((_, with)) = with.iter().find(|(is_given, _)| *is_given)
    {
        let message = format!("MEGNO is computed without {with} only: leave out `megno`");
        return Err(file.error(megno.span(), message));
    }
    if let Some(solver) = &setup.solver
        && system.is_constrained()
    {
        let message = "steps with constraints have an iteration of their own: leave out `solver`";
        return Err(file.error(solver.span(), message));
    }
    if system.friction.is_empty() {
        return Ok(());
    }
    let orders = method.tableau.orders();
    if orders.nystrom > orders.separable && !setup.accept_lower_order {
        let message = format!(
            "`{}` has order {} without friction, but only {} with it: take another method, or write `accept_lower_order = true`",
            method.tableau.name(),
            orders.nystrom,
            orders.separable
        );
        return Err(file.error(setup.method.span(), message));
    }
    Ok(())
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
    further: &[String],
    output: &Path,
) -> Result<(), Error> {
    let is_table = (output.extension()).is_some_and(|extension| extension != "npz");
    match table::twin(coordinates, setup.section.is_some(), further) {
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

/// The system of the formula.
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
const MAX_STEPS_OF_A_RUN: f64 = (1_u64 << f64::MANTISSA_DIGITS) as f64;

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
    let too_many = |time: f64| ((time - start) / size).abs() > MAX_STEPS_OF_A_RUN;
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

fn document(message: String) -> Error {
    ErrorKind::Document { message }.into()
}

/// `1 entry`, `2 entries`
fn counted(count: usize, one: &str, many: &str) -> String {
    let what = if count == 1 { one } else { many };
    format!("{count} {what}")
}
