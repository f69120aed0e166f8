//! Loops in models without mistakes: which joints close, what coordinates there are, and what items mean then.

use crate::support::{Writer, model};
use multibody_engine::model::joint_kinds;
use multibody_engine::model::types::*;

const STEWART: &str = include_str!("../syntax/samples/stewart.txt");

/// The sample with six feet, and something more in its formulation.
fn stewart(formulation: &str) -> Model {
    let text = ["[-2.12, 1.374, 0.0], ", "[0.17, 0.595, -0.4], ", "-0.75, "]
        .iter()
        .fold(STEWART.to_string(), |text, element| text.replace(&format!("{element}/* .. */"), &element.repeat(6)));
    model(&text.replace("constraints: Reduced", &format!("constraints: Reduced{formulation}")))
}

fn names(w: &Writer<'_>, joints: &[JointId]) -> Vec<String> {
    joints.iter().map(|id| w.joint(*id)).collect()
}

/// Coordinates of the tree, and equations of the joints that close loops.
fn counts(m: &Model) -> (usize, usize) {
    let freedoms = |id: &JointId| m.joints[*id].kind.freedoms();
    (m.tree.iter().map(freedoms).sum(), m.cuts.iter().map(|id| 6 - freedoms(id)).sum())
}

fn unknowns(w: &Writer<'_>, solve: &Solve) -> Vec<(String, usize)> {
    solve.unknowns.iter().map(|unknown| (w.joint(unknown.joint), unknown.index)).collect()
}

#[test]
fn stewart_in_hybrid_coordinates() {
    let m = stewart("");
    let w = Writer(&m);
    assert_eq!(counts(&m), (24, 18));
    assert_eq!(m.tree.len(), 13);
    assert_eq!(names(&w, &m.cuts)[..2], ["legs[0].ball", "legs[1].ball"]);
    assert_eq!(w.joint(m.tree[0]), "platform");
    assert_eq!(m.joints[m.tree[0]].kind, &joint_kinds::FREE_BY_ANGLES);
    assert!(matches!(m.handling, Handling::Reduced));
    assert!(m.remarks.is_empty());
    assert_eq!(m.solves.len(), 6);
    let solve = &m.solves[2];
    let of = |name: &str, index| (format!("legs[2].{name}"), index);
    assert_eq!(unknowns(&w, solve), [of("gimbal", 0), of("gimbal", 1), of("stroke", 0)]);
    let SolveHow::From { closings, branches } = &solve.how else { panic!("from a joint") };
    let [Closing { what: LoopClosure::Cut(ball), .. }] = &closings[..] else { panic!("from a joint") };
    assert_eq!(w.joint(*ball), "legs[2].ball");
    assert_eq!(w.list(branches), "[(q(legs[2].stroke, 0) Greater -1), (Cos[q(legs[2].gimbal, 1)] Greater 0)]");
    assert_eq!(m.solve_for.len(), 6);
    assert!(m.solve_for.iter().enumerate().all(|(k, of)| (of.input, of.element) == (InputId(k), 0)));
}

/// One line changes the coordinates of the whole model.
#[test]
fn stewart_in_absolute_and_joint_coordinates() {
    for sequence in ["RollPitchYaw", "Quaternion"] {
        let m = stewart(&format!(", coordinates: Absolute({sequence})"));
        assert_eq!(counts(&m), (78, 72));
        assert_eq!((m.tree.len(), m.cuts.len()), (13, 18));
        assert_eq!((m.solves.len(), m.remarks.len()), (0, 6));
        let why = "`solve` of `legs[0].gimbal.first`, `legs[0].gimbal.second`, `legs[0].stroke`: with these \
                   coordinates the joint `legs[0].gimbal` closes a loop and has none";
        assert_eq!(m.remarks[0], why);
    }
    let m = stewart(", coordinates: Joint");
    let w = Writer(&m);
    assert_eq!(counts(&m), (21, 15));
    assert_eq!(names(&w, &m.cuts)[0], "legs[1].ball");
    assert_eq!(m.solves.len(), 5);
    assert_eq!(
        m.remarks,
        [
            "`#[cut]` of `legs[0].ball`: with these coordinates the joint lies in the tree",
            "`solve` of `legs[0].gimbal.first`, `legs[0].gimbal.second`, `legs[0].stroke`: with these coordinates the \
             joint `legs[0].ball` lies in the tree",
        ]
    );
}

