//! Stage `optimize`, on a program: the order of statements.
//!
//! In: statements in any order in which each stands behind what it reads. Out: the same ones in another. No value changes, and no
//! operation inside of an expression moves.
//!
//! The order in which results need values is a bad one for a processor with several units and sixteen registers: results are asked for
//! from the base to the tip, so what comes first waits for almost all else, and what could go on beside it comes last, while its
//! operands lie on the stack. Compilers keep close to the order of the source in blocks of this size. So statements are listed
//! anew: of those whose operands are there, the one with the longest way to a result comes first, counted in the cycles of its operations (list
//! scheduling by critical paths). Register pressure weighs against it (as in Goodman and Hsu 1988, by one weight in the place of their
//! switch): a statement is put off by `ROOM` cycles for each value that it makes, and preferred by as many for each that it is the last one
//! to read, by half as many where one other reader is left, and so on. Ties go to the order as it was.
//!
//! Of more than [`MANY`] statements what is kept counts alone: from the results down, of the operands of a statement the one first that takes most
//! values at a time while it is made (Sethi and Ullman 1970).
//!
//! Measured on what is emitted (f64, AMD EPYC of family 25, level 3, interleaved minima in one process; time over that in the order
//! in which results need values, with `target-cpu=native` and without):
//!
//! | function | ns before, native / any | native | any |
//! |---|---|---|---|
//! | panda, inverse dynamics | 90 / 128 | 0.91 | 0.78 |
//! | panda, forward dynamics | 156 / 202 | 0.91 | 0.98 |
//! | panda, derivatives of forward dynamics | 938 / 1316 | 0.99 | 1.00 |
//! | four legs on a floating body, forward | 336 / 564 | 0.89 | 0.95 |
//! | the same in packs | 203 / 301 | 0.99 | 0.94 |
//! | humanoid of 32 joints, forward | 1300 / 1776 | 0.97 | 0.99 |
//! | Stewart platform, forward | 158 / 194 | 0.94 | 0.91 |
//! | its leg forces | 143 / 175 | 1.04 | 0.99 |
//! | its strokes with rates and accelerations | 75 / 94 | 0.96 | 0.98 |
//! | geometric mean | | 0.95 | 0.94 |
//!
//! Single times move with where the linker puts the code and with what the compiler's vectoriser makes of it, those of the four legs at baseline
//! by a quarter, before and after; so rules were judged by all of these in several layouts. On the same functions, and the panda's mass matrix
//! (geometric means, native and any): by critical paths alone 0.94 and 1.01, and the humanoid loses; by what is kept, ties by length,
//! 0.94 and 0.99, and Stewart platforms lose 3 percent; operand by operand in the place of statements, 0.96 and 0.97, and leg forces
//! lose 11 percent; by need in functions of all sizes 0.98. Of the panda's inverse dynamics 249 instructions of 934 touch the stack
//! before; 130 of 800 do after a schedule of this kind.
//!
//! Functions of fewer than [`FEWEST`] statements stay as they are: they gain little, and somebody may read them. So does what is run once.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap, HashSet};

use crate::invariant::fault::OrFault;

use super::program::{Expression, Local, Statement};

/// So many statements in a row are worth an order of their own.
pub const FEWEST: usize = 160;

/// Of more than so many what is kept counts alone: their code and its stack are larger than what is near the processor.
pub const MANY: usize = 1000;

/// [cycles] what a value that is kept weighs against length.
const ROOM: i64 = 48;
/// Readers of one value that share in freeing it: of more, none does much.
const SHARED: usize = 4;

// Cycles of operations on present processors, about.
const SHORT: i64 = 4;
const QUOTIENT: i64 = 13;
const CALL: i64 = 18;
const SINES: i64 = 60;
/// By the size of a linear system.
const SOLUTION: i64 = 40;

/// Statements in the order in which a processor takes them best; so are those inside iterations. `after` is what is read behind them.
pub fn order(statements: Vec<Statement>, after: &[&Expression]) -> Vec<Statement> {
    let statements: Vec<Statement> = statements.into_iter().map(inside).collect();
    if statements.len() < FEWEST {
        return statements;
    }
    let list = List::new(&statements, after);
    let order = if statements.len() <= MANY { list.by_length() } else { list.by_need() };
    let mut left: Vec<Option<Statement>> = statements.into_iter().map(Some).collect();
    order.into_iter().filter_map(|number| left[number].take()).collect()
}

