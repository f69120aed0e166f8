//! From expressions to programs: stages, common subexpressions, factoring, schedule, cost.
//!
//! In: the candidates of a derivation. Out: the cheapest of each, compiled.

pub mod angles;
pub mod balance;
pub mod common;
pub mod dag;
pub mod effort;
pub mod factor;
pub mod fields;
pub mod flatten;
mod fold;
pub mod fuse;
mod hints;
mod import;
pub mod linear;
pub mod multiples;
pub mod names;
pub mod order;
pub mod packs;
mod position;
pub mod program;
pub mod schedule;
pub mod stage;
pub mod together;
mod wording;

use crate::contracts::cost::Cost;
use crate::contracts::function::FunctionKind;
use crate::contracts::results::Parts;
use crate::contracts::symbol::Symbol;
use crate::invariant::fault::OrFault;
use crate::invariant::injection::{Break, broken};
use crate::mechanics::limbs::Limbs;
use crate::mechanics::{Derivation, Derived, Inertia};
use crate::symbolic::graph::{Graph, Scalar};
use crate::symbolic::lower::Lowering;
use crate::symbolic::turned::lower_turned;

use dag::Dag;
use position::Together;
use program::{At, Checks, Compiled, FieldId, Function, Program, Rival};
use schedule::Form;

/// Most operations that one function may have before optimisation. A hundred thousand take about seven seconds from the model
/// to its code in an unoptimised build, and rustc takes twenty more in release, with 600 MB.
pub const MOST_OPERATIONS: usize = 200_000;
/// Ways that cost more than this beyond the cheapest are not tried in packs, in hundredths: scalars without vectors run them too.
const MORE_BEFORE_PACKS: u32 = 2;

/// Why a model can't be compiled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The equations are larger than the compiler can take within a reasonable time.
    TooLarge(Excess),
    /// A number in the equations is infinite: a product of literals that is out of range, or a division by what is zero.
    NotFinite,
    /// A function does not have the values of its equations: an error of this compiler.
    Wrong(FunctionKind),
    /// A function of what `Model::at` gives does not have the values of its equations: an error of this compiler.
    WrongAt(FunctionKind),
    /// The tests of parameters do not have the values of their equations: an error of this compiler.
    WrongChecks,
    /// The mass matrix of `System::without_inertia` does not have the values of its equations: an error of this compiler.
    WrongInertia,
    /// A function does not give as many numbers as its type holds: an error of this compiler.
    Misfit(FunctionKind),
    /// The equations of two functions contradict each other: an error of this compiler.
    Contradiction(FunctionKind, FunctionKind),
}

/// What of a model is too large.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Excess {
    /// It has so many coordinates.
    Coordinates(usize),
    /// A function has so many operations before optimisation, more than [`MOST_OPERATIONS`].
    Operations(FunctionKind, usize),
    /// The equations of all functions have more expressions than one graph may hold.
    Expressions,
}

/// Optimises every candidate, takes the cheapest of each function (in packs, where limbs go in packs), and moves parameter work into `Model::new`.
pub fn compile(derivation: &Derivation) -> Result<Compiled, Refusal> {
    compile_with(derivation, Plain::default(), false)
}

/// What is to stand as it was derived, since the optimiser has made it wrong.
#[derive(Clone, Copy, Debug, Default)]
pub struct Plain<'a> {
    /// With them what all functions read of parameters.
    pub functions: &'a [FunctionKind],
    /// `Model::at` and the functions of what it gives.
    pub at: bool,
    /// The tests of parameters.
    pub checks: bool,
}

