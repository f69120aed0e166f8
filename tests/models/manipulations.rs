//! Models whose expressions are made of expressions: derivatives, substitutions, entries of matrices.

use multibody::multibody;

multibody! {
    /// A skew arm of two links with a motor of its own, and what is to be differentiated as outputs.
    pub mod arm {
        /// [m]
        param reach: Vec3 = [0.31, -0.12, 0.27];
        /// [N m/rad], [kg]
        param many: [Scalar; 2] = [3.7, 1.3];
        /// [N m]
        input torque: Vec3;
        input valve;
        world { gravity: [0.4, -0.7, -9.6] }
        body upper { mass: many[1], com: 0.4 * reach, inertia: inertia(0.08, 0.09, 0.11, 0.005, -0.003, 0.002) }
        body lower { mass: 0.8, com: [0.1, 0.05, -0.2], inertia: diag(0.02, 0.03, 0.015) }
        joint shoulder: Universal { parent: ground, child: upper, axes: [[0.6, 0.0, 0.8], Y] }
        joint elbow: Revolute { parent: upper.at(reach).rotated([1.0, 2.0, 0.5], 0.7), child: lower, axis: [0.0, 0.6, -0.8] }
        force coil: SpringDamper { joint: elbow, stiffness: many[0], damping: 0.2, rest: 0.4 }
        force motor: Effort { joint: elbow, value: torque.y * cos(lag) + valve * valve }
        state lag: rate = sin(valve) - lag * elbow.rate, start: 0.2;

        let grip = lower.at([0.05, 0.02, -0.4]);
        let mixed = sin(lag) * torque.y * many[0] + powi(valve, 3) * exp(0.3 * lag) * cos(elbow.angle);
        output place: Vec3 = grip.position;
        output speed: Vec3 = grip.velocity;
        output moving = kinetic();
        output stored = potential();
        output mixture = mixed;

        output place_by_second: Vec3 = diff(grip.position, shoulder.second);
        output speed_by_first: Vec3 = diff(grip.velocity, shoulder.first);
        output moving_by_elbow = diff(kinetic(), elbow);
        output moving_by_rate = diff(kinetic(), elbow.rate);
        output stored_by_reach = diff(potential(), reach.z);
        output stored_by_stiffness = diff(potential(), many[0]);
        output mixture_by_lag = diff(mixed, lag);
        output mixture_by_valve = diff(mixed, valve);
        output mixture_by_torque = diff(mixed, torque.y);
        output place_by_time: Vec3 = diff(grip.position, t);
        output speed_by_time: Vec3 = diff(grip.velocity, t);
        output acceleration: Vec3 = grip.acceleration;
        output moving_by_time = diff(kinetic(), t);
        output twice = diff(diff(kinetic(), elbow.rate), shoulder.first.rate);
        output entry = mass_matrix[elbow, shoulder.first];
        output effort = bias[elbow];
        output still = substitute(kinetic(), elbow.rate = 0.0, shoulder.second = 0.3 * lag, many[1] = 2.0);
        emit forward_dynamics, mass_matrix, bias;
    }
    /// The same arm under forces that hold it: gravity and the spring are taken from the potential energy.
    pub mod held_arm {
        world { gravity: [0.4, -0.7, -9.6] }
        input pull: Vec3;
        body upper { mass: 1.3, com: [0.1, -0.05, 0.1], inertia: inertia(0.08, 0.09, 0.11, 0.005, -0.003, 0.002) }
        body lower { mass: 0.8, com: [0.1, 0.05, -0.2], inertia: diag(0.02, 0.03, 0.015) }
        joint shoulder: Universal { parent: ground, child: upper, axes: [[0.6, 0.0, 0.8], Y] }
        joint elbow: Revolute { parent: upper.at([0.31, -0.12, 0.27]), child: lower, axis: [0.0, 0.6, -0.8] }
        force hold: Effort {
            joint: shoulder,
            value: [
                diff(potential(), shoulder.first) + dot(diff(lower.position, shoulder.first), pull),
                diff(potential(), shoulder.second) + dot(diff(lower.position, shoulder.second), pull),
            ],
        }
        force hold_elbow: Effort {
            joint: elbow, value: diff(potential(), elbow) + mass_matrix[elbow, elbow] * 0.5,
        }
        output slopes: Jacobian = lower.jacobian;
        emit forward_dynamics, mass_matrix, bias;
    }
    /// A four-bar whose crank takes the others along.
    pub mod bars {
        formulation { constraints: Reduced }
        param weight = 3.5;
        world { gravity: [1.0, -9.0, 2.0] }
        input torque;
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body link { mass: 3.5, com: [1.7, 0.2, 0.0], inertia: diag(0.1, 3.0, 3.1) }
        body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
        joint rocker: Revolute { parent: ground.at(4.0 * X), child: lever, axis: Z }
        #[cut]
        joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
        force motor: Effort { joint: crank, value: torque + 0.1 * diff(link.at(2.0 * Y).position.y, crank) }
        solve (coupler, rocker) from pin { sin(rocker.angle - crank.angle - coupler.angle) > 0.0 }
        output top: Vec3 = link.at(2.0 * Y).position;
        output top_speed: Vec3 = link.at(2.0 * Y).velocity;
        output moving = kinetic();
        output top_by_crank: Vec3 = diff(link.at(2.0 * Y).position, crank);
        output speed_by_crank: Vec3 = diff(link.at(2.0 * Y).velocity, crank);
        output speed_by_rate: Vec3 = diff(link.at(2.0 * Y).velocity, crank.rate);
        output moving_by_crank = diff(kinetic(), crank);
        output moving_by_time = diff(kinetic(), t);
        output top_by_time: Vec3 = diff(link.at(2.0 * Y).position, t);
        output speed_by_time: Vec3 = diff(link.at(2.0 * Y).velocity, t);
        output top_acceleration: Vec3 = link.at(2.0 * Y).acceleration;
        output inertia_seen = mass_matrix[crank, crank];
        output closed_form: Vec3 = [closed(rocker) - rocker.angle, diff(closed(coupler), crank) - diff(coupler.angle, crank), 0.0];
        output work = substitute(torque * weight * torque, torque = 2.0, weight = 0.5);
        emit forward_dynamics, mass_matrix;
    }
    /// The same four-bar with multipliers, and a rack beside it: entries of what is held.
    pub mod held_bars {
        formulation { independent: [crank, slide] }
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body link { mass: 3.5, com: [1.7, 0.2, 0.0], inertia: diag(0.1, 3.0, 3.1) }
        body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
        body bar { mass: 0.5 }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
        joint rocker: Revolute { parent: ground.at(4.0 * X), child: lever, axis: Z }
        joint slide: Prismatic { parent: ground, child: bar, axis: Y }
        #[cut]
        joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
        constraint rack = slide + 0.3 * sin(rocker.angle) - 0.1 * crank * crank;
        let end = link.at(3.5 * X);
        output gap: Vec3 = end.express(lever.at(3.0 * X).position - end.position);
        output left: Vec3 = [constraint[pin.x], constraint[pin.y], constraint[rack]];
        output slopes = [
            jacobian[pin.x, crank], jacobian[pin.x, coupler], jacobian[pin.x, rocker], jacobian[pin.x, slide],
            jacobian[pin.y, crank], jacobian[pin.y, coupler], jacobian[pin.y, rocker], jacobian[pin.y, slide],
            jacobian[rack, crank], jacobian[rack, coupler], jacobian[rack, rocker], jacobian[rack, slide],
        ];
        emit forward_dynamics, constraints;
    }
    /// The same four-bar, closed by iteration, driven by a force that compensates what its inertia does as it changes.
    pub mod iterated_bars {
        formulation { constraints: Reduced, independent: [crank] }
        input torque;
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body link { mass: 3.5, com: [1.7, 0.2, 0.0], inertia: diag(0.1, 3.0, 3.1) }
        body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
        joint rocker: Revolute { parent: ground.at(4.0 * X), child: lever, axis: Z }
        #[cut]
        joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
        let change = diff(mass_matrix[crank, crank], crank);
        force motor: Effort {
            joint: crank, value: torque * mass_matrix[crank, crank] + 0.5 * change * crank.rate * crank.rate,
        }
        output inertia_seen = mass_matrix[crank, crank];
        output inertia_by_crank = change;
        output inertia_by_time = diff(mass_matrix[crank, crank], t);
        emit forward_dynamics;
    }
}

