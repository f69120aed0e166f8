//! Mechanisms with things left out: what is not there costs nothing. Every number is a literal. Each call declares one
//! mechanism in several forms; `support/required.rs` has the counts of each, reduced by hand.

use multibody::multibody;

multibody! {
    /// A mass on a rod, in gravity.
    pub mod pendulum {
        world { gravity: -9.81 * Y }
        body bob { mass: 1.7, com: -0.8 * Y }
        joint hinge: Revolute { parent: ground, child: bob, axis: Z }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias, energy;
    }
    /// A body of any shape in place of the mass, hinged where its centre hangs straight down.
    pub mod pendulum_of_any_shape {
        world { gravity: -9.81 * Y }
        body bob { mass: 1.7, com: [0.0, -0.8, 0.3], inertia: inertia(0.4, 0.3, 0.5, 0.01, 0.02, 0.03) }
        joint hinge: Revolute { parent: ground.at([1.0, 2.0, 3.0]), child: bob, axis: Z }
        emit forward_dynamics;
    }
    /// Friction in the hinge.
    pub mod pendulum_with_friction {
        world { gravity: -9.81 * Y }
        body bob { mass: 1.7, com: -0.8 * Y }
        joint hinge: Revolute { parent: ground, child: bob, axis: Z }
        force friction: Damper { joint: hinge, damping: 0.02 }
        emit forward_dynamics;
    }
    /// No gravity.
    pub mod pendulum_without_gravity {
        body bob { mass: 1.7, com: -0.8 * Y }
        joint hinge: Revolute { parent: ground, child: bob, axis: Z }
        emit forward_dynamics;
    }
    /// Gravity along the hinge.
    pub mod turntable {
        world { gravity: -9.81 * Z }
        body bob { mass: 1.7, com: -0.8 * Y }
        joint hinge: Revolute { parent: ground, child: bob, axis: Z }
        emit forward_dynamics, inverse_dynamics;
    }
}

multibody! {
    /// A free body, its frame in principal axes.
    pub mod free {
        body nut { mass: 1.3, inertia: diag(1.0, 1.7, 2.3) }
        joint free: Free { parent: ground, child: nut }
        emit forward_dynamics, energy;
    }
    /// In gravity: it falls as all do.
    pub mod free_in_gravity {
        world { gravity: -9.81 * Z }
        body nut { mass: 1.3, inertia: diag(1.0, 1.7, 2.3) }
        joint free: Free { parent: ground, child: nut }
        emit forward_dynamics;
    }
    /// Two equal moments.
    pub mod free_symmetric {
        body nut { mass: 1.3, inertia: diag(1.7, 1.7, 2.3) }
        joint free: Free { parent: ground, child: nut }
        emit forward_dynamics;
    }
    /// Three equal moments.
    pub mod free_sphere {
        body nut { mass: 1.3, inertia: sphere(1.3, 0.5) }
        joint free: Free { parent: ground, child: nut }
        emit forward_dynamics;
    }
    /// A frame in any axes.
    pub mod free_in_any_axes {
        body nut { mass: 1.3, inertia: inertia(1.0, 1.7, 2.3, 0.11, -0.07, 0.05) }
        joint free: Free { parent: ground, child: nut }
        emit forward_dynamics;
    }
    /// A frame that stands beside the centre of mass, on a principal axis.
    pub mod free_beside_its_centre {
        body nut { mass: 1.3, com: 0.3 * Z, inertia: diag(1.0, 1.7, 2.3) }
        joint free: Free { parent: ground, child: nut }
        emit forward_dynamics;
    }
    /// Anywhere.
    pub mod free_off_its_centre {
        body nut { mass: 1.3, com: [0.1, 0.2, 0.3], inertia: diag(1.0, 1.7, 2.3) }
        joint free: Free { parent: ground, child: nut }
        emit forward_dynamics;
    }
    /// Its position alone.
    pub mod free_seen {
        body nut { mass: 1.3, inertia: diag(1.0, 1.7, 2.3) }
        joint free: Free { parent: ground, child: nut }
        output place = nut.position;
        output speed = nut.velocity;
        output fall = nut.acceleration;
    }
    /// In a plane.
    pub mod plate_in_a_plane {
        world { gravity: -9.81 * Y }
        body plate { mass: 1.3, inertia: inertia(1.0, 1.7, 2.3, 0.11, -0.07, 0.05) }
        joint plane: Planar { parent: ground, child: plate, axis: Z }
        emit forward_dynamics, inverse_dynamics;
    }
    /// A point mass in a plane, by two slides. What slides first has no mass.
    pub mod point_in_a_plane {
        world { gravity: -9.81 * Y }
        body carrier { mass: 0.0 }
        body point { mass: 1.3 }
        joint across: Prismatic { parent: ground, child: carrier, axis: X }
        joint along: Prismatic { parent: carrier, child: point, axis: Y }
        emit forward_dynamics;
    }
    /// On one point.
    pub mod ball {
        body nut { mass: 1.3, com: [0.0, 0.0, 0.4], inertia: diag(0.9, 0.7, 0.5) }
        joint point: Ball { parent: ground, child: nut }
        emit forward_dynamics;
    }
    /// Two equal moments, in gravity: the heavy top.
    pub mod ball_symmetric {
        world { gravity: -9.81 * Z }
        body nut { mass: 1.3, com: [0.0, 0.0, 0.4], inertia: diag(0.9, 0.9, 0.5) }
        joint point: Ball { parent: ground, child: nut }
        emit forward_dynamics;
    }
    /// Moments about the point that are equal: nothing but gravity.
    pub mod ball_round {
        world { gravity: -9.81 * Z }
        body nut { mass: 1.0, com: [0.0, 0.0, 0.5], inertia: diag(0.5, 0.5, 0.75) }
        joint point: Ball { parent: ground, child: nut }
        emit forward_dynamics;
    }
    /// Held at its centre: no gyroscopic terms, and gravity does nothing.
    pub mod ball_balanced {
        world { gravity: -9.81 * Z }
        body nut { mass: 1.3, inertia: diag(0.9, 0.9, 0.9) }
        joint point: Ball { parent: ground, child: nut }
        emit forward_dynamics;
    }
}

