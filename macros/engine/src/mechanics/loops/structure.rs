//! Stage `mechanics`: what becomes of every coordinate and of every constraint equation.
//!
//! In: nothing. Out: the types that [`crate::mechanics::analysis`] fills before anything is derived, and that derivation and `emit`
//! read. A mechanism with loops is an open tree whose coordinates obey equations. Coordinates of the tree are the state,
//! or follow a drive, or are found from the others in an order of steps; equations that no step solves keep multipliers.

use std::collections::BTreeMap;
use std::rc::Rc;

use crate::invariant::fault::OrFault;
use crate::mechanics::translate::symbols::has_quaternion;
use crate::mechanics::written::Page;
use crate::model::types::{ConstraintId, Coordinate, ForceId, JointId, LoopClosure, Model};

use super::advice::{Advice, Pivoted};
use super::constraints::{Writing, is_length};
use super::groups::Group;

/// The split of one model's coordinates and equations.
#[derive(Clone, Debug, Default)]
pub struct Structure {
    /// By joint and velocity coordinate; nothing for joints that close loops.
    pub roles: Vec<Vec<Role>>,
    /// What generated structs hold, in their order.
    pub state: Vec<Coordinate>,
    /// Rates of the state that are no velocity coordinates.
    pub rates: DependentRates,
    /// In which axes the equations below were chosen.
    pub writing: Writing,
    /// Equations that keep a multiplier, in the order of multipliers.
    pub rows: Vec<Row>,
    /// Those among them that vanish or follow from others at the parameters' defaults, and not with others.
    pub wavering: Vec<Row>,
    /// Whether more of them are kept than are independent on some branch of closed loops: their rank falls there everywhere, so a
    /// fall tells of no crossing of motions.
    pub redundant: bool,
    /// Equations that don't follow from others, those with multipliers among them: the loops hold by their forces.
    pub independent: Vec<Row>,
    /// Equations that follow from the others everywhere.
    pub dropped: Vec<Row>,
    /// Equations whose forces rigid bodies don't tell, since they depend on others, kept or left out; where a multiplier is read.
    pub shared: Vec<Row>,
    /// Those among `dropped` that hold for parameters like the declared ones only.
    pub granted: Vec<Row>,
    /// Parameters, by number and element, that break these when they are not at their defaults.
    pub pinned: Vec<(usize, usize)>,
    /// The residuals that amount to one: to a movement by a radian, or by the mechanism's size.
    pub scales: BTreeMap<Row, f64>,
    /// By coordinate of the state what counts as one: the mechanism's size for travels.
    pub units: Vec<f64>,
    /// How dependent coordinates are found, in this order.
    pub steps: Vec<Step>,
    /// By `kinematics` of the model: how what is to be found follows from what is given by Newton's method, where no `solve` item
    /// gives it.
    pub closures: Vec<Option<Rc<Structure>>>,
    /// The same of `emit assembly_modes`: what is given is independent there, and all else of its loops follows.
    pub assembly: Option<Rc<Structure>>,
    /// How many assembly modes there are; known once they are derived.
    pub modes: Option<Modes>,
    /// What is there several times.
    pub groups: Vec<Group>,
    /// Unknowns whose closed forms have a root, and pitches; known once they are derived.
    pub dead_centres: Vec<Coordinate>,
    /// Springs and dampers between points that joints hold together: nothing acts between these.
    pub meeting: Vec<ForceId>,
    /// Configurations in which all loops are closed, parameters at their defaults. The first is the one nearest to where
    /// coordinates stand by default; where they are reduced it has the state there if the loops close so. Empty where
    /// there is no loop, and where none was found. What is in no loop is random in the others.
    pub closed: Vec<Closed>,
    /// Sentences for the report: choices that were made for the user.
    pub notes: Vec<String>,
    /// By candidate of forward dynamics what became of equations with multipliers; known once they are derived.
    pub pivoted: Vec<Pivoted>,
    /// What the choice for loops costs beside the other one, where somebody wants to know.
    pub advice: Option<Box<Advice>>,
    /// The equations for readers, where the model asks for them; known once they are derived.
    pub page: Option<Rc<Page>>,
}

/// How many assembly modes there are at most: so many roots, where there is a polynomial, for each choice of so many sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Modes {
    pub sides: usize,
    pub roots: usize,
    /// Sides that belong to each root, of which one is right as a rule.
    pub choices: usize,
}

/// A configuration in which all loops are closed.
#[derive(Clone, Debug)]
pub struct Closed {
    /// By joint the components of its position, those of a quaternion from its real part on; nothing for joints that close
    /// loops.
    pub positions: Vec<Vec<f64>>,
    /// Greatest residual of any equation, in units of its gradient.
    pub residual: f64,
}

impl Closed {
    /// The value of a coordinate that is a number; nothing for a part of a quaternion.
    pub fn value(&self, model: &Model, coordinate: Coordinate) -> Option<f64> {
        let joint = &model.joints[coordinate.joint];
        if has_quaternion(joint) && coordinate.index + 3 >= joint.kind.freedoms() {
            return None;
        }
        self.positions.get(coordinate.joint.0)?.get(coordinate.index).copied()
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    State,
    /// By the drive with this number in the model.
    Driven(usize),
    /// By the step with this number.
    Dependent(usize),
}

/// One scalar equation of what closes a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Row {
    pub closing: LoopClosure,
    /// Among those that this closing gives, see [`super::constraints`].
    pub index: usize,
}

