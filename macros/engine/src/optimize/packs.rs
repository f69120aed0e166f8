//! Stage `optimize`, on a program: what limbs do alike is done for four of them at a time, or for two.
//!
//! In: statements in the order in which results need them, with sines one by one, and which coordinates belong to limbs that are
//! alike. Out: the same with statements on *packs*, each with a member for every limb, and with members taken out where
//! something else reads them. An operation on a pack is the operation on each of its members, so `verify` runs the program as
//! it is, and values differ from those without packs by the order of terms and factors alone, which is that of the first limb.
//!
//! `likeness` finds statements that do the same work, `unify` makes one expression of them, `worth` keeps what pays, `order`
//! puts all in a row. Sums over several limbs stay scalar; what a limb has in them is taken out first (`parted`), so
//! that only additions are left there. Nothing of this can make a program wrong: an expression of a pack is put together from what its
//! members compute, whatever proposed them.
//!
//! The idea is that of superword-level parallelism (Larsen and Amarasinghe, PLDI 2000), on statements whose likeness is known from the
//! mechanism, where a compiler looks for neighbours in memory.

mod halves;
mod likeness;
mod order;
mod unify;
mod worth;

use std::collections::{BTreeSet, HashMap, HashSet};

use crate::invariant::injection::{Break, broken};
use crate::mechanics::limbs::Limbs;

use likeness::{Likeness, Owner};
use order::{Pack, Taken};

use super::program::{Expression, Local, MEMBERS, Program, Sine, Size, Statement};
use unify::{Packed, Unifier};

/// Rounds in which what limbs have in common sums is taken out; each may tell limbs apart that the one before has not.
const ROUNDS: usize = 3;

/// Fewer are no faster in packs of four: without `target-cpu` a vector of x86-64 holds two `f64`, so two of four members are filled up
/// for nothing.
const LEAST: usize = 3;

/// The program with packs; as it came where they don't pay.
pub fn pack(program: Program, limbs: &Limbs) -> Program {
    let counts = Likeness::counts_without(&program.statements, limbs);
    let with: Vec<Option<usize>> = if counts.is_empty() { vec![None] } else { counts.into_iter().map(Some).collect() };
    let packed = with.into_iter().filter_map(|without| packed(&program, limbs, without));
    packed.min_by_key(weight).unwrap_or(program)
}

/// The program with packs of limbs that have coordinates, and of so many that have none; nothing where they don't pay.
fn packed(program: &Program, limbs: &Limbs, without: Option<usize>) -> Option<Program> {
    let mut parted = program.clone();
    for _ in 0..ROUNDS {
        if !part(&mut parted, limbs, without) {
            break;
        }
    }
    let likeness = Likeness::new(&parted.statements, limbs, without);
    let mut places = proposed(&likeness);
    loop {
        let found = packs(&mut parted.clone(), &likeness, &places);
        let kept = worth::kept(&parted, &found);
        let circular = order::circular(&parted, &found);
        let keep: Vec<_> = found
            .iter()
            .enumerate()
            .filter(|(number, _)| kept.contains(number) && Some(*number) != circular)
            .map(|(_, pack)| (pack.size, pack.statements))
            .collect();
        if keep.len() == places.len() {
            break;
        }
        places = keep;
    }
    let found = packs(&mut parted, &likeness, &places);
    worth::pays(program, &parted, &found).then(|| order::ordered(parted, &found))
}

/// What a program with packs or without them costs, in additions: for choices between ways to the same function.
pub fn weight(program: &Program) -> u32 {
    worth::weight(program)
}

/// Operations of a program on packs, and on scalars, by one round of iterations; nothing where there are no packs.
pub fn operations(program: &Program) -> Option<[usize; 2]> {
    let (mut packed, mut scalar) = (0, 0);
    for statement in &program.statements {
        let own = match statement {
            Statement::SinCos(sines) => sines.len(),
            Statement::PackSines(..) => 1,
            _ => 0,
        };
        let count = own + statement.expressions().map(worth::operations).sum::<usize>();
        match statement {
            Statement::Pack { .. } | Statement::PackSines(..) => packed += count,
            _ => scalar += count,
        }
    }
    let results: usize = program.results.iter().map(worth::operations).sum();
    (packed > 0).then_some([packed, scalar + results])
}

/// Statements for a pack, each at the place of its limb.
type Places = (Size, [Option<usize>; MEMBERS]);

/// Groups of statements, four limbs at a time: the last two of six limbs, and limbs that are two, are a pack of two.
fn proposed(likeness: &Likeness<'_>) -> Vec<Places> {
    let mut limbs: HashMap<usize, usize> = HashMap::new();
    for limb in likeness.groups.iter().flat_map(|group| group.keys()) {
        let count = limbs.entry(limb.set).or_default();
        *count = (*count).max(limb.number + 1);
    }
    let mut found = Vec::new();
    for group in &likeness.groups {
        let count = group.keys().next().map_or(0, |limb| limbs[&limb.set]);
        let chunks: BTreeSet<usize> = group.keys().map(|limb| limb.number / MEMBERS).collect();
        for chunk in chunks {
            let mut places = [None; MEMBERS];
            for (limb, &statement) in group.iter().filter(|(limb, _)| limb.number / MEMBERS == chunk) {
                places[limb.number % MEMBERS] = Some(statement);
            }
            // Chunks are of limbs that there are, so at least one is left.
            let size = if count - MEMBERS * chunk == 2 { Size::Two } else { Size::Four };
            let enough = size == Size::Two || group.len() >= LEAST;
            if enough && places.iter().flatten().count() > 1 {
                found.push((size, places));
            }
        }
    }
    found
}

