//! The Lagrangian itself.

use proc_macro2::TokenStream;
use quote::quote;

use super::{Derivative, Emitter};
use crate::graph::Half;

impl Emitter<'_> {
    /// The implementation of `Lagrangian` with its forces; empty with constraints or friction, which the trait does not cover.
    pub(super) fn lagrangian(&mut self) -> TokenStream {
        let Some(lagrangian) = self.system.lagrangian.clone() else {
            return TokenStream::new();
        };
        if self.system.is_constrained() || !self.system.friction.is_empty() {
            return TokenStream::new();
        }
        let [generics, _, arguments] = self.generics();
        let name = &self.header.name;
        let (scalar, bound) = (&self.scalar.clone(), &self.bound.clone());
        let over = self.vector(&quote!(#scalar));
        let outside = quote!(return #scalar::from_f64(f64::NAN););
        let value = self.values(&["q", "v"], &[lagrangian.formula], outside);
        let gradient = self.gradients(&[("by_velocity", Half::V), ("by_position", Half::Q)].map(
            |(into, half)| Derivative {
                into,
                half,
                of: lagrangian.formula,
                sign: 1,
            },
        ));
        let gradient = self.derivatives(&["q", "v"], &gradient, &["by_velocity", "by_position"]);
        let force = (!lagrangian.applied.is_empty()).then(|| {
            let parts = [("force", lagrangian.applied.clone())];
            let statements = self.derivatives(&["q", "v"], &parts, &["force"]);
            quote! {
                const FORCED: bool = true;

                fn force<#scalar: #bound>(&self, time: #scalar, q: &#over, v: &#over, force: &mut #over) {
                    #statements
                }
            }
        });
        let check_dimension = self.check_dimension();
        quote! {
            #[allow(unused_variables, non_snake_case, clippy::all)]
            impl #generics ::symplectic::system::Lagrangian for #name #arguments {
                type Vector<#scalar: #bound> = #over;

                fn lagrangian<#scalar: #bound>(&self, time: #scalar, q: &#over, v: &#over) -> #scalar {
                    #value
                    result_1
                }

                fn gradient<#scalar: #bound>(&self, time: #scalar, q: &#over, v: &#over, by_velocity: &mut #over, by_position: &mut #over) -> bool {
                    let write = |by_velocity: &mut #over, by_position: &mut #over| {
                        #gradient
                    };
                    write(by_velocity, by_position);
                    true
                }

                #force

                #check_dimension
            }
        }
    }
}
