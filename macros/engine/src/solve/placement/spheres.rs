//! Stage `solve`: three points of a body in turn, each where three spheres meet.
//!
//! The first one has three distances from what is beside the body; the second two, and its distance from the first; the third one,
//! and its distances from both.

use crate::invariant::injection::{Break, broken};
use crate::symbolic::graph::{Graph, Scalar, Vector};

use super::{Alternative, Distance, Pose};

/// A centre with the square of its distance.
pub(super) type Sphere = (Vector, Scalar);

pub(super) fn pose(g: &mut Graph, groups: &[Vec<Distance>], at: &Alternative) -> Option<Pose> {
    let [first, second, third] = groups else { return None };
    let body = [first, second, third].map(|group| group[0].body);
    let apart = |g: &mut Graph, a: usize, b: usize| {
        let between = g.sub_vectors(body[a], body[b]);
        g.dot(between, between)
    };
    let sphere = |d: &Distance| (d.base, d.square);
    let one = meeting(g, [sphere(&first[0]), sphere(&first[1]), sphere(&first[2])], at.sides[0]);
    let own = apart(g, 0, 1);
    let two = meeting(g, [(one, own), sphere(&second[0]), sphere(&second[1])], at.sides[1]);
    let (to_one, to_two) = (apart(g, 0, 2), apart(g, 1, 2));
    let last = if broken(Break::LostSide) { at.sides[1] } else { at.sides[2] };
    let three = meeting(g, [(one, to_one), (two, to_two), sphere(&third[0])], last);
    Some(Pose::of_points(g, body, [one, two, three], None))
}

/// Where three spheres meet: differences of the first one and the others are planes n . x = h, x from its centre. With N = n1 x n2 and
/// m = h1 n2 - h2 n1 it is x = (m x N + side rho N) / N^2, rho^2 = r^2 N^2 - m^2.
pub(super) fn meeting(g: &mut Graph, spheres: [Sphere; 3], side: Scalar) -> Vector {
    let [first, second, third] = spheres;
    let (n1, h1) = plane(g, first, second);
    let (n2, h2) = plane(g, first, third);
    let normal = g.cross(n1, n2);
    let (a, b) = (g.scale(h1, n2), g.scale(h2, n1));
    let across = if broken(Break::MeetingSign) { g.add_vectors(a, b) } else { g.sub_vectors(a, b) };
    let (area, part) = (g.dot(normal, normal), g.dot(across, across));
    let whole = g.mul(first.1, area);
    let gap = g.sub(whole, part);
    let root = g.sqrt(gap);
    let rho = g.mul(side, root);
    let (flat, height) = (g.cross(across, normal), g.scale(rho, normal));
    let sum = g.add_vectors(flat, height);
    let inverse = g.reciprocal(area);
    let x = g.scale(inverse, sum);
    g.add_vectors(first.0, x)
}

/// The plane in which two spheres meet, from the centre of the first one: its normal leads to the other centre.
pub(super) fn plane(g: &mut Graph, first: Sphere, other: Sphere) -> Sphere {
    let normal = g.sub_vectors(other.0, first.0);
    let square = g.dot(normal, normal);
    let sum = g.sum(&[square, first.1, -other.1]);
    let half = g.decimal(0.5);
    (normal, g.mul(half, sum))
}
