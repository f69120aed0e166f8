//! Slides that are found together from measures across them, against the same mechanisms with multipliers and by Newton's method.

use super::against::Mechanism;
use super::support::try_case;

const ARMS: &str = "world { gravity: -9.80665 * Z }
    input load;
    body one { mass: 1.1, com: [0.14, 0.01, -0.02], inertia: diag(0.002, 0.03, 0.031) }
    body two { mass: 1.2, com: [0.15, -0.01, 0.02], inertia: diag(0.003, 0.032, 0.033) }
    body three { mass: 1.3, com: [0.13, 0.02, 0.01], inertia: diag(0.004, 0.034, 0.036) }
    joint a: Revolute { parent: ground.at([0.2, 0.01, 0.03]), child: one, axis: [0.03, 1.0, -0.05] }
    joint b: Revolute { parent: ground.rotated(Z, 2.0943951023931957).at([0.21, -0.02, 0.0]), child: two, axis: [-0.07, 1.0, 0.02] }
    joint c: Revolute { parent: ground.rotated([0.02, 0.01, 1.0], -2.1).at([0.19, 0.0, -0.02]), child: three, axis: [0.04, 1.0, 0.1] }
    body plate { mass: 2.5, com: [0.01, -0.02, 0.03], inertia: diag(0.03, 0.035, 0.05) }
    force push: Effort { joint: a, value: load - 3.0 * a.rate }";
const SLIDES: &str = "body along { mass: 0.2 } body across { mass: 0.3 }
    joint x: Prismatic { parent: ground, child: along, axis: X }
    joint y: Prismatic { parent: along, child: across, axis: Y }
    joint z: Prismatic { parent: across, child: plate, axis: Z }";
/// On something that swings, along no axes of it, and with turns between them.
const OBLIQUE: &str = "body base { mass: 3.0, com: [0.02, 0.05, 0.01], inertia: diag(0.1, 0.2, 0.15) }
    body along { mass: 0.2 } body across { mass: 0.3, com: [0.01, 0.02, 0.0] }
    joint d: Revolute { parent: ground.at([0.01, 0.02, 0.05]), child: base, axis: [0.2, 0.1, 1.0] }
    joint x: Prismatic { parent: base.rotated([0.3, 1.0, 0.2], 0.2).at([0.0, 0.03, 0.01]), child: along, axis: [1.0, 0.2, 0.15] }
    joint y: Prismatic { parent: along.at([0.01, 0.0, 0.02]), child: across.rotated(X, 0.35), axis: [0.25, 1.0, -0.1] }
    joint z: Prismatic { parent: across.oriented([[0.36, 0.48, -0.8], [-0.8, 0.6, 0.0], [0.48, 0.64, 0.6]]), child: plate, axis: [0.1, -0.3, 1.0] }";
const RODS: &str = "
    constraint first: Rod { between: [one.at([0.31, 0.01, 0.0]), plate.at([0.06, 0.01, 0.0])], length: 0.8123456789012345 }
    constraint second: Rod { between: [two.at([0.29, 0.0, 0.02]), plate.at([-0.03, 0.05, 0.01])], length: 0.79 }
    constraint third: Rod { between: [three.at([0.3, 0.0, -0.01]), plate.at([-0.02, -0.06, 0.0])], length: 0.8271 }";
/// The same, some walked the other way.
const RODS_BACK: &str = "
    constraint first: Rod { between: [plate.at([0.06, 0.01, 0.0]), one.at([0.31, 0.01, 0.0])], length: 0.8123456789012345 }
    constraint second: Rod { between: [two.at([0.29, 0.0, 0.02]), plate.at([-0.03, 0.05, 0.01])], length: 0.79 }
    constraint third: Rod { between: [plate.at([-0.02, -0.06, 0.0]), three.at([0.3, 0.0, -0.01])], length: 0.8271 }";
const DRIVEN: [(&str, f64); 3] = [("a", 0.9), ("b", 0.9), ("c", 0.9)];
const PLACES: [&str; 3] = ["x", "y", "z"];

/// On which side of the plane of the three centres the plate lies: the volume of the rods.
const ABOVE: &str = "dot(cross(plate.at([0.06, 0.01, 0.0]).position - one.at([0.31, 0.01, 0.0]).position,
    plate.at([-0.03, 0.05, 0.01]).position - two.at([0.29, 0.0, 0.02]).position),
    plate.at([-0.02, -0.06, 0.0]).position - three.at([0.3, 0.0, -0.01]).position) > 0.0";
