//! Operations as Rust statements, in loops.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::names::{identifier, index_name, index_tokens, length_tokens, pair_name};
use crate::formula::System;
use crate::formula::function::Elementary;
use crate::formula::graph::{Base, LoopId, LoopRange};
use crate::formula::operations::{Op, Operation, Operations};
use crate::formula::syntax::Length;

/// A statement that uses a value.
pub type Statement = Box<dyn Fn(&TokenStream) -> TokenStream>;

/// A statement with a value in it, inside loops.
pub struct Task {
    /// The loops around the statement, outermost first.
    pub loops: Vec<LoopId>,
    /// The value.
    pub value: Op,
    /// The statement for the value.
    pub write: Statement,
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

/// A writer of statements, with the names of the generated code.
pub struct Writer<'a> {
    pub(super) system: &'a System,
    pub(super) operations: &'a Operations<'a>,
    /// The scalar.
    pub(super) scalar: Ident,
    /// Prefix of the names of values.
    pub(super) prefix: String,
    /// Number of names so far.
    pub(super) names: usize,
    /// The code for a pair that is out of range.
    pub(super) outside: TokenStream,
    /// The argument that stands for every coordinate, in a function of one coordinate.
    pub(super) argument: Option<TokenStream>,
}

/// The names known in a block.
#[derive(Clone, Default)]
pub(super) struct Scope {
    pub(super) bound: u64,
    pub(super) names: HashMap<Op, Written>,
}

