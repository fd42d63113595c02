//! The order of a splitting for perturbed systems `H = H_A + εH_B`.
//!
//! Drifts integrate `H_A` and kicks integrate `εH_B`, as in the `SABA` and `SBAB` methods of Laskar & Robutel (2001); with
//! positions and momenta exchanged the roles are exchanged. A method has the order `(s₁, s₂, …)`, `s₁ ≥ s₂ ≥ …`, if
//! its modified Hamiltonian differs from `H` by
//!
//! ```text
//! O(ε h^{s₁} + ε² h^{s₂} + ε³ h^{s₃} + ⋯):
//! ```
//!
//! the terms of `log S` with `j` letters `B` vanish up to the degree `s_j`, apart from `A + B` (Blanes, Casas, Farrés, Laskar,
//! Makazaga & Murua 2013). This holds if and only if the Lyndon words with `j` letters `B` and degree at most `s_j` have the
//! same coefficients in `S` as in `exp(A + B)`, `1/|w|!`; [`crate::certify`] gives the reason. So `s_m` is the largest degree
//! up to which the conditions with at most `m` letters `B` hold, and the condition that refutes `s_m + 1` has a word.
//!
//! The words with one letter `B` are quadrature conditions, `Σ k_i c_iⁿ = 1/(n + 1)` with the kicks `k_i` at the times `c_i`.
//! So `s₁` is the degree of the quadrature plus 1. The conditions of all words together are those for separable `H`, so that
//! the orders decrease to the order `p` for these, with `s_{p−1} = p` at the latest.

use std::fmt;

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::One;

use super::exponential_words::Product;
use super::weights::most_products;
use super::{GivenOrder, SHORT, short};
use crate::algebra::{Dense, Field, Rationals, Zero};
use crate::certify::{DRIFT, KICK, MAX_ORDER, MAX_PERTURBED_ORDER, Word, split_lyndon};
use crate::evidence::{Evidence, evidence_text};
use crate::exact::Exact;
use crate::partitioned::Partitioned;
use crate::schedule::{Class, Node, StepGraph};
use crate::stability::superscript;

/// The order `(s₁, s₂, …)` of a splitting for `H = H_A + εH_B` with drifts for `H_A` and kicks for `εH_B`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PerturbedOrder {
    /// The orders in `ε`, `ε²`, …, at least two; the last one holds for all higher powers, and so is the order for
    /// separable `H`.
    pub powers: Vec<PowerOrder>,
}

/// The order in a power of `ε`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PowerOrder {
    /// The degree up to which all conditions of this power and the lower ones hold.
    pub order: usize,
    /// The evidence that they hold.
    pub evidence: Evidence,
    /// A violated condition of the next degree, of this power or a lower one. If there is none, the
    /// order is a lower bound: conditions of higher degrees were not evaluated.
    pub refuted_by: Option<ViolatedWord>,
}

/// A violated condition on the coefficient of a word.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ViolatedWord {
    /// The word: `A^2B` for `AAB`.
    pub word: String,
    /// Its coefficient, exact if that is short, otherwise its first digits and `…`.
    pub value: String,
    /// Its required value, `1/|w|!`.
    pub wanted: BigRational,
    /// The value minus the required value, written like the value.
    pub residual: String,
}

impl PerturbedOrder {
    /// The numbers `s₁, s₂, …`.
    pub fn orders(&self) -> Vec<usize> {
        self.powers.iter().map(|power| power.order).collect()
    }

    /// The order in a power of `ε`, with `power` at least 1.
    pub fn power(&self, power: usize) -> Option<&PowerOrder> {
        let known = self.powers.get(power.saturating_sub(1));
        known.or(self.powers.last())
    }

    /// The orders as text, `(8, 2)`, with `≥` for a lower bound.
    pub fn numbers(&self) -> String {
        let number = |power: &PowerOrder| {
            let at_least = if power.refuted_by.is_none() {
                "≥ "
            } else {
                ""
            };
            format!("{at_least}{}", power.order)
        };
        let numbers: Vec<String> = self.powers.iter().map(number).collect();
        format!("({})", numbers.join(", "))
    }
}

