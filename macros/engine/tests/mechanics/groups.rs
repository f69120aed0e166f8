//! What is found several times in a mechanism, and that sharing changes no result.

use multibody_engine::contracts::cost::Cost;
use multibody_engine::emit::report;
use multibody_engine::mechanics::loops::groups::{Group, Repeated, find};
use multibody_engine::model::types::Model;
use multibody_engine::optimize::compile;

use crate::support::{model_of, model_with};

fn sentences(model: &Model) -> Vec<String> {
    find(model).iter().map(Group::sentence).collect()
}

const PLATFORM: &str = "world { gravity: -9.80665 * Z } formulation { constraints: Reduced } \
    body platform { mass: 1.5, inertia: diag(0.08, 0.08, 0.08), coordinates: Absolute(RollPitchYaw) } \
    emit forward_dynamics;";

const LEG: &str = "mod leg { port base: Frame; port tip: Frame; param m = 0.1; input thrust; \
    body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) } \
    body piston { mass: m, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) } \
    joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] } \
    joint stroke: Prismatic { parent: cylinder.at(1.0 * Z), child: piston, axis: Z } \
    #[cut] joint ball: Ball { parent: piston, child: tip } \
    force actuator: Effort { joint: stroke, value: thrust } \
    solve (gimbal, stroke) from ball { stroke.travel > -1.0, cos(gimbal.second) > 0.0 } }";

/// One leg by hand. Names, numbers and the order of axes and of the rod's mass are given.
fn leg(name: &str, foot: &str, pin: &str, axes: &str, mass: &str) -> String {
    format!(
        "input thrust_{name}; \
        body tube_{name} {{ mass: 0.2, com: 0.4 * Z, inertia: diag(0.007, 0.007, 0.0) }} \
        body rod_{name} {{ mass: {mass}, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }} \
        joint hip_{name}: Universal {{ parent: ground.at({foot}), child: tube_{name}, axes: {axes} }} \
        joint lift_{name}: Prismatic {{ parent: tube_{name}.at(1.0 * Z), child: rod_{name}, axis: Z }} \
        #[cut] joint foot_{name}: Ball {{ parent: rod_{name}, child: platform.at({pin}) }} \
        force push_{name}: Effort {{ joint: lift_{name}, value: thrust_{name} }} \
        solve (hip_{name}, lift_{name}) from foot_{name} \
            {{ lift_{name}.travel > -1.0, cos(hip_{name}.second) > 0.0 }} "
    )
}

fn by_hand(last_axes: &str, last_mass: &str) -> Model {
    let legs = [
        leg("left", "[-2.1, 1.4, 0.0]", "[0.2, 0.6, -0.4]", "[X, Y]", "0.1"),
        leg("right", "[0.0, -0.2, 0.0]).rotated(Z, 0.3", "[0.4, 0.4, -0.4]", "[X, Y]", "rod_mass"),
        leg("rear", "[-2.4, 0.0, 0.0]", "[-0.6, 0.1, -0.4]", last_axes, last_mass),
    ];
    model_of(&format!("param rod_mass = 0.15; {PLATFORM} {}", legs.concat()))
}

fn stewart() -> Model {
    let feet = "const FEET: [Vec3; 6] = [[-2.12, 1.374, 0.0], [-2.38, 1.224, 0.0], [-2.38, -1.224, 0.0], \
        [-2.12, -1.374, 0.0], [0.0, -0.15, 0.0], [0.0, 0.15, 0.0]]; \
        const PINS: [Vec3; 6] = [[0.17, 0.595, -0.4], [-0.6, 0.15, -0.4], [-0.6, -0.15, -0.4], \
        [0.17, -0.595, -0.4], [0.43, -0.445, -0.4], [0.43, 0.445, -0.4]];";
    let legs =
        "part legs: [leg; 6] = |i| leg { base: ground.at(FEET[i]).rotated(Z, 0.3 * i), tip: platform.at(PINS[i]) };";
    model_with(LEG, &format!("{feet} {PLATFORM} {legs}"))
}

#[test]
fn legs_from_a_part_are_alike() {
    assert_eq!(sentences(&stewart()), ["six identical loops: `legs[0].ball` to `legs[5].ball`"]);
}

