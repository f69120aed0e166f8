//! What strikes, slides and shakes, as `impacts.rs` and the check of the firmware for panics use it.

use multibody::multibody;

multibody! {
    /// A rod that falls against a wall under its pivot.
    pub(crate) mod pendulum {
        world { gravity: -9.81 * Y }
        body rod { mass: 2.0, com: -0.5 * Y, inertia: rod(2.0, 1.0, Y) }
        joint hinge: Revolute { parent: ground, child: rod, axis: Z }
        output energy = kinetic() + potential();
        emit forward_dynamics, impulse;
    }
    /// A block on a table; below `SLOW` its friction fades.
    pub(crate) mod block {
        /// friction
        const MU = 0.3;
        /// [m/s]
        const SLOW = 0.01;
        /// [kg]
        const MASS = 1.5;
        body block { mass: MASS }
        joint slide: Prismatic { parent: ground, child: block, axis: X }
        force friction: Effort { joint: slide, value: -MU * MASS * 9.81 * tanh(slide.rate / SLOW) }
        emit forward_dynamics;
    }
    /// An engine on its mount: six springs with their dampers, each of its own.
    pub(crate) mod mount {
        /// [N/m]
        const K = [4e4, 4e4, 9e4];
        /// [N s/m]
        const C = [200.0, 200.0, 450.0];
        /// [N m/rad]
        const KT = [300.0, 250.0, 120.0];
        /// [N m s/rad]
        const CT = [1.5, 1.0, 0.6];
        body engine { mass: 40.0, inertia: diag(1.2, 1.0, 0.8) }
        joint free: Free { parent: ground, child: engine, coordinates: RollPitchYaw }
        force shift: Force {
            at: engine, axes: ground,
            value: [
                -K[0] * free.x - C[0] * free.x.rate, -K[1] * free.y - C[1] * free.y.rate, -K[2] * free.z - C[2] * free.z.rate,
            ],
        }
        force turn: Torque {
            at: engine, axes: ground,
            value: [
                -KT[0] * free.roll - CT[0] * free.roll.rate, -KT[1] * free.pitch - CT[1] * free.pitch.rate,
                -KT[2] * free.yaw - CT[2] * free.yaw.rate,
            ],
        }
        emit forward_dynamics;
    }
}
