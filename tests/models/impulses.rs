//! Mechanisms that answer to impulses, and that are written in momenta.

use multibody::multibody;

multibody! {
    /// Joints of all kinds that have momenta, with springs, dampers and efforts.
    pub mod tree {
        /// [kg]
        param m = 0.7;
        /// [m]
        param reach: Vec3 = [0.2, -0.3, 0.25];
        /// [N m] or [N]
        input push: [Scalar; 3];
        world { gravity: [0.3, -0.2, -9.7] }
        body cart { mass: 2.0, com: [0.05, 0.0, 0.02], inertia: cuboid(2.0, [0.4, 0.3, 0.1]) }
        body arm { mass: m, com: 0.5 * reach, inertia: inertia(0.02, 0.03, 0.025, 0.001, -0.002, 0.003) }
        body slide { mass: m, com: [0.0, 0.1, 0.0], inertia: cylinder(m, 0.05, 0.3, Y) }
        body screw { mass: 0.3, com: [0.01, 0.0, 0.0], inertia: sphere(0.3, 0.08) }
        body drum { mass: 0.4, inertia: diag(0.01, 0.02, 0.015) }
        body gimbal { mass: 0.5, com: 0.3 * X, inertia: diag(0.01, 0.012, 0.013) }
        body plate { mass: 0.2, com: [0.02, 0.03, 0.0], inertia: diag(0.001, 0.001, 0.002) }
        body kite { mass: 0.4, com: [0.1, 0.0, 0.05], inertia: diag(0.01, 0.02, 0.03) }
        joint floor: Planar { parent: ground.at([0.0, 0.0, 0.1]).rotated(X, 0.2), child: cart, axis: Z }
        joint shoulder: Revolute {
            parent: cart.at([0.1, 0.0, 0.2]).rotated(Y, 0.4), child: arm.at([0.02, 0.0, 0.0]), axis: [1.0, 2.0, -0.5],
            armature: 0.01,
        }
        joint rail: Prismatic { parent: arm.at(reach), child: slide.rotated(Z, -0.3), axis: [0.0, 1.0, 1.0] }
        joint thread: Screw { parent: cart.at(-0.2 * X), child: screw, axis: -Z, pitch: 0.03 }
        joint sleeve: Cylindrical { parent: screw.at(0.1 * Z), child: drum, axis: Y }
        joint neck: Universal { parent: slide.at(0.2 * Y), child: gimbal, axes: [X, Y] }
        joint wrist: Ball { parent: arm.at(0.5 * reach), child: plate, coordinates: RollPitchYaw }
        joint flight: Free { parent: ground, child: kite.at(0.1 * Z), coordinates: RollPitchYaw }
        force drive: Effort { joint: shoulder, value: push[0] - 0.1 * t }
        force lift: Effort { joint: rail, value: push[1] }
        force turn: Effort { joint: thread, value: push[2] }
        force stay: SpringDamper { joint: shoulder, stiffness: 20.0, damping: 0.3, rest: 0.3 }
        force rope: SpringDamper {
            between: [plate.at(0.1 * X), ground.at(Z)], stiffness: 20.0, damping: 0.2, length: 0.2,
        }
        force wind: Force { at: kite.at(0.2 * X), value: [0.2, -0.1 * flight.y.rate, 0.3], axes: kite }
        emit forward_dynamics, mass_matrix, bias, energy, impulse, momentum;
    }
    /// Two rods that keep their energy.
    pub mod rods {
        world { gravity: -9.81 * Y }
        body upper { mass: 1.0, com: -0.5 * Y, inertia: rod(1.0, 1.0, Y) }
        body lower { mass: 1.5, com: -0.4 * Y, inertia: rod(1.5, 0.8, Y) }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-Y), child: lower, axis: Z }
        emit forward_dynamics, mass_matrix, energy, momentum;
    }
    /// Three rods in space.
    pub mod crane {
        param m = 1.0;
        param l = 0.8;
        world { gravity: -9.81 * Z }
        body mast { mass: 2.0, inertia: diag(0.1, 0.1, 0.2) }
        body boom { mass: m, com: 0.5 * l * X, inertia: rod(m, l, X) }
        body jib { mass: 0.5, com: 0.3 * X, inertia: rod(0.5, 0.6, X) }
        joint slew: Revolute { parent: ground, child: mast, axis: Z }
        joint luff: Revolute { parent: mast.at(0.1 * X), child: boom, axis: Y }
        joint fold: Revolute { parent: boom.at(l * X), child: jib, axis: Y }
        emit forward_dynamics, mass_matrix, bias, impulse, momentum;
    }
    /// With quaternions there are impulses, and no momenta.
    pub mod floating {
        body hull { mass: 2.0, com: [0.1, 0.0, -0.05], inertia: diag(0.4, 0.5, 0.6) }
        body arm { mass: 1.0, com: 0.5 * X, inertia: diag(0.01, 0.1, 0.1) }
        body hook { mass: 0.5, com: 0.2 * Z, inertia: diag(0.01, 0.01, 0.01) }
        joint free: Free { parent: ground, child: hull }
        joint hinge: Revolute { parent: hull.at(0.3 * X), child: arm, axis: Z }
        joint eye: Ball { parent: arm.at(X), child: hook }
        emit forward_dynamics, mass_matrix, impulse;
    }
}

