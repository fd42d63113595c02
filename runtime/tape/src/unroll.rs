//! From a formula to a tape: unrolls loops, substitutes parameters, and shares common subexpressions.

use std::collections::{HashMap, HashSet};
use std::error::Error;
use std::fmt;
use std::rc::Rc;

use symplectic_formula::System;
use symplectic_formula::derivative::Scatter;
use symplectic_formula::evaluate::Real;
use symplectic_formula::function::Elementary;
use symplectic_formula::graph::{Half, Id, LoopId};
use symplectic_formula::operations::{Op, Operation, Operations};
use symplectic_formula::statements::{Goal, Statement, statements};

use crate::assembly::{Assembly, join_products};
use crate::operation::{Code, apply};
use crate::tape::Tape;
use crate::values::{Entry, Indices, Values};

/// Largest number of operations of a formula with unrolled loops.
pub const MAX_OPERATIONS: usize = 60_000;
/// Largest number of values to visit while unrolling.
const MAX_VALUES: usize = 4_000_000;

/// Why a formula has no tape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// It has more than [`MAX_OPERATIONS`] operations.
    TooLong,
    /// It refers to a coordinate, or an entry of a parameter, that does not exist.
    Outside,
}

impl fmt::Display for Refusal {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Refusal::TooLong => write!(
                formatter,
                "with its sums written out, the formula has more than {MAX_OPERATIONS} operations"
            ),
            Refusal::Outside => formatter.write_str(
                "an index in the formula is out of range: that coordinate or entry of a parameter does not exist",
            ),
        }
    }
}

impl Error for Refusal {}

/// The number of a value.
pub(crate) type Number = u32;

/// A value of an unrolled formula.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Value {
    /// A constant, by its bits.
    Constant(u64),
    Time,
    Position(usize),
    Momentum(usize),
    /// A parameter that varies between trajectories.
    Parameter(usize),
    Step(Code, [Number; 3]),
}

/// What is done with the component and the value of a part.
type Work<'w, 'a> = &'w mut dyn FnMut(&mut Unrolled<'a>, usize, Number) -> Result<(), Refusal>;

/// The unrolled values of several formulas, without duplicates.
pub(crate) struct Unrolled<'a> {
    system: &'a System,
    values: &'a Values,
    operations: Operations<'a>,
    /// The operations that vary in each loop, in order.
    changing: HashMap<LoopId, Rc<[Op]>>,
    /// For operations in a loop, the operations below them that vary in the loop.
    needed: HashMap<(LoopId, Vec<Op>), Rc<[Op]>>,
    indices: Indices,
    bound: u64,
    /// The values of operations at the present indices.
    known: HashMap<Op, Number>,
    list: Vec<Value>,
    numbers: HashMap<Value, Number>,
    looked_at: usize,
    damping: Option<Damping>,
    /// The half after which parameters stand that are further coordinates.
    further: Half,
}

/// Friction −γp of trajectories from a time t₀. A tape reads the momenta e^{γ(t − t₀)} p: without the Hamiltonian these do not change.
#[derive(Debug, Clone)]
struct Damping {
    start: f64,
    /// The rates γ, of which component k of the momentum has the one with the index k modulo their number.
    rates: Vec<Number>,
}

impl<'a> Unrolled<'a> {
    /// Unrolls the operations of some nodes of the graph of a system.
    pub(crate) fn new(
        system: &'a System,
        values: &'a Values,
        roots: &[Id],
        start: Option<f64>,
    ) -> Result<Self, Refusal> {
        Self::with_further(system, values, roots, start, Half::Q)
    }

