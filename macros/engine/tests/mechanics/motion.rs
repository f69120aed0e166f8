//! The same motion in other coordinates and other frames.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;

use super::support::*;

const OUTPUTS: &str = "
    output acceleration = b.at([0.1, 0.2, 0.3]).acceleration;
    output spin = b.angular_acceleration;
    output velocity = b.at([0.1, 0.2, 0.3]).velocity;
    output energy = kinetic() + potential();
    output pose = b.pose;
    output other = a.at(X).acceleration;
    emit forward_dynamics;";

fn floating(coordinates: &str, free: bool) -> Case {
    let kind = if free { "Free" } else { "Ball" };
    case(&format!(
        "world {{ gravity: -9.81 * Y }}
        body a {{ mass: 1.0, com: 0.2 * X, inertia: diag(0.1, 0.2, 0.25) }}
        body b {{ mass: 0.7, com: [0.1, 0.2, 0.0], inertia: inertia(0.05, 0.04, 0.03, 0.001, 0.002, -0.003) }}
        joint hinge: Revolute {{ parent: ground, child: a, axis: [1.0, 2.0, 3.0] }}
        joint j: {kind} {{ parent: a.at(0.4 * Y).rotated(X, 0.3), child: b.rotated(Z, 0.8).at([0.1, 0.0, 0.2]), {coordinates} }}
        force drag: Torque {{ at: b, value: -0.2 * b.angular_velocity, axes: ground }}
        output relative = j.angular_velocity;
        {OUTPUTS}"
    ))
}

#[test]
fn quaternions_and_angles_agree() {
    for free in [false, true] {
        let angles = floating("coordinates: RollPitchYaw", free);
        let quaternion = floating("coordinates: Quaternion", free);
        for seed in 1..5 {
            let point = angles.random(seed);
            let joint = angles.joint("j");
            let start = if free { 3 } else { 0 };
            let mut same = quaternion.random(seed);
            for symbol in &angles.derivation.symbols {
                let turning = matches!(symbol, Symbol::Position { joint: j, component }
                    | Symbol::Velocity { joint: j, component } if *j == joint && *component >= start);
                if !turning {
                    same.set(*symbol, point.get(*symbol));
                }
            }
            let angle = |k: usize| 0.5 * point.get(Symbol::Position { joint, component: start + k });
            let turns = [(2, 3), (1, 2), (0, 1)].map(|(k, axis)| {
                let mut q = [angle(k).cos(), 0.0, 0.0, 0.0];
                q[axis] = angle(k).sin();
                q
            });
            let q = multiply_quaternions(&multiply_quaternions(&turns[0], &turns[1]), &turns[2]);
            for (k, value) in q.into_iter().enumerate() {
                same.set(Symbol::Position { joint, component: start + k }, value);
            }
            for (k, value) in angles.output("relative", &point).into_iter().enumerate() {
                same.set(Symbol::Velocity { joint, component: start + k }, value);
            }
            for name in ["relative", "velocity", "acceleration", "spin", "energy", "other"] {
                close(name, &quaternion.output(name, &same), &angles.output(name, &point), 1e-10);
            }
        }
    }
}

#[test]
fn frames_do_not_matter() {
    let plain = case(&format!(
        "world {{ gravity: -9.81 * Y }}
        body a {{ mass: 1.0, com: [0.2, 0.1, 0.0], inertia: diag(0.1, 0.2, 0.25) }}
        body b {{ mass: 0.7, com: [0.1, 0.2, 0.0], inertia: inertia(0.05, 0.04, 0.03, 0.001, 0.002, -0.003) }}
        joint hinge: Revolute {{ parent: ground, child: a, axis: Z }}
        joint j: Universal {{ parent: a.at(X), child: b, axes: [X, Y] }}
        {OUTPUTS}"
    ));
    // Body b's frame turned by a quarter about z (x' = y, y' = -x) and moved by (0.5, 0, 0) in the old axes; the
    // joints' frames turned and moved on both sides.
    let moved = case(&format!(
        "world {{ gravity: -9.81 * Y }}
        body a {{ mass: 1.0, com: [0.2, 0.1, 0.0], inertia: diag(0.1, 0.2, 0.25) }}
        body b {{ mass: 0.7, com: [0.2, 0.4, 0.0], inertia: inertia(0.04, 0.05, 0.03, -0.001, -0.003, -0.002) }}
        joint hinge: Revolute {{
            parent: ground.rotated(X, 0.5 * PI).rotated(Y, 0.3), child: a.rotated(X, 0.5 * PI).rotated(Y, 0.3), axis: Y
        }}
        joint j: Universal {{
            parent: a.at(X).rotated(Z, 0.5 * PI), child: b.at(0.5 * Y), axes: [-Y, X]
        }}
        {}",
        OUTPUTS
            .replace("b.at([0.1, 0.2, 0.3])", "b.at([0.2, 0.4, 0.3])")
            .replace("b.pose", "b.at(0.5 * Y).rotated(Z, -0.5 * PI).pose")
    ));
    for seed in 1..4 {
        let point = plain.random(seed);
        for name in ["velocity", "acceleration", "spin", "energy", "other", "pose"] {
            close(name, &moved.output(name, &point), &plain.output(name, &point), 1e-12);
        }
        let (a, b) = (FunctionKind::ForwardDynamics, FunctionKind::ForwardDynamics);
        close("accelerations", &moved.eval(a, &point), &plain.eval(b, &point), 1e-11);
    }
}

