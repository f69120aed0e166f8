//! Stage `solve`: a body with one point where three spheres meet, which three more distances turn about it.
//!
//! With d = a - v and c = b - b_v about the point v, each distance is one product, d . R c = k, 2 k = d^2 + c^2 - r^2. The first one
//! leaves a turn alpha about d_1 and a turn beta about c_1: R = E X(alpha) Z X(beta) F^T, where E and F are frames with their first
//! axes along d_1 and c_1, X turns about the first axis, and Z about the third by the angle between both, whose cosine is kappa.
//! The other two are A cos(beta) + B sin(beta) + C = 0 with coefficients that are linear in cosine and sine of alpha, so that
//!
//! (cos, sin)(beta) = (X, Y) / D, X = B1 C2 - B2 C1, Y = C1 A2 - C2 A1, D = A1 B2 - A2 B1,
//!
//! and the condition on alpha is X^2 + Y^2 = D^2, of degree 4 in cosine and sine. Where D vanishes, as it does in symmetric robots, two modes
//! have the same alpha, so beta is taken from one of both equations, on either side.

use crate::symbolic::graph::{Graph, Scalar, Vector};

use super::circles::{clearer, meeting as meeting_circle};
use super::spheres::meeting;
use super::{Alternative, Distance, Pose, frame_along};

pub(super) fn pose(g: &mut Graph, groups: &[Vec<Distance>], at: &Alternative) -> Option<Pose> {
    let [point, others @ ..] = groups else { return None };
    let spheres = [0, 1, 2].map(|k| (point[k].base, point[k].square));
    let centre = meeting(g, spheres, at.sides[0]);
    let body = point[0].body;
    let mut products = Vec::with_capacity(3);
    for other in others.iter().flatten() {
        let (d, c) = (g.sub_vectors(other.base, centre), g.sub_vectors(other.body, body));
        let [far, near] = [d, c].map(|v| g.dot(v, v));
        let sum = g.sum(&[far, near, -other.square]);
        let half = g.decimal(0.5);
        products.push((d, c, g.mul(half, sum)));
    }
    let [(d, c, k), second, third] = products[..] else { return None };
    let (base, long) = frame_along(g, d);
    let (own, short) = frame_along(g, c);
    let scale = g.mul(long, short);
    let kappa = g.mul(k, scale);
    let square = g.mul(kappa, kappa);
    let rest = g.sub(Scalar::ONE, square);
    let sigma = g.sqrt(rest);
    let [cos, sin] = at.point;
    let mut equations = Vec::with_capacity(2);
    for (d, c, k) in [second, third] {
        let [d, c] = [(base, d), (own, c)].map(|(axes, v)| axes.map(|axis| g.dot(axis, v)));
        // Of d, turned back by alpha.
        let along = [g.mul(d[1], cos), g.mul(d[2], sin)];
        let across = [g.mul(d[2], cos), -g.mul(d[1], sin)];
        let (along, across) = (g.sum(&along), g.sum(&across));
        let (x, y) = (g.mul(kappa, along), g.mul(sigma, d[0]));
        let middle = g.sub(x, y);
        let (x, y) = (g.mul(middle, c[1]), g.mul(across, c[2]));
        let a = g.add(x, y);
        let (x, y) = (g.mul(across, c[1]), g.mul(middle, c[2]));
        let b = g.sub(x, y);
        let (x, y) = (g.mul(kappa, d[0]), g.mul(sigma, along));
        let first = g.add(x, y);
        let first = g.mul(first, c[0]);
        equations.push([a, b, g.sub(first, k)]);
    }
    let [one, two] = equations[..] else { return None };
    let minor = |g: &mut Graph, i: usize, j: usize| {
        let (x, y) = (g.mul(one[i], two[j]), g.mul(one[j], two[i]));
        g.sub(x, y)
    };
    let [x, y, whole] = [minor(g, 1, 2), minor(g, 2, 0), minor(g, 0, 1)];
    let squares = [x, y, whole].map(|s| g.mul(s, s));
    let condition = g.sum(&[squares[0], squares[1], -squares[2]]);
    let line = clearer(g, one, two);
    let [c_beta, s_beta] = meeting_circle(g, line, at.sides[1]);
    // Images of c's frame, turned by beta, in d's frame: columns of X(alpha) Z.
    let [e0, e1, e2] = base;
    let combine = |g: &mut Graph, terms: &[(Scalar, Vector)]| {
        let terms: Vec<Vector> = terms.iter().map(|&(s, v)| g.scale(s, v)).collect();
        g.sum_vectors(&terms)
    };
    let turned = combine(g, &[(cos, e1), (sin, e2)]);
    let third = combine(g, &[(cos, e2), (-sin, e1)]);
    let first = combine(g, &[(kappa, e0), (sigma, turned)]);
    let second = combine(g, &[(kappa, turned), (-sigma, e0)]);
    let images =
        [first, combine(g, &[(c_beta, second), (s_beta, third)]), combine(g, &[(c_beta, third), (-s_beta, second)])];
    let rows = Pose::of_frames(g, images, own);
    Some(Pose::through(g, rows, body, centre, Some(condition)))
}