    /// [`new`](Self::new), where parameters that are further coordinates stand after this half.
    pub(crate) fn with_further(
        system: &'a System,
        values: &'a Values,
        roots: &[Id],
        start: Option<f64>,
        further: Half,
    ) -> Result<Self, Refusal> {
        let rates = start.map_or(&[][..], |_| &system.friction);
        let operations = Operations::new(&system.graph, &[roots, rates].concat());
        let mut unrolled = Unrolled {
            system,
            values,
            operations,
            changing: HashMap::new(),
            needed: HashMap::new(),
            indices: HashMap::new(),
            bound: 0,
            known: HashMap::new(),
            list: Vec::new(),
            numbers: HashMap::new(),
            looked_at: 0,
            damping: None,
            further,
        };
        let all: Vec<Op> = unrolled.operations.all().collect();
        for k in 0..system.graph.count_loops() {
            let changes = |op: &&Op| unrolled.operations.depends(**op).changes_in(LoopId(k));
            let changing = all.iter().filter(changes).copied().collect();
            unrolled.changing.insert(LoopId(k), changing);
        }
        if let Some(start) = start.filter(|_| !rates.is_empty()) {
            // Rates depend on parameters only.
            let below = unrolled.below(rates);
            let below: Vec<Op> = all
                .iter()
                .copied()
                .filter(|op| below.contains(op))
                .collect();
            unrolled.compute_all(&below)?;
            let rates = rates.iter().map(|rate| unrolled.of(*rate));
            let rates = rates.collect::<Result<_, _>>()?;
            unrolled.damping = Some(Damping { start, rates });
        }
        unrolled.compute_all(&all)?;
        Ok(unrolled)
    }

    /// The operations of some nodes, and those below.
    fn below(&self, nodes: &[Id]) -> HashSet<Op> {
        let mut open: Vec<Op> = nodes.iter().map(|id| self.operations.of(*id)).collect();
        let mut below: HashSet<Op> = open.iter().copied().collect();
        while let Some(op) = open.pop() {
            let operands = self.operations.get(op).operands();
            open.extend(operands.into_iter().filter(|op| below.insert(*op)));
        }
        below
    }

    /// e^{−γ(t − t₀)} for a component of the momentum, or e^{γ(t − t₀)}; `None` without friction.
    fn damping(&mut self, place: usize, grows: bool) -> Result<Option<Number>, Refusal> {
        let Some(Damping { start, rates }) = self.damping.clone() else {
            return Ok(None);
        };
        let time = self.add(Value::Time)?;
        let start = self.constant(start)?;
        let elapsed = self.step(Code::Subtract, &[time, start])?;
        let mut exponent = self.step(Code::Multiply, &[rates[place % rates.len()], elapsed])?;
        if !grows {
            exponent = self.step(Code::Negative, &[exponent])?;
        }
        self.step(Code::Exp, &[exponent]).map(Some)
    }

    /// The force on the momenta that a tape reads.
    pub(crate) fn undamped(&mut self, force: Vec<Number>) -> Result<Vec<Number>, Refusal> {
        let each = |(place, force)| match self.damping(place, true)? {
            Some(growth) => self.step(Code::Multiply, &[growth, force]),
            None => Ok(force),
        };
        force.into_iter().enumerate().map(each).collect()
    }

    /// The factors of the momenta that a tape reads; `None` without friction.
    pub(crate) fn factors(&mut self) -> Result<Option<Vec<Number>>, Refusal> {
        (0..self.dimension())
            .map(|place| self.damping(place, false))
            .collect()
    }

    /// The value of a node outside of loops.
    pub(crate) fn of(&self, id: Id) -> Result<Number, Refusal> {
        let found = self.known.get(&self.operations.of(id));
        found.copied().ok_or(Refusal::Outside)
    }

    /// The components of a derivative, as sums of its parts in the order of emitted code: in each loop, the parts of inner loops come first.
    pub(crate) fn gradient(&mut self, parts: &[Scatter]) -> Result<Vec<Number>, Refusal> {
        let goals = parts.iter().map(|part| Goal {
            loops: part.loops.clone(),
            value: self.operations.of(part.value),
        });
        let goals: Vec<_> = goals.collect();
        let mut sums = vec![None; self.dimension() + self.values.further()];
        self.follow(&statements(&self.operations, 0, &goals), parts, &mut sums)?;
        sums.into_iter()
            .map(|sum| match sum {
                Some(sum) => Ok(sum),
                None => self.constant(0.0),
            })
            .collect()
    }

