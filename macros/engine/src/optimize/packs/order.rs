//! Stage `optimize`, packs: all statements in a row.
//!
//! In: statements and packs that take the place of some. Out: the program with packs. Where the first member of a pack stood, the
//! pack stands, behind all that it reads; its members are taken out right behind it, as far as something that is no pack reads
//! them.

use std::collections::{HashMap, HashSet};

use crate::invariant::injection::{Break, broken};
use crate::optimize::program::{Expression, Local, MEMBERS, Program, Size, Statement};

use super::halves;
use super::unify::Signs;

/// Statements as one.
pub(super) struct Pack {
    pub(super) size: Size,
    /// Numbers of the members' statements.
    pub(super) statements: [Option<usize>; MEMBERS],
    pub(super) statement: Statement,
    pub(super) signs: Signs,
}

impl Pack {
    /// Places and numbers of the members' statements.
    pub(super) fn members(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.statements.iter().enumerate().filter_map(|(place, number)| Some((place, (*number)?)))
    }
}

/// What is done at once: a statement, or all of a pack. Packs count behind statements.
struct Units {
    /// Of each statement.
    of: Vec<usize>,
    /// What each reads.
    reads: Vec<Vec<usize>>,
}

impl Units {
    fn new(program: &Program, packs: &[Pack]) -> Units {
        let count = program.statements.len();
        let mut of: Vec<usize> = (0..count).collect();
        for (number, pack) in packs.iter().enumerate() {
            for (_, statement) in pack.members() {
                of[statement] = count + number;
            }
        }
        let mut defined: HashMap<Local, usize> = HashMap::new();
        let mut reads = vec![Vec::new(); count + packs.len()];
        for (number, statement) in program.statements.iter().enumerate() {
            for expression in statement.expressions() {
                expression.each_local(&mut |local| reads[of[number]].extend(defined.get(&local).map(|&by| of[by])));
            }
            defined.extend(statement.defined().into_iter().map(|local| (local, number)));
        }
        Units { of, reads }
    }

    /// Units in an order in which each stands behind what it reads, or one that reads itself.
    fn order(&self) -> Result<Vec<usize>, usize> {
        let mut order = Vec::new();
        // Not seen, begun, done.
        let mut state = vec![0_u8; self.reads.len()];
        for &first in &self.of {
            let mut stack = vec![(first, 0)];
            while let Some((unit, next)) = stack.pop() {
                if state[unit] == 2 {
                    continue;
                }
                state[unit] = 1;
                match self.reads[unit].get(next) {
                    Some(&read) => {
                        stack.push((unit, next + 1));
                        if state[read] == 1 {
                            let circle = stack.iter().rev().take_while(|(other, _)| *other != read);
                            return Err(circle.map(|pair| pair.0).chain([read]).max().unwrap_or(read));
                        }
                        stack.push((read, 0));
                    }
                    None => {
                        state[unit] = 2;
                        order.push(unit);
                    }
                }
            }
        }
        Ok(order)
    }
}

/// A pack that reads what its members give, if there is one.
pub(super) fn circular(program: &Program, packs: &[Pack]) -> Option<usize> {
    let unit = Units::new(program, packs).order().err()?;
    unit.checked_sub(program.statements.len())
}

