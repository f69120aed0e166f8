//! Whipple's bicycle (Meijaard, Papadopoulos, Ruina and Schwab 2007), for the ledger alone: `runtime/tests/rolling` holds it against data.

use multibody::multibody;

multibody! {
    /// x ahead, y to the right, z down; all numbers are parameters.
    mod bicycle {
        port base: Frame;
        param w = 1.02;
        param c = 0.08;
        param tilt = PI / 10;
        param r_rear = 0.3;
        param r_front = 0.35;
        param m_frame = 85;
        param m_rear = 2;
        param m_fork = 4;
        param m_front = 3;
        param x_frame = 0.3;
        param z_frame = -0.9;
        param x_fork = 0.9;
        param z_fork = -0.7;
        param ixx_b = 9.2;
        param iyy_b = 11;
        param izz_b = 2.8;
        param ixz_b = 2.4;
        param ixx_r = 0.0603;
        param iyy_r = 0.12;
        param ixx_h = 0.05892;
        param iyy_h = 0.06;
        param izz_h = 0.00708;
        param ixz_h = -0.00756;
        param ixx_f = 0.1405;
        param iyy_f = 0.28;

        body ahead { mass: 0 }
        body aside { mass: 0 }
        body below { mass: 0 }
        body headed { mass: 0 }
        body leaning { mass: 0 }
        body frame { mass: m_frame, com: [x_frame, 0, z_frame + r_rear], inertia: inertia(ixx_b, iyy_b, izz_b, 0, ixz_b, 0) }
        body rear { mass: m_rear, inertia: diag(ixx_r, iyy_r, ixx_r) }
        body fork { mass: m_fork, com: [x_fork - w - c, 0, z_fork + r_front], inertia: inertia(ixx_h, iyy_h, izz_h, 0, ixz_h, 0) }
        body front { mass: m_front, inertia: diag(ixx_f, iyy_f, ixx_f) }
        joint x: Prismatic { parent: base, child: ahead, axis: X }
        joint y: Prismatic { parent: ahead, child: aside, axis: Y }
        joint z: Prismatic { parent: aside, child: below, axis: Z }
        joint yaw: Revolute { parent: below, child: headed, axis: Z }
        joint roll: Revolute { parent: headed, child: leaning, axis: X }
        joint pitch: Revolute { parent: leaning, child: frame, axis: Y }
        joint spin_rear: Revolute { parent: frame, child: rear, axis: Y }
        joint steer: Revolute { parent: frame.at([w + c, 0, r_rear]), child: fork, axis: [sin(tilt), 0, cos(tilt)] }
        joint spin_front: Revolute { parent: fork.at([-c, 0, -r_front]), child: front, axis: Y }
        input lean;
        input turn;
        input pedal;
        force on_roll: Effort { joint: roll, value: lean }
        force on_steer: Effort { joint: steer, value: turn }
        force on_rear: Effort { joint: spin_rear, value: pedal }
        let road = base.rotated(X, PI);
        constraint rear_tyre: Rolling { wheel: rear, axis: Y, radius: r_rear, on: road }
        constraint front_tyre: Rolling { wheel: front, axis: Y, radius: r_front, on: road }
    }
    /// Three speeds; the height in closed form, the pitch by an iteration.
    pub mod reduced {
        param g = 9.81;
        world { gravity: g * Z }
        part bike: bicycle { base: ground };
        formulation { constraints: Reduced, independent: [bike.roll, bike.steer, bike.spin_rear] }
        emit forward_dynamics, mass_matrix, bias, at { functions: [mass_matrix, bias] };
    }
    /// Nine rates and six multipliers.
    pub mod multipliers {
        param g = 9.81;
        world { gravity: g * Z }
        part bike: bicycle { base: ground };
        formulation { constraints: Multipliers }
        emit forward_dynamics;
    }
}