const BELOW: &str = "dot(cross(plate.at([0.06, 0.01, 0.0]).position - one.at([0.31, 0.01, 0.0]).position,
    plate.at([-0.03, 0.05, 0.01]).position - two.at([0.29, 0.0, 0.02]).position),
    plate.at([-0.02, -0.06, 0.0]).position - three.at([0.3, 0.0, -0.01]).position) < 0.0";

fn delta(name: &'static str, items: &[&'static str], solve: &'static str) -> Mechanism {
    Mechanism {
        name,
        items: [&[ARMS], items].concat(),
        solve,
        moved: DRIVEN.to_vec(),
        assumed: "",
        branches: vec![ABOVE, BELOW],
        coordinates: PLACES.to_vec(),
        bodies: vec!["one", "two", "three", "plate"],
    }
}

#[test]
fn three_rods_and_orthogonal_slides() {
    delta("rods", &[SLIDES, RODS], "(x, y, z) from (first, second, third)").check();
}

#[test]
fn rods_that_are_walked_either_way() {
    delta("walked", &[SLIDES, RODS_BACK], "(z, x, y) from (third, first, second)").check();
}

#[test]
fn oblique_slides_on_a_base_that_swings() {
    let mut mechanism = delta("oblique", &[OBLIQUE, RODS], "(x, y, z) from (first, second, third)");
    mechanism.bodies.extend(["base", "along", "across"]);
    mechanism.moved.push(("d", 3.0));
    mechanism.check();
    let mut mechanism = delta("oblique, walked", &[OBLIQUE, RODS_BACK], "(y, x, z) from (second, third, first)");
    mechanism.bodies.extend(["base", "along", "across"]);
    mechanism.moved.push(("d", 3.0));
    mechanism.check();
}

/// One of the slides stands between turns that are known, so that their directions change.
#[test]
fn a_turn_between_the_slides() {
    let slides = "body along { mass: 0.2 } body across { mass: 0.3 } body turned { mass: 0.4, com: 0.02 * X, inertia: diag(0.01, 0.02, 0.02) }
        joint x: Prismatic { parent: ground, child: along, axis: [1.0, 0.1, 0.0] }
        joint y: Prismatic { parent: along, child: across, axis: [-0.2, 1.0, 0.1] }
        joint d: Revolute { parent: across.at([0.01, 0.02, 0.03]), child: turned, axis: [1.0, 0.3, 0.2] }
        joint z: Prismatic { parent: turned, child: plate, axis: [0.1, 0.0, 1.0] }";
    let mut mechanism = delta("turn between", &[slides, RODS_BACK], "(x, y, z) from (first, second, third)");
    mechanism.bodies.extend(["along", "across", "turned"]);
    mechanism.moved.push(("d", 0.5));
    mechanism.check();
}

/// A floating body whose orientation is known.
#[test]
fn the_place_of_a_floating_body() {
    let free = "joint float: Free { parent: ground.rotated([1.0, 0.2, 0.1], 0.3), child: plate.at([0.01, 0.0, 0.02]), coordinates: RollPitchYaw }";
    let mut mechanism = delta("floating", &[free, RODS], "(float.x, float.y, float.z) from (first, second, third)");
    mechanism.coordinates = vec!["float.x", "float.y", "float.z"];
    mechanism.moved.extend([("float.roll", 0.5), ("float.pitch", 0.5), ("float.yaw", 0.5)]);
    mechanism.check();
}

/// Lengths and places that are parameters, at other values than declared: the condition chooses the branch at run time.
#[test]
fn lengths_that_are_parameters() {
    let items = [
        "param radius = 0.06; param reach = 0.8123456789012345; param off = [-0.02, -0.06, 0.0];",
        SLIDES,
        "constraint first: Rod { between: [one.at([0.31, 0.01, 0.0]), plate.at([radius, 0.01, 0.0])], length: reach }
        constraint second: Rod { between: [two.at([0.29, 0.0, 0.02]), plate.at([-0.03, 0.05, 0.01])], length: 0.79 }
        constraint third: Rod { between: [three.at([0.3, 0.0, -0.01]), plate.at(off)], length: reach }",
    ];
    let mut mechanism = delta("parameters", &items, "(x, y, z) from (first, second, third)");
    mechanism.assumed = "assume (cos(a) > 0.6 && cos(b) > 0.6 && cos(c) > 0.6);";
    mechanism.branches = vec!["z < 0.0", "z > 0.0"];
    mechanism.moved.iter_mut().for_each(|moved| moved.1 = 0.8);
    mechanism.check();
}

