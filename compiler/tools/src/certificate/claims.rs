//! The proved claims about a method, and the names of those that are not proved.

use num_rational::BigRational;
use num_traits::Zero;

use symplectic_compiler::Evidence;
use symplectic_compiler::Tableau;
use symplectic_compiler::inside::Exact;
use symplectic_compiler::inside::Fact;
use symplectic_compiler::inside::LowerTriangular;
use symplectic_compiler::inside::images;
use symplectic_compiler::order::{ClassOrder, HamiltonianClass};
use symplectic_compiler::stability::{Stability, StabilityInterval, StableSteps};
use symplectic_exact::polynomial::Polynomial;
use symplectic_exact::roots::sturm_chain;

use Fact::{List, Literal, Table, Text};

/// The significant digits of the ends of intervals.
const DIGITS: usize = 40;

/// The claims, and `not_covered` with the names of the missing ones.
pub(super) fn of(
    tableau: &Tableau,
    lower_triangular: Option<LowerTriangular>,
) -> Vec<(&'static str, Fact)> {
    let mut claims = Vec::new();
    let mut missing: Vec<String> = Vec::new();
    let properties = tableau.properties();
    if lower_triangular.is_some() {
        // Symplectic by the form of its matrices.
        let palindrome = tableau.separable_properties().symmetric;
        note(
            &mut claims,
            &mut missing,
            "palindrome",
            palindrome.holds,
            palindrome.evidence,
        );
    } else {
        let found = properties.symplectic;
        note(
            &mut claims,
            &mut missing,
            "symplectic",
            found.holds,
            found.evidence,
        );
        let found = properties.symmetric;
        // A witness means that the order of the stages is not the reverse one; the checker does not look for it.
        match (found.holds && found.witness.is_some(), found.evidence) {
            (true, Evidence::Proved) => match order_of_stages(tableau) {
                Some(order) => claims.push(("symmetric", order)),
                None => missing.push("symmetric".to_owned()),
            },
            (true, _) => missing.push("symmetric".to_owned()),
            (_, evidence) => note(
                &mut claims,
                &mut missing,
                "symmetric",
                found.holds,
                evidence,
            ),
        }
    }
    let report = tableau.orders();
    let mut orders = Vec::new();
    let classes = HamiltonianClass::ALL.into_iter();
    for class in classes.filter(|class| report.class(*class).exists()) {
        match class_order(report.class(class)) {
            Some(order) => orders.push((class.name(), order)),
            None => missing.push(format!("order ({class})")),
        }
    }
    claims.push(("order", Table(orders)));
    if let Some(found) = tableau.perturbed_order() {
        let proved = found
            .powers
            .iter()
            .all(|power| is_proved(power.evidence) && power.refuted_by.is_some());
        match proved {
            true => {
                let orders = found.orders().into_iter();
                let orders = orders.map(|order| Literal(order.to_string()));
                claims.push(("perturbed", List(orders.collect())));
            }
            false => missing.push("order (perturbed)".to_owned()),
        }
    }
    // That of a processed method is the stability of its kernel, of which a certificate says nothing.
    let stable = match tableau.processed() {
        Some(_) => None,
        None => stability(tableau, lower_triangular),
    };
    match stable {
        Some(found) => claims.push(("stability", found)),
        None => missing.push("stability".to_owned()),
    }
    claims.push(("not_covered", List(missing.into_iter().map(Text).collect())));
    claims
}

/// The order of the stages, counted from 1, with which the method is symmetric; `None` if its matrices are functions of the nodes.
fn order_of_stages(tableau: &Tableau) -> Option<Fact> {
    let images = match tableau.exact() {
        Exact::Field(_) => images(&tableau.numbers())?,
        _ => return None,
    };
    let stages = images.into_iter().map(|i| Literal((i + 1).to_string()));
    Some(List(stages.collect()))
}

fn is_proved(evidence: Evidence) -> bool {
    matches!(
        evidence,
        Evidence::Proved | Evidence::Refuted | Evidence::Certified
    )
}

