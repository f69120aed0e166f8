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
