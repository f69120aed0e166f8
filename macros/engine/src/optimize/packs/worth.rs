//! Stage `optimize`, packs: what pays.
//!
//! In: statements and packs. Out: the packs that save more than it takes to fill and to empty them.
//!
//! A pack saves the operations of all members but one. To put scalars into one is charged as one instruction for each, to repeat a scalar
//! as one, and to take a member out as one; literals are loaded. What another pack gives or takes is free, so a pack with little work
//! between others pays.

use std::collections::{HashMap, HashSet};

use crate::contracts::call::Call;
use crate::optimize::program::{Expression, Local, Program, Size, Statement};

use super::order::Pack;

/// Quotients and roots, in additions.
const LONG: i32 = 4;
/// Sine and cosine of one angle: in vectors, with packs or without them.
const SINES: i32 = 2;
/// To repeat a scalar.
const REPEAT: i32 = 1;
/// To take a member out.
const TAKE: i32 = 1;
/// Less than such a share of a function's operations, in hundredths, is not worth the trouble.
const SHARE: i32 = 5;

/// Numbers of the packs that pay as long as the others stand.
pub(super) fn kept(program: &Program, packs: &[Pack]) -> HashSet<usize> {
    let outlook = Outlook::new(program, packs);
    (0..packs.len()).filter(|&number| outlook.gain(number) >= 0).collect()
}

/// Whether all of them together do.
pub(super) fn pays(before: &Program, parted: &Program, packs: &[Pack]) -> bool {
    if packs.is_empty() {
        return false;
    }
    let outlook = Outlook::new(parted, packs);
    let all: i32 = before.statements.iter().map(of_statement).sum();
    outlook.total() * 100 > all * SHARE
}

/// Operations, and what it takes to fill packs and to empty them.
pub(super) fn weight(program: &Program) -> u32 {
    let mut filled: HashMap<String, i32> = HashMap::new();
    let mut sum: i32 = program.results.iter().map(of_expression).sum();
    for statement in &program.statements {
        filled.extend(gathers(statement));
        sum += match statement {
            Statement::Members { members, .. } => members.iter().flatten().count() as i32 * TAKE,
            other => of_statement(other),
        };
    }
    (sum + filled.values().sum::<i32>()).unsigned_abs()
}

/// To put scalars into a pack.
fn gather(size: Size) -> i32 {
    size.members() as i32
}

struct Outlook<'a> {
    program: &'a Program,
    packs: &'a [Pack],
    /// The pack that a statement is in.
    of: HashMap<usize, usize>,
    readers: HashMap<Local, Vec<usize>>,
    /// The pack that gives a local of a pack.
    gives: HashMap<Local, usize>,
    /// Locals that packs read: of packs, and scalars that they are filled with.
    read: HashSet<Local>,
    /// Members that are only added to others of their pack.
    summed: HashSet<Local>,
    /// How many packs read a pack of scalars.
    shared: HashMap<String, i32>,
}

