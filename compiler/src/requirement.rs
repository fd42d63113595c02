//! What a user can require of a method: `symplectic`, `order(separable) == 6`, `stable_to(2)`.

use std::fmt;

use num_rational::BigRational;

use crate::error::{Error, ErrorKind};
use crate::expression::{ExpressionKind, Input, parse_list, shown};
use crate::order::{HamiltonianClass, OrderOptions};
use crate::properties::{Evidence, Properties};
use crate::tableau::Tableau;

/// A requirement, as it stands in `require: […]`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Requirement {
    /// A property of [`Properties::NAMES`].
    Property(String),
    /// `order >= 4`, `order(separable) == 6`; without a class for every Hamiltonian.
    Order {
        /// The class of Hamiltonians.
        class: HamiltonianClass,
        /// Whether it is the order exactly, or at least.
        exactly: bool,
        /// The order.
        order: usize,
    },
    /// Stable on the oscillator for every step size.
    PStable,
    /// Stable on the oscillator for `0 < hω ≤ bound`.
    StableTo(BigRational),
}

/// The requirements beside the properties, as messages list them.
const OTHERS: &str = "order >= 4, order(separable) == 6, p_stable, stable_to(2)";

impl Requirement {
    /// Reads a requirement.
    ///
    /// # Errors
    /// [`ErrorKind::Unknown`] and [`ErrorKind::Type`] at the place of what is wrong.
    ///
    /// ```
    /// use symplectic_compiler::Requirement;
    ///
    /// let verlet = symplectic_compiler::derive("polynomial(2)", "lobatto(2)")?;
    /// verlet.require(&Requirement::parse("order(general) == 2")?, None)?;
    /// let error = verlet.require(&Requirement::parse("order >= 3")?, None).unwrap_err();
    /// assert!(error.to_string().starts_with("the order for general H is 2, not 3: "));
    /// # Ok::<(), symplectic_compiler::Error>(())
    /// ```
    pub fn parse(text: &str) -> Result<Self, Error> {
        let input = Input {
            name: "require",
            text,
        };
        for (sign, exactly) in [(">=", false), ("==", true)] {
            if let Some((left, right)) = text.split_once(sign) {
                let start = left.len() + sign.len();
                let number = right.trim().parse().map_err(|_| {
                    let kind = ErrorKind::Type {
                        found: shown(right.trim()),
                        expected: "an order, a whole number,".to_owned(),
                    };
                    input.error(&(start..text.len()), kind)
                })?;
                return Ok(Requirement::Order {
                    class: class(input, left)?,
                    exactly,
                    order: number,
                });
            }
        }
        let unknown = || {
            let known = Properties::NAMES.join(", ");
            let kind = ErrorKind::Unknown {
                what: "property",
                name: shown(text.trim()),
                known: format!("{known}, {OTHERS}"),
            };
            input.error(&(0..text.len()), kind)
        };
        let items = parse_list(input).map_err(|_| unknown())?;
        let [item] = items.as_slice() else {
            return Err(unknown());
        };
        match &item.kind {
            ExpressionKind::Name(name) if name == "p_stable" => Ok(Requirement::PStable),
            ExpressionKind::Name(name) if Properties::NAMES.contains(&name.as_str()) => {
                Ok(Requirement::Property(name.clone()))
            }
            ExpressionKind::Call {
                function,
                arguments,
                ..
            } if function == "stable_to" && arguments.len() == 1 => {
                Ok(Requirement::StableTo(arguments[0].rational(input)?))
            }
            _ => Err(unknown()),
        }
    }
}

/// The class in `order(separable)`.
fn class(input: Input<'_>, text: &str) -> Result<HamiltonianClass, Error> {
    let whole = 0..text.trim_end().len();
    let compact: String = text.split_whitespace().collect();
    let name = match compact.as_str() {
        "order" => Some("general"),
        _ => compact
            .strip_prefix("order(")
            .and_then(|rest| rest.strip_suffix(')')),
    };
    let known = name.and_then(|name| {
        let mut classes = HamiltonianClass::ALL.into_iter();
        classes.find(|class| class.name() == name)
    });
    known.ok_or_else(|| {
        let classes = HamiltonianClass::ALL.map(|class| format!("order({class})"));
        let kind = ErrorKind::Unknown {
            what: "requirement",
            name: shown(text.trim()),
            known: format!("order, {}", classes.join(", ")),
        };
        input.error(&whole, kind)
    })
}

impl fmt::Display for Requirement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Requirement::Property(name) => f.write_str(name),
            Requirement::Order {
                class,
                exactly,
                order,
            } => {
                let sign = if *exactly { "==" } else { ">=" };
                write!(f, "order({class}) {sign} {order}")
            }
            Requirement::PStable => f.write_str("p_stable"),
            Requirement::StableTo(bound) => write!(f, "stable_to({bound})"),
        }
    }
}