    /// Adds the values that statements reach to the components of their parts.
    fn follow(
        &mut self,
        statements: &[Statement],
        parts: &[Scatter],
        sums: &mut [Option<Number>],
    ) -> Result<(), Refusal> {
        for statement in statements {
            match statement {
                Statement::Loop(over, inner) => {
                    let mut reached = Vec::new();
                    add_reached(inner, &mut reached);
                    // Otherwise it is the loop of a sum.
                    if !reached.is_empty() {
                        self.each(*over, &reached, &mut |this| this.follow(inner, parts, sums))?;
                    }
                }
                Statement::Reached(place, _) => {
                    self.reach(&parts[*place], &mut |this, place, value| {
                        sums[place] = Some(match sums[place] {
                            Some(sum) => this.step(Code::Add, &[sum, value])?,
                            None => value,
                        });
                        Ok(())
                    })?;
                }
                _ => (),
            }
        }
        Ok(())
    }

    /// Calls `work` at every index of the loops of a part, with the component and the value there.
    pub(crate) fn scatter(&mut self, part: &Scatter, work: Work<'_, 'a>) -> Result<(), Refusal> {
        self.scatter_in(&part.loops, part, work)
    }

    fn scatter_in(
        &mut self,
        loops: &[LoopId],
        part: &Scatter,
        work: Work<'_, 'a>,
    ) -> Result<(), Refusal> {
        if let Some((&over, inner)) = loops.split_first() {
            return self.each(over, &[self.operations.of(part.value)], &mut |this| {
                this.scatter_in(inner, part, work)
            });
        }
        self.reach(part, work)
    }

    /// Calls `work` with the component and the value of a part at the present indices.
    fn reach(&mut self, part: &Scatter, work: Work<'_, 'a>) -> Result<(), Refusal> {
        let value = self.of(part.value)?;
        let target = &part.target;
        let index = (self.values).index(self.system, &self.indices, &target.index);
        let place = index.map(|index| index * self.system.layout.components() + target.component);
        let place = place.filter(|place| *place < self.dimension());
        work(self, place.ok_or(Refusal::Outside)?, value)
    }

    /// The index of a loop being unrolled.
    pub(crate) fn index(&self, over: LoopId) -> usize {
        self.indices.get(&over).copied().unwrap_or_default()
    }

    /// The number of components of a position.
    fn dimension(&self) -> usize {
        self.values.bodies * self.system.layout.components()
    }

    /// The operations below `wanted` that vary in a loop, operands first. Restricting to these avoids an infinite
    /// recursion between nested sums.
    fn needed(&mut self, over: LoopId, wanted: &[Op]) -> Rc<[Op]> {
        let key = (over, wanted.to_vec());
        if let Some(needed) = self.needed.get(&key) {
            return Rc::clone(needed);
        }
        let mut below: HashSet<Op> = wanted.iter().copied().collect();
        let mut open = wanted.to_vec();
        while let Some(op) = open.pop() {
            let operands = self.operations.get(op).operands();
            open.extend(operands.into_iter().filter(|op| below.insert(*op)));
        }
        let changing = self.changing.get(&over);
        let needed = changing.iter().flat_map(|all| all.iter()).copied();
        let needed: Rc<[Op]> = needed.filter(|op| below.contains(op)).collect();
        self.needed.insert(key, Rc::clone(&needed));
        needed
    }

