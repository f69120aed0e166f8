//! Stage `mechanics`: motion of a link from the coordinates between it and the ground, and back.
//!
//! In: a tree and a link. Out: its pose, velocity and acceleration with the angular ones in its own axes, from link to
//! link; and for a link that floats (three translations, then a ball or three turns) the second derivatives of its
//! coordinates from its accelerations.

use crate::dynamics::tree::{Motion, Tree};
use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};

use super::triple::{Triple, sub};

/// How a link moves in the world.
#[derive(Clone, Debug)]
pub struct Moves {
    /// From its to the world's axes.
    pub rotation: Rotation,
    /// Of its origin, in world axes.
    pub place: Vector,
    pub velocity: Vector,
    pub acceleration: Vector,
    /// In its own axes.
    pub omega: Vector,
    pub d_omega: Vector,
}

/// Motion of every link on the path to this one. `accelerations` by velocity coordinate.
pub fn moves(g: &mut Graph, tree: &Tree, link: usize, accelerations: &[Scalar]) -> Vec<Moves> {
    let mut list: Vec<Moves> = Vec::new();
    let ground = Moves {
        rotation: Rotation::IDENTITY,
        place: Vector::ZERO,
        velocity: Vector::ZERO,
        acceleration: Vector::ZERO,
        omega: Vector::ZERO,
        d_omega: Vector::ZERO,
    };
    for at in tree.path(None, Some(link)) {
        let link = &tree.links[at];
        let below = list.last().unwrap_or(&ground).clone();
        let r = tree.origin(g, link);
        let (turning, along) = tree.joint_motion(g, link, &tree.velocity);
        let (d_turning, d_along) = tree.joint_motion(g, link, accelerations);
        let (slide, d_slide) = (g.rotate(link.rotation, along), g.rotate(link.rotation, d_along));
        // In the parent's axes.
        let swing = g.cross(below.omega, r);
        let velocity = g.add_vectors(swing, slide);
        let tangential = g.cross(below.d_omega, r);
        let two = g.integer(2);
        let twice = g.scale(two, slide);
        let both = g.add_vectors(swing, twice);
        let centripetal = g.cross(below.omega, both);
        let acceleration = g.sum_vectors(&[tangential, centripetal, d_slide]);
        let [r, velocity, acceleration] = [r, velocity, acceleration].map(|v| g.rotate(below.rotation, v));
        let carried = tree.to_link(g, link, below.omega);
        let omega = g.add_vectors(carried, turning);
        let d_carried = tree.to_link(g, link, below.d_omega);
        let relative = g.cross(omega, turning);
        let d_omega = g.sum_vectors(&[d_carried, relative, d_turning]);
        let own = tree.rotation(g, link);
        list.push(Moves {
            rotation: g.compose(below.rotation, own),
            place: g.add_vectors(below.place, r),
            velocity: g.add_vectors(below.velocity, velocity),
            acceleration: g.add_vectors(below.acceleration, acceleration),
            omega,
            d_omega,
        });
    }
    list
}

/// Second derivatives of the coordinates of a floating link, by velocity coordinate, from the acceleration of its
/// origin in world axes and its angular acceleration in its own. Nothing if it doesn't float by coordinate axes.
pub fn coordinates(
    g: &mut Graph,
    tree: &Tree,
    link: usize,
    acceleration: &Triple,
    d_omega: &Triple,
) -> Option<Vec<(usize, Scalar)>> {
    let path = tree.path(None, Some(link));
    let (translations, turns) = path.split_at_checked(3)?;
    let still = vec![Scalar::ZERO; tree.acceleration.len()];
    let moves = moves(g, tree, link, &still);
    let mut found = Vec::new();
    for &at in translations {
        let link = &tree.links[at];
        let Motion::Prismatic(axis) = link.motion else { return None };
        let straight = link.rotation == Rotation::IDENTITY && link.offset == Vector::ZERO;
        if !straight || found.iter().any(|f: &(usize, Scalar)| f.0 == link.freedom) {
            return None;
        }
        found.push((link.freedom, acceleration[axis]));
    }
    let centred = |&at: &usize| tree.links[at].rotation == Rotation::IDENTITY && tree.links[at].offset == Vector::ZERO;
    if !turns.iter().all(centred) {
        return None;
    }
    match *turns {
        [ball] => {
            let Motion::Ball(_) = tree.links[ball].motion else { return None };
            let freedom = tree.links[ball].freedom;
            found.extend((0..3).map(|k| (freedom + k, d_omega[k])));
        }
        [first, second, third] => {
            let axis = |at: usize| match tree.links[at].motion {
                Motion::Revolute(axis) => Some(axis),
                _ => None,
            };
            let (i, j, k) = (axis(first)?, axis(second)?, axis(third)?);
            if i == j || j == k {
                return None;
            }
            // In the axes before the last turn: the last axis is a coordinate axis there too.
            let last = &tree.links[third];
            let (turning, _) = tree.joint_motion(g, last, &tree.velocity);
            let relative = g.cross(moves.last()?.omega, turning);
            let relative = g.components(relative);
            let rest = sub(g, d_omega, &relative);
            let rest = g.vector(rest);
            let rest = tree.to_parent(g, last, rest);
            let bias = moves.get(moves.len().checked_sub(2)?)?.d_omega;
            let (rest, bias) = (g.components(rest), g.components(bias));
            let rest = sub(g, &rest, &bias);
            let unit = g.along(i, Scalar::ONE);
            let column = tree.to_link(g, &tree.links[second], unit);
            let column = g.components(column);
            // The first turn alone has a component along the axis that neither of the others has.
            let alone = 3 - j - k;
            let x = g.div(rest[alone], column[alone]);
            let mut other = |m: usize| {
                let carried = g.mul(column[m], x);
                g.sub(rest[m], carried)
            };
            let (y, z) = (other(j), other(k));
            for (at, value) in [(first, x), (second, y), (third, z)] {
                found.push((tree.links[at].freedom, value));
            }
        }
        _ => return None,
    }
    Some(found)
}
