//! What loops hold at their declared parameters, and points that they hold together.

use multibody_engine::mechanics::loops::structure::Structure;
use multibody_engine::optimize::program::{Compiled, Expression};
use multibody_engine::{Trouble, compile};

use crate::corpus;

fn compiled(text: &str) -> (Structure, Compiled) {
    compile(&corpus::model(text)).unwrap_or_else(|trouble| match trouble {
        Trouble::Complaints(list) => panic!("{list:?}"),
        Trouble::Refused(refusal) => panic!("{refusal:?}: {text}"),
        Trouble::Fault(fault) => panic!("{fault:?}: {text}"),
    })
}

/// A four-bar in a plane through `foot`, turned by `turn`; its end is written in numbers.
fn four_bar(foot: &str, turn: &str, [first, second, third]: [&str; 3], end: &str, emit: &str) -> String {
    format!(
        "pub mod m {{
            param p0 = 1.3;
            param width = 0.4;
            body b0 {{ mass: 1, com: width * X, inertia: diag(0.1, 0.1, 0.1) }}
            body b1 {{ mass: 1, com: 0 * X, inertia: diag(0.1, 0.1, 0.1) }}
            body b2 {{ mass: 1, com: [0, width, (0.5 * width)], inertia: diag(0.1, 0.1, 0.1) }}
            joint j0: Revolute {{ parent: ground.at({foot}).rotated({turn}), child: b0, axis: Z }}
            joint j1: Revolute {{ parent: b0{first}, child: b1, axis: Z }}
            joint j2: Revolute {{ parent: b1{second}, child: b2, axis: Z }}
            #[cut]
            joint j3: Revolute {{ parent: b2{third}, child: ground{end}, axis: Z }}
            output place = b1.position;
            output reaction = j3.reaction.express(b2).force.x;
            solve (j1.angle, j2.angle) from j3 {{ sin(j2.angle) > 0 }}
            formulation {{ constraints: Reduced }}
            emit {emit};
        }}"
    )
}

/// A parameter that moves a foot out of the loop's plane opens the loop. Closed forms rest on all equations, so
/// programs are compared where these hold.
#[test]
fn parameters_that_open_a_loop_stay_where_they_are() {
    for text in [
        four_bar(
            "[(0.5 * p0), -0.7, sqrt(3)]",
            "[0, cos(deg(60)), sin(deg(60))], deg(60)",
            [".at([0.916, 0.0, 0.0])", ".at([1.255, 0.0, 0.0])", ".at([1.184, 0.0, 0.0])"],
            ".at([0.20478278538696837, 1.042442824315931, 1.5212334034587534])\
             .oriented([[-0.6921995565290788, 0.5773731669734464, 0.4330127018922193], \
             [-0.5419173079103561, -0.8120656570667132, 0.2165063509461097], \
             [0.4766397017959577, -0.0847914775897951, 0.8750000000000003]])",
            "forward_dynamics, energy",
        ),
        four_bar(
            "[0, (0.5 * 2.899 / 1.3 * p0), 0]",
            "X + Y, deg(45)",
            ["", ".at([1.297 / 0.4 * width, 0.0, 0.0])", ".at([1.046, 0.0, 0.0])"],
            ".at([0.8621250737081189, 3.177667375424158, 0.6123843843378172])\
             .oriented([[-0.4110044879440208, -0.7622829598580001, 0.4999999999999999], \
             [0.5816857708167193, -0.6415930673170955, -0.4999999999999999], \
             [0.7019380135875478, 0.0853406414363493, 0.7071067811865476]])",
            "forward_dynamics, inverse_dynamics, mass_matrix, energy",
        ),
    ] {
        let (structure, compiled) = compiled(&text);
        assert_eq!(structure.granted.len(), 1, "{:?}", structure.notes);
        // The width, a length in the plane too, opens nothing: it is moved, and what it multiplies is seen.
        assert_eq!(structure.pinned, [(0, 0)], "{text}");
        assert!(compiled.unchecked.is_empty(), "{:?}", compiled.unchecked);
    }
}

