//! Accelerations, reactions, powers and measured coordinates are the same in every formulation.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::mechanics::analysis::analyse;

use super::alike::Mechanism;
use super::support::*;

const FORMULATIONS: [&str; 4] = [
    "formulation { constraints: Reduced }",
    "formulation { coordinates: Absolute(RollPitchYaw) }",
    "formulation { coordinates: Absolute(Quaternion) }",
    "formulation { coordinates: Absolute(RollPitchYaw), constraints: Reduced }",
];

/// Outputs that the mechanism declares itself must agree too.
fn agrees(what: &str, items: &str, outputs: &[&str]) {
    agrees_within(1.0, what, items, outputs);
}

/// With coordinates up to a bound.
fn agrees_within(greatest: f64, what: &str, items: &str, outputs: &[&str]) {
    let mechanism = Mechanism::new(items);
    let (bodies, joints) = mechanism.names();
    let base = mechanism.case("formulation { constraints: Multipliers }", true);
    let mut others: Vec<(&str, Case)> = Vec::new();
    for formulation in FORMULATIONS {
        match mechanism.try_case(formulation, false) {
            Ok(case) => others.push((formulation, case)),
            // A screw whose turns nothing counts is not solved from a guess.
            Err(refusal) => assert!(refusal.contains("whole turns") && formulation.contains("Reduced"), "{refusal}"),
        }
    }
    assert!(others.len() >= 3, "{what}");
    let motions: Vec<_> = (1..20).filter_map(|seed| mechanism.motion_within(&base, seed, greatest)).take(3).collect();
    assert!(motions.len() == 3, "{what}: no motions");
    for motion in &motions {
        let expected = base.outputs(&mechanism.adopt(&base, &base, motion));
        for (formulation, case) in &others {
            let point = mechanism.adopt(case, &base, motion);
            let found = case.outputs(&point);
            if !case.structure.rows.is_empty() {
                let gaps = case.candidate(FunctionKind::Constraints, 0, &point);
                assert!(gaps.iter().all(|gap| gap.abs() < 1e-10), "{what}, {formulation}: open by {gaps:?}");
            }
            let same = |name: &str| {
                let what = format!("{what}, {formulation}, {name}");
                close(&what, &found[name], &expected[name], 1e-8);
            };
            for k in 0..bodies {
                ["velocity", "spin", "acceleration", "spin_rate"].iter().for_each(|name| same(&format!("{name}_{k}")));
            }
            outputs.iter().for_each(|name| same(name));
            let determined = base.structure.dropped.is_empty() && case.structure.dropped.is_empty();
            assert!(determined, "{what}, {formulation}: loads are shared");
            (0..joints).for_each(|k| same(&format!("reaction_{k}")));
        }
    }
}

const BODIES: &str = "world { gravity: [1.0, -9.0, 2.0] }
    body a { mass: 1.0, com: [0.5, 0.1, 0.2], inertia: inertia(0.5, 0.6, 0.7, 0.02, -0.03, 0.01) }
    body b { mass: 0.7, com: [1.1, -0.2, 0.1], inertia: inertia(0.3, 0.2, 0.4, 0.01, 0.02, -0.01) }";

const HINGES: &str = "joint one: Revolute { parent: ground.at([0.1, 0.2, 0]), child: a, axis: [1, 0.3, -0.2] }
    joint two: Revolute { parent: a.at([1, 0.2, 0]).rotated([1, 1, 0], 0.4), child: b.at([0.1, 0, 0.2]), axis: Z }";

