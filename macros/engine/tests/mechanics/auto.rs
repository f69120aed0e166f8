//! `constraints: Auto` stands for the choice that costs less, as the programs of both choices show.

use multibody_engine::contracts::cost::Cost;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::mechanics::loops::advice::{Advice, Closing};
use multibody_engine::mechanics::loops::structure::Structure;
use multibody_engine::model::types::Model;
use multibody_engine::optimize::program::{Compiled, Function, Statement};
use multibody_engine::{Trouble, compile, emit};

use super::support::model_of;

const FOUR_BAR: &str = "world { gravity: -9.81 * Y }
    body crank { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
    body coupler { mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) }
    body rocker { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
    joint shaft: Revolute { parent: ground, child: crank, axis: Z }
    joint knee: Revolute { parent: crank.at(X), child: coupler, axis: Z }
    joint pivot: Revolute { parent: ground.at(4.0 * X), child: rocker, axis: Z }
    #[cut] joint pin: Revolute { parent: coupler.at(3.5 * X), child: rocker.at(3.0 * X), axis: Z }";

const SOLVED: &str = "solve (knee, pivot) from pin { sin(pivot - shaft - knee) > 0.0 }";

/// A slider whose rod Newton's method finds in a round of one equation, beside six equations of a hinge in space.
const LEVER: &str =
    "body lever { mass: 1.0, com: 0.5 * X, inertia: diag(0.1, 0.2, 0.3), coordinates: Absolute(RollPitchYaw) }
    joint hinge: Revolute { parent: ground, child: lever, axis: Z }";

fn text(items: &str, formulation: &str) -> String {
    format!("{items} formulation {{ {formulation} }}")
}

fn built(items: &str, formulation: &str) -> (Model, Structure, Compiled) {
    let model = model_of(&text(items, formulation));
    match compile(&model) {
        Ok((structure, compiled)) => (model, structure, compiled),
        Err(Trouble::Complaints(list)) => panic!("{}: {}", formulation, list[0].message),
        Err(_) => panic!("{formulation} is refused"),
    }
}

/// What is printed, without the report.
fn code(items: &str, formulation: &str) -> String {
    let (model, mut structure, compiled) = built(items, formulation);
    structure.advice = None;
    emit::source(&emit::emit(&model, &structure, &compiled))
}

fn forward(compiled: &Compiled) -> &Function {
    compiled.functions.iter().find(|function| function.kind == FunctionKind::ForwardDynamics).unwrap()
}

fn advice(items: &str, formulation: &str) -> (Structure, Advice) {
    let (_, structure, _) = built(items, formulation);
    let advice = structure.advice.clone().expect("a choice");
    (structure, *advice)
}

/// The code is that of the choice, whatever the coordinates.
#[test]
fn it_is_what_it_stands_for() {
    let closed = format!("{FOUR_BAR} {SOLVED}");
    for (items, coordinates, word) in [
        (closed.as_str(), "", "Reduced"),
        (closed.as_str(), "coordinates: Absolute(RollPitchYaw),", "Multipliers"),
        (FOUR_BAR, "coordinates: Joint,", "Multipliers"),
        (FOUR_BAR, "coordinates: Absolute(Quaternion),", "Multipliers"),
    ] {
        let [chosen, auto] = [word, "Auto"].map(|word| code(items, &format!("{coordinates} constraints: {word}")));
        assert_eq!(chosen, auto, "{coordinates}");
    }
    // Tokens decide, and nothing else.
    let [one, other] = [(); 2].map(|()| code(&closed, "constraints: Auto"));
    assert_eq!(one, other);
}

/// Operations of forward dynamics, weighed anew: what is compiled says whether the choice is right.
#[test]
fn the_cheaper_one_is_taken() {
    let closed = format!("{FOUR_BAR} {SOLVED}");
    let (structure, of_closed) = advice(&closed, "constraints: Auto");
    assert!(structure.rows.is_empty() && structure.guesses() == 0);
    assert_eq!(of_closed.own.unwrap().closing, Closing::ClosedForm);
    let (structure, held) = advice(FOUR_BAR, "constraints: Auto");
    assert_eq!((structure.rows.len(), structure.guesses()), (2, 0));
    assert!(held.is_chosen && held.is_forward);
    // Newton's method is counted with all rounds, each of which has as many operations as the loop's body.
    let Some(Ok(iterated)) = &held.other else { panic!("Newton's method is refused") };
    assert_eq!(iterated.closing, Closing::Newton);
    let (_, _, compiled) = built(FOUR_BAR, "constraints: Reduced");
    let function = forward(&compiled);
    let rounds = function.program.statements.iter().find_map(|statement| match statement {
        Statement::Iterate { count, .. } => Some(*count as u32),
        _ => None,
    });
    let (rounds, one, all) = (rounds.unwrap(), function.after, iterated.operations);
    assert!(rounds > 1 && all.mul > one.mul && all.mul <= rounds * one.mul, "{rounds}: {one:?} {all:?}");
    assert_eq!(all.sincos, one.sincos, "sines of the guess are taken once");
    assert!(iterated.work > held.own.unwrap().work);
    // Without iterations the counts are those of the programs.
    let count = |word: &str, items: &str| forward(&built(items, &format!("constraints: {word}")).2).after;
    assert_eq!(of_closed.own.unwrap().operations, count("Reduced", &closed));
    assert_eq!(held.own.unwrap().operations, count("Multipliers", FOUR_BAR));
    assert_ne!(held.own.unwrap().operations, Cost::default());
}

/// What stands beside forward dynamics is not counted, groups of outputs neither.
#[test]
fn groups_of_outputs_change_no_choice() {
    let items =
        format!("{FOUR_BAR} {SOLVED} output tip = rocker.position; emit forward_dynamics, outputs {{ one: [tip] }};");
    let (structure, advice) = advice(&items, "constraints: Auto");
    assert!(structure.rows.is_empty() && structure.guesses() == 0);
    assert_eq!(advice.own.unwrap().closing, Closing::ClosedForm);
}

/// Newton's method is taken where it costs less: six legs in a platform couple all equations of multipliers, and are found apart.
#[test]
fn iterations_that_cost_less() {
    let feet = [[-2.12, 1.374], [-2.38, 1.224], [-2.38, -1.224], [-2.12, -1.374], [0.0, -0.15], [0.0, 0.15]];
    let pins = [[0.17, 0.595], [-0.6, 0.15], [-0.6, -0.15], [0.17, -0.595], [0.43, -0.445], [0.43, 0.445]];
    let legs = feet.iter().zip(pins).enumerate().map(|(k, (foot, pin))| {
        let [[fx, fy], [px, py]] = [*foot, pin];
        format!(
            "body cylinder_{k} {{ mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }}
             body piston_{k} {{ mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }}
             joint gimbal_{k}: Universal {{ parent: ground.at([{fx:?}, {fy:?}, 0.0]), child: cylinder_{k}, axes: [X, Y] }}
             joint stroke_{k}: Prismatic {{ parent: cylinder_{k}.at(Z), child: piston_{k}, axis: Z }}
             #[cut] joint ball_{k}: Ball {{ parent: piston_{k}, child: plate.at([{px:?}, {py:?}, -0.4]) }} "
        )
    });
    let legs: String = legs.collect();
    let plate = "body plate { mass: 1.5, inertia: diag(0.08, 0.08, 0.08), coordinates: Absolute(RollPitchYaw) }";
    let (structure, advice) = advice(&format!("{plate} {legs}"), "constraints: Auto");
    assert_eq!((structure.rows.len(), structure.guesses()), (0, 18));
    let (own, other) = (advice.own.unwrap(), advice.other.unwrap().unwrap());
    assert_eq!([own.closing, other.closing], [Closing::Newton, Closing::Multipliers]);
    assert!(own.work < other.work, "{own:?} {other:?}");
}

/// A choice that is refused is not taken, and the report says why.
#[test]
fn what_is_refused_is_not_taken() {
    let formulation = "coordinates: Absolute(Quaternion), constraints: Auto";
    let (structure, advice) = advice(LEVER, formulation);
    assert_eq!(structure.rows.len(), 5);
    let Some(Err(reason)) = &advice.other else { panic!("nothing is refused") };
    let refused = match compile(&model_of(&text(LEVER, &formulation.replace("Auto", "Reduced")))) {
        Err(Trouble::Complaints(list)) => list[0].message.clone(),
        _ => panic!("a quaternion follows"),
    };
    assert_eq!(reason, &refused);
    let (model, structure, compiled) = built(LEVER, formulation);
    let report = emit::report(&model, &structure, &compiled);
    assert!(report.contains(&format!("`Reduced` is refused, since {refused}")), "{report}");
}

/// Outputs that one choice alone can give decide for that one; what is wrong in both is told as of multipliers.
#[test]
fn what_is_asked_for_decides() {
    let items = format!("{FOUR_BAR} {SOLVED} output pull = constraint[pin.x];");
    let refused = compile(&model_of(&text(&items, "constraints: Multipliers"))).is_err();
    assert!(!refused);
    let reduced = compile(&model_of(&text(&items, "constraints: Reduced"))).is_ok();
    let (structure, _) = advice(&items, "constraints: Auto");
    assert_eq!(structure.rows.is_empty(), reduced);
    let wrong = format!("{FOUR_BAR} drive shaft = t; drive knee = t; drive pivot = t;");
    let told = |word: &str| match compile(&model_of(&text(&wrong, &format!("constraints: {word}")))) {
        Err(Trouble::Complaints(list)) => list.into_iter().map(|one| one.message).collect::<Vec<_>>(),
        _ => panic!("nothing is left to move"),
    };
    assert_eq!(told("Auto"), told("Multipliers"));
}

/// Without loops nothing is chosen and nothing said.
#[test]
fn without_loops_there_is_no_choice() {
    let items = "body arm { mass: 1.0, com: X } joint hinge: Revolute { parent: ground, child: arm, axis: Z }";
    let (model, structure, compiled) = built(items, "constraints: Auto");
    assert!(structure.advice.is_none());
    assert!(!emit::report(&model, &structure, &compiled).contains("Auto"));
}
