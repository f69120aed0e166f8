//! Jacobians of frames in the velocities of the state: every column is what the twist gains where that velocity alone is
//! one, in open trees, beside drives, couplings and loops, in all formulations; and outputs behind them stay in place.

use multibody_engine::contracts::symbol::Symbol;

use super::support::*;

/// Columns against twists; the outputs behind are in their places.
fn columns(what: &str, text: &str) {
    let case = case(text);
    let state = case.structure.state.clone();
    for seed in 1..4 {
        let point = case.random(seed);
        let twist = |velocities: &[f64]| {
            let mut point = point.clone();
            for (coordinate, &value) in state.iter().zip(velocities) {
                point.set(Symbol::Velocity { joint: coordinate.joint, component: coordinate.index }, value);
            }
            case.output("twist", &point)
        };
        let jacobian = case.output("jacobian", &point);
        let still = twist(&vec![0.0; state.len()]);
        for column in 0..state.len() {
            let mut velocities = vec![0.0; state.len()];
            velocities[column] = 1.0;
            let moved: Vec<f64> = twist(&velocities).iter().zip(&still).map(|(a, b)| a - b).collect();
            let found: Vec<f64> = (0..6).map(|row| jacobian[row * state.len() + column]).collect();
            close(&format!("{what}, column {column}"), &found, &moved, 1e-10);
        }
        close(what, &case.output("behind", &point), &[point.get(Symbol::Time)], 0.0);
    }
}

const BODIES: &str = "body a { mass: 1.0, com: [0.5, 0.1, 0.2], inertia: diag(0.5, 0.6, 0.7) }
    body b { mass: 0.7, com: [1.1, -0.2, 0.1], inertia: diag(0.3, 0.2, 0.4) }
    output jacobian = b.at([0.3, -0.2, 0.4]).rotated([1, 2, 0.5], 0.7).jacobian;
    output twist = b.at([0.3, -0.2, 0.4]).rotated([1, 2, 0.5], 0.7).twist;
    output behind = t;";

#[test]
fn beside_drives() {
    let joints = "joint one: Revolute { parent: ground, child: a, axis: [1, 0.3, -0.2] }
        joint two: Cylindrical { parent: a.at([1, 0.2, 0]), child: b.rotated([1, 1, 0], 0.4), axis: [0.2, 1, 0.5] }";
    for drives in [
        "",
        "drive one.angle = sin(t);",
        "drive two.travel = 0.3 * t * t;",
        "drive two.angle = t;",
        "drive one = t; drive two.travel = 1 + t;",
    ] {
        columns(drives, &format!("{BODIES} {joints} {drives}"));
    }
    let free = "joint one: Free { parent: ground, child: a }
        joint two: Ball { parent: a.at([1, 0.2, 0]), child: b.rotated([1, 1, 0], 0.4) }";
    for drives in ["", "drive one.position = [t, sin(t), 2];", "drive two.orientation = rotation(Z, 0.7 * t);"] {
        columns(drives, &format!("{BODIES} {free} {drives}"));
    }
}

#[test]
fn beside_couplings() {
    let joints = "joint one: Revolute { parent: ground, child: a, axis: [1, 0.3, -0.2] }
        joint two: Planar { parent: a.at([1, 0.2, 0]), child: b, axis: [0.2, 1, 0.5] }";
    for items in [
        "constraint gear = two.angle + 2 * one - 0.1; formulation { constraints: Reduced }",
        "constraint gear = two.angle + 2 * one - 0.1;",
        "constraint gear = two.angle + 2 * one; constraint rack = two.x - 0.3 * one - 0.2 * two.y;
         formulation { constraints: Reduced }",
        "constraint gear = two.angle + 2 * one; drive two.y = sin(t); formulation { constraints: Reduced }",
    ] {
        columns(items, &format!("{BODIES} {joints} {items}"));
    }
}

#[test]
fn in_loops() {
    let bodies = "body c { mass: 1.3, com: [0.9, 0.2, -0.1], inertia: diag(0.4, 0.5, 0.3) }
        joint crank: Revolute { parent: ground, child: a, axis: Z }
        joint coupler: Revolute { parent: a.at(X), child: b, axis: Z }
        joint rocker: Revolute { parent: ground.at(3 * X), child: c, axis: Z }
        #[cut] joint pin: Revolute { parent: b.at(2.5 * X), child: c.at(2 * X), axis: Z }";
    for items in [
        "",
        "formulation { constraints: Reduced }",
        "formulation { constraints: Reduced } solve (coupler, rocker) from pin { sin(rocker - coupler - crank) > 0 }",
        "formulation { constraints: Reduced } drive crank = t;",
        "formulation { coordinates: Absolute(Quaternion) }",
        "formulation { coordinates: Absolute(RollPitchYaw) }",
    ] {
        columns(items, &format!("{BODIES} {bodies} {items}"));
    }
}
