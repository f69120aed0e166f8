//! Stage `mechanics`: accelerations and jumps of mechanisms whose loops are solved, by articulated bodies.
//!
//! In: definitions of dependent and driven coordinates. Out: accelerations of the state: coordinates that follow are embedded in the
//! articulated-body algorithm ([`crate::dynamics::embedded`]) with the velocity map for their slopes, and their accelerations while those of the
//! state are zero for what all are counted from.

use std::rc::Rc;

use crate::dynamics::embedded::{self, Causes, Embedding};
use crate::dynamics::floating_bases::floating_bases;
use crate::dynamics::newton_euler::Wrench;
use crate::dynamics::tree::Tree;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::translate::forces::LoadCase;
use crate::symbolic::graph::{Scalar, Vector};

impl Equations<'_> {
    /// Whether this is a way to accelerations: not where multipliers are kept, speeds are chosen, or no loop is closed before the ground.
    pub(in crate::mechanics) fn embeds(&mut self, reduction: &Reduction) -> bool {
        let structure = Rc::clone(&self.scene.structure);
        let is_closed = structure.rows.is_empty() && structure.rates.rows.is_empty() && !structure.has_speeds();
        if !is_closed || self.is_first_order() || !self.rotors().is_empty() {
            return false;
        }
        let embedding = self.embedding(reduction);
        embedding.is_local(&self.shared().tree)
    }

    pub(in crate::mechanics) fn accelerations_embedded(&mut self, reduction: &Reduction) -> Vec<Scalar> {
        let shared = self.shared();
        let tree = &shared.tree;
        let mut embedding = self.embedding(reduction);
        embedding.still.clone_from(&self.scene.mechanism.tree.acceleration);
        for place in self.speeds() {
            embedding.still[place] = Scalar::ZERO;
        }
        let loads = self.loads(LoadCase::Declared);
        let base = self.base();
        let applied = shared.turn(&mut self.g, &loads.applied);
        let causes = Causes { velocity: &tree.velocity, base, applied: &applied, efforts: &loads.efforts };
        let accelerations = self.of_the_state(tree, &causes, &embedding);
        self.where_the_state_rests(reduction, &accelerations)
    }

    /// How velocities jump under impulses: the same at rest, without forces.
    pub(in crate::mechanics) fn jump_embedded(&mut self, reduction: &Reduction) -> Vec<Scalar> {
        let shared = self.shared();
        let tree = &shared.tree;
        let embedding = self.embedding(reduction);
        let (rest, nothing) = (vec![Scalar::ZERO; tree.freedoms()], vec![Wrench::ZERO; tree.links.len()]);
        let mut impulses = rest.clone();
        for (place, impulse) in self.speeds().into_iter().zip(self.scene.symbols.impulses.clone()) {
            impulses[place] = impulse;
        }
        let impulses = self.scene.mechanism.sign(&impulses);
        let causes = Causes { velocity: &rest, base: Vector::ZERO, applied: &nothing, efforts: &impulses };
        let jump = self.of_the_state(tree, &causes, &embedding);
        self.finish(reduction, &jump)
    }

    /// In the order of its velocities.
    fn of_the_state(&mut self, tree: &Tree, causes: &Causes<'_>, embedding: &Embedding) -> Vec<Scalar> {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let found = embedded::forward_dynamics(&mut self.g, tree, &floating_bases(&mechanism.tree), causes, embedding);
        let found = mechanism.sign(&found);
        self.speeds().into_iter().map(|place| found[place]).collect()
    }

    /// How coordinates follow, in the tree's own directions.
    fn embedding(&mut self, reduction: &Reduction) -> Embedding {
        let mechanism = Rc::clone(&self.scene.mechanism);
        let speeds = self.speeds();
        let map = self.velocity_map(reduction, &speeds);
        let mut embedding = Embedding::open(mechanism.tree.freedoms());
        for (place, row) in map.iter().enumerate().filter(|(place, _)| !speeds.contains(place)) {
            let slopes = speeds.iter().zip(row).filter(|one| *one.1 != Scalar::ZERO);
            let is_against = |other: usize| mechanism.flipped[place] != mechanism.flipped[other];
            embedding.slopes[place] =
                slopes.map(|(&other, &slope)| (other, if is_against(other) { -slope } else { slope })).collect();
        }
        embedding
    }
}