/// Notes a property that holds or does not hold as a claim, if that is proved.
fn note(
    claims: &mut Vec<(&'static str, Fact)>,
    missing: &mut Vec<String>,
    name: &'static str,
    holds: bool,
    evidence: Evidence,
) {
    match is_proved(evidence) {
        true => claims.push((name, Literal(holds.to_string()))),
        false => missing.push(name.to_owned()),
    }
}

/// The order, and a violated condition of the next order.
fn class_order(found: &ClassOrder) -> Option<Fact> {
    let violated = found.refuted_by.as_ref()?;
    is_proved(found.evidence).then(|| {
        Table(vec![
            ("order", Literal(found.order.to_string())),
            ("violated", Text(violated.tree.to_string())),
            ("residual", Text(violated.residual_decimal.to_string())),
        ])
    })
}

/// The most digits of a chain, and of one of its numbers: Python reads no longer ones.
const MAX_DIGITS: usize = 1_000_000;
const MAX_DIGITS_OF_NUMBER: usize = 4000;

/// Sturm's chain of the polynomial that vanishes at `ν² ≠ 0` where the stages have no unique solution or the trace is 2 or −2; `None` if it
/// is too long.
fn chain(stages: &Polynomial, numerator: &Polynomial, denominator: &Polynomial) -> Option<Fact> {
    let twice = denominator.scale(&BigRational::from_integer(2.into()));
    let mut all = &(stages * &(&twice - numerator)) * &(&twice + numerator);
    while !all.is_zero() && all.coefficient(0).is_zero() {
        all = all.div_rem(&Polynomial::variable())?.0;
    }
    let (simple, _) = all.div_rem(&all.gcd(&all.derivative()))?;
    let chain = sturm_chain(&simple);
    let lengths = chain
        .iter()
        .flat_map(|f| f.numerators())
        .map(|c| c.to_string().len());
    let (longest, total) = lengths.fold((0, 0), |(longest, sum), n| (n.max(longest), sum + n));
    let row = |f: &Polynomial| {
        let numbers = f.numerators().iter();
        List(numbers.map(|c| Literal(c.to_string())).collect())
    };
    let short = total <= MAX_DIGITS && longest <= MAX_DIGITS_OF_NUMBER;
    short.then(|| List(chain.iter().map(row).collect()))
}

/// All stable steps of an area-preserving method, and the trace if it is rational; `None` if an irrational one touches 2 or −2. For a
/// solution of order conditions they are verified here, and the checker proves them; it needs no zeros for a splitting.
fn stability(tableau: &Tableau, lower_triangular: Option<LowerTriangular>) -> Option<Fact> {
    let StableSteps::All(found) = tableau.stable_steps() else {
        return None;
    };
    let Stability {
        trace, intervals, ..
    } = &*found;
    let is_known = match found.evidence {
        Evidence::Proved => true,
        Evidence::Verified { .. } => lower_triangular.is_some(),
        _ => false,
    };
    if !found.preserves_area || !is_known {
        return None;
    }
    // The checker finds simple roots only of irrational polynomials.
    if trace.rational.is_none() && found.touches {
        return None;
    }
    let list = |texts: Vec<BigRational>| List(texts.iter().map(|x| Text(x.to_string())).collect());
    let interval = |i: &StabilityInterval| {
        List(vec![
            Text(i.low.decimal(DIGITS)),
            Text(i.high.decimal(DIGITS)),
            Literal(i.low_closed.to_string()),
            Literal(i.high_closed.to_string()),
        ])
    };
    let mut members = Vec::new();
    if let Some((numerator, denominator)) = &trace.rational {
        members.extend([
            ("numerator", list(numerator.coefficients())),
            ("denominator", list(denominator.coefficients())),
        ]);
        let [[_, m12], [m21, _]] = &found.matrix;
        if m12.rational.is_some() && m21.rational.is_some() {
            let (stages, _) = found.stages.rational.as_ref()?;
            members.push(("chain", chain(stages, numerator, denominator)?));
        }
    }
    members.push(("intervals", List(intervals.iter().map(interval).collect())));
    Some(Table(members))
}