#[test]
fn expressions_load_the_bodies() {
    each(
        &[
            "constraint floor = b.at([0.3, 1, 0.1]).position.y - 0.4;",
            "constraint floor = norm(b.at([0.3, 1, 0.1]).position - [3, 1, 0.5]) - 2.5;",
            "constraint along = dot(b.at(X).position - a.at([0, 1, 0]).position, [1, 2, 3]) - 1.4;",
            "constraint seen = dot(b.express([0, 0, 1]), [1, 2, 0.5]) - 0.3 + 0.1 * sin(t);",
            "constraint mixed = b.at([0.3, 1, 0.1]).position.y + 0.5 * two - 0.2 * one - 0.4;",
            "constraint tip = centre_of_mass([b]).y - 0.4 + total_mass() * 0.01 * sin(t);",
            "constraint gear = two - 2 * one - 0.1;",
            "constraint cam = two - 0.5 * sin(one);",
            "constraint rod: Rod { between: [ground.at([2, 0, 0]), b.at(Y)], length: 2.0 }",
        ],
        |constraint| agrees(constraint, &format!("{BODIES} {HINGES} {constraint}"), &[]),
    );
}

/// Several bodies as one, in a loop and under a constraint.
#[test]
fn several_bodies_as_one() {
    let told = "output whole = [total_mass() * X, centre_of_mass(), linear_momentum(), angular_momentum()];
        output moving = [centre_of_mass().velocity, centre_of_mass().acceleration];
        output outer = [centre_of_mass([b]), linear_momentum([b]), angular_momentum([b]), centre_of_mass([b]).acceleration];";
    each(
        &[
            "constraint rod: Rod { between: [ground.at([2, 0, 0]), b.at(Y)], length: 2.0 }",
            "constraint balanced = dot(centre_of_mass(), [1, 2, 0.5]) - 0.7;",
        ],
        |constraint| {
            agrees(constraint, &format!("{BODIES} {HINGES} {constraint} {told}"), &["whole", "moving", "outer"])
        },
    );
}

/// Measured angles are known up to whole turns, and couplings of them hold over any number of turns.
#[test]
fn couplings_hold_over_many_turns() {
    each(
        &[
            "constraint gear = 3.0 * (one + 2.0 * two) - 0.4 * cos(t);",
            "constraint gear = one / 3.0 - 0.4 * two;",
            "constraint gear = 47.0 * one - 13.0 * two;",
            "constraint cam = two - 0.3 * sin(2.0 * two - one) - one;",
            "constraint mixed = b.at([0.3, 1, 0.1]).position.y + 0.5 * two - 0.2 * one - 0.4;",
            "constraint held = sin(two) * cos(one) - 0.2;",
        ],
        |constraint| {
            let told = "output told = [one.rate, two.rate, one.accel, two.accel];";
            agrees_within(30.0, constraint, &format!("{BODIES} {HINGES} {constraint} {told}"), &["told"]);
        },
    );
}

/// The same with other joints that measure angles.
#[test]
fn couplings_of_all_angles() {
    let kinds = [
        ("Universal { axes: [X, -Z]", "two.first - 2 * one"),
        ("Universal { axes: [[1, 1, 0], [1, -1, 3]]", "two.second + two.first - one"),
        ("Cylindrical { axis: [1, 0.3, -0.2]", "two.travel - 0.2 * two.angle + 0.1 * one"),
        ("PinSlot { axis: [1, 1, 0], slide: [1, -1, 3]", "two.travel - 0.2 * two.angle + 0.1 * one"),
        ("Planar { axis: -Z", "0.3 * two.angle + two.x - 0.6 * one"),
        ("Planar { axes: [X, Z]", "0.3 * two.angle + two.y - 0.6 * one"),
        ("Screw { axis: [0.2, 0.3, -1], pitch: 0.2", "two.angle + 0.37 * two.angle - one"),
        ("Ball { coordinates: RollPitchYaw", "two.roll - 2 * one + two.pitch * two.pitch"),
        ("Ball { coordinates: RollPitchYaw", "two.yaw + 0.5 * one"),
    ];
    let texts: Vec<String> = kinds
        .iter()
        .map(|(kind, value)| {
            format!(
                "{BODIES}
                joint one: Revolute {{ parent: ground.at([0.1, 0.2, 0]), child: a.at([0.1, 0, 0.2]), axis: [1, 0.3, -0.2] }}
                joint two: {kind}, parent: a.at([1, 0.2, 0]).rotated([1, 1, 0], 0.4), child: b.at([0.1, 0, 0.2]).rotated(X, 0.3) }}
                constraint coupled = {value} - 0.1;"
            )
        })
        .collect();
    let list: Vec<&str> = texts.iter().map(String::as_str).collect();
    each(&list, |text| {
        // A pitch that is measured stays within a quarter.
        let greatest = if text.contains("Ball") { 1.4 } else { 20.0 };
        agrees_within(greatest, text.lines().last().unwrap_or(""), text, &[]);
    });
}

