//! Stage `dynamics`: axes of last links.
//!
//! In: a tree, regrouped. Out: the same with last links on hinges written in axes that are turned about the hinge, so that their
//! first moment lies along one of them. Nothing hangs on them, so any axes will do: a sum with the angle pays for
//! five products and sums. Only literals are turned: the direction of what is a parameter might be undefined.

use crate::contracts::call::Call;
use crate::symbolic::graph::{Graph, Rotation, Scalar};

use super::tree::{Motion, Tree};

/// Turns last links; the rotations are from the axes in which links were written to those in which they are now.
pub fn turn_ends(g: &mut Graph, tree: &Tree) -> Option<(Tree, Vec<Rotation>)> {
    let mut tree = tree.clone();
    let mut turns = vec![Rotation::IDENTITY; tree.links.len()];
    let mut changed = false;
    for (index, turn) in turns.iter_mut().enumerate() {
        let link = &tree.links[index];
        let Motion::Revolute(axis) = link.motion else { continue };
        let first = [1, 2].map(|step| link.inertia.first[(axis + step) % 3]);
        let is_last = tree.links.iter().all(|other| other.parent != Some(index));
        let is_oblique = first.iter().all(|&moment| moment != Scalar::ZERO && g.literal(moment).is_some());
        if !is_last || !is_oblique {
            continue;
        }
        let angle = g.call(Call::Atan2, &[first[1], first[0]]);
        let inertia = tree.links[index].inertia.turn(g, axis, -angle);
        *turn = g.axis_rotation(axis, -angle);
        let link = &mut tree.links[index];
        link.inertia = inertia;
        link.q = g.add(link.q, angle);
        changed = true;
    }
    changed.then_some((tree, turns))
}
