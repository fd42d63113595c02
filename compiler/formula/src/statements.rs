//! Operations as statements in loops: which values get names, in which order, and what is computed outside of which loop.
//!
//! All languages write the same statements, so they round alike.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use super::function::Elementary;
use super::graph::LoopId;
use super::operations::{Op, Operation, Operations};

/// A value that is wanted.
#[derive(Debug, Clone)]
pub struct Goal {
    /// The loops around it, outermost first.
    pub loops: Vec<LoopId>,
    /// The value.
    pub value: Op,
}

/// A statement. Named values have numbers from 1; an operation is written from its operands, down to those that have a name.
#[derive(Debug, Clone, PartialEq)]
pub enum Statement {
    /// An operation gets a name.
    Name(Op, usize),
    /// Sines and cosines of some angles, which are computed together.
    Turns(Vec<Turn>),
    /// A total gets a name, and begins with zero.
    Zero(Op, usize),
    /// To a total a value is added.
    Add(Op, Op),
    /// These statements for every index of a loop.
    Loop(LoopId, Vec<Statement>),
    /// The value of a goal, by its place in the list, is known.
    Reached(usize, Op),
}

/// The sine and the cosine of an angle, each with its number where it is needed.
#[derive(Debug, Clone, PartialEq)]
pub struct Turn {
    /// The angle.
    pub angle: Op,
    /// Its sine and its cosine.
    pub values: [Option<(Op, usize)>; 2],
}

/// The statements that reach some goals; the indices of the loops `bound`, as bits, are known.
pub fn statements(operations: &Operations<'_>, bound: u64, goals: &[Goal]) -> Vec<Statement> {
    let scope = Scope {
        bound,
        named: HashSet::new(),
    };
    let goals = goals.iter().enumerate().map(|(place, goal)| Task {
        goal: goal.clone(),
        purpose: Purpose::Reach(place),
    });
    let mut plan = Plan {
        operations,
        names: 0,
    };
    plan.block(&scope, goals.collect())
}

/// A goal, and the use of its value.
struct Task {
    goal: Goal,
    purpose: Purpose,
}

#[derive(Clone, Copy)]
enum Purpose {
    Reach(usize),
    AddTo(Op),
}

struct Plan<'a> {
    operations: &'a Operations<'a>,
    /// Number of names so far.
    names: usize,
}

/// What is known in a block.
#[derive(Clone)]
struct Scope {
    bound: u64,
    named: HashSet<Op>,
}

/// The work of one block: its operations and statements.
struct Block {
    scope: Scope,
    statements: Vec<Statement>,
    /// How often each result is used; a result needed in inner blocks counts more than once.
    uses: HashMap<Op, usize>,
    /// Operations of this block.
    here: BTreeSet<Op>,
    /// The phase at which the totals of each operation are available.
    phases: HashMap<Op, usize>,
    /// Sines and cosines that are computed together.
    angles: BTreeMap<(usize, usize), Vec<Op>>,
    turns: HashMap<Op, (usize, usize)>,
}

/// Greatest nesting depth of an expression in the code.
const MAX_DEPTH: usize = 32;

