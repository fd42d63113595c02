//! From the values of a formula to a tape: joins products and sums, puts equal operations in rows, and allocates registers.

use std::collections::{BTreeMap, HashMap};

use crate::inputs::Load;
use crate::operation::Code;
use crate::tape::{Input, Operand, Register, Step, Tape, Write};
use crate::unroll::{MAX_OPERATIONS, Number, Refusal, Value};

/// Length of the shortest row whose block has room for full chunks.
pub(crate) const SHORTEST_ROW: usize = 4;

/// The number of components that are computed side by side.
pub(crate) const CHUNK: usize = 8;

/// The number of uses of each value for the given results.
fn uses(list: &[Value], results: &[Number]) -> Vec<usize> {
    let mut uses = vec![0; list.len()];
    for &result in results {
        uses[result as usize] += 1;
    }
    for number in (0..list.len()).rev() {
        if uses[number] > 0
            && let Value::Step(code, operands) = list[number]
        {
            for &operand in &operands[..code.arity()] {
                uses[operand as usize] += 1;
            }
        }
    }
    uses
}

/// Fuses a sum and a product that only this sum uses into one operation, with the same rounding; returns the new number
/// of uses.
pub(crate) fn join_products(list: &mut [Value], results: &[Number]) -> Vec<usize> {
    let before = uses(list, results);
    for number in 0..list.len() {
        let Value::Step(code @ (Code::Add | Code::Subtract), [left, right, _]) = list[number]
        else {
            continue;
        };
        let product = |of: Number| match list[of as usize] {
            Value::Step(Code::Multiply, [a, b, _]) if before[of as usize] == 1 => Some([a, b]),
            _ => None,
        };
        let joined = match (code, product(left), product(right)) {
            (Code::Add, Some([a, b]), _) => Some((Code::MultiplyAdd, [a, b, right])),
            (Code::Add, None, Some([a, b])) => Some((Code::MultiplyAdd, [a, b, left])),
            (Code::Subtract, Some([a, b]), _) => Some((Code::MultiplySubtract, [a, b, right])),
            (Code::Subtract, None, Some([a, b])) => Some((Code::SubtractProduct, [a, b, left])),
            _ => None,
        };
        if let Some((code, operands)) = joined {
            list[number] = Value::Step(code, operands);
        }
    }
    uses(list, results)
}

/// Places values in registers and their operations in rows.
///
/// Operations of one kind whose operands are known equally early are a group. The results of a group are in successive registers, a block.
/// They are in the order in which they are read first, so that the operands of the next group are in order, too. A row is a part of a group
/// whose operands are either the same or in successive registers.
pub(crate) struct Assembly<'a> {
    list: &'a [Value],
    results: &'a [Number],
    /// The number of remaining uses of each value.
    left: Vec<usize>,
    /// Register and block of each value.
    places: HashMap<Number, (Register, usize)>,
    blocks: Vec<Block>,
    loads: Vec<Load>,
    /// Free blocks by their length.
    free: BTreeMap<usize, Vec<Register>>,
    tape: Tape,
}

/// Operations of one kind.
type Group = (Code, Vec<Number>);

/// The group, the operand, and the place in the group of an operation that reads a value.
type Reader = (usize, usize, usize);

/// Successive registers.
struct Block {
    start: Register,
    length: usize,
    /// The number of values that are still needed.
    live: usize,
}

impl<'a> Assembly<'a> {
    /// The assembly of values with these numbers of uses.
    pub(crate) fn of(list: &'a [Value], uses: Vec<usize>, results: &'a [Number]) -> Self {
        Assembly {
            list,
            results,
            left: uses,
            places: HashMap::new(),
            blocks: Vec::new(),
            loads: Vec::new(),
            free: BTreeMap::new(),
            tape: Tape::default(),
        }
    }

    /// The tape.
    pub(crate) fn tape(mut self) -> Result<Tape, Refusal> {
        let (groups, readers) = self.groups()?;
        self.load(&readers)?;
        for (code, group) in groups {
            self.compute(code, &group)?;
        }
        self.tape.results = self.results.len();
        for (number, result) in self.results.iter().enumerate() {
            let &(from, _) = self.places.get(result).ok_or(Refusal::Outside)?;
            match self.tape.writes.last_mut() {
                Some(last) if last.from + last.count as Register == from => last.count += 1,
                _ => self.tape.writes.push(Write {
                    from,
                    to: number,
                    count: 1,
                }),
            }
        }
        self.tape.writes = (self.tape.writes.iter().copied())
            .flat_map(|row| {
                singles(row.count).map(move |(k, count)| Write {
                    from: row.from + k as Register,
                    to: row.to + k,
                    count,
                })
            })
            .collect();
        self.tape.inputs = match self.tape.steps.is_empty() {
            true => self.copies().into_iter().collect(),
            false => self.loads.iter().copied().collect(),
        };
        let rows = self.tape.steps.iter().filter(|step| step.row.is_some());
        self.tape.in_rows = rows.map(|step| step.count as usize).sum();
        Ok(self.tape)
    }

