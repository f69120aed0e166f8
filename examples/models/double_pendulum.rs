//! A planar double pendulum, as `double_pendulum.rs` and the check of the firmware for panics use it.

use multibody::multibody;

multibody! {
    /// Planar double pendulum. Hinges turn about +z, gravity pulls along -y.
    pub(crate) mod double_pendulum {
        /// [m/s^2] a `const` becomes a literal
        const G = 9.81;
        /// [kg] a `param` stays a field of `Params`
        param m1 = 1.0;
        param m2 = 1.0;
        /// [m] rod lengths
        param l1 = 1.0;
        param l2 = 1.0;

        world { gravity: -G * Y }
        body upper { mass: m1, com: -0.5 * l1 * Y, inertia: rod(m1, l1, Y) }
        body lower { mass: m2, com: -0.5 * l2 * Y, inertia: rod(m2, l2, Y) }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-l1 * Y), child: lower, axis: Z }
        /// [N m] friction of the elbow
        let drag = -0.01 * elbow.rate;
        force friction: Effort { joint: elbow, value: drag }
        /// [J] what friction has turned into heat: a differential equation beside the mechanism's own
        state heat: rate = -drag * elbow.rate, start: 0.0;

        /// [m] tip in the world frame
        output tip: Vec3 = lower.at(-l2 * Y).position;
        output energy = kinetic() + potential();
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias; // outputs are always emitted
    }
}