const FORMULATIONS: [&str; 4] = [
    "constraints: Multipliers",
    "constraints: Reduced",
    "coordinates: Absolute(Quaternion)",
    "coordinates: Absolute(RollPitchYaw)",
];

/// A wheel on a hinge and a disk on a ball, joined in one point of the hinge's axis.
fn pair(force: &str, formulation: &str) -> String {
    format!(
        "pub mod m {{
            param k = 7.0;
            body wheel {{ mass: 1, com: 0.1 * X, inertia: diag(0.1, 0.1, 0.1) }}
            body disk {{ mass: 1, com: 0.1 * Y, inertia: diag(0.1, 0.1, 0.1) }}
            joint hinge: Revolute {{ parent: ground.at(0.2 * Y), child: wheel.at(0.3 * Y).rotated(X, deg(20)), axis: [1, 2, 2] }}
            joint ball: Ball {{ parent: wheel.at(0.3 * Y), child: disk.at(0.5 * Z) }}
            force f: {force}
            output effort = f.power;
            formulation {{ {formulation} }}
            emit forward_dynamics, energy;
        }}"
    )
}

/// Nothing acts between points that are one wherever loops are closed, whatever the coordinates.
#[test]
fn nothing_acts_between_points_that_joints_hold_together() {
    for between in [
        "[ground.at(0.2 * Y), wheel.at(0.3 * Y)]",
        // On the hinge's axis, and from body to body.
        "[wheel.at(0.3 * Y).rotated(X, deg(20)).at([0.1, 0.2, 0.2]), ground.at(0.2 * Y).at([0.1, 0.2, 0.2])]",
        "[ground.at(0.2 * Y), disk.at(0.5 * Z)]",
    ] {
        for force in
            ["Spring { between: BETWEEN, stiffness: k, length: 0.4 }", "Damper { between: BETWEEN, damping: k }"]
        {
            let force = force.replace("BETWEEN", between);
            for formulation in FORMULATIONS {
                let (structure, compiled) = compiled(&pair(&force, formulation));
                // In coordinates of joints the way is zero as it is written.
                let absolute = usize::from(formulation.contains("Absolute"));
                assert_eq!(structure.meeting.len(), absolute, "{force} {formulation}");
                let outputs = compiled.functions.iter().find(|f| format!("{:?}", f.kind) == "Outputs").unwrap();
                assert!(
                    matches!(outputs.program.results[..], [Expression::Literal(x)] if x == 0.0),
                    "{force} {formulation}"
                );
            }
        }
    }
}

/// Off the axis, and off the centre, it acts.
#[test]
fn a_spring_beside_the_axis_acts() {
    for between in ["[ground.at(0.2 * Y), wheel.at(0.31 * Y)]", "[ground.at(0.2 * Y), disk.at(0.51 * Z)]"] {
        let force = format!("Spring {{ between: {between}, stiffness: k, length: 0.4 }}");
        for formulation in FORMULATIONS {
            assert!(compiled(&pair(&force, formulation)).0.meeting.is_empty(), "{force}");
        }
    }
}

/// Where points meet for another reason, the line has no direction, and rounding would give it one.
#[test]
fn points_that_an_equation_holds_together() {
    for constraints in ["Multipliers", "Reduced"] {
        let text = |length: &str| {
            format!(
                "pub mod m {{
                    body a {{ mass: 1 }}
                    body b {{ mass: 2 }}
                    joint u: Prismatic {{ parent: ground, child: a, axis: X }}
                    joint v: Prismatic {{ parent: ground, child: b, axis: X }}
                    constraint same = u.travel - v.travel;
                    force f: Spring {{ between: [a, b], stiffness: 10.0, length: {length} }}
                    formulation {{ constraints: {constraints} }}
                    emit forward_dynamics;
                }}"
            )
        };
        let Err(Trouble::Complaints(list)) = compile(&corpus::model(&text("0.1"))) else {
            panic!("taken: {constraints}")
        };
        let said: Vec<&str> = list.iter().map(|complaint| complaint.message.as_str()).collect();
        assert_eq!(said, ["the two points meet wherever the loops are closed: a line between them has no direction"]);
        // Without a length there is no quotient.
        compiled(&text("0"));
    }
}

