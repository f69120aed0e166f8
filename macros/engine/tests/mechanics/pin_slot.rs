//! Joints that slide and turn against chains of joints with massless bodies between, and a slotted lever by hand.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;

use super::support::*;

/// Bodies with a hinge in front, so that the joint's parent moves too, and something behind.
fn arm(joints: &str, tip: &str) -> Case {
    case(&format!(
        "world {{ gravity: [0.3, -9.0, 1.0] }}
        input push;
        body base {{ mass: 1.3, com: [0.1, 0.2, -0.1], inertia: inertia(0.5, 0.6, 0.7, 0.02, -0.03, 0.01) }}
        body arm {{ mass: 0.8, com: [0.2, -0.1, 0.3], inertia: inertia(0.2, 0.3, 0.25, 0.01, 0.02, -0.03) }}
        body hand {{ mass: 0.4, com: [0.1, 0.1, 0.2], inertia: inertia(0.1, 0.2, 0.15, 0.01, 0.0, -0.02) }}
        joint first: Revolute {{ parent: ground, child: base, axis: [1.0, 2.0, -0.5] }}
        {}
        joint last: Revolute {{ parent: arm.at([0.3, 0.2, 0.1]), child: hand, axis: [1, -1, 1] }}
        output reaction = {tip}.reaction.force;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;",
        joints
            .replace("PARENT", "parent: base.at([0.3, -0.2, 0.5]).rotated([1.0, 1.0, 0.0], 0.4)")
            .replace("CHILD", "child: arm.rotated(X, 0.3).at([-0.1, 0.4, 0.2])")
    ))
}

/// Positions, rates and accelerations of all coordinates in the order of declaration, which both models share.
fn taken(from: &Case, point: &Point, to: &Case) -> Point {
    let mut taken = to.rest();
    let coordinates = |case: &Case| -> Vec<(Symbol, Symbol, Symbol)> {
        let joints = (0..case.model.joints.len()).map(multibody_engine::model::types::JointId);
        let all = joints.flat_map(|joint| {
            let freedoms = case.model.joints[joint].kind.freedoms();
            (0..freedoms).map(move |component| {
                let (position, velocity) =
                    (Symbol::Position { joint, component }, Symbol::Velocity { joint, component });
                (position, velocity, Symbol::Acceleration { joint, component })
            })
        });
        all.collect()
    };
    let (ours, theirs) = (coordinates(from), coordinates(to));
    assert_eq!(ours.len(), theirs.len());
    for (one, other) in ours.into_iter().zip(theirs) {
        taken.set(other.0, point.get(one.0));
        taken.set(other.1, point.get(one.1));
        taken.set(other.2, point.get(one.2));
    }
    for &symbol in &to.derivation.symbols {
        if matches!(symbol, Symbol::Input { .. } | Symbol::Time) {
            taken.set(symbol, point.get(symbol));
        }
    }
    taken
}

fn same(what: &str, one: &Case, chain: &Case) {
    use FunctionKind::*;
    for seed in 1..4 {
        let point = one.random(seed);
        let other = taken(one, &point, chain);
        for kind in [ForwardDynamics, InverseDynamics, MassMatrix, Bias, KineticEnergy, PotentialEnergy] {
            close(&format!("{what} {kind:?}"), &one.eval(kind, &point), &chain.eval(kind, &other), 1e-10);
        }
        let (ours, theirs) = (one.output("reaction", &point), chain.output("reaction", &other));
        close(&format!("{what} reaction"), &ours, &theirs, 1e-10);
    }
}

const PAIRS: [(&str, &str, &str); 4] = [
    ("Z", "X", "Y"),
    ("-Y", "[3, 0, -4]", "[4, 0, 3]"),
    ("[1, 1, 1]", "[1, -1, 0]", "[1, 1, -2]"),
    ("[0.3, -0.4, 1.2]", "[0.8, 0.6, 0.0]", "[-0.72, 0.96, 0.5]"),
];

