//! What a user can require of a method: `symplectic`, `order(separable) == 6`, `stable_to(2)`.

mod fitted;
mod perturbed;

use std::fmt;

use num_rational::BigRational;
use num_traits::Signed;

use crate::definition::Definition;
use crate::error::{Error, ErrorKind};
use crate::evidence::Evidence;
use crate::expression::{ExpressionKind, Input, parse_list, shown};
use crate::limits::Limits;
use crate::order::{HamiltonianClass, OrderOptions, listed};
use crate::properties::{GRADIENT_KICKS, Properties, SeparableProperties};
use crate::stability::StableSteps;
use crate::tableau::Tableau;

/// A requirement, as written in `require: […]`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Requirement {
    /// A property of [`Properties::NAMES`].
    Property(String),
    /// A property of [`SeparableProperties::NAMES`], for separable Hamiltonians or for those with quadratic `T`:
    /// `symplectic(separable)`, `symmetric(nystrom)`.
    ClassProperty {
        /// The property.
        name: String,
        /// The class of Hamiltonians.
        class: HamiltonianClass,
    },
    /// `order >= 4`, `order(separable) == 6`; without a class for every Hamiltonian.
    Order {
        /// The class of Hamiltonians.
        class: HamiltonianClass,
        /// Whether it is the order exactly, or at least.
        exactly: bool,
        /// The order.
        order: usize,
    },
    /// `order(perturbed) >= (8, 4)`: the orders in `ε`, `ε²`, … of a splitting for `H_A + εH_B`, the last one in all
    /// higher powers too.
    PerturbedOrder {
        /// Whether these are the orders exactly, or at least.
        exactly: bool,
        /// The orders.
        orders: Vec<usize>,
    },
    /// Stable on the oscillator for every step size.
    PStable,
    /// Stable on the oscillator for `0 < hω ≤ bound`.
    StableTo(BigRational),
}

/// The requirements other than properties, as messages list them.
const OTHERS: &str = "symplectic(separable), symmetric(separable), the same for nystrom, order >= 4, order(separable) == 6, order(perturbed) >= (8, 4), p_stable, stable_to(2)";

impl Requirement {
    /// Reads a requirement.
    ///
    /// # Errors
    /// [`ErrorKind::Unknown`] and [`ErrorKind::Type`] at the place of the error.
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
                if perturbed::is_meant(left) {
                    let orders = perturbed::read(right)
                        .map_err(|kind| input.error(&(start..text.len()), kind))?;
                    return Ok(Requirement::PerturbedOrder { exactly, orders });
                }
                let number = right.trim().parse().map_err(|_| {
                    let found = match right.trim() {
                        "" => "nothing".to_owned(),
                        right => shown(right),
                    };
                    let kind = ErrorKind::Type {
                        found,
                        expected: "an order, a whole number of at most 19 digits".to_owned(),
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
            if text.trim_start().starts_with("order") {
                let kind = ErrorKind::Type {
                    found: shown(text.trim()),
                    expected: "`order >= 4`, `order == 4`, or the same with a class, as in `order(separable) >= 4`"
                        .to_owned(),
                };
                return input.error(&(0..text.len()), kind);
            }
            if text.trim().parse::<u64>().is_ok() {
                let kind = ErrorKind::Type {
                    found: shown(text.trim()),
                    expected: "a requirement; several orders stand in brackets, as in `order(perturbed) >= (8, 4)`"
                        .to_owned(),
                };
                return input.error(&(0..text.len()), kind);
            }
            let known = Properties::NAMES.join(", ");
            let kind = ErrorKind::Unknown {
                what: "property",
                name: shown(text.trim()),
                known: format!("{known}, {OTHERS}"),
            };
            input.error(&(0..text.len()), kind)
        };
        let items = match parse_list(input) {
            Ok(items) => items,
            // What is wrong is in the bound, not in the name.
            Err(error) if text.trim_start().starts_with("stable_to") => return Err(error),
            Err(_) => return Err(unknown()),
        };
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
                let bound = arguments[0].rational(input)?;
                if !bound.is_positive() {
                    let kind = ErrorKind::Type {
                        found: shown(&bound.to_string()),
                        expected: "a positive bound on hω".to_owned(),
                    };
                    return Err(input.error(&(0..text.len()), kind));
                }
                Ok(Requirement::StableTo(bound))
            }
            ExpressionKind::Call {
                function,
                arguments,
                ..
            } if SeparableProperties::NAMES.contains(&function.as_str()) => {
                let mut classes =
                    [HamiltonianClass::Separable, HamiltonianClass::Nystrom].into_iter();
                let class = classes.find(|class| {
                    matches!(arguments.as_slice(), [name]
                        if name.kind == ExpressionKind::Name(class.to_string()))
                });
                let name = function.clone();
                class
                    .map(|class| Requirement::ClassProperty { name, class })
                    .ok_or_else(unknown)
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
            known: format!("order, {}, order(perturbed)", classes.join(", ")),
        };
        input.error(&whole, kind)
    })
}

