//! Parts: expansion into instances, bound ports and params, indices, access from outside.

use crate::support::{self, Writer, model};
use multibody_engine::model::types::*;

const LEG: &str = "
    /// A foot.
    mod foot {
        port on: Frame;
        param m = 0.1;
        body pad { mass: m }
        joint slide: Prismatic { parent: on, child: pad, axis: Z }
        output height = pad.position.z;
    }
    /// A leg with a foot.
    mod leg {
        port hip: Frame;
        port hand: Frame;
        /// [kg] of the thigh
        param m = 1.0;
        param length = 0.5;
        input torque;
        const AXES = [X, Y];
        let half = 0.5 * length;
        body thigh { mass: m, com: half * X, inertia: rod(m, length, X) }
        joint gimbal: Universal { parent: hip, child: thigh, axes: AXES }
        part end: foot { on: thigh.at(length * X), m: 0.1 * m };
        force drive_it: Effort { joint: gimbal.first, value: torque }
        output gap = norm(hand.position - end.pad.position);
    }
";

#[test]
fn arrays_of_nested_parts() {
    let m = model(&format!(
        "{LEG} pub mod hexapod {{
            const FEET = [X, Y, -X];
            const N = 3;
            param mass = 6.0;
            /// All legs.
            part legs: [leg; N] = |i| leg {{ hip: trunk.at(FEET[i]).rotated(Z, 2.0 * PI * i / 3.0), hand: ground, m: mass / 6.0 }};
            body trunk {{ mass: mass, inertia: diag(1.0, 1.0, 1.0) }}
            joint free: Free {{ parent: ground, child: trunk }}
            output a = legs[2].gimbal.first.rate + legs[N - 3].end.slide;
            output b = legs[1].end.pad.position;
            output c = legs[0].torque * legs[0].half;
            output d = legs[0].drive_it.power;
        }}"
    ));
    let w = Writer(&m);
    let types: Vec<String> = m.part_types.iter().map(|t| t.name.to_string()).collect();
    assert_eq!(types, ["leg", "foot"]);
    assert_eq!(m.part_types[PartTypeId(0)].docs.text, [" A leg with a foot."]);
    assert_eq!(m.instances.len(), 7);
    let at = |k: usize| {
        let i = &m.instances[InstanceId(k)];
        (i.parent.map(|p| p.0), i.field.to_string(), i.index, i.part_type.map(|t| t.0))
    };
    assert_eq!(at(3), (Some(0), "legs".into(), Some((1, 3)), Some(0)));
    assert_eq!(at(4), (Some(3), "end".into(), None, Some(1)));
    assert_eq!(m.instances[InstanceId(1)].docs.text, [" All legs."]);
    // The bound params are fields no more; `length` is one per leg.
    let params: Vec<String> = m.params.iter().map(|p| w.place(&p.place)).collect();
    assert_eq!(params, ["mass", "legs[0].length", "legs[1].length", "legs[2].length"]);
    let joints: Vec<String> = m.joints.iter().map(|j| w.place(&j.place)).collect();
    assert_eq!(joints[..3], ["legs[0].gimbal", "legs[0].end.slide", "legs[1].gimbal"]);
    assert_eq!(joints[6], "free");
    assert_eq!(m.tree[0], JointId(6));
    assert_eq!(
        w.frame(&m.joints[JointId(2)].parent),
        "trunk.at(<[0, 1, 0]>).rotated(<[0, 0, 1]>, (((2 * PI) * 1) / 3))"
    );
    assert_eq!(w.expr(&m.bodies[BodyId(1)].mass), "(0.1 * (mass / 6))");
    assert_eq!(w.output("a"), "(v(legs[2].gimbal, 0) + q(legs[0].end.slide, 0))");
    assert_eq!(w.output("b"), "Position(legs[1].end.pad)");
    assert_eq!(w.output("c"), "(legs[0].torque * (0.5 * legs[0].length))");
    assert_eq!(w.output("d"), "Power(legs[0].drive_it)");
    assert_eq!(w.output("legs[1].gap"), "Norm[(Position(ground) - Position(legs[1].end.pad))]");
    assert_eq!(w.output("legs[1].end.height"), "Position(legs[1].end.pad).z");
}

#[test]
fn shared_values_are_one_node() {
    let m = model(
        "mod m {
            param a = 1.0;
            let b = sin(a) + 1.0;
            const P = [X, Y];
            body link { mass: b, inertia: diag(b, b, 1.0) }
            joint j: Revolute { parent: ground, child: link, axis: P[0] }
            output x = b; output y = b * 2.0;
        }",
    );
    let inertia = m.bodies[BodyId(0)].inertia.as_ref().expect("inertia");
    assert!(std::rc::Rc::ptr_eq(&m.bodies[BodyId(0)].mass.node, &inertia[0].node));
    assert!(std::rc::Rc::ptr_eq(&m.outputs[0].value.node, &inertia[1].node));
}

#[test]
fn two_models_and_a_rename() {
    let text = "#![krate(::mb)] mod a { body b { mass: 1.0 } joint j: Prismatic { parent: ground, child: b, axis: X } }
        #[cfg(unix)] mod c { body b { mass: 1.0 } joint j: Prismatic { parent: ground, child: b, axis: X } }
        #[cfg(windows)] mod c { body b { mass: 1.0 } joint j: Prismatic { parent: ground, child: b, axis: Y } }";
    let (models, diagnostics) = support::check(text);
    assert!(diagnostics.is_empty());
    assert_eq!(models.len(), 3);
    assert!(models[0].krate.is_ident("mb") || models[0].krate.segments.len() == 1);
    assert_eq!(models[0].emit, [Request::ForwardDynamics]);
    assert_eq!(models[2].attrs.len(), 1);
}

