//! Between a motor and what it moves.

multibody::multibody! {
    /// A gear with losses and without inertia: the torque `n m` on the shaft, of which a share is lost on the way.
    ///
    /// The share that arrives is `efficiency` where the motor drives, and its inverse where the shaft drives the motor, with a smooth
    /// passage over the power `passage`: `n m e^tanh(P / P0)`. A motor of your own reads its speed from
    /// `gearbox.motor_rate`; `gear` has a body on the side of the motor.
    pub mod gearbox {
        /// [rad] what it turns
        port shaft: Joint;
        /// [N m] of the motor
        port torque: Scalar;
        /// of speeds, motor to shaft
        param ratio = 10.0;
        param efficiency = 0.9;
        /// [W] half of the passage between driving and being driven
        param passage = 0.1;
        /// [rad/s]
        let motor_rate = ratio * shaft.rate;
        /// [W] from the motor
        let power = torque * motor_rate;
        /// [N m] on the shaft
        let delivered = ratio * torque * powf(efficiency, tanh(power / passage));
        force drive: Effort { joint: shaft, value: delivered }
    }

    /// A gear without play or losses, with the rotor on its motor side: `rotor angle = n * shaft angle`.
    ///
    /// The rotor turns about the z axis of `housing`, whose body it burdens with its mass: give that body the rest. The mesh is a constraint
    /// of positions, which a reduced model solves.
    pub mod gear {
        /// where the rotor is held
        port housing: Frame;
        /// [rad] what it turns
        port shaft: Joint;
        /// of speeds, rotor to shaft
        param ratio = 10.0;
        /// [kg]
        param mass = 0.1;
        /// [kg m^2] about the axis of the rotor, and a half of it across
        param inertia = 1e-5;
        body rotor { mass: mass, inertia: diag(0.5 * inertia, 0.5 * inertia, inertia) }
        joint spin: Revolute { parent: housing, child: rotor, axis: Z }
        constraint mesh = spin - ratio * shaft;
    }

    /// A strain-wave gear: a spring between the motor's angle, divided by the ratio, and the shaft's, which hardens.
    ///
    /// The torque on the shaft is `k1 d + k3 d^3 + c d'`, `d = motor / n - shaft`, and minus an n-th of it acts on the motor.
    /// T. D. Tuttle and W. P. Seering, IEEE Transactions on Robotics and Automation 12, 1996, pages 368 to 374.
    pub mod harmonic_drive {
        /// [rad]
        port motor: Joint;
        /// [rad]
        port shaft: Joint;
        /// of speeds, motor to shaft
        param ratio = 100.0;
        /// [N m/rad]
        param stiffness = 8000.0;
        /// [N m/rad^3]
        param hardening = 0.0;
        /// [N m s/rad]
        param damping = 5.0;
        /// [rad]
        let wound = motor / ratio - shaft;
        /// [rad/s]
        let winding = motor.rate / ratio - shaft.rate;
        /// [N m] on the shaft
        let torque = stiffness * wound + hardening * wound * wound * wound + damping * winding;
        /// [J] in the spring
        let energy = 0.5 * stiffness * wound * wound + 0.25 * hardening * wound * wound * wound * wound;
        /// [W]
        let loss = damping * winding * winding;
        force on_shaft: Effort { joint: shaft, value: torque }
        force on_motor: Effort { joint: motor, value: -torque / ratio }
    }
}
