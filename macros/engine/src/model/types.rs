//! Stage `model`: the checked model, flat, every name resolved; not mutable after this stage.
//!
//! In: nothing. Out: the types that the checker fills and `mechanics` and `emit` read. Parts are expanded: a leg that
//! stands six times has its bodies here six times, each with the place that it has in the generated structs.

// Where the name says it all there is no text.
#![allow(missing_docs)]

use std::rc::Rc;

use proc_macro2::{Ident, Span, TokenStream};
use syn::ext::IdentExt;
use syn::{Attribute, Path, Visibility};

use crate::invariant::index_vec::{IndexVec, id};
use crate::invariant::kept::Kept;

use super::joint_kinds::JointKind;
use super::units::{Declared, Value, Wanted};

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident),* $(,)?) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub struct $name(pub usize);
        id!($name);
    )*};
}
ids! {
    /// Index into [`Model::instances`]; 0 is the model itself.
    InstanceId,
    PartTypeId,
    ParamId,
    InputId,
    StateId,
    BodyId,
    JointId,
    ForceId,
    ConstraintId,
    /// Index into [`Model::externals`], the same in all models of one call.
    ExternalId,
}

pub type Bodies = IndexVec<BodyId, Body>;
pub type Joints = IndexVec<JointId, Joint>;

/// A mechanism, ready for derivation.
#[derive(Clone)]
pub struct Model {
    pub name: Ident,
    pub vis: Visibility,
    /// Documentation and `cfg`, as written.
    pub attrs: Vec<Attribute>,
    /// Path of the runtime crate, `::multibody` unless renamed.
    pub krate: Path,
    /// Whether products are fused to sums: the feature `fma` of the runtime.
    pub fused: bool,
    /// Whether serde writes and reads its structs: the feature `serde` of the runtime.
    pub serialised: bool,
    /// Functions of the user's own Rust, of all modules of the call.
    pub externals: Rc<IndexVec<ExternalId, External>>,
    pub part_types: IndexVec<PartTypeId, PartType>,
    pub instances: IndexVec<InstanceId, Instance>,
    pub params: IndexVec<ParamId, Param>,
    pub inputs: IndexVec<InputId, Input>,
    pub states: IndexVec<StateId, State>,
    pub bodies: Bodies,
    /// In source order, which is the order of coordinates; `tree` gives the topological one.
    pub joints: Joints,
    /// Every body's joint towards the ground, parents before children.
    pub tree: Vec<JointId>,
    /// Joints that close loops, in source order: they have no coordinates and stand in no generated struct.
    pub cuts: Vec<JointId>,
    pub constraints: IndexVec<ConstraintId, Constraint>,
    pub drives: Vec<Drive>,
    /// In source order.
    pub solves: Vec<Solve>,
    /// Conditions (`Bool`) that the user vouches for.
    pub assumptions: Vec<Expr>,
    pub handling: Handling,
    /// Of Newton's method, if the model names a number.
    pub rounds: Option<usize>,
    pub packs: Packs,
    /// Velocity coordinates of the user's choice, in source order.
    pub speeds: Vec<Speed>,
    /// Nothing behind [`crate::formulation`] sees it.
    pub speed_choice: SpeedChoice,
    /// Coordinates that `formulation { independent: [..] }` names.
    pub independent: Vec<Coordinate>,
    /// Said in the report: items that another choice of coordinates has made void, such as a `#[cut]` in the tree; choices that were made
    /// for the user.
    pub remarks: Vec<String>,
    /// Coordinates whose motion is taken to first order.
    pub small: Vec<Coordinate>,
    pub forces: IndexVec<ForceId, Force>,
    pub outputs: Vec<Output>,
    /// `Vec3` in world axes, m/s^2; `None`: no gravity declared.
    pub gravity: Option<Expr>,
    pub emit: Vec<Request>,
    /// Where `emit` says so, for complaints about what can't be derived.
    pub asked: Vec<(Request, Span)>,
    /// Of `emit inverse_dynamics { solve_for: .. }`: the inputs that take the place of efforts, scalar by scalar.
    pub solve_for: Vec<SolveFor>,
    /// Of `emit kinematics { .. }`.
    pub kinematics: Vec<Kinematics>,
    /// Of `emit assembly_modes { .. }`.
    pub assembly: Option<Kinematics>,
    /// Of `emit outputs { .. }`.
    pub output_groups: Vec<OutputGroup>,
    /// Of `emit at { .. }`: functions that go on from what is done once for a position.
    pub at: Vec<AtFunction>,
}