impl fmt::Display for PerturbedOrder {
    /// `(4, 2), proved; not 5 in ε: …; not 3 in ε²: …`
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.numbers())?;
        let evidence = |power: &PowerOrder| evidence_text(power.evidence);
        let mut known: Vec<String> = self.powers.iter().map(evidence).collect();
        // One word for all, or one for each order.
        if known.iter().all(|word| *word == known[0]) {
            known.truncate(1);
        }
        write!(f, ", {}", known.join(" and "))?;
        let mut before = None;
        for (index, power) in self.powers.iter().enumerate() {
            if let Some(violated) = &power.refuted_by
                && before != Some(power.order)
            {
                let exponent = match index {
                    0 => String::new(),
                    _ => superscript(index + 1),
                };
                write!(f, "; not {} in ε{exponent}: {violated}", power.order + 1)?;
            }
            before = Some(power.order);
        }
        Ok(())
    }
}

impl fmt::Display for ViolatedWord {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ViolatedWord {
            word,
            value,
            wanted,
            residual,
        } = self;
        write!(
            f,
            "{word} has the coefficient {value} instead of {wanted}, a difference of {residual}"
        )
    }
}

/// The order of an explicit method; `None` if it is not a splitting for separable `H`. `given` is the order that follows from its
/// construction.
pub(crate) fn perturbed_order(exact: &Exact, given: Option<&GivenOrder>) -> Option<PerturbedOrder> {
    struct Orders<'a>(Option<&'a GivenOrder>);

    impl OfLetters for Orders<'_> {
        type Found = Option<PerturbedOrder>;

        fn of<F: Field>(self, field: &F, letters: Vec<(u8, F::Element)>) -> Self::Found {
            Some(of_letters(field, letters, self.0))
        }
    }

    with_letters(exact, Orders(given))
}

/// What is found from the kicks and drifts of a splitting over any field.
pub(super) trait OfLetters {
    type Found;

    fn of<F: Field>(self, field: &F, letters: Vec<(u8, F::Element)>) -> Self::Found;
}

/// Finds something from the kicks and drifts of a method; `None` if it is not a splitting for separable `H`, or has gradient kicks.
pub(super) fn with_letters<T, O: OfLetters<Found = Option<T>>>(exact: &Exact, of: O) -> Option<T> {
    if exact.has_gradient_kicks() {
        return None;
    }
    let numbers = exact.numbers();
    let graph = StepGraph::new(Class::Separable, exact, &numbers);
    let chain = graph.splitting()?;
    match exact {
        // The splittings among these have only one or two nodes, which are 0 and 1.
        Exact::Nodes(_) => {
            let rational = |&node: &Node| {
                let weight = graph.evaluation(node).weight.short_rational()?;
                Some((letter(node), weight))
            };
            let letters: Option<Vec<_>> = chain.iter().map(rational).collect();
            of.of(&Rationals, letters?)
        }
        Exact::Field(pair) => {
            let letters = letters(pair, &graph, &chain);
            of.of(pair.algebra.field(), letters)
        }
        Exact::Reals(pair) => {
            let letters = letters(pair, &graph, &chain);
            of.of(pair.algebra.field(), letters)
        }
    }
}

/// Orders in `ε`, `ε²`, … as text: `(8, 4)`.
pub fn listed(orders: &[usize]) -> String {
    let orders: Vec<String> = orders.iter().map(usize::to_string).collect();
    format!("({})", orders.join(", "))
}

fn letter(node: Node) -> u8 {
    match node {
        Node::Force(_) => KICK,
        _ => DRIFT,
    }
}

/// Kicks and drifts with their fractions of the step: the sums of the weights of coinciding stages.
fn letters<F: Field>(
    pair: &Partitioned<Dense<F>>,
    graph: &StepGraph<'_>,
    chain: &[Node],
) -> Vec<(u8, F::Element)> {
    let field = pair.algebra.field();
    let fraction = |&node: &Node| {
        let weights = match letter(node) {
            KICK => &pair.b_tilde,
            _ => &pair.b,
        };
        let stages = graph.argument(node).map_or(&[][..], |value| &value.stages);
        let zero = field.rational(&BigRational::default());
        let sum = stages
            .iter()
            .fold(zero, |sum, &stage| field.add(&sum, &weights[stage]));
        (letter(node), sum)
    };
    chain.iter().map(fraction).collect()
}