/// Rates of coordinates that are in the state, while their rates are not: they follow from equations of velocities and from what the user's
/// speeds stand for, as many as there are rates. Positions are integrated.
#[derive(Clone, Debug, Default)]
pub struct DependentRates {
    /// Velocity coordinates: rates of other coordinates of the state in its order, then speeds of the user's choice.
    pub speeds: Vec<Coordinate>,
    pub unknowns: Vec<Coordinate>,
    /// Equations of velocities, which keep no multipliers.
    pub rows: Vec<Row>,
    /// As many coordinates as rows, whose rates these would give without any speeds: their equations of motion tell of the forces.
    pub held: Vec<Coordinate>,
}

/// Coordinates found together.
#[derive(Clone, Debug)]
pub struct Step {
    pub unknowns: Vec<Coordinate>,
    pub means: Means,
}

#[derive(Clone, Debug)]
pub enum Means {
    /// A linear coupling, eliminated exactly: one unknown.
    Linear(ConstraintId),
    /// An equation in which the one unknown stands alone, with a number as its factor: solved for it. All else that the equation
    /// reads is in the state or driven, or earlier steps give it.
    Explicit(ConstraintId),
    /// By the `solve` item with this number in the model.
    Solve(usize),
    /// By Newton's method on these equations, as many as unknowns. The place of the first unknown in the guess.
    Newton { rows: Vec<Row>, guess: usize },
}

/// Equations by equations by coordinates: below that the runtime solves for a projection as fast without knowing any zeros.
const LARGE: usize = 1_000;

impl Structure {
    /// Every coordinate is the state, and nothing holds them together: what a model without loops and drives has.
    pub fn open(model: &Model) -> Structure {
        let mut structure = Structure::default();
        for (index, joint) in model.joints.iter().enumerate() {
            let id = JointId(index);
            let freedoms = if model.cuts.contains(&id) { 0 } else { joint.kind.freedoms() };
            structure.roles.push(vec![Role::State; freedoms]);
            structure.state.extend((0..freedoms).map(|index| Coordinate { joint: id, index }));
        }
        structure
    }

    /// The same mechanism with its loops solved by all `solve` items, as `emit kinematics` needs it whatever becomes of the
    /// constraint equations elsewhere.
    pub fn solved(&self, model: &Model) -> Structure {
        if self.steps.iter().any(|step| matches!(step.means, Means::Solve(_))) {
            return self.clone();
        }
        let mut solved = self.clone();
        solved.rows.clear();
        for (number, solve) in model.solves.iter().enumerate() {
            let step = solved.steps.len();
            for unknown in &solve.unknowns {
                let roles = solved.roles.get_mut(unknown.joint.0);
                if let Some(role) = roles.and_then(|roles| roles.get_mut(unknown.index)) {
                    *role = Role::Dependent(step);
                }
            }
            solved.steps.push(Step { unknowns: solve.unknowns.clone(), means: Means::Solve(number) });
        }
        let role = |coordinate: &Coordinate| solved.role(*coordinate) == Role::State;
        solved.state = self.state.iter().copied().filter(role).collect();
        solved
    }

    pub fn with_notes(mut self, notes: Vec<String>) -> Structure {
        self.notes.extend(notes);
        self
    }

    /// Which of the equations with multipliers belong together: lengths, or cosines, of one closing, by equal numbers.
    /// Where one of them vanishes in a singular pose, the others tell that what is left of it is rounding. Empty where
    /// each stands for itself.
    pub fn row_groups(&self, model: &Model) -> Box<[usize]> {
        let own = |row: &Row| (row.closing, is_length(model, row.closing, row.index));
        // One that vanishes but for a parameter is compared with whatever else its closing keeps: what a parameter of
        // rounding leaves of it is far below that, in any unit.
        let group = |row: &Row| {
            let steady = |other: &&Row| other.closing == row.closing && !self.wavering.contains(other);
            let other = if self.wavering.contains(row) { self.rows.iter().find(steady) } else { None };
            own(other.unwrap_or(row))
        };
        let first = |row: &Row| {
            self.rows.iter().position(|other| group(other) == group(row)).or_fault("a row is in its own group")
        };
        let groups: Box<[usize]> = self.rows.iter().map(first).collect();
        let alone = groups.iter().enumerate().all(|(k, &group)| k == group);
        if alone { Box::default() } else { groups }
    }

    /// Whether equations are so many that projections gain by their zeros, and none follows from others everywhere.
    pub fn is_projected_by_zeros(&self) -> bool {
        !self.redundant && self.rows.len() * self.rows.len() * self.state.len() >= LARGE
    }

    /// Number of velocity coordinates.
    pub fn freedoms(&self) -> usize {
        self.speeds().len()
    }

    /// Velocity coordinates, in the order of `Velocity`: as a rule the rates of the state.
    pub fn speeds(&self) -> &[Coordinate] {
        if self.has_speeds() { &self.rates.speeds } else { &self.state }
    }

    /// Whether velocities are other than the rates of all coordinates of the state.
    pub fn has_speeds(&self) -> bool {
        !self.rates.unknowns.is_empty()
    }

    pub fn role(&self, coordinate: Coordinate) -> Role {
        match self.roles.get(coordinate.joint.0).map(Vec::as_slice) {
            // Before any role is given out; and of a joint that closes a loop, whose coordinates are measured, nothing follows.
            None | Some([]) => Role::State,
            Some(roles) => roles[coordinate.index],
        }
    }

    /// Number of unknowns that Newton's method finds: the size of the guess in `State`.
    pub fn guesses(&self) -> usize {
        let newton = |step: &&Step| matches!(step.means, Means::Newton { .. });
        self.steps.iter().filter(newton).map(|step| step.unknowns.len()).sum()
    }

    /// These unknowns, by their place in the guess.
    pub fn guessed(&self) -> Vec<Coordinate> {
        let newton = |step: &&Step| matches!(step.means, Means::Newton { .. });
        self.steps.iter().filter(newton).flat_map(|step| step.unknowns.iter().copied()).collect()
    }
}
