//! Models that are moved about, and models whose inertia goes to zero.

use multibody::multibody;

/// An open chain in space, a closed loop with its formula, and one that keeps its equations, somewhere.
macro_rules! somewhere {
    ($(#[$docs:meta])* $name:ident { $($origin:tt)* }) => {
        $(#[$docs])*
        pub(crate) mod $name {
            use multibody::multibody;

            multibody! {
                /// Three links in space, with a spring between two of them.
                pub(crate) mod arm {
                    const ORIGIN: Vec3 = $($origin)*;
                    world { gravity: -9.81 * Z }
                    body a { mass: 2.1, com: [0.1, 0.02, 0.3], inertia: inertia(0.2, 0.3, 0.25, 0.01, -0.02, 0.03) }
                    body b { mass: 1.3, com: [0.2, 0.0, 0.1], inertia: inertia(0.1, 0.12, 0.15, 0.01, 0.01, 0.02) }
                    body c { mass: 0.7, com: [0.0, 0.3, 0.0], inertia: diag(0.02, 0.03, 0.04) }
                    joint one: Revolute { parent: ground.at(ORIGIN).rotated(X, 0.3), child: a, axis: Z }
                    joint two: Universal { parent: a.at([0.4, 0.1, 0.5]), child: b, axes: [X, Y] }
                    joint three: Prismatic { parent: b.at([0.7, 0.0, 0.1]), child: c, axis: X }
                    force spring: SpringDamper { between: [a.at(X), c], stiffness: 40.0, damping: 0.3, length: 0.2 }
                    emit forward_dynamics, inverse_dynamics;
                }
            }
            multibody! {
                /// A four-bar.
                pub(crate) mod four_bar {
                    const ORIGIN: Vec3 = $($origin)*;
                    world { gravity: -9.81 * Y }
                    formulation { constraints: Reduced }
                    body crank { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
                    body coupler { mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) }
                    body rocker { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
                    joint shaft: Revolute { parent: ground.at(ORIGIN), child: crank, axis: Z }
                    joint knee: Revolute { parent: crank.at(X), child: coupler, axis: Z }
                    joint pivot: Revolute { parent: ground.at(ORIGIN + [4.1, 0.3, 0.0]), child: rocker, axis: Z }
                    #[cut]
                    joint pin: Revolute { parent: coupler.at(3.5 * X), child: rocker.at(3.0 * X), axis: Z }
                    solve (knee, pivot) from pin { sin(pivot - shaft - knee) > 0.0 }
                    emit forward_dynamics, inverse_dynamics;
                }
            }
            multibody! {
                /// The same with its equations, and a spring to the ground.
                pub(crate) mod four_bar_multipliers {
                    const ORIGIN: Vec3 = $($origin)*;
                    world { gravity: -9.81 * Y }
                    formulation { constraints: Multipliers }
                    body crank { mass: 1.0, com: 0.5 * X, inertia: rod(1.0, 1.0, X) }
                    body coupler { mass: 3.5, com: 1.75 * X, inertia: rod(3.5, 3.5, X) }
                    body rocker { mass: 3.0, com: 1.5 * X, inertia: rod(3.0, 3.0, X) }
                    joint shaft: Revolute { parent: ground.at(ORIGIN), child: crank, axis: Z }
                    joint knee: Revolute { parent: crank.at(X), child: coupler, axis: Z }
                    joint pivot: Revolute { parent: ground.at(ORIGIN + [4.1, 0.3, 0.0]), child: rocker, axis: Z }
                    #[cut]
                    joint pin: Revolute { parent: coupler.at(3.5 * X), child: rocker.at(3.0 * X), axis: Z }
                    force spring: Spring {
                        between: [ground.at(ORIGIN + [0.2, 3.0, 0.0]), coupler.at(X)], stiffness: 70.0, length: 0.4,
                    }
                    emit forward_dynamics;
                }
            }
        }
    };
}

somewhere! {
    /// Where the world begins.
    here { [0.0, 0.0, 0.0] }
}
somewhere! {
    /// A kilometre off.
    at_1e3 { [1e3, -1e3, 1e3] }
}
somewhere! {
    /// A thousand.
    at_1e6 { [1e6, 2e6, -1e6] }
}
somewhere! {
    /// A million.
    at_1e9 { [1e9, -1e9, 0.7e9] }
}

multibody! {
    /// An open chain whose base is a parameter.
    pub mod adjustable {
        param origin: Vec3 = [0.0, 0.0, 0.0];
        world { gravity: -9.81 * Z }
        body a { mass: 2.1, com: [0.1, 0.02, 0.3], inertia: inertia(0.2, 0.3, 0.25, 0.01, -0.02, 0.03) }
        body b { mass: 1.3, com: [0.2, 0.0, 0.1], inertia: inertia(0.1, 0.12, 0.15, 0.01, 0.01, 0.02) }
        body c { mass: 0.7, com: [0.0, 0.3, 0.0], inertia: diag(0.02, 0.03, 0.04) }
        joint one: Revolute { parent: ground.at(origin).rotated(X, 0.3), child: a, axis: Z }
        joint two: Universal { parent: a.at([0.4, 0.1, 0.5]), child: b, axes: [X, Y] }
        joint three: Prismatic { parent: b.at([0.7, 0.0, 0.1]), child: c, axis: X }
        force spring: SpringDamper { between: [a.at(X), c], stiffness: 40.0, damping: 0.3, length: 0.2 }
        emit forward_dynamics, inverse_dynamics, mass_matrix;
    }
}

multibody! {
    /// Rods on universal joints; `i` is what they have about their axes.
    pub mod slender {
        param i = 0.0;
        world { gravity: -9.81 * Z }
        body upper { mass: 1.2, com: -0.5 * Z, inertia: diag(0.1, 0.1, i) }
        body lower { mass: 0.8, com: -0.4 * Z, inertia: diag(0.05, 0.05, i) }
        joint first: Universal { parent: ground, child: upper, axes: [X, Y] }
        joint second: Universal { parent: upper.at(-Z), child: lower, axes: [X, Y] }
        emit forward_dynamics, inverse_dynamics;
    }
    /// The same without.
    pub mod rods {
        world { gravity: -9.81 * Z }
        body upper { mass: 1.2, com: -0.5 * Z, inertia: diag(0.1, 0.1, 0.0) }
        body lower { mass: 0.8, com: -0.4 * Z, inertia: diag(0.05, 0.05, 0.0) }
        joint first: Universal { parent: ground, child: upper, axes: [X, Y] }
        joint second: Universal { parent: upper.at(-Z), child: lower, axes: [X, Y] }
        emit forward_dynamics, inverse_dynamics;
    }
    /// Balls on massless rods.
    pub mod balls {
        param i = 0.0;
        world { gravity: -9.81 * Z }
        body upper { mass: 1.2, com: -0.5 * Z, inertia: diag(i, i, i) }
        body lower { mass: 0.8, com: -0.4 * Z, inertia: diag(i, i, i) }
        joint first: Universal { parent: ground, child: upper, axes: [X, Y] }
        joint second: Universal { parent: upper.at(-Z), child: lower, axes: [X, Y] }
        emit forward_dynamics, inverse_dynamics;
    }
    /// Points.
    pub mod points {
        world { gravity: -9.81 * Z }
        body upper { mass: 1.2, com: -0.5 * Z }
        body lower { mass: 0.8, com: -0.4 * Z }
        joint first: Universal { parent: ground, child: upper, axes: [X, Y] }
        joint second: Universal { parent: upper.at(-Z), child: lower, axes: [X, Y] }
        emit forward_dynamics, inverse_dynamics;
    }
    /// A rod that may spin about its axis, with a torque about it.
    pub mod spinning {
        param i = 0.01;
        input torque;
        world { gravity: -9.81 * Z }
        body rod { mass: 1.2, com: -0.5 * Z, inertia: diag(0.1, 0.1, i) }
        joint support: Ball { parent: ground, child: rod }
        force motor: Torque { at: rod, value: [0.0, 0.0, torque], axes: rod }
        emit forward_dynamics, inverse_dynamics, mass_matrix;
    }
}
