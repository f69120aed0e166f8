//! The words of the language as items, for editors.
//!
//! Expansions name a word here for each that stands in a model, at the place where it stands, in bodies that nobody
//! calls: so an editor shows what is said of it, and completes it. The engine's tests hold the words against the tables
//! by which models are checked.

/// What bodies of functions that nobody calls are generic over: nothing implements it, so nothing is ever computed.
pub trait Never: sealed::Never {
    /// Is never called.
    fn any<T>() -> T;
}

mod sealed {
    /// Nothing implements it.
    pub trait Never {}
}

/// Types of the language.
pub mod ty {
    /// A number.
    pub struct Scalar;

    /// Three numbers: `[a, b, c]`, or made of the unit vectors `X`, `Y` and `Z`.
    pub struct Vec3;

    /// An orientation.
    pub struct Rotation;

    /// A position and an orientation.
    pub struct Pose;

    /// A linear and an angular velocity.
    pub struct Twist;

    /// A force and a moment.
    pub struct Wrench;

    /// Six rows, linear then angular, and a column for each velocity of the state.
    pub struct Jacobian;

    /// A place and axes fixed to a body: `ground`, a body, a port, and those with `.at(offset)`, `.rotated(axis, angle)`
    /// or `.oriented(matrix)`.
    pub struct Frame;

    /// The name of a joint, or one of its coordinates.
    pub struct Joint;

    /// Moments and products of inertia: `diag(..)`, `inertia(..)`, `rod(..)`, `cuboid(..)`, `cylinder(..)` or
    /// `sphere(..)`.
    pub struct Inertia;

    /// Several values in brackets.
    pub struct List;
}

/// What a name was declared as.
pub mod name {
    /// A number that becomes a literal in the code.
    pub struct Const;

    /// A field of `Params`, with its default.
    pub struct Param;

    /// A field of `Input`, given with every call.
    pub struct Input;

    /// A name for an expression, a frame or a joint.
    pub struct Let;

    /// A velocity coordinate of the user's choice, a field of `Velocity`.
    pub struct Speed;

    /// A field of `Output`.
    pub struct Output;

    /// A quantity with a differential equation of its own, a field of `States`.
    pub struct State;

    /// A frame by which a part is connected.
    pub struct Port;

    /// A rigid body or a point mass, and its frame.
    pub struct Body;

    /// How two frames may move relative to each other.
    pub struct Joint;

    /// What acts.
    pub struct Force;

    /// What is held at zero.
    pub struct Constraint;

    /// A part, or an array of them.
    pub struct Part;

    /// What equations of the model's own are solved for.
    pub struct Unknown;

    /// Counts the parts of an array, from zero.
    pub struct Index;

    /// An expression of arguments, expanded where it is called.
    pub struct Function;

    /// What is given to a function where it is called.
    pub struct Argument;

    /// A function of your own Rust: a type that implements `multibody::Function`.
    pub struct Extern;
}

/// Items whose fields stand in braces.
pub mod item {
    use super::ty::{Inertia, List, Scalar, Vec3};

    /// `world { .. }`
    pub struct World {
        /// `[m/s^2]` in world axes; without it there is none.
        pub gravity: Vec3,
    }

    /// `formulation { .. }`: how the equations are set up.
    pub struct Formulation {
        /// `Joint`, `Absolute(RollPitchYaw)` or `Absolute(Quaternion)`, for all bodies.
        pub coordinates: super::coordinates::Absolute,
        /// What becomes of equations of loops: `Multipliers`, `Reduced`, `Stabilised` or `Auto`.
        pub constraints: super::handling::Reduced,
        /// Coordinates that stay in the state.
        pub independent: List,
        /// Rounds of Newton's method where it closes loops: 6, or what is written here. Each doubles the digits of the guess. What is
        /// found alone takes 3, or as many as reach the same order, which triple them.
        pub rounds: Scalar,
        /// Whether limbs that are alike are computed together: `Off`, or `Four` at a time at most.
        pub packs: super::packs::Four,
        /// Velocity coordinates: `Rates` of coordinates, or `Auto`, by the counts of several choices.
        pub speeds: super::speeds::Auto,
        /// `[1/s]` of `Stabilised`: the factor of the residual's derivative.
        pub rate: Scalar,
        /// `[1/s^2]` of `Stabilised`: the factor of the residual.
        pub position: Scalar,
    }