#[test]
fn double_pendulum_in_absolute_coordinates() {
    let text = include_str!("../syntax/samples/double_pendulum.txt");
    let text = text.replace("world {", "formulation { coordinates: Absolute(RollPitchYaw) } world {");
    let m = model(&text);
    assert_eq!(counts(&m), (12, 10));
    let w = Writer(&m);
    assert_eq!(names(&w, &m.tree), ["upper", "lower"]);
    // The rate that friction needs is measured, and its effort acts on the joint that closes.
    let ForceKind::Effort { joint, values } = &m.forces[ForceId(0)].kind else { panic!("an effort") };
    assert_eq!(w.joint(*joint), "elbow");
    assert_eq!(w.list(values), "[(-0.01 * v(elbow, 0))]");
}

#[test]
fn measured_motions() {
    let m = model(
        "mod m {
            formulation { coordinates: Absolute(Quaternion) }
            param n = [1.0, 1.0, 0.0];
            body b { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
            joint j: Cylindrical { parent: ground.at(X), child: b.at(Y), axis: Z }
            joint k: Prismatic { parent: ground, child: b, axis: n }
            joint l: Universal { parent: ground, child: b, axes: [X, Y] }
            output travel = j.travel; output speed = k.rate; output angle = j.angle;
        }",
    );
    let w = Writer(&m);
    assert_eq!([w.output("travel"), w.output("speed"), w.output("angle")], ["q(j, 0)", "v(k, 0)", "q(j, 1)"]);
}

/// The tree and the cuts of joints between `ground`, `a`, `b`, `c`: each as its kind, parent and child.
fn tree(joints: &[&str]) -> (Vec<String>, Vec<String>) {
    let mut text = String::from("mod m {");
    for body in ["a", "b", "c"] {
        if joints.iter().any(|joint| joint.split(' ').any(|word| word == body)) {
            text += &format!("body {body} {{ mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }}");
        }
    }
    for (k, joint) in joints.iter().enumerate() {
        let (cut, joint) = joint.strip_prefix("cut ").map_or(("", *joint), |joint| ("#[cut]", joint));
        let [kind, parent, child] = joint.split(' ').collect::<Vec<_>>()[..] else { panic!("{joint}") };
        let axis = match kind {
            "Fixed" | "Ball" | "Free" => "",
            "Universal" => ", axes: [X, Y]",
            _ => ", axis: Z",
        };
        text += &format!("{cut} joint j{k}: {kind} {{ parent: {parent}, child: {child}{axis} }}");
    }
    let m = model(&(text + "}"));
    let w = Writer(&m);
    (names(&w, &m.tree), names(&w, &m.cuts))
}