impl Model {
    /// Whether it has the function `poses` and its struct.
    pub fn shows_poses(&self) -> bool {
        self.emit.contains(&Request::Poses) && !self.bodies.is_empty()
    }

    /// The velocity coordinate that stands for a speed: ids of joints go on behind those of the joints.
    pub fn coordinate_of(&self, speed: usize) -> Coordinate {
        Coordinate { joint: JointId(self.joints.len() + speed), index: 0 }
    }

    /// The speed that a velocity coordinate stands for, if it is not the rate of a joint's.
    pub fn speed(&self, joint: JointId) -> Option<&Speed> {
        joint.0.checked_sub(self.joints.len()).and_then(|number| self.speeds.get(number))
    }

    /// The frames of all bodies, in the order of declaration.
    pub fn body_frames(&self) -> Vec<Frame> {
        let frame = |(id, body): (BodyId, &Body)| Frame { body: BodyRef::Body(id), steps: Vec::new(), span: body.span };
        self.bodies.iter_ids().map(frame).collect()
    }
}

/// One velocity coordinate of a joint in the tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Coordinate {
    pub joint: JointId,
    pub index: usize,
}

/// A velocity coordinate of the user's choice: a scalar that is affine in velocities.
///
/// Behind the checks of the model it is known as a coordinate without a position: that with the number of [`Model::coordinate_of`].
#[derive(Clone)]
pub struct Speed {
    pub place: Place,
    pub value: Expr,
    pub docs: Docs,
    pub span: Span,
}

/// What is held at zero besides the closing joints.
#[derive(Clone)]
pub struct Constraint {
    pub place: Place,
    pub kind: ConstraintKind,
    /// The measured coordinate that this drives: the expression is the coordinate less its course.
    pub drive: Option<Coordinate>,
    pub docs: Docs,
    pub span: Span,
}

#[derive(Clone)]
pub enum ConstraintKind {
    /// A scalar of positions, parameters and time.
    Value(Expr),
    /// A scalar that is affine in velocities, such as what a wheel slips: its integral may be no function of positions, and is
    /// never taken for one.
    Rate(Expr),
    /// The distance between the origins of two frames is `length` (m).
    Rod { between: Box<[Frame; 2]>, length: Expr },
}

/// What follows a prescribed course. Values depend on time and parameters at most.
#[derive(Clone)]
pub struct Drive {
    pub target: DriveTarget,
    pub value: Expr,
    pub span: Span,
}

/// Coordinates that leave the state together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DriveTarget {
    /// A coordinate whose rate is its velocity coordinate; the value is a scalar.
    Coordinate(Coordinate),
    /// Of a Free joint (or an absolute body); the value is a `Vec3`.
    Position(JointId),
    /// Of a Free or Ball joint; the value is a `Rotation`.
    Orientation(JointId),
    /// Of a Free joint; the value is a `Pose`.
    Pose(JointId),
}

/// Coordinates found from others.
#[derive(Clone)]
pub struct Solve {
    pub unknowns: Vec<Coordinate>,
    pub how: SolveHow,
    pub span: Span,
}

#[derive(Clone)]
pub enum SolveHow {
    /// One scalar for each unknown.
    Formulas(Vec<Expr>),
    /// Found by the macro from what closes the loops; the conditions (`Bool`) choose one branch.
    From { closings: Vec<Closing>, branches: Vec<Expr> },
}

