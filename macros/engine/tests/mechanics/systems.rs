//! Mass, centre of mass and momenta of several bodies as one: sums over the bodies in f64, derivatives along motions, and the
//! balance of momentum and of angular momentum.

use super::support::*;

/// A part on an oblique hinge, with a part of its own.
pub(super) const PARTS: &str = "
    mod toe {
        port foot: Frame;
        param heavy = 0.35;
        body tip { mass: heavy, com: [0.03, -0.02, 0.05], inertia: inertia(0.02, 0.03, 0.025, 0.002, -0.003, 0.001) }
        joint bend: Screw { parent: foot, child: tip.rotated(Y, 0.4), axis: [0.0, 1.0, -1.0], pitch: 0.05, armature: 0.02 }
    }
    mod leg {
        port hip: Frame;
        body shank { mass: 0.8, com: [0.1, 0.2, -0.3], inertia: inertia(0.2, 0.15, 0.12, 0.01, -0.02, 0.015) }
        joint knee: Universal { parent: hip, child: shank, axes: [X, [0.0, 1.0, 1.0]] }
        part toes: [toe; 2] = |i| toe { foot: shank.at([0.3, 0.1 * i, -0.2]).rotated([1.0, 2.0, 0.5], 0.3 + i) };
        output own_momentum = linear_momentum([shank, toes]);
    }";

/// Everything floats but the puck, which stands on the ground like the block.
pub(super) const BODIES: &str = "
    param hull_mass = 2.0;
    body hull { mass: hull_mass, com: [0.1, 0.05, -0.1], inertia: inertia(0.5, 0.6, 0.7, 0.02, -0.03, 0.01) }
    body boom { mass: 0.4, com: [0.3, 0.1, -0.2], inertia: inertia(0.06, 0.05, 0.04, 0.01, 0.02, -0.01) }
    body ball { mass: 0.6, com: [0.0, 0.1, 0.05], inertia: inertia(0.03, 0.05, 0.04, 0.005, 0.004, -0.006) }
    body tag { mass: 0.25, com: [0.1, -0.2, 0.05], inertia: inertia(0.003, 0.004, 0.005, 0.001, 0.0, 0.001) }
    part leg: leg { hip: hull.at([0.2, -0.1, 0.3]).rotated([0.3, 1.0, -0.4], 0.6) };
    joint float: Free { parent: ground, child: hull.at([0.1, 0.2, -0.1]).rotated([1.0, 0.4, 0.2], 0.7) }
    joint reach: Cylindrical { parent: hull.at([0.3, 0.1, -0.2]), child: boom.rotated(Y, 0.2), axis: [-1.0, 0.5, 0.3] }
    joint socket: Ball { parent: boom.at([0.2, 0.5, 0.1]).rotated(X, 0.3), child: ball.at([0.0, 0.1, 0.1]) }
    joint glue: Fixed { parent: ball.at(0.2 * X).rotated([1.0, 1.0, 0.0], 0.5), child: tag }";

pub(super) const GROUNDED: &str = "
    body puck { mass: 0.7, com: [0.1, 0.02, 0.03], inertia: inertia(0.1, 0.2, 0.15, 0.01, 0.02, -0.03) }
    body block { mass: 1.3, com: [0.4, -0.2, 0.1] }
    joint table: Planar { parent: ground.rotated([1.0, 0.2, 0.0], 0.4), child: puck, axis: [0.2, 0.1, 1.0] }
    joint post: Fixed { parent: ground.at([1.0, 2.0, 3.0]).rotated(X, 0.3), child: block }";

