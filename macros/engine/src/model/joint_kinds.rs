//! Stage `model`: the table of joint kinds.
//!
//! In: nothing. Out: one row for each kind: what users write, the freedoms that it leaves and what it holds where it closes
//! a loop, the struct that its coordinates are in. All stages read this table, and none knows a kind by name; what is said
//! of the freedoms (links of the tree, measured coordinates, wrenches, units, names of symbols) follows from them.

use super::types::Orientation;

/// A kind of joint: from the parent's frame to the child's, first freedoms first.
#[derive(Debug, PartialEq, Eq)]
pub struct JointKind {
    /// In the language.
    pub name: &'static str,
    /// In documentation.
    pub word: &'static str,
    /// What other tools call it.
    pub elsewhere: &'static [&'static str],
    pub written: Written,
    /// Its angle travels: `pitch` in m/rad.
    pub has_pitch: bool,
    /// The coordinates that are scalars, in the order of the language.
    pub freedoms: &'static [Freedom],
    /// How it turns in all directions, behind its other freedoms.
    pub orientation: Option<Orientation>,
    /// The equations where it closes a loop, as many as it takes freedoms away.
    pub holds: &'static [Hold],
    /// The runtime's struct of its coordinates, where these are several scalars.
    pub struct_name: &'static str,
}

/// The fields that give the directions of freedoms, see [`super::types::Directions`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Written {
    /// None.
    Frame,
    /// `axis`
    Axis,
    /// `axes`
    Crossed,
    /// `axis`, or `axes` across it.
    Plane,
    /// `axis`, and `slide` across it.
    Slot,
}

/// A motion with a coordinate of its own.
#[derive(Debug, PartialEq, Eq)]
pub struct Freedom {
    pub name: &'static str,
    pub motion: Motion,
    /// Number of its direction.
    pub direction: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    Slides,
    Turns,
}

/// What a joint that closes a loop holds, by the numbers of directions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hold {
    /// The child's point on the parent's.
    Point,
    /// The child's point on a line along a direction.
    Line(usize),
    /// The child's point in the plane across a direction.
    Plane(usize),
    /// An axis of the child on the parent's.
    Axis(usize),
    /// The second of two crossed axes across the first.
    Crossing,
    /// All axes of the child on the parent's.
    Orientation,
    /// Travel along the first direction against the angle about it.
    Pitch,
}

/// All kinds, in the order of messages. Ball and Free have a row for each way to write orientations, the default first.
pub static ALL: [&JointKind; 12] = [
    &FIXED,
    &REVOLUTE,
    &PRISMATIC,
    &SCREW,
    &CYLINDRICAL,
    &UNIVERSAL,
    &PLANAR,
    &PIN_SLOT,
    &BALL,
    &BALL_BY_ANGLES,
    &FREE,
    &FREE_BY_ANGLES,
];

pub static FIXED: JointKind = JointKind {
    name: "Fixed",
    word: "fixed",
    elsewhere: &["Weld", "Rigid"],
    written: Written::Frame,
    has_pitch: false,
    freedoms: &[],
    orientation: None,
    holds: &[Hold::Point, Hold::Orientation],
    struct_name: "",
};

pub static REVOLUTE: JointKind = JointKind {
    name: "Revolute",
    word: "revolute",
    elsewhere: &["Hinge", "Pin", "Rotary", "Rotational", "Continuous"],
    written: Written::Axis,
    has_pitch: false,
    freedoms: &[turns("angle", 0)],
    orientation: None,
    holds: &[Hold::Point, Hold::Axis(0)],
    struct_name: "",
};

pub static PRISMATIC: JointKind = JointKind {
    name: "Prismatic",
    word: "prismatic",
    elsewhere: &["Slider", "Sliding", "Linear", "Translational"],
    written: Written::Axis,
    has_pitch: false,
    freedoms: &[slides("travel", 0)],
    orientation: None,
    holds: &[Hold::Line(0), Hold::Orientation],
    struct_name: "",
};

