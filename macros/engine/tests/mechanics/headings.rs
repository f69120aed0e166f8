//! Motions on planes: functions in axes that head along have the values of those in the axes of the world.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;
use multibody_engine::symbolic::evaluate::{Evaluator, Real};
use multibody_engine::symbolic::graph::SymbolId;
use multibody_engine::symbolic::turned::lower_turned;

use super::support::{Case, case, close};

/// A car with slides in an odd order along negative axes of an oblique plane, and a hinge about a negative axis.
const CAR: &str = "
    let plane = ground.at([0.3, -0.2, 0.7]).rotated([1.0, 2.0, 0.5], 0.37);
    body a { mass: 0.0 }
    body b { mass: 0.3 }
    body lift { mass: 0.0 }
    body chassis { mass: 3.0, com: [0.1, -0.05, 0.02], inertia: inertia(0.3, 0.4, 0.5, 0.01, 0.02, -0.03) }
    body front { mass: 0.4, com: [0.02, 0.01, 0.0], inertia: diag(0.01, 0.012, 0.02) }
    joint y: Prismatic { parent: plane, child: a, axis: -Y }
    joint z: Prismatic { parent: a, child: lift, axis: -Z }
    joint x: Prismatic { parent: lift, child: b, axis: X }
    joint heading: Revolute { parent: b, child: chassis, axis: -Z }
    joint steer: Revolute { parent: chassis.at([0.8, 0.1, 0.0]), child: front, axis: [0.1, 0.2, 1.0] }
    input turn;
    force steering: Effort { joint: steer, value: turn }
    constraint height = z - 0.3 * cos(steer);
    constraint rear: Skate { blade: chassis, along: [1.0, 0.1, 0.0], on: plane }
    constraint fore: Skate { blade: front, along: [1.0, 0.2, 0.0], on: plane }
    output place = chassis.position;
    output velocity = front.velocity;";

const ALL: &str = "emit forward_dynamics, inverse_dynamics, mass_matrix, bias, derivatives, impulse, energy;";

/// Functions with results that got rid of the angle, or turn at the end, and how many results read it still; all have their values.
fn turned(case: &Case) -> Vec<(FunctionKind, usize)> {
    let derivation = &case.derivation;
    assert_eq!(derivation.turns.len(), 1);
    let mut found = Vec::new();
    for function in &derivation.functions {
        for (_, results) in &function.candidates {
            let Some((graph, list)) = lower_turned(&derivation.graph, &results.list, &derivation.turns[0]) else {
                continue;
            };
            let angle = graph.symbol_handle(derivation.turns[0].angle).expect("a symbol");
            let reading = list.iter().filter(|&&root| graph.depends_on(root, &[angle])).count();
            if found.last() != Some(&(function.kind, reading)) {
                found.push((function.kind, reading));
            }
            for seed in 0..4 {
                let point = case.random(seed);
                let value = |id: SymbolId| point.values[&derivation.symbols[id.0]];
                let wanted = Evaluator::new(&derivation.graph, Real { symbols: &value }).run(&results.list);
                let got = Evaluator::new(&graph, Real { symbols: &value }).run(&list);
                close(&format!("{:?}", function.kind), &got, &wanted, 1e-9);
            }
        }
    }
    found
}

/// Slopes of what rolls or skates have no heading in them whatever keeps it there; a weight that has a direction in the plane tells
/// where the car heads.
#[test]
fn a_car_on_an_oblique_plane() {
    let speed = "speed ahead = chassis.express(chassis.velocity).x; speed turned = steer.rate;";
    for (formulation, kinds) in [
        (
            "constraints: Reduced, independent: [heading, steer]",
            [FunctionKind::MassMatrix, FunctionKind::PositionRates],
        ),
        ("constraints: Reduced", [FunctionKind::MassMatrix, FunctionKind::PositionRates]),
        ("constraints: Multipliers", [FunctionKind::ConstraintRate, FunctionKind::ConstraintBias]),
    ] {
        let speed = if formulation == "constraints: Reduced" { speed } else { "" };
        // A motion that Newton's method closes has neither.
        let none = if formulation.contains("Reduced") { ["inverse_dynamics, ", "impulse, "] } else { [" "; 2] };
        let all = none.iter().fold(ALL.to_owned(), |all, none| all.replace(none, " "));
        for gravity in ["world { gravity: 0.0 * Z }", "world { gravity: [0.3, -9.1, 2.2] }"] {
            let found = turned(&case(&format!("{gravity} {CAR} {speed} formulation {{ {formulation} }} {all}")));
            for kind in kinds {
                assert!(found.iter().any(|found| found.0 == kind), "{formulation}, {gravity}: {kind:?} of {found:?}");
            }
            // Where velocities have no direction the rates of two slides are all that has one.
            let two = found.contains(&(FunctionKind::ForwardDynamics, 2));
            let expected = gravity.contains("0.0") && formulation.contains("Reduced");
            assert_eq!(two, expected, "{formulation}: {found:?}");
        }
    }
}