    /// `body name { .. }`: a rigid body or a point mass.
    pub struct Body {
        /// `[kg]` May be zero, for a frame between two joints, and may follow states of the model.
        pub mass: Scalar,
        /// `[m]` The centre of mass in the body's frame; its origin if left out.
        pub com: Vec3,
        /// `[kg m^2]` About the centre of mass, in the body's axes; a point mass if left out.
        pub inertia: Inertia,
        /// `Joint`, `Absolute(RollPitchYaw)` or `Absolute(Quaternion)`.
        pub coordinates: super::coordinates::Absolute,
    }
}

/// Kinds of joints.
pub mod joint {
    use super::coordinates::Quaternion;
    use super::ty::{Frame, List, Scalar, Vec3};

    /// Holds everything.
    pub struct Fixed {
        /// The frame on which the child is fixed.
        pub parent: Frame,
        /// The frame that is fixed.
        pub child: Frame,
    }

    /// Turns about an axis. Coordinate: `angle`, `[rad]`; effort: `[N m]`.
    pub struct Revolute {
        /// The frame that carries the joint.
        pub parent: Frame,
        /// The frame that turns.
        pub child: Frame,
        /// In the joint's frames, of any length but zero; angles are positive by the right-hand rule.
        pub axis: Vec3,
        /// `[kg m^2]` Inertia that the coordinate feels beside that of the bodies, such as a rotor's.
        pub armature: Scalar,
    }

    /// Slides along an axis. Coordinate: `travel`, `[m]`; effort: `[N]`.
    pub struct Prismatic {
        /// The frame that carries the joint.
        pub parent: Frame,
        /// The frame that slides.
        pub child: Frame,
        /// In the joint's frames, of any length but zero.
        pub axis: Vec3,
        /// `[kg]` Inertia that the coordinate feels beside that of the bodies.
        pub armature: Scalar,
    }

    /// Turns about an axis and travels along it in proportion. Coordinate: `angle`, `[rad]`; effort: `[N m]`.
    pub struct Screw {
        /// The frame that carries the joint.
        pub parent: Frame,
        /// The frame that turns and travels.
        pub child: Frame,
        /// In the joint's frames, of any length but zero.
        pub axis: Vec3,
        /// `[m/rad]` Travel per angle, right-handed.
        pub pitch: Scalar,
        /// `[kg m^2]` Inertia that the coordinate feels beside that of the bodies.
        pub armature: Scalar,
    }

    /// Slides along an axis and turns about it. Coordinates: `travel`, `[m]`, and `angle`, `[rad]`.
    pub struct Cylindrical {
        /// The frame that carries the joint.
        pub parent: Frame,
        /// The frame that slides and turns.
        pub child: Frame,
        /// In the joint's frames, of any length but zero.
        pub axis: Vec3,
    }

    /// Turns about its first axis, then about the second, which the first carries along. Coordinates: `first` and
    /// `second`, `[rad]`.
    pub struct Universal {
        /// The frame that carries the joint.
        pub parent: Frame,
        /// The frame that turns.
        pub child: Frame,
        /// `[a, b]`, perpendicular to each other.
        pub axes: List,
    }

    /// Slides in a plane and turns about its normal. Coordinates: `x` and `y`, `[m]`, and `angle`, `[rad]`.
    pub struct Planar {
        /// The frame that carries the joint.
        pub parent: Frame,
        /// The frame that slides and turns.
        pub child: Frame,
        /// The plane's normal; or `axes` in its place.
        pub axis: Vec3,
        /// `[a, b]`: the directions of `x` and `y`; `angle` turns the first towards the second.
        pub axes: List,
    }

    /// A pin in a slot. Coordinates: `travel` along the slot, `[m]`, and `angle`, `[rad]`.
    pub struct PinSlot {
        /// The frame that has the slot.
        pub parent: Frame,
        /// The frame that has the pin.
        pub child: Frame,
        /// The pin's axis.
        pub axis: Vec3,
        /// The direction of the slot, perpendicular to `axis`.
        pub slide: Vec3,
    }

    /// Turns in all directions about a point. Coordinates: a quaternion, or `roll`, `pitch` and `yaw`.
    pub struct Ball {
        /// The frame that carries the joint.
        pub parent: Frame,
        /// The frame that turns.
        pub child: Frame,
        /// `Quaternion` (if left out) or `RollPitchYaw`.
        pub coordinates: Quaternion,
    }

