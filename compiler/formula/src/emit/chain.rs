//! Chains of neighbours.

use num_traits::One;
use proc_macro2::TokenStream;
use quote::quote;

use super::Emitter;
use super::block::{Task, Write, Writer};
use crate::derivative::gradient;
use crate::graph::{Half, Id, LoopId, Number};
use crate::operations::Operations;
use crate::structure::ChainParts;
use crate::syntax::Ends;
use crate::{Parameter, Shape};

impl Emitter<'_> {
    /// A chain: the functions of its bonds that the runtime calls.
    pub(super) fn chain(&mut self, parts: &ChainParts) -> TokenStream {
        let name = self.header.name.clone();
        let [generics, parameters, arguments] = self.generics();
        let (scalar, bound) = (self.scalar.clone(), self.bound.clone());
        let ends = match self.system.ends {
            Some(Ends::Walls) => quote!(between_walls),
            Some(Ends::Free) => quote!(with_free_ends),
            Some(Ends::Ring) | None => quote!(ring),
        };
        let tension = gradient(
            &mut self.system.graph,
            parts.bond,
            &[],
            Number::one(),
            Half::Q,
        );
        let tension = tension.first().map_or(parts.bond, |part| part.value);
        let stiffness = self.slope(tension);
        let outer = parts.on_site.map(|(energy, over)| {
            let minus = -Number::one();
            let parts = gradient(&mut self.system.graph, energy, &[over], minus, Half::Q);
            let force = parts.first().map(|part| part.value);
            let stiffness = force.map(|force| {
                let slope = self.slope(force);
                self.system.graph.scale(-Number::one(), slope)
            });
            (energy, force, stiffness, over)
        });
        // Numbers are copied, so that they stay in registers.
        let only_numbers = |parameter: &Parameter| matches!(parameter.shape, Shape::Number(_));
        let bonds = match self.system.parameters.iter().all(only_numbers) {
            true => quote!(|bonds: &Self| *bonds),
            false => quote!(|bonds| bonds),
        };
        let (variable, site) = (quote!(stretch), quote!(position));
        let function = |this: &Self, argument: &TokenStream, value: Id, over: Option<LoopId>| {
            let operations = Operations::new(&this.system.graph, &[value]);
            let mut writer = Writer::new(
                &this.system,
                &operations,
                scalar.clone(),
                &this.prefix,
                TokenStream::new(),
            );
            let write: Write = Box::new(|value| quote!(let value = #value;));
            let task = Task {
                loops: Vec::new(),
                value: operations.of(value),
                write,
                fixed: false,
            };
            let statements = writer.function(task, argument.clone(), over);
            quote!(#statements value)
        };
        let bond_energy = function(self, &variable, parts.bond, None);
        let tension = function(self, &variable, tension, None);
        let stiffness = function(self, &variable, stiffness, None);
        let outer = outer.map(|(energy, force, stiffness, over)| {
            let energy = function(self, &site, energy, Some(over));
            let [force, stiffness] = [force, stiffness].map(|value| match value {
                Some(value) => function(self, &site, value, Some(over)),
                None => quote!(#scalar::zero()),
            });
            quote! {
                #[inline(always)]
                fn outer_force<#scalar: #bound>(&self, time: #scalar, position: #scalar) -> ::core::option::Option<#scalar> {
                    ::core::option::Option::Some({ #force })
                }

                #[inline(always)]
                fn outer_stiffness<#scalar: #bound>(&self, time: #scalar, position: #scalar) -> ::core::option::Option<#scalar> {
                    ::core::option::Option::Some({ #stiffness })
                }

                fn outer_energy<#scalar: #bound>(&self, time: #scalar, position: #scalar) -> ::core::option::Option<#scalar> {
                    ::core::option::Option::Some({ #energy })
                }
            }
        });
        let inlined = self.inlined();
        let check_dimension = self.check_dimension();
        quote! {
            #[allow(unused_variables, non_snake_case, clippy::all)]
            impl #generics ::symplectic::emitted::Bonds for #name #arguments {
                #inlined

                #[inline(always)]
                fn tension<#scalar: #bound>(&self, time: #scalar, stretch: #scalar) -> #scalar {
                    #tension
                }

                const FORCE_GRADIENT: bool = true;

                #[inline(always)]
                fn stiffness<#scalar: #bound>(&self, time: #scalar, stretch: #scalar) -> ::core::option::Option<#scalar> {
                    ::core::option::Option::Some({ #stiffness })
                }

                fn bond_energy<#scalar: #bound>(&self, time: #scalar, stretch: #scalar) -> ::core::option::Option<#scalar> {
                    ::core::option::Option::Some({ #bond_energy })
                }

                #outer

                #check_dimension
            }

            ::symplectic::emitted::chain_system!((#parameters) (#name #arguments), #bonds, #ends);
        }
    }

    /// The derivative of a function of one position.
    fn slope(&mut self, value: Id) -> Id {
        let graph = &mut self.system.graph;
        let parts = gradient(graph, value, &[], Number::one(), Half::Q);
        let values: Vec<_> = parts
            .iter()
            .map(|part| (Number::one(), part.value))
            .collect();
        graph.sum(values)
    }
}
