//! The benchmark bicycle, shared by the example and others.

use multibody::multibody;

multibody! {
    /// Whipple's bicycle with the parameters of Meijaard, Papadopoulos, Ruina and Schwab, Proc. R. Soc. A 463 (2007) 1955: x ahead, y
    /// to the right, z down. Both wheels are thin discs that roll on the road; what moves is the rear frame with the rider.
    pub mod bicycle {
        /// [m] wheel base
        const BASE: Scalar = 1.02;
        /// [m] trail
        const TRAIL = 0.08;
        /// [rad] of the steer axis
        const TILT = PI / 10;
        /// [m]
        const REAR = 0.3;
        /// [m]
        const FRONT = 0.35;
        world { gravity: 9.81 * Z }
        body ahead { mass: 0 }
        body aside { mass: 0 }
        body below { mass: 0 }
        body headed { mass: 0 }
        body leaning { mass: 0 }
        body frame { mass: 85, com: [0.3, 0, REAR - 0.9], inertia: inertia(9.2, 11, 2.8, 0, 2.4, 0) }
        body rear { mass: 2, inertia: diag(0.0603, 0.12, 0.0603) }
        body fork { mass: 4, com: [0.9 - BASE - TRAIL, 0, -0.7], inertia: inertia(0.05892, 0.06, 0.00708, 0, -0.00756, 0) }
        body front { mass: 3, inertia: diag(0.1405, 0.28, 0.1405) }
        joint x: Prismatic { parent: ground, child: ahead, axis: X }
        joint y: Prismatic { parent: ahead, child: aside, axis: Y }
        joint z: Prismatic { parent: aside, child: below, axis: Z }
        joint yaw: Revolute { parent: below, child: headed, axis: Z }
        joint roll: Revolute { parent: headed, child: leaning, axis: X }
        joint pitch: Revolute { parent: leaning, child: frame, axis: Y }
        joint spin_rear: Revolute { parent: frame, child: rear, axis: Y }
        joint steer: Revolute { parent: frame.at([BASE + TRAIL, 0, REAR]), child: fork, axis: [sin(TILT), 0, cos(TILT)] }
        joint spin_front: Revolute { parent: fork.at([-TRAIL, 0, -FRONT]), child: front, axis: Y }

        // A plane's z axis points to the side of the wheels.
        let road = ground.rotated(X, PI);
        constraint rear_wheel: Rolling { wheel: rear, axis: Y, radius: REAR, on: road }
        constraint front_wheel: Rolling { wheel: front, axis: Y, radius: FRONT, on: road }

        /// [N] sideways on the frame, at its saddle
        input push;
        force gust: Force { at: frame.at([0.0, 0.0, REAR - 1.0]), value: push * Y, axes: headed }

        output rear_slip = rear_wheel.slip;
        output front_slip = front_wheel.slip;
        output rear_track = rear_wheel.contact;
        output front_track = front_wheel.contact;
        output energy = kinetic() + potential();
        emit forward_dynamics, linearize;
    }
}