multibody! {
    /// A motor on a disc: the current, and what is left of it where the inductance counts for nothing.
    pub mod motor {
        param resistance = 1.7;
        param constant = 0.23;
        param inductance = 0.004;
        input voltage;
        body disc { mass: 1.0, inertia: diag(0.1, 0.1, 0.02) }
        joint shaft: Revolute { parent: ground, child: disc, axis: Z }
        state current: rate = (voltage - resistance * current - constant * shaft.rate) / inductance, start: 0.0;
        simplify current.rate == 0.0;
        force drive: Effort { joint: shaft, value: constant * current }
        output flowing = current;
        emit forward_dynamics;
    }
    /// Two currents of one field that turns with the shaft, both without a rate, beside one that keeps its own.
    pub mod field_motor {
        input voltage: [Scalar; 2];
        body disc { mass: 1.0, inertia: diag(0.1, 0.1, 0.02) }
        joint shaft: Revolute { parent: ground, child: disc, axis: Z }
        state direct: rate = (voltage[0] - 0.8 * direct + 0.3 * shaft.rate * quadrature) / 0.01, start: 0.0;
        state quadrature: rate = (voltage[1] - 0.7 * quadrature - 0.2 * shaft.rate * direct) / 0.02, start: 0.0;
        state heat: rate = 0.8 * direct * direct - 0.1 * heat, start: 1.0;
        simplify direct.rate == 0.0;
        simplify quadrature.rate == 0;
        force drive: Effort { joint: shaft, value: 1.1 * quadrature }
        output currents = [direct, quadrature];
        emit forward_dynamics;
    }
    /// Equations of the user's own, linear ones and one of second degree.
    pub mod unknowns {
        param many: [Scalar; 3] = [1.3, -0.4, 2.2];
        input pull: Vec3;
        body disc { mass: 1.0, inertia: diag(0.1, 0.1, 0.02) }
        joint shaft: Revolute { parent: ground, child: disc, axis: Z }
        solve (a, b, c) from [
            many[0] * a - b == pull.x + cos(shaft.angle) * c,
            a + (2.0 + many[1]) * b + 0.5 * c == 3.0 * pull.y,
            a * shaft.rate + c == pull.z - b,
        ];
        solve (lone) from many[2] * lone + 1.0 == pull.x;
        solve (root) from root * (root + pull.x) == 4.0 + powi(shaft.angle, 2) { root > 0.0 }
        solve (other) from root * other * other - 3.0 == 0.2 * other { other < pull.y }
        output found = [a, b, c];
        output alone = lone;
        output roots = [root, other];
        force drive: Effort { joint: shaft, value: a - 0.1 * root }
        emit forward_dynamics;
    }
}

