//! Rotors in air.

multibody::multibody! {
    /// A rotor that pushes along the z axis of its frame: thrust `t w |w|`, and the torque `-d w |w|` of its drag on what holds it.
    ///
    /// The speed is positive about z; a rotor that turns the other way has a negative one, and pushes along z if its `thrust`
    /// is negative. What stirs the air about a flapping rotor is left out. R. Mahony, V. Kumar and P. Corke, IEEE Robotics and Automation
    /// Magazine 19, 2012, pages 20 to 32.
    pub mod rotor {
        port hub: Frame;
        /// [rad/s]
        port speed: Scalar;
        /// [N s^2]
        param thrust = 1e-5;
        /// [N m s^2]
        param drag = 1.5e-7;
        let square = speed * abs(speed);
        /// [N]
        let push = thrust * square;
        /// [W] into what holds it
        let power = push * hub.express(hub.velocity).z - drag * square * hub.express(hub.angular_velocity).z;
        force lift: Force { at: hub, value: [0.0, 0.0, push], axes: hub }
        force resistance: Torque { at: hub, value: [0.0, 0.0, -drag * square], axes: hub }
    }
}