multibody! {
    /// A double pendulum of point masses.
    pub mod double_points {
        world { gravity: -9.81 * Y }
        body upper { mass: 1.5, com: -0.9 * Y }
        body lower { mass: 0.7, com: -1.1 * Y }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-0.9 * Y), child: lower, axis: Z }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias;
    }
    /// Of rods.
    pub mod double_rods {
        world { gravity: -9.81 * Y }
        body upper { mass: 1.5, com: -0.45 * Y, inertia: rod(1.5, 0.9, Y) }
        body lower { mass: 0.7, com: -0.55 * Y, inertia: rod(0.7, 1.1, Y) }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-0.9 * Y), child: lower, axis: Z }
        emit forward_dynamics, inverse_dynamics, mass_matrix;
    }
    /// Of bodies of any shape: in the plane only one moment and two coordinates of the centre of mass are left of each.
    pub mod double_bodies {
        world { gravity: -9.81 * Y }
        body upper { mass: 1.5, com: [0.05, -0.45, 0.1], inertia: inertia(0.3, 0.2, 0.25, 0.01, -0.02, 0.03) }
        body lower { mass: 0.7, com: [-0.04, -0.55, 0.2], inertia: inertia(0.2, 0.1, 0.15, 0.02, 0.01, -0.01) }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at([0.0, -0.9, 0.3]), child: lower, axis: Z }
        emit forward_dynamics, inverse_dynamics, mass_matrix;
    }
    /// No gravity.
    pub mod double_without_gravity {
        body upper { mass: 1.5, com: -0.9 * Y }
        body lower { mass: 0.7, com: -1.1 * Y }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-0.9 * Y), child: lower, axis: Z }
        emit forward_dynamics, inverse_dynamics;
    }
    /// Friction in both hinges.
    pub mod double_with_friction {
        world { gravity: -9.81 * Y }
        body upper { mass: 1.5, com: -0.9 * Y }
        body lower { mass: 0.7, com: -1.1 * Y }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-0.9 * Y), child: lower, axis: Z }
        force friction1: Damper { joint: shoulder, damping: 0.02 }
        force friction2: Damper { joint: elbow, damping: 0.03 }
        emit forward_dynamics;
    }
    /// The elbow welded.
    pub mod double_welded {
        world { gravity: -9.81 * Y }
        body upper { mass: 1.5, com: -0.9 * Y }
        body lower { mass: 0.7, com: -1.1 * Y }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Fixed { parent: upper.at(-0.9 * Y), child: lower }
        emit forward_dynamics, inverse_dynamics, mass_matrix;
    }
    /// The elbow held at an angle by a drive.
    pub mod double_held {
        world { gravity: -9.81 * Y }
        body upper { mass: 1.5, com: -0.9 * Y }
        body lower { mass: 0.7, com: -1.1 * Y }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-0.9 * Y), child: lower, axis: Z }
        drive elbow.angle = 0.0;
        emit forward_dynamics, inverse_dynamics, mass_matrix;
    }
    /// The lower one hung up at the centre: it never turns.
    pub mod double_hung {
        world { gravity: -9.81 * Y }
        body upper { mass: 1.5, com: -0.9 * Y }
        body lower { mass: 0.7, inertia: diag(0.1, 0.2, 0.3) }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-0.9 * Y), child: lower, axis: Z }
        emit forward_dynamics;
    }
    /// Seen from outside: of each body alone.
    pub mod double_seen {
        world { gravity: -9.81 * Y }
        body upper { mass: 1.5, com: -0.9 * Y }
        body lower { mass: 0.7, com: -1.1 * Y }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-0.9 * Y), child: lower, axis: Z }
        output hinge = upper.at(-0.9 * Y).position;
    }
    /// Of the lower one.
    pub mod double_tip_seen {
        world { gravity: -9.81 * Y }
        body upper { mass: 1.5, com: -0.9 * Y }
        body lower { mass: 0.7, com: -1.1 * Y }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-0.9 * Y), child: lower, axis: Z }
        output tip = lower.at(-1.1 * Y).position;
    }
    /// How fast the lower one turns.
    pub mod double_spin_seen {
        world { gravity: -9.81 * Y }
        body upper { mass: 1.5, com: -0.9 * Y }
        body lower { mass: 0.7, com: -1.1 * Y }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(-0.9 * Y), child: lower, axis: Z }
        output spin = lower.angular_velocity;
    }
}

