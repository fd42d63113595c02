//! The command `symplectic search`.

use std::ffi::OsString;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use clap::{Parser, ValueEnum};
use symplectic_compiler::certify::{Claim, Conditions};
use symplectic_compiler::export::{DEFAULT_DIGITS, toml};
use symplectic_compiler::{Error, ErrorKind};
use symplectic_terminal::{errors, print};
use symplectic_tools::certificate;

use crate::display::{self, Live};
use crate::figure::Norm;
use crate::hunt::{Problem, Progress};
use crate::proof::Method;
use crate::state;
use crate::structure::Structure;
use crate::trial::{Splitting, Trial, rivals};

/// Find splittings and compositions of a class and an order, and prove them.
///
/// Random starts are led to solutions of the order conditions, and these to minima of the error. Every method that is printed is proved.
/// Ctrl-C ends the search; what has been found so far is proved and printed.
#[derive(Parser)]
#[command(name = "symplectic search", bin_name = "symplectic search", version)]
struct Arguments {
    /// The class of Hamiltonians.
    #[arg(long, value_enum, default_value_t = Class::Separable)]
    class: Class,
    /// The order; for `--class perturbed` the orders in ε, ε², …, such as `8,4`.
    #[arg(long, value_name = "P", value_delimiter = ',', required = true)]
    order: Vec<usize>,
    /// Force evaluations a step. For a composition these are its steps of Störmer–Verlet.
    #[arg(long, value_name = "S", value_parser = clap::value_parser!(u16).range(1..=40))]
    kicks: u16,
    /// The structure.
    #[arg(long, value_enum, default_value_t = Shape::Aba)]
    structure: Shape,
    /// What is minimised.
    #[arg(long, value_enum, default_value_t = Figure::Error)]
    minimise: Figure,
    /// Only methods that are stable for `q″ = −ω²q` up to this hω a kick; Störmer–Verlet is stable up to 2.
    #[arg(long, value_name = "Z", default_value_t = 0.0)]
    at_least_stable: f64,
    /// The largest size of a coefficient. Large ones lose digits.
    #[arg(long, value_name = "X", default_value_t = 1.0)]
    largest: f64,
    /// The number of random starts [default: as many as the time allows].
    #[arg(long, value_name = "N")]
    starts: Option<u32>,
    /// The time of the search: 30s, 5m, 1h [default: 1m without `--starts`].
    #[arg(long, value_name = "T", value_parser = duration)]
    time: Option<Duration>,
    /// The seed of the random numbers. A seed and a number of starts give the same methods, with any number of threads.
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u32,
    /// The number of methods that are proved and printed.
    #[arg(long, value_name = "N", default_value_t = 3)]
    keep: usize,
    /// Integrate scenes with the methods and with the best ones of the catalogue, and compare errors at equal cost.
    #[arg(long)]
    test: bool,
    /// A folder for the methods as TOML files, with their certificates.
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
    /// A file with the state of the search. If it exists, the search goes on from there.
    #[arg(long, value_name = "FILE")]
    resume: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Class {
    /// H = T(p) + U(q).
    Separable,
    /// H = p²/2m + U(q).
    Nystrom,
    /// H = H_A + εH_B, with drifts for H_A and kicks for εH_B.
    Perturbed,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Shape {
    /// A palindrome of drifts and kicks that begins with a drift.
    Aba,
    /// A palindrome of drifts and kicks that begins with a kick.
    Bab,
    /// Kicks and drifts without symmetry.
    Plain,
    /// A palindrome of steps of Störmer–Verlet: its order holds for every symmetric basic method.
    Composition,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Figure {
    /// The error constant C of the class, and with it the efficiency s C^(1/p).
    #[value(alias = "efficiency")]
    Error,
    /// The smallest error constant over all changes of variables: what grows in long runs.
    ModuloConjugation,
    /// What grows in long runs, and a tenth of the error constant.
    LongRuns,
}

impl Arguments {
    fn problem(&self) -> Result<Problem, Error> {
        let structure = match self.structure {
            Shape::Aba => Structure::Aba,
            Shape::Bab => Structure::Bab,
            Shape::Plain => Structure::Plain,
            Shape::Composition => Structure::Composition,
        };
        let [first, rest @ ..] = &*self.order else {
            return Err(refused("`--order` needs a number".to_owned()));
        };
        let is_perturbed = self.class == Class::Perturbed;
        if is_perturbed == rest.is_empty() {
            return Err(refused(
                "`--class perturbed` has several orders, such as `--order 8,4`, and the other classes have one".to_owned(),
            ));
        }
        let claim = match (structure, self.class) {
            (Structure::Composition, Class::Separable) => Claim::SymmetricBase(*first),
            (Structure::Composition, _) => {
                let message =
                    "compositions have the same conditions for every class: leave out `--class`";
                return Err(refused(message.to_owned()));
            }
            (_, Class::Separable) => Claim::Separable(*first),
            (_, Class::Nystrom) => Claim::Nystrom(*first),
            (_, Class::Perturbed) => Claim::Perturbed(self.order.clone()),
        };
        if structure.is_symmetric() && self.order.iter().any(|order| order % 2 == 1) {
            return Err(refused(format!(
                "symmetric methods have even orders: take `--structure plain`, or order {}",
                first + 1
            )));
        }
        if !(self.largest > 0.0 && self.largest.is_finite()) {
            return Err(refused("`--largest` needs a positive number".to_owned()));
        }
        Ok(Problem {
            claim,
            structure,
            kicks: usize::from(self.kicks),
            norm: match self.minimise {
                Figure::Error => Norm::Error,
                Figure::ModuloConjugation => Norm::ModuloConjugation,
                Figure::LongRuns => Norm::LongRuns,
            },
            largest: self.largest,
            at_least_stable: self.at_least_stable,
        })
    }

    /// The time after which the search ends.
    fn limit(&self) -> Option<Duration> {
        let default = self.starts.is_none().then_some(Duration::from_secs(60));
        self.time.or(default)
    }
}

/// Runs the command with the arguments of a command line, whose first one is the name of the program. Wrong arguments end the process.
pub fn command(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    errors::exit_code(run(&Arguments::parse_from(arguments)))
}

fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let problem = arguments.problem()?;
    let mut progress = match &arguments.resume {
        Some(file) => state::read(file, &problem, arguments.seed)?,
        None => Progress::new(arguments.seed),
    };
    warn(&problem)?;
    search(arguments, &problem, &mut progress)?;
    if progress.solutions.is_empty() {
        return print(&display::nothing(&problem, &progress));
    }
    let mut text = display::summary(&problem, &progress);
    let mut methods: Vec<Method> = Vec::new();
    for solution in progress.solutions.iter().take(arguments.keep) {
        match problem.prove(solution) {
            Ok(method) => {
                let number = methods.len() + 1;
                let name = display::name(&problem, number);
                let method = Method {
                    tableau: method.tableau.named(&name),
                    ..method
                };
                text.push_str(&display::method(&problem, number, solution, &method));
                if let Some(folder) = &arguments.out {
                    write(folder, &name, &method)?;
                }
                methods.push(method);
            }
            Err(error) => text.push_str(&format!("A solution is left out: {error}\n\n")),
        }
    }
    let known = rivals(&problem);
    text.push_str(&display::beside_the_catalogue(&problem, &methods, &known));
    if arguments.test {
        text.push_str(&test(&problem, &methods, &known)?);
    }
    print(&text)
}

/// Compares the methods with the most efficient ones of the catalogue on all scenes.
fn test(
    problem: &Problem,
    methods: &[Method],
    known: &[crate::trial::Known],
) -> Result<String, Error> {
    const RIVALS: usize = 6;
    let trial = Trial::new(problem)?;
    let errors = |tableau| Splitting::of(tableau).map(|splitting| trial.errors(&splitting));
    let own: Vec<_> = methods
        .iter()
        .filter_map(|method| errors(&method.tableau))
        .collect();
    let others = known
        .iter()
        .filter_map(|known| Some((&*known.name, errors(&known.tableau)?)));
    let others: Vec<_> = others.take(RIVALS).collect();
    Ok(display::trial(&trial, &own, &others))
}

fn search(arguments: &Arguments, problem: &Problem, progress: &mut Progress) -> Result<(), Error> {
    let stopped = Arc::new(AtomicBool::new(false));
    let flag = stopped.clone();
    // Without the handler Ctrl-C ends the program as usual.
    let _ = ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed));
    let begin = Instant::now();
    let mut saved = begin;
    let mut live = Live::new();
    let starts = arguments.starts.map_or(u32::MAX, |starts| starts);
    let mut failure = None;
    let searched = problem.search(progress, u64::from(starts), |progress| {
        live.show(problem, progress, begin.elapsed());
        if let Some(file) = &arguments.resume
            && saved.elapsed() > Duration::from_secs(2)
        {
            saved = Instant::now();
            if let Err(error) = state::write(file, problem, progress) {
                failure = Some(error);
                return ControlFlow::Break(());
            }
        }
        let is_over = arguments
            .limit()
            .is_some_and(|limit| begin.elapsed() >= limit);
        match is_over || stopped.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    });
    live.finish();
    searched.map_err(|error| refused(error.to_string()))?;
    match failure {
        Some(error) => Err(error),
        None => arguments
            .resume
            .as_ref()
            .map_or(Ok(()), |file| state::write(file, problem, progress)),
    }
}

