//! A mechanism as data: what the language can say of it, with the value of every number beside its text.
//!
//! `draw` makes random ones, `text` writes them down, `shrink` takes things out of them. The plain recursions read the
//! same data, and never what the engine made of the text.

pub mod beside;
mod carried;
pub mod carts;
pub mod draw;
pub mod expression;
pub mod held;
pub mod limbs;
pub mod loops;
pub mod numbers;
pub mod shrink;
pub mod text;
pub mod wheels;

pub use expression::{Expr, Vector};
pub use held::{Coupling, Drive, Held, Load, Term};

/// Rate of a state for each unit of it.
pub const FLOW: f64 = -0.25;

/// What a model declares.
#[derive(Clone, Debug, Default)]
pub struct Mechanism {
    /// Defaults of `p0`, `p1`, ..
    pub params: Vec<Expr>,
    /// Number of scalar inputs `u0`, `u1`, ..
    pub inputs: usize,
    /// Where `s0`, `s1`, .. start, which masses follow; their rates are [`FLOW`] times themselves.
    pub states: Vec<Expr>,
    /// In world axes.
    pub gravity: Option<Vector>,
    /// `b0`, `b1`, ..; body k hangs on joint k.
    pub bodies: Vec<Body>,
    /// `j0`, `j1`, ..: one for each body, parents before children, then those that close loops.
    pub joints: Vec<Joint>,
    /// `r0`, `r1`, ..: rods.
    pub rods: Vec<Rod>,
    /// `h0`, `h1`, ..: equations of velocities.
    pub held: Vec<Held>,
    /// `c0`, `c1`, ..: equations of coordinates.
    pub couplings: Vec<Coupling>,
    /// Coordinates that follow the time.
    pub drives: Vec<Drive>,
    /// `w0`, `w1`, ..: velocities in the place of rates, by all of these.
    pub speeds: Vec<Vec<f64>>,
    /// `f0`, `f1`, ..
    pub forces: Vec<Force>,
    /// The words of `emit`.
    pub emit: Vec<&'static str>,
    /// Functions that go on from a position.
    pub at: Vec<&'static str>,
    /// Whether limbs that are alike are computed together.
    pub packs: bool,
    /// Items that are written at the end as they are.
    pub tail: String,
    /// Whether outputs of bodies and joints are written, and looked at.
    pub outputs: bool,
    /// Joints whose reactions are not among them.
    pub unread: Vec<usize>,
    /// Whether all else is on the first body.
    pub carried: bool,
    /// Whether those of wheels and blades are that don't read multipliers.
    pub contacts: bool,
    /// Those that do.
    pub loads: Vec<Load>,
    /// A configuration in which the loops are closed, joint by joint.
    pub closed: Vec<Vec<f64>>,
}

/// A body.
#[derive(Clone, Debug)]
pub struct Body {
    /// kg
    pub mass: Expr,
    /// m
    pub com: Vector,
    /// kg m^2
    pub inertia: Inertia,
}

/// About the centre of mass.
#[derive(Clone, Debug)]
pub enum Inertia {
    /// None.
    Point,
    /// Principal moments.
    Diagonal([Expr; 3]),
    /// xx, yy, zz, xy, xz, yz.
    Full([Expr; 6]),
    /// Of this length along an axis.
    Rod(Expr, Vector),
    /// Edges.
    Cuboid(Vector),
    /// Radius, length, axis.
    Cylinder(Expr, Expr, Vector),
    /// Radius.
    Sphere(Expr),
}

/// A frame on a body or on the ground.
#[derive(Clone, Debug, Default)]
pub struct Frame {
    /// The ground where there is none.
    pub body: Option<usize>,
    /// From left to right.
    pub steps: Vec<Step>,
}

/// A step of a frame.
#[derive(Clone, Debug)]
pub enum Step {
    /// `.at(..)`
    At(Vector),
    /// `.rotated(axis, angle)`
    Rotated(Vector, Expr),
    /// `.oriented([..])`
    Oriented([[Expr; 3]; 3]),
}

/// A joint.
#[derive(Clone, Debug)]
pub struct Joint {
    /// What it lets move.
    pub kind: Kind,
    /// Nearer to the ground.
    pub parent: Frame,
    /// On the body that it carries.
    pub child: Frame,
    /// Of joints with one coordinate.
    pub armature: Option<Expr>,
}

/// The ten kinds; two of them with two orientation coordinates.
#[derive(Clone, Debug)]
pub enum Kind {
    /// None.
    Fixed,
    /// angle
    Revolute(Vector),
    /// travel
    Prismatic(Vector),
    /// angle; pitch
    Screw(Vector, Expr),
    /// travel, angle
    Cylindrical(Vector),
    /// first, second
    Universal(Vector, Vector),
    /// x, y, angle; the number of the axis and its sign
    Planar(usize, bool),
    /// travel, angle; the axis and the direction of the slot
    PinSlot(Vector, Vector),
    /// x, y, angle; the two directions
    PlanarAlong(Vector, Vector),
    /// With roll, pitch, yaw or not.
    Ball(bool),
    /// With roll, pitch, yaw or not.
    Free(bool),
}