    /// Places the inputs: components of the state in their order, and others in the order in which they are read.
    fn load(&mut self, readers: &[Reader]) -> Result<(), Refusal> {
        let mut inputs: Vec<(Input, Number)> = Vec::new();
        for (number, value) in self.list.iter().enumerate() {
            let input = match *value {
                Value::Step(..) => continue,
                Value::Constant(bits) => Input::Constant(f64::from_bits(bits)),
                Value::Time => Input::Time,
                Value::Position(k) => Input::Position(k),
                Value::Momentum(k) => Input::Momentum(k),
                Value::Parameter(k) => Input::Parameter(k),
            };
            if self.left[number] > 0 {
                inputs.push((input, number as Number));
            }
        }
        let is_of_state = |(input, _): &(Input, Number)| input.component().is_some();
        let (mut state, mut others): (Vec<_>, Vec<_>) = inputs.into_iter().partition(is_of_state);
        others.sort_by_key(|(_, number)| readers[*number as usize]);
        self.add_loads(&others, 1)?;
        state.sort_by_key(|(input, _)| input.component());
        let follow = |before: &(Input, _), next: &(Input, _)| before.0.after(1) == Some(next.0);
        for row in state.chunk_by(follow) {
            let count = if row.len() < SHORTEST_ROW {
                1
            } else {
                row.len()
            };
            self.add_loads(row, count)?;
        }
        Ok(())
    }

    /// Places inputs in successive registers, `count` at a time.
    fn add_loads(&mut self, inputs: &[(Input, Number)], count: usize) -> Result<(), Refusal> {
        let numbers: Vec<Number> = inputs.iter().map(|(_, number)| *number).collect();
        let start = self.place(&numbers)?;
        let loads = inputs.iter().enumerate().step_by(count);
        self.loads.extend(loads.map(|(k, (input, _))| Load {
            into: start + k as Register,
            count,
            input: *input,
        }));
        Ok(())
    }

    /// The groups in their order, each in the order of its registers; and where each value is read first.
    fn groups(&self) -> Result<(Vec<Group>, Vec<Reader>), Refusal> {
        let mut levels = vec![0_usize; self.list.len()];
        let mut groups: BTreeMap<(usize, Code), Vec<Number>> = BTreeMap::new();
        let mut count = 0;
        for (number, value) in self.list.iter().enumerate() {
            if let Value::Step(code, operands) = *value
                && self.left[number] > 0
            {
                let below = operands[..code.arity()].iter();
                let level = 1 + below.map(|k| levels[*k as usize]).max().unwrap_or(0);
                levels[number] = level;
                count += 1;
                groups
                    .entry((level, code))
                    .or_default()
                    .push(number as Number);
            }
        }
        if count > MAX_OPERATIONS {
            return Err(Refusal::TooLong);
        }
        let mut groups: Vec<Group> = groups
            .into_iter()
            .map(|((_, code), group)| (code, group))
            .collect();
        // Where each value is read first: group, operand and place.
        let mut readers = vec![(usize::MAX, 0, 0); self.list.len()];
        for (place, &result) in self.results.iter().enumerate().rev() {
            readers[result as usize].2 = place;
        }
        for (number, (code, group)) in groups.iter_mut().enumerate().rev() {
            group.sort_by_key(|value| readers[*value as usize]);
            for (place, value) in group.iter().enumerate() {
                if let Value::Step(_, operands) = self.list[*value as usize] {
                    for (slot, operand) in operands[..code.arity()].iter().enumerate() {
                        let reader = &mut readers[*operand as usize];
                        *reader = (number, slot, place).min(*reader);
                    }
                }
            }
        }
        Ok((groups, readers))
    }

