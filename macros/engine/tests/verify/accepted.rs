//! Models that are right and were refused.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::optimize::program::Compiled;
use multibody_engine::{Trouble, compile};

use crate::corpus;

fn compiled(text: &str) -> Compiled {
    let found = compile(&corpus::model(text)).unwrap_or_else(|trouble| match trouble {
        Trouble::Complaints(list) => panic!("{list:?}"),
        Trouble::Refused(refusal) => panic!("{refusal:?}: {text}"),
        Trouble::Fault(fault) => panic!("{fault:?}: {text}"),
    });
    found.1
}

/// A thin rod has no inertia about itself: the pivot of that turn is rounding, and nothing behind it says anything.
#[test]
fn a_thin_rod_in_absolute_coordinates() {
    for coordinates in ["Absolute(RollPitchYaw)", "Absolute(Quaternion)", "Joint"] {
        compiled(&format!(
            "pub mod m {{
                param length = 1.0;
                world {{ gravity: -9.81 * Y }}
                body rod {{ mass: 2.0, com: -0.5 * length * Y, inertia: rod(2.0, length, Y) }}
                joint hinge: Revolute {{ parent: ground, child: rod, axis: Z }}
                formulation {{ coordinates: {coordinates}, constraints: Multipliers }}
                emit forward_dynamics, mass_matrix;
            }}"
        ));
    }
}

/// Kinematics solves loops whatever becomes of them in the dynamics, with the placeholders that this takes.
#[test]
fn kinematics_beside_multipliers() {
    let leg = |constraints: &str| {
        format!(
            "pub mod m {{
                body plate {{ mass: 1.5, inertia: diag(0.08, 0.08, 0.08), coordinates: Absolute(RollPitchYaw) }}
                body cylinder {{ mass: 0.1, com: 0.5 * Z, inertia: diag(0.006, 0.006, 0.001) }}
                body piston {{ mass: 0.1, com: -0.5 * Z, inertia: diag(0.006, 0.006, 0.001) }}
                joint gimbal: Universal {{ parent: ground.at([-2.12, 1.374, 0.0]), child: cylinder, axes: [X, Y] }}
                joint stroke: Prismatic {{ parent: cylinder.at(Z), child: piston, axis: Z }}
                #[cut]
                joint ball: Ball {{ parent: piston, child: plate.at([0.17, 0.595, -0.4]) }}
                solve (gimbal, stroke) from ball {{ stroke > -1.0, cos(gimbal.second) > 0.0 }}
                formulation {{ constraints: {constraints} }}
                emit forward_dynamics, kinematics {{ given: plate.pose, find: stroke }};
            }}"
        )
    };
    for constraints in ["Reduced", "Multipliers"] {
        let compiled = compiled(&leg(constraints));
        assert!(compiled.functions.iter().any(|function| function.kind == FunctionKind::Kinematics(0)));
    }
}

/// Thin rods in a loop of absolute bodies: along their own axes nothing tells the multipliers.
#[test]
fn thin_rods_in_a_loop() {
    for coordinates in ["Absolute(RollPitchYaw)", "Absolute(Quaternion)"] {
        compiled(&format!(
            "pub mod m {{
                param length = 1.0;
                body crank {{ mass: 1.0, com: 0.1 * X, inertia: rod(1.0, 0.2, X) }}
                body rod {{ mass: 1.0, com: 0.5 * length * X, inertia: rod(1.0, length, X) }}
                body piston {{ mass: 1.0 }}
                joint shaft: Revolute {{ parent: ground, child: crank, axis: Z }}
                joint pin: Revolute {{ parent: crank.at(0.2 * X), child: rod, axis: Z }}
                joint guide: Prismatic {{ parent: ground, child: piston, axis: X }}
                joint wrist: Revolute {{ parent: rod.at(length * X), child: piston, axis: Z }}
                formulation {{ coordinates: {coordinates}, constraints: Multipliers }}
                emit forward_dynamics;
            }}"
        ));
    }
}

/// The gap of the loop is measured in the axes of the table, which turns: its equations push the table only where the loop is
/// open, but how they push changes as it opens. With parameters other than the declared ones it is open.
#[test]
fn a_loop_on_a_turning_table() {
    let requests =
        ["forward_dynamics, derivatives, linearize", "residual, inverse_dynamics", "residual, forward_dynamics"];
    for table in ["Revolute { parent: ground, child: table, axis: Z }", "Ball { parent: ground, child: table }"] {
        for request in requests {
            compiled(&format!(
                "mod m {{
                    param length = 0.56;
                    body table {{ mass: 2.8, inertia: sphere(2.8, 0.3) }}
                    body crank {{ mass: 0.2, inertia: diag(1e-3, 1e-3, 1e-3) }}
                    body link {{ mass: 0.1, com: 0.15 * X, inertia: rod(0.1, 0.56, X) }}
                    body slider {{ mass: 2.5 }}
                    joint turn: {table}
                    joint first: Revolute {{ parent: table, child: crank, axis: Z }}
                    joint second: Revolute {{ parent: crank.at(0.1 * X), child: link, axis: Z }}
                    joint push: Prismatic {{ parent: table, child: slider, axis: X }}
                    joint pin: Revolute {{ parent: link.at(length * X), child: slider, axis: Z }}
                    emit {request};
                }}"
            ));
        }
    }
}

