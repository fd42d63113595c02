//! From a system that was read from a formula to Rust code.
//!
//! The type has a field for each parameter, and implements the trait of the class that was found: `SeparableHamiltonian`, `Hamiltonian`, or
//! the parts of a chain. The order of evaluation is that of [`operations`]; sums over indices are loops, so the code is as long for a
//! thousand bodies as for three.

mod block;
mod operations;

use num_traits::One;
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{format_ident, quote};

use self::block::{Statement, Task, Writer, entry, index_tokens, length_tokens};
use self::operations::Operations;
use super::Header;
use crate::arithmetic::rounding::to_f64;
use crate::emit::literal;
use crate::formula::derivative::{Scatter, gradient};
use crate::formula::description::{momenta, page};
use crate::formula::display::number_text;
use crate::formula::graph::{Coordinate, Half, Id, LoopId, Node, Number};
use crate::formula::structure::{ChainParts, Split, each_once};
use crate::formula::syntax::{Ends, Length};
use crate::formula::{Kinetic, Layout, Parameter, Shape, Structure, System};

/// The type of a system with everything that was derived from its formula.
pub fn system(system: &System, structure: &Structure, header: &Header) -> TokenStream {
    let emitter = Emitter::new(system, structure, header);
    emitter.code()
}

/// A name of the user as an identifier; raw where it is a word of Rust.
fn identifier(name: &str) -> Ident {
    const WORDS: [&str; 46] = [
        "as", "async", "await", "abstract", "become", "box", "break", "const", "continue", "do",
        "dyn", "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in",
        "let", "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref",
        "return", "static", "struct", "trait", "true", "try", "type", "typeof", "unsafe",
        "unsized", "use", "virtual", "where",
    ];
    match WORDS.contains(&name) || ["while", "yield"].contains(&name) {
        true => Ident::new_raw(name, Span::call_site()),
        false => Ident::new(name, Span::call_site()),
    }
}

struct Emitter<'a> {
    system: System,
    structure: &'a Structure,
    header: &'a Header,
    /// The scalar of generic functions.
    scalar: Ident,
    /// What names of values begin with.
    prefix: String,
}

