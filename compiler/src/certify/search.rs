//! From printed digits to a certificate: tries each structure until one has a solution near the digits.

use num_rational::BigRational;
use num_traits::{Signed, Zero};

use super::certificate::{Certificate, Enclosed, Facts, Fixed, Solution, Uniqueness, distance};
use super::conditions::{Claim, Conditions};
use super::digits::{Digits, distances};
use super::error::CertifyError;
use super::lyndon::{DRIFT, KICK};
use super::newton::Square;
use super::printed::Printed;
use super::processed::Processor;
use super::proof::Proof;
use super::selection::free_unknowns;
use super::settle::{Settled, settle};
use super::splitting::{Splitting, check, tolerance, wrong_sum};
use super::structure::{
    Coefficient, Reading, Target, composition_readings, processed_readings, readings,
};
use super::system::{Kind, Step, System};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::rational::simplest_between;
use crate::arithmetic::rounding::Decimal;

/// Proves that a splitting with exact coefficients and the claimed order exists near the printed digits.
///
/// # Errors
/// * [`CertifyError::Lengths`], [`CertifyError::GradientLengths`], [`CertifyError::Stages`], [`CertifyError::TooLarge`], [`CertifyError::Order`] if
///   the input is not a valid splitting or claim,
/// * [`CertifyError::GradientKicks`] for gradient kicks with another claim than [`Claim::Nystrom`],
/// * [`CertifyError::WeightSum`] if kicks or drifts do not sum to 1, by more than their digits explain,
/// * [`CertifyError::TooFewCoefficients`] if there are more conditions than unknowns,
/// * [`CertifyError::DifferentSolution`], with its certificate, if the nearest exact method that was found is
///   farther away than `10^−10` and ten units of the last printed place,
/// * [`CertifyError::Dependent`] and [`CertifyError::NotFound`] if no exact method was found.
pub fn certify(splitting: &Splitting, claim: &Claim) -> Result<Certificate, CertifyError> {
    splitting.check()?;
    claim.check()?;
    if !splitting.gradient.is_empty() && !matches!(claim, Claim::Nystrom(_)) {
        let order = claim.order();
        return Err(CertifyError::GradientKicks { order });
    }
    let all = || {
        let linear = splitting.kick.iter().chain(&splitting.drift);
        linear.chain(&splitting.gradient)
    };
    let tolerance = tolerance(all());
    let bits = digit_bits(all());
    let mut readings = readings(splitting);
    if let Claim::SymmetricBase(_) = claim {
        readings.retain(|reading| reading.structure.composition());
    }
    let found = first_certified(&readings, claim, &tolerance, bits);
    for (what, list) in [("kicks", &splitting.kick), ("drifts", &splitting.drift)] {
        check_sum(what, list, &tolerance, &found)?;
    }
    found
}

/// Proves that weights near the printed ones exist with which the composition of any symmetric basic method of
/// order 2 has the claimed order.
///
/// ```
/// use symplectic_compiler::certify::{Printed, certify_composition};
///
/// // Suzuki 1990: 1/(4 − ∛4), four times.
/// let [outer, inner] = ["0.4144907717943757", "-0.6579630871775028"].map(Printed::parse);
/// let (outer, inner) = (outer?, inner?);
/// let weights = [outer.clone(), outer.clone(), inner, outer.clone(), outer];
/// let certificate = certify_composition(&weights, 4)?;
/// assert_eq!(certificate.unknowns(), 2);
/// # Ok::<(), symplectic_compiler::certify::CertifyError>(())
/// ```
///
/// # Errors
/// The same as for [`certify()`].
pub fn certify_composition(weights: &[Printed], order: usize) -> Result<Certificate, CertifyError> {
    check(weights, Coefficient::Weight)?;
    let claim = Claim::SymmetricBase(order);
    claim.check()?;
    let tolerance = tolerance(weights.iter());
    let bits = digit_bits(weights.iter());
    let readings = composition_readings(weights);
    let found = first_certified(&readings, &claim, &tolerance, bits);
    check_sum("weights", weights, &tolerance, &found)?;
    found
}

