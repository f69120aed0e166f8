//! Stage `mechanics`: the tree as the recursions of a way see it.
//!
//! In: the scene. Out: the tree with base inertial parameters, and with parallel hinges in common axes.

use std::rc::Rc;

use crate::dynamics::floating_bases::floating_bases;
use crate::dynamics::regroup::{regroup, regroup_but, regroup_keeping};
use crate::dynamics::shared_axes::{Shared, share_axes};
use crate::dynamics::slid_origins::slide_origins;
use crate::dynamics::tree::Tree;
use crate::dynamics::turned_ends::turn_ends;
use crate::symbolic::graph::{Graph, Vector};

use super::equations::Equations;
use super::scene::{Method, Passing};

#[derive(Clone, Default)]
pub(super) struct Trees {
    regrouped: Option<Rc<Tree>>,
    /// The regrouped tree in the axes that the dynamics is written in.
    shared: Option<Rc<Shared>>,
    /// The same with some mass at hinges.
    passed: Option<Rc<Shared>>,
}

impl Equations<'_> {
    /// The tree with regrouped inertias: for totals.
    pub(super) fn regrouped(&mut self) -> Rc<Tree> {
        if let Some(tree) = &self.caches.trees.regrouped {
            return Rc::clone(tree);
        }
        let tree = Rc::new(regroup(&mut self.g, &self.scene.mechanism.tree));
        self.caches.trees.regrouped = Some(Rc::clone(&tree));
        tree
    }

    /// The regrouped tree in the axes of this way, and how far wrenches given in link axes must turn.
    pub(super) fn shared(&mut self) -> Rc<Shared> {
        if let Some(shared) = &self.caches.trees.shared {
            return Rc::clone(shared);
        }
        let shared = match self.scene.way.method {
            // What floats is best eliminated whole.
            Method::Articulated => {
                let tree = &self.scene.mechanism.tree;
                let keep: Vec<usize> = floating_bases(tree).iter().map(|floating_base| floating_base.link).collect();
                self.in_axes(|g, tree| regroup_but(g, tree, false, &keep))
            }
            Method::Composite | Method::Floating => self.in_axes(regroup),
        };
        let shared = Rc::new(shared);
        self.caches.trees.shared = Some(Rc::clone(&shared));
        shared
    }

    /// The same for what passes motions and wrenches from link to link: some mass stays at hinges.
    pub(super) fn passed(&mut self) -> Rc<Shared> {
        if self.scene.way.method == Method::Articulated || self.scene.way.passing != Passing::Masses {
            return self.shared();
        }
        if let Some(passed) = &self.caches.trees.passed {
            return Rc::clone(passed);
        }
        let passed = Rc::new(self.in_axes(regroup_keeping));
        self.caches.trees.passed = Some(Rc::clone(&passed));
        passed
    }

    /// The tree of the scene regrouped, in the axes and about the origins of this way.
    fn in_axes(&mut self, regroup: impl FnOnce(&mut Graph, &Tree) -> Tree) -> Shared {
        let free = self.scene.way.passing != Passing::Plain;
        let g = &mut self.g;
        let tree = &self.scene.mechanism.tree;
        let slid = if free { slide_origins(g, tree) } else { None };
        let tree = &regroup(g, slid.as_ref().map_or(tree, |(tree, _)| tree));
        let turned = if free { turn_ends(g, tree) } else { None };
        let tree = turned.as_ref().map_or(tree, |(tree, _)| tree);
        let shared = self.scene.way.axes.and_then(|axes| share_axes(g, tree, axes));
        let mut shared = shared.unwrap_or_else(|| Shared::own(g, tree));
        if let Some((_, ends)) = &turned {
            for (turn, &end) in shared.turns.iter_mut().zip(ends) {
                *turn = g.compose(*turn, end);
            }
        }
        shared.tree.turns_columns = free;
        shared.ways = slid.map(|(_, ways)| ways);
        shared
    }

    /// Minus gravity: the acceleration of the ground that acts like it.
    pub(super) fn base(&mut self) -> Vector {
        match self.scene.mechanism.tree.gravity {
            Some(gravity) => self.g.vector(gravity.map(|c| -c)),
            None => Vector::ZERO,
        }
    }
}