/// These statements as packs, what they read before them; those that are not alike after all are left out. Locals of packs
/// are added to the program.
fn packs(program: &mut Program, likeness: &Likeness<'_>, places: &[Places]) -> Vec<Pack> {
    let mut packed = Packed::new();
    let mut found = Vec::new();
    let mut taken = Taken::new(&program.locals);
    for &(size, statements) in places {
        let members: Vec<(usize, &Statement)> = statements
            .iter()
            .enumerate()
            .filter_map(|(place, number)| Some((place, program.statements.get((*number)?)?)))
            .collect();
        let unifier = Unifier { likeness, packed: &packed, size };
        let expressions = members.iter().filter_map(|&(place, statement)| match statement {
            Statement::Let { value, .. } => Some((place, value)),
            Statement::SinCos(sines) => sines.first().map(|sine| (place, &sine.angle)),
            _ => None,
        });
        let expressions: Vec<(usize, &Expression)> = expressions.collect();
        let defined: Vec<(usize, Vec<Local>)> =
            members.iter().map(|&(place, statement)| (place, statement.defined())).collect();
        let is_sine = matches!(members.first(), Some((_, Statement::SinCos(_))));
        let (value, signs) = match is_sine {
            true => match unifier.unsigned(&expressions) {
                Some(angle) => (angle, [false; MEMBERS]),
                None => continue,
            },
            false => match unifier.unify(&expressions) {
                Some(value) => (value.expression, value.signs),
                None => continue,
            },
        };
        let mut local = |which: usize| {
            let names: Vec<&str> =
                defined.iter().filter_map(|(_, locals)| Some(program.locals[locals.get(which)?.0].as_str())).collect();
            let name = taken.unused(&order::common_name(&names));
            let heading = defined.first().and_then(|(_, locals)| program.headings.get(locals.get(which)?.0).cloned());
            program.headings.resize(program.locals.len(), None);
            program.headings.push(heading.flatten());
            program.locals.push(name);
            Local(program.locals.len() - 1)
        };
        let locals: Vec<Local> = (0..if is_sine { 2 } else { 1 }).map(&mut local).collect();
        let statement = match locals[..] {
            [sin, cos] => Statement::PackSines(size, Sine { sin, cos, angle: value }),
            _ => Statement::Pack { size, local: locals[0], value },
        };
        for (place, own) in defined {
            for (&own, &pack) in own.iter().zip(&locals) {
                packed.insert(own, (size, pack, place, signs));
            }
        }
        found.push(Pack { size, statements, statement, signs });
    }
    found
}

/// Takes out what one limb has in values of several, as statements of their own; whether there was anything.
fn part(program: &mut Program, limbs: &Limbs, without: Option<usize>) -> bool {
    let likeness = Likeness::new(&program.statements, limbs, without);
    let mut names: HashSet<String> = program.locals.iter().cloned().collect();
    let mut statements = Vec::with_capacity(program.statements.len());
    let mut added: Vec<(String, Option<std::sync::Arc<str>>)> = Vec::new();
    let first = program.locals.len();
    let mut any = false;
    for (number, mut statement) in std::mem::take(&mut program.statements).into_iter().enumerate() {
        if let (Owner::Several, Statement::Let { local, value }) = (likeness.owners[number], &mut statement) {
            let mut parts = Vec::new();
            let name = program.locals[local.0].trim_start_matches("minus_").to_owned();
            let heading = program.headings.get(local.0).cloned().flatten();
            take_parts(&likeness, value, &mut |part| {
                if broken(Break::LostShare) && parts.len() == 1 {
                    return Expression::Literal(0.0);
                }
                let mut number = 1;
                while names.contains(&format!("{name}_part_{number}")) {
                    number += 1;
                }
                names.insert(format!("{name}_part_{number}"));
                let local = Local(first + added.len());
                added.push((format!("{name}_part_{number}"), heading.clone()));
                parts.push(Statement::Let { local, value: part });
                Expression::Local(local)
            });
            any |= !parts.is_empty();
            statements.extend(parts);
        }
        statements.push(statement);
    }
    program.statements = statements;
    program.headings.resize(first, None);
    for (name, heading) in added {
        program.locals.push(name);
        program.headings.push(heading);
    }
    any
}

/// Replaces the largest parts that belong to one limb and have operations.
fn take_parts(likeness: &Likeness<'_>, value: &mut Expression, take: &mut dyn FnMut(Expression) -> Expression) {
    let is_work = matches!(value, Expression::Sum(_) | Expression::Product(_) | Expression::Quotient(..));
    match likeness.owner(value) {
        Owner::Limb(_) if is_work && likeness.signature(value).is_some() => {
            let part = std::mem::replace(value, Expression::Literal(0.0));
            *value = take(part);
        }
        Owner::Several => match value {
            Expression::Neg(inner) => take_parts(likeness, inner, take),
            Expression::Sum(terms) => terms.iter_mut().for_each(|(_, term)| take_parts(likeness, term, take)),
            Expression::Product(list) => list.iter_mut().for_each(|factor| take_parts(likeness, factor, take)),
            Expression::Quotient(above, below) => {
                [above, below].into_iter().for_each(|part| take_parts(likeness, part, take));
            }
            _ => {}
        },
        Owner::Limb(_) | Owner::Nobody => {}
    }
}
