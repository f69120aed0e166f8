//! Models that are linearised with their outputs: accelerations, reactions, poses, own states, loops in each handling.

use multibody::multibody;

multibody! {
    /// A pole hinged to a cart. The cart slides along x, y points up, and the pole is upright at zero.
    pub mod cart_pole {
        /// [m/s^2]
        param g = 9.81;
        /// [kg]
        param cart_mass = 1.3;
        /// [kg]
        param pole_mass = 0.37;
        /// [m]
        param length = 0.83;
        /// [N]
        input push;
        world { gravity: -g * Y }
        body cart { mass: cart_mass }
        body pole { mass: pole_mass, com: 0.5 * length * Y, inertia: rod(pole_mass, length, Y) }
        joint track: Prismatic { parent: ground, child: cart, axis: X }
        joint hinge: Revolute { parent: cart, child: pole, axis: Z }
        force motor: Effort { joint: track, value: push }
        output tip: Vec3 = pole.at(length * Y).acceleration;
        output bearing: Vec3 = hinge.reaction.force;
        emit forward_dynamics, linearize;
    }
    /// A pendulum that balances on its end by a wheel; the motor has a current of its own.
    pub mod wheel_pendulum {
        /// [m/s^2]
        param g = 9.81;
        /// [V]
        input voltage;
        world { gravity: -g * Y }
        body bar { mass: 0.8, com: 0.11 * Y, inertia: diag(0.004, 0.001, 0.004) }
        body wheel { mass: 0.3, inertia: diag(0.0004, 0.0004, 0.0007) }
        joint foot: Revolute { parent: ground, child: bar, axis: Z }
        joint axle: Revolute { parent: bar.at(0.2 * Y), child: wheel, axis: Z }
        force motor: Effort { joint: axle, value: 0.05 * current - 0.0001 * axle.rate }
        force friction: Damper { joint: foot, damping: 0.002 }
        /// [A]
        state current: rate = (voltage - 1.2 * current - 0.05 * axle.rate) / 0.003, start: 0.0;
        output angle = foot.angle;
        output torque = 0.05 * current;
        output power = voltage * current;
        emit forward_dynamics, linearize;
    }
    /// A craft with a head on a ball, turned and pushed.
    pub mod craft {
        world { gravity: [0.3, -0.2, -9.81] }
        /// [N] along the axes of the hull
        input thrust: Vec3;
        input commands: [Scalar; 2];
        body hull { mass: 4.0, com: [0.1, -0.2, 0.05], inertia: inertia(0.8, 0.9, 1.1, 0.05, -0.03, 0.02) }
        body head { mass: 1.7, com: [0.0, 0.1, 0.3], inertia: diag(0.2, 0.15, 0.1) }
        joint float: Free { parent: ground, child: hull }
        joint neck: Ball { parent: hull.at([0.0, 0.3, 0.2]), child: head.at([0.0, 0.0, -0.1]) }
        joint arm: Revolute { parent: hull.at([0.3, 0.0, 0.0]).rotated(X, 0.7), child: tip, axis: [0.0, 0.6, 0.8] }
        body tip { mass: 0.4, com: 0.2 * X, inertia: diag(0.01, 0.03, 0.02) }
        force jet: Force { at: hull.at([0.0, 0.1, -0.2]), value: thrust, axes: hull }
        force twist: Torque { at: head, value: [commands[0], 0.2 * lag, 0.1], axes: hull }
        force drive: Effort { joint: arm, value: commands[1] - 0.3 * arm.rate }
        state lag: rate = 3.0 * (commands[1] - lag) + 0.2 * arm.rate * cos(arm.angle), start: 0.3;
        output hull_turn: Rotation = hull.rotation;
        output head_turn: Rotation = head.rotation;
        output seen: Pose = head.at([0.1, 0.2, 0.3]).pose;
        output felt: Vec3 = head.at([0.1, 0.2, 0.3]).acceleration;
        output load: Wrench = neck.reaction;
        emit forward_dynamics, linearize;
    }
}

/// One four-bar of skew lengths in each way to close it.
macro_rules! bars {
    ($name:ident { $($more:tt)* }) => {
        multibody! {
            pub mod $name {
                world { gravity: [1.0, -9.0, 0.0] }
                input torque;
                body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
                body link { mass: 3.5, com: [1.7, 0.2, 0.0], inertia: diag(0.1, 3.0, 3.1) }
                body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
                joint crank: Revolute { parent: ground, child: arm, axis: Z }
                joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
                joint rocker: Revolute { parent: ground.at(4.0 * X), child: lever, axis: Z }
                #[cut]
                joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
                force motor: Effort { joint: crank, value: torque }
                force spring: SpringDamper {
                    between: [link.at(2.0 * Y), ground], stiffness: 8.0, damping: 0.4, length: 0.5,
                }
                state lag: rate = torque - 2.0 * lag * rocker.rate, start: 0.0;
                output top: Vec3 = link.at(2.0 * Y).acceleration;
                output load: Vec3 = pin.reaction.force;
                output angle = rocker.angle;
                output turning = rocker.accel;
                emit forward_dynamics, linearize;
                $($more)*
            }
        }
    };
}

bars! { solved {
    formulation { constraints: Reduced }
    solve (coupler, rocker) from pin { sin(rocker.angle - crank.angle - coupler.angle) > 0.0 }
} }
bars! { iterated { formulation { constraints: Reduced, independent: [crank] } } }
bars! { held { formulation { constraints: Multipliers } } }