/// Proves that weights near the printed ones exist with which the processed composition `P K P⁻¹` of any symmetric basic method of order 2 has the
/// claimed order. The kernel K has the weights, which sum to 1; those of the processor P sum to 0.
///
/// # Errors
/// The same as for [`certify()`].
pub fn certify_processed(
    weights: &[Printed],
    processor: &Processor<Printed>,
    order: usize,
) -> Result<Certificate, CertifyError> {
    check(weights, Coefficient::Weight)?;
    check(processor.weights(), Coefficient::Processor)?;
    let claim = Claim::SymmetricBase(order);
    claim.check()?;
    let all = || weights.iter().chain(processor.weights());
    let tolerance = tolerance(all());
    let bits = digit_bits(all());
    let readings = processed_readings(weights, processor);
    let found = first_certified(&readings, &claim, &tolerance, bits);
    check_sum("weights", weights, &tolerance, &found)?;
    found
}

/// The binary places of the proof.
pub const PROOF_BITS: u32 = 320;

/// The binary places with which digits are compared: more than the digits have.
fn digit_bits<'a>(all: impl Iterator<Item = &'a Printed>) -> u32 {
    let places = all.filter_map(Printed::places).max().unwrap_or(0);
    128 + places.saturating_mul(4)
}

fn check_sum(
    what: &'static str,
    list: &[Printed],
    tolerance: &BigRational,
    found: &Result<Certificate, CertifyError>,
) -> Result<(), CertifyError> {
    // Coarse digits that are all correct need not sum to 1.
    let right = |certificate: &Certificate| certificate.digits() == Digits::All;
    if found.as_ref().is_ok_and(right) {
        return Ok(());
    }
    let Some(sum) = wrong_sum(list, tolerance) else {
        return Ok(());
    };
    let nearest = match found {
        Ok(certificate) => Some(Box::new(certificate.clone())),
        Err(CertifyError::DifferentSolution { certificate, .. }) => Some(certificate.clone()),
        Err(_) => None,
    };
    let sum = Decimal::round(&sum, 40).to_string();
    Err(CertifyError::WeightSum {
        what,
        sum: if sum.contains('.') && !sum.contains('e') {
            sum.trim_end_matches('0').trim_end_matches('.').to_owned()
        } else {
            sum
        },
        nearest,
    })
}

/// The certificate of the first reading with a solution near the digits; otherwise the most informative error.
fn first_certified(
    readings: &[Reading],
    claim: &Claim,
    tolerance: &BigRational,
    bits: u32,
) -> Result<Certificate, CertifyError> {
    // Nothing is moved if the numbers satisfy the conditions as they are printed.
    if let Some(found) = readings.iter().find_map(|r| as_printed(r, claim, bits)) {
        return Ok(found);
    }
    let mut worst: Option<CertifyError> = None;
    // The first certificate near the digits, unless another one has all printed digits.
    let mut near: Option<Certificate> = None;
    for reading in readings {
        let error = match certified(reading, claim, bits) {
            Ok(certificate) if certificate.digits() == Digits::All => return Ok(certificate),
            Ok(certificate) if certificate.is_near(tolerance) => {
                near.get_or_insert(certificate);
                continue;
            }
            Ok(certificate) => CertifyError::DifferentSolution {
                allowed: Decimal::round(tolerance, 2).to_string(),
                certificate: Box::new(certificate),
            },
            Err(error) => error,
        };
        if worst
            .as_ref()
            .is_none_or(|known| is_more_informative(&error, known))
        {
            worst = Some(error);
        }
    }
    match near {
        Some(certificate) => Ok(certificate),
        None => Err(worst.unwrap_or(CertifyError::NotAComposition)),
    }
}

/// Whether an error is more informative. A solution ranks highest, and a nearer solution higher; then a failed search;
/// then the number of missing coefficients.
fn is_more_informative(error: &CertifyError, known: &CertifyError) -> bool {
    let rank = |error: &CertifyError| match error {
        CertifyError::DifferentSolution { .. } => 3,
        CertifyError::NotFound { .. } => 2,
        CertifyError::Dependent { .. } => 1,
        _ => 0,
    };
    match (error, known) {
        (
            CertifyError::DifferentSolution { certificate: a, .. },
            CertifyError::DifferentSolution { certificate: b, .. },
        ) => a.distance() < b.distance(),
        (
            CertifyError::TooFewCoefficients {
                conditions: a,
                unknowns: b,
                ..
            },
            CertifyError::TooFewCoefficients {
                conditions: c,
                unknowns: d,
                ..
            },
        ) => a.saturating_sub(*b) < c.saturating_sub(*d),
        _ => rank(error) > rank(known),
    }
}