/// What closes a loop, where a `solve` names it.
#[derive(Clone, Copy, Debug)]
pub struct Closing {
    pub what: LoopClosure,
    pub span: Span,
}

impl Solve {
    /// What closes the loops that its unknowns are found from.
    pub fn closings(&self) -> impl Iterator<Item = LoopClosure> {
        let closings: &[Closing] = match &self.how {
            SolveHow::From { closings, .. } => closings,
            SolveHow::Formulas(_) => &[],
        };
        closings.iter().map(|closing| closing.what)
    }
}

/// What gives constraint equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum LoopClosure {
    Cut(JointId),
    Constraint(ConstraintId),
}

/// What becomes of constraint equations.
#[derive(Clone, Default)]
pub enum Handling {
    /// They stay, with multipliers.
    #[default]
    Multipliers,
    /// With Baumgarte's terms: second derivative + `rate` * first derivative + `position` * residual = 0, with
    /// coefficients in 1/s and 1/s^2.
    Stabilised { rate: Expr, position: Expr },
    /// Dependent coordinates are eliminated.
    Reduced,
    /// One of these two, by the counts of both; nothing behind [`crate::formulation`] sees it.
    Auto,
}

/// Whether limbs that are alike are computed together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Packs {
    /// One after the other.
    #[default]
    Off,
    /// Four at a time, or two.
    Four,
}

/// One scalar input that inverse dynamics finds.
#[derive(Clone, Copy, Debug)]
pub struct SolveFor {
    pub input: InputId,
    pub element: usize,
    pub span: Span,
}

/// `emit kinematics { given: .., find: .. }`, and `assembly_modes` likewise.
#[derive(Clone)]
pub struct Kinematics {
    /// Coordinates whose positions, velocities and accelerations are given: whole joints.
    pub given: Vec<JointId>,
    /// Scalars to find, coordinates of joints.
    pub find: Vec<Coordinate>,
    pub span: Span,
}

/// A function that `emit at { functions: [..] }` names.
#[derive(Clone)]
pub struct AtFunction {
    /// As the method of `Model` is called.
    pub name: String,
    pub span: Span,
}

/// `name: [output, ..]` of `emit outputs { .. }`: outputs that a function of their own gives.
#[derive(Clone)]
pub struct OutputGroup {
    pub name: Ident,
    pub fields: Vec<GroupField>,
}

/// An output of a group, or the same one of all parts of an array.
#[derive(Clone)]
pub struct GroupField {
    /// The path to it with `_` between.
    pub name: Ident,
    /// Places among the model's outputs; the last index of arrays goes fastest.
    pub outputs: Vec<usize>,
    /// Lengths of the arrays of parts on the path, from the model on.
    pub counts: Vec<usize>,
}

impl OutputGroup {
    /// Name of its struct: `OutputPose` of the group `pose`.
    pub fn struct_name(&self) -> String {
        OutputGroup::struct_name_of(&self.name)
    }

    pub fn struct_name_of(name: &Ident) -> String {
        let words = name.unraw().to_string();
        let words = words.split('_').map(|word| {
            let mut letters = word.chars();
            letters.next().into_iter().flat_map(char::to_uppercase).chain(letters).collect::<String>()
        });
        format!("Output{}", words.collect::<String>())
    }

    /// Name of its method of `Model`: `outputs_pose` of the group `pose`.
    pub fn method(&self) -> String {
        format!("outputs_{}", self.name.unraw())
    }

    /// Places among the model's outputs.
    pub fn outputs(&self) -> impl Iterator<Item = usize> {
        self.fields.iter().flat_map(|field| field.outputs.iter().copied())
    }
}

/// A function of the user's own Rust: a type with the runtime's trait `Function`.
#[derive(Clone)]
pub struct External {
    pub name: Ident,
    /// Names of the scalars that it takes.
    pub arguments: Vec<Ident>,
    /// Of the type, as written: `crate::..`, `$crate::..` or `::..`.
    pub path: TokenStream,
}

