//! Stage `mechanics`: the state of one derivation.
//!
//! In: the checked model. Out: [`Equations`], a graph with the model's symbols and tree, to which the other files of this
//! stage add what is asked for and nothing else. Everything is made when it is first needed, once.

use std::collections::HashMap;
use std::rc::Rc;

use crate::dynamics::columns::Columns;
use crate::dynamics::floating_bases::floating_bases;
use crate::dynamics::newton_euler::Wrench;
use crate::dynamics::regroup::{regroup, regroup_but};
use crate::dynamics::shared_axes::{Axes, Shared, share_axes};
use crate::dynamics::tree::Tree;
use crate::dynamics::velocities::LinkVelocity;
use crate::model::types::{Closing, ExprNode, JointId, Model};
use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};

use super::loops::branches::Branch;
use super::loops::constraints::Writing;
use super::loops::constraints::expression::{Slopes, StandIns};
use super::loops::constraints::turns::Turns;
use super::loops::known::Known;
use super::loops::reduction::{Map, Reduction};
use super::loops::rotors::Rotor;
use super::loops::structure::{Row, Structure};
use super::results::constrained::Solved;
use super::translate::build::Mechanism;
use super::translate::forces::Loads;
use super::translate::symbols::Symbols;
use super::translate::values::Value;

/// How the motion of frames is written: the two cost differently, and neither wins always.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// Point by point from the tip to the ground; best for a few frames.
    Nested,
    /// Rotations and velocities of all links in world axes; best where they are shared.
    World,
}

/// Which forward dynamics gives accelerations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    Composite,
    /// The same, solved from the translations of floating bodies.
    Floating,
    Articulated,
}

/// Choices of a candidate.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    pub style: Style,
    pub method: Method,
    /// Common axes for parallel hinges in the recursions of the dynamics.
    pub axes: Option<Axes>,
    /// In which axes loops are closed.
    pub writing: Writing,
}

/// One derivation.
#[derive(Clone)]
pub struct Equations<'m> {
    pub(super) model: &'m Model,
    pub g: Graph,
    pub symbols: Symbols,
    /// Roles of coordinates and equations; without loops and drives an empty one.
    pub(super) structure: Rc<Structure>,
    pub(super) mechanism: Rc<Mechanism>,
    pub(super) style: Style,
    pub(super) method: Method,
    pub(super) axes: Option<Axes>,
    pub(super) writing: Writing,
    /// Equations of closings, once written.
    pub(super) closed: HashMap<Closing, Rc<[Scalar]>>,
    /// By address: the model outlives this.
    pub(super) memo: HashMap<*const ExprNode, Value>,
    pub(super) world: Columns,
    /// Rotation of each link to world axes.
    pub(super) rotations: Vec<Option<Rotation>>,
    pub(super) velocities: Option<Rc<[LinkVelocity]>>,
    pub(super) regrouped: Option<Rc<Tree>>,
    /// The regrouped tree in the axes that the dynamics is written in.
    pub(super) shared: Option<Rc<Shared>>,
    pub(super) loads: Option<Rc<Loads>>,
    pub(super) accelerations: Option<Rc<[Scalar]>>,
    /// Definitions of the coordinates outside the state, where outputs are derived.
    pub(super) reduction: Option<Rc<Reduction>>,
    /// Positions, rates and accelerations of coordinates outside the state, once they are found.
    pub(super) defined: Rc<Map>,
    /// Constrained accelerations, where outputs have asked for them.
    pub(super) solved: Option<Rc<Solved>>,
    pub(super) transmitted: Option<Rc<[Wrench]>>,
    /// How loops are solved, and the signs of roots that conditions have chosen, by `solve` item: decided once.
    pub(super) branches: HashMap<usize, Branch>,
    /// Multipliers whose forces act beside the declared ones.
    pub(super) multiplied: Vec<(Row, Scalar)>,
    /// Inverse dynamics by [`crate::dynamics::lumped`].
    pub(super) lumped: bool,
    /// Multipliers of the equations by which dependent coordinates are found, where reactions have asked for them.
    pub(super) constraint_forces: Option<Rc<[(Row, Scalar)]>>,
    /// Of joints that close loops.
    pub(super) rotors: Option<Rc<[Rotor]>>,
    /// What expressions that are held act with, by constraint.
    pub(super) slopes: HashMap<usize, Rc<Slopes>>,
    /// What whole turns of measured angles do to them.
    pub(super) turns: HashMap<usize, Turns>,
    pub(super) stand_ins: StandIns,
    /// Forces are being derived: the checker lets none depend on loads, and here that would be an endless regress.
    pub(super) loading: bool,
    /// What Newton's method finds stands in the guess already.
    pub(super) at_guess: bool,
    /// `Fixed` joints with a link of their own.
    pub(super) kept: Rc<[JointId]>,
    /// Nodes that the graph had before anything was asked for.
    pub(super) born: usize,
    /// Of derivations before this one.
    pub(super) known: Known<'m>,
}

