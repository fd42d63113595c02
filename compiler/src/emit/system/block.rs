//! Operations as statements of Rust, in loops.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use num_traits::Zero;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::operations::{Op, Operation, Operations};
use crate::arithmetic::rounding::to_f64;
use crate::emit::literal;
use crate::formula::function::Elementary;
use crate::formula::graph::{Base, Coordinate, Half, Index, LoopId, LoopRange};
use crate::formula::syntax::Length;
use crate::formula::{Layout, Shape, System};

/// What is done with a value.
pub type Statement = Box<dyn Fn(&TokenStream) -> TokenStream>;

/// A statement with a value in it, in some loops.
pub struct Task {
    /// The loops in which it stands, the outer ones first.
    pub loops: Vec<LoopId>,
    /// The value.
    pub value: Op,
    /// What is done with it.
    pub write: Statement,
    /// Whether a double is meant, whatever the scalar.
    pub fixed: bool,
}

/// An expression, and how strongly it holds together.
#[derive(Clone)]
struct Written {
    tokens: TokenStream,
    strength: Strength,
    /// Whether it is a double, whatever the scalar.
    fixed: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Strength {
    Sum,
    Product,
    Sign,
    Atom,
}

/// Names of the generated code.
pub struct Writer<'a> {
    system: &'a System,
    operations: &'a Operations<'a>,
    /// The scalar.
    scalar: Ident,
    /// What names of values begin with.
    prefix: String,
    /// How many names there are.
    names: usize,
    /// What is done where a pair is outside.
    outside: TokenStream,
    /// What every coordinate is, in a function of one.
    argument: Option<TokenStream>,
}

/// What is known in a block.
#[derive(Clone, Default)]
struct Scope {
    bound: u64,
    names: HashMap<Op, Written>,
}

/// The work of one block.
struct Block {
    scope: Scope,
    statements: TokenStream,
    /// How often results are used; those needed in inner blocks more than once.
    uses: HashMap<Op, usize>,
    /// Operations of this block.
    here: BTreeSet<Op>,
    /// When their totals are there.
    phases: HashMap<Op, usize>,
    /// Sines and cosines that are made together.
    angles: BTreeMap<(usize, usize), Vec<Op>>,
    turns: HashMap<Op, (usize, usize)>,
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

    /// The statements of a task in which there is one coordinate, in a loop perhaps.
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

