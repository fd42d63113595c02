//! How the linear systems of a Newton iteration decouple.

use proc_macro2::TokenStream;
use quote::quote;

use super::super::facts::Known;
use super::literal;
use crate::algebra::Number;
use crate::arithmetic::eigen::{Blocks, Rows, diagonalise, product};
use crate::arithmetic::fixed::Fixed;
use crate::arithmetic::rounding::to_f64;
use crate::schedule::{Class, StageValue, StepGraph};

/// Binary places of the coefficients: those of the enclosures that round them.
const BITS: u32 = 192;

/// The `DECOUPLING` constant of a `StageTableau` with this value.
pub(super) fn constant(value: TokenStream) -> TokenStream {
    quote!(const DECOUPLING: ::core::option::Option<emitted::Decoupling> = #value;)
}

/// How the systems decouple; `None` if they do not.
pub(super) fn code(graph: &StepGraph<'_>, known: &Known) -> Option<TokenStream> {
    let blocks = blocks(graph, known)?;
    let rounded = |x: &Fixed| literal::double(to_f64(&x.rational()));
    let values = blocks.values.iter().map(|(re, im)| {
        let (re, im) = (rounded(re), rounded(im));
        quote!((#re, #im))
    });
    let rows = |rows: &Rows| {
        let rows = rows.iter().map(|row| {
            let entries = row.iter().map(rounded);
            quote!(&[#(#entries),*])
        });
        quote!(&[#(#rows),*])
    };
    let (to_stages, from_stages) = (rows(&blocks.vectors), rows(&blocks.inverse));
    Some(quote! {
        ::core::option::Option::Some(emitted::Decoupling {
            blocks: &[#(#values),*],
            to_stages: #to_stages,
            from_stages: #from_stages,
        })
    })
}

/// The diagonal blocks of the stage matrix that maps velocities to velocities: `Ã A` for a separable system, and
/// `A = Ã` for a general one.
fn blocks(graph: &StepGraph<'_>, known: &Known) -> Option<Blocks> {
    let positions: Vec<usize> = graph.forces.iter().filter_map(|e| e.position).collect();
    let momenta: Vec<usize> = graph.velocities.iter().filter_map(|e| e.momentum).collect();
    // Scaled to eigenvalues of about 1: those of A are about 1/(2s).
    let scale = Fixed::integer(2 * momenta.len() as i64);
    let rows = |values: &[StageValue<'_>], indices: &[usize]| -> Rows {
        let entry = |number: &Number<'_>| {
            let value = Fixed::new(&number.enclose(BITS).middle());
            value.multiply(&scale)
        };
        let row = |&index: &usize| values[index].coefficients.iter().map(entry).collect();
        indices.iter().map(row).collect()
    };
    let a = rows(&graph.positions, &positions);
    let a_tilde = rows(&graph.momenta, &momenta);
    let equal = a.len() == a_tilde.len() && {
        let mut pairs = a.iter().flatten().zip(a_tilde.iter().flatten());
        pairs.all(|(a, a_tilde)| a.subtract(a_tilde).vanishes())
    };
    let (mut blocks, scale) = match (graph.class, equal) {
        (Class::General, false) => return None,
        (Class::General, true) => (known.blocks(a, diagonalise)?, scale),
        (Class::Separable, true) => {
            let blocks = known.blocks(a, diagonalise)?;
            (blocks.squared(), scale.multiply(&scale))
        }
        (Class::Separable, false) => {
            let matrix = product(&a_tilde, &a);
            (diagonalise(&matrix)?, scale.multiply(&scale))
        }
    };
    for (re, im) in &mut blocks.values {
        (*re, *im) = (re.divide(&scale), im.divide(&scale));
    }
    Some(blocks)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;

    /// Gauss methods are decoupled for both classes, Lobatto pairs for separable systems.
    #[test]
    fn gauss_methods_are_decoupled_and_lobatto_pairs_if_separable() {
        let check = |name: &str, [general, separable]: [bool; 2]| {
            let tableau = catalogue::find(name)
                .expect("known")
                .derive()
                .expect("derived");
            let numbers = tableau.numbers();
            let known = Known::new(&tableau);
            for (class, expected) in [(Class::General, general), (Class::Separable, separable)] {
                let graph = StepGraph::new(class, &tableau.exact, &numbers);
                let blocks = blocks(&graph, &known);
                assert_eq!(blocks.is_some(), expected, "{name} {class:?}");
                let Some(blocks) = blocks else { continue };
                // With an even number of stages, all eigenvalues of a Gauss method are complex.
                if name.starts_with("gauss") {
                    let stages = tableau.stages();
                    assert_eq!(blocks.values.len(), stages.div_ceil(2), "{name}");
                }
            }
        };
        check("gauss-1", [true, true]);
        check("gauss-2", [true, true]);
        check("gauss-5", [true, true]);
        check("gauss-8", [true, true]);
        check("lobatto-3", [false, true]);
        check("lobatto-4", [false, true]);
    }
}
