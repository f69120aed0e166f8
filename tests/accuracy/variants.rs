//! The programs of a model, each optimisation on and off.
//!
//! *All* is what is emitted. *None* has every function as it was derived, the parameters' work too. *Fused* has one rounding for a
//! product and a sum, *packs* limbs in packs of four, where any pay. *No* and the name of a pass is a function without that pass (`factor`, `multiples`, `balance`, `share`,
//! ..), in one program without fields of the model. Statements in another order and sines in groups change no operation:
//! what is emitted has them.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::results::Parts;
use multibody_engine::mechanics::Derivation;
use multibody_engine::mechanics::limbs::Limbs;
use multibody_engine::model::types::Model;
use multibody_engine::optimize::dag::Dag;
use multibody_engine::optimize::program::{Compiled, Function, Program};
use multibody_engine::optimize::schedule::{Fields, schedule};
use multibody_engine::optimize::{Plain, compile_with, flatten, packs, passes};
use multibody_engine::symbolic::graph::Scalar;
use multibody_engine::symbolic::lower::Lowering;

/// Passes that are left out, one by one.
pub(crate) const PASSES: [&str; 8] =
    ["angles", "split", "combine", "factor", "flatten", "share", "balance", "multiples"];

/// A function and the equations that it was made of.
pub(crate) struct Subject {
    pub(crate) kind: FunctionKind,
    /// Whether it goes on from what is done once for a position.
    pub(crate) at: bool,
    pub(crate) parts: Parts,
    candidate: usize,
    pub(crate) programs: Vec<Variant>,
}

/// A function's programs.
pub(crate) struct Variant {
    pub(crate) name: String,
    /// Which runs before and gives the fields that `last` reads, if any does; each reads what those before it gave.
    pub(crate) first: Vec<Program>,
    pub(crate) last: Program,
}

impl Subject {
    /// Results as they were derived.
    pub(crate) fn roots<'d>(&self, derivation: &'d Derivation) -> &'d [Scalar] {
        let derived = derivation.functions.iter().find(|derived| derived.kind == self.kind);
        &derived.expect("what is compiled was derived").candidates[self.candidate].1.list
    }
}

/// All functions of a model that `keeps` says. Each has all passes left out one by one if `thorough`, else one of them.
pub(crate) fn subjects(
    model: &Model,
    derivation: &mut Derivation,
    keeps: &dyn Fn(FunctionKind) -> bool,
    thorough: bool,
) -> Vec<Subject> {
    let kinds: Vec<FunctionKind> = derivation.functions.iter().map(|function| function.kind).collect();
    let plain = Plain { functions: &kinds, at: true, checks: true };
    let mut subjects: Vec<Subject> = Vec::new();
    let whole = Plain::default();
    for (name, plain, fused) in
        [("all", whole, false), ("none", plain, false), ("fused", whole, true), ("packs", whole, false)]
    {
        derivation.limbs = (name == "packs").then(|| Limbs::of(model));
        let compiled = compile_with(derivation, plain, fused).expect("models of the ledger are not too large");
        let behind = compiled.at.iter().flat_map(|at| &at.functions).map(|function| (function, true));
        for (function, at) in compiled.functions.iter().map(|function| (function, false)).chain(behind) {
            let is_other = name != "packs" || packs::operations(&function.program).is_some();
            if keeps(function.kind) && is_other {
                add(&mut subjects, function, at, variant(name, &compiled, at, function));
            }
        }
    }
    for (number, subject) in subjects.iter_mut().filter(|subject| !subject.at).enumerate() {
        for (k, pass) in PASSES.into_iter().enumerate() {
            if thorough || number % PASSES.len() == k {
                let last = without(pass, derivation, subject.roots(derivation));
                subject.programs.push(Variant { name: format!("no {pass}"), first: Vec::new(), last });
            }
        }
    }
    subjects
}

fn variant(name: &str, compiled: &Compiled, at: bool, function: &Function) -> Variant {
    let position = compiled.at.iter().filter(|_| at).map(|at| &at.program);
    let first = [&compiled.prelude].into_iter().chain(position).cloned().collect();
    Variant { name: name.to_owned(), first, last: function.program.clone() }
}

fn add(subjects: &mut Vec<Subject>, function: &Function, at: bool, variant: Variant) {
    let (kind, candidate) = (function.kind, function.candidate);
    match subjects.iter_mut().find(|subject| (subject.kind, subject.at, subject.candidate) == (kind, at, candidate)) {
        Some(subject) => subject.programs.push(variant),
        None => {
            let parts = function.parts.clone();
            subjects.push(Subject { kind, at, parts, candidate, programs: vec![variant] });
        }
    }
}

/// What the optimiser makes without one of its passes.
fn without(pass: &str, derivation: &Derivation, roots: &[Scalar]) -> Program {
    let mut lowering = Lowering::new(&derivation.graph);
    let roots = lowering.run(roots);
    let mut dag = Dag::import(&lowering.to, &roots, &derivation.symbols);
    dag.symbol_names.clone_from(&derivation.symbol_names);
    flatten::flatten(&mut dag);
    passes().filter(|(name, _)| *name != pass).for_each(|(_, rewrite)| rewrite(&mut dag));
    schedule(&dag, &Fields::new(), &[])
}