multibody! {
    /// A four-bar with one coordinate, whose lever is braked.
    pub mod four_bar {
        world { gravity: -9.81 * Y }
        formulation { constraints: Reduced }
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body link { mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) }
        body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
        joint rocker: Revolute { parent: ground.at(4.0 * X), child: lever, axis: Z }
        #[cut]
        joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
        solve (coupler, rocker) from pin { sin(rocker.angle - crank.angle - coupler.angle) > 0.0 }
        force brake: Damper { joint: rocker, damping: 0.4 }
        emit forward_dynamics, mass_matrix, bias, impulse, momentum;
    }
    /// The same on a car, with a pendulum at its lever, without losses.
    pub mod carried {
        world { gravity: -9.81 * Y }
        formulation { constraints: Reduced, independent: [track, crank, hang] }
        body car { mass: 5.0 }
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body link { mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) }
        body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
        body bob { mass: 0.6, com: -0.7 * Y }
        joint track: Prismatic { parent: ground, child: car, axis: X }
        joint crank: Revolute { parent: car, child: arm, axis: Z }
        joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
        joint rocker: Revolute { parent: car.at(4.0 * X), child: lever, axis: Z }
        #[cut]
        joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
        solve (coupler, rocker) from pin { sin(rocker.angle - crank.angle - coupler.angle) > 0.0 }
        joint hang: Revolute { parent: lever.at(3.0 * X), child: bob, axis: Z }
        force spring: Spring { joint: track, stiffness: 30.0 }
        emit forward_dynamics, mass_matrix, energy, momentum;
    }
    /// A gear and a rack, coupled by what is linear.
    pub mod geared {
        param ratio = 3.0;
        world { gravity: -9.81 * Y }
        formulation { constraints: Reduced }
        body wheel { mass: 2.0, com: 0.1 * X, inertia: diag(0.1, 0.1, 0.2) }
        body pinion { mass: 0.5, inertia: diag(0.01, 0.01, 0.02) }
        body rack { mass: 1.0 }
        body bob { mass: 0.3, com: -0.5 * Y, inertia: rod(0.3, 1.0, Y) }
        joint a: Revolute { parent: ground, child: wheel, axis: Z }
        joint b: Revolute { parent: ground.at(X), child: pinion, axis: Z }
        joint slide: Prismatic { parent: ground, child: rack, axis: Y }
        joint hang: Revolute { parent: rack, child: bob, axis: Z }
        constraint mesh = ratio * b.angle + a.angle;
        constraint teeth = b.angle * 0.2 - slide.travel + 0.05;
        emit forward_dynamics, mass_matrix, bias, impulse, momentum;
    }
    /// The crank turns by a drive: what hangs on it answers to impulses at a time.
    pub mod turning {
        world { gravity: -9.81 * Y }
        formulation { constraints: Reduced }
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body ring { mass: 0.6, inertia: diag(0.1, 0.1, 0.1) }
        body bob { mass: 0.5, com: -0.6 * Y, inertia: rod(0.5, 1.2, Y) }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint slide: Prismatic { parent: ground.at(Y), child: ring, axis: X }
        joint hang: Revolute { parent: ring, child: bob, axis: Z }
        constraint rail = slide.travel - 0.3 * crank.angle * sin(hang.angle);
        drive crank.angle = 1.0 + 2.0 * t;
        solve (slide) = (0.3 * crank.angle * sin(hang.angle));
        emit forward_dynamics, mass_matrix, impulse;
    }
}