multibody! {
    /// Equations whose square vanishes.
    pub mod vanishing_squares {
        input pull: Vec3;
        body disc { mass: 1.0, inertia: diag(0.1, 0.1, 0.02) }
        joint shaft: Revolute { parent: ground, child: disc, axis: Z }
        // Of second degree to the eye.
        solve (first) from (first + pull.x) * (first + pull.x) - first * first == 3.0 { first > -1e9 }
        // A coefficient that is zero at some inputs: one solution is left.
        solve (flat) from max(pull.x, 0.0) * flat * flat + (1.3 - pull.z) * flat == 0.1 { abs(flat) < 2.0 }
        output lines = [first, flat];
        output slope = diff(flat, pull.z);
        emit forward_dynamics;
    }
}

multibody! {
    /// Unknown angles.
    pub mod unknown_angles {
        param many: [Scalar; 3] = [1.3, -0.4, 2.2];
        input pull: Vec3;
        body disc { mass: 1.0, inertia: diag(0.1, 0.1, 0.02) }
        joint shaft: Revolute { parent: ground, child: disc, axis: Z }
        // The unknown within sums of angles, in a product of vectors, on both sides, backwards.
        let crooked = dot(cross([0.2, many[1], cos(x - 0.3)], [0.4, -1.1, 0.3]), [0.5, shaft.rate, 0.9]);
        solve (x) from crooked + many[0] * sin(shaft.angle - x) == 0.3 * pull.x - (sin(x) - cos(-x + 2.0 * shaft.angle)) / many[2] {
            cos(x - shaft.angle) > 0.2
        }
        // One of the coefficients is zero, or both terms are on one side.
        solve (level) from 2.0 * cos(level) == pull.y { sin(level) < 0.0 }
        solve (direction) from (3.0 + pull.y) * sin(direction) == pull.x * cos(direction) { cos(direction) > 0.0 }
        solve (after) from sin(after) * sin(level) == 0.4 * pull.z { after > -0.5 * PI, after < 0.5 * PI }
        output found = [x, level, direction, after];
        output turned = cos(x) + many[0] * sin(2.0 * level);
        output crookedness = crooked;
        output slopes = diff(x + direction, shaft.angle);
        force drive: Effort { joint: shaft, value: sin(level + shaft.angle) }
        emit forward_dynamics;
    }
}