/// The program with packs in the place of their members.
pub(super) fn ordered(mut program: Program, packs: &[Pack]) -> Program {
    let count = program.statements.len();
    let units = Units::new(&program, packs);
    let Ok(order) = units.order() else { return program };
    let read = read_outside(&program, packs, &units);
    let mut statements = Vec::with_capacity(order.len());
    let mut minus: HashMap<Local, Local> = HashMap::new();
    let mut taken = Taken::new(&program.locals);
    let old_defined: Vec<Vec<Local>> = program.statements.iter().map(Statement::defined).collect();
    let mut old: Vec<Option<Statement>> = std::mem::take(&mut program.statements).into_iter().map(Some).collect();
    for unit in order {
        let Some(pack) = unit.checked_sub(count).map(|number| &packs[number]) else {
            statements.extend(old[unit].take());
            continue;
        };
        statements.push(pack.statement.clone());
        for (which, local) in pack.statement.defined().into_iter().enumerate() {
            let mut members = [None; MEMBERS];
            for (place, number) in pack.members() {
                let own = old[number].as_ref().and_then(|statement| statement.defined().get(which).copied());
                let Some(own) = own.filter(|own| read.contains(own)) else { continue };
                members[place] = Some(own);
                if pack.signs[place] && !broken(Break::LaneSign) {
                    let name = &program.locals[own.0];
                    let name = name.strip_prefix("minus_").map_or(format!("minus_{name}"), str::to_owned);
                    let heading = program.headings.get(own.0).cloned().flatten();
                    program.headings.resize(program.locals.len(), None);
                    program.headings.push(heading);
                    program.locals.push(taken.unused(&name));
                    minus.insert(own, Local(program.locals.len() - 1));
                    members[place] = Some(Local(program.locals.len() - 1));
                }
            }
            if members.iter().any(Option::is_some) {
                statements.push(Statement::Members { size: pack.size, pack: Expression::Local(local), members });
            }
        }
    }
    let places: HashMap<Local, usize> = packs
        .iter()
        .flat_map(Pack::members)
        .flat_map(|(place, number)| old_defined[number].iter().map(move |&local| (local, place)))
        .collect();
    for statement in &mut statements {
        if let Statement::Let { value, .. } = statement {
            halves::halve(value, &places);
        }
    }
    let signed = |local: Local| match minus.get(&local) {
        Some(&minus) => Expression::Neg(Box::new(Expression::Local(minus))),
        None => Expression::Local(local),
    };
    for statement in &mut statements {
        statement.each_expression_mut(&mut |expression| *expression = expression.with_locals(&signed));
    }
    for result in &mut program.results {
        *result = result.with_locals(&signed);
    }
    program.statements = statements;
    program
}

/// Locals that something else than their pack gives away: scalars, results, and packs that are filled with them.
fn read_outside(program: &Program, packs: &[Pack], units: &Units) -> HashSet<Local> {
    let mut read = HashSet::new();
    let scalars = program.statements.iter().enumerate().filter(|(number, _)| units.of[*number] == *number);
    let scalars = scalars.flat_map(|(_, statement)| statement.expressions());
    let filled = packs.iter().flat_map(|pack| pack.statement.expressions());
    for expression in scalars.chain(filled).chain(&program.results) {
        expression.each_local(&mut |local| {
            read.insert(local);
        });
    }
    read
}

/// What names have in common: words that differ become `each`.
pub(super) fn common_name(names: &[&str]) -> String {
    let words: Vec<Vec<&str>> =
        names.iter().map(|name| name.trim_start_matches("minus_").split('_').collect()).collect();
    let Some((first, rest)) = words.split_first() else { return "each".to_owned() };
    if rest.iter().any(|other| other.len() != first.len()) {
        return format!("{}_of_each", first.join("_"));
    }
    let mut common: Vec<&str> = Vec::new();
    for (at, &word) in first.iter().enumerate() {
        let word = if rest.iter().all(|other| other[at] == word) { word } else { "each" };
        if !(word == "each" && common.last() == Some(&"each")) {
            common.push(word);
        }
    }
    let name = common.join("_");
    if common.contains(&"each") { name } else { format!("{name}_of_each") }
}

/// Names that are taken, with the next number of each that was asked for more than once: so many locals get one name that a search
/// from the first number on would take the square of their count.
pub(super) struct Taken {
    names: HashSet<String>,
    next: HashMap<String, usize>,
}

impl Taken {
    pub(super) fn new(names: &[String]) -> Taken {
        Taken { names: names.iter().cloned().collect(), next: HashMap::new() }
    }

    /// The name, with the least number that is free if it is taken.
    pub(super) fn unused(&mut self, name: &str) -> String {
        if self.names.insert(name.to_owned()) {
            return name.to_owned();
        }
        // No name is ever given back, so numbers below the next are taken.
        let next = self.next.entry(name.to_owned()).or_insert(2);
        loop {
            let numbered = format!("{name}_{next}");
            *next += 1;
            if self.names.insert(numbered.clone()) {
                return numbered;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The least free number, whatever was asked for before.
    #[test]
    fn names_get_the_least_number_that_is_free() {
        let names = ["a", "a_3", "b", "b_2"].map(str::to_owned);
        let mut taken = Taken::new(&names);
        let given = ["a", "a", "c", "c", "a_2", "b", "a"].map(|name| taken.unused(name));
        assert_eq!(given, ["a_2", "a_4", "c", "c_2", "a_2_2", "b_3", "a_5"]);
    }
}