impl Tableau {
    /// Decides a requirement. `accepted` are the binary places to which it is enough that equations are
    /// verified; without them everything has to be proved.
    ///
    /// # Errors
    /// [`ErrorKind::Requirement`] with the witness where it is refuted, [`ErrorKind::NotProved`] where it is
    /// only verified.
    pub fn require(
        &self,
        requirement: &Requirement,
        accepted: Option<u32>,
    ) -> Result<(), ErrorKind> {
        let refuted = |witness: String| ErrorKind::Requirement { message: witness };
        let (holds, evidence, message) = match requirement {
            Requirement::Property(name) => {
                let properties = self.properties();
                let Some(property) = properties.get(name) else {
                    return Err(refuted(format!("there is no property `{name}`")));
                };
                let witness = property.witness.as_deref().unwrap_or("no witness");
                let message = format!("the method is not `{name}`: {witness}");
                (property.holds, property.evidence, message)
            }
            Requirement::Order {
                class,
                exactly,
                order,
            } => return self.require_order(*class, *exactly, *order, accepted),
            Requirement::PStable => {
                let stability = self.stability();
                let message = format!(
                    "the method is not `p_stable`: it is stable for hω in {}",
                    stability.intervals_text()
                );
                (stability.p_stable, stability.evidence, message)
            }
            Requirement::StableTo(bound) => {
                let stability = self.stability();
                let message = format!(
                    "the method is not stable up to hω = {bound}: it is stable for hω in {}",
                    stability.intervals_text()
                );
                (stability.stable_to(bound), stability.evidence, message)
            }
        };
        if !holds {
            return Err(refuted(message));
        }
        self.enough(requirement, evidence, accepted)
    }

    fn require_order(
        &self,
        class: HamiltonianClass,
        exactly: bool,
        order: usize,
        accepted: Option<u32>,
    ) -> Result<(), ErrorKind> {
        let to = |limit: usize| {
            let options = OrderOptions {
                limit: limit.min(OrderOptions::default().limit),
                ..OrderOptions::default()
            };
            self.order(&options).class(class).clone()
        };
        let mut found = to(order);
        if exactly && found.order >= order && found.refuted_by.is_none() {
            // The quadrature does not refute a higher order; some tree with one vertex more may.
            found = to(order + 1);
        }
        let refused = |message: String| Err(ErrorKind::Requirement { message });
        if found.order < order {
            let Some(violated) = &found.refuted_by else {
                return refused(format!(
                    "the order for {class} H is at least {}, and that it is {order} cannot be decided here",
                    found.order
                ));
            };
            return refused(format!(
                "the order for {class} H is {}, not {order}: {violated}",
                found.order
            ));
        }
        if exactly && found.order > order {
            return refused(format!(
                "the order for {class} H is {}, not {order}: all conditions of order {} hold",
                found.order,
                order + 1
            ));
        }
        if exactly && found.refuted_by.is_none() {
            return refused(format!(
                "the order for {class} H is at least {order}, and that it is not higher cannot be decided here"
            ));
        }
        let requirement = Requirement::Order {
            class,
            exactly,
            order,
        };
        self.enough(&requirement, found.evidence, accepted)
    }

    fn enough(
        &self,
        requirement: &Requirement,
        evidence: Evidence,
        accepted: Option<u32>,
    ) -> Result<(), ErrorKind> {
        match evidence {
            Evidence::Verified { bits } if accepted.is_none_or(|accepted| accepted > bits) => {
                Err(ErrorKind::NotProved {
                    requirement: requirement.to_string(),
                    bits,
                })
            }
            _ => Ok(()),
        }
    }
}

/// Derives a definition and decides a requirement: what [`assert_order!`](crate::assert_order) does.
///
/// # Errors
/// What is wrong with the texts, or with the method.
pub fn require(definition: &str, requirement: &str) -> Result<(), Error> {
    let tableau = crate::Definition::parse(definition)?.derive(&crate::Limits::default())?;
    Ok(tableau.require(&Requirement::parse(requirement)?, None)?)
}

/// Asserts the order of a method of `symplectic::tableau!` for a class of Hamiltonians, proved from its exact
/// coefficients: `assert_order!(Lobatto3, general == 4)`, `assert_order!(Lobatto3, nystrom >= 4)`.
///
/// The classes are those of [`HamiltonianClass`](crate::order::HamiltonianClass): `general`, `separable`,
/// `nystrom`. With `symplectic-compiler` as a dev-dependency, order conditions are decided in a crate's
/// tests, and its normal dependencies stay free of big numbers.
///
/// # Panics
/// Where the order is another one: with the condition that is violated.
#[macro_export]
macro_rules! assert_order {
    ($method:ty, $class:ident $sign:tt $order:literal) => {
        if let Err(error) = $crate::require(
            <$method as ::symplectic::Method>::DEFINITION,
            concat!(
                "order(",
                stringify!($class),
                ") ",
                stringify!($sign),
                " ",
                $order
            ),
        ) {
            panic!("{}: {error}", stringify!($method));
        }
    };
}