multibody! {
    /// A spherical pendulum.
    pub mod spherical {
        world { gravity: -9.81 * Z }
        body bob { mass: 1.7, com: -0.8 * Z }
        joint support: Universal { parent: ground, child: bob, axes: [X, Y] }
        emit forward_dynamics, inverse_dynamics, mass_matrix;
    }
    /// Its universal joint as two hinges with a massless carrier.
    pub mod spherical_by_carrier {
        world { gravity: -9.81 * Z }
        body carrier { mass: 0.0 }
        body bob { mass: 1.7, com: -0.8 * Z }
        joint first: Revolute { parent: ground, child: carrier, axis: X }
        joint second: Revolute { parent: carrier, child: bob, axis: Y }
        emit forward_dynamics, inverse_dynamics, mass_matrix;
    }
    /// No gravity.
    pub mod spherical_without_gravity {
        body bob { mass: 1.7, com: -0.8 * Z }
        joint support: Universal { parent: ground, child: bob, axes: [X, Y] }
        emit forward_dynamics;
    }
    /// The second axis held: a pendulum in a plane.
    pub mod spherical_held {
        world { gravity: -9.81 * Z }
        body bob { mass: 1.7, com: -0.8 * Z }
        joint support: Universal { parent: ground, child: bob, axes: [X, Y] }
        drive support.second = 0.0;
        emit forward_dynamics;
    }
}

multibody! {
    /// An arm that turns about the vertical, with a shoulder and an elbow; masses at elbow and hand.
    pub mod arm {
        world { gravity: -9.81 * Z }
        body post { mass: 4.0, inertia: diag(0.2, 0.2, 0.1) }
        body upper { mass: 1.5, com: 0.9 * X }
        body lower { mass: 0.7, com: 1.1 * X }
        joint waist: Revolute { parent: ground, child: post, axis: Z }
        joint shoulder: Revolute { parent: post.at(0.5 * Z), child: upper, axis: -Y }
        joint elbow: Revolute { parent: upper.at(0.9 * X), child: lower, axis: -Y }
        emit forward_dynamics, inverse_dynamics, mass_matrix, bias;
    }
    /// No gravity.
    pub mod arm_without_gravity {
        body post { mass: 4.0, inertia: diag(0.2, 0.2, 0.1) }
        body upper { mass: 1.5, com: 0.9 * X }
        body lower { mass: 0.7, com: 1.1 * X }
        joint waist: Revolute { parent: ground, child: post, axis: Z }
        joint shoulder: Revolute { parent: post.at(0.5 * Z), child: upper, axis: -Y }
        joint elbow: Revolute { parent: upper.at(0.9 * X), child: lower, axis: -Y }
        emit forward_dynamics, inverse_dynamics;
    }
    /// The mass matrix alone.
    pub mod arm_mass_matrix {
        world { gravity: -9.81 * Z }
        body post { mass: 4.0, inertia: diag(0.2, 0.2, 0.1) }
        body upper { mass: 1.5, com: 0.9 * X }
        body lower { mass: 0.7, com: 1.1 * X }
        joint waist: Revolute { parent: ground, child: post, axis: Z }
        joint shoulder: Revolute { parent: post.at(0.5 * Z), child: upper, axis: -Y }
        joint elbow: Revolute { parent: upper.at(0.9 * X), child: lower, axis: -Y }
        emit mass_matrix;
    }
    /// The waist welded: a double pendulum.
    pub mod arm_in_its_plane {
        world { gravity: -9.81 * Z }
        body post { mass: 4.0, inertia: diag(0.2, 0.2, 0.1) }
        body upper { mass: 1.5, com: 0.9 * X }
        body lower { mass: 0.7, com: 1.1 * X }
        joint waist: Fixed { parent: ground, child: post }
        joint shoulder: Revolute { parent: post.at(0.5 * Z), child: upper, axis: -Y }
        joint elbow: Revolute { parent: upper.at(0.9 * X), child: lower, axis: -Y }
        emit forward_dynamics, inverse_dynamics, mass_matrix;
    }
    /// The waist held by a drive.
    pub mod arm_held_in_its_plane {
        world { gravity: -9.81 * Z }
        body post { mass: 4.0, inertia: diag(0.2, 0.2, 0.1) }
        body upper { mass: 1.5, com: 0.9 * X }
        body lower { mass: 0.7, com: 1.1 * X }
        joint waist: Revolute { parent: ground, child: post, axis: Z }
        joint shoulder: Revolute { parent: post.at(0.5 * Z), child: upper, axis: -Y }
        joint elbow: Revolute { parent: upper.at(0.9 * X), child: lower, axis: -Y }
        drive waist.angle = 0.0;
        emit forward_dynamics, inverse_dynamics, mass_matrix;
    }
    /// All axes upright, a slide at the end: gravity does not turn it, and the slide falls by itself.
    pub mod scara {
        world { gravity: -9.81 * Z }
        body upper { mass: 1.5, com: 0.9 * X }
        body lower { mass: 0.7, com: 1.1 * X }
        body quill { mass: 0.3, inertia: diag(0.02, 0.02, 0.01) }
        joint shoulder: Revolute { parent: ground, child: upper, axis: Z }
        joint elbow: Revolute { parent: upper.at(0.9 * X), child: lower, axis: Z }
        joint slide: Prismatic { parent: lower.at(1.1 * X), child: quill, axis: Z }
        emit forward_dynamics, inverse_dynamics;
    }
}

