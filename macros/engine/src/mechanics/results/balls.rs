//! Stage `mechanics`: accelerations of trees on balls whose velocities are speeds.
//!
//! In: a tree in which hinges were made balls ([`crate::mechanics::translate::balls`]), and nothing else follows. Out: accelerations of the
//! velocity coordinates by the articulated-body algorithm (Featherstone 2008), as of any open tree: the hinges' own links, which carry
//! nothing, are left out, and efforts on them are efforts on the balls.

use std::rc::Rc;

use crate::dynamics::articulated;
use crate::dynamics::floating_bases::floating_bases;
use crate::dynamics::inertia::Inertia;
use crate::dynamics::newton_euler::Wrench;
use crate::dynamics::tree::{Link, Tree};
use crate::mechanics::equations::Equations;
use crate::mechanics::loops::reduction::Reduction;
use crate::mechanics::translate::forces::LoadCase;
use crate::symbolic::graph::{Scalar, Vector};

impl Equations<'_> {
    /// Nothing where something else follows, or hangs on what is between hinges.
    pub(in crate::mechanics) fn accelerations_on_balls(&mut self, reduction: &Reduction) -> Option<Vec<Scalar>> {
        let structure = Rc::clone(&self.scene.structure);
        let mechanism = Rc::clone(&self.scene.mechanism);
        let hinges: Vec<_> = mechanism.balls.iter().flat_map(|ball| ball.hinges).collect();
        let is_open = structure.has_speeds()
            && structure.rows.is_empty()
            && structure.rates.rows.is_empty()
            && reduction.rates.len() == hinges.len();
        let follow = structure.rates.unknowns.iter().all(|unknown| hinges.contains(unknown));
        if !is_open || !follow || self.is_first_order() || !self.rotors().is_empty() {
            return None;
        }
        let loads = self.loads(LoadCase::Declared);
        let places: Vec<usize> = hinges.iter().map(|&hinge| self.freedom(hinge)).collect();
        let (tree, kept) = without(&mechanism.tree, &places)?;
        let is_free = |wrench: &Wrench| wrench.force == Vector::ZERO && wrench.moment == Vector::ZERO;
        if !(0..loads.applied.len()).all(|k| kept.contains(&k) || is_free(&loads.applied[k])) {
            return None;
        }
        let applied: Vec<Wrench> = kept.iter().map(|&k| loads.applied[k]).collect();
        let efforts = self.project(reduction, &mechanism.sign(&loads.efforts));
        let efforts = mechanism.sign(&efforts);
        let base = self.base();
        let bases = floating_bases(&tree);
        let found = articulated::forward_dynamics(&mut self.g, &tree, &bases, &tree.velocity, base, &applied, &efforts);
        let found = mechanism.sign(&found);
        let accelerations: Vec<Scalar> = self.speeds().into_iter().map(|place| found[place]).collect();
        Some(self.finish(reduction, &accelerations))
    }
}

/// The tree without links of some freedoms, and the places of those that stay; nothing where such a link carries something.
fn without(tree: &Tree, freedoms: &[usize]) -> Option<(Tree, Vec<usize>)> {
    let goes = |link: &Link| freedoms.contains(&link.freedom);
    let kept: Vec<usize> = (0..tree.links.len()).filter(|&k| !goes(&tree.links[k])).collect();
    let is_bare = |link: &Link| link.inertia == Inertia::ZERO && link.armature == Scalar::ZERO;
    if !tree.links.iter().filter(|link| goes(link)).all(is_bare) {
        return None;
    }
    let mut links = Vec::with_capacity(kept.len());
    for &k in &kept {
        let link = &tree.links[k];
        let parent = match link.parent {
            None => None,
            Some(parent) => Some(kept.iter().position(|&at| at == parent)?),
        };
        links.push(Link { parent, ..link.clone() });
    }
    Some((Tree { links, ..tree.clone() }, kept))
}
