//! The momenta of velocities, in a system from a Lagrangian.

use proc_macro2::TokenStream;
use quote::quote;

use super::{Derivative, Emitter};
use crate::graph::Half;

impl Emitter<'_> {
    /// `p = ∂L/∂v`
    pub(super) fn momentum(&mut self) -> TokenStream {
        let Some(lagrangian) = &self.system.lagrangian else {
            return TokenStream::new();
        };
        let momentum = Derivative {
            into: "momentum",
            half: Half::V,
            of: lagrangian.formula,
            sign: 1,
        };
        let statements = self.derivative(&["q", "v"], momentum);
        let [generics, _, arguments] = self.generics();
        let name = &self.header.name;
        let (scalar, bound) = (&self.scalar, &self.bound);
        let over = self.vector(&quote!(#scalar));
        quote! {
            #[allow(unused_variables, non_snake_case, clippy::all)]
            impl #generics #name #arguments {
                /// The momenta `p = ∂L/∂v` of these velocities: `State::new(t, q, system.momentum_of_velocity(t, &q, &v))` is where to start.
                pub fn momentum_of_velocity<#scalar: #bound>(&self, time: #scalar, q: &#over, v: &#over) -> #over {
                    let mut result = v.clone();
                    let write = |momentum: &mut #over| {
                        #statements
                    };
                    write(&mut result);
                    result
                }
            }
        }
    }
}