multibody! {
    /// A rod on a cart.
    pub mod cart_pole {
        input push;
        world { gravity: -9.81 * Y }
        body cart { mass: 1.2 }
        body pole { mass: 0.3, com: 0.4 * Y, inertia: rod(0.3, 0.8, Y) }
        joint track: Prismatic { parent: ground, child: cart, axis: X }
        joint hinge: Revolute { parent: cart, child: pole, axis: Z }
        force motor: Effort { joint: track, value: push }
        emit forward_dynamics, inverse_dynamics;
    }
    /// No gravity, no motor.
    pub mod cart_pole_without_gravity {
        body cart { mass: 1.2 }
        body pole { mass: 0.3, com: 0.4 * Y, inertia: rod(0.3, 0.8, Y) }
        joint track: Prismatic { parent: ground, child: cart, axis: X }
        joint hinge: Revolute { parent: cart, child: pole, axis: Z }
        emit forward_dynamics;
    }
    /// The cart driven along: gravity leans.
    pub mod cart_driven {
        world { gravity: -9.81 * Y }
        body cart { mass: 1.2 }
        body pole { mass: 0.3, com: 0.4 * Y, inertia: rod(0.3, 0.8, Y) }
        joint track: Prismatic { parent: ground, child: cart, axis: X }
        joint hinge: Revolute { parent: cart, child: pole, axis: Z }
        drive track.travel = 0.7 * t;
        emit forward_dynamics;
    }
}

multibody! {
    /// 1 four-bar in a row, as parallelograms.
    pub mod parallelograms_1 {
        world { gravity: -9.81 * Y }
        formulation { constraints: Reduced }
        body upright0 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright1 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body bar1 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        joint crank: Revolute { parent: ground, child: upright0, axis: Z }
        joint coupler1: Revolute { parent: upright0.at(0.9 * X), child: bar1, axis: Z }
        joint follower1: Revolute { parent: ground.at(1.0 * X), child: upright1, axis: Z }
        #[cut]
        joint pin1: Revolute { parent: bar1.at(X), child: upright1.at(0.9 * X), axis: Z }
        solve (coupler1, follower1) = (-crank.angle, crank.angle);
        emit forward_dynamics;
    }
}

multibody! {
    /// 2 four-bars in a row, as parallelograms.
    pub mod parallelograms_2 {
        world { gravity: -9.81 * Y }
        formulation { constraints: Reduced }
        body upright0 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright1 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright2 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body bar1 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar2 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        joint crank: Revolute { parent: ground, child: upright0, axis: Z }
        joint coupler1: Revolute { parent: upright0.at(0.9 * X), child: bar1, axis: Z }
        joint follower1: Revolute { parent: ground.at(1.0 * X), child: upright1, axis: Z }
        #[cut]
        joint pin1: Revolute { parent: bar1.at(X), child: upright1.at(0.9 * X), axis: Z }
        joint coupler2: Revolute { parent: upright1.at(0.9 * X), child: bar2, axis: Z }
        joint follower2: Revolute { parent: ground.at(2.0 * X), child: upright2, axis: Z }
        #[cut]
        joint pin2: Revolute { parent: bar2.at(X), child: upright2.at(0.9 * X), axis: Z }
        solve (coupler1, follower1) = (-crank.angle, crank.angle);
        solve (coupler2, follower2) = (-crank.angle, crank.angle);
        emit forward_dynamics;
    }
}

multibody! {
    /// 10 four-bars in a row, as parallelograms.
    pub mod parallelograms_10 {
        world { gravity: -9.81 * Y }
        formulation { constraints: Reduced }
        body upright0 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright1 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright2 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright3 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright4 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright5 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright6 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright7 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright8 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright9 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright10 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body bar1 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar2 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar3 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar4 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar5 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar6 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar7 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar8 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar9 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar10 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        joint crank: Revolute { parent: ground, child: upright0, axis: Z }
        joint coupler1: Revolute { parent: upright0.at(0.9 * X), child: bar1, axis: Z }
        joint follower1: Revolute { parent: ground.at(1.0 * X), child: upright1, axis: Z }
        #[cut]
        joint pin1: Revolute { parent: bar1.at(X), child: upright1.at(0.9 * X), axis: Z }
        joint coupler2: Revolute { parent: upright1.at(0.9 * X), child: bar2, axis: Z }
        joint follower2: Revolute { parent: ground.at(2.0 * X), child: upright2, axis: Z }
        #[cut]
        joint pin2: Revolute { parent: bar2.at(X), child: upright2.at(0.9 * X), axis: Z }
        joint coupler3: Revolute { parent: upright2.at(0.9 * X), child: bar3, axis: Z }
        joint follower3: Revolute { parent: ground.at(3.0 * X), child: upright3, axis: Z }
        #[cut]
        joint pin3: Revolute { parent: bar3.at(X), child: upright3.at(0.9 * X), axis: Z }
        joint coupler4: Revolute { parent: upright3.at(0.9 * X), child: bar4, axis: Z }
        joint follower4: Revolute { parent: ground.at(4.0 * X), child: upright4, axis: Z }
        #[cut]
        joint pin4: Revolute { parent: bar4.at(X), child: upright4.at(0.9 * X), axis: Z }
        joint coupler5: Revolute { parent: upright4.at(0.9 * X), child: bar5, axis: Z }
        joint follower5: Revolute { parent: ground.at(5.0 * X), child: upright5, axis: Z }
        #[cut]
        joint pin5: Revolute { parent: bar5.at(X), child: upright5.at(0.9 * X), axis: Z }
        joint coupler6: Revolute { parent: upright5.at(0.9 * X), child: bar6, axis: Z }
        joint follower6: Revolute { parent: ground.at(6.0 * X), child: upright6, axis: Z }
        #[cut]
        joint pin6: Revolute { parent: bar6.at(X), child: upright6.at(0.9 * X), axis: Z }
        joint coupler7: Revolute { parent: upright6.at(0.9 * X), child: bar7, axis: Z }
        joint follower7: Revolute { parent: ground.at(7.0 * X), child: upright7, axis: Z }
        #[cut]
        joint pin7: Revolute { parent: bar7.at(X), child: upright7.at(0.9 * X), axis: Z }
        joint coupler8: Revolute { parent: upright7.at(0.9 * X), child: bar8, axis: Z }
        joint follower8: Revolute { parent: ground.at(8.0 * X), child: upright8, axis: Z }
        #[cut]
        joint pin8: Revolute { parent: bar8.at(X), child: upright8.at(0.9 * X), axis: Z }
        joint coupler9: Revolute { parent: upright8.at(0.9 * X), child: bar9, axis: Z }
        joint follower9: Revolute { parent: ground.at(9.0 * X), child: upright9, axis: Z }
        #[cut]
        joint pin9: Revolute { parent: bar9.at(X), child: upright9.at(0.9 * X), axis: Z }
        joint coupler10: Revolute { parent: upright9.at(0.9 * X), child: bar10, axis: Z }
        joint follower10: Revolute { parent: ground.at(10.0 * X), child: upright10, axis: Z }
        #[cut]
        joint pin10: Revolute { parent: bar10.at(X), child: upright10.at(0.9 * X), axis: Z }
        solve (coupler1, follower1) = (-crank.angle, crank.angle);
        solve (coupler2, follower2) = (-crank.angle, crank.angle);
        solve (coupler3, follower3) = (-crank.angle, crank.angle);
        solve (coupler4, follower4) = (-crank.angle, crank.angle);
        solve (coupler5, follower5) = (-crank.angle, crank.angle);
        solve (coupler6, follower6) = (-crank.angle, crank.angle);
        solve (coupler7, follower7) = (-crank.angle, crank.angle);
        solve (coupler8, follower8) = (-crank.angle, crank.angle);
        solve (coupler9, follower9) = (-crank.angle, crank.angle);
        solve (coupler10, follower10) = (-crank.angle, crank.angle);
        emit forward_dynamics;
    }
}

