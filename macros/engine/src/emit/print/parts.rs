//! Stage `emit`: a large program as several functions.
//!
//! In: a program of more than [`MOST`] operations, or than a caller says. Out: parts of about equal size, each a function of its own,
//! and what passes from one to the next. The compiler's time grows with the square of a function's length (33 s for what takes 4 in
//! parts, and three times the memory), so nobody waits for one that is cut. No operation and no order changes, so no bit does.
//!
//! What a part computes and a later one reads is kept in an array, `kept`, of which each value has a place from the end of the part
//! that computes it to the end of the last one that reads it, and a pack one for each member; then another takes the place. A part reads what it
//! needs at its beginning and writes at its end. Cuts are where few values are kept, and none of them is a comparison, which is no scalar.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

use crate::invariant::fault::{OrFault, raise};
use crate::optimize::program::{Expression, Local, Program, Size, Statement};

use super::blocks::Live;

/// As many operations stand in one function.
pub(in crate::emit) const MOST: usize = 20_000;
/// As many stand in a part, about, where there are more.
pub(in crate::emit) const PART: usize = 2_000;

/// Where a value is kept: a scalar, or the members of a pack.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::emit) struct Kept {
    pub(in crate::emit) local: Local,
    /// Of a pack.
    pub(in crate::emit) size: Option<Size>,
    pub(in crate::emit) places: Vec<usize>,
}

/// One function: live statements `from..to`.
#[derive(Debug)]
pub(in crate::emit) struct Part {
    pub(in crate::emit) from: usize,
    pub(in crate::emit) to: usize,
    /// What earlier parts have computed.
    pub(in crate::emit) reads: Vec<Kept>,
    /// What later parts, or the results, read.
    pub(in crate::emit) writes: Vec<Kept>,
}

/// A program in parts.
pub(in crate::emit) struct Parts {
    pub(in crate::emit) list: Vec<Part>,
    /// Places of the array.
    pub(in crate::emit) places: usize,
    /// Where the results are.
    pub(in crate::emit) results: HashMap<Local, usize>,
}

/// Operations of a program.
pub(in crate::emit) fn operations(program: &Program) -> usize {
    program.expressions().map(weight).sum()
}

/// Results that are computed become statements, each behind what it reads: the last function has nothing to do but to hand them on.
pub(in crate::emit) fn with_results_first(mut program: Program) -> Program {
    let mut defined = vec![0; program.locals.len()];
    for (number, statement) in program.statements.iter().enumerate() {
        statement.defined().into_iter().for_each(|local| defined[local.0] = number + 1);
    }
    let mut behind: Vec<Vec<Statement>> = vec![Vec::new(); program.statements.len() + 1];
    program.headings.resize(program.locals.len(), None);
    for (number, result) in program.results.iter_mut().enumerate() {
        if is_leaf(result) {
            continue;
        }
        let mut after = 0;
        result.each_local(&mut |local| after = after.max(defined[local.0]));
        let local = Local(program.locals.len());
        program.locals.push(format!("result_{}", number + 1));
        program.headings.push(None);
        behind[after].push(Statement::Let { local, value: std::mem::replace(result, Expression::Local(local)) });
    }
    let (first, rest) = behind.split_first_mut().or_fault("there is a place before all statements");
    let mut statements = std::mem::take(first);
    for (statement, results) in std::mem::take(&mut program.statements).into_iter().zip(rest) {
        statements.push(statement);
        statements.append(results);
    }
    program.statements = statements;
    program
}

