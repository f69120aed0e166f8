//! Stage `mechanics`: what a derivation is about.
//!
//! In: the model, its symbols, the structure, choices. Out: a [`Scene`] with the tree of links, which nothing changes from
//! then on.

use std::rc::Rc;

use crate::dynamics::shared_axes::SharedAxes;
use crate::model::types::{JointId, Model};

use super::loops::constraints::Writing;
use super::loops::structure::Structure;
use super::translate::build::Mechanism;
use super::translate::symbols::Symbols;

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

/// How motions and wrenches pass from link to link.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Passing {
    /// In the axes of the joints, with base inertial parameters.
    Plain,
    /// Columns of U that neighbours have in common are turned, and so are last links.
    Columns,
    /// Some mass stays at hinges as well. Of efforts alone: where more is made of them, fewer moments are better.
    Masses,
}

/// Choices of a candidate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Choices {
    pub style: Style,
    pub method: Method,
    /// Common axes for parallel hinges in the recursions of the dynamics.
    pub axes: Option<SharedAxes>,
    pub passing: Passing,
    /// In which axes loops are closed.
    pub writing: Writing,
    /// Inverse dynamics by [`crate::dynamics::lumped`].
    pub lumped: bool,
    /// Small systems of rates are solved by quotients of determinants, which people can read.
    pub for_readers: bool,
}

impl Choices {
    /// As good as any where cost is of no concern.
    pub const PLAIN: Choices = Choices {
        style: Style::Nested,
        method: Method::Composite,
        axes: None,
        passing: Passing::Plain,
        writing: Writing::PLAIN,
        lumped: false,
        for_readers: false,
    };
}

/// What all files of this stage read.
#[derive(Clone)]
pub struct Scene<'m> {
    pub(super) model: &'m Model,
    pub symbols: Rc<Symbols>,
    /// Roles of coordinates and equations; without loops and drives an empty one.
    pub(super) structure: Rc<Structure>,
    pub(super) mechanism: Rc<Mechanism>,
    pub(super) way: Choices,
    /// `Fixed` joints with a link of their own, since their reactions are asked for.
    pub(super) kept: Rc<[JointId]>,
}

impl<'m> Scene<'m> {
    /// Before its tree is built: [`super::equations::Equations::new`] does that, for which it takes a graph.
    pub fn new(model: &'m Model, symbols: Rc<Symbols>) -> Self {
        Scene {
            model,
            symbols,
            structure: Rc::default(),
            mechanism: Rc::default(),
            way: Choices::PLAIN,
            kept: Rc::from([]),
        }
    }
}