    /// Calls `work` for every index of a loop, with the values of `wanted` computed.
    fn each(
        &mut self,
        over: LoopId,
        wanted: &[Op],
        work: &mut dyn FnMut(&mut Self) -> Result<(), Refusal>,
    ) -> Result<(), Refusal> {
        let system = self.system;
        let range = self
            .values
            .range(system, &self.indices, system.graph.get_loop(over));
        let needed = self.needed(over, wanted);
        let changing = self.changing.get(&over).cloned().unwrap_or_default();
        // The same loop may already be running outside this call.
        let before = self.indices.get(&over).copied();
        let kept: Vec<(Op, Number)> = changing
            .iter()
            .filter_map(|op| Some((*op, self.known.remove(op)?)))
            .collect();
        let bound = self.bound;
        self.bound |= 1 << over.0;
        let outcome = range.ok_or(Refusal::Outside).and_then(|mut range| {
            range.try_for_each(|index| {
                self.indices.insert(over, index);
                for op in changing.iter() {
                    self.known.remove(op);
                }
                self.look_at(1 + needed.len())?;
                self.compute_all(&needed)?;
                work(self)
            })
        });
        for op in changing.iter() {
            self.known.remove(op);
        }
        self.bound = bound;
        match before {
            Some(index) => self.indices.insert(over, index),
            None => self.indices.remove(&over),
        };
        self.known.extend(kept);
        outcome
    }

    /// Computes those operations that the present indices determine, operands first.
    fn compute_all(&mut self, operations: &[Op]) -> Result<(), Refusal> {
        for &op in operations {
            let is_ready = self.operations.depends(op).loops & !self.bound == 0;
            if is_ready
                && !self.known.contains_key(&op)
                && let Some(value) = self.compute(op)?
            {
                self.known.insert(op, value);
            }
        }
        Ok(())
    }

    /// Computes an operation; `None` if it refers to something that does not exist. Only results that need it are
    /// refused.
    fn compute(&mut self, op: Op) -> Result<Option<Number>, Refusal> {
        self.look_at(1)?;
        let operation = self.operations.get(op).clone();
        let mut operands = Vec::new();
        if !matches!(operation, Operation::Total(..)) {
            for operand in operation.operands() {
                let Some(&number) = self.known.get(&operand) else {
                    return Ok(None);
                };
                operands.push(number);
            }
        }
        let code = match operation {
            Operation::Constant(value) => {
                return self.constant(<f64 as Real>::number(&value)).map(Some);
            }
            Operation::Pi => return self.constant(std::f64::consts::PI).map(Some),
            Operation::Time => return self.add(Value::Time).map(Some),
            Operation::Parameter(parameter, indices) => {
                let mut places = [0; 2];
                for (place, index) in places.iter_mut().zip(&indices) {
                    let Some(found) = self.values.index(self.system, &self.indices, index) else {
                        return Ok(None);
                    };
                    *place = found;
                }
                let rows = self.values.parameters.get(parameter);
                let row = rows.and_then(|rows| rows.get(places[0]));
                let Some(&value) = row.and_then(|row| row.get(places[1])) else {
                    return Ok(None);
                };
                return match value {
                    Entry::Number(value) => self.constant(value).map(Some),
                    Entry::Varied(k) => self.add(Value::Parameter(k)).map(Some),
                    Entry::Further(k) => {
                        let place = self.dimension() + k;
                        self.add(match self.further {
                            Half::P => Value::Momentum(place),
                            Half::Q | Half::V => Value::Position(place),
                        })
                        .map(Some)
                    }
                };
            }
            Operation::Coordinate(coordinate) => {
                let index = self
                    .values
                    .index(self.system, &self.indices, &coordinate.index);
                let Some(index) = index.filter(|&index| index < self.values.bodies) else {
                    return Ok(None);
                };
                let place = index * self.system.layout.components() + coordinate.component;
                if let Half::Q = coordinate.half {
                    return self.add(Value::Position(place)).map(Some);
                }
                let momentum = self.add(Value::Momentum(place))?;
                return match self.damping(place, false)? {
                    Some(factor) => self.step(Code::Multiply, &[factor, momentum]).map(Some),
                    None => Ok(Some(momentum)),
                };
            }
            Operation::Total(over, body) => {
                return match self.total(over, body) {
                    Err(Refusal::Outside) => Ok(None),
                    sum => sum.map(Some),
                };
            }
            // User-defined functions were refused before.
            Operation::User(..) => return Ok(None),
            Operation::Multiply(a, b) if self.operations.is_division(b) => {
                let Operation::Reciprocal(divisor) = *self.operations.get(b) else {
                    return Ok(None);
                };
                let (Some(&a), Some(&b)) = (self.known.get(&a), self.known.get(&divisor)) else {
                    return Ok(None);
                };
                operands = vec![a, b];
                Code::Divide
            }
            Operation::Negative(_) => Code::Negative,
            Operation::Add(..) => Code::Add,
            Operation::Subtract(..) => Code::Subtract,
            Operation::Multiply(..) => Code::Multiply,
            Operation::Reciprocal(_) => Code::Reciprocal,
            Operation::Root(_) => Code::Root,
            Operation::Absolute(_) => Code::Absolute,
            Operation::OrZero(..) => Code::OrZero,
            Operation::Elementary(function, _) => elementary(function),
            Operation::Atan2(..) => Code::Atan2,
        };
        self.step(code, &operands).map(Some)
    }

