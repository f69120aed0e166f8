//! Hinges that speeds make a ball, against the same speeds written so that no ball is made of them: every function, in all its ways.
//! Among what is asked is all that makes no ball today (`allows_balls`), so that this says what goes wrong once it does.

use multibody_engine::contracts::function::FunctionKind;

use super::support::{Case, case_with, close};

/// A body on three hinges about one point that a cart carries, and what hangs on it.
const TOP: &str = "world { gravity: [0.3, -0.2, -9.7] }
     input push;
     body cart { mass: 1.3, com: [0.1, 0.2, 0.0], inertia: diag(0.1, 0.2, 0.15) }
     body one { mass: 0.2, com: [0.05, 0.0, 0.1], inertia: diag(0.01, 0.02, 0.015) }
     body two { mass: 0.3, com: [0.0, 0.02, -0.1], inertia: diag(0.02, 0.02, 0.015) }
     body top { mass: 2.0, com: [0.1, -0.05, 0.3], inertia: inertia(0.3, 0.4, 0.5, 0.01, 0.02, -0.03) }
     body arm { mass: 0.7, com: [0.2, 0.1, 0.0], inertia: inertia(0.03, 0.02, 0.04, 0.001, 0.002, -0.003) }
     joint slide: Prismatic { parent: ground.rotated(X, 0.3), child: cart, axis: [1.0, 0.2, 0.1] }
     joint swing: Revolute { parent: cart, child: base_of, axis: [0.1, 1.0, 0.3] }
     body base_of { mass: 0.5, com: [0.1, 0.0, 0.0], inertia: diag(0.05, 0.04, 0.03) }
     joint first: Revolute { parent: base_of.at([0.1, 0.2, 0.3]).rotated(Y, 0.4), child: one, axis: [0.3, 1.0, 0.2] }
     joint second: Revolute { parent: one, child: two, axis: -[1.0, 0.1, -0.3] }
     joint third: Revolute { parent: two, child: top.at([0.1, 0.05, -0.1]).rotated(Z, 0.8), axis: -Z }
     joint elbow: Revolute { parent: top.at([0.3, 0.1, 0.2]), child: arm, axis: [0.1, 1.0, 0.4] }
     let seen = top.rotated([1.0, -1.0, 2.0], 0.7);
     let w = seen.express(top.angular_velocity - base_of.angular_velocity);
     emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy, derivatives, impulse;";

/// What is asked of balls, and what acts on them. Each is alone, so that nothing keeps another from making a ball.
const OF_BALLS: &[&str] = &[
    "output moved = [top.acceleration, two.angular_acceleration, one.acceleration, arm.angular_acceleration];",
    "output rates = [first.rate, second.rate, third.rate, elbow.rate, slide.rate];
     output accelerations = [first.accel, second.accel, third.accel, elbow.accel, slide.accel];",
    "output loads = [third.reaction.force, third.reaction.moment, elbow.reaction.moment, swing.reaction.force];",
    "output rider = arm.jacobian; output other = two.jacobian; output turned = two.twist; output twisted = arm.twist;",
    "output whole = [linear_momentum(), angular_momentum(), centre_of_mass().acceleration]; emit poses;",
    "force drag: SpringDamper { joint: second, stiffness: 3.0, damping: 0.4, rest: 0.2 }
     force turned: Damper { joint: third, damping: 0.3 } force by: Effort { joint: first, value: push * third.rate }
     output powers = [drag.power, turned.power, by.power];",
    "force held: Torque { at: two, axes: one, value: [0.1, 0.2, push] } force along: Force { at: one.at(0.2 * X), axes: arm, value: [push, 0.3, 0.1] }
     output powers = [held.power, along.power];",
    "force line: SpringDamper { between: [ground.at([0.4, 0.5, 1.0]), top.at([0.2, 0.1, 0.4])], stiffness: 40.0, damping: 2.0, length: 0.7 }
     force inner: SpringDamper { between: [cart, two.at([0.2, 0.1, 0.4])], stiffness: 40.0, damping: 2.0, length: 0.7 }",
    "force touch: Contact { at: arm.at([0.4, 0.0, 0.0]), radius: 0.1, on: ground, stiffness: 1e3, damping: 0.3, friction: 0.5 }
     output contact = touch.force;",
    "output entry = mass_matrix[slide, elbow]; output rest = bias[elbow];",
];

