//! Generated structs as what others store and move: vectors and, with the feature `serde`, its data model.

#[cfg(feature = "serde")]
mod serial;
mod vectors;

multibody::multibody! {
    mod toe {
        port foot: Frame;
        /// [kg]
        param heavy = 0.35;
        body tip { mass: heavy, com: [0.03, -0.02, 0.05], inertia: diag(0.02, 0.03, 0.025) }
        joint bend: Revolute { parent: foot, child: tip, axis: [0.0, 1.0, -1.0] }
    }
    mod leg {
        port hip: Frame;
        part toes: [toe; 2] = |i| toe { foot: shank.at([0.3, 0.1 * i, -0.2]) };
        param ratios: [Scalar; 3] = [2.0, 3.0, 5.0];
        input drive;
        body shank { mass: 0.8, com: [0.1, 0.2, -0.3], inertia: diag(0.2, 0.15, 0.12) }
        joint knee: Universal { parent: hip, child: shank, axes: [X, [0.0, 1.0, 1.0]] }
        state charge: rate = -ratios[1] * charge + drive, start: 0.0;
        force motor: Effort { joint: knee.first, value: drive - ratios[0] * charge }
    }
    /// Every kind of field, legs in an array with toes in an array, an array of more than 32 numbers.
    pub mod walker {
        input gains: [Scalar; 40];
        part legs: [leg; 3] = |i| leg { hip: hull.at([0.2 * i, -0.1, 0.3]) };
        /// [m]
        param offset: Vec3 = [0.3, -0.7, 1.1];
        param table: [Vec3; 2] = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]];
        body hull { mass: 2.0, com: offset, inertia: diag(0.5, 0.6, 0.7) }
        joint float: Free { parent: ground, child: hull }
        body sled { mass: 1.5, com: table[0], inertia: diag(0.3, 0.4, 0.5) }
        joint slide: Planar { parent: ground, child: sled, axis: [0.2, 0.1, 1.0] }
        state filter: rate = gains[7] - gains[39], start: 0.0;
        input r#type;
        force push: Effort { joint: slide.angle, value: r#type + filter }
        output turned: Rotation = hull.rotation;
        output charge = legs[1].charge;
        output slopes = sled.jacobian;
        emit forward_dynamics, outputs { some: [turned, slopes] };
    }
    /// Without quaternions.
    pub mod flat {
        part legs: [leg; 2] = |i| leg { hip: sled.at([0.2 * i, -0.1, 0.3]) };
        body sled { mass: 1.5, com: [0.1, 0.2, 0.3], inertia: diag(0.3, 0.4, 0.5) }
        joint slide: Planar { parent: ground, child: sled, axis: [0.2, 0.1, 1.0] }
        emit forward_dynamics;
    }
    /// A loop that Newton's method closes.
    pub mod loop_of_four {
        body crank { mass: 1.0, com: 0.1 * X, inertia: diag(0.1, 0.1, 0.1) }
        body coupler { mass: 1.0, com: 0.3 * X, inertia: diag(0.1, 0.1, 0.1) }
        body rocker { mass: 1.0, com: 0.3 * X, inertia: diag(0.1, 0.1, 0.1) }
        joint one: Revolute { parent: ground, child: crank, axis: Z }
        joint two: Revolute { parent: crank.at(0.2 * X), child: coupler, axis: Z }
        joint three: Revolute { parent: ground.at(0.7 * X), child: rocker, axis: Z }
        #[cut] joint pin: Revolute { parent: coupler.at(0.63 * X), child: rocker.at(0.58 * X), axis: Z }
        formulation { constraints: Reduced }
    }
    /// The same, with multipliers.
    pub mod held {
        body crank { mass: 1.0, com: 0.1 * X, inertia: diag(0.1, 0.1, 0.1) }
        body coupler { mass: 1.0, com: 0.3 * X, inertia: diag(0.1, 0.1, 0.1) }
        body rocker { mass: 1.0, com: 0.3 * X, inertia: diag(0.1, 0.1, 0.1) }
        joint one: Revolute { parent: ground, child: crank, axis: Z }
        joint two: Revolute { parent: crank.at(0.2 * X), child: coupler, axis: Z }
        joint three: Revolute { parent: ground.at(0.7 * X), child: rocker, axis: Z }
        #[cut] joint pin: Revolute { parent: coupler.at(0.63 * X), child: rocker.at(0.58 * X), axis: Z }
        formulation { constraints: Multipliers }
    }
}