/// A derivative, where it is written to, and its sign.
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
            prefix,
        }
    }

    fn code(mut self) -> TokenStream {
        let fields = self.fields();
        let dynamics = match (self.structure.chain, self.structure.split) {
            (Some(parts), _) => self.chain(&parts),
            (None, Ok(split)) => self.separable(split),
            (None, Err(_)) => self.general(),
        };
        let invariants = self.invariants();
        quote! {
            #fields
            const _: () = {
                #[allow(unused_imports, clippy::all)]
                use ::symplectic::emitted::{One as _, Scalar, Zero as _};

                #dynamics

                #invariants
            };
        }
    }

    /// The generics of the type as declared, with their kinds only, and as arguments.
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

    /// The type of a parameter.
    fn field(shape: &Shape) -> TokenStream {
        let vector = |item: TokenStream, length: &Length| match length {
            Length::Runtime | Length::PairsOf(_) => quote!(::symplectic::emitted::Vec<#item>),
            length => {
                let length = length_tokens(length);
                quote!([#item; #length])
            }
        };
        match shape {
            Shape::Number(_) => quote!(f64),
            Shape::Pairs => quote!(::symplectic::emitted::Vec<(usize, usize)>),
            Shape::Array(lengths) => lengths.iter().rev().fold(quote!(f64), vector),
        }
    }

    /// The type, what makes one, and the default.
    fn fields(&self) -> TokenStream {
        let Header {
            attributes,
            visibility,
            name,
        } = self.header;
        let [generics, _, arguments] = self.generics();
        let documentation = page(&self.system, self.structure);
        if self.system.parameters.is_empty() {
            return quote! {
                #attributes
                #[doc = #documentation]
                #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
                #visibility struct #name #generics;
            };
        }
        let mut fields = Vec::new();
        let (mut names, mut values, mut inputs) = (Vec::new(), Vec::new(), Vec::new());
        let mut all_copy = true;
        for parameter in &self.system.parameters {
            let field = identifier(&parameter.name);
            let kind = Self::field(&parameter.shape);
            let what = match &parameter.shape {
                Shape::Number(Some(value)) => format!(
                    " The parameter `{}`, {} unless it is set.",
                    parameter.name,
                    number_text(value)
                ),
                _ => format!(" The parameter `{}`.", parameter.name),
            };
            fields.push(quote!(#[doc = #what] pub #field: #kind));
            all_copy &= !kind.to_string().contains("Vec");
            match &parameter.shape {
                Shape::Number(Some(value)) => {
                    let value = literal::double(to_f64(value));
                    values.push(quote!(#field: #value));
                }
                _ => {
                    inputs.push(quote!(#field: #kind));
                    values.push(quote!(#field));
                }
            }
            names.push(field);
        }
        let copy = all_copy.then(|| quote!(Copy,));
        let default = inputs.is_empty().then(|| {
            quote! {
                impl #generics ::core::default::Default for #name #arguments {
                    fn default() -> Self {
                        Self::new()
                    }
                }
            }
        });
        quote! {
            #attributes
            #[doc = #documentation]
            #[allow(non_snake_case)]
            #[derive(Clone, #copy Debug, PartialEq)]
            #visibility struct #name #generics {
                #(#fields),*
            }

            impl #generics #name #arguments {
                /// The system with these parameters, and the values of the definition for the others.
                #[allow(non_snake_case, clippy::too_many_arguments)]
                pub const fn new(#(#inputs),*) -> Self {
                    Self { #(#values),* }
                }
            }

            #default
        }
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

    /// Names for the entries of the vectors of a function, and how many there are.
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

    /// What is done where there are too few coordinates, or a pair is outside: the results are no numbers, which an integrator reports.
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

    /// The check that there are as many coordinates as the formula names.
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

    /// The statements that write derivatives.
    fn derivatives(&mut self, read: &[&str], derivatives: &[Derivative]) -> TokenStream {
        let written: Vec<&str> = derivatives
            .iter()
            .map(|derivative| derivative.into)
            .collect();
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
        let views = self.views(read, &written);
        let outside = self.outside(&written);
        let least = self.least(&outside);
        let roots: Vec<Id> = parts
            .iter()
            .flat_map(|(_, parts)| parts.iter().map(|part| part.value))
            .collect();
        let operations = Operations::new(&self.system.graph, &roots);
        let mut clear = TokenStream::new();
        let mut tasks = Vec::new();
        for (into, parts) in &parts {
            let vector = format_ident!("{into}");
            let vector = quote!(#vector);
            // What is set once needs no zero before it.
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
                let write: Statement = match once {
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
        let mut writer = Writer::new(
            &self.system,
            &operations,
            self.scalar.clone(),
            &self.prefix,
            outside,
        );
        let statements = writer.write(tasks);
        quote!(#views #least #clear #statements)
    }

    /// The expressions of some values, after the statements that they need.
    fn values(&self, read: &[&str], values: &[Id], outside: TokenStream) -> TokenStream {
        let scalar = &self.scalar;
        let views = self.views(read, &[]);
        let least = self.least(&outside);
        let operations = Operations::new(&self.system.graph, values);
        let mut writer = Writer::new(
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
            let write: Statement = Box::new(move |value| quote!(let #name = #value;));
            Task {
                loops: Vec::new(),
                value: operations.of(value),
                write,
                fixed: false,
            }
        });
        let statements = writer.write(tasks.collect());
        quote!(#views #least #statements)
    }

    fn energy(&self, energy: Id) -> TokenStream {
        let outside = quote!(return ::core::option::Option::None;);
        let values = self.values(&["q", "p"], &[energy], outside);
        quote!(#values ::core::option::Option::Some(result_1))
    }

    fn separable(&mut self, split: Split) -> TokenStream {
        let name = self.header.name.clone();
        let [generics, _, arguments] = self.generics();
        let scalar = self.scalar.clone();
        let over = self.vector(&quote!(#scalar));
        let unit = (self.structure.kinetic == Kinetic::Unit).then(|| {
            quote!(
                const UNIT_MASSES: bool = true;
            )
        });
        let velocity = Derivative {
            into: "velocity",
            half: Half::P,
            of: split.kinetic,
            sign: 1,
        };
        let velocity = self.derivatives(&["p"], &[velocity]);
        let force = Derivative {
            into: "force",
            half: Half::Q,
            of: split.potential,
            sign: -1,
        };
        let force = self.derivatives(&["q"], &[force]);
        let energy = self.energy(self.system.energy);
        let jacobian = self.jacobian(Some(split));
        quote! {
            #[allow(unused_variables, non_snake_case, clippy::all)]
            impl #generics ::symplectic::SeparableHamiltonian for #name #arguments {
                type Vector<#scalar: Scalar> = #over;

                #unit

                #[inline(always)]
                fn velocity<#scalar: Scalar>(&self, time: #scalar, p: &#over, velocity: &mut #over) {
                    #velocity
                }

                #[inline(always)]
                fn force<#scalar: Scalar>(&self, time: #scalar, q: &#over, force: &mut #over) {
                    #force
                }

                fn energy<#scalar: Scalar>(&self, time: #scalar, q: &#over, p: &#over) -> ::core::option::Option<#scalar> {
                    #energy
                }
            }

            #jacobian
        }
    }

    fn general(&mut self) -> TokenStream {
        let name = self.header.name.clone();
        let [generics, _, arguments] = self.generics();
        let scalar = self.scalar.clone();
        let over = self.vector(&quote!(#scalar));
        let of = self.system.energy;
        let velocity = || Derivative {
            into: "velocity",
            half: Half::P,
            of,
            sign: 1,
        };
        let force = || Derivative {
            into: "force",
            half: Half::Q,
            of,
            sign: -1,
        };
        let both = self.derivatives(&["q", "p"], &[velocity(), force()]);
        let velocity = self.derivatives(&["q", "p"], &[velocity()]);
        let force = self.derivatives(&["q", "p"], &[force()]);
        let energy = self.energy(of);
        let jacobian = self.jacobian(None);
        quote! {
            #[allow(unused_variables, non_snake_case, clippy::all)]
            impl #generics ::symplectic::Hamiltonian for #name #arguments {
                type Class = ::symplectic::General;
                type Vector<#scalar: Scalar> = #over;

                #[inline(always)]
                fn velocity<#scalar: Scalar>(&self, time: #scalar, q: &#over, p: &#over, velocity: &mut #over) {
                    #velocity
                }

                #[inline(always)]
                fn force<#scalar: Scalar>(&self, time: #scalar, q: &#over, p: &#over, force: &mut #over) {
                    #force
                }

                #[inline(always)]
                fn slopes<#scalar: Scalar>(&self, time: #scalar, q: &#over, p: &#over, (velocity, force): (&mut #over, &mut #over)) {
                    #both
                }

                fn energy<#scalar: Scalar>(&self, time: #scalar, q: &#over, p: &#over) -> ::core::option::Option<#scalar> {
                    #energy
                }
            }

            #jacobian
        }
    }

    /// The second derivatives, for Newton's iteration.
    fn jacobian(&mut self, split: Option<Split>) -> TokenStream {
        let name = self.header.name.clone();
        let [_, parameters, arguments] = self.generics();
        let scalar = self.scalar.clone();
        let over = self.vector(&quote!(#scalar));
        let energy = self.system.energy;
        // The matrix, H or its part, the sign, the half of the row and that of the column.
        let blocks = match split {
            Some(split) => vec![
                ("velocity_by_momentum", split.kinetic, 1, Half::P, Half::P),
                ("force_by_position", split.potential, -1, Half::Q, Half::Q),
            ],
            None => vec![
                ("velocity_by_momentum", energy, 1, Half::P, Half::P),
                ("velocity_by_position", energy, 1, Half::P, Half::Q),
                ("force_by_position", energy, -1, Half::Q, Half::Q),
            ],
        };
        let mut parts: Vec<(&str, Coordinate, Scatter)> = Vec::new();
        for (matrix, of, sign, row, column) in blocks {
            let sign = Number::from_integer(sign.into());
            for first in gradient(&mut self.system.graph, of, &[], sign, row) {
                let loops: Vec<LoopId> = first.loops.clone();
                for second in gradient(
                    &mut self.system.graph,
                    first.value,
                    &loops,
                    Number::one(),
                    column,
                ) {
                    parts.push((matrix, first.target.clone(), second));
                }
            }
        }
        let third = |id: &Id| {
            let nodes = self.system.graph.below([*id]);
            nodes
                .iter()
                .any(|&id| matches!(self.system.graph.node(id), Node::User(_, 3.., _)))
        };
        if self.system.graph.is_full() || parts.iter().any(|(_, _, part)| third(&part.value)) {
            return TokenStream::new();
        }
        let roots: Vec<Id> = parts.iter().map(|(_, _, part)| part.value).collect();
        let operations = Operations::new(&self.system.graph, &roots);
        let views = self.views(&["q", "p"], &[]);
        let nan =
            quote!(jacobian.force_by_position.set(0, 0, #scalar::from_f64(f64::NAN)); return;);
        let least = self.least(&nan);
        let tasks = parts.iter().map(|(matrix, row, part)| {
            let matrix = format_ident!("{matrix}");
            let [row, column] = [row, &part.target].map(|place| self.place(place));
            let write: Statement =
                Box::new(move |value| quote!(jacobian.#matrix.add(#row, #column, #value);));
            Task {
                loops: part.loops.clone(),
                value: operations.of(part.value),
                write,
                fixed: false,
            }
        });
        let mut writer = Writer::new(&self.system, &operations, scalar.clone(), &self.prefix, nan);
        let statements = writer.write(tasks.collect());
        quote! {
            ::symplectic::emitted::if_alloc! {
                #[allow(unused_variables, non_snake_case, clippy::all)]
                impl<#scalar: Scalar, #parameters> ::symplectic::solver::Linearized<#over> for #name #arguments {
                    fn derivatives(&self, time: #scalar, q: &#over, p: &#over, jacobian: &mut ::symplectic::solver::Jacobian<#scalar>) {
                        #views #least #statements
                    }
                }
            }
        }
    }

    /// The number of a component among all.
    fn place(&self, coordinate: &Coordinate) -> TokenStream {
        let index = index_tokens(&coordinate.index);
        match self.system.layout {
            Layout::Numbered(_, Some(components)) => {
                let component = Literal::usize_unsuffixed(coordinate.component);
                let components = Literal::usize_unsuffixed(components);
                let index = match coordinate.index.offset {
                    0 => index,
                    _ => quote!((#index)),
                };
                quote!(#index * #components + #component)
            }
            _ => index,
        }
    }

    /// A chain: what the runtime asks of its bonds.
    fn chain(&mut self, parts: &ChainParts) -> TokenStream {
        let name = self.header.name.clone();
        let [generics, parameters, arguments] = self.generics();
        let scalar = self.scalar.clone();
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
        let outer = parts.on_site.map(|(energy, over)| {
            let minus = -Number::one();
            let parts = gradient(&mut self.system.graph, energy, &[over], minus, Half::Q);
            let force = parts.first().map(|part| part.value);
            (energy, force, over)
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
            let write: Statement = Box::new(|value| quote!(let value = #value;));
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
        let outer = outer.map(|(energy, force, over)| {
            let energy = function(self, &site, energy, Some(over));
            let force = match force {
                Some(force) => function(self, &site, force, Some(over)),
                None => quote!(#scalar::zero()),
            };
            quote! {
                #[inline(always)]
                fn outer_force<#scalar: Scalar>(&self, time: #scalar, position: #scalar) -> ::core::option::Option<#scalar> {
                    ::core::option::Option::Some({ #force })
                }

                fn outer_energy<#scalar: Scalar>(&self, time: #scalar, position: #scalar) -> ::core::option::Option<#scalar> {
                    ::core::option::Option::Some({ #energy })
                }
            }
        });
        quote! {
            #[allow(unused_variables, non_snake_case, clippy::all)]
            impl #generics ::symplectic::system::Bonds for #name #arguments {
                #[inline(always)]
                fn tension<#scalar: Scalar>(&self, time: #scalar, stretch: #scalar) -> #scalar {
                    #tension
                }

                fn bond_energy<#scalar: Scalar>(&self, time: #scalar, stretch: #scalar) -> ::core::option::Option<#scalar> {
                    ::core::option::Option::Some({ #bond_energy })
                }

                #outer
            }

            ::symplectic::emitted::chain_system!((#parameters) (#name #arguments), #bonds, #ends);
        }
    }

    /// Functions for what is conserved.
    fn invariants(&mut self) -> TokenStream {
        let mut code = TokenStream::new();
        for invariant in self.system.invariants.clone() {
            let what = format!(" `{}`, which the exact flow conserves.", invariant.name);
            code.extend(self.function(&invariant.name, &what, &invariant.parts, invariant.scalar));
        }
        let own = |name: &str| {
            self.system
                .invariants
                .iter()
                .any(|invariant| invariant.name == name)
                || self
                    .system
                    .parameters
                    .iter()
                    .any(|parameter| parameter.name == name)
        };
        let found = momenta(&self.system, self.structure);
        let found: Vec<_> = found.into_iter().filter(|(name, _)| !own(name)).collect();
        for (name, kind) in found {
            let parts = kind.parts(&mut self.system);
            let what = format!(
                " The {}, which the exact flow conserves: H has the symmetry.",
                name.replace('_', " ")
            );
            let known = self
                .system
                .invariants
                .iter()
                .any(|invariant| invariant.parts == parts);
            if !known {
                code.extend(self.function(name, &what, &parts, parts.len() == 1));
            }
        }
        if code.is_empty() {
            return code;
        }
        let [generics, _, arguments] = self.generics();
        let name = &self.header.name;
        quote! {
            #[allow(unused_variables, non_snake_case, clippy::all)]
            impl #generics #name #arguments {
                #code
            }
        }
    }

    fn function(&self, name: &str, what: &str, parts: &[Id], alone: bool) -> TokenStream {
        let name = identifier(name);
        let scalar = &self.scalar;
        let over = self.vector(&quote!(#scalar));
        let nan = vec![quote!(#scalar::from_f64(f64::NAN)); parts.len()];
        let outside = match alone {
            true => quote!(return #(#nan)*;),
            false => quote!(return [#(#nan),*];),
        };
        let values = self.values(&["q", "p"], parts, outside);
        let (result, finish) = match alone {
            true => (quote!(#scalar), quote!(result_1)),
            false => {
                let count = Literal::usize_unsuffixed(parts.len());
                let names = (1..=parts.len()).map(|k| format_ident!("result_{k}"));
                (quote!([#scalar; #count]), quote!([#(#names),*]))
            }
        };
        quote! {
            #[doc = #what]
            pub fn #name<#scalar: Scalar>(&self, q: &#over, p: &#over) -> #result {
                #values
                #finish
            }
        }
    }
}