/// A spring on a joint that closes a loop follows a coordinate that is measured between its frames. The balance of energies holds
/// for motions that keep the loop closed, and says nothing of others.
#[test]
fn springs_on_joints_that_close_loops() {
    let slider = "pub mod m {
        body b0 { mass: 1, com: 0 * X, inertia: diag(0.1, 0.1, 0.1) }
        body b1 { mass: 1, com: 0 * X, inertia: diag(0.1, 0.1, 0.1) }
        body b2 { mass: 1, com: 0 * X, inertia: diag(0.1, 0.1, 0.1) }
        joint j0: Revolute {
            parent: ground.at(X).rotated([0, 3, 4], deg(-90)), child: b0.rotated(X + Y, deg(-90)), axis: Z
        }
        joint j1: Revolute { parent: b0.rotated(X + Y, deg(-90)).at([0.993, 0.0, 0.0]), child: b1, axis: Z }
        joint j2: Prismatic { parent: b1, child: b2, axis: X }
        #[cut]
        joint j3: Ball {
            parent: b2.at([1.162, 0.0, 0.0]),
            child: ground.at([1.7418010382130085, -2.3182252418742335, 2.434107404730371])
        }
        force f0: SpringDamper { joint: j1, stiffness: 2.22, damping: 1.878713 }
        formulation { coordinates: Absolute(RollPitchYaw) }
        emit forward_dynamics, energy;
    }";
    let screw = "pub mod m {
        body b0 { mass: 1, com: 0 * X, inertia: diag(0.1, 0.1, 0.1) }
        body b1 { mass: 1, com: 0 * X, inertia: diag(0.1, 0.1, 0.1) }
        joint j0: Revolute { parent: ground, child: b0, axis: Z }
        joint j1: Screw { parent: b0, child: b1, axis: Z, pitch: -0.251 }
        force f0: SpringDamper { joint: j1, stiffness: 17.119, damping: 0.316, rest: -0.346 }
        formulation { coordinates: Absolute(Quaternion) }
        emit forward_dynamics, energy;
    }";
    for text in [slider, screw] {
        let (_, compiled) = compiled(text);
        assert!(compiled.unchecked.is_empty(), "{:?}", compiled.unchecked);
    }
}

/// The rate of a rotor on a joint that closes a loop is measured, too: open loops have no coordinate of which it is the rate.
#[test]
fn rotors_on_joints_that_close_loops() {
    for (kind, coordinates) in [("Revolute", "Quaternion"), ("Prismatic", "RollPitchYaw")] {
        let text = format!(
            "pub mod m {{
                body b0 {{ mass: 1, com: 0 * X, inertia: diag(0.1, 0.1, 0.1) }}
                joint j0: {kind} {{ parent: ground, child: b0, axis: Z, armature: 0.10 }}
                formulation {{ coordinates: Absolute({coordinates}) }}
                emit forward_dynamics;
            }}"
        );
        let (_, compiled) = compiled(&text);
        assert!(compiled.unchecked.is_empty(), "{:?}", compiled.unchecked);
    }
}

/// A body whose axis a closing joint holds, and whose place along that axis, through a point that stands still: closed,
/// the axis fixes the place, so one equation follows from two others there and nowhere else.
#[test]
fn an_equation_may_follow_where_the_others_hold_only() {
    let loop_of = |center: &str, constraints: &str| {
        format!(
            "pub mod m {{
                param beside = 0.0;
                body b0 {{ mass: 1, com: 0 * X, inertia: diag(0.1, 0.1, 0.1) }}
                body b1 {{ mass: 1, com: 0 * X, inertia: diag(0.1, 0.1, 0.1) }}
                body b2 {{ mass: 1, com: 0 * X, inertia: diag(0.1, 0.1, 0.1) }}
                joint j0: Revolute {{
                    parent: ground.rotated([1, 0.5, 0.2], deg(90)).at([0.8, 0, 0.7]), child: b0, axis: Z
                }}
                joint j1: Revolute {{ parent: b0, child: b1{center}, axis: Z }}
                joint j2: Universal {{ parent: b1, child: b2.at([0.7, 0.46, 1]), axes: [[1, 2, 2], [2, 1, -2]] }}
                #[cut]
                joint j3: Planar {{
                    parent: ground.rotated([1, 0.5, 0.2], deg(90)).at([1.4, 0, 0.7]),
                    child: b2.at([1.3, 0.96, 1]), axis: X
                }}
                formulation {{ constraints: {constraints} }}
                emit energy;
            }}"
        )
    };
    let (structure, _) = compiled(&loop_of("", "Reduced"));
    assert_eq!(structure.dropped.len(), 1);
    // A parameter may move the point beside it: then what was left out is looked at in every run.
    let (structure, _) = compiled(&loop_of(".at([beside, 0, 0])", "Reduced"));
    assert_eq!((structure.dropped.len(), structure.granted.len()), (1, 1));
    // With the point beside the hinges' axis the place along the axis counts.
    let (structure, _) = compiled(&loop_of(".at([0.3, 0.2, 0])", "Multipliers"));
    assert_eq!(structure.dropped.len(), 0);
}