impl<'a> Outlook<'a> {
    fn new(program: &'a Program, packs: &'a [Pack]) -> Outlook<'a> {
        let (mut of, mut gives, mut shared) = (HashMap::new(), HashMap::new(), HashMap::new());
        let mut read = HashSet::new();
        for (number, pack) in packs.iter().enumerate() {
            of.extend(pack.members().map(|(_, statement)| (statement, number)));
            gives.extend(pack.statement.defined().into_iter().map(|local| (local, number)));
            for expression in pack.statement.expressions() {
                expression.each_local(&mut |local| {
                    read.insert(local);
                });
            }
            for (key, _) in gathers(&pack.statement) {
                *shared.entry(key).or_insert(0) += 1;
            }
        }
        let summed = summed(program, packs);
        Outlook { program, packs, of, readers: readers(program), gives, read, summed, shared }
    }

    /// Operations that packs save.
    fn saved(&self, number: usize) -> i32 {
        let pack = &self.packs[number];
        let members: i32 = pack.members().map(|(_, statement)| of_statement(&self.program.statements[statement])).sum();
        members - of_statement(&pack.statement)
    }

    /// Members that something reads beside packs, with `dropped` none.
    fn taken(&self, number: usize, dropped: Option<usize>) -> i32 {
        let locals =
            self.packs[number].members().flat_map(|(_, statement)| self.program.statements[statement].defined());
        let is_read = |local: &Local| {
            let is_taken = |reader: &usize| match self.of.get(reader) {
                Some(&pack) => Some(pack) == dropped,
                None => !self.summed.contains(local),
            };
            // Packs may be filled with members of another.
            self.read.contains(local) || self.readers.get(local).is_some_and(|list| list.iter().any(is_taken))
        };
        locals.filter(is_read).count() as i32
    }

    /// What all would cost more without this one.
    fn gain(&self, number: usize) -> i32 {
        let pack = &self.packs[number];
        let filled: i32 = gathers(&pack.statement)
            .into_iter()
            .map(|(key, cost)| if self.shared.get(&key) == Some(&1) { cost } else { 0 })
            .sum();
        let mut reads = HashSet::new();
        for expression in pack.statement.expressions() {
            expression.each_local(&mut |local| reads.extend(self.gives.get(&local)));
        }
        let more_taken: i32 =
            reads.into_iter().map(|read| self.taken(read, Some(number)) - self.taken(read, None)).sum();
        // What it gives to other packs they would have to be filled with.
        let given = pack.statement.defined().into_iter().filter(|local| self.read.contains(local));
        let given = given.count() as i32 * gather(pack.size);
        self.saved(number) + more_taken * TAKE + given - filled - self.taken(number, None) * TAKE
    }

    fn total(&self) -> i32 {
        let filled: HashMap<String, i32> = self.packs.iter().flat_map(|pack| gathers(&pack.statement)).collect();
        let each = (0..self.packs.len()).map(|number| self.saved(number) - self.taken(number, None) * TAKE);
        each.sum::<i32>() - filled.values().sum::<i32>()
    }
}

/// Members that nothing reads but sums of several members of their pack, which is all: these are added up in halves of the
/// pack, with no more instructions than there are sums of two.
fn summed(program: &Program, packs: &[Pack]) -> HashSet<Local> {
    let mut pack_of: HashMap<Local, usize> = HashMap::new();
    for (number, pack) in packs.iter().enumerate() {
        let defined = pack.members().flat_map(|(_, statement)| program.statements[statement].defined());
        pack_of.extend(defined.map(|local| (local, number)));
    }
    let mut found: HashSet<Local> = pack_of.keys().copied().collect();
    let packed: HashSet<usize> = packs.iter().flat_map(Pack::members).map(|(_, statement)| statement).collect();
    let scalar = program.statements.iter().enumerate().filter(|(number, _)| !packed.contains(number));
    let values = scalar.flat_map(|(_, statement)| {
        let is_let = matches!(statement, Statement::Let { .. });
        statement.expressions().map(move |value| (value, is_let))
    });
    for (value, is_let) in values.chain(program.results.iter().map(|result| (result, false))) {
        let mut bare: HashMap<usize, Vec<Local>> = HashMap::new();
        if let (Expression::Sum(terms), true) = (value, is_let) {
            for (_, term) in terms {
                if let Expression::Local(local) = term
                    && let Some(&pack) = pack_of.get(local)
                {
                    bare.entry(pack).or_default().push(*local);
                }
            }
        }
        let added: HashSet<Local> = bare.into_values().filter(|list| list.len() > 1).flatten().collect();
        let mut reads = 0;
        value.each_local(&mut |local| {
            reads += usize::from(added.contains(&local));
            if !added.contains(&local) {
                found.remove(&local);
            }
        });
        if reads > added.len() {
            found.retain(|local| !added.contains(local));
        }
    }
    found
}