/// The same with some functions as they were derived, and products fused to sums in the others if so desired.
pub fn compile_with(derivation: &Derivation, plain: Plain<'_>, fused: bool) -> Result<Compiled, Refusal> {
    if derivation.graph.is_full() {
        return Err(Refusal::TooLarge(Excess::Expressions));
    }
    let mut sound = true;
    let mut chosen: Vec<Chosen> = Vec::new();
    let (symbols, symbol_names) = with_numbers(derivation);
    let importer = Importer { derivation, symbols: &symbols, names: &symbol_names };
    let mut members: Vec<Member<'_>> = derivation.at.iter().map(|&kind| Member::new(derivation, kind)).collect();
    for function in &derivation.functions {
        let mut member = members.iter_mut().find(|member| member.derived.kind == function.kind);
        let mut ways: Vec<Chosen> = Vec::new();
        let mut tried: Vec<Rival> = Vec::new();
        let is_plain = plain.functions.contains(&function.kind);
        let limbs = derivation.limbs.as_ref().filter(|_| !is_plain);
        for (candidate, (method, results)) in function.candidates.iter().enumerate() {
            let mut import = |list: &[Scalar]| {
                let Imported { dag, before, size } = importer.import(list);
                if size > MOST_OPERATIONS {
                    return Err(Refusal::TooLarge(Excess::Operations(function.kind, size)));
                }
                let dag = if is_plain { dag } else { importer.optimised(dag, list, &mut sound) };
                Ok((dag, before))
            };
            let apart = !is_plain && !results.apart.is_empty();
            if let Some(member) = &mut member {
                let (dag, before) = import(&results.list)?;
                member.ways.push(dag);
                member.before.push(before);
            }
            let (dag, before) = match &member {
                Some(Member { ways, before, .. }) if !apart => (ways[candidate].clone(), before[candidate]),
                _ => import(if apart { &results.apart } else { &results.list })?,
            };
            tried.push(Rival { method, cost: dag.cost().0 });
            let (kind, parts, rivals) = (function.kind, results.parts.clone(), Vec::new());
            ways.push(Chosen { kind, parts, method, candidate, before, dag, rivals });
            // Only packs ask for more than the cheapest.
            if limbs.is_none() {
                let best = ways.drain(..).min_by_key(|way| way.dag.cost().0.weight());
                ways.extend(best);
            }
        }
        let least = tried.iter().map(|rival| rival.cost.weight()).min().unwrap_or(0);
        let best = match limbs {
            Some(limbs) if ways.len() > 1 => {
                let is_near = |way: &Chosen| {
                    let weight = way.dag.cost().0.weight();
                    !limbs.numbers.is_empty() || 100 * weight <= (100 + MORE_BEFORE_PACKS) * least
                };
                ways.into_iter().filter(is_near).min_by_key(|way| packed_weight(&way.dag, &symbols, limbs))
            }
            _ => ways.pop(),
        };
        chosen.extend(best.map(|mut chosen| {
            tried.remove(chosen.candidate);
            chosen.rivals = tried;
            chosen
        }));
    }
    let together = (!members.is_empty()).then(|| together(derivation, &members, plain.at, &mut sound));
    let dags: Vec<&Dag> = chosen.iter().map(|c| &c.dag).chain(together.as_ref().map(|found| &found.dag)).collect();
    let mut gathered = fields::gather(&dags, &symbols);
    let inertia = inertia(derivation);
    if let Inertia::Own(dag) = &inertia {
        gathered.take_parameters(dag);
    }
    let fields::StoredFields { mut prelude, fields, names } = gathered;
    prelude.symbol_names.clone_from(&symbol_names);
    if plain.functions.is_empty() {
        sound &= simplify(&mut prelude);
    }
    let prelude_cost = prelude.cost().1;
    // What stands as it was derived has no packs either, and every operation by itself.
    let form_of = |kind| match plain.functions.contains(&kind) {
        true => Form { ordered: true, ..Form::default() },
        false => Form { limbs: derivation.limbs.as_ref(), fused, bounded: &[], ordered: true },
    };
    let form = Form { limbs: derivation.limbs.as_ref(), fused, bounded: &[], ordered: true };
    let form = if plain.at { Form { ordered: true, ..Form::default() } } else { form };
    let at = together.map(|found| at(&members, &found, (&fields, &names), form));
    let functions: Vec<Function> = chosen
        .iter()
        .map(|Chosen { kind, parts, method, candidate, before, dag, rivals }| Function {
            kind: *kind,
            parts: parts.clone(),
            program: with_results_broken(schedule::schedule_as(dag, &fields, &names, form_of(*kind))),
            before: *before,
            after: dag.cost().0,
            method,
            candidate: *candidate,
            rivals: rivals.clone(),
        })
        .collect();
    let prelude = schedule::schedule(&prelude, &schedule::Fields::new(), &[]);
    let inertia = match inertia {
        Inertia::Own(dag) => own(schedule::schedule(&dag, &fields, &names)),
        Inertia::Requested => Inertia::Requested,
        Inertia::Regular => Inertia::Regular,
    };
    let checks = checks(derivation, plain.checks, &mut sound);
    let finite = |program: &program::Program| program.literals().all(f64::is_finite);
    let of_at = at.iter().flat_map(|at| at.functions.iter().map(|f| &f.program).chain([&at.program]));
    if !finite(&prelude) || !functions.iter().map(|f| &f.program).chain(of_at).all(finite) {
        return Err(Refusal::NotFinite);
    }
    Ok(Compiled { fields: names, prelude, prelude_cost, functions, at, checks, inertia, sound, unchecked: Vec::new() })
}