/// Struts whose strokes are given: their lengths are coordinates of the state, and the turns of the struts follow from the place.
#[test]
fn struts_with_given_strokes() {
    let struts = "world { gravity: -9.80665 * Z }
        input load;
        body plate { mass: 2.5, com: [0.01, -0.02, 0.03], inertia: diag(0.03, 0.035, 0.05) }
        body one { mass: 0.6, com: 0.2 * X, inertia: diag(0.002, 0.03, 0.031) }
        body two { mass: 0.7, com: 0.2 * X, inertia: diag(0.002, 0.03, 0.031) }
        body three { mass: 0.8, com: 0.2 * X, inertia: diag(0.002, 0.03, 0.031) }
        body one_rod { mass: 0.2, com: -0.1 * X, inertia: diag(0.001, 0.01, 0.011) }
        body two_rod { mass: 0.3, com: -0.1 * X, inertia: diag(0.001, 0.01, 0.011) }
        body three_rod { mass: 0.4, com: -0.1 * X, inertia: diag(0.001, 0.01, 0.011) }
        joint u: Universal { parent: ground.at([0.4, 0.02, 0.03]), child: one, axes: [Z, Y] }
        joint v: Universal { parent: ground.rotated(Z, 2.0).at([0.41, -0.02, 0.0]), child: two, axes: [Z, Y] }
        joint w: Universal { parent: ground.rotated([0.02, 0.01, 1.0], -2.1).at([0.39, 0.0, -0.02]), child: three, axes: [Z, Y] }
        joint a: Prismatic { parent: one.at(0.75 * X), child: one_rod, axis: X }
        joint b: Prismatic { parent: two.at([0.76, 0.01, 0.0]), child: two_rod, axis: [1.0, 0.05, 0.02] }
        joint c: Prismatic { parent: three.at(0.74 * X), child: three_rod, axis: X }
        force push: Effort { joint: a, value: load - 3.0 * a.rate }";
    let cuts = "#[cut] joint first: Ball { parent: one_rod, child: plate.at([0.06, 0.01, 0.0]) }
        #[cut] joint second: Ball { parent: plate.at([-0.03, 0.05, 0.01]), child: two_rod }
        #[cut] joint third: Ball { parent: three_rod, child: plate.at([-0.02, -0.06, 0.0]) }";
    let mechanism = Mechanism {
        name: "struts",
        items: vec![struts, SLIDES, cuts],
        solve: "(x, y, z, u, v, w) from (first, second, third)",
        moved: vec![("a", 0.2), ("b", 0.2), ("c", 0.2)],
        assumed: "",
        branches: vec![
            "dot(cross(one_rod.position - ground.at([0.4, 0.02, 0.03]).position,
                two_rod.position - ground.rotated(Z, 2.0).at([0.41, -0.02, 0.0]).position),
                three_rod.position - ground.rotated([0.02, 0.01, 1.0], -2.1).at([0.39, 0.0, -0.02]).position) > 0.0,
            cos(u.second) > 0.0, cos(v.second) > 0.0, cos(w.second) > 0.0",
            "dot(cross(one_rod.position - ground.at([0.4, 0.02, 0.03]).position,
                two_rod.position - ground.rotated(Z, 2.0).at([0.41, -0.02, 0.0]).position),
                three_rod.position - ground.rotated([0.02, 0.01, 1.0], -2.1).at([0.39, 0.0, -0.02]).position) < 0.0,
            cos(u.second) > 0.0, cos(v.second) < 0.0, cos(w.second) > 0.0",
        ],
        coordinates: vec!["x", "y", "z", "u.first", "u.second", "v.first", "v.second", "w.first", "w.second"],
        bodies: vec!["plate", "one", "two", "three", "one_rod", "two_rod", "three_rod"],
    };
    mechanism.check();
}

/// Two slides whose plane is not that of the rods.
#[test]
fn two_slides_and_two_rods() {
    let slides = "body along { mass: 0.2 }
        joint x: Prismatic { parent: ground.rotated(X, 0.1), child: along, axis: [1.0, 0.1, 0.2] }
        joint y: Prismatic { parent: along, child: plate, axis: [-0.2, 0.15, 1.0] }";
    let rods = "constraint first: Rod { between: [one.at([0.31, 0.01, 0.0]), plate.at([0.06, 0.01, 0.0])], length: 0.8123456789012345 }
        constraint second: Rod { between: [plate.at([-0.03, 0.05, 0.01]), two.at([0.29, 0.0, 0.02])], length: 0.79 }";
    let mut mechanism = delta("two slides", &[slides, rods], "(x, y) from (first, second)");
    mechanism.branches = vec![
        "dot(ground.rotated(X, 0.1).at(cross([1.0, 0.1, 0.2], [-0.2, 0.15, 1.0])).position, cross(plate.at([0.06, 0.01, 0.0]).position - one.at([0.31, 0.01, 0.0]).position,
        plate.at([-0.03, 0.05, 0.01]).position - two.at([0.29, 0.0, 0.02]).position)) > 0.0",
        "dot(ground.rotated(X, 0.1).at(cross([1.0, 0.1, 0.2], [-0.2, 0.15, 1.0])).position, cross(plate.at([0.06, 0.01, 0.0]).position - one.at([0.31, 0.01, 0.0]).position,
        plate.at([-0.03, 0.05, 0.01]).position - two.at([0.29, 0.0, 0.02]).position)) < 0.0",
    ];
    mechanism.coordinates = vec!["x", "y"];
    mechanism.check();
}