/// A four-bar in a plane that is turned twice; what closes it is written once more by hand.
fn turned(turns: &str, middle: &str, end: &str) -> String {
    format!(
        "pub mod m {{
            param tilt = 0.0;
            body b0 {{ mass: 1, com: 0.2 * X, inertia: diag(0.1, 0.1, 0.1) }}
            body b1 {{ mass: 1, com: 0.3 * Y, inertia: diag(0.1, 0.1, 0.1) }}
            body b2 {{ mass: 1, com: 0 * X, inertia: diag(0.1, 0.1, 0.1) }}
            joint j0: Revolute {{
                parent: ground.at([0, sqrt(3), 2 / 3]){turns},
                child: b0.rotated(X + Y, 2.647),
                axis: Z,
            }}
            joint j1: Revolute {{ parent: b0.rotated(X + Y, 2.647), child: b1, axis: Z }}
            joint j2: Revolute {{ parent: b1.at([1.347, 0.0, 0.0]){middle}, child: b2, axis: Z }}
            #[cut]
            joint j3: Revolute {{ parent: b2.at([0.91, 0.0, 0.0]), child: ground{end}, axis: Z }}
            solve (j1.angle, j2.angle) from j3 {{ sin(j2) > 0.0 }}
            formulation {{ constraints: Reduced }}
            emit forward_dynamics, mass_matrix, energy;
        }}"
    )
}

/// Coefficients that are zero in value only, where a literal is not exact or a parameter is zero as declared: an equation
/// that would be the simplest says nothing, and another one is taken.
#[test]
fn equations_that_say_nothing_as_declared_are_left_aside() {
    let inexact = ".rotated([sqrt(3), 1, 0], acos(1 / 3)).rotated(Y, acos(1 / 3))";
    let tilted = ".rotated([sqrt(3), 1, 0], tilt).rotated(Y, 0.3)";
    let again = |turns: &str, place: &str| format!(".at([0, sqrt(3), 2 / 3]){turns}.at({place})");
    for (turns, middle, end) in [
        (
            inexact,
            "",
            ".at([-0.24787193577853456, 3.7591192610267794, -0.034421039952685084]).oriented([\
             [0.1391745877070883, 0.3028886680740520, 0.9428090415820634], \
             [0.9086660042221553, -0.4175237631212643, 0.0000000000000001], \
             [0.3936451789460963, 0.8566985245588934, -0.3333333333333335]])"
                .to_owned(),
        ),
        (inexact, "", again(inexact, "[1.5, 1.2, 0]")),
        (tilted, "", again(tilted, "[1.5, 1.2, 0]")),
        (tilted, "", again(tilted, "[1.5, 1.2, sin(tilt)]")),
        (tilted, ".rotated(X, tilt)", again(tilted, "[1.5, 1.2, 0]")),
        (".rotated(X, tilt)", "", again(".rotated(X, tilt)", "[1.5, 1.2, 0]")),
    ] {
        let (_, compiled) = compiled(&turned(turns, middle, &end));
        assert!(compiled.unchecked.is_empty(), "{:?}", compiled.unchecked);
    }
}