fn of_letters<F: Field>(
    field: &F,
    letters: Vec<(u8, F::Element)>,
    given: Option<&GivenOrder>,
) -> PerturbedOrder {
    let mut product = Product::new(field, letters);
    // The given order is used only where enclosures would merely verify it.
    let given = given.filter(|_| field.verified_bits().is_some());
    let first = power_order(&mut product, 1, MAX_PERTURBED_ORDER, None, given);
    let mut powers = vec![first];
    let mut power = 2;
    while let Some(before) = powers.last()
        && (power == 2 || power < before.order)
    {
        let limit = before.order.min(MAX_ORDER);
        let next = power_order(&mut product, power, limit, Some(before), given);
        powers.push(next);
        power += 1;
    }
    // The last order holds for all higher powers.
    while powers.len() > 2
        && powers[powers.len() - 1].order == powers[powers.len() - 2].order
        && let Some(last) = powers.pop()
        && let Some(kept) = powers.last_mut()
    {
        kept.evidence = kept.evidence.and(last.evidence);
    }
    PerturbedOrder { powers }
}

/// The order in a power of `ε`, at most `limit`: from the conditions, the result for the previous power, and the given
/// order, up to which no condition is evaluated.
fn power_order<F: Field>(
    product: &mut Product<'_, F>,
    power: usize,
    limit: usize,
    before: Option<&PowerOrder>,
    given: Option<&GivenOrder>,
) -> PowerOrder {
    let verified = product.field().verified_bits();
    let given_order = given.map_or(0, |given| given.in_power(power));
    let known = |order, refuted_by| PowerOrder {
        order,
        evidence: match (given, verified) {
            (Some(given), _) if order <= given_order => given.evidence,
            (_, Some(bits)) => Evidence::Verified { bits },
            _ => Evidence::Proved,
        },
        refuted_by,
    };
    // For m > 1 there is no condition of degree m with m letters B: the word B^m is not a Lyndon word.
    let holds = given_order.max(if power == 1 { 0 } else { power });
    for degree in holds + 1..=limit {
        if product.cost() > most_products(product.field()) {
            return known(degree - 1, None);
        }
        if let Some(violated) = violated(product, power, degree) {
            return known(degree - 1, Some(violated));
        }
    }
    match before {
        Some(before) if before.order <= limit => known(before.order, before.refuted_by.clone()),
        _ => known(limit, None),
    }
}

/// A violated condition of a degree, with `power` letters `B`.
fn violated<F: Field>(
    product: &mut Product<'_, F>,
    power: usize,
    degree: usize,
) -> Option<ViolatedWord> {
    let field = product.field();
    let wanted = exact_flow(degree);
    conditions(power, degree).into_iter().find_map(|word| {
        let value = product.coefficient(&word);
        let residual = field.subtract(&value, &field.rational(&wanted));
        (field.zero(&residual) == Zero::No).then(|| ViolatedWord {
            word: text(&word),
            value: exact_or_short(field, &value),
            wanted: wanted.clone(),
            residual: exact_or_short(field, &residual),
        })
    })
}

/// The words of a degree with `power` letters `B`, whose coefficients are the conditions.
fn conditions(power: usize, degree: usize) -> Vec<Word> {
    match degree {
        1 => vec![vec![DRIFT], vec![KICK]],
        _ => split_lyndon(degree - power, power),
    }
}

/// `1/n!`, the coefficient of a word with `n` letters in `exp(A + B)`.
fn exact_flow(degree: usize) -> BigRational {
    let factorial: BigInt = (1..=degree).fold(BigInt::one(), |n, k| n * k);
    BigRational::new(BigInt::one(), factorial)
}

/// A word with powers for repeated letters: `A^2B`.
fn text(word: &[u8]) -> String {
    let run = |run: &[u8]| {
        let name = if run[0] == DRIFT { 'A' } else { 'B' };
        match run.len() {
            1 => name.to_string(),
            length => format!("{name}^{length}"),
        }
    };
    word.chunk_by(PartialEq::eq).map(run).collect()
}

fn exact_or_short<F: Field>(field: &F, x: &F::Element) -> String {
    match field.exact(x) {
        Some(exact) if exact.chars().count() <= SHORT => exact,
        _ => short(&field.number(x)),
    }
}