/// A thread between two bodies that count no turns pushes and turns them as far as it lags and leans.
#[test]
fn a_thread_that_counts_no_turns() {
    for request in ["forward_dynamics, derivatives", "residual, inverse_dynamics"] {
        compiled(&format!(
            "mod m {{
                param lean = 0.7;
                body nut {{ mass: 0.7, inertia: diag(0.1, 0.2, 0.25) }}
                body bolt {{ mass: 0.7, inertia: diag(0.1, 0.2, 0.25) }}
                joint thread: Screw {{ parent: nut.rotated(X + 2 * Y, lean), child: bolt, axis: Z, pitch: 0.1 }}
                formulation {{ coordinates: Absolute(Quaternion) }}
                emit {request};
            }}"
        ));
    }
}

/// Where the loop is closed the roll of the child does not turn the joint: the damping of that turn is the square of a cosine that
/// is zero there, and rounding of the form in which it is computed.
#[test]
fn entries_that_are_zero_where_the_loop_is_closed() {
    let compiled = compiled(
        "mod m {
            param p = 0.58;
            body a { mass: 0.5, com: X, inertia: diag(0.1, 0.2, 0.25) }
            body b { mass: 0.5 * p + 0.25, com: p * Z, inertia: cylinder(0.5 * p + 0.25, p, 0.5 * p + 0.25, X + 2 * Y) }
            joint hinge: Revolute { parent: a.rotated(X + 2 * Y, p), child: b.rotated(Z, dot(Z, X)).at([p, 0, 5]), axis: Z }
            formulation { coordinates: Absolute(RollPitchYaw) }
            force loss: Damper { joint: hinge.angle, damping: 1.39 }
            emit inverse_dynamics, derivatives;
        }",
    );
    assert_eq!(compiled.unchecked, []);
}

/// A frame that a parameter turns, by nothing as a rule: entries of the linearisation are zero since their terms are equal and opposite,
/// which they are to rounding in the program.
#[test]
fn entries_whose_terms_are_equal_and_opposite() {
    compiled(
        "pub mod m {
            param r = 0.3;
            param tilt = 0.0;
            param other = 0.0;
            body base { mass: 0 }
            body above { mass: 0 }
            body wheel { mass: 0, inertia: diag(0.05, 0, 0.05) }
            body frame { mass: 0, inertia: diag(0, 1, 1) }
            body fly { mass: 1, inertia: diag(0.06, 0.06, 0) }
            joint place: Planar { parent: ground.rotated(X, tilt), child: base, axes: [X, Z] }
            joint up: Prismatic { parent: base, child: above, axis: Y }
            joint lean: Revolute { parent: above, child: frame, axis: X }
            joint spin: Revolute { parent: frame, child: wheel, axis: Y }
            joint turn: Revolute { parent: frame, child: fly, axis: Y }
            constraint roll: Rolling { wheel: wheel, axis: Y, radius: r, on: ground.rotated(X, -0.5 * PI) }
            output force = roll.force;
            output slip = roll.slip;
            emit forward_dynamics, linearize, constraints;
        }",
    );
}

/// Several bodies as one go through all stages: in outputs, their linearisation, forces, states, and under a constraint.
#[test]
fn several_bodies_as_one() {
    for constraints in ["Reduced", "Multipliers"] {
        compiled(&format!(
            "pub mod m {{
                param mass = 1.2;
                param target = 0.4;
                input push;
                world {{ gravity: [0.3, -9.0, 1.0] }}
                body a {{ mass: mass, com: [0.5, 0.1, 0.2], inertia: inertia(0.5, 0.6, 0.7, 0.02, -0.03, 0.01) }}
                body b {{ mass: 0.7, com: [1.1, -0.2, 0.1], inertia: inertia(0.3, 0.2, 0.4, 0.01, 0.02, -0.01) }}
                joint one: Universal {{ parent: ground.at([0.1, 0.2, 0]), child: a, axes: [[1, 0.3, -0.2], [0.3, -1, 0]] }}
                joint two: Revolute {{ parent: a.at([1, 0.2, 0]).rotated([1, 1, 0], 0.4), child: b.at([0.1, 0, 0.2]), axis: Z }}
                constraint balanced = dot(centre_of_mass(), [1, 2, 0.5]) - target;
                state gone: rate = linear_momentum([b]).x, start: 0.0;
                force brake: Force {{ at: b, value: push * X - 0.3 * angular_momentum(), axes: ground }}
                output mass = total_mass();
                output centre = centre_of_mass([a, b]);
                output moving = [centre_of_mass().velocity, centre_of_mass().acceleration];
                output heavier = diff(total_mass(), mass);
                output momenta = [linear_momentum(), angular_momentum()];
                formulation {{ constraints: {constraints} }}
                emit forward_dynamics, linearize, report;
            }}"
        ));
    }
}
