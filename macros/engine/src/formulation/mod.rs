//! Stage `formulation`: what loops cost in one way and in another.
//!
//! In: a checked model. Out: what `constraints: Auto` and `speeds: Auto` stand for, and what is told of the choices. Forward dynamics decides: it is
//! derived with dependent coordinates eliminated and with multipliers, and both programs are counted with all rounds of iterations
//! and with weights that are fitted to times ([`crate::optimize::effort`]). A closed form is taken where it costs about as much as
//! multipliers, since then loops cannot drift; Newton's method only where it costs less.

mod assumable;
mod closable;
mod sides;
mod solvable;
mod speeds;
mod wording;

use crate::contracts::cost::Cost;
use crate::contracts::function::{Asked, FunctionKind};
use crate::invariant::fault::{Fault, guard};
use crate::mechanics;
use crate::mechanics::loops::advice::{Advice, Closing, Figures};
use crate::mechanics::loops::structure::Structure;
use crate::model::types::{Handling, Model, Request, SpeedChoice};
use crate::optimize::effort::Effort;
use crate::optimize::program::Compiled;
use crate::optimize::{self, Refusal};

pub use speeds::with_speeds;

/// What `Auto` stands for, the better choice first, and why; without loops there is nothing to choose.
pub fn choose(model: &Model) -> ([Handling; 2], Option<Advice>) {
    let (reduced, held) = (Handling::Reduced, Handling::Multipliers);
    if !has_loops(model) {
        return ([held, reduced], None);
    }
    let figures = [&reduced, &held].map(|handling| figures_anew(model, handling));
    let [of_reduced, of_held] = &figures;
    let reduces = match (of_reduced, of_held) {
        (Ok(reduced), Ok(held)) => reduced.reduces(held),
        (found, _) => found.is_ok(),
    };
    let (is_chosen, is_forward) = (true, asks_forward(model));
    let [reduced_figures, held_figures] = figures;
    let (handlings, own, other) = match reduces {
        true => ([reduced, held], reduced_figures, held_figures),
        false => ([held, reduced], held_figures, reduced_figures),
    };
    let (assumable, solvable) = Default::default();
    let advice = Advice { is_chosen, is_forward, own: own.ok(), other: Some(other), assumable, solvable };
    (handlings, Some(advice))
}

/// What the choice that was made costs, beside the other one, and what could be assumed for it; nothing of models without loops.
pub fn advice(model: &Model, structure: &Structure, compiled: &Compiled) -> Option<Advice> {
    if !has_loops(model) {
        return None;
    }
    let is_forward = asks_forward(model);
    let own = counted(structure, compiled, is_forward);
    let assumable = assumable::assumable(model, &own);
    // Where the choice was the compiler's, both are known, and closed forms may speak for the one that was not taken.
    if let Some(chosen) = &structure.advice {
        let other = chosen.other.as_ref().and_then(|other| other.as_ref().ok());
        let newton = other.filter(|other| own.closing == Closing::Multipliers && other.closing == Closing::Newton);
        let reduced = || Model { handling: Handling::Reduced, ..model.clone() };
        let solvable = match newton {
            Some(other) => solvable::solvable(&reduced(), other),
            None => solvable::solvable(model, &own),
        };
        return Some(Advice { assumable, solvable, ..(**chosen).clone() });
    }
    let solvable = solvable::solvable(model, &own);
    let other = match model.handling {
        Handling::Reduced => Handling::Multipliers,
        Handling::Multipliers | Handling::Stabilised { .. } | Handling::Auto => Handling::Reduced,
    };
    let other = Some(figures_anew(model, &other));
    Some(Advice { is_chosen: false, is_forward, own: Some(own), other, assumable, solvable })
}

fn has_loops(model: &Model) -> bool {
    !model.cuts.is_empty() || !model.constraints.is_empty()
}

fn asks_forward(model: &Model) -> bool {
    model.emit.contains(&Request::ForwardDynamics)
}

/// What a model takes with its loops closed in one way. Speeds that were chosen for another may be too few: they are chosen again.
fn figures_anew(model: &Model, handling: &Handling) -> Result<Figures, String> {
    if model.speed_choice != SpeedChoice::Made {
        return figures(model, handling);
    }
    let (speeds, handling) = (Vec::new(), handling.clone());
    let open = with_speeds(&Model { speeds, speed_choice: SpeedChoice::Open, handling, ..model.clone() });
    figures(&open, &open.handling)
}

/// What a model takes with its loops closed in one way, or why it is refused.
fn figures(model: &Model, handling: &Handling) -> Result<Figures, String> {
    let model = judged(model, handling);
    // A choice that nobody has made stands in nobody's way.
    let failed = |fault: Fault| {
        format!("the stage `{}` has failed, which is an error of multibody: {}", fault.stage, fault.what)
    };
    let derived = guard("mechanics", || mechanics::of(&model)).map_err(failed)?;
    let (structure, mut derivation) = derived.map_err(|complaints| match complaints.into_iter().next() {
        Some(complaint) => complaint.message,
        None => "the model is not what was written".to_owned(),
    })?;
    // Nothing else is counted.
    let is_forward = asks_forward(&model);
    derivation.functions.retain(|function| counts(function.kind, is_forward));
    let compiled = guard("optimize", || optimize::compile(&derivation)).map_err(failed)?.map_err(refused)?;
    Ok(counted(&structure, &compiled, is_forward))
}

fn counts(kind: FunctionKind, is_forward: bool) -> bool {
    match kind.row().asked {
        _ if is_forward => kind == FunctionKind::ForwardDynamics,
        Asked::By { .. } | Asked::Outputs => true,
        Asked::Equations | Asked::Speeds | Asked::Guesses | Asked::Found => false,
    }
}

/// Of forward dynamics alone, or of all that was asked for.
fn counted(structure: &Structure, compiled: &Compiled, is_forward: bool) -> Figures {
    let functions = compiled.functions.iter().filter(|function| counts(function.kind, is_forward));
    let efforts = functions.map(Effort::of);
    let (mut operations, mut work) = (Cost::default(), 0_u32);
    for effort in efforts {
        operations = operations.plus(effort.operations());
        work = work.saturating_add(effort.work());
    }
    Figures { closing: Closing::of(structure), operations, work }
}

/// The model with what is counted, and nothing else.
fn judged(model: &Model, handling: &Handling) -> Model {
    let mut judged = Model { handling: handling.clone(), at: Vec::new(), ..model.clone() };
    if asks_forward(model) {
        judged.emit = vec![Request::ForwardDynamics];
        judged.outputs.clear();
        judged.output_groups.clear();
        judged.kinematics.clear();
        judged.assembly = None;
        judged.solve_for.clear();
    } else {
        judged.emit.retain(|request| !matches!(request, Request::Report | Request::Equations | Request::At));
    }
    judged.asked.retain(|asked| judged.emit.contains(&asked.0));
    judged
}

fn refused(refusal: Refusal) -> String {
    match refusal {
        Refusal::TooLarge(_) => "its equations are too large",
        Refusal::NotFinite => "its equations hold a number that is not finite",
        _ => "it cannot be compiled",
    }
    .to_owned()
}