#[test]
fn legs_by_hand_are_alike() {
    let expected = ["three identical loops: `foot_left`, `foot_right` and `foot_rear`"];
    assert_eq!(sentences(&by_hand("[X, Y]", "0.3")), expected);
}

/// Another axis, another sign, a missing mass: the others stay together.
#[test]
fn near_misses_stay_out() {
    let expected = ["two identical loops: `foot_left` and `foot_right`"];
    for (axes, mass) in [("[Y, X]", "0.1"), ("[-X, Y]", "0.1"), ("[X, Z]", "0.1"), ("[X, Y]", "0.0")] {
        assert_eq!(sentences(&by_hand(axes, mass)), expected, "{axes} {mass}");
    }
    // All but one leg have an actuator.
    let model = by_hand("[X, Y]", "0.3");
    let mut idle = by_hand("[X, Y]", "0.3");
    assert_eq!(model.forces.len(), 3);
    idle.forces.pop();
    assert_eq!(sentences(&idle), expected);
}

const FOUR: &str = "mod four { port base: Frame; param span = 4.0; \
    body c { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) } \
    body k { mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) } \
    body r { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) } \
    joint crank: Revolute { parent: base, child: c, axis: Z } \
    joint coupler: Revolute { parent: c.at(X), child: k, axis: Z } \
    joint rocker: Revolute { parent: base.at(span * X), child: r, axis: Z } \
    #[cut] joint pin: Revolute { parent: k.at(3.5 * X), child: r.at(3.0 * X), axis: Z } \
    solve (coupler, rocker) from pin { sin(rocker.angle - crank.angle - coupler.angle) > 0.0 } }";

#[test]
fn four_bars_are_alike() {
    let text = "world { gravity: -9.81 * Y } formulation { constraints: Reduced } \
        part bars: [four; 13] = |i| four { base: ground.at(i * Z) }; emit forward_dynamics;";
    let model = model_with(FOUR, text);
    assert_eq!(sentences(&model), ["13 identical loops: `bars[0].pin` to `bars[12].pin`"]);
}

/// Windows in a row share their cranks: what a loop passes on besides is not what tells them apart.
#[test]
fn windows_in_a_row_are_alike() {
    let mut text = "world { gravity: -9.81 * Y } \
        body crank0 { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) } \
        joint turn0: Revolute { parent: ground, child: crank0, axis: Z } emit forward_dynamics;"
        .to_owned();
    for k in 1..5 {
        text += &format!(
            "body bar{k} {{ mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }} \
            body crank{k} {{ mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }} \
            joint turn{k}: Revolute {{ parent: ground.at({k}.0 * X), child: crank{k}, axis: Z }} \
            joint knee{k}: Revolute {{ parent: crank{}.at(X), child: bar{k}, axis: Z }} \
            #[cut] joint pin{k}: Revolute {{ parent: bar{k}.at(X), child: crank{k}.at(X), axis: Z }} ",
            k - 1
        );
    }
    assert_eq!(sentences(&model_of(&text)), ["four identical loops: `pin1` to `pin4`"]);
}

fn pole(k: usize, parent: &str, axis: &str) -> String {
    format!(
        "body link{k} {{ mass: 1.{k}, com: -0.2{k} * Z, inertia: diag(0.0{k}, 0.0{k}, 0.001) }} \
        joint joint{k}: Revolute {{ parent: {parent}, child: link{k}, axis: {axis} }} "
    )
}

const CART: &str = "world { gravity: -9.81 * Z } body link1 { mass: 5.0, inertia: diag(0.1, 0.1, 0.1) } \
    joint joint1: Prismatic { parent: ground, child: link1, axis: X } emit forward_dynamics;";

#[test]
fn poles_in_a_row_are_alike() {
    let poles = |last: &str| {
        let poles = (2..7).map(|k| {
            let parent = if k == 2 { "link1".to_owned() } else { format!("link{}.at(-0.{k} * Z)", k - 1) };
            pole(k, &parent, if k == 6 { last } else { "Y" })
        });
        model_of(&format!("{CART} {}", poles.collect::<String>()))
    };
    let model = poles("Y");
    assert_eq!(sentences(&model), ["five identical links in a row: `joint2` to `joint6`"]);
    assert_eq!(find(&model)[0].what, Repeated::Links);
    assert_eq!(sentences(&poles("X")), ["four identical links in a row: `joint2` to `joint5`"]);
}