/// A plate that rests on an inclined plane: something that slides on it carries a ball.
#[test]
fn two_rods_and_a_plane() {
    let puck = "body puck { mass: 0.4, com: 0.01 * Z, inertia: diag(0.001, 0.002, 0.002) }
        joint rest: Planar { parent: ground.at([0.0, 0.02, 0.5]), child: puck, axis: [0.2, 0.1, 1.0] }
        #[cut] joint third: Ball { parent: puck.at([0.02, 0.0, 0.05]), child: plate.at([-0.02, -0.06, 0.0]) }";
    let rods = "constraint first: Rod { between: [one.at([0.31, 0.01, 0.0]), plate.at([0.06, 0.01, 0.0])], length: 0.8123456789012345 }
        constraint second: Rod { between: [plate.at([-0.03, 0.05, 0.01]), two.at([0.29, 0.0, 0.02])], length: 0.79 }";
    let mut mechanism = delta("plane", &[SLIDES, puck, rods], "(x, y, z, rest.x, rest.y) from (first, second, third)");
    mechanism.branches = vec![
        "dot(ground.at([0.2, 0.1, 1.0]).position, cross(plate.at([0.06, 0.01, 0.0]).position - one.at([0.31, 0.01, 0.0]).position,
        plate.at([-0.03, 0.05, 0.01]).position - two.at([0.29, 0.0, 0.02]).position)) > 0.0",
        "dot(ground.at([0.2, 0.1, 1.0]).position, cross(plate.at([0.06, 0.01, 0.0]).position - one.at([0.31, 0.01, 0.0]).position,
        plate.at([-0.03, 0.05, 0.01]).position - two.at([0.29, 0.0, 0.02]).position)) < 0.0",
    ];
    mechanism.coordinates.extend(["rest.x", "rest.y"]);
    mechanism.moved.push(("rest.angle", 2.0));
    mechanism.bodies.push("puck");
    mechanism.check();
}

fn refusal(items: &[&str]) -> String {
    let text = format!("{} formulation {{ constraints: Reduced }} emit forward_dynamics;", items.join(" "));
    try_case(&text).err().expect("refused")
}

/// What has no such closed form is refused.
#[test]
fn rods_that_tell_no_place() {
    // All three centres on one line, wherever the plate is.
    let rods = "constraint first: Rod { between: [one.at(0.1 * X), plate], length: 0.5099019513592785 }
        constraint second: Rod { between: [one.at(0.2 * X), plate], length: 0.5 }
        constraint third: Rod { between: [one.at(0.3 * X), plate], length: 0.5099019513592785 }
        solve (x, y, z) from (first, second, third) { z < 0.0 }";
    let text = refusal(&[ARMS, SLIDES, rods]);
    assert_eq!(text, "`solve` names 3 unknowns, but the loops give 2 equations for them");
    // A fourth rod.
    let more = "constraint fourth: Rod { between: [ground, plate.at(0.1 * X)], length: 0.9 }
        solve (x, y, z) from (first, second, third, fourth) { z < 0.0 }";
    let text = refusal(&[ARMS, SLIDES, RODS, more]);
    assert_eq!(text, "`solve` names 3 unknowns, but the loops give 4 equations for them");
    // One that does not touch the slides.
    let rods = "constraint first: Rod { between: [one.at(0.1 * X), plate], length: 0.8 }
        constraint second: Rod { between: [two.at(0.2 * X), plate], length: 0.79 }
        constraint third: Rod { between: [three.at(0.3 * X), four.at(0.1 * X)], length: 1.3 }
        body four { mass: 1.0, com: 0.1 * X, inertia: diag(0.01, 0.01, 0.01) }
        joint d: Revolute { parent: ground.at(X), child: four, axis: Y }
        solve (x, y, z) from (first, second, third) { z < 0.0 }";
    let text = refusal(&[ARMS, SLIDES, rods]);
    assert_eq!(text, "the constraint `third` has no coordinate in common with the others");
}
