//! The samples of the design, and every item of the language in models without mistakes.

use crate::support::{Writer, model};
use multibody_engine::model::types::*;

const DOUBLE_PENDULUM: &str = include_str!("../syntax/samples/double_pendulum.txt");

#[test]
fn double_pendulum() {
    let m = model(DOUBLE_PENDULUM);
    let w = Writer(&m);
    assert_eq!(m.tree, [JointId(0), JointId(1)]);
    assert_eq!(m.instances.len(), 1);
    let params: Vec<_> = m.params.iter().map(|p| (w.place(&p.place), &p.default[..])).collect();
    assert_eq!(params.len(), 4);
    assert!(params.iter().all(|(_, default)| *default == [1.0]));
    assert_eq!(m.params[ParamId(0)].docs.unit.as_deref(), Some("kg"));
    assert_eq!(m.gravity.as_ref().map(|g| w.expr(g)), Some("(-9.81 * <[0, 1, 0]>)".into()));
    assert_eq!(w.frame(&m.joints[JointId(1)].parent), "upper.at((-l1 * <[0, 1, 0]>))");
    assert_eq!(w.output("tip"), "Position(lower.at((-l2 * <[0, 1, 0]>)))");
    assert_eq!(w.output("energy"), "(Kinetic + Potential)");
    let inertia = m.bodies[BodyId(0)].inertia.as_ref().expect("a rod has inertia");
    let across = "((m1 * (l1 * l1)) / 12)";
    assert_eq!(w.list(inertia.iter()), format!("[{across}, 0, {across}, 0, 0, 0]"));
    let ForceKind::Effort { joint, values } = &m.forces[ForceId(0)].kind else { panic!("an effort") };
    assert_eq!((joint, w.list(values)), (&JointId(1), "[(-0.01 * v(elbow, 0))]".into()));
    use Request::{Bias, ForwardDynamics, InverseDynamics, MassMatrix};
    assert_eq!(m.emit, [ForwardDynamics, InverseDynamics, MassMatrix, Bias]);
}

#[test]
fn all_joints() {
    let m = model(&format!("mod m {{ {} }}", all_joint_kinds()));
    let w = Writer(&m);
    assert_eq!(m.joints.len(), 11);
    assert_eq!(m.tree.len(), 11);
    assert_eq!(w.output("a"), "q(j1, 0)");
    assert_eq!(w.output("b"), "(v(j4, 0) + v(j4, 1))");
    assert_eq!(w.output("c"), "a(j5, 1)");
    assert_eq!(w.output("d"), "effort(j6, 2)");
    assert_eq!(w.output("e"), "omega(j7)");
    assert_eq!(w.output("f"), "<[v(j8, 0), v(j8, 1), v(j8, 2)]>");
    assert_eq!(w.output("g"), "q(j9, 2)");
    assert_eq!(w.output("h"), "v(j9, 2)");
    assert_eq!(w.output("i"), "<[a(j9, 3), a(j9, 4), a(j9, 5)]>");
    assert_eq!(w.output("k"), "q(j10, 5)");
    assert_eq!(w.output("l"), "Reaction(j0, ground)");
    assert_eq!(w.output("n"), "Linear(Reaction(j1, b1))");
    assert_eq!(w.output("o"), "(q(j1, 0) + Sin[q(j2, 0)])");
    assert_eq!(w.output("p"), "[v(j10, 0), v(j10, 1), v(j10, 2), v(j10, 3), v(j10, 4), v(j10, 5)]");
}

fn all_joint_kinds() -> String {
    let kinds = [
        "Fixed {",
        "Revolute { axis: Z, armature: 0.1,",
        "Prismatic { axis: [1.0, 1.0, 0.0],",
        "Screw { axis: X, pitch: 0.01,",
        "Cylindrical { axis: Y,",
        "Universal { axes: [X, Y],",
        "Planar { axis: Z,",
        "Ball {",
        "Ball { coordinates: RollPitchYaw,",
        "Free {",
        "Free { coordinates: RollPitchYaw,",
    ];
    let mut text = String::new();
    for (k, kind) in kinds.iter().enumerate() {
        text += &format!(
            "body b{k} {{ mass: 1.0, inertia: diag(1.0, 1.5, 2.0) }} joint j{k}: {kind} parent: ground, child: b{k} }}"
        );
    }
    text + "output a = j1;
        output b = j4.travel.rate + j4.angle.rate;
        output c = j5.second.accel;
        output d = j6.angle.effort;
        output e = j7.angular_velocity;
        output f = j8.rates;
        output g = j9.z;
        output h = j9.z.rate;
        output i = j9.angular_acceleration;
        output k = j10.yaw;
        output l: Wrench = j0.reaction;
        output n = j1.reaction.express(b1).force;
        output o = j1 + sin(j2.travel);
        output p = j10.rates;"
}