/// The claim whose conditions are solved for a reading.
fn solved(reading: &Reading, claim: &Claim) -> Claim {
    // A proof for compositions of any symmetric method holds for Störmer–Verlet and each class.
    if reading.structure.composition() {
        Claim::SymmetricBase(claim.order())
    } else {
        claim.clone()
    }
}

/// The conditions that are solved for a reading.
pub(super) fn system_of(reading: &Reading, solved: &Claim) -> Result<System, CertifyError> {
    let steps = reading.steps.clone();
    Ok(match &reading.processing {
        Some(processing) => processing.system(steps, solved),
        None => System::new(
            steps,
            Conditions::new(solved, reading.structure.symmetric())?,
        ),
    })
}

/// The certificate of a method that is found for a reading.
fn certificate(
    reading: &Reading,
    claim: &Claim,
    conditions: usize,
    digit_bits: u32,
    (fixed, uniqueness, solution): (Vec<Fixed>, Option<Uniqueness>, Solution),
    (digits, suspects): (Digits, Vec<Coefficient>),
) -> Certificate {
    Certificate::new(Facts {
        claim: claim.clone(),
        structure: reading.structure,
        conditions,
        unknowns: reading.unknowns.len(),
        fixed,
        targets: reading.targets.clone(),
        sharp: sharp(reading, claim, &solution),
        distance: distance(&reading.targets, &solution, digit_bits),
        digit_bits,
        digits,
        suspects,
        uniqueness,
        solution,
    })
}

/// The certificate of the printed numbers themselves, if they satisfy all conditions exactly.
fn as_printed(reading: &Reading, claim: &Claim, digit_bits: u32) -> Option<Certificate> {
    /// The degrees that are looked at first: most decimals violate one of these conditions.
    const FIRST: usize = 3;
    let values: Vec<BigRational> = reading.unknowns.iter().map(|x| x.start.clone()).collect();
    let solution = Solution::Exact(values.clone());
    let printed = |target: &Target| target.rational(&solution).as_ref() == Some(&target.printed);
    let holds = |system: System| {
        let count = system.all().count();
        system.holds_exactly(&values).then_some(count)
    };
    let solved = solved(reading, claim);
    if !reading.targets.iter().all(printed) {
        return None;
    }
    let first = Conditions::of_degrees(&solved, 1..=FIRST.min(claim.order()));
    holds(System::new(reading.steps.clone(), first))?;
    let count = holds(system_of(reading, &solved).ok()?)?;
    let found = (Vec::new(), None, solution);
    let digits = (Digits::All, Vec::new());
    Some(certificate(
        reading, claim, count, digit_bits, found, digits,
    ))
}