multibody! {
    /// 40 four-bars in a row, as parallelograms.
    pub mod parallelograms_40 {
        world { gravity: -9.81 * Y }
        formulation { constraints: Reduced }
        body upright0 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright1 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright2 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright3 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright4 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright5 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright6 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright7 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright8 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright9 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright10 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright11 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright12 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright13 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright14 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright15 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright16 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright17 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright18 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright19 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright20 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright21 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright22 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright23 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright24 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright25 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright26 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright27 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright28 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright29 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright30 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright31 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright32 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright33 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright34 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright35 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright36 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright37 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright38 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright39 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body upright40 { mass: 1.1, com: 0.45 * X, inertia: rod(1.1, 0.9, X) }
        body bar1 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar2 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar3 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar4 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar5 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar6 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar7 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar8 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar9 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar10 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar11 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar12 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar13 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar14 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar15 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar16 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar17 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar18 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar19 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar20 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar21 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar22 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar23 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar24 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar25 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar26 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar27 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar28 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar29 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar30 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar31 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar32 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar33 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar34 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar35 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar36 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar37 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar38 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar39 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        body bar40 { mass: 1.3, com: 0.5 * X, inertia: rod(1.3, 1.0, X) }
        joint crank: Revolute { parent: ground, child: upright0, axis: Z }
        joint coupler1: Revolute { parent: upright0.at(0.9 * X), child: bar1, axis: Z }
        joint follower1: Revolute { parent: ground.at(1.0 * X), child: upright1, axis: Z }
        #[cut]
        joint pin1: Revolute { parent: bar1.at(X), child: upright1.at(0.9 * X), axis: Z }
        joint coupler2: Revolute { parent: upright1.at(0.9 * X), child: bar2, axis: Z }
        joint follower2: Revolute { parent: ground.at(2.0 * X), child: upright2, axis: Z }
        #[cut]
        joint pin2: Revolute { parent: bar2.at(X), child: upright2.at(0.9 * X), axis: Z }
        joint coupler3: Revolute { parent: upright2.at(0.9 * X), child: bar3, axis: Z }
        joint follower3: Revolute { parent: ground.at(3.0 * X), child: upright3, axis: Z }
        #[cut]
        joint pin3: Revolute { parent: bar3.at(X), child: upright3.at(0.9 * X), axis: Z }
        joint coupler4: Revolute { parent: upright3.at(0.9 * X), child: bar4, axis: Z }
        joint follower4: Revolute { parent: ground.at(4.0 * X), child: upright4, axis: Z }
        #[cut]
        joint pin4: Revolute { parent: bar4.at(X), child: upright4.at(0.9 * X), axis: Z }
        joint coupler5: Revolute { parent: upright4.at(0.9 * X), child: bar5, axis: Z }
        joint follower5: Revolute { parent: ground.at(5.0 * X), child: upright5, axis: Z }
        #[cut]
        joint pin5: Revolute { parent: bar5.at(X), child: upright5.at(0.9 * X), axis: Z }
        joint coupler6: Revolute { parent: upright5.at(0.9 * X), child: bar6, axis: Z }
        joint follower6: Revolute { parent: ground.at(6.0 * X), child: upright6, axis: Z }
        #[cut]
        joint pin6: Revolute { parent: bar6.at(X), child: upright6.at(0.9 * X), axis: Z }
        joint coupler7: Revolute { parent: upright6.at(0.9 * X), child: bar7, axis: Z }
        joint follower7: Revolute { parent: ground.at(7.0 * X), child: upright7, axis: Z }
        #[cut]
        joint pin7: Revolute { parent: bar7.at(X), child: upright7.at(0.9 * X), axis: Z }
        joint coupler8: Revolute { parent: upright7.at(0.9 * X), child: bar8, axis: Z }
        joint follower8: Revolute { parent: ground.at(8.0 * X), child: upright8, axis: Z }
        #[cut]
        joint pin8: Revolute { parent: bar8.at(X), child: upright8.at(0.9 * X), axis: Z }
        joint coupler9: Revolute { parent: upright8.at(0.9 * X), child: bar9, axis: Z }
        joint follower9: Revolute { parent: ground.at(9.0 * X), child: upright9, axis: Z }
        #[cut]
        joint pin9: Revolute { parent: bar9.at(X), child: upright9.at(0.9 * X), axis: Z }
        joint coupler10: Revolute { parent: upright9.at(0.9 * X), child: bar10, axis: Z }
        joint follower10: Revolute { parent: ground.at(10.0 * X), child: upright10, axis: Z }
        #[cut]
        joint pin10: Revolute { parent: bar10.at(X), child: upright10.at(0.9 * X), axis: Z }
        joint coupler11: Revolute { parent: upright10.at(0.9 * X), child: bar11, axis: Z }
        joint follower11: Revolute { parent: ground.at(11.0 * X), child: upright11, axis: Z }
        #[cut]
        joint pin11: Revolute { parent: bar11.at(X), child: upright11.at(0.9 * X), axis: Z }
        joint coupler12: Revolute { parent: upright11.at(0.9 * X), child: bar12, axis: Z }
        joint follower12: Revolute { parent: ground.at(12.0 * X), child: upright12, axis: Z }
        #[cut]
        joint pin12: Revolute { parent: bar12.at(X), child: upright12.at(0.9 * X), axis: Z }
        joint coupler13: Revolute { parent: upright12.at(0.9 * X), child: bar13, axis: Z }
        joint follower13: Revolute { parent: ground.at(13.0 * X), child: upright13, axis: Z }
        #[cut]
        joint pin13: Revolute { parent: bar13.at(X), child: upright13.at(0.9 * X), axis: Z }
        joint coupler14: Revolute { parent: upright13.at(0.9 * X), child: bar14, axis: Z }
        joint follower14: Revolute { parent: ground.at(14.0 * X), child: upright14, axis: Z }
        #[cut]
        joint pin14: Revolute { parent: bar14.at(X), child: upright14.at(0.9 * X), axis: Z }
        joint coupler15: Revolute { parent: upright14.at(0.9 * X), child: bar15, axis: Z }
        joint follower15: Revolute { parent: ground.at(15.0 * X), child: upright15, axis: Z }
        #[cut]
        joint pin15: Revolute { parent: bar15.at(X), child: upright15.at(0.9 * X), axis: Z }
        joint coupler16: Revolute { parent: upright15.at(0.9 * X), child: bar16, axis: Z }
        joint follower16: Revolute { parent: ground.at(16.0 * X), child: upright16, axis: Z }
        #[cut]
        joint pin16: Revolute { parent: bar16.at(X), child: upright16.at(0.9 * X), axis: Z }
        joint coupler17: Revolute { parent: upright16.at(0.9 * X), child: bar17, axis: Z }
        joint follower17: Revolute { parent: ground.at(17.0 * X), child: upright17, axis: Z }
        #[cut]
        joint pin17: Revolute { parent: bar17.at(X), child: upright17.at(0.9 * X), axis: Z }
        joint coupler18: Revolute { parent: upright17.at(0.9 * X), child: bar18, axis: Z }
        joint follower18: Revolute { parent: ground.at(18.0 * X), child: upright18, axis: Z }
        #[cut]
        joint pin18: Revolute { parent: bar18.at(X), child: upright18.at(0.9 * X), axis: Z }
        joint coupler19: Revolute { parent: upright18.at(0.9 * X), child: bar19, axis: Z }
        joint follower19: Revolute { parent: ground.at(19.0 * X), child: upright19, axis: Z }
        #[cut]
        joint pin19: Revolute { parent: bar19.at(X), child: upright19.at(0.9 * X), axis: Z }
        joint coupler20: Revolute { parent: upright19.at(0.9 * X), child: bar20, axis: Z }
        joint follower20: Revolute { parent: ground.at(20.0 * X), child: upright20, axis: Z }
        #[cut]
        joint pin20: Revolute { parent: bar20.at(X), child: upright20.at(0.9 * X), axis: Z }
        joint coupler21: Revolute { parent: upright20.at(0.9 * X), child: bar21, axis: Z }
        joint follower21: Revolute { parent: ground.at(21.0 * X), child: upright21, axis: Z }
        #[cut]
        joint pin21: Revolute { parent: bar21.at(X), child: upright21.at(0.9 * X), axis: Z }
        joint coupler22: Revolute { parent: upright21.at(0.9 * X), child: bar22, axis: Z }
        joint follower22: Revolute { parent: ground.at(22.0 * X), child: upright22, axis: Z }
        #[cut]
        joint pin22: Revolute { parent: bar22.at(X), child: upright22.at(0.9 * X), axis: Z }
        joint coupler23: Revolute { parent: upright22.at(0.9 * X), child: bar23, axis: Z }
        joint follower23: Revolute { parent: ground.at(23.0 * X), child: upright23, axis: Z }
        #[cut]
        joint pin23: Revolute { parent: bar23.at(X), child: upright23.at(0.9 * X), axis: Z }
        joint coupler24: Revolute { parent: upright23.at(0.9 * X), child: bar24, axis: Z }
        joint follower24: Revolute { parent: ground.at(24.0 * X), child: upright24, axis: Z }
        #[cut]
        joint pin24: Revolute { parent: bar24.at(X), child: upright24.at(0.9 * X), axis: Z }
        joint coupler25: Revolute { parent: upright24.at(0.9 * X), child: bar25, axis: Z }
        joint follower25: Revolute { parent: ground.at(25.0 * X), child: upright25, axis: Z }
        #[cut]
        joint pin25: Revolute { parent: bar25.at(X), child: upright25.at(0.9 * X), axis: Z }
        joint coupler26: Revolute { parent: upright25.at(0.9 * X), child: bar26, axis: Z }
        joint follower26: Revolute { parent: ground.at(26.0 * X), child: upright26, axis: Z }
        #[cut]
        joint pin26: Revolute { parent: bar26.at(X), child: upright26.at(0.9 * X), axis: Z }
        joint coupler27: Revolute { parent: upright26.at(0.9 * X), child: bar27, axis: Z }
        joint follower27: Revolute { parent: ground.at(27.0 * X), child: upright27, axis: Z }
        #[cut]
        joint pin27: Revolute { parent: bar27.at(X), child: upright27.at(0.9 * X), axis: Z }
        joint coupler28: Revolute { parent: upright27.at(0.9 * X), child: bar28, axis: Z }
        joint follower28: Revolute { parent: ground.at(28.0 * X), child: upright28, axis: Z }
        #[cut]
        joint pin28: Revolute { parent: bar28.at(X), child: upright28.at(0.9 * X), axis: Z }
        joint coupler29: Revolute { parent: upright28.at(0.9 * X), child: bar29, axis: Z }
        joint follower29: Revolute { parent: ground.at(29.0 * X), child: upright29, axis: Z }
        #[cut]
        joint pin29: Revolute { parent: bar29.at(X), child: upright29.at(0.9 * X), axis: Z }
        joint coupler30: Revolute { parent: upright29.at(0.9 * X), child: bar30, axis: Z }
        joint follower30: Revolute { parent: ground.at(30.0 * X), child: upright30, axis: Z }
        #[cut]
        joint pin30: Revolute { parent: bar30.at(X), child: upright30.at(0.9 * X), axis: Z }
        joint coupler31: Revolute { parent: upright30.at(0.9 * X), child: bar31, axis: Z }
        joint follower31: Revolute { parent: ground.at(31.0 * X), child: upright31, axis: Z }
        #[cut]
        joint pin31: Revolute { parent: bar31.at(X), child: upright31.at(0.9 * X), axis: Z }
        joint coupler32: Revolute { parent: upright31.at(0.9 * X), child: bar32, axis: Z }
        joint follower32: Revolute { parent: ground.at(32.0 * X), child: upright32, axis: Z }
        #[cut]
        joint pin32: Revolute { parent: bar32.at(X), child: upright32.at(0.9 * X), axis: Z }
        joint coupler33: Revolute { parent: upright32.at(0.9 * X), child: bar33, axis: Z }
        joint follower33: Revolute { parent: ground.at(33.0 * X), child: upright33, axis: Z }
        #[cut]
        joint pin33: Revolute { parent: bar33.at(X), child: upright33.at(0.9 * X), axis: Z }
        joint coupler34: Revolute { parent: upright33.at(0.9 * X), child: bar34, axis: Z }
        joint follower34: Revolute { parent: ground.at(34.0 * X), child: upright34, axis: Z }
        #[cut]
        joint pin34: Revolute { parent: bar34.at(X), child: upright34.at(0.9 * X), axis: Z }
        joint coupler35: Revolute { parent: upright34.at(0.9 * X), child: bar35, axis: Z }
        joint follower35: Revolute { parent: ground.at(35.0 * X), child: upright35, axis: Z }
        #[cut]
        joint pin35: Revolute { parent: bar35.at(X), child: upright35.at(0.9 * X), axis: Z }
        joint coupler36: Revolute { parent: upright35.at(0.9 * X), child: bar36, axis: Z }
        joint follower36: Revolute { parent: ground.at(36.0 * X), child: upright36, axis: Z }
        #[cut]
        joint pin36: Revolute { parent: bar36.at(X), child: upright36.at(0.9 * X), axis: Z }
        joint coupler37: Revolute { parent: upright36.at(0.9 * X), child: bar37, axis: Z }
        joint follower37: Revolute { parent: ground.at(37.0 * X), child: upright37, axis: Z }
        #[cut]
        joint pin37: Revolute { parent: bar37.at(X), child: upright37.at(0.9 * X), axis: Z }
        joint coupler38: Revolute { parent: upright37.at(0.9 * X), child: bar38, axis: Z }
        joint follower38: Revolute { parent: ground.at(38.0 * X), child: upright38, axis: Z }
        #[cut]
        joint pin38: Revolute { parent: bar38.at(X), child: upright38.at(0.9 * X), axis: Z }
        joint coupler39: Revolute { parent: upright38.at(0.9 * X), child: bar39, axis: Z }
        joint follower39: Revolute { parent: ground.at(39.0 * X), child: upright39, axis: Z }
        #[cut]
        joint pin39: Revolute { parent: bar39.at(X), child: upright39.at(0.9 * X), axis: Z }
        joint coupler40: Revolute { parent: upright39.at(0.9 * X), child: bar40, axis: Z }
        joint follower40: Revolute { parent: ground.at(40.0 * X), child: upright40, axis: Z }
        #[cut]
        joint pin40: Revolute { parent: bar40.at(X), child: upright40.at(0.9 * X), axis: Z }
        solve (coupler1, follower1) = (-crank.angle, crank.angle);
        solve (coupler2, follower2) = (-crank.angle, crank.angle);
        solve (coupler3, follower3) = (-crank.angle, crank.angle);
        solve (coupler4, follower4) = (-crank.angle, crank.angle);
        solve (coupler5, follower5) = (-crank.angle, crank.angle);
        solve (coupler6, follower6) = (-crank.angle, crank.angle);
        solve (coupler7, follower7) = (-crank.angle, crank.angle);
        solve (coupler8, follower8) = (-crank.angle, crank.angle);
        solve (coupler9, follower9) = (-crank.angle, crank.angle);
        solve (coupler10, follower10) = (-crank.angle, crank.angle);
        solve (coupler11, follower11) = (-crank.angle, crank.angle);
        solve (coupler12, follower12) = (-crank.angle, crank.angle);
        solve (coupler13, follower13) = (-crank.angle, crank.angle);
        solve (coupler14, follower14) = (-crank.angle, crank.angle);
        solve (coupler15, follower15) = (-crank.angle, crank.angle);
        solve (coupler16, follower16) = (-crank.angle, crank.angle);
        solve (coupler17, follower17) = (-crank.angle, crank.angle);
        solve (coupler18, follower18) = (-crank.angle, crank.angle);
        solve (coupler19, follower19) = (-crank.angle, crank.angle);
        solve (coupler20, follower20) = (-crank.angle, crank.angle);
        solve (coupler21, follower21) = (-crank.angle, crank.angle);
        solve (coupler22, follower22) = (-crank.angle, crank.angle);
        solve (coupler23, follower23) = (-crank.angle, crank.angle);
        solve (coupler24, follower24) = (-crank.angle, crank.angle);
        solve (coupler25, follower25) = (-crank.angle, crank.angle);
        solve (coupler26, follower26) = (-crank.angle, crank.angle);
        solve (coupler27, follower27) = (-crank.angle, crank.angle);
        solve (coupler28, follower28) = (-crank.angle, crank.angle);
        solve (coupler29, follower29) = (-crank.angle, crank.angle);
        solve (coupler30, follower30) = (-crank.angle, crank.angle);
        solve (coupler31, follower31) = (-crank.angle, crank.angle);
        solve (coupler32, follower32) = (-crank.angle, crank.angle);
        solve (coupler33, follower33) = (-crank.angle, crank.angle);
        solve (coupler34, follower34) = (-crank.angle, crank.angle);
        solve (coupler35, follower35) = (-crank.angle, crank.angle);
        solve (coupler36, follower36) = (-crank.angle, crank.angle);
        solve (coupler37, follower37) = (-crank.angle, crank.angle);
        solve (coupler38, follower38) = (-crank.angle, crank.angle);
        solve (coupler39, follower39) = (-crank.angle, crank.angle);
        solve (coupler40, follower40) = (-crank.angle, crank.angle);
        emit forward_dynamics;
    }
}

