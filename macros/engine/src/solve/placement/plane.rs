//! Stage `solve`: a body in a plane, held by three distances.
//!
//! Seen along the plane's normal n, with the body turned by phi about it, the ends are u = a - Q b for a point p of the plane: |p - u|^2 = r^2. Differences with the first one
//! are linear in y = p - u_1: y . w_i = h_i with w_i = u_i - u_1 and 2 h_i = r_1^2 + w_i^2 - r_i^2. So y = J (h_3 w_2 - h_2 w_3) / D with D = n . (w_2 x w_3) and J x = n x x, and the condition on phi is
//!
//! |h_3 w_2 - h_2 w_3|^2 = r_1^2 D^2,
//!
//! of degree 3 in cosine and sine: w_i^2, h_i, w_2 . w_3 and D are linear in them. Where two ends are one point, that is where two circles
//! meet, and the other end follows from it.

use crate::contracts::call::Call;
use crate::dynamics::tree::Motion;
use crate::solve::chain::Link;
use crate::solve::distances::at_rest;
use crate::symbolic::graph::{Graph, Rotation, Scalar, Vector};

use super::improved::Twist;
use super::spheres::plane;
use super::{Alternative, Distance, Pose};

/// What the plane is, seen from the base.
struct Plane {
    normal: Vector,
    /// Two axes in it.
    axes: [Vector; 2],
    /// The body before it moves.
    rotation: Rotation,
    offset: Vector,
}

pub(super) fn pose(
    g: &mut Graph,
    links: &[Link],
    groups: &[Vec<Distance>],
    is_inverted: bool,
    at: &Alternative,
) -> Option<Pose> {
    let own = Plane::new(g, links)?;
    let own = if is_inverted { own.inverted(g) } else { own };
    // Ends in the plane, with the square of their distance there.
    let flat = groups.iter().flatten().map(|distance| {
        let body = g.rotate(own.rotation, distance.body);
        let moved = g.add_vectors(body, own.offset);
        let between = g.sub_vectors(distance.base, moved);
        let height = g.dot(own.normal, between);
        let height = g.mul(height, height);
        let square = if distance.is_flat { distance.square } else { g.sub(distance.square, height) };
        Distance { base: own.project(g, distance.base), body: own.project(g, body), square, is_flat: true }
    });
    let flat: Vec<Distance> = flat.collect();
    let [first, second, third] = flat[..] else { return None };
    let (point, place, condition) = match groups.len() {
        2 => own.by_pair(g, [first, second, third], at),
        _ => own.by_turn(g, [first, second, third], at),
    };
    Some(own.pose(g, point, place, condition))
}

/// How the body can move: along the plane, and about its normal.
pub(super) fn twists(g: &mut Graph, links: &[Link]) -> Vec<Twist> {
    Plane::new(g, links).map_or_else(Vec::new, |plane| {
        let [first, second] = plane.axes.map(|axis| (axis, Vector::ZERO));
        vec![first, second, (Vector::ZERO, plane.normal)]
    })
}

impl Plane {
    /// Two slides and a turn across them.
    fn new(g: &mut Graph, links: &[Link]) -> Option<Plane> {
        let (rotation, offset, directions) = at_rest(g, links);
        let motions = links.iter().filter_map(|link| match link {
            Link::Free { motion, .. } => Some(*motion),
            Link::Known { .. } => None,
        });
        let both: Vec<(Motion, Vector)> = motions.zip(directions).collect();
        let slides: Vec<Vector> =
            both.iter().filter(|one| matches!(one.0, Motion::Prismatic(_))).map(|one| one.1).collect();
        let turn = both.iter().find(|one| matches!(one.0, Motion::Revolute(_)))?.1;
        let [first, second] = slides[..] else { return None };
        let flat = [first, second].into_iter().all(|slide| g.dot(slide, turn) == Scalar::ZERO);
        flat.then(|| Plane { normal: turn, axes: [first, g.cross(turn, first)], rotation, offset })
    }

    /// The same as the body sees it.
    fn inverted(self, g: &mut Graph) -> Plane {
        let back = self.rotation.transpose();
        let [normal, first, second] = [self.normal, self.axes[0], self.axes[1]].map(|v| g.rotate(back, v));
        let offset = g.rotate(back, self.offset);
        Plane { normal, axes: [first, second], rotation: back, offset: -offset }
    }

    fn project(&self, g: &mut Graph, v: Vector) -> Vector {
        let along = g.dot(self.normal, v);
        let part = g.scale(along, self.normal);
        g.sub_vectors(v, part)
    }

