//! Loops whose solutions are known: every pair of models is one mechanism on its two branches.

use multibody::multibody;

multibody! {
    /// M1, a planar four-bar, open.
    pub mod rrr_open {
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

        /// absolute angle of the coupler, angle of the rocker
        output angles = [crank.angle + coupler.angle, rocker.angle];
        output rates = [crank.rate + coupler.rate, rocker.rate];
        output accels = [crank.accel + coupler.accel, rocker.accel];
        emit forward_dynamics, inverse_dynamics, kinematics { given: crank, find: [coupler, rocker] };
    }
    /// M1, crossed.
    pub mod rrr_crossed {
        formulation { constraints: Reduced }
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body link { mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) }
        body lever { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint coupler: Revolute { parent: arm.at(X), child: link, axis: Z }
        joint rocker: Revolute { parent: ground.at(4.0 * X), child: lever, axis: Z }
        #[cut]
        joint pin: Revolute { parent: link.at(3.5 * X), child: lever.at(3.0 * X), axis: Z }
        solve (coupler, rocker) from pin { sin(rocker.angle - crank.angle - coupler.angle) < 0.0 }

        /// absolute angle of the coupler, angle of the rocker
        output angles = [crank.angle + coupler.angle, rocker.angle];
        output rates = [crank.rate + coupler.rate, rocker.rate];
        output accels = [crank.accel + coupler.accel, rocker.accel];
        emit forward_dynamics, inverse_dynamics, kinematics { given: crank, find: [coupler, rocker] };
    }
    /// M1 with the crank driven.
    pub mod rrr_driven {
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
        drive crank.angle = 1.0 + 2.0 * t;

        /// absolute angle of the coupler, angle of the rocker
        output angles = [crank.angle + coupler.angle, rocker.angle];
        output rates = [crank.rate + coupler.rate, rocker.rate];
        output accels = [crank.accel + coupler.accel, rocker.accel];
        /// [N m] at the crank
        output torque = crank.effort;
        /// [J]
        output moving = kinetic();
        emit forward_dynamics, inverse_dynamics;
    }
}

multibody! {
    /// M2, a slider-crank, the slider to the right.
    pub mod rrp_right {
        formulation { constraints: Reduced }
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body link { mass: 3.5, com: 1.5 * X, inertia: rod(3.5, 3.0, X) }
        body block { mass: 3.0 }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint rod: Revolute { parent: arm.at(X), child: link, axis: Z }
        joint slider: Prismatic { parent: ground.at(0.4 * Y), child: block, axis: X }
        #[cut]
        joint pin: Revolute { parent: link.at(3.0 * X), child: block, axis: Z }
        solve (rod, slider) from pin { cos(crank.angle + rod.angle) > 0.0 }
        emit forward_dynamics, inverse_dynamics, kinematics { given: crank, find: [rod, slider] };
    }
    /// M2, to the left.
    pub mod rrp_left {
        formulation { constraints: Reduced }
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body link { mass: 3.5, com: 1.5 * X, inertia: rod(3.5, 3.0, X) }
        body block { mass: 3.0 }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint rod: Revolute { parent: arm.at(X), child: link, axis: Z }
        joint slider: Prismatic { parent: ground.at(0.4 * Y), child: block, axis: X }
        #[cut]
        joint pin: Revolute { parent: link.at(3.0 * X), child: block, axis: Z }
        solve (rod, slider) from pin { cos(crank.angle + rod.angle) < 0.0 }
        emit forward_dynamics, inverse_dynamics, kinematics { given: crank, find: [rod, slider] };
    }
}

