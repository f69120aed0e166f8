//! A robot on two wheels.

use multibody::multibody;

multibody! {
    /// A body on two wheels beside each other, each with a motor.
    pub mod balancer {
        /// [m]
        const RADIUS = 0.05;
        /// [m] between the wheels
        const TRACK = 0.2;
        world { gravity: -9.81 * Z }
        body axle { mass: 0 }
        body body { mass: 1.2, com: 0.09 * Z, inertia: diag(0.006, 0.005, 0.003) }
        body left { mass: 0.06, inertia: diag(4e-5, 8e-5, 4e-5) }
        body right { mass: 0.06, inertia: diag(4e-5, 8e-5, 4e-5) }
        joint place: Planar { parent: ground.at(RADIUS * Z), child: axle, axis: Z }
        joint pitch: Revolute { parent: axle, child: body, axis: Y }
        joint left_motor: Revolute { parent: body.at(0.5 * TRACK * Y), child: left, axis: Y }
        joint right_motor: Revolute { parent: body.at(-0.5 * TRACK * Y), child: right, axis: Y }
        constraint left_wheel: Rolling { wheel: left, axis: Y, radius: RADIUS }
        constraint right_wheel: Rolling { wheel: right, axis: Y, radius: RADIUS }
        /// [N m] on both wheels
        input torque: [Scalar; 2];
        force left_torque: Effort { joint: left_motor, value: torque[0] }
        force right_torque: Effort { joint: right_motor, value: torque[1] }
        output slips = [left_wheel.slip, right_wheel.slip];
        output speed = axle.express(axle.velocity).x;
        emit forward_dynamics, linearize;
    }
}