#[test]
fn the_joint_with_most_freedoms_closes() {
    let case = |joints: &[&str], cuts: &[&str]| assert_eq!(tree(joints).1, cuts, "{joints:?}");
    // Of equals the last.
    case(&["Revolute ground a", "Revolute a b", "Revolute ground c", "Revolute b c"], &["j3"]);
    case(&["Revolute ground a", "Revolute a b", "Revolute b c", "Revolute ground c"], &["j3"]);
    // The ball gives three equations only, wherever it stands.
    case(&["Revolute ground a", "Revolute a b", "Ball ground c", "Revolute b c"], &["j2"]);
    case(&["Ball ground c", "Revolute ground a", "Revolute a b", "Revolute b c"], &["j0"]);
    case(&["Universal ground a", "Ball a b", "Prismatic ground b"], &["j1"]);
    // Unless that leaves a body in the air, or against the direction of a joint.
    case(&["Ball ground a", "Revolute a b", "Revolute ground b"], &["j2"]);
    case(&["Ball ground a", "Revolute ground b", "Revolute a b"], &["j2"]);
    case(&["Revolute ground a", "Revolute a b", "Ball b ground"], &["j2"]);
    // Two joints between the same bodies; three.
    case(&["Ball ground a", "Revolute ground a"], &["j0"]);
    case(&["Revolute ground a", "Cylindrical a b", "Prismatic a b", "Revolute a b"], &["j1", "j3"]);
    // Free joints are there for their coordinates.
    case(&["Ball ground a", "Free ground a"], &["j0"]);
    // What the user says.
    case(&["cut Revolute ground a", "Revolute b a", "Ball ground b"], &["j0"]);
    case(&["Revolute ground a", "cut Revolute a b", "Ball ground b"], &["j1"]);
    case(&["Revolute ground a", "Revolute a b", "cut Fixed b ground"], &["j2"]);
    // Circles of joints that all lead forwards.
    case(&["Revolute a b", "Revolute b c", "Revolute c a", "Ball ground a"], &["j2"]);
    case(&["Revolute a b", "Revolute b a", "Ball ground a", "Universal ground b"], &["j0", "j2"]);
}

#[test]
fn parents_come_first() {
    let (tree, cuts) = tree(&["Revolute b c", "Revolute a b", "Revolute ground a", "Ball c ground"]);
    assert_eq!((tree, cuts), (vec!["j2".into(), "j1".into(), "j0".into()], vec!["j3".to_string()]));
}

