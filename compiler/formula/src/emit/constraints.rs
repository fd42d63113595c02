//! Constraints with their gradients or rows, and friction: what a system has in addition to its Hamiltonian.

use num_traits::One;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::Emitter;
use super::block::{Task, Write, Writer};
use super::names::{identifier, index_name, index_tokens};
use crate::Constraint;
use crate::derivative::gradient;
use crate::graph::{Half, Id, LoopId, LoopRange, Number};
use crate::operations::Operations;

impl Emitter<'_> {
    /// The implementation of `Friction` or of the trait of the constraints, and `Hamiltonian::extra`, which returns it; empty if there
    /// are neither.
    pub(super) fn in_addition(&mut self) -> [TokenStream; 2] {
        let given = [
            (quote!(friction::Friction), self.friction()),
            (
                quote!(constraints::HolonomicConstraints),
                self.constraints(),
            ),
            (
                quote!(constraints::NonholonomicConstraints),
                self.nonholonomic(),
            ),
        ]
        .into_iter()
        .find(|(_, functions)| !functions.is_empty());
        let Some((of, functions)) = given else {
            return Default::default();
        };
        let name = &self.header.name;
        let [_, lengths, arguments] = self.generics();
        let (scalar, bound) = (&self.scalar, &self.bound);
        let over = self.vector(&quote!(#scalar));
        let implementation = quote! {
            #[allow(unused_variables, non_snake_case, clippy::all)]
            impl<#scalar: #bound, #lengths> ::symplectic::#of<#over> for #name #arguments {
                #functions
            }
        };
        let extra = quote! {
            #[inline(always)]
            fn extra<#scalar: #bound>(&self) -> ::core::option::Option<&dyn ::symplectic::#of<#over>> {
                ::core::option::Option::Some(self)
            }
        };
        [implementation, extra]
    }

    fn friction(&self) -> TokenStream {
        let rates = &self.system.friction;
        let Some((&last, others)) = rates.split_last() else {
            return TokenStream::new();
        };
        let last = self.rate(last);
        let statements = if others.is_empty() {
            last
        } else {
            let count = rates.len();
            let others = others.iter().map(|&rate| self.rate(rate));
            let arms = others.enumerate().map(|(k, rate)| quote!(#k => { #rate }));
            quote!(match component % #count { #(#arms)* _ => { #last } })
        };
        quote! {
            #[inline(always)]
            fn friction(&self, component: usize) -> f64 {
                #statements
            }
        }
    }

    /// The statements that return a rate of friction.
    fn rate(&self, rate: Id) -> TokenStream {
        let operations = Operations::new(&self.system.graph, &[rate]);
        let write: Write = Box::new(|value| quote!(return #value;));
        let task = Task {
            loops: Vec::new(),
            value: operations.of(rate),
            write,
            fixed: true,
        };
        let writer = Writer::new(
            &self.system,
            &operations,
            self.scalar.clone(),
            &self.prefix,
            TokenStream::new(),
        );
        writer.write(&[task])
    }

    fn constraints(&mut self) -> TokenStream {
        let constraints = self.system.constraints.clone();
        if constraints.is_empty() {
            return TokenStream::new();
        }
        let starts = self.starts(&constraints);
        let count = &starts[constraints.len()];
        let [mut values, mut gradients] = [Vec::new(), Vec::new()];
        for (constraint, start) in constraints.iter().zip(&starts) {
            let loops: Vec<LoopId> = constraint.over.into_iter().collect();
            for (k, &part) in constraint.parts.iter().enumerate() {
                let number = self.number(constraint, start, k);
                values.push((loops.clone(), part, quote!(values[#number])));
                let graph = &mut self.system.graph;
                for entry in gradient(graph, part, &loops, Number::one(), Half::Q) {
                    let component = self.place(&entry.target);
                    let place = quote!(#number, #component);
                    gradients.push((entry.loops, entry.value, place));
                }
            }
        }
        let nan = self.scalar.clone();
        let values = self.tasks(
            values,
            quote!(values.fill(#nan::from_f64(f64::NAN)); return;),
            |place, value| quote!(#place = #value;),
        );
        let gradients = self.tasks(
            gradients,
            quote!(return;),
            |place, value| quote!(gradients.set(#place, #value);),
        );
        let scalar = &self.scalar;
        let over = self.vector(&quote!(#scalar));
        let names = self.constraint_names(&constraints, &starts);
        quote! {
            fn constraints(&self) -> usize {
                #count
            }

            #names

            #[inline(always)]
            fn constraint_values(&self, q: &#over, values: &mut [#scalar]) {
                #values
            }

            #[inline(always)]
            fn constraint_gradients(&self, q: &#over, gradients: &mut ::symplectic::constraints::Gradients<#scalar>) {
                #gradients
            }
        }
    }

    fn nonholonomic(&mut self) -> TokenStream {
        let constraints = self.system.nonholonomic.clone();
        if constraints.is_empty() {
            return TokenStream::new();
        }
        let starts = self.starts(&constraints);
        let count = &starts[constraints.len()];
        let mut rows = Vec::new();
        for (constraint, start) in constraints.iter().zip(&starts) {
            let loops: Vec<LoopId> = constraint.over.into_iter().collect();
            for (k, &part) in constraint.parts.iter().enumerate() {
                let number = self.number(constraint, start, k);
                let graph = &mut self.system.graph;
                for entry in gradient(graph, part, &loops, Number::one(), Half::V) {
                    let component = self.place(&entry.target);
                    rows.push((entry.loops, entry.value, quote!(#number, #component)));
                }
            }
        }
        let rows = self.tasks(
            rows,
            quote!(return;),
            |place, value| quote!(rows.set(#place, #value);),
        );
        let scalar = &self.scalar;
        let over = self.vector(&quote!(#scalar));
        let names = self.constraint_names(&constraints, &starts);
        quote! {
            fn nonholonomic_constraints(&self) -> usize {
                #count
            }

            #names

            #[inline(always)]
            fn nonholonomic_rows(&self, q: &#over, rows: &mut ::symplectic::constraints::Gradients<#scalar>) {
                #rows
            }
        }
    }

    /// The name of each constraint, for errors.
    fn constraint_names(&self, constraints: &[Constraint], starts: &[TokenStream]) -> TokenStream {
        let (mut before, mut rules) = (&starts[0], Vec::new());
        for (constraint, end) in constraints.iter().zip(&starts[1..]) {
            let name = &constraint.name;
            let parts = Literal::usize_unsuffixed(constraint.parts.len());
            let number = match before.to_string().as_str() {
                "0" => quote!(constraint),
                _ => quote!((constraint - (#before))),
            };
            let member = match (constraint.over, constraint.parts.len()) {
                (None, 1) => quote!(::core::option::Option::None),
                (None, _) | (Some(_), 1) => quote!(::core::option::Option::Some(#number)),
                (Some(_), _) => quote!(::core::option::Option::Some(#number / #parts)),
            };
            rules.push(quote! {
                if constraint < #end {
                    return ::core::option::Option::Some(::symplectic::constraints::ConstraintName { name: #name, member: #member });
                }
            });
            before = end;
        }
        quote! {
            fn constraint_name(&self, constraint: usize) -> ::core::option::Option<::symplectic::constraints::ConstraintName> {
                #(#rules)*
                ::core::option::Option::None
            }
        }
    }

    /// The first index of each family of constraints, and the total number.
    fn starts(&self, constraints: &[Constraint]) -> Vec<TokenStream> {
        let mut starts = vec![quote!(0)];
        for constraint in constraints {
            let (before, own) = (&starts[starts.len() - 1], self.count(constraint));
            let next = match before.to_string().as_str() {
                "0" => own,
                _ => quote!(#before + #own),
            };
            starts.push(next);
        }
        starts
    }

    /// Number of constraints of a family.
    fn count(&self, constraint: &Constraint) -> TokenStream {
        let parts = Literal::usize_unsuffixed(constraint.parts.len());
        let indices = match constraint
            .over
            .map(|over| &self.system.graph.get_loop(over).range)
        {
            None => return quote!(#parts),
            Some(LoopRange::List(parameter)) => {
                let list = identifier(&self.system.parameters[*parameter].name);
                quote!(self.#list.len())
            }
            Some(LoopRange::Between(start, end)) => {
                let [start, end] = [start, end].map(index_tokens);
                match start.to_string().as_str() {
                    "0" => quote!(#end),
                    _ => quote!((#end).saturating_sub(#start)),
                }
            }
        };
        match constraint.parts.len() {
            1 => indices,
            _ => quote!(#parts * #indices),
        }
    }

    /// The index of a constraint of a family, in the loop of the family's indices.
    fn number(&self, constraint: &Constraint, start: &TokenStream, part: usize) -> TokenStream {
        let mut terms = Vec::new();
        if start.to_string() != "0" {
            terms.push(start.clone());
        }
        if let Some(over) = constraint.over {
            let index = index_name(over);
            let index = match &self.system.graph.get_loop(over).range {
                LoopRange::Between(first, _)
                    if first.offset != 0 || index_tokens(first).to_string() != "0" =>
                {
                    let first = index_tokens(first);
                    quote!((#index - #first))
                }
                _ => quote!(#index),
            };
            let parts = Literal::usize_unsuffixed(constraint.parts.len());
            terms.push(match constraint.parts.len() {
                1 => index,
                _ => quote!(#parts * #index),
            });
        }
        if part > 0 || terms.is_empty() {
            let part = Literal::usize_unsuffixed(part);
            terms.push(quote!(#part));
        }
        quote!(#(#terms)+*)
    }

    /// The statements for values in loops, each with its place.
    fn tasks(
        &self,
        parts: Vec<(Vec<LoopId>, Id, TokenStream)>,
        outside: TokenStream,
        write: fn(&TokenStream, &TokenStream) -> TokenStream,
    ) -> TokenStream {
        let views = self.views(&["q"], &[]);
        let least = self.least(&outside);
        let roots: Vec<Id> = parts.iter().map(|part| part.1).collect();
        let operations = Operations::new(&self.system.graph, &roots);
        let tasks = parts.into_iter().map(|(loops, value, place)| {
            let write: Write = Box::new(move |value| write(&place, value));
            Task {
                loops,
                value: operations.of(value),
                write,
                fixed: false,
            }
        });
        let writer = Writer::new(
            &self.system,
            &operations,
            self.scalar.clone(),
            &self.prefix,
            outside,
        );
        let statements = writer.write(&tasks.collect::<Vec<_>>());
        quote!(#views #least #statements)
    }
}
