//! A snakeboard.

use multibody::multibody;

multibody! {
    /// A board on two trucks that are steered against each other; its rider swings from side to side. Nothing pushes against the ground.
    pub mod snakeboard {
        /// [m] from the middle to a truck
        const HALF = 0.3;
        body board { mass: 5.0, inertia: diag(0.2, 0.2, 0.2) }
        body rider { mass: 60.0, inertia: diag(1.2, 1.2, 2.0) }
        body front { mass: 1.0, inertia: diag(0.01, 0.01, 0.01) }
        body back { mass: 1.0, inertia: diag(0.01, 0.01, 0.01) }
        joint place: Planar { parent: ground, child: board, axis: Z }
        joint swing: Revolute { parent: board, child: rider, axis: Z }
        joint steer: Revolute { parent: board.at(HALF * X), child: front, axis: Z }
        joint mirror: Revolute { parent: board.at(-HALF * X), child: back, axis: Z }
        constraint alike = steer + mirror;
        constraint front_wheels: Skate { blade: front, along: X }
        constraint back_wheels: Skate { blade: back, along: X }
        /// [N m]
        input twist;
        /// [N m]
        input turn;
        force hips: Effort { joint: swing, value: twist }
        force feet: Effort { joint: steer, value: turn }
        output energy = kinetic();
        output slips = [front_wheels.slip, back_wheels.slip];
        emit forward_dynamics;
    }
}
