//! Stage `mechanics`: how velocities answer to an impulse.
//!
//! In: the tree, impulses as symbols. Out: the jump d of the velocities, M d = impulse: forward dynamics of the mechanism
//! at rest, without gravity and forces, with the impulses for efforts. With closed loops see [`super::constrained`].

use std::rc::Rc;

use crate::dynamics::floating_bases::floating_bases;
use crate::dynamics::newton_euler::Wrench;
use crate::dynamics::{articulated, composite};
use crate::mechanics::equations::Equations;
use crate::mechanics::scene::Method;
use crate::symbolic::graph::{Scalar, Vector};
use crate::symbolic::linear_algebra::solve_symmetric;

impl Equations<'_> {
    /// Of an open tree, in the user's coordinates.
    pub(in crate::mechanics) fn jump(&mut self) -> Vec<Scalar> {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let shared = self.shared();
        let tree = &shared.tree;
        let impulses = mechanism.sign(&self.scene.symbols.impulses);
        let g = &mut self.g;
        let list = match self.scene.way.method {
            Method::Composite | Method::Floating => {
                let matrix = composite::mass_matrix(g, tree);
                let order = mechanism.elimination(self.scene.way.method == Method::Floating);
                solve_symmetric(g, &matrix, &order, &impulses)
            }
            Method::Articulated => {
                let rest = vec![Scalar::ZERO; tree.freedoms()];
                let nothing = vec![Wrench::ZERO; tree.links.len()];
                let floating_bases = floating_bases(&mechanism.tree);
                articulated::forward_dynamics(g, tree, &floating_bases, &rest, Vector::ZERO, &nothing, &impulses)
            }
        };
        mechanism.sign(&list)
    }
}