    /// Holds nothing. Coordinates: `x`, `y`, `z` and a quaternion, or `roll`, `pitch` and `yaw`.
    pub struct Free {
        /// The frame in whose axes the position is measured.
        pub parent: Frame,
        /// The frame that moves.
        pub child: Frame,
        /// `Quaternion` (if left out) or `RollPitchYaw`.
        pub coordinates: Quaternion,
    }
}

/// Kinds of forces.
pub mod force {
    use super::ty::{Frame, Joint, List, Scalar, Vec3};

    /// Acts on a coordinate, or on all of a joint's.
    pub struct Effort {
        /// A joint, or one coordinate of it.
        pub joint: Joint,
        /// `[N]` or `[N m]`; for all coordinates of a joint a `Vec3` or an array.
        pub value: Scalar,
    }

    /// On a coordinate `-stiffness * (q - rest)`, or between two points `stiffness * (distance - length)`.
    pub struct Spring {
        /// A joint, or one coordinate of it.
        pub joint: Joint,
        /// `[frame, frame]`: the two points.
        pub between: List,
        /// `[N/m]`, or `[N m/rad]`.
        pub stiffness: Scalar,
        /// Where it is relaxed, on a joint; zero if left out.
        pub rest: Scalar,
        /// `[m]` At which it is relaxed, between points.
        pub length: Scalar,
    }

    /// On a coordinate `-damping * rate`, or between two points.
    pub struct Damper {
        /// A joint, or one coordinate of it.
        pub joint: Joint,
        /// `[frame, frame]`: the two points.
        pub between: List,
        /// `[N s/m]`, or `[N m s/rad]`.
        pub damping: Scalar,
    }

    /// A spring and a damper in one place.
    pub struct SpringDamper {
        /// A joint, or one coordinate of it.
        pub joint: Joint,
        /// `[frame, frame]`: the two points.
        pub between: List,
        /// `[N/m]`, or `[N m/rad]`.
        pub stiffness: Scalar,
        /// `[N s/m]`, or `[N m s/rad]`.
        pub damping: Scalar,
        /// Where it is relaxed, on a joint; zero if left out.
        pub rest: Scalar,
        /// `[m]` At which it is relaxed, between points.
        pub length: Scalar,
    }

    /// Acts at a point of one body; nothing acts back on another.
    pub struct Force {
        /// At whose origin it acts.
        pub at: Frame,
        /// `[N]`
        pub value: Vec3,
        /// In whose axes the value is given.
        pub axes: Frame,
    }

    /// A moment on one body; nothing acts back on another.
    pub struct Torque {
        /// On whose body it acts.
        pub at: Frame,
        /// `[N m]`
        pub value: Vec3,
        /// In whose axes the value is given.
        pub axes: Frame,
    }

    /// Pushes two bodies apart where they touch, and rubs: it has `force`, `contact`, `gap`, `slip`, `power`, `stored`.
    pub struct Contact {
        /// The point, or the centre of the ball or disc.
        pub at: Frame,
        /// `[m]`, of the ball or disc; a point has none.
        pub radius: Scalar,
        /// Of a thin disc, its axle in axes of `at`.
        pub axis: Vec3,
        /// Its z axis stands on the plane, to the side of `at`; the ground's where it is left out.
        pub on: Frame,
        /// The centre of another ball in place of a plane.
        pub ball: Frame,
        /// `[m]`
        pub ball_radius: Scalar,
        /// `[N/m^exponent]`
        pub stiffness: Scalar,
        /// `[s/m]`: the force is as many times greater as the depth grows faster.
        pub damping: Scalar,
        /// Of the depth, at least 1; 1.5 where it is left out.
        pub exponent: Scalar,
        /// Coulomb's coefficient; none where it is left out.
        pub friction: Scalar,
        /// `[m/s]`, below which friction is like a damper; 0.01 where it is left out.
        pub slip_speed: Scalar,
    }
}

/// Kinds of constraints.
pub mod constraint {
    use super::ty::{Frame, List, Scalar, Vec3};

    /// Holds the distance between the origins of two frames.
    pub struct Rod {
        /// `[frame, frame]`
        pub between: List,
        /// `[m]`, positive.
        pub length: Scalar,
    }

    /// A disc or a ball that rolls on a plane: it has `touch`, `along`, `across`, `contact`, `slip`, `force`.
    pub struct Rolling {
        /// With its origin at the centre.
        pub wheel: Frame,
        /// Of a thin disc, its axle in axes of `wheel`; a ball has none.
        pub axis: Vec3,
        /// `[m]`, positive.
        pub radius: Scalar,
        /// Its z axis stands on the plane, to the side of the wheel; the ground's where it is left out.
        pub on: Frame,
    }

