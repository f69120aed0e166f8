//! Stage `mechanics`: articulated bodies (Featherstone 1983; 2008, chapter 7).
//!
//! In: a tree, velocities, minus gravity, wrenches that act on the links, efforts. Out: the accelerations.
//!
//! All accelerations are counted from those that the links have while no coordinate accelerates: the wrenches that these
//! need come from the Newton-Euler recursion, and no velocity term is left in the articulated equation f = A a + p. From
//! the leaves inwards each freedom s is eliminated: with U = A s and d = s . U + armature the outer bodies are felt as
//! A - U U^T / d and p + U (tau - s . p) / d; outwards again, q'' = (tau - s . p - U . a) / d. The pivots d are those of
//! the positive definite mass matrix.

use crate::symbolic::graph::{Graph, Scalar, Vector};

use super::articulated_inertia::ArticulatedInertia;
use super::kinematics::motions;
use super::newton_euler::{Wrench, inertial_wrench, to_parent};
use super::tree::{Link, Motion, Tree};

/// One eliminated freedom.
struct Pivot {
    link: usize,
    freedom: usize,
    twist: [Scalar; 6],
    /// U / d
    gain: [Scalar; 6],
    /// (tau - s . p) / d
    drive: Scalar,
}

/// Accelerations in the order of the coordinates. `base` is minus gravity, `efforts` are those of all coordinates.
pub fn forward_dynamics(
    g: &mut Graph,
    tree: &Tree,
    velocity: &[Scalar],
    base: Vector,
    applied: &[Wrench],
    efforts: &[Scalar],
) -> Vec<Scalar> {
    let still = vec![Scalar::ZERO; tree.freedoms()];
    let motions = motions(g, tree, velocity, &still, base);
    let mut wrenches = Vec::with_capacity(tree.links.len());
    for ((link, motion), outside) in tree.links.iter().zip(&motions).zip(applied) {
        let needed = inertial_wrench(g, link, motion);
        let outside = Wrench { moment: -outside.moment, force: -outside.force };
        wrenches.push(needed.add(g, &outside));
    }
    let pivots = eliminate(g, tree, wrenches, efforts);
    accelerate(g, tree, &pivots)
}

/// From the leaves inwards.
fn eliminate(g: &mut Graph, tree: &Tree, mut wrenches: Vec<Wrench>, efforts: &[Scalar]) -> Vec<Pivot> {
    let mut inertias: Vec<ArticulatedInertia> =
        tree.links.iter().map(|link| ArticulatedInertia::rigid(g, &link.inertia)).collect();
    let mut pivots = Vec::with_capacity(tree.freedoms());
    for (index, link) in tree.links.iter().enumerate().rev() {
        let mut inertia = inertias[index];
        let mut wrench = components(g, &wrenches[index]);
        for (freedom, twist) in tree.twists(link) {
            let column = inertia.apply(g, &twist);
            let along = dot(g, &twist, &column);
            let pivot = g.add(along, link.armature);
            let inverse = g.reciprocal(pivot);
            let pushed = dot(g, &twist, &wrench);
            let rest = g.sub(efforts[freedom], pushed);
            let drive = g.mul(rest, inverse);
            let gain = column.map(|u| g.mul(u, inverse));
            g.name(pivot, || format!("pivot_{}", freedom + 1));
            g.name(inverse, || format!("inverse_{}", freedom + 1));
            inertia = inertia.less(g, &column, &gain);
            wrench = std::array::from_fn(|k| {
                let handed = g.mul(gain[k], rest);
                g.add(wrench[k], handed)
            });
            pivots.push(Pivot { link: index, freedom, twist, gain, drive });
        }
        let Some(parent) = link.parent else { continue };
        let wrench = Wrench {
            moment: g.vector([wrench[0], wrench[1], wrench[2]]),
            force: g.vector([wrench[3], wrench[4], wrench[5]]),
        };
        let carried = to_parent(g, tree, index, &wrench);
        wrenches[parent] = wrenches[parent].add(g, &carried);
        let carried = inertia_to_parent(g, tree, link, &inertia);
        inertias[parent] = inertias[parent].add(g, &carried);
    }
    pivots
}

/// An articulated inertia about a link's origin as its parent sees it.
fn inertia_to_parent(g: &mut Graph, tree: &Tree, link: &Link, inertia: &ArticulatedInertia) -> ArticulatedInertia {
    let turned = match link.motion {
        Motion::Revolute(axis) | Motion::Screw(axis, _) => {
            let (sin, cos) = (g.sin(link.q), g.cos(link.q));
            inertia.turn(g, axis, cos, sin)
        }
        Motion::Prismatic(_) => *inertia,
        Motion::Ball(quaternion) => {
            let r = g.quaternion_rotation(quaternion);
            inertia.rotate(g, r)
        }
    };
    let placed = turned.rotate(g, link.rotation);
    let origin = tree.origin(g, link);
    let origin = g.components(origin);
    placed.shift(g, origin)
}

/// From the ground outwards.
fn accelerate(g: &mut Graph, tree: &Tree, pivots: &[Pivot]) -> Vec<Scalar> {
    let mut result = vec![Scalar::ZERO; tree.freedoms()];
    let mut pivots = pivots.iter().rev().peekable();
    let mut motions: Vec<(Vector, Vector)> = Vec::with_capacity(tree.links.len());
    for (index, link) in tree.links.iter().enumerate() {
        let mut motion = [Scalar::ZERO; 6];
        if let Some(parent) = link.parent {
            let (angular, linear) = motions[parent];
            let origin = tree.origin(g, link);
            let lever = g.cross(angular, origin);
            let linear = g.add_vectors(linear, lever);
            let angular = tree.to_link(g, link, angular);
            let linear = tree.to_link(g, link, linear);
            let (angular, linear) = (g.components(angular), g.components(linear));
            motion[..3].copy_from_slice(&angular);
            motion[3..].copy_from_slice(&linear);
        }
        // The freedom that was eliminated first depends on those after it.
        while let Some(pivot) = pivots.next_if(|p| p.link == index) {
            let felt = dot(g, &pivot.gain, &motion);
            let acceleration = g.sub(pivot.drive, felt);
            g.name(acceleration, || format!("acceleration_{}", pivot.freedom + 1));
            motion = std::array::from_fn(|k| {
                let part = g.mul(pivot.twist[k], acceleration);
                g.add(motion[k], part)
            });
            result[pivot.freedom] = acceleration;
        }
        let [a, b, c, x, y, z] = motion;
        motions.push((g.vector([a, b, c]), g.vector([x, y, z])));
    }
    result
}

fn components(g: &mut Graph, wrench: &Wrench) -> [Scalar; 6] {
    let (m, f) = (g.components(wrench.moment), g.components(wrench.force));
    [m[0], m[1], m[2], f[0], f[1], f[2]]
}

fn dot(g: &mut Graph, a: &[Scalar; 6], b: &[Scalar; 6]) -> Scalar {
    let terms: [Scalar; 6] = std::array::from_fn(|k| g.mul(a[k], b[k]));
    g.sum(&terms)
}