/// A module with ports, used by this model at least once.
#[derive(Clone)]
pub struct PartType {
    pub name: Ident,
    pub docs: Docs,
}

/// The model (instance 0) or one instance of a part.
#[derive(Clone)]
pub struct Instance {
    /// `None` for the model itself.
    pub parent: Option<InstanceId>,
    /// Field of the parent's structs.
    pub field: Ident,
    /// Position within `[leg; 6]`, and the array's length.
    pub index: Option<(usize, usize)>,
    pub part_type: Option<PartTypeId>,
    pub docs: Docs,
}

/// Where a leaf stands in the generated structs.
#[derive(Clone)]
pub struct Place {
    pub instance: InstanceId,
    pub field: Ident,
}

/// `///` text, with a leading `[kg]` taken out of it.
#[derive(Clone, Default)]
pub struct Docs {
    pub unit: Option<String>,
    pub text: Vec<String>,
}

/// Shape of a param or input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Type {
    Scalar,
    Bool,
    Vec3,
    /// 3x3, orthogonal.
    Rotation,
    /// Position and orientation of a frame in the world.
    Pose,
    /// Linear and angular velocity.
    Twist,
    /// Force and moment.
    Wrench,
    /// 6 x DOF.
    Jacobian,
    Array(Box<Type>, usize),
}

impl Type {
    /// Number of scalars in a `Scalar`, `Vec3` or array of them.
    pub fn scalars(&self) -> usize {
        match self {
            Type::Vec3 => 3,
            Type::Array(element, count) => element.scalars() * count,
            _ => 1,
        }
    }
}

/// A field of `Params`: `Scalar`, `Vec3` or array of them.
#[derive(Clone)]
pub struct Param {
    pub place: Place,
    pub ty: Type,
    /// Flattened, row by row.
    pub default: Vec<f64>,
    pub docs: Docs,
}

/// A field of `Input`: `Scalar`, `Vec3` or array of them.
#[derive(Clone)]
pub struct Input {
    pub place: Place,
    pub ty: Type,
    pub docs: Docs,
}

/// A differential equation of the user's own.
#[derive(Clone)]
pub struct State {
    pub place: Place,
    pub rate: Expr,
    pub start: f64,
    pub docs: Docs,
}

#[derive(Clone)]
pub struct Body {
    pub place: Place,
    /// kg
    pub mass: Expr,
    /// `Vec3`, m, in body axes.
    pub com: Expr,
    /// kg m^2 about the centre of mass in body axes: xx, yy, zz, xy, xz, yz as tensor entries; shapes are expanded.
    /// `None`: a point mass.
    pub inertia: Option<Box<[Expr; 6]>>,
    pub docs: Docs,
    pub span: Span,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BodyRef {
    Ground,
    Body(BodyId),
}

/// A frame fixed to a body: steps apply from left to right, each in the frame that the one before has made.
#[derive(Clone)]
pub struct Frame {
    pub body: BodyRef,
    pub steps: Vec<FrameStep>,
    pub span: Span,
}

/// Expressions here depend on parameters at most.
#[derive(Clone)]
pub enum FrameStep {
    At(Expr),
    /// Axis (`Vec3`, of any length but zero) and angle.
    Rotated(Expr, Expr),
    /// Row by row; columns are the new axes.
    Oriented(Box<[[Expr; 3]; 3]>),
}

#[derive(Clone)]
pub struct Joint {
    pub place: Place,
    pub kind: &'static JointKind,
    pub directions: Directions,
    /// m/rad
    pub pitch: Option<Expr>,
    pub parent: Frame,
    /// Of a joint in the tree its body is never the ground.
    pub child: Frame,
    /// kg m^2 or kg, added to the diagonal of the mass matrix.
    pub armature: Option<Expr>,
    pub docs: Docs,
    pub span: Span,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Orientation {
    Quaternion,
    RollPitchYaw,
}

/// What gives the directions of a joint's freedoms, as it is written: `Vec3` expressions of parameters at most, of any length
/// but zero.
#[derive(Clone)]
pub enum Directions {
    /// The axes of the parent's frame.
    Frame,
    /// One direction, and the two that follow when it is turned into a coordinate axis.
    Axis(Expr),
    /// One of the parent and, perpendicular to it, one of the child.
    Crossed(Box<[Expr; 2]>),
    /// Two of the parent, perpendicular to each other, in which the joint slides, behind their normal: it turns the first
    /// towards the second.
    Plane(Box<[Expr; 2]>),
    /// An axis of the parent and, perpendicular to it, the direction of the slot.
    Slot(Box<[Expr; 2]>),
}

impl Directions {
    /// Whether a direction is one of the child.
    pub fn is_of_child(&self, direction: usize) -> bool {
        match self {
            Directions::Crossed(_) => direction == 1,
            Directions::Frame | Directions::Axis(_) | Directions::Plane(_) | Directions::Slot(_) => false,
        }
    }