#[test]
fn a_planar_chain_needs_one_angle_per_link() {
    let case = case(
        "body a { mass: 1.0, com: 0.2 * X, inertia: diag(0.1, 0.2, 0.25) }
        body b { mass: 0.7, com: 0.1 * X, inertia: diag(0.05, 0.04, 0.03) }
        body c { mass: 0.7, com: 0.1 * X, inertia: diag(0.05, 0.04, 0.03) }
        joint one: Revolute { parent: ground, child: a, axis: Z }
        joint two: Revolute { parent: a.at(X), child: b, axis: Z }
        joint three: Revolute { parent: b.at(X), child: c, axis: -Z }
        output tip = c.at(X).position;
        output spin = c.angular_velocity;
        emit forward_dynamics;",
    );
    use multibody_engine::symbolic::graph::ScalarNode;
    let graph = &case.derivation.graph;
    let outputs = case.derivation.functions.iter().find(|f| f.kind == FunctionKind::Outputs).expect("outputs");
    for results in outputs.candidates.iter().map(|(_, results)| &results.list) {
        let nodes = graph.reachable_scalars(results);
        let sines = nodes.iter().filter(|&&k| matches!(graph.node(graph.scalar_at(k)), ScalarNode::Sin(_))).count();
        assert!(sines <= 3, "{sines} sines");
        let spin = graph.reachable_scalars(&results[5..6]);
        let plain = |&k: &usize| matches!(graph.node(graph.scalar_at(k)), ScalarNode::Sum(_) | ScalarNode::Symbol(_));
        assert!(spin.iter().all(plain), "a sum of rates");
    }
}

#[test]
fn a_ball_under_the_ground_gives_its_coordinates() {
    let case = case(
        "body b { mass: 1.0, inertia: diag(0.1, 0.2, 0.25) }
        joint j: Free { parent: ground, child: b }
        output pose = b.pose;
        output x = j.x;
        output own = b.express(b.angular_velocity);
        emit forward_dynamics;",
    );
    for results in case.derivation.functions[1].candidates.iter().map(|(_, results)| &results.list) {
        let wanted = [Symbol::Position { joint: case.joint("j"), component: 0 }];
        assert_eq!(case.derivation.symbols.iter().position(|s| *s == wanted[0]), symbol(&case, results[7]));
        for (component, &result) in results[..7].iter().enumerate() {
            let found = symbol(&case, result).map(|id| case.derivation.symbols[id]);
            assert_eq!(found, Some(Symbol::Position { joint: case.joint("j"), component }));
        }
        for (k, &result) in results[8..].iter().enumerate() {
            let found = symbol(&case, result).map(|id| case.derivation.symbols[id]);
            assert_eq!(found, Some(Symbol::Velocity { joint: case.joint("j"), component: k + 3 }));
        }
    }
}

fn symbol(case: &Case, s: multibody_engine::symbolic::graph::Scalar) -> Option<usize> {
    use multibody_engine::symbolic::graph::ScalarNode;
    match case.derivation.graph.node(s) {
        ScalarNode::Symbol(id) => Some(id.0),
        _ => None,
    }
}

#[test]
fn a_floating_body_divides_by_constants() {
    use multibody_engine::symbolic::graph::ScalarNode;
    let case = case(
        "body b { mass: 2.0, com: [0.1, 0.2, 0.3], inertia: diag(0.1, 0.2, 0.25) }
        joint j: Free { parent: ground, child: b }
        emit forward_dynamics;",
    );
    let graph = &case.derivation.graph;
    let quotients = |results: &[multibody_engine::symbolic::graph::Scalar]| {
        let nodes = graph.reachable_scalars(results);
        nodes.iter().filter(|&&k| matches!(graph.node(graph.scalar_at(k)), ScalarNode::Reciprocal(_))).count()
    };
    let least = case.derivation.functions[0].candidates.iter().map(|(_, results)| quotients(&results.list)).min();
    assert_eq!(least, Some(0));
    case.eval(FunctionKind::ForwardDynamics, &case.random(1));
}
