//! Rust code for a system that was read from a formula.
//!
//! The type has a field for each parameter. It implements the trait of the class that was found: `SeparableHamiltonian`, `Hamiltonian`, or
//! the parts of a chain; and `Lagrangian`, if the system was given by one. The order of evaluation is that of
//! [`operations`](crate::operations). Sums over indices are loops, so the code is as long for a thousand bodies as for three.

mod band;
mod block;
mod chain;
mod constraints;
mod expression;
mod fields;
mod in_lanes;
mod invariants;
mod jacobian;
mod lagrangian;
mod lengths;
mod momentum;
mod named;
mod names;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use self::block::{Task, Write, Writer};
use self::in_lanes::{LaneNames, Lanes};
use self::names::{entry, identifier, length_tokens};
use crate::derivative::{Scatter, gradient};
use crate::graph::{Half, Id, Number};
use crate::operations::Operations;
use crate::structure::{Split, each_once};
use crate::syntax::Length;
use crate::{Kinetic, Layout, Structure, System};
pub use symplectic_exact::code::Header;

/// The type of a system with everything that was derived from its formula.
pub fn system(system: &System, structure: &Structure, header: &Header) -> TokenStream {
    let emitter = Emitter::new(system, structure, header);
    emitter.code()
}

struct Emitter<'a> {
    system: System,
    structure: &'a Structure,
    header: &'a Header,
    /// The scalar of generic functions.
    scalar: Ident,
    /// The trait of scalars.
    bound: Ident,
    /// Prefix of the names of values.
    prefix: String,
    /// The names of the code for lanes.
    lanes: LaneNames,
}

/// A derivative, the vector it is written to, and its sign.
struct Derivative {
    /// The vector.
    into: &'static str,
    half: Half,
    of: Id,
    sign: i64,
}

impl<'a> Emitter<'a> {
    fn new(system: &System, structure: &'a Structure, header: &'a Header) -> Self {
        let users = || {
            let parameters = system
                .parameters
                .iter()
                .map(|parameter| parameter.name.as_str());
            let functions = system.functions.iter().flatten().map(String::as_str);
            parameters
                .chain(functions)
                .chain(system.lengths.iter().map(String::as_str))
        };
        let unused = |name: &str| {
            let mut name = name.to_owned();
            while users().any(|user| user == name) {
                name.push('_');
            }
            format_ident!("{name}")
        };
        let free = |candidates: &[&str], taken: &dyn Fn(&str, &str) -> bool| {
            let found = candidates
                .iter()
                .find(|name| !users().any(|user| taken(name, user)));
            found.copied().unwrap_or("value_of_formula_").to_owned()
        };
        let scalar = free(&["T", "S", "U", "Number"], &|name, user| name == user);
        let numbered = |name: &str, user: &str| {
            user.strip_prefix(name)
                .is_some_and(|rest| rest.chars().all(|c| c.is_ascii_digit()))
        };
        let prefix = free(&["x", "y", "z", "u", "v", "w"], &numbered);
        Emitter {
            system: system.clone(),
            structure,
            header,
            scalar: format_ident!("{scalar}"),
            bound: unused("Scalar"),
            prefix,
            lanes: LaneNames::new(&header.name, unused),
        }
    }