/// All symbols of the graph with their names, those too that stand for numbers of limbs, which come behind the others.
fn with_numbers(derivation: &Derivation) -> (Vec<Symbol>, Vec<String>) {
    let (mut symbols, mut names) = (derivation.symbols.clone(), derivation.symbol_names.clone());
    let numbers = derivation.limbs.iter().flat_map(|limbs| limbs.numbers.keys());
    let count = numbers.map(|id| id.0 + 1).max().unwrap_or(0).max(symbols.len());
    for index in 0..count - symbols.len() {
        symbols.push(Symbol::Number { index });
        names.push(format!("number_{index}"));
    }
    (symbols, names)
}

/// What choices between candidates compare where limbs go into packs: what is left of them there.
fn packed_weight(dag: &Dag, symbols: &[Symbol], limbs: &Limbs) -> u32 {
    let fields::StoredFields { fields, names, .. } = fields::gather(&[dag], symbols);
    let form = Form { limbs: Some(limbs), fused: false, bounded: &[], ordered: false };
    packs::weight(&schedule::schedule_as(dag, &fields, &names, form))
}

/// From results as they were derived to DAGs.
struct Importer<'a> {
    derivation: &'a Derivation,
    symbols: &'a [Symbol],
    names: &'a [String],
}

/// Results as they were derived, what they cost, and of how many expressions they are.
struct Imported {
    dag: Dag,
    before: Cost,
    size: usize,
}

impl Importer<'_> {
    fn dag(&self, graph: &Graph, roots: &[Scalar]) -> Dag {
        let mut dag = Dag::import(graph, roots, self.symbols);
        dag.symbol_names = self.names.to_vec();
        dag
    }

    fn import(&self, list: &[Scalar]) -> Imported {
        let mut lowering = Lowering::new(&self.derivation.graph);
        let roots = lowering.run(list);
        let graph = lowering.to;
        Imported { dag: self.dag(&graph, &roots), before: graph.cost(&roots), size: graph.len() }
    }

    /// The same optimised, without a heading where that is cheaper.
    fn optimised(&self, mut dag: Dag, list: &[Scalar], sound: &mut bool) -> Dag {
        *sound &= simplify(&mut dag);
        for turn in &self.derivation.turns {
            let turned = lower_turned(&self.derivation.graph, list, turn);
            let Some((graph, roots)) = turned.filter(|(graph, _)| graph.len() <= MOST_OPERATIONS) else { continue };
            let mut turned = self.dag(&graph, &roots);
            *sound &= simplify(&mut turned);
            if turned.cost().0.weight() < dag.cost().0.weight() {
                dag = turned;
            }
        }
        dag
    }
}

/// A function that is asked for at a position, with all its ways.
struct Member<'d> {
    derived: &'d Derived,
    /// Each optimised for itself.
    ways: Vec<Dag>,
    /// What each costs as it was derived.
    before: Vec<Cost>,
}

