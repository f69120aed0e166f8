//! Stage `dynamics`: kinetic energy and the first moment of mass.
//!
//! In: a tree, its velocities. Out: twice the kinetic energy, part by part: w . I w + v . (m v + 2 w x h) of each link,
//! h = m c, and those of rotors; the first moment of all mass, which climbs to the ground like a point does (see
//! [`super::point_kinematics`]).

use crate::symbolic::graph::{Graph, Rotation, RotationNode, Scalar, Vector};

use super::inertia::Inertia;
use super::tree::{Link, Motion, Tree};
use super::velocities::LinkVelocity;

/// J, parts of twice the kinetic energy.
pub(crate) fn twice_kinetic(g: &mut Graph, tree: &Tree, velocities: &[LinkVelocity]) -> Vec<Scalar> {
    let mut twice = Vec::new();
    for (link, &velocity) in tree.links.iter().zip(velocities) {
        twice.push(twice_of(g, &link.inertia, velocity));
        if link.armature != Scalar::ZERO {
            let rate = tree.velocity[link.freedom];
            twice.push(g.product(&[link.armature, rate, rate]));
        }
    }
    twice
}

fn twice_of(g: &mut Graph, inertia: &Inertia, (angular, linear): LinkVelocity) -> Scalar {
    if inertia.is_zero() {
        return Scalar::ZERO;
    }
    let w = g.components(angular);
    let momentum = [0, 1, 2].map(|i| {
        let terms = [0, 1, 2].map(|j| {
            if w[j] == Scalar::ZERO {
                return Scalar::ZERO;
            }
            let entry = inertia.tensor(g, i, j);
            g.mul(entry, w[j])
        });
        g.sum(&terms)
    });
    let momentum = g.vector(momentum);
    let turning = g.dot(angular, momentum);
    let first = g.vector(inertia.first);
    let swing = g.cross(angular, first);
    let straight = g.scale(inertia.mass, linear);
    let pushed = g.sum_vectors(&[straight, swing, swing]);
    let moving = g.dot(linear, pushed);
    g.add(turning, moving)
}

/// Parts of the first moment of all mass in world axes.
pub(crate) fn first_moment(g: &mut Graph, tree: &Tree) -> Vec<Vector> {
    first_moment_about(g, tree, None)
}

/// The same of what a link carries, about its origin in its axes.
pub(crate) fn first_moment_about(g: &mut Graph, tree: &Tree, carrier: Option<usize>) -> Vec<Vector> {
    let mut masses: Vec<Scalar> = tree.links.iter().map(|link| link.inertia.mass).collect();
    let mut parts: Vec<Vec<(Rotation, Vector)>> = Vec::with_capacity(tree.links.len());
    for link in &tree.links {
        parts.push(vec![(Rotation::IDENTITY, g.vector(link.inertia.first))]);
    }
    let mut ground = vec![(Rotation::IDENTITY, g.vector(tree.ground.unwrap_or(Inertia::ZERO).first))];
    let carried = carrier.map_or(0, |carrier| carrier + 1);
    for (index, link) in tree.links.iter().enumerate().skip(carried).rev() {
        let own = std::mem::take(&mut parts[index]);
        let inwards = outgoing(g, link, own, masses[index]);
        match link.parent {
            Some(parent) => {
                masses[parent] = g.add(masses[parent], masses[index]);
                parts[parent].extend(inwards);
            }
            None => ground.extend(inwards),
        }
    }
    let sum = carrier.map_or(ground, |carrier| std::mem::take(&mut parts[carrier]));
    sum.into_iter().map(|(rotation, v)| g.rotate(rotation, v)).collect()
}

/// A subtree's parts as the parent sees them.
fn outgoing(g: &mut Graph, link: &Link, parts: Vec<(Rotation, Vector)>, mass: Scalar) -> Vec<(Rotation, Vector)> {
    let (turn, travel) = match link.motion {
        Motion::Revolute(axis) => (g.axis_rotation(axis, link.q), Vector::ZERO),
        Motion::Screw(axis, pitch) => {
            let length = g.product(&[mass, pitch, link.q]);
            (g.axis_rotation(axis, link.q), g.along(axis, length))
        }
        Motion::Prismatic(axis) => {
            let length = g.mul(mass, link.q);
            (Rotation::IDENTITY, g.along(axis, length))
        }
        Motion::Ball(orientation) => (orientation.rotation(g), Vector::ZERO),
    };
    let mut parts = turned(g, turn, parts);
    parts.push((Rotation::IDENTITY, travel));
    let mut parts = turned(g, link.rotation, parts);
    let lever = g.scale(mass, link.offset);
    parts.push((Rotation::IDENTITY, lever));
    parts
}

/// Turns of parallel axes stay apart with their summed angles; others are carried out one after the other.
fn turned(g: &mut Graph, rotation: Rotation, mut parts: Vec<(Rotation, Vector)>) -> Vec<(Rotation, Vector)> {
    parts.retain(|part| part.1 != Vector::ZERO);
    if rotation == Rotation::IDENTITY || parts.is_empty() {
        return parts;
    }
    let both: Vec<Rotation> = parts.iter().map(|part| g.compose(rotation, part.0)).collect();
    if both.iter().any(|&r| matches!(g.rotation_node(r), RotationNode::Product(..))) {
        let carried: Vec<Vector> = parts.iter().map(|&(r, v)| g.rotate(r, v)).collect();
        return vec![(rotation, g.sum_vectors(&carried))];
    }
    // Parts that turn alike are one.
    let mut merged: Vec<(Rotation, Vector)> = Vec::with_capacity(parts.len());
    for (rotation, (_, v)) in both.into_iter().zip(parts) {
        match merged.iter_mut().find(|part| part.0 == rotation) {
            Some(part) => part.1 = g.add_vectors(part.1, v),
            None => merged.push((rotation, v)),
        }
    }
    merged
}