/// What no number of turns leaves alone is refused at its angle, and a coordinate takes it.
#[test]
fn turns_that_can_not_be_counted_are_refused() {
    each(
        &[
            "param ratio = 2.0; constraint gear = two - ratio * one;",
            "constraint gear = two - sqrt(2.0) * one;",
            "constraint gear = two - 1.2345678 * one;",
            "constraint gear = two - one * one;",
            "constraint cam = dot(b.position, X) - two * sin(one);",
            "constraint cam = two - abs(one);",
            "constraint cam = sin(0.7123 * two) - sin(one);",
        ],
        |items| {
            let items = format!("{BODIES} {HINGES} {items}");
            let refused = |formulation: &str| analyse(&model_of(&format!("{items} {formulation}"))).err();
            assert!(refused("formulation { constraints: Multipliers }").is_none(), "{items}");
            for formulation in &FORMULATIONS[1..] {
                let told = refused(formulation).unwrap_or_else(|| panic!("{items} {formulation} is taken"));
                assert!(told.iter().all(|one| one.message.contains("up to whole turns")), "{told:?}");
            }
        },
    );
}

/// Slides give couplings that are linear in coordinates and hold bodies all the same.
#[test]
fn linear_couplings_of_places() {
    let slides = "joint one: Prismatic { parent: ground, child: a, axis: [1, 0.3, -0.2] }
        joint two: Prismatic { parent: a.rotated([1, 1, 0], 0.4), child: b, axis: Z }";
    each(
        &[
            "constraint floor = b.at([0.3, 1, 0.1]).position.y - 0.4;",
            "constraint mixed = b.position.y - 0.4 * one;",
            "constraint rack = one - 0.3 * two;",
        ],
        |constraint| agrees(constraint, &format!("{BODIES} {slides} {constraint}"), &[]),
    );
}

/// Runs all and tells which failed.
fn each(list: &[&str], f: impl Fn(&str) + std::panic::RefUnwindSafe) {
    let failed = |item: &&&str| std::panic::catch_unwind(|| f(item)).is_err();
    let failed: Vec<_> = list.iter().filter(failed).collect();
    assert!(failed.is_empty(), "{failed:#?}");
}