#[test]
fn poles_side_by_side_are_alike() {
    let poles = |last: &str| {
        let poles = (2..7).map(|k| pole(k, &format!("link1.at(0.{k} * X)"), if k == 6 { last } else { "Y" }));
        model_of(&format!("{CART} {}", poles.collect::<String>()))
    };
    assert_eq!(sentences(&poles("Y")), ["five identical branches: `joint2` to `joint6`"]);
    assert_eq!(sentences(&poles("-Y")), ["four identical branches: `joint2` to `joint5`"]);
}

/// A leg that walks is a branch of several links; what hangs on one of its links counts.
#[test]
fn branches_are_compared_whole() {
    let leg = |name: &str, toe: &str| {
        format!(
            "body thigh_{name} {{ mass: 1.0, com: -0.2 * Z, inertia: diag(0.1, 0.1, 0.0) }} \
            body shank_{name} {{ mass: 1.0, com: -0.2 * Z, inertia: diag(0.1, 0.1, 0.0) }} \
            joint hip_{name}: Revolute {{ parent: trunk.at(0.1 * Y), child: thigh_{name}, axis: Y }} \
            joint knee_{name}: Revolute {{ parent: thigh_{name}.at(-0.4 * Z), child: shank_{name}, axis: Y }} {toe} "
        )
    };
    let toe = "body toe { mass: 0.1, com: 0.1 * X } joint ankle: Revolute { parent: shank_c.at(-0.4 * Z), child: toe, axis: Y }";
    let trunk = "world { gravity: -9.81 * Z } body trunk { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) } \
        joint float: Free { parent: ground, child: trunk } emit forward_dynamics;";
    let text = format!("{trunk} {} {} {}", leg("a", ""), leg("b", ""), leg("c", toe));
    assert_eq!(sentences(&model_of(&text)), ["two identical branches: `hip_a` and `hip_b`"]);
}

fn costs(model: &Model, shared: bool) -> (Vec<Cost>, Vec<String>, String) {
    let mut structure = multibody_engine::mechanics::analysis::analyse(model).expect("a structure");
    if !shared {
        structure.groups.clear();
    }
    let derivation = multibody_engine::mechanics::derive(model, &structure).expect("equations");
    let Ok(compiled) = compile(&derivation) else { panic!("too large") };
    assert!(compiled.sound);
    let costs = compiled.functions.iter().map(|function| function.after).collect();
    let text = report(model, &structure, &compiled);
    (costs, derivation.notes, text)
}

/// What is derived is the same with and without sharing, and the report names what was found.
#[test]
fn sharing_changes_no_result() {
    for model in [stewart(), by_hand("[X, Y]", "0.3"), by_hand("[Y, X]", "0.1")] {
        let (shared, alone) = (costs(&model, true), costs(&model, false));
        assert_eq!(shared.0, alone.0);
        // What is found first depends on what the graph has of a leg by then; what each unknown is found by does not.
        let sorted = |mut notes: Vec<String>| {
            notes.sort_unstable();
            notes
        };
        assert_eq!(sorted(shared.1), sorted(alone.1));
        let sentence = format!("## Repeated parts\n\n- {}", sentences(&model)[0]);
        assert!(shared.2.contains(&sentence), "{}", shared.2);
        assert!(!alone.2.contains("Repeated parts"));
    }
}

/// A plan is not all that a solution is made of: a member whose conditions fit several solutions is refused.
#[test]
fn every_member_has_its_own_branch() {
    let legs = [
        leg("left", "[-2.1, 1.4, 0.0]", "[0.2, 0.6, -0.4]", "[X, Y]", "0.1"),
        leg("right", "[0.0, -0.2, 0.0]", "[0.4, 0.4, -0.4]", "[X, Y]", "0.2")
            .replace("{ lift_right.travel > -1.0, cos(hip_right.second) > 0.0 }", "{ lift_right.travel > -1000.0 }"),
    ];
    let model = model_of(&format!("{PLATFORM} {}", legs.concat()));
    assert_eq!(sentences(&model).len(), 1);
    let Err(complaints) = multibody_engine::mechanics::of(&model) else { panic!("no complaint") };
    assert!(complaints[0].message.contains("solutions"), "{}", complaints[0].message);
}
