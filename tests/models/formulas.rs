//! Formulas of one model in another.

use multibody::multibody;

multibody! {
    /// One leg on the ground, under a pin that is anywhere.
    pub mod single_leg {
        formulation { constraints: Reduced }
        /// [m] of the retracted leg
        param length = 1.0;
        body pin { mass: 1.0, inertia: diag(1.0, 1.0, 1.0), coordinates: Absolute(RollPitchYaw) }
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        joint gimbal: Universal { parent: ground, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(length * Z), child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: pin }
        solve (gimbal, stroke) from ball { stroke > -length, cos(gimbal.second) > 0.0 }
    }
    /// A leg whose joints follow from what the single leg says.
    mod told_leg {
        port base: Frame;
        port tip: Frame;
        input thrust;
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(0.9 * Z), child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        force actuator: Effort { joint: stroke, value: thrust }
        let way = base.express(tip.position - base.position);
        let found = single_leg(
            [gimbal.first, gimbal.second, stroke], pin.x = way.x, pin.y = way.y, pin.z = way.z, length = 0.9,
        );
        solve (gimbal, stroke) = (found[0], found[1], found[2]);
    }
    /// A leg whose joints are solved where they are.
    mod solved_leg {
        port base: Frame;
        port tip: Frame;
        input thrust;
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        joint gimbal: Universal { parent: base, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder.at(0.9 * Z), child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        force actuator: Effort { joint: stroke, value: thrust }
        solve (gimbal, stroke) from ball { stroke > -0.9, cos(gimbal.second) > 0.0 }
    }
    /// Legs that stand askew, by formulas of the single leg.
    pub mod told_platform {
        const FEET: [Vec3; 6] = [
            [-2.12, 1.374, 0.0], [-2.38, 1.224, 0.0], [-2.38, -1.224, 0.0],
            [-2.12, -1.374, 0.0], [0.0, -0.15, 0.0], [0.0, 0.15, 0.0],
        ];
        const PINS: [Vec3; 6] = [
            [0.17, 0.595, -0.4], [-0.6, 0.15, -0.4], [-0.6, -0.15, -0.4],
            [0.17, -0.595, -0.4], [0.43, -0.445, -0.4], [0.43, 0.445, -0.4],
        ];
        const HEADING: [Scalar; 6] = [-0.75, -0.55, 0.55, 0.75, -2.85, 2.85];
        world { gravity: -9.80665 * Z }
        formulation { constraints: Reduced }
        body platform {
            mass: 1.5, com: [0.02, -0.01, 0.03], inertia: diag(0.08, 0.09, 0.1), coordinates: Absolute(RollPitchYaw),
        }
        part legs: [told_leg; 6] = |i| told_leg {
            base: ground.at(FEET[i]).rotated(Z, HEADING[i]).rotated([1.0, 2.0, -0.5], 0.2), tip: platform.at(PINS[i]),
        };
        emit forward_dynamics, inverse_dynamics { solve_for: legs.thrust };
    }
    /// The same, solved where the legs are.
    pub mod solved_platform {
        const FEET: [Vec3; 6] = [
            [-2.12, 1.374, 0.0], [-2.38, 1.224, 0.0], [-2.38, -1.224, 0.0],
            [-2.12, -1.374, 0.0], [0.0, -0.15, 0.0], [0.0, 0.15, 0.0],
        ];
        const PINS: [Vec3; 6] = [
            [0.17, 0.595, -0.4], [-0.6, 0.15, -0.4], [-0.6, -0.15, -0.4],
            [0.17, -0.595, -0.4], [0.43, -0.445, -0.4], [0.43, 0.445, -0.4],
        ];
        const HEADING: [Scalar; 6] = [-0.75, -0.55, 0.55, 0.75, -2.85, 2.85];
        world { gravity: -9.80665 * Z }
        formulation { constraints: Reduced }
        body platform {
            mass: 1.5, com: [0.02, -0.01, 0.03], inertia: diag(0.08, 0.09, 0.1), coordinates: Absolute(RollPitchYaw),
        }
        part legs: [solved_leg; 6] = |i| solved_leg {
            base: ground.at(FEET[i]).rotated(Z, HEADING[i]).rotated([1.0, 2.0, -0.5], 0.2), tip: platform.at(PINS[i]),
        };
        emit forward_dynamics, inverse_dynamics { solve_for: legs.thrust };
    }
}

multibody! {
    /// A slider-crank whose rail lies askew.
    pub mod slider {
        formulation { constraints: Reduced }
        param arm = 0.3;
        param rod = [0.8, 0.1, 0.0];
        body crank { mass: 1.0, inertia: diag(0.1, 0.1, 0.1) }
        body link { mass: 0.5, com: 0.5 * rod, inertia: diag(0.1, 0.2, 0.3) }
        body piston { mass: 0.7, inertia: diag(0.1, 0.1, 0.1) }
        joint turn: Revolute { parent: ground, child: crank, axis: Z }
        joint hinge: Revolute { parent: crank.at(arm * X), child: link, axis: Z }
        joint rail: Prismatic { parent: ground.at(0.05 * Y).rotated(Z, 0.1), child: piston, axis: X }
        #[cut]
        joint pin: Revolute { parent: link.at(rod), child: piston, axis: Z }
        solve (hinge, rail) from pin { rail > 0.3 }
        /// Twice where the piston is.
        output doubled = 2.0 * rail.travel;
        emit forward_dynamics, kinematics { given: [turn], find: [rail] };
    }
    /// What the slider says, moved and shown again.
    pub mod twice {
        body cart { mass: 1.0 }
        input u;
        joint j: Prismatic { parent: ground, child: cart, axis: Y }
        let seen = slider([doubled, norm(piston.position), rail.rate], turn = j * u, turn.rate = 0.5, arm = 0.31);
        output travel = seen[0] / 2.0;
        output rate = seen[2];
        output far = seen[1];
        emit forward_dynamics;
    }
    /// A cart on a belt that follows the slider, with a pendulum.
    pub mod follower {
        world { gravity: -9.81 * Y }
        param speed = 1.3;
        body cart { mass: 1.0 }
        body bob { mass: 0.4, com: -0.6 * Y, inertia: diag(0.01, 0.01, 0.02) }
        joint belt: Prismatic { parent: ground, child: cart, axis: X }
        joint swing: Revolute { parent: cart, child: bob, axis: Z }
        drive belt = slider(rail, turn = speed * t, rod = [0.7, 0.05 * speed, 0.0]);
        output place = belt.travel;
        output rate = belt.rate;
        output accel = belt.accel;
        /// A formula of a formula, at another place.
        output seen = twice(travel, j = swing, u = speed);
        emit forward_dynamics;
    }
}

multibody! {
    /// What a controller knows of an arm.
    pub mod known_arm {
        world { gravity: [0.0, 0.0, -9.81] }
        param load = 0.5;
        body lower { mass: 1.0, com: [0.2, 0.01, 0.0], inertia: rod(1.0, 0.4, X) }
        body upper { mass: 0.6, com: 0.2 * X, inertia: rod(0.6, 0.4, X) }
        body held { mass: load, inertia: sphere(load, 0.05) }
        joint base: Revolute { parent: ground.rotated([1.0, 1.0, 0.0], 0.3), child: lower, axis: Y }
        joint elbow: Revolute { parent: lower.at(0.4 * X), child: upper, axis: [0.0, 1.0, 0.2] }
        joint grip: Fixed { parent: upper.at(0.4 * X), child: held }
    }
    /// The arm under that controller: gravity is compensated, and the rest made that of its inertia at the pose where all is zero.
    pub mod controlled_arm {
        world { gravity: [0.0, 0.0, -9.81] }
        input push: [Scalar; 2];
        param load = 0.5;
        body lower { mass: 1.0, com: [0.2, 0.01, 0.0], inertia: rod(1.0, 0.4, X) }
        body upper { mass: 0.6, com: 0.2 * X, inertia: rod(0.6, 0.4, X) }
        body held { mass: load, inertia: sphere(load, 0.05) }
        joint base: Revolute { parent: ground.rotated([1.0, 1.0, 0.0], 0.3), child: lower, axis: Y }
        joint elbow: Revolute { parent: lower.at(0.4 * X), child: upper, axis: [0.0, 1.0, 0.2] }
        joint grip: Fixed { parent: upper.at(0.4 * X), child: held }
        let weights = known_arm([diff(potential(), base), diff(potential(), elbow)], base = base, elbow = elbow, load = load);
        force hold: Effort { joint: base, value: weights[0] + push[0] }
        force hold_elbow: Effort { joint: elbow, value: weights[1] + push[1] }
        output energy_known = known_arm(kinetic(), base = base, elbow = elbow, base.rate = base.rate, elbow.rate = elbow.rate);
        output energy = kinetic();
        output inertia_known = known_arm(mass_matrix[base, elbow], elbow = elbow);
        output inertia = mass_matrix[base, elbow];
        emit forward_dynamics;
    }
}

multibody! {
    /// A screw geared to an oblique hinge, and a rod in it that follows the time.
    pub mod gears {
        formulation { constraints: Reduced }
        param ratio = 2.0;
        input u: Vec3;
        body a { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
        body b { mass: 1.0, com: [0.1, 0.2, 0.3], inertia: diag(1.0, 1.0, 1.0) }
        body c { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
        joint ja: Revolute { parent: ground.rotated([1.0, 2.0, 3.0], 0.4), child: a, axis: [0.3, 0.1, 1.0] }
        joint jb: Screw { parent: a.at([0.1, 0.2, 0.3]), child: b, axis: [1.0, 1.0, 0.0], pitch: 0.1 }
        joint jc: Cylindrical { parent: b, child: c.at(0.2 * X), axis: Y }
        constraint gear = jb.angle - ratio * ja.angle - 0.2;
        drive jc.travel = 0.3 * sin(2.0 * t) + 0.1;
        state s: rate = u.x - s, start: 0.2;
        output place: Vec3 = c.at(Z).position;
        output speed: Vec3 = c.at(Z).velocity;
        output turn = jc.angle + jb.angle;
        output mixed = s * u.y + kinetic();
        emit forward_dynamics;
    }
    /// It asks from absolute coordinates.
    pub mod asker {
        formulation { coordinates: Absolute(RollPitchYaw) }
        input w: Vec3;
        param k = 3.0;
        body d { mass: 1.0, inertia: diag(1.0, 1.2, 1.0) }
        body e { mass: 1.0, inertia: diag(1.0, 1.2, 1.0) }
        joint jd: Revolute { parent: ground, child: d, axis: Z }
        joint je: Prismatic { parent: d, child: e, axis: X }
        let p = e.position;
        output place: Vec3 = gears(place, ja = p.x, jc.angle = p.y, t = t, ratio = k);
        output speed: Vec3 =
            gears(c.at(Z).velocity, ja = p.x, jc.angle = p.y, t = 2.0 * t, ja.rate = k, jc.angle.rate = w.z);
        output moved: Vec3 = diff(gears(place, ja = k * t, jc.angle = t, t = t), t);
        output mixed = gears(
            mixed, s = w.x, u = w, ja = 0.1, ja.rate = 0.2, jc.angle = 0.3, jc.angle.rate = -0.4, t = 0.5, ratio = 2.0 * k,
        );
        force pull: Force { at: e, value: gears(place, ja = p.x, jc.angle = p.y, t = t), axes: ground }
    }
    /// It is held by what the gears say, with a multiplier.
    pub mod pulled {
        body cart { mass: 1.0 }
        body wheel { mass: 1.0, inertia: diag(1.0, 1.0, 1.0) }
        joint x: Prismatic { parent: ground, child: cart, axis: X }
        joint phi: Revolute { parent: cart, child: wheel, axis: Z }
        constraint follow = x - norm(gears(place, ja = phi, jc.angle = 0.2 * phi, t = 0.0));
        emit forward_dynamics, constraints;
    }
    mod piece {
        port on: Frame;
        param gain = 1.0;
        body p { mass: 1.0 }
        joint q: Prismatic { parent: on, child: p, axis: X }
        output seen = gears(turn, ja = gain * q, jc.angle = q.rate, ratio = gain);
    }
    pub mod pieces {
        part all: [piece; 3] = |i| piece { on: ground, gain: 1.0 + i };
        emit forward_dynamics;
    }
}
