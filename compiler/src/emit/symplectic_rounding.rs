//! Coefficients relative to the weights, `μ_ij = a_ij/b_j` and `μ̃_ij = ã_ij/b̃_j`, with which the stages are
//! sums of increments: `Q_i = q0 + Σ_j μ_ij (h b_j velocity_j)`.
//!
//! A method is symplectic iff `μ̃_ij + μ_ji = 1`. This can hold exactly in floating-point arithmetic: the larger of the two, which
//! is at least 1/2, is rounded correctly to x. The other one is 1 − x, which is exact for every double from 1/2 to 2⁵³. With
//! correctly rounded `a_ij` the condition fails by a rounding error that is always the same, and the energy drifts (Hairer,
//! McLachlan & Razakarivony, 2008; Antoñana, Makazaga & Murua, 2017).

use num_rational::BigRational;

use super::facts::Known;
use crate::algebra::{Number, ROUNDING_BITS, ZERO_BITS};
use crate::arithmetic::interval::Interval;
use crate::arithmetic::rational::ratio;
use crate::arithmetic::rounding::{exact, to_f32, to_f64};
use crate::schedule::StepGraph;

/// A coefficient rounded for the scalar types.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rounded {
    /// The double.
    pub double: f64,
    /// The double nearest to the remainder, the exact value minus `double`.
    pub low: f64,
    /// The single.
    pub single: f32,
}

impl Rounded {
    pub(super) const ZERO: Self = Rounded {
        double: 0.0,
        low: 0.0,
        single: 0.0,
    };
    pub(super) const ONE: Self = Rounded {
        double: 1.0,
        low: 0.0,
        single: 1.0,
    };

    const HALF: Self = Rounded {
        double: 0.5,
        low: 0.0,
        single: 0.5,
    };

    /// A number, correctly rounded.
    pub(super) fn of(number: &Number<'_>) -> Self {
        let double = number.to_f64();
        Rounded {
            double,
            low: number.low_double(double),
            single: number.to_f32(),
        }
    }

    /// Twice the number, exactly.
    pub(super) fn twice(self) -> Self {
        Rounded {
            double: 2.0 * self.double,
            low: 2.0 * self.low,
            single: 2.0 * self.single,
        }
    }

    /// 1 minus the number, if that is exact in doubles: from 1/2 to 2⁵³. For singles it is exact up to 2²⁴.
    fn complement(self) -> Option<Self> {
        let exact = (0.5..9_007_199_254_740_992.0).contains(&self.double);
        exact.then(|| Rounded {
            double: 1.0 - self.double,
            low: -self.low,
            single: 1.0 - self.single,
        })
    }
}

/// The relative coefficients of the distinct stage values of a step.
#[derive(Debug)]
pub struct Relative {
    /// `μ`: a row for each position value, an entry for each velocity.
    pub positions: Vec<Vec<Rounded>>,
    /// `μ̃`: a row for each momentum value, an entry for each force.
    pub momenta: Vec<Vec<Rounded>>,
}

impl Relative {
    /// The relative coefficients; `None` if the method is not symplectic, if a weight is zero, or if a weight is so small that
    /// a quotient has no exact complement.
    pub fn new(graph: &StepGraph<'_>, known: &Known) -> Option<Self> {
        let evaluations = || graph.velocities.iter().chain(&graph.forces);
        if evaluations().any(|evaluation| evaluation.weight.is_zero()) {
            return None;
        }
        let zeros = |rows: usize, columns: usize| vec![vec![Rounded::ZERO; columns]; rows];
        let mut relative = Relative {
            positions: zeros(graph.positions.len(), graph.velocities.len()),
            momenta: zeros(graph.momenta.len(), graph.forces.len()),
        };
        for (f, force) in graph.forces.iter().enumerate() {
            for (v, velocity) in graph.velocities.iter().enumerate() {
                let (position, momentum) = (force.position?, velocity.momentum?);
                let (row, row_tilde) = (&graph.positions[position], &graph.momenta[momentum]);
                let (mu, mu_tilde) = known.complements(
                    (row.stages.clone(), graph.stages_of(velocity)),
                    (row_tilde.stages.clone(), graph.stages_of(force)),
                    |same| {
                        complements(
                            (&row.coefficients[v], &velocity.weight),
                            (&row_tilde.coefficients[f], &force.weight),
                            same,
                        )
                    },
                )?;
                relative.positions[position][v] = mu;
                relative.momenta[momentum][f] = mu_tilde;
            }
        }
        Some(relative)
    }
}

/// A coefficient and the weight that it is relative to.
pub(super) type Fraction<'n> = (&'n Number<'n>, &'n Number<'n>);

/// Two quotients with the sum 1, rounded so that the sum stays 1; `None` if the sum is not 1. If the quotients are the `same`, both
/// are 1/2, which no enclosure can prove.
pub(super) fn complements(
    mu: Fraction<'_>,
    mu_tilde: Fraction<'_>,
    same: bool,
) -> Option<(Rounded, Rounded)> {
    let enclosure = quotient(mu, 0)?;
    if !enclosure
        .add(&quotient(mu_tilde, 0)?)
        .contains(&ratio(1, 1))
    {
        return None;
    }
    if same {
        return Some((Rounded::HALF, Rounded::HALF));
    }
    if mu.0.is_zero() {
        return Some((Rounded::ZERO, Rounded::ONE));
    }
    if mu_tilde.0.is_zero() {
        return Some((Rounded::ONE, Rounded::ZERO));
    }
    // If both are 1/2, exactly or nearly, either may be taken as the larger one.
    let first_is_larger = enclosure.middle() >= ratio(1, 2);
    let larger = round(if first_is_larger { mu } else { mu_tilde })?;
    let smaller = larger.complement()?;
    Some(if first_is_larger {
        (larger, smaller)
    } else {
        (smaller, larger)
    })
}

