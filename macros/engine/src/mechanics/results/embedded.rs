//! Stage `mechanics`: accelerations of mechanisms whose loops are solved, by articulated bodies.
//!
//! In: definitions of dependent and driven coordinates. Out: accelerations of the state: coordinates that follow are embedded in the
//! articulated-body algorithm ([`crate::dynamics::embedded`]) with the velocity map for their slopes, and their accelerations while those of the
//! state are zero for what all are counted from.

use std::rc::Rc;

use crate::dynamics::embedded::{self, Causes, Embedding};
use crate::dynamics::floating_bases::floating_bases;
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::translate::forces::LoadCase;
use crate::symbolic::graph::Scalar;

impl Equations<'_> {
    /// Nothing where multipliers are kept, speeds are chosen, or no loop is closed before the ground.
    pub(in crate::mechanics) fn accelerations_embedded(&mut self, reduction: &Reduction) -> Option<Vec<Scalar>> {
        let structure = Rc::clone(&self.scene.structure);
        let mechanism = Rc::clone(&self.scene.mechanism);
        let is_closed = structure.rows.is_empty() && structure.rates.rows.is_empty() && !structure.has_speeds();
        if !is_closed || self.is_first_order() || !self.rotors().is_empty() {
            return None;
        }
        let embedding = self.embedding(reduction);
        let shared = self.shared();
        let tree = &shared.tree;
        if !embedding.is_local(tree) {
            return None;
        }
        let loads = self.loads(LoadCase::Declared);
        let base = self.base();
        let g = &mut self.g;
        let applied = shared.turn(g, &loads.applied);
        let causes = Causes { velocity: &tree.velocity, base, applied: &applied, efforts: &loads.efforts };
        let found = embedded::forward_dynamics(g, tree, &floating_bases(&mechanism.tree), &causes, &embedding);
        let found = mechanism.sign(&found);
        let accelerations: Vec<Scalar> = self.speeds().into_iter().map(|place| found[place]).collect();
        Some(self.where_the_state_rests(reduction, &accelerations))
    }

    /// In the tree's own directions.
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
            embedding.still[place] = mechanism.tree.acceleration[place];
        }
        embedding
    }
}