    /// Places a group, and adds it to the tape.
    fn compute(&mut self, code: Code, group: &[Number]) -> Result<(), Refusal> {
        let operands = |value: &Number| match self.list[*value as usize] {
            Value::Step(_, operands) => operands,
            _ => [0; 3],
        };
        let operands: Vec<[Number; 3]> = group.iter().map(operands).collect();
        let start = self.place(group)?;
        let mut places: Vec<[(Register, usize); 3]> = Vec::new();
        for numbers in &operands {
            let mut places_of = [(0, 0); 3];
            for (slot, place) in places_of.iter_mut().enumerate() {
                let number = numbers[if slot < code.arity() { slot } else { 0 }];
                *place = *self.places.get(&number).ok_or(Refusal::Outside)?;
            }
            places.push(places_of);
        }
        let (first, mut done) = (self.tape.operands.len(), 0);
        self.tape
            .operands
            .extend(places.iter().map(|all| all.map(|(register, _)| register)));
        while done < places.len() {
            let (count, row) = row(&places[done..]);
            let into = start + done as Register;
            done += count as usize;
            match self.tape.steps.last_mut() {
                // What is in no row is one step.
                Some(last) if row.is_none() && last.row.is_none() && into > start => {
                    last.count += count;
                }
                _ => self.tape.steps.push(Step {
                    code,
                    row,
                    into,
                    count,
                }),
            }
        }
        debug_assert_eq!(self.tape.operands.len(), first + group.len());
        for numbers in operands {
            for number in &numbers[..code.arity()] {
                self.release(*number);
            }
        }
        Ok(())
    }

    /// Places values in successive registers.
    fn place(&mut self, values: &[Number]) -> Result<Register, Refusal> {
        let length = match values.len() {
            count if count < SHORTEST_ROW => count,
            // The last chunk of a row may begin at its end.
            count => count.next_multiple_of(CHUNK) + CHUNK,
        };
        let start = match self.free.get_mut(&length).and_then(Vec::pop) {
            Some(start) => start,
            None => {
                let start = match values.len() {
                    count if count < SHORTEST_ROW => self.tape.registers,
                    _ => self.tape.registers.next_multiple_of(CHUNK),
                };
                self.tape.registers = start + length;
                Register::try_from(start).map_err(|_| Refusal::TooLong)?
            }
        };
        let block = self.blocks.len();
        for (k, value) in values.iter().enumerate() {
            self.places.insert(*value, (start + k as Register, block));
        }
        self.blocks.push(Block {
            start,
            length,
            live: values.len(),
        });
        Ok(start)
    }

    /// Counts a use of a value; after the last use of its values a block is free.
    fn release(&mut self, value: Number) {
        let left = &mut self.left[value as usize];
        *left -= 1;
        if *left == 0
            && let Some((_, block)) = self.places.remove(&value)
        {
            let Block {
                start,
                length,
                live,
            } = &mut self.blocks[block];
            *live -= 1;
            if *live == 0 {
                self.free.entry(*length).or_default().push(*start);
            }
        }
    }

    /// Without operations, results are copied from the inputs without registers.
    fn copies(&self) -> Vec<Load> {
        let mut copies = Vec::new();
        for write in &self.tape.writes {
            let mut done = 0;
            while done < write.count {
                let from = write.from as usize + done;
                let is_loaded = |load: &&Load| {
                    (load.into as usize..load.into as usize + load.count).contains(&from)
                };
                let Some(load) = self.loads.iter().find(is_loaded) else {
                    break;
                };
                let before = from - load.into as usize;
                let count = (load.count - before).min(write.count - done);
                copies.push(Load {
                    into: (write.to + done) as Register,
                    count,
                    input: load.input.after(before).unwrap_or(load.input),
                });
                done += count;
            }
        }
        copies
    }
}

/// A row of registers to copy: its starts and counts, one by one if it is short. Few numbers are copied faster without a call.
fn singles(count: usize) -> impl Iterator<Item = (usize, usize)> {
    let step = if count < SHORTEST_ROW { 1 } else { count };
    (0..count).step_by(step).map(move |k| (k, step))
}

/// The length of the row with which these operands begin, each with its register and its block; and its kinds, if it is long enough.
fn row(places: &[[(Register, usize); 3]]) -> (u32, Option<[Operand; 3]>) {
    let kinds =
        |first: &[(Register, usize); 3], place: &[(Register, usize); 3], distance: usize| {
            let mut kinds = [Operand::Same; 3];
            for slot in 0..3 {
                let ((from, block), (to, other)) = (first[slot], place[slot]);
                kinds[slot] = match to.checked_sub(from) {
                    _ if block != other => return None,
                    Some(0) => Operand::Same,
                    Some(found) if found as usize == distance => Operand::Row,
                    _ => return None,
                };
            }
            Some(kinds)
        };
    let (first, rest) = (&places[0], &places[1..]);
    let row = rest.first().and_then(|place| kinds(first, place, 1));
    let mut others = rest.iter().zip(1..);
    let end =
        others.find(|(place, distance)| row.is_none() || kinds(first, place, *distance) != row);
    let count = end.map_or(places.len(), |(_, distance)| distance);
    let is_row = count >= SHORTEST_ROW && row != Some([Operand::Same; 3]);
    (count as u32, row.filter(|_| is_row))
}