    /// Counts visited values, to bound the work.
    fn look_at(&mut self, count: usize) -> Result<(), Refusal> {
        self.looked_at += count;
        match self.looked_at > MAX_VALUES {
            true => Err(Refusal::TooLong),
            false => Ok(()),
        }
    }

    fn total(&mut self, over: LoopId, body: Op) -> Result<Number, Refusal> {
        let mut sum = None;
        self.each(over, &[body], &mut |this| {
            let term = *this.known.get(&body).ok_or(Refusal::Outside)?;
            sum = Some(match sum {
                Some(sum) => this.step(Code::Add, &[sum, term])?,
                None => term,
            });
            Ok(())
        })?;
        match sum {
            Some(sum) => Ok(sum),
            None => self.constant(0.0),
        }
    }

    fn constant(&mut self, value: f64) -> Result<Number, Refusal> {
        self.add(Value::Constant(value.to_bits()))
    }

    /// Adds an operation, with constant folding.
    fn step(&mut self, code: Code, operands: &[Number]) -> Result<Number, Refusal> {
        let mut numbers = [operands[0]; 3];
        numbers[..operands.len()].copy_from_slice(operands);
        let constant = |number: Number| match self.list[number as usize] {
            Value::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        };
        if let [Some(a), Some(b), Some(c)] = numbers.map(constant) {
            return self.constant(apply(code, [a, b, c]));
        }
        self.add(Value::Step(code, numbers))
    }

    fn add(&mut self, value: Value) -> Result<Number, Refusal> {
        if let Some(&number) = self.numbers.get(&value) {
            return Ok(number);
        }
        self.look_at(1)?;
        let number = Number::try_from(self.list.len()).map_err(|_| Refusal::TooLong)?;
        self.list.push(value);
        self.numbers.insert(value, number);
        Ok(number)
    }

    /// The tape that computes exactly the given values.
    pub(crate) fn tape(&self, results: &[Number]) -> Result<Tape, Refusal> {
        let mut list = self.list.clone();
        let used = join_products(&mut list, results);
        Assembly::of(&list, used, results).tape()
    }
}

/// Collects the values that statements reach.
fn add_reached(statements: &[Statement], reached: &mut Vec<Op>) {
    for statement in statements {
        match statement {
            Statement::Loop(_, inner) => add_reached(inner, reached),
            Statement::Reached(_, value) => reached.push(*value),
            _ => (),
        }
    }
}

fn elementary(function: Elementary) -> Code {
    match function {
        Elementary::Exp => Code::Exp,
        Elementary::Ln => Code::Ln,
        Elementary::Sin => Code::Sin,
        Elementary::Cos => Code::Cos,
        Elementary::Tan => Code::Tan,
        Elementary::Asin => Code::Asin,
        Elementary::Acos => Code::Acos,
        Elementary::Atan => Code::Atan,
        Elementary::Sinh => Code::Sinh,
        Elementary::Cosh => Code::Cosh,
        Elementary::Tanh => Code::Tanh,
    }
}
