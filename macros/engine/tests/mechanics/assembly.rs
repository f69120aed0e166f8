//! Assembly modes: robots that have none in closed form are refused, with the reason.

use multibody_engine::mechanics;

use super::support::model_of;

fn complaint(model: &str) -> Option<String> {
    let complaints = mechanics::of(&model_of(model)).err()?;
    let all = complaints.into_iter().map(|one| format!("{} | {}", one.message, one.help.unwrap_or_default()));
    Some(all.collect::<Vec<_>>().join("\n"))
}

const FEET: [&str; 6] = [
    "[1.0, 0.2, 0.1]",
    "[0.9, 0.4, 0.0]",
    "[-0.4, 0.9, 0.2]",
    "[-0.6, 0.8, -0.1]",
    "[-0.5, -0.9, 0.0]",
    "[0.1, -1.1, 0.3]",
];
const PINS: [&str; 6] = [
    "[0.3, 0.1, -0.1]",
    "[0.2, 0.2, 0.0]",
    "[-0.1, 0.4, 0.1]",
    "[-0.3, 0.2, 0.0]",
    "[-0.2, -0.3, 0.1]",
    "[0.2, -0.2, 0.0]",
];

/// A platform on struts between these feet and pins, by number.
fn platform(feet: [usize; 6], pins: [usize; 6], pose: &str, items: &str) -> String {
    let legs = feet.iter().zip(pins).enumerate().map(|(k, (&foot, pin))| {
        let (foot, pin) = (FEET[foot], PINS[pin]);
        format!(
            "body c{k} {{ mass: 0.1, com: 0.5 * Z, inertia: diag(0.006, 0.006, 0.001) }}
             body p{k} {{ mass: 0.1, com: -0.5 * Z, inertia: diag(0.006, 0.006, 0.001) }}
             joint g{k}: Universal {{ parent: ground.at({foot}), child: c{k}, axes: [X, Y] }}
             joint s{k}: Prismatic {{ parent: c{k}.at(0.9 * Z), child: p{k}, axis: Z }}
             #[cut] joint b{k}: Ball {{ parent: p{k}, child: plate.at({pin}) }}\n"
        )
    });
    let legs: String = legs.collect();
    format!(
        "body plate {{ mass: 1.0, inertia: diag(0.1, 0.1, 0.1), coordinates: Absolute({pose}) }} {legs}
         formulation {{ constraints: Multipliers }} {items}"
    )
}

const ALL: &str = "emit assembly_modes { given: [s0, s1, s2, s3, s4, s5], find: plate.pose };";
const RPY: &str = "RollPitchYaw";

#[test]
fn all_kinds_are_known() {
    let own = [0, 1, 2, 3, 4, 5];
    for (feet, pins) in [
        (own, [0, 0, 1, 1, 2, 2]),
        (own, [0, 1, 2, 2, 1, 0]),
        ([0, 0, 1, 1, 2, 2], own),
        ([0, 1, 1, 2, 2, 0], [0, 0, 1, 1, 2, 2]),
        (own, [0, 0, 0, 1, 1, 2]),
        ([3, 3, 3, 1, 1, 2], own),
        (own, [0, 1, 0, 2, 0, 3]),
        ([4, 4, 4, 1, 3, 2], own),
    ] {
        let model = platform(feet, pins, RPY, ALL);
        assert_eq!(complaint(&model), None, "{feet:?} {pins:?}");
    }
}

/// Numbers that are written otherwise are one point still; what differs by a rounding is not.
#[test]
fn ends_are_compared_by_value() {
    let model = platform([0, 1, 2, 3, 4, 5], [0, 0, 1, 1, 2, 2], RPY, ALL);
    let same = model.replacen("plate.at([0.3, 0.1, -0.1])", "plate.at(0.1 * [3.0, 1.0, 0.0]).at(-0.1 * Z)", 1);
    assert_eq!(complaint(&same), None);
    let other = model.replacen("plate.at([0.3, 0.1, -0.1])", "plate.at([0.3000000001, 0.1, -0.1])", 1);
    assert!(complaint(&other).is_some_and(|text| text.starts_with("no polynomial of low degree")));
}

