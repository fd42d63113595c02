//! The command `symplectic search`.

use std::ffi::OsString;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use clap::{Parser, ValueEnum};
use symplectic_compiler::certify::{CertifyError, Claim, Conditions};
use symplectic_compiler::export::{DEFAULT_DIGITS, toml};
use symplectic_compiler::{Error, ErrorKind};
use symplectic_terminal::{errors, print};
use symplectic_tools::certificate;

use crate::display::{self, Live};
use crate::figure::Norm;
use crate::hunt::{Problem, Progress, Solution};
use crate::proof::{Method, ProofError};
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
    /// For `--class nystrom`: how many of the kicks, the innermost ones, are gradient kicks. Each counts as two force evaluations.
    #[arg(long, value_name = "N", default_value_t = 0)]
    gradient: u16,
    /// The structure.
    #[arg(long, value_enum, default_value_t = Shape::Aba)]
    structure: Shape,
    /// The number of fractions of the processor, for `--structure processed`.
    #[arg(long, value_name = "N", default_value_t = 6, value_parser = clap::value_parser!(u16).range(1..=20))]
    processor: u16,
    /// What is minimised [default: error; cost where the next order is in reach; perturbed for `--class perturbed`].
    #[arg(long, value_enum)]
    minimise: Option<Figure>,
    /// The error at which `--minimise cost` takes the cost.
    #[arg(long, value_name = "E", default_value_t = 1e-8, allow_hyphen_values = true, value_parser = positive)]
    tolerance: f64,
    /// The ε of `--minimise perturbed`.
    #[arg(long, value_name = "E", default_value_t = 1e-2, allow_hyphen_values = true, value_parser = positive)]
    epsilon: f64,
    /// The frequency of the harmonic oscillator with an error of higher order than the method, as one more equation.
    #[arg(long)]
    dispersion: bool,
    /// Only methods that are stable for `q″ = −ω²q` up to this hω a kick; Störmer–Verlet is stable up to 2.
    #[arg(long, value_name = "Z", default_value_t = 0.0)]
    at_least_stable: f64,
    /// The largest size of a coefficient. Large ones lose digits.
    #[arg(long, value_name = "X", default_value_t = 1.0, allow_hyphen_values = true, value_parser = positive)]
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
    /// The same as the kernel of a processed method, P K P⁻¹.
    Processed,
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
    /// The error constant for H_A + εH_B with the ε of `--epsilon`.
    Perturbed,
    /// The force evaluations for the error of `--tolerance`, with the two leading terms of the error; for orders up to 4.
    Cost,
}

