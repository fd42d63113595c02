//! How the tables of a file are stepped: as those of a library, or as the file states itself.

use serde::Deserialize;

use super::lists::Lists;
use crate::import::{Flows, Numbers, OwnNames, half};
use symplectic_compiler::Library;
use symplectic_compiler::Limits;
use symplectic_compiler::inside::shown;
use symplectic_compiler::{Error, ErrorKind};

/// The lists of a file that states itself how they are stepped.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Steps {
    drift: Option<String>,
    kick: Option<String>,
    first: Option<First>,
    weights: Option<String>,
    base: Option<String>,
    #[serde(default)]
    symmetric: bool,
    evidence: String,
}

#[derive(Deserialize, PartialEq, Eq, Clone, Copy)]
#[serde(rename_all = "lowercase")]
enum First {
    Drift,
    Kick,
}

/// How numbers are stepped, and where this is documented.
pub(super) enum Convention {
    /// As those of a library.
    Library(Library),
    /// By names of their own.
    Own { names: OwnNames, evidence: String },
}

impl Steps {
    /// The names of the lists; in the other case a message.
    pub fn convention(self) -> Result<Convention, String> {
        let names = match (self.drift, self.kick, self.weights, self.base) {
            (Some(drift), Some(kick), None, None) => OwnNames::Splitting {
                drift,
                kick,
                drifts_first: self.first.map(|first| first == First::Drift),
                symmetric: self.symmetric,
            },
            (None, None, Some(weights), Some(base)) if self.first.is_none() => {
                OwnNames::Composition {
                    base,
                    weights,
                    symmetric: self.symmetric,
                }
            }
            _ => {
                let message = "`[steps]` has `drift` and `kick`, with `first` if the lists are equally long, or `weights` and `base`";
                return Err(message.to_owned());
            }
        };
        let evidence = self.evidence;
        Ok(Convention::Own { names, evidence })
    }
}

impl Convention {
    /// What has the numbers of a table.
    fn owner(&self) -> &str {
        match self {
            Convention::Library(library) => library.name(),
            Convention::Own { .. } => "[steps]",
        }
    }

    /// The names of the lists that a table may have.
    fn names(&self) -> Vec<&str> {
        match self {
            Convention::Library(library) => match library.stepping() {
                Some(stepping) => vec![stepping.drift, stepping.kick],
                None => vec!["a", "b", "a_tilde", "b_tilde"],
            },
            Convention::Own { names, .. } => names.lists(),
        }
    }

    /// The numbers of a table.
    pub fn numbers(&self, lists: &Lists<'_>, limits: &Limits) -> Result<Numbers, Error> {
        let owner = self.owner();
        let names = self.names();
        let document = |message: String| lists.at_title(ErrorKind::Document { message });
        if let Some(name) = lists.names().find(|name| !names.contains(name)) {
            let names = names.join(", ");
            return Err(document(format!(
                "`{owner}` has no numbers `{}`; it has {names}",
                shown(name)
            )));
        }
        let list = |name: &str| {
            let missing = || {
                document(format!(
                    "the numbers `{name}` are missing, which `{owner}` has"
                ))
            };
            lists.list(name)?.ok_or_else(missing)
        };
        let stepping = match self {
            Convention::Own { names, .. } => {
                return names.numbers(list, |_, kind| lists.at_title(kind), limits);
            }
            Convention::Library(library) => library.stepping(),
        };
        if let Some(stepping) = stepping {
            let (drifts, kicks) = (list(stepping.drift)?, list(stepping.kick)?);
            return Numbers::splitting(&Flows::from(&stepping), drifts, kicks, limits)
                .map_err(|kind| lists.at_title(kind));
        }
        let halves = |a: &str, b: &str| -> Result<_, Error> {
            half(list(a)?, list(b)?, None, limits).map_err(|kind| lists.at_title(kind))
        };
        let has = |wanted: &str| lists.names().any(|name| name == wanted);
        let momenta = match has("a_tilde") {
            true => {
                let weights = if has("b_tilde") { "b_tilde" } else { "b" };
                Some(halves("a_tilde", weights)?)
            }
            false => None,
        };
        let positions = halves("a", "b")?;
        Ok(Numbers::RungeKutta { positions, momenta })
    }

    /// In words.
    pub fn text(&self) -> String {
        let splitting = |drift: &str, kick: &str, drifts_first: Option<bool>, mirrored: bool| {
            let (drift, kick) = (format!("drift {drift}_i"), format!("kick {kick}_i"));
            let back = if mirrored { ", and back" } else { "" };
            match drifts_first {
                Some(true) => format!("{drift}, {kick}{back}"),
                Some(false) => format!("{kick}, {drift}{back}"),
                None => format!("{drift} and {kick} in turn, the longer list first{back}"),
            }
        };
        let (steps, evidence) = match self {
            Convention::Library(library) => match library.stepping() {
                None => return "a Runge–Kutta table".to_owned(),
                Some(stepping) => {
                    let first = Some(stepping.drifts_first);
                    let steps = splitting(stepping.drift, stepping.kick, first, stepping.mirrored);
                    (steps, stepping.evidence)
                }
            },
            Convention::Own { names, evidence } => {
                let steps = match names {
                    OwnNames::Splitting {
                        drift,
                        kick,
                        drifts_first,
                        symmetric,
                    } => splitting(drift, kick, *drifts_first, *symmetric),
                    OwnNames::Composition {
                        base,
                        weights,
                        symmetric,
                    } => {
                        let back = if *symmetric { ", and back" } else { "" };
                        format!("{base} by the fractions {weights}_i{back}")
                    }
                };
                (steps, evidence.as_str())
            }
        };
        format!("{steps} ({evidence})")
    }
}