/// The certificate of a reading, at any distance from the digits.
fn certified(
    reading: &Reading,
    claim: &Claim,
    digit_bits: u32,
) -> Result<Certificate, CertifyError> {
    let structure = reading.structure;
    let system = system_of(reading, &solved(reading, claim))?;
    let counts = (system.all().count(), reading.unknowns.len());
    let with = |found, digits, suspects| {
        let digits = (digits, suspects);
        certificate(reading, claim, counts.0, digit_bits, found, digits)
    };
    let right = |solution: &Solution| {
        let distances = distances(&reading.targets, solution, digit_bits).into_iter();
        let mut pairs = reading.targets.iter().zip(distances);
        pairs.all(|(target, distance)| distance.at_least <= target.half)
    };
    let printed: Vec<BigRational> = reading.unknowns.iter().map(|x| x.start.clone()).collect();
    let simple = reading
        .unknowns
        .iter()
        .map(|x| x.simple.clone().unwrap_or(x.start.clone()));
    // An exact solution that does not round to all prints.
    let mut other = None;
    for values in [printed.clone(), simple.collect()] {
        if short(&values) && system.holds_exactly(&values) {
            let solution = Solution::Exact(values);
            if right(&solution) {
                return Ok(with((Vec::new(), None, solution), Digits::All, Vec::new()));
            }
            other.get_or_insert(solution);
        }
    }
    // Without another solution it is the result.
    let failed = |error| match other {
        Some(solution) => {
            let found = (Vec::new(), None, solution);
            Ok(with(found, Digits::NotFound, Vec::new()))
        }
        None => Err(error),
    };
    if counts.0 > counts.1 {
        return failed(CertifyError::TooFewCoefficients {
            claim: claim.clone(),
            structure,
            conditions: counts.0,
            unknowns: counts.1,
        });
    }
    let not_found = |system: &System| {
        let at: Vec<Interval> = printed
            .iter()
            .map(|x| Interval::enclosing(x, PROOF_BITS))
            .collect();
        let residuals = system.residuals(&at);
        let sizes = residuals.iter().map(|r| r.low().abs().max(r.high().abs()));
        let conditions = system.all().map(|c| c.degree);
        let largest = sizes.zip(conditions).max().unwrap_or_default();
        CertifyError::NotFound {
            claim: claim.clone(),
            residual: Decimal::round(&largest.0, 2).to_string(),
            degree: largest.1,
        }
    };
    let free = match free_unknowns(&system, reading) {
        Ok(free) => free,
        Err(rank) => {
            return failed(CertifyError::Dependent {
                claim: claim.clone(),
                structure,
                conditions: counts.0,
                rank,
            });
        }
    };
    let values = reading.unknowns.iter().enumerate().map(|(index, unknown)| {
        let value = || unknown.simple.clone().unwrap_or(unknown.start.clone());
        (!free.contains(&index)).then(value)
    });
    let square = Square {
        fixed: values.collect(),
        system,
        free,
    };
    let solved = |square: Square| {
        let unknowns = square.free.iter().map(|&index| printed[index].clone());
        let start: Vec<BigRational> = unknowns.collect();
        let center = square.solve(&start, PROOF_BITS)?;
        let fixed = fixed(reading, &square);
        let proof = Proof::new(square, center, PROOF_BITS)?;
        let uniqueness = Some(Uniqueness::around(start, proof.clone()));
        let solution = match recognised(&proof) {
            Some(values) => Solution::Exact(values),
            None => Solution::Enclosed(Box::new(Enclosed::new(proof))),
        };
        Some((fixed, uniqueness, solution))
    };
    let Some(first) = solved(square.clone()) else {
        return failed(not_found(&square.system));
    };
    if right(&first.2) {
        return Ok(with(first, Digits::All, Vec::new()));
    }
    let again = |values: Vec<Option<BigRational>>| {
        let mut moved = square.clone();
        moved.fixed = values;
        solved(moved)
    };
    match settle(
        &square,
        &reading.unknowns,
        &reading.targets,
        digit_bits,
        PROOF_BITS,
    ) {
        Settled::All(values) => match again(values) {
            Some(moved) if right(&moved.2) => Ok(with(moved, Digits::All, Vec::new())),
            _ => Ok(with(first, Digits::NotFound, Vec::new())),
        },
        Settled::Wrong { excluded, suspects } => {
            let mut names = suspects.iter().map(|suspect| suspect.coefficient);
            names.next();
            let names: Vec<Coefficient> = names.collect();
            let best = suspects.into_iter().next();
            let digits = match excluded {
                true => Digits::Excluded,
                false => Digits::NotFound,
            };
            let found = best.and_then(|suspect| again(suspect.fixed));
            Ok(with(found.unwrap_or(first), digits, names))
        }
    }
}

/// The unknowns that are fixed, with their values.
fn fixed(reading: &Reading, square: &Square) -> Vec<Fixed> {
    let pairs = reading.unknowns.iter().zip(&square.fixed);
    pairs
        .filter_map(|(unknown, value)| {
            let value = value.clone()?;
            Some(Fixed {
                coefficient: unknown.name,
                as_printed: value == unknown.start,
                value,
            })
        })
        .collect()
}

/// Whether exact arithmetic with some numbers is cheap.
fn short(values: &[BigRational]) -> bool {
    values.iter().all(|x| x.denom().bits() <= 256)
}