/// Packs that are made of scalars in a statement, and what each takes.
fn gathers(statement: &Statement) -> HashMap<String, i32> {
    let mut found = HashMap::new();
    let (Statement::Pack { size, .. } | Statement::PackSines(size, _) | Statement::Members { size, .. }) = *statement
    else {
        return found;
    };
    let mut stack: Vec<&Expression> = statement.expressions().collect();
    while let Some(expression) = stack.pop() {
        match expression {
            Expression::Pack(list) if list.iter().all(|item| matches!(item, Expression::Literal(_))) => {}
            Expression::Pack(list) => {
                found.insert(format!("{size:?} {list:?}"), if list.len() == 1 { REPEAT } else { gather(size) });
            }
            Expression::Neg(inner) => stack.push(inner),
            Expression::Sum(terms) => stack.extend(terms.iter().map(|(_, term)| term)),
            Expression::Product(list) | Expression::Call(_, list) => stack.extend(list),
            Expression::Fused(operands) => stack.extend(operands.iter()),
            Expression::Quotient(above, below) => stack.extend([&**above, &**below]),
            Expression::Literal(_) | Expression::Symbol(_) | Expression::Field(_) | Expression::Local(_) => {}
        }
    }
    found
}

fn of_statement(statement: &Statement) -> i32 {
    let own = match statement {
        Statement::PackSines(size, _) => size.members() as i32 * SINES,
        Statement::SinCos(sines) => SINES * sines.len() as i32,
        _ => 0,
    };
    own + statement.expressions().map(of_expression).sum::<i32>()
}

/// In additions.
fn of_expression(expression: &Expression) -> i32 {
    let all = |list: &[Expression]| list.iter().map(of_expression).sum::<i32>();
    let between = |count: usize| count.saturating_sub(1) as i32;
    match expression {
        Expression::Literal(_)
        | Expression::Symbol(_)
        | Expression::Field(_)
        | Expression::Local(_)
        | Expression::Pack(_) => 0,
        Expression::Neg(inner) => of_expression(inner),
        Expression::Sum(terms) => between(terms.len()) + terms.iter().map(|(_, term)| of_expression(term)).sum::<i32>(),
        Expression::Product(list) => between(list.len()) + all(list),
        Expression::Fused(operands) => 2 + all(&operands[..]),
        Expression::Quotient(above, below) => LONG + of_expression(above) + of_expression(below),
        Expression::Call(Call::Sqrt, list) => LONG + all(list),
        Expression::Call(_, list) => 1 + all(list),
    }
}

/// Sums and products of two, quotients, roots, calls.
pub(super) fn operations(expression: &Expression) -> usize {
    let all = |list: &[Expression]| list.iter().map(operations).sum::<usize>();
    match expression {
        Expression::Literal(_) | Expression::Symbol(_) | Expression::Field(_) | Expression::Local(_) => 0,
        Expression::Neg(inner) => operations(inner),
        Expression::Sum(terms) => {
            terms.len().saturating_sub(1) + terms.iter().map(|(_, term)| operations(term)).sum::<usize>()
        }
        Expression::Product(list) => list.len().saturating_sub(1) + all(list),
        Expression::Fused(parts) => 2 + all(&parts[..]),
        Expression::Quotient(above, below) => 1 + operations(above) + operations(below),
        Expression::Call(_, list) => 1 + all(list),
        Expression::Pack(list) => all(list),
    }
}

/// What reads each local, by the number of the statement; results count as one more.
fn readers(program: &Program) -> HashMap<Local, Vec<usize>> {
    let mut found: HashMap<Local, Vec<usize>> = HashMap::new();
    for (number, statement) in program.statements.iter().enumerate() {
        for expression in statement.expressions() {
            expression.each_local(&mut |local| found.entry(local).or_default().push(number));
        }
    }
    for result in &program.results {
        result.each_local(&mut |local| found.entry(local).or_default().push(program.statements.len()));
    }
    found
}