/// With what stands inside it in order.
fn inside(statement: Statement) -> Statement {
    match statement {
        Statement::Iterate { count, unknowns, start, body, next, residual } => {
            let after: Vec<&Expression> = next.iter().chain([&residual.1]).collect();
            let body = order(body, &after);
            Statement::Iterate { count, unknowns, start, body, next, residual }
        }
        other => other,
    }
}

/// Statements by number, and what is left to be done.
struct List {
    /// Locals that each reads, without repetition, of those that the list defines.
    reads: Vec<Vec<Local>>,
    /// Statements that read a local.
    readers: HashMap<Local, Vec<usize>>,
    /// Readers of a local that are left; what stands behind the list is one more.
    left: HashMap<Local, usize>,
    /// Locals whose statement is left, of those that each reads.
    waits: Vec<usize>,
    /// Locals that each defines and something reads.
    defined: Vec<Vec<Local>>,
    /// [cycles] what each is put off by.
    put_off: Vec<i64>,
    /// [cycles] from its operands to the last result.
    way: Vec<i64>,
    /// Statements that what stands behind the list reads, without repetition, in the order in which it does.
    wanted: Vec<usize>,
}

impl List {
    fn new(statements: &[Statement], after: &[&Expression]) -> List {
        let own: HashSet<Local> = statements.iter().flat_map(Statement::defined).collect();
        let locals = |expressions: &mut dyn Iterator<Item = &Expression>| {
            let mut found = Vec::new();
            expressions.for_each(|expression| expression.each_local(&mut |local| found.push(local)));
            found.retain(|local| own.contains(local));
            found.sort_unstable();
            found.dedup();
            found
        };
        let mut readers: HashMap<Local, Vec<usize>> = HashMap::new();
        let mut reads = Vec::with_capacity(statements.len());
        for (number, statement) in statements.iter().enumerate() {
            // What an iteration defines it reads too.
            let mut list = locals(&mut statement.expressions());
            let defined = statement.defined();
            list.retain(|local| !defined.contains(local));
            list.iter().for_each(|&local| readers.entry(local).or_default().push(number));
            reads.push(list);
        }
        let mut left: HashMap<Local, usize> = readers.iter().map(|(&local, list)| (local, list.len())).collect();
        locals(&mut after.iter().copied()).into_iter().for_each(|local| *left.entry(local).or_default() += 1);
        let mut wanted = Vec::new();
        let makers = numbered(statements.iter().map(Statement::defined));
        let mut seen = vec![false; statements.len()];
        for expression in after {
            expression.each_local(&mut |local| {
                wanted.extend(makers.get(&local).filter(|&&number| !std::mem::replace(&mut seen[number], true)));
            });
        }
        let is_read = |local: &Local| left.contains_key(local);
        let defined = statements.iter().map(|statement| statement.defined().into_iter().filter(is_read).collect());
        let mut list = List {
            waits: reads.iter().map(Vec::len).collect(),
            put_off: Vec::with_capacity(statements.len()),
            way: vec![0; statements.len()],
            defined: Vec::from_iter(defined),
            reads,
            readers,
            left,
            wanted,
        };
        for number in 0..statements.len() {
            let freed: i64 = list.reads[number].iter().map(|local| share(list.left[local])).sum();
            list.put_off.push(ROOM * list.defined[number].len() as i64 - freed);
        }
        for (number, statement) in statements.iter().enumerate().rev() {
            let users = list.defined[number].iter().flat_map(|local| list.readers.get(local)).flatten();
            let behind = users.map(|&user| list.way[user]).max().unwrap_or(0);
            list.way[number] = behind + duration(statement);
        }
        list
    }