#[test]
fn a_pin_in_a_slot_is_a_slide_and_a_hinge() {
    let forces = "force pull: SpringDamper { joint: TRAVEL, stiffness: 3.0, damping: 0.2, rest: 0.1 }
        force rub: Damper { joint: ANGLE, damping: 0.4 }
        force motor: Effort { joint: ANGLE, value: push - 0.3 }";
    let on = |travel: &str, angle: &str| forces.replace("TRAVEL", travel).replace("ANGLE", angle);
    for (axis, slide, _) in PAIRS {
        let one = arm(
            &format!(
                "joint j: PinSlot {{ PARENT, CHILD, axis: {axis}, slide: {slide} }} {}",
                on("j.travel", "j.angle")
            ),
            "j",
        );
        let chain = arm(
            &format!(
                "body pin {{ mass: 0 }}
                joint slot: Prismatic {{ PARENT, child: pin, axis: {slide} }}
                joint hinge: Revolute {{ parent: pin, CHILD, axis: {axis} }} {}",
                on("slot", "hinge")
            ),
            "hinge",
        );
        same(axis, &one, &chain);
    }
}

#[test]
fn a_plane_of_two_axes_is_two_slides_and_a_hinge() {
    for (normal, first, second) in PAIRS {
        // The normal of the list is the cross product of the other two, or its opposite.
        let one = arm(&format!("joint j: Planar {{ PARENT, CHILD, axes: [{first}, {second}] }}"), "j");
        let chain = arm(
            &format!(
                "body pin {{ mass: 0 }} body pan {{ mass: 0 }}
                joint x: Prismatic {{ PARENT, child: pan, axis: {first} }}
                joint y: Prismatic {{ parent: pan, child: pin, axis: {second} }}
                joint hinge: Revolute {{ parent: pin, CHILD, axis: cross({first}, {second}) }}"
            ),
            "hinge",
        );
        same(normal, &one, &chain);
    }
}

/// A crank of radius r turns a lever, whose pivot lies d behind the crank's, by a pin in the lever's slot. With phi the
/// lever's angle and rho the pin's way from its pivot, one equation is left: (C + L phi'^2) a + L phi' phi'' v^2 is the power
/// of what acts over v.
#[test]
fn a_slotted_lever_moves_as_by_hand() {
    let (r, d, crank_inertia, lever_inertia) = (0.4_f64, 1.0_f64, 0.7, 0.3);
    let (push, torque) = (1.7, -0.6);
    let text = |rest: &str| {
        format!(
            "let plane = ground.at([0.2, 0.1, -0.3]).rotated([1, 2, 2], 0.7);
            body wheel {{ mass: 0.0, inertia: diag(1, 1, {crank_inertia}) }}
            body lever {{ mass: 0.0, inertia: diag(1, 1, {lever_inertia}) }}
            joint crank: Revolute {{ parent: plane, child: wheel, axis: Z }}
            joint swing: Revolute {{ parent: plane.at(-{d:?} * X), child: lever, axis: Z }}
            joint pin: PinSlot {{ parent: lever, child: wheel.at({r:?} * X), axis: Z, slide: X }}
            force drag: Effort {{ joint: pin, value: [{push:?}, {torque:?}] }}
            output told = crank.accel;
            {rest}
            emit forward_dynamics;"
        )
    };
    let held = case(&text("formulation { constraints: Multipliers }"));
    let solved = case(&text(
        "formulation { independent: [crank], constraints: Reduced } solve (swing) from pin { cos(swing) > 0 }",
    ));
    for (theta, v) in [(0.3_f64, 1.2), (1.9, -0.7), (-2.6, 2.0)] {
        let (s, c) = theta.sin_cos();
        let square = r * r + d * d + 2.0 * r * d * c;
        let (phi, rho) = ((r * s).atan2(d + r * c), square.sqrt());
        let slope = r * (r + d * c) / square;
        let bend = (-r * d * s * square + r * (r + d * c) * 2.0 * r * d * s) / (square * square);
        let acting = push * (-r * d * s / rho) + torque * (1.0 - slope);
        let expected =
            (acting - lever_inertia * slope * bend * v * v) / (crank_inertia + lever_inertia * slope * slope);
        for case in [&held, &solved] {
            let mut point = case.rest();
            for (joint, position, velocity) in [("crank", theta, v), ("swing", phi, slope * v)] {
                let joint = case.joint(joint);
                for symbol in [Symbol::Position { joint, component: 0 }, Symbol::Velocity { joint, component: 0 }] {
                    let value = if matches!(symbol, Symbol::Position { .. }) { position } else { velocity };
                    point.set(symbol, value);
                }
            }
            close("the crank's acceleration", &case.output("told", &point), &[expected], 1e-10);
        }
    }
}
