//! Turns of bodies on hinges as speeds: the same motion as in the rates of the hinges, whatever hangs on these.

use multibody::{Configuration, Tangent, multibody};

use crate::speeds::{Random, agree, derivatives_are_slopes, flat, with_rates};

/// One mechanism in the rates of its coordinates, and in speeds.
macro_rules! two_ways {
    ($rates:ident, $chosen:ident, { $($items:tt)* }, { $($speeds:tt)* }) => {
        multibody! {
            pub(crate) mod $rates {
                $($items)*
                emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy, derivatives;
            }
            pub(crate) mod $chosen {
                $($items)*
                $($speeds)*
                emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy, derivatives, linearize;
            }
        }
    };
}

two_ways!(top, top_turning, {
    param tilt = 0.3;
    world { gravity: [0.3, -0.2, -9.7] }
    body trolley { mass: 1.3 }
    body one { mass: 0 }
    body two { mass: 0.2, com: [0.0, 0.1, 0.05], inertia: diag(0.01, 0.02, 0.03) }
    body top { mass: 2.0, com: [0.1, -0.05, 0.3], inertia: inertia(0.3, 0.4, 0.5, 0.01, 0.02, -0.03) }
    body arm { mass: 0.7, com: [0.2, 0.1, 0.0], inertia: inertia(0.03, 0.02, 0.04, 0.001, 0.002, -0.003) }
    joint slide: Prismatic { parent: ground.rotated(X, 0.3), child: trolley, axis: [1.0, 0.2, 0.1] }
    joint first: Revolute {
        parent: trolley.at([0.1, 0.2, 0.3]).rotated([1.0, 2.0, 3.0], 0.4), child: one, axis: [0.3, 1.0, 0.2], armature: 0.05,
    }
    joint second: Revolute { parent: one.rotated(Y, tilt), child: two.rotated(X, -0.5), axis: [1.0, 0.1, -0.3] }
    joint third: Revolute { parent: two.rotated(X, -0.5), child: top.at([0.1, 0.05, -0.1]).rotated(Z, 0.8), axis: -Z }
    joint elbow: Revolute { parent: top.at([0.3, 0.1, 0.2]).rotated(Y, 0.6), child: arm, axis: [0.1, 1.0, 0.4] }
    input twist;
    force push: Effort { joint: first, value: twist }
    force drag: SpringDamper { joint: second, stiffness: 3.0, damping: 0.4, rest: 0.2 }
    force turned: Damper { joint: third, damping: 0.3 }
    force line: SpringDamper { between: [ground.at([0.4, 0.5, 1.0]), top.at([0.2, 0.1, 0.4])], stiffness: 40.0, damping: 2.0, length: 0.7 }
    force held: Torque { at: two, axes: one, value: [0.1, 0.2, twist] }
    output moved = [
        top.acceleration, top.angular_acceleration, arm.at([0.3, 0.0, 0.1]).acceleration, arm.angular_acceleration,
        two.acceleration, two.angular_acceleration, one.angular_acceleration, one.angular_velocity, top.velocity, arm.velocity,
        elbow.reaction.force, elbow.reaction.moment, third.reaction.force, third.reaction.moment,
        slide.reaction.force, slide.reaction.moment, linear_momentum(), angular_momentum(),
    ];
    output hinges = [first.rate, second.rate, third.rate, first.accel, second.accel, third.accel, elbow.accel, slide.accel];
    output energy = kinetic() + potential();
    output powers = [push.power, drag.power, turned.power, line.power];
    output rider = arm.jacobian;
    output at = arm.twist;
}, {
    let seen = top.rotated([1.0, -1.0, 2.0], 0.7);
    /// [rad/s]
    speed along = seen.express(top.angular_velocity - trolley.angular_velocity).x;
    /// [rad/s]
    speed across = seen.express(top.angular_velocity - trolley.angular_velocity).y;
    /// [rad/s]
    speed about = seen.express(top.angular_velocity - trolley.angular_velocity).z;
});

