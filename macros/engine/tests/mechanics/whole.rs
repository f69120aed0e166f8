//! Quantities of several bodies, against sums over bodies one by one.

use std::fmt::Write;

use super::support::*;

/// Mass, centre of mass, and inertia about it (xx, yy, zz, xy, xz, yz) in the body's axes.
type Body = (&'static str, f64, [f64; 3], [f64; 6]);

const BODIES: [Body; 5] = [
    ("trunk", 3.7, [0.13, -0.21, 0.37], [0.9, 0.7, 0.8, 0.05, -0.07, 0.03]),
    ("arm", 1.3, [-0.31, 0.11, 0.23], [0.21, 0.17, 0.19, -0.02, 0.01, 0.03]),
    ("hand", 0.7, [0.07, 0.43, -0.19], [0.05, 0.06, 0.07, 0.01, 0.003, -0.008]),
    ("rod", 0.9, [0.0, -0.4, 0.1], [0.11, 0.13, 0.12, 0.004, -0.011, 0.006]),
    ("plate", 2.2, [0.02, 0.05, -0.01], [0.3, 0.29, 0.31, -0.013, 0.021, 0.0]),
];

fn bodies() -> String {
    let mut text = String::new();
    for (name, mass, com, inertia) in BODIES {
        let six: Vec<String> = inertia.iter().map(|x| format!("{x:?}")).collect();
        let _ = writeln!(
            text,
            "body {name} {{ mass: {mass:?}, com: {com:?}, inertia: inertia({}) }}
             output x_{name} = {name}.at({com:?}).position; output v_{name} = {name}.at({com:?}).velocity;
             output a_{name} = {name}.at({com:?}).acceleration; output w_{name} = {name}.angular_velocity;
             output r_{name} = {name}.rotation;",
            six.join(", ")
        );
    }
    text
}

const WHOLE: &str = "
    world { gravity: [0.7, -1.1, -9.3] }
    output mass = total_mass(); output centre = centre_of_mass().position; output speed = centre_of_mass().velocity;
    output rush = centre_of_mass().acceleration; output p = linear_momentum(); output h = angular_momentum();
    output some_mass = total_mass([hand, plate]); output some_centre = centre_of_mass([plate, hand]).position;
    output some_speed = centre_of_mass([hand, plate]).velocity; output some_rush = centre_of_mass([hand, plate]).acceleration;
    output some_p = linear_momentum([hand, plate]); output some_h = angular_momentum([hand, plate]);
    output slope = diff(centre_of_mass().position, t);
    emit forward_dynamics;";

fn check(what: &str, case: &Case, seed: u64) {
    let point = case.random(seed);
    let found = case.outputs(&point);
    let of = |letter: &str, name: &str| -> [f64; 3] { found[&format!("{letter}_{name}")].clone().try_into().unwrap() };
    for (prefix, list) in [("", vec!["trunk", "arm", "hand", "rod", "plate"]), ("some_", vec!["hand", "plate"])] {
        let chosen: Vec<&Body> = BODIES.iter().filter(|body| list.contains(&body.0)).collect();
        let mass: f64 = chosen.iter().map(|body| body.1).sum();
        let mean = |letter: &str| {
            let sum = chosen.iter().fold([0.0; 3], |sum, body| plus(&sum, &of(letter, body.0).map(|x| x * body.1)));
            sum.map(|x| x / mass)
        };
        let (centre, speed) = (mean("x"), mean("v"));
        let mut spin = [0.0; 3];
        for (name, m, _, [xx, yy, zz, xy, xz, yz]) in &chosen {
            let rows: Vec<f64> = found[&format!("r_{name}")].clone();
            let r: Matrix = [0, 1, 2].map(|i| [0, 1, 2].map(|j| rows[3 * i + j]));
            let inertia = times(&times(&r, &[[*xx, *xy, *xz], [*xy, *yy, *yz], [*xz, *yz, *zz]]), &transpose(&r));
            let [x, v] = [of("x", name), of("v", name)];
            let [dx, dy, dz] = [0, 1, 2].map(|k| x[k] - centre[k]);
            let orbit = [dy * v[2] - dz * v[1], dz * v[0] - dx * v[2], dx * v[1] - dy * v[0]].map(|x| x * m);
            spin = plus(&spin, &plus(&orbit, &apply(&inertia, &of("w", name))));
        }
        let got = |name: &str| found[&format!("{prefix}{name}")].clone();
        let tell = |name: &str| format!("{what}, {prefix}{name}");
        close(&tell("mass"), &got("mass"), &[mass], 1e-13);
        close(&tell("centre"), &got("centre"), &centre, 1e-12);
        close(&tell("speed"), &got("speed"), &speed, 1e-12);
        close(&tell("rush"), &got("rush"), &mean("a"), 1e-11);
        close(&tell("p"), &got("p"), &speed.map(|x| x * mass), 1e-12);
        close(&tell("h"), &got("h"), &spin, 1e-12);
    }
    close(&format!("{what}, slope"), &found["slope"], &found["speed"], 1e-12);
}

/// Trees of every kind of joint; a body that is welded to the ground counts too.
#[test]
fn trees() {
    let floats = "joint a: Free { parent: ground, child: trunk }
        joint b: Ball { parent: trunk.at([0.2, -0.1, 0.4]), child: arm.at([0.1, 0.05, -0.1]) }
        joint c: Screw { parent: arm.at([0.3, 0.1, 0.2]).rotated([1, 2, 2], 0.7), child: hand, axis: [2, -1, 2], pitch: 0.13 }
        joint d: Universal { parent: trunk.at([-0.2, 0.3, 0.1]), child: rod, axes: [[1, 1, 0], [1, -1, 0.5]] }
        joint e: Prismatic { parent: rod.at([0.1, 0.2, 0.3]), child: plate, axis: [1, -2, 3] }";
    let stands = "joint a: Fixed { parent: ground.at([0.3, 0.4, -0.2]), child: trunk }
        joint b: Revolute { parent: trunk.at([0.2, -0.1, 0.4]), child: arm.at([0.1, 0.05, -0.1]), axis: [1, 2, -3], armature: 0.4 }
        joint c: Revolute { parent: arm.at([0.3, 0.1, 0.2]), child: hand, axis: [2, -1, 2] }
        joint d: Planar { parent: ground, child: rod, axis: [1, 1, 1] }
        joint e: Cylindrical { parent: rod.at([0.1, 0.2, 0.3]), child: plate, axis: [1, -2, 3] }";
    for (what, joints) in [("floats", floats), ("stands", stands)] {
        let case = case(&format!("{}{joints}{WHOLE}", bodies()));
        (1..4).for_each(|seed| check(what, &case, seed));
    }
}

/// A loop in the formulations that it can have, bodies relative and absolute.
#[test]
fn loops_in_every_formulation() {
    let joints = "let side = ground.at([0.2, 0.1, -0.4]).rotated([1, 2, 2], 0.7);
        joint a: Revolute { parent: side, child: trunk, axis: Z }
        joint b: Revolute { parent: trunk.at(0.3 * X), child: arm, axis: Z }
        joint c: Revolute { parent: side.at(1.3 * X), child: hand, axis: Z }
        #[cut]
        joint k: Revolute { parent: arm.at(1.5 * X), child: hand.at(1.0 * X), axis: Z }
        joint d: Universal { parent: hand.at([-0.2, 0.3, 0.1]), child: rod, axes: [X, Y] }
        joint e: Prismatic { parent: rod.at([0.1, 0.2, 0.3]), child: plate, axis: [1, -2, 3] }";
    let solved = "solve (b, c) from k { sin(c.angle - a.angle - b.angle) > 0.0 }";
    for formulation in [
        "constraints: Reduced",
        "constraints: Multipliers",
        "coordinates: Absolute(Quaternion), constraints: Multipliers",
    ] {
        let solved = if formulation.contains("Reduced") { solved } else { "" };
        let case = case(&format!("formulation {{ {formulation} }} {}{joints} {solved} {WHOLE}", bodies()));
        (1..3).for_each(|seed| check(formulation, &case, seed));
    }
}

/// Parts stand for their bodies, in arrays and inside each other.
#[test]
fn parts_are_their_bodies() {
    let parts = "mod foot { port up: Frame; body sole { mass: 0.5, com: X } joint k: Prismatic { parent: up, child: sole, axis: Y } }
        mod leg { port up: Frame; body shank { mass: 1.25, com: Y } joint h: Prismatic { parent: up, child: shank, axis: X }
            part foot: foot { up: shank.at(Z) }; output own = total_mass([shank, foot]); }";
    let case = case_with(
        parts,
        "body b { mass: 4.0 } joint j: Prismatic { parent: ground, child: b, axis: Z }
         part legs: [leg; 3] = |i| leg { up: b.at(i * X) };
         output all = total_mass(); output of_legs = total_mass(legs); output of_two = total_mass([legs[0], b, legs[1].foot]);
         output push = linear_momentum(legs[2].foot); emit forward_dynamics;",
    );
    let point = case.random(5);
    close("all", &case.output("all", &point), &[4.0 + 3.0 * 1.75], 1e-15);
    close("legs", &case.output("of_legs", &point), &[3.0 * 1.75], 1e-15);
    close("two", &case.output("of_two", &point), &[1.75 + 4.0 + 0.5], 1e-15);
    // Of one of the legs.
    close("own", &case.output("own", &point), &[1.75], 1e-15);
    let v = case.velocity(&point);
    // b along z, then shank along x and sole along y of each leg.
    close("push", &case.output("push", &point), &[0.5 * v[5], 0.5 * v[6], 0.5 * v[0]], 1e-15);
}