    /// As they are written, in this order.
    pub fn written(&self) -> Vec<&Expr> {
        match self {
            Directions::Frame => Vec::new(),
            Directions::Axis(axis) => vec![axis],
            Directions::Crossed(axes) | Directions::Plane(axes) | Directions::Slot(axes) => axes.iter().collect(),
        }
    }
}

#[derive(Clone)]
pub struct Force {
    pub place: Place,
    pub kind: ForceKind,
    pub docs: Docs,
    pub span: Span,
}

#[derive(Clone)]
pub enum ForceKind {
    /// One value per velocity coordinate of the joint (zero where the user addressed another one).
    Effort { joint: JointId, values: Vec<Expr> },
    /// `-stiffness * (coordinate - rest) - damping * rate` on one coordinate.
    JointSpring {
        joint: JointId,
        coordinate: usize,
        stiffness: Option<Expr>,
        damping: Option<Expr>,
        rest: Option<Expr>,
    },
    /// Along the line between two points; `length` is the natural length.
    LineSpring { between: Box<[Frame; 2]>, stiffness: Option<Expr>, damping: Option<Expr>, length: Option<Expr> },
    /// N, at the frame's origin, in the axes of `axes` (world if that is the ground).
    Force { at: Frame, value: Expr, axes: Frame },
    /// N m
    Torque { at: Frame, value: Expr, axes: Frame },
}

impl ForceKind {
    /// Its fields.
    pub fn values(&self) -> Vec<&Expr> {
        match self {
            ForceKind::Effort { values, .. } => values.iter().collect(),
            ForceKind::JointSpring { stiffness, damping, rest: length, .. }
            | ForceKind::LineSpring { stiffness, damping, length, .. } => {
                [stiffness, damping, length].into_iter().flatten().collect()
            }
            ForceKind::Force { value, .. } | ForceKind::Torque { value, .. } => vec![value],
        }
    }
}

#[derive(Clone)]
pub struct Output {
    pub place: Place,
    /// Its type is the output's type.
    pub value: Expr,
    pub docs: Docs,
}

/// What to derive.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Request {
    ForwardDynamics,
    InverseDynamics,
    MassMatrix,
    /// Of it what is on and below the diagonal.
    MassMatrixLower,
    Bias,
    Energy,
    /// Constraint equations, their Jacobian, rate and bias; with loops and multipliers they are always emitted.
    Constraints,
    /// The equations as a residual for solvers of differential-algebraic equations.
    Residual,
    Kinematics,
    /// All positions of coordinates that what is given leaves.
    AssemblyModes,
    /// Partial derivatives of forward and inverse dynamics.
    Derivatives,
    /// The equations and outputs linearised at a state.
    Linearize,
    /// The jump of velocities under an impulse.
    Impulse,
    /// Momenta, their rates, velocities from momenta.
    Momentum,
    CentroidalMomentumMatrix,
    /// Where all bodies are.
    Poses,
    /// Outputs by groups.
    Outputs,
    /// What is done once for a position, and functions that go on from there.
    At,
    /// The equations, in the module's documentation.
    Report,
    /// The equations as constants.
    Equations,
}

/// A typed expression; shared subtrees (`const`, `let`) are shared here too.
#[derive(Clone)]
pub struct Expr {
    pub node: Rc<ExprNode>,
    pub ty: Type,
    pub span: Span,
    /// Declared where the value has its name.
    pub(super) unit: Option<Rc<Declared>>,
}

impl Expr {
    pub fn new(node: ExprNode, ty: Type, span: Span) -> Expr {
        Expr { node: Rc::new(node), ty, span, unit: None }
    }
}

/// Equations in one unknown x with the coefficients a, b, c.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TwoRoots {
    /// a x^2 + 2 b x + c = 0
    Quadratic,
    /// a cos x + b sin x = c
    Circular,
}