multibody! {
    /// A four-bar that can be stretched: both its bars and its ground have length one.
    pub mod stretched {
        world { gravity: -9.81 * Y }
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body link { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body lever { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
        joint rocker: Revolute { parent: ground.at(X), child: lever, axis: Z }
        #[cut]
        joint pin: Revolute { parent: link.at(X), child: lever.at(X), axis: Z }
        emit forward_dynamics, mass_matrix, constraints, impulse;
    }
    /// Two free rods that hang on each other and on the ground, and a plate on a ball: their idle spins are held by nothing
    /// but the equations.
    pub mod hung {
        formulation { constraints: Multipliers }
        world { gravity: -9.81 * Z }
        body first { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X), coordinates: Absolute(RollPitchYaw) }
        body second { mass: 0.7, com: [0.3, 0.1, 0.0], inertia: diag(0.02, 0.03, 0.04), coordinates: Absolute(Quaternion) }
        body plate { mass: 0.5, com: 0.1 * Z, inertia: diag(0.01, 0.01, 0.02) }
        joint top: Universal { parent: ground, child: first, axes: [Y, X] }
        joint middle: Revolute { parent: first.at(X), child: second, axis: [0.0, 1.0, 1.0] }
        joint eye: Ball { parent: second.at(0.4 * X), child: plate, coordinates: RollPitchYaw }
        constraint swing: Rod { between: [plate.at(0.2 * Z), ground.at([1.0, 1.0, -1.0])], length: 1.3 }
        emit forward_dynamics, mass_matrix, constraints, impulse;
    }
    /// A constraint that moves in time.
    pub mod shaken {
        formulation { constraints: Multipliers }
        world { gravity: -9.81 * Y }
        body cart { mass: 1.3 }
        body bob { mass: 0.8, com: 0.3 * X, inertia: rod(0.8, 0.6, X) }
        joint rail: Prismatic { parent: ground, child: cart, axis: X }
        joint crank: Revolute { parent: ground, child: bob, axis: Z }
        constraint follow = rail.travel - cos(crank.angle) * cos(2.0 * crank.angle + 3.0 * t);
        emit forward_dynamics, mass_matrix, constraints, impulse;
    }
}

multibody! {
    /// A round body that flies: nothing couples its turning to its rate.
    pub mod ball {
        world { gravity: -9.81 * Z }
        body ball { mass: 2.0, inertia: sphere(2.0, 0.1) }
        joint free: Free { parent: ground, child: ball }
    }
    /// A pendulum that is damped.
    pub mod damped {
        world { gravity: -9.81 * Y }
        body bob { mass: 1.0, com: -Y }
        joint hinge: Revolute { parent: ground, child: bob, axis: Z }
        force loss: Damper { joint: hinge, damping: 0.1 }
    }
    /// A pendulum with a motor that has a state.
    pub mod lagging {
        world { gravity: -9.81 * Y }
        body bob { mass: 1.0, com: -Y }
        joint hinge: Revolute { parent: ground, child: bob, axis: Z }
        state torque: rate = -torque, start: 1.0;
        force motor: Effort { joint: hinge, value: torque }
    }
}