multibody! {
    /// M3, an arm on whose line the crank pin slides.
    pub mod rpr_ahead {
        formulation { constraints: Reduced }
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body lever { mass: 3.5, com: 1.5 * X, inertia: rod(3.5, 3.0, X) }
        body block { mass: 3.0 }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint swing: Revolute { parent: ground.at(-2.2 * Y), child: lever, axis: Z }
        joint slide: Prismatic { parent: lever.at(0.25 * Y), child: block, axis: X }
        #[cut]
        joint pin: Revolute { parent: arm.at(X), child: block, axis: Z }
        solve (swing, slide) from pin { slide.travel > 0.0 }
        emit forward_dynamics, inverse_dynamics, kinematics { given: crank, find: [swing, slide] };
    }
    /// M3, the pin on the other side of the pivot.
    pub mod rpr_behind {
        formulation { constraints: Reduced }
        body arm { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
        body lever { mass: 3.5, com: 1.5 * X, inertia: rod(3.5, 3.0, X) }
        body block { mass: 3.0 }
        joint crank: Revolute { parent: ground, child: arm, axis: Z }
        joint swing: Revolute { parent: ground.at(-2.2 * Y), child: lever, axis: Z }
        joint slide: Prismatic { parent: lever.at(0.25 * Y), child: block, axis: X }
        #[cut]
        joint pin: Revolute { parent: arm.at(X), child: block, axis: Z }
        solve (swing, slide) from pin { slide.travel < 0.0 }
        emit forward_dynamics, inverse_dynamics, kinematics { given: crank, find: [swing, slide] };
    }
}

multibody! {
    /// M4, two levers and a rod.
    pub mod rssr_up {
        formulation { constraints: Reduced }
        body disc { mass: 1.0, com: 0.25 * X, inertia: diag(0.1, 0.1, 0.1) }
        body lever { mass: 2.0, com: 0.35 * Y, inertia: diag(0.1, 0.1, 0.1) }
        joint driver: Revolute { parent: ground, child: disc, axis: Z }
        joint shaft: Revolute { parent: ground.at([1.0, 0.3, 0.2]), child: lever, axis: X }
        constraint link: Rod { between: [disc.at(0.5 * X), lever.at(0.7 * Y)], length: 1.0 }
        solve (shaft) from link { 0.2 * cos(shaft.angle) - (0.3 - 0.5 * sin(driver.angle)) * sin(shaft.angle) > 0.0 }
        emit forward_dynamics, inverse_dynamics, kinematics { given: driver, find: shaft };
    }
    /// M4, the lever on the other side.
    pub mod rssr_down {
        formulation { constraints: Reduced }
        body disc { mass: 1.0, com: 0.25 * X, inertia: diag(0.1, 0.1, 0.1) }
        body lever { mass: 2.0, com: 0.35 * Y, inertia: diag(0.1, 0.1, 0.1) }
        joint driver: Revolute { parent: ground, child: disc, axis: Z }
        joint shaft: Revolute { parent: ground.at([1.0, 0.3, 0.2]), child: lever, axis: X }
        constraint link: Rod { between: [disc.at(0.5 * X), lever.at(0.7 * Y)], length: 1.0 }
        solve (shaft) from link { 0.2 * cos(shaft.angle) - (0.3 - 0.5 * sin(driver.angle)) * sin(shaft.angle) < 0.0 }
        emit forward_dynamics, inverse_dynamics, kinematics { given: driver, find: shaft };
    }
}

multibody! {
    /// M4 with a rod that is a body.
    pub mod rusr {
        formulation { constraints: Reduced }
        body disc { mass: 1.0, com: 0.25 * X, inertia: diag(0.1, 0.1, 0.1) }
        body rod { mass: 0.5, com: 0.5 * X, inertia: diag(0.0, 0.05, 0.05) }
        body lever { mass: 2.0, com: 0.35 * Y, inertia: diag(0.1, 0.1, 0.1) }
        joint driver: Revolute { parent: ground, child: disc, axis: Z }
        joint gimbal: Universal { parent: disc.at(0.5 * X), child: rod, axes: [Z, Y] }
        joint shaft: Revolute { parent: ground.at([1.0, 0.3, 0.2]), child: lever, axis: X }
        #[cut]
        joint ball: Ball { parent: rod.at(X), child: lever.at(0.7 * Y) }
        solve (shaft, gimbal) from ball {
            0.2 * cos(shaft.angle) - (0.3 - 0.5 * sin(driver.angle)) * sin(shaft.angle) > 0.0, cos(gimbal.second) > 0.0
        }
        output gap = rod.at(X).position - lever.at(0.7 * Y).position;
        emit forward_dynamics, inverse_dynamics, kinematics { given: driver, find: [shaft, gimbal] };
    }
}

multibody! {
    /// M5, a leg on a universal joint.
    pub mod ups {
        formulation { constraints: Reduced }
        body tip { mass: 1.0, inertia: diag(0.1, 0.1, 0.1), coordinates: Absolute(RollPitchYaw) }
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        joint gimbal: Universal { parent: ground, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder, child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        solve (gimbal, stroke) from ball { stroke > 0.0, cos(gimbal.second) > 0.0 }
        output end = piston.position;
        emit forward_dynamics, inverse_dynamics, kinematics { given: tip.pose, find: [gimbal, stroke] };
    }
    /// M5, turned over the second axis.
    pub mod ups_turned {
        formulation { constraints: Reduced }
        body tip { mass: 1.0, inertia: diag(0.1, 0.1, 0.1), coordinates: Absolute(RollPitchYaw) }
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        joint gimbal: Universal { parent: ground, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder, child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        solve (gimbal, stroke) from ball { stroke > 0.0, cos(gimbal.second) < 0.0 }
        output end = piston.position;
        emit forward_dynamics, inverse_dynamics, kinematics { given: tip.pose, find: [gimbal, stroke] };
    }
    /// M5, the leg through its foot.
    pub mod ups_through {
        formulation { constraints: Reduced }
        body tip { mass: 1.0, inertia: diag(0.1, 0.1, 0.1), coordinates: Absolute(RollPitchYaw) }
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        joint gimbal: Universal { parent: ground, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder, child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        solve (gimbal, stroke) from ball { stroke < 0.0, cos(gimbal.second) > 0.0 }
        output end = piston.position;
        emit forward_dynamics, inverse_dynamics, kinematics { given: tip.pose, find: [gimbal, stroke] };
    }
    /// M5, both.
    pub mod ups_turned_through {
        formulation { constraints: Reduced }
        body tip { mass: 1.0, inertia: diag(0.1, 0.1, 0.1), coordinates: Absolute(RollPitchYaw) }
        body cylinder { mass: 0.1, com: 0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        body piston { mass: 0.1, com: -0.5 * Z, inertia: diag(0.00625, 0.00625, 0.0) }
        joint gimbal: Universal { parent: ground, child: cylinder, axes: [X, Y] }
        joint stroke: Prismatic { parent: cylinder, child: piston, axis: Z }
        #[cut]
        joint ball: Ball { parent: piston, child: tip }
        solve (gimbal, stroke) from ball { stroke < 0.0, cos(gimbal.second) < 0.0 }
        output end = piston.position;
        emit forward_dynamics, inverse_dynamics, kinematics { given: tip.pose, find: [gimbal, stroke] };
    }
}

multibody! {
    /// M6, Bennett's four-bar, with a solution that the user knows.
    pub mod bennett {
        const A = 1.0;
        const B = A * sin(1.1) / sin(0.6);
        const K = sin(0.85) / sin(0.25);
        formulation { constraints: Reduced }
        body one { mass: 1.0, com: 0.5 * X, inertia: diag(0.1, 0.1, 0.1) }
        body two { mass: 1.5, com: 0.5 * X, inertia: diag(0.1, 0.1, 0.1) }
        body three { mass: 1.0, com: 0.5 * X, inertia: diag(0.1, 0.1, 0.1) }
        joint first: Revolute { parent: ground, child: one, axis: Z }
        joint second: Revolute { parent: one.at(A * X).rotated(X, 0.6), child: two, axis: Z }
        joint third: Revolute { parent: two.at(B * X).rotated(X, 1.1), child: three, axis: Z }
        #[cut]
        joint fourth: Revolute {
            parent: three.at(A * X).rotated(X, 0.6), child: ground.rotated(X, -1.1).at(-B * X), axis: Z,
        }
        solve (second, third) = (2.0 * atan2(K * cos(0.5 * first.angle), sin(0.5 * first.angle)), -first.angle);
        emit forward_dynamics, inverse_dynamics, kinematics { given: first, find: [second, third] };
    }
}