pub static SCREW: JointKind = JointKind {
    name: "Screw",
    word: "screw",
    elsewhere: &["Helical"],
    written: Written::Axis,
    has_pitch: true,
    freedoms: &[turns("angle", 0)],
    orientation: None,
    holds: &[Hold::Line(0), Hold::Axis(0), Hold::Pitch],
    struct_name: "",
};

pub static CYLINDRICAL: JointKind = JointKind {
    name: "Cylindrical",
    word: "cylindrical",
    elsewhere: &[],
    written: Written::Axis,
    has_pitch: false,
    freedoms: &[slides("travel", 0), turns("angle", 0)],
    orientation: None,
    holds: &[Hold::Line(0), Hold::Axis(0)],
    struct_name: "Cylindrical",
};

pub static UNIVERSAL: JointKind = JointKind {
    name: "Universal",
    word: "universal",
    elsewhere: &["Cardan", "Hooke"],
    written: Written::Crossed,
    has_pitch: false,
    freedoms: &[turns("first", 0), turns("second", 1)],
    orientation: None,
    holds: &[Hold::Point, Hold::Crossing],
    struct_name: "Universal",
};

pub static PLANAR: JointKind = JointKind {
    name: "Planar",
    word: "planar",
    elsewhere: &[],
    written: Written::Plane,
    has_pitch: false,
    freedoms: &[slides("x", 1), slides("y", 2), turns("angle", 0)],
    orientation: None,
    holds: &[Hold::Plane(0), Hold::Axis(0)],
    struct_name: "Planar",
};

pub static PIN_SLOT: JointKind = JointKind {
    name: "PinSlot",
    word: "pin-slot",
    elsewhere: &["PinInSlot", "SlottedPin"],
    written: Written::Slot,
    has_pitch: false,
    freedoms: &[slides("travel", 1), turns("angle", 0)],
    orientation: None,
    holds: &[Hold::Line(1), Hold::Axis(0)],
    struct_name: "PinSlot",
};

pub static BALL: JointKind = JointKind {
    name: "Ball",
    word: "ball",
    elsewhere: &["Spherical"],
    written: Written::Frame,
    has_pitch: false,
    freedoms: &[],
    orientation: Some(Orientation::Quaternion),
    holds: &[Hold::Point],
    struct_name: "",
};

pub static BALL_BY_ANGLES: JointKind = JointKind {
    freedoms: &[turns("roll", 0), turns("pitch", 1), turns("yaw", 2)],
    orientation: Some(Orientation::RollPitchYaw),
    struct_name: "RollPitchYaw",
    ..BALL
};

pub static FREE: JointKind = JointKind {
    name: "Free",
    word: "free",
    elsewhere: &["Floating", "SixDof", "FreeJoint"],
    written: Written::Frame,
    has_pitch: false,
    freedoms: &[slides("x", 0), slides("y", 1), slides("z", 2)],
    orientation: Some(Orientation::Quaternion),
    holds: &[],
    struct_name: "",
};

pub static FREE_BY_ANGLES: JointKind = JointKind {
    freedoms: &[slides("x", 0), slides("y", 1), slides("z", 2), turns("roll", 0), turns("pitch", 1), turns("yaw", 2)],
    orientation: Some(Orientation::RollPitchYaw),
    ..FREE
};

const fn slides(name: &'static str, direction: usize) -> Freedom {
    Freedom { name, motion: Motion::Slides, direction }
}

const fn turns(name: &'static str, direction: usize) -> Freedom {
    Freedom { name, motion: Motion::Turns, direction }
}

impl Written {
    pub fn fields(self) -> &'static [&'static str] {
        match self {
            Written::Frame => &[],
            Written::Axis | Written::Plane => &["axis"],
            Written::Crossed => &["axes"],
            Written::Slot => &["axis", "slide"],
        }
    }

    /// Those that may stand in their place.
    pub fn instead(self) -> &'static [&'static str] {
        match self {
            Written::Frame | Written::Axis | Written::Crossed | Written::Slot => &[],
            Written::Plane => &["axes"],
        }
    }
}

