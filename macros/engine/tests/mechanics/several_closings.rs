//! Closed forms from several closings together against the same mechanisms with multipliers and by Newton's method: positions,
//! rates and accelerations of everything at random poses, on each branch that the conditions choose.

use super::against::Mechanism;
use super::support::try_case;

/// A lower arm that is moved, an upper one, and the upright between them.
const ARMS: &str = "world { gravity: -9.80665 * Z }
    input load;
    body lower { mass: 2.0, com: 0.2 * X, inertia: diag(0.02, 0.03, 0.04) }
    body upright { mass: 8.0, com: [0.05, 0.01, 0.12], inertia: diag(0.1, 0.12, 0.08) }
    joint low: Revolute { parent: ground, child: lower, axis: [0.05, 1.0, 0.03] }
    force spring: Effort { joint: low, value: load - 5.0 * low.rate }";
const UPPER: &str = "body upper { mass: 1.5, com: 0.15 * X, inertia: diag(0.01, 0.02, 0.03) }
    joint up: Revolute { parent: ground.at([0.08, 0.02, 0.25]), child: upper, axis: [-0.04, 1.0, 0.06] }";
const HEAD: &str =
    "#[cut] joint head: Ball { parent: upper.at([0.31, -0.01, 0.0]), child: upright.at([-0.03, -0.01, 0.26]) }";
const HEAD_BACK: &str =
    "#[cut] joint head: Ball { parent: upright.at([-0.03, -0.01, 0.26]), child: upper.at([0.31, -0.01, 0.0]) }";
const PIVOT: &str =
    "joint pivot: Ball { parent: lower.at([0.42, 0.02, 0.01]), child: upright, coordinates: RollPitchYaw }";
const TIE: &str = "body tie { mass: 0.5, com: 0.2 * X, inertia: diag(0.001, 0.01, 0.01) }
    joint rack: Universal { parent: ground.at([0.05, -0.12, 0.08]), child: tie, axes: [Y, Z] }";
const STEER: &str = "#[cut] joint steer: Ball { parent: tie.at(0.37 * X), child: upright.at([0.0, -0.13, 0.08]) }";
const STEER_BACK: &str = "#[cut] joint steer: Ball { parent: upright.at([0.0, -0.13, 0.08]), child: tie.at(0.37 * X) }";
const ROD: &str = "constraint steer: Rod {
    between: [ground.at([0.05, -0.12, 0.08]), upright.at([0.0, -0.13, 0.08])], length: 0.37 }";

const ASSUMED: &str = "assume (cos(low) > 0.9);";
const PIVOTS: [&str; 4] = ["up", "pivot.roll", "pivot.pitch", "pivot.yaw"];

fn wishbone(name: &'static str, items: &[&'static str], solve: &'static str) -> Mechanism {
    Mechanism {
        name,
        items: [&[ARMS, UPPER, PIVOT], items].concat(),
        solve,
        moved: vec![("low", std::f64::consts::PI)],
        assumed: ASSUMED,
        branches: vec![
            "up < 0.75, cos(pivot.pitch) > 0.0, cos(pivot.yaw) > 0.0",
            "up < 0.75, cos(pivot.pitch) < 0.0, cos(pivot.yaw) < 0.0",
            "up < 0.75, cos(pivot.pitch) > 0.0, cos(pivot.yaw + 0.3) < 0.0",
        ],
        coordinates: PIVOTS.to_vec(),
        bodies: vec!["lower", "upper", "upright"],
    }
}

/// The same with a tie that is a body.
fn tied(name: &'static str, items: &[&'static str], solve: &'static str) -> Mechanism {
    let mut mechanism = wishbone(name, &[items, &[TIE]].concat(), solve);
    mechanism.branches = vec![
        "up < 0.75, cos(pivot.pitch) > 0.0, cos(pivot.yaw) > 0.0, cos(rack.second) > 0.0",
        "up < 0.75, cos(pivot.pitch) > 0.0, cos(pivot.yaw + 0.3) < 0.0, cos(rack.second) < 0.0",
    ];
    mechanism.coordinates.extend(["rack.first", "rack.second"]);
    mechanism.bodies.push("tie");
    mechanism
}

fn turning(name: &'static str, joints: &'static str, solve: &'static str, branches: &[&'static str]) -> Mechanism {
    Mechanism {
        name,
        items: vec![ARMS, UPPER, HEAD, ROD, joints],
        solve,
        moved: vec![("low", std::f64::consts::PI)],
        assumed: ASSUMED,
        branches: branches.to_vec(),
        coordinates: vec!["up"],
        bodies: vec!["lower", "upper", "upright"],
    }
}

