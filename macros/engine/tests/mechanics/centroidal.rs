//! The centroidal momentum matrix: column by column against sums over the bodies by their Jacobians, against the momenta that
//! expressions give, in all formulations; its rate along free motion against what acts from outside.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;

use super::support::*;
use super::systems::{BODIES, Body, GROUNDED, LIST, PARTS, cross, scaled, vector};

const MATRIX: &str = "emit forward_dynamics, centroidal_momentum_matrix;";

/// What the sums need: of each body place, rotation and Jacobian in the axes of the ground, at its centre of mass.
fn shown(bodies: &[Body]) -> String {
    let one = |(k, (name, _, com, _)): (usize, &Body)| {
        format!(
            "output centre_{k} = {name}.at({com:?}).position; output rotation_{k} = {name}.rotation;
            output jacobian_{k} = {name}.at({com:?}).jacobian;"
        )
    };
    bodies.iter().enumerate().map(one).collect()
}

/// A = sum of (R I R^T Jw + m r x Jv, m Jv), by columns.
fn summed(case: &Case, point: &Point, bodies: &[Body]) -> Vec<Vec<f64>> {
    let outputs = case.outputs(point);
    let mass: f64 = bodies.iter().map(|body| body.1).sum();
    let place = |k: usize| vector(&outputs[&format!("centre_{k}")]);
    let centre = (0..bodies.len()).fold([0.0; 3], |sum, k| plus(&sum, &scaled(bodies[k].1 / mass, &place(k))));
    let n = case.structure.state.len();
    let column = |column: usize| {
        let mut momenta = [[0.0; 3]; 2];
        for (k, (_, mass, _, [xx, yy, zz, xy, xz, yz])) in bodies.iter().enumerate() {
            let rows = &outputs[&format!("rotation_{k}")];
            let rotation: Matrix = std::array::from_fn(|i| vector(&rows[3 * i..]));
            let jacobian = &outputs[&format!("jacobian_{k}")];
            let [linear, angular]: [[f64; 3]; 2] =
                std::array::from_fn(|half| std::array::from_fn(|i| jacobian[(3 * half + i) * n + column]));
            let tensor = [[*xx, *xy, *xz], [*xy, *yy, *yz], [*xz, *yz, *zz]];
            let spin = apply(&rotation, &apply(&tensor, &apply(&transpose(&rotation), &angular)));
            let pushed = scaled(*mass, &linear);
            let arm = plus(&place(k), &scaled(-1.0, &centre));
            momenta[0] = plus(&plus(&momenta[0], &spin), &cross(&arm, &pushed));
            momenta[1] = plus(&momenta[1], &pushed);
        }
        momenta.concat()
    };
    (0..n).map(column).collect()
}

fn matrix(case: &Case, point: &Point) -> Vec<Vec<f64>> {
    let (n, all) = (case.structure.state.len(), case.eval(FunctionKind::CentroidalMomentumMatrix, point));
    assert_eq!(all.len(), 6 * n);
    (0..n).map(|column| (0..6).map(|row| all[row * n + column]).collect()).collect()
}

fn check(what: &str, case: &Case, bodies: &[Body]) {
    for seed in 1..4 {
        let point = case.random(seed);
        let (found, expected) = (matrix(case, &point), summed(case, &point, bodies));
        for (column, (found, expected)) in found.iter().zip(&expected).enumerate() {
            close(&format!("{what}, column {column}"), found, expected, 1e-10);
        }
    }
}

#[test]
fn columns_are_sums_over_the_bodies() {
    for (what, inside, bodies) in [("floating", "", 0..7), ("with what stands on the ground", GROUNDED, 0..9)] {
        let bodies = &LIST[bodies];
        check(what, &case_with(PARTS, &format!("{BODIES} {inside} {} {MATRIX}", shown(bodies))), bodies);
    }
}

const LINKS: [Body; 3] = [
    ("a", 1.0, [0.5, 0.1, 0.2], [0.5, 0.6, 0.7, 0.02, -0.03, 0.01]),
    ("b", 0.7, [1.1, -0.2, 0.1], [0.3, 0.2, 0.4, 0.01, 0.02, -0.01]),
    ("c", 1.3, [0.9, 0.2, -0.1], [0.4, 0.5, 0.3, 0.005, 0.004, -0.006]),
];

/// The links, without joints.
fn links() -> String {
    let one = |(name, mass, com, tensor): &Body| {
        let tensor = tensor.map(|x| x.to_string()).join(", ");
        format!("body {name} {{ mass: {mass:?}, com: {com:?}, inertia: inertia({tensor}) }}")
    };
    LINKS.iter().map(one).collect::<String>() + &shown(&LINKS) + MATRIX
}

