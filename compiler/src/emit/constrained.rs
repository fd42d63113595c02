//! How a method steps systems with holonomic constraints, as data.

use num_rational::BigRational;
use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::literal;
use super::symplectic_rounding::complements;
use crate::algebra::{Field, Number, Real, Reals};
use crate::coefficients::Coefficients;
use crate::derive::{Parts, Substep};
use crate::properties::{composed, multiplier_matrix};
use crate::tableau::Tableau;

/// The `CONSTRAINED` constant of a `Method`; empty for a method that does not qualify.
///
/// A composition of constrained methods composes their steps, unless its own coefficients make one.
pub(super) fn code(
    tableau: &Tableau,
    numbers: &Coefficients<Number<'_>>,
    parts: &Parts,
) -> Option<TokenStream> {
    let tableau_of = |numbers: &Coefficients<Number<'_>>| match numbers.b.len() {
        1 => Some(with_an_end(numbers.a[0][0].is_zero())),
        _ => constants(numbers, &multiplier_matrix(numbers)?),
    };
    if tableau.own_properties().constrained.holds {
        return Some(steps("CONSTRAINED", &[tableau_of(numbers)?], None));
    }
    composed::constrained(parts)?;
    let tableaux = parts
        .methods
        .iter()
        .map(|method| tableau_of(&method.numbers()));
    let tableaux = tableaux.collect::<Option<Vec<_>>>()?;
    Some(steps(
        "CONSTRAINED",
        &tableaux,
        Some(&list(&parts.substeps)),
    ))
}

/// Whether the constrained steps are steps of Störmer–Verlet, Lobatto IIIA–IIIB with two stages: nodes 0 and 1 and weights 1/2 determine
/// the rest.
pub(super) fn are_of_stoermer_verlet(
    tableau: &Tableau,
    numbers: &Coefficients<Number<'_>>,
    parts: &Parts,
) -> bool {
    let is_one = |numbers: &Coefficients<Number<'_>>| {
        let [weights, nodes] = [&numbers.b, &numbers.c]
            .map(|vector| vector.iter().map(Number::to_f64).collect::<Vec<_>>());
        weights == [0.5; 2] && nodes == [0.0, 1.0]
    };
    let qualifies = |tableau: &Tableau| tableau.own_properties().constrained.holds;
    if qualifies(tableau) {
        return is_one(numbers);
    }
    let is_part = |method: &Tableau| qualifies(method) && is_one(&method.numbers());
    !parts.substeps.is_empty() && parts.methods.iter().all(is_part)
}

/// Symplectic Euler, whose stage is at the start, with the end of the step as a second stage of weight 0; or its adjoint, whose stage is at
/// the end, with the start as a first stage of weight 0. With one stage, the property `constrained` admits no other coefficients.
fn with_an_end(at_start: bool) -> TokenStream {
    let [zero, one] = [0.0, 1.0].map(|value| {
        let value = literal::double(value);
        quote!(emitted::exact(#value))
    });
    let (weights, momentum_node) = if at_start {
        (quote!(#one, #zero), &one)
    } else {
        (quote!(#zero, #one), &zero)
    };
    quote! {
        emitted::ConstrainedTableau {
            positions: &[&[#zero, #zero], &[#one, #one]],
            momenta: &[&[#one, #zero], &[#one, #zero]],
            weights: &[#weights],
            nodes: &[#zero, #one],
            momentum_nodes: &[#momentum_node, #momentum_node],
            multipliers: &[&[1.0]],
        }
    }
}

/// A constant of a `Method`: steps of these tableaux, with the substeps of `list`, or one step of size 1.
pub(super) fn steps(
    name: &str,
    tableaux: &[TokenStream],
    list: Option<&[TokenStream]>,
) -> TokenStream {
    let exact = |value: f64| {
        let value = literal::double(value);
        quote!(emitted::exact(#value))
    };
    let (start, size) = (exact(0.0), exact(1.0));
    let whole = [quote!(#start, #size, &TABLEAU1)];
    let steps = list
        .unwrap_or(&whole)
        .iter()
        .map(|step| quote!(emitted::ConstrainedStep::new(#step)));
    let name = format_ident!("{name}");
    let names = (1..=tableaux.len()).map(|k| format_ident!("TABLEAU{k}"));
    quote! {
        const #name: &'static [emitted::ConstrainedStep] = {
            #(const #names: emitted::ConstrainedTableau = #tableaux;)*
            &[#(#steps),*]
        };
    }
}

/// The start and the size of every substep as fractions of the step, and the index of its tableau.
pub(super) fn list(substeps: &[Substep]) -> Vec<TokenStream> {
    let coefficient = |real: &Real| literal::coefficient(&Reals.number(real));
    let mut start = Real::rational(BigRational::default());
    let step = |substep: &Substep| {
        let fraction = Real::constant(substep.fraction.clone());
        let (at, size) = (coefficient(&start), coefficient(&fraction));
        let tableau = format_ident!("TABLEAU{}", substep.method + 1);
        start = Reals.add(&start, &fraction);
        quote!(#at, #size, &#tableau)
    };
    substeps.iter().map(step).collect()
}

/// A tableau, rounded so that it is exactly symplectic, and `X⁻¹`.
pub(super) fn constants(
    numbers: &Coefficients<Number<'_>>,
    inverse: &[Vec<f64>],
) -> Option<TokenStream> {
    let stages = numbers.b.len();
    // μ_ij = a_ij/b_j and μ̃_ji = ã_ji/b_i, which add up to 1.
    let pair = |i: usize, j: usize| {
        let mu = (&numbers.a[i][j], &numbers.b[j]);
        let mu_tilde = (&numbers.a_tilde[j][i], &numbers.b_tilde[i]);
        let (mu, mu_tilde) = complements(mu, mu_tilde, false)?;
        Some((literal::rounded(mu), literal::rounded(mu_tilde)))
    };
    let matrix = |entry: &dyn Fn(usize, usize) -> Option<TokenStream>| {
        let row = |i| (0..stages).map(|j| entry(i, j)).collect();
        (0..stages).map(row).collect::<Option<Vec<Vec<_>>>>()
    };
    let positions = matrix(&|i, j| Some(pair(i, j)?.0))?;
    let momenta = matrix(&|i, j| Some(pair(j, i)?.1))?;
    let rows = |rows: &[Vec<TokenStream>]| {
        let rows = rows.iter().map(|row| quote!(&[#(#row),*]));
        quote!(&[#(#rows),*])
    };
    let [positions, momenta] = [&positions, &momenta].map(|matrix| rows(matrix));
    let inverse = inverse.iter().map(|row| literal::array(row));
    let [weights, nodes, momentum_nodes] =
        [&numbers.b, &numbers.c, &numbers.c_tilde].map(|vector| literal::coefficients(vector));
    Some(quote! {
        emitted::ConstrainedTableau {
            positions: #positions,
            momenta: #momenta,
            weights: &#weights,
            nodes: &#nodes,
            momentum_nodes: &#momentum_nodes,
            multipliers: &[#(&#inverse),*],
        }
    })
}
