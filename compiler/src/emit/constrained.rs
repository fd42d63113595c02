//! How a method steps systems with constraints, as data.

use num_rational::BigRational;
use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::literal;
use super::symplectic_rounding::{Rounded, complements};
use crate::algebra::{Field, Number, Real, Reals};
use crate::coefficients::Coefficients;
use crate::exact::over_algebra;
use crate::properties::{from_start_to_end, multiplier_matrix};
use crate::tableau::{Parts, Tableau, composed};

/// The steps of a method for systems with constraints: one step, or those of a composition.
#[derive(Debug, Clone)]
pub struct ConstrainedSteps {
    /// Their distinct tableaux.
    pub tableaux: Vec<ConstrainedTableau>,
    /// The steps in their order.
    pub steps: Vec<ConstrainedStep>,
}

/// A step of a method for systems with constraints.
#[derive(Debug, Clone, Copy)]
pub struct ConstrainedStep {
    /// Where it starts, as a fraction of the whole step.
    pub start: Rounded,
    /// The fraction γ of the whole step.
    pub fraction: Rounded,
    /// The index of its tableau.
    pub tableau: usize,
}

/// A tableau for systems with constraints, rounded so that it is exactly symplectic.
#[derive(Debug, Clone)]
pub struct ConstrainedTableau {
    /// `μ_ij = a_ij/b_j` by rows. For holonomic constraints the first stage is the start of the step and the last its end, whatever the
    /// order in the tableau of the method.
    pub positions: Vec<Vec<Rounded>>,
    /// `μ̃_ij = ã_ij/b_j` by rows.
    pub momenta: Vec<Vec<Rounded>>,
    /// `b_i`
    pub weights: Vec<Rounded>,
    /// `c_i`
    pub nodes: Vec<Rounded>,
    /// `c̃_i`
    pub momentum_nodes: Vec<Rounded>,
    /// `X⁻¹` by rows; empty for non-holonomic constraints.
    pub multipliers: Vec<Vec<f64>>,
}

/// The steps of a method for systems with holonomic constraints, and those for non-holonomic ones; `None` for those that it does not have.
/// Methods that lose their order for general Hamiltonians have neither.
///
/// ```
/// use symplectic_compiler::{derive, emit::constrained_steps};
///
/// let [rattle, _] = constrained_steps(&derive("polynomial(2)", "lobatto(2)")?);
/// assert_eq!(rattle.expect("it is constrained").tableaux[0].weights.len(), 2);
/// assert!(constrained_steps(&derive("polynomial(2)", "gauss(2)")?)[0].is_none());
/// # Ok::<(), symplectic_compiler::Error>(())
/// ```
pub fn constrained_steps(tableau: &Tableau) -> [Option<ConstrainedSteps>; 2] {
    match tableau.parts() {
        Ok(parts) if tableau.keeps_its_order_in_general() => [
            holonomic(tableau, parts),
            super::nonholonomic::steps(tableau, parts),
        ],
        _ => [None, None],
    }
}

/// The steps for holonomic constraints; `None` for a method that does not qualify.
///
/// A composition of constrained methods composes their steps, unless its own coefficients make one.
pub(super) fn holonomic(tableau: &Tableau, parts: &Parts) -> Option<ConstrainedSteps> {
    let tableau_of = |tableau: &Tableau| match tableau.stages() {
        1 => Some(with_an_end(tableau.numbers().a[0][0].is_zero())),
        _ => {
            let numbers = over_algebra!(&tableau.exact, pair => from_start_to_end(pair))?;
            rounded(&numbers, multiplier_matrix(&numbers)?)
        }
    };
    if tableau.own_properties().constrained.holds {
        return Some(ConstrainedSteps::one(tableau_of(tableau)?));
    }
    let composed = composed::constrained(parts).is_some_and(|found| found.holds);
    composed.then(|| ConstrainedSteps::composed(parts, tableau_of))?
}

/// Whether the constrained steps are steps of Störmer–Verlet, Lobatto IIIA–IIIB with two stages: nodes 0 and 1 and weights 1/2 determine
/// the rest.
pub(super) fn are_of_stoermer_verlet(steps: &ConstrainedSteps) -> bool {
    let doubles = |numbers: &[Rounded]| numbers.iter().map(|x| x.double).collect::<Vec<_>>();
    let is_one = |tableau: &ConstrainedTableau| {
        doubles(&tableau.weights) == [0.5; 2] && doubles(&tableau.nodes) == [0.0, 1.0]
    };
    steps.tableaux.iter().all(is_one)
}

/// Symplectic Euler, whose stage is at the start, with the end of the step as a second stage of weight 0; or its adjoint, whose stage is at
/// the end, with the start as a first stage of weight 0. With one stage, the property `constrained` admits no other coefficients.
fn with_an_end(at_start: bool) -> ConstrainedTableau {
    let (zero, one) = (Rounded::ZERO, Rounded::ONE);
    let (weights, momentum_node) = match at_start {
        true => (vec![one, zero], one),
        false => (vec![zero, one], zero),
    };
    ConstrainedTableau {
        positions: vec![vec![zero; 2], vec![one; 2]],
        momenta: vec![vec![one, zero]; 2],
        weights,
        nodes: vec![zero, one],
        momentum_nodes: vec![momentum_node; 2],
        multipliers: vec![vec![1.0]],
    }
}