#[test]
fn in_trees_of_all_formulations() {
    let joints = "joint rail: Prismatic { parent: ground.at([3.0, 1.0, 2.0]), child: a.rotated(X, 0.3), axis: [1.0, 0.3, -0.2] }
        joint hinge: Revolute { parent: a.at([1.0, 0.2, 0.0]), child: b, axis: [-1.0, 0.0, 0.0], armature: 0.3 }
        joint slot: PinSlot { parent: a, child: c.rotated([1.0, 1.0, 0.0], 0.4), axis: [0.2, 1.0, 0.5], slide: [5.0, -1.0, 0.0] }";
    for items in [
        "",
        "drive hinge.angle = sin(3.0 * t);",
        "constraint gear = hinge.angle + 2.0 * rail.travel - 0.1; formulation { constraints: Reduced }",
        "constraint gear = hinge.angle + 2.0 * rail.travel - 0.1;",
        "formulation { coordinates: Absolute(Quaternion) }",
        "formulation { coordinates: Absolute(RollPitchYaw) }",
    ] {
        check(items, &case(&format!("{} {joints} {items}", links())), &LINKS);
    }
}

#[test]
fn in_loops_of_all_formulations() {
    let joints = "let n = [0.36, 0.48, 0.8];
        joint crank: Revolute { parent: ground.at([0.1, 0.2, 0.3]), child: a, axis: n }
        joint coupler: Revolute { parent: a.at([0.8, -0.6, 0.0]), child: b, axis: n }
        joint rocker: Revolute { parent: ground.at([2.5, -1.6, 0.3]), child: c, axis: n }
        #[cut] joint pin: Revolute { parent: b.at(2.5 * [0.8, -0.6, 0.0]), child: c.at(2.0 * [0.8, -0.6, 0.0]), axis: n }";
    for items in [
        "",
        "formulation { constraints: Reduced }",
        "formulation { constraints: Reduced } solve (coupler, rocker) from pin { sin(rocker - coupler - crank) > 0 }",
        "formulation { constraints: Reduced } drive crank = t;",
        "formulation { coordinates: Absolute(Quaternion) }",
        "formulation { coordinates: Absolute(RollPitchYaw) }",
    ] {
        check(items, &case(&format!("{} {joints} {items}", links())), &LINKS);
    }
}

/// A plate on six struts of two bodies each, whose coordinates all follow from the plate's: the whole with its legs, and its rates.
#[test]
fn on_struts() {
    const NAMES: [[&str; 2]; 6] = [
        ["legs[0].cylinder", "legs[0].piston"],
        ["legs[1].cylinder", "legs[1].piston"],
        ["legs[2].cylinder", "legs[2].piston"],
        ["legs[3].cylinder", "legs[3].piston"],
        ["legs[4].cylinder", "legs[4].piston"],
        ["legs[5].cylinder", "legs[5].piston"],
    ];
    let mut bodies: Vec<Body> = vec![("plate", 1.5, [0.01, 0.02, -0.03], [0.08, 0.09, 0.1, 0.0, 0.0, 0.0])];
    for [cylinder, piston] in NAMES {
        bodies.push((cylinder, 0.1, [0.0, 0.0, 0.5], [0.006, 0.006, 0.0, 0.0, 0.0, 0.0]));
        bodies.push((piston, 0.2, [0.0, 0.0, -0.4], [0.005, 0.005, 0.0, 0.0, 0.0, 0.0]));
    }
    let leg = "mod leg { port base: Frame; port tip: Frame;
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.006, 0.006, 0.0) }
        body piston { mass: 0.2, com: -0.4 * Z, inertia: diag(0.005, 0.005, 0.0) }
        joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(1.0 * Z), child: piston, axis: Z }
        #[cut] joint ball: Ball { parent: piston, child: tip }
        force actuator: Effort { joint: stroke, value: 2.0 - 0.3 * stroke.rate }
        solve (gimbal, stroke) from ball { stroke.travel > -1.0, cos(gimbal.second) > 0.0 } }";
    let plate = "
        const FEET = [[-2.1, 1.4, 0.0], [-2.4, 1.2, 0.1], [-2.3, -1.2, 0.0], [-2.1, -1.3, 0.0], [0.1, -0.2, 0.0], [0.0, 0.15, 0.2]];
        const PINS = [[0.2, 0.6, 2.0], [-0.6, 0.2, 2.1], [-0.6, -0.2, 2.0], [0.2, -0.6, 2.0], [0.4, -0.4, 2.2], [0.4, 0.4, 2.0]];
        world { gravity: -9.81 * Z } formulation { constraints: Reduced }
        body plate { mass: 1.5, com: [0.01, 0.02, -0.03], inertia: diag(0.08, 0.09, 0.1), coordinates: Absolute(RollPitchYaw) }
        part legs: [leg; 6] = |i| leg { base: ground.at(FEET[i]), tip: plate.at(PINS[i]) };
        output momenta = [angular_momentum(), linear_momentum()]; output centre = centre_of_mass();
        output mass = total_mass(); output velocity = centre_of_mass().velocity;
        output acceleration = centre_of_mass().acceleration;";
    let case = case_with(leg, &format!("{plate} {} {MATRIX}", shown(&bodies)));
    check("struts", &case, &bodies);
    let point = case.random(2);
    let outputs = case.outputs(&point);
    close("mass", &outputs["mass"], &[bodies.iter().map(|body| body.1).sum()], 1e-14);
    close("momenta", &times_velocities(&case, &point), &outputs["momenta"], 1e-11);
    let centre = bodies.iter().enumerate().fold([0.0; 3], |sum, (k, body)| {
        plus(&sum, &scaled(body.1 / outputs["mass"][0], &vector(&outputs[&format!("centre_{k}")])))
    });
    close("centre", &outputs["centre"], &centre, 1e-12);
    // The plate's angles and their rates are the state.
    let accelerations = case.eval(FunctionKind::ForwardDynamics, &point);
    let later = |time: f64| {
        let mut later = point.clone();
        for (of, acceleration) in case.structure.state.iter().zip(&accelerations) {
            let position = Symbol::Position { joint: of.joint, component: of.index };
            let velocity = Symbol::Velocity { joint: of.joint, component: of.index };
            let (q, v) = (point.get(position), point.get(velocity));
            later.set(position, q + time * (v + 0.5 * time * acceleration));
            later.set(velocity, v + time * acceleration);
        }
        later
    };
    let rate = |name: &str| case.derivative(|time| case.output(name, &later(time)));
    close("velocity", &rate("centre"), &outputs["velocity"], 1e-7);
    close("acceleration", &rate("velocity"), &outputs["acceleration"], 1e-6);
}

