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