multibody! {
    pub mod four_unknowns {
        input pull: Vec3;
        body disc { mass: 1.0, inertia: diag(0.1, 0.1, 0.02) }
        joint shaft: Revolute { parent: ground, child: disc, axis: Z }
        // Four at once, with pivots: the first pivot in the order of the text is zero.
        solve (d, e, f, g) from [
            e + 2.0 * f - g == pull.x,
            d - e + f * cos(shaft.angle) == 1.0,
            3.0 * d + g == pull.y * pull.z,
            0.5 * e + d - f + 2.0 * g == shaft.rate,
        ];
        output four = [d, e, f, g];
        emit forward_dynamics;
    }
}

/// A pole on a cart on a slope, with a second pole on the first.
macro_rules! poles {
    ($name:ident { $($more:tt)* }) => {
        multibody! {
            pub mod $name {
                world { gravity: [0.7, -9.6, 0.0] }
                input push;
                body cart { mass: 1.3 }
                body pole { mass: 0.4, com: [0.02, 0.4, 0.0], inertia: diag(0.02, 0.003, 0.02) }
                body tip { mass: 0.2, com: [0.1, 0.3, 0.0], inertia: diag(0.01, 0.002, 0.011) }
                joint track: Prismatic { parent: ground, child: cart, axis: X }
                joint hinge: Revolute { parent: cart, child: pole, axis: Z }
                joint second: Revolute { parent: pole.at(0.8 * Y), child: tip, axis: Z }
                force motor: Effort { joint: track, value: push * cos(hinge.angle) - 0.3 * track.rate }
                force drag: Effort { joint: second, value: -0.1 * second.rate * abs(track.rate) }
                output place: Vec3 = tip.position;
                emit forward_dynamics, inverse_dynamics, mass_matrix, bias, derivatives, linearize;
                $($more)*
            }
        }
    };
}

poles! { exact_poles {} }
poles! { small_poles { simplify small(hinge); emit impulse, equations; } }
poles! { smaller_poles { simplify small(hinge, second.angle); } }
poles! { held_poles { simplify hinge == 0.3; } }