multibody! {
    /// A slider-crank whose slider's line goes through the shaft; masses at the pins.
    pub mod slider_crank {
        formulation { constraints: Reduced }
        body crank { mass: 1.1, com: 0.3 * X }
        body rod { mass: 0.0 }
        body piston { mass: 0.7 }
        joint shaft: Revolute { parent: ground, child: crank, axis: Z }
        joint big_end: Revolute { parent: crank.at(0.3 * X), child: rod, axis: Z }
        joint slide: Prismatic { parent: ground, child: piston, axis: X }
        #[cut]
        joint small_end: Revolute { parent: rod.at(X), child: piston, axis: Z }
        solve (big_end, slide) from small_end { cos(shaft + big_end) > 0.0 }
        emit forward_dynamics;
    }
    /// In gravity across the line.
    pub mod slider_crank_in_gravity {
        world { gravity: -9.81 * Y }
        formulation { constraints: Reduced }
        body crank { mass: 1.1, com: 0.3 * X }
        body rod { mass: 0.0 }
        body piston { mass: 0.7 }
        joint shaft: Revolute { parent: ground, child: crank, axis: Z }
        joint big_end: Revolute { parent: crank.at(0.3 * X), child: rod, axis: Z }
        joint slide: Prismatic { parent: ground, child: piston, axis: X }
        #[cut]
        joint small_end: Revolute { parent: rod.at(X), child: piston, axis: Z }
        solve (big_end, slide) from small_end { cos(shaft + big_end) > 0.0 }
        emit forward_dynamics;
    }
    /// The piston alone seen.
    pub mod slider_crank_seen {
        formulation { constraints: Reduced }
        body crank { mass: 1.1, com: 0.3 * X }
        body rod { mass: 0.0 }
        body piston { mass: 0.7 }
        joint shaft: Revolute { parent: ground, child: crank, axis: Z }
        joint big_end: Revolute { parent: crank.at(0.3 * X), child: rod, axis: Z }
        joint slide: Prismatic { parent: ground, child: piston, axis: X }
        #[cut]
        joint small_end: Revolute { parent: rod.at(X), child: piston, axis: Z }
        solve (big_end, slide) from small_end { cos(shaft + big_end) > 0.0 }
        output stroke = slide.travel;
    }
}