/// Name in expressions, mass, centre of mass, inertia.
pub(super) type Body = (&'static str, f64, [f64; 3], [f64; 6]);

pub(super) const LIST: [Body; 9] = [
    ("hull", 2.0, [0.1, 0.05, -0.1], [0.5, 0.6, 0.7, 0.02, -0.03, 0.01]),
    ("boom", 0.4, [0.3, 0.1, -0.2], [0.06, 0.05, 0.04, 0.01, 0.02, -0.01]),
    ("ball", 0.6, [0.0, 0.1, 0.05], [0.03, 0.05, 0.04, 0.005, 0.004, -0.006]),
    ("tag", 0.25, [0.1, -0.2, 0.05], [0.003, 0.004, 0.005, 0.001, 0.0, 0.001]),
    ("leg.shank", 0.8, [0.1, 0.2, -0.3], [0.2, 0.15, 0.12, 0.01, -0.02, 0.015]),
    ("leg.toes[0].tip", 0.35, [0.03, -0.02, 0.05], [0.02, 0.03, 0.025, 0.002, -0.003, 0.001]),
    ("leg.toes[1].tip", 0.35, [0.03, -0.02, 0.05], [0.02, 0.03, 0.025, 0.002, -0.003, 0.001]),
    ("puck", 0.7, [0.1, 0.02, 0.03], [0.1, 0.2, 0.15, 0.01, 0.02, -0.03]),
    ("block", 1.3, [0.4, -0.2, 0.1], [0.0; 6]),
];

/// Arguments, and which bodies they mean.
const CHOICES: [(&str, &[usize]); 8] = [
    ("", &[0, 1, 2, 3, 4, 5, 6, 7, 8]),
    ("[hull, boom, ball, tag, leg]", &[0, 1, 2, 3, 4, 5, 6]),
    ("[leg]", &[4, 5, 6]),
    ("[leg.toes]", &[5, 6]),
    ("[leg.toes[1], tag, leg.toes[0].tip]", &[3, 5, 6]),
    ("[boom, ball]", &[1, 2]),
    ("[puck, tag]", &[3, 7]),
    ("[block]", &[8]),
];

/// All quantities of one choice, under a number.
fn asked(number: usize, list: &str) -> String {
    format!(
        "output mass_{number} = total_mass({list});
        output centre_{number} = centre_of_mass({list});
        output velocity_{number} = centre_of_mass({list}).velocity;
        output acceleration_{number} = centre_of_mass({list}).acceleration;
        output linear_{number} = linear_momentum({list});
        output angular_{number} = angular_momentum({list});
        output moving_{number} = diff(centre_of_mass({list}), t);
        output speeding_{number} = diff(centre_of_mass({list}).velocity, t);"
    )
}

pub(super) fn vector(list: &[f64]) -> [f64; 3] {
    std::array::from_fn(|k| list[k])
}

pub(super) fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    std::array::from_fn(|k| a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3])
}

pub(super) fn scaled(factor: f64, v: &[f64; 3]) -> [f64; 3] {
    v.map(|x| factor * x)
}

/// A body's mass, its centre of mass with velocity and acceleration, and its angular momentum about that.
struct Moving {
    mass: f64,
    motion: [[f64; 3]; 3],
    spin: [f64; 3],
}

#[test]
fn sums_over_the_bodies() {
    let mut text = format!("world {{ gravity: [1.0, -9.0, 2.0] }} {BODIES} {GROUNDED} emit forward_dynamics;");
    for (k, (name, _, com, _)) in LIST.iter().enumerate() {
        let point = format!("{name}.at({com:?})");
        text += &format!(
            "output motion_{k} = [{point}.position, {point}.velocity, {point}.acceleration];
            output rotation_{k} = {name}.rotation; output spin_{k} = {name}.angular_velocity;"
        );
    }
    for (number, (list, _)) in CHOICES.iter().enumerate() {
        text += &asked(number, list);
    }
    text += "output own = leg.own_momentum; output shared = linear_momentum([leg]);";
    let case = case_with(PARTS, &text);
    for seed in 1..4 {
        let outputs = case.outputs(&case.random(seed));
        let bodies: Vec<Moving> = LIST
            .iter()
            .enumerate()
            .map(|(k, (_, mass, _, [xx, yy, zz, xy, xz, yz]))| {
                let motion = &outputs[&format!("motion_{k}")];
                let rows = &outputs[&format!("rotation_{k}")];
                let rotation: Matrix = std::array::from_fn(|i| vector(&rows[3 * i..]));
                let tensor = [[*xx, *xy, *xz], [*xy, *yy, *yz], [*xz, *yz, *zz]];
                let turned = apply(&transpose(&rotation), &vector(&outputs[&format!("spin_{k}")]));
                Moving {
                    mass: *mass,
                    motion: std::array::from_fn(|order| vector(&motion[3 * order..])),
                    spin: apply(&rotation, &apply(&tensor, &turned)),
                }
            })
            .collect();
        for (number, (list, chosen)) in CHOICES.iter().enumerate() {
            let chosen: Vec<&Moving> = chosen.iter().map(|&k| &bodies[k]).collect();
            let mass: f64 = chosen.iter().map(|body| body.mass).sum();
            let mean = |order: usize| {
                let sum = chosen.iter().fold([0.0; 3], |sum, body| plus(&sum, &scaled(body.mass, &body.motion[order])));
                scaled(1.0 / mass, &sum)
            };
            let centre = mean(0);
            let angular = chosen.iter().fold([0.0; 3], |sum, body| {
                let arm = plus(&body.motion[0], &scaled(-1.0, &centre));
                plus(&plus(&sum, &body.spin), &cross(&arm, &scaled(body.mass, &body.motion[1])))
            });
            let same = |name: &str, expected: &[f64]| {
                close(&format!("{name} of {list}"), &outputs[&format!("{name}_{number}")], expected, 1e-11);
            };
            same("mass", &[mass]);
            same("centre", &centre);
            same("velocity", &mean(1));
            same("acceleration", &mean(2));
            same("linear", &scaled(mass, &mean(1)));
            same("angular", &angular);
            same("moving", &mean(1));
            same("speeding", &mean(2));
        }
        close("inside the part", &outputs["own"], &outputs["shared"], 1e-14);
    }
}

