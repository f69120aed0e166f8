//! Whipple's bicycle, for whoever wants it in some formulation.

/// Whipple's bicycle: x ahead, y to the right, z down; wheels that roll without slip on the plane z = 0.
macro_rules! bicycle {
    ($name:ident, { $($more:tt)* }) => {
        multibody! {
            pub(crate) mod $name {
                const W = 1.02;
                const C = 0.08;
                const TILT = PI / 10;
                const REAR = 0.3;
                const FRONT = 0.35;
                world { gravity: 9.81 * Z }
                body ahead { mass: 0 }
                body aside { mass: 0 }
                body below { mass: 0 }
                body headed { mass: 0 }
                body leaning { mass: 0 }
                body frame { mass: 85, com: [0.3, 0, -0.9 + REAR], inertia: inertia(9.2, 11, 2.8, 0, 2.4, 0) }
                body rear { mass: 2, inertia: diag(0.0603, 0.12, 0.0603) }
                body fork { mass: 4, com: [0.9 - W - C, 0, -0.7], inertia: inertia(0.05892, 0.06, 0.00708, 0, -0.00756, 0) }
                body front { mass: 3, inertia: diag(0.1405, 0.28, 0.1405) }
                joint x: Prismatic { parent: ground, child: ahead, axis: X }
                joint y: Prismatic { parent: ahead, child: aside, axis: Y }
                joint z: Prismatic { parent: aside, child: below, axis: Z }
                joint yaw: Revolute { parent: below, child: headed, axis: Z }
                joint roll: Revolute { parent: headed, child: leaning, axis: X }
                joint pitch: Revolute { parent: leaning, child: frame, axis: Y }
                joint spin_rear: Revolute { parent: frame, child: rear, axis: Y }
                joint steer: Revolute { parent: frame.at([W + C, 0, REAR]), child: fork, axis: [sin(TILT), 0, cos(TILT)] }
                joint spin_front: Revolute { parent: fork.at([-C, 0, -FRONT]), child: front, axis: Y }
                input lean;
                input turn;
                input pedal;
                force on_roll: Effort { joint: roll, value: lean }
                force on_steer: Effort { joint: steer, value: turn }
                force on_rear: Effort { joint: spin_rear, value: pedal }

                // The plane's z axis points to the side of the wheels.
                let road = ground.rotated(X, PI);
                constraint rear_tyre: Rolling { wheel: rear, axis: Y, radius: REAR, on: road }
                constraint front_tyre: Rolling { wheel: front, axis: Y, radius: FRONT, on: road }
                output rear_force = rear_tyre.force;
                output front_force = front_tyre.force;
                output contacts = [rear_tyre.contact, front_tyre.contact];
                output slips = [rear_tyre.slip, front_tyre.slip];
                output energy = kinetic() + potential();
                $($more)*
            }
        }
    };
}
