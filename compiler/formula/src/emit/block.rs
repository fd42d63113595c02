//! Statements in loops, as Rust.

use std::collections::HashMap;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::names::{identifier, index_name, index_tokens, length_tokens, pair_name};
use crate::System;
use crate::graph::{Base, LoopId, LoopRange};
use crate::operations::{Op, Operations};
use crate::statements::{Goal, Statement, statements};
use crate::syntax::Length;

/// The statement that uses a value.
pub type Write = Box<dyn Fn(&TokenStream) -> TokenStream>;

/// A statement with a value in it, inside loops.
pub struct Task {
    /// The loops around the statement, outermost first.
    pub loops: Vec<LoopId>,
    /// The value.
    pub value: Op,
    /// The statement for the value.
    pub write: Write,
    /// Whether the value is an `f64` for every scalar type.
    pub fixed: bool,
}

/// An expression and its precedence.
#[derive(Clone)]
pub(super) struct Written {
    pub(super) tokens: TokenStream,
    pub(super) strength: Strength,
    /// Whether the value is an `f64` for every scalar type.
    pub(super) fixed: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Strength {
    Sum,
    Product,
    Sign,
    Atom,
}

/// The names of values.
pub(super) type Names = HashMap<Op, Written>;

/// A writer of statements, with the names of the generated code.
pub struct Writer<'a> {
    pub(super) system: &'a System,
    pub(super) operations: &'a Operations<'a>,
    /// The scalar.
    pub(super) scalar: Ident,
    /// Prefix of the names of values.
    pub(super) prefix: String,
    /// The code for a pair that is out of range.
    pub(super) outside: TokenStream,
    /// The argument that replaces every coordinate, in a function of one coordinate.
    pub(super) argument: Option<TokenStream>,
    /// Whether parameters have a value for each lane.
    pub(super) in_lanes: bool,
}

impl<'a> Writer<'a> {
    /// A writer for functions of a system.
    pub fn new(
        system: &'a System,
        operations: &'a Operations<'a>,
        scalar: Ident,
        prefix: &str,
        outside: TokenStream,
    ) -> Self {
        let prefix = prefix.to_owned();
        Writer {
            system,
            operations,
            scalar,
            prefix,
            outside,
            argument: None,
            in_lanes: false,
        }
    }

    /// The same writer for a system whose parameters have a value for each lane.
    pub(super) fn in_lanes(self) -> Self {
        Writer {
            in_lanes: true,
            ..self
        }
    }

    /// Whether a value is an `f64` for every scalar type.
    pub(super) fn is_fixed(&self, op: Op) -> bool {
        let depends = self.operations.depends(op);
        depends.is_fixed() && !(self.in_lanes && depends.parameter)
    }

    /// The statements of some tasks.
    pub fn write(&self, tasks: &[Task]) -> TokenStream {
        self.within(0, tasks)
    }

    /// The statements of a task with one coordinate, possibly in a loop.
    pub fn function(
        &mut self,
        task: Task,
        argument: TokenStream,
        over: Option<LoopId>,
    ) -> TokenStream {
        self.argument = Some(argument);
        self.within(over.map_or(0, |id| 1 << id.0), &[task])
    }

    /// The statements of some tasks, in the loops `bound`.
    fn within(&self, bound: u64, tasks: &[Task]) -> TokenStream {
        let goal = |task: &Task| Goal {
            loops: task.loops.clone(),
            value: task.value,
        };
        let goals: Vec<Goal> = tasks.iter().map(goal).collect();
        let statements = statements(self.operations, bound, &goals);
        self.block(&Names::new(), &statements, tasks)
    }

    pub(super) fn name(&self, number: usize) -> Ident {
        format_ident!("{}{number}", self.prefix)
    }

    fn block(&self, outer: &Names, statements: &[Statement], tasks: &[Task]) -> TokenStream {
        let mut names = outer.clone();
        let mut code = TokenStream::new();
        for statement in statements {
            code.extend(match statement {
                Statement::Name(op, number) => {
                    let Written { tokens, fixed, .. } = self.written(&names, *op);
                    let name = self.name(*number);
                    names.insert(*op, Written::name(&name, fixed));
                    quote!(let #name = #tokens;)
                }
                Statement::Turns(turns) => self.turns(&mut names, turns),
                Statement::Zero(op, number) => {
                    let name = self.name(*number);
                    let scalar = &self.scalar;
                    let fixed = self.is_fixed(*op);
                    names.insert(*op, Written::name(&name, fixed));
                    match fixed {
                        true => quote!(let mut #name = 0.0;),
                        false => quote!(let mut #name = #scalar::zero();),
                    }
                }
                Statement::Add(total, value) => {
                    let Written { tokens, fixed, .. } = self.written(&names, *total);
                    let value = self.value(&names, *value, fixed);
                    quote!(#tokens += #value;)
                }
                Statement::Loop(over, inner) => {
                    self.a_loop(*over, &self.block(&names, inner, tasks))
                }
                Statement::Reached(place, value) => {
                    let Task { write, fixed, .. } = &tasks[*place];
                    write(&self.value(&names, *value, *fixed))
                }
            });
        }
        code
    }

    /// A value, as a double or as the scalar.
    fn value(&self, names: &Names, op: Op, fixed: bool) -> TokenStream {
        let value = self.written(names, op);
        match fixed {
            true => value.tokens,
            false => self.free(value).tokens,
        }
    }

    fn a_loop(&self, over: LoopId, inner: &TokenStream) -> TokenStream {
        let index = index_name(over);
        match &self.system.graph.get_loop(over).range {
            LoopRange::Between(start, end) => {
                let start = index_tokens(start);
                let end = match (&end.base, end.offset) {
                    // The range is empty if the length is less than this.
                    (Base::End(length), ..0) => {
                        let length = length_tokens(length);
                        let less = Literal::usize_unsuffixed(end.offset.unsigned_abs() as usize);
                        quote!(#length.saturating_sub(#less))
                    }
                    _ => index_tokens(end),
                };
                quote!(for #index in #start..#end { #inner })
            }
            LoopRange::List(parameter) => {
                let list = identifier(&self.system.parameters[*parameter].name);
                let [first, second] = [0, 1].map(|slot| pair_name(over, slot));
                let count = match self.system.layout.length() {
                    Length::Fixed(n) => {
                        let n = Literal::usize_unsuffixed(n);
                        quote!(#n)
                    }
                    length => length_tokens(&length),
                };
                let outside = &self.outside;
                quote! {
                    for (#index, &(#first, #second)) in self.#list.iter().enumerate() {
                        if #first >= #count || #second >= #count { #outside }
                        #inner
                    }
                }
            }
        }
    }
}
