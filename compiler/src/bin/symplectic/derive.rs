//! `symplectic derive`

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use symplectic_compiler::{Definition, Error, Key, check, export};

use crate::output::{self, OutputOptions};

/// Derive a tableau, with proofs: from a basis at nodes, from a basis and a quadrature formula, from given
/// coefficients, from kicks and drifts, or as a composition of methods.
///
/// Expressions have numbers, t, pi, e, + - * / ^, sqrt, cbrt, sin, cos, tan, exp, cosh, sinh and root(p, k), the
/// k-th real root of a polynomial p in t.
#[derive(Args)]
pub(crate) struct Arguments {
    /// A TOML file with the definition instead of the options below.
    #[arg(value_name = "FILE", conflicts_with_all = ["basis", "nodes", "quadrature", "base", "weights", "a", "b", "a_tilde", "b_tilde", "kick", "drift", "first", "claim", "compose", "symmetric", "exchange", "adjoint"])]
    file: Option<PathBuf>,
    /// `polynomial(s)`, `legendre(s)`, or a list of functions of t: "1, cos(pi*t), sin(pi*t)".
    #[arg(long, allow_hyphen_values = true)]
    basis: Option<String>,
    /// A rule such as `gauss(3)` (`symplectic list` shows all), or a list of numbers in [0, 1]: "0, 1/3, 1".
    #[arg(long, allow_hyphen_values = true)]
    nodes: Option<String>,
    /// Nodes of the rectangular construction, at least as many as there are functions.
    #[arg(long, allow_hyphen_values = true)]
    quadrature: Option<String>,
    /// A method to compose with `--weights`: a name of `symplectic list`, or a definition in brackets:
    /// "[kick: [1/2, 1/2], drift: [1, 0]]".
    #[arg(long, allow_hyphen_values = true, value_name = "METHOD")]
    base: Option<String>,
    /// The weights of the quadrature, if not the interpolatory ones: "1/6, 2/3, 1/6". Beside a base the fractions of
    /// its steps: "1/2, adjoint(1/2)", "triple_jump(4)", "suzuki(4)".
    #[arg(long, allow_hyphen_values = true)]
    weights: Option<String>,
    /// Given coefficients of the position stages, row by row: "[[0, 0], [1/2, 1/2]]".
    #[arg(long, allow_hyphen_values = true, value_name = "ROWS")]
    a: Option<String>,
    /// Given weights: "1/2, 1/2".
    #[arg(long, allow_hyphen_values = true, value_name = "LIST")]
    b: Option<String>,
    /// Given coefficients of the momentum stages, or `symplectic_partner` [default: those of the positions].
    #[arg(long, allow_hyphen_values = true, value_name = "ROWS")]
    a_tilde: Option<String>,
    /// Given weights of the forces [default: b].
    #[arg(long, allow_hyphen_values = true, value_name = "LIST")]
    b_tilde: Option<String>,
    /// The kicks of a splitting, p -= kick_i h dU/dq: "1/2, 1/2".
    #[arg(long, allow_hyphen_values = true, value_name = "LIST")]
    kick: Option<String>,
    /// The drifts of a splitting, q += drift_i h dT/dp, each after the kick of the same number: "1, 0".
    #[arg(long, allow_hyphen_values = true, value_name = "LIST")]
    drift: Option<String>,
    /// Which of the two comes first: kick or drift [default: kick].
    #[arg(long, value_name = "FLOW")]
    first: Option<String>,
    /// The order that printed kicks and drifts claim, or the printed weights of a composition: the exact method behind
    /// their digits is derived, with a proof that it exists. `separable(6)`, `nystrom(6)`, `perturbed(8, 6, 4)`.
    #[arg(long, value_name = "CLAIM")]
    claim: Option<String>,
    /// Steps of other methods one after another, each with its fraction of the step:
    /// "[1/2, basis: 1, nodes: 0], [1/2, basis: 1, nodes: 1]".
    #[arg(long, allow_hyphen_values = true, value_name = "STEPS")]
    compose: Option<String>,
    /// Mirror a splitting, or the weights of a base: what is written last stands in the middle, once.
    #[arg(long)]
    symmetric: bool,
    /// Exchange the coefficients of positions and momenta.
    #[arg(long)]
    exchange: bool,
    /// Take the adjoint method.
    #[arg(long)]
    adjoint: bool,
    /// A name to put into the output.
    #[arg(long)]
    name: Option<String>,
    #[command(flatten)]
    output: OutputOptions,
}

pub(crate) fn run(arguments: &Arguments) -> Result<ExitCode, Error> {
    let limits = arguments.output.limits();
    let mut tableau = match &arguments.file {
        Some(path) => check(
            &path.display().to_string(),
            &export::read_text(path)?,
            &limits,
        )?,
        None => arguments.definition().derive(&limits)?,
    };
    if let Some(name) = &arguments.name {
        tableau = tableau.named(name);
    }
    output::warn_if_inconsistent(&tableau);
    output::warn_of_wrong_digits(&tableau);
    output::print(&arguments.output.write(&tableau))
}

impl Arguments {
    fn definition(&self) -> Definition {
        let switch = |on: bool| on.then(|| "true".to_owned());
        let symmetric = switch(self.symmetric);
        let (exchange, adjoint) = (switch(self.exchange), switch(self.adjoint));
        let parts = [
            (Key::Basis, &self.basis),
            (Key::Nodes, &self.nodes),
            (Key::Quadrature, &self.quadrature),
            (Key::Base, &self.base),
            (Key::Weights, &self.weights),
            (Key::A, &self.a),
            (Key::B, &self.b),
            (Key::ATilde, &self.a_tilde),
            (Key::BTilde, &self.b_tilde),
            (Key::Kick, &self.kick),
            (Key::Drift, &self.drift),
            (Key::First, &self.first),
            (Key::Claim, &self.claim),
            (Key::Compose, &self.compose),
            (Key::Symmetric, &symmetric),
            (Key::Exchange, &exchange),
            (Key::Adjoint, &adjoint),
        ];
        // A text may be that of a file: `--weights "$(cat weights.txt)"`.
        let given = parts
            .into_iter()
            .filter_map(|(key, text)| Some((key, export::without_mark(text.as_deref()?))));
        Definition::new(given)
    }
}
