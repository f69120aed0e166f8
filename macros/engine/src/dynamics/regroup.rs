//! Stage `dynamics`: base inertial parameters.
//!
//! In: a tree. Out: the same tree with the part of every link's inertia that its joint does not move handed to the
//! parent (Gautier and Khalil 1990; Khalil and Dombre 2002, chapter 9). In moments about the joint frame (m, m c, D):
//! - a revolute motion leaves points of its axis where they are: m, the first moment along the axis, D along the axis;
//! - a prismatic motion leaves all of D: a distribution with neither mass nor first moment feels rotation alone;
//! - a screw leaves D along its axis;
//! - a ball leaves the mass at its centre.
//!
//! Total energies and efforts stay as they are; reactions and energies of single links need the original tree.

use crate::symbolic::graph::{Graph, Scalar};

use super::inertia::Inertia;
use super::kept_masses::keep_mass;
use super::tree::{Motion, Tree};

/// Regroups from the leaves to the ground.
pub fn regroup(g: &mut Graph, tree: &Tree) -> Tree {
    regroup_but(g, tree, false, &[])
}

/// The same for recursions from link to link: some mass stays at hinges (`kept_masses`), and of what a hinge turns into
/// itself a rotor is left, which turns about the hinge and has no moment of inertia across it.
pub fn regroup_keeping(g: &mut Graph, tree: &Tree) -> Tree {
    regroup_as(g, tree, false, &[], true)
}

/// The same; second moments that a hinge turns into themselves may stay whole where they stand, and links may keep all
/// that they have.
pub fn regroup_but(g: &mut Graph, tree: &Tree, whole: bool, keep: &[usize]) -> Tree {
    regroup_as(g, tree, whole, keep, false)
}

fn regroup_as(g: &mut Graph, tree: &Tree, whole: bool, keep: &[usize], masses: bool) -> Tree {
    let mut tree = tree.clone();
    for index in (0..tree.links.len()).rev().filter(|index| !keep.contains(index)) {
        if masses {
            keep_mass(g, &mut tree, index);
        }
        let link = tree.links[index].clone();
        let mut kept = unmoved(&link.inertia, link.motion);
        if let Motion::Revolute(axis) = link.motion
            && whole
            && is_round(&link.inertia, axis)
        {
            kept.second[axis] = Scalar::ZERO;
        }
        if let Motion::Revolute(axis) = link.motion
            && masses
            && is_round(&link.inertia, axis)
        {
            kept.second[axis] = g.add(kept.second[axis], link.inertia.second[(axis + 1) % 3]);
        }
        if kept.is_zero() {
            continue;
        }
        tree.links[index].inertia = link.inertia.sub(g, &kept);
        let offset = g.components(link.offset);
        let turned = kept.rotate(g, link.rotation);
        // A second moment without mass is the same about any point, wherever a prismatic motion has carried it.
        let moved = turned.shift(g, offset);
        match link.parent {
            Some(parent) => tree.links[parent].inertia = tree.links[parent].inertia.add(g, &moved),
            None => {
                let ground = tree.ground.unwrap_or(Inertia::ZERO);
                tree.ground = Some(ground.add(g, &moved));
            }
        }
    }
    for link in &tree.links {
        name(g, &link.inertia, &link.name);
    }
    tree
}

/// Names for what parameters combine to.
fn name(g: &mut Graph, inertia: &Inertia, link: &str) {
    g.name(inertia.mass, || format!("mass_{link}"));
    for (axis, &moment) in ["x", "y", "z"].iter().zip(&inertia.first) {
        g.name(moment, || format!("first_{link}_{axis}"));
    }
    for (axes, &moment) in ["xx", "yy", "zz", "xy", "xz", "yz"].iter().zip(&inertia.second) {
        g.name(moment, || format!("second_{link}_{axes}"));
    }
}

/// Whether a turn about an axis leaves the second moments as they are, and they don't lie on the axis.
fn is_round(inertia: &Inertia, axis: usize) -> bool {
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    let second = &inertia.second;
    second[j] != Scalar::ZERO && second[j] == second[k] && second[3..].iter().all(|&moment| moment == Scalar::ZERO)
}

/// The part of a distribution that does not move when the joint does.
fn unmoved(inertia: &Inertia, motion: Motion) -> Inertia {
    let mut kept = Inertia::ZERO;
    match motion {
        Motion::Revolute(axis) => {
            kept.mass = inertia.mass;
            kept.first[axis] = inertia.first[axis];
            kept.second[axis] = inertia.second[axis];
        }
        Motion::Prismatic(_) => kept.second = inertia.second,
        Motion::Screw(axis, _) => kept.second[axis] = inertia.second[axis],
        Motion::Ball(_) => kept.mass = inertia.mass,
    }
    debug_assert!(kept.first.iter().filter(|&&s| s != Scalar::ZERO).count() <= 1);
    kept
}
