//! The system whose parameters have a value for each lane: trajectories with different parameters run side by side.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::Emitter;
use super::names::identifier;
use crate::derivative::Scatter;

/// Code for lanes; empty for a system without parameters.
#[derive(Default)]
pub(super) struct Lanes {
    /// The type of the joined systems.
    pub(super) system: TokenStream,
    /// Its items in the trait of the system.
    pub(super) join: TokenStream,
}

/// The names of types in the code for lanes: none of them is a name of the user.
pub(super) struct LaneNames {
    /// The type of the joined systems.
    system: Ident,
    vector: Ident,
    scalar: Ident,
    work: Ident,
}

impl LaneNames {
    /// The names for a system; `unused` makes a name of the user differ.
    pub(super) fn new(system: &Ident, unused: impl Fn(&str) -> Ident) -> Self {
        LaneNames {
            system: unused(&format_ident!("{system}InLanes").to_string()),
            vector: unused("LaneVector"),
            scalar: unused("LaneScalar"),
            work: unused("LaneWork"),
        }
    }
}

/// A derivative and its parts.
type Parts = (&'static str, Vec<Scatter>);

impl Emitter<'_> {
    /// The lanes of a separable system.
    pub(super) fn separable_in_lanes(
        &self,
        unit: &Option<TokenStream>,
        velocities: &[Parts],
        forces: &[Parts],
        force_gradient: &Option<[Parts; 1]>,
    ) -> Lanes {
        if self.system.parameters.is_empty() {
            return Lanes::default();
        }
        let [generics, _, arguments] = self.generics();
        let name = &self.lanes.system;
        let (scalar, bound) = (&self.scalar, &self.bound);
        let over = self.vector(&quote!(#scalar));
        let velocity = self.derivatives_by(&["p"], velocities, &["velocity"], |writer| {
            writer.in_lanes()
        });
        let force = self.derivatives_by(&["q"], forces, &["force"], |writer| writer.in_lanes());
        let force_gradient = force_gradient.as_ref().map(|parts| {
            let read = ["q", "p"];
            let statements =
                self.derivatives_by(&read, parts, &["gradient"], |writer| writer.in_lanes());
            self.force_gradient(&statements)
        });
        let joined = self.joined();
        Lanes {
            join: self.join(&quote!(in_lanes_of_separable), &quote!(Separable)),
            system: quote! {
                #joined

                #[allow(unused_variables, non_snake_case, clippy::all)]
                impl #generics ::symplectic::SeparableHamiltonian for #name #arguments {
                    type Vector<#scalar: #bound> = #over;

                    #unit

                    #[inline(always)]
                    fn velocity<#scalar: #bound>(&self, time: #scalar, p: &#over, velocity: &mut #over) {
                        #velocity
                    }

                    #[inline(always)]
                    fn force<#scalar: #bound>(&self, time: #scalar, q: &#over, force: &mut #over) {
                        #force
                    }

                    #force_gradient
                }
            },
        }
    }

    /// The lanes of a system that is not separable. Its steps need velocity and force together.
    pub(super) fn general_in_lanes(&self, parts: &[Parts]) -> Lanes {
        if self.system.parameters.is_empty() || !self.system.is_free() {
            return Lanes::default();
        }
        let [generics, _, arguments] = self.generics();
        let name = &self.lanes.system;
        let (scalar, bound) = (&self.scalar, &self.bound);
        let over = self.vector(&quote!(#scalar));
        let written = ["velocity", "force"];
        let slopes = self.derivatives_by(&["q", "p"], parts, &written, |writer| writer.in_lanes());
        let joined = self.joined();
        Lanes {
            join: self.join(&quote!(in_lanes), &quote!(General)),
            system: quote! {
                #joined

                #[allow(unused_variables, non_snake_case, clippy::all)]
                impl #generics ::symplectic::Hamiltonian for #name #arguments {
                    type Class = ::symplectic::General;
                    type Vector<#scalar: #bound> = #over;

                    #[inline(always)]
                    fn velocity<#scalar: #bound>(&self, time: #scalar, q: &#over, p: &#over, velocity: &mut #over) {
                        ::symplectic::Hamiltonian::slopes(self, time, q, p, (velocity, &mut q.clone()));
                    }

                    #[inline(always)]
                    fn force<#scalar: #bound>(&self, time: #scalar, q: &#over, p: &#over, force: &mut #over) {
                        ::symplectic::Hamiltonian::slopes(self, time, q, p, (&mut q.clone(), force));
                    }

                    #[inline(always)]
                    fn slopes<#scalar: #bound>(&self, time: #scalar, q: &#over, p: &#over, (velocity, force): (&mut #over, &mut #over)) {
                        #slopes
                    }
                }
            },
        }
    }

    /// The items of the trait of the system.
    fn join(&self, function: &TokenStream, class: &TokenStream) -> TokenStream {
        let [_, _, arguments] = self.generics();
        let LaneNames {
            system,
            vector,
            scalar,
            work,
        } = &self.lanes;
        let over = self.vector(&quote!(#scalar));
        quote! {
            const JOINS: bool = true;

            #[inline(always)]
            fn #function<#vector, #scalar, #work>(work: #work) -> #work::Output
            where
                Self: ::symplectic::System<#vector, Class = ::symplectic::#class>,
                #vector: ::symplectic::Vector,
                #scalar: ::symplectic::simd::Lanes,
                #work: ::symplectic::emitted::LaneWork<#vector, Self, #scalar>,
            {
                work.run::<#over, #system #arguments>(#system::join)
            }
        }
    }

    /// The type, and the function that makes it.
    fn joined(&self) -> TokenStream {
        let [generics, _, arguments] = self.generics();
        let (own, name) = (&self.header.name, &self.lanes.system);
        let parameters = self.system.parameters.iter();
        let (fields, kinds): (Vec<Ident>, Vec<TokenStream>) = parameters
            .map(|parameter| (identifier(&parameter.name), Self::field(&parameter.shape)))
            .unzip();
        quote! {
            #[allow(non_snake_case)]
            struct #name #generics {
                #(#fields: <#kinds as ::symplectic::emitted::LaneParameter>::InLanes),*
            }

            #[allow(non_snake_case)]
            impl #generics #name #arguments {
                fn join(systems: &mut dyn ::core::iter::Iterator<Item = &#own #arguments>) -> ::core::option::Option<Self> {
                    use ::symplectic::emitted::LaneParameter as _;
                    let first = systems.next()?;
                    let mut joined = Self { #(#fields: first.#fields.in_all_lanes()),* };
                    for (lane, system) in (1..).zip(systems) {
                        #(system.#fields.set_lane(lane, &mut joined.#fields)?;)*
                    }
                    ::core::option::Option::Some(joined)
                }
            }
        }
    }
}
