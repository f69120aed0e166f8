//! Stage `dynamics`: velocities of the links in their own axes, from the ground outwards.
//!
//! In: a tree. Out: per link its angular velocity and the velocity of its origin, for energies and powers.

use crate::symbolic::graph::{Graph, Vector};

use super::tree::Tree;

/// Angular velocity, and velocity of the origin, in link axes.
pub(crate) type LinkVelocity = (Vector, Vector);

pub(crate) fn velocities(g: &mut Graph, tree: &Tree) -> Vec<LinkVelocity> {
    let mut list: Vec<LinkVelocity> = Vec::with_capacity(tree.links.len());
    for link in &tree.links {
        let (w, v) = link.parent.map_or((Vector::ZERO, Vector::ZERO), |parent| list[parent]);
        let origin = tree.origin(g, link);
        let carried = g.cross(w, origin);
        let at_joint = g.add_vectors(v, carried);
        let (turn, travel) = tree.joint_motion(g, link, &tree.velocity);
        let (w, v) = (tree.to_link(g, link, w), tree.to_link(g, link, at_joint));
        let angular = g.add_vectors(w, turn);
        let linear = g.add_vectors(v, travel);
        let name = &link.name;
        g.name_vector(angular, || format!("w_{name}"));
        g.name_vector(linear, || format!("v_{name}"));
        list.push((angular, linear));
    }
    list
}
