//! Poses of all bodies against a plain recursion of matrices, against the meeting of a loop's ends, and against the state where
//! the state has the pose itself.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;

use super::support::*;

type Place = (Matrix, [f64; 3]);

fn then(a: &Place, b: &Place) -> Place {
    (times(&a.0, &b.0), plus(&a.1, &apply(&a.0, &b.1)))
}

fn flat(place: &Place) -> Vec<f64> {
    place.1.iter().chain(place.0.as_flattened()).copied().collect()
}

/// Of the bodies of this name, in the order of their parts.
fn poses(case: &Case, point: &Point, name: &str) -> Vec<Place> {
    let all = case.eval(FunctionKind::Poses, point);
    assert_eq!(all.len(), 12 * case.model.bodies.len());
    let bodies = case.model.bodies.iter().zip(all.chunks(12));
    let found = bodies
        .filter(|(body, _)| body.place.field == name)
        .map(|(_, p)| ([[p[3], p[4], p[5]], [p[6], p[7], p[8]], [p[9], p[10], p[11]]], [p[0], p[1], p[2]]));
    found.collect()
}

fn position(point: &Point, joint: usize, component: usize) -> f64 {
    point.get(Symbol::Position { joint: multibody_engine::model::types::JointId(joint), component })
}

/// A matrix as users type it, sixteen digits.
const TILT: Matrix = [
    [0.8660254037844387, -0.4698463103929542, 0.1710100716628344],
    [0.5, 0.8137976813493738, -0.2961981327260239],
    [0.0, 0.3420201433256687, 0.9396926207859084],
];

#[test]
fn a_tree_with_parts_is_where_matrices_put_it() {
    let case = case_with(
        "mod leg {
            port hip: Frame;
            param reach = 0.3171;
            body thigh { mass: 0.3, com: [0.15, 0.02, -0.01], inertia: diag(0.0001, 0.003, 0.003) }
            body foot { mass: 0.1, com: [0.05, 0.0, 0.01], inertia: diag(0.0001, 0.002, 0.002) }
            joint knee: Revolute { parent: hip, child: thigh.at([0.01, -0.02, 0.03]), axis: [0.36, 0.48, 0.8] }
            joint ankle: Cylindrical { parent: thigh.at(reach * X), child: foot, axis: [1.0, -2.0, 0.5] }
        }",
        "body trunk { mass: 2.0, com: [0.1, 0.2, -0.05], inertia: diag(0.1, 0.12, 0.2) }
        body plate { mass: 0.4, inertia: diag(0.1, 0.12, 0.2) }
        joint root: Ball { parent: ground.at([0.2, -0.7, 1.3]), child: trunk }
        joint weld: Fixed {
            parent: trunk.at([0.4, 0.1, 0.0]).oriented([
                [0.8660254037844387, -0.4698463103929542, 0.1710100716628344],
                [0.5, 0.8137976813493738, -0.2961981327260239],
                [0.0, 0.3420201433256687, 0.9396926207859084],
            ]),
            child: plate
        }
        part legs: [leg; 2] = |i| leg { hip: plate.rotated([1.0, 1.0, -3.0], 0.7 + i * 2.1).at(0.2 * X) };
        emit poses;",
    );
    for seed in 1..6 {
        let mut point = case.random(seed);
        for (k, joint) in case.model.joints.iter().enumerate().filter(|(_, joint)| !joint.kind.has_quaternion()) {
            let id = multibody_engine::model::types::JointId(k);
            for component in 0..joint.kind.freedoms() {
                let symbol = Symbol::Position { joint: id, component };
                // Several turns and metres away.
                point.set(symbol, 9.0 * point.get(symbol));
            }
        }
        let root = case.joint("root").0;
        let quaternion: Vec<f64> = (0..4).map(|k| position(&point, root, k)).collect();
        let trunk = (of_quaternion(&quaternion), [0.2, -0.7, 1.3]);
        let plate = then(&trunk, &(TILT, [0.4, 0.1, 0.0]));
        close("trunk", &flat(&poses(&case, &point, "trunk")[0]), &flat(&trunk), 1e-14);
        close("plate", &flat(&poses(&case, &point, "plate")[0]), &flat(&plate), 1e-14);
        let of = |name: &str| -> Vec<usize> {
            let joints = case.model.joints.iter().enumerate();
            joints.filter(|(_, joint)| joint.place.field == name).map(|(k, _)| k).collect()
        };
        let (knees, ankles) = (of("knee"), of("ankle"));
        let (thighs, feet) = (poses(&case, &point, "thigh"), poses(&case, &point, "foot"));
        assert_eq!((thighs.len(), feet.len()), (2, 2));
        for i in 0..2 {
            let turned = then(&plate, &(turn([1.0, 1.0, -3.0], 0.7 + i as f64 * 2.1), [0.0; 3]));
            let hip = then(&turned, &(ONE, [0.2, 0.0, 0.0]));
            let knee = then(&hip, &(turn([0.36, 0.48, 0.8], position(&point, knees[i], 0)), [0.0; 3]));
            let thigh = then(&knee, &(ONE, [-0.01, 0.02, -0.03]));
            close("thigh", &flat(&thighs[i]), &flat(&thigh), 1e-13);
            let joint = &case.model.joints[multibody_engine::model::types::JointId(ankles[i])];
            let slot = |name: &str| joint.kind.freedoms.iter().position(|freedom| freedom.name == name).unwrap();
            let [slide, angle] = ["travel", "angle"].map(|name| position(&point, ankles[i], slot(name)));
            let axis = [1.0, -2.0, 0.5];
            let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
            let ankle = (turn(axis, angle), axis.map(|x| slide * x / length));
            let foot = then(&then(&thigh, &(ONE, [0.3171, 0.0, 0.0])), &ankle);
            close("foot", &flat(&feet[i]), &flat(&foot), 1e-13);
        }
    }
}