/// Vectors are components in world axes where they come from frames, plain triples where the user wrote them.
pub enum ExprNode {
    Number(f64),
    Pi,
    Time,
    /// Whole param or input; elements are taken by `Index` and `Component`.
    Param(ParamId),
    Input(InputId),
    State(StateId),
    /// Of a joint: coordinate, its rate, its acceleration. With quaternions the position (order 0) doesn't exist.
    Coordinate {
        joint: JointId,
        index: usize,
        order: Order,
    },
    /// `Vec3`: child relative to parent, in child axes.
    RelativeAngularVelocity(JointId),
    /// Sum of all declared forces on this coordinate of the joint (`Effort` and joint springs).
    Effort {
        joint: JointId,
        index: usize,
    },
    /// Of a frame, in world axes.
    OfFrame(Frame, FrameQuantity),
    /// Linear rows, then angular ones, at the frame's origin in the axes of `axes` (world if that is the ground).
    Jacobian {
        frame: Frame,
        axes: Frame,
    },
    /// What the parent exerts on the child at the joint's child frame.
    Reaction {
        joint: JointId,
        axes: Frame,
    },
    /// Of the equation of a constraint, in the unit of work over that of the equation, or of its integral where it is one of
    /// velocities.
    Multiplier(ConstraintId),
    /// W
    Power(ForceId),
    /// Total, J.
    Kinetic,
    Potential,
    /// Of several bodies as one, in world axes.
    OfBodies(Selection, SystemQuantity),
    /// Components of a world vector in a frame's axes.
    Express {
        frame: Frame,
        vector: Expr,
    },
    /// Partial derivative, of a scalar, vector, or several of them; by time the total one.
    Derivative {
        of: Expr,
        by: Variable,
        /// What is differentiated by time reads velocities: accelerations come in.
        accelerated: bool,
    },
    /// A value with others in the place of variables.
    Substituted {
        of: Expr,
        pairs: Vec<(Variable, Expr)>,
    },
    /// An unknown of equations of the user's own, inside them.
    Unknown(usize),
    /// One of the unknowns of a system of linear equations: the matrix row by row, then the right-hand sides.
    Solved {
        system: Rc<[Expr]>,
        size: usize,
        index: usize,
    },
    /// A solution of an equation in one unknown that has two of them.
    OneOfTwo {
        form: TwoRoots,
        coefficients: Rc<[Expr; 3]>,
        second: bool,
    },
    /// Not a number.
    Undefined,
    /// What another model says, with values in the place of its variables.
    Formula {
        formula: Rc<Formula>,
        given: Vec<Given>,
    },
    /// An entry of the mass matrix.
    MassMatrix([Coordinate; 2]),
    /// An entry of the bias.
    Bias(Coordinate),
    /// What an equation of a loop or a constraint leaves: that of a joint by the name of its component.
    Residual {
        closing: LoopClosure,
        component: Option<String>,
    },
    /// A coordinate that follows from others by a formula.
    Closed(Coordinate),
    Vec3([Expr; 3]),
    Array(Vec<Expr>),
    /// Element of an array, index known.
    Index(Expr, usize),
    /// x, y or z of a `Vec3`.
    Component(Expr, usize),
    /// `.position`, `.force`, `.linear` (first) or `.moment`, `.angular` (second) of a `Wrench`, `Twist`.
    Linear(Expr),
    Angular(Expr),
    Neg(Expr),
    Add(Expr, Expr),
    Sub(Expr, Expr),
    /// Of type `Rotation`: no turn at all.
    Identity,
    /// A turn about an axis (`Vec3`, of parameters at most, of any length but zero) by an angle.
    RotationAbout {
        axis: Expr,
        angle: Expr,
    },
    /// `Rz(yaw) * Ry(pitch) * Rx(roll)`, given as roll, pitch, yaw.
    RollPitchYaw([Expr; 3]),
    /// Two rotations, the right one first applied.
    Compose(Expr, Expr),
    /// Components of a vector in the axes that a rotation maps to, from those it maps from.
    Rotated(Expr, Expr),
    /// Position (`Vec3`) and orientation (`Rotation`).
    Pose(Expr, Expr),
    /// Scalar by scalar, scalar by `Vec3` or `Vec3` by scalar.
    Mul(Expr, Expr),
    Div(Expr, Expr),
    Call(Function, Vec<Expr>),
    /// A function of the user's own Rust.
    External(ExternalId, Vec<Expr>),
    Compare(Comparison, Expr, Expr),
    And(Expr, Expr),
    Or(Expr, Expr),
    Not(Expr),
    /// Condition, then, else.
    Select(Expr, Expr, Expr),
}

