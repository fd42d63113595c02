//! The construction that the parts of a definition select.

use crate::definition::{Definition, Key};

/// The kinds of definitions of a method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Functions at nodes.
    Derived,
    /// Given coefficients.
    Given,
    /// Kicks and drifts.
    Splitting,
    /// Printed kicks and drifts with their claim.
    Certified,
    /// A base method, optionally with steps of it.
    Based,
    /// Steps of several methods.
    Composition,
}

impl Kind {
    /// The construction of a definition; if it has keys of several constructions, one of them.
    pub fn of(definition: &Definition) -> Self {
        let telling = [
            Kind::Composition,
            Kind::Based,
            Kind::Certified,
            Kind::Splitting,
            Kind::Given,
        ];
        let told = |kind: &Kind| {
            kind.telling()
                .iter()
                .any(|&key| definition.get(key).is_some())
        };
        telling.into_iter().find(told).unwrap_or(Kind::Derived)
    }

    /// The keys that distinguish it from the others.
    fn telling(self) -> &'static [Key] {
        match self {
            Kind::Derived => &[Key::Basis, Key::Nodes, Key::Quadrature],
            Kind::Given => &[Key::A, Key::B, Key::ATilde, Key::BTilde],
            Kind::Splitting => &[Key::Kick, Key::Drift, Key::Gradient],
            Kind::Certified => &[Key::Claim],
            Kind::Based => &[Key::Base],
            Kind::Composition => &[Key::Compose],
        }
    }

    /// Whether the construction accepts a key.
    pub fn takes(self, key: Key) -> bool {
        match key {
            Key::Exchange | Key::Adjoint => true,
            Key::Weights => matches!(self, Kind::Derived | Kind::Based),
            Key::Kick | Key::Drift | Key::Gradient => {
                matches!(self, Kind::Splitting | Kind::Certified)
            }
            Key::First => matches!(self, Kind::Splitting | Kind::Certified),
            Key::Symmetric => matches!(self, Kind::Splitting | Kind::Certified | Kind::Based),
            Key::Claim => matches!(self, Kind::Certified | Kind::Based),
            Key::Processor => matches!(self, Kind::Splitting | Kind::Based),
            _ => self.telling().contains(&key),
        }
    }

    /// The message about a key that the construction does not accept.
    pub fn refuses(self, key: Key) -> String {
        let name = key.name();
        match (self, key) {
            (Kind::Certified, Key::Processor) => "a `claim` about a processed method takes a `base` with `weights`: write the numbers of a processed splitting as exact ones, without a `claim`".to_owned(),
            (_, Key::Processor) => "a `processor` goes with the `weights` of a `base`, or with the `kick` and `drift` of a splitting: leave it out".to_owned(),
            (Kind::Certified, _) => format!(
                "a `claim` is about printed `kick` and `drift`, or about `weights` of a `base`: leave out `{name}`"
            ),
            (_, Key::First | Key::Symmetric) => format!(
                "`{name}` goes with the `kick` and `drift` of a splitting{}: leave it out",
                if key == Key::Symmetric {
                    ", or the `weights` of a `base`"
                } else {
                    ""
                }
            ),
            (Kind::Composition, _) => format!(
                "`compose` has the definitions of its methods in it: leave out `{name}`, or `compose`"
            ),
            (Kind::Based, _) => format!(
                "`base` is a whole method, with which `weights` make a composition: leave out `{name}`, or `base`"
            ),
            (Kind::Splitting, _) => {
                format!(
                    "`kick` and `drift` define a splitting completely: leave out `{name}`, or both of them"
                )
            }
            (Kind::Given | Kind::Derived, _) => {
                format!(
                    "`a` and `b` define a method completely: leave out `{name}`, or both of them"
                )
            }
        }
    }
}