    /// The longest way first.
    fn by_length(mut self) -> Vec<usize> {
        let mut order = Vec::with_capacity(self.reads.len());
        let mut done = vec![false; self.reads.len()];
        let mut ready: BinaryHeap<(i64, Reverse<usize>)> = BinaryHeap::new();
        let rank = |list: &List, number: usize| (list.way[number] - list.put_off[number], Reverse(number));
        ready.extend((0..self.reads.len()).filter(|&number| self.waits[number] == 0).map(|n| rank(&self, n)));
        // A rank only grows: a statement stands here once more then, and is done by the time its older ranks come up.
        while let Some((_, Reverse(number))) = ready.pop() {
            if std::mem::replace(&mut done[number], true) {
                continue;
            }
            order.push(number);
            for local in std::mem::take(&mut self.reads[number]) {
                let left = self.left.get_mut(&local).or_fault("what is read has a reader");
                *left -= 1;
                let more = share(*left) - share(*left + 1);
                if more == 0 {
                    continue;
                }
                let readers = self.readers.get(&local).or_fault("what is read has a reader");
                for &reader in readers.iter().filter(|&&reader| !done[reader]) {
                    self.put_off[reader] -= more;
                    if self.waits[reader] == 0 {
                        ready.push(rank(&self, reader));
                    }
                }
            }
            for local in std::mem::take(&mut self.defined[number]) {
                for &reader in self.readers.get(&local).into_iter().flatten() {
                    self.waits[reader] -= 1;
                    if self.waits[reader] == 0 {
                        ready.push(rank(&self, reader));
                    }
                }
            }
        }
        order
    }

    /// From the results down, of the operands first the one that needs most values at a time while it is made.
    fn by_need(self) -> Vec<usize> {
        let makers = numbered(self.defined.iter().cloned());
        let mut needs: Vec<usize> = Vec::with_capacity(self.reads.len());
        let mut operands: Vec<Vec<usize>> = Vec::with_capacity(self.reads.len());
        for reads in &self.reads {
            let mut list: Vec<usize> =
                reads.iter().map(|local| *makers.get(local).or_fault("what is read is defined")).collect();
            list.sort_unstable();
            list.dedup();
            list.sort_by_key(|&operand| Reverse(needs[operand]));
            needs.push(list.iter().enumerate().map(|(kept, &operand)| kept + needs[operand]).max().unwrap_or(0).max(1));
            operands.push(list);
        }
        let mut order = Vec::with_capacity(operands.len());
        let mut seen = vec![false; operands.len()];
        // What nothing reads stands at the end.
        for first in self.wanted.into_iter().chain(0..operands.len()) {
            let mut stack = vec![(first, 0)];
            while let Some((number, next)) = stack.pop() {
                if next == 0 && std::mem::replace(&mut seen[number], true) {
                    continue;
                }
                match operands[number].get(next) {
                    Some(&operand) => stack.extend([(number, next + 1), (operand, 0)]),
                    None => order.push(number),
                }
            }
        }
        order
    }
}

/// The number of the statement that defines a local.
fn numbered(defined: impl Iterator<Item = Vec<Local>>) -> HashMap<Local, usize> {
    defined.enumerate().flat_map(|(number, list)| list.into_iter().map(move |local| (local, number))).collect()
}

/// [cycles] by which a statement is preferred for a value with so many readers left.
fn share(readers: usize) -> i64 {
    if readers > SHARED { 0 } else { ROOM / readers.max(1) as i64 }
}

/// [cycles] from operands to results.
fn duration(statement: &Statement) -> i64 {
    let longest = statement.expressions().map(depth).max().unwrap_or(0);
    longest
        + match statement {
            Statement::Let { .. } | Statement::Pack { .. } => 0,
            Statement::Members { .. } | Statement::Called { .. } => CALL,
            Statement::SinCos(_) | Statement::PackSines(..) => SINES,
            Statement::Solve { size, .. } => SOLUTION * *size as i64,
            Statement::Iterate { count, body, .. } => *count as i64 * body.iter().map(duration).max().unwrap_or(0),
        }
}

/// [cycles] of the longest way through an expression.
fn depth(expression: &Expression) -> i64 {
    match expression {
        Expression::Literal(_) | Expression::Symbol(_) | Expression::Field(_) | Expression::Local(_) => 0,
        Expression::Neg(inner) => depth(inner),
        Expression::Sum(terms) => one_by_one(terms.iter().map(|(_, term)| term)),
        Expression::Product(factors) => one_by_one(factors),
        Expression::Fused(operands) => SHORT + operands.iter().map(depth).max().unwrap_or(0),
        Expression::Quotient(above, below) => QUOTIENT + depth(above).max(depth(below)),
        Expression::Call(_, list) | Expression::Pack(list) => CALL + list.iter().map(depth).max().unwrap_or(0),
    }
}

/// Operands are joined from left to right.
fn one_by_one<'a>(operands: impl IntoIterator<Item = &'a Expression>) -> i64 {
    let mut depths = operands.into_iter().map(depth);
    let first = depths.next().unwrap_or(0);
    depths.fold(first, |before, operand| SHORT + before.max(operand))
}