impl ConstrainedSteps {
    /// One whole step.
    pub(super) fn one(tableau: ConstrainedTableau) -> Self {
        let step = ConstrainedStep {
            start: Rounded::ZERO,
            fraction: Rounded::ONE,
            tableau: 0,
        };
        ConstrainedSteps {
            tableaux: vec![tableau],
            steps: vec![step],
        }
    }

    /// The steps of a composition, with the tableau of each method. Steps of zero size do nothing, and are left out.
    pub(super) fn composed(
        parts: &Parts,
        tableau_of: impl Fn(&Tableau) -> Option<ConstrainedTableau>,
    ) -> Option<Self> {
        let tableaux = parts.methods.iter().map(tableau_of);
        let mut at = Real::rational(BigRational::default());
        let steps = parts.substeps.iter().map(|substep| {
            let fraction = Real::constant(substep.fraction.clone());
            let step = ConstrainedStep {
                start: Rounded::of(&Reals.number(&at)),
                fraction: Rounded::of(&Reals.number(&fraction)),
                tableau: substep.method,
            };
            at = Reals.add(&at, &fraction);
            step
        });
        Some(ConstrainedSteps {
            tableaux: tableaux.collect::<Option<_>>()?,
            steps: steps.filter(|step| step.fraction.double != 0.0).collect(),
        })
    }

    /// A constant of a `Method`.
    pub(super) fn code(&self, name: &str) -> TokenStream {
        let name = format_ident!("{name}");
        let tableau = |number: usize| format_ident!("TABLEAU{}", number + 1);
        let used = |number: &usize| self.steps.iter().any(|step| step.tableau == *number);
        let used: Vec<usize> = (0..self.tableaux.len()).filter(used).collect();
        let tableaux = used.iter().map(|&number| self.tableaux[number].code());
        let names = used.iter().map(|&number| tableau(number));
        let steps = self.steps.iter().map(|step| {
            let [start, fraction] = [step.start, step.fraction].map(literal::rounded);
            let tableau = tableau(step.tableau);
            quote!(emitted::ConstrainedStep::new(#start, #fraction, &#tableau))
        });
        quote! {
            const #name: &'static [emitted::ConstrainedStep] = {
                #(const #names: emitted::ConstrainedTableau = #tableaux;)*
                &[#(#steps),*]
            };
        }
    }
}

/// A tableau with `X⁻¹`.
pub(super) fn rounded(
    numbers: &Coefficients<Number<'_>>,
    multipliers: Vec<Vec<f64>>,
) -> Option<ConstrainedTableau> {
    let stages = numbers.b.len();
    // μ_ij = a_ij/b_j and μ̃_ji = ã_ji/b_i, which add up to 1.
    let pair = |i: usize, j: usize| {
        let mu = (&numbers.a[i][j], &numbers.b[j]);
        let mu_tilde = (&numbers.a_tilde[j][i], &numbers.b_tilde[i]);
        complements(mu, mu_tilde, false)
    };
    let matrix = |entry: &dyn Fn(usize, usize) -> Option<Rounded>| {
        let row = |i| (0..stages).map(|j| entry(i, j)).collect();
        (0..stages).map(row).collect::<Option<Vec<Vec<_>>>>()
    };
    let [weights, nodes, momentum_nodes] = [&numbers.b, &numbers.c, &numbers.c_tilde]
        .map(|numbers| numbers.iter().map(Rounded::of).collect());
    Some(ConstrainedTableau {
        positions: matrix(&|i, j| Some(pair(i, j)?.0))?,
        momenta: matrix(&|i, j| Some(pair(j, i)?.1))?,
        weights,
        nodes,
        momentum_nodes,
        multipliers,
    })
}

impl ConstrainedTableau {
    fn code(&self) -> TokenStream {
        let list = |numbers: &Vec<Rounded>| {
            let numbers = numbers.iter().map(|number| literal::rounded(*number));
            quote!(&[#(#numbers),*])
        };
        let [positions, momenta] = [&self.positions, &self.momenta].map(|rows| {
            let rows = rows.iter().map(list);
            quote!(&[#(#rows),*])
        });
        let [weights, nodes, momentum_nodes] =
            [&self.weights, &self.nodes, &self.momentum_nodes].map(list);
        let multipliers = self.multipliers.iter().map(|row| literal::array(row));
        quote! {
            emitted::ConstrainedTableau {
                positions: #positions,
                momenta: #momenta,
                weights: #weights,
                nodes: #nodes,
                momentum_nodes: #momentum_nodes,
                multipliers: &[#(&#multipliers),*],
            }
        }
    }
}