fn four_bar(more: &str) -> Case {
    case(&format!(
        "let n = [0.36, 0.48, 0.8];
        body crank {{ mass: 1.0, com: 0.1 * X, inertia: diag(0.1, 0.1, 0.1) }}
        body coupler {{ mass: 1.0, com: 0.3 * X, inertia: diag(0.1, 0.1, 0.1) }}
        body rocker {{ mass: 1.0, com: 0.3 * X, inertia: diag(0.1, 0.1, 0.1) }}
        joint one: Revolute {{ parent: ground.at([0.1, 0.2, 0.3]), child: crank, axis: n }}
        joint two: Revolute {{ parent: crank.at(0.2 * [0.8, -0.6, 0.0]), child: coupler, axis: n }}
        joint three: Revolute {{ parent: ground.at([0.1, 0.2, 0.3] + 0.7 * [0.8, -0.6, 0.0]), child: rocker, axis: n }}
        #[cut] joint pin: Revolute {{
            parent: coupler.at(0.63 * [0.48, 0.64, -0.6]), child: rocker.at(0.58 * [0.48, 0.64, -0.6]), axis: n
        }}
        {more}
        emit poses;"
    ))
}

/// Whether the pin's ends are at one place, and its axis is where it always is.
fn check_pin(case: &Case, point: &Point) {
    let [coupler, rocker] = ["coupler", "rocker"].map(|name| poses(case, point, name)[0]);
    let end = |place: &Place, length: f64| plus(&place.1, &apply(&place.0, &[0.48, 0.64, -0.6].map(|x| length * x)));
    close("pin", &end(&coupler, 0.63), &end(&rocker, 0.58), 1e-12);
    let axis = [0.36, 0.48, 0.8];
    for place in [coupler, rocker] {
        close("axis", &apply(&place.0, &axis), &axis, 1e-13);
        close("rotation", times(&place.0, &transpose(&place.0)).as_flattened(), ONE.as_flattened(), 1e-13);
    }
}

#[test]
fn the_ends_of_a_loop_meet() {
    let solved = "solve (two, three) from pin { sin(three.angle - one.angle - two.angle) > 0.0 }";
    let case = four_bar(&format!("formulation {{ constraints: Reduced, independent: [one] }} {solved}"));
    for seed in 1..6 {
        let mut point = case.random(seed);
        let symbol = Symbol::Position { joint: case.joint("one"), component: 0 };
        point.set(symbol, 11.0 * point.get(symbol));
        let crank = (turn([0.36, 0.48, 0.8], point.get(symbol)), [0.1, 0.2, 0.3]);
        close("crank", &flat(&poses(&case, &point, "crank")[0]), &flat(&crank), 1e-14);
        check_pin(&case, &point);
    }
}

#[test]
fn a_drive_puts_bodies_where_the_time_says() {
    let solved = "solve (two, three) from pin { sin(three.angle - one.angle - two.angle) > 0.0 }";
    let case = four_bar(&format!("formulation {{ constraints: Reduced }} drive one.angle = 0.3 + 2.0 * t; {solved}"));
    for time in [0.0, 0.4, 7.0] {
        let mut point = case.random(3);
        point.set(Symbol::Time, time);
        let crank = (turn([0.36, 0.48, 0.8], 0.3 + 2.0 * time), [0.1, 0.2, 0.3]);
        close("crank", &flat(&poses(&case, &point, "crank")[0]), &flat(&crank), 1e-14);
        check_pin(&case, &point);
    }
}

#[test]
fn absolute_coordinates_are_the_poses() {
    let case = case(
        "body a { mass: 1.0, com: [0.1, 0.2, 0.0], inertia: diag(0.1, 0.12, 0.2) }
        body b { mass: 1.0, com: [0.1, 0.2, 0.0], inertia: diag(0.1, 0.12, 0.2) }
        joint one: Revolute { parent: ground, child: a, axis: [0.36, 0.48, 0.8] }
        joint two: Revolute { parent: a.at([0.3, 0.1, -0.2]), child: b, axis: [1.0, -2.0, 0.5] }
        formulation { coordinates: Absolute(Quaternion) }
        emit poses;",
    );
    for seed in 1..4 {
        let point = case.random(seed);
        let joints = case.model.joints.iter().enumerate();
        let free: Vec<usize> = joints.filter(|(_, joint)| joint.kind.is_free()).map(|(k, _)| k).collect();
        assert_eq!(free.len(), 2);
        for (joint, name) in free.into_iter().zip(["a", "b"]) {
            let state: Vec<f64> = (0..7).map(|k| position(&point, joint, k)).collect();
            let place = (of_quaternion(&state[3..]), [state[0], state[1], state[2]]);
            close(name, &flat(&poses(&case, &point, name)[0]), &flat(&place), 1e-14);
        }
    }
}
