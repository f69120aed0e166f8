//! Reactions: statics known by hand, and Newton's and Euler's laws for a body at the end of any joint.

use super::support::*;

#[test]
fn hanging_weights() {
    let case = case(
        "world { gravity: -10.0 * Z }
        body a { mass: 1.0, com: -0.5 * Z, inertia: diag(0.1, 0.1, 0.01) }
        body b { mass: 2.0, com: -0.5 * Z, inertia: diag(0.1, 0.1, 0.01) }
        body c { mass: 4.0 }
        joint one: Revolute { parent: ground, child: a, axis: X }
        joint two: Ball { parent: a.at(-Z), child: b }
        joint three: Fixed { parent: b.at(-Z), child: c }
        output forces = [one.reaction.force, two.reaction.force, three.reaction.force];
        output moments = [one.reaction.moment, two.reaction.moment, three.reaction.moment];
        output turned = three.reaction.express(c.rotated(X, 0.5 * PI));
        emit forward_dynamics;",
    );
    let rest = case.rest();
    close("forces", &case.output("forces", &rest), &[0.0, 0.0, 70.0, 0.0, 0.0, 60.0, 0.0, 0.0, 40.0], 1e-12);
    close("moments", &case.output("moments", &rest), &[0.0; 9], 1e-12);
    close("axes", &case.output("turned", &rest), &[0.0, 40.0, 0.0, 0.0, 0.0, 0.0], 1e-12);
}

#[test]
fn cantilever() {
    let case = case(
        "world { gravity: -10.0 * Z }
        input load;
        body beam { mass: 2.0, com: 0.5 * X, inertia: rod(2.0, 1.0, X) }
        body tip { mass: 3.0 }
        joint wall: Fixed { parent: ground.at(Z), child: beam }
        joint weld: Fixed { parent: beam.at(X), child: tip }
        joint spare: Revolute { parent: ground, child: other, axis: Z }
        body other { mass: 1.0, com: X, inertia: diag(0.0, 1.0, 1.0) }
        force push: Force { at: tip, value: -load * Y, axes: ground }
        force screw: Torque { at: beam, value: 0.7 * X, axes: ground }
        output at_wall = wall.reaction;
        output at_weld = weld.reaction;
        emit forward_dynamics;",
    );
    let mut point = case.rest();
    let input = multibody_engine::model::types::InputId(0);
    point.set(multibody_engine::contracts::symbol::Symbol::Input { input, element: 0 }, 5.0);
    close("weld", &case.output("at_weld", &point), &[0.0, 5.0, 30.0, 0.0, 0.0, 0.0], 1e-12);
    close("wall", &case.output("at_wall", &point), &[0.0, 5.0, 50.0, -0.7, -40.0, 5.0], 1e-12);
}

#[test]
fn no_effort_about_free_axes() {
    let case = case(
        "world { gravity: [1.0, -9.0, 2.0] }
        body a { mass: 1.0, com: [0.3, 0.1, 0.2], inertia: inertia(0.5, 0.6, 0.7, 0.02, -0.03, 0.01) }
        body b { mass: 2.0, com: [0.1, 0.1, 0.5], inertia: diag(0.1, 0.1, 0.12) }
        joint one: Revolute { parent: ground, child: a, axis: Y }
        joint two: Prismatic { parent: a.at(-Z), child: b, axis: [1.0, 1.0, 0.0] }
        force motor: Effort { joint: two, value: 3.0 }
        output first = one.reaction.express(a);
        output second = two.reaction.express(b.rotated(Z, 0.25 * PI));
        emit forward_dynamics;",
    );
    for seed in 1..4 {
        let point = case.random(seed);
        close("about the hinge", &case.output("first", &point)[4..5], &[0.0], 1e-12);
        close("along the rail", &case.output("second", &point)[..1], &[3.0], 1e-12);
    }
}

/// Force: m (a - g) less what is applied; moment: rate of the angular momentum about the centre of mass.
#[test]
fn newton_and_euler_at_every_kind() {
    let kinds = [
        "Fixed {",
        "Revolute { axis: [1.0, 2.0, 0.5]",
        "Prismatic { axis: -X",
        "Screw { axis: Z, pitch: 0.2",
        "Cylindrical { axis: -Y",
        "Universal { axes: [X, Z]",
        "Planar { axis: Y",
        "PinSlot { axis: Y, slide: [1, 0, 2]",
        "Planar { axes: [X, Z]",
        "Ball {",
        "Ball { coordinates: RollPitchYaw",
        "Free {",
        "Free { coordinates: RollPitchYaw",
    ];
    for kind in kinds {
        let (name, fields) = kind.split_once('{').expect("fields");
        let case = case(&format!(
            "world {{ gravity: [1.0, -9.0, 2.0] }}
            input load: Vec3;
            body a {{ mass: 1.0, com: [0.3, 0.1, 0.2], inertia: inertia(0.5, 0.6, 0.7, 0.02, -0.03, 0.01) }}
            body b {{ mass: 0.7, com: [0.1, 0.2, -0.1], inertia: inertia(0.05, 0.06, 0.07, 0.002, -0.003, 0.001) }}
            joint hinge: Revolute {{ parent: ground, child: a, axis: [1.0, -1.0, 0.5] }}
            joint j: {name} {{ parent: a.at([0.1, 0.2, 0.3]).rotated(X, 0.3), child: b.at([0.1, -0.2, 0.1]).rotated(Y, 0.4), {fields} }}
            force push: Force {{ at: b.at(X), value: load, axes: ground }}
            output com = b.at([0.1, 0.2, -0.1]).position;
            output acceleration = b.at([0.1, 0.2, -0.1]).acceleration;
            output rotation = b.rotation;
            output angular = b.angular_velocity;
            output here = b.at([0.1, -0.2, 0.1]).position;
            output point = b.at(X).position;
            output load_now = load;
            output reaction = j.reaction;
            emit forward_dynamics;"
        ));
        for seed in 1..3 {
            let point = case.random(seed);
            let get = |name: &str| -> [f64; 3] {
                let list = case.output(name, &point);
                std::array::from_fn(|k| list[k])
            };
            let (a, load) = (get("acceleration"), get("load_now"));
            let gravity = [1.0, -9.0, 2.0];
            let force = [0, 1, 2].map(|k| 0.7 * (a[k] - gravity[k]) - load[k]);
            let reaction = case.output("reaction", &point);
            close(&format!("{kind} force"), &reaction[..3], &force, 1e-10);
            let momentum = |p: &Point| {
                let (r, w) = (case.output("rotation", p), case.output("angular", p));
                let r: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| r[3 * i + j]));
                let tensor = [[0.05, 0.002, -0.003], [0.002, 0.06, 0.001], [-0.003, 0.001, 0.07]];
                let own = apply(&transpose(&r), &[w[0], w[1], w[2]]);
                apply(&r, &apply(&tensor, &own)).to_vec()
            };
            let rate = case.rate_along_flow(&point, momentum);
            let arm = |from: [f64; 3]| -> [f64; 3] {
                let com = get("com");
                [0, 1, 2].map(|k| from[k] - com[k])
            };
            let (at_joint, at_load) = (cross(arm(get("here")), force), cross(arm(get("point")), load));
            let moment: Vec<f64> = (0..3).map(|k| rate[k] - at_joint[k] - at_load[k]).collect();
            close(&format!("{kind} moment"), &reaction[3..], &moment, 1e-7);
        }
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3])
}