/// An expression of another model of the same call.
pub struct Formula {
    pub model: Model,
    /// In that model's terms: a number, a vector, or several of them.
    pub of: Expr,
    /// That it has there.
    pub(in crate::model) unit: Value,
    /// By `mechanics`.
    pub solved: Kept,
}

/// A value for a variable of another model, or for all scalars of one.
pub struct Given {
    pub variables: Vec<Variable>,
    pub value: Expr,
    /// Its unit in that model, if it is known.
    pub(in crate::model) wanted: Option<Wanted>,
    /// Where the variable is named.
    pub span: Span,
}

/// A scalar by which values are differentiated, or in whose place others are put.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Variable {
    Time,
    /// A position or a rate.
    Coordinate(Coordinate, Order),
    State(StateId),
    /// With the place of the scalar among all of it.
    Param(ParamId, usize),
    Input(InputId, usize),
}

/// Who chooses a model's speeds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SpeedChoice {
    /// Its writer has: those that are listed, else the rates of coordinates.
    #[default]
    Written,
    /// They are to be chosen: `speeds: Auto`.
    Open,
    /// They are listed, and were chosen for one way to close loops.
    Made,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Order {
    Position,
    Rate,
    Acceleration,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FrameQuantity {
    Position,
    Rotation,
    Pose,
    Velocity,
    AngularVelocity,
    Twist,
    Acceleration,
    AngularAcceleration,
}

/// Bodies that are looked at together; `None`: all of the model.
pub type Selection = Option<Rc<[BodyId]>>;

/// What a system of bodies has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SystemQuantity {
    TotalMass,
    CentreOfMass,
    CentreOfMassVelocity,
    CentreOfMassAcceleration,
    LinearMomentum,
    /// About the centre of mass of these bodies.
    AngularMomentum,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Comparison {
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
}

impl Comparison {
    /// In a sentence, before the other value.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Comparison::Less => "less than",
            Comparison::LessEqual => "at most",
            Comparison::Greater => "greater than",
            Comparison::GreaterEqual => "at least",
            Comparison::Equal => "equal to",
            Comparison::NotEqual => "other than",
        }
    }
}

/// Functions of user expressions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Atan2,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
    Sqrt,
    Abs,
    Signum,
    Min,
    Max,
    Hypot,
    /// Integer power, second argument a literal.
    Powi,
    Powf,
    /// Degrees to radians.
    Deg,
    /// Of two `Vec3`.
    Dot,
    Cross,
    /// Length of a `Vec3`.
    Norm,
}