/// Says before the search what cannot be expected of it.
fn warn(problem: &Problem) -> Result<(), Error> {
    let counted = |claim: &Claim| -> Result<usize, Error> {
        let conditions = Conditions::new(claim, problem.structure.is_symmetric());
        Ok(conditions
            .map_err(|error| refused(error.to_string()))?
            .conditions()
            .len())
    };
    let (conditions, unknowns) = (counted(&problem.claim)?, problem.unknowns());
    if conditions > unknowns {
        errors::warning(&format!(
            "there are {conditions} conditions for {unknowns} unknowns: a solution would be a coincidence; take more kicks"
        ));
    }
    let step = if problem.structure.is_symmetric() {
        2
    } else {
        1
    };
    let next = match problem.claim {
        Claim::Separable(order) => Some(Claim::Separable(order + step)),
        Claim::Nystrom(order) => Some(Claim::Nystrom(order + step)),
        Claim::SymmetricBase(order) => Some(Claim::SymmetricBase(order + step)),
        Claim::Perturbed(_) => None,
    };
    if let Some(next) = next
        && counted(&next).is_ok_and(|more| more <= unknowns)
    {
        errors::warning(&format!(
            "{} is in reach with {} kicks: the error constant of the lower order can vanish, and says little; search for the higher order",
            next, problem.kicks
        ));
    }
    Ok(())
}