#[test]
fn a_wishbone_whose_tie_is_a_rod() {
    wishbone("rod", &[HEAD, ROD], "(up, pivot) from (head, steer)").check();
}

#[test]
fn cycles_that_are_walked_either_way() {
    wishbone("rod first", &[HEAD_BACK, ROD], "(up, pivot) from (steer, head)").check();
    tied("head back", &[HEAD_BACK, STEER], "(up, pivot, rack) from (head, steer)").check();
    tied("steer back", &[HEAD, STEER_BACK], "(rack, pivot, up) from (steer, head)").check();
}

#[test]
fn a_wishbone_whose_tie_is_a_body() {
    tied("body", &[HEAD, STEER], "(up, pivot, rack) from (head, steer)").check();
}

#[test]
fn a_universal_joint_and_a_hinge_through_its_centre() {
    let joints = "body knuckle { mass: 0.2, inertia: diag(0.001, 0.002, 0.0015) }
        joint tilt: Universal { parent: lower.at([0.42, 0.02, 0.01]), child: knuckle, axes: [X, Y] }
        joint spin: Revolute { parent: knuckle.at(0.03 * Z), child: upright.at(0.03 * Z), axis: Z }";
    let branches =
        ["up < 0.75, cos(tilt.second) > 0.0, cos(spin) > 0.0", "up < 0.75, cos(tilt.second) < 0.0, cos(spin) < 0.0"];
    let mut mechanism = turning("universal", joints, "(up, tilt, spin) from (head, steer)", &branches);
    mechanism.coordinates.extend(["tilt.first", "tilt.second", "spin"]);
    mechanism.bodies.push("knuckle");
    mechanism.check();
}

#[test]
fn three_oblique_hinges_through_one_point() {
    let joints = "body first { mass: 0.2, inertia: diag(0.001, 0.002, 0.0015) }
        body second { mass: 0.3, inertia: diag(0.001, 0.002, 0.0015) }
        joint a: Revolute { parent: lower.at([0.42, 0.02, 0.01]), child: first, axis: [1.0, 0.1, 0.2] }
        joint b: Revolute { parent: first.at([0.002, 0.02, 0.0]), child: second.at([0.002, 0.02, 0.0]), axis: [0.1, 1.0, 0.0] }
        joint c: Revolute {
            parent: second.at([-0.006, 0.004, 0.02]), child: upright.at([-0.006, 0.004, 0.02]), axis: [-0.3, 0.2, 1.0] }";
    let branches = ["up < 0.75, cos(b) > 0.0, cos(c) > 0.0"];
    let mut mechanism = turning("oblique", joints, "(up, a, b, c) from (head, steer)", &branches);
    mechanism.coordinates.extend(["a", "b", "c"]);
    mechanism.bodies.extend(["first", "second"]);
    mechanism.check();
}

/// The rod leads to the upper arm or to the lower one.
#[test]
fn a_rod_between_what_moves() {
    let rods = [
        "constraint steer: Rod { between: [upper.at([0.1, -0.12, -0.1]), upright.at([0.0, -0.13, 0.08])], length: 0.25 }",
        "constraint steer: Rod { between: [upright.at([0.0, -0.13, 0.08]), lower.at([0.12, -0.1, 0.08])], length: 0.3 }",
    ];
    for rod in rods {
        let mut mechanism = wishbone("rod on an arm", &[HEAD, rod], "(up, pivot) from (head, steer)");
        mechanism.branches.truncate(1);
        mechanism.check();
    }
}

/// A strut in place of the upper arm: what it carries has a length that is found first.
#[test]
fn a_strut_that_guides_the_upright() {
    let strut = "body rod { mass: 0.4, com: 0.1 * Z, inertia: diag(0.003, 0.003, 0.001) }
        joint slide: Prismatic { parent: upright.at([-0.03, -0.01, 0.16]), child: rod, axis: [-0.1, 0.05, 1.0] }
        #[cut] joint mount: Ball { parent: ground.at([0.33, 0.03, 0.55]), child: rod.at(0.2 * Z) }";
    let mechanism = Mechanism {
        name: "strut",
        items: vec![ARMS, PIVOT, strut, ROD],
        solve: "(slide, pivot) from (mount, steer)",
        moved: vec![("low", std::f64::consts::PI)],
        assumed: ASSUMED,
        branches: vec!["slide > -0.3, cos(pivot.pitch) > 0.0, cos(pivot.yaw) > 0.0"],
        coordinates: ["slide"].into_iter().chain(PIVOTS[1..].iter().copied()).collect(),
        bodies: vec!["lower", "upright", "rod"],
    };
    mechanism.check();
}

