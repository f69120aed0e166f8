//! Packs of limbs in every model of the project: the check finds nothing wrong with them, and tells of one that is.

use std::collections::HashMap;

use crate::corpus;
use crate::interpreter;
use crate::rng::Rng;
use multibody_engine::contracts::call::Call;
use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::model::types::{Model, Packs};
use multibody_engine::optimize::program::{Compiled, Expression, Size, Statement};
use multibody_engine::{mechanics, optimize, verify};

fn is_packed(compiled: &Compiled) -> bool {
    let is_pack = |statement: &Statement| matches!(statement, Statement::Pack { .. } | Statement::PackSines(..));
    compiled.functions.iter().any(|function| function.program.statements.iter().any(is_pack))
}

#[test]
fn no_model_of_the_project_is_wrong() {
    let only = std::env::var("VERIFY_ONLY").unwrap_or_default();
    let (mut packed, mut complaints) = (0, Vec::new());
    for (file, call) in corpus::calls() {
        for model in corpus::models(call) {
            let name = format!("{file} {}", model.name);
            if !name.contains(&only) {
                continue;
            }
            let model = Model { packs: Packs::Four, ..model };
            let Ok((structure, derivation)) = mechanics::of(&model) else { continue };
            let compiled = optimize::compile(&derivation).unwrap();
            if !is_packed(&compiled) {
                continue;
            }
            packed += 1;
            println!("{name}");
            let found = verify::check(&model, &structure, &derivation, &compiled);
            if !found.wrong.is_empty() || found.broken.is_some() || !found.unchecked.is_empty() {
                complaints.push(format!("{name}: {found:?}"));
            }
        }
    }
    assert!(complaints.is_empty(), "{complaints:#?}");
    assert!(packed >= 10 || !only.is_empty(), "{packed}");
}

/// A platform on six legs whose places are typed, one of them turned, with numbers that some legs have in common and with zeros.
fn platform(packs: &str) -> Model {
    corpus::model(&format!(
        "mod leg {{
            port base: Frame;
            port tip: Frame;
            input thrust;
            body cylinder {{ mass: 0.3141592653589793, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }}
            body piston {{ mass: 0.2718281828459045, com: -0.5 * Z, inertia: diag(0.00571, 0.00571, 0.0) }}
            joint gimbal: Universal {{ parent: base, child: cylinder, axes: [X, Y] }}
            joint stroke: Prismatic {{ parent: cylinder.at(Z), child: piston, axis: Z }}
            #[cut]
            joint ball: Ball {{ parent: piston, child: tip }}
            force actuator: Effort {{ joint: stroke, value: thrust - 3.1 * (stroke.travel - 0.2) - 0.7 * stroke.rate }}
            solve (gimbal, stroke) from ball {{ stroke > -1.0, cos(gimbal.second) > 0.0 }}
        }}
        pub mod oblique {{
            formulation {{ constraints: Reduced, packs: {packs} }}
            const FEET: [Vec3; 6] = [
                [-2.1234567890123456, 1.3745678901234567, 0.0456789012345678], [-2.38, 1.224, 0.0],
                [-2.3956789012345678, -1.2246789012345678, -0.0345678901234567], [0.0, -1.374, 0.0213456789012345],
                [0.0123456789012345, -0.1523456789012345, 0.0], [0.0, 0.1534567890123456, -0.0123456789012345],
            ];
            const PINS: [Vec3; 6] = [
                [0.1723456789012345, 0.5956789012345678, -0.4012345678901234], [-0.6, 0.15, -0.4],
                [-0.6012345678901234, -0.1512345678901234, -0.4], [0.17, -0.595, -0.3898765432109876],
                [0.4312345678901234, -0.4451234567890123, -0.4], [0.43, 0.0, -0.4123456789012345],
            ];
            world {{ gravity: [0.31, -0.22, -9.7] }}
            body platform {{
                mass: 1.5123456789012345, com: [0.02, -0.03, 0.04], inertia: inertia(0.08, 0.09, 0.11, 0.004, -0.003, 0.002),
                coordinates: Absolute(RollPitchYaw),
            }}
            part legs: [leg; 6] = |i| leg {{
                base: ground.at(FEET[i]).rotated([0.2, -0.1, 1.0], 0.7 * i - 2.0), tip: platform.at(PINS[i]),
            }};
            emit forward_dynamics, inverse_dynamics {{ solve_for: legs.thrust }};
        }}"
    ))
}