impl fmt::Display for Requirement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Requirement::Property(name) => f.write_str(name),
            Requirement::ClassProperty { name, class } => write!(f, "{name}({class})"),
            Requirement::Order {
                class,
                exactly,
                order,
            } => {
                let sign = if *exactly { "==" } else { ">=" };
                write!(f, "order({class}) {sign} {order}")
            }
            Requirement::PerturbedOrder { exactly, orders } => {
                let sign = if *exactly { "==" } else { ">=" };
                write!(f, "order(perturbed) {sign} {}", listed(orders))
            }
            Requirement::PStable => f.write_str("p_stable"),
            Requirement::StableTo(bound) => write!(f, "stable_to({bound})"),
        }
    }
}

impl Tableau {
    /// Decides a requirement. Certified statements count as proved. `accepted` are the binary places to which it is enough that equations
    /// are verified; without them everything has to be proved.
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
                let mut message = format!("the method is not `{name}`: {witness}");
                let separable = self.separable_properties();
                if !property.holds && separable.get(name).is_some_and(|found| found.holds) {
                    let class = separable.class;
                    message.push_str(&format!("; for {class} H it is: require `{name}({class})`"));
                }
                (property.holds, property.evidence, message)
            }
            Requirement::ClassProperty { name, class } => {
                let properties = self.separable_properties();
                let Some(property) = properties.get(name) else {
                    return Err(refuted(format!("there is no property `{requirement}`")));
                };
                if (*class, properties.class)
                    == (HamiltonianClass::Separable, HamiltonianClass::Nystrom)
                {
                    return Err(refuted(format!(
                        "the method is not `{requirement}`: {GRADIENT_KICKS}; require `{name}(nystrom)`"
                    )));
                }
                let witness = property.witness.as_deref().unwrap_or("no witness");
                let message = format!("the method is not `{requirement}`: {witness}");
                (property.holds, property.evidence, message)
            }
            Requirement::Order {
                class,
                exactly,
                order,
            } => return self.require_order(*class, *exactly, *order, accepted),
            Requirement::PerturbedOrder { exactly, orders } => {
                return self.require_perturbed(requirement, *exactly, orders, accepted);
            }
            Requirement::PStable | Requirement::StableTo(_) => {
                let bound = match requirement {
                    Requirement::StableTo(bound) => Some(bound),
                    _ => None,
                };
                let (steps, holds, evidence) = self.stable_to(bound);
                let not = match bound {
                    Some(bound) => format!("stable up to hω = {bound}"),
                    None => "`p_stable`".to_owned(),
                };
                let message = match evidence {
                    Evidence::Undecided { .. } => format!("whether the method is {not}: {steps}"),
                    _ => format!("the method is not {not}: it is stable for hω in {steps}"),
                };
                (holds, evidence, message)
            }
        };
        if !holds {
            return Err(refuted(message));
        }
        self.enough(requirement, evidence, accepted)
    }

    /// The stable steps as text, whether all up to a bound are among them, or all there are, and how that is known.
    fn stable_to(&self, bound: Option<&BigRational>) -> (String, bool, Evidence) {
        let steps = self.stable_steps();
        if let StableSteps::First { interval, evidence } = &steps {
            let holds = bound.is_some_and(|bound| interval.contains(bound));
            return (steps.to_string(), holds, *evidence);
        }
        if let StableSteps::NotDecided { bits } = steps {
            return (steps.to_string(), false, Evidence::Undecided { bits });
        }
        let stability = self.stability();
        let holds = bound.map_or(stability.p_stable, |bound| stability.stable_to(bound));
        (stability.intervals_text(), holds, stability.evidence)
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
        if !found.exists() {
            return refused(format!(
                "the method has no order for {class} H: {GRADIENT_KICKS}; require `order(nystrom)`"
            ));
        }
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
/// `accepted` is as in [`Tableau::require`]; `limits` has to let the stages of the method through.
///
/// # Errors
/// What is wrong with the texts, or with the method.
pub fn require(
    definition: &str,
    requirement: &str,
    accepted: Option<u32>,
    limits: &Limits,
) -> Result<(), Error> {
    let tableau = Definition::parse(definition)?.derive(limits)?;
    Ok(tableau.require(&Requirement::parse(requirement)?, accepted)?)
}

/// The message of an [`assert_order!`](crate::assert_order) that fails: its error, and for what is only verified the assertion that accepts
/// this.
///
/// ```
/// use symplectic_compiler::{ErrorKind, failed_assertion};
///
/// let kind = ErrorKind::NotProved { requirement: "order(general) == 2".to_owned(), bits: 2048 };
/// assert!(failed_assertion("Waves", "general == 2", &kind.into()).ends_with(
///     "takes that for enough: `assert_order!(Waves, general == 2, accept: verified(2048 bits))`"
/// ));
/// ```
pub fn failed_assertion(method: &str, assertion: &str, error: &Error) -> String {
    let accepted = match &*error.kind {
        ErrorKind::NotProved { bits, .. } => {
            format!(": `assert_order!({method}, {assertion}, accept: verified({bits} bits))`")
        }
        _ => String::new(),
    };
    format!("{method}: {error}{accepted}")
}

/// Asserts the order of a method of `symplectic::tableau!` for a class of Hamiltonians, proved from its exact
/// coefficients: `assert_order!(Lobatto3, general == 4)`, `assert_order!(Lobatto3, nystrom >= 4)`. For a method
/// that is only known by enclosures:
/// `assert_order!(Waves, general == 2, accept: verified(100 bits))`.
///
/// The classes are those of [`HamiltonianClass`](crate::order::HamiltonianClass): `general`, `separable`,
/// `nystrom`; and `assert_order!(Saba4, perturbed == (8, 2))` for splittings. With `symplectic-compiler` as a dev-dependency, order conditions are decided in a crate's
/// tests, and its normal dependencies stay free of big numbers.
///
/// # Panics
/// Where the order is another one: with the condition that is violated.
#[macro_export]
macro_rules! assert_order {
    ($method:ty, $class:ident == $order:tt $(, accept: verified($bits:literal bits))? $(,)?) => {
        $crate::assert_order!(@ $method, $class, "==", $order, [$($bits)?])
    };
    ($method:ty, $class:ident >= $order:tt $(, accept: verified($bits:literal bits))? $(,)?) => {
        $crate::assert_order!(@ $method, $class, ">=", $order, [$($bits)?])
    };
    (@ $method:ty, $class:ident, $sign:literal, $order:tt, [$($bits:literal)?]) => {{
        let mut accepted: ::core::option::Option<u32> = ::core::option::Option::None;
        $(accepted = ::core::option::Option::Some($bits);)?
        let _ = &mut accepted;
        // It has compiled, so its stages were allowed.
        let limits = $crate::Limits {
            stages: ::core::cmp::max(
                $crate::Limits::default().stages,
                <$method as ::symplectic::Method>::STAGES,
            ),
        };
        if let ::core::result::Result::Err(error) = $crate::require(
            <$method as ::symplectic::Method>::DEFINITION,
            ::core::concat!("order(", ::core::stringify!($class), ") ", $sign, " ", ::core::stringify!($order)),
            accepted,
            &limits,
        ) {
            let assertion =
                ::core::concat!(::core::stringify!($class), " ", $sign, " ", ::core::stringify!($order));
            ::core::panic!(
                "{}",
                $crate::failed_assertion(::core::stringify!($method), assertion, &error)
            );
        }
    }};
    ($($other:tt)*) => {
        ::core::compile_error!(
            "expected `assert_order!(Method, general == 4)`: a class, `==` or `>=`, and a whole number; behind it `accept: verified(100 bits)` may follow"
        )
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn malformed_requirements_are_refused_at_the_column() {
        for (text, message) in [
            (
                "order >=",
                "require, column 9: found nothing, expected an order, a whole number of at most 19 digits",
            ),
            (
                "order >= 99999999999999999999999",
                "a whole number of at most 19 digits",
            ),
            ("stable_to(0)", "found 0, expected a positive bound on hω"),
            (
                "stable_to(-1/2)",
                "found -1/2, expected a positive bound on hω",
            ),
            ("stable_to(1 +)", "require, column 14: "),
            ("stable_t(1)", "unknown property `stable_t(1)`"),
            ("stable_t(1)", "; did you mean `stable_to(2)`?"),
            ("simplectic", "; did you mean `symplectic`?"),
            ("constraint", "; did you mean `constrained`?"),
            (
                "symetric(separable)",
                "; did you mean `symmetric(separable)`?",
            ),
            (
                "order(seperable) >= 4",
                "; did you mean `order(separable)`?",
            ),
            (
                "order(perturbed) >= (4, 8)",
                "require, column 20: found (4, 8), expected an order in each power of ε, none above the one before, as in (8, 4)",
            ),
            (
                "order(perturbed) == (8, two)",
                "require, column 20: found (8, two), expected",
            ),
            (
                "order(perturbed) >= ()",
                "found (), expected an order in each power of ε, none above the one before, as in (8, 4)",
            ),
            (
                "order(perturbed) >=",
                "found nothing, expected an order in each power",
            ),
        ] {
            let error = Requirement::parse(text).expect_err(text).to_string();
            assert!(error.contains(message), "{text}: {error}");
        }
    }
}