/// With the velocities of the state it gives the momenta of expressions, but for what moves in time by itself.
#[test]
fn times_velocities_it_is_the_momenta() {
    let momenta = "output momenta = [angular_momentum(), linear_momentum()];";
    for drive in ["", "drive reach.angle = 2.0 * t * t;"] {
        let case = case_with(PARTS, &format!("{BODIES} {GROUNDED} {momenta} {drive} {MATRIX}"));
        let state = case.structure.state.clone();
        for seed in 1..4 {
            let point = case.random(seed);
            let still = state.iter().fold(point.clone(), |mut point, coordinate| {
                point.set(Symbol::Velocity { joint: coordinate.joint, component: coordinate.index }, 0.0);
                point
            });
            let (moving, at_rest) = (case.output("momenta", &point), case.output("momenta", &still));
            let given: Vec<f64> = moving.iter().zip(&at_rest).map(|(a, b)| a - b).collect();
            assert_eq!(at_rest.iter().all(|&x| x == 0.0), drive.is_empty());
            close(drive, &times_velocities(&case, &point), &given, 1e-11);
        }
    }
}

fn times_velocities(case: &Case, point: &Point) -> Vec<f64> {
    matrix(case, point).iter().zip(&case.structure.state).fold(vec![0.0; 6], |mut sum, (column, of)| {
        let v = point.get(Symbol::Velocity { joint: of.joint, component: of.index });
        sum.iter_mut().zip(column).for_each(|(sum, x)| *sum += x * v);
        sum
    })
}

#[test]
fn it_changes_by_what_acts_from_outside() {
    let case = case_with(
        PARTS,
        &format!(
            "world {{ gravity: [0.5, -9.0, 1.0] }} {BODIES}
            force motor: Effort {{ joint: reach.travel, value: 3.0 }}
            force band: SpringDamper {{ between: [tag, leg.shank], stiffness: 9.0, damping: 0.8, length: 0.3 }}
            force jet: Force {{ at: ball.at([0.1, 0.3, -0.2]), value: [3.0, -2.0, 0.5], axes: ground }}
            force spin: Torque {{ at: leg.shank, value: [0.3, 0.7, -0.4], axes: ground }}
            output point = ball.at([0.1, 0.3, -0.2]).position; output centre = centre_of_mass(); {MATRIX}"
        ),
    );
    let mass: f64 = LIST[..7].iter().map(|body| body.1).sum();
    for seed in 1..4 {
        let point = case.random(seed);
        let force = [3.0, -2.0, 0.5];
        let arm = plus(&vector(&case.output("point", &point)), &scaled(-1.0, &vector(&case.output("centre", &point))));
        let moment = plus(&cross(&arm, &force), &[0.3, 0.7, -0.4]);
        let total = plus(&scaled(mass, &[0.5, -9.0, 1.0]), &force);
        let rate = case.rate_along_flow(&point, |p| times_velocities(&case, p));
        close("rate", &rate, &[moment, total].concat(), 1e-7);
    }
}

/// The way from the world's origin takes no part in it: far away it is the same to the last digits.
#[test]
fn it_stays_exact_far_from_the_origin() {
    let case = case_with(PARTS, &format!("{BODIES} {MATRIX}"));
    let point = case.random(2);
    let mut far = point.clone();
    for component in 0..3 {
        far.set(Symbol::Position { joint: case.joint("float"), component }, 1e9 * (1.0 + component as f64));
    }
    close("far away", &matrix(&case, &far).concat(), &matrix(&case, &point).concat(), 1e-14);
}