#[test]
fn all_forces() {
    let m = model(
        "mod m {
            param k = 10.0;
            input u; input w: Vec3;
            state i: rate = u - 2.0 * i - j1.rate, start: 0.5;
            let reach = b.express(c.position - b.position);
            body b { mass: 1.0, inertia: sphere(1.0, 0.1) }
            body c { mass: 1.0, inertia: cuboid(1.0, [0.1, 0.2, 0.3]) }
            joint j1: Revolute { parent: ground, child: b, axis: Z }
            joint j2: Universal { parent: b.at(X), child: c, axes: [X, Y] }
            force a: Effort { joint: j1, value: i + u }
            force b2: Effort { joint: j2.second, value: sin(t) }
            force b3: Effort { joint: j2, value: [1.0, u] }
            force d: Spring { joint: j2.first, stiffness: k, rest: 0.1 }
            force e: Damper { joint: j1, damping: 0.1 }
            force f: SpringDamper { between: [b.at(X), ground], stiffness: k, damping: 1.0, length: 0.0 }
            force g: Force { at: c.at(0.1 * Z), value: [0.0, 0.0, -reach.x], axes: ground }
            force h: Torque { at: c, value: w, axes: b }
            output p = f.power + a.power;
            output s = select(u > 0.0 && !(t < 1.0), reach, X);
            output v = norm(cross(reach, Y)) * dot(X, w) + w[1] + powi(u, 2) + atan2(u, k);
        }",
    );
    let w = Writer(&m);
    assert_eq!((m.states.len(), m.states[StateId(0)].start), (1, 0.5));
    assert_eq!(w.expr(&m.states[StateId(0)].rate), "((u - (2 * i)) - v(j1, 0))");
    let ForceKind::Effort { values, .. } = &m.forces[ForceId(1)].kind else { panic!("an effort") };
    assert_eq!(w.list(values), "[0, Sin[t]]");
    let ForceKind::JointSpring { coordinate, rest: Some(rest), damping: None, .. } = &m.forces[ForceId(3)].kind else {
        panic!("a spring")
    };
    assert_eq!((*coordinate, w.expr(rest)), (0, "0.1".into()));
    assert!(matches!(m.forces[ForceId(5)].kind, ForceKind::LineSpring { length: Some(_), .. }));
    let reach = "Express(b, (Position(c) - Position(b)))";
    assert_eq!(w.output("s"), format!("select[((u Greater 0) && !(t Less 1)), {reach}, <[1, 0, 0]>]"));
    assert_eq!(m.outputs[1].value.ty, Type::Vec3);
    let moment = |k: usize| w.expr(&m.bodies[BodyId(1)].inertia.as_ref().expect("inertia")[k]);
    assert_eq!(moment(0), "((1 / 12) * ((0.2 * 0.2) + (0.3 * 0.3)))");
}

#[test]
fn types_of_values() {
    let m = model(
        "pub mod m {
            const N = 3;
            const P = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
            const Q: [Vec3; N] = [X, [0.0, 1.0, 0.0], Z];
            param gains = [1.0, 2.0];
            param points = [[1, 2, 3], [4, 5, 6]];
            param offset: Vec3 = [0.1, 0.2, gains[1] + late];
            param late = 0.3;
            input u: [Vec3; 2];
            body b { mass: 1, inertia: diag(1, 1, 1) }
            joint j: Free { parent: ground.oriented(P), child: b.at(offset).oriented(Q) }
            output a = [b.position.x, 1.0];
            output c = [b.position, X];
            output d = b.pose; output e = b.pose.position; output f = b.twist.linear;
            output g: Jacobian = b.jacobian.express(b);
            output h = b.rotation;
            output i: Vec3 = [j.x, j.y, P[2][2]];
            output k = points[1] - u[0];
        }",
    );
    let w = Writer(&m);
    let default = |k: usize| m.params[ParamId(k)].default.clone();
    assert_eq!(default(1), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    assert_eq!(m.params[ParamId(1)].ty, Type::Array(Box::new(Type::Vec3), 2));
    assert_eq!(default(2), [0.1, 0.2, 2.3]);
    let types: Vec<&Type> = m.outputs.iter().map(|o| &o.value.ty).collect();
    assert_eq!(*types[0], Type::Array(Box::new(Type::Scalar), 2));
    assert_eq!(*types[1], Type::Array(Box::new(Type::Vec3), 2));
    assert_eq!(
        types[2..],
        [&Type::Pose, &Type::Vec3, &Type::Vec3, &Type::Jacobian, &Type::Rotation, &Type::Vec3, &Type::Vec3]
    );
    assert_eq!(w.output("g"), "Jacobian(b, b)");
    assert_eq!(w.frame(&m.joints[JointId(0)].parent), "ground.oriented([1, 0, 0], [0, 1, 0], [0, 0, 1])");
    assert_eq!(w.output("k"), "(points[1] - u[0])");
}