/// Leg forces and accelerations of a body on struts: all six legs go into packs, and values are those without, near and far from
/// where the platform is level. Legs are alike however many numbers two of them share.
#[test]
fn legs_of_a_platform_are_alike() {
    let (model, plain) = (platform("Four"), platform("Off"));
    let [(structure, derivation), (_, other)] =
        [&model, &plain].map(|model| mechanics::of(model).unwrap_or_else(|_| panic!("a derivation")));
    let [packed, alone] = [&derivation, &other].map(|derivation| optimize::compile(derivation).unwrap());
    let found = verify::check(&model, &structure, &derivation, &packed);
    assert!(found.wrong.is_empty() && found.broken.is_none() && found.unchecked.is_empty(), "{found:?}");
    let mut rng = Rng::new(20_261_126);
    for kind in [FunctionKind::ForwardDynamics, FunctionKind::InverseDynamics] {
        let function = packed.functions.iter().find(|function| function.kind == kind).unwrap();
        let derived = derivation.functions.iter().find(|derived| derived.kind == kind).unwrap();
        assert!(!derived.candidates[function.candidate].1.apart.is_empty(), "{kind:?}: {}", function.method);
        // The length of no leg is left to scalars.
        let single = |statement: &&Statement| matches!(statement, Statement::Let { .. });
        let scalars = function.program.statements.iter().filter(single).flat_map(Statement::expressions);
        assert!(!scalars.chain(&function.program.results).any(has_root), "{kind:?}");
        for draw in 0..100 {
            let far = if draw % 2 == 0 { 0.6 } else { 3.0 };
            let known: HashMap<Symbol, f64> =
                derivation.symbols.iter().map(|&symbol| (symbol, rng.real(-far, far))).collect();
            let run = |compiled: &Compiled| {
                let function = compiled.functions.iter().find(|function| function.kind == kind).unwrap();
                interpreter::run(&function.program, &|symbol| known[&symbol], &|_| f64::NAN)
            };
            let (a, b) = (run(&alone), run(&packed));
            let size = a.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
            for (a, b) in a.iter().zip(&b) {
                assert!((a - b).abs() < 1e-9 * size, "{kind:?}, {draw}: {a:e}, {b:e}");
            }
        }
    }
}

/// Two arms on a spine whose hinges are alike: the spine's are no limbs, and what the arms do is done for both. The program is
/// right, gives what it gives without packs, and leaves to scalars what the trunk does alone.
#[test]
fn two_arms_on_a_spine() {
    let hinge = |name: &str, parent: &str, axis: &str, turn: f64| {
        format!(
            "body {name} {{
                mass: 1.3, com: [0.01, -0.02, 0.{}], inertia: inertia(0.031, 0.043, 0.059, 0.002, -0.003, 0.004),
            }}
            joint to_{name}: Revolute {{ parent: {parent}.at([0.02, 0.1, -0.03]).rotated([0.3, 1.0, -0.2], {turn}), child: {name}, axis: {axis} }}
            ",
            name.len()
        )
    };
    let mut text = String::new();
    for (parent, child) in [("pelvis", "lumbar"), ("lumbar", "thorax"), ("thorax", "chest")] {
        text += &hinge(child, parent, "[0.2, -0.1, 1.0]", 0.4);
    }
    for (side, turn) in [("left", 1.1), ("right", -1.1)] {
        let names = ["clavicle", "humerus", "ulna", "hand"].map(|part| format!("{side}_{part}"));
        let mut parent = "chest".to_owned();
        for (name, axis) in
            names.into_iter().zip(["[1.0, 0.2, 0.1]", "[0.1, 1.0, 0.3]", "[-0.2, 0.1, 1.0]", "[1.0, -0.3, 0.2]"])
        {
            text += &hinge(&name, &parent, axis, turn);
            parent = name;
        }
    }
    let model = corpus::model(&format!(
        "pub mod torso {{
            formulation {{ packs: Four }}
            body pelvis {{ mass: 2.1, com: [0.02, -0.01, 0.03], inertia: diag(0.031, 0.043, 0.059) }}
            joint float: Free {{ parent: ground, child: pelvis }}
            {text}
            emit forward_dynamics, inverse_dynamics, mass_matrix;
        }}"
    ));
    let (structure, derivation) = mechanics::of(&model).unwrap_or_else(|_| panic!("a derivation"));
    let compiled = optimize::compile(&derivation).unwrap();
    let found = verify::check(&model, &structure, &derivation, &compiled);
    assert!(found.wrong.is_empty() && found.broken.is_none() && found.unchecked.is_empty(), "{found:?}");
    let alone = optimize::compile(&mechanics::of(&Model { packs: Packs::Off, ..model }).unwrap().1).unwrap();
    let mut rng = Rng::new(20_261_129);
    for (function, other) in compiled.functions.iter().zip(&alone.functions) {
        let size = |statement: &Statement| match statement {
            Statement::Pack { size, .. } | Statement::PackSines(size, _) => Some(*size),
            _ => None,
        };
        assert!(function.program.statements.iter().filter_map(size).all(|size| size == Size::Two));
        let [packed, scalar] = optimize::packs::operations(&function.program).unwrap();
        assert!(4 * packed > 3 * scalar, "{:?}: {packed} on packs, {scalar} on scalars", function.kind);
        for _ in 0..50 {
            let known: HashMap<Symbol, f64> =
                derivation.symbols.iter().map(|&symbol| (symbol, rng.real(-3.0, 3.0))).collect();
            let run = |program: &_| interpreter::run(program, &|symbol| known[&symbol], &|_| f64::NAN);
            let (a, b) = (run(&other.program), run(&function.program));
            let size = a.iter().fold(1.0_f64, |most, x| most.max(x.abs()));
            for (a, b) in a.iter().zip(&b) {
                assert!((a - b).abs() < 1e-10 * size, "{:?}: {a:e}, {b:e}", function.kind);
            }
        }
    }
}