    /// Turned by an angle about the normal, of what lies in the plane.
    fn turned(&self, g: &mut Graph, [cos, sin]: [Scalar; 2], v: Vector) -> Vector {
        let across = g.cross(self.normal, v);
        let (a, b) = (g.scale(cos, v), g.scale(sin, across));
        g.add_vectors(a, b)
    }

    /// The point of the turn, where the body's origin is, and the condition.
    fn by_turn(&self, g: &mut Graph, flat: [Distance; 3], at: &Alternative) -> ([Scalar; 2], Vector, Option<Scalar>) {
        let ends = flat.map(|d| {
            let turned = self.turned(g, at.point, d.body);
            g.sub_vectors(d.base, turned)
        });
        let square = flat[0].square;
        let [(w2, h2), (w3, h3)] = [1, 2].map(|k| plane(g, (ends[0], square), (ends[k], flat[k].square)));
        let (a, b) = (g.scale(h3, w2), g.scale(h2, w3));
        let across = g.sub_vectors(a, b);
        let area = g.cross(w2, w3);
        let area = g.dot(self.normal, area);
        let whole = g.dot(across, across);
        let part = g.product(&[square, area, area]);
        let condition = g.sub(whole, part);
        // Where the ends lie in a line, two modes have the same turn: y is where two of the circles meet, those whose centres are
        // farther apart.
        let [first, second] = [w2, w3].map(|w| g.dot(w, w));
        let less = g.call(Call::Less, &[first, second]);
        let (a, b) = (g.components(w2), g.components(w3));
        let w = [0, 1, 2].map(|k| g.call(Call::Select, &[less, b[k], a[k]]));
        let w = g.vector(w);
        let h = g.call(Call::Select, &[less, h3, h2]);
        let way = g.call(Call::Max, &[first, second]);
        let (whole, part) = (g.mul(square, way), g.mul(h, h));
        let gap = g.sub(whole, part);
        let gap = g.call(Call::Max, &[gap, Scalar::ZERO]);
        let root = g.sqrt(gap);
        let root = g.mul(at.sides[0], root);
        let beside = g.cross(self.normal, w);
        let (along, beside) = (g.scale(h, w), g.scale(root, beside));
        let sum = g.add_vectors(along, beside);
        let inverse = g.reciprocal(way);
        let y = g.scale(inverse, sum);
        (at.point, g.add_vectors(ends[0], y), Some(condition))
    }

    /// The first two distances end in one point of the body.
    fn by_pair(
        &self,
        g: &mut Graph,
        [first, second, third]: [Distance; 3],
        at: &Alternative,
    ) -> ([Scalar; 2], Vector, Option<Scalar>) {
        let one = self.meeting(g, (first.base, first.square), (second.base, second.square), at.sides[0]);
        let own = g.sub_vectors(third.body, first.body);
        let square = g.dot(own, own);
        let two = self.meeting(g, (one, square), (third.base, third.square), at.sides[1]);
        let there = g.sub_vectors(two, one);
        let inverse = g.reciprocal(square);
        let side = g.cross(own, there);
        let (along, across) = (g.dot(own, there), g.dot(self.normal, side));
        let point = [along, across].map(|x| g.mul(x, inverse));
        let turned = self.turned(g, point, first.body);
        (point, g.sub_vectors(one, turned), None)
    }

    /// Where two circles meet.
    fn meeting(&self, g: &mut Graph, a: (Vector, Scalar), b: (Vector, Scalar), side: Scalar) -> Vector {
        let (normal, place) = plane(g, a, b);
        let square = g.dot(normal, normal);
        let (whole, part) = (g.mul(a.1, square), g.mul(place, place));
        let gap = g.sub(whole, part);
        let root = g.sqrt(gap);
        let rho = g.mul(side, root);
        let across = g.cross(self.normal, normal);
        let (flat, height) = (g.scale(place, normal), g.scale(rho, across));
        let sum = g.add_vectors(flat, height);
        let inverse = g.reciprocal(square);
        let x = g.scale(inverse, sum);
        g.add_vectors(a.0, x)
    }

    /// With the body's origin at a place in the plane.
    fn pose(&self, g: &mut Graph, point: [Scalar; 2], place: Vector, condition: Option<Scalar>) -> Pose {
        let [first, second] = self.axes;
        let images = [self.turned(g, point, first), self.turned(g, point, second), self.normal];
        let back = self.rotation.transpose();
        let own = [first, second, self.normal].map(|v| g.rotate(back, v));
        let rows = Pose::of_frames(g, images, own);
        let height = g.dot(self.normal, self.offset);
        let height = g.scale(height, self.normal);
        Pose { rows, position: g.add_vectors(place, height), condition }
    }
}