/// Lengths that are parameters, at other values than declared: conditions choose the branch at run time.
#[test]
fn lengths_that_are_parameters() {
    let items = [
        "param arm = 0.31; param link = 0.37; param knee = [-0.03, -0.01, 0.26];",
        "#[cut] joint head: Ball { parent: upper.at([arm, -0.01, 0.0]), child: upright.at(knee) }",
        "constraint steer: Rod { between: [ground.at([0.05, -0.12, 0.08]), upright.at([0.0, -0.13, 0.08])], length: link }",
    ];
    wishbone("parameters", &items, "(up, pivot) from (head, steer)").check();
}

/// Time moves the lower arm, and something slides on the upright.
#[test]
fn an_arm_that_is_driven() {
    let cart = "body cart { mass: 3.0, com: 0.01 * Z, inertia: diag(0.01, 0.02, 0.015) }
        joint rail: Prismatic { parent: upright.at([0.1, 0.0, 0.0]), child: cart, axis: Y }
        drive low = 0.3 * sin(2.0 * t) - 0.1;";
    let mut mechanism = wishbone("driven", &[HEAD, ROD, cart], "(up, pivot) from (head, steer)");
    mechanism.branches.truncate(1);
    mechanism.coordinates.push("low");
    mechanism.bodies.push("cart");
    mechanism.check();
}

/// What has no closed form is refused, and what determines nothing.
#[test]
fn loops_without_a_closed_form() {
    let refusal = |items: &[&str]| {
        let text = format!("{} formulation {{ constraints: Reduced }} emit forward_dynamics;", items.join(" "));
        try_case(&text).err().expect("refused")
    };
    let rods = "constraint one: Rod { between: [upper.at([0.31, -0.01, 0.0]), upright.at([-0.03, -0.01, 0.26])], length: 0.05 }
        constraint two: Rod { between: [upper.at([0.31, 0.05, 0.0]), upright.at([-0.03, 0.07, 0.26])], length: 0.06 }
        constraint three: Rod { between: [upper.at([0.2, 0.05, 0.0]), upright.at([-0.03, 0.07, 0.2])], length: 0.15 }
        solve (up, pivot) from (one, two, three, steer) { up < 0.75 }";
    let text = refusal(&[ARMS, UPPER, PIVOT, ROD, rods]);
    assert!(text.contains("no two joints of these loops leave an equation in one unknown alone"), "{text}");
    // The rod's ball stands on the line about which it would turn the upright.
    let rod = "constraint steer: Rod { between: [ground.at([0.05, -0.12, 0.08]), upright.at([-0.015, -0.005, 0.13])], length: 0.37 }
        solve (up, pivot) from (head, steer) { up < 0.75 }";
    let text = refusal(&[ARMS, UPPER, PIVOT, HEAD, rod]);
    assert!(text.contains("the loops do not determine"), "{text}");
    let text = refusal(&[
        ARMS,
        UPPER,
        PIVOT,
        HEAD,
        ROD,
        "solve (up, pivot.roll, pivot.pitch) from (head, steer) { up < 0.75 }",
    ]);
    assert!(text.contains("`solve` names 3 unknowns, but the loops give 4 equations for them"), "{text}");
    // Another mechanism stands beside it.
    let bar = "body one { mass: 1.0 } body two { mass: 1.0 } body three { mass: 1.0 }
        joint crank: Revolute { parent: ground, child: one, axis: Z }
        joint pin: Revolute { parent: one.at(0.3 * X), child: two, axis: Z }
        joint rocker: Revolute { parent: ground.at(X), child: three, axis: Z }
        #[cut] joint last: Revolute { parent: two.at(0.9 * X), child: three.at(0.6 * X), axis: Z }
        solve (up, pivot, pin, rocker) from (head, steer, last) { up < 0.75 }";
    let text = refusal(&[ARMS, UPPER, PIVOT, HEAD, ROD, bar]);
    assert!(text.contains("the loop that `last` closes has no coordinate in common"), "{text}");
}