/// An enclosure of a quotient; `None` if the enclosure of the weight contains zero.
fn quotient((value, weight): Fraction<'_>, bits: u32) -> Option<Interval> {
    value.enclose(bits).divide(&weight.enclose(bits))
}

/// A quotient, correctly rounded.
fn round(fraction: Fraction<'_>) -> Option<Rounded> {
    let enclose = |bits| quotient(fraction, bits);
    let double = decide(enclose, to_f64)?;
    let whole = exact(double);
    let low = decide(
        |bits| {
            let rest = enclose(bits)?;
            let known = Interval::enclosing(&whole, rest.bits());
            Some(rest.subtract(&known))
        },
        to_f64,
    )?;
    let single = decide(enclose, to_f32)?;
    Some(Rounded {
        double,
        low,
        single,
    })
}

/// Binary places of the enclosures that decide a rounding. The first are nearly always enough; with the second,
/// both ends of an enclosure of zero round to zero. A number that the last do not separate from the midpoint of two
/// neighbours is taken to be that midpoint.
const DECIDING_BITS: [u32; 3] = [192, ZERO_BITS, ROUNDING_BITS];

/// Rounds a number that is enclosed as narrowly as needed.
pub(super) fn decide<T: PartialEq>(
    enclose: impl Fn(u32) -> Option<Interval>,
    round: impl Fn(&BigRational) -> T,
) -> Option<T> {
    let mut finest = None;
    for bits in DECIDING_BITS {
        let Some(interval) = enclose(bits) else {
            continue;
        };
        // Zero without the sign of an endpoint.
        let middle = interval
            .sign()
            .map_or_else(|| ratio(0, 1), |_| interval.middle());
        finest = Some(round(&middle));
        if round(&interval.low()) == round(&interval.high()) {
            break;
        }
    }
    finest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;
    use crate::schedule::Class;

    /// Calls `check` with every pair of complementary coefficients of the symplectic methods with at most `stages` stages and nonzero weights.
    /// Returns the number of methods.
    fn pairs(
        stages: usize,
        mut check: impl FnMut(&str, Fraction<'_>, Rounded, Fraction<'_>, Rounded),
    ) -> usize {
        let mut methods = 0;
        for entry in catalogue::entries().filter(|entry| entry.stages <= stages) {
            let tableau = entry.derive().expect("derived");
            let numbers = tableau.numbers();
            let known = Known::new(&tableau);
            for class in [Class::General, Class::Separable] {
                let graph = StepGraph::new(class, &tableau.exact, &numbers);
                let Some(relative) = Relative::new(&graph, &known) else {
                    // A symplectic method with equal weights would have this form.
                    assert!(!tableau.properties().symplectic.holds, "{}", entry.name);
                    continue;
                };
                methods += 1;
                for (f, force) in graph.forces.iter().enumerate() {
                    for (v, velocity) in graph.velocities.iter().enumerate() {
                        let position = force.position.expect("seen");
                        let momentum = velocity.momentum.expect("seen");
                        check(
                            &entry.name,
                            (&graph.positions[position].coefficients[v], &velocity.weight),
                            relative.positions[position][v],
                            (&graph.momenta[momentum].coefficients[f], &force.weight),
                            relative.momenta[momentum][f],
                        );
                    }
                }
            }
        }
        methods
    }

    /// The number of stages that the macros take.
    fn usual() -> usize {
        crate::Limits::default().stages
    }

    /// Checks that the two coefficients of every pair have the sum 1, for methods with at most `stages` stages. Returns their number.
    fn symplectic(stages: usize) -> usize {
        pairs(stages, |name, _, mu, _, mu_tilde| {
            assert_eq!(
                exact(mu.double) + exact(mu_tilde.double),
                ratio(1, 1),
                "{name}"
            );
            let [single, single_tilde] = [mu, mu_tilde].map(|mu| exact(mu.single.into()));
            assert_eq!(single + single_tilde, ratio(1, 1), "{name}");
            assert_eq!(mu.low, -mu_tilde.low, "{name}");
        })
    }

    #[test]
    fn rounded_methods_with_two_stages_are_symplectic_exactly() {
        let methods = symplectic(2);
        assert!(methods > 10, "{methods}");
    }

    #[test]
    #[ignore = "thorough"]
    fn rounded_methods_are_symplectic_exactly() {
        let methods = symplectic(usual());
        assert!(methods > 100, "{methods}");
    }

    #[test]
    #[ignore = "thorough"]
    fn symplectic_rounding_moves_coefficients_by_at_most_a_unit() {
        pairs(usual(), |name, fraction, mu, fraction_tilde, mu_tilde| {
            let larger = mu.double.abs().max(mu_tilde.double.abs());
            for (fraction, mu) in [(fraction, mu), (fraction_tilde, mu_tilde)] {
                let enclosure = quotient(fraction, 256).expect("a quotient");
                let distance = enclosure.low() - exact(mu.double);
                let bound = exact(larger * f64::EPSILON / 2.0);
                assert!(distance <= bound && -distance <= bound, "{name}");
            }
        });
    }

    /// The negative twin: if each of the two is rounded by itself, their sum is not 1.
    #[test]
    #[ignore = "thorough"]
    fn correctly_rounded_methods_are_not_symplectic() {
        let mut broken = 0;
        pairs(usual(), |_, mu, _, mu_tilde, _| {
            let [mu, mu_tilde] = [mu, mu_tilde].map(|mu| match mu.0.is_zero() {
                true => 0.0,
                false => round(mu).expect("rounded").double,
            });
            broken += usize::from(exact(mu) + exact(mu_tilde) != ratio(1, 1));
        });
        assert!(broken > 100, "{broken}");
    }
}