impl<'d> Member<'d> {
    fn new(derivation: &'d Derivation, kind: FunctionKind) -> Member<'d> {
        let derived = derivation.functions.iter().find(|derived| derived.kind == kind);
        let derived = derived.or_fault("what is asked for at a position is derived");
        Member { derived, ways: Vec::new(), before: Vec::new() }
    }
}

/// All functions that are asked for at a position in one DAG; as they were derived if `plain`.
fn together(derivation: &Derivation, members: &[Member<'_>], plain: bool, sound: &mut bool) -> Together {
    let importer = Importer { derivation, symbols: &derivation.symbols, names: &derivation.symbol_names };
    let all = |ways: &[usize]| -> Vec<Scalar> {
        let each = members.iter().zip(ways).flat_map(|(member, &way)| &member.derived.candidates[way].1.list);
        each.copied().collect()
    };
    if !plain {
        let functions: Vec<position::Ways> = members.iter().map(|member| member.ways.clone()).collect();
        let found = position::choose(&functions, &derivation.symbols, |ways| {
            let list = all(ways);
            let Imported { dag, size, .. } = importer.import(&list);
            // What is too large for the passes has the work of each function shared as it is.
            (size <= MOST_OPERATIONS).then(|| importer.optimised(dag, &list, sound))
        });
        if let Some(found) = found {
            return found;
        }
        *sound = false;
    }
    let first = vec![0; members.len()];
    let Imported { dag, .. } = importer.import(&all(&first));
    Together::plain(first, dag, members.iter().map(|member| member.derived.candidates[0].1.list.len()))
}

/// Programs of what is known at a position, and of what is left of each function.
fn at(members: &[Member<'_>], found: &Together, (fields, names): (&schedule::Fields, &[String]), form: Form<'_>) -> At {
    let (position, mut late) = found.parts();
    let mut program = schedule::schedule_as(&position, fields, names, form);
    let stored = fields::names_of_roots(&position, &program, names);
    let mut all_fields = fields.clone();
    for (number, &(_, id)) in position.roots.iter().enumerate() {
        let print = position.nodes[id].print;
        let slot = if broken(Break::StoredSlot) { (number + 1) % position.roots.len() } else { number };
        all_fields.insert(print.canonical(), (FieldId(names.len() + slot), print));
    }
    let all_names: Vec<String> = names.iter().chain(&stored).cloned().collect();
    let costs = found.costs();
    let results = std::mem::take(&mut late.roots);
    let functions = members.iter().enumerate().map(|(number, Member { derived, before, .. })| {
        late.roots = results[found.results[number].clone()].to_vec();
        let way = found.ways[number];
        let (method, candidate) = &derived.candidates[way];
        Function {
            kind: derived.kind,
            parts: candidate.parts.clone(),
            program: with_results_broken(schedule::schedule_as(&late, &all_fields, &all_names, form)),
            before: before[way],
            after: costs[number + 1],
            method,
            candidate: way,
            rivals: Vec::new(),
        }
    });
    let functions: Vec<Function> = functions.collect();
    // Which sums must stay plain is known when all their readers are.
    let read = functions.iter().flat_map(|function| fuse::bounded_fields(&function.program));
    let bounded: Vec<usize> = read.filter_map(|field| field.0.checked_sub(names.len())).collect();
    if form.fused && !bounded.is_empty() {
        program = schedule::schedule_as(&position, fields, names, Form { bounded: &bounded, ..form });
    }
    At { functions, fields: stored, program, cost: costs[0] }
}

/// As it came, but for a break.
fn with_results_broken(mut program: Program) -> Program {
    if broken(Break::ResultSlots) {
        program.results.reverse();
    }
    program
}

/// The mass matrix as it was derived: it is computed where a motion has ended, so no pass is worth its time.
fn inertia(derivation: &Derivation) -> Inertia<Dag> {
    let entries = match &derivation.inertia {
        Inertia::Own(entries) => entries,
        Inertia::Requested => return Inertia::Requested,
        Inertia::Regular => return Inertia::Regular,
    };
    let mut lowering = Lowering::new(&derivation.graph);
    let roots = lowering.run(entries);
    if lowering.to.len() > MOST_OPERATIONS {
        return Inertia::Regular;
    }
    let mut dag = Dag::import(&lowering.to, &roots, &derivation.symbols);
    dag.symbol_names.clone_from(&derivation.symbol_names);
    Inertia::Own(dag)
}

/// Nothing is said by numbers that are not finite.
fn own(program: Program) -> Inertia<Program> {
    if program.literals().all(f64::is_finite) { Inertia::Own(program) } else { Inertia::Regular }
}

/// Tests of parameters as a program of their own: what they compute is no field of the model.
fn checks(derivation: &Derivation, plain: bool, sound: &mut bool) -> Checks {
    let tests = &derivation.checks;
    let roots: Vec<Scalar> = tests.iter().flat_map(|test| test.values.iter().copied()).collect();
    let mut lowering = Lowering::new(&derivation.graph);
    let roots = lowering.run(&roots);
    if roots.is_empty() || lowering.to.len() > MOST_OPERATIONS {
        return Checks::default();
    }
    let mut dag = Dag::import(&lowering.to, &roots, &derivation.symbols);
    dag.symbol_names.clone_from(&derivation.symbol_names);
    if !plain {
        *sound &= simplify(&mut dag);
    }
    let program = schedule::schedule(&dag, &schedule::Fields::new(), &[]);
    if !program.literals().all(f64::is_finite) {
        return Checks::default();
    }
    let list = tests.iter().map(|test| (test.what.clone(), test.condition, test.values.len())).collect();
    Checks { program, list }
}

/// The cheapest way to a function.
struct Chosen {
    kind: FunctionKind,
    parts: Parts,
    method: &'static str,
    candidate: usize,
    before: Cost,
    dag: Dag,
    /// The others.
    rivals: Vec<Rival>,
}

/// A rewrite, with its name.
pub type Pass = (&'static str, fn(&mut Dag));

const FIRST: [Pass; 3] = [("angles", angles::angles), ("split", stage::split), ("combine", linear::combine)];
const ROUND: [Pass; 6] = [
    ("factor", factor::factor),
    ("flatten", flatten::flatten),
    ("share", common::share),
    ("balance", balance::balance),
    ("flatten", flatten::flatten),
    ("split", stage::split),
];
const LAST: [Pass; 2] = [("multiples", multiples::multiples), ("share", common::share)];

/// All rewrites of flat expressions in their order, with a fixed number of rounds.
pub fn passes() -> impl Iterator<Item = Pass> {
    rounds(ROUNDS)
}

const ROUNDS: usize = 3;

fn rounds(count: usize) -> impl Iterator<Item = Pass> {
    FIRST.into_iter().chain([ROUND; ROUNDS].into_iter().take(count).flatten()).chain(LAST)
}

/// Expressions of a function, beyond which it has one round: further ones have saved less than a thousandth there.
const LARGE: usize = 40_000;

/// All rewrites. Each pass pays by its own count, not always by the whole: what costs more than what went in is given
/// back as it came. What would not have the same value is done again without the passes that change it, and the answer is
/// `false`: such a pass has an error, or drops what cancels up to rounding and not exactly.
pub fn simplify(dag: &mut Dag) -> bool {
    let before = dag.clone();
    flatten::flatten(dag);
    let mut derived = dag.clone();
    let expected = before.root_prints();
    let count = if dag.order().len() > LARGE { 1 } else { ROUNDS };
    for (_, rewrite) in rounds(count) {
        rewrite(dag);
    }
    let sound = dag.is_sound(&expected);
    if !sound {
        derived = before;
        dag.clone_from(&derived);
        for (_, rewrite) in rounds(count) {
            let last = dag.clone();
            rewrite(dag);
            if !dag.is_sound(&expected) {
                *dag = last;
            }
        }
    }
    if dag.cost().0.weight() > derived.cost().0.weight() {
        *dag = derived;
    }
    sound
}