impl Hold {
    /// Number of equations.
    pub fn rows(self) -> usize {
        match self {
            Hold::Point | Hold::Orientation => 3,
            Hold::Line(_) | Hold::Axis(_) => 2,
            Hold::Plane(_) | Hold::Crossing | Hold::Pitch => 1,
        }
    }

    /// Whether these are lengths (m), and not cosines.
    pub fn is_length(self) -> bool {
        match self {
            Hold::Point | Hold::Line(_) | Hold::Plane(_) | Hold::Pitch => true,
            Hold::Axis(_) | Hold::Crossing | Hold::Orientation => false,
        }
    }
}

impl JointKind {
    /// Names of the kinds, each once.
    pub fn names() -> impl Iterator<Item = &'static str> + Clone {
        let defaults = ALL.iter().filter(|kind| kind.orientation != Some(Orientation::RollPitchYaw));
        defaults.map(|kind| kind.name)
    }

    /// The kind of this name; with the default orientation.
    pub fn named(name: &str) -> Option<&'static JointKind> {
        ALL.into_iter().find(|kind| kind.name == name)
    }

    /// The kind that other tools call so.
    pub fn elsewhere(name: &str) -> Option<&'static JointKind> {
        ALL.into_iter().find(|kind| kind.elsewhere.contains(&name))
    }

    /// The kind with its orientation written in another way.
    pub fn oriented(&self, orientation: Orientation) -> Option<&'static JointKind> {
        ALL.into_iter().find(|kind| kind.name == self.name && kind.orientation == Some(orientation))
    }

    /// Number of velocity coordinates.
    pub fn freedoms(&self) -> usize {
        self.freedoms.len() + if self.has_quaternion() { 3 } else { 0 }
    }

    /// Names of the coordinates that are scalars, in their order.
    pub fn coordinates(&self) -> Vec<&'static str> {
        self.freedoms.iter().map(|freedom| freedom.name).collect()
    }

    /// Whether the orientation is a quaternion.
    pub fn has_quaternion(&self) -> bool {
        self.orientation == Some(Orientation::Quaternion)
    }

    /// Whether the orientation is three angles.
    pub fn has_angles(&self) -> bool {
        self.orientation == Some(Orientation::RollPitchYaw)
    }

    /// Whether it turns in all directions: Ball and Free.
    pub fn turns_freely(&self) -> bool {
        self.orientation.is_some()
    }

    /// Whether it holds nothing: Free.
    pub fn is_free(&self) -> bool {
        self.holds.is_empty()
    }

    /// The coordinates that turn it in all directions, behind the others.
    pub fn turning(&self) -> std::ops::Range<usize> {
        let all = self.freedoms();
        if self.turns_freely() { all - 3..all } else { all..all }
    }

    /// Number of freedoms that slide.
    pub fn slides(&self) -> usize {
        self.freedoms.iter().filter(|freedom| freedom.motion == Motion::Slides).count()
    }

    /// Whether a velocity coordinate slides, and doesn't turn.
    pub fn is_slide(&self, index: usize) -> bool {
        self.freedoms.get(index).is_some_and(|freedom| freedom.motion == Motion::Slides)
    }

    /// The freedoms by number, from the parent to the child: the last angle of Rz(yaw) Ry(pitch) Rx(roll) stands first.
    pub fn sequence(&self) -> Vec<usize> {
        let mut sequence: Vec<usize> = (0..self.freedoms.len()).collect();
        if self.has_angles() {
            sequence[self.turning()].reverse();
        }
        sequence
    }

    /// The angle at which two others turn about one axis.
    pub fn pitch(&self) -> Option<usize> {
        self.has_angles().then(|| self.turning().start + 1)
    }

    /// Whether it holds something where it closes a loop.
    pub fn holds(&self, hold: Hold) -> bool {
        self.holds.contains(&hold)
    }

    /// What each equation belongs to, where the joint closes a loop.
    pub fn rows(&self) -> impl Iterator<Item = Hold> {
        self.holds.iter().flat_map(|&hold| std::iter::repeat_n(hold, hold.rows()))
    }
}