/// Whatever joints, springs and motors do inside a tree that floats, it moves by what acts from outside alone.
#[test]
fn momenta_change_by_what_acts_from_outside() {
    let inner = "input push: Vec3;
        force motor: Effort { joint: reach.travel, value: 3.0 + push.x }
        force coil: Spring { joint: leg.knee.first, stiffness: 12.0, rest: 0.2 }
        force band: SpringDamper { between: [tag, leg.shank], stiffness: 9.0, damping: 0.8, length: 0.3 }";
    let outer = "world { gravity: [0.5, -9.0, 1.0] }
        force jet: Force { at: ball.at([0.1, 0.3, -0.2]), value: push, axes: boom }
        force spin: Torque { at: leg.shank, value: [0.3, push.y, -0.4], axes: hull }
        output point = ball.at([0.1, 0.3, -0.2]).position;
        output axes = boom.rotation; output other = hull.rotation; output given = push;";
    let asked = asked(0, "");
    let still = case_with(PARTS, &format!("{BODIES} {inner} {asked} emit forward_dynamics;"));
    let point = still.random(5);
    for name in ["linear_0", "angular_0"] {
        let rate = still.rate_along_flow(&point, |p| still.output(name, p));
        close(name, &rate, &[0.0; 3], 1e-8);
        let size = still.output(name, &point).iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        assert!(size > 0.1, "{name} is {size}");
    }
    let case = case_with(PARTS, &format!("{BODIES} {inner} {outer} {asked} emit forward_dynamics;"));
    for seed in 1..4 {
        let point = case.random(seed);
        let outputs = case.outputs(&point);
        let rotated = |name: &str, v: &[f64; 3]| {
            let rows: Matrix = std::array::from_fn(|i| vector(&outputs[name][3 * i..]));
            apply(&rows, v)
        };
        let push = vector(&outputs["given"]);
        let force = rotated("axes", &push);
        let torque = rotated("other", &[0.3, push[1], -0.4]);
        let mass = outputs["mass_0"][0];
        let arm = plus(&vector(&outputs["point"]), &scaled(-1.0, &vector(&outputs["centre_0"])));
        let weight = scaled(mass, &[0.5, -9.0, 1.0]);
        let rate = |name: &str| case.rate_along_flow(&point, |p| case.output(name, p));
        close("force", &rate("linear_0"), &plus(&weight, &force), 1e-7);
        close("moment", &rate("angular_0"), &plus(&cross(&arm, &force), &torque), 1e-7);
        let acceleration = scaled(1.0 / mass, &plus(&weight, &force));
        close("acceleration", &outputs["acceleration_0"], &acceleration, 1e-10);
        close("velocity", &rate("centre_0"), &outputs["velocity_0"], 1e-8);
    }
}

/// A force may follow the motion of the whole: it stops where it is.
#[test]
fn forces_follow_the_whole() {
    let case = case_with(
        PARTS,
        &format!(
            "{BODIES} force brake: Force {{ at: hull.at([0.1, 0.2, 0.3]), value: -3.0 * linear_momentum() - total_mass() * centre_of_mass(), axes: ground }}
            {} emit forward_dynamics;",
            asked(0, "")
        ),
    );
    let point = case.random(3);
    let outputs = case.outputs(&point);
    let expected: [f64; 3] =
        std::array::from_fn(|k| -3.0 * outputs["linear_0"][k] - outputs["mass_0"][0] * outputs["centre_0"][k]);
    close("force", &scaled(outputs["mass_0"][0], &vector(&outputs["acceleration_0"])), &expected, 1e-10);
}

/// A declaration of the user's own comes first, and the names stay free.
#[test]
fn names_are_free() {
    let case = case(
        "let total_mass(x) = 3.0 * x;
        body b { mass: 2.0, com: X, inertia: diag(0.1, 0.2, 0.3) }
        joint linear_momentum: Revolute { parent: ground, child: b, axis: Z }
        output own = total_mass(2.0);
        output centre_of_mass = centre_of_mass();
        output angular = angular_momentum().z - 0.3 * linear_momentum.rate;
        emit forward_dynamics;",
    );
    let outputs = case.outputs(&case.random(1));
    assert_eq!(outputs["own"], [6.0]);
    close("angular", &outputs["angular"], &[0.0], 1e-14);
    close("distance", &[outputs["centre_of_mass"].iter().map(|x| x * x).sum()], &[1.0], 1e-14);
}