impl Parts {
    /// Cuts the live statements of a program into parts of about `size` operations.
    pub(in crate::emit) fn new(program: &Program, live: &[Live<'_>], size: usize) -> Parts {
        let flow = Flow::new(program, live);
        let cuts = flow.cuts(live, size.max(1));
        let ends = cuts.iter().copied().skip(1);
        let mut list: Vec<Part> =
            cuts.iter().zip(ends).map(|(&from, to)| Part { from, to, reads: Vec::new(), writes: Vec::new() }).collect();
        let (places, results) = flow.keep(program, live, &mut list);
        let parts = Parts { list, places, results };
        parts.check(program, live);
        parts
    }

    /// Whatever is read stands where it is looked for, in every part: followed place by place.
    fn check(&self, program: &Program, live: &[Live<'_>]) {
        let mut held: Vec<Option<Local>> = vec![None; self.places];
        let holds = |held: &[Option<Local>], kept: &Kept| {
            !kept.places.is_empty() && kept.places.iter().all(|&place| held[place] == Some(kept.local))
        };
        for part in &self.list {
            let mut known = vec![false; program.locals.len()];
            for kept in &part.reads {
                known[kept.local.0] = holds(&held, kept);
            }
            for live in &live[part.from..part.to] {
                live.defined().into_iter().for_each(|local| known[local.0] = true);
                live.inside(&mut |local| known[local.0] = true);
                for expression in live.expressions() {
                    expression.each_local(&mut |local| {
                        if !known[local.0] {
                            raise("a part reads what it has computed, or what is kept for it");
                        }
                    });
                }
            }
            for kept in &part.writes {
                if !known[kept.local.0] {
                    raise("a part keeps what it has computed");
                }
                kept.places.iter().for_each(|&place| held[place] = Some(kept.local));
            }
        }
        for result in &program.results {
            result.each_local(&mut |local| {
                let place = self.results.get(&local);
                if place.is_none_or(|&place| held[place] != Some(local)) {
                    raise("results are kept to the end");
                }
            });
        }
    }
}

/// From where to where each value is needed.
struct Flow {
    /// The statement that computes a local.
    defined: Vec<Option<usize>>,
    /// The last one that reads it; results count as one more.
    last: Vec<usize>,
    /// Locals that are packs.
    size: Vec<Option<Size>>,
    /// Locals that are neither scalars nor packs.
    bound: Vec<bool>,
}

impl Flow {
    fn new(program: &Program, live: &[Live<'_>]) -> Flow {
        let count = program.locals.len();
        let (defined, last) = (vec![None; count], vec![0; count]);
        let mut flow = Flow { defined, last, size: vec![None; count], bound: vec![false; count] };
        for (number, live) in live.iter().enumerate() {
            for expression in live.expressions() {
                expression.each_local(&mut |local| flow.last[local.0] = number);
            }
            let (size, is_bound) = match live.statement {
                Statement::Pack { size, .. } | Statement::PackSines(size, _) => (Some(*size), false),
                Statement::Let { value, .. } => (None, flow.is_comparison(value)),
                _ => (None, false),
            };
            for local in live.defined() {
                flow.defined[local.0] = Some(number);
                flow.size[local.0] = size;
                flow.bound[local.0] = is_bound;
            }
        }
        for result in &program.results {
            result.each_local(&mut |local| flow.last[local.0] = live.len());
        }
        flow
    }

    /// Whether it is a mask of the scalar, and not a scalar.
    fn is_comparison(&self, value: &Expression) -> bool {
        match value {
            Expression::Call(call, _) => call.is_mask(),
            Expression::Local(local) => self.bound[local.0],
            _ => false,
        }
    }

    /// As many scalars has a local.
    fn scalars(&self, local: Local) -> usize {
        self.size[local.0].map_or(1, Size::members)
    }

    /// Locals that outlive the statement which computes them, with both places.
    fn spans(&self) -> impl Iterator<Item = (Local, usize, usize)> + '_ {
        let each = self.defined.iter().zip(&self.last).enumerate();
        each.filter_map(|(local, (&defined, &last))| Some((Local(local), defined?, last)))
            .filter(|(_, defined, last)| last > defined)
    }

    /// Where parts begin, and the end: near equal sizes, where the fewest values are kept.
    fn cuts(&self, live: &[Live<'_>], size: usize) -> Vec<usize> {
        // Before each statement: scalars that pass, and whether there is a comparison among what passes.
        let mut passing = vec![0_i64; live.len() + 2];
        let mut barred = vec![0_i64; live.len() + 2];
        for (local, defined, last) in self.spans() {
            let scalars = self.scalars(local) as i64;
            passing[defined + 1] += scalars;
            passing[last + 1] -= scalars;
            if self.bound[local.0] {
                barred[defined + 1] += 1;
                barred[last + 1] -= 1;
            }
        }
        let mut done = vec![0; live.len() + 1];
        for number in 0..live.len() {
            passing[number + 1] += passing[number];
            barred[number + 1] += barred[number];
            done[number + 1] = done[number] + live[number].expressions().into_iter().map(weight).sum::<usize>().max(1);
        }
        let total = done[live.len()];
        let parts = total.div_ceil(size).max(1);
        let mut cuts = vec![0];
        for part in 1..parts {
            let (wanted, reach) = (total * part / parts, total / parts / 4);
            let from = done.partition_point(|&sum| sum + reach < wanted).max(1);
            let to = done.partition_point(|&sum| sum <= wanted + reach).min(live.len());
            let free = (from..to).filter(|&at| barred[at] == 0 && Some(&at) > cuts.last());
            cuts.extend(free.min_by_key(|&at| (passing[at], done[at].abs_diff(wanted))));
        }
        cuts.push(live.len());
        cuts
    }

    /// Fills in what is read and written, each value in a place that is free; gives the number of places and those of results.
    fn keep(&self, program: &Program, live: &[Live<'_>], parts: &mut [Part]) -> (usize, HashMap<Local, usize>) {
        let mut of: Vec<usize> = Vec::with_capacity(live.len() + 1);
        for (number, part) in parts.iter().enumerate() {
            of.extend((part.from..part.to).map(|_| number));
        }
        of.push(parts.len());
        let mut place: Vec<Vec<usize>> = vec![Vec::new(); program.locals.len()];
        // By the part that reads it last.
        let mut ending: Vec<Vec<usize>> = vec![Vec::new(); parts.len() + 1];
        let mut free: BinaryHeap<Reverse<usize>> = BinaryHeap::new();
        let mut places = 0;
        let mut seen = vec![usize::MAX; program.locals.len()];
        for (number, part) in parts.iter_mut().enumerate() {
            for expression in live[part.from..part.to].iter().flat_map(Live::expressions) {
                expression.each_local(&mut |local| {
                    if !place[local.0].is_empty() && seen[local.0] != number {
                        seen[local.0] = number;
                        let (size, places) = (self.size[local.0], place[local.0].clone());
                        part.reads.push(Kept { local, size, places });
                    }
                });
            }
            free.extend(ending[number].drain(..).map(Reverse));
            for local in live[part.from..part.to].iter().flat_map(Live::defined) {
                if of[self.last[local.0]] <= number {
                    continue;
                }
                for _ in 0..self.scalars(local) {
                    let at = free.pop().map_or(places, |Reverse(at)| at);
                    places = places.max(at + 1);
                    place[local.0].push(at);
                    ending[of[self.last[local.0]]].push(at);
                }
                let (size, places) = (self.size[local.0], place[local.0].clone());
                part.writes.push(Kept { local, size, places });
            }
        }
        let mut results = HashMap::new();
        for result in &program.results {
            // Results are scalars.
            result.each_local(&mut |local| results.extend(place[local.0].first().map(|&place| (local, place))));
        }
        (places, results)
    }
}

/// Operations of an expression, leaves not counted.
fn weight(expression: &Expression) -> usize {
    match expression {
        Expression::Literal(_) | Expression::Symbol(_) | Expression::Field(_) | Expression::Local(_) => 0,
        Expression::Neg(inner) => weight(inner),
        Expression::Sum(terms) => {
            terms.len().saturating_sub(1) + terms.iter().map(|term| weight(&term.1)).sum::<usize>()
        }
        Expression::Product(list) => list.len().saturating_sub(1) + list.iter().map(weight).sum::<usize>(),
        Expression::Quotient(above, below) => 1 + weight(above) + weight(below),
        Expression::Call(_, list) => 1 + list.iter().map(weight).sum::<usize>(),
        Expression::Fused(operands) => 2 + operands.iter().map(weight).sum::<usize>(),
        Expression::Pack(list) => list.iter().map(weight).sum(),
    }
}

fn is_leaf(expression: &Expression) -> bool {
    match expression {
        Expression::Neg(inner) => is_leaf(inner),
        Expression::Literal(_) | Expression::Symbol(_) | Expression::Field(_) | Expression::Local(_) => true,
        _ => false,
    }
}