impl Arguments {
    fn problem(&self) -> Result<Problem, Error> {
        let structure = match self.structure {
            Shape::Aba => Structure::Aba,
            Shape::Bab => Structure::Bab,
            Shape::Plain => Structure::Plain,
            Shape::Composition => Structure::Composition,
            Shape::Processed => Structure::Processed {
                processor: usize::from(self.processor),
            },
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
            (Structure::Composition | Structure::Processed { .. }, Class::Separable) => {
                Claim::SymmetricBase(*first)
            }
            (Structure::Composition | Structure::Processed { .. }, _) => {
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
        let kicks = self.kicks + u16::from(structure == Structure::Bab);
        if self.gradient > 0 && !matches!(claim, Claim::Nystrom(_)) {
            return Err(refused(
                "gradient kicks need a quadratic kinetic energy: `--class nystrom`".to_owned(),
            ));
        }
        if self.gradient > kicks
            || (self.gradient > 0 && structure.is_symmetric() && (kicks - self.gradient) % 2 == 1)
        {
            return Err(refused(format!(
                "a palindrome of {kicks} kicks has {} gradient kicks in its middle: give `--gradient` such a number",
                if kicks.is_multiple_of(2) {
                    "0, 2, 4, …"
                } else {
                    "0, 1, 3, 5, …"
                }
            )));
        }
        let mut problem = Problem {
            gradient: usize::from(self.gradient),
            claim,
            structure,
            kicks: usize::from(self.kicks),
            norm: Norm::Error,
            largest: self.largest,
            dispersion: self.dispersion,
            at_least_stable: self.at_least_stable,
        };
        let default = match self.class {
            Class::Perturbed => Figure::Perturbed,
            _ if next_in_reach(&problem).is_some() && *first <= 4 => Figure::Cost,
            _ => Figure::Error,
        };
        problem.norm = match self.minimise.unwrap_or(default) {
            Figure::Error => Norm::Error,
            Figure::ModuloConjugation => Norm::ModuloConjugation,
            Figure::LongRuns => Norm::LongRuns,
            Figure::Perturbed => Norm::Perturbed {
                epsilon: self.epsilon,
            },
            Figure::Cost => Norm::Cost {
                tolerance: self.tolerance,
            },
        };
        Ok(problem)
    }

    /// The time after which the search ends.
    fn limit(&self) -> Option<Duration> {
        let default = self.starts.is_none().then_some(Duration::from_secs(60));
        self.time.or(default)
    }
}

/// Runs the command with the arguments of a command line, whose first one is the name of the program. Wrong arguments end the process.
pub fn command(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    errors::exit_code(run(&Options(Arguments::parse_from(arguments))))
}

fn run(options: &Options) -> Result<ExitCode, Error> {
    let stopped = Arc::new(AtomicBool::new(false));
    let flag = stopped.clone();
    // Without the handler Ctrl-C ends the program as usual.
    let _ = ctrlc::set_handler(move || {
        // The second time nothing is proved any more.
        if flag.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
    });
    let problem = options.0.problem()?;
    warn(&problem)?;
    let begin = Instant::now();
    let live = Live::new();
    let found = options.search(|progress| {
        live.show(&problem, progress, begin.elapsed());
        match stopped.load(Ordering::Relaxed) {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    });
    live.finish();
    let Found {
        progress,
        methods,
        left_out,
        ..
    } = found?;
    if progress.solutions.is_empty() {
        return print(&display::nothing(&problem, &progress));
    }
    let mut text = display::summary(&problem, &progress);
    for (number, (solution, method)) in (1..).zip(&methods) {
        text.push_str(&display::method(&problem, number, solution, method));
    }
    for error in left_out {
        text.push_str(&format!("A solution is left out: {error}\n\n"));
    }
    let known = rivals(&problem).map_err(|error| refused(error.to_string()))?;
    let methods: Vec<Method> = methods.into_iter().map(|(_, method)| method).collect();
    text.push_str(&display::beside_the_catalogue(&problem, &methods, &known));
    if options.0.test {
        text.push_str(&test(&problem, &methods, &known)?);
    }
    print(&text)
}

/// A search by the options of the command line.
pub struct Options(Arguments);

/// What a search has found.
#[derive(Debug)]
pub struct Found {
    /// What was searched.
    pub problem: Problem,
    /// The state of the search at its end.
    pub progress: Progress,
    /// The best solutions with the methods that are proved to be near them.
    pub methods: Vec<(Solution, Method)>,
    /// The solutions among the best that have no proof.
    pub left_out: Vec<ProofError>,
}

impl Options {
    /// Reads options, the first one after the name of the program: `--order 4 --kicks 5`.
    ///
    /// # Errors
    /// The message about options that are wrong or missing.
    pub fn parse(options: impl IntoIterator<Item = String>) -> Result<Self, String> {
        let program = std::iter::once("search".to_owned());
        let parsed = Arguments::try_parse_from(program.chain(options));
        parsed.map(Options).map_err(|error| error.to_string())
    }

    /// Searches until the starts or the time are used up, or `report`, which is called regularly, breaks it off; then proves the best
    /// solutions, and writes them to the folder of the options.
    ///
    /// ```
    /// use std::ops::ControlFlow;
    /// use symplectic_search::Options;
    ///
    /// let options = ["--order", "4", "--kicks", "4", "--starts", "64"];
    /// let options = Options::parse(options.map(str::to_owned))?;
    /// let found = options.search(|_| ControlFlow::Continue(()))?;
    /// let (_, best) = &found.methods[0];
    /// assert!(best.tableau.orders().separable.order == 4 && best.error < 0.0077);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Options that do not go together, and files that cannot be read or written.
    pub fn search(
        &self,
        mut report: impl FnMut(&Progress) -> ControlFlow<()>,
    ) -> Result<Found, Error> {
        let Options(arguments) = self;
        let problem = arguments.problem()?;
        let mut progress = match &arguments.resume {
            Some(file) => state::read(file, &problem, arguments.seed)?,
            None => Progress::new(arguments.seed),
        };
        let begin = Instant::now();
        let mut saved = begin;
        let mut failure = None;
        let starts = u64::from(arguments.starts.unwrap_or(u32::MAX));
        let searched = problem.search(&mut progress, starts, |progress| {
            if let Some(file) = &arguments.resume
                && saved.elapsed() > SAVED
            {
                saved = Instant::now();
                failure = state::write(file, &problem, progress).err();
            }
            let is_over = arguments
                .limit()
                .is_some_and(|limit| begin.elapsed() >= limit);
            match is_over || failure.is_some() {
                true => ControlFlow::Break(()),
                false => report(progress),
            }
        });
        searched.map_err(|error| refused(error.to_string()))?;
        if let Some(file) = &arguments.resume {
            state::write(file, &problem, &progress)?;
        }
        let (mut methods, mut left_out) = (Vec::new(), Vec::new());
        for solution in progress.solutions.iter().take(arguments.keep) {
            match problem.prove(solution) {
                Ok(method) => {
                    let name = display::name(&problem, methods.len() + 1);
                    let method = Method {
                        tableau: method.tableau.named(&name),
                        ..method
                    };
                    if let Some(folder) = &arguments.out {
                        write(folder, &name, &method)?;
                    }
                    methods.push((solution.clone(), method));
                }
                Err(error) => left_out.push(error),
            }
        }
        Ok(Found {
            problem,
            progress,
            methods,
            left_out,
        })
    }
}

/// The time between two writings of the state.
const SAVED: Duration = Duration::from_secs(2);

/// Compares the methods with the most efficient ones of the catalogue on all scenes.
fn test(
    problem: &Problem,
    methods: &[Method],
    known: &[crate::trial::Known],
) -> Result<String, Error> {
    const RIVALS: usize = 6;
    let trial = Trial::new(problem)?;
    let errors = |splitting: &Splitting| trial.errors(splitting);
    let own = methods
        .iter()
        .filter_map(|method| Splitting::of(&method.tableau));
    let own: Vec<_> = own.map(|splitting| errors(&splitting)).collect();
    let others = known.iter().take(RIVALS);
    let others: Vec<_> = others
        .map(|known| (&*known.name, errors(&known.splitting)))
        .collect();
    Ok(display::trial(&trial, &own, &others))
}

/// Says before the search what cannot be expected of it.
fn warn(problem: &Problem) -> Result<(), Error> {
    let conditions =
        conditions(problem, &problem.claim).map_err(|error| refused(error.to_string()))?;
    let unknowns = problem.unknowns();
    if conditions > unknowns {
        errors::warning(&format!(
            "there are {conditions} conditions for {unknowns} unknowns: a solution would be a coincidence; take more kicks"
        ));
    }
    if let Some(next) = next_in_reach(problem) {
        let figure = match problem.norm {
            Norm::Cost { .. } => {
                "so the cost is minimised, with the two leading terms of the error"
            }
            _ => "so the figure, which has the leading term only, can vanish and says little",
        };
        errors::warning(&format!(
            "{next} is in reach with {} kicks, {figure}; search for the higher order too",
            problem.kicks
        ));
    }
    Ok(())
}

/// The number of conditions of a claim.
fn conditions(problem: &Problem, claim: &Claim) -> Result<usize, CertifyError> {
    Ok(Conditions::new(claim, problem.structure.is_symmetric())?
        .conditions()
        .len())
}

/// The claim of the next order, if there are as many unknowns as conditions for it.
fn next_in_reach(problem: &Problem) -> Option<Claim> {
    let next = problem.claim.next(problem.step())?;
    conditions(problem, &next)
        .is_ok_and(|more| more <= problem.unknowns())
        .then_some(next)
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

fn positive(text: &str) -> Result<f64, String> {
    let value = text
        .parse()
        .ok()
        .filter(|value: &f64| value.is_normal() && *value > 0.0);
    value.ok_or_else(|| "expected a positive number".to_owned())
}
