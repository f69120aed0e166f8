//! Mechanisms of the reference problems in `data/motion`.

use multibody::multibody;

multibody! {
    /// Two point masses on massless rods. Hinges turn about +z, gravity pulls along -y.
    pub mod two_masses {
        /// [m/s^2] gravity
        param g = 9.81;
        /// [kg] upper mass
        param m1 = 1.0;
        /// [kg] lower mass
        param m2 = 1.0;
        /// [m] upper rod
        param l1 = 1.0;
        /// [m] lower rod
        param l2 = 1.0;
        world { gravity: -g * Y }
        body upper { mass: m1, com: -l1 * Y }
        body lower { mass: m2, com: -l2 * Y }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-l1 * Y), child: lower, axis: Z }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// Ten uniform rods in a row. Hinges turn about +z, gravity pulls along -y.
    pub mod chain {
        /// [m/s^2] gravity
        param g = 9.81;
        /// [kg] mass of a rod
        param m = 1.0;
        /// [m] length of a rod
        param l = 1.0;
        world { gravity: -g * Y }
        body rod1 { mass: m, com: -0.5 * l * Y, inertia: rod(m, l, Y) }
        joint hinge1: Revolute { parent: ground, child: rod1, axis: Z }
        body rod2 { mass: m, com: -0.5 * l * Y, inertia: rod(m, l, Y) }
        joint hinge2: Revolute { parent: rod1.at(-l * Y), child: rod2, axis: Z }
        body rod3 { mass: m, com: -0.5 * l * Y, inertia: rod(m, l, Y) }
        joint hinge3: Revolute { parent: rod2.at(-l * Y), child: rod3, axis: Z }
        body rod4 { mass: m, com: -0.5 * l * Y, inertia: rod(m, l, Y) }
        joint hinge4: Revolute { parent: rod3.at(-l * Y), child: rod4, axis: Z }
        body rod5 { mass: m, com: -0.5 * l * Y, inertia: rod(m, l, Y) }
        joint hinge5: Revolute { parent: rod4.at(-l * Y), child: rod5, axis: Z }
        body rod6 { mass: m, com: -0.5 * l * Y, inertia: rod(m, l, Y) }
        joint hinge6: Revolute { parent: rod5.at(-l * Y), child: rod6, axis: Z }
        body rod7 { mass: m, com: -0.5 * l * Y, inertia: rod(m, l, Y) }
        joint hinge7: Revolute { parent: rod6.at(-l * Y), child: rod7, axis: Z }
        body rod8 { mass: m, com: -0.5 * l * Y, inertia: rod(m, l, Y) }
        joint hinge8: Revolute { parent: rod7.at(-l * Y), child: rod8, axis: Z }
        body rod9 { mass: m, com: -0.5 * l * Y, inertia: rod(m, l, Y) }
        joint hinge9: Revolute { parent: rod8.at(-l * Y), child: rod9, axis: Z }
        body rod10 { mass: m, com: -0.5 * l * Y, inertia: rod(m, l, Y) }
        joint hinge10: Revolute { parent: rod9.at(-l * Y), child: rod10, axis: Z }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// A spherical pendulum as a rigid body on a ball joint.
    pub mod pendulum_on_ball {
        /// [m/s^2] gravity
        param g = 9.81;
        /// [kg] mass: the moment about the support is that of one kilogram at one metre
        param m = 1.0 / 0.9;
        /// [m] from the support to the centre of mass
        param l = 0.9;
        /// [kg m^2] about the centre of mass
        param i = 0.1;
        world { gravity: -g * Z }
        body bob { mass: m, com: -l * Z, inertia: diag(i, i, i) }
        joint support: Ball { parent: ground, child: bob }
        /// [m] one metre below the support
        output tip = bob.at(-Z).position;
        /// [m/s] of the tip
        output velocity = bob.at(-Z).velocity;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// A spherical pendulum as a point mass on a universal joint.
    pub mod pendulum_on_universal {
        /// [m/s^2] gravity
        param g = 9.81;
        /// [kg] mass
        param m = 1.0;
        /// [m] length
        param l = 1.0;
        world { gravity: -g * Z }
        body bob { mass: m, com: -l * Z }
        joint support: Universal { parent: ground, child: bob, axes: [X, Y] }
        /// [m] the mass
        output tip = bob.at(-l * Z).position;
        /// [m/s] of the mass
        output velocity = bob.at(-l * Z).velocity;
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// A heavy symmetric top on a fixed point.
    pub mod top {
        /// [m/s^2] gravity
        param g = 9.81;
        /// [kg] mass
        param m = 1.0;
        /// [m] from the point to the centre of mass
        param l = 0.1;
        /// [kg m^2] across the axis, about the centre of mass
        param a = 0.05;
        /// [kg m^2] about the axis
        param c = 0.01;
        world { gravity: -g * Z }
        body top { mass: m, com: l * Z, inertia: diag(a, a, c) }
        joint point: Ball { parent: ground, child: top }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}

multibody! {
    /// A free rigid body, no gravity.
    pub mod free_body {
        /// [kg] mass
        param m = 1.0;
        /// [kg m^2] principal moments
        param i = [1.0, 2.0, 3.0];
        body nut { mass: m, inertia: diag(i[0], i[1], i[2]) }
        joint free: Free { parent: ground, child: nut }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
}
