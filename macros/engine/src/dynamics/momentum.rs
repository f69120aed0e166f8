//! Stage `dynamics`: momenta, and how kinetic energy changes with coordinates.
//!
//! In: a tree, its velocities. Out: the momentum of each link and all that it carries; dT/dq at fixed rates.
//!
//! With the velocity (w, v) of a link at its origin and the momentum (n, f) of all that it carries, about that origin, a
//! joint with the unit twist (a, b) has the momentum a . n + b . f. The energy T of what it carries changes with its
//! coordinate as if the link's velocity changed by the product (w, v) x (a, b) of motions, for what lies beyond goes along
//! in the link's axes: dT/dq = (n, f) . (w x a, w x b + v x a) = a . (n x w + f x v) + b . (f x w). No acceleration and no
//! centrifugal term comes up, so this costs less than a bias does. (Featherstone 2008, section 2.9, for the product;
//! Naudet et al. 2003 for a recursion of Hamilton's equations.)

use crate::symbolic::graph::{Graph, Scalar, Vector};

use super::kinematics::LinkMotion;
use super::newton_euler::{Wrench, inertial_wrench, to_parent};
use super::tree::Tree;
use super::velocities::LinkVelocity;

/// Momentum of each link and all that it carries: angular about the link's origin, linear.
pub(crate) fn carried(g: &mut Graph, tree: &Tree, moving: &[LinkVelocity]) -> Vec<Wrench> {
    let mut momenta: Vec<Wrench> = Vec::with_capacity(tree.links.len());
    for (link, motion) in tree.links.iter().zip(from_rest(moving)) {
        momenta.push(inertial_wrench(g, link, &motion));
    }
    for index in (0..tree.links.len()).rev() {
        let link = &tree.links[index];
        let momentum = momenta[index];
        g.name_vector(momentum.force, || format!("p_{}", link.name));
        g.name_vector(momentum.moment, || format!("h_{}", link.name));
        let Some(parent) = link.parent else { continue };
        let outer = to_parent(g, tree, index, &momentum);
        momenta[parent] = momenta[parent].add(g, &outer);
    }
    momenta
}

/// dT/dq at fixed rates, in the tree's coordinates.
pub(crate) fn swept(g: &mut Graph, tree: &Tree, moving: &[LinkVelocity], momenta: &[Wrench]) -> Vec<Scalar> {
    let mut list = vec![Scalar::ZERO; tree.freedoms()];
    for ((link, &(angular, linear)), momentum) in tree.links.iter().zip(moving).zip(momenta) {
        let turned = g.cross(momentum.moment, angular);
        let pushed = g.cross(momentum.force, linear);
        let moment = g.add_vectors(turned, pushed);
        let force = g.cross(momentum.force, angular);
        for (freedom, effort) in tree.project(g, link, moment, force) {
            list[freedom] = effort;
        }
    }
    list
}

/// Accelerations from rest to these velocities in a second: the wrenches that they take are the momenta.
pub(crate) fn from_rest(moving: &[LinkVelocity]) -> Vec<LinkMotion> {
    let motion = |&(angular, linear)| LinkMotion {
        angular: Vector::ZERO,
        angular_rate: angular,
        linear_rate: linear,
        kept: None,
    };
    moving.iter().map(motion).collect()
}

/// The wrench that moves so all that a link carries, about its origin in its axes; that of the whole tree about the world's
/// origin in world axes.
pub(crate) fn moved_whole(g: &mut Graph, tree: &Tree, motions: &[LinkMotion], carrier: Option<usize>) -> Wrench {
    let mut wrenches: Vec<Wrench> = Vec::with_capacity(tree.links.len());
    for (link, motion) in tree.links.iter().zip(motions) {
        wrenches.push(inertial_wrench(g, link, motion));
    }
    let mut ground = Wrench::ZERO;
    for index in (carrier.map_or(0, |carrier| carrier + 1)..tree.links.len()).rev() {
        let passed = to_parent(g, tree, index, &wrenches[index]);
        let into = tree.links[index].parent.map_or(&mut ground, |parent| &mut wrenches[parent]);
        *into = into.add(g, &passed);
    }
    carrier.map_or(ground, |carrier| wrenches[carrier])
}