/// Writes a method and its certificate.
fn write(folder: &Path, name: &str, method: &Method) -> Result<(), Error> {
    let failed = |path: &Path, error: std::io::Error| {
        refused(format!("cannot write {}: {error}", path.display()))
    };
    std::fs::create_dir_all(folder).map_err(|error| failed(folder, error))?;
    for (ending, text) in [
        ("toml", toml::write(&method.tableau, DEFAULT_DIGITS)),
        ("certificate.json", certificate::write(&method.tableau)?),
    ] {
        let path = folder.join(format!("{name}.{ending}"));
        std::fs::write(&path, text).map_err(|error| failed(&path, error))?;
    }
    Ok(())
}

pub(crate) fn refused(message: String) -> Error {
    ErrorKind::Document { message }.into()
}

/// Reads `30s`, `5m` or `1h`.
fn duration(text: &str) -> Result<Duration, String> {
    let units = [("s", 1.0), ("m", 60.0), ("h", 3600.0)];
    let parsed = units.iter().find_map(|(unit, seconds)| {
        let number: f64 = text.strip_suffix(unit)?.parse().ok()?;
        Duration::try_from_secs_f64(number * seconds).ok()
    });
    parsed
        .filter(|time| !time.is_zero())
        .ok_or_else(|| "expected a time such as 30s, 5m or 1h".to_owned())
}
