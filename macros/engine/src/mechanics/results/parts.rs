//! Stage `mechanics`: the equations of motion taken apart for a reader.
//!
//! In: the tree, declared forces. Out: what inertia, gravity and forces contribute to each equation, so that
//! inertial + gravity = forces. The recursion is linear in the three, and is run for each of them alone.

use std::rc::Rc;

use crate::dynamics::inertia::Inertia;
use crate::dynamics::kinematics::motions;
use crate::dynamics::newton_euler::{Wrench, efforts, transmitted};
use crate::dynamics::tree::{Link, Tree};
use crate::mechanics::equations::Equations;
use crate::mechanics::translate::forces::LoadCase;
use crate::symbolic::graph::{Scalar, Vector};

/// By velocity coordinate of the user's.
pub(in crate::mechanics) struct Parts {
    /// Of accelerations and velocities.
    pub inertial: Vec<Scalar>,
    /// Minus the weight's efforts.
    pub gravity: Vec<Scalar>,
    /// Efforts of what the load case holds.
    pub forces: Vec<Scalar>,
}

impl Equations<'_> {
    pub(in crate::mechanics) fn parts(&mut self, case: LoadCase) -> Parts {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let loads = self.loads(case);
        let base = self.base();
        let tree = &mechanism.tree;
        let free = vec![Wrench { moment: Vector::ZERO, force: Vector::ZERO }; tree.links.len()];
        let still = vec![Scalar::ZERO; tree.freedoms()];
        let weightless = Tree {
            links: tree.links.iter().map(|link| Link { inertia: Inertia::ZERO, ..link.clone() }).collect(),
            ..tree.clone()
        };
        let g = &mut self.g;
        let mut pass = |tree: &Tree, velocity: &[Scalar], acceleration: &[Scalar], base: Vector, applied: &[Wrench]| {
            let motions = motions(g, tree, velocity, acceleration, base);
            let wrenches = transmitted(g, tree, &motions, applied);
            mechanism.sign(&efforts(g, tree, &wrenches, acceleration))
        };
        let mut inertial = pass(tree, &tree.velocity, &tree.acceleration, Vector::ZERO, &free);
        let gravity = pass(tree, &still, &still, base, &free);
        let passed = pass(&weightless, &still, &still, Vector::ZERO, &loads.applied);
        let direct = mechanism.sign(&loads.efforts);
        let forces = direct.iter().zip(&passed).map(|(&direct, &passed)| self.g.sub(direct, passed)).collect();
        let accelerations = self.all_accelerations();
        self.add_rotor_efforts(&mut inertial, &accelerations);
        Parts { inertial, gravity, forces }
    }
}
