//! Stage `dynamics`: masses that stay where they are carried.
//!
//! In: a link on a hinge whose moments are about to be regrouped, and what hangs on it. Out: some of its mass at the origin of
//! a link on another hinge that it carries, so that its first moment has a component less.
//!
//! Regrouping ([`super::regroup`]) leaves the fewest moments, which are not the fewest operations: a component of the first
//! moment takes five products and sums, three for the force and two for the moment, a mass at the hinge three. A mass
//! at that hinge is the same on both links. Only literals are divided by: a length that is a parameter might be zero.

use std::ops::Div;

use crate::symbolic::graph::{Graph, Scalar};

use super::inertia::Inertia;
use super::tree::{Motion, Tree};

/// How many times what there is may stand at a hinge: beyond that small values would be differences of large ones.
const MOST: f64 = 2.0;

/// Moves mass of a link, whose first moment and mass are those of all that it carries, to one of the links that it carries.
pub(super) fn keep_mass(g: &mut Graph, tree: &mut Tree, index: usize) {
    let Motion::Revolute(hinge) = tree.links[index].motion else { return };
    if !tree.moves(g, index) {
        return;
    }
    let total = tree.links[index].inertia.mass;
    for child in index + 1..tree.links.len() {
        let link = &tree.links[child];
        if link.parent != Some(index) || !matches!(link.motion, Motion::Revolute(_)) || !feels_force(tree, child) {
            continue;
        }
        let offset = g.components(link.offset);
        let first = tree.links[index].inertia.first;
        for axis in (0..3).filter(|&axis| axis != hinge) {
            let numbers = [total, first[axis], offset[axis]].map(|scalar| g.literal(scalar));
            let [Some(total), Some(first), Some(length)] = numbers else { continue };
            if first.is_zero() || !length.is_sharp() || length.is_zero() {
                continue;
            }
            let mass = first.div(length);
            if mass.value().abs() > MOST * total.value().abs() {
                continue;
            }
            let mass = g.number(mass);
            let there = Inertia { mass: -mass, ..Inertia::ZERO }.shift(g, offset);
            tree.links[index].inertia = tree.links[index].inertia.add(g, &there);
            tree.links[child].inertia.mass = g.add(tree.links[child].inertia.mass, mass);
            return;
        }
    }
}

/// Whether the acceleration of a link's origin counts for what it carries.
fn feels_force(tree: &Tree, from: usize) -> bool {
    let mut beyond = (from..tree.links.len()).filter(|&index| tree.support(Some(index)).any(|at| at == from));
    beyond.any(|index| tree.links[index].inertia.first.iter().any(|&moment| moment != Scalar::ZERO))
}