impl<'m> Equations<'m> {
    /// `kept` are `Fixed` joints that get a link of their own, since their reactions are asked for.
    pub fn new(model: &'m Model, g: Graph, symbols: Symbols, way: Way, kept: &[JointId]) -> Self {
        let mut equations = Equations {
            model,
            g,
            symbols,
            structure: Rc::new(Structure::default()),
            mechanism: Rc::new(Mechanism::default()),
            style: way.style,
            method: way.method,
            axes: way.axes,
            writing: way.writing,
            closed: HashMap::new(),
            shared: None,
            memo: HashMap::new(),
            world: Columns::new(None, Rotation::IDENTITY),
            rotations: Vec::new(),
            velocities: None,
            regrouped: None,
            loads: None,
            accelerations: None,
            reduction: None,
            defined: Rc::default(),
            solved: None,
            transmitted: None,
            branches: HashMap::new(),
            multiplied: Vec::new(),
            lumped: false,
            constraint_forces: None,
            rotors: None,
            slopes: HashMap::new(),
            turns: HashMap::new(),
            stand_ins: StandIns::default(),
            loading: false,
            at_guess: false,
            kept: kept.into(),
            born: 0,
            known: Known::default(),
        };
        let mechanism = equations.build(kept);
        equations.rotations = vec![None; mechanism.tree.links.len()];
        equations.mechanism = Rc::new(mechanism);
        equations.born = equations.g.size();
        equations
    }

    /// The tree with regrouped inertias: for totals.
    pub(super) fn regrouped(&mut self) -> Rc<Tree> {
        if let Some(tree) = &self.regrouped {
            return Rc::clone(tree);
        }
        let tree = Rc::new(regroup(&mut self.g, &self.mechanism.tree));
        self.regrouped = Some(Rc::clone(&tree));
        tree
    }

    /// The regrouped tree in the axes of this way, and how far wrenches given in link axes must turn.
    pub(super) fn shared(&mut self) -> Rc<Shared> {
        if let Some(shared) = &self.shared {
            return Rc::clone(shared);
        }
        let tree = match self.method {
            // What floats is best eliminated whole.
            Method::Articulated => {
                let keep: Vec<usize> =
                    floating_bases(&self.mechanism.tree).iter().map(|floating_base| floating_base.link).collect();
                Rc::new(regroup_but(&mut self.g, &self.mechanism.tree, false, &keep))
            }
            Method::Composite | Method::Floating => self.regrouped(),
        };
        let shared = self.axes.and_then(|axes| share_axes(&mut self.g, &tree, axes));
        let shared = Rc::new(shared.unwrap_or_else(|| Shared::own(&tree)));
        self.shared = Some(Rc::clone(&shared));
        shared
    }

    /// Minus gravity: the acceleration of the ground that acts like it.
    pub(super) fn base(&mut self) -> Vector {
        match self.mechanism.tree.gravity {
            Some(gravity) => self.g.vector(gravity.map(|c| -c)),
            None => Vector::ZERO,
        }
    }

    /// Velocities of all links, in link axes.
    pub(super) fn link_velocities(&mut self) -> Rc<[LinkVelocity]> {
        if let Some(velocities) = &self.velocities {
            return Rc::clone(velocities);
        }
        let mechanism = Rc::clone(&self.mechanism);
        let velocities: Rc<[LinkVelocity]> =
            crate::dynamics::velocities::velocities(&mut self.g, &mechanism.tree).into();
        self.velocities = Some(Rc::clone(&velocities));
        velocities
    }
}
