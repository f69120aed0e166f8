//! Where functions have kinks and lines no length: derivatives that exist are given, springs between points that are one do
//! nothing, the sign of zero is zero.

use multibody_engine::contracts::function::FunctionKind;
use multibody_engine::contracts::symbol::Symbol;

use super::support::*;

/// Forces of which the derivatives at rest are known.
const DRAG: &str = "body b { mass: 2.0, inertia: diag(1.0, 1.0, 1.0) }
    joint j: Planar { parent: ground, child: b, axis: Z }
    force air: Force { at: b, value: -0.5 * norm(b.velocity) * b.velocity, axes: ground }
    force linear: Effort { joint: j.x, value: -3.0 * j.x.rate - sqrt(j.x * j.x) * j.x }
    force mixed: Effort { joint: j.angle, value: -hypot(j.x.rate, j.y.rate) * j.angle.rate + sqrt(abs(j.y)) * j.y }
    emit forward_dynamics, derivatives;";

#[test]
fn derivatives_at_rest() {
    let case = case(DRAG);
    let found = case.eval(FunctionKind::ForwardDerivatives, &case.rest());
    let mut expected = vec![0.0; found.len()];
    // By the velocity of x: -3 N s/m on 2 kg.
    expected[9] = -1.5;
    close("at rest", &found, &expected, 1e-12);
}

#[test]
fn derivatives_elsewhere() {
    let case = case(DRAG);
    for seed in 1..5 {
        let point = case.random(seed);
        let found = case.eval(FunctionKind::ForwardDerivatives, &point);
        let joint = case.joint("j");
        for component in 0..3 {
            for (matrix, symbol) in
                [Symbol::Position { joint, component }, Symbol::Velocity { joint, component }].into_iter().enumerate()
            {
                let moved = |h: f64| {
                    let mut point = point.clone();
                    point.set(symbol, point.get(symbol) + h);
                    case.eval(FunctionKind::ForwardDynamics, &point)
                };
                let column: Vec<f64> = (0..3).map(|row| found[9 * matrix + 3 * row + component]).collect();
                close("a column", &column, &case.derivative(moved), 1e-8);
            }
        }
    }
}

#[test]
fn points_that_are_one() {
    for force in [
        "SpringDamper { between: [ground.at(X), b.at(Y)], stiffness: 100.0, damping: 2.0, length: 0.3 }",
        "Spring { between: [ground.at(X), b.at(Y)], stiffness: 100.0, length: 0.3 }",
        "Damper { between: [ground.at(X), b.at(Y)], damping: 2.0 }",
    ] {
        let text = |force: &str| {
            format!(
                "world {{ gravity: -10.0 * Y }}
                body b {{ mass: 2.0, com: [0.3, 0.2, 0.0], inertia: diag(1.0, 1.0, 1.0) }}
                joint j: Revolute {{ parent: ground.at(X), child: b.at(Y), axis: Z }}
                {force} output pull = j.reaction; emit forward_dynamics, energy;"
            )
        };
        let with = format!("force idle: {force} output power = idle.power;");
        let (with, without) = (case(&text(&with)), case(&text("")));
        for seed in 1..4 {
            let point = with.random(seed);
            for kind in [FunctionKind::ForwardDynamics, FunctionKind::KineticEnergy] {
                close(force, &with.eval(kind, &point), &without.eval(kind, &point), 0.0);
            }
            close(force, &with.output("pull", &point), &without.output("pull", &point), 0.0);
            close(force, &with.output("power", &point), &[0.0], 0.0);
        }
    }
}

/// Of literals as of everything else.
#[test]
fn the_sign_of_zero() {
    let case = case(
        "param none = 0.0;
        body b { mass: 2.0, inertia: diag(1.0, 1.0, 1.0) }
        joint j: Revolute { parent: ground, child: b, axis: Z }
        output signs = [signum(none), signum(0.0), signum(j), signum(-2.0 * none), signum(j - j + 3.0)];",
    );
    close("signs", &case.output("signs", &case.rest()), &[0.0, 0.0, 0.0, 0.0, 1.0], 0.0);
}

/// What is free has a place that is three numbers, whatever its orientation is.
#[test]
fn springs_on_free_joints() {
    let text = |orientation: &str| {
        format!(
            "body a {{ mass: 1.0, com: [0.1, 0.0, 0.2], inertia: diag(0.5, 0.6, 0.7) }}
            body b {{ mass: 2.0, com: [0.3, 0.2, 0.0], inertia: diag(1.0, 1.0, 1.0) }}
            joint base: Revolute {{ parent: ground, child: a, axis: [1, 2, 3] }}
            joint float: Free {{ parent: a.at([0.2, 0.3, 0.1]).rotated(X, 0.4), child: b, coordinates: {orientation} }}
            force pull: SpringDamper {{ joint: float.x, stiffness: 3.0, damping: 0.2, rest: 0.1 }}
            force lift: Spring {{ joint: float.z, stiffness: 2.0 }}
            output power = pull.power; output place = b.position; output speed = b.velocity;
            output acceleration = b.acceleration; output stored = potential();"
        )
    };
    let (angles, quaternion) = (case(&text("RollPitchYaw")), case(&text("Quaternion")));
    let [mut one, mut other] = [angles.rest(), quaternion.rest()];
    let mut random = Random(3);
    for (name, count) in [("base", 1), ("float", 3)] {
        for component in 0..count {
            for order in [0, 1] {
                let make = |joint| match order {
                    0 => Symbol::Position { joint, component },
                    _ => Symbol::Velocity { joint, component },
                };
                let value = random.next();
                one.set(make(angles.joint(name)), value);
                other.set(make(quaternion.joint(name)), value);
            }
        }
    }
    for name in ["place", "speed", "power", "acceleration", "stored"] {
        close(name, &quaternion.output(name, &other), &angles.output(name, &one), 1e-12);
    }
}
