//! Symmetry of tableaux whose coefficients are numbers in a field.

use super::{SEARCH_BITS, Symmetry, search};
use crate::algebra::{Dense, Field, Number, StageAlgebra, Zero};
use crate::coefficients::Coefficients;
use crate::evidence::Evidence;
use crate::partitioned::Partitioned;
use crate::properties::Property;

impl<F: Field> Symmetry for Dense<F> {
    /// Enclosures find the permutation, the field decides the equations for it.
    fn symmetric(pair: &Partitioned<Self>, numbers: &Coefficients<Number<'_>>) -> Property {
        let order = match search(numbers) {
            Ok(order) => order,
            Err(property) => return property,
        };
        let (algebra, image) = (&*pair.algebra, &order.0);
        let field = algebra.field();
        let adjoint = pair.adjoint();
        let stages = 0..algebra.stages();
        let weights = [&pair.b, &pair.b_tilde].into_iter().flat_map(|b| {
            let residual = |i: usize| field.subtract(&b[image[i]], &b[i]);
            stages.clone().map(residual)
        });
        let halves = [(&pair.a, &adjoint.a), (&pair.a_tilde, &adjoint.a_tilde)];
        let entries = halves.into_iter().flat_map(|(a, reflected)| {
            let places = stages
                .clone()
                .flat_map(|i| stages.clone().map(move |j| (i, j)));
            places.map(|(i, j)| field.subtract(&a[image[i]][image[j]], &reflected[i][j]))
        });
        let mut evidence = Evidence::Proved;
        for residual in weights.chain(entries) {
            match field.zero(&residual) {
                Zero::Yes => {}
                Zero::Within(bits) => evidence = evidence.and(Evidence::Verified { bits }),
                // Another permutation may be left that enclosures could not exclude either.
                Zero::No => {
                    let witness = format!("not equal to the adjoint {}", order.witness());
                    return Property::undecided(SEARCH_BITS, witness);
                }
            }
        }
        Property::holding(evidence, order.unusual())
    }
}
