//! Stage `dynamics`: origins of links along their hinges.
//!
//! In: a tree, not yet regrouped. Out: the same with the origins of links on hinges where they lie closest to those of their carriers. Any
//! point of a hinge's axis will do for one: a way along the axis is the same before and behind the turn, so it is left to what the link
//! carries. A last link has none then, a shoulder whose axes meet has one origin, which no force moves, and a composite
//! is shifted along fewer axes.

use crate::symbolic::graph::{Graph, Scalar, Vector};

use super::tree::{Motion, Tree};

/// Slides origins; the vectors lead from the new ones to the old ones, in link axes.
pub fn slide_origins(g: &mut Graph, tree: &Tree) -> Option<(Tree, Vec<Vector>)> {
    let mut tree = tree.clone();
    let mut ways = vec![Vector::ZERO; tree.links.len()];
    for (index, slid) in ways.iter_mut().enumerate() {
        let link = &tree.links[index];
        let (Motion::Revolute(axis), Some(_)) = (link.motion, link.parent) else { continue };
        let unit = g.along(axis, Scalar::ONE);
        let there = g.rotate(link.rotation, unit);
        let along = g.dot(there, link.offset);
        if along == Scalar::ZERO {
            continue;
        }
        let back = g.scale(along, there);
        let way = g.along(axis, along);
        let shift = g.components(way);
        let offset = g.sub_vectors(link.offset, back);
        let inertia = link.inertia.shift(g, shift);
        (tree.links[index].offset, tree.links[index].inertia) = (offset, inertia);
        for carried in tree.links.iter_mut().filter(|carried| carried.parent == Some(index)) {
            carried.offset = g.add_vectors(carried.offset, way);
        }
        *slid = way;
    }
    ways.iter().any(|&way| way != Vector::ZERO).then_some((tree, ways))
}