    /// A blade that runs along its edge: it has `across`, `slip`, `force`.
    pub struct Skate {
        /// With its origin where the blade cuts.
        pub blade: Frame,
        /// The edge, in axes of `blade`.
        pub along: Vec3,
        /// Its z axis stands on the plane; the ground's where it is left out.
        pub on: Frame,
    }
}

/// Which coordinates a body or a joint has.
pub mod coordinates {
    /// Those of the joint that a body hangs on.
    pub struct Joint;

    /// Six of the body's own: `Absolute(RollPitchYaw)` or `Absolute(Quaternion)`.
    pub struct Absolute;

    /// The orientation is a quaternion.
    pub struct Quaternion;

    /// The orientation is `Rz(yaw) * Ry(pitch) * Rx(roll)`, singular where the pitch is a right angle.
    pub struct RollPitchYaw;
}

/// What becomes of equations of loops.
pub mod handling {
    /// They stay, with a multiplier each.
    pub struct Multipliers;

    /// Dependent coordinates are eliminated.
    pub struct Reduced;

    /// They stay, with Baumgarte's terms: `a + rate * v + position * r = 0`.
    pub struct Stabilised;

    /// `Reduced` or `Multipliers`, by the counts of both.
    pub struct Auto;
}

/// Whether limbs that are alike are computed together.
pub mod packs {
    /// One after the other.
    pub struct Off;

    /// Four at a time, and two where that is what is left, if that is worth it.
    pub struct Four;
}

/// Which velocity coordinates a model has, where no `speed` items say so.
pub mod speeds {
    /// The rates of coordinates.
    pub struct Rates;

    /// Those, or components of velocities of bodies, by the counts of several choices.
    pub struct Auto;
}

/// What `emit` asks for.
// They are written as functions are.
#[allow(non_camel_case_types)]
pub mod emit {
    use super::ty::List;

    /// Accelerations; the model is then a [`System`](crate::System), which integrators take.
    pub struct forward_dynamics;

    /// Efforts that given accelerations need.
    pub struct inverse_dynamics {
        /// Inputs to find in place of efforts.
        pub solve_for: List,
    }

    /// `M` of `M * accel + bias = effort`.
    pub struct mass_matrix;

    /// What is on and below the diagonal of the mass matrix.
    pub struct mass_matrix_lower;

    /// `bias` of `M * accel + bias = effort`: the efforts at zero acceleration.
    pub struct bias;

    /// `kinetic_energy` and `potential_energy`.
    pub struct energy;

    /// What is held at zero, its Jacobian, rate and bias.
    pub struct constraints;

    /// The equations as a residual, for solvers of differential-algebraic equations.
    pub struct residual;

    /// Coordinates with their rates and accelerations from others.
    pub struct kinematics {
        /// Joints, and bodies with `.pose` where their pose is a coordinate.
        pub given: List,
        /// Coordinates, and joints for all of theirs.
        pub find: List,
    }

    /// All positions that what is given leaves.
    pub struct assembly_modes {
        /// Joints.
        pub given: List,
        /// Coordinates, joints for all of theirs, and bodies with `.pose` where their pose is a coordinate.
        pub find: List,
    }

    /// `forward_derivatives` and `inverse_derivatives`.
    pub struct derivatives;

    /// A, B, C and D of `x' = A x + B u`, `y = C x + D u` at any state and input.
    pub struct linearize;

    /// The jump of velocities under an impulse, consistent with the constraints.
    pub struct impulse;

    /// `momentum`, `momentum_rate` and `velocity`.
    pub struct momentum;

    /// Angular momentum about the centre of mass and linear momentum, by the velocities.
    pub struct centroidal_momentum_matrix;

    /// Where all bodies are: positions and rotations of their frames.
    pub struct poses;

    /// Some of the outputs alone: `outputs { name: [output, ..] }` gives the method `outputs_name`.
    pub struct outputs;

    /// `Model::at`, which does once what several functions need at one position.
    pub struct at {
        /// Names of methods, such as `mass_matrix`, which go on from there.
        pub functions: List,
    }

    /// The equations, in the documentation of the module.
    pub struct report;

    /// `FORMULAS`, the equations as text and LaTeX.
    pub struct equations;
}