impl Plan<'_> {
    fn name(&mut self) -> usize {
        self.names += 1;
        self.names
    }

    fn block(&mut self, outer: &Scope, tasks: Vec<Task>) -> Vec<Statement> {
        let mut block = Block {
            scope: outer.clone(),
            statements: Vec::new(),
            uses: HashMap::new(),
            here: BTreeSet::new(),
            phases: HashMap::new(),
            angles: BTreeMap::new(),
            turns: HashMap::new(),
        };
        self.collect(&mut block, &tasks);
        self.order(&mut block);
        let (direct, inner): (Vec<Task>, Vec<Task>) = tasks
            .into_iter()
            .partition(|task| task.goal.loops.is_empty());
        let mut rounds: BTreeMap<(usize, LoopId), Vec<Task>> = BTreeMap::new();
        let totals: Vec<Op> = block.here.iter().copied().collect();
        for op in totals {
            if let Operation::Total(over, body) = *self.operations.get(op) {
                // Before all loops: the sum is read only after its loop.
                let name = self.name();
                block.statements.push(Statement::Zero(op, name));
                let phase = block.phases[&op] - 1;
                let task = Task {
                    goal: Goal {
                        loops: vec![over],
                        value: body,
                    },
                    purpose: Purpose::AddTo(op),
                };
                rounds.entry((phase, over)).or_default().push(task);
                block.scope.named.insert(op);
            }
        }
        for task in inner {
            let phase = self.phase_below(&block, task.goal.value);
            let over = task.goal.loops[0];
            rounds.entry((phase, over)).or_default().push(task);
        }
        for ((_, over), mut tasks) in rounds {
            for task in &mut tasks {
                self.hoist(&mut block, task.goal.value);
                task.goal.loops.remove(0);
            }
            let mut scope = block.scope.clone();
            scope.bound |= 1 << over.0;
            let inner = self.block(&scope, tasks);
            block.statements.push(Statement::Loop(over, inner));
        }
        for Task { goal, purpose } in direct {
            self.require(&mut block, goal.value);
            block.statements.push(match purpose {
                Purpose::Reach(place) => Statement::Reached(place, goal.value),
                Purpose::AddTo(total) => Statement::Add(total, goal.value),
            });
        }
        block.statements
    }

    /// Whether an operation can be computed in a block.
    fn is_in(&self, block: &Block, op: Op) -> bool {
        self.operations.depends(op).loops & !block.scope.bound == 0
    }

    /// Finds the operations computed in a block, and how often each is used.
    fn collect(&self, block: &mut Block, tasks: &[Task]) {
        let mut seen = BTreeSet::new();
        // Operations, and whether they are needed in an inner block.
        let mut open: Vec<(Op, bool)> = tasks
            .iter()
            .map(|task| (task.goal.value, !task.goal.loops.is_empty()))
            .collect();
        while let Some((op, inside)) = open.pop() {
            if block.scope.named.contains(&op) {
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
            if !seen.insert(op) || block.scope.named.contains(&op) {
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

    /// The statements that an operation needs before it can be written; it gets a name if it is used more than once.
    fn require(&mut self, block: &mut Block, op: Op) {
        if block.scope.named.contains(&op) {
            return;
        }
        if let Some(&turn) = block.turns.get(&op) {
            return self.turns(block, turn);
        }
        // Long chains of operations are written from their beginning.
        self.prepare(block, op);
        self.require_operands(block, op);
        let leaf = self.operations.get(op).is_leaf();
        let often = block.uses.get(&op).copied().unwrap_or(0) > 1;
        if !leaf && often {
            self.keep(block, op);
        }
    }

    fn require_operands(&mut self, block: &mut Block, op: Op) {
        // A total has a name already.
        if matches!(self.operations.get(op), Operation::Total(..)) {
            return;
        }
        for operand in self.operations.written_operands(op) {
            self.require(block, operand);
        }
    }

    fn keep(&mut self, block: &mut Block, op: Op) {
        let name = self.name();
        block.statements.push(Statement::Name(op, name));
        block.scope.named.insert(op);
    }

    /// Names parts of a deeply nested operation, so that no expression in the code is too deep.
    fn prepare(&mut self, block: &mut Block, op: Op) {
        let mut order = Vec::new();
        let mut open = vec![(op, 0_usize)];
        let mut seen = BTreeSet::new();
        let mut deep = false;
        while let Some((next, depth)) = open.pop() {
            if !seen.insert(next) || block.scope.named.contains(&next) {
                continue;
            }
            deep |= depth > MAX_DEPTH;
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
            let is_wanted = next != op
                && block.here.contains(&next)
                && !self.operations.get(next).is_leaf()
                && !self.operations.is_division(next);
            let often = block.uses.get(&next).copied().unwrap_or(0) > 1;
            if is_wanted && (often || count % MAX_DEPTH == 0) && !block.scope.named.contains(&next)
            {
                match block.turns.get(&next) {
                    Some(&turn) => self.turns(block, turn),
                    None => {
                        self.require_operands(block, next);
                        self.keep(block, next);
                    }
                }
            }
        }
    }

    /// The sines and cosines of all angles of a group that is computed together.
    fn turns(&mut self, block: &mut Block, turn: (usize, usize)) {
        let mut turns = Vec::new();
        for angle in block.angles.get(&turn).cloned().unwrap_or_default() {
            self.require(block, angle);
            let values = [Elementary::Sin, Elementary::Cos].map(|function| {
                let wanted = Operation::Elementary(function, angle);
                let mut known = block.turns.keys().copied();
                let found = known.find(|&op| *self.operations.get(op) == wanted)?;
                Some((found, self.name()))
            });
            turns.push(Turn { angle, values });
        }
        let named = turns.iter().flat_map(|turn| turn.values).flatten();
        block.scope.named.extend(named.map(|(op, _)| op));
        block.statements.push(Statement::Turns(turns));
    }
}