/// What keeps hinges from being a ball.
const OF_HINGES: &[&str] = &[
    "output loads = [first.reaction.force, second.reaction.moment];",
    "state wound: rate = third.rate - 0.3 * wound + top.angular_velocity.y, start: 0.1; force by: Effort { joint: second, value: wound }
     output slope = diff(kinetic(), slide.rate);",
    "output slope = diff(kinetic(), first.rate); output other = diff(potential(), second);",
    "output put = substitute(kinetic(), first = 0.3, second.rate = 0.2);",
    "joint tied: Free { parent: cart, child: arm } output measured = [tied.x, tied.y.rate, tied.z.accel];",
    "drive swing = 0.3 * sin(3.0 * t); output effort = swing.effort;",
    "constraint gear = elbow - 2.0 * slide;",
    "constraint gear = third - 2.0 * elbow;",
    "constraint blade = top.express(top.velocity).y; formulation { constraints: Reduced } output load = blade.multiplier;",
    "constraint blade = arm.express(arm.velocity).y; output load = blade.multiplier;",
    "constraint link: Rod { between: [ground.at([0.9, 0.5, 0.2]), arm.at([0.3, 0.0, 0.1])], length: 0.8 } output load = link.multiplier;",
];

const KINDS: [FunctionKind; 18] = [
    FunctionKind::ForwardDynamics,
    FunctionKind::InverseDynamics,
    FunctionKind::MassMatrix,
    FunctionKind::Bias,
    FunctionKind::KineticEnergy,
    FunctionKind::PotentialEnergy,
    FunctionKind::Constraints,
    FunctionKind::ConstraintJacobian,
    FunctionKind::PositionJacobian,
    FunctionKind::ConstraintRate,
    FunctionKind::ConstraintBias,
    FunctionKind::ForwardDerivatives,
    FunctionKind::InverseDerivatives,
    FunctionKind::Impulse,
    FunctionKind::PositionRates,
    FunctionKind::RateDerivatives,
    FunctionKind::Poses,
    FunctionKind::Outputs,
];

/// The same numbers from all functions of both, at random states.
fn agree(ball: &Case, general: &Case, label: &str) {
    for seed in 1..4 {
        let point = ball.random(seed);
        for kind in KINDS.into_iter().filter(|&kind| ball.candidates(kind) > 0) {
            let (found, wanted) = (ball.eval(kind, &point), general.eval(kind, &point));
            close(&format!("{label}: {kind:?}"), &found, &wanted, 1e-8);
        }
    }
}

/// Nodes of the mass matrix, which are others where there is a ball.
fn nodes(case: &Case) -> usize {
    let made = case.derivation.functions.iter().find(|made| made.kind == FunctionKind::MassMatrix).expect("derived");
    case.derivation.graph.reachable_scalars(&made.candidates[0].1.list).len()
}

#[test]
fn balls_are_what_their_speeds_say() {
    let in_ball = "speed x = w.x; speed y = w.y; speed z = w.z;";
    let general = "speed x = 1.0 * w.x; speed y = 1.0 * w.y; speed z = 1.0 * w.z;";
    let of = |features: &'static [&str], has_ball: bool| features.iter().map(move |feature| (*feature, has_ball));
    for (feature, has_ball) in of(OF_BALLS, true).chain(of(OF_HINGES, false)) {
        let [one, other] = [in_ball, general].map(|speeds| case_with("", &format!("{TOP} {speeds} {feature}")));
        assert_eq!(nodes(&one) != nodes(&other), has_ball, "{feature}");
        agree(&one, &other, feature);
    }
}