/// Forces on joints, and what is asked of them, where the bodies have coordinates of their own.
#[test]
fn joints_are_measured() {
    let kinds = [
        ("Revolute { axis: [1, 0.3, -0.2]", "angle", 1),
        ("Revolute { axis: -Y", "angle", 1),
        ("Prismatic { axis: [1, 0.3, -0.2]", "travel", 1),
        ("Prismatic { axis: -Z", "travel", 1),
        ("Revolute { armature: 0.7, axis: [1, 0.3, -0.2]", "angle", 1),
        ("Prismatic { armature: 0.4, axis: -Z", "travel", 1),
        ("Screw { armature: 0.3, axis: [0.2, 0.3, -1], pitch: 0.2", "angle", 1),
        ("Screw { axis: [0.2, 0.3, -1], pitch: 0.2", "angle", 1),
        ("Screw { axis: -X, pitch: -0.3", "angle", 1),
        ("Cylindrical { axis: [1, 0.3, -0.2]", "travel angle", 2),
        ("Cylindrical { axis: -Y", "travel angle", 2),
        ("Universal { axes: [X, -Z]", "first second", 2),
        ("Universal { axes: [[1, 1, 0], [1, -1, 3]]", "first second", 2),
        ("PinSlot { axis: -Z, slide: X", "travel angle", 2),
        ("PinSlot { axis: [1, 1, 0], slide: [1, -1, 3]", "travel angle", 2),
        ("Planar { axis: -Z", "x y angle", 3),
        ("Planar { axis: [1, 0.3, -0.2]", "x y angle", 3),
        ("Planar { axes: [X, Z]", "x y angle", 3),
        ("Planar { axes: [[1, 1, 0], [1, -1, 3]]", "x y angle", 3),
        ("Ball { coordinates: RollPitchYaw", "roll pitch yaw", 3),
        ("Free { coordinates: RollPitchYaw", "x y z roll pitch yaw", 6),
    ];
    let texts: Vec<String> = kinds
        .iter()
        .map(|(kind, names, count)| {
            let names: Vec<&str> = names.split(' ').collect();
            let mut text = format!(
                "{BODIES}
                joint one: Revolute {{ parent: ground.at([0.1, 0.2, 0]), child: a.at([0.1, 0, 0.2]), axis: [1, 0.3, -0.2] }}
                joint two: {kind}, parent: a.at([1, 0.2, 0]).rotated([1, 1, 0], 0.4), child: b.at([0.1, 0, 0.2]).rotated(X, 0.3) }}
                force wind: Force {{ at: b, value: [1, 2, -0.5], axes: ground }}
                output moving = kinetic();"
            );
            for (k, name) in names.iter().enumerate() {
                text += &format!(
                    "force spring_{name}: SpringDamper {{ joint: two.{name}, stiffness: 3 + {k}, damping: 0.2, rest: 0.1 }}
                    force motor_{name}: Effort {{ joint: two.{name}, value: 0.7 * cos(t) - 0.3 * two.{name}.rate }}
                    output power_{name} = [spring_{name}.power, motor_{name}.power];
                    output told_{name} = [two.{name}, two.{name}.rate, two.{name}.accel, two.{name}.effort];"
                );
            }
            if *count == 3 && kind.starts_with("Ball") {
                text += "output relative = two.angular_velocity;";
            }
            text += "output stored = potential();";
            text
        })
        .collect();
    let list: Vec<&str> = texts.iter().map(String::as_str).collect();
    each(&list, |text| {
        let told: Vec<&str> = text
            .split("output ")
            .skip(1)
            .filter_map(|rest| rest.split([' ', '=']).next())
            .filter(|name| !name.is_empty())
            .collect();
        let told: Vec<&str> = told
            .into_iter()
            .filter(|name| ["power", "told", "stored", "relative", "moving"].iter().any(|p| name.starts_with(p)))
            .collect();
        assert!(told.len() >= 3);
        agrees(&text[BODIES.len()..], text, &told);
    });
}

/// Drives and couplings of joints.
#[test]
fn joints_are_driven() {
    each(
        &[
            "drive two = 0.3 * sin(t) + 0.2;",
            "drive one = 2.5 * t; force spring: Spring { joint: two, stiffness: 2, rest: 0.3 }",
            "drive two = 40 - 3 * t;",
        ],
        |items| {
            let told =
                "output held = [one.effort, two.effort]; output told = [one, two, one.rate, two.rate, two.accel];";
            let slides = "joint one: Prismatic { parent: ground.at([0.1, 0.2, 0]), child: a, axis: [1, 0.3, -0.2] }
                joint two: Screw { parent: a.at([1, 0.2, 0]).rotated([1, 1, 0], 0.4), child: b, axis: Z, pitch: 0.4 }";
            agrees(items, &format!("{BODIES} {HINGES} {items} {told}"), &["held"]);
            agrees(items, &format!("{BODIES} {slides} {items} {told}"), &["told", "held"]);
        },
    );
}