#[test]
fn joints_at_an_absolute_body() {
    let m = model(
        "mod m {
            body hand { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
            body plate { mass: 1.0, inertia: diag(1.0, 1.0, 1.0), coordinates: Absolute(Quaternion) }
            body finger { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
            joint on: Revolute { parent: plate, child: finger, axis: Z }
            joint arm: Ball { parent: ground, child: hand }
            joint grip: Fixed { parent: plate, child: hand }
            joint base: Revolute { parent: ground, child: plate, axis: Z }
            /// [m]
            output x = plate.x + plate.x.rate;
            output spin = plate.angular_velocity;
        }",
    );
    let w = Writer(&m);
    assert_eq!(names(&w, &m.tree), ["plate", "on", "arm"]);
    assert_eq!(names(&w, &m.cuts), ["grip", "base"]);
    assert_eq!(w.frame(&m.joints[JointId(0)].child), "plate");
    assert_eq!(w.frame(&m.joints[JointId(0)].parent), "ground");
    assert_eq!(w.output("x"), "(q(plate, 0) + v(plate, 0))");
}

#[test]
fn drives_and_constraints() {
    let m = model(
        "mod m {
            param k = 2.0;
            body a { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
            body b { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
            body c { mass: 1.0, inertia: diag(1.0, 1.0, 1.0), coordinates: Absolute(RollPitchYaw) }
            body d { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
            body e { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
            joint turn: Revolute { parent: ground, child: a, axis: Z }
            joint slide: Prismatic { parent: ground, child: b, axis: X }
            joint ball: Ball { parent: ground, child: d }
            joint float: Free { parent: ground, child: e }
            /// Rack and pinion.
            constraint rack = turn * 0.05 - slide.travel + sin(t);
            constraint link: Rod { between: [a.at(X), b], length: k }
            drive turn = k * t;
            drive c.orientation = identity();
            drive c.z = sin(t);
            drive ball.orientation = rotation(Z, t) * roll_pitch_yaw(0, 0, t);
            drive e.pose = pose([t, 0, 0], identity());
            solve (slide) from rack { slide > 0.0 }
            assume c.position.z > 0.0;
            formulation { constraints: Stabilised, rate: k, position: 100.0, independent: [turn, c.x] }
            output r = rotation(Z, t) * c.rotation;
            output p = pose(X, identity()).position;
            emit kinematics { given: [c.pose, turn], find: [slide, float.x] }, residual, constraints;
        }",
    );
    let w = Writer(&m);
    let ConstraintKind::Value(rack) = &m.constraints[ConstraintId(0)].kind else { panic!("a value") };
    assert_eq!(w.expr(rack), "(((q(turn, 0) * 0.05) - q(slide, 0)) + Sin[t])");
    assert_eq!(m.constraints[ConstraintId(0)].docs.text, [" Rack and pinion."]);
    let ConstraintKind::Rod { between, length } = &m.constraints[ConstraintId(1)].kind else { panic!("a rod") };
    assert_eq!((w.frame(&between[0]), w.expr(length)), ("a.at(<[1, 0, 0]>)".into(), "k".into()));
    let joint = |name: &str| {
        let index = m.joints.iter().position(|joint| joint.place.field == name);
        JointId(index.unwrap_or_else(|| panic!("{name}")))
    };
    let targets: Vec<DriveTarget> = m.drives.iter().map(|drive| drive.target).collect();
    let coordinate = |name, index| Coordinate { joint: joint(name), index };
    assert_eq!(
        targets,
        [
            DriveTarget::Coordinate(coordinate("turn", 0)),
            DriveTarget::Orientation(joint("c")),
            DriveTarget::Coordinate(coordinate("c", 2)),
            DriveTarget::Orientation(joint("ball")),
            DriveTarget::Pose(joint("float")),
        ]
    );
    assert_eq!(w.expr(&m.drives[3].value), "(Rotation[<[0, 0, 1]>, t] o RollPitchYaw[0, 0, t])");
    assert_eq!(w.expr(&m.drives[4].value), "Pose[<[t, 0, 0]>, Identity]");
    assert_eq!(m.solves[0].closings().collect::<Vec<_>>(), [LoopClosure::Constraint(ConstraintId(0))]);
    assert_eq!(w.list(&m.assumptions), "[(Position(c).z Greater 0)]");
    assert_eq!(m.independent, [coordinate("turn", 0), coordinate("c", 0)]);
    let Handling::Stabilised { rate, position } = &m.handling else { panic!("stabilised") };
    assert_eq!((w.expr(rate), w.expr(position)), ("k".into(), "100".into()));
    assert_eq!(m.emit, [Request::Kinematics, Request::Residual, Request::Constraints]);
    assert_eq!(m.kinematics[0].given, [joint("c"), joint("turn")]);
    assert_eq!(m.kinematics[0].find, [coordinate("slide", 0), coordinate("float", 0)]);
    assert_eq!(w.output("r"), "(Rotation[<[0, 0, 1]>, t] o Rotation(c))");
    assert_eq!(w.output("p"), "<[1, 0, 0]>");
}

#[test]
fn inputs_to_solve_for() {
    let m = model(
        "mod leg {
            port a: Frame;
            input u; input w: [Vec3; 2];
            body link { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
            joint swing: Revolute { parent: a, child: link, axis: Z }
        }
        mod m {
            input first: Vec3;
            part legs: [leg; 2] = |i| leg { a: ground };
            emit inverse_dynamics { solve_for: [legs.u, first.y, legs[1].w[1]] };
        }",
    );
    let w = Writer(&m);
    let found: Vec<(String, usize)> =
        m.solve_for.iter().map(|of| (w.place(&m.inputs[of.input].place), of.element)).collect();
    let of = |name: &str, element| (name.to_string(), element);
    assert_eq!(
        found,
        [
            of("legs[0].u", 0),
            of("legs[1].u", 0),
            of("first", 1),
            of("legs[1].w", 3),
            of("legs[1].w", 4),
            of("legs[1].w", 5),
        ]
    );
}