/// The work of one block: its operations and statements.
pub(super) struct Block {
    pub(super) scope: Scope,
    pub(super) statements: TokenStream,
    /// How often each result is used; a result needed in inner blocks counts more than once.
    pub(super) uses: HashMap<Op, usize>,
    /// Operations of this block.
    pub(super) here: BTreeSet<Op>,
    /// The phase at which the totals of each operation are available.
    pub(super) phases: HashMap<Op, usize>,
    /// Sines and cosines that are computed together.
    pub(super) angles: BTreeMap<(usize, usize), Vec<Op>>,
    pub(super) turns: HashMap<Op, (usize, usize)>,
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
            names: 0,
            outside,
            argument: None,
        }
    }

    /// The statements of some tasks.
    pub fn write(&mut self, tasks: Vec<Task>) -> TokenStream {
        self.block(&Scope::default(), tasks)
    }

    /// The statements of a task with one coordinate, possibly in a loop.
    pub fn function(
        &mut self,
        task: Task,
        argument: TokenStream,
        over: Option<LoopId>,
    ) -> TokenStream {
        self.argument = Some(argument);
        let bound = over.map_or(0, |id| 1 << id.0);
        self.block(
            &Scope {
                bound,
                ..Scope::default()
            },
            vec![task],
        )
    }

    pub(super) fn name(&mut self) -> Ident {
        self.names += 1;
        format_ident!("{}{}", self.prefix, self.names)
    }

    fn block(&mut self, outer: &Scope, tasks: Vec<Task>) -> TokenStream {
        let mut block = Block {
            scope: outer.clone(),
            statements: TokenStream::new(),
            uses: HashMap::new(),
            here: BTreeSet::new(),
            phases: HashMap::new(),
            angles: BTreeMap::new(),
            turns: HashMap::new(),
        };
        self.collect(&mut block, &tasks);
        self.order(&mut block);
        let (direct, inner): (Vec<Task>, Vec<Task>) =
            tasks.into_iter().partition(|task| task.loops.is_empty());
        let mut rounds: BTreeMap<(usize, LoopId), Vec<Task>> = BTreeMap::new();
        let totals: Vec<Op> = block.here.iter().copied().collect();
        for op in totals {
            if let Operation::Total(over, body) = *self.operations.get(op) {
                let name = self.name();
                let scalar = &self.scalar;
                let fixed = self.operations.depends(op).is_fixed();
                let zero = if fixed {
                    quote!(0.0)
                } else {
                    quote!(#scalar::zero())
                };
                // Before all loops: the sum is read only after its loop.
                block.statements.extend(quote!(let mut #name = #zero;));
                let phase = block.phases[&op] - 1;
                let sum = name.clone();
                let write: Statement = Box::new(move |value| quote!(#sum += #value;));
                let task = Task {
                    loops: vec![over],
                    value: body,
                    write,
                    fixed,
                };
                rounds.entry((phase, over)).or_default().push(task);
                let written = Written {
                    tokens: quote!(#name),
                    strength: Strength::Atom,
                    fixed,
                };
                block.scope.names.insert(op, written);
            }
        }
        for task in inner {
            let phase = self.phase_below(&block, task.value);
            rounds.entry((phase, task.loops[0])).or_default().push(task);
        }
        for ((_, over), tasks) in rounds {
            for task in &tasks {
                self.hoist(&mut block, task.value);
            }
            let loops = self.a_loop(&block, over, tasks);
            block.statements.extend(loops);
        }
        for task in direct {
            let value = self.require(&mut block, task.value);
            let value = if task.fixed { value } else { self.free(value) }.tokens;
            block.statements.extend((task.write)(&value));
        }
        block.statements
    }

    fn a_loop(&mut self, block: &Block, over: LoopId, tasks: Vec<Task>) -> TokenStream {
        let mut scope = block.scope.clone();
        scope.bound |= 1 << over.0;
        let tasks = tasks.into_iter().map(|mut task| {
            task.loops.remove(0);
            task
        });
        let inner = self.block(&scope, tasks.collect());
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

    /// Whether an operation can be computed in a block.
    fn is_in(&self, block: &Block, op: Op) -> bool {
        self.operations.depends(op).loops & !block.scope.bound == 0
    }

    /// Finds what is computed in a block, and how often it is used.
    fn collect(&self, block: &mut Block, tasks: &[Task]) {
        let mut seen = BTreeSet::new();
        // Operations, and whether they are needed in an inner block.
        let mut open: Vec<(Op, bool)> = tasks
            .iter()
            .map(|task| (task.value, !task.loops.is_empty()))
            .collect();
        while let Some((op, inside)) = open.pop() {
            if block.scope.names.contains_key(&op) {
                continue;
            }
            let here = self.is_in(block, op);
            let operation = self.operations.get(op);
            if here {
                *block.uses.entry(op).or_insert(0) += 1 + usize::from(inside);
            }
            if !seen.insert(op) || operation.is_leaf() {
                continue;
            }
            if here {
                block.here.insert(op);
            }
            let deeper = !here || matches!(operation, Operation::Total(..));
            open.extend(
                operation
                    .operands()
                    .into_iter()
                    .map(|operand| (operand, deeper)),
            );
        }
    }

    /// Orders the totals of a block, and its sines.
    fn order(&self, block: &mut Block) {
        let here: Vec<Op> = block.here.iter().copied().collect();
        let mut levels: HashMap<Op, usize> = HashMap::new();
        for op in here {
            let operation = self.operations.get(op);
            let phase = match operation {
                Operation::Total(_, body) => 1 + self.phase_below(block, *body),
                _ => operation
                    .operands()
                    .iter()
                    .map(|op| block.phases.get(op).copied().unwrap_or(0))
                    .max()
                    .unwrap_or(0),
            };
            block.phases.insert(op, phase);
            let below = operation
                .operands()
                .iter()
                .map(|op| levels.get(op).copied().unwrap_or(0))
                .max()
                .unwrap_or(0);
            let fixed = self.operations.depends(op).is_fixed();
            let level = match operation {
                Operation::Elementary(Elementary::Sin | Elementary::Cos, angle) if !fixed => {
                    let group = block.angles.entry((phase, below)).or_default();
                    if !group.contains(angle) {
                        group.push(*angle);
                    }
                    block.turns.insert(op, (phase, below));
                    below + 1
                }
                _ => below,
            };
            levels.insert(op, level);
        }
    }

    /// The phase after which everything is available that an operation of an inner block needs from this block.
    fn phase_below(&self, block: &Block, op: Op) -> usize {
        let mut seen = BTreeSet::new();
        let mut open = vec![op];
        let mut phase = 0;
        while let Some(op) = open.pop() {
            if !seen.insert(op) {
                continue;
            }
            match block.phases.get(&op) {
                Some(&known) if block.here.contains(&op) => phase = phase.max(known),
                _ => open.extend(self.operations.get(op).operands()),
            }
        }
        phase
    }

    /// Computes what an inner block needs from this one.
    fn hoist(&mut self, block: &mut Block, op: Op) {
        let mut seen = BTreeSet::new();
        let mut open = vec![op];
        let mut needed = BTreeSet::new();
        while let Some(op) = open.pop() {
            if !seen.insert(op) || block.scope.names.contains_key(&op) {
                continue;
            }
            match block.here.contains(&op) {
                true => {
                    needed.insert(op);
                }
                false => open.extend(self.operations.get(op).operands()),
            }
        }
        for op in needed {
            self.require(block, op);
        }
    }
}