/// The solution, if it is rational: the simplest numbers in its enclosures solve the conditions exactly.
fn recognised(proof: &Proof) -> Option<Vec<BigRational>> {
    let free = proof.solution(&proof.center, proof.bits);
    let short = u64::from(proof.bits / 3);
    let mut values = Vec::with_capacity(free.len());
    for interval in &free {
        let simplest = simplest_between(&interval.low(), &interval.high());
        if simplest.denom().bits() > short {
            return None;
        }
        values.push(simplest);
    }
    let mut next = values.into_iter();
    let fixed = proof.square.fixed.iter();
    let all: Option<Vec<BigRational>> = fixed.map(|x| x.clone().or_else(|| next.next())).collect();
    all.filter(|all| proof.square.system.holds_exactly(all))
}

/// Whether a condition of the next order is refuted.
///
/// For a composition of Störmer–Verlet these are the conditions of the class for the drifts and kicks.
fn sharp(reading: &Reading, claim: &Claim, solution: &Solution) -> Option<bool> {
    const BITS: u32 = 192;
    // A symmetric method has even order, so an odd claim understates the order by one.
    let degree = claim.order() + 1;
    let next = claim.next(1)?;
    let unknowns = solution.unknowns(BITS);
    let (steps, arguments) = match claim {
        Claim::SymmetricBase(_) => (reading.steps.clone(), unknowns),
        _ => expanded(&reading.targets, &unknowns, BITS),
    };
    let conditions = Conditions::of_degrees(&next, std::iter::once(degree));
    let system = System::new(steps, conditions);
    let residuals = system.residuals(&arguments);
    Some(residuals.iter().any(|r| !r.contains(&BigRational::zero())))
}

/// The steps and coefficients of a splitting in the order in which they are applied.
pub(super) fn expanded(
    targets: &[Target],
    unknowns: &[Interval],
    bits: u32,
) -> (Vec<Step>, Vec<Interval>) {
    let mut sorted: Vec<(usize, Kind, Interval)> = targets
        .iter()
        .map(|target| {
            let value = target.enclosed(unknowns, bits);
            match target.name {
                Coefficient::Drift(index) => (index, Kind::Letter(DRIFT), value),
                Coefficient::Gradient(index) => (index, Kind::Gradient, value),
                Coefficient::Kick(index)
                | Coefficient::Weight(index)
                | Coefficient::Processor(index) => (index, Kind::Letter(KICK), value),
            }
        })
        .collect();
    // In each stage the drift comes last.
    sorted.sort_by_key(|(index, kind, _)| (*index, *kind == Kind::Letter(DRIFT)));
    let step =
        |(argument, (_, kind, _)): (usize, &(usize, Kind, Interval))| Step::new(*kind, argument);
    let steps = sorted.iter().enumerate().map(step).collect();
    (
        steps,
        sorted.into_iter().map(|(_, _, value)| value).collect(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arithmetic::rational::ratio;
    use crate::certify::structure::{Structure, Unknown};

    /// Störmer–Verlet as three conditions for its kick, its drift and a number that is not used: they are dependent. The second kick is
    /// printed with a wrong digit, unlike the first.
    #[test]
    fn an_exact_solution_is_the_result_if_there_is_no_other() {
        let names = [
            Coefficient::Kick(0),
            Coefficient::Drift(0),
            Coefficient::Kick(2),
        ];
        let starts = [ratio(1, 2), ratio(1, 1), ratio(0, 1)];
        let unknowns = names.iter().zip(&starts).map(|(&name, start)| Unknown {
            name,
            start: start.clone(),
            simple: None,
            exact: false,
        });
        let step = |letter, argument| Step::new(Kind::Letter(letter), argument);
        let target = |name, printed, argument| Target {
            name,
            printed,
            half: ratio(1, 2_000_000),
            terms: vec![(argument, ratio(1, 1))],
        };
        let reading = Reading {
            structure: Structure::Splitting,
            processing: None,
            unknowns: unknowns.collect(),
            steps: vec![step(KICK, 0), step(DRIFT, 1), step(KICK, 0)],
            targets: vec![
                target(names[0], ratio(1, 2), 0),
                target(names[1], ratio(1, 1), 1),
                target(Coefficient::Kick(1), ratio(500_003, 1_000_000), 0),
            ],
        };
        let found = certified(&reading, &Claim::Separable(2), 192).expect("a certificate");
        assert_eq!((found.conditions(), found.unknowns()), (3, 3));
        assert_eq!(found.digits(), Digits::NotFound);
        assert_eq!(*found.distance(), ratio(3, 1_000_000));
    }
}