/// What moves with one slide alone has a direction.
#[test]
fn a_slide_with_mass() {
    let car = CAR.replace("body a { mass: 0.0 }", "body a { mass: 0.1 }");
    let found = turned(&case(&format!(
        "world {{ gravity: 0.0 * Z }} {car} formulation {{ constraints: Reduced, independent: [heading, steer] }}
         emit forward_dynamics, bias;"
    )));
    assert_eq!(found[0], (FunctionKind::ForwardDynamics, 4));
    assert!(found.contains(&(FunctionKind::PositionRates, 2)), "{found:?}");
}

/// A rate of a slide among the velocities is a component of a vector whose other one follows: nothing turns but what doesn't read it.
#[test]
fn half_a_vector() {
    let found = turned(&case(&format!(
        "world {{ gravity: 0.0 * Z }} {CAR} formulation {{ constraints: Reduced, independent: [x, steer] }} emit forward_dynamics, mass_matrix;"
    )));
    assert!(found.iter().all(|found| found.0 != FunctionKind::ForwardDynamics), "{found:?}");
}

/// Two hinges on one slide, about axes that don't commute: columns that were turned twice are turned back in the other order.
#[test]
fn two_hinges_on_three_slides() {
    let case = case(
        "world { gravity: 0.0 * Z }
         body p { mass: 0.0 } body q { mass: 0.0 } body carrier { mass: 1.0 }
         body wheel { mass: 1.0, com: [0.1, 0.2, 0.0], inertia: diag(1.0, 1.2, 1.4) }
         body rotor { mass: 1.0, com: [0.0, 0.2, 0.1], inertia: diag(1.0, 1.2, 1.4) }
         body weight { mass: 1.0 }
         joint x: Prismatic { parent: ground, child: p, axis: X }
         joint y: Prismatic { parent: p, child: q, axis: Y }
         joint z: Prismatic { parent: q, child: carrier, axis: Z }
         joint a: Revolute { parent: carrier, child: wheel, axis: Z }
         joint b: Revolute { parent: carrier, child: rotor, axis: X }
         joint c: Prismatic { parent: ground, child: weight, axis: X }
         let along = x.rate * cos(a) + y.rate * sin(a);
         let across = y.rate * cos(a) - x.rate * sin(a);
         constraint one = along - 0.4 * c.rate;
         constraint two = across * cos(b) + z.rate * sin(b) - 0.3 * c.rate;
         constraint three = z.rate * cos(b) - across * sin(b) + 0.2 * c.rate;
         formulation { constraints: Reduced, independent: [a, b, c] }
         emit forward_dynamics;",
    );
    assert_eq!(case.derivation.turns.len(), 2);
    for seed in 0..4 {
        let point = case.random(seed);
        let rates = case.eval(FunctionKind::PositionRates, &point);
        let [x, y, z, _, _, c] = rates[..] else { panic!("{rates:?}") };
        let angle = |name: &str| point.values[&Symbol::Position { joint: case.joint(name), component: 0 }];
        let ((sa, ca), (sb, cb)) = (angle("a").sin_cos(), angle("b").sin_cos());
        let (along, across) = (x * ca + y * sa, y * ca - x * sa);
        let rows = [along - 0.4 * c, across * cb + z * sb - 0.3 * c, z * cb - across * sb + 0.2 * c];
        close("rows", &rows, &[0.0; 3], 1e-12);
    }
}
