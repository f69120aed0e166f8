//! Mechanisms for the edges of what numbers can do.

use multibody::multibody;

multibody! {
    /// A symmetric body that turns freely about its centre, as a quaternion.
    pub mod turning {
        /// [kg m^2] across the axis
        param a = 1.0;
        /// [kg m^2] about the axis
        param c = 1.6;
        body wheel { mass: 1.0, inertia: diag(a, a, c) }
        joint centre: Ball { parent: ground, child: wheel }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// The same, by roll, pitch and yaw.
    pub mod gimballed {
        /// [kg m^2] across the axis
        param a = 1.0;
        /// [kg m^2] about the axis
        param c = 1.6;
        body wheel { mass: 1.0, inertia: diag(a, a, c) }
        joint centre: Ball { parent: ground, child: wheel, coordinates: RollPitchYaw }
        output pose = wheel.pose;
        output spin = wheel.angular_velocity;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}