    fn name(&mut self) -> Ident {
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
                // Before all loops: what is summed there is not read sooner.
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
                    // None are there, where there are none.
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
                let list = literal_name(&self.system.parameters[*parameter].name);
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

    /// The totals of a block one after the other, and its sines.
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

    /// The phase in which everything is there that an operation of an inner block needs from this one.
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

    /// The expression for an operation, after the statements that it needs.
    fn require(&mut self, block: &mut Block, op: Op) -> Written {
        if let Some(written) = block.scope.names.get(&op) {
            return written.clone();
        }
        if let Some(&turn) = block.turns.get(&op) {
            self.turns(block, turn);
            return block.scope.names[&op].clone();
        }
        // Long chains of operations are gone through from their beginning.
        self.prepare(block, op);
        let written = self.expression(block, op);
        let leaf = self.operations.get(op).is_leaf();
        let often = block.uses.get(&op).copied().unwrap_or(0) > 1;
        if leaf || !often {
            return written;
        }
        self.keep(block, op, written)
    }

    fn keep(&mut self, block: &mut Block, op: Op, written: Written) -> Written {
        let name = self.name();
        let Written { tokens, fixed, .. } = written;
        block.statements.extend(quote!(let #name = #tokens;));
        let written = Written {
            tokens: quote!(#name),
            strength: Strength::Atom,
            fixed,
        };
        block.scope.names.insert(op, written.clone());
        written
    }

    /// Writes what an operation is made of, if there is much of it.
    fn prepare(&mut self, block: &mut Block, op: Op) {
        let mut order = Vec::new();
        let mut open = vec![(op, 0_usize)];
        let mut seen = BTreeSet::new();
        let mut deep = false;
        while let Some((next, depth)) = open.pop() {
            if !seen.insert(next) || block.scope.names.contains_key(&next) {
                continue;
            }
            deep |= depth > MOST_DEPTH;
            order.push(next);
            open.extend(
                self.operations
                    .get(next)
                    .operands()
                    .into_iter()
                    .map(|operand| (operand, depth + 1)),
            );
        }
        if !deep {
            return;
        }
        order.sort();
        for (count, next) in order.into_iter().enumerate() {
            let is_wanted =
                next != op && block.here.contains(&next) && !self.operations.get(next).is_leaf();
            let often = block.uses.get(&next).copied().unwrap_or(0) > 1;
            if is_wanted
                && (often || count % MOST_DEPTH == 0)
                && !block.scope.names.contains_key(&next)
            {
                match block.turns.get(&next) {
                    Some(&turn) => self.turns(block, turn),
                    None => {
                        let written = self.expression(block, next);
                        self.keep(block, next, written);
                    }
                }
            }
        }
    }

    /// Sines and cosines of all angles of a turn.
    fn turns(&mut self, block: &mut Block, turn: (usize, usize)) {
        let angles = block.angles.get(&turn).cloned().unwrap_or_default();
        let mut names = Vec::new();
        let mut values = Vec::new();
        for angle in angles {
            let value = self.require(block, angle);
            values.push(self.free(value));
            let mut pair = Vec::new();
            for function in [Elementary::Sin, Elementary::Cos] {
                let found =
                    block.turns.keys().copied().find(|&op| {
                        *self.operations.get(op) == Operation::Elementary(function, angle)
                    });
                pair.push(found.map(|op| (op, self.name())));
            }
            names.push(pair);
        }
        let shown = |name: &Option<(Op, Ident)>| match name {
            Some((_, name)) => quote!(#name),
            None => quote!(_),
        };
        let pairs = names.iter().map(|pair| {
            let pair = pair.iter().map(shown);
            quote!((#(#pair),*))
        });
        let pairs: Vec<TokenStream> = pairs.collect();
        let statement = match (pairs.as_slice(), values.as_slice()) {
            ([pair], [value]) => {
                let receiver = atom(value);
                match names[0].as_slice() {
                    [Some((_, name)), None] => quote!(let #name = #receiver.sin();),
                    [None, Some((_, name))] => quote!(let #name = #receiver.cos();),
                    _ => quote!(let #pair = #receiver.sin_cos();),
                }
            }
            _ => {
                let scalar = &self.scalar;
                let values = values.iter().map(|value| &value.tokens);
                quote!(let [#(#pairs),*] = #scalar::sin_cos_all([#(#values),*]);)
            }
        };
        block.statements.extend(statement);
        for (op, name) in names.into_iter().flatten().flatten() {
            let written = Written {
                tokens: quote!(#name),
                strength: Strength::Atom,
                fixed: false,
            };
            block.scope.names.insert(op, written);
        }
    }

    /// A double as a number of the scalar.
    fn free(&self, written: Written) -> Written {
        if !written.fixed {
            return written;
        }
        let (scalar, tokens) = (&self.scalar, &written.tokens);
        let text = tokens.to_string();
        let tokens = match text.as_str() {
            "1.0" => quote!(#scalar::one()),
            "0.0" => quote!(#scalar::zero()),
            _ => quote!(#scalar::from_f64(#tokens)),
        };
        Written {
            tokens,
            strength: Strength::Atom,
            fixed: false,
        }
    }

    fn expression(&mut self, block: &mut Block, op: Op) -> Written {
        let fixed = self.operations.depends(op).is_fixed();
        let both = |this: &mut Self, block: &mut Block, a: Op, b: Op| {
            let sides = [a, b].map(|side| this.require(block, side));
            sides.map(|side| if fixed { side } else { this.free(side) })
        };
        let (tokens, strength) = match self.operations.get(op).clone() {
            Operation::Constant(value) => {
                let number = literal::double(to_f64(&value));
                let strength = if value < Zero::zero() {
                    Strength::Sign
                } else {
                    Strength::Atom
                };
                (number, strength)
            }
            Operation::Pi => (quote!(::core::f64::consts::PI), Strength::Atom),
            Operation::Time => (quote!(time), Strength::Atom),
            Operation::Parameter(parameter, indices) => {
                (self.parameter(parameter, &indices), Strength::Atom)
            }
            Operation::Coordinate(coordinate) => (self.coordinate(&coordinate), Strength::Atom),
            Operation::Negative(a) => {
                let a = self.require(block, a);
                let a = if fixed { a } else { self.free(a) };
                let a = at_least(&a, Strength::Product);
                (quote!(-#a), Strength::Sign)
            }
            Operation::Add(a, b) => {
                let [a, b] = both(self, block, a, b);
                let (a, b) = (a.tokens, at_least(&b, Strength::Product));
                (quote!(#a + #b), Strength::Sum)
            }
            Operation::Subtract(a, b) => {
                let [a, b] = both(self, block, a, b);
                let (a, b) = (a.tokens, at_least(&b, Strength::Product));
                (quote!(#a - #b), Strength::Sum)
            }
            Operation::Multiply(a, b) => {
                // A reciprocal that is used once is a division.
                let known = block.scope.names.contains_key(&b);
                let once = block.uses.get(&b).copied().unwrap_or(0) == 1;
                match *self.operations.get(b) {
                    Operation::Reciprocal(divisor) if once && !known && block.here.contains(&b) => {
                        let [a, b] = both(self, block, a, divisor);
                        let (a, b) = (
                            at_least(&a, Strength::Product),
                            at_least(&b, Strength::Sign),
                        );
                        (quote!(#a / #b), Strength::Product)
                    }
                    _ => {
                        let [a, b] = both(self, block, a, b);
                        let (a, b) = (
                            at_least(&a, Strength::Product),
                            at_least(&b, Strength::Sign),
                        );
                        (quote!(#a * #b), Strength::Product)
                    }
                }
            }
            Operation::Reciprocal(a) => {
                let a = self.require(block, a);
                match fixed {
                    true => {
                        let a = at_least(&a, Strength::Sign);
                        (quote!(1.0 / #a), Strength::Product)
                    }
                    false => {
                        let a = atom(&a);
                        (quote!(#a.recip()), Strength::Atom)
                    }
                }
            }
            Operation::Root(a) => self.call(block, a, "sqrt", fixed),
            Operation::Absolute(a) => self.call(block, a, "abs", fixed),
            Operation::Elementary(function, a) => self.call(block, a, function.name(), fixed),
            Operation::Atan2(a, b) => {
                let [y, x] = both(self, block, a, b);
                let (y, x) = (y.tokens, x.tokens);
                let scalar = if fixed {
                    quote!(::core::primitive::f64)
                } else {
                    let scalar = &self.scalar;
                    quote!(#scalar)
                };
                (
                    quote!(<#scalar as ::symplectic::Scalar>::atan2(#y, #x)),
                    Strength::Atom,
                )
            }
            Operation::User(function, derivative, a) => {
                let name = literal_name(&self.system.functions[function][derivative.min(2)]);
                let a = self.require(block, a).tokens;
                (quote!(#name(#a)), Strength::Atom)
            }
            // It has a name.
            Operation::Total(..) => (quote!(), Strength::Atom),
        };
        Written {
            tokens,
            strength,
            fixed,
        }
    }

    fn call(
        &mut self,
        block: &mut Block,
        a: Op,
        name: &str,
        fixed: bool,
    ) -> (TokenStream, Strength) {
        let a = self.require(block, a);
        let name = literal::identifier(name);
        let tokens = match fixed {
            true => {
                let a = a.tokens;
                quote!(::symplectic::Scalar::#name(#a))
            }
            false => {
                let a = atom(&self.free(a));
                quote!(#a.#name())
            }
        };
        (tokens, Strength::Atom)
    }

    fn parameter(&self, parameter: usize, indices: &[Index]) -> TokenStream {
        let parameter = &self.system.parameters[parameter];
        let name = literal_name(&parameter.name);
        let Shape::Array(lengths) = &parameter.shape else {
            return quote!(self.#name);
        };
        let checked = |length: &Length| matches!(length, Length::Runtime | Length::PairsOf(_));
        let indices: Vec<TokenStream> = indices.iter().map(index_tokens).collect();
        match (indices.as_slice(), lengths.iter().any(checked)) {
            ([i], false) => quote!(self.#name[#i]),
            ([i, j], false) => quote!(self.#name[#i][#j]),
            ([i], true) => quote!(self.#name.get(#i).copied().unwrap_or(f64::NAN)),
            ([i, j], true) => {
                quote!(self.#name.get(#i).and_then(|row| row.get(#j)).copied().unwrap_or(f64::NAN))
            }
            _ => quote!(self.#name),
        }
    }

    fn coordinate(&self, coordinate: &Coordinate) -> TokenStream {
        if let Some(argument) = &self.argument {
            return argument.clone();
        }
        let half = match coordinate.half {
            Half::Q => quote!(q),
            Half::P => quote!(p),
        };
        entry(&self.system.layout, &half, coordinate)
    }
}

/// Deepest nesting of an expression in the code.
const MOST_DEPTH: usize = 32;

/// An entry of a vector.
pub fn entry(layout: &Layout, vector: &TokenStream, coordinate: &Coordinate) -> TokenStream {
    let index = index_tokens(&coordinate.index);
    match layout {
        Layout::Numbered(_, Some(_)) => {
            let component = Literal::usize_unsuffixed(coordinate.component);
            quote!(#vector[#index][#component])
        }
        _ => quote!(#vector[#index]),
    }
}

fn at_least(written: &Written, strength: Strength) -> TokenStream {
    let tokens = &written.tokens;
    match written.strength >= strength {
        true => quote!(#tokens),
        false => quote!((#tokens)),
    }
}

fn atom(written: &Written) -> TokenStream {
    at_least(written, Strength::Atom)
}

/// A name of the user.
pub fn literal_name(name: &str) -> Ident {
    super::identifier(name)
}

/// The length of an array.
pub fn length_tokens(length: &Length) -> TokenStream {
    match length {
        Length::Fixed(n) => {
            let n = Literal::usize_unsuffixed(*n);
            quote!(#n)
        }
        Length::Generic(name) => {
            let name = literal_name(name);
            quote!(#name)
        }
        Length::Runtime | Length::PairsOf(_) => quote!(n),
    }
}

/// The index of a loop; of a list, the number of the pair.
fn index_name(id: LoopId) -> Ident {
    let letters = ["i", "j", "k", "l", "m"];
    match letters.get(id.0) {
        Some(letter) => format_ident!("{letter}"),
        None => format_ident!("i{}", id.0),
    }
}

fn pair_name(id: LoopId, slot: usize) -> Ident {
    format_ident!("{}_{}", index_name(id), ["first", "second"][slot])
}

/// An index.
pub fn index_tokens(index: &Index) -> TokenStream {
    let offset = Literal::usize_unsuffixed(index.offset.unsigned_abs() as usize);
    let base = match &index.base {
        Base::Start => return quote!(#offset),
        Base::End(length) => length_tokens(length),
        Base::Loop(id) => {
            let name = index_name(*id);
            quote!(#name)
        }
        Base::Pair(id, slot @ (0 | 1)) => {
            let name = pair_name(*id, *slot);
            quote!(#name)
        }
        Base::Pair(id, _) => {
            let name = index_name(*id);
            quote!(#name)
        }
    };
    match index.offset.signum() {
        0 => base,
        1 => quote!(#base + #offset),
        _ => quote!(#base - #offset),
    }
}