const DRIVE: &str = "
    /// A motor without inductance.
    mod motor {
        port shaft: Joint;
        /// [V]
        port supply: Scalar;
        /// [N m/A]
        param constant = 0.05;
        /// [ohm]
        param resistance = 2.0;
        /// [A]
        let current = (supply - constant * shaft.rate) / resistance;
        force torque: Effort { joint: shaft, value: constant * current }
        output power = supply * current;
        output angle = shaft;
    }
    /// A push along a given direction.
    mod pusher {
        port at: Frame;
        port along: Vec3;
        force push: Force { at: at, axes: ground, value: 2.0 * along }
    }";

/// A coordinate and values are given as frames are: what is meant is the joint of the model, what is written is read where it stands.
#[test]
fn ports_take_coordinates_and_values() {
    let m = model(&format!(
        "{DRIVE} pub mod m {{
            /// [V]
            input voltage;
            param k = 3.0;
            body a {{ mass: 1.0, com: X, inertia: diag(1, 1, 1) }}
            body b {{ mass: 1.0, com: X, inertia: diag(1, 1, 1) }}
            joint hinge: Revolute {{ parent: ground, child: a, axis: Z }}
            joint gimbal: Universal {{ parent: a.at(X), child: b, axes: [X, Y] }}
            part one: motor {{ shaft: hinge, supply: voltage - k * gimbal.second, constant: 0.1 }};
            part two: motor {{ shaft: gimbal.second, supply: 2.0 * one.current, constant: 0.2 }};
            part three: pusher {{ at: b.at(X), along: k * a.velocity }};
            output x = two.power;
        }}"
    ));
    let w = Writer(&m);
    assert_eq!(w.output("one.angle"), "q(hinge, 0)");
    assert_eq!(w.output("two.angle"), "q(gimbal, 1)");
    let one = "(((voltage - (k * q(gimbal, 1))) - (0.1 * v(hinge, 0))) / one.resistance)";
    let two = format!("(((2 * {one}) - (0.2 * v(gimbal, 1))) / two.resistance)");
    assert_eq!(w.output("x"), format!("((2 * {one}) * {two})"));
    assert_eq!(m.inputs.len(), 1);
    assert_eq!(m.joints.len(), 2);
}

#[test]
fn mistakes_of_ports() {
    let model = "body a { mass: 1.0, com: X, inertia: diag(1, 1, 1) }
        joint gimbal: Universal { parent: ground, child: a, axes: [X, Y] } /// [m]
        param far = 1.0;";
    let cases = [
        (
            "part p: motor { shaft: gimbal, supply: 1.0 };",
            "gimbal | a universal joint has 2 coordinates, a port for a joint takes one | name the coordinate, such as `gimbal.first`",
        ),
        (
            "part p: motor { shaft: a, supply: 1.0 };",
            "a | this is no joint | a port for a joint takes a joint of one coordinate, or a coordinate of one",
        ),
        (
            "part p: motor { shaft: gimbal.first, supply: a };",
            "a | expected a value, found a frame | take `.position`, `.velocity`, `.pose`, .. of it",
        ),
        ("part p: motor { shaft: gimbal.first, supply: far };", "far | `supply` is declared in V, its value is in m"),
        (
            "part p: motor { supply: 1.0 };",
            "p | the port `shaft` of `motor` is not bound | write `shaft: <joint>` between the braces",
        ),
        (
            "part p: motor { shaft: gimbal.first };",
            "p | the port `supply` of `motor` is not bound | write `supply: <value>` between the braces",
        ),
        ("part p: pusher { at: a, along: 1.0 };", "1.0 | expected a Vec3, found a scalar"),
    ];
    for (part, expected) in cases {
        let said = support::said(&format!("{DRIVE} mod m {{ {model} {part} }}"));
        assert!(said.iter().any(|line| line.starts_with(expected)), "{part}\n{said:#?}");
    }
    // The unit of a joint says whether it slides.
    let slides = DRIVE.replace("port shaft: Joint", "/// [m]\n port shaft: Joint").replace("/// [N m/A]", "");
    let said =
        support::said(&format!("{slides} mod m {{ {model} part p: motor {{ shaft: gimbal.first, supply: 1.0 }}; }}"));
    assert!(
        said.iter().any(|line| line == "gimbal.first | `shaft` is declared in m, this coordinate is in rad"),
        "{said:#?}"
    );
    // A signal that goes round in a circle.
    let round = format!(
        "{DRIVE} mod m {{ {model} part p: motor {{ shaft: gimbal.first, supply: q.current }}; part q: motor {{ shaft: gimbal.second, supply: p.current }}; }}"
    );
    let said = support::said(&round);
    assert!(said.iter().any(|line| line.contains("is defined through itself")), "{said:#?}");
}

/// A part that nobody uses is checked by itself, whatever its ports lead to.
#[test]
fn ports_of_a_part_by_itself() {
    assert_eq!(support::said(DRIVE), Vec::<String>::new());
    let wrong = DRIVE.replace("shaft.rate", "shaft.rat").replace("2.0 * along", "at * along");
    assert_eq!(support::said(&wrong).len(), 2, "{:#?}", support::said(&wrong));
}
