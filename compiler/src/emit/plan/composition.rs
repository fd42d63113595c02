//! Compositions of different methods, each with its own stages.

use num_rational::BigRational;
use proc_macro2::{Ident, TokenStream};
use quote::quote;

use super::{Plan, class_name, for_each_class, literal};
use crate::algebra::{Field, Real, Reals};
use crate::schedule::Class;
use crate::tableau::Substep;
use crate::tableau::Tableau;

/// A composition of different methods.
pub(super) struct Composed<'a> {
    /// The plans of the methods.
    pub(super) plans: Vec<Plan>,
    pub(super) methods: &'a [Tableau],
    pub(super) substeps: &'a [Substep],
}

impl Composed<'_> {
    /// The plan for one class.
    pub(super) fn of_class(&self, class: Class, name: &Ident) -> Plan {
        let class = class_name(class);
        let (generics, of_class) = (TokenStream::new(), quote!(emitted::#class));
        let substeps = self.code(&generics, &quote!(#name), &of_class);
        Plan {
            name: quote!(emitted::Composition<#name>),
            code: quote!(pub struct #name; #substeps),
            splits: false,
        }
    }

    /// The plans for both classes, from plans of the methods that are generic over the class `K`.
    pub(super) fn of_both(&self, name: &Ident) -> [Plan; 2] {
        let generics = quote!(<K: emitted::Class>);
        let substeps = self.code(&generics, &quote!(#name<K>), &quote!(K));
        let code = quote! {
            pub struct #name<K>(::core::marker::PhantomData<K>);

            #substeps
        };
        for_each_class(code, &quote!(Composition), name)
    }

    /// The plans of the methods, and the list of the substeps of a type, with these generic parameters.
    fn code(&self, generics: &TokenStream, name: &TokenStream, class: &TokenStream) -> TokenStream {
        let (plans, count) = (&self.plans, self.plans.len());
        let names: Vec<&TokenStream> = plans.iter().map(|plan| &plan.name).collect();
        let codes = plans.iter().map(|plan| &plan.code);
        // Memories as nested pairs.
        let memory = names.iter().rev().fold(TokenStream::new(), |rest, plan| {
            let own = quote!(<#plan as emitted::Plan>::Memory<V, S, N>);
            if rest.is_empty() {
                own
            } else {
                quote!((#own, #rest))
            }
        });
        let place = |method: usize| {
            let inner = (0..method).map(|_| quote!(.1));
            let last = (method + 1 < count).then(|| quote!(.0));
            quote!(memory #(#inner)* #last)
        };
        let arms = |call: &dyn Fn(&TokenStream, TokenStream) -> TokenStream| {
            let numbers = |method: usize| {
                let steps = self.substeps.iter().enumerate();
                let own = steps.filter(move |(_, step)| step.method == method);
                own.map(|(number, _)| literal::count(number))
            };
            // The last plan is the default arm.
            let arms = (0..count).map(|method| {
                let call = call(names[method], place(method));
                if method + 1 == count {
                    quote!(_ => #call)
                } else {
                    let numbers = numbers(method);
                    quote!(#(#numbers)|* => #call)
                }
            });
            quote!(match number { #(#arms),* })
        };
        let borrowed = |place: TokenStream| {
            if count == 1 {
                place
            } else {
                quote!(&mut #place)
            }
        };
        let take = arms(&|plan, place| {
            let place = borrowed(place);
            quote!(<#plan as emitted::Plan>::take::<R, V, S, N>(step, system, #place, kept, stopping, outcome))
        });
        let observe = arms(&|plan, place| {
            let place = borrowed(place);
            quote!(<#plan as emitted::Plan>::observe::<R, V, S, N, W>(step, system, #place, outcome, observer))
        });
        let substeps = self.list();
        let vector = quote!(V: emitted::Vector);
        let solver = quote!(N: emitted::Solver<V, S>);
        let arguments = quote! {
            R: emitted::Summation, #vector, S: emitted::System<V, Class = Self::Class>, #solver
        };
        quote! {
            #(#codes)*

            impl #generics emitted::Substeps for #name {
                type Class = #class;
                type Memory<#vector, S: emitted::System<V>, #solver> = #memory;

                const SUBSTEPS: &'static [emitted::Substep] = &[#(#substeps),*];

                #[inline]
                fn take<#arguments>(
                    number: usize,
                    step: &emitted::Step<'_, V>,
                    system: &S,
                    memory: &mut Self::Memory<V, S, N>,
                    kept: emitted::WarmStart,
                    stopping: emitted::Stopping,
                    outcome: emitted::Outcome<'_, V>,
                ) -> ::core::result::Result<emitted::StepStatistics, emitted::Failure> {
                    #take
                }

                fn observe<#arguments, W: emitted::EvaluationObserver>(
                    number: usize,
                    step: &emitted::Step<'_, V>,
                    system: &S,
                    memory: &mut Self::Memory<V, S, N>,
                    outcome: emitted::Outcome<'_, V>,
                    observer: &mut W,
                ) {
                    #observe
                }
            }
        }
    }

    /// The substeps as constants.
    fn list(&self) -> Vec<TokenStream> {
        let coefficient = |real: &Real| literal::coefficient(&Reals.number(real));
        let mut start = Real::rational(BigRational::default());
        let mut stages = 0;
        // Before the first substep comes the last one of the previous step.
        let mut before = self.substeps.last();
        let mut list = Vec::new();
        for substep in self.substeps {
            let fraction = Real::constant(substep.fraction.clone());
            let follows = before.is_some_and(|before| before.method == substep.method);
            let equal = follows && before.is_some_and(|before| before.fraction == substep.fraction);
            let (at, size) = (coefficient(&start), coefficient(&fraction));
            let count = literal::count(stages);
            list.push(quote! {
                emitted::Substep {
                    start: #at,
                    fraction: #size,
                    kept: emitted::WarmStart::new(#follows, #equal),
                    stages: #count,
                }
            });
            start = Reals.add(&start, &fraction);
            stages += self.methods[substep.method].stages();
            before = Some(substep);
        }
        list
    }
}