    fn code(mut self) -> TokenStream {
        let fields = self.fields();
        let lagrangian = self.lagrangian();
        let dynamics = match (self.structure.chain, self.structure.split) {
            _ if self.system.without_hamiltonian().is_some() => TokenStream::new(),
            (Some(parts), _) => self.chain(&parts),
            (None, Ok(split)) if self.system.is_free() => self.separable(split),
            (None, split) => self.general(split.ok()),
        };
        let named = self.named();
        let momentum = self.momentum();
        let invariants = self.invariants();
        if self.system.graph.overflowed() {
            return quote!(::core::compile_error!("the derivatives have too many sums in one another"););
        }
        let bound = match self.bound == "Scalar" {
            true => quote!(Scalar),
            false => {
                let name = &self.bound;
                quote!(Scalar as #name)
            }
        };
        quote! {
            #fields
            const _: () = {
                #[allow(unused_imports, clippy::all)]
                use ::symplectic::emitted::{One as _, #bound, Zero as _};

                #dynamics

                #lagrangian

                #named

                #momentum

                #invariants
            };
        }
    }

    /// The generics of the type: as declared, with their kinds only, and as arguments.
    fn generics(&self) -> [TokenStream; 3] {
        let names: Vec<Ident> = self
            .system
            .lengths
            .iter()
            .map(|name| identifier(name))
            .collect();
        if names.is_empty() {
            return Default::default();
        }
        [
            quote!(<#(const #names: usize),*>),
            quote!(#(const #names: usize),*),
            quote!(<#(#names),*>),
        ]
    }

    /// The type of positions and momenta over a scalar.
    fn vector(&self, scalar: &TokenStream) -> TokenStream {
        match &self.system.layout {
            Layout::Named([names, _]) => {
                let n = Literal::usize_unsuffixed(names.len());
                quote!(::symplectic::nalgebra::SVector<#scalar, #n>)
            }
            Layout::Numbered(Length::Runtime, _) => {
                quote!(::symplectic::nalgebra::DVector<#scalar>)
            }
            Layout::Numbered(length, components) => {
                let length = length_tokens(length);
                match components {
                    None => quote!(::symplectic::nalgebra::SVector<#scalar, #length>),
                    Some(components) => {
                        let components = Literal::usize_unsuffixed(*components);
                        quote!(::symplectic::nalgebra::SMatrix<#scalar, #components, #length>)
                    }
                }
            }
        }
    }

    /// Names for the entries of a function's vectors, and the number of entries.
    fn views(&self, read: &[&str], written: &[&str]) -> TokenStream {
        let mut code = TokenStream::new();
        let runtime = matches!(self.system.layout, Layout::Numbered(Length::Runtime, _));
        let components = match self.system.layout {
            Layout::Numbered(_, components) => components.map(Literal::usize_unsuffixed),
            Layout::Named(_) => None,
        };
        for (name, change) in read
            .iter()
            .map(|name| (name, false))
            .chain(written.iter().map(|name| (name, true)))
        {
            let name = format_ident!("{name}");
            let mutable = change.then(|| quote!(mut));
            code.extend(match (runtime, &components) {
                (false, None) => quote!(let #name = &#mutable #name.data.0[0];),
                (false, Some(_)) => quote!(let #name = &#mutable #name.data.0;),
                (true, components) => {
                    let slice = if change {
                        quote!(as_mut_slice)
                    } else {
                        quote!(as_slice)
                    };
                    let chunks = if change {
                        quote!(as_chunks_mut)
                    } else {
                        quote!(as_chunks)
                    };
                    let chunks = components.as_ref().map(|k| quote!(.#chunks::<#k>().0));
                    quote!(let #name = #name.#slice()#chunks;)
                }
            });
        }
        if runtime {
            let names: Vec<Ident> = read
                .iter()
                .chain(written)
                .map(|name| format_ident!("{name}"))
                .collect();
            code.extend(quote!(let n = [#(#names.len()),*].into_iter().min().unwrap_or(0);));
            for (k, name) in names.iter().enumerate() {
                let mutable = (k >= read.len()).then(|| quote!(mut));
                code.extend(quote!(let #name = &#mutable #name[..n];));
            }
        }
        code
    }

    /// The code for too few coordinates or for a pair out of range: it sets the results to NaN, which an integrator reports.
    fn outside(&self, written: &[&str]) -> TokenStream {
        let scalar = &self.scalar;
        let fill = written.iter().map(|name| {
            let name = format_ident!("{name}");
            match self.system.layout {
                Layout::Numbered(_, Some(_)) => {
                    quote!(#name.as_flattened_mut().fill(#scalar::from_f64(f64::NAN));)
                }
                _ => quote!(#name.fill(#scalar::from_f64(f64::NAN));),
            }
        });
        quote!(#(#fill)* return;)
    }

    /// The check that there are at least as many coordinates as the formula names.
    fn least(&self, outside: &TokenStream) -> TokenStream {
        let length = self.system.layout.length();
        if self.system.least == 0 || matches!(length, Length::Fixed(_)) {
            return TokenStream::new();
        }
        let (length, least) = (
            length_tokens(&length),
            Literal::usize_unsuffixed(self.system.least),
        );
        quote!(if #length < #least { #outside })
    }

    /// The statements that write a derivative.
    fn derivative(&mut self, read: &[&str], derivative: Derivative) -> TokenStream {
        let into = derivative.into;
        let parts = self.gradients(&[derivative]);
        self.derivatives(read, &parts, &[into])
    }

    fn gradients(&mut self, derivatives: &[Derivative]) -> Vec<(&'static str, Vec<Scatter>)> {
        let mut parts: Vec<(&'static str, Vec<Scatter>)> = Vec::new();
        for derivative in derivatives {
            let sign = Number::from_integer(derivative.sign.into());
            let all = gradient(
                &mut self.system.graph,
                derivative.of,
                &[],
                sign,
                derivative.half,
            );
            parts.push((derivative.into, all));
        }
        parts
    }

    /// The statements that write some of the derivatives. The operations are derived from all derivatives together, so
    /// each derivative has the same bits in every selection.
    fn derivatives(
        &self,
        read: &[&str],
        parts: &[(&'static str, Vec<Scatter>)],
        written: &[&str],
    ) -> TokenStream {
        self.derivatives_by(read, parts, written, |writer| writer)
    }

    /// [`derivatives`](Self::derivatives) by another writer.
    fn derivatives_by(
        &self,
        read: &[&str],
        parts: &[(&'static str, Vec<Scatter>)],
        written: &[&str],
        by: impl for<'w> FnOnce(Writer<'w>) -> Writer<'w>,
    ) -> TokenStream {
        let views = self.views(read, written);
        let outside = self.outside(written);
        let least = self.least(&outside);
        let roots: Vec<Id> = parts
            .iter()
            .flat_map(|(_, parts)| parts.iter().map(|part| part.value))
            .collect();
        let operations = Operations::new(&self.system.graph, &roots);
        let mut clear = TokenStream::new();
        let mut tasks = Vec::new();
        for (into, parts) in parts.iter().filter(|(into, _)| written.contains(into)) {
            let vector = format_ident!("{into}");
            let vector = quote!(#vector);
            // Entries that are set once need no zero first.
            let once = each_once(&self.system, parts);
            if !once {
                let scalar = &self.scalar;
                let zero = quote!(#scalar::zero());
                clear.extend(match self.system.layout {
                    Layout::Numbered(_, Some(_)) => quote!(#vector.as_flattened_mut().fill(#zero);),
                    _ => quote!(#vector.fill(#zero);),
                });
            }
            for part in parts {
                let place = entry(&self.system.layout, &vector, &part.target);
                let value = operations.of(part.value);
                let write: Write = match once {
                    true => Box::new(move |value| quote!(#place = #value;)),
                    false => Box::new(move |value| quote!(#place += #value;)),
                };
                tasks.push(Task {
                    loops: part.loops.clone(),
                    value,
                    write,
                    fixed: false,
                });
            }
        }
        let writer = Writer::new(
            &self.system,
            &operations,
            self.scalar.clone(),
            &self.prefix,
            outside,
        );
        let statements = by(writer).write(&tasks);
        quote!(#views #least #clear #statements)
    }

    /// The expressions of the given values, after the statements that they need.
    fn values(&self, read: &[&str], values: &[Id], outside: TokenStream) -> TokenStream {
        let scalar = &self.scalar;
        let views = self.views(read, &[]);
        let least = self.least(&outside);
        let operations = Operations::new(&self.system.graph, values);
        let writer = Writer::new(
            &self.system,
            &operations,
            scalar.clone(),
            &self.prefix,
            outside,
        );
        let count = values.len();
        let names: Vec<Ident> = (1..=count).map(|k| format_ident!("result_{k}")).collect();
        let tasks = values.iter().zip(&names).map(|(&value, name)| {
            let name = name.clone();
            let write: Write = Box::new(move |value| quote!(let #name = #value;));
            Task {
                loops: Vec::new(),
                value: operations.of(value),
                write,
                fixed: false,
            }
        });
        let statements = writer.write(&tasks.collect::<Vec<_>>());
        quote!(#views #least #statements)
    }

    fn energy(&self, energy: Id) -> TokenStream {
        let outside = quote!(return ::core::option::Option::None;);
        let values = self.values(&["q", "p"], &[energy], outside);
        quote!(#values ::core::option::Option::Some(result_1))
    }

    /// That all of velocities and forces is inlined. The user's own functions may not be.
    fn inlined(&self) -> TokenStream {
        match self.system.functions.is_empty() {
            true => quote!(
                const INLINED: bool = true;
            ),
            false => TokenStream::new(),
        }
    }

    fn separable(&mut self, split: Split) -> TokenStream {
        let name = self.header.name.clone();
        let [generics, _, arguments] = self.generics();
        let (scalar, bound) = (self.scalar.clone(), self.bound.clone());
        let over = self.vector(&quote!(#scalar));
        let unit = (self.structure.kinetic == Kinetic::Unit).then(|| {
            quote!(
                const MASSES: ::symplectic::system::Masses = ::symplectic::system::Masses::Unit;
            )
        });
        let velocity = Derivative {
            into: "velocity",
            half: Half::P,
            of: split.kinetic,
            sign: 1,
        };
        let force = Derivative {
            into: "force",
            half: Half::Q,
            of: split.potential,
            sign: -1,
        };
        let (velocities, forces) = (self.gradients(&[velocity]), self.gradients(&[force]));
        let velocity = self.derivatives(&["p"], &velocities, &["velocity"]);
        let force = self.derivatives(&["q"], &forces, &["force"]);
        let force_gradient = self.system.force_gradient(self.structure);
        let force_gradient = force_gradient.map(|parts| [("gradient", parts)]);
        let Lanes { system, join } =
            self.separable_in_lanes(&unit, &velocities, &forces, &force_gradient);
        let force_gradient = force_gradient.map(|parts| {
            let statements = self.derivatives(&["q", "p"], &parts, &["gradient"]);
            self.force_gradient(&statements)
        });
        let energy = self.energy(self.system.energy);
        let jacobian = self.jacobian(Some(split));
        let inlined = self.inlined();
        let check_dimension = self.check_dimension();
        quote! {
            #[allow(unused_variables, non_snake_case, clippy::all)]
            impl #generics ::symplectic::SeparableHamiltonian for #name #arguments {
                type Vector<#scalar: #bound> = #over;

                #unit

                #inlined

                #join

                #[inline(always)]
                fn velocity<#scalar: #bound>(&self, time: #scalar, p: &#over, velocity: &mut #over) {
                    #velocity
                }

                #[inline(always)]
                fn force<#scalar: #bound>(&self, time: #scalar, q: &#over, force: &mut #over) {
                    #force
                }

                #force_gradient

                fn energy<#scalar: #bound>(&self, time: #scalar, q: &#over, p: &#over) -> ::core::option::Option<#scalar> {
                    #energy
                }

                #jacobian

                #check_dimension
            }

            #system
        }
    }

    /// The force gradient by these statements, in which the momenta are the components of the force.
    fn force_gradient(&self, statements: &TokenStream) -> TokenStream {
        let (scalar, bound) = (&self.scalar, &self.bound);
        let over = self.vector(&quote!(#scalar));
        quote! {
            const FORCE_GRADIENT: bool = true;

            #[inline(always)]
            fn force_gradient<#scalar: #bound>(&self, time: #scalar, q: &#over, force: &#over, gradient: &mut #over) {
                let p = force;
                #statements
            }
        }
    }

    /// H of any class, with constraints or friction if any; a separable H with its two parts.
    fn general(&mut self, split: Option<Split>) -> TokenStream {
        let name = self.header.name.clone();
        let [generics, _, arguments] = self.generics();
        let (scalar, bound) = (self.scalar.clone(), self.bound.clone());
        let over = self.vector(&quote!(#scalar));
        let energy = self.system.energy;
        let [kinetic, potential] =
            split.map_or([energy; 2], |split| [split.kinetic, split.potential]);
        let velocity = Derivative {
            into: "velocity",
            half: Half::P,
            of: kinetic,
            sign: 1,
        };
        let force = Derivative {
            into: "force",
            half: Half::Q,
            of: potential,
            sign: -1,
        };
        let applied = self.system.applied.clone();
        let forced = self.system.force_of_momenta().is_some();
        let class = if split.is_some() && !forced {
            quote!(::symplectic::Separable)
        } else {
            quote!(::symplectic::General)
        };
        let class = if !self.system.friction.is_empty() {
            quote!(::symplectic::friction::Damped)
        } else if !self.system.constraints.is_empty() {
            quote!(::symplectic::constraints::Constrained<#class>)
        } else if !self.system.nonholonomic.is_empty() {
            quote!(::symplectic::constraints::Nonholonomic<#class>)
        } else {
            class
        };
        let masses = match (split.is_some(), self.structure.kinetic == Kinetic::Unit) {
            (true, true) => quote!(
                const MASSES: ::symplectic::system::Masses = ::symplectic::system::Masses::Unit;
            ),
            // A separable class says so itself.
            (true, false) if forced => quote!(
                const MASSES: ::symplectic::system::Masses = ::symplectic::system::Masses::Constant;
            ),
            _ => TokenStream::new(),
        };
        let mut parts = self.gradients(&[velocity, force]);
        self.system.add_applied(&mut parts[1].1);
        let halves = ["q", "p"];
        // If velocity and force share nothing, they are computed one after the other.
        let both = (split.is_none() || forced).then(|| {
            let both = self.derivatives(&halves, &parts, &["velocity", "force"]);
            quote! {
                #[inline(always)]
                fn slopes<#scalar: #bound>(&self, time: #scalar, q: &#over, p: &#over, (velocity, force): (&mut #over, &mut #over)) {
                    #both
                }
            }
        });
        let velocity = self.derivatives(&halves, &parts, &["velocity"]);
        let force = self.derivatives(&halves, &parts, &["force"]);
        let Lanes { system, join } = self.general_in_lanes(&parts);
        let energy = self.energy(energy);
        // Newton's iteration is for systems without constraints.
        let jacobian = if self.system.is_constrained() || !self.system.friction.is_empty() {
            TokenStream::new()
        } else {
            self.jacobian(split)
        };
        let applied = (!applied.is_empty()).then(|| {
            let parts = [("applied", applied)];
            let statements = self.derivatives(&halves, &parts, &["applied"]);
            quote! {
                const FORCED: bool = true;

                fn applied_force<#scalar: #bound>(&self, time: #scalar, q: &#over, p: &#over, applied: &mut #over) {
                    #statements
                }
            }
        });
        let [in_addition, extra] = self.in_addition();
        let inlined = self.inlined();
        let check_dimension = self.check_dimension();
        quote! {
            #[allow(unused_variables, non_snake_case, clippy::all)]
            impl #generics ::symplectic::Hamiltonian for #name #arguments {
                type Class = #class;
                type Vector<#scalar: #bound> = #over;

                #masses

                #inlined

                #join

                #[inline(always)]
                fn velocity<#scalar: #bound>(&self, time: #scalar, q: &#over, p: &#over, velocity: &mut #over) {
                    #velocity
                }

                #[inline(always)]
                fn force<#scalar: #bound>(&self, time: #scalar, q: &#over, p: &#over, force: &mut #over) {
                    #force
                }

                #both

                fn energy<#scalar: #bound>(&self, time: #scalar, q: &#over, p: &#over) -> ::core::option::Option<#scalar> {
                    #energy
                }

                #applied

                #jacobian

                #check_dimension

                #extra
            }

            #in_addition

            #system
        }
    }
}