/// The origins of two frames stay apart by a length.
#[derive(Clone, Debug)]
pub struct Rod {
    /// Where it is held.
    pub between: [Frame; 2],
    /// m
    pub length: Expr,
}

/// What acts.
#[derive(Clone, Debug)]
pub enum Force {
    /// On one coordinate, or on all of a joint.
    Effort {
        /// Its number.
        joint: usize,
        /// All where there is none.
        component: Option<usize>,
        /// One for each.
        values: Vec<Expr>,
    },
    /// On a coordinate: stiffness, damping, rest.
    JointSpring {
        /// Its number.
        joint: usize,
        /// Of its coordinates.
        component: usize,
        /// N/m or N m/rad
        stiffness: Option<Expr>,
        /// N s/m or N m s/rad
        damping: Option<Expr>,
        /// Where it is relaxed.
        rest: Option<Expr>,
    },
    /// Between two points.
    LineSpring {
        /// Whose origins are pulled together.
        between: [Frame; 2],
        /// N/m
        stiffness: Option<Expr>,
        /// N s/m
        damping: Option<Expr>,
        /// m
        length: Option<Expr>,
    },
    /// On a body.
    Wrench {
        /// A `Torque` or a `Force`.
        torque: bool,
        /// On which body, and where.
        at: Frame,
        /// N or N m
        value: Vector,
        /// In whose axes.
        axes: Frame,
    },
}

impl Kind {
    /// Number of velocity coordinates.
    pub fn freedoms(&self) -> usize {
        match self {
            Kind::Fixed => 0,
            Kind::Revolute(_) | Kind::Prismatic(_) | Kind::Screw(..) => 1,
            Kind::Cylindrical(_) | Kind::Universal(..) | Kind::PinSlot(..) => 2,
            Kind::Planar(..) | Kind::PlanarAlong(..) | Kind::Ball(_) => 3,
            Kind::Free(_) => 6,
        }
    }

    /// Number of position coordinates.
    pub fn coordinates(&self) -> usize {
        self.freedoms() + usize::from(self.quaternion().is_some())
    }

    /// Where a quaternion begins among the position coordinates.
    pub fn quaternion(&self) -> Option<usize> {
        match self {
            Kind::Ball(false) => Some(0),
            Kind::Free(false) => Some(3),
            _ => None,
        }
    }

    /// Names of the coordinates that are numbers.
    pub fn names(&self) -> &'static [&'static str] {
        match self {
            Kind::Fixed | Kind::Ball(false) => &[],
            Kind::Revolute(_) | Kind::Screw(..) => &["angle"],
            Kind::Prismatic(_) => &["travel"],
            Kind::Cylindrical(_) | Kind::PinSlot(..) => &["travel", "angle"],
            Kind::Universal(..) => &["first", "second"],
            Kind::Planar(..) | Kind::PlanarAlong(..) => &["x", "y", "angle"],
            Kind::Ball(true) => &["roll", "pitch", "yaw"],
            Kind::Free(false) => &["x", "y", "z"],
            Kind::Free(true) => &["x", "y", "z", "roll", "pitch", "yaw"],
        }
    }
}

impl Mechanism {
    /// Joints that close loops.
    pub fn cuts(&self) -> &[Joint] {
        &self.joints[self.bodies.len()..]
    }

    /// Velocity coordinates of the tree.
    pub fn freedoms(&self) -> usize {
        self.joints[..self.bodies.len()].iter().map(|j| j.kind.freedoms()).sum()
    }

    /// Whether anything closes a loop.
    pub fn looped(&self) -> bool {
        let is_tied = !self.couplings.is_empty() || !self.drives.is_empty();
        self.joints.len() > self.bodies.len() || !self.rods.is_empty() || !self.held.is_empty() || is_tied
    }

    /// Joints whose reactions are written, in order.
    pub fn read_joints(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.joints.len()).filter(|joint| !self.unread.contains(joint))
    }

    /// Whether something is held on both sides of a joint, so that what it bears is not to be told from the tree alone.
    pub fn is_in_a_loop(&self, joint: usize) -> bool {
        let is_beyond = |frame: &Frame| frame.body.is_some_and(|body| self.is_beyond(body, joint));
        let closings = self.cuts().iter().map(|cut| [&cut.parent, &cut.child]);
        let rods = self.rods.iter().map(|rod| rod.between.each_ref());
        let mut ends = closings.chain(rods).chain(self.held.iter().filter_map(Held::frames));
        joint >= self.bodies.len() || ends.any(|[a, b]| is_beyond(a) != is_beyond(b))
    }

    /// Whether a body hangs on a joint, at whatever distance.
    pub fn is_beyond(&self, body: usize, joint: usize) -> bool {
        body == joint || self.joints[body].parent.body.is_some_and(|parent| self.is_beyond(parent, joint))
    }
}