/// A sign of one member, a member in the place of another, a pack that reads another member.
#[test]
fn a_wrong_member_is_noticed() {
    let model = corpus::model(
        "pub mod spider {
            formulation { packs: Four }
            world { gravity: [0.3, -0.2, -9.7] }
            body trunk { mass: 2.1, com: [0.02, -0.01, 0.03], inertia: diag(0.031, 0.043, 0.059) }
            joint float: Free { parent: ground, child: trunk }
            part legs: [leg; 4] = |i| leg { hip: trunk.at(HIPS[i]).rotated(Z, TURNS[i]), };
            const HIPS: [Vec3; 4] = [[0.31, 0.22, 0.03], [0.29, -0.21, 0.02], [-0.33, 0.19, 0.01], [-0.28, -0.24, 0.05]];
            const TURNS: [Scalar; 4] = [0.3, -0.7, 2.2, -2.6];
            emit forward_dynamics, inverse_dynamics;
        }
        mod leg {
            port hip: Frame;
            param m = 0.4;
            body thigh { mass: m, com: [0.12, 0.03, -0.02], inertia: inertia(0.002, 0.004, 0.005, 0.0003, -0.0002, 0.0001) }
            body shin { mass: 0.3, com: [0.17, -0.02, 0.01], inertia: diag(0.001, 0.003, 0.003) }
            joint lift: Revolute { parent: hip, child: thigh, axis: [0.1, 1.0, 0.2] }
            joint knee: Revolute { parent: thigh.at([0.3, 0.02, -0.01]), child: shin, axis: [0.2, 1.0, -0.1] }
        }",
    );
    let (structure, derivation) = mechanics::of(&model).unwrap_or_else(|_| panic!("a derivation"));
    let compiled = optimize::compile(&derivation).unwrap();
    assert!(is_packed(&compiled));
    let wrong = |compiled: &Compiled| !verify::check(&model, &structure, &derivation, compiled).wrong.is_empty();
    assert!(!wrong(&compiled));
    let mut tried = 0;
    for function in 0..compiled.functions.len() {
        for number in 0..compiled.functions[function].program.statements.len() {
            let mut broken = compiled.clone();
            let done = match &mut broken.functions[function].program.statements[number] {
                Statement::Members { members, .. } => {
                    let taken: Vec<usize> = (0..members.len()).filter(|&k| members[k].is_some()).collect();
                    taken.len() > 1 && {
                        members.swap(taken[0], taken[1]);
                        true
                    }
                }
                Statement::Pack { value, .. } => is_negated(value),
                _ => false,
            };
            // Members that are only summed may change places.
            if done && number % 3 == 0 && differs(&compiled, &broken, function) {
                tried += 1;
                assert!(wrong(&broken), "function {function}, statement {number}");
            }
        }
    }
    assert!(tried > 20, "{tried}");
}

/// Whether a root is taken in it.
fn has_root(value: &Expression) -> bool {
    match value {
        Expression::Call(Call::Sqrt, _) => true,
        Expression::Neg(inner) => has_root(inner),
        Expression::Sum(terms) => terms.iter().any(|(_, term)| has_root(term)),
        Expression::Product(list) | Expression::Call(_, list) => list.iter().any(has_root),
        Expression::Quotient(above, below) => has_root(above) || has_root(below),
        _ => false,
    }
}

/// Whether a function gives other values, with numbers for all that it reads.
fn differs(a: &Compiled, b: &Compiled, function: usize) -> bool {
    let number = |text: String| {
        let sum = text.bytes().fold(7_u64, |sum, byte| sum.wrapping_mul(131).wrapping_add(u64::from(byte)));
        0.2 + 1e-6 * (sum % 1_000_003) as f64
    };
    let [a, b] = [a, b].map(|compiled| {
        let program = &compiled.functions[function].program;
        interpreter::run(program, &|symbol| number(format!("{symbol:?}")), &|field| number(format!("{field:?}")))
    });
    a.iter().zip(&b).any(|(a, b)| (a - b).abs() > 1e-9 * (1.0 + a.abs()))
}

/// The second member of the first pack of literals or coordinates takes the other sign.
fn is_negated(value: &mut Expression) -> bool {
    match value {
        Expression::Pack(list) => {
            let mut all: Vec<Expression> = list.iter().cycle().take(4).cloned().collect();
            all[1] = Expression::Neg(Box::new(all[1].clone()));
            *list = all;
            true
        }
        Expression::Neg(inner) => is_negated(inner),
        Expression::Sum(terms) => terms.iter_mut().any(|(_, term)| is_negated(term)),
        Expression::Product(list) | Expression::Call(_, list) => list.iter_mut().any(is_negated),
        Expression::Quotient(above, _) => is_negated(above),
        _ => false,
    }
}