#[test]
fn others_are_refused_with_the_reason() {
    let own = [0, 1, 2, 3, 4, 5];
    let told = |model: &str, text: &str| {
        let found = complaint(model).unwrap_or_default();
        assert!(found.contains(text), "{found}");
    };
    told(
        &platform(own, own, RPY, ALL),
        "legs end in common on the body by 1, 1, 1, 1, 1, 1, beside it by 1, 1, 1, 1, 1, 1",
    );
    told(&platform(own, [0, 0, 1, 1, 2, 3], RPY, ALL), "on the body by 2, 2, 1, 1");
    told(&platform(own, [0, 0, 1, 1, 2, 2], "Quaternion", ALL), "Absolute(RollPitchYaw)");
    let five = "emit assembly_modes { given: [s0, s1, s2, s3, s4], find: plate.pose };";
    assert!(complaint(&platform(own, [0, 0, 1, 1, 2, 2], RPY, five)).is_some());
    let gimbals = "emit assembly_modes { given: [s0, s1, s2, s3, s4, s5], find: [plate.pose, g0] };";
    told(&platform(own, [0, 0, 1, 1, 2, 2], RPY, gimbals), "`g0.first` is not known from the pose");
    let reduced = platform(own, [0, 0, 1, 1, 2, 2], RPY, ALL).replace("Multipliers", "Reduced");
    told(&reduced, "Multipliers");
    // Legs that don't reach everywhere, or hold more with other parameters.
    let short = platform(own, [0, 0, 1, 1, 2, 2], RPY, ALL);
    told(&short.replace("parent: p3, child", "parent: p3.at(0.6 * Y), child"), "something else than one distance");
    told(
        &short.replace("child: c3, axes: [X, Y]", "child: c3, axes: [X, [0.0, 1.0, 1.0]]"),
        "something else than one distance",
    );
    told(&short.replace("child: p3, axis: Z", "child: p3, axis: [0.0, 0.6, 0.8]"), "something else than one distance");
    let arms = [0.0, 2.1, 4.2].iter().enumerate().map(|(k, turn)| {
        let tilt = if k == 1 { ".rotated(X, tilt)" } else { "" };
        format!(
            "body a{k} {{ mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }} body b{k} {{ mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }}
             joint s{k}: Revolute {{ parent: ground.rotated(Z, {turn}).at(X), child: a{k}, axis: Z }}
             joint k{k}: Revolute {{ parent: a{k}.at(0.5 * X){tilt}, child: b{k}, axis: Z }}
             #[cut] joint w{k}: Revolute {{ parent: b{k}.at(0.6 * X), child: plate.rotated(Z, {turn}).at(0.3 * X), axis: Z }}\n"
        )
    });
    let arms: String = arms.collect();
    told(
        &format!(
            "param tilt = 0.0; body plate {{ mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }}
             joint slide: Planar {{ parent: ground, child: plate, axis: Z }} {arms}
             formulation {{ constraints: Multipliers }} emit assembly_modes {{ given: [s0, s1, s2], find: slide }};"
        ),
        "something else than one distance",
    );
    // A hinge in place of a universal joint holds more than a distance.
    let legs = [0.0, 2.1, 4.2].iter().enumerate().map(|(k, turn)| {
        format!(
            "body c{k} {{ mass: 0.1, com: 0.5 * Z, inertia: diag(0.006, 0.006, 0.001) }}
             body p{k} {{ mass: 0.1, com: -0.5 * Z, inertia: diag(0.006, 0.006, 0.001) }}
             joint g{k}: Revolute {{ parent: ground.rotated(Z, {turn}).at(X), child: c{k}, axis: Y }}
             joint s{k}: Prismatic {{ parent: c{k}.at(0.9 * Z), child: p{k}, axis: Z }}
             #[cut] joint b{k}: Ball {{ parent: p{k}, child: plate.rotated(Z, {turn}).at(0.5 * X) }}\n"
        )
    });
    let legs: String = legs.collect();
    told(
        &format!(
            "body plate {{ mass: 1.0, inertia: diag(0.1, 0.1, 0.1), coordinates: Absolute(RollPitchYaw) }} {legs}
             formulation {{ constraints: Multipliers }} emit assembly_modes {{ given: [s0, s1, s2], find: plate.pose }};"
        ),
        "a leg holds the body by more than one distance",
    );
    let bar = "body a { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
        body b { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) } body c { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
        joint p: Revolute { parent: ground, child: a, axis: Z } joint q: Revolute { parent: a.at(X), child: b, axis: Z }
        joint r: Revolute { parent: ground.at(2.0 * X), child: c, axis: Z }
        #[cut] joint pin: Revolute { parent: b.at(1.7 * X), child: c.at(1.2 * X), axis: Z }
        formulation { constraints: Multipliers } emit assembly_modes { given: p, find: [q, r] };";
    told(bar, "there is none");
}