two_ways!(limb, limb_turning, {
    world { gravity: [0.1, 0.4, -9.8] }
    body hull { mass: 5.0, com: [0.1, 0.05, -0.1], inertia: inertia(0.5, 0.6, 0.7, 0.03, -0.02, 0.01) }
    body upper { mass: 1.5, com: [0.02, 0.01, 0.3], inertia: inertia(0.2, 0.21, 0.05, 0.003, 0.002, 0.001) }
    body fore { mass: 1.0, com: [0.01, 0.03, 0.2], inertia: inertia(0.1, 0.11, 0.03, 0.001, 0.002, -0.001) }
    joint base: Free { parent: ground.rotated(Y, 0.2), child: hull.rotated(X, 0.4), coordinates: RollPitchYaw }
    joint shoulder: Ball { parent: hull.at([0.3, 0.1, 0.2]).rotated(X, 1.1), child: upper.rotated(Z, 0.3), coordinates: RollPitchYaw }
    joint elbow: Ball { parent: upper.at([0.0, 0.1, 0.6]), child: fore, coordinates: RollPitchYaw }
    input twist;
    force bend: Torque { at: fore, axes: upper, value: [0.2, twist, 0.1] }
    force pull: SpringDamper { between: [hull.at([0.2, 0.0, 0.3]), fore.at([0.1, 0.0, 0.4])], stiffness: 30.0, damping: 1.0, length: 0.4 }
    output moved = [
        hull.acceleration, hull.angular_acceleration, upper.acceleration, upper.angular_acceleration, fore.acceleration,
        fore.angular_acceleration, shoulder.reaction.force, shoulder.reaction.moment, elbow.reaction.force, shoulder.angular_velocity,
        elbow.angular_velocity, base.angular_velocity, linear_momentum(),
    ];
    output hinges = [base.roll.rate, base.pitch.rate, base.yaw.rate, elbow.roll.rate, elbow.pitch.accel, elbow.yaw.accel, base.z.accel, base.roll.accel];
    output energy = kinetic() + potential();
    output rider = fore.jacobian;
    output at = fore.twist;
}, {
    let turned = hull.express(hull.angular_velocity);
    speed hull_x = turned.x;
    speed hull_y = turned.y;
    speed hull_z = turned.z;
    let bent = fore.express(fore.angular_velocity - upper.angular_velocity);
    speed fore_x = bent.x;
    speed fore_y = bent.y;
    speed fore_z = bent.z;
    let lifted = upper.express(upper.angular_velocity - hull.angular_velocity);
    speed upper_x = lifted.x;
    speed upper_y = lifted.y;
    speed upper_z = lifted.z;
});

macro_rules! same_motion {
    ($test:ident, $rates:ident, $chosen:ident, [$($field:ident),*]) => {
        #[test]
        fn $test() {
            let (rates, chosen) = ($rates::Model::<f64>::default(), $chosen::Model::<f64>::default());
            assert_eq!($rates::DOF, $chosen::DOF);
            let mut random = Random(7);
            for _ in 0..20 {
                let mut state = $rates::State::<f64>::default();
                state.q = state.q.displace(&random.vector::<$rates::Velocity>().map(&mut |x| 3.0 * x));
                state.v = random.vector();
                let mut other = $chosen::State::<f64>::default();
                $(other.q.$field = state.q.$field;)*
                let other = with_rates(&chosen, 0.0, &other, &flat(&state.v));
                let twist = random.next();
                let (input, same_input) = ($rates::Input { twist }, $chosen::Input { twist });
                let (out, same) = (rates.outputs(0.0, &state, &input), chosen.outputs(0.0, &other, &same_input));
                agree(&same.moved, &out.moved);
                for (one, other) in same.hinges.iter().zip(&out.hinges) {
                    assert!((one - other).abs() < 1e-9 * (1.0 + other.abs()), "{one} {other}");
                }
                assert!((out.energy - same.energy).abs() < 1e-11 * (1.0 + out.energy.abs()));
                let v = multibody::nalgebra::DVector::from_vec(flat(&other.v));
                let moved = same.rider * &v;
                assert!((moved.fixed_rows::<3>(0) - same.at.linear).amax() < 1e-11);
                assert!((moved.fixed_rows::<3>(3) - same.at.angular).amax() < 1e-11);
                derivatives_are_slopes(&chosen, 0.0, &other, &same_input);
            }
        }
    };
}

same_motion!(a_top_on_a_trolley, top, top_turning, [slide, first, second, third, elbow]);
same_motion!(a_limb_on_a_floating_hull, limb, limb_turning, [base, shoulder, elbow]);
